//! Table 2: what the hull test and the quintic solver save.
//!
//! The paper's method ([`crate::shrinking`]) with the hull test, without it, and with a general companion-matrix solver in the
//! place of the quintic solver, beside this project's own (hierarchy of arcs, no polynomial roots), on the same curves. A
//! run is the whole job: medial polylines at `steps` feet a segment, their index, lfs at every foot. Variants take turns,
//! and the least of several times counts, so that ratios hold on a machine that is doing other things as well.

use std::hint::black_box;

use feature_sampling::medial::Resolution;
use feature_sampling::model::{CurveModel, MedialModel};

use crate::clock::{self, Clock};
use crate::report::{Cell, Report, Table};
use crate::shrinking::{self, Variant, places};
use crate::source::Source;
use crate::{Experiment, ExperimentError, Finding, value};

/// What the paper prints: curve, "segments", and seconds with hull test, without, with Eigen.
const PRINTED: [(&str, u32, [f64; 3]); 3] =
    [("bunny", 68, [0.64, 2.22, 4.52]), ("complex", 108, [4.36, 10.76, 26.20]), ("spiral", 152, [3.00, 13.91, 17.86])];

/// The columns of times, in order, as findings and CSV name them.
const TIMES: [&str; 4] = ["hull_test", "no_hull_test", "companion", "hierarchy"];

/// Joints that turn by less are smooth, in degrees: the program's default.
const CORNER_DEGREES: f64 = 1.0;

/// The experiment.
#[derive(Clone, Debug)]
pub struct Table2 {
    curves: Vec<Source>,
    steps: u32,
    rounds: u32,
}

impl Table2 {
    /// On these curves; `quick` takes fewer feet and one round.
    pub fn new(curves: Vec<Source>, quick: bool) -> Self {
        let (steps, rounds) = if quick { (50, 1) } else { (1000, 3) };
        Self { curves, steps, rounds }
    }

    /// Seconds that one variant takes, and the radii that it found at the feet of all segments.
    fn once(&self, model: &CurveModel<f64>, column: usize) -> (f64, Vec<f64>) {
        let variants = [Variant::HullTest, Variant::NoHullTest, Variant::Companion];
        let start = Clock::start();
        let medial = match variants.get(column) {
            Some(variant) => shrinking::medial_model(model, self.steps, *variant),
            None => MedialModel::new(model, &Resolution::Steps(self.steps)),
        };
        let curve = model.curve();
        let lfs: Vec<f64> = places(&curve, self.steps).map(|(_, t, s)| medial.lfs(&s.point(&t))).collect();
        (start.seconds(), black_box(lfs))
    }
}

impl Experiment for Table2 {
    fn name(&self) -> &'static str {
        "table2"
    }

    fn fingerprint(&self) -> String {
        let curves: Vec<String> = self.curves.iter().map(Source::fingerprint).collect();
        format!("{} steps={} rounds={}", curves.join(" "), self.steps, self.rounds)
    }

    fn units(&self) -> u32 {
        u32::try_from(self.curves.len()).unwrap_or(u32::MAX)
    }

    fn timed(&self) -> bool {
        true
    }

    fn run(&self, unit: u32) -> Result<Vec<Finding>, ExperimentError> {
        let Some(source) = self.curves.get(unit as usize) else { return Ok(Vec::new()) };
        let model = source.model::<f64>(CORNER_DEGREES)?;
        let mut least = [f64::INFINITY; 4];
        let mut lfs: [Vec<f64>; 4] = Default::default();
        for _ in 0..self.rounds {
            for (column, least) in least.iter_mut().enumerate() {
                let (seconds, found) = self.once(&model, column);
                *least = least.min(seconds);
                lfs[column] = found;
            }
        }
        let mut findings: Vec<Finding> =
            TIMES.iter().zip(least).map(|(name, seconds)| Finding::new(*name, seconds)).collect();
        // The three variants of one method have to agree, whatever they take.
        for (name, other) in [("no_hull_test_differs", &lfs[1]), ("companion_differs", &lfs[2])] {
            let differ = lfs[0].iter().zip(other).filter(|(a, b)| (*a - *b).abs() > 1e-4 * model.diagonal()).count();
            findings.push(Finding::new(name, differ as f64));
        }
        findings.push(Finding::new("feet", lfs[0].len() as f64));
        findings.push(Finding::new("segments", model.curve().segments.len() as f64));
        Ok(findings)
    }

    fn report(&self, findings: &[Vec<Finding>]) -> Result<Report, ExperimentError> {
        let columns = [
            "curve",
            "source",
            "cubics",
            "control_points",
            "hierarchy_s",
            "hull_test_s",
            "no_hull_test_s",
            "companion_s",
            "no_hull_test_ratio",
            "companion_ratio",
            "hierarchy_gain",
            "lfs_differs",
        ];
        let title = format!("Table 2: seconds for medial axis and lfs, {} feet a segment", self.steps);
        let mut table = Table::new("table2", title, &columns);
        for (source, found) in self.curves.iter().zip(findings) {
            let [hull, none, companion, ours] = TIMES.map(|name| value(found, name));
            let (hull, none, companion, ours) = (hull?, none?, companion?, ours?);
            let differ = value(found, "no_hull_test_differs")? + value(found, "companion_differs")?;
            let cubics = source.cubics() as u64;
            let mut row = vec![
                Cell::text(&source.name),
                Cell::text(if source.shipped { "measured (shipped drawing)" } else { "measured" }),
                Cell::Count(cubics),
                Cell::Count(4 * cubics),
            ];
            row.extend([ours, hull, none, companion, none / hull, companion / hull, hull / ours].map(Cell::number));
            row.push(Cell::count(differ));
            table.rows.push(row);
        }
        for (name, points, [hull, none, companion]) in PRINTED {
            let mut row = vec![
                Cell::text(name),
                Cell::text("printed"),
                Cell::Count(u64::from(points) / 4),
                Cell::Count(u64::from(points)),
                Cell::Empty,
            ];
            row.extend([hull, none, companion, none / hull, companion / hull].map(Cell::number));
            row.extend([Cell::Empty, Cell::Empty]);
            table.rows.push(row);
        }
        let shipped = self.curves.iter().any(|curve| curve.shipped);
        table.notes = notes(shipped);
        Ok(Report { name: "table2", tables: vec![table], plots: vec![], bars: vec![], pictures: vec![] })
    }
}

