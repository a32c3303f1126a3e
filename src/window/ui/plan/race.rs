//! The race of a plan: up to three planners at the same task, and a table of what came of each.

use bevy_egui::egui::{Align, Label, Layout, RichText, TextStyle, Ui, WidgetInfo, WidgetType, vec2};

use super::racer::{PlanStage, Racer};
use super::state::PlanState;
use crate::window::ui::FrameColours;
use crate::window::ui::paint::fold::menu;
use motion_lab_core::picture::Role;
use motion_lab_sim::capture::{proven, unit};
use motion_lab_sim::plans::{PathLengths, PlannerName};

/// The most planners that race.
const MAX_RACERS: usize = 3;

/// Width of a planner's name and of a number, points, and of a table with its names beside its numbers.
const NAME: f32 = 132.0;
const NUMBER: f32 = 76.0;
const WIDE: f32 = NAME + 4.0 * NUMBER;

/// The numbers of a row.
const NUMBERS: [&str; 4] = ["iterations", "edges", "length", "clearance"];

impl PlanState {
    /// The planners at work, in the order in which they came.
    pub fn racing(&self) -> impl Iterator<Item = PlannerName> {
        self.racers.iter().map(|racer| racer.planner)
    }

    /// Whether there is more than one planner at work.
    pub fn is_race(&self) -> bool {
        self.racers.len() > 1
    }

    /// Lets these planners race from the start, with this one in front, or else the first.
    pub fn race(&mut self, planners: &[PlannerName], front: PlannerName) {
        let new = |planner: &PlannerName| Racer::new(*planner, &self.task, self.seed);
        let racers: Vec<Racer> = planners.iter().take(MAX_RACERS).map(new).collect();
        if !racers.is_empty() {
            self.front = racers.iter().position(|racer| racer.planner == front).unwrap_or(0);
            self.racers = racers;
        }
        self.restart();
    }

    /// Lets another planner join, from its own start. It comes to the front; what the others have, they keep.
    pub fn join(&mut self, planner: PlannerName) {
        if self.racers.len() < MAX_RACERS && self.racing().all(|other| other != planner) {
            self.racers.push(Racer::new(planner, &self.task, self.seed));
            self.bring(self.racers.len() - 1);
        }
    }

    /// Leaves the planner in front alone, with what it has.
    pub fn end_race(&mut self) {
        self.racers = vec![self.racer().clone()];
        self.bring(0);
    }

    /// Brings the planner of this number to the front. Nothing begins anew.
    pub fn bring(&mut self, racer: usize) {
        if racer < self.racers.len() {
            self.front = racer;
            self.look();
        }
    }
}

/// Shows who races: a menu of the planners that may join, and a link that ends the race.
pub fn who_races(ui: &mut Ui, plan: &mut PlanState) {
    if matches!(plan.stage(), PlanStage::Read(..)) {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        let racing: Vec<PlannerName> = plan.racing().collect();
        let robot = plan.task().robot;
        let is_new = |name: &PlannerName| name.suits(&robot).is_ok() && !racing.contains(name);
        let others: Vec<PlannerName> = plan.planners.all().filter(is_new).collect();
        if !others.is_empty() && racing.len() < MAX_RACERS {
            menu(ui, "Race another", |ui| {
                for planner in others {
                    if ui.button(planner.title()).clicked() {
                        plan.join(planner);
                        ui.close();
                    }
                }
            });
        }
        if plan.is_race() && ui.link("End the race").on_hover_text("Only the planner in front stays").clicked() {
            plan.end_race();
        }
    });
}

/// Shows the table of a race; a click on a planner brings it to the front. Beside the names of the others stands how
/// their paths are drawn. Nothing where one planner is alone.
pub fn table(ui: &mut Ui, look: &FrameColours, plan: &mut PlanState) {
    if !plan.is_race() {
        return;
    }
    let is_wide = ui.available_width() >= WIDE;
    let front = plan.planner();
    let unit = unit(&plan.task().robot);
    let [iterations, edges, length, clearance] = NUMBERS;
    let head = [iterations.into(), edges.into(), format!("{length},\u{a0}{unit}"), format!("{clearance},\u{a0}m")];
    let head =
        head.map(|words: String| RichText::new(words).text_style(TextStyle::Small).color(look.colour(Role::Muted)));
    row(ui, is_wide.then(|| RichText::new("")), head);
    let (mut chosen, mut rivals) = (None, 0);
    for (i, racer) in plan.racers.iter().enumerate() {
        let numbers = numbers(racer);
        let spoken: Vec<String> =
            NUMBERS.iter().zip(&numbers).map(|(name, number)| format!("{name} {number}")).collect();
        let spoken = format!("{}: {}", racer.planner.title(), spoken.join(", "));
        let line = match (i == plan.front, rivals) {
            (true, _) => "",
            (false, 0) => " \u{2013}\u{a0}\u{2013}",
            (false, _) => " \u{b7}\u{a0}\u{b7}\u{a0}\u{b7}",
        };
        rivals += u32::from(i != plan.front);
        let words = numbers.map(|number| RichText::new(number).monospace());
        ui.horizontal(|ui| {
            let size = vec2(if is_wide { NAME } else { ui.available_width() }, ui.spacing().interact_size.y);
            let layout = Layout::left_to_right(Align::Center);
            let name = ui.allocate_ui_with_layout(size, layout, |ui| {
                ui.set_min_width(if is_wide { NAME } else { 0.0 });
                ui.selectable_label(racer.planner == front, format!("{}{line}", racer.planner.title()))
            });
            let name = name.inner;
            name.widget_info(|| WidgetInfo::selected(WidgetType::Button, true, racer.planner == front, &spoken));
            if name.on_hover_text("Bring it to the front").clicked() {
                chosen = Some(i);
            }
            if is_wide {
                cells(ui, words.clone());
            }
        });
        if !is_wide {
            row(ui, None, words);
        }
    }
    if let Some(chosen) = chosen {
        plan.bring(chosen);
    }
}

/// The numbers of a planner: what it took, and the length and the clearance of its path; a dash where it has none, and
/// in place of both why there is none.
fn numbers(racer: &Racer) -> [String; 4] {
    let effort = racer.effort();
    let [length, clearance] = match (&racer.stage, racer.lengths()) {
        (_, Some(PathLengths { length, clearance })) => [format!("{length:.3}"), proven(clearance)],
        (PlanStage::Ended(_), None) => ["no path".to_owned(), "\u{2013}".to_owned()],
        _ => ["\u{2013}"; 2].map(str::to_owned),
    };
    [effort.iterations.to_string(), effort.edges.to_string(), length, clearance]
}

/// Shows a row: a name, if it stands beside the numbers, and the numbers.
fn row(ui: &mut Ui, name: Option<RichText>, numbers: [RichText; 4]) {
    ui.horizontal(|ui| {
        if let Some(name) = name {
            let size = vec2(NAME, ui.text_style_height(&TextStyle::Small));
            ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
                ui.set_min_width(NAME);
                ui.label(name)
            });
        }
        cells(ui, numbers);
    });
}

/// Shows four numbers, each at the right end of its cell.
fn cells(ui: &mut Ui, numbers: [RichText; 4]) {
    ui.spacing_mut().item_spacing.x = 0.0;
    for number in numbers {
        let size = vec2(NUMBER, ui.text_style_height(&TextStyle::Monospace));
        ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
            ui.set_min_width(NUMBER);
            ui.add(Label::new(number).extend());
        });
    }
}
