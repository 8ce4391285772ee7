//! lfs of shapes where it is known in closed form, and of drawings against an independent dense computation.
//!
//! The value that counts is the one *of the cubics that are drawn*. A circle of four cubics is no circle: its curvature
//! varies, and its smallest lfs is 0.9921 R.

use std::error::Error;
use std::fmt::Write;
use std::path::Path;

use feature_sampling::bezier::Cubic;
use feature_sampling::curve::CurveParam;
use feature_sampling::curve::door::{DoorOptions, sine_of_degrees};
use feature_sampling::geometry::Point;
use feature_sampling::medial::{Foot, Resolution, Side, tangent_disk};
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::scalar::Scalar;

/// What can go wrong, in words.
pub type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// A path: closed or not, and its cubics.
type Stroke<S> = (bool, Vec<Cubic<S>>);

/// A drawing, and places on it (by point) with their lfs.
struct Shape {
    name: &'static str,
    strokes: Vec<Stroke<f64>>,
    known: Vec<(Point<f64>, f64)>,
}

/// (4/3)·(√2 − 1): the handle of a quarter circle.
const QUARTER: f64 = 0.552_284_749_830_793_6;

fn cubic(p: [[f64; 2]; 4]) -> Cubic<f64> {
    Cubic { points: p.map(|[x, y]| Point::new(x, y)) }
}

fn line(a: [f64; 2], b: [f64; 2]) -> Stroke<f64> {
    (false, vec![Cubic::line(Point::new(a[0], a[1]), Point::new(b[0], b[1]))])
}

/// The four quarters of an ellipse around (x, 0).
fn quarters(x: f64, a: f64, b: f64) -> [Cubic<f64>; 4] {
    [
        [[1.0, 0.0], [1.0, QUARTER], [QUARTER, 1.0], [0.0, 1.0]],
        [[0.0, 1.0], [-QUARTER, 1.0], [-1.0, QUARTER], [-1.0, 0.0]],
        [[-1.0, 0.0], [-1.0, -QUARTER], [-QUARTER, -1.0], [0.0, -1.0]],
        [[0.0, -1.0], [QUARTER, -1.0], [1.0, -QUARTER], [1.0, 0.0]],
    ]
    .map(|q| cubic(q.map(|[u, v]| [x + a * u, b * v])))
}

fn ellipse(a: f64, b: f64) -> Stroke<f64> {
    (true, quarters(0.0, a, b).to_vec())
}

/// Where a cubic is sharpest, and the radius of curvature there; by a grid and golden sections.
fn sharpest(c: &Cubic<f64>) -> (Point<f64>, f64) {
    let power = c.power_basis();
    let radius = |t: f64| {
        let (d, dd) = (power.derivative(&t), power.second_derivative(&t));
        d.norm().powi(3) / d.cross(&dd).abs()
    };
    let grid = |i: i32| f64::from(i) / 1000.0;
    let i = (0..=1000).min_by(|&i, &j| radius(grid(i)).total_cmp(&radius(grid(j)))).unwrap_or(0);
    let (mut lo, mut hi) = (grid((i - 1).max(0)), grid((i + 1).min(1000)));
    for _ in 0..80 {
        let (a, b) = (hi - (hi - lo) * 0.618_033_988_749_895, lo + (hi - lo) * 0.618_033_988_749_895);
        if radius(a) < radius(b) { hi = b } else { lo = a }
    }
    let t = [grid(i), lo, hi].into_iter().min_by(|a, b| radius(*a).total_cmp(&radius(*b))).unwrap_or(lo);
    (power.eval(&t), radius(t))
}

/// Known by the curvature at the sharpest place of each of these cubics.
fn bent(name: &'static str, strokes: Vec<Stroke<f64>>, cubics: &[usize]) -> Shape {
    let known = cubics.iter().map(|&i| sharpest(&strokes[0].1[i])).collect();
    Shape { name, strokes, known }
}

/// Known everywhere, from the point.
fn known(name: &'static str, strokes: Vec<Stroke<f64>>, lfs: impl Fn(f64, f64) -> f64) -> Shape {
    let points = |c: &Cubic<f64>| (0..=64).map(|i| c.eval(&(f64::from(i) / 64.0))).collect::<Vec<_>>();
    let all = strokes.iter().flat_map(|s| &s.1).flat_map(points);
    let known = all.map(|p| (p, lfs(p.x, p.y))).collect();
    Shape { name, strokes, known }
}

