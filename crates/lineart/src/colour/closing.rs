//! How the gaps between regions are closed.
//!
//! A gap is a side of the triangulation with different regions beside it and no stroke on it. Where it starts or ends at
//! the free end of a stroke, a cubic continues the stroke's tangent there, if it stays within the two triangles of the side
//! and crosses neither a curve nor another closing; otherwise the gap is closed by its straight side.
//!
//! A straight side crosses no chord, but chords stand for curves that bulge, near ones and, where chords are long, far
//! ones. All pieces of curve whose boxes meet that of a closing are looked at. Where a straight closing would cut through
//! one of them the curve is to be sampled more densely ([`bulges`]) and everything done again.

use std::collections::{HashMap, HashSet};

use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::{Aabb, Point, Vector};

use super::plane::{NONE, Plane};
use crate::node::pairs::Boxes;
use crate::node::{Owner, Track};

/// How gap sides are closed other than straight, by side, for all regions alike: the inner control points from the lower
/// vertex on.
pub(super) type Closings = HashMap<u32, [Point<f64>; 2]>;

/// Chords of a closing, and of a piece of curve, when they are asked whether they cross.
const CHORDS: u32 = 16;

/// A side between two regions that no stroke lies on.
struct Gap {
    side: u32,
    /// Vertices, the lower first.
    ends: [u32; 2],
    faces: [u32; 2],
}

fn gaps(plane: &Plane<'_>, region_of: &[u32]) -> Vec<Gap> {
    let mut out = Vec::new();
    for (face, number) in plane.faces.iter().zip(0_u32..) {
        for i in 0..3 {
            let (side, beyond) = (face.sides[i], face.beyond[i]);
            let is_open = beyond != NONE && beyond > number && plane.sides[side as usize].chain == NONE;
            if is_open && region_of[number as usize] != region_of[beyond as usize] {
                let (a, b) = (face.corners[i], face.corners[(i + 1) % 3]);
                out.push(Gap { side, ends: [a.min(b), a.max(b)], faces: [number, beyond] });
            }
        }
    }
    out
}

/// Works out how the gap sides between regions are closed.
pub(super) fn closings(plane: &Plane<'_>, region_of: &[u32]) -> Closings {
    let tangents = stroke_ends(plane);
    let mut wanted: Vec<(u32, [Point<f64>; 2])> = Vec::new();
    let mut lines: Vec<Vec<Point<f64>>> = Vec::new();
    for gap in gaps(plane, region_of) {
        let [start, end] = gap.ends.map(|v| plane.point(v));
        let chord = end.minus(&start);
        let third = chord.norm() / 3.0;
        let handle = |vertex: u32, towards: &Vector<f64>| {
            let smooth = tangents.get(&vertex).filter(|tangent| tangent.dot(towards) > 0.0);
            smooth.map(|tangent| tangent.scaled(&third))
        };
        let (first, last) = (handle(gap.ends[0], &chord), handle(gap.ends[1], &chord.opposite()));
        if first.is_none() && last.is_none() {
            continue;
        }
        let straight = chord.scaled(&(1.0 / 3.0));
        let controls = [start.plus(&first.unwrap_or(straight)), end.plus(&last.unwrap_or(straight.opposite()))];
        let cubic = Cubic::new(start, controls[0], controls[1], end);
        let line: Vec<Point<f64>> = (0..=CHORDS).map(|i| cubic.eval(&(f64::from(i) / f64::from(CHORDS)))).collect();
        if line[1..CHORDS as usize].iter().all(|p| is_inside(plane, gap.faces, p)) {
            wanted.push((gap.side, controls));
            lines.push(line);
        }
    }
    let mut refused = HashSet::new();
    meetings(plane, &lines, |closing, _| {
        refused.insert(closing);
    });
    // Closings that are left may cross each other: the later one gives way.
    let boxes = Boxes::new(lines.iter().map(Aabb::around).collect());
    let mut pairs = Vec::new();
    boxes.overlapping(|_| true, |i, j| pairs.push((i as usize, j as usize)));
    pairs.sort_unstable();
    for (i, j) in pairs {
        if !refused.contains(&i) && !refused.contains(&j) && cross(&lines[i], &lines[j]) {
            refused.insert(j);
        }
    }
    wanted.into_iter().zip(0..).filter(|(_, number)| !refused.contains(number)).map(|(closing, _)| closing).collect()
}

