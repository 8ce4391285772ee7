//! From a connected graph to one polygon: the boundary of a solid of Delaunay triangles, inflated and then sculptured.
//!
//! Connect2D (Ohrhallinger, Mudur 2013) and SIGDT (Marin, Ohrhallinger, Wimmer 2022) end with these steps, known from the
//! three-dimensional sibling of the former. Given some Delaunay edges, the *frame*:
//!
//! 1. Faces that can be reached from outside the hull without crossing the frame are outside, all others are the solid. Its
//!    *boundary* are the edges between inside and outside, and *walls*, edges of the frame with both sides outside.
//! 2. About a site, the outside faces form runs, cut by walls and by inside faces: its *wedges*. A site of a simple polygon
//!    has one, an interior site none. While a site has two or more, the solid is **inflated**: of the outside faces that
//!    have a boundary edge at such a site, the one that changes the boundary's length least joins (the sum of its sides that
//!    are not boundary minus the sum of those that are).
//! 3. While a site is interior, the solid is **sculptured**: of the inside faces with a boundary side and an interior site
//!    opposite of it, the one that lengthens the boundary least leaves.
//!
//! The boundary is then one simple polygon through all sites, unless step 3 found no face for some of them: those are
//! missed. Without any face (collinear sites) the frame itself is the answer.
//!
//! **Cost.** O(n log n), with heaps whose stale entries are recognised when they come up. The number of wedges at a site
//! is the number of its edges at which a run starts (counter-clockwise: outside after the edge, and inside before it or a
//! wall at it), or one if no run starts and some face is outside; so one face changes it in constant time, at however
//! many edges. A site that gets its second wedge has at most four boundary edges, so that pushing the faces beside them is
//! cheap too, where pushing all faces about it would not be.
//!
//! **Ties.** Equal costs go to the face with the lower corners.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::Pairs;
use super::sites::{OUTER, Sites};

/// The polygon that the frame leads to; `frame` says of each edge of `sites` whether it belongs to it.
pub(crate) fn polygon(sites: &Sites, frame: &[bool]) -> Pairs {
    let mut solid = Solid::new(sites, frame);
    solid.inflate();
    solid.sculpture();
    let boundary = (0_u32..).zip(sites.edges()).filter(|(number, _)| solid.is_boundary(*number));
    boundary.map(|(_, edge)| edge.ends).collect()
}

/// An entry of a heap: cost, corners, face.
#[derive(Clone, Copy, PartialEq)]
struct Candidate {
    cost: f64,
    corners: [u32; 3],
    face: u32,
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.cost.total_cmp(&other.cost).then(self.corners.cmp(&other.corners)).then(self.face.cmp(&other.face))
    }
}

struct Solid<'s> {
    sites: &'s Sites,
    inside: Vec<bool>,
    /// Edges of the frame; they are walls where both sides are outside.
    frame: Vec<bool>,
    /// Of each site, the faces about it that are outside; the one beyond the hull counts once for each of its edges.
    outside: Vec<u32>,
    /// Of each site, its edges at which a run of outside faces starts.
    starts: Vec<u32>,
    /// Of each site, edges that became boundary at some time.
    rims: Vec<Vec<u32>>,
}

impl<'s> Solid<'s> {
    fn new(sites: &'s Sites, frame: &[bool]) -> Self {
        let mut inside = vec![true; sites.faces().len()];
        let mut pending = Vec::new();
        for (edge, &barred) in sites.edges().iter().zip(frame) {
            if !barred && edge.faces.contains(&OUTER) {
                pending.push(edge.across(OUTER));
            }
        }
        while let Some(face) = pending.pop() {
            // Collinear sites have edges with the outer face on both sides.
            if face == OUTER || !std::mem::replace(&mut inside[face as usize], false) {
                continue;
            }
            for side in sites.face(face).sides {
                if !frame[side as usize] {
                    pending.push(sites.edge(side).across(face));
                }
            }
        }
        let count = sites.len();
        let mut solid = Self {
            sites,
            inside,
            frame: frame.to_vec(),
            outside: vec![0; count],
            starts: vec![0; count],
            rims: vec![Vec::new(); count],
        };
        for edge in (0..).take(sites.edges().len()) {
            let ends = sites.edge(edge).ends;
            for (place, site) in ends.into_iter().enumerate() {
                let [_, after] = solid.before_and_after(edge, place);
                solid.outside[site as usize] += u32::from(!solid.is_inside(after));
                solid.starts[site as usize] += u32::from(solid.run_starts(edge, place));
                if solid.is_boundary(edge) {
                    solid.rims[site as usize].push(edge);
                }
            }
        }
        solid
    }

    fn is_inside(&self, face: u32) -> bool {
        face != OUTER && self.inside[face as usize]
    }

    /// The faces clockwise and counter-clockwise of an edge about one of its ends. (Which is which does not matter, as long
    /// as it is the same for all edges at a site: the edge's faces are those left and right of one direction.)
    fn before_and_after(&self, edge: u32, place: usize) -> [u32; 2] {
        let faces = self.sites.edge(edge).faces;
        if place == 0 { [faces[1], faces[0]] } else { faces }
    }

