"""Runs and plans given anything: an answer, or an exception of Python."""

import pytest
from test_garbage import GARBAGE

import motion_lab as ml

RUN = ml.record(ticks=3, rays=4)
DIGESTS = ml.record(ticks=3, rays=4, frames=False)
PATH = ml.plan("workbench", (2.0, 0.0), (3.1, 0.0), robot=ml.Reach())
FRAME = RUN.frame(2)
VERIFICATION, DIFFERENCE, PICTURE = RUN.verify(), RUN.diff(RUN), RUN.plot()


def is_long(given):
    """Whether so many ticks or iterations take long, and not because anything is wrong."""
    return isinstance(given, int) and 10**6 < given < 2**64


def live():
    return ml.Recorder("lot", rays=0)


CALLS = {
    "record": ml.record,
    "record ticks": lambda x: None if is_long(x) else ml.record("lot", x),
    "record seed": lambda x: ml.record("lot", 1, seed=x),
    "record script": lambda x: ml.record("lot", 1, script=x),
    "record event": lambda x: ml.record("lot", 1, script=[x]),
    "record tick": lambda x: ml.record("lot", 1, script=[(x, "Hitch", {"release": True})]),
    "record robot": lambda x: ml.record("lot", 1, script=[(1, x, {"release": True})]),
    "record input": lambda x: ml.record("lot", 1, script=[(1, "Hitch", x)]),
    "record rays": lambda x: ml.record(ticks=1, rays=x),
    "record range": lambda x: ml.record("apartment", 1, range=x),
    "record frames": lambda x: ml.record("lot", 1, frames=x),
    "read": ml.read,
    "from_bytes": ml.Run.from_bytes,
    "states": RUN.states,
    "scans": RUN.scans,
    "sensor": lambda x: RUN.scans("Rusty", x),
    "frame": RUN.frame,
    "digests": DIGESTS.frame,
    "diff": RUN.diff,
    "plot": RUN.plot,
    "theme": lambda x: RUN.plot(theme=x),
    "csv": lambda x: RUN.to_csv(ranges=x),
    "equal": lambda x: (RUN == x, FRAME == x, PATH == x, PICTURE == x),
    "Recorder": ml.Recorder,
    "step": lambda x: None if is_long(x) else live().step(x),
    "seek": lambda x: None if is_long(x) else live().seek(x),
    "restore": lambda x: live().restore(x),
    "robot": lambda x: live().input(x, release=True),
    "drive": lambda x: live().input("Hitch", drive=x),
    "channel": lambda x: live().input("Hitch", drive=(x, 0)),
    "move_to": lambda x: live().input("Hitch", move_to=x),
    "teleport": lambda x: live().input("Hitch", teleport=x),
    "trailer": lambda x: live().input("Hitch", trailer=x),
    "release": lambda x: live().input("Hitch", release=x),
    "world": lambda x: live().change(x, open="gate"),
    "close": lambda x: live().change("Lot", close=x),
    "remove": lambda x: live().change("Lot", remove=x),
    "move": lambda x: live().change("Lot", move=("the west pillar", x)),
    "moved": lambda x: live().change("Lot", move=x),
    "add": lambda x: live().change("Lot", add=x),
    "points": lambda x: live().change("Lot", add=("a", x, 0.1)),
    "radius": lambda x: live().change("Lot", add=("a", [(1, 1)], x)),
    "configuration": lambda x: live().configuration(x),
    "plan": lambda x: ml.plan(x, (2.0, 0.0), (3.1, 0.0), robot=ml.Reach()),
    "start": lambda x: ml.plan("workbench", x, (3.1, 0.0), robot=ml.Reach(), budget=10),
    "goal": lambda x: ml.plan("apartment", (1.5, 5.75), x, robot=ml.Disc(), budget=10),
    "ends": lambda x: ml.plan("lot", x, x, robot=ml.Hitch(trailer=True), budget=10),
    "plan robot": lambda x: ml.plan("workbench", (2.0, 0.0), (3.1, 0.0), robot=x),
    "planner": lambda x: ml.plan("workbench", (2.0, 0.0), (3.1, 0.0), robot=ml.Reach(), planner=x),
    "plan seed": lambda x: ml.plan("workbench", (2.0, 0.0), (3.1, 0.0), robot=ml.Reach(), seed=x),
    "clearance": lambda x: ml.plan("workbench", (2.0, 0.0), (3.1, 0.0), robot=ml.Reach(), clearance=x),
    "budget": lambda x: ml.plan("workbench", (2.0, 0.0), (3.1, 0.0), robot=ml.Reach(), budget=x),
    "tube": lambda x: ml.plan("apartment", (1.5, 5.75), (4.5, 2.0), robot=ml.Disc(), tube=x, budget=10),
    "path theme": lambda x: PATH.plot(theme=x),
    "draw": lambda x: ml.World("lot").draw(x),
    "_drawing": lambda x: ml._core._drawing(x),
}


@pytest.mark.parametrize("name", CALLS)
def test_a_run_or_a_plan_of_anything_answers_or_raises_and_never_panics(name):
    raised = 0
    for given in GARBAGE:
        try:
            CALLS[name](given)
        except Exception:
            raised += 1
    assert raised > 0 or name == "equal"


def test_every_word_of_the_answers_can_be_printed():
    for value in [RUN, DIGESTS, PATH, FRAME, VERIFICATION, DIFFERENCE, PICTURE, live()]:
        assert type(value).__name__ in repr(value) and str(value)
