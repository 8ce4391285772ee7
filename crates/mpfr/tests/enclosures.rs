//! Proved bounds of lfs in `f64` meet those in 128 bits, on drawings that ship.

use std::path::Path;

use feature_sampling_mpfr::enclosures::{Compared, Question, compare};

#[test]
fn bounds_meet_on_drawings() {
    for name in ["leaf_01.svg", "elephant_outline_matthe_r.svg"] {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../drawings").join(name);
        let drawing = lineart::drawing::load(&file).expect("it ships");
        let strokes: Vec<_> = drawing.paths.into_iter().map(|path| (path.closed, path.cubics)).collect();
        let question = Question { corner_degrees: 1.0, tolerance: 0.1, share: 0.1, points: 3, seed: 7 };
        let rows = compare(&strokes, &question).expect("a curve");
        assert_eq!(rows.len(), 3, "{name}");
        for row in &rows {
            assert!(row.agrees(), "{name}: {row:?}");
            let [lower, upper] = row.plain;
            assert!(lower > 0.0 && lower >= 0.89 * upper, "{name}: a bound worth the name: {row:?}");
        }
    }
}

#[test]
fn what_does_not_agree_is_seen() {
    let at = feature_sampling::geometry::Point::new(0.0, 0.0);
    let row = Compared { at, plain: [1.0, 2.0], wide: [1.5, 2.5], judge: 2.25 };
    assert!(row.agrees());
    assert!(!Compared { plain: [0.5, 1.25], ..row.clone() }.agrees(), "apart");
    assert!(!Compared { plain: [2.75, 3.0], ..row.clone() }.agrees(), "apart the other way");
    assert!(!Compared { judge: 1.25, ..row }.agrees(), "a lower bound above a distance to the medial axis");
}
