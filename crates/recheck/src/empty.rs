//! Claims about radii, evaluated.
//!
//! r(f, d) ≥ R for all feet of a cell says that for all of them and all q of C
//!
//! ```text
//! G = |q−f|² − K d·(q−f) ≥ 0,   K = 2R/|d|.
//! ```
//!
//! For a stretch of C, G is a polynomial in its parameter with coefficients that are intervals over the cell, once the factors
//! that vanish where q comes near f are divided out: the forms of section 4 of `docs/certificates.md`, put together here from
//! general polynomials. A stretch that no form settles is halved, or the cell is, whichever is longer.

use feature_sampling::curve::ideal::Enclosed;
use feature_sampling::curve::{EndId, JointKind};
use feature_sampling::geometry::Vector;
use feature_sampling::scalar::Field;

use crate::bernstein::{Real, add_product, disk, least, on};
use crate::feet::{Capsule, Feet, Span, own_bend, points, seen};
use crate::scene::Scene;

/// So many evaluations may one claim take.
const EVALUATIONS: u32 = 20_000;

type Axes<const N: usize> = [[Real; N]; 2];

fn axes<const N: usize>(vectors: [Enclosed<f64>; N]) -> Axes<N> {
    [vectors.map(|v| v.x), vectors.map(|v| v.y)]
}

/// What one claim has left, and what it works with.
pub(crate) struct Work {
    evaluations: u32,
    found: Vec<usize>,
}

impl Work {
    pub(crate) const fn new() -> Self {
        Self { evaluations: 0, found: Vec::new() }
    }
}

/// All tangent disks of this radius at all feet of the cell are empty. `false`: not shown.
pub(crate) fn empty(scene: &Scene<'_>, span: &Span, radius: f64, work: &mut Work) -> bool {
    if radius <= 0.0 {
        return true;
    }
    if !radius.is_finite() {
        return false;
    }
    let disks = Disks::new(scene, span, radius);
    let mut found = std::mem::take(&mut work.found);
    scene.obstacles.near(&disks.centre, disks.reach_sq, &mut found);
    work.evaluations = EVALUATIONS;
    let shown = found.iter().all(|&i| {
        let (segment, range) = scene.stretches[i];
        disks.miss(scene, segment, range, work)
    });
    work.found = found;
    shown
}

/// All tangent disks of one radius at the feet of a cell.
struct Disks {
    span: Span,
    feet: Option<Feet>,
    /// [`Feet::change`].
    change: Option<(Real, Enclosed<f64>)>,
    radius: f64,
    /// They lie within a disk around this point,
    centre: Enclosed<f64>,
    /// of at most this radius, squared.
    reach_sq: f64,
}

impl Disks {
    fn new(scene: &Scene<'_>, span: &Span, radius: f64) -> Self {
        let (centre, spread) = Capsule::new(scene, span).disk(radius);
        let reach = Real::point(radius) + Real::point(spread);
        let feet = Feet::new(scene, span);
        let change = feet.as_ref().and_then(|feet| feet.change(scene, radius));
        Self { span: *span, feet, change, radius, centre, reach_sq: *reach.square().hi() }
    }

    /// A stretch of a segment lies outside all of them.
    fn miss(&self, scene: &Scene<'_>, segment: u32, range: [f64; 2], work: &mut Work) -> bool {
        if scene.bounds(segment, range).distance_sq(&self.centre) > self.reach_sq {
            return true;
        }
        if work.evaluations == 0 {
            return false;
        }
        work.evaluations -= 1;
        if let Some(feet) = &self.feet
            && self.misses(scene, feet, segment, range)
        {
            return true;
        }
        // The longer one is halved; a cell counts as long as its disks move.
        let extent = |v: &Enclosed<f64>| v.x.width().max(v.y.width());
        let own = match (&self.feet, &self.change) {
            (Some(feet), Some((c, _))) => extent(&feet.point) + c.magnitude() * feet.length.hi(),
            _ => f64::INFINITY,
        };
        let [a, b] = range;
        let m = 0.5 * (a + b);
        let its = scene
            .from(EndId::new(segment, 0))
            .map_or(0.0, |o| extent(&crate::feet::box_of(o, Real::point(a), Real::point(b))));
        if its > 0.5 * own && a < m && m < b {
            return self.miss(scene, segment, [a, m], work) && self.miss(scene, segment, [m, b], work);
        }
        let Some(halves) = self.span.halves() else { return false };
        halves.iter().all(|half| Self::new(scene, half, self.radius).miss(scene, segment, range, work))
    }

