//! `Directed` and `Interval` of `f32`, `f64` and `Mpfr` against MPFR's directed rounding: no containment failure, and how
//! much wider than need be.
//!
//! A short run by default. The long one, 10⁷ cases for each operation and scalar (a tenth of that for intervals of `Mpfr`),
//! a quarter of an hour:
//! `FSAMPLE_CASES=10000000 cargo test --release -p feature-sampling-mpfr --test interval -- --nocapture`
//!
//! MPFR computes with the precision of the scalar and an exponent without bounds, rounded down; rounded down once more to the
//! scalar, with its subnormals and its overflow, this is the largest number of the scalar that is not above the exact
//! result. A lower end is right if it is not above that.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    clippy::cast_lossless,
    reason = "random bits are cut to the types under test"
)]

use feature_sampling::scalar::{Directed, Field, Interval, Scalar};
use feature_sampling_mpfr::Mpfr;
use feature_sampling_mpfr::truth::input::Gen;
use num_traits::Zero;
use rug::Float;
use rug::float::Round;

/// Cases for each operation and scalar.
fn cases() -> u64 {
    std::env::var("FSAMPLE_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(100_000)
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Operation {
    Add,
    Sub,
    Mul,
    Div,
    Sqrt,
}

const OPERATIONS: [Operation; 5] = [Operation::Add, Operation::Sub, Operation::Mul, Operation::Div, Operation::Sqrt];

/// What the tests need of a scalar.
trait Machine: Directed + Copy + std::fmt::Display {
    /// A number with these 64 random bits in its representation: any exponent, subnormals and infinities included; no NaN.
    fn from_random(bits: u64) -> Self;
    /// The exponent range, of 2, with what lies just beyond it.
    const EXPONENTS: (i32, i32);
    /// With a significand from random bits and an exponent.
    fn scaled(bits: u64, exponent: i32) -> Self;
    fn up(self) -> Self;
    fn down(self) -> Self;
    fn wide(self) -> f64;
    /// The exact number rounded one way.
    fn rounded(value: &Float, round: Round) -> Self;
}

macro_rules! machine {
    ($float:ident, $bits:ident, $to:ident, $low:literal, $high:literal) => {
        impl Machine for $float {
            const EXPONENTS: (i32, i32) = ($low, $high);

            fn from_random(bits: u64) -> Self {
                let value = $float::from_bits((bits >> (64 - $bits::BITS)) as $bits);
                if value.is_nan() { $float::from_bits((bits as $bits) & ($bits::MAX >> 2)) } else { value }
            }

            fn scaled(bits: u64, exponent: i32) -> Self {
                let significand = 1.0 + (bits >> 12) as $float / (1_u64 << 52) as $float;
                // In two steps: a single power may be out of range.
                let half = exponent / 2;
                let value = significand * (2.0 as $float).powi(half) * (2.0 as $float).powi(exponent - half);
                if bits & 1 == 0 { value } else { -value }
            }

            fn up(self) -> Self {
                self.next_up()
            }

            fn down(self) -> Self {
                self.next_down()
            }

            fn wide(self) -> f64 {
                f64::from(self)
            }

            fn rounded(value: &Float, round: Round) -> Self {
                value.$to(round)
            }
        }
    };
}

machine!(f32, u32, to_f32_round, -152, 130);
machine!(f64, u64, to_f64_round, -1078, 1026);

/// A number; the kinds cover what is special.
fn number<S: Machine>(g: &mut Gen) -> S {
    let (low, high) = S::EXPONENTS;
    let exponent = |g: &mut Gen, from: i32, to: i32| from + (g.below((to - from) as u64 + 1) as i32);
    let bits = g.bits();
    match g.below(12) {
        0 => S::from_f64([0.0, -0.0, 1.0, -1.0, 2.0, 0.5, 3.0, 10.0][g.below(8) as usize]),
        // Subnormal, or nearly.
        1 => S::scaled(bits, exponent(g, low, low + 30)),
        // Near overflow.
        2 => S::scaled(bits, exponent(g, high - 20, high)),
        // Squares and products near the ends of the range.
        3 => S::scaled(bits, exponent(g, low / 2 - 30, low / 2 + 30)),
        4 => S::scaled(bits, exponent(g, high / 2 - 20, high / 2 + 5)),
        5 => S::from_f64(f64::INFINITY * if bits & 1 == 0 { 1.0 } else { -1.0 }),
        // Few bits: exact results and ties.
        6 => S::scaled(bits & 0xfff0_0000_0000_0001, exponent(g, -20, 20)),
        7 | 8 => S::scaled(bits, exponent(g, -30, 30)),
        _ => S::from_random(bits),
    }
}

/// Two operands; at times close to each other, or to each other's negative, or with a product or quotient at an end of the
/// range.
fn operands<S: Machine>(g: &mut Gen) -> (S, S) {
    let a: S = number(g);
    let b = match g.below(8) {
        0 => {
            let mut b = a;
            for _ in 0..g.below(4) {
                b = if g.below(2) == 0 { b.up() } else { b.down() };
            }
            if g.below(2) == 0 { b } else { -b }
        }
        1 if a.is_finite() && !a.is_zero() => {
            let (low, high) = S::EXPONENTS;
            let own = a.wide().abs().log2().floor() as i32;
            let target = if g.below(2) == 0 { low + g.below(80) as i32 } else { high - g.below(8) as i32 };
            S::scaled(g.bits(), if g.below(2) == 0 { target - own } else { own - target })
        }
        _ => number(g),
    };
    (a, b)
}

/// The exact result rounded down and up to the scalar; `None` where there is none among the reals.
fn exact<S: Machine>(operation: Operation, a: S, b: S) -> Option<(S, S)> {
    if !(a.is_finite() && b.is_finite()) {
        return None;
    }
    // f64 holds both scalars; the precision is that of the scalar, so that rounding twice the same way is rounding once.
    let (x, y) = (Float::with_val(53, a.wide()), Float::with_val(53, b.wide()));
    let compute = |round| {
        let value = match operation {
            Operation::Add => Float::with_val_round(S::BITS, &x + &y, round),
            Operation::Sub => Float::with_val_round(S::BITS, &x - &y, round),
            Operation::Mul => Float::with_val_round(S::BITS, &x * &y, round),
            Operation::Div if b.is_zero() => return None,
            Operation::Div => Float::with_val_round(S::BITS, &x / &y, round),
            Operation::Sqrt if a < S::zero() => return None,
            Operation::Sqrt => Float::with_val_round(S::BITS, x.sqrt_ref(), round),
        };
        Some(S::rounded(&value.0, round))
    };
    Some((compute(Round::Down)?, compute(Round::Up)?))
}

fn ends<S: Machine>(operation: Operation, a: S, b: S) -> (S, S) {
    match operation {
        Operation::Add => (a.add_down(&b), a.add_up(&b)),
        Operation::Sub => (a.sub_down(&b), a.sub_up(&b)),
        Operation::Mul => (a.mul_down(&b), a.mul_up(&b)),
        Operation::Div => (a.div_down(&b), a.div_up(&b)),
        Operation::Sqrt => (a.sqrt_down(), a.sqrt_up()),
    }
}

fn apply<S: Machine>(operation: Operation, a: Interval<S>, b: &Interval<S>) -> Interval<S> {
    match operation {
        Operation::Add => a + b,
        Operation::Sub => a - b,
        Operation::Mul => a * b,
        Operation::Div => a / b,
        Operation::Sqrt => a.sqrt(),
    }
}

/// Single numbers: containment, and how often an end is farther out than the best one.
fn numbers<S: Machine>(name: &str) {
    for operation in OPERATIONS {
        let mut g = Gen::new(0x000d_15c0);
        let (mut tried, mut failures, mut wider, mut beyond) = (0_u64, Vec::new(), 0_u64, 0_u64);
        for _ in 0..cases() {
            let (a, b) = operands::<S>(&mut g);
            let (lo, hi) = ends(operation, a, b);
            assert!(
                lo <= hi,
                "{name} {operation:?} {a:e} {b:e}: [{lo:e}, {hi:e}]",
                a = a.wide(),
                b = b.wide(),
                lo = lo.wide(),
                hi = hi.wide()
            );
            let Some((down, up)) = exact(operation, a, b) else { continue };
            tried += 1;
            if !(lo <= down && hi >= up) && failures.len() < 10 {
                let text = format!(
                    "{:e} {:e}: [{:e}, {:e}] against [{:e}, {:e}]",
                    a.wide(),
                    b.wide(),
                    lo.wide(),
                    hi.wide(),
                    down.wide(),
                    up.wide()
                );
                failures.push(text);
            }
            wider += u64::from(lo != down) + u64::from(hi != up);
            beyond += u64::from(lo < down.down()) + u64::from(hi > up.up());
        }
        println!(
            "{name} {operation:?}: {tried} cases, {} failures, {wider} ends wider than the best, {beyond} by more than a step",
            failures.len()
        );
        assert!(failures.is_empty(), "{name} {operation:?}: {failures:#?}");
        assert_eq!(beyond, 0, "{name} {operation:?}: never more than a step");
        assert!(tried * 3 >= cases(), "{name} {operation:?}: most cases count: {tried}");
    }
}

/// Intervals: results for members are members of the result, and its ends are those of the best enclosure or one step wider.
fn intervals<S: Machine>(name: &str) {
    for operation in OPERATIONS {
        let mut g = Gen::new(0x001e_7ea1);
        let (mut compared, mut wider) = (0_u64, 0_u64);
        for _ in 0..cases() {
            let ((a, c), (b, d)) = (operands::<S>(&mut g), operands::<S>(&mut g));
            let (x, y) = (Interval::between(a, c), Interval::between(b, d));
            let z = apply(operation, x, &y);
            assert!(z.lo() <= z.hi(), "{name} {operation:?} {x:?} {y:?}: {z:?}");
            // The best ends are taken on at the corners, unless a divisor may be 0 or a root does not exist.
            let (mut best, mut whole) = ((S::infinity(), -S::infinity()), true);
            for (p, q) in [(a, b), (a, d), (c, b), (c, d), (x.middle(), y.middle())] {
                // The middle of an interval without finite members is none of them.
                if !(x.contains(&p) && y.contains(&q)) {
                    continue;
                }
                let Some((down, up)) = exact(operation, p, q) else {
                    whole = false;
                    continue;
                };
                assert!(
                    *z.lo() <= down && *z.hi() >= up,
                    "{name} {operation:?} {x:?} {y:?}: {p} {q} gives [{down}, {up}], not in {z:?}"
                );
                best = (if down < best.0 { down } else { best.0 }, if up > best.1 { up } else { best.1 });
            }
            if whole && !(operation == Operation::Div && y.contains(&S::zero())) {
                compared += 1;
                wider += u64::from(*z.lo() < best.0) + u64::from(*z.hi() > best.1);
                assert!(
                    *z.lo() >= best.0.down() && *z.hi() <= best.1.up(),
                    "{name} {operation:?} {x:?} {y:?}: {z:?} is more than a step wider than {best:?}"
                );
            }
        }
        println!(
            "Interval<{name}> {operation:?}: {} cases, 0 failures; of {compared} with a known best enclosure {wider} ends are a step wider",
            cases()
        );
        assert!(compared * 8 >= cases(), "{name} {operation:?}: enough cases count: {compared}");
    }
}

/// A number of any precision: of moderate size, zeros of both signs, infinities, few bits, far away.
fn long_number<const BITS: u32>(g: &mut Gen) -> Mpfr<BITS> {
    let significand = |g: &mut Gen| {
        let mut v = Float::with_val(BITS, 1);
        for _ in 0..BITS.div_ceil(64) {
            v = (v << 64) + g.bits();
        }
        v
    };
    let value: Float = match g.below(10) {
        0 => Float::with_val(BITS, [0.0, -0.0, 1.0, -1.0, 0.5, 3.0, -7.0, 10.0][g.below(8) as usize]),
        1 => Float::with_val(BITS, if g.below(2) == 0 { f64::INFINITY } else { f64::NEG_INFINITY }),
        2 => Float::with_val(BITS, g.between(-4.0, 4.0)),
        3 => significand(g) >> (BITS as i32 + g.below(2000) as i32),
        4 => significand(g) << (g.below(2000) as i32),
        _ => significand(g) >> (BITS as i32 + g.below(40) as i32),
    };
    Mpfr::from_float(&if g.below(2) == 0 { -value } else { value })
}

/// Intervals of MPFR numbers: their ends are those of the best enclosure, to the bit.
///
/// The judge computes each corner in eight times the digits first: sums, differences and products are exact then, unless
/// their terms are far apart.
fn long_intervals<const BITS: u32>() {
    let judge = 8 * BITS;
    for operation in OPERATIONS {
        let mut g = Gen::new(0x010a_61e5);
        let (count, mut compared) = (cases() / 10, 0_u64);
        for _ in 0..count {
            let [a, b, c, d] = [(); 4].map(|()| long_number::<BITS>(&mut g));
            let (x, y) = (Interval::between(a, c), Interval::between(b, d));
            let z = match operation {
                Operation::Add => x.clone() + &y,
                Operation::Sub => x.clone() - &y,
                Operation::Mul => x.clone() * &y,
                Operation::Div => x.clone() / &y,
                Operation::Sqrt => x.clone().sqrt(),
            };
            assert!(z.lo() <= z.hi(), "{operation:?} {x:?} {y:?}: {z:?}");
            let (mut best, mut whole) = ((Mpfr::infinity(), -Mpfr::<BITS>::infinity()), true);
            for (p, q) in [(x.lo(), y.lo()), (x.lo(), y.hi()), (x.hi(), y.lo()), (x.hi(), y.hi())] {
                let (p, q) = (p.as_float(), q.as_float());
                let none = match operation {
                    Operation::Div => q.is_zero(),
                    Operation::Sqrt => *p < 0,
                    _ => false,
                };
                if !(p.is_finite() && q.is_finite()) || none {
                    whole = false;
                    continue;
                }
                let value = |round| match operation {
                    Operation::Add => Float::with_val_round(judge, p + q, round),
                    Operation::Sub => Float::with_val_round(judge, p - q, round),
                    Operation::Mul => Float::with_val_round(judge, p * q, round),
                    Operation::Div => Float::with_val_round(judge, p / q, round),
                    Operation::Sqrt => Float::with_val_round(judge, p.sqrt_ref(), round),
                };
                let end = |round| Mpfr::from_float(&Float::with_val_round(BITS, value(round).0, round).0);
                let (down, up) = (end(Round::Down), end(Round::Up));
                assert!(*z.lo() <= down && *z.hi() >= up, "{operation:?} {x:?} {y:?}: [{down}, {up}] not in {z:?}");
                best = (if down < best.0 { down } else { best.0 }, if up > best.1 { up } else { best.1 });
            }
            if whole && !(operation == Operation::Div && y.contains(&Mpfr::zero())) {
                compared += 1;
                assert!(*z.lo() == best.0 && *z.hi() == best.1, "{operation:?} {x:?} {y:?}: {z:?}, not {best:?}");
            }
        }
        println!(
            "Interval<Mpfr<{BITS}>> {operation:?}: {count} cases, 0 failures; {compared} compared, none wider than the best"
        );
        assert!(compared * 8 >= count, "{operation:?}: enough cases count: {compared}");
    }
}

#[test]
fn intervals_mpfr() {
    long_intervals::<64>();
    long_intervals::<128>();
    // No multiple of the words that MPFR computes with.
    long_intervals::<113>();
}

#[test]
fn directed_f64() {
    numbers::<f64>("f64");
}

#[test]
fn directed_f32() {
    numbers::<f32>("f32");
}

#[test]
fn intervals_f64() {
    intervals::<f64>("f64");
}

#[test]
fn intervals_f32() {
    intervals::<f32>("f32");
}

/// Powers of two and conversions, at the ends of the range too.
#[test]
fn powers_and_conversions() {
    let mut g = Gen::new(7);
    for _ in 0..cases() / 4 {
        let (a, e) = (number::<f64>(&mut g), g.below(4400) as i32 - 2200);
        if !a.is_finite() {
            continue;
        }
        let value: Float = Float::with_val(53, a) << e;
        let (lo, hi) = (a.mul_pow2_down(e), a.mul_pow2_up(e));
        assert!(
            lo <= value.to_f64_round(Round::Down) && hi >= value.to_f64_round(Round::Up),
            "{a:e} 2^{e}: {lo:e} {hi:e}"
        );
        let (lo, hi) = (f32::from_f64_down(a), f32::from_f64_up(a));
        let value = Float::with_val(53, a);
        assert!(lo <= value.to_f32_round(Round::Down) && hi >= value.to_f32_round(Round::Up), "{a:e}: {lo:e} {hi:e}");
        let (n, half) = (g.bits() as i32, Interval::point(a).half());
        assert!(f64::from(f32::int_down(n)) <= f64::from(n) && f64::from(f32::int_up(n)) >= f64::from(n), "{n}");
        let value: Float = Float::with_val(53, a) >> 1;
        assert!(*half.lo() <= value.to_f64_round(Round::Down) && *half.hi() >= value.to_f64_round(Round::Up), "{a:e}");
    }
}
