//! Sampling, meshing and simulating a curve at one density: what Table 4 and Figures 10, 12 and 13 are made of.
//!
//! **Protocol.** Lengths are in diagonals of the control points. The rectangle is the box of the curves with a tenth of its
//! width and height on each side, the same for all densities (the prototype's changes with the density, so that its columns
//! are not about one problem). −Δu = 1, u = 0 on all lines and on the rectangle. The reference is the uniform mesh of
//! density 0.005. The error of a mesh is the root of the mean square of its difference from the reference, over the
//! reference's vertices weighted by their areas, in percent of the greatest value of the reference.
//!
//! Samples: ε = 1, d_min = 0.01, d_max = 0.1, as the paper has them. The paper's density d is the longest edge of *uniform*
//! meshes and d_max of the samples of *nonuniform* ones, whose triangles have no longest edge. *Graded* meshes have
//! the paper's samples, and sizes by lfs, nowhere above d.

use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::Point;
use feature_sampling::medial::Resolution;
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::{Condition, SamplingOptions};
use lineart::drawing::DrawingPath;
use lineart::mesh::drawn::{Drawn, Grading, noding, sampled};
use lineart::mesh::{Mesh, Options, Size, mesh};
use lineart::simulate::{Problem, Simulation, Solution};

use crate::ExperimentError;
use crate::clock::Clock;
use crate::source::Source;

/// The paper's sampling densities.
pub const DENSITIES: [f64; 6] = [0.1, 0.05, 0.03, 0.02, 0.015, 0.01];

/// The density of the reference.
const REFERENCE: f64 = 0.005;

/// The paper's bounds for meshing, in diagonals.
const D_MIN: f64 = 0.01;
const D_MAX: f64 = 0.1;

/// lfs is wanted to this.
const TOLERANCE: f64 = 0.01;

/// Joints that turn by less are smooth, in degrees: the program's default.
const CORNER_DEGREES: f64 = 1.0;

/// How triangles get their sizes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// No edge longer than the density.
    Uniform,
    /// No bound but the smallest angle; samples no farther apart than the density.
    Nonuniform,
    /// By lfs and the distance from the curves, no edge longer than the density.
    Graded,
}

impl Mode {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Uniform, Self::Nonuniform, Self::Graded];

    /// Its name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Nonuniform => "nonuniform",
            Self::Graded => "graded",
        }
    }
}

/// A curve ready to be meshed.
pub struct Subject {
    name: String,
    paths: Vec<DrawingPath>,
    curve: CurveModel<f64>,
    medial: MedialModel<f64>,
    /// Seconds that model and medial axis took.
    pub seconds: f64,
}

/// A mesh, with the seconds that sampling (with noding) and meshing took.
pub struct Meshed {
    /// The lines.
    pub drawn: Drawn,
    /// The triangles.
    pub mesh: Mesh,
    /// Seconds for samples and noding, without [`Subject::seconds`].
    pub sampling: f64,
    /// Seconds for the mesh.
    pub meshing: f64,
}

impl Subject {
    /// Computes the medial axis of a curve.
    ///
    /// # Errors
    /// Names the curve and the cause.
    pub fn new(source: &Source) -> Result<Self, ExperimentError> {
        let clock = Clock::start();
        let curve = source.model::<f64>(CORNER_DEGREES)?;
        let medial = MedialModel::new(&curve, &Resolution::Tolerance(TOLERANCE));
        let path = |(closed, cubics): &(bool, Vec<Cubic<f64>>)| DrawingPath {
            closed: *closed,
            cubics: cubics.clone(),
            ..DrawingPath::default()
        };
        let paths = source.paths.iter().map(path).collect();
        Ok(Self { name: source.name.clone(), paths, curve, medial, seconds: clock.seconds() })
    }

    fn failed(&self, error: impl std::fmt::Display) -> ExperimentError {
        ExperimentError::new(format!("{}: {error}", self.name))
    }

    /// The diagonal of the control points.
    pub fn diagonal(&self) -> f64 {
        *self.curve.diagonal()
    }

    /// The mesh of a density.
    ///
    /// # Errors
    /// Names the curve and the cause.
    pub fn mesh(&self, mode: Mode, density: f64) -> Result<Meshed, ExperimentError> {
        let diagonal = self.diagonal();
        let most = if mode == Mode::Nonuniform { density } else { D_MAX };
        let options = SamplingOptions {
            condition: Condition::Epsilon(1.0),
            min_distance: Some(D_MIN.min(most) * diagonal),
            max_distance: Some(most * diagonal),
            tolerance: TOLERANCE,
            ..SamplingOptions::default()
        };
        let clock = Clock::start();
        let rows = sampled(&self.paths, &self.curve, &self.medial, &options).map_err(|e| self.failed(e))?;
        let noding = noding(diagonal, options.min_distance);
        let drawn = Drawn::new(&self.paths, &rows, &noding).map_err(|e| self.failed(e))?;
        let sampling = clock.seconds();
        let clock = Clock::start();
        let size = match mode {
            Mode::Uniform => Size::Uniform(density * diagonal),
            Mode::Nonuniform => Size::Unbounded,
            Mode::Graded => drawn.graded(density * diagonal, &Grading::default()),
        };
        let outcome = mesh(&drawn.lines(), &drawn.frame, &Options { size, ..Options::default() });
        let outcome = outcome.map_err(|e| self.failed(e))?;
        if outcome.capped {
            return Err(self.failed("the mesh has too many vertices"));
        }
        Ok(Meshed { mesh: outcome.mesh, meshing: clock.seconds(), drawn, sampling })
    }

