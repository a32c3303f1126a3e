//! The figures of `docs/black-box.md`, drawn by the tests of what they show.

use std::path::PathBuf;

use motion_lab_core::collision::Scene;
use motion_lab_core::geometry::Aabb;
use motion_lab_core::picture::{Drawing, Figure, Item, Line, Role, Theme};
use motion_lab_core::prelude::Point2;

/// A part of the plane.
pub fn frame(min: [f64; 2], max: [f64; 2]) -> Aabb {
    Aabb::new(Point2::new(min[0], min[1]), Point2::new(max[0], max[1]))
}

/// The walls of a scene.
pub fn walls(scene: &Scene) -> Vec<Item> {
    let wall = |(i, core): (usize, Vec<Point2>)| {
        Item::new(format!("obstacle/{i}"), format!("wall {i}"), Role::Obstacle, Drawing::Polyline(core))
            .stroked(Line::solid(4.0))
    };
    scene.pieces().map(|(_, piece)| piece.core().to_vec()).enumerate().map(wall).collect()
}

/// Checks that a figure of the page is what the test draws. `MOTION_LAB_WRITE_FIGURES=1` writes it anew.
#[track_caller]
pub fn check_figure(name: &str, figure: &Figure) {
    let path =
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets/figures").join(format!("black-box-{name}.svg"));
    let drawn = figure.svg(Theme::Light.palette());
    assert!(drawn.len() < 32_000, "{name}: {} bytes", drawn.len());
    if std::env::var_os("MOTION_LAB_WRITE_FIGURES").is_some() {
        std::fs::write(&path, &drawn).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(kept == drawn, "{}: MOTION_LAB_WRITE_FIGURES=1 draws it anew", path.display());
}
