"""Bodies of MuJoCo on a cable: the implicit exchange of `lariat.exchange` with a model of MuJoCo.

# Validity

MuJoCo's RK4 moves bodies under a constant force by the mean velocity of a step, to the fourth order: no energy is made or taken. Its
other integrators, the default among them, move bodies by the velocity at the end of the step, and damp a swing of angular frequency w
along the cable at a rate of about w^2 h/4, which is told once. Needs the package ``mujoco``.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lariat_cables._lariat import CoSimulation
from lariat_cables.errors import ResultWarning
from lariat_cables.exchange import EndMotion, Exchange, Exchanged
from lariat_cables.water import GRAVITY

Array = NDArray[np.float64]


class MujocoExchange:
    """Steps a model of MuJoCo and a cable together, whose ends are held by bodies at their centres of mass (``data.xipos`` and ``data.xquat``)."""

    def __init__(self, model: Any, data: Any, cable: Any, ends: Sequence[tuple[Any, int | str]], *, clamp: bool = False) -> None:
        """Attaches the points of a cable to bodies, ``[("end", "crate")]``, where both are now. A cable whose gravity is the default,
        (0, -9.81, 0), takes that of the model, whose z axis is up by default. Raises what ``CoSimulation.attach`` raises, and KeyError
        for a body that is not there."""
        import mujoco  # type: ignore[import-untyped, unused-ignore]

        self._mujoco = mujoco
        self.model, self.data = model, data
        self.bodies = [model.body(body).id for _, body in ends]
        mujoco.mj_forward(model, data)
        if np.array_equal(cable.gravity, GRAVITY):
            cable.gravity = model.opt.gravity
        self.exchange = Exchange(CoSimulation(cable))
        for (at, _), body in zip(ends, self.bodies, strict=True):
            self.exchange.coupling.attach(at, data.xipos[body], _xyzw(data.xquat[body]), clamp=clamp)
        self._ahead = mujoco.MjData(model)
        if model.opt.integrator != mujoco.mjtIntegrator.mjINT_RK4:
            name = mujoco.mjtIntegrator(model.opt.integrator).name
            text = f"MuJoCo's integrator {name} moves bodies by the velocity at the end of a step, and damps them on a cable: set integrator=\"RK4\""
            warnings.warn(text, ResultWarning, stacklevel=2)

    def step(self) -> Exchanged:
        """Advances model and cable by the time step of the model. ``data.xfrc_applied`` of other bodies, controls and forces act as MuJoCo has
        them; that of the bodies at the ends is added to. Raises what ``Exchange.step`` raises; all is then as before."""
        mujoco, model = self._mujoco, self.model

        def move(force: Array, moment: Array) -> EndMotion:
            mujoco.mj_copyData(self._ahead, model, self.data)
            for body, f, m in zip(self.bodies, force, moment, strict=True):
                self._ahead.xfrc_applied[body, :3] += f
                self._ahead.xfrc_applied[body, 3:] += m
            mujoco.mj_step(model, self._ahead)
            self._ahead.xfrc_applied[:] = self.data.xfrc_applied
            # poses and velocities of bodies at the end of the step, not at its beginning
            mujoco.mj_kinematics(model, self._ahead)
            mujoco.mj_comPos(model, self._ahead)
            rates = np.zeros((len(self.bodies), 6))
            for row, body in zip(rates, self.bodies, strict=True):
                jacobian = np.zeros((6, model.nv))
                mujoco.mj_jacBodyCom(model, self._ahead, jacobian[:3], jacobian[3:], body)
                row[:] = jacobian @ self._ahead.qvel
            rotations = [_xyzw(self._ahead.xquat[body]) for body in self.bodies]
            return EndMotion(self._ahead.xipos[self.bodies].copy(), rotations, rates[:, :3], rates[:, 3:])

        done = self.exchange.step(model.opt.timestep, move)
        mujoco.mj_copyData(self.data, model, self._ahead)
        return done


def _xyzw(quaternion: Array) -> Array:
    return np.roll(np.asarray(quaternion, float), -1)
