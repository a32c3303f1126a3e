//! `world import`: a map or drawing of another program as a world file.

use crate::cli::support::choices::{lengths_of, one_of, values};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use motion_lab::collision::{Collision, Scene};
use motion_lab::configuration::WrittenCoordinate;
use motion_lab::random::Seed;
use motion_lab::run::Recipe;
use motion_lab::tour::TourConfig;
use motion_lab::worlds::World;
use motion_lab::worlds::import::{
    CellStyle, ImportError, Imported, RosMap, SvgOptions, Unknown, irsim, is_ros_map, movingai, svg,
};

use crate::cli::support::input::{MAX_FOREIGN, MAX_TEXT, is_dash, read_bytes, read_text_of};
use crate::cli::support::output::write_file;
use crate::cli::support::simulate::begin;
use crate::cli::support::target::Target;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure, Outcome, say};

/// Read a map or drawing of another program and write it as a world file.
///
/// A ROS map is given by its yaml file; its image must be a PGM. In a MovingAI map . G S are free, @ O T W occupied. Of
/// either the occupied cells become solid boxes. In an SVG drawing what is filled becomes a solid obstacle and what is
/// only stroked a wall, called by their ids. Of an IR-SIM world the static obstacles are read, and its robots as Rusty
/// (diff) and Hitch (acker).
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab world import map.yaml --robot rusty --start 1,2,0 -o map.ron
  motion-lab world import drawing.svg --metres-per-unit 0.01 -o drawing.ron
  motion-lab world import arena.map --format movingai --metres-per-cell 0.25 -o arena.ron")]
pub struct Import {
    /// The map or drawing.
    file: PathBuf,
    /// The world file to write. [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// What FILE is. [default: by its name and content]
    #[arg(long, alias = "from")]
    format: Option<ImportFormat>,
    /// The world's name. [default: FILE without folder and extension]
    #[arg(long)]
    name: Option<String>,
    /// Put a robot of this kind into the world: rusty, reach, reach3, hitch.
    #[arg(long, value_name = "KIND", requires = "start")]
    robot: Option<String>,
    /// Where that robot starts: x,y,theta; for an arm its joint angles.
    #[arg(long, value_name = "NUMBERS", requires = "robot", value_delimiter = ',', allow_hyphen_values = true)]
    start: Vec<WrittenCoordinate>,
    /// Trace the borders of occupied cells as closed walls: fewer obstacles, but a robot put inside them touches
    /// nothing.
    #[arg(long)]
    hollow: bool,
    /// What the unknown cells of a ROS map are.
    #[arg(long, value_parser = one_of(UNKNOWN), value_name = "WHAT", default_value = "occupied")]
    unknown: Unknown,
    /// The size of a MovingAI map's cells, metres.
    #[arg(long, value_name = "METRES", default_value_t = 1.0)]
    metres_per_cell: f64,
    /// The length of an SVG drawing's unit, metres.
    #[arg(long, value_name = "METRES", default_value_t = 1.0)]
    metres_per_unit: f64,
    /// How far the straight pieces of an SVG drawing's curves may be from them, metres.
    #[arg(long, value_name = "METRES", default_value_t = SvgOptions::default().tolerance)]
    tolerance: f64,
}

/// A format that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ImportFormat {
    /// A ROS map: the yaml file of map_server.
    Ros,
    /// A map of the MovingAI benchmarks.
    Movingai,
    /// A world of IR-SIM: its static obstacles, its robots diff and acker.
    Irsim,
    /// An SVG drawing.
    Svg,
}

/// What unknown cells may be, by name.
const UNKNOWN: [(&str, Unknown, &str); 2] =
    [("occupied", Unknown::Occupied, "Not known to be free, hence never called free"), ("free", Unknown::Free, "")];

