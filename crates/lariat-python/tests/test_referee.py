"""The adapter for cosseratbench, and what docs/referee.md says of the catenary."""

from __future__ import annotations

import pytest

pytest.importorskip("cosseratbench")

from cosseratbench import registry  # type: ignore[import-untyped, unused-ignore] # noqa: E402
from cosseratbench.experiment import run  # type: ignore[import-untyped, unused-ignore] # noqa: E402

from lariat.referee import LariatSolver  # noqa: E402
from lariat.referee_catenary import FLEXIBLE, green_sag, lariat_sag  # noqa: E402


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


def test_what_the_element_does_not_have_is_refused_by_name() -> None:
    outcomes = {name: run(registry.load_experiment(name), LariatSolver(), n_elements=10) for name in ("twist", "crossing")}
    assert all(result.outcome == "unsupported" for result in outcomes.values())
