//! A text file taken whole, or a clear reason why not.
//!
//! All readers of this crate work on text in memory. This is the one place that touches the file system for them:
//! it bounds what is read (a device file never ends), names a folder and a compressed drawing for what they are,
//! and says where a file stops being UTF-8. A byte order mark is removed.

use std::fmt;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The largest file that is read, in bytes: 256 MiB, a thousand times the largest drawing seen in practice.
pub const MAX_BYTES: u64 = 256 << 20;

/// Why a text could not be had. The message names no file: whoever adds the cause adds the name.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ReadError {
    /// The system refused: missing file, no permission, a broken pipe. Check name and rights.
    Io {
        /// The system's kind of error.
        kind: io::ErrorKind,
        /// The system's words.
        message: String,
    },
    /// The name is a folder's.
    Directory,
    /// More than [`MAX_BYTES`].
    TooLarge,
    /// The file starts like a gzip file (`.svgz`); unpack it first.
    Compressed,
    /// Not UTF-8; save the file in that encoding.
    NotUtf8 {
        /// Offset of the first byte that is not.
        at: usize,
    },
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io { kind: io::ErrorKind::NotFound, .. } => f.write_str("no such file"),
            Self::Io { message, .. } => write!(f, "cannot be read: {message}"),
            Self::Directory => f.write_str("is a directory, not a file"),
            Self::TooLarge => write!(f, "is larger than {} MiB", MAX_BYTES >> 20),
            Self::Compressed => f.write_str("is compressed with gzip (svgz); unpack it first, for example with gunzip"),
            Self::NotUtf8 { at } => write!(f, "is not UTF-8 text (byte {at})"),
        }
    }
}

impl std::error::Error for ReadError {}

impl From<io::Error> for ReadError {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::IsADirectory => Self::Directory,
            kind => Self::Io { kind, message: error.to_string() },
        }
    }
}

/// The text of the file at `path`, without a byte order mark.
pub fn read_file(path: &Path) -> Result<String, ReadError> {
    // Some systems open a folder gladly and fail at the first read with a riddle; so ask first.
    if path.is_dir() {
        return Err(ReadError::Directory);
    }
    read(File::open(path)?)
}

/// The text that `input` gives until its end, without a byte order mark.
pub fn read(input: impl Read) -> Result<String, ReadError> {
    let mut bytes = Vec::new();
    input.take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(ReadError::TooLarge);
    }
    if bytes.starts_with(&[0x1f, 0x8b]) {
        return Err(ReadError::Compressed);
    }
    if bytes.starts_with("\u{feff}".as_bytes()) {
        bytes.drain(..3);
    }
    String::from_utf8(bytes).map_err(|e| ReadError::NotUtf8 { at: e.utf8_error().valid_up_to() })
}

/// `text` with control characters escaped, so that a message stays on one line whatever a file contains.
pub(crate) fn one_line(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() {
            out.extend(c.escape_default());
        } else {
            out.push(c);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_that_are_not_a_text_are_named() {
        assert_eq!(read(&b"\x1f\x8b\x08\x00"[..]), Err(ReadError::Compressed));
        assert_eq!(read(&b"<svg\xff/>"[..]), Err(ReadError::NotUtf8 { at: 4 }));
        assert_eq!(read(&b"\xef\xbb\xbf<svg/>"[..]), Ok("<svg/>".to_owned()));
        assert_eq!(read(io::repeat(b' ')), Err(ReadError::TooLarge));
    }

    #[test]
    fn messages_stay_on_one_line() {
        assert_eq!(one_line("a\nb\u{1b}"), "a\\nb\\u{1b}");
    }
}
