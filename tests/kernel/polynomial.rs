//! Root finding against planted roots, in every class that breaks solvers: multiple and clustered roots, roots at the
//! ends of the interval, degree drops, extreme scales, values that are not numbers.

use feature_sampling::polynomial::{Polynomial, Root, RootKind, RootsError};
use feature_sampling::scalar::{Field, Scalar};

/// leading·∏(x − r), expanded in f64 from exact-ish factors.
fn planted<const N: usize>(leading: f64, roots: &[f64]) -> Polynomial<f64, N> {
    let mut c = [0.0; N];
    c[0] = leading;
    for (n, r) in roots.iter().enumerate() {
        for j in (0..=n + 1).rev() {
            let below = if j > 0 { c[j - 1] } else { 0.0 };
            c[j] = below - r * c[j];
        }
    }
    Polynomial::new(c)
}

/// Every planted root lies in a bracket (widened by `slack`), multiplicities add up, and brackets hold their values.
fn check<const N: usize>(found: &[Root<f64>], truth: &[f64], slack: f64, what: &str) {
    for r in found {
        assert!(r.lower <= r.value && r.value <= r.upper, "{what}: value inside its bracket: {r:?}");
        assert!(
            truth.iter().any(|t| (r.lower - slack..=r.upper + slack).contains(t)),
            "{what}: ghost {r:?}, truth {truth:?}"
        );
    }
    for w in found.windows(2) {
        assert!(w[0].upper <= w[1].lower, "{what}: brackets are disjoint: {found:?}");
    }
    for t in truth {
        assert!(
            found.iter().any(|r| (r.lower - slack..=r.upper + slack).contains(t)),
            "{what}: {t} missed, found {found:?}"
        );
    }
    let count: usize = found.iter().map(|r| usize::from(r.kind.multiplicity())).sum();
    assert_eq!(count, truth.len(), "{what}: multiplicities of {found:?}, truth {truth:?}");
}

#[test]
fn simple_roots_in_unit() {
    let roots = [0.1, 0.35, 0.5, 0.75, 0.9];
    for k in 0..=5 {
        let mut truth = roots[..k].to_vec();
        let inside = truth.clone();
        truth.extend([1.5, -2.0, 3.0, 4.0, -0.5].iter().take(5 - k));
        let p = planted::<6>(3.0, &truth);
        let found = p.roots_in_unit().expect("finite");
        check::<6>(&found, &inside, 1e-13, "planted");
        for (r, t) in found.iter().zip(&inside) {
            assert!((r.value - t).abs() < 1e-13, "{r:?} against {t}");
            assert_eq!(r.kind, RootKind::Simple);
            assert!(r.upper - r.lower < 1e-11, "a tight bracket {r:?}");
        }
    }
}

#[test]
fn multiple_roots() {
    for (m, kind) in [(2, RootKind::Even), (3, RootKind::Odd), (4, RootKind::Cluster(4)), (5, RootKind::Cluster(5))] {
        for at in [1.0 / 3.0, 0.5, 0.25, 0.7, 0.123_456_789, 0.999, 0.001] {
            let mut truth = vec![at; m];
            truth.resize(5, -1.5);
            let found = planted::<6>(1.0, &truth).roots_in_unit().expect("finite");
            let inside = vec![at; m];
            check::<6>(&found, &inside, 0.0, &format!("{m}-fold at {at}"));
            assert_eq!(found.len(), 1, "{m}-fold at {at}: {found:?}");
            assert_eq!(found[0].kind, kind, "{m}-fold at {at}: {found:?}");
            assert!((found[0].value - at).abs() < 1e-12, "{m}-fold at {at}: mean of {found:?}");
            let attainable = (1e-15_f64).powf(1.0 / m as f64);
            assert!(found[0].upper - found[0].lower < 64.0 * attainable, "{m}-fold at {at}: width of {found:?}");
        }
    }
}

