//! The events of a run as log messages: contacts, takeovers, refusals.

use crate::simulation::RobotView;

use super::message::{LogMessage, Timestamp, level};

/// The messages about a tick. `before` are the robots after the previous tick, `now` those after this one.
pub fn news(tick: u64, before: &[RobotView], now: &[RobotView]) -> Vec<LogMessage> {
    let mut messages = Vec::new();
    for (before, now) in before.iter().zip(now) {
        let mut tell = |level, message| messages.push(message_of(tick, level, &now.name, message));
        if now.contacts > before.contacts {
            tell(level::WARNING, format!("contact {}", now.contacts));
        }
        if now.refusals > before.refusals {
            tell(level::WARNING, format!("an input was refused, {} so far", now.refusals));
        }
        match (before.manual, now.manual) {
            (false, true) => tell(level::INFO, "taken over from its tour".to_owned()),
            (true, false) => tell(level::INFO, "back on its tour".to_owned()),
            _ => {}
        }
    }
    messages
}

/// A message about `name`.
pub fn message_of(tick: u64, level: i32, name: &str, message: String) -> LogMessage {
    LogMessage { timestamp: Some(Timestamp::of_tick(tick)), level, message, name: name.to_owned() }
}
