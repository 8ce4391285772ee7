//! Crawl (Parakkat, Muthuganapathy 2016).
//!
//! A component starts at the shortest edge between a site and its nearest neighbour whose ends are both free, and grows at
//! either end by the shorter of the two edges to the nearest free Delaunay neighbour, until neither end has one. Before
//! each step it may close: once more than three sites have been added, if one end is the other's second-nearest neighbour
//! of all. For ε-samples, with no constant proved. O(n log n).
//!
//! Consequences of the rule, not of this program: a loop of five sites never closes, nothing keeps a walk from leaping to
//! another curve, and an end may find its second-nearest neighbour too early. At equal lengths the end that was seeded with
//! the higher site number grows.

use super::sites::Sites;
use super::{Pairs, Reconstruction};

/// Sites that have to be added before a component may close.
const BEFORE_CLOSING: u32 = 4;

/// Crawl; it has no parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Crawl;

impl Reconstruction for Crawl {
    fn pairs(&self, sites: &Sites) -> Pairs {
        let mut visited = vec![false; sites.len()];
        // How many of a site's edges lead to visited sites for certain, from the shortest on: no edge is looked at twice.
        let mut skipped = vec![0_usize; sites.len()];
        let mut pairs = Vec::new();
        let seeds = (0_u32..)
            .zip(sites.edges())
            .filter(|(number, edge)| edge.ends.iter().any(|&end| sites.nearest_edge(end) == Some(*number)));
        for (_, seed) in seeds {
            if seed.ends.iter().any(|&end| visited[end as usize]) {
                continue;
            }
            pairs.push(seed.ends);
            seed.ends.iter().for_each(|&end| visited[end as usize] = true);
            let mut tips = seed.ends;
            let mut grown = 0;
            loop {
                if grown >= BEFORE_CLOSING && closes(sites, tips) {
                    pairs.push(tips);
                    break;
                }
                let step = tips.map(|tip| nearest_free(sites, tip, &visited, &mut skipped));
                let grows = match step {
                    [None, None] => break,
                    [Some(a), Some(b)] => usize::from(sites.edge(b).length_sq <= sites.edge(a).length_sq),
                    [a, _] => usize::from(a.is_none()),
                };
                let Some(edge) = step[grows] else { break };
                let next = sites.edge(edge).other(tips[grows]);
                pairs.push([tips[grows], next]);
                visited[next as usize] = true;
                tips[grows] = next;
                grown += 1;
            }
        }
        pairs
    }
}

/// One of two sites is the second-nearest Delaunay neighbour of the other.
fn closes(sites: &Sites, [a, b]: [u32; 2]) -> bool {
    sites.neighbours(a).nth(1) == Some(b) || sites.neighbours(b).nth(1) == Some(a)
}

/// The shortest edge from `tip` to a site that is not visited. Sites never become free again.
fn nearest_free(sites: &Sites, tip: u32, visited: &[bool], skipped: &mut [usize]) -> Option<u32> {
    let edges = sites.edges_at(tip);
    let from = &mut skipped[tip as usize];
    while let Some(&edge) = edges.get(*from) {
        if !visited[sites.edge(edge).other(tip) as usize] {
            return Some(edge);
        }
        *from += 1;
    }
    None
}
