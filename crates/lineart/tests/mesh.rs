//! The mesher against an independent judge, on random stroke sets, on drawings, and on cases whose answer is known.

#[path = "common/meshes.rs"]
mod meshes;
#[path = "common/soup.rs"]
mod soup;
#[expect(dead_code, reason = "the judge of noding stays unused here")]
#[path = "common/strokes.rs"]
mod strokes;

use std::path::{Path, PathBuf};

use feature_sampling::bezier::Cubic;
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::geometry::{Aabb, Point};
use feature_sampling::medial::Resolution;
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::{Condition, SamplingOptions};
use lineart::drawing::{Drawing, DrawingPath, load};
use lineart::export::mesh::{MeshRows, vtk};
use lineart::mesh::curved::bend;
use lineart::mesh::drawn::{Drawn, Grading, noding, sampled};
use lineart::mesh::smooth::smooth;
use lineart::mesh::{Lines, Mesh, MeshError, Options, Size, mesh};
use lineart::node::Track;

/// Graded more than by default.
const FINE: Grading = Grading { lfs_factor: Some(4.0), growth: 1.0 };

/// Bounds of samples in shares of the diagonal.
struct Sampling {
    epsilon: f64,
    least: Option<f64>,
    most: Option<f64>,
}

/// What the paper uses for meshing.
const COARSE: Sampling = Sampling { epsilon: 1.0, least: Some(0.01), most: Some(0.1) };

fn drawn(drawing: &Drawing, sampling: &Sampling) -> (Drawn, f64) {
    let paths: Vec<(bool, &[Cubic<f64>])> =
        drawing.paths.iter().map(|path| (path.closed, path.cubics.as_slice())).collect();
    let curve = CurveModel::new(&paths, &DoorOptions::default()).expect("a curve");
    let medial = MedialModel::new(&curve, &Resolution::Tolerance(0.01));
    let diagonal = *curve.diagonal();
    let options = SamplingOptions {
        condition: Condition::Epsilon(sampling.epsilon),
        min_distance: sampling.least.map(|share| share * diagonal),
        max_distance: sampling.most.map(|share| share * diagonal),
        tolerance: 0.01,
        ..SamplingOptions::default()
    };
    let rows = sampled(&drawing.paths, &curve, &medial, &options).expect("samples");
    let noding = noding(diagonal, options.min_distance);
    (Drawn::new(&drawing.paths, &rows, &noding).expect("noded"), diagonal)
}

fn shipped(name: &str) -> Drawing {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../drawings");
    load(folder.join(name)).expect("a drawing that ships")
}

fn text(svg: &str) -> Drawing {
    let text = format!("<svg xmlns=\"http://www.w3.org/2000/svg\">{svg}</svg>");
    lineart::svg::read_str(&text, "test").expect("a drawing")
}

/// A few sets of each kind; `cargo run --release -p lineart --example mesh_survey` examines 10 000.
#[test]
fn random_strokes_are_meshed() {
    for (kind, name) in strokes::KINDS.iter().enumerate() {
        for seed in 0..12 {
            let verdict = soup::examine(kind, seed);
            assert!(verdict.as_ref().is_ok_and(|(count, _)| *count > 10), "{name}, seed {seed}: {verdict:?}");
        }
    }
}

/// A piece at the end of a line was taken for a triangle's side between two lines, the line itself being the second of them, and the
/// triangle was left flat: one set in 140. Found by the survey.
#[test]
fn a_line_is_no_neighbour_of_itself() {
    for (kind, seed) in [(0, 785), (0, 989), (1, 42), (1, 402)] {
        let verdict = soup::examine(kind, seed);
        assert!(verdict.is_ok(), "{}, seed {seed}: {verdict:?}", strokes::KINDS[kind]);
    }
}

/// Copies displaced by half the pitch of noding stayed lines of their own, with one to three million triangles between and around
/// them; a few of these sets were noded on a finer lattice, which made it worse. Found by the survey.
#[test]
fn near_copies_ask_for_no_small_triangles() {
    for seed in [12, 39, 79, 502, 544] {
        let verdict = soup::examine(3, seed);
        assert!(verdict.as_ref().is_ok_and(|(count, _)| *count < 60_000), "seed {seed}: {verdict:?}");
    }
}

