//! A drawing as the rest of the program sees it: paths of cubics, and where each came from.
//!
//! Readers ([`crate::svg`], [`crate::csv_in`]) make a [`Drawing`]; samplers and writers only read it. Everything
//! that a file format can say about placement (transforms, `<use>`, units, shapes) has been worked out by then, so
//! that all coordinates are f64 in one frame: the user units of the root `viewBox`, y downwards. What a reader left
//! out or could not honour is listed in [`Drawing::warnings`]; nothing is dropped silently.
//!
//! The order of [`Drawing::paths`] is the order of the document and is part of the interface: the index of a path
//! is the `path` column of every output.

use std::fmt;
use std::path::Path;

use feature_sampling::bezier::Cubic;

use crate::csv_in::{self, CsvError};
use crate::svg::{self, SvgError};
use crate::text_in::{self, ReadError, one_line};

/// A whole drawing: subpaths in document order, with their groups and layers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Name of the file that was read, or `-` for standard input.
    pub source: String,
    /// The root `viewBox` in user units: x, y, width, height. `None` where the document has none.
    pub view_box: Option<[f64; 4]>,
    /// How many user units make a millimetre; `None` where the document gives no physical size.
    ///
    /// A `width` or `height` in plain numbers or `px` is a physical size: CSS fixes 96 px to the inch. So is a
    /// document with no `viewBox` at all, whose user unit is the px. A document with a `viewBox` but neither
    /// `width` nor `height` (or with percentages there) takes the size of whatever shows it: that is `None`.
    pub user_units_per_mm: Option<f64>,
    /// Groups, parents before children.
    pub groups: Vec<Group>,
    /// Subpaths in document order.
    pub paths: Vec<DrawingPath>,
    /// What was left out or not honoured, in document order.
    pub warnings: Vec<Warning>,
}

/// A container element: `g`, `a`, `switch`, a nested `svg`, a `use`, or the `symbol` a `use` refers to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// Index in [`Drawing::groups`] of the group around this one; always smaller than this group's own index.
    pub parent: Option<usize>,
    /// The `id` attribute.
    pub id: Option<String>,
    /// The `inkscape:label` attribute: the name a layer has in Inkscape's dialogue.
    pub label: Option<String>,
    /// The group says `inkscape:groupmode="layer"`.
    pub is_layer: bool,
}

/// One subpath: a chain of cubics, each starting where the one before ended.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawingPath {
    /// The `id` of the element; instances made by `use` share the id of the element they repeat.
    pub id: Option<String>,
    /// Index in [`Drawing::groups`] of the innermost group around the element.
    pub group: Option<usize>,
    /// Name of the element: `path`, `rect`, `circle`…
    pub element: String,
    /// Which subpath of its element this is, from 0.
    pub subpath: usize,
    /// The path says that it is closed (`Z`, or a shape that is). Its last cubic then ends where its first starts,
    /// to the bit: a closing line was added where the ends differed, however short it is.
    pub closed: bool,
    /// The cubics, at least one.
    pub cubics: Vec<Cubic<f64>>,
    /// The fill paint as written; `None` where there is no fill. Without a word in the document it is black.
    pub fill: Option<String>,
    /// The stroke paint as written; `None` where there is no stroke.
    pub stroke: Option<String>,
    /// The stroke width in root user units (scaled by the square root of the transform's determinant); `None` where
    /// there is no stroke.
    pub stroke_width: Option<f64>,
    /// The number in the attribute `data-value` of the element or of the nearest one around it: a value that simulations
    /// are given along the path.
    pub value: Option<f64>,
}

/// Something in the document that was left out or not honoured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Warning {
    /// The element: tag, id where it has one, line and column.
    pub element: String,
    /// What happened to it and why, in plain words.
    pub message: String,
}

/// A drawing that could not be loaded. `Display` gives one line: file, place, cause.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum LoadError {
    /// The file or standard input could not be had as text.
    Read {
        /// Name of the file, or `-`.
        source: String,
        /// What went wrong.
        error: ReadError,
    },
    /// It is an SVG drawing that cannot be read.
    Svg(SvgError),
    /// It is a CSV of control points that cannot be read.
    Csv(CsvError),
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read { source, error } => write!(f, "{}: {error}", one_line(source)),
            Self::Svg(error) => error.fmt(f),
            Self::Csv(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for LoadError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Read { error, .. } => Some(error),
            Self::Svg(error) => error.source(),
            Self::Csv(_) => None,
        }
    }
}

/// Loads a drawing from a file, or from standard input where the name is `-`.
///
/// The format follows the extension, `.svg` or `.csv`; where that does not tell, a text that starts with `<` is SVG.
///
/// # Errors
/// [`LoadError`], whose text is one line with file, place and cause.
pub fn load(path: impl AsRef<Path>) -> Result<Drawing, LoadError> {
    let path = path.as_ref();
    let source = path.display().to_string();
    let text = if source == "-" { text_in::read(std::io::stdin().lock()) } else { text_in::read_file(path) };
    let text = text.map_err(|error| LoadError::Read { source: source.clone(), error })?;
    let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let is_svg = match extension.as_deref() {
        Some("svg") => true,
        Some("csv") => false,
        _ => text.trim_start().starts_with('<'),
    };
    if is_svg {
        svg::read_str(&text, &source).map_err(LoadError::Svg)
    } else {
        csv_in::read_str(&text, &source).map_err(LoadError::Csv)
    }
}
