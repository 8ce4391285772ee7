//! The reconstruction algorithms on small point sets whose answers were worked out by an independent implementation on
//! another triangulation library: `points/*.xy`, points of one curve after the other, in order along each.

use std::collections::BTreeSet;
use std::path::Path;

use feature_sampling::geometry::Point;
use lineart::reconstruct::{Algorithm, Sites};

type Edges = BTreeSet<(usize, usize)>;

const EVERY: [Algorithm; 10] = Algorithm::MAIN;
/// Those that make one polygon of everything.
const ONE_POLYGON: [Algorithm; 2] = [Algorithm::Connect2d, Algorithm::Sigdt];

fn points(name: &str) -> Vec<Point<f64>> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/points").join(format!("{name}.xy"));
    let text = std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let number = |field: &str| field.parse().expect("a number");
    let point = |line: &str| line.split_once(' ').map(|(x, y)| Point::new(number(x), number(y))).expect("two numbers");
    text.lines().map(point).collect()
}

fn edges(name: &str, algorithm: Algorithm) -> Edges {
    algorithm.edges(&Sites::new(&points(name)).expect("finite")).into_iter().collect()
}

/// Consecutive numbers, and the closing edge.
fn ring(from: usize, count: usize) -> Edges {
    let mut all = chain(&(from..from + count).collect::<Vec<_>>());
    all.insert((from, from + count - 1));
    all
}

fn chain(numbers: &[usize]) -> Edges {
    numbers.windows(2).map(|w| (w[0].min(w[1]), w[0].max(w[1]))).collect()
}

fn rings(counts: [usize; 2]) -> Edges {
    &ring(0, counts[0]) | &ring(counts[0], counts[1])
}

#[track_caller]
fn expect(name: &str, algorithm: Algorithm, truth: &Edges, missing: &[(usize, usize)], extra: &[(usize, usize)]) {
    let found = edges(name, algorithm);
    let list = |of: &[(usize, usize)]| of.iter().copied().collect::<Edges>();
    let difference = (truth - &found, &found - truth);
    assert_eq!(difference, (list(missing), list(extra)), "{name}, {}: missing and extra", algorithm.name());
}

/// Every site has two edges and all are connected.
#[track_caller]
fn expect_one_polygon(name: &str, algorithm: Algorithm) {
    let found = edges(name, algorithm);
    let count = points(name).len();
    let (mut at, mut before, mut steps) = (0, usize::MAX, 0);
    while steps == 0 || at != 0 {
        let next: Vec<usize> =
            found.iter().filter_map(|&(a, b)| if a == at { Some(b) } else { (b == at).then_some(a) }).collect();
        assert_eq!(next.len(), 2, "{name}, {}: degree of {at}", algorithm.name());
        let to = if next[0] == before { next[1] } else { next[0] };
        (before, at, steps) = (at, to, steps + 1);
        assert!(steps <= count, "{name}, {}: a tail", algorithm.name());
    }
    assert_eq!((steps, found.len()), (count, count), "{name}, {}: one polygon", algorithm.name());
}

#[test]
fn regular_polygons() {
    for algorithm in EVERY {
        expect("t1_12gon", algorithm, &ring(0, 12), &[], &[]);
        expect("t1_hexagon", algorithm, &ring(0, 6), &[], &[]);
        if algorithm == Algorithm::Crawl {
            assert_eq!(edges("t1_5gon", algorithm).len(), 4, "too few sites to close");
            assert!(edges("t1_5gon", algorithm).is_subset(&ring(0, 5)), "no chord");
        } else {
            expect("t1_5gon", algorithm, &ring(0, 5), &[], &[]);
        }
    }
}

#[test]
fn triangle() {
    let count = |algorithm| edges("t1_triangle", algorithm).len();
    for algorithm in [Algorithm::Crust, Algorithm::Connect2d, Algorithm::Sigdt] {
        assert_eq!(count(algorithm), 3, "{}", algorithm.name());
    }
    for algorithm in [Algorithm::Peel, Algorithm::HnnCrust, Algorithm::NnCrust, Algorithm::CompatibleCrust] {
        assert_eq!(count(algorithm), 2, "{}: no two rounded sides are equal", algorithm.name());
    }
    assert_eq!(count(Algorithm::ConservativeCrust), 0, "the centre is near all three midpoints");
}

