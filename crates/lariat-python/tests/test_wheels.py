"""Sheaves and drums of a world: against the equations of rigid bodies, and saved."""

from __future__ import annotations

import math
import pickle

import pytest

import lariat_cables as lariat
from lariat_cables import Collider, FixedJoint, RevoluteJoint, RigidBody, errors

G = 9.80665


def atwood(masses: tuple[float, float], **options: float) -> tuple[lariat.World, list[lariat.results.RigidBodyHandle], int, float]:
    """Two loads on two cables that hang side by side from one point, over a sheave there; returns the mass of the rope too."""
    world, section = lariat.World(), lariat.Section(2e5, 1e-3, 0.005)
    hook = world.add_body(RigidBody.fixed(translation=[0.0, 0.0, 0.0]))
    bodies, cables = [], []
    for mass, z in zip(masses, (0.3, -0.3)):
        cable = lariat.Cable([[0, 0, 0], [0, -3, z]], section, elements=12, effects=lariat.Damping(5e-3, 0.0), fidelity="game")
        cables.append(world.add_cable(cable))
        load = world.add_body(RigidBody.dynamic(translation=[0.0, -3.1, z]).can_sleep(False), [Collider.cuboid(0.1, 0.1, 0.1).mass(mass)])
        world.attach(cables[-1], "start", hook, [0.0, 0.0, 0.0])
        world.attach(cables[-1], "end", load, [0.0, 0.1, 0.0])
        bodies.append(load)
    return world, bodies, world.add_sheave(cables[0], "start", cables[1], "start", **options), 0.005 * 2.0 * math.hypot(3.0, 0.3)


@pytest.mark.parametrize("friction", [0.0, 0.05])
def test_loads_over_a_sheave_fall_as_atwoods(friction: float) -> None:
    """T1 = k T2, k = exp(friction angle): the heavier falls with g (m1 - k m2)/(m1 + k m2), while the loads sway a little, within 5 %."""
    world, bodies, sheave, rope = atwood((3.0, 2.0), friction=friction)
    speeds = []
    for _ in range(36):
        world.step()
        speeds.append(-world.rigid_bodies[bodies[0]].linvel[1])
    # the cables hang 11 degrees apart
    angle = math.pi - 2.0 * math.atan(0.1)
    k = math.exp(friction * angle)
    measured = speeds[-1] / (36 / 60)
    assert measured == pytest.approx(G * (3.0 - k * 2.0) / (3.0 + k * 2.0 + rope), rel=5e-2)
    reading = world.sheave(sheave)
    assert abs(reading.passed) > 0.1 and (reading.lost > 0.1 if friction else abs(reading.lost) < 1e-6)


def test_a_sheave_sticks_below_its_friction_and_is_saved() -> None:
    world, bodies, sheave, _ = atwood((2.1, 2.0), friction=0.5)
    again = pickle.loads(pickle.dumps(world))
    for w in (world, again):
        for _ in range(30):
            w.step()
    assert abs(world.sheave(sheave).passed) < 1e-6
    assert again.snapshot() == world.snapshot()
    world.remove_sheave(sheave)
    with pytest.raises(errors.NoSheaveError):
        world.sheave(sheave)
    with pytest.raises(errors.NoSheaveError):
        world.sheave(7)


