"""What the examples print is right."""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "examples"))


def test_the_crane_resets_bitwise_and_a_driver_who_looks_swings_less() -> None:
    import gym_crane as crane

    env = crane.CraneEnv()
    rows, total = crane.episode(env, crane.driver, seed=1)
    other, careless = crane.episode(env, crane.hasty, seed=2)
    again, _ = crane.episode(env, crane.driver, seed=1)
    assert np.array_equal(rows, again) and not np.array_equal(rows, other)
    assert np.abs(np.diff(rows[:, 2])).max() > 0.01 and rows[0, 2] < -3.0
    hasty, _ = crane.episode(env, crane.hasty, seed=1)
    assert abs(rows[-1, 2]) < 0.1 and crane.swing(rows) < 0.3 * crane.swing(hasty)
    # a load on a rope is a pendulum of the length to its centre, of which the rope turns as one with it
    env.reset(seed=1)
    for _ in range(20):
        env.step(np.array([1.0]))
    places = []
    while env.v > 0.0:
        env.step(np.array([-1.0]))
    for _ in range(300):
        seen = env.step(np.array([-env.v * 20.0]))[0]
        places.append(seen[2] - seen[0])
    signs = np.flatnonzero(np.diff(np.sign(places)) > 0)
    period = float(np.diff(signs).mean()) * crane.FRAMES * crane.STEP
    assert period == pytest.approx(2 * math.pi * math.sqrt((crane.ROPE + 0.5) / crane.GRAVITY), rel=0.05)


def test_stiffness_and_damping_are_found_from_recorded_points() -> None:
    """Source: what the recording was made with, on a finer mesh, with noise."""
    pytest.importorskip("scipy")
    import identify

    found, errors = identify.main()
    assert found == pytest.approx(identify.TRUTH, rel=0.02)
    assert (errors / found < 0.02).all()
