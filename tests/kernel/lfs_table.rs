//! Samples from a table of lfs are true ε-samples, however coarse the table and its numbers are: by the judge that shares no
//! code with the kernel.

use crate::common::{Model, Strokes, closed, cubic, ellipse, open, polygon, raw, stick};
use feature_sampling::curve::given::{self, Extent};
use feature_sampling::curve::{Curve, CurveParam, JointKind, Segment};
use feature_sampling::lfs::FeatureSize;
use feature_sampling::lfs::table::{Column, LfsTable};
use feature_sampling::sampling::resumable::{Resumable, Step};
use feature_sampling::sampling::{Sample, SamplingOptions};
use fsample_checker::{Checker, Options};

fn drawings() -> Vec<(&'static str, Strokes)> {
    let wave = cubic([[0.0, 0.0], [20.0, 40.0], [50.0, -30.0], [70.0, 10.0]]);
    let heart = vec![
        cubic([[0.0, 0.0], [20.0, 25.0], [60.0, 5.0], [40.0, -20.0]]),
        cubic([[40.0, -20.0], [30.0, -35.0], [10.0, -40.0], [0.0, -60.0]]),
        cubic([[0.0, -60.0], [-10.0, -40.0], [-30.0, -35.0], [-40.0, -20.0]]),
        cubic([[-40.0, -20.0], [-60.0, 5.0], [-20.0, 25.0], [0.0, 0.0]]),
    ];
    vec![
        ("ellipse", vec![ellipse(0.0, 0.0, 8.0, 3.0)]),
        ("wave beside a stroke", vec![open(vec![wave]), stick([0.0, 20.0], [60.0, 35.0])]),
        ("heart", vec![closed(heart)]),
        ("zigzag", vec![polygon(false, &[[0.0, 0.0], [5.0, 8.0], [6.0, 0.0], [6.5, 9.0]])]),
    ]
}

/// A number that is at most v, with 8 bits.
fn coarse(v: f64) -> f64 {
    f64::from_bits(v.to_bits() >> 45 << 45)
}

/// C as it would be sent: each segment with its corners, and nothing else of the door's.
fn sent(curve: &Curve<'_, f64>) -> Vec<Segment<f64>> {
    (0..)
        .zip(curve.segments)
        .map(|(i, s)| given::segment(i, s.path, s.cubic, [0, 1].map(|side| s.end(side).kind == JointKind::Corner)))
        .collect()
}

fn samples(
    curve: &Curve<'_, f64>,
    features: &impl FeatureSize<f64>,
    options: &SamplingOptions<f64>,
) -> Vec<Sample<f64>> {
    let mut all = Vec::new();
    for (path, _) in (0..).zip(curve.paths) {
        let mut sampler = Resumable::new(curve, features, path, options).unwrap();
        loop {
            match sampler.step(100).unwrap() {
                Step::Pending => {}
                Step::Sample(s) => all.push(s),
                Step::Done => break,
            }
        }
    }
    all
}

#[test]
fn true_samples_from_coarse_tables() {
    for (name, strokes) in drawings() {
        let model = Model::new(&strokes, 1e-3);
        let checker = Checker::new(&raw(&strokes));
        let whole = model.curve.curve();
        let segments = sent(&whole);
        let extent = Extent::of(&segments);
        assert_eq!((extent.diagonal, extent.noise), {
            // The door measures the drawing's control points; here no handle was turned.
            (*whole.diagonal, *whole.noise)
        });
        let curve = Curve {
            segments: &segments,
            sources: &[],
            arcs: &[],
            nodes: &[],
            diagonal: &extent.diagonal,
            noise: &extent.noise,
            ..whole
        };
        let floor = 0.01 * *whole.diagonal;
        let mut counts = Vec::new();
        for steps in [1_u32, 3, 16, 128] {
            let count = steps + 1;
            let columns: Vec<_> = (0..).zip(&segments).map(|(k, _)| Column { first: k * count, count }).collect();
            let value = |index: u32| {
                let (segment, k) = (index / count, index % count);
                let at = CurveParam { segment, t: columns[0].parameter(k) };
                coarse(model.medial.lfs(&curve.point(&at).unwrap()) * (1.0 - 1e-3))
            };
            let values: Vec<f64> = (0..count * u32::try_from(segments.len()).unwrap()).map(value).collect();
            let table = LfsTable::new(&curve, &columns, |k| values[k as usize]);
            for epsilon in [0.3, 0.5, 0.95] {
                let options = SamplingOptions { min_distance: Some(floor), even: false, ..model.options(epsilon) };
                let found = samples(&curve, &table, &options);
                let rules = Options { min_distance: Some(floor), ..Options::default() };
                let report = checker.check(&model.judged(&found), epsilon, rules);
                assert!(
                    report.violations.is_empty(),
                    "{name}, {steps} steps, ε = {epsilon}: {:?}",
                    report.violations.first()
                );
                if epsilon == 0.5 {
                    counts.push(found.len());
                }
            }
        }
        // A finer table makes fewer samples, down to nearly as few as lfs itself.
        let own = samples(
            &whole,
            &model.medial.index(),
            &SamplingOptions { min_distance: Some(floor), even: false, ..model.options(0.5) },
        );
        println!("{name}: {counts:?} samples, {} with lfs itself", own.len());
        assert!(
            counts[3] <= counts[0] && counts[3] * 10 <= own.len() * 11 + 10,
            "{name}: {counts:?} for {}",
            own.len()
        );
    }
}
