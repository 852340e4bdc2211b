"""Nodes of a cable, as places."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from typing_extensions import Self


class Node(int):
    """A node of a cable by its number, from 0 at the start: ``cable.fix(lariat.Node(3))``.

    It is an ``int``, so that it counts in arrays of nodes: ``cable.positions[cable.node("end")]``. Calls that take a point of a cable
    take no other integer than 0, which could be a number of metres as well. Raises ValueError for a negative number.
    """

    __slots__ = ()

    def __new__(cls, number: int) -> Self:
        if number < 0:
            raise ValueError(f"the number of a node must be >= 0, not {number}")
        return super().__new__(cls, number)

    def __repr__(self) -> str:
        return f"Node({int(self)})"
