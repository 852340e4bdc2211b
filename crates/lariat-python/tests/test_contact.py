"""Contact, friction, joints and queries."""

from __future__ import annotations

import numpy as np
import pytest

import lariat_cables as lariat
from lariat_cables import Collider, Contact, Obstacle, RigidBody, errors

SECTION = lariat.Section(2e4, 1e-3, 0.1, diameter=0.01)


def test_a_rope_that_starts_in_a_floor_is_told_the_cause_and_nothing_else() -> None:
    section = lariat.Section(5e3, 2e-3, 0.04, diameter=0.008)

    def line(height: float) -> lariat.Cable:
        points = [[0, height, 0], [1.2, height, 0]]
        rope = lariat.Cable(points, section, length=1.25, elements=20, fix=["start", "end"], fidelity="game", effects=[Contact()])
        rope.set_obstacles([Obstacle.half_space([0, 1, 0])])
        return rope

    # slack, it sags by 0.16 m
    (told,) = line(0.02).warnings()
    assert "deep in obstacle 0" in told and "`lariat.Contact`" in told
    rope = line(0.02)
    rope.step(0.002, steps=100)
    assert "deep in obstacle 0" in rope.warnings()[0] and not any("elements=" in line for line in rope.warnings())
    assert "deep in obstacle 0" in lariat.CoSimulation(rope).cable.warnings()[0]
    assert line(0.2).warnings() == []


def test_a_rope_at_rest_on_a_floor_is_carried_by_it() -> None:
    rope = lariat.Cable([[0, 0.006, 0], [1, 0.006, 0]], SECTION, elements=10, fidelity="game", effects=[Contact(0.3), lariat.Damping(1e-3, 1e-3)])
    rope.set_obstacles([Obstacle.half_space([0, 1, 0])])
    rope.step(1 / 60, steps=60)
    touches = rope.contacts()
    # weight: rho A L g
    assert sum(touch.normal_force for touch in touches) == pytest.approx(0.1 * 9.81, rel=2e-2)
    assert all(touch.obstacle == 0 and touch.normal @ [0, 1, 0] == pytest.approx(1.0) for touch in touches)
    assert rope.positions[:, 1].min() == pytest.approx(0.005, abs=5e-4)
    assert rope.contact_energy() >= 0.0


@pytest.mark.parametrize("friction, slides", [(0.3, True), (0.7, False)])
def test_a_rope_on_a_slope_slides_beyond_the_angle_of_friction(friction: float, slides: bool) -> None:
    """Coulomb: on a slope of angle a it stays where friction > tan a, else it accelerates by g (sin a - friction cos a)."""
    angle = np.radians(27.0)  # tan = 0.51
    along, normal = np.array([np.cos(angle), -np.sin(angle), 0.0]), np.array([np.sin(angle), np.cos(angle), 0.0])
    # the depth at rest, so that it does not fall on it
    start = 0.005 * normal
    rope = lariat.Cable([start, start + 0.5 * along], SECTION, elements=5, fidelity="game", effects=Contact())
    rope.set_obstacles([Obstacle.half_space(list(normal), friction=friction)])
    before = rope.positions.mean(axis=0)
    time = 0.5
    rope.step(1 / 240, steps=120)
    moved = (rope.positions.mean(axis=0) - before) @ along
    expected = 0.5 * 9.81 * (np.sin(angle) - friction * np.cos(angle)) * time**2 if slides else 0.0
    assert moved == pytest.approx(expected, rel=5e-2, abs=5e-3)


def test_contact_needs_its_method_and_a_radius() -> None:
    with pytest.raises(errors.ContactMethodError):
        lariat.Cable([[0, 0, 0], [1, 0, 0]], SECTION, integrator=lariat.Integrator("esdirk4", tolerance=1e-6), effects=Contact())
    with pytest.raises(errors.MissingForEffectError):
        lariat.Cable([[0, 0, 0], [1, 0, 0]], lariat.Section(1e4, 0.1, 0.1), fidelity="game", effects=Contact())
    rope = lariat.Cable([[0, 0, 0], [1, 0, 0]], SECTION, fidelity="game", effects=Contact(0.2, radius=0.006))
    assert rope.effects["contact"] == Contact(0.2, radius=0.006)
    with pytest.raises(errors.InvalidValueError):
        rope.set_obstacles([Obstacle.ball(-1.0)])
    with pytest.raises(errors.InvalidValueError):
        rope.set_obstacles([Obstacle.ball(1.0, friction=-1.0)])
    with pytest.raises(TypeError):
        rope.set_obstacles([3])  # type: ignore[list-item]


