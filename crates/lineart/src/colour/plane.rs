//! The plane cut into triangles along the strokes.
//!
//! A constrained Delaunay triangulation of the noded samples inside a frame, kept as plain tables: for each face its
//! vertices, for each of its sides the face beyond, the squared length, and the edge of the graph that blocks it. All of it
//! is in whole lattice units, so signs and comparisons of lengths are exact. A plane does not depend on hints; it is made
//! once and coloured as often as hints change.
//!
//! **Frame.** The box of the drawing padded on each side by 1.1 times its larger extent: edges to the frame are then
//! longer than any edge inside the drawing, so that what is outside is connected by the widest passages there are.

use std::cmp::Reverse;
use std::collections::HashMap;

use feature_sampling::geometry::{Aabb, Point};
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::ColourError;
use crate::drawing::DrawingPath;
use crate::node::pairs::Boxes;
use crate::node::{Chain, Noded, Options, Track, node};

/// No face, no edge.
pub(super) const NONE: u32 = u32::MAX;

/// A triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    /// Vertices, counter-clockwise where y points up.
    pub(super) corners: [u32; 3],
    /// The face beyond the side from corner i to corner i + 1, or [`NONE`] at the frame.
    pub(super) beyond: [u32; 3],
    /// Number of that side; both faces of a side have the same.
    pub(super) sides: [u32; 3],
}

/// An edge of the triangulation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    /// Squared length in lattice units, exact.
    pub(super) length_sq: u128,
    /// The edge of the graph that lies here, or [`NONE`]: colour passes.
    pub(super) chain: u32,
    /// Its place among all sides by length, of equally long ones the higher number first.
    pub(super) rank: u32,
}

/// A drawing, ready to be coloured.
#[derive(Debug)]
pub struct Plane<'a> {
    pub(super) paths: &'a [DrawingPath],
    pub(super) noded: Noded,
    pub(super) faces: Vec<Face>,
    pub(super) sides: Vec<Side>,
    /// The sides by rank.
    pub(super) by_rank: Vec<u32>,
    /// Lattice places of all vertices; those of the frame are the last four.
    pub(super) places: Vec<[i64; 2]>,
    /// The lattice's origin and unit.
    pub(super) origin: Point<f64>,
    pub(super) unit: f64,
    /// How many edges of the graph end in a vertex.
    pub(super) degrees: Vec<u32>,
    triangulation: ConstrainedDelaunayTriangulation<Point2<f64>>,
    /// By spade's number of a face.
    numbers: Vec<u32>,
    /// Faces beside curves with the number of the corner that their side on it starts at, and the boxes of those curves.
    beside: Vec<(u32, usize)>,
    curves: Boxes,
}

impl<'a> Plane<'a> {
    /// Nodes the chains and triangulates.
    ///
    /// # Errors
    /// [`ColourError`].
    pub fn new(paths: &'a [DrawingPath], chains: &[Chain], options: &Options) -> Result<Self, ColourError> {
        let noded = node(paths, chains, options).map_err(ColourError::Node)?;
        if noded.edges.is_empty() {
            return Err(ColourError::Empty);
        }
        let mut places: Vec<[i64; 2]> = noded.vertices.iter().map(|vertex| vertex.place).collect();
        let bound = |i: usize| {
            let along = || places.iter().map(|place| place[i]);
            (along().min().unwrap_or(0), along().max().unwrap_or(0))
        };
        let ((left, right), (low, high)) = (bound(0), bound(1));
        let pad = ((right - left).max(high - low) / 10).saturating_mul(11).max(8);
        let (left, right, low, high) = (left - pad, right + pad, low - pad, high + pad);
        places.extend([[left, low], [right, low], [right, high], [left, high]]);

        let points: Vec<Point2<f64>> = places.iter().map(|p| Point2::new(p[0] as f64, p[1] as f64)).collect();
        let constraints = noded.edges.iter().map(|edge| edge.ends.map(|v| v as usize)).collect();
        let mut conflicts = 0;
        let triangulation =
            ConstrainedDelaunayTriangulation::try_bulk_load_cdt(points, constraints, |_| conflicts += 1)
                .map_err(|_| ColourError::Triangulation)?;
        // Noded edges cannot conflict; if they do, colours would leak.
        if conflicts > 0 || triangulation.num_vertices() != places.len() {
            return Err(ColourError::Triangulation);
        }
        let mut degrees = vec![0; places.len()];
        noded.edges.iter().flat_map(|edge| edge.ends).for_each(|v| degrees[v as usize] += 1);
        let unit = noded.unit;
        let first = noded.vertices.first().map_or_else(Default::default, |vertex| {
            let [x, y] = vertex.place.map(|v| v as f64 * unit);
            Point::new(vertex.point.x - x, vertex.point.y - y)
        });
        let mut plane = Self {
            paths,
            noded,
            faces: Vec::new(),
            sides: Vec::new(),
            by_rank: Vec::new(),
            places,
            origin: first,
            unit,
            degrees,
            triangulation,
            numbers: Vec::new(),
            beside: Vec::new(),
            curves: Boxes::new(Vec::new()),
        };
        plane.tabulate();
        plane.rank();
        plane.index_curves();
        Ok(plane)
    }

