"""Writes docs/referee.md: the experiments of ``cosseratbench`` by Lariat, PyElastica and MuJoCo, in one run on one machine.

    python -m lariat_cables.referee_page --out docs/referee.md
"""

from __future__ import annotations

import argparse
import os
import platform
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

import lariat_cables as lariat

EXPERIMENTS = ("catenary", "cantilever", "pendulum", "capstan", "crossing", "twist", "pile")
VARIANTS: dict[str, list[dict[str, float]]] = {"capstan": [{"overhang": 0.95}, {"overhang": 1.1}], "crossing": [{}, {"drop": 0.2}], "pile": [{}]}
"""Parameters of experiments of which not all are run."""
OBSERVED = {"pile": ["max_rod_overlap"]}
"""Observations of the benchmark that the table has beside the metrics."""
SOLVERS = ("lariat", "pyelastica", "mujoco")
SHORT = 2.0
"""Runs below this wall time in s are made three times, and the shortest counts."""
REFINED = 4
"""Elements of a second run of Lariat's statics, which shows how far the reference itself is from the rod."""
MAIN = {"catenary": "sag_error", "cantilever": "tip_deflection_error", "pendulum": "period_error", "crossing": "shape_error", "twist": "critical_twist_error"}
"""The metric by which solvers are compared."""


def measure(experiment: Any, solver: Any, values: dict[str, float], refined: int = 1) -> Any:
    """Runs an experiment after a short one, which compiles what a solver compiles at its first run, with ``refined`` times its elements."""
    from dataclasses import replace

    from cosseratbench.experiment import run  # type: ignore[import-untyped, unused-ignore]

    scenario, elements = experiment.scenario_for(**values), refined * experiment.n_elements
    try:
        solver.run(replace(scenario, duration=scenario.duration / 100), n_elements=elements, n_frames=2)
    except Exception:  # noqa: BLE001 -- the run below reports it
        pass
    results = [run(experiment, solver, values=values, n_elements=elements)]
    while results[0].wall_time is not None and results[0].wall_time < SHORT and len(results) < 3:
        results.append(run(experiment, solver, values=values, n_elements=elements))
    return min(results, key=lambda result: result.wall_time or 0.0)


def solvers(names: list[str]) -> dict[str, Any]:
    """Returns the solvers by the name of their row."""
    from cosseratbench import registry  # type: ignore[import-untyped, unused-ignore]

    from lariat_cables.referee import PRESETS, LariatSolver

    made: dict[str, Any] = {}
    for name in names:
        if name == "lariat":
            made.update({f"lariat, {preset}": LariatSolver(preset=preset) for preset in PRESETS})
        else:
            made[name] = registry.load_solver(name)
    return made


def rows(experiment: Any, by_name: dict[str, Any], values: dict[str, float]) -> list[tuple[str, Any]]:
    """Returns the result of each solver; statics and contact do not depend on the preset, and have one row."""
    from lariat_cables.referee import touches

    found = []
    for name, solver in by_name.items():
        scenario = experiment.scenario_for(**values)
        if touches(scenario) and name.startswith("lariat") and name != "lariat, game":
            continue
        quasi_static = scenario.quasi_static and not touches(scenario)
        if quasi_static and name.startswith("lariat"):
            if name != "lariat, engineering":
                continue
            name = "lariat, statics"
        result = measure(experiment, solver, values)
        new = [(name, result)]
        if quasi_static and name.startswith("lariat"):
            new.append((f"{REFINED} times the elements", measure(experiment, solver, values, REFINED)))
        for name, result in new:
            print(experiment.name, values, name, result.outcome, dict(result.metrics), result.wall_time, flush=True)
        found += new
    if experiment.name == "crossing":
        found.append(("the reference at the nodes", at_nodes(experiment, values)))
    return found


def at_nodes(experiment: Any, values: dict[str, float]) -> Any:
    """Returns what the metrics make of the reference itself at the nodes of a solver; the points of the reference are equally far apart."""
    from cosseratbench.experiment import Result, score
    from cosseratbench.trajectory import Trajectory

    scenario, count = experiment.scenario_for(**values), experiment.n_elements
    curves = [
        np.stack([np.interp(np.linspace(0.0, 1.0, count + 1), np.linspace(0.0, 1.0, len(curve)), x) for x in curve.T], axis=1)
        for curve in experiment.reference(scenario)
    ]
    still = Trajectory(np.array([0.0, 1.0]), tuple(np.stack([c, c]) for c in curves), tuple(np.zeros((2, count, 3)) for _ in curves))
    metrics, observations = score(experiment, scenario, still)
    return Result(experiment.name, "reference", count, metrics=metrics, observations=observations)


def table(found: list[tuple[str, Any]], metrics: list[str]) -> str:
    """Returns rows as a table."""
    lines = ["| solver | " + " | ".join(m.replace("_", " ") for m in metrics) + " | wall s |", "|---" * (len(metrics) + 2) + "|"]
    for name, result in found:
        read = {**result.observations, **result.metrics}
        numbers = [f"{read[m]:.1e}" if m in read else result.outcome for m in metrics]
        lines.append(f"| {name} | {' | '.join(numbers)} | {f'{result.wall_time:.3g}' if result.wall_time else '-'} |")
    return "\n".join(lines)


