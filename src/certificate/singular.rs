//! Where lfs falls to 0: singular places, and the stretches of path around them that a floor serves.
//!
//! Around a corner, crossing, T-junction or retracted handle the floored condition allows |p−s| < floor on the *stretch* of the
//! path where ε·lfs is below that floor. That p lies on such a stretch is a claim of its own, and is proved: at the singular
//! place M comes as near as [`Place::distance`] says, and from there `march` goes along the path in both directions as long
//! as an upper bound of lfs stays below floor/ε. Upper bounds are |p−x| plus what M is away from x, and those of the medial
//! points that stand on p itself. What is listed is never longer than the true stretch.
//!
//! **Joints.** Where branches leave a point in directions that are not opposite to each other, points on a bisector have two
//! nearest ones arbitrarily near to it: it belongs to M. So does the end of a branch whose curvature has no bound.
//!
//! **Contacts.** Let f and q be points of two strokes, |f−q| ≤ δ, and let neither stroke, followed from f, reach q within 2δ.
//! Then M comes within 2δ of f: otherwise all points of the segment from f to q had a unique nearest point, which would move
//! continuously along C from f to q, and never farther than 2δ from f; since the stroke itself leaves that disk without
//! meeting q, it would have to change strokes at a crossing, and a crossing with a clear angle belongs to M.
//! Strokes that touch without an angle, or coincide, are left alone: nothing is claimed about them.

use super::{Claim, Extent, Neighbourhood};
use crate::buffer::{BufferFull, Store};
use crate::curve::contact::Contact;
use crate::curve::nearest::{Locality, nearest_non_local};
use crate::curve::{CurveParam, EndId, JointKind};
use crate::geometry::Point;
use crate::lfs::bound::Band;
use crate::medial::cell::Cell;
use crate::scalar::Directed;

/// A point of C near which lfs is 0.
#[derive(Clone, Debug)]
pub struct Place<S> {
    /// Where it is.
    pub at: CurveParam<S>,
    /// The point.
    pub point: Point<S>,
    /// M comes at least as near as this.
    pub distance: S,
}

/// The place of a corner, if it is certain that it belongs to M.
pub fn corner<S: Directed, B: Store<Cell<S>>>(band: &Band<'_, S, B>, end: EndId) -> Option<Place<S>> {
    let scene = band.scene();
    let certain = crate::medial::cell::singular(scene, end);
    let t = if end.side() == 0 { S::zero() } else { S::one() };
    let point = scene.curve.end_point(end)?.clone();
    certain.then(|| Place { at: CurveParam { segment: end.segment(), t }, point, distance: band.slop().clone() })
}

/// The place of a contact, if it is certain that M comes near it.
pub fn touching<S: Directed, B: Store<Cell<S>>>(band: &Band<'_, S, B>, contact: &Contact<S>) -> Option<Place<S>> {
    let curve = band.scene().curve;
    let at = CurveParam { segment: contact.segment, t: contact.middle() };
    let segment = curve.segment(at.segment)?;
    let f = segment.point(&at.t);
    // Far above rounding, far below every floor.
    let small = curve.diagonal.clone() / &S::int(10_000_000);
    let own = Locality::of(curve, &at)?;
    let near = nearest_non_local(curve, &f, &own, small.clone().square())?;
    let other = curve.segment(near.at.segment)?;
    let sine = segment.tangent(&at.t).cross(&other.tangent(&near.at.t)).abs();
    if sine * &S::int(1000) < S::one() {
        return None;
    }
    let distance = near.distance_sq.sqrt().twice() + band.slop();
    // Followed from f either way, the stroke leaves the disk on this segment, or ends.
    let leaves = |side: usize| {
        let end = segment.end(side);
        let open = end.kind == JointKind::Open;
        let mut t = if side == 0 { S::zero() } else { S::one() };
        let mut left = false;
        // Halvings of the way, as long as what lies between turns by less than a quarter.
        for _ in 0..40 {
            if segment.point(&t).distance(&f) <= distance.clone().twice() {
                break;
            }
            left |= segment.tangent(&t).dot(&segment.tangent(&at.t)) > S::zero();
            t = S::midpoint(&t, &at.t);
        }
        left || open
    };
    (leaves(0) && leaves(1)).then(|| Place { at, point: f, distance })
}

