//! The command line: what can be asked, and what can be asked together.
//!
//! clap checks names and forms. Whether values make sense (ε above zero, a smallest distance not above the largest) is
//! checked by the options that several commands share ([`groups`]), so that the message can say what would be right. All of
//! these are usage errors, exit code 2; lengths can only be compared once the drawing says how long a millimetre is.

mod application;
mod curve;
mod groups;
mod kernel;
mod reproduce;

use std::ffi::OsString;

use clap::{Args, CommandFactory, Parser, Subcommand};
use clap_complete::Shell;

pub(crate) use self::application::{ColourArgs, MeshArgs, ReconstructArgs, SimulateArgs, TriangleArgs, UnlabelledName};
pub(crate) use self::curve::{
    CertifyArgs, CompareArgs, CompareFormat, InspectArgs, InspectFormat, LfsArgs, MedialArgs, SampleArgs,
};
pub(crate) use self::groups::{Layer, above, check_corner_angle, resolve, share};
pub(crate) use self::kernel::{NearestArgs, RootsArgs};
pub(crate) use self::reproduce::{ExperimentName, ReproduceArgs};
use crate::errors::Failure;

/// Local feature size, medial axis and ε-samples of vector line art.
///
/// Reads an SVG drawing (or a CSV of control points), works out how near each of its points is to the drawing's medial
/// axis, and places points along the curves: dense where there is detail, sparse where there is none.
///
/// Coordinates are the user units of the root viewBox, y downwards. A length L is a plain number (user units) or a
/// number with mm, cm, in, px, pt, or % (of the diagonal of the drawing's control points).
#[derive(Parser, Debug)]
#[command(name = "fsample", version, arg_required_else_help = true, max_term_width = 100)]
#[command(after_help = "\
Examples:
  fsample sample drawing.svg -o samples.svg
  fsample sample drawing.svg --epsilon 0.3 --chord-error 0.1mm --min-distance 0.05mm -o plot.gcode
  fsample inspect drawing.svg

Exit codes: 0 done; 1 the answer is no; 2 usage; 3 bad input; 4 output could not be written;
5 gave up at a limit that an option can raise.")]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// One command and its options.
#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    Sample(SampleArgs),
    Medial(MedialArgs),
    Lfs(LfsArgs),
    Certify(CertifyArgs),
    Inspect(InspectArgs),
    Colour(ColourArgs),
    Compare(CompareArgs),
    Reconstruct(ReconstructArgs),
    Mesh(MeshArgs),
    Simulate(SimulateArgs),
    Reproduce(ReproduceArgs),
    Roots(RootsArgs),
    Nearest(NearestArgs),
    Completions(CompletionsArgs),
    Man(ManArgs),
}

/// Print a completion script for a shell.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample completions bash > ~/.local/share/bash-completion/completions/fsample
  fsample completions zsh > ~/.zfunc/_fsample")]
pub(crate) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    pub(crate) shell: Shell,
}

/// Print a manual page.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample man | man -l -
  fsample man sample > fsample-sample.1")]
pub(crate) struct ManArgs {
    /// The command whose page is wanted; without it, the page of fsample itself
    pub(crate) command: Option<String>,
}

/// Reads the command line.
pub(crate) fn parse() -> Result<Command, Failure> {
    let arguments = queries_as_values(std::env::args_os());
    Cli::try_parse_from(arguments).map(|cli| cli.command).map_err(|error| Failure::from_clap(&error))
}

/// The command line with a blank before queries like `-5,3`, which clap would take for options.
fn queries_as_values(arguments: impl Iterator<Item = OsString>) -> Vec<OsString> {
    let mut arguments: Vec<OsString> = arguments.collect();
    if arguments.get(1).is_some_and(|command| command == "nearest") {
        for argument in arguments.iter_mut().skip(2) {
            let is_query = argument
                .to_str()
                .and_then(|text| text.strip_prefix('-'))
                .is_some_and(|text| text.contains(',') && text.starts_with(|c: char| c.is_ascii_digit() || c == '.'));
            if is_query {
                let mut value = OsString::from(" ");
                value.push(&*argument);
                *argument = value;
            }
        }
    }
    arguments
}

/// The command line as data, for completions and manual pages.
pub(crate) fn definition() -> clap::Command {
    Cli::command()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_definition_is_sound() {
        definition().debug_assert();
    }
}
