//! `PaperArgs`, what pictures are drawn on, and how they are written.

use motion_lab_core::picture::Theme;
use std::path::Path;

use crate::capture::{self, CaptureError, CaptureForm, Captured, Paper};
use clap::Args;

use super::choices;
use super::target::Target;
use crate::cli::Failure;

/// The sheet of a picture.
#[derive(Debug, Args)]
pub struct PaperArgs {
    /// Pictures: the paper's colours.
    #[arg(long, value_parser = choices::theme(), default_value = "light")]
    theme: Theme,
    /// Pictures: the sheet's greatest width, pixels: 420 to 640 for a column, 1280 for a page. Letters keep their size.
    #[arg(long, value_name = "PIXELS", default_value_t = 1280, value_parser = clap::value_parser!(u32).range(200..=4096))]
    width: u32,
    /// PNG and GIF: dots for each pixel of the sheet; 2 or 3 for print.
    #[arg(long, value_name = "TIMES", default_value_t = 1.0, value_parser = parse_scale)]
    scale: f32,
}

impl PaperArgs {
    /// The paper.
    pub fn paper(&self) -> Paper {
        Paper { palette: self.theme.palette(), width: self.width, scale: self.scale }
    }
}

fn parse_scale(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(scale) if (0.1..=8.0).contains(&scale) => Ok(scale),
        _ => Err("it must be a number from 0.1 to 8".into()),
    }
}

/// Writes a picture to its target.
pub fn write_picture(captured: &Captured, paper: &Paper, form: CaptureForm, target: &Target) -> Result<(), Failure> {
    let path = target.path();
    capture::write(captured, paper, form, path).map_err(|error| not_written(path, error))
}

/// The failure of a picture that was to be written to `path`.
pub fn not_written(path: &Path, error: CaptureError) -> Failure {
    match error {
        CaptureError::Write(error) => Failure::output(path, &error),
        CaptureError::Fault(reason) => Failure::internal(anyhow::anyhow!(reason)),
        error => Failure::usage(error, "Choose a smaller --width or --scale."),
    }
}
