//! lfs gathered at places while the medial walk goes on is what a search of all edges gives; and a curve that was sent cubic by
//! cubic is the one that the door made.

use std::cell::Cell;

use crate::common::{Strokes, closed, cubic, curve_model, difficult, ellipse, open, stick};
use feature_sampling::bezier::Cubic;
use feature_sampling::buffer::SliceStore;
use feature_sampling::curve::contact::Contact;
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::curve::given::{self, Extent};
use feature_sampling::curve::{ArcStart, Curve, CurveParam, EndId, JointKind, Segment, arc, contact};
use feature_sampling::geometry::hierarchy::{Item, Node};
use feature_sampling::geometry::{Point, project_to_segment};
use feature_sampling::lfs::FeatureSize;
use feature_sampling::lfs::gather::Gather;
use feature_sampling::lfs::table::{Column, LfsTable};
use feature_sampling::medial::uniform::Progress;
use feature_sampling::medial::{self, Foot, MedialPoint, Side};
use feature_sampling::model::CurveModel;
use feature_sampling::scalar::Scalar;

/// Difficult ones; and a loop of one cubic, strokes that end in each other's ends, a smooth path that is drawn twice, halves that
/// run against each other, and nothing but a line, which has no medial axis.
fn drawings() -> Vec<(&'static str, Strokes)> {
    let wave = cubic([[0.0, 0.0], [20.0, 40.0], [50.0, -30.0], [70.0, 10.0]]);
    let (a, b) = wave.split_at(&0.375);
    let drop = cubic([[0.0, 0.0], [30.0, 20.0], [-30.0, 20.0], [0.0, 0.0]]);
    let mut all = difficult();
    all.extend([
        ("drop", vec![closed(vec![drop]), stick([-20.0, -5.0], [20.0, -6.0])]),
        ("star", vec![stick([0.0, 0.0], [9.0, 1.0]), stick([0.0, 0.0], [-5.0, 6.0]), stick([2.0, -7.0], [0.0, 0.0])]),
        ("line", vec![stick([0.0, 0.0], [10.0, 3.0])]),
        ("smooth path twice", vec![open(vec![a, b]), open(vec![b.reversed(), a.reversed()])]),
        ("halves that meet with their ends", vec![open(vec![a]), open(vec![b.reversed()])]),
    ]);
    all
}

/// A curve that was received.
struct Received<S> {
    segments: Vec<Segment<S>>,
    arcs: Vec<ArcStart<S>>,
    nodes: Vec<Node<S>>,
    extent: Extent<S>,
}

impl<S: Scalar> Received<S> {
    /// The cubics of a curve, one after the other, with their corners and cuts.
    fn new(from: &Curve<'_, S>, leaf: u32) -> Self {
        let (mut segments, mut arcs) = (Vec::new(), Vec::new());
        for (index, s) in (0..).zip(from.segments) {
            let corners = [0, 1].map(|side| s.end(side).kind == JointKind::Corner);
            segments.push(given::segment(index, s.path, s.cubic.clone(), corners));
            given::join(&mut segments);
            given::arc(&mut segments, &mut arcs).unwrap();
            for arc in from.arcs_of(s).skip(1) {
                assert_eq!(given::cut(&mut segments, &mut arcs, arc.span[0].clone()), Ok(true));
                assert_eq!(given::cut(&mut segments, &mut arcs, arc.span[0].clone()), Ok(false), "not ascending");
            }
        }
        let extent = Extent::of(&segments);
        let (mut items, mut nodes) = (Vec::<Item<S>>::new(), Vec::new());
        given::finish(&mut segments, &mut arcs, leaf, &mut items, &mut nodes).unwrap();
        Self { segments, arcs, nodes, extent }
    }

