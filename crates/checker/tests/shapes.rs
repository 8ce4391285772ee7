//! Shapes whose lfs is known in closed form, and samples of them that hold or fail by design.

mod common;

use common::path_data;
use fsample_checker::{Checker, Options, RawPath, Sample};

/// A circle of four cubics about (x, y) with the usual handle length.
fn circle(x: f64, y: f64, r: f64) -> RawPath {
    ellipse(x, y, r, r)
}

fn ellipse(x: f64, y: f64, a: f64, b: f64) -> RawPath {
    const H: f64 = 0.552_284_749_830_793_4;
    let at = |u: f64, v: f64| [x + a * u, y + b * v];
    let cubics = vec![
        [at(1.0, 0.0), at(1.0, H), at(H, 1.0), at(0.0, 1.0)],
        [at(0.0, 1.0), at(-H, 1.0), at(-1.0, H), at(-1.0, 0.0)],
        [at(-1.0, 0.0), at(-1.0, -H), at(-H, -1.0), at(0.0, -1.0)],
        [at(0.0, -1.0), at(H, -1.0), at(1.0, -H), at(1.0, 0.0)],
    ];
    RawPath { closed: true, cubics }
}

/// |a/b − 1| ≤ 1e-9.
fn close(a: f64, b: f64) {
    assert!((a / b - 1.0).abs() < 1e-9, "{a} for {b}");
}

/// Radius of curvature of a cubic at its start.
fn end_radius(c: &[[f64; 2]; 4]) -> f64 {
    let d = |i: usize, j: usize| [c[j][0] - c[i][0], c[j][1] - c[i][1]];
    let (u, v) = (d(0, 1), d(1, 2));
    let speed = u[0].hypot(u[1]);
    // κ = 2/3 · |u × v| / |u|³
    1.5 * speed.powi(3) / (u[0] * v[1] - u[1] * v[0]).abs()
}

/// `n` samples at equal parameters on every cubic.
fn even(checker: &Checker, paths: &[RawPath], n: u32) -> Vec<Sample> {
    let mut out = Vec::new();
    for (path, p) in paths.iter().enumerate() {
        for segment in 0..p.cubics.len() {
            for i in 0..n {
                let t = f64::from(i) / f64::from(n);
                out.push(Sample { path, segment, t, point: checker.point(path, segment, t) });
            }
        }
        if !p.closed {
            let segment = p.cubics.len() - 1;
            out.push(Sample { path, segment, t: 1.0, point: checker.point(path, segment, 1.0) });
        }
    }
    out
}

#[test]
fn circle_of_four_cubics() {
    let paths = [circle(3.0, -2.0, 5.0)];
    let checker = Checker::new(&paths);
    // Curvature varies along each cubic: the tips of the medial axis reach out from the centre, so that the smallest
    // lfs is 0.9921 of the radius, at the joints (a curvature extremum of the cubics).
    let least = (0..=400).map(|i| checker.lfs(0, 0, f64::from(i) / 400.0)).fold(f64::INFINITY, f64::min);
    assert!((least / 5.0 - 0.9921).abs() < 1e-4, "{least}");
}

#[test]
fn ellipse_at_its_major_vertex() {
    let paths = [ellipse(0.0, 0.0, 2.0, 1.0)];
    let radius = end_radius(&paths[0].cubics[0]);
    assert!((radius - 0.5).abs() < 0.02);
    // The cubics are not quite ellipses: their curvature peaks a little beside the vertex, so two branch tips stand by
    // its centre of curvature, nearer than b²/a by a quarter of a per cent.
    let lfs = Checker::new(&paths).lfs(0, 0, 0.0);
    assert!(lfs < radius && lfs > 0.997 * radius, "{lfs} for {radius}");
    // A flatter handle puts the peak at the vertex itself: b²/a of the curve drawn, exactly.
    let eye = path_data("M -2 0 C -2 0.5 -1 1 0 1 C 1 1 2 0.5 2 0 C 2 -0.5 1 -1 0 -1 C -1 -1 -2 -0.5 -2 0 Z");
    close(Checker::new(&eye).lfs(0, 0, 0.0), end_radius(&eye[0].cubics[0]));
}

#[test]
fn parabola_at_its_vertex() {
    // y = x² for |x| ≤ 2 as one quadratic: focal length 1/4, lfs 1/2 at the vertex.
    let paths = path_data("M -2 4 Q 0 -4 2 4");
    let checker = Checker::new(&paths);
    close(checker.lfs(0, 0, 0.5), 0.5);
    // Away from the vertex the nearest medial point is the tip (0, 1/2) or the axis above it.
    let p = checker.point(0, 0, 0.55);
    let up = p.y.max(0.5);
    close(checker.lfs(0, 0, 0.55), p.x.hypot(p.y - up));
}

