"""What methods return: named tuples of numbers and arrays. SI units, world axes."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lariat_cables.node import Node

if TYPE_CHECKING:
    from lariat_cables import Cable, Section

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
    """Tension in N, the force along the tangent, by the equilibrium of the nodes; negative = compression."""
    curvature: Array
    """Curvature vector in 1/m, along the binormal."""
    moment: Array
    """Bending moment in N m, along the binormal."""
    green_strain: float
    """Green strain, projected on linear functions inside the element."""
    tension_uncertainty: float
    """What the strain misses to the tension in N, far above its error; all of it if nothing can judge."""


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


class States(NamedTuple):
    """States of several cables; a cable with fewer nodes than another has NaN beyond its own."""

    coordinates: Array
    """Nodal coordinates, shape (cables, nodes, 6): position in m and slope."""
    rates: Array
    """Rates of the nodal coordinates, shape (cables, nodes, 6): m/s and 1/s."""
    time: Array
    """Times in s, shape (cables,)."""
    nodes: NDArray[np.int64]
    """Numbers of nodes, shape (cables,)."""

    @property
    def positions(self) -> Array:
        """Positions of the nodes in m, shape (cables, nodes, 3): a view."""
        return self.coordinates[:, :, :3]

    @property
    def slopes(self) -> Array:
        """Slope vectors dr/ds of the nodes, shape (cables, nodes, 3): a view."""
        return self.coordinates[:, :, 3:]

    @property
    def velocities(self) -> Array:
        """Velocities of the nodes in m/s, shape (cables, nodes, 3): a view."""
        return self.rates[:, :, :3]


class Reaction(NamedTuple):
    """What a support does to the cable."""

    node: Node
    force: Array
    """In N."""
    moment: Array
    """In N m."""


class Twist(NamedTuple):
    """Torsion of a cable between two neighbouring clamps that hold its spin."""

    nodes: tuple[Node, Node]
    twist: float
    """In rad, right-handed positive, whole turns included."""
    torque: float
    """In N m about the cable in the direction of arc length, on what holds the first node."""
    twist_rate: float
    """In rad/m."""


class Energy(NamedTuple):
    """Energies in J; that of gravity is zero at the origin."""

    kinetic: float
    axial: float
    bending: float
    gravity: float
    torsion: float = 0.0

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


class WorldEquilibrium(NamedTuple):
    """What a search for the equilibrium of a world found; true if all is stable."""

    stable: bool
    moved: list[RigidBodyHandle]
    """Dynamic bodies that were brought to their place."""
    held: list[RigidBodyHandle]
    """Attached bodies that were held: fixed, kinematic, disabled or without mass."""
    unattached: list[RigidBodyHandle]
    """Dynamic bodies without a cable, which were left where they are."""

    def __bool__(self) -> bool:
        return self.stable


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
    """Force at the end of the step in N, shape (ends, 3); of cables with contact or a reel, whose forces are known over steps alone, the mean."""
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
    """An event of a step of a world: "asleep", "awake", "broken", "degraded" (its work reached the limit of the world), "contact started",
    "contact ended", "contact ignored" (a collider that it cannot touch), "attachment ended", or "warning: " and its text."""

    kind: str
    cable: Cable | None
    rest: Cable | None
    """The part behind a break."""
    arc_length: float | None
    """Arc length of a break or of a contact in m."""
    tension: float | None
    """Tension in N at which it broke."""
    collider: ColliderHandle | None = None
    """The collider of a contact."""
    force: float | None = None
    """Normal force in N of a contact that started."""


class Touch(NamedTuple):
    """A contact of a cable, at the end of a step."""

    obstacle: int | ColliderHandle
    """Index of the obstacle, or handle of the collider of a world."""
    arc_length: float
    """Of the point that touches, in m."""
    normal: Array
    """Outward normal of the obstacle."""
    normal_force: float
    """In N, > 0: the obstacle pushes the cable along the normal."""
    friction: Array
    """Friction on the cable in N."""
    depth: float
    """Depth in m by which the surface of the cable is in the obstacle."""
    slips: bool
    """Whether it slips."""


class SheaveReading(NamedTuple):
    """What a sheave did so far."""

    passed: float
    """Length in m that ran over it."""
    force: float
    """Friction in N in the last step: what the pull on one side exceeds that on the other by, but for inertia."""
    lost: float
    """Energy in J that friction took."""


class CableTouch(NamedTuple):
    """A contact of a cable of a world with another or with itself, at the end of a step."""

    other: Cable
    arc_length: float
    """Of the point that touches, in m."""
    other_arc_length: float
    """Of the point of the other cable, in m."""
    normal: Array
    """Unit normal, from the other cable to this one."""
    normal_force: float
    """In N, > 0."""
    friction: Array
    """Friction on this cable in N."""
    depth: float
    """Depth in m by which the surfaces are in each other."""
    slips: bool
    """Whether it slips."""


class Rope(NamedTuple):
    """A rope that was added to a world."""

    cable: Cable
    start: int | None
    """Number of the attachment of its start; None if the world holds it."""
    end: int | None
    """Number of the attachment of its end; None if the world holds it."""


class ReelReading(NamedTuple):
    """What a reel does now."""

    length_out: float
    """Unstretched length that is out, in m."""
    rate: float
    """In m/s: positive pays out."""
    force: float
    """Pull of the winch along the cable in N."""
    tension: float
    """Tension of the cable at the eye in N."""
    work: float
    """Work of the winch on the cable so far in J, with the energy of the material that entered."""
    remeshed: float
    """Energy in J that merging and splitting elements added so far."""
    splits: int
    """Elements split so far."""
    merges: int
    """Elements merged so far."""
    stopped: bool
    """Whether it slows down or stands at the end of its stock, at a held node or a load."""
    speed_ratio: float
    """Rate over the speed of transverse waves at the eye; infinite without tension."""


class Break(NamedTuple):
    """Where, why and under which load a cable became two."""

    cause: str
    """ "tension", "strain" or "cut"."""
    arc_length: float
    """Of the break in m: the new length of the part before it."""
    tension: float
    """Largest elastic tension in N since the end of the last host step; of a cut, the tension at it."""
    strain: float
    """Strain there."""
    time: float
    """Time in s of that tension, within the last host step."""
    strain_energy: float
    """Strain energy of both parts in J."""
    inserted_energy: float
    """Change of the total energy in J by the edit itself."""
    damping: float
    """Tension of damping in N beside `tension`, which does not count."""
    breaks: int
    """Breaks by loads, one after another, that made the parts: 1 of a cable that was whole, 0 of a cut of one."""


class ColliderHandle(NamedTuple):
    """Names a collider of a world."""

    index: int  # type: ignore[assignment]
    generation: int


class ImpulseJointHandle(NamedTuple):
    """Names an impulse joint of a world."""

    index: int  # type: ignore[assignment]
    generation: int


class MultibodyJointHandle(NamedTuple):
    """Names a multibody joint of a world."""

    index: int  # type: ignore[assignment]
    generation: int


class RayIntersection(NamedTuple):
    """Where a ray meets a collider."""

    time_of_impact: float
    """In lengths of the ray's direction."""
    normal: Array
    """Outward normal of the collider."""


