"""The program that the wheel brings is the one that the module is part of."""

import subprocess
import sys

import motion_lab as ml


def program(*arguments):
    done = subprocess.run([sys.executable, "-m", "motion_lab", *arguments], capture_output=True, text=True, timeout=300)
    return done.returncode, done.stdout


def test_the_program_and_the_module_have_one_digest_for_64_seeds():
    code, said = program("record", "--seeds", "0..64")
    lines = [line.split() for line in said.splitlines()]
    assert code == 0 and [int(seed) for seed, _ in lines] == list(range(64))
    for seed, digest in lines:
        assert ml.record(seed=int(seed)).digest == digest
    assert len({digest for _, digest in lines}) == 64


def test_a_log_of_the_module_is_verified_by_the_program_and_a_failure_is_its_own(tmp_path):
    ml.record("apartment", ticks=30, seed=3).write(tmp_path / "run.mcap")
    code, said = program("verify", str(tmp_path / "run.mcap"))
    assert code == 0 and "30 of 30 ticks bit-identical" in said
    assert program("verify", str(tmp_path / "none.mcap"))[0] == 3
