//! Triangle meshes around line art.
//!
//! A rectangle around a drawing is cut into triangles such that every line of the drawing is a union of edges: the paper's
//! second application (Section 5.2). Lines come as a planar graph ([`Lines`]): the chains of samples, noded, so that they
//! meet in vertices only.
//!
//! ```text
//! lines ── start      constrained Delaunay triangulation (spade)
//!   │        │
//! size ── refine      Ruppert's algorithm with sizes, by the worst first (queue), on triangles of our own
//!            │
//!         smooth      moves free vertices, only where every bound stays
//! ```
//!
//! **What is promised** of a [`Mesh`]: its triangles run counterclockwise in the coordinates as they are, fill the
//! rectangle and meet in whole edges; every line is a union of edges ([`Mesh::borders`] says which); no edge is longer than
//! the size at its ends; no angle is smaller than the bound, except where two lines meet at a smaller angle, and between two
//! such lines ([`Mesh::excused`] counts them); the edges, lines included, are Delaunay. If the limit on vertices is reached, or something
//! cannot be refined, the [`Outcome`] says so. The same input gives the same bytes.

pub mod curved;
pub mod drawn;
mod opening;
mod queue;
mod refine;
pub mod size;
pub mod smooth;
mod start;
mod triangles;

use std::fmt;

use feature_sampling::geometry::{Aabb, Point};

use self::refine::{Bounds, Excuse, Line, Refinement, Verdict};
pub use self::size::{Graded, Size, Wish};
use self::triangles::{NONE, Triangles, next};

/// The largest smallest angle that can be asked for, in degrees: beyond it refinement does not end in practice.
pub const LARGEST_MIN_ANGLE: f64 = 33.0;

/// The angle that refinement is sure to end with, in degrees: its sine is 1/√8.
pub const DEFAULT_MIN_ANGLE: f64 = 20.7;

/// A planar graph: edges that meet in vertices only. Every edge is a line.
#[derive(Clone, Copy, Debug)]
pub struct Lines<'a> {
    /// Distinct points.
    pub points: &'a [Point<f64>],
    /// Pairs of different indices, each pair once.
    pub edges: &'a [[u32; 2]],
}

/// What triangles have to be like.
#[derive(Clone, Debug)]
pub struct Options {
    /// No angle is smaller, in degrees, from 0 to [`LARGEST_MIN_ANGLE`]; see the module for exceptions.
    pub min_angle: f64,
    /// No edge is longer.
    pub size: Size,
    /// Refinement stops where there are so many vertices.
    pub max_vertices: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { min_angle: DEFAULT_MIN_ANGLE, size: Size::Unbounded, max_vertices: 2_000_000 }
    }
}

/// Triangles that fill a rectangle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertices: first the points of the lines, in their order, then the corners of the rectangle, then those of
    /// refinement.
    pub points: Vec<Point<f64>>,
    /// Corners, counterclockwise in the coordinates as they are (x · y' − y · x' > 0).
    pub triangles: Vec<[u32; 3]>,
    /// The edges that lines and the sides of the rectangle are made of, in the order of the lines.
    pub borders: Vec<Border>,
    /// Triangles with a smaller angle than the bound, as small angles between lines force them.
    pub excused: usize,
}

/// An edge of a mesh that is a piece of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Border {
    /// Index of the line; `None` for the sides of the rectangle.
    pub line: Option<u32>,
    /// Vertices, in the direction of the line.
    pub ends: [u32; 2],
}

/// How a mesh turned out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// The smallest angle, in degrees.
    pub min_angle: f64,
    /// The longest edge.
    pub longest: f64,
    /// The shortest edge.
    pub shortest: f64,
}

impl Mesh {
    /// Angles and lengths over all triangles.
    pub fn quality(&self) -> Quality {
        let mut quality = Quality { min_angle: 60.0, longest: 0.0, shortest: f64::INFINITY };
        for triangle in &self.triangles {
            let p = triangle.map(|v| self.points[v as usize]);
            for i in 0..3 {
                let (u, v) = (p[(i + 1) % 3].minus(&p[i]), p[(i + 2) % 3].minus(&p[i]));
                quality.min_angle = quality.min_angle.min(u.cross(&v).atan2(u.dot(&v)).to_degrees());
                quality.longest = quality.longest.max(u.norm());
                quality.shortest = quality.shortest.min(u.norm());
            }
        }
        quality
    }
}

