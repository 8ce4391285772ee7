//! In which order points go into a triangulation.
//!
//! Incremental insertion costs a walk to the point and flips around it. Points along curves are the worst input for orders
//! that sweep: long triangles across the empty middle are flipped again and again. A *biased randomised insertion order*
//! (Amenta, Choi and Rote 2003) avoids both: in each round about half of the points that are left, a random half, so that
//! the flips are few in expectation whatever the points; and within a round along Hilbert's curve, so that the next point
//! is near the last one. The random choice depends on the number of a point alone: the same input has the same order.

use feature_sampling::geometry::{Aabb, Point};

/// Cells of Hilbert's curve along each axis, as a power of two.
const BITS: u32 = 16;

/// The numbers of all points in the order in which to insert them.
pub(super) fn order(points: &[Point<f64>]) -> Vec<u32> {
    let bounds = Aabb::around(points);
    let extent = bounds.extent();
    let largest = f64::from((1_u32 << BITS) - 1);
    let scale = largest / extent.x.max(extent.y).max(f64::MIN_POSITIVE);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the cells, or saturated")]
    let cell = |v: f64| (v * scale).min(largest) as u32;
    let mut keys: Vec<(u32, u64, u32)> = (0..)
        .zip(points)
        .map(|(number, p)| {
            let place = hilbert(cell(p.x - bounds.min.x), cell(p.y - bounds.min.y));
            // Late rounds are large ones.
            (u32::MAX - round(number), place, number)
        })
        .collect();
    keys.sort_unstable();
    keys.into_iter().map(|(.., number)| number).collect()
}

/// The round of a point, counted from the last: half of all points are in round 0, a quarter in 1, and so on.
fn round(number: u32) -> u32 {
    // The mixer of SplitMix64 (Steele, Lea and Flood 2014).
    let mut z = (u64::from(number) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z ^ (z >> 31)).trailing_zeros()
}

/// How far along Hilbert's curve a cell is.
fn hilbert(mut x: u32, mut y: u32) -> u64 {
    let mut along = 0;
    for level in (0..BITS).rev() {
        let (right, up) = ((x >> level) & 1, (y >> level) & 1);
        along = (along << 2) | u64::from((3 * right) ^ up);
        // The quarters at the ends are turned.
        if up == 0 {
            if right == 1 {
                (x, y) = (!x, !y);
            }
            (x, y) = (y, x);
        }
    }
    along
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_on_the_curve_are_neighbours_in_the_plane() {
        let side = 1_u32 << (BITS - 3);
        let mut cells: Vec<(u64, i32, i32)> = Vec::new();
        for x in 0..8_u32 {
            for y in 0..8_u32 {
                cells.push((hilbert(x * side, y * side), x.cast_signed(), y.cast_signed()));
            }
        }
        cells.sort_unstable();
        for pair in cells.windows(2) {
            let ((a, ax, ay), (b, bx, by)) = (pair[0], pair[1]);
            assert!(a < b, "no two cells in one place");
            assert_eq!((ax - bx).abs() + (ay - by).abs(), 1, "{pair:?}");
        }
    }

    #[test]
    fn every_point_once_and_the_last_half_last() {
        let points: Vec<_> = (0..1000).map(|i| Point::new(f64::from(i % 37), f64::from(i % 11))).collect();
        let order = order(&points);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..1000).collect::<Vec<_>>());
        let last = order.iter().rev().take_while(|number| round(**number) == 0).count();
        assert!((400..600).contains(&last), "{last} points in the last round");
        assert!(super::order(&[]).is_empty());
        assert_eq!(super::order(&[Point::new(1.0, 1.0); 1]), [0]);
    }
}
