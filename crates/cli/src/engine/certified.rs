//! Certificates: samples of a drawing judged by the kernel, and the answer in terms of the drawing.

use feature_sampling::certificate::effective::EffectiveEpsilon;
use feature_sampling::certificate::{Claim, Piece, Placed, Verdict};
use feature_sampling::curve::CurveParam;
use feature_sampling::geometry::Point;
use feature_sampling::model::{CurveModel, Judgement};
use feature_sampling::prover::Prover;
use feature_sampling::sampling::{Bound, Sample};
use fsample_recheck::{Certificate, Proved, Why};
use lineart::drawing::Drawing;
use lineart::export::{PathRows, SampleRow};

use super::{Bounds, Density, Door, Engine, curve_model};
use crate::errors::{Failure, shown};
use crate::input::GivenSample;

/// Samples that are added where placed samples could not be proved: so many rounds. Each halves the gaps; towards an end beside
/// another stroke lfs falls from the singular floor to the other one, by fourteen halvings.
const ROUNDS: usize = 24;

/// No more are added once there are a tenth and these more than at first: what no sample helps would be halved for ever.
const FEW: usize = 100;

/// The effective ε is bounded to this share, if it can be.
const EFFECTIVE: f64 = 1e-2;

/// A point where the condition fails.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fault {
    pub(crate) path: u32,
    pub(crate) segment: u32,
    pub(crate) t: f64,
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) distance: f64,
    pub(crate) lfs: f64,
}

/// The answer.
#[derive(Debug)]
pub(crate) struct Judged {
    pub(crate) certificate: Certificate,
    pub(crate) witness: Option<Fault>,
    /// Path, cubic and parameters of the drawing that each segment of the certificate stands for.
    pub(crate) segments: Vec<(u32, u32, f64, f64)>,
    /// Cells that were made to find the answer.
    pub(crate) cells: usize,
    pub(crate) door: Door,
}

impl Judged {
    /// Pieces without proof.
    pub(crate) fn unknown(&self) -> usize {
        self.certificate.pieces.iter().filter(|p| p.why == Why::Unknown).count()
    }

    /// All of C is proved.
    pub(crate) fn proved(&self) -> bool {
        self.witness.is_none() && self.unknown() == 0
    }
}

/// Re-checks a certificate of a drawing. Answers what it shows, or why it is rejected.
pub(crate) fn recheck(
    drawing: &Drawing,
    certificate: &Certificate,
    samples: Option<&[GivenSample]>,
) -> Result<Result<Rechecked, String>, Failure> {
    let curve = curve_model(drawing, certificate.corner_angle)?;
    if let Some(given) = samples {
        let sorted = |mut points: Vec<(f64, f64)>| {
            points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
            points
        };
        let claimed = sorted(certificate.samples.iter().map(|s| (s.x, s.y)).collect());
        if claimed != sorted(given.iter().map(|s| (s.x, s.y)).collect()) {
            return Ok(Err("it is about other samples".to_owned()));
        }
    }
    Ok(match fsample_recheck::check(curve.curve(), certificate) {
        Ok(Proved::Sample { claims }) => Ok(Rechecked { fault: None, claims }),
        Ok(Proved::Fault(w)) => {
            let at = CurveParam { segment: w.at.segment, t: w.at.t };
            Ok(Rechecked { fault: Some(fault(&curve, &at, w.distance, w.lfs)), claims: 1 })
        }
        Err(rejection) => Err(rejection.to_string()),
    })
}

/// A certificate that holds.
#[derive(Debug)]
pub(crate) struct Rechecked {
    /// Where the condition fails, if that is what it shows.
    pub(crate) fault: Option<Fault>,
    /// Claims about radii that were evaluated.
    pub(crate) claims: usize,
}

fn fault(model: &CurveModel<f64>, at: &CurveParam<f64>, distance: f64, lfs: f64) -> Fault {
    let (path, segment, t) = model.source(at);
    let point = model.curve().point(at).unwrap_or_default();
    Fault { path, segment, t, x: point.x, y: point.y, distance, lfs }
}

/// How much may be spent on a proof.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Effort {
    /// Samples are placed for this share less of ε and of the floors.
    pub(crate) slack: f64,
    /// Most cells of the foot set.
    pub(crate) cells: u32,
}

/// Samples placed to be proved, path by path and in order, and what the prover says of them.
struct Repaired {
    samples: Vec<Vec<Sample<f64>>>,
    placed: Vec<Placed<f64>>,
    claim: Claim<f64>,
    judgement: Judgement<f64>,
}

fn placed_of(samples: &[Vec<Sample<f64>>]) -> Vec<Placed<f64>> {
    samples.iter().flatten().map(|s| Placed { path: s.path, at: s.at, point: s.point }).collect()
}