fn notes(shipped: bool) -> Vec<String> {
    let mut notes = vec![
        format!("*hull_test*, *no_hull_test* and *companion* are the paper's method, re-created from its section 7.1 in double \
         precision: closest point of all segments by the roots of a quintic, a disk that shrinks until nothing changes, the \
         nearer side kept. *companion* finds the roots as eigenvalues of the companion matrix, as a general library does, \
         with the hull test. *hierarchy* is this project's own method, with both sides kept: one traversal of a bounding \
         hierarchy for each disk, no polynomial roots. Times are {} of the whole job on one core: medial polylines, index, \
         lfs at every foot; the least of the rounds, in which the variants take turns.", clock::kind()),
        "*lfs_differs* counts feet at which lfs of the three variants of the one method differs by more than 1e-4 of the \
         diagonal."
            .to_owned(),
        "What the paper prints as segment count (68, 108, 152) is the number of control points, four a cubic: its BUNNY, \
         COMPLEX and SPIRAL have 17, 27 and 38 cubics."
            .to_owned(),
        "Ratios against *hull_test*. Without the hull test every segment is solved for, so that ratio grows with the number of \
         segments and with how cheap the test is against the solver: a faster quintic solver makes it smaller, and so does \
         a start from a small disk. The companion ratio is that of two solvers diluted by the hull tests around them. In \
         the hierarchy the hull test has become a box test that a whole subtree shares, and the closest-point search is \
         gone: *hierarchy_gain* is what both bring together, although twice as many disks are kept."
            .to_owned(),
    ];
    if shipped {
        notes.push(
            "Warning: no curve was given with --curve, so drawings that come with the program were used. The paper's curves \
             are different ones: times cannot be compared with the printed rows, ratios only loosely."
                .to_owned(),
        );
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::*;
    use feature_sampling::bezier::Cubic;
    use feature_sampling::geometry::Point;

    #[test]
    fn a_small_table() {
        let cubic = |p: [[f64; 2]; 4]| Cubic { points: p.map(|[x, y]| Point::new(x, y)) };
        let wave = cubic([[0.0, 0.0], [30.0, 25.0], [70.0, -25.0], [100.0, 0.0]]);
        let arch = cubic([[0.0, 40.0], [30.0, 10.0], [70.0, 10.0], [100.0, 40.0]]);
        let paths = vec![(false, vec![wave]), (false, vec![arch])];
        let table = Table2::new(vec![Source { name: "two".into(), shipped: true, paths }], true);
        let findings = table.run(0).expect("done");
        assert_eq!(value(&findings, "no_hull_test_differs"), Ok(0.0), "the hull test changes nothing");
        assert_eq!(value(&findings, "companion_differs"), Ok(0.0), "nor does the solver");
        let report = table.report(&[findings]).expect("a report");
        assert_eq!(report.tables[0].rows.len(), 4, "ours and the three printed ones");
        assert!(report.markdown().contains("Warning: no curve was given"), "said");
    }
}
