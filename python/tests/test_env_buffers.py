"""What the environments are made of: every array is written where it is, or refused by its name, and nothing panics."""

import numpy as np
import pytest

import motion_lab as ml
from motion_lab._core import Episodes, Fleet


def arrays(count, width, **other):
    given = {
        "actions": np.zeros((count, 2), np.float32),
        "observations": np.zeros((count, width), np.float32),
        "rewards": np.zeros(count),
        "terminated": np.zeros(count, bool),
        "truncated": np.zeros(count, bool),
    }
    return given | other


def shifted(dtype, shape):
    """An array that starts one byte off."""
    size = int(np.prod(shape)) * np.dtype(dtype).itemsize
    return np.zeros(size + 1, np.uint8)[1:].view(dtype).reshape(shape)


def read_only(array):
    array.flags.writeable = False
    return array


@pytest.mark.parametrize(
    ("make", "count", "width"), [(lambda: Episodes("ReachPost", 4, "Disabled"), 4, 11), (lambda: Fleet(10, 1), 8, 363)]
)
def test_arrays_that_cannot_be_written_in_place_are_refused_by_name_and_nothing_is_stepped(make, count, width):
    made, untouched = make(), make()
    both = np.zeros(2 * count)
    wrong = [
        ({"actions": np.zeros((count, 2))}, "actions is no C-ordered array of float32"),
        ({"actions": np.zeros((2, count), np.float32).T}, "actions is no C-ordered array of float32"),
        ({"actions": np.zeros((count, 4), np.float32)[:, ::2]}, "actions is no C-ordered array"),
        ({"actions": np.zeros((count, 2), ">f4")}, "actions is no C-ordered array"),
        ({"actions": shifted(np.float32, (count, 2))}, "actions is no C-ordered array"),
        ({"actions": [[0.0, 0.0]] * count}, "actions is no C-ordered array"),
        ({"actions": None}, "actions is no C-ordered array"),
        ({"actions": np.zeros((count, 3), np.float32)}, f"{3 * count} numbers in actions, but {2 * count} are needed"),
        ({"observations": np.zeros((count, width))}, "observations is no C-ordered array of float32"),
        ({"observations": np.zeros((width, count), np.float32).T}, "observations is no C-ordered array of float32"),
        ({"observations": np.zeros((count, width - 1), np.float32)}, "places for observations, but"),
        ({"observations": read_only(np.zeros((count, width), np.float32))}, "observations is not writeable"),
        ({"rewards": np.zeros(count, np.float32)}, "rewards is no C-ordered array of float64"),
        ({"rewards": both[::2]}, "rewards is no C-ordered array of float64"),
        ({"rewards": np.zeros(count + 1)}, f"rewards has {count + 1} places for {count} episodes"),
        ({"terminated": np.zeros(count, np.uint8)}, "terminated is no C-ordered array of bool"),
        ({"terminated": np.zeros(count - 1, bool)}, f"terminated has {count - 1} places for {count} episodes"),
        ({"truncated": read_only(np.zeros(count, bool))}, "truncated is not writeable, or shares memory"),
    ]
    flags, numbers = np.zeros(count, bool), np.zeros((count, width), np.float32)
    wrong += [
        ({"terminated": flags, "truncated": flags}, "truncated is not writeable, or shares memory with another array"),
        ({"actions": numbers[:1, : 2 * count], "observations": numbers}, "observations .* shares memory with another"),
    ]
    for other, words in wrong:
        with pytest.raises(ValueError, match=words):
            made.step(**arrays(count, width, **other))
    given, same = arrays(count, width), arrays(count, width)
    assert made.step(**given) is untouched.step(**same) is False
    assert all(np.array_equal(given[name], same[name]) for name in given) and given["observations"].any()


def test_words_and_numbers_that_make_no_episodes_are_refused():
    for given, words in [
        (("Goal", 1, "NextStep"), 'no task is named "Goal": there are RustyGoal, HitchPark and ReachPost'),
        (("RustyGoal", 2**62, "NextStep"), "4611686018427387904 episodes: at most 1048576 go on together"),
        (("RustyGoal", 1, "later"), 'autoreset "later": it is NextStep, SameStep or Disabled'),
    ]:
        with pytest.raises(ml.Error, match=words):
            Episodes(*given)
    none = Episodes("ReachPost", 0, "NextStep")
    assert none.count == 0 and none.step(**arrays(0, 11)) is False and none.configurations().shape[0] == 0
    episodes = Episodes("ReachPost", 2, "SameStep")
    for seeds, mask, words in [([1], None, "1 seeds for 2"), ([1, 2], [True], "1 flags for 2")]:
        with pytest.raises(ValueError, match=words):
            episodes.begin(seeds, mask)
    for seeds in ([1, -1], [1, 2**64]):
        with pytest.raises(OverflowError):
            episodes.begin(seeds)
    assert episodes.final_observation(0) is None and episodes.final_observation(2**40) is None
    with pytest.raises(ml.Error, match="there is no episode 2; there are 2"):
        episodes.episode(2)


def test_configurations_are_those_of_the_runs():
    episodes = Episodes("HitchPark", 3, "NextStep")
    given = arrays(3, 10)
    given["actions"][:] = [[0.5, 0.3], [-0.5, 0.1], [0, 0]]
    for _ in range(5):
        episodes.step(**given)
    rows = episodes.configurations()
    assert rows.dtype == np.float64
    for index in range(3):
        last = episodes.episode(index).states("Hitch")[-1]
        assert rows[index, :3].tolist() == [last["x"], last["y"], last["theta"]]
