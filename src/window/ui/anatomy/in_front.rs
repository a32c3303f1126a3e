//! The robot in front, wherever it is shown: what a widget hands on to the one that comes in front after it, and what
//! is put into the run from there.
//!
//! A robot on its tour in a run that plays, and what a widget begins with, were nobody's choice, so neither is handed
//! on. A plan under way and an edited world are not replaced: they are another question.

use std::sync::Arc;

use bevy_egui::egui::Ui;

use crate::window::ui::dashboard::in_hand::chosen;
use crate::window::ui::dashboard::stage::front;
use crate::window::ui::paint::button::LabButton;
use crate::window::ui::{AtlasState, Cockpit, Command, Dashboard, FrameColours, SessionCommand, UiState};
use motion_lab_core::configuration::{AnyConfiguration, Configuration};
use motion_lab_core::robots::AnyRobot;
use motion_lab_core::worlds::World;
use motion_lab_sim::anatomy::{Anatomy, WorldSource};
use motion_lab_sim::manifest::Widget;
use motion_lab_sim::plans::Task;
use motion_lab_sim::run::Quantized;

/// A robot where it stands, in its world as it is.
#[derive(Clone, Debug, PartialEq)]
struct RobotInFront {
    /// Its name: that of a resident of the world, or of its kind.
    name: String,
    robot: AnyRobot,
    q: AnyConfiguration,
    world: Arc<World>,
    source: WorldSource,
}

/// Hands the robot in front on to the widget that comes in front next.
pub fn hand_on(to: Widget, model: &Dashboard, state: &mut UiState) {
    if let Some(robot) = RobotInFront::of(model, state).filter(|_| to != state.widget) {
        robot.show_in(to, state);
    }
}

impl RobotInFront {
    /// The robot of the widget in front, if somebody chose its state.
    fn of(model: &Dashboard, state: &UiState) -> Option<Self> {
        match state.widget {
            Widget::Dashboard => Self::of_run(model, state),
            Widget::Anatomy | Widget::Cspace => Some(Self::of_query(&state.anatomy.anatomy))
                .filter(|shown| *shown != Self::of_query(&Anatomy::default())),
            Widget::Plan => {
                let first = Self::of_plan(&Task::round_the_post());
                Some(Self::of_plan(state.plan.task())).filter(|shown| *shown != first)
            }
            Widget::Atlas => Self::of_atlas(&state.atlas).filter(|_| state.atlas.was_changed()),
        }
    }

    /// The robot of the dashboard's world in front, at the tick shown, where the run was stopped there or the robot is
    /// driven by hand. `None` for a kind that is not the lab's.
    fn of_run(model: &Dashboard, state: &UiState) -> Option<Self> {
        let (_, cockpit) = front(&model.cockpits, state)?;
        let shown = chosen(cockpit, state).filter(|robot| !model.playing || robot.manual)?;
        let (_, q) = AnyRobot::of_kind(&shown.kind, &shown.coordinates)?;
        let world = Arc::clone(&cockpit.standing);
        let source = WorldSource::of(&world).unwrap_or(WorldSource::Unsaved);
        Some(RobotInFront { name: shown.name.clone(), robot: shown.model?.fitted(&q), q, world, source })
    }

    /// The robot of Query and Space.
    fn of_query(anatomy: &Anatomy) -> Self {
        let (name, robot) = (name_of(anatomy).to_owned(), *anatomy.checker().robot());
        let (world, source) = (Arc::clone(anatomy.world()), anatomy.source().clone());
        RobotInFront { name, robot, q: anatomy.q(), world, source }
    }

    /// The robot of a plan, where its path begins.
    fn of_plan(task: &Task) -> Self {
        let source = WorldSource::of(&task.world).unwrap_or(WorldSource::Unsaved);
        let world = Arc::clone(&task.world);
        RobotInFront { name: task.name.clone(), robot: task.robot, q: task.start, world, source }
    }

    /// The robot that the atlas's clicks put.
    fn of_atlas(atlas: &AtlasState) -> Option<Self> {
        let robot = atlas.atlas().robots().get(atlas.robot)?;
        let (world, source) = (Arc::new(atlas.world().clone()), atlas.source());
        Some(RobotInFront { name: robot.name.clone(), robot: robot.robot, q: robot.q, world, source })
    }

    /// Shows it in a widget. The run is what it is: the dashboard takes nothing.
    fn show_in(self, widget: Widget, state: &mut UiState) {
        match widget {
            Widget::Dashboard => {}
            Widget::Anatomy | Widget::Cspace => {
                let asked = &state.anatomy.anatomy;
                if self != Self::of_query(asked)
                    && let Ok(asked) = asked.of_robot(World::clone(&self.world), self.source, self.robot, self.q)
                {
                    state.anatomy.set(asked);
                }
            }
            Widget::Plan => {
                if state.plan.is_idle() && self != Self::of_plan(state.plan.task()) {
                    state.plan.show((&self.name, self.robot), self.world, self.q, None);
                }
            }
            Widget::Atlas => {
                if state.atlas.has_history() {
                    return;
                }
                if *state.atlas.world() != *self.world {
                    state.open_world(AtlasState::of(World::clone(&self.world)));
                }
                state.atlas.stand(&self.name, self.q);
            }
        }
    }
}

/// The button that puts a robot of the run where a widget has it.
pub struct PutInRun<'a> {
    /// The world's name.
    pub world: &'a str,
    /// The robot's name.
    pub robot: &'a str,
    pub q: AnyConfiguration,
}

impl<'a> PutInRun<'a> {
    /// For the robot of Query and Space.
    pub fn of_query(anatomy: &'a Anatomy) -> Self {
        PutInRun { world: &anatomy.world().name, robot: name_of(anatomy), q: anatomy.q() }
    }

    /// Shows it. It is disabled unless the run has a robot of this name, with as many coordinates, in a world of this
    /// name.
    pub fn show(&self, ui: &mut Ui, model: &Dashboard, look: &FrameColours, commands: &mut Vec<Command>) {
        let own = self.q.coordinates();
        let is_other = |c: &Cockpit| c.robots.iter().any(|r| r.name == self.robot && r.coordinates.len() != own.len());
        let lives_there = |c: &Cockpit| c.world.name == self.world && c.has(self.robot) && !is_other(c);
        let is_there = model.cockpits.iter().any(lives_there);
        let button = LabButton::new("Put it in the run").enabled(is_there).show(ui, look);
        let words =
            if is_there { "At the next tick; Ctrl+Z undoes it" } else { "It does not live in the run under way" };
        if button.on_hover_text(words).clicked() {
            let coordinates = own.iter().filter_map(|c| Quantized::try_new(*c)).collect();
            let (world, robot) = (self.world.to_owned(), self.robot.to_owned());
            commands.push(Command::Session(SessionCommand::PutRobot { world, robot, coordinates }));
        }
    }
}

/// The name of the robot of Query and Space: of the world's resident that it is, or of its kind.
fn name_of(anatomy: &Anatomy) -> &str {
    anatomy.lives_as().map_or(anatomy.checker().robot().title(), |resident| &resident.name)
}
