"""Sweeps: one scene at many points, each a value for some keys, on all cores of this machine or on a Dask cluster."""

from __future__ import annotations

import itertools
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from os import cpu_count
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lariat_cables import _lariat
from lariat_cables.errors import InvalidValueError
from lariat_cables.scenes import Probe, Probes, Run, SceneLike, _Bar, setting, source

Series = dict[str, NDArray[np.float64]]
Reduce = Mapping[str, Callable[[Run], float]]

TIMES = ("cpu_s", "wall_s", "real_time_factor")
"""Columns that differ between two runs of the same."""


class Sweep:
    """The rows of a sweep: settings, results, warnings and error of each run."""

    def __init__(self, settings: list[dict[str, Any]], rows: list[dict[str, Any]], series: list[Series] | None = None) -> None:
        self.settings = settings
        """The values of each run by key."""
        self.rows = rows
        """By run: results by name, warnings, error (None if the run did not fail)."""
        self.series = series if series is not None else [{} for _ in rows]
        """By run: the arrays that were asked for, by name; empty for a scene that was refused."""

    def __len__(self) -> int:
        return len(self.rows)

    @property
    def errors(self) -> list[str | None]:
        """Why each run failed; None if it did not."""
        return [row["error"] for row in self.rows]

    @property
    def columns(self) -> dict[str, list[Any]]:
        """The table by column: settings, results (None where a run has none), warnings, error."""
        names = sorted({name for row in self.rows for name in row["results"]})
        keys = list(dict.fromkeys(key for s in self.settings for key in s))
        table: dict[str, list[Any]] = {key: [s.get(key) for s in self.settings] for key in keys}
        table.update({name: [row["results"].get(name) for row in self.rows] for name in names})
        table["warnings"] = [len(row["warnings"]) for row in self.rows]
        table["error"] = self.errors
        return table

    def table(self) -> Any:
        """Returns the table as a DataFrame of pandas, else as a Table of Arrow, else as a dict of NumPy arrays."""
        columns = self.columns
        try:
            import pandas  # type: ignore[import-untyped, unused-ignore]

            return pandas.DataFrame(columns)
        except ImportError:
            pass
        try:
            import pyarrow  # type: ignore[import-not-found, import-untyped, unused-ignore]

            return pyarrow.table(columns)
        except ImportError:
            return self.arrays()

    def arrays(self) -> dict[str, Any]:
        """Returns the table as a dict of NumPy arrays; a number that a run does not have is NaN."""
        arrays = {}
        for name, values in self.columns.items():
            number = all(isinstance(x, (int, float, type(None))) and not isinstance(x, bool) for x in values)
            if name != "error" and number:
                arrays[name] = np.array([np.nan if x is None else x for x in values], dtype=float)
            else:
                column = np.empty(len(values), dtype=object)
                column[:] = values
                arrays[name] = column
        return arrays

    def same_results(self, other: Sweep) -> bool:
        """Whether the results of all runs are bitwise those of another sweep; times are not compared."""

        def plain(row: dict[str, Any]) -> Any:
            return {k: v for k, v in row["results"].items() if k not in TIMES}, row["warnings"], row["error"]

        return self.settings == other.settings and list(map(plain, self.rows)) == list(map(plain, other.rows))

    def __repr__(self) -> str:
        failed = sum(error is not None for error in self.errors)
        return f"<Sweep: {len(self)} runs, {failed} failed>"


def sweep(
    scene: SceneLike,
    vary: Mapping[str, Iterable[Any]] | None = None,
    *,
    points: Iterable[Mapping[str, Any]] | None = None,
    reduce: Reduce | None = None,
    series: Sequence[str] = (),
    out: SceneLike | None = None,
    client: Any = None,
    threads: int = 0,
    progress: bool = True,
) -> Sweep:
    """Runs a scene at many points: all combinations of the values in ``vary``, as ``{"cable.sling.elements": [10, 20]}``, the last key varying
    fastest, or a list of ``points``, as ``[{"cable.sling.elements": 10, "duration": 2.0}, ...]``; with both, all combinations at each point.

    ``reduce`` has functions of one's own, each from a :class:`Run` to a number, which is a result by that name; one that raises an
    exception ends the sweep. ``series`` names probes (``"hook"``) or their columns (``"hook.tension"``, vectors too), whose arrays are kept in
    :attr:`Sweep.series`: shape (samples,), (samples, 3) or (samples, columns).

    A run that fails is a row with its error; no other is lost. With ``out`` every row is written to that folder when its run ends, what is
    done there is not run again, and ``table.csv`` is written in the end; with ``reduce`` rows that lack a result of that name are run again,
    and with ``series`` all are. Runs are made by ``threads`` threads (0: all cores), or by the workers of ``client``, a
    ``dask.distributed.Client``; results are bitwise the same. Ctrl-C ends all runs after their present host step; rows that are written stay.

    Raises ``SceneError``, ``OverrideError`` or ``NoSuchKeyError`` for what all runs refuse, as a key that does not exist; ``KeyError`` for a
    series of no probe; ``InvalidValueError`` without points.
    """
    name, text = source(scene)
    settings = _points(vary, points)
    arguments = [[setting(key, value) for key, value in point.items()] for point in settings]
    folder = None if out is None else str(out)
    _lariat.sweep_check(name, text, arguments)
    kept: list[Series] | None = None
    with _Bar(progress, len(arguments), "run") as bar:
        if client is None and not reduce and not series:
            lines = _lariat.sweep_local(name, text, arguments, folder, threads=threads, progress=bar)
        else:
            job = _Job(name, text, dict(reduce or {}), tuple(series))
            lines, kept = _each(job, arguments, folder, client, threads, bar)
    if folder is not None:
        _lariat.sweep_table(lines, Path(folder))
    return Sweep(settings, [json.loads(line) for line in lines], kept)


