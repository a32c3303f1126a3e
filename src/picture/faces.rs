//! The faces that letters are set in, on the screen and in pictures.

/// The faces of the lab by name: for words, for figures and code, and for signs that both lack. TrueType; `assets/fonts/build` makes
/// them.
pub const FACES: [(&str, &[u8]); 3] = [
    ("lab-sans", include_bytes!("../../assets/fonts/lab-sans.ttf")),
    ("lab-mono", include_bytes!("../../assets/fonts/lab-mono.ttf")),
    ("lab-signs", include_bytes!("../../assets/fonts/lab-signs.ttf")),
];
