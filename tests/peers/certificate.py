#!/usr/bin/env python3
"""certificate.py FILE...: checks proofs that `motion-lab query edge --certificate FILE` wrote, by geometry of its own.

A certificate names shapes, a robot, a motion over s in [0, 1], and steps [from, to, clearance]. This program proves each step again: from `from`
to `to` the robot keeps at least `clearance` metres from every shape. It uses Python's standard library and nothing of the lab's.

Numbers are the doubles that the file's digits read as, and are computed to 60 digits. SLACK is taken off every distance and is far more than
all rounding here. So a claim is accepted because it is true of the motion in real numbers, never because it is nearly true. The proof is about
the shapes in the file: whether these are those of a world is for the reader to compare.

Exits with 0 when every file is accepted, and says how far each is proven; with 1 when one is refused, and says why.
"""

import json
import math
import sys
from decimal import Decimal, getcontext
from functools import lru_cache

getcontext().prec = 60
SLACK = Decimal("1e-30")
# Greatest size of a number in a certificate; worlds end at 1e4 m.
LARGEST = Decimal("1e6")
TAU = 2 * Decimal("3.14159265358979323846264338327950288419716939937510582097494")
# What is left at a contact, per metre of the largest coordinate, at most: the lab rounds its shapes to doubles.
CONTACT = Decimal(2) ** -46


class Refused(Exception):
    """Why a certificate is not accepted."""


def require(holds, what):
    if not holds:
        raise Refused(what)


def number(text):
    value = Decimal(float(text))
    require(abs(value) <= LARGEST, f"the number {text}")
    return value


# Every point of a part's core is a mean, with fixed weights, of the part's vertices. A vertex is the robot's origin, which moves in a straight
# line, and a sum of vectors, each turned by the sum of some of the configuration's coordinates: [(numbers of the coordinates, vector)].


def is_arm(robot):
    return robot["kind"] == "reach"


def parts(robot):
    """The vertices of each part."""
    if robot["kind"] == "rusty":
        return [[[]]]
    if is_arm(robot):
        joints = [[]]
        for k, ahead in enumerate(robot["lengths"]):
            joints.append(joints[-1] + [(range(k + 1), (ahead, Decimal(0)))])
        return [list(link) for link in zip(joints, joints[1:])]
    require(robot["kind"] == "hitch", f"a robot of kind {robot['kind']}")
    box = lambda angle, back, front, width: [[((angle,), (x, y))] for x in (back, front) for y in (-width / 2, width / 2)]
    body, trailer = robot["body"], robot["trailer"]
    boxes = [box(2, -body["rear_overhang"], body["length"] - body["rear_overhang"], body["width"])]
    if trailer is not None:
        axle = -trailer["hitch_len"]
        boxes.append(box(3, axle - trailer["rear_overhang"], axle + trailer["front_overhang"], trailer["width"]))
    return boxes


def place(robot, vertex, q):
    x, y = robot["base"] if is_arm(robot) else q[:2]
    for angles, (ahead, left) in vertex:
        cos, sin = cos_sin(sum(q[i] for i in angles))
        x, y = x + cos * ahead - sin * left, y + sin * ahead + cos * left
    return x, y


@lru_cache(maxsize=64)
def cos_sin(angle):
    """The power series of exp(i angle), whole turns taken off."""
    angle -= TAU * (angle / TAU).to_integral_value()
    term, sums = Decimal(1), [Decimal(1), Decimal(0)]
    for n in range(1, 80):
        term *= angle / n
        sums[n % 2] += -term if n % 4 > 1 else term
    return sums


def bend(vertex, by):
    """A bound on the vertex's second derivative. q(s) = from + s by, so each vector v turns at a constant rate w, and its second derivative is
    -w^2 v; that of the origin is 0."""
    return sum(length(v) * sum(by[i] for i in angles) ** 2 for angles, v in vertex)


def way(start, end, is_angle):
    """What is added to a coordinate from s = 0 to 1: for an angle the short way round; what doubles see as half a turn goes the positive way."""
    if not is_angle:
        return end - start
    require(abs(start) <= math.pi and abs(end) <= math.pi, "an angle beyond pi")
    seen = float(end) - float(start)
    return end - start + (TAU if seen <= -math.pi else -TAU if seen > math.pi else 0)


def length(v):
    return (v[0] * v[0] + v[1] * v[1]).sqrt()


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def distance(a, b):
    """The distance between the convex hulls of two lists of points: that of the origin from the hull of all their differences."""
    points = sorted({(p[0] - q[0], p[1] - q[1]) for p in a for q in b})
    corners = half_hull(points) + half_hull(points[::-1]) or points
    sides = list(zip(corners, corners[1:] + corners[:1]))
    inside = len(corners) > 2 and all(turn(p, q, (0, 0)) >= 0 for p, q in sides)
    return Decimal(0) if inside else min(from_origin(p, q) for p, q in sides)


def half_hull(points):
    """The corners on one side of the hull of sorted points, but for the last."""
    corners = []
    for p in points:
        while len(corners) > 1 and turn(corners[-2], corners[-1], p) <= 0:
            corners.pop()
        corners.append(p)
    return corners[:-1]


