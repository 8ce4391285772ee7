//! lfs and tangent disks against two judges: published truth values, and the checker's brute force.
//!
//! The truth tables (lfs and both radii at 400 parameters of four drawings, good to about 1e-9) do not ship: that part
//! skips where the data folder is absent (`FSAMPLE_DATA`). Disks are compared on the drawings that ship, at random places
//! and next to joints, where the two one-sided curvatures and the far branches meet.

use crate::common::{Model, Random, Stroke, curve_model, data, doors, load, raw, shipped, stem, svg_files};
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::medial::{Foot, Side, tangent_disk};
use feature_sampling::model::CurveModel;
use fsample_checker::Checker;

/// The kernel's radius at a raw cubic's parameter.
fn radius(model: &CurveModel<f64>, path: usize, cubic: usize, t: f64, left: bool) -> Option<f64> {
    disk(model, path, cubic, t, left).map(|(radius, _)| radius)
}

/// The same with its relative error where another segment bounds the disk: the quotient |q−f|² / (2 d·(q−f)) of plain
/// differences, whose denominator is known to the noise of two coordinates.
fn disk(model: &CurveModel<f64>, path: usize, cubic: usize, t: f64, left: bool) -> Option<(f64, f64)> {
    let curve = model.curve();
    let at = crate::common::place(model, path, cubic, t)?;
    let side = if left { Side::Left } else { Side::Right };
    let foot = Foot::normal(&curve, at, side)?;
    let found = tangent_disk(&curve, &foot);
    let other = found.touch.as_ref().filter(|q| q.at.segment != at.segment).and_then(|q| curve.point(&q.at));
    let error = other.map_or(0.0, |q| 4.0 * curve.noise * found.radius / q.distance_sq(&foot.point));
    Some((found.radius, error))
}

#[test]
fn lfs_and_radii_agree_with_the_truth() {
    // The truth calls joints smooth that turn by less than 0.002 rad.
    let door = DoorOptions { corner_sine: 0.002, ..DoorOptions::default() };
    for name in ["simple", "blob2", "complex", "spiral"] {
        let (Some(file), Some(truth)) = (data(&format!("drawings/{name}.svg")), data(&format!("truth/{name}.csv")))
        else {
            continue;
        };
        let strokes = load(&file);
        let model = Model::with_door(&strokes, 1e-5, &door);
        let diagonal = *model.curve.diagonal();
        let text = std::fs::read_to_string(truth).expect("the truth");
        let (mut worst, mut worst_radius, mut low) = ((0.0_f64, 0, 0.0), (0.0_f64, 0, 0.0), 0.0_f64);
        for row in text.lines().skip(1) {
            let v: Vec<f64> = row.split(',').map(|x| x.parse().expect("a number")).collect();
            let cubic = (0..strokes[0].cubics.len()).find(|&i| i as f64 == v[0]).expect("a cubic");
            let lfs = model.lfs(0, cubic, v[1]) / v[4] - 1.0;
            low = low.min(lfs);
            if lfs.abs() > worst.0 {
                worst = (lfs.abs(), cubic, v[1]);
            }
            for (truth, left) in [(v[8], true), (v[9], false)] {
                let mine = radius(&model.curve, 0, cubic, v[1], left).expect("a place");
                if truth < 1e3 * diagonal {
                    let off = (mine / truth - 1.0).abs();
                    if off > worst_radius.0 {
                        worst_radius = (off, cubic, v[1]);
                    }
                } else {
                    assert!(mine > 900.0 * diagonal, "{name} cubic {cubic} t {}: {mine} for {truth}", v[1]);
                }
            }
        }
        println!("{name}: lfs within {worst:?} (lowest {low:.1e}), radii within {worst_radius:?}");
        assert!(worst.0 <= 2e-5, "{name}: lfs off by {worst:?}");
        assert!(worst_radius.0 <= 1e-9, "{name}: radius off by {worst_radius:?}");
    }
}

/// Kernel and checker at random places, next to joints, and at joints. Returns the largest relative difference.
fn compare_disks(name: &str, strokes: &[Stroke], random: &mut Random, rounds: u32) -> f64 {
    let (door, checker_door) = doors(1.0);
    let model = curve_model(strokes, &door);
    let checker = Checker::with_options(&raw(strokes), &checker_door);
    let diagonal = checker.diagonal();
    let noise = 1e-9 * diagonal;
    // Where branches of other paths touch a place, the judge's plain differences are noise.
    let touchings = checker.contacts();
    let mut worst = (0.0_f64, String::new());
    for (path, stroke) in strokes.iter().enumerate() {
        for (cubic, c) in stroke.cubics.iter().enumerate() {
            for _ in 0..rounds {
                let near = 10_f64.powf(random.between(-9.0, -2.0));
                for t in [random.unit(), near, 1.0 - near] {
                    for left in [true, false] {
                        // Lines run at uniform speed on C, dropped cubics are not on it.
                        let Some((mine, error)) = disk(&model, path, cubic, t, left) else { continue };
                        let at = crate::common::place(&model, path, cubic, t).expect("a place");
                        let p = model.curve().point(&at).expect("a point");
                        let theirs = checker.radius(path, cubic, t, left);
                        let q = checker.point(path, cubic, t);
                        if (p.x - q.x).hypot(p.y - q.y) > noise {
                            continue;
                        }
                        if touchings.iter().any(|c| c.distance(q) < 1e-8 * diagonal) {
                            continue;
                        }
                        if mine.min(theirs) > 10.0 * diagonal {
                            continue;
                        }
                        // A radius of touching branches is known to the coordinates' noise.
                        let off = (mine - theirs).abs() / (mine.min(theirs) + noise) - error;
                        if off.is_nan() || off > worst.0 {
                            let text =
                                format!("path {path} cubic {cubic} t {t} left {left}: {mine} for {theirs} {c:?}");
                            worst = (off, text);
                        }
                    }
                }
            }
        }
    }
    println!("{name}: disks within {:.1e}", worst.0);
    // Where branches touch nearby, the judge's plain differences are good for no more.
    assert!(worst.0 <= 1e-6, "{name}: radius off by {:e}: {}", worst.0, worst.1);
    worst.0
}

#[test]
fn disks_agree_with_brute_force_on_shipped_drawings() {
    let mut random = Random(11);
    for (name, strokes) in shipped() {
        let cubics: usize = strokes.iter().map(|s| s.cubics.len()).sum();
        // The judge's own medial axis of the larger drawings takes minutes.
        if cubics > 50 && !crate::common::everything() {
            continue;
        }
        compare_disks(&name, &strokes, &mut random, if crate::common::everything() { 12 } else { 3 });
    }
}

#[test]
fn disks_agree_with_brute_force_on_extra_drawings() {
    let Some(folder) = data("drawings") else { return };
    let mut random = Random(12);
    for file in svg_files(&folder) {
        let strokes = load(&file);
        let cubics: usize = strokes.iter().map(|s| s.cubics.len()).sum();
        if cubics <= 40 || crate::common::everything() {
            compare_disks(&stem(&file), &strokes, &mut random, if crate::common::everything() { 12 } else { 2 });
        }
    }
}