    /// One of the forms shows it.
    fn misses(&self, scene: &Scene<'_>, feet: &Feet, segment: u32, range: [f64; 2]) -> bool {
        let radius = self.radius;
        let k = Real::point(radius).twice() / feet.length;
        let itself = Some(feet.near).filter(|e| e.segment() == segment);
        let near = if feet.fan.is_some() {
            let mut ends = itself.into_iter().chain(scene.at_point_of(feet.near, segment));
            ends.any(|end| beside_fan(scene, feet, end, range, k))
        } else {
            let mut ends = [feet.near, feet.near.opposite()].into_iter();
            (itself.is_some() && beside_own(scene, feet, range, k))
                || ends.any(|near| {
                    scene.at_point_of(near, segment).any(|other| across(scene, feet, near, other, range, radius))
                })
        };
        near || self.change.as_ref().is_some_and(|change| apart(scene, feet, segment, range, radius, change))
    }
}

/// G by its mean value: one disk, and how the others differ from it.
fn apart(
    scene: &Scene<'_>,
    feet: &Feet,
    segment: u32,
    range: [f64; 2],
    radius: f64,
    (c, axis): &(Real, Enclosed<f64>),
) -> bool {
    let Some(o) = scene.from(EndId::new(segment, 0)) else { return false };
    let [a, b] = seen(range, 0);
    let mean = &feet.mean;
    let k = Real::point(radius).twice() / mean.direction.norm();
    let ([x, y], [mx, my]) = (points(o, a, b, &feet.point), points(o, a, b, &mean.point));
    let share = *c / k;
    let mut ahead = towards(&mx, &my, &mean.direction);
    for (a, t) in ahead.iter_mut().zip(towards(&x, &y, axis)) {
        *a = *a + share * t;
    }
    least(&disk(&mx, &my, k, &ahead)) >= 0.0
}

/// d·(x, y), coefficient by coefficient.
fn towards<const N: usize>(x: &[Real; N], y: &[Real; N], d: &Enclosed<f64>) -> [Real; N] {
    core::array::from_fn(|i| d.x * x[i] + d.y * y[i])
}

/// D with q−f = (v−u)D, as coefficients of powers of v.
fn own_chord(scene: &Scene<'_>, feet: &Feet, u: Real) -> Option<[Enclosed<f64>; 3]> {
    let [c1, c2, c3] = scene.from(feet.near)?.c;
    let d1 = c2.plus_scaled(&u, &c3);
    Some([c1.plus_scaled(&u, &d1), d1, c3])
}

/// The same segment: G/(v−u)² = |D|² ∓ K E.
fn beside_own(scene: &Scene<'_>, feet: &Feet, range: [f64; 2], k: Real) -> bool {
    let (Some(u), Some(o)) = (feet.u, scene.from(feet.near)) else { return false };
    let Some(chord) = own_chord(scene, feet, u) else { return false };
    let [a, b] = seen(range, feet.near.side());
    if o.retracted {
        // E = k₂₃(u + 2v), and u, v ≥ 0: on the side that it bends away from, all is outside.
        let k23 = o.c[1].cross(&o.c[2]);
        if if feet.left { *k23.hi() <= 0.0 } else { *k23.lo() >= 0.0 } {
            return true;
        }
    }
    let bend = own_bend(o, u);
    let bend = on(if feet.left { bend } else { bend.map(|e| -e) }, a, b);
    let [x, y] = axes(chord).map(|c| on(c, a, b));
    least(&disk(&x, &y, k, &bend)[..5]) >= 0.0
}

/// What the form across a joint needs: T×(q−f) and q−f in terms of u, v.
struct Across {
    u: Real,
    /// q−f = v D_Q − u D_F.
    d_f: Enclosed<f64>,
    /// b₁, b₂, b₃.
    q: [Enclosed<f64>; 3],
    /// T×(q−f) = u² own + uv (M × D_Q) + v² (turn₀ + v turn₁) + v first.
    own: Real,
    m: Enclosed<f64>,
    turn: [Real; 2],
    /// Exactly zero at a smooth joint.
    first: Option<Real>,
    /// |T|.
    speed: Real,
    /// The direction is on the left of the tangent that leaves `near`.
    left: bool,
}

