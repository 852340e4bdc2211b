"""Recordings of what a program steps itself: arrays, CSV, the animated page."""

from __future__ import annotations

import csv
import html
import io
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from os import PathLike
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lariat_cables import _lariat
from lariat_cables._lariat import Cable, CoSimulation, World
from lariat_cables.errors import Error
from lariat_cables.scenes import Probe

Array = NDArray[np.float64]
Recorded = Union[World, Cable, CoSimulation, Sequence[Cable]]

_CABLE = ("s", "x", "y", "z", "vx", "vy", "vz", "tension")
_BODY = ("x", "y", "z", "qx", "qy", "qz", "qw")


class Track:
    """The samples of a cable or a body: ``track.t``, and columns as arrays, vectors by their names.

    A cable has ``position``, ``velocity`` (samples, nodes, 3), ``tension`` and ``arc_length`` (samples, nodes), and as lists of arrays if the number of
    its nodes changes; a body ``position`` (samples, 3) and ``rotation`` (samples, 4), x, y, z, w.
    """

    def __init__(self, columns: tuple[str, ...]) -> None:
        self.columns = columns
        """What a row has."""
        self.rows: list[Array] = []
        """The numbers of each sample, shape (nodes, columns) or (columns,)."""
        self._times: list[float] = []

    def _add(self, time: float, row: Array) -> None:
        self._times.append(time)
        self.rows.append(row)

    @property
    def t(self) -> Array:
        """Times of the samples in s."""
        return np.array(self._times)

    def _of(self, first: int, last: int) -> Any:
        parts = [row[..., first:last] if last - first > 1 else row[..., first] for row in self.rows]
        return np.array(parts) if len({part.shape for part in parts}) < 2 else parts

    @property
    def position(self) -> Any:
        """Positions in m."""
        first = self.columns.index("x")
        return self._of(first, first + 3)

    def __getattr__(self, name: str) -> Any:
        found = {"velocity": ("vx", 3), "tension": ("tension", 1), "arc_length": ("s", 1), "rotation": ("qx", 4)}.get(name)
        if found is None or found[0] not in self.columns:
            raise AttributeError(f"no {name!r} here; there are {', '.join(self.columns)}")
        first = self.columns.index(found[0])
        return self._of(first, first + found[1])

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        return f"<Track: {len(self)} samples of {', '.join(self.columns)}>"

    def _lines(self) -> Iterator[Iterable[Any]]:
        nodes = self.columns is _CABLE
        yield ["t", *(["node"] if nodes else []), *self.columns]
        for time, row in zip(self._times, self.rows):
            if nodes:
                yield from ([repr(time), node, *map(repr, values.tolist())] for node, values in enumerate(row))
            else:
                yield [repr(time), *map(repr, row.tolist())]


