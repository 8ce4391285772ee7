//! Are verdicts on ε-samples true? Random small curves, samples that are good as often as not, and a dense look at each.
//!
//! The prover ([`Prover`]) computes in intervals of `f64`. Here its verdict is compared with points of C and of M, without any of
//! the code that proves. In every gap between samples the point of C that fares worst is picked out of a dense row by medial polylines;
//! [`Oracle`] finds a point of M near it, and the distances from samples and from that point of M are computed in an arithmetic of
//! the caller's choice. Points of M are never nearer than lfs, so a proof that fails here is false, by more than rounding
//! of that arithmetic. For a refutation the same is asked at its witness.

use crate::feature_size::{Oracle, Stroke};
use crate::random::Random;
use feature_sampling::bezier::Cubic;
use feature_sampling::certificate::{Claim, Placed, Verdict, Witness};
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::curve::{Curve, CurveParam};
use feature_sampling::geometry::Point;
use feature_sampling::model::{CurveModel, Judgement};
use feature_sampling::prover::Prover;
use feature_sampling::sampling::{Condition, SamplingOptions};
use feature_sampling::scalar::Scalar;

/// Points of a segment in a dense row.
const ROW: i32 = 300;

/// Tolerance of the medial polylines that samples are placed by, and the worst points found.
const TOLERANCE: f64 = 1e-3;

/// What the door rounds in one arithmetic and not in another is below this share of distances.
const MARGIN: f64 = 1e-8;

/// Floors of the claim, as shares of the diagonal: beside singular points, and elsewhere.
const FLOORS: [f64; 2] = [1e-3, 1e-7];

/// Cells of the foot set, at most.
const CELLS: usize = 100_000;

/// A drawing of one to three small paths, with samples.
#[derive(Debug)]
pub struct Case {
    strokes: Vec<Stroke>,
    oracle: Oracle<f64>,
    epsilon: f64,
    samples: Vec<Placed<f64>>,
}

/// How many verdicts came, by kind, and how many points were looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Random drawings that the door or the sampler did not take.
    pub rejected: u32,
    /// Samples that were proved.
    pub proved: u32,
    /// Samples that were refuted.
    pub refuted: u32,
    /// Samples about which nothing was found out.
    pub unknown: u32,
    /// Points at which a proof or a witness was compared.
    pub points: u32,
}

impl core::ops::AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        self.rejected += other.rejected;
        self.proved += other.proved;
        self.refuted += other.refuted;
        self.unknown += other.unknown;
        self.points += other.points;
    }
}

/// In a square of side 10.
fn point(random: &mut Random) -> Point<f64> {
    Point::new(random.between(0.0, 10.0), random.between(0.0, 10.0))
}

/// One or two cubics in a row, with a smooth joint or a corner; now and then closed.
fn path(random: &mut Random) -> Stroke {
    let first = Cubic::new(point(random), point(random), point(random), point(random));
    let [start, out, handle, end] = first.points;
    let kind = random.integer(0, 3);
    if kind == 0 {
        return (false, vec![first]);
    }
    let ahead = |by: f64, from: &Point<f64>, at: &Point<f64>| {
        Point::new(at.x + by * (at.x - from.x), at.y + by * (at.y - from.y))
    };
    let leaving = if random.integer(0, 3) == 0 { point(random) } else { ahead(0.3 + random.unit(), &handle, &end) };
    let second = match kind {
        1 => Cubic::new(end, leaving, ahead(0.3 + random.unit(), &out, &start), start),
        _ => Cubic::new(end, leaving, point(random), point(random)),
    };
    (kind == 1, vec![first, second])
}

impl Case {
    /// A random one; `None` where the door or the sampler does not take it.
    pub fn random(random: &mut Random) -> Option<Self> {
        let strokes: Vec<Stroke> = (0..=random.integer(0, 2)).map(|_| path(random)).collect();
        let oracle = Oracle::<f64>::new(&strokes, 1.0, TOLERANCE).ok()?;
        let epsilon = match random.integer(0, 3) {
            0 => 0.3,
            1 => 0.5,
            2 => 0.66,
            _ => 0.9,
        };
        let aim = epsilon * random.between(0.85, 1.05);
        let options = SamplingOptions {
            condition: Condition::Epsilon(aim),
            tolerance: TOLERANCE,
            // A little less than the floors of the claim.
            singular_floor: 0.98 * FLOORS[0],
            floor: 0.98 * FLOORS[1],
            ..SamplingOptions::default()
        };
        let samples = oracle.curve().sample(oracle.medial(), &options).ok()?;
        let mut samples: Vec<_> = samples.iter().map(|s| Placed { path: s.path, at: s.at, point: s.point }).collect();
        samples.sort_by(|a, b| (a.path, a.at.segment).cmp(&(b.path, b.at.segment)).then(a.at.t.total_cmp(&b.at.t)));
        if random.integer(0, 3) == 0 {
            let lost = random.integer(0, i32::try_from(samples.len()).ok()? - 1);
            samples.remove(usize::try_from(lost).ok()?);
        }
        Some(Self { strokes, oracle, epsilon, samples })
    }

