"""The example that learns: a few small generations of it, and what it writes."""

import importlib.util
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import motion_lab as ml


@pytest.fixture
def example():
    path = Path(__file__).parents[1] / "examples" / "learn.py"
    spec = importlib.util.spec_from_file_location("learn", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_sectors_hold_how_near_the_nearest_of_their_rays_is(example):
    seen = np.random.default_rng(1).uniform(0, 1, (3, 363)).astype(np.float32)
    inputs = example.inputs(seen)
    assert inputs.shape == (3, example.INPUTS + 1)
    assert all(inputs[i, k] == 1 - seen[i, 15 * k : 15 * k + 15].min() for i in range(3) for k in range(24))
    assert np.array_equal(inputs[:, 24:27], seen[:, 360:]) and (inputs[:, 27] == 1).all()


def test_a_policy_by_hand_reaches_more_goals_than_none(example):
    weights = np.zeros(example.COUNT, np.float32)
    first, second = weights[: 16 * 28].reshape(16, 28), weights[16 * 28 :].reshape(2, 17)
    first[0, 26], first[1, 27] = 1, 5  # the sine of the goal's bearing, and always 1
    second[0, 1], second[1, 0] = 0.3, 2  # ahead slowly, and toward the goal
    assert example.success(weights, 64).mean() > 0.05
    assert not example.success(np.zeros(example.COUNT, np.float32), 64).any(), "who stands reaches nothing"


def test_it_changes_what_it_knows_and_writes_pictures_and_logs_that_verify(example, tmp_path, monkeypatch):
    monkeypatch.setattr(example, "PAIRS", 16)
    monkeypatch.setattr(example, "TICKS", 40)
    before, after = example.learn(3)
    assert before.shape == after.shape == (example.COUNT,) and np.abs(after - before).max() > 0.01
    assert np.array_equal(example.learn(3)[1], after), "the same draws give the same weights"
    goals = []
    for name, weights in [("before", before), ("after", after)]:
        example.show(weights, example.HELD_OUT, name, tmp_path)
        run = ml.read(tmp_path / f"{name}.mcap")
        assert run.ticks > 0 and run.verify()
        svg = ElementTree.parse(tmp_path / f"{name}.svg").getroot()
        way = svg.findall(".//{*}polyline")[0].get("points").split()
        states = run.states("Rusty")
        assert way == [f"{state['x']:.3f},{state['y']:.3f}" for state in states[1:]]
        goals.append([circle.get("cx") for circle in svg.findall(".//{*}circle") if circle.get("r") == "0.25"])
    assert goals[0] == goals[1] and len(goals[0]) == 1, "the same goal"
    assert (tmp_path / "before.mcap").read_bytes() != (tmp_path / "after.mcap").read_bytes()