class Recording:
    """What ``record`` returns: ``take()`` samples, ``cables`` and ``bodies`` have the tracks; in a notebook, the animated page."""

    def __init__(self, what: Recorded, name: str, probes: Mapping[str, Callable[[], ArrayLike]]) -> None:
        self.name = name
        """Title of the page."""
        self.cables: dict[str, Track] = {}
        """Tracks by the names of the cables, a second of a name with a number."""
        self.bodies: dict[str, Track] = {}
        """Tracks by the names that a scene gave, else ``body 0``, ``body 1``, in the order of the world."""
        self._what: Any = [what] if isinstance(what, Cable) else what
        self._read = dict(probes)
        self._rows: dict[str, list[Array]] = {probe: [] for probe in self._read}
        if isinstance(what, World):
            gravity: ArrayLike = what.gravity
        else:
            gravity = self._listed()[0].gravity
        self._film = _lariat.Film(name, gravity)

    def _listed(self) -> list[Cable]:
        if isinstance(self._what, World):
            return self._what.cables
        cables = [self._what.cable] if isinstance(self._what, CoSimulation) else list(self._what)
        if not cables or not all(isinstance(cable, Cable) for cable in cables):
            raise TypeError("expected a World, a Cable, a CoSimulation or a list of cables")
        return cables

    def take(self) -> None:
        """Records the present state: once after each step, or as often as wanted. Probes are called. The page has 300 to 600 frames evenly
        spaced, whatever is recorded."""
        cables = self._listed()
        world = self._what if isinstance(self._what, World) else None
        time = world.time if world is not None else cables[0].time
        rows = {}
        for probe, read in self._read.items():
            values = np.asarray(read(), dtype=float)
            rows[probe] = np.concatenate([[time], values.ravel()])
            known = self._rows[probe]
            if known and known[-1].shape != rows[probe].shape:
                raise ValueError(f"probe {probe!r} gave {values.size} numbers, and {known[-1].size - 1} before")
        for cable, key in zip(cables, _keys(cable.name for cable in cables)):
            at = cable.arc_lengths
            samples = np.column_stack([at, cable.positions, cable.velocities, cable.sample(at).tension])
            self.cables.setdefault(key, Track(_CABLE))._add(time, samples)
        if world is not None:
            for (_, body), key in zip(world.rigid_bodies, _keys(world._body_names())):
                pose = np.concatenate([np.asarray(body.translation), np.asarray(body.rotation)])
                self.bodies.setdefault(key, Track(_BODY))._add(time, pose)
            self._film.take_world(world)
        else:
            self._film.take_cables(cables)
        for probe, row in rows.items():
            self._rows[probe].append(row)

    @property
    def probes(self) -> dict[str, Probe]:
        """What the functions gave, by name: ``probes["hook"].rows`` has the times in its first column."""
        return {name: Probe(_columns(rows), np.array(rows)) for name, rows in self._rows.items() if rows}

    def _told(self) -> list[str]:
        if isinstance(self._what, World):
            return self._what.warnings()
        return [line for cable in self._listed() for line in cable.warnings()]

    def page(self) -> str:
        """Returns the page that plays the motion, as HTML that needs no network."""
        series = [(name, probe.columns, probe.rows.ravel().tolist()) for name, probe in self.probes.items()]
        return self._film.page(series, self._told())

    def svg(self) -> str:
        """Returns the motion as an animated SVG: no script, any browser."""
        return self._film.svg()

    def save(self, folder: str | PathLike[str]) -> None:
        """Writes cables/NAME.csv (a row for each sample and node), bodies/NAME.csv, probes/NAME.csv and view.html, the page, in place
        of the files of the last recording or run.

        Raises ``InTheWayError`` for a file that Lariat did not write, or that was changed since, and ``BusyError`` while another
        program writes there; ``Error`` if nothing was recorded.
        """
        if len(self) == 0:
            raise Error("nothing was recorded: call take() after each step")
        files = [("view.html", self.page())]
        for kind, tracks in (("cables", self.cables), ("bodies", self.bodies)):
            for file, track in zip(_files(kind, tracks), tracks.values()):
                files.append((file, _csv(track._lines())))
        probes = self.probes
        for file, probe in zip(_files("probes", probes), probes.values()):
            files.append((file, _csv([probe.columns, *(map(repr, row.tolist()) for row in probe.rows)])))
        _lariat.save_files(folder, files)

    def __len__(self) -> int:
        return max((len(track) for track in (*self.cables.values(), *self.bodies.values())), default=0)

    def __repr__(self) -> str:
        return f"<Recording {self.name!r}: {len(self)} samples of {len(self.cables)} cables and {len(self.bodies)} bodies>"

    def _repr_html_(self) -> str:
        page = html.escape(self.page(), quote=True)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 600px; border: 0"></iframe>'


def _keys(names: Iterable[str]) -> list[str]:
    """Returns names of which none comes twice."""
    keys: list[str] = []
    for name in names:
        same = sum(key == name or key.startswith(f"{name} (") for key in keys)
        keys.append(f"{name} ({same + 1})" if name in keys else name)
    return keys


def _columns(rows: list[Array]) -> list[str]:
    count = rows[0].size - 1
    return ["t", *(["value"] if count == 1 else [f"value_{'xyz'[i] if count == 3 else i}" for i in range(count)])]


def _files(kind: str, names: Iterable[str]) -> list[str]:
    plain = (re.sub(r"[^-.() 0-9A-Za-z_]", "_", name).lstrip(".") or "_" for name in names)
    return [f"{kind}/{name}.csv" for name in _keys(plain)]


def _csv(rows: Iterable[Iterable[Any]]) -> str:
    text = io.StringIO(newline="")
    csv.writer(text).writerows(rows)
    return text.getvalue()


def record(what: Recorded, *, name: str = "recording", probes: Mapping[str, Callable[[], ArrayLike]] | None = None) -> Recording:
    """Returns a recording of a world, a cable, a list of cables or a co-simulation, empty until ``take`` is called.

    ``probes`` are functions without arguments that return a number or an array, always of one size: they are called at each ``take``, and plotted.

    >>> import lariat_cables as lariat
    >>> rope = lariat.Cable([[0, 0, 0], [1, 0, 0]], lariat.Section(1e5, 0.1, 0.1), fix="start", fidelity="game")
    >>> recording = lariat.record(rope, probes={"tip height": lambda: rope.positions[-1, 1]})
    >>> for _ in range(30):
    ...     recording.take()
    ...     rope.step(1 / 60)
    >>> recording.cables["cable"].position.shape
    (30, 11, 3)

    Raises ``TypeError`` for other objects.
    """
    return Recording(what, name, probes or {})
