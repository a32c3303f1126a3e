"""The questions, in worlds whose answers follow by hand."""

import math
import pickle

import numpy as np
import pytest

import motion_lab as ml

# a wall along x = 3 from y = 0 to y = 3, and a disc of 1 m about (0, 0)
WORLD = ml.World.from_shapes(segments=[(3, 0, 3, 3)], discs=[(0, 0, 1)], bounds=(-5, -5, 5, 5))


@pytest.fixture
def disc():
    return ml.Checker(WORLD, ml.Disc(radius=0.25))


def test_a_disc_touches_where_its_centre_is_as_near_as_its_radius(disc):
    # 1.25 m from the centre of the disc, and beyond
    assert [disc.intersects((x, 0)) for x in (1.0, 1.25, 1.2500001)] == [True, True, False]
    assert [disc.distance((x, 0)) for x in (1.0, 1.25, 1.5)] == [0.0, 0.0, 0.25]
    assert [disc.is_free((x, 0)) for x in (1.0, 1.25, 1.2500001)] == [False, False, True]
    np.testing.assert_allclose(disc.distance([(3, 5), (2, 4)]), [1.75, math.sqrt(2) - 0.25], atol=1e-12)


def test_a_witness_is_a_pair_of_nearest_points(disc):
    witness = disc.witness((2.0, 1.0))
    assert witness == (0.75, (2.25, 1.0), (3.0, 1.0), 0, 0)
    assert WORLD.obstacles[witness.obstacle].name == "segment 1"
    many = disc.witness([(2.0, 1.0), (-2.0, 0.0)])
    np.testing.assert_array_equal(many.on_obstacle, [(3, 1), (-1, 0)])
    np.testing.assert_array_equal(many.on_robot, [(2.25, 1), (-1.75, 0)])
    assert [WORLD.obstacles[i].name for i in many.obstacle] == ["segment 1", "disc 1"]
    assert (many.obstacle.dtype, many.part.dtype) == (np.int64, np.int64)


def test_where_there_is_no_obstacle_distances_are_infinite_and_numbers_are_minus_one():
    checker = ml.Checker(ml.World.from_shapes(bounds=(0, 0, 1, 1)), ml.Disc())
    assert checker.distance((0, 0)) == math.inf
    one = checker.witness((0, 0))
    assert (one.distance, one.part, one.obstacle) == (math.inf, -1, -1)
    assert all(map(math.isnan, (*one.on_robot, *one.on_obstacle)))
    many = checker.witness([(0, 0)] * 3)
    assert (many.distance == math.inf).all() and (many.obstacle == -1).all() and (many.part == -1).all()
    assert np.isnan(many.on_robot).all() and np.isnan(many.on_obstacle).all()
    edge = checker.edge((0, 0), (1, 1))
    assert (edge.verdict, edge.clearance, edge.free_until, edge.obstacle) == (ml.FREE, math.inf, 1.0, -1)
    assert (ml.scan(checker.world, (0, 0, 0)) == math.inf).all()


def test_an_edge_is_free_or_hits_where_its_line_comes_near(disc):
    free, hit = disc.edge((2, -4), (2, 4)), disc.edge((1.5, 1), (4.5, 1))
    assert free.verdict is ml.FREE and hit.verdict is ml.HIT
    # 0.75 m from either obstacle's nearest point to the line's
    assert 0.7 < free.clearance <= 0.75
    assert (free.free_until, free.contact_at, free.part, free.obstacle) == (1.0, math.inf, -1, -1)
    # the disc's edge meets the wall when its centre is at x = 2.75, at (2.75 - 1.5) / 3 of the way
    assert hit.free_until <= 1.25 / 3 <= hit.contact_at < 1.25 / 3 + 1e-6
    assert (hit.clearance, hit.part, hit.obstacle) == (0.0, 0, 0)
    many = disc.edge([(2, -4), (1.5, 1)], [(2, 4), (4.5, 1)])
    assert (many.verdict == [ml.FREE, ml.HIT]).all() and (many.verdict == ml.HIT).tolist() == [False, True]
    assert many.verdict.dtype == np.int8
    np.testing.assert_array_equal(np.array(list(zip(*many, strict=True))), [free, hit])
    assert disc.edge_free((2, -4), (2, 4)) and not disc.edge_free((1.5, 1), (4.5, 1))
    assert disc.swept((1.5, 1), (4.5, 1)) and not disc.swept((2, -4), (2, 4))


