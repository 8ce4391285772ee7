//! The points as all algorithms see them: distinct sites, their Delaunay triangulation, edges in one total order.
//!
//! Everything the algorithms share is done here, once for all of them.
//!
//! **Sites.** Equal points are one site; results name the first of them. Coordinates are multiplied by the power of two
//! that brings the largest near 1. That is exact and changes no comparison, and it lets every finite input in: the
//! predicates of `spade` are exact between 2^−142 and 2^201 (what is smaller than 2^−142 of the largest coordinate counts
//! as zero).
//!
//! **Triangulation.** `spade` with Shewchuk's exact predicates. Where four or more sites lie on one empty circle several
//! triangulations are Delaunay and which of them is used depends on the order of the input; an algorithm whose answer
//! depends on it has none better. Collinear sites give a chain of edges and no face.
//!
//! **The tie rule.** "Shorter" and "nearer" always mean: smaller (squared length, lower site number, higher site number),
//! the squared length as rounded in `f64`. [`Sites::edges`] is sorted so and each site's edges are in that order, hence a
//! site's nearest neighbour is the other end of its first edge (the nearest-neighbour graph is part of every Delaunay
//! triangulation). Rules that speak of *equal* lengths compare the rounded squared lengths.

use std::collections::HashMap;
use std::fmt;

use feature_sampling::geometry::Point;
use spade::{DelaunayTriangulation, HasPosition, MIN_ALLOWED_VALUE, Point2, Triangulation};

use super::insertion;

/// The face outside the convex hull, in [`Edge::faces`].
pub const OUTER: u32 = u32::MAX;

/// Why points cannot be triangulated.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SitesError {
    /// A coordinate is infinite or not a number; leave the point out.
    NotFinite {
        /// Its number in the input, from 0.
        point: usize,
    },
    /// More than 2^29 points.
    TooMany,
}

impl fmt::Display for SitesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { point } => write!(f, "point {point} has a coordinate that is not finite"),
            Self::TooMany => f.write_str("more than 536870912 points"),
        }
    }
}

impl std::error::Error for SitesError {}

/// A Delaunay edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Its ends, lower site number first.
    pub ends: [u32; 2],
    /// The faces left and right of the way from the first end to the second, with y upwards; [`OUTER`] outside the hull.
    pub faces: [u32; 2],
    /// Squared length in scaled coordinates, rounded.
    pub length_sq: f64,
}

impl Edge {
    /// The other end.
    pub const fn other(&self, site: u32) -> u32 {
        if self.ends[0] == site { self.ends[1] } else { self.ends[0] }
    }

    /// The other face.
    pub const fn across(&self, face: u32) -> u32 {
        if self.faces[0] == face { self.faces[1] } else { self.faces[0] }
    }

    /// Length in scaled coordinates.
    pub fn length(&self) -> f64 {
        self.length_sq.sqrt()
    }
}

/// A Delaunay triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Face {
    /// Corners, ascending.
    pub corners: [u32; 3],
    /// Sides, as numbers of edges; side i lies opposite of corner i.
    pub sides: [u32; 3],
}

impl Face {
    /// Where among the corners a site stands.
    pub fn place_of(&self, site: u32) -> Option<usize> {
        self.corners.iter().position(|&corner| corner == site)
    }
}

/// Distinct points with their Delaunay triangulation.
#[derive(Clone, Debug)]
pub struct Sites {
    points: Vec<Point<f64>>,
    first: Vec<usize>,
    edges: Vec<Edge>,
    faces: Vec<Face>,
    /// Edges of site i: `around[starts[i]..starts[i + 1]]`.
    starts: Vec<u32>,
    around: Vec<u32>,
}

