//! Cells of the foot set, enclosed.
//!
//! A cell is a stretch of a segment on one side, or a fan of directions at an end. Everything that a claim about it needs is
//! evaluated here from the coefficients of C\* in intervals, once: feet, directions, curvature, and the *capsule* that
//! holds its medial points. Seen outgoing from an end, B = P + c₁u + c₂u² + c₃u³ and T = B' (B'/u where the handle is retracted,
//! c₁ = 0); d is ±left(T), so that d·z = ±T×z.

use feature_sampling::curve::EndId;
use feature_sampling::curve::ideal::{Enclosed, Outgoing};
use feature_sampling::geometry::{Point, Vector};
use feature_sampling::scalar::Field;

use crate::bernstein::{Real, on};
use crate::scene::Scene;

/// Which feet a cell covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Span {
    /// A stretch of a segment on one side.
    Side {
        /// Segment of C.
        segment: u32,
        /// On the left of the direction of growing parameters.
        left: bool,
        /// First and last parameter.
        from: f64,
        /// Last parameter.
        to: f64,
    },
    /// Directions (1−λ)e₁ + λe₂ at an end: e₁ is the unit normal of its branch on one side, e₂ bisects the fan between it
    /// and the normal of the other branch on its other side. At an open end both are the same branch.
    Fan {
        /// The end whose branch e₁ is normal to: twice the segment, and 1 for the end at parameter 1.
        end: u32,
        /// The end on the other side of the fan.
        other: u32,
        /// e₁ is on the left of the direction in which the branch leaves.
        left: bool,
        /// First λ.
        from: f64,
        /// Last λ.
        to: f64,
    },
}

/// An end by its number in a certificate.
pub(crate) fn end_of(number: u32) -> EndId {
    EndId::new(number >> 1, (number & 1) as usize)
}

impl Span {
    /// First and last parameter, or λ.
    pub(crate) const fn range(&self) -> [f64; 2] {
        let (Self::Side { from, to, .. } | Self::Fan { from, to, .. }) = self;
        [*from, *to]
    }

    /// The same feet between other parameters.
    pub(crate) fn between(&self, range: [f64; 2]) -> Self {
        let mut part = *self;
        let (Self::Side { from, to, .. } | Self::Fan { from, to, .. }) = &mut part;
        [*from, *to] = range;
        part
    }

    /// Its two halves; `None` where there is no number between the ends.
    pub(crate) fn halves(&self) -> Option<[Self; 2]> {
        let [a, b] = self.range();
        let m = 0.5 * (a + b);
        (a < m && m < b).then(|| [self.between([a, m]), self.between([m, b])])
    }

    fn middle(&self) -> Self {
        let [a, b] = self.range();
        let m = (0.5 * (a + b)).clamp(a, b);
        self.between([m, m])
    }
}

/// Directions of a fan.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fan {
    /// (1−λ)e₁; e₁ is exactly normal to the branch.
    pub(crate) first: Enclosed<f64>,
    /// e₂.
    pub(crate) second: Enclosed<f64>,
    /// λ.
    pub(crate) share: Real,
}

/// The middle of a cell, for mean values: d·(q−f) = dₘ·(q−fₘ) + (u−uₘ) d'·(q−f) somewhere on it, since d·F' = 0. For a fan u is λ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mean {
    /// fₘ.
    pub(crate) point: Enclosed<f64>,
    /// dₘ.
    pub(crate) direction: Enclosed<f64>,
    /// d' on all of the cell.
    pub(crate) turning: Enclosed<f64>,
    /// u − uₘ.
    pub(crate) off: Real,
}

/// Enclosures over all feet of a cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Feet {
    /// The end that parameters are seen from: the nearer one, or the fan's.
    pub(crate) near: EndId,
    /// The parameters seen from there; `None` for a fan.
    pub(crate) u: Option<Real>,
    /// The direction is on the left of the tangent that leaves `near`.
    pub(crate) left: bool,
    pub(crate) point: Enclosed<f64>,
    /// d, not normalised.
    pub(crate) direction: Enclosed<f64>,
    /// |d|, above zero.
    pub(crate) length: Real,
    pub(crate) fan: Option<Fan>,
    pub(crate) mean: Mean,
}

/// What is known of where the medial points of a cell are, for radii that are not known yet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Capsule {
    /// A point near the foot in the middle, and a vector near its unit direction.
    pub(crate) foot: Point<f64>,
    pub(crate) normal: Vector<f64>,
    /// No foot is farther than `half` + `errors[0]` from it.
    pub(crate) half: f64,
    /// What foot and normal are off.
    errors: [f64; 2],
    /// Curvature towards d.
    bend: Option<Real>,
    /// No unit direction is farther than this from the normal.
    turn: f64,
}

