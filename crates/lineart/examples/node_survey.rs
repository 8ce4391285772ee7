//! Nodes random stroke sets of five kinds and has each result judged:
//! `cargo run --release -p lineart --example node_survey -- [SETS] [FIRST SEED]`
//!
//! Prints a line for each kind, with the worst of what was measured, and every failure with its seed. 100 000 sets is the
//! figure of the acceptance test and the default; `tests/node.rs` runs a few of them.

use std::error::Error;

#[path = "../tests/common/strokes.rs"]
mod strokes;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse::<u64>());
    let (sets, first) = (number(100_000)?, number(0)?);
    let kinds = strokes::KINDS.len() as u64;
    let mut failures = 0;
    for (kind, name) in strokes::KINDS.iter().enumerate() {
        let (mut edges, mut rounds, mut most, mut finer) = (0, 0, 0, 0);
        let (mut displacement, mut off_curve) = (0.0_f64, 0.0_f64);
        let count = sets.div_ceil(kinds);
        for seed in first..first + count {
            match strokes::examine(kind, seed) {
                Ok(verdict) => {
                    edges += verdict.edges;
                    most = most.max(verdict.edges);
                    rounds = rounds.max(verdict.rounds);
                    finer += usize::from(verdict.units > 5.0);
                    displacement = displacement.max(verdict.displacement);
                    off_curve = off_curve.max(verdict.off_curve);
                }
                Err(cause) => {
                    failures += 1;
                    println!("{name}, seed {seed}: {cause}");
                }
            }
        }
        println!(
            "{name}: {count} sets, {edges} edges (at most {most}), at most {rounds} rounds, {finer} on a finer lattice, moved by at \
             most {displacement:.3} pitches, off the curve by at most {off_curve:.3}"
        );
    }
    if failures > 0 { Err(format!("{failures} failures").into()) } else { Ok(()) }
}