    fn curve<'a>(&'a self, like: &Curve<'a, S>, leaf: u32) -> Curve<'a, S> {
        Curve {
            segments: &self.segments,
            sources: &[],
            paths: like.paths,
            arcs: &self.arcs,
            nodes: &self.nodes,
            leaf,
            diagonal: &self.extent.diagonal,
            noise: &self.extent.noise,
        }
    }
}

fn single(strokes: &Strokes) -> Vec<(bool, Vec<Cubic<f32>>)> {
    let point = |p: Point<f64>| Point::new(f32::from_f64(p.x), f32::from_f64(p.y));
    strokes
        .iter()
        .map(|s| (s.closed, s.cubics.iter().map(|c| Cubic { points: c.points.map(point) }).collect()))
        .collect()
}

/// The same joints, kinds, repetitions and arcs.
fn same<S: Scalar>(name: &str, door: &Curve<'_, S>, received: &Curve<'_, S>) {
    assert_eq!(door.segments.len(), received.segments.len(), "{name}");
    for (index, (a, b)) in (0..).zip(door.segments.iter().zip(received.segments)) {
        assert_eq!(a.twin, b.twin, "{name}, segment {index}");
        assert_eq!(a.arcs, b.arcs, "{name}, segment {index}");
        for side in 0..2 {
            let end = EndId::new(index, side);
            assert_eq!(a.end(side).kind, b.end(side).kind, "{name}, segment {index}, side {side}");
            let sorted = |curve: &Curve<'_, S>| {
                let mut all: Vec<EndId> = curve.joint(end).collect();
                all.sort_unstable();
                all
            };
            assert_eq!(sorted(door), sorted(received), "{name}, segment {index}, side {side}");
        }
    }
    for (a, b) in door.arcs.iter().zip(received.arcs) {
        assert!(a.segment == b.segment && a.t == b.t, "{name}");
        assert!((a.turn.clone() - &b.turn).abs() < S::ratio(1, 1000), "{name}: {:?} {:?}", a.turn, b.turn);
    }
    assert_eq!(door.arcs.len(), received.arcs.len(), "{name}");
    assert_eq!(door.nodes.len(), received.nodes.len(), "{name}");
}

#[test]
fn cubics_one_by_one_make_the_curve_of_the_door() {
    for leaf in [1, 3, 12] {
        let door = DoorOptions { leaf, ..DoorOptions::default() };
        // Circles that touch where both have joints: `an_end_on_a_joint_is_a_member_of_it`.
        for (name, strokes) in drawings().into_iter().filter(|(name, _)| *name != "touching circles") {
            let model = curve_model(&strokes, &door);
            let curve = model.curve();
            let received = Received::new(&curve, leaf);
            same(name, &curve, &received.curve(&curve, leaf));
            let paths = single(&strokes);
            let paths: Vec<(bool, &[Cubic<f32>])> = paths.iter().map(|(closed, c)| (*closed, c.as_slice())).collect();
            let door = DoorOptions { leaf, ..DoorOptions::default() };
            let model = CurveModel::<f32>::new(&paths, &door).unwrap();
            let curve = model.curve();
            let received = Received::new(&curve, leaf);
            same(name, &curve, &received.curve(&curve, leaf));
        }
    }
}

/// However many arcs share a leaf of the hierarchy, the disks are the same, to the last digits of their radii.
#[test]
fn leaves_of_several_arcs_have_the_same_disks() {
    for (name, strokes) in drawings() {
        let walks = [1, 5, 12].map(|leaf| {
            let model = curve_model(&strokes, &DoorOptions { leaf, ..DoorOptions::default() });
            let (curve, mut points, mut line) = (model.curve(), Vec::new(), 0);
            for (path, _) in (0..).zip(curve.paths) {
                line = medial::walk_uniform(&curve, path, 40, model.contacts(), line, &mut points).unwrap();
            }
            points
        });
        for other in &walks[1..] {
            assert_eq!(walks[0].len(), other.len(), "{name}");
            for (a, b) in walks[0].iter().zip(other) {
                assert!((a.radius - b.radius).abs() <= 1e-11 * a.radius, "{name}: {a:?} {b:?}");
            }
        }
    }
}

