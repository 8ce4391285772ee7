//! SIGDT, also SIG-Connect2D (Marin, Ohrhallinger, Wimmer 2022).
//!
//! The frame is the spheres-of-influence graph within the Delaunay triangulation: sites are joined if the circles about
//! them through their nearest neighbours meet, |pq| ≤ r(p) + r(q). Edges are added until it is connected and no degree is
//! below two, as in Connect2D, and the same inflating and sculpturing follows ([`super::solid`]). The graph contains the
//! curve below ε = 0.5 where the lengths of neighbouring edges have a ratio below 2. Closed curves only. O(n log n).
//!
//! The article speaks of a *dual* of Connect2D's steps, whose exact form was not at hand; this form agrees with its results.
//! Joining glues several outlines into one polygon ([`Loops::One`]). [`Loops::Components`] takes each component of the graph
//! by itself instead, with a triangulation of its own, so that nested outlines do not flood each other.

use super::connect2d::connect;
use super::sites::Sites;
use super::solid::polygon;
use super::union::Union;
use super::{Pairs, Reconstruction};

/// What is made of several components of the graph.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Loops {
    /// They are joined into one polygon.
    #[default]
    One,
    /// A polygon of each.
    Components,
}

/// SIGDT.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sigdt {
    /// What is made of several components.
    pub loops: Loops,
}

impl Reconstruction for Sigdt {
    fn pairs(&self, sites: &Sites) -> Pairs {
        let mut frame = influence(sites);
        if self.loops == Loops::One {
            connect(sites, &mut frame);
            return polygon(sites, &frame);
        }
        let mut union = Union::new(sites.len());
        for (edge, _) in sites.edges().iter().zip(&frame).filter(|(_, taken)| **taken) {
            union.join(edge.ends);
        }
        // Sites by component, ascending within each.
        let mut members: Vec<(u32, u32)> = sites.numbers().map(|site| (union.find(site), site)).collect();
        members.sort_unstable();
        let mut pairs = Vec::new();
        for component in members.chunk_by(|a, b| a.0 == b.0) {
            let chosen: Vec<u32> = component.iter().map(|&(_, site)| site).collect();
            let part = sites.subset(&chosen);
            let within = |edge: &super::sites::Edge| {
                let [a, b] = edge.ends.map(|end| chosen[end as usize]);
                sites.edge_between(a, b).is_some_and(|edge| frame[edge as usize])
            };
            let mut frame: Vec<bool> = part.edges().iter().map(within).collect();
            connect(&part, &mut frame);
            pairs.extend(polygon(&part, &frame).into_iter().map(|ends| ends.map(|end| chosen[end as usize])));
        }
        pairs
    }
}

/// Which Delaunay edges belong to the spheres-of-influence graph.
pub fn influence(sites: &Sites) -> Vec<bool> {
    let radius: Vec<f64> =
        sites.numbers().map(|site| sites.nearest_edge(site).map_or(0.0, |edge| sites.edge(edge).length())).collect();
    let meets = |edge: &super::sites::Edge| edge.length() <= edge.ends.iter().map(|&end| radius[end as usize]).sum();
    sites.edges().iter().map(meets).collect()
}
