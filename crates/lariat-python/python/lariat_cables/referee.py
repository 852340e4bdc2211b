"""The adapter for ``cosseratbench``, a benchmark of rods by others: ``cosseratbench run -s lariat``.

Quasi-static scenarios of rods that touch nothing are solved by statics, without time steps: all frames but the first are the equilibrium.
Others are stepped from frame to frame; the integrator controls its error. ``preset`` chooses the fidelity and the tolerance.

Scenarios with contact are stepped by fidelity game, which is the one that has contact, whatever the preset. Quasi-static ones have dissipation:

- rods that touch each other alone: that of the other adapters, proportional to mass, critical at the slowest mode; between two steps of
  dt the rates are taken times exp(-c dt). When all are at rest, the rest of the frames are that state.
- rods of which an end slides: the same; the end is clamped to a body of a thousandth of the rod's mass on a slider of a world, and the loads of the
  end are those of the body.
- rods on obstacles: internal damping, critical at the lowest axial mode, which cannot hold a rope that slides.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from cosseratbench.scenario import End, EndCondition, Rod, Scenario  # type: ignore[import-untyped, unused-ignore]
from cosseratbench.solver import Diverged  # type: ignore[import-untyped, unused-ignore]
from cosseratbench.trajectory import Trajectory  # type: ignore[import-untyped, unused-ignore]

import lariat_cables as lariat
from lariat_cables.types import Array, Fidelity, Place

ENDS: tuple[tuple[End, Place], ...] = ((End.START, "start"), (End.END, "end"))
REST = 1e-4
"""Speed below which rods are at rest, in rod lengths per second."""
PRESETS: dict[str, lariat.Integrator | Fidelity] = {
    "engineering": "engineering",
    "game": "game",
    "tr-bdf2": lariat.Integrator("tr-bdf2", tolerance=1e-5),
}


class LariatSolver:
    """A solver of ``cosseratbench``: stretch, bending and torsion of cables, contact with cylinders, planes and other rods, and friction there;
    without shear. A clamp that is turned about the rod is a motor of ``lariat.Torsion``."""

    name = "lariat"
    backend_version = lariat.__version__

    def __init__(self, time_step_scale: float = 1.0, preset: str = "engineering") -> None:
        if preset not in PRESETS:
            raise ValueError(f"unknown preset {preset!r}; expected {', '.join(PRESETS)}")
        self.preset = preset
        self.rests = False
        self.time_step_scale = time_step_scale

    @property
    def capabilities(self) -> frozenset[Any]:
        """What the solver models."""
        from cosseratbench.solver import Capability  # type: ignore[import-untyped, unused-ignore]

        has = Capability
        return frozenset({has.STRETCH, has.CYLINDER_CONTACT, has.PLANE_CONTACT, has.ROD_CONTACT, has.ROD_FRICTION})

    def settings(self, scenario: Scenario, *, n_elements: int, n_frames: int) -> dict[str, Any]:
        """The numerical choices for a run."""
        method = "statics" if scenario.quasi_static else repr(PRESETS[self.preset])
        settings: dict[str, Any] = {"method": method, "host_step": self._step(scenario, n_frames)[0]}
        if touches(scenario):
            settings |= {"method": "discrete-gradient", "contact_stiffness": _stiffness(scenario, n_elements)}
        return settings

    def _step(self, scenario: Scenario, n_frames: int) -> tuple[float, int]:
        interval = scenario.duration / (n_frames - 1)
        # a host step is that of a game or shorter, as far as the error control is concerned
        steps = max(1, int(np.ceil(interval / (self.time_step_scale / 60.0))))
        return interval / steps, steps

    def run(self, scenario: Scenario, *, n_elements: int, n_frames: int) -> Trajectory:
        """Computes a scenario with this many elements per rod."""
        if len({rod.friction for rod in scenario.rods}) > 1:
            raise NotImplementedError("the larger of two coefficients of friction of rods that touch: Lariat takes the mean")
        if scenario.quasi_static and not touches(scenario) and any(not _slides(motion) for rod in scenario.rods for motion in _motions(rod)):
            raise NotImplementedError("driven ends of rods in equilibrium that touch nothing")
        self.rests = False
        cables = [self._cable(rod, scenario, n_elements) for rod in scenario.rods]
        step, steps = self._step(scenario, n_frames)
        world = None
        if any(_slides(motion) for rod in scenario.rods for motion in _motions(rod)):
            world, cables = _on_sliders(cables, scenario, step)
        frames = [[cable.positions] for cable in cables]
        twists = [[_twist(cable)] for cable in cables]
        try:
            for _ in range(n_frames - 1):
                self._advance(cables, world, scenario, step, steps)
                for cable, path, twist in zip(cables, frames, twists):
                    path.append(cable.positions)
                    twist.append(_twist(cable))
        except lariat.Error as error:
            raise Diverged(str(error), error.time) from error
        paths, times = [np.stack(path) for path in frames], np.linspace(0.0, scenario.duration, n_frames)
        directors = [_directors(path, _normals(rod, times), np.array(twist)) for rod, path, twist in zip(scenario.rods, paths, twists)]
        return Trajectory(times, tuple(paths), tuple(directors))

    def _advance(self, cables: list[lariat.Cable], world: lariat.World | None, scenario: Scenario, step: float, steps: int) -> None:
        """Advances all rods by a frame, in the world that they are in."""
        contact = touches(scenario)
        if scenario.quasi_static and not contact and world is None:
            for cable in cables:
                if cable.time == 0.0:
                    cable.equilibrium()
                    cable.time = step
            return
        settles = scenario.quasi_static and not scenario.obstacles
        kept = np.exp(-2.0 * scenario.slowest_frequency() * step)
        driven = any(rod.start_motion or rod.end_motion for rod in scenario.rods)
        at_once = 1 if settles or driven else steps
        for _ in range(steps // at_once):
            if settles and self.rests:
                return
            before = [cable.positions for cable in cables]
            if world is None:
                for cable, rod in zip(cables, scenario.rods):
                    _drive(cable, rod, step)
            if world is not None:
                world.step()
            elif contact:
                lariat.step_together(cables, step, steps=at_once)
            else:
                for cable in cables:
                    cable.step(step, steps=at_once)
            if settles:
                for cable in cables:
                    cable.set_state(cable.coordinates, kept * cable.rates)
                ways = [float(np.abs(cable.positions - was).max()) / rod.length for cable, was, rod in zip(cables, before, scenario.rods)]
                self.rests = not driven and max(ways) < REST * step

    def _cable(self, rod: Rod, scenario: Scenario, n_elements: int) -> lariat.Cable:
        section = lariat.Section.round(2.0 * rod.radius, rod.material.youngs_modulus, rod.material.density)
        nodes: Array = rod.nodes(n_elements)
        preset, effects = PRESETS[self.preset], list[Any]()
        if touches(scenario):
            preset = "game"
            stiffness = _stiffness(scenario, n_elements)
            effects.append(lariat.Contact(rod.friction, stiffness=stiffness, cables=True, itself=scenario.self_contact))
        if scenario.quasi_static and touches(scenario):
            wave_speed = float(np.sqrt(section.axial_stiffness / section.mass_per_length))
            damping = lariat.Damping.from_ratio(1.0, np.pi * wave_speed / rod.length)
            effects.append(damping)
        if any(np.any(motion.rotation) for motion in _motions(rod)):
            preset = "game"
            effects.append(_torsion(rod, _slopes(rod, n_elements)))
        cable = lariat.Cable(
            nodes, section, length=rod.length, elements=n_elements, gravity=scenario.gravity, integrator=preset, effects=effects, name="rod"
        )
        cable.set_obstacles([_obstacle(obstacle, rod) for obstacle in scenario.obstacles])
        cable.set_state(np.hstack([nodes, _slopes(rod, n_elements)]), np.zeros((n_elements + 1, 6)))
        for end, at in ENDS:
            if rod.condition(end) is EndCondition.PINNED:
                cable.fix(at)
            elif rod.condition(end) is EndCondition.CLAMPED:
                cable.clamp(at)
        for load in rod.loads:
            if not _slides(rod.motion(load.at)):
                cable.add_load(0.0 if load.at is End.START else rod.length, load.force)
        return cable


def _motions(rod: Rod) -> list[Any]:
    """Returns the motions of the driven ends."""
    return [motion for motion in (rod.start_motion, rod.end_motion) if motion is not None]


def _slides(motion: Any) -> bool:
    """Returns whether an end of this motion, or of none, slides."""
    return motion is not None and motion.slides_along is not None


def _torsion(rod: Rod, slopes: Array) -> lariat.Torsion:
    """Returns the torsion of a rod, whose motors turn its driven ends about it."""
    spins: dict[str, Any] = {}
    for (end, at), slope in zip(ENDS, (slopes[0], slopes[-1])):
        motion = rod.motion(end)
        if motion is None or not np.any(motion.rotation):
            continue
        tangent, turned = slope / np.linalg.norm(slope), np.asarray(motion.rotation, float)
        about = turned @ tangent
        if np.abs(turned - np.outer(about, tangent)).max() > 1e-3 * np.abs(turned).max():
            raise NotImplementedError("ends that are turned about another direction than their own")
        spins[str(at)] = lariat.MotorCourse(tuple(zip(motion.times, about / (2.0 * np.pi))))
    return lariat.Torsion(rod.material.shear_modulus * 2.0 * rod.second_moment_of_area, **spins)


def _twist(cable: lariat.Cable) -> float:
    """Returns the twist in rad of a cable between its ends; 0 without torsion."""
    return sum(reading.twist for reading in cable.torsion())


def _on_sliders(cables: list[lariat.Cable], scenario: Scenario, step: float) -> tuple[lariat.World, list[lariat.Cable]]:
    """Returns a world with the rods, whose ends that slide are clamped to bodies on sliders."""
    if scenario.obstacles:
        raise NotImplementedError("ends that slide, beside obstacles")
    world = lariat.World(scenario.gravity, dt=step, sleep_speed=0.0)
    held = world.add_body(lariat.RigidBody.fixed())
    inside = [world.add_cable(cable) for cable in cables]
    for cable, rod in zip(inside, scenario.rods):
        for end, at in ENDS:
            motion = rod.motion(end)
            if motion is None:
                continue
            if not _slides(motion) or np.any(motion.displacement):
                raise NotImplementedError("ends that are led, beside ends that slide")
            place = cable.positions[0 if end is End.START else -1]
            mass = 1e-3 * rod.material.density * rod.area * rod.length
            builder = lariat.RigidBody.dynamic(translation=place, gravity_scale=0.0, can_sleep=False)
            body = world.add_body(builder, [lariat.Collider.ball(rod.radius, mass=mass, sensor=True)])
            joint = lariat.PrismaticJoint.builder(motion.axis.tolist(), local_anchor1=place, local_anchor2=[0.0, 0.0, 0.0])
            world.multibody_joints.insert(held, body, joint)
            cable.release(at)
            world.attach(cable, at, body, kind="clamp")
            for load in rod.loads:
                if load.at is end:
                    world.rigid_bodies[body].add_force(load.force)
    return world, inside


def touches(scenario: Scenario) -> bool:
    """Returns whether anything in a scenario can touch a rod."""
    return bool(scenario.obstacles) or len(scenario.rods) > 1 or scenario.self_contact


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


def _stiffness(scenario: Scenario, n_elements: int) -> float | None:
    """Returns the stiffness of contact in N/m^2: where rods may touch rods, so stiff that the weight of all of them on one element has a depth of
    a percent of a radius. None: that of Lariat."""
    if len(scenario.rods) == 1 and not scenario.self_contact:
        return None
    weight = sum(rod.material.density * rod.area * rod.length for rod in scenario.rods) * float(np.linalg.norm(scenario.gravity))
    return max(100.0 * weight / (rod.radius * rod.length / n_elements) for rod in scenario.rods) or None


def _drive(cable: lariat.Cable, rod: Rod, step: float) -> None:
    """Prescribes how driven ends move over the next step: cubics through the places and velocities of the motion at its ends."""
    for end, at in ENDS:
        motion, first = rod.motion(end), np.asarray(rod.centerline[0 if end is End.START else -1], float)
        if motion is not None:
            then = cable.time + step
            cable.prescribe(at, first + motion.pose(then)[0], step, motion.rates(then)[0])


def _slopes(rod: Rod, n_elements: int) -> Array:
    """Slopes dr/ds at the nodes: those of the centre line at its own points by differences of second order, linear between them. The directions of
    clamps are those of its ends; those of its first and last segments would tilt the clamps of a bent rod by half a segment's turn."""
    points: Array = np.asarray(rod.centerline, float)
    drawn: Array = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    arc: Array = drawn if rod.rest_arc_length is None else np.asarray(rod.rest_arc_length, float)
    gradient: Array = np.gradient(points, arc, axis=0, edge_order=2 if len(points) > 2 else 1)
    at = np.linspace(0.0, rod.length, n_elements + 1)
    return np.stack([np.interp(at, arc, component) for component in gradient.T], axis=1)