    /// What the prover says of the samples.
    pub fn judge(&self) -> Judgement<f64> {
        let claim = Claim { finest: 1.0 / 64.0, gap_cells: 4_000, ..Claim::new(self.epsilon) };
        Prover::new(self.oracle.curve(), CELLS).judge(&self.samples, &claim, true)
    }

    /// Compares a judgement with a dense look in the arithmetic W: how many points were looked at.
    ///
    /// # Errors
    /// What is wrong, in words, with the drawing.
    pub fn check<W: Scalar>(&self, judgement: &Judgement<f64>) -> Result<u32, String> {
        let say = |cause: String| format!("{cause}; ε = {} of {:?}", self.epsilon, self.strokes);
        let wide = self.wide::<W>().map_err(say)?;
        let look = Look { case: self, judgement, curve: wide.curve() };
        match &judgement.verdict {
            Verdict::Unknown => Ok(0),
            Verdict::Refuted(witness) => look.refuted(witness).map_err(say),
            Verdict::Proved => look.proved().map_err(say),
        }
    }

    /// The curve in another arithmetic.
    fn wide<W: Scalar>(&self) -> Result<CurveModel<W>, String> {
        let paths: Vec<(bool, Vec<Cubic<W>>)> = self
            .strokes
            .iter()
            .map(|(closed, cubics)| {
                let widened = cubics.iter().map(|c| Cubic { points: c.points.map(|p| Point::from_f64(p.x, p.y)) });
                (*closed, widened.collect())
            })
            .collect();
        let borrowed: Vec<(bool, &[Cubic<W>])> = paths.iter().map(|(closed, cubics)| (*closed, &cubics[..])).collect();
        let corner_sine = W::from_f64(feature_sampling::curve::door::sine_of_degrees(&1.0));
        let model = CurveModel::new(&borrowed, &DoorOptions { corner_sine, ..DoorOptions::default() })
            .map_err(|error| error.to_string())?;
        let (segments, plain) = (model.curve().segments.len(), self.oracle.curve().curve().segments.len());
        if segments == plain { Ok(model) } else { Err(format!("{segments} segments for {plain}")) }
    }
}

/// A judgement under inspection.
struct Look<'c, W> {
    case: &'c Case,
    judgement: &'c Judgement<f64>,
    curve: Curve<'c, W>,
}

/// A point of C: how far samples are, and M.
struct Seen {
    distance: f64,
    lfs: f64,
}

