//! What the widgets that stand still show: anatomy, atlas, configuration space.

use motion_lab::anatomy::{Anatomy, Tab, WorldSource};
use motion_lab::atlas::{Atlas, GridLayer, Refusal, names};
use motion_lab::configuration::AnyConfiguration;
use motion_lab::cspace::{CellMap, Overlay, Slice, cspace_picture};
use motion_lab::picture::{Figure, Item, Panel, world as draw_world};
use motion_lab::robots::{AnyRobot, Robot};
use motion_lab::ui::{readout, widget};
use motion_lab::worlds::World;

use super::paper::{Note, Paper};
use super::{SceneArgs, TabName};
use crate::cli::Failure;
use crate::cli::numbers::Numbers;
use crate::cli::query::RobotName;
use crate::cli::world_source::find_world;

/// Writes the query anatomy: the tab with a close view, or all four.
pub fn anatomy(args: &SceneArgs, paper: &Paper) -> Result<(), Failure> {
    let anatomy = frozen(args)?;
    let tab = args.tab.map(|tab| match tab {
        TabName::Intersects => Tab::Intersects,
        TabName::Distance => Tab::Distance,
        TabName::Witness => Tab::Witness,
        TabName::Swept => Tab::Swept,
    });
    let tabs = tab.map_or(Tab::ALL.to_vec(), |tab| vec![tab]);
    let mut panels = Vec::new();
    for tab in &tabs {
        let shown = anatomy.clone().with_tab(*tab);
        let readout = shown.readout();
        panels.push(Panel { heading: tab.name().to_owned(), readout, picture: shown.picture() });
        if let (1, Some(picture)) = (tabs.len(), shown.close_up()) {
            panels.push(Panel { heading: "close up".into(), readout: Vec::new(), picture });
        }
    }
    let figure = Figure {
        title: format!("Query anatomy: {} in the world {}", anatomy.checker().robot().name(), anatomy.world().name),
        description: tabs.iter().map(|t| anatomy.clone().with_tab(*t).described()).collect::<Vec<_>>().join(" "),
        panels,
        caption: caption("anatomy", &anatomy),
    };
    paper.write(&figure, &notes(&anatomy))
}

/// Writes the workspace and beside it the configuration space.
pub fn cspace(args: &SceneArgs, paper: &Paper) -> Result<(), Failure> {
    let mut anatomy = frozen(args)?.with_tab(Tab::Swept);
    anatomy.show_annulus = args.annulus;
    let slice = Slice::through(anatomy.checker(), &anatomy.q()).map_err(|e| Failure::usage(e, "Change --q."))?;
    let mut map = CellMap::new(slice, args.cells.unwrap_or(9));
    map.refine(args.budget.unwrap_or(u32::MAX));
    let solutions = match (anatomy.checker().robot(), anatomy.q()) {
        (AnyRobot::Reach(arm), AnyConfiguration::T2(q)) => {
            arm.ik(arm.tip(&q)).into_iter().flatten().map(AnyConfiguration::T2).collect()
        }
        _ => Vec::new(),
    };
    let overlay = Overlay {
        now: Some(anatomy.q()),
        in_contact: anatomy.intersects(),
        line: Some([anatomy.q(), anatomy.second()]),
        solutions,
        ..Overlay::default()
    };
    let progress = map.progress();
    let share = |part: f64| format!("{:.1} %", 100.0 * part);
    let known = vec![
        format!("proven free {}, proven blocked {}", share(progress.free), share(progress.blocked)),
        format!("not known {}, {} cells judged", share(progress.unknown), progress.judged),
    ];
    let panels = vec![
        Panel { heading: "workspace".into(), readout: anatomy.readout(), picture: anatomy.picture() },
        Panel { heading: "configuration space".into(), readout: known, picture: cspace_picture(&map, &overlay) },
    ];
    let figure = Figure {
        title: format!("Workspace and configuration space of {}", anatomy.checker().robot().name()),
        description: anatomy.described(),
        panels,
        caption: caption("cspace", &anatomy),
    };
    paper.write(&figure, &notes(&anatomy))
}

