//! Are the samples of a drawing a true ε-sample? Judged by `crates/checker`, which shares no code with the kernel.
//!
//! `cargo run --release --example true_samples -- DRAWING.svg ...` prints a row for each drawing and each ε: the samples at
//! the default tolerance, gaps that fail, the largest |p − s|/lfs(p) where no floor decides, the share of the curve's length
//! on which a floor does, and edges between neighbours that the Delaunay triangulation of all samples does not have.
//! Exit code 1 if any gap fails.

use feature_sampling::bezier::Cubic;
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::medial::Resolution;
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::{Condition, SamplingOptions};
use fsample_checker::{Checker, Options, RawPath, Sample, V2};

const TOLERANCE: f64 = 1e-3;

fn main() {
    let mut failed = 0;
    println!("| drawing | cubics | ε | samples | failing gaps | effective ε | under a floor | missing edges |");
    println!("|---|---|---|---|---|---|---|---|");
    for file in std::env::args().skip(1) {
        let drawing = match lineart::drawing::load(&file) {
            Ok(drawing) => drawing,
            Err(error) => {
                eprintln!("true_samples: {error}");
                std::process::exit(3);
            }
        };
        let paths: Vec<(bool, &[Cubic<f64>])> = drawing.paths.iter().map(|p| (p.closed, p.cubics.as_slice())).collect();
        let raw: Vec<RawPath> = paths
            .iter()
            .map(|(closed, cubics)| RawPath {
                closed: *closed,
                cubics: cubics.iter().map(|c| c.points.map(|p| [p.x, p.y])).collect(),
            })
            .collect();
        let model = CurveModel::new(&paths, &DoorOptions::default()).expect("a drawing");
        let medial = MedialModel::new(&model, &Resolution::Tolerance(TOLERANCE));
        let checker = Checker::new(&raw);
        let name = std::path::Path::new(&file).file_stem().map_or(file.clone().into(), |s| s.to_string_lossy());
        let cubics: usize = raw.iter().map(|p| p.cubics.len()).sum();
        for epsilon in [0.3, 0.5, 0.66, 1.0] {
            let options = SamplingOptions {
                condition: Condition::Epsilon(epsilon),
                tolerance: TOLERANCE,
                ..SamplingOptions::default()
            };
            let samples = model.sample(&medial, &options).expect("samples");
            let claimed: Vec<Sample> = samples
                .iter()
                .map(|s| {
                    let (path, segment, t) = model.source(&s.at);
                    let point = V2 { x: s.point.x, y: s.point.y };
                    Sample { path: path as usize, segment: segment as usize, t, point }
                })
                .collect();
            let report = checker.check(&claimed, epsilon, Options::default());
            failed += report.violations.len();
            println!(
                "| {name} | {cubics} | {epsilon} | {} | {} | {:.4} | {:.1} % | {} |",
                samples.len(),
                report.violations.len(),
                report.effective_epsilon,
                100.0 * report.share_under_floor,
                report.missing_edges.len()
            );
        }
    }
    std::process::exit(i32::from(failed > 0));
}
