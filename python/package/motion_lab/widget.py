"""A run in a cell of a notebook: `motion_lab.Widget`, with `motion-lab[notebook]`."""

from __future__ import annotations

import os
from pathlib import Path as FilePath

from ._core import Path, Run, World, record

try:
    import anywidget
    import ipywidgets  # type: ignore[import-untyped]
    import traitlets
except ImportError as error:
    raise ImportError(f"motion_lab.Widget needs anywidget: pip install 'motion-lab[notebook]' ({error})") from error

__all__ = ["Widget"]

# a page's text about its simulator, which is the same in every page of a template
_BEFORE = '<script type="text/plain" id="wasm">'
_AFTER = "</script>"


class _Simulator(ipywidgets.Widget):  # type: ignore[misc]
    """The simulator as pages hold it: a notebook has it once, however many widgets it has."""

    text = traitlets.Unicode().tag(sync=True)


_simulators: dict[str, _Simulator] = {}


def _simulator_of(text: str) -> _Simulator:
    kept = _simulators.get(text)
    # whoever closes all widgets closes this one too
    if kept is None or kept.comm is None:
        kept = _simulators[text] = _Simulator(text=text)
    return kept


def _run_of(shown: Run | Path | World) -> Run:
    if isinstance(shown, Run):
        return shown
    if isinstance(shown, Path):
        return shown.play()
    if isinstance(shown, World):
        if not shown.robots:
            raise ValueError(f"world {shown.name!r} has no robots, so nothing runs there: world.plot() is its picture")
        return record(shown)
    raise TypeError(f"a Run, a Path or a World, not {type(shown).__name__}")


class Widget(anywidget.AnyWidget):
    """A run in a cell, which the reader plays: of a path the run that plays it, of a world its robots' tour.

    The reader's browser simulates it again, without a network. The notebook reads and sets where it is:

        w = ml.Widget(run)
        w.tick = 600                             # the reader sees tick 600
        w.observe(lambda change: print(change["new"]), "tick")

    `verdict` is empty until the browser has simulated the run, then `"verified"`, `"differs"` or `"failed"`. `run` is
    the run. `height` is the cell's, in pixels, and `template` that of `Run.to_html`.

    Raises ValueError for a world without robots, TypeError for anything else than a run, a path or a world, and what
    `Run.to_html` and `Path.play` raise. Setting a tick that the run has not raises `traitlets.TraitError`.
    """

    _esm = FilePath(__file__).with_name("widget.js")
    _before = traitlets.Unicode().tag(sync=True)
    _after = traitlets.Unicode().tag(sync=True)
    _simulator = traitlets.Instance(_Simulator).tag(sync=True, **ipywidgets.widget_serialization)
    height = traitlets.Int(640).tag(sync=True)
    tick = traitlets.Int().tag(sync=True)
    playing = traitlets.Bool(False).tag(sync=True)
    verdict = traitlets.Unicode("").tag(sync=True)

    def __init__(
        self, shown: Run | Path | World, *, template: str | os.PathLike[str] | None = None, height: int = 640
    ) -> None:
        self.run = _run_of(shown)
        before, _, rest = self.run.to_html(template=template).partition(_BEFORE)
        text, _, after = rest.partition(_AFTER)
        parts = {"_before": before + _BEFORE, "_simulator": _simulator_of(text), "_after": _AFTER + after}
        super().__init__(**parts, height=height, tick=self.run.ticks)

    @traitlets.validate("tick")
    def _has_tick(self, proposal: dict[str, int]) -> int:
        if 0 <= proposal["value"] <= self.run.ticks:
            return proposal["value"]
        raise traitlets.TraitError(f"there is no tick {proposal['value']}: they are 0 to {self.run.ticks}")
