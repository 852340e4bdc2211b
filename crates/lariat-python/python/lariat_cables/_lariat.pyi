from collections.abc import Callable, Iterable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, final, overload

from numpy.typing import ArrayLike
from typing_extensions import Self

from lariat_cables.bodies import ColliderBuilder, RigidBody, RigidBodyBuilder, RigidBodySet
from lariat_cables.contact import Obstacle
from lariat_cables.effects import Contact, Damping, Effects
from lariat_cables.joints import ImpulseJointSet, MultibodyJointSet
from lariat_cables.node import Node
from lariat_cables.reel import Reel
from lariat_cables.results import (
    Attachment,
    Break,
    CableTouch,
    ColliderHandle,
    EndForces,
    Energy,
    Equilibrium,
    Event,
    MeshIndicator,
    Momentum,
    PointProjection,
    RayIntersection,
    Reaction,
    ReelReading,
    SheaveReading,
    RigidBodyHandle,
    Rope,
    Sample,
    Samples,
    States,
    Touch,
    Twist,
    WorldEnergy,
    WorldEquilibrium,
)
from lariat_cables.types import Array, Fidelity, Handle, Place, Points
from lariat_cables.water import Water

VERSION: str

@final
class Section:
    """Axial stiffness, bending stiffness and mass per length of a cable."""

    def __new__(
        cls,
        axial_stiffness: float,
        bending_stiffness: float,
        mass_per_length: float,
        *,
        diameter: float | None = None,
        outer_area: float | None = None,
        rope: bool = False,
        breaking_load: float | None = None,
    ) -> Self:
        """Measured stiffness: EA in N (> 0), EI in N m^2 (>= 0), mass per unstretched length in kg/m (> 0).

        ``diameter`` (m) is for drag and drawing, ``outer_area`` (m^2) for buoyancy; a ``rope``, or what has a ``breaking_load`` (N),
        cannot push, and is told to be overloaded above that. Raises InvalidValueError.
        """

    @staticmethod
    def round(diameter: float, youngs_modulus: float, density: float) -> Section:
        """A solid round section: m, Pa, kg/m^3. Raises InvalidValueError."""

    @staticmethod
    def square(side: float, youngs_modulus: float, density: float) -> Section:
        """A solid square section: m, Pa, kg/m^3. Raises InvalidValueError."""

    @staticmethod
    def tube(outer: float, inner: float, youngs_modulus: float, density: float) -> Section:
        """A tube: outer and inner diameter in m, Pa, kg/m^3. Raises InvalidValueError."""

    @staticmethod
    def wire_rope(diameter: float) -> Section:
        """A steel wire rope, 6x36WS with an independent wire rope core, of this nominal diameter in m. Raises InvalidValueError."""

    @staticmethod
    def rope(material: str, diameter: float) -> Section:
        """A rope or chain of this nominal diameter in m, that of a chain of its bar, as catalogues have them: ``"nylon"``, ``"polyester"``,
        ``"hmpe"``, ``"wire_rope"`` or ``"chain"``. A cable of it has the axial law ``"rope"``, unless it is
        given another one: force over elongation, and no push.

        Raises BuilderError for another material, InvalidValueError for a diameter that is not positive and at most 0.35 m.
        """

    @staticmethod
    def breaking_load(material: str, diameter: float) -> float:
        """The breaking load in N of such a rope or chain, for ``set_strength``. Raises as ``rope``."""

    @property
    def axial_stiffness(self) -> float:
        """EA in N."""

    @property
    def bending_stiffness(self) -> float:
        """EI in N m^2."""

    @property
    def mass_per_length(self) -> float:
        """Mass per unstretched length in kg/m."""

    @property
    def diameter(self) -> float | None:
        """Outer diameter or side in m; None if no shape was given."""

    @property
    def outer_area(self) -> float | None:
        """Area inside the outline in m^2; None if no shape was given."""

@final
class Integrator:
    """A time integration method and how its steps are chosen."""

    def __new__(
        cls,
        method: str = "esdirk4",
        *,
        tolerance: float | None = None,
        norm: Literal["every", "motion", "bodies"] | None = None,
        substeps: int | None = None,
        max_step: float | None = None,
        adaptive: float | None = None,
        stable: float | None = None,
        dissipation: float | None = None,
    ) -> Self:
        """A method by name (see ``integrators()``), and exactly one of: ``tolerance``, the error of position in m per host step (of the
        errors that ``norm`` selects); ``substeps`` per host step; ``max_step`` in s; ``adaptive``, 1, 2, 4 or 8 equal steps in 1/60 s
        of "discrete-gradient" (1 and 2 keep this error in m in that time, in proportion for cables shorter than 1 m); ``stable``, a share
        in (0, 1] of the stability limit of an explicit method. ``dissipation`` of "discrete-gradient", 0 to 1/16: a motion of angular frequency w loses the share
        a (h w)^3/2 of its amplitude per radian in steps of h; default 1/16, with a tolerance 1/256.

        Raises UnknownIntegratorError, StepControlError, NoErrorEstimateError, NoErrorNormError, NoStabilityLimitError,
        InvalidValueError.
        """

    def __getnewargs_ex__(self) -> tuple[tuple[str], dict[str, float | str]]: ...
    @property
    def method(self) -> str:
        """The name of the method."""

