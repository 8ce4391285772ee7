//! `fsample nearest`.
//!
//! This is about the drawing as it is drawn: every cubic of the file, kinks and slivers included, without what the door of
//! the sampler smooths or drops. So the answer can be checked against the file by anyone.

use std::fmt::Write as _;

use feature_sampling::bezier::PowerBasis;
use feature_sampling::bezier::nearest::{Nearest, nearest};
use feature_sampling::geometry::Point;
use feature_sampling::geometry::hierarchy::{Hierarchy, Item, Node, build};
use lineart::drawing::Drawing;
use lineart::export::number::Number;

use crate::errors::Failure;
use crate::input;
use crate::number_in::number;
use crate::options::NearestArgs;
use crate::output::{Format, Target};

/// Columns of the result.
const HEADER: &str = "x,y,path,segment,t,px,py,distance";

/// Finds the point of the drawing that is closest to each query.
pub(crate) fn run(args: &NearestArgs) -> Result<(), Failure> {
    let target = Target::new(args.output.output.as_deref(), args.output.format.as_deref(), &[Format::Csv])?;
    let from_stdin = args.queries.iter().filter(|query| *query == "-").count();
    if from_stdin > 1 || (from_stdin == 1 && args.input.file == "-") {
        return Err(Failure::usage("standard input can be read once: for the drawing, or for one list of queries"));
    }
    let mut queries = Vec::new();
    for text in args.queries.iter().filter(|query| *query != "-") {
        query(text)?;
    }
    let drawing = input::drawing(&args.input.file, args.quiet)?;
    for text in &args.queries {
        if text == "-" {
            queries.extend(input::points("-")?);
        } else {
            queries.push(query(text)?);
        }
    }
    target.check_folder()?;
    let index = Index::new(&drawing);
    let mut rows = String::with_capacity(queries.len() * 100);
    rows.push_str(HEADER);
    rows.push('\n');
    for q in &queries {
        let Some((piece, found)) = index.nearest(q) else {
            return Err(Failure::input(&args.input.file, format!("({}, {}) is too far away", q.x, q.y)));
        };
        let [x, y, t] = [q.x, q.y, found.t].map(Number);
        let [px, py, distance] = [found.point.x, found.point.y, found.distance_sq.sqrt()].map(Number);
        // Writing to a string cannot fail.
        let _ = writeln!(rows, "{x},{y},{},{},{t},{px},{py},{distance}", piece.path, piece.segment);
    }
    target.write(|out| out.write_all(rows.as_bytes()))
}

/// `X,Y`.
fn query(text: &str) -> Result<Point<f64>, Failure> {
    let usage = |cause: &str| Failure::usage(format!("“{text}” is not a query: {cause}"));
    let (x, y) = text.split_once(',').ok_or_else(|| usage("write X,Y, or - for a list on standard input"))?;
    let coordinate = |text: &str| number(text.trim()).map_err(|cause| usage(&cause));
    Ok(Point::new(coordinate(x)?, coordinate(y)?))
}

/// A cubic of the drawing.
struct Piece {
    path: usize,
    segment: usize,
    curve: PowerBasis<f64>,
}

/// The cubics of a drawing, by their boxes.
struct Index {
    pieces: Vec<Piece>,
    nodes: Vec<Node<f64>>,
}

impl Index {
    fn new(drawing: &Drawing) -> Self {
        let mut pieces = Vec::new();
        let mut items = Vec::new();
        for (path, chain) in drawing.paths.iter().enumerate() {
            for (segment, cubic) in chain.cubics.iter().enumerate() {
                items
                    .push(Item { bounds: cubic.control_box(), index: u32::try_from(pieces.len()).unwrap_or(u32::MAX) });
                pieces.push(Piece { path, segment, curve: cubic.power_basis() });
            }
        }
        let mut nodes = Vec::with_capacity(2 * items.len());
        // A vector takes whatever is pushed, and 40 levels hold more cubics than memory.
        let built = build(&mut items, &mut nodes);
        debug_assert!(built.is_ok(), "a tree of {} cubics", pieces.len());
        Self { pieces, nodes }
    }

    /// The closest point; of equally close ones, that of the first cubic. `None` where squares overflow.
    fn nearest(&self, q: &Point<f64>) -> Option<(&Piece, Nearest<f64>)> {
        let mut best: Option<(u32, Nearest<f64>)> = None;
        // One step beyond the best, so that equally close cubics are looked at too.
        let bound = |best: &Option<(u32, Nearest<f64>)>| best.map_or(f64::INFINITY, |(_, n)| n.distance_sq.next_up());
        Hierarchy::new(&self.nodes).nearest_first(q, &mut best, bound, |best, index| {
            let Some(piece) = self.pieces.get(index as usize) else { return };
            let found = nearest(&piece.curve, q);
            let is_better = best.is_none_or(|(first, other)| {
                found.distance_sq < other.distance_sq || (found.distance_sq == other.distance_sq && index < first)
            });
            if is_better && found.distance_sq.is_finite() {
                *best = Some((index, found));
            }
        });
        best.and_then(|(index, found)| Some((self.pieces.get(index as usize)?, found)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lineart::svg;

    #[test]
    fn the_first_of_equally_close_cubics() {
        let text = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">
            <path d="M 0,0 L 2,0 L 2,2"/><path d="M 2,0 L 4,0"/><path d="M 0,5 L 4,5"/></svg>"#;
        let drawing = svg::read_str(text, "test.svg").expect("a drawing");
        let index = Index::new(&drawing);
        let answer = |x: f64, y: f64| index.nearest(&Point::new(x, y)).map(|(p, n)| (p.path, p.segment, n.distance_sq));
        assert_eq!(answer(2.0, -1.0), Some((0, 0, 1.0)), "the end of the first segment, not the start of others");
        assert_eq!(answer(3.0, -1.0), Some((1, 0, 1.0)));
        assert_eq!(answer(1.0, 2.5), Some((0, 1, 1.25)));
        assert_eq!(answer(0.0, 6.0), Some((2, 0, 1.0)));
        assert_eq!(answer(1e300, 0.0), None, "squares overflow");
    }

    #[test]
    fn queries_are_two_finite_numbers() {
        assert_eq!(query("1,-0x1p1").ok(), Some(Point::new(1.0, -2.0)));
        for bad in ["", "1", "1,2,3", "1,inf", "a,b", "1;2"] {
            assert!(query(bad).is_err(), "{bad}");
        }
    }
}
