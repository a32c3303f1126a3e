"""Stable-Baselines3's vector environment; where it is not installed, on a stub with the contract of its base class."""

import importlib
import importlib.util
import subprocess
import sys
import types
import warnings
from abc import ABC, abstractmethod

import numpy as np
import pytest

from motion_lab.envs import Env


class StubVecEnv(ABC):
    """What learners find in `stable_baselines3.common.vec_env.VecEnv`: what is abstract, and what it does itself."""

    def __init__(self, num_envs, observation_space, action_space):
        self.num_envs = num_envs
        self.observation_space = observation_space
        self.action_space = action_space
        self.reset_infos = [{} for _ in range(num_envs)]
        self._seeds = [None for _ in range(num_envs)]
        self._options = [{} for _ in range(num_envs)]
        try:
            render_modes = self.get_attr("render_mode")
        except AttributeError:
            warnings.warn("no `render_mode`", stacklevel=2)
            render_modes = [None for _ in range(num_envs)]
        assert all(mode == render_modes[0] for mode in render_modes)
        self.render_mode = render_modes[0]

    def _reset_seeds(self):
        self._seeds = [None for _ in range(self.num_envs)]

    def _reset_options(self):
        self._options = [{} for _ in range(self.num_envs)]

    @abstractmethod
    def reset(self): ...

    @abstractmethod
    def step_async(self, actions): ...

    @abstractmethod
    def step_wait(self): ...

    @abstractmethod
    def close(self): ...

    @abstractmethod
    def get_attr(self, attr_name, indices=None): ...

    @abstractmethod
    def set_attr(self, attr_name, value, indices=None): ...

    @abstractmethod
    def env_method(self, method_name, *method_args, indices=None, **method_kwargs): ...

    @abstractmethod
    def env_is_wrapped(self, wrapper_class, indices=None): ...

    def step(self, actions):
        self.step_async(actions)
        return self.step_wait()

    def seed(self, seed=None):
        self._seeds = [seed + index for index in range(self.num_envs)]
        return self._seeds


@pytest.fixture
def make(monkeypatch):
    """Makes the environment, on the real base class where there is one."""
    if importlib.util.find_spec("stable_baselines3") is None:
        common = types.ModuleType("stable_baselines3.common.vec_env")
        common.VecEnv = StubVecEnv
        for name in ("stable_baselines3", "stable_baselines3.common"):
            monkeypatch.setitem(sys.modules, name, types.ModuleType(name))
        monkeypatch.setitem(sys.modules, common.__name__, common)
    from motion_lab.sb3 import VecEnv

    return VecEnv


def test_it_is_one_of_stable_baselines3_s_own_without_a_warning(make):
    from stable_baselines3.common.vec_env import VecEnv as Base

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        env = make("HitchPark", 3)
    assert isinstance(env, Base) and env.num_envs == 3 and env.render_mode is None
    assert env.observation_space == Env("HitchPark").observation_space
    assert env.action_space == Env("HitchPark").action_space
    assert "Stable-Baselines3" in make.__doc__ and make.__name__ == "VecEnv"


def test_its_steps_are_those_of_single_environments_begun_anew_where_they_end(make):
    env, singles = make("ReachPost", 3), [Env("ReachPost") for _ in range(3)]
    assert env.seed(11) == [11, 12, 13]
    seen = env.reset()
    expected = np.stack([single.reset(seed=11 + i)[0] for i, single in enumerate(singles)])
    assert seen.dtype == np.float32 and seen.tobytes() == expected.tobytes()
    draws, ends, cuts = np.random.default_rng(1), 0, 0
    for step in range(450):
        actions = draws.uniform(-1, 1, (3, 2)).astype(np.float32)
        actions[2] = 0  # an arm that stands is cut off
        seen, rewards, dones, infos = env.step(actions)
        assert rewards.dtype == np.float32 and dones.dtype == np.bool_ and len(infos) == 3
        for i, single in enumerate(singles):
            one, reward, terminated, truncated, info = single.step(actions[i])
            assert rewards[i] == np.float32(reward) and dones[i] == (terminated or truncated)
            if dones[i]:
                assert infos[i].pop("terminal_observation").tobytes() == one.tobytes()
                assert infos[i] == {"TimeLimit.truncated": truncated, "is_success": info["is_success"]}
                one, _ = single.reset()
                ends, cuts = ends + 1, cuts + truncated
            else:
                assert infos[i] == {}
            assert seen[i].tobytes() == one.tobytes(), (step, i)
    assert cuts >= 2 and ends > cuts
    # the seeds hold for one reset
    again = env.reset()
    assert again.tobytes() == np.stack([single.reset()[0] for single in singles]).tobytes()
    assert env.reset_infos == [{}, {}, {}]


def test_what_learners_ask_of_its_replicas(make):
    env = make("RustyGoal", 3)
    env.seed(1)
    env.reset()
    env.step(np.ones((3, 2)))
    assert env.get_attr("render_mode") == [None, None, None] and env.get_attr("num_envs", 1) == [3]
    with pytest.raises(AttributeError):
        env.get_attr("nothing")
    assert env.env_is_wrapped(object) == [False] * 3 and env.env_is_wrapped(object, [0, 2]) == [False] * 2
    assert [run.verify().identical for run in env.env_method("episode", indices=[0, 2])] == [1, 1]
    with pytest.raises(AttributeError, match="replicas have the method episode"):
        env.env_method("reset")
    with pytest.raises(AttributeError, match="'task'"):
        env.set_attr("task", 1)
    with pytest.raises(RuntimeError, match="step_async"):
        env.step_wait()
    with pytest.raises(ValueError, match="the action of episode 1 is not finite"):
        env.step([[0, 0], [np.nan, 0], [0, 0]])
    env.close()


def test_the_module_loads_without_stable_baselines3_and_says_what_is_missing_when_asked():
    code = "import sys; sys.modules['stable_baselines3'] = None\nimport motion_lab.sb3\n"
    code += (
        "try:\n    motion_lab.sb3.VecEnv\nexcept ImportError as error:\n    print('stable_baselines3' in str(error))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "True"


@pytest.mark.parametrize("task", ["RustyGoal", "HitchPark", "ReachPost"])
def test_stable_baselines3_finds_nothing_wrong(task):
    checked = pytest.importorskip("stable_baselines3.common.env_checker", reason="Stable-Baselines3 is not installed")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        checked.check_env(Env(task))


def test_ppo_learns_for_10_000_steps(tmp_path):
    sb3 = pytest.importorskip("stable_baselines3", reason="Stable-Baselines3 is not installed")
    from stable_baselines3.common.vec_env import VecMonitor

    replicas = importlib.import_module("motion_lab.sb3").VecEnv("RustyGoal", 16)
    model = sb3.PPO("MlpPolicy", VecMonitor(replicas), n_steps=128, seed=7, device="cpu")
    model.learn(10_000)
    # a rollout is 16 times 128 steps
    assert model.num_timesteps == 10_240 and len(model.ep_info_buffer) > 0
    replicas.episode(3).write(tmp_path / "episode.mcap")
    assert replicas.episode(3).verify()
