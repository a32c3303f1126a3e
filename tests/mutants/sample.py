"""A sample of the small faults that cargo-mutants lists."""

import hashlib
import json
import subprocess
import sys
from pathlib import Path

VERSION = "26.2.0"
ROOMS = [f"crates/sim/src/{room}" for room in ("simulation", "plans", "export", "run")]
ROOMS += ["crates/core/src/planning", "crates/core/src/cspace", "src/batch"]


def listed(tools: Path, tree: Path) -> list[dict]:
    """Every fault that cargo-mutants can plant in the rooms. Ends with exit code 77 where it cannot be installed."""
    tool = tools / "bin/cargo-mutants"
    there = subprocess.run([tool, "--version"], capture_output=True, text=True).stdout if tool.exists() else ""
    if not there.endswith(f" {VERSION}\n"):
        install = "nice -n 19 cargo install --quiet --debug --locked cargo-mutants --root".split()
        if subprocess.run([*install, tools, "--target-dir", tools / "build", "--version", VERSION]).returncode:
            sys.exit(77)
    chosen = [word for room in ROOMS for word in ("--file", f"{room}/**/*.rs")]
    every = [tool, "mutants", "--no-config", "--workspace", "--list", "--json", *chosen]
    return json.loads(subprocess.check_output(every, cwd=tree))


def sampled(mutants: list[dict], count: int, seed: int) -> dict[int, dict]:
    """The faults whose hashes with the seed are the least, numbered from 1."""
    by_name = {mutant["name"]: mutant for mutant in mutants}
    names = sorted(by_name, key=lambda name: hashlib.sha256(f"{seed} {name}".encode()).digest())
    return {number: by_name[name] for number, name in enumerate(names[:count], 1)}
