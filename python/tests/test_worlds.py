"""Worlds: by name, out of files and texts, and out of arrays."""

import copy
import pickle

import numpy as np
import pytest

import motion_lab as ml

YARD = """World(version: 1, name: "Yard", bounds: (min: (0, 0), max: (8, 6)),
    walls: [(name: "the fence", points: [(0, 0), (8, 0), (8, 6)])],
    obstacles: [(name: "the tree", shape: Disc(center: (2, 3), radius: 0.4))],
    doors: [(name: "the gate", hinge: (4, 0), end: (5, 0), open: false),
            (name: "the hatch", hinge: (6, 1), end: (7, 1), open: true)],
    places: [(name: "home", pose: (x: 3, y: 5.5, theta: "90deg"))],
    robots: [(name: "Big", kind: "rusty", start: [3, 5.5, 0], disc: (radius: 0.25)),
             (name: "Arm", kind: "reach3", start: [1, 2, 3]),
             (name: "Puck", kind: "x-puck", start: [1])])
"""


def test_the_built_in_worlds_have_names():
    assert ml.world_names() == ["apartment", "workbench", "lot"]
    assert [ml.World(name).name for name in ml.world_names()] == ["Apartment", "Workbench", "Lot"]
    assert ml.World("apartment").bounds == (0.0, 0.0, 12.0, 8.0)
    assert ml.World("apartment") == ml.World("apartment") != ml.World("lot")


def test_a_name_that_no_world_has_is_refused_with_the_nearest_one():
    with pytest.raises(ml.WorldError) as refused:
        ml.World("Workbnech")
    assert str(refused.value) == 'no built-in world is named "Workbnech"; did you mean "workbench"?'
    assert (refused.value.path, refused.value.line, refused.value.column) == (None, None, None)
    assert isinstance(refused.value, ValueError) and isinstance(refused.value, ml.Error)
    with pytest.raises(ml.WorldError, match="there are apartment, workbench, lot, and World.read reads a file$"):
        ml.World("office")


def test_a_text_becomes_a_world_with_all_that_it_names():
    yard = ml.World.parse(YARD)
    assert (yard.name, yard.bounds) == ("Yard", (0, 0, 8, 6))
    # a closed door is an obstacle, an open one is none
    assert [o.name for o in yard.obstacles] == ["the fence", "the tree", "the gate"]
    assert [o.kind for o in yard.obstacles] == ["wall", "solid", "wall"]
    fence, tree, gate = (o.shapes for o in yard.obstacles)
    assert [s.vertices.tolist() for s in fence] == [[[0, 0], [8, 0]], [[8, 0], [8, 6]]]
    assert [(s.vertices.tolist(), s.radius) for s in tree] == [([[2, 3]], 0.4)]
    assert [(s.vertices.tolist(), s.radius) for s in gate] == [([[4, 0], [5, 0]], 0)]
    # the answers number the closed doors after the other obstacles
    assert ml.Checker(yard, ml.Disc()).witness((4.5, 0.3)).obstacle in (0, 2)
    assert yard.places == {"home": (3.0, 5.5, np.pi / 2)}
    big, arm, puck = yard.robots
    assert (big.name, big.kind, big.start, big.robot) == ("Big", "rusty", (3.0, 5.5, 0.0), ml.Rusty(0.25))
    assert (arm.robot, puck.robot) == (ml.Reach((0.6, 0.5, 0.4)), None)


def test_the_witness_of_a_closed_door_is_the_door():
    gate = '(name: "gate", hinge: (4, 0), end: (4, 5), open: false)'
    text = f'World(version: 1, name: "W", bounds: (min: (0, 0), max: (8, 6)), doors: [{gate}])'
    world = ml.World.parse(text)
    witness = ml.Checker(world, ml.Disc()).witness((3.0, 2.0))
    assert world.obstacles[witness.obstacle].name == "gate"