/// Finds all singular places and the stretches around them.
///
/// `contacts` are those of the whole curve. Extents come sorted by segment. Nothing is done where the claim has a floor of its
/// own, which holds everywhere.
///
/// # Errors
/// [`BufferFull`].
pub fn neighbourhoods<S: Directed, B: Store<Cell<S>>>(
    band: &mut Band<'_, S, B>,
    contacts: &[Contact<S>],
    claim: &Claim<S>,
    places: &mut impl Store<Neighbourhood<S>>,
    extents: &mut impl Store<Extent<S>>,
) -> Result<(), BufferFull> {
    places.shorten(0);
    extents.shorten(0);
    if claim.min_distance.is_some() {
        return Ok(());
    }
    let curve = band.scene().curve;
    let below =
        claim.singular_floor.clone() * curve.diagonal / &claim.epsilon * &(S::one() - &S::unit_roundoff().mul_pow2(8));
    let mut march = March { band, below, places, extents };
    for (path, index) in curve.paths.iter().zip(0_u32..) {
        for segment in path.first..path.first + path.count {
            let Some(s) = curve.segment(segment) else { continue };
            for side in 0..2 {
                if s.end(side).kind != JointKind::Corner && !s.end(side).retracted {
                    continue;
                }
                // A twin stands in the joint of the segment that it repeats.
                let end = match s.twin {
                    Some(t) => EndId::new(t.segment, if t.reversed { 1 - side } else { side }),
                    None => EndId::new(segment, side),
                };
                if let Some(mut place) = corner(march.band, end) {
                    place.at = CurveParam { segment, t: if side == 0 { S::zero() } else { S::one() } };
                    march.from(index, &place, side == 0)?;
                }
            }
        }
    }
    for contact in contacts {
        let Some(place) = touching(march.band, contact) else { continue };
        let Some(path) = curve.segment(contact.segment).map(|s| s.path) else { continue };
        march.from(path, &place, true)?;
        march.from(path, &place, false)?;
    }
    extents.items_mut().sort_unstable_by(|a, b| {
        a.segment.cmp(&b.segment).then(a.span[0].partial_cmp(&b.span[0]).unwrap_or(core::cmp::Ordering::Equal))
    });
    Ok(())
}

struct March<'m, 'b, S, B, P, E> {
    band: &'m mut Band<'b, S, B>,
    /// floor/ε.
    below: S,
    places: &'m mut P,
    extents: &'m mut E,
}

impl<S, B, P, E> March<'_, '_, S, B, P, E>
where
    S: Directed,
    B: Store<Cell<S>>,
    P: Store<Neighbourhood<S>>,
    E: Store<Extent<S>>,
{
    /// Goes along the path from a place, forwards or backwards, while lfs is certainly below the limit.
    fn from(&mut self, path: u32, place: &Place<S>, forwards: bool) -> Result<(), BufferFull> {
        let curve = self.band.scene().curve;
        let Some(&along) = curve.paths.get(path as usize) else { return Ok(()) };
        let name = u32::try_from(self.places.items().len()).unwrap_or(u32::MAX);
        let least = self.below.clone().mul_pow2(-9);
        let mut segment = place.at.segment;
        let mut t = place.at.t.clone();
        let mut length = S::zero();
        // A step is a 512th of the limit at least, or goes to the end of a segment: the path or the stretch ends it.
        'segments: for _ in 0..=along.count {
            let Some(s) = curve.segment(segment) else { break };
            let start = t.clone();
            let goal = if forwards { S::one() } else { S::zero() };
            let mut step = self.below.clone().mul_pow2(-1);
            while t != goal {
                // A parameter step for that length, by the speed here and in the end.
                let speed = s.power.derivative(&t).norm().max(s.power.derivative(&goal).norm());
                let mut dt = if speed > S::zero() { step.clone() / &speed } else { S::one() };
                dt = dt.max(S::unit_roundoff().mul_pow2(4));
                let next =
                    if forwards { (t.clone() + &dt).min(goal.clone()) } else { (t.clone() - &dt).max(goal.clone()) };
                let (a, b) = if forwards { (&t, &next) } else { (&next, &t) };
                let (middle, half) = middle_of(&s.cubic, a, b);
                let straight = middle.distance(&place.point) + &place.distance + &half;
                let mut sure = straight + self.band.slop() < self.below;
                if !sure && half <= self.below.clone().mul_pow2(-3) {
                    let at = CurveParam { segment, t: S::midpoint(a, b) };
                    let upper = self.band.upper_at(&at, &middle, &self.below) + &half + self.band.slop();
                    sure = upper < self.below;
                }
                if sure {
                    length = length + &half.twice();
                    t = next;
                    step = (step.clone() * &S::int(2)).min(self.below.clone().mul_pow2(-1));
                } else if step > least {
                    step = step.mul_pow2(-2);
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
                _ => break 'segments,
            };
            segment = along.first + next;
            t = if forwards { S::zero() } else { S::one() };
        }
        self.places.push(Neighbourhood { path, at: place.at.clone(), point: place.point.clone(), length, forwards })
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
