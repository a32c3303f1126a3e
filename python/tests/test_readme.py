"""The code of the README runs from top to bottom."""

import contextlib
import io
import re
from pathlib import Path

import pytest

from motion_lab import _template

README = Path(__file__).parents[1] / "README.md"


def test_the_code_of_the_readme_runs_and_says_what_it_says(tmp_path, monkeypatch):
    for package in ("gymnasium", "pandas", "anywidget"):
        pytest.importorskip(package)
    if _template.usual() is None:
        pytest.skip("this wheel was built without Node.js: no pages")
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", README.read_text(), re.DOTALL)
    assert len(blocks) >= 6
    names: dict[str, object] = {}
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        for number, block in enumerate(blocks):
            exec(compile(block, f"README block {number}", "exec"), names)
    # the comments beside the code are its words
    assert 'no built-in world is named "apartmnt"; did you mean "apartment"?' in said.getvalue()
    assert "q has 3 coordinates, a Disc's configuration has 2: x, y" in said.getvalue()
    assert names["obs"].shape == (64, 363) and names["ranges"].shape == (1, 360)
    written = {"tour.mcap", "tour.svg", "tour.html", "mine.mcap", "episode.mcap"}
    assert {file.name for file in tmp_path.iterdir()} == written
