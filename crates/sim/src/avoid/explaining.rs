//! `Explaining`, an explanation under way.

use super::approach::Approach;
use super::branches::Branches;
use super::round::round_from;
use super::search::{EvasionSearch, SearchState};
use super::simulated_again::{AddKinds, recorder, without_sensors};
use super::speed_channel::speed_channel;
use super::{
    AvoidError, ContactEpisode, ContactPartner, Evasion, EvasionMeans, EvasionSet, EvasionSpeeds, Explanation,
    LastChance, NoEvasion, SearchExtent,
};
use crate::recording::Recorder;
use crate::run::{Event, Quantized, Recipe, RobotInput, Script};

/// Explains a contact of a run: until when it could be avoided, and how.
///
/// # Errors
/// [`AvoidError`]: the set is refused, or the run has no such contact.
pub fn explain(recipe: &Recipe, episode: &ContactEpisode, set: &EvasionSet) -> Result<Explanation, AvoidError> {
    Explaining::new(recipe, (&episode.robot, episode.first), set)?.finish()
}

/// From how many ticks a way round is sought.
const ROUND_TRIES: usize = 20;

/// The explanation of a contact, a piece at a time: a tick of the run, some of a branch, or a plan.
pub struct Explaining {
    recipe: Recipe,
    set: EvasionSet,
    add: Option<AddKinds>,
    phase: Phase,
    stopping: Option<LastChance>,
    ticks: u64,
}

/// What is being done.
enum Phase {
    /// The run goes up to the contact and to its end.
    Approach(Box<Approach>),
    /// Channels are tried.
    Drive { branches: Box<Branches>, search: Box<EvasionSearch> },
    /// An arm stays where it is.
    Stay(Box<Branches>, SearchExtent),
    /// A way round is planned.
    Round(Box<Branches>, RoundTries),
    /// A way out is simulated in the whole run.
    Confirm(Box<Confirmation>, Confirmed),
    /// It is done, or has failed.
    Over,
}

/// A way out, simulated in the whole run.
struct Confirmation {
    branches: Branches,
    run: Recorder,
    /// The run without it, where the world changes meanwhile.
    as_it_was: Option<Recorder>,
    evasion: Evasion,
}

/// What follows where a way out is none in the whole run.
enum Confirmed {
    /// It is a fault: nothing that a branch leaves out moves the robot.
    Surely,
    /// The next is tried: a planner knows nothing of what changes meanwhile.
    Else(RoundTries),
}

/// The ticks from which a way round is still to be sought.
struct RoundTries {
    ticks: std::collections::VecDeque<u64>,
    extent: SearchExtent,
    /// Why the last one failed.
    why: NoEvasion,
}

impl Explaining {
    /// The explanation of the contact of a robot that begins in a tick.
    ///
    /// # Errors
    /// [`AvoidError`]: the set is refused, or the run cannot start. That there is no such contact shows later.
    pub fn new(recipe: &Recipe, (robot, tick): (&str, u64), set: &EvasionSet) -> Result<Self, AvoidError> {
        Self::with_robots(recipe, (robot, tick), set, None)
    }

    /// [`new`](Self::new) with further kinds of robots.
    ///
    /// # Errors
    /// As of [`new`](Self::new).
    pub fn with_robots(
        recipe: &Recipe,
        (robot, tick): (&str, u64),
        set: &EvasionSet,
        add: Option<AddKinds>,
    ) -> Result<Self, AvoidError> {
        set.check()?;
        let approach = Approach::new(recipe, (robot, tick), set.back, add.clone())?;
        let phase = Phase::Approach(Box::new(approach));
        Ok(Explaining { recipe: recipe.clone(), set: set.clone(), add, phase, stopping: None, ticks: 0 })
    }

    /// The number of ticks that were simulated so far.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    /// Does the whole of it.
    ///
    /// # Errors
    /// As of [`step`](Self::step).
    pub fn finish(mut self) -> Result<Explanation, AvoidError> {
        loop {
            if let Some(explanation) = self.step()? {
                return Ok(explanation);
            }
        }
    }