@final
class Cable:
    """A cable of ANCF elements with its rule, integrator and state.

    A point of a cable is "start", "end", an arc length of the unstretched cable in m from its start (float), or a ``lariat.Node``; another
    integer than 0 could be either, and raises AmbiguousPlaceError. Arrays are copies. Any number of threads may use a cable: they wait for
    each other, and other threads run Python while it is stepped.
    """

    def __new__(
        cls,
        points: Points,
        section: Section | Iterable[tuple[float, Section]],
        *,
        length: float | None = None,
        pretension: float | None = None,
        sag: float | None = None,
        elements: int | None = None,
        finest: float | None = None,
        finest_at: Place | Iterable[Place] | None = None,
        name: str = "cable",
        rule: str | None = None,
        allow_rank_deficient: bool = False,
        fidelity: Fidelity | None = None,
        integrator: Integrator | Fidelity | None = None,
        gravity: ArrayLike | None = None,
        velocity: ArrayLike | None = None,
        angular_velocity: ArrayLike | None = None,
        fix: Place | Iterable[Place] | None = None,
        clamp: Place | Iterable[Place] | None = None,
        clamp_along: Iterable[tuple[Place, ArrayLike]] | None = None,
        nodes_at: Sequence[float] | None = None,
        effects: Effects = None,
        damped_as: str | None = None,
    ) -> Self:
        """A cable through ``points`` (m, shape (n, 3), n >= 2) of one section, or of several: (arc length in m where it begins, section).

        - ``length``: unstretched, in m; by default that of the polyline. Longer: it starts slack, in arcs that sag along gravity.
        - ``pretension``, ``sag``: instead of ``length``, that with which it has this tension in N at its middle, or hangs by this distance in m
          below the line between its ends, when it hangs between them under its weight, loads per length and buoyancy.
        - ``elements``: default 10. ``nodes_at``: arc lengths in m that get a node.
        - ``finest``: length in m of the elements at ``finest_at``, by default both ends, from where they grow by a constant ratio up to
          their number: for moments at clamps and loads, within ``sqrt(EI/T)`` of which a cable under a tension T bends.
        - ``rule``: "projected-3" (default), "G5-3", "ST2", "L2T2" ...
        - ``fidelity`` ("engineering" by default) or ``integrator``.
        - ``gravity``: m/s^2, default (0, -9.81, 0). ``velocity`` (m/s) and ``angular_velocity`` (rad/s): a rigid motion of the start.
        - ``fix``, ``clamp``: points held as they start; a clamp holds the tangent in the direction of the polyline, too, also
          of a slack cable, which starts in equilibrium between its clamps. A node is placed there.
        - ``clamp_along``: clamps with their directions, as pairs of a place and a vector of any size.
        - ``effects``: see lariat.effects. ``damped_as``: a kind of rope, see ``rope_kinds()``.

        Raises InvalidValueError, ShapeError, TooFewPointsError, CoincidentPointsError, ElementCountError, NoSectionError,
        RankDeficientError, OutOfRangeError, NodeBeforeMeshError, EffectsError, MissingForEffectError, ExplicitDampingError and those of
        unknown names.
        """

    def step(self, dt: float, *, steps: int = 1) -> None:
        """Advances the cable by ``steps`` steps of ``dt`` (s); 0 does nothing. Ctrl-C ends it after a step. The first warning of each kind goes
        through Python's ``warnings`` as ``errors.ResultWarning``; ``warnings()`` has all. Raises InvalidValueError, AttachedError, InWorldError,
        and StepFailedError, after which the cable is as it was before the step that failed."""

    def equilibrium(self, *, tolerance: float = 1e-9, iterations: int = 400) -> Equilibrium:
        """Moves the cable to static equilibrium. ``tolerance``: largest residual force over the sum of the loads. Raises
        NoEquilibriumError, after which the cable is as it was; AttachedError, InWorldError."""

    def to_bytes(self) -> bytes:
        """Returns description and state; ``from_bytes`` continues the run bitwise. Pickle uses it."""

    @staticmethod
    def from_bytes(bytes: bytes) -> Cable:
        """Returns a saved cable of the same version. Raises FormatError."""

    def snapshot(self) -> bytes:
        """Returns the state alone, for ``restore``."""

    def restore(self, snapshot: bytes) -> None:
        """Restores a state of this cable; the run continues bitwise from there. Raises FormatError, WrongCountError."""

    def copy(self) -> Cable:
        """Returns a copy; that of a cable of a world belongs to no world."""

    def __copy__(self) -> Cable: ...
    def __deepcopy__(self, memo: dict[int, Any], /) -> Cable: ...
    @property
    def name(self) -> str:
        """Name in errors."""

    @property
    def time(self) -> float:
        """Time of the state in s. Set: prescribed motions and ramps keep their distance from it; raises InWorldError, InvalidValueError."""

    @time.setter
    def time(self, value: float) -> None: ...
    @property
    def length(self) -> float:
        """Unstretched length in m."""

    @property
    def elements(self) -> int:
        """Number of elements."""

    @property
    def nodes(self) -> int:
        """Number of nodes: one more than elements."""

    @property
    def sections(self) -> list[Section]:
        """Sections by element."""

    @property
    def arc_lengths(self) -> Array:
        """Arc lengths of the nodes in m, shape (nodes,)."""

    @property
    def rule(self) -> str:
        """Rule of the elastic forces. Set: raises UnknownRuleError, RankDeficientError, MissingForEffectError."""

    @rule.setter
    def rule(self, value: str) -> None: ...
    @property
    def integrator(self) -> Integrator:
        """The time integrator. Set to an Integrator or the name of a fidelity: raises ExplicitDampingError."""

    @integrator.setter
    def integrator(self, value: Integrator | Fidelity) -> None: ...
    @property
    def gravity(self) -> Array:
        """Gravity in m/s^2, shape (3,). Set: raises ShapeError, InvalidValueError."""

    @gravity.setter
    def gravity(self, value: ArrayLike) -> None: ...
    @property
    def effects(self) -> dict[str, Any]:
        """Effects that are on, by key. Set to an effect, a list of them or a dict: replaces all; raises EffectsError, MissingForEffectError,
        ExplicitDampingError."""

    @effects.setter
    def effects(self, value: Effects) -> None: ...
    @property
    def positions(self) -> Array:
        """Positions of the nodes in m, shape (nodes, 3)."""

    @property
    def slopes(self) -> Array:
        """Slope vectors dr/ds of the nodes, shape (nodes, 3)."""

    @property
    def velocities(self) -> Array:
        """Velocities of the nodes in m/s, shape (nodes, 3)."""

    @property
    def coordinates(self) -> Array:
        """Nodal coordinates, shape (nodes, 6): position in m and slope."""

    @property
    def rates(self) -> Array:
        """Rates of the nodal coordinates, shape (nodes, 6): m/s and 1/s."""

    def read_into(self, coordinates: Array) -> None:
        """Copies the nodal coordinates into a contiguous array of shape (nodes, 6). Raises ShapeError."""

    def set_state(self, coordinates: ArrayLike, rates: ArrayLike) -> None:
        """Sets nodal coordinates and their rates, both of shape (nodes, 6). If coordinates change, contacts are forgotten: friction begins
        anew, and the depth at which the cable is set gives no force. ``restore`` keeps them. Raises ShapeError, InvalidValueError."""

    def set_rigid_motion(self, velocity: ArrayLike, angular_velocity: ArrayLike | None = None) -> None:
        """Sets the velocities of a rigid motion: ``velocity`` (m/s) of the start, ``angular_velocity`` (rad/s) about it. Raises ShapeError,
        InvalidValueError."""

    @overload
    def sample(self, at: Place) -> Sample: ...  # type: ignore[overload-overlap]
    @overload
    def sample(self, at: Sequence[Place] | Array) -> Samples:
        """Reads the cable at one point, or at several: a sequence of points, or an array of arc lengths in m of shape (n,). Raises
        OutOfRangeError, ShapeError, AmbiguousPlaceError."""

    def warnings(self) -> list[str]:
        """Returns what the cable says about its mesh, steps, energy, law and sizes, in all its steps; what is beyond the ``warn_level`` of its
        world, of its present shape."""

    def peak_tension(self) -> tuple[float, float]:
        """Returns the arc length in m of the largest tension, and that tension in N."""

    def reactions(self) -> list[Reaction]:
        """Returns forces and moments of the supports on the cable, by ascending node. Raises StepFailedError."""

    def energy(self) -> Energy:
        """Returns kinetic, axial, bending, gravity and torsion energy in J."""

    def torsion(self) -> list[Twist]:
        """Returns torque and twist between each two neighbouring clamps that hold the spin."""

    def momentum(self) -> Momentum:
        """Returns linear momentum in kg m/s, and angular momentum about the origin in kg m^2/s."""

    def mesh_indicator(self) -> MeshIndicator:
        """Returns what the shape says about the error of the mesh."""

    def natural_frequencies(self) -> Array:
        """Returns the angular frequencies in rad/s of small motions about the present state, ascending. Dense: for hundreds of nodes."""

    def damping_at_mode(self, ratio: float, mode: int) -> Damping:
        """Returns the damping that damps the ``mode``-th frequency, from 1, by this ratio of critical. Raises OutOfRangeError."""

    def diagnostics(self) -> dict[str, Any]:
        """Returns counts of steps, iterations and evaluations."""

    def node(self, at: Place) -> Node:
        """Returns the node at a point. Raises OutOfRangeError, NoNodeError."""

    def insert_node(self, at: Place) -> Node:
        """Returns the node at a point, and places one if there is none. Raises OutOfRangeError, InWorldError."""

    def fix(self, at: Place) -> None:
        """Holds the position of a node where it is. Raises OutOfRangeError, NoNodeError."""

    def clamp(self, at: Place, direction: ArrayLike | None = None) -> None:
        """Holds the position of a node as it is and its tangent along ``direction``, by default as it is; at an end of a slack cable as it
        was laid, as drawn. Raises as ``fix``, NoTangentError, and InvalidValueError for a direction of size zero."""

    def release(self, at: Place) -> None:
        """Frees a node. Raises as ``fix``."""

    def prescribe(self, at: Place, position: ArrayLike, duration: float, velocity: ArrayLike | None = None) -> None:
        """Prescribes the position of a node: the cubic from where it is, at its present velocity, to ``position`` (m) at ``velocity``
        (m/s; default 0) a time ``duration`` (s) later; then it is held there. ``restore`` restores it. Raises OutOfRangeError, NoNodeError,
        ShapeError, InvalidValueError."""

    def add_load(
        self,
        at: Place,
        force: ArrayLike | None = None,
        *,
        moment: ArrayLike | None = None,
        ramp: float = 0.0,
        history: Sequence[tuple[float, float]] | None = None,
    ) -> None:
        """Adds a force (N) and moment (N m) in world axes at a point, ramped over ``ramp`` s, times the factor of ``history``:
        rows of seconds from now and factor, linear between them, constant outside. Raises OutOfRangeError, InvalidValueError."""

    def clear_loads(self) -> None:
        """Removes all point loads."""

    def sample_flow(self, velocities: ArrayLike) -> None:
        """Samples a flow at the nodes, in m/s, shape (nodes, 3): valid until the next call, on top of that of the drag. Raises
        MissingForEffectError, WrongCountError."""

    def redefine(
        self, *, rule: str | None = None, effects: Effects = None, integrator: Integrator | Fidelity | None = None
    ) -> None:
        """Replaces rule, effects and integrator together, where one needs the other. Raises UnknownRuleError, RankDeficientError,
        EffectsError, MissingForEffectError, ExplicitDampingError; the cable is then as it was."""

    def cut(self, at: Place) -> Cable:
        """Cuts the cable; this one keeps the part before the point, the other is returned. Raises OutOfRangeError, InWorldError."""

    def set_obstacles(self, obstacles: Iterable[Obstacle]) -> None:
        """Sets what the cable can touch from the next step on, in place of the obstacles it had; their velocities count from now. It touches
        them if it has the effect Contact. ``to_bytes``, ``copy`` and ``cut`` keep them. Raises InWorldError, InvalidValueError,
        BuilderError."""

    def contacts(self) -> list[Touch]:
        """Returns what the cable touched at the end of the last step, by the index of the obstacle. Raises InWorldError."""

    def contact_energy(self) -> float:
        """Returns the energy in J that contacts store."""

    def add_reel(self, at: Place, reel: Reel) -> None:
        """Puts a reel at an end: from the next step on it pays cable out and takes it in through that node, which a support or an
        attachment must hold. Raises ReelPlaceError, ExplicitReelError, ReelMethodError, NotWithReelError, InvalidValueError,
        BuilderError."""

    def set_reel(self, at: Place, reel: Reel) -> None:
        """Changes what the reel at an end does from now on. Raises ReelPlaceError, ReelMethodError, InvalidValueError, BuilderError."""

    def set_reel_length(self, at: Place, length: float, rate: float) -> None:
        """Lets the reel at an end come to a length of cable (m) that is out, with at most a rate (m/s), and stop there. Raises as ``set_reel``."""

    def set_reel_rate(self, at: Place, rate: float) -> None:
        """Changes the rate of the reel at an end in m/s: positive pays out. Raises as ``set_reel``."""

    def remove_reel(self, at: Place) -> None:
        """Takes the reel at an end away; what is out stays. Does nothing without a reel. Raises UnknownPlaceError."""

    def reel(self, at: Place) -> ReelReading | None:
        """Returns what the reel at an end does now; None without one. Raises UnknownPlaceError."""

    def reel_description(self, at: Place) -> Reel | None:
        """Returns the reel at an end as it was described; None without one. Raises UnknownPlaceError."""

    def set_strength(self, tension: float | None = None, *, strain: float | None = None) -> None:
        """Sets the tension in N and the strain above which ``break_overloaded`` breaks the cable; None: no limit. Raises InvalidValueError,
        OneElementError, InWorldError."""

    def break_overloaded(self) -> tuple[Cable, Break] | None:
        """Breaks the cable at the inner node that exceeds its strength most; this one keeps the part before it. Returns the part behind it
        and why it broke, or None if it holds. Raises InWorldError."""