class PointProjection(NamedTuple):
    """The point of a collider nearest to another."""

    is_inside: bool
    """Whether the point was in the collider."""
    point: Array
    """In m."""


class RigidBodyHandle(NamedTuple):
    """Names a body of a world."""

    index: int  # type: ignore[assignment]
    generation: int


def section(
    axial: float,
    bending: float,
    mass: float,
    diameter: float | None,
    outer_area: float | None,
    rope: bool = False,
    breaking_load: float | None = None,
) -> Section:
    """Restores a pickled section."""
    from lariat_cables import Section

    shape = {"diameter": diameter, "outer_area": outer_area}
    return Section(axial, bending, mass, rope=rope, breaking_load=breaking_load, **shape)


def _document() -> None:
    """Give each field the text below it, which ``help`` shows: named tuples forget it."""
    try:
        source = Path(__file__).read_text("utf-8")
    except OSError:  # packed without sources
        return
    for own in (node for node in ast.parse(source).body if isinstance(node, ast.ClassDef)):
        for field, text in zip(own.body, own.body[1:], strict=False):
            match field, text:
                case ast.AnnAssign(target=ast.Name(id=name)), ast.Expr(value=ast.Constant(value=str(words))):
                    getattr(globals()[own.name], name).__doc__ = words


_document()