#[test]
fn end_points() {
    for truth in [
        vec![0.0],
        vec![1.0],
        vec![0.0, 1.0],
        vec![0.0, 0.5, 1.0],
        vec![0.0, 0.0],
        vec![1.0, 1.0],
        vec![0.0; 5],
        vec![1.0; 3],
    ] {
        let mut all = truth.clone();
        all.resize(5, 2.5);
        let found = planted::<6>(1.0, &all).roots_in_unit().expect("finite");
        check::<6>(&found, &truth, 0.0, "ends");
    }
    let p = planted::<6>(2.0, &[-3.0, -1.0, 0.0, 1.0, 7.0]);
    let found = p.roots_between(&-3.0, &7.0).expect("finite");
    check::<6>(&found, &[-3.0, -1.0, 0.0, 1.0, 7.0], 0.0, "interval ends");
    let found = p.roots_between(&-1.0, &1.0).expect("finite");
    check::<6>(&found, &[-1.0, 0.0, 1.0], 0.0, "interval ends");
    let found = p.roots_between(&-0.5, &0.5).expect("finite");
    check::<6>(&found, &[0.0], 0.0, "inner interval");
}

#[test]
fn degree_drops() {
    let p = Polynomial::new([-1.0, 2.0, 0.0, 0.0, 0.0, 0.0]);
    let found = p.roots_in_unit().expect("finite");
    check::<6>(&found, &[0.5], 0.0, "linear in a quintic's clothes");
    assert_eq!(p.real_roots().expect("finite").len(), 1);
    let p = Polynomial::new([0.1875_f64, -1.0, 1.0, 0.0, 0.0, 1e-20]);
    check::<6>(&p.roots_in_unit().expect("finite"), &[0.25, 0.75], 1e-15, "leading 1e-20");
    let all = p.real_roots().expect("finite");
    assert_eq!(all.len(), 3, "x⁵·1e-20 turns around once far out: {all:?}");
    assert_eq!(Polynomial::new([5.0_f64, 0.0, 0.0]).real_roots().expect("finite").len(), 0);
    assert_eq!(Polynomial::new([5.0_f64]).roots_in_unit().expect("finite").len(), 0);
    assert_eq!(Polynomial::new([0.0_f64, 0.0, 3.0]).real_roots().expect("finite")[0].kind, RootKind::Even);
}

#[test]
fn all_real_roots() {
    for truth in [
        vec![-5.0, -0.5, 0.25, 3.0, 100.0],
        vec![1.0, 2.0, 3.0, 4.0, 5.0],
        vec![-1.0, 1.0, 1e6, -1e6, 0.5],
        vec![-20.0, -1.0, 0.0, 1.0, 17.0],
    ] {
        let mut sorted = truth.clone();
        sorted.sort_by(f64::total_cmp);
        let found = planted::<6>(1.0, &truth).real_roots().expect("finite");
        assert_eq!(found.len(), 5, "{truth:?}: {found:?}");
        for (r, t) in found.iter().zip(&sorted) {
            assert!((r.value - t).abs() <= 1e-9 * t.abs().max(1e-3), "{r:?} against {t}");
        }
    }
    // Wilkinson's, degree 7
    let found = planted::<8>(1.0, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]).real_roots().expect("finite");
    assert_eq!(found.len(), 7, "{found:?}");
    // a double root at the boundary of two searches
    let found = planted::<6>(1.0, &[1.0, 1.0, -1.0, -1.0, 4.0]).real_roots().expect("finite");
    let kinds: Vec<u8> = found.iter().map(|r| r.kind.multiplicity()).collect();
    assert_eq!(kinds, [2, 2, 1], "{found:?}");
}

#[test]
fn extreme_scales() {
    for e in [-1000_i32, -500, -300, -40, 40, 300, 500, 1000] {
        let mut p = planted::<6>(1.0, &[0.2, 0.4, 0.6, 0.8, -1.0]);
        for c in &mut p.coefficients {
            *c = if e.abs() > 500 { c.mul_pow2(e / 2).mul_pow2(e / 2) } else { c.mul_pow2(e) };
        }
        check::<6>(&p.roots_in_unit().expect("finite"), &[0.2, 0.4, 0.6, 0.8], 1e-14, "scaled coefficients");
        assert_eq!(p.real_roots().expect("finite").len(), 5, "2^{e}");
    }
    // roots near 0 keep their relative accuracy
    let p = planted::<6>(1.0, &[1e-9, 2e-9, 3e-9, 0.5, 2.0]);
    let found = p.roots_in_unit().expect("finite");
    assert_eq!(found.len(), 4, "{found:?}");
    for (r, t) in found.iter().zip([1e-9, 2e-9, 3e-9, 0.5]) {
        assert!((r.value - t).abs() <= 1e-12 * t, "{r:?} against {t}");
    }
    for scale in [1e-150, 1e-50, 1e50, 1e150] {
        let p = Polynomial::new([scale * scale * 2.0, -3.0 * scale, 1.0]);
        let found = p.real_roots().expect("finite");
        assert_eq!(found.len(), 2, "{scale}: {found:?}");
        for (r, t) in found.iter().zip([scale, 2.0 * scale]) {
            assert!((r.value - t).abs() <= 1e-14 * t, "{r:?} against {t}");
        }
    }
}

