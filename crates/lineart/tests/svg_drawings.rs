//! Real drawings: those that ship, always; a folder of extra drawings where it is present.
//!
//! The folder is named by the variable `FSAMPLE_DATA`, by default `../shared/data` beside the workspace, with
//! subfolders `drawings` and `public-domain`.

use std::path::{Path, PathBuf};

use lineart::drawing::Drawing;
use lineart::svg;

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The extra folder, or none and a message.
fn extra() -> Option<PathBuf> {
    let folder = std::env::var_os("FSAMPLE_DATA").map_or_else(|| workspace().join("../shared/data"), PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("skipped: no folder of extra drawings at {} (set FSAMPLE_DATA)", folder.display());
    None
}

fn read(path: &Path) -> Drawing {
    svg::read_file(path).unwrap_or_else(|error| panic!("{error}"))
}

/// Paths, closed paths, cubics.
fn counts(drawing: &Drawing) -> (usize, usize, usize) {
    let closed = drawing.paths.iter().filter(|path| path.closed).count();
    (drawing.paths.len(), closed, drawing.paths.iter().map(|path| path.cubics.len()).sum())
}

/// Diagonal of the bounding box of all control points.
fn diagonal(drawing: &Drawing) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in drawing.paths.iter().flat_map(|path| &path.cubics).flat_map(|cubic| &cubic.points) {
        low = [low[0].min(p.x), low[1].min(p.y)];
        high = [high[0].max(p.x), high[1].max(p.y)];
    }
    (high[0] - low[0]).hypot(high[1] - low[1])
}

#[test]
fn drawings_that_ship() {
    let expected = [
        ("bee", (46, 37, 136), 0),
        ("celtic_triskell_01", (4, 4, 39), 1),
        ("elephant_outline_matthe_r", (8, 0, 44), 0),
        ("hand_dennis_rutjes_01", (9, 1, 41), 3),
        ("leaf_01", (6, 1, 23), 2),
        ("seal_sek_", (14, 3, 109), 4),
        ("sleeping_cat_ron_golan_01", (17, 3, 57), 0),
    ];
    for (name, shape, groups) in expected {
        let drawing = read(&workspace().join("drawings").join(name).with_extension("svg"));
        assert_eq!(counts(&drawing), shape, "{name}");
        assert_eq!(drawing.groups.len(), groups, "{name}");
        assert!(drawing.warnings.is_empty(), "{name}: {:?}", drawing.warnings);
        assert!((drawing.user_units_per_mm.unwrap() * 25.4 - 96.0).abs() < 1e-12, "{name}");
    }
}

#[test]
fn drawings_with_gaps() {
    for (name, shape) in [("deer", (19, 0, 104)), ("fish", (13, 1, 62)), ("snail", (12, 0, 82))] {
        let drawing = read(&workspace().join("drawings").join(name).with_extension("svg"));
        assert_eq!(counts(&drawing), shape, "{name}");
        assert!(drawing.warnings.is_empty(), "{name}: {:?}", drawing.warnings);
        assert!((drawing.user_units_per_mm.unwrap() - 1.0).abs() < 1e-12, "{name}");
    }
}

#[test]
fn the_switch_of_the_seal_shows_its_group() {
    let drawing = read(&workspace().join("drawings/seal_sek_.svg"));
    assert_eq!(drawing.view_box, Some([0.0, 0.0, 128.636, 132.676]));
    assert!(drawing.paths.iter().any(|path| path.element == "circle" && path.cubics.len() == 4));
    assert!(drawing.paths.iter().any(|path| path.element == "ellipse" && path.cubics.len() == 4));
}

/// Cubics as published for these drawings, paths, closed paths, and closing lines of less than 1e-12: sketching
/// programs return to the start by adding up steps, which leaves the last digit open, and the published counts do not
/// have those lines.
#[test]
fn extra_drawings_have_their_published_counts() {
    let Some(folder) = extra() else { return };
    let expected = [
        ("simple", 3, 1, 1, 0),
        ("blob2", 13, 1, 1, 1),
        ("complex", 27, 1, 1, 1),
        ("spiral", 38, 1, 1, 1),
        ("f1", 40, 7, 0, 0),
        ("f2", 68, 12, 0, 0),
        ("f3", 52, 6, 0, 0),
        ("f4", 54, 6, 2, 0),
        ("f6", 72, 10, 1, 1),
        ("bunny", 17, 1, 0, 0),
        ("Fishi", 154, 6, 0, 0),
        ("Deery", 182, 6, 1, 1),
        ("Frog2", 196, 65, 2, 1),
        ("Spidy", 244, 11, 3, 1),
        ("Croco", 257, 50, 0, 0),
    ];
    for (name, published, paths, closed, tiny_lines) in expected {
        let drawing = read(&folder.join("drawings").join(name).with_extension("svg"));
        assert_eq!(counts(&drawing), (paths, closed, published + tiny_lines), "{name}");
        let last = drawing.paths.iter().filter(|path| path.closed).filter_map(|path| path.cubics.last());
        let tiny = last.filter(|cubic| cubic.start().distance(cubic.end()) < 1e-12);
        assert_eq!(tiny.count(), tiny_lines, "{name}");
        assert!(drawing.warnings.is_empty(), "{name}: {:?}", drawing.warnings);
        match name {
            "bunny" => assert_eq!(drawing.user_units_per_mm, None),
            "f1" | "f2" | "f3" | "f4" | "f6" => assert_eq!(drawing.user_units_per_mm, Some(96.0 / 25.4), "{name}"),
            _ => assert_eq!(drawing.user_units_per_mm, Some(1.0), "{name}"),
        }
    }
}

#[test]
fn every_extra_drawing_is_read() {
    let Some(folder) = extra() else { return };
    let mut read_so_far = 0;
    for folder in ["drawings", "public-domain"].map(|name| folder.join(name)) {
        let Ok(entries) = std::fs::read_dir(&folder) else { continue };
        let mut files: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
        files.retain(|path| path.extension().is_some_and(|extension| extension == "svg"));
        files.sort();
        for path in files {
            let drawing = read(&path);
            let name = path.display();
            assert!(diagonal(&drawing) > 0.0, "{name}");
            for path in &drawing.paths {
                assert!(path.cubics.iter().all(|cubic| cubic.is_finite()), "{name}");
                assert!(path.cubics.windows(2).all(|pair| pair[0].end() == pair[1].start()), "{name}");
            }
            read_so_far += 1;
        }
    }
    eprintln!("{read_so_far} extra drawings read");
}
