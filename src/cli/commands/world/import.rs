//! `world import`: a map or drawing of another program as a world file.

use crate::cli::support::choices::{NumberList, lengths_of, one_of, values};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::configuration::WrittenCoordinate;
use motion_lab_core::random::Seed;
use motion_lab_core::worlds::World;
use motion_lab_import::{
    CellStyle, ImportError, Imported, IrsimOptions, RosMap, Scenario, SvgOptions, Unknown, irsim, is_ros_map, movingai,
    svg,
};
use motion_lab_sim::run::Recipe;
use motion_lab_sim::tour::TourConfig;

use crate::cli::support::input::{MAX_FOREIGN, MAX_TEXT, is_dash, read_bytes, read_text_of, shown};
use crate::cli::support::output::write_file;
use crate::cli::support::simulate::begin;
use crate::cli::support::target::Target;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure, Outcome, say};

/// Read a map or drawing of another program and write it as a world file.
///
/// A ROS map is given by its yaml file; its image may be a PGM, PPM, PBM, PNG or BMP. In a MovingAI map . G S E are
/// free, @ O T W occupied. Of either the occupied cells become solid boxes. Of a MovingAI scenario (.scen) the map is
/// read, and its problems become the places `start 1`, `goal 1`, `start 2` and so on. In an SVG drawing what is filled
/// becomes a solid obstacle and what is only stroked a wall, called by their ids; it has its physical size, if it says
/// one. Of an IR-SIM world the static obstacles are read, and its robots with their sizes and lidars as Rusty (diff)
/// and Hitch (acker).
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab world import map.yaml --robot rusty --start 1,2,0 -o map.ron
  motion-lab world import drawing.svg --metres-per-unit 0.01 -o drawing.ron
  motion-lab world import campus.yaml --shift -431000,-4582000 -o campus.ron
  motion-lab world import arena.map.scen -o arena.ron
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
    /// What the unknown cells of a ROS map are. [default: occupied; the yaml's thresholds say which are unknown]
    #[arg(long, value_parser = one_of(UNKNOWN), value_name = "WHAT")]
    unknown: Option<Unknown>,
    /// Move a ROS map by this, metres. [default: none; a map that reaches beyond 10 km has its own corner as origin]
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    shift: Option<NumberList>,
    /// Leave out what the lab does not have of an IR-SIM world, such as obstacles that move, and say so.
    #[arg(long)]
    lenient: bool,
    /// The seed of what an IR-SIM world leaves to chance.
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    seed: u64,
    /// The size of a MovingAI map's cells, metres. [default: 1, and a warning, as such a map says no size]
    #[arg(long, value_name = "METRES")]
    metres_per_cell: Option<f64>,
    /// The length of an SVG drawing's own unit, that of its viewBox, metres. [default: by the drawing's physical size;
    /// without one, 1 m for a pixel of its width and height, and a warning]
    #[arg(long, value_name = "METRES")]
    metres_per_unit: Option<f64>,
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
    /// A scenario of the MovingAI benchmarks, beside its map.
    Scen,
    /// A world of IR-SIM: its static obstacles, its robots diff and acker.
    Irsim,
    /// An SVG drawing.
    Svg,
}