def test_what_is_wrong_in_a_text_is_told_by_line_and_column():
    tree = '(name: "the tree", shape: Disc(center: (1, 1), radius: 0))'
    text = f'World(version: 1, name: "yard", bounds: (min: (0, 0), max: (4, 3)),\n    obstacles: [{tree}])'
    with pytest.raises(ml.WorldError) as refused:
        ml.World.parse(text, name="yard.ron")
    error = refused.value
    assert (error.path, error.line, error.column) == ("yard.ron", 2, 17)
    assert str(error).startswith('yard.ron:2:17: obstacles[0] "the tree": radius 0 m')
    assert ml.World.parse(YARD).name == "Yard"
    again = pickle.loads(pickle.dumps(error))
    assert (type(again), str(again), again.line) == (ml.WorldError, str(error), 2)


def test_a_world_is_written_and_read_back_equal(tmp_path):
    yard = ml.World.parse(YARD)
    path = tmp_path / "yard.ron"
    yard.write(path)
    assert path.read_text() == str(yard)
    assert ml.World.read(path) == ml.World.read(str(path)) == yard
    assert hash(ml.World.read(path)) == hash(yard)
    for again in [pickle.loads(pickle.dumps(yard)), copy.deepcopy(yard), ml.World.parse(str(yard))]:
        assert again == yard and str(again) == str(yard)
    assert yard != str(yard) and yard != ml.World("lot")


def test_files_that_cannot_be_read_are_refused_as_python_refuses_them(tmp_path):
    with pytest.raises(FileNotFoundError) as refused:
        ml.World.read(tmp_path / "none.ron")
    assert refused.value.filename == str(tmp_path / "none.ron")
    with pytest.raises(IsADirectoryError):
        ml.World.read(tmp_path)
    with pytest.raises(OSError):
        ml.World("lot").write(tmp_path / "no" / "such" / "folder.ron")
    bytes_ = tmp_path / "bytes.ron"
    bytes_.write_bytes(b"World(\xff)")
    with pytest.raises(ml.WorldError, match="the file is not UTF-8 text$"):
        ml.World.read(bytes_)
    large = tmp_path / "large.ron"
    with large.open("wb") as file:
        file.truncate((32 << 20) + 1)
    with pytest.raises(ml.WorldError, match=f"a world file has at most {32 << 20} bytes$"):
        ml.World.read(large)
    broken = tmp_path / "broken.ron"
    broken.write_text("World(\n  version: 1,\n  name")
    with pytest.raises(ml.WorldError) as refused:
        ml.World.read(broken)
    assert (refused.value.path, refused.value.line) == (str(broken), 3)


def test_arrays_become_obstacles_in_their_order():
    world = ml.World.from_shapes(
        segments=np.array([[0, 0, 5, 5]], np.float32),
        boxes=np.asfortranarray([[0, 0, 1, 2], [3, 3, 4, 4]]),
        discs=[(7, 1, 0.5)],
        polygons=[[(6, 6), (8, 6), (7, 7), (8, 8), (6, 8)], np.array([(0, 7), (1, 7), (0, 8)])],
        name="Made",
    )
    assert [o.name for o in world.obstacles] == ["segment 1", "box 1", "box 2", "disc 1", "polygon 1", "polygon 2"]
    assert (world.name, world.bounds) == ("Made", (0, 0, 8, 8))
    assert world.obstacles[1].shapes[0].vertices.tolist() == [[0, 0], [1, 0], [1, 2], [0, 2]]
    assert len(world.obstacles[4].shapes) > 1, "a concave polygon is cut into convex ones"
    checker = ml.Checker(world, ml.Disc(radius=0.01))
    # inside the concave polygon, in its notch, in the disc, beside it
    assert checker.intersects([(6.3, 7), (7.8, 7), (7.4, 1), (7.6, 1)]).tolist() == [True, False, True, False]
    assert ml.World.parse(str(world)) == world
    pairs = ml.World.from_shapes(segments=[[(0, 0), (5, 5)]], boxes=[[(0, 0), (1, 2)], [(3, 3), (4, 4)]])
    assert [str(o.shapes[0].vertices) for o in pairs.obstacles] == [
        str(o.shapes[0].vertices) for o in world.obstacles[:3]
    ]


