//! How a run that does not succeed ends.
//!
//! Scripts decide by the exit code, people by one line that names the file, the place in it and the cause. The codes are
//! part of the interface:
//!
//! | code | meaning |
//! |---|---|
//! | 0 | done |
//! | 1 | the answer is no (commands that ask a question, such as `reconstruct --compare`) |
//! | 2 | usage: options that make no sense, alone or together |
//! | 3 | bad input |
//! | 4 | output could not be written |
//! | 5 | gave up at a limit that the user can raise |

use std::fmt::Display;
use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;

/// Why a run ended, with what to tell the user.
#[derive(Debug)]
pub(crate) struct Failure {
    code: u8,
    message: String,
}

impl Failure {
    /// The answer to what was asked is no.
    pub(crate) fn no(message: impl Display) -> Self {
        Self { code: 1, message: message.to_string() }
    }

    /// Options that make no sense.
    pub(crate) fn usage(message: impl Display) -> Self {
        Self { code: 2, message: message.to_string() }
    }

    /// Input that cannot be used; `name` is the file.
    pub(crate) fn input(name: &str, message: impl Display) -> Self {
        Self { code: 3, message: format!("{}: {message}", shown(name)) }
    }

    /// What a reader of `lineart` has to say; it names the file itself.
    pub(crate) fn read(error: impl Display) -> Self {
        Self { code: 3, message: error.to_string() }
    }

    /// Output that could not be written; `name` is the file.
    ///
    /// A reader that stopped listening (`fsample … | head`) is no failure of anyone: that ends quietly.
    pub(crate) fn output(name: &str, error: &io::Error) -> Self {
        let message = match error.kind() {
            ErrorKind::BrokenPipe => String::new(),
            _ => format!("{}: cannot be written: {error}", shown(name)),
        };
        Self { code: if message.is_empty() { 0 } else { 4 }, message }
    }

    /// A limit that the user can raise; the message names the option.
    pub(crate) fn limit(message: impl Display) -> Self {
        Self { code: 5, message: message.to_string() }
    }

    /// What clap has to say. Help and version are answers, not errors.
    pub(crate) fn from_clap(error: &clap::Error) -> Self {
        let text = error.render().to_string();
        match error.kind() {
            clap::error::ErrorKind::DisplayHelp | clap::error::ErrorKind::DisplayVersion => {
                match io::stdout().lock().write_all(text.as_bytes()) {
                    Ok(()) => Self { code: 0, message: String::new() },
                    Err(error) => Self::output("-", &error),
                }
            }
            clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
                // Nothing was asked: the help is the message, and there is no line to add to it.
                drop(io::stderr().lock().write_all(text.as_bytes()));
                Self { code: 2, message: String::new() }
            }
            _ => Self::usage(first_paragraph(&text)),
        }
    }

    /// Prints the message, if there is one, and answers the exit code.
    pub(crate) fn report(self) -> ExitCode {
        if !self.message.is_empty() {
            // There is nowhere left to complain to if standard error is gone.
            drop(writeln!(io::stderr(), "fsample: error: {}", on_one_line(&self.message)));
        }
        ExitCode::from(self.code)
    }
}

/// Says something that does not keep the run from succeeding.
pub(crate) fn warn(message: impl Display) {
    drop(writeln!(io::stderr(), "fsample: warning: {}", on_one_line(&message.to_string())));
}

/// A file name as messages show it.
pub(crate) fn shown(name: &str) -> &str {
    if name == "-" { "standard input or output" } else { name }
}

/// clap's message without its heading, its tips and its usage.
fn first_paragraph(text: &str) -> String {
    let paragraph = text.split("\n\n").next().unwrap_or_default();
    let message = paragraph.strip_prefix("error: ").unwrap_or(paragraph);
    format!("{message}; see fsample --help")
}

/// Line breaks and the blanks around them become single blanks.
fn on_one_line(message: &str) -> String {
    message.lines().map(str::trim).filter(|line| !line.is_empty()).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_take_one_line() {
        assert_eq!(on_one_line("a\n  b\n\nc"), "a b c", "joined");
        let clap = "error: unexpected argument '--x' found\n\n  tip: y\n\nUsage: z";
        assert_eq!(first_paragraph(clap), "unexpected argument '--x' found; see fsample --help", "the message alone");
    }

    #[test]
    fn a_reader_that_left_is_no_failure() {
        let failure = Failure::output("-", &io::Error::from(ErrorKind::BrokenPipe));
        assert_eq!((failure.code, failure.message.as_str()), (0, ""), "quiet");
    }
}
