"""What the distance of Lariat's catenaries from the reference of ``cosseratbench`` is made of: its material law, its bending stiffness and its
elements. ``referee_page`` writes it into its page.

The reference is a perfectly flexible cable whose tension is EA (f - 1) at the stretch f. Lariat's law is that of Green's strain,
EA f (f^2 - 1)/2, and its cable has the bending stiffness of its section. The perfectly flexible catenary with Green's law is a quadrature of its
own here, without elements: the force at an arc length is known, and so are direction and stretch.
"""

from __future__ import annotations

from typing import Any

import numpy as np

import lariat_cables as lariat
from lariat_cables.types import Array

POINTS = 20_001
FLEXIBLE = 1e-4
"""Bending stiffness of the flexible cable over that of the section."""


def green_sag(rod: Any, gravity: float, span: float) -> float:
    """Returns the height in m of the lowest point of the flexible catenary with Green's law, between pins at height 0."""
    axial, weight = rod.material.youngs_modulus * rod.area, rod.material.density * rod.area * gravity
    s = np.linspace(0.0, rod.length, POINTS)
    vertical = weight * (s - 0.5 * rod.length)

    def shape(horizontal: float) -> tuple[Array, Array]:
        tension = np.hypot(horizontal, vertical)
        stretch = np.ones_like(s)
        # Newton's iteration from above: convex and increasing beyond 1/sqrt 3
        stretch += tension / axial
        for _ in range(50):
            stretch -= (stretch * (stretch**2 - 1) / 2 - tension / axial) / ((3 * stretch**2 - 1) / 2)
        rates = stretch * np.stack([np.full_like(s, horizontal), vertical]) / tension
        path = np.concatenate([np.zeros((2, 1)), np.cumsum((rates[:, 1:] + rates[:, :-1]) / 2 * np.diff(s), axis=1)], axis=1)
        return path[0], path[1]

    low, high = 1e-6 * weight * rod.length, 1e6 * weight * rod.length
    for _ in range(200):
        middle = float(np.sqrt(low * high))
        low, high = (middle, high) if shape(middle)[0][-1] < span else (low, middle)
    return float(shape(middle)[1].min())


def lariat_sag(rod: Any, gravity: float, bending: float, elements: int) -> float:
    """Returns that of Lariat, with this factor on the bending stiffness."""
    modulus, density = rod.material.youngs_modulus, rod.material.density
    section = lariat.Section(modulus * rod.area, bending * modulus * rod.second_moment_of_area, density * rod.area)
    nodes = rod.nodes(elements)
    cable = lariat.Cable(nodes, section, length=rod.length, elements=elements, gravity=[0.0, 0.0, -gravity], fix=["start", "end"])
    cable.equilibrium()
    return float(cable.positions[:, 2].min())


def section() -> str:
    """Returns the section of the page."""
    from cosseratbench import registry  # type: ignore[import-untyped, unused-ignore]
    from cosseratbench.experiments.catenary import reference_curve  # type: ignore[import-untyped, unused-ignore]

    experiment = registry.load_experiment("catenary")
    text = """
**What the error is made of**

The reference has no bending stiffness, and a tension of EA (f - 1) at the stretch f; Lariat has the bending stiffness of the section, and the tension of Green's strain,
EA f (f^2 - 1)/2. The sag of each step from the one to the other, relative to the reference; the last column is the error of the elements:
Lariat with 1e-4 of the bending stiffness beside the flexible catenary with Green's law, a quadrature without elements.

| youngs_modulus, span | all | of it by Green's law | by bending stiffness | Lariat, flexible, beside Green's catenary |
|---|---|---|---|---|
"""
    for modulus, span in ((1e6, 0.8), (1e5, 0.8), (1e7, 0.8), (1e6, 0.6), (1e6, 0.95)):
        scenario = experiment.scenario_for(youngs_modulus=modulus, span=span)
        rod, gravity = scenario.rods[0], float(np.linalg.norm(scenario.gravity))
        reference = float(reference_curve(rod, gravity, span)[:, 2].min())
        green = green_sag(rod, gravity, span)
        stiff, flexible = (lariat_sag(rod, gravity, bending, 4 * experiment.n_elements) for bending in (1.0, FLEXIBLE))
        parts = [stiff / reference - 1, green / reference - 1, (stiff - flexible) / reference, flexible / green - 1]
        text += f"| {modulus:.0e} Pa, {span:g} m | " + " | ".join(f"{part:+.1e}" for part in parts) + " |\n"
    return text
