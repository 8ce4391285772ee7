//! From a sampled drawing to what is meshed: lines, the rectangle, sizes, given values.
//!
//! The chains of samples are noded ([`crate::node`]): crossings, T-junctions, overlaps and copies become shared vertices
//! and lines. Each line remembers the path it is a piece of, with parameters, so that values can be given along paths and
//! triangles can be bent to the curve again ([`super::curved`]).
//!
//! Where nothing had to be cut or merged, vertices are the samples to the bit; else they are points of the noder's lattice,
//! at most its pitch away ([`noding`]).

use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::{Aabb, Point};
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::{SamplingError, SamplingOptions};

use super::opening;
use super::size::{Graded, Size, Wish};
use super::{Lines, Mesh};
use crate::drawing::DrawingPath;
use crate::export::{PathRows, SampleRow};
use crate::node::{self, Chain, NodeError, Owner, Report, node};

/// How much larger the rectangle is than the drawing, on each side: this share of its width or height.
pub const PADDING: f64 = 0.1;

/// But no less than this share of its diagonal: a single straight stroke has no height.
const LEAST_PADDING: f64 = 0.03;

/// The length c of graded sizes at ends and corners, in diagonals of the rectangle: an end of a stroke asks for d²/c. Larger
/// ones gain on drawings with few ends and lose on those with many; found by experiment, as above.
pub const GRADED_SCALE: f64 = 1.0 / 14.0;

/// What lfs counts unless it is said.
pub const LFS_FACTOR: f64 = 16.0;

/// How graded sizes follow the drawing. The values by default are those at which the error of the Poisson problem is least for
/// the number of triangles, by experiment (`fsample reproduce figure10`); smaller ones make more of the details.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grading {
    /// What lfs counts: a triangle at a sample may be as large as its lfs, times this. `None`, the default, is 16 times, but no less
    /// than the end of a stroke asks for: what is smaller costs more triangles than it repays.
    pub lfs_factor: Option<f64>,
    /// What a unit of distance adds. 2 by default.
    pub growth: f64,
}

impl Default for Grading {
    fn default() -> Self {
        Self { lfs_factor: None, growth: 2.0 }
    }
}

/// How lines are noded for meshing: the pitch is a hundred-thousandth of the diagonal, or a hundredth of the smallest distance
/// of samples if that is more. Ten times the noder's own default: between two strokes that run beside each other at a pitch,
/// fair triangles are as small as the pitch, and there are as many of them as the strokes are long.
pub fn noding(diagonal: f64, min_distance: Option<f64>) -> node::Options {
    node::Options::new((1e-5 * diagonal).max(min_distance.unwrap_or(0.0) / 100.0))
}

/// A drawing as lines in a rectangle.
#[derive(Clone, Debug, Default)]
pub struct Drawn {
    /// Vertices of the lines.
    pub points: Vec<Point<f64>>,
    /// The lines.
    pub edges: Vec<[u32; 2]>,
    /// For each line the first path that it is a piece of, with the parameters at its ends.
    pub owners: Vec<Owner>,
    /// Every path that each line is a piece of.
    all_owners: Vec<Vec<u32>>,
    /// The rectangle.
    pub frame: Aabb<f64>,
    /// What samples ask of sizes: lfs, but no less than the shorter gap beside them; in user units.
    pub wishes: Vec<Wish>,
    /// What noding did.
    pub report: Report,
}

impl Drawn {
    /// Nodes samples. Rows are by path, as many as there are paths.
    ///
    /// # Errors
    /// Those of [`node()`].
    pub fn new(
        paths: &[DrawingPath],
        samples: &[PathRows<SampleRow>],
        options: &node::Options,
    ) -> Result<Self, NodeError> {
        let noded = node(paths, &Chain::of_samples(samples), options)?;
        let report = noded.report;
        let untouched = report.crossings + report.vertices_added + report.segments_merged == 0;
        let point = |vertex: &node::Vertex| if untouched { vertex.exact } else { vertex.point };
        let points: Vec<Point<f64>> = noded.vertices.iter().map(point).collect();
        let owners = noded.edges.iter().filter_map(|edge| noded.owners(edge).first().copied()).collect();
        let paths_of = |edge| {
            let mut paths: Vec<u32> = noded.owners(edge).iter().map(|owner| owner.path).collect();
            paths.sort_unstable();
            paths.dedup();
            paths
        };
        Ok(Self {
            edges: noded.edges.iter().map(|edge| edge.ends).collect(),
            owners,
            all_owners: noded.edges.iter().map(paths_of).collect(),
            frame: frame(paths, &points),
            wishes: samples.iter().flat_map(wishes).collect(),
            points,
            report,
        })
    }

