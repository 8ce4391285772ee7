//! All tangent disks of one radius along a cell, in plain numbers.
//!
//! Whether a piece of C stays out of all of them is decided by the disk in the middle and a bound of how much the others differ, with an
//! allowance for every rounding. It is asked first: the forms of [`super::clear`] take thirty times as long, and are needed only where the
//! piece comes near the feet themselves. With w = q − fₘ, x = T·w along the tangent and y = n·w,
//!
//! ```text
//! G(f, q) = |q−f|² − 2R d·(q−f) ≥ |w|² − 2R y − m(w)    for all feet (f, d) of the cell, and all q:
//! m = 2hM (|x| + h(1 + K(|w| + h)))         along a stretch with curvature: M = max |1−kR|, K = max |k|;
//! m = 2R (α|x| + α²|y|/2)                   for a fan;
//! m = 2RH + H²                              for anything else, H the spread at R.
//! ```
//!
//! m is convex, so along a cubic it is at most what its values at the control points say in Bernstein's basis, and so one polynomial of
//! degree 6 decides. Proof: `docs/certificates.md`, section 4.

use super::cell::{Cell, FootSpan, slop};
use super::clear::Scene;
use crate::geometry::{Point, Vector};
use crate::scalar::Directed;

/// How the disks of a cell differ from the one in its middle.
enum Change<S> {
    /// 2hM, and h(1 + Kh), and hK.
    Stretch { shift: S, apart: S, bend: S },
    /// 2Rα, and Rα².
    Fan { aside: S, ahead: S },
    /// 2RH + H².
    Any(S),
}

/// The tangent disks of one radius at all feet of a cell.
pub(super) struct Family<S> {
    foot: Point<S>,
    normal: Vector<S>,
    /// 2R.
    width: S,
    change: Change<S>,
    /// What w may be off by, and how much more of that for each unit of |w|.
    off: [S; 2],
    /// How fast G and m change with w, beside 2|w|.
    slope: S,
}

/// w of a point as the family sees it.
struct Seen<S> {
    w: Vector<S>,
    /// 2R y + m.
    needed: S,
    /// At least |w|.
    far: S,
}

impl<S: Directed> Family<S> {
    pub(super) fn new(scene: &Scene<'_, S>, cell: &Cell<S>, radius: &S) -> Self {
        let one = S::one;
        let width = radius.clone().twice();
        let [e0, e1] = &cell.errors;
        let h = &cell.half;
        let (change, slope) = match (&cell.feet, &cell.bend) {
            (FootSpan::Fan { .. }, _) => {
                let turn = &cell.turn;
                let aside = width.clone() * turn;
                let ahead = (turn.clone().square().half() + &e1.clone().twice()) * &width;
                let slope = aside.clone() + &ahead;
                (Change::Fan { aside, ahead }, slope)
            }
            (_, Some([k0, k1])) => {
                let most = k0.clone().abs().max(k1.clone().abs());
                let moved = |k: &S| (one() - &(k.clone() * radius)).abs();
                let rounded = (most.clone() * radius + &one()) * &S::unit_roundoff().mul_pow2(3);
                let shift = (moved(k0).max(moved(k1)) + &rounded) * h;
                let bend = most * h;
                let apart = (bend.clone() + &one()) * h;
                let slope = shift.clone().twice() * &(one() + &bend.clone().twice());
                (Change::Stretch { shift: shift.twice(), apart, bend }, slope)
            }
            _ => {
                let spread = cell.spread(radius, radius);
                (Change::Any((width.clone() + &spread) * &spread), S::zero())
            }
        };
        let (foot, normal) = (cell.centre.clone(), cell.normal.clone());
        let off = [slop(scene) + e0, e1.clone()];
        Self { foot, normal, slope: slope + &width, width, change, off }
    }

    fn see(&self, q: &Point<S>) -> Seen<S> {
        let w = q.minus(&self.foot);
        let x = self.normal.cross(&w).abs();
        let y = self.normal.dot(&w);
        let far = x.clone() + &y.clone().abs();
        let m = match &self.change {
            Change::Stretch { shift, apart, bend } => (bend.clone() * &far + &x + apart) * shift,
            Change::Fan { aside, ahead } => aside.clone() * &x + &(ahead.clone() * &y.clone().abs()),
            Change::Any(m) => m.clone(),
        };
        Seen { needed: y * &self.width + &m, w, far }
    }

    /// What G − m may be off by where |w| is at most `far` and m at most `most`: by w, and by rounding.
    fn error(&self, far: &S, most: &S) -> S {
        let [e, e1] = &self.off;
        let off = e1.clone() * far + e;
        let by_w = (far.clone().twice() + &self.slope + &off) * &off;
        let size = (far.clone() + &self.width) * far + most;
        by_w * &S::ratio(9, 8) + &(size * &S::unit_roundoff().mul_pow2(6))
    }

