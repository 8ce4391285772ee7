//! Our refinement beside `spade`'s, and beside what was measured of CGAL:
//! `cargo run --release -p lineart --example refine_race -- DRAWING.svg ...`
//!
//! Each drawing is sampled at ε = 1 with gaps from 0.01 to 0.1 of its diagonal, as the paper does for meshing, and refined at
//! seven longest edges with angles of 20.7° at least; `spade` refines the same lines with the area of an equilateral triangle
//! of that edge. Both from the triangulation of the lines to the last triangle, in turns, the least time of [`TURNS`].
//!
//! CGAL 5.5.1 (without Lloyd's iterations) and `spade` were once measured side by side on other samples of the drawings in
//! [`MEASURED`], in rectangles of another width. What CGAL would need here, in triangles and in time, is what `spade` needs
//! here times their ratio then.

use std::error::Error;
use std::time::Instant;

use feature_sampling::bezier::Cubic;
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::geometry::Point;
use feature_sampling::medial::Resolution;
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::{Condition, SamplingOptions};
use lineart::drawing::load;
use lineart::mesh::drawn::{Drawn, noding, sampled};
use lineart::mesh::{Options, Size, mesh};
use spade::{AngleLimit, ConstrainedDelaunayTriangulation, Point2, RefinementParameters, Triangulation};

/// Timings of each side.
const TURNS: usize = 9;

/// Longest edges, in diagonals of the control points.
const LONGEST: [f64; 7] = [0.1, 0.05, 0.03, 0.02, 0.015, 0.01, 0.003];

/// By drawing and longest edge: triangles and milliseconds of CGAL, triangles and milliseconds of `spade`.
const MEASURED: [(&str, &[[f64; 4]]); 4] = [
    (
        "simple",
        &[
            [352.0, 0.49, 262.0, 0.12],
            [1432.0, 1.44, 1028.0, 0.40],
            [3925.0, 8.10, 2821.0, 0.99],
            [8901.0, 9.26, 6422.0, 2.15],
            [15772.0, 44.33, 11335.0, 3.76],
            [35616.0, 119.39, 25451.0, 8.74],
        ],
    ),
    (
        "complex",
        &[
            [483.0, 0.51, 384.0, 0.15],
            [1488.0, 1.55, 1089.0, 0.41],
            [3970.0, 4.15, 2904.0, 1.05],
            [8934.0, 31.84, 6456.0, 2.15],
            [15797.0, 27.38, 11415.0, 4.09],
            [35918.0, 49.91, 25690.0, 9.01],
            [399_000.0, 3900.0, 283_000.0, 490.0],
        ],
    ),
    (
        "Croco",
        &[
            [2465.0, 1.98, 2562.0, 0.77],
            [2840.0, 2.47, 2741.0, 0.91],
            [4074.0, 4.00, 3591.0, 1.22],
            [7202.0, 7.46, 5677.0, 1.92],
            [11428.0, 20.91, 8801.0, 2.94],
            [24606.0, 38.66, 17997.0, 6.27],
        ],
    ),
    (
        "f2",
        &[
            [1892.0, 1.73, 2006.0, 0.73],
            [2458.0, 2.41, 2346.0, 0.85],
            [4392.0, 4.56, 3643.0, 1.33],
            [8186.0, 8.66, 6412.0, 2.25],
            [13864.0, 53.49, 10411.0, 3.50],
            [29676.0, 138.51, 21684.0, 24.74],
        ],
    ),
];

