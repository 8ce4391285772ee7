//! Elliptical arcs as cubics.
//!
//! A circular arc of angle θ and radius R is replaced by the cubic with the same ends and end tangents whose handles
//! are (4/3) tan(θ/4) R long. It touches the circle at both ends and in the middle, and lies outside it elsewhere, by
//! at most 2.73e-4 R for θ = 90° (4.2e-6 R for 45°); an ellipse is an affine image, with the same figure relative
//! to its axes. Pieces are at most 90° long: the ones browsers, Inkscape and plotters' programs draw, four to the
//! circle. The sampler's answers are exact for *that* curve: its smallest curvature radius is 0.9921 R, and so is
//! its local feature size. Finer pieces would bring this nearer to R, at the price of a drawing that differs from
//! what everyone else makes of the same file.
//!
//! The conversion from SVG's end points and flags to centre and angles follows the implementation notes of SVG 2
//! (section B.2.4), done in coordinates where the ellipse is the unit circle: there the centre is found from half
//! the chord alone and no fourth powers of coordinates occur.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::transform::sin_cos_degrees;

/// Handle length of a quarter of the unit circle: (4/3) tan(π/8) = (4/3)(√2 − 1).
pub(super) const QUARTER_HANDLE: f64 = 0.552_284_749_830_793_6;

/// An angle may exceed whole quarters by this fraction of one before another piece is added: end points come with
/// five or six digits, and a half circle should not become three pieces because of the last.
const SLACK: f64 = 1e-6;

/// Radii, rotation in degrees and flags of an arc command.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArcShape {
    pub(super) rx: f64,
    pub(super) ry: f64,
    pub(super) rotation: f64,
    pub(super) large: bool,
    pub(super) sweep: bool,
}

