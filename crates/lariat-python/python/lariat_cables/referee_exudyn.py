"""The falling pendulum by Lariat and by Exudyn, in one run: error against processor time. ``referee_page`` writes it into its page.

    python -m lariat_cables.referee_exudyn
"""

from __future__ import annotations

import time
from collections.abc import Callable
from importlib.metadata import version
from typing import Any, NamedTuple

import numpy as np

import lariat_cables as lariat
from lariat_cables.types import Array

ELEMENTS = 10
FRAME, FRAMES = 0.01, 200
SIDE, MODULUS, DENSITY, LENGTH = 0.01, 1e8, 4000.0, 2.0
TARGETS = (5.4e-4, 8e-6)
"""Errors in m at which the times are compared."""
REPEATS = 3
STEPS = (400, 800, 1200, 1600, 2400, 3200, 4800, 6400, 9600, 12_800, 19_200)
"""Numbers of steps, of which each frame is a whole number."""
REFERENCE_STEPS = 64_000
EXPLICIT_STEPS = 16_000
TOLERANCES = tuple(float(x) for x in 10.0 ** np.arange(-2.0, -8.1, -0.5))
RULES = ("projected-3", "projected-T1")
"""The default, and that of fidelity game."""
METHODS = ("esdirk4", "esdirk3", "tr-bdf2")
SUBSTEPS = (1, 2, 3, 4, 6, 8, 12)
SHARES = (1.0, 0.95, 0.7)
"""Steps of explicit methods over their stability limit."""


class Row(NamedTuple):
    """A run."""

    setting: str
    error: float
    """Largest distance of the tip from the reference in m, at 200 times."""
    cpu: float
    """Shortest processor time in s of three runs, without set-up; both run on one thread."""


def fastest(run: Callable[[], tuple[Array, float]]) -> tuple[Array, float]:
    """Returns the path of the tip, and the shortest time."""
    runs = [run() for _ in range(REPEATS)]
    return runs[0][0], min(cpu for _, cpu in runs)


def distance(path: Array, reference: Array) -> float:
    """Returns the largest distance of two paths."""
    return float(np.linalg.norm(path - reference, axis=1).max())


def by_lariat(integrator: lariat.Integrator | None, rule: str | None = None) -> tuple[Array, float]:
    """Runs Lariat; None is the untouched default."""
    section = lariat.Section.square(SIDE, MODULUS, DENSITY)
    chosen: dict[str, Any] = {} if integrator is None else {"integrator": integrator}
    cable = lariat.Cable([[0.0, 0.0, 0.0], [LENGTH, 0.0, 0.0]], section, elements=ELEMENTS, fix="start", rule=rule, **chosen)
    path = np.empty((FRAMES, 3))
    begin = time.process_time()
    for i in range(FRAMES):
        cable.step(FRAME)
        path[i] = cable.positions[-1]
    return path, time.process_time() - begin


def by_exudyn(steps: int, modified: bool = True, explicit: bool = False) -> tuple[Array, float]:
    """Runs Exudyn's ANCF cable in the plane: the trapezoidal rule with full or modified Newton's iteration, or the explicit RK44."""
    import exudyn  # type: ignore[import-not-found, unused-ignore]
    from exudyn import beams  # type: ignore[import-not-found, unused-ignore]
    from exudyn.itemInterface import ObjectANCFCable2D, SensorNode  # type: ignore[import-not-found, unused-ignore]

    # kept until the end: the system belongs to it
    container = exudyn.SystemContainer()
    system = container.AddSystem()
    template = ObjectANCFCable2D(
        massPerLength=DENSITY * SIDE**2,
        bendingStiffness=MODULUS * SIDE**4 / 12,
        axialStiffness=MODULUS * SIDE**2,
        useReducedOrderIntegration=1,
    )
    made = beams.GenerateBeamElementsAlongLine(  # type: ignore[no-untyped-call, unused-ignore]
        system,
        positionStart=[0, 0, 0],
        positionEnd=[LENGTH, 0, 0],
        numberOfElements=ELEMENTS,
        beamTemplate=template,
        gravity=[0, -9.81, 0],
        groundConstraintsStart=[True, True, False, False],
    )
    kind = exudyn.OutputVariableType.Position
    tip = SensorNode(nodeNumber=made["nodes"][-1], storeInternal=True, outputVariableType=kind)  # type: ignore[no-untyped-call, unused-ignore]
    sensor = system.AddSensor(tip)
    system.Assemble()
    settings = exudyn.SimulationSettings()
    integration = settings.timeIntegration
    integration.endTime = FRAME * FRAMES
    integration.numberOfSteps = steps
    integration.verboseMode = 0
    integration.newton.useModifiedNewton = modified
    integration.generalizedAlpha.spectralRadius = 1.0
    integration.automaticStepSize = False
    integration.explicit.eliminateConstraints = True
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = FRAME
    types = exudyn.DynamicSolverType
    begin = time.process_time()
    system.SolveDynamic(settings, solverType=types.RK44 if explicit else types.GeneralizedAlpha)
    cpu = time.process_time() - begin
    # time and position, from time 0 on
    path: Array = np.asarray(system.GetSensorStoredData(sensor))[1:, 1:4]
    return path, cpu