def _normals(rod: Rod, times: Array) -> Array:
    """Returns the normal at the start of a rod at some times: it turns with the start."""
    normal, motion = np.asarray(rod.normal, float), rod.start_motion
    return np.stack([normal if motion is None else motion.pose(time)[1] @ normal for time in times])


def _directors(path: Array, normals: Array, twists: Array) -> Array:
    """Returns the normal at the middles of the elements of each frame: that at the start, carried by the smallest rotation from one tangent to the
    next, and turned by its share of the twist of the frame."""
    tangents = np.diff(path, axis=1)
    tangents /= np.linalg.norm(tangents, axis=2, keepdims=True)
    directors = np.empty_like(tangents)
    first = normals - np.sum(tangents[:, 0] * normals, axis=1)[:, None] * tangents[:, 0]
    directors[:, 0] = first / np.linalg.norm(first, axis=1, keepdims=True)
    for i in range(1, tangents.shape[1]):
        a, b, d = tangents[:, i - 1], tangents[:, i], directors[:, i - 1]
        share = np.sum(b * d, axis=1) / (1.0 + np.sum(a * b, axis=1))
        directors[:, i] = d - share[:, None] * (a + b)
    angles = np.outer(twists, (np.arange(tangents.shape[1]) + 0.5) / tangents.shape[1])[:, :, None]
    return np.asarray(np.cos(angles) * directors + np.sin(angles) * np.cross(tangents, directors))
