//! The noder against an independent judge, on random stroke sets, and on cases whose answer is known.

#[path = "common/strokes.rs"]
mod strokes;

use lineart::drawing::{Drawing, DrawingPath};
use lineart::node::{Chain, NodeError, Noded, Options, node};

/// A few sets of each kind; `cargo run --release -p lineart --example node_survey` examines 100 000.
#[test]
fn random_strokes_are_noded() {
    for (kind, name) in strokes::KINDS.iter().enumerate() {
        for seed in 0..12 {
            let verdict = strokes::examine(kind, seed);
            assert!(verdict.is_ok(), "{name}, seed {seed}: {verdict:?}");
            let is_noded =
                verdict.is_ok_and(|v| v.edges > 0 && v.rounds <= 30 && [4.0, 16.0, 64.0].contains(&v.units.round()));
            assert!(is_noded, "{name}, seed {seed}: something was noded, on one of the lattices");
        }
    }
}

/// Found by the survey: chords that bulge far from their curves were led through vertices of strokes that touch the chord
/// only, beside it or at a sharp corner with it.
#[test]
fn no_vertex_is_far_from_its_curve() {
    for seed in [1798, 3396, 7053, 7493, 8674, 13163, 17884, 18311, 18695] {
        let verdict = strokes::examine(0, seed);
        assert!(verdict.is_ok(), "seed {seed}: {verdict:?}");
    }
}

/// Found by the survey: among copies that lie a few units of the lattice from each other a segment was led up to five pitches
/// astray, or was cut again and again.
#[test]
fn near_copies_settle_within_a_pitch() {
    for seed in [1881, 5521, 6066, 7462, 8835, 13681, 16917, 17190, 17860, 19026, 19681] {
        let verdict = strokes::examine(3, seed);
        assert!(verdict.is_ok(), "seed {seed}: {verdict:?}");
    }
}

/// A path that runs to and fro within one parameter: its pieces there have an order, though not the first that comes to mind.
#[test]
fn paths_that_turn_back_on_the_spot_are_followed() {
    for seed in [14677, 17744] {
        let verdict = strokes::examine(3, seed);
        assert!(verdict.is_ok(), "seed {seed}: {verdict:?}");
    }
}

/// The judge is able to say no: the chains as they are, not noded.
#[test]
fn the_judge_sees_a_crossing() {
    let drawing = drawing(&["M0 0L2 2", "M0 2L2 0"]);
    let chains = [0, 1].map(|path| Chain { path, closed: false, at: vec![0.0, 1.0] });
    let each = |i: usize| node(&drawing.paths, &chains[i..=i], &Options::new(1e-6)).expect("one line");
    let (first, second) = (each(0), each(1));
    let segment = |noded: &Noded| noded.edges[0].ends.map(|v| noded.vertices[v as usize].place);
    assert!(strokes::clash(segment(&first), segment(&second)), "two diagonals");
    let noded = node(&drawing.paths, &chains, &Options::new(1e-6)).expect("noded");
    assert!(strokes::judge(&drawing.paths, &chains, &noded, 1e-6).is_ok(), "and what was made of them");
    assert!(strokes::judge(&drawing.paths, &chains, &first, 1e-6).is_err(), "one of the chains is missing");
}

fn drawing(paths: &[&str]) -> Drawing {
    let paths: String = paths.iter().map(|d| format!("<path d=\"{d}\"/>")).collect();
    let text = format!("<svg xmlns=\"http://www.w3.org/2000/svg\">{paths}</svg>");
    lineart::svg::read_str(&text, "test").expect("a drawing")
}

/// Every joint and eight places on each cubic.
fn chains(paths: &[DrawingPath]) -> Vec<Chain> {
    let chain = |(path, stroke): (usize, &DrawingPath)| {
        let last = 8 * stroke.cubics.len();
        let at = (0..if stroke.closed { last } else { last + 1 }).map(|i| i as f64 / 8.0).collect();
        Chain { path, closed: stroke.closed, at }
    };
    paths.iter().enumerate().map(chain).collect()
}

