"""measure.py WORLDS.json [PACKAGE...]: see benches/peers/run. Prints microseconds a call, medians over the rounds, each package as its users call it."""

import json
import math
import statistics
import sys
import time

ROUNDS = 15


def timed(work, cases):
    """The median time of one call, microseconds, over rounds that each go through some of the cases."""
    for case in cases[:4]:
        work(case)
    rounds = []
    for k in range(ROUNDS):
        some = cases[k % 8 :: 8]
        start = time.perf_counter()
        for case in some:
            work(case)
        rounds.append((time.perf_counter() - start) / len(some) * 1e6)
    return statistics.median(rounds)


def stepped(step, robots):
    """The median time of a step of all robots, microseconds a robot, over a few rounds."""
    step(None)
    return timed(step, [None] * (8 if robots > 100 else 64)) / robots


def shapely(worlds):
    from shapely import LineString, Polygon, STRtree, distance

    for name, world in worlds["arms"].items():
        shapes = [Polygon(b) for b in world["boxes"]]
        tree = STRtree(shapes)

        def ask(arm):
            for ax, ay, bx, by in arm:
                link = LineString([(ax, ay), (bx, by)])
                distance(link, shapes[tree.nearest(link)])

        yield f"arm, distance, {name} obstacles", timed(ask, world["arms"])


def pymunk(worlds):
    import pymunk

    for name, world in worlds["scans"].items():
        space = pymunk.Space()
        for ax, ay, bx, by in world["segments"]:
            space.add(pymunk.Segment(space.static_body, (ax, ay), (bx, by), 0))
        reach, keep = world["range"], pymunk.ShapeFilter()

        def scan(pose):
            x, y, theta = pose
            for k in range(360):
                bearing = theta + math.tau * k / 360
                space.segment_query_first((x, y), (x + reach * math.cos(bearing), y + reach * math.sin(bearing)), 0, keep)

        yield f"scan, 360 rays, {name} segments", timed(scan, world["poses"][:32])


def broad_phase(package, box, capsule):
    """Distance of an arm's links by FCL's interface, which Coal shares: a manager of obstacles, one request for each link."""

    def measure(worlds):
        lib = __import__(package)
        for name, world in worlds["arms"].items():
            yield f"arm, distance, {name} obstacles", timed(*arm_by(lib, world, box, capsule))

    return measure


def arm_by(lib, world, box, capsule):
    manager = lib.DynamicAABBTreeCollisionManager()
    obstacles = [box(lib, b) for b in world["boxes"]]
    if hasattr(lib, "Transform"):  # python-fcl
        manager.registerObjects(obstacles)
        manager.setup()

        def ask(arm):
            for link in arm:
                data = lib.DistanceData()
                manager.distance(capsule(lib, link), data, lib.defaultDistanceCallback)
    else:
        for obstacle in obstacles:
            manager.registerObject(obstacle)
        manager.setup()

        def ask(arm):
            for link in arm:
                manager.distance(capsule(lib, link), lib.DistanceCallBackDefault())

    return ask, world["arms"]


def middle_and_turn(ax, ay, bx, by):
    return (ax + bx) / 2, (ay + by) / 2, math.hypot(bx - ax, by - ay), math.atan2(by - ay, bx - ax)


def turned(c, s):
    """About z."""
    return [[c, -s, 0], [s, c, 0], [0, 0, 1]]


def lying(c, s):
    """A capsule's axis, z, laid along (c, s, 0)."""
    return [[-s, 0, c], [c, 0, s], [0, 1, 0]]


def fcl_object(lib, shape, rotation, x, y):
    import numpy

    rotation, place = numpy.array(rotation, float), numpy.array([x, y, 0.0])
    if hasattr(lib, "Transform"):
        return lib.CollisionObject(shape, lib.Transform(rotation, place))
    return lib.CollisionObject(shape, lib.Transform3s(rotation, place))


def fcl_box(lib, corners):
    (ax, ay), (bx, by), (cx, cy), _ = corners
    width, height = math.hypot(bx - ax, by - ay), math.hypot(cx - bx, cy - by)
    rotation = turned((bx - ax) / width, (by - ay) / width)
    return fcl_object(lib, lib.Box(width, height, 1.0), rotation, (ax + cx) / 2, (ay + cy) / 2)


def fcl_capsule(lib, link):
    x, y, length, turn = middle_and_turn(*link)
    return fcl_object(lib, lib.Capsule(0.03, length), lying(math.cos(turn), math.sin(turn)), x, y)


