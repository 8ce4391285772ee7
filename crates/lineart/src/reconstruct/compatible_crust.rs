//! CompatibleCrust (Bjerkevik, Birkner 2022), as far as it is known.
//!
//! **A reconstruction.** Of the article only the abstract was at hand: an algorithm "similar to NN-Crust", in any
//! dimension, correct for ε ≤ 0.66 on closed curves. The rule here was found from that theorem and from the numbers printed
//! for it; agreement with those numbers is therefore no independent confirmation. Independent evidence: it is right on
//! every true ε-sample with ε ≤ 0.66 that the tests make.
//!
//! An edge has to fit at *both* of its ends, not only at the one that proposes it. Edge pr is compatible if at each end it
//! makes at least 90° with the edge to that end's nearest neighbour, or is that edge. Each site with a single edge in the
//! nearest-neighbour graph gets its shortest compatible Delaunay edge ([`Form::DegreeOne`]). In the other form
//! ([`Form::Mutual`]) every site proposes one and those proposed from both ends are kept. O(n log n).
//!
//! Open curves come out well; a corner sharper than 90° loses an edge. Degrees can exceed 2 in the first form.

use super::angle::is_wide;
use super::nn_crust::NearestGraph;
use super::sites::{Sites, ascending};
use super::{Pairs, Reconstruction};

/// Who proposes edges and which proposals count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// Sites with a single edge propose, and all proposals count.
    #[default]
    DegreeOne,
    /// Every site proposes; what both ends propose counts.
    Mutual,
}

/// CompatibleCrust.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CompatibleCrust {
    /// Who proposes edges and which proposals count.
    pub form: Form,
}

impl Reconstruction for CompatibleCrust {
    fn pairs(&self, sites: &Sites) -> Pairs {
        let graph = NearestGraph::new(sites);
        let mut proposed: Pairs = Vec::new();
        for p in sites.numbers() {
            if self.form == Form::DegreeOne && graph.degree(p) != 1 {
                continue;
            }
            let q = sites.nearest(p);
            let fitting = |r: &u32| Some(*r) != q && fits(sites, p, *r) && fits(sites, *r, p);
            proposed.extend(sites.neighbours(p).find(fitting).map(|r| ascending([p, r])));
        }
        let mut pairs = graph.pairs(sites);
        match self.form {
            Form::DegreeOne => pairs.append(&mut proposed),
            Form::Mutual => {
                proposed.sort_unstable();
                pairs.extend(proposed.windows(2).filter(|w| w[0] == w[1]).map(|w| w[0]));
            }
        }
        pairs
    }
}

/// The edge from `at` to `to` fits at its end `at`.
fn fits(sites: &Sites, at: u32, to: u32) -> bool {
    sites.nearest(at).is_none_or(|q| q == to || is_wide(sites.point(at), sites.point(q), sites.point(to)))
}
