//! What must hold for any bytes: one function for each fuzz target.
//!
//! Each panics with everything needed to repeat the case as a named test. The same functions are called by the fuzz
//! targets, by tests on random bytes and by tests on the committed corpus.

use crate::closest::{Closest, brute};
use crate::decode::{self, Bytes};
use crate::judge::{Fault, Interval, Judge};
use crate::proof::refuted;
use crate::solve::{Ask, prove, solve, solve_within};
use feature_sampling::bezier::nearest::{distance_quintic, nearest, nearest_between};
use feature_sampling::bezier::{Cubic, PowerBasis};
use feature_sampling::geometry::{Aabb, Point};
use feature_sampling::polynomial::{Root, RootKind, RootsError};
use lineart::svg;

/// Root finding: typed errors for what has no list of roots; otherwise no fault by exact count in [0, 1], in an interval and
/// on the whole line, certified statements that are true, and answers that follow the polynomial when it is scaled, mirrored, reversed and shifted.
///
/// # Panics
/// If anything of this does not hold.
pub fn roots(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let coefficients = decode::polynomial(&mut bytes);
    let (lo, hi) = decode::interval(&mut bytes);
    check_roots(&coefficients, lo, hi);
}

/// [`roots`] on given numbers; lo < hi.
///
/// # Panics
/// If it does not hold.
pub fn check_roots(coefficients: &[f64], lo: f64, hi: f64) {
    let asks = [Ask::Unit, Ask::Between(lo, hi), Ask::Real];
    let error = if coefficients.iter().any(|c| !c.is_finite()) {
        Some(RootsError::NotFinite)
    } else if coefficients.iter().all(|c| *c == 0.0) {
        Some(RootsError::ZeroPolynomial)
    } else {
        None
    };
    if let Some(error) = error {
        for ask in asks {
            assert_eq!(solve(coefficients, ask), Err(error), "{ask:?} of {coefficients:?}");
        }
        return;
    }
    // Coefficients that differ by more than doubles can hold after scaling have no answer in doubles.
    if !is_within_range(coefficients) {
        for ask in asks {
            let found = solve(coefficients, ask).unwrap_or_else(|e| panic!("{ask:?} of {coefficients:?}: {e}"));
            assert!(found.iter().all(|r| r.lower <= r.value && r.value <= r.upper), "{ask:?} of {coefficients:?}");
        }
        return;
    }
    for ask in asks {
        faultless(coefficients, ask);
    }
    follow(coefficients);
}

/// The largest and the smallest coefficient that is not zero differ by less than 2⁹⁰⁰.
fn is_within_range(coefficients: &[f64]) -> bool {
    let sizes = || coefficients.iter().map(|c| c.abs()).filter(|c| *c > 0.0);
    let (least, largest) = (sizes().fold(f64::INFINITY, f64::min), sizes().fold(0.0, f64::max));
    largest.log2() - least.log2() < 900.0
}

/// In wider brackets the same roots are found: kinds are the same, and a bracket, if it is not the narrowest, has the width that was
/// asked for and holds the root.
fn coarse(coefficients: &[f64], ask: Ask, fine: &[Root<f64>]) {
    for width in [1e-12, 1e-7, 1e-3] {
        let found =
            solve_within(coefficients, ask, width).unwrap_or_else(|e| panic!("{ask:?} of {coefficients:?}: {e}"));
        let say = || format!("{ask:?} of {coefficients:?} within {width}: {found:?} for {fine:?}");
        assert_eq!(found.len(), fine.len(), "{}", say());
        for (wide, narrow) in found.iter().zip(fine) {
            let is_in_order = wide.lower <= wide.value && wide.value <= wide.upper;
            let is_same = wide.kind == narrow.kind && wide.lower <= narrow.upper && narrow.lower <= wide.upper;
            // Ends are rounded, and those beyond 1 are reciprocals.
            let half = (0.5 * width + width * width + 8.0 * f64::EPSILON) * wide.value.abs();
            let is_narrow = (wide.upper - wide.lower) <= (2.0 * half).max(narrow.upper - narrow.lower);
            let is_near = (wide.value - narrow.value).abs() <= half.max(narrow.upper - narrow.lower);
            assert!(is_in_order && is_same && is_narrow && is_near, "{}", say());
        }
        assert!(found.windows(2).all(|w| w[0].upper <= w[1].lower), "{}", say());
    }
}

