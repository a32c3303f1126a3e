"""What a step of the environment RustyGoal takes, beside the bare scans of the same poses and beside ir-sim and navground.

    PYTHON -m pip install WHEEL gymnasium -r benches/peers/requirements.txt; PYTHON benches/peers/steps.py

All in one run: rounds in turn, CPU time of one thread, of each the least. The peers drive one rover with the same sensor
through the same walls; the Apartment's disc is left out for them.
"""

import sys
import time

import numpy as np

import measure
import motion_lab as ml
from motion_lab.envs import Env, VectorEnv

ROUNDS, REACH, DT, RADIUS = 7, 4.0, 0.05, 0.11
TICKS = 100


def timed(work):
    begun = time.process_time()
    work()
    return time.process_time() - begun


def ours(count, copy):
    """Seconds of a replica's step, and of a scan at the poses where the steps ended."""
    steps = max(20_480 // count, 1)
    vec, draws, ranges = VectorEnv("RustyGoal", count, copy=copy), np.random.default_rng(1), np.empty((count, 360))
    vec.reset(seed=1)
    world, times = ml.World("apartment"), []
    for _ in range(ROUNDS):
        actions = np.stack([np.ones(count), draws.uniform(-0.5, 0.5, count)], axis=1).astype(np.float32)
        stepped = timed(lambda: [vec.step(actions) for _ in range(steps)])
        poses = vec.configurations()
        scanned = timed(lambda: [ml.scan(world, poses, rays=360, range=REACH, out=ranges) for _ in range(steps)])
        times.append((stepped, scanned))
    return [min(column) / (steps * count) for column in zip(*times)]


def single():
    """Seconds of a step of the environment alone."""
    env, action = Env("RustyGoal"), np.array([1.0, 0.1], np.float32)
    env.reset(seed=1)

    def steps():
        for _ in range(1_000):
            if any(env.step(action)[2:4]):
                env.reset()

    return min(timed(steps) for _ in range(ROUNDS)) / 1_000


def segments(world):
    for obstacle in world.obstacles:
        for shape in obstacle.shapes:
            corners = shape.vertices.tolist()
            yield from zip(corners, corners[1:] + corners[:1] if len(corners) > 2 else corners[1:])


def peer(name):
    """Seconds of a step of a peer, without what it takes to make its world; None where it is not installed."""

    def minute(ticks):
        task = object.__new__(measure.Task)
        task.kind, task.settings = "minute", [REACH, DT, RADIUS]
        task.obstacles = [[0, *a, *b] for a, b in segments(ml.World("apartment"))]
        task.cases = [[6.0, 4.0, 0.0, *[0.2, 0.3] * ticks]]
        drive = measure.PEERS[name](task)
        return min(timed(lambda: drive(0)) for _ in range(5))

    try:
        return (minute(TICKS) - minute(0)) / TICKS
    except ImportError as missing:
        return print(f"{name} is left out: {missing}", file=sys.stderr)


def main():
    ml.set_threads(1)
    rows = {
        f"VectorEnv of {count}, {'fresh' if copy else 'same'} arrays": ours(count, copy)
        for count in (1, 64, 1024)
        for copy in (True, False)
    }
    for what, (step, scan) in rows.items():
        print(f"{what}: {1e-3 / step:.0f} k steps/s, {step / scan:.2f} times the scans")
    alone = single()
    print(f"Env: {1e-3 / alone:.0f} k steps/s")
    for name in ("ir-sim", "navground"):
        if step := peer(name):
            best = rows["VectorEnv of 1024, fresh arrays"][0]
            print(
                f"{name}: {1e-3 / step:.3f} k steps/s, {step / best:.0f} times a step of 1,024 replicas, {step / alone:.0f} times one of an Env"
            )


if __name__ == "__main__":
    main()
