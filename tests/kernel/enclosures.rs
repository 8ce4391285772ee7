//! Enclosures of lfs and of the reach: they hold what is known exactly, and are as narrow as was asked.

use crate::common::Random;
use feature_sampling::bezier::Cubic;
use feature_sampling::curve::CurveParam;
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::geometry::Point;
use feature_sampling::lfs::enclose::Precision;
use feature_sampling::medial::Resolution;
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::prover::Prover;

const CELLS: usize = 1_000_000;

fn cubic(p: [(f64, f64); 4]) -> Cubic<f64> {
    let [a, b, c, d] = p.map(|(x, y)| Point::new(x, y));
    Cubic::new(a, b, c, d)
}

/// A straight segment whose control points are exact where coordinates are multiples of 3.
fn line(a: (f64, f64), b: (f64, f64)) -> Cubic<f64> {
    let at = |k: f64| ((a.0 * (3.0 - k) + b.0 * k) / 3.0, (a.1 * (3.0 - k) + b.1 * k) / 3.0);
    cubic([a, at(1.0), at(2.0), b])
}

/// A curve whose medial axis is known, and its lfs.
struct Shape {
    name: &'static str,
    paths: Vec<(bool, Vec<Cubic<f64>>)>,
    lfs: fn(&Point<f64>) -> f64,
    reach: f64,
}

fn shapes() -> Vec<Shape> {
    vec![
        // The line between two equal parallel segments, and its continuation.
        Shape {
            name: "parallel segments",
            paths: vec![(false, vec![line((0.0, 0.0), (30.0, 0.0))]), (false, vec![line((0.0, 6.0), (30.0, 6.0))])],
            lfs: |_| 3.0,
            reach: 3.0,
        },
        // Two segments in a row: only directions at the facing ends have medial points, those of the bisector.
        Shape {
            name: "facing ends",
            paths: vec![(false, vec![line((-30.0, 0.0), (-3.0, 0.0))]), (false, vec![line((3.0, 0.0), (30.0, 0.0))])],
            lfs: |p| p.x.abs(),
            reach: 3.0,
        },
        // y = x²/4 from −6 to 6: the axis, from the centre of curvature of the vertex upwards.
        Shape {
            name: "parabola",
            paths: vec![(false, vec![cubic([(-6.0, 9.0), (-2.0, -3.0), (2.0, -3.0), (6.0, 9.0)])])],
            lfs: |p| p.x.hypot((2.0 - p.y).max(0.0)),
            reach: 2.0,
        },
        // The same in two halves: all of its upper bounds come across the joint.
        Shape {
            name: "parabola in halves",
            paths: vec![(
                false,
                vec![
                    cubic([(-12.0, 36.0), (-8.0, 12.0), (-4.0, 0.0), (0.0, 0.0)]),
                    cubic([(0.0, 0.0), (4.0, 0.0), (8.0, 12.0), (12.0, 36.0)]),
                ],
            )],
            lfs: |p| p.x.hypot((2.0 - p.y).max(0.0)),
            reach: 2.0,
        },
        // The bisector of a corner, 90° and 2 atan(1/3).
        Shape {
            name: "right angle",
            paths: vec![(false, vec![line((30.0, 0.0), (0.0, 0.0)), line((0.0, 0.0), (0.0, 30.0))])],
            lfs: |p| p.x.max(p.y) * 0.5_f64.sqrt(),
            reach: 0.0,
        },
        Shape {
            name: "acute angle",
            paths: vec![(false, vec![line((27.0, 9.0), (0.0, 0.0)), line((0.0, 0.0), (27.0, -9.0))])],
            lfs: |p| p.y.abs(),
            reach: 0.0,
        },
        // Two diagonals.
        Shape {
            name: "crossing",
            paths: vec![(false, vec![line((-30.0, 0.0), (30.0, 0.0))]), (false, vec![line((0.0, -30.0), (0.0, 30.0))])],
            lfs: |p| p.x.abs().max(p.y.abs()) * 0.5_f64.sqrt(),
            reach: 0.0,
        },
        // The diagonals inside.
        Shape {
            name: "square",
            paths: vec![(
                true,
                vec![
                    line((-6.0, -6.0), (6.0, -6.0)),
                    line((6.0, -6.0), (6.0, 6.0)),
                    line((6.0, 6.0), (-6.0, 6.0)),
                    line((-6.0, 6.0), (-6.0, -6.0)),
                ],
            )],
            lfs: |p| (6.0 - p.x.abs().min(p.y.abs())) * 0.5_f64.sqrt(),
            reach: 0.0,
        },
    ]
}

