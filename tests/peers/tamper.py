#!/usr/bin/env python3
"""tamper.py FILE...: certificate.py accepts these certificates, and refuses every forgery of them.

Exits with 1 at the first certificate that is refused or forgery that is accepted, and says which. A forgery that would change nothing in a
file, such as a gap between its steps where it has one step, is left out there.
"""

import json
import sys

sys.dont_write_bytecode = True

from certificate import Refused, checked


def middle(c):
    return c["steps"][len(c["steps"]) // 2]


def on_the_robot(c):
    return c["robot"]["base"] if c["robot"]["kind"] == "reach" else c["motion"]["from"][:2]


def enlarge(c):
    if c["robot"]["kind"] == "hitch":
        c["robot"]["body"]["width"] += 50.0
    else:
        c["robot"]["radius"] += 2 * max(step[2] for step in c["steps"])


def early(c):
    """Of the proof its first step is left, and the contact comes right after it."""
    c["steps"], until = c["steps"][:1], c["steps"][0][1]
    c["verdict"].update(free_until=until, contact_at=until + 1e-12)
    c["proven_until"] = until


ALWAYS = {
    "a clearance that is no number": lambda c: middle(c).__setitem__(2, float("nan")),
    "a clearance that is a text": lambda c: middle(c).__setitem__(2, "much"),
    "a clearance of 0": lambda c: middle(c).__setitem__(2, 0.0),
    "a first step that begins late": lambda c: c["steps"][0].__setitem__(0, 1e-9),
    "a step of no length": lambda c: middle(c).__setitem__(1, middle(c)[0]),
    "a step back": lambda c: c["steps"].append([c["steps"][-1][1], 0.0, 1e-9]),
    "a step beyond the motion's end": lambda c: c["steps"][-1].__setitem__(1, 1.0000000001),
    "no step": lambda c: c.update(steps=[]),
    "a proof that ends elsewhere": lambda c: c.update(proven_until=c["proven_until"] * 0.5),
    "a margin below 0": lambda c: c.update(margin=-1.0),
    "no margin": lambda c: c.pop("margin"),
    "another robot": lambda c: c["robot"].update(kind="reach" if c["robot"]["kind"] == "hitch" else "hitch"),
    "an unknown robot": lambda c: c["robot"].update(kind="snake"),
    "a coordinate too many": lambda c: c["motion"]["to"].append(0.0),
    "an angle beyond pi": lambda c: c["motion"]["to"].__setitem__(-1, 3.2),
    "an unknown motion": lambda c: c["motion"].update(kind="arc"),
    "another version": lambda c: c.update(version=2),
}
OF_SEVERAL_STEPS = {
    "a missing step": lambda c: c["steps"].pop(len(c["steps"]) // 2),
    "a gap": lambda c: c["steps"][0].__setitem__(1, c["steps"][0][1] * 0.999),
    "an overlap": lambda c: c["steps"][1].__setitem__(0, c["steps"][1][0] * 0.999),
}
OF_OBSTACLES = {
    "1 % more clearance": lambda c: middle(c).__setitem__(2, middle(c)[2] * 1.01),
    "1e-9 m more clearance": lambda c: middle(c).__setitem__(2, middle(c)[2] + 1e-9),
    "infinite clearance": lambda c: middle(c).__setitem__(2, "inf"),
    "a margin that is not kept": lambda c: c.update(margin=min(step[2] for step in c["steps"])),
    "a larger robot": enlarge,
    "an obstacle on the robot": lambda c: c["world"]["obstacles"][-1].update(core=[on_the_robot(c)]),
    "an obstacle without points": lambda c: c["world"]["obstacles"][-1].update(core=[]),
    "an obstacle of negative radius": lambda c: c["world"]["obstacles"][-1].update(radius=-1e-3),
    "an infinite coordinate": lambda c: c["world"]["obstacles"][-1]["core"][0].__setitem__(0, float("inf")),
}
OF_FREE = {
    "a free motion of more clearance": lambda c: c["verdict"].update(clearance=c["verdict"]["clearance"] * 1.01),
}
OF_HITS = {
    "one step over a motion that hits": lambda c: c.update(steps=[[0.0, 1.0, 1e-300]]),
    "a hit called free": lambda c: c.update(verdict={"edge": "free", "clearance": 1e-300}, proven_until=1.0),
    "a contact within the proof": lambda c: c["verdict"].update(contact_at=c["verdict"]["free_until"] * 0.5),
    "a contact where there is none": early,
}


def forgeries(text):
    """The texts of all forgeries, by name."""
    c = json.loads(text)
    sets = [ALWAYS, OF_SEVERAL_STEPS if len(c["steps"]) > 1 else {}, OF_HITS if c["verdict"]["edge"] == "hit" else {}]
    if c["world"]["obstacles"]:
        sets += [OF_OBSTACLES, OF_FREE if c["verdict"]["edge"] == "free" else {}]
    for name, forge in [item for some in sets for item in some.items()]:
        c = json.loads(text)
        forge(c)
        yield name, json.dumps(c)
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
    print(f"{refused} forgeries of {len(files)} certificates refused")
    return 0 if files else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