    /// Does the next piece. Returns the explanation when it is done.
    ///
    /// # Errors
    /// [`AvoidError::NoContact`] where no contact of the robot begins in that tick, and after the end.
    pub fn step(&mut self) -> Result<Option<Explanation>, AvoidError> {
        match std::mem::replace(&mut self.phase, Phase::Over) {
            Phase::Approach(mut approach) => {
                self.ticks += 1;
                match approach.step()? {
                    None => self.phase = Phase::Approach(approach),
                    Some(episode) => {
                        let branches = Branches::new(*approach, episode, self.set.horizon)?;
                        return self.begin_stopping(Box::new(branches));
                    }
                }
                Ok(None)
            }
            Phase::Drive { mut branches, mut search } => {
                let before = branches.ticks;
                let state = search.step(&mut branches)?;
                self.count(branches.ticks - before);
                search.extent.ticks += branches.ticks - before;
                match state {
                    SearchState::Open => {
                        self.phase = Phase::Drive { branches, search };
                        Ok(None)
                    }
                    SearchState::Exhausted => {
                        self.answered(branches, LastChance::None(NoEvasion::TooLate(search.extent)))
                    }
                    SearchState::Found(channels) => {
                        let evasion = self.driven(&branches, channels, search.extent);
                        self.confirm(branches, evasion, Confirmed::Surely)
                    }
                }
            }
            Phase::Stay(branches, extent) => self.stay(branches, extent),
            Phase::Round(branches, tries) => self.round(branches, tries),
            Phase::Confirm(confirmation, then) => self.go_on(confirmation, then),
            Phase::Over => Err(AvoidError::Over),
        }
    }

    /// Runs the next tick of a way out in the whole run.
    fn go_on(&mut self, mut at: Box<Confirmation>, then: Confirmed) -> Result<Option<Explanation>, AvoidError> {
        self.ticks += 1;
        let Confirmation { branches, run, as_it_was, evasion } = &mut *at;
        let frame = run.step();
        let state = |robot: &str| {
            let id = self.recipe.config.robot_names().position(|name| name == robot);
            id.and_then(|id| frame.robots.get(id))
        };
        let touches = state(&branches.episode.robot).is_none_or(|robot| robot.in_contact);
        let tick = frame.tick;
        if let ContactPartner::Robot(other) = &branches.episode.with {
            let meets = state(other).is_some_and(|other| other.in_contact);
            evasion.is_still_met |= tick >= evasion.tick && meets;
        }
        if let Some(as_it_was) = as_it_was {
            as_it_was.step();
            evasion.is_in_the_way = run.refusals().count() > as_it_was.refusals().count();
        }
        if tick >= evasion.tick && touches {
            let Confirmation { branches, evasion, .. } = *at;
            return self.unconfirmed(Box::new(branches), evasion, then);
        }
        if tick >= evasion.free_until {
            let Confirmation { branches, evasion, .. } = *at;
            return self.answered(Box::new(branches), LastChance::At(evasion));
        }
        self.phase = Phase::Confirm(at, then);
        Ok(None)
    }

    fn count(&mut self, ticks: u64) {
        self.ticks += ticks;
    }

    /// Begins with standing still.
    fn begin_stopping(&mut self, mut branches: Box<Branches>) -> Result<Option<Explanation>, AvoidError> {
        if branches.takes(|_| Some(RobotInput::Drive(0, 0)))? {
            return self.drive(branches, vec![[0, 0]], 0);
        }
        if branches.takes(move_to)? {
            self.phase = Phase::Stay(branches, SearchExtent::default());
            return Ok(None);
        }
        self.stopping = Some(LastChance::None(NoEvasion::NoInputs));
        self.answered(branches, LastChance::None(NoEvasion::NoInputs))
    }

    /// Begins to try channels, with at most this many switches.
    fn drive(
        &mut self,
        branches: Box<Branches>,
        channels: Vec<[i16; 2]>,
        switches: u32,
    ) -> Result<Option<Explanation>, AvoidError> {
        let set = EvasionSet { switches, ..self.set.clone() };
        let (until, ticks) = (branches.episode.first + set.horizon, branches.ticks_back(set.back));
        self.phase = Phase::Drive { branches, search: Box::new(EvasionSearch::new(channels, &set, until, ticks)) };
        Ok(None)
    }

