//! −Δu = f on a mesh, with u given along lines.
//!
//! The paper's third step (Section 5.2): the Poisson problem in linear elements, whose matrix has the cotangents of the
//! mesh (Pinkall and Polthier 1993). The source f is a constant, lumped at the vertices: a third of the area around each.
//! One code serves the membrane under load and steady heat with sources (f = 1), and with f = 0 everything that interpolates
//! as smoothly as possible: Laplace, diffusion curves, soap films of small slope.
//!
//! ```text
//! K u = M f,   K_ij = −½ (cot α_ij + cot β_ij),   K_ii = −Σ_j K_ij
//! ```
//!
//! α and β are the angles opposite to the edge ij. Rows of vertices whose value is given are taken out, with their values on
//! the right-hand side; what is left is symmetric and positive definite if every part of the mesh has a given value. Along
//! an edge of a Delaunay mesh α + β ≤ 180°, so no off-diagonal is positive and u obeys the maximum principle: with f ≥ 0 it
//! is nowhere below the least given value.
//!
//! **Units.** K does not depend on the scale, M does: lengths are measured in the [`Problem::unit`], by default the
//! diagonal of the drawing, so that u does not depend on the drawing's units either.
//!
//! ```
//! use lineart::mesh::{Lines, Options, Size, mesh};
//! use lineart::simulate::{Problem, Simulation};
//! use feature_sampling::geometry::{Aabb, Point};
//!
//! // A square with nothing in it, held at 0 along its sides.
//! let frame = Aabb { min: Point::new(0.0, 0.0), max: Point::new(1.0, 1.0) };
//! let options = Options { size: Size::Uniform(0.05), ..Options::default() };
//! let mesh = mesh(&Lines { points: &[], edges: &[] }, &frame, &options)?.mesh;
//! let mut given = vec![None; mesh.points.len()];
//! mesh.borders.iter().flat_map(|border| border.ends).for_each(|v| given[v as usize] = Some(0.0));
//! let simulation = Simulation::new(&mesh, &given)?;
//! let solution = simulation.solve(&Problem { source: 1.0, unit: 1.0, given: &given })?;
//! // The exact maximum is 0.0736713….
//! assert!((solution.greatest - 0.073_671).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cholesky;
pub mod contour;
mod dissect;

use std::fmt;

use crate::mesh::Mesh;

use self::cholesky::{Factor, Matrix, NotDefinite, Plan};
use self::dissect::Graph;

/// What is asked.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a> {
    /// f, constant.
    pub source: f64,
    /// Lengths are measured in it; in the mesh's coordinates.
    pub unit: f64,
    /// u where it is given, for each vertex.
    pub given: &'a [Option<f64>],
}

/// A mesh with the vertices whose values are given: assembled and factored, ready for values and sources.
#[derive(Clone, Debug)]
pub struct Simulation {
    /// The unknown of each vertex; `None` where the value is given.
    unknown_of: Vec<Option<u32>>,
    /// K among the unknowns.
    stiffness: Matrix,
    /// K between unknowns and given vertices: unknown, vertex, entry.
    coupling: Vec<(u32, u32, f64)>,
    /// K between given vertices, for the energy; each pair once, and diagonals.
    among_given: Vec<(u32, u32, f64)>,
    /// A third of the area around each vertex, in coordinates.
    areas: Vec<f64>,
    plan: Plan,
    factor: Factor,
}

/// The answer, and how good it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// u at each vertex.
    pub values: Vec<f64>,
    /// ½ ∫ |∇u|².
    pub dirichlet_energy: f64,
    /// ½ ∫ |∇u|² − ∫ f u, what the solution makes least.
    pub energy: f64,
    /// The least value.
    pub least: f64,
    /// The greatest value.
    pub greatest: f64,
    /// ‖K u − b‖∞ / ‖b‖∞ over the unknowns (absolute where b = 0).
    pub residual: f64,
    /// How many values were not given.
    pub unknowns: usize,
}

/// What cannot be solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SimulateError {
    /// There are more or fewer given values than vertices.
    Count,
    /// A given value, the source or the unit is not a finite number.
    NotFinite,
    /// Nothing holds the values around this vertex: a part of the mesh has no given value.
    Loose {
        /// Its index.
        vertex: usize,
    },
    /// A triangle has no area.
    Flat {
        /// Its index.
        triangle: usize,
    },
    /// The vertices with given values are not those that were factored for.
    OtherVertices,
}

