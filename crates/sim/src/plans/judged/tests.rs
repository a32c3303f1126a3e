use super::*;
use crate::plans::PathFile;
use motion_lab_core::collision::Certificate;
use motion_lab_core::prelude::*;

/// The judgement of a path of the Workbench's arm through these corners.
fn judged(corners: &[[f64; 2]], ends: [[f64; 2]; 2]) -> Option<JudgedPath> {
    let legs: Vec<String> = corners
        .windows(2)
        .map(|ends| format!(r#"{{"kind": "chart line", "from": {:?}, "to": {:?}}}"#, ends[0], ends[1]))
        .collect();
    of("reach", World::workbench(), ends.map(|end| format!("{end:?}")), &legs.join(", "))
}

fn of(kind: &str, world: World, [start, goal]: [String; 2], legs: &str) -> Option<JudgedPath> {
    let text = format!(
        r#"{{"version": 1, "robot": {{"kind": "{kind}"}}, "start": {start}, "goal": {goal}, "legs": [{legs}]}}"#
    );
    let file = PathFile::read(&text).unwrap();
    let (robot, ends) = file.robot().unwrap();
    file.judged(&Task::new("own", robot, world, ends)).unwrap()
}

fn words(judged: Option<JudgedPath>) -> String {
    judged.unwrap().proof.unwrap_err().to_string()
}

#[test]
fn a_path_through_the_post_names_its_first_leg_that_hits_and_where() {
    let (start, goal) = ([2.0, 0.0], [3.1, 0.0]);
    let through = judged(&[start, goal], [start, goal]).unwrap();
    let Err(PathError::NotFree { leg: 0, obstacle: Some(name), .. }) = &through.proof else { panic!("{through:?}") };
    assert_eq!(name, "the post");
    // the post stands from -0.7 to -0.5 and from 0.3 to 0.5
    let hit = through.hit.unwrap();
    let at = hit.witness.unwrap().on_obstacle;
    assert!((-0.7..=-0.5).contains(&at.x) && (0.3..=0.5).contains(&at.y), "{at}");
    assert_eq!((hit.way[0].coordinates()[0], hit.way[6].coordinates()[0]), (start[0], goal[0]));
    let contact = hit.at.coordinates()[0];
    assert!(start[0] < contact && contact < goal[0], "{contact}");
    // the same leg behind a free one
    let behind = judged(&[[1.9, 0.0], start, goal], [[1.9, 0.0], goal]).unwrap();
    assert!(matches!(behind.proof, Err(PathError::NotFree { leg: 1, .. })), "{behind:?}");
}

#[test]
fn a_free_path_has_the_clearance_that_the_checker_proves_of_its_legs() {
    let corners = [[2.0, 0.0], [1.6, 0.0], [1.6, 0.3]];
    let proof = judged(&corners, [corners[0], corners[2]]).unwrap().proof.unwrap();
    let checker = ChainChecker::new(Scene::workbench(), Reach::<2>::workbench());
    let clearance = |ends: &[[f64; 2]]| {
        let mut proof = Certificate::new();
        checker.edge_certified(&Tn(ends[0]), &Tn(ends[1]), &mut proof).unwrap();
        proof.clearance()
    };
    let least = corners.windows(2).map(clearance).fold(f64::INFINITY, motion_lab_core::num::lesser);
    assert!(proof > 0.0 && (proof - least).abs() < 1e-9, "{proof} {least}");
}

#[test]
fn legs_that_part_end_elsewhere_or_leave_the_world_are_no_path() {
    let ends = [[2.0, 0.0], [1.5, 0.0]];
    let apart = r#"{"kind": "chart line", "from": [2, 0], "to": [1.9, 0]}, {"kind": "chart line", "from": [1.8, 0], "to": [1.5, 0]}"#;
    let reach = |legs| of("reach", World::workbench(), ends.map(|end| format!("{end:?}")), legs);
    assert_eq!(words(reach(apart)), "leg 1 does not begin where the one before ends");
    assert_eq!(words(judged(&[[2.0, 0.0], [1.6, 0.0]], ends)), "the path does not lead from the start to the goal");
    // the Lot ends at x = 16; without its curb 5 s at 1 m/s lead out of it, and back
    let open = World { obstacles: Vec::new(), ..World::lot() };
    let forth_and_back = |from: f64| {
        let there = HITCH
            .drive(&HitchCfg { body: Pose2::new(from, 4.5, 0.0), trailer: None }, &CarCmd { v: 1.0, phi: 0.0 }, 5.0)
            .unwrap()
            .at(1.0);
        let back = HITCH.drive(&there, &CarCmd { v: -1.0, phi: 0.0 }, 5.0).unwrap().at(1.0);
        let [start, turned, goal] = [from, there.body.x, back.body.x].map(|x| format!("[{x:?}, 4.5, 0]"));
        let leg = |from: &str, v: i8| {
            format!(r#"{{"kind": "drive", "from": {from}, "to": [], "control": {{"v": {v}, "phi": 0, "seconds": 5}}}}"#)
        };
        let legs = [leg(&start, 1), leg(&turned, -1)].join(", ");
        of("hitch", open.clone(), [start, goal], &legs.replace("[]", &turned)).unwrap().proof
    };
    assert_eq!(forth_and_back(12.0), Err(PathError::Outside(0)));
    assert_eq!(forth_and_back(10.0), Ok(f64::INFINITY));
}

#[test]
fn a_tree_alone_and_more_legs_than_are_judged_are_not_judged() {
    let ends = [[2.0, 0.0], [1.5, 0.0]];
    assert_eq!(judged(&ends[..1], ends), None);
    let many = |count: usize| vec![[2.0, 0.0]; count + 1];
    assert_eq!(judged(&many(MAX_JUDGED + 1), [[2.0, 0.0]; 2]), None);
    assert!(judged(&many(MAX_JUDGED), [[2.0, 0.0]; 2]).unwrap().proof.is_ok());
}

/// What is asked of a leg is asked of the motion that it is: a rover's line has the short proof of a disc's.
#[test]
fn a_leg_answers_as_its_motion_does() {
    let at = |x: f64, y: f64| AnyRobot::of_kind("rusty", &[x, y, 0.5]).unwrap();
    let ((rover, a), (_, b)) = (at(1.0, 2.0), at(1.5, 2.25));
    let line = rover.edge(&a, &b).unwrap();
    let disc = line.disc_line().unwrap();
    assert_eq!((disc.0.a, disc.0.b), (Point2::new(1.0, 2.0), Point2::new(1.5, 2.25)));
    assert_eq!(FileMotion::Line(Box::new(line)).disc_line(), Some(disc));
}
