//! One cubic of the drawing, in powers of its parameter.
//!
//! B(t) = p + a₁ t + a₂ t² + a₃ t³. Only evaluation, reversal and the bounds that the search in `disk` prunes
//! with live here; a line has a₂ = a₃ = 0 exactly, so that no rounding gives it a curvature.

use crate::plane::V2;

/// A cubic in powers of t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cubic {
    /// B(0).
    pub p: V2,
    /// Coefficients of t, t² and t³.
    pub a: [V2; 3],
    /// B(1), kept apart so that both ends are exact.
    pub q: V2,
    /// Coefficients of the curve run backwards, from its control points too: a retracted handle stays exactly zero.
    back: [V2; 3],
}

impl Cubic {
    /// The cubic with these control points.
    pub fn new(c: [V2; 4]) -> Cubic {
        let powers = |c: [V2; 4]| {
            let (d0, d1, d2) = (c[1] - c[0], c[2] - c[1], c[3] - c[2]);
            let (e0, e1) = (d1 - d0, d2 - d1);
            [d0 * 3.0, e0 * 3.0, e1 - e0]
        };
        Cubic { p: c[0], a: powers(c), q: c[3], back: powers([c[3], c[2], c[1], c[0]]) }
    }

    /// The straight line at uniform speed.
    pub fn line(p: V2, q: V2) -> Cubic {
        let none = V2::default();
        Cubic { p, a: [q - p, none, none], q, back: [p - q, none, none] }
    }

    /// The same curve run backwards.
    pub fn reversed(&self) -> Cubic {
        Cubic { p: self.q, a: self.back, q: self.p, back: self.a }
    }

    /// B(t).
    pub fn at(&self, t: f64) -> V2 {
        if t >= 1.0 {
            return self.q;
        }
        self.p + ((self.a[2] * t + self.a[1]) * t + self.a[0]) * t
    }

    /// B(t) − f, subtracting before multiplying so that little is lost where B(0) and f lie near each other.
    pub fn relative_to(&self, f: V2, t: f64) -> V2 {
        (self.p - f) + ((self.a[2] * t + self.a[1]) * t + self.a[0]) * t
    }

    /// B′(t), from the nearer end: near a retracted handle the velocity is small, and its direction counts.
    pub fn velocity(&self, t: f64) -> V2 {
        if t > 0.5 {
            let v = 1.0 - t;
            return -((self.back[2] * (3.0 * v) + self.back[1] * 2.0) * v + self.back[0]);
        }
        (self.a[2] * (3.0 * t) + self.a[1] * 2.0) * t + self.a[0]
    }

    /// B″(t).
    pub fn acceleration(&self, t: f64) -> V2 {
        self.a[2] * (6.0 * t) + self.a[1] * 2.0
    }

    /// A disc (centre, radius) around the piece [t0, t1]: the middle of the chord, half the chord, and the most that a
    /// piece can leave its chord, h²/8 · max |B″| (B″ is linear, so an end decides).
    pub fn disc(&self, t0: f64, t1: f64) -> (V2, f64) {
        let (p, q) = (self.at(t0), self.at(t1));
        let h = t1 - t0;
        let bend = self.acceleration(t0).norm2().max(self.acceleration(t1).norm2()).sqrt();
        ((p + q) * 0.5, 0.5 * p.distance(q) + h * h * 0.125 * bend)
    }

    /// An upper bound of the arc length of [t0, t1]: the speed in the middle and the most that it can change.
    pub fn length_bound(&self, t0: f64, t1: f64) -> f64 {
        let h = t1 - t0;
        let bend = self.acceleration(t0).norm2().max(self.acceleration(t1).norm2()).sqrt();
        h * (self.velocity(0.5 * (t0 + t1)).norm() + 0.5 * h * bend)
    }

    /// Arc length of [t0, t1] by Simpson's rule on 64 pieces: good to far more digits than a share of length needs.
    pub fn length(&self, t0: f64, t1: f64) -> f64 {
        let n = 64;
        let h = (t1 - t0) / f64::from(n);
        let speed = |i: i32| self.velocity(t0 + h * 0.5 * f64::from(i)).norm();
        (0..n).map(|i| (speed(2 * i) + 4.0 * speed(2 * i + 1) + speed(2 * i + 2)) * h / 6.0).sum()
    }

    /// The unit direction in which the curve leaves B(0): of the first derivative that does not vanish.
    pub fn leaving(&self) -> V2 {
        let scale = self.a.iter().map(|c| c.norm()).fold(0.0, f64::max);
        self.a.iter().find(|c| c.norm() > 1e-12 * scale).map_or(V2::default(), |c| c.unit())
    }

    /// The parameter of the point of the curve nearest to x, and its distance, by dense search and polishing.
    pub fn project(&self, x: V2) -> (f64, f64) {
        let n = 200;
        let place = |i: i32| f64::from(i) / f64::from(n);
        let best = (0..=n).min_by(|&i, &j| self.at(place(i)).distance(x).total_cmp(&self.at(place(j)).distance(x)));
        let i = best.unwrap_or(0);
        let ends = (place((i - 1).max(0)), place((i + 1).min(n)));
        let (t, d) = crate::plane::minimise(|t| self.at(t).distance(x), ends.0, ends.1, 1e-12);
        [(t, d), (0.0, self.p.distance(x)), (1.0, self.q.distance(x))]
            .into_iter()
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap_or((t, d))
    }
}
