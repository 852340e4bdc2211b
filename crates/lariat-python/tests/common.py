"""What several tests use."""

from __future__ import annotations

from pathlib import Path

import lariat_cables as lariat

SCENES = Path(__file__).parents[3] / "assets" / "scenes"


def pendulum(**arguments: object) -> lariat.Cable:
    """The falling pendulum of Bulin & Hajzman: 2 m, 1 cm square, released from horizontal."""
    section = lariat.Section.square(0.01, 1.0e8, 4000.0)
    return lariat.Cable([[0, 0, 0], [2, 0, 0]], section, fix="start", **arguments)  # type: ignore[arg-type]
