//! Where `f32` and `f64` disagree with the ground truth about the medial side or about lfs, and why.
//!
//! Two kinds of places are looked at: *equidistant* ones, and *special* ones: joints, inflections and vertices, and beside
//! each of them at 1e-9, 1e-6 and 1e-3 in the parameter, where branches of the medial axis end and sides change.
//!
//! The **side** is that of the smaller of the two tangent disks. Where a scalar finds the other side than the truth it is
//!
//! * a *tie*, if the two true radii differ relatively by no more than the stated bound: the foot of a branch point, or one
//!   between parallel strokes, where both disks are equally large and rounding decides;
//! * *touching*, if the nearer true radius is no more than that bound times the diagonal: beside a crossing or a junction,
//!   where both disks shrink to nothing and rounding of coordinates decides;
//! * *flat*, if neither true disk is bounded within the drawing: at an inflection or on a straight stretch;
//! * else *unexplained*, which is an error of the sampler.
//!
//! **lfs** is compared at the same number of steps, so that only the scalar differs.

use feature_sampling::bezier::critical::{inflections, vertices};
use feature_sampling::medial::Resolution;
use feature_sampling::model::CurveModel;
use feature_sampling::scalar::Scalar;

use crate::report::{Cell, Table};
use crate::source::Source;
use crate::truth::{Disks, Job, Truest, disks, equidistant};
use crate::{ExperimentError, Finding, value};

/// A scalar with its bounds.
struct Judged {
    name: &'static str,
    /// The nearer side may be another where the two radii differ relatively by less: rounding of the coordinates (2^-24, 2^-53
    /// of the diagonal), amplified where a disk touches at a small angle.
    side: f64,
    /// lfs may differ by this share of the hull diagonal, at the same steps.
    lfs: f64,
}

const JUDGED: [Judged; 2] =
    [Judged { name: "f32", side: 1e-4, lfs: 1e-5 }, Judged { name: "f64", side: 1e-12, lfs: 1e-13 }];

/// The kinds of places.
const KINDS: [&str; 2] = ["equidistant", "special"];

/// What is counted.
const COUNTS: [&str; 10] = [
    "places",
    "other_side",
    "ties",
    "flat",
    "touching",
    "unexplained",
    "worst_radius",
    "worst_lfs",
    "lfs_beyond",
    "steps",
];

/// Disagreements that are listed for one curve, scalar and kind.
const LISTED: usize = 40;

/// What is said of one disagreement: where it is, the true radii, the radii found, and why.
const FIELDS: [&str; 7] = ["segment", "t", "true_left", "true_right", "left", "right", "why"];

/// Reasons, by their number among the findings.
const REASONS: [&str; 4] = ["tie", "flat", "touching", "unexplained"];

/// Joints, inflections and vertices, and places beside them.
fn special(model: &CurveModel<Truest>) -> Vec<(u32, f64)> {
    let mut places = Vec::new();
    for (segment, s) in (0_u32..).zip(model.curve().segments) {
        let mut stops = vec![0.0, 1.0];
        stops.extend(inflections(&s.power).iter().map(Scalar::to_f64));
        stops.extend(vertices(&s.power).iter().map(Scalar::to_f64));
        let beside = [0.0, 1e-9, -1e-9, 1e-6, -1e-6, 1e-3, -1e-3];
        let mut all: Vec<f64> = stops.iter().flat_map(|t| beside.map(|d| t + d)).collect();
        all.retain(|t| (0.0..=1.0).contains(t));
        all.sort_by(f64::total_cmp);
        all.dedup();
        places.extend(all.into_iter().map(|t| (segment, t)));
    }
    places
}

/// Both scalars against the truth.
pub(crate) fn compare(source: &Source, count: u32, steps: u32) -> Result<Vec<Finding>, ExperimentError> {
    let truth = Job::<Truest>::new(source, &Resolution::Steps(steps))?;
    let mut findings = Vec::new();
    for (kind, places) in KINDS.into_iter().zip([equidistant(&truth.curve, count), special(&truth.curve)]) {
        let known = disks(&truth.curve, &places);
        let lfs: Vec<f64> = known.points.iter().map(|p| truth.distance(p)).collect();
        let [single, double] = &JUDGED;
        findings.extend(judge::<f32>(single, kind, source, (&places, &known, &lfs), steps)?);
        findings.extend(judge::<f64>(double, kind, source, (&places, &known, &lfs), steps)?);
    }
    Ok(findings)
}