fn model(paths: &[(bool, Vec<Cubic<f64>>)]) -> CurveModel<f64> {
    let input: Vec<(bool, &[Cubic<f64>])> = paths.iter().map(|(closed, c)| (*closed, c.as_slice())).collect();
    CurveModel::new(&input, &DoorOptions::default()).expect("a curve")
}

/// What precision was asked, with an end to it where lfs is 0.
fn precision(model: &CurveModel<f64>, share: f64) -> Precision<f64> {
    Precision { share, least: 1e-7 * model.diagonal(), steps: 1_000_000 }
}

/// Bounds at `count` points hold the exact lfs and are as narrow as `share`, but where lfs is as good as 0.
fn holds(shape: &Shape, share: f64, count: u32) {
    let model = model(&shape.paths);
    let curve = model.curve();
    let segments = u32::try_from(curve.segments.len()).expect("few");
    let precision = precision(&model, share);
    let mut prover = Prover::new(&model, CELLS);
    // Parameters without a rhythm, ends included.
    let mut t = 0.0;
    for i in 0..count {
        let at = CurveParam { segment: i % segments, t };
        let p = curve.point(&at).expect("a place");
        let truth = (shape.lfs)(&p);
        // An estimate that is far off, now and then: it decides nothing.
        let estimate = if i % 7 == 0 { 1e-3 * truth } else { truth };
        let bounds = prover.lfs(&p, &0.0, &estimate, &precision);
        // The closed form is rounded a few times itself, and so is p.
        let off = 1e-15 * model.diagonal();
        assert!(
            bounds.lower <= truth + off && truth - off <= bounds.upper,
            "{}: {at:?} {truth} {bounds:?}",
            shape.name
        );
        let narrow = bounds.upper - bounds.lower <= share * bounds.upper * (1.0 + 1e-12);
        assert!(narrow || bounds.upper <= precision.least, "{}: {at:?} {truth} {bounds:?}", shape.name);
        t = if t == 0.0 { 1.0 } else { (t * 0.5 + 0.618_033_988_749_894_9 * f64::from(i)).fract() };
    }
}

#[test]
fn bounds_hold_the_exact_lfs() {
    for shape in shapes() {
        holds(&shape, 0.01, 500);
    }
}

/// `cargo test --release --test kernel enclosures:: -- --ignored`.
#[test]
#[ignore = "long: 10,000 points on each shape"]
fn bounds_hold_the_exact_lfs_at_ten_thousand_points() {
    for shape in shapes() {
        holds(&shape, 0.01, 10_000);
    }
}

#[test]
fn bounds_shrink_to_the_asked_width() {
    for shape in shapes() {
        for (share, count) in [(0.3, 60), (0.1, 60), (1e-3, 20), (1e-4, 5)] {
            holds(&shape, share, count);
        }
    }
}

