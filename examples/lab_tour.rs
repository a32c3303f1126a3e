//! The chapter's worked example as a program: the numbers of the worked example, then the 60 s tour at the book's seed,
//! whose figure it writes to `figures/ch02_tour.svg`.
//!
//! `cargo run --example lab_tour`
#![allow(clippy::print_stdout, dead_code)]

use std::error::Error;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::fmt::Write;
use std::fs;
use std::path::Path;

use motion_lab::capture::run_svg;
use motion_lab::collision::{Collision, Scene};
use motion_lab::picture::Theme;
use motion_lab::prelude::*;
use motion_lab::recording::Run;
use motion_lab::tour::{BOOK_SEED, TourConfig};
use motion_lab::worlds::World;

/// The program's output. The figure of its run is written to `figure`, in a folder that is made if there is none.
pub fn report(figure: &Path) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    // Choset's arm at his configuration
    let arm = Reach::<2>::choset();
    let q = T2::new(FRAC_PI_4, FRAC_PI_2);
    let points = arm.fk(&q);
    let (elbow, tip) = (points[1], points[2]);
    writeln!(text, "elbow ({:.4}, {:.4})  tip ({:.4}, {:.4})", elbow.x, elbow.y, tip.x, tip.y)?;

    // a scratch scene with the worked example's square, which is also the Workbench's block
    let block = Shape::try_rectangle(Point2::new(0.5, 1.0), Point2::new(1.0, 1.5))?;
    let scene = Scene::empty(World::workbench().bounds).with_obstacle("the block", block);
    let footprint = arm.footprint(&q);
    writeln!(text, "intersects: {}  distance: {:.4}", scene.intersects(&footprint), scene.distance(&footprint))?;
    let w = scene.witness(&footprint).ok_or("an empty scene has no witness")?;
    let (a, b) = (w.on_robot, w.on_obstacle);
    writeln!(text, "witness a*=({:.4}, {:.4}) b*=({:.4}, {:.4})", a.x, a.y, b.x, b.y)?;

    // Rusty against one wall
    let wall = Scene::of_walls(&[Segment::new(Point2::new(3.0, 0.0), Point2::new(3.0, 3.0))]);
    writeln!(text, "distance: {:.4}", wall.distance(&Footprint::disc(Point2::new(2.0, 1.0), RUSTY.body_radius)))?;

    // the 60 s tour, recorded, replayed from seed and script alone, and compared to the last bit
    let log = Run::record(TourConfig::default(), BOOK_SEED)?;
    if Run::replay(&log)? != log.frames() {
        return Err("the replay differs".into());
    }
    for line in motion_lab::recording::final_lines(&log) {
        writeln!(text, "{line}")?;
    }
    if let Some(folder) = figure.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(figure, run_svg(&log, log.recipe.config.ticks, Theme::Light, |_| {})?)?;
    Ok(text)
}

fn main() -> Result<(), Box<dyn Error>> {
    print!("{}", report(Path::new("figures/ch02_tour.svg"))?);
    Ok(())
}
