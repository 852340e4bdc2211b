"""Types of arguments, for annotations."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lariat_cables.node import Node
from lariat_cables.results import RigidBodyHandle

Array = NDArray[np.float64]
"""Numbers."""
Points = Union[ArrayLike, Sequence[object]]
"""Points in m, shape (n, 3). A list of lists of ints and of floats is to type checkers one of objects."""
Place = Union[Literal["start", "end"], Node, float]
"""A point of a cable: an end, an arc length of the unstretched cable in m from its start (float), or a node. An integer that is no ``Node`` is
refused where it is not 0."""
Fidelity = Literal["game", "engineering", "reference"]
"""Accuracy against cost."""
Handle = Union[RigidBodyHandle, tuple[int, int]]
"""Names a body of a world."""