def step_all(cables: Sequence[Cable], dt: float, *, steps: int = 1) -> States:
    """Advances cables that nothing connects by ``steps`` steps of ``dt`` (s), on all threads, and returns their states as arrays. Warns as
    ``Cable.step`` does, once for all. Raises StepFailedError, that of the first cable that cannot step, after all others have made that step; DuplicateCableError, InWorldError."""

def states(cables: Sequence[Cable]) -> States:
    """Returns the states of cables as arrays, without a step; cables of worlds, too. Raises NoCableError."""

def step_together(cables: Sequence[Cable], dt: float, *, steps: int = 1) -> None:
    """Advances cables that may touch each other (``Contact(cables=True)``) by ``steps`` steps of ``dt`` (s), in one system, with the integrator of
    the first. Warns as ``Cable.step`` does, once for all. Raises DuplicateCableError, EmptyIslandError, TimeMismatchError, StepFailedError; the steps before a failed one are made."""

def integrators() -> list[str]:
    """Returns the names of the integration methods."""

def rope_kinds() -> list[str]:
    """Returns the names of the kinds of rope, by which damping is named."""

def recommended_elements(fidelity: Fidelity = "engineering") -> int:
    """Returns the number of elements that a fidelity recommends. Raises UnknownFidelityError."""

