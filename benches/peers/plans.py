"""OMPL beside the lab's planners, on the same problems, its states judged by the lab's scene.

    PYTHON -m pip install WHEEL ompl==2.0.1
    PYTHON benches/peers/plans.py [--solutions N] [--write PAGE] [--csv FILE]

Every problem is planned by OMPL's RRT-Connect at several resolutions, and by the lab, seed by seed in turn, on one thread. What OMPL
calls an exact solution is then judged by the lab: along its straight legs by edges, along a car's Reeds-Shepp curves at states a
millimetre apart, which are OMPL's own. A hit is a proven contact.

OMPL asks through Python whether a state is free, which a program in C++ would not. So what it takes lies between two figures: the time of
its `solve`, and the time that the lab takes to judge as many states in a batch. Times are processor time.
"""

import argparse
import csv
import itertools
import math
import re
import statistics
import sys
import time
from collections import defaultdict
from dataclasses import dataclass, field

import motion_lab as ml
import numpy as np
from ompl import base as ob
from ompl import geometric as og
from ompl import util as ou

DEFAULT = 0.01  # OMPL's resolution, of the greatest extent of the space
EDGES = 0.0  # none: OMPL asks for whole motions, which the lab's edges judge
JUDGES = {DEFAULT: 1.0, 0.001: 1.0, 0.0001: 0.1, EDGES: 0.1}  # with the share of the solutions asked for
LONGEST = 20.0  # seconds of an attempt
STEP = 1e-3  # metres between the states at which a car's curve is judged
WHEELBASE, MAX_STEER = 2.5, 0.6  # of the lab's car: crates/core/src/configuration/sizes.rs
TURN = WHEELBASE / math.tan(MAX_STEER)
BEGIN, END = "<!-- table: begin -->", "<!-- table: end -->"


@dataclass
class Work:
    """Problems of one kind: pairs of a checker and its ends."""

    name: str
    planner: str  # the lab's
    problems: list[tuple[ml.Checker, tuple[float, ...], tuple[float, ...]]]


def generated(kind, count=10, **settings):
    """The first problems of a set that docs/formats.md describes, of those for which the lab finds a path."""
    number = 0
    while count:
        try:
            problem = ml.Problem.generate(kind, seed=1, number=number, **settings)
        except ml.Error:
            problem = None
        number += 1
        if problem and problem.has_path is not False:
            # of a rover the heading plans nothing
            robot = ml.Disc(problem.robot.radius) if isinstance(problem.robot, ml.Rusty) else problem.robot
            checker = ml.Checker(problem.world, robot)
            size = len(checker.coordinates)
            planner = "hybrid-a-star" if isinstance(robot, ml.Hitch) else "rrt-connect"
            if math.isfinite(lab_plan(planner, checker, problem.start[:size], problem.goal[:size], 0)):
                count -= 1
                yield checker, problem.start[:size], problem.goal[:size]


def works():
    post, office = ml.Checker("workbench", ml.Reach()), ml.Checker("apartment", ml.Disc(ml.Rusty().radius))
    rooms = [((1.5, 5.75), (9.75, 6.25)), ((1.5, 5.75), (10.5, 1.5)), ((6.0, 4.0), (1.5, 1.5)), ((10.5, 1.5), (1.5, 1.5))]
    return [
        Work("rover, Apartment, 4 pairs of rooms", "rrt-connect", [(office, *ends) for ends in rooms]),
        Work("rover, 10 worlds of 30 circles", "rrt-connect", list(generated("circles"))),
        Work("rover, 10 mazes of 8 by 8", "rrt-connect", list(generated("maze"))),
        Work("arm of 2 links round the post", "rrt-connect", [(post, (2.0, 0.0), (3.1, 0.0))]),
        Work("arm of 3 links, 10 worlds of 8 circles", "rrt-connect", list(generated("circles", robot="reach3"))),
        Work("car, 10 worlds of 30 circles", "hybrid-a-star", list(generated("circles", robot="hitch"))),
        Work("car, 10 bays of five", "hybrid-a-star", list(generated("parking"))),
    ]


class Edges(ob.MotionValidator):
    """The lab's edges as OMPL's judge of motions."""

    def __init__(self, bridge):
        super().__init__(bridge.information)
        self.bridge = bridge

    def checkMotion(self, start, end, *_):
        self.bridge.count += 1
        return bool(self.bridge.checker.edge_free(self.bridge.read(start), self.bridge.read(end)))


