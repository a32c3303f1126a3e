//! Tests of the simulation as a whole.

use crate::random::Seed;
use crate::recording::Recorder;
use crate::tour::TourConfig;

#[test]
fn explore() {
    let n: u64 = std::env::var("N").map_or(1, |v| v.parse().unwrap());
    for seed in (0..n).chain([2005]) {
        let t = std::time::Instant::now();
        let mut r = Recorder::new(TourConfig::default(), Seed(seed)).unwrap();
        let (mut laps, mut last) = (0, 0.0);
        for _ in 0..1200 {
            let f = r.step();
            let next = f.robots[0].extra[2];
            if next < last {
                laps += 1;
            }
            last = next;
        }
        println!("{seed} laps {laps} {:?}", t.elapsed());
        for v in r.view() {
            println!("   {} {} contacts {} {:?}", v.name, v.configuration, v.contacts, v.encoders);
        }
    }
}
