//! Triangles bent to the curve.
//!
//! A chord stands for a piece of a Bézier curve. If the vertices that refinement put on the chord are moved to the curve,
//! and each triangle beside it gets that piece as its side, the mesh covers the drawing exactly, provided no triangle folds
//! over. The paper claims as much for ε ≤ 0.66 (Section 5.2: "a positive Jacobian").
//!
//! A triangle with cubic sides is a cubic Bézier triangle; its middle control point is that of the quadratic that is
//! nearest to it, a quarter of the sum of the six beside it less a sixth of the corners (Farin 1986). The determinant of its
//! derivatives is a polynomial of degree four; if its fifteen Bernstein coefficients are positive it is. Where one is not,
//! the triangle is cut in four, down to a sixteenth of its sides; what is not positive then counts as folded.
//!
//! **Ears.** Where two sides of a triangle are neighbouring pieces of one smooth curve, they meet at 180° once bent: the
//! determinant is 0 in that corner, however dense the samples are, and the paper's claim cannot hold there. Such triangles
//! are listed on their own, and judged with one bent side at a time.
//!
//! A chord that stands for pieces of several cubics makes several triangles, with the far corner in common.

use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::{Point, Vector};

use super::Mesh;
use super::drawn::Drawn;
use crate::drawing::DrawingPath;
use crate::node::Track;

/// What bending came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bent {
    /// Triangles with a side on a curve, once for each cubic along it.
    pub triangles: usize,
    /// Those with two bent sides or more: their index in the mesh.
    pub ears: Vec<usize>,
    /// Those whose determinant is not positive everywhere: their index in the mesh.
    pub folded: Vec<usize>,
}

/// Bends the triangles of a mesh to the curves of its lines.
pub fn bend(mesh: &Mesh, drawn: &Drawn, paths: &[DrawingPath]) -> Bent {
    let mut points = mesh.points.clone();
    // What the door of the kernel takes for the rounding of coordinates.
    let noise = 2.0 * f64::EPSILON * points.iter().fold(0.0, |most: f64, p| most.max(p.x.abs()).max(p.y.abs()));
    // The curve of each border, from its first end to its second, by its vertices.
    let mut pieces: Vec<([u32; 2], Vec<Cubic<f64>>)> = Vec::new();
    for border in &mesh.borders {
        let Some(line) = border.line.map(|line| line as usize) else { continue };
        let (owner, [a, b]) = (drawn.owners[line], drawn.edges[line].map(|v| mesh.points[v as usize]));
        let Some(path) = paths.get(owner.path as usize) else { continue };
        let along = b.minus(&a);
        let track = Track::new(&path.cubics);
        let [u, v] = border.ends.map(|vertex| {
            let share = (mesh.points[vertex as usize].minus(&a).dot(&along) / along.norm_sq()).clamp(0.0, 1.0);
            let parameter = owner.at[0] + share * (owner.at[1] - owner.at[0]);
            // Ends of lines stay: several curves may meet there.
            if share > 0.0 && share < 1.0 {
                points[vertex as usize] = track.eval(parameter);
            }
            parameter
        });
        let mut cubics: Vec<Cubic<f64>> = track.cubics(u.min(v), u.max(v)).collect();
        // A closing line may be nothing but the rounding of its ends: no triangle has a side there.
        cubics.retain(|cubic| cubic.points.iter().any(|p| p.distance(cubic.start()) > noise));
        if u > v {
            cubics.reverse();
            cubics.iter_mut().for_each(|cubic| *cubic = cubic.reversed());
        }
        pieces.push((border.ends, cubics));
    }
    pieces.sort_unstable_by_key(|(ends, _)| *ends);
    let piece = |from: u32, to: u32| -> Option<Vec<Cubic<f64>>> {
        let at =
            |ends: [u32; 2]| pieces.binary_search_by_key(&ends, |(ends, _)| *ends).ok().map(|i| pieces[i].1.clone());
        let mut cubics = at([from, to]).or_else(|| {
            let mut cubics = at([to, from])?;
            cubics.reverse();
            cubics.iter_mut().for_each(|cubic| *cubic = cubic.reversed());
            Some(cubics)
        })?;
        // Where lines end at the points of a lattice, so does the curve.
        cubics.first_mut()?.move_end(0, points[from as usize]);
        cubics.last_mut()?.move_end(1, points[to as usize]);
        Some(cubics)
    };
    let mut bent = Bent::default();
    for (index, triangle) in mesh.triangles.iter().enumerate() {
        let p = triangle.map(|v| points[v as usize]);
        let sides: [Option<Vec<Cubic<f64>>>; 3] = std::array::from_fn(|i| piece(triangle[i], triangle[(i + 1) % 3]));
        let straight: [Cubic<f64>; 3] = std::array::from_fn(|i| Cubic::line(p[i], p[(i + 1) % 3]));
        let curved = sides.iter().filter(|side| side.is_some()).count();
        if curved > 1 {
            bent.ears.push(index);
        }
        let mut fine = true;
        for (i, side) in sides.iter().enumerate() {
            let far = p[(i + 2) % 3];
            for cubic in side.iter().flatten() {
                bent.triangles += 1;
                fine &=
                    is_positive(&net(&[*cubic, Cubic::line(*cubic.end(), far), Cubic::line(far, *cubic.start())]), 4);
            }
        }
        if curved == 0 {
            // Its corners may have moved.
            fine = is_positive(&net(&straight), 0);
        }
        if !fine {
            bent.folded.push(index);
        }
    }
    bent
}

