//! Bounds beside ε, alone and combined, measured on the samples by other means than the sampler's.
//!
//! Chord error is measured on a dense subdivision; d_min holds between any two samples of which one is free (ends and
//! corners are always samples); d_max and chord error hold unless d_min stands against them, that is unless the gap is
//! below 2·d_min, where no sample can be put in between; grading holds between all neighbouring gaps; the ρ-condition is
//! checked against the judge's lfs. Same input, same output.

use crate::common::{
    Model, Stroke, Strokes, closed, cubic, ellipse, everything, open, polygon, raw, rounded, shipped, stadium, stick,
};
use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::{Point, distance_sq_to_segment};
use feature_sampling::sampling::{Bound, Condition, Sample, SamplingError, SamplingOptions};
use feature_sampling::scalar::Scalar;
use fsample_checker::{Checker, Options};

fn shapes() -> Vec<(String, Strokes)> {
    let wave = cubic([[0.0, 0.0], [20.0, 40.0], [50.0, -30.0], [70.0, 10.0]]);
    let blob = vec![
        cubic([[0.0, 0.0], [40.0, 0.0], [80.0, -20.0], [80.0, 20.0]]),
        cubic([[80.0, 20.0], [80.0, 60.0], [40.0, 30.0], [20.0, 40.0]]),
        cubic([[20.0, 40.0], [0.0, 50.0], [-10.0, 80.0], [-30.0, 60.0]]),
        cubic([[-30.0, 60.0], [-50.0, 40.0], [-40.0, 0.0], [0.0, 0.0]]),
    ];
    let mut all = vec![
        ("circle".to_owned(), vec![ellipse(0.0, 0.0, 50.0, 50.0)]),
        ("ellipse".to_owned(), vec![ellipse(0.0, 0.0, 80.0, 10.0)]),
        ("stadium".to_owned(), vec![stadium(40.0, 8.0)]),
        ("wave".to_owned(), vec![open(vec![wave])]),
        ("blob".to_owned(), vec![closed(blob)]),
        ("triangle".to_owned(), vec![polygon(true, &[[0.0, 0.0], [60.0, 5.0], [20.0, 40.0]])]),
        ("crossing".to_owned(), vec![stick([0.0, 0.0], [60.0, 30.0]), open(vec![wave])]),
        ("lone line".to_owned(), vec![stick([0.0, 0.0], [60.0, 30.0])]),
    ];
    // With FSAMPLE_ALL=1 all drawings that ship, otherwise the small ones.
    all.extend(
        shipped().into_iter().filter(|(_, s)| everything() || s.iter().map(|s| s.cubics.len()).sum::<usize>() < 40),
    );
    all
}

/// Neighbours along the paths, the closing pair of closed paths included.
fn gaps<'s, S: Scalar>(model: &Model<S>, samples: &'s [Sample<S>]) -> Vec<(&'s Sample<S>, &'s Sample<S>)> {
    let mut out = Vec::new();
    for path in samples.chunk_by(|a, b| a.path == b.path) {
        out.extend(path.windows(2).map(|w| (&w[0], &w[1])));
        if model.curve.curve().paths[path[0].path as usize].closed {
            out.extend(path.last().zip(path.first()));
        }
    }
    out
}

/// Points of C from one sample to the next, both included.
fn between<S: Scalar>(model: &Model<S>, a: &Sample<S>, b: &Sample<S>, n: i32) -> Vec<(u32, S, Point<S>)> {
    let curve = model.curve.curve();
    let path = curve.paths[a.path as usize];
    let mut out = Vec::new();
    let mut segment = a.at.segment;
    let mut from = a.at.t.clone();
    for turn in 0..=path.count {
        let last = segment == b.at.segment && (b.at.t > from || (turn > 0 && b.at.t >= from));
        let to = if last { b.at.t.clone() } else { S::one() };
        for i in 0..=n {
            let t = (to.clone() - &from) * &S::ratio(i, n) + &from;
            let point = curve.segments[segment as usize].point(&t);
            out.push((segment, t, point));
        }
        if last {
            break;
        }
        segment = if segment + 1 < path.first + path.count { segment + 1 } else { path.first };
        from = S::zero();
        // A path's last sample may lie at the start of its first segment.
        if segment == b.at.segment && b.at.t.is_zero() {
            break;
        }
    }
    out
}

fn chord_error(model: &Model<f64>, a: &Sample<f64>, b: &Sample<f64>) -> f64 {
    let off = |p: &Point<f64>| distance_sq_to_segment(p, &a.point, &b.point).sqrt();
    between(model, a, b, 64).iter().map(|(_, _, p)| off(p)).fold(0.0, f64::max)
}