impl fmt::Display for SimulateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count => f.write_str("every vertex needs a given value or none"),
            Self::NotFinite => f.write_str("values, source and unit are finite numbers"),
            Self::Loose { vertex } => write!(f, "no value is given that reaches vertex {vertex}"),
            Self::Flat { triangle } => write!(f, "triangle {triangle} has no area"),
            Self::OtherVertices => f.write_str("values are given at other vertices than before"),
        }
    }
}

impl std::error::Error for SimulateError {}

impl Simulation {
    /// Assembles and factors. Only *where* `given` has values matters here.
    ///
    /// # Errors
    /// See [`SimulateError`].
    pub fn new(mesh: &Mesh, given: &[Option<f64>]) -> Result<Self, SimulateError> {
        if given.len() != mesh.points.len() {
            return Err(SimulateError::Count);
        }
        let mut count = 0;
        let number = |value: &Option<f64>| {
            value.is_none().then(|| {
                count += 1;
                count - 1
            })
        };
        let unknown_of: Vec<Option<u32>> = given.iter().map(number).collect();
        let (entries, diagonal, areas) = assemble(mesh)?;

        let unknowns: Vec<u32> = (0..).zip(given).filter(|(_, value)| value.is_none()).map(|(v, _)| v).collect();
        let places: Vec<_> = unknowns.iter().map(|&v| mesh.points[v as usize]).collect();
        let mut stiffness = Matrix {
            graph: Graph { first: vec![0; unknowns.len() + 1], to: Vec::new() },
            diagonal: unknowns.iter().map(|&v| diagonal[v as usize]).collect(),
            beside: Vec::new(),
        };
        let (mut pairs, mut coupling, mut among_given) = (Vec::new(), Vec::new(), Vec::new());
        for &(a, b, value) in &entries {
            match (unknown_of[a as usize], unknown_of[b as usize]) {
                (Some(i), Some(j)) => pairs.extend([(i, j, value), (j, i, value)]),
                (Some(i), None) => coupling.push((i, b, value)),
                (None, Some(j)) => coupling.push((j, a, value)),
                (None, None) => among_given.push((a, b, value)),
            }
        }
        let fixed = (0_u32..).zip(given).filter(|(_, value)| value.is_some());
        among_given.extend(fixed.map(|(v, _)| (v, v, diagonal[v as usize])));
        pairs.sort_unstable_by_key(|&(i, j, _)| (i, j));
        for &(i, j, value) in &pairs {
            stiffness.graph.first[i as usize + 1] += 1;
            stiffness.graph.to.push(j);
            stiffness.beside.push(value);
        }
        for i in 0..unknowns.len() {
            stiffness.graph.first[i + 1] += stiffness.graph.first[i];
        }
        if let Some(unknown) = loose(&stiffness.graph, &coupling) {
            return Err(SimulateError::Loose { vertex: unknowns[unknown] as usize });
        }
        let plan = Plan::new(&stiffness.graph, &places);
        let factor = plan
            .factor(&stiffness)
            .map_err(|NotDefinite { unknown }| SimulateError::Loose { vertex: unknowns[unknown] as usize })?;
        Ok(Self { unknown_of, stiffness, coupling, among_given, areas, plan, factor })
    }

    /// Entries of the Cholesky factor, for those who want to know the cost.
    pub fn factor_entries(&self) -> usize {
        self.plan.entries()
    }

    /// The areas that belong to the vertices: a third of each triangle around, in coordinates.
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// Solves for values and a source.
    ///
    /// # Errors
    /// See [`SimulateError`].
    pub fn solve(&self, problem: &Problem<'_>) -> Result<Solution, SimulateError> {
        let Problem { source, unit, given } = *problem;
        if given.len() != self.unknown_of.len() {
            return Err(SimulateError::Count);
        }
        if given.iter().zip(&self.unknown_of).any(|(value, unknown)| value.is_some() == unknown.is_some()) {
            return Err(SimulateError::OtherVertices);
        }
        let finite = source.is_finite() && unit.is_finite() && given.iter().flatten().all(|value| value.is_finite());
        if !finite || unit <= 0.0 {
            return Err(SimulateError::NotFinite);
        }
        let load: Vec<f64> = self.areas.iter().map(|area| source * (area / unit / unit)).collect();
        let mut right = vec![0.0; self.stiffness.diagonal.len()];
        for (unknown, load) in self.unknown_of.iter().zip(&load) {
            if let Some(i) = unknown {
                right[*i as usize] = *load;
            }
        }
        for &(i, vertex, value) in &self.coupling {
            right[i as usize] -= value * given[vertex as usize].unwrap_or(0.0);
        }
        let mut found = self.plan.solve(&self.factor, &right);
        // One step of refinement: what rounding left over is solved for as well.
        let rest: Vec<f64> = right.iter().zip(self.stiffness.times(&found)).map(|(b, ku)| b - ku).collect();
        for (value, step) in found.iter_mut().zip(self.plan.solve(&self.factor, &rest)) {
            *value += step;
        }
        let product = self.stiffness.times(&found);
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0_f64, |worst, v| worst.max(v.abs()));
        let scale = largest(&mut right.iter().copied());
        let error = largest(&mut right.iter().zip(&product).map(|(b, ku)| b - ku));
        let residual = if scale > 0.0 { error / scale } else { error };