    /// −Δu = 1, u = 0 along all lines, and how many seconds it took: matrix, factor and solution, the least of several.
    ///
    /// # Errors
    /// Names the curve and the cause.
    pub fn solve(&self, meshed: &Meshed, rounds: u32) -> Result<(Solution, f64), ExperimentError> {
        let given = meshed.drawn.given(&meshed.mesh, |_| Some(0.0), Some(0.0));
        let problem = Problem { source: 1.0, unit: self.diagonal(), given: &given };
        let mut least = f64::INFINITY;
        let mut solution = None;
        for _ in 0..rounds.max(1) {
            let clock = Clock::start();
            let solved = Simulation::new(&meshed.mesh, &given).and_then(|simulation| simulation.solve(&problem));
            solution = Some(solved.map_err(|e| self.failed(e))?);
            least = least.min(clock.seconds());
        }
        solution.map(|solution| (solution, least)).ok_or_else(|| self.failed("nothing was solved"))
    }
}

/// A reference solution that others are compared with.
pub struct Reference {
    points: Vec<Point<f64>>,
    values: Vec<f64>,
    areas: Vec<f64>,
    greatest: f64,
    grid: Grid,
}

impl Reference {
    /// The uniform mesh of density 0.005; `coarse` takes 0.02.
    ///
    /// # Errors
    /// Names the curve and the cause.
    pub fn new(subject: &Subject, coarse: bool) -> Result<Self, ExperimentError> {
        let meshed = subject.mesh(Mode::Uniform, if coarse { 4.0 * REFERENCE } else { REFERENCE })?;
        let (solution, _) = subject.solve(&meshed, 1)?;
        let mesh = meshed.mesh;
        let mut areas = vec![0.0; mesh.points.len()];
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|v| mesh.points[v as usize]);
            let third = b.minus(&a).cross(&c.minus(&a)) / 6.0;
            triangle.iter().for_each(|&v| areas[v as usize] += third);
        }
        let grid = Grid::new(&mesh.points);
        Ok(Self { grid, areas, greatest: solution.greatest, values: solution.values, points: mesh.points })
    }

    /// The error of another solution, in percent of the greatest value.
    pub fn error(&self, mesh: &Mesh, values: &[f64]) -> f64 {
        let mut there = vec![f64::NAN; self.points.len()];
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|v| mesh.points[v as usize]);
            let [u, v, w] = triangle.map(|v| values[v as usize]);
            let double = b.minus(&a).cross(&c.minus(&a));
            self.grid.near([a, b, c], |i| {
                let p = &self.points[i];
                let [r, s, t] = [(b, c), (c, a), (a, b)].map(|(q, r)| r.minus(&q).cross(&p.minus(&q)) / double);
                // Neighbours agree on their common edge.
                if r.min(s).min(t) >= -1e-9 {
                    there[i] = r * u + s * v + t * w;
                }
            });
        }
        let (mut sum, mut total) = (0.0, 0.0);
        for ((there, value), area) in there.iter().zip(&self.values).zip(&self.areas) {
            // Rounding may leave a vertex on the rectangle's side out; both are 0 there.
            if there.is_finite() {
                sum += area * (there - value).powi(2);
            }
            total += area;
        }
        100.0 * (sum / total).sqrt() / self.greatest
    }
}

/// Points in square cells.
struct Grid {
    low: Point<f64>,
    cell: f64,
    columns: usize,
    rows: usize,
    first: Vec<usize>,
    items: Vec<usize>,
}

impl Grid {
    fn new(points: &[Point<f64>]) -> Self {
        let all = feature_sampling::geometry::Aabb::around(points);
        let extent = all.extent();
        let cell = 2.0 * (extent.x * extent.y / points.len().max(1) as f64).sqrt();
        let mut grid = Self { low: all.min, cell, columns: 0, rows: 0, first: Vec::new(), items: Vec::new() };
        [grid.columns, grid.rows] = grid.cell_of(all.max).map(|n| n + 1);
        let number = |grid: &Self, p: &Point<f64>| {
            let [x, y] = grid.cell_of(*p);
            y * grid.columns + x
        };
        let mut first = vec![0; grid.columns * grid.rows + 1];
        points.iter().for_each(|p| first[number(&grid, p) + 1] += 1);
        for i in 0..grid.columns * grid.rows {
            first[i + 1] += first[i];
        }
        let mut items: Vec<usize> = (0..points.len()).collect();
        items.sort_by_key(|&i| number(&grid, &points[i]));
        Self { first, items, ..grid }
    }

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small number of cells")]
    fn cell_of(&self, p: Point<f64>) -> [usize; 2] {
        [p.x - self.low.x, p.y - self.low.y].map(|along| (along / self.cell).max(0.0) as usize)
    }

    /// Every point in the cells that the box of a triangle meets.
    fn near(&self, corners: [Point<f64>; 3], mut each: impl FnMut(usize)) {
        let all = feature_sampling::geometry::Aabb::around(&corners);
        let ([x0, y0], [x1, y1]) = (self.cell_of(all.min), self.cell_of(all.max));
        for y in y0..=y1.min(self.rows - 1) {
            let row = y * self.columns;
            let last = x1.min(self.columns - 1);
            if x0 <= last {
                self.items[self.first[row + x0]..self.first[row + last + 1]].iter().copied().for_each(&mut each);
            }
        }
    }
}
