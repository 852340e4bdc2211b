"""The stubs: strictly typed, and the same as the extension module."""

from __future__ import annotations

import ast
import builtins
import re
import subprocess
import sys
from pathlib import Path

import docstrings
from lariat_cables import _lariat, errors, results



def test_stubs_are_those_of_the_module(tmp_path: Path) -> None:
    allowed = tmp_path / "allowed"
    allowed.write_text("lariat_cables._lariat.__all__\n", encoding="utf-8")
    arguments = [sys.executable, "-m", "mypy.stubtest", "lariat_cables._lariat", "--allowlist", str(allowed)]
    found = subprocess.run(arguments, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert found.returncode == 0, found.stdout + found.stderr


def test_the_package_and_its_examples_are_strictly_typed(tmp_path: Path) -> None:
    here = Path(__file__).parents[1]
    for what in (["-p", "lariat_cables"], [str(here / "examples")]):
        arguments = ["--strict", "--cache-dir", str(tmp_path), "--config-file", str(here / "pyproject.toml"), *what]
        found = subprocess.run([sys.executable, "-m", "mypy", *arguments], capture_output=True, text=True, check=False, cwd=tmp_path)
        assert found.returncode == 0, found.stdout + found.stderr


def words(doc: str | None) -> str:
    return " ".join((doc or "").split())


def test_docstrings_are_those_of_the_stubs() -> None:
    """``python docstrings.py`` writes them."""
    found = docstrings.of_stubs()
    assert len(found) > 125
    for (owner, name), doc in found.items():
        thing = getattr(_lariat, owner) if owner else _lariat
        assert words(getattr(thing, name).__doc__ if name else thing.__doc__) == words(doc), (owner, name)


def test_fields_of_results_say_what_they_are() -> None:
    """Those with a text in the source have it in ``help``."""
    for own in (results.Sample, results.Attachment, results.ReelReading, results.EndForces):
        assert not any((getattr(own, name).__doc__ or "").startswith("Alias") for name in own._fields), own


def test_calls_say_what_they_raise() -> None:
    """Every call with arguments, and every property that can be set, names exceptions that there are."""
    found = docstrings.of_stubs()
    public = {"Section", "Integrator", "Cable", "CoSimulation", "World", ""}
    for node in ast.parse(docstrings.STUBS.read_text(encoding="utf-8")).body:
        owner, items = (node.name, node.body) if isinstance(node, ast.ClassDef) else ("", [node])
        for item in items:
            if not isinstance(item, ast.FunctionDef) or item.name.startswith("_") or (owner, item.name) not in found:
                continue
            given = [a for a in item.args.args + item.args.kwonlyargs if a.arg not in ("self", "cls")]
            if owner in public and given:
                assert "aises" in found[owner, item.name], (owner, item.name)
    for name in {name for doc in found.values() for name in re.findall(r"\b\w+Error\b", doc)}:
        assert hasattr(errors, name) or hasattr(builtins, name), name
