//! YAML as a tree.

mod builder;
mod node;

pub(crate) use builder::read;
pub(crate) use node::{Fields, YamlNode, YamlValue};
