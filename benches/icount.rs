//! Instructions of the hot five: roots in [0, 1], all real roots, closest point, tangent disk, lfs look-up.
//!
//! Times depend on the machine and on who else is using it; instructions hardly do. `cargo bench --bench icount` runs this
//! program under `valgrind --tool=cachegrind`, once and five times through each set of inputs; a quarter of the difference,
//! shared among the calls, is what one call takes, without start and set-up. Where valgrind is missing it says so. Under
//! `cargo test` each set is run through once.

mod queries;

use feature_sampling::bezier::nearest::{distance_quintic, nearest};
use feature_sampling::bezier::{Cubic, PowerBasis};
use feature_sampling::curve::CurveParam;
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::geometry::Point;
use feature_sampling::medial::{Foot, Resolution, Side, tangent_disk};
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::polynomial::Polynomial;
use std::hint::black_box;
use std::path::Path;
use std::process::Command;

/// Names of the jobs.
const JOBS: [&str; 11] = [
    "roots_in_unit c0",
    "roots_in_unit c1",
    "roots_in_unit c2",
    "real_roots c0",
    "real_roots c1",
    "real_roots c2",
    "nearest c0",
    "nearest c1",
    "nearest c2",
    "tangent_disk",
    "lfs",
];

/// Runs through the inputs of a job so many times; answers the number of calls in one of them.
fn run(job: &str, rounds: u32) -> usize {
    let (function, class) = job.split_once(" c").unwrap_or((job, "0"));
    let class = class.parse().unwrap_or(0);
    match function {
        "tangent_disk" | "lfs" => drawing(function, rounds),
        "nearest" => {
            let list: Vec<(PowerBasis<f64>, Point<f64>)> =
                queries::class(class, 1024).into_iter().map(|(b, q)| (b.power_basis(), q)).collect();
            repeat(&list, rounds, |(b, q)| nearest(b, q).distance_sq)
        }
        _ => {
            let list: Vec<Polynomial<f64, 6>> =
                queries::class(class, 1024).iter().map(|(b, q)| distance_quintic(&b.power_basis(), q)).collect();
            if function == "real_roots" {
                repeat(&list, rounds, |p| p.real_roots().map_or(0, |r| r.len()))
            } else {
                repeat(&list, rounds, |p| p.roots_in_unit().map_or(0, |r| r.len()))
            }
        }
    }
}

/// 1000 feet on a shipped drawing.
fn drawing(function: &str, rounds: u32) -> usize {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("drawings/celtic_triskell_01.svg");
    let Ok(drawing) = lineart::svg::read_file(&file) else { return 0 };
    let paths: Vec<(bool, &[Cubic<f64>])> = drawing.paths.iter().map(|p| (p.closed, p.cubics.as_slice())).collect();
    let Ok(model) = CurveModel::new(&paths, &DoorOptions::default()) else { return 0 };
    let curve = model.curve();
    let count = u32::try_from(curve.segments.len()).unwrap_or(1);
    let feet: Vec<Foot<f64>> = (0..1000_u32)
        .filter_map(|i| {
            let at = CurveParam { segment: (i * count) / 1000, t: f64::from(i * count % 1000) / 1000.0 };
            Foot::normal(&curve, at, Side::Left)
        })
        .collect();
    if function == "tangent_disk" {
        return repeat(&feet, rounds, |foot| tangent_disk(&curve, foot).radius);
    }
    let medial = MedialModel::new(&model, &Resolution::Steps(50));
    repeat(&feet, rounds, |foot| medial.lfs(&foot.point))
}

fn repeat<T, R>(list: &[T], rounds: u32, f: impl Fn(&T) -> R) -> usize {
    for _ in 0..rounds {
        for item in list {
            black_box(f(black_box(item)));
        }
    }
    list.len()
}

/// Instructions that this program takes for a job, by cachegrind.
fn instructions(job: &str, rounds: u32) -> Option<u64> {
    let output = Command::new("valgrind")
        .args(["--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"])
        .arg(std::env::current_exe().ok()?)
        .args(["--job", job, &rounds.to_string()])
        .output()
        .ok()?;
    let report = String::from_utf8_lossy(&output.stderr);
    let line = report.lines().find(|line| line.contains("I refs:") || line.contains("I   refs:"))?;
    let digits: String = line.rsplit(':').next()?.chars().filter(char::is_ascii_digit).collect();
    digits.parse().ok()
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [flag, job, rounds] = arguments.as_slice()
        && flag == "--job"
    {
        run(job, rounds.parse().unwrap_or(1));
        return;
    }
    if !arguments.iter().any(|argument| argument == "--bench") {
        // `cargo test`: once each
        for job in JOBS {
            assert!(run(job, 1) > 0, "{job} has inputs");
        }
        return;
    }
    println!("{:20} {:>20}", "", "instructions per call");
    for job in JOBS {
        let calls = u64::try_from(run(job, 0)).unwrap_or(1).max(1);
        match (instructions(job, 1), instructions(job, 5)) {
            (Some(once), Some(five)) => println!("{job:20} {:>20}", five.saturating_sub(once) / (4 * calls)),
            _ => {
                eprintln!("valgrind is missing or counted nothing for {job}");
                std::process::exit(1);
            }
        }
    }
}
