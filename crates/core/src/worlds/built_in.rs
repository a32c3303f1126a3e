//! The three worlds of the book, built into the program.

use std::sync::LazyLock;

use super::World;
use crate::names::{hint, nearest};

/// Reads a world that is part of this program.
#[expect(clippy::panic, reason = "the text is a constant of the program, and a test reads each of the three")]
fn read(file: &str, text: &str) -> World {
    match World::parse(file, text) {
        Ok(world) => world,
        Err(error) => panic!("{error}"),
    }
}

static APARTMENT: LazyLock<World> = LazyLock::new(|| read("apartment.ron", include_str!("../../worlds/apartment.ron")));
static WORKBENCH: LazyLock<World> = LazyLock::new(|| read("workbench.ron", include_str!("../../worlds/workbench.ron")));
static LOT: LazyLock<World> = LazyLock::new(|| read("lot.ron", include_str!("../../worlds/lot.ron")));

impl World {
    /// The Apartment, 12 x 8 m: five rooms off a corridor, rooms A and C mirror images of each other. Rusty lives here.
    pub fn apartment() -> World {
        APARTMENT.clone()
    }

    /// The Workbench, the square [-2.4, 2.4]^2 with the block, the post and the shelf. Reach lives here.
    pub fn workbench() -> World {
        WORKBENCH.clone()
    }

    /// The Lot, 16 x 10 m, with curbs, four bays and two pillars. Hitch lives here.
    pub fn lot() -> World {
        LOT.clone()
    }

    /// The names that [`built_in`](Self::built_in) knows.
    pub fn built_in_names() -> [&'static str; 3] {
        ["apartment", "workbench", "lot"]
    }

    /// The name under which a world in all the same is built in; `None` if there is none.
    pub fn built_in_name(&self) -> Option<&'static str> {
        Self::built_in_names().into_iter().find(|name| Self::built_in(name).as_ref() == Some(self))
    }

    /// The built-in world of this name, `None` when there is none.
    pub fn built_in(name: &str) -> Option<World> {
        match name {
            "apartment" => Some(Self::apartment()),
            "workbench" => Some(Self::workbench()),
            "lot" => Some(Self::lot()),
            _ => None,
        }
    }

    /// The built-in world of this name.
    ///
    /// # Errors
    /// [`UnknownWorld`] when there is none; it names the one that was meant, if one is near.
    pub fn named(name: &str) -> Result<World, UnknownWorld> {
        Self::built_in(name).ok_or_else(|| UnknownWorld { name: name.to_owned() })
    }
}

/// There is no built-in world of this name.
///
/// Prints as `no built-in world is named "apartmnt"; did you mean "apartment"?`
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no built-in world is named {name:?}{}", self.instead())]
pub struct UnknownWorld {
    /// The name.
    pub name: String,
}

impl UnknownWorld {
    /// The built-in world that was meant; `None` if none is near.
    pub fn meant(&self) -> Option<&'static str> {
        nearest(&self.name, World::built_in_names())
    }

    fn instead(&self) -> String {
        match self.meant() {
            None => format!("; there are {}", World::built_in_names().join(", ")),
            meant => hint(meant),
        }
    }
}
