"""Recorded runs: the digests that the repository pins, states, files, verification, comparison, pictures."""

import base64
import csv
import io
import math
import os
import pickle
import subprocess
import sys
import zlib
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import motion_lab as ml

ROOT = Path(__file__).parents[2]
SAMPLES = ROOT / "tests" / "samples"

# run digests that crates/sim/tests/pins pins
TOUR = "f745674b9949ddd86153036592511806"
DRIVING = "79a1486a47c698e1eb8180aeb24a7be0"
EIGHT = "cd5024290592d15c84eb14ab41dc5ec1"
TRAILER = "e666c13ff444e7c43f692fb6b98ea608"

# the inputs of the pinned run of eight robots
EIGHT_INPUTS = [
    (1, "Anna", {"drive": (96, -10)}),
    (1, "Bert", {"drive": (128, 20)}),
    (1, "Finn", {"drive": (-64, 90)}),
    (1, "Dora", {"drive": (100, 40)}),
    (20, "Gina", {"drive": (128, 0)}),
    (30, "Hugo", {"drive": (-128, -33)}),
    (60, "Cleo", {"move_to": (1.5, -0.75)}),
    (90, "Emil", {"move_to": [-1.25, 0.5, 2.0]}),
    (120, "Bert", {"drive": (-128, -60)}),
    (150, "Anna", {"release": True}),
    (180, "Finn", {"drive": (128, 0)}),
]

# those of the pinned run of trailer and teleport
TRAILER_INPUTS = [
    (5, "Hitch", {"trailer": True}),
    (6, "Hitch", {"drive": (80, 48)}),
    (60, "Hitch", {"drive": (-64, -20)}),
    (100, "Hitch", {"teleport": (5.5, 2.25, -0.0625, 0.125)}),
    (100, "Rusty", {"teleport": (6.0, 4.0, 1.0)}),
    (100, "Reach", {"teleport": np.array([-1.0, 0.5])}),
    (140, "Hitch", {"trailer": False}),
    (150, "Hitch", {"release": True}),
]


@pytest.fixture(scope="module")
def tour():
    return ml.record()


def test_the_tour_has_the_digest_that_the_program_prints(tour):
    assert tour.digest == TOUR
    assert (tour.seed, tour.ticks, tour.robots, tour.has_frames) == (2005, 1200, ("Rusty", "Reach", "Hitch"), True)
    assert [world.name for world in tour.worlds] == ["Apartment", "Workbench", "Lot"]
    assert TOUR in repr(tour)


def test_a_script_by_its_file_or_its_text_gives_the_pinned_run():
    path = ROOT / "tests" / "scripts" / "driving.ron"
    assert ml.record(script=path).digest == DRIVING
    assert ml.record(script=str(path)).digest == DRIVING
    assert ml.record(script=path.read_text()).digest == DRIVING


def test_inputs_in_a_list_give_the_pinned_runs():
    eight = ml.record(ml.World.read(SAMPLES / "eight.ron"), 400, seed=8, script=EIGHT_INPUTS, rays=90, range=6.0)
    assert eight.digest == EIGHT
    assert ml.record(ticks=240, seed=11, script=TRAILER_INPUTS).digest == TRAILER
    # the script of a run is what records it again
    assert ml.record(
        ticks=240, seed=11, script=ml.record(ticks=240, seed=11, script=TRAILER_INPUTS).script
    ) == ml.record(ticks=240, seed=11, script=TRAILER_INPUTS)


def test_a_digest_log_has_the_digest_of_the_frames_and_none_of_them(tmp_path):
    run = ml.record(frames=False)
    assert (run.digest, run.has_frames, run.ticks) == (TOUR, False, 1200)
    assert run._repr_svg_() is None
    run.write(tmp_path / "digests.mcap")
    assert (tmp_path / "digests.mcap").stat().st_size < 60_000
    verification = ml.read(tmp_path / "digests.mcap").verify()
    assert (verification.recorded, verification.identical, verification.digest) == (1200, 1200, TOUR)
    for ask in [
        lambda: run.states("Rusty"),
        lambda: run.scans("Rusty"),
        lambda: run.frame(0),
        run.to_csv,
        run.to_pandas,
        run.plot,
        lambda: run.diff(run),
    ]:
        with pytest.raises(ml.LogError, match="this is a digest log, which holds no frames"):
            ask()


