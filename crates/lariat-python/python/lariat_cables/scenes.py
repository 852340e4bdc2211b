"""Runs of scenes: a TOML file (docs/scene.md of the repository), its text, or a dict of the same keys."""

from __future__ import annotations

import html
import json
import warnings
from collections.abc import Callable, Iterator, Mapping
from os import PathLike, fspath
from pathlib import Path
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from lariat_cables import _lariat
from lariat_cables._lariat import World
from lariat_cables.errors import ReadError, ResultWarning

Array = NDArray[np.float64]
SceneLike = Union[str, "PathLike[str]", Mapping[str, Any]]

_VECTORS = {
    "position": ("x", "y", "z"),
    "velocity": ("vx", "vy", "vz"),
    "slope": ("sx", "sy", "sz"),
    "force": ("fx", "fy", "fz"),
    "rotation": ("qx", "qy", "qz", "qw"),
    "angular_velocity": ("wx", "wy", "wz"),
    "linear": ("px", "py", "pz"),
    "angular": ("lx", "ly", "lz"),
}


def source(scene: SceneLike) -> tuple[str, str]:
    """Returns name and text of a scene."""
    if isinstance(scene, Mapping):
        return "scene", _lariat.to_toml(dict(scene))
    path = fspath(scene)
    if "\n" in path:
        return "scene", path
    try:
        return path, Path(path).read_text(encoding="utf-8")
    except (OSError, ValueError) as error:
        raise ReadError(f"cannot read {path}: {error}") from error


def overrides(settings: Mapping[str, Any] | None) -> list[str]:
    """Returns settings as ``KEY=VALUE`` with values in TOML."""
    return [setting(key, value) for key, value in (settings or {}).items()]


def setting(key: str, value: Any) -> str:
    """Returns one override, its value in TOML."""
    text = _lariat.to_toml({"x": value if not isinstance(value, Mapping) else dict(value)})
    if isinstance(value, Mapping):
        pairs = (line.split(" = ", 1) for line in text.splitlines() if " = " in line)
        return f"{key}={{ {', '.join(f'{k} = {v}' for k, v in pairs)} }}"
    return f"{key}={' '.join(text.split(' = ', 1)[1].split())}"


