"""Sweeps: rows, failures, restart, threads, a cluster of Dask."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from common import SCENES

import lariat

SCENE = SCENES / "falling_pendulum.toml"
GRID = {"cable.0.elements": [2, 3, 4], "duration": [0.1, -1.0, 0.2]}


def test_each_combination_is_a_row_and_failures_lose_none() -> None:
    sweep = lariat.sweep(SCENE, GRID, progress=False)
    assert len(sweep) == 9 and [e is None for e in sweep.errors] == [True, False, True] * 3
    assert "duration" in (sweep.errors[1] or "")
    for settings, row in zip(sweep.settings, sweep.rows):
        if row["error"] is None:
            run = lariat.run(SCENE, set=settings, progress=False)
            assert row["results"]["simulated_s"] == run.summary["simulated_s"] == settings["duration"]
            name, probe = next(iter(run.probes.items()))
            for column in probe.columns[1:]:
                assert row["results"][f"{name}.{column}.last"] == probe[column][-1]
                assert row["results"][f"{name}.{column}.max"] == probe[column].max()


def test_what_all_runs_refuse_is_raised() -> None:
    with pytest.raises(lariat.Error) as error:
        lariat.sweep(SCENE, {"cable.0.elemnts": [2, 3]}, progress=False)
    assert "elements" in str(error.value)


def test_ctrl_c_ends_a_sweep_in_the_middle_of_its_runs() -> None:
    """Runs of an hour of the pendulum take minutes; signals reach the main thread alone, which waits for the threads of Rust."""
    code = (
        "import lariat, sys\n"
        "print('begins', flush=True)\n"
        f"lariat.sweep({str(SCENE)!r}, {{'duration': [3600.0, 3601.0, 3602.0]}}, progress=False)\n"
    )
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout is not None and process.stdout.readline() == "begins\n"
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=60)
    assert process.returncode != 0 and "KeyboardInterrupt" in told


def test_tables_have_a_row_for_each_run() -> None:
    sweep = lariat.sweep(SCENE, GRID, progress=False)
    arrays = sweep.arrays()
    assert arrays["cable.0.elements"].tolist() == [2, 2, 2, 3, 3, 3, 4, 4, 4]
    assert np.isnan(arrays["simulated_s"][1]) and arrays["error"][0] is None
    pandas = pytest.importorskip("pandas")
    table = sweep.table()
    assert isinstance(table, pandas.DataFrame) and len(table) == 9 and list(table.columns)[:2] == list(GRID)


def test_results_do_not_depend_on_threads() -> None:
    assert lariat.sweep(SCENE, GRID, threads=1, progress=False).same_results(lariat.sweep(SCENE, GRID, threads=2, progress=False))


def test_a_restart_runs_only_what_is_missing(tmp_path: Path) -> None:
    first = lariat.sweep(SCENE, {**GRID, "duration": [0.1, -1.0]}, out=tmp_path, progress=False)
    # a line that was not written to its end, as after a power failure
    with open(tmp_path / "rows.jsonl", "a", encoding="utf-8") as rows:
        rows.write('{"of": "')
    whole = lariat.sweep(SCENE, GRID, out=tmp_path, progress=False)
    done = {tuple(s.items()): row for s, row in zip(first.settings, first.rows)}
    for settings, row in zip(whole.settings, whole.rows):
        if tuple(settings.items()) in done:
            # times are those of the first run: it was not run again
            assert row == done[tuple(settings.items())]
    assert len((tmp_path / "rows.jsonl").read_text(encoding="utf-8").splitlines()) == 9 + 1
    assert len((tmp_path / "table.csv").read_text(encoding="utf-8").splitlines()) == 9 + 1
    assert whole.same_results(lariat.sweep(SCENE, GRID, progress=False))


def test_another_scene_in_the_same_folder_is_run(tmp_path: Path) -> None:
    lariat.sweep(SCENE, {"duration": [0.1]}, out=tmp_path, progress=False)
    text = SCENE.read_text(encoding="utf-8").replace("elements = 10", "elements = 5")
    other = lariat.sweep(text, {"duration": [0.1]}, out=tmp_path, progress=False)
    assert other.same_results(lariat.sweep(text, {"duration": [0.1]}, progress=False))


def test_two_hundred_runs_on_a_cluster_are_those_of_one_machine_bit_for_bit(tmp_path: Path) -> None:
    """Two workers, each a process; and a restart that finds everything done."""
    distributed = pytest.importorskip("distributed")
    grid = {"cable.0.elements": [2, 3, 4, 5], "cable.0.youngs_modulus": list(np.geomspace(1e7, 1e8, 25)), "duration": [0.05, 0.1]}
    local = lariat.sweep(SCENE, grid, progress=False)
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            remote = lariat.sweep(SCENE, grid, client=client, out=tmp_path, progress=False)
            again = lariat.sweep(SCENE, grid, client=client, out=tmp_path, progress=False)
    assert len(remote) == 200 and remote.errors == [None] * 200
    assert remote.same_results(local)
    assert again.rows == remote.rows
