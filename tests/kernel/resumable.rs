//! The resumable sampler gives the samples of the one-shot sampler to the bit, whatever the budget.

use feature_sampling::bezier::Cubic;
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::geometry::Point;
use feature_sampling::lfs::FeatureSize;
use feature_sampling::medial::Resolution;
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::resumable::{Resumable, Step};
use feature_sampling::sampling::{Condition, Sample, SamplingError, SamplingOptions};
use proptest::prelude::*;
use std::cell::Cell;

/// Counts the look-ups.
struct Counted<'a, F> {
    inner: &'a F,
    looks: Cell<u32>,
}

impl<S, F: FeatureSize<S>> FeatureSize<S> for Counted<'_, F> {
    fn lfs(&self, at: &feature_sampling::curve::CurveParam<S>, p: &Point<S>) -> S {
        self.looks.set(self.looks.get() + 1);
        self.inner.lfs(at, p)
    }
}

fn cubics(points: &[[f32; 2]]) -> Vec<Cubic<f32>> {
    let p = |i: usize| Point::new(points[i][0], points[i][1]);
    (0..points.len().saturating_sub(1) / 3)
        .map(|k| Cubic::new(p(3 * k), p(3 * k + 1), p(3 * k + 2), p(3 * k + 3)))
        .collect()
}

fn both(paths: &[(bool, &[Cubic<f32>])], options: &SamplingOptions<f32>, budget: u32) {
    let Ok(model) = CurveModel::new(paths, &DoorOptions::default()) else { return };
    let medial = MedialModel::new(&model, &Resolution::Steps(16));
    let (curve, index) = (model.curve(), medial.index());
    let counted = Counted { inner: &index, looks: Cell::new(0) };
    for (path, _) in (0_u32..).zip(curve.paths) {
        let whole = model.sample_path(&medial, path, options).unwrap();
        let mut sampler = Resumable::new(&curve, &counted, path, options).unwrap();
        let mut found: Vec<Sample<f32>> = Vec::new();
        let mut calls = 0_u64;
        loop {
            counted.looks.set(0);
            let step = sampler.step(budget).unwrap();
            // At most one look-up a turn, and one for the sample that is handed out.
            assert!(counted.looks.get() <= budget + 1, "{} look-ups in a call of {budget}", counted.looks.get());
            match step {
                Step::Pending => {}
                Step::Sample(s) => found.push(s),
                Step::Done => break,
            }
            calls += 1;
            assert!(calls < 10_000_000);
        }
        assert_eq!(found.len(), whole.len());
        for (a, b) in found.iter().zip(&whole) {
            let bits =
                |s: &Sample<f32>| (s.at.segment, [s.at.t, s.point.x, s.point.y, s.lfs].map(f32::to_bits), s.bound);
            assert_eq!(bits(a), bits(b));
        }
        assert_eq!(sampler.step(budget).unwrap(), Step::Done);
    }
}

fn options(epsilon: f32, chord: Option<f32>, min: f32) -> SamplingOptions<f32> {
    SamplingOptions {
        condition: Condition::Epsilon(epsilon),
        chord_error: chord,
        min_distance: Some(min),
        even: false,
        ..SamplingOptions::default()
    }
}

#[test]
fn a_circle_and_a_kinked_path() {
    let k = 55.228_48;
    let circle = cubics(&[
        [100.0, 0.0],
        [100.0, k],
        [k, 100.0],
        [0.0, 100.0],
        [-k, 100.0],
        [-100.0, k],
        [-100.0, 0.0],
        [-100.0, -k],
        [-k, -100.0],
        [0.0, -100.0],
        [k, -100.0],
        [100.0, -k],
        [100.0, 0.0],
    ]);
    let kinked =
        cubics(&[[-50.0, 0.0], [-40.0, 30.0], [-10.0, 30.0], [0.0, 0.0], [10.0, 30.0], [40.0, 30.0], [50.0, 0.0]]);
    for epsilon in [0.2, 0.5, 0.95] {
        for budget in [1, 3, 1000] {
            both(&[(true, &circle), (false, &kinked)], &options(epsilon, Some(0.5), 0.05), budget);
        }
    }
    both(&[(true, &circle)], &SamplingOptions { condition: Condition::Unbounded, ..options(0.5, Some(0.01), 1.0) }, 7);
}

#[test]
fn what_has_no_bounded_turns_is_refused() {
    let line = cubics(&[[0.0, 0.0], [1.0, 0.0], [2.0, 1.0], [3.0, 0.0]]);
    let model = CurveModel::new(&[(false, &line)], &DoorOptions::default()).unwrap();
    let medial = MedialModel::new(&model, &Resolution::Steps(8));
    let (curve, index) = (model.curve(), medial.index());
    let good = options(0.5, None, 0.1);
    assert!(Resumable::new(&curve, &index, 0, &good).is_ok());
    for bad in [
        SamplingOptions { even: true, ..good.clone() },
        SamplingOptions { grading: Some(2.0), ..good.clone() },
        SamplingOptions { condition: Condition::Rho(0.5), ..good.clone() },
        SamplingOptions { min_distance: None, ..good.clone() },
    ] {
        assert_eq!(Resumable::new(&curve, &index, 0, &bad).unwrap_err(), SamplingError::NotResumable);
    }
    let mut few = Resumable::new(&curve, &index, 9, &good).unwrap();
    assert_eq!(few.step(1).unwrap(), Step::Done);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn any_path(
        points in prop::collection::vec(prop::array::uniform2(-100.0_f32..100.0), 4..14),
        closed: bool,
        epsilon in 0.1_f32..1.0,
        chord in prop::option::of(0.05_f32..5.0),
        min in 0.3_f32..3.0,
        budget in 1_u32..40,
    ) {
        both(&[(closed, &cubics(&points))], &options(epsilon, chord, min), budget);
    }
}