const fn fixed(bound: Bound) -> bool {
    matches!(bound, Bound::Start | Bound::End | Bound::Corner)
}

/// What the samples of these options break, one line each.
fn broken(name: &str, model: &Model<f64>, options: &SamplingOptions<f64>) -> Vec<String> {
    let samples = model.sample(options);
    let mut out = Vec::new();
    let min = options.min_distance.unwrap_or(0.0);
    let slack = 1.0 + 1e-9;
    for (a, b) in gaps(model, &samples) {
        let gap = a.point.distance(&b.point);
        // Between two fixed samples there may be less room than d_min.
        if gap * slack < min && !(fixed(a.bound) && fixed(b.bound)) {
            out.push(format!("{name}: gap {gap} below d_min {min}: {a:?} {b:?}"));
        }
        if gap <= 2.0 * min {
            continue;
        }
        if options.max_distance.is_some_and(|max| gap > max * slack) {
            out.push(format!("{name}: gap {gap} above d_max {:?}: {a:?} {b:?}", options.max_distance));
        }
        if let Some(allowed) = options.chord_error {
            let error = chord_error(model, a, b);
            if error > allowed * slack {
                out.push(format!("{name}: chord error {error} above {allowed}, gap {gap}: {a:?} {b:?}"));
            }
        }
    }
    out.truncate(3);
    out
}

