"""A rover learns to drive to goals by its lidar, with numpy alone: evolution strategies over a small network.

    python learn.py [--generations 100] [--out .]

Every generation tries 512 changes of the network's weights and their opposites, each for 300 ticks in an episode of its
own, and moves the weights toward the changes that earned more (Salimans et al., 2017, "Evolution strategies as a
scalable alternative to reinforcement learning"). One call steps all 1,024 rovers. A hundred generations take
about 160 s of CPU time; before them the network reaches none of the goals, after them nearly half.

Afterwards the network is asked about 256 episodes that it never saw. One whose goal it reaches now and did not reach
before is written twice, as a picture (`before.svg`, `after.svg`) and as a log that verifies: `motion-lab verify
after.mcap`.
"""

import argparse
import pathlib
import time

import numpy as np

from motion_lab.envs import VectorEnv

PAIRS, TICKS, HIDDEN, SECTORS = 512, 300, 16, 24
HELD_OUT = 1_000_000  # the seeds from here on are for tests
INPUTS = SECTORS + 3
SIZES = [(HIDDEN, INPUTS + 1), (2, HIDDEN + 1)]
COUNT = sum(rows * columns for rows, columns in SIZES)


def inputs(seen):
    """What the network sees: how near the nearest thing is in each of 24 sectors, and where the goal is."""
    rays = seen[:, :360].reshape(len(seen), 3 * SECTORS, 5)
    fifths = np.minimum.reduce([rays[:, :, k] for k in range(5)])
    sectors = 1 - np.minimum.reduce([fifths[:, k::3] for k in range(3)])
    return np.concatenate([sectors, seen[:, 360:], np.ones((len(seen), 1), np.float32)], axis=1)


def act(weights, seen):
    """The actions of networks, one for each row of `weights` and of `seen`."""
    first, second = np.split(weights, [SIZES[0][0] * SIZES[0][1]], axis=-1)
    x = inputs(seen)[:, :, None]
    x = np.tanh(first.reshape(-1, *SIZES[0]) @ x)
    return np.tanh(second.reshape(-1, *SIZES[1]) @ np.pad(x, ((0, 0), (0, 1), (0, 0)), constant_values=1))[:, :, 0]


def earned(vec, weights, seeds, ticks):
    """What networks earn in so many ticks, in one episode after the other."""
    seen, _ = vec.reset(seed=seeds)
    total = np.zeros(len(weights))
    for _ in range(ticks):
        seen, rewards, *_ = vec.step(act(weights, seen))
        total += rewards
    return total


def success(weights, count=256):
    """Which of the held-out episodes one network does what it was to do in."""
    vec = VectorEnv("RustyGoal", count, copy=False)
    seen, _ = vec.reset(seed=HELD_OUT)
    over, reached = np.zeros(count, bool), np.zeros(count, bool)
    for _ in range(600):
        seen, _, terminated, truncated, info = vec.step(act(weights[None], seen))
        ended = (terminated | truncated) & ~over
        if ended.any():
            reached |= ended & info["is_success"]
            over |= ended
    return reached


def learn(generations):
    """Weights before and after."""
    draws = np.random.default_rng(1)
    weights = draws.normal(0, 0.1, COUNT).astype(np.float32)
    first = weights.copy()
    vec = VectorEnv("RustyGoal", 2 * PAIRS, copy=False)
    mean, square, sigma, rate = np.zeros(COUNT), np.zeros(COUNT), 0.1, 0.05
    begun = time.monotonic()
    for generation in range(1, generations + 1):
        noise = draws.normal(size=(PAIRS, COUNT)).astype(np.float32)
        # a change and its opposite go through the same episodes
        seeds = np.tile(np.arange(PAIRS) + PAIRS * generation, 2) % HELD_OUT
        total = earned(vec, weights + sigma * np.concatenate([noise, -noise]), seeds, TICKS)
        ranks = total.argsort().argsort() / (2 * PAIRS - 1) - 0.5
        slope = (ranks[:PAIRS] - ranks[PAIRS:]) @ noise / PAIRS
        # Adam (Kingma and Ba, 2015)
        mean = 0.9 * mean + 0.1 * slope
        square = 0.99 * square + 0.01 * slope**2
        step = (mean / (1 - 0.9**generation)) / (np.sqrt(square / (1 - 0.99**generation)) + 1e-8)
        weights = (weights + rate * step).astype(np.float32)
        if generation % 10 == 0:
            print(
                f"generation {generation:3}, {time.monotonic() - begun:5.1f} s: {total.mean():+.2f} in 15 s", flush=True
            )
    return first, weights


