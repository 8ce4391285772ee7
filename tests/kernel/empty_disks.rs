//! The heart of the certificates: where an emptiness proof or an upper bound of radii is given, plain points must agree.
//!
//! A verdict can be right although the proof behind it is void, because the searches that propose bounds are good. So the proofs
//! are asked here directly, with radii that are too large as often as not.

use crate::common::Random;
use feature_sampling::bezier::Cubic;
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::curve::{CurveParam, EndId, ideal};
use feature_sampling::geometry::{Point, Vector};
use feature_sampling::medial::cell::FootSpan;
use feature_sampling::medial::clear::{Scene, Stretch, clears, reaches};
use feature_sampling::medial::disk::tangent_disk;
use feature_sampling::medial::{Foot, Side};
use feature_sampling::model::CurveModel;

impl Random {
    /// A short or a long piece of [0, 1], now and then up to an end.
    fn span(&mut self) -> [f64; 2] {
        let length = [0.5, 0.1, 0.01, 1e-3][self.below(4) as usize];
        let from = self.unit() * (1.0 - length);
        match self.below(6) {
            0 => [0.0, length],
            1 => [1.0 - length, 1.0],
            _ => [from, from + length],
        }
    }
}

/// Three cubics in a row with a smooth joint between the first two, and a stroke of its own: all that forms tell apart.
fn strokes(random: &mut Random) -> CurveModel<f64> {
    let mut point = || random.point(10.0);
    let (a, b, c, d) = (point(), point(), point(), point());
    let ahead = d.minus(&c);
    let (f, g, h) = (point(), point(), point());
    let e = Point::new(d.x + 0.7 * ahead.x, d.y + 0.7 * ahead.y);
    let row = [Cubic::new(a, b, c, d), Cubic::new(d, e, f, g), Cubic::new(g, point(), point(), h)];
    let other = [Cubic::new(point(), point(), point(), point())];
    CurveModel::new(&[(false, &row), (false, &other)], &DoorOptions::default()).expect("a curve")
}

#[test]
fn proofs_agree_with_plain_points() {
    let mut random = Random(1);
    // Own segment, across a smooth joint, anything else: how often a disk was proved empty, and was plainly not.
    let mut counts = [[0_u32; 2]; 3];
    for _ in 0..150 {
        let model = strokes(&mut random);
        let curve = model.curve();
        let mut coefficients = Vec::new();
        ideal::coefficients(&curve, &mut coefficients).expect("a vector");
        let scene = Scene { curve: &curve, ideal: &coefficients };
        for _ in 0..60 {
            let side = if random.below(2) == 0 { Side::Left } else { Side::Right };
            let span = FootSpan::Normal { segment: random.below(4), span: random.span(), side };
            let piece = Stretch { segment: random.below(4), span: random.span() };
            let radius = 0.02 * 1000.0_f64.powf(random.unit());
            let FootSpan::Normal { segment, span: [a, b], .. } = span else { continue };
            let Some(feet) = span.feet(&scene) else { continue };
            let proved = clears(&scene, &feet, &piece, &radius);
            // The deepest that a plain point lies in a plain disk.
            let own = curve.segment(segment).expect("a segment");
            let its = curve.segment(piece.segment).expect("a segment");
            let mut depth = f64::NEG_INFINITY;
            for i in 0..=12 {
                let s = a + (b - a) * f64::from(i) / 12.0;
                let (f, left) = (own.point(&s), own.tangent(&s).left());
                let d: Vector<f64> = if side == Side::Left { left } else { left.opposite() };
                let centre = Point::new(f.x + radius * d.x, f.y + radius * d.y);
                for k in 0..=40 {
                    let t = piece.span[0] + (piece.span[1] - piece.span[0]) * f64::from(k) / 40.0;
                    depth = depth.max(radius - its.point(&t).distance(&centre));
                }
            }
            let inside = depth > 1e-9 * (radius + 10.0);
            assert!(!(proved && inside), "{segment} {:?} {piece:?} {radius}: {depth}", [a, b]);
            let form = match (segment, piece.segment) {
                (s, q) if s == q => 0,
                (0, 1) | (1, 0) => 1,
                _ => 2,
            };
            counts[form][0] += u32::from(proved);
            counts[form][1] += u32::from(inside);
        }
    }
    for [proved, inside] in counts {
        assert!(proved > 100 && inside > 100, "both happen, often: {counts:?}");
    }
}

