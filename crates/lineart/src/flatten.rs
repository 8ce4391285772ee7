//! Other ways to turn curves into points, and the figures by which to compare them.
//!
//! A plotter driver, a viewer or a mesher has to flatten curves somehow. The usual ways are here, each in its plainest
//! form and written from its published description, so that `fsample compare` can set them beside ε-samples of the same
//! drawing: greedy chord-error flattening ([`by_chord_error`]), a fixed number of steps per cubic ([`uniform`]), pieces
//! of a given length ([`by_length`], as vpype does on reading), and the splitter that plotter firmware runs on a G5
//! command ([`by_midpoint`]). None of them looks at anything but one path at a time.
//!
//! Straight cubics stay one piece wherever the method cuts cubic by cubic: none of those tools cuts lines.

use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::Point;
use spade::InsertionError;

use crate::delaunay::missing_edges;
use crate::stretch::{Location, between, is_straight, length, pieces};

/// A point on a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Where on the path.
    pub at: Location,
    /// The point itself.
    pub point: Point<f64>,
}

/// A path cut into chords.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// The last vertex is followed by the first, which is not repeated.
    pub closed: bool,
    /// The vertices, in the order of the path.
    pub vertices: Vec<Vertex>,
}

impl Polyline {
    /// Neighbours by index, with the closing edge of a closed path.
    fn edges(&self) -> impl Iterator<Item = (usize, usize)> {
        let count = self.vertices.len();
        let closing = (self.closed && count > 1).then(|| (count - 1, 0));
        (1..count).map(|i| (i - 1, i)).chain(closing)
    }

    /// Removes vertices nearer than `below` to the one before them. Drawings close with lines of 1e-16, which no driver
    /// would send to its machine, and which would count here as points with gaps of nothing.
    pub fn without_slivers(mut self, below: f64) -> Self {
        self.vertices.dedup_by(|next, kept| next.point.distance(&kept.point) < below);
        if self.closed
            && self.vertices.len() > 1
            && self.vertices.first().zip(self.vertices.last()).is_some_and(|(a, b)| a.point.distance(&b.point) < below)
        {
            self.vertices.pop();
        }
        self
    }

    /// From places on a path.
    fn through(cubics: &[Cubic<f64>], closed: bool, places: impl IntoIterator<Item = Location>) -> Self {
        let vertex = |at: Location| Some(Vertex { at, point: cubics.get(at.segment)?.eval(&at.t) });
        Self { closed, vertices: places.into_iter().filter_map(vertex).collect() }
    }

    /// From cuts of each cubic on its own: `cut` answers the parameters in (0, 1] where pieces end.
    fn cubic_by_cubic(cubics: &[Cubic<f64>], closed: bool, cut: impl Fn(&Cubic<f64>) -> Vec<f64>) -> Self {
        let ends = cubics.iter().enumerate().flat_map(|(segment, cubic)| {
            let parameters = if is_straight(cubic) { vec![1.0] } else { cut(cubic) };
            parameters.into_iter().map(move |t| Location::new(segment, t))
        });
        let mut line = Self::through(cubics, closed, std::iter::once(Location::new(0, 0.0)).chain(ends));
        if closed && line.vertices.len() > 1 {
            line.vertices.pop();
        }
        line
    }
}

/// Every chord as long as it may be while the curve stays within `tolerance` of it, from the start of the path.
pub fn by_chord_error(cubics: &[Cubic<f64>], closed: bool, tolerance: f64) -> Polyline {
    // How finely an end is searched: the loss against the true farthest end is this share of a cubic.
    const PRECISION: f64 = 1e-9;
    let count = cubics.len();
    let end = count as f64;
    let place = |number: f64| Location::from_number(number, count);
    let fits = |from: f64, to: f64| deviation(&pieces(cubics, place(from), place(to))) <= tolerance;

    let mut places = vec![place(0.0)];
    let mut from = 0.0;
    while from < end {
        let mut step = 1.0 / 64.0;
        let mut good = from;
        let mut bad = loop {
            let to = (from + step).min(end);
            if !fits(from, to) {
                break Some(to);
            }
            good = to;
            if to >= end {
                break None;
            }
            step *= 2.0;
        };
        while let Some(to) = bad.filter(|to| to - good > PRECISION) {
            let middle = 0.5 * (good + to);
            if fits(from, middle) {
                good = middle;
            } else {
                bad = Some(middle);
            }
        }
        // Below the precision (a tolerance of nothing) go on all the same.
        from = if good > from { good } else { (from + PRECISION).min(end) };
        places.push(place(from));
    }
    if closed && places.len() > 1 {
        places.pop();
    }
    Polyline::through(cubics, closed, places)
}

