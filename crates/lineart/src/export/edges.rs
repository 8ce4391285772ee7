//! Reconstructed edges as CSV, JSON and as a picture.

use std::io::{self, Write};

use feature_sampling::geometry::Point;

use super::json::JsonText;
use super::number::{JsonNumber, trimmed};

/// Side of the picture of one algorithm, without its margins, in user units of the picture.
const SIDE: f64 = 300.0;
/// Space around each.
const MARGIN: f64 = 20.0;
/// Space for its name.
const TITLE: f64 = 22.0;
/// Pictures in a row.
const COLUMNS: usize = 4;

/// What an algorithm found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EdgesOf {
    /// Its name.
    pub algorithm: &'static str,
    /// Pairs of point numbers, ascending.
    pub edges: Vec<(usize, usize)>,
}

/// Writes `a,b`, or `algorithm,a,b` where `named`.
///
/// # Errors
/// Those of `out`.
pub fn csv(out: &mut dyn Write, results: &[EdgesOf], named: bool) -> io::Result<()> {
    writeln!(out, "{}", if named { "algorithm,a,b" } else { "a,b" })?;
    for result in results {
        for (a, b) in &result.edges {
            if named {
                write!(out, "{},", result.algorithm)?;
            }
            writeln!(out, "{a},{b}")?;
        }
    }
    Ok(())
}

/// Writes `{version, source, points, results: [{algorithm, edges: [[a, b]]}]}`.
///
/// # Errors
/// Those of `out`.
pub fn json(out: &mut dyn Write, source: &str, points: usize, results: &[EdgesOf]) -> io::Result<()> {
    write!(
        out,
        "{{\"version\":1,\"source\":{},\"points\":{},\"results\":[",
        JsonText(source),
        JsonNumber(points as f64)
    )?;
    for (i, result) in results.iter().enumerate() {
        write!(out, "{}\n{{\"algorithm\":{},\"edges\":[", if i > 0 { "," } else { "" }, JsonText(result.algorithm))?;
        for (j, (a, b)) in result.edges.iter().enumerate() {
            write!(out, "{}[{a},{b}]", if j > 0 { "," } else { "" })?;
        }
        write!(out, "]}}")?;
    }
    writeln!(out, "\n]}}")
}

/// Draws points and edges, y downwards, one picture for each algorithm. With the true edges, those that are missing are
/// broken red lines and those that are extra thick red ones.
///
/// # Errors
/// Those of `out`.
pub fn svg(
    out: &mut dyn Write,
    points: &[Point<f64>],
    results: &[EdgesOf],
    truth: Option<&[(usize, usize)]>,
) -> io::Result<()> {
    let fold = |of: fn(&Point<f64>) -> f64| {
        points.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
    };
    let ((left, right), (top, bottom)) = (fold(|p| p.x), fold(|p| p.y));
    // Halves, because the whole extent may be beyond what a double holds.
    let half = (right / 2.0 - left / 2.0).max(bottom / 2.0 - top / 2.0);
    let scale = |v: f64, low: f64| if half > 0.0 { (v / 2.0 - low / 2.0) / half * SIDE } else { SIDE / 2.0 };
    let place = |p: &Point<f64>| [trimmed(scale(p.x, left), 3), trimmed(scale(p.y, top), 3)];
    let [w, h] = [scale(right, left), scale(bottom, top)].map(|v| v.max(SIDE / 4.0) + 2.0 * MARGIN);
    let columns = results.len().clamp(1, COLUMNS);
    let (width, height) = (w * columns as f64, (h + TITLE) * results.len().div_ceil(columns) as f64);
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>",
        trimmed(width, 3),
        trimmed(height, 3)
    )?;
    let radius = (SIDE / (points.len().max(1) as f64).sqrt() / 12.0).clamp(0.2, 2.5);
    for (i, result) in results.iter().enumerate() {
        let (x, y) = (w * (i % columns) as f64 + MARGIN, (h + TITLE) * (i / columns) as f64 + MARGIN);
        writeln!(
            out,
            "<g id=\"{}\" transform=\"translate({} {})\">",
            result.algorithm,
            trimmed(x, 3),
            trimmed(y + TITLE, 3)
        )?;
        let differs = truth.is_some_and(|truth| truth != result.edges);
        let note = if differs { " (differs)" } else { "" };
        writeln!(out, "<text y=\"-12\">{}: {} edges{note}</text>", result.algorithm, result.edges.len())?;
        let in_truth = |edge: &(usize, usize)| truth.is_none_or(|truth| truth.binary_search(edge).is_ok());
        let is_missing = |edge: &&(usize, usize)| result.edges.binary_search(edge).is_err();
        let found = || result.edges.iter();
        let missing = truth.unwrap_or_default().iter().filter(is_missing);
        strokes(out, found().filter(|edge| in_truth(edge)), points, &place, "stroke=\"#000\"")?;
        strokes(out, found().filter(|edge| !in_truth(edge)), points, &place, "stroke=\"#d55e00\" stroke-width=\"2\"")?;
        strokes(out, missing, points, &place, "stroke=\"#d55e00\" stroke-dasharray=\"3 3\"")?;
        write!(out, "<g fill=\"#0072b2\">")?;
        for [x, y] in points.iter().map(place) {
            write!(out, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{}\"/>", trimmed(radius, 2))?;
        }
        writeln!(out, "</g>\n</g>")?;
    }
    writeln!(out, "</svg>")
}

fn strokes<'e>(
    out: &mut dyn Write,
    edges: impl Iterator<Item = &'e (usize, usize)>,
    points: &[Point<f64>],
    place: &impl Fn(&Point<f64>) -> [String; 2],
    style: &str,
) -> io::Result<()> {
    let mut edges = edges.filter_map(|&(a, b)| Some([points.get(a)?, points.get(b)?].map(place))).peekable();
    if edges.peek().is_none() {
        return Ok(());
    }
    write!(out, "<path fill=\"none\" {style} d=\"")?;
    for [[x0, y0], [x1, y1]] in edges {
        write!(out, "M{x0} {y0}L{x1} {y1}")?;
    }
    writeln!(out, "\"/>")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(body: impl Fn(&mut dyn Write) -> io::Result<()>) -> String {
        let mut out = Vec::new();
        body(&mut out).expect("written");
        String::from_utf8(out).expect("text")
    }

    #[test]
    fn all_forms() {
        let results = [EdgesOf { algorithm: "crust", edges: vec![(0, 1), (1, 2)] }];
        let points = [[0.0, 0.0], [1e308, 0.0], [-1e308, 1.0]].map(|[x, y]| Point::new(x, y));
        assert_eq!(written(|out| csv(out, &results, false)), "a,b\n0,1\n1,2\n");
        assert_eq!(written(|out| csv(out, &results, true)), "algorithm,a,b\ncrust,0,1\ncrust,1,2\n");
        let text = written(|out| json(out, "a\"b", 3, &results));
        let value: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!((value["source"].as_str(), &value["results"][0]["edges"][1][1]), (Some("a\"b"), &2.into()));
        let picture = written(|out| svg(out, &points, &results, Some(&[(0, 1), (0, 2)])));
        assert!(!picture.contains("NaN") && !picture.contains("inf"), "{picture}");
        assert!(picture.contains("crust: 2 edges (differs)") && picture.contains("dasharray"), "{picture}");
        let one = written(|out| svg(out, &points[..1], &results[..0], None));
        assert!(one.contains("</svg>"), "nothing to draw");
    }
}
