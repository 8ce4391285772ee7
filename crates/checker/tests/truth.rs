//! Comparison with data that does not ship: published truth values of lfs, and the samples of another program, which
//! must fail by a known amount. Skips, saying so, where the data folder (`FSAMPLE_DATA`) is absent.

mod common;

use fsample_checker::plane::v2;
use fsample_checker::{Checker, DoorOptions, Options, RawPath, Sample};
use std::path::PathBuf;

/// The text of a data file, or a message and nothing.
fn data(name: &str) -> Option<String> {
    let default = || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let folder = std::env::var_os("FSAMPLE_DATA").map_or_else(default, PathBuf::from);
    let text = std::fs::read_to_string(folder.join(name)).ok();
    if text.is_none() {
        println!("skipped: no {name} (set FSAMPLE_DATA to the data folder)");
    }
    text
}

fn drawing(name: &str) -> Option<Vec<RawPath>> {
    data(&format!("drawings/{name}.svg")).map(|text| common::svg(&text))
}

fn numbers(row: &str, separator: char) -> Vec<f64> {
    row.split(separator).map(|x| x.parse().unwrap()).collect()
}

/// lfs, and both radii where they are not huge, at 400 parameters of each smooth drawing.
#[test]
fn lfs_and_radii_agree_with_the_truth() {
    // The truth rounds to 12 digits and calls joints smooth below 0.002 rad.
    let door = DoorOptions { corner_angle: 0.002_f64.to_degrees() };
    for name in ["simple", "blob2", "complex", "spiral"] {
        let (Some(paths), Some(truth)) = (drawing(name), data(&format!("truth/{name}.csv"))) else { continue };
        let checker = Checker::with_options(&paths, &door);
        let (mut worst, mut worst_radius) = (0.0_f64, 0.0_f64);
        for row in truth.lines().skip(1) {
            let v = numbers(row, ',');
            let segment = (0..=paths[0].cubics.len()).find(|&i| f64::from(u32::try_from(i).unwrap()) == v[0]).unwrap();
            assert!(checker.point(0, segment, v[1]).distance(v2(v[2], v[3])) < 1e-9);
            worst = worst.max((checker.lfs(0, segment, v[1]) / v[4] - 1.0).abs());
            for (truth, left) in [(v[8], true), (v[9], false)] {
                let mine = checker.radius(0, segment, v[1], left);
                if truth < 1e3 * checker.diagonal() {
                    worst_radius = worst_radius.max((mine / truth - 1.0).abs());
                } else {
                    assert!(mine > 900.0 * checker.diagonal(), "{name}: {mine} for {truth}");
                }
            }
        }
        println!("{name}: lfs within {worst:.1e}, radii within {worst_radius:.1e}");
        assert!(worst < 1e-10, "{name}: lfs off by {worst:e}");
        assert!(worst_radius < 1e-7, "{name}: radius off by {worst_radius:e}");
    }
}

/// Samples that were asked to be 0.5-samples and are not: the checker must find by how much.
#[test]
fn foreign_samples_fail_by_the_known_amount() {
    let table = [
        ("simple", 0.5),
        ("blob2", 0.5005),
        ("complex", 0.510),
        ("spiral", 0.5001),
        ("f1", 0.630),
        ("f4", 0.637),
        ("f6", 0.562),
        ("Frog2", 1.0),
        ("Croco", 0.710),
    ];
    for (name, expected) in table {
        let (Some(paths), Some(rows)) = (drawing(name), data(&format!("prototype-samples/{name}.xy"))) else {
            continue;
        };
        let checker = Checker::new(&paths);
        let samples: Vec<Sample> = rows
            .lines()
            .map(|row| {
                let v = numbers(row, ' ');
                let path = (0..paths.len()).find(|&i| f64::from(u32::try_from(i).unwrap()) == v[0]).unwrap();
                let point = v2(v[1], v[2]);
                let (segment, t, _) = checker.project(path, point).unwrap();
                Sample { path, segment, t, point }
            })
            .collect();
        // The figures leave out "1 % of the diagonal" around ends, crossings and corners of drawings of several paths.
        // A radius of 1.4 % reproduces all of them to three digits, 1 % only those of f1 and f4: the exclusion was
        // evidently not quite a disc of that radius.
        let leave_out = if paths.len() > 1 { 0.014 } else { 0.0 };
        let report = checker.check(&samples, 0.5, Options { leave_out, ..Options::default() });
        println!(
            "{name}: {} samples, effective epsilon {:.4} for {expected}; {} gaps fail, {:.1} % under a floor",
            samples.len(),
            report.effective_epsilon,
            report.violations.len(),
            100.0 * report.share_under_floor
        );
        assert!((report.effective_epsilon - expected).abs() < 0.01, "{name}: {}", report.effective_epsilon);
        assert!(!report.violations.is_empty());
    }
}