    fn tabulate(&mut self) {
        let by_ends: HashMap<[u32; 2], u32> = self.noded.edges.iter().map(|edge| edge.ends).zip(0..).collect();
        let number = |index: usize| u32::try_from(index).unwrap_or(NONE);
        self.numbers = vec![NONE; self.triangulation.num_all_faces()];
        for (face, count) in self.triangulation.inner_faces().zip(0..) {
            self.numbers[face.fix().index()] = count;
        }
        let places = &self.places;
        self.sides = self
            .triangulation
            .undirected_edges()
            .map(|edge| {
                let [a, b] = edge.vertices().map(|vertex| number(vertex.fix().index()));
                let d = |i: usize| places[a as usize][i].abs_diff(places[b as usize][i]);
                let square = |v: u64| u128::from(v) * u128::from(v);
                let chain = by_ends.get(&[a.min(b), a.max(b)]).copied().unwrap_or(NONE);
                Side { length_sq: square(d(0)) + square(d(1)), chain, rank: NONE }
            })
            .collect();
        let numbers = &self.numbers;
        self.faces = self
            .triangulation
            .inner_faces()
            .map(|face| {
                let edges = face.adjacent_edges();
                Face {
                    corners: edges.map(|edge| number(edge.from().fix().index())),
                    beyond: edges.map(|edge| numbers[edge.rev().face().fix().index()]),
                    sides: edges.map(|edge| number(edge.as_undirected().fix().index())),
                }
            })
            .collect();
    }

    /// Sorts the sides once, so that a flood compares whole numbers of 32 bits.
    fn rank(&mut self) {
        let sides = &self.sides;
        let mut by_rank: Vec<u32> = (0..).take(sides.len()).collect();
        by_rank.sort_unstable_by_key(|&side| (sides[side as usize].length_sq, Reverse(side)));
        for (&side, rank) in by_rank.iter().zip(0..) {
            self.sides[side as usize].rank = rank;
        }
        self.by_rank = by_rank;
    }

    fn index_curves(&mut self) {
        let mut boxes = Vec::new();
        for (face, number) in self.faces.iter().zip(0_u32..) {
            for (i, side) in face.sides.iter().enumerate() {
                let chain = self.sides[*side as usize].chain;
                let Some(edge) = self.noded.edges.get(chain as usize) else { continue };
                let Some(owner) = self.noded.owners(edge).first() else { continue };
                let Some(path) = self.paths.get(owner.path as usize) else { continue };
                let (low, high) = (owner.at[0].min(owner.at[1]), owner.at[0].max(owner.at[1]));
                let mut bounds = Aabb::empty();
                Track::new(&path.cubics).cubics(low, high).for_each(|cubic| bounds.merge(&cubic.control_box()));
                self.beside.push((number, i));
                boxes.push(bounds);
            }
        }
        self.curves = Boxes::new(boxes);
    }

    /// The point of a vertex, in user units.
    pub(super) fn point(&self, vertex: u32) -> Point<f64> {
        match self.noded.vertices.get(vertex as usize) {
            Some(vertex) => vertex.exact,
            None => {
                let [x, y] = self.places[vertex as usize].map(|v| v as f64 * self.unit);
                Point::new(self.origin.x + x, self.origin.y + y)
            }
        }
    }

