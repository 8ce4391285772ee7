//! The study on true ε-samples of curves, and on the published sets where they are at hand.

use std::path::PathBuf;

use fsample_experiments::shard::{self, Shard};
use fsample_experiments::source::Source;
use fsample_experiments::study::{GivenSets, Grid, Study};
use fsample_experiments::table3::Table3;
use lineart::reconstruct::Algorithm;

fn data(file: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("FSAMPLE_DATA")
        .map_or_else(|| PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")), PathBuf::from);
    let path = folder.join(file);
    if !path.exists() {
        eprintln!("skipped: {} is not there", path.display());
        return None;
    }
    Some(path)
}

/// CompatibleCrust is proved to be right for ε up to 0.66.
fn compatible_crust_is_right(source: &Source) {
    let study = Study::new(Some(source.clone()), Grid::quick(), None);
    let algorithms = [Algorithm::CompatibleCrust, Algorithm::CompatibleCrustMutual, Algorithm::Accord];
    for epsilon in [0.3, 0.5, 0.58, 0.62, 0.64, 0.66] {
        for start in 0..20 {
            let start = f64::from(start) / 20.0;
            let set = study.sample(source, epsilon, start).expect("samples");
            let correct = set.correct(&algorithms).expect("finite");
            assert_eq!(correct, [true; 3], "{}: ε = {epsilon}, start {start}", source.name);
        }
    }
}

#[test]
fn compatible_crust_on_the_shipped_curve() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../drawings/hook.svg");
    let drawing = lineart::svg::read_file(file.as_ref()).expect("a drawing");
    compatible_crust_is_right(&Source::new(&drawing, true));
}

#[test]
fn compatible_crust_on_the_papers_curves() {
    for name in ["complex", "spiral", "simple", "blob2", "bunny"] {
        let Some(file) = data(&format!("drawings/{name}.svg")) else { continue };
        let drawing = lineart::svg::read_file(&file).expect("a drawing");
        compatible_crust_is_right(&Source::new(&drawing, false));
    }
}

/// Sharding changes nothing, nor does the number of threads.
#[test]
fn shards_and_threads() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../drawings/hook.svg");
    let curve = Source::new(&lineart::svg::read_file(file.as_ref()).expect("a drawing"), true);
    let table = || Table3::new(Study::new(Some(curve.clone()), Grid::new(100, 4), None));
    let run = |index, of, threads| shard::run(&table(), Shard { index, of }, threads, &|_, _| ()).expect("done");
    let whole = shard::merge(&table(), vec![("whole".into(), run(1, 1, 1))]).expect("a report");
    let parts = [(1, 3), (2, 1), (3, 2)].map(|(index, threads)| (index.to_string(), run(index, 3, threads)));
    let merged = shard::merge(&table(), parts.to_vec()).expect("a report");
    assert_eq!(merged.markdown(), whole.markdown(), "to the byte");
}

/// Sets in the form of the published ones. The full table is `fsample reproduce table3 --samples …`.
#[test]
fn reading_published_sets() {
    let text = "set 0 0 3\n0 0\n1 0\n0.5 0.8\nset 16 1 3\n0 0\n1 0\n0.5 0.8\n";
    let given = GivenSets::read(text, "triangles.sets").expect("sets");
    let table = Table3::new(Study::new(None, Grid::paper(), Some(given)));
    let part = shard::run(&table, Shard::WHOLE, 2, &|_, _| ()).expect("done");
    let csv = shard::merge(&table, vec![("x".into(), part)]).expect("a report").csv();
    assert!(csv.contains("\ncrust,0.25,100.0,>0.66,0.66,"), "three edges: {csv}");
    assert!(csv.contains("\npeel,-,0.0,<0.50,<0.50,"), "two edges: {csv}");
}
