"""Ropes of a world in one call, junctions, budget, warnings; reels in steps that others make; states that keep contacts."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import lariat_cables as lariat
from lariat_cables import Collider, RigidBody, errors

SECTION = lariat.Section(1e4, 0.05, 0.2, diameter=0.01)


def test_a_rope_in_one_call_carries_its_load() -> None:
    """In equilibrium the upper end carries the crate and the rope (statics)."""
    world = lariat.World()
    crate = world.add_body(RigidBody.dynamic(translation=[0, -2.1, 0]), [Collider.cuboid(0.1, 0.1, 0.1, mass=50.0)])
    free = world.add_body(RigidBody.dynamic(translation=[9, 0, 0]), [Collider.ball(0.1)])
    rope = world.add_rope([0, 0, 0], [0, -2, 0], lariat.Section.wire_rope(0.008), end_body=crate, strength=20e3, name="sling")
    assert rope.start is None and rope.end is not None and rope.cable.name == "sling" and world.warnings() == []
    found = world.equilibrium()
    assert found and found.moved == [crate] and found.held == [] and found.unattached == [free]
    weight = (50.0 + 2.0 * lariat.Section.wire_rope(0.008).mass_per_length) * 9.81
    assert rope.cable.reactions()[0].force[1] == pytest.approx(weight, rel=1e-6)
    world.set_strength(rope.cable, strain=1e-6)
    world.step()
    broken = [event for event in world.events() if event.kind == "broken"]
    assert broken and broken[0].cable is not None and broken[0].rest is not None
    for bad in ({"slack": float("nan")}, {"elements": 0}, {"strength": -1.0}, {"start_body": (99, 0)}):
        with pytest.raises(errors.Error):
            world.add_rope([0, 0, 0], [0, -2, 0], SECTION, **bad)  # type: ignore[arg-type]


def test_a_kink_lets_a_limp_rope_have_a_corner() -> None:
    """With a kink at its load a limp rope without weight hangs in two straight halves (statics); without, it is round there."""
    depth = []
    for kinked in (True, False):
        world = lariat.World(gravity=[0, 0, 0])
        section = lariat.Section(1e5, 0.0, 0.1)
        rope = world.add_rope([0, 0, 0], [4, 0, 0], section, length=5.0, elements=8).cable
        if kinked:
            rest, junction = world.add_kink(rope, 2.5)
            assert (rope.length, rest.length) == pytest.approx((2.5, 2.5))
            assert [s for _, s in world.junction(junction)] == pytest.approx([2.5, 0.0])
        rope.add_load(2.5, [0, -100, 0])
        assert world.equilibrium()
        depth.append(rope.sample(2.5).position[1])
        if not kinked:
            for where in (0.0, 5.0):
                with pytest.raises(errors.Error):
                    world.add_kink(rope, where)
    # each half carries 100/(2 sin a), sin a = 1.5/2.5
    half = 2.5 * (1 + 100 / 1.2 / 1e5)
    assert depth[0] == pytest.approx(-np.sqrt(half**2 - 4), rel=1e-5)
    assert depth[1] - depth[0] > 1e-3


def test_a_junction_is_left() -> None:
    world = lariat.World(sleep_speed=0.0)
    ropes = [world.add_rope([x, 0, 0], [0, -1, 0], SECTION).cable for x in (-1.0, 0.0, 1.0)]
    for rope in ropes:
        rope.release("end")
    tie = world.join(ropes[0], "end", ropes[1], "end")
    assert world.join(ropes[2], "end", ropes[0], "end") == tie
    assert [s for _, s in world.junction(tie)] == pytest.approx([np.sqrt(2), 1, np.sqrt(2)])
    for _ in range(5):
        world.step()
    assert ropes[2].positions[-1] == pytest.approx(ropes[0].positions[-1], abs=1e-9)
    world.leave(tie, ropes[2])
    for _ in range(30):
        world.step()
    assert np.linalg.norm(ropes[2].positions[-1] - ropes[0].positions[-1]) > 0.01
    with pytest.raises(errors.NoJunctionError):
        world.leave(7, ropes[0])
    with pytest.raises(errors.GapTooLongError):
        world.join(ropes[2], "end", ropes[0], 0.5, gap=1e-3)
    copy = pickle.loads(pickle.dumps(world))
    copy.step()
    world.step()
    assert [s for _, s in copy.junction(tie)] == [s for _, s in world.junction(tie)]
    assert all(np.array_equal(a.coordinates, b.coordinates) for a, b in zip(copy.cables, world.cables))


def test_a_budget_degrades_and_says_so() -> None:
    def kinds(**limits: float) -> set[str]:
        world = lariat.World(fidelity="engineering", **limits)  # type: ignore[arg-type]
        rope = world.add_rope([0, 0, 0], [2, 0, 0], SECTION, elements=20, fidelity="engineering").cable
        rope.release("end")
        found: set[str] = set()
        for _ in range(30):
            world.step()
            found |= {event.kind for event in world.events()}
        assert np.isfinite(rope.coordinates).all()
        return found

    assert "degraded" not in kinds() and "degraded" in kinds(max_iterations=2)
    for bad in ({"max_iterations": 1, "max_time": 1.0}, {"max_time": 0.0}, {"max_time": float("nan")}):
        with pytest.raises(errors.InvalidValueError):
            lariat.World(**bad)  # type: ignore[arg-type]


def test_cables_of_a_world_touch_each_other() -> None:
    """A rope that is dropped across a rope hangs over it; force and place are the same from both sides (Newton)."""
    world = lariat.World(sleep_speed=0.0)
    low = world.add_rope([-1, 0, 0], [1, 0, 0], SECTION).cable
    high = world.add_rope([0, 0.02, -1], [0, 0.02, 1], SECTION).cable
    for end in ("start", "end"):
        high.release(end)  # type: ignore[arg-type]
    for cable in (low, high):
        world.set_contact(cable, lariat.Contact(0.3, cables=True))
    for _ in range(24):
        world.step()
    assert high.sample(0.5 * high.length).position[1] > low.sample(0.5 * low.length).position[1]
    mine, theirs = ([*sorted(world.cable_contacts(cable), key=lambda touch: touch.normal_force)] for cable in (low, high))
    assert len(mine) == len(theirs) > 0
    for one, other in zip(mine, theirs):
        assert one.normal_force == other.normal_force > 0 and one.normal == pytest.approx(-other.normal)
        assert (one.arc_length, one.other_arc_length) == (other.other_arc_length, other.arc_length)
        assert one.friction == pytest.approx(-other.friction)


def test_velocities_that_are_set_keep_contacts() -> None:
    """A rope that lies on a rope is not let through it by a program that damps the velocities: with the same velocities nothing changes."""
    runs = []
    for touched in (False, True):
        pair = [
            lariat.Cable(points, SECTION, elements=8, fix=["start", "end"], length=1.05, fidelity="game", effects=lariat.Contact(0.0, cables=True))
            for points in ([[-0.5, 0, 0], [0.5, 0, 0]], [[0, 0.02, -0.5], [0, 0.02, 0.5]])
        ]
        for _ in range(60):
            lariat.step_together(pair, 0.01)
            if touched:
                pair[0].set_state(pair[0].coordinates, pair[0].rates)
        runs.append([cable.sample(0.525).position[1] for cable in pair])
    assert runs[1] == pytest.approx(runs[0], abs=1e-3) and runs[1][1] > runs[1][0] + 0.008


@pytest.mark.parametrize("at", ["start", "end"])
def test_a_reel_runs_in_a_co_simulation_and_together_with_others(at: str) -> None:
    """About a metre is paid out as from a cable by itself, by elements that are split, and the body stays on its end of the cable."""

    def reeling() -> lariat.Cable:
        cable = lariat.Cable([[0, 0, 0], [1, 0, 0]], SECTION, elements=4, fix="start" if at == "start" else "end", fidelity="game")
        cable.add_reel(at, lariat.Reel(0.5))  # type: ignore[arg-type]
        return cable

    alone = reeling()
    alone.fix("end" if at == "start" else "start")
    alone.step(0.01, steps=200)
    assert alone.length > 1.9 and alone.elements > 6
    cable = reeling()
    coupling = lariat.CoSimulation(cable)
    far = "end" if at == "start" else "start"
    place = np.array([1.0, 0, 0]) if far == "end" else np.zeros(3)
    coupling.attach(far, place)  # type: ignore[arg-type]
    for _ in range(200):
        forces = coupling.step(0.01, [place])
    assert cable.length == pytest.approx(alone.length, abs=1e-9) and abs(cable.elements - alone.elements) <= 1
    assert cable.positions[-1 if far == "end" else 0] == pytest.approx(place, abs=1e-12) and np.isfinite(forces.force).all()
    cable = reeling()
    other = lariat.Cable([[0, 5, 0], [1, 5, 0]], SECTION, elements=4, fix="start", fidelity="game")
    lariat.step_together([cable, other], 0.01, steps=200)
    assert cable.length == pytest.approx(alone.length, abs=1e-9) and abs(cable.elements - alone.elements) <= 1


def test_an_end_has_one_host() -> None:
    cable = lariat.Cable([[0, 0, 0], [1, 0, 0]], SECTION, elements=4, fix="start")
    first, second = lariat.CoSimulation(cable), lariat.CoSimulation(cable)
    first.attach("end", [1, 0, 0])
    with pytest.raises(errors.AlreadyAttachedError):
        second.attach("end", [1, 0, 0])
    first.step(0.01, [[1, 0, 0]])
    cable.set_state(0.9 * cable.coordinates, cable.rates)
    with pytest.raises(errors.GapTooLongError) as caught:
        first.step(0.01, [[1, 0, 0]])
    assert caught.value.gap == pytest.approx(0.1) and caught.value.cable == "cable"
