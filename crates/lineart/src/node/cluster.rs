//! Points that are as good as one.
//!
//! Strokes that meet have ends that differ by rounding, and would round to different lattice points where they happen to
//! stand on both sides of a border. So each point is replaced by the first one before it that is within a radius.

use std::collections::HashMap;

use feature_sampling::geometry::Point;

/// Points seen so far, in squares as large as the radius.
#[derive(Debug)]
pub(super) struct Clusters {
    radius: f64,
    origin: Point<f64>,
    /// Looked up only, never listed: the order of the map plays no role.
    squares: HashMap<[i64; 2], Vec<Point<f64>>>,
}

impl Clusters {
    pub(super) fn new(radius: f64, origin: Point<f64>) -> Self {
        Self { radius, origin, squares: HashMap::new() }
    }

    #[expect(clippy::cast_possible_truncation, reason = "within ±2^53; checked at the door")]
    fn square(&self, p: &Point<f64>) -> [i64; 2] {
        [(p.x - self.origin.x) / self.radius, (p.y - self.origin.y) / self.radius].map(|v| v.floor() as i64)
    }

    /// The first point that was asked about within the radius; this one, if there was none.
    pub(super) fn first(&mut self, p: Point<f64>) -> Point<f64> {
        let [x, y] = self.square(&p);
        let near = (-1..=1)
            .flat_map(|dx| (-1..=1).map(move |dy| [x + dx, y + dy]))
            .filter_map(|square| self.squares.get(&square))
            .flatten()
            .find(|other| other.distance(&p) <= self.radius);
        match near {
            Some(first) => *first,
            None => {
                self.squares.entry([x, y]).or_default().push(p);
                p
            }
        }
    }
}
