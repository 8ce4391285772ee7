//! Are the edges of a polyline in the Delaunay triangulation of its points?
//!
//! A mesher that is given the samples of a drawing keeps its lines without further work exactly where they are Delaunay
//! edges already; a dense enough ε-sample has this property and a flattened curve need not. Points are triangulated by
//! `spade` with exact predicates; an edge counts as present if some Delaunay triangulation of the points has it. Several
//! exist where four or more points lie on one empty circle (any regular drawing), and which of them the triangulator
//! finds is chance: that must not count against the edge.
//!
//! **Ties.** If ab is an edge of some Delaunay triangulation but not of ours, then ours has edges crossing it, and two
//! crossing edges that both have an empty circle have all four ends on one circle. So the triangle at a that ab enters
//! has b on its circumcircle. Conversely that circle is empty, so b on it makes ab Delaunay. One exact incircle test for
//! each triangle at a therefore decides.

use std::collections::HashMap;

use feature_sampling::geometry::Point;
use robust::{Coord, incircle};
use spade::handles::{FixedVertexHandle, VertexHandle};
use spade::{DelaunayTriangulation, HasPosition, InsertionError, MIN_ALLOWED_VALUE, Point2, Triangulation};

/// A point with its number among the distinct points.
struct Site {
    position: Point2<f64>,
    number: usize,
}

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

/// How many edges (pairs of indices of `points`) no Delaunay triangulation of all the points has.
///
/// Points may repeat; an edge between two points at one place is never missing. Coordinates below 2^−142 in size count
/// as zero, where the exact predicates' own domain ends.
///
/// # Errors
/// A coordinate is not finite or beyond 2^201.
pub fn missing_edges(points: &[Point<f64>], edges: &[(usize, usize)]) -> Result<usize, InsertionError> {
    let mut numbers: HashMap<[u64; 2], usize> = HashMap::new();
    let mut sites = Vec::new();
    let mut site_of = Vec::with_capacity(points.len());
    for point in points {
        let [x, y] = [point.x, point.y].map(|v| if v.abs() < MIN_ALLOWED_VALUE { 0.0 } else { v });
        let number = *numbers.entry([x.to_bits(), y.to_bits()]).or_insert(sites.len());
        if number == sites.len() {
            sites.push(Site { position: Point2::new(x, y), number });
        }
        site_of.push(number);
    }

    let triangulation = DelaunayTriangulation::<Site>::bulk_load(sites)?;
    let mut handles: Vec<Option<FixedVertexHandle>> = vec![None; triangulation.num_vertices()];
    for vertex in triangulation.vertices() {
        if let Some(handle) = handles.get_mut(vertex.data().number) {
            *handle = Some(vertex.fix());
        }
    }
    let vertex = |point: usize| site_of.get(point).and_then(|&site| handles.get(site).copied().flatten());

    let missing = edges.iter().filter_map(|&(a, b)| vertex(a).zip(vertex(b))).filter(|&(a, b)| {
        a != b
            && triangulation.get_edge_from_neighbors(a, b).is_none()
            && !tied(&triangulation.vertex(a), triangulation.vertex(b).position())
    });
    Ok(missing.count())
}

/// A triangle at this vertex has `other` on its circumcircle.
fn tied(vertex: &VertexHandle<'_, Site>, other: Point2<f64>) -> bool {
    let coord = |p: Point2<f64>| Coord { x: p.x, y: p.y };
    vertex.out_edges().filter_map(|edge| edge.face().as_inner()).any(|face| {
        let [a, b, c] = face.positions().map(coord);
        incircle(a, b, c, coord(other)) == 0.0
    })
}

#[cfg(test)]
mod tests {
    use super::missing_edges;
    use feature_sampling::geometry::Point;

    fn missing(points: &[(f64, f64)], edges: &[(usize, usize)]) -> usize {
        let points: Vec<_> = points.iter().map(|&(x, y)| Point::new(x, y)).collect();
        missing_edges(&points, edges).expect("in range")
    }

    #[test]
    fn a_long_diagonal_is_missing() {
        // A flat rhombus: its short diagonal is Delaunay, its long one is not.
        let rhombus = [(-2.0, 0.0), (0.0, -1.0), (2.0, 0.0), (0.0, 1.0)];
        assert_eq!(missing(&rhombus, &[(1, 3)]), 0, "short");
        assert_eq!(missing(&rhombus, &[(0, 2)]), 1, "long");
        assert_eq!(missing(&rhombus, &[(0, 1), (1, 2), (2, 3), (3, 0)]), 0, "sides");
    }

    #[test]
    fn both_diagonals_of_a_square_are_present() {
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        assert_eq!(missing(&square, &[(0, 2), (1, 3)]), 0, "a tie");
        // Sixteen points of one exact circle (Pythagorean, radius 65): every chord is Delaunay.
        let mut ring = Vec::new();
        for (a, b) in [(16.0, 63.0), (33.0, 56.0), (25.0, 60.0), (39.0, 52.0)] {
            ring.extend([(a, b), (-a, b), (a, -b), (-a, -b)]);
        }
        let chords: Vec<_> = (0..ring.len()).flat_map(|a| (0..a).map(move |b| (a, b))).collect();
        assert_eq!(missing(&ring, &chords), 0, "every chord of an empty circle");
    }

    #[test]
    fn repeated_and_collinear_points() {
        let line = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1e-200, -0.0)];
        assert_eq!(missing(&line, &[(0, 1), (1, 2), (2, 3), (0, 4)]), 0, "neighbours");
        assert_eq!(missing(&line, &[(0, 3)]), 1, "a point lies between");
        assert!(missing_edges(&[Point::new(1e300, 0.0)], &[]).is_err(), "out of the domain");
    }
}
