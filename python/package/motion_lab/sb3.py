"""Stable-Baselines3: `VecEnv`, many episodes of a task as its learners take them.

    from motion_lab.sb3 import VecEnv
    model = stable_baselines3.PPO("MlpPolicy", VecEnv("RustyGoal", 64))

Stable-Baselines3 takes no Gymnasium `VectorEnv`. It is imported when `VecEnv` is asked for, not before.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium.vector import AutoresetMode

from ._core import Run
from .envs import Task, VectorEnv


class _Replicas:
    """Many episodes of a task, stepped together, as Stable-Baselines3's `VecEnv`.

    An episode that ends begins anew in the same step; its info has `terminal_observation`, `TimeLimit.truncated` and
    `is_success`. `seed(s)` and then `reset()` gives replica i the seed s + i, and the bits of `motion_lab.envs.Env`
    with that seed; rewards are float32. Wrap it in `VecMonitor` for the returns and the lengths of episodes.
    """

    num_envs: int
    _seeds: list[int | None]

    def __init__(self, task: Task = "RustyGoal", num_envs: int = 1) -> None:
        self.replicas = VectorEnv(task, num_envs, autoreset_mode=AutoresetMode.SAME_STEP)
        self.actions: npt.ArrayLike | None = None
        super().__init__(  # type: ignore[call-arg]
            self.replicas.num_envs, self.replicas.single_observation_space, self.replicas.single_action_space
        )

    def reset(self) -> npt.NDArray[np.float32]:
        """Begin all episodes; returns what they observe."""
        observations, _ = self.replicas.reset(seed=self._seeds)
        self.reset_infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        self._reset_seeds()  # type: ignore[attr-defined]
        self._reset_options()  # type: ignore[attr-defined]
        return observations

    def step_async(self, actions: npt.ArrayLike) -> None:
        """Keep the actions for `step_wait`."""
        self.actions = actions

    def step_wait(
        self,
    ) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32], npt.NDArray[np.bool_], list[dict[str, Any]]]:
        """Act in all of them for a tick; returns what they observe, what it earned, which ended, and what else."""
        if self.actions is None:
            raise RuntimeError("step_async() comes before step_wait()")
        actions, self.actions = self.actions, None
        observations, rewards, terminated, truncated, info = self.replicas.step(actions)
        ended = terminated | truncated
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for index in np.flatnonzero(ended).tolist():
            infos[index] = {
                "terminal_observation": info["final_obs"][index],
                "TimeLimit.truncated": bool(truncated[index]),
                "is_success": bool(info["final_info"]["is_success"][index]),
            }
        return observations, rewards.astype(np.float32), ended, infos

    def close(self) -> None:
        """Nothing is left open."""

    def episode(self, index: int) -> Run:
        """The run of a replica's present episode so far: it can be written, and it verifies."""
        return self.replicas.episode(index)

    def get_attr(self, attr_name: str, indices: int | Iterable[int] | None = None) -> list[Any]:
        """An attribute, which all replicas share, once for each."""
        value = getattr(self.replicas, attr_name)
        return [value for _ in self._indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: int | Iterable[int] | None = None) -> None:
        """Refused: the replicas share their attributes, and none is to be set."""
        raise AttributeError(f"the replicas share {attr_name!r}, which is not to be set")

    def env_method(
        self, method_name: str, *args: Any, indices: int | Iterable[int] | None = None, **kwargs: Any
    ) -> list[Any]:
        """`env_method("episode")` gives the replicas' runs; they have no other method."""
        if method_name != "episode" or args or kwargs:
            raise AttributeError(f"replicas have the method episode() alone, not {method_name!r}")
        return [self.episode(index) for index in self._indices(indices)]

    def env_is_wrapped(self, wrapper_class: type, indices: int | Iterable[int] | None = None) -> list[bool]:
        """No replica is wrapped."""
        return [False for _ in self._indices(indices)]

    def _indices(self, indices: int | Iterable[int] | None) -> Iterable[int]:
        if indices is None:
            return range(self.replicas.num_envs)
        return [indices] if isinstance(indices, int) else indices


@functools.cache
def _of(base: type) -> type:
    """The class `VecEnv` on Stable-Baselines3's own."""
    members = {"__doc__": _Replicas.__doc__, "__module__": __name__}
    return type("VecEnv", (_Replicas, base), members)


def __getattr__(name: str) -> Any:
    if name != "VecEnv":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from stable_baselines3.common.vec_env import VecEnv as base  # type: ignore[import-not-found]

    return _of(base)
