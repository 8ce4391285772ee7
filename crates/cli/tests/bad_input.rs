//! Everything that can be wrong ends in one line, the documented exit code, and no file.

mod common;

use common::{DRAWING, Place};

fn svg(body: &str) -> String {
    format!(r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">{body}</svg>"#)
}

fn path(data: &str) -> String {
    svg(&format!(r#"<path id="culprit" d="{data}"/>"#))
}

#[test]
fn drawings_that_cannot_be_read() {
    let place = Place::new();
    place.put("text.svg", "This is no drawing.\n");
    place.put("empty.svg", "");
    place.put("truncated.svg", &DRAWING[..DRAWING.len() / 2]);
    place.put("malformed.svg", &path("M 0,0 L 1,x"));
    place.put("nan.svg", &path("M 0,0 L NaN,1"));
    place.put("infinite.svg", &path("M 0,0 C 1,1 2,2 1e999,3"));
    place.put("huge.svg", &path("M 0,0 C 1,1 2,2 1e300,3"));
    place.put("hugest.svg", &path("M -1e308,0 L 1e308,0 1,1e308"));
    place.put("tiny.svg", &path("M 0,0 C 1e-300,0 2e-300,1e-300 3e-300,0"));
    place.put("point.svg", &path("M 5,5 C 5,5 5,5 5,5 L 5,5 Z"));
    place.put("nothing.svg", &svg(""));
    place.put("words.svg", &svg("<text>hello</text>"));
    place.put("bad.csv", "path,closed,x0,y0,x1,y1,x2,y2,x3,y3\n0,0,1,2,3\n");
    std::fs::write(place.path("binary.svg"), [0xff, 0xfe, 0x00, 0x80]).expect("written");
    std::fs::create_dir(place.path("folder.svg")).expect("made");
    for command in ["sample", "medial", "lfs", "inspect", "compare"] {
        let output = if matches!(command, "inspect" | "compare") { "" } else { " -o out.csv" };
        let fails = |file: &str, words: &[&str]| {
            let mut words = words.to_vec();
            words.push(file);
            place.fails(&format!("{command} {file}{output}"), 3, &words);
        };
        fails("missing.svg", &["no such file"]);
        fails("folder.svg", &["directory"]);
        fails("text.svg", &[]);
        fails("empty.svg", &[]);
        fails("binary.svg", &["UTF-8"]);
        fails("truncated.svg", &[]);
        fails("malformed.svg", &["culprit"]);
        fails("nan.svg", &["culprit"]);
        fails("infinite.svg", &["culprit"]);
        fails("huge.svg", &["culprit"]);
        fails("hugest.svg", &["culprit"]);
        fails("tiny.svg", &[]);
        fails("point.svg", &["all points coincide"]);
        fails("nothing.svg", &["no curve"]);
        fails("words.svg", &["no curve", "left out"]);
        fails("bad.csv", &["line 2"]);
    }
}

#[test]
fn points_that_cannot_be_read() {
    let place = Place::with_drawing();
    place.put("points.txt", "1 2\n3 four\n");
    place.fails("lfs drawing.svg --at points.txt -o out.csv", 3, &["points.txt", "line 2"]);
    place.fails("lfs drawing.svg --at none.txt -o out.csv", 3, &["none.txt", "no such file"]);
    place.fails("lfs - --at -", 2, &["standard input"]);
}

#[test]
fn output_that_cannot_be_written() {
    let place = Place::with_drawing();
    std::fs::create_dir(place.path("folder.csv")).expect("made");
    for command in ["sample", "medial", "lfs"] {
        place.fails(&format!("{command} drawing.svg -o no/such/folder/out.csv"), 4, &["out.csv", "folder"]);
        // A file in the place of a folder stops every user, root included.
        place.fails(&format!("{command} drawing.svg -o drawing.svg/out.csv"), 4, &["out.csv"]);
        place.fails(&format!("{command} drawing.svg -o folder.csv"), 4, &["folder.csv"]);
        if std::path::Path::new("/proc/self").exists() {
            place.fails(&format!("{command} drawing.svg -o /proc/out.csv"), 4, &["/proc/out.csv"]);
        }
        if std::path::Path::new("/dev/full").exists() {
            place.fails(&format!("{command} drawing.svg --format csv -o /dev/full"), 4, &["/dev/full"]);
        }
    }
}

#[cfg(unix)]
#[test]
fn a_folder_without_write_permission() {
    use std::os::unix::fs::PermissionsExt;
    let place = Place::with_drawing();
    let folder = place.path("locked");
    std::fs::create_dir(&folder).expect("made");
    std::fs::set_permissions(&folder, std::fs::Permissions::from_mode(0o555)).expect("locked");
    if std::fs::write(folder.join("probe"), "").is_ok() {
        eprintln!("skipped: this user may write everywhere");
        return;
    }
    place.fails("sample drawing.svg -o locked/out.csv", 4, &["locked/out.csv"]);
}

#[test]
fn options_that_make_no_sense() {
    let place = Place::with_drawing();
    let usage =
        |options: &str, words: &[&str]| place.fails(&format!("sample drawing.svg -o out.csv {options}"), 2, words);
    for epsilon in ["0", "-1", "nan", "inf", "-0.0"] {
        usage(&format!("--epsilon {epsilon}"), &["epsilon"]);
        usage(&format!("--rho {epsilon}"), &["rho"]);
    }
    usage("--epsilon=-inf", &["epsilon"]);
    usage("--epsilon half", &["epsilon"]);
    usage("--epsilon 0.5 --rho 0.5", &["epsilon", "rho"]);
    usage("--steps 10 --tolerance 0.1", &["steps", "tolerance"]);
    usage("--steps 0", &["steps"]);
    usage("--tolerance 0", &["tolerance"]);
    usage("--tolerance 1", &["tolerance"]);
    usage("--tolerance nan", &["tolerance"]);
    usage("--min-distance 2 --max-distance 1", &["min-distance 2", "max-distance 1"]);
    usage("--min-distance 1cm --max-distance 1mm", &["min-distance 1cm", "max-distance 1mm"]);
    usage("--epsilon 1.5", &["epsilon"]);
    usage("--min-distance 0", &["min-distance"]);
    usage("--min-distance -1", &["min-distance"]);
    usage("--max-distance 0", &["max-distance"]);
    usage("--chord-error 0mm", &["chord-error"]);
    usage("--chord-error 1furlong", &["chord-error"]);
    usage("--chord-error nan", &["chord-error"]);
    usage("--grading 1", &["grading"]);
    usage("--grading inf", &["grading"]);
    usage("--start 1", &["start"]);
    usage("--start -0.1", &["start"]);
    usage("--start nan", &["start"]);
    usage("--corner-angle -1", &["corner-angle"]);
    usage("--corner-angle 91", &["corner-angle"]);
    usage("--threads 0", &["threads"]);
    usage("--layers samples", &["layers", "svg"]);
    usage("--with-lfs", &["with-lfs", "fsj"]);
    usage("--pen-up M5", &["gcode"]);
    usage("--unknown", &["--unknown"]);
    place.fails("medial drawing.svg -o out.fsj", 2, &["fsj", "csv"]);
    place.fails("sample drawing.svg -o out.fsj --rho 0.5", 2, &["job", "--epsilon", "--rho"]);
    place.fails("sample drawing.svg -o out.fsj --grading 2", 2, &["job", "--grading"]);
    place.fails("sample drawing.svg -o out.fsj --steps 2000", 2, &["job", "--steps", "1024"]);
    place.fails("sample drawing.svg -o out.xyz", 2, &["xyz"]);
    place.fails("sample drawing.svg -o out", 2, &["extension", "--format"]);
    place.fails("medial drawing.svg -o out.gcode", 2, &["gcode", "csv"]);
    place.fails("lfs drawing.svg -o out.ply", 2, &["ply", "csv"]);
    place.fails("sample drawing.svg -o out.gcode --feed 0", 2, &["feed"]);
    place.fails("sample", 2, &["<IN>"]);
    place.fails("frobnicate drawing.svg", 2, &["frobnicate"]);
    place.fails("compare drawing.svg --diagonal 10", 2, &["diagonal", "physical"]);
    place.fails("man frobnicate", 2, &["frobnicate"]);
    place.fails("completions frobnicate", 2, &["frobnicate"]);
}

#[test]
fn a_physical_length_needs_a_physical_drawing() {
    let place = Place::new();
    place.put("unitless.svg", &path("M 1,1 C 2,8 8,8 9,1"));
    place.fails("sample unitless.svg --chord-error 0.1mm -o out.csv", 2, &["chord-error", "0.1mm", "physical"]);
    place.ok("sample unitless.svg --chord-error 1% -o out.csv --quiet");
}

#[test]
fn a_limit_that_can_be_raised() {
    let place = Place::with_drawing();
    place.fails("sample drawing.svg -o out.csv --max-samples 3", 5, &["drawing.svg", "--max-samples"]);
    place.fails("compare drawing.svg --max-samples 3", 5, &["drawing.svg", "--max-samples"]);
    for command in ["sample", "medial", "lfs", "compare"] {
        let line = format!("{command} drawing.svg --max-medial-points 50");
        place.fails(&line, 5, &["drawing.svg", "50 medial points", "--max-medial-points"]);
    }
    let place_of_the_limit = place.ok("medial drawing.svg --quiet").lines().count() - 1;
    place.ok(&format!("medial drawing.svg --quiet --max-medial-points {place_of_the_limit}"));
    let one_less = format!("medial drawing.svg --quiet --max-medial-points {}", place_of_the_limit - 1);
    place.fails(&one_less, 5, &["--max-medial-points"]);
    place.ok("sample drawing.svg -o out.csv --max-samples 300 --quiet");
}

#[test]
fn an_old_result_survives_a_failed_run() {
    let place = Place::with_drawing();
    place.put("out.csv", "precious");
    place.put("broken.svg", &path("M 0,0 L"));
    place.fails("sample broken.svg -o out.csv", 3, &["broken.svg"]);
    assert_eq!(place.get("out.csv"), "precious", "untouched");
    place.ok("sample drawing.svg -o out.csv");
    assert!(place.get("out.csv").starts_with("path,segment"), "replaced by a whole one");
}

#[cfg(unix)]
#[test]
fn a_reader_that_leaves_early() {
    use std::io::{BufRead, BufReader};
    use std::process::Stdio;
    let place = Place::with_drawing();
    let mut child = common::command(&place.path(""))
        .args(["medial", "drawing.svg", "--steps", "20000", "--quiet"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("fsample starts");
    let mut first = String::new();
    let mut reader = BufReader::new(child.stdout.take().expect("a pipe"));
    reader.read_line(&mut first).expect("a line");
    drop(reader);
    let output = child.wait_with_output().expect("fsample ends");
    assert_eq!(output.status.code(), Some(0), "leaving is no error");
    assert!(output.stderr.is_empty(), "and is not worth a word: {}", String::from_utf8_lossy(&output.stderr));
}
