//! Vectors: differences of points.
//!
//! Algebra holds over any [`Field`], intervals included; what compares asks for a [`Scalar`].

use crate::scalar::{Field, Scalar};

/// A difference of two points, in user units (or a direction, or a derivative: then per unit of parameter).
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Vector<S> {
    /// Horizontal part, to the right.
    pub x: S,
    /// Vertical part, downwards as in SVG.
    pub y: S,
}

impl<S: Field> Vector<S> {
    /// The vector (x, y).
    #[inline]
    pub const fn new(x: S, y: S) -> Self {
        Self { x, y }
    }

    /// The zero vector.
    #[inline]
    pub fn zero() -> Self {
        Self::new(S::zero(), S::zero())
    }

    /// `self` + `other`.
    #[inline]
    pub fn plus(&self, other: &Self) -> Self {
        Self::new(self.x.clone() + &other.x, self.y.clone() + &other.y)
    }

    /// `self` − `other`.
    #[inline]
    pub fn minus(&self, other: &Self) -> Self {
        Self::new(self.x.clone() - &other.x, self.y.clone() - &other.y)
    }

    /// `self` times a number.
    #[inline]
    pub fn scaled(&self, k: &S) -> Self {
        Self::new(self.x.clone() * k, self.y.clone() * k)
    }

    /// `self` + k·`other`.
    #[inline]
    pub fn plus_scaled(&self, k: &S, other: &Self) -> Self {
        Self::new(other.x.clone() * k + &self.x, other.y.clone() * k + &self.y)
    }

    /// −`self`.
    #[inline]
    pub fn opposite(&self) -> Self {
        Self::new(-self.x.clone(), -self.y.clone())
    }

    /// The vector turned to the left: (−y, x).
    #[inline]
    pub fn left(&self) -> Self {
        Self::new(-self.y.clone(), self.x.clone())
    }

    /// Scalar product.
    #[inline]
    pub fn dot(&self, other: &Self) -> S {
        self.x.clone() * &other.x + &(self.y.clone() * &other.y)
    }

    /// Cross product x₁y₂ − y₁x₂: positive where `other` lies to the left of `self`.
    #[inline]
    pub fn cross(&self, other: &Self) -> S {
        self.x.clone() * &other.y - &(self.y.clone() * &other.x)
    }

    /// Squared length.
    #[inline]
    pub fn norm_sq(&self) -> S {
        self.x.clone().square() + &self.y.clone().square()
    }

    /// Length.
    #[inline]
    pub fn norm(&self) -> S {
        self.norm_sq().sqrt()
    }
}

impl<S: Scalar> Vector<S> {
    /// The unit vector of the same direction; `None` where the length is zero or not finite.
    ///
    /// The vector is first divided by its larger coordinate, so that nothing overflows or vanishes on the way.
    #[inline]
    pub fn unit(&self) -> Option<Self> {
        let larger = self.x.clone().abs().max(self.y.clone().abs());
        if !(larger > S::zero() && larger.is_finite()) {
            return None;
        }
        let v = Self::new(self.x.clone() / &larger, self.y.clone() / &larger);
        let n = v.norm();
        Some(Self::new(v.x / &n, v.y / &n))
    }

    /// Both coordinates are finite.
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}
