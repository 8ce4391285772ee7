//! The closest point of a cubic, twice: by brute force in doubles, and exactly.
//!
//! Brute force is quick and good to about nine digits of the parameter, which is enough for sixteen of the distance (it is
//! stationary there). Where it finds less than the kernel did, or the kernel less than it, [`Exact distances`](Closest)
//! decide: the squared distance at a double parameter is a number with finitely many bits, and the true minimum is at an
//! end or at a root of the quintic, which [`Sturm`] isolates to as many bits as asked.

use crate::dyadic::Dyadic;
use crate::exact::Exact;
use crate::sturm::{Sturm, beyond_all_roots};
use feature_sampling::bezier::PowerBasis;
use feature_sampling::geometry::Point;

/// Points of the grid that brute force looks at.
const GRID: u32 = 256;

/// The squared distance from q to the curve on [0, 1], and a parameter where it is taken; brute force.
pub fn brute(b: &PowerBasis<f64>, q: &Point<f64>) -> (f64, f64) {
    let [a1, a2, a3] = &b.a;
    let distance_sq = |t: f64| b.eval(&t).distance_sq(q);
    let slope = |t: f64| {
        let (x, y) = (a1.x + t * (2.0 * a2.x + t * 3.0 * a3.x), a1.y + t * (2.0 * a2.y + t * 3.0 * a3.y));
        let p = b.eval(&t);
        (p.x - q.x) * x + (p.y - q.y) * y
    };
    let at = |i: u32| f64::from(i) / f64::from(GRID);
    let mut best = (f64::INFINITY, 0.0);
    let mut keep = |t: f64| {
        let f = distance_sq(t);
        if f < best.0 {
            best = (f, t);
        }
    };
    let mut before = distance_sq(0.0);
    let mut here = before;
    for i in 0..=GRID {
        let after = if i < GRID { distance_sq(at(i + 1)) } else { f64::INFINITY };
        if here <= before && here <= after {
            // a minimum of the grid: bisect the slope on either side
            let (mut lo, mut hi) = (at(i.saturating_sub(1)), at((i + 1).min(GRID)));
            for _ in 0..54 {
                let mid = f64::midpoint(lo, hi);
                if slope(mid) < 0.0 { lo = mid } else { hi = mid }
            }
            for t in [at(i), lo, hi] {
                keep(t);
            }
        }
        before = here;
        here = after;
    }
    best
}

/// A cubic by powers of t and a query, exactly.
#[derive(Clone, Debug)]
pub struct Closest {
    /// B(t) − q, coordinates x and y.
    away: [Exact; 2],
    sturm: Option<Sturm>,
}

impl Closest {
    /// `None` if a number is not finite.
    pub fn new(b: &PowerBasis<f64>, q: &Point<f64>) -> Option<Self> {
        let [a1, a2, a3] = &b.a;
        let coordinates = [[b.origin.x, q.x, a1.x, a2.x, a3.x], [b.origin.y, q.y, a1.y, a2.y, a3.y]];
        let mut powers = vec![Dyadic::zero(); 6];
        let mut away = Vec::new();
        for coordinate in coordinates {
            let exact: Option<Vec<Dyadic>> = coordinate.into_iter().map(Dyadic::from_f64).collect();
            let [origin, query, a1, a2, a3] = <[Dyadic; 5]>::try_from(exact?).ok()?;
            let c = [origin.minus(&query), a1, a2, a3];
            // (B − q)·B'
            for (i, p) in c.iter().enumerate() {
                for (j, d) in c.iter().enumerate().skip(1) {
                    let term = p.times(d).times_int(i32::try_from(j).unwrap_or(0));
                    if let Some(sum) = powers.get_mut(i + j - 1) {
                        *sum = sum.plus(&term);
                    }
                }
            }
            away.push(Exact::from_dyadic(&c));
        }
        let quintic = Exact::from_dyadic(&powers);
        let sturm = quintic.degree().map(|_| Sturm::new(&quintic));
        Some(Self { away: <[Exact; 2]>::try_from(away).ok()?, sturm })
    }

