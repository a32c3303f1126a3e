use std::collections::BTreeSet;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use super::*;
use motion_lab_core::collision::{Collision, EdgeVerdict, Scene};
use motion_lab_core::configuration::{AnyConfiguration, Configuration, T2};
use motion_lab_core::geometry::{Aabb, Footprint, Point2, Shape};
use motion_lab_core::num::{cos, sin, sqrt};
use motion_lab_core::picture::{Drawing, Item, Role};
use motion_lab_core::robots::{AnyRobot, Reach, Robot};
use motion_lab_core::worlds::{Obstacle, ObstacleKind, World};

fn at(th1: f64, th2: f64, thick: bool) -> Anatomy {
    let mut anatomy = Anatomy::default();
    anatomy.set_thick_links(thick);
    anatomy.set_coordinate(0, th1);
    anatomy.set_coordinate(1, th2);
    anatomy
}

fn ids(items: &[Item]) -> Vec<&str> {
    items.iter().map(|i| i.id.as_str()).collect()
}

fn item<'a>(items: &'a [Item], id: &str) -> &'a Item {
    items.iter().find(|i| i.id == id).unwrap_or_else(|| panic!("no {id} among {:?}", ids(items)))
}

#[test]
fn the_default_shows_the_chapters_numbers() {
    let bare = Anatomy::default();
    assert_eq!(bare.readout(), ["intersects: false"]);
    let exact = 1.5 / sqrt(2.0) - 1.0;
    assert!((bare.distance() - exact).abs() < 1e-9 && (exact - 0.0606602).abs() < 1e-7);
    assert_eq!(bare.clone().with_tab(Tab::Distance).readout()[0], "distance: 0.0607 m");
    let pairs = bare.nearest();
    assert_eq!(pairs.len(), 1);
    assert_eq!(pairs[0].on_obstacle, Feature::Corner(Point2::new(0.5, 1.0)));
    let foot = Point2::new(1.0 / sqrt(2.0) - 0.25, 1.0 / sqrt(2.0) + 0.25);
    assert!((pairs[0].witness.on_robot - foot).norm() < 1e-6);
    let words = bare.with_tab(Tab::Witness).readout();
    assert_eq!(
        words,
        [
            "a* = (0.457, 0.957) on link 2",
            "b* = (0.500, 1.000) at a corner of the block",
            "|a* \u{2212} b*| = 0.0607 m"
        ]
    );
    let thick = at(FRAC_PI_4, FRAC_PI_2, true);
    assert!((thick.distance() - (exact - 0.03)).abs() < 1e-9, "less by exactly the radius");
    assert_eq!(thick.thick_links(), Some(true));
}

#[test]
fn the_distance_falls_to_exactly_0_and_stays_there_red() {
    for (thick, contact) in [(false, 1.4008779), (true, 1.4846065)] {
        let before = at(FRAC_PI_4, contact + 1e-6, thick).with_tab(Tab::Distance);
        assert!(before.distance() > 0.0 && before.distance() < 1e-5);
        assert_eq!(item(&before.picture().items, "robot/Reach/1").role, Role::Robot);
        for k in 0..50 {
            let th2 = (contact - 1e-6) * f64::from(50 - k) / 50.0;
            let anatomy = at(FRAC_PI_4, th2, thick).with_tab(Tab::Distance);
            assert_eq!(anatomy.distance(), 0.0, "theta2 = {th2}");
            assert_eq!(anatomy.readout()[0], "distance: 0 m");
            let picture = anatomy.picture();
            assert_eq!(item(&picture.items, "robot/Reach/1").role, Role::Goal, "red the moment it touches");
            assert_eq!(item(&picture.items, "contact").role, Role::Goal);
            assert!(!ids(&picture.items).contains(&"witness/1/segment"), "there is no way between");
        }
    }
}

#[test]
fn exercise_3_touches_then_reads_its_number() {
    let mut anatomy = Anatomy::exercise_3();
    assert!(anatomy.intersects() && anatomy.distance() == 0.0);
    anatomy.set_coordinate(1, FRAC_PI_2 + 0.3);
    assert!((anatomy.distance() - (0.9 * sin(0.3) - 0.1 * cos(0.3))).abs() < 1e-9);
    let pair = anatomy.nearest()[0];
    assert!((pair.witness.on_obstacle - Point2::new(0.9, 0.9)).norm() < 1e-12);
    assert!(matches!(pair.on_obstacle, Feature::Corner(_)));
}

