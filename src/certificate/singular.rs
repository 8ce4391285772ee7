//! Where lfs falls to 0: singular places, and the stretches of path around them that a floor serves.
//!
//! Around a corner, crossing, T-junction or retracted handle the floored condition allows |p−s| < floor on the *stretch* of the
//! path where ε·lfs is below that floor. That p lies on such a stretch is a claim of its own, and is proved from single feet:
//! r(f, d) ≤ ρ puts a point of M within ρ of f, so lfs(f) ≤ ρ.
//!
//! * A **place** is a foot with lfs ≤ 1e-7 of the diagonal. One is looked for beside every corner, open end, contact and retracted handle,
//!   nearer and nearer, by the radii of tangent disks; a point of C that such a disk cannot hold proves it. So one rule finds all kinds of
//!   singular points, and says nothing of strokes that only pass each other at a distance.
//! * From there `March` goes along the path in both directions, in steps on all of which lfs is certainly below floor/ε:
//!   since the place is near (lfs grows no faster than the distance), or since the medial point of some foot is. Such feet are tried
//!   between the step and the place, since beside a corner the nearest medial point of p stands on feet that are nearer to it, and
//!   around the step.
//!
//! What is listed is never longer than the true stretch.

use super::{BoundedFoot, Claim, Extent, Neighbourhood, Step};
use crate::buffer::{BufferFull, Store};
use crate::curve::contact::Contact;
use crate::curve::{CurveParam, JointKind};
use crate::geometry::{Point, Vector};
use crate::medial::cell::{FootSpan, slop};
use crate::medial::clear::{Scene, osculates, reaches};
use crate::medial::disk::tangent_disk;
use crate::medial::{Foot, Side};
use crate::scalar::Directed;

/// Feet that are tried for each step, from it to the place.
const FEET: i32 = 8;

/// Feet that are tried on either side of a step, a twelfth of the limit apart: the nearest medial point is then missed by less than a
/// hundredth of it.
const AROUND: i32 = 24;

/// A foot with an upper bound of its radius.
struct Reach<S> {
    foot: BoundedFoot<S>,
    point: Point<S>,
    direction: Vector<S>,
    radius: S,
}

/// An upper bound of the radius at a foot, and why; `None` where the plain radius is `limit` or more.
fn reach<S: Directed>(scene: &Scene<'_, S>, at: CurveParam<S>, side: Side, limit: &S) -> Option<Reach<S>> {
    let foot = Foot::normal(scene.curve, at, side)?;
    let disk = tangent_disk(scene.curve, &foot);
    if disk.radius >= *limit {
        return None;
    }
    let Foot { at, side, point, direction, .. } = foot;
    let CurveParam { segment, t } = at.clone();
    let span = [t.clone(), t];
    let feet = (FootSpan::Normal { segment, span, side }).feet(scene)?;
    let mut radius = osculates(scene, &feet);
    let mut witness = None;
    if let Some(touch) = disk.touch {
        let reached = reaches(scene, &feet, touch.at.segment, &touch.at.t);
        if reached < radius {
            (radius, witness) = (reached, Some(touch.at));
        }
    }
    Some(Reach { foot: BoundedFoot { at, side, witness }, point, direction, radius })
}

/// A point of C where lfs is nearly 0.
struct Place<S> {
    /// On the segment that was asked about, a twin or not: a neighbourhood holds its place.
    foot: BoundedFoot<S>,
    point: Point<S>,
    /// lfs is at most this.
    lfs: S,
}

/// A place beside a parameter of a segment, with lfs at most `limit`.
fn place<S: Directed>(scene: &Scene<'_, S>, segment: u32, t: &S, limit: &S) -> Option<Place<S>> {
    for k in 4..24 {
        let offset = S::one().mul_pow2(-2 * k);
        for beside in [t.clone() + &offset, t.clone() - &offset] {
            if beside < S::zero() || beside > S::one() || beside == *t {
                continue;
            }
            let at = CurveParam { segment, t: beside };
            for side in [Side::Left, Side::Right] {
                if let Some(reach) = reach(scene, at.clone(), side, &limit.clone().twice())
                    && reach.radius <= *limit
                {
                    let Reach { foot: BoundedFoot { witness, .. }, point, radius: lfs, .. } = reach;
                    return Some(Place { foot: BoundedFoot { at, side, witness }, point, lfs });
                }
            }
        }
    }
    None
}

