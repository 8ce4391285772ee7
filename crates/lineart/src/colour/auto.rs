//! Seeds where nobody has given a hint.
//!
//! A face whose own widest passage is much wider than the way by which colour reached it belongs to a room of its own: it
//! becomes a seed, the widest such face first, until there is none. "Much wider" is the factor γ; the rule is that of the
//! gap factor of Blender's fill. Sealed rooms are rooms in any case. Each seed costs a flood, so components that do not
//! touch each other are treated one by one.

use super::flood::{Flood, components, widest};
use super::plane::{NONE, Plane};

/// How rooms are found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Auto {
    /// A face that is reached through a passage narrower than this share of its own widest one is in another room; between
    /// 0 and 1.
    pub gamma: f64,
    /// Rooms with a smaller share of the area of the drawing's box are not looked for.
    pub least_area: f64,
    /// At most this many seeds.
    pub limit: usize,
}

impl Default for Auto {
    fn default() -> Self {
        Self { gamma: 0.7, least_area: 1e-4, limit: 1000 }
    }
}

/// Adds seeds, numbered from `next` on, to the faces that `flood` has reached from `seeds`; answers all seeds and the flood
/// from them. Openings narrower than `max_gap` (squared, lattice units) part rooms whatever γ says.
pub(super) fn rooms(
    plane: &Plane<'_>,
    seeds: &[(u32, u32)],
    mut next: u32,
    auto: &Auto,
    max_gap: u128,
) -> (Vec<(u32, u32)>, Flood) {
    let parts = components(plane, |_, _, side| side.chain == NONE);
    let mut by_part: Vec<Vec<u32>> = vec![Vec::new(); plane.faces.len()];
    for (part, face) in parts.iter().zip(0_u32..) {
        by_part[*part as usize].push(face);
    }
    let box_area: f64 = {
        let n = plane.noded.vertices.iter().map(|v| v.point);
        let bounds = feature_sampling::geometry::Aabb::around(n.collect::<Vec<_>>().iter());
        bounds.extent().x * bounds.extent().y
    };
    // As squared lengths go, so do areas: a room is at least about as large as a triangle over its widest passage.
    let least = auto.least_area * box_area / (plane.unit * plane.unit);
    let widths: Vec<u128> = (0..).take(plane.faces.len()).map(|face| widest(plane, face)).collect();
    let mut all = seeds.to_vec();
    let mut flood = Flood::empty(plane);
    for faces in by_part.iter().filter(|faces| !faces.is_empty()) {
        let mut own: Vec<(u32, u32)> =
            seeds.iter().copied().filter(|(face, _)| parts[*face as usize] == parts[faces[0] as usize]).collect();
        let area: f64 = faces.iter().map(|face| plane.area(*face)).sum();
        if own.is_empty() && area < auto.least_area * box_area {
            continue;
        }
        loop {
            for face in faces {
                flood.source[*face as usize] = NONE;
            }
            flood.grow(plane, &own, |_, _| true);
            let foreign = |face: &&u32| {
                let (width, own) = (flood.width_sq(plane, **face), widths[**face as usize]);
                let unreached = flood.source[**face as usize] == NONE;
                unreached
                    || (own as f64 >= least
                        && width != u128::MAX
                        && ((width as f64) < auto.gamma * auto.gamma * own as f64
                            || (width < max_gap && own >= max_gap)))
            };
            let seed =
                faces.iter().filter(foreign).max_by_key(|face| (widths[**face as usize], std::cmp::Reverse(**face)));
            let Some(seed) = seed.filter(|_| all.len() < auto.limit) else { break };
            own.push((*seed, next));
            all.push((*seed, next));
            next += 1;
        }
    }
    (all, flood)
}