    /// The lines.
    pub fn lines(&self) -> Lines<'_> {
        Lines { points: &self.points, edges: &self.edges }
    }

    /// The path of each line.
    pub fn path_of(&self) -> Vec<u32> {
        self.owners.iter().map(|owner| owner.path).collect()
    }

    /// The graded size, nowhere above `largest`: by lfs, by ends and corners ([`GRADED_SCALE`]), and by the distance from both.
    pub fn graded(&self, largest: f64, grading: &Grading) -> Size {
        let scale = GRADED_SCALE * self.frame.extent().norm();
        let mut wishes = opening::wishes(&self.points, &self.edges, largest, scale);
        let (factor, least) = match grading.lfs_factor {
            Some(factor) => (factor, 0.0),
            None => (LFS_FACTOR, opening::at_an_end(largest, scale)),
        };
        let by_lfs = |wish: &Wish| Wish { size: (factor * wish.size).max(least), ..*wish };
        wishes.extend(self.wishes.iter().map(by_lfs));
        Size::Graded(Graded::new(wishes, largest, grading.growth))
    }

    /// The values that are given at the vertices of a mesh of these lines: along paths, `of_path` by their index; along the
    /// rectangle, `frame`. Where paths of different values meet it is their mean.
    pub fn given(&self, mesh: &Mesh, of_path: impl Fn(u32) -> Option<f64>, frame: Option<f64>) -> Vec<Option<f64>> {
        let mut at: Vec<(u32, u32)> = Vec::new();
        let mut given = vec![None; mesh.points.len()];
        for border in &mesh.borders {
            match border.line.and_then(|line| self.all_owners.get(line as usize)) {
                Some(paths) => at.extend(paths.iter().flat_map(|&path| border.ends.map(|vertex| (vertex, path)))),
                None => border.ends.into_iter().for_each(|vertex| given[vertex as usize] = frame),
            }
        }
        at.sort_unstable();
        at.dedup();
        for here in at.chunk_by(|a, b| a.0 == b.0) {
            let values: Vec<f64> = here.iter().filter_map(|&(_, path)| of_path(path)).collect();
            if let Some(&first) = values.first() {
                let same = values.iter().all(|value| *value == first);
                let mean = values.iter().sum::<f64>() / values.len() as f64;
                given[here[0].0 as usize] = Some(if same { first } else { mean });
            }
        }
        given
    }
}

/// Samples of a drawing as rows by path, without the names of the bounds that decided them.
///
/// # Errors
/// Those of the sampler.
pub fn sampled(
    paths: &[DrawingPath],
    curve: &CurveModel<f64>,
    medial: &MedialModel<f64>,
    options: &SamplingOptions<f64>,
) -> Result<Vec<PathRows<SampleRow>>, SamplingError> {
    let empty = |path: &DrawingPath| PathRows { closed: path.closed, rows: Vec::new() };
    let mut out: Vec<PathRows<SampleRow>> = paths.iter().map(empty).collect();
    for (index, path) in (0_u32..).zip(curve.curve().paths) {
        let row = |sample: &feature_sampling::sampling::Sample<f64>| {
            let (path, segment, t) = curve.source(&sample.at);
            SampleRow { path, segment, t, x: sample.point.x, y: sample.point.y, lfs: sample.lfs, bound: "" }
        };
        let samples = curve.sample_path(medial, index, options)?;
        if let Some(place) = out.get_mut(path.source as usize) {
            *place = PathRows { closed: path.closed, rows: samples.iter().map(row).collect() };
        }
    }
    Ok(out)
}

