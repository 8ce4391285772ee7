//! Edges between consecutive samples that no Delaunay triangulation of all samples has.
//!
//! An edge ab is in some Delaunay triangulation exactly if some circle through a and b has no sample inside: the
//! definition itself is tested, with exact predicates, and no triangulation is built. On each side of ab the sample
//! that sees ab under the widest angle demands the most; the edge exists if the one on the right is not inside the
//! circle through a, b and the one on the left. Samples on the open segment forbid it. Ties (cocircular samples) thus
//! count as present. The work is quadratic, but an edge whose diametral disc holds no sample is done at once.

use crate::condition::Sample;
use crate::plane::V2;
use crate::tree::Tree;
use robust::{Coord, incircle, orient2d};

fn coord(p: V2) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

/// Whether some circle through a and b has none of the points inside.
fn present(a: V2, b: V2, points: &[V2]) -> bool {
    let (ca, cb) = (coord(a), coord(b));
    let mut widest: [Option<Coord<f64>>; 2] = [None, None];
    for &p in points {
        if p == a || p == b {
            continue;
        }
        let c = coord(p);
        let side = orient2d(ca, cb, c);
        if side == 0.0 {
            if (p - a).dot(p - b) < 0.0 {
                return false;
            }
            continue;
        }
        let left = side > 0.0;
        let best = &mut widest[usize::from(left)];
        // incircle wants its first three points anticlockwise.
        let wider =
            |old: Coord<f64>| if left { incircle(ca, cb, old, c) > 0.0 } else { incircle(cb, ca, old, c) > 0.0 };
        if best.is_none_or(wider) {
            *best = Some(c);
        }
    }
    match widest {
        [Some(right), Some(left)] => incircle(ca, cb, left, right) <= 0.0,
        _ => true,
    }
}

/// The edges that are missing, as pairs of indices.
pub(crate) fn missing(samples: &[Sample], edges: &[(usize, usize)]) -> Vec<(usize, usize)> {
    let points: Vec<V2> = samples.iter().map(|s| s.point).collect();
    let tree = Tree::new(points.iter().map(|&p| (p, p)));
    let mut out = Vec::new();
    for &(i, j) in edges {
        let (a, b) = (points[i], points[j]);
        if a == b {
            continue;
        }
        let radius = 0.5 * a.distance(b);
        let crowd = tree.within((a + b) * 0.5, radius * (1.0 + 1e-9));
        if crowd.iter().all(|&(k, _)| points[k] == a || points[k] == b) || present(a, b, &points) {
            continue;
        }
        out.push((i, j));
    }
    out
}
