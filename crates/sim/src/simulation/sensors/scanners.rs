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

impl ScanMemory {
    /// The scanner for the rays of pattern number `fan`, and the room for what it sees.
    pub(crate) fn at(&mut self, fan: usize, rays: FanSensor) -> (&mut Scanner, &mut NeighbourMemory) {
        if self.scanners.len() <= fan {
            self.scanners.resize(fan + 1, None);
        }
        let scanner = self.scanners[fan].get_or_insert_with(|| Box::new(Scanner::new(rays)));
        (scanner, &mut self.room)
    }
}
