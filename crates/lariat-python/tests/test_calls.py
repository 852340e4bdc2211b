"""Random sequences of calls, most of them with arguments that make no sense: each ends in a result or in an exception.

A panic of Rust would be a ``PanicException``, which is no ``Exception``, and an abort would end the process.
"""

from __future__ import annotations

import random
import threading
import zlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import lariat_cables as lariat

SEQUENCES = 1000
CALLS = 15


def number(r: random.Random) -> Any:
    return r.choice(
        [0, 1, -1, 2.0, 0.5, 1 / 60, 1e-3, -0.3, 1e-120, 1e9, 1e30, 1e300, -1e300, float("nan"), float("inf"), None, "x", True,
         10**30, np.float32(0.1), np.int64(3), [], object()]
    )  # fmt: skip


def array(r: random.Random) -> Any:
    shape = r.choice([(3,), (2, 3), (1, 3), (5, 6), (4, 6), (2,), (0,), (0, 3), (3, 3, 3), (), (1, 4), (2, 4)])
    kind = r.randrange(6)
    a = np.array([r.uniform(-2, 2) for _ in range(int(np.prod(shape)))]).reshape(shape)
    if kind == 0 and a.size:
        a.flat[r.randrange(a.size)] = r.choice([np.nan, np.inf, 1e300])
    if kind == 1:
        return a.astype(np.float32)
    if kind == 2:
        return a.tolist()
    if kind == 3:
        return r.choice([None, "abc", {}, [[1, 2], [3]], [None], a.T, a.astype(complex), b"123456"])
    return a


def place(r: random.Random) -> Any:
    return r.choice(["start", "end", 0, 1, 4, -1, 99, lariat.Node(1), lariat.Node(4), lariat.Node(99), 0.0, 1.0, 0.333, 5.0, float("nan"), None, "middle", 2**70, [], True])


def effects(r: random.Random) -> Any:
    return r.choice(
        [None, [], lariat.Damping(1e-3, 1e-3), lariat.Damping(-1.0, 0.0), lariat.Drag(1.2), lariat.Drag(float("nan")), {"drag": 3}, 7,
         [lariat.Buoyancy(1000.0), lariat.Buoyancy(1.0)], lariat.LineLoad((0, 0, 1), 3.0, 2.0), lariat.RestShape([]),
         lariat.RestShape([lariat.RestPiece(0.9, 0.5, 2.0)]), lariat.GravityScale(1e300), lariat.Contact(0.3, radius=0.01), lariat.Contact(number(r)), {"nothing": {}}, "drag"]
    )  # fmt: skip


def obstacle(r: random.Random) -> Any:
    make: list[Callable[[], Any]] = [
        lambda: lariat.Obstacle.half_space([0, 1, 0], position=[0, -0.2, 0]),
        lambda: lariat.Obstacle.half_space([number(r), number(r), 0]),
        lambda: lariat.Obstacle.ball(number(r), position=array(r)),
        lambda: lariat.Obstacle.cylinder(0.5, 0.1, rotation=r.choice([[0, 0, 0, 1], array(r)]), friction=number(r)),
        lambda: lariat.Obstacle.capsule([0, 0, 0], [number(r), 0, 0], 0.1, velocity=array(r), skin=number(r)),
        lambda: lariat.Obstacle.cuboid(0.1, number(r), 0.1, angular_velocity=[0, 0, 3], except_at=[(number(r), 1.0)]),
        lambda: None,
    ]
    return r.choice(make)()


def reel(r: random.Random) -> Any:
    return r.choice(
        [lariat.Reel(), lariat.Reel(0.3), lariat.Reel(number(r)), lariat.Reel([[0.0, number(r)], [1.0, 0.1]]), lariat.Reel(-0.3, stock=number(r)),
         lariat.Reel.brake(number(r)), lariat.Reel.free_spool(inertia=number(r)), lariat.Reel(feed=r.choice(["coil", "bag", "x"])), None, 3]
    )  # fmt: skip


def section(r: random.Random) -> Any:
    make: list[Callable[[], Any]] = [
        lambda: lariat.Section(1e5, 0.1, 0.1),
        lambda: lariat.Section.round(0.01, 1e8, 1000.0),
        lambda: lariat.Section.wire_rope(0.01),
        lambda: lariat.Section(number(r), number(r), number(r)),
        lambda: [(0.0, lariat.Section(1e5, 0.1, 0.1)), (number(r), lariat.Section(1e4, 0.0, 0.2))],
        lambda: None,
    ]
    return r.choice(make)()


