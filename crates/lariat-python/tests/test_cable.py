"""A cable: physics against analytic solutions, arrays, state, errors, threads."""

from __future__ import annotations

import copy
import pickle
import threading
import time

import numpy as np
import pytest
from common import pendulum

import lariat_cables as lariat
from lariat_cables import errors
from lariat_cables.types import Fidelity


def test_a_slack_cable_hangs_in_the_catenary() -> None:
    """Sag and tension of the inextensible catenary of parameter a: length 2 a sinh(b/2a) (textbook; solved here by bisection)."""
    span, length, weight = 2.5, 3.0, 0.14 * 9.81
    low, high = 0.1, 100.0
    for _ in range(200):
        a = 0.5 * (low + high)
        low, high = (a, high) if 2 * a * np.sinh(span / (2 * a)) > length else (low, a)
    section = lariat.Section(1.6e6, 1e-4, 0.14)
    rope = lariat.Cable([[0, 0, 0], [span, 0, 0]], section, length=length, elements=40, fix=["start", "end"])
    report = rope.equilibrium()
    middle = rope.sample(0.5 * length)
    assert report.stable
    assert -middle.position[1] == pytest.approx(a * (np.cosh(span / (2 * a)) - 1), rel=1e-3)
    assert middle.tension == pytest.approx(weight * a, rel=2e-3)
    assert sum(r.force[1] for r in rope.reactions()) == pytest.approx(weight * length, rel=1e-9)


def test_a_length_by_pretension_or_sag_is_that_of_the_catenary() -> None:
    """Length and sag of the inextensible catenary of parameter a = H/w: 2 a sinh(b/2a) and a (cosh(b/2a) - 1) (textbook)."""
    span, weight, a = 35.0, 3.0 * 9.81, 8.5
    length, sag = 2 * a * np.sinh(span / (2 * a)), a * (np.cosh(span / (2 * a)) - 1)
    line = ([[0, 0, 0], [span, 0, 0]], lariat.Section(1e8, 0.0, 3.0))
    held = {"elements": 60, "fix": ["start", "end"], "rule": "projected-none"}
    assert lariat.Cable(*line, pretension=a * weight, **held).length == pytest.approx(length, rel=1e-4)
    assert lariat.Cable(*line, sag=sag, **held).length == pytest.approx(length, rel=1e-4)
    with pytest.raises(TypeError, match="one of length, pretension and sag"):
        lariat.Cable(*line, sag=sag, length=length, **held)
    with pytest.raises(errors.InvalidValueError, match="pretension"):
        lariat.Cable(*line, pretension=1.0, **held)


def test_the_pendulum_falls_as_the_reference_does() -> None:
    """Tip after 0.5 s: (1.3108, -1.2034) m, converged solution of an independent program."""
    cable = pendulum(elements=10)
    for _ in range(30):
        cable.step(1 / 60)
    assert np.linalg.norm(cable.sample(2.0).position - [1.3108, -1.2034, 0.0]) < 3e-3
    assert cable.time == pytest.approx(0.5)


def test_arrays_have_the_shapes_of_the_nodes_and_are_copies() -> None:
    cable = pendulum(elements=6)
    assert cable.positions.shape == cable.slopes.shape == cable.velocities.shape == (7, 3)
    assert cable.coordinates.shape == cable.rates.shape == (7, 6)
    before = cable.positions
    cable.step(0.1)
    assert before[-1, 1] == 0.0 and cable.positions[-1, 1] < 0.0
    into = np.empty((7, 6))
    cable.read_into(into)
    assert (into == cable.coordinates).all() and (into[:, 3:] == cable.slopes).all()


def test_sampling_many_points_reads_what_sampling_each_does() -> None:
    cable = pendulum(elements=5)
    cable.step(0.2)
    s = np.linspace(0.0, 2.0, 11)
    many = cable.sample(s)
    assert many.position.shape == (11, 3) and many.tension.shape == (11,)
    for i in range(11):
        one = cable.sample(float(s[i]))
        assert (one.position == many.position[i]).all() and one.tension == many.tension[i]
        assert (one.moment == many.moment[i]).all() and (one.curvature == many.curvature[i]).all()


