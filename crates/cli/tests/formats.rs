//! Every format says the same, and says it in the way that is written down.

mod common;

use common::{Place, shipped_drawings, table};
use serde_json::Value;

const SAMPLES: &str = "path,segment,t,x,y,lfs,bound";
const MEDIAL: &str = "path,segment,t,x,y,side,mx,my,radius,polyline";
const LFS: &str = "path,segment,t,x,y,lfs";
const BOUNDS: [&str; 9] = ["start", "epsilon", "chord", "min", "max", "grading", "floor", "end", "corner"];

fn number(text: &str) -> f64 {
    let value: f64 = text.parse().unwrap_or_else(|_| panic!("“{text}” is a number"));
    assert!(!value.is_nan(), "no column is NaN");
    let again = if value.is_infinite() { "inf".to_owned() } else { format!("{value}") };
    assert_eq!(again, text, "shortest round-trip form");
    value
}

/// The rows of a JSON result, path by path, as the fields of its CSV.
fn json_rows(text: &str, key: &str, columns: &str) -> Vec<Vec<String>> {
    let value: Value = serde_json::from_str(text).expect("valid JSON");
    let field = |row: &Value, column: &str| match &row[column] {
        Value::Null => "inf".to_owned(),
        Value::String(word) => word.clone(),
        Value::Number(number) => match number.as_u64() {
            Some(whole) => whole.to_string(),
            None => number.as_f64().expect("a double").to_string(),
        },
        other => panic!("{column}: {other}"),
    };
    let paths = value["paths"].as_array().expect("paths");
    paths
        .iter()
        .flat_map(|path| path[key].as_array().expect("rows"))
        .map(|row| columns.split(',').map(|column| field(row, column)).collect())
        .collect()
}

