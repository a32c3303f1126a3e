//! The user interface: the widgets, their settings and their commands.
//!
//! Colours are named by [`Theme`](motion_lab_core::picture::Theme) alone.

mod anatomy;
mod atlas;
mod capture_form;
pub(crate) mod capture_state;
mod closing;
mod command;
mod crowd;
mod cspace;
mod dashboard;
mod help;
pub(crate) mod keys;
mod lab;
mod lesson;
mod lesson_state;
mod menu;
mod number;
pub(crate) mod paint;
pub(crate) mod plan;
mod recent;
mod recent_menu;
mod settings;
mod state;
mod tasks_done;
mod time;

pub(crate) use anatomy::AnatomyState;
pub(crate) use atlas::AtlasState;
pub(crate) use capture_state::{CaptureOrder, CaptureState};
pub(crate) use command::{Command, SessionCommand};
pub(crate) use crowd::members::Members;
pub(crate) use crowd::state::CrowdState;
pub(crate) use crowd::values::{CrowdRobot, CrowdView, MAX_SHOWN_EACH, Stance};
pub(crate) use cspace::put_at::footprint_at;
pub(crate) use cspace::{CspaceState, LinkedState, TRAIL};
pub(crate) use dashboard::blend::blend;
pub(crate) use dashboard::goal::ParkingExercise;
pub(crate) use dashboard::hand::arm::{joints, turned};
pub(crate) use dashboard::hand::held_tow::HeldTow;
pub(crate) use dashboard::stage::front;
pub(crate) use dashboard::twin_state::AskedTwin;
pub(crate) use dashboard::values::{Cockpit, CockpitRobot, Dashboard, ShownClearance, ShownDashboard};
pub(crate) use lab::lab;
pub(crate) use lesson_state::LessonState;
pub(crate) use paint::frame_colours::FrameColours;
pub(crate) use plan::PlanState;
pub(crate) use recent::Recent;
pub(crate) use settings::Settings;
pub(crate) use state::{Closing, Grasp, Interface, Notice, Offer, SeedDraft, UiState, Working};
pub(crate) use time::chance::{ScriptMark, ShownChance};
