//! `WidgetText`, the words around a widget, read from the manifest `assets/widgets.ron`.

mod formula;
mod hint_task;
mod lesson;
mod text;
mod theme_choice;
mod widget;

pub use formula::{ChapterFormula, Formula, Level, Term};
pub use hint_task::HintTask;
pub use lesson::Lesson;
pub use text::{Hint, KeyText, WidgetText};
pub use theme_choice::ThemeChoice;
pub use widget::Widget;
