//! Input for the cases: the same every time, with a liking for what is special.

use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::{Point, Vector};
use feature_sampling::scalar::Scalar;

use super::{Truth, lift};

/// A source of input.
#[derive(Clone, Debug)]
pub struct Gen {
    state: u64,
}

impl Gen {
    /// From a seed.
    pub const fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// 64 bits (SplitMix64, Steele et al. 2014).
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.state ^ (self.state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Below `n`.
    pub fn below(&mut self, n: u64) -> u64 {
        self.bits() % n
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// In [lo, hi).
    pub fn between(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.unit()
    }

    /// A number of moderate size: mostly within ±100, at times an integer, 0, or some powers of two smaller.
    pub fn number<S: Scalar>(&mut self) -> S {
        let value = match self.below(16) {
            0 => 0.0,
            1 => self.between(-9.0, 9.0).round(),
            2 => self.between(-100.0, 100.0) / 4096.0,
            _ => self.between(-100.0, 100.0),
        };
        S::from_f64(value)
    }

    /// A number above 0.
    pub fn positive<S: Scalar>(&mut self) -> S {
        S::from_f64(2_f64.powf(self.between(-20.0, 20.0)))
    }

    /// A parameter in [0, 1]; at times an end, or next to one.
    pub fn parameter<S: Scalar>(&mut self) -> S {
        let value = match self.below(16) {
            0 => 0.0,
            1 => 1.0,
            2 => self.unit() / 1e6,
            3 => 0.5,
            _ => self.unit(),
        };
        S::from_f64(value)
    }

    /// A point.
    pub fn point<S: Scalar>(&mut self) -> Point<S> {
        Point::new(self.number(), self.number())
    }

    /// A vector.
    pub fn vector<S: Scalar>(&mut self) -> Vector<S> {
        Vector::new(self.number(), self.number())
    }

    /// A cubic; at times a line, one with a retracted handle, or a small one far from the origin.
    pub fn cubic<S: Scalar>(&mut self) -> Cubic<S> {
        let [a, b, c, d] = [self.point::<S>(), self.point(), self.point(), self.point()];
        match self.below(10) {
            0 => Cubic::line(a, d),
            1 => Cubic::new(a.clone(), a, c, d),
            2 => {
                let near = |p: &Point<S>| a.plus(&p.minus(&a).scaled(&S::ratio(1, 100)));
                Cubic::new(a.clone(), near(&b), near(&c), near(&d))
            }
            _ => Cubic::new(a, b, c, d),
        }
    }

    /// A cubic that bends one way and not much, as drawings have them.
    pub fn tame_cubic<S: Scalar>(&mut self) -> Cubic<S> {
        let (x, y) = (self.between(-50.0, 50.0), self.between(-50.0, 50.0));
        let (length, turn) = (self.between(5.0, 40.0), self.between(0.0, std::f64::consts::TAU));
        let (rise, skew) = (self.between(0.1, 0.5) * length, self.between(0.8, 1.2));
        let (u, v) = ((turn.cos(), turn.sin()), (-turn.sin(), turn.cos()));
        let at = |a: f64, b: f64| Point::new(S::from_f64(x + a * u.0 + b * v.0), S::from_f64(y + a * u.1 + b * v.1));
        Cubic::new(at(0.0, 0.0), at(0.3 * length, rise), at(0.7 * length, rise * skew), at(length, 0.0))
    }
}

/// A point, without error.
pub fn lift_point<S: Scalar>(p: &Point<S>) -> Point<Truth> {
    Point::new(lift(&p.x), lift(&p.y))
}

/// A vector, without error.
pub fn lift_vector<S: Scalar>(v: &Vector<S>) -> Vector<Truth> {
    Vector::new(lift(&v.x), lift(&v.y))
}

/// A cubic, without error.
pub fn lift_cubic<S: Scalar>(c: &Cubic<S>) -> Cubic<Truth> {
    let [a, b, c, d] = &c.points;
    Cubic::new(lift_point(a), lift_point(b), lift_point(c), lift_point(d))
}
