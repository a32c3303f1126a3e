//! Addresses of the page.
//!
//! A wrong reader takes a link that it writes otherwise, repeats a sentence of the link's maker as if the lab said it,
//! or lets endless work through.

use super::refusal;
use motion_lab::web::{Link, LinkError, MAX_LINK};

/// Longest refusal, characters.
const LONGEST: usize = 300;

/// Reads the query of an address.
pub fn check(data: &[u8]) -> bool {
    let Ok(query) = std::str::from_utf8(data) else { return false };
    let read = Link::read(query);
    for refused in [&read.run, &read.view].into_iter().filter_map(|part| part.as_ref().err()) {
        refusal::check(refused, "");
        assert!(refused.to_string().chars().count() <= LONGEST, "{refused}");
    }
    let parsed = Link::parse(query);
    assert_eq!(parsed.is_ok(), read.run.is_ok() && read.view.is_ok());
    let Ok(link) = parsed else { return false };
    match link.query() {
        Ok(again) => {
            assert!(again.len() <= MAX_LINK);
            // by their texts: the range of a sensor that no run may have can be no number
            assert_eq!(format!("{:?}", Link::parse(&again)), format!("{:?}", Ok::<_, LinkError>(&link)), "{again}");
            assert_eq!(Link::read(&format!("?{again}")).link.query().as_ref(), Ok(&again));
        }
        Err(error) => assert!(matches!(error, LinkError::TooLong(length) if length > MAX_LINK), "{error}"),
    }
    true
}