def test_many_robots_are_kept_as_digests_unless_frames_are_asked_for():
    bounds = "bounds: (min: (0, 0), max: (101, 2))"
    robots = ", ".join(f'(name: "r{i}", kind: "rusty", start: [{i}.5, 1, 0])' for i in range(101))
    world = ml.World.parse(f'World(version: 1, name: "row", {bounds}, walls: [], robots: [{robots}])')
    assert not ml.record(world, 2, rays=0).has_frames
    run = ml.record(world, 2, rays=0, frames=True)
    assert run.has_frames and len(run.robots) == 101
    assert run.digest == ml.record([world], 2, rays=0).digest


def table(run, **how):
    """The rows of the CSV export, by Python's own reader."""
    return list(csv.DictReader(io.StringIO(run.to_csv(**how))))


@pytest.mark.parametrize("robot", ["Rusty", "Reach", "Hitch"])
def test_states_are_the_columns_of_the_csv_bit_for_bit(tour, robot):
    states = tour.states(robot)
    rows = [row for row in table(tour) if row["robot"] == robot]
    assert states.shape == (1201,) and len(rows) == 1201 and states.flags.writeable
    by_field = {name.removesuffix("_rad").removesuffix("_m").removesuffix("_s"): name for name in rows[0]}
    numbers = {
        np.dtype("i8"): int,
        np.dtype("f8"): float,
        np.dtype("?"): lambda text: {"true": True, "false": False}[text],
    }
    for field in states.dtype.names:
        dtype = states.dtype[field]
        cells = [row[by_field[field]] for row in rows]
        expected = [math.nan if cell == "" else numbers[dtype](cell) for cell in cells]
        assert states[field].tobytes() == np.array(expected, dtype).tobytes(), field
    # what is left out is the name and the number of the robot, and what its kind has not
    empty = {name for name in rows[0] if all(row[name] == "" for row in rows)}
    assert set(rows[0]) - empty - {"id", "robot"} <= {by_field[field] for field in states.dtype.names}


def test_states_have_the_fields_of_the_robot_s_kind(tour):
    driven = ("channel0", "channel1", "manual", "in_contact", "contacts", "flash", "refusals")
    assert set(driven) < set(tour.states("Rusty").dtype.names)
    assert tour.states("Rusty").dtype.names[:8] == (
        *("tick", "time", "x", "y", "theta"),
        *("left_wheel", "right_wheel", "waypoint"),
    )
    assert tour.states("Reach").dtype.names[:4] == ("tick", "time", "theta1", "theta2")
    hitch = tour.states("Hitch")
    assert hitch.dtype.names[2:6] == ("x", "y", "theta", "psi") and np.isnan(hitch["psi"]).all()
    trailed = ml.record(ticks=160, seed=11, script=TRAILER_INPUTS).states("Hitch")
    assert [bool(np.isnan(trailed["psi"][tick])) for tick in (4, 5, 139, 140)] == [True, False, False, True]
    assert (trailed["x"][100], trailed["manual"][4], trailed["manual"][5]) == (pytest.approx(5.5, abs=0.2), False, True)


def test_scans_are_the_ranges_of_the_csv_bit_for_bit():
    run = ml.record(ticks=20, seed=3, rays=24)
    rows = [row for row in table(run, ranges=True) if row["robot"] == "Rusty"]
    expected = np.array([[float(row[f"range{i}_m"]) for i in range(24)] for row in rows])
    scans = run.scans("Rusty")
    assert scans.shape == (21, 24) and scans.dtype == np.float64 and scans.flags.c_contiguous
    assert scans.tobytes() == expected.tobytes()
    assert np.isinf(ml.record(ticks=1, range=0.5).scans("Rusty")).any()


def test_several_sensors_of_a_robot_are_told_apart_by_number():
    sensors = '[(name: "back", rays: 7, range: 3), (name: "front", rays: 5, range: 3)]'
    text = str(ml.World("apartment")).replace('kind: "rusty",', f'kind: "rusty", sensors: {sensors},', 1)
    run = ml.record(ml.World.parse(text), 2, rays=9)
    assert [run.scans("Rusty", sensor).shape for sensor in range(3)] == [(3, 9), (3, 7), (3, 5)]
    with pytest.raises(IndexError, match="Rusty has 3 range sensors: there is no number 3"):
        run.scans("Rusty", 3)


