#!/usr/bin/env python3
"""barrier.py FILE...: checks proofs that there is no path, which `motion-lab plan --barrier FILE` wrote, by geometry of its own.

A barrier names shapes, a robot, a start and a goal, and cells: boxes of configurations. This program proves two things again. At the middle of
each cell the named part of the robot is deeper in the named obstacle than any of its points moves within the cell, so every configuration in
the cell is in contact. And when all cells are taken away, the start and the goal lie in different pieces of what is left, for a rover and a car
of the world's bounds, for an arm of the torus. So every curve from the one to the other meets a cell, and no path is free.

Numbers, shapes and robots are those of certificate.py, whose rules hold here: numbers are the doubles that the file's digits read as, computed
to 60 digits, and a claim is accepted because it is true in real numbers. SLACK is taken off every depth and every cell. The proof is about the
robot, the shapes and the bounds in the file: whether these are those of a world is for the reader to compare.

Exits with 0 when every file is accepted; with 1 when one is refused, and says why.
"""

import json
import sys
from decimal import ROUND_FLOOR, Decimal
from itertools import product
from math import prod

sys.dont_write_bytecode = True

from certificate import SLACK, TAU, Refused, cos_sin, from_origin, is_arm, length, number, parts, place, read, require, turn

PI = TAU / 2
# More boxes are not flooded: a file of the lab has a tenth of them.
BOXES = 4_000_000


# Depths. A core is a point, a segment or a convex polygon; a shape is all within its radius of its core. Let every point of the part move by at
# most d, a polygon as a rigid body, a segment staying one whose points are the same means of its ends. Two shapes stay in contact while their
# cores stay within the sum of the radii, which each of these proves for every d below it:
#
# - A point of the part's core lies in the obstacle's core, d below its depth in it plus the radii; or outside it, d below the radii less its
#   distance. For its distance from the obstacle's core, negative inside it, grows by at most d.
# - A point of the obstacle's core lies in or outside the part's core, for the same reason.
# - A side of the part's core crosses a side of the obstacle's core, d below the radii plus the least distance of an end of either from the other.
#   While the side moves straight from place to place they cross until an end of one meets the other, which takes that much of the movement; what
#   is left of it then moves the cores apart by at most as much.


def sides(core):
    """The sides of a core: a point's is the point, twice."""
    return [(core[i - 1], p) for i, p in enumerate(core)] if len(core) > 2 else [(core[0], core[-1])]


def gap(point, side):
    """The distance of a point from a segment."""
    return from_origin(*[(p[0] - point[0], p[1] - point[1]) for p in side])


def distance_out(point, core):
    """The distance of a point from a core, negative inside it: its depth there. A point with all sides on one hand lies within their hull."""
    edge = min(gap(point, side) for side in sides(core))
    turns = [turn(a, b, point) for a, b in sides(core)]
    inside = len(core) > 2 and (all(t > 0 for t in turns) or all(t < 0 for t in turns))
    return -edge if inside else edge


def along(side):
    """Some points of a segment."""
    (a, b), eighths = side, [Decimal(k) / 8 for k in range(9)]
    return [(a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])) for s in eighths]


def crossing(p, q):
    """Of two segments that cross, the least distance of an end of either from the other; nothing of others."""
    opposite = lambda u, v: turn(*u, v[0]) * turn(*u, v[1]) < 0
    return [min([gap(end, q) for end in p] + [gap(end, p) for end in q])] if opposite(p, q) and opposite(q, p) else []


def depths(part, radius, shape):
    """How far the points of a part may move while it stays in contact with a shape, by each proof that there is."""
    core, both = shape["core"], radius + shape["radius"] - SLACK
    yield from (both - distance_out(p, core) for side in sides(part) for p in along(side))
    yield from (both - distance_out(p, part) for side in sides(core) for p in along(side))
    yield from (both + c for ours in sides(part) for theirs in sides(core) for c in crossing(ours, theirs))


