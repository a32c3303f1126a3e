"""Planners of one's own, and planners compared by the same problem at several seeds."""

from __future__ import annotations

import time
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Protocol

from ._core import NoPath, plan

if TYPE_CHECKING:
    from ._core import Checker, Search, World


class Planner(Protocol):
    """What ``plan`` asks of a planner of yours; it need not be a subclass.

    One that joins samples says so by an attribute ``draws_samples``, True: then its paths keep 1 mm from obstacles,
    unless another ``clearance`` is asked for.
    """

    @property
    def name(self) -> str:
        """Small letters, digits and hyphens; none of ``planner_names()``."""

    def advance(self, search: Search, /) -> object:
        """Go on by an iteration; ``search.take`` and ``take_branch`` end it. What is returned does not matter."""


def compare(
    planners: Iterable[str | Planner | type[Planner]],
    checker: Checker | World | str,
    start: Any,
    goal: Any,
    *,
    seeds: Iterable[int] = range(100),
    **how: Any,
) -> list[dict[str, Any]]:
    """A row for each planner and seed: what it did, the path's length in its own unit and clearance, or the reason.

    The other arguments are those of ``plan``, and what ``plan`` raises is raised, but for NoPath. A class is called for
    a planner of each attempt. Length and clearance are None without a path, the reason is with one.
    ``pandas.DataFrame(rows)`` is the table.
    """
    seeds = list(seeds)
    rows = []
    for planner in planners:
        for seed in seeds:
            begun = time.perf_counter()
            # a planner may hold what it has grown, so that each attempt has one of its own
            own = planner() if isinstance(planner, type) else planner
            path, reason = None, None
            try:
                path = plan(checker, start, goal, planner=own, seed=seed, **how)
                effort = path.effort
            except NoPath as error:
                reason = str(error)
                effort = error.effort or dict.fromkeys(["iterations", "samples", "edges", "free"], 0)
            row: dict[str, Any] = {
                "planner": own if isinstance(own, str) else own.name,
                "seed": seed,
                "solved": path is not None,
                "time_s": time.perf_counter() - begun,
                **effort,
                "length": path.length if path else None,
                "clearance_m": path.clearance if path else None,
                "reason": reason,
            }
            rows.append(row)
    return rows
