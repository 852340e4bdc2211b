"""Bending stiffness and damping of a rope from recorded points: nobody knows the EI of his rope.

The rope is clamped at one end, held out level, and let go; a camera follows some marks on it, at known distances from the clamp. Mass per
length and EA are known (a scale, the catalogue); EI and the damping of bending are fitted by least squares (scipy), of all marks at all
times. Here the recording is made by the program: a finer mesh than the one that fits, and noise of 1 mm.

    pip install lariat-cables scipy
    python identify.py
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import least_squares  # type: ignore[import-untyped, unused-ignore]

import lariat_cables as lariat
from lariat_cables.types import Array

LENGTH, MASS, AXIAL = 0.8, 0.15, 5e4
"""Of the rope: m, kg/m, EA in N."""
MARKS = np.array([0.2, 0.4, 0.6, 0.8])
"""Distances of the marks from the clamp, in m along the rope."""
FRAME, FRAMES = 1 / 60, 90
"""Of the camera: s, and how many."""
TRUTH = (0.05, 0.02)
"""EI in N m^2 and the time of the damping of bending in s that the recording is made with."""
NOISE = 1e-3
"""Of a coordinate of a mark, in m."""


def motion(stiffness: float, damping: float, elements: int = 8) -> Array:
    """Returns the marks of a rope that is let go, in m, shape (frames, marks, 2)."""
    rope = lariat.Cable(
        [[0, 0, 0], [LENGTH, 0, 0]],
        lariat.Section(AXIAL, stiffness, MASS),
        elements=elements,
        clamp="start",
        integrator=lariat.Integrator("esdirk4", tolerance=1e-5),
        effects=lariat.Damping(damping, damping),
    )
    frames = []
    for _ in range(FRAMES):
        rope.step(FRAME)
        frames.append(rope.sample(MARKS).position[:, :2])
    return np.array(frames)


def identify(recorded: Array, guess: tuple[float, float] = (0.2, 0.005)) -> tuple[Array, Array]:
    """Returns EI in N m^2 and the time of the damping in s, and the standard errors of both.

    Both are positive and known to a power of ten at best, so that their logarithms are fitted.
    """

    def misses(logarithms: Array) -> Array:
        return (motion(*np.exp(logarithms)) - recorded).ravel()

    # steps of the derivatives well above the tolerance of the integrator
    fit = least_squares(misses, np.log(guess), diff_step=1e-2, x_scale=1.0, xtol=1e-5)
    variance = 2.0 * fit.cost / (fit.fun.size - 2)
    errors = np.sqrt(np.diag(np.linalg.inv(fit.jac.T @ fit.jac)) * variance)
    return np.exp(fit.x), np.exp(fit.x) * errors


def main() -> tuple[Array, Array]:
    recorded = motion(*TRUTH, elements=24) + np.random.default_rng(1).normal(0.0, NOISE, (FRAMES, len(MARKS), 2))
    found, errors = identify(recorded)
    for name, unit, truth, value, error in zip(("EI", "damping"), ("N m^2", "s"), TRUTH, found, errors):
        print(f"{name}: {value:.5f} +- {error:.5f} {unit}, recorded with {truth} ({100 * (value / truth - 1):+.2f} %)")
    return found, errors


if __name__ == "__main__":
    main()