/// The answer, which has no fault.
fn faultless(coefficients: &[f64], ask: Ask) -> Vec<Root<f64>> {
    let found = solve(coefficients, ask).unwrap_or_else(|e| panic!("{ask:?} of {coefficients:?}: {e}"));
    let judge = Judge::new(coefficients).unwrap_or_else(|| panic!("{coefficients:?} is finite and not zero"));
    let within = match ask {
        Ask::Unit => Interval::between(0.0, 1.0),
        Ask::Between(lo, hi) => Interval::between(lo, hi),
        Ask::Real => Some(judge.everywhere()),
    };
    let within = within.unwrap_or_else(|| panic!("{ask:?} is finite"));
    let faults = judge.faults(&found, &within);
    coarse(coefficients, ask, &found);
    if !faults.is_empty() {
        let words: Vec<String> = faults.iter().map(Fault::to_string).collect();
        let truth = judge.roots(&within);
        panic!("{ask:?} of {coefficients:?}: {}; found {found:?}, truth {truth:?}", words.join("; "));
    }
    let certified = prove(coefficients, ask).unwrap_or_else(|e| panic!("{ask:?} of {coefficients:?}: {e}"));
    if let Some(cause) = refuted(&judge, &certified, &within) {
        panic!("{ask:?} of {coefficients:?}: {cause}; certified {certified:?}, truth {:?}", judge.roots(&within));
    }
    found
}

/// Metamorphic checks: each changed polynomial is judged for itself, and answers that are exact images are compared.
fn follow(coefficients: &[f64]) {
    let plain = solve(coefficients, Ask::Real).unwrap_or_default();
    let is_safe = |factor: f64| {
        let fits = |c: f64| c == 0.0 || (1e-290..1e290).contains(&(c * factor).abs());
        coefficients.iter().all(|c| fits(*c))
    };
    for factor in [-1.0, 2.0_f64.powi(37), 2.0_f64.powi(-300)] {
        if is_safe(1.0) && is_safe(factor) {
            let scaled: Vec<f64> = coefficients.iter().map(|c| c * factor).collect();
            assert_eq!(solve(&scaled, Ask::Real).as_ref(), Ok(&plain), "{coefficients:?} times {factor:e}");
            // In [0, 1] sizes decide the way that is taken: both are right, not equal.
            faultless(&scaled, Ask::Unit);
        }
    }
    let mirrored: Vec<f64> = coefficients.iter().enumerate().map(|(j, c)| if j % 2 == 1 { -c } else { *c }).collect();
    faultless(&mirrored, Ask::Real);
    let reversed: Vec<f64> = coefficients.iter().rev().copied().collect();
    let back = faultless(&reversed, Ask::Real);
    let simple = |list: &[Root<f64>]| list.iter().all(|r| r.kind == RootKind::Simple && r.value != 0.0);
    let ends = [coefficients.first(), coefficients.last()].into_iter().flatten().all(|c| *c != 0.0);
    // Reciprocals of doubles stay doubles unless they are tiny or huge.
    let comfortable = |list: &[Root<f64>]| list.iter().all(|r| (1e-200..1e200).contains(&r.value.abs()));
    if ends && simple(&plain) && simple(&back) && comfortable(&plain) && comfortable(&back) {
        assert_eq!(plain.len(), back.len(), "{coefficients:?} and its reverse: {plain:?}, {back:?}");
    }
    // Integers shift exactly: p(x + 1).
    let is_small = |c: &f64| c.fract() == 0.0 && c.abs() < 1e9;
    if coefficients.len() <= 8 && coefficients.iter().all(is_small) {
        let mut shifted = coefficients.to_vec();
        for done in 0..shifted.len() {
            for j in (done + 1..shifted.len()).rev() {
                shifted[j - 1] += shifted[j];
            }
        }
        faultless(&shifted, Ask::Between(-1.0, 0.0));
        faultless(&shifted, Ask::Real);
    }
}

