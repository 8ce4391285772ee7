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
//! *capsule*. `lower` comes from an emptiness proof over all of C ([`Cell::enclose`]), `upper` from single points of C.
//! Proofs: `docs/certificates.md`, sections 2 to 5.

use super::clear::{FanFeet, Feet, Scene, Stretch, clears, curvature, osculates, reaches};
use super::disk::tangent_disk;
use super::foot::{Foot, Side};
use crate::curve::ideal::{Enclosed, Outgoing};
use crate::curve::{CurveParam, EndId, JointKind};
use crate::geometry::{Point, Vector, distance_sq_to_segment};
use crate::scalar::{Directed, Enclosure as Interval, Field};
use arrayvec::ArrayVec;

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
    bend: Option<[S; 2]>,
    /// No unit direction is farther than this from nₘ.
    turn: S,
    /// Errors of fₘ and nₘ.
    errors: [S; 2],
    /// At most r(f, d), for all feet.
    pub lower: S,
    /// At least r(f, d), for all feet.
    pub upper: S,
    /// The point of C that gave `upper`.
    pub witness: Option<CurveParam<S>>,
    /// r at the first foot, in the middle and at the last one, as found without proof: where the search for bounds starts.
    pub guess: [S; 3],
    /// The bounds were looked for up to this radius; below zero: not at all.
    pub asked: S,
    /// Index of the first of its two halves, in a band.
    pub children: u32,
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
fn leaving<S: Directed>(o: &Outgoing<S>) -> &Enclosed<S> {
    let [c1, c2, _] = &o.c;
    if o.retracted { c2 } else { c1 }
}