def test_a_load_turns_a_drum() -> None:
    """(J/R^2 + rho S + m) a = g (m + rho L), J = 1/2 M R^2: a bucket falls from a windlass that nothing holds."""
    world, radius = lariat.World(), 0.15
    drum = world.add_body(RigidBody.dynamic(translation=[radius, 0.0, 0.0]).can_sleep(False), [Collider.cylinder(0.4, radius).mass(8.0)])
    frame = world.add_body(RigidBody.fixed(translation=[radius, 0.0, 0.0]))
    world.impulse_joints.insert(frame, drum, RevoluteJoint.builder([0.0, 1.0, 0.0]).contacts_enabled(False))
    rope = world.add_cable(
        lariat.Cable([[0, 0, 0], [0, 0, 4]], lariat.Section(2e5, 0.01, 0.1), elements=8, effects=lariat.Damping(1e-2, 0.0), fidelity="game")
    )
    world.gravity = [0.0, 0.0, G]
    bucket = world.add_body(RigidBody.dynamic(translation=[0.0, 0.0, 4.0]).can_sleep(False), [Collider.ball(0.05).mass(10.0)])
    world.attach(rope, "start", frame, [-radius, 0.0, 0.0])
    world.attach(rope, "end", bucket, [0.0, 0.0, 0.0])
    world.add_drum(rope, "start", drum, [0.0, 1.0, 0.0], radius, stock=12.0)
    for _ in range(30):
        world.step()
    inertia = 0.5 * 8.0 + 0.1 * 12.0 + 10.0
    fell = world.rigid_bodies[bucket].translation[2] - 4.0
    assert fell == pytest.approx(0.5 * G * (10.0 + 0.1 * 4.3) / inertia * 0.5**2, rel=2e-2)
    reading = rope.reel("start")
    assert reading is not None and abs(world.rigid_bodies[drum].angvel[1]) == pytest.approx(reading.rate / radius, rel=1e-3)
    assert world.remove_drum(rope, "start") and not world.remove_drum(rope, "start")


def test_a_cable_runs_over_sheaves_along_it() -> None:
    """Two loads on one cable over two eyes: m1 v1' + m2 v2' = (m1 - m2) g along the rope, in which its tension is not; the parts stay one cable."""
    world = lariat.World()
    hook = world.add_body(RigidBody.fixed())
    corners = [[0, -2, 0], [0, 0, 0], [1, 0, 0], [1, -2, 0]]
    section = lariat.Section(1e5, 1e-3, 0.005)
    cable = world.add_cable(lariat.Cable(corners, section, elements=24, nodes_at=[2.0, 3.0], fidelity="game", effects=[lariat.Damping(axial=5e-3, bending=5e-3)]))
    loads = []
    for at, mass, x in (("start", 15.0, 0.0), ("end", 10.0, 1.0)):
        load = world.add_body(RigidBody.dynamic(translation=[x, -2.1, 0.0]).can_sleep(False), [Collider.cuboid(0.1, 0.1, 0.1).mass(mass)])
        world.attach(cable, at, load, [0.0, 0.1, 0.0])
        loads.append(load)
    with pytest.raises(errors.GapTooLongError):
        world.add_sheave_at(cable, 1.0, hook, [0.0, 0.0, 0.0])
    number, between = world.add_sheave_at(cable, 2.0, hook, [0.0, 0.0, 0.0])
    _, rest = world.add_sheave_at(cable, 3.0, hook, [1.0, 0.0, 0.0])
    assert [part.length for part in world.parts(rest)] == [part.length for part in (cable, between, rest)]
    speeds = []
    for _ in range(36):
        world.step()
        speeds.append([world.rigid_bodies[load].linvel[1] for load in loads])
    (first, second), (third, fourth) = speeds[11], speeds[35]
    assert 15.0 * (first - third) + 10.0 * (fourth - second) == pytest.approx(5.0 * G * 24.0 / 60.0, rel=0.01)
    assert world.sheave(number).passed < -0.1


def test_what_makes_no_wheel_is_refused() -> None:
    world, _, _, _ = atwood((1.0, 1.0))
    one, two = world.cables
    with pytest.raises(errors.ReelPlaceError):
        world.add_sheave(one, "start", two, "start")
    with pytest.raises(errors.InvalidValueError):
        world.add_sheave(one, "end", two, "end", friction=-1.0)
    fixed = world.add_body(RigidBody.fixed())
    with pytest.raises(errors.DrumBodyError):
        world.add_drum(one, "end", fixed, [0, 1, 0], 0.1)
    with pytest.raises(errors.InvalidValueError):
        world.add_drum(one, "end", fixed, [0, 0, 0], 0.1)
    drum, other = (world.add_body(RigidBody.dynamic(translation=[5.0, 0.0, z]), [Collider.ball(0.1)]) for z in (0.0, 1.0))
    world.impulse_joints.insert(drum, other, FixedJoint.builder().local_anchor1([0.0, 0.0, 1.0]))
    world.add_drum(one, "end", drum, [0, 1, 0], 0.1)
    with pytest.raises(errors.Error):
        world.step()
