"""Torsion: twisted cables, motors, and reels on them."""

from __future__ import annotations

import math
import pickle

import pytest

import lariat_cables as lariat
from lariat_cables import Motor, MotorCourse, Reel, Torsion, errors

SECTION = lariat.Section(1e4, 0.03, 0.1, diameter=0.01)
STIFFNESS = 0.02


def straight(torsion: Torsion, **arguments: object) -> lariat.Cable:
    """1 m between two clamps, without weight."""
    points = [[0, 0, 0], [1, 0, 0]]
    return lariat.Cable(points, SECTION, elements=8, effects=torsion, gravity=[0, 0, 0], fidelity="game", **arguments)  # type: ignore[arg-type]


def test_a_twisted_cable_has_the_torque_and_the_energy_of_its_twist() -> None:
    cable = straight(Torsion(STIFFNESS, initial_twist=0.25), clamp=["start", "end"])
    (reading,) = cable.torsion()
    assert reading.nodes == (0, 8) and reading.twist == pytest.approx(math.pi / 2)
    assert reading.torque == pytest.approx(STIFFNESS * math.pi / 2)
    assert reading.twist_rate == pytest.approx(math.pi / 2)
    assert cable.energy().torsion == pytest.approx(0.5 * STIFFNESS * (math.pi / 2) ** 2)


def test_a_motor_twists_and_a_swivel_does_not_hold() -> None:
    motor = straight(Torsion(STIFFNESS, end=Motor(0.25, until=1.0)), clamp=["start", "end"])
    motor.step(1 / 60, steps=90)
    assert motor.torsion()[0].twist == pytest.approx(math.pi / 2, abs=1e-9)
    swivel = straight(Torsion(STIFFNESS, initial_twist=0.25, end="swivel"), clamp=["start", "end"])
    assert swivel.torsion() == [] and any("torsion" in text or "spin" in text for text in swivel.warnings())
    assert straight(Torsion(STIFFNESS), clamp="start", fix="end").torsion() == []


def test_a_motor_turns_an_end_by_its_course() -> None:
    """A parabola through rows of one: turns = t^2/8."""
    rows = [(t, t**2 / 8) for t in (0.0, 0.5, 1.1, 2.0)]
    cable = straight(Torsion(STIFFNESS, end=MotorCourse(rows)), clamp=["start", "end"])
    for k in range(1, 5):
        cable.step(1 / 60, steps=30)
        assert cable.torsion()[0].twist == pytest.approx(2 * math.pi * (0.5 * k) ** 2 / 8, abs=1e-9)
    assert cable.effects["torsion"].end == MotorCourse(tuple(rows))
    with pytest.raises((ValueError, errors.Error)):
        straight(Torsion(STIFFNESS, end=MotorCourse([(1.0, 0.0), (0.5, 1.0)])), clamp=["start", "end"])


def test_a_reel_keeps_the_twist_that_is_out() -> None:
    rope = lariat.Cable(
        [[0, 0, 0], [0, -2, 0]], SECTION, elements=8, effects=Torsion(STIFFNESS, initial_twist=0.25), clamp=["start", "end"], fidelity="game"
    )
    rope.add_reel("start", Reel(0.2))
    rope.step(1 / 60, steps=120)
    (reading,) = rope.torsion()
    assert rope.length > 2.2
    assert reading.torque == pytest.approx(STIFFNESS * reading.twist / rope.length)


def test_tension_of_a_stranded_rope_makes_torque() -> None:
    factor = 0.1 * 0.01
    rope = lariat.Cable(
        [[0, 0, 0], [1, 0, 0]], SECTION, elements=8, effects=Torsion(STIFFNESS, torque_per_tension=factor), clamp=["start", "end"],
        length=0.995, gravity=[0, 0, 0], fidelity="game",
    )  # fmt: skip
    (reading,) = rope.torsion()
    tension = rope.sample(0.5).tension
    assert tension > 40.0
    assert reading.torque == pytest.approx(factor * tension, rel=0.01)
    with pytest.raises(errors.Error, match="torque_per_tension"):
        rope.add_reel("start", Reel(0.2))


def test_torsion_is_read_back_pickled_and_checked() -> None:
    torsion = Torsion(STIFFNESS, 0.25, 0.1, start="swivel", end=Motor(1.0, 0.5, 2.0))
    assert pickle.loads(pickle.dumps(torsion)) == torsion
    assert Torsion.round(3.0, 0.5).stiffness == pytest.approx(2.0)
    with pytest.raises(ValueError, match="Poisson"):
        Torsion.round(3.0, 0.6)
    with pytest.raises((ValueError, errors.Error)):
        straight(Torsion(-1.0), clamp=["start", "end"])
