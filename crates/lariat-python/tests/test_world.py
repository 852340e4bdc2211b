"""A world: the payload pendulum against its reference, attachments, breaking, snapshots."""

from __future__ import annotations

import pickle
import warnings
from collections.abc import Callable

import numpy as np
import pytest

import lariat_cables as lariat
from lariat_cables import Collider, RigidBody, errors


def payload(**settings: object) -> tuple[lariat.World, lariat.Cable, lariat.results.RigidBodyHandle, int]:
    """A crate of 50 kg on a cable of 2 m, released from horizontal (assets/scenes/payload_pendulum.toml)."""
    world = lariat.World(**settings)  # type: ignore[arg-type]
    crate = world.add_body(RigidBody.dynamic(translation=[2.0, -0.1, 0.0]).can_sleep(False), [Collider.cuboid(0.1, 0.1, 0.1).mass(50.0)])
    cable = lariat.Cable([[0, 0, 0], [2, 0, 0]], lariat.Section.square(0.01, 1e9, 4000.0), fix="start", name="sling")
    sling = world.add_cable(cable)
    hook = world.attach(sling, "end", crate, [0.0, 0.1, 0.0])
    return world, sling, crate, hook


def test_the_crate_swings_as_the_reference_does() -> None:
    """(1.70292, -1.21801) m after 0.5 s: an independent monolithic code; within 6e-3 m at 1/60 s."""
    world, sling, crate, hook = payload()
    for _ in range(30):
        world.step()
    assert np.linalg.norm(world.rigid_bodies[crate].translation[:2] - [1.70292, -1.21801]) < 6e-3
    reading = world.attachment(hook)
    assert np.linalg.norm(reading.gap) < 1e-4 and reading.force[1] > 0.0 and (reading.moment == 0.0).all()
    assert world.time == pytest.approx(0.5) and sling.time == pytest.approx(0.5)
    assert world.rigid_bodies[crate].mass == pytest.approx(50.0)


def test_energy_is_kept() -> None:
    world, *_ = payload(fidelity="engineering", dt=1 / 240)
    before = world.energy().total
    for _ in range(120):
        world.step()
    assert world.energy().total == pytest.approx(before, abs=1e-3 * world.energy().bodies_kinetic)


def test_a_saved_world_continues_bitwise() -> None:
    world, *_ = payload()
    for _ in range(5):
        world.step()
    others = [pickle.loads(pickle.dumps(world)), lariat.World.from_bytes(world.to_bytes())]
    for w in [world, *others]:
        for _ in range(20):
            w.step()
    assert all(w.snapshot() == world.snapshot() for w in others)


def test_a_cable_of_a_world_is_pickled_with_it_alone() -> None:
    """Beside its world it would come back as a cable of none; a copy is one by itself."""
    world, sling, *_ = payload()
    with pytest.raises(lariat.errors.InWorldError, match="pickle that"):
        pickle.dumps((world, sling))
    again = pickle.loads(pickle.dumps(world))
    again.step()
    assert again.cables[0].time > 0.0 == pickle.loads(pickle.dumps(sling.copy())).time


def test_restore_brings_a_world_back_in_place_and_it_continues_bitwise() -> None:
    """Law: after ``restore`` n steps give the bits of the first n steps; bodies, cables and attachments are those of before."""
    world, sling, crate, hook = payload()
    for _ in range(5):
        world.step()
    saved, start = world.snapshot(), world.rigid_bodies[crate].translation
    runs = []
    for _ in range(2):
        for _ in range(20):
            world.step()
        runs.append((world.snapshot(), sling.to_bytes(), world.attachment(hook).force.tobytes()))
        assert np.linalg.norm(world.rigid_bodies[crate].translation - start) > 0.1
        late = world.add_cable(sling.copy())
        assert world.restore(saved) is None  # type: ignore[func-returns-value]
        assert np.array_equal(world.rigid_bodies[crate].translation, start) and len(world.cables) == 1
        with pytest.raises(lariat.errors.NoCableError):
            late.energy()
    assert runs[0] == runs[1]
    with pytest.raises(lariat.errors.FormatError):
        world.restore(saved[:-1])
    assert world.snapshot() == saved


def test_statics_put_the_crate_below_the_pin() -> None:
    world, sling, crate, _ = payload()
    assert world.equilibrium()
    stretch = 50.0 * 9.81 / (1e9 * 1e-4) * 2.0
    assert world.rigid_bodies[crate].translation == pytest.approx([0.0, -2.1 - stretch, 0.0], abs=1e-3)
    assert sling.sample(1.0).tension == pytest.approx(50.0 * 9.81, rel=2e-2)


def test_an_overloaded_cable_breaks_and_says_where() -> None:
    world, sling, _, _ = payload()
    world.set_strength(sling, 100.0)
    events: list[lariat.results.Event] = []
    for _ in range(60):
        world.step()
        events += [event for event in world.events() if event.kind == "broken"]
    assert events and events[0].tension is not None and events[0].tension > 100.0
    assert events[0].rest is not None and events[0].cable is not None and len(world.cables) > 1


