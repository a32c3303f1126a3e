"""Runs under way: driven, moved back and ahead, restored, logged."""

import os
import subprocess
import sys
import textwrap
import threading

import numpy as np
import pytest

import motion_lab as ml

# of crates/sim/tests/pins: a run driven to tick 160, taken back to tick 100 and driven otherwise from there
BRANCHED = "dc4f780846f1c187aae6465571f64912"


def test_a_live_run_that_branches_has_the_pinned_digest():
    live = ml.Recorder(seed=100)
    assert live.step(40) == 40
    live.input("Rusty", drive=(128, 30))
    live.input("Hitch", trailer=True)
    live.step(50)
    live.input("Hitch", drive=(-90, 40))
    live.step(30)
    live.input("Reach", move_to=(2.0, 0.0))
    assert live.step(40) == live.tick == 160
    live.seek(100)
    live.input("Rusty", drive=(-128, 5))
    live.input("Hitch", drive=(128, -64))
    live.step(120)
    run = live.log()
    assert (run.ticks, run.digest, live.digest) == (220, BRANCHED, BRANCHED)
    assert run.verify().identical == 220 and live.tick == 220


@pytest.mark.parametrize("seed", range(8))
def test_a_run_step_by_step_is_the_recorded_run(seed):
    run = ml.record(ticks=60, seed=seed)
    live = ml.Recorder(seed=seed)
    for tick in range(61):
        assert live.frame == run.frame(tick)
        assert live.configuration("Reach") == tuple(run.states("Reach")[["theta1", "theta2"]][tick])
        live.step()
    live.seek(60)
    assert live.log() == run and live.digest == run.digest


def test_going_back_and_ahead_comes_to_the_same_frames():
    run = ml.record(ticks=300, seed=9)
    live = ml.Recorder(seed=9)
    for tick in [300, 10, 299, 0, 150, 151, 20, 300]:
        live.seek(tick)
        assert live.tick == tick and live.frame == run.frame(tick) and live.frame.digest == run.frame(tick).digest
    assert live.frame != run.frame(299)
    assert live.digest == run.digest


def test_a_frame_is_restored_and_goes_on_as_before():
    run = ml.record(ticks=40, seed=6)
    live = ml.Recorder(seed=6)
    live.step(40)
    live.restore(run.frame(15))
    assert live.tick == 15 and live.frame == run.frame(15)
    live.step(25)
    assert live.frame == run.frame(40)
    # a frame of another run, by robots, seed, settings or inputs, is refused, and nothing has moved
    driven = ml.record(ticks=40, seed=6, script=[(5, "Rusty", {"drive": (0, 128)})])
    for other in (ml.Recorder("apartment", seed=6), ml.Recorder(seed=7), ml.Recorder(seed=6, rays=12)):
        other.step(9)
        before = other.frame
        with pytest.raises(ml.RunError, match="^the frame of tick 15 is one of another run$"):
            other.restore(run.frame(15))
        assert other.frame == before and other.tick == 9
    live = ml.Recorder(seed=6)
    with pytest.raises(ml.RunError, match="another run"):
        live.restore(driven.frame(15))
    assert live.tick == 0
    live.restore(driven.frame(4))
    assert live.tick == 4, "before the input the runs are one"


def test_a_robot_s_state_is_that_of_the_log():
    live = ml.Recorder(seed=3, rays=12)
    live.input("Rusty", drive=(128, 0))
    live.step(80)
    states = live.log().states("Rusty")
    assert live.configuration("Rusty") == tuple(states[["x", "y", "theta"]][80])
    assert live.in_contact("Rusty") is bool(states["in_contact"][80])
    assert states["in_contact"].any() and states["manual"][1:].all() and not states["manual"][0]
    assert (states["channel0"][1:] == 128).all()
    assert live.scan("Rusty").tobytes() == live.log().scans("Rusty")[80].tobytes()
    assert live.scan("Rusty").shape == (12,) and live.robots == ("Rusty", "Reach", "Hitch")


def test_inputs_are_in_the_script_and_in_the_log():
    live = ml.Recorder("workbench", script=[(3, "Reach", {"move_to": (2.0, 0.0)})])
    live.step(4)
    live.input("Reach", move_to=np.array([2.0, 0.25]))
    live.input("Reach", teleport=[2.0, 0.5])
    live.step()
    live.input("Reach", release=True)
    live.step()
    lines = [line.strip() for line in live.script.splitlines() if "tick" in line]
    # a unit is 2^-20
    assert lines == [
        '(tick: 3, robot: "Reach", input: MoveTo([2097152, 0])),',
        '(tick: 5, robot: "Reach", input: MoveTo([2097152, 262144])),',
        '(tick: 5, robot: "Reach", input: Teleport([2097152, 524288])),',
        '(tick: 6, robot: "Reach", input: Release),',
    ]
    assert live.log().script == live.script
    assert ml.record("workbench", 6, script=live.script) == live.log()


def test_worlds_change_under_way():
    live = ml.Recorder("apartment", rays=0)
    doors = [
        line.split('name: "')[1].split('"')[0]
        for line in str(ml.World("apartment")).splitlines()
        if "hinge" in line or "open: true" in line
    ]
    assert doors, "the apartment has doors"
    before = len(live.worlds[0].obstacles)
    live.change("Apartment", close=doors[0])
    live.change("Apartment", add=("a crate", [(11.2, 0.5), (11.4, 0.5), (11.4, 0.7)], 0.0))
    live.step()
    names = [obstacle.name for obstacle in live.worlds[0].obstacles]
    assert doors[0] in names and "a crate" in names and len(names) == before + 2
    live.change("Apartment", open=doors[0])
    live.change("Apartment", move=("a crate", (0.0, 0.5, 0.0)))
    live.step()
    live.change("Apartment", remove="a crate")
    live.step()
    assert len(live.worlds[0].obstacles) == before
    assert live.log().verify().identical == 3 and live.log().script.count("world:") == 5