#[test]
fn upper_bounds_are_above_plain_radii() {
    let mut random = Random(2);
    let mut finite = 0_u32;
    for _ in 0..150 {
        let model = strokes(&mut random);
        let curve = model.curve();
        let mut coefficients = Vec::new();
        ideal::coefficients(&curve, &mut coefficients).expect("a vector");
        let scene = Scene { curve: &curve, ideal: &coefficients };
        for _ in 0..40 {
            let side = if random.below(2) == 0 { Side::Left } else { Side::Right };
            let (segment, [a, b]) = (random.below(4), random.span());
            let Some(feet) = (FootSpan::Normal { segment, span: [a, b], side }).feet(&scene) else { continue };
            let upper = reaches(&scene, &feet, random.below(4), &random.unit());
            finite += u32::from(upper.is_finite());
            for i in 0..=8 {
                let at = CurveParam { segment, t: a + (b - a) * f64::from(i) / 8.0 };
                let radius = Foot::normal(&curve, at, side).map_or(0.0, |foot| tangent_disk(&curve, &foot).radius);
                assert!(radius <= upper * (1.0 + 1e-9) + 1e-9, "{at:?}: {radius} above {upper}");
            }
        }
    }
    assert!(finite > 300, "{finite} say something");
}

/// Fans of directions at open ends: pieces of the end's own stroke, where all depends on what turns away first, and any others.
#[test]
fn fans_agree_with_plain_points() {
    let mut random = Random(3);
    // Own segment and others: how often a disk was proved empty, and was plainly not.
    let mut counts = [[0_u32; 2]; 2];
    for _ in 0..200 {
        let model = strokes(&mut random);
        let curve = model.curve();
        let mut coefficients = Vec::new();
        ideal::coefficients(&curve, &mut coefficients).expect("a vector");
        let scene = Scene { curve: &curve, ideal: &coefficients };
        for _ in 0..60 {
            let (segment, side) = [(0, 0), (2, 1), (3, 0), (3, 1)][random.below(4) as usize];
            let end = EndId::new(segment, side);
            let left = random.below(2) == 0;
            let scale = [1.0, 0.1, 1e-2, 1e-4][random.below(4) as usize];
            let span = random.span().map(|l| scale * l);
            let Some(feet) = (FootSpan::Fan { end, other: end, left, span }).feet(&scene) else { continue };
            let own = random.below(2) == 0;
            let its = if own { segment } else { random.below(4) };
            let (t, length) = (if side == 0 { 0.0 } else { 1.0 }, 10.0_f64.powf(-4.0 * random.unit()));
            let piece = match random.below(2) {
                // From the end on, or somewhere.
                0 if own => Stretch { segment: its, span: if side == 0 { [0.0, length] } else { [1.0 - length, 1.0] } },
                _ => Stretch { segment: its, span: random.span() },
            };
            let stroke = curve.segment(segment).expect("a segment");
            // Radii about that of curvature, and others.
            let bent = {
                let d = stroke.power.derivative(&t);
                d.norm_sq() * d.norm() / d.cross(&stroke.power.second_derivative(&t)).abs()
            };
            let radius =
                if random.below(2) == 0 { bent * (0.7 + random.unit()) } else { 0.02 * 1000.0_f64.powf(random.unit()) };
            let proved = clears(&scene, &feet, &piece, &radius);
            let tangent = stroke.tangent(&t);
            let u = if side == 0 { tangent } else { tangent.opposite() };
            let first = if left { u.left() } else { u.left().opposite() };
            let f = stroke.point(&t);
            let mut depth = f64::NEG_INFINITY;
            for i in 0..=8 {
                let l = span[0] + (span[1] - span[0]) * f64::from(i) / 8.0;
                let d = first.scaled(&(1.0 - l)).plus_scaled(&-l, &u).unit().expect("a direction");
                let centre = f.plus_scaled(&radius, &d);
                for k in 0..=60 {
                    let q = piece.span[0] + (piece.span[1] - piece.span[0]) * f64::from(k) / 60.0;
                    depth = depth.max(radius - curve.segment(its).expect("a segment").point(&q).distance(&centre));
                }
            }
            let inside = depth > 1e-9 * (radius + 10.0);
            assert!(!(proved && inside), "{end:?} {left} {span:?} {piece:?} {radius}: {depth}");
            let form = usize::from(its != segment);
            counts[form][0] += u32::from(proved);
            counts[form][1] += u32::from(inside);
        }
    }
    for [proved, inside] in counts {
        assert!(proved > 100 && inside > 100, "both happen, often: {counts:?}");
    }
}