fn shapes() -> Vec<Shape> {
    let f = 0.75;
    let parabola =
        Cubic::quadratic(Point::new(-4.0 * f, 4.0 * f), &Point::new(0.0, -4.0 * f), Point::new(4.0 * f, 4.0 * f));
    let [a, b, c, d] = quarters(0.0, 1.0, 1.0);
    let shifted = |q: Cubic<f64>, x: f64| Cubic { points: q.points.map(|p| Point::new(p.x + x, p.y)) };
    let side = |y: f64, x: f64| Cubic::line(Point::new(-x, y), Point::new(x, y));
    let stadium =
        vec![side(-1.0, 3.0), shifted(d, 3.0), shifted(a, 3.0), side(1.0, -3.0), shifted(b, -3.0), shifted(c, -3.0)];
    let mut stadium = bent("stadium", vec![(true, stadium)], &[1, 2, 4, 5]);
    stadium.known.extend((-4..=4).map(|i| (Point::new(0.5 * f64::from(i), 1.0), 1.0)));
    let mut rings = bent("concentric circles, 1 and 1.6", vec![ellipse(1.0, 1.0), ellipse(1.6, 1.6)], &[]);
    for r in [1.0, 1.6] {
        let h = r * 0.5_f64.sqrt();
        rings.known.extend([[r, 0.0], [0.0, r], [-r, 0.0], [h, h], [-h, h]].map(|[x, y]| (Point::new(x, y), 0.3)));
    }
    let corner = vec![
        Cubic::line(Point::new(1.0, 0.0), Point::new(0.0, 0.0)),
        Cubic::line(Point::new(0.0, 0.0), Point::new(0.0, 1.0)),
    ];
    let half = 0.5_f64.sqrt();
    let sine60 = 60_f64.to_radians().sin();
    vec![
        bent("circle", vec![ellipse(1.0, 1.0)], &[0, 1, 2, 3]),
        bent("ellipse 2 : 1", vec![ellipse(2.0, 1.0)], &[0, 1, 2, 3]),
        bent("ellipse 5 : 1", vec![ellipse(5.0, 1.0)], &[0, 1, 2, 3]),
        known(
            "parabola",
            vec![(false, vec![parabola])],
            move |x, y| {
                if y < 2.0 * f { x.hypot(y - 2.0 * f) } else { x.abs() }
            },
        ),
        stadium,
        rings,
        known("two parallel lines", vec![line([-2.0, 0.0], [2.0, 0.0]), line([-2.0, 0.5], [2.0, 0.5])], |_, _| 0.25),
        known("corner of 90°", vec![(false, corner)], move |x, y| (x + y) * half),
        known(
            "two ends facing each other",
            vec![line([-1.0, 0.0], [-0.1, 0.0]), line([0.1, 0.0], [1.0, 0.0])],
            |x, _| x.abs(),
        ),
        known("T-junction", vec![line([-1.0, 0.0], [1.0, 0.0]), line([0.0, 0.0], [0.0, 1.0])], move |x, y| {
            (x.abs() + y) * half
        }),
        known("crossing of 60°", vec![line([-1.0, 0.0], [1.0, 0.0]), line([-0.5, -sine60], [0.5, sine60])], |x, y| {
            0.5 * x.hypot(y)
        }),
    ]
}

/// The curve and its medial polylines, in a scalar, at a tolerance.
fn models<S: Scalar>(
    strokes: &[Stroke<f64>],
    corner_degrees: f64,
    tolerance: f64,
) -> Result<(CurveModel<S>, MedialModel<S>)> {
    let rounded = |c: &Cubic<f64>| Cubic { points: c.points.map(|p| Point::from_f64(p.x, p.y)) };
    let paths: Vec<Stroke<S>> =
        strokes.iter().map(|(closed, cubics)| (*closed, cubics.iter().map(rounded).collect())).collect();
    let borrowed: Vec<(bool, &[Cubic<S>])> = paths.iter().map(|(closed, cubics)| (*closed, &cubics[..])).collect();
    let door = DoorOptions { corner_sine: sine_of_degrees(&S::from_f64(corner_degrees)), ..DoorOptions::default() };
    let curve = CurveModel::new(&borrowed, &door)?;
    let medial = MedialModel::new(&curve, &Resolution::Tolerance(S::from_f64(tolerance)));
    Ok((curve, medial))
}