    /// |B(t) − q|², exactly.
    pub fn distance_sq(&self, t: &Dyadic) -> Dyadic {
        let [x, y] = self.away.each_ref().map(|p| p.value(t));
        x.times(&x).plus(&y.times(&y))
    }

    /// The least squared distance on [0, 1]: an upper bound that is too large by about 2^−160 of itself where the closest
    /// point is inside, and exact where it is an end.
    pub fn least(&self) -> Dyadic {
        let (zero, one) = (Dyadic::zero(), Dyadic::power_of_two(0));
        let mut least = self.distance_sq(&zero).min(self.distance_sq(&one));
        if let Some(sturm) = &self.sturm {
            for (lo, _) in sturm.roots(&zero, &one, 90) {
                least = least.min(self.distance_sq(&lo));
            }
        }
        least
    }

    /// How much farther than the closest point the point at t is, relative to the least distance; infinite where that is 0
    /// and this is not.
    pub fn excess(&self, t: f64) -> f64 {
        let (Some(t), least) = (Dyadic::from_f64(t), self.least()) else { return f64::INFINITY };
        let more = self.distance_sq(&t).minus(&least);
        if more.sign() <= 0 {
            return 0.0;
        }
        // √(1 + x) − 1 ≤ x/2
        (more.log2() - least.log2()).exp2() / 2.0
    }

    /// The distance at t minus the least distance, rounded up a little.
    pub fn excess_absolute(&self, t: f64) -> f64 {
        let (Some(t), least) = (Dyadic::from_f64(t), self.least()) else { return f64::INFINITY };
        let here = self.distance_sq(&t);
        let more = here.minus(&least);
        if more.sign() <= 0 {
            return 0.0;
        }
        // (a² − b²)/(a + b)
        let sum = (here.log2() / 2.0).exp2() + (least.log2() / 2.0).exp2();
        (more.log2() - sum.log2()).exp2()
    }

    /// The parameters in [0, 1] where the distance is stationary, to 64 bits; `None` where it is everywhere.
    pub fn critical(&self) -> Option<Vec<f64>> {
        let sturm = self.sturm.as_ref()?;
        let (zero, one) = (Dyadic::zero(), Dyadic::power_of_two(0));
        Some(sturm.roots(&zero, &one, 64).into_iter().map(|(lo, _)| lo.to_f64()).collect())
    }

    /// A power of two beyond all critical parameters, `None` where there are none.
    pub fn reach(&self) -> Option<Dyadic> {
        self.sturm.as_ref()?.square_free().map(beyond_all_roots)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use feature_sampling::bezier::Cubic;

    #[test]
    fn brute_force_and_exact_distances_agree() {
        let mut random = crate::random::Random::new(3);
        for class in crate::queries::Class::ALL {
            for _ in 0..200 {
                let (cubic, q) = crate::queries::query(class, &mut random);
                let b = cubic.power_basis();
                let (_, t) = brute(&b, &q);
                let exact = Closest::new(&b, &q).expect("finite");
                assert!(exact.excess(t) < 1e-12, "{cubic:?} {q:?}: {}", exact.excess(t));
            }
        }
    }

    #[test]
    fn a_wrong_parameter_shows() {
        let line = Cubic::line(Point::new(0.0, 0.0), Point::new(3.0, 0.0)).power_basis();
        let exact = Closest::new(&line, &Point::new(1.5, 4.0)).expect("finite");
        assert_eq!(exact.excess(0.5), 0.0);
        assert!((exact.excess(0.5 + 1.0) - (5.0_f64.powi(2) / 16.0 - 1.0) / 2.0).abs() < 1e-9);
        assert_eq!(exact.least().to_f64(), 16.0);
        assert_eq!(exact.critical(), Some(vec![0.5]));
    }
}
