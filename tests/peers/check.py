"""check.py LOG JSONL VIEWER: see tests/peers/check. Every comparison of numbers is one of their 64 bits."""

import importlib
import json
import math
import struct
import sys
from collections import defaultdict

from google.protobuf.descriptor import FieldDescriptor
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

TICK = 50_000_000
compared = 0


def bits(x):
    return struct.pack("<d", x)


def equal(expected, found, where):
    """The JSON value is the message's, bit for bit."""
    global compared
    expected = [float(x) for x in expected] if isinstance(expected, list) else [float(expected)]
    found = list(found) if not isinstance(found, float) else [found]
    assert len(expected) == len(found), f"{where}: {len(expected)} numbers in JSON, {len(found)} in the log"
    for k, (a, b) in enumerate(zip(expected, found)):
        assert bits(a) == bits(b), f"{where}[{k}]: {a!r} in JSON, {b!r} in the log"
        compared += 1


def messages(file):
    """The decoded messages of a file by topic: (schema, tick, message)."""
    by_topic = defaultdict(list)
    with open(file, "rb") as stream:
        reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for schema, channel, message, decoded in reader.iter_decoded_messages(log_time_order=False):
            assert message.log_time % TICK == 0 and message.log_time == message.publish_time
            by_topic[channel.topic].append((schema.name, message.log_time // TICK, decoded))
    return by_topic


def check_log(log, lines):
    topics = messages(log)
    assert set(topics) <= {"/input", "/frame", "/scan", "/digest"}, set(topics)
    assert len(topics["/frame"]) == len(topics["/digest"]) == len(lines)
    scans = {(scan.tick, scan.robot): scan for _, _, scan in topics["/scan"]}
    floats = lambda robot: {f.name for f in robot.DESCRIPTOR.fields if f.type == FieldDescriptor.TYPE_DOUBLE}
    for line, (_, tick, frame), (_, _, digest) in zip(lines, topics["/frame"], topics["/digest"]):
        where = f"tick {tick}"
        assert line["tick"] == tick == frame.tick == digest.tick and line["digest"] == digest.xxh3_128, where
        equal(line["time"], frame.time, f"{where}, time")
        assert math.isclose(frame.time, tick / 20, rel_tol=1e-15), f"{where}: 20 ticks are a second"
        assert len(line["robots"]) == len(frame.robots), where
        for exported, robot in zip(line["robots"], frame.robots):
            at = f"{where}, robot {robot.id}"
            assert floats(robot) == {"configuration", "extra", "target"}, "a number that is not compared"
            for field in floats(robot):
                equal(exported[field], getattr(robot, field), f"{at}, {field}")
            assert exported["channels"] == list(robot.channels), at
            for field in ["id", "manual", "in_contact", "contacts", "flash", "refusals"]:
                assert exported[field] == getattr(robot, field), f"{at}, {field}"
            scan = scans.pop((tick, robot.id), None)
            assert (scan is None) == (exported["ranges"] is None), at
            if scan is not None:
                equal(exported["ranges"], scan.ranges, f"{at}, ranges")
                most = scan.max_range * (1 + 1e-12)
                assert all(0 <= r <= most or r == math.inf for r in scan.ranges), f"{at}: beyond the sensor's range"
    assert not scans, "scans of no robot"


def check_schema(message, seen):
    """The descriptor says of every field what Foxglove's own package says of it."""
    if message.full_name in seen or not message.full_name.startswith("foxglove."):
        return
    seen.add(message.full_name)
    module = importlib.import_module(f"foxglove_schemas_protobuf.{message.name}_pb2")
    official = getattr(module, message.name).DESCRIPTOR
    interface = lambda d: [
        (f.number, f.name, f.type, f.is_repeated, f.message_type and f.message_type.full_name)
        for f in d.fields
    ]
    enums = lambda d: {e.name: [(v.name, v.number) for v in e.values] for e in d.enum_types}
    assert interface(message) == interface(official), message.full_name
    assert enums(message) == enums(official), message.full_name
    for field in message.fields:
        if field.message_type is not None:
            check_schema(field.message_type, seen)


def robot_frames(robot):
    """Where a robot and its parts are and how they are turned, by its configuration and the lab's dimensions."""
    q = robot["configuration"]
    if robot["kind"] == "rusty":  # a disc looks alike from all sides
        base, frames = (q[0], q[1], q[2]), [(q[0], q[1], 0)]
    elif robot["kind"] == "hitch":  # the hitch is on the rear axle
        base, frames = (q[0], q[1], q[2]), [(q[0], q[1], heading) for heading in q[2:]]
    else:  # links of a metre, the first at the origin
        base, frames = (0, 0, q[0]), [(0, 0, q[0]), (math.cos(q[0]), math.sin(q[0]), q[0] + q[1])]
    parts = [(f"part/{k}/{robot['name']}", *frame) for k, frame in enumerate(frames)]
    return [(f"robot/{robot['name']}", *base)] + parts


def check_viewer(log, viewer, lines):
    topics = messages(viewer)
    plain = messages(log)
    for topic in plain:
        ours, theirs = topics.pop(topic), plain[topic]
        same = [(s, t, m.SerializeToString()) for s, t, m in ours] == [(s, t, m.SerializeToString()) for s, t, m in theirs]
        assert same, f"{topic} is not the log's own"

    seen = set()
    for topic, of_topic in topics.items():
        for schema, _, message in of_topic:
            assert message.DESCRIPTOR.full_name == schema, topic
            check_schema(message.DESCRIPTOR, seen)
    scan_topics = {t for t in topics if t.startswith("/viewer/scan/")}
    assert set(topics) == {"/viewer/transforms", "/viewer/worlds", "/viewer/robots", "/viewer/log"} | scan_topics
    assert scan_topics, "a run with a range sensor"

    # every frame leads to the one root, every turn is one, and every robot stands where the log has it
    for (_, tick, update), line in zip(topics["/viewer/transforms"], lines, strict=True):
        parents = {t.child_frame_id: t.parent_frame_id for t in update.transforms}
        placed = {t.child_frame_id: t for t in update.transforms}
        assert len(parents) == len(update.transforms), "a frame with two parents"
        for child in parents:
            while child in parents:
                child = parents[child]
            assert child == "lab", child
        for t in update.transforms:
            q = t.rotation
            assert abs(q.x**2 + q.y**2 + q.z**2 + q.w**2 - 1) < 1e-12 and q.x == q.y == 0
            assert (t.timestamp.seconds, t.timestamp.nanos) == divmod(tick * TICK, 10**9)
        for robot in line["robots"]:
            t = placed[f"robot/{robot['name']}"]
            assert t.parent_frame_id == f"world/{robot['world']}"
            if robot["kind"] in ("rusty", "hitch"):
                x, y = robot["configuration"][:2]
                equal([x, y], [t.translation.x, t.translation.y], f"tick {tick}, transform of {robot['name']}")
            for name, x, y, heading in robot_frames(robot):
                t = placed.pop(name)
                at = f"tick {tick}, transform of {name}"
                assert math.dist((x, y), (t.translation.x, t.translation.y)) < 1e-12 and t.translation.z == 0, at
                turn = 2 * math.atan2(t.rotation.z, t.rotation.w)
                assert abs(math.remainder(turn - heading, 2 * math.pi)) < 1e-12, at
        assert all(name.startswith("world/") for name in placed), f"tick {tick}: frames of nothing: {set(placed)}"

    for topic in scan_topics:
        name = topic.removeprefix("/viewer/scan/")
        for (_, tick, scan), line in zip(topics[topic], lines, strict=True):
            robot = next(r for r in line["robots"] if r["name"] == name)
            equal(robot["ranges"], scan.ranges, f"tick {tick}, {topic}")
            assert scan.frame_id == f"robot/{name}" and scan.start_angle == 0
            assert (scan.timestamp.seconds, scan.timestamp.nanos) == divmod(tick * TICK, 10**9)
            assert (scan.pose.position.x, scan.pose.position.y, scan.pose.orientation.w) == (0, 0, 1)
            n = len(scan.ranges)
            assert abs(scan.end_angle - 2 * math.pi * (n - 1) / n) < 1e-12

    [(_, _, worlds)] = topics["/viewer/worlds"]
    assert len({e.id for e in worlds.entities}) == len(worlds.entities) > 10
    for _, tick, update in topics["/viewer/robots"]:
        frames = {t.child_frame_id for t in topics["/viewer/transforms"][tick][2].transforms}
        assert {e.frame_id for e in update.entities} <= frames and update.entities
        for entity in update.entities:
            assert len(entity.triangles) == 1 and entity.frame_locked
            [triangles] = entity.triangles
            assert len(triangles.indices) % 3 == 0 and max(triangles.indices) < len(triangles.points)
    contacts = sum(robot["contacts"] for robot in lines[-1]["robots"])
    entries = [m for _, _, m in topics["/viewer/log"] if m.message.startswith("contact ")]
    assert contacts == len(entries) > 0, "a message for each contact"


log, jsonl, viewer = sys.argv[1:]
with open(jsonl, encoding="utf-8") as stream:
    lines = [json.loads(line) for line in stream]
check_log(log, lines)
in_log = compared
check_viewer(log, viewer, lines)
print(f"{log}: {in_log} numbers equal in log and JSON, {compared - in_log} more in the viewers' channels")
