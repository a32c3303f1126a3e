"""Paths: planned, proven, written, played, drawn."""

import json
import math

import numpy as np
import pytest

import motion_lab as ml

# the chapter's question: the arm of the Workbench round the post
POST = ((2.0, 0.0), (3.1, 0.0))


def round_the_post(**how):
    return ml.plan("workbench", *POST, robot=ml.Reach(), **how)


def turned(a, b):
    """The difference of angles the short way, by numpy."""
    return (np.asarray(b) - np.asarray(a) + np.pi) % (2 * np.pi) - np.pi


def test_a_path_leads_from_the_start_to_the_goal_and_is_as_long_as_its_legs():
    path = round_the_post()
    assert path.corners.shape == (len(path) + 1, 2) and path.corners.dtype == np.float64
    assert path.corners[0].tolist() == [2.0, 0.0] and path.corners[-1].tolist() == [3.1, 0.0]
    legs = turned(path.corners[:-1], path.corners[1:])
    assert path.length == pytest.approx(np.hypot(legs[:, 0], legs[:, 1]).sum(), rel=1e-12)
    assert (path.unit, path.planner, path.seed, path.controls) == ("rad", "rrt-connect", 2005, None)


def test_a_path_s_clearance_is_proven_step_by_step():
    path = round_the_post()
    steps = path.certificates
    assert len(steps) == len(path) and all(step.shape[1] == 3 for step in steps)
    for step in steps:
        # from 0 to 1 without a gap
        assert step[0, 0] == 0.0 and step[-1, 1] == 1.0 and (step[1:, 0] == step[:-1, 1]).all()
    assert path.clearance == min(step[:, 2].min() for step in steps) == path.verify() > 0.001


def test_a_checker_proves_every_leg_that_was_planned_for_it():
    checker = ml.Checker("apartment", ml.Disc())
    path = ml.plan(checker, start=(1.5, 5.75), goal=(9.75, 6.25), planner="rrt-connect", seed=7)
    assert len(path) > 1 and checker.edge_free(path.corners[:-1], path.corners[1:]).all()
    assert checker.distance(path.corners).min() >= path.clearance
    by_world = ml.plan(ml.World("apartment"), (1.5, 5.75), (9.75, 6.25), robot=ml.Disc(), seed=7)
    assert by_world.corners.tobytes() == path.corners.tobytes()
    for robot, start, goal in [(ml.Reach(), *POST), (ml.Rusty(), (1.5, 5.75, 1.0), (9.75, 6.25, 0.0))]:
        checker = ml.Checker("workbench" if isinstance(robot, ml.Reach) else "apartment", robot)
        corners = ml.plan(checker, start, goal).corners
        assert checker.edge_free(corners[:-1], corners[1:]).all()
    with pytest.raises(TypeError, match="a Checker has its robot: leave out robot="):
        ml.plan(checker, (1.5, 5.75, 0), (9.75, 6.25, 0), robot=ml.Rusty())


def test_the_same_seed_gives_the_same_path_and_another_another():
    assert round_the_post().corners.tobytes() == round_the_post(seed=2005).corners.tobytes()
    assert round_the_post(seed=7).corners.tobytes() != round_the_post().corners.tobytes()


def test_a_disc_s_path_is_of_its_place_and_a_rover_s_of_its_pose():
    ends = ((1.5, 5.75), (9.75, 6.25))
    disc = ml.plan("apartment", *ends, robot=ml.Disc(0.11), planner="visibility-graph")
    legs = np.diff(disc.corners, axis=0)
    assert disc.length == pytest.approx(np.hypot(*legs.T).sum(), rel=1e-12) and disc.unit == "m"
    assert disc.length >= math.dist(*ends)
    rover = ml.plan("apartment", (*ends[0], 0.5), (*ends[1], 1.0), robot=ml.Rusty(), planner="visibility-graph")
    assert rover.corners.shape == (len(rover) + 1, 3) and not rover.corners[:, 2].any()
    assert rover.corners[:, :2].tobytes() == disc.corners.tobytes()
    # the shortest way is the shortest of all
    assert disc.length <= ml.plan("apartment", *ends, robot=ml.Disc(0.11)).length
    wider = ml.plan("apartment", *ends, robot=ml.Disc(0.11), planner="visibility-graph", tube=0.02)
    assert wider.length > disc.length


