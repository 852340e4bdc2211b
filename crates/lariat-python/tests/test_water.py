"""Bodies of a world in water."""

from __future__ import annotations

import math

import numpy as np
import pytest

import lariat_cables as lariat


def pool(density: float, **water: object) -> tuple[lariat.World, tuple[int, int]]:
    world = lariat.World()
    ball = world.add_body(lariat.RigidBody.dynamic(), [lariat.Collider.ball(0.2, density=density)])
    world.set_water(lariat.Water(1000.0, **water))  # type: ignore[arg-type]
    return world, ball


def test_a_float_rests_where_it_displaces_its_weight() -> None:
    """Source: Archimedes; half of a ball is below where its density is half that of the water."""
    world, ball = pool(500.0)
    world.immerse(ball, [0.06] * 3)
    for _ in range(900):
        world.step()
    assert abs(world.rigid_bodies[ball].translation[1]) < 0.01


def test_a_ball_sinks_at_its_terminal_speed_and_floats_on_a_wave() -> None:
    """Source: weight less buoyancy = drag. A small float on a long wave follows its height."""
    world, ball = pool(3000.0, level=None)
    world.immerse(ball, [0.06] * 3, added_mass=0.5)
    for _ in range(600):
        world.step()
    volume = 4 / 3 * math.pi * 0.2**3
    speed = math.sqrt(2 * 2000.0 * volume * 9.81 / (1000.0 * 0.06))
    assert world.rigid_bodies[ball].linvel[1] == pytest.approx(-speed, rel=1e-3)
    work = world.water_work(ball)
    assert work is not None and work < 0.0

    world, ball = pool(500.0, wave=lariat.Wave(0.3, 8.0))
    world.immerse(ball, [0.06] * 3, added_mass=0.5)
    heights = []
    for _ in range(2400):
        world.step()
        heights.append(world.rigid_bodies[ball].translation[1])
    assert max(heights[-480:]) == pytest.approx(0.3, abs=0.02)


def test_water_is_saved_changed_and_taken_away() -> None:
    world, ball = pool(700.0)
    world.immerse(ball, added_mass=0.5)
    for _ in range(30):
        world.step()
    saved, before = world.snapshot(), world.rigid_bodies[ball].translation
    for _ in range(30):
        world.step()
    after = world.rigid_bodies[ball].translation
    assert abs(after[1] - before[1]) > 0.01
    world.restore(saved)
    assert np.array_equal(world.rigid_bodies[ball].translation, before)
    for _ in range(30):
        world.step()
    assert np.array_equal(world.rigid_bodies[ball].translation, after)
    world.set_water(lariat.Water(2000.0))
    assert world.emerge(ball) and not world.emerge(ball)
    world.immerse(ball)
    world.set_water(None)
    assert world.water_work(ball) is None
    before = world.rigid_bodies[ball].linvel[1]
    world.step()
    assert world.rigid_bodies[ball].linvel[1] == pytest.approx(before - 9.81 / 60, abs=1e-4)


def test_added_mass_is_one_number_or_one_for_each_axis() -> None:
    """Source: v = F t/(m + C_i m) of a neutral body; three equal numbers are one."""

    def pulled(added: object, axis: int) -> np.ndarray:
        world, ball = pool(1000.0, level=None)
        world.immerse(ball, added_mass=added)
        force = [0.0] * 3
        force[axis] = 10.0
        world.rigid_bodies[ball].add_force(force)
        for _ in range(60):
            world.step()
        return np.asarray(world.rigid_bodies[ball].linvel)

    mass = 1000.0 * 4 / 3 * math.pi * 0.2**3
    for axis, coefficient in enumerate([0.1, 1.4, 0.7]):
        expected = 10.0 / (mass * (1 + coefficient))
        assert pulled([0.1, 1.4, 0.7], axis)[axis] == pytest.approx(expected, rel=1e-4)
    assert np.array_equal(pulled(0.5, 0), pulled([0.5] * 3, 0))
    world, ball = pool(1000.0)
    with pytest.raises(lariat.errors.WaterValueError):
        world.immerse(ball, added_mass=[0.5, -1.0, 0.5])


def test_what_cannot_be_in_water_is_refused_by_name() -> None:
    world = lariat.World()
    wall = world.add_body(lariat.RigidBody.fixed(), [lariat.Collider.ball(0.2)])
    bare = world.add_body(lariat.RigidBody.dynamic())
    with pytest.raises(lariat.errors.NoWaterError):
        world.immerse(bare)
    world.set_water(lariat.Water(1000.0))
    with pytest.raises(lariat.errors.NotDynamicError):
        world.immerse(wall)
    with pytest.raises(lariat.errors.NoVolumeError):
        world.immerse(bare)
    with pytest.raises(lariat.errors.WaterValueError):
        world.immerse(bare, volume=0.0)
    for wrong in (lariat.Water(0.0), lariat.Water(1000.0, wave=lariat.Wave(0.3, 0.0))):
        with pytest.raises(lariat.errors.Error):
            world.set_water(wrong)
    with pytest.raises(ValueError, match="level"):
        world.set_water(lariat.Water(1000.0, level=None, wave=lariat.Wave(0.3, 8.0)))
    with pytest.raises(TypeError, match="Water"):
        world.set_water(1000.0)  # type: ignore[arg-type]


def test_cables_are_in_the_water_of_a_world_by_the_effects_that_it_makes() -> None:
    """Source: Archimedes' principle and Morison's formula, of the part that is wet: 3 m of 4."""
    water = lariat.Water(1000.0, level=0.0, flow=lariat.Flow([0.05, 0, 0]))
    section = lariat.Section(1e5, 0.0, 0.5, diameter=0.02, outer_area=math.pi * 1e-4)
    effects = [water.buoyancy(added_mass=0.0), water.drag()]
    rope = lariat.Cable([[0, 1, 0], [0, -3, 0]], section, elements=40, fix="start", effects=effects)
    rope.equilibrium()
    force = np.abs(rope.reactions()[0].force)
    assert force[1] == pytest.approx(9.81 * (0.5 * 4 - 1000.0 * math.pi * 1e-4 * 3), rel=2e-3)
    assert force[0] == pytest.approx(0.5 * 1000.0 * 1.2 * 0.02 * 0.05**2 * 3, rel=0.02)
    wave = lariat.Water(1025.0, level=2.0, wave=lariat.Wave(0.5, 8.0))
    surface = wave.drag(gravity=[0, 0, -9.81]).flow.surface
    assert surface is not None and wave.buoyancy(gravity=[0, 0, -9.81]).surface == surface
    assert surface["up"] == [0, 0, 1] and surface["level"] == 2.0 and surface["wave"]["period"] == 8.0
    assert lariat.Water(level=None).buoyancy().surface is None
    with pytest.raises(ValueError, match="free surface"):
        lariat.Water(level=None, wave=lariat.Wave(0.5, 8.0)).drag()