def cable(r: random.Random) -> Any:
    arguments = {
        "length": number, "elements": lambda r: r.choice([1, 3, 4, 0, -1, 10**7, 2.5, None]), "fix": place, "clamp": place,
        "effects": effects, "gravity": array, "rule": lambda r: r.choice(["ST2", "G2-2", "x", "exact-none", None]),
        "fidelity": lambda r: r.choice(["game", "engineering", "reference", "best"]), "nodes_at": lambda r: [number(r)],
        "velocity": array,
    }  # fmt: skip
    chosen = r.sample(sorted(arguments), r.randrange(3))
    points = r.choice([[[0, 0, 0], [1, 0, 0]], [[0, 0, 0], [1, 0, 0], [1, 1, 0]], array(r)])
    given = {"elements": 4, "fix": "start"} | {name: arguments[name](r) for name in chosen}
    return lariat.Cable(points, section(r), **given)


def bytes_of(r: random.Random, saved: bytes) -> Any:
    broken = bytearray(saved)
    for _ in range(r.randrange(4)):
        broken[r.randrange(len(broken))] = r.randrange(256)
    # as if it had been written so: what the checksum would refuse, the reader meets
    head, _, body = saved.partition(b"\n")
    broken_body = bytes(broken[len(head) + 1 :])
    signed = head.rsplit(b" ", 1)[0] + b" %08x\n" % zlib.crc32(broken_body) + broken_body
    return r.choice([saved, bytes(broken), signed, saved[: r.randrange(len(saved))], b"", "text", None])


def call_cable(r: random.Random, c: lariat.Cable) -> Any:
    calls: list[Callable[[], Any]] = [
        lambda: c.step(r.choice([1 / 60, 1e-3, 0.0, number(r)])),
        lambda: c.equilibrium(tolerance=r.choice([1e-9, number(r)]), iterations=r.choice([50, 0, -1])),
        lambda: c.sample(r.choice([number(r), array(r)])),
        lambda: c.fix(place(r)),
        lambda: c.clamp(place(r)),
        lambda: c.release(place(r)),
        lambda: c.prescribe(place(r), array(r), number(r), array(r)),
        lambda: c.add_load(number(r), array(r), moment=array(r), ramp=number(r)),
        lambda: c.set_state(array(r), array(r)),
        lambda: c.set_rigid_motion(array(r), array(r)),
        lambda: c.read_into(array(r)),
        lambda: c.sample_flow(array(r)),
        lambda: c.insert_node(place(r)),
        lambda: c.cut(place(r)),
        lambda: c.set_obstacles(r.choice([[], [obstacle(r)], [obstacle(r), obstacle(r)], None])),
        lambda: (c.contacts(), c.contact_energy()),
        lambda: c.redefine(effects=lariat.Contact(0.3, radius=0.01), integrator="game"),
        lambda: c.add_reel(place(r), reel(r)),
        lambda: c.set_reel(place(r), reel(r)),
        lambda: c.set_reel_rate(place(r), number(r)),
        lambda: (c.reel(place(r)), c.reel_description(place(r))),
        lambda: c.remove_reel(place(r)),
        lambda: (c.set_strength(number(r), strain=number(r)), c.break_overloaded()),
        lambda: c.natural_frequencies(),
        lambda: c.damping_at_mode(number(r), r.choice([1, 0, -1, 10**6])),
        lambda: c.reactions(),
        lambda: (c.energy().total, c.momentum(), c.mesh_indicator(), c.peak_tension(), c.diagnostics(), c.effects, repr(c)),
        lambda: setattr(c, r.choice(["effects", "gravity", "time", "rule", "integrator"]), r.choice([effects(r), array(r), number(r)])),
        lambda: setattr(c, "integrator", r.choice(["game", lariat.Integrator("rkn4", stable=0.5)])),
        lambda: c.redefine(rule=r.choice([None, "mean-T1"]), effects=effects(r)),
        lambda: c.restore(bytes_of(r, c.snapshot())),
        lambda: lariat.Cable.from_bytes(bytes_of(r, c.to_bytes())).step(1e-3),
        lambda: lariat.step_all(r.choice([[c], [c, c], [], [None], None]), 1e-3, steps=r.choice([0, 1, 2, -1])),
        lambda: lariat.states(r.choice([[c], [c, c], [], [None], None])),
        lambda: lariat.step_together(r.choice([[c], [c, c], [c, c.copy()], [], [None]]), number(r), steps=r.choice([0, 1, 2, -1, None])),
        lambda: lariat.Integrator(r.choice(["esdirk4", "verlet", "x", "generalised-alpha-7"]), tolerance=number(r), substeps=r.choice([None, 3, 0, -1])),
    ]  # fmt: skip
    return r.choice(calls)()


