//! ε-samples judged by the independent checker: no point of the curve may lack a sample within ε·lfs.
//!
//! Always run: the drawings that ship at ε = 0.3 and 1 (all four with `FSAMPLE_ALL=1`), smooth shapes and special inputs at
//! ε = 0.3, 0.5, 0.66 and 1. Where the data folder is present (`FSAMPLE_DATA`): the smooth drawings at a
//! tolerance of 1e-5, and all of its drawings; those above 60 cubics only with `FSAMPLE_ALL=1`. The floored condition stands in only where the
//! definitions allow it, and the share of curve under the floor is printed. The checker's tolerance is its own error, 1e-8.

use crate::common::{
    Model, Stroke, Strokes, closed, cubic, data, ellipse, everything, line, load, open, polygon, pt, raw, reversed,
    shipped, stadium, stem, stick, svg_files,
};
use feature_sampling::bezier::Cubic;
use feature_sampling::sampling::{Bound, Sample, SamplingOptions};
use fsample_checker::{Checker, Options, Report};

const ALL: [f64; 4] = [0.3, 0.5, 0.66, 1.0];

/// One drawing before its judge.
struct Case {
    name: String,
    model: Model<f64>,
    checker: Checker,
}

impl Case {
    fn new(name: &str, strokes: &[Stroke], tolerance: f64) -> Self {
        let model = Model::new(strokes, tolerance);
        Self { name: name.to_owned(), model, checker: Checker::new(&raw(strokes)) }
    }

    fn judge(&self, options: &SamplingOptions<f64>, epsilon: f64) -> (Vec<Sample<f64>>, Report) {
        let samples = self.model.sample(options);
        let report = self.checker.check(&self.model.judged(&samples), epsilon, Options::default());
        println!(
            "{} at {epsilon}: {} samples, effective epsilon {:.5}, {:.2} % under a floor, {} missing edges",
            self.name,
            samples.len(),
            report.effective_epsilon,
            100.0 * report.share_under_floor,
            report.missing_edges.len()
        );
        (samples, report)
    }

    /// What is wrong with the samples at ε, one line each.
    fn faults(&self, epsilon: f64) -> Vec<String> {
        let (_, report) = self.judge(&self.model.options(epsilon), epsilon);
        self.faults_in(epsilon, &report)
    }

    fn faults_in(&self, epsilon: f64, report: &Report) -> Vec<String> {
        let mut out = Vec::new();
        for v in report.violations.iter().take(5) {
            out.push(format!("{} at {epsilon} ({} violations): {v:?}", self.name, report.violations.len()));
        }
        if report.off_curve > 1e-7 * self.checker.diagonal() {
            out.push(format!("{} at {epsilon}: a sample off the curve by {}", self.name, report.off_curve));
        }
        out
    }
}

