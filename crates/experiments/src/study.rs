//! The study of reconstruction under ε-sampling (section 4.1): Table 3 and Figure 7.
//!
//! One curve is sampled for 50 values of ε (0.50 to 0.99) from 100 starts each, spread evenly over its parameter; each
//! sample set is reconstructed by each algorithm; a run is *correct* if the edges are those between consecutive samples of
//! each path (with the closing edge of closed ones), no fewer and no more. The medial axis depends neither on ε nor on the
//! start: it is computed once, on first use.
//!
//! Sets come from one of two places: this project's sampler, or a list of given sets, such as those that the paper's
//! own program made. The experiment's units are the values of ε of each of them in turn; a unit's findings are the number
//! of correct runs by algorithm, the number of sets and of points.
//!
//! The sampler's samples are *greedy* here: as far apart as ε allows from the start on. By default, elsewhere, it uses the
//! slack at the seam to lower ε, so that the sets would be better than their ε says.

use std::fmt::Write;
use std::sync::OnceLock;

use feature_sampling::geometry::Point;
use feature_sampling::medial::Resolution;
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::{Condition, SamplingOptions};
use lineart::reconstruct::{Algorithm, Sites};

use crate::source::Source;
use crate::{ExperimentError, Finding, value};

/// Relative error of lfs that the medial axis is refined to.
const TOLERANCE: f64 = 1e-3;

/// Points on a curve in order: what a reconstruction is given and what it should find.
#[derive(Clone, Debug, PartialEq)]
pub struct PointSet {
    /// Paths: closed or not, and the points along them.
    pub paths: Vec<(bool, Vec<Point<f64>>)>,
}

impl PointSet {
    /// All points, path after path.
    pub fn points(&self) -> Vec<Point<f64>> {
        self.paths.iter().flat_map(|(_, points)| points.iter().copied()).collect()
    }

    /// The true edges, by number in [`PointSet::points`]; ascending, sorted, each once. Equal points are one, under the
    /// lowest of their numbers, as reconstructions have it.
    pub fn edges(&self) -> Vec<(usize, usize)> {
        let mut first = std::collections::HashMap::new();
        let mut number = 0;
        let mut edges = Vec::new();
        for (closed, points) in &self.paths {
            let mut numbers = Vec::with_capacity(points.len() + 1);
            for p in points {
                numbers.push(*first.entry([(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()]).or_insert(number));
                number += 1;
            }
            if *closed {
                numbers.extend(numbers.first().copied());
            }
            edges.extend(numbers.windows(2).filter(|w| w[0] != w[1]).map(|w| (w[0].min(w[1]), w[0].max(w[1]))));
        }
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// Which of the algorithms find exactly the true edges.
    ///
    /// # Errors
    /// A coordinate that is not finite.
    pub fn correct(&self, algorithms: &[Algorithm]) -> Result<Vec<bool>, ExperimentError> {
        let sites = Sites::new(&self.points()).map_err(|error| ExperimentError::new(error.to_string()))?;
        let truth = self.edges();
        Ok(algorithms.iter().map(|algorithm| algorithm.edges(&sites) == truth).collect())
    }
}

/// The values of ε and the number of starts.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Values of ε in thousandths: 0.5 is 500.
    pub thousandths: Vec<u32>,
    /// Starts at 0, 1/n, …
    pub starts: u32,
}

impl Grid {
    /// The paper's: 50 × 100.
    pub fn paper() -> Self {
        Self::new(10, 100)
    }

    /// Every fifth ε and ten starts.
    pub fn quick() -> Self {
        Self::new(50, 10)
    }

    /// From 0.5 up to below 1 in steps of so many thousandths, at least one; at least one start.
    pub fn new(step: u32, starts: u32) -> Self {
        Self { thousandths: (500..1000).step_by(step.max(1) as usize).collect(), starts: starts.max(1) }
    }

    fn describe(&self) -> String {
        format!("epsilon={:?} starts={}", self.thousandths, self.starts)
    }
}

/// Sets that somebody else made, as text: `set E O N` with the numbers of ε and of the start (from 0) and a count, then N
/// lines `x y`, points in order along one closed curve. ε number E is 0.50 + E/100.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenSets {
    /// Name of the file.
    pub name: String,
    /// Sets with their ε in thousandths.
    sets: Vec<(u32, PointSet)>,
    hash: u64,
}

