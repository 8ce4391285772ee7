//! Where C touches itself or turns without bound: crossings, T-junctions, cusps and retracted handles.
//!
//! At these points lfs is zero and no finite ε-sample exists; the floored condition holds around them. Pairs of pieces
//! are halved while their discs meet, down to the floor that the condition uses everywhere (1e-7 of the diagonal):
//! whatever comes nearer than that counts as a contact, whatever does not is an ordinary stroke with a small lfs.
//! A crossing of a cubic with itself has a closed form. Contacts within 1e-4 of the diagonal of one another lie on the
//! same floored stretch (which is at least 1e-3 long), so one of them is enough; overlaps thus stay affordable.

use crate::curve::Cubic;
use crate::door::Drawing;
use crate::plane::{V2, minimise};

/// A point of C where the floored condition holds, as places on obstacles.
#[derive(Clone, Debug)]
pub(crate) struct Contact {
    pub(crate) at: V2,
    pub(crate) places: Vec<(usize, f64)>,
}

/// Share of the diagonal below which curves touch and radii of curvature vanish.
pub(crate) const TOUCH: f64 = 1e-7;

struct Pair<'a> {
    drawing: &'a Drawing,
    i: usize,
    j: usize,
    /// Shared vertices, where touching means nothing.
    shared: Vec<V2>,
    found: Vec<Contact>,
    budget: u32,
}

impl Pair<'_> {
    fn search(&mut self, a: (f64, f64), b: (f64, f64)) {
        let touch = TOUCH * self.drawing.diagonal;
        let (ca, ra) = self.drawing.cubics[self.i].disc(a.0, a.1);
        let (cb, rb) = self.drawing.cubics[self.j].disc(b.0, b.1);
        if ca.distance(cb) > ra + rb + touch || self.budget == 0 {
            return;
        }
        self.budget -= 1;
        let near = 1e-4 * self.drawing.diagonal;
        let inside = |p: V2, q: V2| ca.distance(p) + ra < near && cb.distance(q) + rb < near;
        if self.shared.iter().any(|&v| inside(v, v)) || self.found.iter().any(|c| inside(c.at, c.at)) {
            return;
        }
        if ra.max(rb) < 0.5 * touch {
            let places = vec![(self.i, 0.5 * (a.0 + a.1)), (self.j, 0.5 * (b.0 + b.1))];
            self.found.push(Contact { at: ca, places });
            return;
        }
        if ra >= rb {
            let m = 0.5 * (a.0 + a.1);
            self.search((a.0, m), b);
            self.search((m, a.1), b);
        } else {
            let m = 0.5 * (b.0 + b.1);
            self.search(a, (b.0, m));
            self.search(a, (m, b.1));
        }
    }
}

/// The parameters at which a cubic crosses itself: a₁ + a₂ (s+t) + a₃ (s²+st+t²) = 0, linear in two unknowns.
fn loop_of(c: &Cubic) -> Option<(f64, f64)> {
    let [a1, a2, a3] = c.a;
    let det = a2.cross(a3);
    if det == 0.0 {
        return None;
    }
    let sum = -a1.cross(a3) / det;
    let product = sum * sum - a1.cross(a2) / det;
    let root = sum * sum - 4.0 * product;
    if root <= 0.0 {
        return None;
    }
    let (s, t) = (0.5 * (sum - root.sqrt()), 0.5 * (sum + root.sqrt()));
    (s >= 0.0 && t <= 1.0 && !(s < 1e-9 && t > 1.0 - 1e-9)).then_some((s, t))
}

/// Where the radius of curvature falls below `limit`: at most the two ends and the slowest places between.
fn sharp(c: &Cubic, limit: f64) -> Vec<f64> {
    if c.a[1].norm2() == 0.0 && c.a[2].norm2() == 0.0 {
        return Vec::new();
    }
    let speed = |t: f64| c.velocity(t).norm();
    let mut places = vec![0.0, 1.0];
    for i in 0..4 {
        let (lo, hi) = (f64::from(i) / 4.0, f64::from(i + 1) / 4.0);
        places.push(minimise(speed, lo, hi, 1e-12).0);
    }
    places.retain(|&t| {
        let v = c.velocity(t);
        let bend = v.cross(c.acceleration(t)).abs();
        v.norm() <= 0.01 * limit || v.norm().powi(3) < limit * bend
    });
    places.sort_by(f64::total_cmp);
    places.dedup_by(|a, b| c.length_bound(*b, *a) < limit);
    places
}

/// All contacts of a drawing.
pub(crate) fn contacts(drawing: &Drawing) -> Vec<Contact> {
    let limit = TOUCH * drawing.diagonal;
    let mut out = Vec::new();
    for (i, c) in drawing.cubics.iter().enumerate() {
        out.extend(sharp(c, limit).into_iter().map(|t| Contact { at: c.at(t), places: vec![(i, t)] }));
        if let Some((s, t)) = loop_of(c) {
            out.push(Contact { at: c.at(s), places: vec![(i, s), (i, t)] });
        }
    }
    let discs: Vec<_> = drawing.cubics.iter().map(|c| c.disc(0.0, 1.0)).collect();
    for i in 0..drawing.cubics.len() {
        for j in i + 1..drawing.cubics.len() {
            if discs[i].0.distance(discs[j].0) > discs[i].1 + discs[j].1 + limit {
                continue;
            }
            let shared = drawing.ends[i].iter().filter(|v| drawing.ends[j].contains(v));
            let shared = shared.map(|&v| drawing.vertices[v].at).collect();
            let mut pair = Pair { drawing, i, j, shared, found: Vec::new(), budget: 2_000_000 };
            pair.search((0.0, 1.0), (0.0, 1.0));
            out.append(&mut pair.found);
        }
    }
    for v in drawing.vertices.iter().filter(|v| !v.smooth && v.branches.len() > 1) {
        let places = v.branches.iter().map(|b| (b.cubic, if b.last { 1.0 } else { 0.0 })).collect();
        out.push(Contact { at: v.at, places });
    }
    out
}
