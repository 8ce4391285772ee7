//! Dense feet over the whole foot set, and the medial points they carry.
//!
//! M consists of the centres f + r·d of largest empty tangent disks over all pairs (f, d) with d·u ≤ 0 for every branch
//! direction u that leaves f, together with the corners, crossings and cusps themselves. The pairs form *strands*: each
//! side of each cubic, and one fan of directions at each open end or corner. Along a strand the centre moves
//! continuously, so a strand is refined until neighbouring centres are close against their radius and the centre in the
//! middle lies near the chord between them. Radii, not lengths, set the scale: the disk is empty, so whatever looks at
//! a medial point of radius r stands at least r away from it.

use crate::disk::{Disk, Foot, Scene, Touch};
use crate::plane::{V2, v2};

/// What a strand is made of.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// Parameter: t of the cubic.
    Side { cubic: usize, side: f64 },
    /// Parameter: the angle of the direction.
    Fan { vertex: usize },
}

/// One foot of a strand.
#[derive(Clone, Copy, Debug)]
struct Stop {
    x: f64,
    at: V2,
    centre: Option<V2>,
    radius: f64,
    touch: Touch,
}

/// A stretch of medial axis between two neighbouring feet of a strand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    pub(crate) strand: usize,
    pub(crate) x: [f64; 2],
    pub(crate) a: V2,
    pub(crate) b: V2,
    /// How far the true stretch may leave the chord, by the deviations seen (not a bound).
    pub(crate) slack: f64,
    hint: Touch,
}

/// The dense medial axis.
pub(crate) struct Medial {
    kinds: Vec<Kind>,
    /// Stretches; a single medial point is one of length zero.
    pub(crate) links: Vec<Link>,
    /// Number of disks computed.
    pub(crate) feet: usize,
}

/// Neighbouring centres are at most this share of their radius apart.
const STEP: f64 = 0.05;
/// The centre in the middle is at most this share of the radius off the chord.
const BEND: f64 = 5e-4;

struct Walk<'a> {
    scene: &'a Scene,
    kind: Kind,
    strand: usize,
    floor: f64,
    grain: f64,
    far: f64,
    links: Vec<Link>,
    feet: usize,
}

impl Kind {
    fn foot(self, scene: &Scene, x: f64) -> Foot {
        match self {
            Kind::Side { cubic, side } => {
                let drawing = &scene.drawing;
                if x > 0.0 && x < 1.0 {
                    return Foot::Side { cubic, t: x, side };
                }
                let last = x >= 1.0;
                let leaving = drawing.branch(crate::door::End { cubic, last }).leaving();
                let along = if last { -leaving } else { leaving };
                let vertex = drawing.ends[cubic][usize::from(last)];
                Foot::Vertex { vertex, d: along.perp() * side, normal: drawing.vertices[vertex].smooth }
            }
            Kind::Fan { vertex } => Foot::Vertex { vertex, d: v2(x.cos(), x.sin()), normal: false },
        }
    }
}

impl Walk<'_> {
    fn stop(&mut self, x: f64, hint: Touch) -> Stop {
        self.feet += 1;
        let disk = self.scene.disk(self.kind.foot(self.scene, x), hint);
        let radius = disk.radius();
        Stop { x, at: disk.at, centre: if radius < self.far { disk.centre() } else { None }, radius, touch: disk.touch }
    }

    fn refine(&mut self, a: Stop, b: Stop, depth: u32) {
        let (Some(ca), Some(cb)) = (a.centre, b.centre) else {
            // Towards a half-plane: follow the axis outwards while it may still be nearest to anything.
            let near = a.radius.min(b.radius);
            if (near < 0.01 * self.far || depth < 3) && depth < 34 {
                let m = self.stop(0.5 * (a.x + b.x), if a.radius < b.radius { a.touch } else { b.touch });
                self.refine(a, m, depth + 1);
                self.refine(m, b, depth + 1);
            }
            return;
        };
        let radius = a.radius.min(b.radius);
        let length = ca.distance(cb);
        // Feet that all but coincide carry no more information than rounding leaves them (fans: angles).
        let side = matches!(self.kind, Kind::Side { .. });
        let same = side && a.at.distance(b.at) < self.grain;
        let small = length <= self.floor || same || depth >= 32;
        let m = self.stop(0.5 * (a.x + b.x), a.touch);
        let Some(cm) = m.centre else {
            if depth < 34 {
                self.refine(a, m, depth + 1);
                self.refine(m, b, depth + 1);
            }
            return;
        };
        let off = cm.distance_to_segment(ca, cb).0;
        let coarse = length > STEP * radius || off > BEND * radius || ca.distance(cm).max(cm.distance(cb)) > length;
        if !small && coarse && (radius < 0.01 * self.far) {
            self.refine(a, m, depth + 1);
            self.refine(m, b, depth + 1);
            return;
        }
        let slack = 2.0 * off + 1e-3 * length;
        for (p, q) in [(a, m), (m, b)] {
            if let (Some(u), Some(v)) = (p.centre, q.centre) {
                self.links.push(Link { strand: self.strand, x: [p.x, q.x], a: u, b: v, slack, hint: p.touch });
            }
        }
    }

    fn run(&mut self, x0: f64, x1: f64, parts: u32) {
        let mut before = self.stop(x0, None);
        for i in 1..=parts {
            let x = if i == parts { x1 } else { x0 + (x1 - x0) * f64::from(i) / f64::from(parts) };
            let next = self.stop(x, before.touch);
            self.refine(before, next, 0);
            before = next;
        }
    }
}

