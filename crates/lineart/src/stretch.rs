//! Stretches of a path: the curve between two of its parameters, as cubics.
//!
//! Samples say where they are by cubic and parameter. Everything that looks at the curve *between* two samples (chord
//! errors, coloured strokes) asks here for the pieces. The pieces join to the bit with the cubics they are cut from at
//! t = 0 and t = 1; elsewhere de Casteljau's rounding applies.

use feature_sampling::bezier::Cubic;

/// A place on a path: a cubic and a parameter on it. Ordered along the path.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Location {
    /// Index of the cubic in its path.
    pub segment: usize,
    /// Parameter on the cubic, in [0, 1].
    pub t: f64,
}

impl Location {
    /// The place (segment, t).
    pub fn new(segment: usize, t: f64) -> Self {
        Self { segment, t }
    }

    /// The place as one number: segments are of length 1. Good for searches, not for storage.
    pub fn as_number(self) -> f64 {
        self.segment as f64 + self.t
    }

    /// The inverse of [`Location::as_number`] on a path of `count` cubics; numbers beyond its ends give the ends.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the value is a small whole number")]
    pub fn from_number(number: f64, count: usize) -> Self {
        let last = count.saturating_sub(1);
        let segment = (number.max(0.0).floor() as usize).min(last);
        Self::new(segment, (number - segment as f64).clamp(0.0, 1.0))
    }
}

/// The curve from one place to another, forwards. Where `to` does not lie after `from`, the path is closed and the
/// stretch runs through its seam. Pieces of no extent in t are left out.
pub fn pieces(cubics: &[Cubic<f64>], from: Location, to: Location) -> Vec<Cubic<f64>> {
    let mut out = Vec::new();
    let mut add = |segment: usize, t0: f64, t1: f64| {
        if let Some(cubic) = cubics.get(segment) {
            out.extend(between(cubic, t0, t1));
        }
    };
    if from < to && from.segment == to.segment {
        add(from.segment, from.t, to.t);
        return out;
    }
    add(from.segment, from.t, 1.0);
    let between_segments: Box<dyn Iterator<Item = usize>> = if from < to {
        Box::new(from.segment + 1..to.segment)
    } else {
        Box::new((from.segment + 1..cubics.len()).chain(0..to.segment))
    };
    for segment in between_segments {
        add(segment, 0.0, 1.0);
    }
    add(to.segment, 0.0, to.t);
    out
}

/// The part of a cubic between two parameters; `None` where t0 ≥ t1.
pub fn between(cubic: &Cubic<f64>, t0: f64, t1: f64) -> Option<Cubic<f64>> {
    if t0 >= t1 {
        return None;
    }
    let left = if t1 < 1.0 { cubic.split_at(&t1).0 } else { *cubic };
    Some(if t0 > 0.0 { left.split_at(&(t0 / t1)).1 } else { left })
}

/// Arc length of a cubic, by Gauss's five-point rule on sixteen equal stretches of its parameter.
///
/// Good to about ten digits where the speed does not vanish, to about four at a cusp.
pub fn length(cubic: &Cubic<f64>) -> f64 {
    const NODES: [(f64, f64); 5] = [
        (0.0, 0.568_888_888_888_888_9),
        (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
        (0.906_179_845_938_664, 0.236_926_885_056_189_08),
    ];
    const STRETCHES: u32 = 16;
    let power = cubic.power_basis();
    let half = 0.5 / f64::from(STRETCHES);
    let stretch = |i: u32| {
        let middle = f64::from(2 * i + 1) * half;
        NODES.iter().map(|(node, weight)| weight * power.derivative(&(middle + node * half)).norm()).sum::<f64>() * half
    };
    (0..STRETCHES).map(stretch).sum()
}

/// The cubic is a straight line run through once, forwards, as far as doubles can tell.
pub fn is_straight(cubic: &Cubic<f64>) -> bool {
    let [start, a, b, end] = &cubic.points;
    let chord = end.minus(start);
    let tolerance = 1e-12 * chord.norm_sq();
    let (along_a, along_b) = (a.minus(start).dot(&chord), b.minus(start).dot(&chord));
    let ordered = along_a >= -tolerance && along_b >= along_a - tolerance && along_b <= chord.norm_sq() + tolerance;
    ordered && [a, b].iter().all(|p| p.minus(start).cross(&chord).abs() <= tolerance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use feature_sampling::geometry::Point;

    fn square() -> Vec<Cubic<f64>> {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Point::new(x, y));
        (0..4).map(|i| Cubic::line(corners[i], corners[(i + 1) % 4])).collect()
    }

    #[test]
    fn within_across_and_through_the_seam() {
        let square = square();
        let stretch = |a: (usize, f64), b: (usize, f64)| {
            let found = pieces(&square, Location::new(a.0, a.1), Location::new(b.0, b.1));
            for pair in found.windows(2) {
                assert!(pair[0].end().distance(pair[1].start()) < 1e-12, "pieces follow each other");
            }
            let (first, last) = (found[0], found[found.len() - 1]);
            (found.len(), first.start().x, first.start().y, last.end().x, last.end().y)
        };
        assert_eq!(stretch((0, 0.25), (0, 0.75)), (1, 0.25, 0.0, 0.75, 0.0), "within one cubic");
        assert_eq!(stretch((0, 0.5), (2, 0.5)), (3, 0.5, 0.0, 0.5, 1.0), "across two joints");
        assert_eq!(stretch((3, 0.5), (0, 0.5)), (2, 0.0, 0.5, 0.5, 0.0), "through the seam");
        assert_eq!(stretch((0, 0.75), (0, 0.25)).0, 5, "through the seam to the same cubic");
        assert_eq!(stretch((0, 1.0), (1, 1.0)).0, 1, "nothing of no extent");
        assert_eq!(stretch((0, 0.0), (0, 0.0)).0, 4, "all the way round");
    }

    #[test]
    fn lengths_and_straight_lines() {
        let line = square()[0];
        assert!((length(&line) - 1.0).abs() < 1e-14, "a unit line");
        assert!(is_straight(&line), "is straight");
        // y = x² from 0 to 1: √5/2 + asinh(2)/4.
        let parabola = Cubic::quadratic(Point::new(0.0, 0.0), &Point::new(0.5, 0.0), Point::new(1.0, 1.0));
        assert!((length(&parabola) - 1.478_942_857_544_597_4).abs() < 1e-12, "a parabola");
        assert!(!is_straight(&parabola), "is not");
        let [a, b] = [Point::new(0.0, 0.0), Point::new(1.0, 0.0)];
        assert!(!is_straight(&Cubic::new(a, Point::new(2.0, 0.0), b, b)), "overshoots its end and comes back");
    }

    #[test]
    fn places_as_numbers() {
        for place in [Location::new(0, 0.0), Location::new(2, 0.5), Location::new(3, 1.0)] {
            assert_eq!(Location::from_number(place.as_number(), 4), place, "there and back");
        }
        assert_eq!(Location::from_number(9.0, 4), Location::new(3, 1.0), "the end is the end");
    }
}
