//! `PageTemplate`, a page without its run.

use std::iter::zip;
use std::ops::Range;

use base64::prelude::{BASE64_STANDARD, Engine};

use super::gzip::gzip;
use super::{PageValue, TemplateError, simulator_print};
use motion_lab_core::one_line::quoted;

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

/// A run as its page holds it: in letters of base64, or numbers.
pub(super) struct RunInPage {
    pub(super) seed: String,
    pub(super) ticks: String,
    pub(super) digest: String,
    /// On light and on dark paper.
    pub(super) figures: [String; 2],
    pub(super) log: String,
}

impl PageTemplate {
    /// Largest size of a file that is read as one, bytes: 20 times the site's simulator.
    pub const MAX_BYTES: u64 = 64 << 20;

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

    /// The page that holds this run.
    pub(super) fn filled(&self, run: &RunInPage) -> String {
        let RunInPage { seed, ticks, digest, figures: [light, dark], log } = run;
        let values = [self.print(), seed, ticks, digest, dark, light, &self.simulator, log];
        let length = self.text.len() + values.map(str::len).iter().sum::<usize>();
        let (mut page, mut after) = (String::with_capacity(length), 0);
        for (place, value) in zip(&self.places, values) {
            page.push_str(&self.text[after..place.start]);
            page.push_str(value);
            after = place.end;
        }
        page.push_str(&self.text[after..]);
        page
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
