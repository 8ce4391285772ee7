//! The triangulation that refinement works on: triangles with their neighbours, in one array.
//!
//! A *half-edge* is the number 4·t + i: edge i of triangle t, from its corner i to the next one counterclockwise. Each
//! edge knows the half-edge across it ([`NONE`] along the frame) and the *line* it is a piece of ([`NONE`] where it is
//! free to change). Lines are never crossed, so the triangulation stays a constrained Delaunay triangulation: no vertex
//! that can be seen from inside a triangle lies inside its circumcircle.
//!
//! **Insertion** (Bowyer 1981, Watson 1981). The triangles that a new point destroys are found by going outwards from
//! where it falls, through edges that are no lines, for as long as circumcircles hold the point. Signs are exact, so this
//! is the set that Lawson's flips would remove one by one; hence their outline is seen from the point as a whole and comes
//! up in counterclockwise order. The search changes nothing: a point that turns out to be in the way of a line is dropped
//! before anything is built. The new triangles are the fan over the outline.
//!
//! Splitting an edge is the same with the triangles at both its sides to begin with. A rounded middle of a line is not on
//! it to the last bit; that both halves are still seen properly is checked.

use feature_sampling::geometry::Point;
use robust::{Coord, incircle, orient2d};

/// No half-edge, no line, no vertex.
pub(super) const NONE: u32 = u32::MAX;

/// Three corners, counterclockwise, with what lies across the edge from each to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Triangle {
    /// Vertices.
    pub(super) corners: [u32; 3],
    /// Half-edges across.
    pub(super) across: [u32; 3],
    /// Lines.
    pub(super) lines: [u32; 3],
    /// How often this place in the array has been used for another triangle.
    pub(super) stamp: u32,
}

/// An edge of the outline of what an insertion destroys, with the half-edge outside it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rim {
    pub(super) from: u32,
    pub(super) to: u32,
    outside: u32,
    pub(super) line: u32,
}

/// Where a point is, seen from a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    /// In this triangle or on its edges.
    Inside(u32),
    /// Behind a line: the half-edge that is in the way.
    Behind(u32),
    /// Not found within a reasonable number of steps.
    Lost,
}

/// See the module's description.
#[derive(Clone, Debug, Default)]
pub(super) struct Triangles {
    pub(super) points: Vec<Point<f64>>,
    /// A half-edge that starts at each vertex.
    pub(super) spokes: Vec<u32>,
    pub(super) all: Vec<Triangle>,
    destroyed: Vec<u32>,
    pub(super) rim: Vec<Rim>,
    /// What the last insertion built, in the order of the outline.
    pub(super) built: Vec<u32>,
    stack: Vec<u32>,
}

/// The next half-edge of a triangle.
pub(super) const fn next(h: u32) -> u32 {
    if h & 3 == 2 { h - 2 } else { h + 1 }
}

/// The half-edge before.
pub(super) const fn previous(h: u32) -> u32 {
    if h & 3 == 0 { h + 2 } else { h - 1 }
}

/// A half-edge by triangle and edge.
const fn half_edge(triangle: u32, edge: u32) -> u32 {
    triangle << 2 | edge
}

#[inline]
fn coord(p: Point<f64>) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

/// Twice the area of a triangle, its sign exact: above 0 where a, b, c run counterclockwise.
#[inline]
pub(super) fn orientation(a: Point<f64>, b: Point<f64>, c: Point<f64>) -> f64 {
    let (left, right) = ((a.x - c.x) * (b.y - c.y), (a.y - c.y) * (b.x - c.x));
    let det = left - right;
    // Shewchuk's first filter: (3 + 16 u) u with u = 2⁻⁵³.
    if det.abs() >= 3.330_669_073_875_472e-16 * (left.abs() + right.abs()) {
        return det;
    }
    orient2d(coord(a), coord(b), coord(c))
}

/// d lies inside the circle through a, b, c, which run counterclockwise; exact.
#[inline]
pub(super) fn in_circle(a: Point<f64>, b: Point<f64>, c: Point<f64>, d: Point<f64>) -> bool {
    let (adx, ady, bdx, bdy, cdx, cdy) = (a.x - d.x, a.y - d.y, b.x - d.x, b.y - d.y, c.x - d.x, c.y - d.y);
    let (bc, cb, ca, ac, ab, ba) = (bdx * cdy, cdx * bdy, cdx * ady, adx * cdy, adx * bdy, bdx * ady);
    let (a_sq, b_sq, c_sq) = (adx * adx + ady * ady, bdx * bdx + bdy * bdy, cdx * cdx + cdy * cdy);
    let det = a_sq * (bc - cb) + b_sq * (ca - ac) + c_sq * (ab - ba);
    let permanent = (bc.abs() + cb.abs()) * a_sq + (ca.abs() + ac.abs()) * b_sq + (ab.abs() + ba.abs()) * c_sq;
    // Shewchuk's first filter: (10 + 96 u) u.
    if det.abs() > 1.110_223_024_625_157e-15 * permanent {
        return det > 0.0;
    }
    incircle(coord(a), coord(b), coord(c), coord(d)) > 0.0
}