class Bridge:
    """A robot's space in OMPL, whose states the lab judges, and OMPL's planner there."""

    def __init__(self, checker, start, goal):
        self.checker, self.is_free, self.count = checker, checker.is_free, 0
        self.start, self.goal = start, goal
        self.size, angles = len(checker.coordinates), checker.angles
        self.is_car = isinstance(checker.robot, ml.Hitch)
        min_x, min_y, max_x, max_y = checker.world.bounds
        box = ob.RealVectorBounds(2)
        for axis, (low, high) in enumerate([(min_x, max_x), (min_y, max_y)]):
            box.setLow(axis, low)
            box.setHigh(axis, high)
        if self.is_car:
            self.space = ob.ReedsSheppStateSpace(TURN)
            self.space.setBounds(box)
        elif angles:
            self.space = ob.CompoundStateSpace()
            for _ in angles:
                self.space.addSubspace(ob.SO2StateSpace(), 1.0)
        else:
            self.space = ob.RealVectorStateSpace(2)
            self.space.setBounds(box)
        self.read = [self.read_point, self.read_angles, self.read_pose][bool(angles) + self.is_car]
        self.setup = og.SimpleSetup(self.space)
        self.setup.setStateValidityChecker(self.valid)
        self.information = self.setup.getSpaceInformation()
        self.setup.setStartAndGoalStates(self.state(self.start), self.state(self.goal))
        self.setup.setPlanner(og.RRTConnect(self.information))

    @staticmethod
    def read_point(state):
        return state[0], state[1]

    def read_angles(self, state):
        return tuple([state[i].value for i in range(self.size)])

    @staticmethod
    def read_pose(state):
        return state.getX(), state.getY(), state.getYaw()

    def valid(self, state):
        self.count += 1
        return self.is_free(self.read(state))

    def state(self, q):
        state = self.space.allocState()
        if self.is_car:
            state.setXY(q[0], q[1])
            state.setYaw(q[2])
        else:
            for i, coordinate in enumerate(q):
                if self.checker.angles:
                    state[i].value = coordinate
                else:
                    state[i] = coordinate
        return state

    def set_judge(self, judge):
        """A resolution; or the lab's edges, from then on."""
        if judge == EDGES:
            self.information.setMotionValidator(Edges(self))
        else:
            self.information.setStateValidityCheckingResolution(judge)
        self.setup.setup()

    def solve(self):
        """The configurations by which an exact solution is judged, or None; the seconds; and how often it asked."""
        self.setup.clear()
        self.count = 0
        begun = time.process_time()
        self.setup.solve(LONGEST)
        seconds = time.process_time() - begun
        q = None
        if self.setup.haveExactSolutionPath():
            # OMPL takes the states of a solution back, so that no name here may outlive it
            q = self.configurations(self.setup.getSolutionPath().getStates())
        return q, seconds, self.count

    def configurations(self, states):
        """What is judged: the corners of straight legs; of a car's curves states at most STEP apart."""
        if not self.is_car:
            return np.array([self.read(state) for state in states])
        poses, between = [], self.space.allocState()
        for a, b in itertools.pairwise(states):
            pieces = max(1, math.ceil(self.space.distance(a, b) / STEP))
            for i in range(pieces):
                self.space.interpolate(a, b, i / pieces, between)
                poses.append(self.read(between))
        return np.array([*poses, self.read(states[-1])])

    def hits(self, q):
        """Whether a proven contact lies on the way, and whether the way is proven free: None for a car, whose states alone are asked."""
        if self.is_car:
            return bool(self.checker.intersects(q).any()), None
        verdicts = self.checker.edge(q[:-1], q[1:]).verdict
        return bool((verdicts == ml.HIT).any()), bool((verdicts == ml.FREE).all())


def price(bridge, some=20_000):
    """Seconds that the lab takes to judge a state in a batch, about where the ends are."""
    ends = np.array([bridge.start, bridge.goal])
    low, high = ends.min(axis=0) - 1.0, ends.max(axis=0) + 1.0
    states = np.random.default_rng(1).uniform(low, high, (some, bridge.size))
    begun = time.process_time()
    bridge.is_free(states)
    return (time.process_time() - begun) / some


@dataclass
class Tally:
    """What came of one kind of problems at one resolution."""

    solved: int = 0
    unsolved: int = 0
    hits: int = 0
    free: int = 0
    seconds: list[float] = field(default_factory=list)
    judging: list[float] = field(default_factory=list)
    states: list[int] = field(default_factory=list)


def lab_plan(planner, checker, start, goal, seed):
    begun = time.process_time()
    try:
        ml.plan(checker, start, goal, planner=planner, seed=seed)
    except ml.NoPath:
        return math.inf
    return time.process_time() - begun