impl Across {
    fn new(scene: &Scene<'_>, feet: &Feet, near: EndId, other: EndId) -> Option<Self> {
        let (f, q) = (scene.from(near)?, scene.from(other)?);
        let u = feet.u?;
        let u = if near == feet.near { u } else { Real::int(1) - u };
        let speed = f.derivative(&u).norm();
        if *speed.lo() <= 0.0 {
            return None;
        }
        let [c1, c2, c3] = f.c;
        let (k12, k13, k23) = (c1.cross(&c2), c1.cross(&c3), c2.cross(&c3));
        // Joined smoothly, both have one tangent line.
        let smooth = scene.curve.end(near).is_some_and(|e| e.kind == JointKind::Smooth)
            && scene.curve.joint(near).any(|e| e == other);
        let first = (!smooth).then(|| c1.cross(&q.c[0]));
        Some(Self {
            u,
            d_f: c1.plus_scaled(&u, &c2.plus_scaled(&u, &c3)),
            q: q.c,
            own: (k23 * u + k13.twice()) * u + k12,
            m: c2.scaled(&Real::int(2)).plus_scaled(&u, &c3.scaled(&Real::int(3))),
            turn: [c1.cross(&q.c[1]), c1.cross(&q.c[2])],
            first,
            speed,
            // Seen from the other end the tangent is reversed.
            left: feet.left == (near == feet.near),
        })
    }
}

/// Across a joint: a u² + b uv + c v² with a, b, c bounded over cell and stretch.
fn across(scene: &Scene<'_>, feet: &Feet, near: EndId, other: EndId, range: [f64; 2], radius: f64) -> bool {
    let Some(form) = Across::new(scene, feet, near, other) else { return false };
    let k = Real::point(radius).twice() / form.speed;
    let k = if form.left { k } else { -k };
    // The term of first order: it vanishes, or only takes q away from the disk.
    if form.first.is_some_and(|first| *(first * k).hi() > 0.0) {
        return false;
    }
    let [from, to] = seen(range, other.side());
    let a = form.d_f.norm_sq() - form.own * k;
    let mixed = form.q.map(|b| -(form.d_f.dot(&b).twice() + form.m.cross(&b) * k));
    // The middle one of three weighted coefficients counts twice.
    let [b0, b1, b2] = on(mixed, from, to);
    let b = b0.lo().min(0.5 * *b1.lo()).min(*b2.lo());
    let [x, y] = axes(form.q).map(|c| on(c, from, to));
    let turned = on(form.turn, from, to);
    let weights = [1.0, 4.0, 6.0, 4.0, 1.0];
    let c = disk(&x, &y, k, &turned).into_iter().zip(weights).map(|(c, w)| *(c / Real::point(w)).lo());
    let c = c.fold(f64::INFINITY, f64::min);
    homogeneous(*a.lo(), b, c, form.u, from.hull(&to))
}

/// a u² + b uv + c v² ≥ 0 for all u, v ≥ 0 of these ranges.
///
/// All (u, v) of the rectangle lie in the cone of P = (u most, v least) and Q = (u least, v most). At αP + βQ the form is α²p +
/// 2αβq + β²r with p, r its values at P and Q and q the bilinear one: non-negative for all α, β ≥ 0 if p, r ≥ 0 and (q ≥ 0 or
/// q² ≤ pr).
fn homogeneous(a: f64, b: f64, c: f64, u: Real, v: Real) -> bool {
    let [a, b, c] = [a, b, c].map(Real::point);
    let clamp = |x: &f64| Real::point(x.max(0.0));
    let (u0, u1, v0, v1) = (clamp(u.lo()), clamp(u.hi()), clamp(v.lo()), clamp(v.hi()));
    let value = |u: Real, v: Real| a * u.square() + b * u * v + c * v.square();
    let (p, r) = (value(u1, v0), value(u0, v1));
    let q = a * u0 * u1 + (b * (u1 * v1 + u0 * v0)).half() + c * v0 * v1;
    *p.lo() >= 0.0 && *r.lo() >= 0.0 && (*q.lo() >= 0.0 || q.square().certainly_le(&(p * r)))
}

