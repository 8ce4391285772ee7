//! NN-Crust (Dey, Kumar 1999).
//!
//! Each site is joined to its nearest neighbour and to its half-neighbour: the nearest Delaunay neighbour on the far side,
//! at an angle of at least 90° from the nearest one. Proved to be correct below ε = 1/3 for closed curves. An end of an
//! open curve is joined to nothing more if no site lies in its far half-plane. O(n log n).
//!
//! As first described, only sites with one edge after the first step look for a half-neighbour ([`Seekers::DegreeOne`]).
//! That form leaves undersampled places alone and is right more often; the numbers printed in the paper agree with the
//! textbook form, in which every site looks ([`Seekers::All`]).

use super::angle::is_wide;
use super::sites::Sites;
use super::{Pairs, Reconstruction};

/// Which sites look for a half-neighbour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Seekers {
    /// Every site.
    #[default]
    All,
    /// Sites with a single edge in the nearest-neighbour graph.
    DegreeOne,
}

/// NN-Crust.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NnCrust {
    /// Which sites look for a half-neighbour.
    pub seekers: Seekers,
}

impl Reconstruction for NnCrust {
    fn pairs(&self, sites: &Sites) -> Pairs {
        let graph = NearestGraph::new(sites);
        let mut pairs = graph.pairs(sites);
        for p in sites.numbers() {
            if self.seekers == Seekers::DegreeOne && graph.degree(p) != 1 {
                continue;
            }
            let Some(q) = sites.nearest(p) else { continue };
            let wide = |r: &u32| *r != q && is_wide(sites.point(p), sites.point(q), sites.point(*r));
            pairs.extend(sites.neighbours(p).find(wide).map(|r| [p, r]));
        }
        pairs
    }
}

/// The graph of nearest neighbours: what NN-Crust and its relatives start from.
pub(crate) struct NearestGraph {
    /// Numbers of its edges, ascending.
    pub(crate) edges: Vec<u32>,
    degrees: Vec<u32>,
}

impl NearestGraph {
    pub(crate) fn new(sites: &Sites) -> Self {
        let mut edges: Vec<u32> = sites.numbers().filter_map(|p| sites.nearest_edge(p)).collect();
        edges.sort_unstable();
        edges.dedup();
        let mut degrees = vec![0; sites.len()];
        for end in edges.iter().flat_map(|&edge| sites.edge(edge).ends) {
            degrees[end as usize] += 1;
        }
        Self { edges, degrees }
    }

    pub(crate) fn degree(&self, site: u32) -> u32 {
        self.degrees[site as usize]
    }

    pub(crate) fn pairs(&self, sites: &Sites) -> Pairs {
        self.edges.iter().map(|&edge| sites.edge(edge).ends).collect()
    }
}
