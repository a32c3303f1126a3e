"""Planning problems by a seed."""

import numpy as np
import pytest

import motion_lab as ml


def joined(problem: ml.Problem, columns: int, rows: int) -> set[tuple[int, int]]:
    """The cells of a maze that the rover gets to from the first, along lines between their middles."""
    checker = ml.Checker(problem.world, ml.Disc(0.1))
    middle = lambda cell: [cell[0] + 0.5, cell[1] + 0.5]  # noqa: E731
    seen, open_cells = set(), [(0, 0)]
    while open_cells:
        cell = open_cells.pop()
        if cell in seen:
            continue
        seen.add(cell)
        x, y = cell
        for other in [(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)]:
            is_cell = 0 <= other[0] < columns and 0 <= other[1] < rows
            if is_cell and checker.edge_free(middle(cell), middle(other)):
                open_cells.append(other)
    return seen


def test_a_maze_is_as_it_is_said_to_be() -> None:
    for number in range(6):
        problem = ml.Problem.generate("maze", seed=3, number=number, columns=5, rows=4)
        assert (problem.has_path, len(joined(problem, 5, 4))) == (True, 20)
        assert (problem.start[:2], problem.goal[:2]) == ((0.5, 0.5), (4.5, 3.5))
        closed = ml.Problem.generate("maze", seed=3, number=number, columns=5, rows=4, closed=True)
        assert closed.has_path is False
        cells = joined(closed, 5, 4)
        assert (0, 0) in cells and (4, 3) not in cells


def test_problems_of_every_kind_are_planned_and_are_the_same_again() -> None:
    asked = [
        ("circles", {}),
        ("circles", {"robot": "reach3"}),
        ("circles", {"robot": "hitch", "circles": np.int64(5)}),
        ("maze", {"columns": 3, "rows": 3}),
        ("passage", {"width": 0.4}),
        ("parking", {"parked": 0}),
        ("warehouse", {"robots": 80}),
    ]
    for kind, settings in asked:
        problem = ml.Problem.generate(kind, seed=2, **settings)
        again = ml.Problem.generate(kind, seed=2, number=0, **settings)
        assert (problem.world, problem.start, problem.goal) == (again.world, again.start, again.goal)
        assert problem.world != ml.Problem.generate(kind, seed=2, number=1, **settings).world
        assert len(problem.start) == len(problem.robot.coordinates) == len(problem.goal)
        checker = ml.Checker(problem.world, problem.robot)
        assert checker.distance(problem.start) > 0.05 and checker.distance(problem.goal) > 0.05
        path = ml.plan(problem.world, problem.start, problem.goal, robot=problem.robot)
        assert path.length > 0
        [resident] = problem.world.robots
        assert resident.start == problem.start
    assert len(problem.world.obstacles) > 10 and problem.has_path is None
    assert repr(problem) == '<Problem "warehouse 1 of seed 2": Rusty>'


def test_the_numbers_of_a_passage_are_metres() -> None:
    narrow, same, wide = (ml.Problem.generate("passage", width=width) for width in (0.21, 0.22, 0.23))
    told = (narrow.has_path, same.has_path, wide.has_path)
    assert told == (False, None, True), "Rusty is 22 cm wide, and rounding decides for a gap as wide as that"
    with pytest.raises(ml.NoPath):
        ml.plan(narrow.world, narrow.start, narrow.goal, robot=narrow.robot, planner="visibility-graph")
    assert ml.plan(wide.world, wide.start, wide.goal, robot=wide.robot, planner="visibility-graph").length > 0


def test_what_there_is_not_is_refused_in_words() -> None:
    with pytest.raises(ml.Error, match=r"no problems are called 'mase'.*|no problems are called \"mase\"; .*maze"):
        ml.Problem.generate("mase")
    with pytest.raises(ml.Error, match="^maze: unknown field `columnz`, expected one of `columns`, `rows`"):
        ml.Problem.generate("maze", columnz=3)
    with pytest.raises(ml.Error, match="^maze: columns 1: it must be from 2 to 200$"):
        ml.Problem.generate("maze", columns=1)
    with pytest.raises(ml.Error, match="^maze: .*invalid type"):
        ml.Problem.generate("maze", columns="three")
    with pytest.raises(ml.Error, match="has no room"):
        ml.Problem.generate("circles", circles=400, radius=[2, 2])
    with pytest.raises(TypeError):
        ml.Problem.generate("maze", columns=object())
    with pytest.raises(TypeError):
        ml.Problem.generate("maze", number=1.5)
