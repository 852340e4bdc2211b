"""The adapter for ``cosseratbench``, a benchmark of rods by others: ``cosseratbench run -s lariat``.

Quasi-static scenarios are solved by statics, without time steps: all frames but the first are the equilibrium. Others are stepped from
frame to frame; the integrator controls its error. ``preset`` chooses the fidelity and the tolerance.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from cosseratbench.scenario import End, EndCondition, Rod, Scenario  # type: ignore[import-untyped, unused-ignore]
from cosseratbench.solver import Diverged  # type: ignore[import-untyped, unused-ignore]
from cosseratbench.trajectory import Trajectory  # type: ignore[import-untyped, unused-ignore]

import lariat
from lariat.types import Array, Fidelity

PRESETS: dict[str, lariat.Integrator | Fidelity] = {
    "engineering": "engineering",
    "game": "game",
    "tr-bdf2": lariat.Integrator("tr-bdf2", tolerance=1e-5),
}


class LariatSolver:
    """A solver of ``cosseratbench``: stretch and bending of cables without twist, shear or contact."""

    name = "lariat"
    backend_version = lariat.__version__

    def __init__(self, time_step_scale: float = 1.0, preset: str = "engineering") -> None:
        if preset not in PRESETS:
            raise ValueError(f"unknown preset {preset!r}; expected {', '.join(PRESETS)}")
        self.preset = preset
        self.time_step_scale = time_step_scale

    @property
    def capabilities(self) -> frozenset[Any]:
        """What the solver models."""
        from cosseratbench.solver import Capability  # type: ignore[import-untyped, unused-ignore]

        return frozenset({Capability.STRETCH})

    def settings(self, scenario: Scenario, *, n_elements: int, n_frames: int) -> dict[str, Any]:
        """The numerical choices for a run."""
        method = "statics" if scenario.quasi_static else repr(PRESETS[self.preset])
        return {"method": method, "host_step": self._step(scenario, n_frames)[0]}

    def _step(self, scenario: Scenario, n_frames: int) -> tuple[float, int]:
        interval = scenario.duration / (n_frames - 1)
        # a host step is that of a game or shorter, as far as the error control is concerned
        steps = max(1, int(np.ceil(interval / (self.time_step_scale / 60.0))))
        return interval / steps, steps

    def run(self, scenario: Scenario, *, n_elements: int, n_frames: int) -> Trajectory:
        """Computes a scenario with this many elements per rod."""
        if scenario.obstacles or scenario.self_contact:
            raise NotImplementedError("contact of rods")
        cables = [self._cable(rod, scenario, n_elements) for rod in scenario.rods]
        frames = [[cable.positions] for cable in cables]
        step, steps = self._step(scenario, n_frames)
        try:
            for _ in range(n_frames - 1):
                for cable, path in zip(cables, frames):
                    if not scenario.quasi_static:
                        cable.step(step, steps=steps)
                    elif len(path) == 1:
                        cable.equilibrium()
                    path.append(cable.positions)
        except lariat.Error as error:
            raise Diverged(str(error), error.time) from error
        paths = [np.stack(path) for path in frames]
        directors = [_directors(path, np.asarray(rod.normal, float)) for rod, path in zip(scenario.rods, paths)]
        return Trajectory(np.linspace(0.0, scenario.duration, n_frames), tuple(paths), tuple(directors))

    def _cable(self, rod: Rod, scenario: Scenario, n_elements: int) -> lariat.Cable:
        if rod.start_motion is not None or rod.end_motion is not None:
            raise NotImplementedError("ends with prescribed motion: they twist")
        section = lariat.Section.round(2.0 * rod.radius, rod.material.youngs_modulus, rod.material.density)
        nodes: Array = rod.nodes(n_elements)
        preset = PRESETS[self.preset]
        cable = lariat.Cable(
            nodes, section, length=rod.length, elements=n_elements, gravity=scenario.gravity, integrator=preset, name="rod"
        )
        cable.set_state(np.hstack([nodes, _slopes(rod, n_elements)]), np.zeros((n_elements + 1, 6)))
        for end, at in ((End.START, "start"), (End.END, "end")):
            if rod.condition(end) is EndCondition.PINNED:
                cable.fix(at)  # type: ignore[arg-type]
            elif rod.condition(end) is EndCondition.CLAMPED:
                cable.clamp(at)  # type: ignore[arg-type]
        for load in rod.loads:
            cable.add_load(0.0 if load.at is End.START else rod.length, load.force)
        return cable


def _slopes(rod: Rod, n_elements: int) -> Array:
    """Slopes dr/ds at the nodes: central differences of the centre line where it has points beside the node, one-sided at the ends."""
    fine = max(1, 400 // n_elements) * n_elements
    points: Array = rod.nodes(fine)
    h = rod.length / fine
    gradient: Array = np.gradient(points, h, axis=0, edge_order=2 if fine > 1 else 1)
    return gradient[:: fine // n_elements]


def _directors(path: Array, normal: Array) -> Array:
    """Returns the normal, carried along the elements of each frame by the smallest rotation from one tangent to the next: untwisted."""
    tangents = np.diff(path, axis=1)
    tangents /= np.linalg.norm(tangents, axis=2, keepdims=True)
    directors = np.empty_like(tangents)
    first = normal - (tangents[:, 0] @ normal)[:, None] * tangents[:, 0]
    directors[:, 0] = first / np.linalg.norm(first, axis=1, keepdims=True)
    for i in range(1, tangents.shape[1]):
        a, b, d = tangents[:, i - 1], tangents[:, i], directors[:, i - 1]
        share = np.sum(b * d, axis=1) / (1.0 + np.sum(a * b, axis=1))
        directors[:, i] = d - share[:, None] * (a + b)
    return directors
