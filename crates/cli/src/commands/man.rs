//! `fsample man`.

use crate::errors::Failure;
use crate::options::{ManArgs, definition};
use crate::output::to_stdout;

/// Prints a manual page.
pub(crate) fn run(args: &ManArgs) -> Result<(), Failure> {
    let mut whole = definition();
    // Gives every command its full name.
    whole.build();
    let page = match &args.command {
        None => whole,
        Some(name) => match whole.find_subcommand(name) {
            Some(command) => command.clone(),
            None => return Err(Failure::usage(format!("there is no command “{name}”; see fsample --help"))),
        },
    };
    to_stdout(|out| clap_mangen::Man::new(page).render(out)).map_err(|error| Failure::output("-", &error))
}
