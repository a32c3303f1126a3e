use bevy_egui::egui::{Context, RawInput};

use super::*;
use motion_lab_core::picture::{Drawing, Fill};

/// The corners of the mesh that a picture is painted with, those in `rect`, to a hundredth of a point.
fn painted(ctx: &Context, picture: &Arc<Picture>, rect: Rect, fit: &Fit) -> Vec<[i32; 2]> {
    let mut output = ctx.run_ui(RawInput::default(), |ui| {
        // as the widgets do, by a painter that shows the paper alone
        paint_cached(&ui.painter_at(rect), picture, rect, fit, &FrameColours::from(Theme::Light));
    });
    output.textures_delta.clear();
    let meshes = output.shapes.iter().filter_map(|clipped| match &clipped.shape {
        Shape::Mesh(mesh) => Some(Arc::clone(mesh)),
        _ => None,
    });
    let corners = meshes.flat_map(|mesh| mesh.vertices.iter().map(|v| v.pos).collect::<Vec<_>>());
    let in_view = corners.filter(|p| rect.contains(*p));
    let mut found: Vec<[i32; 2]> = in_view.map(|p| [p.x, p.y].map(|v| (100.0 * v).round() as i32)).collect();
    found.sort_unstable();
    found
}

#[test]
fn a_kept_picture_is_where_a_new_one_would_be() {
    let p = Point2::new;
    let boxes = (0..40).map(|i| {
        let (x, y) = (f64::from(i % 8) * 10.0, f64::from(i / 8) * 10.0);
        let corners = vec![p(x, y), p(x + 4.0, y), p(x + 4.0, y + 3.0), p(x, y + 3.0)];
        Item::new(format!("{i}"), "a box", Role::Obstacle, Drawing::Polygon(corners)).filled(Fill::Tint(1.0))
    });
    let picture = Arc::new(Picture::new("Yard", Aabb::new(p(0.0, 0.0), p(80.0, 50.0))).with(boxes));
    let rect = Rect::from_min_size(pos2(10.0, 20.0), Vec2::new(200.0, 100.0));
    let whole = fit(&picture, rect);
    let kept = Context::default();
    let mut seen = 0;
    // a step within what is kept, one out of it, and back; then larger, and another picture
    let views = [(40.0, 25.0, 4.0), (53.0, 22.0, 4.0), (70.0, 40.0, 4.0), (40.0, 25.0, 4.0), (40.0, 25.0, 6.0)];
    for (x, y, zoom) in views {
        let fit = whole.magnified(p(x, y), zoom).on_pixels(1.0);
        let now = painted(&kept, &picture, rect, &fit);
        assert_eq!(now, painted(&Context::default(), &picture, rect, &fit), "{x} {y} {zoom}");
        seen += now.len();
    }
    assert!(seen > 50, "{seen}");
}

#[test]
fn a_paper_has_its_worlds_proportions() {
    let p = Point2::new;
    let picture = |w, h| Picture::new("a", Aabb::new(p(1.0, 2.0), p(1.0 + w, 2.0 + h)));
    let room = Rect::from_min_size(pos2(10.0, 20.0), Vec2::new(416.0, 216.0));
    // 400 by 200 points within the margin of 8: a square is as high as the room, a strip as wide
    assert_eq!(proportioned(&picture(5.0, 5.0), room).size(), Vec2::new(216.0, 216.0));
    assert_eq!(proportioned(&picture(8.0, 1.0), room).size(), Vec2::new(416.0, 66.0));
    assert_eq!(proportioned(&picture(8.0, 1.0), room).min, room.min);
    let tiny = proportioned(&picture(8.0, 1.0), Rect::from_min_size(pos2(0.0, 0.0), Vec2::splat(1.0)));
    assert!(tiny.width() > 0.0 && tiny.height() > 0.0, "{tiny:?}");
}

#[test]
fn a_level_rectangle_is_four_corners_and_a_slanted_one_keeps_its_fade() {
    let p = Point2::new;
    let picture = |corners: Vec<Point2>| {
        let item = Item::new("a", "a", Role::Obstacle, Drawing::Polygon(corners)).filled(Fill::Tint(0.6));
        Arc::new(Picture::new("A", Aabb::new(p(0.0, 0.0), p(10.0, 10.0))).with([item]))
    };
    let rect = Rect::from_min_size(pos2(0.0, 0.0), Vec2::splat(116.0));
    let corners = |picture: &Arc<Picture>| {
        let mut all = painted(&Context::default(), picture, rect, &fit(picture, rect));
        all.dedup();
        all
    };
    // 10 m are 100 points within the margin of 8; upward on paper is downward on the screen
    let level = [p(1.0, 2.0), p(4.0, 2.0), p(4.0, 7.0), p(1.0, 7.0)];
    let found = [[1800, 3800], [1800, 8800], [4800, 3800], [4800, 8800]];
    for turned in 0..4 {
        let mut corners_of = level.to_vec();
        corners_of.rotate_left(turned);
        assert_eq!(corners(&picture(corners_of.clone())), found);
        corners_of.reverse();
        assert_eq!(corners(&picture(corners_of)), found);
    }
    let slanted = vec![p(1.0, 2.0), p(4.0, 2.5), p(4.0, 7.0), p(1.0, 7.0)];
    assert_eq!(corners(&picture(slanted)).len(), 8);
}

#[test]
fn a_line_that_turns_back_has_no_spike() {
    let ctx = Context::default();
    for off in [0.0, 0.01, 0.1, 1.0, 3.0, 10.0] {
        let line = [[10.0, 50.0], [60.0, 50.0], [10.0, 50.0 + off]];
        let stroke = Stroke::new(2.0, FrameColours::from(Theme::Light).colour(Role::Text));
        let mut output = ctx.run_ui(RawInput::default(), |ui| paint_line(ui.painter(), &line, stroke, Dash::Solid));
        output.textures_delta.clear();
        let drawn = ctx.tessellate(output.shapes, 1.0).into_iter().flat_map(|clipped| match clipped.primitive {
            bevy_egui::egui::epaint::Primitive::Mesh(mesh) => mesh.vertices,
            bevy_egui::egui::epaint::Primitive::Callback(_) => Vec::new(),
        });
        let farthest = drawn.map(|v| v.pos.x).fold(0.0, f32::max);
        // half the width and the feathering are 1.5 points, and a mitre may be some times as long
        assert!((60.0..75.0).contains(&farthest), "{off}: {farthest}");
    }
}

#[test]
fn level_and_upright_edges_go_to_the_pixels_and_slanted_ones_stay() {
    let mut square = [[0.3, 0.4], [10.3, 0.4], [10.3, 10.4], [0.3, 10.4], [0.3, 0.4]];
    snap(&mut square, 1.0, 0.0);
    assert_eq!(square, [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0], [0.0, 0.0]]);
    let mut upright = [[7.9, 0.4], [7.9, 5.2]];
    snap(&mut upright, 1.0, 0.5);
    assert_eq!(upright, [[7.5, 0.4], [7.5, 5.2]], "its ends stay");
    let slanted = [[0.3, 0.4], [5.2, 3.3], [9.1, 0.2]];
    let mut same = slanted;
    snap(&mut same, 2.0, 0.5);
    assert_eq!(same, slanted);
}
