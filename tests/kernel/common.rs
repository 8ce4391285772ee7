//! What the integration tests share: shapes, drawings, the kernel's models, and the way to the independent judge.
//!
//! `FSAMPLE_DATA` names the folder with the drawings and truth data that do not ship (default `../shared/data` beside the
//! repository); tests that need it say that they skip where it is absent. `FSAMPLE_ALL=1` asks for every drawing and ε.

use std::path::{Path, PathBuf};

use feature_sampling::bezier::Cubic;
use feature_sampling::curve::CurveParam;
use feature_sampling::curve::door::{DoorOptions, sine_of_degrees};
use feature_sampling::geometry::Point;
use feature_sampling::medial::Resolution;
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::{Condition, Sample, SamplingOptions};
use feature_sampling::scalar::Scalar;
use fsample_checker::RawPath;
use fsample_checker::plane::v2;

/// A path: closed or open, and its cubics.
#[derive(Clone, Debug)]
pub(crate) struct Stroke<S = f64> {
    pub(crate) closed: bool,
    pub(crate) cubics: Vec<Cubic<S>>,
}

/// A drawing, as the kernel and the judge are both given it.
pub(crate) type Strokes<S = f64> = Vec<Stroke<S>>;

/// (4/3)·(√2 − 1): the handle of a quarter circle.
pub(crate) const QUARTER: f64 = 0.552_284_749_830_793_6;

pub(crate) fn pt(x: f64, y: f64) -> Point<f64> {
    Point::new(x, y)
}

pub(crate) fn open(cubics: Vec<Cubic<f64>>) -> Stroke {
    Stroke { closed: false, cubics }
}

pub(crate) fn closed(cubics: Vec<Cubic<f64>>) -> Stroke {
    Stroke { closed: true, cubics }
}

pub(crate) fn line(a: [f64; 2], b: [f64; 2]) -> Cubic<f64> {
    Cubic::line(pt(a[0], a[1]), pt(b[0], b[1]))
}

pub(crate) fn cubic(p: [[f64; 2]; 4]) -> Cubic<f64> {
    Cubic { points: p.map(|[x, y]| pt(x, y)) }
}

/// A straight stroke.
pub(crate) fn stick(a: [f64; 2], b: [f64; 2]) -> Stroke {
    open(vec![line(a, b)])
}

/// A closed or open polygon.
pub(crate) fn polygon(close: bool, corners: &[[f64; 2]]) -> Stroke {
    let mut cubics: Vec<_> = corners.windows(2).map(|w| line(w[0], w[1])).collect();
    if close {
        cubics.push(line(corners[corners.len() - 1], corners[0]));
    }
    Stroke { closed: close, cubics }
}

/// Fans at open ends and corners, an acute corner, a crossing, a touching, a stroke drawn twice, a cusp, strokes that
/// coincide along a stretch.
pub(crate) fn difficult() -> Vec<(&'static str, Strokes)> {
    let wave = cubic([[0.0, 0.0], [20.0, 40.0], [50.0, -30.0], [70.0, 10.0]]);
    let cusp = cubic([[0.0, 0.0], [10.0, 10.0], [0.0, 10.0], [10.0, 0.0]]);
    let right: Vec<_> = quarters(4.0, 0.0, 2.0, 2.0).into();
    vec![
        ("ellipse", vec![ellipse(0.0, 0.0, 8.0, 3.0)]),
        ("wave and a stroke across", vec![open(vec![wave]), stick([0.0, 20.0], [60.0, -5.0])]),
        ("zigzag", vec![polygon(false, &[[0.0, 0.0], [5.0, 8.0], [6.0, 0.0], [6.5, 9.0]])]),
        ("square", vec![polygon(true, &[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])]),
        ("touching circles", vec![ellipse(0.0, 0.0, 2.0, 2.0), closed(right)]),
        ("twice", vec![open(vec![wave]), open(vec![wave.reversed()]), stick([0.0, 30.0], [60.0, 35.0])]),
        ("cusp", vec![open(vec![cusp]), stick([-5.0, -5.0], [15.0, -4.0])]),
        ("half a stroke again", vec![stick([0.0, 0.0], [10.0, 0.0]), stick([3.0, 0.0], [7.0, 0.0])]),
    ]
}

/// An ellipse of four cubics from (cx + a, cy), through (cx, cy + b).
pub(crate) fn ellipse(cx: f64, cy: f64, a: f64, b: f64) -> Stroke {
    closed(quarters(cx, cy, a, b).to_vec())
}

/// Its four quarters.
pub(crate) fn quarters(cx: f64, cy: f64, a: f64, b: f64) -> [Cubic<f64>; 4] {
    let k = QUARTER;
    let unit = [
        [[1.0, 0.0], [1.0, k], [k, 1.0], [0.0, 1.0]],
        [[0.0, 1.0], [-k, 1.0], [-1.0, k], [-1.0, 0.0]],
        [[-1.0, 0.0], [-1.0, -k], [-k, -1.0], [0.0, -1.0]],
        [[0.0, -1.0], [k, -1.0], [1.0, -k], [1.0, 0.0]],
    ];
    unit.map(|q| cubic(q.map(|[x, y]| [cx + a * x, cy + b * y])))
}

