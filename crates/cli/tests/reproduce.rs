//! `fsample reproduce`: tables 1 and 2 in their small versions.

mod common;

use common::Place;

/// Columns of a CSV row by name.
fn column<'t>(header: &str, row: &'t str, name: &str) -> &'t str {
    let index = header.split(',').position(|column| column == name).expect("the column");
    row.split(',').nth(index).expect("the field")
}

#[test]
fn table1_in_all_forms() {
    let place = Place::with_drawing();
    place.ok("reproduce table1 --quick --curve drawing.svg -o out/deep --quiet");
    let read = |name: &str| place.get(&format!("out/deep/{name}"));
    let table = read("table1.csv");
    let (header, rows) = table.split_once('\n').expect("a header");
    let error = |sampler: &str, steps: &str| -> f64 {
        let row = rows.lines().find(|row| row.starts_with(&format!("drawing,{sampler},{steps},"))).expect("the row");
        column(header, row, "lfs_rmse").parse().expect("a number")
    };
    assert!(error("f64", "100") < error("f64", "10") / 20.0, "second order");
    assert!(error("f64", "100") < 1e-4, "and small");
    assert!(rows.contains("complex,paper printed,1000,3.329,"), "what the paper prints");
    let markdown = read("table1.md");
    assert!(markdown.contains("Ground truth: "), "it says which: {markdown}");
    assert!(!markdown.contains("Warning"), "a curve was given");
    let json: serde_json::Value = serde_json::from_str(&read("table1.json")).expect("JSON");
    assert_eq!(json["tables"].as_array().map(Vec::len), Some(3), "the table and the comparison of scalars");
    let agreement = read("table1-agreement.csv");
    let (header, rows) = agreement.split_once('\n').expect("a header");
    assert_eq!(rows.lines().count(), 4, "two scalars, two kinds of places: {agreement}");
    for row in rows.lines() {
        for what in ["unexplained", "lfs_beyond_bound"] {
            assert_eq!(column(header, row, what), "0", "{what}: {row}");
        }
        assert_ne!(column(header, row, "places"), "0", "{row}");
    }
    for plot in ["table1-lfs.svg", "table1-medial.svg", "table1-time.svg"] {
        let svg = read(plot);
        assert!(svg.contains("drawing f64") && !svg.contains("NaN"), "{plot}");
    }
}

#[test]
fn table2_in_shards() {
    let place = Place::with_drawing();
    place.put("other.csv", "0,0,0,0,30,25,70,-25,100,0\n1,0,0,40,30,10,70,10,100,40\n");
    let curves = "--quick --curve drawing.svg --curve other.csv --quiet";
    place.ok(&format!("reproduce table2 {curves} --shard 1/2 -o parts"));
    let second = place.ok(&format!("reproduce table2 {curves} --shard 2/2"));
    assert!(second.starts_with("# fsample reproduce, shard, layout 1\n# table2 of 2 units\n"), "{second}");
    place.put("second.csv", &second);
    let first = "parts/table2.shard-1-of-2.csv";
    let table = place.ok(&format!("reproduce table2 {curves} --merge {first} second.csv"));
    let names: Vec<_> = table.lines().skip(1).map(|row| row.split(',').next().unwrap_or_default()).collect();
    assert_eq!(names, ["drawing", "other", "bunny", "complex", "spiral"], "ours, then the printed ones");
    let (header, rows) = table.split_once('\n').expect("a header");
    for row in rows.lines().take(2) {
        assert_eq!(column(header, row, "lfs_differs"), "0", "one method, one result: {row}");
    }
    place.fails(&format!("reproduce table2 {curves} --merge {first}"), 3, &["unit 1 of 2 is in none of the shards"]);
    place.fails(
        &format!("reproduce table1 {curves} --merge {first}"),
        3,
        &["table2.shard-1-of-2.csv", "not of table1"],
    );
    let other = "reproduce table2 --quick --curve drawing.svg --quiet --merge";
    place.fails(&format!("{other} {first}"), 3, &["table2.shard-1-of-2.csv", "other curves"]);
    place.fails(&format!("{other} other.csv"), 3, &["other.csv: line 1", "no shard"]);
}

/// Two open strokes that cross, and one that ends on another: lfs is 0 in three places.
const CROSSING: &str = "0,0,0,0,30,40,70,60,100,100\n1,0,0,100,30,70,70,30,100,0\n2,0,20,80,20,60,30,50,20,20\n";

/// A table of Table 1 without its seconds.
fn untimed(table: &str) -> Vec<String> {
    let seconds = table.lines().next().and_then(|header| header.split(',').position(|name| name == "seconds"));
    let seconds = seconds.expect("a column of seconds");
    let row = |line: &str| {
        let cells = line.split(',').enumerate().filter(|(i, _)| *i != seconds);
        cells.map(|(_, cell)| cell).collect::<Vec<_>>().join(",")
    };
    table.lines().map(row).collect()
}

#[test]
fn open_and_crossing_strokes_in_shards_and_threads() {
    let place = Place::new();
    place.put("crossing.csv", CROSSING);
    let table1 = "reproduce table1 --quick --curve crossing.csv --quiet";
    let whole = untimed(&place.ok(&format!("{table1} --threads 1")));
    assert!(whole.iter().filter(|row| row.starts_with("crossing,")).count() >= 6, "{whole:#?}");
    assert_eq!(untimed(&place.ok(&format!("{table1} --threads 3"))), whole, "threads");
    for shard in 1..=3 {
        place.ok(&format!("{table1} --shard {shard}/3 -o parts"));
    }
    let file = |shard: u32| format!("parts/table1.shard-{shard}-of-3.csv");
    let merged = place.ok(&format!("{table1} --merge {} {} {}", file(3), file(1), file(2)));
    assert_eq!(untimed(&merged), whole, "shards, in any order");
    // The second part again in the place of the third.
    place.fails(&format!("{table1} --merge {} {} {}", file(1), file(2), file(2)), 3, &["in another shard already"]);
    let full = "reproduce table1 --curve crossing.csv --quiet";
    place.fails(&format!("{full} --merge {}", file(1)), 3, &["other options"]);
    place.put("cut.csv", &place.get(&file(1)).replace(",lfs,", ",lfs;"));
    place.fails(&format!("{table1} --merge cut.csv"), 3, &["cut.csv: line", "three fields"]);
}

#[test]
fn what_cannot_be_asked() {
    let place = Place::with_drawing();
    place.fails("reproduce table9", 2, &["table9"]);
    place.fails("reproduce table2 --shard 3/2", 2, &["1 ≤ I ≤ N"]);
    place.fails("reproduce table1 table2 --quick --curve drawing.svg", 2, &["-o DIR"]);
    place.fails("reproduce table2 --curve drawing.svg drawing.svg", 2, &["two curves are named “drawing”"]);
    place.fails("reproduce table2 --curve nothing.svg", 3, &["nothing.svg"]);
    place.fails("reproduce table2 --quick --curve drawing.svg -o drawing.svg", 4, &["drawing.svg"]);
}
