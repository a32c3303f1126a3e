#!/usr/bin/env python3
"""decided.py LAB FOLDER COUNT [SEED [KIND...]]: planning problems whose answers are known by construction, COUNT of each kind of robot.

A rover among walls with gaps, arms of two and three links among posts, a car with and without a trailer before a wall with a gap: whether a
path exists follows from widths alone. Of each problem `motion-lab plan` is asked twice, for a proof by cells and for a path by another planner.
- Where there is no path, the cells say `none`, their barrier is accepted by barrier.py, and no other planner has a path within 100
  iterations. What has more boxes
  than barrier.py floods is counted as `too fine`.
- Where there is one, no barrier is written, and what is found is accepted by geometry of its own: straight legs by certificate.py, the obstacles
  being those that are generated here; a drive by following it, its boxes apart by more than they move from sample to sample.
- Undecided is only what is tighter than TIGHT says. In every eighth problem the bound on the length of a path is no longer than a path that
  is found, and there is none where there is no path.

Exits with 0 when all of that is so; prints for each kind the paths, barriers, what was undecided and how tight that was.
"""

import json
import math
import os
import random
import subprocess
import sys
from decimal import Decimal
from multiprocessing import Pool
from pathlib import Path

sys.dont_write_bytecode = True

import barrier
import certificate
from certificate import require

# By how much a passage is narrower than the robot (first) and wider (second) at most where cells decide nothing, metres.
TIGHT = {"rover": (0.1, 0.15), "arm": (0.1, 0.1), "arm3": (0.25, 0.25), "car": (0.35, 0.7), "trailer": (0.35, 0.7)}
# The share of problems with walls or posts so thin, or gaps so near the robot's width, that proofs need fine cells.
HARD = 0.1
# The rover, and the car: its boxes behind and ahead of the rear axle and to either side.
RADIUS, WIDTH, WHEELBASE, HITCH = 0.11, 1.7, 2.5, 2.0
BODY, TRAILER = (-0.7, 3.2, WIDTH / 2), (-2.8, -1.0, 0.75)


