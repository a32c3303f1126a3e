//! Captures of the widgets without a run: anatomy, configuration space, atlas.

use super::{Captured, Note};
use crate::anatomy::{Anatomy, Tab};
use crate::atlas::{Atlas, GridLayer, names};
use crate::manifest::Widget;
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::cspace::{CellMap, cspace_picture};
use motion_lab_core::picture::{Figure, Item, Panel, readout, world as draw_world};

/// The query anatomy: these tabs side by side, or one tab with a close-up of the nearest points.
pub fn anatomy(anatomy: &Anatomy, tabs: &[Tab]) -> Captured {
    let mut panels = Vec::new();
    for tab in tabs {
        let shown = anatomy.clone().with_tab(*tab);
        let readout = shown.readout();
        panels.push(Panel { heading: tab.name().to_owned(), readout, picture: shown.picture() });
        if let (1, Some(picture)) = (tabs.len(), shown.close_up()) {
            panels.push(Panel { heading: "close up".into(), readout: Vec::new(), picture });
        }
    }
    let figure = Figure {
        title: format!("Query anatomy: {} in the world {}", anatomy.checker().robot().title(), anatomy.world().name),
        description: tabs.iter().map(|t| anatomy.clone().with_tab(*t).described()).collect::<Vec<_>>().join(" "),
        panels,
        caption: caption(Widget::Anatomy, anatomy),
    };
    Captured { figure, notes: notes(anatomy) }
}

/// The workspace, and beside it the configuration space as far as `map` knows it. `trace` is the path of the
/// configuration, oldest first. The chart line is drawn when the anatomy's tab is the swept one.
pub fn cspace(anatomy: &Anatomy, map: &CellMap, trace: Vec<AnyConfiguration>) -> Captured {
    let (known, picture) = (what_is_known(map), cspace_picture(map, &anatomy.in_space(trace)));
    let panels = vec![
        Panel { heading: "workspace".into(), readout: anatomy.readout(), picture: anatomy.picture() },
        Panel { heading: "configuration space".into(), readout: known, picture },
    ];
    let figure = Figure {
        title: format!("Workspace and configuration space of {}", anatomy.checker().robot().title()),
        description: anatomy.described(),
        panels,
        caption: caption(Widget::Cspace, anatomy),
    };
    Captured { figure, notes: notes(anatomy) }
}

/// What is said of a map's cells, line by line: the slice, and how much of it is known.
pub fn what_is_known(map: &CellMap) -> Vec<String> {
    let progress = map.progress();
    let share = |part: f64| format!("{:.1} %", 100.0 * part);
    vec![
        map.slice().described(),
        format!("proven free {}, proven blocked {}", share(progress.free), share(progress.blocked)),
        format!("not known {}, {} cells judged", share(progress.unknown), progress.judged),
    ]
}

/// A world of the atlas.
#[derive(Clone, Debug)]
pub struct AtlasSheet<'a> {
    /// The world with its robots.
    pub atlas: &'a Atlas,
    /// The grid under it.
    pub grid: Option<&'a GridLayer>,
    /// The items drawn over it, such as a refusal with its offer.
    pub over: Vec<Item>,
    /// The text under it.
    pub readout: Vec<String>,
    /// Whether names are shown.
    pub names: bool,
}

/// Worlds side by side on a sheet of this width, pixels.
pub fn atlas(sheets: &[AtlasSheet<'_>], width_px: f64) -> Captured {
    let panel = |sheet: &AtlasSheet<'_>| {
        let world = sheet.atlas.world();
        let mut picture = sheet.atlas.picture().with(sheet.over.iter().cloned());
        let mut readout = sheet.readout.clone();
        if let Some(layer) = sheet.grid {
            let over = std::mem::replace(&mut picture, layer.picture());
            picture.name.clone_from(&over.name);
            picture.items.extend(over.items);
            let grid = layer.grid();
            readout.push(format!("cells of {} m, {} x {}", grid.resolution(), grid.columns(), grid.rows()));
        }
        Panel { heading: world.name.clone(), readout, picture }
    };
    let worlds = || sheets.iter().map(|sheet| sheet.atlas.world());
    let list = |sheet: &AtlasSheet<'_>| {
        let names: Vec<String> = draw_world(sheet.atlas.world()).items.into_iter().map(|i| i.name).collect();
        format!("{}: {}.", sheet.atlas.world().name, names.join(", "))
    };
    let mut figure = Figure {
        title: "World atlas".into(),
        description: sheets.iter().map(list).collect::<Vec<_>>().join(" "),
        panels: sheets.iter().map(panel).collect(),
        caption: vec![Widget::Atlas.text().misconception.clone()],
    };
    let scales = figure.px_per_metre(width_px);
    for ((panel, sheet), scale) in figure.panels.iter_mut().zip(sheets).zip(scales).filter(|((_, s), _)| s.names) {
        panel.picture.items.extend(names(sheet.atlas, scale));
    }
    let contents = worlds().map(|w| format!("{} {:032x}", w.name, w.content_hash())).collect::<Vec<_>>();
    Captured { figure, notes: vec![("World", contents.join(", "))] }
}

/// The caption under the panels: the misconception that the widget removes, and the configuration shown.
fn caption(widget: Widget, anatomy: &Anatomy) -> Vec<String> {
    // other widgets' text is about the arm and does not hold for other robots
    let said = widget == Widget::Anatomy || anatomy.checker().robot().annulus().is_some();
    let misconception = said.then(|| widget.text().misconception.clone());
    misconception.into_iter().chain([readout(&anatomy.q().to_string())]).collect()
}

/// The notes of the file: the world's content hash and the configuration.
fn notes(anatomy: &Anatomy) -> Vec<Note> {
    vec![
        ("World", format!("{} {:032x}", anatomy.world().name, anatomy.world().content_hash())),
        ("Configuration", format!("{:?}", anatomy.q())),
    ]
}
