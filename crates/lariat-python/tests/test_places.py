"""A point of a cable means the same in every call."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any

import docstrings
import numpy as np
import pytest

import lariat_cables as lariat
from lariat_cables import errors

SECTION = lariat.Section(1e5, 0.05, 0.2, diameter=0.01)
NODES = 5
"""Nodes of the cable, at 0, 0.5, 1, 1.5 and 2 m: node 1 is not at 1 m."""


def cable(**arguments: Any) -> lariat.Cable:
    return lariat.Cable([[0, 0, 0], [2, 0, 0]], SECTION, elements=NODES - 1, fidelity="game", **arguments)


def in_world(act: Callable[[lariat.World, lariat.Cable, lariat.RigidBodyHandle], Any]) -> Any:
    """Returns where a call on a world lets its cables and its body be after two steps, or the kind of its error."""
    world = lariat.World()
    body = world.add_body(lariat.RigidBody.dynamic(), [lariat.Collider.ball(0.1)])
    rope = world.add_cable(cable())
    try:
        act(world, rope, body)
        world.step()
        world.step()
    except errors.Error as error:
        return type(error)
    return [c.coordinates.tobytes() for c in world.cables], world.rigid_bodies[body].translation.tobytes()


def alone(act: Callable[[lariat.Cable], Any], fixed: Any = None) -> Any:
    """Returns what a call on a cable leaves, and what it returns."""
    rope = cable(fix=fixed)
    try:
        returned = act(rope)
    except errors.Error as error:
        return type(error)
    return rope.to_bytes(), returned.to_bytes() if isinstance(returned, lariat.Cable) else repr(returned)


def coupled(at: Any) -> Any:
    coupling = lariat.CoSimulation(cable())
    coupling.attach(at, [0, 0, 0])
    return coupling.to_bytes()


def second(world: lariat.World) -> lariat.Cable:
    return world.add_cable(lariat.Cable([[0, 0, 0], [0, 2, 0]], SECTION, elements=NODES - 1, fidelity="game"))


CALLS: dict[tuple[str, str, str], Callable[[Any], Any]] = {
    ("Cable", "__new__", "fix"): lambda at: cable(fix=at).to_bytes(),
    ("Cable", "__new__", "clamp"): lambda at: cable(clamp=[at]).to_bytes(),
    ("Cable", "__new__", "clamp_along"): lambda at: cable(clamp_along=[(at, [1, 0, 0])]).to_bytes(),
    ("Cable", "__new__", "finest_at"): lambda at: lariat.Cable([[0, 0, 0], [2, 0, 0]], SECTION, elements=30, finest=0.02, finest_at=at).to_bytes(),
    ("Cable", "sample", "at"): lambda at: alone(lambda c: (c.sample(at).s, c.sample([at]).s)),
    ("Cable", "node", "at"): lambda at: alone(lambda c: c.node(at)),
    ("Cable", "insert_node", "at"): lambda at: alone(lambda c: c.insert_node(at)),
    ("Cable", "fix", "at"): lambda at: alone(lambda c: c.fix(at)),
    ("Cable", "clamp", "at"): lambda at: alone(lambda c: c.clamp(at)),
    ("Cable", "release", "at"): lambda at: alone(lambda c: c.release(at), ["start", "end", 0.5, 1.0, 1.5]),
    ("Cable", "prescribe", "at"): lambda at: alone(lambda c: c.prescribe(at, [0, 1, 0], 1.0)),
    ("Cable", "add_load", "at"): lambda at: alone(lambda c: c.add_load(at, [0, 1, 0])),
    ("Cable", "cut", "at"): lambda at: alone(lambda c: c.cut(at)),
    ("Cable", "add_reel", "at"): lambda at: alone(lambda c: c.add_reel(at, lariat.Reel(0.5)), ["start", "end"]),
    ("Cable", "set_reel", "at"): lambda at: alone(lambda c: (c.add_reel(at, lariat.Reel(0.5)), c.set_reel(at, lariat.Reel(0.2))), ["start", "end"]),
    ("Cable", "set_reel_length", "at"): lambda at: alone(lambda c: (c.add_reel(at, lariat.Reel(0.5)), c.set_reel_length(at, 1.2, 0.2)), ["start", "end"]),
    ("Cable", "set_reel_rate", "at"): lambda at: alone(lambda c: (c.add_reel(at, lariat.Reel(0.5)), c.set_reel_rate(at, 0.2)), ["start", "end"]),
    ("Cable", "remove_reel", "at"): lambda at: alone(lambda c: (c.add_reel(at, lariat.Reel(0.5)), c.remove_reel(at)), ["start", "end"]),
    ("Cable", "reel", "at"): lambda at: alone(lambda c: (c.add_reel("end", lariat.Reel(0.5)), c.reel(at)), ["start", "end"]),
    ("Cable", "reel_description", "at"): lambda at: alone(lambda c: (c.add_reel("end", lariat.Reel(0.5)), c.reel_description(at)), ["start", "end"]),
    ("CoSimulation", "attach", "at"): coupled,
    ("World", "cut", "at"): lambda at: in_world(lambda w, c, b: w.cut(c, at)),
    ("World", "attach", "at"): lambda at: in_world(lambda w, c, b: w.attach(c, at, b)),
    ("World", "add_kink", "at"): lambda at: in_world(lambda w, c, b: w.add_kink(c, at)),
    ("World", "join", "at"): lambda at: in_world(lambda w, c, b: w.join(c, at, second(w), 0.5, gap=None)),
    ("World", "join", "second_at"): lambda at: in_world(lambda w, c, b: w.join(second(w), 0.5, c, at, gap=None)),
    ("World", "add_sheave", "at"): lambda at: in_world(lambda w, c, b: w.add_sheave(c, at, second(w), "start")),
    ("World", "add_sheave", "second_at"): lambda at: in_world(lambda w, c, b: w.add_sheave(second(w), "start", c, at)),
    ("World", "add_sheave_at", "at"): lambda at: in_world(lambda w, c, b: w.add_sheave_at(c, at, b, c.sample(at).position)),
    ("World", "add_drum", "at"): lambda at: in_world(lambda w, c, b: w.add_drum(c, at, b, [0, 0, 1], 0.1)),
    ("World", "remove_drum", "at"): lambda at: in_world(lambda w, c, b: (w.add_drum(c, at, b, [0, 0, 1], 0.1), w.remove_drum(c, at))),
}  # fmt: skip


def test_no_call_that_takes_a_place_is_left_out() -> None:
    """Read off the stub: an argument whose type names ``Place``."""
    taken = set()
    for node in ast.parse(docstrings.STUBS.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.ClassDef):
            for item in node.body:
                if isinstance(item, ast.FunctionDef):
                    for argument in item.args.args + item.args.kwonlyargs:
                        if argument.annotation is not None and "Place" in ast.unparse(argument.annotation):
                            taken.add((node.name, item.name, argument.arg))
    assert taken == set(CALLS)


@pytest.mark.parametrize("call", CALLS, ids=".".join)
def test_a_node_is_its_arc_length_and_another_integer_is_refused(call: tuple[str, str, str]) -> None:
    """Law: f(Node(k)) = f(arc_lengths[k]), f("start") = f(Node(0)) = f(0), f("end") = f(Node(last)); f(1) is AmbiguousPlaceError."""
    f = CALLS[call]
    lengths = cable().arc_lengths
    before_mesh = call[1] == "__new__"  # but for the first, no node has a number before there are elements
    for k, s in enumerate(lengths):
        if before_mesh and k > 0:
            with pytest.raises(errors.NodeBeforeMeshError):
                f(lariat.Node(k))
        elif not before_mesh:
            assert f(lariat.Node(k)) == f(float(s)) == f(np.float64(s)) == f(np.array(s)), k
    last = 2.0 if before_mesh else lariat.Node(NODES - 1)
    assert f("start") == f(lariat.Node(0)) == f(0.0) == f(0)
    assert f("end") == f(last)
    results = [f(x) for x in ("start", 0.5, "end")]
    assert call[1] in ("remove_reel", "remove_drum") or len({repr(r) for r in results}) > 1, "the place does not matter"
    for integer in (1, 2, -1, np.int64(1), np.array(1)):
        with pytest.raises(errors.AmbiguousPlaceError, match=r"lariat\.Node\(|\.0"):
            raised = f(integer)
            if isinstance(raised, type):
                raise raised("lariat.Node(")
    for nothing in (True, np.True_, 1j, [[1.0]]):
        with pytest.raises((TypeError, errors.Error)):
            raised = f(nothing)
            if isinstance(raised, type):
                raise raised("")


def test_samples_of_arrays_count_metres_and_sequences_hold_places() -> None:
    rope = cable()
    assert rope.sample(np.array([0.0, 1.0])).s.tolist() == [0.0, 1.0]
    assert rope.sample(["start", lariat.Node(1), 1.25, "end"]).s.tolist() == [0.0, 0.5, 1.25, 2.0]
    assert rope.sample([]).s.shape == (0,) and rope.sample(np.float32(0.5)).s == 0.5
    for wrong in (np.arange(3), [0.5, 1], (2,)):
        with pytest.raises(errors.AmbiguousPlaceError):
            rope.sample(wrong)  # type: ignore[call-overload]
    with pytest.raises(errors.ShapeError):
        rope.sample(np.zeros((2, 2)))


def test_nodes_count_in_arrays() -> None:
    rope = cable()
    node = rope.node(1.5)
    assert repr(node) == "Node(3)" and rope.positions[node] == pytest.approx([1.5, 0, 0])
    with pytest.raises(ValueError, match="-1"):
        lariat.Node(-1)
    rope.fix(node)
    assert [r.node for r in rope.reactions()] == [3] and isinstance(rope.reactions()[0].node, lariat.Node)
