//! How large triangles may be, place by place.
//!
//! Uniform: no edge is longer than a length. Graded: features ask for small triangles and the distance from them allows
//! larger ones,
//!
//! ```text
//! size(x) = min( largest, min over places p of  size(p) + growth · |x − p| )
//! ```
//!
//! so neighbouring triangles differ little (the function is `growth`-Lipschitz), and the drawing's own measure of detail
//! decides. Samples ask for a multiple of lfs. It falls to 0 at corners, crossings and stroke ends of no room; a triangle there need not be
//! smaller than the lines that meet there, so each sample counts as much as its shortest line at least. Ends and corners of
//! lines ask for what simulation needs (`opening`).
//!
//! The minimum over all places is found in a tree over them whose nodes know the least that any place below asks for.

use feature_sampling::geometry::Point;

/// The longest that an edge may be.
#[derive(Clone, Debug, Default)]
pub enum Size {
    /// No limit.
    #[default]
    Unbounded,
    /// The same everywhere, in user units.
    Uniform(f64),
    /// By the features.
    Graded(Graded),
}

/// A place that asks for triangles of a size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wish {
    /// Where.
    pub point: Point<f64>,
    /// The size there, in user units.
    pub size: f64,
}

/// See the module's description.
#[derive(Clone, Debug)]
pub struct Graded {
    largest: f64,
    growth: f64,
    /// Permuted: the middle of each range splits it by x or y, in turns.
    wishes: Vec<Wish>,
    /// For each middle, the least size in its range.
    least: Vec<f64>,
}

/// Up to so many wishes are searched one by one.
const LEAF: usize = 6;

impl Graded {
    /// `largest` may be infinite; `growth` is what a unit of distance adds.
    pub fn new(mut wishes: Vec<Wish>, largest: f64, growth: f64) -> Self {
        // One that is large enough everywhere asks for nothing.
        wishes.retain(|wish| wish.size < largest);
        let mut least = vec![f64::INFINITY; wishes.len()];
        let mut ranges = vec![(0, wishes.len(), false)];
        while let Some((from, to, by_y)) = ranges.pop() {
            if from == to {
                continue;
            }
            let middle = from + (to - from) / 2;
            least[middle] = wishes[from..to].iter().fold(f64::INFINITY, |least, wish| least.min(wish.size));
            if to - from <= LEAF {
                continue;
            }
            wishes[from..to]
                .select_nth_unstable_by(middle - from, |a, b| key(&a.point, by_y).total_cmp(&key(&b.point, by_y)));
            ranges.push((from, middle, !by_y));
            ranges.push((middle + 1, to, !by_y));
        }
        Self { largest, growth, wishes, least }
    }

    /// The size at a point.
    pub fn at(&self, p: &Point<f64>) -> f64 {
        let mut best = self.largest;
        self.visit(0, self.wishes.len(), false, p, 0.0, &mut best);
        best
    }

    /// `away`: the range is at least this far from the point.
    fn visit(&self, from: usize, to: usize, by_y: bool, p: &Point<f64>, away: f64, best: &mut f64) {
        if from == to {
            return;
        }
        let middle = from + (to - from) / 2;
        if self.least[middle] + self.growth * away >= *best {
            return;
        }
        let mut offer = |wish: &Wish| *best = best.min(wish.size + self.growth * wish.point.distance(p));
        if to - from <= LEAF {
            self.wishes[from..to].iter().for_each(offer);
            return;
        }
        let wish = &self.wishes[middle];
        offer(wish);
        let beyond = key(p, by_y) - key(&wish.point, by_y);
        let (low, high) = ((from, middle), (middle + 1, to));
        let [near, far] = if beyond < 0.0 { [low, high] } else { [high, low] };
        self.visit(near.0, near.1, !by_y, p, away, best);
        self.visit(far.0, far.1, !by_y, p, away.max(beyond.abs()), best);
    }
}

fn key(p: &Point<f64>, by_y: bool) -> f64 {
    if by_y { p.y } else { p.x }
}

impl Size {
    /// The size at a point; infinite where nothing limits it.
    pub fn at(&self, p: &Point<f64>) -> f64 {
        match self {
            Self::Unbounded => f64::INFINITY,
            Self::Uniform(length) => *length,
            Self::Graded(graded) => graded.at(p),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_finds_the_minimum() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let wishes: Vec<Wish> = (0..500)
            .map(|_| Wish { point: Point::new(random(), random()), size: 0.001 + random() * random() })
            .collect();
        let graded = Graded::new(wishes.clone(), 0.3, 0.4);
        for _ in 0..1000 {
            let p = Point::new(2.0 * random() - 0.5, 2.0 * random() - 0.5);
            let all = wishes.iter().fold(0.3_f64, |least, w| least.min(w.size + 0.4 * w.point.distance(&p)));
            assert_eq!(graded.at(&p), all, "at {p:?}");
        }
        assert_eq!(Graded::new(Vec::new(), 0.3, 0.4).at(&Point::new(0.0, 0.0)), 0.3, "nothing asked for");
    }
}
