//! Local feature size against the analytic value *of the curve that is drawn*.
//!
//! Each shape comes with places on it at which lfs is known in closed form; where a curvature decides, it is that of the
//! Béziers (a circle of four cubics has minimal lfs 0.9921 R). f64 at tolerance 1e-7 must be right to 1e-6, f32 at 1e-4 to
//! 1e-3. The same must hold after moving, turning, reversing and splitting; scaling by powers of two changes no bit.

use crate::common::{
    Model, Random, Stroke, Strokes, closed, cubic, ellipse, line, mapped, open, placed, polygon, pt, quarters,
    reversed, rounded, sharpest, stadium, stick,
};
use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::Point;
use feature_sampling::medial::Side;
use feature_sampling::scalar::Scalar;

/// A place on a shape and lfs there.
#[derive(Clone, Copy, Debug)]
struct Known {
    path: usize,
    cubic: usize,
    t: f64,
    lfs: f64,
}

/// A drawing with known values.
struct Shape {
    name: &'static str,
    strokes: Strokes,
    known: Vec<Known>,
    /// Smallest lfs of a shape without corners or touchings.
    reach: Option<f64>,
}

const TOLERANCE: f64 = 1e-7;
const RIGHT: f64 = 1e-6;

impl Shape {
    fn new(name: &'static str, strokes: Strokes) -> Self {
        Self { name, strokes, known: Vec::new(), reach: None }
    }

    fn point(&self, path: usize, cubic: usize, t: f64) -> Point<f64> {
        self.strokes[path].cubics[cubic].eval(&t)
    }

    /// lfs everywhere, from the point.
    fn everywhere(mut self, lfs: impl Fn(Point<f64>) -> f64) -> Self {
        for path in 0..self.strokes.len() {
            for cubic in 0..self.strokes[path].cubics.len() {
                for i in 0..=64 {
                    let t = f64::from(i) / 64.0;
                    let lfs = lfs(self.point(path, cubic, t));
                    self.known.push(Known { path, cubic, t, lfs });
                }
            }
        }
        self
    }

    fn at(mut self, path: usize, cubic: usize, t: f64, lfs: f64) -> Self {
        self.known.push(Known { path, cubic, t, lfs });
        self
    }

    fn reach(mut self, reach: f64) -> Self {
        self.reach = Some(reach);
        self
    }
}

/// Where curvature decides the reach of a closed curve: lfs is the radius of curvature at its largest curvature.
fn by_curvature(mut shape: Shape, cubics: &[usize]) -> Shape {
    let mut reach = f64::INFINITY;
    for &i in cubics {
        let (curvature, t) = sharpest(&shape.strokes[0].cubics[i]);
        shape = shape.at(0, i, t, 1.0 / curvature);
        reach = reach.min(1.0 / curvature);
    }
    shape.reach(reach)
}

fn ray(angle: f64, length: f64) -> [f64; 2] {
    [angle.cos() * length, angle.sin() * length]
}