def test_a_car_s_path_says_what_drives_it():
    goal = (6.75, 7.0, -math.pi / 2)
    path = ml.plan("lot", (6.5, 2.5, 0.0), goal, robot=ml.Hitch())
    assert path.planner == "hybrid-a-star" and path.controls.shape == (len(path), 3) and path.corners.shape[1] == 3
    speed, _steer, seconds = path.controls.T
    assert path.length == pytest.approx((abs(speed) * seconds).sum(), rel=1e-12)
    # docs/cli.md: within 0.1 m and 0.05 rad
    assert math.dist(path.corners[-1, :2], goal[:2]) < 0.1 and abs(turned(path.corners[-1, 2], goal[2])) < 0.05
    # a leg without steering goes straight on
    straight = path.controls[:, 1] == 0.0
    assert straight.any()
    for a, b, (v, _, t) in zip(
        path.corners[:-1][straight], path.corners[1:][straight], path.controls[straight], strict=True
    ):
        assert b[:2] == pytest.approx(a[:2] + v * t * np.array([math.cos(a[2]), math.sin(a[2])]), abs=1e-9)


@pytest.mark.parametrize("planner", ml.planner_names())
def test_every_planner_finds_a_proven_path_or_says_why_not(planner):
    try:
        path = ml.plan("apartment", (1.5, 5.75), (4.5, 2.0), robot=ml.Disc(), planner=planner, budget=20_000)
    except ml.NoPath as reason:
        assert planner == "potential-field" and str(reason)
    except ml.Error as reason:
        assert planner == "hybrid-a-star" and "it plans for a car only" in str(reason)
    else:
        assert path.verify() == path.clearance > 0.0 and path.planner == planner
        assert path.corners[0].tolist() == [1.5, 5.75] and path.corners[-1].tolist() == [4.5, 2.0]


def test_a_path_keeps_the_clearance_that_is_asked_for():
    path = round_the_post(clearance=0.02)
    assert path.clearance > 0.02 and min(step[:, 2].min() for step in path.certificates) > 0.02
    with pytest.raises(ml.NoPath, match="the start has a clearance of .* m from .*; it is to keep more than 1 m"):
        round_the_post(clearance=1.0)


def test_a_budget_bounds_the_iterations_and_shortens_the_best_path():
    with pytest.raises(ml.NoPath, match="no path within the bound on iterations: 3 iterations, "):
        round_the_post(budget=3)
    assert round_the_post().effort["iterations"] < 1000
    first = round_the_post(planner="rrt-star")
    better = round_the_post(planner="rrt-star", budget=3000)
    assert better.effort["iterations"] == 3000 and better.length < first.length
    assert better.verify() == better.clearance


def test_no_path_of_a_disc_is_shorter_than_its_bound():
    # two tangents and an arc about the wall's end, half a metre beside the straight line
    walls = '(name: "wall", points: [(0, -2), (0, 0.5)])'
    world = ml.World.parse(
        f'World(version: 1, name: "end", bounds: (min: (-2, -2), max: (2, 2)), walls: [{walls}], robots: [])'
    )
    line = math.sqrt(1.25 - 0.01)
    by_hand = 2 * (line + 0.1 * (math.atan2(0.5, 1) + math.atan2(0.1, line)))
    ends = ((-1.0, 0.0), (1.0, 0.0))
    path = ml.plan(world, *ends, robot=ml.Disc(0.1), planner="tangent-graph")
    assert by_hand - 1e-7 < path.length_bound <= by_hand <= path.length < by_hand + 1e-3
    first = ml.plan(world, *ends, robot=ml.Disc(0.1), planner="rrt", clearance=0)
    short = ml.plan(world, *ends, robot=ml.Disc(0.1), planner="rrt", clearance=0, shorten=True)
    assert by_hand <= short.length < first.length and short.verify() == short.clearance
    assert first.length_bound == path.length_bound
    arm = round_the_post()
    assert 1.5 < arm.length_bound < arm.length


def test_no_path_says_why_in_the_library_s_words():
    for ask, words in [
        (lambda: ml.plan("workbench", (1.0, 0.0), (3.1, 0.0), robot=ml.Reach()), "the start would overlap the block"),
        (lambda: ml.plan("apartment", (1.5, 5.75), (40.0, 1.0), robot=ml.Disc()), "the goal"),
    ]:
        with pytest.raises(ml.NoPath, match=words):
            ask()
    # that a planner is none for a robot says nothing of paths
    for ask, words in [
        (
            lambda: ml.plan("lot", (6.5, 2.5, 0), (6.75, 7, 0), robot=ml.Hitch(), planner="rrt"),
            "which no car can drive",
        ),
        (lambda: round_the_post(planner="bug1"), "this planner does not work here: it plans for discs in the plane"),
    ]:
        with pytest.raises(ml.Error, match=words):
            ask()
    assert issubclass(ml.NoPath, RuntimeError) and not issubclass(ml.NoPath, ValueError)
    closed = ml.World.from_shapes(boxes=[(4.0, 0.0, 5.0, 10.0)], bounds=(0, 0, 10, 10))
    with pytest.raises(ml.NoPath, match="the goal can't be reached: .* cells prove that obstacles part it"):
        ml.plan(closed, (2, 5), (8, 5), robot=ml.Disc(0.5), planner="cell-decomposition")


