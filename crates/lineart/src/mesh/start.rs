//! The first triangulation: the lines and the rectangle, constrained Delaunay, by `spade`.
//!
//! From there on [`super::triangles`] takes over: refinement needs to know which line an edge is a piece of, to split lines
//! at a chosen point, and to look before it inserts, none of which `spade` offers.

use feature_sampling::geometry::{Aabb, Point};
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

use super::triangles::{NONE, Triangle, Triangles};
use super::{Lines, MeshError};

struct Site {
    position: Point2<f64>,
    number: u32,
}

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

/// The lines that the triangulation has: those of the drawing by their index, then the four sides of the rectangle.
pub(super) fn triangulate(lines: &Lines<'_>, frame: &Aabb<f64>) -> Result<Triangles, MeshError> {
    let Aabb { min, max } = *frame;
    let mut points = lines.points.to_vec();
    let first = index(points.len());
    points.extend([min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)]);
    let mut edges: Vec<([u32; 2], u32)> =
        lines.edges.iter().zip(0_u32..).map(|(&[a, b], line)| ([a.min(b), a.max(b)], line)).collect();
    let sides = [[0, 1], [1, 2], [2, 3], [0, 3]].map(|side: [u32; 2]| side.map(|i| first + i));
    let count = index(edges.len());
    edges.extend(sides.iter().zip(count..).map(|(&side, line)| (side, line)));
    edges.sort_unstable();
    if let Some(pair) = edges.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        return Err(MeshError::NotNoded { line: pair[1].1 });
    }

    let site = |(p, number): (&Point<f64>, u32)| Site { position: Point2::new(p.x + 0.0, p.y + 0.0), number };
    let sites: Vec<Site> = points.iter().zip(0_u32..).map(site).collect();
    let constraints = edges.iter().map(|(ends, _)| ends.map(|v| v as usize)).collect();
    let mut conflict = None;
    let cdt: ConstrainedDelaunayTriangulation<Site> =
        ConstrainedDelaunayTriangulation::try_bulk_load_cdt(sites, constraints, |edge| conflict = Some(edge))
            .map_err(|_| MeshError::OutOfRange)?;
    let line_of = |ends: [u32; 2]| {
        let ends = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        edges.binary_search_by(|(other, _)| other.cmp(&ends)).ok().and_then(|at| edges.get(at)).map(|(_, line)| *line)
    };
    if let Some(edge) = conflict {
        let line = line_of(edge.map(index)).unwrap_or(0);
        return Err(MeshError::NotNoded { line });
    }
    if cdt.num_vertices() != points.len() {
        return Err(MeshError::RepeatedPoint);
    }

    let mut out = Triangles::default();
    out.spokes = vec![NONE; points.len()];
    out.points = points;
    let mut found = 0;
    for (face, t) in cdt.inner_faces().zip(0_u32..) {
        let mut triangle = Triangle { corners: [NONE; 3], across: [NONE; 3], lines: [NONE; 3], stamp: 0 };
        for (i, edge) in face.adjacent_edges().into_iter().enumerate() {
            let (from, to) = (edge.from().data().number, edge.to().data().number);
            triangle.corners[i] = from;
            if edge.is_constraint_edge() {
                triangle.lines[i] = line_of([from, to]).ok_or(MeshError::NotNoded { line: 0 })?;
                found += usize::from(from < to || edge.rev().is_outer_edge());
            }
            // Inner faces are numbered from 1, after the outer one, without gaps.
            if let Some(other) = edge.rev().face().as_inner() {
                let place = other.adjacent_edges().iter().position(|e| e.fix() == edge.rev().fix()).unwrap_or(0);
                triangle.across[i] = index(other.index() - 1) << 2 | index(place);
            }
            out.spokes[from as usize] = t << 2 | index(i);
        }
        out.all.push(triangle);
    }
    // A line through a vertex was cut there by the triangulator.
    if found != edges.len() { Err(MeshError::NotNoded { line: 0 }) } else { Ok(out) }
}

fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(NONE)
}