def test_what_no_script_could_hold_is_refused_and_changes_nothing():
    live = ml.Recorder()
    refused = [
        (lambda: live.input("Rusti", release=True), ml.RunError, 'there is no robot "Rusti"'),
        (lambda: live.input("Rusty", drive=(0, 129)), ml.RunError, "channel 129: it must be in -128 to 128"),
        (lambda: live.input("Rusty", drive=(0.5, 0)), TypeError, "drive: two whole numbers, each from -128 to 128"),
        (lambda: live.input("Rusty", drive=3), TypeError, "drive: two whole numbers"),
        (lambda: live.input("Rusty"), TypeError, "no input: it is one of drive, move_to, teleport, trailer, release"),
        (lambda: live.input("Rusty", drive=(1, 2), release=True), TypeError, "2 inputs at once"),
        (lambda: live.input("Rusty", release=False), ValueError, "release: it is True, or left out"),
        (lambda: live.input("Rusty", close="x"), TypeError, "close: a robot's input is one of"),
        (lambda: live.input("Reach", move_to=(float("nan"), 0)), ValueError, "move_to: NaN is no coordinate"),
        (lambda: live.input("Reach", move_to="far"), TypeError, "move_to: a configuration, as a list of numbers"),
        (lambda: live.input("Reach", move_to=()), ml.RunError, "0 coordinates: there must be 1 to 64"),
        (lambda: live.change("Apartmant", close="x"), ml.RunError, 'there is no world "Apartmant"'),
        (lambda: live.change("Apartment", close="x"), ml.RunError, 'there is no door "x" in world "Apartment"'),
        (lambda: live.change("Apartment", move="x"), TypeError, r"move: a tuple \(name, \(x, y, theta\)\)"),
        (lambda: live.change("Apartment", add=("x", [], 0.1)), ml.RunError, "0 coordinates: there must be 1 to 64"),
        (lambda: live.change("Apartment", drive=(1, 2)), TypeError, "drive: a change of a world is one of close"),
        (lambda: live.step(-1), ValueError, "n -1: it must be from 0"),
        (lambda: live.step(1 << 33), ml.RunError, "8589934592 ticks: at most 4294967296"),
        (lambda: live.seek(1 << 33), ml.RunError, "8589934592 ticks: at most 4294967296"),
        (lambda: live.seek(1.5), TypeError, "tick: a whole number, not float"),
        (lambda: live.configuration("X"), ml.RunError, 'the run has no robot "X"'),
        (lambda: live.scan("Reach"), IndexError, "Reach has 0 range sensors"),
        (lambda: ml.Recorder(seed=-1), ValueError, "seed -1"),
    ]
    for ask, error, words in refused:
        with pytest.raises(error, match=words):
            ask()
    assert "tick:" not in live.script and live.tick == 0


def test_what_only_the_tick_refuses_is_counted():
    live = ml.Recorder()
    assert live.refusals == (0, None) and not live.refusals
    live.input("Reach", teleport=(1.0, 0.0))  # onto the block, as driving.ron says
    live.step()
    count, first = live.refusals
    assert live.refusals and (live.refusals.total, live.refusals.first) == (count, first)
    assert count == 1 and first.startswith('tick 1: robot "Reach" refused Teleport: ')


def test_a_call_meanwhile_is_refused_and_neither_waits_nor_breaks():
    live = ml.Recorder()
    begun = threading.Event()
    refused = []

    def ask():
        begun.wait()
        while live_thread.is_alive() and not refused:
            try:
                live.robots.index("Rusty")
            except RuntimeError as error:
                refused.append(str(error))

    def work():
        begun.set()
        live.step(20_000)

    live_thread, asking = threading.Thread(target=work), threading.Thread(target=ask)
    asking.start()
    live_thread.start()
    live_thread.join()
    asking.join()
    assert refused == ["the run is at work in another call"] and live.tick == 20_000


def test_control_c_stops_a_log_and_leaves_the_run_where_it_stood():
    code = """
        import os, signal, threading, time
        import motion_lab as ml
        live = ml.Recorder("workbench", rays=0)
        live.step(300_000)
        frame, pressed = live.frame, []
        def press():
            pressed.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)
        threading.Timer(0.05, press).start()
        try:
            live.log()
            print("not stopped")
        except KeyboardInterrupt:
            print(f"{time.monotonic() - pressed[0]:.3f} {live.tick} {live.frame == frame}")
    """
    command = [sys.executable, "-c", textwrap.dedent(code)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True).stdout.split()
    # 0.1 s on a machine that does nothing else
    assert done[1:] == ["300000", "True"] and float(done[0]) < 1.0, done


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork here")
def test_a_forked_child_records_a_crowd_as_its_parent_does():
    bounds = "bounds: (min: (0, 0), max: (300, 2))"
    robots = ", ".join(f'(name: "r{i}", kind: "rusty", start: [{i}.5, 1, 0])' for i in range(300))
    world = ml.World.parse(f'World(version: 1, name: "row", {bounds}, walls: [], robots: [{robots}])')
    # from 256 robots on a tick is divided among threads, which do not survive a fork
    expected = ml.record(world, 3, rays=4).digest
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.write(writing, (ml.record(world, 3, rays=4).digest or "").encode())
        os._exit(0)
    os.close(writing)
    import select

    ready, _, _ = select.select([reading], [], [], 20)
    if not ready:
        os.kill(child, 9)
    os.waitpid(child, 0)
    assert ready and os.read(reading, 64).decode() == expected
