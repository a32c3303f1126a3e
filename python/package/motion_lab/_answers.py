"""The answers that are more than one number, or that are no plain one: named tuples, and the verdicts on edges."""

from enum import IntEnum
from typing import Any, NamedTuple


class Verdict(IntEnum):
    """What is known of an edge. Arrays of answers hold its numbers: ``e.verdict == ml.FREE``."""

    FREE = 0
    """The whole edge is proven free."""
    HIT = 1
    """The edge touches an obstacle, or leaves the robot's own limits."""
    UNRESOLVED = 2
    """Neither could be proven: the edge comes too close to contact to tell."""

    def __bool__(self) -> bool:
        """Raise TypeError: ``FREE`` is the number 0, so that it would be false."""
        raise TypeError("a verdict is neither true nor false: compare it, as e.verdict == ml.FREE")


FREE, HIT, UNRESOLVED = Verdict


class Shape(NamedTuple):
    """All points within ``radius``, metres, of the convex hull of ``vertices``."""

    vertices: Any
    """An array ``(k, 2)``, metres, counter-clockwise; a disc has one vertex, a segment two."""
    radius: float
    """Metres; 0 for segments, boxes and polygons."""


class Proven(float):
    """How far along an edge a proof holds, from 0.0 to 1.0: a number that is true only where it is the whole edge."""

    __slots__ = ()

    @property
    def holds(self) -> bool:
        """Whether the whole edge is proven free."""
        return self == 1.0

    @property
    def up_to(self) -> float:
        """Everything before this parameter of the edge is proven free."""
        return float(self)

    def __bool__(self) -> bool:
        return self.holds

    def __repr__(self) -> str:
        return f"Proven(up_to={float(self)!r}, holds={self.holds})"

    __str__ = float.__repr__


class Refusals(NamedTuple):
    """How many inputs and changes a run refused, and why the first was. It is true when there were any."""

    total: int
    """How many."""
    first: str | None
    """Why the first was, in words; None where there was none."""

    def __bool__(self) -> bool:
        return self.total > 0


class Witness(NamedTuple):
    """The nearest points of a robot and the obstacles; each an array for many configurations."""

    distance: Any
    """Metres between the two points; 0 on contact, inf where there is no obstacle."""
    on_robot: Any
    """The point of the robot, metres; nan where there is no obstacle."""
    on_obstacle: Any
    """The point of the obstacle, metres; on contact the same as ``on_robot``, nan where there is no obstacle."""
    part: Any
    """The number of the robot's part: an arm's link, 1 for a car's trailer; -1 where there is no obstacle."""
    obstacle: Any
    """The number of the obstacle in ``world.obstacles``; -1 where there is none."""

    def __bool__(self) -> bool:
        """Raise TypeError: any tuple would be true, in contact or not."""
        raise TypeError("a witness is neither true nor false: compare its distance, or ask checker.intersects(q)")


class Edge(NamedTuple):
    """What is known of an edge over its parameter from 0 to 1; each an array for many edges."""

    verdict: Any
    """``FREE``, ``HIT`` or ``UNRESOLVED``."""
    clearance: Any
    """A proven lower bound of the clearance all along the edge, metres: 0 unless it is free, inf without obstacles."""
    free_until: Any
    """Everything before this parameter is proven free; 1 for a free edge."""
    contact_at: Any
    """At this parameter the robot touches, or is outside its own limits; inf where no contact is known."""
    part: Any
    """The number of the robot's part in contact there, or held by the limit; -1 where no contact is known."""
    obstacle: Any
    """The number in ``world.obstacles`` of what it touches; -1 for its own limit, and where no contact is known."""
    gap: Any
    """How far the robot can still move after ``free_until`` in an unresolved edge, metres; 0 in any other."""

    def __bool__(self) -> bool:
        """Raise TypeError: any tuple would be true, free or not."""
        raise TypeError("an edge is neither true nor false: ask e.verdict == ml.FREE, or checker.edge_free(a, b)")
