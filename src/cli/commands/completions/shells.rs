//! What is changed in the completions that `clap_complete` makes.

use clap::ValueEnum;
use clap::builder::PossibleValue;
use clap_complete::Shell;
use motion_lab_core::worlds::World;

use crate::cli::commands::query::Question;

/// The program's name.
pub const NAME: &str = "motion-lab";

/// The completions as this program's are to be.
///
/// - In bash the states of a program with a hyphen in its name have two spellings, so that nothing is completed after a
///   command (issue 6421 of clap); one spelling is enough.
/// - Where the name of a built-in world may stand, the path of a file may, too.
/// - In fish the values of arguments without an option are added.
pub fn mended(shell: Shell, text: &str) -> String {
    let worlds = World::built_in_names().join(" ");
    match shell {
        Shell::Bash => {
            let text = text.replace(&NAME.replace('-', "__subcmd__"), &NAME.replace('-', "__"));
            let names = format!("$(compgen -W \"{worlds}\" -- \"${{cur}}\")");
            text.replace(&names, &format!("{names} $(compgen -f -- \"${{cur}}\")"))
        }
        Shell::Zsh => text.replace(&format!(":({worlds})'"), &format!(":{{ compadd {worlds}; _files }}'")),
        Shell::Fish => {
            let first = World::built_in_names().into_iter().next().unwrap_or_default();
            let text = text.replace(&format!("-r -f -a \"{first}"), &format!("-r -F -a \"{first}"));
            let values = |command: &str, values: &str| {
                format!("complete -c {NAME} -n \"__fish_motion_lab_using_subcommand {command}\" -a \"{values}\"\n")
            };
            let named = |names: Vec<PossibleValue>| names.iter().map(|v| v.get_name().to_owned()).collect::<Vec<_>>();
            let questions = Question::value_variants().iter().filter_map(ValueEnum::to_possible_value).collect();
            let shells = Shell::value_variants().iter().filter_map(ValueEnum::to_possible_value).collect();
            text + &values("world; and __fish_seen_subcommand_from show export", &worlds)
                + &values("query", &named(questions).join(" "))
                + &values("completions", &named(shells).join(" "))
        }
        _ => text.to_owned(),
    }
}