def test_a_table_for_pandas_has_the_columns_of_the_csv_bit_for_bit(tour):
    pandas = pytest.importorskip("pandas")
    frame = tour.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and len(frame) == 3 * 1201
    assert list(frame.columns) == tour.to_csv().splitlines()[0].split(",")
    read = pandas.read_csv(io.StringIO(tour.to_csv()))
    pandas.testing.assert_frame_equal(frame, read, check_exact=True)
    ranges = ml.record(ticks=1, rays=3).to_pandas(ranges=True)
    assert list(ranges.columns)[-3:] == ["range0_m", "range1_m", "range2_m"]
    # Reach and Hitch have no sensor
    assert ranges["range0_m"].isna().tolist() == [False, True, True] * 2


def test_a_run_verifies_all_its_ticks_and_is_read_back_equal(tour, tmp_path):
    verification = tour.verify()
    assert verification and verification.difference is None
    assert repr(verification) == f"Verification(recorded=1200, identical=1200, digest='{TOUR}')"
    tour.write(tmp_path / "tour.mcap")
    read = ml.read(tmp_path / "tour.mcap")
    assert read == tour and read.digest == TOUR and read.verify().identical == 1200
    assert (tmp_path / "tour.mcap").read_bytes() == bytes(tour)
    assert ml.Run.from_bytes(bytes(tour)) == tour
    assert os.listdir(tmp_path) == ["tour.mcap"]


def test_a_log_of_before_is_read_and_verifies():
    for name, ticks in [("format_1.mcap", 12), ("format_2.mcap", 12)]:
        run = ml.read(SAMPLES / name)
        assert (run.ticks, run.verify().identical, bool(run.verify())) == (ticks, ticks, True)


def test_a_run_travels_to_another_process_by_pickle():
    run = ml.record(ticks=5, seed=4)
    copied = pickle.loads(pickle.dumps(run))
    assert copied == run and hash(copied) == hash(run) and copied is not run
    assert run != ml.record(ticks=5, seed=5) and run != "a run"


