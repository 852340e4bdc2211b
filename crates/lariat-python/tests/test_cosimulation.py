"""Co-simulation: forces on prescribed ends, momentum, impedance against beam theory, MuJoCo."""

from __future__ import annotations

import pickle
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import lariat_cables as lariat
from lariat_cables import errors
from lariat_cables.exchange import EndMotion, Exchange
from lariat_cables.types import Fidelity

sys.path.insert(0, str(Path(__file__).parents[1] / "examples"))

EA, EI, MASS, LENGTH = 1e5, 40.0, 0.5, 2.0


def straight(**arguments: object) -> lariat.Cable:
    section = lariat.Section(EA, EI, MASS)
    return lariat.Cable([[0, 0, 0], [LENGTH, 0, 0]], section, elements=8, **arguments)  # type: ignore[arg-type]


def test_an_end_at_rest_carries_half_of_a_hanging_cable() -> None:
    """After it has settled, the forces of both ends add up to the weight (statics)."""
    cable = lariat.Cable([[0, 0, 0], [1.5, 0, 0]], lariat.Section(1e4, 0.01, 0.3), length=2.0, fix="start", effects=lariat.Damping(0.05, 0.05))
    coupling = lariat.CoSimulation(cable)
    coupling.attach("end", [1.5, 0.2, 0])
    for _ in range(600):
        forces = coupling.step(1 / 60, [[1.5, 0.2, 0]])
    assert forces.force[0, 1] == pytest.approx(-0.5 * 0.3 * 2.0 * 9.81, rel=1e-3)
    assert forces.moment[0] == pytest.approx(np.cross([0, -0.2, 0], forces.force[0]), abs=1e-12)
    assert abs(forces.work[0]) < 1e-12


def defect(fidelity: Fidelity, moving: float) -> float:
    """Returns the momentum in shares of weight x time that is in neither the bodies nor the cable, for ends that accelerate smoothly."""
    cable = straight(fidelity=fidelity)
    coupling = lariat.CoSimulation(cable)
    coupling.attach("start", [0, 0, 0])
    coupling.attach("end", [2.0, 0, 0], clamp=True)
    dt, steps, before, impulse = 1 / 400, 80, cable.momentum().linear, np.zeros(3)
    for k in range(1, steps + 1):
        t = k * dt
        a = moving * 0.2 * np.sin(3 * t) ** 2
        forces = coupling.step(
            dt,
            [[moving * 0.1 * np.sin(5 * t) ** 2, 0, 0], [2.0 - moving * 0.2 * t**2, moving * 0.2 * t**2, moving * 0.1 * t**2]],
            [[0, 0, 0, 1], [0, 0, np.sin(a / 2), np.cos(a / 2)]],
            [[moving * 0.5 * np.sin(10 * t), 0, 0], [-moving * 0.4 * t, moving * 0.4 * t, moving * 0.2 * t]],
            [[0, 0, 0], [0, 0, moving * 0.6 * np.sin(6 * t)]],
        )
        impulse += dt * forces.force.sum(axis=0)
    weight = MASS * LENGTH * 9.81 * steps * dt
    lost = impulse - [0, -weight, 0] + cable.momentum().linear - before
    return float(np.abs(lost).max()) / weight


@pytest.mark.parametrize("fidelity", ["game", "engineering", "reference"])
@pytest.mark.parametrize("moving", [0.0, 1.0, 4.0])
def test_impulses_are_what_the_cable_loses(fidelity: Fidelity, moving: float) -> None:
    """Momentum: J on the bodies = weight x time - change of the cable's momentum (Newton), to rounding."""
    assert defect(fidelity, moving) < 1e-10


def snatched(fidelity: Fidelity, dt: float, turn: float) -> float:
    """Returns the largest momentum, in shares of weight x time, that is in neither the bodies nor the cable while its ends move by 0.2 m within
    0.2 s and the clamped one turns by an angle (rad), from rest to rest by the polynomial of least jerk, and rest for 0.1 s."""
    cable, duration = straight(fidelity=fidelity), 0.2
    coupling = lariat.CoSimulation(cable)
    coupling.attach("start", [0, 0, 0])
    coupling.attach("end", [2.0, 0, 0], clamp=True)
    before, impulse, largest = cable.momentum().linear, np.zeros(3), 0.0
    for k in range(1, round(1.5 * duration / dt) + 1):
        x = min(k * dt / duration, 1.0)
        s, v = x**3 * (10 - 15 * x + 6 * x**2), 30 * x**2 * (1 - x) ** 2 / duration
        forces = coupling.step(
            dt,
            [[0.1 * s, 0, 0], [2.0 - 0.2 * s, 0.2 * s, 0.1 * s]],
            [[0, 0, 0, 1], [0, 0, np.sin(turn * s / 2), np.cos(turn * s / 2)]],
            [[0.1 * v, 0, 0], [-0.2 * v, 0.2 * v, 0.1 * v]],
            [[0, 0, 0], [0, 0, turn * v]],
        )
        impulse += dt * forces.force.sum(axis=0)
        lost = impulse + [0, MASS * LENGTH * 9.81 * k * dt, 0] + cable.momentum().linear - before
        largest = max(largest, float(np.abs(lost).max()))
    return largest / (MASS * LENGTH * 9.81 * duration)


