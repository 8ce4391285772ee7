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
//! The **ground truth** is computed at two resolutions; what they differ by stands beside the table. With the feature `mpfr` it
//! is computed in 128 bits ([`feature_sampling_mpfr`](../../feature_sampling_mpfr/index.html)), without in `f64`; the table
//! says which. Radii are exact in the scalar at any density, so that a comparison of `f32` and `f64` with the truth says
//! where these disagree about the medial side, and whether by more than rounding explains.

use std::hint::black_box;
use std::sync::OnceLock;

use feature_sampling::curve::CurveParam;
use feature_sampling::geometry::Point;
use feature_sampling::lfs::FeatureSize;
use feature_sampling::medial::{Foot, Resolution, Side, tangent_disk};
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::{self, SamplingOptions};
use feature_sampling::scalar::Scalar;

use crate::clock::{self, Clock};
use crate::plot::{Axis, Plot, Series};
use crate::prototype::Prototype;
use crate::report::{Cell, Report, Table, three_digits};
use crate::source::Source;
use crate::{Experiment, ExperimentError, Finding, value};

#[cfg(feature = "mpfr")]
type Truest = feature_sampling_mpfr::Mpfr<128>;
#[cfg(not(feature = "mpfr"))]
type Truest = f64;

/// The scalar of the ground truth, as tables name it.
const TRUEST: &str = if cfg!(feature = "mpfr") { "MPFR with 128 bits" } else { "f64 (built without the feature mpfr)" };

/// Joints that turn by less are smooth, in degrees: the program's default.
const CORNER_DEGREES: f64 = 1.0;

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

/// The samplers that are measured.
const SAMPLERS: [&str; 3] = ["f32", "f64", "[OMW16] re-created"];

/// Names of what is measured, in the order of the columns.
const MEASURES: [&str; 4] = ["seconds", "medial", "lfs", "distance"];

/// Two scalars may disagree about the nearer side where the two radii differ relatively by less than this: rounding of the
/// coordinates (2^-24, 2^-53 of the diagonal), amplified where a disk touches at a small angle.
const SIDE_BOUND: [(&str, f64); 2] = [("f32", 1e-4), ("f64", 1e-12)];

/// … and about lfs, at the same steps, by this share of the hull diagonal.
const LFS_BOUND: [(&str, f64); 2] = [("f32", 1e-5), ("f64", 1e-13)];

/// The experiment.
#[derive(Debug)]
pub struct Table1 {
    curves: Vec<Source>,
    steps: Vec<u32>,
    /// Places a segment.
    places: u32,
    /// The two relative tolerances of the ground truth, the finer first.
    tolerances: [f64; 2],
    truths: Vec<OnceLock<Result<Truth, ExperimentError>>>,
}

/// What is true of a curve, rounded to doubles.
#[derive(Clone, Debug)]
struct Truth {
    /// Points of the curve at the places.
    points: Vec<Point<f64>>,
    /// Radii to the left and to the right there; infinite where there is no disk.
    radii: Vec<[f64; 2]>,
    /// Medial points of the nearer side there, with radii up to the diagonal.
    medial: Vec<Point<f64>>,
    lfs: Vec<f64>,
    gaps: Vec<Vec<f64>>,
    /// Root mean square difference of lfs at the two resolutions, over the hull diagonal.
    uncertainty: f64,
}

/// What one sampler makes of a curve.
struct Job<S> {
    curve: CurveModel<S>,
    medial: MedialModel<S>,
}

impl<S: Scalar> Job<S> {
    fn new(source: &Source, resolution: &Resolution<S>) -> Result<Self, ExperimentError> {
        let curve = source.model::<S>(CORNER_DEGREES)?;
        let medial = MedialModel::new(&curve, resolution);
        Ok(Self { curve, medial })
    }

    fn gaps(&self, source: &Source) -> Result<Vec<Vec<f64>>, ExperimentError> {
        gaps(source, &self.curve, &self.medial.index())
    }

    fn lfs(&self, p: &Point<f64>) -> f64 {
        self.medial.lfs(&Point::from_f64(p.x, p.y)).to_f64()
    }

    /// Distance of a point of the plane from the medial polylines.
    fn distance(&self, p: &Point<f64>) -> f64 {
        self.lfs(p)
    }
}

