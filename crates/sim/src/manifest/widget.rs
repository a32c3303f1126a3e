//! `Widget`, the widgets of the lab.

use super::text::{WidgetText, text_of};

/// A widget of the lab. The order is that of the rail.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Widget {
    /// The robots of a run, driven and plotted.
    #[default]
    Dashboard,
    /// One frozen scene and the four queries.
    Anatomy,
    /// The configuration space beside the workspace.
    Cspace,
    /// Worlds with their names, grids and the editor.
    Atlas,
    Plan,
}

impl Widget {
    /// All widgets, in the order of the rail.
    pub const ALL: [Widget; 5] = [Widget::Dashboard, Widget::Anatomy, Widget::Cspace, Widget::Atlas, Widget::Plan];

    /// The id by which links, pages, files and the command line name it.
    pub const fn id(self) -> &'static str {
        match self {
            Widget::Dashboard => "dashboard",
            Widget::Anatomy => "anatomy",
            Widget::Cspace => "cspace",
            Widget::Atlas => "atlas",
            Widget::Plan => "plan",
        }
    }

    /// The widget with this id.
    pub fn of(id: &str) -> Option<Widget> {
        Widget::ALL.into_iter().find(|widget| widget.id() == id)
    }

    /// Its words.
    pub fn text(self) -> &'static WidgetText {
        text_of(self.id())
    }
}
