//! Figures of the widgets that need no run: anatomy, atlas, configuration space.

use crate::capture::{self, AtlasSheet, Captured, Paper, unit};
use motion_lab_core::cspace::{CellMap, Slice};
use motion_lab_core::picture::{Item, readout};
use motion_lab_core::robots::Robot;
use motion_lab_core::worlds::World;
use motion_lab_sim::anatomy::{Anatomy, Tab, WorldSource};
use motion_lab_sim::atlas::{Atlas, GridLayer, TeleportRefusal};

use super::args::SceneArgs;
use crate::cli::Failure;
use crate::cli::commands::query::Chosen;
use crate::cli::support::choices::{CHOSET, NumberList};
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::words::counted;
use crate::cli::support::world_source::find_world;

/// The query anatomy: the tab with a close view, or all four.
pub fn anatomy(args: &SceneArgs) -> Result<Captured, Failure> {
    Ok(capture::anatomy(&frozen(args)?, &args.tab.map_or(Tab::ALL.to_vec(), |tab| vec![tab])))
}

/// The workspace and beside it the configuration space.
pub fn cspace(args: &SceneArgs) -> Result<Captured, Failure> {
    // a motion is drawn where one is asked for
    let tab = if args.step.is_some() { Tab::Swept } else { Tab::default() };
    let anatomy = frozen(args)?.with_tab(tab);
    let slice = Slice::through(anatomy.checker(), &anatomy.q()).map_err(|e| Failure::usage(e, "Change --q."))?;
    let mut map = CellMap::new(slice, args.cells.unwrap_or(9));
    judge(&mut map, args.budget.unwrap_or(u32::MAX));
    Ok(capture::cspace(&anatomy, &map, Vec::new()))
}

/// Judges up to `budget` cells, and shows how far it has come.
fn judge(map: &mut CellMap, budget: u32) {
    let progress = CommandProgress::of(0, "cells, as known");
    let mut left = budget;
    while left > 0 && map.refine(left.min(PIECE)) {
        left -= left.min(PIECE);
        progress.expect(map.expected().min(u64::from(budget)));
        progress.at(u64::from(budget - left));
    }
}

/// Number of cells judged between two looks at the progress.
const PIECE: u32 = 1000;

/// Worlds, with the names of everything in them if `named`.
pub fn atlas(args: &SceneArgs, named: bool, paper: &Paper) -> Result<Captured, Failure> {
    let worlds: Vec<World> = match &args.world {
        Some(name) => vec![find_world(name)?],
        None => World::built_in_names().into_iter().map(find_world).collect::<Result<_, _>>()?,
    };
    if args.teleport.is_some() && worlds.len() > 1 {
        return Err(Failure::usage("--teleport needs a world", "Name it with --world."));
    }
    let mut atlases: Vec<Atlas> = worlds.into_iter().map(Atlas::new).collect();
    let grid = |atlas: &Atlas| {
        let layer = args.grid.map(|resolution| GridLayer::new(atlas.world(), resolution)).transpose();
        layer.map_err(|error| Failure::usage(error, "Give a coarser --grid, in metres."))
    };
    let grids: Vec<Option<GridLayer>> = atlases.iter().map(grid).collect::<Result<_, _>>()?;
    let mut notes = Vec::new();
    for atlas in &mut atlases {
        notes.push(match &args.teleport {
            Some(to) => teleport(atlas, to)?,
            None => (Vec::new(), Vec::new()),
        });
    }
    // a refusal has labels of its own where names would be
    let names = named && args.teleport.is_none();
    let sheet = |((atlas, grid), (over, readout))| AtlasSheet { atlas, grid, over, readout, names };
    let sheets: Vec<AtlasSheet<'_>> =
        atlases.iter().zip(grids.iter().map(Option::as_ref)).zip(notes).map(sheet).collect();
    Ok(capture::atlas(&sheets, paper.width_px()))
}

/// Puts the first robot at `to`. For a refusal, returns the items to draw and the lines to show.
fn teleport(atlas: &mut Atlas, to: &NumberList) -> Result<(Vec<Item>, Vec<String>), Failure> {
    let usage = |reason: String| Failure::usage(reason, "See `motion-lab capture --help`.");
    let resident = atlas.robots().first().ok_or_else(|| usage("no robot of the lab's lives there".into()))?;
    let to = &to.values(resident.robot.about().lengths).map_err(usage)?;
    let wrong = || usage(format!("{}: {} is at {}", counted(to.len(), "number"), resident.name, resident.q));
    let wanted = resident.q.with_coordinates(to).filter(|q| resident.robot.check(q).is_ok()).ok_or_else(wrong)?;
    let unit = unit(&resident.robot);
    Ok(match atlas.teleport(0, wanted) {
        Some(Err(refusal)) => {
            let mut said = vec![refusal.to_string()];
            if let TeleportRefusal::Overlap { nearest: Some(offer), .. } = &refusal {
                said.push(format!("nearest free: {}", readout(&offer.q.to_string())));
                let [away, nothing] = [offer.distance, offer.proven];
                said.push(format!("{away:.4} {unit} away, and nothing nearer than {nothing:.4} {unit} is free"));
            }
            (atlas.refusal_items(0, &wanted, &refusal), said)
        }
        _ => (Vec::new(), Vec::new()),
    })
}

/// The scene asked for.
fn frozen(args: &SceneArgs) -> Result<Anatomy, Failure> {
    let name = args.robot.as_deref().unwrap_or(CHOSET);
    let world_name = args.world.clone().unwrap_or_else(|| Chosen::home(name).to_owned());
    let (chosen, world) = Chosen::in_world(name, Some(&world_name))?;
    let source = World::built_in_names().into_iter().find(|n| *n == world_name);
    let source = source.map_or(WorldSource::File(world_name), WorldSource::BuiltIn);
    let usage = |error: &dyn std::fmt::Display| Failure::usage(error, "See `motion-lab capture --help`.");
    let (robot, q) = chosen.written(args.q.as_ref(), &world).map_err(|e| usage(&e))?;
    let mut anatomy = Anatomy::new(world, source, robot, q).map_err(|e| usage(&e))?;
    if chosen.name == CHOSET && chosen.start.is_none() && args.step.is_none() {
        anatomy.set_step(0, -std::f64::consts::FRAC_PI_2);
    }
    if let Some(step) = &args.step {
        if step.0.len() != anatomy.step().len() {
            return Err(usage(&format!("{}: the step has {}", counted(step.0.len(), "number"), anatomy.step().len())));
        }
        let values = chosen.values(step).map_err(|e| usage(&e))?;
        values.iter().enumerate().for_each(|(i, s)| anatomy.set_step(i, *s));
    }
    anatomy.show_annulus = args.annulus;
    Ok(anatomy)
}