def stepped(cable: lariat.Cable, steps: int = 5) -> bytes:
    for _ in range(steps):
        cable.step(1 / 60)
    return cable.to_bytes()


@pytest.mark.parametrize("fidelity", ["game", "engineering", "reference"])
def test_a_saved_cable_continues_bitwise(fidelity: Fidelity) -> None:
    cable = pendulum(elements=4, fidelity=fidelity, effects=[lariat.Drag(1.2, flow=lariat.Flow((3.0, 0.0, 1.0)))])
    stepped(cable)
    pickled, from_bytes = pickle.loads(pickle.dumps(cable)), lariat.Cable.from_bytes(cable.to_bytes())
    copies = [pickled, from_bytes, copy.copy(cable), copy.deepcopy(cable), cable.copy()]
    snapshot = cable.snapshot()
    expected = stepped(cable)
    assert all(stepped(other) == expected for other in copies)
    cable.restore(snapshot)
    stepped(cable)
    assert (cable.coordinates == from_bytes.coordinates).all() and (cable.rates == from_bytes.rates).all()


def test_effects_go_in_and_come_out() -> None:
    given = [
        lariat.Damping(1e-3, 2e-3),
        lariat.Drag(1000.0, 1.1, 0.02, 0.01, lariat.Flow((1.0, 0.0, 0.0), history=[[0.0, 0.0], [1.0, 1.0]])),
        lariat.Buoyancy(1000.0),
        lariat.GravityScale(0.5),
        lariat.LineLoad((0.0, 0.0, 1.0), 0.5, 1.5),
        lariat.RestShape([lariat.RestPiece(0.0, 1.0, 0.5)]),
    ]
    cable = pendulum(effects=given)
    effects = cable.effects
    assert set(effects) == {"damping", "drag", "buoyancy", "gravity_scale", "line_load", "rest_shape"}
    assert effects["damping"] == given[0] and effects["buoyancy"] == given[2] and effects["rest_shape"] == given[5]
    again = pendulum(effects=effects)
    assert stepped(cable) == stepped(again)
    cable.effects = None
    assert cable.effects == {}


def test_supports_and_loads_change_between_steps() -> None:
    """A straight vertical cable that carries 10 N: tension 10 N plus the weight below (statics)."""
    cable = lariat.Cable([[0, 0, 0], [0, -2, 0]], lariat.Section(1e5, 0.01, 0.1), fix="start")
    cable.add_load(2.0, [0, -10, 0])
    cable.equilibrium()
    assert cable.sample(1.0).tension == pytest.approx(10 + 0.1 * 9.81, rel=1e-6)
    cable.clear_loads()
    cable.prescribe("start", [0.3, 0, 0], 0.5)
    for _ in range(30):
        cable.step(1 / 60)
    assert cable.positions[0] == pytest.approx([0.3, 0, 0], abs=1e-12)
    cable.fix("start")
    rest = cable.cut(1.0)
    assert cable.length == pytest.approx(1.0) and rest.length == pytest.approx(1.0)
    cable.release("start")
    cable.step(1 / 60)


def test_the_tension_in_water_is_the_effective_tension() -> None:
    """A chain that hangs free in water (docs/words.md): 0 N at its foot, (m - rho A) g L at its top; the tension of the wall would be
    -rho g L A at the foot. Source: weight less buoyancy of what hangs below."""
    mass, area, length, water = 5.6, 7.1e-4, 50.0, 1025.0
    section = lariat.Section(2e7, 0.0, mass, outer_area=area)
    chain = lariat.Cable([[0, 0, 0], [0, -length, 0]], section, elements=10, fix="start", effects=lariat.Buoyancy(water))
    chain.equilibrium()
    weight = (mass - water * area) * 9.81 * length
    assert chain.sample("end").tension == pytest.approx(0.0, abs=1e-6 * weight)
    assert chain.sample("start").tension == pytest.approx(weight, rel=1e-4)


