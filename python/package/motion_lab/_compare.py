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
        """Go on by an iteration; ``search.take`` and ``take_branch`` end it. What is returned does not matter.

        One that gives up raises ``NoPath`` with its reason: ``plan`` raises it with the effort, and ``compare`` has the
        reason in the row. Anything else that is raised ends both.
        """


def compare(
    planners: Iterable[str | Planner | type[Planner]],
    checker: Checker | World | str,
    start: Any,
    goal: Any,
    *,
    seeds: Iterable[int] = range(100),
    clearance: float | None = None,
    **how: Any,
) -> list[dict[str, Any]]:
    """A row for each planner and seed: what it did, the path's length in its own unit and clearance, or the reason.

    ``clearance`` is what every path has to keep, metres, alike for all planners. Without it each is asked for what is
    usual for it, which is not the same: 1 mm of the lab's planners that draw samples and of yours with
    ``draws_samples``, 0 of all others. The column ``clearance_asked_m`` says it, None where there is no path and
    nobody said one.

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
                path = plan(checker, start, goal, planner=own, seed=seed, clearance=clearance, **how)
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
                "length": None if path is None else path.length,
                "clearance_m": None if path is None else path.clearance,
                "clearance_asked_m": clearance if path is None else path.clearance_asked,
                "reason": reason,
            }
            rows.append(row)
    return rows
