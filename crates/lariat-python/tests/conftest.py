"""Tests run in a folder of their own: MuJoCo writes its log into the present one."""

import pytest


@pytest.fixture(autouse=True)
def _own_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