/// Pieces of paths that a straight side between two regions crosses because they bulge beyond their chords: paths and
/// parameters where another sample is needed.
pub(super) fn bulges(plane: &Plane<'_>, region_of: &[u32]) -> Vec<(usize, f64)> {
    let lines: Vec<Vec<Point<f64>>> =
        gaps(plane, region_of).iter().map(|gap| gap.ends.map(|v| plane.point(v)).to_vec()).collect();
    let mut out = Vec::new();
    meetings(plane, &lines, |_, owner| out.push((owner.path as usize, 0.5 * (owner.at[0] + owner.at[1]))));
    out.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    out.dedup();
    out
}

/// Directions in which strokes would go on at their free ends.
fn stroke_ends(plane: &Plane<'_>) -> HashMap<u32, Vector<f64>> {
    let mut out = HashMap::new();
    for edge in &plane.noded.edges {
        let Some(owner) = plane.noded.owners(edge).first() else { continue };
        let Some(path) = plane.paths.get(owner.path as usize) else { continue };
        let track = Track::new(&path.cubics);
        for i in 0..2 {
            if plane.degrees[edge.ends[i] as usize] != 1 {
                continue;
            }
            // Where the derivative vanishes the chord of a short stretch shows the direction.
            let (at, other) = (owner.at[i], owner.at[1 - i]);
            let inside = at + (other - at) * 1e-3;
            let direction = track.eval_around(at).minus(&track.eval_around(inside));
            if let Some(unit) = direction.unit() {
                out.insert(edge.ends[i], unit);
            }
        }
    }
    out
}

/// A point lies in one of two faces.
fn is_inside(plane: &Plane<'_>, faces: [u32; 2], p: &Point<f64>) -> bool {
    faces.iter().any(|&face| {
        let corners = plane.faces[face as usize].corners.map(|v| plane.point(v));
        (0..3).all(|i| {
            let (a, b) = (&corners[i], &corners[(i + 1) % 3]);
            b.minus(a).cross(&p.minus(a)) >= 0.0
        })
    })
}

/// Calls `found` with the number of each polyline and the owner of each piece of curve that cross, ends aside.
fn meetings(plane: &Plane<'_>, lines: &[Vec<Point<f64>>], mut found: impl FnMut(usize, &Owner)) {
    if lines.is_empty() {
        return;
    }
    // Owners beyond the first lie on it.
    let pieces: Vec<&Owner> = plane.noded.edges.iter().filter_map(|edge| plane.noded.owners(edge).first()).collect();
    let hull = |owner: &&Owner| {
        let [from, to] = [owner.at[0].min(owner.at[1]), owner.at[0].max(owner.at[1])];
        let cubics = plane.paths.get(owner.path as usize).map_or(&[][..], |path| &path.cubics);
        let mut bounds = Aabb::empty();
        Track::new(cubics).cubics(from, to).for_each(|cubic| bounds.merge(&cubic.control_box()));
        bounds
    };
    let boxes = Boxes::new(lines.iter().map(Aabb::around).chain(pieces.iter().map(hull)).collect());
    let count = lines.len();
    boxes.overlapping(
        |i| (i as usize) < count,
        |i, j| {
            let (line, piece) = (i as usize, (j as usize).checked_sub(count));
            if let Some(owner) = piece.and_then(|piece| pieces.get(piece))
                && cross(&lines[line], &chords(plane, owner))
            {
                found(line, owner);
            }
        },
    );
}

/// A piece of curve as a polyline.
fn chords(plane: &Plane<'_>, owner: &Owner) -> Vec<Point<f64>> {
    let Some(path) = plane.paths.get(owner.path as usize) else { return Vec::new() };
    let track = Track::new(&path.cubics);
    let [from, to] = owner.at;
    (0..=CHORDS).map(|i| track.eval_around(from + (to - from) * f64::from(i) / f64::from(CHORDS))).collect()
}

/// Two polylines cross properly.
fn cross(first: &[Point<f64>], second: &[Point<f64>]) -> bool {
    let side = |a: &Point<f64>, b: &Point<f64>, p: &Point<f64>| b.minus(a).cross(&p.minus(a));
    first.windows(2).any(|p| {
        second.windows(2).any(|q| {
            side(&p[0], &p[1], &q[0]) * side(&p[0], &p[1], &q[1]) < 0.0
                && side(&q[0], &q[1], &p[0]) * side(&q[0], &q[1], &p[1]) < 0.0
        })
    })
}
