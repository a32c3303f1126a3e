//! `world export`: a world in the format of another program.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use motion_lab::picture::Theme;
use motion_lab::picture::{Figure, places, world as draw};
use motion_lab::worlds::{Grid, World};

use crate::cli::support::output::write_file;
use crate::cli::support::world_source::find_world;
use crate::cli::{Failure, Outcome, say};

/// Write a world as a ROS map (a yaml file and beside it its image, a PGM) or as a picture (SVG).
///
/// A cell of the ROS map is occupied when an obstacle meets or touches its closed square.
#[derive(Debug, Args)]
pub struct Export {
    /// A built-in world's name, or the path of a world file.
    #[arg(value_name = "NAME|FILE")]
    world: String,
    /// The format. [default: by the output's name]
    #[arg(long)]
    format: Option<Format>,
    /// The file to write: the yaml of a ROS map, or the SVG.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The size of a ROS map's cells, metres.
    #[arg(long, value_name = "METRES", default_value_t = 0.05)]
    resolution: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// The yaml and PGM of map_server.
    Ros,
    /// A picture.
    Svg,
}

impl Export {
    /// Runs the command.
    pub fn run(self) -> Result<Outcome, Failure> {
        let world = find_world(&self.world)?;
        let format = self.format.or_else(|| match self.output.extension()?.to_str()? {
            "yaml" | "yml" => Some(Format::Ros),
            "svg" => Some(Format::Svg),
            _ => None,
        });
        match format {
            Some(Format::Ros) => self.ros(&world)?,
            Some(Format::Svg) => {
                let mut picture = draw(&world);
                picture.items.extend(places(&world.places));
                write_file(&self.output, Figure::of(picture).svg(Theme::Light.palette()).as_bytes())?;
                say(format!("wrote {}", self.output.display()));
            }
            None => {
                return Err(Failure::usage(
                    format!("{}: its name does not tell the format", self.output.display()),
                    "Say it with --format: ros or svg.",
                ));
            }
        }
        Ok(Outcome::Done)
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
        let files = grid.ros_map(&image.file_name().unwrap_or_default().to_string_lossy());
        write_file(&image, &files.image)?;
        write_file(&self.output, files.yaml.as_bytes())?;
        say(format!(
            "wrote {} and {}, {} x {} cells",
            self.output.display(),
            image.display(),
            grid.columns(),
            grid.rows()
        ));
        Ok(())
    }
}
