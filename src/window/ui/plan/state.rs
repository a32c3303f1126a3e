//! `PlanState`, the state of the widget that plans.

use std::sync::Arc;

use bevy::platform::time::Instant;

use super::paces::{PACES, SHOWS_REJECTED};
use super::racer::{PlanStage, Racer};
use motion_lab_core::collision::Checker;
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::picture::{Item, Picture, world as picture_of};
use motion_lab_core::planning::{Effort, NoPath};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::Robot;
use motion_lab_sim::anatomy::touching_items;
use motion_lab_sim::capture::judged_words;
use motion_lab_sim::lens::SpaceCells;
use motion_lab_sim::manifest::HintTask;
use motion_lab_sim::plans::{Bug1Walk, Drawn, PathLengths, PlannerName, Planners, Task, space_items, workspace_items};
use motion_lab_sim::run::Event;
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

/// Level of the finest cells: a 128th of the sides.
const FINEST: u32 = 7;

/// Largest part of a frame spent on iterations, seconds.
const BUDGET: f64 = 0.008;

/// The state of the widget that plans.
#[derive(Clone, Debug)]
pub struct PlanState {
    pub(super) task: Task,
    /// The planners at work on the task, in the order in which they came; never none.
    pub(super) racers: Vec<Racer>,
    /// The number of the one in front: what it grows is drawn, and its path is what can be played and saved.
    pub(super) front: usize,
    /// The planners to choose from.
    pub planners: Planners,
    pub(super) seed: Seed,
    /// Whether it goes on by itself.
    pub playing: bool,
    /// The number of its pace among [`PACES`].
    pub pace: usize,
    /// The iterations that are due: less than one after a frame.
    due: f64,
    pub(super) drawn: Drawn,
    /// The name by which commands know the world, if they do.
    pub(super) known_as: Option<&'static str>,
    backdrop: Arc<Picture>,
    /// The plan over the workspace.
    pub over: Arc<Picture>,
    pub(super) cells: Option<SpaceCells>,
    /// The plan over the cells, once it has been asked for.
    over_cells: Option<Arc<Picture>>,
    /// The end whose numbers are shown, and that is being dragged: 0 the start, 1 the goal.
    pub end: usize,
    /// Whether it is drawn over the dashboard's panes too.
    pub over_drive: bool,
    /// The path that the run plays, with the run's configuration and the inputs that play it.
    played: Option<(Arc<TourConfig>, Arc<Picture>, Vec<Event>)>,
    /// Whether the goal was moved since the planner was last at work.
    pub is_moved: bool,
    /// What the reader did that hints ask for, since it was last taken.
    pub tasks_done: Vec<HintTask>,
}

impl Default for PlanState {
    /// The chapter's question: round the post on the Workbench.
    fn default() -> Self {
        Self::of(Task::round_the_post())
    }
}

impl PlanState {
    /// A task, with the planner that suits its robot.
    pub fn of(task: Task) -> Self {
        let drawn = nothing(&task);
        let racer = Racer::new(PlannerName::default_for(&task.robot), &task, BOOK_SEED);
        let mut state = PlanState {
            known_as: task.world.built_in_name(),
            racers: vec![racer],
            front: 0,
            planners: Planners::default(),
            seed: BOOK_SEED,
            playing: false,
            pace: 3,
            due: 0.0,
            drawn,
            backdrop: Arc::new(picture_of(&task.world)),
            over: Arc::new(Picture::new("plan", task.world.bounds)),
            cells: None,
            over_cells: None,
            end: 1,
            over_drive: false,
            played: None,
            is_moved: false,
            tasks_done: Vec::new(),
            task,
        };
        state.look();
        state
    }

    /// The chapter's question, as the widget begins; the planners to choose from stay.
    pub fn begin_anew(&mut self) {
        *self = PlanState { planners: std::mem::take(&mut self.planners), ..Self::default() };
    }

    /// Another task. The planners that suit the robot stay, pace and seed stay.
    pub fn take(&mut self, task: Task) {
        let front = self.planner();
        let suits = |planner: &PlannerName| planner.suits(&task.robot).is_ok();
        let planners: Vec<PlannerName> = self.racing().filter(suits).collect();
        let (seed, pace, over_drive, played) = (self.seed, self.pace, self.over_drive, self.played.take());
        let known = std::mem::take(&mut self.planners);
        let task = Task { noise: self.task.noise, ..task };
        *self = PlanState { seed, pace, over_drive, played, planners: known, ..Self::of(task) };
        if !planners.is_empty() {
            self.race(&planners, front);
        } else {
            self.restart();
        }
    }

    /// The task.
    pub fn task(&self) -> &Task {
        &self.task
    }

    /// Whether its world is one of the built-in ones.
    pub fn is_in_books_world(&self) -> bool {
        self.known_as.is_some()
    }

    /// The planner in front, with its work.
    pub(super) fn racer(&self) -> &Racer {
        &self.racers[self.front]
    }

    /// The planner in front.
    pub fn planner(&self) -> PlannerName {
        self.racer().planner
    }

