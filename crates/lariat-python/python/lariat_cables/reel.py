"""Reels: what pays a cable out and takes it in at an end."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, Literal

EVER = -1e300
"""A time in s before every other."""


@dataclass(frozen=True)
class Reel:
    """A reel at an end of a cable, the eye; ``Cable.add_reel`` takes it."""

    rate: float | Sequence[Sequence[float]] = 0.0
    """In m/s, positive pays out: one, or ``[[time in s, rate], ...]`` with ascending times; a rate holds until the next row."""
    to_length: float | None = None
    """Length in m that is out when the reel stops: it comes there with the rates, whatever their sign. None: the rates are followed."""
    acceleration: float = 2.0
    """Largest acceleration of the rate in m/s^2. Rows that end before their rate is reached are told by the warning slow_reel."""
    stock: float | None = None
    """Largest length in m that can be out; None: no limit."""
    max_force: float | None = None
    """Largest force of the motor in N, above which the reel slips; 0 is a free spool, and a brake has a rate of zero. Needs the integrator
    "discrete-gradient". None: as strong as it must be."""
    inertia: float = 0.0
    """Inertia of the wheel over the square of its radius in kg; it counts where the reel slips."""
    feed: Literal["drum", "coil", "bag"] = "drum"
    """How material comes to the eye: from a drum that turns with the rate, picked up from a coil at rest, or from a bag without loss."""

    @classmethod
    def brake(cls, force: float, **kwargs: Any) -> Reel:
        """A brake that slips above a force in N."""
        return cls(max_force=force, **kwargs)

    @classmethod
    def free_spool(cls, **kwargs: Any) -> Reel:
        """A reel that turns freely."""
        return cls(max_force=0.0, **kwargs)


def plain(reel: Reel) -> dict[str, Any]:
    """Returns a reel as plain data."""
    if not isinstance(reel, Reel):
        raise TypeError(f"expected a Reel, got {reel!r}")
    values = asdict(reel)
    if isinstance(reel.rate, (int, float)):
        values["rate"] = [[EVER, reel.rate]] if reel.rate else []
    return values


def build(values: Mapping[str, Any]) -> Reel:
    """Returns plain data as a reel."""
    known = {name: values[name] for name in Reel.__dataclass_fields__ if name in values}
    rows = known["rate"]
    if len(rows) <= 1:
        known["rate"] = rows[0][1] if rows else 0.0
    return Reel(**known)
