"""Asks questions of 10,000 rows, for `python/cost`: KERNEL TIMES."""

import sys

import motion_lab as ml
import numpy as np

kernel, times = sys.argv[1], int(sys.argv[2])
ml.set_threads(1)
checker = ml.Checker("apartment", ml.Disc())
i = np.arange(10_000)
q = np.stack([0.6 + 10.8 * (i * 61 % 10_000) / 1e4, 0.5 + 7.0 * (i * 37 % 10_000) / 1e4], axis=1)
to = q + [0.2, 0.1]
flags, metres = np.empty(10_000, bool), np.empty(10_000)
asks = {
    "intersects": lambda: checker.intersects(q, out=flags),
    "distance": lambda: checker.distance(q, out=metres),
    "witness": lambda: checker.witness(q),
    "edge_free": lambda: checker.edge_free(q, to, out=flags),
}
for _ in range(times):
    asks[kernel]()
