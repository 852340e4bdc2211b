"""The implicit exchange of forces and poses between a cable and bodies of another program.

# Equation

The program moves its bodies under the mean forces F of the cables over a step, ``pose = move(F)``, and the cable that follows them gives
back its own, ``F' = cable(pose)``. The exchange is done when both are the same::

    G(F) = cable(move(F)) - F = 0

solved by Broyden's method in variables that weigh each force by the root of the mobility it acts on. The first matrix is the linear
prediction ``B = 1 + Z R/h``: R is the velocity that a unit force gives the bodies over the step h, and Z the impedance of the cable,
with the weights of the trapezoidal rule (`CoSimulation.impedance` of half the step).

# Validity

Stable for any ratio of the masses while a step is shorter than waves take to and fro along the cable, and for bodies heavier than the cable in any,
since nothing is extrapolated from step to step: what a body gets is what the cable gave in the same
step. It makes no energy, and takes none, if the program moves its bodies by the mean of the velocities before and after the step, as the
trapezoidal rule, RK4 and exact integration of a constant force do, and if the cable takes one step in each, as the discrete gradient does
(fidelity game; its numerical dissipation is the cable's own). Of a cable that takes many, as others do, forces vary within a step while the
body gets their mean, so that the work F dx on the body is not that of the cable: of bodies lighter than a cable it may grow. The sum of what is made
so is told once it is `MADE` of the work exchanged. Bodies lighter than the cable, in steps within which waves run to
and fro along it, may gain energy in the cable itself; that is told before the first step. Where a cable whips, its forces jump with the motion, and none may agree: the nearest are
taken, if they are `CLOSE`, the bodies get the rest of the momentum in the next step, and the first such step is told. A program that moves them by the velocity after the step
(semi-implicit Euler) damps a swing of angular frequency w along the cable at a rate of about w^2 h/4.

# References

Degroote, Bathe, Vierendeels, Performance of a new partitioned procedure versus a monolithic procedure in fluid-structure interaction,
2009. Broyden, A class of methods for solving nonlinear simultaneous equations, 1965.

# Alternatives

The explicit exchange, `CoSimulation.step` once per step with the last forces: cheaper, and stable only where the impedance of the cable
is small beside the mass of the bodies.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lariat_cables import errors
from lariat_cables._lariat import CoSimulation
from lariat_cables.results import EndForces

Array = NDArray[np.float64]

TOLERANCE = 1e-9
"""Largest difference of both forces, as a share of the forces of the step: far below what any integrator leaves."""
MOST_TRIALS = 30
"""Most trials of a step. Smooth steps take 3 to 6, those in which a cable becomes taut up to some 20."""
CLOSE = 0.1
"""Largest difference of both forces, as a share of the largest, that a step may leave where no forces agree: the next step gives the bodies what
they lack of it."""
ROUNDING = 64 * np.finfo(float).eps
"""Relative error of a position: what the stiffness of the cable makes of it is no difference of forces."""
REMEASURE = 10
"""Trials from which on the mobility of the bodies is measured anew: the linear prediction was poor."""


MADE = 0.05
"""Share of all work exchanged so far, to and fro, or of the largest energy of motion of the cable, that an exchange may make before it says so."""
STARTS = 10
"""Steps at the start that do not count: bodies may start at other velocities than their ends, and the shock is theirs."""


class EndMotion(NamedTuple):
    """Where bodies are at the end of a step, and how fast: as the arguments of ``CoSimulation.step``."""

    positions: ArrayLike
    """Of the reference points in m, shape (ends, 3)."""
    rotations: ArrayLike | None = None
    """Quaternions x, y, z, w, shape (ends, 4); default: unchanged."""
    velocities: ArrayLike | None = None
    """In m/s, shape (ends, 3); default: uniform motion."""
    angular_velocities: ArrayLike | None = None
    """In rad/s, shape (ends, 3); default: uniform motion."""


class Exchanged(NamedTuple):
    """What an exchange agreed on."""

    forces: EndForces
    """What the cable did to the bodies over the step."""
    motion: EndMotion
    """Where the bodies are."""
    trials: int
    """Times that the bodies were moved."""


Move = Callable[[Array, Array], EndMotion]


class Exchange:
    """Steps a cable and bodies of another program together, for any ratio of their masses.

    ``step(dt, move)`` calls ``move(force, moment)`` some times, with constant forces (N) and moments (N m, about the reference points) on
    the bodies over the step, both of shape (ends, 3). Each call starts from the same state of the program, the one before the step, and
    returns an ``EndMotion``. The last call is the one that holds.
    """

    def __init__(self, coupling: CoSimulation) -> None:
        if not isinstance(coupling, CoSimulation):
            raise TypeError(f"expected a CoSimulation, which says where the ends of a cable are, got {type(coupling).__name__}")
        self.coupling = coupling
        self._forces: Array | None = None
        self._mobility: Array | None = None
        self._motion: EndMotion | None = None
        # forces in N that the last step owes the bodies
        self._owed: Array | float = 0.0
        # steps, and in J: what the cable did on the bodies, to and fro, what they got beyond it, and its largest energy of motion
        self._steps, self._work, self._made, self._motion_of_cable = 0, 0.0, 0.0, 0.0
        self._told: set[str] = set()

    def step(self, dt: float, move: Move) -> Exchanged:
        """Advances the cable by ``dt`` (s). Raises ExchangeError if no forces agree, and what ``CoSimulation.step`` raises; the cable is then
        as before."""
        before = self.coupling.snapshot()
        try:
            done = self._solve(dt, move, before)
        except BaseException:
            self.coupling.restore(before)
            raise
        self._judge(done)
        return done

    def _judge(self, done: Exchanged) -> None:
        """Sums the work that bodies got and the cable did not do."""
        before, self._motion = self._motion, done.motion
        self._steps += 1
        if before is None or self._steps <= STARTS:
            return
        self._work += float(np.abs(done.forces.work).sum())
        got = float((done.forces.force * (np.asarray(done.motion.positions, float) - np.asarray(before.positions, float))).sum())
        if done.motion.rotations is not None and before.rotations is not None:
            pairs = zip(done.forces.moment, before.rotations, done.motion.rotations, strict=True)  # type: ignore[arg-type]
            got += float(sum(moment @ _turn(first, last) for moment, first, last in pairs))
        self._made += got - float(done.forces.work.sum())
        # where hardly anything was exchanged yet, a share of that says nothing
        self._motion_of_cable = max(self._motion_of_cable, self.coupling.cable.energy().kinetic)
        scale = max(self._work, self._motion_of_cable)
        if self._made > MADE * scale:
            self._tell(
                "makes energy",
                f"{self._made:.1e} J until {self.coupling.cable.time:.4f} s, of {scale:.1e} J exchanged or in motion; take fidelity=\"game\", or a "
                "shorter step",
            )

    def _judge_step(self, dt: float, mobility: Array) -> None:
        """Says where the exchange is known to make energy: bodies lighter than the cable, in steps that waves run through it to and fro in."""
        cable = self.coupling.cable
        travel = cable.length * max((section.mass_per_length / section.axial_stiffness) ** 0.5 for section in cable.sections)
        weight = cable.length * max(section.mass_per_length for section in cable.sections)
        mobile = np.diag(mobility).reshape(-1, 6)[:, :3].max()
        if dt > 2.0 * travel and mobile * weight > dt:
            self._tell(
                "may make energy",
                f"a body of {dt / mobile:.1e} kg is lighter than the cable, {weight:.1e} kg, and waves run to and fro along it within a step of {dt} s: "
                f"take one of {2.0 * travel:.1e} s or less",
            )

    def _tell(self, what: str, details: str) -> None:
        if what not in self._told:
            self._told.add(what)
            name = self.coupling.cable.name
            warnings.warn(f"the exchange of cable {name!r} {what}: {details}", errors.ResultWarning, stacklevel=_outside())

    def _solve(self, dt: float, move: Move, before: bytes) -> Exchanged:
        z = self.coupling.impedance(0.5 * dt)
        size = len(z)
        force = np.zeros(size) if self._forces is None or len(self._forces) != size else self._forces
        if self._mobility is None or len(self._mobility) != size:
            self._mobility = measure(move, force, dt)
            self._judge_step(dt, self._mobility)
        linear = np.eye(size) + z @ self._mobility / dt
        weight = np.sqrt(np.abs(np.diag(self._mobility)))
        weight[weight == 0.0] = 1.0
        inverse = weight[:, None] * np.linalg.inv(linear) / weight
        stiffness = np.abs(z).max(axis=1) / dt**2

        change = miss = np.zeros(0)
        trials, nearest, best = 0, np.inf, force
        while trials < MOST_TRIALS:
            trials += 1
            motion = _moved(move(*_split(force + self._owed)))
            self.coupling.restore(before)
            try:
                forces = self.coupling.step(dt, *motion)
            except errors.StepFailedError:
                # too far from what the cable can follow: half way back
                if not change.size:
                    raise
                change = 0.5 * change
                force = force - change / weight
                continue
            given = _join(forces)
            last, miss = miss, weight * (given - force)
            size_of_both = float(np.maximum(np.abs(weight * given), np.abs(weight * force)).max())
            rounding = ROUNDING * float(np.abs(np.asarray(motion.positions)).max()) * stiffness * weight
            if (np.abs(miss) <= np.maximum(TOLERANCE * size_of_both, rounding)).all():
                self._forces, self._owed = given, given - force
                if trials >= REMEASURE:
                    self._mobility = None
                return Exchanged(forces, motion, trials)
            if float(np.abs(miss).max()) < nearest * size_of_both:
                nearest, best = float(np.abs(miss).max()) / size_of_both, force
            if change.size:
                answer = inverse @ (last - miss)
                along = float(change @ answer)
                if along != 0.0:
                    inverse = inverse + np.outer((change - answer) / along, change @ inverse)
            change = inverse @ miss
            force = force + change / weight
        self._mobility = None
        cable, value = self.coupling.cable, nearest
        if value > CLOSE:
            raise errors.ExchangeError(
                f"the forces of cable {cable.name!r} and the motion of its bodies do not agree after {MOST_TRIALS} trials: they miss each other by "
                f"{value:.1e} of the largest force; take a shorter step than {dt} s",
                value=value, cable=cable.name, time=cable.time,
            )  # fmt: skip
        motion = _moved(move(*_split(best + self._owed)))
        self.coupling.restore(before)
        forces = self.coupling.step(dt, *motion)
        self._forces, self._owed = _join(forces), _join(forces) - best
        details = f"by {value:.1e} of the largest force at {cable.time:.4f} s, and the bodies get the rest a step later; take a shorter step than {dt} s"
        self._tell("does not settle", details)
        return Exchanged(forces, motion, trials + 1)


def _split(force: Array) -> tuple[Array, Array]:
    rows = force.reshape(-1, 6)
    return rows[:, :3].copy(), rows[:, 3:].copy()


def _join(forces: EndForces) -> Array:
    return np.hstack([forces.force, forces.moment]).ravel()


def _turn(first: ArrayLike, last: ArrayLike) -> Array:
    """The rotation vector from one quaternion x, y, z, w to another."""
    a, b = np.asarray(first, float), np.asarray(last, float)
    vector = a[3] * b[:3] - b[3] * a[:3] + np.cross(a[:3], b[:3])
    scalar, size = float(a @ b), float(np.linalg.norm(vector))
    return vector * (2.0 * np.arctan2(size, abs(scalar)) / size * (1.0 if scalar >= 0.0 else -1.0)) if size > 0.0 else np.zeros(3)


def measure(move: Move, force: Array, dt: float) -> Array:
    """Returns the velocities that unit forces, then moments, give the bodies over a step beside those under ``force``, shape (6 ends, 6 ends)."""

    def velocity(at: Array) -> Array:
        motion = _moved(move(*_split(at)))
        linear = np.asarray(motion.positions, float) / dt if motion.velocities is None else np.asarray(motion.velocities, float)
        spin = np.zeros_like(linear) if motion.angular_velocities is None else np.asarray(motion.angular_velocities, float)
        return np.hstack([linear, spin]).ravel()

    still = velocity(force)
    return np.stack([velocity(force + unit) - still for unit in np.eye(len(force))], axis=1)


def _moved(motion: object) -> EndMotion:
    """Returns what ``move`` returned, if it is a motion of the ends."""
    if not isinstance(motion, tuple) or not 1 <= len(motion) <= len(EndMotion._fields):
        raise errors.InvalidValueError(f"move returns {type(motion).__name__}: it must return an EndMotion(positions, rotations, velocities, angular_velocities)")
    return EndMotion(*motion)


def _outside() -> int:
    """Returns the level of the first caller that is not of this package, for a warning that the caller of this function gives."""
    level, frame = 1, sys._getframe(1)
    while frame is not None and frame.f_globals.get("__name__", "").split(".")[0] == __name__.split(".")[0]:
        level, frame = level + 1, frame.f_back  # type: ignore[assignment]
    return level