/// Finds all singular places and the stretches around them.
///
/// `contacts` are those of the whole curve, sorted by segment. Extents come sorted by segment. Nothing is done where the claim has a floor of its
/// own, which holds everywhere.
///
/// # Errors
/// [`BufferFull`].
pub fn neighbourhoods<S: Directed>(
    scene: &Scene<'_, S>,
    contacts: &[Contact<S>],
    claim: &Claim<S>,
    places: &mut impl Store<Neighbourhood<S>>,
    steps: &mut impl Store<Step<S>>,
    extents: &mut impl Store<Extent<S>>,
) -> Result<(), BufferFull> {
    places.shorten(0);
    steps.shorten(0);
    extents.shorten(0);
    if claim.min_distance.is_some() {
        return Ok(());
    }
    let curve = scene.curve;
    let less = S::one() - &S::unit_roundoff().mul_pow2(8);
    let below = claim.singular_floor.clone() * curve.diagonal / &claim.epsilon * &less;
    let limit = claim.floor.clone() * curve.diagonal * &less;
    let mut march = March { scene, below, slop: slop(scene), places, steps, extents };
    for (segment, index) in curve.segments.iter().zip(0_u32..) {
        for side in 0..2 {
            let end = segment.end(side);
            // Contacts leave joints of the other stroke out: an open end may lie at one.
            if matches!(end.kind, JointKind::Corner | JointKind::Open) || end.retracted {
                let t = if side == 0 { S::zero() } else { S::one() };
                march.around(index, &t, &limit)?;
            }
        }
    }
    for contact in contacts {
        march.around(contact.segment, &contact.middle(), &limit)?;
    }
    // Contacts are those of obstacles: a stroke that repeats one has them as well.
    for (segment, index) in curve.segments.iter().zip(0_u32..) {
        let Some(twin) = segment.twin else { continue };
        let first = contacts.partition_point(|c| c.segment < twin.segment());
        for contact in contacts.get(first..).unwrap_or_default().iter().take_while(|c| c.segment == twin.segment()) {
            march.around(index, &twin.place(contact.middle()).t, &limit)?;
        }
    }
    extents.items_mut().sort_unstable_by(|a, b| {
        a.segment.cmp(&b.segment).then(a.span[0].partial_cmp(&b.span[0]).unwrap_or(core::cmp::Ordering::Equal))
    });
    Ok(())
}

struct March<'m, 's, S, P, T, E> {
    scene: &'m Scene<'s, S>,
    /// floor/ε.
    below: S,
    slop: S,
    places: &'m mut P,
    steps: &'m mut T,
    extents: &'m mut E,
}

