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

import lariat_cables as lariat

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


def test_points_reductions_and_series_are_those_of_runs(tmp_path: Path) -> None:
    """Source: ``lariat.run`` of each point by itself."""
    points = [{"cable.0.elements": 3, "duration": 0.1}, {"cable.0.elements": 5}, {"duration": -1.0}]
    name = next(iter(lariat.run(SCENE, set={"duration": 0.05}, progress=False).probes))
    highest = {"highest": lambda run: float(run.probes[name].position[:, 1].max()), "samples": lambda run: len(run.t)}
    wanted = [name, f"{name}.position", f"{name}.x"]
    sweep = lariat.sweep(SCENE, {"cable.0.youngs_modulus": [1e8, 5e7]}, points=points, reduce=highest, series=wanted, out=tmp_path, progress=False)
    assert [s["cable.0.youngs_modulus"] for s in sweep.settings] == [1e8, 5e7] * 3 and sweep.settings[2]["cable.0.elements"] == 5
    assert [e is None for e in sweep.errors] == [True] * 4 + [False] * 2 and sweep.series[4] == {}
    for settings, row, series in list(zip(sweep.settings, sweep.rows, sweep.series))[:4]:
        run = lariat.run(SCENE, set=settings, progress=False)
        assert np.array_equal(series[name], run.probes[name].rows)
        assert np.array_equal(series[f"{name}.position"], run.probes[name].position)
        assert np.array_equal(series[f"{name}.x"], run.probes[name].x)
        assert row["results"]["highest"] == run.probes[name].position[:, 1].max() and row["results"]["samples"] == len(run.t)
        assert row["results"][f"{name}.x.last"] == run.probes[name].x[-1]
    assert np.isnan(sweep.arrays()["highest"][4]) and sweep.columns["duration"][2] is None
    # the folder has the reductions: nothing is run again, but for another name
    again = lariat.sweep(SCENE, points=sweep.settings, reduce=highest, out=tmp_path, progress=False)
    assert again.rows == sweep.rows
    other = lariat.sweep(SCENE, points=sweep.settings[:1], reduce={"two": lambda run: 2.0}, out=tmp_path, progress=False)
    assert other.rows[0]["results"]["two"] == 2.0
    plain = lariat.sweep(SCENE, points=points[:1], progress=False)
    assert plain.rows[0]["results"]["simulated_s"] == 0.1


def test_sweeps_refuse_what_they_cannot_reduce() -> None:
    with pytest.raises(lariat.errors.InvalidValueError):
        lariat.sweep(SCENE)
    with pytest.raises(lariat.errors.InvalidValueError, match="at least one point"):
        lariat.sweep(SCENE, points=[], progress=False)
    with pytest.raises(lariat.errors.InvalidValueError, match="at least one point"):
        lariat.sweep(SCENE, {"duration": []}, progress=False)
    with pytest.raises(lariat.errors.InvalidValueError, match="a list of settings"):
        lariat.sweep(SCENE, points={"duration": [0.05]}, progress=False)  # type: ignore[arg-type]
    with pytest.raises(lariat.errors.InvalidValueError, match="'times' of reduce returns ndarray"):
        lariat.sweep(SCENE, {"duration": [0.05]}, reduce={"times": lambda run: run.t}, progress=False)
    with pytest.raises(KeyError, match="there are"):
        lariat.sweep(SCENE, {"duration": [0.05]}, series=["nothing.x"], progress=False)
    with pytest.raises(ZeroDivisionError):
        lariat.sweep(SCENE, {"duration": [0.05, 3600.0]}, reduce={"wrong": lambda run: 1 / 0}, threads=2, progress=False)


def test_what_all_runs_refuse_is_raised() -> None:
    with pytest.raises(lariat.Error) as error:
        lariat.sweep(SCENE, {"cable.0.elemnts": [2, 3]}, progress=False)
    assert "elements" in str(error.value)


@pytest.mark.parametrize("reduce", ["", ", reduce={'one': lambda run: 1.0}"])
def test_ctrl_c_ends_a_sweep_in_the_middle_of_its_runs(reduce: str) -> None:
    """Runs of an hour of the pendulum take minutes; signals reach the main thread alone, which waits for the threads of Rust."""
    code = (
        "import sys, lariat_cables as lariat\n"
        "print('begins', flush=True)\n"
        f"lariat.sweep({str(SCENE)!r}, {{'duration': [3600.0, 3601.0, 3602.0]}}, progress=False{reduce})\n"
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
        rows.write('{"of":"')
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
            few = {**grid, "cable.0.youngs_modulus": [1e8], "duration": [0.05]}
            reduced = lariat.sweep(SCENE, few, client=client, reduce={"samples": lambda run: len(run.t)}, progress=False)
    assert len(remote) == 200 and remote.errors == [None] * 200
    assert remote.same_results(local)
    assert again.rows == remote.rows
    here = lariat.sweep(SCENE, few, reduce={"samples": lambda run: len(run.t)}, progress=False)
    assert reduced.same_results(here) and here.rows[0]["results"]["samples"] > 1
