"""Arrays of any layout: what is read is what the rows hold, whatever their dtype, order and strides."""

import numpy as np
import pytest

import motion_lab as ml

ROBOTS = {
    "disc": ("apartment", ml.Disc(), [0, 0], [12, 8]),
    "rusty": ("apartment", ml.Rusty(), [0, 0, -4], [12, 8, 4]),
    "reach": ("workbench", ml.Reach(), [-4, -4], [4, 4]),
    "reach of three": ("workbench", ml.Reach((0.6, 0.5, 0.4)), [-4, -4, -4], [4, 4, 4]),
    "hitch": ("lot", ml.Hitch(), [0, 0, -4], [16, 10, 4]),
    "hitch with trailer": ("lot", ml.Hitch(trailer=True, jackknife=1.3), [0, 0, -4, -4], [16, 10, 4, 4]),
}
N = 60


def strided(q):
    wide = np.full((len(q), 2 * q.shape[1] + 1), np.nan)
    wide[:, 1::2] = q
    return wide[:, 1::2]


def every_second(q):
    tall = np.full((2 * len(q), q.shape[1]), np.nan)
    tall[::2] = q
    return tall[::2]


def unaligned(q):
    packed = np.zeros(q.nbytes + 1, np.uint8)
    view = packed[1:].view(np.float64).reshape(q.shape)
    view[...] = q
    assert not view.flags.aligned
    return view


def read_only(q):
    q = q.copy()
    q.flags.writeable = False
    return q


class Subclass(np.ndarray):
    """An array that reads its items otherwise."""


class Table:
    """What other libraries' tables say of themselves: columns, in Fortran's order."""

    def __init__(self, q):
        self.columns = [column.copy() for column in q.T]

    def __array__(self, dtype=None, copy=None):
        return np.array(self.columns, dtype).T


LAYOUTS = {
    "C": lambda q: q,
    "Fortran": np.asfortranarray,
    "columns": lambda q: np.array([*q.T]).T,
    "strided": strided,
    "every second row": every_second,
    "reversed rows": lambda q: q[::-1].copy()[::-1],
    "reversed columns": lambda q: q[:, ::-1].copy()[:, ::-1],
    "big-endian": lambda q: q.astype(">f8"),
    "long double": lambda q: q.astype(np.longdouble),
    "unaligned": unaligned,
    "read-only": read_only,
    "subclass": lambda q: q.view(Subclass),
    "list of tuples": lambda q: [tuple(row) for row in q],
    "list of arrays": list,
    "table of another library": Table,
    "field of a structured array": lambda q: np.array(
        [(1, row) for row in q], [("before", "i1"), ("q", "f8", q.shape[1:])]
    )["q"],
}
# dtypes that hold other numbers: the expected answers are those of the numbers they hold
ROUNDED = {"float32": np.float32, "float16": np.float16, "int64": np.int64, "int8": np.int8, "bool": np.bool_}


def configurations(name, n=N, seed=5):
    world, robot, low, high = ROBOTS[name]
    return ml.Checker(world, robot), np.random.default_rng(seed).uniform(low, high, (n, len(low)))


def rows(answer, *arrays):
    """The answers one by one, each of a tuple of floats: the path that takes no array."""
    return [answer(*(tuple(map(float, row)) for row in each)) for each in zip(*arrays, strict=True)]


def same(array, one_by_one, dtype):
    assert array.dtype == dtype
    assert array.shape == np.shape(one_by_one)
    np.testing.assert_array_equal(array, one_by_one)


ONE = {"intersects": np.bool_, "distance": np.float64, "is_free": np.bool_}
TWO = {"swept": np.bool_, "edge_free": np.bool_}


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("robot", ROBOTS)
def test_answers_over_an_array_of_any_layout_are_those_of_its_rows(robot, layout):
    checker, q = configurations(robot)
    laid = LAYOUTS[layout](q)
    for name, dtype in ONE.items():
        same(getattr(checker, name)(laid), rows(getattr(checker, name), q), dtype)
    a, b = q[:-1], q[:-1] + 0.1 * (q[1:] - q[:-1])
    for name, dtype in TWO.items():
        expected = rows(getattr(checker, name), a, b)
        same(getattr(checker, name)(LAYOUTS[layout](a), LAYOUTS[layout](b)), expected, dtype)
    for field, expected in zip(checker.witness(laid), zip(*rows(checker.witness, q), strict=True), strict=True):
        np.testing.assert_array_equal(field, expected)
    for field, expected in zip(
        checker.edge(a, LAYOUTS[layout](b)), zip(*rows(checker.edge, a, b), strict=True), strict=True
    ):
        np.testing.assert_array_equal(field, expected)