/// Every cubic in the same number of pieces of equal parameter.
pub fn uniform(cubics: &[Cubic<f64>], closed: bool, steps: u32) -> Polyline {
    Polyline::cubic_by_cubic(cubics, closed, |_| equal_parts(steps))
}

/// Every cubic in ⌈length / piece⌉ pieces of equal parameter, at most 10⁶.
pub fn by_length(cubics: &[Cubic<f64>], closed: bool, piece: f64) -> Polyline {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the range first")]
    Polyline::cubic_by_cubic(cubics, closed, |cubic| equal_parts((length(cubic) / piece).ceil().clamp(1.0, 1e6) as u32))
}

/// Steps of a tenth of the cubic's parameter, halved while the curve at half the step is farther than `tolerance` (sum of
/// both coordinates' differences) from the middle of the chord, but not below 1/500; a step that needed no halving is
/// doubled while that holds and it is a tenth or less: so the longest is a fifth. The next cut starts with the last step.
///
/// This is what Marlin and grblHAL do with a G5 command, with a tolerance of 0.1 mm. The middle is no bound: the chord
/// error may be larger than the tolerance, and on short cubics it is far smaller, because each gets five steps at least.
pub fn by_midpoint(cubics: &[Cubic<f64>], closed: bool, tolerance: f64) -> Polyline {
    const FIRST: f64 = 0.1;
    const SHORTEST: f64 = 0.002;
    Polyline::cubic_by_cubic(cubics, closed, |cubic| {
        let fits = |from: f64, to: f64| {
            let off = cubic.eval(&from).middle(&cubic.eval(&to)).minus(&cubic.eval(&(0.5 * (from + to))));
            off.x.abs() + off.y.abs() <= tolerance
        };
        let mut ends = Vec::new();
        let (mut from, mut step) = (0.0, FIRST);
        while from < 1.0 {
            let mut to = (from + step).min(1.0);
            let mut halved = false;
            while to - from >= SHORTEST && !fits(from, to) {
                to = 0.5 * (from + to);
                halved = true;
            }
            while !halved && to - from <= FIRST && 2.0 * to - from < 1.0 && fits(from, 2.0 * to - from) {
                to = 2.0 * to - from;
            }
            step = to - from;
            from = to;
            ends.push(to);
        }
        ends
    })
}

fn equal_parts(steps: u32) -> Vec<f64> {
    (1..=steps).map(|i| f64::from(i) / f64::from(steps)).collect()
}

/// The largest distance of a curve from the chord between its ends.
fn deviation(curve: &[Cubic<f64>]) -> f64 {
    let Some((first, last)) = curve.first().zip(curve.last()) else { return 0.0 };
    let (a, b) = (*first.start(), *last.end());
    curve.iter().map(|cubic| farthest(cubic, &a, &b)).fold(0.0, f64::max)
}

/// The largest distance of a point of the cubic from the segment ab, to about eight digits.
///
/// The best of a few equally spaced points, then a golden-section search around it.
fn farthest(cubic: &Cubic<f64>, a: &Point<f64>, b: &Point<f64>) -> f64 {
    const POINTS: u32 = 12;
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let distance = |t: f64| distance_to_segment(&cubic.eval(&t), a, b);
    let spacing = 1.0 / f64::from(POINTS);
    let (best, value) = (0..=POINTS)
        .map(|i| f64::from(i) * spacing)
        .map(|t| (t, distance(t)))
        .fold((0.0, 0.0), |best, next| if next.1 > best.1 { next } else { best });
    let (mut low, mut high) = ((best - spacing).max(0.0), (best + spacing).min(1.0));
    let mut inner = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let mut values = inner.map(distance);
    for _ in 0..20 {
        if values[0] > values[1] {
            high = inner[1];
            inner = [high - GOLDEN * (high - low), inner[0]];
            values = [distance(inner[0]), values[0]];
        } else {
            low = inner[0];
            inner = [inner[1], low + GOLDEN * (high - low)];
            values = [values[1], distance(inner[1])];
        }
    }
    value.max(values[0]).max(values[1])
}

