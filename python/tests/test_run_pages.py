"""Runs as pages: the program's own, and in notebooks."""

import base64
import html
import re
import subprocess
import sys

import pytest

import motion_lab as ml
from motion_lab import _template

needs_template = pytest.mark.skipif(_template.usual() is None, reason="this wheel was built without Node.js: no pages")


@needs_template
def test_a_page_is_the_program_s_reads_as_the_run_and_is_a_template_itself(tmp_path):
    run = ml.record(ticks=40, seed=7)
    run.write(tmp_path / "run.mcap")
    export = [
        sys.executable,
        "-m",
        "motion_lab",
        "export",
        str(tmp_path / "run.mcap"),
        "-o",
        str(tmp_path / "run.html"),
    ]
    subprocess.run(export, check=True, capture_output=True)
    page = run.to_html()
    assert page == (tmp_path / "run.html").read_text()
    again = ml.read(tmp_path / "run.html")
    assert (again.digest, again.seed, again.ticks, again.has_frames) == (run.digest, 7, 40, False)
    assert again.verify() and again.to_html() == page
    assert run.to_html(template=tmp_path / "run.html") == page


@needs_template
def test_a_notebook_shows_a_run_as_its_page_with_the_picture_for_who_does_not_trust_it():
    run = ml.record(ticks=40, seed=7)
    shown = run._repr_html_()
    frame = re.fullmatch(r'<iframe srcdoc="([^"]*)" ([^>]*)>(<img [^>]*>)</iframe>', shown)
    assert html.unescape(frame[1]) == run.to_html() and 'title="A run of the motion lab"' in frame[2]
    assert frame[3] == run.plot()._repr_html_()
    digests = ml.record(ticks=40, seed=7, frames=False)
    assert digests._repr_svg_() is None and html.unescape(digests._repr_html_()).count(run.to_html()) == 1


@needs_template
def test_a_page_holds_no_name_as_markup():
    name = '"></iframe><script>alert(1)</script>'
    world = ml.World.from_shapes(boxes=[(1, 1, 2, 2)], bounds=(0, 0, 4, 4), name="yard")
    world = world.with_robot(name, ml.Rusty(), (3.0, 3.0, 0.0))
    run = ml.record(world, ticks=3)
    page = re.fullmatch(r'<iframe srcdoc="([^"]*)" [^"]*"[^"]*" [^<>]*><img [^<>]*></iframe>', run._repr_html_())[1]
    assert "alert(1)" not in html.unescape(page) == run.to_html()


def test_a_long_run_is_its_picture_in_a_notebook():
    # 3 robots: 50,001 ticks of a robot
    run = ml.record(ticks=16_667)
    assert run._repr_html_() == run.plot()._repr_html_()
    assert ml.record(ticks=16_667, frames=False)._repr_html_() is None


def test_without_a_template_a_notebook_has_the_picture_and_who_asks_is_told(monkeypatch, tmp_path):
    monkeypatch.setattr(_template, "usual", lambda: None)
    run = ml.record(ticks=4)
    shown = run._repr_html_()
    svg = base64.b64decode(shown.removeprefix('<img src="data:image/svg+xml;base64,').removesuffix('">'))
    assert svg.decode() == run.plot().svg
    with pytest.raises(FileNotFoundError, match="this package was built without the template"):
        run.to_html()
    with pytest.raises(FileNotFoundError, match=r"nowhere\.html"):
        run.to_html(template="nowhere.html")
    (tmp_path / "page.html").write_text("<html>")
    with pytest.raises(OSError, match=r"page\.html: it is no template of a run's page: it has no place for"):
        run.to_html(template=tmp_path / "page.html")
