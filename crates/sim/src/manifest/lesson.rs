//! `Lesson`, a hint by itself, for which a link or a page asks.

use super::{Hint, HintTask, Widget};
use crate::anatomy::{Anatomy, Tab};
use motion_lab_core::configuration::AnyConfiguration;

/// The step in the first coordinate with which a lesson about motions begins: from where they begin, it is free.
const FREE_STEP: f64 = 0.2;

/// A hint by itself, for which a link or a page asks by its id.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lesson {
    /// What it asks for.
    pub task: HintTask,
    /// The widget that it is about.
    pub widget: Widget,
}

impl Lesson {
    /// All lessons, widget by widget: each hint is one.
    pub fn all() -> impl Iterator<Item = Lesson> {
        let of = |widget: Widget| widget.text().hints.iter().map(move |hint| Lesson { task: hint.task, widget });
        Widget::ALL.into_iter().flat_map(of)
    }

    /// The lesson with this [`id`](Self::id).
    pub fn of(id: &str) -> Option<Lesson> {
        Lesson::all().find(|lesson| lesson.id() == id)
    }

    /// Its id in links and messages, such as `two_elbows`.
    pub fn id(self) -> String {
        let mut id = String::new();
        for letter in self.task.id().chars() {
            if letter.is_ascii_uppercase() && !id.is_empty() {
                id.push('_');
            }
            id.push(letter.to_ascii_lowercase());
        }
        id
    }

    /// Its words.
    pub fn text(self) -> &'static str {
        self.hint().map_or("", |hint| &hint.text)
    }

    /// What it teaches, in one sentence, for its end.
    pub fn learnt(self) -> &'static str {
        self.hint().map_or("", |hint| &hint.learnt)
    }

    /// The lesson that follows it; `None` after the last.
    pub fn next(self) -> Option<Lesson> {
        Lesson::all().skip_while(|lesson| *lesson != self).nth(1)
    }

    /// The scene in which a lesson of Query or the configuration space begins: its question, nothing of it done yet,
    /// and the robot at `start` where that is a configuration of it.
    pub fn scene(self, start: Option<AnyConfiguration>) -> Anatomy {
        let tab = match self.task {
            _ if self.widget != Widget::Anatomy => Tab::default(),
            HintTask::Near => Tab::Witness,
            HintTask::Hit | HintTask::FreeEnds => Tab::Swept,
            _ => Tab::Distance,
        };
        let mut scene = Anatomy::default().with_tab(tab);
        scene.show_annulus = self.task == HintTask::TwoPoints;
        if matches!(self.task, HintTask::Hit | HintTask::FreeEnds) {
            // a motion that is free: what hits is to be found
            scene.set_step(0, FREE_STEP);
        }
        if let Some(q) = start {
            // another robot's is none of this one's
            _ = scene.set_q(q);
        }
        scene
    }

    fn hint(self) -> Option<&'static Hint> {
        self.widget.text().hints.iter().find(|hint| hint.task == self.task)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_lesson_but_the_last_is_followed_by_the_next() {
        let mut lesson = Lesson::all().next().unwrap();
        let mut ids = vec![lesson.id()];
        while let Some(next) = lesson.next() {
            lesson = next;
            ids.push(lesson.id());
        }
        assert_eq!(ids, Lesson::all().map(Lesson::id).collect::<Vec<_>>());
        assert_eq!(Lesson::of("reset").unwrap().next(), Lesson::of("touch"), "on to the next widget");
    }

    #[test]
    fn what_is_to_hit_begins_with_a_motion_that_is_free() {
        use motion_lab_core::collision::EdgeVerdict;
        use motion_lab_core::configuration::T2;

        // where Query begins, and where the book's figure does
        for start in [None, Some(AnyConfiguration::T2(T2::new(2.0, 0.0)))] {
            for id in ["hit", "free_ends"] {
                let scene = Lesson::of(id).unwrap().scene(start);
                let verdict = scene.sweep().unwrap().verdict;
                assert!(matches!(verdict, EdgeVerdict::Free { .. }), "{id}: {verdict:?}");
                assert!(scene.step()[0] > 0.0, "it goes somewhere");
            }
        }
    }

    #[test]
    fn each_hint_is_a_lesson_with_an_id_of_its_own() {
        let ids: Vec<String> = Lesson::all().map(Lesson::id).collect();
        for (id, task, widget) in [
            ("two_elbows", HintTask::TwoElbows, Widget::Dashboard),
            ("near", HintTask::Near, Widget::Anatomy),
            ("free_ends", HintTask::FreeEnds, Widget::Anatomy),
            ("over_edge", HintTask::OverEdge, Widget::Cspace),
            ("pick_wall", HintTask::PickWall, Widget::Atlas),
            ("find_path", HintTask::FindPath, Widget::Plan),
        ] {
            assert_eq!(Lesson::of(id), Some(Lesson { task, widget }));
            assert_eq!(ids.iter().filter(|other| *other == id).count(), 1, "{id}");
        }
        assert_eq!((Lesson::of("TwoElbows"), Lesson::of("")), (None, None));
        assert!(Lesson::all().all(|lesson| Lesson::of(&lesson.id()) == Some(lesson) && !lesson.text().is_empty()));
        assert!(Lesson::of("over_edge").is_some_and(|lesson| lesson.text().starts_with("Off the edge of the map")));
    }
}
