"""Gymnasium environments: an episode of a learning task (`Env`), and many stepped together (`VectorEnv`).

Importing this module registers `motion_lab/RustyGoal-v0`, `motion_lab/HitchPark-v0` and `motion_lab/ReachPost-v0`:

    gym.make("motion_lab.envs:motion_lab/RustyGoal-v0")
    gym.make_vec("motion_lab.envs:motion_lab/RustyGoal-v0", num_envs=1024)

An observation is a float32 array, an action two numbers in [-1, 1], a step a tick of 0.05 s. What the numbers mean:

- RustyGoal, 363: a rover in the Apartment drives to a goal 1 to 4 m away. Of 360 rays, from straight ahead
  counter-clockwise, the range over 4 m (1 where nothing is in range); the goal's distance over 4 m; the cosine and the
  sine of its bearing from the heading. Actions: speed and turn rate. At most 600 ticks.
- HitchPark, 10: a car backs its trailer into a bay of the Lot. The car's rear axle (x / 16 m, y / 10 m, cosine and sine
  of its heading), cosine and sine of the trailer's heading from the car's, from the trailer's axle to the middle of the
  bay (x / 16 m, y / 10 m), cosine and sine of the trailer's heading. Actions: speed and steering angle. At most 1,200.
- ReachPost, 11: an arm turns from one side of the Workbench's post to the other. Cosine and sine of both joints, those
  of the goal, the differences to the goal over pi, the clearance in metres. Actions: the joints' turns in a tick, as
  parts of 0.1 rad. At most 200.

A tick earns the metres (ReachPost: radians) by which the robot came nearer, 1 more where it does what it was to do, 1
less on contact; both end the episode. The step that ends one says in `info["is_success"]` which it was. There is no
render mode: `episode` gives the run, whose picture shows it all.
"""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import Any, Literal

import gymnasium as gym
import numpy as np
import numpy.typing as npt
from gymnasium import spaces
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space

from ._core import Episodes, Run

__all__ = ["Env", "Task", "VectorEnv"]

Task = Literal["RustyGoal", "HitchPark", "ReachPost"]

Floats = npt.NDArray[np.float32]
Flags = npt.NDArray[np.bool_]

# the least and the greatest of each number: (how many, least, greatest)
_LIMITS: dict[str, list[tuple[int, float, float]]] = {
    "RustyGoal": [(360, 0, 1), (1, 0, 4), (2, -1, 1)],
    "HitchPark": [(2, 0, 1), (4, -1, 1), (2, -2, 2), (2, -1, 1)],
    "ReachPost": [(8, -1, 1), (2, -1, 1), (1, 0, 4)],
}

_AUTORESET = {
    AutoresetMode.NEXT_STEP: "NextStep",
    AutoresetMode.SAME_STEP: "SameStep",
    AutoresetMode.DISABLED: "Disabled",
}


def observation_space(task: str) -> spaces.Box[np.float32]:
    """The space of one observation of a task."""
    if task not in _LIMITS:
        raise ValueError(f"no task is named {task!r}: there are {', '.join(_LIMITS)}")
    counts, least, greatest = zip(*_LIMITS[task], strict=True)
    low, high = (np.repeat(np.array(ends, np.float32), counts) for ends in (least, greatest))
    return spaces.Box(low, high, dtype=np.float32)


def action_space() -> spaces.Box[np.float32]:
    """The space of one action of any task."""
    return spaces.Box(-1.0, 1.0, (2,), np.float32)


def as_actions(actions: Any, shape: tuple[int, ...]) -> Floats:
    """Actions as a C-ordered float32 array of this shape.

    Raises ValueError for another shape and for what is no array of real numbers.
    """
    given = np.asarray(actions)
    if given.shape != shape:
        raise ValueError(f"actions have the shape {given.shape}, not {shape}")
    if given.dtype == np.float32 and given.flags.c_contiguous and given.flags.aligned:
        return given
    if not np.can_cast(given.dtype, np.float32, "same_kind"):
        raise ValueError(f"actions are {given.dtype}, here they are float32")
    with np.errstate(over="ignore"):  # what overflows is refused as not finite
        return np.array(given, np.float32, order="C")


def as_seed(seed: Any, count: int = 1) -> int:
    """The first of `count` seeds as an int.

    Raises ValueError unless all are from 0 to 2**64 - 1.
    """
    first = operator.index(seed)
    if not 0 <= first <= 2**64 - count:
        raise ValueError(f"seed {first}: it must be from 0 to {2**64 - count}")
    return first


