"""What a program steps itself, recorded: arrays, files, the page."""

from __future__ import annotations

import csv
import json
import re
from pathlib import Path

import numpy as np
import pytest

import lariat_cables as lariat

SECTION = lariat.Section(1e5, 0.1, 0.1)


def data_of(page: str) -> dict:
    found = re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.DOTALL)
    assert found
    return json.loads(found.group(1))


def crane() -> tuple[lariat.World, lariat.Cable, int]:
    world = lariat.World()
    hook = world.add_body(lariat.RigidBody.dynamic(translation=[1, 0, 0]), [lariat.Collider.ball(0.1, mass=5.0)])
    world.add_collider(lariat.Collider.cuboid(5.0, 0.1, 5.0).translation([0, -3, 0]), None)
    rope = world.add_cable(lariat.Cable([[0, 0, 0], [1, 0, 0]], SECTION, fix="start", name="rope"))
    return world, rope, world.attach(rope, "end", hook, [0, 0, 0])


def test_a_world_is_recorded_as_it_was(tmp_path: Path) -> None:
    world, rope, held = crane()
    recording = lariat.record(world, name="crane", probes={"hook": lambda: world.attachment(held).force, "time": lambda: world.time})
    last = np.empty(0)
    for _ in range(20):
        world.step()
        recording.take()
        last = rope.positions
    track, body = recording.cables["rope"], recording.bodies["body 0"]
    assert track.position.shape == (20, 11, 3)
    assert np.array_equal(track.position[-1], last)
    assert track.velocity.shape == (20, 11, 3) and track.tension.shape == (20, 11)
    assert np.allclose(track.arc_length[3], np.linspace(0, 1, 11))
    assert np.allclose(body.position[-1], last[-1], atol=1e-5)
    assert body.rotation.shape == (20, 4)
    assert np.allclose(track.t, world.time + (np.arange(20) - 19) / 60)
    assert recording.probes["hook"].rows.shape == (20, 4)
    assert recording.probes["time"].value[-1] == world.time
    page = data_of(recording.page())
    assert page["name"] == "crane" and [b["name"] for b in page["bodies"]] == ["body 0", ""]
    assert [p["name"] for p in page["probes"]] == ["hook", "time"]
    recording.save(tmp_path)
    with (tmp_path / "cables" / "rope.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 20 * 11
    assert float(rows[-1]["y"]) == last[-1, 1]
    assert (tmp_path / "view.html").exists() and (tmp_path / "probes" / "hook.csv").exists()
    assert (tmp_path / "bodies" / "body 0.csv").read_text().startswith("t,x,y,z,qx")
    assert recording.svg().startswith("<svg") and "srcdoc" in recording._repr_html_()


def test_a_cable_with_obstacles_and_one_that_changes_its_nodes() -> None:
    rope = lariat.Cable([[0, 1, 0], [2, 1, 0]], SECTION, fix="start", fidelity="game", effects=[lariat.Contact(radius=0.005)])
    rope.set_obstacles([lariat.Obstacle.half_space([0, 1, 0]), lariat.Obstacle.cylinder(1.0, 0.1, position=[1, 0.5, 0])])
    recording = lariat.record(rope)
    for _ in range(5):
        recording.take()
        rope.step(1 / 60)
    shapes = [body["shape"] for body in data_of(recording.page())["bodies"]]
    assert shapes == [{"plane": [0.0, 1.0, 0.0]}, {"cylinder": [1.0, 0.1]}]

    hoist = lariat.Cable([[0, 1, 0], [0, -2, 0]], SECTION, fix="start", fidelity="game")
    hoist.add_reel("start", lariat.Reel(2.0, stock=50.0))
    wound = lariat.record([hoist])
    for _ in range(120):
        hoist.step(1 / 60)
        wound.take()
    lengths = {len(position) for position in wound.cables["cable"].position}
    assert len(lengths) > 1 and len(wound) == 120


def test_a_scene_has_its_names_and_a_cable_that_breaks_gets_a_track_of_its_own() -> None:
    world = lariat.load(Path(__file__).parents[3] / "assets" / "scenes" / "payload_pendulum.toml")
    recording = lariat.record(world)
    recording.take()
    world.step()
    world.cut(world.cable("sling"), 1.0)
    recording.take()
    assert list(recording.bodies) == ["crate"]
    assert [len(track) for track in recording.cables.values()] == [2, 1]


def test_what_is_no_cable_and_probes_that_change_are_refused() -> None:
    with pytest.raises(TypeError, match="World"):
        lariat.record([])
    with pytest.raises(TypeError, match="World"):
        lariat.record([1.0])  # type: ignore[list-item]
    sizes = iter([1, 2])
    rope = lariat.Cable([[0, 0, 0], [1, 0, 0]], SECTION, fix="start")
    recording = lariat.record(rope, probes={"odd": lambda: np.zeros(next(sizes))})
    recording.take()
    with pytest.raises(ValueError, match="odd"):
        recording.take()
    assert len(recording) == 1 and len(recording.probes["odd"]) == 1


def test_a_cosimulation_is_recorded() -> None:
    coupling = lariat.CoSimulation(lariat.Cable([[0, 0, 0], [0, -2, 0]], SECTION, fix="start"))
    coupling.attach("end", [0, -2, 0])
    recording = lariat.record(coupling)
    recording.take()
    coupling.step(0.002, [[0, -2, 0]])
    recording.take()
    assert recording.cables["cable"].t[-1] == 0.002
