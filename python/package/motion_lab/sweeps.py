"""Sweeps: many runs by a study, as a table; here, or a shard of them on each worker of an engine.

    from motion_lab.sweeps import sweep, sweep_on_dask, sweep_on_ray
    table = sweep("noise.ron")
    table = sweep_on_dask("noise.ron", shards=64, client=dask.distributed.Client("scheduler:8786"))
    table = sweep_on_ray("noise.ron", shards=64)

The runs are made by the program that the package brings. A row is a function of the study and its number, so that the
tables are equal to the last bit. `shard` and `merge` do the same with any other engine, as
`merge(executor.map(shard, [study] * n, range(1, n + 1), [n] * n))`.
"""

from __future__ import annotations

import csv
import math
import os
import subprocess
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path
from typing import Any

from ._core import Error

__all__ = ["Study", "merge", "shard", "sweep", "sweep_on_dask", "sweep_on_ray"]

Study = str | os.PathLike[str]
"""The text of a study, which has `Sweep(` in it, or the path of one.

A path, and the files that the study names, are looked for where the work is done: on the workers of an engine. A text
travels with its task, so that a study of built-in worlds needs no file system that they share.
"""


def sweep(study: Study, *, jobs: int | None = None) -> Any:
    """Run a study on this machine, and return its table, a `pandas.DataFrame` with a row for each run.

    `jobs` says how many runs at once, one for each processor without it; it changes no bit. The columns are those of
    docs/formats.md under The tables of sweeps, units in their names; a cell without a value is NaN. An interrupted
    sweep keeps nothing: `motion-lab sweep` keeps rows as they are made. Raises Error for a study that is none, with
    line and column; ImportError without pandas.
    """
    return merge([_part(study, [] if jobs is None else ["--jobs", str(jobs)])])


def shard(study: Study, number: int, of: int) -> bytes:
    """Run shard `number` of `of` shards, counted from 1, one run at a time, and return its sealed part.

    A pure function that pickles by its name: what an engine runs on a worker, and may run again. Raises as `sweep`.
    """
    return _part(study, ["--shard", f"{number}/{of}", "--jobs", "1"])


def merge(parts: Iterable[bytes]) -> Any:
    """Make one table of all parts of a study, in any order and of any sharding, proven complete.

    Raises Error where a row is missing, a seal is wrong, or parts are of two studies; ImportError without pandas.
    """
    pandas = import_module("pandas")
    with tempfile.TemporaryDirectory() as folder:
        parts = list(parts)
        for number, part in enumerate(parts):
            Path(folder, f"{number}.sweep").write_bytes(part)
        table = Path(folder, "table.csv")
        _program("sweep", "merge", folder, "-o", str(table))
        with open(table, encoding="utf-8", newline="") as lines:
            names, *rows = csv.reader(lines)
    cells = zip(*rows, strict=True)
    # a digest is a text, whatever its digits
    columns = (
        (name, column if name == "digest" else _column(column)) for name, column in zip(names, cells, strict=True)
    )
    return pandas.DataFrame({name: list(column) for name, column in columns})


def sweep_on_dask(study: Study, *, shards: int, client: Any) -> Any:
    """Run a study in shards as tasks of `client`, a `dask.distributed.Client`, and return its table.

    A shard should take a minute or more. A task that fails is tried again twice; what it raises then is raised here.
    """
    numbers = _numbers(shards)
    futures = client.map(shard, [study] * shards, numbers, [shards] * shards, retries=2, pure=False)
    return merge(client.gather(futures))


def sweep_on_ray(study: Study, *, shards: int) -> Any:
    """Run a study in shards as tasks of the cluster that Ray is connected to, or starts here, and return its table.

    A shard should take a minute or more. A task whose worker dies is tried again, as Ray does; what a task raises is
    raised here, in Ray's wrapping. Raises ImportError without Ray.
    """
    ray = import_module("ray")
    remote = ray.remote(shard)
    return merge(ray.get([remote.remote(study, number, shards) for number in _numbers(shards)]))


def _numbers(shards: int) -> range:
    if shards < 1:
        raise ValueError(f"shards is {shards}; there has to be one")
    return range(1, shards + 1)


def _part(study: Study, settings: list[str]) -> bytes:
    """The one part that the program makes of a study with these settings."""
    with tempfile.TemporaryDirectory() as folder, _file(study) as file:
        _program("sweep", str(file), "-o", folder, *settings)
        (part,) = Path(folder).glob("part-*.sweep")
        return part.read_bytes()


@contextmanager
def _file(study: Study) -> Iterator[Path]:
    if not (isinstance(study, str) and "Sweep" in study and "(" in study):
        yield Path(study)
        return
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "study.ron")
        file.write_text(study, encoding="utf-8")
        yield file


def _column(cells: tuple[str, ...]) -> list[Any]:
    """Cells as whole numbers, as floats, each bit for bit and NaN where there is none, as truth values, or as texts."""
    readers: list[Callable[[str], Any]] = [
        int,
        lambda cell: float(cell or "nan"),
        {"true": True, "false": False}.__getitem__,
    ]
    for read in readers:
        with suppress(ValueError, KeyError):
            return [read(cell) for cell in cells]
    return [cell or math.nan for cell in cells]


def _program(*arguments: str) -> None:
    """Runs the program that this package brings; its words are the error."""
    from .__main__ import program

    done = subprocess.run([program(), "--quiet", *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        raise Error(done.stderr.strip() or f"motion-lab ended with exit code {done.returncode}")