    fn run_starts(&self, edge: u32, place: usize) -> bool {
        let [before, after] = self.before_and_after(edge, place);
        !self.is_inside(after) && (self.is_inside(before) || self.frame[edge as usize])
    }

    fn is_boundary(&self, edge: u32) -> bool {
        let [a, b] = self.sites.edge(edge).faces.map(|face| self.is_inside(face));
        a != b || (!a && !b && self.frame[edge as usize])
    }

    fn wedges(&self, site: u32) -> u32 {
        match self.starts[site as usize] {
            0 => u32::from(self.outside[site as usize] > 0),
            starts => starts,
        }
    }

    /// Puts a face on the other side; `frame` edges among its sides lose that role if it leaves the solid.
    fn turn(&mut self, face: u32) {
        let sides = self.sites.face(face).sides;
        let joins = !self.inside[face as usize];
        let count = |solid: &mut Self, add: bool| {
            for side in sides {
                for (place, site) in solid.sites.edge(side).ends.into_iter().enumerate() {
                    let starts = u32::from(solid.run_starts(side, place));
                    let total = &mut solid.starts[site as usize];
                    *total = if add { *total + starts } else { *total - starts };
                }
            }
        };
        count(self, false);
        let was = sides.map(|side| self.is_boundary(side));
        self.inside[face as usize] = joins;
        if !joins {
            sides.iter().for_each(|&side| self.frame[side as usize] = false);
        }
        count(self, true);
        for corner in self.sites.face(face).corners {
            let total = &mut self.outside[corner as usize];
            *total = if joins { *total - 1 } else { *total + 1 };
        }
        for (side, was) in sides.into_iter().zip(was) {
            if !was && self.is_boundary(side) {
                for end in self.sites.edge(side).ends {
                    self.rims[end as usize].push(side);
                }
            }
        }
    }

    fn candidate(&self, face: u32, cost: f64) -> Reverse<Candidate> {
        Reverse(Candidate { cost, corners: self.sites.face(face).corners, face })
    }

    /// What inflating by a face would add to the boundary's length; `None` if it is not a candidate.
    fn growth(&self, face: u32) -> Option<f64> {
        if face == OUTER || self.inside[face as usize] {
            return None;
        }
        let (mut eligible, mut sum) = (false, 0.0);
        for side in self.sites.face(face).sides {
            let edge = self.sites.edge(side);
            if self.is_boundary(side) {
                eligible |= edge.ends.iter().any(|&end| self.wedges(end) >= 2);
                sum -= edge.length();
            } else {
                sum += edge.length();
            }
        }
        eligible.then_some(sum)
    }

    fn inflate(&mut self) {
        let sites = self.sites;
        let mut heap = BinaryHeap::new();
        for face in (0..).take(sites.faces().len()) {
            heap.extend(self.growth(face).map(|cost| self.candidate(face, cost)));
        }
        while let Some(Reverse(Candidate { cost, face, .. })) = heap.pop() {
            // A stale entry: a newer one with the cost of now was pushed when the cost changed.
            if self.growth(face) != Some(cost) {
                continue;
            }
            let corners = sites.face(face).corners;
            let before = corners.map(|corner| self.wedges(corner));
            self.turn(face);
            for side in sites.face(face).sides {
                let beyond = sites.edge(side).across(face);
                heap.extend(self.growth(beyond).map(|cost| self.candidate(beyond, cost)));
            }
            for (corner, before) in corners.into_iter().zip(before) {
                if before < 2 && self.wedges(corner) >= 2 {
                    let mut rim = std::mem::take(&mut self.rims[corner as usize]);
                    rim.retain(|&edge| self.is_boundary(edge));
                    for beside in rim.iter().flat_map(|&edge| sites.edge(edge).faces) {
                        heap.extend(self.growth(beside).map(|cost| self.candidate(beside, cost)));
                    }
                    self.rims[corner as usize] = rim;
                }
            }
        }
    }

    /// What sculpturing a face away would add to the boundary's length; `None` if it is not a candidate.
    fn carving(&self, face: u32) -> Option<f64> {
        if !self.is_inside(face) {
            return None;
        }
        let shape = self.sites.faces().get(face as usize)?;
        let mut best: Option<f64> = None;
        for (corner, side) in shape.corners.into_iter().zip(shape.sides) {
            if self.wedges(corner) == 0 && self.is_boundary(side) {
                let length = |side: u32| self.sites.edge(side).length();
                let cost = shape.sides.into_iter().map(|s| if s == side { -length(s) } else { length(s) }).sum();
                best = Some(best.map_or(cost, |b| b.min(cost)));
            }
        }
        best
    }

