//! `PageValue`, what a page holds of its simulator and its run.

/// A value of a page. Each stands once in the page, between two texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PageValue {
    /// Which simulator the page holds: [`simulator_print`](super::simulator_print()).
    Print,
    /// The run's seed.
    Seed,
    /// The run's length, ticks.
    Ticks,
    /// The run's digest.
    Digest,
    /// The run's figure on dark paper, SVG in base64.
    DarkFigure,
    /// The same on light paper.
    LightFigure,
    /// The simulator, WebAssembly in gzip's form and base64.
    Simulator,
    /// The run's log with a digest of each second, in the same form.
    Log,
}

impl PageValue {
    /// All of them, in the order of the page.
    pub const ALL: [PageValue; 8] = [
        PageValue::Print,
        PageValue::Seed,
        PageValue::Ticks,
        PageValue::Digest,
        PageValue::DarkFigure,
        PageValue::LightFigure,
        PageValue::Simulator,
        PageValue::Log,
    ];

    /// What stands before it.
    pub const fn before(self) -> &'static str {
        match self {
            PageValue::Print => "data-simulator=\"",
            PageValue::Seed => "<span id=\"seed\">",
            PageValue::Ticks => "<span id=\"ticks\">",
            PageValue::Digest => "Its digest was ",
            PageValue::DarkFigure => " srcset=\"data:image/svg+xml;base64,",
            PageValue::LightFigure => " src=\"data:image/svg+xml;base64,",
            PageValue::Simulator => "<script type=\"text/plain\" id=\"wasm\">",
            PageValue::Log => "<script type=\"text/plain\" id=\"bytes\">",
        }
    }

    /// The sign at which it ends.
    pub const fn end(self) -> char {
        match self {
            PageValue::Print | PageValue::DarkFigure | PageValue::LightFigure => '"',
            PageValue::Digest => '.',
            PageValue::Seed | PageValue::Ticks | PageValue::Simulator | PageValue::Log => '<',
        }
    }

    /// Its name in messages.
    pub const fn name(self) -> &'static str {
        match self {
            PageValue::Print => "the simulator's print",
            PageValue::Seed => "the run's seed",
            PageValue::Ticks => "the run's length",
            PageValue::Digest => "the run's digest",
            PageValue::DarkFigure => "the figure on dark paper",
            PageValue::LightFigure => "the figure on light paper",
            PageValue::Simulator => "the simulator",
            PageValue::Log => "the run's log",
        }
    }
}
