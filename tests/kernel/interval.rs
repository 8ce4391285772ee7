//! Directed rounding and intervals, against exact arithmetic on whole numbers: every double is an integer times 2^−1074.

#![allow(clippy::op_ref, reason = "a borrowed right operand is the form that is tested")]

use feature_sampling::scalar::{Directed, Field, Interval, Sign3};
use num_bigint::BigInt;
use num_traits::{One, Zero};

/// The double times 2^1074.
fn exact(v: f64) -> BigInt {
    let bits = v.to_bits();
    let (exponent, fraction) = ((bits >> 52) & 0x7ff, bits & ((1 << 52) - 1));
    let m = if exponent == 0 { fraction } else { fraction | (1 << 52) };
    let n = BigInt::from(m) << (exponent.max(1) - 1);
    if v < 0.0 { -n } else { n }
}

/// Numbers of every kind: random bits, near one another, at the ends of the range, special ones.
fn numbers() -> impl Iterator<Item = f64> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    core::iter::from_fn(move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        let r = state.wrapping_mul(0x2545_f491_4f6c_dd1d);
        let special = [
            0.0,
            -0.0,
            5e-324,
            -5e-324,
            f64::MIN_POSITIVE,
            f64::MAX,
            f64::MIN,
            1.0,
            -1.0,
            1.0_f64.next_up(),
            2.0_f64.powi(-960),
            2.0_f64.powi(990),
            3.0,
            0.1,
        ];
        let v = match r % 8 {
            0 => special[(r >> 8) as usize % special.len()],
            1 => f64::from_bits(r & 0x800f_ffff_ffff_ffff),
            2 => f64::from_bits((r & 0x801f_ffff_ffff_ffff) | 0x7fc0_0000_0000_0000),
            3 | 4 => f64::from_bits((r & 0x801f_ffff_ffff_ffff) | 0x3fe0_0000_0000_0000),
            5 => ((r >> 40) as f64) / 1024.0,
            _ => f64::from_bits(r),
        };
        Some(if v.is_finite() { v } else { 0.5 })
    })
}

/// lo ≤ x ≤ hi for an exact x, and hi − lo at most two steps where both are finite.
fn check(lo: f64, hi: f64, below: impl Fn(f64) -> bool, above: impl Fn(f64) -> bool, what: &str) {
    assert!(lo == f64::NEG_INFINITY || (lo.is_finite() && below(lo)), "{what}: lower end {lo:e}");
    assert!(hi == f64::INFINITY || (hi.is_finite() && above(hi)), "{what}: upper end {hi:e}");
    assert!(hi <= lo.next_up().next_up(), "{what}: [{lo:e}, {hi:e}] is too wide");
}

#[test]
fn ends_lie_on_their_side_of_the_exact_result() {
    let mut n = numbers();
    for _ in 0..40_000 {
        let (a, b) = (n.next().unwrap_or(1.0), n.next().unwrap_or(1.0));
        let (ea, eb) = (exact(a), exact(b));
        let sum = ea.clone() + &eb;
        check(a.add_down(&b), a.add_up(&b), |l| exact(l) <= sum, |h| exact(h) >= sum, &format!("{a:e} + {b:e}"));
        let difference = ea.clone() - &eb;
        check(
            a.sub_down(&b),
            a.sub_up(&b),
            |l| exact(l) <= difference,
            |h| exact(h) >= difference,
            &format!("{a:e} - {b:e}"),
        );
        // Products carry 2^2148: a bound is brought to that scale.
        let product = ea.clone() * &eb;
        let scaled = |v: f64| exact(v) << 1074;
        check(
            a.mul_down(&b),
            a.mul_up(&b),
            |l| scaled(l) <= product,
            |h| scaled(h) >= product,
            &format!("{a:e} * {b:e}"),
        );
        if b != 0.0 {
            // v ≤ a/b: v·|b| ≤ ±a at the scale of products.
            let (numerator, divisor) = if b < 0.0 { (-ea.clone(), -eb) } else { (ea.clone(), eb) };
            let numerator = numerator << 1074;
            let times = |v: f64| exact(v) * &divisor;
            check(
                a.div_down(&b),
                a.div_up(&b),
                |l| times(l) <= numerator,
                |h| times(h) >= numerator,
                &format!("{a:e} / {b:e}"),
            );
        }
        let root = a.abs();
        let (radicand, square) = (exact(root) << 1074, |v: f64| exact(v) * exact(v));
        check(
            root.sqrt_down(),
            root.sqrt_up(),
            |l| square(l) <= radicand,
            |h| square(h) >= radicand,
            &format!("sqrt {root:e}"),
        );
    }
}

