"""Runs of scenes: files, dicts, probes, failures, pages, OpenUSD."""

from __future__ import annotations

import builtins
import copy
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from common import SCENES

import lariat_cables as lariat
from lariat_cables import errors

ROPE = {
    "duration": 0.1,
    "dt": 0.01,
    "cable": [{"name": "rope", "points": [[0, 0, 0], [2, 0, 0]], "section": {"square": 0.01}, "density": 4000.0, "youngs_modulus": 1e8}],
    "attachment": [{"cable": "rope", "at": "start", "body": "world"}],
    "probe": [{"name": "tip", "cable": "rope", "at": "end"}],
}  # fmt: skip


def test_a_file_runs_and_its_probes_are_arrays() -> None:
    """The crate after 0.5 s is at (1.70292, -1.21801) m: an independent monolithic code."""
    run = lariat.run(SCENES / "payload_pendulum.toml", set={"duration": 0.5}, progress=False)
    hook, crate = run.probes["hook"], run.probes["crate"]
    assert hook.force.shape == (len(run.t), 3) and run.t[-1] == 0.5
    assert np.linalg.norm(crate.position[-1, :2] - [1.70292, -1.21801]) < 6e-3
    assert hook.gap is not None and (hook["fx"] == hook.force[:, 0]).all() and hook.moment.shape == hook.force.shape
    assert run.summary["simulated_s"] == 0.5 and run.summary["failed"] is None


def test_a_dict_is_the_same_scene_as_its_text() -> None:
    run = lariat.run(ROPE)
    text = lariat._lariat.to_toml(ROPE)  # type: ignore[arg-type]
    assert (lariat.run(text).probes["tip"].rows == run.probes["tip"].rows).all()
    arrays = {**ROPE, "cable": [{**ROPE["cable"][0], "points": np.array([[0.0, 0, 0], [2, 0, 0]])}]}  # type: ignore[index]
    assert (lariat.run(arrays).probes["tip"].rows == run.probes["tip"].rows).all()


def test_statics_have_one_sample() -> None:
    """The tip of a rope that hangs from its start is its length below it."""
    run = lariat.statics(ROPE)
    assert len(run.probes["tip"]) == 1
    assert run.probes["tip"].position[0] == pytest.approx([0, -2, 0], abs=1e-2)


def test_a_scene_that_is_not_accepted_says_where() -> None:
    with pytest.raises(errors.SceneError) as error:
        lariat.run(ROPE, set={"cable.rope.elements": 0})
    assert error.value.__dict__["key"] == "cable.rope.elements" and error.value.__dict__["accepted"]
    with pytest.raises(errors.ReadError):
        lariat.run("no such file.toml")
    with pytest.raises(errors.OverrideError):
        lariat.run(ROPE, set={"cable.slin.elements": 3})
    with pytest.raises(errors.SceneError):
        lariat.run({"cable": [{"name": None}]})


def test_a_run_that_fails_keeps_its_samples() -> None:
    stiff = {**ROPE, "cable": [{**ROPE["cable"][0], "youngs_modulus": 1e12, "integrator": {"method": "verlet", "substeps": 1}}]}  # type: ignore[index]
    with pytest.raises(lariat.Error) as error:
        lariat.run(stiff)
    run = error.value.__dict__["run"]
    assert len(run.probes["tip"]) >= 1 and run.summary["failed"]


def test_a_notebook_shows_the_page(tmp_path: Path) -> None:
    run = lariat.run(ROPE)
    shown = run._repr_html_()
    assert shown.startswith("<iframe srcdoc=") and "&lt;html" in shown and "<html" not in shown
    run.save(tmp_path)
    assert (tmp_path / "view.html").read_text(encoding="utf-8") == run.page()
    rows = np.loadtxt(tmp_path / "probes" / "tip.csv", delimiter=",", skiprows=1)
    assert (rows == run.probes["tip"].rows).all()


def test_progress_is_told_without_tqdm(monkeypatch: pytest.MonkeyPatch) -> None:
    real = builtins.__import__

    def without(name: str, *rest: object) -> object:
        if name.startswith("tqdm"):
            raise ImportError(name)
        return real(name, *rest)  # type: ignore[arg-type]

    monkeypatch.setattr(builtins, "__import__", without)
    monkeypatch.delitem(sys.modules, "tqdm.auto", raising=False)
    assert len(lariat.run(ROPE).probes["tip"]) == 11


