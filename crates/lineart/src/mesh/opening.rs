//! How small triangles should be at ends and corners of lines, for the sake of what is simulated on them.
//!
//! At a vertex where lines leave an opening of angle ω > π, a solution with given values on them behaves like r^(π/ω): at a
//! stroke's end (ω = 2π) like √r. Its derivatives have no bound there, and in a mesh of one size d that place spoils the
//! solution by O(d^(2π/ω)), while elsewhere linear elements err by O(d²) (Grisvard 1985; Babuška 1970). With triangles of
//! size s at the vertex and growing with the distance, the two are in balance where s^(π/ω) ∝ d, that is
//!
//! ```text
//! s = d · (d / c)^(ω/π − 1)
//! ```
//!
//! with a length c; so s = d where lines are straight, and s ∝ d² at the end of a stroke. Geometrically growing triangles
//! around a few vertices cost little: some dozens each.

use std::f64::consts::{PI, TAU};

use feature_sampling::geometry::Point;

use super::size::Wish;

/// Wishes of the vertices of some lines for triangles that are nowhere larger than `largest`; `scale` is c. None where
/// `largest` is no smaller than `scale`.
pub(super) fn wishes(points: &[Point<f64>], edges: &[[u32; 2]], largest: f64, scale: f64) -> Vec<Wish> {
    let mut out = Vec::new();
    if largest.is_nan() || largest >= scale {
        return out;
    }
    let mut around: Vec<(u32, u32)> = edges.iter().flat_map(|&[a, b]| [(a, b), (b, a)]).collect();
    around.sort_unstable();
    let mut directions: Vec<f64> = Vec::new();
    for ends in around.chunk_by(|a, b| a.0 == b.0) {
        let Some(&(vertex, _)) = ends.first() else { continue };
        let here = points[vertex as usize];
        directions.clear();
        directions.extend(ends.iter().map(|&(_, end)| {
            let leg = points[end as usize].minus(&here);
            leg.y.atan2(leg.x)
        }));
        // Also where the lines are shorter than that: it bounds how fast triangles grow beyond them.
        let size = largest * (largest / scale).powf(widest_opening(&mut directions) / PI - 1.0);
        if size < largest {
            out.push(Wish { point: here, size });
        }
    }
    out
}

/// What the end of a stroke asks for: d²/c, or d where that is no smaller; nothing where there is no largest size.
pub(super) fn at_an_end(largest: f64, scale: f64) -> f64 {
    if largest.is_finite() { largest * (largest / scale).min(1.0) } else { 0.0 }
}

/// The largest angle between neighbouring directions, of a full turn for one.
fn widest_opening(directions: &mut [f64]) -> f64 {
    directions.sort_by(f64::total_cmp);
    let turn = directions.first().zip(directions.last()).map_or(TAU, |(first, last)| first + TAU - last);
    directions.windows(2).map(|pair| pair[1] - pair[0]).fold(turn, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_ask_for_the_square_and_straight_lines_for_nothing() {
        // A stroke of three points with a right angle at the last but one, and a straight joint before it.
        let points = [[0.0, 0.0], [10.0, 0.0], [20.0, 0.0], [20.0, 10.0]].map(|[x, y]| Point::new(x, y));
        let edges = [[0, 1], [1, 2], [2, 3]];
        let found = wishes(&points, &edges, 1.0, 4.0);
        let sizes: Vec<(f64, f64)> = found.iter().map(|wish| (wish.point.x + wish.point.y, wish.size)).collect();
        let expected = [(0.0, 0.25), (20.0, 0.5), (30.0, 0.25)];
        assert_eq!(sizes.len(), 3, "two ends and a corner: {sizes:?}");
        for (found, expected) in sizes.iter().zip(expected) {
            assert!(found.0 == expected.0 && (found.1 - expected.1).abs() < 1e-12, "{sizes:?}");
        }
        assert_eq!(at_an_end(1.0, 4.0), found[0].size, "the same rule");
        assert_eq!(at_an_end(5.0, 4.0), 5.0, "no smaller than the scale");
        assert_eq!(at_an_end(f64::INFINITY, 4.0), 0.0, "no largest size");
        assert!(wishes(&points, &edges, 4.0, 4.0).is_empty(), "no smaller than the scale");
        assert!(wishes(&points, &edges, f64::INFINITY, 4.0).is_empty(), "no largest size");
    }

    #[test]
    fn openings() {
        assert_eq!(widest_opening(&mut [1.0]), TAU);
        assert!((widest_opening(&mut [PI / 2.0, 0.0, PI]) - PI).abs() < 1e-15);
        assert!((widest_opening(&mut [3.0, -3.0]) - 6.0).abs() < 1e-12, "across the cut of the arc tangent");
    }
}
