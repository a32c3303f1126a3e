//! `CaptureState`, the state of the capture form, and `CaptureOrder`, the capture that it orders.

use crate::capture::{Form, Span};

/// The file formats to choose from. On the web only the vector picture: the browser makes its fonts and pixels.
pub(super) const FORMS: &[Form] = if cfg!(target_family = "wasm") { &[Form::Svg] } else { &Form::ALL };

/// An order to capture the widget in front.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CaptureOrder {
    /// The file format.
    pub form: Form,
    /// Largest width of the sheet, pixels.
    pub width: u32,
    /// Dots for each pixel of the sheet.
    pub scale: u32,
    /// The ticks of a GIF.
    pub span: Span,
}

/// The state of the capture form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CaptureState {
    /// Whether it is open.
    pub open: bool,
    /// The order as chosen so far.
    pub order: CaptureOrder,
}

impl Default for CaptureState {
    fn default() -> Self {
        let order = CaptureOrder { form: FORMS[0], width: 1280, scale: 2, span: Span { from: 0, to: 0, every: 4 } };
        CaptureState { open: false, order }
    }
}
