"""Cables of MuJoCo models: vertices, mass and supports are those that MuJoCo itself reads from the same model."""

from __future__ import annotations

import tomllib
import sys
from typing import Any

import numpy as np
import pytest

import lariat_cables as lariat
from lariat_cables import errors

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

mujoco = pytest.importorskip("mujoco")

PLUGIN = """<plugin plugin="mujoco.elasticity.cable"><config key="twist" value="1e6"/><config key="bend" value="4e6"/></plugin>
<joint kind="main" damping="0.01"/>"""
CURVES = [
    ('curve="s" count="9 1 1" size="1.5" offset="0.1 0.2 0.3"', "ball"),
    ('curve="cos(s) sin(s) 0" count="21 1 1" size="1.2 .3 1" offset="0.1 0.2 0.3" quat="0.5 0.5 -0.5 0.5"', "none"),
    ('vertex="0 0 0  0.5 0 0.1  1 0 0.1  1.2 0 0.3"', "free"),
]


def model(curve: str, initial: str, geom: str = 'type="capsule" size=".005" density="1200"') -> str:
    return f"""<mujoco><option gravity="0 0 -3"/><extension><plugin plugin="mujoco.elasticity.cable"/></extension><worldbody>
<body pos="0 0 1" quat="0.8 0 0 0.6"><body pos="0.3 0 0"><composite type="cable" prefix="A_" {curve} initial="{initial}">
{PLUGIN}<geom {geom}/></composite></body></body></worldbody>
<equality><connect body1="A_B_last" anchor="0.04 0 0"/></equality></mujoco>"""


@pytest.mark.parametrize(("curve", "initial"), CURVES)
def test_a_composite_is_the_cable_that_mujoco_reads(curve: str, initial: str) -> None:
    text = model(curve, initial)
    if initial == "free":  # which MuJoCo takes on the world alone
        text = text.replace('<body pos="0 0 1" quat="0.8 0 0 0.6"><body pos="0.3 0 0">', "").replace("</body></body>", "")
    scene: dict[str, Any] = tomllib.loads(lariat.import_mjcf(text))
    cable = scene["cable"][0]
    theirs = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(theirs)
    mujoco.mj_forward(theirs, data)
    bodies = [i for i in range(theirs.nbody) if theirs.body(i).name.startswith("A_B_")]
    vertices = np.vstack([data.xpos[bodies], data.site("A_S_last").xpos])
    # a bent composite is drawn finer, through the vertices
    points = np.array(cable["points"])
    assert points[:: (len(points) - 1) // len(bodies)] == pytest.approx(vertices, abs=1e-6)
    assert cable["elements"] == len(bodies) and cable["name"] == "A" and scene["gravity"] == [0, 0, -3]
    held = [(a["at"], a.get("kind", "ball")) for a in scene["attachment"]]
    assert held[:-1] == {"ball": [("start", "ball")], "none": [("start", "clamp")], "free": []}[initial]
    # the anchor is 0.04 m from the last vertex but one; a bent composite is a little longer than its chords
    length = np.linalg.norm(np.diff(vertices, axis=0), axis=1)
    at = length.sum() if held[-1][0] == "end" else held[-1][0]
    assert held[-1][1] == "ball" and at == pytest.approx(length[:-1].sum() + 0.04, rel=0.03)
    assert lariat.run(scene, set={"duration": 0.01}).summary["failed"] is None


def test_mass_and_stiffness_are_those_of_the_geom() -> None:
    text = model(*CURVES[0]).replace('gravity="0 0 -3"', 'gravity="0 0 0"')
    by_density = tomllib.loads(lariat.import_mjcf(text))["cable"][0]
    assert by_density["youngs_modulus"] == 4e6 and by_density["section"] == {"round": 0.01}
    theirs = mujoco.MjModel.from_xml_string(text)  # with the half balls at both ends of each capsule
    assert by_density["density"] * np.pi * 0.005**2 * 1.5 == pytest.approx(theirs.body_mass.sum(), rel=1e-9)
    by_mass = tomllib.loads(lariat.import_mjcf(model(*CURVES[0], geom='type="box" size="0.1 .004 .004" mass="0.02"')))["cable"][0]
    assert by_mass["mass_per_length"] == pytest.approx(8 * 0.02 / 1.5)
    assert by_mass["axial_stiffness"] == pytest.approx(8 * 0.02 * 3 * 1e5)  # MuJoCo's cable does not stretch
    assert by_mass["bending_stiffness"] == pytest.approx(4e6 * 0.008**4 / 12)


def test_damping_of_joints_slows_bending_as_in_mujoco() -> None:
    """The torque c w of a joint between segments of length l is the moment EI tau w/l: tau = c l/EI."""
    cable = tomllib.loads(lariat.import_mjcf(model(*CURVES[0])))["cable"][0]
    stiffness = 4e6 * np.pi * 0.005**4 / 4
    assert cable["damping"]["bending"] == pytest.approx(0.01 * (1.5 / 8) / stiffness)


def test_a_flexcomp_of_one_dimension_is_the_cable_that_mujoco_reads() -> None:
    text = """<mujoco><worldbody><flexcomp name="F" type="grid" dim="1" count="6 1 1" spacing=".2 .1 .1" pos="0 0 1" radius=".01" mass="0.6">
<edge stiffness="100"/><pin id="0 5"/></flexcomp></worldbody></mujoco>"""
    scene = tomllib.loads(lariat.import_mjcf(text))
    theirs = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(theirs)
    mujoco.mj_forward(theirs, data)
    cable = scene["cable"][0]
    assert np.array(cable["points"]) == pytest.approx(data.flexvert_xpos, abs=1e-9)
    assert cable["axial_stiffness"] == pytest.approx(100 * 0.2) and cable["mass_per_length"] == pytest.approx(0.6)
    assert [a["at"] for a in scene["attachment"]] == ["start", "end"]
    assert lariat.run(scene, set={"duration": 0.05}).summary["failed"] is None


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("<mujoco>", "<mujoco", "not XML"),
        ("mujoco>", "robot>", "not a model"),
        ('type="cable"', 'type="particle"', "composite"),
        ('<body pos="0.3 0 0">', '<body pos="0.3 0 0"><freejoint/>', "without a mass"),
        ('key="bend" value="4e6"', 'key="bend" value="0"', "bend"),
        ('type="capsule"', 'type="ellipsoid"', "ellipsoid"),
        ('curve="s"', 'curve="exp(s)"', "exp(s)"),
        ('count="9 1 1"', 'count="1 1 1"', "count"),
        ('size="1.5"', 'size="nan"', "nan"),
        ('body1="A_B_last"', 'body1="A_B_33"', "A_B_33"),
        ('quat="0.8 0 0 0.6"', 'euler="0 0 1" quat="1 0 0 0"', "euler"),
        ("<worldbody>", '<default class="a"><joint damp="1"/></default><worldbody>', "damp"),
        ('damping="0.01"', 'damping="0.01" armature="0.1"', "armature"),
        ("<worldbody>", '<include file="x.xml"/><worldbody>', "include"),
    ],
)
def test_what_cannot_be_imported_right_is_named(old: str, new: str, named: str) -> None:
    text = model(*CURVES[0])
    assert old in text
    with pytest.raises(errors.ImportError, match=named.replace("(", r"\(").replace(")", r"\)")):
        lariat.import_mjcf(text.replace(old, new))