def test_an_edge_that_grazes_within_rounding_is_unresolved_or_hits_and_is_never_free(disc):
    edge = disc.edge((2.75, -4), (2.75, 4))
    assert edge.verdict in (ml.HIT, ml.UNRESOLVED)
    assert not disc.edge_free((2.75, -4), (2.75, 4))
    # the wall begins at y = 0: the disc touches it there first
    assert edge.free_until <= 0.5 + 1e-6


def test_an_arms_edge_turns_the_short_way_round():
    # a wall that only the long way round crosses
    world = ml.World.from_shapes(segments=[(1.5, -0.5, 1.5, 0.5)], bounds=(-3, -3, 3, 3))
    arm = ml.Checker(world, ml.Reach((1, 1), radius=0))
    a, b = (math.pi - 0.5, 0.0), (math.pi + 0.5, 0.0)
    assert arm.edge_free(a, b)
    assert not arm.edge_free((-0.5, 0.0), (0.5, 0.0))
    assert arm.edge((-0.5, 0.0), (0.5, 0.0)).part == 1, "the outer link"
    # angles are the same a full turn on
    assert arm.distance((math.pi, 0.0)) == arm.distance((-math.pi, 0.0))


def test_a_hitch_beyond_its_limit_is_not_free_though_it_touches_nothing():
    world = ml.World.from_shapes(bounds=(-30, -30, 30, 30))
    car = ml.Checker(world, ml.Hitch(trailer=True, jackknife=1.25))
    folded, straight = (0, 0, 0, 1.5), (0, 0, 0, 0)
    assert not car.is_free(folded) and not car.intersects(folded) and car.is_free(straight)
    edge = car.edge(straight, folded)
    assert (edge.verdict, edge.obstacle) == (ml.HIT, -1)
    assert edge.free_until <= 1.25 / 1.5 <= edge.contact_at
    many = car.edge([straight], [folded])
    assert (many.verdict[0], many.obstacle[0], many.part[0]) == (ml.HIT, -1, edge.part)


def test_a_certificate_is_verified_and_a_forged_one_is_not(disc):
    a, b = (2, -4), (2, 4)
    proof = disc.certificate(a, b)
    assert proof.verify() == proof.proven_until == 1.0
    assert 0 < proof.clearance <= 0.75 and len(proof) == len(proof.steps) > 0
    again = ml.Certificate(disc, a, b, proof.steps, proof.margin)
    assert again.verify() == 1.0
    assert pickle.loads(pickle.dumps(proof)).verify() == 1.0
    forged = proof.steps.copy()
    forged[0, 2] = 5.0
    with pytest.raises(ml.Error, match="^step 0 claims 5 m of clearance, but only .* m are proven$"):
        ml.Certificate(disc, a, b, forged).verify()
    with pytest.raises(ml.Error, match="^step 0 does not begin where the one before ends$"):
        ml.Certificate(disc, a, b, [(0.5, 1.0, 0.1)]).verify()
    with pytest.raises(ml.Error, match="^step 0 claims"):
        ml.Certificate(disc, (1.5, 1), (4.5, 1), [(0.0, 1.0, 0.1)]).verify()
    assert ml.Certificate(disc, a, b, np.zeros((0, 3))).verify() == 0.0
    with pytest.raises(ml.Error):
        ml.Certificate(disc, a, b, [(np.nan, np.nan, np.nan)]).verify()
    blocked = disc.certificate((1.5, 1), (4.5, 1))
    assert blocked.verify() == blocked.proven_until <= 1.25 / 3
    touching = disc.certificate((1, 0), (4, 0))
    assert (len(touching), touching.verify(), touching.clearance) == (0, 0.0, math.inf)
    assert touching.steps.shape == (0, 3)