impl<W: Scalar> Look<'_, W> {
    /// Distances at a point of C; `None` where there is no point of M.
    fn see(&self, at: &CurveParam<f64>) -> Option<Seen> {
        let plain = self.case.oracle.curve().curve().point(at)?;
        let origin = self.case.oracle.lfs(&plain).origin?.widened::<W>()?;
        let p = self.curve.point(&CurveParam { segment: at.segment, t: W::from_f64(at.t) })?;
        let medial = origin.medial_point(&self.curve)?;
        let samples = self.case.samples.iter().map(|s| Point::<W>::from_f64(s.point.x, s.point.y));
        let distance = samples.map(|s| s.distance(&p)).fold(W::infinity(), W::min);
        Some(Seen { distance: distance.to_f64(), lfs: medial.distance(&p).to_f64() })
    }

    /// The floor that serves at a place, in units of the drawing.
    fn floor(&self, at: &CurveParam<f64>) -> f64 {
        let holds = |[from, to]: &[f64; 2]| *from <= at.t && at.t <= *to;
        let beside = self.judgement.steps.iter().any(|step| step.segment == at.segment && holds(&step.span));
        FLOORS[usize::from(!beside)] * self.case.oracle.curve().diagonal()
    }

    fn refuted(&self, witness: &Witness<f64>) -> Result<u32, String> {
        let Some(Seen { distance, lfs }) = self.see(&witness.at) else {
            return Err(format!("{witness:?}: no medial axis"));
        };
        if distance < witness.distance * (1.0 - MARGIN) {
            return Err(format!("{witness:?}: a sample at {distance}"));
        }
        if distance < self.case.epsilon * lfs * (1.0 - MARGIN) {
            return Err(format!("{witness:?}: {distance}, lfs {lfs}"));
        }
        let floor = FLOORS[0] * self.case.oracle.curve().diagonal();
        if distance < floor * (1.0 - MARGIN) { Err(format!("{witness:?}: a floor serves")) } else { Ok(1) }
    }

    fn proved(&self) -> Result<u32, String> {
        let (case, epsilon) = (self.case, self.case.epsilon);
        let (curve, medial) = (case.oracle.curve().curve(), case.oracle.medial());
        let mut points = 0;
        for (segment, number) in curve.segments.iter().zip(0..) {
            let mut stops = case.samples.iter().filter(|s| s.at.segment == number).map(|s| s.at.t).peekable();
            let mut worst: Option<(f64, CurveParam<f64>)> = None;
            for i in 0..=ROW {
                let at = CurveParam { segment: number, t: f64::from(i) / f64::from(ROW) };
                let p = segment.point(&at.t);
                let (floor, feature) = (self.floor(&at), epsilon * medial.lfs(&p));
                let singular = FLOORS[0] * case.oracle.curve().diagonal();
                if floor >= singular && feature > singular * (1.0 + 4.0 * TOLERANCE) {
                    return Err(format!("{p:?}: a floor of singular places where ε·lfs is {feature}"));
                }
                let nearest = case.samples.iter().map(|s| s.point.distance(&p)).fold(f64::INFINITY, f64::min);
                let share = nearest / feature.max(floor);
                if worst.as_ref().is_none_or(|(most, _)| share > *most) {
                    worst = Some((share, at));
                }
                // The gap ends before the next place of the row, and so does the segment.
                let mut ends = i == ROW;
                while stops.next_if(|t| *t <= f64::from(i + 1) / f64::from(ROW)).is_some() {
                    ends = true;
                }
                if let Some((_, at)) = worst.take_if(|_| ends)
                    && let Some(Seen { distance, lfs }) = self.see(&at)
                {
                    points += 1;
                    let allowed = (epsilon * lfs).max(self.floor(&at));
                    if distance >= allowed * (1.0 + MARGIN) {
                        return Err(format!(
                            "proved, but at {at:?} a sample is {distance} away of {allowed}, lfs {lfs}"
                        ));
                    }
                }
            }
        }
        Ok(points)
    }
}

/// Judges samples of random curves, each from a seed of its own, and compares in the arithmetic W.
///
/// # Errors
/// The first false verdict, in words, with its seed.
pub fn survey<W: Scalar>(seeds: core::ops::Range<u64>) -> Result<Counts, String> {
    let mut counts = Counts::default();
    for seed in seeds {
        let Some(case) = Case::random(&mut Random::new(seed)) else {
            counts.rejected += 1;
            continue;
        };
        let judgement = case.judge();
        counts.points += case.check::<W>(&judgement).map_err(|cause| format!("seed {seed}: {cause}"))?;
        match judgement.verdict {
            Verdict::Proved => counts.proved += 1,
            Verdict::Refuted(_) => counts.refuted += 1,
            Verdict::Unknown => counts.unknown += 1,
        }
    }
    Ok(counts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_verdict_is_false() {
        let counts = survey::<f64>(0..25).expect("true verdicts");
        assert!(counts.proved > 3 && counts.refuted > 3, "both happen: {counts:?}");
        assert!(counts.points > 20 * counts.proved, "a dense look: {counts:?}");
    }

    /// The verdict on other samples than those it is compared with.
    #[test]
    fn false_verdicts_are_seen() {
        let mut seen = [0, 0];
        for seed in 0..40 {
            let Some(mut case) = Case::random(&mut Random::new(seed)) else { continue };
            let judgement = case.judge();
            match judgement.verdict {
                Verdict::Proved => {
                    // Every other sample is gone, so that some gap is twice what it was.
                    let mut keep = false;
                    case.samples.retain(|_| {
                        keep = !keep;
                        keep
                    });
                    assert!(case.check::<f64>(&judgement).is_err(), "seed {seed}: thinned");
                    seen[0] += 1;
                }
                Verdict::Refuted(ref witness) => {
                    let Placed { path, at, .. } = case.samples[0];
                    case.samples.push(Placed { path, at, point: witness.point });
                    assert!(case.check::<f64>(&judgement).is_err(), "seed {seed}: a sample at the witness");
                    seen[1] += 1;
                }
                Verdict::Unknown => {}
            }
        }
        assert!(seen[0] > 3 && seen[1] > 3, "both happen: {seen:?}");
    }
}
