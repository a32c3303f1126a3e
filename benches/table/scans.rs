//! Scans: 360 rays in small and large worlds.

use motion_lab::sensors::Instructions;

use crate::Table;
use crate::contest::{Ours, WORLDS, agree, task};
use crate::measure::Entrant;
use crate::row::Mark;
use crate::worlds::CASES;

pub fn rows(table: &mut Table) {
    let best = Instructions::best();
    let mut sets = vec![best];
    sets.extend(Instructions::available().into_iter().filter(|set| *set != best));
    for case in WORLDS {
        let mark = |set| match case.must {
            Some([must, _]) if set == best => Mark::faster_by(must),
            Some([_, must]) => Mark::faster_by(must),
            None => Mark::FASTER,
        };
        let works: Vec<_> = sets.iter().map(|set| (format!("{} ({set:?})", case.work()), mark(*set))).collect();
        table.race(&works, |peers| {
            let ours = sets.iter().map(|set| Ours::new(&case, *set)).collect::<Vec<_>>();
            let peers = peers.entrants(&task(&case), |name, answers| agree(&mut Ours::new(&case, best), name, answers));
            let ours = ours.into_iter().map(|mut ours| Entrant::new("", CASES, move |i| ours.scan(i)[0]));
            ours.chain(peers).collect()
        });
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
