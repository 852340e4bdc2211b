"""A body of MuJoCo on a cable of Lariat: the payload pendulum, and the same body on MuJoCo's own cable beside it.

A crate of 50 kg hangs by its top face on a cable of 2 m and 0.8 kg and is released from horizontal. MuJoCo integrates by RK4: its
semi-implicit Euler method, the default, has an error of g h t/2 in free fall, which is 1e-2 m after 1 s. Per step of 1/500 s:

1. MuJoCo predicts the pose of the crate with the last force of the cable;
2. the cable moves its end there, and returns the mean force and moment on the crate;
3. MuJoCo steps with them.

The centre of the crate is compared with an independent monolithic code: (1.70292, -1.21801) m after 0.5 s and (-0.82138, -1.91419) m
after 1 s, with an error below 2e-5 m.

    pip install "lariat-cables" "mujoco<4"
    python mujoco_payload.py
"""

from __future__ import annotations

import time

import mujoco  # type: ignore[import-untyped, unused-ignore]
import numpy as np

import lariat_cables as lariat
from lariat_cables.types import Fidelity

REFERENCE = {0.5: (1.70292, -1.21801), 1.0: (-0.82138, -1.91419)}
SIDE, YOUNGS_MODULUS, DENSITY, LENGTH = 0.01, 1e9, 4000.0, 2.0
STEP = 1.0 / 500.0

CRATE = '<freejoint/><geom type="box" size="0.1 0.1 0.1" mass="50" contype="0" conaffinity="0"/>'


def error(times: list[float], places: list[np.ndarray]) -> dict[float, float]:
    """Distance in m from the reference."""
    path = np.array(places)
    return {t: float(np.hypot(*(path[np.argmin(np.abs(np.array(times) - t)), :2] - xy))) for t, xy in REFERENCE.items()}


def on_lariat(step: float = STEP, fidelity: Fidelity = "engineering") -> tuple[dict[float, float], float]:
    """Returns the errors in m and the wall time in s with the cable of Lariat."""
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{step}" gravity="0 -9.81 0" integrator="RK4"/>'
        f'<worldbody><body name="crate" pos="2 -0.1 0">{CRATE}</body></worldbody></mujoco>'
    )
    data, ahead = mujoco.MjData(model), mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    section = lariat.Section.square(SIDE, YOUNGS_MODULUS, DENSITY)
    cable = lariat.Cable([[0.0, 0.0, 0.0], [LENGTH, 0.0, 0.0]], section, elements=10, fix="start", fidelity=fidelity)
    coupling = lariat.CoSimulation(cable)
    crate = model.body("crate").id
    coupling.attach("end", data.xipos[crate])
    times, places = [0.0], [data.xipos[crate].copy()]
    begin = time.perf_counter()
    while data.time < 1.0 - 0.5 * step:
        # the pose that MuJoCo reaches with the last force
        mujoco.mj_copyData(ahead, model, data)
        mujoco.mj_step(model, ahead)
        w, x, y, z = ahead.qpos[3:7]
        # MuJoCo's angular velocity is in the axes of the body
        spin = np.zeros(3)
        mujoco.mju_rotVecQuat(spin, ahead.qvel[3:6], ahead.qpos[3:7])
        forces = coupling.step(step, [ahead.qpos[:3]], [[x, y, z, w]], [ahead.qvel[:3]], [spin])
        data.xfrc_applied[crate, :3] = forces.force[0]
        data.xfrc_applied[crate, 3:] = forces.moment[0]
        mujoco.mj_step(model, data)
        times.append(data.time)
        places.append(data.qpos[:3].copy())
    return error(times, places), time.perf_counter() - begin


def on_mujoco(segments: int, step: float) -> tuple[dict[float, float], float]:
    """Returns the errors in m and the wall time in s with MuJoCo's cable of this many segments, of the same mass and bending stiffness."""
    # the bending stiffness of a capsule of radius r is that of a round section: EI = E pi r^4/4
    radius = SIDE / 2
    bend = YOUNGS_MODULUS * SIDE**4 / 12 / (np.pi * radius**4 / 4)
    mass = DENSITY * SIDE**2 * LENGTH / segments
    vertices = np.zeros((segments + 1, 3))
    vertices[:, 0] = np.linspace(0.0, LENGTH, segments + 1)
    vertices[2, 1] = 1e-6 * LENGTH / segments  # the frame of a cable that starts straight is undefined
    model = mujoco.MjModel.from_xml_string(f"""
<mujoco>
  <extension><plugin plugin="mujoco.elasticity.cable"/></extension>
  <option timestep="{step}" gravity="0 -9.81 0" integrator="implicitfast"/>
  <worldbody>
    <composite type="cable" prefix="c_" initial="ball" vertex="{" ".join(map(str, vertices.ravel()))}">
      <plugin plugin="mujoco.elasticity.cable">
        <config key="bend" value="{bend}"/><config key="twist" value="{bend / 3}"/><config key="flat" value="true"/>
      </plugin>
      <joint kind="main" damping="0"/>
      <geom type="capsule" size="{radius}" mass="{mass}" contype="0" conaffinity="0"/>
    </composite>
    <body name="crate" pos="2 -0.1 0">{CRATE}</body>
  </worldbody>
  <equality>
    <connect body1="crate" body2="c_B_last" anchor="0 0.1 0" solref="{2 * step} 1" solimp="0.99 0.999 0.0001"/>
  </equality>
</mujoco>""")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    crate = model.body("crate").id
    times, places = [0.0], [data.xipos[crate].copy()]
    # a warning that it diverges would be written to a file, too
    mujoco.set_mju_user_warning(lambda _: None)
    begin = time.perf_counter()
    while data.time < 1.0 - 0.5 * step:
        mujoco.mj_step(model, data)
        times.append(data.time)
        places.append(data.xipos[crate].copy())
        if data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number:
            return dict.fromkeys(REFERENCE, float("nan")), time.perf_counter() - begin
    mujoco.mj_kinematics(model, data)
    return error(times, places), time.perf_counter() - begin


def main() -> None:
    """Prints the table, and checks the first row."""
    rows = [
        ("Lariat, 10 elements, 1/500 s", *on_lariat()),
        ("Lariat, 10 elements, 1/500 s, game", *on_lariat(fidelity="game")),
        ("MuJoCo's cable, 10 segments, 1/500 s", *on_mujoco(10, STEP)),
        ("MuJoCo's cable, 10 segments, 1/4000 s", *on_mujoco(10, STEP / 8)),
        ("MuJoCo's cable, 40 segments, 1/16000 s", *on_mujoco(40, STEP / 32)),
    ]
    print("| cable | error at 0.5 s, m | error at 1 s, m | wall ms |\n|---|---:|---:|---:|")
    for name, errors, wall in rows:
        half, whole = ("diverged" if np.isnan(x) else f"{x:.1e}" for x in (errors[0.5], errors[1.0]))
        print(f"| {name} | {half} | {whole} | {1e3 * wall:.0f} |")
    assert max(rows[0][1].values()) < 1e-2, rows[0]


if __name__ == "__main__":
    main()