    /// Takes the answer to what was asked last, and goes on to the next.
    fn answered(&mut self, mut branches: Box<Branches>, answer: LastChance) -> Result<Option<Explanation>, AvoidError> {
        let Some(stopping) = self.stopping.take() else {
            let drives = matches!(&answer, LastChance::At(Evasion { means: EvasionMeans::Channels(_), .. }));
            let drives = drives || branches.takes(|_| Some(RobotInput::Drive(0, 0)))?;
            self.stopping = Some(answer);
            return if drives { self.begin_driving(branches) } else { self.begin_round(branches) };
        };
        Ok(Some(Explanation { episode: branches.episode.clone(), stopping, going_on: answer }))
    }

    fn begin_driving(&mut self, mut branches: Box<Branches>) -> Result<Option<Explanation>, AvoidError> {
        let speeds = match &self.set.speeds {
            EvasionSpeeds::Channels(speeds) => speeds.clone(),
            EvasionSpeeds::Kept => match speed_channel(&mut branches)? {
                Ok(kept) => vec![kept],
                Err(none) => return self.answered(branches, LastChance::None(none)),
            },
        };
        let turns = || self.set.turns.iter().copied();
        let mut channels: Vec<[i16; 2]> = Vec::new();
        for pair in speeds.iter().flat_map(|&a| turns().map(move |b| [a, b])) {
            if !channels.contains(&pair) {
                channels.push(pair);
            }
        }
        self.drive(branches, channels, self.set.switches)
    }

    fn driven(&self, branches: &Branches, channels: Vec<(u64, [i16; 2])>, extent: SearchExtent) -> Evasion {
        let episode = &branches.episode;
        let (tick, free_until) = (extent.earliest, episode.first + self.set.horizon);
        let inputs = channels.iter().map(|&(tick, [a, b])| (tick, RobotInput::Drive(a, b)));
        // nothing is known of what comes then, so it stops there
        let stop =
            channels.last().filter(|(_, last)| *last != [0, 0]).map(|_| (free_until + 1, RobotInput::Drive(0, 0)));
        let script = self.script(episode, tick, inputs.chain(stop));
        Evasion {
            tick,
            free_until,
            means: EvasionMeans::Channels(channels),
            script,
            extent,
            is_still_met: false,
            is_in_the_way: false,
        }
    }

    /// Lets an arm stay where it is from the next tick before.
    fn stay(&mut self, mut branches: Box<Branches>, extent: SearchExtent) -> Result<Option<Explanation>, AvoidError> {
        let until = branches.episode.first + self.set.horizon;
        let tick = branches.ticks_back(self.set.back).get(extent.branches as usize).copied();
        let frame = tick.and_then(|tick| branches.frame(tick - 1)).cloned();
        let (Some(tick), Some(frame)) = (tick, frame) else {
            return self.answered(branches, LastChance::None(NoEvasion::TooLate(extent)));
        };
        let Some(input) = move_to(&branches.state(&frame).configuration) else {
            return self.answered(branches, LastChance::None(NoEvasion::NoInputs));
        };
        let before = branches.ticks;
        branches.begin(&frame)?;
        branches.input(input.clone());
        let is_free = (tick..=until).all(|_| !branches.step().1.in_contact);
        let ticks = branches.ticks - before;
        self.count(ticks);
        let extent = SearchExtent { earliest: tick, branches: extent.branches + 1, ticks: extent.ticks + ticks };
        if !is_free {
            self.phase = Phase::Stay(branches, extent);
            return Ok(None);
        }
        let script = self.script(&branches.episode, tick, [(tick, input)]);
        let means = EvasionMeans::Standing;
        let evasion =
            Evasion { tick, free_until: until, means, script, extent, is_still_met: false, is_in_the_way: false };
        self.confirm(branches, evasion, Confirmed::Surely)
    }