impl Import {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let kind = self.format.map_or_else(|| kind_of(&self.file), Ok)?;
        let mut imported = self.read(kind)?;
        if let Err((i, reason)) = imported.world.check_residents() {
            let reason = format!("{}: {}: {reason}", self.file.display(), imported.world.robots[i].name);
            return Err(Failure::input(reason, "Give it a start within the world, or leave it out."));
        }
        if let Some(kind) = &self.robot {
            let usage = |reason: String| Failure::usage(reason, "See `motion-lab world import --help`.");
            let start = values(&self.start, lengths_of(kind)).map_err(|reason| usage(format!("--start: {reason}")))?;
            imported.put_robot(kind, &start).map_err(|problem| usage(format!("--robot {kind}: {problem}")))?;
            imported.world.check_residents().map_err(|(_, reason)| usage(format!("--robot {kind}: {reason}")))?;
        }
        let Imported { world, notes } = imported;
        notes.iter().for_each(say);
        contacts(&world)?.iter().for_each(say);
        let text = world.to_ron();
        let Some(output) = self.output.as_deref().filter(|output| !is_dash(output)) else {
            data.text(&text)?;
            return Ok(Outcome::Done);
        };
        let target = Target::of(output)?;
        write_file(output, text.as_bytes())?;
        target.wrote_with(&format!(" with {}", counted(world.obstacles.len(), "obstacle")));
        Ok(Outcome::Done)
    }

    fn read(&self, kind: ImportFormat) -> Result<Imported, Failure> {
        let file = self.file.display().to_string();
        let stem = self.file.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let name = self.name.clone().or(stem).unwrap_or_default();
        let style = if self.hollow { CellStyle::Hollow } else { CellStyle::Solid };
        let limit = if kind == ImportFormat::Movingai { MAX_TEXT } else { MAX_FOREIGN };
        let text = read_text_of(&self.file, limit)?;
        match kind {
            ImportFormat::Ros => RosMap::parse(&file, &text).map_err(refused).and_then(|map| {
                // the image lies where the yaml says, seen from the yaml's own folder
                let image = self.file.parent().unwrap_or(Path::new("")).join(&map.image);
                let bytes = read_bytes(&image, MAX_TEXT)?;
                let cells = map.cells(&image.display().to_string(), &bytes, self.unknown).map_err(refused)?;
                cells.world(&file, &name, style).map_err(refused)
            }),
            ImportFormat::Movingai => movingai(&file, &text, self.metres_per_cell)
                .and_then(|cells| cells.world(&file, &name, style))
                .map_err(refused),
            ImportFormat::Irsim => irsim(&file, &text, &name).map_err(refused),
            ImportFormat::Svg => {
                let options = SvgOptions { metres_per_unit: self.metres_per_unit, tolerance: self.tolerance };
                svg(&file, &text, &name, options).map_err(refused)
            }
        }
    }
}

fn refused(error: ImportError) -> Failure {
    Failure::input(error, "Correct it there, or leave it out. `motion-lab world import --help` tells what is read.")
}

/// The kind of a file, by its name; of a yaml file, by its content.
fn kind_of(file: &Path) -> Result<ImportFormat, Failure> {
    let extension = file.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    match extension.as_str() {
        "map" => Ok(ImportFormat::Movingai),
        "svg" => Ok(ImportFormat::Svg),
        "yaml" | "yml" if is_ros_map(&read_text_of(file, MAX_FOREIGN)?) => Ok(ImportFormat::Ros),
        "yaml" | "yml" => Ok(ImportFormat::Irsim),
        "pgm" => Err(Failure::usage(
            format!("{}: this is a ROS map's image", file.display()),
            "Name the yaml file beside it: that tells the size of a pixel and where the map lies.",
        )),
        _ => Err(Failure::usage(
            format!("{}: its name does not tell what it is", file.display()),
            "Say it with --format: ros, movingai, irsim or svg.",
        )),
    }
}

/// A sentence for each robot that starts in contact.
fn contacts(world: &World) -> Result<Vec<String>, Failure> {
    if world.robots.is_empty() {
        return Ok(Vec::new());
    }
    let config = TourConfig { worlds: vec![world.clone()], ticks: 0, sensor: None };
    let scene = Scene::of_world(world);
    let run = begin(&Recipe::new(config, Seed(0)))?;
    let sentences = run.view().into_iter().filter_map(|robot| {
        let touched = scene.witness(&robot.footprint).filter(|w| w.dist == 0.0)?;
        let obstacle = scene.obstacle_name(touched.obstacle).unwrap_or("an obstacle");
        Some(format!("{} starts in contact with {obstacle}: give it another start", robot.name))
    });
    Ok(sentences.collect())
}