def test_a_rope_over_a_beam_in_a_world_touches_its_collider() -> None:
    world = lariat.World()
    beam = world.add_collider(Collider.capsule_z(1.0, 0.1, friction=0.4, collision_groups=(1, 0xFFFFFFFF)))
    rope = world.add_cable(lariat.Cable([[-0.5, 0.106, 0], [0.5, 0.106, 0]], SECTION, elements=20))
    world.set_contact(rope, Contact(0.4))
    events = set()
    for _ in range(30):
        world.step()
        events |= {(event.kind, event.collider) for event in world.events()}
    touches = world.contacts(rope)
    assert ("contact started", beam) in events
    assert touches and all(touch.obstacle == beam for touch in touches)
    assert rope.positions[10, 1] > 0.1 > rope.positions[0, 1]
    assert world.collider_parent(beam) is None
    # groups that exclude each other: it falls through
    world.set_contact_rules(rope, collision_groups=(2, 2))
    for _ in range(30):
        world.step()
    assert not world.contacts(rope) and rope.positions[10, 1] < 0.0
    with pytest.raises(errors.InWorldError):
        rope.set_obstacles([])
    with pytest.raises(errors.InWorldError):
        rope.contacts()
    world.remove_collider(beam)
    with pytest.raises(errors.NoColliderError):
        world.collider_parent(beam)


def test_colliders_of_all_shapes_are_found_by_rays_and_points() -> None:
    world = lariat.World(gravity=[0, 0, 0])
    square = [[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]]
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    # top of each shape above its origin
    shapes = [
        (Collider.ball(0.5), 0.5), (Collider.cuboid(0.3, 0.4, 0.5), 0.4), (Collider.cone(0.5, 0.2), 0.5), (Collider.capsule_x(0.5, 0.2), 0.2),
        (Collider.capsule_y(0.5, 0.2), 0.7), (Collider.capsule_z(0.5, 0.2), 0.2), (Collider.cylinder(0.6, 0.2), 0.6),
        (Collider.convex_hull(0.3 * corners), 0.3), (Collider.trimesh(square, [[0, 2, 1], [0, 3, 2]]), 0.0),
    ]  # fmt: skip
    handles = [world.add_collider(shape.translation([10.0 * i, 0, 0])) for i, (shape, _) in enumerate(shapes)]
    world.step()
    for i, (_, top) in enumerate(shapes):
        # beside the edge of the triangles
        above = [10.0 * i + 1e-4, 5.0, 2e-4]
        hit = world.cast_ray_and_get_normal(above, [0, -1, 0], 100.0)
        assert hit is not None and hit[0] == handles[i]
        assert hit[1].time_of_impact == pytest.approx(5.0 - top, abs=1e-2)
        assert world.cast_ray(above, [0, -1, 0], 1.0) is None
        nearest = world.project_point(above)
        assert nearest is not None and nearest[0] == handles[i] and not nearest[1].is_inside
        assert nearest[1].point[1] == pytest.approx(top, abs=1e-2)
    assert world.intersect_point([0, 0.1, 0]) == [handles[0]]
    for bad in (Collider.convex_hull(np.zeros((3, 3))), Collider.trimesh(square, [[0, 1, 9]]), Collider.halfspace([0, 0, 0])):
        with pytest.raises(lariat.Error):
            world.add_collider(bad)


def test_a_hinge_makes_a_pendulum() -> None:
    """A point mass of arm L swings by T = 2 pi sqrt(L/g) at small angles; a ball of radius r adds 2/5 r^2 to L^2."""
    world = lariat.World(dt=1 / 480)
    length, radius, angle = 1.0, 0.1, 0.05
    pin = world.add_body(RigidBody.fixed())
    start = [length * np.sin(angle), -length * np.cos(angle), 0]
    bob = world.add_body(RigidBody.dynamic(translation=start), [Collider.ball(radius, mass=1.0)])
    hinge = world.impulse_joints.insert(pin, bob, lariat.RevoluteJoint.builder([0, 0, 1], local_anchor2=[-start[0], -start[1], 0]))
    assert world.impulse_joints.bodies_connected_by_joint(hinge) == (pin, bob) and hinge in world.impulse_joints
    period = 2 * np.pi * np.sqrt((length**2 + 0.4 * radius**2) / (9.81 * length))
    steps = round(480 * period)
    for _ in range(steps):
        world.step()
    assert world.rigid_bodies[bob].translation == pytest.approx(start, abs=0.1 * length * angle)
    world.impulse_joints.remove(hinge)
    assert len(world.impulse_joints) == 0
    with pytest.raises(errors.NoJointError):
        world.impulse_joints.remove(hinge)