    /// The cubic with these control points, each off by no more than the slop, lies outside of all disks. `false`: not shown.
    pub(super) fn clears(&self, points: &[Point<S>; 4]) -> bool {
        let [p0, p1, p2, p3] = points;
        let (p0, p1, p2, p3) = (self.see(p0), self.see(p1), self.see(p2), self.see(p3));
        let far = p0.far.clone().max(p1.far.clone()).max(p2.far.clone().max(p3.far.clone()));
        let size = |s: &Seen<S>| s.needed.clone().abs();
        let most = size(&p0).max(size(&p1)).max(size(&p2).max(size(&p3)));
        // What is far inside at an end is not worth more.
        let least = self.error(&far, &most);
        let first = p0.w.norm_sq() - &p0.needed;
        let last = p3.w.norm_sq() - &p3.needed;
        if first < least || last < least {
            return false;
        }
        let three = S::int(3);
        let (a0, a1, a2, a3) = (&p0.needed, &p1.needed, &p2.needed, &p3.needed);
        let (w0, w1, w2, w3) = (&p0.w, &p1.w, &p2.w, &p3.w);
        // |w|² − (2R y + m) in Bernstein's basis of degree 6, each coefficient times what makes it free of fractions.
        let second = w0.dot(w1).twice() - &(a0.clone() + a1);
        let fifth = w2.dot(w3).twice() - &(a2.clone() + a3);
        if second < least.clone().twice() || fifth < least.clone().twice() {
            return false;
        }
        let five = least.clone() * &S::int(5);
        let third = w0.dot(w2).twice() + &(w1.norm_sq() * &three) - &(a1.clone() * &three + a0 + a2);
        let fourth = w1.dot(w3).twice() + &(w2.norm_sq() * &three) - &(a2.clone() * &three + a1 + a3);
        if third < five || fourth < five {
            return false;
        }
        let nine = S::int(9);
        let middle = (w1.dot(w2) * &nine + &w0.dot(w3)).twice() - &((a1.clone() + a2) * &nine + a0 + a3);
        middle >= least * &S::int(20)
    }

    /// About the largest radius of which the disks leave out a point of C; infinite where all do.
    pub(super) fn most(&self, q: &Point<S>) -> S {
        let seen = self.see(q);
        let size = seen.needed.clone().abs();
        let needed = seen.needed + &self.error(&seen.far, &size);
        if needed > S::zero() { seen.w.norm_sq() / &needed * &self.width.clone().half() } else { S::infinity() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bezier::Cubic;
    use crate::curve::door::DoorOptions;
    use crate::curve::{EndId, ideal};
    use crate::medial::Side;
    use crate::model::CurveModel;
    use alloc::vec::Vec;

    /// What is said to lie outside of all disks of a cell does, wherever it is looked at; and what lies well outside is said to.
    #[test]
    fn agrees_with_plain_points() {
        let mut state = 7_u64;
        let mut unit = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        // Outside of a stretch's disks and of a fan's: shown; inside, so not shown; outside by a tenth, and not shown.
        let mut counts = [[0_u32; 3]; 2];
        for _ in 0..60 {
            let mut point = || Point::new(10.0 * unit(), 10.0 * unit());
            let cubics =
                [[Cubic::new(point(), point(), point(), point())], [Cubic::new(point(), point(), point(), point())]];
            let paths: Vec<(bool, &[Cubic<f64>])> = cubics.iter().map(|c| (false, c.as_slice())).collect();
            let model = CurveModel::new(&paths, &DoorOptions::default()).expect("a curve");
            let curve = model.curve();
            let mut coefficients = Vec::new();
            ideal::coefficients(&curve, &mut coefficients).expect("a vector");
            let scene = Scene { curve: &curve, ideal: &coefficients };
            for _ in 0..200 {
                let width = 0.2 * unit().powi(4);
                let (from, left) = (unit() * (1.0 - width), unit() < 0.5);
                let fan = unit() < 0.3;
                let span = [from, from + width];
                let end = EndId::new(0, 1);
                let feet = if fan {
                    FootSpan::Fan { end, other: end, left, span }
                } else {
                    FootSpan::Normal { segment: 0, span, side: if left { Side::Left } else { Side::Right } }
                };
                let cell = Cell::new(&scene, feet);
                let radius = 0.05 * 200.0_f64.powf(unit());
                let long = 0.3 * unit().powi(3);
                let start = unit() * (1.0 - long);
                let Some(other) = curve.segment(1) else { continue };
                let part = other.cubic.part(&start, &(start + long));
                let said = Family::new(&scene, &cell, &radius).clears(&part.points);
                let mut least = f64::INFINITY;
                for i in 0..=8 {
                    let t = from + width * f64::from(i) / 8.0;
                    let at = match feet {
                        FootSpan::Fan { .. } => FootSpan::Fan { end, other: end, left, span: [t, t] },
                        FootSpan::Normal { segment, side, .. } => FootSpan::Normal { segment, side, span: [t, t] },
                        corner @ FootSpan::Corner { .. } => corner,
                    };
                    let one = Cell::new(&scene, at);
                    for k in 0..=40 {
                        let q = part.eval(&(f64::from(k) / 40.0));
                        let w = q.minus(&one.centre);
                        least = least.min((w.norm_sq() - 2.0 * radius * w.dot(&one.normal)) / (radius * radius));
                    }
                }
                assert!(!said || least >= -1e-12, "{feet:?}, radius {radius}: {least}");
                let count = &mut counts[usize::from(fan)];
                count[0] += u32::from(said);
                count[1] += u32::from(least < 0.0);
                count[2] += u32::from(!said && least > 0.1 && width < 0.01);
            }
        }
        for [shown, inside, missed] in counts {
            assert!(shown > 500 && inside > 200 && missed < shown / 20, "{counts:?}");
        }
    }
}
