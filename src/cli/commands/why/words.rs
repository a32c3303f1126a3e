//! What is known of a contact, in words.

use motion_lab_sim::avoid::{ContactPartner, Evasion, EvasionMeans, EvasionSet, Explanation, LastChance, NoEvasion};
use motion_lab_sim::run::seconds;

/// The lines of a contact that was explained by this set.
pub fn lines(why: &Explanation, set: &EvasionSet) -> Vec<String> {
    let episode = &why.episode;
    let (first, time) = (episode.first, seconds(episode.first));
    let head = format!(
        "{}, contact {}: meets {} at tick {first} ({time:.2} s) in {}",
        episode.robot, episode.number, episode.with, episode.world
    );
    vec![head, format!("  by stopping: {}", stopping(why, set)), format!("  by going on: {}", going_on(why, set))]
}

fn stopping(why: &Explanation, set: &EvasionSet) -> String {
    match &why.stopping {
        LastChance::At(evasion) if evasion.tick == why.episode.first => {
            let how = if evasion.means == EvasionMeans::Standing { "stays where it is" } else { "stops within a tick" };
            format!("in tick {} itself; it {how}{}", evasion.tick, other(why, evasion))
        }
        LastChance::At(evasion) => format!("{}{}", at(why, evasion), other(why, evasion)),
        LastChance::None(none) => no_way(why, none, set),
    }
}

fn going_on(why: &Explanation, set: &EvasionSet) -> String {
    match &why.going_on {
        LastChance::At(evasion) => {
            let tried = match evasion.means {
                EvasionMeans::Channels(_) if evasion.tick < why.episode.first => {
                    format!("; later none, of {} tried", branches(evasion.extent.branches))
                }
                _ => String::new(),
            };
            format!("{}, {}{tried}{}", at(why, evasion), means(evasion), other(why, evasion))
        }
        LastChance::None(none) => no_way(why, none, set),
    }
}

/// That the robot it would meet touches something all the same, and that a change of the world does not come about.
fn other(why: &Explanation, evasion: &Evasion) -> String {
    let met = match &why.episode.with {
        ContactPartner::Robot(name) if evasion.is_still_met => format!("; {name} is in contact all the same"),
        _ => String::new(),
    };
    let in_the_way =
        if evasion.is_in_the_way { "; a change of the world is refused, it stands in the way" } else { "" };
    format!("{met}{in_the_way}")
}

/// The last chance, and how long before the contact it is.
fn at(why: &Explanation, evasion: &Evasion) -> String {
    let (tick, before) = (evasion.tick, why.episode.first - evasion.tick);
    if before == 0 {
        return format!("in tick {tick} itself");
    }
    format!("until tick {tick} ({:.2} s before)", seconds(before))
}

/// By what the robot avoids the contact.
fn means(evasion: &Evasion) -> String {
    match &evasion.means {
        EvasionMeans::Channels(channels) => {
            let each = |(tick, [a, b]): &(u64, [i16; 2])| format!("Drive({a}, {b}) from tick {tick}");
            format!("by {}", channels.iter().map(each).collect::<Vec<_>>().join(", "))
        }
        EvasionMeans::Standing => "where it is".into(),
        EvasionMeans::Path { length, arrives } => format!("by a path of {length:.3} rad that ends at tick {arrives}"),
    }
}

fn branches(count: u64) -> String {
    if count == 1 { "1 branch".into() } else { format!("{count} branches") }
}

fn no_way(why: &Explanation, none: &NoEvasion, set: &EvasionSet) -> String {
    let NoEvasion::TooLate(extent) = none else { return none.to_string() };
    let further = match extent.earliest {
        tick if why.episode.first - tick == set.back => "--back looks farther back",
        1 => "the run begins there",
        _ => "the contact before ends there",
    };
    format!("too late from tick {} on, of {} tried; {further}", extent.earliest, branches(extent.branches))
}