    /// The length of a side, in user units.
    pub(super) fn length(&self, side: u32) -> f64 {
        (self.sides[side as usize].length_sq as f64).sqrt() * self.unit
    }

    /// Twice the area of a face in square user units.
    pub(super) fn area(&self, face: u32) -> f64 {
        let [a, b, c] = self.faces[face as usize].corners.map(|v| self.places[v as usize].map(|v| v as f64));
        ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) * self.unit * self.unit / 2.0
    }

    /// A point in lattice units.
    pub(super) fn scaled(&self, p: &Point<f64>) -> Point2<f64> {
        Point2::new((p.x - self.origin.x) / self.unit, (p.y - self.origin.y) / self.unit)
    }

    /// The face that holds a point, [`NONE`] outside the frame. On a side or a corner it is the face with the smallest
    /// number.
    ///
    /// Between a curve and its chord the face is the one on the curve's side of the point: a stroke parts the plane where
    /// it is drawn, not where its chord runs.
    pub(super) fn locate(&self, p: &Point<f64>) -> u32 {
        use spade::PositionInTriangulation as Position;
        let around = |vertex: FixedVertexHandle| {
            self.triangulation.vertex(vertex).out_edges().map(|edge| self.numbers[edge.face().fix().index()]).min()
        };
        let q = self.scaled(p);
        let face = match self.triangulation.locate(q) {
            Position::OnFace(face) => self.numbers[face.index()],
            Position::OnEdge(edge) => {
                let edge = self.triangulation.directed_edge(edge);
                let [a, b] = [edge.face(), edge.rev().face()].map(|face| self.numbers[face.fix().index()]);
                a.min(b)
            }
            Position::OnVertex(vertex) => around(vertex).unwrap_or(NONE),
            Position::OutsideOfConvexHull(_) | Position::NoTriangulation => NONE,
        };
        self.beyond_bulge(p).unwrap_or(face)
    }

    /// If a point lies between a piece of curve and its chord: the face on the chord's other side, of several the one with
    /// the smallest number.
    fn beyond_bulge(&self, p: &Point<f64>) -> Option<u32> {
        let mut best: Option<u32> = None;
        self.curves.around(p, |i| {
            let (number, corner) = self.beside[i as usize];
            if best.is_none_or(|best| number < best) && self.is_in_bulge(number, corner, p) {
                best = Some(number);
            }
        });
        best
    }

    /// A point lies between the curve and the chord of a face's side, outside of the face.
    fn is_in_bulge(&self, face: u32, corner: usize, p: &Point<f64>) -> bool {
        let face = &self.faces[face as usize];
        let chain = self.sides[face.sides[corner] as usize].chain;
        let Some(edge) = self.noded.edges.get(chain as usize) else { return false };
        let (start, end) = (self.point(face.corners[corner]), self.point(face.corners[(corner + 1) % 3]));
        let chord = end.minus(&start);
        let v = p.minus(&start);
        // Faces lie to the left of their sides: a point to the right is a candidate, near enough to be in a bulge.
        let (along, across) = (chord.dot(&v) / chord.norm_sq(), chord.cross(&v) / chord.norm_sq());
        if !((-0.5..=1.5).contains(&along) && (-1.0..0.0).contains(&across)) {
            return false;
        }
        let Some(owner) = self.noded.owners(edge).first() else { return false };
        let Some(path) = self.paths.get(owner.path as usize) else { return false };
        let track = Track::new(&path.cubics);
        let (low, high) = (owner.at[0].min(owner.at[1]), owner.at[0].max(owner.at[1]));
        const STEPS: u32 = 64;
        let at = |step: u32| track.eval(low + (high - low) * f64::from(step) / f64::from(STEPS));
        let mut polygon: Vec<Point<f64>> = (0..=STEPS).map(at).collect();
        polygon.dedup();
        winding(&polygon, p)
    }
}

/// A point is inside a closed polygon, by the number of crossings of a ray.
fn winding(polygon: &[Point<f64>], p: &Point<f64>) -> bool {
    let next = polygon.iter().cycle().skip(1);
    let crosses = |(a, b): (&Point<f64>, &Point<f64>)| {
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    polygon.iter().zip(next).filter(|pair| crosses(*pair)).count() % 2 == 1
}