/// Writes worlds with the names of everything in them.
pub fn atlas(args: &SceneArgs, paper: &Paper) -> Result<(), Failure> {
    let worlds: Vec<World> = match &args.world {
        Some(name) => vec![find_world(name)?],
        None => World::built_in_names().into_iter().map(find_world).collect::<Result<_, _>>()?,
    };
    if args.teleport.is_some() && worlds.len() > 1 {
        return Err(Failure::usage("a robot of which world?", "Name it with --world."));
    }
    let mut atlases: Vec<Atlas> = worlds.iter().map(|world| Atlas::new(world.clone())).collect();
    let mut panels = Vec::new();
    for (world, atlas) in worlds.iter().zip(&mut atlases) {
        let (refused, mut readout) = match &args.teleport {
            Some(Numbers(to)) => teleport(atlas, to)?,
            None => (Vec::new(), Vec::new()),
        };
        let mut picture = atlas.picture().with(refused);
        if let Some(resolution) = args.grid {
            let layer = GridLayer::new(world, resolution)
                .map_err(|error| Failure::usage(error, "Give a coarser --grid, in metres."))?;
            let over = std::mem::replace(&mut picture, layer.picture());
            picture.name.clone_from(&over.name);
            picture.items.extend(over.items);
            readout.push(format!("cells of {resolution} m, {} x {}", layer.grid().columns(), layer.grid().rows()));
        }
        panels.push(Panel { heading: world.name.clone(), readout, picture });
    }
    let list = |world: &World| draw_world(world).items.iter().map(|i| i.name.clone()).collect::<Vec<_>>().join(", ");
    let mut figure = Figure {
        title: "World atlas".into(),
        description: worlds.iter().map(|w| format!("{}: {}.", w.name, list(w))).collect::<Vec<_>>().join(" "),
        panels,
        caption: widget("atlas").map(|w| w.misconception.clone()).into_iter().collect(),
    };
    let scales = figure.px_per_metre(paper.width());
    let named = if args.teleport.is_some() { &[][..] } else { &atlases };
    for ((panel, atlas), scale) in figure.panels.iter_mut().zip(named).zip(scales) {
        panel.picture.items.extend(names(atlas, scale));
    }
    let contents = worlds.iter().map(|w| format!("{} {:032x}", w.name, w.content_hash())).collect::<Vec<_>>();
    paper.write(&figure, &[("World", contents.join(", "))])
}

/// Puts the first robot there; or what is to be drawn and said of its refusal.
fn teleport(atlas: &mut Atlas, to: &[f64]) -> Result<(Vec<Item>, Vec<String>), Failure> {
    let usage = |reason: String| Failure::usage(reason, "See `motion-lab capture --help`.");
    let resident = atlas.robots().first().ok_or_else(|| usage("no robot of the lab's lives there".into()))?;
    let wrong = || usage(format!("{} numbers: {} is at {}", to.len(), resident.name, resident.q));
    let wanted = resident.q.with_coordinates(to).filter(|q| resident.robot.check(q).is_ok()).ok_or_else(wrong)?;
    Ok(match atlas.teleport(0, wanted) {
        Some(Err(refusal)) => {
            let mut said = vec![refusal.to_string()];
            if let Refusal::Overlap { nearest: Some(offer), .. } = &refusal {
                said.push(format!("nearest free: {}", readout(&offer.q.to_string())));
                said.push(format!("{:.4} away, and nothing nearer than {:.4} is free", offer.distance, offer.proven));
            }
            (atlas.refusal_items(0, &wanted, &refusal), said)
        }
        _ => (Vec::new(), Vec::new()),
    })
}

/// The scene asked for.
fn frozen(args: &SceneArgs) -> Result<Anatomy, Failure> {
    let name = args.robot.unwrap_or(RobotName::Choset);
    let world_name = args.world.clone().unwrap_or_else(|| name.home().to_owned());
    let world = find_world(&world_name)?;
    let source = World::built_in_names().into_iter().find(|n| *n == world_name);
    let source = source.map_or(WorldSource::File(world_name), WorldSource::BuiltIn);
    let usage = |error: &dyn std::fmt::Display| Failure::usage(error, "See `motion-lab capture --help`.");
    let (robot, q) = name.at(args.q.as_ref().map(|q| &q.0[..]), &world).map_err(|e| usage(&e))?;
    let mut anatomy = Anatomy::new(world, source, robot, q).map_err(|e| usage(&e))?;
    if name == RobotName::Choset && args.step.is_none() {
        anatomy.set_step(0, -std::f64::consts::FRAC_PI_2);
    }
    if let Some(step) = &args.step {
        if step.0.len() != anatomy.step().len() {
            return Err(usage(&format!("{} numbers: the step has {}", step.0.len(), anatomy.step().len())));
        }
        step.0.iter().enumerate().for_each(|(i, s)| anatomy.set_step(i, *s));
    }
    anatomy.show_annulus = args.annulus;
    Ok(anatomy)
}

/// What stands under the panels: the misconception that the widget removes, and the configuration shown.
fn caption(id: &str, anatomy: &Anatomy) -> Vec<String> {
    let misconception = widget(id).map(|w| w.misconception.clone());
    misconception.into_iter().chain([readout(&anatomy.q().to_string())]).collect()
}

/// What makes the picture what it is.
fn notes(anatomy: &Anatomy) -> [Note; 2] {
    [
        ("World", format!("{} {:032x}", anatomy.world().name, anatomy.world().content_hash())),
        ("Configuration", format!("{:?}", anatomy.q())),
    ]
}