def call_cosimulation(r: random.Random, s: lariat.CoSimulation) -> Any:
    calls: list[Callable[[], Any]] = [
        lambda: s.attach(place(r), array(r), r.choice([None, [0, 0, 0, 1], array(r)]), clamp=r.random() < 0.5),
        lambda: s.step(r.choice([1e-3, number(r)]), r.choice([s.cable.positions[-1:], array(r)]), array(r), array(r)),
        lambda: s.step(1e-3, s.cable.positions[-1:]),
        lambda: s.impedance(r.choice([1e-3, number(r)])),
        lambda: lariat.CoSimulation.from_bytes(bytes_of(r, s.to_bytes())).step(1e-3, [[1, 0, 0]]),
        lambda: call_cable(r, s.cable),
    ]
    return r.choice(calls)()


def call_world(r: random.Random, w: lariat.World, things: dict[str, list[Any]]) -> Any:
    def body() -> Any:
        return r.choice([*things["bodies"], (0, 0), (99, 1), None, (-1, 2)])

    def rope() -> Any:
        return r.choice([*things["cables"], None, lariat.Cable([[0, 0, 0], [1, 0, 0]], lariat.Section(1e5, 0.1, 0.1), elements=2)])

    def add_body() -> None:
        make = r.choice([lariat.RigidBody.dynamic, lariat.RigidBody.fixed, lariat.RigidBody.kinematic_position_based])
        shape = r.choice([lariat.Collider.cuboid(0.1, 0.1, 0.1), lariat.Collider.ball(number(r)), lariat.Collider.capsule_y(0.1, 0.1, mass=number(r))])
        things["bodies"].append(w.add_body(make(translation=r.choice([[1, 0, 0], array(r)])), [shape]))

    def attach() -> None:
        things["attachments"].append(w.attach(rope(), place(r), body(), r.choice([None, array(r)]), kind=r.choice(["ball", "clamp", "glue"]), gap=r.choice([None, 1e-3, number(r)])))  # fmt: skip

    def collider() -> Any:
        make: list[Callable[[], Any]] = [
            lambda: lariat.Collider.halfspace([0, 1, number(r)], translation=[0, -1, 0]),
            lambda: lariat.Collider.cone(number(r), 0.1, collision_groups=r.choice([(1, 1), (number(r), 2)])),
            lambda: lariat.Collider.capsule_x(0.1, 0.1, friction_combine_rule=r.choice(["max", "most"])),
            lambda: lariat.Collider.convex_hull(array(r)),
            lambda: lariat.Collider.trimesh(array(r), [[0, 1, r.choice([2, 3, 1, -1])]]),
        ]
        return r.choice(make)()

    def joint() -> None:
        make: list[Callable[[], Any]] = [
            lambda: lariat.FixedJoint.builder(local_anchor1=array(r)),
            lambda: lariat.SphericalJoint.builder(),
            lambda: lariat.RevoluteJoint.builder(r.choice([[0, 0, 1], array(r)]), limits=[number(r), 1.0]),
            lambda: lariat.PrismaticJoint.builder([1, 0, 0]).motor(number(r), 0.1, number(r), 1.0).motor_max_force(number(r)),
            lambda: lariat.RopeJoint.builder(number(r)),
            lambda: lariat.SpringJoint.builder(number(r), 10.0, number(r)),
            lambda: None,
        ]
        joints = r.choice([w.impulse_joints, w.multibody_joints])
        things.setdefault("joints", []).append(joints.insert(body(), body(), r.choice(make)()))

    calls: list[Callable[[], Any]] = [
        lambda: things.setdefault("colliders", []).append(w.add_collider(collider(), r.choice([None, body()]))),
        lambda: w.remove_collider(r.choice([*things.get("colliders", []), (99, 0), None])),
        lambda: w.collider_parent(r.choice([*things.get("colliders", []), (99, 0), "x"])),
        joint,
        lambda: r.choice([w.impulse_joints, w.multibody_joints]).remove(r.choice([*things.get("joints", []), (99, 0), None])),
        lambda: (list(w.impulse_joints), list(w.multibody_joints), len(w.impulse_joints)),
        lambda: w.cast_ray(array(r), array(r), number(r)),
        lambda: w.cast_ray_and_get_normal([0, 1, 0], array(r), number(r), exclude_rigid_body=body()),
        lambda: (w.project_point(array(r), max_dist=number(r)), w.intersect_point(array(r))),
        lambda: w.set_contact(rope(), r.choice([lariat.Contact(0.3, radius=0.01), lariat.Contact(0.3, radius=0.01, cables=True, itself=True), lariat.Contact(number(r)), None, 3])),
        lambda: w.set_contact_rules(rope(), collision_groups=r.choice([(1, 1), (number(r), 1)])),
        lambda: w.contacts(rope()),
        add_body,
        attach,
        lambda: things["cables"].append(w.add_cable(rope())),
        lambda: w.step(),
        lambda: w.step(),
        lambda: w.equilibrium(),
        lambda: w.remove_cable(rope()),
        lambda: w.remove_body(body()),
        lambda: w.cut(rope(), place(r)),
        lambda: w.set_strength(rope(), number(r), strain=r.choice([None, number(r)])),
        lambda: things["cables"].append(w.add_rope(array(r), [0, 1, 0], section(r), start_body=r.choice([None, body()]), slack=number(r)).cable),
        lambda: w.add_rope([0, 0, 0], [1, 1, 0], lariat.Section.wire_rope(0.01), strength=number(r), elements=r.choice([None, 3, 0, -1]), fidelity="game"),
        lambda: (w.cable_contacts(rope()), w.warnings()),
        lambda: things.setdefault("junctions", []).append(w.join(rope(), place(r), rope(), place(r), gap=r.choice([None, number(r)]))),
        lambda: w.leave(r.choice([*things.get("junctions", []), 7, -1]), rope()),
        lambda: w.junction(r.choice([*things.get("junctions", []), 7, -1])),
        lambda: lariat.World(max_iterations=r.choice([None, 3, 0, number(r)]), max_time=r.choice([None, number(r)])),
        lambda: w.detach(r.choice([*things["attachments"], 7, -1])),
        lambda: w.attachment(r.choice([*things["attachments"], 7, -1])),
        lambda: w.join(rope(), place(r), rope(), place(r)),
        lambda: (w.energy(), w.momentum(), w.events(), w.time, len(w.rigid_bodies), w.cables),
        lambda: setattr(w, r.choice(["dt", "gravity"]), r.choice([number(r), array(r), 1 / 60])),
        lambda: setattr(w.rigid_bodies[body()], r.choice(["translation", "linvel", "angvel", "rotation"]), array(r)),
        lambda: w.rigid_bodies[body()].apply_impulse(array(r)),
        lambda: (w.restore(bytes_of(r, w.snapshot())), lariat.World.from_bytes(bytes_of(r, w.to_bytes())).step()),
        lambda: w.add_sheave(rope(), place(r), rope(), place(r), inertia=number(r), friction=number(r), turns=r.choice([0.0, number(r)])),
        lambda: w.add_sheave(rope(), place(r), rope(), place(r)),
        lambda: (w.sheave(r.choice([0, 1, -1, None])), w.remove_sheave(r.choice([0, 1, 99]))),
        lambda: w.add_drum(rope(), place(r), body(), array(r), number(r), stock=r.choice([None, number(r)]), inertia=r.choice([0.0, number(r)])),
        lambda: w.add_drum(rope(), place(r), body(), [0, 1, 0], 0.1),
        lambda: w.remove_drum(rope(), place(r)),
        lambda: call_cable(r, rope()),
    ]
    return r.choice(calls)()