fn shapes() -> Vec<Shape> {
    let root2 = std::f64::consts::SQRT_2;
    let mut all = Vec::new();

    // The medial axis of a circle of four cubics ends in eight centres of curvature.
    all.push(by_curvature(Shape::new("circle", vec![ellipse(0.0, 0.0, 1.0, 1.0)]), &[0, 1, 2, 3]));
    all.push(by_curvature(Shape::new("ellipse 2:1", vec![ellipse(3.0, 1.0, 2.0, 1.0)]), &[0, 1, 2, 3]));
    all.push(by_curvature(Shape::new("ellipse 5:1", vec![ellipse(0.0, 0.0, 5.0, 1.0)]), &[0, 1, 2, 3]));

    // y = x²/4f: the medial axis is x = 0 from (0, 2f) upwards, ends included (they are mirrored at it).
    let f = 0.75;
    let parabola = Cubic::quadratic(pt(-4.0 * f, 4.0 * f), &pt(0.0, -4.0 * f), pt(4.0 * f, 4.0 * f));
    let axis = move |p: Point<f64>| if p.y < 2.0 * f { p.x.hypot(p.y - 2.0 * f) } else { p.x.abs() };
    all.push(Shape::new("parabola", vec![open(vec![parabola])]).everywhere(axis).reach(2.0 * f));

    // Along the sides half the width, at the caps the Béziers' largest curvature.
    let mut s = by_curvature(Shape::new("stadium", vec![stadium(3.0, 1.0)]), &[1, 2, 4, 5]);
    for i in 0..=32 {
        let t = 0.25 + f64::from(i) / 64.0;
        s = s.at(0, 0, t, 1.0).at(0, 3, t, 1.0);
    }
    all.push(s);

    // Both circles bulge by the same share between the eight places where they are exact: there the gap is smallest.
    let mut s = Shape::new("concentric circles", vec![ellipse(0.0, 0.0, 1.0, 1.0), ellipse(0.0, 0.0, 1.6, 1.6)]);
    for (path, cubic) in [(0, 0), (0, 1), (0, 2), (0, 3), (1, 0), (1, 1), (1, 2), (1, 3)] {
        s = s.at(path, cubic, 0.0, 0.3).at(path, cubic, 0.5, 0.3).at(path, cubic, 1.0, 0.3);
    }
    all.push(s.reach(0.3));

    let parallel = vec![stick([-2.0, 0.0], [2.0, 0.0]), stick([-2.0, 0.5], [2.0, 0.5])];
    all.push(Shape::new("parallel lines", parallel).everywhere(|_| 0.25).reach(0.25));

    let corner = polygon(false, &[[1.0, 0.0], [0.0, 0.0], [0.0, 1.0]]);
    all.push(Shape::new("corner of 90°", vec![corner]).everywhere(move |p| (p.x + p.y) / root2));

    // A corner of 40°: the bisector is 20° off each arm.
    let (a, b) = (ray(0.1, 1.0), ray(0.1 + 40_f64.to_radians(), 1.0));
    let sharp = polygon(false, &[a, [0.0, 0.0], b]);
    let sine = 20_f64.to_radians().sin();
    all.push(Shape::new("corner of 40°", vec![sharp]).everywhere(move |p| p.x.hypot(p.y) * sine));

    let facing = vec![stick([-1.0, 0.0], [-0.1, 0.0]), stick([0.1, 0.0], [1.0, 0.0])];
    all.push(Shape::new("facing ends", facing).everywhere(|p| p.x.abs()).reach(0.1));

    // Two convex strokes, mirrored: their bisector is the mirror.
    let tilted = vec![stick([-1.1, 0.6], [-0.1, 0.0]), stick([0.1, 0.0], [1.1, 0.6])];
    all.push(Shape::new("facing ends at an angle", tilted).everywhere(|p| p.x.abs()).reach(0.1));

    let tee = vec![stick([-1.0, 0.0], [1.0, 0.0]), stick([0.0, 0.0], [0.0, 1.0])];
    all.push(Shape::new("T-junction", tee).everywhere(move |p| (p.x.abs() + p.y) / root2));

    let cross = vec![stick([-1.0, 0.0], [1.0, 0.0]), stick([0.0, -1.0], [0.0, 1.0])];
    all.push(Shape::new("X of 90°", cross).everywhere(move |p| (p.x.abs() + p.y.abs()) / root2));

    let (a, b) = (ray(0.3, 1.0), ray(0.3 + 60_f64.to_radians(), 1.0));
    let cross = vec![stick([-a[0], -a[1]], a), stick([-b[0], -b[1]], b)];
    all.push(Shape::new("X of 60°", cross).everywhere(|p| 0.5 * p.x.hypot(p.y)));
    all
}

/// Relative error, or absolute where the value is (nearly) 0.
fn error(found: f64, truth: f64, unit: f64) -> f64 {
    if truth < 1e-9 * unit { (found - truth).abs() / unit } else { (found / truth - 1.0).abs() }
}

/// The largest error of lfs over the known places of a shape that was moved by a similarity with this scale.
fn worst<S: Scalar>(shape: &Shape, strokes: &[Stroke<S>], tolerance: f64, scale: f64) -> (f64, Known) {
    let model = Model::new(strokes, tolerance);
    let unit = model.curve.diagonal().to_f64();
    shape
        .known
        .iter()
        .map(|k| (error(model.lfs(k.path, k.cubic, k.t).to_f64(), scale * k.lfs, unit), *k))
        .fold((0.0, shape.known[0]), |a, b| if b.0 > a.0 || b.0.is_nan() { b } else { a })
}

#[test]
fn a_circle_of_cubics_is_no_circle() {
    let (curvature, t) = sharpest(&quarters(0.0, 0.0, 1.0, 1.0)[0]);
    assert!((1.0 / curvature - 0.9921).abs() < 5e-5, "{} at {t}", 1.0 / curvature);
    // The ellipse's sharpest place is its major vertex: (3/2)·(1 − k)·… of b²/a.
    let (curvature, t) = sharpest(&quarters(0.0, 0.0, 5.0, 1.0)[0]);
    assert!((1.0 / curvature - 0.2).abs() < 0.005, "{} at {t}", 1.0 / curvature);
}

