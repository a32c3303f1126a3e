//! Reads the maps of ROS: map_server's yaml with a graymap.

use super::cells::grid_of;
use super::pgm::Pgm;
use crate::error::wrong_value;
use crate::{ImportError, OccupancyMap, yaml};
use motion_lab_core::geometry::{Point2, Pose2};

/// The head of a ROS map: its yaml file.
///
/// A pixel of shade `s` (0 black, 1 white) is occupied to the degree `1 - s`, with `negate` to the degree `s`. From
/// `occupied_thresh` on it is occupied, below `free_thresh` it is free, in between unknown. In the mode `raw` a pixel's
/// own value is its degree in hundredths, and beyond 100 it is unknown. Thresholds not given are 0.65 and 0.196, as in
/// map_server.
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
    /// The least degree of a pixel that is not free.
    pub free_thresh: f64,
    /// Whether a pixel's own value is its degree in hundredths.
    pub raw: bool,
}

/// How a map's unknown cells are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unknown {
    /// As occupied: only cells known to be free are free.
    #[default]
    Occupied,
    /// As free.
    Free,
}

/// Whether a yaml text looks like the head of a ROS map: it names an image.
pub fn is_ros_map(text: &str) -> bool {
    yaml::read(text).is_ok_and(|tree| tree.fields("").is_ok_and(|mut fields| fields.take("image").is_some()))
}

impl RosMap {
    /// Reads a map's yaml file. `file` is its name in errors.
    ///
    /// # Errors
    /// [`ImportError`] names line and key: what is missing, unknown or out of range.
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
        let negate = match fields.take("negate") {
            None => false,
            Some(node) => match node.text("negate")? {
                "0" | "false" => false,
                "1" | "true" => true,
                _ => return Err(node.wrong("negate", "0 or 1")),
            },
        };
        let raw = match fields.take("mode") {
            None => false,
            Some(node) => match node.text("mode")? {
                "trinary" | "scale" => false,
                "raw" => true,
                _ => return Err(node.wrong("mode", "trinary, scale or raw")),
            },
        };
        fields.finish("image, resolution, origin, negate, occupied_thresh, free_thresh and mode")?;
        let origin = Pose2::new(origin[0] + 0.0, origin[1] + 0.0, origin[2] + 0.0);
        Ok(RosMap { image, resolution, origin, negate, occupied_thresh, free_thresh, raw })
    }

    /// Reads the map's cells from the bytes of its image, a PGM. `file` is the image's name in errors.
    ///
    /// # Errors
    /// [`ImportError`]: bytes that are not a graymap, a graymap cut short, or a size that no grid may have.
    pub fn cells(&self, file: &str, image: &[u8], unknown: Unknown) -> Result<OccupancyMap, ImportError> {
        self.read_cells(image, unknown).map_err(|error| error.of(file))
    }

    fn read_cells(&self, image: &[u8], unknown: Unknown) -> Result<OccupancyMap, ImportError> {
        let Pgm { columns, rows, max, pixels } = Pgm::read(image)?;
        let mut unknowns = 0_usize;
        let cells: Vec<bool> = pixels
            .into_iter()
            .map(|pixel| match self.is_occupied(pixel, max) {
                Some(occupied) => occupied,
                None => {
                    unknowns += 1;
                    unknown == Unknown::Occupied
                }
            })
            .collect();
        // without a rotation the grid uses the world's frame, so that its lines are the map's to the bit
        let (origin, frame) = if self.origin.theta == 0.0 {
            (self.origin.position(), Pose2::IDENTITY)
        } else {
            (Point2::origin(), self.origin)
        };
        let grid = grid_of(origin, self.resolution, columns, rows, || Ok(cells))?;
        let taken = match unknown {
            Unknown::Occupied => "occupied",
            Unknown::Free => "free",
        };
        let notes = if unknowns == 0 { vec![] } else { vec![format!("unknown cells, taken as {taken}: {unknowns}")] };
        Ok(OccupancyMap { grid, frame, notes })
    }

    /// Whether a pixel is occupied; `None` if it is unknown.
    fn is_occupied(&self, pixel: u16, max: u16) -> Option<bool> {
        let degree = match (self.raw, self.negate) {
            (true, _) if pixel > 100 => return None,
            (true, _) => f64::from(pixel) / 100.0,
            (false, true) => f64::from(pixel) / f64::from(max),
            (false, false) => f64::from(max - pixel) / f64::from(max),
        };
        if degree >= self.occupied_thresh {
            Some(true)
        } else if degree < self.free_thresh {
            Some(false)
        } else {
            None
        }
    }
}