def race(work, solutions, rows):
    """Both sides in turn: the lab's seconds, and a tally of OMPL's for each resolution."""
    bridges = [Bridge(*problem) for problem in work.problems]
    prices = [price(bridge) for bridge in bridges]
    tallies, ours = {}, []
    for judge, share in JUDGES.items():
        if judge == EDGES and bridges[0].is_car:
            continue  # a car's curves are no edges
        tally = tallies[judge] = Tally()
        for bridge in bridges:
            bridge.set_judge(judge)
        wanted = math.ceil(solutions * share)
        for attempt in range(2 * wanted):
            if tally.solved == wanted:
                break
            number = attempt % len(bridges)
            bridge = bridges[number]
            q, seconds, asked = bridge.solve()
            mine = None
            # the lab does the same work again for the same seed, whatever OMPL's resolution
            if judge == DEFAULT and attempt < 100 * len(bridges):
                mine = lab_plan(work.planner, *work.problems[number], attempt // len(bridges))
                ours.append(mine)
            hit = free = None
            if q is None:
                tally.unsolved += 1
            else:
                hit, free = bridge.hits(q)
                tally.solved += 1
                tally.hits += hit
                tally.free += bool(free)
            tally.seconds.append(seconds)
            tally.judging.append(asked * prices[number])
            tally.states.append(asked)
            rows.append([work.name, number, judge, attempt, q is not None, seconds, asked, hit, free, mine])
    return ours, tallies


def in_ms(seconds):
    return f"{seconds * 1e3:#.3g}".rstrip(".") if math.isfinite(seconds) else "none"


def table(results):
    heads = "problems, resolution, exact solutions, hit something, states asked, `solve`, its states alone, the lab, times the lab"
    yield f"| {heads.replace(', ', ' | ')} |"
    yield "|---" * 9 + "|"
    for work, ours, tallies in results:
        lab = statistics.median(ours)
        for judge, tally in tallies.items():
            share = f"{tally.hits} ({100 * tally.hits / max(1, tally.solved):.3g} %)"
            solved = f"{tally.solved:,}" + (f" of {tally.solved + tally.unsolved:,}" if tally.unsolved else "")
            through, judging = (statistics.median(seconds) for seconds in (tally.seconds, tally.judging))
            cells = [
                work.name if judge == DEFAULT else "",
                named(judge),
                solved,
                share,
                f"{statistics.median(tally.states):,.0f}",
                in_ms(through),
                "" if judge == EDGES else in_ms(judging),
                in_ms(lab) if judge == DEFAULT else "",
                times(through / lab) if judge == EDGES else f"{times(judging / lab)} to {times(through / lab)}",
            ]
            yield f"| {' | '.join(cells)} |"


def times(ratio):
    """To two digits, and no power of ten."""
    return f"{float(f'{ratio:.2g}'):g}"


def named(judge):
    return "the lab's edges" if judge == EDGES else f"{100 * judge:g} %"


def totals(results):
    sums = defaultdict(lambda: [0, 0])
    for _, _, tallies in results:
        for judge, tally in tallies.items():
            sums[judge][0] += tally.solved
            sums[judge][1] += tally.hits
    for judge, (solved, hits) in sums.items():
        share = f"{hits:,} hit something ({100 * hits / solved:.3g} %)."
        yield f"- {named(judge)}: of {solved:,} exact solutions {share}"


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("--solutions", type=int, default=10_000, help="exact solutions of OMPL at its default, in all")
    ask.add_argument("--write", help="the page whose table is written anew")
    ask.add_argument("--csv", help="a row for each attempt")
    ask.add_argument("--only", default="", help="the problems with this in their name")
    asked = ask.parse_args()
    ml.set_threads(1)
    ou.setLogLevel(ou.LOG_ERROR)
    ou.RNG.setSeed(2005)
    chosen = [work for work in works() if asked.only in work.name]
    results, rows = [], []
    for work in chosen:
        results.append((work, *race(work, math.ceil(asked.solutions / len(chosen)), rows)))
        print("\n".join(list(table(results[-1:]))[2:]), file=sys.stderr, flush=True)
    text = "\n".join([*table(results), "", *totals(results)])
    print(text)
    if asked.csv:
        with open(asked.csv, "w", newline="") as file:
            out = csv.writer(file)
            out.writerow("problems problem resolution attempt solved seconds states hit free lab_seconds".split())
            out.writerows(rows)
    if asked.write:
        with open(asked.write) as file:
            page = file.read()
        with open(asked.write, "w") as file:
            file.write(re.sub(f"{BEGIN}.*{END}", lambda _: f"{BEGIN}\n{text}\n{END}", page, flags=re.DOTALL))


if __name__ == "__main__":
    main()
