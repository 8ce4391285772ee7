//! Small random drawings on an integer lattice, where degeneracies abound: coinciding points, collinear handles, retracted
//! handles, cusps, crossings, overlaps, ends that meet. Nothing may panic; outputs are finite and in order. The seed is
//! fixed, so that every run judges the same drawings; `PROPTEST_CASES` and `PROPTEST_RNG_SEED` ask for others.

use crate::common::{Model, Stroke, curve_model, pt, rounded};
use feature_sampling::bezier::Cubic;
use feature_sampling::buffer::SliceStore;
use feature_sampling::curve::CurveParam;
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::medial::walk::relevance;
use feature_sampling::medial::{MedialPoint, Resolution, walk};
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::Bound;
use feature_sampling::scalar::Scalar;
use proptest::prelude::*;

/// One to four cubics in up to three paths.
fn drawings() -> impl Strategy<Value = Vec<Stroke>> {
    let point = || (0..7_i32, 0..7_i32).prop_map(|(x, y)| pt(f64::from(x), f64::from(y)));
    let path = (any::<bool>(), point(), prop::collection::vec([point(), point(), point()], 1..=2)).prop_map(
        |(closed, start, rest)| {
            let mut at = start;
            let cubics = rest.into_iter().map(|[b, c, d]| Cubic::new(std::mem::replace(&mut at, d), b, c, d)).collect();
            Stroke { closed, cubics }
        },
    );
    prop::collection::vec(path, 1..=3)
}