class Env(gym.Env[Floats, Floats]):
    """One episode after the other of a task.

    `reset(seed=s)` begins the first episode of the seed s, `reset()` the next one of the seed that the environment has;
    at first one is drawn. It is replica 0 of a `VectorEnv` with the same seed, bit for bit.

    With `copy=False` every step gives the same array, with other numbers in it.
    """

    metadata: dict[str, Any] = {"render_modes": []}

    def __init__(self, task: Task = "RustyGoal", *, copy: bool = True, render_mode: None = None) -> None:
        self.observation_space = observation_space(task)
        self.action_space = action_space()
        _check_render_mode(render_mode)
        self._episodes = Episodes(task, 1, "Disabled")
        self._begun = False
        self._copy = copy
        self._arrays = _Arrays(1, self._episodes.observations)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Floats, dict[str, Any]]:
        """Begin an episode; returns what is observed at its start, and no information. There are no options."""
        if seed is not None:
            seed = as_seed(seed)
        super().reset(seed=seed)
        if seed is None and not self._begun:
            seed = _drawn(self.np_random, 1)
        self._episodes.begin([seed])
        self._begun = True
        observations = self._next_arrays().observations
        self._episodes.observe(observations)
        return observations[0], {}

    def step(self, action: npt.ArrayLike) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        """Act for a tick, 0.05 s.

        Returns what is observed then, what the tick earned, whether it ended the episode and whether it cut it off;
        then `info["is_success"]` says whether the robot did what it was to do.

        Raises ValueError for an action of another shape or type, `motion_lab.Error` (a ValueError) for one that is not
        finite and after the end of an episode.
        """
        if not self._begun:
            raise gym.error.ResetNeeded("reset() comes before step()")
        actions = as_actions(action, (2,))
        arrays = self._next_arrays()
        ended = self._episodes.step(actions, *arrays.all())
        info = {"is_success": bool(self._episodes.reached()[0])} if ended else {}
        reward, terminated, truncated = arrays.rewards[0], arrays.terminated[0], arrays.truncated[0]
        return arrays.observations[0], float(reward), bool(terminated), bool(truncated), info

    def episode(self) -> Run:
        """The run of the present episode so far: it can be written, and it verifies."""
        return self._episodes.episode(0)

    def _next_arrays(self) -> _Arrays:
        if self._copy:
            self._arrays = _Arrays(1, self._episodes.observations)
        return self._arrays