def test_the_motion_is_opened_by_openusd(tmp_path: Path) -> None:
    """Positions in the file are those of the probes, in single precision."""
    pxr = pytest.importorskip("pxr")
    from pxr import Usd, UsdGeom

    assert pxr
    run = lariat.run(SCENES / "payload_pendulum.toml", set={"duration": 0.5}, progress=False)
    run.save_usd(tmp_path / "run.usda")
    stage = Usd.Stage.Open(str(tmp_path / "run.usda"))
    sling = UsdGeom.BasisCurves(stage.GetPrimAtPath("/World/sling"))
    points = np.array(sling.GetPointsAttr().Get(500.0))
    assert len(points) == 3 * 10 + 1 and list(sling.GetCurveVertexCountsAttr().Get()) == [31]
    crate = UsdGeom.Xformable(stage.GetPrimAtPath("/World/crate")).ComputeLocalToWorldTransform(500.0)
    assert list(crate.ExtractTranslation()) == pytest.approx(run.probes["crate"].position[-1], abs=1e-6)
    top = np.array(crate.Transform((0.0, 0.1, 0.0)))
    assert points[-1] == pytest.approx(top, abs=1e-4)
    stiffness = stage.GetPrimAtPath("/World/sling").GetAttribute("lariat:axialStiffness").Get()
    assert stiffness == pytest.approx(1e9 * 1e-4)


def test_an_error_that_is_asked_for_is_proven() -> None:
    """The claim holds against a run with four times the elements and a hundredth of the error."""
    asked = lariat.run({**ROPE, "duration": 0.3}, error=1e-2, progress=False)
    claim = asked.summary["error"]
    assert claim["outcome"] == "proven" and 0.0 < claim["claimed_m"] <= 1e-2
    fine = lariat.run({**ROPE, "duration": 0.3}, error=1e-4, progress=False)
    assert fine.summary["error"]["outcome"] == "proven"
    away = np.linalg.norm(asked.probes["tip"].position - fine.probes["tip"].position, axis=1).max()
    assert 0.0 < away <= claim["claimed_m"] + fine.summary["error"]["claimed_m"]


def test_an_error_of_a_tension_is_asked_for_by_a_text() -> None:
    run = lariat.run({**ROPE, "duration": 0.1}, error="tension=5%", progress=False)
    claim = run.summary["error"]
    assert claim["asked_m"] is None and claim["forces"]["quantity"] == "tension"
    assert claim["forces"]["asked"] == pytest.approx(0.05) and claim["forces"]["relative"]
    with pytest.raises(ValueError, match="tension=1%"):
        lariat.run(ROPE, error="strain=1%", progress=False)


def test_keys_and_rules_are_told() -> None:
    assert "`elements`" in lariat.keys() and "kg/m^3" in lariat.keys("cable.density")
    assert "projected-3" in lariat.rules() and "L2T2" in lariat.rules()
    with pytest.raises(errors.NoSuchKeyError) as error:
        lariat.keys("cable.elemnts")
    assert "elements" in str(error.value)


def test_the_wheel_has_the_command(tmp_path: Path) -> None:
    """It writes the files of a run, and ends with the exit codes of the command."""
    scene = tmp_path / "rope.toml"
    scene.write_text(lariat._lariat.to_toml(ROPE), encoding="utf-8")  # type: ignore[arg-type]
    command = [sys.executable, "-m", "lariat_cables"]
    done = subprocess.run([*command, "run", scene, "--out", tmp_path / "out"], capture_output=True, text=True)
    assert done.returncode == 0 and (tmp_path / "out/view.html").is_file() and (tmp_path / "out/probes/tip.csv").is_file()
    wrong = subprocess.run([*command, "run", tmp_path / "none.toml", "--out", tmp_path / "none"], capture_output=True, text=True)
    assert wrong.returncode == 2 and "none.toml" in wrong.stderr and not (tmp_path / "none").exists()
    assert subprocess.run([*command, "--version"], capture_output=True, text=True).stdout.startswith("lariat ")
    assert subprocess.run([*command, "rn"], capture_output=True, text=True).returncode == 2


def test_a_run_starts_from_the_equilibrium_that_statics_found(tmp_path: Path) -> None:
    """A hanging rope stays where it hangs; drawn level it falls by g t^2/2 meanwhile. From memory, pickled, by a folder of Python or of
    the command: the same bits."""
    hangs = {**ROPE, "cable": [{**ROPE["cable"][0], "points": [[0, 0, 0], [1, 0, 0]], "length": 1.3}]}  # type: ignore[index]
    hangs["attachment"] = [*ROPE["attachment"], {"cable": "rope", "at": "end", "body": "world"}]  # type: ignore[misc]
    hangs["probe"] = [{"name": "middle", "cable": "rope", "at": "50 %"}]
    found = lariat.statics(hangs)
    run = lariat.run(hangs, start=found, set={"duration": 0.3}, progress=False)
    rest = found.probes["middle"].position[0]
    assert rest[1] < -0.3 and np.abs(run.probes["middle"].position - rest).max() < 1e-6
    assert np.abs(lariat.run(hangs, progress=False).probes["middle"].position[0] - rest).max() > 0.01
    scene, own, other = tmp_path / "scene.toml", tmp_path / "own", tmp_path / "other"
    scene.write_text(lariat._lariat.to_toml(hangs))
    found.save(own)
    command = [Path(sys.executable).with_name("lariat"), "static", scene, "--out", other]
    assert subprocess.run(command, capture_output=True).returncode == 0
    for start in (pickle.loads(pickle.dumps(found)), own, str(other)):
        again = lariat.run(hangs, start=start, set={"duration": 0.3}, progress=False)
        assert (again.probes["middle"].rows == run.probes["middle"].rows).all()
    with pytest.raises(errors.StateError, match='cable "rope" differs'):
        lariat.run(hangs, start=found, set={"cable.rope.length": 1.4})
    with pytest.raises(errors.ReadError):
        lariat.run(hangs, start=tmp_path)
    with pytest.raises(ValueError, match="statics"):
        lariat.run(hangs, start=run)