def from_origin(p, q):
    """The distance of the origin from the segment."""
    u = (q[0] - p[0], q[1] - p[1])
    square = u[0] * u[0] + u[1] * u[1]
    t = min(max(-(p[0] * u[0] + p[1] * u[1]) / square, Decimal(0)), Decimal(1)) if square else Decimal(0)
    return length((p[0] + t * u[0], p[1] + t * u[1]))


def span(points):
    return [(min(c), max(c)) for c in zip(*points)]


def proven(robot, motion, shapes, start, end):
    """A lower bound of the clearance from s = start to s = end, metres.

    Let h = end - start, and f(s) be a core point's place less the point of the chord between its places at the two ends. f is 0 at both, and
    |f''| <= A, the greatest bend of the part's vertices. Where |f| is greatest, at m, the derivative of f along the direction of f(m) is 0; an
    end is at most h / 2 away, and Taylor's formula from m to it gives 0 >= |f(m)| - A (h / 2)^2 / 2. So the point stays within A h^2 / 8 of the
    convex hull of the part's vertices at both ends.
    """
    least = Decimal("inf")
    ends = [[a + s * b for a, b in zip(motion["from"], motion["by"])] for s in (start, end)]
    for vertices in motion["parts"]:
        hull = [place(robot, v, q) for v in vertices for q in ends]
        off = max(bend(v, motion["by"]) for v in vertices) * (end - start) ** 2 / 8 + robot.get("radius", 0) + SLACK
        box = span(hull)
        for core, radius, its_box in shapes:
            # no two of their points are nearer than the boxes along either axis
            if max(max(a[0] - b[1], b[0] - a[1]) for a, b in zip(box, its_box)) - off - radius < least:
                least = min(distance(hull, core) - off - radius, least)
    return least


def check(certificate):
    """How far the motion is proven free, in how many steps, and the least clearance of these. Raises Refused."""
    require(certificate["version"] == 1, f"version {certificate['version']}: this program reads version 1")
    robot, motion, margin, steps = (certificate[key] for key in ("robot", "motion", "margin", "steps"))
    require(motion["kind"] == "chart line", f"a motion of kind {motion['kind']}")
    motion["parts"] = parts(robot)
    size = len(motion["parts"]) + (0 if is_arm(robot) else 2)
    require(motion["parts"] and len(motion["from"]) == len(motion["to"]) == size, "the motion is not one of this robot")
    motion["by"] = [way(a, b, is_arm(robot) or i > 1) for i, (a, b) in enumerate(zip(motion["from"], motion["to"]))]
    shapes = [(o["core"], o["radius"], span(o["core"])) for o in certificate["world"]["obstacles"]]
    require(margin >= 0 and robot.get("radius", 0) >= 0 and all(core and r >= 0 for core, r, _ in shapes),
            "a negative margin or radius, or a shape without points")

    at, least = Decimal(0), Decimal("inf")
    for i, (start, end, claimed) in enumerate(steps):
        require(start == at, f"step {i} begins at s={float(start)}, the one before ends at s={float(at)}")
        require(start < end <= 1, f"step {i} does not go forward within [0, 1]")
        claimed, bound = Decimal(claimed), proven(robot, motion, shapes, start, end)
        require(claimed > margin, f"step {i} claims {float(claimed)} m of clearance, not above the margin of {float(margin)} m")
        require(claimed <= bound, f"step {i} claims {float(claimed)} m of clearance; {float(bound)} m are proven")
        at, least = end, min(claimed, least)
    require(steps, "no step: nothing is proven")

    verdict = certificate["verdict"]
    until = 1 if verdict["edge"] == "free" else verdict["free_until"]
    for said in (until, certificate["proven_until"]):
        require(at == said, f"the steps end at s={float(at)}, not at s={float(said)}")
    if verdict["edge"] == "free":
        require(Decimal(verdict["clearance"]) <= least, f"the verdict claims {float(verdict['clearance'])} m of clearance")
    if verdict["edge"] == "hit":
        contact = verdict["contact_at"]
        require(until < contact <= 1, "the contact is not after the proof's end and before the motion's")
        left = proven(robot, motion, shapes, contact, contact)
        coordinates = [abs(x) for core, _, _ in shapes for p in core for x in p]
        require(left <= CONTACT * max(coordinates + [1]), f"no contact at s={float(contact)}: {float(left)} m are left")
    return at, len(steps), least


def checked(text):
    """As `check`, of a file's text, whatever that holds."""
    try:
        return check(json.loads(text, parse_float=number, parse_int=number, parse_constant=number))
    except (ArithmeticError, AttributeError, LookupError, RecursionError, TypeError, ValueError) as error:
        raise Refused(f"no certificate: {type(error).__name__}: {error}") from error


def read(file):
    try:
        with open(file, encoding="utf-8") as stream:
            return stream.read()
    except (OSError, UnicodeDecodeError) as error:
        raise Refused(error) from error


def main(files):
    refused = 0
    for file in files:
        try:
            until, steps, least = checked(read(file))
            said = f"proven free to s={float(until)}, {steps} steps, least clearance {float(least)} m"
        except Refused as error:
            refused += 1
            said = f"REFUSED: {error}"
        print(f"{file}: {said}")
    return 1 if refused or not files else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