/// What unknown cells may be, by name.
const UNKNOWN: [(&str, Unknown, &str); 2] = [
    (
        "occupied",
        Unknown::Occupied,
        "And so is the shade 205, which map_saver writes for unknown, whatever the thresholds",
    ),
    ("free", Unknown::Free, ""),
];

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
        let Imported { world, notes, assumed_unit } = imported;
        notes.iter().for_each(say);
        self.warning(kind, assumed_unit).iter().for_each(say);
        contacts(&world)?.iter().for_each(say);
        let text = world.to_ron();
        let Some(output) = self.output.as_deref().filter(|output| !is_dash(output)) else {
            data.text(&text)?;
            return Ok(Outcome::Done);
        };
        let target = Target::of(output)?;
        write_file(&target, text.as_bytes())?;
        target.wrote_with(&format!(" with {}", counted(world.obstacles.len(), "obstacle")));
        Ok(Outcome::Done)
    }

    fn read(&self, kind: ImportFormat) -> Result<Imported, Failure> {
        let file = self.file.display().to_string();
        let name = self.world_name();
        if self.shift.is_some() && kind != ImportFormat::Ros {
            return Err(Failure::usage("--shift: only ROS maps lie somewhere else", "Leave it out."));
        }
        let limit = if matches!(kind, ImportFormat::Movingai | ImportFormat::Scen) { MAX_TEXT } else { MAX_FOREIGN };
        let text = read_text_of(&self.file, limit)?;
        match kind {
            ImportFormat::Ros => self.ros(&file, &text, &name),
            ImportFormat::Movingai => self.movingai(&file, &text, &name),
            ImportFormat::Scen => self.scenario(&file, &text, &name),
            ImportFormat::Irsim => {
                let options = IrsimOptions { is_lenient: self.lenient, seed: Seed(self.seed) };
                irsim(&file, &text, &name, options).map_err(refused)
            }
            ImportFormat::Svg => {
                let options = SvgOptions { metres_per_unit: self.metres_per_unit, tolerance: self.tolerance };
                svg(&file, &text, &name, options).map_err(refused)
            }
        }
    }

    /// The world's name: as asked for, or the file's, of `arena.map.scen` without both endings.
    fn world_name(&self) -> String {
        let stem = self.file.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        self.name.clone().unwrap_or_else(|| stem.strip_suffix(".map").map_or(stem.clone(), str::to_owned))
    }

    /// The size of a MovingAI map's cells, metres.
    fn cell(&self) -> f64 {
        self.metres_per_cell.unwrap_or(1.0)
    }

    /// What is said where nobody says how large things are.
    fn warning(&self, kind: ImportFormat, assumed_unit: Option<f64>) -> Option<String> {
        let file = shown(&self.file);
        let of_cells = matches!(kind, ImportFormat::Movingai | ImportFormat::Scen) && self.metres_per_cell.is_none();
        let of_cells = of_cells.then(|| {
            format!("{file}: the map says no size, so a cell was taken for 1 m; --metres-per-cell says how large it is")
        });
        let of_drawing = |unit: f64| {
            format!(
                "{file}: the drawing says no physical size, so a unit of it was taken for {unit} m; --metres-per-unit \
                 says how long it is"
            )
        };
        of_cells.or_else(|| assumed_unit.map(of_drawing))
    }

    fn style(&self) -> CellStyle {
        if self.hollow { CellStyle::Hollow } else { CellStyle::Solid }
    }

    fn ros(&self, file: &str, text: &str, name: &str) -> Result<Imported, Failure> {
        let mut map = RosMap::parse(file, text).map_err(refused)?;
        if let Some(shift) = &self.shift {
            let usage = |reason: String| Failure::usage(reason, "For example --shift -431000,-4582000.");
            let [x, y] = shift.values(2).map_err(usage)?[..] else {
                return Err(usage("--shift takes two numbers: x,y".into()));
            };
            map.origin.x += x;
            map.origin.y += y;
        }
        let image = self.image(&mut map);
        let bytes = read_bytes(&image, MAX_TEXT)?;
        let unknown = self.unknown.unwrap_or_default();
        let cells = map.cells(&image.display().to_string(), &bytes, unknown).map_err(refused)?;
        cells.world(file, name, self.style()).map_err(refused)
    }

    /// Where a map's image lies: where the yaml says, seen from the yaml's own folder. Many yaml files name it by the
    /// path of whoever made them; then it is the one beside the yaml, with a note.
    fn image(&self, map: &mut RosMap) -> PathBuf {
        let named = self.beside(&map.image);
        let near = self.beside(Path::new(&map.image).file_name().unwrap_or_default());
        if named.is_file() || !near.is_file() {
            return named;
        }
        map.notes.push(format!("the image was read from {}: {} is not there", near.display(), map.image));
        near
    }

    fn movingai(&self, file: &str, text: &str, name: &str) -> Result<Imported, Failure> {
        let cells = movingai(file, text, self.cell()).map_err(refused)?;
        cells.world(file, name, self.style()).map_err(refused)
    }

    fn scenario(&self, file: &str, text: &str, name: &str) -> Result<Imported, Failure> {
        let scenario = Scenario::parse(file, text).map_err(refused)?;
        // scenarios name their map by a path of whoever made them: it lies there, or beside the scenario
        let base = Path::new(&scenario.map).file_name().unwrap_or_default();
        let places = [self.beside(&scenario.map), self.beside(base), self.file.with_extension("")];
        let map = places.iter().find(|path| path.is_file()).unwrap_or(&places[1]);
        let map_name = map.display().to_string();
        let cells = movingai(&map_name, &read_text_of(map, MAX_TEXT)?, self.cell()).map_err(refused)?;
        let size = [cells.grid.columns(), cells.grid.rows()].map(u64::from);
        let mut imported = cells.world(&map_name, name, self.style()).map_err(refused)?;
        scenario.put_places(file, size, self.cell(), &mut imported).map_err(refused)?;
        Ok(imported)
    }

    /// A path as seen from the file's own folder.
    fn beside(&self, path: impl AsRef<Path>) -> PathBuf {
        self.file.parent().unwrap_or(Path::new("")).join(path)
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
        "scen" => Ok(ImportFormat::Scen),
        "svg" => Ok(ImportFormat::Svg),
        "yaml" | "yml" if is_ros_map(&read_text_of(file, MAX_FOREIGN)?) => Ok(ImportFormat::Ros),
        "yaml" | "yml" => Ok(ImportFormat::Irsim),
        "pgm" | "ppm" | "pbm" | "png" | "bmp" => Err(Failure::usage(
            format!("{}: this is a ROS map's image", file.display()),
            "Name the yaml file beside it: that tells the size of a pixel and where the map lies.",
        )),
        _ => Err(Failure::usage(
            format!("{}: its name does not tell what it is", file.display()),
            "Say it with --format: ros, movingai, scen, irsim or svg.",
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