        let value = |(unknown, given): (&Option<u32>, &Option<f64>)| match (unknown, given) {
            (Some(i), _) => found[*i as usize],
            (None, Some(value)) => *value,
            (None, None) => f64::NAN,
        };
        let values: Vec<f64> = self.unknown_of.iter().zip(given).map(value).collect();
        let quadratic: f64 = found.iter().zip(&product).map(|(u, ku)| u * ku).sum();
        let mixed: f64 = self.coupling.iter().map(|&(i, v, k)| 2.0 * found[i as usize] * k * values[v as usize]).sum();
        let twice = |a: u32, b: u32| if a == b { 1.0 } else { 2.0 };
        let fixed: f64 =
            self.among_given.iter().map(|&(a, b, k)| twice(a, b) * values[a as usize] * k * values[b as usize]).sum();
        let dirichlet_energy = 0.5 * (quadratic + mixed + fixed);
        let work: f64 = values.iter().zip(&load).map(|(u, load)| u * load).sum();
        Ok(Solution {
            dirichlet_energy,
            energy: dirichlet_energy - work,
            least: values.iter().copied().fold(f64::INFINITY, f64::min),
            greatest: values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            residual,
            unknowns: found.len(),
            values,
        })
    }
}

/// Entries beside the diagonal (a < b, each pair once), the diagonal, and the areas of the vertices.
type Assembled = (Vec<(u32, u32, f64)>, Vec<f64>, Vec<f64>);

fn assemble(mesh: &Mesh) -> Result<Assembled, SimulateError> {
    let mut parts: Vec<(u32, u32, f64)> = Vec::with_capacity(3 * mesh.triangles.len());
    let mut diagonal = vec![0.0; mesh.points.len()];
    let mut areas = vec![0.0; mesh.points.len()];
    for (index, triangle) in mesh.triangles.iter().enumerate() {
        let p = triangle.map(|v| mesh.points[v as usize]);
        let double = p[1].minus(&p[0]).cross(&p[2].minus(&p[0]));
        if double.is_nan() || double <= 0.0 {
            return Err(SimulateError::Flat { triangle: index });
        }
        for i in 0..3 {
            let [a, b, c] = [i, (i + 1) % 3, (i + 2) % 3];
            let half_cotangent = 0.5 * p[a].minus(&p[c]).dot(&p[b].minus(&p[c])) / double;
            let (from, to) = (triangle[a], triangle[b]);
            parts.push((from.min(to), from.max(to), -half_cotangent));
            diagonal[from as usize] += half_cotangent;
            diagonal[to as usize] += half_cotangent;
            areas[triangle[i] as usize] += double / 6.0;
        }
    }
    // Stable: the two halves of an edge are added in the order of their triangles.
    parts.sort_by_key(|&(a, b, _)| (a, b));
    parts.dedup_by(|second, first| {
        let same = (first.0, first.1) == (second.0, second.1);
        if same {
            first.2 += second.2;
        }
        same
    });
    Ok((parts, diagonal, areas))
}

/// An unknown that no path of the graph joins to a given value.
fn loose(graph: &Graph, coupling: &[(u32, u32, f64)]) -> Option<usize> {
    let mut held = vec![false; graph.first.len() - 1];
    let mut stack: Vec<u32> = coupling.iter().map(|&(i, ..)| i).collect();
    while let Some(i) = stack.pop() {
        if !std::mem::replace(&mut held[i as usize], true) {
            stack.extend(graph.neighbours(i as usize).iter().filter(|&&j| !held[j as usize]));
        }
    }
    held.iter().position(|held| !held)
}