    /// Chooses another planner in place of the one in front, from its own start. One that races already goes from its
    /// old place; the others keep what they have.
    pub fn set_planner(&mut self, planner: PlannerName) {
        self.racers[self.front] = Racer::new(planner, &self.task, self.seed);
        let (mut i, front) = (0, self.front);
        self.racers.retain(|racer| {
            i += 1;
            i == front + 1 || racer.planner != planner
        });
        let front = self.racers.iter().position(|racer| racer.planner == planner);
        (self.playing, self.due) = (false, 0.0);
        self.bring(front.unwrap_or(0));
    }

    /// Whether the planner's robot walks by a range sensor, which may lie.
    pub fn is_by_sensor(&self) -> bool {
        self.planner() == PlannerName::Bug1Sensor
    }

    /// Whether the sensor lies: it is a cheap one with noise, not an exact one.
    pub fn sensor_lies(&self) -> bool {
        self.task.noise.is_some()
    }

    /// Chooses whether the sensor lies. The planner begins anew.
    pub fn set_sensor_lies(&mut self, lies: bool) {
        self.task.noise = lies.then_some(Bug1Walk::NOISE);
        self.restart();
    }

    /// The seed of the planner's samples, and of the sensor's noise where the sensor lies.
    pub fn seed(&self) -> Seed {
        self.seed
    }

    /// Chooses another seed, with which the planner begins anew.
    pub fn set_seed(&mut self, seed: Seed) {
        self.seed = seed;
        self.restart();
    }

    /// Moves the start, 0, or the goal, 1. The planner begins anew.
    pub fn move_end(&mut self, end: usize, q: AnyConfiguration) {
        let moved = if end == 0 { &mut self.task.start } else { &mut self.task.goal };
        if *moved != q {
            *moved = q;
            self.restart();
            self.is_moved |= end == 1;
        }
    }

    /// The start, 0, or the goal, 1.
    pub fn end_at(&self, end: usize) -> AnyConfiguration {
        if end == 0 { self.task.start } else { self.task.goal }
    }

    /// Whether another iteration does anything.
    pub fn goes_on(&self) -> bool {
        self.racers.iter().any(Racer::goes_on)
    }

    /// The plan in a sentence, for readers who do not see it.
    pub fn described(&self) -> String {
        let Task { name, start, goal, .. } = &self.task;
        let found = match self.stage() {
            PlanStage::Growing => format!("{} edges so far", self.drawn.edges.len()),
            PlanStage::Solved => format!("a path of {}", self.drawn.legs()),
            PlanStage::Ended(reason) => reason.to_string(),
            PlanStage::Read(file, judged) => {
                let judged = judged_words(judged.as_ref());
                return format!("the file {file} for {name}, from {start} to {goal}. {judged}");
            }
        };
        let left = self.drawn.sensed.iter().flat_map(|sensed| &sensed.leave_points).enumerate();
        let left: String = left.map(|(i, point)| format!("; round {}: {point}", i + 1)).collect();
        format!("{} for {name}, from {start} to {goal}: {found}{left}", self.planner().title())
    }

    /// How far the planner in front has come.
    pub fn stage(&self) -> &PlanStage {
        &self.racer().stage
    }

    /// What the planner in front has done.
    pub fn effort(&self) -> Effort {
        self.racer().effort()
    }

    /// What there is to draw.
    pub fn drawn(&self) -> &Drawn {
        &self.drawn
    }

    /// The length and the clearance of the planner's own path, if it has one.
    pub fn lengths(&self) -> Option<PathLengths> {
        self.racer().lengths()
    }

    /// A length that no path undercuts, metres, where it is known.
    pub fn length_bound(&self) -> Option<f64> {
        self.racer().work.as_ref()?.length_bound(&self.task)
    }

    /// The picture of the world alone.
    pub fn backdrop(&self) -> &Arc<Picture> {
        &self.backdrop
    }

    /// Begins anew: nothing is grown. Says at once where there is no problem to solve.
    pub fn restart(&mut self) {
        self.playing = false;
        self.due = 0.0;
        for racer in &mut self.racers {
            *racer = Racer::new(racer.planner, &self.task, self.seed);
        }
        self.look();
    }

    /// Does one iteration; nothing where no planner is at work, as for a file's path.
    pub fn step(&mut self) {
        if self.racers.iter().any(|racer| racer.work.is_some()) {
            self.step_unseen();
            self.look();
        }
    }

    /// Does one iteration of each planner without a path, or where all have one, of each that improves its own; looks
    /// not at what came of it. Once the last has its first path, or none goes on, they no longer go on by themselves.
    fn step_unseen(&mut self) {
        if !self.goes_on() {
            return self.playing = false;
        }
        self.tasks_done.extend(std::mem::take(&mut self.is_moved).then_some(HintTask::MoveGoal));
        let grow = self.racers.iter().any(Racer::grows);
        self.racers.iter_mut().filter(|racer| racer.grows() == grow).for_each(Racer::step);
        self.playing &= if grow { self.racers.iter().any(Racer::grows) } else { self.goes_on() };
    }

