"""The adapter for cosseratbench, and what docs/referee.md says of the catenary."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

pytest.importorskip("cosseratbench")

from cosseratbench import registry  # type: ignore[import-untyped, unused-ignore] # noqa: E402
from cosseratbench.experiment import run  # type: ignore[import-untyped, unused-ignore] # noqa: E402
from cosseratbench.experiments.twist import LEVELS, growth_rates  # type: ignore[import-untyped, unused-ignore] # noqa: E402

from lariat_cables.referee import LariatSolver  # noqa: E402
from lariat_cables.referee_catenary import FLEXIBLE, green_sag, lariat_sag  # noqa: E402
from lariat_cables.referee_page import at_nodes  # noqa: E402


@pytest.mark.parametrize("friction", [0.15, 0.45])
def test_a_rope_on_a_capstan_holds_up_to_the_capstan_equation(friction: float) -> None:
    """The equation with the weight of the rope on the cylinder, as in cosseratbench; 0.15 m of rope hang on the light side."""
    experiment = registry.load_experiment("capstan")
    slides = [
        run(experiment, LariatSolver(), values={"overhang": overhang, "friction": friction}, n_elements=experiment.n_elements)
        for overhang in (0.95, 1.1)
    ]
    assert all(result.outcome == "completed" for result in slides)
    assert slides[0].metrics["slide"] < 2e-3 and slides[1].metrics["slide"] > 0.05


@pytest.mark.parametrize("modulus, span", [(2e5, 0.7), (5e6, 0.9)])
def test_a_flexible_catenary_is_that_of_greens_law(modulus: float, span: float) -> None:
    """Against a quadrature without elements."""
    rod = registry.load_experiment("catenary").scenario_for(youngs_modulus=modulus, span=span).rods[0]
    assert lariat_sag(rod, 9.81, FLEXIBLE, 200) == pytest.approx(green_sag(rod, 9.81, span), rel=1e-5)


@pytest.mark.parametrize("values", [{"drop": 0.07, "youngs_modulus": 1e6}, {"drop": 0.1, "youngs_modulus": 1e7}])
def test_a_rope_on_a_rope_has_the_shape_of_the_elastica(values: dict[str, float]) -> None:
    """Against the boundary value problem of cosseratbench; the metrics read nodes, and what they make of the reference at the nodes is no error."""
    experiment = registry.load_experiment("crossing")
    parameters = tuple(dataclasses.replace(p, values=(*p.values, values[p.name])) for p in experiment.parameters)
    experiment = dataclasses.replace(experiment, parameters=parameters)
    result, reference = run(experiment, LariatSolver(), values=values), at_nodes(experiment, values)
    assert result.outcome == "completed"
    assert result.metrics["shape_error"] < reference.metrics["shape_error"] + 1e-3
    assert abs(result.metrics["lift_error"] - reference.metrics["lift_error"]) < 5e-3


def test_a_rope_that_is_lowered_on_a_floor_lies_on_itself() -> None:
    """The clamp has moved as the scenario says, and no coil is in another one by more than a share of the radius."""
    experiment = registry.load_experiment("pile")
    result = run(experiment, LariatSolver(), values={"friction": 0.4}, n_elements=experiment.n_elements)
    assert result.outcome == "completed" and result.observations["max_rod_overlap"] < 0.5
    assert result.metrics["settling_residual"] < 0.05
    rod = experiment.scenario_for(friction=0.4).rods[0]
    clamp = result.trajectory.positions[0][:, 0]
    moved = [rod.start_motion.pose(t)[0] for t in result.trajectory.times]
    assert clamp - clamp[0] == pytest.approx(np.array(moved), abs=1e-9)


@pytest.mark.parametrize("tension", [1.0, 10.0, 30.0])
def test_a_twisted_rod_kinks_at_the_torque_of_greenhill(tension: float) -> None:
    """Against the critical torque of a clamped rod under tension; the fit of the benchmark to how fast rods grow is good to 0.5 %, as it says. At the
    critical twist itself a straight rod neither grows nor falls back. The end slides and turns as the scenario says: the rods that stay straight are
    stretched by their tension, and twisted by what the end turned."""
    experiment = registry.load_experiment("twist")
    # M l/EI is 0.5 at most: the mesh errs by less than 1e-4
    result = run(experiment, LariatSolver(), values={"tension": tension}, n_elements=25)
    assert result.outcome == "completed"
    assert result.metrics["critical_twist_error"] < 0.005
    scenario = experiment.scenario_for(tension=tension)
    levels = np.array(LEVELS)
    rates = growth_rates(scenario, result.trajectory)
    assert np.all(rates[levels < 1.0] < -0.2) and abs(rates[levels == 1.0][0]) < 0.1 and np.all(rates[levels > 1.0] > 0.3)
    rod, path, directors = scenario.rods[0], result.trajectory.positions[0], result.trajectory.directors[0]
    force = rod.loads[0].force[0]
    strain = path[-1, -1, 0] / rod.length - 1.0
    assert strain == pytest.approx(force / (rod.material.youngs_modulus * rod.area), rel=1e-2)
    # of the elements' middles, which miss half an element at each end
    turned = np.unwrap(np.arctan2(directors[:, :, 2], directors[:, :, 1]), axis=0)[-1]
    count = len(turned)
    expected = rod.end_motion.rotation[-1][0] * (count - 1) / count
    assert (turned[-1] - turned[0]) == pytest.approx(expected, rel=1e-6)


def test_what_the_adapter_does_not_write_is_refused_by_name() -> None:
    """A clamp that is turned across the rod, and one that is led beside others that slide."""
    experiment = registry.load_experiment("twist")
    scenario = experiment.scenario_for()
    led = dataclasses.replace(scenario.rods[0], end_motion=dataclasses.replace(scenario.rods[0].end_motion, slides_along=None))
    with pytest.raises(NotImplementedError, match="beside ends that slide"):
        LariatSolver().run(dataclasses.replace(scenario, rods=(led, *scenario.rods[1:])), n_elements=10, n_frames=2)
    rod = scenario.rods[0]
    motion = dataclasses.replace(rod.end_motion, slides_along=None, rotation=tuple((0.0, x, 0.0) for x, _, _ in rod.end_motion.rotation))
    tilted = dataclasses.replace(scenario, rods=(dataclasses.replace(rod, end_motion=motion),))
    with pytest.raises(NotImplementedError, match="another direction"):
        LariatSolver().run(tilted, n_elements=10, n_frames=2)
