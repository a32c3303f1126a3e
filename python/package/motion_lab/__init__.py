"""A deterministic 2D robot-motion laboratory."""

from ._core import world_names

__all__ = ["world_names"]