/// Turning goes on from arc to arc and through smooth joints, by what the arcs turn, whichever way a segment runs.
#[test]
fn turning_goes_on_along_strands() {
    let mut reversed = 0;
    for (name, strokes) in drawings() {
        let model = curve_model(&strokes, &DoorOptions::default());
        let curve = model.curve();
        let loops = curve.segments.iter().map(|s| s.loop_turn).fold(0.0, f64::max);
        for (index, s) in (0..).zip(curve.segments).filter(|(_, s)| s.twin.is_none()) {
            let arcs: Vec<_> = curve.arcs_of(s).collect();
            assert!(arcs.windows(2).all(|w| w[0].turn[1] == w[1].turn[0] && w[0].span[1] == w[1].span[0]), "{name}");
            assert!(arcs[0].span[0] == 0.0 && arcs[arcs.len() - 1].span[1] == 1.0, "{name}");
            for arc in &arcs {
                let turned = (arc.turn[1] - arc.turn[0]).abs();
                assert!((turned - arc.turning(s)).abs() < 1e-12, "{name}: {turned} for {}", arc.turning(s));
                reversed += u32::from(arc.turn[1] < arc.turn[0]);
            }
            for side in 0..2 {
                let end = EndId::new(index, side);
                let turn = |end: EndId| {
                    let arcs: Vec<_> = curve.arcs_of(curve.segment(end.segment()).unwrap()).collect();
                    if end.side() == 0 { arcs[0].turn[0] } else { arcs[arcs.len() - 1].turn[1] }
                };
                if s.end(side).kind == JointKind::Smooth {
                    let next = curve.joint(end).nth(1).unwrap();
                    let gap = (turn(end) - turn(next)).abs();
                    assert!(gap < 1e-12 || (gap - loops).abs() < 1e-12, "{name}: {gap}");
                }
            }
        }
    }
    assert!(reversed > 0, "a strand runs against a segment");
}

/// An end that stands on a joint of other strokes to the bit is a member of it; the door knows ends of open paths only.
#[test]
fn an_end_on_a_joint_is_a_member_of_it() {
    let strokes = vec![ellipse(0.0, 0.0, 8.0, 3.0), stick([8.0, 0.0], [15.0, 1.0])];
    let model = curve_model(&strokes, &DoorOptions::default());
    let received = Received::new(&model.curve(), 1);
    let curve = received.curve(&model.curve(), 1);
    let joint: Vec<EndId> = curve.joint(EndId::new(4, 0)).collect();
    assert_eq!(joint.len(), 3, "{joint:?}");
    assert!(joint.iter().all(|&end| curve.end(end).unwrap().kind == JointKind::Corner));
}

#[test]
fn cuts_have_to_fit() {
    let mut segments = Vec::new();
    let mut arcs: Vec<ArcStart<f64>> = Vec::new();
    assert_eq!(given::cut(&mut segments, &mut arcs, 0.5), Ok(false), "nothing is there");
    segments.push(given::segment(0, 0, cubic([[0.0, 0.0], [1.0, 0.0], [2.0, 1.0], [3.0, 3.0]]), [false; 2]));
    assert_eq!(given::cut(&mut segments, &mut arcs, 0.5), Ok(false), "no arc");
    given::arc(&mut segments, &mut arcs).unwrap();
    for (t, fits) in
        [(0.0, false), (0.25, true), (0.25, false), (0.1, false), (f64::NAN, false), (1.0, false), (0.75, true)]
    {
        assert_eq!(given::cut(&mut segments, &mut arcs, t), Ok(fits), "{t}");
    }
    assert_eq!(segments[0].arcs, (0, 3));
    let mut none: [ArcStart<f64>; 0] = [];
    assert!(given::arc(&mut segments, &mut SliceStore::new(&mut none)).is_err());
}