#[test]
fn the_reach_is_enclosed_where_it_is() {
    for Shape { name, paths, lfs, reach } in shapes() {
        let model = model(&paths);
        for (share, estimate) in [(0.1, reach), (1e-3, reach), (1e-3, 0.01), (1e-3, 1e6)] {
            let mut prover = Prover::new(&model, CELLS);
            let precision = precision(&model, share);
            let found = prover.reach(&estimate, &precision);
            assert!(found.lower <= reach && reach <= found.upper, "{name}: {found:?}");
            let narrow = found.upper - found.lower <= share * found.upper * (1.0 + 1e-12);
            assert!(narrow || found.upper <= precision.least, "{name}: {found:?}");
            // lfs is that small at the foot that it names.
            let cell = found.cell.and_then(|c| prover.cells().get(c as usize)).expect("a cell");
            let near = lfs(&cell.centre) - cell.half;
            assert!(near <= found.upper + 1e-12, "{name}: {near} at {:?}", cell.centre);
        }
    }
}

/// One straight stroke has no medial axis: no upper bound, and a lower one beyond the drawing.
#[test]
fn without_a_medial_axis_nothing_bounds_lfs_from_above() {
    let model = model(&[(false, vec![line((0.0, 0.0), (30.0, 9.0))])]);
    let mut prover = Prover::new(&model, CELLS);
    let precision = precision(&model, 0.01);
    let p = Point::new(10.0, 3.0);
    let bounds = prover.lfs(&p, &0.0, &f64::INFINITY, &precision);
    assert!(bounds.upper == f64::INFINITY && bounds.lower >= *model.diagonal(), "{bounds:?}");
    let reach = prover.reach(&f64::INFINITY, &precision);
    assert!(reach.upper == f64::INFINITY && reach.lower >= *model.diagonal() && reach.cell.is_none(), "{reach:?}");
}

/// A budget of nothing gives bounds that hold, and say little.
#[test]
fn without_steps_bounds_are_wide_and_hold() {
    for shape in shapes() {
        let model = model(&shape.paths);
        let mut prover = Prover::new(&model, CELLS);
        let precision = Precision { share: 0.01, least: 0.0, steps: 3 };
        let p = model.curve().point(&CurveParam { segment: 0, t: 0.3 }).expect("a place");
        let (truth, bounds) = ((shape.lfs)(&p), prover.lfs(&p, &0.0, &(shape.lfs)(&p), &precision));
        assert!(bounds.lower <= truth && truth <= bounds.upper, "{}: {truth} {bounds:?}", shape.name);
    }
}

/// On curves that nothing is known of, the plain estimate lies between the bounds, within its own error; a disk of points has the
/// bounds of all of them.
#[test]
fn estimates_lie_between_the_bounds() {
    let mut random = Random(3);
    for round in 0..10 {
        let mut point = || (10.0 * random.unit(), 10.0 * random.unit());
        let paths = vec![
            (false, vec![cubic([point(), point(), point(), point()])]),
            (false, vec![cubic([point(), point(), point(), point()])]),
        ];
        let model = model(&paths);
        let medial = MedialModel::new(&model, &Resolution::Tolerance(1e-4));
        let precision = precision(&model, 0.02);
        let mut prover = Prover::new(&model, CELLS);
        let curve = model.curve();
        for segment in 0..u32::try_from(curve.segments.len()).expect("few") {
            for i in 0..=8 {
                let t = f64::from(i) / 8.0;
                let p = curve.point(&CurveParam { segment, t }).expect("a place");
                let estimate = medial.lfs(&p);
                let bounds = prover.lfs(&p, &0.0, &estimate, &precision);
                let off = 1e-3 * estimate + precision.least;
                assert!(
                    bounds.lower <= estimate + off && estimate - off <= bounds.upper,
                    "{round} {estimate} {bounds:?}"
                );
                let h = 0.05 * estimate;
                let around = prover.lfs(&p, &h, &estimate, &Precision { share: 0.2, ..precision.clone() });
                for j in -8..=8 {
                    let at = CurveParam { segment, t: (t + f64::from(j) * 1e-3).clamp(0.0, 1.0) };
                    let q = curve.point(&at).expect("a place");
                    let lfs = medial.lfs(&q);
                    let held = around.lower <= lfs + off && lfs - off <= around.upper;
                    assert!(held || q.distance(&p) > h, "{round} {lfs} {around:?}");
                }
            }
        }
    }
}
