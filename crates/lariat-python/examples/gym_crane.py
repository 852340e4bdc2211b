"""A crane as an environment for reinforcement learning: ``reset`` and ``step`` as those of gymnasium, which need not be installed.

A trolley runs along a beam, and a load of 200 kg hangs below it on a rope of 6 m. The action is the acceleration of the trolley; the
reward is what a crane driver wants: the load near its goal, and still. ``reset`` restores one snapshot of the world, so that an episode
costs no building, and the same seed and actions give the same observations, bit for bit.

    pip install lariat-cables
    python gym_crane.py
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

import lariat_cables as lariat
from lariat_cables.types import Array

ROPE, LOAD, GRAVITY = 6.0, 200.0, 9.81
LARGEST_SPEED, LARGEST_ACCELERATION = 2.0, 1.0
"""Of the trolley, in m/s and m/s^2."""
STEP = 1 / 60
FRAMES = 3
"""Host steps for each action: 20 actions per second."""
EPISODE = 400
"""Actions in an episode: 20 s."""


class CraneEnv:
    """The environment. An observation is position and speed of the trolley and position and speed of the load, both from the goal in m
    and m/s, shape (4,); an action is the acceleration of the trolley in m/s^2, shape (1,)."""

    def __init__(self) -> None:
        self.world = lariat.World(dt=STEP)
        trolley = self.world.add_body(lariat.RigidBody.kinematic_position_based(), [lariat.Collider.cuboid(0.3, 0.1, 0.3)])
        load = self.world.add_body(lariat.RigidBody.dynamic(translation=[0, -ROPE - 0.5, 0]), [lariat.Collider.cuboid(0.5, 0.5, 0.5, mass=LOAD)])
        self.world.add_rope(
            [0, 0, 0], [0, -ROPE, 0], lariat.Section.wire_rope(0.012), start_body=trolley, end_body=load, elements=6, name="hoist"
        )
        self.world.equilibrium()
        self.trolley, self.load = self.world.rigid_bodies[trolley], self.world.rigid_bodies[load]
        self.start = self.world.snapshot()
        self.goal, self.x, self.v, self.actions = 0.0, 0.0, 0.0, 0

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Array, dict[str, Any]]:
        """Begins an episode with a goal between 3 and 8 m; returns an observation, and the goal."""
        self.world.restore(self.start)
        self.goal = float(np.random.default_rng(seed).uniform(3.0, 8.0))
        self.x, self.v, self.actions = 0.0, 0.0, 0
        return self._observation(), {"goal": self.goal}

    def step(self, action: Array) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        """Takes an action; returns observation, reward, whether the load is off its rope, whether the time is over, and the tension in N."""
        acceleration = float(np.clip(np.ravel(action)[0], -LARGEST_ACCELERATION, LARGEST_ACCELERATION))
        for _ in range(FRAMES):
            self.v = float(np.clip(self.v + acceleration * STEP, -LARGEST_SPEED, LARGEST_SPEED))
            self.x += self.v * STEP
            self.trolley.set_next_kinematic_translation([self.x, 0, 0])
            self.world.step()
        self.actions += 1
        seen = self._observation()
        reward = -(abs(seen[2]) + 0.5 * abs(seen[3])) * FRAMES * STEP
        tension = self.world.cable("hoist").sample("start").tension
        return seen, float(reward), False, self.actions >= EPISODE, {"tension": tension}

    def _observation(self) -> Array:
        place, speed = self.load.translation[0], self.load.linvel[0]
        return np.array([self.x - self.goal, self.v, place - self.goal, speed])


def driver(seen: Array) -> Array:
    """A driver by feedback: towards the goal, and after the load where it swings."""
    x, v, place, speed = seen
    return np.array([-0.25 * x - 1.0 * v + 0.9 * (place - x) + 0.3 * (speed - v)])


def hasty(seen: Array) -> Array:
    """A driver that does not look at the load."""
    x, v, *_ = seen
    return np.array([-1.0 * x - 1.5 * v])


def episode(env: CraneEnv, policy: Any, seed: int) -> tuple[Array, float]:
    """Returns all observations of an episode, and its reward."""
    seen, _ = env.reset(seed=seed)
    rows, total, over = [seen], 0.0, False
    while not over:
        seen, reward, _, over, _ = env.step(policy(seen))
        rows.append(seen)
        total += reward
    return np.array(rows), total


def swing(rows: Array) -> float:
    """The largest distance in m of the load from below the trolley in the last 5 s."""
    last = rows[-int(5.0 / (FRAMES * STEP)) :]
    return float(np.abs(last[:, 2] - last[:, 0]).max())


def main() -> None:
    env = CraneEnv()
    rows, total = episode(env, driver, seed=1)
    again, _ = episode(env, driver, seed=1)
    other, careless = episode(env, hasty, seed=1)
    print(f"driver: reward {total:.1f}, swing {swing(rows):.3f} m, {abs(rows[-1, 2]):.3f} m from the goal; the same again: {np.array_equal(rows, again)}")
    print(f"hasty:  reward {careless:.1f}, swing {swing(other):.3f} m; period of the rope alone {2 * math.pi * math.sqrt(ROPE / GRAVITY):.1f} s")


if __name__ == "__main__":
    main()
