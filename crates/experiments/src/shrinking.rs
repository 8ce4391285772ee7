//! The paper's own way to a medial axis (section 7.1), with the choices that Table 2 compares.
//!
//! From a disk as large as the drawing, tangent at the foot, the closest point of *all* segments to the centre is found; if
//! it lies inside, the disk shrinks until it touches it; again, until nothing changes. The nearer of the two sides is kept.
//! The kernel does not work like this: disks with one foot are nested, so one traversal of a hierarchy does, see
//! `feature_sampling::medial::disk`. This is here to be compared with.

use feature_sampling::bezier::hull::hull_keeps_away;
use feature_sampling::bezier::nearest::{critical_points, distance_quintic};
use feature_sampling::curve::{Curve, CurveParam, Segment};
use feature_sampling::geometry::Point;
use feature_sampling::medial::{Foot, MedialPoint, Side};
use feature_sampling::model::{CurveModel, MedialModel};

use crate::companion;

/// The disk is final where no point is nearer to its centre than the foot by more than this share of the diagonal (the
/// paper: 1e-9, in user units). Where the curvature bounds the disk this leaves an error: a disk too large by δ holds points
/// that are nearer by only about δ², so radii there are good to some 1e-5 of themselves and no better.
const PRECISION: f64 = 1e-9;

/// Shrinkings of one disk, at most: each touches a point of the curve, and few are needed.
const SHRINKINGS: usize = 200;

/// Table 2's columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    /// Hull test, specialised quintic solver: the paper's own setting.
    HullTest,
    /// Every segment is solved for.
    NoHullTest,
    /// Hull test; all roots of each quintic from its companion matrix.
    Companion,
}

/// The squared distance of the curve from q where it is below `bound_sq`, and the point.
fn closest(curve: &Curve<'_, f64>, q: &Point<f64>, bound_sq: f64, variant: Variant) -> Option<Point<f64>> {
    let (mut bound_sq, mut best) = (bound_sq, None);
    for segment in curve.segments {
        if variant != Variant::NoHullTest && hull_keeps_away(&segment.cubic, q, &bound_sq) {
            continue;
        }
        let mut offer = |t: f64| {
            let p = segment.point(&t);
            let distance_sq = p.distance_sq(q);
            if distance_sq < bound_sq {
                (bound_sq, best) = (distance_sq, Some(p));
            }
        };
        offer(0.0);
        offer(1.0);
        if variant == Variant::Companion {
            let quintic = distance_quintic(&segment.power, q);
            companion::roots_in_unit(&quintic.coefficients).0.into_iter().for_each(offer);
        } else {
            critical_points(&segment.power, q).into_iter().for_each(offer);
        }
    }
    best
}

/// The radius of the disk at a foot, at most `largest`.
fn shrink(curve: &Curve<'_, f64>, foot: &Foot<f64>, largest: f64, variant: Variant) -> f64 {
    let precision = PRECISION * curve.diagonal;
    let mut radius = largest;
    for _ in 0..SHRINKINGS {
        let centre = foot.point.plus_scaled(&radius, &foot.direction);
        // What is not nearer by more than the precision is the foot itself, or rounding.
        let inner = (radius - precision).max(0.0);
        let Some(q) = closest(curve, &centre, inner * inner, variant) else { break };
        let v = q.minus(&foot.point);
        let above = foot.direction.dot(&v);
        let next = v.norm_sq() / (2.0 * above);
        if !(above > 0.0 && next < radius) {
            break;
        }
        radius = next;
    }
    radius
}

/// The medial point of a place on the curve, on its nearer side.
fn medial_point(curve: &Curve<'_, f64>, segment: u32, t: f64, variant: Variant) -> Option<MedialPoint<f64>> {
    let mut best: Option<MedialPoint<f64>> = None;
    for side in [Side::Left, Side::Right] {
        let at = CurveParam { segment, t };
        let foot = Foot::normal(curve, at, side)?;
        let largest = best.as_ref().map_or(*curve.diagonal, |b| b.radius);
        let radius = shrink(curve, &foot, largest, variant);
        if best.as_ref().is_none_or(|b| radius < b.radius) {
            let centre = foot.point.plus_scaled(&radius, &foot.direction);
            best = Some(MedialPoint { at, foot: foot.point, side, centre, radius, polyline: 0 });
        }
    }
    best
}

/// The one-sided medial polylines of the paper, `steps` feet a segment.
pub fn medial_model(model: &CurveModel<f64>, steps: u32, variant: Variant) -> MedialModel<f64> {
    let curve = model.curve();
    MedialModel::from_paths(curve.paths.iter().map(|path| {
        let mut points: Vec<MedialPoint<f64>> = Vec::new();
        let mut polyline = 0;
        for segment in path.first..path.first + path.count {
            let last = u32::from(segment + 1 == path.first + path.count);
            for i in 0..steps + last {
                let t = f64::from(i) / f64::from(steps);
                let Some(mut point) = medial_point(&curve, segment, t, variant) else { continue };
                if points.last().is_some_and(|before| before.side != point.side) {
                    polyline += 1;
                }
                point.polyline = polyline;
                points.push(point);
            }
        }
        points
    }))
}

/// The parameters at which tables look at a curve: `steps` a segment, of every segment as the door made it.
pub fn places<'c>(curve: &Curve<'c, f64>, steps: u32) -> impl Iterator<Item = (u32, f64, &'c Segment<f64>)> {
    let segments = curve.segments;
    (0_u32..)
        .zip(segments)
        .flat_map(move |(k, segment)| (0..steps).map(move |i| (k, f64::from(i) / f64::from(steps), segment)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use feature_sampling::bezier::Cubic;
    use feature_sampling::curve::door::DoorOptions;
    use feature_sampling::medial::tangent_disk;

    fn drawing() -> CurveModel<f64> {
        let cubic = |p: [[f64; 2]; 4]| Cubic { points: p.map(|[x, y]| Point::new(x, y)) };
        let wave = [cubic([[0.0, 0.0], [30.0, 25.0], [70.0, -25.0], [100.0, 0.0]])];
        let arch = [cubic([[0.0, 40.0], [30.0, 10.0], [70.0, 10.0], [100.0, 40.0]])];
        CurveModel::new(&[(false, &wave), (false, &arch)], &DoorOptions::default()).expect("a curve")
    }

    #[test]
    fn all_variants_find_the_kernels_disks() {
        let model = drawing();
        let curve = model.curve();
        for variant in [Variant::HullTest, Variant::NoHullTest, Variant::Companion] {
            for (segment, t, _) in places(&curve, 23) {
                let found = medial_point(&curve, segment, t, variant).expect("a place");
                let radius = [Side::Left, Side::Right]
                    .into_iter()
                    .filter_map(|side| Foot::normal(&curve, CurveParam { segment, t }, side))
                    .map(|foot| tangent_disk(&curve, &foot).radius)
                    .fold(*model.diagonal(), f64::min);
                assert!((found.radius / radius - 1.0).abs() < 1e-3, "{variant:?} {segment} {t}: {found:?} {radius}");
            }
        }
    }
}
