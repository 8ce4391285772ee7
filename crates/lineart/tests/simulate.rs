//! The Poisson problem where the answer is known.

use feature_sampling::geometry::{Aabb, Point};
use lineart::mesh::{Lines, Mesh, Options, Size, mesh};
use lineart::simulate::contour::{bands, contour, levels};
use lineart::simulate::{Problem, SimulateError, Simulation, Solution};

/// A regular polygon of many sides around the origin, in a rectangle.
fn disk(sides: u32, size: f64) -> (Mesh, Vec<bool>) {
    let points: Vec<_> = (0..sides)
        .map(|i| {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(sides);
            Point::new(angle.cos(), angle.sin())
        })
        .collect();
    let edges: Vec<[u32; 2]> = (0..sides).map(|i| [i, (i + 1) % sides]).collect();
    let frame = Aabb { min: Point::new(-1.2, -1.2), max: Point::new(1.2, 1.2) };
    let options = Options { size: Size::Uniform(size), ..Options::default() };
    let mesh = mesh(&Lines { points: &points, edges: &edges }, &frame, &options).expect("noded").mesh;
    let on_line = on_borders(&mesh, |line| line.is_some());
    (mesh, on_line)
}

fn on_borders(mesh: &Mesh, which: impl Fn(Option<u32>) -> bool) -> Vec<bool> {
    let mut on = vec![false; mesh.points.len()];
    let borders = mesh.borders.iter().filter(|border| which(border.line));
    borders.flat_map(|border| border.ends).for_each(|v| on[v as usize] = true);
    on
}

fn solve(mesh: &Mesh, given: &[Option<f64>], source: f64) -> Solution {
    let simulation = Simulation::new(mesh, given).expect("held");
    simulation.solve(&Problem { source, unit: 1.0, given }).expect("solved")
}

/// A mesh with a few lines in it, of any shape.
fn some_mesh(size: f64) -> Mesh {
    let points = [[0.1, 0.2], [0.7, 0.35], [0.4, 0.9], [0.71, 0.4]].map(|[x, y]| Point::new(x, y));
    let frame = Aabb { min: Point::new(-0.3, 0.0), max: Point::new(1.1, 1.0) };
    let options = Options { size: Size::Uniform(size), ..Options::default() };
    mesh(&Lines { points: &points, edges: &[[0, 1], [1, 2], [1, 3]] }, &frame, &options).expect("noded").mesh
}

#[test]
fn linear_functions_are_exact() {
    let mesh = some_mesh(0.08);
    let frame = on_borders(&mesh, |line| line.is_none());
    let given: Vec<Option<f64>> = mesh.points.iter().zip(&frame).map(|(p, on)| on.then_some(2.0 * p.x - p.y)).collect();
    let solution = solve(&mesh, &given, 0.0);
    let worst = mesh.points.iter().zip(&solution.values).fold(0.0_f64, |w, (p, u)| w.max((u - 2.0 * p.x + p.y).abs()));
    assert!(worst < 1e-12, "{worst}");
    // ½ |∇u|² times the area.
    assert!((solution.dirichlet_energy - 0.5 * 5.0 * 1.4).abs() < 1e-11, "{}", solution.dirichlet_energy);
    assert!(solution.residual < 1e-12, "{}", solution.residual);
}

/// xy is harmonic but not linear. On right triangles with legs along the axes, hypotenuses of slope ±1, the cotangents are
/// those of the five-point stencil, for which it is exact.
#[test]
fn a_saddle_is_exact_on_a_grid() {
    let n = 12_u32;
    let points: Vec<_> = (0..(n + 1) * (n + 1))
        .map(|i| Point::new(f64::from(i % (n + 1)) / f64::from(n), f64::from(i / (n + 1)) / f64::from(n)))
        .collect();
    let mut triangles = Vec::new();
    for y in 0..n {
        for x in 0..n {
            let [a, b, c, d] = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)].map(|(x, y)| y * (n + 1) + x);
            triangles.extend(if (x + y) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
        }
    }
    let mesh = Mesh { points, triangles, ..Mesh::default() };
    let edge = |p: &Point<f64>| p.x == 0.0 || p.x == 1.0 || p.y == 0.0 || p.y == 1.0;
    let given: Vec<Option<f64>> = mesh.points.iter().map(|p| edge(p).then_some(p.x * p.y)).collect();
    let solution = solve(&mesh, &given, 0.0);
    let worst = mesh.points.iter().zip(&solution.values).fold(0.0_f64, |w, (p, u)| w.max((u - p.x * p.y).abs()));
    assert!(worst < 1e-12, "{worst}");
}

#[test]
fn a_loaded_disk_converges_with_order_two() {
    let error = |sides: u32, size: f64| {
        let (mesh, rim) = disk(sides, size);
        // Outside of the disk nothing is asked: it is held too.
        let inside = |p: &Point<f64>| p.x * p.x + p.y * p.y < 1.0;
        let given: Vec<Option<f64>> =
            mesh.points.iter().zip(&rim).map(|(p, rim)| (*rim || !inside(p)).then_some(0.0)).collect();
        let solution = solve(&mesh, &given, 1.0);
        assert!(solution.least >= 0.0, "the maximum principle");
        let (mut sum, mut count) = (0.0, 0.0);
        for ((p, u), given) in mesh.points.iter().zip(&solution.values).zip(&given) {
            if given.is_none() {
                sum += (u - (1.0 - p.x * p.x - p.y * p.y) / 4.0).powi(2);
                count += 1.0;
            }
        }
        f64::sqrt(sum / count)
    };
    let errors = [error(24, 0.2), error(48, 0.1), error(96, 0.05), error(192, 0.025)];
    assert!(errors[3] < 1e-4, "{errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.7..2.4).contains(&order), "{errors:?}");
    }
}

