"""Planners that are written in Python, and planners compared."""

import gc
import json
import weakref

import numpy as np
import pytest

import motion_lab as ml

ENDS = ((2.0, 0.0), (2.2, 1.9))
POST = ((2.0, 0.0), (3.1, 0.0))


class Detour:
    """Over one sample, the first that start and goal both see. It counts what it does."""

    name = "detour"
    draws_samples = True

    def __init__(self):
        self.samples = self.edges = self.free = self.iterations = 0
        self.over = None

    def advance(self, search):
        self.iterations += 1
        self.samples += 1
        over = search.sample()
        for node, q in ((0, over), (None, search.goal)):
            self.edges += 1
            node = search.reach(len(search.nodes) - 1 if node is None else node, q)
            if node is None:
                return
            self.free += 1
        self.over = over
        search.take_branch(node)


class Rrt:
    """A tree of samples."""

    name = "my-rrt"
    draws_samples = True

    def advance(self, search):
        q = search.sample()
        node = search.reach(search.nearest(q), q)
        end = None if node is None else search.reach(node, search.goal)
        if end is not None:
            search.take_branch(end)


def of(advance, **attributes):
    """A planner of a function."""
    return type("One", (), {"name": "one", "advance": lambda self, search: advance(search), **attributes})()


def planned(planner, ends=ENDS, **how):
    return ml.plan("workbench", *ends, robot=ml.Reach(), planner=planner, **how)


def test_a_planner_in_python_has_its_path_proven_counted_written_and_played(tmp_path):
    planner = Detour()
    path = planned(planner)
    assert (path.planner, len(path)) == ("detour", 2)
    assert path.corners.tolist() == [list(ENDS[0]), planner.over.tolist(), list(ENDS[1])]
    assert path.effort == {name: getattr(planner, name) for name in ("iterations", "samples", "edges", "free")}
    assert path.clearance == path.verify() > 0.001, "it draws samples, and keeps the usual margin"
    checker = ml.Checker("workbench", ml.Reach())
    assert checker.edge_free(path.corners[:-1], path.corners[1:]).all()
    path.write(tmp_path / "path.json")
    assert json.loads((tmp_path / "path.json").read_text())["planner"] == "detour"
    assert path.play().verify().identical > 0
    assert "detour" in path.plot().svg
    # the same seed gives the same path, another another
    assert planned(Detour).corners.tobytes() == path.corners.tobytes()
    assert planned(Detour, seed=7).corners.tobytes() != path.corners.tobytes()


def test_a_tree_in_python_goes_round_the_post_and_from_room_to_room():
    path = planned(Rrt, POST)
    nodes, edges = path.growth
    assert len(path) > 2 and len(edges) == len(nodes) - 1
    assert path.corners[0].tolist() == list(POST[0]) and path.corners[-1].tolist() == list(POST[1])
    for robot, ends in [(ml.Disc(), ((1.5, 5.75), (9.75, 6.25))), (ml.Rusty(), ((1.5, 5.75, 1), (9.75, 6.25, 0)))]:
        path = ml.plan("apartment", *ends, robot=robot, planner=Rrt)
        assert path.corners.shape[1] == len(ends[0]) and path.verify() > 0.001
    # a rover is planned as a disc
    widths = set()
    three = of(lambda search: widths.add(search.start.shape) or search.take([0]))
    with pytest.raises(ml.NoPath):
        ml.plan("apartment", (1.5, 5.75, 1), (9.75, 6.25, 0), robot=ml.Rusty(), planner=three, budget=3)
    assert widths == {(2,)}
    arm = ml.Reach(lengths=(0.5, 0.4, 0.3))
    path = ml.plan("workbench", (2, 0, 0.1), (2.2, 1.9, 0), robot=arm, planner=Rrt)
    assert path.corners.shape[1] == 3
    # for a car there is none, whether its start touches something or not
    for start in ((6.5, 2.5, 0), (0.0, 0.0, 0.0)):
        with pytest.raises(ml.Error, match="no car can drive"):
            ml.plan("lot", start, (6.75, 7, -1.5), robot=ml.Hitch(), planner=Rrt)


