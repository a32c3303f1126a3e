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
                things: Some(entries(blockers)),
                least: Some(is_least),
                doors: doors.map(entries),
                tried: Some(tried),
                error: None,
            },
            Err(reason) => {
                BlockersAnswer { things: None, least: None, doors: None, tried: None, error: Some(reason.to_string()) }
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
        let alone = self.doors.as_ref().map(|doors| format!("\n             doors alone: {}", to_do(doors)));
        format!("what blocks: there is a path if you {}{least}{}", to_do(things), alone.unwrap_or_default())
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

/// What to do with things: `open "A's door" and take away "the post"`.
fn to_do(things: &[BlockerEntry]) -> String {
    let [doors, others]: [Vec<&BlockerEntry>; 2] =
        [true, false].map(|is_door| things.iter().filter(|thing| (thing.kind == "door") == is_door).collect());
    let list = |verb: &str, things: &[&BlockerEntry]| {
        let names: Vec<_> = things.iter().map(|thing| format!("{:?}", thing.name)).collect();
        (!names.is_empty()).then(|| format!("{verb} {}", names.join(", ")))
    };
    [list("open", &doors), list("take away", &others)].into_iter().flatten().collect::<Vec<_>>().join(" and ")
}
