//! Control points from CSV: `path,closed,x0,y0,x1,y1,x2,y2,x3,y3`, one cubic per line.
//!
//! For drawings that come from a program rather than from a drawing program. `path` is a whole number that groups
//! the lines of one path; they stand together, in order along the path, each cubic starting where the one before
//! ended. `closed` is 1, true, 0 or false, the same for all lines of a path; a closed path whose ends differ gets a
//! straight closing line, as SVG's `Z` gives it. A header line (its first field is not a number), empty lines and
//! lines that start with `#` are skipped. Paths are numbered in order of appearance; the number written in the file
//! is kept as the path's id.
//!
//! Ends that meet in print may differ in their last digit: a gap of up to [`JOIN_TOLERANCE`] of the diagonal is
//! closed by moving the start of the later cubic. A wider gap is an error, since it is not said what bridges it.

use std::fmt;

use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::Point;

use crate::drawing::{Drawing, DrawingPath};
use crate::svg::MAX_COORDINATE;
use crate::text_in::one_line;

/// The widest gap between consecutive cubics that is closed without a word, in diagonals of the bounding box of all
/// control points. The same figure below which the kernel drops segments.
pub const JOIN_TOLERANCE: f64 = 2e-6;

/// A CSV of control points that could not be read. `Display` gives one line: file, line, cause.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CsvError {
    source: String,
    /// Number of the line, from 1; none where the whole file is meant.
    line: Option<usize>,
    cause: String,
}

impl CsvError {
    /// Number of the line, from 1; none where the whole file is meant.
    pub fn line(&self) -> Option<usize> {
        self.line
    }
}

impl fmt::Display for CsvError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self.line {
            Some(line) => format!("{}: line {line}: {}", self.source, self.cause),
            None => format!("{}: {}", self.source, self.cause),
        };
        f.write_str(&one_line(&text))
    }
}

impl std::error::Error for CsvError {}

/// One line of the file.
struct Row {
    line: usize,
    path: u64,
    closed: bool,
    cubic: Cubic<f64>,
}

/// Reads a CSV of control points; `source` names it in messages and in the drawing.
///
/// ```
/// let text = "path,closed,x0,y0,x1,y1,x2,y2,x3,y3\n0,false,0,0,1,2,3,2,4,0\n";
/// let drawing = lineart::csv_in::read_str(text, "arch.csv")?;
/// assert_eq!(drawing.paths.len(), 1);
/// # Ok::<(), lineart::csv_in::CsvError>(())
/// ```
///
/// # Errors
/// [`CsvError`], with the number of the line.
pub fn read_str(text: &str, source: &str) -> Result<Drawing, CsvError> {
    let fail = |line: Option<usize>, cause: String| CsvError { source: source.to_owned(), line, cause };
    let mut rows = Vec::new();
    let mut header_may_come = true;
    for (index, line) in text.strip_prefix('\u{feff}').unwrap_or(text).lines().enumerate() {
        let content = line.trim();
        if content.is_empty() || content.starts_with('#') {
            continue;
        }
        let first = content.split(',').next().unwrap_or_default().trim();
        if std::mem::take(&mut header_may_come) && first.parse::<f64>().is_err() {
            continue;
        }
        rows.push(row(content, index + 1).map_err(|cause| fail(Some(index + 1), cause))?);
    }
    if rows.is_empty() {
        return Err(fail(None, "no curve in it: no line of control points".to_owned()));
    }
    let join = JOIN_TOLERANCE * diagonal(&rows);
    let mut paths: Vec<DrawingPath> = Vec::new();
    let mut numbers = std::collections::HashSet::new();
    let mut previous: Option<(u64, usize)> = None;
    for mut row in rows {
        let at = Some(row.line);
        match (previous, paths.last_mut()) {
            (Some((number, before)), Some(path)) if number == row.path => {
                if path.closed != row.closed {
                    return Err(fail(at, format!("path {number} was said to be closed and open")));
                }
                if let Some(last) = path.cubics.last() {
                    if row.cubic.start().distance(last.end()) > join {
                        return Err(fail(at, format!("the cubic does not start where that of line {before} ends")));
                    }
                    row.cubic.points[0] = *last.end();
                }
                path.cubics.push(row.cubic);
            }
            _ => {
                if !numbers.insert(row.path) {
                    return Err(fail(at, format!("the lines of path {} do not stand together", row.path)));
                }
                paths.push(DrawingPath {
                    id: Some(row.path.to_string()),
                    element: "csv".to_owned(),
                    closed: row.closed,
                    cubics: vec![row.cubic],
                    ..DrawingPath::default()
                });
            }
        }
        previous = Some((row.path, row.line));
    }
    for path in paths.iter_mut().filter(|path| path.closed) {
        if let (Some(first), Some(last)) = (path.cubics.first(), path.cubics.last())
            && first.start() != last.end()
        {
            let closing = Cubic::line(*last.end(), *first.start());
            path.cubics.push(closing);
        }
    }
    Ok(Drawing { source: source.to_owned(), paths, ..Drawing::default() })
}

