"""Measures the wheel, and writes the figures into docs/python.md.

    python crates/lariat-python/measure.py --wheel target/python/wheels/*.whl --into docs/python.md
"""

from __future__ import annotations

import argparse
import os
import platform
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "examples"))
SCENE = HERE.parents[1] / "assets" / "scenes" / "falling_pendulum.toml"


def import_time() -> tuple[float, float]:
    """Shortest wall time in ms of ``import numpy`` and of ``import lariat_cables`` after it, of ten processes."""
    code = (
        "import time; a = time.perf_counter(); import numpy; b = time.perf_counter(); import lariat_cables; "
        "print(b - a, time.perf_counter() - b)"
    )
    runs = [subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split() for _ in range(10)]
    numpy, lariat = (1e3 * min(float(run[i]) for run in runs) for i in (0, 1))
    return numpy, lariat


def step_overhead() -> tuple[float, float, float]:
    """Wall time in us of a step called from Python, of one in a loop of Rust, and their difference: smallest of 40 pairs of 1000 steps."""
    import lariat_cables as lariat

    section = lariat.Section.square(0.01, 1e8, 4000.0)
    python, rust = [], []
    for _ in range(40):
        cable = lariat.Cable([[0, 0, 0], [2, 0, 0]], section, elements=1, fix="start", integrator=lariat.Integrator("verlet", stable=0.9))
        other = cable.copy()
        begin = time.perf_counter()
        for _ in range(1000):
            cable.step(1e-5)
        python.append(time.perf_counter() - begin)
        begin = time.perf_counter()
        other.step(1e-5, steps=1000)
        rust.append(time.perf_counter() - begin)
        assert cable.to_bytes() == other.to_bytes()
    called, looped = 1e3 * min(python), 1e3 * min(rust)
    return called, looped, called - looped


def mujoco_table() -> list[str]:
    """The rows of the example with MuJoCo."""
    output = subprocess.run([sys.executable, str(HERE / "examples" / "mujoco_payload.py")], capture_output=True, text=True, check=True)
    return [line for line in output.stdout.splitlines() if line.startswith("|")]


def sweep_times() -> list[tuple[str, float]]:
    """Shortest wall time in s of three sweeps of 200 runs by threads and by workers of Dask; results are checked to be the same bit for bit."""
    import numpy as np
    from distributed import Client, LocalCluster

    import lariat_cables as lariat

    grid = {"cable.0.elements": [10, 12, 14, 16], "cable.0.youngs_modulus": list(np.geomspace(1e7, 1e8, 50)), "duration": [2.0]}
    times, sweeps = [], []

    def timed(name: str, **arguments: object) -> None:
        walls = []
        for _ in range(3):
            begin = time.perf_counter()
            sweeps.append(lariat.sweep(SCENE, grid, progress=False, **arguments))
            walls.append(time.perf_counter() - begin)
        times.append((name, min(walls)))

    for threads in (1, 2):
        timed(f"{threads} thread{'s' * (threads > 1)}", threads=threads)
    for workers in (1, 2):
        with LocalCluster(n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=None) as cluster, Client(cluster) as client:
            # the workers import lariat_cables
            lariat.sweep(SCENE, {"duration": [0.01] * workers}, client=client, progress=False)
            timed(f"Dask, {workers} worker{'s' * (workers > 1)}", client=client)
    assert all(sweep.same_results(sweeps[0]) for sweep in sweeps)
    assert sweeps[0].errors == [None] * 200
    return times


def machine() -> str:
    """What the figures were measured on."""
    models = [line.split(":", 1)[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")]
    cpu = models[0] if models else platform.machine()
    return f"Machine: {cpu}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.2f} at the start; Python {platform.python_version()}."


def main() -> None:
    """Writes the figures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--wheel", type=Path, required=True)
    parser.add_argument("--into", type=Path, required=True)
    arguments = parser.parse_args()
    about, busy = machine(), os.getloadavg()[0] > 0.5
    numpy, lariat = import_time()
    called, looped, overhead = step_overhead()
    times = sweep_times()
    one = {name: wall for name, wall in times}
    lines = [
        f"- The wheel has {arguments.wheel.stat().st_size / 1e6:.1f} MB. `import lariat_cables` takes {lariat:.0f} ms after `import numpy`, which takes {numpy:.0f} ms.",
        f"- A call of `step` costs {overhead:.2f} us more than a step in Rust ({called:.2f} us beside {looped:.2f} us, one element, one step of Verlet).",
        "",
        "A crate of 50 kg in MuJoCo on a cable, released from horizontal, against an independent monolithic code "
        "([the example](../crates/lariat-python/examples/mujoco_payload.py)). MuJoCo's own cable does not stretch.",
        "",
        *mujoco_table(),
        "",
        "200 runs of the falling pendulum, 2 s each, 10 to 16 elements, the shortest of three sweeps; all sweeps have the same results bit for bit:",
        "",
        "| by | wall s |",
        "|---|---:|",
        *(f"| {name} | {wall:.2f} |" for name, wall in times),
        "",
        f"From 1 to 2 threads: {one['1 thread'] / one['2 threads']:.2f} times as fast; from 1 to 2 workers: "
        f"{one['Dask, 1 worker'] / one['Dask, 2 workers']:.2f} times.",
        "",
        about,
    ]
    if busy:
        lines.append("Other programs ran at the same time: walls are too long, and the scaling says nothing about this one.")
    page = arguments.into.read_text(encoding="utf-8")
    before, rest = page.split("<!-- measured -->\n", 1)
    _, after = rest.split("<!-- /measured -->", 1)
    arguments.into.write_text(before + "<!-- measured -->\n" + "\n".join(lines) + "\n<!-- /measured -->" + after, encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
