"""Assignments and grades, against `motion-lab grade` and against numbers by hand."""

import json
import subprocess
import sys

import pytest

import motion_lab as ml

FORWARD = """Assignment(version: 1, world: "lot", robot: "Hitch", start: [6.5, 2.5, 0],
    goal: (at: [7.5, 2.5, 0], within: [0.1, 0.1, 0.1]),
    stay: (hold: 20, at: end),
    limits: (ticks: 200, contacts: 0, reversals: 0),
    points: (goal: 6, contacts: 2, reversals: 2),
    seeds: [1, 5])"""
# 13 ticks of 0.05 s at its full 1.5 m/s are 0.975 m
THERE = [(1, "Hitch", {"drive": (128, 0)}), (14, "Hitch", {"drive": (0, 0)})]
BEYOND = [(1, "Hitch", {"drive": (128, 0)}), (22, "Hitch", {"drive": (0, 0)})]
BACK = [(1, "Hitch", {"drive": (-128, 0)}), (3, "Hitch", {"drive": (128, 0)}), (18, "Hitch", {"drive": (0, 0)})]


def graded(folder, submission):
    """What the program says of a submission."""
    (folder / "exam.ron").write_text(FORWARD)
    asked = [sys.executable, "-m", "motion_lab", "grade", "--json", str(folder / "exam.ron"), str(submission)]
    return json.loads(subprocess.run(asked, capture_output=True, text=True, timeout=100).stdout)


def test_an_assignment_says_what_it_asks_for():
    exam = ml.Assignment.parse(FORWARD)
    assert (exam.robot, exam.seeds, exam.ticks, exam.world.name) == ("Hitch", (1, 5), 200, "Lot")
    assert [robot.start for robot in exam.world.robots] == [(6.5, 2.5, 0.0)]
    assert repr(exam) == "<Assignment for Hitch in Lot: 200 ticks, 2 seeds>"


def test_who_gets_there_and_stays_earns_all_points():
    grade = ml.Assignment.parse(FORWARD).grade(THERE)
    assert grade and (grade.points, grade.max_points, grade.refused) == (10, 10, None)
    assert grade.criteria == [("goal", 6, 6), ("contacts", 2, 2), ("reversals", 2, 2)]
    assert [(attempt.seed, attempt.tick, attempt.verdict) for attempt in grade.attempts] == [
        (1, 200, "passed"),
        (5, 200, "passed"),
    ]
    for attempt in grade.attempts:
        assert attempt and attempt.passed and (attempt.contacts, attempt.reversals, attempt.radians) == (0, 0, 0)
        assert attempt.configuration == pytest.approx([7.475, 2.5, 0], abs=1e-12)
        assert attempt.metres == pytest.approx(0.025, abs=1e-12)


def test_who_drives_on_or_turns_round_loses_points():
    exam = ml.Assignment.parse(FORWARD)
    beyond = exam.grade(BEYOND)
    assert not beyond and beyond.points == 0
    assert {attempt.verdict for attempt in beyond.attempts} == {"left the goal"}
    back = exam.grade(BACK)
    assert not back and back.points == 8 and back.criteria[2] == ("reversals", 0, 2)
    assert [(attempt.verdict, attempt.reversals, bool(attempt)) for attempt in back.attempts] == [
        ("too many reversals", 1, False)
    ] * 2


@pytest.mark.parametrize("script", [THERE, BEYOND, BACK], ids=["there", "beyond", "back"])
def test_the_program_gives_the_same_grade(tmp_path, script):
    run = ml.record("lot", script=script, ticks=30, seed=1)
    (tmp_path / "mine.ron").write_text(run.script)
    (tmp_path / "exam.ron").write_text(FORWARD)
    exam = ml.Assignment.read(tmp_path / "exam.ron")
    program = graded(tmp_path, tmp_path / "mine.ron")
    for submission in [script, tmp_path / "mine.ron", str(tmp_path / "mine.ron"), run.script]:
        grade = exam.grade(submission)
        assert (bool(grade), grade.points, grade.max_points) == (
            program["passed"],
            program["points"],
            program["max_points"],
        )
        for mine, its in zip(grade.attempts, program["attempts"], strict=True):
            for field in ["verdict", "tick", "contacts", "reversals", "configuration", "metres", "radians"]:
                assert getattr(mine, field) == its[field]