def test_occupied_cells_become_boxes_that_cover_them_and_nothing_else():
    occupied = np.random.default_rng(3).random((13, 17)) < 0.4
    for cells in [occupied, np.asfortranarray(occupied), occupied[::-1].copy()[::-1]]:
        world = ml.World.from_shapes(occupancy=cells, resolution=0.25, origin=(-1, 2))
        assert world.bounds == (-1, 2, -1 + 17 * 0.25, 2 + 13 * 0.25)
        point = ml.Checker(world, ml.Disc(radius=0.001))
        rows, columns = np.indices(occupied.shape)
        centres = np.stack([-1 + 0.25 * (columns + 0.5), 2 + 0.25 * (rows + 0.5)], axis=-1)
        np.testing.assert_array_equal(point.intersects(centres), occupied)
    assert len(ml.World.from_shapes(occupancy=np.ones((50, 40), bool), resolution=0.1).obstacles) == 1
    empty = ml.World.from_shapes(occupancy=np.zeros((5, 4), bool), resolution=0.5)
    assert (empty.obstacles, empty.bounds) == ((), (0, 0, 2, 2.5))


@pytest.mark.parametrize(
    ("shapes", "words"),
    [
        ({"discs": [(0, 0, 1), (3, 3, 0)]}, "discs[1]: radius 0 m: it must be finite, from 0.001 to 10000 m"),
        (
            {"discs": [(np.nan, 0, 1)]},
            "discs[0]: point (NaN, 0): coordinates must be finite and at most 10000 m in size",
        ),
        ({"segments": [(1, 1, 1, 1)]}, "segments[0]: from points[0] on: length 0 m: the smallest feature is 0.001 m"),
        ({"polygons": [[(0, 0), (1, 1), (0, 1), (1, 0)]]}, "polygons[0]: polygon: "),
        ({"polygons": [np.zeros((0, 2))]}, "polygons[0]: polygon: "),
        ({"segments": [(0, 0, 5, 0)]}, "bounds: length 0 m: the smallest feature is 0.001 m"),
        ({"bounds": (1, 1, 0, 0)}, "bounds: the box's corners are swapped"),
        ({"occupancy": np.ones((2, 2), bool), "resolution": 0.0}, "the boxes of occupancy[0]: length 0 m"),
        ({"occupancy": np.ones((2, 2), bool), "resolution": np.nan}, "the boxes of occupancy[0]: point (NaN, "),
        ({"boxes": np.full((2, 4), 1e300)}, "boxes[0]: point ("),
    ],
)
def test_what_no_world_may_hold_is_refused_by_its_number(shapes, words):
    with pytest.raises(ml.WorldError) as refused:
        ml.World.from_shapes(**shapes)
    assert str(refused.value).startswith(words)


@pytest.mark.parametrize(
    ("shapes", "words"),
    [
        ({"boxes": [(0, 0, 1)]}, "boxes has shape (1, 3), not (n, 4): min x, min y, max x, max y"),
        ({"discs": (0, 0, 1)}, "discs has shape (3,), not (n, 3): x, y, radius"),
        ({"discs": ["a"]}, "discs is no array of real numbers: its dtype is <U1"),
        ({"polygons": [[0, 1]]}, "a polygon has shape (2,), not (n, 2): x, y"),
        ({}, "a world without a shape needs bounds"),
        ({"discs": []}, "a world without a shape needs bounds"),
        (
            {"occupancy": [[1, 0]], "resolution": 1},
            "occupancy is no array of bool: say which cells are occupied, as `grid > 0.5` does",
        ),
        (
            {"occupancy": np.ones((2, 2)), "resolution": 1},
            "occupancy is no array of bool: say which cells are occupied, as `grid > 0.5` does",
        ),
        ({"occupancy": np.ones((2, 2), bool)}, "occupancy needs a resolution, the length of a cell's side in metres"),
        ({"occupancy": np.ones(4, bool), "resolution": 1}, "occupancy has shape (4,), not (rows, columns)"),
        (
            {"occupancy": np.ones((0, 4), bool), "resolution": 1},
            "occupancy has shape (0, 4): it has no cells, or too many",
        ),
    ],
)
def test_arrays_of_the_wrong_shape_are_refused_in_words(shapes, words):
    with pytest.raises(ValueError) as refused:
        ml.World.from_shapes(**shapes)
    assert str(refused.value) == words


