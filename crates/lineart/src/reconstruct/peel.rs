//! Peel (Parakkat, Methirumangalath, Muthuganapathy 2018).
//!
//! Every Delaunay triangle loses its longest side: what is left, the Urquhart graph, holds the curve and some chords. Then
//! an edge stays if at each of its ends fewer than two other edges of that graph are shorter; all edges are judged at once.
//! For ε-samples, with no constant proved. Open, closed and several curves alike. O(n log n).
//!
//! All sides that are longest lose, if several are: the rounded lengths of three points of a regular pattern decide. The
//! last step of its authors' program, which removes self-intersections by a factor that is 0 in the study, does nothing
//! there and is left out: the result is part of a triangulation and does not intersect itself.

use super::sites::Sites;
use super::{Pairs, Reconstruction};

/// Peel; it has no parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Peel;

impl Reconstruction for Peel {
    fn pairs(&self, sites: &Sites) -> Pairs {
        let urquhart = urquhart(sites);
        // Fewer than two are shorter where the edge is no longer than the second shortest.
        let limits: Vec<f64> = sites
            .numbers()
            .map(|site| {
                let mut kept = sites.edges_at(site).iter().filter(|&&edge| urquhart[edge as usize]);
                kept.nth(1).map_or(f64::INFINITY, |&edge| sites.edge(edge).length_sq)
            })
            .collect();
        let kept = (0_u32..).zip(sites.edges()).filter(|&(number, edge)| {
            urquhart[number as usize] && edge.ends.iter().all(|&end| edge.length_sq <= limits[end as usize])
        });
        kept.map(|(_, edge)| edge.ends).collect()
    }
}

/// Which Delaunay edges are longest in no triangle.
pub fn urquhart(sites: &Sites) -> Vec<bool> {
    let mut kept = vec![true; sites.edges().len()];
    for face in sites.faces() {
        let lengths = face.sides.map(|side| sites.edge(side).length_sq);
        let longest = lengths.into_iter().fold(0.0, f64::max);
        for (side, length) in face.sides.into_iter().zip(lengths) {
            if length >= longest {
                kept[side as usize] = false;
            }
        }
    }
    kept
}
