"""A step costs little more than the scans in it: CPU time of one thread, the best of alternating rounds."""

import time

import numpy as np
import pytest

import motion_lab as ml
from motion_lab.envs import VectorEnv

# a step's command, tick with contact and slip, scan, observation, reward and autoreset, from Python into fresh arrays
MOST = 2.0


def cost_over_scans(count, steps, rounds=7):
    vec = VectorEnv("RustyGoal", count)
    vec.reset(seed=1)
    world, draws, ranges = ml.World("apartment"), np.random.default_rng(1), np.empty((count, 360))
    stepped, scanned = [], []
    for _ in range(rounds):
        actions = np.stack([np.ones(count), draws.uniform(-0.5, 0.5, count)], axis=1).astype(np.float32)
        begun = time.process_time()
        for _ in range(steps):
            vec.step(actions)
        stepped.append(time.process_time() - begun)
        poses = vec.configurations()
        begun = time.process_time()
        for _ in range(steps):
            ml.scan(world, poses, rays=360, range=4.0, out=ranges)
        scanned.append(time.process_time() - begun)
    return min(stepped) / min(scanned), count * steps / min(stepped)


@pytest.mark.parametrize(("count", "steps"), [(64, 320), (1024, 20)])
def test_a_step_costs_at_most_twice_the_bare_scans_of_the_same_poses(count, steps, capsys):
    try:
        ml.set_threads(1)
        ratio, rate = cost_over_scans(count, steps)
        ratio = min(ratio, cost_over_scans(count, steps)[0]) if ratio > MOST else ratio
    finally:
        ml.set_threads(None)
    with capsys.disabled():
        print(f"\n{count} replicas: {rate / 1000:.0f} k steps/s, {ratio:.2f} times the scans")
    assert ratio <= MOST