#[test]
fn near_pairs() {
    // resolved where the data can tell, together otherwise
    let found = planted::<6>(1.0, &[0.3, 0.301, -2.0, -2.0, 5.0]).roots_in_unit().expect("finite");
    assert_eq!(found.len(), 2, "{found:?}");
    let found = planted::<6>(1.0, &[0.3, 0.3 + 1e-12, -2.0, -2.0, 5.0]).roots_in_unit().expect("finite");
    check::<6>(&found, &[0.3, 0.3 + 1e-12], 0.0, "a pair 1e-12 apart");
}

#[test]
fn typed_answers() {
    let nan = Polynomial::new([1.0, f64::NAN]);
    assert_eq!(nan.roots_in_unit(), Err(RootsError::NotFinite));
    assert_eq!(nan.real_roots(), Err(RootsError::NotFinite));
    let inf = Polynomial::new([1.0, f64::INFINITY, -f64::INFINITY]);
    assert_eq!(inf.roots_in_unit(), Err(RootsError::NotFinite));
    assert_eq!(Polynomial::new([0.0_f64; 6]).roots_in_unit(), Err(RootsError::ZeroPolynomial));
    let p = Polynomial::new([1.0, -2.0]);
    assert_eq!(p.roots_between(&1.0, &0.0), Err(RootsError::BadInterval));
    assert_eq!(p.roots_between(&0.0, &f64::INFINITY), Err(RootsError::BadInterval));
    let huge = Polynomial::new([f64::MAX, -f64::MAX, -f64::MAX, f64::MAX]);
    check::<4>(&huge.real_roots().expect("finite"), &[-1.0, 1.0, 1.0], 0.0, "sums overflow");
}

#[test]
fn single_precision() {
    let p = Polynomial::new([-0.09375_f32, 0.84375, -2.25, 1.5]); // 1.5 (x − ¼)(x − ¼)(x − 1)
    let found = p.roots_in_unit().expect("finite");
    let total: u8 = found.iter().map(|r| r.kind.multiplicity()).sum();
    assert_eq!(total, 3, "{found:?}");
    assert!((found[0].value - 0.25).abs() < 1e-3 && (found[1].value - 1.0).abs() < 1e-6, "{found:?}");
    for e in [-120, -60, 60, 100] {
        let p = Polynomial::new([-0.25_f32, 1.0, -0.5, 2.0].map(|c| c.mul_pow2(e)));
        assert_eq!(p.roots_in_unit().expect("finite").len(), 1, "2^{e}");
    }
    assert_eq!(<f32 as Scalar>::BITS, 24);
}

