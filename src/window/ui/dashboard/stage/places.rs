//! Where the cockpit in front, its configuration and its words are.

use bevy_egui::egui::{Rect, pos2};

use crate::window::ui::Cockpit;
use crate::window::ui::paint::canvas;

/// Gap between panes, and between the panes and the window's border, points.
pub const GAP: f32 = 20.0;

/// Share of the stage's width for what stands beside the cockpit in front, and its bounds, points.
const BESIDE: f32 = 0.34;
const MIN_BESIDE: f32 = 280.0;
const MAX_BESIDE: f32 = 420.0;

/// Share of a tall room's height for the cockpit in front, at most.
const ABOVE: f32 = 0.62;

/// The height from which on the column beside the cockpit in front has room for all words.
const HIGH: f32 = 680.0;

/// Width from which words and configuration stand side by side, points.
pub const WIDE: f32 = 560.0;

/// Height that words take in a wide room, points.
const WORDS: f32 = 260.0;

/// Least height of the configuration beside the cockpit in front, with its line of words, points.
const MIN_SPACE: f32 = 96.0;

/// Where the cockpit in front is, and what there is to say of it.
pub struct StagePlaces {
    /// Its world.
    pub sheet: Rect,
    /// The room under its world for a part of the words, if the room beside it is too low for all.
    pub foot: Option<Rect>,
    /// The room for the other cockpits, the words and the configuration.
    pub beside: Rect,
}

/// The places in a room, whose foot is `foot` high where there is one.
pub fn places(cockpit: &Cockpit, room: Rect, foot: f32) -> StagePlaces {
    let world = &cockpit.world;
    if room.height() > room.width() {
        let sheet = canvas::proportioned(world, room.with_max_y(room.top() + ABOVE * room.height()));
        return StagePlaces { sheet, foot: None, beside: room.with_min_y(sheet.bottom() + 12.0) };
    }
    let width = (BESIDE * room.width()).clamp(MIN_BESIDE, MAX_BESIDE).min(0.6 * room.width());
    let left = room.with_max_x(room.right() - width - GAP);
    let whole = canvas::proportioned(world, left);
    let is_free = room.bottom() - whole.bottom() >= foot;
    let is_high = room.height() >= HIGH || room.right() - whole.right() - GAP >= WIDE;
    // where robots share the room, what can be done with each stays with its words; a small world has no foot to give
    if cockpit.robots.len() != 1 || (is_high || left.width() < WIDE) && !is_free {
        return StagePlaces { sheet: whole, foot: None, beside: room.with_min_x(whole.right() + GAP) };
    }
    let sheet = canvas::proportioned(world, left.with_max_y((room.bottom() - foot).max(room.top())));
    let under = Rect::from_min_max(pos2(sheet.left(), sheet.bottom() + 6.0), pos2(sheet.right(), room.bottom()));
    StagePlaces { sheet, foot: Some(under), beside: room.with_min_x(sheet.right() + GAP) }
}

/// Shares a room between the words, which need a height, and the configuration: side by side where it is wide and not
/// high, else one below the other. Without room for both, the words have it all.
pub fn share(room: Rect, words: f32) -> (Rect, Option<Rect>) {
    // not by what the words need now, so that the two do not change places as words come and go
    let is_high = room.height() - WORDS >= 0.5 * room.width();
    if room.width() >= WIDE && room.height() >= MIN_SPACE && !is_high {
        let (words, space) = room.split_left_right_at_fraction(0.5);
        return (words.with_max_x(words.right() - GAP), Some(space));
    }
    let side = (room.height() - words - 6.0).min(room.width()).min(0.66 * room.height());
    if side < MIN_SPACE {
        return (room, None);
    }
    let (words, space) = room.split_top_bottom_at_y(room.bottom() - side);
    (words, Some(space.with_min_y(space.top() + 6.0)))
}

/// Shares the room under the paper of a narrow screen between the configuration and the words under it. The words
/// have at least `words` points; without room for both, all of it.
pub fn below_paper(room: Rect, words: f32) -> (Option<Rect>, Rect) {
    let height = (room.height() - words).min(0.8 * room.width());
    if height < MIN_SPACE {
        return (None, room);
    }
    let (space, words) = room.split_top_bottom_at_y(room.top() + height);
    (Some(space), words.with_min_y(words.top() + 6.0))
}

#[cfg(test)]
mod tests {
    use bevy_egui::egui::vec2;

    use super::*;

    #[test]
    fn words_and_configuration_share_what_room_there_is() {
        let room = |w: f32, h: f32| Rect::from_min_size(pos2(100.0, 50.0), vec2(w, h));
        for (w, h) in [(600.0, 300.0), (400.0, 500.0), (300.0, 900.0)] {
            let room = room(w, h);
            let (words, space) = share(room, 150.0);
            let space = space.unwrap_or_else(|| panic!("{w} by {h} has room for both"));
            assert!(room.contains_rect(words) && room.contains_rect(space) && !words.shrink(0.1).intersects(space));
            assert!(space.width().min(space.height()) >= 120.0 && words.height() >= 150.0, "{w} by {h}");
        }
        // what the words need is theirs
        let high = room(400.0, 330.0);
        assert_eq!(share(high, 200.0).0.height(), 206.0);
        assert_eq!(share(high, 240.0), (high, None));
    }
}