def test_what_is_no_problem_is_refused_with_the_reason():
    for ask, error, words in [
        (
            lambda: round_the_post(planner="rrt-conect"),
            ValueError,
            'there is no planner "rrt-conect"; there are rrt-connect, rrt, ',
        ),
        (
            lambda: ml.plan("workbench", (2.0, math.nan), (3.1, 0.0), robot=ml.Reach()),
            ml.ConfigurationError,
            "start is not finite",
        ),
        (lambda: ml.plan("workbench", (2.0, 0.0), (3.1,), robot=ml.Reach()), ValueError, "goal has 1 coordinate"),
        (
            lambda: ml.plan("workbench", np.zeros((2, 2)), (3.1, 0), robot=ml.Reach()),
            TypeError,
            "start is one configuration, not many",
        ),
        (lambda: ml.plan("workbench", *POST), TypeError, "a path is planned for a Checker, or for a World and robot="),
        (lambda: round_the_post(clearance=-1.0), ValueError, "clearance -1: it must be from 0 to 100 m"),
        (lambda: round_the_post(clearance=math.nan), ValueError, "clearance NaN"),
        (lambda: round_the_post(tube=2.0), ValueError, "tube 2: it must be from 0 to 1 m"),
        (lambda: round_the_post(budget=-1), ValueError, "budget -1"),
        (lambda: round_the_post(seed="x"), TypeError, "seed: a whole number, not str"),
    ]:
        with pytest.raises(error, match=words):
            ask()


def test_a_path_file_holds_the_legs_with_every_bit(tmp_path):
    path = round_the_post()
    path.write(tmp_path / "path.json")
    file = json.loads((tmp_path / "path.json").read_text())
    assert (file["version"], file["planner"], file["seed"], file["robot"]["kind"]) == (1, "rrt-connect", 2005, "reach")
    assert [leg["to"] for leg in file["legs"]] == path.corners[1:].tolist()
    assert [leg["steps"] for leg in file["legs"]] == [steps.tolist() for steps in path.certificates]
    assert (file["length"], file["clearance"], file["effort"]) == (path.length, path.clearance, path.effort)
    assert "growth" not in file
    path.write(tmp_path / "path.json", growth=True)
    growth = json.loads((tmp_path / "path.json").read_text())["growth"]
    assert len(growth["nodes"]) > 2 and all(len(edge) == 2 for edge in growth["edges"])
    mine = tmp_path / "mine.json"
    mine.write_text("{}")
    with pytest.raises(FileExistsError, match=r"mine\.json: this file is no path; overwrite=True replaces it"):
        path.write(mine)
    assert mine.read_text() == "{}"
    path.write(mine, overwrite=True)
    assert json.loads(mine.read_text())["version"] == 1


def test_what_was_grown_holds_the_path_and_is_a_graph_of_networkx(tmp_path):
    path = round_the_post()
    nodes, edges = path.growth
    path.write(tmp_path / "path.json", growth=True)
    file = json.loads((tmp_path / "path.json").read_text())["growth"]
    assert (nodes.tolist(), edges.tolist()) == (file["nodes"], file["edges"]) and nodes.shape[1] == edges.shape[1] == 2
    networkx = pytest.importorskip("networkx")
    graph = path.graph()
    assert isinstance(graph, networkx.Graph) and graph.number_of_nodes() == len(nodes)
    assert [graph.nodes[i]["q"] for i in range(len(nodes))] == [tuple(node) for node in nodes.tolist()]
    # two trees, which the path joins
    assert {frozenset(edge) for edge in graph.edges} == {frozenset(edge) for edge in edges.tolist()}
    parts = list(networkx.connected_components(graph))
    at = {tuple(node): number for number, node in enumerate(nodes.tolist())}
    assert len(parts) <= 2 and {POST[0], POST[1]} <= set(at)
    rover = ml.plan("apartment", (1.5, 5.75, 1.0), (4.5, 2.0, 0.0), robot=ml.Rusty(), planner="visibility-graph")
    assert rover.growth[0].shape[1] == 3 and not rover.growth[0][:, 2].any()


def test_an_arm_plays_its_path_to_the_goal_without_a_contact():
    run = round_the_post().play()
    states = run.states("Reach")
    assert (states["theta1"][0], states["theta2"][0]) == POST[0]
    # a script holds 2^-20 rad
    assert (states["theta1"][-1], states["theta2"][-1]) == pytest.approx(POST[1], abs=1e-6)
    assert states["contacts"][-1] == 0 and states["refusals"][-1] == 0 and run.verify()


