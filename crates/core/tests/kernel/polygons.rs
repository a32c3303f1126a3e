//! Table N: the separating axis test against brute force.

use motion_lab_core::collision::Collision;
use motion_lab_core::random::{Seed, Stream};

use oracle::fixtures::{Kind, footprint_of, placed, random_body, scene_of};
use oracle::plain::{meet_by_brute_force, separated_by_an_axis};

#[test]
fn separating_axis_agrees_with_brute_force_on_400_random_convex_pairs() {
    let mut s = Stream::new(Seed(31), "tests/polygons");
    let mut meeting = 0;
    for _ in 0..400 {
        let (p, q) = (random_body(&mut s, Kind::Polygon, 1.5), random_body(&mut s, Kind::Polygon, 1.5));
        let (a, b) = (placed(&p), placed(&q));
        let separated = separated_by_an_axis(a.core(), b.core());
        assert_eq!(!separated, meet_by_brute_force(a.core(), b.core()), "{a:?} {b:?}");
        assert_eq!(!separated, scene_of(&[q]).intersects(&footprint_of(&[p])), "{a:?} {b:?}");
        meeting += usize::from(!separated);
    }
    assert!((100..300).contains(&meeting), "{meeting} of 400 meet: the sample says little");
}