/// One scalar at one kind of places; `known` are the places, their true disks and their lfs in the truest scalar.
fn judge<S: Scalar>(
    judged: &Judged,
    kind: &str,
    source: &Source,
    known: (&[(u32, f64)], &Disks, &[f64]),
    steps: u32,
) -> Result<Vec<Finding>, ExperimentError> {
    let (places, known, lfs) = known;
    let job = Job::<S>::new(source, &Resolution::Steps(steps))?;
    let found = disks(&job.curve, places);
    let diagonal = job.curve.diagonal().to_f64();
    let mut counts = [0.0; 4];
    let (mut worst_radius, mut listed) = (0.0_f64, Vec::new());
    for ((place, found), known) in places.iter().zip(&found.radii).zip(&known.radii) {
        // Beyond the diagonal a disk counts as a half-plane.
        let [f, k] = [found, known].map(|r| r.map(|r| if r <= diagonal { r } else { f64::INFINITY }));
        let (nearer, true_nearer) = (f[0].min(f[1]), k[0].min(k[1]));
        if true_nearer.is_finite() && true_nearer > 0.0 {
            worst_radius = worst_radius.max((nearer / true_nearer - 1.0).abs());
        }
        if (f[0] < f[1]) == (k[0] < k[1]) {
            continue;
        }
        let why = if !true_nearer.is_finite() {
            1
        } else if (k[0] - k[1]).abs() <= judged.side * true_nearer {
            0
        } else if true_nearer <= judged.side * diagonal {
            2
        } else {
            3
        };
        counts[why] += 1.0;
        if listed.len() < LISTED {
            let segment = f64::from(place.0);
            listed.push([segment, place.1, known[0], known[1], found[0], found[1], why as f64]);
        }
    }
    let (mut worst_lfs, mut beyond) = (0.0_f64, 0.0);
    for (p, known) in known.points.iter().zip(lfs) {
        let difference = (job.distance(p) - known).abs() / source.hull_diagonal();
        if difference.is_finite() {
            worst_lfs = worst_lfs.max(difference);
            beyond += f64::from(u8::from(difference > judged.lfs));
        }
    }
    let [ties, flat, touching, unexplained] = counts;
    let other = counts.iter().sum();
    let numbers = [
        places.len() as f64,
        other,
        ties,
        flat,
        touching,
        unexplained,
        worst_radius,
        worst_lfs,
        beyond,
        f64::from(steps),
    ];
    let prefix = format!("{} {kind}", judged.name);
    let mut findings: Vec<Finding> =
        COUNTS.iter().zip(numbers).map(|(what, value)| Finding::new(format!("{prefix} {what}"), value)).collect();
    for (i, row) in listed.into_iter().enumerate() {
        let named = FIELDS.iter().zip(row).map(|(field, value)| Finding::new(format!("{prefix} {i} {field}"), value));
        findings.extend(named);
    }
    Ok(findings)
}

/// The two tables: counts, and each disagreement.
pub(crate) struct Tables {
    pub(crate) counts: Table,
    pub(crate) each: Table,
}

impl Tables {
    pub(crate) fn new() -> Self {
        let columns = [
            "curve",
            "scalar",
            "kind",
            "places",
            "other_side",
            "ties",
            "flat",
            "touching",
            "unexplained",
            "side_bound",
            "worst_radius_relative",
            "lfs_steps",
            "worst_lfs",
            "lfs_bound",
            "lfs_beyond_bound",
        ];
        let mut counts = Table::new("table1-agreement", "Where scalars disagree with the ground truth", &columns);
        counts.notes = notes();
        let columns =
            ["curve", "scalar", "kind", "segment", "t", "true_left", "true_right", "left", "right", "explanation"];
        let mut each = Table::new("table1-disagreements", "Each place where the nearer side is another", &columns);
        each.notes = vec![format!(
            "Radii of the tangent disks to the left and to the right, in user units, in the ground truth and as found; at \
             most {LISTED} places a curve, scalar and kind are listed."
        )];
        Self { counts, each }
    }

    /// The rows of one curve.
    pub(crate) fn add(&mut self, source: &Source, found: &[Finding]) -> Result<(), ExperimentError> {
        for judged in &JUDGED {
            for kind in KINDS {
                let prefix = format!("{} {kind}", judged.name);
                let get = |what: &str| value(found, &format!("{prefix} {what}"));
                let count = |what: &str| get(what).map(Cell::count);
                let head = [Cell::text(&source.name), Cell::text(judged.name), Cell::text(kind)];
                let mut row = head.to_vec();
                for what in ["places", "other_side", "ties", "flat", "touching", "unexplained"] {
                    row.push(count(what)?);
                }
                row.extend([Cell::number(judged.side), Cell::number(get("worst_radius")?), count("steps")?]);
                row.extend([Cell::number(get("worst_lfs")?), Cell::number(judged.lfs), count("lfs_beyond")?]);
                self.counts.rows.push(row);
                let mut i = 0;
                while let Ok(segment) = get(&format!("{i} segment")) {
                    let mut row = head.to_vec();
                    row.push(Cell::count(segment));
                    for field in &FIELDS[1..6] {
                        row.push(Cell::number(get(&format!("{i} {field}"))?));
                    }
                    let why = get(&format!("{i} why"))?;
                    let reason = (0_u32..).zip(REASONS).find(|(n, _)| f64::from(*n) == why);
                    row.push(Cell::text(reason.map_or("", |(_, reason)| reason)));
                    self.each.rows.push(row);
                    i += 1;
                }
            }
        }
        Ok(())
    }
}

fn notes() -> Vec<String> {
    vec![
        "*equidistant* places are those of Table 1; *special* ones are joints, inflections and vertices of curvature, and \
         beside each of them at 1e-9, 1e-6 and 1e-3 in the parameter. *other_side*: places where the smaller of the two \
         tangent disks lies on the other side than in the ground truth. Of these, *ties* are places where the two true radii \
         differ relatively by no more than *side_bound*, so that rounding decides: feet of branch points, and of the axis \
         between parallel strokes. *flat* are places where neither true disk is bounded within the drawing: inflections and \
         straight stretches. *touching* are places where the nearer radius is at most *side_bound* times the diagonal: beside \
         crossings and junctions. *unexplained* is what is left, and has to be 0. *worst_radius_relative* compares the nearer \
         radii."
            .to_owned(),
        "lfs is compared at the same number of steps, so that only the scalar differs; bounds and differences are shares of \
         the hull diagonal. *lfs_beyond_bound* has to be 0."
            .to_owned(),
    ]
}
