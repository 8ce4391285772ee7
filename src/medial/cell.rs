//! Cells of the foot set: stretches of feet with an enclosure of everything that stands on them.
//!
//! A cell is a piece of the foot set: a stretch of a segment on one side, or a fan of directions at an end or on the outer side
//! of a corner. For all of its feet (f, d), |d| = 1, and all ρ between two bounds,
//!
//! ```text
//! |f + ρd − (fₘ + ρnₘ)| ≤ H(ρ),   H(ρ) = min(h·max|1−kρ| + e₀ + e₁ρ,  h + e₀ + αρ),
//! ```
//!
//! with fₘ and nₘ two plain numbers near the foot and direction in the middle, h half the length of the stretch, k the curvature
//! towards d, α the turning, e₀ and e₁ what fₘ and nₘ are off. (f + ρd moves by (1−kρ) times what f moves.) With an
//! enclosure [lower, upper] of the radii r(f, d), all medial points of the cell lie within H of a straight segment: a
//! *capsule*. `lower` comes from an emptiness proof over all of C, `upper` from single points of C (`medial::radii`).
//! Proofs: `docs/certificates.md`, sections 2 to 5.

use super::clear::{FanFeet, Feet, MeanFoot, Scene, curvature};
use super::foot::Side;
use super::foot_set::singular;
use crate::curve::ideal::{Enclosed, Outgoing};
use crate::curve::{CurveParam, EndId};
use crate::geometry::{Point, Vector, distance_sq_to_segment};
use crate::scalar::{Directed, Enclosure as Interval, Field};

/// Which feet a cell covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FootSpan<S> {
    /// A stretch of a segment, parameters from its start, on one side (never [`Side::Fan`] nor [`Side::Corner`]).
    Normal {
        /// The segment.
        segment: u32,
        /// First and last parameter.
        span: [S; 2],
        /// Left or right.
        side: Side,
    },
    /// The directions (1−λ)e₁ + λe₂ at an end: e₁ is the unit normal of its branch on the given side of the direction in which
    /// the branch leaves, e₂ the unit vector between e₁ and the normal of the other branch on its other side (the same branch
    /// twice at an open end).
    Fan {
        /// The end whose branch e₁ is normal to.
        end: EndId,
        /// The branch on the other side of the fan.
        other: EndId,
        /// e₁ is on the left of the outgoing tangent.
        left: bool,
        /// First and last λ.
        span: [S; 2],
    },
    /// A point that belongs to M itself: a corner.
    Corner {
        /// One of its ends.
        end: EndId,
    },
}

/// A piece of the foot set and what is known of it.
#[derive(Clone, Debug)]
pub struct Cell<S> {
    /// What it covers.
    pub feet: FootSpan<S>,
    /// fₘ.
    pub centre: Point<S>,
    /// nₘ, nearly of length 1.
    pub normal: Vector<S>,
    /// h: no foot is farther than this (and e₀) from fₘ.
    pub half: S,
    /// Enclosure of the curvature towards d, where it is bounded.
    pub(super) bend: Option<[S; 2]>,
    /// No unit direction is farther than this from nₘ.
    pub(super) turn: S,
    /// Errors of fₘ and nₘ.
    pub(super) errors: [S; 2],
    /// At most r(f, d), for all feet.
    pub lower: S,
    /// At least r(f, d), for all feet.
    pub upper: S,
    /// The point of C that gave `upper`.
    pub witness: Option<CurveParam<S>>,
    /// r at the first foot, in the middle and at the last one, as found without proof: where the search for bounds starts.
    pub guess: [S; 3],
    /// The upper bound and the plain radii were looked for.
    pub looked: bool,
    /// The lower bound was looked for up to this radius; below zero: not at all.
    pub asked: S,
    /// Index of the first of its two halves, in a band.
    pub children: u32,
}

/// A part of a band around the medial axis: all points within `spread` of a straight segment.
#[derive(Clone, Debug, PartialEq)]
pub struct Capsule<S> {
    /// Where the segment starts and ends.
    pub axis: [Point<S>; 2],
    /// The radius.
    pub spread: S,
}

/// No halves yet.
pub const UNDIVIDED: u32 = u32::MAX;

/// Bounds of |a − b| and the like are rounded by far less than this many noises of the coordinates.
#[inline]
pub fn slop<S: Directed>(scene: &Scene<'_, S>) -> S {
    scene.curve.noise.clone() * &S::int(32)
}

