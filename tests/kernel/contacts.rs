//! Where a curve touches itself: outlines that nearly coincide, and plain crossings.

use crate::common::{Stroke, closed, curve_model, ellipse, mapped, polygon, pt};
use feature_sampling::bezier::Cubic;
use feature_sampling::curve::contact::{place, reach};
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::model::CurveModel;

fn model(strokes: &[Stroke]) -> CurveModel<f64> {
    curve_model(strokes, &DoorOptions::default())
}

/// A clock, a gesture and a balloon of public icon sets took half a minute each, while strokes were told apart a
/// hundred-thousandth of the diagonal at a time.
#[test]
fn outlines_a_millionth_apart_do_not_touch() {
    for gap in [1e-3, 1e-6, 1e-7] {
        let inner = ellipse(0.0, 0.0, 3.0, 2.0);
        let outer = ellipse(0.0, 0.0, 3.0 * (1.0 + gap), 2.0 * (1.0 + gap));
        assert_eq!(model(&[inner, outer]).contacts(), [], "gap {gap}");
    }
}

/// As programs write it that keep fill and stroke apart.
#[test]
fn an_outline_drawn_twice_with_other_joints_touches_all_along() {
    let once = ellipse(0.0, 0.0, 3.0, 2.0);
    let halves = |c: &Cubic<f64>| {
        let (a, b) = c.split_at(&0.3);
        [a, b]
    };
    let twice = closed(once.cubics.iter().flat_map(halves).collect());
    let model = model(&[once, twice]);
    assert_eq!(model.curve().segments.len(), 12, "4 and 8 cubics");
    for segment in 0..12 {
        let own = model.contacts().iter().filter(|c| c.segment == segment);
        let share: f64 = own.map(|c| c.span[1] - c.span[0]).sum();
        assert!((share - 1.0).abs() < 1e-4, "segment {segment}: {share} of it touches");
    }
    // A few for each segment, not one for each hundred-thousandth.
    assert!(model.contacts().len() < 60, "{} contacts", model.contacts().len());
}

#[test]
fn crossings_are_found_where_they_are() {
    // By symmetry the two ellipses cross on the diagonals; the cubics are symmetric too.
    let strokes = [ellipse(0.0, 0.0, 3.0, 2.0), ellipse(0.0, 0.0, 2.0, 3.0)];
    for angle in [0.0_f64, 0.7] {
        let (sin, cos) = angle.sin_cos();
        let turned = mapped(&strokes, |p| pt(cos * p.x - sin * p.y, sin * p.x + cos * p.y));
        let model = model(&turned);
        let curve = model.curve();
        assert_eq!(model.contacts().len(), 8, "four crossings, on either stroke");
        for contact in model.contacts() {
            let p = curve.point(&place(contact)).expect("a place on the curve");
            let (x, y) = (cos * p.x + sin * p.y, cos * p.y - sin * p.x);
            assert!((x.abs() - y.abs()).abs() <= 4.0 * reach(&curve), "({x}, {y}) is off the diagonal");
        }
    }
}

/// {n/k} has n(k − 1) crossings, and its corners are none of them: {7/3} has corners of 26°, {24/11} of 15°.
#[test]
fn a_star_polygon_crosses_itself_as_often_as_it_should() {
    for (n, k) in [(7, 2), (7, 3), (24, 7), (24, 11)] {
        let corner = |i: usize| {
            let angle = std::f64::consts::TAU * (i * k % n) as f64 / n as f64;
            [angle.cos(), angle.sin()]
        };
        let corners: Vec<_> = (0..n).map(corner).collect();
        let model = model(&[polygon(true, &corners)]);
        assert_eq!(model.contacts().len(), 2 * n * (k - 1), "{{{n}/{k}}}");
    }
}