impl Sites {
    /// Merges equal points and triangulates. O(n log n).
    ///
    /// # Errors
    /// See [`SitesError`].
    pub fn new(points: &[Point<f64>]) -> Result<Self, SitesError> {
        if points.len() > 1 << 29 {
            return Err(SitesError::TooMany);
        }
        if let Some(point) = points.iter().position(|p| !(p.x.is_finite() && p.y.is_finite())) {
            return Err(SitesError::NotFinite { point });
        }
        let largest = points.iter().fold(0.0_f64, |m, p| m.max(p.x.abs()).max(p.y.abs()));
        let scale = Scale::for_largest(largest);
        let mut seen = HashMap::with_capacity(points.len());
        let (mut distinct, mut first) = (Vec::new(), Vec::new());
        for (i, point) in points.iter().enumerate() {
            let p = Point::new(scale.apply(point.x), scale.apply(point.y));
            seen.entry([p.x.to_bits(), p.y.to_bits()]).or_insert_with(|| {
                distinct.push(p);
                first.push(i);
            });
        }
        drop(seen);
        Ok(Self::triangulated(distinct, first))
    }

    /// Some of the sites by themselves; site numbers are positions in `chosen`.
    pub(crate) fn subset(&self, chosen: &[u32]) -> Self {
        let points = chosen.iter().map(|&site| self.point(site)).collect();
        Self::triangulated(points, (0..chosen.len()).collect())
    }

    fn triangulated(points: Vec<Point<f64>>, first: Vec<usize>) -> Self {
        let (mut edges, faces) = delaunay(&points);
        let (edges, faces) = {
            let mut order: Vec<u32> = (0..).take(edges.len()).collect();
            order.sort_unstable_by(|&a, &b| {
                let (a, b) = (&edges[a as usize], &edges[b as usize]);
                a.length_sq.total_cmp(&b.length_sq).then(a.ends.cmp(&b.ends))
            });
            let mut rank = vec![0_u32; edges.len()];
            for (new, &old) in (0_u32..).zip(&order) {
                rank[old as usize] = new;
            }
            let sorted: Vec<Edge> = order.iter().map(|&old| edges[old as usize]).collect();
            edges.clear();
            let renamed =
                faces.into_iter().map(|face: Face| Face { sides: face.sides.map(|s| rank[s as usize]), ..face });
            (sorted, renamed.collect())
        };
        let mut starts = vec![0_u32; points.len() + 1];
        for site in edges.iter().flat_map(|edge| edge.ends) {
            starts[site as usize + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut around = vec![0; 2 * edges.len()];
        for (number, edge) in (0_u32..).zip(&edges) {
            for site in edge.ends {
                let place = &mut next[site as usize];
                around[*place as usize] = number;
                *place += 1;
            }
        }
        Self { points, first, edges, faces, starts, around }
    }

    /// How many sites there are.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// There are none.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// The numbers of all sites.
    pub fn numbers(&self) -> impl Iterator<Item = u32> + use<> {
        (0..).take(self.points.len())
    }

    /// A site, in scaled coordinates.
    pub fn point(&self, site: u32) -> Point<f64> {
        self.points[site as usize]
    }

    /// All sites, in scaled coordinates.
    pub fn points(&self) -> &[Point<f64>] {
        &self.points
    }

    /// The first point of the input at this site.
    pub fn original(&self, site: u32) -> usize {
        self.first[site as usize]
    }

    /// All Delaunay edges, shortest first.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// A Delaunay edge by its number in [`Sites::edges`].
    pub fn edge(&self, edge: u32) -> &Edge {
        &self.edges[edge as usize]
    }

    /// All Delaunay triangles.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// A Delaunay triangle.
    pub fn face(&self, face: u32) -> &Face {
        &self.faces[face as usize]
    }

    /// The edges at a site, shortest first.
    pub fn edges_at(&self, site: u32) -> &[u32] {
        let i = site as usize;
        &self.around[self.starts[i] as usize..self.starts[i + 1] as usize]
    }

    /// The neighbours of a site in the triangulation, nearest first.
    pub fn neighbours(&self, site: u32) -> impl Iterator<Item = u32> + '_ {
        self.edges_at(site).iter().map(move |&edge| self.edge(edge).other(site))
    }

    /// The nearest other site; `None` for a lone one.
    pub fn nearest(&self, site: u32) -> Option<u32> {
        self.neighbours(site).next()
    }

    /// The edge to the nearest other site.
    pub fn nearest_edge(&self, site: u32) -> Option<u32> {
        self.edges_at(site).first().copied()
    }

    /// The edge between two sites, if it is a Delaunay edge of this triangulation.
    pub fn edge_between(&self, a: u32, b: u32) -> Option<u32> {
        let fewer = if self.edges_at(a).len() <= self.edges_at(b).len() { [a, b] } else { [b, a] };
        self.edges_at(fewer[0]).iter().copied().find(|&edge| self.edge(edge).other(fewer[0]) == fewer[1])
    }
}

/// Multiplication by a power of two, in two steps because the power itself may be out of range.
struct Scale([f64; 2]);

impl Scale {
    fn for_largest(largest: f64) -> Self {
        // The exponent of a positive double; subnormal ones count as 2^-1023, which is near enough.
        let exponent = i32::try_from((largest.to_bits() >> 52) & 0x7ff).unwrap_or(0) - 1023;
        let half = -exponent / 2;
        Self([half, -exponent - half].map(|e| 2.0_f64.powi(e)))
    }

