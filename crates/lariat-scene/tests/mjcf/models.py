"""Writes models of the kinds of MuJoCo's public cables into models/, and where MuJoCo has their tips after 1 s into tips.csv.

pip install mujoco==3.17.0 && python models.py
"""

import csv
import math
import sys
from pathlib import Path

import mujoco

HERE = Path(__file__).parent
PLUGIN = '<extension><plugin plugin="mujoco.elasticity.cable"/></extension>'


def composite(
    n=20,
    line="s",
    length=1.0,
    initial="none",
    offset="0 0 1",
    bend="1e7",
    damping=0.002,
    joint="",
    geom='type="cylinder" size=".004" density="1200" contype="0" conaffinity="0"',
    prefix="c_",
    config="",
    shape="",
):
    """A cable of n segments; `damping` is that of a joint of 20 segments a metre, so that more segments are the same cable."""
    shape = shape or f'curve="{line}" count="{n + 1} 1 1" size="{length}"'
    return f"""<composite prefix="{prefix}" type="cable" {shape} offset="{offset}" initial="{initial}">
      <plugin plugin="mujoco.elasticity.cable"><config key="twist" value="4e6"/><config key="bend" value="{bend}"/>{config}</plugin>
      <joint kind="main" damping="{damping * n / 20 / length:g}" {joint}/>
      <geom {geom}/>
    </composite>"""


def circle(n, radius=0.5, angle=1.2):
    """Vertices of an arc that starts along x and bends up."""
    points = ((radius * math.sin(angle * k / n), 0.0, radius * (1 - math.cos(angle * k / n))) for k in range(n + 1))
    return 'vertex="' + "  ".join(f"{x:.9g} {y:g} {z:.9g}" for x, y, z in points) + '"'


def model(world, option='<option timestep="0.0002"/>', rest="", before=""):
    return f"<mujoco>\n  {before}{PLUGIN}\n  {option}\n  <worldbody>\n    {world}\n  </worldbody>\n  {rest}\n</mujoco>\n"


FREE = '<option timestep="0.0002"><flag gravity="disable"/></option>'
TOUCHES = 'type="capsule" size=".005" density="1200" condim="1"'
GROUND = '<geom name="ground" type="plane" size="0 0 1" condim="1"/>'
ARC = {"length": 0.6, "damping": 0.01}