fn distance_to_segment(p: &Point<f64>, a: &Point<f64>, b: &Point<f64>) -> f64 {
    let (chord, to_p) = (b.minus(a), p.minus(a));
    let size = chord.norm_sq();
    let part = if size > 0.0 { (to_p.dot(&chord) / size).clamp(0.0, 1.0) } else { 0.0 };
    to_p.plus_scaled(&-part, &chord).norm()
}

/// The largest distance of a path from the chords of its polyline.
pub fn chord_error(cubics: &[Cubic<f64>], line: &Polyline) -> f64 {
    line.edges().map(|(i, j)| deviation(&pieces(cubics, line.vertices[i].at, line.vertices[j].at))).fold(0.0, f64::max)
}

/// What a set of polylines is like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// Points, of all paths together.
    pub points: usize,
    /// Chords.
    pub edges: usize,
    /// The largest distance of a path from its chords, in user units.
    pub chord_error: f64,
    /// Chords missing from the Delaunay triangulation of all points.
    pub missing: usize,
    /// The largest ratio of two neighbouring gaps of a path; 1 where all are equal, infinite where two points coincide.
    pub grading: f64,
    /// The smallest distance between neighbours.
    pub min_gap: f64,
    /// The largest distance between neighbours.
    pub max_gap: f64,
}

/// Measures the polylines of a drawing's paths.
///
/// # Errors
/// Coordinates outside the domain of exact predicates.
pub fn figures<'a>(
    paths: impl IntoIterator<Item = (&'a [Cubic<f64>], &'a Polyline)>,
) -> Result<Figures, InsertionError> {
    let mut points = Vec::new();
    let mut edges = Vec::new();
    let (mut error, mut grading) = (0.0_f64, 1.0_f64);
    let (mut min_gap, mut max_gap) = (f64::INFINITY, 0.0_f64);
    for (cubics, line) in paths {
        let gaps = gaps(line);
        min_gap = gaps.iter().copied().fold(min_gap, f64::min);
        max_gap = gaps.iter().copied().fold(max_gap, f64::max);
        grading = neighbour_ratios(&gaps, line.closed).fold(grading, f64::max);
        error = error.max(chord_error(cubics, line));
        edges.extend(line.edges().map(|(i, j)| (points.len() + i, points.len() + j)));
        points.extend(line.vertices.iter().map(|vertex| vertex.point));
    }
    let missing = missing_edges(&points, &edges)?;
    Ok(Figures { points: points.len(), edges: edges.len(), chord_error: error, missing, grading, min_gap, max_gap })
}

/// Distances between neighbours, in the order of the path.
pub fn gaps(line: &Polyline) -> Vec<f64> {
    line.edges().map(|(i, j)| line.vertices[i].point.distance(&line.vertices[j].point)).collect()
}

/// Ratios of neighbouring gaps, the larger over the smaller.
fn neighbour_ratios(gaps: &[f64], closed: bool) -> impl Iterator<Item = f64> {
    let closing = (closed && gaps.len() > 2).then(|| gaps.last().copied().zip(gaps.first().copied())).flatten();
    gaps.iter().copied().zip(gaps.iter().copied().skip(1)).chain(closing).map(|(a, b)| {
        let (small, large) = if a < b { (a, b) } else { (b, a) };
        // Two equal gaps of nothing grade evenly.
        if small == large { 1.0 } else { large / small }
    })
}

