"""Gymnasium's environments: its own checks, seeds, what follows the end of an episode, and what is refused."""

import warnings

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode, SyncVectorEnv

import motion_lab as ml
from motion_lab.envs import Env, VectorEnv

TASKS = ["RustyGoal", "HitchPark", "ReachPost"]
TICKS = {"RustyGoal": 600, "HitchPark": 1200, "ReachPost": 200}
MODES = [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP]


def drawn(count, seed=0):
    """Actions that go somewhere: ahead, with some turning."""
    actions = np.random.default_rng(seed).uniform(-1, 1, (count, 2))
    return np.stack([0.5 + 0.5 * actions[:, 0], 0.3 * actions[:, 1]], axis=1).astype(np.float32)


def same(a, b):
    """Whether two results are the same to the last bit, nested or not."""
    if isinstance(a, dict):
        return isinstance(b, dict) and a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    if isinstance(a, tuple):
        return isinstance(b, tuple) and len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, np.ndarray) and a.dtype == object:
        return b.dtype == object and a.shape == b.shape and all(map(same, a, b))
    if isinstance(a, np.ndarray):
        return isinstance(b, np.ndarray) and a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()
    return type(a) is type(b) and a == b


@pytest.mark.parametrize("task", TASKS)
def test_gymnasium_s_own_check_passes_without_a_warning(task):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(gym.make(f"motion_lab.envs:motion_lab/{task}-v0").unwrapped)


@pytest.mark.parametrize("task", TASKS)
def test_an_id_makes_one_environment_or_many(task):
    env = gym.make(f"motion_lab/{task}-v0")
    vec = gym.make_vec(f"motion_lab/{task}-v0", num_envs=3, autoreset_mode="SameStep")
    assert type(env.unwrapped) is Env and type(vec) is VectorEnv
    assert vec.num_envs == 3 and vec.metadata["autoreset_mode"] is AutoresetMode.SAME_STEP
    assert vec.single_observation_space == env.observation_space and vec.single_action_space == env.action_space
    assert env.observation_space.shape == {"RustyGoal": (363,), "HitchPark": (10,), "ReachPost": (11,)}[task]
    default = gym.make_vec(f"motion_lab/{task}-v0")
    assert default.metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP and default.num_envs == 1


