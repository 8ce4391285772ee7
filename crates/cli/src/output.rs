//! Where a result goes, and in which format.
//!
//! The format follows the extension of `-o`, or `--format`, which wins; on standard output it is CSV. Files appear whole
//! or not at all ([`lineart::export::atomic`]).

use std::fmt;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use lineart::export::atomic;

use crate::errors::Failure;

/// A format of results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Svg,
    Ply,
    Csv,
    Json,
    Gcode,
    Fsj,
    Stl,
    Obj,
    Msh,
    Vtk,
    Png,
}

impl Format {
    const ALL: [(&'static str, Self); 11] = [
        ("svg", Self::Svg),
        ("ply", Self::Ply),
        ("csv", Self::Csv),
        ("json", Self::Json),
        ("gcode", Self::Gcode),
        ("fsj", Self::Fsj),
        ("stl", Self::Stl),
        ("obj", Self::Obj),
        ("msh", Self::Msh),
        ("vtk", Self::Vtk),
        ("png", Self::Png),
    ];

    /// By its name, which is also its extension.
    fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, format)| *format)
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(Self::ALL.iter().find(|(_, format)| format == self).map_or("", |(name, _)| name))
    }
}

/// A place for a result and the format it has there.
#[derive(Debug)]
pub(crate) struct Target {
    /// `None` is standard output.
    file: Option<PathBuf>,
    pub(crate) format: Format,
}

impl Target {
    /// Works out where the result goes; `offered` are the formats of the command.
    pub(crate) fn new(output: Option<&Path>, format: Option<&str>, offered: &[Format]) -> Result<Self, Failure> {
        let file = output.filter(|path| *path != Path::new("-")).map(Path::to_path_buf);
        let known = || offered.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        let named = |name: &str| match Format::named(name).filter(|format| offered.contains(format)) {
            Some(format) => Ok(format),
            None => Err(Failure::usage(format!("the format “{name}” is not offered here; choose one of {}", known()))),
        };
        let format = match (format, &file) {
            (Some(name), _) => named(name)?,
            (None, None) => Format::Csv,
            (None, Some(file)) => match file.extension() {
                Some(extension) => named(&extension.to_string_lossy())?,
                None => {
                    let message = format!("{} has no extension: say --format, one of {}", file.display(), known());
                    return Err(Failure::usage(message));
                }
            },
        };
        Ok(Self { file, format })
    }

    /// The folder of the file is there: better said before a long computation than after it.
    pub(crate) fn check_folder(&self) -> Result<(), Failure> {
        let Some(file) = &self.file else { return Ok(()) };
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        match folder.metadata() {
            Ok(metadata) if metadata.is_dir() => Ok(()),
            Ok(_) => Err(self.failure(&io::ErrorKind::NotADirectory.into())),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                Err(self.failure(&io::Error::new(error.kind(), "the folder does not exist")))
            }
            Err(error) => Err(self.failure(&error)),
        }
    }

    /// Writes the result through `body`.
    pub(crate) fn write(&self, body: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Failure> {
        let written = match &self.file {
            Some(file) => atomic::write_file(file, body),
            None => to_stdout(body),
        };
        written.map_err(|error| self.failure(&error))
    }

    fn failure(&self, error: &io::Error) -> Failure {
        Failure::output(&self.file.as_ref().map_or("-".to_owned(), |file| file.display().to_string()), error)
    }
}

/// Writes to standard output, buffered.
pub(crate) fn to_stdout(body: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(1 << 16, io::stdout().lock());
    body(&mut out)?;
    out.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_by_extension_and_by_name() {
        let format = |output: Option<&str>, name| {
            Target::new(output.map(Path::new), name, &[Format::Svg, Format::Csv]).ok().map(|target| target.format)
        };
        assert_eq!(format(None, None), Some(Format::Csv), "standard output is CSV");
        assert_eq!(format(Some("-"), None), Some(Format::Csv), "so is -");
        assert_eq!(format(Some("a.SVG"), None), Some(Format::Svg), "by extension");
        assert_eq!(format(Some("a.svg"), Some("csv")), Some(Format::Csv), "the option wins");
        assert_eq!(format(Some("a.ply"), None), None, "not of this command");
        assert_eq!(format(Some("a.fsj"), None), None, "not of this command either");
        assert_eq!(format(Some("a"), None), None, "no extension");
    }
}