/// Distances of consecutive samples, path by path.
fn gaps<S: Scalar>(
    source: &Source,
    model: &CurveModel<S>,
    features: &impl FeatureSize<S>,
) -> Result<Vec<Vec<f64>>, ExperimentError> {
    let curve = model.curve();
    let mut all = Vec::new();
    for (path, _) in (0_u32..).zip(curve.paths) {
        let (mut samples, mut scratch) = (Vec::new(), Vec::new());
        let options = SamplingOptions::default();
        sampling::sample_path(&curve, features, model.contacts(), path, &options, &mut samples, &mut scratch)
            .map_err(|error| ExperimentError::new(format!("{}: path {path}: {error}", source.name)))?;
        all.push(samples.windows(2).map(|pair| pair[0].point.distance(&pair[1].point).to_f64()).collect());
    }
    Ok(all)
}

/// The places of one segment.
fn parameters(count: u32) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| (f64::from(i) + 0.5) / f64::from(count))
}

/// The tangent disks at the places.
struct Disks {
    /// The places on the curve.
    points: Vec<Point<f64>>,
    /// Radii to the left and to the right.
    radii: Vec<[f64; 2]>,
    /// Centres of the nearer side, with radii up to the diagonal.
    centres: Vec<Point<f64>>,
}

/// The tangent disks at the places.
fn disks<S: Scalar>(model: &CurveModel<S>, places: u32) -> Disks {
    let curve = model.curve();
    let (mut points, mut all, mut centres) = (Vec::new(), Vec::new(), Vec::new());
    let lower = |p: &Point<S>| Point::new(p.x.to_f64(), p.y.to_f64());
    for (segment, _) in (0_u32..).zip(curve.segments) {
        for t in parameters(places) {
            let at = CurveParam { segment, t: S::from_f64(t) };
            let mut radii = [S::infinity(), S::infinity()];
            let mut centre = None;
            for (i, side) in [Side::Left, Side::Right].into_iter().enumerate() {
                let Some(foot) = Foot::normal(&curve, at.clone(), side) else { continue };
                radii[i] = tangent_disk(&curve, &foot).radius;
                if radii[i] <= *curve.diagonal && (i == 0 || radii[1] < radii[0]) {
                    centre = Some(lower(&foot.point.plus_scaled(&radii[i], &foot.direction)));
                }
            }
            points.extend(curve.point(&at).as_ref().map(lower));
            all.push(radii.map(|r| r.to_f64()));
            centres.extend(centre);
        }
    }
    Disks { points, radii: all, centres }
}

/// Root mean square.
fn rms(values: impl IntoIterator<Item = f64>) -> f64 {
    let (sum, count) = values.into_iter().fold((0.0, 0_u32), |(sum, n), v| (sum + v * v, n + 1));
    (sum / f64::from(count.max(1))).sqrt()
}

/// Differences where both are finite (a curve without a medial axis has an infinite lfs in every row).
fn differences<'v>(a: &'v [f64], b: &'v [f64]) -> impl Iterator<Item = f64> + 'v {
    a.iter().zip(b).map(|(a, b)| a - b).filter(|d| d.is_finite())
}

impl Table1 {
    /// On these curves; `quick` takes fewer steps, fewer places and a coarser truth.
    pub fn new(curves: Vec<Source>, quick: bool) -> Self {
        let truths = curves.iter().map(|_| OnceLock::new()).collect();
        let (steps, places, tolerances) =
            if quick { (vec![10, 100], 37, [1e-6, 1e-5]) } else { (vec![10, 100, 1000, 10_000], 197, [1e-8, 1e-7]) };
        Self { curves, steps, places, tolerances, truths }
    }