def models(s):
    """Returns models by name with s times the segments, and a point of each; no point if Lariat refuses it."""
    end = "c_S_last"
    return {
        # as MuJoCo's cable.xml: a cable between the world and a slider, over a floor that an included file has
        "cable": (
            f"""<mujoco model="Cable">
  <include file="floor_and_light.xml"/>
  {PLUGIN}
  <option timestep="0.0002"/>
  <statistic center="0 0 .3" extent="1"/>
  <visual><global elevation="-30"/></visual>
  <compiler autolimits="true"/>
  <size memory="50M"/>
  <worldbody>
    <composite type="cable" curve="s" count="{20 * s + 1} 1 1" size="1" offset="-.3 0 .6" initial="none">
      <plugin plugin="mujoco.elasticity.cable">
        <config key="twist" value="1e7"/><config key="bend" value="4e7"/><config key="vmax" value="0.05"/>
      </plugin>
      <joint kind="main" damping="{0.008 * s}"/>
      <geom type="cylinder" size=".005" rgba=".8 .2 .1 1" condim="1" contype="0"/>
    </composite>
    <body name="slider" pos=".7 0 .6"><joint type="slide" axis="1 0 0" damping="0"/><geom size=".02" condim="1"/></body>
  </worldbody>
  <equality><connect name="right_boundary" body1="B_last" body2="slider" anchor="{0.05 / s} 0 0"/></equality>
  <contact><exclude body1="B_last" body2="slider"/></contact>
  <actuator><motor site="S_last" gear="0 0 0 1 0 0" ctrlrange="-.03 .03"/></actuator>
</mujoco>
""",
            "S_last",
        ),
        "cantilever": (model(composite(20 * s)), end),
        "pendulum": (model(composite(20 * s, initial="ball", damping=0.0, bend="1e5")), end),
        "span_to_site": (
            model(
                composite(20 * s)
                + '<body name="pole" pos="1 0 0"><geom type="cylinder" size=".01 .5" contype="0" conaffinity="0"/>'
                '<site name="hook" pos="0 0 1"/></body>',
                rest='<equality><connect site1="c_S_last" site2="hook" solref=".002 1"/></equality>',
            ),
            f"c_B_{10 * s}",
        ),
        "inactive": (
            model(
                composite(20 * s, bend="1e8"),
                rest=f'<equality><connect body1="c_B_last" anchor="{0.05 / s} 0 0" active="false"/></equality>',
            ),
            end,
        ),
        "arc": (model(composite(10 * s, shape=circle(10 * s), **ARC), FREE), end),
        "arc_under_gravity": (model(composite(10 * s, bend="2e9", shape=circle(10 * s), **ARC)), end),
        "arc_flat": (
            model(composite(10 * s, shape=circle(10 * s), config='<config key="flat" value="true"/>', **ARC), FREE),
            end,
        ),
        "wind": (
            model(
                composite(20 * s, damping=0.01),
                '<option timestep="0.0002" density="1000" viscosity="0.001" wind="0 .8 0"/>',
            ),
            end,
        ),
        "floor": (
            model(GROUND + composite(10 * s, length=0.5, offset="0 0 .3", initial="free", geom=TOUCHES)),
            end,
        ),
        "mocap_and_load": (
            model(
                '<body name="hand" mocap="true" pos="0 0 1" euler="0 0 90">'
                + composite(20 * s, offset="0 0 0", damping=0.01)
                + '</body><body name="load" pos="0 1 1"><freejoint/><geom type="box" size=".05 .05 .05" mass=".05"/></body>',
                rest='<equality><weld body1="load" body2="c_B_last" solref=".002 1"/></equality>',
            ),
            "load",
        ),
        "arm": (
            model(
                '<body name="arm" pos="0 0 1"><joint type="hinge" axis="0 1 0"/>'
                '<geom type="capsule" fromto="0 0 0 .5 0 0" size=".04" contype="0" conaffinity="0"/>'
                + composite(10 * s, offset=".5 0 0", length=0.5, bend="1e8", damping=0.01)
                + "</body>"
            ),
            end,
        ),
        # bodies that are one with the first segment
        "hinged": (
            model(
                '<body name="hand" pos="0 0 1"><joint type="hinge" axis="0 1 0"/>'
                + composite(10 * s, offset="0 0 0", length=0.5, bend="1e8", damping=0.01)
                + "</body>"
            ),
            end,
        ),
        "thrown": (
            model(
                '<body name="hand" pos="0 0 1" euler="0 20 0"><freejoint/>'
                + composite(10 * s, offset="0 0 0", shape=circle(10 * s), config='<config key="flat" value="true"/>', **ARC)
                + "</body>",
            ),
            end,
        ),
        "springs": (model(composite(20 * s, joint=f'stiffness="{0.5 * s}"')), end),
        "flex": (
            f"""<mujoco>
  <option timestep="0.0002"/>
  <worldbody>
    <flexcomp name="r" type="grid" dim="1" count="{20 * s + 1} 1 1" spacing="{0.05 / s} .05 .05" pos="0 0 1" mass=".2" radius=".002">
      <edge stiffness="{2e4 * s}" damping="{2 * s}"/><contact contype="0" conaffinity="0"/><pin id="0 {20 * s}"/>
    </flexcomp>
  </worldbody>
</mujoco>
""",
            f"r_{10 * s}",
        ),
        "two_tied": (
            model(
                composite(10 * s, length=0.5, bend="1e8")
                + composite(10 * s, "0 0 s", prefix="d_", length=0.5, offset=".5 0 .5", initial="free"),
                rest=f'<equality><connect body1="d_B_last" body2="c_B_last" anchor="{0.05 / s} 0 0" solref=".002 1"/></equality>',
            ),
            "d_S_first",
        ),
        "defaults": (
            model(
                composite(20 * s, damping=0.01)
                + '<body name="load" pos="1 0 1" childclass="light"><freejoint/><geom/></body>',
                before='<default><geom contype="0" conaffinity="0"/><default class="light">'
                '<geom type="sphere" size=".03" mass=".03"/></default></default>\n  ',
                rest=f'<equality><connect body1="c_B_last" body2="load" anchor="{0.05 / s} 0 0" solref=".002 1"/></equality>',
            ),
            "load",
        ),
        # as MuJoCo's belt.xml, coil.xml, and with a spring beside it: refused by name
        "belt": (
            model(
                composite(
                    shape='vertex="0 0 0 .05 0 .05 .1 0 .1 .15 0 .15 .2 0 .2 .25 0 .15 .3 0 .1 .35 0 .05 .4 0 0"',
                    geom='type="box" size="0.0353 0.02 0.0015"',
                ),
                FREE,
                rest='<equality><connect body1="c_B_last" anchor=".07 0 0"/></equality>',
            ),
            "",
        ),
        "coil": (
            model(
                composite(
                    shape='curve="cos(s) sin(s) s" count="41 1 1" size="0.25 .1 4"', bend="15e8", joint='armature="0.01"'
                )
            ),
            "",
        ),
        "helix": (model(composite(shape='curve="cos(s) sin(s) s" count="41 1 1" size="0.25 .1 4"')), ""),
        "tendon": (
            model(
                composite(),
                rest='<tendon><spatial stiffness="100"><site site="c_S_last"/><site site="c_S_first"/></spatial></tendon>',
            ),
            "",
        ),
    }