/// A mesh, and whether it is all that was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The mesh: complete, conforming and Delaunay even where refinement stopped early.
    pub mesh: Mesh,
    /// The limit on vertices was reached while something was still too large or too flat.
    pub capped: bool,
    /// What could not be refined.
    pub unrefined: Vec<Unrefined>,
}

/// A place that could not be refined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unrefined {
    /// The middle of a triangle or of a line.
    pub at: Point<f64>,
    /// Why.
    pub reason: Refused,
}

/// Why something was not refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Refused {
    /// A piece of a line is too short to be split in doubles.
    ShortLine,
    /// The centre of a triangle is nowhere, in doubles.
    Degenerate,
}

/// Lines that cannot be meshed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshError {
    /// This line crosses another one, lies on it, or runs through a vertex: node the lines first.
    NotNoded {
        /// Its index, or 0 where it cannot be told.
        line: u32,
    },
    /// Two points are equal: node the lines first.
    RepeatedPoint,
    /// An edge names a point that does not exist, or one point twice.
    BadEdge {
        /// Its index.
        line: u32,
    },
    /// A point is not strictly inside the rectangle.
    Outside {
        /// Its index.
        point: u32,
    },
    /// A coordinate is not finite, or outside the domain of exact predicates.
    OutOfRange,
    /// The smallest angle or the size is no number that makes sense.
    BadBound,
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotNoded { line } => write!(f, "line {line} meets another one outside of its ends"),
            Self::RepeatedPoint => f.write_str("two vertices are at one place"),
            Self::BadEdge { line } => write!(f, "line {line} has no two ends"),
            Self::Outside { point } => write!(f, "point {point} lies outside of the rectangle"),
            Self::OutOfRange => f.write_str("a coordinate is not finite, or too large or small for exact predicates"),
            Self::BadBound => {
                write!(f, "the smallest angle lies between 0 and {LARGEST_MIN_ANGLE} degrees, lengths are positive")
            }
        }
    }
}

impl std::error::Error for MeshError {}

/// Meshes a rectangle around lines.
///
/// # Errors
/// See [`MeshError`].
pub fn mesh(lines: &Lines<'_>, frame: &Aabb<f64>, options: &Options) -> Result<Outcome, MeshError> {
    check(lines, frame, options)?;
    let triangles = start::triangulate(lines, frame)?;
    let sharp = sharp_ends(&triangles, lines);
    let diagonal = frame.extent().norm();
    let sine = options.min_angle.to_radians().sin();
    let bounds = Bounds {
        sine_sq: sine * sine,
        size: &options.size,
        max_vertices: options.max_vertices,
        // Far below what a noder leaves, far above what rounding does to a point.
        shortest: 1e-11 * diagonal,
    };
    let mut refinement = Refinement::new(triangles, sharp, bounds);
    refinement.run();
    Ok(finish(refinement, lines.edges.len()))
}

fn check(lines: &Lines<'_>, frame: &Aabb<f64>, options: &Options) -> Result<(), MeshError> {
    let sensible = match options.size {
        Size::Uniform(length) => length > 0.0,
        _ => true,
    };
    if !(sensible && (0.0..=LARGEST_MIN_ANGLE).contains(&options.min_angle)) {
        return Err(MeshError::BadBound);
    }
    if !(frame.min.is_finite() && frame.max.is_finite()) {
        return Err(MeshError::OutOfRange);
    }
    if lines.points.len() >= (u32::MAX / 16) as usize || options.max_vertices >= (u32::MAX / 16) as usize {
        return Err(MeshError::BadBound);
    }
    for (p, point) in lines.points.iter().zip(0..) {
        if !p.is_finite() {
            return Err(MeshError::OutOfRange);
        }
        if !(frame.min.x < p.x && p.x < frame.max.x && frame.min.y < p.y && p.y < frame.max.y) {
            return Err(MeshError::Outside { point });
        }
    }
    for (&[a, b], line) in lines.edges.iter().zip(0..) {
        if a == b || a.max(b) as usize >= lines.points.len() {
            return Err(MeshError::BadEdge { line });
        }
    }
    Ok(())
}

