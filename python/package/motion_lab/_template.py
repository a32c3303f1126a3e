"""The template of a run's page, which the wheel brings for the program and the package alike."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, files
from pathlib import Path


def usual() -> Path | None:
    """The file that was installed with the package, wherever the installer puts data; None where there is none."""
    try:
        installed = files("motion-lab") or []
    except PackageNotFoundError:
        return None
    found = (Path(str(file.locate())).resolve() for file in installed if file.name == "run-page.template")
    return next((file for file in found if file.is_file()), None)