def test_step_all_steps_each_as_alone_and_returns_arrays_of_all() -> None:
    fleet = [pendulum(elements=n) for n in (3, 5, 4)]
    alone = [cable.copy() for cable in fleet]
    stepped = lariat.step_all(fleet, 0.05, steps=2)
    for cable in alone:
        cable.step(0.05, steps=2)
    assert [c.to_bytes() for c in fleet] == [c.to_bytes() for c in alone]
    assert stepped.coordinates.shape == stepped.rates.shape == (3, 6, 6) and stepped.positions.shape == (3, 6, 3)
    assert stepped.nodes.tolist() == [4, 6, 5] and stepped.time == pytest.approx([0.1] * 3)
    for i, cable in enumerate(alone):
        n = cable.nodes
        assert np.array_equal(stepped.coordinates[i, :n], cable.coordinates) and np.array_equal(stepped.rates[i, :n], cable.rates)
        assert np.array_equal(stepped.slopes[i, :n], cable.slopes) and np.array_equal(stepped.velocities[i, :n], cable.velocities)
        assert np.isnan(stepped.coordinates[i, n:]).all() and np.isnan(stepped.rates[i, n:]).all()
    world = lariat.World()
    inside = world.add_cable(fleet[0])
    assert np.array_equal(lariat.states([inside, fleet[1]]).coordinates, stepped.coordinates[:2], equal_nan=True)
    assert lariat.states([]).coordinates.shape == (0, 0, 6)
    with pytest.raises(errors.InWorldError):
        lariat.step_all([inside], 0.1)
    with pytest.raises(errors.DuplicateCableError):
        lariat.step_all([fleet[0], fleet[0]], 0.1)


def test_errors_carry_value_cable_and_time() -> None:
    cable = pendulum(name="sling")
    with pytest.raises(errors.InvalidValueError) as invalid:
        cable.step(float("nan"))
    assert np.isnan(invalid.value.value) and invalid.value.cable == "sling"
    with pytest.raises(errors.OutOfRangeError) as outside:
        cable.sample(7.0)
    assert outside.value.value == 7.0 and outside.value.__dict__["limit"] == pytest.approx(2.0)
    free = lariat.Cable([[0, 0, 0], [1, 0, 0]], lariat.Section(1e3, 0.1, 1.0), name="free")
    with pytest.raises(errors.NoEquilibriumError) as none:
        free.equilibrium()
    assert none.value.cable == "free" and none.value.time == 0.0
    before = free.coordinates
    explicit = lariat.Integrator("verlet", substeps=1)
    stiff = lariat.Cable([[0, 0, 0], [1, 0, 0]], lariat.Section(1e9, 0.1, 1.0), integrator=explicit, name="stiff")
    with pytest.raises(errors.StepFailedError) as failed:
        stiff.step(1.0)
    assert failed.value.cable == "stiff" and failed.value.time == 0.0 and failed.value.__dict__["step"] > 0.0
    again = pickle.loads(pickle.dumps(failed.value))
    assert type(again) is errors.StepFailedError and again.__dict__ == failed.value.__dict__
    assert (free.coordinates == before).all()


def test_wrong_shapes_and_types_are_named() -> None:
    section = lariat.Section.round(0.01, 1e8, 1000.0)
    for points in ([0, 0, 0], [[0, 0], [1, 1]], np.zeros((2, 3, 1))):
        with pytest.raises(errors.ShapeError):
            lariat.Cable(points, section)
    with pytest.raises(TypeError):
        lariat.Cable([[0, 0, 0], [1, 0, 0]], 3.0)  # type: ignore[arg-type]
    for points in ([[0, 0, 0], [1j, 0, 0]], [[0, 0, 0], [None, 0, 0]], "points"):
        with pytest.raises(TypeError):
            lariat.Cable(points, section)  # type: ignore[arg-type]
    with pytest.raises(TypeError):
        pendulum().node(True)
    with pytest.raises(errors.UnknownPlaceError):
        pendulum().node("middle")  # type: ignore[arg-type]
    with pytest.raises(errors.UnknownRuleError):
        pendulum(rule="G5")
    with pytest.raises(errors.EffectsError):
        pendulum(effects={"dragg": {}})
    with pytest.raises(errors.FormatError):
        lariat.Cable.from_bytes(b"nonsense")


