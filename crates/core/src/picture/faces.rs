//! The typefaces of the screen and of pictures.

/// The lab's typefaces by name: for words, for figures and code, and for signs that both lack. They are TrueType;
/// `assets/fonts/build` makes them.
pub const FACES: [(&str, &[u8]); 3] = [
    ("lab-sans", include_bytes!("../../assets/fonts/lab-sans.ttf")),
    ("lab-mono", include_bytes!("../../assets/fonts/lab-mono.ttf")),
    ("lab-signs", include_bytes!("../../assets/fonts/lab-signs.ttf")),
];
