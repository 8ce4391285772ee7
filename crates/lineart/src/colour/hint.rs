//! Hints: which colour belongs where.
//!
//! A hint is a dot (one point) or a scribble (a polyline), with a colour or with none, which keeps a place empty. Hints
//! come as lines of text, `x,y,colour`, or from a layer of the drawing. In a layer a filled shape is a dot at the centroid
//! of its control points, in the colour of its fill (of its stroke, if it has no fill); an open path with a stroke is a
//! scribble in the colour of its stroke. A scribble that crosses a stroke of the drawing colours both sides.

use std::fmt;
use std::str::FromStr;

use feature_sampling::geometry::Point;

use crate::drawing::{Drawing, DrawingPath};

/// An opaque colour, written `#rrggbb`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Colour(String);

impl Colour {
    /// The colour that a CSS colour (`#rgb`, `#rrggbb`, `rgb(…)`, a name) stands for; transparency is ignored. `None` if it
    /// is not one.
    pub fn named(text: &str) -> Option<Self> {
        let colour = svgtypes::Color::from_str(text.trim()).ok()?;
        Some(Self(format!("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue)))
    }
}

impl fmt::Display for Colour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Six colours that are easily told apart, and light enough for black lines on them.
pub const PALETTE: [&str; 6] = ["#8ecae6", "#ffd166", "#a7c957", "#f4978e", "#cdb4db", "#f2cc8f"];

/// A hint.
#[derive(Clone, Debug, PartialEq)]
pub struct Hint {
    /// A point, or a polyline; in user units.
    pub points: Vec<Point<f64>>,
    /// The colour; none keeps the place empty.
    pub colour: Option<Colour>,
}

impl Hint {
    /// A dot; `None` if it is not a colour that [`Colour::named`] knows.
    pub fn at(point: Point<f64>, colour: &str) -> Option<Self> {
        Colour::named(colour).map(|colour| Self { points: vec![point], colour: Some(colour) })
    }
}

/// What is wrong with a hint.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum HintError {
    /// It is not of the form `x,y,colour`.
    Form(String),
    /// Its coordinates are not finite numbers.
    Point(String),
    /// It is not a colour.
    Colour(String),
}

impl fmt::Display for HintError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Form(text) => write!(f, "“{text}” is not a hint: write “x,y,colour”"),
            Self::Point(text) => write!(f, "“{text}” does not begin with two finite numbers"),
            Self::Colour(text) => write!(f, "“{text}” is not a colour: write #rgb, #rrggbb, a CSS name, or none"),
        }
    }
}

impl std::error::Error for HintError {}

impl FromStr for Hint {
    type Err = HintError;

    fn from_str(text: &str) -> Result<Self, HintError> {
        let mut fields = text.splitn(3, ',').map(str::trim);
        let (Some(x), Some(y), Some(colour)) = (fields.next(), fields.next(), fields.next()) else {
            return Err(HintError::Form(text.trim().to_owned()));
        };
        let coordinate = |text: &str| text.parse::<f64>().ok().filter(|v| v.is_finite() && v.abs() <= 1e100);
        let (Some(x), Some(y)) = (coordinate(x), coordinate(y)) else {
            return Err(HintError::Point(text.trim().to_owned()));
        };
        let colour = paint(colour).ok_or_else(|| HintError::Colour(colour.to_owned()))?;
        Ok(Self { points: vec![Point::new(x, y)], colour })
    }
}

/// A colour, or the word `none`; nothing where it is neither.
fn paint(text: &str) -> Option<Option<Colour>> {
    match text {
        text if text.eq_ignore_ascii_case("none") => Some(None),
        text => Colour::named(text).map(Some),
    }
}