#[test]
fn a_symmetric_mesh_has_a_symmetric_solution() {
    // The mesh of one half, and its mirror image.
    let half = some_mesh(0.07);
    let edge = half.points.iter().fold(f64::INFINITY, |least: f64, p| least.min(p.x));
    let mut mesh = Mesh { points: half.points.clone(), triangles: half.triangles.clone(), ..Mesh::default() };
    let mut image = Vec::new();
    for (v, p) in (0_u32..).zip(&half.points) {
        if p.x == edge {
            image.push(v);
        } else {
            image.push(u32::try_from(mesh.points.len()).expect("few"));
            mesh.points.push(Point::new(2.0 * edge - p.x, p.y));
        }
    }
    mesh.triangles.extend(half.triangles.iter().map(|&[a, b, c]| [c, b, a].map(|v| image[v as usize])));
    let lines = on_borders(&half, |line| line.is_some());
    let mut given = vec![None; mesh.points.len()];
    for (v, on) in lines.iter().enumerate().filter(|(_, on)| **on) {
        given[v] = on.then_some(0.0);
        given[image[v] as usize] = Some(0.0);
    }
    let solution = solve(&mesh, &given, 1.0);
    assert!(solution.least >= 0.0 && solution.greatest > 0.01, "{}", solution.greatest);
    for (v, w) in image.iter().enumerate() {
        let (a, b) = (solution.values[v], solution.values[*w as usize]);
        assert!((a - b).abs() <= 1e-10 * solution.greatest, "{a} {b}");
    }
}

#[test]
fn other_values_and_sources_use_the_same_factor() {
    let mesh = some_mesh(0.1);
    let (frame, lines) = (on_borders(&mesh, |line| line.is_none()), on_borders(&mesh, |line| line.is_some()));
    let given = |frame_value: f64, line_value: f64| -> Vec<Option<f64>> {
        let value = |(frame, line): (&bool, &bool)| if *frame { Some(frame_value) } else { line.then_some(line_value) };
        frame.iter().zip(&lines).map(value).collect()
    };
    let simulation = Simulation::new(&mesh, &given(0.0, 0.0)).expect("held");
    let ask = |frame, line, source| {
        let given = given(frame, line);
        simulation.solve(&Problem { source, unit: 1.0, given: &given }).expect("solved")
    };
    let (load, heat, both) = (ask(0.0, 0.0, 1.0), ask(0.0, 3.0, 0.0), ask(0.0, 3.0, 1.0));
    for ((a, b), c) in load.values.iter().zip(&heat.values).zip(&both.values) {
        assert!((a + b - c).abs() < 1e-12, "superposition");
    }
    assert!(heat.least == 0.0 && heat.greatest == 3.0, "between what is given");
    // The minimum of the energy: every change makes it larger, and that of the load is −½ of its work.
    assert!((load.energy + load.dirichlet_energy).abs() < 1e-12, "{} {}", load.energy, load.dirichlet_energy);
    let other = given(0.0, 0.0).iter().map(|_| None).collect::<Vec<Option<f64>>>();
    let problem = Problem { source: 1.0, unit: 1.0, given: &other };
    assert_eq!(simulation.solve(&problem).err(), Some(SimulateError::OtherVertices), "other vertices");
    let loose = Simulation::new(&mesh, &other).map(|simulation| simulation.factor_entries());
    assert_eq!(loose, Err(SimulateError::Loose { vertex: 0 }), "nothing is held");
}

#[test]
fn contours_and_bands_cut_the_plane() {
    let mesh = some_mesh(0.1);
    let values: Vec<f64> = mesh.points.iter().map(|p| p.x).collect();
    for level in levels(-0.3, 1.1, 6) {
        let found = contour(&mesh, &values, level);
        let length: f64 =
            found.lines.iter().flat_map(|line| line.windows(2)).map(|pair| pair[0].distance(&pair[1])).sum();
        assert!((length - 1.0).abs() < 1e-9, "from the top to the bottom: {length}");
        assert_eq!(found.lines.len(), 1, "in one piece");
        assert!(found.lines[0].iter().all(|p| (p.x - level).abs() < 1e-12), "where the value is");
    }
    let steps = levels(-0.3, 1.1, 6);
    let mut area = vec![0.0; steps.len() + 1];
    for triangle in &mesh.triangles {
        for (band, p) in bands(triangle.map(|v| mesh.points[v as usize]), triangle.map(|v| values[v as usize]), &steps)
        {
            for i in 1..p.len() - 1 {
                area[band] += 0.5 * p[i].minus(&p[0]).cross(&p[i + 1].minus(&p[0]));
            }
        }
    }
    assert!(area.iter().all(|area| (area - 0.2).abs() < 1e-9), "seven strips of equal width: {area:?}");
    // A ring.
    let values: Vec<f64> = mesh.points.iter().map(|p| -(p.x - 0.4).hypot(p.y - 0.5)).collect();
    let found = contour(&mesh, &values, -0.3);
    assert_eq!(found.lines.len(), 1, "one ring");
    assert_eq!(found.lines[0].first(), found.lines[0].last(), "that closes");
}
