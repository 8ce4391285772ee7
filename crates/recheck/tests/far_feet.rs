//! The rule that only feet within 2L matter, at its edge: a medial point that is nearer than L while all of its feet are farther.

use feature_sampling::bezier::Cubic;
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::geometry::Point;
use feature_sampling::model::CurveModel;
use fsample_recheck::{
    Certificate, Claimed, Node, PieceClaim, Place, SampleClaim, Span, Tree, Upper, Why, check, hash,
};

/// Halvings of the foot set.
const DEPTH: u32 = 11;

/// Pieces of the curve.
const PIECES: u32 = 512;

/// y = x²/4 from −6 to 6. Its medial axis is x = 0, y ≥ 2; lfs at (x, y) is the distance from (0, max(y, 2)).
fn parabola() -> CurveModel<f64> {
    let [a, b, c, d] = [(-6.0, 9.0), (-2.0, -3.0), (2.0, -3.0), (6.0, 9.0)].map(|(x, y)| Point::new(x, y));
    let cubic = [Cubic::new(a, b, c, d)];
    CurveModel::new(&[(false, cubic.as_slice())], &DoorOptions::default()).expect("a curve")
}

fn x(t: f64) -> f64 {
    12.0 * t - 6.0
}

fn lfs(t: f64) -> f64 {
    let x = x(t);
    x.hypot((2.0 - 0.25 * x * x).max(0.0))
}

/// Cells in preorder down to the depth; inside, each has nearly its radius, from the foot that is nearest to the vertex, and the foot on
/// the other side bounds it from above.
fn cells(inside: bool, from: f64, to: f64, depth: u32, nodes: &mut Vec<Node>) {
    let near = if from < 0.5 && 0.5 < to { 0.0 } else { x(from).abs().min(x(to).abs()) };
    let lower = if inside { (near * near + 4.0).sqrt() * (1.0 - 1e-6) } else { 100.0 };
    let m = 0.5 * (from + to);
    let upper =
        inside.then(|| if m == 0.5 { Upper::Curvature } else { Upper::Point(Place { segment: 0, t: 1.0 - m }) });
    let leaf = depth == 0;
    nodes.push(Node { split: !leaf, lower: if leaf { lower } else { 0.0 }, upper: upper.filter(|_| leaf) });
    if !leaf {
        cells(inside, from, m, depth - 1, nodes);
        cells(inside, m, to, depth - 1, nodes);
    }
}

/// Every piece has a sample on it and claims a share of its lfs; one piece claims another share.
fn certified(model: &CurveModel<f64>, share: f64, odd: Option<(u32, f64)>) -> Certificate {
    let at = |i: f64| i / f64::from(PIECES);
    let curve = model.curve();
    let mut trees = Vec::new();
    for left in [true, false] {
        let mut nodes = Vec::new();
        // From left to right the inside is on the left.
        cells(left, 0.0, 1.0, DEPTH, &mut nodes);
        trees.push(Tree { feet: Span::Side { segment: 0, left, from: 0.0, to: 1.0 }, nodes });
    }
    for end in [0, 1] {
        for left in [true, false] {
            // The axis is at a distance of 6.
            let nodes = vec![Node { split: false, lower: 5.9, upper: None }];
            trees.push(Tree { feet: Span::Fan { end, other: end, left, from: 0.0, to: 1.0 }, nodes });
        }
    }
    let point = |t: f64| curve.segments[0].point(&t);
    Certificate {
        curve: hash(&curve),
        corner_angle: 1.0,
        epsilon: 0.1,
        min_distance: None,
        claimed: Claimed::Proved,
        samples: (0..PIECES)
            .map(|i| {
                let t = at(f64::from(i) + 0.5);
                SampleClaim { at: Place { segment: 0, t }, x: point(t).x, y: point(t).y }
            })
            .collect(),
        pieces: (0..PIECES)
            .map(|i| {
                let (from, to) = (at(f64::from(i)), at(f64::from(i) + 1.0));
                let share = odd.filter(|odd| odd.0 == i).map_or(share, |odd| odd.1);
                let why = Why::Feature(share * lfs(from).min(lfs(to)).min(5.8));
                PieceClaim { segment: 0, from, to, sample: i, why }
            })
            .collect(),
        neighbourhoods: Vec::new(),
        trees,
    }
}

/// Between y = 1 and y = 2 the nearest medial point is (0, 2), and its only foot, the vertex, is farther away than it.
#[test]
fn feet_farther_than_their_medial_point_are_looked_at() {
    let model = parabola();
    let share = 0.998;
    assert!(
        check(model.curve(), &certified(&model, share, None)).is_ok(),
        "{:?}",
        check(model.curve(), &certified(&model, share, None))
    );
    let mut asked = 0;
    for i in 0..PIECES {
        let (from, to) = (f64::from(i) / f64::from(PIECES), f64::from(i + 1) / f64::from(PIECES));
        let inside = |t: f64| (1.2..1.9).contains(&(0.25 * x(t) * x(t)));
        if inside(from) && inside(to) {
            asked += 1;
            // More than the larger of both ends' lfs, less than the distance of the vertex.
            let odd = 1.001 * lfs(from).max(lfs(to)) / lfs(from).min(lfs(to));
            let c = certified(&model, share, Some((i, odd)));
            assert!(check(model.curve(), &c).is_err(), "piece {i} has no such lfs");
        }
    }
    assert!(asked > 20, "{asked}");
}
