//! The foot set as a list of cells to start from.
//!
//! It consists of both sides of every arc, of the directions at open ends, and at every joint of several branches of the directions that
//! point away from all of them; and such a joint may belong to M itself (`docs/mathematics.md`, section 2). Cubics that repeat others are the
//! same obstacle and are left out, their joints are not.

use super::cell::{FootSpan, leaving, unit};
use super::clear::Scene;
use super::foot::Side;
use crate::curve::{EndId, JointKind};
use crate::scalar::Directed;

/// Calls `each` with every cell that a subdivision of the foot set starts from, in a fixed order: one for each side of each
/// arc, then those at joints.
pub fn roots<S: Directed, E>(
    scene: &Scene<'_, S>,
    mut each: impl FnMut(FootSpan<S>) -> Result<(), E>,
) -> Result<(), E> {
    for arc in (0..).map_while(|index| scene.curve.arc(index)) {
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

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;
    use crate::bezier::Cubic;
    use crate::curve::door::DoorOptions;
    use crate::curve::ideal;
    use crate::geometry::Point;
    use crate::model::CurveModel;
    use alloc::vec::Vec;

    /// A stroke that goes on smoothly, and a path that repeats it and turns off instead: the joint there starts with an end of the
    /// repetition, which is no obstacle, and the stroke's own end belongs to another joint.
    #[test]
    fn a_joint_behind_a_repetition_is_a_root() {
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
        let mut coefficients = Vec::new();
        ideal::coefficients(&curve, &mut coefficients).expect("a vector");
        let mut found: Vec<FootSpan<f64>> = Vec::new();
        let scene = Scene { curve: &curve, ideal: &coefficients };
        let all: Result<(), ()> = roots(&scene, |feet| {
            found.push(feet);
            Ok(())
        });
        assert_eq!(all, Ok(()));
        let joint = EndId::new(3, 0);
        let there = |end: EndId| curve.end_point(end) == curve.end_point(joint);
        let corners = found.iter().filter(|feet| matches!(feet, FootSpan::Corner { end } if there(*end))).count();
        assert_eq!(corners, 1, "once");
        assert!(singular(&scene, joint), "it belongs to M");
    }
}
