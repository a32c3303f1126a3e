//! What is known of a contact, as JSON.

use motion_lab_sim::avoid::{Evasion, EvasionMeans, Explanation, LastChance, NoEvasion, SearchExtent};
use motion_lab_sim::export::JsonNumber;
use serde::Serialize;

/// A contact.
#[derive(Serialize)]
pub struct ContactReport<'a> {
    robot: &'a str,
    world: &'a str,
    /// Its number among those of the robot, from 1.
    contact: u32,
    /// The first tick in contact.
    tick: u64,
    /// The first tick after it; null where the run ends in contact.
    ended: Option<u64>,
    /// What the robot meets.
    meets: String,
    stopping: ChanceReport<'a>,
    going_on: ChanceReport<'a>,
}

/// The last chance to avoid it.
#[derive(Default, Serialize)]
struct ChanceReport<'a> {
    /// Null where there is none.
    last_chance: Option<u64>,
    free_until: Option<u64>,
    /// Whether the robot that it would meet is in contact up to there all the same; left out where it is not.
    #[serde(skip_serializing_if = "Option::is_none")]
    still_met: Option<bool>,
    /// Whether a change of the world is refused because it stands in the way; left out where none is.
    #[serde(skip_serializing_if = "Option::is_none")]
    in_the_way: Option<bool>,
    /// Channels, each from its tick on; null for an arm.
    #[serde(skip_serializing_if = "Option::is_none")]
    channels: Option<&'a [(u64, [i16; 2])]>,
    /// An arm's path, by its joints.
    #[serde(skip_serializing_if = "Option::is_none")]
    path_rad: Option<JsonNumber>,
    #[serde(skip_serializing_if = "Option::is_none")]
    arrives: Option<u64>,
    /// The earliest tick that was searched, and the number of branches; null where nothing was searched.
    earliest: Option<u64>,
    branches: Option<u64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    none: Option<String>,
}

impl<'a> ContactReport<'a> {
    /// The report of a contact.
    pub fn of(why: &'a Explanation) -> Self {
        let episode = &why.episode;
        ContactReport {
            robot: &episode.robot,
            world: &episode.world,
            contact: episode.number,
            tick: episode.first,
            ended: episode.ended,
            meets: episode.with.to_string(),
            stopping: ChanceReport::of(&why.stopping),
            going_on: ChanceReport::of(&why.going_on),
        }
    }
}

impl<'a> ChanceReport<'a> {
    fn of(chance: &'a LastChance) -> Self {
        let searched = |SearchExtent { earliest, branches, .. }: SearchExtent| ChanceReport {
            earliest: Some(earliest),
            branches: Some(branches),
            ..ChanceReport::default()
        };
        match chance {
            LastChance::At(evasion) => {
                let Evasion { tick, free_until, means, extent, is_still_met, is_in_the_way, .. } = evasion;
                let (mut channels, mut path_rad, mut arrives) = (None, None, None);
                match means {
                    EvasionMeans::Channels(driven) => channels = Some(&driven[..]),
                    EvasionMeans::Path { length, arrives: at } => {
                        (path_rad, arrives) = (Some(JsonNumber(*length)), Some(*at));
                    }
                    EvasionMeans::Standing => {}
                }
                let (last_chance, free_until) = (Some(*tick), Some(*free_until));
                let (still_met, in_the_way) = (is_still_met.then_some(true), is_in_the_way.then_some(true));
                ChanceReport {
                    last_chance,
                    free_until,
                    still_met,
                    in_the_way,
                    channels,
                    path_rad,
                    arrives,
                    ..searched(*extent)
                }
            }
            LastChance::None(none) => {
                let extent = if let NoEvasion::TooLate(extent) = none { Some(*extent) } else { None };
                let report = extent.map_or_else(ChanceReport::default, searched);
                ChanceReport { none: Some(none.to_string()), ..report }
            }
        }
    }
}