#[test]
fn two_circles_apart() {
    for algorithm in EVERY {
        if ONE_POLYGON.contains(&algorithm) {
            let (missing, extra) = ([(0, 15), (23, 24)], [(0, 23), (15, 24)]);
            expect("t2_two_circles_far", algorithm, &rings([16, 16]), &missing, &extra);
            expect_one_polygon("t2_two_circles_far", algorithm);
        } else {
            expect("t2_two_circles_far", algorithm, &rings([16, 16]), &[], &[]);
        }
    }
    expect("t2_two_circles_far", Algorithm::SigdtComponents, &rings([16, 16]), &[], &[]);
}

#[test]
fn concentric_circles() {
    for algorithm in EVERY {
        if ONE_POLYGON.contains(&algorithm) {
            expect_one_polygon("t3_concentric", algorithm);
        } else {
            expect("t3_concentric", algorithm, &rings([32, 16]), &[], &[]);
        }
    }
    expect("t3_concentric", Algorithm::SigdtComponents, &rings([32, 16]), &[], &[]);
}

#[test]
fn circles_with_a_gap_above_their_spacing() {
    for algorithm in EVERY {
        match algorithm {
            Algorithm::Connect2d | Algorithm::Sigdt => expect_one_polygon("t3_two_circles_gap05", algorithm),
            Algorithm::ConservativeCrust => {
                expect("t3_two_circles_gap05", algorithm, &rings([16, 16]), &[], &[(0, 24)]);
            }
            _ => expect("t3_two_circles_gap05", algorithm, &rings([16, 16]), &[], &[]),
        }
    }
}

#[test]
fn circles_with_a_gap_below_their_spacing() {
    let name = "t3_two_circles_gap02";
    for algorithm in EVERY {
        assert!(edges(name, algorithm).contains(&(0, 24)), "{}: the bridge", algorithm.name());
    }
    let truth = rings([16, 16]);
    let extra = [(0, 24), (1, 23), (15, 25)];
    expect(name, Algorithm::Crust, &truth, &[], &extra);
    expect(name, Algorithm::ConservativeCrust, &truth, &[], &extra);
    let lost = &truth - &edges(name, Algorithm::NnCrust);
    assert!([(0, 15), (23, 24)].iter().all(|edge| lost.contains(edge)), "nn-crust misses {lost:?}");
    for algorithm in [Algorithm::Peel, Algorithm::HnnCrust] {
        let lost = &truth - &edges(name, algorithm);
        assert_eq!(lost, [(0, 1), (0, 15), (23, 24), (25, 26)].into_iter().collect(), "{}", algorithm.name());
    }
}

#[test]
fn a_square_has_right_angles() {
    for algorithm in EVERY {
        expect("t4_square32", algorithm, &ring(0, 32), &[], &[]);
    }
}

#[test]
fn a_sheared_square() {
    let (name, truth) = ("t4_parallelogram32", ring(0, 32));
    for algorithm in [
        Algorithm::Crust,
        Algorithm::NnCrust,
        Algorithm::NnCrustDegreeOne,
        Algorithm::HnnCrust,
        Algorithm::Peel,
        Algorithm::Crawl,
        Algorithm::Connect2d,
        Algorithm::Sigdt,
    ] {
        expect(name, algorithm, &truth, &[], &[]);
    }
    expect(name, Algorithm::CompatibleCrust, &truth, &[(16, 17)], &[(15, 17)]);
    expect(name, Algorithm::CompatibleCrustMutual, &truth, &[(16, 17)], &[]);
    expect(name, Algorithm::AccordUnseeded, &truth, &[(0, 1), (16, 17)], &[]);
    expect(name, Algorithm::ConservativeCrust, &truth, &[(0, 1), (16, 17)], &[]);
}