#[test]
fn shipped_drawings_in_three_ways() {
    for name in ["leaf_01.svg", "elephant_outline_matthe_r.svg", "bee.svg", "celtic_triskell_01.svg"] {
        let (drawn, diagonal) = drawn(&shipped(name), &COARSE);
        for size in [Size::Unbounded, Size::Uniform(0.03 * diagonal), drawn.graded(0.1 * diagonal, &FINE)] {
            let options = Options { size, ..Options::default() };
            let outcome = mesh(&drawn.lines(), &drawn.frame, &options).expect("noded");
            assert!(!outcome.capped && outcome.unrefined.is_empty(), "{name}: {:?}", outcome.unrefined);
            let verdict = meshes::judge(&outcome.mesh, &drawn, &options);
            assert!(verdict.is_ok(), "{name}, {}: {verdict:?}", outcome.mesh.triangles.len());
            let mut even = outcome.mesh.clone();
            assert!(smooth(&mut even, &options, 5) > 0, "{name}: something moved");
            let verdict = meshes::judge(&even, &drawn, &options);
            assert!(verdict.is_ok(), "{name}, smoothed: {verdict:?}");
        }
    }
}

/// The judge is able to say no.
#[test]
fn the_judge_sees_what_is_wrong() {
    let drawing = text(r#"<path d="M0 0C40 0 60 20 100 100M0 100L100 0"/>"#);
    let (drawn, _) = drawn(&drawing, &COARSE);
    let options = Options { size: Size::Uniform(10.0), ..Options::default() };
    let good = mesh(&drawn.lines(), &drawn.frame, &options).expect("noded").mesh;
    assert_eq!(meshes::judge(&good, &drawn, &options), Ok(()), "as it is");
    let wrong = |change: &dyn Fn(&mut Mesh)| {
        let mut bad = good.clone();
        change(&mut bad);
        meshes::judge(&bad, &drawn, &options)
    };
    assert!(wrong(&|bad| bad.triangles[3].reverse()).is_err(), "a reversed triangle");
    assert!(wrong(&|bad| bad.triangles.truncate(bad.triangles.len() - 1)).is_err(), "a hole");
    assert!(wrong(&|bad| bad.borders.retain(|border| border.line != Some(1))).is_err(), "an interrupted line");
    assert!(wrong(&|bad| bad.points.last_mut().expect("points").x += 5.0).is_err(), "a vertex moved");
    let finer = Options { size: Size::Uniform(9.0), ..Options::default() };
    assert!(meshes::judge(&good, &drawn, &finer).is_err(), "an edge too long");
    let fairer = Options { min_angle: 33.0, ..options.clone() };
    assert!(meshes::judge(&good, &drawn, &fairer).is_err(), "an angle too small");
}

#[test]
fn same_input_same_bytes() {
    let bytes = || {
        let (drawn, diagonal) = drawn(&shipped("bee.svg"), &COARSE);
        let options = Options { size: drawn.graded(0.05 * diagonal, &FINE), ..Options::default() };
        let outcome = mesh(&drawn.lines(), &drawn.frame, &options).expect("noded");
        let path_of = drawn.path_of();
        let rows = MeshRows { mesh: &outcome.mesh, path_of: &path_of, names: &[], values: None, source: "bee.svg" };
        let mut out = Vec::new();
        vtk::write(&mut out, &rows).expect("written");
        out
    };
    assert!(bytes() == bytes(), "the same");
}

#[test]
fn strokes_of_no_room() {
    for svg in [
        r#"<path d="M5 5H95"/>"#,
        r#"<path d="M5 5V95"/>"#,
        r#"<path d="M0 0L100 0L0 0.5M0 9L90 10L0 9.3"/>"#,
        r#"<path d="M0 0H100M0 0.3H90"/>"#,
        r#"<path d="M0 0H100M0 1e-9H100M50 0V50"/>"#,
        r#"<path d="M1e6 1e6l1e-2 0l0 1e-2"/>"#,
        r#"<path d="M0 0C1 1 2 2 0 0M0 0H.001"/>"#,
        r#"<circle cx="0" cy="0" r="1"/><circle cx="2" cy="0" r="1"/><circle cx="0" cy="0" r="1"/>"#,
    ] {
        let (drawn, diagonal) = drawn(&text(svg), &Sampling { epsilon: 0.5, least: None, most: None });
        for size in [Size::Unbounded, Size::Uniform(0.05 * diagonal), drawn.graded(0.2 * diagonal, &FINE)] {
            let options = Options { size, ..Options::default() };
            let outcome = mesh(&drawn.lines(), &drawn.frame, &options).expect("noded");
            assert!(!outcome.capped && outcome.unrefined.is_empty(), "{svg}: {:?}", outcome.unrefined);
            let verdict = meshes::judge(&outcome.mesh, &drawn, &options);
            assert!(verdict.is_ok(), "{svg}: {verdict:?}");
        }
    }
}

#[test]
fn limits_and_errors_are_said() {
    let frame = Aabb { min: Point::new(0.0, 0.0), max: Point::new(1.0, 1.0) };
    let points = [[0.2, 0.2], [0.8, 0.8], [0.2, 0.8], [0.8, 0.2]].map(|[x, y]| Point::new(x, y));
    let error = |edges: &[[u32; 2]], options: &Options| mesh(&Lines { points: &points, edges }, &frame, options).err();
    let plain = Options::default();
    assert!(matches!(error(&[[0, 1], [2, 3]], &plain), Some(MeshError::NotNoded { .. })), "a crossing");
    assert_eq!(error(&[[0, 4]], &plain), Some(MeshError::BadEdge { line: 0 }), "no such point");
    assert_eq!(error(&[[1, 1]], &plain), Some(MeshError::BadEdge { line: 0 }), "no length");
    assert_eq!(error(&[], &Options { min_angle: 40.0, ..plain.clone() }), Some(MeshError::BadBound), "too fair");
    let zero = Options { size: Size::Uniform(0.0), ..plain.clone() };
    assert_eq!(error(&[], &zero), Some(MeshError::BadBound), "too small");
    let outside = [Point::new(0.5, 0.5), Point::new(1.0, 0.5)];
    let found = mesh(&Lines { points: &outside, edges: &[[0, 1]] }, &frame, &plain).err();
    assert_eq!(found, Some(MeshError::Outside { point: 1 }), "on the rectangle");
    let capped = Options { size: Size::Uniform(0.01), max_vertices: 1000, ..plain };
    let outcome = mesh(&Lines { points: &points, edges: &[[0, 1]] }, &frame, &capped).expect("noded");
    assert!(outcome.capped && outcome.mesh.points.len() == 1000, "stopped at the limit");
}

/// The curve that stands behind a side of a triangle leaves one of its corners beyond the side that meets it there.
fn leaves_a_corner(triangle: [u32; 3], flat: &Mesh, drawn: &Drawn, paths: &[DrawingPath]) -> bool {
    let point = |v: u32| &flat.points[v as usize];
    (0..6).any(|k| {
        let [a, b, c] = [k % 3, (k + 1 + k / 3) % 3, (k + 2 - k / 3) % 3].map(|i| triangle[i]);
        let line = flat.borders.iter().find(|border| border.ends == [a, b] || border.ends == [b, a]);
        let Some(line) = line.and_then(|border| border.line) else { return false };
        let (owner, ends) = (&drawn.owners[line as usize], drawn.edges[line as usize]);
        let [from, to] = if ends[0] == a { owner.at } else { [owner.at[1], owner.at[0]] };
        let beside = Track::new(&paths[owner.path as usize].cubics).eval(from + 1e-3 * (to - from));
        let (along, side, curve) = (point(b).minus(point(a)), point(c).minus(point(a)), beside.minus(point(a)));
        side.cross(&curve) * side.cross(&along) <= 0.0
    })
}

/// The paper's claim for ε ≤ 0.66, on smooth curves; on drawings that do not ship too, where they are there.
#[test]
fn bent_triangles_do_not_fold() {
    let mut drawings =
        vec![shipped("hook.svg"), text(r#"<circle cx="0" cy="0" r="10"/><ellipse cx="30" cy="0" rx="3" ry="14"/>"#)];
    let extra = std::env::var_os("FSAMPLE_DATA").map(|folder| PathBuf::from(folder).join("drawings"));
    for name in ["simple.svg", "blob2.svg", "complex.svg", "spiral.svg"] {
        match extra.as_ref().map(|folder| folder.join(name)).filter(|file| file.exists()) {
            Some(file) => drawings.push(load(file).expect("a drawing")),
            None => println!("skipped: {name} is not there"),
        }
    }
    for drawing in drawings {
        for epsilon in [0.3, 0.5, 0.66] {
            let (drawn, _) = drawn(&drawing, &Sampling { epsilon, least: None, most: None });
            // Triangles as large and flat as they come: refinement moves vertices to the curve, which the claim is not about.
            let outcome = mesh(&drawn.lines(), &drawn.frame, &Options { min_angle: 0.0, ..Options::default() });
            let flat = outcome.expect("noded").mesh;
            let bent = bend(&flat, &drawn, &drawing.paths);
            let name = &drawing.source;
            assert!(bent.triangles >= 2 * drawn.edges.len(), "{name}: both sides of each line");
            // The claim needs triangles that are not thin: samples on neighbouring crests of blob2 nearly line up.
            let thin = |folded: &usize| {
                name.ends_with("blob2.svg") && leaves_a_corner(flat.triangles[*folded], &flat, &drawn, &drawing.paths)
            };
            let unexplained: Vec<&usize> = bent.folded.iter().filter(|folded| !thin(folded)).collect();
            assert!(unexplained.is_empty(), "{name} at {epsilon}, of {}: {unexplained:?}", bent.triangles);
            assert!(bent.folded.len() <= 3, "{name} at {epsilon}: {:?}", bent.folded);
        }
    }
    // And the check is able to say no: where a sixth of a circle is one line, its arc may leave a corner of the triangle
    // beyond the other side.
    let drawing = text(r#"<circle cx="0" cy="0" r="10"/><path d="M8.4 4.3L7.9 5.1" fill="none"/>"#);
    let (drawn, _) = drawn(&drawing, &Sampling { epsilon: 1.0, least: Some(0.35), most: None });
    let outcome = mesh(&drawn.lines(), &drawn.frame, &Options { min_angle: 0.0, ..Options::default() });
    let flat = outcome.expect("noded").mesh;
    let bent = bend(&flat, &drawn, &drawing.paths);
    assert!(!bent.folded.is_empty(), "far too few samples");
    for &triangle in &bent.folded {
        assert!(leaves_a_corner(flat.triangles[triangle], &flat, &drawn, &drawing.paths), "{triangle}");
    }
}

/// A line that closes a path may be as long as the rounding of its ends: no side of a triangle is bent to it.
#[test]
fn a_closing_line_of_rounded_length_is_no_side() {
    let d = "M0.1 0C0.1 5.5 4 10 10 10S20 5.5 20 0 16-10 10-10 0.1-5.5 0.10000000000000002 0Z";
    let drawing = text(&format!(r#"<path d="{d}"/>"#));
    assert_eq!(drawing.paths[0].cubics.len(), 5, "four arcs and the line");
    let (drawn, _) = drawn(&drawing, &Sampling { epsilon: 0.5, least: None, most: None });
    let outcome = mesh(&drawn.lines(), &drawn.frame, &Options { min_angle: 0.0, ..Options::default() });
    let bent = bend(&outcome.expect("noded").mesh, &drawn, &drawing.paths);
    assert_eq!(bent.folded, [0_usize; 0], "of {}", bent.triangles);
}
