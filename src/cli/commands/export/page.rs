//! A run as one page, which any browser opens.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use motion_lab_sim::run::Log;
use motion_lab_sim::run_page::{PageTemplate, RunPageError, TemplateError, UnfinishedPage};

use crate::cli::support::input::{read_bytes, shown};
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::simulate::unstarted;
use crate::cli::{Failure, say};

/// What the run is put into.
#[derive(Debug, Args)]
pub struct PageArgs {
    /// HTML: what the run is put into, with the simulator: a page that this version of the lab saved, or the file
    /// `run-page.template` of `assets/web/build`. [default: that file beside this program, or in `../share/motion-lab`
    /// from there, where the build puts it]
    #[arg(long, value_name = "FILE")]
    pub template: Option<PathBuf>,
}

/// The file that `assets/web/build` makes.
const TEMPLATE: &str = "run-page.template";

/// Where a program in this folder has its template: beside it, or in the data of what it was installed with. A build's
/// programs and its template lie so, too.
fn usual_places(folder: &Path) -> [PathBuf; 2] {
    let above = folder.parent().unwrap_or(folder);
    [folder.join(TEMPLATE), above.join("share").join("motion-lab").join(TEMPLATE)]
}

/// The first of these places that has a file.
fn first_of(places: &[PathBuf]) -> Result<&Path, Failure> {
    places.iter().find(|place| place.is_file()).map(PathBuf::as_path).ok_or_else(|| {
        let places: Vec<String> = places.iter().map(|place| place.display().to_string()).collect();
        Failure::input(
            format!("there is no template of a run's page: no file {}", places.join(", none ")),
            "Name a page that the lab saved by --template FILE, or make the template in a checkout of motion-lab: \
             assets/web/build --light",
        )
    })
}

impl PageArgs {
    /// The template, with this program's simulator.
    fn read(&self) -> Result<PageTemplate, Failure> {
        if let Some(named) = &self.template {
            return read_template(named);
        }
        let program = env::current_exe().and_then(fs::canonicalize).map_err(Failure::internal)?;
        read_template(first_of(&usual_places(program.parent().unwrap_or(&program)))?)
    }
}

fn read_template(file: &Path) -> Result<PageTemplate, Failure> {
    let template = PageTemplate::read(&read_bytes(file, PageTemplate::MAX_BYTES)?);
    template.and_then(|template| template.check_simulator().map(|()| template)).map_err(|error| {
        let next = match &error {
            TemplateError::Print(_) => return Failure::internal(error),
            TemplateError::OtherSimulator { .. } => {
                "Make it anew by assets/web/build --light, or name a page that the lab of this version saved: \
                 --template FILE"
            }
            _ => "Name a page that the lab saved, or the file run-page.template of assets/web/build: --template FILE",
        };
        Failure::input(format!("{}: {error}", shown(file)), next)
    })
}

/// The page of the run in a log, which is simulated again, and compared. Where it differs from the log, that is said,
/// and there is no page, as it would not verify.
pub fn page(args: &PageArgs, file: &Path, log: &Log) -> Result<Option<String>, Failure> {
    let failure = |error| match error {
        RunPageError::Run(error) => unstarted(error, &log.recipe),
        error => Failure::internal(error),
    };
    let template = args.read()?;
    let progress = CommandProgress::of(log.ticks(), "ticks");
    let mut page = UnfinishedPage::of_log(&template, log).map_err(failure)?;
    while page.go_on().map_err(failure)? {
        progress.at(page.tick());
    }
    match page.page() {
        Err(error @ RunPageError::Differs(_)) => {
            let next = "A page of it would not verify, and none is written: ask for the log as it was recorded.";
            say(format!("{}: {error}\n{next}", shown(file)));
            Ok(None)
        }
        page => page.map(Some).map_err(failure),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_template_lies_beside_the_program_or_in_the_data_installed_with_it() {
        let folder = tempfile::tempdir().unwrap();
        let programs = folder.path().join("bin");
        let places = usual_places(&programs);
        let refused = first_of(&places).unwrap_err().to_string();
        for said in [places[0].to_str().unwrap(), places[1].to_str().unwrap(), "--template", "assets/web/build"] {
            assert!(refused.contains(said), "{refused}");
        }
        // as `make install` lays it out, and as a build folder is
        let data = folder.path().join("share/motion-lab/run-page.template");
        fs::create_dir_all(data.parent().unwrap()).unwrap();
        fs::write(&data, "data").unwrap();
        assert_eq!(first_of(&places).unwrap(), data);
        fs::create_dir(&programs).unwrap();
        fs::write(programs.join("run-page.template"), "beside").unwrap();
        assert_eq!(first_of(&places).unwrap(), programs.join("run-page.template"));
    }
}
