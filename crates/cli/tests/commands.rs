//! What the commands answer, and that they answer it every time alike.

mod common;

use common::{Place, shipped_drawings, table};
use serde_json::Value;

const SAMPLES: &str = "path,segment,t,x,y,lfs,bound";

#[test]
fn same_bytes_every_time_and_on_any_number_of_threads() {
    let place = Place::new();
    for drawing in shipped_drawings() {
        let file = drawing.to_str().expect("a name in UTF-8");
        for format in ["csv", "svg"] {
            let run = |threads: &str| {
                let ran = place.run_with(&["sample", file, "--format", format, "--quiet", "--threads", threads], "");
                assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{file}: quiet is quiet");
                ran.out
            };
            let one = run("1");
            assert!(one == run("2") && one == run("5"), "{file} as {format}: the same bytes");
        }
    }
}

#[test]
fn bounds_are_kept() {
    let place = Place::with_drawing();
    let gaps = |options: &str| {
        let rows = table(&place.ok(&format!("sample drawing.svg --quiet {options}")), SAMPLES);
        let point = |row: &Vec<String>| -> (f64, f64) { (row[3].parse().expect("x"), row[4].parse().expect("y")) };
        rows.windows(2)
            .filter(|pair| pair[0][0] == pair[1][0])
            .map(|pair| (point(&pair[0]), point(&pair[1])))
            .map(|(a, b)| (a.0 - b.0).hypot(a.1 - b.1))
            .collect::<Vec<_>>()
    };
    let plain = gaps("");
    assert!(gaps("--epsilon 0.2").len() > plain.len(), "a smaller ε makes more samples");
    assert!(gaps("--rho 0.5").len() >= plain.len(), "ρ asks for no less than ε");
    assert!(gaps("--max-distance 3").iter().all(|gap| *gap <= 3.0), "no gap above the largest distance");
    assert!(gaps("--max-distance 1.5mm").iter().all(|gap| *gap <= 3.0), "in millimetres, two units each");
    assert!(gaps("--epsilon 0.05 --min-distance 4").iter().all(|gap| *gap >= 4.0 - 1e-9), "none below the smallest");
    assert!(gaps("--chord-error 0.01mm").len() > plain.len(), "a chord error makes more samples");
}

#[test]
fn the_summary_says_what_happened() {
    let place = Place::with_drawing();
    let err = place.run("sample drawing.svg --epsilon 0.05 --min-distance 4").err;
    assert_eq!(err.lines().count(), 1, "one line: {err}");
    for word in ["drawing.svg", "samples on 2 paths", "gaps ", "smallest lfs ", "min-distance won at ", " s"] {
        assert!(err.contains(word), "“{word}” is missing: {err}");
    }
    assert!(place.run("sample drawing.svg --quiet").err.is_empty(), "quiet");
}

#[test]
fn inspect_in_both_forms() {
    let place = Place::with_drawing();
    let text = place.ok("inspect drawing.svg");
    for word in ["100 mm × 50 mm", "2: 1 closed, 1 open", "layer outlines (first): 1 path", "path blob", "2 open ends"]
    {
        assert!(text.contains(word), "“{word}” is missing: {text}");
    }
    let value: Value = serde_json::from_str(&place.ok("inspect drawing.svg --format json")).expect("valid JSON");
    assert_eq!(value["view_box"], serde_json::json!([0, 0, 200, 100]), "frame");
    assert_eq!(value["cubics"], 3, "cubics");
    assert_eq!(value["user_units_per_mm"], 2, "units");
    assert_eq!(value["paths"][0]["closed"], true, "closed");
    assert_eq!(value["joints"]["open"], 2, "open ends");
    assert_eq!(value["groups"][1]["label"], "lines", "layers");
    place.put("warned.svg", r#"<svg xmlns="http://www.w3.org/2000/svg"><text>a</text><path d="M0,0 L1,1"/></svg>"#);
    let value: Value = serde_json::from_str(&place.ok("inspect warned.svg --format json")).expect("valid JSON");
    assert_eq!(value["warnings"].as_array().map(Vec::len), Some(1), "warnings");
}

#[test]
fn compare_in_three_forms() {
    let place = Place::with_drawing();
    let text = place.ok("compare drawing.svg --quiet");
    for word in ["epsilon", "epsilon+chord", "greedy-chord", "uniform", "pieces", "g5-splitter", "missing edges"] {
        assert!(text.contains(word), "“{word}” is missing: {text}");
    }
    let header = "method,setting,points,edges,chord_error_mm,missing_edges,grading,min_gap_mm,max_gap_mm";
    let rows = table(&place.ok("compare drawing.svg --quiet --format csv --min-distance 0.05mm"), header);
    assert_eq!(rows.len(), 7, "with the smallest distance there is one more");
    for row in &rows {
        let error: f64 = row[4].parse().expect("a number");
        // ε alone and the G5 splitter promise no chord error.
        if !["epsilon", "g5-splitter"].contains(&row[0].as_str()) {
            assert!(error <= 0.1 * (1.0 + 1e-6), "the chord error is kept: {row:?}");
        }
        if row[0] == "epsilon" {
            assert_eq!(row[5], "0", "an ε-sample has Delaunay edges: {row:?}");
        }
    }
    let value: Value =
        serde_json::from_str(&place.ok("compare drawing.svg --quiet --format json")).expect("valid JSON");
    assert_eq!(value["methods"].as_array().map(Vec::len), Some(6), "six methods");
    let diagonal = |options: &str| {
        let text = place.ok(&format!("compare drawing.svg --quiet --format json {options}"));
        serde_json::from_str::<Value>(&text).expect("valid JSON")["diagonal_mm"].as_f64().expect("a number")
    };
    assert!((diagonal("--diagonal 15cm") - 150.0).abs() < 1e-9, "the size that was asked for");
}

#[test]
fn help_completions_and_manual_pages() {
    let place = Place::new();
    for command in ["sample", "medial", "lfs", "inspect", "compare", "completions", "man"] {
        let help = place.ok(&format!("{command} --help"));
        assert!(help.contains("Examples:\n") && help.contains("Usage: fsample "), "{command}: {help}");
        assert!(!help.contains("fsj"), "{command}: a format that is not there yet is not in the help");
        let page = place.ok(&format!("man {command}"));
        assert!(page.contains(".TH") && page.contains(command), "{command}: a manual page");
    }
    assert!(place.ok("--version").starts_with("fsample "), "version");
    assert!(place.ok("man").contains(".TH fsample"), "the page of the program");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        assert!(place.ok(&format!("completions {shell}")).contains("fsample"), "{shell}");
    }
    let nothing = place.run("");
    assert_eq!((nothing.code, nothing.out.as_str()), (2, ""), "nothing asked is a usage error");
    assert!(nothing.err.contains("Usage:"), "with help: {}", nothing.err);
}