impl GivenSets {
    /// Reads the text; `name` is that of the file, for messages and tables.
    ///
    /// # Errors
    /// Names the file, the line and what is wrong with it.
    pub fn read(text: &str, name: &str) -> Result<Self, ExperimentError> {
        let bad = |line: usize, cause: &str| ExperimentError::new(format!("{name}: line {}: {cause}", line + 1));
        let mut sets: Vec<(u32, PointSet)> = Vec::new();
        let mut wanted = 0;
        for (line, content) in text.lines().enumerate() {
            let mut fields = content.split_ascii_whitespace();
            if wanted == 0 {
                let is_header = fields.next() == Some("set");
                let mut number = || fields.next().and_then(|f| f.parse::<u32>().ok()).filter(|_| is_header);
                let (Some(epsilon), Some(_), Some(count)) = (number(), number(), number()) else {
                    return Err(bad(line, "“set E O N” is expected here"));
                };
                if epsilon > 49 {
                    return Err(bad(line, "ε is 0.50 + E/100, so E is at most 49"));
                }
                wanted = count;
                sets.push((500 + 10 * epsilon, PointSet { paths: vec![(true, Vec::new())] }));
                continue;
            }
            let mut number = || fields.next().and_then(|f| f.parse::<f64>().ok()).filter(|v| v.is_finite());
            let (Some(x), Some(y)) = (number(), number()) else {
                return Err(bad(line, "“x y” is expected here"));
            };
            if let Some((_, points)) = sets.last_mut().and_then(|(_, set)| set.paths.last_mut()) {
                points.push(Point::new(x, y));
            }
            wanted -= 1;
        }
        if wanted > 0 {
            return Err(bad(text.lines().count(), "the last set is incomplete"));
        }
        if sets.is_empty() {
            return Err(bad(0, "there is no set in it"));
        }
        Ok(Self { name: crate::source::table_name(name), sets, hash: crate::source::fnv(text.bytes()) })
    }
}

/// A curve and its medial axis.
type Models = (CurveModel<f64>, MedialModel<f64>);

/// Where sample sets come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Samples {
    Ours,
    Given,
}

/// The study: sets, algorithms, and which units there are.
#[derive(Debug)]
pub struct Study {
    curve: Option<Source>,
    grid: Grid,
    given: Option<GivenSets>,
    models: OnceLock<Result<Models, ExperimentError>>,
}

/// What came of the sets of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Heading.
    pub label: String,
    /// A word for the names of columns: `ours`, `given`.
    pub key: &'static str,
    /// Values of ε in thousandths.
    pub thousandths: Vec<u32>,
    /// Sets by ε.
    pub sets: Vec<f64>,
    /// All points of all sets.
    pub points: f64,
    /// Correct runs by algorithm (in the order of [`Algorithm::MAIN`]) and ε.
    pub correct: Vec<Vec<f64>>,
}

impl Study {
    /// Of a curve; of sets that were given as well. Without a curve, of those alone.
    pub const fn new(curve: Option<Source>, grid: Grid, given: Option<GivenSets>) -> Self {
        Self { curve, grid, given, models: OnceLock::new() }
    }

    /// The curve and its medial axis, computed by whoever asks first.
    fn models(&self, curve: &Source) -> Result<&Models, ExperimentError> {
        let build = || {
            let model = curve.model::<f64>(1.0)?;
            let medial = MedialModel::new(&model, &Resolution::Tolerance(TOLERANCE));
            Ok((model, medial))
        };
        self.models.get_or_init(build).as_ref().map_err(Clone::clone)
    }

    /// The sample set of one ε and one start.
    ///
    /// # Errors
    /// A curve that the kernel refuses, or too many samples.
    pub fn sample(&self, curve: &Source, epsilon: f64, start: f64) -> Result<PointSet, ExperimentError> {
        let (model, medial) = self.models(curve)?;
        let options = SamplingOptions {
            condition: Condition::Epsilon(epsilon),
            start,
            tolerance: TOLERANCE,
            even: false,
            ..SamplingOptions::default()
        };
        let mut paths = Vec::new();
        for (path, number) in model.curve().paths.iter().zip(0_u32..) {
            let samples = model
                .sample_path(medial, number, &options)
                .map_err(|error| ExperimentError::new(format!("{}: {error}", curve.name)))?;
            paths.push((path.closed, samples.iter().map(|sample| sample.point).collect()));
        }
        Ok(PointSet { paths })
    }

