//! Drawings and points on their way in.

use std::io;
use std::path::Path;

use feature_sampling::geometry::Point;
use lineart::drawing::Drawing;
use lineart::{csv_in, svg, text_in};

use crate::errors::{Failure, warn};

/// Reads a drawing: SVG, or control points as CSV where the name ends so. Standard input is told apart by its first
/// character. What the reader left out is said on standard error.
pub(crate) fn drawing(file: &str, quiet: bool) -> Result<Drawing, Failure> {
    drawing_and_text(file, quiet).map(|(drawing, _)| drawing)
}

/// The same, with the text that it was read from.
pub(crate) fn drawing_and_text(file: &str, quiet: bool) -> Result<(Drawing, String), Failure> {
    let text = text(file)?;
    let is_csv = if file == "-" {
        // An XML document starts with <, a table with a digit, the header or a comment.
        text.trim_start().starts_with(|c: char| c.is_ascii_digit() || c == '#') || text.trim_start().starts_with("path")
    } else {
        Path::new(file).extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"))
    };
    let drawing = if is_csv {
        csv_in::read_str(&text, file).map_err(Failure::read)?
    } else {
        svg::read_str(&text, file).map_err(Failure::read)?
    };
    if !quiet {
        for warning in &drawing.warnings {
            warn(format!("{file}: {}: {}", warning.element, warning.message));
        }
    }
    if drawing.paths.is_empty() {
        let left_out = match drawing.warnings.len() {
            0 => String::new(),
            count => format!(" ({count} left out, see the warnings)"),
        };
        return Err(Failure::input(file, format!("there is no curve in it{left_out}")));
    }
    Ok((drawing, text))
}

/// Reads points, one `x y` or `x,y` per line. Empty lines, `#` comments and one header line are skipped.
pub(crate) fn points(file: &str) -> Result<Vec<Point<f64>>, Failure> {
    parse_points(&text(file)?).map_err(|(line, cause)| Failure::input(file, format!("line {line}: {cause}")))
}

/// Reads edges, two point numbers a line (`a,b` or `a b`), with the number of the line of each. Empty lines, `#` comments
/// and one header line are skipped.
pub(crate) fn edges(file: &str) -> Result<Vec<(usize, [usize; 2])>, Failure> {
    let text = text(file)?;
    let mut edges = Vec::new();
    let mut header_may_follow = true;
    for (line, content) in content_lines(&text) {
        let numbers: Vec<Option<usize>> = fields(content).map(|field| field.parse().ok()).collect();
        match numbers.as_slice() {
            [Some(a), Some(b)] => edges.push((line, [*a, *b])),
            [None, ..] if header_may_follow => {}
            _ => return Err(Failure::input(file, format!("line {line}: “{content}” is not an edge: write “a,b”"))),
        }
        header_may_follow = false;
    }
    Ok(edges)
}

/// A sample as a table of samples has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GivenSample {
    pub(crate) line: usize,
    pub(crate) path: u32,
    pub(crate) segment: u32,
    pub(crate) t: f64,
    pub(crate) x: f64,
    pub(crate) y: f64,
}

/// Reads samples as `fsample sample` writes them: path,segment,t,x,y and more columns, which are not looked at.
pub(crate) fn samples(file: &str) -> Result<Vec<GivenSample>, Failure> {
    let text = text(file)?;
    let mut samples = Vec::new();
    let mut header_may_follow = true;
    for (line, content) in content_lines(&text) {
        let found: Vec<&str> = fields(content).collect();
        let row = match found.as_slice() {
            [path, segment, t, x, y, ..] => (|| {
                let (path, segment) = (path.parse().ok()?, segment.parse().ok()?);
                let [t, x, y] = [t, x, y].map(|v| v.parse::<f64>().ok().filter(|v| v.is_finite()));
                Some(GivenSample { line, path, segment, t: t.filter(|t| (0.0..=1.0).contains(t))?, x: x?, y: y? })
            })(),
            _ => None,
        };
        match row {
            Some(row) => samples.push(row),
            None if header_may_follow && content.starts_with("path") => {}
            None => {
                let expected = "is not a sample: write “path,segment,t,x,y”, t from 0 to 1";
                return Err(Failure::input(file, format!("line {line}: “{content}” {expected}")));
            }
        }
        header_may_follow = false;
    }
    Ok(samples)
}

/// Lines with something other than a comment on them, with their numbers from 1.
fn content_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    (1..).zip(text.lines()).filter_map(|(line, content)| {
        let content = content.split('#').next().unwrap_or_default().trim();
        (!content.is_empty()).then_some((line, content))
    })
}

/// What stands between commas and blanks.
fn fields(content: &str) -> impl Iterator<Item = &str> {
    content.split(|c: char| c == ',' || c.is_whitespace()).filter(|field| !field.is_empty())
}

fn parse_points(text: &str) -> Result<Vec<Point<f64>>, (usize, String)> {
    let mut points = Vec::new();
    let mut header_may_follow = true;
    for (line, content) in content_lines(text) {
        let numbers: Vec<Option<f64>> = fields(content).map(|field| field.parse().ok()).collect();
        match numbers.as_slice() {
            [Some(x), Some(y)] if x.is_finite() && y.is_finite() => points.push(Point::new(*x, *y)),
            [Some(_), Some(_)] => return Err((line, format!("“{content}” is not a finite point"))),
            // A header has words where points have numbers.
            [None, ..] if header_may_follow => {}
            _ => return Err((line, format!("“{content}” is not a point: write “x y” or “x,y”"))),
        }
        header_may_follow = false;
    }
    Ok(points)
}

/// Reads a text file; `-` is standard input.
pub(crate) fn text(file: &str) -> Result<String, Failure> {
    let read = if file == "-" { text_in::read(io::stdin().lock()) } else { text_in::read_file(Path::new(file)) };
    read.map_err(|error| Failure::input(file, error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_as_people_write_them() {
        let points = parse_points("# two\nx,y\n1,2\n\n 3\t-4e-1 # here\n").expect("points");
        assert_eq!(points, [Point::new(1.0, 2.0), Point::new(3.0, -0.4)], "commas, blanks, comments, a header");
        let line = |text| parse_points(text).map_err(|(line, _)| line);
        assert_eq!(line("1 2\nx y\n"), Err(2), "a header comes first");
        assert_eq!(line("1 2 3"), Err(1), "three numbers");
        assert_eq!(line("1 2\n1"), Err(2), "one number");
        assert_eq!(line("1 inf"), Err(1), "not finite");
        assert_eq!(line(""), Ok(vec![]), "no points");
    }
}
