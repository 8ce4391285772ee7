//! Crust (Amenta, Bern, Eppstein 1998).
//!
//! An edge belongs to the crust if some circle through its ends holds neither a site nor a Voronoi vertex: the Voronoi
//! vertices of a dense sample lie near the medial axis, which a true edge's circle stays away from. As published, in two
//! triangulations: that of the sites P gives the Voronoi vertices V, and the edges of that of P ∪ V with both ends in P are
//! the crust. Proved to be correct below ε = 0.252 for smooth closed curves. Several curves and open ones are fine in
//! practice; nothing keeps a degree from being 1 or 3.
//!
//! **One triangulation is enough.** Put the Voronoi vertex v at (u, w): along the edge from its middle, and along its
//! bisector. With half length h and the circle's centre at t on the bisector, v is inside exactly if u² + w² − h² < 2·t·w. So
//! each Voronoi vertex leaves a half-line of centres, and so do the sites: together the dual Voronoi edge. What is left is
//! one interval, found by bisection: ask a kd-tree for a Voronoi vertex in the circle of the middle centre; none: the edge
//! is in the crust; one: it takes away the middle, hence half of the interval at least. A few questions decide an edge.
//!
//! Most edges are decided without any question, by the two Voronoi vertices at the ends of the dual edge (the one-step crust
//! of Gold and Snoeyink 2001, which holds the crust): at distances a and b from the edge's middle to either side of it, both
//! are avoided by a circle only if a·b ≥ h². With a = h·cot α and b = h·cot β, the angles opposite of the edge, that says
//! α + β ≤ 90°.
//!
//! The second triangulation is not only slow: Voronoi vertices reach up to 10⁶ diameters away, and for the points of a dense
//! curve an incremental triangulator needed quadratic time (24 s for 80 000 points). It is kept as the judge in the tests.
//! O(n log n) on points of curves.
//!
//! In floating point: the Voronoi vertices are rounded, as they are where they are triangulated. The sum of the angles is
//! seen as 90° exactly where coordinates are integers below 2^12, as those of pixels are.

use feature_sampling::geometry::Point;
use robust::{Coord, orient2d};

use super::kd::Kd;
use super::sites::{Edge, OUTER, Sites};
use super::voronoi::circumcentres;
use super::{Pairs, Reconstruction};

/// Questions about one edge: each halves an interval of doubles.
const QUESTIONS: usize = 64;

/// How near to 1 the share of a centre beyond the hull may come: 10⁹ half edges away.
const BEYOND: f64 = 1.0 - 1e-9;

/// Crust; it has no parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Crust;

impl Reconstruction for Crust {
    fn pairs(&self, sites: &Sites) -> Pairs {
        let centres = circumcentres(sites);
        let kd = Kd::new(&centres);
        let kept = sites.edges().iter().filter(|edge| one_step(sites, edge) && avoids(sites, &centres, &kd, edge));
        kept.map(|edge| edge.ends).collect()
    }
}

/// The angles opposite of the edge add up to at most 90 degrees.
fn one_step(sites: &Sites, edge: &Edge) -> bool {
    let [left, right] = edge.faces.map(|face| opposite(sites, edge, face));
    match (left, right) {
        (Some((cos, sin)), Some((cos2, sin2))) => cos > 0.0 && cos2 > 0.0 && cos * cos2 >= sin * sin2,
        (Some((cos, _)), None) | (None, Some((cos, _))) => cos > 0.0,
        (None, None) => true,
    }
}

/// Cosine and sine, with one positive factor, of the angle of a face opposite of one of its edges.
fn opposite(sites: &Sites, edge: &Edge, face: u32) -> Option<(f64, f64)> {
    if face == OUTER {
        return None;
    }
    let apex = sites.face(face).corners.into_iter().find(|corner| !edge.ends.contains(corner))?;
    let [a, b, c] = [edge.ends[0], edge.ends[1], apex].map(|site| sites.point(site));
    let (u, v) = (a.minus(&c), b.minus(&c));
    let coord = |p: Point<f64>| Coord { x: p.x, y: p.y };
    Some((u.x * v.x + u.y * v.y, orient2d(coord(a), coord(b), coord(c)).abs()))
}