/// The feet are a fan, the stretch belongs to a branch of its joint: a factor v is divided out, or v².
fn beside_fan(scene: &Scene<'_>, feet: &Feet, end: EndId, range: [f64; 2], k: Real) -> bool {
    let (Some(q), Some(fan)) = (scene.from(end), &feet.fan) else { return false };
    let [from, to] = seen(range, end.side());
    // Where the handle is retracted one more factor goes: D_Q/v.
    let [x, y] = axes(if q.retracted { [q.c[1], q.c[2], Vector::new(Real::int(0), Real::int(0))] } else { q.c })
        .map(|c| on(c, from, to));
    let away = |d: &Enclosed<f64>| least(&towards(&x, &y, &d.opposite())) >= 0.0;
    if away(&feet.direction) {
        return true;
    }
    if feet.near != end {
        return false;
    }
    let held = away(&fan.second);
    if q.retracted {
        // What is left of e₁·(b₂ + v b₃) is v e₁·b₃.
        return held && *fan.first.dot(&q.c[2]).hi() <= 0.0;
    }
    let turned = on([fan.first.dot(&q.c[1]), fan.first.dot(&q.c[2])], from, to);
    let bent = disk(&x, &y, k, &turned);
    if held && least(&bent[..5]) >= 0.0 {
        return true;
    }
    // G/v = v(|D|² − K(1−λ)e₁·(b₂ + v b₃)) − Kλ e₂·D, of degree five: near the joint the last term is what counts.
    let aside = towards(&x, &y, &fan.second.scaled(&(fan.share * k)));
    let mut form = [Real::point(0.0); 7];
    add_product(&mut form, &bent[..5], &[from, to]);
    add_product(&mut form, &aside.map(|a| -a), &[1, 3, 3, 1].map(Real::int));
    least(&form[..6]) >= 0.0
}

