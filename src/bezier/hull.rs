//! The hull test (paper, Section 7.1): a cubic lies in the convex hull of its control points, so a query farther from the
//! hull than the best distance so far need not be solved for. The paper measures a factor of 2 to 5 in whole runs.
//!
//! Both functions rest on one inequality. For any direction w, every point x of the hull has
//! (q − x)·w ≥ h = min over the control points p of (q − p)·w; so if h > 0 the hull is at least h/|w| away from q. With w
//! pointing from the nearest point of the hull to q the bound is attained. Rounding can turn w a little, which makes the
//! bound smaller, never wrong: its own error is that of h alone, a few roundings of the distances involved.

use super::Cubic;
use crate::geometry::{Point, Vector, project_to_segment};
use crate::scalar::Scalar;

/// Squared distance from q to the convex hull of the control points, 0 inside; a lower bound of the squared distance to
/// the curve. Exact up to a few roundings.
pub fn hull_distance_sq<S: Scalar>(cubic: &Cubic<S>, q: &Point<S>) -> S {
    let [p0, p1, p2, p3] = &cubic.points;
    let mut best = S::infinity();
    let mut towards = Vector::zero();
    for (a, b) in [(p0, p1), (p1, p2), (p2, p3), (p3, p0), (p0, p2), (p1, p3)] {
        let (_, nearest) = project_to_segment(q, a, b);
        let w = q.minus(&nearest);
        let distance_sq = w.norm_sq();
        if distance_sq < best {
            best = distance_sq;
            towards = w;
        }
    }
    along(cubic, q, &towards).unwrap_or_else(S::zero)
}

/// Whether the hull, hence the curve, is known to keep a squared distance of at least `distance_sq` from q.
///
/// `false` means "not known": the test is quick, not sharp. It tries the control box, then the direction from the chord.
#[inline]
pub fn hull_keeps_away<S: Scalar>(cubic: &Cubic<S>, q: &Point<S>, distance_sq: &S) -> bool {
    if cubic.control_box().distance_sq(q) >= *distance_sq {
        return true;
    }
    let (_, nearest) = project_to_segment(q, cubic.start(), cubic.end());
    along(cubic, q, &q.minus(&nearest)).is_some_and(|bound| bound >= *distance_sq)
}

/// The bound h²/|w|² of direction w; `None` if the direction does not separate.
#[inline]
fn along<S: Scalar>(cubic: &Cubic<S>, q: &Point<S>, w: &Vector<S>) -> Option<S> {
    let mut least = S::infinity();
    for p in &cubic.points {
        least = least.min(q.minus(p).dot(w));
    }
    let length_sq = w.norm_sq();
    (least > S::zero() && length_sq > S::zero()).then(|| least.clone() / &length_sq * &least)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = Point<f64>> {
        (-10.0..10.0, -10.0..10.0).prop_map(|(x, y)| Point::new(x, y))
    }

    #[test]
    fn known_distances() {
        let c = Cubic::new(Point::new(0.0, 0.0), Point::new(0.0, 2.0), Point::new(2.0, 2.0), Point::new(2.0, 0.0));
        assert_eq!(hull_distance_sq(&c, &Point::new(1.0, 1.0)), 0.0, "inside");
        assert_eq!(hull_distance_sq(&c, &Point::new(1.0, 5.0)), 9.0, "above an edge");
        assert_eq!(hull_distance_sq(&c, &Point::new(5.0, 6.0)), 25.0, "off a corner");
        assert!(hull_keeps_away(&c, &Point::new(5.0, 6.0), &25.0));
        assert!(!hull_keeps_away(&c, &Point::new(1.0, 1.0), &1e-9));
        let dot = Cubic::line(Point::new(1.0, 1.0), Point::new(1.0, 1.0));
        assert_eq!(hull_distance_sq(&dot, &Point::new(4.0, 5.0)), 25.0, "a point");
        assert_eq!(hull_distance_sq(&dot, &Point::new(1.0, 1.0)), 0.0, "the point itself");
    }

    proptest! {
        #[test]
        fn never_beyond_the_curve(a in point(), b in point(), c in point(), d in point(), q in point(), t in 0.0..1.0) {
            let cubic = Cubic::new(a, b, c, d);
            let distance_sq = cubic.eval(&t).distance_sq(&q);
            prop_assert!(hull_distance_sq(&cubic, &q) <= distance_sq * (1.0 + 1e-12) + 1e-24);
            prop_assert!(!hull_keeps_away(&cubic, &q, &(distance_sq * (1.0 + 1e-12) + 1e-24)));
        }

        #[test]
        fn single_precision_too(a in point(), b in point(), c in point(), d in point(), q in point(), t in 0.0_f32..1.0) {
            let down = |p: Point<f64>| Point::<f32>::from_f64(p.x, p.y);
            let cubic = Cubic::new(down(a), down(b), down(c), down(d));
            let distance_sq = cubic.eval(&t).distance_sq(&down(q));
            prop_assert!(hull_distance_sq(&cubic, &down(q)) <= distance_sq * (1.0 + 1e-4) + 1e-10);
        }
    }
}
