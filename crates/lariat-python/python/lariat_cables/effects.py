"""Effects of a cable beside inertia, elasticity and point loads; each is off unless given.

A cable takes one effect, a list of them, or a dict by key as scene files have it.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any, ClassVar, Union

Vector = Sequence[float]


@dataclass(frozen=True)
class GravityScale:
    """Factor on gravity for this cable."""

    factor: float
    key: ClassVar[str] = "gravity_scale"


@dataclass(frozen=True)
class Buoyancy:
    """Buoyancy and added mass."""

    fluid_density: float
    """In kg/m^3, > 0."""
    added_mass: float = 1.0
    """Coefficient of added mass, >= 0; 1 for a circle in ideal flow."""
    area: float | None = None
    """Displaced area in m^2; by default that inside the outline of the section."""
    surface: Mapping[str, Any] | None = None
    """The free surface of the fluid, as that of a :class:`Flow`; by default the fluid is everywhere."""
    key: ClassVar[str] = "buoyancy"


@dataclass(frozen=True)
class Damping:
    """Kelvin-Voigt damping: the times by which the rates of strain and curvature count."""

    axial: float
    """In s, >= 0."""
    bending: float
    """In s, >= 0."""
    key: ClassVar[str] = "damping"

    @classmethod
    def from_ratio(cls, ratio: float, angular_frequency: float) -> Damping:
        """The times that damp an elastic mode of this angular frequency (rad/s) with this ratio of critical damping."""
        return cls(2.0 * ratio / angular_frequency, 2.0 * ratio / angular_frequency)


@dataclass(frozen=True)
class Motor:
    """A motor that turns the spin of a clamped end at a constant rate."""

    rate: float
    """Turns per second, right-handed about the cable in the direction of arc length."""
    start: float = 0.0
    """Time in s at which it starts."""
    until: float = sys.float_info.max
    """Time in s at which it stops, and holds."""


@dataclass(frozen=True)
class MotorCourse:
    """A motor that turns the spin of a clamped end by a course."""

    rows: Sequence[Sequence[float]]
    """``[[time in s, turns], ...]``, times ascending; turns are right-handed about the cable in the direction of arc length. Between rows the
    rate is continuous (cubics), and zero between equal ones; before the first row and behind the last it holds."""


@dataclass(frozen=True)
class Torsion:
    """Torsion: one torque between two clamps that hold the spin. On bodies and with reels it needs the integrator
    "discrete-gradient"."""

    stiffness: float
    """GJ in N m^2, > 0."""
    initial_twist: float = 0.0
    """Turns by which the cable is twisted as built."""
    damping: float = 0.0
    """Time in s by which the twist is damped, >= 0: that of a damping ratio z at omega rad/s is 2 z/omega. A hook on a rope with torque per
    tension k gets about GJ/(GJ + EA k^2) of z, and all of it with axial damping of the same time."""
    start: str | Motor | MotorCourse = "held"
    """Whether a clamp at the start holds the spin: "held", "swivel", or a motor."""
    end: str | Motor | MotorCourse = "held"
    """The same at the end."""
    torque_per_tension: float = 0.0
    """Torque per tension in m while twist is held: torque factor times diameter of a stranded rope, positive for a right-hand lay.
    Not on reels, nor with an axial law."""
    inner: str | Motor = "held"
    """The same as ``start`` and ``end`` of all clamps between; one that is not held lets the torque through."""
    key: ClassVar[str] = "torsion"

    @classmethod
    def round(cls, bending_stiffness: float, poisson: float) -> Torsion:
        """That of a solid round section or a round tube: GJ = EI/(1 + nu). Raises ValueError for a Poisson number that is not
        between -1 and 0.5."""
        if not -1.0 < poisson <= 0.5:
            raise ValueError(f"Poisson number must be above -1 and at most 0.5, not {poisson}")
        return cls(bending_stiffness / (1.0 + poisson))


@dataclass(frozen=True)
class Contact:
    """Contact with the obstacles of a cable, or with the colliders of its world. Needs the integrator "discrete-gradient"."""

    friction: float = 0.5
    """Coefficient of friction of the cable, >= 0, combined with that of a collider; obstacles have their own."""
    restitution: float = 0.0
    """Coefficient of restitution of the cable, 0 to 1, combined with that of a collider; obstacles have their own."""
    radius: float | None = None
    """In m, > 0; None: half the diameter of the section."""
    stiffness: float | None = None
    """Normal force per length and depth in N/m^2, > 0; None: EA/(40 r^2)."""
    itself: bool = False
    """Whether the cable touches itself."""
    cables: bool = False
    """Whether it touches the other cables of ``step_together`` or of its world that have this too."""
    key: ClassVar[str] = "contact"


@dataclass(frozen=True)
class Flow:
    """Velocity of a fluid: ``velocity`` (m/s), times a factor by height, times a factor by time."""

    velocity: Vector = (0.0, 0.0, 0.0)
    profile: Mapping[str, Any] | None = None
    """``{"up": direction, "rows": [[height in m, factor], ...]}``, heights ascending."""
    history: Sequence[Sequence[float]] = ()
    """``[[time in s, factor], ...]``, times ascending."""
    samples: Sequence[Vector] = ()
    """Velocities in m/s at the nodes, on top of the rest."""
    surface: Mapping[str, Any] | None = None
    """The free surface of the fluid: ``{"level": m, "up": direction, "gravity": m/s^2, "wave": {"amplitude": m, "period": s, "direction":
    direction}}``, the wave (linear, regular; also ``phase`` in rad and ``depth`` in m) may be left out. By default the fluid is everywhere."""


@dataclass(frozen=True)
class Drag:
    """Drag of a fluid or wind."""

    fluid_density: float
    """In kg/m^3, > 0."""
    normal: float = 1.2
    """Coefficient across the cable, >= 0."""
    tangential: float = 0.01
    """Coefficient along the cable, >= 0."""
    diameter: float | None = None
    """In m; by default that of the section."""
    flow: Flow = field(default_factory=Flow)
    key: ClassVar[str] = "drag"


@dataclass(frozen=True)
class LineLoad:
    """A constant force per length in world axes."""

    force: Vector
    """In N per m of unstretched cable."""
    start: float = 0.0
    """Arc length in m where it begins."""
    end: float = 1.7976931348623157e308
    """Arc length in m where it ends; beyond the cable's end = up to there."""
    key: ClassVar[str] = "line_load"