fn in_order(placed: &mut [Placed<f64>]) {
    placed.sort_by(|a, b| (a.path, a.at.segment).cmp(&(b.path, b.at.segment)).then(a.at.t.total_cmp(&b.at.t)));
}

/// Gives the samples of pieces their numbers in a list that holds more of them; both lists are in order.
fn renumber(pieces: &mut [Piece<f64>], before: &[Placed<f64>], after: &[Placed<f64>]) {
    let mut number = 0;
    let numbers: Vec<u32> = before
        .iter()
        .map(|old| {
            let behind = after.iter().skip(number).position(|new| new == old).unwrap_or(after.len());
            number += behind;
            u32::try_from(number).unwrap_or(u32::MAX)
        })
        .collect();
    for piece in pieces {
        piece.sample = numbers.get(piece.sample as usize).copied().unwrap_or(u32::MAX);
    }
}

impl Engine<'_> {
    /// Judges samples that are given.
    pub(crate) fn certify(
        &self,
        given: &[GivenSample],
        epsilon: f64,
        min_distance: Option<f64>,
        effort: Effort,
    ) -> Result<Judged, Failure> {
        let claim = Claim { min_distance, ..Claim::new(epsilon) };
        let mut placed = self.placed(given)?;
        in_order(&mut placed);
        let cells = usize::try_from(effort.cells).unwrap_or(usize::MAX);
        Ok(self.judged(&placed, &claim, &self.curve.certify(&placed, &claim, cells, false)))
    }

    /// Bounds of the effective ε of samples that are given.
    pub(crate) fn effective(
        &self,
        given: &[GivenSample],
        epsilon: f64,
        min_distance: Option<f64>,
        effort: Effort,
    ) -> Result<EffectiveEpsilon<f64>, Failure> {
        let mut placed = self.placed(given)?;
        in_order(&mut placed);
        Ok(self.effective_of(&placed, epsilon, min_distance, effort))
    }

    /// Bounds of the effective ε of samples that are placed to be proved for an ε.
    pub(crate) fn effective_of_placed(
        &self,
        epsilon: f64,
        min_distance: Option<f64>,
        effort: Effort,
    ) -> Result<EffectiveEpsilon<f64>, Failure> {
        let Repaired { placed, .. } = self.repaired(&Bounds::least(epsilon, min_distance), epsilon, effort)?;
        Ok(self.effective_of(&placed, epsilon, min_distance, effort))
    }

    fn effective_of(
        &self,
        placed: &[Placed<f64>],
        epsilon: f64,
        min_distance: Option<f64>,
        effort: Effort,
    ) -> EffectiveEpsilon<f64> {
        let claim = Claim { min_distance, ..Claim::new(epsilon) };
        let cells = usize::try_from(effort.cells).unwrap_or(usize::MAX);
        Prover::new(&self.curve, cells).effective(placed, &claim, &EFFECTIVE)
    }

    /// Samples that are placed with some slack and judged, with one more wherever they could not be proved.
    pub(crate) fn sample_certified(
        &self,
        bounds: &Bounds,
        epsilon: f64,
        effort: Effort,
    ) -> Result<(Vec<PathRows<SampleRow>>, Judged), Failure> {
        let Repaired { samples, placed, claim, judgement } = self.repaired(bounds, epsilon, effort)?;
        let bounds = Bounds { density: Density::Epsilon(epsilon), ..*bounds };
        let judged = self.judged(&placed, &claim, &judgement);
        Ok((self.sample_rows(samples, &bounds), judged))
    }

    /// The same, as the kernel has them.
    fn repaired(&self, bounds: &Bounds, epsilon: f64, effort: Effort) -> Result<Repaired, Failure> {
        let mut claim = Claim { min_distance: bounds.min_distance, give_up: true, ..Claim::new(epsilon) };
        let bounds = Bounds { density: Density::Epsilon(epsilon), ..*bounds };
        let mut samples = self.sampled(&bounds, 1.0 - effort.slack)?;
        let cells = usize::try_from(effort.cells).unwrap_or(usize::MAX);
        let mut prover = Prover::new(&self.curve, cells);
        let (mut round, mut first) = (0, None);
        let (mut before, mut known) = (Vec::new(), Vec::new());
        loop {
            let mut placed = placed_of(&samples);
            in_order(&mut placed);
            renumber(&mut known, &before, &placed);
            let count = *first.get_or_insert(placed.len());
            let is_last =
                round == ROUNDS || placed.len() > count + count / 10 + FEW || prover.cells().len() + 2 > cells;
            // The last judgement is for the user, who wants to know all of what is left.
            claim.give_up = !is_last;
            let mut judgement = prover.judge_again(&placed, &claim, false, &known);
            round += 1;
            if judgement.verdict == Verdict::Proved || is_last {
                judgement.cells = prover.into_cells();
                return Ok(Repaired { samples, placed, claim, judgement });
            }
            self.add_samples(&mut samples, &judgement);
            (before, known) = (placed, judgement.pieces);
        }
    }

    /// One more sample in the middle of each run of pieces that were not proved.
    fn add_samples(&self, samples: &mut [Vec<Sample<f64>>], judgement: &Judgement<f64>) {
        let curve = self.curve.curve();
        let is_sample = |segment: u32, t: f64| {
            let own = curve.segment(segment).and_then(|s| samples.get(s.path as usize));
            own.is_some_and(|own| own.iter().any(|s| s.at == CurveParam { segment, t }))
        };
        let mut runs: Vec<(u32, [f64; 2])> = Vec::new();
        for piece in judgement.pieces.iter().filter(|p| !p.reason.proves()) {
            let [from, to] = piece.span;
            match runs.last_mut() {
                Some((segment, run))
                    if *segment == piece.segment && run[1] >= from && !is_sample(piece.segment, from) =>
                {
                    run[1] = to;
                }
                _ => runs.push((piece.segment, piece.span)),
            }
        }
        for (segment, [from, to]) in runs {
            let at = CurveParam { segment, t: 0.5 * (from + to) };
            let (Some(point), Some(s)) = (curve.point(&at), curve.segment(segment)) else { continue };
            let Some(own) = samples.get_mut(s.path as usize) else { continue };
            let new = Sample { path: s.path, at, point, lfs: self.medial.lfs(&point), bound: Bound::Epsilon };
            // Behind the last one before it along the path; before all others, behind the last of all: where a closed path
            // that starts elsewhere comes round.
            let order = |a: &CurveParam<f64>, b: &CurveParam<f64>| a.segment.cmp(&b.segment).then(a.t.total_cmp(&b.t));
            let position = |before: &dyn Fn(&Sample<f64>) -> bool| {
                let found = own.iter().enumerate().filter(|(_, s)| before(s));
                found.max_by(|a, b| order(&a.1.at, &b.1.at)).map(|(i, _)| i + 1)
            };
            let index = position(&|s| order(&s.at, &at).is_lt()).or_else(|| position(&|_| true)).unwrap_or(0);
            own.insert(index, new);
        }
    }

    /// Places of the drawing as places on C.
    fn placed(&self, given: &[GivenSample]) -> Result<Vec<Placed<f64>>, Failure> {
        let curve = self.curve.curve();
        let name = shown(&self.drawing.source);
        let fail = |s: &GivenSample, what: &str| Failure::no(format!("{name}: the sample of line {} {what}", s.line));
        given
            .iter()
            .map(|s| {
                let path = curve.paths.iter().position(|p| p.source == s.path);
                let path = path.ok_or_else(|| fail(s, "is on a path that the drawing does not have"))?;
                let p = curve.paths[path];
                // A cubic that was dropped as too short is where the next one starts, or the last one ends.
                let own = |k: &u32| {
                    curve.source(*k).is_some_and(|c| c.segment > s.segment || (c.segment == s.segment && c.to >= s.t))
                };
                let range = p.first..p.first + p.count;
                let segment = range.clone().find(own).unwrap_or(range.end - 1);
                let source = curve.source(segment).copied().unwrap_or_default();
                let t = if source.segment == s.segment {
                    source.place(&s.t)
                } else if source.segment > s.segment {
                    0.0
                } else {
                    1.0
                };
                let at = CurveParam { segment, t };
                let point = Point::new(s.x, s.y);
                let there = curve.point(&at).unwrap_or(point);
                if there.distance(&point) > 1e-9 * self.curve.diagonal() + 4.0 * curve.noise + snapped(self) {
                    return Err(fail(s, &format!("is not on the curve, but {:e} away", there.distance(&point))));
                }
                Ok(Placed { path: u32::try_from(path).unwrap_or(u32::MAX), at, point })
            })
            .collect()
    }

    fn judged(&self, placed: &[Placed<f64>], claim: &Claim<f64>, judgement: &Judgement<f64>) -> Judged {
        let certificate =
            fsample_recheck::certificate(&self.curve, placed, claim, self.options.corner_angle, judgement);
        let witness = match &judgement.verdict {
            Verdict::Refuted(w) => Some(fault(&self.curve, &w.at, w.distance, w.lfs)),
            _ => None,
        };
        let source = |segment: u32| {
            let (path, cubic, from) = self.curve.source(&CurveParam { segment, t: 0.0 });
            (path, cubic, from, self.curve.source(&CurveParam { segment, t: 1.0 }).2)
        };
        let segments = (0..).zip(self.curve.curve().segments).map(|(i, _)| source(i)).collect();
        Judged { certificate, witness, segments, cells: judgement.cells.len(), door: self.door() }
    }
}

/// What snapping may have moved.
fn snapped(engine: &Engine<'_>) -> f64 {
    engine.door().report.snap
}
