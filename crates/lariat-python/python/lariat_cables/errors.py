"""Exceptions: one class per kind of error of the mechanics, the coupling to rapier3d and the scenes.

Every exception has the attributes ``value``, ``cable`` and ``time`` (None where they have no meaning) and all other numbers and names
of the error, as listed with each class. A step that fails leaves the cable as it was.
"""

from __future__ import annotations

from typing import Any


class Error(Exception):
    """Base class. Attributes: ``value`` (the number that is wrong), ``cable`` (its name), ``time`` in s; each None if unknown."""

    value: Any = None
    cable: str | None = None
    time: float | None = None

    def __init__(self, message: str = "", **fields: Any) -> None:
        super().__init__(message)
        self.__dict__.update(fields)

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (type(self), str(self), self.__dict__)


def _restored(kind: type[Error], message: str, fields: dict[str, Any]) -> Error:
    return kind(message, **fields)


class ResultWarning(UserWarning):
    """What a run tells of its scene, its mesh and its steps: a result that is probably not what was meant, wrong, or coarse."""


class InvalidValueError(Error, ValueError):
    """A number outside its range, infinite or NaN: what, value, expected."""


class ShapeError(Error, ValueError):
    """An array of the wrong shape: shape."""


class WrongCountError(Error, ValueError):
    """A list that does not have one entry per node or coordinate: what, count, expected."""


class TooFewPointsError(Error, ValueError):
    """A start shape of fewer than two points: count."""


class CoincidentPointsError(Error, ValueError):
    """Two successive points of a start shape that coincide: index, point."""


class ElementCountError(Error, ValueError):
    """No elements, or too many: count, most."""


class ObstacleKeyError(Error, ValueError):
    """Two obstacles with the same key: key."""


class ObstacleBodyError(Error):
    """An obstacle on a body that does not step with the cable: key, body, bodies."""


class ContactMethodError(Error, ValueError):
    """Contact with another method than "discrete-gradient": method."""


class TorsionPlaceError(Error, ValueError):
    """Torsion where it is not carried: by."""


class OneElementError(Error, ValueError):
    """A limit of the strength of a cable of one element, which has no inner node to break at."""


class ExplicitReelError(Error, ValueError):
    """A reel with an explicit method: method."""


class ReelMethodError(Error, ValueError):
    """A reel with ``max_force`` under another method than "discrete-gradient", or any under one by which its account of energy does not close: method,
    reason."""


class ReelPlaceError(Error, ValueError):
    """A reel where none can be, or none where one was named: reason."""


class FastReelError(Error):
    """A step of an island in which too much of the element at an eye would pass: share, most."""


class NotWithReelError(Error, ValueError):
    """Something that a cable with a reel does not carry: what."""


class NoSectionError(Error, ValueError):
    """A cable without a section at its start."""


class NodeBeforeMeshError(Error, ValueError):
    """A node named by its number while the cable is not built yet: node. Give an arc length (float)."""


class SupportOrderError(Error, ValueError):
    """Supports of saved bytes that are not on the cable: node, nodes."""


class EffectsError(Error, ValueError):
    """Effects that are not such: an unknown name or parameter."""


class MissingForEffectError(Error, ValueError):
    """An effect that needs what the cable does not have: effect, requirement."""


class MissingForceDensitiesError(Error):
    """A cable read back without its functions: count."""


class EmptyRestPieceError(Error, ValueError):
    """A piece of a rest shape that covers no element: from."""


class AmbiguousPlaceError(Error, TypeError):
    """An integer as a point of a cable: it could be a node, or a number of metres."""


class UnknownPlaceError(Error, ValueError):
    """A text that is no point of a cable."""


class UnknownRuleError(Error, ValueError):
    """A name that is no rule: rule, expected, suggestion."""


class UnknownIntegratorError(Error, ValueError):
    """A name that is no integration method: name, expected, suggestion."""


class UnknownRopeKindError(Error, ValueError):
    """A name that is no kind of rope: name, expected, suggestion."""


class UnknownFidelityError(Error, ValueError):
    """A name that is no fidelity: name, suggestion."""


class UnknownNormError(Error, ValueError):
    """A name that is no error norm: name, suggestion."""


class UnknownKindError(Error, ValueError):
    """A name that is no kind of attachment."""


class StepControlError(Error, ValueError):
    """None or several of tolerance, substeps, max_step, adaptive and stable; or both fidelity and integrator."""


class NoErrorEstimateError(Error, ValueError):
    """A tolerance for a method that does not estimate its error: method."""


class NoErrorNormError(Error, ValueError):
    """A norm that the estimate of a method does not have: method, norm."""


class NoStabilityLimitError(Error, ValueError):
    """A share of the stability limit for an implicit method: method."""


class ExplicitDampingError(Error, ValueError):
    """Internal damping with an explicit method: method."""


class RankDeficientError(Error, ValueError):
    """A rule with modes of deformation that have no energy: rule, reason."""


class OutOfRangeError(Error, ValueError):
    """A node or an arc length that is not on the cable: what, value, limit."""


class NoNodeError(Error, ValueError):
    """An arc length without a node: arc_length, nearest."""


class AttachedError(Error):
    """A cable by itself of which a node is attached to a body: node."""


class InWorldError(Error):
    """An operation on a cable of a world that only the world can do."""


class DuplicateCableError(Error, ValueError):
    """The same cable twice in one call."""


class NoTangentError(Error):
    """A clamp at a node whose slope has length zero: node."""


class PinError(Error):
    """A co-simulation that does not fit its cable any more: node, problem."""


class NotInIslandError(Error):
    """A pin that names no cable or body: pin, what, index, count."""


class EmptyIslandError(Error):
    """Ends that changed while another thread stepped."""


