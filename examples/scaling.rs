//! How the cost grows with the drawing: 10², 10³, 10⁴ and 10⁵ cubics at 16 steps a cubic, and the exponent that fits.
//!
//! The drawing is a field of closed wavy strokes of eight cubics, one a unit cell with jitter, some of which cross their
//! neighbours. `cargo run --release --example scaling [-- LARGEST]`

use feature_sampling::bezier::Cubic;
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::geometry::Point;
use feature_sampling::medial::Resolution;
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::SamplingOptions;
use std::time::Instant;

/// A field of about `cubics` cubics.
fn field(cubics: u32) -> Vec<Vec<Cubic<f64>>> {
    let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
    let mut random = || {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        f64::from(u32::try_from(seed >> 32).unwrap_or(0)) / f64::from(u32::MAX)
    };
    let strokes = cubics / 8;
    let side = f64::from(strokes).sqrt().ceil();
    (0..strokes)
        .map(|i| {
            let (row, column) = ((f64::from(i) / side).floor(), f64::from(i) % side);
            let centre = (column + 0.2 * random(), row + 0.2 * random());
            let radii: Vec<f64> = (0..8).map(|_| 0.25 + 0.3 * random()).collect();
            let at = |k: usize, radius: f64| {
                let angle = std::f64::consts::TAU * f64::from(u8::try_from(k % 8).unwrap_or(0)) / 8.0;
                (centre.0 + radius * angle.cos(), centre.1 + radius * angle.sin(), angle)
            };
            (0..8)
                .map(|k| {
                    // Tangents across the rays: smooth joints.
                    let (x0, y0, a0) = at(k, radii[k]);
                    let (x1, y1, a1) = at(k + 1, radii[(k + 1) % 8]);
                    let h = 0.26;
                    let (h0, h1) = (h * radii[k], h * radii[(k + 1) % 8]);
                    Cubic::new(
                        Point::new(x0, y0),
                        Point::new(x0 - h0 * a0.sin(), y0 + h0 * a0.cos()),
                        Point::new(x1 + h1 * a1.sin(), y1 - h1 * a1.cos()),
                        Point::new(x1, y1),
                    )
                })
                .collect()
        })
        .collect()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let largest = std::env::args().nth(1).map_or(Ok(100_000), |a| a.parse::<u32>())?;
    println!("| cubics | door, contacts (s) | medial polylines (s) | samples (s) | samples | all (s) |");
    println!("|---|---|---|---|---|---|");
    let mut measured: Vec<(f64, f64)> = Vec::new();
    for cubics in [100, 1000, 10_000, 100_000].into_iter().filter(|&n| n <= largest) {
        let strokes = field(cubics);
        let paths: Vec<(bool, &[Cubic<f64>])> = strokes.iter().map(|s| (true, s.as_slice())).collect();
        let start = Instant::now();
        let model = CurveModel::new(&paths, &DoorOptions::default())?;
        let door = start.elapsed().as_secs_f64();
        let medial = MedialModel::new(&model, &Resolution::Steps(16));
        let walked = start.elapsed().as_secs_f64();
        let samples = model.sample(&medial, &SamplingOptions::default())?;
        let all = start.elapsed().as_secs_f64();
        println!(
            "| {} | {door:.3} | {:.3} | {:.3} | {} | {all:.3} |",
            model.curve().segments.len(),
            walked - door,
            all - walked,
            samples.len()
        );
        measured.push((f64::from(cubics).ln(), all.ln()));
    }
    if let (Some(first), Some(last)) = (measured.first(), measured.last())
        && last.0 > first.0
    {
        let count = f64::from(u32::try_from(measured.len())?);
        let mean = |f: fn(&(f64, f64)) -> f64| measured.iter().map(f).sum::<f64>() / count;
        let (mx, my) = (mean(|p| p.0), mean(|p| p.1));
        let covariance: f64 = measured.iter().map(|p| (p.0 - mx) * (p.1 - my)).sum();
        let variance: f64 = measured.iter().map(|p| (p.0 - mx).powi(2)).sum();
        println!("\nLeast squares: the cost grows like n^{:.3}.", covariance / variance);
    }
    Ok(())
}
