//! `CaptureState`, what the capture form remembers, and `CaptureOrder`, what it asks for.

use crate::capture::{Form, Span};

/// The forms to choose from: a page has the vector picture only, whose fonts and pixels the browser makes.
pub(super) const FORMS: &[Form] = if cfg!(target_family = "wasm") { &[Form::Svg] } else { &Form::ALL };

/// What is to be captured of the widget in front.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CaptureOrder {
    /// The form of the file.
    pub form: Form,
    /// The sheet's greatest width, pixels.
    pub width: u32,
    /// Dots for each pixel of the sheet.
    pub scale: u32,
    /// The ticks of a GIF.
    pub span: Span,
}

/// What the capture form remembers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CaptureState {
    /// Whether it is open.
    pub open: bool,
    /// What it asks for.
    pub order: CaptureOrder,
}

impl Default for CaptureState {
    fn default() -> Self {
        let order = CaptureOrder { form: FORMS[0], width: 1280, scale: 2, span: Span { from: 0, to: 0, every: 4 } };
        CaptureState { open: false, order }
    }
}
