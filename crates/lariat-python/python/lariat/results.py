"""What methods return: named tuples of numbers and arrays. SI units, world axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from lariat import Cable, Section

Array = NDArray[np.float64]


class Sample(NamedTuple):
    """A cable at one arc length; vectors have the shape (3,)."""

    s: float
    """Arc length of the unstretched cable in m."""
    position: Array
    """Position in m."""
    velocity: Array
    """Velocity in m/s."""
    slope: Array
    """Slope vector dr/ds; its length is the stretch."""
    tension: float
    """Tension in N, averaged at nodes; negative = compression."""
    curvature: Array
    """Curvature vector in 1/m, along the binormal."""
    moment: Array
    """Bending moment in N m, along the binormal."""
    green_strain: float
    """Green strain, projected on linear functions inside the element."""
    tension_uncertainty: float
    """The larger jump of the tension in N at the nodes of the element before averaging; all of it if no node can judge."""


class Samples(NamedTuple):
    """A cable at n arc lengths: the fields of ``Sample`` as arrays of shape (n,), vectors as arrays of shape (n, 3)."""

    s: Array
    position: Array
    velocity: Array
    slope: Array
    tension: Array
    curvature: Array
    moment: Array
    green_strain: Array
    tension_uncertainty: Array


class Reaction(NamedTuple):
    """What a support does to the cable."""

    node: int
    force: Array
    """In N."""
    moment: Array
    """In N m."""


class Energy(NamedTuple):
    """Energies in J; that of gravity is zero at the origin."""

    kinetic: float
    axial: float
    bending: float
    gravity: float

    @property
    def total(self) -> float:
        """The sum of all."""
        return sum(self)


class WorldEnergy(NamedTuple):
    """Energies of a world in J."""

    cables: Energy
    bodies_kinetic: float
    bodies_gravity: float

    @property
    def total(self) -> float:
        """The sum of all."""
        return self.cables.total + self.bodies_kinetic + self.bodies_gravity


class Momentum(NamedTuple):
    """Momentum."""

    linear: Array
    """In kg m/s."""
    angular: Array
    """About the origin, in kg m^2/s."""


class Equilibrium(NamedTuple):
    """The report of a search for equilibrium."""

    iterations: int
    residual: float
    """Largest residual force in N."""
    stable: bool


class MeshIndicator(NamedTuple):
    """What the shape says about the mesh."""

    position: float
    """Estimate of the largest error of position in m."""
    turn: float
    """Largest turn in rad of an element that no node judges."""


class EndForces(NamedTuple):
    """What a cable did to the bodies at its ends over a step of a co-simulation; rows are ends."""

    force: Array
    """Mean force on the body in N, shape (ends, 3)."""
    moment: Array
    """Mean moment about the reference point of the body in N m, shape (ends, 3)."""
    end_force: Array
    """Force at the end of the step in N, shape (ends, 3)."""
    work: Array
    """Work on the body over the step in J, shape (ends,)."""


class Attachment(NamedTuple):
    """What a cable of a world does to a body, after a step."""

    force: Array
    """Force on the body in N."""
    moment: Array
    """Moment on the body about the anchor in N m; zero for a ball."""
    gap: Array
    """Position of the node minus that of the anchor in m."""
    work: float
    """Work on the body since the attachment was made, in J."""


class Event(NamedTuple):
    """An event of a step of a world: "asleep", "awake", "broken", "attachment ended", or "warning: " and its text."""

    kind: str
    cable: Cable | None
    rest: Cable | None
    """The part behind a break."""
    arc_length: float | None
    """Arc length of a break in m."""
    tension: float | None
    """Tension in N at which it broke."""


class RigidBodyHandle(NamedTuple):
    """Names a body of a world."""

    index: int  # type: ignore[assignment]
    generation: int


def section(axial: float, bending: float, mass: float, diameter: float | None, outer_area: float | None) -> Section:
    """Restores a pickled section."""
    from lariat import Section

    return Section(axial, bending, mass, diameter=diameter, outer_area=outer_area)
