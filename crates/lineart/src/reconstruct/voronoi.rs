//! Voronoi vertices: centres of the empty circles through three sites.
//!
//! No vertex may be left out because it is far away: the centre of a sliver at the hull bears on the edge beside it. A triangle so flat that its centre cannot be computed (twice its area below 1e−9 of its
//! longest side squared) gets one at 10⁶ times the longest side, beyond that side; that is nearer than the true centre of
//! all but the very flattest such triangles, and as good as infinitely far for every circle through sites of a curve.

use feature_sampling::geometry::Point;
use robust::{Coord, orient2d};

use super::sites::Sites;

/// Twice the area below which a triangle counts as flat, relative to the square of its longest side.
const FLAT: f64 = 1e-9;

/// How far away the centre of a flat triangle is put, in longest sides.
const FAR: f64 = 1e6;

/// The circumcentre of each Delaunay triangle, in the order of [`Sites::faces`], in scaled coordinates; rounded.
pub fn circumcentres(sites: &Sites) -> Vec<Point<f64>> {
    sites.faces().iter().map(|face| circumcentre(face.corners.map(|corner| sites.point(corner)))).collect()
}

fn circumcentre([a, b, c]: [Point<f64>; 3]) -> Point<f64> {
    let (u, v) = (b.minus(&a), c.minus(&a));
    let (uu, vv) = (u.norm_sq(), v.norm_sq());
    let coord = |p: Point<f64>| Coord { x: p.x, y: p.y };
    // Exact in sign: the centre of a sliver must not end up on the wrong side of it.
    let area2 = orient2d(coord(a), coord(b), coord(c));
    let sides = [(b.distance_sq(&c), a, b, c), (vv, b, c, a), (uu, c, a, b)];
    let (longest, apex, from, to) = sides.into_iter().fold(sides[0], |m, s| if s.0 > m.0 { s } else { m });
    if area2.abs() < FLAT * longest {
        let middle = from.middle(&to);
        let along = to.minus(&from);
        let out = Point::new(middle.x - FAR * along.y, middle.y + FAR * along.x);
        let back = Point::new(middle.x + FAR * along.y, middle.y - FAR * along.x);
        // Beyond the longest side: where the apex is not.
        return if orient2d(coord(from), coord(to), coord(apex)) > 0.0 { back } else { out };
    }
    let d = 0.5 / area2;
    Point::new(a.x + d * (v.y * uu - u.y * vv), a.y + d * (u.x * vv - v.x * uu))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn same_distance_from_all_corners() {
        let corners = [Point::new(1.0, 2.0), Point::new(4.0, 2.5), Point::new(2.0, 7.0)];
        let centre = circumcentre(corners);
        let distances = corners.map(|corner| corner.distance(&centre));
        assert!(distances.iter().all(|d| (d - distances[0]).abs() < 1e-12), "{distances:?}");
    }

    #[test]
    fn a_flat_triangle_has_its_centre_beyond_its_longest_side() {
        for flip in [1.0, -1.0] {
            let corners = [Point::new(0.0, 0.0), Point::new(2.0, 0.0), Point::new(1.0, flip * 1e-12)];
            for turn in 0..3 {
                let centre = circumcentre([0, 1, 2].map(|i| corners[(i + turn) % 3]));
                assert!((centre.x - 1.0).abs() < 1e-9 && centre.y * flip < -1e5, "{centre:?}");
            }
        }
    }
}