@dataclass(frozen=True)
class RestPiece:
    """A piece of the shape without stress, up to the next piece."""

    start: float = 0.0
    """Arc length in m where it begins."""
    stretch: float = 1.0
    """Stretch without stress, > 0."""
    curvature: float = 0.0
    """Curvature without stress in 1/m, >= 0."""


@dataclass(frozen=True)
class RestShape:
    """The shape without stress; before the first piece, straight and unstretched."""

    pieces: Sequence[RestPiece]
    key: ClassVar[str] = "rest_shape"


@dataclass(frozen=True)
class AxialLaw:
    """Axial force against engineering strain, instead of the Green law."""

    law: str | Sequence[Sequence[float]]
    """"green": EA times the Green strain, as without a law, where that is meant; "hooke": EA times the strain; "rope": the same, without force in compression; or a measured curve, rows of strain and force in N, both
    ascending from a force of 0, which cannot push."""
    key: ClassVar[str] = "axial_law"


Effect = Union[GravityScale, Buoyancy, AxialLaw, Contact, Damping, Drag, LineLoad, RestShape, Torsion]
Effects = Union[Effect, Iterable[Effect], Mapping[str, Any], None]


def _spin(end: str | Motor | MotorCourse) -> Any:
    if isinstance(end, MotorCourse):
        return {"course": [[float(x) for x in row] for row in end.rows]}
    return {"motor": {"rate": end.rate, "from": end.start, "until": end.until}} if isinstance(end, Motor) else end


