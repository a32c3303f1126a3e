//! `RunDraft`, the parameters of a whole run while its axes get their values.

use crate::batch::parameter::RunParameter;
use crate::batch::planning::{Planning, RunLength};
use crate::batch::study_text::{GoalText, NamedLength, PlannerText, StudyText, TicksText, WarehouseText};
use crate::batch::values::AxisValue;
use motion_lab_core::random::Seed;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{Resident, Warehouse, World};
use motion_lab_sim::plans::MAX_CLEARANCE;
use motion_lab_sim::tour::BOOK_SEED;

/// What the parameters of a whole run change.
pub struct RunDraft {
    pub seed: u64,
    pub length: RunLength,
    pub script: Option<String>,
    pub planner: Option<PlannerText>,
    pub worlds: Vec<String>,
    pub sensor: Option<RangeSensor>,
    pub warehouse: Option<WarehouseText>,
}

impl RunDraft {
    pub fn of(text: &StudyText) -> Self {
        // the book's own sensor and length, without making its worlds
        let sensor = text.sensor.map_or(RangeSensor { n_rays: 360, max_range: 4.0 }, |sensor| RangeSensor {
            n_rays: sensor.rays,
            max_range: sensor.range,
        });
        RunDraft {
            seed: text.seed.unwrap_or(BOOK_SEED.0),
            length: match (text.ticks, &text.planner) {
                (Some(TicksText::Ticks(ticks)), _) => RunLength::Ticks(ticks),
                (Some(TicksText::Named(NamedLength::Planned)), _) => RunLength::Planned,
                (None, Some(_)) => RunLength::Unsimulated,
                (None, None) => RunLength::Ticks(1200),
            },
            script: text.script.clone(),
            planner: text.planner.clone(),
            worlds: text.worlds.clone(),
            sensor: (!text.no_sensor).then_some(sensor),
            warehouse: text.warehouse,
        }
    }

    pub fn set(&mut self, of: RunParameter, value: &AxisValue) -> Result<(), String> {
        let no_warehouse = || "the study has no warehouse".to_owned();
        let no_planner = || "the study has no planner".to_owned();
        let no_sensor = || "the study has no sensor".to_owned();
        match (of, value) {
            (RunParameter::Seed, AxisValue::Whole(n)) => self.seed = *n,
            (RunParameter::Ticks, AxisValue::Whole(n)) => self.length = RunLength::Ticks(*n),
            (RunParameter::Script, AxisValue::Name(name)) => self.script = Some(name.clone()),
            (RunParameter::World, AxisValue::Name(name)) => self.worlds = vec![name.clone()],
            (RunParameter::Rays, AxisValue::Whole(n)) => {
                let sensor = self.sensor.as_mut().ok_or_else(no_sensor)?;
                sensor.n_rays = u32::try_from(*n).map_err(|_| format!("{n} rays: too many"))?;
            }
            (RunParameter::Range, AxisValue::Number(x)) => {
                self.sensor.as_mut().ok_or_else(no_sensor)?.max_range = *x;
            }
            (RunParameter::WarehouseSeed, AxisValue::Whole(n)) => {
                self.warehouse.as_mut().ok_or_else(no_warehouse)?.seed = *n;
            }
            (RunParameter::WarehouseRobots, AxisValue::Whole(n)) => {
                self.warehouse.as_mut().ok_or_else(no_warehouse)?.robots = *n;
            }
            (RunParameter::Planner, AxisValue::Name(name)) => {
                self.planner.as_mut().ok_or_else(no_planner)?.name = Some(name.clone());
            }
            (RunParameter::PlannerIterations, AxisValue::Whole(n)) => {
                self.planner.as_mut().ok_or_else(no_planner)?.iterations = Some(*n);
            }
            (RunParameter::PlannerTube, AxisValue::Number(x)) => {
                self.planner.as_mut().ok_or_else(no_planner)?.tube = *x;
            }
            (RunParameter::PlannerClearance, AxisValue::Number(x)) => {
                self.planner.as_mut().ok_or_else(no_planner)?.clearance = Some(*x);
            }
            // an axis has only values of its parameter's form
            _ => {}
        }
        Ok(())
    }
}

impl PlannerText {
    /// The planning of a run in these worlds, in which the goal's robot is alone.
    pub fn planning(&self, goal: Option<&GoalText>, worlds: &[World]) -> Result<Planning, String> {
        let PlannerText { name, iterations, tube, clearance } = self;
        let goal = goal.ok_or("a planner needs a goal")?;
        let robot = &goal.robot;
        let residents: Vec<&Resident> = worlds.iter().flat_map(|world| &world.robots).collect();
        let kind = match residents[..] {
            [resident] if resident.name == *robot => &resident.kind,
            _ => return Err(format!("a planner's robot is alone in its run: write robots: [{robot:?}]")),
        };
        let placed = Resident::try_new(robot, kind.clone(), goal.at(), None);
        let goal = placed.map_err(|problem| format!("the goal: {problem}"))?.start;
        if !(0.0..=1.0).contains(tube) {
            return Err(format!("planner.tube: {tube} m: it must be from 0 to 1 m"));
        }
        if let Some(kept) = clearance.filter(|kept| !(0.0..=MAX_CLEARANCE).contains(kept)) {
            return Err(format!("planner.clearance: {kept} m: it must be from 0 to {MAX_CLEARANCE} m"));
        }
        Ok(Planning { planner: name.clone(), goal, iterations: *iterations, tube: *tube, clearance: *clearance })
    }
}

/// The world of a warehouse.
pub fn generated(text: WarehouseText) -> Result<World, String> {
    let WarehouseText { robots, seed, trailers } = text;
    let robots = usize::try_from(robots).unwrap_or(usize::MAX);
    Warehouse { seed: Seed(seed), robots, trailers }.world().map_err(|error| error.to_string())
}
