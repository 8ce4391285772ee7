//! lfs from the nearest medial *vertex*, through a kd-tree (paper, section 3.2; feature `kiddo`).
//!
//! The paper finds the vertex n of the medial polylines nearest to p and takes the distance from p to the edges that meet
//! in n. This is for comparison with [`LfsIndex`](super::LfsIndex), which finds the nearest *edge*: the estimate here is
//! never smaller, and larger where the nearest edge does not end in the nearest vertex. On an edge longer than its distance
//! from p, a vertex of another polyline can be nearer than both of its ends (`docs/mathematics.md`, section 7).

use super::FeatureSize;
use crate::curve::CurveParam;
use crate::geometry::{Point, distance_sq_to_segment};
use crate::medial::MedialPoint;
use alloc::vec::Vec;
use kiddo::{ImmutableKdTree, SquaredEuclidean};

/// The medial polylines, borrowed, with a kd-tree of their vertices.
///
/// Vertices that are not finite are left out, with their edges. Vertices at one place count as one that has the edges of
/// all of them.
#[derive(Debug)]
pub struct KdIndex<'a> {
    points: &'a [MedialPoint<f64>],
    /// Indices of the finite vertices, those at one place next to each other.
    vertices: Vec<usize>,
    /// Where each place starts in `vertices`.
    places: Vec<usize>,
    /// The places; none without a finite vertex.
    tree: Option<ImmutableKdTree<f64, 2>>,
}

impl<'a> KdIndex<'a> {
    /// Builds the tree over these points.
    pub fn new(points: &'a [MedialPoint<f64>]) -> Self {
        // Adding 0 makes −0 the same as 0.
        let at = |i: usize| points.get(i).map_or([f64::NAN; 2], |p| [p.centre.x + 0.0, p.centre.y + 0.0]);
        let mut vertices: Vec<usize> = (0..points.len()).filter(|&i| at(i).iter().all(|c| c.is_finite())).collect();
        vertices.sort_by(|&i, &j| at(i)[0].total_cmp(&at(j)[0]).then(at(i)[1].total_cmp(&at(j)[1])));
        let (mut places, mut coordinates) = (Vec::new(), Vec::new());
        for (k, &i) in vertices.iter().enumerate() {
            if coordinates.last() != Some(&at(i)) {
                places.push(k);
                coordinates.push(at(i));
            }
        }
        // The tree fails only for more places than its u32 holds, which medial points number anyway.
        let tree = if coordinates.is_empty() { None } else { ImmutableKdTree::new_from_slice(&coordinates).ok() };
        Self { points, vertices, places, tree }
    }

    /// The paper's estimate of lfs: the distance from p to the nearest vertex's edges, at most two in each polyline.
    ///
    /// Infinite if there is no finite vertex. It can exceed the distance to the polylines, [`LfsIndex::distance`], because
    /// the nearest vertex is not always on the nearest edge.
    ///
    /// [`LfsIndex::distance`]: super::LfsIndex::distance
    pub fn lfs(&self, p: &Point<f64>) -> f64 {
        let Some(tree) = &self.tree else { return f64::INFINITY };
        let place = tree.query(&[p.x, p.y]).nearest_one::<SquaredEuclidean<f64>>().execute().item as usize;
        let from = self.places.get(place).copied().unwrap_or_default();
        let to = self.places.get(place + 1).copied().unwrap_or(self.vertices.len());
        let here = self.vertices.get(from..to).unwrap_or_default();
        here.iter().map(|&i| self.distance_sq_around(i, p)).fold(f64::INFINITY, f64::min).sqrt()
    }

    /// Squared distance from p to a vertex and the edges that meet in it.
    fn distance_sq_around(&self, vertex: usize, p: &Point<f64>) -> f64 {
        let Some(n) = self.points.get(vertex) else { return f64::INFINITY };
        let neighbours = [vertex.checked_sub(1), vertex.checked_add(1)];
        neighbours
            .into_iter()
            .filter_map(|i| self.points.get(i?))
            .filter(|other| other.polyline == n.polyline && other.centre.x.is_finite() && other.centre.y.is_finite())
            .map(|other| distance_sq_to_segment(p, &n.centre, &other.centre))
            .fold(p.distance_sq(&n.centre), f64::min)
    }
}