    fn apply(&self, v: f64) -> f64 {
        let scaled = v * self.0[0] * self.0[1];
        flushed(scaled)
    }
}

/// A constructed point in the domain of the predicates.
#[cfg(test)]
pub(crate) fn admissible(p: Point<f64>) -> Point<f64> {
    /// Far beyond all that scaled sites can lead to, and within the domain.
    const LARGEST: f64 = 1e60;
    let within = |v: f64| if v.is_finite() { flushed(v.clamp(-LARGEST, LARGEST)) } else { LARGEST };
    Point::new(within(p.x), within(p.y))
}

/// Without what is too small for the predicates; never −0.
fn flushed(v: f64) -> f64 {
    if v.abs() < MIN_ALLOWED_VALUE { 0.0 } else { v }
}

/// A point with its number.
struct Vertex {
    position: Point2<f64>,
    number: u32,
}

impl HasPosition for Vertex {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

fn triangulation(points: &[Point<f64>]) -> DelaunayTriangulation<Vertex> {
    let mut triangulation = DelaunayTriangulation::with_capacity(points.len(), 3 * points.len(), 2 * points.len());
    let mut last = None;
    for number in insertion::order(points) {
        let p = &points[number as usize];
        let vertex = Vertex { position: Point2::new(p.x, p.y), number };
        let inserted = match last {
            Some(near) => triangulation.insert_with_hint(vertex, near),
            None => triangulation.insert(vertex),
        };
        // All coordinates are finite and in the domain, which is all that can be wrong.
        last = inserted.ok().or(last);
    }
    triangulation
}

/// The edges of a Delaunay triangulation of distinct points in the domain of `spade`, as pairs of their numbers.
#[cfg(test)]
pub(crate) fn delaunay_edges(points: &[Point<f64>]) -> Vec<[u32; 2]> {
    let triangulation = triangulation(points);
    triangulation.undirected_edges().map(|edge| ascending(edge.vertices().map(|v| v.data().number))).collect()
}

/// Edges and faces, with `Face::sides` by position among the edges.
fn delaunay(points: &[Point<f64>]) -> (Vec<Edge>, Vec<Face>) {
    let triangulation = triangulation(points);
    let number = |face: spade::handles::FaceHandle<'_, spade::handles::PossiblyOuterTag, Vertex, (), (), ()>| {
        // Face 0 of spade is the outer one. Fewer than 2^30 sites have fewer than 2^31 faces.
        face.as_inner().map_or(OUTER, |inner| u32::try_from(inner.fix().index() - 1).unwrap_or(OUTER))
    };
    let edges = triangulation.undirected_edges().map(|edge| {
        let directed = edge.as_directed();
        let directed =
            if directed.from().data().number < directed.to().data().number { directed } else { directed.rev() };
        let ends = [directed.from(), directed.to()].map(|v| v.data().number);
        let faces = [number(directed.face()), number(directed.rev().face())];
        Edge { ends, faces, length_sq: points[ends[0] as usize].distance_sq(&points[ends[1] as usize]) }
    });
    let edges: Vec<Edge> = edges.collect();
    let faces = triangulation.inner_faces().map(|face| {
        // Side i of spade's face starts at its corner i, so it lies opposite of corner i + 2.
        let sides = face.adjacent_edges();
        let mut pairs = [2, 0, 1].map(|i| {
            let opposite = sides[(i + 1) % 3];
            let side = u32::try_from(opposite.as_undirected().fix().index()).unwrap_or(OUTER);
            (sides[i].from().data().number, side)
        });
        pairs.sort_unstable();
        Face { corners: pairs.map(|(corner, _)| corner), sides: pairs.map(|(_, side)| side) }
    });
    let faces = faces.collect();
    (edges, faces)
}

/// Lower number first.
pub(crate) const fn ascending(ends: [u32; 2]) -> [u32; 2] {
    if ends[0] <= ends[1] { ends } else { [ends[1], ends[0]] }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sites(points: &[(f64, f64)]) -> Sites {
        let points: Vec<_> = points.iter().map(|&(x, y)| Point::new(x, y)).collect();
        Sites::new(&points).expect("finite")
    }

    #[test]
    fn equal_points_are_one_site() {
        let sites = sites(&[(3.0, 0.0), (0.0, 0.0), (3.0, -0.0), (0.0, 1.0)]);
        assert_eq!(sites.len(), 3, "distinct points");
        assert_eq!(sites.original(2), 3, "the first of each");
    }

    #[test]
    fn triangulation_is_consistent() {
        let mut points = Vec::new();
        for i in 0..60_u32 {
            let t = f64::from(i);
            points.push(((t * 0.37).sin() * t, (t * 0.71).cos() * (60.0 - t)));
        }
        let sites = sites(&points);
        let hull = sites.edges().iter().filter(|edge| edge.faces.contains(&OUTER)).count();
        assert_eq!(sites.edges().len(), 3 * sites.len() - 3 - hull, "Euler");
        for (number, face) in (0_u32..).zip(sites.faces()) {
            for i in 0..3 {
                let side = sites.edge(face.sides[i]);
                assert!(side.faces.contains(&number), "side knows its face");
                assert!(!side.ends.contains(&face.corners[i]), "side i lies opposite of corner i");
            }
        }
        for site in sites.numbers() {
            let lengths: Vec<f64> = sites.edges_at(site).iter().map(|&edge| sites.edge(edge).length_sq).collect();
            assert!(lengths.is_sorted(), "shortest first");
            let brute = sites.numbers().filter(|&other| other != site).min_by(|&a, &b| {
                let of = |o: u32| sites.point(o).distance_sq(&sites.point(site));
                of(a).total_cmp(&of(b)).then(a.cmp(&b))
            });
            assert_eq!(sites.nearest(site), brute, "nearest neighbour of {site}");
        }
    }

    #[test]
    fn degenerate_input() {
        assert!(sites(&[]).is_empty(), "nothing");
        assert_eq!(sites(&[(1.0, 1.0)]).edges().len(), 0, "one point");
        assert_eq!(sites(&[(1.0, 1.0), (1.0, 1.0), (2.0, 1.0)]).edges().len(), 1, "two points");
        let line: Vec<_> = (0..20).map(|i| (f64::from((i * 7) % 20), f64::from((i * 7) % 20))).collect();
        let line = sites(&line);
        assert_eq!((line.edges().len(), line.faces().len()), (19, 0), "a chain");
        for scale in [f64::MAX / 4.0, f64::MIN_POSITIVE, 1e-320] {
            let square = sites(&[(0.0, 0.0), (scale, 0.0), (scale, scale), (0.0, scale)]);
            assert_eq!((square.edges().len(), square.faces().len()), (5, 2), "a square of side {scale:e}");
        }
        let bad = [Point::new(0.0, 0.0), Point::new(f64::NAN, 0.0)];
        assert_eq!(Sites::new(&bad).err(), Some(SitesError::NotFinite { point: 1 }), "not a number");
    }
}