/// A drawing's lines, and the diagonal of its control points.
fn lines(file: &str) -> Result<(Drawn, f64), Box<dyn Error>> {
    let drawing = load(file)?;
    let paths: Vec<(bool, &[Cubic<f64>])> = drawing.paths.iter().map(|p| (p.closed, p.cubics.as_slice())).collect();
    let curve = CurveModel::new(&paths, &DoorOptions::default())?;
    let medial = MedialModel::new(&curve, &Resolution::Tolerance(0.01));
    let diagonal = *curve.diagonal();
    let options = SamplingOptions {
        condition: Condition::Epsilon(1.0),
        min_distance: Some(0.01 * diagonal),
        max_distance: Some(0.1 * diagonal),
        tolerance: 0.01,
        ..SamplingOptions::default()
    };
    let rows = sampled(&drawing.paths, &curve, &medial, &options)?;
    Ok((Drawn::new(&drawing.paths, &rows, &noding(diagonal, options.min_distance))?, diagonal))
}

/// Triangles of `spade`'s refinement of the same lines and rectangle.
fn by_area(drawn: &Drawn, longest: f64) -> Result<usize, Box<dyn Error>> {
    let (min, max) = (drawn.frame.min, drawn.frame.max);
    let corners = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)];
    let points = drawn.points.iter().chain(&corners).map(|p| Point2::new(p.x, p.y)).collect();
    let first = drawn.points.len();
    let sides = [[0, 1], [1, 2], [2, 3], [3, 0]].map(|side| side.map(|i| first + i));
    let edges = drawn.edges.iter().map(|ends| ends.map(|v| v as usize)).chain(sides).collect();
    let mut conflicts = 0;
    let mut triangulation: ConstrainedDelaunayTriangulation<Point2<f64>> =
        ConstrainedDelaunayTriangulation::try_bulk_load_cdt(points, edges, |_| conflicts += 1)?;
    let done = triangulation.refine(
        RefinementParameters::<f64>::new()
            .with_angle_limit(AngleLimit::from_deg(20.7))
            .with_max_allowed_area(0.75_f64.sqrt() / 2.0 * longest * longest)
            .with_max_additional_vertices(10_000_000),
    );
    if conflicts > 0 || !done.refinement_complete {
        return Err("spade: not refined".into());
    }
    Ok(triangulation.num_inner_faces())
}

fn main() -> Result<(), Box<dyn Error>> {
    let titles = ["drawing", "triangles", "spade", "/ CGAL", "ms", "/ spade", "/ CGAL"];
    let [drawing, triangles, spade, cgal, ms, by_spade, by_cgal] = titles;
    println!("{drawing:16} {triangles:>10} {spade:>8} {cgal:>8} {ms:>10} {by_spade:>8} {by_cgal:>8}");
    for file in std::env::args().skip(1) {
        let (drawn, diagonal) = lines(&file)?;
        let name = file.rsplit('/').next().unwrap_or(&file).trim_end_matches(".svg");
        let known = MEASURED.iter().find(|(known, _)| *known == name).map(|(_, rows)| rows);
        for (row, share) in LONGEST.into_iter().enumerate() {
            let longest = share * diagonal;
            let options = Options { size: Size::Uniform(longest), ..Options::default() };
            let (mut ours, mut theirs) = ((0, f64::INFINITY), (0, f64::INFINITY));
            for _ in 0..TURNS {
                let start = Instant::now();
                let outcome = mesh(&drawn.lines(), &drawn.frame, &options)?;
                ours = (outcome.mesh.triangles.len(), start.elapsed().as_secs_f64().min(ours.1));
                let start = Instant::now();
                theirs.0 = by_area(&drawn, longest)?;
                theirs.1 = start.elapsed().as_secs_f64().min(theirs.1);
            }
            let (more, slower) = (ours.0 as f64 / theirs.0 as f64, ours.1 / theirs.1);
            let cgal = known
                .and_then(|rows| rows.get(row))
                .map_or([f64::NAN; 2], |[count, ms, by_area, spade]| [more / (count / by_area), slower / (ms / spade)]);
            println!(
                "{:16} {:10} {:8} {:8.3} {:10.2} {slower:8.2} {:8.2}",
                format!("{name} {share}"),
                ours.0,
                theirs.0,
                cgal[0],
                ours.1 * 1e3,
                cgal[1]
            );
        }
    }
    Ok(())
}