def test_bodies_are_read_and_changed() -> None:
    world = lariat.World(gravity=[0, 0, 0])
    handle = world.add_body(RigidBody.dynamic(linvel=[1, 0, 0]), [Collider.ball(0.5, density=1000.0)])
    body = world.rigid_bodies[handle]
    assert body.mass == pytest.approx(1000.0 * 4 / 3 * np.pi * 0.125, rel=1e-5)
    body.apply_impulse([0, body.mass, 0])
    world.step()
    assert body.linvel == pytest.approx([1, 1, 0], rel=1e-5)
    body.rotation = [0, 0, np.sin(0.1), np.cos(0.1)]
    assert body.rotation == pytest.approx([0, 0, np.sin(0.1), np.cos(0.1)], abs=1e-6)
    assert len(world.rigid_bodies) == 1 and handle in world.rigid_bodies
    world.remove_body(handle)
    assert len(world.rigid_bodies) == 0


def test_bodies_are_moved_with_their_cables() -> None:
    """Bodies that were moved and turned about the vertical go on as those that were not, moved and turned."""

    def swing(moves: bool) -> tuple[np.ndarray, np.ndarray]:
        world = lariat.World()
        hook = world.add_body(RigidBody.fixed(), [Collider.ball(0.01)])
        crate = world.add_body(RigidBody.dynamic(translation=[1.5, -1.0, 0.5]).can_sleep(False), [Collider.cuboid(0.1, 0.1, 0.1).mass(20.0)])
        rope = world.add_cable(lariat.Cable([[0, 0, 0], [1.5, -1.0, 0.5]], lariat.Section.square(0.01, 1e9, 4000.0), name="rope"))
        world.attach(rope, "start", hook, [0, 0, 0])
        world.attach(rope, "end", crate, [0, 0, 0])
        for step in range(60):
            if moves and step == 30:
                with pytest.raises(errors.HeldInMoveError) as held:
                    world.move_bodies([crate], translation=by)
                assert held.value.cable == "rope"
                world.move_bodies([hook, crate], translation=by, rotation=[0, angle, 0])
            world.step()
        return rope.positions, world.rigid_bodies[crate].translation

    by, angle = np.array([3.0, 1.0, -2.0]), 0.7
    turn = np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])
    (moved, crate), (stayed, other) = swing(True), swing(False)
    assert np.abs(moved - (stayed @ turn.T + by)).max() < 1e-4
    assert np.abs(crate - (turn @ other + by)).max() < 1e-4


def test_what_does_not_fit_is_named() -> None:
    world, sling, crate, hook = payload()
    alone = lariat.Cable([[0, 0, 0], [1, 0, 0]], lariat.Section(1e3, 0.1, 0.1))
    with pytest.raises(errors.OtherWorldError):
        world.attach(alone, "end", crate)
    with pytest.raises(errors.GapTooLongError) as gap:
        world.attach(sling, "start", crate, [0, 0, 0])
    assert gap.value.cable == "sling" and gap.value.__dict__["gap"] > 1.0
    with pytest.raises(errors.AlreadyAttachedError):
        world.attach(sling, "end", crate)
    with pytest.raises(errors.InWorldError):
        sling.step(0.1)
    with pytest.raises(errors.NoBodyError):
        world.rigid_bodies[(9, 9)]  # type: ignore[index]
    with pytest.raises(errors.InvalidValueError):
        world.dt = float("nan")
    with pytest.raises(errors.BuilderError):
        Collider.cuboid(1, 1, 1, colour=3)
    world.detach(hook)
    with pytest.raises(errors.NoAttachmentError):
        world.attachment(hook)
    removed = world.remove_cable(sling)
    removed.step(0.01)
    with pytest.raises(errors.NoCableError):
        sling.positions  # noqa: B018


def test_the_first_warning_of_each_kind_goes_through_warnings() -> None:
    """Two coarse ropes, of E in GPa: a line for a kind, in the names of Python, and no second one."""
    world = lariat.World(fidelity="engineering")
    for x in (0.0, 1.0):
        section = lariat.Section.round(0.01, 0.1, 1100.0)
        world.add_cable(lariat.Cable([[x, 0, 0], [x, 0, 1]], section, elements=2, fix="start"))
    with pytest.warns(errors.ResultWarning) as told:
        world.step()
    texts = [str(warning.message) for warning in told]
    assert sum("Young's modulus" in text for text in texts) == 1, texts
    with warnings.catch_warnings():
        warnings.simplefilter("error", errors.ResultWarning)
        world.step()
    def limp() -> lariat.Cable:
        section = lariat.Section(1e5, 0.01, 0.1)
        return lariat.Cable([[0, 0, 0], [2, 0, 0]], section, length=2.5, elements=2, fix="start")

    def coarse(steps: Callable[[], object]) -> int:
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            steps()
        return sum("`elements=" in str(line.message) for line in told)

    rope = limp()
    assert coarse(lambda: rope.step(0.02, steps=20)) == 1
    assert coarse(lambda: rope.step(0.02, steps=20)) == 0
    assert any("`elements=" in text for text in rope.warnings()), rope.warnings()
    ropes = [limp() for _ in range(5)]
    assert coarse(lambda: lariat.step_all(ropes, 0.02, steps=20)) == 1
    assert coarse(lambda: lariat.step_together([limp(), limp()], 0.02, steps=20)) == 1
    held = lariat.CoSimulation(limp())
    held.attach("start", [0, 0, 0])
    assert coarse(lambda: [held.step(0.02, [[0, 0, 0]]) for _ in range(20)]) == 1