    /// The ground truth of a curve, computed once.
    fn truth(&self, index: usize) -> Result<&Truth, ExperimentError> {
        let (Some(source), Some(cell)) = (self.curves.get(index), self.truths.get(index)) else {
            return Err(ExperimentError::new("there is no such curve"));
        };
        cell.get_or_init(|| {
            let [fine, coarse] = self.tolerances.map(|tolerance| Resolution::Tolerance(Truest::from_f64(tolerance)));
            let coarse = Job::<Truest>::new(source, &coarse)?;
            let Disks { points, radii, centres: medial } = disks(&coarse.curve, self.places);
            let coarse: Vec<f64> = points.iter().map(|p| coarse.lfs(p)).collect();
            let fine = Job::<Truest>::new(source, &fine)?;
            let lfs: Vec<f64> = points.iter().map(|p| fine.lfs(p)).collect();
            let uncertainty = rms(differences(&lfs, &coarse)) / source.hull_diagonal();
            Ok(Truth { points, radii, medial, lfs, gaps: fine.gaps(source)?, uncertainty })
        })
        .as_ref()
        .map_err(Clone::clone)
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
                black_box(job.medial.lfs(&segment.point(&t)));
            }
        }
        let gaps = job.gaps(source)?;
        let seconds = start.seconds();
        let lfs: Vec<f64> = truth.points.iter().map(|p| job.lfs(p)).collect();
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

    /// Where a scalar and the truth disagree about the nearer side or about lfs, and whether by more than is allowed.
    fn compare<S: Scalar>(&self, source: &Source, truth: &Truth, name: &str) -> Result<Vec<Finding>, ExperimentError> {
        let steps = self.steps.get(self.steps.len().saturating_sub(2)).copied().unwrap_or(10);
        let job = Job::<S>::new(source, &Resolution::Steps(steps))?;
        let same = Job::<Truest>::new(source, &Resolution::Steps(steps))?;
        let radii = disks(&job.curve, self.places).radii;
        let unit = source.hull_diagonal();
        let bound = |bounds: &[(&str, f64)]| bounds.iter().find(|b| b.0 == name).map_or(0.0, |b| b.1);
        let (side_bound, lfs_bound) = (bound(&SIDE_BOUND), bound(&LFS_BOUND));
        let (mut other_side, mut unexplained, mut worst_radius) = (0_u32, 0_u32, 0.0_f64);
        let diagonal = source_diagonal(&job);
        for (found, known) in radii.iter().zip(&truth.radii) {
            // Beyond the diagonal a disk counts as a half-plane.
            let [found, known] = [found, known].map(|r| r.map(|r| if r <= diagonal { r } else { f64::INFINITY }));
            if known[0].min(known[1]).is_finite() {
                worst_radius = worst_radius.max((found[0].min(found[1]) / known[0].min(known[1]) - 1.0).abs());
            }
            if (found[0] < found[1]) == (known[0] < known[1]) {
                continue;
            }
            other_side += 1;
            let tie = known[0] == known[1] || (known[0] - known[1]).abs() <= side_bound * known[0].min(known[1]);
            unexplained += u32::from(!tie);
        }
        let (mut worst_lfs, mut beyond) = (0.0_f64, 0_u32);
        for p in &truth.points {
            let difference = (job.lfs(p) - same.lfs(p)).abs() / unit;
            if difference.is_finite() {
                worst_lfs = worst_lfs.max(difference);
                beyond += u32::from(difference > lfs_bound);
            }
        }
        Ok([
            ("places", truth.points.len() as f64),
            ("other_side", f64::from(other_side)),
            ("unexplained_sides", f64::from(unexplained)),
            ("worst_radius", worst_radius),
            ("worst_lfs", worst_lfs),
            ("lfs_beyond", f64::from(beyond)),
            ("steps", f64::from(steps)),
        ]
        .into_iter()
        .map(|(what, value)| Finding::new(format!("{name} {what}"), value))
        .collect())
    }
}

/// A line of a plot: its label, whether it is printed, and what was measured at which steps.
type Line = (String, bool, Vec<(u32, [f64; 4])>);

/// The diagonal of the drawing.
fn source_diagonal<S: Scalar>(job: &Job<S>) -> f64 {
    job.curve.diagonal().to_f64()
}

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
    findings.push(Finding::new("uncertainty", truth.uncertainty));
    findings
}

