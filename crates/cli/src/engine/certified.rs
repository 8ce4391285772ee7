//! Certificates: samples of a drawing judged by the kernel, and the answer in terms of the drawing.

use feature_sampling::certificate::{Claim, Placed, Reason, Verdict};
use feature_sampling::curve::CurveParam;
use feature_sampling::geometry::Point;
use feature_sampling::sampling::{Condition, SamplingError, SamplingOptions};

use super::{Door, Engine};
use crate::errors::{Failure, shown};
use crate::input::GivenSample;

/// Samples that are added where placed samples could not be proved: so many rounds.
const ROUNDS: usize = 4;

/// A place of the drawing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub(crate) path: u32,
    pub(crate) segment: u32,
    pub(crate) t: f64,
    pub(crate) x: f64,
    pub(crate) y: f64,
}

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

/// One side of a singular place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch {
    pub(crate) path: u32,
    pub(crate) segment: u32,
    pub(crate) t: f64,
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) forwards: bool,
    pub(crate) length: f64,
}

/// A piece of the drawing with its reason.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Proof {
    pub(crate) path: u32,
    pub(crate) segment: u32,
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) sample: Option<u32>,
    pub(crate) reason: &'static str,
    pub(crate) proves: bool,
    pub(crate) lfs: Option<f64>,
}

/// The answer.
#[derive(Debug)]
pub(crate) struct Judged {
    pub(crate) samples: Vec<Spot>,
    pub(crate) pieces: Vec<Proof>,
    pub(crate) neighbourhoods: Vec<Stretch>,
    pub(crate) witness: Option<Fault>,
    pub(crate) cells: usize,
    pub(crate) door: Door,
}

impl Judged {
    /// Pieces without proof.
    pub(crate) fn unknown(&self) -> usize {
        self.pieces.iter().filter(|p| !p.proves).count()
    }

    /// All of C is proved.
    pub(crate) fn proved(&self) -> bool {
        self.witness.is_none() && self.unknown() == 0
    }

    /// The verdict in one word.
    pub(crate) fn verdict(&self) -> &'static str {
        match (&self.witness, self.unknown()) {
            (Some(_), _) => "refuted",
            (None, 0) => "proved",
            _ => "unknown",
        }
    }
}

impl Engine<'_> {
    /// Judges samples: those given, or such as are placed here with some slack.
    pub(crate) fn certify(
        &self,
        given: Option<&[GivenSample]>,
        epsilon: f64,
        min_distance: Option<f64>,
        slack: f64,
        cells: u32,
    ) -> Result<Judged, Failure> {
        let claim = Claim { min_distance, ..Claim::new(epsilon) };
        let mut placed = match given {
            Some(given) => self.placed(given)?,
            None => self.place(&claim, slack)?,
        };
        let cells = usize::try_from(cells).unwrap_or(usize::MAX);
        let mut round = 0;
        loop {
            placed.sort_by(|a, b| (a.path, a.at.segment).cmp(&(b.path, b.at.segment)).then(a.at.t.total_cmp(&b.at.t)));
            let judgement = self.curve.certify(&placed, &claim, cells, false);
            round += 1;
            if given.is_some() || judgement.verdict == Verdict::Proved || round > ROUNDS {
                return Ok(self.judged(&placed, &judgement));
            }
            // One more sample in the middle of each run of pieces that were not proved.
            let curve = self.curve.curve();
            let mut last: Option<(u32, f64)> = None;
            for piece in judgement.pieces.iter().filter(|p| !p.reason.proves()) {
                let joins = last.is_some_and(|(segment, end)| segment == piece.segment && end >= piece.span[0]);
                last = Some((piece.segment, piece.span[1]));
                let t = 0.5 * (piece.span[0] + piece.span[1]);
                let at = CurveParam { segment: piece.segment, t };
                if let (false, Some(point), Some(s)) = (joins, curve.point(&at), curve.segment(piece.segment)) {
                    placed.push(Placed { path: s.path, at, point });
                }
            }
        }
    }

    /// Samples placed with slack: below ε, and below the floors.
    fn place(&self, claim: &Claim<f64>, slack: f64) -> Result<Vec<Placed<f64>>, Failure> {
        let aim = 1.0 - slack;
        let options = SamplingOptions {
            condition: Condition::Epsilon(claim.epsilon * aim),
            min_distance: claim.min_distance,
            singular_floor: claim.singular_floor * aim,
            floor: claim.floor * aim,
            tolerance: self.options.tolerance,
            ..SamplingOptions::default()
        };
        let samples = self.curve.sample(&self.medial, &options).map_err(|error| match error {
            SamplingError::Limit(limit) => Failure::limit(format!("a path needs more than {limit} samples")),
            error => Failure::usage(error),
        })?;
        Ok(samples.iter().map(|s| Placed { path: s.path, at: s.at, point: s.point }).collect())
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
                    curve.segment(*k).is_some_and(|c| {
                        c.source.segment > s.segment || (c.source.segment == s.segment && c.source.to >= s.t)
                    })
                };
                let range = p.first..p.first + p.count;
                let segment = range.clone().find(own).unwrap_or(range.end - 1);
                let source = curve.segment(segment).map(|c| c.source).unwrap_or_default();
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

    fn judged(&self, placed: &[Placed<f64>], judgement: &feature_sampling::model::Judgement<f64>) -> Judged {
        let spot = |at: &CurveParam<f64>, p: &Point<f64>| {
            let (path, segment, t) = self.curve.source(at);
            Spot { path, segment, t, x: p.x, y: p.y }
        };
        let pieces = judgement.pieces.iter().map(|p| {
            let [from, to] =
                [&p.span[0], &p.span[1]].map(|t| self.curve.source(&CurveParam { segment: p.segment, t: *t }));
            let (reason, lfs) = match &p.reason {
                Reason::Feature(lfs) => ("feature", Some(*lfs)),
                Reason::Floor => ("floor", None),
                Reason::Neighbourhood(_) => ("neighbourhood", None),
                Reason::Fine => ("unknown: too fine", None),
                Reason::Cells => ("unknown: too many cells", None),
                Reason::Pieces => ("unknown: too many pieces", None),
            };
            let sample = (p.sample != u32::MAX).then_some(p.sample);
            let proves = p.reason.proves();
            Proof { path: from.0, segment: from.1, from: from.2, to: to.2, sample, reason, proves, lfs }
        });
        let witness = match &judgement.verdict {
            Verdict::Refuted(w) => {
                let Spot { path, segment, t, x, y } = spot(&w.at, &w.point);
                Some(Fault { path, segment, t, x, y, distance: w.distance, lfs: w.lfs })
            }
            _ => None,
        };
        let neighbourhoods = judgement.neighbourhoods.iter().map(|n| {
            let Spot { path, segment, t, x, y } = spot(&n.at, &n.point);
            Stretch { path, segment, t, x, y, forwards: n.forwards, length: n.length }
        });
        Judged {
            samples: placed.iter().map(|s| spot(&s.at, &s.point)).collect(),
            pieces: pieces.collect(),
            neighbourhoods: neighbourhoods.collect(),
            witness,
            cells: judgement.cells,
            door: self.door(),
        }
    }
}

/// What snapping may have moved.
fn snapped(engine: &Engine<'_>) -> f64 {
    engine.door().report.snap
}