#[test]
fn a_sharp_wedge() {
    let (name, truth) = ("t4_sharp_wedge", chain(&[7, 6, 5, 4, 3, 2, 1, 0, 8, 9, 10, 11, 12, 13, 14, 15, 16]));
    expect(name, Algorithm::Crust, &truth, &[], &[(0, 9)]);
    expect(name, Algorithm::Connect2d, &truth, &[], &[(7, 16)]);
    expect(name, Algorithm::Sigdt, &truth, &[], &[(7, 16)]);
    for algorithm in [Algorithm::Peel, Algorithm::HnnCrust, Algorithm::ConservativeCrust, Algorithm::AccordUnseeded] {
        expect(name, algorithm, &truth, &[(0, 8), (8, 9)], &[(0, 9)]);
    }
    for algorithm in [Algorithm::NnCrust, Algorithm::CompatibleCrust] {
        expect(name, algorithm, &truth, &[(8, 9)], &[(0, 9)]);
    }
}

#[test]
fn open_curves() {
    let arc = chain(&(0..11).collect::<Vec<_>>());
    let line = chain(&(0..8).collect::<Vec<_>>());
    for algorithm in EVERY {
        match algorithm {
            Algorithm::Connect2d | Algorithm::Sigdt => {
                expect("t5_open_arc", algorithm, &arc, &[], &[(0, 10)]);
                expect_one_polygon("t5_open_line", algorithm);
            }
            Algorithm::Crawl => {
                expect("t5_open_arc", algorithm, &arc, &[(0, 1)], &[(1, 10)]);
                expect("t5_open_line", algorithm, &line, &[], &[]);
            }
            _ => {
                expect("t5_open_arc", algorithm, &arc, &[], &[]);
                expect("t5_open_line", algorithm, &line, &[], &[]);
            }
        }
    }
}

#[test]
fn necks() {
    let has = |algorithm, list: [(usize, usize); 2]| {
        let found = edges("t6_neck_rect_w24", algorithm);
        list.map(|edge| found.contains(&edge))
    };
    for algorithm in [Algorithm::CompatibleCrust, Algorithm::NnCrust, Algorithm::HnnCrust, Algorithm::Peel] {
        assert_eq!(has(algorithm, [(0, 1), (2, 3)]), [true; 2], "{}: short pairing", algorithm.name());
        assert_eq!(has(algorithm, [(0, 3), (1, 2)]), [false; 2], "{}: long pairing", algorithm.name());
    }
    for algorithm in [Algorithm::Crust, Algorithm::ConservativeCrust] {
        assert_eq!(has(algorithm, [(0, 1), (2, 3)]), [true; 2], "{}: short pairing", algorithm.name());
        assert_eq!(has(algorithm, [(0, 3), (1, 2)]), [true; 2], "{}: long pairing too", algorithm.name());
    }
    // Ambiguous by symmetry: any answer, but always the same.
    for algorithm in Algorithm::ALL {
        assert_eq!(edges("t6_neck_square", algorithm), edges("t6_neck_square", algorithm), "{}", algorithm.name());
    }
}

#[test]
fn sparse_beside_dense() {
    for (algorithm, expected) in [
        (Algorithm::Crust, [8, 0, 48]),
        (Algorithm::AccordUnseeded, [8, 0, 48]),
        (Algorithm::HnnCrust, [2, 0, 48]),
        (Algorithm::Peel, [0, 0, 48]),
        (Algorithm::NnCrust, [5, 9, 48]),
    ] {
        let mut found = [0; 3];
        for (a, b) in edges("t7_sparse_dense", algorithm) {
            found[usize::from(a >= 9) + usize::from(b >= 9)] += 1;
        }
        assert_eq!(found, expected, "{}: sparse, across, dense", algorithm.name());
    }
}

#[test]
fn gaps_that_grow_geometrically() {
    for algorithm in Algorithm::ALL {
        let found = edges("t8_geometric", algorithm);
        assert!(found.iter().all(|&(a, b)| a < b && b < 6), "{}: {found:?}", algorithm.name());
    }
}
