"""Every public class, method, property and function of the package with arguments at random: each call ends in a result or in an exception.

What is called is read from the package, so that what is added is called, too. A panic of Rust would be a ``PanicException``, which is no
``Exception``; an abort would end the process.
"""

from __future__ import annotations

import inspect
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_calls import array, effects, number, obstacle, place, reel

import lariat_cables as lariat
from lariat_cables import _lariat, bodies, contact, effects as effect_classes, errors, joints, results, scenes

ROUNDS = 12
"""Calls of each method and function with arguments at random, on each of the objects."""


def nested() -> list[Any]:
    """A list that contains itself."""
    itself: list[Any] = []
    itself.append(itself)
    return itself


def objects() -> list[Any]:
    """One of each class, made anew: calls change them."""
    section = lariat.Section(1e4, 0.05, 0.2, diameter=0.01)
    world = lariat.World()
    body = world.add_body(lariat.RigidBody.dynamic(translation=[1, 0, 0]), [lariat.Collider.ball(0.1)])
    other = world.add_body(lariat.RigidBody.fixed(), [lariat.Collider.cuboid(0.1, 0.1, 0.1)])
    world.impulse_joints.insert(body, other, lariat.SphericalJoint.builder())
    free = lariat.Cable([[0, 0, 0], [1, 0, 0]], section, elements=4, fix="start", fidelity="game")
    rope = world.add_cable(free)
    world.attach(rope, "end", body, [0, 0, 0])
    coupling = lariat.CoSimulation(free.copy())
    coupling.attach("end", [1, 0, 0])
    removed = world.remove_cable(world.add_cable(free))
    return [
        free, rope, removed, world, coupling, section, free.integrator, world.rigid_bodies, world.rigid_bodies[body], world.impulse_joints,
        world.multibody_joints, lariat.RigidBody.dynamic(), lariat.Collider.ball(0.1), lariat.RevoluteJoint.builder([0, 0, 1]),
        lariat.PrismaticJoint.builder([1, 0, 0]), lariat.Obstacle.ball(0.1), lariat.Reel(0.1), lariat.Damping(0.1, 0.1), body, free.energy(), free.sample([0.1]),
    ]  # fmt: skip


def argument(r: random.Random, pool: list[Any]) -> Any:
    make: list[Callable[[], Any]] = [
        lambda: number(r), lambda: number(r), lambda: array(r), lambda: place(r), lambda: effects(r), lambda: obstacle(r), lambda: reel(r),
        lambda: r.choice(pool), lambda: r.choice(pool), lambda: [r.choice(pool), r.choice(pool)], nested, lambda: {"cable": nested()},
        lambda: r.choice(["game", "start", "end", "esdirk4", "wire-rope", "", "a\0b", "\ud800", b"", (0, 0), (99, 1), {}, lambda *a: 1 / 0]),
    ]  # fmt: skip
    return r.choice(make)()


def arguments(r: random.Random, function: Any, pool: list[Any]) -> tuple[list[Any], dict[str, Any]]:
    """As many arguments as it takes, more or less."""
    try:
        parameters = list(inspect.signature(function).parameters.values())
    except (TypeError, ValueError):
        return [argument(r, pool) for _ in range(r.randrange(3))], {}
    positional = [p for p in parameters if p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD)]
    needed = sum(p.default is p.empty for p in positional)
    count = r.choice([needed, needed, len(positional), max(0, needed - 1), needed + 3])
    named = [p.name for p in parameters if p.kind is p.KEYWORD_ONLY and r.random() < 0.3 and p.name not in ("client", "progress")]
    return [argument(r, pool) for _ in range(count)], {name: argument(r, pool) for name in named}


def attempt(call: Callable[[], Any]) -> bool:
    try:
        call()
    except Exception as error:
        assert type(error).__name__ != "PanicException"
        return False
    return True


def callables() -> list[tuple[str, Any]]:
    """All public functions and classes."""
    found: dict[str, Any] = {}
    for module in (lariat, _lariat, bodies, contact, effect_classes, joints, results, scenes):
        for name in dir(module):
            thing = getattr(module, name)
            if not name.startswith("_") and callable(thing) and getattr(thing, "__module__", "").startswith("lariat"):
                found[f"{thing.__module__}.{name}"] = thing
    return sorted(found.items())


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("seed", range(ROUNDS))
def test_every_function_and_class(seed: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    r, pool = random.Random(10**6 + seed), objects()
    for _, function in callables():
        if not (isinstance(function, type) and issubclass(function, BaseException)):
            given, named = arguments(r, function, pool)
            attempt(lambda: function(*given, **named))
            if isinstance(function, type):
                for name in [n for n in dir(function) if not n.startswith("_") and callable(getattr(function, n))]:
                    given, named = arguments(r, getattr(function, name), pool)
                    attempt(lambda: getattr(function, name)(*given, **named))


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("seed", range(ROUNDS))
def test_every_method_and_property(seed: int) -> None:
    r = random.Random(2 * 10**6 + seed)
    made = 0
    for index in range(len(objects())):
        for name in [n for n in dir(objects()[index]) if not n.startswith("_") or n in ("__getitem__", "__reduce__", "__copy__", "__deepcopy__", "__repr__", "__len__")]:
            pool = objects()
            target = pool[index]
            if attempt(lambda: setattr(target, name, argument(r, pool))) and callable(getattr(type(target), name, None)):
                continue
            for _ in range(2):
                attempt(lambda: getattr(target, name))
                method = getattr(type(target), name, None)
                if callable(method):
                    given, named = arguments(r, getattr(target, name), pool)
                    made += attempt(lambda: getattr(target, name)(*given, **named))
            # what is left of it still works, or says why not
            for thing in pool[:5]:
                attempt(lambda: repr(thing))
                if hasattr(thing, "step"):
                    attempt(lambda: thing.step(1e-3) if isinstance(thing, lariat.Cable) else thing.step())
    assert made > 30


def test_data_that_contain_themselves_are_refused() -> None:
    itself = nested()
    deep: Any = 1.0
    for _ in range(10**5):
        deep = [deep]
    cable = lariat.Cable([[0, 0, 0], [1, 0, 0]], lariat.Section(1e4, 0.05, 0.2), elements=2)
    for data in (itself, deep):
        for call in (lambda: lariat.run({"cable": data}), lambda: setattr(cable, "effects", {"drag": data}), lambda: lariat.sweep({}, {"a": data})):
            with pytest.raises((RecursionError, errors.Error)):
                call()


def test_arrays_that_are_filled_have_the_order_of_c() -> None:
    cable = lariat.Cable([[0, 0, 0], [1, 0, 0]], lariat.Section(1e4, 0.05, 0.2), elements=4)
    filled = np.zeros((5, 6))
    cable.read_into(filled)
    assert np.array_equal(filled, cable.coordinates)
    for other in (np.zeros((5, 6), order="F"), np.zeros((6, 5)), np.zeros((3, 10)), np.zeros((10, 6))[::2]):
        with pytest.raises(errors.ShapeError):
            cable.read_into(other)
        assert not other.any()
