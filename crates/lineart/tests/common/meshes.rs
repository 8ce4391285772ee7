//! A judge of meshes that shares no code with the mesher.

use std::collections::{HashMap, HashSet};

use feature_sampling::geometry::Point;
use lineart::mesh::drawn::Drawn;
use lineart::mesh::{Mesh, Options};
use robust::{Coord, incircle, orient2d};

fn coord(p: Point<f64>) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

/// What is wrong with a mesh of some lines, if anything.
pub(crate) fn judge(mesh: &Mesh, drawn: &Drawn, options: &Options) -> Result<(), String> {
    let point = |v: u32| mesh.points[v as usize];
    // Orientation, area, and whole edges.
    let mut apex: HashMap<[u32; 2], u32> = HashMap::new();
    let mut area = 0.0;
    for &[a, b, c] in &mesh.triangles {
        if orient2d(coord(point(a)), coord(point(b)), coord(point(c))) <= 0.0 {
            return Err(format!("triangle {a} {b} {c} does not run counterclockwise"));
        }
        area += 0.5 * point(b).minus(&point(a)).cross(&point(c).minus(&point(a)));
        for (edge, far) in [([a, b], c), ([b, c], a), ([c, a], b)] {
            if apex.insert(edge, far).is_some() {
                return Err(format!("two triangles on one side of edge {edge:?}"));
            }
        }
    }
    let extent = drawn.frame.extent();
    if (area / (extent.x * extent.y) - 1.0).abs() > 1e-9 {
        return Err(format!("the triangles have an area of {area}, the rectangle {}", extent.x * extent.y));
    }
    // Delaunay, lines included; only the sides of the rectangle have one triangle.
    let on_frame = |p: Point<f64>| {
        let (min, max) = (drawn.frame.min, drawn.frame.max);
        p.x == min.x || p.x == max.x || p.y == min.y || p.y == max.y
    };
    for (&[a, b], &c) in &apex {
        match apex.get(&[b, a]) {
            Some(&d) => {
                let [p, q, r, s] = [a, b, c, d].map(|v| coord(point(v)));
                if incircle(p, q, r, s) > 0.0 {
                    return Err(format!("edge {a} {b} is not Delaunay"));
                }
            }
            None if on_frame(point(a)) && on_frame(point(b)) => {}
            None => return Err(format!("edge {a} {b} has one triangle")),
        }
    }
    // Every line is a chain of edges from its first to its second end.
    let diagonal = extent.norm();
    let mut lines_at: HashMap<u32, Vec<usize>> = HashMap::new();
    let mut pieces: HashMap<u32, Vec<[u32; 2]>> = HashMap::new();
    for border in &mesh.borders {
        border.line.into_iter().for_each(|line| pieces.entry(line).or_default().push(border.ends));
    }
    for (number, ends) in (0..).zip(&drawn.edges) {
        let (line, mut at) = (number as usize, ends[0]);
        for &[from, to] in pieces.get(&number).into_iter().flatten() {
            if from != at || !(apex.contains_key(&[from, to]) && apex.contains_key(&[to, from])) {
                return Err(format!("line {line} is interrupted at vertex {at}"));
            }
            let [a, b] = ends.map(point);
            let off = b.minus(&a).cross(&point(to).minus(&a)) / a.distance(&b);
            if off.abs() > 1e-12 * diagonal + 2.0 * f64::EPSILON * a.x.abs().max(a.y.abs()) {
                return Err(format!("line {line} leaves its chord by {off}"));
            }
            lines_at.entry(from).or_default().push(line);
            lines_at.entry(to).or_default().push(line);
            at = to;
        }
        if at != ends[1] {
            return Err(format!("line {line} ends at vertex {at}"));
        }
    }
    // Points of the lines are vertices, to the bit.
    if drawn.points.iter().zip(&mesh.points).any(|(a, b)| a != b) {
        return Err("a point of the lines moved".to_owned());
    }
    // Lengths and angles.
    let mut flat = 0;
    for triangle in &mesh.triangles {
        let p = triangle.map(point);
        // The smallest angle, and the edge opposite to it.
        let mut least = (f64::INFINITY, 0);
        for i in 0..3 {
            let (a, b, c) = (p[i], p[(i + 1) % 3], p[(i + 2) % 3]);
            let most = options.size.at(&a).min(options.size.at(&b));
            if a.distance(&b) > most * (1.0 + 1e-9) {
                return Err(format!("an edge of length {} where {most} is asked for", a.distance(&b)));
            }
            // The angle at c.
            let (u, v) = (a.minus(&c), b.minus(&c));
            let angle = u.cross(&v).atan2(u.dot(&v)).to_degrees();
            if angle < least.0 {
                least = (angle, i);
            }
        }
        let (angle, i) = least;
        if angle < options.min_angle - 1e-6 {
            flat += 1;
            if !joins_sharp(drawn, &lines_at, triangle[i], triangle[(i + 1) % 3]) {
                return Err(format!("an angle of {angle}° at {:?}, away from small input angles", p[(i + 2) % 3]));
            }
        }
    }
    if flat != mesh.excused {
        return Err(format!("{flat} flat triangles, {} are said to be", mesh.excused));
    }
    Ok(())
}

/// The ends lie on two lines that meet at less than 60°.
fn joins_sharp(drawn: &Drawn, lines_at: &HashMap<u32, Vec<usize>>, from: u32, to: u32) -> bool {
    let lines = |v: u32| lines_at.get(&v).into_iter().flatten().copied().collect::<HashSet<_>>();
    let (first, second) = (lines(from), lines(to));
    first.iter().any(|&l| {
        second.iter().filter(|&&m| m != l).any(|&m| {
            let (p, q) = (drawn.edges[l], drawn.edges[m]);
            p.iter().filter(|end| q.contains(end)).any(|&apex| {
                let other = |ends: [u32; 2]| if ends[0] == apex { ends[1] } else { ends[0] };
                let [o, a, b] = [apex, other(p), other(q)].map(|v| drawn.points[v as usize]);
                let (u, v) = (a.minus(&o), b.minus(&o));
                u.cross(&v).atan2(u.dot(&v)).to_degrees().abs() < 60.0
            })
        })
    })
}
