"""`Widget`, without a notebook; test_notebook.py has it in one."""

import subprocess
import sys

import pytest

import motion_lab as ml
from motion_lab import _template

traitlets = pytest.importorskip("traitlets")
pytest.importorskip("anywidget")
pytestmark = pytest.mark.skipif(_template.usual() is None, reason="this wheel was built without Node.js: no pages")


def test_a_widget_is_the_page_of_its_run_and_all_have_one_simulator():
    run = ml.record(seed=7, ticks=60)
    one, other = ml.Widget(run), ml.Widget(ml.record(seed=8, ticks=40), height=300)
    assert one._before + one._simulator.text + one._after == run.to_html()
    assert one._simulator is other._simulator and one._before != other._before
    assert len(one._simulator.text) > 500_000 > len(one._before) + len(one._after)
    assert (one.run, one.tick, one.playing, one.verdict, other.height) == (run, 60, False, "", 300)
    one._simulator.close()
    again = ml.Widget(run)
    assert again._simulator is not one._simulator and again._simulator is ml.Widget(run)._simulator


def test_a_path_is_played_and_a_world_s_robots_tour():
    path = ml.plan("workbench", (2.0, 0.0), (3.1, 0.0), robot=ml.Reach())
    assert ml.Widget(path).run == path.play()
    assert ml.Widget(ml.World("apartment")).run == ml.record("apartment")
    with pytest.raises(ValueError, match=r"world 'bare' has no robots, so nothing runs there: world\.plot\(\)"):
        ml.Widget(ml.World.from_shapes(discs=[(1, 1, 0.5)], name="bare"))
    with pytest.raises(TypeError, match="a Run, a Path or a World, not str"):
        ml.Widget("apartment")


def test_a_tick_is_one_that_the_run_has():
    widget = ml.Widget(ml.record(ticks=5))
    widget.tick = 0
    for tick in (-1, 6):
        with pytest.raises(traitlets.TraitError, match=f"there is no tick {tick}: they are 0 to 5"):
            widget.tick = tick
    assert widget.tick == 0


def test_without_anywidget_the_package_is_whole_and_says_what_the_widget_needs():
    code = (
        "import sys; sys.modules['anywidget'] = None\n"
        "from motion_lab import *\nimport motion_lab as ml\n"
        "try:\n    ml.Widget\nexcept ImportError as error:\n    print(error)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("motion_lab.Widget needs anywidget: pip install 'motion-lab[notebook]' (")
