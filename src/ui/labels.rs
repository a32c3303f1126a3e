//! Names of things on a paper: moved aside where they would cover one another, with a line to what they name.

use bevy_egui::egui::{FontId, Painter, Rect, Stroke, TextStyle, Ui, Vec2, pos2, vec2};

use super::{Look, Name};
use crate::picture::{Fit, Role};

/// Where a name may stand beside what it names, as steps across and down: below, above, right, left, at the corners, then farther
/// off.
const PLACES: [(f32, f32); 12] = [
    (0.0, 1.0),
    (0.0, -1.0),
    (1.0, 0.0),
    (-1.0, 0.0),
    (1.0, 1.0),
    (-1.0, 1.0),
    (1.0, -1.0),
    (-1.0, -1.0),
    (0.0, 2.0),
    (0.0, -2.0),
    (0.0, 3.0),
    (0.0, -3.0),
];

/// The place for a rectangle of `size` that names the `thing`: in its middle where it fits there, else beside it, the first place that
/// lies in `room` and off all `taken`; `None` when there is none.
pub fn place(thing: Rect, size: Vec2, room: Rect, taken: &[Rect]) -> Option<Rect> {
    let inside = thing.width() >= size.x && thing.height() >= size.y;
    let beside = PLACES.into_iter().map(|(across, down)| {
        let step = vec2(0.5 * (thing.width() + size.x) + 3.0, 0.5 * (thing.height() + size.y) + 3.0);
        let farther = vec2(0.0, f32::abs(down) - 1.0).max(Vec2::ZERO) * f32::signum(down) * (size.y + 2.0);
        vec2(across * step.x, f32::signum(down) * f32::abs(down).clamp(0.0, 1.0) * step.y) + farther
    });
    let offsets = inside.then_some(Vec2::ZERO).into_iter().chain(beside);
    let mut rects = offsets.map(|off| Rect::from_center_size(thing.center() + off, size));
    rects.find(|rect| room.contains_rect(*rect) && taken.iter().all(|t| !t.intersects(*rect)))
}

/// Paints the names on the paper, each on a small plate. One that finds no place is left out.
pub fn labels(ui: &Ui, painter: &Painter, names: &[Name], (paper, fit): (Rect, &Fit), look: &Look) {
    let font: FontId = TextStyle::Small.resolve(ui.style());
    let things: Vec<Rect> = names.iter().map(|name| thing(name, fit)).collect();
    let mut taken: Vec<Rect> = Vec::new();
    for (name, thing) in names.iter().zip(&things) {
        let galley = painter.layout_no_wrap(name.text.clone(), font.clone(), look.colour(Role::Text));
        let size = galley.size() + vec2(4.0, 0.0);
        let Some(rect) = place(*thing, size, paper.shrink(2.0), &taken) else { continue };
        if rect.distance_to_pos(thing.center()) > 0.5 * thing.size().max_elem() + 8.0 {
            let (from, to) = (thing.clamp(rect.center()), rect.clamp(thing.center()));
            painter.line_segment([from, to], Stroke::new(1.0, look.colour(Role::Muted)));
        }
        painter.rect_filled(rect, 2.0, look.tint(Role::Paper, 0.85));
        painter.galley(rect.min + vec2(2.0, 0.0), galley, look.colour(Role::Text));
        taken.push(rect);
    }
}

/// What a name names, on the screen: at least as large as the dot of a place.
fn thing(name: &Name, fit: &Fit) -> Rect {
    let [x, y] = fit.screen_from_world(name.at);
    let half = name.half.map(|h| (h * fit.px_per_metre()) as f32);
    Rect::from_center_size(pos2(x as f32, y as f32), (2.0 * vec2(half[0], half[1])).max(Vec2::splat(6.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_move_aside_and_stay_on_the_paper() {
        let room = Rect::from_min_size(pos2(0.0, 0.0), vec2(200.0, 200.0));
        let (size, dot) = (vec2(40.0, 14.0), Vec2::splat(6.0));
        let thing = Rect::from_center_size(pos2(100.0, 100.0), dot);
        let mut taken = Vec::new();
        for _ in 0..6 {
            let rect = place(thing, size, room, &taken).expect("there is room");
            assert!(!rect.intersects(thing), "it does not cover what it names");
            assert!(taken.iter().all(|t: &Rect| !t.intersects(rect)) && room.contains_rect(rect));
            taken.push(rect);
        }
        let corner = place(Rect::from_center_size(pos2(0.0, 0.0), dot), size, room, &[]).expect("moved in");
        assert!(room.contains_rect(corner));
        assert_eq!(place(thing, size, room, &[room]), None);
        let large = Rect::from_center_size(pos2(100.0, 100.0), vec2(60.0, 20.0));
        assert_eq!(place(large, size, room, &[]).map(|r| r.center()), Some(large.center()), "it fits inside");
    }
}