    /// Values of ε of the given sets.
    fn given_thousandths(given: &GivenSets) -> Vec<u32> {
        let mut all: Vec<u32> = given.sets.iter().map(|(epsilon, _)| *epsilon).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Kinds of sets with their values of ε, in the order of the units.
    fn kinds(&self) -> Vec<(Samples, Vec<u32>)> {
        let ours = self.curve.iter().map(|_| (Samples::Ours, self.grid.thousandths.clone()));
        ours.chain(self.given.iter().map(|given| (Samples::Given, Self::given_thousandths(given)))).collect()
    }

    pub(crate) fn fingerprint(&self) -> String {
        let mut text = String::new();
        if let Some(curve) = &self.curve {
            // Writing to a string cannot fail.
            let _ = write!(text, "{} {}", curve.fingerprint(), self.grid.describe());
        }
        if let Some(given) = &self.given {
            let _ = write!(text, " given={:016x}", given.hash);
        }
        text.trim_start().to_owned()
    }

    pub(crate) fn units(&self) -> u32 {
        self.kinds().iter().map(|(_, values)| u32::try_from(values.len()).unwrap_or(0)).sum()
    }

    pub(crate) fn run(&self, unit: u32) -> Result<Vec<Finding>, ExperimentError> {
        let all = self.kinds().into_iter().flat_map(|(kind, values)| values.into_iter().map(move |v| (kind, v)));
        let Some((kind, thousandths)) = all.into_iter().nth(unit as usize) else { return Ok(Vec::new()) };
        let (mut sets, mut points) = (0_u32, 0_usize);
        let mut correct = [0_u32; Algorithm::MAIN.len()];
        let mut take = |set: &PointSet| -> Result<(), ExperimentError> {
            sets += 1;
            points += set.paths.iter().map(|(_, points)| points.len()).sum::<usize>();
            for (total, right) in correct.iter_mut().zip(set.correct(&Algorithm::MAIN)?) {
                *total += u32::from(right);
            }
            Ok(())
        };
        match (kind, &self.curve, &self.given) {
            (Samples::Ours, Some(curve), _) => {
                for start in 0..self.grid.starts {
                    let epsilon = f64::from(thousandths) / 1000.0;
                    take(&self.sample(curve, epsilon, f64::from(start) / f64::from(self.grid.starts))?)?;
                }
            }
            (Samples::Given, _, Some(given)) => {
                for (_, set) in given.sets.iter().filter(|(value, _)| *value == thousandths) {
                    take(set)?;
                }
            }
            _ => {}
        }
        let mut findings = vec![Finding::new("sets", f64::from(sets)), Finding::new("points", points as f64)];
        findings.extend(
            Algorithm::MAIN.iter().zip(correct).map(|(algorithm, n)| Finding::new(algorithm.name(), f64::from(n))),
        );
        Ok(findings)
    }

    /// The findings of all units, sorted out.
    pub(crate) fn columns(&self, findings: &[Vec<Finding>]) -> Result<Vec<Column>, ExperimentError> {
        let mut rest = findings.iter();
        let mut columns = Vec::new();
        for (kind, thousandths) in self.kinds() {
            let (label, key) = match kind {
                Samples::Ours => {
                    let name = self.curve.as_ref().map_or("", |curve| &curve.name);
                    (format!("true ε-samples of {name}"), "ours")
                }
                Samples::Given => (format!("sets of {}", self.given.as_ref().map_or("", |given| &given.name)), "given"),
            };
            let mut column = Column {
                label,
                key,
                sets: Vec::new(),
                points: 0.0,
                correct: vec![Vec::new(); Algorithm::MAIN.len()],
                thousandths,
            };
            for found in rest.by_ref().take(column.thousandths.len()) {
                column.sets.push(value(found, "sets")?);
                column.points += value(found, "points")?;
                for (algorithm, counts) in Algorithm::MAIN.iter().zip(&mut column.correct) {
                    counts.push(value(found, algorithm.name())?);
                }
            }
            columns.push(column);
        }
        Ok(columns)
    }

    /// The curve, if there is one.
    pub const fn curve(&self) -> Option<&Source> {
        self.curve.as_ref()
    }
}

impl Column {
    /// Share of correct runs of an algorithm (by its place in [`Algorithm::MAIN`]) over the whole grid, in percent.
    pub fn valid(&self, algorithm: usize) -> f64 {
        let all: f64 = self.sets.iter().sum();
        100.0 * self.correct.get(algorithm).map_or(0.0, |counts| counts.iter().sum::<f64>()) / all.max(1.0)
    }