def test_a_path_is_played_by_the_robot_that_it_was_planned_for():
    short = ml.Reach(lengths=(0.5, 0.4))
    run = ml.plan("workbench", (2.0, 0.0), (3.1, 0.0), robot=short).play()
    assert [resident.robot for resident in run.worlds[0].robots] == [short] and run.states("Reach")["contacts"][-1] == 0
    rover = ml.plan("apartment", (1.5, 5.75), (4.5, 2.0), robot=ml.Disc(0.2), tube=0.02).play()
    assert rover.worlds[0].robots[0].robot == ml.Rusty(0.2) and rover.verify()
    states = rover.states("Rusty")
    assert math.hypot(states["x"][-1] - 4.5, states["y"][-1] - 2.0) < 0.05 and states["contacts"][-1] == 0
    # within the tube no wall is touched: the nearest is as far as the path's clearance, or further
    poses = np.column_stack([states["x"], states["y"]])
    assert ml.Checker("apartment", ml.Disc(0.2)).distance(poses).min() > 0.0
    car = ml.plan("lot", (6.5, 2.5, 0.0, 0.0), (6.75, 7.0, -math.pi / 2, -math.pi / 2), robot=ml.Hitch(trailer=True))
    assert car.corners.shape[1] == 4 and car.play().states("Hitch")["contacts"][-1] == 0


def test_a_path_that_nobody_can_follow_is_not_played():
    thin = ml.plan("apartment", (1.5, 5.75), (9.75, 6.25), robot=ml.Disc(), planner="visibility-graph")
    with pytest.raises(ml.RunError, match=r"the robot strays 0\.001\d* m from the path, and the tube is 0\.001 m"):
        thin.play()


def test_a_path_shows_itself_in_a_notebook():
    path = round_the_post()
    assert "RRT-Connect" in path.plot().svg and path._repr_svg_() == path.plot().svg
    assert path._repr_html_().startswith('<img src="data:image/svg+xml;base64,')
    assert path.plot(theme="dark").svg != path.plot().svg
    assert repr(path).startswith(f"<Path of {len(path)} legs, {path.length:.3f} rad, by rrt-connect: clearance 0.")


def test_corners_from_elsewhere_are_a_path_with_its_proof(tmp_path):
    found = ml.plan("apartment", (1.5, 5.75), (9.75, 6.25), robot=ml.Disc())
    path = ml.Path.of("apartment", found.corners, robot=ml.Disc())
    assert path.corners.tobytes() == found.corners.tobytes() and path.planner == "corners"
    assert 0.0 < path.verify() == path.clearance and path.length == pytest.approx(found.length, abs=1e-12)
    assert (path.clearance_asked, found.clearance_asked) == (0.0, 0.001)
    # it is written, and played where there is room for it
    path.write(tmp_path / "path.json")
    assert json.loads((tmp_path / "path.json").read_text())["planner"] == "corners"
    arm = ml.Checker("workbench", ml.Reach())
    corners = [(2.0, 0.0), (2.0, 0.3), (2.2, 0.3)]
    assert ml.Path.of(arm, corners).play().verify()
    assert len(ml.Path.of(arm, np.array(corners))) == 2
    # through the post: which line, and what it hits
    with pytest.raises(ml.NoPath, match="leg 1 hits the post with part") as refused:
        ml.Path.of(arm, [(2.0, 0.3), (2.0, 0.0), (3.1, 0.0)])
    assert refused.value.effort["edges"] == 2 and refused.value.effort["free"] == 1
    # a clearance that is asked for is kept or refused
    clear = ml.Path.of(arm, corners).clearance
    assert ml.Path.of(arm, corners, clearance=0.9 * clear).clearance_asked == 0.9 * clear
    with pytest.raises(ml.NoPath):
        ml.Path.of(arm, corners, clearance=1.1 * clear)
    # a path that stays where it is is one, and true
    stays = ml.Path.of(arm, [(2.0, 0.0)])
    assert stays and stays.length == 0.0 and stays.verify() > 0.0
    for corners, error, words in [
        ([], ValueError, "corners is empty"),
        ((2.0, 0.0), ValueError, "corners has no axis"),
        ([(2.0, 0.0, 0.0)], ValueError, "corners has 3 coordinates"),
        ([(2.0, float("nan"))], ml.ConfigurationError, "corners is"),
        (7, TypeError, "iterable"),
    ]:
        with pytest.raises(error, match=words):
            ml.Path.of(arm, corners)
    with pytest.raises(ValueError, match="clearance -1"):
        ml.Path.of(arm, [(2.0, 0.0)], clearance=-1)
    with pytest.raises(ml.Error, match="no car can drive"):
        ml.Path.of("lot", [(6.5, 2.5, 0.0), (7.0, 2.5, 0.0)], robot=ml.Hitch())
