//! The largest empty tangent disk, one foot at a time, by search over the whole of C.
//!
//! At a foot point f with unit direction d the disk of radius r touches q where 1/(2r) = d·w / |w|², w = q − f. So the
//! wanted curvature k = 1/(2r) is the *supremum* of d·w/|w|² over C, zero for a half-plane, infinite where C enters
//! every disk. The search keeps the best k found so far and visits pieces of C in three ways:
//!
//! - **near f**, where w and d·w both vanish, by divided differences: with B(t) − B(s) = (t−s) D(t), the normal part of
//!   D is (t−s) E(t), and k = E / (|B′(s)| |D|²) is a smooth function. This holds as long as D keeps within half its
//!   length of B′(s), the *zone* of f. The zone is continued across a smooth joint by the same algebra, and from a
//!   vertex it starts in every branch.
//! - **elsewhere**, each piece lies in a disc (c, ρ), and can matter only if k(|c−f|² − ρ²) < d·(c−f) + ρ. Pieces that
//!   pass are halved until they are small against their distance from f;
//! - then the maximum on the piece is where the derivative of d·w/|w|² changes sign, or at an end.
//!
//! Nothing is remembered between feet but one touching point, which only speeds the search up.

use crate::curve::Cubic;
use crate::door::{Drawing, End};
use crate::plane::{V2, minimise};

/// Where a disk touches from: the foot point and its direction.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Foot {
    /// Inside an obstacle at t, on its left (+1, direction (−B′y, B′x)) or right (−1).
    Side { cubic: usize, t: f64, side: f64 },
    /// At a vertex, in a direction of its cone. `normal`: perpendicular to both branches of a smooth vertex.
    Vertex { vertex: usize, d: V2, normal: bool },
}

/// A place on an obstacle.
pub(crate) type Touch = Option<(usize, f64)>;

/// A largest empty tangent disk.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Disk {
    /// The foot point.
    pub(crate) at: V2,
    /// Unit direction to the centre.
    pub(crate) d: V2,
    /// 1/(2r).
    pub(crate) k: f64,
    /// What it touches, if anything beyond its own foot point.
    pub(crate) touch: Touch,
}

impl Disk {
    /// Radius; infinite for a half-plane.
    pub(crate) fn radius(&self) -> f64 {
        if self.k > 0.0 { 0.5 / self.k } else { f64::INFINITY }
    }

    /// Centre, unless the disk is a half-plane.
    pub(crate) fn centre(&self) -> Option<V2> {
        (self.k > 0.0).then(|| self.at + self.d * self.radius())
    }
}

struct Leaf {
    t0: f64,
    t1: f64,
    centre: V2,
    reach: f64,
}

struct Block {
    cubic: usize,
    centre: V2,
    reach: f64,
    leaves: Vec<Leaf>,
}

/// The curve with what the search needs: discs around pieces, and both readings of every cubic.
pub(crate) struct Scene {
    pub(crate) drawing: Drawing,
    backwards: Vec<Cubic>,
    blocks: Vec<Block>,
}

/// Pieces are cut until their handles turn by less than this cosine says (30°).
const STRAIGHT: f64 = 0.866;

fn cut(c: &Cubic, t0: f64, t1: f64, depth: u32, out: &mut Vec<Leaf>) {
    let (u, v, m) = (c.velocity(t0), c.velocity(t1), c.velocity(0.5 * (t0 + t1)));
    let bent = |a: V2, b: V2| a.dot(b) < STRAIGHT * a.norm() * b.norm();
    if depth < 3 || (depth < 8 && (bent(u, v) || bent(u, m) || bent(m, v))) {
        let tm = 0.5 * (t0 + t1);
        cut(c, t0, tm, depth + 1, out);
        cut(c, tm, t1, depth + 1, out);
    } else {
        let (centre, reach) = c.disc(t0, t1);
        out.push(Leaf { t0, t1, centre, reach });
    }
}

