//! Random small curves, samples that are good as often as not: no verdict is false.
//!
//! What a verdict says is compared with a dense look at the curve: distances from all samples, lfs from medial polylines that were found
//! in plain numbers, without any of the code that proves. Those are good to 1e-3.

use crate::common::Random;
use feature_sampling::bezier::Cubic;
use feature_sampling::certificate::{Claim, Placed, Verdict};
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::geometry::Point;
use feature_sampling::medial::Resolution;
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::prover::Prover;
use feature_sampling::sampling::{Condition, SamplingOptions};

impl Random {
    /// One or two cubics in a row, with a smooth joint or a corner; now and then closed.
    fn path(&mut self) -> (bool, Vec<Cubic<f64>>) {
        let first = Cubic::new(self.point(10.0), self.point(10.0), self.point(10.0), self.point(10.0));
        let [start, out, handle, end] = first.points;
        let kind = self.below(4);
        if kind == 0 {
            return (false, vec![first]);
        }
        let ahead = |by: f64, from: &Point<f64>, at: &Point<f64>| {
            Point::new(at.x + by * (at.x - from.x), at.y + by * (at.y - from.y))
        };
        let leaving = if self.below(4) == 0 { self.point(10.0) } else { ahead(0.3 + self.unit(), &handle, &end) };
        let second = match kind {
            1 => Cubic::new(end, leaving, ahead(0.3 + self.unit(), &out, &start), start),
            _ => Cubic::new(end, leaving, self.point(10.0), self.point(10.0)),
        };
        (kind == 1, vec![first, second])
    }
}

/// Verdicts that came, by kind.
#[derive(Debug, Default)]
struct Counts {
    proved: u32,
    refuted: u32,
    unknown: u32,
}

/// Judges the samples of one random curve, and compares.
fn round(random: &mut Random, counts: &mut Counts) {
    let paths: Vec<_> = (0..=random.below(2)).map(|_| random.path()).collect();
    let input: Vec<(bool, &[Cubic<f64>])> = paths.iter().map(|(closed, c)| (*closed, c.as_slice())).collect();
    let Ok(model) = CurveModel::new(&input, &DoorOptions::default()) else { return };
    let medial = MedialModel::new(&model, &Resolution::Tolerance(1e-3));
    let epsilon = [0.3, 0.5, 0.66, 0.9][random.below(4) as usize];
    let aim = epsilon * (0.85 + 0.2 * random.unit());
    let options = SamplingOptions {
        condition: Condition::Epsilon(aim),
        tolerance: 1e-3,
        singular_floor: 0.98e-3,
        floor: 0.98e-7,
        ..SamplingOptions::default()
    };
    let Ok(samples) = model.sample(&medial, &options) else { return };
    let mut placed: Vec<Placed<f64>> =
        samples.iter().map(|s| Placed { path: s.path, at: s.at, point: s.point }).collect();
    placed.sort_by(|a, b| (a.path, a.at.segment).cmp(&(b.path, b.at.segment)).then(a.at.t.total_cmp(&b.at.t)));
    if random.below(4) == 0 {
        placed.remove(random.below(u32::try_from(placed.len()).expect("few")) as usize);
    }
    let claim = Claim { finest: 1.0 / 64.0, gap_cells: 4_000, ..Claim::new(epsilon) };
    let verdict = Prover::new(&model, 100_000).judge(&placed, &claim, true).verdict;
    let diagonal = *model.diagonal();
    let nearest = |p: &Point<f64>| placed.iter().map(|s| s.point.distance(p)).fold(f64::INFINITY, f64::min);
    match verdict {
        Verdict::Unknown => counts.unknown += 1,
        Verdict::Refuted(w) => {
            counts.refuted += 1;
            let (distance, lfs) = (nearest(&w.point), medial.lfs(&w.point));
            assert!(distance >= (1.0 - 1e-12) * w.distance, "{w:?}: a sample at {distance}");
            assert!(distance >= epsilon * lfs * (1.0 - 2e-3) - 1e-9 * diagonal, "{w:?}: {distance}, lfs {lfs}");
            assert!(distance >= 1e-3 * diagonal * (1.0 - 1e-12), "{w:?}: a floor serves");
        }
        Verdict::Proved => {
            counts.proved += 1;
            for segment in model.curve().segments {
                for i in 0..=300 {
                    let p = segment.point(&(f64::from(i) / 300.0));
                    let (distance, lfs) = (nearest(&p), medial.lfs(&p));
                    let feature = epsilon * lfs;
                    // On the verge of a stretch that a floor serves either holds.
                    let floor = if feature < 1.002e-3 * diagonal { 1e-3 } else { 1e-7 };
                    let allowed = (feature * (1.0 + 2e-3)).max(floor * diagonal);
                    assert!(distance < allowed, "{p:?}: {distance} of {allowed}, lfs {lfs}, {paths:?} at {epsilon}");
                }
            }
        }
    }
}

fn survey(rounds: u32, seed: u64) {
    let mut random = Random(seed);
    let mut counts = Counts::default();
    for _ in 0..rounds {
        round(&mut random, &mut counts);
    }
    println!("{counts:?}");
    let enough = rounds / 8;
    assert!(counts.proved > enough && counts.refuted > enough, "both happen: {counts:?}");
}

#[test]
fn no_verdict_is_false() {
    survey(25, 1);
}

/// `cargo test --release --test kernel no_false_proof:: -- --ignored --nocapture`.
#[test]
#[ignore = "long: 10,000 curves"]
fn no_verdict_is_false_of_ten_thousand() {
    survey(10_000, 2);
}
