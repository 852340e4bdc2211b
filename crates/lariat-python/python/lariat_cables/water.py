"""The water that bodies of a world are in."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from lariat_cables.effects import Flow

Vector = Sequence[float]


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
    """Water for the bodies of a world: ``World.set_water`` takes it. Cables are in it by their effects ``Buoyancy`` and ``Drag``."""

    density: float = 1000.0
    """In kg/m^3, > 0."""
    level: float | None = 0.0
    """Height of the free surface in m, along the gravity of the world; None: water everywhere."""
    wave: Wave | None = None
    """A wave of the surface."""
    flow: Flow = field(default_factory=Flow)
    """Its current."""


def plain(water: Water) -> dict[str, Any]:
    """Returns water as plain data."""
    if not isinstance(water, Water):
        raise TypeError(f"expected a Water, got {water!r}")
    if water.level is None and water.wave is not None:
        raise ValueError("a wave needs a free surface: give the level of the water")
    if isinstance(water.flow, Mapping):
        raise TypeError("flow must be a lariat.Flow")
    data = asdict(water)
    return {**data, "flow": {key: value for key, value in data["flow"].items() if value is not None}}
