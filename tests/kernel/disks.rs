//! Largest empty tangent disks of random strokes: no plain point lies inside, and a guard, which makes those of a row of feet
//! cheaper, changes none.

use crate::common::Random;
use feature_sampling::bezier::Cubic;
use feature_sampling::curve::CurveParam;
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::geometry::Point;
use feature_sampling::medial::{Foot, Guard, Side, tangent_disk, tangent_disk_beside};
use feature_sampling::model::CurveModel;
use feature_sampling::scalar::Scalar;

/// A point on the grid of millionths, in the scalar.
fn scaled<S: Scalar>(p: &Point<f64>) -> Point<S> {
    let [x, y] = [p.x, p.y].map(|v| {
        #[allow(clippy::cast_possible_truncation, reason = "below 20 million")]
        let millionths = (v * 1e6) as i32;
        S::ratio(millionths, 1_000_000)
    });
    Point::new(x, y)
}

/// A long stroke among short ones: disks that a neighbour's arc, the stroke's own, or another's bounds.
fn strokes<S: Scalar>(random: &mut Random) -> CurveModel<S> {
    let cubic = |random: &mut Random, size: f64| {
        let origin = random.point(10.0);
        let mut point = || {
            let p = random.point(size);
            scaled(&Point::new(origin.x + p.x, origin.y + p.y))
        };
        [Cubic::new(point(), point(), point(), point())]
    };
    let list: Vec<[Cubic<S>; 1]> = (0..12).map(|i| cubic(random, if i < 2 { 10.0 } else { 2.0 })).collect();
    let paths: Vec<(bool, &[Cubic<S>])> = list.iter().map(|c| (false, c.as_slice())).collect();
    CurveModel::new(&paths, &DoorOptions::default()).expect("a curve")
}

/// Walks along all segments of some drawings; the largest difference between radii, relatively, beyond what the noise η of
/// the coordinates makes of 1/r = 2A/B: a share 2rη/B on either side.
fn worst<S: Scalar>(drawings: u64) -> S {
    const STEPS: i32 = 120;
    let mut random = Random(7);
    let mut worst = S::zero();
    for _ in 0..drawings {
        let model = strokes::<S>(&mut random);
        let curve = model.curve();
        for (segment, _) in (0_u32..).zip(curve.segments) {
            for side in [Side::Left, Side::Right] {
                let mut guard = Guard::new();
                for k in 1..STEPS {
                    let at = CurveParam { segment, t: S::ratio(k, STEPS) };
                    let foot = Foot::normal(&curve, at, side).expect("a foot");
                    let (alone, beside) = (tangent_disk(&curve, &foot), tangent_disk_beside(&curve, &foot, &mut guard));
                    if alone.radius != beside.radius {
                        let off = (alone.radius.clone() - &beside.radius).abs() / &alone.radius;
                        let touch = beside.touch.and_then(|t| curve.point(&t.at)).expect("finite disks touch");
                        let noise = beside.radius.clone() * curve.noise / &touch.distance_sq(&foot.point);
                        let off = off - &(noise * &S::int(4));
                        assert!(off.is_finite(), "{:?} beside, {:?} alone", beside.radius, alone.radius);
                        worst = worst.max(off);
                    }
                }
            }
        }
    }
    worst
}

#[test]
fn disks_beside_others_are_the_disks_alone() {
    let (double, single) = (worst::<f64>(200), worst::<f32>(200));
    assert!(double <= 1e-11, "{double:e}");
    assert!(single <= 1e-4, "{single:e}");
}

#[test]
fn no_plain_point_lies_inside() {
    const POINTS: u32 = 400;
    let mut random = Random(3);
    for _ in 0..30 {
        let model = strokes::<f64>(&mut random);
        let curve = model.curve();
        let places =
            |segment: u32| (0..=POINTS).map(move |k| CurveParam { segment, t: f64::from(k) / f64::from(POINTS) });
        let count = u32::try_from(curve.segments.len()).expect("a few");
        let points: Vec<Point<f64>> = (0..count).flat_map(places).filter_map(|at| curve.point(&at)).collect();
        for segment in 0..count {
            for (k, side) in (1..40).flat_map(|k| [(k, Side::Left), (k, Side::Right)]) {
                let at = CurveParam { segment, t: f64::from(k) / 40.0 };
                let foot = Foot::normal(&curve, at, side).expect("a foot");
                let bend = |q: &Point<f64>| {
                    let chord = q.minus(&foot.point);
                    // Rounding must not bend what touches the tangent.
                    2.0 * (foot.direction.dot(&chord) - 1e-13) / chord.norm_sq().max(1e-18)
                };
                let plain = points.iter().map(bend).fold(0.0, f64::max);
                let found = tangent_disk(&curve, &foot).radius;
                let most = plain.recip() * (1.0 + 1e-9);
                assert!(found <= most, "{:?} {side}: {found}, at most {most}", foot.at);
            }
        }
    }
}
