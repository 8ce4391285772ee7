//! Certificates: bounds hold, faults are found, nothing false is proved.

use feature_sampling::bezier::Cubic;
use feature_sampling::certificate::{Claim, Placed, Verdict};
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::curve::{CurveParam, EndId};
use feature_sampling::geometry::{Point, Vector};
use feature_sampling::medial::{Foot, Resolution, Side, tangent_disk};
use feature_sampling::model::{CurveModel, Judgement, MedialModel};
use feature_sampling::prover::Prover;
use feature_sampling::sampling::{Condition, SamplingOptions};

const CELLS: usize = 200_000;

fn cubic(p: [(f64, f64); 4]) -> Cubic<f64> {
    let [a, b, c, d] = p.map(|(x, y)| Point::new(x, y));
    Cubic::new(a, b, c, d)
}

/// An ellipse of four cubics, with the usual handles.
fn ellipse(a: f64, b: f64) -> Vec<Cubic<f64>> {
    let k = 0.552_284_749_830_793_4;
    vec![
        cubic([(a, 0.0), (a, k * b), (k * a, b), (0.0, b)]),
        cubic([(0.0, b), (-k * a, b), (-a, k * b), (-a, 0.0)]),
        cubic([(-a, 0.0), (-a, -k * b), (-k * a, -b), (0.0, -b)]),
        cubic([(0.0, -b), (k * a, -b), (a, -k * b), (a, 0.0)]),
    ]
}

fn model(paths: &[(bool, Vec<Cubic<f64>>)]) -> CurveModel<f64> {
    let input: Vec<(bool, &[Cubic<f64>])> = paths.iter().map(|(closed, c)| (*closed, c.as_slice())).collect();
    CurveModel::new(&input, &DoorOptions::default()).expect("a curve")
}

fn sampled(model: &CurveModel<f64>, epsilon: f64) -> Vec<Placed<f64>> {
    let medial = MedialModel::new(model, &Resolution::Tolerance(1e-3));
    let options =
        SamplingOptions { condition: Condition::Epsilon(epsilon), tolerance: 1e-3, ..SamplingOptions::default() };
    let mut placed: Vec<Placed<f64>> = model
        .sample(&medial, &options)
        .expect("samples")
        .iter()
        .map(|s| Placed { path: s.path, at: s.at, point: s.point })
        .collect();
    placed.sort_by(|a, b| (a.path, a.at.segment).cmp(&(b.path, b.at.segment)).then(a.at.t.total_cmp(&b.at.t)));
    placed
}

fn verdict(model: &CurveModel<f64>, samples: &[Placed<f64>], epsilon: f64) -> Verdict<f64> {
    model.certify(samples, &Claim::new(epsilon), CELLS, true).verdict
}

#[test]
fn samples_with_slack_are_proved() {
    for (a, b) in [(1.0, 1.0), (3.0, 1.0), (1.0, 2.0)] {
        let model = model(&[(true, ellipse(a, b))]);
        for epsilon in [0.5, 0.66] {
            let samples = sampled(&model, 0.99 * epsilon);
            assert_eq!(verdict(&model, &samples, epsilon), Verdict::Proved, "ellipse {a} × {b} at {epsilon}");
        }
    }
}

#[test]
fn two_strokes_and_open_ends_are_proved() {
    let strokes = vec![
        (false, vec![cubic([(0.0, 0.0), (1.0, 1.0), (2.0, 1.0), (3.0, 0.0)])]),
        (false, vec![cubic([(0.0, 1.5), (1.0, 2.0), (2.0, 2.0), (3.5, 1.0)])]),
    ];
    let model = model(&strokes);
    let samples = sampled(&model, 0.49);
    assert_eq!(verdict(&model, &samples, 0.5), Verdict::Proved);
}

#[test]
fn faults_are_refuted() {
    let model = model(&[(true, ellipse(3.0, 1.0))]);
    let samples = sampled(&model, 0.495);
    for i in (0..samples.len()).step_by(4) {
        let mut fewer = samples.clone();
        fewer.remove(i);
        let Verdict::Refuted(w) = verdict(&model, &fewer, 0.5) else { panic!("without sample {i}: not refuted") };
        // What the witness says holds: no sample is that near, by far more than the bounds' own rounding.
        let nearest = fewer.iter().map(|s| s.point.distance(&w.point)).fold(f64::INFINITY, f64::min);
        assert!(nearest >= w.distance && w.distance >= 0.5 * w.lfs, "{w:?}");
    }
    // A whole gap in the place of a nudge: each sample moved on to the next one's place.
    let mut moved = samples.clone();
    moved[3].at = samples[4].at;
    moved[3].point = samples[4].point;
    assert!(matches!(verdict(&model, &moved, 0.5), Verdict::Refuted(_)));
    assert!(matches!(verdict(&model, &samples, 0.45), Verdict::Refuted(_)), "what is aimed at 0.495 is none at 0.45");
}