def test_a_scan_reads_the_way_to_the_walls():
    ranges = ml.scan(WORLD, [(2, 0.5, 0), (2, 0.5, math.pi / 2)], rays=4, range=4.0)
    # ahead the wall at x = 3, to the left and the right nothing, behind the disc, whose side is at x^2 + y^2 = 1
    disc = 2 - math.sqrt(0.75)
    np.testing.assert_allclose(ranges, [(1, math.inf, disc, math.inf), (math.inf, disc, math.inf, 1)], atol=1e-12)
    assert (ml.scan(WORLD, (0.5, 0, 0), rays=5) == 0).all(), "inside the disc"
    # a wall one metre ahead: at bearing b it is 1 / cos b away
    fan = ml.scan(WORLD, (2, 1, 0), rays=3, field_of_view=1.0)
    np.testing.assert_allclose(fan, [1 / math.cos(0.5), 1.0, 1 / math.cos(0.5)], atol=1e-12)
    np.testing.assert_array_equal(ml.scan(WORLD, (2, 1, 0), field_of_view=2 * math.pi), ml.scan(WORLD, (2, 1, 0)))
    # a scan between two others of another sensor changes neither
    np.testing.assert_array_equal(ml.scan(WORLD, (2, 1, 0), rays=3, field_of_view=1.0), fan)
    assert ml.scan(WORLD, (2, 1, 0), rays=3, range=0.5, field_of_view=1.0).tolist() == [math.inf] * 3
    np.testing.assert_array_equal(ml.scan(WORLD, (2, 1, 0), rays=3, field_of_view=1.0), fan)
    for wrong, words in [
        ({"rays": 0}, "0 rays: there must be 1 to 100000"),
        ({"rays": -5}, "-5 rays: there must be 1 to 100000"),
        ({"range": 0.0}, "range 0 m: it must be 0.001 to 10000 m"),
        ({"range": math.nan}, "range NaN m: it must be 0.001 to 10000 m"),
    ]:
        with pytest.raises(ml.Error) as refused:
            ml.scan(WORLD, (2, 1, 0), **wrong)
        assert str(refused.value) == words
    with pytest.raises(ml.Error, match="^field of view 9 rad"):
        ml.scan(WORLD, (2, 1, 0), field_of_view=9.0)


def test_a_checker_knows_its_coordinates():
    for robot, names, units, angles in [
        (ml.Disc(), ("x", "y"), ("m", "m"), ()),
        (ml.Rusty(), ("x", "y", "theta"), ("m", "m", "rad"), (2,)),
        (ml.Reach(), ("th1", "th2"), ("rad", "rad"), (0, 1)),
        (ml.Reach((1, 1, 1)), ("th1", "th2", "th3"), ("rad",) * 3, (0, 1, 2)),
        (ml.Hitch(), ("x", "y", "theta"), ("m", "m", "rad"), (2,)),
        (ml.Hitch(trailer=True), ("x", "y", "theta", "psi"), ("m", "m", "rad", "rad"), (2, 3)),
    ]:
        checker = ml.Checker(WORLD, robot)
        assert (checker.coordinates, checker.units, checker.angles) == (names, units, angles)
        assert (robot.coordinates, robot.units, robot.angles) == (names, units, angles)
        assert checker.world is WORLD and checker.robot is robot


def test_a_checker_needs_a_world_and_a_robot():
    with pytest.raises(
        TypeError, match=r"^a robot is a Disc, Rusty, Reach or Hitch, not the class Rusty: write Rusty\(\)$"
    ):
        ml.Checker("lot", ml.Rusty)
    with pytest.raises(TypeError, match="^a robot is a Disc, Rusty, Reach or Hitch, not str$"):
        ml.Checker("lot", "rusty")
    with pytest.raises(TypeError, match="^a world is a World or the name of one, not int$"):
        ml.Checker(3, ml.Rusty())
    with pytest.raises(ml.WorldError, match='^no built-in world is named "apartmnt"; did you mean "apartment"\\?$'):
        ml.Checker("apartmnt", ml.Rusty())
    with pytest.raises(ValueError, match="^a is an array of more than one axis$"):
        ml.Checker("lot", ml.Disc()).certificate([(0, 0)], (1, 1))


