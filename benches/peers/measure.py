"""measure.py: public Python packages as rivals of the table (benches/table/process.rs says the protocol), each as its users call it.

A package answers a task by a function of the number of a case. What takes long is asked for some of the cases only, evenly chosen."""

import json
import math
import os
import sys
import tempfile
import time

import numpy

LONGEST = 0.4  # seconds of a round
TURN = math.tau


def shapely(task):
    """https://shapely.readthedocs.io/en/stable/strtree.html: one query of the tree for all links, then the distances."""
    if task.kind != "distance":
        return None
    from shapely import LineString, Polygon, STRtree, distance, prepare

    shapes = numpy.array([Polygon(pairs(line[1:])) for line in task.obstacles])
    prepare(shapes)
    tree, radius = STRtree(shapes), task.settings[0]
    arms = [numpy.array([LineString(pairs(link)) for link in links(case)]) for case in task.cases]

    def ask(i):
        nearest = tree.nearest(arms[i])
        return [max(0.0, float(distance(arms[i], shapes[nearest]).min()) - radius)]

    return ask


def pymunk(task):
    """https://www.pymunk.org/en/latest/pymunk.html#pymunk.Space.segment_query_first: one query for each ray."""
    if task.kind != "scan":
        return None
    import pymunk

    space = pymunk.Space()
    for _, ax, ay, bx, by in task.obstacles:
        space.add(pymunk.Segment(space.static_body, (ax, ay), (bx, by), 0))
    reach, keep = task.settings[0], pymunk.ShapeFilter()
    fans = [((x, y), [(x + reach * u, y + reach * v) for u, v in pairs(rays)]) for x, y, *rays in task.cases]

    def ask(i):
        start, ends = fans[i]
        hits = [space.segment_query_first(start, end, 0, keep) for end in ends]
        return [reach * hit.alpha if hit else math.inf for hit in hits]

    return ask


def broad_phase(package, box, capsule):
    """Distance of an arm's links by FCL's interface, which Coal shares: a manager of obstacles, one request for each link.

    https://github.com/BerkeleyAutomation/python-fcl#broadphase-checking, https://github.com/coal-library/coal"""

    def peer(task):
        if task.kind != "distance":
            return None
        lib = __import__(package)
        manager = lib.DynamicAABBTreeCollisionManager()
        obstacles = [box(lib, pairs(line[1:])) for line in task.obstacles]
        radius = task.settings[0]
        arms = [[capsule(lib, link, radius) for link in links(case)] for case in task.cases]
        if hasattr(lib, "Transform"):  # python-fcl
            manager.registerObjects(obstacles)
            manager.setup()

            def ask(i):
                least = math.inf
                for link in arms[i]:
                    data = lib.DistanceData()
                    manager.distance(link, data, lib.defaultDistanceCallback)
                    least = min(least, data.result.min_distance)
                return [least]
        else:
            for obstacle in obstacles:
                manager.registerObject(obstacle)
            manager.setup()

            def ask(i):
                least = math.inf
                for link in arms[i]:
                    callback = lib.DistanceCallBackDefault()
                    manager.distance(link, callback)
                    least = min(least, callback.data.result.min_distance)
                return [least]

        return ask

    return peer


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


def fcl_capsule(lib, link, radius):
    x, y, length, turn = middle_and_turn(*link)
    return fcl_object(lib, lib.Capsule(radius, length), lying(math.cos(turn), math.sin(turn)), x, y)


def irsim(task):
    """https://ir-sim.readthedocs.io/en/stable/usage/configure_sensor.html: a world file, then a step a tick."""
    import irsim

    if task.kind == "scan":
        if len(task.obstacles) > 1000:
            return None  # seconds a scan
        reach = task.settings[0]
        robot = {"shape": {"name": "circle", "radius": 0.02}, "state": [*task.cases[0][:2], 0], "sensors": [lidar(reach)]}
        env = irsim_world(irsim, [robot], task.obstacles)
        poses = [numpy.array([[x], [y], [math.atan2(rays[1], rays[0])]]) for x, y, *rays in task.cases]

        def scan(i):
            env.robot.lidar.step(poses[i])
            return [float(r) for r in env.robot.lidar.get_scan()["ranges"]]

        return scan
    if task.kind == "minute":
        reach, dt, radius = task.settings
        x, y, theta, *speeds = task.cases[0]
        commands = [numpy.array([[v], [w]]) for v, w in pairs(speeds)]
        diff = {"kinematics": {"name": "diff"}, "vel_min": [-9, -9], "vel_max": [9, 9]}

        def minute(_):
            robot = {**diff, "shape": {"name": "circle", "radius": radius}, "state": [x, y, theta], "sensors": [lidar(reach)]}
            env = irsim_world(irsim, [robot], task.obstacles, dt)
            for command in commands:
                env.step(command)
            return [float(env.robot.state[0, 0]), float(env.robot.state[1, 0])]

        return minute
    if task.kind == "crowd" and len(task.cases) <= 100:
        reach, dt, radius = task.settings
        goes = {"kinematics": {"name": "diff"}, "behavior": {"name": "dash"}, "shape": {"name": "circle", "radius": radius}}
        robot = lambda pose: {**goes, "state": pose, "goal": [pose[0] + 50, pose[1], 0], "sensors": [lidar(reach)]}
        env = irsim_world(irsim, [robot(pose) for pose in task.cases], task.obstacles, dt)
        return lambda _: env.step() or [0.0]
    return None


def lidar(reach):
    return {"type": "lidar2d", "range_min": 0, "range_max": reach, "angle_range": TURN, "number": 360}


