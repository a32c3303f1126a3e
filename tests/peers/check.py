"""check.py LOG JSONL FOXGLOVE RERUN: see tests/peers/check. Every comparison of numbers of a log is one of their 64 bits."""

import importlib
import json
import math
import struct
import sys
from collections import defaultdict

import pyarrow
from google.protobuf.descriptor import FieldDescriptor
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory
from rerun.chunk import McapReader

TICK = 50_000_000
# The names of the numbers of the tour's kinds, whatever the run.
COORDINATES = {
    "rusty": ["x_m", "y_m", "theta_rad"],
    "reach": ["theta1_rad", "theta2_rad"],
    "hitch": ["x_m", "y_m", "theta_rad", "psi_rad"],
}
EXTRA = {"rusty": ["left_wheel_rad", "right_wheel_rad", "waypoint"]}
compared = 0


def numbers(named):
    """The numbers of an object, without those that are not there."""
    return [x for x in named.values() if x is not None]


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
        equal(line["time_s"], frame.time, f"{where}, time")
        assert math.isclose(frame.time, tick / 20, rel_tol=1e-15), f"{where}: 20 ticks are a second"
        assert len(line["robots"]) == len(frame.robots), where
        for exported, robot in zip(line["robots"], frame.robots):
            at = f"{where}, robot {robot.id}"
            assert floats(robot) == {"configuration", "extra", "target"}, "a number that is not compared"
            names = {"configuration": COORDINATES[exported["kind"]], "extra": EXTRA.get(exported["kind"], [])}
            names["target"] = [f"target_{name}" for name in COORDINATES["reach"]] if exported["kind"] == "reach" else []
            for field in floats(robot):
                assert list(exported[field]) == names[field], f"{at}, {field}: {list(exported[field])}"
                equal(numbers(exported[field]), getattr(robot, field), f"{at}, {field}")
            assert exported["channels"] == list(robot.channels), at
            for field in ["id", "manual", "in_contact", "contacts", "flash", "refusals"]:
                assert exported[field] == getattr(robot, field), f"{at}, {field}"
            scan = scans.pop((tick, robot.id), None)
            assert (scan is None) == (exported["ranges_m"] is None), at
            if scan is not None:
                equal(exported["ranges_m"], scan.ranges, f"{at}, ranges")
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
    q = numbers(robot["configuration"])
    if robot["kind"] == "rusty":  # a disc looks alike from all sides
        base, frames = (q[0], q[1], q[2]), [(q[0], q[1], 0)]
    elif robot["kind"] == "hitch":  # the hitch is on the rear axle
        base, frames = (q[0], q[1], q[2]), [(q[0], q[1], heading) for heading in q[2:]]
    else:  # links of a metre, the first at the origin
        base, frames = (0, 0, q[0]), [(0, 0, q[0]), (math.cos(q[0]), math.sin(q[0]), q[0] + q[1])]
    parts = [(f"part/{k}/{robot['name']}", *frame) for k, frame in enumerate(frames)]
    return [(f"robot/{robot['name']}", *base)] + parts