class VectorEnv(gym.vector.VectorEnv[Floats, Floats, npt.NDArray[Any]]):
    """Many episodes of a task, stepped together by one call without any Python for each; the GIL is free meanwhile.

    `reset(seed=s)` gives replica i the seed s + i: it is `Env.reset(seed=s + i)`, bit for bit, and no other replica and
    no number of threads changes it. `reset()` begins the next episodes of the seeds that the replicas have; at first
    they are drawn. From 256 replicas on a step divides them among threads (`motion_lab.set_threads`).

    `autoreset_mode` says what follows the end of an episode:

    - NEXT_STEP: the next step begins a new one, whatever its action, which is finite, and earns nothing;
    - SAME_STEP: the same step begins it; `info["final_obs"]` and `info["final_info"]` say how the last one ended;
    - DISABLED: nothing; `reset(options={"reset_mask": m})` begins those anew that the array of bool says.

    With `copy=False` every step gives the same arrays, with other numbers in them.
    """

    def __init__(
        self,
        task: Task = "RustyGoal",
        num_envs: int = 1,
        *,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        copy: bool = True,
        render_mode: None = None,
    ) -> None:
        mode = AutoresetMode(autoreset_mode)
        self.metadata = {"render_modes": [], "autoreset_mode": mode}
        self.num_envs = operator.index(num_envs)
        if not 1 <= self.num_envs <= 2**20:
            raise ValueError(f"num_envs {num_envs}: there must be 1 to {2**20}")
        self.single_observation_space = observation_space(task)
        self.single_action_space = action_space()
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        _check_render_mode(render_mode)
        self.autoreset_mode = mode
        self._episodes = Episodes(task, self.num_envs, _AUTORESET[mode])
        self._begun = False
        self._copy = copy
        self._arrays = _Arrays(self.num_envs, self._episodes.observations)

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Floats, dict[str, Any]]:
        """Begin episodes; returns what all observe then, and no information.

        `seed` is one for all (replica i has seed + i), or one for each, None for the next episode of a replica.
        `options={"reset_mask": m}` begins only some.
        """
        seeds = self._seeds(seed)
        mask = (options or {}).get("reset_mask")
        if mask is not None:
            mask = _as_mask(mask, self.num_envs).tolist()
        self._episodes.begin(seeds, mask)
        self._begun = True
        observations = self._next_arrays().observations
        self._episodes.observe(observations)
        return observations, {}

    def step(self, actions: npt.ArrayLike) -> tuple[Floats, npt.NDArray[np.float64], Flags, Flags, dict[str, Any]]:
        """Act in all of them for a tick, 0.05 s.

        Returns arrays of what they observe then, what the tick earned, whether it ended their episodes and whether it
        cut them off.

        Raises ValueError for actions of another shape or type, `motion_lab.Error` (a ValueError) for the first replica
        whose action is not finite, or whose episode has ended and was not begun anew. Nothing has changed then.
        """
        if not self._begun:
            raise gym.error.ResetNeeded("reset() comes before step()")
        given = as_actions(actions, (self.num_envs, 2))
        arrays = self._next_arrays()
        ended = self._episodes.step(given, *arrays.all())
        return (*arrays.all(), self._info(arrays) if ended else {})

    def episode(self, index: int) -> Run:
        """The run of a replica's present episode so far: it can be written, and it verifies.

        With NEXT_STEP the present episode is the one that ended until the next step.
        """
        return self._episodes.episode(index)

    def configurations(self) -> npt.NDArray[np.float64]:
        """The robots' configurations, float64 of (num_envs, d): metres and radians."""
        return self._episodes.configurations()

    def _info(self, arrays: _Arrays) -> dict[str, Any]:
        """What there is to say of the episodes that this step ended."""
        ended = arrays.terminated | arrays.truncated
        success = {"is_success": self._episodes.reached(), "_is_success": ended}
        if self.autoreset_mode != AutoresetMode.SAME_STEP:
            return success
        final = np.full(self.num_envs, None, dtype=object)
        for index in np.flatnonzero(ended).tolist():
            final[index] = self._episodes.final_observation(index)
        return {"final_obs": final, "_final_obs": ended.copy(), "final_info": success, "_final_info": ended.copy()}

    def _seeds(self, seed: int | Sequence[int | None] | None) -> list[int | None]:
        count = self.num_envs
        if isinstance(seed, (list, tuple, np.ndarray)):
            if len(seed) != count:
                raise ValueError(f"{len(seed)} seeds for {count} replicas")
            seeds = [None if own is None else as_seed(own) for own in seed]
        elif seed is None:
            seeds = [None] * count
        else:
            first = as_seed(seed, count)
            super().reset(seed=first)
            return [first + index for index in range(count)]
        if not self._begun and None in seeds:
            first = _drawn(self.np_random, count)
            seeds = [first + index if own is None else own for index, own in enumerate(seeds)]
        return seeds

    def _next_arrays(self) -> _Arrays:
        if self._copy:
            self._arrays = _Arrays(self.num_envs, self._episodes.observations)
        return self._arrays


class _Arrays:
    """The arrays that a step writes."""

    __slots__ = ("observations", "rewards", "terminated", "truncated")

    def __init__(self, count: int, width: int) -> None:
        self.observations = np.empty((count, width), np.float32)
        self.rewards = np.empty(count, np.float64)
        self.terminated = np.empty(count, np.bool_)
        self.truncated = np.empty(count, np.bool_)

    def all(self) -> tuple[Floats, npt.NDArray[np.float64], Flags, Flags]:
        return self.observations, self.rewards, self.terminated, self.truncated


def _check_render_mode(render_mode: None) -> None:
    if render_mode is not None:
        raise ValueError(f"render_mode {render_mode!r}: there is none; episode() gives the run, which has a picture")


def _as_mask(mask: Any, count: int) -> Flags:
    if not (isinstance(mask, np.ndarray) and mask.dtype == np.bool_ and mask.shape == (count,)):
        raise ValueError(f"options['reset_mask'] must be an array of {count} bool")
    if not mask.any():
        raise ValueError("options['reset_mask'] says of no replica that it begins anew")
    return mask


def _drawn(random: np.random.Generator, count: int) -> int:
    """The first of `count` seeds, drawn."""
    return int(random.integers(2**63 - count))


def _register() -> None:
    for task in _LIMITS:
        gym.register(
            f"motion_lab/{task}-v0",
            entry_point="motion_lab.envs:Env",
            vector_entry_point="motion_lab.envs:VectorEnv",
            kwargs={"task": task},
        )


_register()