def irsim_world(irsim, robots, segments, step=0.05):
    wall = lambda ends: {"shape": {"name": "linestring", "vertices": pairs(ends)}, "state": [0, 0, 0]}
    world = {"height": 500, "width": 500, "offset": [-10, -10], "step_time": step, "collision_mode": "stop"}
    scene = {"world": world, "robot": robots, "obstacle": [wall(line[1:]) for line in segments]}
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "world.yaml")
        with open(path, "w") as file:
            json.dump(scene, file)  # YAML holds JSON
        return irsim.make(path, display=False, log_level="ERROR")


def navground(task):
    """https://idsia-robotics.github.io/navground/: agents with a LiDAR, `World.run` a tick at a time."""
    from navground import core, sim

    if task.kind not in ("scan", "minute", "crowd"):
        return None
    reach = task.settings[0]

    def place(scene, pose, radius):
        wheels = core.kinematics.TwoWheelsDifferentialDriveKinematics(max_speed=9.0, wheel_axis=0.16)
        behavior = core.behaviors.DummyBehavior(kinematics=wheels, radius=radius)
        agent = sim.Agent(radius=radius, behavior=behavior, kinematics=wheels)
        agent.pose = core.Pose2(tuple(pose[:2]), pose[2])
        scene.add_agent(agent)
        sensor = sim.state_estimations.LidarStateEstimation(range=reach, start_angle=0.0, field_of_view=TURN, resolution=360)
        state = core.SensingState()
        sensor.prepare(agent, scene)
        return agent, sensor, state

    def world():
        scene = sim.World()
        for _, ax, ay, bx, by in task.obstacles:
            scene.add_wall(sim.Wall((ax, ay), (bx, by)))
        return scene

    if task.kind == "scan":
        scene = world()
        agent, sensor, state = place(scene, [*task.cases[0][:2], 0.0], 0.0)
        poses = [core.Pose2((x, y), math.atan2(rays[1], rays[0])) for x, y, *rays in task.cases]

        def scan(i):
            agent.pose = poses[i]
            sensor.update(agent, scene, state)
            return [float(r) for r in numpy.asarray(state.buffers["range"].data).ravel()]

        return scan
    _, dt, radius = task.settings
    if task.kind == "minute":
        start, speeds = task.cases[0][:3], pairs(task.cases[0][3:])

        def minute(_):
            scene = world()
            agent, sensor, state = place(scene, start, radius)
            x, y, theta = start
            for v, w in speeds:
                agent.controller.follow_twist(core.Twist2((v, 0.0), w, core.Frame.relative))
                scene.run(1, dt)
                x, y, theta = x + v * dt * math.cos(theta), y + v * dt * math.sin(theta), theta + w * dt
                agent.pose = core.Pose2((x, y), theta)  # its controllers do not follow both speeds
                sensor.update(agent, scene, state)
            return [float(agent.position[0]), float(agent.position[1])]

        return minute
    if len(task.cases) > 1000:
        return None  # minutes a step
    scene = world()
    agents = [place(scene, pose, radius) for pose in task.cases]
    for agent, _, _ in agents:
        agent.controller.follow_twist(core.Twist2((0.2, 0.0), 0.0, core.Frame.relative))

    def step(_):
        scene.run(1, dt)
        for agent, sensor, state in agents:
            sensor.update(agent, scene, state)
        return [0.0]

    return step


def pairs(numbers):
    return [list(pair) for pair in zip(numbers[::2], numbers[1::2])]


def links(case):
    return [case[i : i + 4] for i in range(0, len(case), 4)]


PEERS = {
    "shapely": shapely,
    "pymunk": pymunk,
    "python-fcl": broad_phase("fcl", fcl_box, fcl_capsule),
    "coal": broad_phase("coal", fcl_box, fcl_capsule),
    "ir-sim": irsim,
    "navground": navground,
}


class Task:
    """What the table asks for: `benches/table/rivals/task.rs`."""

    def __init__(self, head, lines):
        self.kind, obstacles, cases = head
        numbers = lambda: [float(word) for word in next(lines).split()]
        self.settings = numbers()
        self.obstacles = [numbers() for _ in range(int(obstacles))]
        self.cases = [numbers() for _ in range(int(cases))]


def ways(task):
    for name, peer in PEERS.items():
        try:
            ask = peer(task)
        except ImportError as missing:
            print(f"{name} is left out: {missing}", file=sys.stderr)
            continue
        if ask:
            yield name, ask


def lap(ask, cases):
    """Nanoseconds a case. A crowd's cases are its robots, which one step moves."""
    start = time.perf_counter_ns()
    for i in cases:
        ask(i)
    return time.perf_counter_ns() - start


def main():
    answers_to = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what the packages print is no answer
    lines = iter(sys.stdin.readline, "")
    answer = lambda line: print(line, file=answers_to, flush=True)
    task, asked, some = None, [], []
    for line in lines:
        word, *rest = line.split()
        if word == "task":
            task = Task(rest, lines)
            asked = list(ways(task))
            some = [None] * len(asked)
            answer("|".join(name for name, _ in asked))
            continue
        number = int(rest[0])
        ask, count = asked[number][1], len(task.cases)
        if word == "answers":
            for i in range(count if task.kind != "crowd" else 1):
                answer(" ".join(repr(value) for value in ask(i)))
            for _ in range(count - 1 if task.kind == "crowd" else 0):
                answer("0")
        elif task.kind == "crowd":
            answer(lap(ask, [0]) / count)
        else:
            if some[number] is None:
                few = list(range(0, count, max(1, count // 4)))
                each = max(1, lap(ask, few)) / len(few)
                some[number] = range(0, count, max(1, math.ceil(each * count / (LONGEST * 1e9))))
            answer(lap(ask, some[number]) / len(some[number]))


if __name__ == "__main__":
    main()
