//! The closest point of a cubic against brute force: queries all over the control box, next to the curve, and next to
//! centres of curvature, where the quintic has nearly multiple roots and solvers lose answers.

use crate::common::Random;
use feature_sampling::bezier::nearest::{
    Nearest, critical_points, distance_quintic, nearest, nearest_between, nearest_of,
};
use feature_sampling::bezier::{Cubic, PowerBasis};
use feature_sampling::geometry::Point;
use feature_sampling::scalar::Scalar;

impl Random {
    fn cubic(&mut self) -> Cubic<f64> {
        Cubic::new(self.point(100.0), self.point(100.0), self.point(100.0), self.point(100.0))
    }

    /// A query of class 0 (in the box), 1 (within 1e-3 of the curve's size of it), 2 (the same of a centre of curvature).
    fn query(&mut self, cubic: &Cubic<f64>, class: u32) -> Point<f64> {
        let b = cubic.power_basis();
        let t = self.unit();
        let jitter =
            |r: &mut Self, p: Point<f64>| Point::new(p.x + (r.unit() - 0.5) * 0.2, p.y + (r.unit() - 0.5) * 0.2);
        match class {
            0 => self.point(100.0),
            1 => jitter(self, b.eval(&t)),
            _ => {
                let (d, dd) = (b.derivative(&t), b.second_derivative(&t));
                let centre = b.eval(&t).plus_scaled(&(d.norm_sq() / d.cross(&dd)), &d.left());
                if centre.is_finite() && centre.x.abs() < 1e4 && centre.y.abs() < 1e4 {
                    jitter(self, centre)
                } else {
                    self.point(100.0)
                }
            }
        }
    }
}

/// The closest point by a fine grid, each local minimum polished by golden section.
fn brute(b: &PowerBasis<f64>, q: &Point<f64>, t0: f64, t1: f64) -> f64 {
    let f = |t: f64| b.eval(&t).distance_sq(q);
    let n = 400_u32;
    let at = |i: u32| t0 + (t1 - t0) * f64::from(i) / f64::from(n);
    let values: Vec<f64> = (0..=n).map(|i| f(at(i))).collect();
    let mut best = values[0].min(values[n as usize]);
    for i in 0..=n {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(n));
        if values[i as usize] > values[before as usize] || values[i as usize] > values[after as usize] {
            continue;
        }
        let (mut lo, mut hi) = (at(before), at(after));
        for _ in 0..80 {
            let (a, c) = (hi - (hi - lo) * 0.618_033_988_749_895, lo + (hi - lo) * 0.618_033_988_749_895);
            if f(a) < f(c) { hi = c } else { lo = a }
        }
        best = best.min(f((lo + hi) / 2.0)).min(values[i as usize]);
    }
    best
}

fn down(b: &Cubic<f64>) -> Cubic<f32> {
    Cubic { points: b.points.map(|p| Point::from_f64(p.x, p.y)) }
}

fn up(b: &Cubic<f32>) -> Cubic<f64> {
    Cubic { points: b.points.map(|p| Point::new(p.x.to_f64(), p.y.to_f64())) }
}

#[test]
fn agrees_with_brute_force() {
    let mut random = Random(1);
    for i in 0..6000 {
        let cubic = random.cubic();
        let q = random.query(&cubic, i % 3);
        let b = cubic.power_basis();
        let found = nearest(&b, &q);
        let truth = brute(&b, &q, 0.0, 1.0);
        // the distance itself cannot be known better than the coordinates, about 1e-14 here
        let (d, best) = (found.distance_sq.sqrt(), truth.sqrt());
        assert!(d <= best * (1.0 + 1e-12) + 1e-13, "case {i}: {d} against {best}, {cubic:?}, {q:?}");
        assert_eq!(found.point, b.eval(&found.t), "the point belongs to the parameter");
        assert!((0.0..=1.0).contains(&found.t));
    }
}

#[test]
fn single_precision_agrees_with_brute_force() {
    let mut random = Random(2);
    for i in 0..6000 {
        let cubic = random.cubic();
        let q = random.query(&cubic, i % 3);
        let (cubic, q) = (down(&cubic), Point::<f32>::from_f64(q.x, q.y));
        let found = nearest(&cubic.power_basis(), &q);
        let q64 = Point::new(q.x.to_f64(), q.y.to_f64());
        let b = up(&cubic).power_basis();
        let truth = brute(&b, &q64, 0.0, 1.0).sqrt();
        let d = b.eval(&found.t.to_f64()).distance(&q64);
        assert!(d <= truth * (1.0 + 1e-5) + 1e-4, "case {i}: {d} against {truth}, {cubic:?}, {q:?}");
    }
}

