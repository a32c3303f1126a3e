//! Writes a grid as a ROS map.

use std::fmt::Write;

use crate::worlds::Grid;

/// A ROS map: the two files that map_server reads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RosFiles {
    /// The yaml file's text.
    pub yaml: String,
    /// The image's bytes: a PGM of the form P5, occupied cells black, free ones white.
    pub image: Vec<u8>,
}

impl Grid {
    /// The grid as a ROS map whose yaml names its image `image_name`. Reading it gives this grid, to the bit.
    pub fn ros_map(&self, image_name: &str) -> RosFiles {
        let (columns, rows) = (self.columns(), self.rows());
        let mut image = format!("P5\n{columns} {rows}\n255\n").into_bytes();
        for row in (0..rows).rev() {
            image.extend((0..columns).map(|column| if self.is_occupied(column, row) { 0 } else { 254 }));
        }
        let (resolution, origin) = (self.resolution(), self.origin);
        let yaml = format!(
            "image: {}\nmode: trinary\nresolution: {resolution:?}\norigin: [{:?}, {:?}, 0.0]\nnegate: 0\n\
             occupied_thresh: 0.65\nfree_thresh: 0.196\n",
            quoted(image_name),
            origin.x,
            origin.y
        );
        RosFiles { yaml, image }
    }
}

/// A text in YAML's double quotes.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            // writing to a String never fails
            c if c.is_control() => _ = write!(out, "\\x{:02x}", u32::from(c)),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