def box(name, low, high):
    corners = [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
    text = f'(name: "{name}", shape: Box(min: ({low[0]!r}, {low[1]!r}), max: ({high[0]!r}, {high[1]!r})))'
    return text, (corners, 0.0)


def walls(rng, size, gaps_of, thickness, first, last):
    """Walls across a yard from its lower to its upper end, and the widest gap of the one whose widest is least."""
    texts, shapes, least = [], [], math.inf
    count = len(gaps_of)
    for k, gaps in enumerate(gaps_of):
        left = first + (last - first) * (k + 0.5) / count - thickness / 2
        middles = [size[1] * (j + 0.5) / len(gaps) + rng.uniform(-0.1, 0.1) * size[1] / len(gaps) for j in range(len(gaps))]
        ends = [-5.0] + [y for m, g in zip(middles, gaps) for y in (m - g / 2, m + g / 2)] + [size[1] + 5.0]
        for j, (low, high) in enumerate(zip(ends[::2], ends[1::2])):
            text, shape = box(f"wall {k} {j}", (left, low), (left + thickness, high))
            texts.append(text)
            shapes.append(shape)
        # the gap as it is after rounding
        least = min(least, max(b - a for a, b in zip(ends[1::2], ends[2::2])))
    return texts, shapes, least


def yard(kind, rng):
    """A rover or a car before walls. The spare of its widest way is negative where there is none."""
    if kind == "rover":
        size, wide, thickness = (6.0, 4.0), 2 * RADIUS, rng.uniform(0.05, 0.4)
        gaps = [[wide * rng.uniform(0.2, 2.5) for _ in range(rng.randint(1, 3))] for _ in range(rng.randint(1, 3))]
        texts, shapes, least = walls(rng, size, gaps, thickness, 1.0, 5.0)
        ends = [(0.5, rng.uniform(0.5, 3.5)), (5.5, rng.uniform(0.5, 3.5))]
        robot = {"kind": "rusty", "radius": Decimal(RADIUS)}
        ends = [(*q, 0.0) for q in ends]
    else:
        size, wide, hard = (24.0, 10.0), WIDTH, rng.random() < HARD
        thickness = rng.uniform(0.5, 4.0) if hard else rng.uniform(5.0, 7.0)
        gap = rng.uniform(0.4, 3.4) if hard else rng.choice((rng.uniform(0.2, 0.6), rng.uniform(2.6, 4.0)))
        texts, shapes, least = walls(rng, size, [[gap]], thickness, 12.0, 14.0)
        trailer = (0.0,) if kind == "trailer" else ()
        ends = [(x, rng.uniform(3.5, 6.5), 0.0, *trailer) for x in (4.0, 20.0)]
        robot = {"kind": "hitch"}
    world = f'World(version: 1, name: "yard", bounds: (min: (0, 0), max: {size}), obstacles: [{", ".join(texts)}])'
    return {"world": world, "shapes": shapes, "robot": robot, "name": robot["kind"], "ends": ends, "spare": least - wide}


def arm(kind, rng):
    """An arm about whose base posts stand. A post that is nearer than the elbow ends the turns of the first link on either side of it; past one
    that is not the arm turns with its other links folded back."""
    lengths = [1.0, rng.uniform(0.2, 0.35)] + [rng.uniform(0.1, 0.2)] * (kind == "arm3")
    thick, hard = rng.uniform(0.02, 0.05), rng.random() < HARD
    count = rng.randint(1, 4 if hard else 3)
    turns = [2 * math.pi * (k + rng.uniform(-0.1, 0.1)) / count for k in range(count)]
    post = lambda turn: (turn, rng.uniform(0.06, 0.12), rng.uniform(0.45, 1.5)) if hard else (turn, rng.uniform(0.28, 0.33), rng.uniform(0.45, 0.6))
    posts = [post(turn) for turn in turns]
    at = [(far * math.cos(turn), far * math.sin(turn)) for turn, _, far in posts]
    texts = [f'(name: "post {k}", shape: Disc(center: ({x!r}, {y!r}), radius: {posts[k][1]!r}))' for k, (x, y) in enumerate(at)]
    reach = sum(lengths[1:]) + thick + 0.1

    def is_open(turn):
        """Whether the other links turn freely there, and the first is free."""
        elbow, clear = (math.cos(turn), math.sin(turn)), True
        for (x, y), (_, radius, _) in zip(at, posts):
            t = min(max(x * elbow[0] + y * elbow[1], 0.0), 1.0)
            clear &= math.hypot(x - t * elbow[0], y - t * elbow[1]) > radius + thick + 0.1
            clear &= math.hypot(x - elbow[0], y - elbow[1]) > radius + reach
        return clear

    free = [turn for turn in (rng.uniform(-3.1, 3.1) for _ in range(400)) if is_open(turn)]
    if len(free) < 2:
        return arm(kind, rng)
    ends = [free[0], free[1]]
    # by how much the elbow is clear of each post, and whether that stands between the ends
    spares = [far - radius - thick - lengths[0] for _, radius, far in posts]
    low, high = sorted(end % (2 * math.pi) for end in ends)
    sides = {True: [math.inf], False: [math.inf]}
    for spare, turn in zip(spares, turns):
        sides[low < turn % (2 * math.pi) < high].append(spare)
    spare = max(min(sides[True]), min(sides[False]))
    bends = lambda: [rng.uniform(-3.0, 3.0) for _ in lengths[1:]]
    size = max(far for _, _, far in posts) + 3.0
    resident = f'(name: "Arm", kind: "reach{"3" if kind == "arm3" else ""}", start: {[ends[0]] + [0.0] * (len(lengths) - 1)}'
    resident += f", arm: (base: (0, 0), lengths: {lengths}, radius: {thick!r}))"
    world = f'World(version: 1, name: "posts", bounds: (min: (-{size}, -{size}), max: ({size}, {size})), obstacles: [{", ".join(texts)}]'
    shapes = [([p], radius) for p, (_, radius, _) in zip(at, posts)]
    robot = {"kind": "reach", "base": [Decimal(0), Decimal(0)], "lengths": [Decimal(x) for x in lengths], "radius": Decimal(thick)}
    return {"world": world + f", robots: [{resident}])", "shapes": shapes, "robot": robot, "name": "Arm",
            "ends": [(end, *bends()) for end in ends], "spare": spare}


def certified(problem, path):
    """Checks each leg of a path of straight lines by certificate.py."""
    obstacles = [{"core": [tuple(map(Decimal, p)) for p in core], "radius": Decimal(radius)} for core, radius in problem["shapes"]]
    legs = json.loads(path, parse_float=certificate.number, parse_int=certificate.number, parse_constant=certificate.number)["legs"]
    flat = problem["robot"]["kind"] == "rusty"
    for leg in legs:
        along = {"kind": "chart line", **{end: (leg[end] + [Decimal(0)])[:3] if flat else leg[end] for end in ("from", "to")}}
        least = min(step[2] for step in leg["steps"])
        certificate.check({"version": 1, "robot": problem["robot"], "motion": along, "margin": Decimal(0), "steps": leg["steps"],
                           "world": {"obstacles": obstacles}, "proven_until": Decimal(1),
                           "verdict": {"edge": "free", "clearance": least}})
    joined([[float(x) for x in leg[end]] for leg in legs for end in ("from", "to")], problem, (1e-9,) * 3)


def joined(places, problem, reach):
    """Checks that legs, by their ends, lead from start to goal without a jump, and end off it by no more than this."""
    (start, goal), lengths = problem["ends"], 0 if problem["robot"]["kind"] == "reach" else 2
    require(near(places[0], start, (1e-9,) * 4, lengths) and near(places[-1], goal, reach, lengths), "the path leads elsewhere")
    require(all(near(a, b, (1e-9,) * 4, lengths) for a, b in zip(places[1::2], places[2::2])), "the path jumps")


def near(a, b, reach, lengths):
    """Whether two configurations differ by no more than this in each coordinate, of which the first `lengths` are lengths, the others angles."""
    off = [x - y if i < lengths else (x - y + math.pi) % (2 * math.pi) - math.pi for i, (x, y) in enumerate(zip(a, b))]
    return all(abs(d) <= r for d, r in zip(off, reach))


def boxes(q):
    """The corners of the car's body, and of its trailer."""
    def turned(heading, back, front, half):
        cos, sin = math.cos(heading), math.sin(heading)
        corners = ((back, -half), (front, -half), (front, half), (back, half))
        return [(q[0] + cos * x - sin * y, q[1] + sin * x + cos * y) for x, y in corners]

    yield turned(q[2], *BODY)
    if len(q) > 3:
        yield turned(q[3], *TRAILER)


def apart(a, b):
    """The widest gap between two boxes along a normal of either; their distance is no less."""
    widest = -math.inf
    for corners in (a, b):
        for (x, y), (u, v) in zip(corners, corners[1:] + corners[:1]):
            length = math.hypot(u - x, v - y)
            nx, ny = (v - y) / length, (x - u) / length
            spans = [[nx * px + ny * py for px, py in box] for box in (a, b)]
            widest = max(widest, min(spans[0]) - max(spans[1]), min(spans[1]) - max(spans[0]))
    return widest


def driven(problem, path):
    """Follows a drive, and checks that no box comes to a wall: at each place it is farther from all than it moves until the next."""
    legs = json.loads(path)["legs"]
    # as near as hybrid A* takes for the goal
    joined([leg[end] for leg in legs for end in ("from", "to")], problem, (0.1, 0.1, 0.05, 0.05))
    for leg in legs:
        control, at, left = leg["control"], list(leg["from"]), leg["control"]["seconds"]
        v, turning = control["v"], control["v"] * math.tan(control["phi"]) / WHEELBASE
        # no point of car or trailer is farther from the rear axle than six metres, nor does either turn faster than this
        rate = abs(v) + 6.0 * max(abs(turning), abs(v) / HITCH * (len(at) > 3))
        while left > 0:
            room = min(apart(ours, wall) for ours in boxes(at) for wall, _ in problem["shapes"])
            # a car's arc is exact, its trailer's heading is not
            dt = min(0.9 * room / rate, 0.01 if len(at) > 3 else 0.1, left)
            require(dt > 1e-6 or dt == left, f"a box comes to {room} m from a wall")
            drive(at, v, turning, dt)
            left = left - dt if left - dt > 1e-12 else 0
        require(near(at, leg["to"], (1e-5,) * 4, 2), "the controls lead elsewhere")


def drive(at, v, turning, dt):
    """Moves a car on its arc, and its trailer's heading by the rule of midpoints."""
    middle = at[2] + turning * dt / 2
    chord = v * dt if turning == 0 else 2 * v / turning * math.sin(turning * dt / 2)
    at[0] += chord * math.cos(middle)
    at[1] += chord * math.sin(middle)
    if len(at) > 3:
        slope = lambda psi, theta: v / HITCH * math.sin(theta - psi)
        half = at[3] + slope(at[3], at[2]) * dt / 2
        at[3] += slope(half, middle) * dt
    at[2] += turning * dt


def plan(lab, folder, problem, more):
    ask = [lab, "plan", "--world", str(folder / "world.ron"), "--robot", problem["name"], "--tube", "0", "--json"]
    ask += [f"--{end}=" + ",".join(repr(x) for x in q) for end, q in zip(("from", "to"), problem["ends"])]
    done = subprocess.run(ask + more, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    require(done.returncode in (0, 4, 7), f"exit code {done.returncode}: {done.stderr}")
    return json.loads(done.stdout.splitlines()[-1])


def one(task):
    """What became of a problem: its answer, how tight it was, and what is wrong."""
    lab, folder, kind, seed = task
    rng = random.Random(f"{kind} {seed}")
    problem = (arm if kind.startswith("arm") else yard)(kind, rng)
    folder = Path(folder) / str(os.getpid())
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "world.ron").write_text(problem["world"])
    written, path = folder / "barrier.json", folder / "path.json"
    for file in (written, path):
        file.unlink(missing_ok=True)
    spare, car = problem["spare"], kind in ("car", "trailer")
    try:
        cells = plan(lab, folder, problem, ["--planner", "cell-decomposition", "--barrier", str(written), "-o", str(path)])
        answer = cells["answer"]
        if "do not say how a car drives" in cells.get("reason", ""):
            answer = "joined"
        require(written.exists() == (answer == "none"), f"{answer}, and a barrier or none")
        if answer == "none":
            require(spare < 0, "no path is said, and there is one")
            try:
                barrier.checked(written.read_text())
            except certificate.Refused as error:
                # what it says of many thin cells, before it looks at any
                require("too many boxes to flood" in str(error), error)
                answer = "too fine"
        if answer == "path":
            require(spare > 0, "a path is said, and there is none")
            certified(problem, path.read_text())
        require(answer != "joined" or spare > 0, "cells join what is parted")
        low, high = TIGHT[kind]
        require(answer != "undecided" or -low < spare < high, "undecided, and not tight")
        few = ["--iterations", "100" if spare < 0 else "20000"]
        bound = ["--bound"] if seed % 8 == 0 else []
        other = plan(lab, folder, problem, ["-o", str(path), *bound, *few])
        require(other["answer"] != "none" or spare < 0, "the bound says that there is no path, and there is one")
        if other["answer"] == "path":
            require(spare > 0, "another planner has a path, and there is none")
            (driven if car else certified)(problem, path.read_text())
            require(not bound or other["length_bound"] <= other["length"], "a path is shorter than the bound")
        ratio = other["length"] / other["length_bound"] if bound and other["answer"] == "path" else None
        return kind, seed, answer, other["answer"], spare, ratio, None
    except (certificate.Refused, ArithmeticError, LookupError, TypeError, ValueError) as error:
        return kind, seed, "failed", "failed", spare, None, f"{type(error).__name__}: {error}"


def main(lab, folder, count, first=0, *kinds):
    kinds, failures = kinds or list(TIGHT), 0
    results = {kind: [] for kind in kinds}
    with Pool() as pool:
        tasks = [(lab, folder, kind, seed) for kind in kinds for seed in range(first, first + count)]
        for result in pool.imap_unordered(one, tasks, chunksize=1):
            results[result[0]].append(result)
            if result[-1]:
                failures += 1
                print(f"{result[0]} {result[1]}, spare {result[4]:.4f} m: {result[-1]}")
    for kind, rows in results.items():
        answers = [row[2] for row in rows]
        tight = [row[4] for row in rows if row[2] == "undecided"]
        found, ratios = [row for row in rows if row[3] == "path"], sorted(row[5] for row in rows if row[5])
        said = ", ".join(f"{answers.count(answer)} {answer}" for answer in ("path", "joined", "none", "too fine", "undecided"))
        missed = sum(row[3] != "path" and row[4] > 0 for row in rows)
        print(f"{kind}: {len(rows)} problems: {said}" + (f" (spare {min(tight):.3f} to {max(tight):.3f} m)" if tight else ""))
        print(f"    by another planner {len(found)} paths, {missed} open problems without; length over bound: median "
              f"{ratios[len(ratios) // 2] if ratios else math.nan:.3f}")
        for answer in ("none", "joined" if kind in ("car", "trailer") else "path"):
            if count >= 6 and answer not in answers:
                failures += 1
                print(f"{kind}: no problem with the answer {answer}")
    print(f"{sum(map(len, results.values()))} problems, {failures} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:5]), *sys.argv[5:]))
