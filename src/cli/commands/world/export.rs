//! `world export`: a world in the format of another program.

use std::path::PathBuf;

use crate::capture::{CaptureForm, Captured, with_names};
use clap::{Args, ValueEnum};
use motion_lab_core::picture::{Figure, places, world as draw};
use motion_lab_core::worlds::{Grid, World};

use crate::cli::support::choices::WorldNames;
use crate::cli::support::console::note;
use crate::cli::support::input::is_dash;
use crate::cli::support::output::write_file;
use crate::cli::support::paper::{PaperArgs, write_picture};
use crate::cli::support::target::Target;
use crate::cli::support::world_source::find_world;
use crate::cli::{Data, Failure, Outcome};

/// Write a world as a ROS map (a yaml file and beside it its image, a PGM) or as a picture (SVG or PNG).
///
/// A cell of the ROS map is occupied when an obstacle meets or touches its closed square.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab world export lot --resolution 0.05 -o lot.yaml
  motion-lab world export apartment --names --theme dark -o apartment.png
  motion-lab world export yard.ron -o - > yard.svg")]
pub struct WorldExport {
    /// A built-in world's name, or the path of a world file.
    #[arg(value_name = "NAME|FILE", value_parser = WorldNames, hide_possible_values = true)]
    world: String,
    /// The format. [default: by the output's name]
    #[arg(long)]
    format: Option<WorldFormat>,
    /// The file to write: the yaml of a ROS map, or the picture. `-` is standard output, for a picture.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The size of a ROS map's cells, metres.
    #[arg(long, value_name = "METRES", default_value_t = 0.05)]
    resolution: f64,
    #[command(flatten)]
    paper: PaperArgs,
    /// SVG and PNG: the names of obstacles, places and marks, not of places alone.
    #[arg(long)]
    names: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum WorldFormat {
    /// The yaml and PGM of map_server.
    Ros,
    /// A picture.
    Svg,
    /// The same, painted.
    Png,
}

impl WorldExport {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let world = find_world(&self.world)?;
        let format = self.format.or_else(|| match self.output.extension().and_then(|e| e.to_str()) {
            Some("yaml" | "yml") => Some(WorldFormat::Ros),
            Some("png") => Some(WorldFormat::Png),
            Some("svg") => Some(WorldFormat::Svg),
            _ => is_dash(&self.output).then_some(WorldFormat::Svg),
        });
        match format {
            Some(WorldFormat::Ros) => self.ros(&world)?,
            Some(form) => {
                let target = Target::of(&self.output)?;
                self.picture(
                    &world,
                    if form == WorldFormat::Png { CaptureForm::Png } else { CaptureForm::Svg },
                    &target,
                )?;
                target.finish(data)?;
            }
            None => {
                return Err(Failure::usage(
                    format!("{}: its name does not tell the format", self.output.display()),
                    "Say it with --format: ros, svg or png.",
                ));
            }
        }
        Ok(Outcome::Done)
    }

    /// Draws the world.
    fn picture(&self, world: &World, form: CaptureForm, target: &Target) -> Result<(), Failure> {
        let paper = self.paper.paper();
        let mut picture = draw(world);
        if !self.names {
            picture.items.extend(places(&world.places));
        }
        let figure = Figure::of(picture);
        let worlds = std::slice::from_ref(world);
        let figure = if self.names { with_names(figure, worlds, paper.width_px()) } else { figure };
        let notes = vec![("World", format!("{} {:032x}", world.name, world.content_hash()))];
        write_picture(&Captured { figure, notes }, &paper, form, target)
    }

    /// Writes the image first: a yaml without its image would be of no use.
    fn ros(&self, world: &World) -> Result<(), Failure> {
        let grid = Grid::rasterize(world, self.resolution)
            .map_err(|error| Failure::usage(error, "Give a coarser --resolution, in metres."))?;
        let image = self.output.with_extension("pgm");
        if image == self.output {
            return Err(Failure::usage(
                format!("{}: this is the image's name", image.display()),
                "Name the yaml file; the image is put beside it.",
            ));
        }
        let (yaml, pgm) = (Target::file(&self.output)?, Target::file(&image)?);
        let files = grid.ros_map(&image.file_name().unwrap_or_default().to_string_lossy());
        write_file(&pgm, &files.image)?;
        write_file(&yaml, files.yaml.as_bytes())?;
        let cells = format!("{} x {} cells", grid.columns(), grid.rows());
        note(format!("wrote {} and {}, {cells}", self.output.display(), image.display()));
        // what is lost is said of each
        [yaml, pgm].iter().filter(|target| target.older().is_some()).for_each(Target::wrote);
        Ok(())
    }
}
