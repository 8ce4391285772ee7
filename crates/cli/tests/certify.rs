//! `fsample certify`: the answer, the exit code and the certificate.

mod common;

use common::Place;
use serde_json::Value;

/// A place with an ellipse and samples of it that are dense enough for ε = 0.5.
fn ellipse() -> Place {
    let place = Place::new();
    let shape = r#"<svg xmlns="http://www.w3.org/2000/svg"><ellipse cx="3" cy="2" rx="2" ry="1" fill="none"/></svg>"#;
    place.put("ellipse.svg", shape);
    let samples = place.ok("sample ellipse.svg --epsilon 0.49 --quiet");
    place.put("samples.csv", &samples);
    place
}

#[test]
fn samples_are_proved_and_the_certificate_covers_the_path() {
    let place = ellipse();
    assert_eq!(place.ok("certify ellipse.svg --samples samples.csv --epsilon 0.5 --quiet -o c.json"), "proved\n");
    let certificate: Value = serde_json::from_str(&place.get("c.json")).expect("JSON");
    assert_eq!(certificate["verdict"], "proved");
    assert_eq!(certificate["epsilon"], 0.5);
    let samples = certificate["samples"].as_array().expect("samples");
    assert_eq!(samples.len(), place.get("samples.csv").lines().count() - 1);
    // The pieces of each cubic follow each other from 0 to 1.
    let pieces = certificate["pieces"].as_array().expect("pieces");
    let mut end = (-1, 1.0);
    for piece in pieces {
        let segment = piece["segment"].as_i64().expect("an index");
        let [from, to] = ["from", "to"].map(|name| piece[name].as_f64().expect("a parameter"));
        let follows =
            if segment == end.0 { from == end.1 } else { segment == end.0 + 1 && end.1 == 1.0 && from == 0.0 };
        assert!(follows && to > from, "piece {piece} behind {end:?}");
        assert_eq!(piece["reason"], "feature");
        end = (segment, to);
    }
    assert_eq!(end, (3, 1.0));
}

#[test]
fn a_sample_less_is_refuted_and_the_witness_breaks_the_condition() {
    let place = ellipse();
    let fewer: Vec<String> =
        place.get("samples.csv").lines().enumerate().filter(|(i, _)| *i != 4).map(|(_, l)| l.to_owned()).collect();
    place.put("fewer.csv", &fewer.join("\n"));
    let ran = place.run("certify ellipse.svg --samples fewer.csv --epsilon 0.5 --quiet -o c.json");
    assert_eq!(ran.code, 1, "{}", ran.err);
    assert!(ran.out.starts_with("refuted at ("), "{}", ran.out);
    let certificate: Value = serde_json::from_str(&place.get("c.json")).expect("JSON");
    let witness = &certificate["witness"];
    let number = |object: &Value, name: &str| object[name].as_f64().expect("a number");
    let [distance, lfs] = ["distance_at_least", "lfs_at_most"].map(|name| number(witness, name));
    let [x, y] = ["x", "y"].map(|name| number(&certificate["witness_at"], name));
    assert!(distance >= 0.5 * lfs, "{witness}");
    // Independently of the program: the nearest of the samples that were given.
    let nearest = fewer[1..]
        .iter()
        .map(|line| {
            let columns: Vec<f64> = line.split(',').take(5).map(|v| v.parse().expect("a number")).collect();
            (columns[3] - x).hypot(columns[4] - y)
        })
        .fold(f64::INFINITY, f64::min);
    assert!(distance <= nearest, "{distance} for {nearest}");
}

#[test]
fn certificates_are_rechecked() {
    let place = ellipse();
    place.ok("certify ellipse.svg --samples samples.csv --epsilon 0.5 --quiet -o c.json");
    assert_eq!(place.ok("certify ellipse.svg --check c.json --quiet"), "proved\n");
    assert_eq!(place.ok("certify ellipse.svg --check c.json --samples samples.csv --epsilon 0.5 --quiet"), "proved\n");
    // Of other samples, of a smaller ε, of another curve.
    let fewer: Vec<String> =
        place.get("samples.csv").lines().enumerate().filter(|(i, _)| *i != 4).map(|(_, l)| l.to_owned()).collect();
    place.put("fewer.csv", &fewer.join("\n"));
    place.fails("certify ellipse.svg --check c.json --samples fewer.csv --quiet", 1, &["rejected", "other samples"]);
    place.fails("certify ellipse.svg --check c.json --epsilon 0.4 --quiet", 1, &["rejected", "0.5"]);
    place.put("other.svg", &place.get("ellipse.svg").replace("ry=\"1\"", "ry=\"1.001\""));
    place.fails("certify other.svg --check c.json --quiet", 1, &["rejected", "another curve"]);
    // A claim that was changed.
    place.put("bold.json", &place.get("c.json").replace("\"epsilon\": 0.5", "\"epsilon\": 0.45"));
    place.fails("certify ellipse.svg --check bold.json --quiet", 1, &["rejected", "piece"]);
    // What a refuted one shows holds, and the answer is no.
    place.run("certify ellipse.svg --samples fewer.csv --epsilon 0.5 --quiet -o r.json");
    let ran = place.run("certify ellipse.svg --check r.json --quiet");
    assert!(ran.code == 1 && ran.out.starts_with("refuted at ("), "{} {}", ran.out, ran.err);
    place.put("broken.json", "{\"format\": 1}");
    place.fails("certify ellipse.svg --check broken.json", 3, &["broken.json", "certificate"]);
    place.fails("certify ellipse.svg --check c.json -o d.json", 2, &["--check"]);
}

