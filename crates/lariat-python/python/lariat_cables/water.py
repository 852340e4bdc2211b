"""The water that bodies of a world are in."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from lariat_cables.effects import Buoyancy, Drag, Flow

Vector = Sequence[float]

GRAVITY = (0.0, -9.81, 0.0)


@dataclass(frozen=True)
class Wave:
    """A linear regular wave (Airy)."""

    amplitude: float
    """In m, half the height from trough to crest, > 0."""
    period: float
    """In s, > 0."""
    direction: Vector = (1.0, 0.0, 0.0)
    """Where it goes; its part along the surface counts."""
    phase: float = 0.0
    """In rad: 0 puts a crest over the origin at time zero."""
    depth: float | None = None
    """Depth of the water at rest in m, > 0; None: deep."""


@dataclass(frozen=True)
class Water:
    """Water for the bodies of a world: ``World.set_water`` takes it. Cables are in it by the effects that ``buoyancy`` and ``drag`` return."""

    density: float = 1000.0
    """In kg/m^3, > 0."""
    level: float | None = 0.0
    """Height of the free surface in m, along the gravity of the world; None: water everywhere."""
    wave: Wave | None = None
    """A wave of the surface."""
    flow: Flow = field(default_factory=Flow)
    """Its current."""

    def buoyancy(self, added_mass: float = 1.0, area: float | None = None, *, gravity: Vector = GRAVITY) -> Buoyancy:
        """Returns buoyancy and added mass of a cable in this water, with its level and wave; ``gravity`` is that of the world (m/s^2)."""
        return Buoyancy(self.density, added_mass, area, self._surface(gravity))

    def drag(self, normal: float = 1.2, tangential: float = 0.01, diameter: float | None = None, *, gravity: Vector = GRAVITY) -> Drag:
        """Returns the drag of a cable in this water, with its level, wave and current; ``gravity`` is that of the world (m/s^2)."""
        return Drag(self.density, normal, tangential, diameter, replace(self.flow, surface=self._surface(gravity)))

    def _surface(self, gravity: Vector) -> dict[str, Any] | None:
        _checked(self)
        if self.level is None:
            return None
        size = math.hypot(*gravity)
        if not size > 0.0:
            raise ValueError("a free surface needs gravity")
        surface: dict[str, Any] = {"level": self.level, "up": [-x / size for x in gravity], "gravity": size}
        if self.wave is not None:
            surface["wave"] = {key: value for key, value in asdict(self.wave).items() if value is not None}
        return surface


def _checked(water: Water) -> None:
    if water.level is None and water.wave is not None:
        raise ValueError("a wave needs a free surface: give the level of the water")
    if isinstance(water.flow, Mapping):
        raise TypeError("flow must be a lariat.Flow")


def plain(water: Water) -> dict[str, Any]:
    """Returns water as plain data."""
    if not isinstance(water, Water):
        raise TypeError(f"expected a Water, got {water!r}")
    _checked(water)
    data = asdict(water)
    return {**data, "flow": {key: value for key, value in data["flow"].items() if value is not None}}
