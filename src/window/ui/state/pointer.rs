//! `PointerState`, what is pointed at.

use motion_lab_core::picture::Role;
use motion_lab_sim::manifest::Widget;

/// What is pointed at, and what is lit for it.
#[derive(Clone, Debug, Default)]
pub struct PointerState {
    /// The role of what is pointed at in a picture, whose terms are underlined.
    pub over: Option<Role>,
    /// The role that is lit: all others fade.
    pub lit: Option<Role>,
    /// The role that the surrounding page asks to light, and in which widget. It counts only while nothing here is
    /// pointed at.
    pub page_lit: Option<(Widget, Role)>,
    /// The role that is pointed at in this frame.
    pub pointed: Option<Role>,
    /// Whether fingers touch the screen, or may: controls are as large as a fingertip.
    pub is_touched: bool,
}