/// Control points of a cubic triangle, rows towards the third corner: 0 to 3 the first side, 4 to 6, 7 to 8, 9.
type Net = [Point<f64>; 10];

/// The place of control point (i, j, k), i + j + k = 3, where j counts towards the second corner and k to the third.
const fn at(j: usize, k: usize, degree: usize) -> usize {
    // Rows before row k have degree + 1, degree, … points.
    k * (degree + 1) - k * k.saturating_sub(1) / 2 + j
}

fn net([first, second, third]: &[Cubic<f64>; 3]) -> Net {
    let mut net = [*first.start(); 10];
    for i in 0..4 {
        net[at(i, 0, 3)] = first.points[i];
        net[at(3 - i, i, 3)] = second.points[i];
        net[at(0, 3 - i, 3)] = third.points[i];
    }
    let sum = |places: &[(usize, usize)]| {
        places.iter().fold(Point::new(0.0, 0.0), |sum, &(j, k)| {
            let p = net[at(j, k, 3)];
            Point::new(sum.x + p.x, sum.y + p.y)
        })
    };
    let beside = sum(&[(1, 0), (2, 0), (2, 1), (1, 2), (0, 1), (0, 2)]);
    let corners = sum(&[(0, 0), (3, 0), (0, 3)]);
    net[at(1, 1, 3)] = Point::new(beside.x / 4.0 - corners.x / 6.0, beside.y / 4.0 - corners.y / 6.0);
    net
}

/// The determinant of the derivatives is positive everywhere; `depth` halvings at most.
fn is_positive(net: &Net, depth: u32) -> bool {
    let coefficients = determinant(net);
    if coefficients.iter().all(|value| *value > 0.0) {
        return true;
    }
    // Coefficients at corners are values.
    let corners = [coefficients[at(0, 0, 4)], coefficients[at(4, 0, 4)], coefficients[at(0, 4, 4)]];
    if depth == 0 || corners.iter().any(|value| value.is_nan() || *value <= 0.0) {
        return false;
    }
    quarters(net).iter().all(|quarter| is_positive(quarter, depth - 1))
}