@pytest.mark.parametrize("task", TASKS)
def test_replica_i_is_the_environment_of_seed_s_plus_i_to_the_last_bit(task):
    vec = VectorEnv(task, 4)
    envs = [Env(task) for _ in range(4)]
    seen = vec.reset(seed=20)[0]
    assert same(seen, np.stack([env.reset(seed=20 + i)[0] for i, env in enumerate(envs)]))
    over, ends = np.zeros(4, bool), 0
    for step in range(260):
        actions = drawn(4, step // 30)
        seen, rewards, terminated, truncated, _ = vec.step(actions)
        for i, env in enumerate(envs):
            one = (env.reset()[0], 0.0, False, False) if over[i] else env.step(actions[i])[:4]
            assert same((seen[i], float(rewards[i]), bool(terminated[i]), bool(truncated[i])), one), (step, i)
        over = terminated | truncated
        ends += over.sum()
    assert ends >= 2, "episodes ended and began anew"


@pytest.mark.parametrize("task", TASKS)
@pytest.mark.parametrize("mode", MODES)
def test_what_follows_an_end_is_as_in_gymnasium_s_own_vector_environment(task, mode):
    vec = VectorEnv(task, 3, autoreset_mode=mode)
    theirs = SyncVectorEnv([lambda: Env(task)] * 3, autoreset_mode=mode)
    assert same(vec.reset(seed=5), theirs.reset(seed=5))
    ends = 0
    for step in range(260):
        actions = drawn(3, step // 30)
        ours = vec.step(actions)
        assert same(ours, theirs.step(actions)), step
        ends += (ours[2] | ours[3]).sum()
    assert ends >= 2


def test_with_the_three_modes_the_same_episodes_follow_each_other():
    vecs = {mode: VectorEnv("RustyGoal", 2, autoreset_mode=mode) for mode in AutoresetMode}
    first = [vec.reset(seed=1)[0] for vec in vecs.values()]
    assert same(first[0], first[1]) and same(first[0], first[2])
    ahead = np.array([[1, 0], [1, 0]], np.float32)
    for _ in range(700):
        results = {mode: vec.step(ahead) for mode, vec in vecs.items()}
        ended = results[AutoresetMode.DISABLED][2]
        if ended.any():
            break
    assert ended.sum() == 1
    i = int(ended.argmax())
    following, at_once, off = (
        results[m] for m in (AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP, AutoresetMode.DISABLED)
    )
    # all three say the same of the end
    assert all(same(following[k], at_once[k]) and same(following[k], off[k]) for k in (1, 2, 3))
    assert same(following[0], off[0]) and same(following[4], off[4]) and not following[4]["is_success"][i]
    assert same(at_once[4]["final_obs"][i], off[0][i]) and at_once[4]["final_obs"][1 - i] is None
    assert at_once[4]["_final_obs"].tolist() == ended.tolist()
    # nothing begins by itself
    with pytest.raises(ml.Error, match=f"episode {i} has ended; begin it anew first"):
        vecs[AutoresetMode.DISABLED].step(ahead)
    begun, _ = vecs[AutoresetMode.DISABLED].reset(options={"reset_mask": ended})
    assert same(begun[i], at_once[0][i]), "the same next start"
    assert same(begun[1 - i], off[0][1 - i]), "the other goes on"
    # the next step begins it and earns nothing
    late = vecs[AutoresetMode.NEXT_STEP].step(ahead)
    assert same(late[0][i], at_once[0][i]) and late[1][i] == 0 and not late[2][i]
    assert late[1][1 - i] != 0


def test_an_episode_is_a_log_that_verifies_and_whose_ticks_are_its_steps(tmp_path):
    vec = VectorEnv("RustyGoal", 2)
    vec.reset(seed=3)
    for _ in range(12):
        vec.step(drawn(2))
    run = vec.episode(1)
    assert run.ticks == 12 and run.verify().identical == 12 and run.verify()
    env = Env("RustyGoal")
    env.reset(seed=4)
    for _ in range(12):
        env.step(drawn(2)[1])
    assert env.episode().digest == run.digest != vec.episode(0).digest
    run.write(tmp_path / "episode.mcap")
    assert (tmp_path / "episode.mcap").read_bytes()[1:5] == b"MCAP"
    for index in (2, 2**40):
        with pytest.raises(ml.Error, match=f"there is no episode {index}; there are 2"):
            vec.episode(index)
    with pytest.raises(OverflowError):
        vec.episode(-1)


def test_seeds_may_be_one_for_all_or_one_for_each_and_are_drawn_where_there_are_none():
    one, each = VectorEnv("ReachPost", 3), VectorEnv("ReachPost", 3)
    assert same(one.reset(seed=7)[0], each.reset(seed=[7, 8, 9])[0])
    assert same(one.reset()[0], each.reset(seed=[None, None, None])[0]), "the next episodes"
    assert not same(one.reset()[0], one.reset(seed=7)[0])
    assert not same(VectorEnv("ReachPost", 3).reset()[0], VectorEnv("ReachPost", 3).reset()[0])
    last = 2**64 - 1
    assert same(one.reset(seed=last - 2)[0][2], Env("ReachPost").reset(seed=last)[0])
    for seed, words in [(-1, "seed -1: it must be from 0"), (last - 1, "it must be from 0"), ([1, 2], "2 seeds for 3")]:
        with pytest.raises(ValueError, match=words):
            one.reset(seed=seed)
    with pytest.raises(TypeError):
        one.reset(seed=1.5)


@pytest.mark.parametrize("make", [lambda copy: Env(copy=copy), lambda copy: VectorEnv(num_envs=2, copy=copy)])
def test_data_is_fresh_by_default_and_the_same_arrays_where_no_copy_is_asked_for(make):
    for copy in (True, False):
        env = make(copy)
        first = env.reset(seed=1)[0]
        kept = first.copy()
        second = env.step(np.ones(env.action_space.shape, np.float32))
        third = env.step(np.ones(env.action_space.shape, np.float32))
        assert np.shares_memory(first, second[0]) != copy
        assert np.array_equal(first, kept) == copy
        for a, b in zip(second[:4], third[:4], strict=True):
            if isinstance(a, np.ndarray):
                assert np.shares_memory(a, b) != copy


def test_both_ways_of_returning_data_give_the_same_numbers():
    fresh, kept = VectorEnv("HitchPark", 2), VectorEnv("HitchPark", 2, copy=False)
    assert same(fresh.reset(seed=1)[0], kept.reset(seed=1)[0])
    for step in range(30):
        assert same(fresh.step(drawn(2, step)), kept.step(drawn(2, step)))


def test_actions_of_any_layout_are_the_same_actions():
    rows = drawn(5)
    wide = np.zeros((5, 4), np.float32)
    wide[:, ::2] = rows
    byte = np.zeros(5 * 8 + 1, np.uint8)
    shifted = byte[1:].view(np.float32).reshape(5, 2)
    shifted[:] = rows
    given = [rows, np.asfortranarray(rows), wide[:, ::2], rows[::-1].copy()[::-1], rows.astype(np.float64)]
    given += [rows.astype(">f4"), rows.tolist(), shifted]
    vecs = [VectorEnv("RustyGoal", 5) for _ in given]
    for vec in vecs:
        vec.reset(seed=2)
    results = [vec.step(actions) for vec, actions in zip(vecs, given, strict=True)]
    assert all(same(results[0], result) for result in results)
    whole = [VectorEnv("RustyGoal", 1) for _ in range(2)]
    for vec in whole:
        vec.reset(seed=2)
    assert same(whole[0].step([[1, 0]]), whole[1].step(np.array([[1.0, 0.0]], np.float32)))


def test_wrong_actions_are_refused_by_name_and_change_nothing():
    vec, untouched = VectorEnv("RustyGoal", 3), VectorEnv("RustyGoal", 3)
    vec.reset(seed=2)
    untouched.reset(seed=2)
    bad = np.zeros((3, 2), np.float32)
    bad[2, 1] = np.nan
    many = [
        (bad, "the action of episode 2 is not finite"),
        (np.full((3, 2), 1e300), "the action of episode 0 is not finite"),
        (np.zeros((3, 3), np.float32), r"actions have the shape \(3, 3\), not \(3, 2\)"),
        (np.zeros(6, np.float32), r"actions have the shape \(6,\)"),
        (np.zeros((2, 3), np.float32), r"actions have the shape \(2, 3\)"),
        (0.5, r"actions have the shape \(\)"),
        (np.zeros((3, 2), complex), "actions are complex128, here they are float32"),
        (np.full((3, 2), "a"), "actions are <U1, here they are float32"),
        (np.full((3, 2), None), "actions are object, here they are float32"),
    ]
    for actions, words in many:
        with pytest.raises(ValueError, match=words):
            vec.step(actions)
    assert same(vec.step(drawn(3)), untouched.step(drawn(3)))
    env = Env()
    env.reset(seed=1)
    with pytest.raises(ml.Error, match="the action of episode 0 is not finite"):
        env.step([np.inf, 0])
    with pytest.raises(ValueError, match=r"actions have the shape \(3,\), not \(2,\)"):
        env.step(np.zeros(3))


def test_what_is_out_of_range_is_cut():
    vec, cut = VectorEnv("RustyGoal", 2), VectorEnv("RustyGoal", 2)
    vec.reset(seed=2)
    cut.reset(seed=2)
    assert same(vec.step([[9.0, 0.5], [1.0, -7.0]]), cut.step([[1.0, 0.5], [1.0, -1.0]]))


def test_what_cannot_be_is_refused_when_it_is_asked_for():
    with pytest.raises(ValueError, match="no task is named 'RustyGaol': there are RustyGoal, HitchPark, ReachPost"):
        Env("RustyGaol")
    with pytest.raises(ValueError, match="render_mode 'human': there is none"):
        VectorEnv("RustyGoal", render_mode="human")
    for count in (0, -1, 2**20 + 1):
        with pytest.raises(ValueError, match=f"num_envs {count}: there must be 1 to"):
            VectorEnv("RustyGoal", count)
    for env in (Env(), VectorEnv()):
        with pytest.raises(gym.error.ResetNeeded):
            env.step(np.zeros(env.action_space.shape))
    vec = VectorEnv("RustyGoal", 2)
    for mask in ([True, False], np.ones(2), np.ones(3, bool), np.zeros(2, bool)):
        with pytest.raises(ValueError, match="reset_mask"):
            vec.reset(options={"reset_mask": mask})


@pytest.mark.parametrize("task", TASKS)
def test_what_is_observed_lies_in_its_space_and_an_episode_ends_in_time(task):
    vec = VectorEnv(task, 32)
    vec.observation_space.seed(1)
    seen, _ = vec.reset(seed=100)
    assert seen in vec.observation_space
    longest, ages = 0, np.zeros(32, int)
    for step in range(TICKS[task] + 5):
        actions = drawn(32, step // 25)
        actions[::2] = 0.02 * actions[::2]
        seen, _, terminated, truncated, _ = vec.step(actions)
        assert seen in vec.observation_space
        ages += 1
        longest = max(longest, *(ages * truncated))
        ages[terminated | truncated] = -1
    assert longest == TICKS[task], "those that hardly move are cut off at the last tick"


def test_no_number_of_threads_changes_a_bit():
    def run():
        vec = VectorEnv("RustyGoal", 300)
        seen = [vec.reset(seed=1)[0]]
        for step in range(20):
            seen += vec.step(drawn(300, step))[:4]
        return b"".join(array.tobytes() for array in seen)

    try:
        ml.set_threads(1)
        alone = run()
        ml.set_threads(3)
        assert run() == alone
    finally:
        ml.set_threads(None)
