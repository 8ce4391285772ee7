//! What can be wrong with an SVG document, in one line that leads to the place.
//!
//! A browser shows what it can of a broken drawing. A program whose output drives a machine should not: half a path
//! is not the drawing that was meant. So the reader refuses malformed data, and says where.

use std::fmt;

use crate::text_in::{ReadError, one_line};

/// An element for a message: tag, id where it has one, line and column where its start tag begins.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ElementName {
    /// Local name, `path` say.
    pub tag: String,
    /// The `id` attribute.
    pub id: Option<String>,
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
}

impl fmt::Display for ElementName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.id {
            Some(id) => write!(f, "{} #{id} at {}:{}", self.tag, self.line, self.column),
            None => write!(f, "{} at {}:{}", self.tag, self.line, self.column),
        }
    }
}

/// A drawing that could not be read. `Display` gives one line: file, element, cause.
#[derive(Clone, Debug, PartialEq)]
pub struct SvgError {
    source: String,
    kind: Box<SvgErrorKind>,
}

/// What went wrong; see [`SvgError::kind`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SvgErrorKind {
    /// The file could not be had as text.
    Read(ReadError),
    /// Not well-formed XML: truncated, say. Holds the cause with line and column.
    Xml(String),
    /// XML, but the root element is not `svg`; holds its name.
    NotSvg(String),
    /// An attribute that does not follow its grammar.
    Malformed {
        /// The element.
        element: ElementName,
        /// Its attribute.
        attribute: String,
        /// Byte offset in the attribute's value where known.
        at: Option<usize>,
        /// In plain words.
        cause: String,
    },
    /// A coordinate that is not finite or beyond [`super::MAX_COORDINATE`] in root user units.
    OutOfRange {
        /// The element.
        element: ElementName,
        /// Number of the segment within the element, from 1.
        segment: usize,
    },
    /// A `use` that shows itself, directly or by way of others.
    Cycle(ElementName),
    /// The document asks for more than the reader's fixed limits allow; holds the element and the limit in words.
    Limit(ElementName, String),
    /// Nothing in the document is a curve. Holds what there was instead, in words.
    NoCurve(String),
}

impl SvgError {
    pub(super) fn new(source: &str, kind: SvgErrorKind) -> Self {
        Self { source: source.to_owned(), kind: Box::new(kind) }
    }

    /// What went wrong.
    pub fn kind(&self) -> &SvgErrorKind {
        &self.kind
    }

    /// Name of the file, or `-`.
    pub fn file(&self) -> &str {
        &self.source
    }
}

impl fmt::Display for SvgError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&one_line(&format!("{}: {}", self.source, self.kind)))
    }
}

impl fmt::Display for SvgErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read(error) => error.fmt(f),
            Self::Xml(cause) => write!(f, "not well-formed XML: {cause}"),
            Self::NotSvg(root) => write!(f, "not an SVG drawing: the root element is “{root}”, not “svg”"),
            Self::Malformed { element, attribute, at: Some(at), cause } => {
                write!(f, "{element}: {attribute}, byte {at}: {cause}")
            }
            Self::Malformed { element, attribute, at: None, cause } => write!(f, "{element}: {attribute}: {cause}"),
            Self::OutOfRange { element, segment } => write!(
                f,
                "{element}: segment {segment} has a coordinate that is not finite or beyond {:e}",
                super::MAX_COORDINATE
            ),
            Self::Cycle(element) => write!(f, "{element}: refers to itself"),
            Self::Limit(element, limit) => write!(f, "{element}: {limit}"),
            Self::NoCurve(what) => write!(f, "no curve to be seen: {what}"),
        }
    }
}

impl std::error::Error for SvgError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &*self.kind {
            SvgErrorKind::Read(error) => Some(error),
            _ => None,
        }
    }
}
