//! Refinement from the inside: invariants that a mesh does not show.

use super::*;

/// Lines in the unit square's box, refined, with the inside checked.
fn refined(points: &[[f64; 2]], edges: &[[u32; 2]], options: &Options) -> Outcome {
    let points: Vec<_> = points.iter().map(|&[x, y]| Point::new(x, y)).collect();
    let lines = Lines { points: &points, edges };
    let frame = Aabb { min: Point::new(-0.1, -0.1), max: Point::new(1.1, 1.1) };
    let triangles = start::triangulate(&lines, &frame).expect("noded");
    triangles.check();
    let sine = options.min_angle.to_radians().sin();
    let bounds =
        Bounds { sine_sq: sine * sine, size: &options.size, max_vertices: options.max_vertices, shortest: 1e-11 };
    let mut refinement = Refinement::new(triangles.clone(), sharp_ends(&triangles, &lines), bounds);
    refinement.run();
    refinement.mesh.check();
    finish(refinement, edges.len())
}

fn with_size(length: f64) -> Options {
    Options { size: Size::Uniform(length), ..Options::default() }
}

#[test]
fn a_cross_and_a_wedge() {
    let points = [[0.1, 0.1], [0.9, 0.9], [0.5, 0.5], [0.1, 0.9], [0.9, 0.1], [0.2, 0.1], [0.6, 0.101], [0.6, 0.11]];
    let edges = [[0, 2], [2, 1], [3, 2], [2, 4], [5, 6], [5, 7]];
    for length in [0.5, 0.1, 0.03] {
        let outcome = refined(&points, &edges, &with_size(length));
        assert!(!outcome.capped && outcome.unrefined.is_empty(), "{length}: {:?}", outcome.unrefined);
        assert!(outcome.mesh.triangles.len() < 40_000, "{length}: {}", outcome.mesh.triangles.len());
    }
}