impl<S, P, T, E> March<'_, '_, S, P, T, E>
where
    S: Directed,
    P: Store<Neighbourhood<S>>,
    T: Store<Step<S>>,
    E: Store<Extent<S>>,
{
    /// The neighbourhood of a place beside a parameter, if there is one.
    fn around(&mut self, segment: u32, t: &S, limit: &S) -> Result<(), BufferFull> {
        let Some(place) = place(self.scene, segment, t, limit) else { return Ok(()) };
        let Some(path) = self.scene.curve.segment(segment).map(|s| s.path) else { return Ok(()) };
        let first = self.steps.items().len();
        let extent = self.extents.items().len();
        let back = self.along(path, &place, false)?;
        let turned = self.extents.items().len();
        // In the order of the path.
        if let Some(steps) = self.steps.items_mut().get_mut(first..) {
            steps.reverse();
        }
        let ahead = self.along(path, &place, true)?;
        self.join(extent, turned);
        let count = self.steps.items().len() - first;
        let index = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        let Place { foot, point, .. } = place;
        let length = back + &ahead;
        self.places.push(Neighbourhood { path, foot, point, length, steps: (index(first), index(count)) })
    }

    /// Makes the extents before and behind a place one: the first of either direction.
    fn join(&mut self, first: usize, turned: usize) {
        let Some([before, ..]) = self.extents.items().get(first..turned) else { return };
        let Some([behind, ..]) = self.extents.items().get(turned..) else { return };
        if before.segment != behind.segment || before.span[1] != behind.span[0] {
            return;
        }
        let end = behind.span[1].clone();
        let last = self.extents.items().len() - 1;
        if let Some(before) = self.extents.items_mut().get_mut(first) {
            before.span[1] = end;
        }
        self.extents.items_mut().swap(turned, last);
        self.extents.shorten(last);
    }

    /// lfs is certainly below the limit on a stretch; if so, why, and about how long it is.
    fn small(&self, place: &Place<S>, segment: u32, span: &[S; 2], forwards: bool) -> Option<(Step<S>, S)> {
        let s = self.scene.curve.segment(segment)?;
        let (middle, half) = middle_of(&s.cubic, &span[0], &span[1]);
        let step = |foot| Step { segment, span: span.clone(), foot };
        let straight = middle.distance(&place.point);
        if straight.clone() + &half + &place.lfs + &self.slop < self.below {
            return Some((step(None), half.twice()));
        }
        if half > self.below.clone().half() {
            return None;
        }
        // Feet from here back to the place, as far as they are on this segment.
        let t = S::midpoint(&span[0], &span[1]);
        let back = if place.foot.at.segment == segment {
            place.foot.at.t.clone()
        } else if forwards {
            S::zero()
        } else {
            S::one()
        };
        let towards_place = (0..FEET).map(|k| (back.clone() - &t) * &S::ratio(k, FEET) + &t);
        // And in either direction: a medial point nearer than the limit has feet within twice that.
        let speed = s.power.derivative(&t).norm();
        let apart = if speed > S::zero() { self.below.clone() / &speed } else { S::zero() };
        let around = (1..=AROUND).flat_map(|k| [-k, k]).map(|k| apart.clone() * &S::ratio(2 * k, AROUND) + &t);
        for t in towards_place.chain(around.filter(|t| *t >= S::zero() && *t <= S::one())) {
            let at = CurveParam { segment, t };
            for side in [Side::Left, Side::Right] {
                let Some(Reach { foot, point, direction, radius }) = reach(self.scene, at.clone(), side, &self.below)
                else {
                    continue;
                };
                if radius >= self.below {
                    continue;
                }
                // M meets the segment from the foot to this point.
                let far = middle.distance(&point.plus_scaled(&radius, &direction)).max(middle.distance(&point));
                if far + &half + &self.slop.clone().twice() < self.below {
                    return Some((step(Some(foot)), half.twice()));
                }
            }
        }
        None
    }

    /// Goes along the path from a place, forwards or backwards, while lfs is certainly below the limit. Answers how far.
    fn along(&mut self, path: u32, place: &Place<S>, forwards: bool) -> Result<S, BufferFull> {
        let mut length = S::zero();
        let curve = self.scene.curve;
        let Some(&along) = curve.paths.get(path as usize) else { return Ok(length) };
        let name = u32::try_from(self.places.items().len()).unwrap_or(u32::MAX);
        let least = self.below.clone().mul_pow2(-9);
        let most = self.below.clone().half();
        let CurveParam { mut segment, mut t } = place.foot.at.clone();
        // A step is a 512th of the limit at least, or goes to the end of a segment: the path or the stretch ends it.
        for _ in 0..=along.count {
            let Some(s) = curve.segment(segment) else { break };
            let start = t.clone();
            let goal = if forwards { S::one() } else { S::zero() };
            let mut size = most.clone();
            while t != goal {
                // A parameter step for that length, by the speed here and in the end.
                let speed = s.power.derivative(&t).norm().max(s.power.derivative(&goal).norm());
                let mut dt = if speed > S::zero() { size.clone() / &speed } else { S::one() };
                dt = dt.max(S::unit_roundoff().mul_pow2(4));
                let next =
                    if forwards { (t.clone() + &dt).min(goal.clone()) } else { (t.clone() - &dt).max(goal.clone()) };
                let span = if forwards { [t.clone(), next.clone()] } else { [next.clone(), t.clone()] };
                if let Some((step, long)) = self.small(place, segment, &span, forwards) {
                    self.steps.push(step)?;
                    length = length + &long;
                    t = next;
                    size = size.twice().min(most.clone());
                } else if size > least {
                    size = size.mul_pow2(-2);
                } else {
                    break;
                }
            }
            let span = if forwards { [start, t.clone()] } else { [t.clone(), start] };
            if span[1] > span[0] {
                self.extents.push(Extent { segment, span, neighbourhood: name })?;
            }
            if t != goal {
                break;
            }
            // On to the next segment of the path.
            let k = segment - along.first;
            let next = match (forwards, along.closed) {
                (true, _) if k + 1 < along.count => k + 1,
                (true, true) => 0,
                (false, _) if k > 0 => k - 1,
                (false, true) => along.count - 1,
                _ => break,
            };
            segment = along.first + next;
            t = if forwards { S::zero() } else { S::one() };
        }
        Ok(length)
    }
}

/// A point near the middle of a piece and a bound of the distance of all of it.
fn middle_of<S: Directed>(cubic: &crate::bezier::Cubic<S>, a: &S, b: &S) -> (Point<S>, S) {
    let piece = cubic.part(a, b);
    let [p0, p1, p2, p3] = &piece.points;
    let middle = p0.middle(p3).middle(&p1.middle(p2));
    let half = piece.points.iter().map(|c| c.distance(&middle)).fold(S::zero(), S::max);
    (middle, half)
}
