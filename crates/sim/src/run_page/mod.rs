//! A run as one page: a file that any browser opens without a network, which simulates the run again and says whether
//! every second comes out the same.
//!
//! A [`PageTemplate`] is everything but the run: words, script, style, and the simulator as WebAssembly. The site's
//! build makes one, and every page that was written is one too. The program, the Python package and the lab's own page
//! write with this alone, so the same run gives the same bytes, on every machine. What a page holds of its run is
//! numbers and letters of base64 only, so that no name in a world or a script is read as markup. `Log::read_mcap` reads
//! the page.

mod error;
mod gzip;
mod page_value;
mod simulator_print;
mod template;
#[cfg(test)]
mod tests;
mod unfinished;

pub use error::{RunPageError, TemplateError};
pub use page_value::PageValue;
pub use simulator_print::simulator_print;
pub use template::PageTemplate;
pub use unfinished::UnfinishedPage;