/// A plain point inside an enclosure, and a bound of its distance from the others inside.
fn middle_of<S: Directed>(v: &Enclosed<S>) -> (Vector<S>, S) {
    let m = Vector::new(v.x.middle(), v.y.middle());
    let off = v.minus(&crate::curve::ideal::exact_vector(&m)).norm();
    (m, off.hi().clone())
}

fn hull<S: Directed, const N: usize>(points: [Enclosed<S>; N]) -> Option<Enclosed<S>> {
    points.into_iter().reduce(|a, b| Vector::new(a.x.hull(&b.x), a.y.hull(&b.y)))
}

/// Encloses B on [v0, v1]: the hull of the stretch's own control points.
fn stretch<S: Directed>(o: &Outgoing<S>, v0: &Interval<S>, v1: &Interval<S>) -> Option<Enclosed<S>> {
    let [c1, c2, c3] = &o.c;
    let three = Interval::int(3);
    let product = v0.clone() * v1;
    // Polar forms of v, v² and v³ at (a, a, b).
    let inner = |a: &Interval<S>, b: &Interval<S>| {
        let square = a.clone().square();
        let e1 = (a.clone().twice() + b) / &three;
        let e2 = (square.clone() + &product.clone().twice()) / &three;
        o.end.plus_scaled(&e1, c1).plus_scaled(&e2, c2).plus_scaled(&(square * b), c3)
    };
    hull([o.point(v0), inner(v0, v1), inner(v1, v0), o.point(v1)])
}

/// The direction in which a branch leaves its end, not normalised.
pub(super) fn leaving<S: Directed>(o: &Outgoing<S>) -> &Enclosed<S> {
    let [c1, c2, _] = &o.c;
    if o.retracted { c2 } else { c1 }
}

pub(super) fn unit<S: Directed>(v: &Enclosed<S>) -> Enclosed<S> {
    let n = v.norm();
    Vector::new(v.x.clone() / &n, v.y.clone() / &n)
}

impl<S: Directed> FootSpan<S> {
    /// The enclosures that proofs over these feet need; `None` where they degenerate (then the feet must be divided).
    pub fn feet(&self, scene: &Scene<'_, S>) -> Option<Feet<S>> {
        match self {
            Self::Normal { segment, span: [a, b], side } => {
                let near = usize::from(a.clone() + b > S::one());
                let o = scene.outgoing(EndId::new(*segment, near))?;
                let from = Interval::new(a.clone(), b.clone());
                let back = Interval::int(1) - &from;
                let u = if near == 0 { from.clone() } else { back.clone() };
                let (v0, v1) = (Interval::point(u.lo().clone()), Interval::point(u.hi().clone()));
                let [c1, c2, c3] = &o.c;
                // The control points of the stretch hold it, those of its derivative hold the tangent.
                let (e1, e2) = ((v0.clone() + &v1).half(), v0.clone() * &v1);
                let (two_c2, three_c3) = (c2.scaled(&Interval::int(2)), c3.scaled(&Interval::int(3)));
                let tangent = if o.retracted {
                    hull([o.tangent(&v0), o.tangent(&v1)])?
                } else {
                    let between = c1.plus_scaled(&e1, &two_c2).plus_scaled(&e2, &three_c3);
                    hull([o.tangent(&v0), between, o.tangent(&v1)])?
                };
                let length = tangent.norm();
                if *length.lo() <= S::zero() {
                    return None;
                }
                let point = stretch(o, &v0, &v1)?;
                let left = (*side == Side::Left) == (near == 0);
                let normal = tangent.left();
                let turned = |v: &Enclosed<S>| if left { v.left() } else { v.left().opposite() };
                let middle = Interval::point(u.middle());
                let mean = MeanFoot {
                    point: o.point(&middle),
                    direction: turned(&o.tangent(&middle)),
                    change: turned(&if o.retracted {
                        three_c3
                    } else {
                        two_c2.plus_scaled(&u, &c3.scaled(&Interval::int(6)))
                    }),
                    offset: u - &middle,
                };
                Some(Feet {
                    segment: *segment,
                    from: Some([from, back]),
                    side: near,
                    left,
                    point,
                    direction: if left { normal } else { normal.opposite() },
                    length,
                    fan: None,
                    mean: Some(mean),
                })
            }
            Self::Fan { end, other, left, span: [a, b] } => {
                let (own, across) = (scene.outgoing(*end)?, scene.outgoing(*other)?);
                let u = unit(leaving(own));
                let first = if *left { u.left() } else { u.left().opposite() };
                let v = unit(leaving(across));
                // The bisector, in the one of two ways that divides by something: the branches may be opposite.
                let sum = u.plus(&v);
                let second = if *sum.norm_sq().lo() > S::one().mul_pow2(-2) {
                    unit(&sum).opposite()
                } else {
                    unit(&first.plus(&if *left { v.left().opposite() } else { v.left() }))
                };
                let lambda = Interval::new(a.clone(), b.clone());
                let first = first.scaled(&(Interval::int(1) - &lambda));
                let direction = first.plus(&second.scaled(&lambda));
                let length = direction.norm();
                if *length.lo() <= S::zero() || !length.hi().is_finite() {
                    return None;
                }
                Some(Feet {
                    segment: end.segment(),
                    from: None,
                    side: end.side(),
                    left: *left,
                    point: own.end.clone(),
                    direction,
                    length,
                    fan: Some(FanFeet { branch: *end, first, second, share: lambda }),
                    mean: None,
                })
            }
            Self::Corner { .. } => None,
        }
    }