/// A product of (64x − k) with integers k has integer coefficients that doubles hold exactly, so the truth is exact.
#[test]
fn exact_products_with_multiplicities() {
    let mut seed = 99_u64;
    let mut random = |n: u64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        i32::try_from((seed >> 33) % n).expect("small")
    };
    let (mut worst, mut ambiguities) = (0.0_f64, 0);
    for case in 0..60_000 {
        let mut numerators = Vec::new();
        while numerators.len() < 5 {
            let k = match random(4) {
                0 => random(65),
                1 => random(3) * 32,
                _ => random(400) - 200,
            };
            for _ in 0..=random(5).min(4 - i32::try_from(numerators.len()).expect("at most 5")) {
                numerators.push(k);
            }
        }
        numerators.sort_unstable();
        let mut c = [0.0; 6];
        c[0] = 1.0;
        for (n, k) in numerators.iter().enumerate() {
            for j in (0..=n + 1).rev() {
                let below = if j > 0 { c[j - 1] } else { 0.0 };
                c[j] = 64.0 * below - f64::from(*k) * c[j];
            }
        }
        let p = Polynomial::new(c);
        let exact = |inside: &dyn Fn(i32) -> bool| -> Vec<f64> {
            numerators.iter().filter(|k| inside(**k)).map(|k| f64::from(*k) / 64.0).collect()
        };
        for (found, truth) in [
            (p.roots_in_unit().expect("finite"), exact(&|k| (0..=64).contains(&k))),
            (p.roots_between(&-1.5, &0.25).expect("finite"), exact(&|k| (-96..=16).contains(&k))),
            (p.real_roots().expect("finite"), exact(&|_| true)),
        ] {
            // a cluster with other roots within twice its width may be counted with or without them
            let ambiguous = found.iter().filter(|r| r.kind != RootKind::Simple).any(|r| {
                let (middle, reach) = (f64::midpoint(r.lower, r.upper), 2.5 * (r.upper - r.lower));
                let all = numerators.iter().map(|k| f64::from(*k) / 64.0);
                let mut close: Vec<f64> = all.filter(|t| (t - middle).abs() <= reach).collect();
                close.dedup();
                close.len() > 1
            });
            ambiguities += usize::from(ambiguous);
            if ambiguous {
                for t in &truth {
                    assert!(
                        found.iter().any(|r| (r.lower - 1e-15..=r.upper + 1e-15).contains(t)),
                        "{t} missed, found {found:?}"
                    );
                }
                continue;
            }
            check::<6>(&found, &truth, 1e-15, &format!("case {case}, {numerators:?}"));
            for r in &found {
                if r.kind == RootKind::Simple {
                    let t = truth.iter().map(|t| (t - r.value).abs()).fold(f64::INFINITY, f64::min);
                    let (_, slope) = p.eval_with_derivative(&r.value);
                    let attainable = p.magnitude(&r.value) / slope.abs() * f64::EPSILON;
                    worst = worst.max(t / attainable);
                }
            }
        }
    }
    assert!(ambiguities < 1000, "{ambiguities} ambiguous answers of 180000");
    assert!(worst < 4.0, "a simple root is off by {worst} times its attainable error");
}

#[test]
fn exact_products_in_single_precision() {
    let mut seed = 5_u64;
    let mut random = |n: u64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        i16::try_from((seed >> 33) % n).expect("small")
    };
    for case in 0..20_000 {
        let mut k = [0_i16; 3].map(|_| random(33) - 12);
        k.sort_unstable();
        if k.windows(2).any(|w| w[1] - w[0] < 3) {
            continue;
        }
        let mut c = [1.0_f32, 0.0, 0.0, 0.0];
        for (n, k) in k.iter().enumerate() {
            for j in (0..=n + 1).rev() {
                let below = if j > 0 { c[j - 1] } else { 0.0 };
                c[j] = 8.0 * below - f32::from(*k) * c[j];
            }
        }
        let p = Polynomial::new(c);
        for (found, inside) in
            [(p.roots_in_unit().expect("finite"), 0..=8), (p.real_roots().expect("finite"), -12..=20)]
        {
            let truth: Vec<f32> = k.iter().filter(|k| inside.contains(*k)).map(|k| f32::from(*k) / 8.0).collect();
            assert_eq!(found.len(), truth.len(), "case {case}: {k:?}, {found:?}");
            for (r, t) in found.iter().zip(&truth) {
                assert!((r.value - t).abs() <= 1e-4, "case {case}: {r:?} against {t}");
                assert!(r.lower <= t + 1e-6 && *t <= r.upper + 1e-6, "case {case}: {r:?} holds {t}");
            }
        }
    }
}

