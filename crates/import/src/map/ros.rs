//! Reads the maps of ROS: map_server's yaml with an image.

use super::cells::grid_of;
use super::gray_image::GrayImage;
use super::image;
use crate::error::wrong_value;
use crate::yaml::{self, YamlNode};
use crate::{ImportError, OccupancyMap};
use motion_lab_core::geometry::{MAX_COORDINATE, Point2, Pose2};
use motion_lab_core::one_line::OneLine;

/// The head of a ROS map: its yaml file, read as Nav2's map_server reads it.
///
/// A pixel of shade `s` (0 black, 1 white, in 255 steps) is occupied to the degree `1 - s`, with `negate` to the degree
/// `s`. Up to `free_thresh` it is free, else from `occupied_thresh` on occupied. What lies between and what is
/// transparent is for the [`RosMode`] to say. Degrees are compared in single precision, as there. Thresholds not given
/// are 0.65 and 0.196, as in map_server of ROS 1.
#[derive(Clone, Debug, PartialEq)]
pub struct RosMap {
    /// The image file, as the yaml names it: relative to the yaml's own folder.
    pub image: String,
    /// The size of a pixel, metres.
    pub resolution: f64,
    /// The pose of the image's lower left corner in the world.
    pub origin: Pose2,
    /// Whether white is occupied.
    pub negate: bool,
    /// The least degree of an occupied pixel.
    pub occupied_thresh: f64,
    /// The greatest degree of a free pixel.
    pub free_thresh: f64,
    /// What the pixels mean that are neither free nor occupied.
    pub mode: RosMode,
    /// Notes for the reader: keys of the yaml that say nothing of the map.
    pub notes: Vec<String>,
}

/// How a ROS map's shades become costs from 0, free, to 100, occupied.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RosMode {
    /// A pixel is free, occupied or, between the thresholds, unknown.
    #[default]
    Trinary,
    /// Between the thresholds the cost grows from 0 to 100.
    Scale,
    /// The shade itself, from 0 to 255, is the cost; above 100 it is unknown. Thresholds and `negate` say nothing.
    Raw,
}

/// How a map's unknown cells are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unknown {
    /// As occupied: only cells known to be free are free. The file's own thresholds say what is unknown, with a note
    /// where they call the shade free that map_saver writes for unknown.
    #[default]
    ByThresholds,
    /// As occupied, and so are cells of the shade that map_saver writes for unknown, whatever the thresholds say.
    Occupied,
    /// As free.
    Free,
}

/// The cost from which on a cell is an obstacle, as in Nav2's static layer. Lower costs are free.
const OBSTACLE_COST: u8 = 100;

/// The shade that map_saver writes for unknown cells.
const SAVED_UNKNOWN: u8 = 205;

/// What was met while an image was read.
#[derive(Default)]
struct RosCounts {
    /// The unknown cells.
    unknown: u64,
    /// The cells that are free with a cost of 1 and more.
    costly: u64,
    /// The cells of the shade that map_saver writes for unknown, and that the thresholds call free.
    saved_unknown: u64,
}

/// Whether a yaml text looks like the head of a ROS map: it names an image.
pub fn is_ros_map(text: &str) -> bool {
    yaml::read(text).is_ok_and(|tree| tree.fields("").is_ok_and(|mut fields| fields.take("image").is_some()))
}

impl RosMap {
    /// Reads a map's yaml file. `file` is its name in errors. Numbers may stand in quotes, modes in capitals; `negate`
    /// is a number, 0 for no, or a word such as `false` and `no`. Other keys get a note each.
    ///
    /// # Errors
    /// [`ImportError`] names line and key: what is missing, malformed or out of range.
    ///
    /// ```
    /// use motion_lab_import::RosMap;
    /// let text = "image: yard.pgm\nresolution: 0.05\norigin: [-1, -2, 0]\nnegate: 0\noccupied_thresh: 1.65\n";
    /// let error = RosMap::parse("yard.yaml", text).unwrap_err();
    /// assert_eq!(error.to_string(), "yard.yaml:5: occupied_thresh: 1.65: it must be from 0 to 1");
    /// ```
    pub fn parse(file: &str, text: &str) -> Result<RosMap, ImportError> {
        Self::read(text).map_err(|error| error.of(file))
    }