/// Two straight sides of length 2·l and two half circles of two cubics each, radius r.
pub(crate) fn stadium(l: f64, r: f64) -> Stroke {
    let [a, b, c, d] = quarters(0.0, 0.0, r, r);
    let shift = |q: Cubic<f64>, x: f64| Cubic { points: q.points.map(|p| pt(p.x + x, p.y)) };
    closed(vec![line([-l, -r], [l, -r]), shift(d, l), shift(a, l), line([l, r], [-l, r]), shift(b, -l), shift(c, -l)])
}

/// The same drawing with every point mapped.
pub(crate) fn mapped(strokes: &[Stroke], f: impl Fn(Point<f64>) -> Point<f64>) -> Strokes {
    let map = |c: &Cubic<f64>| Cubic { points: c.points.map(&f) };
    strokes.iter().map(|s| Stroke { closed: s.closed, cubics: s.cubics.iter().map(map).collect() }).collect()
}

/// The same drawing turned by an angle (in radians), scaled and moved.
pub(crate) fn placed(strokes: &[Stroke], angle: f64, scale: f64, by: [f64; 2]) -> Strokes {
    let (sin, cos) = angle.sin_cos();
    mapped(strokes, |p| pt(scale * (cos * p.x - sin * p.y) + by[0], scale * (sin * p.x + cos * p.y) + by[1]))
}

/// Every path run backwards.
pub(crate) fn reversed(strokes: &[Stroke]) -> Strokes {
    let back = |s: &Stroke| s.cubics.iter().rev().map(Cubic::reversed).collect();
    strokes.iter().map(|s| Stroke { closed: s.closed, cubics: back(s) }).collect()
}

/// The same drawing with coordinates rounded to another scalar.
pub(crate) fn rounded<S: Scalar>(strokes: &[Stroke]) -> Strokes<S> {
    let to = |c: &Cubic<f64>| Cubic { points: c.points.map(|p| Point::from_f64(p.x, p.y)) };
    strokes.iter().map(|s| Stroke { closed: s.closed, cubics: s.cubics.iter().map(to).collect() }).collect()
}

/// A small generator: the tests run the same everywhere.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let x = (self.0 ^ (self.0 >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        f64::from(u32::try_from(x >> 32).expect("32 bits")) / 4_294_967_296.0
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// 0 … n − 1.
    pub(crate) fn below(&mut self, n: u32) -> u32 {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to n")]
        let k = (self.unit() * f64::from(n)) as u32;
        k
    }

    /// In a square of this size.
    pub(crate) fn point(&mut self, size: f64) -> Point<f64> {
        pt(size * self.unit(), size * self.unit())
    }
}

/// The kernel's curve.
pub(crate) fn curve_model<S: Scalar>(strokes: &[Stroke<S>], door: &DoorOptions<S>) -> CurveModel<S> {
    let paths: Vec<(bool, &[Cubic<S>])> = strokes.iter().map(|s| (s.closed, s.cubics.as_slice())).collect();
    CurveModel::new(&paths, door).expect("a drawing")
}

/// The kernel's curve and medial polylines of a drawing.
pub(crate) struct Model<S> {
    pub(crate) curve: CurveModel<S>,
    pub(crate) medial: MedialModel<S>,
    pub(crate) tolerance: S,
}

impl<S: Scalar> Model<S> {
    /// Refined to a tolerance.
    pub(crate) fn new(strokes: &[Stroke<S>], tolerance: f64) -> Self {
        Self::with_door(strokes, tolerance, &DoorOptions::default())
    }

    pub(crate) fn with_door(strokes: &[Stroke<S>], tolerance: f64, door: &DoorOptions<S>) -> Self {
        let curve = curve_model(strokes, door);
        let tolerance = S::from_f64(tolerance);
        let medial = MedialModel::new(&curve, &Resolution::Tolerance(tolerance.clone()));
        Self { curve, medial, tolerance }
    }

    /// The place on C of a raw cubic's parameter; `None` where the door dropped it.
    pub(crate) fn place(&self, path: usize, cubic: usize, t: f64) -> Option<CurveParam<S>> {
        place(&self.curve, path, cubic, t)
    }

    /// lfs at a raw cubic's parameter.
    pub(crate) fn lfs(&self, path: usize, cubic: usize, t: f64) -> S {
        let at = self.place(path, cubic, t).expect("the cubic is on C");
        self.medial.lfs(&self.curve.curve().point(&at).expect("a place on C"))
    }

