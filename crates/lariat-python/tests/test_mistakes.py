"""What newcomers write in Python, and the first line that they get: it says the cause."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from typing import Any

import pytest

import lariat_cables as lariat
from lariat_cables import Collider, Contact, RigidBody, errors

STEEL = lariat.Section.rope("wire_rope", 0.008)
LINE = [[0, 0, 0], [0, -2, 0]]


def rope(section: lariat.Section = STEEL, **settings: Any) -> lariat.Cable:
    return lariat.Cable(LINE, section, **{"fix": "start", "fidelity": "game", **settings})


def yard() -> tuple[lariat.World, lariat.Cable, Any]:
    """A world with a rope of 2 m, and a crate of 10 kg at its end."""
    world = lariat.World()
    crate = world.add_body(RigidBody.dynamic().translation([0, -2.1, 0]), [Collider.cuboid(0.1, 0.1, 0.1).mass(10.0)])
    return world, world.add_cable(rope(name="sling")), crate


def attach_twice() -> None:
    world, sling, crate = yard()
    for at in ("end", 2.0):
        world.attach(sling, at, crate, [0, 0.1, 0])


def anchor_of_the_world() -> None:
    world, sling, crate = yard()
    world.attach(sling, "end", crate, [0, -2.0, 0])


def removed() -> None:
    world, sling, _ = yard()
    world.remove_cable(sling)
    sling.reel("start")


def removed_body() -> None:
    world, sling, crate = yard()
    world.remove_body(crate)
    world.attach(sling, "end", crate)


def stretched(strain: float) -> lariat.Cable:
    line = rope()
    line.set_strength(strain=strain)
    return line


def free_reel() -> lariat.Cable:
    line = rope()
    line.add_reel("end", lariat.Reel(0.5))
    return line


def light_water() -> lariat.World:
    world, _, _ = yard()
    world.set_water(lariat.Water(1.025))
    return world


def step_by_itself() -> None:
    yard()[1].step(0.01)


MISTAKES: list[tuple[str, Callable[[], Any], list[str]]] = [
    # sizes and materials in another unit
    ("a diameter in mm", lambda: rope(lariat.Section.round(8.0, 2.1e11, 7850.0)), ["as long as thick", "in m"]),
    ("a modulus in GPa", lambda: rope(lariat.Section.round(0.008, 210.0, 7850.0)), ["was 210 GPa"]),
    ("a density in g/cm^3", lambda: rope(lariat.Section.round(0.008, 2.1e11, 7.85)), ["g/cm^3 meant", "GravityScale(0.0)"]),
    ("the modulus for EA", lambda: rope(lariat.Section(2.1e11, 0.5, 0.25)), ["was the modulus given?"]),
    ("a slack in percent", lambda: rope(length=10.0), ["% of slack"]),
    ("damping as a share", lambda: rope(effects=lariat.Damping(2.0, 0.0)), ["2 s", "Cable(damped_as="]),
    ("a friction in percent", lambda: rope(effects=Contact(friction=30.0)), ["no two materials", "not in percent"]),
    ("a breaking strain in percent", lambda: stretched(2.0), ["200 % of its length", "not in percent"]),
    ("a radius of contact in mm", lambda: rope(effects=Contact(radius=5.0)), ["was 5 mm meant?"]),
    ("gravity in mm/s^2", lambda: rope(gravity=[0, -9810, 0]), ["not in mm/s^2"]),
    ("a tolerance in mm", lambda: rope(fidelity=None, integrator=lariat.Integrator("esdirk4", tolerance=5.0)), ["an error of positions in m"]),
    ("water in t/m^3", light_water, ["g/cm^3 or t/m^3 meant?"]),
    ("a reel at a free end", free_reel, ["nothing holds the eye"]),
    # numbers that nothing has
    ("elements below 0", lambda: rope(elements=-1), ["a whole number of at least 0, got -1"]),
    ("elements as a text", lambda: rope(elements="10"), ["a whole number of at least 0, got '10' (str)"]),
    ("half a step", lambda: rope().step(0.01, steps=2.5), ["a whole number of at least 0, got 2.5 (float)"]),
    ("a node by a name", lambda: rope(nodes_at="middle"), ["expected numbers, got str"]),
    ("an effect that is not made", lambda: rope(effects=lariat.Drag), ["the class Drag: write Drag(...)"]),
    ("an effect by its name", lambda: rope(effects="drag"), ["an effect of lariat, or a list of them, got 'drag'"]),
    ("an exchange of a cable", lambda: lariat.Exchange(rope()), ["expected a CoSimulation", "got Cable"]),
    ("a recording of nothing", lambda: lariat.record(rope()).save("nowhere"), ["call take()"]),
    ("a body that was removed", removed_body, ["RigidBodyHandle(index=0, generation=0)"]),
    ("one point", lambda: lariat.Cable([[0, 0, 0]], STEEL), ["at least 2 points"]),
    ("points in a plane", lambda: lariat.Cable([[0, 0], [1, 0]], STEEL), ["3"]),
    ("points in columns", lambda: lariat.Cable([[0, 1], [0, 0], [0, 0]], STEEL), ["3"]),
    ("no number", lambda: rope(length=math.nan), ["length", "finite"]),
    ("no element", lambda: rope(elements=0), ["1 to"]),
    ("a breaking load of 0", lambda: rope().set_strength(0.0), ["breaking tension (N)", "> 0"]),
    ("a load of nothing", lambda: rope().add_load("end"), ["a force, a moment, or both"]),
    ("two lengths", lambda: rope(length=2.1, sag=0.1), ["one of length, pretension and sag"]),
    # names
    ("an unknown rule", lambda: rope(rule="simpson"), ["simpson"]),
    ("an unknown rope", lambda: lariat.Section.rope("hemp", 0.01), ["hemp"]),
    ("an effect by a wrong name", lambda: rope(effects={"darg": lariat.Damping(1e-3, 1e-3)}), ["'darg'", "'damping'"]),
    ("an unknown argument", lambda: rope(segments=10), ["segments"]),
    # places
    ("a point behind the end", lambda: rope().sample(2.5), ["2.5", "[0, 2]"]),
    ("a share of the length", lambda: rope().sample(1), ["lariat.Node"]),
    ("an anchor in the axes of the world", anchor_of_the_world, ["from what it is to be attached to"]),
    ("an attachment twice", attach_twice, ["attached already"]),
    ("a cable that was removed", removed, [""]),
    ("a cable of a world by itself", step_by_itself, ["world"]),
    # what does not go together
    ("contact by a method without it", lambda: rope(effects=Contact(), fidelity=None, integrator=lariat.Integrator("esdirk4", tolerance=1e-6)), ["contact"]),
    ("a preset and an integrator", lambda: rope(integrator=lariat.Integrator("esdirk4", tolerance=1e-6)), ["fidelity or integrator"]),
]


@pytest.mark.parametrize("what, wrong, words", MISTAKES, ids=[what for what, *_ in MISTAKES])
def test_the_first_line_says_the_cause(what: str, wrong: Callable[[], Any], words: list[str]) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", errors.ResultWarning)
        try:
            made = wrong()
            line = made.warnings()[0]
        except (errors.Error, TypeError, ValueError) as error:
            line = str(error).splitlines()[0]
    print(f"| {what} | {line} |")
    assert all(word in line for word in words), line


def test_of_what_is_right_nothing_is_said() -> None:
    world, sling, crate = yard()
    world.attach(sling, "end", crate, [0, 0.1, 0])
    for _ in range(60):
        world.step()
    assert world.warnings() == []


def test_a_step_of_a_world_may_have_its_own_length() -> None:
    """*Source.* Two worlds: one by its ``dt``, one by a step of that length."""
    (one, first, _), (other, second, _) = yard(), yard()
    other.dt = 0.5
    for _ in range(10):
        one.step()
        other.step(one.dt)
    assert (first.positions == second.positions).all() and other.dt == 0.5 and abs(other.time - one.time) < 1e-6
    for dt in (0.0, -1.0, math.nan):
        with pytest.raises(errors.InvalidValueError, match="dt"):
            other.step(dt)


def test_names_and_lists_that_are_not_there_are_told() -> None:
    scene = "duration = 0.1\n[[cable]]\nname = \"c\"\npoints = [[0, 0, 0], [1, 0, 0]]\nsection = { wire_rope = 0.008 }\n[[probe]]\nname = \"hook\"\ncable = \"c\"\nat = \"end\"\n"
    run = lariat.run(scene)
    with pytest.raises(KeyError, match="no probe 'hok'; the run has hook"):
        run.probes["hok"]
    vary: Any = [{"duration": 0.2}]
    with pytest.raises(errors.InvalidValueError, match="a list of settings is points"):
        lariat.sweep(scene, vary)
