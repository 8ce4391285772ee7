//! Every public function of the kernel against 256 bits.

use std::fs;
use std::path::{Path, PathBuf};

use feature_sampling_mpfr::truth::table::TABLE;
use feature_sampling_mpfr::truth::{Kind, SCALARS, document, scan};

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

#[test]
fn errors_are_within_the_table() {
    let mut failures = Vec::new();
    for entry in TABLE {
        let Kind::Measured(measured) = &entry.kind else { continue };
        for (i, scalar) in SCALARS.into_iter().enumerate() {
            let worst = measured.worst(i);
            let within = worst <= measured.allowed[i];
            if !within {
                failures.push(format!("{} in {scalar}: {worst} ulp, allowed {}", entry.function, measured.allowed[i]));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_public_function_has_an_entry() {
    let functions = scan::public_functions(&repository().join("src")).expect("the kernel's source");
    assert!(functions.len() > 100, "the scanner works: {}", functions.len());
    let known: Vec<&str> = TABLE.iter().map(|entry| entry.function).collect();
    let missing: Vec<&String> = functions.iter().filter(|name| !known.contains(&name.as_str())).collect();
    assert!(missing.is_empty(), "public functions without an entry in crates/mpfr/src/truth/table.rs: {missing:#?}");
    let gone: Vec<&&str> = known.iter().filter(|name| !functions.iter().any(|f| f == *name)).collect();
    assert!(gone.is_empty(), "entries without a public function: {gone:#?}");
    assert!(known.is_sorted(), "entries are in order");
    for entry in TABLE {
        if let Kind::Through(other) = entry.kind {
            let named = TABLE.iter().any(|e| e.function == other && matches!(e.kind, Kind::Measured(_)));
            assert!(named, "{}: {other} is no measured entry", entry.function);
        }
    }
}

#[test]
fn the_document_is_generated() {
    let text = fs::read_to_string(repository().join("docs/accuracy.md")).expect("docs/accuracy.md");
    let expected = document::without_measured(&(document::functions(false) + &document::others()));
    let found: Vec<String> = document::without_measured(&text);
    assert_eq!(found, expected, "run `cargo run --release -p feature-sampling-mpfr -- accuracy`");
}