pub(crate) fn unit(v: &Enclosed<f64>) -> Enclosed<f64> {
    let n = v.norm();
    Vector::new(v.x / n, v.y / n)
}

/// The direction in which a branch leaves its end, not normalised.
pub(crate) fn leaving(o: &Outgoing<f64>) -> &Enclosed<f64> {
    if o.retracted { &o.c[1] } else { &o.c[0] }
}

pub(crate) fn exact(p: &Point<f64>) -> Enclosed<f64> {
    Vector::new(Real::point(p.x), Real::point(p.y))
}

/// The smallest box around points.
fn hull<const N: usize>(xs: [Real; N], weights: [i32; N]) -> Real {
    let mut all = xs.iter().zip(weights).map(|(x, w)| *x / Real::int(w));
    let first = all.next().unwrap_or_else(Real::entire);
    all.fold(first, |a, b| a.hull(&b))
}

/// The tangent over parameters, seen from an end.
fn tangent(o: &Outgoing<f64>, from: Real, to: Real) -> Enclosed<f64> {
    let [c1, c2, c3] = &o.c;
    let axis = |c1: Real, c2: Real, c3: Real| {
        if o.retracted {
            hull(on([c2.twice(), c3 * Real::int(3)], from, to), [1, 1])
        } else {
            hull(on([c1, c2.twice(), c3 * Real::int(3)], from, to), [1, 2, 1])
        }
    };
    Vector::new(axis(c1.x, c2.x, c3.x), axis(c1.y, c2.y, c3.y))
}

/// Weighted control points of a stretch of a segment, seen from an end, less a point.
pub(crate) fn points(o: &Outgoing<f64>, from: Real, to: Real, origin: &Enclosed<f64>) -> [[Real; 4]; 2] {
    let [c1, c2, c3] = &o.c;
    [on([o.end.x - origin.x, c1.x, c2.x, c3.x], from, to), on([o.end.y - origin.y, c1.y, c2.y, c3.y], from, to)]
}

/// A box around a stretch of a segment.
pub(crate) fn box_of(o: &Outgoing<f64>, from: Real, to: Real) -> Enclosed<f64> {
    let [x, y] = points(o, from, to, &exact(&Point::new(0.0, 0.0)));
    Vector::new(hull(x, [1, 3, 3, 1]), hull(y, [1, 3, 3, 1]))
}

/// A parameter range from the start of a segment as one that is seen from an end: where it begins, where it ends.
pub(crate) fn seen(range: [f64; 2], side: usize) -> [Real; 2] {
    let [a, b] = range.map(Real::point);
    if side == 0 { [a, b] } else { [Real::int(1) - b, Real::int(1) - a] }
}

/// T × (q−f) = (v−u)² E with E linear in v, as coefficients of powers of v (T/u and c₁ = 0 where the handle is retracted).
pub(crate) fn own_bend(o: &Outgoing<f64>, u: Real) -> [Real; 2] {
    let [c1, c2, c3] = &o.c;
    let k23 = c2.cross(c3);
    if o.retracted {
        return [k23 * u, k23.twice()];
    }
    let (k12, k13) = (c1.cross(c2), c1.cross(c3));
    [(k23 * u + k13.twice()) * u + k12, k23.twice() * u + k13]
}