/// All values, by a walk with so many foot points.
fn gathered<S: Scalar>(
    curve: &Curve<'_, S>,
    columns: &[Column],
    contacts: &[Contact<S>],
    foot_points: u32,
    nodes: usize,
    budget: u32,
) -> (Vec<S>, u32) {
    let count = columns.last().map_or(0, |c| c.first + c.count) as usize;
    let values: Vec<Cell<Option<S>>> = (0..count).map(|_| Cell::new(None)).collect();
    let get = |k: u32| {
        let value = values[k as usize].take();
        values[k as usize].set(value.clone());
        value.unwrap()
    };
    let set = |k: u32, v: S| values[k as usize].set(Some(v));
    let mut most = vec![S::zero(); nodes];
    let mut gather = Gather::new(curve, columns, contacts, foot_points, &mut most, (get, set));
    let mut turns = 0;
    while gather.step(budget) != Progress::Done {
        turns += 1;
    }
    assert!(budget < u32::MAX || turns <= 1, "one call suffices");
    assert_eq!(gather.step(1), Progress::Done);
    let taken = gather.taken();
    drop(gather);
    (values.into_iter().map(|v| v.into_inner().unwrap()).collect(), taken)
}

/// The least distance to an edge, and to the centre of one of the first disks.
fn reference(curve: &Curve<'_, f64>, points: &[MedialPoint<f64>], q: &Point<f64>) -> [f64; 2] {
    let edges = points.iter().enumerate().map(|(i, a)| match points.get(i + 1) {
        Some(b) if b.polyline == a.polyline => project_to_segment(q, &a.centre, &b.centre).1.distance(q),
        _ => a.centre.distance(q),
    });
    let mut centres = f64::INFINITY;
    for (segment, _) in (0..).zip(curve.segments).filter(|(_, s)| s.twin.is_none()) {
        for (t, side) in [(0.25, Side::Left), (0.25, Side::Right), (0.75, Side::Left), (0.75, Side::Right)] {
            let foot = Foot::normal(curve, CurveParam { segment, t }, side).unwrap();
            let radius = medial::tangent_disk(curve, &foot).radius;
            if radius.is_finite() {
                centres = centres.min(foot.point.plus_scaled(&radius, &foot.direction).distance(q));
            }
        }
    }
    [edges.fold(f64::INFINITY, f64::min), centres]
}

#[test]
fn values_are_distances_to_the_nearest_edge() {
    for leaf in [1, 3, 12] {
        for (name, strokes) in drawings() {
            let model = curve_model(&strokes, &DoorOptions { leaf, ..DoorOptions::default() });
            let curve = model.curve();
            for (foot_points, count) in [(1, 2), (16, 5), (33, 40), (200, 17)] {
                let mut points = Vec::new();
                let mut line = 0;
                for (path, _) in (0..).zip(curve.paths) {
                    line =
                        medial::walk_uniform(&curve, path, foot_points, model.contacts(), line, &mut points).unwrap();
                }
                let columns: Vec<Column> =
                    (0..).zip(curve.segments).map(|(k, _)| Column { first: k * count, count }).collect();
                let (values, taken) =
                    gathered(&curve, &columns, model.contacts(), foot_points, curve.nodes.len(), u32::MAX);
                assert_eq!(taken as usize, points.len(), "{name}");
                let noise = 1e-12 * curve.diagonal;
                for (segment, s) in (0..).zip(curve.segments).filter(|(_, s)| s.twin.is_none()) {
                    for k in 0..count {
                        let q = s.point(&columns[0].parameter(k));
                        let [edges, centres] = reference(&curve, &points, &q);
                        let value = values[(segment * count + k) as usize];
                        assert!(
                            value <= edges + noise && value >= edges.min(centres) - noise,
                            "{name}: {value} for {edges} (centres {centres}), segment {segment}, place {k}"
                        );
                    }
                }
                // Whatever the budget; and without the numbers that spare work.
                for (nodes, budget) in [(curve.nodes.len(), 1), (curve.nodes.len(), 7), (0, 1000)] {
                    let again = gathered(&curve, &columns, model.contacts(), foot_points, nodes, budget).0;
                    assert!(
                        again.iter().zip(&values).all(|(a, b)| a == b || (a - b).abs() <= noise),
                        "{name}: {nodes} nodes, calls of {budget}"
                    );
                }
            }
        }
    }
}

