"""Whatever a call is given, it answers or raises an exception of Python: the library never panics."""

import itertools
import subprocess
import sys

import numpy as np
import pytest

import motion_lab as ml


class Raises:
    """An object whose every reading fails."""

    def __float__(self):
        raise RuntimeError("no float")

    def __index__(self):
        raise RuntimeError("no index")

    def __len__(self):
        raise RuntimeError("no length")

    def __iter__(self):
        raise RuntimeError("no items")

    def __array__(self, *args, **kwargs):
        raise RuntimeError("no array")


class Lies(list):
    """A list that is longer than it says."""

    def __len__(self):
        return 2


GARBAGE = [
    None, True, 0, -1, 1.5, float("nan"), float("inf"), 10**400, 2**63, -(2**63), 1j, "", "apartment", "\ud800", "\0",
    b"\xff", (), (1,), (1, 2), (1, 2, 3), (1, 2, 3, 4), (1, 2, 3, 4, 5), [1, [2]], [[1, 2], [3]], ("a", "b"),
    (None, None), (1, 10**400), [[], []], {}, {1: 2}, {1, 2}, object(), type, Raises(), Lies([1, 2, 3]), range(2),
    iter([1, 2]), lambda: 1, np, np.float64(1), np.zeros(()), np.zeros(0), np.zeros(2), np.zeros((2, 0)),
    np.zeros((0, 2)), np.zeros((3, 2)), np.zeros((3, 3)), np.zeros((3, 4)), np.full((3, 2), np.nan),
    np.full((3, 3), 1e308), np.full((3, 2), -1e308), np.full((2, 2), 5e-324), np.zeros((3, 2), object),
    np.zeros((3, 2), "U3"), np.zeros((3, 2), "f8,f8"), np.zeros((1,) * 30 + (2,)), np.zeros((3, 2), bool),
    np.zeros((3, 2), complex), np.zeros((2, 2, 2, 3)), np.broadcast_to(0.0, (3, 2)), np.zeros((4, 2))[::-2],
    memoryview(b"12"), np.ma.masked_array(np.zeros((3, 2))), ml.World("lot"), ml.World, ml.Disc(), ml.Disc, ml.FREE,
]  # fmt: skip

CHECKERS = [
    ml.Checker("lot", robot) for robot in (ml.Disc(), ml.Rusty(), ml.Reach(), ml.Hitch(trailer=True, jackknife=1.0))
]
OF_ONE = {
    "World": ml.World,
    "World.read": ml.World.read,
    "World.parse": ml.World.parse,
    "from_shapes": ml.World.from_shapes,
    "Disc": ml.Disc,
    "Rusty": ml.Rusty,
    "Reach": ml.Reach,
    "Hitch": ml.Hitch,
    "set_threads": lambda n: ml.set_threads(n if n not in (1, 2) else None),
    "scan": lambda poses: ml.scan("lot", poses, rays=2),
    "scan of a world": lambda world: ml.scan(world, (1, 2, 3), rays=2),
    "rays": lambda rays: ml.scan("lot", (1, 2, 3), rays),
    "range": lambda range_: ml.scan("lot", (1, 2, 3), 2, range_),
    "field of view": lambda angle: ml.scan("lot", (1, 2, 3), 2, field_of_view=angle),
    "jackknife": lambda angle: ml.Hitch(True, jackknife=angle),
    "base": lambda base: ml.Reach(base=base),
    "steps": lambda steps: ml.Certificate(CHECKERS[0], (1, 2), (3, 4), steps).verify(),
    "margin": lambda margin: ml.Certificate(CHECKERS[0], (1, 2), (3, 4), [(0, 1, 0)], margin).verify(),
    **{
        name: lambda x, name=name: ml.World.from_shapes(**{name: x})
        for name in ["segments", "boxes", "discs", "polygons", "bounds", "occupancy", "name"]
    },
    "resolution": lambda x: ml.World.from_shapes(occupancy=np.ones((2, 2), bool), resolution=x),
    "origin": lambda x: ml.World.from_shapes(occupancy=np.ones((2, 2), bool), resolution=1, origin=x),
    "is equal": lambda x: (ml.World("lot") == x, ml.Disc() == x),
    "write": lambda x: None if isinstance(x, (str, bytes, int)) else ml.World("lot").write(x),
}


def tried(call, *arguments):
    """Whether the call answered. A panic is a BaseException, and no Exception."""
    try:
        call(*arguments)
    except Exception:
        return False
    return True


@pytest.mark.parametrize("name", OF_ONE)
def test_a_function_of_one_argument_never_panics(name):
    answered = [tried(OF_ONE[name], garbage) for garbage in GARBAGE]
    assert not all(answered) or name == "is equal"


@pytest.mark.parametrize("name", ["distance", "intersects", "is_free", "witness"])
def test_a_question_about_anything_never_panics(name):
    for checker, q in itertools.product(CHECKERS, GARBAGE):
        tried(getattr(checker, name), q)
    assert tried(getattr(CHECKERS[0], name), np.zeros((3, 2)))


@pytest.mark.parametrize("name", ["edge", "edge_free", "swept", "certificate"])
def test_a_question_about_two_things_never_panics(name):
    for checker, a, b in itertools.product(CHECKERS, GARBAGE, GARBAGE):
        tried(getattr(checker, name), a, b)
    assert tried(getattr(CHECKERS[0], name), (1, 2), (1, 3))


def test_an_out_that_is_anything_never_panics():
    q = np.zeros((3, 2))
    for out in GARBAGE:
        tried(lambda out: CHECKERS[0].distance(q, out=out), out)
        tried(lambda out: CHECKERS[0].swept(q, q, out=out), out)
        tried(lambda out: ml.scan("lot", np.zeros((3, 3)), rays=2, out=out), out)


def test_a_checker_of_anything_never_panics():
    for world, robot in itertools.product(GARBAGE, GARBAGE):
        tried(ml.Checker, world, robot)
        tried(ml.Certificate, world, robot, (1, 2), np.zeros((1, 3)))


def test_more_answers_than_there_is_memory_are_a_memory_error():
    with pytest.raises(MemoryError):
        ml.scan("lot", np.zeros((2**21, 3)), rays=100_000)


def test_the_package_is_imported_without_numpy():
    code = "import sys, motion_lab as ml; ml.Checker('lot', ml.Disc()).distance((1, 2)); print('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "False\n"