#[test]
fn stadium() {
    const H: f64 = 0.552_284_749_830_793_4;
    let d = format!(
        "M -3 -1 L 3 -1 C {} -1 4 {} 4 0 C 4 {} {} 1 3 1 L -3 1 C {} 1 -4 {} -4 0 C -4 {} {} -1 -3 -1 Z",
        3.0 + H,
        -H,
        H,
        3.0 + H,
        -3.0 - H,
        H,
        -H,
        -3.0 - H
    );
    let paths = path_data(&d);
    let checker = Checker::new(&paths);
    close(checker.lfs(0, 0, 0.5), 1.0);
    close(checker.lfs(0, 0, 0.3), 1.0);
    // The caps are circles in the approximation of cubics.
    let cap = checker.lfs(0, 1, 1.0);
    assert!((cap - 1.0).abs() < 0.01, "{cap}");
}

#[test]
fn concentric_circles() {
    // The gap is 1; the inner disk's centre is farther.
    let checker = Checker::new(&[circle(0.0, 0.0, 2.0), circle(0.0, 0.0, 3.0)]);
    for (path, t) in [(0, 0.0), (1, 0.0), (0, 0.5), (1, 0.5)] {
        let lfs = checker.lfs(path, 0, t);
        assert!((lfs - 0.5).abs() < 1e-3, "{lfs}");
    }
    // By symmetry both circles have their feet on the axes opposite each other.
    close(checker.lfs(0, 0, 0.0), 0.5);
}

#[test]
fn parallel_lines() {
    let checker = Checker::new(&path_data("M 0 0 L 10 0 M 0 2 L 10 2"));
    close(checker.lfs(0, 0, 0.5), 1.0);
    close(checker.lfs(1, 0, 0.2), 1.0);
}

#[test]
fn right_angle() {
    let paths = path_data("M 4 0 L 0 0 L 0 4");
    let checker = Checker::new(&paths);
    // The bisector of the inside is the whole axis near the corner: x/√2.
    for x in [0.001, 0.1, 1.0] {
        close(checker.lfs(0, 1, x / 4.0), x / 2.0_f64.sqrt());
    }
    assert_eq!(checker.lfs(0, 0, 1.0), 0.0);
    // On the outside disks are half-planes.
    assert_eq!(checker.radius(0, 1, 0.25, false).min(checker.radius(0, 1, 0.25, true)), 1.0);
    assert_eq!(checker.radius(0, 1, 0.25, false).max(checker.radius(0, 1, 0.25, true)), f64::INFINITY);
}

#[test]
fn ends_facing_each_other() {
    let checker = Checker::new(&path_data("M 0 0 L 4 0 M 5 0 L 9 0"));
    close(checker.lfs(0, 0, 1.0), 0.5);
    close(checker.lfs(1, 0, 0.0), 0.5);
    close(checker.lfs(0, 0, 0.5), 2.5);
}

#[test]
fn lone_segment() {
    let paths = path_data("M 1 2 L 7 5");
    let checker = Checker::new(&paths);
    assert_eq!(checker.lfs(0, 0, 0.3), f64::INFINITY);
    let report = checker.check(&even(&checker, &paths, 1), 0.3, Options::default());
    assert!(report.violations.is_empty());
    assert_eq!(report.effective_epsilon, 0.0);
}

#[test]
fn segments_of_nothing_and_small_kinks_do_no_harm() {
    let checker = Checker::new(&path_data("M 0 0 L 5 0 L 5 1e-16 L 10 0.01 M 0 2 L 5 2 L 10 2.01"));
    assert!(checker.contacts().is_empty());
    assert!(checker.displacement() > 0.0);
    assert!((checker.lfs(0, 0, 0.5) - 1.0).abs() < 1e-3);
}

#[test]
fn identical_strokes_are_one_obstacle() {
    let checker = Checker::new(&path_data("M 0 0 C 1 2 3 2 4 0 M 4 0 C 3 2 1 2 0 0"));
    let alone = Checker::new(&path_data("M 0 0 C 1 2 3 2 4 0"));
    close(checker.lfs(0, 0, 0.5), alone.lfs(0, 0, 0.5));
}

