//! Scans: 360 rays in small and large worlds.

use motion_lab::sensors::Instructions;

use crate::Table;
use crate::contest::{Case, Ours, Parry, WORLDS, agree};
use crate::measure::{Contender, Timing, race};

fn against(case: &Case, set: Instructions) -> Vec<Timing> {
    let (mut ours, mut parry) = (Ours::new(case, set), Parry::new(case));
    agree(&mut ours, &mut parry);
    race(vec![Contender::new("", move |i| ours.scan(i)[0]), Contender::new("parry", move |i| parry.scan(i)[0])])
}

pub fn rows(table: &mut Table) {
    let best = Instructions::best();
    for case in WORLDS {
        let work = case.work();
        table.row(&format!("{work} ({best:?})"), case.must, || against(&case, best));
        for set in Instructions::available() {
            if set != best {
                let must = if case.must.is_empty() { "" } else { ">= 15x" };
                table.row(&format!("{work} ({set:?})"), must, || against(&case, set));
            }
        }
    }
}

/// Prints for each world the digest of its scans, which is the same for all instructions.
pub fn print_digests() {
    for case in WORLDS {
        for set in Instructions::available() {
            println!("{:016x} {}", Ours::new(&case, set).digest(), case.work());
        }
    }
}