@pytest.mark.parametrize("fidelity", ["game", "engineering"])
def test_snatched_ends_give_all_of_the_momentum(fidelity: Fidelity) -> None:
    """At any step length, with and without a clamped end that turns."""
    for n in (150, 400, 1600):
        for turn in (0.0, 0.2, 1.5):
            assert snatched(fidelity, 1 / n, turn) < 1e-10


@pytest.mark.parametrize("fidelity, bound", [("game", 1e-3), ("engineering", 1e-10)])
def test_moments_on_the_bodies_are_the_angular_momentum_that_the_cable_loses(fidelity: Fidelity, bound: float) -> None:
    """About the origin, without gravity, from the forces and moments on the reference points; the discrete gradient keeps angular momentum but for
    the numerical dissipation of bending."""
    random, dt = np.random.default_rng(5), 1 / 300
    cable = straight(fidelity=fidelity, gravity=[0, 0, 0])
    coupling = lariat.CoSimulation(cable)
    places = np.array([[-0.1, 0.1, 0.0], [2.1, 0.0, 0.2]])
    coupling.attach("start", places[0])
    coupling.attach("end", places[1], clamp=True)
    angle, left, size, before = 0.0, np.zeros(3), 0.0, cable.momentum().angular
    for _ in range(20):
        new, angle = places + random.uniform(-3, 3, (2, 3)) * dt, angle + random.uniform(-6, 6) * dt
        turn = [0, 0, np.sin(angle / 2), np.cos(angle / 2)]
        forces = coupling.step(dt, new, [turn, turn])
        about = np.cross(0.5 * (places + new), forces.force) + forces.moment
        places, left, size = new, left + dt * about.sum(axis=0), size + dt * float(np.abs(about).sum())
    assert np.abs(left + cable.momentum().angular - before).max() < bound * size


def test_ends_follow_their_bodies_exactly() -> None:
    cable = straight()
    coupling = lariat.CoSimulation(cable)
    coupling.attach("end", [2.0, 0.3, 0.0], [0, 0, 0, 1])
    turn = 0.4
    coupling.step(0.05, [[1.9, 0.2, 0.1]], [[0, 0, np.sin(turn / 2), np.cos(turn / 2)]])
    arm = np.array([0.3 * np.sin(turn), -0.3 * np.cos(turn), 0.0])
    assert cable.positions[-1] == pytest.approx(np.array([1.9, 0.2, 0.1]) + arm, abs=1e-9)


def test_impedance_of_long_steps_is_the_stiffness_of_a_beam() -> None:
    """Z/h^2 of a clamped straight beam for h so long that inertia vanishes: EA/L, 12 EI/L^3, 6 EI/L^2, 4 EI/L (Euler-Bernoulli)."""
    coupling = lariat.CoSimulation(straight(clamp="start", gravity=[0, 0, 0]))
    coupling.attach("end", [LENGTH, 0, 0], clamp=True)
    h = 1e3
    z = coupling.impedance(h) / h**2
    assert z == pytest.approx(z.T, rel=1e-9, abs=1e-6)
    assert z[0, 0] == pytest.approx(EA / LENGTH, rel=1e-6)
    for across, about, sign in ((1, 5, -1), (2, 4, 1)):
        assert z[across, across] == pytest.approx(12 * EI / LENGTH**3, rel=1e-4)
        assert z[about, about] == pytest.approx(4 * EI / LENGTH, rel=1e-4)
        assert z[across, about] == pytest.approx(sign * 6 * EI / LENGTH**2, rel=1e-4)
    assert z[3] == pytest.approx(np.zeros(6), abs=1e-9)


def twisted(turns: float, points: list[list[float]], **arguments: object) -> lariat.Cable:
    """A cable between two clamps, GJ = 0.02 N m^2, in equilibrium."""
    section, effects = lariat.Section(1e4, 0.03, 0.1), lariat.Torsion(0.02, initial_twist=turns)
    cable = lariat.Cable(points, section, elements=8, fidelity="game", effects=effects, clamp=["start", "end"], **arguments)  # type: ignore[arg-type]
    cable.equilibrium()
    return cable


