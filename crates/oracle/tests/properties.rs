//! The properties of the fuzz targets on random bytes, and on every file of the committed corpus.

use fsample_oracle::property;
use proptest::collection::vec;
use proptest::prelude::*;
use std::path::Path;

/// Runs a property on each file of a target's corpus and of its regressions.
fn replay(target: &str, property: impl Fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus").join(target);
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    assert!(!files.is_empty(), "{} holds a corpus", folder.display());
    for file in files {
        let data = std::fs::read(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        let run = std::panic::AssertUnwindSafe(|| property(&data));
        if let Err(cause) = std::panic::catch_unwind(run) {
            eprintln!("in {}", file.display());
            std::panic::resume_unwind(cause);
        }
    }
}

#[test]
fn corpus_of_roots() {
    replay("roots", property::roots);
}

#[test]
fn corpus_of_closest() {
    replay("closest", property::closest);
}

#[test]
fn corpus_of_svg() {
    replay("svg", property::document);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn roots_of_random_bytes(data in vec(any::<u8>(), 2..80)) {
        property::roots(&data);
    }

    #[test]
    fn closest_points_of_random_bytes(data in vec(any::<u8>(), 2..90)) {
        property::closest(&data);
    }

    #[test]
    fn path_data(data in "[MmLlHhVvCcSsQqTtAaZz0-9 .,eE+-]{0,120}") {
        property::document(data.as_bytes());
    }

    #[test]
    fn elements(data in "!(<(path d='[MLCZ0-9 .]{0,20}'|g|rect|circle|use|svg|line)( (id|x|y|r|width|transform|href)='[#a-z0-9(). ]{0,12}'){0,3}(/>|>)){0,6}") {
        property::document(data.as_bytes());
    }
}
