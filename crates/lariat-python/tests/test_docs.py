"""The code of docs/python.md runs as it stands, block after block."""

import re
import subprocess
import sys
from pathlib import Path
from unittest import mock

import pytest

import lariat_cables as lariat

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "python.md"


def blocks():
    """The code of the page in order."""
    return re.findall(r"^```python\n(.*?)^```$", PAGE.read_text(), re.DOTALL | re.MULTILINE)


def test_every_block_of_the_page_runs(tmp_path, monkeypatch):
    """Paths of scenes are those of a clone; what a block writes goes to a folder of the test."""
    (tmp_path / "assets").symlink_to(ROOT / "assets")
    pyplot = mock.MagicMock()
    monkeypatch.setitem(sys.modules, "matplotlib", mock.MagicMock(pyplot=pyplot))
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", pyplot)
    names = {"scene": "assets/scenes/payload_pendulum.toml"}
    found = blocks()
    assert len(found) >= 8
    for number, code in enumerate(found):
        try:
            exec(compile(code, f"{PAGE.name}, block {number + 1}", "exec"), names)
        except Exception as error:
            pytest.fail(f"block {number + 1}: {error!r}\n{code}")
    # the page says what the blocks show
    half_weight, flexible = 0.147 * 9.81 * 3.0 / 2.0, 2.746  # N; a catenary without bending stiffness: sinh(x)/x = 1.2
    assert half_weight < names["line"].tension.max() < flexible
    assert names["reading"].rate == pytest.approx(1 / 60, rel=1e-6)
    assert names["done"].forces.force[0][1] > 0.0
    assert (tmp_path / "out" / "payload" / "view.html").exists()
    assert issubclass(lariat.errors.StepFailedError, lariat.Error)


def test_the_blocks_of_the_page_are_strictly_typed(tmp_path):
    """Each block as a user's file, behind the imports of the page and the names that earlier blocks leave."""
    names = "import math\nfrom typing import Any\nimport numpy as np\nimport lariat_cables as lariat\n"
    names += "section: lariat.Section\nrope: lariat.Cable\nworld: lariat.World\nhook: int\nscene: Any\n"
    files = []
    for number, code in enumerate(blocks()):
        files.append(tmp_path / f"block_{number + 1}.py")
        files[-1].write_text((names if number else "") + code)
    # a page binds a name anew, and its functions are short
    looser = ["no-redef", "no-untyped-def", "no-untyped-call", "assignment"]
    arguments = ["--strict", "--ignore-missing-imports", *(f"--disable-error-code={code}" for code in looser)]
    command = [sys.executable, "-m", "mypy", *arguments, *map(str, files)]
    found = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert found.returncode == 0, found.stdout + found.stderr
