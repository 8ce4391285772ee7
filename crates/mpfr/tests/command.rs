//! `fsample-mpfr` on the command line.

use std::path::PathBuf;
use std::process::Command;

/// A folder of this test's own.
fn folder() -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("fsample-mpfr");
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

fn put(name: &str, text: &str) -> String {
    let file = folder().join(name);
    std::fs::write(&file, text).expect("written");
    file.display().to_string()
}

/// Exit code, standard output, standard error.
fn run(arguments: &[&str]) -> (i32, String, String) {
    let ran = Command::new(env!("CARGO_BIN_EXE_fsample-mpfr")).args(arguments).output().expect("it starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
    (ran.status.code().unwrap_or(-1), text(ran.stdout), text(ran.stderr))
}

fn ok(arguments: &[&str]) -> String {
    let (code, out, err) = run(arguments);
    assert_eq!(code, 0, "{arguments:?}: {err}");
    out
}

/// A line, and a stroke that ends one above it: beside it M is the parabola y = (x² + 1)/2.
const END_ABOVE_A_LINE: &str = "0,0,-10,0,-4,0,4,0,10,0\n1,0,0,1,0,2,0,4,0,6\n";

fn column(table: &str, row: usize, index: usize) -> String {
    let row = table.lines().nth(row + 1).expect("the row");
    row.split(',').nth(index).expect("the field").to_owned()
}

#[test]
fn lfs_in_any_precision() {
    let drawing = put("end.csv", END_ABOVE_A_LINE);
    let points = put("points.txt", "# two points of the line\nx y\n0 0\n1,0\n");
    let table = |bits: &str| ok(&["lfs", &drawing, "--at", &points, "--bits", bits, "--tolerance", "1e-2"]);
    // At (1, 0) the nearest point of the parabola has u³ + 3u = 2: u = ∛(1+√2) − ∛(√2−1), and lfs² = (1−u)² + (u²+1)²/4.
    let root = 2_f64.sqrt();
    let u = (1.0 + root).cbrt() - (root - 1.0).cbrt();
    let known = ((1.0 - u).powi(2) + (u * u + 1.0).powi(2) / 4.0).sqrt();
    let mut before = String::new();
    for (bits, digits) in [("64", 16), ("100", 30), ("256", 30)] {
        let table = table(bits);
        assert_eq!(table.lines().count(), 3, "{table}");
        let at_foot: f64 = column(&table, 0, 5).parse().expect("a number");
        assert!((at_foot - 0.5).abs() < 1e-15, "{bits}: {at_foot}");
        let text = column(&table, 1, 5);
        let value: f64 = text.parse().expect("a number");
        assert!((value / known - 1.0).abs() < 1e-14, "{bits}: {value} {known}");
        if !before.is_empty() {
            assert_eq!(before.get(..16), text.get(..16), "digits stay as they are");
        }
        assert!(text.len() >= digits, "{bits}: {text}");
        before = text;
    }
}

#[test]
fn places_along_the_drawing_and_the_ladder() {
    let drawing = put("lines.csv", "0,0,0,0,1,0,2,0,3,0\n1,0,0,1,1,1,2,1,3,1\n");
    let table = ok(&["lfs", &drawing, "--along", "3"]);
    assert_eq!(table.lines().next(), Some("path,segment,t,x,y,lfs,mx,my,polylines"), "{table}");
    assert_eq!(table.lines().count(), 7, "{table}");
    for row in 0..6 {
        assert_eq!(column(&table, row, 5).parse(), Ok(0.5), "between two lines: {table}");
    }
    let ladder = ok(&["ladder", &drawing, "--along", "1"]);
    let rungs: Vec<&str> = ladder.lines().skip(1).filter_map(|row| row.split(',').next()).collect();
    assert_eq!(rungs, ["64", "128", "256", "512", "1024"], "{ladder}");
}

#[test]
fn proved_bounds_in_both_arithmetics() {
    let drawing = put("two-lines.csv", "0,0,0,0,1,0,2,0,3,0\n1,0,0,1,1,1,2,1,3,1\n");
    let table = ok(&["enclosures", &drawing, "--points", "4", "--width", "0.01"]);
    assert_eq!(table.lines().next(), Some("x,y,lower,upper,lower_128,upper_128,judge,agrees"), "{table}");
    assert_eq!(table.lines().count(), 5, "{table}");
    for row in 0..4 {
        let [lower, upper, wide_lower, wide_upper] =
            [2, 3, 4, 5].map(|i| column(&table, row, i).parse::<f64>().expect("a number"));
        for [lower, upper] in [[lower, upper], [wide_lower, wide_upper]] {
            assert!((0.495..=0.5).contains(&lower) && (0.5..=0.506).contains(&upper), "between two lines: {table}");
        }
        assert_eq!(column(&table, row, 7), "true", "{table}");
    }
}

#[test]
fn what_cannot_be_done() {
    let drawing = put("bad-lines.csv", END_ABOVE_A_LINE);
    let bad = put("bad.txt", "0 0\n1 2 3\n");
    let fails = |arguments: &[&str], code: i32, word: &str| {
        let (found, out, err) = run(arguments);
        assert_eq!((found, out.as_str(), err.lines().count()), (code, "", 1), "{arguments:?}: {err}");
        assert!(err.contains(word), "{arguments:?}: {err}");
    };
    fails(&["frobnicate"], 2, "frobnicate");
    fails(&["lfs"], 2, "which drawing");
    fails(&["lfs", &drawing, "--bits", "2000"], 2, "--bits 2000");
    fails(&["lfs", &drawing, "--bits"], 2, "needs a value");
    fails(&["lfs", &drawing, "--wrong"], 2, "--wrong");
    fails(&["lfs", &drawing, &drawing], 2, "one drawing");
    fails(&["lfs", &drawing, "--at", &bad, "--along", "2"], 2, "exclude");
    fails(&["lfs", "no-such.svg"], 3, "no-such.svg");
    fails(&["lfs", &drawing, "--at", "no-such.txt"], 3, "no-such.txt");
    fails(&["lfs", &drawing, "--at", &bad], 3, "line 2");
    fails(&["ladder", &drawing, "--bits", "64"], 2, "--bits");
    fails(&["lfs", &drawing, "--width", "0.1"], 2, "--width");
    fails(&["enclosures", &drawing, "--along", "4"], 2, "--along");
    fails(&["enclosures", &drawing, "--width", "1"], 2, "0.5");
    assert!(ok(&[]).contains("ladder DRAWING"), "without arguments it says how");
}

#[test]
fn verdicts_on_random_curves_are_true() {
    let table = ok(&["verdicts", "--curves", "12", "--from", "3"]);
    let counts: Vec<u32> =
        table.lines().nth(1).expect("a row").split(',').map(|n| n.parse().expect("a count")).collect();
    let [rejected, proved, refuted, unknown, points] = counts[..] else { panic!("{table}") };
    assert_eq!(rejected + proved + refuted + unknown, 12, "{table}");
    assert!(proved > 0 && refuted > 0 && points > 10 * proved, "{table}");
    for arguments in [&["verdicts", "--curves"][..], &["verdicts", "--curves", "many"], &["verdicts", "drawing.svg"]] {
        let (code, _, message) = run(arguments);
        assert_eq!((code, message.lines().count()), (2, 1), "{message}");
    }
}