impl FeatureSize<f64> for KdIndex<'_> {
    fn lfs(&self, _at: &CurveParam<f64>, p: &Point<f64>) -> f64 {
        self.lfs(p)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bezier::Cubic;
    use crate::curve::door::DoorOptions;
    use crate::medial::Resolution;
    use crate::model::{CurveModel, MedialModel};

    fn vertex(x: f64, y: f64, polyline: u32) -> MedialPoint<f64> {
        MedialPoint { centre: Point::new(x, y), polyline, ..MedialPoint::default() }
    }

    /// An ellipse of four cubics.
    fn ellipse(rx: f64, ry: f64) -> [Cubic<f64>; 4] {
        let k = 0.552_284_749_831;
        let quarter = [[1.0, 0.0], [1.0, k], [k, 1.0], [0.0, 1.0]];
        core::array::from_fn(|turn| {
            let turned = |[x, y]: [f64; 2]| [[x, y], [-y, x], [-x, -y], [y, -x]][turn];
            Cubic { points: quarter.map(|p| Point::new(rx * turned(p)[0], ry * turned(p)[1])) }
        })
    }

    #[test]
    fn never_below_the_nearest_edge_and_close_to_it() {
        let cubics = ellipse(60.0, 40.0);
        let curve = CurveModel::new(&[(true, &cubics)], &DoorOptions::default()).unwrap();
        let medial = MedialModel::new(&curve, &Resolution::Tolerance(1e-3));
        let kd = KdIndex::new(medial.points());
        for i in 0..400 {
            let p = cubics[i % 4].eval(&(i as f64 / 400.0));
            let (vertex, edge) = (kd.lfs(&p), medial.lfs(&p));
            assert!(vertex >= edge * (1.0 - 1e-12), "{p:?}: {vertex} < {edge}");
            assert!(vertex <= edge * (1.0 + 1e-2), "{p:?}: {vertex} > {edge}");
        }
    }

    #[test]
    fn nothing_is_infinitely_far() {
        let p = Point::new(1.0, 2.0);
        assert_eq!(KdIndex::new(&[]).lfs(&p), f64::INFINITY);
        let unbounded = [vertex(f64::INFINITY, 0.0, 0), vertex(f64::NAN, 0.0, 0)];
        assert_eq!(KdIndex::new(&unbounded).lfs(&p), f64::INFINITY);
        // An edge to a vertex that is not finite is none.
        let half = [vertex(f64::INFINITY, 0.0, 0), vertex(1.0, 0.0, 0)];
        assert_eq!(KdIndex::new(&half).lfs(&p), 2.0);
    }

    #[test]
    fn many_vertices_at_one_place_have_all_their_edges() {
        let mut points: Vec<_> = (0..300).map(|i| vertex(0.0, if i % 2 == 0 { 0.0 } else { -0.0 }, i)).collect();
        points.extend([vertex(10.0, 0.0, 299), vertex(0.0, 0.0, 300), vertex(0.0, 10.0, 300)]);
        let kd = KdIndex::new(&points);
        assert_eq!(kd.places.len(), 3);
        assert_eq!((kd.lfs(&Point::new(4.0, 1.0)), kd.lfs(&Point::new(1.0, 4.0))), (1.0, 1.0));
        assert_eq!(kd.lfs(&Point::new(-3.0, -4.0)), 5.0);
    }

    #[test]
    fn vertices_in_one_line() {
        let points: Vec<_> = (0..1000).map(|i| vertex(7.0, f64::from(i), 0)).collect();
        assert_eq!(KdIndex::new(&points).lfs(&Point::new(4.0, 500.3)), 3.0);
    }

    #[test]
    fn the_nearest_vertex_can_be_on_another_polyline() {
        let points = [vertex(-10.0, 1.0, 0), vertex(10.0, 1.0, 0), vertex(0.0, -2.0, 1)];
        assert_eq!(KdIndex::new(&points).lfs(&Point::new(0.0, 0.0)), 2.0);
    }
}