def verdict(found: list[tuple[str, Any]], metric: str) -> str:
    """Returns a sentence about error and time of the most accurate row of Lariat beside the most accurate other solver."""
    done = [(name, result) for name, result in found if metric in result.metrics]
    ours = min((x for x in done if x[0].startswith("lariat")), key=lambda x: x[1].metrics[metric], default=None)
    others = min((x for x in done if x[0] in SOLVERS), key=lambda x: x[1].metrics[metric], default=None)
    if ours is None or others is None:
        return "No comparison: a solver did not complete."
    error, time = ours[1].metrics[metric] / others[1].metrics[metric], ours[1].wall_time / others[1].wall_time
    elastica = next((result for name, result in done if name == "pyelastica"), None)
    tenth = "" if elastica is None else f" PyElastica's time is {elastica.wall_time / ours[1].wall_time:.3g} times that of this row."
    return f"Beside {others[0]}, the most accurate other solver, `{ours[0]}` has {error:.2g} times its error in {time:.1e} of its time.{tenth}"


def catenary_section() -> str:
    """Returns what the distance of Lariat's catenaries from the reference is made of."""
    from lariat_cables.referee_catenary import section

    return section()


def exudyn_section() -> str:
    """Returns the section beside Exudyn; empty where that is not installed."""
    from importlib.util import find_spec

    if find_spec("exudyn") is None:
        print("no comparison with exudyn: pip install exudyn==1.13.6", flush=True)
        return ""
    from lariat_cables.referee_exudyn import section

    print("falling pendulum beside exudyn", flush=True)
    return section()


def machine() -> str:
    """Returns what the figures were measured on."""
    cpu = platform.processor() or platform.machine()
    if Path("/proc/cpuinfo").exists():
        models = [line.split(":", 1)[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")]
        cpu = models[0] if models else cpu
    packages = [f"{name} {version(name)}" for name in ("cosseratbench", "pyelastica", "mujoco", "numpy")]
    return f"Machine: {cpu}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.2f} at the start; Python {platform.python_version()}, lariat {lariat.__version__}, {', '.join(packages)}."


TEXT = """# An outside referee

[cosseratbench](https://pypi.org/project/cosseratbench/) is a benchmark of rods by others: they define the scenarios, the references and
the metrics, and the adapters of PyElastica and MuJoCo are theirs. Solvers take part through an adapter; that of Lariat is
`lariat.referee`. All rows of a table were made in the same run of

```sh
python -m lariat_cables.referee_page {flags}--out docs/referee.md
```

after a short run of each, which compiles what is compiled at the first use; of runs below 2 s the shortest of three counts. The number of elements is
that of the experiment, the same for all. Catenary and cantilever are quasi-static: Lariat solves them by statics, the others by damped
motion, as their adapters choose. A second row with more elements shows the distance of the converged rod from the reference: that of the catenary has no
bending stiffness, and errors below this distance mean nothing. On the capstan a rope should stay where it is below an overhang of 1, and slide off above; the slide
is no error there.

Rods that touch rods are stepped by fidelity `game`, with contact so stiff that the weight of all rods on one element has a depth of a percent of a radius. At the
crossing Lariat settles by the damping of the other adapters and by internal damping, and ends when no node moves by more than 1e-4 rod lengths per second. That
matters for stiff ropes: with 1e7 Pa the symmetric shape of the reference is no stable equilibrium of ropes without friction; what differs from it grows by
exp(5.7 t/s), on 51, 101 and 201 elements alike, and who goes on ends elsewhere. The metric `lift` reads the node behind the middle, for between an odd number of
elements there is none in the middle: the last row is what the metrics make of the reference itself. The pile has no reference: it shows that the coils do not pass
into each other, and what the run costs. The rods of
twist have ends that turn and slide; each is held just below or beyond the twist of Greenhill, and how fast those beyond it grow tells the critical
twist, which the benchmark calls good to 0.5 %. It gives no number, nan, where fewer than three rods grow.

{machine}
"""


def main() -> None:
    """Writes the page."""
    from cosseratbench import registry

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--solver", action="append", help="solvers to run (default: all three)")
    parser.add_argument("--experiment", action="append", choices=EXPERIMENTS, help="experiments to run (default: all)")
    parser.add_argument("--default-only", action="store_true", help="leave out the other parameters of the experiments")
    arguments = parser.parse_args()
    flags = "--default-only " if arguments.default_only else ""
    text = TEXT.format(machine=machine(), flags=flags)
    by_name = solvers(arguments.solver or list(SOLVERS))
    for name in arguments.experiment or EXPERIMENTS:
        experiment = registry.load_experiment(name)
        text += f"\n## {name.capitalize()}\n\n{experiment.description}\n"
        variants = [dict[str, float]()]
        if not arguments.default_only:
            variants += [{p.name: v} for p in experiment.parameters for v in p.values if v != p.default]
        variants = VARIANTS.get(name, variants)[: 1 if arguments.default_only and name != "capstan" else None]
        for values in variants:
            title = ", ".join(f"{key} = {value:g}" for key, value in experiment.values(**values).items())
            found = rows(experiment, by_name, values)
            text += (f"\n**{title}**\n" if title else "") + f"\n{table(found, [*experiment.metrics, *OBSERVED.get(name, [])])}\n"
            text += f"\n{verdict(found, MAIN[name])}\n" if name in MAIN else ""
        text += catenary_section() if name == "catenary" else ""
    if not arguments.default_only:
        text += exudyn_section()
    arguments.out.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