@pytest.mark.parametrize("layout", LAYOUTS)
def test_scans_of_an_array_of_any_layout_are_those_of_its_rows(layout):
    _, poses = configurations("rusty", 20)
    expected = [ml.scan("apartment", tuple(map(float, pose)), rays=7) for pose in poses]
    same(ml.scan("apartment", LAYOUTS[layout](poses), rays=7), expected, np.float64)


@pytest.mark.parametrize("dtype", ROUNDED)
def test_numbers_of_another_dtype_are_taken_for_what_they_are(dtype):
    checker, q = configurations("disc")
    q = q.astype(ROUNDED[dtype])
    same(checker.distance(q), rows(checker.distance, q), np.float64)
    assert checker.distance(q[0]) == checker.distance(tuple(map(float, q[0])))


def test_leading_axes_are_the_answers_axes():
    checker, q = configurations("reach")
    for shape in [(3, 4, 5), (60, 1), (1, 60), (2, 1, 30, 1), (60,)]:
        cube = q.reshape(*shape, 2)
        assert checker.distance(cube).shape == shape
        np.testing.assert_array_equal(checker.distance(cube).ravel(), checker.distance(q))
        witness = checker.witness(cube)
        assert witness.distance.shape == witness.part.shape == witness.obstacle.shape == shape
        assert witness.on_robot.shape == witness.on_obstacle.shape == (*shape, 2)
        assert checker.edge(cube, cube).verdict.shape == shape
        assert ml.scan("workbench", np.zeros((*shape, 3)), rays=3).shape == (*shape, 3)


def test_one_configuration_is_answered_without_arrays():
    checker, q = configurations("disc")
    for one in [tuple(q[0].tolist()), q[0].tolist(), q[0], q[0].astype(">f8"), np.array([*q.T])[:, 0], list(q[0])]:
        assert type(checker.distance(one)) is float
        assert checker.distance(one) == checker.distance(q)[0]
        assert type(checker.intersects(one)) is bool
        assert type(checker.is_free(one)) is bool
        assert type(checker.swept(one, one)) is bool
        assert type(checker.edge_free(one, one)) is bool
        assert type(checker.witness(one).on_robot) is tuple
        assert checker.edge(one, one).verdict in ml.Verdict
    assert checker.distance((1, 2)) == checker.distance((1.0, 2.0))
    assert checker.distance((True, np.float32(2))) == checker.distance((1.0, 2.0))


def test_no_rows_have_no_answers():
    checker, _ = configurations("rusty")
    for shape in [(0,), (3, 0), (0, 5)]:
        none = np.zeros((*shape, 3))
        assert checker.distance(none).shape == checker.edge_free(none, none).shape == shape
        assert checker.witness(none).on_robot.shape == (*shape, 2)
        assert checker.edge(none, none).verdict.shape == shape
        assert ml.scan("lot", none, rays=4).shape == (*shape, 4)