def parts(line):
    """How many parts each robot has."""
    return [len(robot_frames(robot)) for robot in line["robots"]]


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
    once = {"/viewer/worlds", "/viewer/paths"}
    sometimes = {"/viewer/robots", "/viewer/contacts", "/viewer/log"}
    assert set(topics) == {"/viewer/transforms"} | once | sometimes | scan_topics
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
                x, y = numbers(robot["configuration"])[:2]
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
            equal(robot["ranges_m"], scan.ranges, f"tick {tick}, {topic}")
            assert scan.frame_id == f"robot/{name}" and scan.start_angle == 0
            assert (scan.timestamp.seconds, scan.timestamp.nanos) == divmod(tick * TICK, 10**9)
            assert (scan.pose.position.x, scan.pose.position.y, scan.pose.orientation.w) == (0, 0, 1)
            n = len(scan.ranges)
            assert abs(scan.end_angle - 2 * math.pi * (n - 1) / n) < 1e-12

    [(_, _, worlds)] = topics["/viewer/worlds"]
    assert len({e.id for e in worlds.entities}) == len(worlds.entities) > 10
    changes = 1 + sum(parts(a) != parts(b) for a, b in zip(lines, lines[1:]))
    assert len(topics["/viewer/robots"]) == changes, "the robots are written once, and again when a part comes or goes"
    for topic in ["/viewer/robots", "/viewer/contacts"]:
        for _, tick, update in topics[topic]:
            frames = {t.child_frame_id for t in topics["/viewer/transforms"][tick][2].transforms}
            assert {e.frame_id for e in update.entities} <= frames
            for entity in update.entities:
                assert len(entity.triangles) == 1 and entity.frame_locked
                [triangles] = entity.triangles
                assert len(triangles.indices) % 3 == 0 and max(triangles.indices) < len(triangles.points)
            flashing = {r["name"] for r in lines[tick]["robots"] if topic == "/viewer/robots" or r["flash"] > 0}
            assert {e.frame_id.split("/", 2)[2] for e in update.entities} == flashing, f"{topic} at tick {tick}"
    [(_, _, paths)] = topics["/viewer/paths"]
    assert {e.id for e in paths.entities if e.id.startswith("path/")} == {f"path/{r['name']}" for r in lines[0]["robots"]}
    of_edge = lambda entity: tuple(round(255 * c) for c in (lambda c: (c.r, c.g, c.b, c.a))(entity.lines[0].color))
    named = lambda kind: next(e for e in paths.entities if e.id.startswith(kind))
    colours = {
        "robot": of_edge(topics["/viewer/robots"][0][2].entities[0]),
        "goal": of_edge(next(u.entities[0] for _, _, u in topics["/viewer/contacts"] if u.entities)),
        "path": of_edge(named("path/")),
        "obstacle": of_edge(next(e for e in worlds.entities if "/obstacle/" in e.id)),
    }
    assert len(set(colours.values())) == 4 and of_edge(named("contacts/")) == colours["goal"]
    contacts = sum(robot["contacts"] for robot in lines[-1]["robots"])
    entries = [m for _, _, m in topics["/viewer/log"] if m.message.startswith("contact ")]
    assert contacts == len(entries) > 0, "a message for each contact"
    return colours


