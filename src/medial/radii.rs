//! Enclosing the radii of a cell.
//!
//! **From below** by a proof that disks are empty. It starts from disks that were found without proof, a little smaller than the least of them,
//! and goes through the hierarchy: boxes outside of a disk around all of the cell's disks are done at once, pieces of arcs are proved to
//! be outside by their own boxes or by the forms of [`super::clear`], or halved, down to the length of the cell; what then fails lowers the radius. Since disks are
//! nested (`docs/mathematics.md`, section 3) what was shown for a larger radius stays shown.
//!
//! **From above** by single points of C that no larger empty disk can hold, and by the curvature: the points that bounded the plain disks, and
//! where another stroke is as near as the cell is long, points beside those.
//!
//! How good the bounds are depends on what was found without proof, not whether they hold.

use super::cell::{Cell, FootSpan, slop};
use super::clear::{Feet, Scene, Stretch, clears, clears_nearby, osculates, reaches};
use super::disk::tangent_disk;
use super::family::Family;
use super::foot::{Foot, Side};
use crate::curve::{CurveParam, EndId};
use crate::geometry::{Point, Vector};
use crate::scalar::Directed;
use arrayvec::ArrayVec;

impl<S: Directed> Cell<S> {
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

    /// Finds the upper bound of the radii, and the plain disks that the search for a lower one starts from.
    ///
    /// The upper bound is the best of those that the points give which bounded these disks.
    pub fn look(&mut self, scene: &Scene<'_, S>) {
        if self.looked {
            return;
        }
        self.looked = true;
        let Some(feet) = self.feet.feet(scene) else { return };
        let mut witnesses: ArrayVec<CurveParam<S>, WITNESSES> = ArrayVec::new();
        for which in 0..3 {
            if self.guess[which] >= S::zero() {
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
    }

    /// Where the search for a lower bound up to `limit` starts, and up to which radius it then has looked.
    fn start(&self, scene: &Scene<'_, S>, limit: &S) -> [S; 2] {
        let [g0, g1, g2] = self.guess.clone();
        let least = g0.min(g1).min(g2);
        // Asked again for a little more, it would start again: so it looks a little farther.
        let limit = limit.clone() * &S::ratio(3, 2);
        // A plain disk says 0 where an end of another stroke lies at the foot, whether or not that stroke leads into it: then the search
        // starts from what is asked for.
        let capped = limit < least || least <= slop(scene);
        let asked = if capped { limit.clone() } else { S::infinity() };
        let least = if capped { limit } else { least };
        [least.clone() * &(S::one() - &self.first_fall(&least)), asked]
    }

    /// The largest lower bound of the radii that [`Cell::enclose`] may find.
    pub fn hoped(&self, scene: &Scene<'_, S>, limit: &S) -> S {
        if !self.looked || self.asked >= *limit {
            return self.lower.clone();
        }
        let [start, _] = self.start(scene, limit);
        start.max(self.lower.clone())
    }

    /// Encloses the radii, as far as they are below `limit`.
    ///
    /// The lower bound starts from disks found without proof and falls until nothing of C is left that is not proved to be
    /// outside.
    pub fn enclose(&mut self, scene: &Scene<'_, S>, limit: &S) {
        if self.asked >= *limit {
            return;
        }
        self.look(scene);
        let [start, asked] = self.start(scene, limit);
        self.asked = asked;
        if start <= self.lower {
            return;
        }
        let Some(feet) = self.feet.feet(scene) else { return };
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
        let share = if *radius > S::zero() { self.half.clone() / radius + self.turning() } else { S::one() };
        share.mul_pow2(-2).clamp(S::unit_roundoff().mul_pow2(12), S::one().mul_pow2(-9))
    }

    /// The largest radius found, at most `start`, for which the disks at all feet are proved empty.
    fn empty(&self, scene: &Scene<'_, S>, feet: &Feet<S>, start: S) -> S {
        let mut proof = Emptiness {
            cell: self,
            scene,
            feet,
            family: Family::new(scene, self, &start),
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
    /// The disks, and
    family: Family<S>,
    /// a disk around this point that holds them all,
    centre: Point<S>,
    /// its radius, squared.
    reach_sq: S,
    /// So many pieces may still be looked at.
    tries: u32,
}

impl<S: Directed> Emptiness<'_, '_, S> {
    /// The disks, and the one around all of them, for the current radius.
    fn renew(&mut self) {
        self.family = Family::new(self.scene, self.cell, &self.radius);
        self.centre = self.cell.axis(&self.radius);
        let reach = self.cell.spread(&self.radius, &self.radius) + &self.radius + &slop(self.scene);
        let reach = reach * &(S::one() + &S::unit_roundoff().mul_pow2(5));
        self.reach_sq = reach.square();
    }

    /// Nothing was shown that was not known.
    fn give_up(&mut self) {
        self.radius = self.cell.lower.clone();
        self.renew();
    }

    /// Lowers the radius until the arc is proved to be outside.
    fn arc(&mut self, index: u32) {
        let Some(arc) = self.scene.curve.arc(index) else { return };
        let Some(segment) = self.scene.curve.segment(arc.segment) else { return };
        let touches = self.scene.touches(self.feet, arc.segment);
        let mut pending: ArrayVec<[S; 2], 48> = ArrayVec::new();
        pending.push(arc.span.clone());
        while let Some(span) = pending.pop() {
            // The box of a part is smaller than that of the arc, and forms cost more than a hundred times as much.
            let part = segment.cubic.part(&span[0], &span[1]);
            if span != arc.span && part.control_box().distance_sq(&self.centre) > self.reach_sq
                || self.family.clears(&part.points)
            {
                continue;
            }
            // A cell that takes more than this is too large, or touches C: its parent's bound stands.
            self.tries = self.tries.saturating_sub(1);
            if self.tries == 0 {
                self.give_up();
                return;
            }
            let [a, b] = &span;
            let m = S::midpoint(a, b);
            // Shorter than the cell, or than what its directions move the disk by, a piece has nothing to gain.
            let least = self.cell.half.clone().twice().max(self.cell.turning().clone() * &self.radius.clone().half());
            let least = least.max(self.radius.clone().mul_pow2(-12));
            let [start, _, _, end] = &part.points;
            let long = start.distance(end) > least && m > *a && m < *b && pending.remaining_capacity() >= 2;
            let piece = Stretch { segment: arc.segment, span: span.clone() };
            if touches || !long {
                let shown = if long { clears_nearby } else { clears };
                if shown(self.scene, self.feet, &piece, &self.radius) {
                    continue;
                }
            } else {
                // An end of the piece that no division takes out of the disks says how small they have to be.
                let most = self.family.most(start).min(self.family.most(end));
                if most < self.radius {
                    let fall = self.cell.first_fall(&self.radius);
                    let next = most * &(S::one() - &fall);
                    if next <= self.cell.lower || next < self.radius.clone().mul_pow2(-4) {
                        self.give_up();
                        return;
                    }
                    self.radius = next;
                    self.renew();
                    pending.push(span);
                    continue;
                }
            }
            if long {
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
                    self.give_up();
                    return;
                }
                self.renew();
                if self.family.clears(&part.points) || clears(self.scene, self.feet, &piece, &self.radius) {
                    break;
                }
            }
        }
    }
}
