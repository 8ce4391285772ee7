//! `check DRAWING.cubics.csv SAMPLES.csv --epsilon E [--min-distance D] [--tolerance T] [--corner-angle DEG]`
//!
//! Prints the judgement on standard output, one `name: value` per line. Exit codes: 0 no violation, 1 violations, 2 bad
//! usage, 3 bad input.

use fsample_checker::{Checker, DoorOptions, Options, RawPath, Report, Sample, table};
use std::process::ExitCode;

const USAGE: &str =
    "usage: check DRAWING.cubics.csv SAMPLES.csv --epsilon E [--min-distance D] [--tolerance T] [--corner-angle DEG]";

struct Job {
    files: Vec<String>,
    epsilon: f64,
    options: Options,
    door: DoorOptions,
}

fn arguments() -> Result<Job, String> {
    let mut job =
        Job { files: Vec::new(), epsilon: f64::NAN, options: Options::default(), door: DoorOptions::default() };
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        if !word.starts_with("--") {
            job.files.push(word);
            continue;
        }
        let value = words.next().and_then(|v| v.parse::<f64>().ok()).ok_or(format!("{word} wants a number"))?;
        match word.as_str() {
            "--epsilon" => job.epsilon = value,
            "--min-distance" => job.options.min_distance = Some(value),
            "--tolerance" => job.options.tolerance = value,
            "--corner-angle" => job.door.corner_angle = value,
            _ => return Err(format!("unknown option {word}")),
        }
    }
    if job.files.len() != 2 || job.epsilon.is_nan() || job.epsilon <= 0.0 {
        return Err(USAGE.into());
    }
    Ok(job)
}

fn load(job: &Job) -> Result<(Vec<RawPath>, Vec<Sample>), String> {
    let read = |name: &String| std::fs::read_to_string(name).map_err(|e| format!("{name}: {e}"));
    let (drawing, samples) = (&job.files[0], &job.files[1]);
    let paths = table::drawing(&read(drawing)?).map_err(|e| format!("{drawing}: {e}"))?;
    let list = table::samples(&read(samples)?).map_err(|e| format!("{samples}: {e}"))?;
    for s in &list {
        let known = paths.get(s.path).is_some_and(|p| s.segment <= p.cubics.len());
        if !known {
            return Err(format!("{samples}: the drawing has no path {}, segment {}", s.path, s.segment));
        }
    }
    Ok((paths, list))
}

fn print(report: &Report) {
    println!("violations: {}", report.violations.len());
    for v in &report.violations {
        let rule = if v.floored { "floor" } else { "epsilon" };
        println!(
            "  path {} segment {} t {} at ({}, {}): {} of what {rule} allows",
            v.path, v.segment, v.t, v.point.x, v.point.y, v.ratio
        );
    }
    println!("effective epsilon: {}", report.effective_epsilon);
    if let Some(p) = report.worst {
        println!("  at ({}, {})", p.x, p.y);
    }
    println!("share of length under a floor: {}", report.share_under_floor);
    println!("tolerance: {}", report.tolerance_used);
    println!("largest chord error: {}", report.max_chord_error);
    println!("missing Delaunay edges: {}", report.missing_edges.len());
    println!("gaps: {} to {}", report.gaps.0, report.gaps.1);
    println!("grading: {}", report.grading);
    println!("samples off the curve by at most: {}", report.off_curve);
}

fn main() -> ExitCode {
    let job = match arguments() {
        Ok(job) => job,
        Err(message) => {
            eprintln!("{message}");
            return ExitCode::from(2);
        }
    };
    match load(&job) {
        Ok((paths, samples)) => {
            let report = Checker::with_options(&paths, &job.door).check(&samples, job.epsilon, job.options);
            print(&report);
            ExitCode::from(u8::from(!report.violations.is_empty()))
        }
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(3)
        }
    }
}