def sequence(seed: int) -> int:
    """Makes one sequence of calls, and returns how many of them raised."""
    r = random.Random(seed)
    raised = 0
    objects: list[Any] = [lariat.Cable([[0, 0, 0], [1, 0, 0]], lariat.Section(1e4, 0.05, 0.2, diameter=0.01), elements=4, fix="start")]
    world, things = lariat.World(), {"bodies": [], "cables": [], "attachments": []}
    objects += [lariat.CoSimulation(objects[0].copy())]
    objects[1].attach("end", [1, 0, 0])

    def one() -> None:
        nonlocal raised
        try:
            kind = r.randrange(8)
            if kind == 0:
                objects[0] = cable(r)
            elif kind < 4:
                call_cable(r, objects[0])
            elif kind < 6:
                call_world(r, world, things)
            else:
                call_cosimulation(r, objects[1])
        except Exception as error:
            assert type(error).__name__ != "PanicException"
            raised += 1

    if seed % 5:
        for _ in range(CALLS):
            one()
    else:
        threads = [threading.Thread(target=lambda: [one() for _ in range(CALLS)]) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    return raised


@pytest.mark.parametrize("hundred", range(SEQUENCES // 100))
def test_random_calls_end_in_results_or_exceptions(hundred: int, recwarn: pytest.WarningsRecorder) -> None:
    failures: list[BaseException] = []
    hook = threading.excepthook
    threading.excepthook = lambda arguments: failures.append(arguments.exc_value or RuntimeError())
    try:
        raised = sum(sequence(100 * hundred + i) for i in range(100))
    finally:
        threading.excepthook = hook
    assert not failures
    # most calls make no sense, and some do
    assert 0.3 * 100 * CALLS < raised < 0.95 * 120 * CALLS