def entities(file):
    """What Rerun makes of a file: for each entity and component the values in order, with their ticks."""
    found = defaultdict(list)
    for chunk in McapReader(file).stream().to_chunks():
        batch = chunk.to_record_batch()
        if "message_log_time" not in batch.schema.names:
            continue  # about the file
        ticks = batch.column("message_log_time").cast(pyarrow.int64()).to_pylist()
        for name in batch.schema.names:
            if ":" in name:
                values = batch.column(name).to_pylist()
                found[chunk.entity_path, name] += [(t // TICK, v) for t, v in zip(ticks, values) if v is not None]
    return {key: sorted(values, key=lambda value: value[0]) for key, values in found.items()}


def check_rerun(log, viewer, lines, colours):
    global drawn
    assert not entities(log), "Rerun takes messages of a log itself: README says that it does not"
    found = entities(viewer)
    last = len(lines) - 1
    # points are single floats of places within 30 m
    close = lambda p, q: math.dist(p[:2], q) < 1e-5 and p[2] == 0
    get = lambda topic, name: found[topic, name]
    transforms = defaultdict(dict)
    columns = [get("/viewer/transforms", f"Transform3D:{name}") for name in
               ["child_frame", "parent_frame", "translation", "quaternion"]]
    for (tick, [child]), (_, [parent]), (_, [shift]), (_, [turn]) in zip(*columns, strict=True):
        transforms[tick][child] = (parent, shift, turn)
    assert set(transforms) == set(range(len(lines)))
    for line in lines:
        placed = dict(transforms[line["tick"]])
        for robot in line["robots"]:
            for name, x, y, heading in robot_frames(robot):
                parent, shift, (qx, qy, qz, qw) = placed.pop(name)
                at = f"tick {line['tick']}, {name}"
                assert parent == f"world/{robot['world']}" and close(shift, (x, y)) and qx == qy == 0, at
                assert abs(math.remainder(2 * math.atan2(qz, qw) - heading, 2 * math.pi)) < 1e-5, at
        assert {parent for parent, _, _ in placed.values()} == {"lab"}

    colours = {role: int.from_bytes(bytes(rgba), "big") for role, rgba in colours.items()}

    def clouds(topic, frame, role):
        """The clouds of a topic by tick; every one has the frame, stands in it unturned, and the role's colour at each point."""
        places, paints = get(topic, "Points3D:positions"), get(topic, "Points3D:colors")
        assert all(value == [frame] for _, value in get(topic, "CoordinateFrame:frame")), topic
        assert all(value == [[0, 0, 0, 1]] for _, value in get(topic, "InstancePoses3D:quaternions")), topic
        assert [len(value) for _, value in places] == [len(value) for _, value in paints], topic
        for tick, value in paints:
            assert set(value) <= ({colours[role(tick)]} if role else set(value)), f"{topic}: a colour at tick {tick}"
        return dict(places)

    rays = 0
    for robot in lines[0]["robots"]:
        world, name, number = f"world/{robot['world']}", robot["name"], robot["id"]
        states = [line["robots"][number] for line in lines]
        [(tick, walls)] = clouds(f"/viewer/worlds/{robot['world']}", world, None).items()
        assert tick == 0 and len(walls) > 100
        [(_, paints)] = get(f"/viewer/worlds/{robot['world']}", "Points3D:colors")
        assert paints.count(colours["obstacle"]) > 100
        [(tick, path)] = clouds(f"/viewer/paths/{name}", world, lambda _: "path").items()
        assert tick == 0 and len(path) > 50
        [(tick, hits)] = clouds(f"/viewer/contacts/{name}", world, lambda _: "goal").items()
        assert tick == 0 and len(hits) == states[-1]["contacts"], f"a point for each contact of {name}"
        for part in range(max(len(robot_frames(state)) for state in states) - 1):
            frame = f"part/{part}/{name}"
            look = lambda tick: "goal" if states[tick]["flash"] > 0 else "robot"
            edges = clouds(f"/viewer/robots/{name}/{part}", frame, look)
            shown = [frame in transforms[tick] for tick in range(len(lines))]
            looks = [shown[t] and 1 + (states[t]["flash"] > 0) for t in range(len(lines))]
            changes = [t for t in range(len(lines)) if looks[t] != (looks[t - 1] if t else 0)]
            assert list(edges) == changes, f"{frame}: written when its look changes"
            assert all((len(edge) > 100) == shown[tick] for tick, edge in edges.items()), frame
        if robot["ranges_m"] is None:
            continue
        scans = clouds(f"/viewer/scan/{name}", world, None)
        assert list(scans) == list(range(len(lines)))
        for tick, state in enumerate(states):
            x, y, heading = numbers(state["configuration"])
            n = len(state["ranges_m"])
            bearings = [heading + 2 * math.pi * k / n for k in range(n)]
            ends = [(x + float(r) * math.cos(b), y + float(r) * math.sin(b))
                    for r, b in zip(state["ranges_m"], bearings) if r != "inf"]
            assert len(ends) == len(scans[tick]) and all(map(close, scans[tick], ends)), f"tick {tick}: scan of {name}"
            rays += len(ends)
    assert rays > 1000
    log_texts = [text for _, [text] in get("/viewer/log", "TextLog:text")]
    assert sum("contact " in text for text in log_texts) == sum(robot["contacts"] for robot in lines[last]["robots"]) > 0
    own = {f"/{name}" for name in ["input", "frame", "scan", "digest"]}
    drawn = {path for path, _ in found} - own
    archetypes = {name.split(":")[0] for path, name in found if path not in own}
    assert archetypes == {"Transform3D", "Points3D", "CoordinateFrame", "InstancePoses3D", "TextLog"}, archetypes
    return rays


log, jsonl, viewer, rerun = sys.argv[1:]
with open(jsonl, encoding="utf-8") as stream:
    lines = [json.loads(line) for line in stream]
check_log(log, lines)
in_log = compared
colours = check_viewer(log, viewer, lines)
rays = check_rerun(log, rerun, lines, colours)
print(f"{log}: {in_log} numbers equal in log and JSON, {compared - in_log} more in the viewers' channels; "
      f"Rerun draws {len(drawn)} entities, {rays} ends of rays among them")