#[test]
fn the_witness_jumps_from_corner_to_edge_and_the_tie_shows_both() {
    // link 2 is level at theta2 = 3 pi/4: on one side of that the block's corner is nearest to the link, on the other
    // its lower edge is nearest to the elbow
    let tie = 0.75 * PI;
    let at = |th2| {
        let mut world = World::workbench();
        world.obstacles.retain(|o| o.name == "the block"); // the post would be nearer by then
        let q = AnyConfiguration::T2(T2::new(FRAC_PI_4, th2));
        Anatomy::new(world, WorldSource::Unsaved, AnyRobot::Reach(Reach::choset()), q).unwrap()
    };
    let corner = at(tie - 0.01).nearest();
    assert_eq!((corner.len(), corner[0].on_obstacle), (1, Feature::Corner(Point2::new(0.5, 1.0))));
    let edge = at(tie + 0.01).nearest();
    assert!(matches!(edge[0].on_obstacle, Feature::Edge(..)) && edge.len() == 1, "{edge:?}");
    let jump = corner[0].witness.on_obstacle - edge[0].witness.on_obstacle;
    assert!(jump.norm() > 0.2, "it jumps, {}", jump.norm());

    let both = at(tie).with_tab(Tab::Witness);
    let pairs = both.nearest();
    assert_eq!(pairs.len(), 2, "{pairs:?}");
    let kinds =
        (matches!(pairs[0].on_obstacle, Feature::Corner(_)), matches!(pairs[1].on_obstacle, Feature::Corner(_)));
    assert!(kinds.0 != kinds.1, "one at the corner, one on the edge: {pairs:?}");
    assert!((pairs[0].witness.dist - pairs[1].witness.dist).abs() <= TIE);
    assert!(both.readout()[0].starts_with("a tie of 2"));
    let shown = both.overlay();
    item(&shown.items, "witness/1/segment");
    item(&shown.items, "witness/2/segment");
}

#[test]
fn every_tied_pair_is_a_pair_of_nearest_points() {
    let mut s = motion_lab_core::random::Stream::new(motion_lab_core::random::Seed(11), "ties");
    let mut ties = 0;
    for k in 0..300 {
        // in every other case a link is level or upright, and edges are parallel
        let th1 = s.uniform(-PI, PI);
        let th2 = if k % 2 == 0 {
            s.uniform(-PI, PI)
        } else {
            motion_lab_core::num::wrap(FRAC_PI_2 * f64::from(k % 4) - th1)
        };
        let anatomy = at(th1, th2, k % 3 == 0);
        let (scene, robot) = (anatomy.checker().scene(), anatomy.footprint());
        let pairs = anatomy.nearest();
        assert_eq!(Some(pairs[0].witness), scene.witness(&robot));
        ties += usize::from(pairs.len() > 1);
        for pair in &pairs {
            let w = pair.witness;
            assert!((w.dist - anatomy.distance()).abs() <= TIE);
            assert!(((w.on_robot - w.on_obstacle).norm() - w.dist).abs() < 1e-12);
            // each point lies on its obstacle: a point there touches
            let grown = Footprint::disc(w.on_obstacle, 1e-9);
            assert!(scene.intersects(&grown), "{w:?}");
        }
    }
    assert!(ties > 0, "none of them tied");
}

#[test]
fn the_tip_is_dragged_on_the_elbow_side_and_within_the_annulus() {
    let mut anatomy = Anatomy::default();
    let to = Point2::new(-1.0, 0.7);
    anatomy.drag(to);
    assert!((anatomy.checker().robot().reference(&anatomy.q()) - to).norm() < 1e-12);
    assert!(anatomy.q().coordinates()[1] > 0.0);
    anatomy.set_coordinate(1, -1.0);
    anatomy.drag(Point2::new(9.0, 0.0));
    assert_eq!(anatomy.q().coordinates()[1], 0.0, "straight at the annulus' border");
    anatomy.drag(to);
    assert!(anatomy.q().coordinates()[1] < 0.0, "and back on the side it was on");
    anatomy.drag(Point2::origin());
    anatomy.drag(to);
    assert!(anatomy.q().coordinates()[1] < 0.0, "folded it keeps its side too");
    let before = anatomy.q();
    anatomy.drag(Point2::new(f64::NAN, 0.0));
    anatomy.set_coordinate(0, f64::INFINITY);
    anatomy.set_step(0, f64::NAN);
    assert_eq!(anatomy.q(), before);
    assert_eq!(anatomy.range(0), [-PI, PI]);
}

