//! Local feature size: the distance from a point to the dense medial axis, coarse or polished.
//!
//! The coarse value is the distance to the chords between neighbouring medial points; its error is the slack that
//! [`crate::foot`] measured, a few 1e-4 of the radius at most. The polished value takes every stretch whose chord lies
//! within its slack of the nearest one and minimises the distance to the true centre f + r·d over the foot's parameter,
//! computing disks anew. Golden sections do not mind kinks, and ends of stretches are medial points themselves, so
//! branch tips at curvature extrema and at joints, which decide lfs more often than not, are met exactly.

use crate::disk::Scene;
use crate::foot::Medial;
use crate::plane::{V2, minimise};
use crate::tree::Tree;

/// A local feature size and the medial point that gives it.
#[derive(Clone, Copy, Debug)]
pub struct Feature {
    /// Distance to the medial axis; infinite if there is none.
    pub lfs: f64,
    /// The nearest medial point, if there is a medial axis.
    pub medial: Option<V2>,
}

/// The evaluator.
pub(crate) struct Evaluator {
    pub(crate) scene: Scene,
    pub(crate) medial: Medial,
    tree: Tree,
}

impl Evaluator {
    /// Computes the medial axis of a scene.
    pub(crate) fn new(scene: Scene, special: &[V2]) -> Evaluator {
        let medial = Medial::new(&scene, special);
        let tree = Tree::new(medial.links.iter().map(|l| (l.a, l.b)));
        Evaluator { scene, medial, tree }
    }

    /// Radius of the largest empty tangent disk at a place of a path (obstacle, parameter, run backwards).
    pub(crate) fn radius(&self, place: (usize, f64, bool), left: bool) -> f64 {
        let (cubic, t, reversed) = place;
        self.medial.side(&self.scene, cubic, t, if left == reversed { -1.0 } else { 1.0 }).radius()
    }

    /// Distance to the chords, and the slack of the nearest.
    pub(crate) fn coarse(&self, p: V2) -> (f64, f64) {
        match self.tree.nearest(p, f64::INFINITY) {
            Some((i, d)) => (d, self.medial.links[i].slack),
            None => (f64::INFINITY, 0.0),
        }
    }

    /// Distance to the medial axis, polished.
    pub(crate) fn fine(&self, p: V2) -> Feature {
        let Some((nearest, coarse)) = self.tree.nearest(p, f64::INFINITY) else {
            return Feature { lfs: f64::INFINITY, medial: None };
        };
        let slack = self.medial.links[nearest].slack;
        let widest = slack.max(2e-3 * coarse);
        let mut near = self.tree.within(p, coarse + slack + widest);
        near.sort_by(|a, b| (a.1, a.0).partial_cmp(&(b.1, b.0)).unwrap_or(std::cmp::Ordering::Equal));
        // Vertices are medial points: the nearest of them bounds from above at no cost.
        let mut best = Feature { lfs: f64::INFINITY, medial: None };
        let mut offer = |lfs: f64, at: V2| {
            if lfs < best.lfs {
                best = Feature { lfs, medial: Some(at) };
            }
            best.lfs
        };
        let mut bound = f64::INFINITY;
        for &(i, _) in &near {
            let l = &self.medial.links[i];
            bound = offer(p.distance(l.a), l.a).min(bound);
            bound = offer(p.distance(l.b), l.b).min(bound);
        }
        let mut done: Vec<(usize, f64, f64)> = Vec::new();
        for &(i, d) in &near {
            let l = &self.medial.links[i];
            let known = done.iter().any(|&(s, lo, hi)| s == l.strand && lo <= l.x[0] && l.x[1] <= hi);
            if l.x[0] == l.x[1] || d - l.slack >= bound || known {
                continue;
            }
            // The minimum may hide in the neighbour if the nearest point of the chord is an end of it.
            let (_, place) = p.distance_to_segment(l.a, l.b);
            let (mut lo, mut hi) = (l.x[0], l.x[1]);
            if place < 0.05 && i > 0 {
                let n = &self.medial.links[i - 1];
                if n.strand == l.strand && n.x[1] == lo {
                    lo = n.x[0];
                }
            }
            if place > 0.95 && i + 1 < self.medial.links.len() {
                let n = &self.medial.links[i + 1];
                if n.strand == l.strand && n.x[0] == hi {
                    hi = n.x[1];
                }
            }
            let mut touch = self.medial.hint(i);
            // The centre in the middle halves the chord; the bend that it shows is all but quartered by that. Most
            // stretches are out of the race after this one disk.
            let middle = self.medial.disk(&self.scene, l.strand, 0.5 * (l.x[0] + l.x[1]), touch);
            touch = middle.touch;
            if let Some(m) = middle.centre() {
                bound = offer(p.distance(m), m).min(bound);
                let off = m.distance_to_segment(l.a, l.b).0;
                let left = p.distance_to_segment(l.a, m).0.min(p.distance_to_segment(m, l.b).0);
                if left - off - 1e-4 * l.a.distance(l.b) >= bound {
                    continue;
                }
            }
            let mut closest = (f64::INFINITY, p);
            let scene = &self.scene;
            minimise(
                |x| {
                    let disk = self.medial.disk(scene, l.strand, x, touch);
                    touch = disk.touch;
                    let Some(m) = disk.centre() else { return f64::MAX };
                    let d = p.distance(m);
                    if d < closest.0 {
                        closest = (d, m);
                    }
                    d
                },
                lo,
                hi,
                1e-8 * (hi - lo),
            );
            bound = offer(closest.0, closest.1).min(bound);
            done.push((l.strand, lo, hi));
        }
        best
    }
}
