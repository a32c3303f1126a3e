//! The session with its widgets, without a window: every behaviour by the names that a screen reader reads.

mod anatomy;
mod atlas;
mod capture;
mod crowd;
mod cspace;
mod doors;
mod drive;
mod own_kind;
mod persistence;
mod plan;
mod safe;
mod screen;
mod time;
mod widgets;
mod work;

use std::time::Duration;

use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_egui::egui::{self, Event, Key, Modifiers, PointerButton, Pos2, pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};

use super::desktop::files::{open_run, save_run};
use super::session::{SessionPlugin, carry_out};
use crate::window::ui::{AtlasState, Interface, SessionCommand, ShownDashboard, UiState};
use motion_lab_core::configuration::Coordinates;
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{Log, RobotInput, Script};
use motion_lab_sim::simulation::{
    History, LatestFrame, PendingInput, Playback, RobotView, RunCommand, RunConfig, Transport, view,
};

/// What the transport said when it was asked.
#[derive(Clone, Copy, Debug, PartialEq)]
struct TransportThen {
    seed: motion_lab_core::random::Seed,
    tick: u64,
    frontier: u64,
    playback: Playback,
    speed: f64,
    looping: bool,
}

/// The lab, run frame by frame. A frame takes a fortieth of a second: half a tick at normal speed.
struct Lab {
    app: App,
}

impl Lab {
    fn frame(&mut self, ui: &mut egui::Ui) {
        self.app.update();
        let world = self.app.world_mut();
        let mut commands = Vec::new();
        world.resource_scope(|world, mut interface: Mut<Interface>| {
            let (shown, history) = (world.resource::<ShownDashboard>(), world.resource::<History>());
            crate::window::ui::lab(ui, &shown.0, history, &mut interface.0, &mut commands);
        });
        if world.contains_resource::<super::desktop::dialogs::Dialogs>() {
            super::desktop::dialogs::show(world, ui.ctx());
        }
        carry_out(world, commands);
    }

    fn transport(&self) -> TransportThen {
        let transport = self.app.world().resource::<Transport>();
        let &Transport { playback, speed, looping, .. } = transport;
        let (seed, tick, frontier) = (transport.seed(), transport.tick(), transport.frontier());
        TransportThen { seed, tick, frontier, playback, speed, looping }
    }

    fn robot(&self, id: usize) -> RobotView {
        view(self.app.world()).swap_remove(id)
    }

    fn script(&self) -> &Script {
        self.app.world().resource::<PendingInput>().script()
    }
}

fn app(frame: Duration) -> App {
    let mut app = App::new();
    app.add_plugins((bevy::time::TimePlugin, SessionPlugin))
        .add_message::<SessionCommand>()
        .insert_resource(TimeUpdateStrategy::ManualDuration(frame));
    let settings = &mut app.world_mut().resource_mut::<Interface>().into_inner().0.settings;
    motion_lab_sim::manifest::Widget::ALL.into_iter().for_each(|widget| settings.put_hints_away(widget));
    app
}

const WIDE: [f32; 2] = [1280.0, 800.0];
const PHONE: [f32; 2] = [390.0, 844.0];

fn lab(size: [f32; 2]) -> Harness<'static, Lab> {
    lab_of(app(Duration::from_millis(25)), size)
}

fn lab_of(app: App, size: [f32; 2]) -> Harness<'static, Lab> {
    let lab = Lab { app };
    let mut harness =
        Harness::builder().with_size(size).with_step_dt(0.025).build_ui_state(|ui, lab: &mut Lab| lab.frame(ui), lab);
    harness.run_steps(3);
    harness
}

fn interface<'a>(harness: &'a Harness<'_, Lab>) -> &'a UiState {
    &harness.state().app.world().resource::<Interface>().0
}

fn interface_mut<'a>(harness: &'a mut Harness<'_, Lab>) -> &'a mut UiState {
    &mut harness.state_mut().app.world_mut().resource_mut::<Interface>().into_inner().0
}

/// Clicks the control of this name; what is in the menu, there.
fn click(harness: &mut Harness<'_, Lab>, name: &str) {
    if harness.query_by_label(name).is_none() {
        harness.get_by_label("Menu").click();
        harness.run_steps(3);
    }
    harness.get_by_label(name).click();
    harness.run_steps(3);
}

/// Brings the cockpit of this robot to the front.
fn bring(harness: &mut Harness<'_, Lab>, robot: &str) {
    harness.get_by_label_contains(&format!("Bring {robot}")).click();
    harness.run_steps(3);
}

/// The paper of the pane whose description begins with `begins`.
fn paper(harness: &Harness<'_, Lab>, begins: &str) -> egui::Rect {
    let node = harness
        .get_all_by_role(egui::accesskit::Role::Button)
        .find(|n| n.accesskit_node().label().is_some_and(|label| label.starts_with(begins)));
    node.expect("the pane").rect()
}

fn pointer(harness: &mut Harness<'_, Lab>, at: Pos2, pressed: Option<bool>) {
    harness.event(Event::PointerMoved(at));
    if let Some(pressed) = pressed {
        let button = PointerButton::Primary;
        harness.event(Event::PointerButton { pos: at, button, pressed, modifiers: Modifiers::NONE });
    }
    harness.step();
}

/// Holds Alt, or lets go of it: with it a drag puts a robot elsewhere.
fn alt(harness: &mut Harness<'_, Lab>, is_held: bool) {
    harness.event(Event::ModifiersChanged(if is_held { Modifiers::ALT } else { Modifiers::NONE }));
}

fn click_at(harness: &mut Harness<'_, Lab>, at: Pos2) {
    pointer(harness, at, Some(true));
    pointer(harness, at, Some(false));
    harness.run_steps(2);
}

fn arm_rusty(harness: &mut Harness<'_, Lab>) {
    let at = paper(harness, "Apartment").left_top() + egui::vec2(20.0, 60.0);
    click_at(harness, at);
    assert_eq!(harness.state().app.world().resource::<Interface>().0.hand.armed.as_deref(), Some("Rusty"));
}

fn pause(harness: &mut Harness<'_, Lab>) {
    click(harness, "Pause");
    assert_eq!(harness.state().transport().playback, Playback::Paused);
}

/// Drags the handle of this name to a point of the Workbench, in ten moves.
fn drag(harness: &mut Harness<'_, Lab>, handle: &str, to: [f64; 2]) {
    let from = harness.get_by_label(handle).rect().center();
    let paper = paper(harness, "Workbench");
    let scale = (paper.width() - 16.0) / 4.8;
    let to = paper.center() + egui::vec2(to[0] as f32, -to[1] as f32) * scale;
    pointer(harness, from, Some(true));
    for i in 1..=10 {
        pointer(harness, from.lerp(to, i as f32 / 10.0), None);
    }
    harness.run_steps(3);
    pointer(harness, to, Some(false));
    harness.run_steps(3);
}

/// The atlas as it is shown.
fn atlas(harness: &Harness<'_, Lab>) -> AtlasState {
    harness.state().app.world().resource::<Interface>().0.atlas.clone()
}

/// Where a point of the atlas's world is on the screen.
fn at(harness: &Harness<'_, Lab>, [x, y]: [f64; 2]) -> Pos2 {
    let world = atlas(harness).world().clone();
    let paper = harness.get_by_label_contains(&format!("World {}", world.name)).rect();
    let fit = crate::window::ui::paint::canvas::fit(&motion_lab_core::picture::world(&world), paper);
    let [x, y] = fit.screen_from_world(motion_lab_core::geometry::Point2::new(x, y));
    pos2(x as f32, y as f32)
}
