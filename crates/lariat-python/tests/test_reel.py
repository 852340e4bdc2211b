"""Reels, breaking and cutting."""

from __future__ import annotations

import pickle

import pytest

import lariat_cables as lariat
from lariat_cables import Reel, errors

SECTION = lariat.Section(2e4, 1e-3, 0.2, diameter=0.01)
LOAD = 50.0


def hanging(**arguments: object) -> lariat.Cable:
    """3 m of rope that hang from a winch at the start, with a load at the end."""
    rope = lariat.Cable([[0, 0, 0], [0, -3, 0]], SECTION, elements=12, fix="start", fidelity="game", **arguments)  # type: ignore[arg-type]
    rope.add_load(3.0, [0, -LOAD, 0])
    rope.equilibrium()
    return rope


def test_a_winch_pays_out_what_it_says() -> None:
    rope = hanging(effects=lariat.Damping(1e-2, 1e-2))
    out = rope.length
    rope.add_reel("start", Reel(0.5, acceleration=1.0, stock=10.0))
    rope.step(1 / 60, steps=120)
    reading = rope.reel("start")
    assert reading is not None and reading.rate == pytest.approx(0.5)
    # 0.25 s v up to the rate by the acceleration
    assert reading.length_out - out == pytest.approx(0.5 * 2.0 - 0.5 * 0.5**2 / 1.0, abs=1e-6)
    weight = LOAD + 0.2 * 9.81 * reading.length_out
    assert reading.tension == pytest.approx(weight, rel=5e-2)
    assert reading.work < 0.0 and reading.splits > 0 and rope.elements > 12
    rope.set_reel_rate("start", 0.0)
    rope.step(1 / 60, steps=60)
    still = rope.reel("start")
    assert still is not None and still.rate == 0.0
    rope.remove_reel("start")
    assert rope.reel("start") is None and rope.length == pytest.approx(still.length_out)


def test_a_brake_slips_above_its_force_and_a_free_spool_does_not_hold() -> None:
    held, slips, free = (hanging() for _ in range(3))
    held.add_reel("start", Reel.brake(2.0 * LOAD))
    slips.add_reel("start", Reel.brake(0.5 * LOAD, stock=100.0, inertia=1.0))
    free.add_reel("start", Reel.free_spool(stock=100.0, inertia=1.0))
    for rope in (held, slips, free):
        rope.step(1 / 60, steps=30)
    rates = [reading.rate for rope in (held, slips, free) if (reading := rope.reel("start")) is not None]
    assert rates[0] == pytest.approx(0.0, abs=1e-9) and 0.0 < rates[1] < rates[2]
    slipping = slips.reel("start")
    # the motor holds with its force, and the inertia of the wheel with its own
    assert slipping is not None and slipping.force > 0.4 * LOAD


def test_a_reel_is_read_back_changed_and_saved() -> None:
    rope = hanging()
    reel = Reel([[0.0, 0.1], [1.0, -0.2]], stock=5.0, feed="bag")
    rope.add_reel("start", reel)
    assert rope.reel_description("start") == reel and rope.reel_description("end") is None
    rope.set_reel("start", Reel(0.3))
    assert rope.reel_description("start") == Reel(0.3)
    other = pickle.loads(pickle.dumps(rope))
    for cable in (rope, other):
        cable.step(1 / 60, steps=60)
    assert rope.to_bytes() == other.to_bytes()


def test_a_rest_shape_without_pieces_is_none() -> None:
    """Straight and unstretched before the first piece: a cable whose rest shape has none steps as one without."""
    plain, empty = hanging(), hanging(effects=lariat.RestShape([]))
    for rope in (plain, empty):
        rope.add_reel("start", Reel(0.3))
        rope.step(1 / 60, steps=30)
    assert plain.positions == pytest.approx(empty.positions, abs=1e-9)


def test_a_natural_curvature_goes_with_a_reel_and_pieces_are_refused() -> None:
    """What is one along the rope passes an eye; stock does not know where a piece begins."""
    curved = hanging(effects=lariat.RestShape([lariat.RestPiece(curvature=0.5)]))
    out = curved.length
    curved.add_reel("start", Reel(0.3, acceleration=1.0))
    curved.step(1 / 60, steps=30)
    reading = curved.reel("start")
    # 0.3 s up to the rate
    assert reading is not None and reading.length_out == pytest.approx(out + 0.3 * 0.5 - 0.5 * 0.3**2, abs=1e-6)
    pieces = hanging(effects=lariat.RestShape([lariat.RestPiece(), lariat.RestPiece(1.0, curvature=0.5)]))
    with pytest.raises(errors.NotWithReelError):
        pieces.add_reel("start", Reel())


def test_reels_that_cannot_be_are_named() -> None:
    rope = hanging()
    with pytest.raises(errors.ReelPlaceError):
        rope.add_reel(1.5, Reel())
    with pytest.raises(errors.ReelPlaceError):
        rope.set_reel("end", Reel())
    with pytest.raises(errors.InvalidValueError):
        rope.add_reel("start", Reel(acceleration=-1.0))
    with pytest.raises(errors.BuilderError):
        rope.add_reel("start", Reel(feed="hose"))  # type: ignore[arg-type]
    accurate = lariat.Cable([[0, 0, 0], [0, -3, 0]], SECTION, fix="start", integrator=lariat.Integrator("esdirk4", tolerance=1e-6))
    with pytest.raises(errors.ReelMethodError):
        accurate.add_reel("start", Reel.brake(10.0))


def test_a_winch_in_a_world_lifts_a_crate() -> None:
    world = lariat.World()
    mast = world.add_body(lariat.RigidBody.fixed(translation=[0, 5, 0]))
    crate = world.add_body(lariat.RigidBody.dynamic(translation=[0, 1.9, 0]), [lariat.Collider.cuboid(0.1, 0.1, 0.1, mass=20.0)])
    rope = world.add_cable(lariat.Cable([[0, 5, 0], [0, 2, 0]], SECTION, elements=12))
    world.attach(rope, "start", mast)
    world.attach(rope, "end", crate)
    assert world.equilibrium()
    before = world.rigid_bodies[crate].translation[1]
    rope.add_reel("start", Reel(-0.5, acceleration=0.5))
    for _ in range(120):
        world.step()
    reading = rope.reel("start")
    assert reading is not None and reading.length_out == pytest.approx(3.0 - (0.5 * 2.0 - 0.25), abs=1e-3)
    # the crate hangs on, and swings on its rope of EA 2e4 N
    assert world.rigid_bodies[crate].translation[1] - before == pytest.approx(0.75, abs=0.05)
    assert reading.force == pytest.approx(20.0 * 9.81, rel=0.2)


def test_a_rope_breaks_into_two_that_fall_apart_and_is_cut() -> None:
    rope = hanging()
    rope.set_strength(2.0 * LOAD)
    assert rope.break_overloaded() is None
    rope.set_strength(0.5 * LOAD)
    broken = rope.break_overloaded()
    assert broken is not None
    rest, how = broken
    assert how.cause == "tension" and how.tension > 0.5 * LOAD and 0.0 < how.arc_length < 3.0
    assert rope.length == pytest.approx(how.arc_length) and rest.length == pytest.approx(3.0 - how.arc_length)
    rest.step(1 / 60, steps=6)
    assert rest.positions[0, 1] < -how.arc_length
    other = rest.cut(0.5 * rest.length)
    assert other.length == pytest.approx(rest.length)
    with pytest.raises(errors.InvalidValueError):
        rope.set_strength(-1.0)
