#!/usr/bin/env python3
"""shortest.py LAB FOLDER: compares the bounds that `motion-lab plan --bound` gives with shortest paths that Shapely's geometry has.

For a disc among obstacles the centre keeps a radius r from each. Shapely grows every obstacle by r, its round corners cut into many
straight pieces: once with corners on the circles, so that the polygon lies within what is forbidden, and once beyond them, by the factor
1 / cos of half a piece, so that it holds all of that. A path round the inner polygons is no longer than any path of the disc, and one
round the outer polygons is one of the disc. So the shortest path lies between the two lengths, each of which is Dijkstra's over the
corners that see one another. The lab's bound and the length of its path must lie in that interval, but for ROUNDING and the millimetre
by which the lab's path may be longer.

Worlds are drawn by Python's own generator from a seed, and the lab reads them as files. Exits with 1 where a length lies outside.
"""

import heapq
import json
import math
import random
import subprocess
import sys
from pathlib import Path

from shapely import STRtree
from shapely.geometry import LineString, Point, Polygon, box
from shapely.ops import unary_union
from shapely.prepared import prep

RADIUS = 0.11
PIECES = 32  # of a quarter of a circle
SIZE = 3.0
ROUNDING = 1e-6
PATH = 1e-3  # the lab's path may be longer than the shortest by so much
WORLDS = 10


def obstacles(rng):
    """Walls, discs and triangles as Shapely's shapes, and as a world file has them."""
    shapes, lines, walls = [], [], []
    if rng.random() < 0.2:
        # from side to side
        ends = [(rng.uniform(-2, 2), -SIZE), (rng.uniform(-2, 2), SIZE)]
        shapes.append((LineString(ends), 0.0))
        walls.append(f'(name: "across", points: [{", ".join(f"({a}, {b})" for a, b in ends)}])')
    for i in range(rng.randint(3, 7)):
        x, y, turn = rng.uniform(-2.2, 2.2), rng.uniform(-2.2, 2.2), rng.uniform(0, math.tau)
        reach = rng.uniform(0.4, 1.6)
        if i % 3 == 0:
            ends = [(x, y), (x + reach * math.cos(turn), y + reach * math.sin(turn))]
            shapes.append((LineString(ends), 0.0))
            walls.append(f'(name: "wall {i}", points: [{", ".join(f"({a}, {b})" for a, b in ends)}])')
        elif i % 3 == 1:
            shapes.append((Point(x, y), 0.3 * reach))
            lines.append(f'(name: "disc {i}", shape: Disc(center: ({x}, {y}), radius: {0.3 * reach}))')
        else:
            corners = [(x + 0.5 * reach * math.cos(turn + k), y + 0.5 * reach * math.sin(turn + k)) for k in (0, 1.7, 4.1)]
            shapes.append((Polygon(corners), 0.0))
            lines.append(f'(name: "triangle {i}", shape: Polygon([{", ".join(f"({a}, {b})" for a, b in corners)}]))')
    return shapes, (
        f'World(version: 1, name: "random", bounds: (min: (-{SIZE}, -{SIZE}), max: ({SIZE}, {SIZE})), '
        f'walls: [{", ".join(walls)}], obstacles: [{", ".join(lines)}], robots: [])'
    )


def length_among(shapes, start, goal, factor):
    """The length of the shortest path of a point among the shapes grown by the disc's radius times a factor; infinity without one."""
    grown = [shape.buffer((extra + RADIUS) * factor, quad_segs=PIECES) for shape, extra in shapes]
    blocked = unary_union(grown)
    room = box(-SIZE, -SIZE, SIZE, SIZE)
    if any(not room.covers(Point(p)) or blocked.contains(Point(p)) for p in (start, goal)):
        return None
    parts = list(blocked.geoms) if hasattr(blocked, "geoms") else [blocked]
    rings = [ring for part in parts for ring in (part.exterior, *part.interiors)]
    # a corner that is inward is on no shortest path
    nodes = [start, goal]
    for ring in rings:
        points = list(ring.coords)[:-1]
        outward = 1 if ring.is_ccw else -1
        sign = outward if any(ring.equals(part.exterior) for part in parts) else -outward
        for i, (bx, by) in enumerate(points):
            (ax, ay), (cx, cy) = points[i - 1], points[(i + 1) % len(points)]
            if sign * ((bx - ax) * (cy - by) - (by - ay) * (cx - bx)) > 0 and room.covers(Point(bx, by)):
                nodes.append((bx, by))
    # shrunk by a hair, so that lines along its own sides do not cross it
    shy = [part.buffer(-1e-9) for part in parts]
    tree, prepared = STRtree(shy), [prep(part) for part in shy]

    def sees(a, b):
        line = LineString([a, b])
        return not any(prepared[i].intersects(line) for i in tree.query(line))

    best, open_, done = {0: 0.0}, [(math.dist(start, goal), 0)], set()
    while open_:
        _, at = heapq.heappop(open_)
        if at in done:
            continue
        done.add(at)
        if at == 1:
            return best[1]
        for to, place in enumerate(nodes):
            if to in done:
                continue
            cost = best[at] + math.dist(nodes[at], place)
            if cost < best.get(to, math.inf) and sees(nodes[at], place):
                best[to] = cost
                heapq.heappush(open_, (cost + math.dist(place, goal), to))
    return math.inf


def main(lab, folder):
    bent = parted = widest = 0
    seed = 0
    while bent + parted < WORLDS:
        seed += 1
        rng = random.Random(seed)
        shapes, text = obstacles(rng)
        start, goal = [(round(rng.uniform(-2.8, 2.8), 3), round(rng.uniform(-2.8, 2.8), 3)) for _ in range(2)]
        inner = length_among(shapes, start, goal, 1.0)
        outer = length_among(shapes, start, goal, 1.0 / math.cos(math.pi / (4 * PIECES)))
        if inner is None or outer is None or inner < math.dist(start, goal) + 1e-9:
            continue  # no ends of a path, or the straight line
        world = Path(folder, "random.ron")
        world.write_text(text)
        ends = [",".join(map(repr, p)) for p in (start, goal)]
        ask = ["plan", "--planner", "tangent-graph", "--robot", "rusty", "--world", str(world), "--tube", "0", "--bound", "--json"]
        done = subprocess.run([lab, *ask, f"--from={ends[0]}", f"--to={ends[1]}"], capture_output=True, text=True, check=False)
        answer = json.loads(done.stdout)
        if math.isinf(inner):
            assert answer["answer"] == "none" and done.returncode == 7, (seed, answer)
            parted += 1
            continue
        bound, length = answer.get("length_bound"), answer.get("length")
        if math.isinf(outer):
            continue  # a gap between the two polygons
        assert answer["answer"] == "path", (seed, inner, outer, answer)
        assert inner - ROUNDING <= bound <= outer + ROUNDING, (seed, inner, bound, outer)
        assert bound <= length <= outer + PATH, (seed, bound, length, outer)
        bent, widest = bent + 1, max(widest, outer - inner)
    assert bent >= 6 and parted >= 2, (bent, parted)
    print(f"{bent} shortest paths lie in intervals of at most {widest * 1e6:.0f} micrometres, and {parted} problems have none")


main(*sys.argv[1:])