/// The radii of the largest empty disks at all feet of a cell are at most this, since they cannot hold the point of C with this
/// segment and parameter; infinite where it shows nothing.
pub(crate) fn reached(scene: &Scene<'_>, feet: &Feet, segment: u32, t: f64) -> f64 {
    let mut best = f64::INFINITY;
    let mut offer = |chord_sq: Real, ahead: Real, length: Real| {
        if *ahead.lo() > 0.0 {
            best = best.min(*(chord_sq * length / ahead.twice()).hi());
        }
    };
    if let Some(q) = scene.from(EndId::new(segment, 0)) {
        let q = q.point(&Real::point(t));
        let d = q.minus(&feet.point);
        offer(d.norm_sq(), feet.direction.dot(&d), feet.length);
        let mean = &feet.mean;
        let ahead = mean.direction.dot(&q.minus(&mean.point)) + mean.off * mean.turning.dot(&d);
        offer(d.norm_sq(), ahead, feet.length);
    }
    if let Some(u) = feet.u {
        if feet.near.segment() == segment
            && let (Some([d0, d1, d2]), Some(o)) = (own_chord(scene, feet, u), scene.from(feet.near))
        {
            let [v, _] = seen([t, t], feet.near.side());
            let [e0, e1] = own_bend(o, u);
            let bend = e1 * v + e0;
            let chord = d0.plus_scaled(&v, &d1.plus_scaled(&v, &d2));
            offer(chord.norm_sq(), if feet.left { bend } else { -bend }, feet.length);
        }
        for near in [feet.near, feet.near.opposite()] {
            for other in scene.at_point_of(near, segment) {
                let Some(f) = Across::new(scene, feet, near, other) else { continue };
                let [v, _] = seen([t, t], other.side());
                let [b1, b2, b3] = f.q;
                let d_q = b1.plus_scaled(&v, &b2.plus_scaled(&v, &b3));
                let first = f.first.map_or(Real::point(0.0), |first| first * v);
                let turned = (f.turn[1] * v + f.turn[0]) * v.square();
                let ahead = f.own * f.u.square() + f.m.cross(&d_q) * f.u * v + turned + first;
                let chord = d_q.scaled(&v).minus(&f.d_f.scaled(&f.u));
                offer(chord.norm_sq(), if f.left { ahead } else { -ahead }, f.speed);
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use feature_sampling::bezier::Cubic;
    use feature_sampling::curve::door::DoorOptions;
    use feature_sampling::geometry::Point;
    use feature_sampling::model::CurveModel;

    use super::*;

    fn model() -> CurveModel<f64> {
        let cubic = |p: [(f64, f64); 4]| {
            let [a, b, c, d] = p.map(|(x, y)| Point::new(x, y));
            Cubic::new(a, b, c, d)
        };
        let bent = [
            cubic([(0.0, 0.0), (1.0, 0.5), (2.0, 0.5), (3.0, 0.0)]),
            cubic([(3.0, 0.0), (3.2, 1.0), (3.0, 2.0), (2.0, 3.0)]),
            cubic([(2.0, 3.0), (1.6, 3.4), (0.6, 3.4), (0.2, 2.6)]),
        ];
        let other = [cubic([(1.0, -1.0), (1.2, 0.0), (1.6, 1.0), (1.5, 2.0)])];
        CurveModel::new(&[(false, bent.as_slice()), (false, other.as_slice())], &DoorOptions::default())
            .expect("a curve")
    }

    struct Random(u64);

    impl Random {
        fn unit(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    /// The largest empty disk by plain points: at least so large as the true one, a little too large between the points.
    fn plain_radius(model: &CurveModel<f64>, foot: &Point<f64>, direction: &Vector<f64>, own: (u32, f64)) -> f64 {
        let mut least = f64::INFINITY;
        for (segment, index) in model.curve().segments.iter().zip(0_u32..) {
            for i in 0..=500 {
                let t = f64::from(i) / 500.0;
                let to = segment.point(&t).minus(foot);
                let ahead = to.dot(direction);
                // Beside the foot roundings decide.
                if ahead > 0.0 && !(index == own.0 && (t - own.1).abs() < 0.02) {
                    least = least.min(to.norm_sq() / (2.0 * ahead));
                }
            }
        }
        least
    }

    /// Disks that a plain point lies in are never shown to be empty, upper bounds are never below plain radii, no medial
    /// point is nearer than its cell's capsule says; and all of it says something.
    #[test]
    fn claims_agree_with_plain_points() {
        let model = model();
        let scene = Scene::new(model.curve());
        let mut random = Random(5);
        let mut work = Work::new();
        let (mut shown, mut refused, mut bounded) = (0, 0, 0);
        for round in 0..3000_u32 {
            let segment = round % 4;
            let from = random.unit() * 0.95;
            let width = 0.05 * random.unit() * random.unit();
            let left = random.unit() < 0.5;
            let span = Span::Side { segment, left, from, to: from + width };
            let Some(feet) = Feet::new(&scene, &span) else { continue };
            let capsule = Capsule::new(&scene, &span);
            let p = Point::new(4.0 * random.unit() - 0.5, 5.0 * random.unit() - 1.0);
            let radius = 0.05 * 60.0_f64.powf(random.unit());
            let is_empty = empty(&scene, &span, radius, &mut work);
            let upper = reached(&scene, &feet, (segment + 1) % 4, random.unit());
            let mut plain = f64::INFINITY;
            for i in 0..=4 {
                let u = from + width * f64::from(i) / 4.0;
                let own = scene.curve.segment(segment).expect("a segment");
                let foot = own.point(&u);
                let tangent = own.power.derivative(&u);
                let normal = if left { tangent.left() } else { tangent.left().opposite() };
                let unit = normal.scaled(&(1.0 / normal.norm()));
                let r = plain_radius(&model, &foot, &unit, (segment, u));
                plain = plain.min(r);
                assert!(upper > r * 0.97 || upper >= r - 1e-3, "round {round}: upper bound {upper} of {r}");
                let rho = radius * random.unit();
                let m = foot.plus_scaled(&rho, &unit);
                assert!(m.distance(&p) >= capsule.distance(&p, 0.0, radius) - 1e-9, "round {round}: a medial point");
                assert!(foot.distance(&p) >= capsule.off_feet(&p) - 1e-9, "round {round}: a foot");
                assert!(m.distance(&p) <= capsule.farthest(&p, 0.0, radius) + 1e-9, "round {round}: farthest");
            }
            bounded += u32::from(upper.is_finite());
            if radius > plain * (1.0 + 1e-9) {
                refused += 1;
                assert!(!is_empty, "round {round}: {span:?} has no empty disk of radius {radius}, {plain} at most");
            }
            shown += u32::from(is_empty);
        }
        assert!(shown > 400 && refused > 400 && bounded > 400, "{shown} shown, {refused} refused, {bounded} bounded");
    }
}
