//! `fsample completions`.

use crate::errors::Failure;
use crate::options::{CompletionsArgs, definition};
use crate::output::to_stdout;

/// Prints a completion script.
pub(crate) fn run(args: &CompletionsArgs) -> Result<(), Failure> {
    // The generator panics where it cannot write, so it writes into memory.
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut definition(), "fsample", &mut script);
    to_stdout(|out| out.write_all(&script)).map_err(|error| Failure::output("-", &error))
}
