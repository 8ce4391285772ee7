//! `fsample`: feature-size sampling of vector line art on the command line.
//!
//! This crate only translates: options into bounds, files into drawings, results into formats, and every way a run can
//! end into one line on standard error and an exit code ([`errors`]). What is computed lives in `feature-sampling` and
//! `lineart`; [`engine`] is the one place where the two meet. Each command has a file of its own under [`commands`].

mod commands;
mod engine;
mod errors;
mod input;
mod job;
mod meshing;
mod number_in;
mod options;
mod output;
mod progress;
mod study_input;
mod summary;

use std::process::ExitCode;

fn main() -> ExitCode {
    match options::parse().and_then(commands::run) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
