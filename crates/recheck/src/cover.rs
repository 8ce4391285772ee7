//! Covers: cells of the foot set, pieces of C.
//!
//! The foot set consists of both sides of every segment (one that repeats another is the same obstacle), and at every joint
//! that is not smooth of the directions that point away from all of its branches. Those directions form a cone, or there are none.
//! If u is the direction of a branch such that no other one lies certainly to its right, and w that of one such that no other lies
//! certainly to its left, then the cone may lie between the right normal of u and the left normal of w, and both fans are
//! required. Where roundings leave more than one candidate all pairs are; where they leave none, some branch lies to
//! the right of each, and the cone is empty. A joint of several branches may belong to M itself.

use feature_sampling::curve::{Curve, EndId, JointKind};
use feature_sampling::geometry::Point;

use crate::Tree;
use crate::check::Rejection;
use crate::feet::{Span, end_of, leaving, unit};
use crate::scene::Scene;

/// Sides and fans that a cover needs: by segment and side, and pairs of ends with the side of the first one.
pub(crate) struct Required {
    sides: Vec<(u32, bool)>,
    fans: Vec<(u32, u32, bool)>,
    /// Points that may belong to M themselves.
    pub(crate) points: Vec<Point<f64>>,
}

const fn number(end: EndId) -> u32 {
    end.segment() * 2 + if end.side() == 0 { 0 } else { 1 }
}

impl Required {
    pub(crate) fn new(scene: &Scene<'_>) -> Self {
        let curve = &scene.curve;
        let mut required = Self { sides: Vec::new(), fans: Vec::new(), points: Vec::new() };
        for (segment, index) in curve.segments.iter().zip(0..) {
            if segment.twin.is_some() {
                continue;
            }
            required.sides.extend([(index, false), (index, true)]);
            for side in 0..2 {
                let end = EndId::new(index, side);
                // Once a joint, at the first of its ends that is not one of a repetition.
                let is_obstacle = |e: &EndId| curve.segment(e.segment()).is_some_and(|s| s.twin.is_none());
                let is_first = || curve.joint(end).filter(is_obstacle).all(|e| e >= end);
                if segment.end(side).kind != JointKind::Smooth && is_first() {
                    required.joint(scene, curve.joint(end).collect());
                }
            }
        }
        required.fans.sort_unstable();
        required
    }

    fn joint(&mut self, scene: &Scene<'_>, ends: Vec<EndId>) {
        if let [end] = ends.as_slice() {
            let end = number(*end);
            self.fans.extend([(end, end, false), (end, end, true)]);
            return;
        }
        self.points.extend(ends.first().and_then(|e| scene.curve.end_point(*e)));
        let branches: Vec<_> =
            ends.iter().filter_map(|&e| scene.from(e).map(|o| (number(e), unit(leaving(o))))).collect();
        // No other branch is certainly to the right of `a`, or to its left.
        let extreme = |a: usize, right: bool| {
            branches.iter().enumerate().all(|(b, (_, v))| {
                let cross = branches[a].1.cross(v);
                b == a || if right { *cross.hi() >= 0.0 } else { *cross.lo() <= 0.0 }
            })
        };
        for a in (0..branches.len()).filter(|&a| extreme(a, true)) {
            for b in (0..branches.len()).filter(|&b| b != a && extreme(b, false)) {
                let (u, w) = (branches[a].0, branches[b].0);
                self.fans.extend([(u, w, false), (w, u, true)]);
            }
        }
    }

    /// The trees cover all of it.
    pub(crate) fn covered(&self, trees: &[Tree]) -> Result<(), Rejection> {
        let mut sides: Vec<(u32, bool, f64, f64)> = Vec::new();
        let mut fans: Vec<(u32, u32, bool)> = Vec::new();
        for tree in trees {
            match tree.feet {
                Span::Side { segment, left, from, to } => sides.push((segment, left, from, to)),
                Span::Fan { end, other, left, from: 0.0, to: 1.0 } => fans.push((end, other, left)),
                Span::Fan { .. } => {}
            }
        }
        sides.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)));
        fans.sort_unstable();
        for &(segment, left) in &self.sides {
            let start = sides.partition_point(|s| (s.0, s.1) < (segment, left));
            let own = sides[start..].iter().take_while(|s| (s.0, s.1) == (segment, left));
            let end = own.fold(0.0, |end: f64, s| if s.2 <= end { end.max(s.3) } else { end });
            if end < 1.0 {
                return Err(Rejection::new(format!("the foot set of segment {segment} is covered up to {end} only")));
            }
        }
        match self.fans.iter().find(|fan| fans.binary_search(fan).is_err()) {
            Some(fan) => Err(Rejection::new(format!("the fan between ends {} and {} is not covered", fan.0, fan.1))),
            None => Ok(()),
        }
    }
}

/// A parameter range of an existing segment, in order.
pub(crate) fn sound(curve: &Curve<'_, f64>, segment: u32, [from, to]: [f64; 2]) -> bool {
    curve.segment(segment).is_some() && 0.0 <= from && from <= to && to <= 1.0
}

/// The feet exist.
pub(crate) fn sound_feet(curve: &Curve<'_, f64>, span: &Span) -> bool {
    match *span {
        Span::Side { segment, from, to, .. } => sound(curve, segment, [from, to]),
        Span::Fan { end, other, from, to, .. } => {
            let there = |e: u32| curve.end(end_of(e)).is_some();
            there(end) && there(other) && 0.0 <= from && from <= to && to <= 1.0
        }
    }
}

#[cfg(test)]
mod tests {
    use feature_sampling::bezier::Cubic;
    use feature_sampling::curve::door::DoorOptions;
    use feature_sampling::model::CurveModel;

    use super::*;

    /// A stroke that goes on smoothly, and a path that repeats it and turns off instead: the joint there starts with an end of the
    /// repetition, which is no obstacle, and the stroke's own end belongs to another joint.
    #[test]
    fn a_joint_behind_a_repetition_is_required() {
        let cubic = |p: [(f64, f64); 4]| {
            let [a, b, c, d] = p.map(|(x, y)| Point::new(x, y));
            Cubic::new(a, b, c, d)
        };
        let stroke = cubic([(0.0, 0.0), (1.0, 1.0), (2.0, 1.0), (3.0, 0.0)]);
        let onward = cubic([(3.0, 0.0), (4.0, -1.0), (5.0, -1.0), (6.0, 0.0)]);
        let behind = cubic([(3.0, 0.0), (3.0, 1.0), (4.0, 2.0), (5.0, 2.0)]);
        let paths: [(bool, &[Cubic<f64>]); 2] = [(false, &[stroke, onward]), (false, &[stroke, behind])];
        let model = CurveModel::new(&paths, &DoorOptions::default()).expect("a curve");
        let curve = model.curve();
        assert!(curve.segments[2].twin.is_some(), "it is a repetition");
        assert_eq!(curve.segments[3].end(0).kind, JointKind::Corner);
        let required = Required::new(&Scene::new(curve));
        assert!(required.points.contains(&Point::new(3.0, 0.0)), "{:?}", required.points);
    }
}