#[test]
fn ends_of_floats_are_the_tightest() {
    let mut n = numbers();
    #[allow(clippy::cast_possible_truncation, reason = "any float will do")]
    let mut next = || f32::from_bits((n.next().unwrap_or(1.0).to_bits() >> 17) as u32);
    for _ in 0..200_000 {
        let (a, b) = (next(), next());
        if !a.is_finite() || !b.is_finite() {
            continue;
        }
        let product = f64::from(a) * f64::from(b);
        let (lo, hi) = (a.mul_down(&b), a.mul_up(&b));
        assert!(f64::from(lo) <= product && product <= f64::from(hi), "{a:e} * {b:e}");
        assert!(hi <= lo.next_up(), "{a:e} * {b:e}: wider than one step");
        assert_eq!(lo == hi, f64::from(lo) == product, "{a:e} * {b:e}: a point exactly where the product is a float");
        let (lo, hi) = (a.add_down(&b), a.add_up(&b));
        let (sum, e) = feature_sampling::scalar::eft::two_sum(f64::from(a), f64::from(b));
        assert!(f64::from(lo) < sum || (f64::from(lo) == sum && e >= 0.0), "{a:e} + {b:e}");
        assert!(f64::from(hi) > sum || (f64::from(hi) == sum && e <= 0.0), "{a:e} + {b:e}");
        assert!(hi <= lo.next_up(), "{a:e} + {b:e}: wider than one step");
        if b != 0.0 {
            let (lo, hi) = (f64::from(a.div_down(&b)), f64::from(a.div_up(&b)));
            let b = f64::from(b);
            let (l, h) = if b > 0.0 { (lo * b, hi * b) } else { (hi * b, lo * b) };
            assert!((l <= f64::from(a) && f64::from(a) <= h) || !lo.is_finite() || !hi.is_finite(), "{a:e} / {b:e}");
        }
    }
}

#[test]
fn intervals_contain_all_results_of_members() {
    let mut n = numbers();
    let mut near = || n.next().map_or(1.0, |v| v.clamp(-1e100, 1e100));
    for _ in 0..20_000 {
        let x = Interval::between(near(), near());
        let y = Interval::between(near(), near());
        for p in [*x.lo(), x.middle(), *x.hi()] {
            for q in [*y.lo(), y.middle(), *y.hi()] {
                let (i, j) = (Interval::point(p), Interval::point(q));
                assert!((x + &y).encloses(&(i + &j)) && (x - &y).encloses(&(i - &j)), "{x:?} ± {y:?} at {p:e}, {q:e}");
                assert!((x * &y).encloses(&(i * &j)), "{x:?} × {y:?} at {p:e}, {q:e}");
                assert!(q == 0.0 || (x / &y).encloses(&(i / &j)), "{x:?} ÷ {y:?} at {p:e}, {q:e}");
            }
            assert!(x.square().encloses(&Interval::point(p).square()), "{x:?} squared");
            assert!(x.abs().contains(&p.abs()), "|{x:?}|");
            assert!(p < 0.0 || x.sqrt().encloses(&Interval::point(p).sqrt()), "√{x:?}");
        }
    }
}

#[test]
fn unbounded_ends_and_signs() {
    type I = Interval<f64>;
    let up = I::new(1.0, f64::INFINITY);
    assert_eq!(I::one() / &up, I::new(0.0, 1.0), "reciprocals of [1, ∞]");
    assert_eq!(up * &I::zero(), I::zero(), "0 times any finite number");
    assert_eq!(I::one() / &I::new(0.0, 2.0), I::new(0.5, f64::INFINITY), "a divisor that touches zero");
    assert_eq!(I::one() / &I::new(-2.0, 0.0), I::new(f64::NEG_INFINITY, -0.5), "from below");
    assert_eq!(I::one() / &I::new(-1.0, 1.0), I::entire(), "a divisor around zero");
    assert_eq!(up - &up, I::entire(), "∞ − ∞");
    assert_eq!(I::new(f64::NAN, 1.0), I::entire(), "not a number");
    assert_eq!(I::new(-4.0, 4.0).sqrt(), I::new(0.0, 2.0), "the members that have a root");
    assert_eq!(
        (I::new(1.0, 2.0).sign3(), I::new(-2.0, -1.0).sign3()),
        (Sign3::Positive, Sign3::Negative),
        "certain signs"
    );
    assert_eq!(
        (I::zero().sign3(), I::new(-1.0, 1.0).sign3()),
        (Sign3::Zero, Sign3::Unknown),
        "zero, or no certain sign"
    );
    assert!(
        !I::new(1.0, 2.0).certainly_lt(&I::new(2.0, 3.0)) && I::new(1.0, 2.0).possibly_lt(&I::new(2.0, 3.0)),
        "touching"
    );
    assert!(Interval::<f32>::from_f64(0.1).lo() < Interval::<f32>::from_f64(0.1).hi(), "a tenth is no float");
    assert!(Interval::<f32>::int(16_777_217).contains(&16_777_216.0), "an integer beyond 24 bits");
}