@final
class CoSimulation:
    """A cable on bodies that another program moves: per step it takes their poses, and returns forces, moments and the impedance.

    A body is known by a reference point, by convention its centre of mass. Rotations are quaternions x, y, z, w. ``step`` once per step, with
    the last forces on the bodies, is an explicit exchange: stable where the impedance is small beside the mass matrix of the bodies.
    ``lariat.Exchange`` repeats it until forces and poses agree, and is stable for any.
    """

    def __new__(cls, cable: Cable) -> Self:
        """A co-simulation of this cable, which is from now on stepped by it. Raises InWorldError."""

    @property
    def cable(self) -> Cable:
        """The cable, to read it."""

    def attach(self, at: Place, position: ArrayLike, rotation: ArrayLike | None = None, *, clamp: bool = False) -> int:
        """Attaches a node to a body whose reference point is at ``position`` (m) with ``rotation``: where the node is now. A clamp holds the
        direction of the tangent, too. Returns the index of the end. Raises OutOfRangeError, NoNodeError, AlreadyAttachedError (by this or
        another co-simulation)."""

    def step(
        self,
        dt: float,
        positions: ArrayLike,
        rotations: ArrayLike | None = None,
        velocities: ArrayLike | None = None,
        angular_velocities: ArrayLike | None = None,
    ) -> EndForces:
        """Advances the cable by ``dt`` (s) while the bodies move to ``positions`` (m, shape (ends, 3)), ``rotations`` (shape (ends, 4);
        default: unchanged) with ``velocities`` (m/s) and ``angular_velocities`` (rad/s) at the end of the step (shape (ends, 3); default:
        uniform motion over the step). Warns as ``Cable.step`` does. Raises ShapeError, InvalidValueError, GapTooLongError (something else
        moved an end by more than 1e-3 m), and StepFailedError, after which all is as before."""

    def impedance(self, dt: float) -> Array:
        """Returns Z, shape (6 ends, 6 ends), velocity before angular velocity of each end, about the reference points, in kg, kg m and
        kg m^2: if the velocities at the end of a step of ``dt`` (s) differ by dv from the prescribed ones, the impulse on the bodies differs by
        -Z dv. Raises InvalidValueError."""

    def snapshot(self) -> bytes:
        """Returns the state of cable and ends, for ``restore``."""

    def restore(self, snapshot: bytes) -> None:
        """Restores a state of this co-simulation; the run continues bitwise from there. Raises FormatError, WrongCountError."""

    def copy(self) -> CoSimulation:
        """Returns a copy with a cable of its own, obstacles included. ``copy.copy`` and ``copy.deepcopy`` use it."""

    def __copy__(self) -> CoSimulation: ...
    def __deepcopy__(self, memo: dict[int, Any], /) -> CoSimulation: ...

    def to_bytes(self) -> bytes:
        """Returns cable, obstacles and ends; ``from_bytes`` continues the run bitwise. Pickle uses it."""

    @staticmethod
    def from_bytes(bytes: bytes) -> CoSimulation:
        """Returns a saved co-simulation of the same version. Raises FormatError."""

