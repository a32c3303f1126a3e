"""Runs in a real JupyterLab in Chromium. Skipped without jupyterlab, nbclient, playwright or the browser."""

import contextlib
import os
import shutil
import socket
import subprocess
import sys
import time
import urllib.request

import pytest

import motion_lab as ml
from motion_lab import _template

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("jupyterlab")
playwright = pytest.importorskip("playwright.sync_api")
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
pytestmark = [
    pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium"),
    pytest.mark.skipif(_template.usual() is None, reason="this wheel was built without Node.js: no pages"),
]


@contextlib.contextmanager
def jupyterlab(folder):
    """Its address, while it serves a folder."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    options = ["--no-browser", "--allow-root", f"--port={port}", "--ServerApp.token=", "--ServerApp.password="]
    settings = dict(os.environ, JUPYTERLAB_WORKSPACES_DIR=str(folder / "workspaces"))
    server = subprocess.Popen(
        [sys.executable, "-m", "jupyterlab", *options], cwd=folder, env=settings, stderr=subprocess.DEVNULL
    )
    try:
        for _ in range(120):
            with contextlib.suppress(OSError):
                urllib.request.urlopen(f"http://127.0.0.1:{port}/api", timeout=5).close()
                break
            time.sleep(0.5)
        yield f"http://127.0.0.1:{port}/lab/tree"
    finally:
        server.terminate()
        try:
            server.wait(60)
        except subprocess.TimeoutExpired:
            server.kill()


def test_a_trusted_notebook_simulates_the_run_again_and_another_shows_its_picture(tmp_path):
    cell = nbformat.v4.new_code_cell("import motion_lab as ml\nml.record(seed=7, ticks=60)")
    notebook = nbformat.v4.new_notebook(cells=[cell])
    nbclient.NotebookClient(notebook, kernel_name="python3").execute()
    nbformat.write(notebook, tmp_path / "trusted.ipynb")
    subprocess.run([sys.executable, "-m", "jupyter", "trust", str(tmp_path / "trusted.ipynb")], check=True)
    # a signature is of what the notebook holds
    notebook.cells[0].source += "  # by somebody else"
    nbformat.write(notebook, tmp_path / "untrusted.ipynb")
    with jupyterlab(tmp_path) as address, playwright.sync_playwright() as play:
        browser = play.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        page = browser.new_page()
        page.goto(f"{address}/trusted.ipynb?reset")
        frame = page.frame_locator(".jp-OutputArea-output iframe")
        frame.locator("html[data-verdict]").wait_for(timeout=60_000)
        digest = ml.record(seed=7, ticks=60).digest
        assert frame.locator("#verdict").inner_text() == f"Verified: bit-identical, 60 of 60, digest {digest}."
        frame.locator("#line").fill("30")
        assert frame.locator("#shown").inner_text() == "tick 30, 1.50 s"
        page.goto(f"{address}/untrusted.ipynb?reset")
        picture = page.locator(".jp-OutputArea-output img")
        picture.wait_for(timeout=60_000)
        assert picture.evaluate("image => image.naturalWidth") > 400
        assert page.locator(".jp-OutputArea-output iframe").count() == 0
        browser.close()


# without it JupyterLab asks for a kernel first
KERNEL = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
CELLS = [
    "import motion_lab as ml\nrun = ml.record(seed=7, ticks=60)\nw = ml.Widget(run)\nw",
    "path = ml.plan('workbench', (2.0, 0.0), (3.1, 0.0), robot=ml.Reach())\np = ml.Widget(path)\np",
    "w.tick = 30",
    "w.playing = True",
    "print(w.tick, w.verdict, p.tick, p.verdict, w._simulator is p._simulator)",
]


def test_a_widget_s_state_is_read_and_set_by_the_notebook(tmp_path):
    pytest.importorskip("anywidget")
    cells = [nbformat.v4.new_code_cell(code) for code in CELLS]
    nbformat.write(nbformat.v4.new_notebook(cells=cells, metadata=KERNEL), tmp_path / "widgets.ipynb")
    with jupyterlab(tmp_path) as address, playwright.sync_playwright() as play:
        browser = play.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1200, "height": 1800})
        page.goto(f"{address}/widgets.ipynb?reset")
        page.locator(".jp-Notebook .jp-CodeCell").nth(4).wait_for(timeout=60_000)

        def run_cell(number):
            page.locator(".jp-CodeCell .jp-InputArea-editor").nth(number).click()
            page.keyboard.press("Control+Enter")

        def printed(number, words):
            output = page.locator(".jp-CodeCell").nth(number).locator(".jp-OutputArea-output", has_text=words)
            output.wait_for(timeout=30_000)

        first, second = (page.frame_locator("iframe").nth(i) for i in (0, 1))
        for number in (0, 1):
            run_cell(number)
        for frame in (first, second):
            frame.locator("html[data-verdict=verified]").wait_for(state="attached", timeout=60_000)
        ticks = ml.plan("workbench", (2.0, 0.0), (3.1, 0.0), robot=ml.Reach()).play().ticks
        run_cell(4)
        printed(4, f"60 verified {ticks} verified True")
        # set by the notebook
        run_cell(2)
        first.locator("html[data-tick='30']").wait_for(state="attached", timeout=30_000)
        assert first.locator("#shown").inner_text() == "tick 30, 1.50 s"
        # moved by the reader
        second.locator("#line").fill("12")
        second.locator("html[data-tick='12']").wait_for(state="attached", timeout=30_000)
        run_cell(4)
        printed(4, "30 verified 12 verified True")
        # played to its end
        run_cell(3)
        first.locator("html[data-tick='60']").wait_for(state="attached", timeout=30_000)
        run_cell(4)
        printed(4, "60 verified 12 verified True")
        page.screenshot(path=tmp_path / "widgets.png")
        browser.close()