    pub(crate) fn options(&self, epsilon: f64) -> SamplingOptions<S> {
        SamplingOptions {
            condition: Condition::Epsilon(S::from_f64(epsilon)),
            tolerance: self.tolerance.clone(),
            ..SamplingOptions::default()
        }
    }

    pub(crate) fn sample(&self, options: &SamplingOptions<S>) -> Vec<Sample<S>> {
        self.curve.sample(&self.medial, options).expect("samples")
    }

    /// The samples as the judge takes them.
    pub(crate) fn judged(&self, samples: &[Sample<S>]) -> Vec<fsample_checker::Sample> {
        samples
            .iter()
            .map(|s| {
                let (path, segment, t) = self.curve.source(&s.at);
                fsample_checker::Sample {
                    path: path as usize,
                    segment: segment as usize,
                    t: t.to_f64(),
                    point: v2(s.point.x.to_f64(), s.point.y.to_f64()),
                }
            })
            .collect()
    }
}

/// The place on C of a raw cubic's parameter. Only for cubics that are not straight: those run at uniform speed on C.
pub(crate) fn place<S: Scalar>(model: &CurveModel<S>, path: usize, cubic: usize, t: f64) -> Option<CurveParam<S>> {
    let curve = model.curve();
    let path = curve.paths.iter().find(|p| p.source as usize == path)?;
    let t = S::from_f64(t);
    (path.first..path.first + path.count).find_map(|i| {
        let source = curve.source(i)?;
        let here = source.segment as usize == cubic && t >= source.from && t <= source.to;
        here.then(|| CurveParam { segment: i, t: (t.clone() - &source.from) / &(source.to.clone() - &source.from) })
    })
}

/// A drawing as the judge reads it.
pub(crate) fn raw(strokes: &[Stroke]) -> Vec<RawPath> {
    strokes
        .iter()
        .map(|s| RawPath { closed: s.closed, cubics: s.cubics.iter().map(|c| c.points.map(|p| [p.x, p.y])).collect() })
        .collect()
}

/// Options of the kernel's door and of the judge's for the same corner angle in degrees.
pub(crate) fn doors(degrees: f64) -> (DoorOptions<f64>, fsample_checker::DoorOptions) {
    let kernel = DoorOptions { corner_sine: sine_of_degrees(&degrees), ..DoorOptions::default() };
    (kernel, fsample_checker::DoorOptions { corner_angle: degrees })
}

/// Reads an SVG drawing.
pub(crate) fn load(file: &Path) -> Strokes {
    let drawing = lineart::drawing::load(file).unwrap_or_else(|e| panic!("{e}"));
    drawing.paths.into_iter().map(|p| Stroke { closed: p.closed, cubics: p.cubics }).collect()
}

/// A file of the data folder, or a message and nothing.
pub(crate) fn data(name: &str) -> Option<PathBuf> {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let file = std::env::var_os("FSAMPLE_DATA").map_or_else(beside, PathBuf::from).join(name);
    let there = file.exists();
    if !there {
        eprintln!("skipped: no {name} (set FSAMPLE_DATA to the data folder)");
    }
    there.then_some(file)
}

/// The SVG files of a folder, by name.
pub(crate) fn svg_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut files: Vec<PathBuf> = entries.map(|e| e.expect("an entry").path()).collect();
    files.retain(|f| f.extension().is_some_and(|e| e == "svg"));
    files.sort();
    files
}

/// The drawings that ship, by name.
pub(crate) fn shipped() -> Vec<(String, Strokes)> {
    let files = svg_files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("drawings"));
    files.iter().map(|f| (stem(f), load(f))).collect()
}

pub(crate) fn stem(file: &Path) -> String {
    file.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default()
}

/// `FSAMPLE_ALL` is set: everything is asked for.
pub(crate) fn everything() -> bool {
    std::env::var_os("FSAMPLE_ALL").is_some_and(|v| v != "0")
}

/// Largest curvature of a cubic and its parameter, by a grid and golden sections.
pub(crate) fn sharpest(c: &Cubic<f64>) -> (f64, f64) {
    let b = c.power_basis();
    let curvature = |t: f64| {
        let (d, dd) = (b.derivative(&t), b.second_derivative(&t));
        d.cross(&dd).abs() / d.norm().powi(3)
    };
    let n = 2000_u32;
    let at = |i: u32| f64::from(i) / f64::from(n);
    let i = (0..=n).max_by(|&i, &j| curvature(at(i)).total_cmp(&curvature(at(j)))).expect("points");
    let (mut lo, mut hi) = (at(i.saturating_sub(1)), at((i + 1).min(n)));
    for _ in 0..90 {
        let (a, c) = (hi - (hi - lo) * 0.618_033_988_749_895, lo + (hi - lo) * 0.618_033_988_749_895);
        if curvature(a) > curvature(c) { hi = c } else { lo = a }
    }
    [at(i), lo, hi, 0.5 * (lo + hi)]
        .into_iter()
        .map(|t| (curvature(t), t))
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .expect("four candidates")
}