#[test]
fn swept_catches_midpoint() {
    let mut anatomy = at(2.0, 0.0, false).with_tab(Tab::Swept);
    anatomy.set_step(0, 1.1);
    anatomy.set_step(1, 0.0);
    let sweep = anatomy.sweep().unwrap();
    assert!(sweep.from_free && sweep.to_free, "free end points included");
    let EdgeVerdict::Hit { free_until, contact_at, part: 0, by } = sweep.verdict else { panic!("{:?}", sweep.verdict) };
    assert_eq!(by.obstacle().and_then(|id| anatomy.checker().scene().obstacle_name(id)), Some("the post"));
    assert!(sweep.width <= 1e-6 && free_until < contact_at, "bracketed to a micrometre");
    assert!(anatomy.checker().is_free(&sweep.at(free_until)) && !anatomy.checker().is_free(&sweep.at(contact_at)));
    let picture = anatomy.picture();
    assert_eq!(item(&picture.items, "hit/0").role, Role::Goal, "a red ghost between");
    item(&picture.items, "hit/words");
    let unique: BTreeSet<&str> = ids(&picture.items).into_iter().collect();
    assert_eq!(unique.len(), picture.items.len(), "ids are unique");
    assert_eq!(item(&picture.items, "second/0").role, Role::Robot);
    assert_eq!(item(&picture.items, "robot/Reach/0").role, Role::Robot);
    assert!(ids(&picture.items).iter().any(|id| id.starts_with("step/")));
    assert!(anatomy.readout().iter().any(|l| l == "link 1 hits the post"), "{:?}", anatomy.readout());
    // a smaller step is free, and its proof is shown
    anatomy.set_step(0, 0.2);
    let sweep = anatomy.sweep().unwrap();
    assert!(sweep.verdict.is_free() && sweep.certificate.proven_until() == 1.0);
    assert!(anatomy.readout()[1].starts_with("free all the way, at least"));
    assert!(!ids(&anatomy.picture().items).contains(&"hit/0"));
}

#[test]
fn the_step_goes_the_short_way_and_no_farther_than_pi() {
    let mut anatomy = Anatomy::default();
    anatomy.set_step(0, 9.0);
    assert_eq!(anatomy.step(), [PI, 0.0]);
    assert!((anatomy.second().coordinates()[0] - (FRAC_PI_4 - PI)).abs() < 1e-15);
}

#[test]
fn any_robot_in_any_world_has_an_anatomy() {
    for name in World::built_in_names() {
        let world = World::built_in(name).unwrap();
        let anatomy = Anatomy::of_world(world, WorldSource::BuiltIn("lot")).unwrap();
        for tab in Tab::ALL {
            let anatomy = anatomy.clone().with_tab(tab);
            let picture = anatomy.picture();
            let unique: BTreeSet<&str> = ids(&picture.items).into_iter().collect();
            assert_eq!(unique.len(), picture.items.len(), "{name} {tab:?}: ids are unique");
            assert!(!anatomy.readout().is_empty() && anatomy.described().contains(&anatomy.q().to_string()));
        }
    }
    let empty = World { obstacles: Vec::new(), ..World::lot() };
    let nothing = Anatomy::of_world(empty, WorldSource::Unsaved).unwrap().with_tab(Tab::Witness);
    assert_eq!(nothing.readout(), ["no witness: nothing is there"]);
    assert_eq!(nothing.clone().with_tab(Tab::Distance).readout()[0], "distance: \u{221e}");
    assert!(nothing.close_up().is_none() && !nothing.picture().items.is_empty());
    let nobody = World { robots: Vec::new(), ..World::lot() };
    assert!(Anatomy::of_world(nobody, WorldSource::Unsaved).is_none());
}

#[test]
fn the_annulus_is_drawn_on_demand() {
    let mut anatomy = Anatomy::default();
    assert!(!ids(&anatomy.picture().items).iter().any(|id| id.starts_with("annulus")));
    anatomy.show_annulus = true;
    let items = anatomy.picture().items;
    item(&items, "annulus/outer circle");
    assert!(!ids(&items).contains(&"annulus/inner circle"), "of equal links it is a point");
}