    /// The parameter in the middle, and the span of one half.
    fn halves(&self) -> Option<[Self; 2]> {
        let split = |[a, b]: &[S; 2]| {
            let m = S::midpoint(a, b);
            (m > *a && m < *b).then(|| [[a.clone(), m.clone()], [m, b.clone()]])
        };
        Some(match self {
            Self::Normal { segment, span, side } => {
                split(span)?.map(|span| Self::Normal { segment: *segment, span, side: *side })
            }
            // A fan that is narrower than this is as bad as it will ever be.
            Self::Fan { span: [a, b], .. } if b.clone() - a <= S::one().mul_pow2(-18) => return None,
            Self::Fan { end, other, left, span } => {
                split(span)?.map(|span| Self::Fan { end: *end, other: *other, left: *left, span })
            }
            Self::Corner { .. } => return None,
        })
    }

    /// The middle alone.
    fn middle(&self) -> Self {
        let at = |[a, b]: &[S; 2]| {
            let m = S::midpoint(a, b);
            [m.clone(), m]
        };
        match self {
            Self::Normal { segment, span, side } => Self::Normal { segment: *segment, span: at(span), side: *side },
            Self::Fan { end, other, left, span } => Self::Fan { end: *end, other: *other, left: *left, span: at(span) },
            Self::Corner { end } => Self::Corner { end: *end },
        }
    }
}

impl<S: Directed> Cell<S> {
    /// The cell of some feet, nothing known yet of its radii.
    pub fn new(scene: &Scene<'_, S>, feet: FootSpan<S>) -> Self {
        let zero = S::zero;
        let mut cell = Self {
            centre: Point::new(zero(), zero()),
            normal: Vector::zero(),
            half: zero(),
            bend: None,
            turn: S::int(2),
            errors: [zero(), zero()],
            lower: zero(),
            upper: S::infinity(),
            witness: None,
            guess: [-S::one(), -S::one(), -S::one()],
            looked: false,
            asked: -S::one(),
            children: UNDIVIDED,
            feet,
        };
        if let FootSpan::Corner { end } = &cell.feet {
            cell.upper = if singular(scene, *end) { zero() } else { S::infinity() };
            cell.looked = true;
            cell.asked = S::infinity();
            cell.turn = zero();
            if let Some(p) = scene.curve.end_point(*end) {
                cell.centre = p.clone();
            }
            return cell;
        }
        let (Some(middle), feet) = (cell.feet.middle().feet(scene), cell.feet.feet(scene)) else {
            // Not even the middle has a direction.
            cell.half = scene.curve.diagonal.clone();
            return cell;
        };
        let (centre, off) = middle_of(&middle.point);
        cell.centre = Point::new(centre.x, centre.y);
        let (normal, skew) = middle_of(&unit(&middle.direction));
        cell.normal = normal;
        cell.errors = [off, skew];
        let Some(feet) = feet else {
            if let FootSpan::Normal { segment, span: [a, b], .. } = &cell.feet {
                let hull = scene
                    .outgoing(EndId::new(*segment, 0))
                    .and_then(|o| stretch(o, &Interval::point(a.clone()), &Interval::point(b.clone())));
                let half = hull.map(|h| h.minus(&crate::curve::ideal::exact(&cell.centre)).norm().hi().clone());
                cell.half = half.unwrap_or_else(|| scene.curve.diagonal.clone());
            }
            return cell;
        };
        let n = crate::curve::ideal::exact_vector(&cell.normal);
        let off = unit(&feet.direction).minus(&n).norm().hi().clone();
        if off < cell.turn {
            cell.turn = off;
        }
        if let (Some(from), Some(o)) = (&feet.from, scene.outgoing(EndId::new(feet.segment, feet.side))) {
            let u = if feet.side == 0 { &from[0] } else { &from[1] };
            let speed = if o.retracted { feet.length.clone() * u } else { feet.length.clone() };
            // The middle may be off by a rounding.
            let width = Interval::point(u.width()).half() + &Interval::point(S::unit_roundoff().mul_pow2(2));
            cell.half = (speed * &width).hi().clone();
            cell.bend = curvature(scene, &feet).map(|k| [k.lo().clone(), k.hi().clone()]);
            if let Some([a, b]) = &cell.bend {
                let most = Interval::point(a.clone().abs().max(b.clone().abs()));
                let turn = most * &Interval::point(cell.half.clone()) + &Interval::point(cell.errors[1].clone());
                if *turn.hi() < cell.turn {
                    cell.turn = turn.hi().clone();
                }
            }
        }
        cell
    }

