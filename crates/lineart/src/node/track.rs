//! A path by one running parameter, and hulls of its pieces.
//!
//! The parameter of a path of n cubics runs from 0 to n; on a closed path it goes on past n, through the seam, so that a
//! piece is always a pair `from` < `to`. The hull of a piece is a box along its chord that holds all control points of
//! its cubics: narrow where the piece is nearly straight, and a bound of how far the curve is from its chord.

use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::{Aabb, Point, Vector};

use crate::stretch::{Location, between};

/// The cubics of a path.
#[derive(Clone, Copy, Debug)]
pub struct Track<'a> {
    cubics: &'a [Cubic<f64>],
}

impl<'a> Track<'a> {
    /// The path of these cubics, at least one.
    pub fn new(cubics: &'a [Cubic<f64>]) -> Self {
        Self { cubics }
    }

    /// How far the parameter runs: the number of cubics.
    pub fn length(&self) -> f64 {
        self.cubics.len() as f64
    }

    /// Where a parameter is; parameters beyond the end have gone through the seam.
    pub fn locate(&self, u: f64) -> Location {
        let n = self.length();
        let u = if u > n { u - n } else { u };
        Location::from_number(u, self.cubics.len())
    }

    /// The point at u.
    pub fn eval(&self, u: f64) -> Point<f64> {
        let at = self.locate(u);
        self.cubics.get(at.segment).map_or_else(Point::default, |cubic| cubic.eval(&at.t))
    }

    /// The point at a parameter that may have gone round a closed path once more, in either direction.
    pub fn eval_around(&self, u: f64) -> Point<f64> {
        let n = self.length();
        self.eval(if u < 0.0 { u + n } else { u })
    }

    /// The derivative by u.
    pub fn derivative(&self, u: f64) -> Vector<f64> {
        let at = self.locate(u);
        self.cubics.get(at.segment).map_or_else(Vector::zero, |cubic| cubic.power_basis().derivative(&at.t))
    }

    /// The cubics from one parameter to a later one. Pieces of no extent in the parameter are left out; neighbours join
    /// to the bit where a whole cubic stands between them.
    pub fn cubics(&self, from: f64, to: f64) -> impl Iterator<Item = Cubic<f64>> + use<'a> {
        let track = *self;
        let n = self.length();
        let mut u = from;
        std::iter::from_fn(move || {
            while u < to {
                // A parameter that stands on a joint belongs to the cubic after it.
                let at = track.locate(if u >= n { u - n } else { u });
                let next = (u.floor() + 1.0).min(to);
                let end = if next < u.floor() + 1.0 { next - u.floor() } else { 1.0 };
                u = next;
                let piece = track.cubics.get(at.segment).and_then(|cubic| between(cubic, at.t, end));
                if piece.is_some() {
                    return piece;
                }
            }
            None
        })
    }

    /// Every leg of the control polygons goes forwards in a direction, and so does the curve.
    pub(super) fn advances(&self, from: f64, to: f64, direction: &Vector<f64>) -> bool {
        self.cubics(from, to).all(|cubic| {
            let [a, b, c, d] = &cubic.points;
            [(a, b), (b, c), (c, d)].iter().all(|(p, q)| q.minus(p).dot(direction) >= 0.0)
        })
    }

    /// No control point is farther than a margin above the line through a point with this unit normal.
    pub(super) fn is_below(&self, from: f64, to: f64, p: &Point<f64>, normal: &Vector<f64>, margin: f64) -> bool {
        self.cubics(from, to).all(|cubic| cubic.points.iter().all(|q| q.minus(p).dot(normal) <= margin))
    }

    /// The parameter in [from, to] at which the curve is nearest to a point, searched downhill from a guess: Gauss and
    /// Newton's step, halved until it comes nearer. It starts from the best of the guess and seven
    /// places between, because the step is of no use where the curve nearly stands still (a retracted handle, a cusp).
    pub fn nearest(&self, p: &Point<f64>, from: f64, to: f64, guess: f64) -> f64 {
        let mut best = guess.clamp(from, to);
        let mut best_sq = self.eval(best).distance_sq(p);
        let mut try_at = |best: &mut f64, u: f64| {
            let distance_sq = self.eval(u).distance_sq(p);
            let nearer = distance_sq < best_sq;
            if nearer {
                (*best, best_sq) = (u, distance_sq);
            }
            nearer
        };
        for share in [1.0 / 64.0, 1.0 / 16.0, 0.25, 0.5, 0.75, 15.0 / 16.0, 63.0 / 64.0] {
            try_at(&mut best, from + share * (to - from));
        }
        for _ in 0..32 {
            let d = self.derivative(best);
            let mut step = p.minus(&self.eval(best)).dot(&d) / d.norm_sq();
            if !step.is_finite() {
                break;
            }
            let start = best;
            for _ in 0..24 {
                let u = (start + step).clamp(from, to);
                if u == start || try_at(&mut best, u) {
                    break;
                }
                step *= 0.5;
            }
            if (best - start).abs() <= f64::EPSILON * (to - from) {
                break;
            }
        }
        best
    }
}