def test_a_run_is_simulated_again_and_a_forged_one_refused(tmp_path):
    exam = ml.Assignment.parse(FORWARD)
    live = ml.Recorder(exam.world, seed=1)
    live.input("Hitch", drive=(128, 0))
    live.step(13)
    live.input("Hitch", drive=(0, 0))
    live.step(20)
    run = live.log()
    assert exam.grade(run)
    run.write(tmp_path / "mine.mcap")
    assert exam.grade(tmp_path / "mine.mcap") and exam.grade(str(tmp_path / "mine.mcap"))
    run.write(tmp_path / "MINE.MCAP")
    assert exam.grade(tmp_path / "MINE.MCAP")
    elsewhere = exam.grade(ml.record("apartment", ticks=3))
    assert not elsewhere and (elsewhere.points, elsewhere.attempts) == (0, ())
    assert elsewhere.refused == "the log was recorded in another world, or from another start"
    teleport = exam.grade([(1, "Hitch", {"teleport": [7.5, 2.5, 0]})])
    assert teleport.refused == "events[0]: a teleport is not allowed"
    assert repr(teleport) == "<Grade: refused: events[0]: a teleport is not allowed>"


def test_an_assignments_world_is_a_built_in_one_or_a_file_beside_it_or_given(tmp_path):
    (tmp_path / "course").mkdir()
    text = FORWARD.replace('"lot"', '"yard.ron"')
    (tmp_path / "course" / "exam.ron").write_text(text)
    with pytest.raises(ml.WorldError, match='no built-in world is named "yard.ron"'):
        ml.Assignment.read(tmp_path / "course" / "exam.ron")
    ml.World("lot").write(tmp_path / "course" / "yard.ron")
    assert ml.Assignment.read(tmp_path / "course" / "exam.ron").grade(THERE)
    with pytest.raises(ml.WorldError):
        ml.Assignment.parse(text)
    assert ml.Assignment.parse(text, world="lot").grade(THERE)
    assert ml.Assignment.parse(text, world=ml.World("lot")).world.name == "Lot"


def test_what_is_no_assignment_is_refused_with_its_place(tmp_path):
    with pytest.raises(ml.Error, match=r"^exam.ron:1:\d+: robot: .*Hutch"):
        ml.Assignment.parse(FORWARD.replace('"Hitch"', '"Hutch"'), name="exam.ron")
    with pytest.raises(ml.Error, match="^<text>:1:"):
        ml.Assignment.parse("Assignment(version: 2)")
    with pytest.raises(FileNotFoundError):
        ml.Assignment.read(tmp_path / "none.ron")
    exam = ml.Assignment.parse(FORWARD)
    with pytest.raises(FileNotFoundError):
        exam.grade(tmp_path / "none.mcap")
    for none in [7, None]:
        with pytest.raises(TypeError):
            exam.grade(none)
    (tmp_path / "long.ron").write_bytes(b" " * ((64 << 20) + 1))
    for read in [ml.Assignment.read, exam.grade]:
        with pytest.raises(ml.Error, match="long.ron: an? (assignment|script) has at most 67108864 bytes"):
            read(tmp_path / "long.ron")
    (tmp_path / "latin.ron").write_bytes(b"Assignment(\xe9)")
    with pytest.raises(ml.Error, match="latin.ron: the file is not UTF-8 text"):
        ml.Assignment.read(tmp_path / "latin.ron")
    (tmp_path / "bad.mcap").write_bytes(b"no log")
    with pytest.raises(ml.LogError, match="bad.mcap"):
        exam.grade(tmp_path / "bad.mcap")