def test_a_log_with_a_changed_byte_is_refused(tmp_path):
    data = bytearray(bytes(ml.record(ticks=40)))
    data[len(data) // 2] ^= 1
    (tmp_path / "forged.mcap").write_bytes(data)
    with pytest.raises(
        ml.LogError, match=r"forged\.mcap: the log has been changed after byte \d+: \d+ of 40 ticks are whole"
    ):
        ml.read(tmp_path / "forged.mcap")
    with pytest.raises(ml.LogError, match="the log is cut off after byte"):
        ml.Run.from_bytes(bytes(data[: len(data) // 4]))
    with pytest.raises(ml.LogError, match="this is not a run log"):
        ml.read(SAMPLES / "eight.ron")


def records(data):
    """The records of an MCAP file, as docs/formats.md describes them: where each begins, its opcode, its content."""
    at = 8
    while at + 9 <= len(data) - 8:
        length = int.from_bytes(data[at + 1 : at + 9], "little")
        yield at, data[at], data[at + 9 : at + 9 + length]
        at += 9 + length


def test_a_log_that_was_forged_with_its_seals_is_read_and_differs(tmp_path):
    xxhash = pytest.importorskip("xxhash")
    run = ml.record(frames=False)
    data = bytearray(bytes(run))
    data_end, seal, digests = 0x0F, 0x80, 0x81
    minute = [at for at, opcode, _ in records(bytes(data)) if opcode == digests][1]
    # the record holds its last tick, then the digest of each second: forge that of the third
    third = minute + 9 + 8 + 8 * 2
    data[third] ^= 1
    for at, opcode, content in records(bytes(data)):
        if opcode == seal and at > third:
            assert int.from_bytes(content[8:16], "little") == at
            data[at + 9 + 16 : at + 9 + 32] = xxhash.xxh3_128_intdigest(bytes(data[:at])).to_bytes(16, "little")
        if opcode == data_end:
            data[at + 9 : at + 13] = zlib.crc32(data[:at]).to_bytes(4, "little")
    (tmp_path / "forged.mcap").write_bytes(data)
    forged = ml.read(tmp_path / "forged.mcap")
    verification = forged.verify()
    assert not verification and (verification.recorded, verification.identical) == (1200, 40)
    assert verification.difference.startswith("second 3, ticks 41 to 60: the digest is ")
    assert verification.digest == TOUR and "difference=" in repr(verification)


def test_a_difference_says_settings_ticks_and_the_first_value(tour):
    same = tour.diff(ml.record())
    assert not same and (same.ticks, same.differing, same.setup, same.tick, same.first) == (1200, 0, [], None, None)
    assert str(same) == "1200 ticks, equal to the last bit"
    other = tour.diff(ml.record(ticks=50, seed=7))
    assert other and (other.ticks, other.tick) == (50, 1)
    assert other.setup == [("seed", "2005", "7"), ("ticks", "1200", "50")]
    first = [run.states("Rusty")["x"][1].item() for run in (tour, ml.record(ticks=1, seed=7))]
    assert f"tick 1, robot 0, configuration[0]: expected {first[0]!r} (" in other.first
    assert f"found {first[1]!r} (" in other.first
    assert str(other).splitlines()[:2] == ["seed: 2005 here, 7 there", "ticks: 1200 here, 50 there"]
    driven = tour.diff(ml.record(script=[(600, "Reach", {"teleport": (-1.0, 0.5)})]))
    assert driven.tick == 600 and driven.differing == 601


def test_a_file_that_is_no_log_is_replaced_only_when_asked(tmp_path):
    run = ml.record(ticks=2)
    mine = tmp_path / "thesis.tex"
    mine.write_text("years of work")
    with pytest.raises(FileExistsError, match=r"thesis\.tex: this file is no run log; overwrite=True replaces it"):
        run.write(mine)
    assert mine.read_text() == "years of work"
    run.write(mine, overwrite=True)
    assert ml.read(mine) == run
    ml.record(ticks=3).write(mine)
    assert ml.read(mine).ticks == 3, "an older log is replaced"
    with pytest.raises(FileNotFoundError):
        run.write(tmp_path / "no folder" / "run.mcap")
    with pytest.raises(IsADirectoryError):
        run.write(tmp_path, overwrite=True)
    assert os.listdir(tmp_path) == ["thesis.tex"]


def test_a_picture_is_an_svg_that_notebooks_show(tour, tmp_path):
    picture = tour.plot(600)
    assert ElementTree.fromstring(picture.svg).tag == "{http://www.w3.org/2000/svg}svg"
    assert "tick 600 of 1200 (30.00 s)" in picture.svg and TOUR in tour.plot().svg
    html = picture._repr_html_()
    start = '<img src="data:image/svg+xml;base64,'
    assert html.startswith(start) and html.endswith('">')
    assert base64.b64decode(html[len(start) : -2]).decode() == picture.svg == picture._repr_svg_()
    picture.save(tmp_path / "tour.svg")
    assert (tmp_path / "tour.svg").read_text() == picture.svg
    assert tour.plot(theme="dark").svg != tour.plot(theme="light").svg == tour._repr_svg_()
    assert tour.plot()._repr_html_() in tour._repr_html_()
    with pytest.raises(ValueError, match=r"tour\.png: a picture is an SVG file, whose name ends with \.svg"):
        picture.save(tmp_path / "tour.png")


def test_what_no_run_may_have_is_refused_with_the_reason():
    refused = [
        (
            lambda: ml.record("apartmnt"),
            ml.WorldError,
            'no built-in world is named "apartmnt"; did you mean "apartment"',
        ),
        (lambda: ml.record([]), ml.RunError, "0 worlds: there must be 1 to 1000"),
        (lambda: ml.record(["lot", "lot"]), ml.RunError, 'two robots are named "Hitch"'),
        (lambda: ml.record(3), TypeError, "'int' object is not iterable"),
        (lambda: ml.record(ticks=-1), ValueError, "ticks -1: it must be from 0 to 18446744073709551615"),
        (lambda: ml.record(ticks=1.5), TypeError, "ticks: a whole number, not float"),
        (lambda: ml.record(ticks=1 << 40), ml.RunError, "1099511627776 ticks: at most 4294967296"),
        (lambda: ml.record(seed=1 << 64), ValueError, "seed 18446744073709551616"),
        (lambda: ml.record(rays=1 << 33), ml.RunError, "4294967295 rays"),
        (lambda: ml.record(range=math.nan), ml.RunError, "range NaN"),
        (lambda: ml.record(script="nowhere.ron"), FileNotFoundError, "nowhere.ron"),
        (
            lambda: ml.record(script=5),
            TypeError,
            "a script is its text, the path of its file or a list of inputs, not int",
        ),
        (
            lambda: ml.record(script="Script(version: 9, events: [])"),
            ml.RunError,
            "script:1: version 9: this program reads",
        ),
        (lambda: ml.record(script=[(1, "Rusti", {"release": True})]), ml.RunError, 'there is no robot "Rusti"'),
        (
            lambda: ml.record(script=[(0, "Rusty", {"release": True})]),
            ml.RunError,
            r"events\[0\]: tick 0: it must be in 1",
        ),
        (lambda: ml.record(script=[(-1, "Rusty", {"release": True})]), ValueError, r"script\[0\]: tick -1"),
        (lambda: ml.record(script=[(1, "Rusty")]), TypeError, r"script\[0\]: it is a tuple \(tick, name, input\)"),
        (lambda: ml.record(script=[(1, "Rusty", {})]), TypeError, r"script\[0\]: 0 inputs: one of drive"),
        (lambda: ml.record(script=[(1, "Rusty", {"fly": 1})]), TypeError, "fly: a robot's input is one of drive"),
        (
            lambda: ml.record(script=[(1, "Rusty", {"drive": (129, 0)})]),
            ml.RunError,
            "channel 129: it must be in -128 to 128",
        ),
        (lambda: ml.record(script=[(1, "Rusty", {"drive": (1 << 20, 0)})]), ml.RunError, "channel 1048576: it must be"),
        (
            lambda: ml.record(script=[(1, "Lot", {"close": "gate"})]),
            ml.RunError,
            'there is no door "gate" in world "Lot"',
        ),
        (lambda: ml.record(ticks=1).states("Rusti"), ml.RunError, 'has no robot "Rusti"; did you mean "Rusty"'),
        (lambda: ml.record(ticks=1).scans("Reach"), IndexError, "Reach has 0 range sensors: there is no number 0"),
        (lambda: ml.record(ticks=1).frame(2), IndexError, "there is no tick 2: they are 0 to 1"),
        (lambda: ml.record(ticks=1).plot(2), ml.RunError, "there is no tick 2: they are 0 to 1"),
        (lambda: ml.record(ticks=1).plot(theme="blue"), ValueError, 'theme "blue": it is "light" or "dark"'),
        (lambda: ml.read("nowhere.mcap"), FileNotFoundError, "nowhere.mcap"),
    ]
    for ask, error, words in refused:
        with pytest.raises(error, match=words):
            ask()
    assert issubclass(ml.RunError, ml.Error) and issubclass(ml.LogError, ml.Error) and issubclass(ml.Error, ValueError)


STOPPED = """
import os, signal, threading, time
import motion_lab as ml
pressed = []
def press():
    pressed.append(time.monotonic())
    os.kill(os.getpid(), signal.SIGINT)
threading.Timer(0.5, press).start()
try:
    {work}
    print("not stopped")
except KeyboardInterrupt:
    print(f"stopped {{time.monotonic() - pressed[0]:.3f}}")
"""


@pytest.mark.parametrize(
    "work",
    [
        "ml.record(ticks=50_000_000, frames=False)",
        "ml.Recorder().step(50_000_000)",
        "ml.Recorder().seek(50_000_000)",
        "ml.plan('workbench', (2.0, 0.0), (3.1, 0.0), robot=ml.Reach(), planner='rrt-star', budget=50_000_000)",
    ],
)
def test_control_c_stops_long_work_soon(work):
    command = [sys.executable, "-c", STOPPED.format(work=work)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
    assert done.stdout.startswith("stopped ")
    assert float(done.stdout.split()[1]) < 1.0, done.stdout  # 0.1 s on a machine that does nothing else