fn row(text: &str, line: usize) -> Result<Row, String> {
    let fields: Vec<&str> = text.split(',').map(str::trim).collect();
    let [path, closed, points @ ..] = fields.as_slice() else {
        return Err(format!("{} fields instead of 10", fields.len()));
    };
    if points.len() != 8 {
        return Err(format!("{} fields instead of 10", fields.len()));
    }
    let path = path.parse().map_err(|_| format!("the path number “{path}” is not a whole number from 0"))?;
    let closed = match closed.to_ascii_lowercase().as_str() {
        "1" | "true" => true,
        "0" | "false" => false,
        _ => return Err(format!("closed is “{closed}”, not 0, 1, false or true")),
    };
    let mut xy = [0.0_f64; 8];
    for (value, text) in xy.iter_mut().zip(points) {
        *value = text.parse().map_err(|_| format!("“{text}” is not a number"))?;
        if !value.is_finite() || value.abs() > MAX_COORDINATE {
            return Err(format!("the coordinate “{text}” is not finite or beyond {MAX_COORDINATE:e}"));
        }
    }
    let [x0, y0, x1, y1, x2, y2, x3, y3] = xy;
    let cubic = Cubic::new(Point::new(x0, y0), Point::new(x1, y1), Point::new(x2, y2), Point::new(x3, y3));
    Ok(Row { line, path, closed, cubic })
}

fn diagonal(rows: &[Row]) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in rows.iter().flat_map(|row| &row.cubic.points) {
        low = [low[0].min(point.x), low[1].min(point.y)];
        high = [high[0].max(point.x), high[1].max(point.y)];
    }
    (high[0] - low[0]).hypot(high[1] - low[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        read_str(text, "f.csv").unwrap_err().to_string()
    }

    #[test]
    fn paths_are_read_in_order() {
        let text = "path,closed,x0,y0,x1,y1,x2,y2,x3,y3\n\
                    # a comment\n\
                    7,0, 0,0, 1,0, 2,0, 3,0\n\n\
                    7,false,3,0,4,0,5,0,6,1e0\r\n\
                    2,TRUE,0,0,0,9,9,9,9,0\n";
        let drawing = read_str(text, "-").unwrap();
        let shape: Vec<_> = drawing.paths.iter().map(|p| (p.id.as_deref(), p.closed, p.cubics.len())).collect();
        assert_eq!(shape, [(Some("7"), false, 2), (Some("2"), true, 2)]);
        assert_eq!(drawing.paths[1].cubics[1], Cubic::line(Point::new(9.0, 0.0), Point::new(0.0, 0.0)));
        assert_eq!(drawing.source, "-");
        assert_eq!(drawing.user_units_per_mm, None);
    }

    #[test]
    fn a_gap_of_rounding_is_closed() {
        let drawing = read_str("0,0,0,0,1,0,2,0,3,0\n0,0,3.000001,0,4,0,5,0,6,0", "-").unwrap();
        assert_eq!(drawing.paths[0].cubics[1].points[0], Point::new(3.0, 0.0));
    }

    #[test]
    fn errors_name_the_line() {
        assert_eq!(message("h\n0,0,1,2,3"), "f.csv: line 2: 5 fields instead of 10");
        assert_eq!(message("0,0,1,2,3,4,5,6,7,8,9"), "f.csv: line 1: 11 fields instead of 10");
        assert_eq!(message("0,0,1,2,3,4,5,6,7,x"), "f.csv: line 1: “x” is not a number");
        assert_eq!(message("0,2,1,2,3,4,5,6,7,8"), "f.csv: line 1: closed is “2”, not 0, 1, false or true");
        assert_eq!(message("-1,0,1,2,3,4,5,6,7,8"), "f.csv: line 1: the path number “-1” is not a whole number from 0");
        for bad in ["NaN", "inf", "-inf", "1e300", "1e999"] {
            let expected = format!("f.csv: line 1: the coordinate “{bad}” is not finite or beyond 1e100");
            assert_eq!(message(&format!("0,0,1,2,3,4,5,6,7,{bad}")), expected);
        }
        let gap = "0,0,0,0,1,0,2,0,3,0\n0,0,3.1,0,4,0,5,0,6,0";
        assert_eq!(message(gap), "f.csv: line 2: the cubic does not start where that of line 1 ends");
        let apart = "0,0,0,0,1,0,2,0,3,0\n1,0,0,0,1,0,2,0,3,0\n0,0,3,0,4,0,5,0,6,0";
        assert_eq!(message(apart), "f.csv: line 3: the lines of path 0 do not stand together");
        let mixed = "0,0,0,0,1,0,2,0,3,0\n0,1,3,0,4,0,5,0,6,0";
        assert_eq!(message(mixed), "f.csv: line 2: path 0 was said to be closed and open");
        assert_eq!(message("path,closed\n"), "f.csv: no curve in it: no line of control points");
        assert_eq!(message(""), "f.csv: no curve in it: no line of control points");
    }
}