impl Triangles {
    #[inline]
    pub(super) fn triangle(&self, h: u32) -> &Triangle {
        &self.all[(h >> 2) as usize]
    }

    /// The vertex that a half-edge starts at.
    #[inline]
    pub(super) fn origin(&self, h: u32) -> u32 {
        self.triangle(h).corners[(h & 3) as usize]
    }

    #[inline]
    pub(super) fn across(&self, h: u32) -> u32 {
        self.triangle(h).across[(h & 3) as usize]
    }

    #[inline]
    pub(super) fn line(&self, h: u32) -> u32 {
        self.triangle(h).lines[(h & 3) as usize]
    }

    #[inline]
    pub(super) fn point(&self, vertex: u32) -> Point<f64> {
        self.points[vertex as usize]
    }

    /// The corners of a triangle.
    #[inline]
    pub(super) fn corners(&self, triangle: u32) -> [Point<f64>; 3] {
        self.all[triangle as usize].corners.map(|v| self.point(v))
    }

    /// The number of triangles, for loops over them all.
    pub(super) fn count(&self) -> u32 {
        u32::try_from(self.all.len()).unwrap_or(NONE)
    }

    /// The half-edge from one vertex to another, or the reverse one if only that exists (along the frame).
    pub(super) fn between(&self, from: u32, to: u32) -> Option<u32> {
        let start = self.spokes[from as usize];
        // Around counterclockwise, then, if the frame stops that, clockwise.
        let mut h = start;
        loop {
            if self.origin(next(h)) == to {
                return Some(h);
            }
            let before = previous(h);
            if self.origin(before) == to {
                return Some(match self.across(before) {
                    NONE => before,
                    other => other,
                });
            }
            h = self.across(before);
            if h == start {
                return None;
            }
            if h == NONE {
                break;
            }
        }
        h = start;
        loop {
            h = self.across(h);
            if h == NONE {
                return None;
            }
            h = next(h);
            if self.origin(next(h)) == to {
                return Some(h);
            }
        }
    }

    /// Every edge at a vertex, as a half-edge of either direction.
    pub(super) fn around(&self, vertex: u32, mut each: impl FnMut(u32)) {
        let start = self.spokes[vertex as usize];
        let mut h = start;
        loop {
            each(h);
            let before = previous(h);
            h = self.across(before);
            if h == start {
                return;
            }
            if h == NONE {
                // The frame: what is left lies clockwise of the start.
                each(before);
                break;
            }
        }
        h = self.across(start);
        while h != NONE {
            each(next(h));
            h = self.across(next(h));
        }
    }

    /// Where a point is, going there from a triangle.
    pub(super) fn locate(&self, p: Point<f64>, start: u32) -> Place {
        // Straight ahead, one crosses about √n triangles.
        let limit = 64 + self.all.len();
        let (mut t, mut came_from) = (start, NONE);
        for _ in 0..limit {
            let triangle = &self.all[t as usize];
            let corners = triangle.corners.map(|v| self.point(v));
            let leave = [0, 1, 2].into_iter().find(|&i| {
                half_edge(t, i) != came_from && orientation(corners[i as usize], corners[(i as usize + 1) % 3], p) < 0.0
            });
            let Some(i) = leave else { return Place::Inside(t) };
            if triangle.lines[i as usize] != NONE {
                return Place::Behind(half_edge(t, i));
            }
            came_from = triangle.across[i as usize];
            t = came_from >> 2;
        }
        Place::Lost
    }

    /// Collects what a point in a triangle destroys, and its outline.
    pub(super) fn dig(&mut self, p: Point<f64>, triangle: u32) {
        self.destroyed.clear();
        self.rim.clear();
        self.destroyed.push(triangle);
        let h = half_edge(triangle, 0);
        self.stack.extend([previous(h), next(h), h]);
        self.follow(p);
    }

