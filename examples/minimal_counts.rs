//! How few samples would do, by other means than the sampler's: on a grid.
//!
//! `cargo run --release --example minimal_counts -- DRAWING.svg ...` (one closed path each, no corners) prints, for each ε, the
//! sampler's count and the least number of grid points that are an ε-sample of the grid points, over starts throughout the
//! first gap, for finer and finer grids. A grid lets a gap grow by up to a step, so its minimum is at most that of the curve,
//! and it rises to it as the grid is refined. It knows lfs and nothing else of the sampler.

use feature_sampling::bezier::Cubic;
use feature_sampling::curve::CurveParam;
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::geometry::Point;
use feature_sampling::medial::Resolution;
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::{Condition, SamplingOptions};

const GRIDS: [i32; 5] = [250, 500, 1000, 2000, 4000];
const TOLERANCE: f64 = 1e-5;
/// Starts that are tried in the first gap.
const STARTS: usize = 40;

/// Points once around a path, with ε·lfs.
struct Grid(Vec<(Point<f64>, f64)>);

impl Grid {
    fn at(&self, i: usize) -> &(Point<f64>, f64) {
        &self.0[i % self.0.len()]
    }

    /// Whether the grid point s serves the grid point p.
    fn serves(&self, s: usize, p: usize) -> bool {
        let (point, reach) = self.at(p);
        point.distance(&self.at(s).0) < *reach
    }

    /// The farthest sample after i such that each point between is served by one of the two.
    fn next(&self, i: usize) -> usize {
        let end = i + self.0.len();
        let Some(unserved) = (i + 1..end).find(|&p| !self.serves(i, p)) else { return end };
        // The first unserved point serves itself; from there as far as it goes.
        let spanned = |j: &usize| (unserved..=*j).all(|p| self.serves(*j, p));
        (unserved..=end).take_while(spanned).last().unwrap_or(unserved)
    }

    fn least(&self) -> usize {
        let first = self.next(0);
        let starts = (0..=first).step_by((first / STARTS).max(1));
        let count = |start: usize| {
            let (mut i, mut n) = (start, 0);
            while i < start + self.0.len() {
                i = self.next(i);
                n += 1;
            }
            n
        };
        starts.map(count).min().unwrap_or_default()
    }
}

fn main() {
    let grids: Vec<String> = GRIDS.iter().map(|g| format!("grid {g}")).collect();
    println!("| drawing | ε | sampler | {} |", grids.join(" | "));
    println!("|---|---|---|{}", "---|".repeat(GRIDS.len()));
    for file in std::env::args().skip(1) {
        let drawing = match lineart::drawing::load(&file) {
            Ok(drawing) => drawing,
            Err(error) => {
                eprintln!("minimal_counts: {error}");
                std::process::exit(3);
            }
        };
        let paths: Vec<(bool, &[Cubic<f64>])> = drawing.paths.iter().map(|p| (p.closed, p.cubics.as_slice())).collect();
        let model = CurveModel::new(&paths, &DoorOptions::default()).expect("a drawing");
        let medial = MedialModel::new(&model, &Resolution::Tolerance(TOLERANCE));
        let curve = model.curve();
        let name = std::path::Path::new(&file).file_stem().map_or(file.clone().into(), |s| s.to_string_lossy());
        for epsilon in [0.3, 0.5, 0.66, 1.0] {
            let options = SamplingOptions {
                condition: Condition::Epsilon(epsilon),
                tolerance: TOLERANCE,
                ..SamplingOptions::default()
            };
            let samples = model.sample(&medial, &options).expect("samples").len();
            let least = GRIDS.map(|g| {
                let places = (0_u32..).zip(curve.segments).flat_map(|(segment, _)| {
                    (0..g).map(move |k| CurveParam { segment, t: f64::from(k) / f64::from(g) })
                });
                let reach = |at| curve.point(&at).map(|p| (p, epsilon * medial.lfs(&p)));
                Grid(places.filter_map(reach).collect()).least().to_string()
            });
            println!("| {name} | {epsilon} | {samples} | {} |", least.join(" | "));
        }
    }
}