def _points(vary: Mapping[str, Iterable[Any]] | None, points: Iterable[Mapping[str, Any]] | None) -> list[dict[str, Any]]:
    """Returns the settings of each run."""
    if vary is None and points is None:
        raise InvalidValueError("a sweep needs vary, values by key, or points, a list of settings")
    if vary is not None and not isinstance(vary, Mapping):
        raise InvalidValueError("vary is values by key, as {'cable.sling.elements': [10, 20]}; a list of settings is points")
    grid = {key: list(values) for key, values in (vary or {}).items()}
    combinations = [dict(zip(grid, values)) for values in itertools.product(*grid.values())]
    if isinstance(points, Mapping):
        raise InvalidValueError("points is a list of settings, as [{'cable.sling.elements': 10}]; a mapping of values by key is vary")
    rows = [{**point, **combination} for point in ([{}] if points is None else points) for combination in combinations]
    if not rows:
        raise InvalidValueError("a sweep needs at least one point; points, or the values of a key of vary, are empty")
    return rows


class _Job:
    """What is run at each point, here or on a worker."""

    def __init__(self, name: str, text: str, reduce: dict[str, Callable[[Run], float]], series: tuple[str, ...]) -> None:
        self.name, self.text, self.reduce, self.series = name, text, reduce, series

    def __call__(self, arguments: list[str], stop: _lariat.Stop | None = None) -> tuple[str, Series]:
        """Returns the row of a point, as JSON, and its series."""
        line, kept = _lariat.sweep_run(self.name, self.text, arguments, stop or _lariat.Stop())
        if kept is None or not (self.reduce or self.series):
            return line, {}
        summary, tables, _, recorded = kept
        run = Run(summary, Probes({key: Probe(columns, rows) for key, (columns, rows) in tables.items()}), recorded)
        row = json.loads(line)
        if row["error"] is None:
            row["results"].update({name: _number(name, function(run)) for name, function in self.reduce.items()})
        return json.dumps(row), {name: _series(run, name) for name in self.series}

    def lacks(self, line: str | None) -> bool:
        """Whether a row of a folder has to be run again."""
        if line is None or self.series:
            return True
        row = json.loads(line)
        return row["error"] is None and not all(name in row["results"] for name in self.reduce)


def _number(name: str, value: Any) -> float:
    """Returns what a function of ``reduce`` returned, if it is a number."""
    try:
        return float(value)
    except (TypeError, ValueError) as error:
        raise InvalidValueError(f"the function {name!r} of reduce returns {type(value).__name__}: it must return one number; arrays are kept by series") from error


def _series(run: Run, name: str) -> NDArray[np.float64]:
    """Returns the rows of a probe, or a column of one."""
    if name in run.probes:
        return run.probes[name].rows
    probe, _, column = name.rpartition(".")
    if probe not in run.probes:
        raise KeyError(f"no probe for the series {name!r}; there are {', '.join(run.probes) or 'none'}")
    return run.probes[probe][column]


def _each(
    job: _Job, points: list[list[str]], folder: str | None, client: Any, threads: int, bar: Any
) -> tuple[list[str], list[Series]]:
    """Runs the points that are missing on threads or a cluster; returns rows and series in the order of the points."""
    lines: list[Any] = [None] * len(points) if folder is None else _lariat.sweep_done(job.name, job.text, points, folder)
    kept: list[Series] = [{} for _ in points]
    missing = [i for i, line in enumerate(lines) if job.lacks(line)]
    done = len(points) - len(missing)

    def take(i: int, result: tuple[str, Series]) -> None:
        nonlocal done
        lines[i], kept[i] = result
        if folder is not None:
            _lariat.sweep_append(job.name, job.text, lines[i], folder)
        done += 1
        if bar is not None:
            bar(done)

    if client is not None:
        from distributed import as_completed as completed_there

        futures = client.map(job, [points[i] for i in missing], pure=False)
        place = {future.key: i for future, i in zip(futures, missing)}
        for future in completed_there(futures):  # type: ignore[no-untyped-call, unused-ignore]
            take(place[future.key], future.result())
        return lines, kept
    stop = _lariat.Stop()
    with ThreadPoolExecutor(threads or cpu_count() or 1) as pool:
        try:
            begun = {pool.submit(job, points[i], stop): i for i in missing}
            for here in as_completed(begun):
                take(begun[here], here.result())
        except BaseException:
            # Ctrl-C, or a function of the user that failed
            stop.set()
            pool.shutdown(wait=True, cancel_futures=True)
            raise
    return lines, kept
