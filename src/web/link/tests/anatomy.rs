//! What Query shows, in an address.

use super::super::*;
use motion_lab_core::collision::EdgeVerdict;
use motion_lab_core::configuration::Configuration;
use motion_lab_sim::anatomy::{Anatomy, Tab};

#[test]
fn a_motion_past_the_post_is_in_an_address_with_its_links() {
    let link = Link::parse("widget=anatomy&tab=swept&q=2,0&step=1.1,0&thick=yes").unwrap();
    let mut scene = Anatomy::default();
    assert_eq!(link.anatomy.show_in(&mut scene), Ok(()));
    assert_eq!((scene.tab, scene.step(), scene.thick_links()), (Tab::Swept, &[1.1, 0.0][..], Some(true)));
    // README's motion: links with a radius of 3 cm meet the post in less than a third of the way
    let verdict = scene.sweep().unwrap().verdict;
    assert!(
        matches!(verdict, EdgeVerdict::Hit { contact_at, .. } if (0.28..0.29).contains(&contact_at)),
        "{verdict:?}"
    );
    // and back: the same scene, which another reader sees
    let written = Link { widget: Some(Widget::Anatomy), anatomy: LinkedAnatomy::of(&scene), ..Link::default() };
    assert!(written.query().unwrap().ends_with("&widget=anatomy&tab=swept&q=2,0&step=1.1,0&thick=yes"));
    // bare links where none are named; nothing said changes nothing
    assert_eq!(LinkedAnatomy::default().show_in(&mut scene), Ok(()));
    assert_eq!((scene.thick_links(), scene.step()), (Some(true), &[1.1, 0.0][..]));
    assert_eq!(Link::parse("tab=distance").unwrap().anatomy.show_in(&mut scene), Ok(()));
    assert_eq!((scene.tab, scene.thick_links()), (Tab::Distance, Some(false)));
    // only a motion has a step
    assert_eq!(LinkedAnatomy::of(&scene).step, [0.0; 0]);
}

#[test]
fn what_the_robot_of_query_does_not_take_is_named_and_costs_nothing_else() {
    let shown = |query: &str| {
        let mut scene = Anatomy::default();
        let refused = Link::parse(query).unwrap().anatomy.show_in(&mut scene);
        (refused.err(), scene)
    };
    let (refused, scene) = shown("tab=swept&q=1,2,3&step=0.5,0&thick=yes");
    assert_eq!(refused.as_deref(), Some("q: the robot has 2 coordinates"));
    assert_eq!((scene.step(), scene.thick_links()), (&[0.5, 0.0][..], Some(true)));
    let (refused, scene) = shown("tab=swept&q=1,2&step=0.5");
    assert_eq!(refused.as_deref(), Some("step: the robot has 2 coordinates"));
    assert_eq!(scene.q().coordinates()[..], [1.0, 2.0]);
    assert_eq!(scene.step(), Anatomy::default().step());
    // half a turn is the longest motion of a joint
    assert_eq!(shown("step=9,0").1.step(), [std::f64::consts::PI, 0.0]);
    let refused = Link::parse("step=1;2").unwrap_err().to_string();
    assert!(refused.starts_with("step: it must be up to 16 numbers"), "{refused}");
    assert_eq!(Link::parse("thick=no").unwrap_err().to_string(), "thick: it must be one of yes, not \"no\"");
}
