"""The stubs: strictly typed, and the same as the extension module."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path


def test_stubs_are_those_of_the_module(tmp_path: Path) -> None:
    allowed = tmp_path / "allowed"
    allowed.write_text("lariat._lariat.__all__\n", encoding="utf-8")
    arguments = [sys.executable, "-m", "mypy.stubtest", "lariat._lariat", "--allowlist", str(allowed)]
    found = subprocess.run(arguments, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert found.returncode == 0, found.stdout + found.stderr


def test_the_package_and_its_examples_are_strictly_typed(tmp_path: Path) -> None:
    here = Path(__file__).parents[1]
    for what in (["-p", "lariat"], [str(here / "examples")]):
        arguments = ["--strict", "--cache-dir", str(tmp_path), "--config-file", str(here / "pyproject.toml"), *what]
        found = subprocess.run([sys.executable, "-m", "mypy", *arguments], capture_output=True, text=True, check=False, cwd=tmp_path)
        assert found.returncode == 0, found.stdout + found.stderr
