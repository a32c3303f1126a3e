"""Forked and spawned workers, threads, and Ctrl+C."""

import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import textwrap
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import motion_lab as ml

N = 3000


def questions():
    return np.random.default_rng(7).uniform([0, 0], [12, 8], (N, 2))


def work(checker):
    """All that is parallel, in a worker."""
    q = questions()
    ranges = ml.scan(checker.world, np.column_stack([q, q[:, 0]])[:500], rays=8)
    return checker.distance(q), checker.edge_free(q[:-1], q[1:]), checker.witness(q).obstacle, ranges


def equal(found, expected):
    return all(np.array_equal(a, b) for a, b in zip(found, expected, strict=True))


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_workers_of_multiprocessing_answer_as_their_parent(method):
    if method not in multiprocessing.get_all_start_methods():
        pytest.skip("the system has no such processes")
    checker = ml.Checker("apartment", ml.Disc())
    # the parent has its threads before it forks
    expected = work(checker)
    with multiprocessing.get_context(method).Pool(2) as pool:
        for found in pool.map_async(work, [checker] * 3).get(timeout=60):
            assert equal(found, expected)
    assert equal(work(checker), expected), "the parent's own threads still work"


@pytest.mark.skipif(not hasattr(os, "fork"), reason="the system does not fork")
def test_a_child_of_a_child_answers_and_keeps_the_number_of_threads():
    code = """
        import os, sys
        import numpy as np, motion_lab as ml
        checker = ml.Checker("apartment", ml.Disc())
        q = np.random.default_rng(7).uniform([0, 0], [12, 8], (3000, 2))
        ml.set_threads(3)
        expected = checker.distance(q)
        def child(generations):
            process = os.fork()
            if process == 0:
                fine = ml.threads() == 3 and np.array_equal(checker.distance(q), expected)
                ml.set_threads(2)
                fine = fine and ml.threads() == 2 and np.array_equal(checker.distance(q), expected)
                ml.set_threads(3)
                fine = fine and (generations == 1 or child(generations - 1))
                os._exit(0 if fine else 1)
            return os.waitpid(process, 0)[1] == 0
        sys.exit(0 if child(2) else 1)
    """
    assert subprocess.run([sys.executable, "-c", textwrap.dedent(code)], timeout=60).returncode == 0


def test_no_answer_depends_on_the_number_of_threads():
    checker = ml.Checker("workbench", ml.Reach())
    q = np.random.default_rng(7).uniform(-4, 4, (N, 2))
    edges = []
    try:
        for n in [1, 2, 7, None]:
            ml.set_threads(n)
            assert n is None or ml.threads() == n
            edges.append(np.array(checker.edge(q[:-1], q[1:])))
    finally:
        ml.set_threads(None)
    for other in edges[1:]:
        np.testing.assert_array_equal(other, edges[0])
    for n in [0, -1, 1025]:
        with pytest.raises(ValueError, match=f"^{n} threads: there must be 1 to 1024$"):
            ml.set_threads(n)


def test_threads_share_a_checker():
    checker = ml.Checker("apartment", ml.Disc())
    expected = work(checker)
    with ThreadPoolExecutor(8) as pool:
        for found in pool.map(lambda _: work(checker), range(16)):
            assert equal(found, expected)


def test_two_calls_do_not_write_into_one_array():
    checker = ml.Checker("apartment", ml.Disc())
    q, out = np.tile(questions(), (200, 1)), np.zeros(200 * N)
    refused = []

    def ask():
        for _ in range(3):
            try:
                checker.distance(q, out=out)
            except ValueError as error:
                refused.append(str(error))

    threads = [threading.Thread(target=ask) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert refused and set(refused) == {"another call is using out"}
    np.testing.assert_array_equal(out, checker.distance(q))


def test_other_threads_run_while_a_call_of_a_thousand_rows_and_more_is_under_way():
    checker = ml.Checker("apartment", ml.Disc())
    q = np.tile(questions(), (300, 1))
    ticks, done = [], threading.Event()

    def count():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    begun = time.perf_counter()
    checker.edge_free(q[:-1], q[1:])
    ended = time.perf_counter()
    done.set()
    counter.join()
    during = [t for t in ticks if begun < t < ended]
    assert len(during) >= 3 or ended - begun < 0.02


@pytest.mark.skipif(not hasattr(signal, "SIGINT") or sys.platform == "win32", reason="the system sends no signals")
@pytest.mark.parametrize("name", ["distance", "edge_free", "edge", "swept", "scan", "grade"])
def test_ctrl_c_stops_a_call(name):
    code = f"""
        import os, signal, threading, time
        import numpy as np, motion_lab as ml
        ml.set_threads(1)
        checker = ml.Checker("lot", ml.Hitch(trailer=True))
        q = np.random.default_rng(7).uniform([0, 0, -3, -3], [16, 10, 3, 3], (2_000_000, 4))
        pressed = []
        def press():
            pressed.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)
        timer = threading.Timer(0.3, press)
        exam = ml.Assignment.parse(
            'Assignment(version: 1, world: "lot", robot: "Hitch", goal: (at: [7.5, 2.5, 0], within: [0, 0, 0]), '
            'limits: (ticks: 100000), seeds: "0..1000")'
        )
        asks = {{
            "grade": lambda: exam.grade([]),
            "scan": lambda: ml.scan("lot", np.ascontiguousarray(q[:400_000, :3]), rays=360),
            "distance": lambda: [checker.distance(q) for _ in range(50)],
            "edge": lambda: checker.edge(q[:-1], q[1:]),
            "edge_free": lambda: checker.edge_free(q[:-1], q[1:]),
            "swept": lambda: checker.swept(q[:-1], q[1:]),
        }}
        ask = asks["{name}"]
        timer.start()
        try:
            ask()
            print("it ended by itself")
        except KeyboardInterrupt:
            print(time.monotonic() - pressed[0])
    """

    def stopped_after():
        ran = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], timeout=120, capture_output=True, text=True)
        return float(ran.stdout or "inf")

    # a busy machine may be late once
    assert any(stopped_after() < 1.0 for _ in range(3))


def test_checkers_and_their_errors_are_pickled():
    checker = ml.Checker("lot", ml.Hitch(trailer=True, jackknife=1.2, length=4.5))
    again = pickle.loads(pickle.dumps(checker))
    assert (again.world, again.robot) == (checker.world, checker.robot)
    q = (3.0, 4.0, 0.5, 0.25)
    assert (again.distance(q), again.is_free(q)) == (checker.distance(q), checker.is_free(q))
    with pytest.raises(ml.ConfigurationError) as refused:
        checker.distance([(1.0, 2.0, 3.0, np.nan)])
    error = pickle.loads(pickle.dumps(refused.value))
    assert (type(error), str(error), error.row) == (ml.ConfigurationError, "q[0] is not finite", (0,))
