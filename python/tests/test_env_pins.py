"""What the tasks let robots observe and earn, by the digests that the library's own tests pin."""

import struct

import numpy as np
import pytest

from motion_lab.envs import VectorEnv

xxhash = pytest.importorskip("xxhash")

# crates/sim/tests/tasks/pins.rs
PINS = {"RustyGoal": "79618dd27e97cb81", "HitchPark": "d217519e69ec3e15", "ReachPost": "409931136ddbd1f4"}


def stream(seed, name, count):
    """The first draws in [0, 1) of the library's stream of this name: ChaCha with 8 rounds, keyed by two hashes."""
    name = name.encode()
    halves = [xxhash.xxh3_128_intdigest(text, seed=seed).to_bytes(16, "little") for text in (name, b"\0" + name)]
    key = np.frombuffer(halves[0] + halves[1], "<u4")
    blocks = -(-count // 8)
    start = np.zeros((16, blocks), np.uint32)
    start[:4] = np.frombuffer(b"expand 32-byte k", "<u4")[:, None]
    start[4:12] = key[:, None]
    start[12] = np.arange(blocks)
    x = start.copy()

    def quarter(a, b, c, d):
        for p, q, r, by in ((a, b, d, 16), (c, d, b, 12), (a, b, d, 8), (c, d, b, 7)):
            x[p] += x[q]
            turned = x[r] ^ x[p]
            x[r] = (turned << np.uint32(by)) | (turned >> np.uint32(32 - by))

    for _ in range(4):
        for i in range(4):
            quarter(i, 4 + i, 8 + i, 12 + i)
        for i in range(4):
            quarter(i, 4 + (i + 1) % 4, 8 + (i + 2) % 4, 12 + (i + 3) % 4)
    words = (x + start).T.reshape(-1).astype(np.uint64)
    bits = words[::2] | words[1::2] << np.uint64(32)
    return ((bits >> np.uint64(11)).astype(np.float64) * 2.0**-53)[:count]


@pytest.mark.parametrize("task", PINS)
def test_observations_rewards_and_ends_have_the_digests_of_the_library(task):
    actions = (-1.0 + 2.0 * stream(4, "pins", 200 * 6)).astype(np.float32).reshape(200, 3, 2)
    vec = VectorEnv(task, 3)
    vec.reset(seed=1)
    data = bytearray()
    for action in actions:
        seen, rewards, terminated, truncated, info = vec.step(action)
        reached = info.get("is_success", np.zeros(3, bool))
        for reward, ended, cut, has_reached in zip(rewards, terminated, truncated, reached, strict=True):
            end = 3 if cut else 0 if not ended else 1 if has_reached else 2
            data += struct.pack("<dB", reward, end)
        data += seen.astype("<f4").tobytes()
    assert xxhash.xxh3_64_hexdigest(bytes(data)) == PINS[task]
