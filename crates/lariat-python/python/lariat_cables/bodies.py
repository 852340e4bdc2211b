"""Rigid bodies of a world, by the names that the ``rapier3d`` wheel has for them. Lengths in m, angles in rad, single precision."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lariat_cables.errors import BuilderError
from lariat_cables.results import ColliderHandle, RigidBodyHandle

if TYPE_CHECKING:
    from lariat_cables import World

Array = NDArray[np.float64]


class _Builder:
    _methods: frozenset[str]

    def __init__(self, fixed: dict[str, Any], parameters: dict[str, Any]) -> None:
        self._parameters = dict(fixed)
        for name, value in parameters.items():
            if name not in self._methods:
                raise BuilderError(f"{type(self).__name__} has no {name!r}; expected {', '.join(sorted(self._methods))}")
            self._parameters[name] = value

    def _with(self, name: str, value: Any) -> Any:
        self._parameters[name] = value
        return self


class RigidBodyBuilder(_Builder):
    """Collects what a body is; made by ``RigidBody.dynamic`` and its like, added by ``World.add_body``."""

    _methods = frozenset(
        ["translation", "rotation", "linvel", "angvel", "linear_damping", "angular_damping", "gravity_scale", "can_sleep",
         "ccd_enabled", "additional_mass"]
    )  # fmt: skip

    def translation(self, v: ArrayLike) -> RigidBodyBuilder:
        """Sets the position of the origin in m."""
        return self._with("translation", v)  # type: ignore[no-any-return]

    def rotation(self, scaled_axis: ArrayLike) -> RigidBodyBuilder:
        """Sets the rotation vector in rad."""
        return self._with("rotation", scaled_axis)  # type: ignore[no-any-return]

    def linvel(self, v: ArrayLike) -> RigidBodyBuilder:
        """Sets the velocity in m/s."""
        return self._with("linvel", v)  # type: ignore[no-any-return]

    def angvel(self, v: ArrayLike) -> RigidBodyBuilder:
        """Sets the angular velocity in rad/s."""
        return self._with("angvel", v)  # type: ignore[no-any-return]

    def linear_damping(self, f: float) -> RigidBodyBuilder:
        """Sets the damping of the velocity in 1/s."""
        return self._with("linear_damping", f)  # type: ignore[no-any-return]

    def angular_damping(self, f: float) -> RigidBodyBuilder:
        """Sets the damping of the angular velocity in 1/s."""
        return self._with("angular_damping", f)  # type: ignore[no-any-return]

    def gravity_scale(self, f: float) -> RigidBodyBuilder:
        """Sets the factor on gravity."""
        return self._with("gravity_scale", f)  # type: ignore[no-any-return]

    def can_sleep(self, b: bool) -> RigidBodyBuilder:
        """Sets whether it may fall asleep."""
        return self._with("can_sleep", b)  # type: ignore[no-any-return]

    def ccd_enabled(self, b: bool) -> RigidBodyBuilder:
        """Sets whether fast motion is checked for contact."""
        return self._with("ccd_enabled", b)  # type: ignore[no-any-return]

    def additional_mass(self, m: float) -> RigidBodyBuilder:
        """Adds mass in kg to that of the colliders."""
        return self._with("additional_mass", m)  # type: ignore[no-any-return]


class ColliderBuilder(_Builder):
    """Collects what a collider is; made by ``Collider.cuboid`` and its like."""

    _methods = frozenset(
        ["translation", "rotation", "density", "mass", "friction", "restitution", "sensor", "friction_combine_rule", "collision_groups",
         "solver_groups"]
    )  # fmt: skip

    def translation(self, v: ArrayLike) -> ColliderBuilder:
        """Sets the position on the body in m."""
        return self._with("translation", v)  # type: ignore[no-any-return]

    def rotation(self, scaled_axis: ArrayLike) -> ColliderBuilder:
        """Sets the rotation vector on the body in rad."""
        return self._with("rotation", scaled_axis)  # type: ignore[no-any-return]

    def density(self, d: float) -> ColliderBuilder:
        """Sets the density in kg/m^3."""
        return self._with("density", d)  # type: ignore[no-any-return]

    def mass(self, m: float) -> ColliderBuilder:
        """Sets the mass in kg."""
        return self._with("mass", m)  # type: ignore[no-any-return]

    def friction(self, f: float) -> ColliderBuilder:
        """Sets the coefficient of friction."""
        return self._with("friction", f)  # type: ignore[no-any-return]

    def restitution(self, r: float) -> ColliderBuilder:
        """Sets the coefficient of restitution."""
        return self._with("restitution", r)  # type: ignore[no-any-return]

    def sensor(self, b: bool) -> ColliderBuilder:
        """Sets whether it only detects."""
        return self._with("sensor", b)  # type: ignore[no-any-return]

    def friction_combine_rule(self, rule: Literal["average", "min", "multiply", "max"]) -> ColliderBuilder:
        """Sets how its friction is combined with that of what it touches, bodies and cables."""
        return self._with("friction_combine_rule", rule)  # type: ignore[no-any-return]

    def collision_groups(self, memberships: int, filter: int) -> ColliderBuilder:  # noqa: A002
        """Sets its groups and those that it touches, as bits. By name: ``collision_groups=(memberships, filter)``."""
        return self._with("collision_groups", (memberships, filter))  # type: ignore[no-any-return]

    def solver_groups(self, memberships: int, filter: int) -> ColliderBuilder:  # noqa: A002
        """Sets its groups and those that it pushes, as bits. By name: ``solver_groups=(memberships, filter)``."""
        return self._with("solver_groups", (memberships, filter))  # type: ignore[no-any-return]


def _rows(points: ArrayLike) -> Array:
    rows = np.asarray(points, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise BuilderError(f"expected points of shape (n, 3), got {rows.shape}")
    return rows


class Collider:
    """Makes builders of colliders."""

    @staticmethod
    def cuboid(hx: float, hy: float, hz: float, **kwargs: Any) -> ColliderBuilder:
        """A box of these half extents in m."""
        return ColliderBuilder({"shape": "cuboid", "size": [hx, hy, hz]}, kwargs)

    @staticmethod
    def ball(radius: float, **kwargs: Any) -> ColliderBuilder:
        """A ball of this radius in m."""
        return ColliderBuilder({"shape": "ball", "size": [radius]}, kwargs)

    @staticmethod
    def cylinder(half_height: float, radius: float, **kwargs: Any) -> ColliderBuilder:
        """A cylinder along y, in m."""
        return ColliderBuilder({"shape": "cylinder", "size": [half_height, radius]}, kwargs)

    @staticmethod
    def capsule_y(half_height: float, radius: float, **kwargs: Any) -> ColliderBuilder:
        """A capsule along y, in m."""
        return ColliderBuilder({"shape": "capsule_y", "size": [half_height, radius]}, kwargs)

    @staticmethod
    def capsule_x(half_height: float, radius: float, **kwargs: Any) -> ColliderBuilder:
        """A capsule along x, in m."""
        return ColliderBuilder({"shape": "capsule_x", "size": [half_height, radius]}, kwargs)

    @staticmethod
    def capsule_z(half_height: float, radius: float, **kwargs: Any) -> ColliderBuilder:
        """A capsule along z, in m."""
        return ColliderBuilder({"shape": "capsule_z", "size": [half_height, radius]}, kwargs)

    @staticmethod
    def cone(half_height: float, radius: float, **kwargs: Any) -> ColliderBuilder:
        """A cone along y, in m, with its tip up."""
        return ColliderBuilder({"shape": "cone", "size": [half_height, radius]}, kwargs)

    @staticmethod
    def halfspace(outward_normal: Sequence[float], **kwargs: Any) -> ColliderBuilder:
        """Everything below the plane through the origin with this normal."""
        return ColliderBuilder({"shape": "halfspace", "size": list(outward_normal)}, kwargs)

    @staticmethod
    def convex_hull(points: ArrayLike, **kwargs: Any) -> ColliderBuilder:
        """The convex hull of points in m, shape (n, 3)."""
        return ColliderBuilder({"shape": "convex_hull", "size": _rows(points).ravel().tolist()}, kwargs)

    @staticmethod
    def trimesh(vertices: ArrayLike, indices: ArrayLike, **kwargs: Any) -> ColliderBuilder:
        """Triangles: vertices in m, shape (n, 3), and their indices, shape (m, 3)."""
        flat = _rows(vertices).ravel().tolist()
        return ColliderBuilder({"shape": "trimesh", "size": flat, "indices": np.asarray(indices).tolist()}, kwargs)


class RigidBody:
    """A body of a world, as it is now."""

    def __init__(self, world: World, handle: RigidBodyHandle) -> None:
        self._world = world
        self.handle = handle

    @staticmethod
    def dynamic(**kwargs: Any) -> RigidBodyBuilder:
        """A body that forces move."""
        return RigidBodyBuilder({"body_type": "dynamic"}, kwargs)

    @staticmethod
    def fixed(**kwargs: Any) -> RigidBodyBuilder:
        """A body that stays where it is."""
        return RigidBodyBuilder({"body_type": "fixed"}, kwargs)

    @staticmethod
    def kinematic_position_based(**kwargs: Any) -> RigidBodyBuilder:
        """A body that is moved by its next position."""
        return RigidBodyBuilder({"body_type": "kinematic_position_based"}, kwargs)

    @staticmethod
    def kinematic_velocity_based(**kwargs: Any) -> RigidBodyBuilder:
        """A body that is moved by its velocity."""
        return RigidBodyBuilder({"body_type": "kinematic_velocity_based"}, kwargs)

    def _state(self) -> tuple[Array, list[float], Array, Array, float, bool]:
        return self._world._body(self.handle)

    @property
    def translation(self) -> Array:
        """Position of the origin in m, shape (3,)."""
        return self._state()[0]

    @translation.setter
    def translation(self, value: ArrayLike) -> None:
        self._world._set_body(self.handle, "translation", value)

    @property
    def rotation(self) -> Array:
        """Quaternion x, y, z, w, shape (4,)."""
        return np.array(self._state()[1])

    @rotation.setter
    def rotation(self, value: Sequence[float]) -> None:
        self._world._set_rotation(self.handle, value, False)

    @property
    def linvel(self) -> Array:
        """Velocity of the centre of mass in m/s, shape (3,)."""
        return self._state()[2]

    @linvel.setter
    def linvel(self, value: ArrayLike) -> None:
        self._world._set_body(self.handle, "linvel", value)

    @property
    def angvel(self) -> Array:
        """Angular velocity in rad/s, shape (3,)."""
        return self._state()[3]

    @angvel.setter
    def angvel(self, value: ArrayLike) -> None:
        self._world._set_body(self.handle, "angvel", value)

    @property
    def mass(self) -> float:
        """Mass in kg."""
        return self._state()[4]

    @property
    def is_sleeping(self) -> bool:
        """Whether it is asleep."""
        return self._state()[5]

    def set_next_kinematic_translation(self, translation: ArrayLike) -> None:
        """Sets where a kinematic body is after the next step, in m."""
        self._world._set_body(self.handle, "next_kinematic_translation", translation)

    def set_next_kinematic_rotation(self, rotation: Sequence[float]) -> None:
        """Sets the quaternion (x, y, z, w) of a kinematic body after the next step."""
        self._world._set_rotation(self.handle, rotation, True)

    def add_force(self, force: ArrayLike) -> None:
        """Adds a force in N, until ``reset_forces``."""
        self._world._set_body(self.handle, "add_force", force)

    def add_torque(self, torque: ArrayLike) -> None:
        """Adds a torque in N m, until ``reset_forces``."""
        self._world._set_body(self.handle, "add_torque", torque)

    def apply_impulse(self, impulse: ArrayLike) -> None:
        """Applies an impulse in N s at the centre of mass."""
        self._world._set_body(self.handle, "apply_impulse", impulse)

    def apply_torque_impulse(self, torque_impulse: ArrayLike) -> None:
        """Applies an angular impulse in N m s."""
        self._world._set_body(self.handle, "apply_torque_impulse", torque_impulse)

    def reset_forces(self) -> None:
        """Removes all forces and torques that were added."""
        self._world._reset_forces(self.handle)


class RigidBodySet:
    """The bodies of a world, by handle."""

    def __init__(self, world: World) -> None:
        self._world = world

    def __getitem__(self, handle: RigidBodyHandle) -> RigidBody:
        body = RigidBody(self._world, RigidBodyHandle(*handle))
        body._state()
        return body

    def __contains__(self, handle: object) -> bool:
        return handle in self._world._handles()

    def __iter__(self) -> Iterator[tuple[RigidBodyHandle, RigidBody]]:
        for parts in self._world._handles():
            handle = RigidBodyHandle(*parts)
            yield handle, RigidBody(self._world, handle)

    def __len__(self) -> int:
        return len(self._world._handles())


def add(world: World, builder: RigidBodyBuilder, colliders: Sequence[ColliderBuilder]) -> RigidBodyHandle:
    """Adds a body with its colliders to a world."""
    return RigidBodyHandle(*world._add_body(builder._parameters, [c._parameters for c in colliders]))


def add_collider(world: World, builder: ColliderBuilder, parent: RigidBodyHandle | None) -> ColliderHandle:
    """Adds a collider to a body, or one fixed in the world."""
    return ColliderHandle(*world._add_collider(builder._parameters, parent))