/// The largest τ ≥ 0 with a τ + b τ² ≤ half of `speed`.
fn zone(speed: f64, a: f64, b: f64) -> f64 {
    let c = 0.5 * speed;
    if c <= 0.0 {
        0.0
    } else {
        // The root of b τ² + a τ − c in its stable form.
        2.0 * c / (a + (a * a + 4.0 * b * c).sqrt()).max(1e-300)
    }
}

/// Parameter ranges of one cubic that divided differences have covered already.
#[derive(Default)]
struct Covered {
    ranges: Vec<(usize, f64, f64)>,
}

impl Covered {
    fn mark(&mut self, cubic: usize, lo: f64, hi: f64) {
        self.ranges.push((cubic, lo.max(0.0), hi.min(1.0)));
    }

    fn touches(&self, cubic: usize) -> bool {
        self.ranges.iter().any(|r| r.0 == cubic)
    }

    /// What is left of [0, 1] on this cubic.
    fn rest(&self, cubic: usize) -> Vec<(f64, f64)> {
        let mut taken: Vec<(f64, f64)> = self.ranges.iter().filter(|r| r.0 == cubic).map(|r| (r.1, r.2)).collect();
        taken.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut from, mut out) = (0.0, Vec::new());
        for (lo, hi) in taken {
            if lo > from {
                out.push((from, lo));
            }
            from = f64::max(from, hi);
        }
        if from < 1.0 {
            out.push((from, 1.0));
        }
        out
    }
}

/// One search: the disk so far.
struct Search<'a> {
    scene: &'a Scene,
    f: V2,
    d: V2,
    k: f64,
    touch: Touch,
    /// Cubics that hold f, with its parameter: B(t) − f has the factor t − s there, which must be divided out before
    /// rounding sets in, however far t is.
    own: Vec<(usize, f64)>,
    foot: Foot,
    /// Neighbours of the cubic that holds f, by their end at the common vertex, and the way from f to that vertex.
    next: Vec<(End, V2)>,
}

