//! `WidgetText`, the words around a widget, read from the manifest `assets/widgets.ron`.

mod deed;
mod formula;
mod lesson;
mod text;
mod theme_choice;
mod widget;

pub use deed::Deed;
pub use formula::{Formula, Level, Term, Told};
pub use lesson::Lesson;
pub use text::{Hint, KeyText, WidgetText};
pub use theme_choice::ThemeChoice;
pub use widget::Widget;