/// The largest relative error of lfs over the known places; absolute in units of the diagonal where the value is 0.
fn worst<S: Scalar>(shape: &Shape, tolerance: f64) -> Result<f64> {
    let (curve, medial) = models::<S>(&shape.strokes, 1.0, tolerance)?;
    let unit = curve.diagonal().to_f64();
    let errors = shape.known.iter().map(|(p, lfs)| {
        let found = medial.lfs(&Point::from_f64(p.x, p.y)).to_f64();
        if *lfs < 1e-9 * unit { found / unit } else { (found / lfs - 1.0).abs() }
    });
    Ok(errors.fold(0.0, f64::max))
}

/// Errors of lfs on the shapes, as Markdown.
///
/// # Errors
/// A shape that the door refuses.
pub fn analytic() -> Result<String> {
    let mut out = String::from(
        "| shape | f64, 1e-3 | f64, 1e-5 | f64, 1e-7 | f32, 1e-3 | f32, 1e-4 |\n|---|---|---|---|---|---|\n",
    );
    for shape in shapes() {
        write!(out, "| {} |", shape.name)?;
        for tolerance in [1e-3, 1e-5, 1e-7] {
            write!(out, " {:.1e} |", worst::<f64>(&shape, tolerance)?)?;
        }
        for tolerance in [1e-3, 1e-4] {
            write!(out, " {:.1e} |", worst::<f32>(&shape, tolerance)?)?;
        }
        out.push('\n');
    }
    Ok(out)
}

/// One line of a truth file.
struct Truth {
    segment: u32,
    t: f64,
    lfs: f64,
    radii: [f64; 2],
}

fn read_truth(file: &Path) -> Result<Vec<Truth>> {
    let mut rows = Vec::new();
    for line in std::fs::read_to_string(file)?.lines().skip(1) {
        let v = line.split(',').map(str::parse).collect::<std::result::Result<Vec<f64>, _>>()?;
        let segment = line.split(',').next().unwrap_or_default().parse()?;
        let [t, lfs, left, right] = [1, 4, 8, 9].map(|i| v.get(i).copied().unwrap_or(f64::NAN));
        rows.push(Truth { segment, t, lfs, radii: [left, right] });
    }
    Ok(rows)
}

/// Errors of lfs on drawings, as Markdown; `folder` holds `drawings/NAME.svg` and `truth/NAME.csv` with the columns
/// `segment,t,x,y,lfs,error,mx,my,left,right`. `None` where one of them is missing.
///
/// # Errors
/// A drawing or table that cannot be read.
pub fn against_truth(folder: &Path) -> Result<Option<String>> {
    let mut out =
        String::from("| drawing | tolerance | medial points | lfs too large by | too small by | error of radii |\n");
    out.push_str("|---|---|---|---|---|---|\n");
    for name in ["simple", "blob2", "complex", "spiral"] {
        let (drawing, table) = (folder.join(format!("drawings/{name}.svg")), folder.join(format!("truth/{name}.csv")));
        if !(drawing.exists() && table.exists()) {
            return Ok(None);
        }
        let strokes: Vec<Stroke<f64>> =
            lineart::drawing::load(&drawing)?.paths.into_iter().map(|p| (p.closed, p.cubics)).collect();
        let truth = read_truth(&table)?;
        for tolerance in [1e-3, 1e-5, 1e-7] {
            // The truth calls joints smooth that turn by less than 0.002 rad.
            let (model, medial) = models::<f64>(&strokes, 0.002_f64.to_degrees(), tolerance)?;
            let curve = model.curve();
            let (mut over, mut under, mut radii) = (0.0_f64, 0.0_f64, 0.0_f64);
            for row in &truth {
                // One path without cusps: each segment is a whole cubic of the drawing.
                let here = (0_u32..).zip(curve.sources).find(|(_, s)| s.segment == row.segment);
                let Some((segment, _)) = here else { continue };
                let at = CurveParam { segment, t: row.t };
                let Some(p) = curve.point(&at) else { continue };
                let error = medial.lfs(&p) / row.lfs - 1.0;
                (over, under) = (over.max(error), under.max(-error));
                for (side, known) in [Side::Left, Side::Right].into_iter().zip(row.radii) {
                    let found = Foot::normal(&curve, at, side).map(|f| tangent_disk(&curve, &f).radius);
                    // Beyond the diagonal radii are of no use to lfs.
                    if let Some(found) = found.filter(|_| known < *model.diagonal()) {
                        radii = radii.max((found / known - 1.0).abs());
                    }
                }
            }
            writeln!(
                out,
                "| {name} | {tolerance:.0e} | {} | {over:.1e} | {under:.1e} | {radii:.1e} |",
                medial.points().len()
            )?;
        }
    }
    Ok(Some(out))
}
