//! Regions and their boundaries.
//!
//! Faces of one colour that are joined across open sides are a region. A half-edge of a region's face bounds it if the face
//! beyond is in another region; a stroke with the same region on both sides ends inside it and bounds nothing. Loops have
//! the region on their left; at a vertex that several loops touch, the next half-edge is found by turning through the
//! region's own fan of faces, so that touching loops stay separate.

use super::plane::{NONE, Plane};

/// A half-edge of a boundary.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub(super) from: u32,
    pub(super) to: u32,
    pub(super) side: u32,
    /// The region beyond, or [`NONE`] at the frame.
    pub(super) beyond: u32,
}

/// The loops of each region, by region number of each face.
pub(super) fn loops(plane: &Plane<'_>, region_of: &[u32], count: usize) -> Vec<Vec<Vec<Step>>> {
    let region = |face: u32| if face == NONE { NONE } else { region_of[face as usize] };
    let mut done = vec![[false; 3]; plane.faces.len()];
    let mut out: Vec<Vec<Vec<Step>>> = vec![Vec::new(); count];
    for start in 0..plane.faces.len() {
        for corner in 0..3 {
            let own = region_of[start];
            if done[start][corner] || region(plane.faces[start].beyond[corner]) == own {
                continue;
            }
            let mut steps = Vec::new();
            let (mut face, mut i) = (start, corner);
            while !done[face][i] {
                done[face][i] = true;
                let f = &plane.faces[face];
                steps.push(Step {
                    from: f.corners[i],
                    to: f.corners[(i + 1) % 3],
                    side: f.sides[i],
                    beyond: region(f.beyond[i]),
                });
                // Turn around the end of this half-edge through faces of the region.
                i = (i + 1) % 3;
                while region(plane.faces[face].beyond[i]) == own {
                    let (side, next) = (plane.faces[face].sides[i], plane.faces[face].beyond[i] as usize);
                    let Some(back) = plane.faces[next].sides.iter().position(|s| *s == side) else { break };
                    face = next;
                    i = (back + 1) % 3;
                }
            }
            out[own as usize].push(steps);
        }
    }
    out
}