def test_a_run_pickles_with_its_page() -> None:
    run = lariat.run(ROPE, progress=False)
    again = pickle.loads(pickle.dumps(run))
    assert (again.probes["tip"].rows == run.probes["tip"].rows).all() and again.summary == run.summary
    assert again.page() == run.page() and again.usd() == run.usd() and again.svg() == run.svg()


def test_integrators_pickle() -> None:
    for integrator in (
        lariat.Integrator("tr-bdf2", tolerance=1e-5, norm="motion"),
        lariat.Integrator("discrete-gradient", max_step=1 / 240, dissipation=0.01),
        lariat.Integrator("discrete-gradient", tolerance=1e-4),
        lariat.Integrator("trapezoid", substeps=4),
        lariat.Integrator("verlet", stable=0.5),
    ):
        again = pickle.loads(pickle.dumps(integrator))
        assert again == integrator == copy.copy(integrator) and repr(again) == repr(integrator)


def test_a_loaded_scene_is_stepped_and_changed_by_its_names() -> None:
    """It goes where the run goes, whose probe is the other side; 2e-6 m is the single precision of the bodies."""
    scene = SCENES / "payload_pendulum.toml"
    run = lariat.run(scene, set={"duration": 0.5}, progress=False)
    world = lariat.load(scene)
    crate, hook = world.body("crate"), run.probes["hook"]
    while world.time < 0.5 - 0.5 * world.dt:
        world.step()
    assert crate.translation == pytest.approx(run.probes["crate"].position[-1], abs=5e-6)
    assert world.attachment("hook").force == pytest.approx(hook.force[-1], rel=1e-3)
    assert world.cable("sling").name == "sling" and world.cable("sling").time == pytest.approx(0.5)
    for call, error in (
        (lambda: world.body("hook"), errors.NoBodyError),
        (lambda: world.cable("crate"), errors.NoCableError),
        (lambda: world.attachment("anchor"), errors.NoAttachmentError),
        (lambda: world.sheave("crate"), errors.NoSheaveError),
    ):
        with pytest.raises(error, match="there are: "):
            call()
    world.detach("hook")
    before = crate.linvel
    world.step()
    assert crate.linvel - before == pytest.approx([0, -9.81 * world.dt, 0], abs=1e-4)
    again = lariat.World.from_bytes(world.to_bytes())
    again.step()
    world.step()
    assert (again.body("crate").translation == crate.translation).all()


def test_a_loaded_scene_drives_its_kinematic_bodies_and_leaves_the_others() -> None:
    def body(name: str, **keys: object) -> dict[str, object]:
        return {"name": name, "kind": "kinematic", "shape": {"ball": 0.1}, **keys}

    bodies = [body("trolley", path=[[0, 0, 0, 0], [1, 2, 0, 0]]), body("hand", position=[2.0, 5.0, 0.0])]
    attachments = [{"cable": "rope", "at": "start", "body": "trolley"}]
    world = lariat.load({**ROPE, "dt": 0.1, "engine": "rapier", "body": bodies, "attachment": attachments})
    for k in range(5):
        world.body("hand").set_next_kinematic_translation([2.0, 5.0, 0.1 * (k + 1)])
        world.step()
    assert world.body("trolley").translation == pytest.approx([1.0, 0, 0], abs=1e-6)
    assert world.body("hand").translation == pytest.approx([2.0, 5.0, 0.5], abs=1e-6)
    assert world.cable("rope").sample(0.0).position == pytest.approx([1.0, 0, 0], abs=1e-5)


def test_a_timed_cut_is_for_the_program_that_steps() -> None:
    cable = {**ROPE["cable"][0], "break": {"time": 0.05, "at": 1.0}}  # type: ignore[index]
    with pytest.raises(errors.TimedCutError) as error:
        lariat.load({**ROPE, "cable": [cable]})
    assert error.value.__dict__["cable"] == "rope"