impl Feet {
    /// Encloses all feet of a cell; `None` where its direction may vanish, or the cell does not exist.
    pub(crate) fn new(scene: &Scene<'_>, span: &Span) -> Option<Self> {
        match *span {
            Span::Side { segment, left, from, to } => {
                let side = usize::from(from + to > 1.0);
                let near = EndId::new(segment, side);
                let o = scene.from(near)?;
                let [first, last] = seen([from, to], side);
                let t = tangent(o, first, last);
                let length = t.norm();
                if *length.lo() <= 0.0 || !length.hi().is_finite() {
                    return None;
                }
                let left = left == (side == 0);
                let normal = |t: Enclosed<f64>| if left { t.left() } else { t.left().opposite() };
                let u = first.hull(&last);
                let middle = Real::point(u.middle());
                let [_, c2, c3] = &o.c;
                let bent = if o.retracted {
                    c3.scaled(&Real::int(3))
                } else {
                    c2.scaled(&Real::int(2)).plus_scaled(&u, &c3.scaled(&Real::int(6)))
                };
                let mean = Mean {
                    point: o.point(&middle),
                    direction: normal(o.tangent(&middle)),
                    turning: normal(bent),
                    off: u - middle,
                };
                Some(Self {
                    near,
                    u: Some(u),
                    left,
                    point: box_of(o, first, last),
                    direction: normal(t),
                    length,
                    fan: None,
                    mean,
                })
            }
            Span::Fan { end, other, left, from, to } => {
                let near = end_of(end);
                let (own, across) = (scene.from(near)?, scene.from(end_of(other))?);
                let normal = |o: &Outgoing<f64>, left: bool| {
                    let n = unit(leaving(o)).left();
                    if left { n } else { n.opposite() }
                };
                let first = normal(own, left);
                // The bisector, in the one of two ways that divides by something.
                let sum = unit(leaving(own)).plus(&unit(leaving(across)));
                let second = if *sum.norm_sq().lo() > 0.25 {
                    unit(&sum).opposite()
                } else {
                    unit(&first.plus(&normal(across, !left)))
                };
                let lambda = Real::new(from, to);
                let middle = Real::point(lambda.middle());
                let turning = second.minus(&first);
                let mean = Mean {
                    point: own.end,
                    direction: first.plus(&turning.scaled(&middle)),
                    turning,
                    off: lambda - middle,
                };
                let first = first.scaled(&(Real::int(1) - lambda));
                let direction = first.plus(&second.scaled(&lambda));
                let length = direction.norm();
                if *length.lo() <= 0.0 || !length.hi().is_finite() {
                    return None;
                }
                let fan = Some(Fan { first, second, share: lambda });
                Some(Self { near, u: None, left, point: own.end, direction, length, fan, mean })
            }
        }
    }

    /// For a fixed q, how G = |q−f|² − 2R d·(q−f), |d| = 1, changes along the cell: G = Gₘ − c a·(q−f) with the answer (c, a), somewhere on it.
    ///
    /// Along a stretch d' = −k F', k the curvature towards d, so G' = −2(1−kR) F'·(q−f). Where the handle is retracted F' = uT and k|F'| is how
    /// fast T turns, (T × T')/|T|². In a fan d/|d| turns by (d × d')/|d|² = (e₁ × e₂)/|d|² towards left(d)/|d|.
    pub(crate) fn change(&self, scene: &Scene<'_>, radius: f64) -> Option<(Real, Enclosed<f64>)> {
        let radius = Real::point(radius);
        let turned = self.direction.left();
        let (twice, cube) = (self.mean.off.twice(), self.length.square() * self.length);
        let Some(u) = self.u else {
            return Some((twice * radius * self.mean.direction.cross(&self.mean.turning) / cube, turned));
        };
        let share = if scene.from(self.near)?.retracted {
            let turn = self.direction.cross(&self.mean.turning) / cube;
            u - if self.left { turn } else { -turn } * radius
        } else {
            Real::int(1) - self.bend(scene)? * radius
        };
        Some((twice * share, if self.left { turned.opposite() } else { turned }))
    }

    /// Curvature towards d; `None` where it has no bound, or the cell is a fan.
    fn bend(&self, scene: &Scene<'_>) -> Option<Real> {
        let (u, o) = (self.u?, scene.from(self.near)?);
        if o.retracted {
            return None;
        }
        let [e0, e1] = own_bend(o, u);
        let k = (e1 * u + e0).twice() / (self.length.square() * self.length);
        k.hi().is_finite().then_some(if self.left { k } else { -k })
    }

    /// The radius of curvature is at most this at all feet.
    pub(crate) fn osculating(&self, scene: &Scene<'_>) -> f64 {
        let (Some(u), Some(o)) = (self.u, scene.from(self.near)) else { return f64::INFINITY };
        let [e0, e1] = own_bend(o, u);
        let sign = |e: Real| if self.left { e } else { -e };
        let cube = self.length.square() * self.length;
        // Retracted: D = uT and E = 3k₂₃u, one factor u is divided out of |D|²|T|/(2E).
        let (over, under) =
            if o.retracted { (cube * u, sign(e1).half() * Real::int(3)) } else { (cube, sign(e1 * u + e0)) };
        if *under.lo() > 0.0 { *(over / under.twice()).hi() } else { f64::INFINITY }
    }
}