impl Search<'_> {
    fn offer(&mut self, k: f64, cubic: usize, t: f64) {
        if k > self.k {
            self.k = k;
            self.touch = Some((cubic, t));
        }
    }

    /// w = B(t) − f and B′(t), read from the nearer end of the cubic.
    fn offset(&self, cubic: usize, t: f64) -> (V2, V2) {
        if let Some(&(end, way)) = self.next.iter().find(|(e, _)| e.cubic == cubic && e.last == (t > 0.5)) {
            let c = self.scene.branch(end);
            let v = if end.last { 1.0 - t } else { t };
            let beyond = ((c.a[2] * v + c.a[1]) * v + c.a[0]) * v;
            return (way + beyond, if end.last { -c.velocity(v) } else { c.velocity(v) });
        }
        if t <= 0.5 {
            let c = &self.scene.drawing.cubics[cubic];
            (c.relative_to(self.f, t), c.velocity(t))
        } else {
            let c = &self.scene.backwards[cubic];
            (c.relative_to(self.f, 1.0 - t), -c.velocity(1.0 - t))
        }
    }

    /// The same as [`Self::far_point`] on a cubic that leaves f: w = v·D, d·w = v·(d·D).
    fn own_point(&mut self, cubic: usize, t: f64, s: f64) -> f64 {
        let c = &self.scene.drawing.cubics[cubic];
        let [a1, a2, a3] = c.a;
        let v = t - s;
        let (e1, e2) = (c.velocity(s), a2 + a3 * (3.0 * s));
        let (chord, turn) = (e1 + (e2 + a3 * v) * v, e2 + a3 * (2.0 * v));
        let l = chord.norm2();
        let level = match self.foot {
            Foot::Side { .. } => true,
            Foot::Vertex { normal, .. } => normal || self.d.dot(e1).abs() <= 1e-12 * a1.norm(),
        };
        let (n2, n3) = (self.d.dot(e2), self.d.dot(a3));
        let (n, dn) = if level {
            (n2 + n3 * v, n3)
        } else {
            let n1 = self.d.dot(e1);
            (n1 / v + n2 + n3 * v, n3 - n1 / (v * v))
        };
        if l == 0.0 {
            self.offer(f64::INFINITY, cubic, t);
            return 0.0;
        }
        self.offer(n / l, cubic, t);
        dn * l - 2.0 * n * chord.dot(turn)
    }

    /// k of a single far point, and the sign of its derivative in t.
    fn far_point(&mut self, cubic: usize, t: f64) -> f64 {
        let own = self.own.iter().filter(|o| o.0 == cubic).map(|o| o.1);
        if let Some(s) = own.min_by(|a, b| (a - t).abs().total_cmp(&(b - t).abs())) {
            return self.own_point(cubic, t, s);
        }
        let (w, v) = self.offset(cubic, t);
        let (n, l) = (self.d.dot(w), w.norm2());
        if l == 0.0 {
            self.offer(f64::INFINITY, cubic, t);
            return 0.0;
        }
        self.offer(n / l, cubic, t);
        self.d.dot(v) * l - 2.0 * n * w.dot(v)
    }

    /// The maximum of k on a piece that is small against its distance.
    fn far_maximum(&mut self, cubic: usize, t0: f64, t1: f64) {
        for t in [t0, t1] {
            self.far_point(cubic, t);
        }
        // At an end with a retracted handle the derivative vanishes: its sign is asked a little inside.
        let hair = 1e-7 * (t1 - t0);
        let (t0, t1) = (t0 + hair, t1 - hair);
        let tm = 0.5 * (t0 + t1);
        let g = [self.far_point(cubic, t0), self.far_point(cubic, tm), self.far_point(cubic, t1)];
        for (a, b, ga, gb) in [(t0, tm, g[0], g[1]), (tm, t1, g[1], g[2])] {
            if !(ga > 0.0 && gb < 0.0) {
                continue;
            }
            // Regula falsi after Illinois: the value is flat at the maximum, so few steps reach full precision.
            let (mut a, mut b, mut ga, mut gb, mut last) = (a, b, ga, gb, 0);
            for _ in 0..40 {
                let t = (a * gb - b * ga) / (gb - ga);
                let t = if t > a && t < b { t } else { 0.5 * (a + b) };
                let gt = self.far_point(cubic, t);
                if gt == 0.0 || b - a < 1e-9 * (t1 - t0) {
                    break;
                }
                let step = if gt > 0.0 { t - a } else { b - t };
                if gt > 0.0 {
                    (a, ga) = (t, gt);
                    if last == 1 {
                        gb *= 0.5;
                    }
                    last = 1;
                } else {
                    (b, gb) = (t, gt);
                    if last == -1 {
                        ga *= 0.5;
                    }
                    last = -1;
                }
                if step < 1e-9 * (t1 - t0) {
                    break;
                }
            }
        }
    }

    /// Whether a disc can hold a point that matters.
    fn matters(&self, centre: V2, reach: f64) -> bool {
        let w = centre - self.f;
        self.k * (w.norm2() - reach * reach) < self.d.dot(w) + reach
    }

    fn far(&mut self, cubic: usize, t0: f64, t1: f64, disc: (V2, f64), depth: u32) {
        if !self.matters(disc.0, disc.1) || self.k == f64::INFINITY {
            return;
        }
        let clear = disc.0.distance(self.f) - disc.1;
        // Where f all but touches the curve, pieces of the size of rounding are points; halving them leads nowhere.
        let point = disc.1 <= 1e-14 * self.scene.drawing.diagonal;
        if disc.1 <= 0.3 * clear || point || depth > 60 {
            self.far_maximum(cubic, t0, t1);
            return;
        }
        let tm = 0.5 * (t0 + t1);
        let c = &self.scene.drawing.cubics[cubic];
        let halves = [(t0, tm, c.disc(t0, tm)), (tm, t1, c.disc(tm, t1))];
        // The nearer half first: it shrinks the disk more.
        let order = if halves[0].2.0.distance(self.f) <= halves[1].2.0.distance(self.f) { [0, 1] } else { [1, 0] };
        for i in order {
            let (a, b, disc) = halves[i];
            self.far(cubic, a, b, disc, depth + 1);
        }
    }

    /// Everything that the zone does not cover.
    fn sweep(&mut self, covered: &Covered) {
        let scene = self.scene;
        for block in &scene.blocks {
            if !self.matters(block.centre, block.reach) {
                continue;
            }
            if covered.touches(block.cubic) {
                for (lo, hi) in covered.rest(block.cubic) {
                    let disc = scene.drawing.cubics[block.cubic].disc(lo, hi);
                    self.far(block.cubic, lo, hi, disc, 0);
                }
            } else {
                for leaf in &block.leaves {
                    self.far(block.cubic, leaf.t0, leaf.t1, (leaf.centre, leaf.reach), 0);
                }
            }
        }
    }

    /// Polishes the maxima of a near function sampled at increasing places; `back` turns a place into a parameter.
    fn near_maxima(&mut self, cubic: usize, places: &[f64], f: impl Fn(f64) -> f64, back: impl Fn(f64) -> f64) {
        let values: Vec<f64> = places.iter().map(|&x| f(x)).collect();
        let last = places.len() - 1;
        for (i, &value) in values.iter().enumerate() {
            self.offer(value, cubic, back(places[i]));
            // A smooth function does not rise to more than twice its samples between them.
            if 2.0 * value <= self.k || self.k == f64::INFINITY {
                continue;
            }
            let (lo, hi) = (places[i.saturating_sub(1)], places[(i + 1).min(last)]);
            let peak = if i == 0 || i == last {
                // A maximum between an end and its neighbour shows in the slope at the end.
                f(places[i] + 1e-3 * (if i == 0 { hi } else { lo } - places[i])) > value
            } else {
                value > values[i - 1] && value >= values[i + 1]
            };
            if peak {
                let (x, k) = minimise(|x| -f(x), lo, hi, 1e-6 * (hi - lo));
                self.offer(-k, cubic, back(x));
            }
        }
    }

    /// A branch that leaves f itself with v ↦ f + v (b₁ + b₂ v + b₃ v²); `level`: d is perpendicular to b₁.
    fn near_branch(&mut self, end: End, level: bool, covered: &mut Covered) {
        let c = self.scene.branch(end);
        let [b1, b2, b3] = c.a;
        let d = self.d;
        let slope = d.dot(b1);
        let slope = if level || slope.abs() <= 1e-12 * b1.norm() { 0.0 } else { slope };
        if slope > 0.0 {
            self.offer(f64::INFINITY, end.cubic, if end.last { 1.0 } else { 0.0 });
            return;
        }
        let speed = b1.norm();
        let limit = if speed > 0.0 {
            zone(speed, b2.norm(), b3.norm()).min(1.0)
        } else {
            zone(b2.norm(), b3.norm(), 0.0).min(1.0)
        };
        if limit <= 0.0 {
            return;
        }
        let (mut n2, n3) = (d.dot(b2), d.dot(b3));
        if speed == 0.0 {
            // A retracted handle: b₂ is the direction, and takes the place of b₁ in what the cone demands.
            if n2.abs() <= 1e-12 * b2.norm() {
                n2 = 0.0;
            }
            if n2 > 0.0 {
                self.offer(f64::INFINITY, end.cubic, if end.last { 1.0 } else { 0.0 });
                return;
            }
        }
        let f = |v: f64| {
            let chord = b1 + (b2 + b3 * v) * v;
            let l = chord.norm2();
            if slope == 0.0 && speed > 0.0 { (n2 + n3 * v) / l } else { (slope / v + n2 + n3 * v) / l }
        };
        let mut places = vec![limit];
        let finest = 1e-9 * limit;
        let mut v = 0.6 * limit;
        while v > finest {
            places.push(v);
            // With no slope the function is smooth at zero: a few places do.
            v *= if slope == 0.0 && speed > 0.0 { 0.4 } else { 0.6 };
            if slope == 0.0 && speed > 0.0 && places.len() > 7 {
                break;
            }
        }
        if speed > 0.0 && slope == 0.0 {
            places.push(0.0);
        }
        places.reverse();
        let back = |v: f64| if end.last { 1.0 - v } else { v };
        self.near_maxima(end.cubic, &places, f, back);
        let (lo, hi) = if end.last { (1.0 - limit, 1.0) } else { (0.0, limit) };
        covered.mark(end.cubic, lo, hi);
    }

    /// The zone of a foot point inside a cubic, on that cubic and across smooth joints.
    fn near_side(&mut self, cubic: usize, s: f64, side: f64, covered: &mut Covered) {
        let scene = self.scene;
        let c = &scene.drawing.cubics[cubic];
        let [_, a2, a3] = c.a;
        let velocity = c.velocity(s);
        let speed = velocity.norm();
        let e2 = a2 + a3 * (3.0 * s);
        let limit = zone(speed, e2.norm(), a3.norm());
        let (c2, c3) = (side * velocity.cross(e2), side * velocity.cross(a3));
        let own = |tau: f64| {
            let chord = velocity + (e2 + a3 * tau) * tau;
            (c2 + c3 * tau) / (speed * chord.norm2())
        };
        let (lo, hi) = ((-limit).max(-s), limit.min(1.0 - s));
        if c2 != 0.0 || c3 != 0.0 {
            let places: Vec<f64> = (0..9)
                .map(|i| {
                    let x = f64::from(i - 4) / 4.0;
                    if x < 0.0 { -x * lo } else { x * hi }
                })
                .collect();
            self.near_maxima(cubic, &places, own, |tau| s + tau);
        }
        covered.mark(cubic, if lo <= -s { 0.0 } else { s + lo }, if hi >= 1.0 - s { 1.0 } else { s + hi });
        for last in [false, true] {
            let u = if last { 1.0 - s } else { s };
            let vertex = &scene.drawing.vertices[scene.drawing.ends[cubic][usize::from(last)]];
            if u > limit || !vertex.smooth {
                continue;
            }
            let me = End { cubic, last };
            let Some(&next) = vertex.branches.iter().find(|&&b| b != me) else { continue };
            let [b1, b2, b3] = scene.branch(next).a;
            let reach = zone(b1.norm(), b2.norm(), b3.norm()).min(1.0);
            // With f behind the joint by u: joint − f = u·back, and B′(s) = g·μ·b₁ − g·u·m.
            let g = if last { 1.0 } else { -1.0 };
            let e = if last { 1.0 } else { 0.0 };
            let tau = e - s;
            let back = (velocity + (e2 + a3 * tau) * tau) * g;
            let m = a2 * 2.0 + a3 * (3.0 * (s + e));
            let mu = c.velocity(e).norm() / b1.norm();
            let own_part = u * u * (c2 + c3 * tau) * side;
            let (x2, x3) = (b1.cross(b2), b1.cross(b3));
            let across = |v: f64| {
                let d = b1 + (b2 + b3 * v) * v;
                let n = own_part + g * (mu * v * v * (x2 + x3 * v) - u * v * m.cross(d));
                side * n / (speed * (back * u + d * v).norm2())
            };
            let mut places = vec![reach];
            let finest = 0.02 * u * speed / b1.norm();
            let mut v = 0.6 * reach;
            while v > finest && places.len() < 90 {
                places.push(v);
                v *= 0.6;
            }
            // Where curvature jumps, the touching point may lie at v far below u: the slope at the joint itself tells.
            places.extend([v, 0.0]);
            places.reverse();
            self.near_maxima(next.cubic, &places, across, |v| if next.last { 1.0 - v } else { v });
            let (lo, hi) = if next.last { (1.0 - reach, 1.0) } else { (0.0, reach) };
            covered.mark(next.cubic, lo, hi);
        }
    }
}