#[test]
fn samples_are_placed_where_none_are_given() {
    let place = ellipse();
    assert_eq!(place.ok("certify ellipse.svg --epsilon 0.66 --quiet"), "proved\n");
}

#[test]
fn what_makes_no_sense_is_refused() {
    let place = ellipse();
    place.fails("certify ellipse.svg", 2, &["--epsilon"]);
    place.fails("certify ellipse.svg --epsilon 0", 2, &["epsilon"]);
    place.fails("certify ellipse.svg --epsilon 0.5 --slack 1", 2, &["slack"]);
    place.fails("certify ellipse.svg --epsilon 0.5 -o c.svg", 2, &["svg", "json"]);
    place.fails("certify none.svg --epsilon 0.5", 3, &["none.svg"]);
    place.put("bad.csv", "path,segment,t,x,y\n0,0,2,1,1\n");
    place.fails("certify ellipse.svg --samples bad.csv --epsilon 0.5", 3, &["bad.csv", "line 2"]);
    place.put("off.csv", "path,segment,t,x,y\n0,0,0.5,1,1\n");
    place.fails("certify ellipse.svg --samples off.csv --epsilon 0.5 --quiet", 1, &["line 2", "not on the curve"]);
}

#[test]
fn certified_samples_are_proved_and_hardly_more() {
    let place = ellipse();
    // A corner and a crossing, where lfs is 0.
    let strokes = r#"<svg xmlns="http://www.w3.org/2000/svg"><g fill="none"><path d="M0 0 C1 0.5 2 0.5 3 0 C3.2 1 3 2 2 3"/><path d="M1 -1 C1.2 0 1.6 1 1.5 2"/></g></svg>"#;
    place.put("strokes.svg", strokes);
    for drawing in ["ellipse.svg", "strokes.svg"] {
        let rows = |table: &str| table.lines().count() - 1;
        let plain = rows(&place.ok(&format!("sample {drawing} --epsilon 0.5 --quiet")));
        let certified = place.ok(&format!("sample {drawing} --epsilon 0.5 --certified --quiet"));
        let more = rows(&certified).saturating_sub(plain);
        assert!(more <= 1 + plain / 50, "{drawing}: {more} more than {plain}");
        place.put("certified.csv", &certified);
        let answer = place.ok(&format!("certify {drawing} --samples certified.csv --epsilon 0.5 --quiet -o c.json"));
        assert_eq!(answer, "proved\n", "{drawing}");
        assert_eq!(place.ok(&format!("certify {drawing} --check c.json --samples certified.csv --quiet")), "proved\n");
    }
    place.fails("sample ellipse.svg --certified --rho 0.5", 2, &["--rho"]);
    place.fails("sample ellipse.svg --slack 0.1", 2, &["--certified"]);
    place.fails("sample ellipse.svg --certified --slack 2", 2, &["slack"]);
    place.fails("sample ellipse.svg --certified --max-cells 3 --quiet", 1, &["could not be proved"]);
}

#[test]
fn lfs_comes_with_bounds() {
    let place = ellipse();
    let table = place.ok("lfs ellipse.svg --certified --width 0.05 --quiet");
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some("path,segment,t,x,y,lfs,lower,upper"));
    let mut rows = 0;
    for line in lines {
        let numbers: Vec<f64> = line.split(',').map(|v| v.parse().expect("a number")).collect();
        let [lfs, lower, upper] = [5, 6, 7].map(|i| numbers[i]);
        assert!(lower <= lfs * 1.002 && lfs * 0.998 <= upper, "{line}");
        assert!(upper - lower <= 0.05 * upper, "{line}");
        rows += 1;
    }
    assert!(rows > 20, "{rows}");
    // A point beside the curve has wider bounds, by its distance.
    place.put("points.txt", "5 2\n5.5 2\n");
    let beside = place.ok("lfs ellipse.svg --certified --at points.txt --quiet");
    let bounds: Vec<Vec<f64>> =
        beside.lines().skip(1).map(|l| l.split(',').skip(6).map(|v| v.parse().expect("a number")).collect()).collect();
    assert!(bounds[1][0] <= bounds[0][0] - 0.4 && bounds[1][1] >= bounds[0][1] + 0.4, "{bounds:?}");
    place.ok("lfs ellipse.svg --certified --quiet -o band.svg");
    assert!(place.get("band.svg").contains(r#"inkscape:label="band""#));
    let ran = place.run("lfs ellipse.svg --certified");
    assert!(ran.err.contains("reach from"), "{}", ran.err);
    place.fails("lfs ellipse.svg --width 0.1", 2, &["--certified"]);
    place.fails("lfs ellipse.svg --certified --width 0", 2, &["width"]);
}

#[test]
fn the_effective_epsilon_is_bracketed() {
    let place = ellipse();
    let answer = place.ok("certify ellipse.svg --samples samples.csv --epsilon 0.3 --effective --quiet");
    let numbers: Vec<f64> = answer.split_whitespace().filter_map(|w| w.parse().ok()).collect();
    let [lower, upper] = numbers[..] else { panic!("{answer}") };
    assert!(lower <= upper && upper <= 1.02 * lower && upper <= 0.5, "{answer}");
    place.fails("certify ellipse.svg --epsilon 0.5 --effective -o c.json", 2, &["--effective"]);
}