proptest::proptest! {
    /// Any bits whatever: typed errors or ordered, finite brackets inside the interval; never a panic, never NaN.
    #[test]
    fn any_coefficients(bits in proptest::array::uniform6(proptest::num::u64::ANY), lo in -1e3..1e3, width in 1e-9..1e3) {
        let p = Polynomial::new(bits.map(f64::from_bits));
        let hi = lo + width;
        let answers = [(p.roots_in_unit(), 0.0, 1.0), (p.roots_between(&lo, &hi), lo, hi), (p.real_roots(), f64::MIN, f64::MAX)];
        for (answer, lo, hi) in answers {
            match answer {
                Ok(found) => {
                    for r in &found {
                        proptest::prop_assert!(lo <= r.lower && r.lower <= r.value && r.value <= r.upper && r.upper <= hi, "{r:?}");
                    }
                    proptest::prop_assert!(found.windows(2).all(|w| w[0].upper <= w[1].lower), "{found:?}");
                }
                Err(e) => proptest::prop_assert_eq!(e, RootsError::NotFinite),
            }
        }
    }

    /// Multiplying by −1 and by a power of two changes no bit; x → −x mirrors the answer.
    #[test]
    fn symmetries(c in proptest::array::uniform6(-1.0..1.0), e in -30..30) {
        let p = Polynomial::new(c);
        let found = p.roots_in_unit().expect("finite");
        let scaled = Polynomial::new(c.map(|x: f64| (-x).mul_pow2(e)));
        proptest::prop_assert_eq!(&scaled.roots_in_unit().expect("finite"), &found);
        let all = p.real_roots().expect("finite");
        let mirrored = p.mirrored().real_roots().expect("finite");
        proptest::prop_assert_eq!(all.len(), mirrored.len());
        for (a, b) in all.iter().zip(mirrored.iter().rev()) {
            proptest::prop_assert_eq!(a.value, -b.value);
        }
        proptest::prop_assert_eq!(all.iter().map(|r| r.kind.multiplicity()).sum::<u8>() % 2, 1, "a quintic has an odd number");
    }
}

/// Two cases of the survey of nasty polynomials (ten thousand of each class): three roots that just can be told apart, with the end of
/// the interval beside the first one; and a triple root of which rounding has left two complex ones and one outside of the stretch
/// that noise hides.
#[test]
fn triple_clusters_at_an_end_and_taken_apart() {
    let p = Polynomial::new([
        0.932_696_606_315_453_7,
        -6.606_294_650_728_676,
        17.419_744_107_073_52,
        -20.708_832_190_732_323,
        10.586_794_337_959_57,
        -1.841_808_825_141_464_6,
    ]);
    let found = p.roots_between(&0.494_778_517_393_056_45, &1.482_030_166_361_556_5).expect("finite");
    let truth = [0.494_778_630_205, 0.494_796_694_166, 0.494_819_938_07];
    assert_eq!(found.len(), 3, "{found:?}");
    check::<6>(&found, &truth, 1e-11, "beside an end");

    let p = Polynomial::new([
        -4.469_700_774_739_357,
        19.978_888_051_590_886,
        -35.111_333_573_203_33,
        30.253_548_104_588_994,
        -12.751_793_639_717_464,
        2.100_767_094_543_430_2,
    ]);
    let found = p.real_roots().expect("finite");
    let near = found.iter().find(|r| (r.value - 0.923_602_53).abs() < 1e-5);
    assert!(near.is_some_and(|r| r.kind == RootKind::Even), "a near miss at 0.92360: {found:?}");
}

/// Two more: a triple cluster whose first root is 1.6e-7 outside of the interval, so that its end is one, and not the next root inside;
/// and one outside beside two that rounding has made complex.
#[test]
fn an_end_beside_the_other_roots_of_a_cluster() {
    let p = Polynomial::new([
        -0.044_011_053_505_487_77,
        0.578_489_460_457_305_6,
        -2.755_819_077_029_912,
        5.606_942_148_031_96,
        -4.341_189_158_429_237,
        1.0,
    ]);
    let lower = 0.253_977_398_108_793_5;
    let found = p.roots_between(&lower, &0.415_288_073_912_349_6).expect("finite");
    check::<6>(&found, &[lower, 0.253_983_549_390, 0.253_993_316_090], 1e-11, "the end is a root");

    let p = Polynomial::new([
        -1.645_754_197_687_413_5,
        7.696_976_442_158_281,
        -14.212_013_146_514_611,
        12.914_720_295_363_27,
        -5.753_874_861_233_342,
        1.0,
    ]);
    let lower = 0.921_559_513_479_444_5;
    let found = p.roots_between(&lower, &2.547_895_046_347_874).expect("finite");
    let kinds: Vec<_> = found.iter().map(|r| r.kind).collect();
    assert_eq!(kinds, [RootKind::Simple, RootKind::Even, RootKind::Simple, RootKind::Simple], "{found:?}");
    assert_eq!(found[0].value, lower);
    assert!((found[1].value - 0.921_669_79).abs() < 1e-6, "the near miss: {found:?}");
}