#[test]
fn every_robot_goes_into_every_world_and_stands_free() {
    let anatomy = Anatomy::default().with_tab(Tab::Witness);
    let mut s = motion_lab_core::random::Stream::new(motion_lab_core::random::Seed(3), "choices");
    let mut in_contact = 0;
    for name in World::built_in_names() {
        let there = anatomy.in_world(World::built_in(name).unwrap(), WorldSource::BuiltIn(name));
        for (choice, robot) in Anatomy::choices() {
            let chosen = there.with_robot(robot);
            assert_eq!(
                (chosen.checker().robot(), chosen.tab, &chosen.world().name),
                (&robot, Tab::Witness, &there.world().name)
            );
            if chosen.intersects() {
                // the arm's base is at a corner of walls, or the car fits nowhere at its heading: no sample is free
                let bounds = there.world().bounds;
                for _ in 0..2000 {
                    let drawn = robot.sample(bounds.min, bounds.max, &mut s);
                    let place = [0, 1].map(|i| drawn.coordinates()[i]);
                    let q = chosen.q().with(0, place[0]).with(1, place[1]);
                    assert!(!chosen.checker().is_free(&q), "{choice} in {name}: {q}");
                }
                in_contact += 1;
            }
            assert!(!chosen.picture().items.is_empty() && chosen.q().coordinates().iter().all(|c| c.is_finite()));
        }
    }
    assert!(in_contact <= 9, "{in_contact} of 18");
    // a configuration that fits both robots stays
    let mut bent = anatomy.clone();
    bent.set_coordinate(1, 0.3);
    let thick = bent.with_robot(AnyRobot::Reach(Reach::workbench()));
    assert_eq!((thick.q(), thick.step()), (bent.q(), bent.step()));
    let towing = anatomy.in_world(World::lot(), WorldSource::BuiltIn("lot")).with_robot(Anatomy::choices()[5].1);
    assert_eq!(towing.q().coordinates().len(), 4);
}

#[test]
fn what_is_unresolved_is_shown_with_its_reason() {
    // the straight arm turns under a wall that is one ulp above its reach
    let above = f64::from_bits(2.0_f64.to_bits() + 1);
    let mut world = World { obstacles: Vec::new(), ..World::workbench() };
    let wall = Shape::Segment { a: Point2::new(-1.0, above), b: Point2::new(1.0, above) };
    let pieces = vec![(motion_lab_core::geometry::Pose2::IDENTITY, wall)];
    world.obstacles.push(Obstacle::new("the lid", ObstacleKind::Wall, pieces));
    let q = AnyConfiguration::T2(T2::new(0.5 * PI - 0.4, 0.0));
    let arm = AnyRobot::Reach(Reach::choset());
    let mut anatomy = Anatomy::new(world, WorldSource::Unsaved, arm, q).unwrap().with_tab(Tab::Swept);
    anatomy.set_step(0, 0.8);
    let sweep = anatomy.sweep().unwrap();
    let EdgeVerdict::Unresolved { free_until, gap, .. } = sweep.verdict else { panic!("{:?}", sweep.verdict) };
    assert!(free_until > 0.49 && free_until < 0.51 && sweep.width == gap, "{:?}", sweep.verdict);
    assert!(sweep.from_free && sweep.to_free);
    assert_eq!(anatomy.readout()[1], "unresolved: the gap is below what rounding can tell from contact");
    let picture = anatomy.picture();
    assert!(ids(&picture.items).iter().any(|id| id.starts_with("step/")));
    assert_eq!(item(&picture.items, "unresolved").role, Role::Unknown);
}

#[test]
fn the_distance_stands_where_it_covers_neither_robot_nor_obstacle() {
    let mut s = motion_lab_core::random::Stream::new(motion_lab_core::random::Seed(5), "plates");
    let mut crowded = 0;
    for _ in 0..200 {
        let anatomy = at(s.uniform(-PI, PI), s.uniform(-PI, PI), true).with_tab(Tab::Distance);
        if anatomy.intersects() {
            continue;
        }
        for picture in [anatomy.picture(), anatomy.close_up().unwrap()] {
            let motion_lab_core::picture::Drawing::Label { at: place, .. } =
                item(&picture.items, "witness/distance").drawing.clone()
            else {
                panic!("a label")
            };
            let Aabb { min, max } = picture.bounds;
            assert!(place.x > min.x && place.x < max.x && place.y > min.y && place.y < max.y);
            // the middle of the words, with half their height around it
            let words = Footprint::disc(place, 0.02 * (max.y - min.y));
            let itself = anatomy.footprint().parts().iter().fold(Scene::empty(picture.bounds), |scene, part| {
                let core = part.placed().core();
                scene.with_obstacle("itself", Shape::Capsule { a: core[0], b: core[1], radius: part.placed().radius() })
            });
            crowded += u32::from(anatomy.checker().scene().intersects(&words) || itself.intersects(&words));
            let w = anatomy.nearest()[0].witness;
            let (lo, hi) = (picture.bounds.min, picture.bounds.max);
            for p in [w.on_robot, w.on_obstacle] {
                assert!(p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y, "both points are in view");
            }
        }
    }
    assert_eq!(crowded, 0);
}