impl Scene {
    /// Prepares a drawing.
    pub(crate) fn new(drawing: Drawing) -> Scene {
        let backwards = drawing.cubics.iter().map(Cubic::reversed).collect();
        let blocks = drawing
            .cubics
            .iter()
            .enumerate()
            .map(|(cubic, c)| {
                let mut leaves = Vec::new();
                cut(c, 0.0, 1.0, 0, &mut leaves);
                let sum = leaves.iter().fold(V2::default(), |s, l| s + l.centre);
                #[expect(clippy::cast_precision_loss, reason = "a cubic has at most 256 leaves")]
                let centre = sum * (1.0 / leaves.len() as f64);
                let reach = leaves.iter().map(|l| l.centre.distance(centre) + l.reach).fold(0.0, f64::max);
                Block { cubic, centre, reach, leaves }
            })
            .collect();
        Scene { drawing, backwards, blocks }
    }

    fn branch(&self, end: End) -> Cubic {
        if end.last { self.backwards[end.cubic] } else { self.drawing.cubics[end.cubic] }
    }

    /// The largest empty disk at a foot; `hint` is a touching point to start from.
    pub(crate) fn disk(&self, foot: Foot, hint: Touch) -> Disk {
        let mut covered = Covered::default();
        let (f, d) = match foot {
            Foot::Side { cubic, t, side } => {
                let c = &self.drawing.cubics[cubic];
                (c.at(t), c.velocity(t).perp().unit() * side)
            }
            Foot::Vertex { vertex, d, .. } => (self.drawing.vertices[vertex].at, d),
        };
        let own = match foot {
            Foot::Side { cubic, t, .. } => vec![(cubic, t)],
            Foot::Vertex { vertex, .. } => {
                let ends = self.drawing.vertices[vertex].branches.iter();
                ends.map(|e| (e.cubic, if e.last { 1.0 } else { 0.0 })).collect()
            }
        };
        let mut search = Search { scene: self, f, d, k: 0.0, touch: None, own, foot, next: Vec::new() };
        if let Foot::Side { cubic, t, .. } = foot {
            let c = &self.drawing.cubics[cubic];
            for last in [false, true] {
                let v = (if last { 1.0 } else { 0.0 }) - t;
                let way = (c.velocity(t) + (c.a[1] + c.a[2] * (3.0 * t + v)) * v) * v;
                let me = End { cubic, last };
                let vertex = &self.drawing.vertices[self.drawing.ends[cubic][usize::from(last)]];
                search.next.extend(vertex.branches.iter().filter(|&&b| b != me).map(|&b| (b, way)));
            }
        }
        if let Some((cubic, t)) = hint {
            // A point near f is left to divided differences: rounding spoils the quotient there.
            let (w, _) = search.offset(cubic, t);
            if d.dot(w) > 1e-7 * self.drawing.diagonal {
                search.far_point(cubic, t);
            }
        }
        match foot {
            Foot::Side { cubic, t, side } => {
                if self.drawing.cubics[cubic].velocity(t).norm2() == 0.0 {
                    return Disk { at: f, d, k: f64::INFINITY, touch: None };
                }
                search.near_side(cubic, t, side, &mut covered);
            }
            Foot::Vertex { vertex, normal, .. } => {
                for &end in &self.drawing.vertices[vertex].branches {
                    search.near_branch(end, normal, &mut covered);
                }
            }
        }
        search.sweep(&covered);
        Disk { at: f, d, k: search.k, touch: search.touch }
    }
}
