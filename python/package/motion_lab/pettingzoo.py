"""PettingZoo: the rovers of a generated warehouse, many agents in one run (`Warehouse`)."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pettingzoo  # type: ignore[import-untyped]
from gymnasium import spaces

from ._core import Fleet, Run
from .envs import action_space, as_actions, as_seed, observation_space

__all__ = ["Warehouse"]

Floats = npt.NDArray[np.float32]


class Warehouse(pettingzoo.ParallelEnv[str, Floats, Floats]):  # type: ignore[misc]
    """The rovers of a generated warehouse, each on its way to a goal of its own, in one run.

    They see each other and are in each other's way; arms and cars go about their tours. `robots`, 10 to 100,000, are
    eight rovers, an arm and a car of every ten; `warehouse` is the seed of what is generated, and with `trailers` every
    car pulls one. An agent's name is its rover's, "rover 00000". It begins where the warehouse puts it, and its goal is
    on the route through the aisle there, 1 to 4 m away. It observes, acts and earns as in RustyGoal
    (`motion_lab.envs`): 360 rays and where its goal is; speed and turn rate.

    An agent is done when it reached its goal, touched something (both terminate) or took 600 ticks of 0.05 s
    (truncates), and leaves `agents`; its rover stands from then on. `reset(seed=s)` begins the first episode of a seed,
    `reset()` the next one; at first a seed is drawn.
    """

    metadata: dict[str, Any] = {
        "name": "motion_lab_warehouse_v0",
        "render_modes": [],
        "is_parallelizable": True,
    }

    def __init__(
        self, robots: int = 10, *, warehouse: int = 1, trailers: bool = False, render_mode: None = None
    ) -> None:
        if render_mode is not None:
            raise ValueError(
                f"render_mode {render_mode!r}: there is none; episode() gives the run, which has a picture"
            )
        self.render_mode = None
        self._fleet = Fleet(robots, as_seed(warehouse), trailers=trailers)
        self.possible_agents: list[str] = self._fleet.names
        self.agents: list[str] = []
        self._rows = {agent: row for row, agent in enumerate(self.possible_agents)}
        self.observation_spaces = {agent: observation_space("RustyGoal") for agent in self.possible_agents}
        self.action_spaces = {agent: action_space() for agent in self.possible_agents}
        self._begun = False

    def observation_space(self, agent: str) -> spaces.Box[np.float32]:
        """The space of what an agent observes."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> spaces.Box[np.float32]:
        """The space of an agent's actions."""
        return self.action_spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Floats], dict[str, dict[str, Any]]]:
        """Begin an episode with all agents; returns what each observes, and no information. There are no options."""
        if seed is None and not self._begun:
            seed = int(np.random.default_rng().integers(2**63))
        self._fleet.begin(None if seed is None else as_seed(seed))
        self._begun = True
        self.agents = list(self.possible_agents)
        observations = self._observations()
        self._fleet.observe(observations)
        return {agent: observations[self._rows[agent]] for agent in self.agents}, {agent: {} for agent in self.agents}

    def step(
        self, actions: dict[str, npt.ArrayLike]
    ) -> tuple[dict[str, Floats], dict[str, float], dict[str, bool], dict[str, bool], dict[str, dict[str, Any]]]:
        """Act for a tick, 0.05 s: an action of every agent in `agents`. Those of agents that are done mean nothing.

        Returns what each agent observes, earns, whether that ends its episode or cuts it off, and
        `{"is_success": ..}` of one that is done.

        Raises ValueError for an action that is missing, of no agent, or of another shape or type, and
        `motion_lab.Error` (a ValueError) for one that is not finite. Nothing has changed then.
        """
        for agent in actions:
            if agent not in self._rows:
                raise ValueError(f"an action of {agent!r}, who is no agent here")
        agents = self.agents
        if not agents:
            return {}, {}, {}, {}, {}
        count = len(self.possible_agents)
        given = np.zeros((count, 2), np.float32)
        for agent in agents:
            if agent not in actions:
                raise ValueError(f"no action of {agent!r}")
            try:
                given[self._rows[agent]] = as_actions(actions[agent], (2,))
            except ValueError as error:
                raise ValueError(f"{agent}: {error}") from None
        observations, rewards = self._observations(), np.empty(count, np.float64)
        terminated, truncated = np.empty(count, np.bool_), np.empty(count, np.bool_)
        self._fleet.step(given, observations, rewards, terminated, truncated)
        reached = self._fleet.reached()
        rows = [(agent, self._rows[agent]) for agent in agents]
        done = {agent: bool(terminated[row] or truncated[row]) for agent, row in rows}
        self.agents = [agent for agent in agents if not done[agent]]
        return (
            {agent: observations[row] for agent, row in rows},
            {agent: float(rewards[row]) for agent, row in rows},
            {agent: bool(terminated[row]) for agent, row in rows},
            {agent: bool(truncated[row]) for agent, row in rows},
            {agent: {"is_success": bool(reached[row])} if done[agent] else {} for agent, row in rows},
        )

    def episode(self) -> Run:
        """The run so far, of all robots: it can be written, and it verifies."""
        return self._fleet.episode()

    def _observations(self) -> Floats:
        return np.empty((len(self.possible_agents), self._fleet.observations), np.float32)