/// The lines and the sides of the rectangle, with where they meet others at less than 60°.
fn sharp_ends(triangles: &Triangles, lines: &Lines<'_>) -> Vec<Line> {
    let first = u32::try_from(lines.points.len()).unwrap_or(NONE);
    let sides = [[0, 1], [1, 2], [2, 3], [3, 0]].map(|side: [u32; 2]| side.map(|i| first + i));
    let line = |ends| Line { ends, sharp: [false; 2] };
    let mut all: Vec<Line> = lines.edges.iter().copied().chain(sides).map(line).collect();
    let mut at: Vec<Vec<u32>> = vec![Vec::new(); triangles.points.len()];
    for (line, i) in all.iter().zip(0..) {
        line.ends.iter().for_each(|&end| at[end as usize].push(i));
    }
    for (vertex, here) in (0_u32..).zip(&at) {
        let direction = |i: u32| {
            let [a, b] = all[i as usize].ends;
            let other = if a == vertex { b } else { a };
            triangles.point(other).minus(&triangles.point(vertex))
        };
        let mut by_angle: Vec<(f64, u32)> = here.iter().map(|&i| (direction(i).y.atan2(direction(i).x), i)).collect();
        by_angle.sort_by(|a, b| a.0.total_cmp(&b.0));
        let pairs = by_angle.iter().zip(by_angle.iter().cycle().skip(1));
        let meet: Vec<[u32; 2]> = pairs
            .filter(|(a, b)| {
                let (u, v) = (direction(a.1), direction(b.1));
                // cos > 1/2.
                a.1 != b.1 && u.dot(&v) > 0.5 * (u.norm() * v.norm())
            })
            .map(|(a, b)| [a.1, b.1])
            .collect();
        for i in meet.into_iter().flatten() {
            let line = &mut all[i as usize];
            let end = usize::from(line.ends[1] == vertex);
            line.sharp[end] = true;
        }
    }
    all
}

/// Takes the mesh out of a refinement.
fn finish(refinement: Refinement<'_>, drawn: usize) -> Outcome {
    let mut excused = 0;
    let mut borders = Vec::new();
    let triangles = &refinement.mesh;
    for t in 0..triangles.count() {
        if matches!(refinement.verdict(t), Verdict::Flat(_)) && refinement.excuse(t) != Excuse::None {
            excused += 1;
        }
        for h in [t << 2, t << 2 | 1, t << 2 | 2] {
            let line = triangles.line(h);
            if line == NONE {
                continue;
            }
            let mut ends = [triangles.origin(h), triangles.origin(next(h))];
            let [a, b] = refinement.lines[line as usize].ends.map(|v| triangles.point(v));
            let along = b.minus(&a);
            let place = |v: u32| along.dot(&triangles.point(v).minus(&a));
            if place(ends[0]) > place(ends[1]) {
                // Its other side comes up too, unless it is the frame.
                if triangles.across(h) != NONE {
                    continue;
                }
                ends.reverse();
            }
            borders.push((line, place(ends[0]), ends));
        }
    }
    borders.sort_by(|a, b| (a.0, a.1).partial_cmp(&(b.0, b.1)).unwrap_or(std::cmp::Ordering::Equal));
    let border =
        |(line, _, ends): (u32, f64, [u32; 2])| Border { line: ((line as usize) < drawn).then_some(line), ends };
    let mesh = Mesh {
        triangles: triangles.all.iter().map(|triangle| triangle.corners).collect(),
        borders: borders.into_iter().map(border).collect(),
        excused,
        points: refinement.mesh.points,
    };
    Outcome { mesh, capped: refinement.capped, unrefined: refinement.unrefined }
}

#[cfg(test)]
mod tests;
