//! `CaptureState`, the state of the capture form, and `CaptureOrder`, the capture that it orders.

use motion_lab_sim::capture::{CaptureForm, CaptureSpan};

/// The most pictures of a GIF in a page, whose memory holds them all.
#[cfg(target_family = "wasm")]
pub(crate) const MAX_PICTURES: u64 = 400;

/// An order to capture the widget in front.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CaptureOrder {
    /// The file format.
    pub form: CaptureForm,
    /// Largest width of the sheet, pixels.
    pub width: u32,
    /// Dots for each pixel of the sheet.
    pub scale: u32,
    /// The ticks of a GIF.
    pub span: CaptureSpan,
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
        let order = CaptureOrder {
            form: CaptureForm::ALL[0],
            width: 1280,
            scale: 2,
            span: CaptureSpan { from: 0, to: 0, every: 4 },
        };
        CaptureState { open: false, order }
    }
}
