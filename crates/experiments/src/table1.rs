//! Table 1: error and time against steps a segment.
//!
//! For 10, 100, 1000 and 10 000 steps: the time of the whole job on one core (door, medial polylines, index, lfs at every foot,
//! ε-samples), and the root mean square error of three things against a ground truth, all relative to the longest hull
//! diagonal of the curve's cubics:
//!
//! * the **medial axis**: distance of true medial points from the medial polylines. True points are those of the nearer
//!   side with a radius of at most the diagonal of the drawing: branches that run far out would decide the mean and have no
//!   influence on lfs.
//! * **lfs**, at the same places.
//! * the **distance of consecutive samples** (ε = 1/2), gap by gap from the first sample of each path.
//!
//! *Places* are equidistant in the parameter of every segment, at a number that shares no factor with the steps, so that
//! they fall on feet of none of the rows. (The paper compares at feet that both densities have, where the error is least.)
//!
//! The **ground truth** (`truth`) is computed with the feature `mpfr` in 128 bits
//! ([`feature_sampling_mpfr`](../../feature_sampling_mpfr/index.html)), without in `f64`; the table says which, and by how much
//! two densities of it differ. With the feature our sampler runs in MPFR as well. `agreement` says where `f32` and
//! `f64` disagree with the truth.

use std::hint::black_box;
use std::sync::OnceLock;

use feature_sampling::geometry::Point;
use feature_sampling::medial::Resolution;
use feature_sampling::scalar::Scalar;

use crate::agreement;
use crate::clock::{self, Clock};
use crate::plot::{Axis, Plot, Series};
use crate::prototype::Prototype;
use crate::report::{Cell, Report, Table, three_digits};
use crate::source::Source;
use crate::truth::{CHECKED, CORNER_DEGREES, Job, TRUEST, Truest, Truth, differences, gaps, parameters, rms};
use crate::{Experiment, ExperimentError, Finding, value};

/// What the paper prints for COMPLEX: sampler, steps, seconds, medial axis, lfs, distance.
const PRINTED: [(&str, u32, [f64; 4]); 8] = [
    ("[OMW16]", 10, [0.004, 0.018, 0.0459, 0.706]),
    ("[OMW16]", 100, [0.051, 0.008, 0.0429, 0.491]),
    ("[OMW16]", 1000, [4.786, 0.112, 0.1208, 0.482]),
    ("[OMW16]", 10_000, [477.237, 0.272, 1.998, 0.612]),
    ("paper", 10, [0.016, 1.38e-5, 0.0026, 0.212]),
    ("paper", 100, [0.235, 2.55e-5, 0.0006, 0.121]),
    ("paper", 1000, [3.329, 1.46e-6, 0.0005, 0.097]),
    ("paper", 10_000, [44.405, f64::NAN, f64::NAN, f64::NAN]),
];

/// The samplers that are measured; the last is the prototype.
const SAMPLERS: &[&str] = if cfg!(feature = "mpfr") {
    &["f32", "f64", "MPFR 128 bits", "[OMW16] re-created"]
} else {
    &["f32", "f64", "[OMW16] re-created"]
};

/// Names of what is measured, in the order of the columns.
const MEASURES: [&str; 4] = ["seconds", "medial", "lfs", "distance"];

/// The experiment.
#[derive(Debug)]
pub struct Table1 {
    curves: Vec<Source>,
    steps: Vec<u32>,
    /// Places a segment.
    places: u32,
    /// The two relative tolerances of the ground truth's polylines, the finer first.
    tolerances: [f64; 2],
    truths: Vec<OnceLock<Result<Truth, ExperimentError>>>,
}

impl Table1 {
    /// On these curves; `quick` takes fewer steps, fewer places and a coarser truth.
    pub fn new(curves: Vec<Source>, quick: bool) -> Self {
        let truths = curves.iter().map(|_| OnceLock::new()).collect();
        let (steps, places, tolerances) =
            if quick { (vec![10, 100], 17, [1e-5, 1e-4]) } else { (vec![10, 100, 1000, 10_000], 197, [1e-6, 1e-5]) };
        Self { curves, steps, places, tolerances, truths }
    }

    /// The ground truth of a curve, computed once.
    fn truth(&self, index: usize) -> Result<&Truth, ExperimentError> {
        let (Some(source), Some(cell)) = (self.curves.get(index), self.truths.get(index)) else {
            return Err(ExperimentError::new("there is no such curve"));
        };
        cell.get_or_init(|| Truth::new(source, self.places, self.tolerances)).as_ref().map_err(Clone::clone)
    }