def test_what_things_are_is_said_in_words_of_one_and_of_many():
    one = ml.World.from_shapes(boxes=[[0, 0, 1, 1]], bounds=(0, 0, 2, 2))
    assert repr(one) == '<World "World": 1 obstacle, 0 robots>'
    assert repr(one.obstacles[0]).endswith(": solid of 1 shape>")
    assert repr(ml.World("lot")).endswith("1 robot>")


def test_robots_live_in_worlds_of_arrays_too():
    empty = ml.World.from_shapes(boxes=[(2, 0, 3, 1)], bounds=(0, 0, 8, 6))
    world = empty.with_robot("Rover", ml.Rusty(0.2), (1, 2, 0)).with_robot("Arm", ml.Reach(), [0.5, 1])
    world = world.with_robot("Car", ml.Hitch(trailer=True, length=4.5), (5, 4, 0, 0))
    assert (empty.robots, [robot.name for robot in world.robots]) == ((), ["Rover", "Arm", "Car"])
    assert [robot.kind for robot in world.robots] == ["rusty", "reach", "hitch"]
    assert [robot.start for robot in world.robots] == [(1, 2, 0), (0.5, 1), (5, 4, 0, 0)]
    assert world.robots[0].robot == ml.Rusty(0.2) and world.robots[1].robot == ml.Reach()
    assert ml.World.parse(str(world)) == world == pickle.loads(pickle.dumps(world))
    # 20 ticks of 0.05 s at 0.6 m/s, its most, by wheels of 33 mm; its motion is noisy
    run = ml.record(world, ticks=20, script=[(1, "Rover", {"drive": (128, 0)})])
    state = run.states("Rover")[-1]
    assert state["left_wheel"] == pytest.approx(0.6 / 0.033, abs=1e-12) and run.verify()
    assert abs(state["x"] - 1.6) < 0.05 and state["in_contact"] == 0


def test_a_robot_that_a_world_has_no_room_for_is_refused():
    world = ml.World("apartment")
    taken = world.robots[0].name
    for name, robot, start, words in [
        (taken, ml.Rusty(), (1, 1, 0), "something in the world has this name already"),
        (world.obstacles[0].name, ml.Rusty(), (1, 1, 0), "something in the world has this name already"),
        (" Rover", ml.Rusty(), (1, 1, 0), "blanks"),
        ("R", ml.Rusty(), (1, 1), "start has 2 coordinates, a Rusty's configuration has 3: x, y, theta"),
        # neither gains a trailer nor loses one
        ("R", ml.Hitch(), (5, 4, 0, 0), "start has 4 coordinates, a Hitch's configuration has 3: x, y, theta"),
        ("R", ml.Hitch(trailer=True), (5, 4, 0), "start has 3 coordinates, a Hitch's configuration has 4"),
        ("R", ml.Rusty(), (1, 1, np.nan), "finite"),
        ("R", ml.Rusty(), (-1, 1, 0), "outside"),
        ("R", ml.Rusty(5.0), (6, 4, 0), "a diameter of 10 m"),
        ("R", ml.Reach(base=(20, 0)), (0, 0), "base"),
    ]:
        with pytest.raises(ml.WorldError, match=words):
            world.with_robot(name, robot, start)
    with pytest.raises(TypeError, match="a Disc has no wheels"):
        world.with_robot("R", ml.Disc(), (1, 1))