def test_damaged_bytes_are_refused() -> None:
    """A flipped bit anywhere, and bytes that are missing or too many, are found; the object itself reads back."""
    saved = pendulum(elements=4).to_bytes()
    assert lariat.Cable.from_bytes(saved).elements == 4
    for at in range(len(saved)):
        damaged = bytearray(saved)
        damaged[at] ^= 1 << (at % 8)
        with pytest.raises(errors.FormatError):
            lariat.Cable.from_bytes(bytes(damaged))
    half = len(saved) // 2
    for other in (saved[:-1], saved + b"\0", saved[:half] + saved[half + 8 :]):
        with pytest.raises(errors.FormatError):
            lariat.Cable.from_bytes(other)


def test_other_threads_run_while_a_cable_is_stepped() -> None:
    """A thread of Python goes on counting during one long step; without release of the interpreter it would stand still."""
    cable = pendulum(elements=40, integrator=lariat.Integrator("esdirk4", tolerance=1e-8))
    counted: list[float] = []
    stop = threading.Event()

    def count() -> None:
        while not stop.is_set():
            counted.append(time.perf_counter())
            time.sleep(1e-3)

    thread = threading.Thread(target=count)
    thread.start()
    begin = time.perf_counter()
    cable.step(1.0)
    end = time.perf_counter()
    stop.set()
    thread.join()
    within = [t for t in counted if begin < t < end]
    assert len(within) > 10 * (end - begin), (len(within), end - begin)


def test_threads_that_step_one_cable_wait_for_each_other() -> None:
    """Two threads with 50 steps each end in the state of 100 steps."""
    cable, alone = pendulum(elements=4), pendulum(elements=4)
    threads = [threading.Thread(target=lambda: [cable.step(1 / 240) for _ in range(50)]) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for _ in range(100):
        alone.step(1 / 240)
    assert cable.to_bytes() == alone.to_bytes()


def test_names_are_listed() -> None:
    assert "esdirk4" in lariat.integrators() and "wire-rope" in lariat.rope_kinds()
    assert lariat.recommended_elements("game") == 10
    assert lariat.Section.wire_rope(0.01) == pickle.loads(pickle.dumps(lariat.Section.wire_rope(0.01)))
    assert repr(lariat.Integrator("esdirk4", tolerance=1e-6)) == "Integrator(\"esdirk4\", tolerance=1e-6)"


def test_ropes_and_chains_are_sections_by_their_names() -> None:
    """Source: the coefficients of MoorPy for a studless chain (crates/lariat-ancf/src/material.rs), at a bar of 20 mm."""
    chain = lariat.Section.rope("chain", 0.02)
    assert chain.mass_per_length == pytest.approx(20.01e3 * 0.02**2)
    assert chain.axial_stiffness == pytest.approx(85.61e9 * 0.02**2 - 3.927e7 * 0.02**3) and chain.bending_stiffness == 0.0
    assert lariat.Section.breaking_load("chain", 0.02) == pytest.approx(910.7 * 0.02 + 1.206e9 * 0.02**2 - 2.192e9 * 0.02**3)
    assert lariat.Section.rope("wire_rope", 0.01).axial_stiffness == lariat.Section.wire_rope(0.01).axial_stiffness
    with pytest.raises(errors.BuilderError, match="polyester"):
        lariat.Section.rope("hemp", 0.02)
    with pytest.raises(errors.InvalidValueError):
        lariat.Section.rope("nylon", 20.0)
