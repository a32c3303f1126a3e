//! `NumberField`, a number field of the editor, and what is typed into it or dragged in it.

/// A number field of the editor. It belongs to its thing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct NumberField {
    /// The name of the thing; `None` for the world.
    pub thing: Option<String>,
    /// Which of its numbers, from 0.
    pub number: usize,
}

/// Text in a field that is not yet entered.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TypedText {
    /// The field.
    pub field: NumberField,
    /// The text.
    pub text: String,
    /// The number that the field had meanwhile. Once it has another, the text counts no more.
    pub was: f64,
}