class Probe:
    """The samples of a probe: columns by name (``probe.tension``) or index, vectors by theirs (``probe.force``)."""

    def __init__(self, columns: list[str], rows: Array) -> None:
        self.columns = columns
        self.rows = rows
        """All samples, shape (samples, columns)."""

    @property
    def t(self) -> Array:
        """Times of the samples in s."""
        return self.rows[:, 0]

    def __getitem__(self, name: str) -> Array:
        if name in self.columns:
            column: Array = self.rows[:, self.columns.index(name)]
            return column
        vector = ("mx", "my", "mz") if name == "moment" else _VECTORS.get(name, ("",))
        if all(column in self.columns for column in vector):
            columns: Array = self.rows[:, [self.columns.index(column) for column in vector]]
            return columns
        raise KeyError(f"no column {name!r}; the probe has {', '.join(self.columns)}")

    def __getattr__(self, name: str) -> Array:
        if name.startswith("_") or name in ("columns", "rows"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(error.args[0]) from None

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        return f"<Probe: {len(self)} samples of {', '.join(self.columns)}>"


class Probes(dict[str, Probe]):
    """The probes of a run by name."""

    def __missing__(self, name: str) -> Probe:
        raise KeyError(f"no probe {name!r}; the run has {', '.join(self) or 'none'}")


class _Written:
    """The page, the picture, the motion and the state of a run that was pickled."""

    def __init__(self, page: str, svg: str, usd: str, state: str) -> None:
        self._page, self._svg, self._usd, self._state = page, svg, usd, state

    def page(self) -> str:
        return self._page

    def svg(self) -> str:
        return self._svg

    def usd(self) -> str:
        return self._usd

    def state(self) -> str:
        return self._state


class Run:
    """A run of a scene: ``probes`` by name, ``summary``, ``t``; in a notebook, the animated view."""

    def __init__(self, summary: dict[str, Any], probes: Probes, recorded: _lariat.Recorded | _Written) -> None:
        self.summary = summary
        """The results and costs, with the keys of summary.json."""
        self.probes = probes
        """Samples by the name of the probe."""
        self._recorded = recorded
        self._rests = False

    def __getstate__(self) -> dict[str, Any]:
        state = self._recorded.state() if self._rests else ""
        return {**self.__dict__, "_recorded": _Written(self.page(), self.svg(), self.usd(), state)}

    @property
    def t(self) -> Array:
        """Times in s of the samples of the first probe; empty without probes."""
        return next((probe.t for probe in self.probes.values()), np.empty(0))

    @property
    def warnings(self) -> list[str]:
        """What is told of the warnings of the run, a line for each kind; ``summary["warnings"]`` has all, with levels."""
        return list(self.summary["told"])

    def page(self) -> str:
        """Returns the page that plays the motion, as HTML that needs no network."""
        return self._recorded.page()

    def save(self, folder: str | PathLike[str]) -> None:
        """Writes the files of ``lariat run``: probes/NAME.csv, summary.json and view.html, the page, in place of those of the last run; of
        ``statics`` also state, from which ``run(start=folder)`` and ``lariat run --from`` start.

        Raises ``InTheWayError`` for a file that Lariat did not write, or that was changed since, and ``BusyError`` while another
        program writes there.
        """
        files = [("summary.json", json.dumps(self.summary, indent=2) + "\n"), ("view.html", self.page())]
        for name, probe in self.probes.items():
            rows = [",".join(probe.columns), *(",".join(repr(float(x)) for x in row) for row in probe.rows)]
            files.append((f"probes/{name}.csv", "\n".join(rows) + "\n"))
        if self._rests:
            files.append(("state", self._recorded.state()))
        _lariat.save_files(folder, files)

    def svg(self) -> str:
        """Returns the motion as an animated SVG, for a README or a page: no script, any browser."""
        return self._recorded.svg()

    def save_svg(self, path: str | PathLike[str]) -> None:
        """Writes the motion as an animated SVG, in place of one that was written so and that nobody changed; else ``InTheWayError``."""
        _lariat.save_file(path, self.svg(), "svg")

    def usd(self) -> str:
        """Returns the motion as OpenUSD (.usda): curves and bodies with time samples, and the stiffness of the cables."""
        return self._recorded.usd()

    def save_usd(self, path: str | PathLike[str]) -> None:
        """Writes the motion as OpenUSD, for usdview, Blender and others, in place of one as ``save_svg``."""
        _lariat.save_file(path, self.usd(), "usd")

    def __repr__(self) -> str:
        return f"<Run of {self.summary['name']!r}: {self.summary['simulated_s']} s, probes {', '.join(self.probes) or 'none'}>"

    def _repr_html_(self) -> str:
        page = html.escape(self.page(), quote=True)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 600px; border: 0"></iframe>'


class _Bar:
    """A progress bar by tqdm, if it is installed."""

    def __init__(self, wanted: bool, total: float, unit: str) -> None:
        self._bar: Any = None
        self._unit, self._total = unit, total
        if wanted:
            try:
                from tqdm.auto import tqdm  # type: ignore[import-untyped, unused-ignore]
            except ImportError:
                return
            self._bar = tqdm(total=total, unit=unit, delay=1.0)

    def __enter__(self) -> Callable[[float], None] | None:
        return self._to if self._bar is not None else None

    def _to(self, value: float) -> None:
        self._bar.update(value - self._bar.n)

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()


def _state(start: Run | str | PathLike[str]) -> tuple[str, str]:
    """Returns the text of a state, and where it comes from."""
    if isinstance(start, Run):
        if not start._rests:
            raise ValueError("start: a run of lariat.statics, or a folder with its state, not a run in time")
        return start._recorded.state(), "start"
    file = Path(fspath(start)) / "state"
    try:
        return file.read_text(encoding="utf-8"), str(file)
    except (OSError, ValueError) as error:
        raise ReadError(f"cannot read {file}: {error}") from error


def _collect(
    scene: SceneLike,
    settings: Mapping[str, Any] | None,
    statics: bool,
    progress: bool,
    error: float | str | None,
    start: Run | str | PathLike[str] | None = None,
) -> Run:
    name, text = source(scene)
    given = overrides(settings)
    state = None if start is None else _state(start)
    total = _duration(text, settings)
    with _Bar(progress and total is not None, total or 0.0, "s") as bar:
        summary, tables, failed, recorded = _lariat.run_scene(name, text, given, statics=statics, error=error, start=state, progress=bar)
    run = Run(summary, Probes({key: Probe(columns, rows) for key, (columns, rows) in tables.items()}), recorded)
    run._rests = statics and failed is None
    for line in run.warnings:
        # the caller of run or statics
        warnings.warn(line, ResultWarning, stacklevel=3)
    if failed is not None:
        failed.run = run
        raise failed
    return run


def _duration(text: str, settings: Mapping[str, Any] | None) -> float | None:
    if settings and isinstance(settings.get("duration"), (int, float)):
        return float(settings["duration"])
    lines: Iterator[str] = (line.split("#")[0] for line in text.splitlines())
    for line in lines:
        if line.strip().startswith("["):
            break
        key, _, value = line.partition("=")
        if key.strip() == "duration":
            try:
                return float(value)
            except ValueError:
                return None
    return None


def run(
    scene: SceneLike,
    *,
    set: Mapping[str, Any] | None = None,  # noqa: A002
    error: float | str | None = None,
    start: Run | str | PathLike[str] | None = None,
    progress: bool = True,
) -> Run:
    """Runs a scene for its duration.

    With ``error``, in m, elements and integrator of the scene are chosen so that no position is off by more, and several runs prove it:
    ``summary["error"]`` has the claim, its parts and ``outcome``, which is ``"proven"`` or says why not. A text asks for tensions or moments:
    ``"tension=1%"``, ``"tension=50N"``, ``"moment=5%"``, ``"moment=2Nm"``, at ends, held and loaded points and the largest of each cable.

    ``start`` is the equilibrium that the run begins in, bit for bit: what ``statics`` of the same scene returned, or a folder that
    it, or ``lariat static``, was saved to. Duration, ``dt``, probes and name may differ; all else that does is refused by its name.
    It does not go together with ``error``.

    ``set`` overrides keys, as ``{"cable.sling.elements": 20}``. Progress is shown by tqdm if it is installed and the run takes longer than a second.

    What a run tells of itself, a line for each kind, goes through Python's ``warnings`` as ``errors.ResultWarning``.

    Raises ``SceneError`` for a scene that is not accepted, ``StateError`` and ``ReadError`` for a ``start`` that is not its state, and the
    error of the mechanics for a run that fails; its attribute ``run`` then has the samples until there.
    """
    return _collect(scene, set, False, progress, error, start)


def statics(
    scene: SceneLike,
    *,
    set: Mapping[str, Any] | None = None,  # noqa: A002
    error: float | str | None = None,
) -> Run:
    """Finds the static equilibrium of a scene; probes then have one sample each, at t = 0. ``error`` is as of ``run``.

    Raises ``NoEquilibriumError`` if there is none, and as ``run``.
    """
    return _collect(scene, set, True, False, error)


def load(scene: SceneLike, *, set: Mapping[str, Any] | None = None) -> World:  # noqa: A002
    """Returns the world of a scene, brought to its start as by ``run``, to be stepped, read and changed by a program.

    ``world.step()`` advances it by the ``dt`` of the scene. ``world.cable("sling")``, ``world.body("crate")`` and
    ``world.attachment("hook")`` find what the scene calls so. Kinematic bodies follow their ``path`` or velocity, and loads
    act, as in a run; a kinematic body without them goes where ``set_next_kinematic_translation`` sends it, and a body that the
    scene loads takes impulses, but no other forces. Probes and ``duration`` are for runs. ``set`` overrides keys, as of ``run``.

    What the start tells, a line for each kind, goes through Python's ``warnings`` as ``errors.ResultWarning``.

    Raises ``SceneError``, the errors of the mechanics, and ``TimedCutError`` for a cable that the scene cuts at a time.
    """
    world, told = _lariat.load_scene(*source(scene), overrides(set))
    for line in told:
        warnings.warn(line, ResultWarning, stacklevel=2)
    return world


def keys(path: str | None = None) -> str:
    """Returns the keys of a scene, with unit, range and default, as Markdown: all, or those of a table or key, such as ``"cable.drag"``.

    Raises ``errors.NoSuchKeyError`` for a key that does not exist.
    """
    return _lariat.scene_keys(path)


def rules() -> str:
    """Returns the rules of the elastic forces, and what each is for, as a table."""
    return _lariat.scene_rules()


def import_mjcf(model: str | PathLike[str]) -> str:
    """Returns the cables of a MuJoCo model (``<composite type="cable">``, ``<flexcomp dim="1">``), a file or its text, as a scene in TOML.

    Raises ``errors.ImportError`` for what cannot be imported right.
    """
    name, text = ("model", fspath(model)) if fspath(model).lstrip().startswith("<") else source(model)
    return _lariat.import_mjcf(name, text)
