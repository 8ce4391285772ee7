//! Meshes random stroke sets of five kinds (crossings, T-junctions, copies, displaced copies, corners on a coarse lattice) and
//! has each mesh judged:
//! `cargo run --release -p lineart --example mesh_survey -- [SETS OF EACH KIND] [FIRST SEED] [KIND]`
//!
//! Prints a line for each kind and every failure with its seed; a set that takes more than two seconds is one. 2000 sets of
//! each kind is the figure of the acceptance test and the default; `tests/mesh.rs` runs a few of them. Kinds count from 0, in
//! the order above; without one all of them come.

use std::error::Error;

#[path = "../tests/common/meshes.rs"]
mod meshes;
#[path = "../tests/common/soup.rs"]
mod soup;
#[expect(dead_code, reason = "the judge of noding stays unused here")]
#[path = "../tests/common/strokes.rs"]
mod strokes;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse::<u64>());
    let (sets, first, only) = (number(2000)?, number(0)?, number(u64::MAX)?);
    let mut failures = 0;
    for (kind, name) in strokes::KINDS.iter().enumerate() {
        if only < strokes::KINDS.len() as u64 && only != kind as u64 {
            continue;
        }
        let (mut triangles, mut most, mut longest) = (0, 0, 0.0_f64);
        for seed in first..first + sets {
            let verdict = soup::examine(kind, seed).and_then(|(count, seconds)| {
                longest = longest.max(seconds);
                if seconds > 2.0 { Err(format!("{count} triangles took {seconds:.1} s")) } else { Ok(count) }
            });
            match verdict {
                Ok(count) => {
                    triangles += count;
                    most = most.max(count);
                }
                Err(cause) => {
                    failures += 1;
                    println!("{name}, seed {seed}: {cause}");
                }
            }
        }
        println!("{name}: {sets} sets, {triangles} triangles (at most {most}), at most {longest:.2} s");
    }
    if failures > 0 { Err(format!("{failures} failures").into()) } else { Ok(()) }
}
