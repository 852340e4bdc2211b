"""The name of the module, and its alias."""

from __future__ import annotations

import subprocess
import sys
from importlib.metadata import distribution
from pathlib import Path

ALIAS = Path(__file__).parents[1] / "data" / "purelib"


def told(code: str, *path: Path) -> str:
    """What a new process prints that starts as with the wheel's .pth file."""
    start = f"import sys; sys.path[:0] = {[str(p) for p in (*path, ALIAS)]}; sys.modules.pop('_lariat_cables_alias', None)\n"
    start += "sys.meta_path[:] = [f for f in sys.meta_path if f.__class__ is not type or f.__name__ != '_Finder']\nimport _lariat_cables_alias\n"
    done = subprocess.run([sys.executable, "-c", start + code], capture_output=True, text=True, check=False)
    return (done.stdout + done.stderr).strip()


def test_lariat_is_an_alias_where_no_other_module_has_the_name() -> None:
    """The same objects, below it too: an exception is caught by either name."""
    code = (
        "import lariat, lariat.errors, lariat.with_mujoco\n"
        "import lariat_cables, lariat_cables.errors\n"
        "from lariat.effects import Drag\n"
        "print(lariat is lariat_cables, lariat.errors is lariat_cables.errors, Drag is lariat_cables.Drag, lariat_cables.__spec__.name)"
    )
    assert told(code.replace(", lariat.with_mujoco", "")) == "True True True lariat_cables"
    assert told("import lariat.nothing").endswith("No module named 'lariat_cables.nothing'")


def test_another_lariat_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "lariat").mkdir()
    (tmp_path / "lariat" / "__init__.py").write_text("whose = 'theirs'")
    (tmp_path / "lariat" / "errors.py").write_text("whose = 'theirs'")
    code = "import lariat_cables, lariat, lariat.errors\nprint(lariat.whose, lariat.errors.whose, lariat_cables.__name__)"
    assert told(code, tmp_path) == "theirs theirs lariat_cables"


def test_nothing_is_imported_before_it_is_asked_for() -> None:
    assert told("print(any(name in sys.modules for name in ('numpy', 'lariat', 'lariat_cables')))") == "False"


def test_the_wheel_holds_no_file_called_lariat_and_the_licences_of_what_is_inside() -> None:
    files = [str(file) for file in distribution("lariat-cables").files or []]
    assert not any(file.startswith(("lariat/", "lariat.py")) for file in files)
    for name in ("lariat_cables.pth", "_lariat_cables_alias.py", "lariat_cables/py.typed"):
        assert name in files
    texts = [file for file in distribution("lariat-cables").files or [] if file.name == "THIRD-PARTY-LICENSES"]
    assert len(texts) == 1 and "uPlot" in texts[0].read_text() and "rapier3d" in texts[0].read_text()