#[test]
fn the_names_of_the_nearest_points_stand_off_what_they_name() {
    // corner and edge, near and far
    let mut named = 0;
    for th2 in [FRAC_PI_2, 1.5, 1.7, 2.2, 2.6] {
        let anatomy = at(FRAC_PI_4, th2, false).with_tab(Tab::Witness);
        let close = anatomy.close_up().unwrap();
        if !ids(&close.items).contains(&"witness/1/a*") {
            // points this near leave no room for names
            continue;
        }
        named += 1;
        let size = close.bounds.max.x - close.bounds.min.x;
        for id in ["witness/1/a*", "witness/1/b*"] {
            let Drawing::Label { at, .. } = item(&close.items, id).drawing else { panic!("a label") };
            let point = Footprint::disc(at, 0.0);
            let off = anatomy.checker().scene().distance(&point);
            assert!(off > 0.03 * size, "{id} at theta2 = {th2}: {off} of {size} from an obstacle");
        }
    }
    assert!(named >= 3, "{named}");
}

#[test]
fn a_robot_goes_where_it_lives() {
    let anatomy = Anatomy::default();
    let robot = |name: &str| Anatomy::choices().into_iter().find(|(n, _)| *n == name).unwrap().1;
    let home = anatomy.at_home(robot("Hitch with its trailer"));
    assert_eq!((home.world().name.as_str(), home.intersects()), ("Lot", false));
    assert_eq!(anatomy.at_home(robot("Reach, three links")).world().name, "Workbench", "an arm stays");
    let mut own = World::lot();
    own.name = "Mine".into();
    let mine = home.in_world(own, WorldSource::Unsaved);
    assert_eq!(mine.at_home(robot("Rusty")).world().name, "Mine", "a world of one's own is kept");
}

#[test]
fn links_of_any_length_have_their_annulus_and_their_two_elbows() {
    let mut anatomy = Anatomy::default();
    anatomy.show_annulus = true;
    anatomy.set_length(1, 0.4);
    assert_eq!(anatomy.lengths(), Some([1.0, 0.4]));
    let radius = |anatomy: &Anatomy, circle: &str| match item(&anatomy.picture().items, circle).drawing {
        Drawing::Disc { radius, .. } => radius,
        _ => panic!("a circle"),
    };
    let radii = ["annulus/inner circle", "annulus/outer circle"].map(|circle| radius(&anatomy, circle));
    assert!((radii[0] - 0.6).abs() < 1e-15 && (radii[1] - 1.4).abs() < 1e-15, "{radii:?}");
    // by the law of cosines: d^2 = 1 + 0.16 + 0.8 cos theta2
    anatomy.drag(Point2::new(0.0, -0.9));
    let AnyConfiguration::T2(q) = anatomy.q() else { panic!("an arm") };
    assert!((1.16 + 0.8 * cos(q.th2()) - 0.81).abs() < 1e-12, "{q}");
    assert_eq!(anatomy.solutions().len(), 2);
    // too near the base: on the inner circle the arm is folded, and there is one
    anatomy.drag(Point2::new(0.0, -0.2));
    assert_eq!(anatomy.solutions().len(), 1);
    for (link, length, expected) in [(0, 0.0, 0.1), (1, 7.0, 1.5)] {
        anatomy.set_length(link, length);
        assert_eq!(anatomy.lengths().map(|lengths| lengths[link]), Some(expected));
    }
    anatomy.set_length(0, f64::NAN);
    anatomy.set_length(2, 1.0);
    assert_eq!(anatomy.lengths(), Some([0.1, 1.5]));
    let mut car = anatomy.at_home(AnyRobot::Hitch(motion_lab_core::robots::HITCH));
    car.set_length(0, 1.0);
    assert_eq!(car.lengths(), None);
}