@final
class World:
    """rapier3d with cables on its bodies. Names are those of the ``rapier3d`` wheel where they overlap; bodies have single precision."""

    def __new__(
        cls,
        gravity: ArrayLike | None = None,
        *,
        dt: float = ...,
        fidelity: Fidelity = "game",
        rapier_steps: int = 1,
        max_rapier_steps: int = 32,
        sleep_speed: float = 2e-3,
        max_iterations: int | None = None,
        max_time: float | None = None,
        warn_level: Literal["setup", "wrong", "coarse"] | None = None,
    ) -> Self:
        """A world of this gravity (m/s^2, default (0, -9.81, 0)) and host step (s, default 1/60). ``fidelity``: of cables whose
        integrator nobody chose. ``rapier_steps``, ``max_rapier_steps``: Rapier's steps per host step. ``sleep_speed``: in m/s, below
        which cables and bodies may fall asleep; 0 = never. ``max_iterations`` (Newton iterations of each island, repeatable) or
        ``max_time`` (wall-clock s): the work of a host step beyond which accuracy is reduced, with the event "degraded"; by default 2000
        iterations per 1/60 s for cables with fidelity game, and no limit for others, nor for any with ``max_time=math.inf``. ``warn_level``:
        up to which level ``warnings`` and events warn; by default of cables with fidelity game up to "wrong", of others up to "coarse". Raises
        InvalidValueError, UnknownFidelityError, UnknownKindError."""

    def step(self, dt: float | None = None) -> None:
        """Advances bodies and cables by ``dt`` (s); without, by that of the world. The first warning of each kind, before the first step and
        after each, goes through Python's ``warnings`` as ``errors.ResultWarning``; ``warnings()`` has all. Raises InvalidValueError, and
        StepRefusedError if some cables cannot step; all others have advanced."""

    def add_body(self, builder: RigidBodyBuilder, colliders: Sequence[ColliderBuilder] | None = None) -> RigidBodyHandle:
        """Adds a body with its colliders. Raises InvalidValueError, BuilderError."""

    def remove_body(self, handle: Handle) -> None:
        """Removes a body with its colliders; attachments to it end at the next step. Raises NoBodyError."""

    def move_bodies(self, bodies: Sequence[Handle], translation: ArrayLike | None = None, rotation: ArrayLike | None = None) -> None:
        """Moves bodies by ``translation`` (m) after a turn by the rotation vector ``rotation`` (rad) about the origin, in world axes, with the cables that
        are attached to them and those tied to these: a teleport without a jolt. Velocities turn with them, strains and tensions stay; contacts
        begin anew. Raises HeldInMoveError, JointInMoveError, NoBodyError, OtherWorldError, InvalidValueError; nothing has moved then."""

    @property
    def rigid_bodies(self) -> RigidBodySet:
        """The bodies, by handle."""

    def add_collider(self, builder: ColliderBuilder, parent: Handle | None = None) -> ColliderHandle:
        """Adds a collider to a body, or one fixed in the world. Raises NoBodyError, BuilderError, InvalidValueError."""

    def remove_collider(self, handle: Handle) -> None:
        """Removes a collider. Raises NoColliderError."""

    def collider_parent(self, collider: Handle) -> RigidBodyHandle | None:
        """Returns the body of a collider; None for one without. Raises NoColliderError."""

    @property
    def impulse_joints(self) -> ImpulseJointSet:
        """The impulse joints, by handle."""

    @property
    def multibody_joints(self) -> MultibodyJointSet:
        """The multibody joints, by handle."""

    def cast_ray(
        self,
        origin: ArrayLike,
        direction: ArrayLike,
        max_toi: float,
        solid: bool = True,
        *,
        exclude_rigid_body: Handle | None = None,
    ) -> tuple[ColliderHandle, float] | None:
        """Returns the first collider on the ray ``origin + t direction`` (m), and its t up to ``max_toi``; None if there is none. With
        ``solid`` a ray from inside meets it at 0, else its far side. Queries see colliders as of the last step. Raises
        InvalidValueError."""

    def cast_ray_and_get_normal(
        self,
        origin: ArrayLike,
        direction: ArrayLike,
        max_toi: float,
        solid: bool = True,
        *,
        exclude_rigid_body: Handle | None = None,
    ) -> tuple[ColliderHandle, RayIntersection] | None:
        """As ``cast_ray``, with the normal. Raises InvalidValueError."""

    def project_point(
        self, point: ArrayLike, solid: bool = True, *, max_dist: float = 1e15, exclude_rigid_body: Handle | None = None
    ) -> tuple[ColliderHandle, PointProjection] | None:
        """Returns the collider nearest to a point (m) within ``max_dist``, and its nearest point; None if there is none. With ``solid`` a
        point inside is its own projection. Raises ShapeError, InvalidValueError."""

    def intersect_point(self, point: ArrayLike, *, exclude_rigid_body: Handle | None = None) -> list[ColliderHandle]:
        """Returns the colliders that contain a point (m). Raises ShapeError, InvalidValueError."""

    def set_contact(self, cable: Cable, contact: Contact | None) -> None:
        """Lets a cable touch the colliders, and other cables and itself if the contact says so, or no longer with None; it gets the integrator "discrete-gradient" if nobody chose one. Raises
        InvalidValueError, MissingForEffectError (no diameter and no radius), ContactMethodError, NoCableError."""

    def set_contact_rules(
        self,
        cable: Cable,
        *,
        collision_groups: tuple[int, int] | None = None,
        solver_groups: tuple[int, int] | None = None,
        friction_combine_rule: Literal["average", "min", "multiply", "max"] = "average",
        restitution_combine_rule: Literal["average", "min", "multiply", "max"] = "average",
    ) -> None:
        """Sets the groups of a cable as bits (memberships, filter), None: all; and how its friction and restitution are combined
        with those of colliders. Raises OtherWorldError, NoCableError."""

    def contacts(self, cable: Cable) -> list[Touch]:
        """Returns what a cable touched at the end of the last step, each with its collider. Raises OtherWorldError, NoCableError."""

    def cable_contacts(self, cable: Cable) -> list[CableTouch]:
        """Returns what a cable touched of others and of itself at the end of the last step, if its contact says that it may. Raises
        NoCableError."""

    def add_cable(self, cable: Cable) -> Cable:
        """Adds a copy of a cable, and returns it as a part of this world. Raises NoCableError for one that was removed from its world."""

    @property
    def cables(self) -> list[Cable]:
        """All cables."""

    def cable(self, name: str) -> Cable:
        """Returns the first cable of this name. Raises NoCableError, with the names that there are."""

    def body(self, name: str) -> RigidBody:
        """Returns the body that the scene of :func:`lariat.load` calls so. Raises NoBodyError, with the names that there are."""

    def remove_cable(self, cable: Cable) -> Cable:
        """Removes a cable with its attachments, and returns it by itself. Raises NoCableError, OtherWorldError."""

    def cut(self, cable: Cable, at: Place) -> Cable:
        """Cuts a cable; it keeps the part before the point, the other is returned. Raises OutOfRangeError."""

    def add_rope(
        self,
        start: ArrayLike,
        end: ArrayLike,
        section: Section,
        *,
        start_body: Handle | None = None,
        end_body: Handle | None = None,
        slack: float = 0.0,
        length: float | None = None,
        strength: float | None = None,
        elements: int | None = None,
        fidelity: Fidelity | None = None,
        name: str = "rope",
    ) -> Rope:
        """Adds the usual rope between two points (m), each held by a body or by the world, damped by 0.2 of critical at its lowest axial
        mode. ``slack``: unstretched length beyond the distance, as a share of it; ``length``: unstretched length in m, in place of a slack;
        ``strength``: tension in N above which it breaks; ``elements``: default that of fidelity game. Raises NoBodyError, CoincidentPointsError, InvalidValueError, ElementCountError."""

    def set_strength(self, cable: Cable, tension: float | None = None, *, strain: float | None = None) -> None:
        """Sets the tension in N and the strain above which a cable breaks; None: no limit. Raises InvalidValueError, OneElementError,
        NoCableError."""

    def attach(
        self,
        cable: Cable,
        at: Place,
        body: Handle,
        anchor: ArrayLike | None = None,
        *,
        kind: Literal["ball", "clamp"] = "ball",
        gap: float | None = 1e-3,
        direction: ArrayLike | None = None,
    ) -> int:
        """Attaches a point of a cable to a body: at ``anchor`` (m, body axes), by default where the point is now. ``gap``: the largest
        distance in m that is closed; None: any. ``direction``: of the tangent of a clamp, in body axes; by default as it is, of a slack
        cable as it was laid that of the drawing. Returns the number of the attachment. Raises GapTooLongError, AlreadyAttachedError,
        NoBodyError, NoCableError, OutOfRangeError."""

    def detach(self, attachment: int | str) -> None:
        """Ends an attachment, by its number or its name in the scene. Raises NoAttachmentError."""

    def attachment(self, attachment: int | str) -> Attachment:
        """Returns what the cable does to the body, after the last step; of an attachment by its number, or its name in the scene. Raises NoAttachmentError."""

    def join(self, first: Cable, at: Place, second: Cable, second_at: Place, *, gap: float | None = 1e-3) -> int:
        """Ties a point of a cable to a point of another, like a massless shackle; ``gap``: the largest distance in m that is closed, None:
        any. Returns the number of the junction; that of one of the points, if it is tied already. Raises GapTooLongError,
        AlreadyAttachedError, NoCableError, OutOfRangeError."""

    def add_kink(self, cable: Cable, at: Place) -> tuple[Cable, int]:
        """Frees the slope of a cable at a point between its ends, on both sides, as a hinge does: where a point load or a junction bends a
        cable that is limp, sqrt(EI/T) far below an element. The cable becomes two that share the point; ``cable`` keeps the part before it.
        Returns the other part and the number of the junction of both. No moment and no torque goes through it. Raises NoCableError,
        AlreadyAttachedError, OutOfRangeError, NotWithReelError."""

    def leave(self, junction: int, cable: Cable) -> None:
        """Unties a cable from a junction; one with a single point left ends. Raises NoJunctionError, NoCableError."""

    def junction(self, junction: int) -> list[tuple[Cable, float]]:
        """Returns the cables of a junction, each with the arc length of its point in m. Raises NoJunctionError."""

    def add_sheave(
        self,
        first: Cable,
        at: Place,
        second: Cable,
        second_at: Place,
        *,
        inertia: float = 0.0,
        friction: float = 0.0,
        turns: float = 0.0,
        brake: float = 0.0,
    ) -> int:
        """Lets the first cable run into the second over a wheel, where an end of each is attached to one point of a body. ``inertia``: that of
        the wheel over the square of its radius, in kg; ``friction``: tensions differ by up to exp(friction angle); ``turns``: angle in rad
        wound beyond that between the two; ``brake``: constant friction in N. Both need the integrator "discrete-gradient" and one section.
        Returns the number of the sheave. Raises ReelPlaceError, ReelMethodError, NotWithReelError, InvalidValueError, NoCableError; what makes no sheave beyond that is an error of the next step."""

    def add_sheave_at(
        self,
        cable: Cable,
        at: Place,
        body: Handle,
        anchor: ArrayLike,
        *,
        inertia: float = 0.0,
        friction: float = 0.0,
        turns: float = 0.0,
        brake: float = 0.0,
    ) -> tuple[int, Cable]:
        """Lets a cable run over an eye at ``anchor`` of a body (m, body axes), within 1 mm of a point between its ends; an arc length counts along all
        :meth:`parts`. Other arguments as in :meth:`add_sheave`. Returns the number of the sheave, and the part of the cable behind it. Raises GapTooLongError,
        AlreadyAttachedError, NoBodyError, ReelPlaceError, ReelMethodError, NotWithReelError, OutOfRangeError, InvalidValueError, NoCableError; nothing
        changes then."""

    def parts(self, cable: Cable) -> list[Cable]:
        """Returns the parts of a cable that runs over sheaves along it, from start to end. Raises NoCableError."""

    def remove_sheave(self, sheave: int | str) -> None:
        """Ends a sheave: what is on its sides stays there. Raises NoSheaveError."""

    def sheave(self, sheave: int | str) -> SheaveReading:
        """Returns what a sheave did so far, by its number or its name in the scene. Raises NoSheaveError."""

    def add_drum(
        self, cable: Cable, at: Place, body: Handle, axis: ArrayLike, radius: float, *, stock: float | None = None, inertia: float = 0.0
    ) -> None:
        """Winds an end of a cable on a dynamic body that turns about ``axis`` (in its frame; positive spin pays out): the cable runs at
        ``radius`` (m), and its pull turns the body. ``stock``: largest length in m that can be out; ``inertia``: what the drum carries beside
        the body's own, over the square of the radius, in kg. Needs the integrator "discrete-gradient". Raises DrumBodyError, NoBodyError,
        ReelPlaceError, ReelMethodError, NotWithReelError, InvalidValueError, NoCableError; a step raises DrumJoinedError."""

    def remove_drum(self, cable: Cable, at: Place) -> bool:
        """Ends the drum at an end of a cable: what is out stays. Returns whether there was one. Raises NoCableError."""

    def equilibrium(self) -> WorldEquilibrium:
        """Moves cables and the bodies on them, as their joints allow, to static equilibrium; true if all is stable. Cables with contact lie on fixed and kinematic
        colliders, without friction; where bodies touch others or would fall on them, or cables touch each other, themselves or bodies that they move, all
        comes to rest by its motion, from where it is drawn. Raises NoEquilibriumError, JointInStaticsError, CableTouchesInStaticsError, and, where not all
        comes to rest, NotHeldInStaticsError, ContactInStaticsError, CablesPassInStaticsError, CablePassesBodyInStaticsError, MovesInStaticsError; all is then as before."""

    def warnings(self) -> list[str]:
        """Returns what all cables say about their mesh, steps, energy, law and sizes, and about colliders that they are in or do not bounce off.
        Worth a look when a world has been built."""

    def is_asleep(self, cable: Cable) -> bool:
        """Returns whether a cable is asleep with the bodies attached to it. Raises OtherWorldError, NoCableError."""

    def events(self) -> list[Event]:
        """Returns the events of the last step."""

    def energy(self) -> WorldEnergy:
        """Returns energies in J."""

    def momentum(self) -> Momentum:
        """Returns the momentum of cables and bodies."""

    def set_water(self, water: Water | None) -> None:
        """Sets the water of the world; bodies that are in it stay, with their added mass. None takes it away, with all that is in it.
        Raises InvalidValueError."""

    def immerse(
        self,
        body: Handle,
        drag_area: ArrayLike | None = None,
        *,
        spin_drag: ArrayLike | None = None,
        added_mass: float | ArrayLike | None = None,
        volume: float | None = None,
    ) -> None:
        """Puts a dynamic body into the water: buoyancy, the forces of its wave, drag, and added mass.

        ``drag_area`` is drag coefficient times area (m^2), ``spin_drag`` the coefficient of the quadratic drag of rotation (m^5), both (3,) along
        the axes of the body, none by default. ``added_mass`` is the coefficient on the mass that it displaces, 0.5 of a sphere: a
        number, or (3,) along the axes of the body. ``volume`` (m^3) is by default that of its colliders. The body has now its mass and
        colliders; call it again after they change. Raises NoWaterError, NoBodyError, NotDynamicError, WaterValueError, NoVolumeError."""

    def emerge(self, body: Handle) -> bool:
        """Takes a body out of the water, with its added mass; returns whether it was in it. Raises TypeError for what is no handle."""

    def water_work(self, body: Handle) -> float | None:
        """Returns the work of the water in J on a body since it is in it; None for one that is not. Raises TypeError for what is no handle."""

    @property
    def time(self) -> float:
        """Simulated time in s."""

    @property
    def dt(self) -> float:
        """The host step in s. Set: raises InvalidValueError."""

    @dt.setter
    def dt(self, value: float) -> None: ...
    @property
    def gravity(self) -> Array:
        """Gravity in m/s^2, shape (3,). Set: raises ShapeError, InvalidValueError."""

    @gravity.setter
    def gravity(self, value: ArrayLike) -> None: ...
    def snapshot(self) -> bytes:
        """Returns bodies and cables, for ``restore``."""

    def restore(self, snapshot: bytes) -> None:
        """Restores bodies and cables of a snapshot of the same version; the run continues bitwise from there. Cables and handles of what is
        in it stay valid; those of what was added since raise NoCableError, NoBodyError. Raises FormatError, after which all is as
        before."""

    def to_bytes(self) -> bytes:
        """Returns bodies and cables; ``from_bytes`` continues the run bitwise. Pickle uses it."""

    @staticmethod
    def from_bytes(bytes: bytes) -> World:
        """Returns a saved world of the same version, from ``to_bytes`` or ``snapshot``. Raises FormatError."""

    def _add_body(self, body: dict[str, Any], colliders: Sequence[dict[str, Any]]) -> tuple[int, int]: ...
    def _add_collider(self, collider: dict[str, Any], body: Handle | None) -> tuple[int, int]: ...
    def _insert_joint(self, first: Handle, second: Handle, joint: dict[str, Any], multibody: bool) -> tuple[int, int]: ...
    def _remove_joint(self, handle: Handle, multibody: bool) -> None: ...
    def _joints(self, multibody: bool) -> list[tuple[tuple[int, int], tuple[int, int], tuple[int, int]]]: ...
    def _body_names(self) -> list[str]: ...
    def _handles(self) -> list[tuple[int, int]]: ...
    def _body(self, handle: Handle) -> tuple[Array, list[float], Array, Array, float, bool]: ...
    def _set_body(self, handle: Handle, what: str, value: ArrayLike) -> None: ...
    def _set_rotation(self, handle: Handle, q: Sequence[float], next: bool) -> None: ...
    def _reset_forces(self, handle: Handle) -> None: ...