fn none(faults: &[String]) {
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// Around a corner the floor of singular points holds, also where the path does not start at one: a drop that starts
/// opposite to its corner took samples down to the floor of strokes that nearly coincide.
#[test]
fn the_floor_of_a_corner_does_not_depend_on_where_the_path_starts() {
    let there = cubic([[0.0, 0.0], [1.0, 1.0], [2.0, 1.0], [2.0, 0.0]]);
    let back = cubic([[2.0, 0.0], [2.0, -1.0], [1.0, -1.0], [0.0, 0.0]]);
    let samples = |cubics: Vec<Cubic<f64>>| {
        let model = Model::new(&[closed(cubics)], 1e-3);
        model.sample(&model.options(0.5))
    };
    let (corner, opposite) = (samples(vec![there, back]), samples(vec![back, there]));
    assert!(corner.iter().any(|s| s.bound == Bound::Floor), "no floor");
    let points = |samples: &[Sample<f64>]| samples.iter().map(|s| s.point).collect::<Vec<_>>();
    assert_eq!(points(&opposite), points(&corner));
}

#[test]
fn chord_error_and_distances() {
    let mut faults = Vec::new();
    for (name, strokes) in shapes() {
        let model = Model::new(&strokes, 1e-3);
        let d = *model.curve.diagonal();
        for epsilon in [0.5, 1.0] {
            let base = model.options(epsilon);
            for (chord, min, max) in [
                (Some(1e-3), None, None),
                (Some(1e-4), None, None),
                (Some(1e-3), Some(5e-4), None),
                (Some(1e-4), Some(2e-3), None),
                (None, Some(1e-2), None),
                (None, None, Some(2e-2)),
                (Some(3e-4), Some(1e-3), Some(1e-2)),
                (None, Some(4e-3), Some(4e-3)),
            ] {
                let options = SamplingOptions {
                    chord_error: chord.map(|c| c * d),
                    min_distance: min.map(|c| c * d),
                    max_distance: max.map(|c| c * d),
                    ..base.clone()
                };
                faults.extend(broken(&format!("{name} ε {epsilon} {chord:?} {min:?} {max:?}"), &model, &options));
            }
        }
    }
    none(&faults);
}

/// Keeping d_min to an end, a corner or the seam must not leave a point without a sample within max(ε·lfs, d_min).
#[test]
fn the_last_gap_keeps_the_condition() {
    // Corners of little turning: lfs falls to 0 at them from well above d_min.
    let heart = vec![
        cubic([[0.0, 0.0], [20.0, 25.0], [60.0, 5.0], [40.0, -20.0]]),
        cubic([[40.0, -20.0], [30.0, -35.0], [10.0, -40.0], [0.0, -60.0]]),
        cubic([[0.0, -60.0], [-10.0, -40.0], [-30.0, -35.0], [-40.0, -20.0]]),
        cubic([[-40.0, -20.0], [-60.0, 5.0], [-20.0, 25.0], [0.0, 0.0]]),
    ];
    for (name, strokes) in shapes().into_iter().chain([("heart".to_owned(), vec![closed(heart)])]) {
        let model = Model::new(&strokes, 1e-3);
        let checker = Checker::new(&raw(&strokes));
        for share in [0.002, 0.01, 0.03, 0.08, 0.2] {
            let floor = share * *model.curve.diagonal();
            for (epsilon, even) in [(0.5, false), (0.5, true), (0.95, false)] {
                let options = SamplingOptions { min_distance: Some(floor), even, ..model.options(epsilon) };
                let rules = Options { min_distance: Some(floor), ..Options::default() };
                let report = checker.check(&model.judged(&model.sample(&options)), epsilon, rules);
                let first = report.violations.first();
                assert!(
                    first.is_none(),
                    "{name}, ε = {epsilon}, d_min = {share} of the diagonal, even {even}: {first:?}"
                );
            }
        }
    }
}

#[test]
fn chord_error_without_features() {
    let mut faults = Vec::new();
    for (name, strokes) in shapes() {
        let model = Model::new(&strokes, 1e-3);
        let chord = 1e-4 * model.curve.diagonal();
        let options =
            SamplingOptions { condition: Condition::Unbounded, chord_error: Some(chord), ..model.options(0.5) };
        faults.extend(broken(&name, &model, &options));
    }
    none(&faults);
}

/// Largest ratio of neighbouring gaps, path by path.
fn grading(model: &Model<f64>, samples: &[Sample<f64>]) -> f64 {
    let mut worst = 1.0_f64;
    for path in samples.chunk_by(|a, b| a.path == b.path) {
        let n = path.len();
        let closed = model.curve.curve().paths[path[0].path as usize].closed && n > 1;
        let count = if closed { n } else { n - 1 };
        let gap = |i: usize| path[i % n].point.distance(&path[(i + 1) % n].point);
        for i in 0..if closed { count } else { count.saturating_sub(1) } {
            let (a, b) = (gap(i), gap((i + 1) % count.max(1)));
            worst = worst.max(a / b).max(b / a);
        }
    }
    worst
}

#[test]
fn grading_is_kept() {
    let mut faults = Vec::new();
    for (name, strokes) in shapes() {
        let model = Model::new(&strokes, 1e-3);
        for ratio in [1.2, 1.5, 2.0] {
            let options = SamplingOptions { grading: Some(ratio), ..model.options(0.5) };
            let found = grading(&model, &model.sample(&options));
            println!("{name}: grading {found:.4} for {ratio}");
            if found > ratio * (1.0 + 1e-9) {
                faults.push(format!("{name}: grading {found} for {ratio}"));
            }
        }
    }
    none(&faults);
}

/// min(|p − s₀|, |p − s₁|) < ρ·(smallest lfs between s₀ and s₁), lfs by the judge.
#[test]
fn rho_samples() {
    let mut faults = Vec::new();
    for (name, strokes) in shapes().into_iter().take(5) {
        let model = Model::new(&strokes, 1e-3);
        let checker = Checker::new(&raw(&strokes));
        for rho in [0.3, 0.6, 0.9] {
            let options = SamplingOptions { condition: Condition::Rho(rho), ..model.options(0.5) };
            let samples = model.sample(&options);
            let mut worst = 0.0_f64;
            for (a, b) in gaps(&model, &samples) {
                let places = between(&model, a, b, 24);
                let lfs = |(segment, t, _): &(u32, f64, Point<f64>)| {
                    let at = feature_sampling::curve::CurveParam { segment: *segment, t: *t };
                    let (path, cubic, t) = model.curve.source(&at);
                    checker.lfs(path as usize, cubic as usize, t)
                };
                let reach = places.iter().map(lfs).fold(f64::INFINITY, f64::min);
                let far = |p: &Point<f64>| p.distance(&a.point).min(p.distance(&b.point));
                let far = places.iter().map(|(_, _, p)| far(p)).fold(0.0, f64::max);
                worst = worst.max(far / reach);
            }
            println!("{name}: {} samples, effective rho {worst:.4} for {rho}", samples.len());
            if worst >= rho {
                faults.push(format!("{name}: effective rho {worst} for {rho}"));
            }
            // Greedy wastes little: somewhere the bound is nearly reached.
            if worst < 0.7 * rho {
                faults.push(format!("{name}: only {worst} of rho {rho} is used"));
            }
        }
    }
    none(&faults);
}

#[test]
fn the_same_again() {
    fn twice<S: Scalar>(strokes: &[Stroke]) {
        let strokes = rounded::<S>(strokes);
        let [a, b] = [(); 2].map(|()| {
            let model = Model::<S>::new(&strokes, 1e-3);
            let d = model.curve.diagonal().clone();
            let options = SamplingOptions {
                chord_error: Some(d.clone() * &S::ratio(1, 2000)),
                min_distance: Some(d * &S::ratio(1, 1000)),
                // Grading in f64 only.
                grading: (S::BITS > 24).then(|| S::ratio(3, 2)),
                ..model.options(0.5)
            };
            model.sample(&options)
        });
        assert_eq!(a, b);
    }
    for (_, strokes) in shapes() {
        twice::<f64>(&strokes);
        twice::<f32>(&strokes);
    }
}

#[test]
fn errors_have_types() {
    let model = Model::new(&[ellipse(0.0, 0.0, 1.0, 1.0)], 1e-2);
    let with = |change: &dyn Fn(&mut SamplingOptions<f64>)| {
        let mut options = model.options(0.5);
        change(&mut options);
        model.curve.sample(&model.medial, &options).map(|s| s.len())
    };
    for bad in [0.0, -0.5, 1.5, f64::NAN, f64::INFINITY] {
        assert_eq!(with(&|o| o.condition = Condition::Epsilon(bad)), Err(SamplingError::Condition), "{bad}");
        assert_eq!(with(&|o| o.condition = Condition::Rho(bad)), Err(SamplingError::Condition), "{bad}");
    }
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(with(&|o| o.chord_error = Some(bad)), Err(SamplingError::Length), "{bad}");
        assert_eq!(with(&|o| o.min_distance = Some(bad)), Err(SamplingError::Length), "{bad}");
        assert_eq!(with(&|o| o.max_distance = Some(bad)), Err(SamplingError::Length), "{bad}");
    }
    let contradictory = with(&|o| (o.min_distance, o.max_distance) = (Some(0.2), Some(0.1)));
    assert_eq!(contradictory, Err(SamplingError::Contradiction));
    for bad in [1.0, 0.5, -2.0, f64::NAN, f64::INFINITY] {
        assert_eq!(with(&|o| o.grading = Some(bad)), Err(SamplingError::Grading), "{bad}");
    }
    for bad in [-0.1, 1.0, f64::NAN] {
        assert_eq!(with(&|o| o.start = bad), Err(SamplingError::Start), "{bad}");
    }
    assert_eq!(with(&|o| (o.limit, o.max_distance) = (10, Some(0.01))), Err(SamplingError::Limit(10)));
    assert!(with(&|_| ()).is_ok());
}

