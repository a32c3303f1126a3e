"""PettingZoo's parallel environment: its own checks, agents that leave, and the run they are in."""

import warnings

import numpy as np
import pytest
from pettingzoo.test import parallel_api_test, parallel_seed_test

import motion_lab as ml
from motion_lab.pettingzoo import Warehouse


def toward(seen):
    """Straight for the goal: turn toward it, and go when it is ahead."""
    cos, sin = seen[361], seen[362]
    return np.array([cos > 0.9, (1 - cos) * np.sign(sin)], np.float32)


def test_pettingzoo_s_own_checks_pass_without_a_warning(capsys):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        parallel_api_test(Warehouse(12), num_cycles=700)
        parallel_seed_test(lambda: Warehouse(12), num_cycles=20)
    assert "Passed Parallel API test" in capsys.readouterr().out


def test_an_agent_that_is_done_leaves_and_its_rover_stands():
    env = Warehouse(20, warehouse=3)
    seen, infos = env.reset(seed=1)
    assert env.agents == env.possible_agents == [f"rover {i:05}" for i in range(16)]
    assert infos == {agent: {} for agent in env.agents}
    left, nearer = {}, dict.fromkeys(env.agents, 0.0)
    first = {agent: seen[agent][360] * 4 for agent in env.agents}
    for _ in range(300):
        before = list(env.agents)
        seen, rewards, terminated, truncated, infos = env.step({agent: toward(seen[agent]) for agent in before})
        for data in (seen, rewards, terminated, truncated, infos):
            assert list(data) == before
        for agent in before:
            nearer[agent] += rewards[agent]
            if terminated[agent]:
                left[agent] = infos[agent]["is_success"]
                worth = 1 if left[agent] else -1
                assert nearer[agent] == pytest.approx(first[agent] - seen[agent][360] * 4 + worth, abs=1e-5)
            else:
                assert infos[agent] == {}
        assert env.agents == [agent for agent in before if agent not in left]
        assert not any(truncated.values())
        if not env.agents:
            break
    assert set(left.values()) == {True, False}, "some reached their goals and some touched something"


def test_the_run_of_all_robots_verifies_and_is_that_of_its_seed(tmp_path):
    def drive(env):
        env.reset(seed=9)
        for _ in range(25):
            env.step({agent: [1, 0.2] for agent in env.agents})
        return env.episode()

    env = Warehouse(10)
    run = drive(env)
    assert run.ticks == 25 and run.verify().identical == 25 and run.verify()
    run.write(tmp_path / "warehouse.mcap")
    assert (tmp_path / "warehouse.mcap").read_bytes()[1:5] == b"MCAP"
    # the run goes on from where it stood
    env.step({agent: [1, 0.2] for agent in env.agents})
    assert env.episode().ticks == 26
    assert drive(env).digest == drive(Warehouse(10)).digest == run.digest
    assert drive(Warehouse(10, warehouse=2)).digest != run.digest
    assert drive(Warehouse(10, trailers=True)).digest != run.digest


def test_rovers_see_each_other():
    env = Warehouse(20, warehouse=3)
    seen, _ = env.reset(seed=1)
    other = Warehouse(20, warehouse=3)
    same, _ = other.reset(seed=1)
    assert all(np.array_equal(seen[agent], same[agent]) for agent in env.agents)
    still, driven = env.agents[5], env.agents[2]  # the second drives in sight of the first
    for _ in range(10):
        seen = env.step({agent: [0, 0] for agent in env.agents})[0]
        same = other.step({agent: [float(agent == driven), 0] for agent in other.agents})[0]
    assert not np.array_equal(seen[still][:360], same[still][:360]), "what the other one does is seen"
    assert np.array_equal(seen[still][360:], same[still][360:])


def test_wrong_actions_are_refused_by_the_agent_s_name_and_change_nothing():
    env = Warehouse(10)
    env.reset(seed=1)
    right = {agent: np.zeros(2, np.float32) for agent in env.agents}
    agent = env.agents[3]
    for wrong, words in [
        ({**right, agent: [np.nan, 0]}, f"the action of {agent} is not finite"),
        ({**right, agent: [0, 0, 0]}, rf"{agent}: actions have the shape \(3,\), not \(2,\)"),
        ({**right, agent: ["a", "b"]}, f"{agent}: actions are <U1"),
        ({**right, "rover 99999": [0, 0]}, "an action of 'rover 99999', who is no agent here"),
        ({name: action for name, action in right.items() if name != agent}, f"no action of '{agent}'"),
    ]:
        with pytest.raises(ValueError, match=words):
            env.step(wrong)
    assert env.episode().ticks == 0
    for robots, words in [(9, "9 robots: a warehouse has 10 to 100000"), (100_001, "100001 robots")]:
        with pytest.raises(ml.Error, match=words):
            Warehouse(robots)
    with pytest.raises(ValueError, match="seed -1"):
        env.reset(seed=-1)
    with pytest.raises(ValueError, match="render_mode 'human'"):
        Warehouse(render_mode="human")


def test_before_the_first_reset_there_are_no_agents_and_without_a_seed_one_is_drawn():
    env = Warehouse(10)
    assert env.agents == [] and env.step({}) == ({}, {}, {}, {}, {})
    seen, again = env.reset()[0], Warehouse(10).reset()[0]
    agent = env.agents[0]
    assert not np.array_equal(seen[agent], again[agent])
    assert not np.array_equal(seen[agent], env.reset()[0][agent]), "the next episode has other goals"
    assert env.observation_space(agent) is env.observation_space(agent)
    assert seen[agent] in env.observation_space(agent)


def test_an_action_of_no_agent_is_refused_where_there_are_none_too():
    with pytest.raises(ValueError, match="an action of 'nobody', who is no agent here"):
        Warehouse(10).step({"nobody": [0, 0]})
