"""Worlds on the axes of matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._core import _drawing

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._core import World


def draw(world: World, ax: Axes) -> Axes:
    """Add the obstacles, doors, routes and marks of a world to axes, and fit the axes to its bounds."""
    from matplotlib.collections import LineCollection, PolyCollection

    for name, colour, pieces, lines, width, dashed in _drawing(world):
        if pieces:
            ax.add_collection(PolyCollection(pieces, facecolors=colour, alpha=0.25, linewidths=0, gid=name))
        if lines:
            style = "dashed" if dashed else "solid"
            ax.add_collection(LineCollection(lines, colors=colour, linewidths=width, linestyles=style, gid=name))
    left, bottom, right, top = world.bounds
    ax.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
    return ax