fn none(faults: &[String]) {
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn shipped_drawings() {
    let epsilons: &[f64] = if everything() { &ALL } else { &[0.3, 1.0] };
    let mut faults = Vec::new();
    for (name, strokes) in shipped() {
        let case = Case::new(&name, &strokes, 1e-3);
        faults.extend(epsilons.iter().flat_map(|&e| case.faults(e)));
    }
    none(&faults);
}

#[test]
fn drawings_of_the_data_folder() {
    let mut faults = Vec::new();
    for folder in ["drawings", "public-domain"] {
        let Some(folder) = data(folder) else { continue };
        for file in svg_files(&folder) {
            let strokes = load(&file);
            let cubics: usize = strokes.iter().map(|s| s.cubics.len()).sum();
            if !everything() && (cubics > 60 || folder.ends_with("public-domain")) {
                continue;
            }
            let case = Case::new(&stem(&file), &strokes, 1e-3);
            let epsilons: &[f64] = if everything() { &ALL } else { &[0.5] };
            faults.extend(epsilons.iter().flat_map(|&e| case.faults(e)));
        }
    }
    none(&faults);
}

/// True, with all edges in the Delaunay triangulation, no sliver at the seam, and at most one sample more than the least
/// number over all starts. The minima are those of `examples/minimal_counts` at its finest grid, where they no longer rise.
#[test]
fn smooth_drawings_of_the_data_folder() {
    let minima = [
        ("simple", [29, 17, 13, 8]),
        ("blob2", [71, 42, 31, 19]),
        ("complex", [262, 157, 118, 77]),
        ("spiral", [569, 341, 258, 170]),
    ];
    let mut faults = Vec::new();
    for (name, minima) in minima {
        let Some(file) = data(&format!("drawings/{name}.svg")) else { continue };
        let case = Case::new(name, &load(&file), 1e-5);
        for (epsilon, minimum) in ALL.into_iter().zip(minima) {
            let (samples, report) = case.judge(&case.model.options(epsilon), epsilon);
            faults.extend(case.faults_in(epsilon, &report));
            if samples.len() > minimum + 1 {
                faults.push(format!("{name} at {epsilon}: {} samples, {minimum} would do", samples.len()));
            }
            if epsilon <= 0.66 && !report.missing_edges.is_empty() {
                faults.push(format!("{name} at {epsilon}: {} missing edges", report.missing_edges.len()));
            }
            if case.model.curve.report().corners == 0 {
                faults.extend(seam(name, &samples, epsilon));
            }
        }
    }
    none(&faults);
}

/// Closed smooth shapes.
fn smooth_shapes() -> Vec<(&'static str, Strokes)> {
    let pear = vec![
        cubic([[0.0, 0.0], [6.0, 0.0], [5.0, 5.0], [3.0, 6.0]]),
        cubic([[3.0, 6.0], [1.0, 7.0], [2.0, 10.0], [0.0, 10.0]]),
        cubic([[0.0, 10.0], [-2.0, 10.0], [-1.0, 7.0], [-3.0, 6.0]]),
        cubic([[-3.0, 6.0], [-5.0, 5.0], [-6.0, 0.0], [0.0, 0.0]]),
    ];
    let bean = vec![
        cubic([[0.0, 0.0], [4.0, 0.0], [8.0, -2.0], [8.0, 2.0]]),
        cubic([[8.0, 2.0], [8.0, 6.0], [4.0, 3.0], [2.0, 4.0]]),
        cubic([[2.0, 4.0], [0.0, 5.0], [-1.0, 8.0], [-3.0, 6.0]]),
        cubic([[-3.0, 6.0], [-5.0, 4.0], [-4.0, 0.0], [0.0, 0.0]]),
    ];
    vec![
        ("circle", vec![ellipse(0.0, 0.0, 1.0, 1.0)]),
        ("ellipse", vec![ellipse(5.0, 3.0, 4.0, 1.0)]),
        ("stadium", vec![stadium(3.0, 1.0)]),
        ("pear", vec![closed(pear)]),
        ("bean", vec![closed(bean)]),
        ("rings", vec![ellipse(0.0, 0.0, 3.0, 3.0), ellipse(0.2, 0.0, 2.2, 2.0), ellipse(0.0, 0.1, 0.3, 0.9)]),
    ]
}

/// Neighbours of a greedy sample lie on the border of one disk of radius ε·lfs(x), and the path makes an angle of at most
/// asin(ε/2) with the chord there, so a gap is 2ε·lfs(x)·√(1 − ε²/4) at least and 2ε·lfs(x) at most. The centres of two
/// neighbouring disks are no farther apart than their radii, and lfs is 1-Lipschitz: their radii differ by at most a factor
/// (1 + ε)/(1 − ε). The gap that closes the path has been spread to at least 63/64 of its neighbour's share; that, and
/// what the last trial leaves, is allowed for by a tenth.
fn seam(name: &str, samples: &[Sample<f64>], epsilon: f64) -> Vec<String> {
    let mut out = Vec::new();
    if epsilon >= 0.6 {
        return out;
    }
    let bound = 1.1 * (1.0 + epsilon) / (1.0 - epsilon) / (1.0 - epsilon * epsilon / 4.0).sqrt();
    for path in samples.chunk_by(|a, b| a.path == b.path).filter(|p| p.len() >= 6) {
        let n = path.len();
        let gap = |i: usize| path[i % n].point.distance(&path[(i + 1) % n].point);
        let (before, at, after) = (gap(n - 2), gap(n - 1), gap(n));
        let ratio = [at / before, before / at, at / after, after / at].into_iter().fold(0.0, f64::max);
        println!("{name} at {epsilon}: gap ratio {ratio:.3} at the seam");
        if ratio > bound {
            out.push(format!("{name} at {epsilon}: gaps {before} {at} {after} at the seam, ratio {ratio} > {bound}"));
        }
    }
    out
}

#[test]
fn smooth_closed_shapes() {
    let mut faults = Vec::new();
    for (name, strokes) in smooth_shapes() {
        let case = Case::new(name, &strokes, 1e-3);
        for epsilon in ALL {
            let (samples, report) = case.judge(&case.model.options(epsilon), epsilon);
            faults.extend(case.faults_in(epsilon, &report));
            faults.extend(seam(name, &samples, epsilon));
            if epsilon <= 0.66 && !report.missing_edges.is_empty() {
                faults.push(format!("{name} at {epsilon}: missing edges {:?}", report.missing_edges));
            }
            if report.share_under_floor > 0.0 {
                faults.push(format!("{name} at {epsilon}: a floor on a smooth shape"));
            }
        }
    }
    none(&faults);
}

#[test]
fn starts_anywhere() {
    let mut faults = Vec::new();
    for (name, strokes) in smooth_shapes() {
        let case = Case::new(name, &strokes, 1e-3);
        let mut counts = Vec::new();
        for start in [0.0, 0.1, 0.25, 0.333, 0.5, 0.77, 0.99] {
            let options = SamplingOptions { start, ..case.model.options(0.5) };
            let (samples, report) = case.judge(&options, 0.5);
            faults.extend(case.faults_in(0.5, &report).into_iter().map(|f| format!("start {start}: {f}")));
            counts.push(samples.len());
            assert_eq!(samples[0].bound, Bound::Start);
        }
        // Greedy is at most one above the best start, path by path.
        let (least, most) = (counts.iter().min().copied(), counts.iter().max().copied());
        if most > least.map(|n| n + strokes.len()) {
            faults.push(format!("{name}: counts {counts:?} by start"));
        }
    }
    none(&faults);
}

/// What drawings contain and samplers trip over.
fn special_inputs() -> Vec<(&'static str, Strokes)> {
    let half = crate::common::quarters(0.0, 0.0, 2.0, 2.0);
    let wave = [[0.0, 0.0], [2.0, 4.0], [5.0, -3.0], [7.0, 1.0]];
    let kink = 0.05_f64.to_radians();
    let turned =
        [[7.0, 1.0], [7.0 + 2.0 * kink.cos(), 1.0 + 4.0 * kink.cos() + 2.0 * kink.sin()], [11.0, 5.0], [12.0, 0.0]];
    let direction = (4.0_f64).atan2(2.0) + kink;
    let length = 20_f64.sqrt();
    let kinked = [turned[0], [7.0 + length * direction.cos(), 1.0 + length * direction.sin()], turned[2], turned[3]];
    let eight = vec![
        cubic([[0.0, 0.0], [3.0, 3.0], [6.0, 3.0], [6.0, 0.0]]),
        cubic([[6.0, 0.0], [6.0, -3.0], [3.0, -3.0], [0.0, 0.0]]),
        cubic([[0.0, 0.0], [-3.0, 3.0], [-6.0, 3.0], [-6.0, 0.0]]),
        cubic([[-6.0, 0.0], [-6.0, -3.0], [-3.0, -3.0], [0.0, 0.0]]),
    ];
    vec![
        ("half disc closed by Z", vec![closed(half[..2].to_vec())]),
        ("half disc with its line", vec![closed(vec![half[0], half[1], line([-2.0, 0.0], [2.0, 0.0])])]),
        (
            "collinear handles",
            vec![open(vec![cubic([[0.0, 0.0], [0.5, 0.0], [5.5, 0.0], [6.0, 0.0]])]), stick([1.0, 1.0], [5.0, 2.0])],
        ),
        ("handles on a curve's chord", vec![open(vec![cubic([[0.0, 0.0], [3.0, 0.0], [3.0, 0.0], [6.0, 2.0]])])]),
        ("retracted start", vec![open(vec![cubic([[0.0, 0.0], [0.0, 0.0], [4.0, 4.0], [6.0, 0.0]])])]),
        (
            "retracted both",
            vec![open(vec![cubic([[0.0, 0.0], [0.0, 0.0], [6.0, 0.0], [6.0, 0.0]])]), stick([0.0, 2.0], [6.0, 1.0])],
        ),
        (
            "retracted joint",
            vec![open(vec![
                cubic([[0.0, 0.0], [1.0, 3.0], [4.0, 3.0], [4.0, 3.0]]),
                cubic([[4.0, 3.0], [4.0, 3.0], [7.0, 4.0], [8.0, 0.0]]),
            ])],
        ),
        ("exact cusp", vec![open(vec![cubic([[0.0, 0.0], [4.0, 4.0], [0.0, 4.0], [4.0, 0.0]])])]),
        ("loop", vec![open(vec![cubic([[0.0, 0.0], [6.0, 4.0], [-2.0, 4.0], [4.0, 0.0]])])]),
        ("figure eight", vec![closed(eight)]),
        (
            "figure eight of one crossing",
            vec![closed(vec![
                cubic([[-4.0, -2.0], [0.0, -2.0], [0.0, 2.0], [4.0, 2.0]]),
                cubic([[4.0, 2.0], [7.0, 2.0], [7.0, -2.0], [4.0, -2.0]]),
                cubic([[4.0, -2.0], [0.0, -2.0], [0.0, 2.0], [-4.0, 2.0]]),
                cubic([[-4.0, 2.0], [-7.0, 2.0], [-7.0, -2.0], [-4.0, -2.0]]),
            ])],
        ),
        ("the same twice", vec![open(vec![cubic(wave)]), open(vec![cubic(wave)])]),
        ("the same and back", vec![open(vec![cubic(wave)]), open(vec![cubic(wave).reversed()])]),
        (
            "crossings",
            vec![
                open(vec![cubic(wave)]),
                stick([0.0, 2.0], [7.0, -1.0]),
                stick([3.0, -3.0], [3.5, 4.0]),
                ellipse(4.0, 0.0, 2.0, 1.0),
            ],
        ),
        ("T exact", vec![stick([0.0, 0.0], [8.0, 0.0]), stick([4.0, 0.0], [4.0, 5.0])]),
        (
            "T exact on a curve",
            vec![open(vec![cubic(wave)]), open(vec![Cubic::line(cubic(wave).eval(&0.5), pt(3.0, 6.0))])],
        ),
        ("T 1e-9 short", vec![stick([0.0, 0.0], [8.0, 0.0]), stick([4.0, 1e-9], [4.0, 5.0])]),
        ("T short", vec![stick([0.0, 0.0], [8.0, 0.0]), stick([4.0, 0.01], [4.0, 5.0])]),
        (
            "ends meet smoothly",
            vec![stick([0.0, 0.0], [4.0, 0.0]), open(vec![cubic([[4.0, 0.0], [6.0, 0.0], [8.0, 1.0], [8.0, 4.0]])])],
        ),
        ("ends meet in a corner", vec![stick([0.0, 0.0], [4.0, 0.0]), stick([4.0, 0.0], [5.0, 3.0])]),
        (
            "three ends meet",
            vec![stick([0.0, 0.0], [4.0, 0.0]), stick([4.0, 0.0], [5.0, 3.0]), stick([6.0, -3.0], [4.0, 0.0])],
        ),
        ("kink of 0.05°", vec![open(vec![cubic([[0.0, 0.0], [2.0, 4.0], [5.0, -3.0], [7.0, 1.0]]), cubic(kinked)])]),
        ("one closed cubic", vec![closed(vec![cubic([[0.0, 0.0], [5.0, 4.0], [-5.0, 4.0], [0.0, 0.0]])])]),
        ("square", vec![polygon(true, &[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])]),
        ("needle", vec![polygon(true, &[[0.0, 0.0], [10.0, 0.2], [0.0, 0.4]])]),
        (
            "polyline of collinear pieces",
            vec![open(vec![line([0.0, 0.0], [1.0, 0.0]), line([1.0, 0.0], [4.0, 0.0])]), stick([0.0, 1.0], [4.0, 1.5])],
        ),
    ]
}

#[test]
fn special_inputs_are_sampled_truly() {
    let mut faults = Vec::new();
    for (name, strokes) in special_inputs() {
        let case = Case::new(name, &strokes, 1e-3);
        faults.extend(ALL.into_iter().flat_map(|e| case.faults(e)));
    }
    none(&faults);
}

#[test]
fn special_inputs_backwards() {
    let mut faults = Vec::new();
    for (name, strokes) in special_inputs() {
        let case = Case::new(&format!("{name}, reversed"), &reversed(&strokes), 1e-3);
        faults.extend(case.faults(0.5));
    }
    none(&faults);
}

/// Two curved strokes meet in a corner with retracted handles: from the corner itself the quotient of the tangent disks has no
/// value at the other stroke's end and its largest ones beside it, and inside the corner no disk has any size.
#[test]
fn corners_with_retracted_handles() {
    let strokes = vec![open(vec![
        cubic([[237.463, 448.56], [228.095, 448.56], [210.92, 413.429], [210.92, 413.429]]),
        cubic([[210.92, 413.429], [210.92, 413.429], [225.753, 393.911], [225.753, 388.447]]),
    ])];
    let case = Case::new("retracted corner", &strokes, 1e-4);
    for segment in 0..2 {
        for k in 1..100 {
            let t = f64::from(k) / 100.0;
            let p = strokes[0].cubics[segment as usize].eval(&t);
            let (ours, theirs) = (case.model.medial.lfs(&p), case.checker.lfs(0, segment as usize, t));
            assert!((ours - theirs).abs() <= 2e-4 * theirs, "segment {segment} t {t}: {ours}, judge {theirs}");
        }
    }
    none(&ALL.into_iter().flat_map(|e| case.faults(e)).collect::<Vec<_>>());
}