    /// The smallest ε, in thousandths, at which some run is wrong.
    pub fn upper(&self, algorithm: usize) -> Option<u32> {
        let counts = self.correct.get(algorithm)?.iter().zip(&self.sets);
        counts.zip(&self.thousandths).find(|((correct, sets), _)| correct < sets).map(|(_, value)| *value)
    }

    /// The largest ε, in thousandths, at which some run is correct.
    pub fn top(&self, algorithm: usize) -> Option<u32> {
        let counts = self.correct.get(algorithm)?.iter().zip(&self.thousandths);
        counts.rev().find(|(correct, _)| **correct > 0.0).map(|(_, value)| *value)
    }

    /// Share of correct runs at each ε, in percent.
    pub fn success(&self, algorithm: usize) -> Vec<[f64; 2]> {
        let counts = self.correct.get(algorithm).into_iter().flatten().zip(&self.sets).zip(&self.thousandths);
        counts.map(|((correct, sets), value)| [f64::from(*value) / 1000.0, 100.0 * correct / sets.max(1.0)]).collect()
    }
}

/// What a table calls an ε in thousandths.
pub(crate) fn shown(value: Option<u32>, none: &str) -> String {
    value.map_or_else(|| none.to_owned(), |v| format!("{:.1$}", f64::from(v) / 1000.0, if v % 10 == 0 { 2 } else { 3 }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(closed: bool, points: &[[f64; 2]]) -> PointSet {
        PointSet { paths: vec![(closed, points.iter().map(|[x, y]| Point::new(*x, *y)).collect())] }
    }

    #[test]
    fn true_edges() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        assert_eq!(set(true, &square).edges(), [(0, 1), (0, 3), (1, 2), (2, 3)], "closed");
        assert_eq!(set(false, &square).edges(), [(0, 1), (1, 2), (2, 3)], "open");
        assert_eq!(set(true, &[[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]).edges(), [(0, 1)], "equal points are one");
    }

    #[test]
    fn reading_sets() {
        let given = GivenSets::read("set 0 0 2\n0 0\n1 0\nset 49 7 1\n2 2\n", "x").expect("sets");
        assert_eq!(given.sets.len(), 2, "two sets");
        assert_eq!(given.sets[1].0, 990, "ε in thousandths");
        let error = |text| GivenSets::read(text, "x").expect_err("wrong").to_string();
        assert_eq!(error("set 0 0 2\n0 0\n"), "x: line 3: the last set is incomplete");
        assert_eq!(error("0 0\n"), "x: line 1: “set E O N” is expected here");
        assert_eq!(error("set 0 0 1\n0 a\n"), "x: line 2: “x y” is expected here");
        assert_eq!(error("set 60 0 1\n0 0\n"), "x: line 1: ε is 0.50 + E/100, so E is at most 49");
        assert_eq!(error(""), "x: line 1: there is no set in it");
    }

    #[test]
    fn bounds_of_a_column() {
        let column = Column {
            label: String::new(),
            key: "ours",
            thousandths: vec![50, 51, 52, 53],
            sets: vec![10.0; 4],
            points: 0.0,
            correct: vec![vec![10.0, 9.0, 10.0, 0.0], vec![0.0; 4], vec![10.0; 4]],
        };
        assert_eq!((column.valid(0), column.upper(0), column.top(0)), (72.5, Some(51), Some(52)), "some");
        assert_eq!((column.valid(1), column.upper(1), column.top(1)), (0.0, Some(50), None), "none");
        assert_eq!((column.valid(2), column.upper(2), column.top(2)), (100.0, None, Some(53)), "all");
    }
}
