//! Crust (Amenta, Bern, Eppstein 1998).
//!
//! An edge belongs to the crust if some circle through its ends holds neither a site nor a Voronoi vertex: the Voronoi
//! vertices of a dense sample lie near the medial axis, which a true edge's circle stays away from. In two triangulations:
//! that of the sites P gives the Voronoi vertices V, and the edges of that of P ∪ V with both ends in P are the crust.
//! Proved to be correct below ε = 0.252 for smooth closed curves. O(n log n).
//!
//! Several curves and open ones are fine in practice; nothing keeps a degree from being 1 or 3. The guarantee that is left
//! in floating point: the second triangulation is exact about the *rounded* Voronoi vertices.

use std::collections::HashSet;

use super::sites::{Sites, delaunay_edges};
use super::voronoi::circumcentres;
use super::{Pairs, Reconstruction};

/// Crust; it has no parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Crust;

impl Reconstruction for Crust {
    fn pairs(&self, sites: &Sites) -> Pairs {
        let bits = |p: &feature_sampling::geometry::Point<f64>| [(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()];
        let mut points = sites.points().to_vec();
        let count = points.len();
        let mut seen: HashSet<[u64; 2]> = points.iter().map(bits).collect();
        for centre in circumcentres(sites) {
            // Centres of faces on one circle may coincide, and a centre may be a site: that one then guards the place.
            let centre = super::sites::admissible(centre);
            if seen.insert(bits(&centre)) {
                points.push(centre);
            }
        }
        delaunay_edges(&points).into_iter().filter(|edge| (edge[1] as usize) < count).collect()
    }
}