/// What the samples of a path ask for.
fn wishes(path: &PathRows<SampleRow>) -> Vec<Wish> {
    let point = |row: &SampleRow| Point::new(row.x, row.y);
    let gap = |a: Option<&SampleRow>, b: Option<&SampleRow>| match a.zip(b) {
        Some((a, b)) => point(a).distance(&point(b)),
        None => f64::INFINITY,
    };
    let rows = &path.rows;
    let count = rows.len();
    let wish = |(i, row): (usize, &SampleRow)| {
        let before = if i > 0 { rows.get(i - 1) } else { rows.last().filter(|_| path.closed && count > 1) };
        let after = if i + 1 < count { rows.get(i + 1) } else { rows.first().filter(|_| path.closed && count > 1) };
        let shorter = gap(before, Some(row)).min(gap(Some(row), after));
        let floor = if shorter.is_finite() { shorter } else { 0.0 };
        Wish { point: point(row), size: row.lfs.max(floor) }
    };
    // A lone sample with no lfs asks for nothing.
    rows.iter().enumerate().map(wish).filter(|wish| wish.size > 0.0).collect()
}

/// The rectangle around the curves and the points.
fn frame(paths: &[DrawingPath], points: &[Point<f64>]) -> Aabb<f64> {
    let mut all = Aabb::around(points);
    for cubic in paths.iter().flat_map(|path| &path.cubics) {
        all.merge(&curve_box(cubic));
    }
    if !all.min.is_finite() {
        // Nothing is drawn: any rectangle will do.
        return Aabb { min: Point::new(0.0, 0.0), max: Point::new(1.0, 1.0) };
    }
    let extent = all.extent();
    // A drawing that is one point still gets a rectangle.
    let least = LEAST_PADDING * extent.norm().max(1e-9 * all.min.x.abs().max(all.min.y.abs()).max(1e-9));
    let (dx, dy) = ((PADDING * extent.x).max(least), (PADDING * extent.y).max(least));
    Aabb { min: Point::new(all.min.x - dx, all.min.y - dy), max: Point::new(all.max.x + dx, all.max.y + dy) }
}

/// The box of a cubic itself, which its control points may leave.
pub fn curve_box(cubic: &Cubic<f64>) -> Aabb<f64> {
    let mut all = Aabb::around([cubic.start(), cubic.end()]);
    let [a, b, c, d] = cubic.points;
    for [p, q, r, s] in [[a.x, b.x, c.x, d.x], [a.y, b.y, c.y, d.y]] {
        // B' / 3 = u (1−t)² + 2 v t (1−t) + w t².
        let (u, v, w) = (q - p, r - q, s - r);
        let (square, half_linear) = (u - 2.0 * v + w, v - u);
        let root = (half_linear * half_linear - square * u).max(0.0).sqrt();
        // Both quotients of the quadratic formula, so that neither root cancels.
        let sum = -(half_linear + root.copysign(half_linear));
        for t in [sum / square, u / sum] {
            // Also false for NaN.
            if t > 0.0 && t < 1.0 {
                all.include(&cubic.eval(&t));
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_box_of_a_cubic_is_tight() {
        let mut seed = 3_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 40) as f64 / f64::from(1 << 20)
        };
        for round in 0..200 {
            let mut cubic = Cubic { points: std::array::from_fn(|_| Point::new(random(), random())) };
            if round % 4 == 0 {
                // Half as high as the parabola's control point.
                cubic = Cubic::quadratic(cubic.points[0], &cubic.points[1], cubic.points[2]);
            }
            let tight = curve_box(&cubic);
            let dense: Vec<_> = (0..=4000).map(|i| cubic.eval(&(f64::from(i) / 4000.0))).collect();
            let seen = Aabb::around(&dense);
            for (a, b) in [(tight.min, seen.min), (tight.max, seen.max)] {
                assert!((a.x - b.x).abs() < 1e-5 && (a.y - b.y).abs() < 1e-5, "{round}: {tight:?} {seen:?}");
            }
        }
    }
}
