//! Moving the vertices inside to more even places, without breaking a bound.
//!
//! Each vertex that is on no line moves towards the mean of the circumcentres of its triangles, weighted by their areas:
//! where those of its Voronoi cell and of the optimal Delaunay triangulation lie (Chen and Holst 2011). Lloyd's method does
//! the like and checks nothing: it makes edges longer than the bound and angles smaller. Here a move stands only if, in the
//! triangles around the vertex, no angle falls below the bound (or below the smallest that was there, if that was smaller),
//! no edge becomes longer than the size, and all edges stay Delaunay, so that no edge has to change. If the whole way does
//! not do, half of it and a quarter are tried.

use feature_sampling::geometry::Point;

use super::triangles::{in_circle, orientation};
use super::{Mesh, Options};

/// Moves vertices, up to so many rounds; answers how many moves stood.
pub fn smooth(mesh: &mut Mesh, options: &Options, rounds: u32) -> usize {
    let sine_sq = options.min_angle.to_radians().sin().powi(2);
    let mut fixed = vec![false; mesh.points.len()];
    mesh.borders.iter().flat_map(|border| border.ends).for_each(|v| fixed[v as usize] = true);
    // Edges that must stay Delaunay may lie anywhere; those of lines need not, but do.
    let around = Around::new(mesh);
    let mut moved = 0;
    for _ in 0..rounds {
        let before = moved;
        for (vertex, _) in fixed.iter().enumerate().filter(|(_, fixed)| !**fixed) {
            moved += usize::from(around.improve(mesh, options, sine_sq, vertex));
        }
        if moved == before {
            break;
        }
    }
    moved
}

/// The triangles around each vertex, as the edge opposite to it and the vertex beyond that edge.
struct Around {
    first: Vec<usize>,
    /// From, to, beyond.
    rims: Vec<[u32; 3]>,
}

const NOTHING: u32 = u32::MAX;

impl Around {
    fn new(mesh: &Mesh) -> Self {
        let mut apexes: Vec<([u32; 2], u32)> =
            mesh.triangles.iter().flat_map(|&[a, b, c]| [([a, b], c), ([b, c], a), ([c, a], b)]).collect();
        apexes.sort_unstable();
        let apex =
            |edge: [u32; 2]| apexes.binary_search_by_key(&edge, |(edge, _)| *edge).map_or(NOTHING, |i| apexes[i].1);
        let mut by_vertex: Vec<(u32, [u32; 3])> = Vec::with_capacity(apexes.len());
        by_vertex.extend(apexes.iter().map(|&([from, to], vertex)| (vertex, [from, to, apex([to, from])])));
        by_vertex.sort_unstable();
        let mut first = vec![0; mesh.points.len() + 1];
        by_vertex.iter().for_each(|(vertex, _)| first[*vertex as usize + 1] += 1);
        for i in 0..mesh.points.len() {
            first[i + 1] += first[i];
        }
        Self { first, rims: by_vertex.into_iter().map(|(_, rim)| rim).collect() }
    }

    /// Moves one vertex if that keeps everything.
    fn improve(&self, mesh: &mut Mesh, options: &Options, sine_sq: f64, vertex: usize) -> bool {
        let rims = &self.rims[self.first[vertex]..self.first[vertex + 1]];
        let old = mesh.points[vertex];
        let (mut x, mut y, mut total) = (0.0, 0.0, 0.0);
        for rim in rims {
            let (a, b) = (mesh.points[rim[0] as usize], mesh.points[rim[1] as usize]);
            let (u, v) = (a.minus(&old), b.minus(&old));
            let double = u.cross(&v);
            let (u_sq, v_sq) = (u.norm_sq(), v.norm_sq());
            // Twice the area cancels against that of the circumcentre's formula.
            x += 0.5 * (v.y * u_sq - u.y * v_sq);
            y += 0.5 * (u.x * v_sq - v.x * u_sq);
            total += double;
        }
        let (worst, _) = self.measure(mesh, rims, old);
        let floor = worst.min(sine_sq);
        for share in [1.0, 0.5, 0.25] {
            let new = Point::new(old.x + share * x / total, old.y + share * y / total);
            if new == old || !new.is_finite() {
                return false;
            }
            let (angle, longest_sq) = self.measure(mesh, rims, new);
            if angle < floor || angle <= 0.0 || !fits(mesh, options, rims, new, longest_sq) {
                continue;
            }
            mesh.points[vertex] = new;
            if self.is_delaunay(mesh, rims, new) {
                return true;
            }
            mesh.points[vertex] = old;
        }
        false
    }

    /// The least squared sine of the triangles around a place, and their longest squared edge at it. 0 where one does not
    /// run counterclockwise.
    fn measure(&self, mesh: &Mesh, rims: &[[u32; 3]], p: Point<f64>) -> (f64, f64) {
        let (mut least, mut longest) = (1.0_f64, 0.0_f64);
        for rim in rims {
            let (a, b) = (mesh.points[rim[0] as usize], mesh.points[rim[1] as usize]);
            let double = orientation(a, b, p);
            if double <= 0.0 {
                return (0.0, f64::INFINITY);
            }
            let mut sides = [a.distance_sq(&b), b.distance_sq(&p), p.distance_sq(&a)];
            longest = longest.max(sides[1]).max(sides[2]);
            sides.sort_by(f64::total_cmp);
            least = least.min(double * double / (sides[1] * sides[2]));
        }
        (least, longest)
    }

    /// No vertex beyond the rim lies in the circle of its triangle, and no vertex of the rim in that of another one.
    fn is_delaunay(&self, mesh: &Mesh, rims: &[[u32; 3]], p: Point<f64>) -> bool {
        rims.iter().all(|&[from, to, beyond]| {
            let (a, b) = (mesh.points[from as usize], mesh.points[to as usize]);
            let outside = beyond == NOTHING || !in_circle(a, b, p, mesh.points[beyond as usize]);
            // The triangle after this one, across the spoke at `to`.
            let after = rims.iter().find(|other| other[0] == to).map(|other| mesh.points[other[1] as usize]);
            outside && after.is_some_and(|c| !in_circle(a, b, p, c))
        })
    }
}

/// No spoke is longer than the size at its ends allows.
fn fits(mesh: &Mesh, options: &Options, rims: &[[u32; 3]], p: Point<f64>, longest_sq: f64) -> bool {
    match &options.size {
        super::Size::Unbounded => true,
        super::Size::Uniform(length) => longest_sq <= length * length,
        graded @ super::Size::Graded(_) => {
            let here = graded.at(&p);
            rims.iter().all(|rim| {
                let a = mesh.points[rim[0] as usize];
                // Rims are as long as they were.
                p.distance(&a) <= here.min(graded.at(&a))
            })
        }
    }
}
