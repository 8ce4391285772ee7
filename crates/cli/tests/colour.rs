//! `fsample colour`, as a user runs it.

mod common;

use common::Place;

const ART: &str = r#"<?xml version="1.0"?>
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">
<style>path{fill:none;stroke:black}</style>
<defs/>
<!-- art --><path d="M55 20 A30 30 0 1 1 45 20"/>
<g id="hints"><circle cx="50" cy="50" r="2" fill="gold"/></g>
</svg>
"#;

/// The drawing is in the result byte for byte, the fills before it, the hints are gone.
#[test]
fn the_drawing_is_left_as_it_is() {
    let place = Place::new();
    place.put("art.svg", ART);
    let run = place.run_with(&["colour", "art.svg", "-o", "out.svg", "--report", "out.json", "--bleed", "0.5"], "");
    assert_eq!(run.code, 0, "{}", run.err);
    let out = std::fs::read_to_string(place.path("out.svg")).expect("a picture");
    let start = out.find("\n<g id=\"fills\">").expect("fills");
    let end = start + out[start..].find("</g>\n").expect("their end") + 5;
    assert!(out[start..end].contains("fill:#ffd700"), "the colour of the hint");
    assert!(out[start..end].contains("stroke-width:0.5"), "the bleed");
    let hints = "<g id=\"hints\"><circle cx=\"50\" cy=\"50\" r=\"2\" fill=\"gold\"/></g>";
    assert_eq!(out[..start].to_owned() + &out[end..], ART.replace(hints, ""), "the rest is the document");
    assert!(start < out.find("<!-- art -->").expect("the drawing"), "colours lie under the strokes");
    let report: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(place.path("out.json")).expect("a report")).expect("JSON");
    let gold = report["regions"].as_array().expect("regions").iter().find(|r| r["colour"] == "#ffd700").expect("gold");
    assert_eq!(gold["hints"], serde_json::json!([1]), "its hint");
    let gap = gold["gaps"][0]["length"].as_f64().expect("a gap");
    assert!((gap - 10.0).abs() < 0.01, "the gap is 10 wide, not {gap}");
}

#[test]
fn the_same_bytes_for_any_number_of_threads_and_order_of_hints() {
    let place = Place::new();
    place.put("art.svg", ART);
    let hints = ["50,50,gold", "50,5,#abc"];
    let run = |first: &str, second: &str, threads: &str| {
        place
            .run_with(&["colour", "art.svg", "--quiet", "--hint", first, "--hint", second, "--threads", threads], "")
            .out
    };
    let out = run(hints[0], hints[1], "1");
    assert!(out.contains("#aabbcc") && out.contains("#ffd700"), "both colours");
    assert_eq!(out, run(hints[0], hints[1], "3"), "threads");
    assert_eq!(out, run(hints[1], hints[0], "2"), "order");
}

#[test]
fn what_cannot_be_done_is_said() {
    let place = Place::new();
    place.put("art.svg", &ART.replace("hints", "other"));
    place.put("bad.csv", "1,2,red\n3,4\n");
    let cases: [(&[&str], i32, &str); 7] = [
        (&[], 2, "there are no hints"),
        (&["--hint", "1,2"], 2, "is not a hint"),
        (&["--hint", "1,2,nonsuch"], 2, "is not a colour"),
        (&["--hints", "bad.csv"], 3, "bad.csv: line 2"),
        (&["--hint-layer", "nowhere"], 3, "no hint in a layer"),
        (&["--auto", "--hint", "1,2,red"], 2, "cannot be used"),
        (&["--auto", "--gamma", "2"], 2, "--gamma is 2"),
    ];
    for (options, code, message) in cases {
        let arguments: Vec<&str> =
            ["colour", "art.svg", "-o", "out.svg"].into_iter().chain(options.iter().copied()).collect();
        let run = place.run_with(&arguments, "");
        assert_eq!((run.code, run.err.contains(message)), (code, true), "{options:?}: {}", run.err);
        assert!(!place.path("out.svg").exists(), "{options:?}: nothing is written");
    }
    let run = place.run_with(&["colour", "art.svg", "--hint-layer", "other", "-o", "out.svg"], "");
    assert_eq!(run.code, 0, "a layer by another name: {}", run.err);
}

/// Fewer samples change triangles, not which hint fills which room.
#[test]
fn the_same_rooms_for_any_epsilon() {
    let place = Place::new();
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    for (drawing, hints) in [
        ("elephant_outline_matthe_r", "elephant"),
        ("sleeping_cat_ron_golan_01", "cat"),
        ("snail", "snail"),
        ("fish", "fish"),
        ("deer", "deer"),
    ] {
        let files = [format!("drawings/{drawing}.svg"), format!("docs/pictures/hints/{hints}.csv")];
        let [drawing, hints] =
            files.map(|file| root.join(file)).map(|path| path.to_str().expect("a path in UTF-8").to_owned());
        let rooms = |epsilon: &str| {
            let options =
                ["colour", &drawing, "--hints", &hints, "--epsilon", epsilon, "-o", "out.svg", "--report", "out.json"];
            let run = place.run_with(&options, "");
            assert_eq!(run.code, 0, "{}", run.err);
            let report: serde_json::Value = serde_json::from_str(&place.get("out.json")).expect("JSON");
            let regions = report["regions"].as_array().expect("regions").iter();
            // By hint: its colour, the other hints in its room, and the room's area.
            let mut rooms: Vec<(String, f64)> = regions
                .filter(|region| region["hints"].as_array().is_some_and(|hints| !hints.is_empty()))
                .map(|region| {
                    let name = format!("{} {}", region["hints"], region["colour"]);
                    (name, region["area"].as_f64().expect("an area"))
                })
                .collect();
            rooms.sort_by(|a, b| a.0.cmp(&b.0));
            rooms
        };
        let dense = rooms("0.4");
        assert!(dense.len() >= 4, "{dense:?}");
        for epsilon in ["0.5", "0.6", "0.7"] {
            let found = rooms(epsilon);
            let names = |rooms: &[(String, f64)]| rooms.iter().map(|room| room.0.clone()).collect::<Vec<_>>();
            assert_eq!(names(&found), names(&dense), "{drawing} at {epsilon}");
            let all: f64 = dense.iter().map(|room| room.1).sum();
            for (room, dense) in found.iter().zip(&dense) {
                assert!((room.1 - dense.1).abs() < 0.05 * all, "{drawing} at {epsilon}: {room:?} was {dense:?}");
            }
        }
    }
}
