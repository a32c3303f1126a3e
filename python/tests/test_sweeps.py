"""Sweeps: the tables are those of the program, whatever ran the shards; engines are used where they are installed."""

import concurrent.futures
import subprocess
import sys

import pytest

import motion_lab as ml
from motion_lab import sweeps

pd = pytest.importorskip("pandas")

STUDY = """Sweep(version: 1, worlds: ["apartment"], robots: ["Rusty"], ticks: 20, sensor: (rays: 8, range: 2),
    axes: [(vary: "seed", over: Range(18446744073709551610, 18446744073709551614)),
        (vary: "Rusty.start.x", over: Steps(2.5, 3.5, 3))])"""
ROWS = 12


def by_the_program(folder, study=STUDY):
    """The table of the program alone, as text."""
    (folder / "study.ron").write_text(study)
    for arguments in (["study.ron", "-o", "parts"], ["merge", "parts", "-o", "table.csv"]):
        command = [sys.executable, "-m", "motion_lab", "sweep", *arguments]
        subprocess.run(command, cwd=folder, check=True, capture_output=True)
    return (folder / "table.csv").read_text()


def same(table, text):
    """Every cell is what the text says, to the last bit."""
    head, *lines = text.splitlines()
    assert list(table.columns) == head.split(",") and len(table) == len(lines) == ROWS
    for row, line in zip(table.itertuples(index=False), lines, strict=True):
        for cell, written in zip(row, line.split(","), strict=True):
            if written == "":
                assert pd.isna(cell)
            elif isinstance(cell, float):
                assert cell == float(written), (cell, written)
            else:
                assert str(cell).lower() == written, (cell, written)


def test_a_table_is_that_of_the_program_and_shards_are_merged_to_the_same(tmp_path):
    text = by_the_program(tmp_path)
    whole = sweeps.sweep(STUDY, jobs=2)
    same(whole, text)
    assert whole["seed"].tolist() == [2**64 - 6 + k // 3 for k in range(ROWS)], "whole numbers stay whole"
    with concurrent.futures.ProcessPoolExecutor(2) as pool:
        parts = list(pool.map(sweeps.shard, [STUDY] * 5, range(1, 6), [5] * 5))
    same(sweeps.merge(reversed(parts)), text)
    # a path is looked for where the work is done
    same(sweeps.merge([sweeps.shard(tmp_path / "study.ron", k, 2) for k in (1, 2)]), text)
    same(sweeps.sweep(str(tmp_path / "study.ron")), text)


def test_parts_that_do_not_go_together_and_studies_that_are_none_are_errors(tmp_path):
    parts = [sweeps.shard(STUDY, k, 3) for k in (1, 2, 3)]
    other = sweeps.shard(STUDY.replace("ticks: 20", "ticks: 21"), 3, 3)
    damaged = parts[2][:-1] + bytes([parts[2][-1] ^ 1])
    for wrong in (parts[:2], [*parts[:2], other], [*parts[:2], damaged], []):
        with pytest.raises(ml.Error):
            sweeps.merge(wrong)
    with pytest.raises(ml.Error, match=r"study\.ron:1:.*sed"):
        sweeps.sweep("Sweep(version: 1, sed: 3)")
    with pytest.raises(ml.Error, match="none.ron"):
        sweeps.sweep(tmp_path / "none.ron")
    with pytest.raises(ml.Error, match="4/3"):
        sweeps.shard(STUDY, 4, 3)
    for run in (lambda: sweeps.sweep_on_dask(STUDY, shards=0, client=None), lambda: sweeps._numbers(-1)):
        with pytest.raises(ValueError, match="shards is"):
            run()


def test_dask_makes_the_same_table_and_raises_what_a_task_raises(tmp_path):
    distributed = pytest.importorskip("dask.distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            same(sweeps.sweep_on_dask(STUDY, shards=4, client=client), by_the_program(tmp_path))
            with pytest.raises(ml.Error, match="sed"):
                sweeps.sweep_on_dask("Sweep(version: 1, sed: 3)", shards=2, client=client)


def test_ray_makes_the_same_table_and_raises_what_a_task_raises(tmp_path):
    ray = pytest.importorskip("ray")
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    try:
        same(sweeps.sweep_on_ray(STUDY, shards=4), by_the_program(tmp_path))
        with pytest.raises(ml.Error, match="sed"):
            sweeps.sweep_on_ray("Sweep(version: 1, sed: 3)", shards=2)
    finally:
        ray.shutdown()
