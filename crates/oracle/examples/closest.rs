//! Closest points and their quintics: `cargo run --release -p fsample-oracle --example closest -- [queries] [seed]`.
#![allow(clippy::print_stdout, reason = "a report")]

use fsample_oracle::queries::Class;
use fsample_oracle::survey;

fn main() {
    let mut arguments = std::env::args().skip(1);
    let count: usize = arguments.next().and_then(|a| a.parse().ok()).unwrap_or(1_000_000);
    let seed: u64 = arguments.next().and_then(|a| a.parse().ok()).unwrap_or(1);
    println!("{count} queries in three classes, seed {seed}");
    println!("class   queries  checked  wrong   worst excess  miscounted  ambiguous  faults");
    let mut clean = true;
    for (i, class) in Class::ALL.into_iter().enumerate() {
        let share = count / 3 + usize::from(i < count % 3);
        let s = survey::closest(class, share, seed);
        clean &= s.wrong + s.faults == 0;
        println!(
            "c{i:<5} {:>8} {:>8} {:>6} {:>14.2e} {:>11} {:>10} {:>7}",
            s.queries, s.checked, s.wrong, s.excess, s.miscounted, s.ambiguous, s.faults
        );
        for example in &s.examples {
            println!("    {example}");
        }
    }
    println!("{}", if clean { "no wrong answer" } else { "there are wrong answers" });
    std::process::exit(i32::from(!clean));
}
