"""What a cable by itself can touch. In a world the colliders are its obstacles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from numpy.typing import ArrayLike

Vector = ArrayLike


@dataclass(frozen=True)
class Obstacle:
    """Something that a cable can touch, at rest or moving at constant velocities from when it is set; ``Cable.set_obstacles`` takes it.

    Made by ``half_space``, ``ball``, ``cylinder``, ``capsule`` and ``cuboid``, which take the other fields by name.
    """

    shape: str
    size: Sequence[float]
    position: Vector = (0.0, 0.0, 0.0)
    """Of its origin, in m."""
    rotation: ArrayLike = (0.0, 0.0, 0.0, 1.0)
    """Quaternion x, y, z, w."""
    velocity: Vector = (0.0, 0.0, 0.0)
    """In m/s."""
    angular_velocity: Vector = (0.0, 0.0, 0.0)
    """In rad/s, about its origin."""
    friction: float = 0.5
    """Coefficient of friction between it and the cable, >= 0; it counts alone."""
    restitution: float = 0.0
    """Coefficient of restitution between it and the cable, 0 to 15/17; it counts alone."""
    skin: float = 0.0
    """Distance in m that the cable keeps from it, >= 0."""
    except_at: Sequence[tuple[float, float]] = ()
    """Pieces of the cable, from and to an arc length in m, that do not touch it."""

    @staticmethod
    def half_space(normal: Sequence[float] = (0.0, 1.0, 0.0), **kwargs: Any) -> Obstacle:
        """Everything below the plane through the origin with this outward normal."""
        return Obstacle("half_space", list(normal), **kwargs)

    @staticmethod
    def ball(radius: float, **kwargs: Any) -> Obstacle:
        """A ball of this radius in m."""
        return Obstacle("ball", [radius], **kwargs)

    @staticmethod
    def cylinder(half_height: float, radius: float, **kwargs: Any) -> Obstacle:
        """A cylinder along y, in m."""
        return Obstacle("cylinder", [half_height, radius], **kwargs)

    @staticmethod
    def capsule(start: Sequence[float], end: Sequence[float], radius: float, **kwargs: Any) -> Obstacle:
        """A segment from ``start`` to ``end`` with a radius, in m."""
        return Obstacle("capsule", [*start, *end, radius], **kwargs)

    @staticmethod
    def cuboid(hx: float, hy: float, hz: float, **kwargs: Any) -> Obstacle:
        """A box of these half extents in m."""
        return Obstacle("cuboid", [hx, hy, hz], **kwargs)


def plain(obstacle: Obstacle) -> dict[str, Any]:
    """Returns an obstacle as plain data."""
    if not isinstance(obstacle, Obstacle):
        raise TypeError(f"expected an Obstacle, got {obstacle!r}")
    return asdict(obstacle)