fn unit<S: Directed>(v: &Enclosed<S>) -> Enclosed<S> {
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
                Some(Feet {
                    segment: *segment,
                    from: Some([from, back]),
                    side: near,
                    left,
                    point,
                    direction: if left { normal } else { normal.opposite() },
                    length,
                    fan: None,
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
                    fan: Some(FanFeet { branch: *end, first, second }),
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

/// Whether it is certain that a joint, or an end, belongs to M: two of its branches are not opposite to each other, or one of
/// them has curvature without bound.
pub fn singular<S: Directed>(scene: &Scene<'_, S>, end: EndId) -> bool {
    let directions = |e: EndId| scene.outgoing(e).map(|o| unit(leaving(o)));
    let bent = |e: EndId| scene.outgoing(e).is_some_and(|o| o.retracted && !o.c[1].cross(&o.c[2]).contains(&S::zero()));
    let Some(first) = directions(end) else { return false };
    let kinked = |e: EndId| directions(e).is_some_and(|d| *first.plus(&d).norm_sq().lo() > S::unit_roundoff());
    let joined = scene.curve.end(end).is_some_and(|e| e.kind == JointKind::Corner);
    scene.curve.joint(end).any(|e| bent(e) || (joined && e != end && kinked(e)))
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
            asked: -S::one(),
            children: UNDIVIDED,
            feet,
        };
        if let FootSpan::Corner { end } = &cell.feet {
            cell.upper = if singular(scene, *end) { zero() } else { S::infinity() };
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
    fn axis(&self, rho: &S) -> Point<S> {
        self.centre.plus_scaled(rho, &self.normal)
    }

    /// At most the distance from p to every medial point of the cell with a radius below `limit`; the rounding of plain
    /// numbers is not allowed for.
    pub fn distance(&self, p: &Point<S>, limit: &S) -> S {
        let far = self.upper.clone().min(limit.clone()).max(self.lower.clone());
        let d = distance_sq_to_segment(p, &self.axis(&self.lower), &self.axis(&far)).sqrt();
        d - &self.spread(&self.lower, &far)
    }

    /// At least the distance from p to every medial point of the cell, of which there are some; infinite where nothing is
    /// known. The rounding of plain numbers is not allowed for.
    pub fn farthest(&self, p: &Point<S>) -> S {
        if !self.upper.is_finite() {
            return S::infinity();
        }
        let (a, b) = (p.distance(&self.axis(&self.lower)), p.distance(&self.axis(&self.upper)));
        a.max(b) + &self.spread(&self.lower, &self.upper)
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

    /// The plain foot in the middle (0 for the first, 2 for the last).
    fn plain_foot(&self, scene: &Scene<'_, S>, which: usize) -> Option<Foot<S>> {
        let pick = |[a, b]: &[S; 2]| match which {
            0 => a.clone(),
            2 => b.clone(),
            _ => S::midpoint(a, b),
        };
        match &self.feet {
            FootSpan::Normal { segment, span, side } => {
                Foot::normal(scene.curve, CurveParam { segment: *segment, t: pick(span) }, *side)
            }
            FootSpan::Fan { end, .. } => {
                let mut feet = self.feet.clone();
                if let FootSpan::Fan { span, .. } = &mut feet {
                    let l = pick(span);
                    *span = [l.clone(), l];
                }
                let d = feet.feet(scene)?.direction;
                Foot::fan(scene.curve, *end, Vector::new(d.x.middle(), d.y.middle()).unit()?)
            }
            FootSpan::Corner { .. } => None,
        }
    }

    /// Encloses the radii, as far as they are below `limit`.
    ///
    /// The lower bound starts from disks found without proof and falls until nothing of C is left that is not proved to be
    /// outside; the upper bound is the best of those that the points give which bounded these disks.
    pub fn enclose(&mut self, scene: &Scene<'_, S>, limit: &S) {
        if self.asked >= *limit {
            return;
        }
        self.asked = limit.clone();
        let Some(feet) = self.feet.feet(scene) else { return };
        let mut witnesses: ArrayVec<CurveParam<S>, WITNESSES> = ArrayVec::new();
        for which in 0..3 {
            if self.guess[which] >= S::zero() && which != 1 {
                continue;
            }
            let Some(foot) = self.plain_foot(scene, which) else { continue };
            let disk = tangent_disk(scene.curve, &foot);
            self.guess[which] = disk.radius.clone();
            let Some(touch) = disk.touch else { continue };
            if disk.radius <= self.half.clone() + &slop(scene) {
                self.beside(scene, &foot, &touch.at, &mut witnesses);
            }
            if witnesses.try_push(touch.at).is_err() {
                break;
            }
        }
        for at in witnesses {
            let upper = reaches(scene, &feet, at.segment, &at.t);
            if upper < self.upper {
                self.upper = upper;
                self.witness = Some(at);
            }
        }
        let osculating = osculates(scene, &feet);
        if osculating < self.upper {
            self.upper = osculating;
            self.witness = None;
        }
        let [g0, g1, g2] = self.guess.clone();
        let least = g0.min(g1).min(g2);
        // Asked again for a little more, it would start again: so it looks a little farther.
        let limit = limit.clone() * &S::ratio(3, 2);
        let capped = limit < least;
        self.asked = if capped { limit.clone() } else { S::infinity() };
        let least = least.min(limit);
        let start = least.clone() * &(S::one() - &self.first_fall(&least));
        if start <= self.lower {
            return;
        }
        let lower = self.empty(scene, &feet, start.clone());
        if lower < start {
            self.asked = S::infinity();
        }
        if lower > self.lower {
            self.lower = lower;
        }
    }

    /// Witnesses where another stroke comes as near as the cell is long, or touches it. The nearest point of that stroke lies ahead of
    /// some feet and behind others and says nothing of the whole cell; points of it that are a few lengths of the cell farther on do,
    /// and what bounds the stroke's own disk there.
    fn beside(
        &self,
        scene: &Scene<'_, S>,
        foot: &Foot<S>,
        at: &CurveParam<S>,
        out: &mut ArrayVec<CurveParam<S>, WITNESSES>,
    ) {
        let Some(speed) = scene.curve.segment(at.segment).map(|s| s.power.derivative(&at.t).norm()) else { return };
        // A fan has no length: then every scale from roundings upwards.
        let (start, growth, steps) =
            if self.half > S::zero() { (self.half.clone().twice(), 1, 8) } else { (slop(scene).mul_pow2(4), 3, 12) };
        let mut offset = start / &speed;
        for _ in 0..steps {
            for side in 0..2 {
                let left = if side == 0 { at.t.clone() } else { S::one() - &at.t };
                // From that end: on this segment, or across the joint.
                if left >= offset {
                    let _ = out.try_push(seen_from(EndId::new(at.segment, side), left - &offset));
                } else if offset <= S::one() {
                    for other in scene.curve.joint(EndId::new(at.segment, side)).skip(1) {
                        let _ = out.try_push(seen_from(other, offset.clone() - &left));
                    }
                }
            }
            offset = offset.mul_pow2(growth);
        }
        let Some(normal) = scene.curve.segment(at.segment).map(|s| s.tangent(&at.t).left()) else { return };
        let side = if normal.dot(&foot.direction) > S::zero() { Side::Left } else { Side::Right };
        let own = Foot::normal(scene.curve, at.clone(), side);
        if let Some(touch) = own.and_then(|f| tangent_disk(scene.curve, &f).touch) {
            let _ = out.try_push(touch.at);
        }
    }

    /// By which share a radius is lowered first: about what it varies by along the cell, and less than 2^−9.
    fn first_fall(&self, radius: &S) -> S {
        let share = if *radius > S::zero() { self.half.clone() / radius + &self.turn } else { S::one() };
        share.mul_pow2(-2).clamp(S::unit_roundoff().mul_pow2(12), S::one().mul_pow2(-9))
    }

    /// The largest radius found, at most `start`, for which the disks at all feet are proved empty.
    fn empty(&self, scene: &Scene<'_, S>, feet: &Feet<S>, start: S) -> S {
        let mut proof = Emptiness {
            cell: self,
            scene,
            feet,
            radius: start,
            centre: self.centre.clone(),
            reach_sq: S::zero(),
            tries: TRIES,
        };
        proof.renew();
        let towards = proof.centre.clone();
        scene.curve.hierarchy().traverse(
            &towards,
            &mut proof,
            |p, bounds| p.radius > p.cell.lower && bounds.distance_sq(&p.centre) <= p.reach_sq,
            |p, arc, _| p.arc(arc),
        );
        proof.radius
    }
}

/// The place at a parameter that is counted from an end.
fn seen_from<S: Directed>(end: EndId, u: S) -> CurveParam<S> {
    CurveParam { segment: end.segment(), t: if end.side() == 0 { u } else { S::one() - &u } }
}

/// Points of C that are tried as upper bounds: three touchings, and what is beside them.
const WITNESSES: usize = 80;

/// Pieces that one emptiness proof looks at, at most. Cells that succeed take 20 to 60 on the drawings at hand.
const TRIES: u32 = 400;

/// State of an emptiness proof.
struct Emptiness<'p, 's, S> {
    cell: &'p Cell<S>,
    scene: &'p Scene<'s, S>,
    feet: &'p Feet<S>,
    /// The radius that is to be proved.
    radius: S,
    /// All disks lie within a disk around this point,
    centre: Point<S>,
    /// of this radius, squared.
    reach_sq: S,
    /// So many pieces may still be looked at.
    tries: u32,
}

impl<S: Directed> Emptiness<'_, '_, S> {
    /// The disk around all disks, for the current radius.
    fn renew(&mut self) {
        self.centre = self.cell.axis(&self.radius);
        let reach = self.cell.spread(&self.radius, &self.radius) + &self.radius + &slop(self.scene);
        let reach = reach * &(S::one() + &S::unit_roundoff().mul_pow2(5));
        self.reach_sq = reach.square();
    }

    /// Lowers the radius until the arc is proved to be outside.
    fn arc(&mut self, index: u32) {
        let Some(arc) = self.scene.curve.arcs.get(index as usize) else { return };
        let Some(segment) = self.scene.curve.segment(arc.segment) else { return };
        let mut pending: ArrayVec<[S; 2], 48> = ArrayVec::new();
        pending.push(arc.span.clone());
        while let Some(span) = pending.pop() {
            // A cell that takes more than this is too large, or touches C: its parent's bound stands.
            self.tries = self.tries.saturating_sub(1);
            if self.tries == 0 {
                self.radius = self.cell.lower.clone();
                self.renew();
                return;
            }
            let piece = Stretch { segment: arc.segment, span };
            if clears(self.scene, self.feet, &piece, &self.radius) {
                continue;
            }
            let [a, b] = &piece.span;
            let m = S::midpoint(a, b);
            // Shorter than the cell, or than what its directions move the disk by, a piece has nothing to gain.
            let least = self.cell.half.clone().twice().max(self.cell.turn.clone() * &self.radius.clone().half());
            let least = least.max(self.radius.clone().mul_pow2(-12));
            let long = segment.point(a).distance(&segment.point(b)) > least;
            if long && m > *a && m < *b && pending.remaining_capacity() >= 2 {
                pending.push([m.clone(), b.clone()]);
                pending.push([a.clone(), m]);
                continue;
            }
            // Fall faster and faster; what is left at the end is nothing.
            let mut fall = self.cell.first_fall(&self.radius);
            loop {
                self.radius = self.radius.clone() * &(S::one() - &fall);
                fall = fall.twice();
                if self.radius <= self.cell.lower || fall >= S::one() {
                    self.radius = self.cell.lower.clone();
                    self.renew();
                    return;
                }
                if clears(self.scene, self.feet, &piece, &self.radius) {
                    break;
                }
            }
            self.renew();
        }
    }
}

/// Calls `each` with every cell that a subdivision of the foot set starts from, in a fixed order: one for each side of each
/// arc, then those at joints.
pub fn roots<S: Directed, E>(
    scene: &Scene<'_, S>,
    mut each: impl FnMut(FootSpan<S>) -> Result<(), E>,
) -> Result<(), E> {
    for arc in scene.curve.arcs {
        for side in [Side::Left, Side::Right] {
            each(FootSpan::Normal { segment: arc.segment, span: arc.span.clone(), side })?;
        }
    }
    let whole = || [S::zero(), S::one()];
    for (segment, index) in scene.curve.segments.iter().zip(0_u32..) {
        if segment.twin.is_some() {
            continue;
        }
        for side in 0..2 {
            let end = EndId::new(index, side);
            let Some(here) = scene.curve.end(end) else { continue };
            match here.kind {
                JointKind::Smooth => {}
                JointKind::Open => {
                    for left in [true, false] {
                        each(FootSpan::Fan { end, other: end, left, span: whole() })?;
                    }
                }
                JointKind::Corner => {
                    // Once a joint, at its first end; ends of repetitions may come before it and are not looked at.
                    let is_obstacle = |e: &EndId| scene.curve.segment(e.segment()).is_some_and(|s| s.twin.is_none());
                    if scene.curve.joint(end).filter(is_obstacle).all(|e| e >= end) {
                        each(FootSpan::Corner { end })?;
                        cone(scene, end, &mut each)?;
                    }
                }
            }
        }
    }
    Ok(())
}

/// The fans of a joint of several branches: those directions that point away from all of them form a cone between the right
/// normal of one and the left normal of another, such that no branch lies certainly to the right of the first or to the left of
/// the second. Roundings can leave several such pairs, then all are taken; if they leave none, there is no cone.
fn cone<S: Directed, E>(
    scene: &Scene<'_, S>,
    joint: EndId,
    each: &mut impl FnMut(FootSpan<S>) -> Result<(), E>,
) -> Result<(), E> {
    let direction = |e: EndId| scene.outgoing(e).map(|o| unit(leaving(o)));
    let extreme = |end: EndId, right: bool| {
        direction(end).is_some_and(|u| {
            scene.curve.joint(joint).filter(|e| *e != end).filter_map(direction).all(|v| {
                let cross = u.cross(&v);
                if right { *cross.hi() >= S::zero() } else { *cross.lo() <= S::zero() }
            })
        })
    };
    for end in scene.curve.joint(joint).filter(|&e| extreme(e, true)) {
        for other in scene.curve.joint(joint).filter(|&e| e != end && extreme(e, false)) {
            let whole = || [S::zero(), S::one()];
            each(FootSpan::Fan { end, other, left: false, span: whole() })?;
            each(FootSpan::Fan { end: other, other: end, left: true, span: whole() })?;
        }
    }
    Ok(())
}
