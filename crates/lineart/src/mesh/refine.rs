//! Delaunay refinement: triangles that are too flat or too large are broken up until there are none.
//!
//! Ruppert 1995 and Shewchuk 2002, with a size: a line with a vertex inside its diametral circle, or longer than the size,
//! is split; a triangle with too small an angle or an edge longer than the size gets a vertex at its circumcentre, unless
//! that lies in the diametral circle of a line, which is split instead. Lines come before triangles, large triangles before
//! flat ones, the worst first. When nothing is left, every line is an edge of the (not only constrained) Delaunay
//! triangulation.
//!
//! **Small input angles.** Where two lines meet at less than 60°, halving one can put a vertex into the circle of the
//! other for ever. So a line that starts at such an apex is split at a power of two from it: neighbours are cut at equal
//! distances, and the vertices of one stay out of the circles of the other. A triangle between them cannot be made fair:
//! neither if its small angle is that of the apex itself, nor, without end, if its shortest edge joins two cuts at equal
//! distance (Miller, Pav and Walkington 2003). The first are left alone. The second get their circumcentre if that is in no
//! line's circle, which makes no edge shorter than those there are, and are left alone else.
//!
//! **It ends.** With the angle at most 20.7° no rule makes an edge shorter than those around it but for a constant; above,
//! up to 33°, it ends in practice. A limit on the vertices stands behind both. What could not be refined is listed.
//!
//! **Off-centres** (Üngör 2004). For a triangle that is only flat, the point on the way to the circumcentre that makes the
//! triangle over the shortest edge just good enough leaves fewer triangles behind.

use feature_sampling::geometry::Point;

use super::queue::{Entry, Queue};
use super::size::Size;
use super::triangles::{NONE, Place, Triangles, next, previous};
use super::{Refused, Unrefined};

/// Where a vertex lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stand {
    /// It came with the lines.
    Input,
    /// A cut of a line.
    On(u32),
    /// In the open.
    Free,
}

/// A line between two input vertices.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) ends: [u32; 2],
    /// It meets another line at less than 60° there.
    pub(super) sharp: [bool; 2],
}

/// What triangles have to be like.
#[derive(Clone, Debug)]
pub(super) struct Bounds<'a> {
    /// The square of the sine of the smallest angle.
    pub(super) sine_sq: f64,
    pub(super) size: &'a Size,
    pub(super) max_vertices: usize,
    /// No line shorter than this is split.
    pub(super) shortest: f64,
}

/// How a triangle fares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Verdict {
    Good,
    /// An edge is too long, by this factor squared.
    Large(f64),
    /// The smallest angle is too small; how much worse than the bound, squared.
    Flat(f64),
}

/// Refinement under way.
pub(super) struct Refinement<'a> {
    pub(super) mesh: Triangles,
    pub(super) stands: Vec<Stand>,
    pub(super) lines: Vec<Line>,
    bounds: Bounds<'a>,
    /// The size at each vertex; empty unless it differs from place to place.
    sizes: Vec<f64>,
    uniform_sq: f64,
    large: Queue,
    flat: Queue,
    /// Lines to be looked at, by the vertices of a piece.
    pieces: Vec<[u32; 2]>,
    pub(super) unrefined: Vec<Unrefined>,
    /// Triangles that small input angles excuse.
    pub(super) excused: usize,
    pub(super) capped: bool,
}

impl<'a> Refinement<'a> {
    pub(super) fn new(mesh: Triangles, lines: Vec<Line>, bounds: Bounds<'a>) -> Self {
        let sizes = match bounds.size {
            Size::Graded(_) => mesh.points.iter().map(|p| bounds.size.at(p)).collect(),
            _ => Vec::new(),
        };
        let uniform = if let Size::Uniform(length) = bounds.size { *length } else { f64::INFINITY };
        Self {
            stands: vec![Stand::Input; mesh.points.len()],
            mesh,
            lines,
            sizes,
            uniform_sq: uniform * uniform,
            bounds,
            large: Queue::new(),
            flat: Queue::new(),
            pieces: Vec::new(),
            unrefined: Vec::new(),
            excused: 0,
            capped: false,
        }
    }