#[test]
fn csv_json_ply_and_svg_agree_on_every_drawing() {
    let place = Place::new();
    for drawing in shipped_drawings() {
        let file = drawing.to_str().expect("a name in UTF-8");
        let run = |rest: &str| {
            let ran = place
                .run_with(&[&["sample", file], rest.split_whitespace().collect::<Vec<_>>().as_slice()].concat(), "");
            assert_eq!(ran.code, 0, "{file} {rest}: {}", ran.err);
            ran
        };
        let csv = run("");
        assert_eq!(csv.err.lines().filter(|line| !line.contains(": warning: ")).count(), 1, "one line: {}", csv.err);
        let rows = table(&csv.out, SAMPLES);
        let mut last = (0, 0, 0.0);
        for row in &rows {
            let [path, segment, t, x, y, lfs, bound] = row.as_slice() else { panic!("seven columns: {row:?}") };
            let path: u32 = path.parse().expect("a path");
            let segment: u32 = segment.parse().expect("a segment");
            let (t, x, y, lfs) = (number(t), number(x), number(y), number(lfs));
            assert!((0.0..=1.0).contains(&t) && x.is_finite() && y.is_finite() && lfs >= 0.0, "{file}: {row:?}");
            assert!(BOUNDS.contains(&bound.as_str()), "{file}: {row:?}");
            assert!(path >= last.0, "{file}: in path order");
            last = (path, segment, t);
        }

        let json = run("--format json").out;
        assert_eq!(json_rows(&json, "samples", SAMPLES), rows, "{file}: JSON has the rows of CSV");
        let value: Value = serde_json::from_str(&json).expect("valid JSON");
        for key in ["version", "source", "options", "diagonal", "paths"] {
            assert!(!value[key].is_null(), "{file}: JSON has {key}");
        }
        assert_eq!(value["options"]["epsilon"], 0.5, "{file}: the default");

        run("-o out.ply --quiet");
        let ply = place.get("out.ply");
        let (head, body) = ply.split_once("end_header\n").expect("a header");
        let count = |what: &str| {
            let line = head.lines().find_map(|line| line.strip_prefix(&format!("element {what} "))).expect("counted");
            line.parse::<usize>().expect("a count")
        };
        assert_eq!(count("vertex"), rows.len(), "{file}: a vertex for each row");
        assert_eq!(body.lines().count(), count("vertex") + count("edge"), "{file}: as many lines as announced");
        let paths = value["paths"].as_array().expect("paths");
        let edges = paths.iter().map(|path| {
            let samples = path["samples"].as_array().expect("samples").len();
            if path["closed"] == true && samples > 2 { samples } else { samples.saturating_sub(1) }
        });
        assert_eq!(count("edge"), edges.sum::<usize>(), "{file}: an edge for each pair of neighbours");
        for (line, row) in body.lines().zip(&rows) {
            let fields: Vec<_> = line.split(' ').collect();
            assert_eq!(fields, [row[3].as_str(), &row[4], "0", &row[5]], "{file}: the same points");
        }

        run("-o out.svg --quiet");
        let svg = place.get("out.svg");
        assert_eq!(svg.matches("<circle ").count(), rows.len(), "{file}: a dot for each row");
        for layer in ["drawing", "lfs", "medial", "samples"] {
            assert!(svg.contains(&format!(r#"inkscape:label="{layer}""#)), "{file}: layer {layer}");
        }
        // What was written can be read, and the drawing in it is the drawing that was read.
        run("-o only.svg --quiet --layers drawing");
        let count = |file: &str| {
            let text = place.run_with(&["inspect", file, "--format", "json"], "").out;
            let value: Value = serde_json::from_str(&text).expect("valid JSON");
            (value["cubics"].clone(), value["paths"].as_array().map(Vec::len))
        };
        assert_eq!(count("only.svg"), count(file), "{file}: the drawing comes back");
    }
}

#[test]
fn medial_and_lfs_tables() {
    let place = Place::with_drawing();
    let rows = table(&place.ok("medial drawing.svg --quiet"), MEDIAL);
    assert!(rows.len() > 10, "there is a medial axis");
    for row in &rows {
        let at = |column: usize| number(&row[column]);
        let distance = (at(3) - at(6)).hypot(at(4) - at(7));
        assert!((distance - at(8)).abs() <= 1e-9 * at(8).max(1.0), "the centre lies a radius away: {row:?}");
        assert!(at(8).is_finite(), "unbounded disks have no row: {row:?}");
        assert!(["left", "right", "fan", "corner"].contains(&row[5].as_str()), "a side: {row:?}");
    }
    let json = place.ok("medial drawing.svg --quiet --format json");
    assert_eq!(json_rows(&json, "medial", MEDIAL), rows, "JSON has the rows of CSV");

    let rows = table(&place.ok("lfs drawing.svg --quiet"), LFS);
    assert!(rows.len() > 10, "there are foot points");
    let json = place.ok("lfs drawing.svg --quiet --format json");
    assert_eq!(json_rows(&json, "lfs", LFS), rows, "JSON has the rows of CSV");

    // Asked at the same points, lfs is the same.
    let points: String = rows.iter().map(|row| format!("{},{}\n", row[3], row[4])).collect();
    place.put("points.txt", &format!("x,y\n# foot points\n{points}"));
    let again = table(&place.ok("lfs drawing.svg --quiet --at points.txt"), LFS);
    assert_eq!(again.len(), rows.len(), "one row a point");
    for (a, b) in again.iter().zip(&rows) {
        assert_eq!(a[3..], b[3..], "the same point has the same lfs");
    }
    place.ok("lfs drawing.svg -o lfs.svg --quiet");
    assert!(place.get("lfs.svg").contains("local feature size"), "a legend");
    place.ok("medial drawing.svg -o medial.svg --quiet");
    assert!(place.get("medial.svg").contains("<polyline "), "polylines");
}

#[test]
fn no_medial_axis_is_infinite() {
    let place = Place::new();
    place.put("line.svg", r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><path d="M1,1 L9,5"/></svg>"#);
    let ran = place.run("sample line.svg");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert_eq!(ran.out, format!("{SAMPLES}\n0,0,0,1,1,inf,start\n0,0,1,9,5,inf,end\n"), "two samples");
    assert!(ran.err.contains("lfs infinite"), "the summary says so: {}", ran.err);
    let json: Value = serde_json::from_str(&place.ok("sample line.svg --format json")).expect("valid JSON");
    assert!(json["paths"][0]["samples"][0]["lfs"].is_null(), "null in JSON");
    assert_eq!(place.ok("medial line.svg"), format!("{MEDIAL}\n"), "no medial points");
    assert_eq!(place.ok("lfs line.svg"), format!("{LFS}\n0,0,0,1,1,inf\n0,0,1,9,5,inf\n"), "its ends");
    for format in ["svg", "ply", "gcode"] {
        place.ok(&format!("sample line.svg -o out.{format} --max-distance 50%"));
    }
    assert!(place.get("out.svg").contains("no medial axis"), "the legend says so");
}

#[test]
fn gcode_goes_where_the_samples_are() {
    let place = Place::with_drawing();
    let rows = table(&place.ok("sample drawing.svg --chord-error 0.1mm --quiet"), SAMPLES);
    let options = ["--pen-up", "M280 P0 S90", "--pen-up", "G4 P150", "--pen-down", "M280 P0 S40", "--feed", "900"];
    let base = ["sample", "drawing.svg", "-o", "out.gcode", "--chord-error", "0.1mm", "--quiet"];
    let ran = place.run_with(&[base.as_slice(), &options].concat(), "");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let text = place.get("out.gcode");
    let mut points: Vec<(f64, f64)> = Vec::new();
    for line in text.lines().filter(|line| line.starts_with("G0 X") || line.starts_with("G1 X")) {
        let word = |letter: char| {
            let word = line.split(' ').find_map(|word| word.strip_prefix(letter)).expect("a coordinate");
            assert!(
                word.split_once('.').is_none_or(|(_, d)| d.len() <= 4 && !d.ends_with('0')),
                "four decimals: {line}"
            );
            word.parse::<f64>().expect("a number")
        };
        points.push((word('X'), word('Y')));
    }
    // Two user units to the millimetre, y upwards from the lower edge; closed paths return to their start.
    let mm = |row: &Vec<String>| (number(&row[3]) / 2.0, (100.0 - number(&row[4])) / 2.0);
    let (closed, open): (Vec<_>, Vec<_>) = rows.iter().partition(|row| row[0] == "0");
    let mut expected: Vec<_> = closed.iter().copied().map(mm).collect();
    expected.push(expected[0]);
    expected.extend(open.iter().copied().map(mm));
    expected.push((0.0, 0.0));
    assert_eq!(points.len(), expected.len(), "one move a point");
    for (a, b) in points.iter().zip(&expected) {
        assert!((a.0 - b.0).abs() <= 5.1e-5 && (a.1 - b.1).abs() <= 5.1e-5, "{a:?} is {b:?}");
    }
    assert!(text.contains("\nG21\nG90\nM280 P0 S90\nG4 P150\n"), "millimetres, absolute, pen up: {text}");
    assert_eq!(text.matches("\nM280 P0 S40\n").count(), 2, "the pen goes down once a path");
    assert!(text.contains("; path 0 blob\n") && text.contains("; path 1 wave\n"), "ids: {text}");
    assert!(text.contains("; group: outlines\n") && text.contains("; group: lines\n"), "layers: {text}");
    assert!(text.contains("; chord-error: 0.2\n") && text.contains("; pen-down: M280 P0 S40\n"), "options: {text}");
    assert!(text.contains(" F900\n"), "the feed: {text}");
}

#[test]
fn pictures_keep_frame_groups_and_ids() {
    let place = Place::with_drawing();
    place.ok("sample drawing.svg -o out.svg");
    let svg = place.get("out.svg");
    assert!(svg.contains(r#"width="100mm" height="50mm" viewBox="0 0 200 100""#), "the frame of the drawing");
    for group in [r#"id="first" inkscape:label="outlines""#, r#"id="second" inkscape:label="lines""#] {
        assert!(svg.contains(&format!(r#"<g inkscape:groupmode="layer" {group}>"#)), "{group}");
    }
    for id in ["blob", "wave"] {
        assert_eq!(svg.matches(&format!(r#" id="{id}""#)).count(), 1, "{id} once");
    }
    let inspected: Value = serde_json::from_str(&place.ok("inspect out.svg --format json")).expect("valid JSON");
    assert!(inspected["groups"].as_array().expect("groups").iter().any(|group| group["id"] == "first"), "read back");
}

#[test]
fn control_points_and_pipes() {
    let place = Place::with_drawing();
    let csv = "path,closed,x0,y0,x1,y1,x2,y2,x3,y3\n0,0,0,0,1,3,4,3,5,0\n";
    place.put("points.csv", csv);
    let from_file = place.ok("sample points.csv --quiet");
    let piped = place.run_with(&["sample", "-", "--quiet"], csv);
    assert_eq!((piped.code, piped.out), (0, from_file), "a table from a pipe: {}", piped.err);
    let piped = place.run_with(&["sample", "-", "-o", "-", "--quiet"], common::DRAWING);
    assert_eq!((piped.code, piped.out), (0, place.ok("sample drawing.svg --quiet")), "a drawing: {}", piped.err);
    let asked = place.run_with(&["lfs", "drawing.svg", "--at", "-", "--quiet"], "50 50\n");
    assert_eq!(table(&asked.out, LFS).len(), 1, "points from a pipe: {}", asked.err);
}