    /// Curve, sampler and steps of a unit; the units after the last are comparisons, one for each curve.
    fn unit(&self, unit: u32) -> (usize, usize, Option<u32>) {
        let (unit, steps) = (unit as usize, self.steps.len());
        let each = SAMPLERS.len() * steps + 1;
        let (curve, rest) = (unit / each, unit % each);
        (curve, rest / steps, if rest + 1 == each { None } else { self.steps.get(rest % steps).copied() })
    }

    /// A timed run in a scalar, its errors.
    fn ours<S: Scalar>(source: &Source, truth: &Truth, steps: u32) -> Result<Vec<Finding>, ExperimentError> {
        let start = Clock::start();
        let job = Job::<S>::new(source, &Resolution::Steps(steps))?;
        let curve = job.curve.curve();
        for segment in curve.segments {
            for i in 0..steps {
                let t = S::from_f64(f64::from(i) / f64::from(steps));
                black_box(job.medial.lfs(&segment.point(&t)).to_f64());
            }
        }
        let gaps = job.gaps(source)?;
        let seconds = start.seconds();
        let lfs: Vec<f64> = truth.points.iter().map(|p| job.distance(p)).collect();
        Ok(errors(source, truth, seconds, &lfs, |p| job.distance(p), &gaps))
    }

    fn prototype(&self, source: &Source, truth: &Truth, steps: u32) -> Result<Vec<Finding>, ExperimentError> {
        let start = Clock::start();
        let model = source.model::<f32>(CORNER_DEGREES)?;
        let prototype = Prototype::new(&model, steps);
        // Where lfs is wrong it may be wrong by so much that there is no end of samples.
        let gaps = gaps(source, &model, &prototype).unwrap_or_default();
        let seconds = start.seconds();
        let segments = (0_u32..).zip(model.curve().segments);
        let places = segments.flat_map(|(segment, _)| parameters(self.places).map(move |t| (segment, t)));
        let lfs: Vec<f64> = places.map(|(segment, t)| prototype.lfs_at(segment, t)).collect();
        Ok(errors(source, truth, seconds, &lfs, |p| prototype.distance(p), &gaps))
    }

    /// The steps at which scalars are compared.
    fn compared(&self) -> u32 {
        self.steps.get(self.steps.len().saturating_sub(2)).copied().unwrap_or(10)
    }
}

/// A line of a plot: its label, whether it is printed, and what was measured at which steps.
type Line = (String, bool, Vec<(u32, [f64; 4])>);

/// The findings of one row.
fn errors(
    source: &Source,
    truth: &Truth,
    seconds: f64,
    lfs: &[f64],
    distance: impl Fn(&Point<f64>) -> f64,
    gaps: &[Vec<f64>],
) -> Vec<Finding> {
    let unit = source.hull_diagonal();
    let medial = rms(truth.medial.iter().map(distance)) / unit;
    let gap_errors = gaps.iter().zip(&truth.gaps).flat_map(|(a, b)| differences(a, b));
    let distance = if gaps.is_empty() { f64::NAN } else { rms(gap_errors) / unit };
    let count = |gaps: &[Vec<f64>]| gaps.iter().map(Vec::len).sum::<usize>() as f64;
    let measured = [seconds, medial, rms(differences(lfs, &truth.lfs)) / unit, distance];
    let mut findings: Vec<Finding> =
        MEASURES.iter().zip(measured).map(|(name, value)| Finding::new(*name, value)).collect();
    findings.push(Finding::new("gaps", if gaps.is_empty() { f64::NAN } else { count(gaps) }));
    findings.push(Finding::new("true_gaps", count(&truth.gaps)));
    findings.push(Finding::new("lfs_differs", truth.lfs_differs));
    findings.push(Finding::new("gaps_differ", truth.gaps_differ));
    findings
}