def points(rows):
    return " ".join(f"{x:.3f},{y:.3f}" for x, y in rows)


def picture(run, goal):
    """The way of a run from its start to where it ended, and its goal, as SVG."""
    (world,), parts = run.worlds, []
    for shape in (shape for obstacle in world.obstacles for shape in obstacle.shapes):
        if len(shape.vertices) == 1:
            (x, y), radius = shape.vertices[0], shape.radius
            parts.append(f'<circle cx="{x}" cy="{y}" r="{radius}" fill="#d8d4c8" stroke="#4a4338"/>')
        else:
            parts.append(f'<polygon points="{points(shape.vertices)}" fill="#d8d4c8" stroke="#4a4338"/>')
    # at tick 0 the rover stands where it lives; the episode puts it at its start before tick 1
    way = run.states("Rusty")[1:]
    way = np.stack([way["x"], way["y"]], axis=1)
    parts.append(f'<circle cx="{goal[0]:.3f}" cy="{goal[1]:.3f}" r="0.25" fill="none" stroke="#2e8b57"/>')
    parts.append(f'<polyline points="{points(way)}" fill="none" stroke="#7a6fd0"/>')
    for (x, y), fill in ((way[0], "none"), (way[-1], "#0b4caf")):
        parts.append(f'<circle cx="{x:.3f}" cy="{y:.3f}" r="0.11" fill="{fill}" stroke="#0b4caf"/>')
    left, low, right, high = world.bounds
    width, height = 70 * (right - left), 70 * (high - low)
    frame = f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}">'
    place = f'<g transform="matrix(70 0 0 -70 {-70 * left} {70 * high})" stroke-width="0.03">'
    return "\n".join([frame, place, *parts, "</g>", "</svg>", ""])


def show(weights, seed, name, folder):
    """Drive one episode, and write its log and its picture."""
    vec = VectorEnv("RustyGoal")
    seen, _ = vec.reset(seed=seed)
    x, y, heading = vec.configurations()[0]
    distance, bearing = 4 * seen[0, 360], heading + np.arctan2(seen[0, 362], seen[0, 361])
    goal = x + distance * np.cos(bearing), y + distance * np.sin(bearing)
    for _ in range(600):
        seen, _, terminated, truncated, _ = vec.step(act(weights[None], seen))
        if terminated[0] or truncated[0]:
            break
    run = vec.episode(0)
    run.write(folder / f"{name}.mcap")
    (folder / f"{name}.svg").write_text(picture(run, goal))
    print(f"{name}.mcap: {run.ticks} ticks, {4 * seen[0, 360]:.2f} m from the goal; {run.verify()}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--generations", type=int, default=100)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path())
    arguments = parser.parse_args()
    before, after = learn(arguments.generations)
    then, now = success(before), success(after)
    print(f"goals reached in {len(then)} episodes that it never saw: {then.mean():.1%} before, {now.mean():.1%} after")
    gained = np.flatnonzero(now & ~then)
    seed = HELD_OUT + int(gained[0] if len(gained) else 0)
    arguments.out.mkdir(parents=True, exist_ok=True)
    show(before, seed, "before", arguments.out)
    show(after, seed, "after", arguments.out)


if __name__ == "__main__":
    main()