/// Some circle through the ends of the edge holds no site and no Voronoi vertex.
fn avoids(sites: &Sites, centres: &[Point<f64>], kd: &Kd, edge: &Edge) -> bool {
    let [a, b] = edge.ends.map(|end| sites.point(end));
    let (middle, half) = (a.middle(&b), 0.5 * edge.length());
    let along = b.minus(&a);
    // To the left of the way from a to b.
    let normal = Point::new(-along.y / (2.0 * half), along.x / (2.0 * half));
    let bisector = |v: &Point<f64>| (v.x - middle.x) * normal.x + (v.y - middle.y) * normal.y;
    // Centres as shares t/(h + |t|), so that those far away are halved into as well.
    let share = |t: f64| t / (half + t.abs());
    let of_face = |face: u32, none: f64| centres.get(face as usize).map_or(none, |v| share(bisector(v)));
    let (mut low, mut high) = (of_face(edge.faces[1], -BEYOND), of_face(edge.faces[0], BEYOND));
    for _ in 0..QUESTIONS {
        let middle_share = 0.5 * (low + high);
        let t = half * middle_share / (1.0 - middle_share.abs());
        let centre = Point::new(middle.x + t * normal.x, middle.y + t * normal.y);
        let inside = |v: &Point<f64>| v.distance_sq(&middle) - half * half < 2.0 * t * bisector(v);
        let Some(found) = kd.find(&centre, half.hypot(t), inside) else { return true };
        let w = bisector(&found);
        let limit = share((found.distance_sq(&middle) - half * half) / (2.0 * w));
        if w > 0.0 && limit < high {
            high = limit;
        } else if w < 0.0 && limit > low {
            low = limit;
        } else {
            // In the middle of the edge, or at the end of the interval up to rounding.
            return false;
        }
        if low > high {
            return false;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reconstruct::sites::{admissible, delaunay_edges};
    use std::collections::HashSet;

    /// As published: the triangulation of sites and Voronoi vertices.
    fn two_triangulations(sites: &Sites) -> Pairs {
        let bits = |p: &Point<f64>| [(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()];
        let mut points = sites.points().to_vec();
        let mut seen: HashSet<[u64; 2]> = points.iter().map(bits).collect();
        // Centres of faces on one circle may coincide, and a centre may be a site: that one then guards the place.
        points.extend(circumcentres(sites).into_iter().map(admissible).filter(|centre| seen.insert(bits(centre))));
        delaunay_edges(&points).into_iter().filter(|edge| (edge[1] as usize) < sites.len()).collect()
    }

    #[test]
    fn one_triangulation_gives_what_two_give() {
        let mut state = 7_u64;
        let mut unit = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24)
        };
        let mut edges = 0;
        for round in 0..200 {
            let points: Vec<_> = (0..60)
                .map(|i| match round % 4 {
                    0 => Point::new(unit(), unit()),
                    // Flat slivers at the hull.
                    1 => Point::new(unit(), 1e-3 * unit()),
                    // Two noisy circles.
                    _ => {
                        let (angle, r) = (f64::from(i) * 0.2618, 1.0 + 0.02 * unit() + f64::from(i % 2));
                        Point::new(r * angle.cos() + 1e-4 * unit(), r * angle.sin() + 1e-4 * unit())
                    }
                })
                .collect();
            let sites = Sites::new(&points).expect("finite");
            let (mut one, mut two) = (Crust.pairs(&sites), two_triangulations(&sites));
            one.sort_unstable();
            two.sort_unstable();
            assert_eq!(one, two, "round {round}");
            edges += one.len();
        }
        assert!(edges > 5000, "{edges} edges agree");
    }

    #[test]
    fn right_sums_count() {
        // A square: each side has an angle of 45° opposite, the diagonal two of 90°.
        let sites = |list: &[[f64; 2]]| Sites::new(&list.iter().map(|p| Point::new(p[0], p[1])).collect::<Vec<_>>());
        let square = sites(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]).expect("finite");
        assert_eq!(Crust.pairs(&square).len(), 4, "sides only");
        let two = sites(&[[-2.0, 0.0], [0.0, -1.0], [2.0, 0.0], [0.0, 1.0]]).expect("finite");
        assert!(!Crust.pairs(&two).contains(&[1, 3]), "twice 53.13° are too many");
        let three = sites(&[[-6.0, 0.0], [0.0, -2.0], [1.5, 0.0], [0.0, 2.0]]).expect("finite");
        // tan 18.43° · … : 2·atan(1/3) and 2·atan(4/3), 143.13° together.
        assert!(!Crust.pairs(&three).contains(&[1, 3]), "nor these");
        let exact = sites(&[[-6.0, 0.0], [0.0, -2.0], [4.0, 0.0], [0.0, 2.0]]).expect("finite");
        // 2·atan(1/3) and 2·atan(1/2): 36.87° + 53.13°.
        let edge = exact.edges().iter().find(|edge| edge.ends == [1, 3]).expect("the diagonal");
        assert!(one_step(&exact, edge), "exactly 90°");
    }
}