    /// The same for a point on an edge. False if the point does not see the other edges of the triangles beside it.
    pub(super) fn dig_edge(&mut self, p: Point<f64>, h: u32) -> bool {
        self.destroyed.clear();
        self.rim.clear();
        let other = self.across(h);
        let mut edges = vec![next(h), previous(h)];
        self.destroyed.push(h >> 2);
        if other != NONE {
            self.destroyed.push(other >> 2);
            edges.extend([next(other), previous(other)]);
        }
        let seen = edges.iter().all(|&e| {
            let (a, b) = (self.point(self.origin(e)), self.point(self.origin(next(e))));
            orientation(a, b, p) > 0.0
        });
        self.stack.extend(edges.iter().rev());
        self.follow(p);
        seen
    }

    /// Goes outwards through the edges on the stack, counterclockwise.
    fn follow(&mut self, p: Point<f64>) {
        while let Some(h) = self.stack.pop() {
            let inside = *self.triangle(h);
            let i = (h & 3) as usize;
            let (outside, line) = (inside.across[i], inside.lines[i]);
            if outside != NONE && line == NONE {
                let [a, b, c] = self.corners(outside >> 2);
                if in_circle(a, b, c, p) {
                    self.destroyed.push(outside >> 2);
                    self.stack.extend([previous(outside), next(outside)]);
                    continue;
                }
            }
            self.rim.push(Rim { from: inside.corners[i], to: inside.corners[(i + 1) % 3], outside, line });
        }
    }

    /// Puts a point into what was dug for it; answers its vertex. `halves`: the two ends of a line that it splits, and that
    /// line.
    pub(super) fn fill(&mut self, p: Point<f64>, halves: Option<([u32; 2], u32)>) -> u32 {
        let vertex = u32::try_from(self.points.len()).unwrap_or(NONE);
        self.points.push(p);
        self.built.clear();
        let fan = self.rim.len();
        for k in 0..fan {
            let t = match self.destroyed.get(k) {
                Some(&t) => t,
                None => {
                    self.all.push(Triangle { corners: [0; 3], across: [NONE; 3], lines: [NONE; 3], stamp: 0 });
                    self.count() - 1
                }
            };
            self.built.push(t);
        }
        // A fan is open where the frame is split.
        let closed = self.rim.first().map(|rim| rim.from) == self.rim.last().map(|rim| rim.to);
        for k in 0..fan {
            let Rim { from, to, outside, line } = self.rim[k];
            let t = self.built[k];
            let after = if k + 1 < fan { Some(k + 1) } else { closed.then_some(0) };
            let before = if k > 0 { Some(k - 1) } else { closed.then_some(fan - 1) };
            let across = [
                outside,
                after.map_or(NONE, |k| half_edge(self.built[k], 2)),
                before.map_or(NONE, |k| half_edge(self.built[k], 1)),
            ];
            let spoke_line = |end| halves.filter(|(ends, _)| ends.contains(&end)).map_or(NONE, |(_, line)| line);
            let triangle = &mut self.all[t as usize];
            triangle.corners = [from, to, vertex];
            triangle.across = across;
            triangle.lines = [line, spoke_line(to), spoke_line(from)];
            triangle.stamp += 1;
            if outside != NONE {
                self.all[(outside >> 2) as usize].across[(outside & 3) as usize] = half_edge(t, 0);
            }
            self.spokes[from as usize] = half_edge(t, 0);
            if after.is_none() {
                self.spokes[to as usize] = half_edge(t, 1);
            }
        }
        self.spokes.push(self.built.first().map_or(NONE, |&t| half_edge(t, 2)));
        vertex
    }

    /// Neighbours agree with each other, triangles run counterclockwise, edges that are no lines are locally Delaunay.
    #[cfg(test)]
    pub(super) fn check(&self) {
        for (t, triangle) in (0_u32..).zip(&self.all) {
            let [a, b, c] = self.corners(t);
            assert!(orientation(a, b, c) > 0.0, "triangle {t} runs counterclockwise");
            for i in 0..3 {
                let h = half_edge(t, i);
                let other = self.across(h);
                if other == NONE {
                    assert_ne!(self.line(h), NONE, "the outermost edges are lines");
                    continue;
                }
                assert_eq!(self.across(other), h, "neighbours agree");
                assert_eq!(self.line(other), self.line(h), "about the line");
                assert_eq!(self.origin(other), self.origin(next(h)), "and about the edge");
                let far = self.point(self.origin(previous(other)));
                assert!(self.line(h) != NONE || !in_circle(a, b, c, far), "edge {i} of {t} is locally Delaunay");
            }
            assert!(triangle.corners.iter().all(|&v| self.origin(self.spokes[v as usize]) == v), "spokes");
        }
    }
}