/// Hands the three later control points of each piece of the arc to `piece`, in order; the last ends at `to`
/// exactly. Gives false and hands out nothing where the arc is a straight line: a radius is 0, or the chord
/// is nothing beside the radii.
pub(super) fn arc_to(
    from: (f64, f64),
    to: (f64, f64),
    shape: &ArcShape,
    mut piece: impl FnMut((f64, f64), (f64, f64), (f64, f64)),
) -> bool {
    let (mut rx, mut ry) = (shape.rx.abs(), shape.ry.abs());
    if rx == 0.0 || ry == 0.0 {
        return false;
    }
    let (sin, cos) = sin_cos_degrees(shape.rotation);
    // Half the chord, from `from` to `to`, in the frame where the ellipse is the unit circle.
    let (hx, hy) = ((to.0 - from.0) / 2.0, (to.1 - from.1) / 2.0);
    let mut half = ((hx * cos + hy * sin) / rx, (hy * cos - hx * sin) / ry);
    let mut length = half.0.hypot(half.1);
    if length == 0.0 {
        return false; // The chord vanishes beside the radii: no centre can be told from another.
    }
    if length > 1.0 {
        // Radii too small for the chord grow until it is a diameter.
        rx *= length;
        ry *= length;
        half = (half.0 / length, half.1 / length);
        length = 1.0;
    }
    // The centre lies across the chord's middle, to the left or right of it.
    let side = if shape.large == shape.sweep { -1.0 } else { 1.0 };
    let k = side * ((1.0 - length) * (1.0 + length)).sqrt() / length;
    let centre = (-half.1 * k, half.0 * k);
    let start = (-half.0 - centre.0, -half.1 - centre.1);
    let end = (half.0 - centre.0, half.1 - centre.1);
    let angle0 = start.1.atan2(start.0);
    let mut turn = (start.0 * end.1 - start.1 * end.0).atan2(start.0 * end.0 + start.1 * end.1);
    if shape.sweep && turn < 0.0 {
        turn += TAU;
    } else if !shape.sweep && turn > 0.0 {
        turn -= TAU;
    }

    if !turn.is_finite() {
        // Radii and chord too far apart for f64. The pen reports what is not finite, so hand it that.
        piece(to, to, (f64::NAN, f64::NAN));
        return true;
    }
    let quarters = (turn.abs() / FRAC_PI_2 - SLACK).ceil().clamp(1.0, 4.0);
    let step = turn / quarters;
    let handle = 4.0 / 3.0 * (step / 4.0).tan();
    let middle = ((from.0 + to.0) / 2.0, (from.1 + to.1) / 2.0);
    let place = |u: f64, v: f64| {
        let (x, y) = ((u + centre.0) * rx, (v + centre.1) * ry);
        (middle.0 + x * cos - y * sin, middle.1 + x * sin + y * cos)
    };
    let mut a = angle0;
    let mut done = 0.0;
    while done < quarters {
        done += 1.0;
        let b = angle0 + done * step;
        let ((sa, ca), (sb, cb)) = (a.sin_cos(), b.sin_cos());
        let end = if done < quarters { place(cb, sb) } else { to };
        piece(place(ca - handle * sa, sa + handle * ca), place(cb + handle * sb, sb - handle * cb), end);
        a = b;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest distance of the arc's cubics from the circle round the origin, over its radius.
    fn departure(from: (f64, f64), to: (f64, f64), radius: f64, large: bool, sweep: bool) -> (usize, f64) {
        use feature_sampling::{bezier::Cubic, geometry::Point};
        let shape = ArcShape { rx: radius, ry: radius, rotation: 0.0, large, sweep };
        let (mut here, mut worst, mut count) = (from, 0.0_f64, 0);
        assert!(arc_to(from, to, &shape, |p, q, r| {
            let c = Cubic::new(
                Point::new(here.0, here.1),
                Point::new(p.0, p.1),
                Point::new(q.0, q.1),
                Point::new(r.0, r.1),
            );
            for i in 0..=1000 {
                let p = c.eval(&(f64::from(i) / 1000.0));
                worst = worst.max((p.x.hypot(p.y) / radius - 1.0).abs());
            }
            here = r;
            count += 1;
        }));
        assert_eq!(here, to, "the arc ends where it should, to the bit");
        (count, worst)
    }

    #[test]
    fn quarters_keep_the_stated_error() {
        let (count, worst) = departure((5.0, 0.0), (0.0, 5.0), 5.0, false, true);
        assert_eq!(count, 1);
        assert!((2.7e-4..2.74e-4).contains(&worst), "{worst}");
        let (count, worst) = departure((5.0, 0.0), (0.0, 5.0), 5.0, true, false);
        assert_eq!(count, 3);
        assert!(worst < 2.74e-4, "{worst}");
        let h = 5.0 * 0.5_f64.sqrt();
        let (count, worst) = departure((5.0, 0.0), (h, h), 5.0, false, true);
        assert_eq!(count, 1);
        assert!(worst < 4.3e-6, "{worst}");
    }

    #[test]
    fn half_circles_are_two_pieces_whatever_the_last_digit() {
        for radius in [1.0, 0.999_999_9, 1.000_000_000_1] {
            let shape = ArcShape { rx: radius, ry: radius, rotation: 0.0, large: false, sweep: true };
            let mut count = 0;
            arc_to((1.0, 0.0), (-1.0, 0.0), &shape, |_, _, _| count += 1);
            assert_eq!(count, 2, "{radius}");
        }
    }

    #[test]
    fn the_four_flags_choose_the_four_arcs() {
        // Chord from (0,0) to (1,1) on unit circles round (1,0) and (0,1).
        for (large, sweep, middle) in [
            (false, false, (1.0 - 0.5_f64.sqrt(), 0.5_f64.sqrt())),
            (false, true, (0.5_f64.sqrt(), 1.0 - 0.5_f64.sqrt())),
        ] {
            let shape = ArcShape { rx: 1.0, ry: 1.0, rotation: 0.0, large, sweep };
            arc_to((0.0, 0.0), (1.0, 1.0), &shape, |p, q, _| {
                let x = (3.0 * p.0 + 3.0 * q.0 + 1.0) / 8.0;
                let y = (3.0 * p.1 + 3.0 * q.1 + 1.0) / 8.0;
                assert!((x - middle.0).abs() < 1e-12 && (y - middle.1).abs() < 1e-12, "{x} {y}");
            });
        }
        for (large, sweep, second) in [(true, false, (-1.0, 1.0)), (true, true, (1.0, -1.0))] {
            let shape = ArcShape { rx: 1.0, ry: 1.0, rotation: 0.0, large, sweep };
            let mut ends = Vec::new();
            arc_to((0.0, 0.0), (1.0, 1.0), &shape, |_, _, r| ends.push(r));
            assert_eq!(ends.len(), 3);
            let hit = ends.iter().any(|e| (e.0 - second.0).abs() < 1e-12 && (e.1 - second.1).abs() < 1e-12);
            assert!(hit, "{large} {sweep}: {ends:?}");
        }
    }

    #[test]
    fn radii_that_are_too_small_grow_and_negative_ones_lose_their_sign() {
        let shape = ArcShape { rx: -1e-300, ry: 1e-300, rotation: 0.0, large: false, sweep: true };
        let mut ends = Vec::new();
        assert!(arc_to((-3.0, 0.0), (3.0, 0.0), &shape, |_, _, r| ends.push(r)));
        assert_eq!(ends.len(), 2);
        assert!((ends[0].0).abs() < 1e-12 && (ends[0].1 + 3.0).abs() < 1e-12, "{ends:?}");
    }

    #[test]
    fn what_f64_cannot_hold_is_handed_out_as_such() {
        let shape = ArcShape { rx: 1e300, ry: 1e-300, rotation: 45.0, large: false, sweep: true };
        let mut ends = Vec::new();
        assert!(arc_to((0.0, 0.0), (5.0, 1e200), &shape, |_, _, r| ends.push(r)));
        assert!(ends.iter().any(|e| e.0.is_nan()), "{ends:?}");
    }

    #[test]
    fn a_rotated_ellipse_keeps_its_axes() {
        // An ellipse with half axes 4 and 2 turned by 90°: half axes 2 along x, 4 along y.
        let shape = ArcShape { rx: 4.0, ry: 2.0, rotation: 90.0, large: false, sweep: true };
        let mut ends = Vec::new();
        arc_to((-2.0, 0.0), (2.0, 0.0), &shape, |_, _, r| ends.push(r));
        assert_eq!(ends.len(), 2);
        assert!((ends[0].0).abs() < 1e-12 && (ends[0].1 + 4.0).abs() < 1e-12, "{ends:?}");
    }

    #[test]
    fn a_zero_radius_is_a_line() {
        let shape = ArcShape { rx: 0.0, ry: 2.0, rotation: 0.0, large: false, sweep: true };
        assert!(!arc_to((0.0, 0.0), (1.0, 1.0), &shape, |_, _, _| ()));
    }

    #[test]
    fn the_quarter_handle_is_its_formula() {
        assert!((QUARTER_HANDLE - 4.0 / 3.0 * (2.0_f64.sqrt() - 1.0)).abs() < 1e-15);
    }
}