/// Closest point: not farther than brute force finds it, by 1e-12 of the distance, exactly evaluated (and by a few roundings
/// of the coordinates and of Horner's scheme, which is all there is when the query lies on the curve); the answer is where it says; the
/// part of a cubic answers for the part; a closest point inside is among the roots of the quintic.
///
/// # Panics
/// If anything of this does not hold.
pub fn closest(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let (cubic, q) = decode::cubic_and_query(&mut bytes);
    let (from, to) = (f64::from(bytes.byte()) / 255.0, f64::from(bytes.byte()) / 255.0);
    check_closest(&cubic, &q, from.min(to), from.max(to));
}

/// [`closest`] on given numbers; from ≤ to, both in [0, 1].
///
/// # Panics
/// If it does not hold.
pub fn check_closest(cubic: &Cubic<f64>, q: &Point<f64>, from: f64, to: f64) {
    let b = cubic.power_basis();
    let say = || format!("{cubic:?}, {q:?}");
    let found = nearest(&b, q);
    assert!((0.0..=1.0).contains(&found.t), "{}: t = {}", say(), found.t);
    assert_eq!(found.point, b.eval(&found.t), "{}: B(t)", say());
    let (least, brute_t) = brute(&b, q);
    let exact = Closest::new(&b, q).unwrap_or_else(|| panic!("{}: not finite", say()));
    let size = cubic.points.iter().map(|p| p.x.abs().max(p.y.abs())).fold(q.x.abs().max(q.y.abs()), f64::max);
    // Rounding coordinates moves a point by the first, whatever the solver, and Horner's scheme by the second.
    let noise = |t: f64| f64::max(8.0 * f64::EPSILON * size, horner_noise(&b, q, t));
    let agree = (found.distance_sq.sqrt() - least.sqrt()).abs() <= 1e-13 * least.sqrt();
    if !agree && exact.excess(found.t) > 1e-12 {
        let absolute = exact.excess_absolute(found.t);
        let allowed = noise(found.t) + noise(brute_t);
        assert!(absolute <= allowed, "{}: t = {}, brute {brute_t}, {absolute:e} too far", say(), found.t);
    }
    let part = nearest_between(&b, q, &from, &to);
    assert!(from <= part.t && part.t <= to, "{}: {} in [{from}, {to}]", say(), part.t);
    for i in 0..=64 {
        let t = from + (to - from) * f64::from(i) / 64.0;
        let other = b.eval(&t).distance_sq(q).sqrt();
        let allowed = noise(part.t) + noise(t);
        assert!(part.distance_sq.sqrt() <= other + allowed, "{}: {t} is nearer than {} on the part", say(), part.t);
    }
    // A closest point inside is stationary: one of the roots of the quintic, up to 1e-9 and what rounding its coefficients
    // does (they carry the errors of several roundings of differences of coordinates), or of the exact quintic: where
    // coordinates differ by 18 orders of magnitude it can have roots that the rounded one has not. Where all points from there
    // to a root or an end are equally far up to the rounding of coordinates, as for queries so far away that a double does not
    // hold the difference, any of them is an answer.
    let quintic = distance_quintic(&b, q).coefficients;
    if 0.0 < found.t
        && found.t < 1.0
        && let Some(judge) = Judge::new(&quintic)
    {
        let roots = solve(&quintic, Ask::Unit).unwrap_or_default();
        let is_near = roots.iter().any(|r| r.lower - 1e-9 <= found.t && found.t <= r.upper + 1e-9);
        let is_level = || {
            let to = roots.iter().map(|r| r.value).chain([0.0, 1.0]);
            let apart = |t: f64| (b.eval(&t).distance_sq(q).sqrt() - found.distance_sq.sqrt()).abs();
            let between = |t: f64, i: i32| found.t + (t - found.t) * f64::from(i) / 16.0;
            let is_level = |t: f64| apart(t) <= noise(found.t) + noise(t);
            to.into_iter().any(|t| (0..=16).all(|i| is_level(between(t, i))))
        };
        let is_exact = || exact.critical().is_some_and(|roots| roots.iter().any(|t| (t - found.t).abs() <= 1e-9));
        let is_stationary = is_near || judge.is_covered(&roots, found.t) || is_level() || is_exact();
        assert!(is_stationary, "{}: {} is not stationary: {roots:?}", say(), found.t);
    }
}