fn noded(paths: &[&str], pitch: f64) -> (Drawing, Noded) {
    let drawing = drawing(paths);
    let chains = chains(&drawing.paths);
    let noded = node(&drawing.paths, &chains, &Options::new(pitch)).expect("noded");
    let verdict = strokes::judge(&drawing.paths, &chains, &noded, pitch);
    assert!(verdict.is_ok(), "{paths:?}: {verdict:?}");
    (drawing, noded)
}

/// How many edges end in each vertex.
fn degrees(noded: &Noded) -> Vec<usize> {
    let mut degrees = vec![0; noded.vertices.len()];
    noded.edges.iter().flat_map(|edge| edge.ends).for_each(|v| degrees[v as usize] += 1);
    degrees
}

/// A crossing of two curves is cut at the parameters of the curves' intersection, not of their chords.
#[test]
fn crossings_are_those_of_the_curves() {
    // y = x²/4 for x in 0…4, as a quadratic with x = 4t; and the line y = 1: they cross at x = 2, t = 1/2. And a second
    // line y = 3, at x = √12.
    let (_, noded) = noded(&["M0 0Q2 0 4 4", "M-1 1L4.3 1", "M-1 3L4.3 3"], 1e-6);
    let mut crossings = Vec::new();
    for ((v, number), degree) in noded.vertices.iter().zip(0_u32..).zip(degrees(&noded)) {
        if degree == 4 {
            let on_curve = noded
                .edges
                .iter()
                .filter(|edge| edge.ends.contains(&number))
                .flat_map(|edge| noded.owners(edge).iter().map(move |owner| (edge, owner)))
                .filter(|(_, owner)| owner.path == 0)
                .map(|(edge, owner)| owner.at[usize::from(edge.ends[1] == number)]);
            let parameters: Vec<f64> = on_curve.collect();
            assert_eq!(parameters.len(), 2, "the curve goes on");
            assert_eq!(parameters[0], parameters[1], "at one parameter");
            crossings.push((parameters[0], v.exact));
        }
    }
    crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
    let expected = [(0.5, 2.0, 1.0), (12.0_f64.sqrt() / 4.0, 12.0_f64.sqrt(), 3.0)];
    assert_eq!(crossings.len(), 2, "two crossings");
    for ((t, p), (u, x, y)) in crossings.iter().zip(expected) {
        assert!((t - u).abs() < 1e-12, "parameter {t}");
        assert!((p.x - x).abs() < 1e-11 && (p.y - y).abs() < 1e-11, "point {p:?}");
    }
}

/// A stroke that ends on another is joined to it, on it or a little short of it or beyond.
#[test]
fn junctions_are_joined() {
    for off in [0.0, -1e-9, 1e-9, -1e-7, 1e-7] {
        let stem = format!("M1 5L1 {}", 1.0 + off);
        let (_, noded) = noded(&["M0 1C1 1 1 1 2 1", &stem], 3e-6);
        let degrees = degrees(&noded);
        assert_eq!(degrees.iter().filter(|d| **d == 3).count(), 1, "{off}: one junction");
        assert_eq!(degrees.iter().filter(|d| **d == 1).count(), 3, "{off}: three ends, no stub");
        assert!(noded.vertices.iter().all(|v| v.point.distance(&v.exact) <= 3e-6), "{off}: near the curves");
    }
}