def irsim(worlds):
    import os
    import tempfile

    import irsim
    import numpy

    def wall(ax, ay, bx, by):
        return {"shape": {"name": "linestring", "vertices": [[ax, ay], [bx, by]]}, "state": [0, 0, 0]}

    for name, world in worlds["scans"].items():
        if len(world["segments"]) > 1000:
            continue  # seconds a scan
        lidar = {"type": "lidar2d", "range_min": 0, "range_max": world["range"], "angle_range": math.tau, "number": 360}
        robot = {"shape": {"name": "circle", "radius": 0.02}, "state": world["poses"][0], "sensors": [lidar]}
        walls = [wall(*ends) for ends in world["segments"]]
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "world.yaml")
            with open(path, "w") as file:
                json.dump({"world": {"height": 100, "width": 100}, "robot": [robot], "obstacle": walls}, file)  # YAML holds JSON
            env = irsim.make(path, display=False, log_level="ERROR")
        scanner = env.robot.lidar
        scan = lambda pose: scanner.step(numpy.array(pose).reshape(3, 1))
        yield f"scan, 360 rays, {name} segments", timed(scan, world["poses"][:8])
        env.end()
    for name, world in worlds["crowds"].items():
        if int(name) > 100:
            continue  # minutes a step
        lidar = {"type": "lidar2d", "range_min": 0, "range_max": world["range"], "angle_range": math.tau, "number": 360}
        robot = lambda pose: {
            "kinematics": {"name": "diff"},
            "shape": {"name": "circle", "radius": 0.11},
            "state": pose,
            "behavior": {"name": "dash"},
            "goal": [pose[0] + 50, pose[1], 0],
            "sensors": [lidar],
        }
        scene = {
            "world": {"height": 500, "width": 500, "offset": [-10, -10], "step_time": 0.05, "collision_mode": "stop"},
            "robot": [robot(pose) for pose in world["robots"]],
            "obstacle": [wall(*ends) for ends in world["segments"]],
        }
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "world.yaml")
            with open(path, "w") as file:
                json.dump(scene, file)
            env = irsim.make(path, display=False, log_level="ERROR")
        yield f"a robot-step among {name} robots", stepped(lambda _: env.step(), len(world["robots"]))
        env.end()


def navground(worlds):
    from navground import core, sim

    for name, world in worlds["scans"].items():
        scene = sim.World()
        for ax, ay, bx, by in world["segments"]:
            scene.add_wall(sim.Wall((ax, ay), (bx, by)))
        lidar = sim.state_estimations.LidarStateEstimation(
            range=world["range"], start_angle=0.0, field_of_view=math.tau, resolution=360
        )
        agent = sim.Agent(radius=0.0, behavior=core.behaviors.DummyBehavior())
        scene.add_agent(agent)
        state = core.SensingState()
        lidar.prepare(agent, scene)

        def scan(pose):
            x, y, theta = pose
            agent.pose = core.Pose2((x, y), theta)
            lidar.update(agent, scene, state)

        yield f"scan, 360 rays, {name} segments", timed(scan, world["poses"])
    for name, world in worlds["crowds"].items():
        if int(name) > 1000:
            continue  # minutes a step
        scene, sensors = sim.World(), []
        for ax, ay, bx, by in world["segments"]:
            scene.add_wall(sim.Wall((ax, ay), (bx, by)))
        for x, y, theta in world["robots"]:
            wheels = core.kinematics.TwoWheelsDifferentialDriveKinematics(max_speed=0.6, wheel_axis=0.16)
            behavior = core.behaviors.DummyBehavior(kinematics=wheels, radius=0.11)
            agent = sim.Agent(radius=0.11, behavior=behavior, kinematics=wheels)
            agent.pose = core.Pose2((x, y), theta)
            scene.add_agent(agent)
            agent.controller.follow_twist(core.Twist2((0.2, 0.0), 0.0, core.Frame.relative))
            lidar = sim.state_estimations.LidarStateEstimation(
                range=world["range"], start_angle=0.0, field_of_view=math.tau, resolution=360
            )
            state = core.SensingState()
            lidar.prepare(agent, scene)
            sensors.append((agent, lidar, state))

        def step(_):
            scene.run(1, 0.05)
            for agent, lidar, state in sensors:
                lidar.update(agent, scene, state)

        yield f"a robot-step among {name} robots", stepped(step, len(sensors))


PEERS = {
    "shapely": shapely,
    "pymunk": pymunk,
    "python-fcl": broad_phase("fcl", fcl_box, fcl_capsule),
    "coal": broad_phase("coal", fcl_box, fcl_capsule),
    "ir-sim": irsim,
    "navground": navground,
}


def main():
    with open(sys.argv[1]) as file:
        worlds = json.load(file)
    wanted = sys.argv[2:] or PEERS
    for package, measure in PEERS.items():
        if package not in wanted:
            continue
        try:
            for work, microseconds in measure(worlds):
                print(f"{package:11} {work:40} {microseconds:9.1f} us")
        except ImportError as missing:
            print(f"{package:11} left out: {missing}")


if __name__ == "__main__":
    main()
