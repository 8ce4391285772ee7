//! Which colour reaches a face first through the widest passages.
//!
//! From the faces of the hints a maximum spanning forest grows: of all sides that colour could cross next, the longest is
//! crossed. Each of its paths is a widest path (its narrowest side is as long as that of any other path), so two colours
//! meet at the narrowest passage between them, and there is no threshold that says what a gap is. Strokes are never
//! crossed. Lengths are compared exactly and ties go by the number of the side, so the order in which hints are given
//! plays no role. Cost: O(n log n). Source: Parakkat, Memari, Cani, "Delaunay Painting", 2022, whose flow rule
//! (`flow(next) = min(flow, length)`, largest flow wins) decides the same wherever flows differ.

use std::collections::BinaryHeap;

use super::plane::{NONE, Plane, Side};

/// What reached each face.
#[derive(Clone, Debug)]
pub(super) struct Flood {
    /// Number of the seed, or [`NONE`].
    pub(super) source: Vec<u32>,
    /// Rank of the narrowest side on the way from the seed; [`NONE`] at seeds.
    width: Vec<u32>,
}

impl Flood {
    pub(super) fn empty(plane: &Plane<'_>) -> Self {
        let count = plane.faces.len();
        Self { source: vec![NONE; count], width: vec![0; count] }
    }

    /// Squared length of the narrowest side on the way from the seed; the largest number at seeds.
    pub(super) fn width_sq(&self, plane: &Plane<'_>, face: u32) -> u128 {
        let side = plane.by_rank.get(self.width[face as usize] as usize);
        side.map_or(u128::MAX, |side| side_of(plane, *side).length_sq)
    }

    /// Grows from seeds (a face and the number of its source) over faces that nothing has reached. `enters` may refuse a
    /// face that would be entered through a side.
    pub(super) fn grow(&mut self, plane: &Plane<'_>, seeds: &[(u32, u32)], enters: impl Fn(u32, u128) -> bool) {
        let mut heap = BinaryHeap::new();
        let push = |heap: &mut BinaryHeap<_>, face: u32, source: u32, width: u32| {
            let f = &plane.faces[face as usize];
            for (&side, &beyond) in f.sides.iter().zip(&f.beyond) {
                let Side { chain, rank, .. } = side_of(plane, side);
                if chain == NONE && beyond != NONE {
                    heap.push((rank, beyond, source, width));
                }
            }
        };
        for &(face, source) in seeds {
            let here = &mut self.source[face as usize];
            if *here == NONE {
                *here = source;
                self.width[face as usize] = NONE;
                push(&mut heap, face, source, NONE);
            }
        }
        while let Some((rank, face, source, width)) = heap.pop() {
            if self.source[face as usize] != NONE
                || !enters(face, side_of(plane, plane.by_rank[rank as usize]).length_sq)
            {
                continue;
            }
            let width = width.min(rank);
            self.source[face as usize] = source;
            self.width[face as usize] = width;
            push(&mut heap, face, source, width);
        }
    }
}

fn side_of(plane: &Plane<'_>, side: u32) -> Side {
    plane.sides[side as usize]
}

/// The squared length of the longest side of a face that colour can cross; 0 if there is none.
pub(super) fn widest(plane: &Plane<'_>, face: u32) -> u128 {
    let f = &plane.faces[face as usize];
    let open = |(side, beyond): (&u32, &u32)| {
        let Side { length_sq, chain, .. } = side_of(plane, *side);
        (chain == NONE && *beyond != NONE).then_some(length_sq)
    };
    f.sides.iter().zip(&f.beyond).filter_map(open).max().unwrap_or(0)
}

/// Faces joined across sides that `joins` holds for; each face gets the smallest number of its set.
pub(super) fn components(plane: &Plane<'_>, joins: impl Fn(u32, u32, Side) -> bool) -> Vec<u32> {
    let mut parent: Vec<u32> = (0..).take(plane.faces.len()).collect();
    for (face, number) in plane.faces.iter().zip(0_u32..) {
        for (&side, &beyond) in face.sides.iter().zip(&face.beyond) {
            if beyond != NONE && beyond > number && joins(number, beyond, side_of(plane, side)) {
                let (a, b) = (root(&mut parent, number), root(&mut parent, beyond));
                parent[a.max(b) as usize] = a.min(b);
            }
        }
    }
    (0..).take(parent.len()).map(|i| root(&mut parent, i)).collect()
}

fn root(parent: &mut [u32], mut i: u32) -> u32 {
    while parent[i as usize] != i {
        parent[i as usize] = parent[parent[i as usize] as usize];
        i = parent[i as usize];
    }
    i
}
