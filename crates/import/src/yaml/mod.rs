//! YAML as a tree.

mod builder;
mod node;

pub(crate) use builder::{read, read_as_python};
pub(crate) use node::{Fields, YamlNode, YamlValue};