def test_impedance_about_the_axis_is_the_torsional_stiffness() -> None:
    """Z/h^2 about the axis of a straight cable for long steps: GJ/L, between both ends the opposite."""
    z = held(twisted(0.0, [[0, 0, 0], [1, 0, 0]], gravity=[0, 0, 0])).impedance(1e3) / 1e6
    assert [z[3, 3], z[3, 9], z[9, 9]] == pytest.approx([0.02, -0.02, 0.02], rel=1e-9)


@pytest.mark.parametrize("turns", [0.6, -0.9])
@pytest.mark.parametrize("h", [1e2, 1e4])
def test_impedance_of_a_bent_and_twisted_cable_is_the_stiffness_of_its_equilibrium(turns: float, h: float) -> None:
    """Z/h^2 of long steps: by how much the force on one end of the cable in equilibrium, and its torque, differ where this end was turned about
    its axis, by central differences. The cable bears more torque than a straight one would, and is pushed together: the cable without its ends has no
    positive definite stiffness."""
    bent, d = [[0, 0, 0], [0.5, -0.2, 0.1], [1, 0, 0]], 1e-4
    cable = twisted(turns, bent)
    axes = cable.slopes[[0, -1]] / np.linalg.norm(cable.slopes[[0, -1]], axis=1)[:, None]
    z = held(cable).impedance(h) / h**2

    def pulled(turn: float) -> np.ndarray:
        other = twisted(turns + turn / (2 * np.pi), bent)
        other.equilibrium()
        return np.append(other.reactions()[-1].force, other.torsion()[0].torque)

    exact = (pulled(d) - pulled(-d)) / (2 * d)
    assert exact[3] < 0.995 * 0.02 / cable.length  # the curve gives way
    to_end = np.zeros((12, 4))
    to_end[6:9, :3], to_end[9:, 3] = np.eye(3), axes[1]
    # forces of 1 N/m and moments of 1 N m/rad, as both are here
    assert to_end.T @ z @ to_end[:, 3] == pytest.approx(exact, rel=1e-3, abs=1e-3 * exact[3])
    assert axes[0] @ z[3:6, 9:] @ axes[1] == pytest.approx(-exact[3], rel=1e-3)


def held(cable: lariat.Cable) -> lariat.CoSimulation:
    """Both ends clamped to bodies of the host."""
    coupling = lariat.CoSimulation(cable)
    for at, node in (("start", 0), ("end", -1)):
        coupling.attach(at, cable.positions[node], clamp=True)  # type: ignore[arg-type]
    return coupling


def test_a_disc_of_a_host_is_a_torsional_pendulum() -> None:
    """A disc that the host turns at the end of a straight cable: sqrt(GJ/(L I)), less (w h)^2/12 = 3e-5 by the trapezoidal rule of the host. The
    linear prediction is right: a step takes two trials."""
    inertia, dt, angle, spin, most = 4e-3, 1 / 120, 0.5, 0.0, 0
    section, effects = lariat.Section(1e4, 0.03, 0.1), lariat.Torsion(0.02)
    cable = lariat.Cable([[0, 0, 0], [1, 0, 0]], section, elements=4, fidelity="game", effects=effects, clamp="start", gravity=[0, 0, 0])
    coupling = lariat.CoSimulation(cable)
    coupling.attach("end", [1, 0, 0], clamp=True)
    exchange = Exchange(coupling)

    def at(turned: float) -> list[list[float]]:
        return [[np.sin(turned / 2), 0.0, 0.0, np.cos(turned / 2)]]

    # the host turns the disc out, and lets it go at rest
    coupling.step(0.5, [[1, 0, 0]], at(angle))
    coupling.step(dt, [[1, 0, 0]], at(angle))
    assert cable.torsion()[0].twist == pytest.approx(angle, rel=1e-9)
    passages = []
    for k in range(1200):

        def move(_: np.ndarray, moment: np.ndarray) -> EndMotion:
            after = spin + dt * moment[0, 0] / inertia
            turned = angle + 0.5 * dt * (spin + after)
            return EndMotion([[1, 0, 0]], at(turned), [[0, 0, 0]], [[after, 0, 0]])

        done = exchange.step(dt, move)
        before, most = angle, max(most, done.trials)
        spin = float(np.asarray(done.motion.angular_velocities)[0, 0])
        angle = 2.0 * float(np.arcsin(np.asarray(done.motion.rotations)[0, 0]))
        if before * angle < 0.0:
            passages.append(dt * (k + before / (before - angle)))
    own = np.pi * (len(passages) - 1) / (passages[-1] - passages[0])
    assert own == pytest.approx(np.sqrt(0.02 / inertia), rel=1e-4)
    assert most <= 3


