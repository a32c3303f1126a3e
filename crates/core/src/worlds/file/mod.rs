//! World files: as written, checked, and printed.

pub(crate) mod comments;
pub(crate) mod description;
pub(crate) mod items;
pub(crate) mod name;
pub(crate) mod parse;
pub(crate) mod print;
pub(crate) mod resident;
pub(crate) mod ron_words;
mod route;
pub(crate) mod sizes;
pub(crate) mod source;
