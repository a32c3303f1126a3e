"""A deterministic 2D robot-motion laboratory: collision answers with proofs, planners, exact replay, environments.

Metres, radians, seconds, float64. Touching is contact. The last axis of an array is the configuration.
"""

from typing import TYPE_CHECKING

# questions
from ._core import (
    Assignment,
    Attempt,
    Certificate,
    Checker,
    ConfigurationError,
    Difference,
    Disc,
    Error,
    Frame,
    Grade,
    Hitch,
    LogError,
    NoPath,
    Obstacle,
    Path,
    Picture,
    Problem,
    Reach,
    Recorder,
    Resident,
    Robot,
    Run,
    RunError,
    Rusty,
    Search,
    Verification,
    World,
    WorldError,
    __version__,
    plan,
    planner_names,
    read,
    record,
    scan,
    set_threads,
    threads,
    world_names,
)

if TYPE_CHECKING:
    from ._answers import FREE, HIT, UNRESOLVED, Edge, Proven, Refusals, Shape, Verdict, Witness
    from ._compare import Planner, compare
    from .widget import Widget as Widget

__all__ = [
    "FREE",
    "HIT",
    "UNRESOLVED",
    "Assignment",
    "Attempt",
    "Certificate",
    "Checker",
    "ConfigurationError",
    "Difference",
    "Disc",
    "Edge",
    "Error",
    "Frame",
    "Grade",
    "Hitch",
    "LogError",
    "NoPath",
    "Obstacle",
    "Path",
    "Picture",
    "Planner",
    "Problem",
    "Proven",
    "Reach",
    "Recorder",
    "Refusals",
    "Resident",
    "Robot",
    "Run",
    "RunError",
    "Rusty",
    "Search",
    "Shape",
    "Verdict",
    "Verification",
    "Witness",
    "World",
    "WorldError",
    "__version__",
    "compare",
    "plan",
    "planner_names",
    "read",
    "record",
    "scan",
    "set_threads",
    "threads",
    "world_names",
]

# what is loaded when it is first asked for, and from which module
_LATER = dict.fromkeys(
    ["FREE", "HIT", "UNRESOLVED", "Edge", "Proven", "Refusals", "Shape", "Verdict", "Witness"], "_answers"
)
_LATER |= dict.fromkeys(["Planner", "compare"], "_compare")
# not among __all__: it needs anywidget
_LATER["Widget"] = "widget"


def __getattr__(name: str) -> object:
    module = _LATER.get(name)
    if module is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    value = getattr(import_module(f"{__name__}.{module}"), name)
    globals()[name] = value
    return value