/// The cone of directions d with d·u ≤ 0 for all u, as an interval of angles, if it has an inside.
fn cone(directions: &[V2]) -> Option<(f64, f64)> {
    use std::f64::consts::{FRAC_PI_2, PI, TAU};
    let opposite: Vec<f64> = directions.iter().map(|u| (-u.y).atan2(-u.x)).collect();
    let first = *opposite.first()?;
    let (mut lo, mut hi) = (-FRAC_PI_2, FRAC_PI_2);
    for angle in &opposite {
        let by = (angle - first + PI).rem_euclid(TAU) - PI;
        lo = lo.max(by - FRAC_PI_2);
        hi = hi.min(by + FRAC_PI_2);
    }
    (hi - lo > 1e-9).then_some((first + lo, first + hi))
}

impl Medial {
    /// The medial axis of a scene; `special` are points of C that belong to it themselves (crossings, cusps).
    pub(crate) fn new(scene: &Scene, special: &[V2]) -> Medial {
        let drawing = &scene.drawing;
        let mut out = Medial { kinds: Vec::new(), links: Vec::new(), feet: 0 };
        let sides = (0..drawing.cubics.len()).flat_map(|cubic| [1.0, -1.0].map(|side| Kind::Side { cubic, side }));
        let mut strands: Vec<(Kind, f64, f64, u32)> = sides.map(|kind| (kind, 0.0, 1.0, 8)).collect();
        let mut points = special.to_vec();
        for (vertex, v) in drawing.vertices.iter().enumerate().filter(|(_, v)| !v.smooth) {
            let directions: Vec<V2> = v.branches.iter().map(|&b| drawing.branch(b).leaving()).collect();
            if let Some((lo, hi)) = cone(&directions) {
                strands.push((Kind::Fan { vertex }, lo, hi, 8));
            }
            if directions.len() > 1 {
                points.push(v.at);
            }
        }
        for (kind, x0, x1, parts) in strands {
            let mut walk = Walk {
                scene,
                kind,
                strand: out.kinds.len(),
                floor: 2e-6 * drawing.diagonal,
                grain: 1e-10 * drawing.diagonal,
                far: 1e4 * drawing.diagonal,
                links: Vec::new(),
                feet: 0,
            };
            walk.run(x0, x1, parts);
            out.feet += walk.feet;
            out.links.append(&mut walk.links);
            out.kinds.push(kind);
        }
        for p in points {
            out.links.push(Link { strand: usize::MAX, x: [0.0, 0.0], a: p, b: p, slack: 0.0, hint: None });
        }
        out
    }

    /// The disk at a place of an obstacle, on its left (+1) or right (−1).
    pub(crate) fn side(&self, scene: &Scene, cubic: usize, t: f64, side: f64) -> Disk {
        scene.disk(Kind::Side { cubic, side }.foot(scene, t), None)
    }

    /// The disk of a strand's foot at x.
    pub(crate) fn disk(&self, scene: &Scene, strand: usize, x: f64, hint: Touch) -> Disk {
        scene.disk(self.kinds[strand].foot(scene, x), hint)
    }

    /// A touching point near those of a link.
    pub(crate) fn hint(&self, link: usize) -> Touch {
        self.links[link].hint
    }
}