/// A box along the chord of a piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hull {
    pub(super) start: Point<f64>,
    pub(super) end: Point<f64>,
    /// Unit vector along the chord; any, where the chord has no length.
    pub(super) along: Vector<f64>,
    /// Length of the chord.
    pub(super) chord: f64,
    /// Extent along the chord, from its start.
    reach: [f64; 2],
    /// Extent across it, to the left.
    width: [f64; 2],
}

impl Hull {
    pub(super) fn of(track: &Track<'_>, from: f64, to: f64) -> Self {
        let (start, end) = (track.eval(from), track.eval(to));
        let chord = end.minus(&start);
        let along = chord.unit().unwrap_or(Vector::new(1.0, 0.0));
        let mut hull = Self { start, end, along, chord: chord.norm(), reach: [0.0, 0.0], width: [0.0, 0.0] };
        hull.reach[1] = hull.chord;
        for cubic in track.cubics(from, to) {
            for p in &cubic.points {
                let (x, y) = hull.frame(p);
                hull.reach = [hull.reach[0].min(x), hull.reach[1].max(x)];
                hull.width = [hull.width[0].min(y), hull.width[1].max(y)];
            }
        }
        hull
    }

    /// A point in the frame of the chord.
    fn frame(&self, p: &Point<f64>) -> (f64, f64) {
        let v = p.minus(&self.start);
        (self.along.dot(&v), self.along.cross(&v))
    }

    /// No point of the piece is farther than this from its chord.
    pub(super) fn deviation(&self) -> f64 {
        let beyond = (-self.reach[0]).max(self.reach[1] - self.chord);
        beyond.max(-self.width[0]).max(self.width[1])
    }

    fn corners(&self) -> [Point<f64>; 4] {
        let [left, right] = self.reach;
        let [low, high] = self.width;
        let across = self.along.left();
        let corner = |x: f64, y: f64| self.start.plus_scaled(&x, &self.along).plus_scaled(&y, &across);
        [corner(left, low), corner(right, low), corner(right, high), corner(left, high)]
    }

    /// A point that is within a margin of the box: how far along the chord it lies, as a share.
    pub(super) fn beside(&self, p: &Point<f64>, margin: f64) -> Option<f64> {
        let (x, y) = self.frame(p);
        let inside = x >= self.reach[0] - margin
            && x <= self.reach[1] + margin
            && y >= self.width[0] - margin
            && y <= self.width[1] + margin;
        (inside && self.chord > 0.0).then(|| (x / self.chord).clamp(0.0, 1.0))
    }

    /// The box with sides along the axes, grown by a margin.
    pub(super) fn bounds(&self, margin: f64) -> Aabb<f64> {
        let mut bounds = Aabb::around(&self.corners());
        bounds.min = bounds.min.plus(&Vector::new(-margin, -margin));
        bounds.max = bounds.max.plus(&Vector::new(margin, margin));
        bounds
    }

    /// Some side of one of the boxes separates the two by more than the margin.
    pub(super) fn is_apart(&self, other: &Self, margin: f64) -> bool {
        self.separates(other, margin) || other.separates(self, margin)
    }

    fn separates(&self, other: &Self, margin: f64) -> bool {
        let [mut left, mut right, mut low, mut high] = [f64::INFINITY, -f64::INFINITY, f64::INFINITY, -f64::INFINITY];
        for (x, y) in other.corners().iter().map(|p| self.frame(p)) {
            (left, right) = (left.min(x), right.max(x));
            (low, high) = (low.min(y), high.max(y));
        }
        left > self.reach[1] + margin
            || right < self.reach[0] - margin
            || low > self.width[1] + margin
            || high < self.width[0] - margin
    }
}