def bound(robot, part, half, core):
    """How far a point of a part moves from the middle of a cell to anywhere in it, at most.

    A rover moves as its centre does, a car's body as its rear axle does and about that. A point of link k is the base and a sum of vectors, one for
    each of the links 1 to k and no longer than it; the vector of link j turns by at most the sum of the half sides 1 to j. A vector of length L that
    turns by a moves its end by 2 L sin(a / 2) where a is at most half a turn, and never by more than 2 L.
    """
    chord = lambda a: 2 * (cos_sin(a / 2)[1] if a < PI else 1)
    if is_arm(robot):
        turned = [sum(half[: j + 1]) for j in range(part + 1)]
        return sum(ahead * chord(a) for ahead, a in zip(robot["lengths"], turned)) + SLACK
    turning = max(length(v) for v in core) * chord(half[2]) if robot["kind"] == "hitch" else 0
    return length(half[:2]) + turning + SLACK


def placed(robot, its_part, q):
    """The core of a part at a configuration; of a car's body the corners in their order."""
    core = [place(robot, vertex, q) for vertex in its_part]
    return core if len(core) < 4 else [core[i] for i in (0, 1, 3, 2)]


def blocked(barrier, cell, its_parts):
    """Checks that every configuration of a cell is in contact. Returns by how much."""
    robot, part = barrier["robot"], cell["part"]
    require(part in range(len(its_parts)), f"part {part} is none of the robot's")
    shapes = [s for s in barrier["world"]["obstacles"] if s["obstacle"] == cell["obstacle"] and s["name"] == cell["name"]]
    require(shapes, f"there is no obstacle {cell['obstacle']} called {cell['name']}")
    own = its_parts[int(part)]
    core, at_origin = placed(robot, own, cell["middle"]), placed(robot, own, [Decimal(0)] * len(cell["middle"]))
    radius = 0 if robot["kind"] == "hitch" else robot["radius"]
    proofs = (d for shape in shapes for d in depths(core, radius, shape))
    require(any(cell["depth"] <= d for d in proofs), f"the cell claims a depth of {float(cell['depth'])} m; less is proven")
    true_bound = bound(robot, int(part), cell["half"], at_origin)
    require(cell["bound"] >= true_bound, f"the cell claims a bound of {float(cell['bound'])} m; its points may move {float(true_bound)} m")
    require(cell["bound"] < cell["depth"], "the part may leave the obstacle within the cell")
    return cell["depth"] - true_bound


# Flooding. Along each axis the ends of the cells cut the range into pieces. A box of pieces, one of each axis, lies in a cell or holds no inner
# point of any. Cells are closed, so a curve that meets none goes from open box to open box through a side, or through a place about which all
# boxes are open: what it can get to is what sides join. The cells are shrunk by SLACK first, far more than angles are rounded.


class Axis:
    """The pieces of an axis, and those that each cell covers."""

    def __init__(self, low, high, wraps, arcs):
        self.low, self.high, self.wraps = low, high, wraps
        spans = [self.spans(a + SLACK, b - SLACK) for a, b in arcs]
        self.cuts = sorted({low, high} | {x for cell in spans for span in cell for x in span})
        number = {x: i for i, x in enumerate(self.cuts)}
        self.covered = [[i for a, b in cell for i in range(number[a], number[b])] for cell in spans]
        self.count = len(self.cuts) - 1

    def turned(self, x):
        """An angle within a turn from the lower end on."""
        return x - TAU * ((x - self.low) / TAU).to_integral_value(ROUND_FLOOR) if self.wraps else x

    def spans(self, a, b):
        """What an arc covers of the range, in one span or, over the end of a turn, in two."""
        if self.wraps and b - a >= TAU:
            return [(self.low, self.high)]
        a, b = self.turned(a), self.turned(a) + b - a
        spans = [(a, b), (a - TAU, b - TAU)] if self.wraps else [(a, b)]
        spans = [(max(a, self.low), min(b, self.high)) for a, b in spans]
        return [(a, b) for a, b in spans if a < b]

    def at(self, x):
        """The pieces in or at whose ends a place lies."""
        places = [self.turned(x) + turn for turn in ((-TAU, 0, TAU) if self.wraps else (0,))]
        return [i for i in range(self.count) for y in places if self.cuts[i] - SLACK <= y <= self.cuts[i + 1] + SLACK]

    def beside(self, i):
        return [j % self.count for j in (i - 1, i + 1) if self.wraps or 0 <= j < self.count]


def flooded(axes, closed, start):
    """The open boxes that a curve from the start can get to."""
    reached = {box for box in product(*[axis.at(x) for axis, x in zip(axes, start)])} - closed
    waiting = list(reached)
    while waiting:
        box = waiting.pop()
        for k, axis in enumerate(axes):
            for i in axis.beside(box[k]):
                other = box[:k] + (i,) + box[k + 1 :]
                if other not in closed and other not in reached:
                    reached.add(other)
                    waiting.append(other)
    return reached


