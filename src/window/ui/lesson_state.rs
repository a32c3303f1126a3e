//! `LessonState`, the lesson under way.

use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_sim::manifest::{HintTask, Lesson};

/// The lesson under way.
#[derive(Clone, Debug, PartialEq)]
pub struct LessonState {
    /// Which one it is.
    pub lesson: Lesson,
    /// Where Query's robot, which is the configuration space's too, stands when it begins; `None` for its usual place.
    pub start: Option<AnyConfiguration>,
    /// The seconds that it took, once it has been done.
    pub took: Option<f64>,
    /// What was learnt, once it has been done.
    pub learnt: String,
    /// The clock at its first frame, seconds.
    began: Option<f64>,
    /// Whether its widget has been made ready.
    pub is_ready: bool,
    /// Whether the frame before showed it done. What is so from the start is not the reader's doing.
    was_done: bool,
}

impl LessonState {
    /// The lesson at its beginning.
    pub fn begun(lesson: Lesson) -> Self {
        LessonState {
            lesson,
            start: None,
            took: None,
            learnt: String::new(),
            began: None,
            is_ready: false,
            was_done: true,
        }
    }

    /// Takes in what was done in a frame, by `now` in seconds. Returns whether that ended it.
    pub fn see(&mut self, done: &[HintTask], now: f64) -> bool {
        let began = *self.began.get_or_insert(now);
        let is_done = done.contains(&self.lesson.task);
        let ends = is_done && !self.was_done && self.took.is_none();
        if ends {
            self.took = Some(now - began);
        }
        self.was_done = is_done;
        ends
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lesson_is_done_by_what_comes_after_its_beginning_and_once() {
        let mut under_way = LessonState::begun(Lesson::of("near").unwrap());
        under_way.see(&[HintTask::Near], 10.0);
        assert_eq!(under_way.took, None, "it was so from the start");
        under_way.see(&[HintTask::Touch], 12.0);
        assert_eq!(under_way.took, None, "another task");
        assert!(under_way.see(&[HintTask::Touch, HintTask::Near], 17.5), "it ends");
        assert_eq!(under_way.took, Some(7.5));
        under_way.see(&[], 20.0);
        assert!(!under_way.see(&[HintTask::Near], 30.0), "once");
        assert_eq!(under_way.took, Some(7.5), "the first time counts");
    }
}