FLOOR = """<mujoco>
  <compiler meshdir="asset" texturedir="asset"/>
  <statistic meansize=".05"/>
  <visual><rgba haze="0.15 0.25 0.35 1"/><quality shadowsize="4096"/></visual>
  <asset>
    <texture name="texplane" type="2d" builtin="checker" rgb1=".2 .3 .4" rgb2=".1 0.15 0.2" width="512" height="512"/>
    <material name="matplane" reflectance="0.3" texture="texplane" texrepeat="10 10" texuniform="true"/>
  </asset>
  <worldbody>
    <light diffuse=".4 .4 .4" specular="0.1 0.1 0.1" pos="0 0 2.0" dir="0 0 -1" castshadow="false"/>
    <geom name="ground" type="plane" size="0 0 1" pos="0 0 0" quat="1 0 0 0" material="matplane" condim="1"/>
  </worldbody>
</mujoco>
"""


def tip(model, data, name):
    if name.startswith("load") or "_B_" in name or name.startswith("r_"):
        return data.body(name).xpos
    return data.site(name).xpos


def run(path, point, step):
    loaded = mujoco.MjModel.from_xml_path(str(path))
    loaded.opt.timestep = step
    data = mujoco.MjData(loaded)
    while data.time < 1.0 - 1e-9:
        mujoco.mj_step(loaded, data)
    mass = sum(loaded.body(i).mass[0] for i in range(loaded.nbody) if "B_" in loaded.body(i).name)
    return tip(loaded, data, point).copy(), mass


AS_IS = {"wind"}
"""MuJoCo's fluid acts on both faces of each segment, so that more segments are another cable."""


def main() -> None:
    folder = HERE / "models"
    folder.mkdir(exist_ok=True)
    (folder / "floor_and_light.xml").write_text(FLOOR)
    fine = models(2)
    rows = []
    for name, (text, point) in models(1).items():
        (folder / f"{name}.xml").write_text(text)
        if not point or (sys.argv[1:] and name not in sys.argv[1:]):
            continue
        coarse, mass = run(folder / f"{name}.xml", point, 2e-4)
        (folder / "fine.xml").write_text(fine[name][0])
        twice, _ = run(folder / "fine.xml", fine[name][1], 1e-4)
        (folder / "fine.xml").unlink()
        # joints between rigid segments err in the first order of their length, most at a clamp
        limit = coarse if name in AS_IS else 2 * twice - coarse
        rows.append([name, point, *(f"{x:.5f}" for x in (*coarse, *limit)), f"{mass:.9g}"])
        print(rows[-1], flush=True)
    with (HERE / "tips.csv").open("w", newline="") as file:
        file.write(
            f"# MuJoCo {mujoco.__version__}, models.py: a point after 1 s as the model is, and the limit of many segments by "
            "twice as many (m); the mass of composites (kg)\n"
        )
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["model", "point", "x", "y", "z", "limit_x", "limit_y", "limit_z", "mass"])
        writer.writerows(rows)


if __name__ == "__main__":
    main()