def parted(barrier, ranges):
    """Checks that the cells part the start from the goal."""
    cells, ends = barrier["cells"], [barrier["start"], barrier["goal"]]
    arcs = lambda k: [(cell["middle"][k] - cell["half"][k], cell["middle"][k] + cell["half"][k]) for cell in cells]
    axes = [Axis(low, high, wraps, arcs(k)) for k, (low, high, wraps) in enumerate(ranges)]
    require(prod(axis.count for axis in axes) <= BOXES, "too many boxes to flood")
    for end, q in zip(("start", "goal"), ends):
        require(all(axis.low <= axis.turned(x) <= axis.high for axis, x in zip(axes, q)), f"the {end} lies outside the world's bounds")
        is_in = lambda cell: all(abs(axis.turned(x - m)) <= h for axis, x, m, h in zip(axes, q, cell["middle"], cell["half"]))
        held = [cell for cell in cells if is_in(cell)]
        require(not held, f"the {end} lies in a cell")
    closed = {box for n in range(len(cells)) for box in product(*[axis.covered[n] for axis in axes])}
    reached = flooded(axes, closed, ends[0])
    require(not reached.intersection(product(*[axis.at(x) for axis, x in zip(axes, ends[1])])), "the cells leave a way from the start to the goal")


def check(barrier):
    """The number of cells, and by how much the depth of the shallowest is beyond its bound. Raises Refused."""
    require(barrier["kind"] == "barrier" and barrier["version"] == 1, "this program reads barriers of version 1")
    robot, cells, bounds = barrier["robot"], barrier["cells"], barrier["world"]["bounds"]
    require(robot["kind"] in ("rusty", "reach", "hitch"), f"a robot of kind {robot['kind']}")
    require(robot.get("trailer") is None, "a car is proven without its trailer")
    sides_of_world = [(low, high, False) for low, high in zip(*bounds)]
    turns = len(robot["lengths"]) if is_arm(robot) else int(robot["kind"] == "hitch")
    ranges = ([] if is_arm(robot) else sides_of_world) + [(-PI, PI, True)] * turns
    lists = [barrier["axes"], barrier["start"], barrier["goal"]] + [cell[key] for cell in cells for key in ("middle", "half")]
    require(all(len(numbers) == len(ranges) for numbers in lists), "another number of coordinates than the robot has")
    names = [f"th{k + 1}" for k in range(turns)] if is_arm(robot) else ["x", "y", "theta"][: 2 + turns]
    require([axis["name"] for axis in barrier["axes"]] == names, "the axes are not the robot's, in their order")
    require(all(axis["wraps"] is wraps for axis, (_, _, wraps) in zip(barrier["axes"], ranges)), "angles wrap, and lengths do not")
    positive = [half for cell in cells for half in cell["half"]] + [high - low for low, high, _ in ranges] + robot.get("lengths", [])
    positive += [robot["body"][key] for key in ("length", "width")] if robot["kind"] == "hitch" else []
    require(all(x > 0 for x in positive), "a side, a link or the world has no length")
    require(robot.get("radius", 0) >= 0 and all(s["core"] and s["radius"] >= 0 for s in barrier["world"]["obstacles"]), "a shape is none")
    require(cells, "no cell: nothing is proven")
    its_parts = parts(robot)
    spare = min(blocked(barrier, cell, its_parts) for cell in cells)
    parted(barrier, ranges)
    return len(cells), spare


def checked(text):
    """As `check`, of a file's text, whatever that holds."""
    try:
        return check(json.loads(text, parse_float=number, parse_int=number, parse_constant=number))
    except (ArithmeticError, AttributeError, LookupError, RecursionError, TypeError, ValueError) as error:
        raise Refused(f"no barrier: {type(error).__name__}: {error}") from error


def main(files):
    refused = 0
    for file in files:
        try:
            cells, spare = checked(read(file))
            said = f"no path is proven by {cells} cells, each deeper than it moves by {float(spare)} m at least"
        except Refused as error:
            refused += 1
            said = f"REFUSED: {error}"
        print(f"{file}: {said}")
    return 1 if refused or not files else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