def test_joints_that_make_no_sense_are_named() -> None:
    world = lariat.World()
    first, second = (world.add_body(RigidBody.dynamic(translation=[i, 0, 0]), [Collider.ball(0.1)]) for i in range(2))
    with pytest.raises(errors.BuilderError):
        world.impulse_joints.insert(first, first, lariat.SphericalJoint.builder())
    with pytest.raises(errors.NoBodyError):
        world.impulse_joints.insert(first, (99, 0), lariat.SphericalJoint.builder())
    with pytest.raises(errors.InvalidValueError):
        world.impulse_joints.insert(first, second, lariat.RevoluteJoint.builder([0, 0, 0]))
    with pytest.raises(errors.InvalidValueError):
        world.impulse_joints.insert(first, second, lariat.PrismaticJoint.builder([1, 0, 0]).limits(1.0, -1.0))
    with pytest.raises(errors.BuilderError):
        lariat.SphericalJoint.builder(limits=[0, 1])
    link = world.multibody_joints.insert(first, second, lariat.PrismaticJoint.builder([1, 0, 0]).limits(-1.0, 1.0).motor_velocity(0.1, 1.0))
    assert world.multibody_joints.bodies_connected_by_joint(link) == (first, second)
    with pytest.raises(errors.BuilderError):
        world.multibody_joints.insert(second, first, lariat.FixedJoint.builder())
    for builder in (lariat.RopeJoint.builder(2.0), lariat.SpringJoint.builder(1.0, 10.0, 0.1), lariat.FixedJoint.builder()):
        other = world.add_body(RigidBody.dynamic(translation=[0, 2, 0]), [Collider.ball(0.1)])
        world.impulse_joints.insert(first, other, builder)
    for _ in range(10):
        world.step()
    world.multibody_joints.remove(link)
    assert len(world.multibody_joints) == 0 and len(world.impulse_joints) == 3


def test_cables_that_are_stepped_together_hold_each_other() -> None:
    """A rope that is thrown down on another stops on it, and one that may not touch falls through; momentum of the pair is that of gravity,
    for both are free (Newton)."""
    section = lariat.Section.round(0.02, 1e7, 1000.0)
    for touches in (True, False):
        pair = [
            lariat.Cable(points, section, elements=6, gravity=[0, 0, 0], fidelity="game", effects=lariat.Contact(0.2, cables=touches), velocity=velocity)
            for points, velocity in (
                ([[-0.5, 0.05, 0], [0.5, 0.05, 0]], [0, 0, 0]),
                ([[0.03, -0.5, 0.05], [0.03, 0.5, 0.05]], [0, 0, -1.0]),
            )
        ]
        before = sum(cable.momentum().linear for cable in pair)
        for _ in range(20):
            lariat.step_together(pair, 1 / 100)
        height = [cable.sample(0.5).position[2] for cable in pair]
        assert (height[1] > height[0]) == touches
        assert sum(cable.momentum().linear for cable in pair) == pytest.approx(before, abs=1e-6)
        assert (np.abs(before[2] - pair[1].momentum().linear[2]) > 0.1 * np.abs(before[2])) == touches
    with pytest.raises(lariat.errors.EmptyIslandError):
        lariat.step_together([], 0.01)
    with pytest.raises(lariat.errors.DuplicateCableError):
        lariat.step_together([pair[0], pair[0]], 0.01)


@pytest.mark.parametrize("restitution", [0.0, 0.4, 0.8])
def test_a_bar_bounces_by_newtons_law(restitution: float) -> None:
    bar = lariat.Cable([[0, 0.105, 0], [0.4, 0.105, 0]], lariat.Section(1e6, 1e3, 0.1, diameter=0.01), elements=2, fidelity="game", effects=Contact())
    bar.set_obstacles([Obstacle.half_space([0, 1, 0], friction=0.0, restitution=restitution)])
    bar.set_rigid_motion([0, -2, 0])
    before, speed = 0.0, 0.0
    for _ in range(60):
        bar.step(1 / 240)
        speed = bar.velocities[:, 1].mean()
        if speed > before:
            break
        before = speed
    assert 2.0 < -before < 2.6
    # the rest of an impact that is inelastic; gravity changes the velocity by 0.04 m/s in each step
    bar.step(1 / 240)
    assert bar.velocities[:, 1].mean() == pytest.approx(-restitution * before, abs=0.09)
    with pytest.raises(errors.InvalidValueError):
        bar.set_obstacles([Obstacle.half_space([0, 1, 0], restitution=0.9)])
