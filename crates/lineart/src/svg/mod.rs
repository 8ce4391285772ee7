//! SVG in: a document becomes a [`Drawing`].
//!
//! The problem is small to state (which curves does this file draw, and where?) and wide: path data with ten
//! commands, seven shapes, transforms on every level, instances, viewports, units, style. The parts each have a file:
//!
//! ```text
//! walk ── the tree: groups, use, switch, what is rendered; owns the limits
//!  ├─ viewport   lengths, viewBox, physical size          ├─ outline    a pen: commands → subpaths in root units
//!  ├─ transform  affine maps                              │   ├─ path_data  the d attribute
//!  ├─ style      the cascade, inherited properties        │   ├─ shapes     rect, circle, …
//!  │   └─ css    style sheets and declarations            │   └─ arc        elliptical arcs → cubics
//!  └─ fault, error   what is wrong, where
//! ```
//!
//! XML comes from `roxmltree`, the grammars of path data, transforms and lengths from `svgtypes`; why these and not
//! `usvg`, with figures, is in `docs/svg.md`. All arithmetic is in f64.
//!
//! # What is read
//! Everything rendered that has an outline: `path`, `rect`, `circle`, `ellipse`, `line`, `polyline`, `polygon`, in
//! `svg`, `g`, `a`, `switch`, through `use` and `symbol`, whatever the paint (fills have outlines too). Left out
//! without a word: what the document does not show (`display:none`, `visibility:hidden`, `defs`, the branches of a
//! `switch` that lose). Left out with a warning: `text`, `image`, `foreignObject`; `clipPath`, `mask` and `pattern`,
//! which would hide or add lines; markers; references that lead nowhere; transforms that flatten the plane.
//!
//! # What is refused
//! Documents that are not well-formed, and data that do not follow their grammar: see [`SvgErrorKind`]. The reader
//! neither panics nor runs away, whatever it is fed: depth, elements visited and cubics made are bounded by
//! [`MAX_DEPTH`], [`MAX_ELEMENTS`] and [`MAX_CUBICS`], and entities by `roxmltree`.

mod arc;
mod css;
mod error;
mod fault;
mod outline;
mod path_data;
mod shapes;
mod style;
mod transform;
mod viewport;
mod walk;

use std::path::Path;

use roxmltree::{Document, ParsingOptions};

pub use self::error::{ElementName, SvgError, SvgErrorKind};
use crate::drawing::Drawing;
use crate::text_in;

/// The largest coordinate taken, in root user units: 1e100.
///
/// Far beyond any drawing, and far enough inside the range of f64 that squares of distances stay finite.
pub const MAX_COORDINATE: f64 = 1e100;

/// How deep elements may be nested, counting through `use`.
pub const MAX_DEPTH: usize = 1024;

/// How many elements are visited at most, instances counted each time.
pub const MAX_ELEMENTS: usize = 1_000_000;

/// How many cubics a drawing may have.
pub const MAX_CUBICS: usize = 4_000_000;

/// How many XML nodes (elements, texts, comments) a document may have.
const MAX_NODES: u32 = 8_000_000;

/// Reads the SVG file at `path`.
///
/// # Errors
/// [`SvgError`], whose text is one line with file, element and cause.
pub fn read_file(path: &Path) -> Result<Drawing, SvgError> {
    let source = path.display().to_string();
    let text = text_in::read_file(path).map_err(|error| SvgError::new(&source, SvgErrorKind::Read(error)))?;
    read_str(&text, &source)
}

/// Reads an SVG document from memory; `source` names it in messages and in the drawing.
///
/// ```
/// let text = r#"<svg xmlns="http://www.w3.org/2000/svg"><circle r="10"/></svg>"#;
/// let drawing = lineart::svg::read_str(text, "circle.svg")?;
/// assert_eq!(drawing.paths[0].element, "circle");
/// assert_eq!(drawing.paths[0].cubics.len(), 4);
/// # Ok::<(), lineart::svg::SvgError>(())
/// ```
///
/// # Errors
/// [`SvgError`], whose text is one line with file, element and cause.
pub fn read_str(text: &str, source: &str) -> Result<Drawing, SvgError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let fail = |kind| SvgError::new(source, kind);
    // Drawing programs of the 2000s declare their namespaces as entities, so document types are allowed.
    let options = ParsingOptions { allow_dtd: true, nodes_limit: MAX_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| fail(xml_error(error, text)))?;
    walk::read(&document, source).map_err(fail)
}

fn xml_error(error: roxmltree::Error, text: &str) -> SvgErrorKind {
    use roxmltree::Error as E;
    let cause = match error {
        _ if text.trim().is_empty() => "the file is empty".to_owned(),
        E::UnclosedRootNode | E::UnexpectedEndOfStream => "the file ends before its elements are closed".to_owned(),
        E::NodesLimitReached => format!("more than {MAX_NODES} nodes"),
        E::NoRootNode => "there is no element in it".to_owned(),
        // roxmltree's messages end in “at line:column”.
        other => other.to_string(),
    };
    SvgErrorKind::Xml(cause)
}