/// The fewest uniform steps per cubic that keep the chord error within a tolerance on all paths, up to `limit`.
pub fn steps_for<'a>(paths: impl Iterator<Item = &'a [Cubic<f64>]> + Clone, tolerance: f64, limit: u32) -> u32 {
    let fits = |steps: u32| {
        let step = 1.0 / f64::from(steps);
        paths.clone().flatten().filter(|cubic| !is_straight(cubic)).all(|cubic| {
            (0..steps).all(|i| {
                let (from, to) = (f64::from(i) * step, f64::from(i + 1) * step);
                between(cubic, from, to.min(1.0)).is_none_or(|piece| deviation(&[piece]) <= tolerance)
            })
        })
    };
    let mut bad = 0;
    let mut good = 1;
    while good < limit && !fits(good) {
        bad = good;
        good = (2 * good).min(limit);
    }
    while good - bad > 1 {
        let middle = bad + (good - bad) / 2;
        if fits(middle) {
            good = middle;
        } else {
            bad = middle;
        }
    }
    good
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A circle of radius 1 in four cubics.
    fn circle() -> Vec<Cubic<f64>> {
        const HANDLE: f64 = 0.552_284_749_830_793_4;
        let turn = |(x, y): (f64, f64), quarter: usize| (0..quarter).fold((x, y), |(x, y), _| (-y, x));
        (0..4)
            .map(|quarter| {
                let points = [(1.0, 0.0), (1.0, HANDLE), (HANDLE, 1.0), (0.0, 1.0)].map(|p| turn(p, quarter));
                let [a, b, c, d] = points.map(|(x, y)| Point::new(x, y));
                Cubic::new(a, b, c, d)
            })
            .collect()
    }

    #[test]
    fn greedy_chords_of_a_circle() {
        let circle = circle();
        let line = by_chord_error(&circle, true, 0.01);
        // A chord of error e turns by 2 acos(1 − e): 2π / 0.2829 = 22.2.
        assert_eq!(line.vertices.len(), 23, "one above the quotient");
        let error = chord_error(&circle, &line);
        assert!(error <= 0.01 && error > 0.009_99, "the tolerance is used and kept: {error}");
    }

    #[test]
    fn cuts_cubic_by_cubic() {
        let circle = circle();
        assert_eq!(uniform(&circle, true, 8).vertices.len(), 32, "eight per cubic, closed");
        assert_eq!(uniform(&circle[..1], false, 8).vertices.len(), 9, "eight, open");
        assert_eq!(by_length(&circle, true, 0.1).vertices.len(), 64, "a quarter of length 1.5708 makes 16");
        assert_eq!(by_midpoint(&circle, true, 1.0).vertices.len(), 20, "five per cubic at least");
        let steps = steps_for(std::iter::once(circle.as_slice()), 0.01, 1000);
        let error = |steps| chord_error(&circle, &uniform(&circle, true, steps));
        assert!(error(steps) <= 0.01 && error(steps - 1) > 0.01, "the fewest steps: {steps}");
    }

    #[test]
    fn slivers_go() {
        let at = |x: f64| Vertex { at: Location::new(0, x), point: Point::new(x, 0.0) };
        let line = Polyline { closed: true, vertices: [0.0, 1.0, 1.0 + 1e-14, 0.5, 1e-14].map(at).to_vec() };
        assert_eq!(line.without_slivers(1e-9).vertices, [0.0, 1.0, 0.5].map(at), "the first of each place stays");
    }

    #[test]
    fn figures_of_a_square() {
        let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)].map(|(x, y)| Point::new(x, y));
        let square: Vec<_> = (0..4).map(|i| Cubic::line(corners[i], corners[(i + 1) % 4])).collect();
        let line = uniform(&square, true, 7);
        let figures = figures([(square.as_slice(), &line)]).expect("in range");
        assert_eq!((figures.points, figures.edges, figures.missing), (4, 4, 0), "lines stay whole");
        assert_eq!((figures.grading, figures.min_gap, figures.max_gap), (2.0, 1.0, 2.0), "gaps");
        assert!(figures.chord_error < 1e-15, "lines are their chords");
    }
}
