//! Chord-error flattening of one cubic at a time, with a true bound and constant work a point.
//!
//! For firmware that knows no curve, only the next cubic (a G5 command): [`Flattener::next`] gives the end points of line
//! segments that stay within a tolerance of the cubic. Over a stretch of h in the parameter the chord, run through at uniform
//! speed, is the linear interpolant of B; the error of linear interpolation is at most h²/8 · max |B''|, and B'' of a cubic
//! is linear, so that its length is largest at an end of the stretch. That is a bound on the distance from the chord, not an
//! estimate: splitters that test the middle of a stretch miss an S whose middle lies on its chord.
//!
//! The bound looks at the speed along the chord too, so that it asks for more segments than the distance alone needs where
//! speed changes along a line; [`crate::sampling`] measures the distance itself, at the price of a quintic.
//!
//! Memory: one struct of 13 scalars and a count of what is left. Work: seven lengths of B'' and one evaluation a point.

use super::SamplingError;
use crate::bezier::{Cubic, PowerBasis};
use crate::geometry::Point;
use crate::scalar::Scalar;

/// Rounds that lengthen a step after the first, safe one.
const ROUNDS: u32 = 4;

/// The points of one cubic, one by one.
#[derive(Clone, Debug)]
pub struct Flattener<S> {
    power: PowerBasis<S>,
    end: Point<S>,
    /// 8 × the tolerance that is left after rounding.
    allowed: S,
    t: S,
}

impl<S: Scalar> Flattener<S> {
    /// Starts at the beginning of a cubic; its start itself is not handed out.
    ///
    /// `tolerance` is the largest distance of the cubic from the line segments, in the unit of the coordinates. Of it, 16
    /// roundoffs of the largest coordinate are kept for rounding.
    ///
    /// # Errors
    /// [`SamplingError::Length`] if the tolerance is not above twice that, or anything is not finite.
    pub fn new(cubic: &Cubic<S>, tolerance: &S) -> Result<Self, SamplingError> {
        let mut largest = S::zero();
        for p in &cubic.points {
            largest = largest.max(p.x.clone().abs()).max(p.y.clone().abs());
        }
        let rounding = largest * &S::unit_roundoff().mul_pow2(4);
        if !cubic.is_finite() || !tolerance.is_finite() || *tolerance <= rounding.clone().twice() {
            return Err(SamplingError::Length);
        }
        let power = cubic.power_basis();
        let allowed = (tolerance.clone() - &rounding).mul_pow2(3);
        let bend = power.second_derivative(&S::zero()).norm() + &power.second_derivative(&S::one()).norm();
        if !bend.is_finite() || !allowed.is_finite() {
            return Err(SamplingError::Length);
        }
        Ok(Self { power, end: cubic.end().clone(), allowed, t: S::zero() })
    }

    /// The parameter of the last point.
    pub const fn parameter(&self) -> &S {
        &self.t
    }

    /// The next point, the cubic's end last; `None` after it.
    #[expect(clippy::should_implement_trait, reason = "a scalar's arithmetic is no business of an iterator's adaptors")]
    pub fn next(&mut self) -> Option<Point<S>> {
        if self.t >= S::one() {
            return None;
        }
        let rest = S::one() - &self.t;
        let here = self.power.second_derivative(&self.t).norm();
        // max |B''| from here to a step further.
        let bend = |h: &S| here.clone().max(self.power.second_derivative(&(self.t.clone() + h)).norm());
        let longest =
            |m: &S| if *m > S::zero() { (self.allowed.clone() / m).sqrt().min(rest.clone()) } else { rest.clone() };
        // With the largest bend of all the rest a step is safe; a shorter stretch may bend less, which allows more.
        let mut step = longest(&bend(&rest));
        for _ in 0..ROUNDS {
            let longer = longest(&bend(&step));
            if longer.clone().square() * &bend(&longer) > self.allowed || longer <= step {
                break;
            }
            step = longer;
        }
        let to = self.t.clone() + &step;
        // A step always leads on: where rounding swallows it, by the smallest parameter there is.
        let least = self.t.clone() + &S::unit_roundoff().twice();
        self.t = to.max(least).min(S::one());
        Some(if self.t >= S::one() { self.end.clone() } else { self.power.eval(&self.t) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::chord::piece_error_sq;

    fn cubic(p: [f64; 8]) -> Cubic<f64> {
        let [a, b, c, d, e, f, g, h] = p;
        Cubic::new(Point::new(a, b), Point::new(c, d), Point::new(e, f), Point::new(g, h))
    }

    /// Every chord keeps the tolerance, by the exact chord error; the points lead to the end, and are not too many.
    fn check(c: &Cubic<f64>, tolerance: f64) -> usize {
        let power = c.power_basis();
        let mut flat = Flattener::new(c, &tolerance).unwrap();
        let (mut t, mut here, mut count) = (0.0, *c.start(), 0);
        while let Some(p) = flat.next() {
            let to = *flat.parameter();
            let error = piece_error_sq(&power, &t, &to, &here, &p).sqrt();
            assert!(error <= tolerance, "{error} > {tolerance} from {t} to {to}");
            (t, here, count) = (to, p, count + 1);
        }
        assert_eq!(here, *c.end());
        count
    }

    #[test]
    fn an_s_whose_middle_lies_on_its_chord_is_seen() {
        assert!(check(&cubic([0.0, 0.0, 10.0, 30.0, 20.0, -30.0, 30.0, 0.0]), 0.1) > 8);
    }

    #[test]
    fn a_line_is_one_chord_and_a_quarter_circle_a_few() {
        assert_eq!(check(&cubic([0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0]), 1e-3), 1);
        // The sagitta of a chord of a unit circle over an angle a is about a²/8: 0.001 allows 0.0894, which is 17.6 chords.
        let n = check(&cubic([1.0, 0.0, 1.0, 0.552_284_75, 0.552_284_75, 1.0, 0.0, 1.0]), 1e-3);
        assert!((18..=24).contains(&n), "{n}");
    }

    #[test]
    fn what_cannot_be_kept_is_refused() {
        let c = cubic([0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 1.0]);
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-16] {
            assert_eq!(Flattener::new(&c, &bad).unwrap_err(), SamplingError::Length);
        }
        assert!(Flattener::new(&cubic([f64::NAN, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 1.0]), &0.1).is_err());
        let huge = f64::MAX;
        assert!(Flattener::new(&cubic([huge, huge, -huge, huge, huge, -huge, -huge, huge]), &1e300).is_err());
    }

    proptest::proptest! {
        #[test]
        fn every_cubic_keeps_its_tolerance(p in proptest::array::uniform8(-100.0_f64..100.0), bits in 1_i32..12) {
            check(&cubic(p), 2.0_f64.powi(-bits));
        }
    }
}