#[test]
fn without_samples_nothing_is_proved() {
    let model = model(&[(true, ellipse(2.0, 1.0))]);
    assert_ne!(verdict(&model, &[], 0.5), Verdict::Proved);
}

#[test]
fn a_budget_of_no_cells_is_unknown() {
    let model = model(&[(true, ellipse(3.0, 1.0))]);
    let samples = sampled(&model, 0.495);
    assert_eq!(model.certify(&samples, &Claim::new(0.5), 10, true).verdict, Verdict::Unknown);
}

/// The effective ε lies between its bounds: what is proved above it is refuted 2 % below it.
#[test]
fn the_effective_epsilon_is_bracketed() {
    let model = model(&[(true, ellipse(3.0, 1.0))]);
    let samples = sampled(&model, 0.3);
    let found = Prover::new(&model, CELLS).effective(&samples, &Claim::new(0.5), &1e-2);
    assert!(found.lower <= found.upper && found.upper <= found.lower * 1.02, "{found:?}");
    // Samples are spread evenly: they may do better than was aimed at, not worse.
    assert!(found.lower <= 0.3, "{found:?}");
    assert_eq!(verdict(&model, &samples, found.upper), Verdict::Proved, "{found:?}");
    assert!(matches!(verdict(&model, &samples, 0.98 * found.lower), Verdict::Refuted(_)), "{found:?}");
}

/// What was proved of a gap stays proved when samples are added elsewhere, and is not looked at again.
#[test]
fn known_gaps_are_taken_over() {
    let model = model(&[(true, ellipse(3.0, 1.0))]);
    let samples = sampled(&model, 0.495);
    let mut fewer = samples.clone();
    fewer.remove(5);
    let claim = Claim::new(0.5);
    let mut prover = Prover::new(&model, CELLS);
    let first = prover.judge(&fewer, &claim, false);
    assert!(matches!(first.verdict, Verdict::Refuted(_)));
    let mut known = first.pieces;
    known.iter_mut().filter(|p| p.sample >= 5).for_each(|p| p.sample += 1);
    let cells = prover.cells().len();
    let again = prover.judge_again(&samples, &claim, false, &known);
    assert_eq!(again.verdict, Verdict::Proved);
    assert!(prover.cells().len() < cells + cells / 4, "{cells} and {}", prover.cells().len());
    let own = |segment: u32| again.pieces.iter().filter(move |p| p.segment == segment);
    for segment in 0..4 {
        let end = own(segment).fold(0.0, |end, p| if p.span[0] == end { p.span[1] } else { f64::NAN });
        assert_eq!(end, 1.0, "pieces cover segment {segment}");
    }
}

/// Two arches that cross twice, the second one drawn three times: as it is, again, and backwards.
fn repeated_arches() -> CurveModel<f64> {
    let first = cubic([(0.0, 0.0), (2.0, 5.0), (6.0, 5.0), (8.0, 0.0)]);
    let left = cubic([(0.0, 3.0), (1.0, 2.0), (2.5, 1.0), (4.0, 1.0)]);
    let right = cubic([(4.0, 1.0), (5.5, 1.0), (7.0, 2.0), (8.0, 3.0)]);
    let second = vec![left, right];
    let backwards = vec![right.reversed(), left.reversed()];
    model(&[(false, vec![first]), (false, second.clone()), (false, second), (false, backwards)])
}

