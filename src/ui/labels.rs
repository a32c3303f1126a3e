//! Names of things on a paper: moved aside where they would cover one another, with a line to what they name.

use bevy_egui::egui::{FontId, Painter, Pos2, Rect, Stroke, TextStyle, Ui, Vec2, pos2, vec2};

use super::Look;
use crate::picture::{Drawing, Fit, Item, Role};

/// Where a name may stand, as steps of its own size from what it names: on it, below, above, right, left, then farther off.
const PLACES: [(f32, f32); 13] = [
    (0.0, 0.0),
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

/// The place for a rectangle of `size` that names the point `at`: the first that lies in `room` and off all `taken`; `None` when
/// there is none.
pub fn place(at: Pos2, size: Vec2, room: Rect, taken: &[Rect]) -> Option<Rect> {
    PLACES.into_iter().find_map(|(across, down)| {
        let off = vec2(across * (size.x + 8.0), down * (size.y + 4.0));
        let rect = Rect::from_center_size(at + off, size);
        let free = room.contains_rect(rect) && taken.iter().all(|t| !t.intersects(rect));
        free.then_some(rect)
    })
}

/// Paints the labels among `items` on the paper, each on a small plate. One that finds no place is left out.
pub fn labels(ui: &Ui, painter: &Painter, items: &[Item], (paper, fit): (Rect, &Fit), look: &Look) {
    let font: FontId = TextStyle::Small.resolve(ui.style());
    let mut taken: Vec<Rect> = Vec::new();
    for item in items {
        let Drawing::Label { at, text, .. } = &item.drawing else { continue };
        let [x, y] = fit.screen_from_world(*at);
        let at = pos2(x as f32, y as f32);
        let galley = painter.layout_no_wrap(text.clone(), font.clone(), look.colour(Role::Text));
        let size = galley.size() + vec2(6.0, 2.0);
        let Some(rect) = place(at, size, paper.shrink(2.0), &taken) else { continue };
        if rect.distance_to_pos(at) > 3.0 {
            let edge = rect.clamp(at);
            painter.line_segment([at, edge], Stroke::new(1.0, look.colour(Role::Muted)));
        }
        painter.rect_filled(rect, 2.0, look.tint(Role::Paper, 0.85));
        painter.galley(rect.min + vec2(3.0, 1.0), galley, look.colour(Role::Text));
        taken.push(rect);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_move_aside_and_stay_on_the_paper() {
        let room = Rect::from_min_size(pos2(0.0, 0.0), vec2(200.0, 200.0));
        let size = vec2(40.0, 14.0);
        let mut taken = Vec::new();
        for _ in 0..9 {
            let rect = place(pos2(100.0, 100.0), size, room, &taken).expect("there is room");
            assert!(taken.iter().all(|t: &Rect| !t.intersects(rect)) && room.contains_rect(rect));
            taken.push(rect);
        }
        let corner = place(pos2(0.0, 0.0), size, room, &[]).expect("moved in");
        assert!(room.contains_rect(corner));
        assert_eq!(place(pos2(100.0, 100.0), size, room, &[room]), None);
    }
}