    /// H(ρ) for all ρ in [from, to].
    pub fn spread(&self, from: &S, to: &S) -> S {
        let point = |v: &S| Interval::point(v.clone());
        let (h, to_i) = (point(&self.half), point(to));
        let [e0, e1] = &self.errors;
        let wide = h.clone() + &point(e0) + &(point(&self.turn) * &to_i);
        let wide = wide.hi().clone();
        let Some([k0, k1]) = &self.bend else { return wide };
        let k = Interval::new(k0.clone(), k1.clone());
        let moved = (Interval::int(1) - &(k * &Interval::new(from.clone(), to.clone()))).magnitude();
        let sheared = point(&moved) * &h + &point(e0) + &(point(e1) * &to_i);
        wide.min(sheared.hi().clone())
    }

    /// No unit direction of the cell is farther than this from its normal.
    pub const fn turning(&self) -> &S {
        &self.turn
    }

    /// The end of the axis at ρ.
    #[inline]
    pub(super) fn axis(&self, rho: &S) -> Point<S> {
        self.centre.plus_scaled(rho, &self.normal)
    }

    /// At most the distance from p to every medial point of the cell with a radius below `limit`; the rounding of plain
    /// numbers is not allowed for.
    pub fn distance(&self, p: &Point<S>, limit: &S) -> S {
        self.distance_from(p, &self.lower, limit)
    }

    /// The same if all radii were at least `lower`.
    pub fn distance_from(&self, p: &Point<S>, lower: &S, limit: &S) -> S {
        let far = self.upper.clone().min(limit.clone()).max(lower.clone());
        let d = distance_sq_to_segment(p, &self.axis(lower), &self.axis(&far)).sqrt();
        d - &self.spread(lower, &far)
    }

    /// At least the distance from p to every medial point of the cell, of which there are some; infinite where nothing is
    /// known. The rounding of plain numbers is not allowed for.
    pub fn farthest(&self, p: &Point<S>) -> S {
        self.farthest_from(p, &self.lower)
    }

    /// The same if all radii were at least `lower`.
    pub fn farthest_from(&self, p: &Point<S>, lower: &S) -> S {
        if !self.upper.is_finite() {
            return S::infinity();
        }
        let lower = lower.clone().min(self.upper.clone());
        let (a, b) = (p.distance(&self.axis(&lower)), p.distance(&self.axis(&self.upper)));
        a.max(b) + &self.spread(&lower, &self.upper)
    }

    /// All of its medial points with a radius below `limit` lie within this; the rounding of plain numbers is not allowed for.
    pub fn capsule(&self, limit: &S) -> Capsule<S> {
        let far = self.upper.clone().min(limit.clone()).max(self.lower.clone());
        Capsule { axis: [self.axis(&self.lower), self.axis(&far)], spread: self.spread(&self.lower, &far) }
    }

    /// Its two halves, which know what it knows.
    pub fn halves(&self, scene: &Scene<'_, S>) -> Option<[Self; 2]> {
        let [a, b] = self.feet.halves()?;
        let half = |feet, guess: [&S; 2]| {
            let mut cell = Self::new(scene, feet);
            cell.lower = self.lower.clone();
            cell.upper = self.upper.clone();
            cell.witness = self.witness.clone();
            cell.guess = [guess[0].clone(), -S::one(), guess[1].clone()];
            cell
        };
        let [g0, g1, g2] = &self.guess;
        Some([half(a, [g0, g1]), half(b, [g1, g2])])
    }
}