    fn begin_round(&mut self, branches: Box<Branches>) -> Result<Option<Explanation>, AvoidError> {
        let mut ticks = branches.ticks_back(self.set.back);
        ticks.truncate(ROUND_TRIES);
        let tries = RoundTries { ticks, extent: SearchExtent::default(), why: NoEvasion::NoInputs };
        self.phase = Phase::Round(branches, tries);
        Ok(None)
    }

    /// Plans a way round from the next tick before.
    fn round(&mut self, mut branches: Box<Branches>, mut tries: RoundTries) -> Result<Option<Explanation>, AvoidError> {
        let Some(tick) = tries.ticks.pop_front() else {
            return self.answered(branches, LastChance::None(tries.why));
        };
        tries.extent = SearchExtent { earliest: tick, branches: tries.extent.branches + 1, ..tries.extent };
        match round_from(&mut branches, tick, self.recipe.seed)? {
            Ok((inputs, means, arrives)) => {
                let script = self.script(&branches.episode, tick, inputs);
                let free_until = std::cmp::max(arrives, branches.episode.first) + self.set.horizon;
                let extent = tries.extent;
                let evasion =
                    Evasion { tick, free_until, means, script, extent, is_still_met: false, is_in_the_way: false };
                self.confirm(branches, evasion, Confirmed::Else(tries))
            }
            // no earlier tick changes these
            Err(why @ (NoEvasion::EndsInContact | NoEvasion::Company(_))) => {
                self.answered(branches, LastChance::None(why))
            }
            Err(why) => {
                self.phase = Phase::Round(branches, RoundTries { why, ..tries });
                Ok(None)
            }
        }
    }

    /// Begins to simulate a way out in the whole run.
    fn confirm(
        &mut self,
        branches: Box<Branches>,
        evasion: Evasion,
        then: Confirmed,
    ) -> Result<Option<Explanation>, AvoidError> {
        let recipe = without_sensors(&Recipe { script: evasion.script.clone(), ..self.recipe.clone() });
        let run = recorder(&recipe, self.add.as_ref())?.without_keyframes();
        let meanwhile = evasion.tick..=evasion.free_until;
        let changes = self.recipe.script.changes.iter().any(|change| meanwhile.contains(&change.tick));
        let as_it_was = changes.then(|| recorder(&without_sensors(&self.recipe), self.add.as_ref())).transpose()?;
        let as_it_was = as_it_was.map(Recorder::without_keyframes);
        let at = Confirmation { branches: *branches, run, as_it_was, evasion };
        self.phase = Phase::Confirm(Box::new(at), then);
        Ok(None)
    }

    fn unconfirmed(
        &mut self,
        branches: Box<Branches>,
        evasion: Evasion,
        then: Confirmed,
    ) -> Result<Option<Explanation>, AvoidError> {
        match then {
            Confirmed::Surely => {
                Err(AvoidError::Unconfirmed { robot: branches.episode.robot.clone(), tick: evasion.tick })
            }
            Confirmed::Else(tries) => {
                let why = NoEvasion::NoPath("the world changes while the path is played".into());
                self.phase = Phase::Round(branches, RoundTries { why, ..tries });
                Ok(None)
            }
        }
    }

    /// The run's script with other inputs of the robot from a tick on.
    fn script(
        &self,
        episode: &ContactEpisode,
        from: u64,
        inputs: impl IntoIterator<Item = (u64, RobotInput)>,
    ) -> Script {
        let Script { events, changes, .. } = &self.recipe.script;
        let mut events: Vec<Event> =
            events.iter().filter(|event| event.robot != episode.robot || event.tick < from).cloned().collect();
        let event = |(tick, input)| Event { tick, robot: episode.robot.clone(), input };
        events.extend(inputs.into_iter().map(event));
        events.sort_by_key(|event| event.tick);
        Script::new(events, changes.clone())
    }
}

/// The input that tells an arm to go to these coordinates.
fn move_to(coordinates: &[f64]) -> Option<RobotInput> {
    coordinates.iter().map(|x| Quantized::try_new(*x)).collect::<Option<_>>().map(RobotInput::MoveTo)
}