/// In f32 a position's rounding is no longer small beside a gap, on straight lines above all. Steps must not be cut in half
/// by it, nor stand still: the counts are those of f64, grading comes to an end, and no place is sampled twice.
#[test]
fn single_precision_takes_no_more_samples() {
    let wave = cubic([[0.0, 0.0], [20.0, 40.0], [50.0, -30.0], [70.0, 10.0]]);
    let loops = cubic([[5.0, 3.0], [5.0, 0.0], [1.0, 5.0], [5.0, 3.0]]);
    let twist = vec![
        cubic([[2.0, 1.0], [0.0, 2.0], [2.0, 0.0], [6.0, 3.0]]),
        cubic([[6.0, 3.0], [1.0, 6.0], [6.0, 2.0], [5.0, 0.0]]),
    ];
    let drawings: [Strokes; 4] = [
        vec![open(vec![wave]), stick([0.0, 20.0], [60.0, -5.0])],
        vec![ellipse(0.0, 0.0, 8.0, 3.0), stick([-4.0, 0.0], [-4.0, 1.0]), stick([4.0, 1.0], [5.0, 0.0])],
        vec![closed(vec![loops])],
        vec![closed(vec![loops]), open(twist)],
    ];
    fn count<S: Scalar + Default>(strokes: &[Stroke], epsilon: f64, grading: Option<f64>) -> usize {
        let model = Model::<S>::new(&rounded::<S>(strokes), 1e-2);
        let options = SamplingOptions { grading: grading.map(S::from_f64), ..model.options(epsilon) };
        let samples = model.sample(&options);
        for (a, b) in gaps(&model, &samples) {
            assert!(a.point != b.point || samples.len() == 1, "twice: {a:?} {b:?}");
        }
        samples.len()
    }
    for (i, strokes) in drawings.iter().enumerate() {
        for epsilon in [0.3, 0.5, 1.0] {
            let (single, double) = (count::<f32>(strokes, epsilon, None), count::<f64>(strokes, epsilon, None));
            assert!(single <= double + double / 100 + 1, "drawing {i} at {epsilon}: {single} in f32, {double} in f64");
            count::<f32>(strokes, epsilon, Some(1.5));
        }
    }
}
