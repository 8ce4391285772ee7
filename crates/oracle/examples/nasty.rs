//! The nasty set: `cargo run --release -p fsample-oracle --example nasty -- [cases per class] [seed]`.
#![allow(clippy::print_stdout, reason = "a report")]

use fsample_oracle::nasty::Class;
use fsample_oracle::survey;

fn main() {
    let mut arguments = std::env::args().skip(1);
    let count: usize = arguments.next().and_then(|a| a.parse().ok()).unwrap_or(10_000);
    let seed: u64 = arguments.next().and_then(|a| a.parse().ok()).unwrap_or(1);
    println!(
        "{count} polynomials per class, seed {seed}; each asked for [0, 1], a random interval, and all of the line"
    );
    println!("{}", survey::units());
    println!(
        "{:28} {:>8} {:>7} {:>6} {:>6} {:>6} {:>6} {:>6} {:>7} {:>7} {:>7} {:>7} {:>8} {:>8} {:>7} {:>7}",
        "class",
        "roots",
        "at end",
        "missed",
        "at end",
        "ghosts",
        "counts",
        "off",
        "planted",
        "error",
        "width",
        "cluster",
        "brackets",
        "proved",
        "refuted",
        "outside"
    );
    let mut clean = true;
    for class in Class::ALL {
        let s = survey::roots(class, count, seed);
        clean &= s.is_clean();
        println!(
            "{class:28} {:>8} {:>7} {:>6} {:>6} {:>6} {:>6} {:>6} {:>7} {:>7.2} {:>7.1} {:>7.1} {:>8} {:>8} {:>7} {:>7}",
            s.roots,
            s.at_ends,
            s.missed,
            s.missed_at_ends,
            s.ghosts,
            s.miscounts,
            s.inaccurate,
            s.planted_missed,
            s.quality.error,
            s.quality.simple_width,
            s.quality.cluster_width,
            s.certified,
            s.proved,
            s.refuted,
            s.outside
        );
        for example in &s.examples {
            println!("    {example}");
        }
    }
    println!("{}", if clean { "nothing missed, no ghosts" } else { "there are faults" });
    std::process::exit(i32::from(!clean));
}
