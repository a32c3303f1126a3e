#!/usr/bin/env python3
"""tamper_barrier.py FILE...: barrier.py accepts these barriers, and refuses every forgery of them.

Exits with 1 at the first barrier that is refused or forgery that is accepted, and says which. A forgery that would prove as much as before in a
file, such as a larger world where no cell ends at the world's sides, is left out there.
"""

import json
import sys

sys.dont_write_bytecode = True

from barrier import checked
from certificate import Refused


def middle(b):
    return b["cells"][len(b["cells"]) // 2]


def its_shapes(b):
    return [shape for shape in b["world"]["obstacles"] if shape["obstacle"] == middle(b)["obstacle"]]


def deepest(b):
    return max(b["cells"], key=lambda cell: cell["depth"] - cell["bound"])


def move(b, by):
    for shape in its_shapes(b):
        shape["core"] = [[x + by, y + by] for x, y in shape["core"]]


def shrink(b, by):
    """The obstacle of the cell in the middle, smaller about its middle."""
    for shape in its_shapes(b):
        mean = [sum(c) / len(shape["core"]) for c in zip(*shape["core"])]
        shape["core"] = [[m + (1 - by) * (x - m) for m, x in zip(mean, p)] for p in shape["core"]]
        shape["radius"] *= 1 - by


def open_door(b):
    b["world"]["obstacles"] = [shape for shape in b["world"]["obstacles"] if shape not in its_shapes(b)]


def larger_world(b):
    (low, high) = b["world"]["bounds"]
    b["world"]["bounds"] = [[x - 1.0 for x in low], [x + 1.0 for x in high]]


def put(key, value):
    return lambda b: middle(b).update({key: value(middle(b))})


def moved(axis, by):
    """The cell in the middle, moved along an axis by so many of its half sides."""

    def forge(b):
        middle(b)["middle"][axis] += by * middle(b)["half"][axis]

    return forge


def halves(by):
    return lambda b: middle(b).update(half=[by(h) for h in middle(b)["half"]])


ALWAYS = {
    "a cell moved by its side": moved(0, 2),
    "a cell moved by its other side": moved(1, -2),
    "a cell moved by its last side": moved(-1, 2),
    "a cell moved where nothing is": put("middle", lambda c: [0.1234] * len(c["middle"])),
    "a cell of a nanometre less": halves(lambda h: h - 1e-9),
    "a cell of half its sides": halves(lambda h: h / 2),
    "a larger cell": halves(lambda h: h * 1.1),
    "a cell without sides": halves(lambda h: 0.0),
    "a cell inside out": halves(lambda h: -h),
    "a cell of everything": halves(lambda h: 1e5),
    "an endless cell": halves(lambda h: "inf"),
    "cells of half their sides": lambda b: [cell.update(half=[h / 2 for h in cell["half"]]) for cell in b["cells"]],
    "one cell": lambda b: b.update(cells=[deepest(b)]),
    "one cell many times": lambda b: b.update(cells=[deepest(b)] * len(b["cells"])),
    "no cell": lambda b: b.update(cells=[]),
    "half of the cells": lambda b: b.update(cells=b["cells"][::2]),
    "a cell without a coordinate": lambda b: middle(b)["middle"].pop(),
    "more depth than there is": put("depth", lambda c: c["depth"] + 4.0),
    "infinite depth": put("depth", lambda c: "inf"),
    "a depth that is no number": put("depth", lambda c: float("nan")),
    "no depth": lambda b: middle(b).pop("depth"),
    "a depth below the bound": put("depth", lambda c: c["bound"] * 0.99),
    "a bound of 0": put("bound", lambda c: 0.0),
    "a bound that is too low": put("bound", lambda c: c["bound"] * 0.99),
    "a bound of more than the depth": put("bound", lambda c: c["depth"] * 1.01),
    "a part that is none": put("part", lambda c: 7),
    "half a part": put("part", lambda c: 0.5),
    "a part counted from behind": put("part", lambda c: -1),
    "an obstacle that is none": put("obstacle", lambda c: 999),
    "an obstacle by another name": put("name", lambda c: c["name"] + "?"),
    "an obstacle moved away": lambda b: move(b, 20.0),
    "an obstacle moved": lambda b: move(b, 0.4),
    "an obstacle moved the other way": lambda b: move(b, -0.4),
    "an obstacle of half its size": lambda b: shrink(b, 0.5),
    "an open door": open_door,
    "no obstacle": lambda b: b["world"].update(obstacles=[]),
    "an obstacle without points": lambda b: [shape.update(core=[]) for shape in its_shapes(b)],
    "an obstacle of negative radius": lambda b: [shape.update(radius=-1e-3) for shape in its_shapes(b)],
    "an infinite coordinate": lambda b: its_shapes(b)[0]["core"][0].__setitem__(0, float("inf")),
    "a coordinate beyond all worlds": lambda b: its_shapes(b)[0]["core"][0].__setitem__(0, 1e300),
    "the goal where the start is": lambda b: b.update(goal=b["start"]),
    "the start where the goal is": lambda b: b.update(start=b["goal"]),
    "the start beside the goal": lambda b: b.update(start=[x - 1e-6 for x in b["goal"]]),
    "the start in a cell": lambda b: b.update(start=middle(b)["middle"]),
    "the goal in a cell": lambda b: b.update(goal=[x + 0.99 * h for x, h in zip(middle(b)["middle"], middle(b)["half"])]),
    "a coordinate too few": lambda b: b["start"].pop(),
    "a coordinate too many": lambda b: b["goal"].append(0.0),
    "a start that is a text": lambda b: b.update(start="here"),
    "axes that wrap the other way": lambda b: [axis.update(wraps=not axis["wraps"]) for axis in b["axes"]],
    "the axes the other way round": lambda b: b["axes"].reverse(),
    "one axis": lambda b: b["axes"].pop(),
    "an unknown robot": lambda b: b["robot"].update(kind="snake"),
    "another robot": lambda b: b["robot"].update(kind="reach" if b["robot"]["kind"] == "rusty" else "rusty"),
    "another version": lambda b: b.update(version=2),
    "another kind of proof": lambda b: b.update(kind="certificate"),
    "no bounds": lambda b: b["world"].pop("bounds"),
}
OF_THE_WORLD = {
    "a world inside out": lambda b: b["world"]["bounds"].reverse(),
    "a start outside the world": lambda b: b["start"].__setitem__(0, b["world"]["bounds"][0][0] - 1e-9),
    "a goal outside the world": lambda b: b["goal"].__setitem__(1, b["world"]["bounds"][1][1] + 1e-9),
}
# of a car barrier.py looks at more points of its sides than the lab does, and may prove a little more
WITH_A_RADIUS = {
    "more depth": put("depth", lambda c: c["depth"] * 1.01),
    "a nanometre more depth": put("depth", lambda c: c["depth"] + 1e-9),
    "a thinner robot": lambda b: b["robot"].update(radius=b["robot"]["radius"] * 0.5),
    "a robot of negative radius": lambda b: b["robot"].update(radius=-b["robot"]["radius"]),
    "a robot with headings": lambda b: b["robot"].update(kind="hitch"),
}
OF_ARMS = {
    "an arm elsewhere": lambda b: b["robot"].update(base=[5.0, 5.0]),
    "an arm with short links": lambda b: b["robot"].update(lengths=[0.1 for _ in b["robot"]["lengths"]]),
    "an arm with a link of negative length": lambda b: b["robot"]["lengths"].__setitem__(1, -1.0),
    "an arm of one link more": lambda b: b["robot"]["lengths"].append(0.1),
    "another link": put("part", lambda c: len(c["middle"]) - 1 - c["part"]),
}


def body(key, by):
    return lambda b: b["robot"]["body"].update({key: by(b["robot"]["body"][key])})


OF_CARS = {
    "a car half as wide": body("width", lambda w: w / 2),
    "a car half as long": body("length", lambda l: l / 2),
    "a car of no width": body("width", lambda w: 0.0),
    "a car of negative length": body("length", lambda l: -l),
    "a car behind its axle": body("rear_overhang", lambda r: r + 3.0),
    "a car with a trailer": lambda b: b["robot"].update(
        trailer={"hitch_len": 2.0, "front_overhang": 1.0, "rear_overhang": 0.8, "width": 1.5}
    ),
    "a thin car with a radius": lambda b: (b["robot"].update(radius=1.0), body("width", lambda w: 0.01)(b)),
    "a car without a heading": lambda b: [b[key].pop() for key in ("axes", "start", "goal")],
    "a heading that ends": lambda b: b["axes"][2].update(wraps=False),
}


def ends_at_the_sides(b):
    """Whether the barrier ends at the sides of the world, and a larger one has a way round it."""
    (low, high) = b["world"]["bounds"]
    reaches = lambda cell: any(m - h <= a or m + h >= z for m, h, a, z in zip(cell["middle"], cell["half"], low, high))
    return b["robot"]["kind"] != "reach" and any(map(reaches, b["cells"]))


def forgeries(text):
    """The texts of all forgeries, by name."""
    b = json.loads(text)
    sets = [ALWAYS, {"rusty": {}, "reach": OF_ARMS, "hitch": OF_CARS}[b["robot"]["kind"]]]
    sets += [{} if b["robot"]["kind"] == "reach" else OF_THE_WORLD, WITH_A_RADIUS if "radius" in b["robot"] else {}]
    sets += [{"a larger world": larger_world}] if ends_at_the_sides(b) else []
    sets += [{f"without cell {n}": lambda b, n=n: b["cells"].pop(n)} for n in range(0, len(b["cells"]), max(5, len(b["cells"]) // 12))]
    for name, forge in [item for some in sets for item in some.items()]:
        b = json.loads(text)
        forge(b)
        yield name, json.dumps(b)
    for broken in ["", "{}", "[]", "null", text[: len(text) // 2], text.replace("[", "", 1)]:
        yield f"the text {broken[:20]!r}", broken


def main(files):
    refused = 0
    for file in files:
        with open(file, encoding="utf-8") as stream:
            text = stream.read()
        try:
            checked(text)
        except Refused as error:
            print(f"{file}: refused as it is: {error}")
            return 1
        for name, forged in forgeries(text):
            try:
                checked(forged)
            except Refused:
                refused += 1
            else:
                print(f"{file}: accepted with {name}")
                return 1
    print(f"{refused} forgeries of {len(files)} barriers refused")
    return 0 if files else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
