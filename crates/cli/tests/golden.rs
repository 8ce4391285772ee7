//! Golden files: the bytes of every format, as they were when they were last looked at.
//!
//! `UPDATE_GOLDEN=1 cargo test -p fsample --test golden` writes them anew; look at the difference before it is committed.
//! Arithmetic is + − × ÷ √ throughout on these drawings, so the bytes are the same on every IEEE machine.

mod common;

use std::path::Path;

use common::Place;

/// A file's name, and the command that gives its bytes on standard output.
const GOLDEN: [(&str, &str); 14] = [
    ("samples.csv", "sample drawing.svg --quiet"),
    ("samples.json", "sample drawing.svg --quiet --format json --chord-error 0.5mm --min-distance 1mm"),
    ("samples.svg", "sample drawing.svg --quiet --format svg --epsilon 0.9 --steps 12"),
    ("samples.ply", "sample drawing.svg --quiet --format ply"),
    ("samples.gcode", "sample drawing.svg --quiet --format gcode --chord-error 0.2mm"),
    ("samples-rho.csv", "sample drawing.svg --quiet --rho 0.7 --grading 1.5"),
    ("crossing.csv", "sample crossing.csv --quiet"),
    ("crossing-medial.csv", "medial crossing.csv --quiet --steps 8"),
    ("medial.svg", "medial drawing.svg --quiet --format svg --steps 8"),
    ("medial.json", "medial drawing.svg --quiet --format json --steps 4"),
    ("lfs.csv", "lfs drawing.svg --quiet --steps 8"),
    ("lfs.svg", "lfs drawing.svg --quiet --format svg --steps 8"),
    ("inspect.txt", "inspect drawing.svg"),
    ("compare.csv", "compare drawing.svg --quiet --format csv"),
];

/// A closed cubic and a line that crosses it.
const CROSSING: &str = "path,closed,x0,y0,x1,y1,x2,y2,x3,y3\n0,1,0,0,40,0,40,30,0,0\n1,0,-5,10,5,10,20,5,35,5\n";

#[test]
fn bytes_are_what_they_were() {
    let place = Place::with_drawing();
    place.put("crossing.csv", CROSSING);
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    let update = std::env::var_os("UPDATE_GOLDEN").is_some();
    let mut changed = Vec::new();
    for (name, command) in GOLDEN {
        let now = place.ok(command);
        let file = folder.join(name);
        if update {
            std::fs::create_dir_all(&folder).expect("the folder of golden files");
            std::fs::write(&file, &now).expect("a golden file");
        }
        let before = std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        if let Some((n, (a, b))) = (1..).zip(before.lines().zip(now.lines())).find(|(_, (a, b))| a != b) {
            changed.push(format!("{name}:{n}: {a}\n  now: {b}"));
        } else if before != now {
            changed.push(format!("{name}: {} lines, now {}", before.lines().count(), now.lines().count()));
        }
    }
    assert!(changed.is_empty(), "{}", changed.join("\n"));
}