    /// Until there is nothing left to do, or no room to do it in.
    pub(super) fn run(&mut self) {
        // Last in, first out: the lines come up in their order.
        self.pieces.extend(self.lines.iter().rev().map(|line| line.ends));
        for t in 0..self.mesh.count() {
            self.judge(t);
        }
        loop {
            if let Some(piece) = self.pieces.pop() {
                self.look_at(piece);
            } else if let Some(entry) = self.large.pop().or_else(|| self.flat.pop()) {
                if self.mesh.all[entry.item as usize].stamp == entry.stamp {
                    self.improve(entry.item);
                }
            } else {
                break;
            }
            if self.mesh.points.len() >= self.bounds.max_vertices {
                self.capped = self.is_unfinished();
                break;
            }
        }
    }

    /// Something that is waiting is bad indeed.
    fn is_unfinished(&mut self) -> bool {
        while let Some([a, b]) = self.pieces.pop() {
            if self.mesh.between(a, b).is_some_and(|h| self.is_crowded(h) || self.is_long(a, b)) {
                return true;
            }
        }
        while let Some(entry) = self.large.pop().or_else(|| self.flat.pop()) {
            if self.mesh.all[entry.item as usize].stamp == entry.stamp && self.verdict(entry.item) != Verdict::Good {
                return true;
            }
        }
        false
    }

    /// The square of the longest that an edge between two vertices may be.
    fn limit_sq(&self, ends: &[u32]) -> f64 {
        if self.sizes.is_empty() {
            return self.uniform_sq;
        }
        let least = ends.iter().fold(f64::INFINITY, |least: f64, &v| least.min(self.sizes[v as usize]));
        least * least
    }

    pub(super) fn verdict(&self, t: u32) -> Verdict {
        let [a, b, c] = self.mesh.corners(t);
        let (mut x, mut y, mut z) = (a.distance_sq(&b), b.distance_sq(&c), c.distance_sq(&a));
        let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        // z becomes the longest, x the shortest.
        if x > y {
            (x, y) = (y, x);
        }
        if y > z {
            (y, z) = (z, y);
        }
        if x > y {
            y = x;
        }
        let limit = self.limit_sq(&self.mesh.all[t as usize].corners);
        if z > limit {
            return Verdict::Large(z / limit);
        }
        // The smallest angle is between the two longer edges.
        let (got, wanted) = (area * area, self.bounds.sine_sq * (y * z));
        if got < wanted { Verdict::Flat(wanted / got) } else { Verdict::Good }
    }

    /// Puts a triangle into the queue it belongs to.
    fn judge(&mut self, t: u32) {
        let entry = Entry { item: t, stamp: self.mesh.all[t as usize].stamp };
        match self.verdict(t) {
            Verdict::Good => {}
            Verdict::Large(by) => self.large.push(by, entry),
            Verdict::Flat(by) => self.flat.push(by, entry),
        }
    }

    /// A vertex of the triangles beside a piece of a line lies in its diametral circle.
    fn is_crowded(&self, h: u32) -> bool {
        let (a, b) = (self.mesh.origin(h), self.mesh.origin(next(h)));
        let (a, b) = (self.mesh.point(a), self.mesh.point(b));
        let crowds = |h: u32| h != NONE && in_diametral_circle(a, b, self.mesh.point(self.mesh.origin(previous(h))));
        crowds(h) || crowds(self.mesh.across(h))
    }

    fn is_long(&self, a: u32, b: u32) -> bool {
        self.mesh.point(a).distance_sq(&self.mesh.point(b)) > self.limit_sq(&[a, b])
    }

    /// Splits a piece of a line that is still there if it is crowded or too long.
    fn look_at(&mut self, [a, b]: [u32; 2]) {
        let Some(h) = self.mesh.between(a, b) else { return };
        if self.mesh.line(h) != NONE && (self.is_crowded(h) || self.is_long(a, b)) {
            self.split(h);
        }
    }