def converged(rule: str) -> Array:
    """Returns the converged motion of Lariat's model with a rule."""
    return by_lariat(lariat.Integrator("esdirk4", tolerance=1e-11), rule)[0]


def measure() -> tuple[list[Row], list[Row]]:
    """Runs all settings, and returns the rows of Lariat and of Exudyn, each against the converged motion of its own model."""
    theirs = by_exudyn(REFERENCE_STEPS)[0]
    first, second = [], []
    choices: list[tuple[str, lariat.Integrator | None]] = [("the untouched default", None)]
    choices += [(f"{m}, tolerance {t:.0e} m", lariat.Integrator(m, tolerance=t)) for m in METHODS for t in TOLERANCES]
    for method in lariat.integrators():
        try:
            choices += [(f"{method}, {x:g} of the stability limit", lariat.Integrator(method, stable=x)) for x in SHARES]
        except lariat.errors.NoStabilityLimitError:
            choices += [(f"{method}, {n} steps per 0.01 s", lariat.Integrator(method, substeps=n)) for n in SUBSTEPS]
    for rule in RULES:
        ours = converged(rule)
        for name, integrator in choices:
            try:
                path, cpu = fastest(lambda rule=rule, integrator=integrator: by_lariat(integrator, rule))  # type: ignore[misc]
            except lariat.errors.StepFailedError:
                # a step too long for its method is no row
                continue
            first.append(Row(f"{rule}, {name}", distance(path, ours), cpu))
    for modified in (True, False):
        for steps in STEPS:
            path, cpu = fastest(lambda steps=steps, modified=modified: by_exudyn(steps, modified))  # type: ignore[misc]
            name = f"trapezoidal rule, {steps} steps, {'modified' if modified else 'full'} Newton"
            second.append(Row(name, distance(path, theirs), cpu))
    return first, second


def section() -> str:
    """Returns the section of the page."""
    ours, theirs = measure()
    apart = distance(by_exudyn(EXPLICIT_STEPS, explicit=True)[0][-1:], by_exudyn(EXPLICIT_STEPS)[0][-1:])
    between = distance(*map(converged, RULES))
    text = f"""
## Falling pendulum, beside Exudyn {version("exudyn")}

The pendulum of `assets/scenes/falling_pendulum.toml`, 2 s, {ELEMENTS} elements, undamped. The error is the largest distance of the tip, at {FRAMES} times, from
the converged motion of the same model: the same elements with a step or a tolerance so small that it no longer counts. Exudyn is run by its trapezoidal rule (generalised-alpha
without dissipation) on its ANCF cable in the plane, which has two coordinates of three; its explicit solvers (RK44 with {EXPLICIT_STEPS}
steps) end {apart:.1e} m from that motion, and are left out. Lariat is run with the rules {" and ".join(RULES)}, each judged by its own converged motion; these are {between:.1e} m apart, which is of the size of the error of the mesh. Each row is
the fastest setting of those tried that has the error: {len(TOLERANCES)} tolerances of {", ".join(METHODS)}, {len(SUBSTEPS)} fixed steps of every implicit method, {len(SHARES)} of every explicit one, and the default; {len(STEPS)} steps of 1/200 to 1/9600 s with
full and modified Newton's iteration.

| error at most | solver | setting | error m | CPU ms | ratio |
|---|---|---|---|---|---|
"""
    for target in TARGETS:
        found = [min((row for row in rows if row.error <= target), key=lambda row: row.cpu, default=None) for rows in (ours, theirs)]
        for name, row in zip((f"lariat {lariat.__version__}", f"exudyn {version('exudyn')}"), found):
            if row is None:
                text += f"| {target:.1e} m | {name} | none reaches it | | | |\n"
                continue
            ratio = f"{row.cpu / found[0].cpu:.1f}" if found[0] is not None else ""
            text += f"| {target:.1e} m | {name} | {row.setting} | {row.error:.1e} | {1e3 * row.cpu:.1f} | {ratio} |\n"
    default = ours[0]
    return text + f"\nLariat's untouched default has an error of {default.error:.1e} m in {1e3 * default.cpu:.1f} ms.\n"


if __name__ == "__main__":
    print(section())
