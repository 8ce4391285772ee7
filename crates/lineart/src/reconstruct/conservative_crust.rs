//! ConservativeCrust (Dey, Mehlhorn, Ramos 2000), as far as it is known.
//!
//! **A reconstruction.** Known from the literature: it starts from the Gabriel graph (the Delaunay edges whose diametral
//! disk is empty), keeps an edge only if it is well apart from an estimate of the medial axis, and is governed by a
//! parameter; what it outputs is justified for any input, so open curves stay open. The exact test was not at hand. Two
//! forms were compared with the printed results:
//!
//! * [`Separation::Disk`]: a Gabriel edge stays if the disk of `factor` times half its length around its midpoint holds no
//!   Voronoi vertex. 1/√2 fits best. A *smaller* factor gives fewer exact results: more chords survive.
//! * [`Separation::Medial`]: the medial axis is estimated by the Voronoi edges dual to the Delaunay edges that are dropped,
//!   a Gabriel edge is dropped if its midpoint is nearer to that estimate than `factor` times its length, and so on until
//!   nothing changes. 0.46 fits best. Dropping an edge only ever adds to the estimate, hence the final set does not depend
//!   on the order; each drop asks once which midpoint disks its dual edge meets.
//!
//! O(n log n).

use std::cmp::Ordering;

use feature_sampling::geometry::Point;

use super::angle::dot_sign;
use super::disks::Disks;
use super::kd::Kd;
use super::sites::{OUTER, Sites};
use super::voronoi::circumcentres;
use super::{Pairs, Reconstruction};

/// What "well apart from the medial axis" means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Separation {
    /// No Voronoi vertex within `factor` times half the edge's length from its midpoint.
    Disk {
        /// Above 0.
        factor: f64,
    },
    /// No dual of a dropped edge within `factor` times the edge's length from its midpoint.
    Medial {
        /// Above 0.
        factor: f64,
    },
}

/// ConservativeCrust.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConservativeCrust {
    /// What keeps an edge.
    pub separation: Separation,
}

impl Default for ConservativeCrust {
    fn default() -> Self {
        Self { separation: Separation::Disk { factor: std::f64::consts::FRAC_1_SQRT_2 } }
    }
}

impl ConservativeCrust {
    /// The second form with the factor that fits best.
    pub const MEDIAL: Self = Self { separation: Separation::Medial { factor: 0.46 } };
}

impl Reconstruction for ConservativeCrust {
    fn pairs(&self, sites: &Sites) -> Pairs {
        let centres = circumcentres(sites);
        let gabriel = gabriel(sites);
        let middle = |edge: u32| {
            let [a, b] = sites.edge(edge).ends;
            sites.point(a).middle(&sites.point(b))
        };
        let edges = (0..).take(sites.edges().len());
        let kept: Vec<u32> = match self.separation {
            Separation::Disk { factor } => {
                let kd = Kd::new(&centres);
                let reach = factor * factor / 4.0;
                let free = |edge: &u32| !kd.any_within(&middle(*edge), reach * sites.edge(*edge).length_sq);
                edges.filter(|&edge| gabriel[edge as usize]).filter(free).collect()
            }
            Separation::Medial { factor } => {
                let mut dropped: Vec<u32> = edges.clone().filter(|&edge| !gabriel[edge as usize]).collect();
                let alive: Vec<u32> = edges.filter(|&edge| gabriel[edge as usize]).collect();
                let disk = |&edge: &u32| (middle(edge), factor * sites.edge(edge).length());
                let mut disks = Disks::new(alive.iter().map(disk).collect());
                let mut met = Vec::new();
                let mut gone = vec![false; alive.len()];
                while let Some(edge) = dropped.pop() {
                    let [from, to] = dual(sites, &centres, edge);
                    disks.take_meeting(&from, &to, &mut met);
                    for place in met.drain(..) {
                        gone[place as usize] = true;
                        dropped.push(alive[place as usize]);
                    }
                }
                alive.into_iter().zip(gone).filter_map(|(edge, gone)| (!gone).then_some(edge)).collect()
            }
        };
        kept.into_iter().map(|edge| sites.edge(edge).ends).collect()
    }
}

/// Which Delaunay edges have an empty diametral disk: the angle opposite of them is nowhere obtuse.
pub fn gabriel(sites: &Sites) -> Vec<bool> {
    let mut kept = vec![true; sites.edges().len()];
    for face in sites.faces() {
        for (corner, side) in face.corners.into_iter().zip(face.sides) {
            let [a, b] = sites.edge(side).ends;
            if dot_sign(sites.point(corner), sites.point(a), sites.point(b)) == Ordering::Less {
                kept[side as usize] = false;
            }
        }
    }
    kept
}

/// The Voronoi edge between the sites of a Delaunay edge. Where it is a ray, four times the hull's size of it.
fn dual(sites: &Sites, centres: &[Point<f64>], edge: u32) -> [Point<f64>; 2] {
    /// Scaled coordinates are below 2 in size.
    const FAR: f64 = 16.0;
    let edge = sites.edge(edge);
    let [a, b] = edge.ends.map(|end| sites.point(end));
    let along = b.minus(&a);
    let unit = along.norm();
    match edge.faces {
        [OUTER, OUTER] => {
            let m = a.middle(&b);
            let out = Point::new(-along.y / unit * FAR, along.x / unit * FAR);
            [Point::new(m.x - out.x, m.y - out.y), Point::new(m.x + out.x, m.y + out.y)]
        }
        [OUTER, face] | [face, OUTER] => {
            let centre = centres[face as usize];
            let corners = sites.face(face).corners;
            let apex = corners.into_iter().find(|corner| !edge.ends.contains(corner)).map_or(a, |c| sites.point(c));
            let left = along.x * (apex.y - a.y) - along.y * (apex.x - a.x) > 0.0;
            let out = if left { FAR } else { -FAR };
            [centre, Point::new(centre.x + along.y / unit * out, centre.y - along.x / unit * out)]
        }
        [left, right] => [centres[left as usize], centres[right as usize]],
    }
}
