//! The command line that goes on with what is left of a run.

use std::path::Path;
use std::str::FromStr;

use motion_lab::shrink::{Condition, ConditionError};

use super::ShrinkArgs;

/// A condition as it was written.
#[derive(Clone, Debug)]
pub struct WrittenCondition {
    text: String,
    pub condition: Condition,
}

impl FromStr for WrittenCondition {
    type Err = ConditionError;

    fn from_str(text: &str) -> Result<Self, ConditionError> {
        Ok(WrittenCondition { text: text.to_owned(), condition: Condition::parse(text)? })
    }
}

impl ShrinkArgs {
    /// The command line, for `sh`, that shrinks the run in `left` further, by the same condition and command.
    pub(super) fn again(&self, left: &Path) -> String {
        let left = left.display().to_string();
        // a name that begins as options do is none behind its folder
        let left = if left.starts_with('-') { format!("./{left}") } else { left };
        let mut line = format!("motion-lab shrink {}", quoted(&left));
        let mut option = |name: &str, value: &str| {
            let joint = if value.starts_with('-') { "=" } else { " " };
            line.push_str(&format!(" {name}{joint}{}", quoted(value)));
        };
        if let Some(condition) = &self.condition {
            option("--while", &condition.text);
        }
        if let Some(command) = &self.exec {
            option("--exec", command);
        }
        if let Some(code) = self.exit {
            option("--exit", &code.to_string());
        }
        if self.keep_worlds {
            line.push_str(" --keep-worlds");
        }
        line
    }
}

/// A text as one word of a shell's command.
pub fn quoted(text: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "/._-".contains(c);
    let is_word = !text.is_empty() && text.chars().all(is_plain);
    if is_word { text.to_owned() } else { format!("'{}'", text.replace('\'', r"'\''")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_stays_one_word() {
        assert_eq!(quoted("/tmp/a-b/c_1.mcap"), "/tmp/a-b/c_1.mcap");
        assert_eq!(quoted("/tmp/o'clock; x/c.mcap"), r"'/tmp/o'\''clock; x/c.mcap'");
        assert_eq!(quoted(""), "''");
    }
}
