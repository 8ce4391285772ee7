//! Exact predicates against exact integer arithmetic on a million near-degenerate cases per scalar and predicate.
//!
//! Coordinates are integers times a power of two, so that the determinants can be computed without error: in 128 bits for
//! orient2d, in multi-precision integers for incircle. The cases are collinear or cocircular configurations with the
//! last bits of the coordinates changed; the plain backend must fail on some of them, or the cases prove nothing.

use feature_sampling::geometry::Point;
use feature_sampling::predicate::{Exact, Plain, Predicates, Sign};
use num_bigint::BigInt;

const CASES: usize = 1_000_000;

struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in −2^bits … 2^bits.
    fn int(&mut self, bits: u32) -> i64 {
        let wide = i64::try_from(self.next() >> (63 - bits)).expect("at most 63 bits");
        wide - (1_i64 << bits)
    }

    /// −2 … 2, mostly 0.
    fn nudge(&mut self) -> i64 {
        match self.next() % 8 {
            0 => -2,
            1 => -1,
            2 => 1,
            3 => 2,
            _ => 0,
        }
    }
}

type Int = (i64, i64);

fn orient_exact(a: Int, b: Int, c: Int) -> Sign {
    let wide = |p: Int, q: Int| (i128::from(p.0) - i128::from(q.0), i128::from(p.1) - i128::from(q.1));
    let ((bx, by), (cx, cy)) = (wide(b, a), wide(c, a));
    Sign::of(&(bx * cy - by * cx))
}

fn incircle_exact(a: Int, b: Int, c: Int, d: Int) -> Sign {
    let row = |p: Int| {
        let (x, y) = (i128::from(p.0) - i128::from(d.0), i128::from(p.1) - i128::from(d.1));
        (x, y, x * x + y * y)
    };
    let (a, b, c) = (row(a), row(b), row(c));
    let minor = |p: (i128, i128, i128), q: (i128, i128, i128)| p.0 * q.1 - p.1 * q.0;
    let term = |lift: i128, minor: i128| BigInt::from(lift) * BigInt::from(minor);
    let sum = term(a.2, minor(b, c)) + term(b.2, minor(c, a)) + term(c.2, minor(a, b));
    Sign::of(&sum)
}

/// Three points on a line, the last bits of some moved; |coordinates| < 2^bits.
fn collinear(r: &mut Random, bits: u32) -> [Int; 3] {
    let (a, d) = ((r.int(bits - 2), r.int(bits - 2)), (r.int(bits / 2 - 2), r.int(bits / 2 - 2)));
    let mut at = |k: i64| (a.0 + d.0 * k + r.nudge(), a.1 + d.1 * k + r.nudge());
    let reach = 1_i64 << (bits / 2 - 1);
    [at(0), at(reach / 3), at(reach - 7)]
}

/// Four points on a circle (the corners of a rectangle), the last bits of some moved; |coordinates| < 2^bits.
fn cocircular(r: &mut Random, bits: u32) -> [Int; 4] {
    let (a, u) = ((r.int(bits - 2), r.int(bits - 2)), (r.int(bits - 6), r.int(bits - 6)));
    let (k, v) = (1 + r.int(1).abs(), (-u.1, u.0));
    let corners =
        [a, (a.0 + u.0, a.1 + u.1), (a.0 + u.0 + k * v.0, a.1 + u.1 + k * v.1), (a.0 + k * v.0, a.1 + k * v.1)];
    corners.map(|p| (p.0 + r.nudge(), p.1 + r.nudge()))
}

/// The point with these integers in units of 2^−20, exact if they fit the significand.
fn double(p: Int) -> Point<f64> {
    #[allow(clippy::cast_precision_loss, reason = "fewer bits than the significand")]
    Point::new(p.0 as f64 / 1_048_576.0, p.1 as f64 / 1_048_576.0)
}

fn single(p: Int) -> Point<f32> {
    #[allow(clippy::cast_precision_loss, reason = "fewer bits than the significand")]
    Point::new(p.0 as f32 / 1024.0, p.1 as f32 / 1024.0)
}

/// Runs all cases; returns how often the plain backend was wrong.
fn run<S>(bits: u32, seed: u64, point: impl Fn(Int) -> Point<S>) -> (usize, usize)
where
    Exact: Predicates<S>,
    Plain: Predicates<S>,
{
    let mut random = Random(seed);
    let mut wrong = (0, 0);
    let mut zeros = (0, 0);
    for case in 0..CASES {
        let [a, b, c] = collinear(&mut random, bits);
        let truth = orient_exact(a, b, c);
        let p = [point(a), point(b), point(c)];
        assert_eq!(
            <Exact as Predicates<S>>::orient2d(&p[0], &p[1], &p[2]),
            truth,
            "orient2d {case}: {a:?} {b:?} {c:?}"
        );
        wrong.0 += usize::from(<Plain as Predicates<S>>::orient2d(&p[0], &p[1], &p[2]) != truth);
        zeros.0 += usize::from(truth == Sign::Zero);

        let [a, b, c, d] = cocircular(&mut random, bits);
        let truth = incircle_exact(a, b, c, d);
        let p = [point(a), point(b), point(c), point(d)];
        assert_eq!(
            <Exact as Predicates<S>>::incircle(&p[0], &p[1], &p[2], &p[3]),
            truth,
            "incircle {case}: {a:?} {b:?} {c:?} {d:?}"
        );
        wrong.1 += usize::from(<Plain as Predicates<S>>::incircle(&p[0], &p[1], &p[2], &p[3]) != truth);
        zeros.1 += usize::from(truth == Sign::Zero);
    }
    assert!(zeros.0 > 1000 && zeros.1 > 1000, "degenerate cases among them: {zeros:?}");
    wrong
}

#[test]
fn doubles_agree_with_integers() {
    let wrong = run(52, 1, double);
    println!("plain f64 fails {} of orient2d and {} of incircle, of {CASES}", wrong.0, wrong.1);
    assert!(wrong.0 > 100 && wrong.1 > 100, "the cases are hard: {wrong:?}");
}

#[test]
fn singles_agree_with_integers() {
    let wrong = run(23, 2, single);
    println!("plain f32 fails {} of orient2d and {} of incircle, of {CASES}", wrong.0, wrong.1);
    assert!(wrong.0 > 100 && wrong.1 > 100, "the cases are hard: {wrong:?}");
}

#[test]
fn a_case_plain_gets_wrong() {
    // Kettner et al. 2008, doi:10.1016/j.comgeo.2007.06.003: near the line through b and c, determinant −12·2^−53
    let (a, b) = (Point::new(0.5 + 2.0_f64.powi(-53), 0.5), Point::new(12.0, 12.0));
    let c = Point::new(24.0, 24.0);
    assert_eq!(Exact::orient2d(&a, &b, &c), Sign::Negative);
    assert_eq!(Plain::orient2d(&a, &b, &c), Sign::Zero);
}
