"""Environments in forked processes and on threads."""

import os
import sys
import threading
import time
import warnings

import numpy as np
import pytest
from gymnasium.vector import AsyncVectorEnv

from motion_lab.envs import Env, VectorEnv

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")


def steps(count):
    vec = VectorEnv("RustyGoal", count)
    seen = [vec.reset(seed=1)[0]]
    seen += [vec.step(np.full((count, 2), 0.5, np.float32))[0] for _ in range(3)]
    return b"".join(array.tobytes() for array in seen)


def in_a_fork(work, seconds=60):
    """What `work` returns in a forked child, or None if it does not end."""
    out, into = os.pipe()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child == 0:
        try:
            os.close(out)
            answer = work()
            with os.fdopen(into, "wb") as pipe:
                pipe.write(answer)
        finally:
            os._exit(0)
    os.close(into)
    said = bytearray()
    reader = threading.Thread(target=lambda: said.extend(os.fdopen(out, "rb").read()))
    reader.start()
    reader.join(seconds)
    if reader.is_alive():
        os.kill(child, 9)
        reader.join()
        said.clear()
    os.waitpid(child, 0)
    return bytes(said) or None


@pytest.mark.parametrize("count", [1, 300])
def test_a_forked_process_steps_as_its_parent_does(count):
    expected = steps(300)  # the parent's threads run
    if count == 1:
        expected = steps(1)
    assert in_a_fork(lambda: steps(count)) == expected


def test_gymnasium_s_processes_step_as_one_process_does():
    steps(300)
    vec, one = AsyncVectorEnv([lambda: Env("RustyGoal")] * 2, context="fork"), VectorEnv("RustyGoal", 2)
    try:
        seen, _ = vec.reset(seed=4)
        assert np.array_equal(seen, one.reset(seed=4)[0])
        for _ in range(5):
            actions = np.full((2, 2), 0.7, np.float32)
            theirs, ours = vec.step(actions), one.step(actions)
            assert all(np.array_equal(a, b) for a, b in zip(theirs[:4], ours[:4], strict=True))
    finally:
        vec.close(terminate=True)


def test_another_thread_runs_while_many_replicas_step():
    vec = VectorEnv("RustyGoal", 255)
    vec.reset(seed=1)
    actions = np.zeros((255, 2), np.float32)
    counted, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            time.sleep(1e-5)

    thread, interval = threading.Thread(target=count), sys.getswitchinterval()
    thread.start()
    try:
        # nobody is made to give up the lock now: the other thread counts only while a step has released it
        sys.setswitchinterval(60)
        before = counted[0]
        for _ in range(50):
            vec.step(actions)
        assert counted[0] - before > 20
    finally:
        sys.setswitchinterval(interval)
        stop.set()
        thread.join()


def test_two_threads_in_one_environment_are_told_apart():
    vec = VectorEnv("RustyGoal", 255)
    vec.reset(seed=1)
    actions, errors = np.zeros((255, 2), np.float32), []

    def run():
        for _ in range(60):
            try:
                vec.step(actions)
            except RuntimeError as error:
                errors.append(str(error))

    threads = [threading.Thread(target=run) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all("borrowed" in error for error in errors)
    vec.step(actions)