def test_what_a_search_answers():
    checker = ml.Checker("workbench", ml.Reach())
    seen = {}

    def advance(search):
        free = (2.0, 0.3)
        assert search.start.tolist() == list(ENDS[0]) and search.goal.tolist() == list(ENDS[1])
        assert repr(search) == "<Search of 1 nodes>" and search.nodes.tolist() == [list(ENDS[0])]
        # the post stands between these two
        assert search.edge_free(*POST) is False and search.edge_free(POST[0], np.array(free)) is True
        assert search.reach(0, POST[1]) is None and search.reach(0, list(free)) == 1
        # angles are wrapped, and the nearest is so the short way round
        assert search.reach(1, (2.0, 0.4 - 2 * np.pi)) == 2
        assert search.nodes[2].tolist() == pytest.approx([2.0, 0.4])
        assert [search.nearest(q) for q in ((2.0, 0.01), (2.0 - 2 * np.pi, 0.31), (2.1, 2.0))] == [0, 1, 2]
        assert search.take([]) is False, "no path at all"
        sample = search.sample()
        assert checker.distance(sample) >= 0 and sample.shape == (2,)
        for call, error, words in [
            (lambda: search.reach(3, free), IndexError, "there is no node 3: the search has 3"),
            (lambda: search.take([0, 7]), IndexError, "no node 7"),
            (lambda: search.take_branch(9), IndexError, "no node 9"),
            (lambda: search.reach(-1, free), OverflowError, None),
            (lambda: search.reach(0, (1, 2, 3)), ValueError, "q has 3 coordinates"),
            (lambda: search.edge_free((1, 2), np.zeros((4, 2))), ValueError, "b is one configuration, not many"),
            (lambda: search.nearest((np.nan, 0)), ml.ConfigurationError, "q is not finite"),
        ]:
            with pytest.raises(error, match=words):
                call()
        seen["search"] = search
        raise StopIteration("seen")

    with pytest.raises(StopIteration, match="seen"):
        planned(of(advance))
    with pytest.raises(RuntimeError, match="a search can be used within advance alone"):
        seen["search"].sample()
    with pytest.raises(RuntimeError, match="within advance alone"):
        repr(seen["search"])


def test_a_path_that_is_not_free_or_does_not_reach_the_goal_is_none():
    def through_the_post(search):
        # the line to the goal is not free, so there is no node to take
        assert search.reach(0, search.goal) is None

    with pytest.raises(ml.NoPath, match="no path within the bound on iterations: 5 iterations") as refused:
        planned(of(through_the_post), POST, budget=5)
    assert refused.value.effort == {"iterations": 5, "samples": 0, "edges": 5, "free": 0}
    # a way to somewhere else, and none, are no path from the start to the goal
    for nodes in ([0, 1], [0]):

        def elsewhere(search, nodes=nodes):
            search.reach(0, (2.0, 0.3))
            search.take(nodes)

        with pytest.raises(ml.NoPath, match="does not lead from the start to the goal") as refused:
            planned(of(elsewhere), POST, budget=5)
        assert refused.value.effort == {"iterations": 1, "samples": 0, "edges": 1, "free": 1}


def test_what_advance_raises_is_raised_once_and_ends_the_search():
    calls = []

    def take_and_raise(search):
        search.take([0, search.reach(0, search.goal)])
        raise ZeroDivisionError("after all")

    with pytest.raises(ZeroDivisionError, match="after all"):
        planned(of(take_and_raise), ((2.0, 0.0), (2.0, 0.3)))

    def advance(search):
        calls.append(search.sample())
        if len(calls) == 3:
            raise ZeroDivisionError("three")

    with pytest.raises(ZeroDivisionError, match="three"):
        planned(of(advance), POST)
    assert len(calls) == 3
    for kind in (KeyboardInterrupt, SystemExit):

        def stop(search, kind=kind):
            raise kind("stop")

        with pytest.raises(kind, match="stop"):
            planned(of(stop), POST)

    def give_up(search):
        search.sample()
        raise ml.NoPath("it has no patience")

    with pytest.raises(ml.NoPath, match="it has no patience") as refused:
        planned(of(give_up), POST)
    assert refused.value.effort == {"iterations": 1, "samples": 1, "edges": 0, "free": 0}


def test_a_planner_without_a_name_of_its_own_or_without_advance_is_refused():
    for planner, error, words in [
        (of(print, name="rrt"), ml.Error, 'there is a planner "rrt" already'),
        (of(print, name="My planner"), ml.Error, "is no name of a planner"),
        (of(print, name=3), TypeError, "an object with a name and a method advance"),
        (of(print, draws_samples="yes"), TypeError, "draws_samples is True or False"),
        (object(), TypeError, "a method advance"),
        (7, TypeError, "a method advance"),
        ("rrt-conect", ValueError, 'did you mean "rrt-connect"'),
    ]:
        with pytest.raises(error, match=words):
            planned(planner)


