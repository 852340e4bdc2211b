"""Joints of a world, by the names that the ``rapier3d`` wheel has for them. Lengths in m, angles in rad, single precision."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from lariat_cables.bodies import _Builder
from lariat_cables.errors import BuilderError
from lariat_cables.results import ImpulseJointHandle, MultibodyJointHandle, RigidBodyHandle
from lariat_cables.types import Handle

if TYPE_CHECKING:
    from lariat_cables import World


class JointBuilder(_Builder):
    """Collects what a joint is; made by ``FixedJoint.builder`` and its like, inserted by ``World.impulse_joints.insert``."""

    _methods = frozenset(["local_anchor1", "local_anchor2", "contacts_enabled"])

    def local_anchor1(self, p: ArrayLike) -> JointBuilder:
        """Sets the anchor on the first body, in its axes, in m."""
        return self._with("local_anchor1", p)  # type: ignore[no-any-return]

    def local_anchor2(self, p: ArrayLike) -> JointBuilder:
        """Sets the anchor on the second body, in its axes, in m."""
        return self._with("local_anchor2", p)  # type: ignore[no-any-return]

    def contacts_enabled(self, b: bool) -> JointBuilder:
        """Sets whether the bodies collide with each other."""
        return self._with("contacts_enabled", b)  # type: ignore[no-any-return]


class AxisJointBuilder(JointBuilder):
    """Collects what a joint with one free axis is."""

    _methods = JointBuilder._methods | {"limits", "motor", "motor_max_force"}

    def limits(self, min: float, max: float) -> AxisJointBuilder:  # noqa: A002
        """Sets the least and the largest angle or distance."""
        return self._with("limits", [min, max])  # type: ignore[no-any-return]

    def motor(self, target_pos: float, target_vel: float, stiffness: float, damping: float) -> AxisJointBuilder:
        """Sets a motor: a spring and a damper to a position (m, rad) and a velocity (m/s, rad/s)."""
        return self._with("motor", [target_pos, target_vel, stiffness, damping])  # type: ignore[no-any-return]

    def motor_velocity(self, target_vel: float, factor: float) -> AxisJointBuilder:
        """Sets a motor to a velocity (m/s, rad/s)."""
        return self.motor(0.0, target_vel, 0.0, factor)

    def motor_position(self, target_pos: float, stiffness: float, damping: float) -> AxisJointBuilder:
        """Sets a motor to a position (m, rad)."""
        return self.motor(target_pos, 0.0, stiffness, damping)

    def motor_max_force(self, max_force: float) -> AxisJointBuilder:
        """Sets the largest force (N) or torque (N m) of the motor."""
        return self._with("motor_max_force", max_force)  # type: ignore[no-any-return]


class FixedJoint:
    """Makes builders of joints that lock bodies to each other."""

    @staticmethod
    def builder(**kwargs: Any) -> JointBuilder:
        """A joint that allows no relative motion."""
        return JointBuilder({"joint": "fixed"}, kwargs)


class SphericalJoint:
    """Makes builders of ball joints."""

    @staticmethod
    def builder(**kwargs: Any) -> JointBuilder:
        """A joint that keeps two anchors together."""
        return JointBuilder({"joint": "spherical"}, kwargs)


class RevoluteJoint:
    """Makes builders of hinges."""

    @staticmethod
    def builder(axis: Sequence[float], **kwargs: Any) -> AxisJointBuilder:
        """A hinge about an axis, which both bodies have."""
        return AxisJointBuilder({"joint": "revolute", "size": axis}, kwargs)


class PrismaticJoint:
    """Makes builders of sliders."""

    @staticmethod
    def builder(axis: Sequence[float], **kwargs: Any) -> AxisJointBuilder:
        """A slider along an axis, which both bodies have."""
        return AxisJointBuilder({"joint": "prismatic", "size": axis}, kwargs)


class RopeJoint:
    """Makes builders of joints that bound a distance."""

    @staticmethod
    def builder(max_distance: float, **kwargs: Any) -> JointBuilder:
        """A joint that keeps two anchors within a distance in m."""
        return JointBuilder({"joint": "rope", "size": [max_distance]}, kwargs)


class SpringJoint:
    """Makes builders of springs."""

    @staticmethod
    def builder(rest_length: float, stiffness: float, damping: float, **kwargs: Any) -> JointBuilder:
        """A spring of this rest length (m), stiffness (N/m) and damping (N s/m)."""
        return JointBuilder({"joint": "spring", "size": [rest_length, stiffness, damping]}, kwargs)


def _parameters(joint: JointBuilder) -> dict[str, Any]:
    if not isinstance(joint, JointBuilder):
        raise BuilderError(f"expected a builder of a joint, got {joint!r}")
    return joint._parameters


class ImpulseJointSet:
    """The impulse joints of a world, by handle."""

    def __init__(self, world: World) -> None:
        self._world = world

    def insert(self, body1: Handle, body2: Handle, joint: JointBuilder) -> ImpulseJointHandle:
        """Inserts a joint. Raises NoBodyError, BuilderError, InvalidValueError."""
        return ImpulseJointHandle(*self._world._insert_joint(body1, body2, _parameters(joint), False))

    def remove(self, handle: Handle) -> None:
        """Removes a joint. Raises NoJointError."""
        self._world._remove_joint(handle, False)

    def bodies_connected_by_joint(self, handle: Handle) -> tuple[RigidBodyHandle, RigidBodyHandle]:
        """Returns the two bodies. Raises NoJointError."""
        return _bodies(self._world, handle, False)

    def __contains__(self, handle: object) -> bool:
        return any(joint[0] == handle for joint in self._world._joints(False))

    def __iter__(self) -> Iterator[ImpulseJointHandle]:
        return iter([ImpulseJointHandle(*joint[0]) for joint in self._world._joints(False)])

    def __len__(self) -> int:
        return len(self._world._joints(False))


class MultibodyJointSet:
    """The multibody joints of a world, by handle: joints in reduced coordinates, which cannot drift."""

    def __init__(self, world: World) -> None:
        self._world = world

    def insert(self, parent: Handle, link_body: Handle, joint: JointBuilder) -> MultibodyJointHandle:
        """Inserts a joint that moves ``link_body`` against ``parent``. Raises BuilderError (a loop), NoBodyError, InvalidValueError."""
        return MultibodyJointHandle(*self._world._insert_joint(parent, link_body, _parameters(joint), True))

    def remove(self, handle: Handle) -> None:
        """Removes a joint. Raises NoJointError."""
        self._world._remove_joint(handle, True)

    def bodies_connected_by_joint(self, handle: Handle) -> tuple[RigidBodyHandle, RigidBodyHandle]:
        """Returns parent and link. Raises NoJointError."""
        return _bodies(self._world, handle, True)

    def __contains__(self, handle: object) -> bool:
        return any(joint[0] == handle for joint in self._world._joints(True))

    def __iter__(self) -> Iterator[MultibodyJointHandle]:
        return iter([MultibodyJointHandle(*joint[0]) for joint in self._world._joints(True)])

    def __len__(self) -> int:
        return len(self._world._joints(True))


def _bodies(world: World, handle: Handle, multibody: bool) -> tuple[RigidBodyHandle, RigidBodyHandle]:
    from lariat_cables.errors import NoJointError

    for joint, first, second in world._joints(multibody):
        if joint == tuple(handle):
            return RigidBodyHandle(*first), RigidBodyHandle(*second)
    raise NoJointError(f"no joint {handle!r} in this world")