/// Everything that can be said of any drawing.
fn holds<S: Scalar>(strokes: &[Stroke], slack: f64, resolution: &Resolution<S>) -> Result<(), TestCaseError> {
    let strokes = rounded::<S>(strokes);
    let paths: Vec<(bool, &[Cubic<S>])> = strokes.iter().map(|s| (s.closed, s.cubics.as_slice())).collect();
    let Ok(curve) = CurveModel::new(&paths, &DoorOptions::default()) else {
        let first = strokes[0].cubics[0].points[0].clone();
        let one_point = strokes.iter().flat_map(|s| &s.cubics).flat_map(|c| &c.points).all(|p| *p == first);
        prop_assert!(one_point, "only a drawing without extent is refused");
        return Ok(());
    };
    let tolerance = S::from_f64(1e-2);
    let medial = MedialModel::new(&curve, resolution);
    for m in medial.points() {
        prop_assert!(m.centre.is_finite() && m.radius.is_finite() && m.radius >= S::zero(), "{m:?}");
    }
    let model = Model { curve, medial, tolerance };
    let c = model.curve.curve();
    let diagonal = c.diagonal.to_f64();
    // lfs along the curve: not negative, and 1-Lipschitz.
    for (i, _) in (0_u32..).zip(c.segments) {
        let mut before = None;
        for k in 0..=40 {
            let p = c.point(&CurveParam { segment: i, t: S::ratio(k, 40) }).expect("a place");
            let lfs = model.medial.lfs(&p).to_f64();
            prop_assert!(lfs >= 0.0, "lfs {lfs}");
            if let Some((q, other)) = before.replace((p.clone(), lfs))
                && lfs.is_finite()
            {
                let step = p.distance(&q).to_f64();
                prop_assert!((lfs - other).abs() <= step * (1.0 + slack) + slack * diagonal, "{lfs} {other} {step}");
            }
        }
    }
    for epsilon in [0.4, 1.0] {
        let samples = model.sample(&model.options(epsilon));
        for s in &samples {
            prop_assert!(s.point.is_finite() && s.lfs >= S::zero(), "{s:?}");
            prop_assert!(s.at.t >= S::zero() && s.at.t <= S::one(), "{s:?}");
            prop_assert_eq!(c.point(&s.at), Some(s.point.clone()));
        }
        for (index, path) in (0_u32..).zip(c.paths) {
            let own: Vec<_> = samples.iter().filter(|s| s.path == index).collect();
            prop_assert!(!own.is_empty(), "path {index} has no sample");
            let (first, last) = (own[0], own[own.len() - 1]);
            prop_assert_eq!(first.bound, Bound::Start);
            if !path.closed {
                prop_assert_eq!((first.at.segment, first.at.t.to_f64()), (path.first, 0.0));
                prop_assert_eq!((last.at.segment, last.at.t.to_f64()), (path.first + path.count - 1, 1.0));
                prop_assert_eq!(last.bound, Bound::End);
            }
            // In path order, once around from the first; no place twice.
            let place = |at: &CurveParam<S>| f64::from(at.segment - path.first) + at.t.to_f64();
            let begin = place(&first.at);
            let along: Vec<f64> = own
                .iter()
                .map(|s| place(&s.at) - begin + if place(&s.at) < begin { f64::from(path.count) } else { 0.0 })
                .collect();
            prop_assert!(along.windows(2).all(|w| w[0] < w[1]), "path {} out of order: {:?}", index, along);
            let apart = own.windows(2).all(|w| w[0].point != w[1].point || w[0].at.segment != w[1].at.segment);
            prop_assert!(apart, "two samples at one place");
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_small_drawing_f64(strokes in drawings()) {
        holds::<f64>(&strokes, 1e-9, &Resolution::Tolerance(1e-2))?;
    }

    #[test]
    fn any_small_drawing_f32(strokes in drawings()) {
        holds::<f32>(&strokes, 1e-5, &Resolution::Tolerance(1e-2))?;
    }

    /// Any bits at all: an error or a result, never a panic.
    #[test]
    fn any_bits(bits in prop::collection::vec(any::<f64>(), 8), closed in any::<bool>()) {
        let p = |i: usize| pt(bits[2 * i], bits[2 * i + 1]);
        let cubics = [Cubic::new(p(0), p(1), p(2), p(3))];
        if let Ok(curve) = CurveModel::new(&[(closed, &cubics)], &DoorOptions::default()) {
            let medial = MedialModel::new(&curve, &Resolution::Steps(8));
            for m in medial.points() {
                prop_assert!(m.radius >= 0.0, "{m:?}");
            }
        }
    }
}

/// The end of a loop touches the corner where the loop starts. That was taken for the corner itself, no floor held at the end,
/// and samples went down to the last bit, where two of them were one point.
#[test]
fn the_end_of_a_loop_touches_its_corner() {
    let first = Cubic::new(pt(0.0, 1.0), pt(0.0, 0.0), pt(0.0, 0.0), pt(0.0, 0.0));
    let second = Cubic::new(pt(0.0, 0.0), pt(3.0, 2.0), pt(4.0, 1.0), pt(0.0, 0.0));
    let stroke = crate::common::open(vec![first, second]);
    holds::<f32>(&[stroke], 1e-5, &Resolution::Tolerance(1e-2)).expect("a drawing like any other");
}

#[test]
fn nothing_is_an_error() {
    let nothing: [Stroke; 0] = [];
    let paths: Vec<(bool, &[Cubic<f64>])> = nothing.iter().map(|s| (s.closed, s.cubics.as_slice())).collect();
    assert!(CurveModel::new(&paths, &DoorOptions::default()).is_err());
    let point = crate::common::stick([1.0, 1.0], [1.0, 1.0]);
    assert!(CurveModel::new(&[(false, &point.cubics)], &DoorOptions::default()).is_err());
    // Beside a path that is none, others are kept.
    let model = curve_model(&[point, crate::common::stick([0.0, 0.0], [1.0, 0.0])], &DoorOptions::default());
    assert_eq!(model.curve().paths.len(), 1);
}

/// Drawings that once took a million medial points or more: narrow cusps, strokes that coincide for a stretch, lines that
/// run back over themselves, an end that touches its own path, brush strokes. What lies between two strokes needs few points.
#[test]
fn degenerate_drawings_take_few_medial_points() {
    type Path<'a> = (bool, &'a [[[i32; 2]; 4]]);
    let drawings: [&[Path<'_>]; 6] = [
        &[(false, &[[[4, 1], [2, 6], [3, 0], [4, 1]]]), (false, &[[[3, 3], [4, 3], [3, 6], [3, 1]]])],
        &[
            (true, &[[[1, 4], [0, 4], [0, 3], [6, 4]], [[6, 4], [4, 6], [2, 1], [1, 1]]]),
            (false, &[[[1, 3], [3, 5], [1, 0], [5, 0]], [[5, 0], [2, 4], [0, 0], [2, 5]]]),
            (false, &[[[2, 6], [4, 2], [0, 3], [6, 4]]]),
        ],
        &[(false, &[[[4, 0], [5, 1], [3, 1], [2, 2]], [[2, 2], [5, 4], [4, 5], [2, 2]]])],
        &[
            (false, &[[[4, 4], [0, 4], [5, 4], [4, 4]]]),
            (false, &[[[1, 3], [4, 2], [0, 2], [4, 4]], [[4, 4], [4, 5], [0, 4], [2, 1]]]),
        ],
        &[
            (true, &[[[1, 2], [3, 2], [6, 1], [3, 2]]]),
            (false, &[[[4, 0], [0, 4], [0, 5], [3, 2]], [[3, 2], [5, 4], [6, 5], [6, 1]]]),
            (true, &[[[4, 2], [1, 3], [3, 3], [1, 2]]]),
        ],
        &[
            (true, &[[[6, 2], [4, 5], [0, 3], [2, 1]], [[2, 1], [4, 0], [3, 1], [3, 1]]]),
            (true, &[[[1, 0], [4, 3], [4, 3], [5, 3]], [[5, 3], [6, 1], [6, 5], [6, 5]]]),
            (true, &[[[6, 5], [1, 4], [0, 4], [1, 6]]]),
        ],
    ];
    for (i, drawing) in drawings.iter().enumerate() {
        let point = |[x, y]: [i32; 2]| pt(f64::from(x), f64::from(y));
        let strokes: Vec<(bool, Vec<Cubic<f64>>)> =
            drawing.iter().map(|(c, v)| (*c, v.iter().map(|q| Cubic { points: q.map(point) }).collect())).collect();
        takes_few_medial_points(&strokes, &format!("drawing {i}"));
    }
    // A brush stroke of eight lines that cross each other again and again at angles of some thousandths.
    let line = |k: i32| {
        let thousandth = |n: i32| f64::from(n) * 1e-3;
        let [up, down, end] = [7 * k * k % 11, 5 * k * k % 7, 3 * k % 10].map(thousandth);
        let cubic = Cubic::new(pt(0.0, thousandth(k)), pt(3.0, 1.0 + up), pt(7.0, 1.0 - down), pt(10.0, end));
        (false, vec![cubic])
    };
    takes_few_medial_points(&(0..8).map(line).collect::<Vec<_>>(), "a brush");
}

/// At most 10 000 medial points a path, at a tolerance of a hundredth.
fn takes_few_medial_points(strokes: &[(bool, Vec<Cubic<f64>>)], name: &str) {
    let mut room = vec![MedialPoint::<f64>::default(); 10_000];
    let paths: Vec<(bool, &[Cubic<f64>])> = strokes.iter().map(|(c, v)| (*c, v.as_slice())).collect();
    let model = CurveModel::new(&paths, &DoorOptions::default()).expect("a drawing");
    let curve = model.curve();
    let relevance = relevance(&curve);
    for (path, _) in (0_u32..).zip(curve.paths) {
        let mut out = SliceStore::new(&mut room);
        let end = walk(&curve, path, &Resolution::Tolerance(1e-2), model.contacts(), &relevance, 0, &mut out);
        assert!(end.is_ok(), "{name}, path {path}: {end:?}");
    }
}