    fn sculpture(&mut self) {
        let sites = self.sites;
        let mut heap = BinaryHeap::new();
        for face in (0..).take(sites.faces().len()) {
            heap.extend(self.carving(face).map(|cost| self.candidate(face, cost)));
        }
        while let Some(Reverse(Candidate { cost, face, .. })) = heap.pop() {
            if self.carving(face) != Some(cost) {
                continue;
            }
            self.turn(face);
            for side in sites.face(face).sides {
                let beyond = sites.edge(side).across(face);
                heap.extend(self.carving(beyond).map(|cost| self.candidate(beyond, cost)));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reconstruct::connect2d::connect;
    use feature_sampling::geometry::Point;

    /// The steps of the module's header by rescanning everything, with wedges counted around each site by angle.
    struct Rescan<'s> {
        sites: &'s Sites,
        inside: Vec<bool>,
        frame: Vec<bool>,
    }

    impl Rescan<'_> {
        fn is_inside(&self, face: u32) -> bool {
            face != OUTER && self.inside[face as usize]
        }

        fn is_boundary(&self, edge: u32) -> bool {
            let [a, b] = self.sites.edge(edge).faces.map(|face| self.is_inside(face));
            a != b || (!a && !b && self.frame[edge as usize])
        }

        fn wedges(&self, site: u32) -> usize {
            let centre = self.sites.point(site);
            let mut spokes: Vec<(f64, u32)> = self
                .sites
                .edges_at(site)
                .iter()
                .map(|&edge| {
                    let v = self.sites.point(self.sites.edge(edge).other(site)).minus(&centre);
                    (v.y.atan2(v.x), edge)
                })
                .collect();
            spokes.sort_by(|a, b| a.0.total_cmp(&b.0));
            // The sector after each spoke, counter-clockwise: the face that two consecutive spokes share, if there is one.
            let sector = |i: usize| {
                let (a, b) = (self.sites.edge(spokes[i].1), self.sites.edge(spokes[(i + 1) % spokes.len()].1));
                let corners = [site, a.other(site), b.other(site)];
                let shared = a
                    .faces
                    .into_iter()
                    .find(|face| *face != OUTER && corners.iter().all(|c| self.sites.face(*face).corners.contains(c)));
                shared.is_some_and(|face| self.is_inside(face))
            };
            let n = spokes.len();
            let inside: Vec<bool> = (0..n).map(sector).collect();
            let wall = |i: usize| self.frame[spokes[i].1 as usize];
            let starts = (0..n).filter(|&i| !inside[i] && (inside[(i + n - 1) % n] || wall(i))).count();
            if starts == 0 { usize::from(inside.iter().any(|i| !i)) } else { starts }
        }

        fn best(&self, cost: impl Fn(u32) -> Option<f64>) -> Option<u32> {
            let faces = (0..).take(self.sites.faces().len());
            let candidates = faces.filter_map(|face| Some((cost(face)?, self.sites.face(face).corners, face)));
            candidates.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))).map(|best| best.2)
        }

        fn length(&self, edge: u32) -> f64 {
            self.sites.edge(edge).length()
        }

        fn run(mut self) -> Pairs {
            loop {
                let growth = |face: u32| {
                    let sides = self.sites.face(face).sides;
                    let eligible = |&side: &u32| {
                        self.is_boundary(side) && self.sites.edge(side).ends.iter().any(|&end| self.wedges(end) >= 2)
                    };
                    let sign = |side: u32| if self.is_boundary(side) { -1.0 } else { 1.0 };
                    (!self.is_inside(face) && sides.iter().any(eligible))
                        .then(|| sides.into_iter().map(|side| sign(side) * self.length(side)).sum())
                };
                let Some(face) = self.best(growth) else { break };
                self.inside[face as usize] = true;
            }
            self.frame.fill(false);
            loop {
                let carving = |face: u32| {
                    let shape = self.sites.face(face);
                    let places = (0..3).filter(|&i| {
                        self.is_inside(face) && self.is_boundary(shape.sides[i]) && self.wedges(shape.corners[i]) == 0
                    });
                    let cost =
                        |i: usize| (0..3).map(|k| if k == i { -1.0 } else { 1.0 } * self.length(shape.sides[k])).sum();
                    places.map(cost).min_by(f64::total_cmp)
                };
                let Some(face) = self.best(carving) else { break };
                self.inside[face as usize] = false;
            }
            let edges = (0..).take(self.sites.edges().len());
            edges.filter(|&edge| self.is_boundary(edge)).map(|edge| self.sites.edge(edge).ends).collect()
        }
    }

    #[test]
    fn heaps_give_what_rescanning_gives() {
        let mut state = 3_u64;
        let mut unit = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24)
        };
        // So many because a site that becomes free of wedges and gets them again is rare: the first is in round 265.
        for round in 0..1500 {
            let points: Vec<_> = (0..40).map(|_| Point::new(unit(), unit() * f64::from(1 + round % 3))).collect();
            let sites = Sites::new(&points).expect("finite");
            let mut frame = vec![false; sites.edges().len()];
            connect(&sites, &mut frame);
            let start = Solid::new(&sites, &frame);
            let slow = Rescan { sites: &sites, inside: start.inside.clone(), frame: frame.clone() }.run();
            assert_eq!(polygon(&sites, &frame), slow, "round {round}");
        }
    }
}