impl Experiment for Table1 {
    fn name(&self) -> &'static str {
        "table1"
    }

    fn fingerprint(&self) -> String {
        let curves: Vec<String> = self.curves.iter().map(Source::fingerprint).collect();
        let steps: Vec<String> = self.steps.iter().map(u32::to_string).collect();
        format!("{} steps={} truth={TRUEST}", curves.join(" "), steps.join("+"))
    }

    fn units(&self) -> u32 {
        u32::try_from(self.curves.len() * (SAMPLERS.len() * self.steps.len() + 1)).unwrap_or(u32::MAX)
    }

    fn timed(&self) -> bool {
        true
    }

    fn run(&self, unit: u32) -> Result<Vec<Finding>, ExperimentError> {
        let (curve, sampler, steps) = self.unit(unit);
        let truth = self.truth(curve)?;
        let Some(source) = self.curves.get(curve) else { return Ok(Vec::new()) };
        match (steps, sampler) {
            (None, _) => {
                let mut findings = self.compare::<f32>(source, truth, "f32")?;
                findings.extend(self.compare::<f64>(source, truth, "f64")?);
                Ok(findings)
            }
            (Some(steps), 0) => Self::ours::<f32>(source, truth, steps),
            (Some(steps), 1) => Self::ours::<f64>(source, truth, steps),
            (Some(steps), _) => self.prototype(source, truth, steps),
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
        let mut agreement = Table::new(
            "table1-agreement",
            "Where scalars disagree with the ground truth",
            &[
                "curve",
                "scalar",
                "places",
                "other_side",
                "of_these_unexplained",
                "side_bound",
                "worst_radius_relative",
                "lfs_steps",
                "worst_lfs",
                "lfs_bound",
                "lfs_beyond_bound",
            ],
        );
        let mut series: Vec<Line> = Vec::new();
        let (mut before, mut uncertainty) = (None::<(String, u32, [f64; 4])>, Vec::new());
        for (unit, found) in (0_u32..).zip(findings) {
            let (curve, sampler, steps) = self.unit(unit);
            let source = self.curves.get(curve).ok_or_else(|| ExperimentError::new("there is no such curve"))?;
            let Some(steps) = steps else {
                for (name, side_bound) in SIDE_BOUND {
                    let get = |what: &str| value(found, &format!("{name} {what}"));
                    let lfs_bound = LFS_BOUND.iter().find(|b| b.0 == name).map_or(0.0, |b| b.1);
                    agreement.rows.push(vec![
                        Cell::text(&source.name),
                        Cell::text(name),
                        Cell::count(get("places")?),
                        Cell::count(get("other_side")?),
                        Cell::count(get("unexplained_sides")?),
                        Cell::number(side_bound),
                        Cell::number(get("worst_radius")?),
                        Cell::count(get("steps")?),
                        Cell::number(get("worst_lfs")?),
                        Cell::number(lfs_bound),
                        Cell::count(get("lfs_beyond")?),
                    ]);
                }
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
            let own = (source.name.clone(), value(found, "uncertainty")?, value(found, "true_gaps")?);
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
        agreement.notes = agreement_notes();
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
        Ok(Report { name: "table1", tables: vec![table, agreement], plots, bars: vec![], pictures: vec![] })
    }
}

impl Table1 {
    fn notes(&self, uncertainty: &[(String, f64, f64)]) -> Vec<String> {
        let [fine, coarse] = self.tolerances;
        let differ: Vec<String> = uncertainty
            .iter()
            .map(|(name, u, gaps)| format!("{name} {} ({gaps} gaps between samples)", three_digits(*u)))
            .collect();
        let mut notes = vec![
            format!(
                "Ground truth: {TRUEST}, lfs refined to a relative {fine:e}. At {coarse:e} the RMS of the difference in lfs \
                 is: {}. Smaller errors than that are not resolved.",
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

fn agreement_notes() -> Vec<String> {
    vec![
        "*other_side*: places where the nearer of the two tangent disks lies on the other side than in the ground truth. \
         Explained are those where the two true radii differ relatively by no more than *side_bound*, so that rounding \
         decides: feet of branch points and of the axis between parallel strokes, where both disks are equally large, and \
         inflections and straight stretches, where neither is bounded within the drawing. *worst_radius_relative* compares \
         the nearer radii."
            .to_owned(),
        "lfs is compared at the same number of steps, so that only the scalar differs; bounds and differences are shares of \
         the hull diagonal. An lfs that differs by more stems from a medial point that one scalar keeps and the other does \
         not: a disk that barely touches, or touches at a joint, where coordinates as rounded to the scalar are another \
         drawing."
            .to_owned(),
    ]
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
        // f32 at 10 and 100 steps, f64 at both, the prototype at both.
        assert!(lfs(3) < lfs(2) / 30.0, "second order: {} {}", lfs(2), lfs(3));
        assert!((lfs(0) / lfs(2) - 1.0).abs() < 1e-2, "with few steps the scalar does not matter");
        assert!(lfs(5) > 10.0 * lfs(3), "vertices without edges are far worse");
        let unexplained = value(&findings[6], "f64 unexplained_sides").expect("compared");
        assert_eq!(unexplained, 0.0, "sides agree");
        let report = table.report(&findings).expect("a report");
        assert_eq!((report.tables.len(), report.plots.len()), (2, 3));
        assert_eq!(report.tables[0].rows.len(), 6 + PRINTED.len());
    }
}
