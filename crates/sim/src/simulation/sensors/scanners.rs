//! `Scanners`, working memory for scans: as much as there are threads and patterns of rays, not sensors.

use std::sync::{Mutex, PoisonError};

use crate::simulation::tick::crowd::NeighbourMemory;
use motion_lab_core::sensors::{FanSensor, Scanner};

/// Desks, each of which one thread works at. They are kept from tick to tick.
#[derive(Debug, Default)]
pub(crate) struct Scanners(Mutex<Vec<ScanMemory>>);

/// What a thread needs to scan.
#[derive(Debug, Default)]
pub(crate) struct ScanMemory {
    /// A scanner for each pattern of rays, made when it is first needed.
    scanners: Vec<Option<Box<Scanner>>>,
    /// The rays of these scanners.
    rays: u64,
    /// The robots that a sensor sees.
    pub(crate) room: NeighbourMemory,
}

/// A desk that goes back when its thread is done.
pub(crate) struct Borrowed<'a> {
    scanners: &'a Scanners,
    pub(crate) desk: ScanMemory,
}

impl Scanners {
    /// A desk that nobody else works at.
    pub(crate) fn desk(&self) -> Borrowed<'_> {
        let desk = self.0.lock().unwrap_or_else(PoisonError::into_inner).pop();
        Borrowed { scanners: self, desk: desk.unwrap_or_default() }
    }
}

impl Drop for Borrowed<'_> {
    fn drop(&mut self) {
        let desk = std::mem::take(&mut self.desk);
        self.scanners.0.lock().unwrap_or_else(PoisonError::into_inner).push(desk);
    }
}

/// Largest number of rays of the scanners that one thread keeps, but for those of a single one.
const MAX_SCANNER_RAYS: u64 = 2_000_000;

impl ScanMemory {
    /// The scanner for the rays of pattern number `fan`, and the room for what it sees. Where there are too many
    /// patterns to keep, they are made anew.
    pub(crate) fn at(&mut self, fan: usize, rays: FanSensor) -> (&mut Scanner, &mut NeighbourMemory) {
        if self.scanners.len() <= fan {
            self.scanners.resize(fan + 1, None);
        }
        if self.scanners[fan].is_none() {
            self.make_room(u64::from(rays.sensor.n_rays));
        }
        let scanner = self.scanners[fan].get_or_insert_with(|| Box::new(Scanner::new(rays)));
        (scanner, &mut self.room)
    }

    /// Drops the scanners there are if these rays would be too many with theirs.
    fn make_room(&mut self, rays: u64) {
        if self.rays + rays > MAX_SCANNER_RAYS {
            self.scanners.fill_with(|| None);
            self.rays = 0;
        }
        self.rays += rays;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::sensors::RangeSensor;

    #[test]
    fn a_thread_keeps_the_scanners_of_two_million_rays_and_no_more() {
        let fan = |k: u32| FanSensor::from(RangeSensor { n_rays: 400_000, max_range: f64::from(k + 1) });
        let mut memory = ScanMemory::default();
        let kept = |memory: &ScanMemory| memory.scanners.iter().flatten().count();
        let mut counts = Vec::new();
        for k in [0, 1, 0, 2, 3, 4, 1, 5, 5, 0] {
            memory.at(k as usize, fan(k));
            counts.push(kept(&memory));
        }
        // five of them have two million rays; the sixth comes alone
        assert_eq!(counts, [1, 2, 2, 3, 4, 5, 5, 1, 1, 2]);
    }
}
