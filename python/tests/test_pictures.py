"""Worlds drawn: in notebooks and on the axes of matplotlib."""

import subprocess
import sys

import numpy as np
import pytest

import motion_lab as ml


def test_a_world_shows_itself_in_a_notebook():
    world = ml.World("workbench")
    assert "the post" in world._repr_svg_() and world.plot().svg == world._repr_svg_()
    assert world._repr_html_().startswith('<img src="data:image/svg+xml;base64,')


def test_a_world_is_drawn_on_axes_in_metres():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    from matplotlib import pyplot

    world = ml.World.from_shapes(
        boxes=[(1, 1, 3, 2)], discs=[(6, 4, 0.5)], segments=[(0, 0, 8, 0)], bounds=(0, 0, 8, 6), name="yard"
    )
    figure, ax = pyplot.subplots()
    assert world.draw(ax) is ax
    assert (ax.get_xlim(), ax.get_ylim(), ax.get_aspect()) == ((0.0, 8.0), (0.0, 6.0), 1.0)
    drawn = {}
    for collection in ax.collections:
        points = np.concatenate([path.vertices for path in collection.get_paths()])
        drawn.setdefault(collection.get_gid(), []).append((points.min(axis=0).tolist(), points.max(axis=0).tolist()))
    assert set(drawn) == {"box 1", "disc 1", "segment 1"}
    # filled, and stroked about the same edge
    assert drawn["box 1"] == [([1.0, 1.0], [3.0, 2.0])] * 2
    assert drawn["segment 1"] == [([0.0, 0.0], [8.0, 0.0])]
    for low, high in drawn["disc 1"]:
        assert low == pytest.approx([5.5, 3.5], abs=0.01) and high == pytest.approx([6.5, 4.5], abs=0.01)
    figure.canvas.draw()
    pyplot.close(figure)


def test_open_doors_are_drawn_dashed_across_their_gaps():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    from matplotlib import pyplot

    # of worlds/apartment.ron: (name: "door A", hinge: (2.5, 4.75), end: (3.375, 4.75), open: true)
    figure, ax = pyplot.subplots()
    ml.World("apartment").draw(ax)
    gap, leaf = [collection for collection in ax.collections if collection.get_gid() == "door A"]
    assert gap.get_paths()[0].vertices.tolist() == [[2.5, 4.75], [3.375, 4.75]]
    assert leaf.get_paths()[0].vertices.tolist() == [[2.5, 4.75], [2.5, 5.625]], "a quarter about its hinge"
    assert gap.get_linestyle()[0][1] is not None and leaf.get_linestyle()[0][1] is None
    pyplot.close(figure)


def test_runs_and_plans_load_neither_pandas_nor_matplotlib():
    code = (
        "import sys, motion_lab as ml; run = ml.record(ticks=1); run.states('Rusty'); run.plot();"
        "ml.plan('workbench', (2.0, 0.0), (3.1, 0.0), robot=ml.Reach()).plot();"
        "print([name for name in ('pandas', 'matplotlib', 'gymnasium') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
