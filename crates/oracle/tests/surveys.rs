//! The nasty set and the closest points, a few of each; the examples `nasty` and `closest` of this crate ask for millions.

use fsample_oracle::property::check_roots;
use fsample_oracle::random::Random;
use fsample_oracle::{nasty, queries, survey};

#[test]
fn nothing_nasty_is_missed_or_invented() {
    let mut ends = 0;
    for class in nasty::Class::ALL {
        let s = survey::roots(class, 60, 2024);
        assert!(s.is_clean(), "{class}: {s:?}");
        assert!(s.roots > 200, "{class}: {s:?}");
        ends += s.at_ends;
    }
    assert!(ends > 100, "{ends} roots at ends");
}

#[test]
fn no_closest_point_is_wrong() {
    for class in queries::Class::ALL {
        let s = survey::closest(class, 4000, 2024);
        assert_eq!((s.wrong, s.faults), (0, 0), "{class:?}: {s:?}");
        assert!(s.checked >= 4, "{class:?}: {s:?}");
    }
}

/// The product of two polynomials, rounded.
fn times(p: &[f64], q: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; p.len() + q.len() - 1];
    for (i, a) in p.iter().enumerate() {
        for (j, b) in q.iter().enumerate() {
            product[i + j] += a * b;
        }
    }
    product
}

/// Clusters of three to six roots, most of them complex, about the number where the search changes to reciprocals: cut in two there,
/// one in 500 came out with a wrong parity or with a ghost.
#[test]
fn clusters_at_the_border_to_reciprocals() {
    let mut random = Random::new(7);
    let border = 1397.0 / 1024.0;
    for _ in 0..500 {
        let order = random.integer(3, 6);
        let spread = 10.0_f64.powf(random.between(-6.0, -1.5));
        let centre = border + spread * random.between(-1.0, 1.0);
        let mut near = || spread * random.between(-0.3, 0.3);
        let mut p = vec![1.0];
        for _ in 0..order / 2 {
            let (re, im) = (centre + near(), near());
            p = times(&p, &[re * re + im * im, -2.0 * re, 1.0]);
        }
        if order % 2 == 1 {
            p = times(&p, &[-(centre + near()), 1.0]);
        }
        if random.integer(0, 1) == 0 {
            p = times(&p, &[0.3, 1.0]);
        }
        check_roots(&p, -1.0, 1.0);
    }
}
