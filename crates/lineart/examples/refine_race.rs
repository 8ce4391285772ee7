//! Our refinement beside `spade`'s and CGAL's:
//! `cargo run --release -p lineart --example refine_race -- [--cgal PROGRAM] DRAWING.svg ...`
//!
//! Each drawing is sampled at ε = 1 with gaps from 0.01 to 0.1 of its diagonal, as the paper does for meshing, and refined at
//! seven longest edges with angles of 20.7° at least. CGAL (without Lloyd's iterations) gets the same lines and bounds, by
//! PROGRAM, which is `cgal_refine.cpp` beside this file, compiled; `spade` the same lines and the area of an equilateral
//! triangle of that edge, for it has no bound on lengths. All from the lines to the last triangle, in turns, the least time
//! of [`TURNS`].

use std::error::Error;
use std::fmt::Write as _;
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdout, Command, Stdio};
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

/// Points and lines of a drawing and of the rectangle around it.
fn with_frame(drawn: &Drawn) -> (Vec<Point<f64>>, Vec<[usize; 2]>) {
    let (min, max) = (drawn.frame.min, drawn.frame.max);
    let corners = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)];
    let first = drawn.points.len();
    let sides = [[0, 1], [1, 2], [2, 3], [3, 0]].map(|side| side.map(|i| first + i));
    let points = drawn.points.iter().copied().chain(corners).collect();
    (points, drawn.edges.iter().map(|ends| ends.map(|v| v as usize)).chain(sides).collect())
}

/// Triangles of `spade`'s refinement of the same lines and rectangle.
fn by_area(drawn: &Drawn, longest: f64) -> Result<usize, Box<dyn Error>> {
    let (points, edges) = with_frame(drawn);
    let points = points.into_iter().map(|p| Point2::new(p.x, p.y)).collect();
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

/// The compiled `cgal_refine.cpp`, waiting for work.
struct Cgal {
    process: Child,
    answers: BufReader<ChildStdout>,
}

impl Cgal {
    fn start(program: &str) -> Result<Self, Box<dyn Error>> {
        let spawned = Command::new(program).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut process = spawned.map_err(|why| format!("{program}: {why}"))?;
        let answers = BufReader::new(process.stdout.take().ok_or("no pipe")?);
        Ok(Self { process, answers })
    }

    /// Triangles and seconds.
    fn refine(&mut self, drawn: &Drawn, longest: f64) -> Result<(usize, f64), Box<dyn Error>> {
        let (points, edges) = with_frame(drawn);
        let mut text = format!("{} {} {longest}\n", points.len(), edges.len());
        for p in points {
            writeln!(text, "{} {}", p.x, p.y)?;
        }
        for [from, to] in edges {
            writeln!(text, "{from} {to}")?;
        }
        self.process.stdin.as_mut().ok_or("no pipe")?.write_all(text.as_bytes())?;
        let mut answer = String::new();
        self.answers.read_line(&mut answer)?;
        let (count, seconds) = answer.trim().split_once(' ').ok_or("CGAL: no answer")?;
        Ok((count.parse()?, seconds.parse()?))
    }
}

impl Drop for Cgal {
    fn drop(&mut self) {
        // It ends with its input.
        drop(self.process.stdin.take());
        let _ = self.process.wait();
    }
}

/// Triangles and the least time of several runs.
#[derive(Clone, Copy)]
struct Best {
    triangles: usize,
    seconds: f64,
}

impl Best {
    const NONE: Self = Self { triangles: 0, seconds: f64::INFINITY };

    fn note(&mut self, triangles: usize, seconds: f64) {
        *self = Self { triangles, seconds: seconds.min(self.seconds) };
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut files: Vec<String> = std::env::args().skip(1).collect();
    let mut cgal = match files.iter().position(|word| word == "--cgal") {
        Some(at) if at + 1 < files.len() => {
            Some(Cgal::start(&files.drain(at..at + 2).next_back().ok_or("no program")?)?)
        }
        _ => None,
    };
    let titles = ["drawing", "triangles", "spade", "CGAL", "/ CGAL", "ms", "/ spade", "/ CGAL"];
    let [drawing, triangles, spade, by_cgal, more, ms, slower, than_cgal] = titles;
    println!("{drawing:16} {triangles:>10} {spade:>8} {by_cgal:>8} {more:>8} {ms:>10} {slower:>8} {than_cgal:>8}");
    for file in files {
        let (drawn, diagonal) = lines(&file)?;
        let name = file.rsplit('/').next().unwrap_or(&file).trim_end_matches(".svg");
        for share in LONGEST {
            let longest = share * diagonal;
            let options = Options { size: Size::Uniform(longest), ..Options::default() };
            let (mut ours, mut areas, mut theirs) = (Best::NONE, Best::NONE, Best::NONE);
            for _ in 0..TURNS {
                let start = Instant::now();
                let outcome = mesh(&drawn.lines(), &drawn.frame, &options)?;
                ours.note(outcome.mesh.triangles.len(), start.elapsed().as_secs_f64());
                let start = Instant::now();
                let count = by_area(&drawn, longest)?;
                areas.note(count, start.elapsed().as_secs_f64());
                if let Some(cgal) = &mut cgal {
                    let (count, seconds) = cgal.refine(&drawn, longest)?;
                    theirs.note(count, seconds);
                }
            }
            let by_cgal = cgal.as_ref().map_or([f64::NAN; 2], |_| {
                [ours.triangles as f64 / theirs.triangles as f64, ours.seconds / theirs.seconds]
            });
            println!(
                "{:16} {:10} {:8} {:8} {:8.3} {:10.2} {:8.2} {:8.2}",
                format!("{name} {share}"),
                ours.triangles,
                areas.triangles,
                theirs.triangles,
                by_cgal[0],
                ours.seconds * 1e3,
                ours.seconds / areas.seconds,
                by_cgal[1]
            );
        }
    }
    Ok(())
}