    /// Goes on by itself for a frame that took `seconds`.
    pub fn play(&mut self, seconds: f64) {
        let (rate, _) = PACES[self.pace.min(PACES.len() - 1)];
        // after a pause of the window it does not hurry to make up for it
        self.due = if rate.is_finite() { self.due + rate * seconds.clamp(0.0, 0.1) } else { f64::INFINITY };
        let begun = Instant::now();
        if self.due < 1.0 {
            return;
        }
        while self.playing && self.due >= 1.0 && begun.elapsed().as_secs_f64() < BUDGET {
            self.step_unseen();
            self.due -= 1.0;
        }
        // what the budget had no room for is let go
        self.due = if self.due < 1.0 { self.due } else { 0.0 };
        self.look();
    }

    /// The run with this configuration plays the path by these inputs: it is drawn over its world, but for the start,
    /// where the robot is.
    pub fn is_played_by(&mut self, config: &Arc<TourConfig>, inputs: Vec<Event>) {
        let left_out = ["start", "growth", "rival"];
        let shown = |item: &Item| !left_out.iter().any(|id| item.id.starts_with(id));
        let items = self.over.items.iter().filter(|item| shown(item)).cloned();
        let picture = Picture::new("played path", self.over.bounds).with(items);
        self.played = Some((Arc::clone(config), Arc::new(picture), inputs));
    }

    /// Forgets the path that a run played, unless that run is still the one with this configuration.
    pub fn see_run(&mut self, config: &Arc<TourConfig>) {
        self.played.take_if(|(played, ..)| !Arc::ptr_eq(played, config));
    }

    /// Whether a run with these inputs does nothing but play the path.
    pub fn plays_alone(&self, inputs: &[Event]) -> bool {
        self.played.as_ref().is_some_and(|(.., own)| *own == inputs)
    }

    /// The picture of the path or the plan for a pane that shows the world of this name, where it is to be drawn there.
    pub fn over_world(&self, name: &str) -> Option<&Arc<Picture>> {
        let is_there = |config: &TourConfig| config.worlds.iter().any(|world| world.name == name);
        let played = self.played.as_ref().filter(|(config, ..)| is_there(config)).map(|(_, picture, _)| picture);
        played.or_else(|| Some(&self.over).filter(|_| self.over_drive && self.task.world.name == name))
    }

    /// The slice of the configuration space behind the plan, through the end in hand, a little better known with each
    /// call.
    pub fn cells(&mut self, budget: u32) -> Option<(&SpaceCells, bool)> {
        let through = self.end_at(self.end);
        let slice_of = |cells: &SpaceCells| {
            let checker = cells.map().slice().checker();
            Arc::ptr_eq(&checker.shared_scene(), &self.task.scene) && *checker.robot() == self.task.planned()
        };
        let serves = |cells: &SpaceCells| slice_of(cells) && cells.map().slice().holds(&through);
        if !self.cells.as_ref().is_some_and(serves) {
            let checker = Checker::new(Arc::clone(&self.task.scene), self.task.planned());
            self.cells = SpaceCells::through(&checker, &through, FINEST);
            self.over_cells = None;
        }
        let cells = self.cells.as_mut()?;
        let more = cells.refine(budget);
        Some((cells, more))
    }

    /// Updates the drawing from what the planner in front has grown so far, and the others' paths. At fast paces what
    /// was rejected is not drawn.
    pub(super) fn look(&mut self) {
        let mut drawn = match &self.racer().work {
            Some(work) => work.with(|attempt| attempt.drawn()),
            None => nothing(&self.task),
        };
        let others = self.racers.iter().enumerate().filter(|(i, _)| *i != self.front);
        drawn.rivals = others.map(|(_, racer)| racer.path()).collect();
        if self.playing && PACES[self.pace.min(PACES.len() - 1)].0 > SHOWS_REJECTED {
            drawn.rejected = None;
        }
        // a disc has no heading: the ends keep the robot's own
        drawn.ends = [self.task.start, self.task.goal];
        self.draw(drawn);
    }

    /// Draws this from now on.
    pub(super) fn draw(&mut self, drawn: Drawn) {
        let mut items = workspace_items(&self.task.robot, &drawn);
        if matches!(self.stage(), PlanStage::Ended(NoPath::Problem(_))) {
            // an end in contact says with what
            let ends = drawn.ends.iter().map(|q| self.task.robot.footprint(q));
            items.extend(ends.flat_map(|footprint| touching_items(&self.task.scene, &footprint)));
        }
        self.over = Arc::new(Picture::new("plan", self.task.world.bounds).with(items));
        (self.drawn, self.over_cells) = (drawn, None);
    }

    /// The plan over the cells of the slice, drawn where something has changed.
    pub fn over_cells(&mut self) -> Option<Arc<Picture>> {
        let cells = self.cells.as_ref()?;
        let drawn = || {
            let items = space_items(cells.map().slice(), &self.drawn);
            Arc::new(Picture::new("plan in its space", cells.picture().bounds).with(items))
        };
        Some(Arc::clone(self.over_cells.get_or_insert_with(drawn)))
    }
}

/// The ends of a task, before anything is grown.
fn nothing(task: &Task) -> Drawn {
    Drawn::of_ends([task.start, task.goal])
}
