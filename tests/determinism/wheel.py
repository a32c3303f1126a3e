"""Prints the lines of the runs whose logs lie in a folder, simulated again by the Python package: name, ticks, digest of the run."""

import pathlib
import sys

import motion_lab

lines = []
for path in pathlib.Path(sys.argv[1]).glob("*.mcap"):
    verified = motion_lab.read(path).verify()
    lines.append(f"{path.stem} {verified.recorded} {verified.digest}")
print("\n".join(sorted(lines)))
