"""Types of arguments, for annotations."""

from __future__ import annotations

from typing import Literal, Union

import numpy as np
from numpy.typing import NDArray

from lariat.results import RigidBodyHandle

Array = NDArray[np.float64]
"""Numbers."""
Place = Union[Literal["start", "end"], int, float]
"""A point of a cable: an end, a node (int), or an arc length of the unstretched cable in m (float)."""
Fidelity = Literal["game", "engineering", "reference"]
"""Accuracy against cost."""
Handle = Union[RigidBodyHandle, tuple[int, int]]
"""Names a body of a world."""