    fn read(text: &str) -> Result<RosMap, ImportError> {
        let tree = yaml::read(text)?;
        let mut fields = tree.fields("")?;
        let image = fields.need("image")?.text("image")?.to_owned();
        let resolution = fields.need("resolution")?.number("resolution")?;
        let origin = fields.need("origin")?.numbers("origin", 3..=3, "three numbers: x, y, yaw")?;
        let mut degree = |key: &'static str, default: f64| {
            let Some(node) = fields.take(key) else { return Ok(default) };
            match node.number(key)? {
                degree if (0.0..=1.0).contains(&degree) => Ok(degree),
                _ => Err(node.wrong(key, "from 0 to 1")),
            }
        };
        let occupied_thresh = degree("occupied_thresh", 0.65)?;
        let free_thresh = degree("free_thresh", 0.196)?;
        if free_thresh > occupied_thresh {
            let problem = wrong_value(free_thresh, "at most occupied_thresh");
            return Err(ImportError::at(tree.line, "free_thresh", problem));
        }
        let negate = fields.take("negate").map_or(Ok(false), negate)?;
        let mode = fields.take("mode").map_or(Ok(RosMode::Trinary), RosMode::read)?;
        let notes = fields
            .others()
            .map(|(key, line)| format!("{} in line {line} says nothing of the map", OneLine(key)))
            .collect();
        let origin = Pose2::new(origin[0] + 0.0, origin[1] + 0.0, origin[2] + 0.0);
        Ok(RosMap { image, resolution, origin, negate, occupied_thresh, free_thresh, mode, notes })
    }

    /// Reads the map's cells from the bytes of its image: a PGM, PPM, PBM, PNG or BMP, whatever its name. A colour
    /// counts as its shade. `file` is the image's name in errors. A map that reaches beyond [`MAX_COORDINATE`] gets its
    /// own lower left corner as the world's origin, with a note.
    ///
    /// # Errors
    /// [`ImportError`]: bytes that are no such image, an image cut short, or a size that no grid may have.
    pub fn cells(&self, file: &str, image: &[u8], unknown: Unknown) -> Result<OccupancyMap, ImportError> {
        self.read_cells(image, unknown).map_err(|error| error.of(file))
    }

    fn read_cells(&self, image: &[u8], unknown: Unknown) -> Result<OccupancyMap, ImportError> {
        let image = image::read(image)?;
        let (columns, rows) = (image.columns, image.rows);
        let mut counts = RosCounts::default();
        let cells = self.occupied(&image, unknown, &mut counts);
        let mut notes = self.notes.clone();
        self.note(&counts, unknown, &mut notes);
        let mut at = self.origin;
        if self.is_far(columns as f64, rows as f64) {
            notes.push(format!(
                "the map reaches beyond {MAX_COORDINATE} m: its lower left corner, ({}, {}), is the world's origin",
                at.x, at.y
            ));
            at = Pose2::new(0.0, 0.0, at.theta);
        }
        // without a rotation the grid uses the world's frame, so that its lines are the map's to the bit
        let (origin, frame) = if at.theta == 0.0 { (at.position(), Pose2::IDENTITY) } else { (Point2::origin(), at) };
        let grid = grid_of(origin, self.resolution, columns, rows, || Ok(cells))?;
        Ok(OccupancyMap { grid, frame, notes })
    }

    /// Whether a corner of an image of this size, in pixels, lies farther out than a world may reach.
    fn is_far(&self, columns: f64, rows: f64) -> bool {
        let (width, height) = (columns * self.resolution, rows * self.resolution);
        let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
        let corners = corners.map(|(x, y)| self.origin.transform(Point2::new(x, y)));
        corners.iter().any(|p| p.x.abs() > MAX_COORDINATE || p.y.abs() > MAX_COORDINATE)
    }

    /// Which cells are obstacles, in the order of the image.
    fn occupied(&self, image: &GrayImage, unknown: Unknown, counts: &mut RosCounts) -> Vec<bool> {
        let costs: Vec<Option<u8>> = (0..=u8::MAX).map(|shade| self.cost(shade)).collect();
        let is_transparency_unknown = self.mode != RosMode::Raw;
        let mut is_occupied = |(shade, opaque): (u8, bool)| {
            let mut cost = costs[usize::from(shade)].filter(|_| opaque || !is_transparency_unknown);
            if cost == Some(0) && shade == SAVED_UNKNOWN && !self.negate && self.mode != RosMode::Raw {
                counts.saved_unknown += 1;
                cost = cost.filter(|_| unknown != Unknown::Occupied);
            }
            match cost {
                None => {
                    counts.unknown += 1;
                    unknown != Unknown::Free
                }
                Some(cost) => {
                    counts.costly += u64::from((1..OBSTACLE_COST).contains(&cost));
                    cost >= OBSTACLE_COST
                }
            }
        };
        image.pixels().map(&mut is_occupied).collect()
    }

    /// The cost of an opaque pixel of this shade, 0 to 100; `None` if it is unknown.
    fn cost(&self, shade: u8) -> Option<u8> {
        if self.mode == RosMode::Raw {
            return (shade <= OBSTACLE_COST).then_some(shade);
        }
        // every step in single precision, as Nav2 takes it
        let light = f32::from(shade) / 255.0;
        let degree = if self.negate { light } else { 1.0 - light };
        let (free, occupied) = (self.free_thresh as f32, self.occupied_thresh as f32);
        if degree <= free {
            Some(0)
        } else if degree >= occupied {
            Some(OBSTACLE_COST)
        } else if self.mode == RosMode::Scale {
            let span = (self.occupied_thresh - self.free_thresh) as f32;
            Some((((degree - free) / span * 100.0).round() as u8).min(OBSTACLE_COST))
        } else {
            None
        }
    }

    /// Adds a sentence for each thing that the reader of a map may expect otherwise.
    fn note(&self, counts: &RosCounts, unknown: Unknown, notes: &mut Vec<String>) {
        if counts.saved_unknown > 0 && unknown == Unknown::ByThresholds {
            let (cells, are) = cells_are(counts.saved_unknown);
            notes.push(format!(
                "{cells} of {SAVED_UNKNOWN}, which map_saver writes for unknown, {are} free by free_thresh {}",
                self.free_thresh
            ));
        }
        if counts.unknown > 0 {
            let taken = if unknown == Unknown::Free { "free" } else { "occupied" };
            notes.push(format!("unknown cells, taken as {taken}: {}", counts.unknown));
        }
        if counts.costly > 0 {
            let (cells, are) = cells_are(counts.costly);
            notes.push(format!(
                "{cells} with a cost of 1 to {} {are} free: a cell is an obstacle at {OBSTACLE_COST}",
                OBSTACLE_COST - 1
            ));
        }
    }
}

impl RosMode {
    fn read(node: &YamlNode) -> Result<RosMode, ImportError> {
        match node.text("mode")?.to_ascii_lowercase().as_str() {
            "trinary" => Ok(RosMode::Trinary),
            "scale" => Ok(RosMode::Scale),
            "raw" => Ok(RosMode::Raw),
            _ => Err(node.wrong("mode", "trinary, scale or raw")),
        }
    }
}

/// Reads `negate`: a whole number, which is yes unless it is 0, or a word.
fn negate(node: &YamlNode) -> Result<bool, ImportError> {
    if let Ok(number) = node.text("negate")?.parse::<i32>() {
        return Ok(number != 0);
    }
    node.boolean("negate").map_err(|_| node.wrong("negate", "0 or 1, false or true"))
}

/// A number of cells, and the verb for it.
fn cells_are(count: u64) -> (String, &'static str) {
    if count == 1 { ("1 cell".into(), "is") } else { (format!("{count} cells"), "are") }
}
