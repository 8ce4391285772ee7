//! Axis-aligned boxes.

use super::{Point, Vector};
use crate::scalar::Scalar;

/// An axis-aligned box; `min` ≤ `max` in both coordinates unless it is [`Aabb::empty`].
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Aabb<S> {
    /// Smallest coordinates.
    pub min: Point<S>,
    /// Largest coordinates.
    pub max: Point<S>,
}

impl<S: Scalar> Aabb<S> {
    /// The box of nothing; it is at an infinite distance from every point.
    #[inline]
    pub fn empty() -> Self {
        let inf = S::infinity();
        Self { min: Point::new(inf.clone(), inf.clone()), max: Point::new(-inf.clone(), -inf) }
    }

    /// The smallest box around some points.
    #[inline]
    pub fn around<'p>(points: impl IntoIterator<Item = &'p Point<S>>) -> Self
    where
        S: 'p,
    {
        let mut b = Self::empty();
        for p in points {
            b.include(p);
        }
        b
    }

    /// Grows to hold a point.
    #[inline]
    pub fn include(&mut self, p: &Point<S>) {
        if p.x < self.min.x {
            self.min.x = p.x.clone();
        }
        if p.y < self.min.y {
            self.min.y = p.y.clone();
        }
        if p.x > self.max.x {
            self.max.x = p.x.clone();
        }
        if p.y > self.max.y {
            self.max.y = p.y.clone();
        }
    }

    /// Grows to hold another box.
    #[inline]
    pub fn merge(&mut self, other: &Self) {
        self.include(&other.min);
        self.include(&other.max);
    }

    /// Squared distance from a point to the box, 0 inside; infinite for the empty box.
    #[inline]
    pub fn distance_sq(&self, p: &Point<S>) -> S {
        let zero = S::zero();
        let dx = (self.min.x.clone() - &p.x).max(p.x.clone() - &self.max.x).max(zero.clone());
        let dy = (self.min.y.clone() - &p.y).max(p.y.clone() - &self.max.y).max(zero);
        dx.square() + &dy.square()
    }

    /// Squared distance from one box to another, 0 where they meet; infinite where one is empty.
    #[inline]
    pub fn gap_sq(&self, other: &Self) -> S {
        let zero = S::zero();
        let dx = (self.min.x.clone() - &other.max.x).max(other.min.x.clone() - &self.max.x).max(zero.clone());
        let dy = (self.min.y.clone() - &other.max.y).max(other.min.y.clone() - &self.max.y).max(zero);
        dx.square() + &dy.square()
    }

    /// From corner to corner.
    #[inline]
    pub fn extent(&self) -> Vector<S> {
        self.max.minus(&self.min)
    }

    /// The middle.
    #[inline]
    pub fn centre(&self) -> Point<S> {
        self.min.middle(&self.max)
    }
}