/// A stroke that is drawn twice has one table, read from both ends.
#[test]
fn a_twin_reads_the_table_of_the_segment_that_it_repeats() {
    let wave = cubic([[0.0, 0.0], [20.0, 40.0], [50.0, -30.0], [70.0, 10.0]]);
    let strokes = vec![open(vec![wave]), open(vec![wave.reversed()]), stick([0.0, 30.0], [60.0, 35.0])];
    let model = curve_model(&strokes, &DoorOptions::default());
    let curve = model.curve();
    let columns = [Column { first: 0, count: 65 }, Column { first: 65, count: 2 }, Column { first: 67, count: 9 }];
    let (values, _) = gathered(&curve, &columns, model.contacts(), 64, curve.nodes.len(), 1);
    let table = LfsTable::new(&curve, &columns, |k| values[k as usize]);
    for k in 0..=100 {
        let t = f64::from(k) / 100.0;
        let p = wave.power_basis().eval(&t);
        let lfs = table.lfs(&CurveParam { segment: 0, t }, &p);
        let back = table.lfs(&CurveParam { segment: 1, t: 1.0 - t }, &p);
        assert!((lfs - back).abs() <= 1e-9 && lfs > 1.0, "{lfs} and {back} at {t}");
    }
}

/// The whole way of a chip in f32, against the same in f64.
#[test]
fn in_f32_values_differ_by_roundings() {
    for (name, strokes) in drawings() {
        let paths = single(&strokes);
        let paths: Vec<(bool, &[Cubic<f32>])> = paths.iter().map(|(closed, c)| (*closed, c.as_slice())).collect();
        let model = CurveModel::<f32>::new(&paths, &DoorOptions::default()).unwrap();
        let received = Received::new(&model.curve(), 12);
        let curve = received.curve(&model.curve(), 12);
        let mut contacts = Vec::new();
        (0..u32::try_from(curve.segments.len()).unwrap())
            .for_each(|segment| contact::find(&curve, segment, &mut contacts).unwrap());
        let columns: Vec<Column> =
            (0..).zip(curve.segments).map(|(k, _)| Column { first: k * 20, count: 20 }).collect();
        let (values, _) = gathered(&curve, &columns, &contacts, 32, curve.nodes.len(), 1);
        let exact = curve_model(&strokes, &DoorOptions::default());
        let (truth, _) = gathered(&exact.curve(), &columns, exact.contacts(), 32, exact.curve().nodes.len(), 1);
        for (k, (value, truth)) in values.iter().zip(&truth).enumerate() {
            let (value, allowed) = (f64::from(*value), 2e-4 * exact.curve().diagonal);
            assert!(value.is_infinite() == truth.is_infinite(), "{name}, place {k}: {value} for {truth}");
            assert!(truth.is_infinite() || (value - truth).abs() <= allowed, "{name}, place {k}: {value} for {truth}");
        }
    }
    // Cuts are those of the host.
    let mut cuts = Vec::new();
    let segment = given::segment(0, 0, cubic([[0.0, 0.0], [20.0, 40.0], [50.0, -30.0], [70.0, 10.0]]), [false; 2]);
    arc::cut(0, &segment, &mut cuts).unwrap();
    assert!(cuts.len() > 3 && cuts[0].t == 0.0 && cuts.windows(2).all(|w| w[0].t < w[1].t), "{cuts:?}");
}