impl Experiment for Table1 {
    fn name(&self) -> &'static str {
        "table1"
    }

    fn fingerprint(&self) -> String {
        let curves: Vec<String> = self.curves.iter().map(Source::fingerprint).collect();
        let steps: Vec<String> = self.steps.iter().map(u32::to_string).collect();
        let [fine, coarse] = self.tolerances;
        let truth = format!("{TRUEST} at {} places and {fine:e} and {coarse:e}", self.places);
        format!("{} steps={} truth={truth}", curves.join(" "), steps.join("+"))
    }

    fn units(&self) -> u32 {
        u32::try_from(self.curves.len() * (SAMPLERS.len() * self.steps.len() + 1)).unwrap_or(u32::MAX)
    }

    fn timed(&self) -> bool {
        true
    }

    fn run(&self, unit: u32) -> Result<Vec<Finding>, ExperimentError> {
        let (curve, sampler, steps) = self.unit(unit);
        let Some(source) = self.curves.get(curve) else { return Ok(Vec::new()) };
        let Some(steps) = steps else { return agreement::compare(source, self.places, self.compared()) };
        let truth = self.truth(curve)?;
        match sampler {
            0 => Self::ours::<f32>(source, truth, steps),
            1 => Self::ours::<f64>(source, truth, steps),
            2 if cfg!(feature = "mpfr") => Self::ours::<Truest>(source, truth, steps),
            _ => self.prototype(source, truth, steps),
        }
    }

    fn report(&self, findings: &[Vec<Finding>]) -> Result<Report, ExperimentError> {
        let columns = [
            "curve",
            "sampler",
            "steps",
            "seconds",
            "medial_rmse",
            "lfs_rmse",
            "distance_rmse",
            "samples",
            "medial_order",
            "lfs_order",
        ];
        let mut table = Table::new("table1", "Table 1: error and time against steps a segment", &columns);
        let mut agreement = agreement::Tables::new();
        let mut series: Vec<Line> = Vec::new();
        let (mut before, mut uncertainty) = (None::<(String, u32, [f64; 4])>, Vec::new());
        for (unit, found) in (0_u32..).zip(findings) {
            let (curve, sampler, steps) = self.unit(unit);
            let source = self.curves.get(curve).ok_or_else(|| ExperimentError::new("there is no such curve"))?;
            let Some(steps) = steps else {
                agreement.add(source, found)?;
                continue;
            };
            let mut measured = [0.0; 4];
            for (place, name) in measured.iter_mut().zip(MEASURES) {
                *place = value(found, name)?;
            }
            let sampler = SAMPLERS.get(sampler).copied().unwrap_or_default();
            let label = format!("{} {sampler}", source.name);
            // log(e₁/e₂) / log(n₂/n₁): 2 means that twice the steps make a quarter of the error.
            let order = |i: usize| match &before {
                Some((name, n, old)) if *name == label => {
                    (old[i] / measured[i]).ln() / (f64::from(steps) / f64::from(*n)).ln()
                }
                _ => f64::NAN,
            };
            let orders = [order(1), order(2)];
            let mut row = vec![Cell::text(&source.name), Cell::text(sampler), Cell::Count(steps.into())];
            row.extend(measured.map(Cell::number));
            row.push(Cell::count(value(found, "gaps")?));
            row.extend(orders.map(Cell::number));
            table.rows.push(row);
            before = Some((label.clone(), steps, measured));
            match series.last_mut() {
                Some((name, _, points)) if *name == label => points.push((steps, measured)),
                _ => series.push((label, false, vec![(steps, measured)])),
            }
            let [lfs, differ, count] = ["lfs_differs", "gaps_differ", "true_gaps"].map(|name| value(found, name));
            let own = (source.name.clone(), [lfs?, differ?, count?]);
            if uncertainty.last() != Some(&own) {
                uncertainty.push(own);
            }
        }
        for (name, steps, measured) in PRINTED {
            let mut row = vec![Cell::text("complex"), Cell::text(format!("{name} printed")), Cell::Count(steps.into())];
            row.extend(measured.map(Cell::number));
            row.extend([Cell::Empty, Cell::Empty, Cell::Empty]);
            table.rows.push(row);
            let label = format!("complex {name} printed");
            match series.last_mut() {
                Some((known, _, points)) if *known == label => points.push((steps, measured)),
                _ => series.push((label, true, vec![(steps, measured)])),
            }
        }
        table.notes = self.notes(&uncertainty);
        let plots = [
            ("table1-lfs", "RMSE of lfs", 2, "share of the hull diagonal"),
            ("table1-medial", "RMSE of the medial axis", 1, "share of the hull diagonal"),
            ("table1-time", "Time of the whole job", 0, "seconds"),
        ]
        .into_iter()
        .map(|(name, title, column, unit)| Plot {
            name: name.to_owned(),
            title: title.to_owned(),
            x: Axis { label: "steps a segment".to_owned(), logarithmic: true },
            y: Axis { label: unit.to_owned(), logarithmic: true },
            series: series
                .iter()
                .map(|(label, dashed, points)| Series {
                    label: label.clone(),
                    points: points.iter().map(|(n, measured)| [f64::from(*n), measured[column]]).collect(),
                    dashed: *dashed,
                })
                .collect(),
        })
        .collect();
        Ok(Report {
            name: "table1",
            tables: vec![table, agreement.counts, agreement.each],
            plots,
            bars: vec![],
            pictures: vec![],
        })
    }
}

