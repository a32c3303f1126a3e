//! `Role`, what a thing stands for, and `Palette`, the colours a medium gives to roles.

/// What a drawn thing stands for. Its colour follows from this and from nothing else.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// The sheet itself, and marks left blank in a filled shape.
    Paper,
    /// A robot that touches nothing.
    Robot,
    /// Walls and solid obstacles.
    Obstacle,
    /// A goal. Contact has the same role: a collision is where a plan ends.
    Goal,
    /// The way a robot went or will go.
    Path,
    /// What a sensor sees.
    Sensor,
    /// Nearest points and the distance between them.
    Witness,
    /// Space proven free.
    Free,
    /// Space of which nothing is known.
    Unknown,
    /// Anything armed, selected or focused.
    Focus,
    /// Words.
    Text,
    /// Secondary words and marks.
    Muted,
    /// The frames of panes. Decoration only: it carries no meaning, so it may be faint.
    Hairline,
}

impl Role {
    /// Every role, in the order of their declaration.
    pub const ALL: [Role; 13] = [
        Role::Paper,
        Role::Robot,
        Role::Obstacle,
        Role::Goal,
        Role::Path,
        Role::Sensor,
        Role::Witness,
        Role::Free,
        Role::Unknown,
        Role::Focus,
        Role::Text,
        Role::Muted,
        Role::Hairline,
    ];

    /// The role's name: the class of its items in an SVG file.
    pub const fn name(self) -> &'static str {
        match self {
            Role::Paper => "paper",
            Role::Robot => "robot",
            Role::Obstacle => "obstacle",
            Role::Goal => "goal",
            Role::Path => "path",
            Role::Sensor => "sensor",
            Role::Witness => "witness",
            Role::Free => "free",
            Role::Unknown => "unknown",
            Role::Focus => "focus",
            Role::Text => "text",
            Role::Muted => "muted",
            Role::Hairline => "hairline",
        }
    }
}

/// An sRGB colour, 8 bits a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rgb(pub [u8; 3]);

impl std::fmt::Display for Rgb {
    /// As SVG and CSS write it: `#` and six hexadecimal digits.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [r, g, b] = self.0;
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
}

/// The colour of every role.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Palette {
    colours: [Rgb; Role::ALL.len()],
}

impl Palette {
    /// Creates a palette from the colours of all roles, in the order of `Role::ALL`.
    pub const fn new(colours: [Rgb; Role::ALL.len()]) -> Self {
        Palette { colours }
    }

    /// The colour of a role.
    pub const fn colour(&self, role: Role) -> Rgb {
        self.colours[role as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roles_are_listed_in_order_and_named_apart() {
        let mut names: Vec<&str> = Role::ALL.iter().map(|r| r.name()).collect();
        for (i, role) in Role::ALL.iter().enumerate() {
            assert_eq!(*role as usize, i, "a palette is indexed by the role");
        }
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), Role::ALL.len());
    }
}