#[test]
fn analytic_shapes() {
    let mut failed = Vec::new();
    for shape in shapes() {
        let (worst, at) = worst(&shape, &shape.strokes, TOLERANCE, 1.0);
        println!("{}: {worst:.1e}", shape.name);
        if worst.is_nan() || worst > RIGHT {
            failed.push(format!("{}: lfs off by {worst:e} at {at:?}", shape.name));
        }
        // Nowhere is lfs below the reach, and no disk is smaller.
        let Some(reach) = shape.reach else { continue };
        let model = Model::new(&shape.strokes, TOLERANCE);
        for (path, stroke) in shape.strokes.iter().enumerate() {
            for cubic in 0..stroke.cubics.len() {
                for i in 0..=200 {
                    let lfs = model.lfs(path, cubic, f64::from(i) / 200.0);
                    if lfs < reach * (1.0 - RIGHT) {
                        failed.push(format!("{}: lfs {lfs} below the reach {reach}", shape.name));
                    }
                }
            }
        }
        if let Some(m) = model.medial.points().iter().find(|m| m.radius < reach * (1.0 - RIGHT)) {
            failed.push(format!("{}: a disk below the reach {reach}: {m:?}", shape.name));
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn f32_collapses_no_disk() {
    let mut failed = Vec::new();
    for shape in shapes() {
        let strokes = rounded::<f32>(&shape.strokes);
        let (worst, at) = worst(&shape, &strokes, 1e-4, 1.0);
        println!("{}: {worst:.1e}", shape.name);
        if worst.is_nan() || worst > 1e-3 {
            failed.push(format!("{}: lfs off by {worst:e} at {at:?}", shape.name));
        }
        let Some(reach) = shape.reach else { continue };
        let model = Model::new(&strokes, 1e-4);
        for m in model.medial.points() {
            if f64::from(m.radius) < reach * (1.0 - 1e-3) {
                failed.push(format!("{}: a disk below the reach {reach}: {m:?}", shape.name));
                break;
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn moved_and_turned_shapes() {
    let mut random = Random(7);
    let mut failed = Vec::new();
    for shape in shapes() {
        for offset in [0.0, 1e3, 1e6] {
            let angle = random.between(0.0, std::f64::consts::TAU);
            let by = [offset * random.between(0.5, 1.0), -offset];
            let strokes = placed(&shape.strokes, angle, 1.0, by);
            // The shape that is left after rounding to the coordinates' last digit is another one by that much.
            let rounding = 16.0 * offset * f64::EPSILON / 0.1;
            let (worst, at) = worst(&shape, &strokes, TOLERANCE, 1.0);
            println!("{} at {offset:.0e}: {worst:.1e}", shape.name);
            if worst.is_nan() || worst > RIGHT + rounding {
                failed.push(format!("{} turned by {angle}, moved by {by:?}: {worst:e} at {at:?}", shape.name));
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn reversed_shapes() {
    for shape in shapes() {
        let back = Shape {
            name: shape.name,
            strokes: reversed(&shape.strokes),
            known: shape
                .known
                .iter()
                .map(|k| {
                    let last = shape.strokes[k.path].cubics.len() - 1;
                    Known { cubic: last - k.cubic, t: 1.0 - k.t, ..*k }
                })
                .collect(),
            reach: shape.reach,
        };
        let (worst, at) = worst(&back, &back.strokes, TOLERANCE, 1.0);
        assert!(worst <= RIGHT, "{}: {worst:e} at {at:?}", shape.name);
    }
}

/// Splitting a cubic changes no point of the curve, so it changes no lfs.
#[test]
fn split_shapes() {
    let mut random = Random(3);
    let mut failed = Vec::new();
    for shape in shapes() {
        let cuts: Vec<Vec<f64>> =
            shape.strokes.iter().map(|s| s.cubics.iter().map(|_| random.between(0.05, 0.95)).collect()).collect();
        let split = |path: usize, s: &Stroke| Stroke {
            closed: s.closed,
            cubics: s.cubics.iter().enumerate().flat_map(|(i, c)| <[_; 2]>::from(c.split_at(&cuts[path][i]))).collect(),
        };
        let strokes: Strokes = shape.strokes.iter().enumerate().map(|(i, s)| split(i, s)).collect();
        let known = shape
            .known
            .iter()
            .map(|k| {
                let cut = cuts[k.path][k.cubic];
                if k.t <= cut {
                    Known { cubic: 2 * k.cubic, t: k.t / cut, ..*k }
                } else {
                    Known { cubic: 2 * k.cubic + 1, t: (k.t - cut) / (1.0 - cut), ..*k }
                }
            })
            .collect();
        let split = Shape { name: shape.name, strokes, known, reach: shape.reach };
        let (worst, at) = worst(&split, &split.strokes, TOLERANCE, 1.0);
        println!("{}: {worst:.1e}", shape.name);
        if worst.is_nan() || worst > RIGHT {
            failed.push(format!("{} cut at {cuts:?}: {worst:e} at {at:?}", shape.name));
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// Powers of two are exact: every medial point, lfs and sample scales to the bit.
#[test]
fn scaling_by_powers_of_two_changes_no_bit() {
    fn compare<S: Scalar>(name: &str, strokes: &[Stroke], tolerance: f64, exponents: &[i32]) {
        let base = Model::<S>::new(&rounded(strokes), tolerance);
        let samples = base.sample(&base.options(0.4));
        for &e in exponents {
            let factor = 2_f64.powi(e);
            let scaled = mapped(strokes, |p| pt(p.x * factor, p.y * factor));
            let model = Model::<S>::new(&rounded(&scaled), tolerance);
            assert_eq!(model.medial.points().len(), base.medial.points().len(), "{name} at 2^{e}");
            for (a, b) in base.medial.points().iter().zip(model.medial.points()) {
                assert_eq!(a.radius.clone().mul_pow2(e), b.radius, "{name} at 2^{e}: {a:?}");
                assert_eq!(a.at, b.at, "{name} at 2^{e}");
            }
            let again = model.sample(&model.options(0.4));
            assert_eq!(again.len(), samples.len(), "{name} at 2^{e}");
            for (a, b) in samples.iter().zip(&again) {
                assert_eq!((&a.at, a.bound, a.lfs.clone().mul_pow2(e)), (&b.at, b.bound, b.lfs.clone()), "{name}");
            }
        }
    }
    let mut all: Vec<(&str, Strokes)> = shapes().into_iter().map(|s| (s.name, s.strokes)).collect();
    let wild = cubic([[0.3, 0.1], [2.7, 1.9], [-1.3, 1.7], [1.1, 0.2]]);
    all.push(("loop", vec![closed(vec![wild]), stick([0.1, 0.9], [1.3, 1.45])]));
    for (name, strokes) in all {
        compare::<f64>(name, &strokes, 1e-4, &[-40, -7, 1, 33]);
        compare::<f32>(name, &strokes, 1e-3, &[-6, 1, 9]);
    }
}

#[test]
fn a_lone_segment_has_no_medial_axis() {
    fn alone<S: Scalar>(strokes: &[Stroke]) {
        let model = Model::<S>::new(&rounded(strokes), 1e-4);
        assert!(!model.lfs(0, 0, 0.5).is_finite(), "lfs is infinite");
        assert!(model.medial.points().is_empty());
        let samples = model.sample(&model.options(0.5));
        assert_eq!(samples.len(), 2, "{samples:?}");
        assert!(samples.iter().all(|s| !s.lfs.is_finite()));
    }
    alone::<f64>(&[stick([1.0, 2.0], [5.0, 4.0])]);
    alone::<f32>(&[stick([1.0, 2.0], [5.0, 4.0])]);
    // In two pieces it is the same curve.
    alone::<f64>(&[open(vec![line([0.0, 0.0], [1.0, 0.0]), line([1.0, 0.0], [3.0, 0.0])])]);
    // Handles on the line, unevenly.
    alone::<f64>(&[open(vec![cubic([[0.0, 0.0], [2.0, 2.0], [2.5, 2.5], [3.0, 3.0]])])]);
}

/// A corner carries medial axis on its inner side only; lfs is 0 at it.
#[test]
fn corners_have_an_inside() {
    let corner = polygon(false, &[[1.0, 0.0], [0.0, 0.0], [0.0, 1.0]]);
    let model = Model::new(&[corner], TOLERANCE);
    assert!(model.lfs(0, 0, 1.0) < 1e-9);
    for m in model.medial.points() {
        let (x, y) = (m.centre.x, m.centre.y);
        assert!((x - y).abs() <= 1e-6 * (x + y).abs().max(1e-3) && x >= -1e-9, "{m:?}");
        assert!(m.side != Side::Fan || m.radius > 0.5, "{m:?}");
    }
}