@final
class Recorded:
    def page(self) -> str: ...
    def svg(self) -> str: ...
    def usd(self) -> str: ...
    def state(self) -> str: ...

@final
class Stop:
    def __new__(cls) -> Self: ...
    def set(self) -> None: ...

@final
class Film:
    def __new__(cls, name: str, gravity: ArrayLike) -> Self: ...
    def take_world(self, world: World) -> None: ...
    def take_cables(self, cables: Sequence[Cable]) -> None: ...
    def page(self, series: Sequence[tuple[str, Sequence[str], Sequence[float]]], told: Sequence[str]) -> str: ...
    def svg(self) -> str: ...

def import_mjcf(file: str, text: str) -> str: ...
def save_files(folder: str | PathLike[str], files: list[tuple[str, str]]) -> None: ...
def save_file(path: str | PathLike[str], text: str, format: str) -> None: ...
def load_scene(file: str, text: str, overrides: list[str]) -> tuple[World, list[str]]: ...
def run_command(arguments: list[str]) -> int: ...
def scene_keys(path: str | None) -> str: ...
def scene_rules() -> str: ...
def to_toml(scene: dict[str, Any]) -> str: ...
def run_scene(
    file: str,
    text: str,
    overrides: list[str],
    *,
    statics: bool = False,
    error: float | str | None = None,
    start: tuple[str, str] | None = None,
    progress: Callable[[float], None] | None = None,
) -> tuple[dict[str, Any], Mapping[str, tuple[list[str], Array]], Any, Recorded]: ...
def sweep_check(file: str, text: str, points: list[list[str]]) -> None: ...
def sweep_row(file: str, text: str, settings: list[str]) -> str: ...
def sweep_run(
    file: str, text: str, settings: list[str], stop: Stop
) -> tuple[str, tuple[dict[str, Any], Mapping[str, tuple[list[str], Array]], Any, Recorded] | None]: ...
def sweep_done(file: str, text: str, points: list[list[str]], out: str | PathLike[str]) -> list[str | None]: ...
def sweep_append(file: str, text: str, row: str, out: str | PathLike[str]) -> None: ...
def sweep_table(rows: list[str], out: str | PathLike[str]) -> None: ...
def sweep_local(
    file: str,
    text: str,
    points: list[list[str]],
    out: str | PathLike[str] | None = None,
    *,
    threads: int = 0,
    progress: Callable[[float], None] | None = None,
) -> list[str]: ...