def test_impedance_of_short_steps_is_inertia() -> None:
    """Both ends of a free cable that move together as h goes to 0: no more than its mass, and positive definite."""
    coupling = lariat.CoSimulation(straight())
    for at in ("start", "end"):
        coupling.attach(at, [0.0 if at == "start" else LENGTH, 0, 0])  # type: ignore[arg-type]
    z = coupling.impedance(1e-6)
    together = np.zeros(12)
    together[[0, 6]] = 1.0
    assert 0.0 < together @ z @ together < MASS * LENGTH
    assert np.linalg.eigvalsh(z).min() > -1e-12


def test_impedance_predicts_how_impulses_change() -> None:
    """dJ = -Z dv, against the difference of two steps of one implicit Euler-like step (TR-BDF2, one step), along the cable: within the
    difference of the two methods, a third."""
    h, dv = 1 / 500, 1e-3
    integrator = lariat.Integrator("tr-bdf2", substeps=1)
    coupling = lariat.CoSimulation(straight(fix="start", integrator=integrator, gravity=[0, 0, 0]))
    coupling.attach("end", [LENGTH, 0, 0])
    z = coupling.impedance(h)
    saved = coupling.to_bytes()
    impulse = []
    for v in (0.0, dv):
        other = lariat.CoSimulation.from_bytes(saved)
        forces = other.step(h, [[LENGTH + h * v, 0, 0]], velocities=[[v, 0, 0]])
        impulse.append(h * forces.end_force[0, 0])
    assert impulse[1] - impulse[0] == pytest.approx(-z[0, 0] * dv, rel=0.5)


def test_a_saved_co_simulation_continues_bitwise() -> None:
    coupling = lariat.CoSimulation(straight(fix="start"))
    coupling.attach("end", [2.0, 0.1, 0.0], clamp=True)
    coupling.step(0.01, [[2.0, 0.11, 0.0]])
    other = pickle.loads(pickle.dumps(coupling))
    for c in (coupling, other):
        c.step(0.01, [[2.0, 0.12, 0.0]])
    assert coupling.to_bytes() == other.to_bytes()


def test_a_failed_step_leaves_all_as_before() -> None:
    coupling = lariat.CoSimulation(straight(fix="start", integrator=lariat.Integrator("verlet", substeps=1)))
    coupling.attach("end", [2.0, 0.0, 0.0])
    cable = coupling.cable
    before = (cable.coordinates, cable.rates, cable.time)
    with pytest.raises(errors.StepFailedError):
        coupling.step(1.0, [[2.0, 0.0, 0.0]])
    with pytest.raises(errors.ShapeError):
        coupling.step(0.01, [2.0, 0.0, 0.0])
    with pytest.raises(errors.AttachedError):
        coupling.cable.step(0.01)
    assert (cable.coordinates == before[0]).all() and (cable.rates == before[1]).all() and cable.time == before[2]


def test_a_body_of_mujoco_swings_as_the_reference_does() -> None:
    """50 kg on the cable, an independent monolithic code (assets/scenes/payload_pendulum.toml): within 1e-2 m at steps of 1/500 s."""
    pytest.importorskip("mujoco")
    import mujoco_payload  # type: ignore[import-not-found]

    for fidelity in ("engineering", "game"):
        errors_at, _ = mujoco_payload.on_lariat(fidelity=fidelity)
        assert max(errors_at.values()) < 1e-2, (fidelity, errors_at)


def test_a_quaternion_with_w_first_is_told() -> None:
    """The identity of MuJoCo, (1, 0, 0, 0), is a half turn about x here; other rotations are read as they are, and no number as w is lost."""
    world = lariat.World()
    body = world.rigid_bodies[world.add_body(lariat.RigidBody.dynamic())]
    obstacle = lariat.Obstacle.ball(1.0, position=[0.0, -9.0, 0.0], rotation=[1.0, 0.0, 0.0, 0.0])
    calls = [
        lambda: lariat.CoSimulation(straight()).attach("end", [LENGTH, 0, 0], [1.0, 0.0, 0.0, 0.0]),
        lambda: setattr(body, "rotation", [-1.0, 0.0, 0.0, 0.0]),
        lambda: straight().set_obstacles([obstacle]),
    ]
    for call in calls:
        with pytest.warns(errors.ResultWarning, match="w is first"):
            call()
    with warnings.catch_warnings():
        warnings.simplefilter("error", errors.ResultWarning)
        body.rotation = [0.0, 1.0, 0.0, 0.0]
        assert body.rotation == pytest.approx([0.0, 1.0, 0.0, 0.0], abs=1e-6)
        lariat.CoSimulation(straight()).attach("end", [LENGTH, 0, 0], [0.6, 0.0, 0.0, 0.8])
    with pytest.raises(errors.InvalidValueError):
        body.rotation = [1.0, 1.0, 0.0, 0.0]
