//! How long colouring again takes after a hint has changed: `cargo run --release -p lineart --example recolour`
//!
//! 256 wavy strokes with 10 240 samples, and 16 hints of which one comes and goes. Prints the median of 21 runs.

use std::time::Instant;

use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::Point;
use lineart::colour::{Hint, Options, Plane};
use lineart::drawing::DrawingPath;
use lineart::node::{Chain, Options as NodeOptions};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut paths = Vec::new();
    for i in 0..16 {
        for j in 0..16 {
            let (x, y) = (f64::from(i), f64::from(j));
            let p = |dx: f64, dy: f64| Point::new(x + dx, y + dy);
            let cubic = Cubic::new(p(0.05, 0.1), p(1.4, 0.3), p(-0.4, 0.6), p(0.95, 0.9));
            paths.push(DrawingPath { cubics: vec![cubic], ..DrawingPath::default() });
        }
    }
    let at: Vec<f64> = (0..40).map(|i| f64::from(i) / 39.0).collect();
    let chains: Vec<Chain> = (0..paths.len()).map(|path| Chain { path, closed: false, at: at.clone() }).collect();
    let start = Instant::now();
    let plane = Plane::new(&paths, &chains, &NodeOptions::for_drawing(23.0, None))?;
    println!("{} samples, plane made in {:.2} ms", 40 * paths.len(), start.elapsed().as_secs_f64() * 1e3);
    let hint =
        |i: u32| Hint::at(Point::new(f64::from(i) + 0.5, 15.5 - f64::from(i)), ["red", "blue", "gold"][i as usize % 3]);
    let hints: Vec<Hint> = (0..16).filter_map(hint).collect();
    let mut times: Vec<f64> = (0..21)
        .map(|run| {
            let start = Instant::now();
            let labels = plane.label(&hints[run % 2..], &Options::default());
            let time = start.elapsed().as_secs_f64() * 1e3;
            std::hint::black_box(labels);
            time
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("coloured again in {:.2} ms (median of {})", times[10], times.len());
    Ok(())
}