def test_robots_have_the_sizes_of_the_library_and_refuse_what_it_refuses():
    world = ml.World.from_shapes(segments=[(100, -9, 100, 9)], bounds=(-5, -9, 105, 9))
    # how far the robot reaches ahead of x = 0: a radius; a car of 3.9 m with 0.7 m behind its axle; two links of 1 m
    for robot, q, reach in [
        (ml.Disc(), (0, 0), 0.11),
        (ml.Rusty(), (0, 0, 1), 0.11),
        (ml.Rusty(0.3), (0, 0, 1), 0.3),
        (ml.Hitch(), (0, 0, 0), 3.2),
        (ml.Hitch(length=4.9), (0, 0, 0), 4.2),
        (ml.Reach(), (0, 0), 2.03),
        (ml.Reach((0.5, 0.25, 0.25), base=(1, 2), radius=0), (0, 0, 0), 2.0),
    ]:
        assert ml.Checker(world, robot).distance(q) == pytest.approx(100 - reach, abs=1e-12)
        assert pickle.loads(pickle.dumps(robot)) == robot != ml.Disc(radius=0.111)
        assert hash(pickle.loads(pickle.dumps(robot))) == hash(robot)
    for make, words in [
        (lambda: ml.Disc(0), "radius 0 m: it must be finite, from 0.001 to 10000 m"),
        (lambda: ml.Disc(math.nan), "radius NaN m: it must be finite, from 0.001 to 10000 m"),
        (lambda: ml.Rusty(-1), "disc.radius -1: it must be from 0.001 to 1000"),
        (lambda: ml.Reach((1,)), "1 length: an arm has 2 or 3 links"),
        (lambda: ml.Reach((1,) * 4), "4 lengths: an arm has 2 or 3 links"),
        (lambda: ml.Reach((1, 0)), "arm.lengths[1] 0: it must be from 0.001 to 1000"),
        (lambda: ml.Hitch(width=0), "car.width 0: it must be from 0.001 to 1000"),
    ]:
        with pytest.raises(ml.Error) as refused:
            make()
        assert str(refused.value) == words
    assert (ml.Disc(0.5).radius, ml.Rusty(0.5).radius, ml.Reach((1, 2)).lengths) == (0.5, 0.5, (1.0, 2.0))
    assert (ml.Hitch().trailer, ml.Hitch(trailer=True).trailer) == (False, True)
    assert (repr(ml.Reach((1, 2))), repr(ml.Rusty())) == ("Reach(lengths=(1.0, 2.0))", "Rusty()")
    sized = ml.Hitch(trailer=True, jackknife=1.2, length=4.5)
    assert eval(repr(sized), vars(ml)) == sized
    assert eval(repr(ml.Rusty(track=0.2)), vars(ml)) == ml.Rusty(track=0.2)


@pytest.mark.parametrize("margin", [-10.0, -0.2, float("nan"), float("inf"), -float("inf")])
def test_a_margin_that_is_none_proves_nothing(margin):
    checker = ml.Checker("apartment", ml.Disc())
    assert checker.edge((1, 4), (1, 7)).verdict == ml.HIT
    with pytest.raises(ValueError, match=r"^margin .*: it must be finite and not below 0 m$"):
        ml.Certificate(checker, (1, 4), (1, 7), [[0, 1, -9.0]], margin=margin)


def test_the_version_is_that_of_the_package():
    from importlib.metadata import version

    assert ml.__version__ == version("motion-lab")


def test_a_row_that_is_none_is_named_in_its_own_axes_also_where_it_is_broadcast():
    disc = ml.Checker("apartment", ml.Disc())
    good, bad = np.full((3, 4, 2), 2.0), np.full((4, 2), 2.0)
    bad[2, 1] = np.nan
    for ask in [disc.edge_free, disc.edge, disc.swept]:
        for a, b, name, row in [
            (good, bad, "b", (2,)),
            (bad, good, "a", (2,)),
            (good, bad[2:3], "b", (0,)),
            (np.empty((0, 4, 2)), bad, "b", (2,)),
            (good, np.broadcast_to(bad, (3, 4, 2)), "b", (0, 2)),
        ]:
            with pytest.raises(ml.ConfigurationError) as refused:
                ask(a, b)
            assert (refused.value.name, refused.value.row) == (name, row)


def test_a_proof_of_a_part_is_not_true(disc):
    whole, blocked = disc.certificate((2, -4), (2, 4)), disc.certificate((1.5, 1), (4.5, 1))
    proof = whole.verify()
    assert proof and proof.holds is True and proof.up_to == 1.0 and isinstance(proof, ml.Proven)
    part = blocked.verify()
    assert not part and part.holds is False and 0.0 < part.up_to == part <= 1.25 / 3
    assert type(part.up_to) is float and f"{part:.3f}" == f"{part.up_to:.3f}"
    assert str(part) == str(part.up_to) and repr(part) == f"Proven(up_to={part.up_to!r}, holds=False)"
    again = pickle.loads(pickle.dumps(part))
    assert again == part and not again
    assert not ml.Certificate(disc, (2, -4), (2, 4), np.zeros((0, 3))).verify()


def test_what_would_be_true_whatever_it_says_is_not_asked(disc):
    through = ((1.5, 1), (4.5, 1))
    edge = disc.edge(*through)
    assert edge.verdict == ml.HIT and disc.edge((2, -4), (2, 4)).verdict == ml.FREE == 0
    for answer, words in [
        (disc.certificate(*through), r"certificate\.verify\(\)"),
        (edge, "edge_free"),
        (disc.edge([through[0]], [through[1]]), "edge_free"),
        (edge.verdict, "compare it"),
        (ml.FREE, "compare it"),
        (disc.witness(through[0]), "compare its distance"),
    ]:
        with pytest.raises(TypeError, match=f"neither true nor false.*{words}"):
            bool(answer)