/// Hints from lines `x,y,colour`. Empty lines, lines that start with `#`, and one header line are skipped.
///
/// # Errors
/// The number of the line, from 1, and what is wrong with it.
pub fn parse_hints(text: &str) -> Result<Vec<Hint>, (usize, HintError)> {
    let mut hints = Vec::new();
    let mut header_may_follow = true;
    for (number, line) in (1..).zip(text.lines()) {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        match line.parse() {
            Ok(hint) => hints.push(hint),
            // A header has words where points have numbers.
            Err(HintError::Point(_)) if header_may_follow => {}
            Err(error) => return Err((number, error)),
        }
        header_may_follow = false;
    }
    Ok(hints)
}

/// Takes the hints out of a drawing: all paths in a group whose id or Inkscape label is `layer`. Shapes whose paint is not
/// a plain colour are left out and named in the warnings.
pub fn from_layer(drawing: &mut Drawing, layer: &str) -> (Vec<Hint>, Vec<String>) {
    let mut inside: Vec<bool> = Vec::with_capacity(drawing.groups.len());
    for group in &drawing.groups {
        let named = [&group.id, &group.label].into_iter().flatten().any(|name| name == layer);
        let outer = group.parent.and_then(|parent| inside.get(parent)).copied().unwrap_or(false);
        inside.push(named || outer);
    }
    let is_hint = |path: &DrawingPath| path.group.is_some_and(|group| inside[group]);
    let (mut hints, mut warnings) = (Vec::new(), Vec::new());
    for path in drawing.paths.iter().filter(|path| is_hint(path)) {
        let is_scribble = !path.closed && path.stroke.is_some();
        let paint_text =
            if is_scribble { &path.stroke } else { path.fill.as_ref().map_or(&path.stroke, |_| &path.fill) };
        match paint_text.as_deref().and_then(Colour::named) {
            Some(colour) => hints.push(Hint { points: points(path, is_scribble), colour: Some(colour) }),
            None => {
                let id = path.id.as_deref().map_or_else(String::new, |id| format!(" “{id}”"));
                let paint = paint_text.as_deref().unwrap_or("none");
                warnings.push(format!("the hint {}{id} has no plain colour ({paint}) and is left out", path.element));
            }
        }
    }
    drawing.paths.retain(|path| !is_hint(path));
    (hints, warnings)
}

fn points(path: &DrawingPath, is_scribble: bool) -> Vec<Point<f64>> {
    const STEPS: u32 = 8;
    let along =
        path.cubics.iter().flat_map(|cubic| (0..=STEPS).map(|i| cubic.eval(&(f64::from(i) / f64::from(STEPS)))));
    let mut along: Vec<Point<f64>> = along.collect();
    along.dedup();
    if is_scribble {
        return along;
    }
    let count = along.len().max(1) as f64;
    let sum = along.iter().fold(Point::new(0.0, 0.0), |sum, p| Point::new(sum.x + p.x, sum.y + p.y));
    vec![Point::new(sum.x / count, sum.y / count)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hints_as_people_write_them() {
        let hints = parse_hints("x,y,colour\n# two\n1, 2 ,red\n\n-3.5,4e-1,#0f8\n5,6,none\n").expect("hints");
        let colours: Vec<_> = hints.iter().map(|h| h.colour.as_ref().map(ToString::to_string)).collect();
        assert_eq!(colours, [Some("#ff0000".to_owned()), Some("#00ff88".to_owned()), None], "colours and none");
        assert_eq!(hints[1].points, [Point::new(-3.5, 0.4)], "points");
        let rgb = "7,8,rgb(1, 2, 3)".parse::<Hint>().expect("a colour with commas");
        assert_eq!(rgb.colour, Colour::named("#010203"), "rgb()");
    }

    #[test]
    fn refusals_name_the_line() {
        assert!(matches!(parse_hints("1,2,red\n1,2"), Err((2, HintError::Form(_)))), "two fields");
        assert!(matches!(parse_hints("1,2,red\nx,y,red"), Err((2, HintError::Point(_)))), "a header comes first");
        assert!(matches!(parse_hints("1,2,nonsuch"), Err((1, HintError::Colour(_)))), "no colour");
        assert!(matches!(parse_hints("1,inf,red\n1,nan,red"), Err((2, HintError::Point(_)))), "not finite");
    }
}
