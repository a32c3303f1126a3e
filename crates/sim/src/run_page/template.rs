//! `PageTemplate`, a page without its run.

use std::iter::zip;
use std::ops::Range;

use base64::prelude::{BASE64_STANDARD, Engine};

use super::gzip::gzip;
use super::{PageValue, RunPageError, TemplateError, simulator_print};
use crate::capture::RunFigure;
use crate::recording::Recorder;
use crate::run::{Digest, LogKind, LogWriter, Recipe};
use motion_lab_core::one_line::quoted;
use motion_lab_core::picture::Theme;

/// The first bytes of a WebAssembly module.
const MODULE: &[u8] = b"\0asm";

/// The first letters of what is in gzip's form and base64.
const PACKED: &str = "H4sI";

/// Everything of a page but its run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PageTemplate {
    text: String,
    /// Where the values are in the text, in the order of [`PageValue::ALL`].
    places: [Range<usize>; PageValue::ALL.len()],
    /// The simulator as the page holds it.
    simulator: String,
}

/// A run as its page holds it.
struct RunInPage {
    digest: Digest,
    /// On light and on dark paper.
    figures: [String; 2],
    log: Vec<u8>,
}

impl PageTemplate {
    /// Reads a template: a page that holds a run, or a page's text with the bytes of the simulator's module behind it.
    ///
    /// # Errors
    /// [`TemplateError`] for anything else.
    pub fn read(file: &[u8]) -> Result<Self, TemplateError> {
        // a text has no byte 0
        let end = file.windows(MODULE.len()).position(|bytes| bytes == MODULE);
        let (text, module) = file.split_at(end.unwrap_or(file.len()));
        let text = std::str::from_utf8(text).map_err(|error| TemplateError::NotText(error.valid_up_to()))?;
        PageTemplate::of(text.to_owned(), module)
    }

    /// The template of this text with this module; of a page that holds a run, without one.
    ///
    /// # Errors
    /// [`TemplateError`] when a value has not its one place in the text, or there is no simulator.
    pub fn of(text: String, module: &[u8]) -> Result<Self, TemplateError> {
        let mut places = [const { 0..0 }; PageValue::ALL.len()];
        let mut after = 0;
        for (place, value) in zip(&mut places, PageValue::ALL) {
            *place = place_of(value, &text, after)?;
            after = place.end;
        }
        let [.., held, _] = &places;
        let simulator = match &text[held.clone()] {
            _ if module.starts_with(MODULE) => BASE64_STANDARD.encode(gzip(module)),
            packed if packed.starts_with(PACKED) => packed.to_owned(),
            _ => return Err(TemplateError::NoSimulator),
        };
        Ok(PageTemplate { text, places, simulator })
    }

    /// Which simulator it holds, as it says itself: see [`simulator_print()`].
    pub fn print(&self) -> &str {
        &self.text[self.places[0].clone()]
    }

    /// Refuses a template with another simulator than this program's.
    ///
    /// # Errors
    /// [`TemplateError::OtherSimulator`].
    pub fn check_simulator(&self) -> Result<(), TemplateError> {
        let (found, own) = (self.print(), simulator_print()?);
        if found == own { Ok(()) } else { Err(TemplateError::OtherSimulator { found: quoted(found), own }) }
    }

    /// The page of a run, which is simulated for it. Calls `on_tick` with the run at every tick from 0 on.
    ///
    /// # Errors
    /// [`RunPageError`] when the run can't be simulated or logged.
    pub fn page(&self, recipe: &Recipe, on_tick: impl FnMut(&Recorder)) -> Result<String, RunPageError> {
        let RunInPage { digest, figures, log } = RunInPage::of(recipe, on_tick)?;
        let [light, dark] = figures.map(|figure| BASE64_STANDARD.encode(figure));
        let log = BASE64_STANDARD.encode(gzip(&log));
        let [seed, ticks, digest] = [recipe.seed.to_string(), recipe.config.ticks.to_string(), digest.to_string()];
        let values = [self.print(), &seed, &ticks, &digest, &dark, &light, &self.simulator, &log];
        let length = self.text.len() + values.map(str::len).iter().sum::<usize>();
        let (mut page, mut after) = (String::with_capacity(length), 0);
        for (place, value) in zip(&self.places, values) {
            page.push_str(&self.text[after..place.start]);
            page.push_str(value);
            after = place.end;
        }
        page.push_str(&self.text[after..]);
        Ok(page)
    }
}

/// Where the text holds a value: its only place, behind `after`.
fn place_of(value: PageValue, text: &str, after: usize) -> Result<Range<usize>, TemplateError> {
    let mut found = text.match_indices(value.before());
    let begin = found.next().map(|(at, before)| at + before.len()).filter(|begin| *begin > after);
    if found.next().is_some() {
        return Err(TemplateError::Twice(value));
    }
    let begin = begin.ok_or(TemplateError::Missing(value))?;
    let length = text[begin..].find(value.end()).ok_or(TemplateError::Missing(value))?;
    Ok(begin..begin + length)
}

impl RunInPage {
    fn of(recipe: &Recipe, mut on_tick: impl FnMut(&Recorder)) -> Result<Self, RunPageError> {
        let mut run = Recorder::of(recipe)?.without_keyframes();
        let mut writer = LogWriter::new(Vec::new(), recipe, LogKind::Digests, run.frame())?;
        let mut figure = RunFigure::default();
        figure.watch(run.view());
        on_tick(&run);
        let ticks = recipe.config.ticks;
        for _ in 0..ticks {
            writer.tick(run.step())?;
            figure.watch(run.view());
            on_tick(&run);
        }
        let digest = writer.digest();
        let figures = [Theme::Light, Theme::Dark].map(|theme| figure.svg(recipe, ticks, digest, theme));
        Ok(RunInPage { digest, figures, log: writer.finish()? })
    }
}
