"""The adapter for ``cosseratbench``, a benchmark of rods by others: ``cosseratbench run -s lariat``.

Quasi-static scenarios are solved by statics, without time steps: all frames but the first are the equilibrium. Others are stepped from
frame to frame; the integrator controls its error. ``preset`` chooses the fidelity and the tolerance.

Scenarios with obstacles are stepped by fidelity game, which is the one that has contact, whatever the preset; quasi-static ones with internal
damping, critical at the lowest axial mode, which cannot hold a rope that slides.
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
    """A solver of ``cosseratbench``: stretch and bending of cables, and contact with cylinders and planes; without torsion, shear and contact
    of rods with rods."""

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

        return frozenset({Capability.STRETCH, Capability.CYLINDER_CONTACT, Capability.PLANE_CONTACT})

    def settings(self, scenario: Scenario, *, n_elements: int, n_frames: int) -> dict[str, Any]:
        """The numerical choices for a run."""
        method = "statics" if scenario.quasi_static else repr(PRESETS[self.preset])
        if scenario.obstacles:
            method = "discrete-gradient"
        return {"method": method, "host_step": self._step(scenario, n_frames)[0]}

    def _step(self, scenario: Scenario, n_frames: int) -> tuple[float, int]:
        interval = scenario.duration / (n_frames - 1)
        # a host step is that of a game or shorter, as far as the error control is concerned
        steps = max(1, int(np.ceil(interval / (self.time_step_scale / 60.0))))
        return interval / steps, steps

    def run(self, scenario: Scenario, *, n_elements: int, n_frames: int) -> Trajectory:
        """Computes a scenario with this many elements per rod."""
        if scenario.self_contact or (len(scenario.rods) > 1 and scenario.obstacles):
            raise NotImplementedError("contact of rods with rods")
        cables = [self._cable(rod, scenario, n_elements) for rod in scenario.rods]
        frames = [[cable.positions] for cable in cables]
        step, steps = self._step(scenario, n_frames)
        try:
            for _ in range(n_frames - 1):
                for cable, path in zip(cables, frames):
                    if scenario.obstacles or not scenario.quasi_static:
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
            raise NotImplementedError("ends with prescribed motion twist, and this element has no torsion")
        section = lariat.Section.round(2.0 * rod.radius, rod.material.youngs_modulus, rod.material.density)
        nodes: Array = rod.nodes(n_elements)
        preset = "game" if scenario.obstacles else PRESETS[self.preset]
        effects: list[Any] = [lariat.Contact()] if scenario.obstacles else []
        if scenario.obstacles and scenario.quasi_static:
            wave_speed = float(np.sqrt(section.axial_stiffness / section.mass_per_length))
            effects.append(lariat.Damping.from_ratio(1.0, np.pi * wave_speed / rod.length))
        cable = lariat.Cable(
            nodes, section, length=rod.length, elements=n_elements, gravity=scenario.gravity, integrator=preset, effects=effects, name="rod"
        )
        cable.set_obstacles([_obstacle(obstacle, rod) for obstacle in scenario.obstacles])
        cable.set_state(np.hstack([nodes, _slopes(rod, n_elements)]), np.zeros((n_elements + 1, 6)))
        for end, at in ((End.START, "start"), (End.END, "end")):
            if rod.condition(end) is EndCondition.PINNED:
                cable.fix(at)  # type: ignore[arg-type]
            elif rod.condition(end) is EndCondition.CLAMPED:
                cable.clamp(at)  # type: ignore[arg-type]
        for load in rod.loads:
            cable.add_load(0.0 if load.at is End.START else rod.length, load.force)
        return cable


def _obstacle(obstacle: Any, rod: Rod) -> lariat.Obstacle:
    """Returns an obstacle; of the friction of two things that touch the larger applies."""
    friction = max(obstacle.friction, rod.friction)
    if obstacle.kind == "plane":
        return lariat.Obstacle.half_space(obstacle.unit_normal, position=obstacle.point, friction=friction)
    if obstacle.kind != "cylinder":
        raise NotImplementedError(f"contact with a {obstacle.kind}")
    # the smallest rotation that takes y to the axis, of which either direction will do
    x, y, z = obstacle.unit_axis * (1.0 if obstacle.unit_axis[1] >= 0.0 else -1.0)
    rotation = np.array([z, 0.0, -x, 1.0 + y])
    half, at = obstacle.length / 2, obstacle.center
    return lariat.Obstacle.cylinder(half, obstacle.radius, position=at, rotation=rotation / np.linalg.norm(rotation), friction=friction)


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
