//! What is written on a command line: conditions, and the words of a shell's command.

use std::str::FromStr;

use motion_lab_sim::shrink::{Condition, ConditionError};

/// A condition as it was written.
#[derive(Clone, Debug)]
pub struct WrittenCondition {
    pub text: String,
    pub condition: Condition,
}

impl FromStr for WrittenCondition {
    type Err = ConditionError;

    fn from_str(text: &str) -> Result<Self, ConditionError> {
        Ok(WrittenCondition { text: text.to_owned(), condition: Condition::parse(text)? })
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
