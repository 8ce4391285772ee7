//! The walk with equal steps, one foot at a time: the same medial points whatever the budget, and no call hands out more of
//! them than it may look at.

use crate::common::{cubic, difficult, ellipse, open, polygon};
use feature_sampling::buffer::{BufferFull, Sink, SliceStore};
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::medial::uniform::{Progress, UniformWalk};
use feature_sampling::medial::{self, MedialPoint, Resolution};

/// Counts what a call hands out.
struct Counted {
    points: Vec<MedialPoint<f64>>,
    call: u32,
}

impl Sink<MedialPoint<f64>> for Counted {
    fn take(&mut self, point: MedialPoint<f64>) -> Result<(), BufferFull> {
        self.points.push(point);
        self.call += 1;
        Ok(())
    }
}

#[test]
fn the_budget_changes_nothing() {
    for (name, strokes) in difficult() {
        let model = crate::common::curve_model(&strokes, &DoorOptions::default());
        let curve = model.curve();
        let relevance = medial::walk::relevance(&curve);
        for steps in [1, 16, 33, 300] {
            let mut whole = Vec::new();
            for (path, _) in (0..).zip(curve.paths) {
                whole.extend(model.walk(path, &Resolution::Steps(steps), &relevance));
            }
            assert!(!whole.is_empty(), "{name}");
            for budget in [0, 1, 2, 7, 1000] {
                let mut out = Counted { points: Vec::new(), call: 0 };
                for (path, _) in (0..).zip(curve.paths) {
                    let from = out.points.len();
                    let mut walk = UniformWalk::new(&curve, path, steps, model.contacts(), 0);
                    loop {
                        out.call = 0;
                        let progress = walk.step(budget, &mut out).unwrap();
                        assert!(out.call <= budget.max(1), "{name}: {} points in a call of {budget}", out.call);
                        if progress == Progress::Done {
                            break;
                        }
                    }
                    out.call = 0;
                    assert_eq!(walk.step(1, &mut out), Ok(Progress::Done));
                    assert_eq!(out.call, 0, "{name}: a walk that is done hands out nothing");
                    let last = out.points[from..].last().map_or(0, |p| p.polyline + 1);
                    assert_eq!(walk.polyline(), last, "{name}: the next polyline's number is free");
                }
                assert_eq!(out.points, whole, "{name}, {steps} steps");
            }
        }
    }
}

/// At a retracted end the curvature is unbounded on one side, and the medial axis runs into the curve there, also where the fan of
/// the end comes to that side's normal with a large disk. (A sketch of a cat: lfs at the end of a stroke came out as 9 instead of 0.)
#[test]
fn the_axis_runs_into_a_retracted_end_behind_a_fan() {
    let stroke = cubic([[145.5, 269.15], [156.83, 280.48], [190.8, 312.19], [190.8, 312.19]]);
    // All disks of the fan are small.
    let frame = polygon(true, &[[130.0, 250.0], [210.0, 250.0], [210.0, 330.0], [130.0, 330.0]]);
    for (stroke, t) in [(stroke, 1.0), (stroke.reversed(), 0.0)] {
        let model = crate::common::curve_model(&[open(vec![stroke]), frame.clone()], &DoorOptions::default());
        let curve = model.curve();
        let relevance = medial::walk::relevance(&curve);
        let on_curve = |m: &MedialPoint<f64>| m.at.segment == 0 && m.at.t == t && m.radius == 0.0;
        for steps in [1, 8, 32] {
            let points = model.walk(0, &Resolution::Steps(steps), &relevance);
            assert!(points.iter().any(on_curve), "{steps} steps");
            let lines = |m: &MedialPoint<f64>| points.iter().filter(|p| p.polyline == m.polyline).count();
            assert!(points.iter().filter(|m| on_curve(m)).all(|m| lines(m) > 1), "an edge leads to it");
        }
        let points = model.walk(0, &Resolution::Tolerance(0.05), &relevance);
        assert!(points.iter().any(on_curve), "refined");
    }
}

#[test]
fn no_path_and_no_room() {
    let model = crate::common::curve_model(&[ellipse(0.0, 0.0, 8.0, 3.0)], &DoorOptions::default());
    let curve = model.curve();
    let mut none = UniformWalk::new(&curve, 9, 16, model.contacts(), 5);
    assert_eq!(none.step(1, &mut Vec::new()), Ok(Progress::Done));
    assert_eq!(none.polyline(), 5);
    let mut room = [MedialPoint::default(); 10];
    let mut out = SliceStore::new(&mut room);
    let full = medial::walk_uniform(&curve, 0, 16, model.contacts(), 0, &mut out);
    assert_eq!(full, Err(BufferFull { capacity: 10 }));
}
