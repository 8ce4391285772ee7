//! Connect2D (Ohrhallinger, Mudur 2013).
//!
//! Looks for a short closed polygon through all points. The frame is grown as Kruskal's minimum spanning tree, except that
//! an edge is also taken if an end still has fewer than two; then the solid it encloses is inflated and sculptured
//! ([`super::solid`]). Proved below ε = 0.5 where the lengths of neighbouring edges have a ratio below 1.609. One outline:
//! an open curve gets closed and several curves become one polygon. Sharp corners are no difficulty. O(n log n).
//!
//! The details of the frame are inferred from the three-dimensional sibling of the algorithm.

use super::sites::Sites;
use super::solid::polygon;
use super::union::Union;
use super::{Pairs, Reconstruction};

/// Connect2D; it has no parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Connect2d;

impl Reconstruction for Connect2d {
    fn pairs(&self, sites: &Sites) -> Pairs {
        let mut frame = vec![false; sites.edges().len()];
        connect(sites, &mut frame);
        polygon(sites, &frame)
    }
}

/// Adds edges to a frame, shortest first, that join two components or give an end its first or second edge.
pub(crate) fn connect(sites: &Sites, frame: &mut [bool]) {
    let mut union = Union::new(sites.len());
    let mut degree = vec![0_u32; sites.len()];
    for (edge, _) in sites.edges().iter().zip(frame.iter()).filter(|(_, taken)| **taken) {
        union.join(edge.ends);
        edge.ends.iter().for_each(|&end| degree[end as usize] += 1);
    }
    for (edge, taken) in sites.edges().iter().zip(frame) {
        if *taken {
            continue;
        }
        let joins = union.join(edge.ends);
        if joins || edge.ends.iter().any(|&end| degree[end as usize] < 2) {
            *taken = true;
            edge.ends.iter().for_each(|&end| degree[end as usize] += 1);
        }
    }
}