impl Table1 {
    fn notes(&self, uncertainty: &[(String, [f64; 3])]) -> Vec<String> {
        let [fine, coarse] = self.tolerances;
        let differ: Vec<String> = uncertainty
            .iter()
            .map(|(name, [lfs, gaps, count])| {
                format!("{name} {} and {} ({count} gaps between samples)", three_digits(*lfs), three_digits(*gaps))
            })
            .collect();
        let mut notes = vec![
            format!(
                "Ground truth: {TRUEST}. Medial points are tangent disks at the places themselves. lfs is minimised over \
                 feet, started from medial polylines of a relative tolerance of {fine:e}; gaps are those of our sampler on \
                 these polylines. With polylines of {coarse:e} instead, the largest difference of lfs (at one place in \
                 {CHECKED}) and the RMS of the differences of gaps are: {}; smaller errors than that are not resolved.",
                differ.join(", ")
            ),
            format!(
                "Errors are root mean squares over {} places a segment, relative to the longest hull diagonal (the longest \
                 distance of two control points of one cubic). Medial axis: distance of true medial points (nearer side, \
                 radius at most the drawing's diagonal; far branches would decide the mean) from the medial polylines. lfs: \
                 at the same places, which fall on feet of no row. Distance: gaps between consecutive samples at ε = 1/2, \
                 compared one by one from the first sample of each path on, as far as both have them; once the two sets are \
                 out of step the difference is that of unrelated gaps.",
                self.places
            ),
            format!(
                "*seconds*: {} of the whole job on one core: door, medial polylines, index, lfs at every foot, ε-samples. \
                 *order* is the exponent p of error ~ steps^(−p) from the row above to this one; chords of a smooth medial \
                 branch make it 2.",
                clock::kind()
            ),
            "*[OMW16] re-created*: single floats, disks through other foot points, lfs from the nearest medial point, both by \
             searching all points; made from the paper's description, not from the program that the paper measured. Its lfs \
             is that of the foot nearest in parameter. Printed rows are those of the paper for COMPLEX, against its own \
             10 000 steps."
                .to_owned(),
        ];
        if self.curves.iter().any(|curve| curve.shipped) {
            notes.push(
                "Warning: no curve was given with --curve, so drawings that come with the program were used; the printed \
                 rows are about another curve."
                    .to_owned(),
            );
        }
        notes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use feature_sampling::bezier::Cubic;

    #[test]
    fn a_small_table() {
        let cubic = |p: [[f64; 2]; 4]| Cubic { points: p.map(|[x, y]| Point::new(x, y)) };
        let wave = cubic([[0.0, 0.0], [30.0, 25.0], [70.0, -25.0], [100.0, 0.0]]);
        let arch = cubic([[0.0, 40.0], [30.0, 10.0], [70.0, 10.0], [100.0, 40.0]]);
        let paths = vec![(false, vec![wave]), (false, vec![arch])];
        let table = Table1::new(vec![Source { name: "two".into(), shipped: true, paths }], true);
        let findings: Vec<_> = (0..table.units()).map(|unit| table.run(unit).expect("done")).collect();
        let lfs = |unit: usize| value(&findings[unit], "lfs").expect("measured");
        // f32 at 10 and 100 steps, f64 at both, perhaps MPFR at both, the prototype at both, the comparison.
        let (prototype, compared) = (2 * SAMPLERS.len() - 1, 2 * SAMPLERS.len());
        assert!(lfs(3) < lfs(2) / 30.0, "second order: {} {}", lfs(2), lfs(3));
        assert!((lfs(0) / lfs(2) - 1.0).abs() < 1e-2, "with few steps the scalar does not matter");
        assert!(lfs(prototype) > 10.0 * lfs(3), "vertices without edges are far worse");
        for scalar in ["f32", "f64"] {
            for kind in ["equidistant", "special"] {
                let count = |what| value(&findings[compared], &format!("{scalar} {kind} {what}")).expect("compared");
                assert_eq!((count("unexplained"), count("lfs_beyond")), (0.0, 0.0), "{scalar} {kind}");
            }
        }
        // Two different densities of polylines; the truth comes from neither.
        assert!(value(&findings[3], "lfs_differs").expect("measured") < 1e-12, "the truth is one");
        let report = table.report(&findings).expect("a report");
        assert_eq!((report.tables.len(), report.plots.len()), (3, 3));
        assert_eq!(report.tables[0].rows.len(), compared + PRINTED.len());
    }
}