#[test]
fn contacts_are_found() {
    // A crossing, a T-junction, a loop of one cubic, a cusp and a retracted handle.
    assert_eq!(Checker::new(&path_data("M 0 0 L 4 4 M 0 4 L 4 0")).contacts().len(), 1);
    assert_eq!(Checker::new(&path_data("M 0 0 L 4 0 M 2 0 L 2 3")).contacts().len(), 1);
    assert_eq!(Checker::new(&path_data("M 0 0 C 6 4 -2 4 4 0")).contacts().len(), 1);
    assert!(!Checker::new(&path_data("M 0 0 C 4 4 0 4 4 0")).contacts().is_empty());
    assert_eq!(Checker::new(&path_data("M 0 0 C 0 0 1 2 4 2")).contacts().len(), 1);
    assert!(Checker::new(&path_data("M 0 0 L 4 0 M 0 1 L 4 1")).contacts().is_empty());
}

#[test]
fn judgement_of_a_circle() {
    let paths = [circle(0.0, 0.0, 1.0)];
    let checker = Checker::new(&paths);
    let samples = even(&checker, &paths, 4);
    let report = checker.check(&samples, 0.5, Options::default());
    // Sixteen samples: the middle of a gap of 22.5° is 2 sin(5.625°) = 0.196 from its samples; parameters are not angles.
    assert!((report.effective_epsilon - 0.196).abs() < 0.01, "{}", report.effective_epsilon);
    assert!(report.violations.is_empty() && report.missing_edges.is_empty());
    assert!((report.max_chord_error - 0.0193).abs() < 1e-3);
    assert!(report.off_curve < 1e-9);
    // Exactly the effective ε fails (the condition is strict), a little more passes.
    let at = |epsilon: f64| checker.check(&samples, epsilon, Options::default()).violations.len();
    assert!(at(report.effective_epsilon * (1.0 - 1e-6)) > 0);
    assert_eq!(at(report.effective_epsilon * (1.0 + 1e-6)), 0);
    // A missing sample is noticed.
    let report = checker.check(&samples[1..], 0.3, Options::default());
    assert_eq!(report.violations.len(), 1);
}

#[test]
fn floors_at_a_corner() {
    let paths = path_data("M 4 0 L 0 0 L 0 4");
    let checker = Checker::new(&paths);
    // Samples that fall off geometrically towards the corner until the default floor.
    let mut list = vec![(0, 0.0)];
    let mut x = 4.0;
    while x > 1.5e-3 * checker.diagonal() {
        x /= 1.2;
        list.push((0, 1.0 - x / 4.0));
    }
    let mirrored: Vec<_> = list.iter().rev().map(|&(_, t)| (1, 1.0 - t)).collect();
    list.push((0, 1.0));
    list.extend(mirrored);
    let sample = |&(segment, t): &(usize, f64)| Sample { path: 0, segment, t, point: checker.point(0, segment, t) };
    let samples: Vec<Sample> = list.iter().map(sample).collect();
    let report = checker.check(&samples, 0.3, Options::default());
    assert!(report.violations.is_empty(), "{:?}", report.violations);
    assert!(report.share_under_floor > 0.0 && report.share_under_floor < 0.01);
    // Without the corner itself the floor is not met; with a floor of the user's own it may be.
    let without: Vec<Sample> = samples.iter().copied().filter(|s| s.t < 1.0 || s.segment > 0).collect();
    let thinner: Vec<Sample> = without.iter().copied().filter(|s| s.point.norm() > 0.02).collect();
    assert!(checker.check(&thinner, 0.3, Options::default()).violations.iter().any(|v| v.floored));
    let own = Options { min_distance: Some(0.2), ..Options::default() };
    assert!(checker.check(&thinner, 0.3, own).violations.is_empty());
}

#[test]
fn delaunay_edges() {
    // Three close parallel lines sampled too thinly: neighbours on the middle one are not Delaunay neighbours.
    let paths = path_data("M 0 0 L 8 0 M 1 0.1 L 9 0.1 M 1 -0.1 L 9 -0.1");
    let checker = Checker::new(&paths);
    let report = checker.check(&even(&checker, &paths, 4), 0.5, Options::default());
    assert!(!report.missing_edges.is_empty());
    // Cocircular ties count as present: a square.
    let square = path_data("M 0 0 L 1 0 L 1 1 L 0 1 Z");
    let checker = Checker::new(&square);
    let mut samples = even(&checker, &square, 1);
    samples.push(Sample { path: 0, segment: 3, t: 0.0, point: checker.point(0, 3, 0.0) });
    assert!(checker.check(&samples, 0.5, Options::default()).missing_edges.is_empty());
}