impl Capsule {
    /// Where the medial points of a cell are.
    pub(crate) fn new(scene: &Scene<'_>, span: &Span) -> Self {
        let unknown = |half: f64, foot: Point<f64>| Self {
            foot,
            normal: Vector::new(0.0, 0.0),
            half,
            errors: [0.0, 0.0],
            bend: None,
            turn: 1.0,
        };
        let whole = || unknown(f64::INFINITY, Point::new(0.0, 0.0));
        let Some(feet) = Feet::new(scene, span) else {
            // Any direction: within `turn` of no direction at all.
            let Span::Side { segment, from, to, .. } = *span else { return whole() };
            let Some(o) = scene.from(EndId::new(segment, 0)) else { return whole() };
            let bounds = box_of(o, Real::point(from), Real::point(to));
            let foot = Point::new(bounds.x.middle(), bounds.y.middle());
            return unknown(*bounds.minus(&exact(&foot)).norm().hi(), foot);
        };
        let Some(middle) = Feet::new(scene, &span.middle()) else { return whole() };
        let foot = Point::new(middle.point.x.middle(), middle.point.y.middle());
        let direction = unit(&middle.direction);
        let normal = Vector::new(direction.x.middle(), direction.y.middle());
        let n = Vector::new(Real::point(normal.x), Real::point(normal.y));
        let errors = [middle.point.minus(&exact(&foot)).norm(), direction.minus(&n).norm()].map(|e| *e.hi());
        let mut turn = unit(&feet.direction).minus(&n).norm().hi().min(2.0 + errors[1]);
        let (mut half, mut bend) = (0.0, None);
        if let (Some(u), Some(o)) = (feet.u, scene.from(feet.near)) {
            // |B'| is |T|, or u|T|; the middle is within half the width of u, and a rounding.
            let speed = if o.retracted { feet.length * u } else { feet.length };
            half = *(speed * (Real::point(u.width()).half() + Real::point(f64::EPSILON))).hi();
            bend = feet.bend(scene);
            if let Some(k) = bend {
                let along = Real::point(k.magnitude()) * Real::point(half) + Real::point(errors[1]);
                turn = turn.min(*along.hi());
            }
        }
        Self { foot, normal, half, errors, bend, turn }
    }

    /// f + ρd is nearer than this to foot + ρ normal, for all feet and all ρ from `low` to `high`.
    fn spread(&self, low: f64, high: f64) -> f64 {
        let (half, high_e) = (Real::point(self.half), Real::point(high));
        let [e0, e1] = self.errors.map(Real::point);
        let turned = half + e0 + Real::point(self.turn) * high_e;
        let Some(k) = self.bend else { return *turned.hi() };
        // d/ds (f + ρd) = (1 − kρ) T.
        let moved = (Real::int(1) - k * Real::new(low, high)).magnitude();
        let sheared = Real::point(moved) * half + e0 + e1 * high_e;
        turned.hi().min(*sheared.hi())
    }

    /// All f + ρd with one ρ lie within this disk: its centre, its radius.
    pub(crate) fn disk(&self, rho: f64) -> (Enclosed<f64>, f64) {
        let n = Vector::new(Real::point(self.normal.x), Real::point(self.normal.y));
        (exact(&self.foot).plus(&n.scaled(&Real::point(rho))), self.spread(rho, rho))
    }

    /// At most the distance from a point to all feet.
    pub(crate) fn off_feet(&self, p: &Point<f64>) -> f64 {
        let off = Real::point(self.half) + Real::point(self.errors[0]);
        *(exact(p).minus(&exact(&self.foot)).norm() - off).lo()
    }

    /// At most the distance from a point to all f + ρd, ρ from `low` to `high`.
    pub(crate) fn distance(&self, p: &Point<f64>, low: f64, high: f64) -> f64 {
        let n = Vector::new(Real::point(self.normal.x), Real::point(self.normal.y));
        let w = exact(p).minus(&exact(&self.foot));
        let (along, squared) = (w.dot(&n), n.norm_sq());
        let to = |rho: f64| *w.minus(&n.scaled(&Real::point(rho))).norm().lo();
        // Before the first end, behind the last one, or anywhere: the line.
        let axis = if *(along - squared * Real::point(low)).hi() <= 0.0 {
            to(low)
        } else if *(along - squared * Real::point(high)).lo() >= 0.0 {
            to(high)
        } else {
            // |n| is 1 but for a few roundings, or 0 where nothing is known of the direction.
            if *squared.lo() > 0.5 {
                *(w.cross(&n).abs() / squared.sqrt()).lo()
            } else {
                *(Real::point(to(low)) - squared.sqrt() * (Real::point(high) - Real::point(low))).lo()
            }
        };
        *(Real::point(axis) - Real::point(self.spread(low, high))).lo()
    }

    /// At least the distance from a point to all f + ρd, ρ from `low` to `high`.
    pub(crate) fn farthest(&self, p: &Point<f64>, low: f64, high: f64) -> f64 {
        let to = |rho: f64| exact(p).minus(&self.disk(rho).0).norm();
        let far = to(low).hi().max(*to(high).hi());
        *(Real::point(far) + Real::point(self.spread(low, high))).hi()
    }
}