/// What Horner's scheme leaves unknown of |B(t) − q| where two points are compared. Three of its steps and a difference are off by
/// 7u(Σ|aⱼ|tʲ + |q|) in each coordinate: once in the distance itself, and once more in the curve whose stationary points are looked for,
/// which is off by as much.
fn horner_noise(b: &PowerBasis<f64>, q: &Point<f64>, t: f64) -> f64 {
    let [a1, a2, a3] = &b.a;
    let moduli = |[c0, c1, c2, c3]: [f64; 4]| c0.abs() + t * (c1.abs() + t * (c2.abs() + t * c3.abs()));
    let x = moduli([b.origin.x, a1.x, a2.x, a3.x]) + q.x.abs();
    let y = moduli([b.origin.y, a1.y, a2.y, a3.y]) + q.y.abs();
    7.0 * f64::EPSILON * x.hypot(y)
}

/// The SVG reader: a typed error that names the file, in one line, or a drawing whose numbers are finite and whose paths
/// are chains; the same drawing when read again.
///
/// # Panics
/// If anything of this does not hold.
pub fn document(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    // A few bytes would rarely make a document: those that do not look like one are taken as path data or as children.
    let wrapped = match text.as_bytes().first() {
        Some(b'<') => text.to_owned(),
        Some(b'!') => format!(r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">{}</svg>"#, &text[1..]),
        _ => {
            let data = text.replace(['"', '<', '&'], " ");
            format!(r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="{data}"/></svg>"#)
        }
    };
    let read = svg::read_str(&wrapped, "fuzz.svg");
    let drawing = match &read {
        Ok(drawing) => drawing,
        Err(error) => {
            let message = error.to_string();
            assert!(message.contains("fuzz.svg"), "{message:?} names no file, from {wrapped:?}");
            assert!(message.lines().count() == 1, "{message:?} has several lines, from {wrapped:?}");
            return;
        }
    };
    let mut bounds = Aabb::empty();
    for path in &drawing.paths {
        assert!(!path.cubics.is_empty(), "a path without cubics, from {wrapped:?}");
        assert!(path.group.is_none_or(|group| group < drawing.groups.len()), "a group that is not there");
        for cubic in &path.cubics {
            assert!(cubic.is_finite(), "{cubic:?} from {wrapped:?}");
            bounds.merge(&cubic.control_box());
        }
        for pair in path.cubics.windows(2) {
            assert_eq!(pair[0].end(), pair[1].start(), "a chain, from {wrapped:?}");
        }
        if let (true, Some(first), Some(last)) = (path.closed, path.cubics.first(), path.cubics.last()) {
            let (start, end): (&Point<f64>, &Point<f64>) = (first.start(), last.end());
            assert_eq!(start, end, "a closed path ends where it starts, from {wrapped:?}");
        }
    }
    for (i, group) in drawing.groups.iter().enumerate() {
        assert!(group.parent.is_none_or(|parent| parent < i), "parents come before children, from {wrapped:?}");
    }
    for warning in &drawing.warnings {
        let words = format!("{}: {}", warning.element, warning.message);
        assert!(words.lines().count() <= 1, "{words:?} has several lines, from {wrapped:?}");
    }
    assert_eq!(Ok(drawing), svg::read_str(&wrapped, "fuzz.svg").as_ref(), "reading is a function, of {wrapped:?}");
}