/// Bernstein coefficients of the determinant, degree 4.
fn determinant(net: &Net) -> [f64; 15] {
    // The derivatives towards the second and the third corner are quadratic.
    let mut towards = [[Vector::<f64>::zero(); 6]; 2];
    for k in 0..3 {
        for j in 0..3 - k {
            let base = net[at(j, k, 3)];
            towards[0][at(j, k, 2)] = net[at(j + 1, k, 3)].minus(&base);
            towards[1][at(j, k, 2)] = net[at(j, k + 1, 3)].minus(&base);
        }
    }
    let factorial = |n: usize| [1.0, 1.0, 2.0, 6.0, 24.0][n];
    let multinomial = |degree: usize, j: usize, k: usize| {
        factorial(degree) / (factorial(degree - j - k) * factorial(j) * factorial(k))
    };
    let mut out = [0.0; 15];
    for k in 0..3 {
        for j in 0..3 - k {
            for n in 0..3 {
                for m in 0..3 - n {
                    let weight = multinomial(2, j, k) * multinomial(2, m, n) / multinomial(4, j + m, k + n);
                    let (u, v) = (towards[0][at(j, k, 2)], towards[1][at(m, n, 2)]);
                    out[at(j + m, k + n, 4)] += weight * u.cross(&v);
                }
            }
        }
    }
    out
}

/// The four triangles between corners and middles of sides, by de Casteljau's algorithm with blossoms.
fn quarters(net: &Net) -> [Net; 4] {
    let corner = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let middle = [[0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5]];
    [
        [corner[0], middle[0], middle[2]],
        [middle[0], corner[1], middle[1]],
        [middle[2], middle[1], corner[2]],
        [middle[1], middle[2], middle[0]],
    ]
    .map(|triangle| {
        let mut part = *net;
        for k in 0..4 {
            for j in 0..4 - k {
                let arguments: [[f64; 3]; 3] = std::array::from_fn(|i| match i {
                    i if i < k => triangle[2],
                    i if i < k + j => triangle[1],
                    _ => triangle[0],
                });
                part[at(j, k, 3)] = blossom(net, &arguments);
            }
        }
        part
    })
}

/// The blossom of a cubic triangle at three barycentric places.
fn blossom(net: &Net, arguments: &[[f64; 3]; 3]) -> Point<f64> {
    let mut level: Vec<Point<f64>> = net.to_vec();
    for (degree, [a, b, c]) in (0..3).rev().zip(arguments) {
        let mut next = Vec::with_capacity(6);
        for k in 0..=degree {
            for j in 0..=degree - k {
                let [p, q, r] = [(j, k), (j + 1, k), (j, k + 1)].map(|(j, k)| level[at(j, k, degree + 1)]);
                next.push(Point::new(a * p.x + b * q.x + c * r.x, a * p.y + b * q.y + c * r.y));
            }
        }
        level = next;
    }
    level[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner_net(bulge: f64) -> Net {
        let p = |x, y| Point::new(x, y);
        let side = Cubic { points: [p(0.0, 0.0), p(1.0, bulge), p(2.0, bulge), p(3.0, 0.0)] };
        net(&[side, Cubic::line(p(3.0, 0.0), p(0.0, 3.0)), Cubic::line(p(0.0, 3.0), p(0.0, 0.0))])
    }

    #[test]
    fn straight_triangles_have_their_area() {
        let found = determinant(&corner_net(0.0));
        // Derivatives are a third of the sides: 1 by 1.
        assert!(found.iter().all(|value| (value - 1.0).abs() < 1e-14), "{found:?}");
    }

    #[test]
    fn a_bulge_folds_where_the_determinant_says() {
        assert!(is_positive(&corner_net(-0.5), 6), "outwards");
        assert!(is_positive(&corner_net(0.6), 6), "inwards, a little");
        assert!(!is_positive(&corner_net(1.2), 6), "the side leaves its corner to the wrong side of the other side");
        assert!(!is_positive(&corner_net(4.0), 6), "through the opposite side");
    }

    #[test]
    fn quarters_are_the_same_surface() {
        let net = corner_net(0.7);
        let [first, .., last] = quarters(&net);
        let centre = |net: &Net| blossom(net, &[[1.0 / 3.0; 3]; 3]);
        let (a, b) = (centre(&last), centre(&net));
        assert!(a.distance(&b) < 1e-14, "the middle quarter has the same centre");
        let (a, b) = (first[3], blossom(&net, &[[0.5, 0.5, 0.0]; 3]));
        assert!(a.distance(&b) < 1e-14, "the middle of a side");
    }
}