@pytest.mark.parametrize(
    ("a", "b", "shape"),
    [
        ((7, 2), (2,), (7,)),
        ((2,), (7, 2), (7,)),
        ((7, 1, 2), (5, 2), (7, 5)),
        ((1, 2), (4, 3, 2), (4, 3)),
        ((0, 1, 2), (5, 2), (0, 5)),
    ],
)
def test_two_arrays_broadcast_along_their_leading_axes_as_numpy_broadcasts(a, b, shape):
    checker, q = configurations("disc", 100)
    a, b = q[: np.prod(a) // 2].reshape(a), q[-np.prod(b) // 2 :][: np.prod(b) // 2].reshape(b)
    wide = [np.broadcast_to(x, (*shape, 2)) for x in (a, b)]
    for name in ["edge_free", "swept"]:
        answers = getattr(checker, name)(a, b)
        assert answers.shape == shape
        expected = rows(getattr(checker, name), *(x.reshape(-1, 2) for x in wide))
        np.testing.assert_array_equal(answers.ravel(), np.array(expected, bool))
    for one, many in zip(checker.edge(a, b), checker.edge(*wide), strict=True):
        np.testing.assert_array_equal(one, many)


def test_a_broadcast_view_is_read_as_its_rows():
    checker, q = configurations("disc")
    wide = np.broadcast_to(q[3], (9, 2))
    np.testing.assert_array_equal(checker.distance(wide), [checker.distance(q[3])] * 9)


def test_overlapping_arrays_are_read_as_they_are():
    checker, q = configurations("disc")
    windows = np.lib.stride_tricks.sliding_window_view(q.ravel(), 2)
    np.testing.assert_array_equal(checker.distance(windows), checker.distance(windows.copy()))
    np.testing.assert_array_equal(checker.edge_free(q[:-1], q[1:]), checker.edge_free(q[:-1].copy(), q[1:].copy()))


def test_out_takes_the_answers_and_is_returned():
    checker, q = configurations("hitch")
    for name, dtype in ONE.items():
        out = np.full(N, 7).astype(dtype)
        assert getattr(checker, name)(np.asfortranarray(q), out=out) is out
        np.testing.assert_array_equal(out, getattr(checker, name)(q))
    for name in TWO:
        out = np.ones((N - 1, 2), bool)[:, 0].copy()
        assert getattr(checker, name)(q[:-1], q[1:], out=out) is out
        np.testing.assert_array_equal(out, getattr(checker, name)(q[:-1], q[1:]))
    ranges = np.zeros((N, 9))
    assert ml.scan("lot", q, rays=9, out=ranges) is ranges
    np.testing.assert_array_equal(ranges, ml.scan("lot", q, rays=9))
    # an answer to one configuration goes into an array without axes
    out = np.zeros(())
    assert checker.distance(q[0], out=out) is out
    assert out == checker.distance(q[0])
    # a row of a larger array of the caller's
    table = np.zeros((2, N))
    checker.distance(q, out=table[1])
    np.testing.assert_array_equal(table, [np.zeros(N), checker.distance(q)])


@pytest.mark.parametrize(
    ("out", "words"),
    [
        (np.zeros(9), "out has shape (9,), its answers have (10,)"),
        (np.zeros((10, 1)), "out has shape (10, 1), its answers have (10,)"),
        (np.zeros(10, np.float32), "out has dtype float32, its answers are float64"),
        (np.zeros(10, ">f8"), "out has dtype >f8, its answers are float64"),
        (np.zeros(10, int), "out has dtype int64, its answers are float64"),
        (np.zeros(20)[::2], "out is not C-ordered and aligned"),
        (np.zeros(10)[::-1], "out is not C-ordered and aligned"),
        (read_only(np.zeros(10)), "out is not writeable"),
        ([0.0] * 10, "out is no numpy array, but list"),
    ],
)
def test_an_out_that_does_not_fit_is_refused_and_left_alone(out, words):
    checker, q = configurations("disc", 10)
    before = np.array(out)
    with pytest.raises(ValueError) as refused:
        checker.distance(q, out=out)
    assert str(refused.value) == words
    np.testing.assert_array_equal(out, before)


def test_an_out_that_shares_memory_with_the_questions_is_refused():
    checker, q = configurations("disc", 10)
    buffer = np.zeros(40)
    buffer[:20] = q.ravel()
    questions = buffer[:20].reshape(10, 2)
    for out in [buffer[:10], buffer[10:20], buffer[19:29]]:
        for layout in [questions, questions[::-1], np.asfortranarray(questions).view()]:
            if np.shares_memory(layout, out):
                with pytest.raises(ValueError, match="^out shares memory with q$"):
                    checker.distance(layout, out=out)
    checker.distance(questions, out=buffer[20:30])
    np.testing.assert_array_equal(buffer[20:30], checker.distance(q))
    flags = np.zeros(160, np.uint8)
    a, b = np.zeros((10, 2)), flags.view(np.float64).reshape(10, 2)
    with pytest.raises(ValueError, match="^out shares memory with b$"):
        checker.edge_free(a, b, out=flags[:10].view(bool))


@pytest.mark.parametrize(
    ("q", "words"),
    [
        (np.zeros((5, 3)), "q has 3 coordinates, a Disc's configuration has 2: x, y"),
        (np.zeros((5, 1)), "q has 1 coordinate, a Disc's configuration has 2: x, y"),
        (np.zeros(3), "q has 3 coordinates, a Disc's configuration has 2: x, y"),
        ((1.0, 2.0, 3.0), "q has 3 coordinates, a Disc's configuration has 2: x, y"),
        ([], "q has 0 coordinates, a Disc's configuration has 2: x, y"),
        (np.zeros((2, 0)), "q has 0 coordinates, a Disc's configuration has 2: x, y"),
        (1.0, "q has no axis, a Disc's configuration has 2: x, y"),
        (np.array(1.0), "q has no axis, a Disc's configuration has 2: x, y"),
        (np.zeros((5, 2), complex), "q is no array of real numbers: its dtype is complex128"),
        ("ab", "q is no array of real numbers: its dtype is <U2"),
        (["1", "2"], "q is no array of real numbers: its dtype is <U1"),
        (None, "q is no array of real numbers: its dtype is object"),
        (np.zeros((5, 2), "M8[s]"), "q is no array of real numbers: its dtype is datetime64[s]"),
        (np.zeros(2, "f8,f8"), "q is no array of real numbers: its dtype is [('f0', '<f8'), ('f1', '<f8')]"),
        (
            np.ma.masked_array(np.zeros((5, 2)), mask=True),
            "q is a masked array: say with its filled() what stands for what is masked",
        ),
    ],
)
def test_what_is_no_array_of_configurations_is_refused_in_words(q, words):
    checker, _ = configurations("disc")
    for ask in [checker.distance, checker.intersects, checker.is_free, checker.witness]:
        with pytest.raises(ValueError) as refused:
            ask(q)
        assert str(refused.value) == words


def test_arrays_that_do_not_broadcast_are_refused():
    checker, q = configurations("disc")
    for ask in [checker.edge, checker.edge_free, checker.swept]:
        with pytest.raises(ValueError) as refused:
            ask(q[:3], q[:4])
        assert str(refused.value) == "a has shape (3, 2) and b (4, 2): their leading axes do not broadcast"
    with pytest.raises(ValueError, match="^q has 2 coordinates, a Hitch's configuration has 4: x, y, theta, psi$"):
        ml.Checker("lot", ml.Hitch(trailer=True)).distance((1.0, 2.0))


@pytest.mark.parametrize("number", [np.nan, np.inf, -np.inf])
def test_a_configuration_that_is_not_finite_is_named_by_its_row(number):
    checker, q = configurations("disc", 2000)
    for row in [0, 17, 1999]:
        bad = q.copy()
        bad[row, 1] = number
        for ask in [checker.distance, checker.intersects, checker.is_free, checker.witness]:
            with pytest.raises(ml.ConfigurationError) as refused:
                ask(bad)
            assert str(refused.value) == f"q[{row}] is not finite"
            assert (refused.value.name, refused.value.row) == ("q", (row,))
        for ask in [checker.edge, checker.edge_free, checker.swept]:
            with pytest.raises(ml.ConfigurationError, match=rf"^b\[{row}\] is not finite$"):
                ask(q, bad)
            with pytest.raises(ml.ConfigurationError, match=rf"^a\[{row}\] is not finite$"):
                ask(bad, q[0])
    with pytest.raises(ml.ConfigurationError, match=r"^q\[1, 0, 2\] is not finite$"):
        checker.distance(np.where(np.arange(60) == 35, number, 0.0).reshape(2, 5, 3, 2))
    for one in [(number, 1.0), [1.0, number], np.array([number, 1.0])]:
        with pytest.raises(ml.ConfigurationError) as refused:
            checker.distance(one)
        assert (str(refused.value), refused.value.row) == ("q is not finite", ())
    out = np.full(2000, 5.0)
    with pytest.raises(ml.ConfigurationError):
        checker.distance(bad, out=out)
    assert (out == 5.0).all(), "nothing is written then"
    with pytest.raises(ml.ConfigurationError, match=r"^poses\[1\] is not finite$"):
        ml.scan("lot", [(1, 2, 3), (1, 2, number)])


def test_a_number_that_no_float_holds_is_refused_or_rounded_as_numpy_does():
    checker, _ = configurations("disc")
    assert checker.distance((2**53 + 1, 0)) == checker.distance((float(2**53), 0.0))
    with pytest.raises(ValueError):
        checker.distance((10**400, 0))