    /// Splits a piece of a line; false if it is too short for that.
    fn split(&mut self, h: u32) -> bool {
        let line = self.mesh.line(h);
        let ends = [self.mesh.origin(h), self.mesh.origin(next(h))];
        let [a, b] = ends.map(|v| self.mesh.point(v));
        let length = a.distance(&b);
        let share = self.share(line, ends, length);
        let p = Point::new(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y));
        if length < self.bounds.shortest || !self.mesh.dig_edge(p, h) {
            self.unrefined.push(Unrefined { at: a.middle(&b), reason: Refused::ShortLine });
            return false;
        }
        let vertex = self.mesh.fill(p, Some((ends, line)));
        self.settle(p, Stand::On(line));
        for end in ends {
            self.pieces.push([vertex, end]);
        }
        // What the new vertex crowds.
        for rim in &self.mesh.rim {
            if rim.line != NONE && in_diametral_circle(self.mesh.point(rim.from), self.mesh.point(rim.to), p) {
                self.pieces.push([rim.from, rim.to]);
            }
        }
        true
    }

    /// Where to split a piece, as a share of its length: the middle, or a power of two from a sharp apex.
    fn share(&self, line: u32, [a, b]: [u32; 2], length: f64) -> f64 {
        let Line { ends, sharp } = self.lines[line as usize];
        let is_apex = |v: u32| (v == ends[0] && sharp[0]) || (v == ends[1] && sharp[1]);
        match (is_apex(a), is_apex(b)) {
            (true, false) => shell(length) / length,
            (false, true) => 1.0 - shell(length) / length,
            _ => 0.5,
        }
    }

    /// Book-keeping for the vertex that was just put in.
    fn settle(&mut self, p: Point<f64>, stand: Stand) {
        self.stands.push(stand);
        if !self.sizes.is_empty() {
            self.sizes.push(self.bounds.size.at(&p));
        }
        for i in 0..self.mesh.built.len() {
            self.judge(self.mesh.built[i]);
        }
    }

    /// Does something about a bad triangle.
    fn improve(&mut self, t: u32) {
        let verdict = self.verdict(t);
        let is_flat = matches!(verdict, Verdict::Flat(_));
        let may_split = if is_flat {
            match self.excuse(t) {
                Excuse::Apex => {
                    self.excused += 1;
                    return;
                }
                Excuse::Shell => false,
                Excuse::None => true,
            }
        } else {
            verdict != Verdict::Good
        };
        let p = self.centre(t, is_flat);
        if !p.is_finite() {
            return self.refuse(t, Refused::Degenerate);
        }
        let blocked = match self.mesh.locate(p, t) {
            Place::Lost => return self.refuse(t, Refused::Degenerate),
            Place::Behind(h) => {
                let (from, to) = (self.mesh.origin(h), self.mesh.origin(next(h)));
                vec![[from, to]]
            }
            Place::Inside(at) => {
                self.mesh.dig(p, at);
                let crowded = self.mesh.rim.iter().filter(|rim| {
                    rim.line != NONE && in_diametral_circle(self.mesh.point(rim.from), self.mesh.point(rim.to), p)
                });
                crowded.map(|rim| [rim.from, rim.to]).collect()
            }
        };
        if blocked.is_empty() {
            self.mesh.fill(p, None);
            self.settle(p, Stand::Free);
            return;
        }
        if !may_split {
            self.excused += 1;
            return;
        }
        let stamp = self.mesh.all[t as usize].stamp;
        let mut any = false;
        for [from, to] in blocked {
            any |= self.mesh.between(from, to).is_some_and(|h| self.mesh.line(h) != NONE && self.split(h));
        }
        if !any {
            self.refuse(t, Refused::ShortLine);
        } else if self.mesh.all[t as usize].stamp == stamp {
            self.judge(t);
        }
    }

    fn refuse(&mut self, t: u32, reason: Refused) {
        let [a, b, c] = self.mesh.corners(t);
        let at = Point::new((a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0);
        self.unrefined.push(Unrefined { at, reason });
    }

    /// The point that breaks a triangle up: the circumcentre, or, if it is only flat, the off-centre if that is nearer.
    fn centre(&self, t: u32, is_flat: bool) -> Point<f64> {
        let mut p = self.mesh.corners(t);
        if is_flat {
            // The shortest edge first.
            let [x, y, z] = [0, 1, 2].map(|i: usize| p[i].distance_sq(&p[(i + 1) % 3]));
            p.rotate_left(if x <= y && x <= z { 0 } else { usize::from(y <= z) + 2 * usize::from(z < y) });
        }
        let [a, b, c] = p;
        let (bx, by, cx, cy) = (b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y);
        let (b_sq, c_sq) = (bx * bx + by * by, cx * cx + cy * cy);
        let twice = 0.5 / (bx * cy - by * cx);
        let (mut x, mut y) = ((cy * b_sq - by * c_sq) * twice, (bx * c_sq - cx * b_sq) * twice);
        if is_flat {
            // Over the edge of length l, an apex at height h sees it at an angle of sine s where h = l (1 + √(1−s²)) / 2s.
            // A little nearer, so that rounding cannot leave the angle below the bound.
            let sine = self.bounds.sine_sq.sqrt();
            let reach = 0.95 * (1.0 + (1.0 - self.bounds.sine_sq).max(0.0).sqrt()) / (2.0 * sine);
            let (dx, dy) = (0.5 * bx - by * reach, 0.5 * by + bx * reach);
            let (mx, my) = (x - 0.5 * bx, y - 0.5 * by);
            let (ox, oy) = (dx - 0.5 * bx, dy - 0.5 * by);
            if ox * ox + oy * oy < mx * mx + my * my {
                (x, y) = (dx, dy);
            }
        }
        Point::new(a.x + x, a.y + y)
    }

    /// Does a small input angle excuse a flat triangle?
    pub(super) fn excuse(&self, t: u32) -> Excuse {
        let triangle = &self.mesh.all[t as usize];
        let p = self.mesh.corners(t);
        let [x, y, z] = [0, 1, 2].map(|i: usize| p[i].distance_sq(&p[(i + 1) % 3]));
        let short = if x <= y && x <= z { 0 } else { usize::from(y <= z) + 2 * usize::from(z < y) };
        let [a, b, apex] = [0, 1, 2].map(|i| triangle.corners[(short + i) % 3]);
        let both_lines = triangle.lines[(short + 1) % 3] != NONE && triangle.lines[(short + 2) % 3] != NONE;
        if both_lines && self.stands[apex as usize] == Stand::Input {
            return Excuse::Apex;
        }
        let on_one_shell = |apex: u32| {
            let apex = self.mesh.point(apex);
            let (to_a, to_b) = (self.mesh.point(a).minus(&apex), self.mesh.point(b).minus(&apex));
            let (length_a, length_b) = (to_a.norm(), to_b.norm());
            // The apex may be sharp on account of other lines.
            let sharp = to_a.dot(&to_b) > 0.5 * (length_a * length_b);
            // Cuts on one shell differ by rounding only, cuts on different shells by a quarter at least.
            sharp && (length_a - length_b).abs() <= 1e-3 * length_a
        };
        let shell = match (self.stands[a as usize], self.stands[b as usize]) {
            (Stand::On(first), Stand::On(second)) if first != second => {
                let theirs = self.sharp_ends(second);
                self.sharp_ends(first).any(|end| theirs.clone().any(|other| other == end) && on_one_shell(end))
            }
            (Stand::On(line), Stand::Input) => self.is_from_apex(line, b, &on_one_shell),
            (Stand::Input, Stand::On(line)) => self.is_from_apex(line, a, &on_one_shell),
            (Stand::Input, Stand::Input) => {
                // Two vertices may have several apexes in common.
                let mut found = false;
                self.mesh.around(a, |h| {
                    let line = self.mesh.line(h);
                    found |= line != NONE && self.is_from_apex(line, b, &|end| end != a && on_one_shell(end));
                });
                found
            }
            _ => false,
        };
        if shell { Excuse::Shell } else { Excuse::None }
    }

    /// The ends at which a line meets others at less than 60°.
    fn sharp_ends(&self, line: u32) -> impl Iterator<Item = u32> + Clone + use<> {
        let Line { ends, sharp } = self.lines[line as usize];
        ends.into_iter().zip(sharp).filter(|(_, sharp)| *sharp).map(|(end, _)| end)
    }

    /// A sharp end of a line that is suitable and that another line joins to an input vertex.
    fn is_from_apex(&self, line: u32, vertex: u32, suits: &impl Fn(u32) -> bool) -> bool {
        self.sharp_ends(line).any(|end| end != vertex && suits(end) && self.is_joined(end, vertex, line))
    }

    /// A line, cut or not, but not the given one joins two input vertices: the last piece at the second belongs to a line from
    /// the first.
    fn is_joined(&self, end: u32, vertex: u32, except: u32) -> bool {
        let mut found = false;
        self.mesh.around(vertex, |h| {
            let line = self.mesh.line(h);
            found |= line != NONE && line != except && self.lines[line as usize].ends.contains(&end);
        });
        found
    }
}

/// Why a flat triangle may stay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Excuse {
    None,
    /// Its small angle is one between two lines.
    Apex,
    /// Its shortest edge joins two lines at equal distance from where they meet.
    Shell,
}

/// A power of two between a third and two thirds of a length.
fn shell(length: f64) -> f64 {
    let mut power = 1.0;
    while length > 3.0 * power {
        power *= 2.0;
    }
    while length < 1.5 * power {
        power *= 0.5;
    }
    power
}

#[inline]
fn in_diametral_circle(a: Point<f64>, b: Point<f64>, p: Point<f64>) -> bool {
    (a.x - p.x) * (b.x - p.x) + (a.y - p.y) * (b.y - p.y) < 0.0
}
