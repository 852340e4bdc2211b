"""Sweeps: one scene with all combinations of values of some keys, on all cores of this machine or on a Dask cluster."""

from __future__ import annotations

import itertools
import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from lariat import _lariat
from lariat.scenes import SceneLike, _Bar, setting, source

TIMES = ("cpu_s", "wall_s", "real_time_factor")
"""Columns that differ between two runs of the same."""


class Sweep:
    """The rows of a sweep: settings, results, warnings and error of each run."""

    def __init__(self, settings: list[dict[str, Any]], rows: list[dict[str, Any]]) -> None:
        self.settings = settings
        """The values of each run by key."""
        self.rows = rows
        """By run: results by name, warnings, error (None if the run did not fail)."""

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
        keys = list(self.settings[0]) if self.settings else []
        table: dict[str, list[Any]] = {key: [s[key] for s in self.settings] for key in keys}
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
    vary: Mapping[str, Iterable[Any]],
    *,
    out: SceneLike | None = None,
    client: Any = None,
    threads: int = 0,
    progress: bool = True,
) -> Sweep:
    """Runs a scene with all combinations of the values in ``vary``, as ``{"cable.sling.elements": [10, 20]}``; the last key varies fastest.

    A run that fails is a row with its error; no other is lost. With ``out`` every row is written to that folder when its run ends, what is
    done there is not run again, and ``table.csv`` is written in the end. Runs are made by ``threads`` threads (0: all cores), or by the
    workers of ``client``, a ``dask.distributed.Client``; results are bitwise the same. Ctrl-C ends all runs after their present host step;
    rows that are written stay.

    Raises ``SceneError``, ``OverrideError`` or ``NoSuchKeyError`` for what all runs refuse, as a key that does not exist.
    """
    name, text = source(scene)
    keys = list(vary)
    settings = [dict(zip(keys, values)) for values in itertools.product(*(list(vary[key]) for key in keys))]
    points = [[setting(key, value) for key, value in point.items()] for point in settings]
    folder = None if out is None else str(out)
    _lariat.sweep_check(name, text, points)
    with _Bar(progress, len(points), "run") as bar:
        if client is None:
            lines = _lariat.sweep_local(name, text, points, folder, threads=threads, progress=bar)
        else:
            lines = _on_cluster(client, name, text, points, folder, bar)
    if folder is not None:
        _lariat.sweep_table(lines, Path(folder))
    return Sweep(settings, [json.loads(line) for line in lines])


def _on_cluster(client: Any, name: str, text: str, points: list[list[str]], folder: str | None, bar: Any) -> list[str]:
    from distributed import as_completed

    lines: list[Any] = [None] * len(points) if folder is None else _lariat.sweep_done(name, text, points, folder)
    missing = [i for i, line in enumerate(lines) if line is None]
    futures = client.map(_lariat.sweep_row, [name] * len(missing), [text] * len(missing), [points[i] for i in missing], pure=False)
    place = {future.key: i for future, i in zip(futures, missing)}
    done = len(points) - len(missing)
    for future in as_completed(futures):  # type: ignore[no-untyped-call, unused-ignore]
        line = future.result()
        lines[place[future.key]] = line
        if folder is not None:
            _lariat.sweep_append(name, text, line, folder)
        done += 1
        if bar is not None:
            bar(done)
    return lines
