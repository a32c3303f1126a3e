//! `BlockersAnswer`, what to move where there is no path.

use motion_lab_sim::plans::{Blocker, BlockerKind, NoRemoval, Removal};
use serde::Serialize;

/// What to move for a path to appear, or why that is not known.
#[derive(Clone, Debug, Serialize)]
pub struct BlockersAnswer {
    /// The things, doors first.
    #[serde(skip_serializing_if = "Option::is_none")]
    things: Option<Vec<BlockerEntry>>,
    /// Whether it is proven that no fewer things will do.
    #[serde(skip_serializing_if = "Option::is_none")]
    least: Option<bool>,
    /// The fewest doors alone, where they are not the things.
    #[serde(skip_serializing_if = "Option::is_none")]
    doors: Option<Vec<BlockerEntry>>,
    /// The number of sets that were planned without.
    #[serde(skip_serializing_if = "Option::is_none")]
    tried: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
    /// What to do with the things, and with the doors alone.
    #[serde(skip)]
    to_do: [String; 2],
}

#[derive(Clone, Debug, Serialize)]
struct BlockerEntry {
    kind: &'static str,
    name: String,
}

impl BlockersAnswer {
    pub fn of(found: Result<Removal, NoRemoval>) -> Self {
        let entries = |blockers: Vec<Blocker>| blockers.into_iter().map(BlockerEntry::of).collect();
        match found {
            Ok(Removal { blockers, doors, is_least, tried }) => BlockersAnswer {
                to_do: [&blockers[..], doors.as_deref().unwrap_or_default()].map(Removal::to_do),
                things: Some(entries(blockers)),
                least: Some(is_least),
                doors: doors.map(entries),
                tried: Some(tried),
                error: None,
            },
            Err(reason) => {
                let error = Some(reason.to_string());
                BlockersAnswer { things: None, least: None, doors: None, tried: None, error, to_do: Default::default() }
            }
        }
    }

    /// The answer in sentences.
    pub fn words(&self) -> String {
        let Some(things) = &self.things else {
            return format!("what blocks: {}", self.error.as_deref().unwrap_or("not known"));
        };
        let least = match (self.least, things.len()) {
            (Some(true), 1) => "",
            (Some(true), _) => "; no fewer will do",
            _ => "; none of them can stay, and whether another set has fewer is not known",
        };
        let [these, doors] = &self.to_do;
        let alone = self.doors.as_ref().map(|_| format!("\n             doors alone: {doors}"));
        format!("what blocks: there is a path if you {these}{least}{}", alone.unwrap_or_default())
    }
}

impl BlockerEntry {
    fn of(Blocker { kind, name }: Blocker) -> Self {
        let kind = match kind {
            BlockerKind::Door => "door",
            BlockerKind::Obstacle => "obstacle",
            BlockerKind::Wall => "wall",
        };
        BlockerEntry { kind, name }
    }
}