/// Found with a mosquito whose strokes are all drawn twice: walking around the joints of a twin did not end, and crossings had
/// floors on the first of the strokes only.
#[test]
fn strokes_that_are_drawn_again_are_proved_as_well() {
    let model = repeated_arches();
    let samples = sampled(&model, 0.495);
    assert_eq!(verdict(&model, &samples, 0.5), Verdict::Proved);
    // The others' samples serve a stroke that lies on them, but that is not looked for; where all are gone it is a fault.
    let on_one = |s: &Placed<f64>| s.path != 1 || (s.point.x - 2.5).abs() > 0.5;
    let on_all = |s: &Placed<f64>| s.path == 0 || (s.point.x - 2.5).abs() > 0.5;
    let without = |keep: &dyn Fn(&Placed<f64>) -> bool| samples.iter().filter(|s| keep(s)).cloned().collect::<Vec<_>>();
    assert_eq!(verdict(&model, &without(&on_one), 0.5), Verdict::Unknown);
    assert!(matches!(verdict(&model, &without(&on_all), 0.5), Verdict::Refuted(_)));
}

#[test]
fn a_foot_on_a_repeated_stroke_is_that_of_the_first() {
    let model = repeated_arches();
    let curve = model.curve();
    for (again, t, first, same) in [(3, 0.25, 1, 0.25), (4, 1.0, 2, 1.0), (5, 0.25, 2, 0.75), (6, 1.0, 1, 0.0)] {
        assert!(curve.segments[again as usize].twin.is_some(), "segment {again} is a repetition");
        for side in [Side::Left, Side::Right] {
            let place = |segment, t| CurveParam { segment, t };
            let foot = Foot::normal(&curve, place(again, t), side).expect("a place");
            let known =
                [Side::Left, Side::Right].map(|side| Foot::normal(&curve, place(first, same), side).expect("a place"));
            let twin = known.iter().find(|k| k.side == foot.side).expect("one of the two");
            assert_eq!((&foot.at, &foot.point, &foot.direction), (&twin.at, &twin.point, &twin.direction), "{again}");
            assert_eq!(tangent_disk(&curve, &foot), tangent_disk(&curve, twin), "segment {again} at {t}");
            // The normal is that of the repeated stroke, whichever way it runs.
            let own = curve.segments[again as usize].tangent(&t).left();
            let along = own.dot(&foot.direction);
            assert!(
                (along - if side == Side::Left { 1.0 } else { -1.0 }).abs() < 1e-15,
                "segment {again} at {t}: {along}"
            );
        }
    }
    let fan = Foot::fan(&curve, EndId::new(6, 1), Vector::new(-1.0, 0.0)).expect("an end");
    assert_eq!((fan.end, tangent_disk(&curve, &fan).touch), (Some(EndId::new(1, 0)), None), "left of all strokes");
    let ends = |id| curve.joint(id).count();
    assert_eq!(ends(EndId::new(3, 1)), 2, "the joint between both cubics");
    assert_eq!(ends(EndId::new(5, 1)), 2, "the same, seen from a stroke that runs backwards");
    assert_eq!(ends(EndId::new(6, 1)), 1, "an open end");
}

#[test]
fn a_gap_that_is_given_up_is_left_behind_its_first_unknown_piece() {
    let model = model(&[(true, ellipse(3.0, 1.0))]);
    let samples = sampled(&model, 0.4999);
    // Pieces so large that some hold and some do not.
    let thorough = Claim { finest: 0.125, ..Claim::new(0.5) };
    let quick = Claim { give_up: true, ..thorough.clone() };
    let [all, first] = [thorough, quick].map(|claim| model.certify(&samples, &claim, CELLS, false));
    assert_eq!((&all.verdict, &first.verdict), (&Verdict::Unknown, &Verdict::Unknown));
    let left = |judgement: &Judgement<f64>| judgement.pieces.iter().filter(|p| !p.reason.proves()).count();
    let proved = |judgement: &Judgement<f64>| judgement.pieces.len() - left(judgement);
    assert!(
        left(&all) > 0 && proved(&first) > 0 && proved(&first) <= proved(&all),
        "{} of {}",
        proved(&first),
        proved(&all)
    );
    assert!(first.pieces.len() < all.pieces.len(), "it saves work");
    // Up to the first unknown piece of a gap both say the same, and all behind it is unknown.
    let is_start = |segment: u32, t: f64| t == 0.0 || samples.iter().any(|s| s.at == CurveParam { segment, t });
    let mut given_up = false;
    for piece in &first.pieces {
        given_up &= !is_start(piece.segment, piece.span[0]);
        assert!(!given_up || !piece.reason.proves(), "{piece:?} lies behind an unknown piece");
        assert!(!piece.reason.proves() || all.pieces.contains(piece), "{piece:?} was proved before");
        given_up |= !piece.reason.proves();
    }
}
