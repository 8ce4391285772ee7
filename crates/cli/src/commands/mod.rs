//! One file per command.

mod certify;
mod colour;
mod compare;
mod completions;
mod inspect;
mod lfs;
mod man;
mod medial;
mod mesh;
mod nearest;
mod reconstruct;
mod reproduce;
mod roots;
mod sample;
mod simulate;

use crate::errors::Failure;
use crate::options::Command;

/// Runs a command.
pub(crate) fn run(command: Command) -> Result<(), Failure> {
    match command {
        Command::Sample(args) => sample::run(&args),
        Command::Medial(args) => medial::run(&args),
        Command::Lfs(args) => lfs::run(&args),
        Command::Certify(args) => certify::run(&args),
        Command::Inspect(args) => inspect::run(&args),
        Command::Colour(args) => colour::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Reconstruct(args) => reconstruct::run(&args),
        Command::Mesh(args) => mesh::run(&args),
        Command::Simulate(args) => simulate::run(&args),
        Command::Reproduce(args) => reproduce::run(&args),
        Command::Roots(args) => roots::run(&args),
        Command::Nearest(args) => nearest::run(&args),
        Command::Completions(args) => completions::run(&args),
        Command::Man(args) => man::run(&args),
    }
}
