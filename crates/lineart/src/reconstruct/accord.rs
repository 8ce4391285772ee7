//! Accord: greedy matching of edges that agree with what stands at both of their ends. Ours, from no paper.
//!
//! The nearest-neighbour graph is taken first: in a good sample all its edges are right. Then all other Delaunay edges are
//! looked at, shortest first. One is accepted if both its ends have fewer than two edges and it makes at least 90° with the
//! edge that stands there, if one does. So a site decides by the edge that it really has, where NN-Crust and its relatives
//! go by its nearest neighbour alone; and a long edge finds the places taken that shorter ones had a better claim to.
//!
//! No constant is proved. Below ε = 0.765 all angles at samples of the curve are at least 90° (they are at least
//! π − 4·asin(ε/2)), so no true edge is refused by another true one. Open curves stay open, several curves are no
//! difficulty, corners sharper than 90° lose an edge. A degree exceeds 2 only where nearest neighbours meet.
//! O(n log n).

use super::angle::is_wide;
use super::nn_crust::NearestGraph;
use super::sites::Sites;
use super::{Pairs, Reconstruction};

/// Accord.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Accord {
    /// Start from the nearest-neighbour graph; without, from nothing, which costs some exact results.
    pub seeded: bool,
}

impl Default for Accord {
    fn default() -> Self {
        Self { seeded: true }
    }
}

impl Reconstruction for Accord {
    fn pairs(&self, sites: &Sites) -> Pairs {
        let mut accepted = Accepted { sites, others: vec![[None; 2]; sites.len()] };
        let mut pairs = Vec::new();
        if self.seeded {
            pairs = NearestGraph::new(sites).pairs(sites);
            pairs.iter().for_each(|&ends| accepted.take(ends));
        }
        for edge in sites.edges() {
            let [a, b] = edge.ends;
            if accepted.agrees(a, b) && accepted.agrees(b, a) {
                accepted.take(edge.ends);
                pairs.push(edge.ends);
            }
        }
        pairs
    }
}

struct Accepted<'s> {
    sites: &'s Sites,
    /// The other ends of a site's edges, up to two of them.
    others: Vec<[Option<u32>; 2]>,
}

impl Accepted<'_> {
    fn take(&mut self, [a, b]: [u32; 2]) {
        for (at, to) in [(a, b), (b, a)] {
            if let Some(place) = self.others[at as usize].iter_mut().find(|place| place.is_none()) {
                *place = Some(to);
            }
        }
    }

    /// An edge from `at` to `to` is new there, has a place there, and a wide angle.
    fn agrees(&self, at: u32, to: u32) -> bool {
        match self.others[at as usize] {
            [None, _] => true,
            [Some(q), None] => q != to && is_wide(self.sites.point(at), self.sites.point(q), self.sites.point(to)),
            _ => false,
        }
    }
}