class ExchangeError(Error):
    """Forces and motion of an exchange that do not agree: time, value (what they miss, as a share of the largest force)."""


class ImpedanceError(Error):
    """A state whose impedance cannot be computed: time, value (the step in s)."""


class TimeMismatchError(Error):
    """Cables that are at different times: expected."""


class StepFailedError(Error):
    """A time step that failed: time (of the state that is kept), at, step, failure."""


class NoEquilibriumError(Error):
    """No static equilibrium was found: time, failure, residual, iterations."""


class StepRefusedError(Error):
    """Cables that cannot step with their bodies; all others have advanced: cables, time, cause."""


class NoCableError(Error, LookupError):
    """A cable that is not, or no longer, in the world."""


class NoAttachmentError(Error, LookupError):
    """An attachment that is not, or no longer, in the world."""


class NoSheaveError(Error, LookupError):
    """A sheave that is not, or no longer, in the world."""


class DrumBodyError(Error, ValueError):
    """A drum that is not a dynamic body."""


class DrumJoinedError(Error, ValueError):
    """A drum that is joined to a dynamic body."""


class NoJunctionError(Error, LookupError):
    """A junction that is not, or no longer, in the world."""


class NoBodyError(Error, LookupError):
    """A body that is not, or no longer, in the world."""


class NotDynamicError(Error, ValueError):
    """A body that is not dynamic, where only those are moved."""


class NoWaterError(Error, LookupError):
    """A world without water."""


class NoVolumeError(Error, ValueError):
    """A body in water without a collider that encloses a volume, and without a volume of its own."""


class WaterValueError(Error, ValueError):
    """A number of a body in water that is out of range."""


class OtherWorldError(Error):
    """A cable or body of another world."""


class GapTooLongError(Error, ValueError):
    """A cable too far from what it is to be attached to: gap, limit in m."""


class TimeStepError(Error, ValueError):
    """A time step that is negative or not finite: dt."""


class AnchorNotFiniteError(Error, ValueError):
    """An anchor that is not finite: body, anchor."""


class AlreadyAttachedError(Error):
    """A node that is already attached: node."""


class LinkLostError(Error):
    """A link of a multibody that moved otherwise than predicted: body, gap."""


class HeldInMoveError(Error):
    """A cable on bodies that are to be moved, which something else holds, too: cable."""


class JointInMoveError(Error):
    """A body to be moved that is joined to one that stays, or a link of a multibody: body."""


class JointInStaticsError(Error):
    """A joint on a body whose equilibrium is asked for, of a kind that statics do not compute: body."""


class ContactInStaticsError(Error):
    """A contact of a body whose equilibrium is asked for, in a world that comes to no rest by its motion: body."""


class NotHeldInStaticsError(Error):
    """Bodies and cables that nothing holds, and that would fall on nothing on which they come to rest: bodies, cables."""


class MovesInStaticsError(Error):
    """Cables that touch each other, themselves, or bodies that they move, in a world that comes to no rest by its motion: way."""


class CablesPassInStaticsError(Error):
    """Cables that would be found beyond each other, in a world that comes to no rest by its motion, or there too: cable, other, arc_length,
    by_motion."""


class CablePassesBodyInStaticsError(Error):
    """A cable that would be found in a body that cables move, or beyond it, in a world that comes to no rest by its motion, or there too:
    cable, body, arc_length, by_motion."""


class CableTouchesInStaticsError(Error):
    """A cable that touches a collider whose equilibrium is asked for: collider, arc_length, depth."""


class NoColliderError(Error):
    """A collider that is not, or no longer, in the world."""


class NoJointError(Error):
    """A joint that is not, or no longer, in the world."""


class BodyNotFiniteError(Error):
    """A body whose state is not finite: body, time."""


class BuilderError(Error, ValueError):
    """A body, a collider, a joint, an obstacle or a reel that cannot be built."""


class FormatError(Error, ValueError):
    """Bytes that are no saved object of this version."""


class SceneError(Error, ValueError):
    """A value of a scene that is not accepted: place, key, problem, accepted, suggestion."""


class NotBuiltError(Error, ValueError):
    """A part of the scene format that this version does not compute: key."""


class TimedCutError(Error, ValueError):
    """A scene that cuts a cable at a time, given to ``load``: cable."""


class NoChosenMeshError(Error):
    """A mesh with ``finest = "auto"`` in a scene without equilibrium: cable."""


class TooLargeError(Error, ValueError):
    """A scene that would need more memory or disk than anybody means."""


class ErrorTooSmallError(Error, ValueError):
    """An ``error`` that cannot be proven in a scene."""


class StudyError(Error):
    """Runs that cannot be compared, so that an ``error`` cannot be proven."""


class SyntaxError(Error, ValueError):  # noqa: A001
    """A file that is not TOML."""


class NoSuchKeyError(Error, LookupError):
    """A key or table that no scene has. Attributes: ``key``."""


class OverrideError(Error, ValueError):
    """An override that is not a path into the scene."""


class ImportError(Error, ValueError):  # noqa: A001
    """A model of another program that cannot be imported right: line."""


class InTheWayError(Error):
    """A file that Lariat did not write, or that was changed since, and that would be overwritten."""


class BusyError(Error):
    """A folder that another program writes results to."""


class StateError(Error, ValueError):
    """A state that a run cannot start from: damaged, of another version, or of another scene."""


class ReadError(Error, OSError):
    """A scene that cannot be read."""


class OutputError(Error, OSError):
    """A folder or file that cannot be created."""


class WriteError(Error, OSError):
    """A file that could not be written to its end: time."""


class BodyError(Error):
    """A rigid body of a scene whose motion cannot be computed: time, body."""