#[test]
fn intervals_and_batches() {
    let mut random = Random(3);
    for i in 0..1500 {
        let cubics: Vec<Cubic<f64>> = (0..12).map(|_| random.cubic()).collect();
        let q = random.query(&cubics[0], i % 3);
        let b = cubics[0].power_basis();
        let (t0, t1) = (random.unit() * 0.5, 0.5 + random.unit() * 0.5);
        let found = nearest_between(&b, &q, &t0, &t1);
        assert!(found.t >= t0 && found.t <= t1);
        let truth = brute(&b, &q, t0, t1).sqrt();
        assert!(found.distance_sq.sqrt() <= truth * (1.0 + 1e-12) + 1e-13, "case {i}");
        let singly = cubics.iter().map(|c| nearest(&c.power_basis(), &q).distance_sq).fold(f64::INFINITY, f64::min);
        let (index, best) = nearest_of(&cubics, &q, f64::INFINITY).expect("twelve cubics");
        assert_eq!(best.distance_sq, singly, "the batch finds the same");
        assert_eq!(nearest(&cubics[index].power_basis(), &q), best);
        assert_eq!(nearest_of(&cubics, &q, singly), None, "nothing closer than the closest");
    }
    let b = random.cubic().power_basis();
    let at = nearest_between(&b, &random.point(100.0), &0.5, &0.5);
    assert_eq!((at.t, at.point), (0.5, b.eval(&0.5)), "an empty interval");
}

#[test]
fn critical_points_include_the_closest() {
    let mut random = Random(4);
    for i in 0..3000 {
        let cubic = random.cubic();
        let q = random.query(&cubic, i % 3);
        let b = cubic.power_basis();
        let found = nearest(&b, &q);
        let critical = critical_points(&b, &q);
        assert!(critical.windows(2).all(|w| w[0] <= w[1]), "ascending");
        let best = critical.iter().chain(&[0.0, 1.0]).map(|t| b.eval(t).distance(&q)).fold(f64::INFINITY, f64::min);
        assert!((best - found.distance_sq.sqrt()).abs() <= best * 1e-12 + 1e-13, "case {i}: {best} {found:?}");
        let quintic = distance_quintic(&b, &q);
        for t in &critical {
            let noise = quintic.magnitude(t) * 1e-13;
            assert!(quintic.eval(t).abs() <= noise, "case {i}: stationary at {t}");
        }
    }
}

#[test]
fn degenerate_cubics() {
    let p = |x: f64, y: f64| Point::new(x, y);
    let close = |found: &Nearest<f64>, t: f64, d: f64| {
        assert!((found.t - t).abs() < 1e-9 && (found.distance_sq.sqrt() - d).abs() < 1e-12, "{found:?}: {t}, {d}");
    };
    let line = Cubic::line(p(0.0, 0.0), p(3.0, 0.0)).power_basis();
    close(&nearest(&line, &p(1.5, 2.0)), 0.5, 2.0);
    close(&nearest(&line, &p(-3.0, 4.0)), 0.0, 5.0);
    close(&nearest(&line, &p(3.0, 0.0)), 1.0, 0.0);
    let dot = Cubic::line(p(2.0, 2.0), p(2.0, 2.0)).power_basis();
    close(&nearest(&dot, &p(5.0, 6.0)), 0.0, 5.0);
    assert!(critical_points(&dot, &p(5.0, 6.0)).is_empty(), "everything is stationary");
    // retracted handles: B' = 0 at both ends
    let retracted = Cubic::new(p(0.0, 0.0), p(0.0, 0.0), p(4.0, 0.0), p(4.0, 0.0)).power_basis();
    close(&nearest(&retracted, &p(2.0, 1.0)), 0.5, 1.0);
    close(&nearest(&retracted, &p(-1.0, 0.0)), 0.0, 1.0);
    close(&nearest(&retracted, &p(4.0, 3.0)), 1.0, 3.0);
    // a line run back and forth
    let folded = Cubic::new(p(0.0, 0.0), p(4.0, 0.0), p(-3.0, 0.0), p(1.0, 0.0)).power_basis();
    let found = nearest(&folded, &p(0.5, 1.0));
    assert!((found.distance_sq - 1.0).abs() < 1e-12, "{found:?}");
    // the cusp itself and its centre
    let cusp = Cubic::new(p(0.0, 0.0), p(1.0, 1.0), p(0.0, 1.0), p(1.0, 0.0)).power_basis();
    let tip = cusp.eval(&0.5);
    assert!(nearest(&cusp, &tip).distance_sq <= 1e-28);
    // a query on the curve
    let mut random = Random(5);
    for _ in 0..500 {
        let b = random.cubic().power_basis();
        let t = random.unit();
        assert!(nearest(&b, &b.eval(&t)).distance_sq <= 1e-24, "on the curve");
    }
}