/// Copies, exact, reversed and displaced by less than three quarters of the pitch, are one line with several owners.
#[test]
fn copies_are_one() {
    let curve = "M0 0C1 2 3 -2 4 0";
    let (_, once) = noded(&[curve], 1e-5);
    let displaced =
        ["M0 1e-9C1 2 3 -2 4 1e-9", "M0 7e-6C1 2.000007 3 -1.999993 4 7e-6", "M4 7e-6C3 -1.999993 1 2.000007 0 7e-6"];
    for copy in [curve, "M4 0C3 -2 1 2 0 0"].into_iter().chain(displaced) {
        let (_, twice) = noded(&[curve, copy], 1e-5);
        assert_eq!(twice.edges.len(), once.edges.len(), "{copy}: no edge more");
        assert!(twice.edges.iter().all(|edge| twice.owners(edge).len() == 2), "{copy}: two owners each");
        assert_eq!(twice.report.segments_merged, once.edges.len(), "{copy}: and reported so");
    }
    // A part, cut out elsewhere than at samples.
    let (_, part) = noded(&[curve, "M1 0.562500000000000L1 0.5625"], 1e-5);
    assert_eq!(part.edges.len(), once.edges.len(), "a stroke of no length adds nothing");
}

/// A closed path with a loop is cut where it crosses itself.
#[test]
fn figure_eight() {
    let (_, noded) = noded(&["M0 0C4 4 4 -4 0 0C-4 4 -4 -4 0 0Z"], 1e-6);
    let degrees = degrees(&noded);
    assert_eq!(degrees.iter().filter(|d| **d == 4).count(), 1, "it crosses itself where it starts");
    assert!(degrees.iter().all(|d| *d == 4 || *d == 2), "and nowhere else");
}

#[test]
fn scaling_by_a_power_of_two_changes_no_parameter() {
    let (paths, chains) = strokes::strokes(0, 3);
    let scaled: Vec<DrawingPath> = paths
        .iter()
        .map(|path| strokes::moved(path, |p| feature_sampling::geometry::Point::new(p.x * 1024.0, p.y * 1024.0)))
        .collect();
    let [small, large] = [(&paths, 1e-5), (&scaled, 1e-5 * 1024.0)]
        .map(|(paths, pitch)| node(paths, &chains, &Options::new(pitch)).expect("noded"));
    assert_eq!(small.edges, large.edges, "the same graph");
    for edge in &small.edges {
        assert_eq!(small.owners(edge), large.owners(edge), "the same parameters");
    }
}

#[test]
fn refusals() {
    let paths = drawing(&["M0 0L2 2", "M0 2L2 0"]).paths;
    let chain = |at: &[f64]| Chain { path: 0, closed: false, at: at.to_vec() };
    let run =
        |chain: &Chain, options: Options| node(&paths, std::slice::from_ref(chain), &options).map(|n| n.edges.len());
    let fine = Options::new(1e-6);
    assert_eq!(run(&chain(&[0.0, 1.0]), fine), Ok(1), "a line");
    assert_eq!(run(&chain(&[0.5]), fine), Ok(0), "a point has no edge");
    assert_eq!(run(&chain(&[]), fine), Ok(0), "nor has nothing");
    assert_eq!(run(&chain(&[0.5, 0.25]), fine), Err(NodeError::Chain { chain: 0 }), "backwards");
    assert_eq!(run(&chain(&[0.0, f64::NAN]), fine), Err(NodeError::Chain { chain: 0 }), "not a number");
    assert_eq!(run(&chain(&[0.0, 1.5]), fine), Err(NodeError::Chain { chain: 0 }), "beyond the end");
    assert_eq!(run(&Chain { path: 9, ..chain(&[0.0]) }, fine), Err(NodeError::Chain { chain: 0 }), "no such path");
    assert!(matches!(run(&chain(&[0.0, 1.0]), Options::new(f64::NAN)), Err(NodeError::Pitch(_))), "no pitch");
    assert!(matches!(run(&chain(&[0.0, 1.0]), Options::new(0.0)), Err(NodeError::Pitch(_))), "no pitch either");
    assert_eq!(run(&chain(&[0.0, 1.0]), Options::new(1e-17)), Err(NodeError::TooFine), "too fine");
    let few = Options { limit: 3, ..fine };
    let both = [chain(&[0.0, 0.25, 0.5, 0.75, 1.0]), Chain { path: 1, ..chain(&[0.0, 1.0]) }];
    assert!(matches!(node(&paths, &both, &few), Err(NodeError::TooMany { limit: 3 })), "too many");
}
