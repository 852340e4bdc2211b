"""Tests run in a folder of their own: MuJoCo writes its log into the present one."""

import sys
from pathlib import Path

import pytest

# docstrings.py
sys.path.insert(0, str(Path(__file__).parents[1]))


@pytest.fixture(autouse=True)
def _own_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