def _made_spin(end: Any) -> Any:
    if isinstance(end, str):
        return end
    if "course" in end:
        return MotorCourse(tuple(tuple(row) for row in end["course"]))
    motor = end["motor"]
    return Motor(motor["rate"], motor["from"], motor["until"])


def _plain(effect: Any) -> Any:
    if isinstance(effect, GravityScale):
        return effect.factor
    if isinstance(effect, AxialLaw):
        return effect.law if isinstance(effect.law, str) else {"curve": [list(row) for row in effect.law]}
    if isinstance(effect, RestShape):
        return [_plain(piece) for piece in effect.pieces]
    values = {f.name: getattr(effect, f.name) for f in fields(effect)}
    if isinstance(effect, Torsion):
        return {name: _spin(value) if name in ("start", "end", "inner") else value for name, value in values.items()}
    if isinstance(effect, Drag):
        values["flow"] = {k: v for k, v in _plain(effect.flow).items() if k == "velocity" or (v is not None and len(v))}
    for ours, theirs in (("start", "from"), ("end", "to")):
        if ours in values:
            values[theirs] = values.pop(ours)
    return values


def collect(effects: Effects) -> dict[str, Any]:
    """Returns effects as plain data, by the keys of the mechanics."""
    if effects is None:
        return {}
    if isinstance(effects, Mapping):
        items: list[Any] = []
        plain = {}
        for key, value in effects.items():
            if hasattr(value, "key"):
                if key != value.key:
                    from lariat_cables.errors import EffectsError

                    raise EffectsError(f"effects: {key!r} is given a {type(value).__name__}, whose key is {value.key!r}")
                items.append(value)
            elif isinstance(value, (list, tuple)) and any(hasattr(item, "key") for item in value):
                items.extend(value)
            else:
                plain[key] = value
    else:
        if isinstance(effects, str):
            raise TypeError(f"expected an effect of lariat, or a list of them, got {effects!r}")
        items = [effects] if hasattr(effects, "key") else list(effects)
        plain = {}
    for effect in items:
        if isinstance(effect, type) and hasattr(effect, "key"):
            raise TypeError(f"expected an effect, got the class {effect.__name__}: write {effect.__name__}(...)")
        if not hasattr(effect, "key"):
            raise TypeError(f"expected an effect of lariat, got {effect!r}")
        if effect.key == "line_load":
            plain.setdefault("line_load", []).append(_plain(effect))
        elif effect.key in plain:
            from lariat_cables.errors import EffectsError

            raise EffectsError(f"effects: {effect.key} is given twice")
        else:
            plain[effect.key] = _plain(effect)
    return plain


def build(plain: Mapping[str, Any]) -> dict[str, Any]:
    """Returns plain data as effects, by key; those that are off are left out."""
    made: dict[str, Any] = {}
    for key, value in plain.items():
        if value is None:
            continue
        if key == "gravity_scale":
            made[key] = GravityScale(value)
        elif key == "axial_law":
            made[key] = AxialLaw(value if isinstance(value, str) else value["curve"])
        elif key == "damping":
            made[key] = Damping(**value)
        elif key == "torsion":
            made[key] = Torsion(**{k: _made_spin(v) if k in ("start", "end", "inner") else v for k, v in value.items()})
        elif key == "contact":
            made[key] = Contact(**value)
        elif key == "buoyancy":
            made[key] = Buoyancy(**value)
        elif key == "drag":
            made[key] = Drag(**{**value, "flow": Flow(**value["flow"])})
        elif key == "line_load":
            made[key] = [LineLoad(v["force"], v["from"], v["to"]) for v in value]
        elif key == "rest_shape":
            made[key] = RestShape([RestPiece(v["from"], v["stretch"], v["curvature"]) for v in value])
        else:
            made[key] = value
    return made
