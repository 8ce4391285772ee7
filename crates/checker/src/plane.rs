//! Vectors of the plane and a one-dimensional minimiser: all the mathematics the checker shares between its files.
//!
//! The checker keeps its own copy of such small things on purpose: an error in the kernel's geometry must not be able
//! to hide itself from its judge.

use std::ops::{Add, Mul, Neg, Sub};

/// A point or a vector of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct V2 {
    /// Abscissa.
    pub x: f64,
    /// Ordinate.
    pub y: f64,
}

/// The vector (x, y).
pub const fn v2(x: f64, y: f64) -> V2 {
    V2 { x, y }
}

impl V2 {
    /// Inner product.
    pub fn dot(self, o: V2) -> f64 {
        self.x * o.x + self.y * o.y
    }

    /// Third coordinate of the cross product.
    pub fn cross(self, o: V2) -> f64 {
        self.x * o.y - self.y * o.x
    }

    /// Squared length.
    pub fn norm2(self) -> f64 {
        self.dot(self)
    }

    /// Length.
    pub fn norm(self) -> f64 {
        self.norm2().sqrt()
    }

    /// The vector turned by a right angle: (−y, x).
    pub fn perp(self) -> V2 {
        v2(-self.y, self.x)
    }

    /// The vector at length 1; zero stays zero.
    pub fn unit(self) -> V2 {
        let n = self.norm();
        if n > 0.0 { self * (1.0 / n) } else { self }
    }

    /// Distance between two points.
    pub fn distance(self, o: V2) -> f64 {
        (self - o).norm()
    }

    /// Distance to the segment from a to b, and where on it (0 … 1) the nearest point lies.
    pub fn distance_to_segment(self, a: V2, b: V2) -> (f64, f64) {
        let e = b - a;
        let l2 = e.norm2();
        let x = if l2 > 0.0 { ((self - a).dot(e) / l2).clamp(0.0, 1.0) } else { 0.0 };
        (self.distance(a + e * x), x)
    }
}

impl Add for V2 {
    type Output = V2;
    fn add(self, o: V2) -> V2 {
        v2(self.x + o.x, self.y + o.y)
    }
}

impl Sub for V2 {
    type Output = V2;
    fn sub(self, o: V2) -> V2 {
        v2(self.x - o.x, self.y - o.y)
    }
}

impl Mul<f64> for V2 {
    type Output = V2;
    fn mul(self, k: f64) -> V2 {
        v2(self.x * k, self.y * k)
    }
}

impl Neg for V2 {
    type Output = V2;
    fn neg(self) -> V2 {
        v2(-self.x, -self.y)
    }
}

/// Brent's minimiser on [lo, hi]: golden sections, with parabolas where they help. Returns the place and the value.
///
/// It stops when the place is known to `tolerance` (absolute). A minimum at a kink is found as surely as a smooth one,
/// only more slowly.
pub fn minimise(mut f: impl FnMut(f64) -> f64, lo: f64, hi: f64, tolerance: f64) -> (f64, f64) {
    const GOLDEN: f64 = 0.381_966_011_250_105;
    let (mut a, mut b) = (lo, hi);
    let mut x = a + GOLDEN * (b - a);
    let mut fx = f(x);
    let (mut w, mut fw, mut v, mut fv) = (x, fx, x, fx);
    let (mut step, mut before) = (0.0f64, 0.0f64);
    for _ in 0..90 {
        let middle = 0.5 * (a + b);
        let tol = tolerance + 1e-16 * x.abs();
        if (x - middle).abs() <= 2.0 * tol - 0.5 * (b - a) {
            break;
        }
        let mut golden = true;
        if before.abs() > tol {
            let r = (x - w) * (fx - fv);
            let mut q = (x - v) * (fx - fw);
            let mut p = (x - v) * q - (x - w) * r;
            q = 2.0 * (q - r);
            if q > 0.0 {
                p = -p;
            }
            q = q.abs();
            if p.abs() < (0.5 * q * before).abs() && p > q * (a - x) && p < q * (b - x) {
                before = step;
                step = p / q;
                let u = x + step;
                if u - a < 2.0 * tol || b - u < 2.0 * tol {
                    step = if x < middle { tol } else { -tol };
                }
                golden = false;
            }
        }
        if golden {
            before = if x < middle { b - x } else { a - x };
            step = GOLDEN * before;
        }
        let u = if step.abs() >= tol { x + step } else { x + tol * step.signum() };
        let fu = f(u);
        if fu <= fx {
            if u < x {
                b = x;
            } else {
                a = x;
            }
            (v, fv, w, fw, x, fx) = (w, fw, x, fx, u, fu);
        } else {
            if u < x {
                a = u;
            } else {
                b = u;
            }
            if fu <= fw || w == x {
                (v, fv, w, fw) = (w, fw, u, fu);
            } else if fu <= fv || v == x || v == w {
                (v, fv) = (u, fu);
            }
        }
    }
    (x, fx)
}