def test_one_that_draws_no_samples_keeps_no_margin():
    def to_goal(search):
        end = search.reach(0, search.goal)
        if end is not None:
            search.take_branch(end)

    world = ml.World.from_shapes(boxes=[(2.0, 0.0, 3.0, 1.0)], bounds=(0, 0, 4, 4))
    robot = ml.Disc(0.1)
    ends = ((0.5, 1.1004), (3.5, 1.1004))
    path = ml.plan(world, *ends, robot=robot, planner=of(to_goal))
    assert path.clearance == pytest.approx(0.0004, abs=1e-9)
    for how in ({"planner": of(to_goal), "clearance": 0.001}, {"planner": of(to_goal, draws_samples=True)}):
        with pytest.raises(ml.NoPath, match="no path within the bound on iterations: 5"):
            ml.plan(world, *ends, robot=robot, budget=5, **how)


def test_a_path_does_not_hold_its_planner():
    planner = Detour()
    path = planned(planner)
    planner.path = path
    gone = weakref.ref(planner)
    del planner
    del path
    gc.collect()
    assert gone() is None


def test_planners_are_compared_by_rows():
    rows = ml.compare([Detour, "rrt-connect"], "workbench", *ENDS, robot=ml.Reach(), seeds=[3, 1], budget=400)
    order = [("detour", 3), ("detour", 1), ("rrt-connect", 3), ("rrt-connect", 1)]
    assert [(row["planner"], row["seed"]) for row in rows] == order
    for row in rows:
        path = planned(Detour if row["planner"] == "detour" else row["planner"], seed=row["seed"], budget=400)
        assert (row["solved"], row["length"], row["clearance_m"]) == (True, path.length, path.clearance)
        assert {name: row[name] for name in path.effort} == path.effort and row["reason"] is None
        assert row["time_s"] > 0
    # each attempt has a planner of its own, which says its name
    made = []

    class Counted(Detour):
        def __init__(self):
            super().__init__()
            self.name = f"detour-{len(made)}"
            made.append(self)

    rows = ml.compare([Counted], "workbench", *ENDS, robot=ml.Reach(), seeds=range(3))
    assert [row["planner"] for row in rows] == ["detour-0", "detour-1", "detour-2"]
    assert [row["iterations"] for row in rows] == [planner.iterations for planner in made]
    with pytest.raises(ml.Error, match="plans for discs"):
        ml.compare(["rrt", "bug1"], "workbench", *ENDS, robot=ml.Reach(), seeds=[1])
    without = ml.compare(["rrt", "prm"], "workbench", *POST, robot=ml.Reach(), seeds=range(2), budget=2)
    assert [row["solved"] for row in without] == [False] * 4
    assert {row["iterations"] for row in without} == {2} and {row["length"] for row in without} == {None}
    assert all(row["reason"].startswith("no path within the bound") for row in without)
    overlap = ml.compare(["rrt"], "workbench", (2.4, 0), POST[1], robot=ml.Reach(), seeds=[0])
    assert overlap[0]["edges"] == 0 and "the post" in overlap[0]["reason"]
    assert list(rows[0]) == list(without[0]) == list(overlap[0])
    with pytest.raises(ValueError, match="no planner"):
        ml.compare(["rtt"], "workbench", *POST, robot=ml.Reach())


def test_who_gives_up_has_a_row_and_clearance_is_asked_of_all_alike():
    def give_up(search):
        search.reach(0, search.goal)
        raise ml.NoPath("it has no patience")

    def how(**more):
        return ml.compare([of(give_up), Detour, "a-star"], "workbench", *ENDS, robot=ml.Reach(), seeds=[1], **more)

    gave_up, detour, grid = how()
    assert (gave_up["solved"], gave_up["reason"], gave_up["edges"]) == (False, "it has no patience", 1)
    # planners that draw no samples are asked for nothing, whether the lab's or one's own
    assert [row["clearance_asked_m"] for row in (gave_up, detour, grid)] == [None, 0.001, 0.0]
    assert [row["clearance_asked_m"] for row in how(clearance=0.002)] == [0.002] * 3
    assert all(row["clearance_m"] > 0.002 for row in how(clearance=0.002) if row["solved"])
    assert list(gave_up) == list(detour) == list(grid)
