//! Ours and theirs in turns: ratios of times that a busy machine does not spoil, and who misses roots.
//!
//! `cargo bench --bench race` runs through each set of inputs with our function and with that of a peer (polycool 0.4 and kurbo
//! 0.13, at 1e-12) [`TURNS`] times in turns and prints the least time of both: for roots once in brackets of 1e-12 like theirs, once
//! in the narrowest. Then both solve products of (64x − k) with
//! integers k, whose coefficients are exact in doubles, so that the roots are known exactly: a root is missed if no answer is
//! within 1e-3 of it, an answer without a root within 1e-3 is a ghost. Under `cargo test` each is done once.

mod queries;

use feature_sampling::bezier::nearest::{distance_quintic, nearest};
use feature_sampling::polynomial::Polynomial;
use kurbo::ParamCurveNearest;
use std::hint::black_box;
use std::time::Instant;

/// Passes through each set of inputs.
const TURNS: usize = 25;

/// Inputs of each set. A thousand would be known by heart: predictors of branches learn the way of each of them in a few passes,
/// which no caller's data lets them do, and the more a function branches the more it gains.
const INPUTS: usize = 50_000;

/// Nanoseconds for each call in one pass.
fn pass<T, R>(list: &[T], f: &impl Fn(&T) -> R) -> f64 {
    let start = Instant::now();
    for item in list {
        // By reference: what is measured is no copy of the answer.
        let answer = f(black_box(item));
        black_box(&answer);
    }
    start.elapsed().as_secs_f64() * 1e9 / f64::from(u32::try_from(list.len().max(1)).unwrap_or(1))
}

/// Prints a row: our function on our inputs, theirs on theirs.
fn race<A, B, R, Q>(name: &str, turns: usize, ours: (&[A], impl Fn(&A) -> R), theirs: (&[B], impl Fn(&B) -> Q)) {
    let (mut a, mut b) = (Vec::new(), Vec::new());
    for _ in 0..turns {
        a.push(pass(ours.0, &ours.1));
        b.push(pass(theirs.0, &theirs.1));
    }
    let least = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min);
    let (a, b) = (least(&a), least(&b));
    println!("{name:24} {a:8.1} {b:8.1} {:8.2}", b / a);
}

/// Coefficients uniform in [−1, 1], none of them with a root in [0, 1] by a wide margin.
fn rootless(count: usize) -> Vec<Polynomial<f64, 6>> {
    let mut random = queries::Random::new(11);
    let mut list = Vec::new();
    while list.len() < count {
        let p = Polynomial::new([0; 6].map(|_| random.unit() * 2.0 - 1.0));
        let least = (0..=64).map(|i| p.eval(&(f64::from(i) / 64.0)).abs()).fold(f64::INFINITY, f64::min);
        if least > 0.05 && p.roots_in_unit().is_ok_and(|roots| roots.is_empty()) {
            list.push(p);
        }
    }
    list
}

/// The product of 64x − k over five integers: exact.
fn product(numerators: &[i32; 5]) -> Polynomial<f64, 6> {
    let mut c = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    for (n, k) in numerators.iter().enumerate() {
        for j in (0..=n + 1).rev() {
            let below = if j > 0 { c[j - 1] } else { 0.0 };
            c[j] = 64.0 * below - f64::from(*k) * c[j];
        }
    }
    Polynomial::new(c)
}

/// Missed roots and ghosts of a list of answers.
fn faults(found: &[f64], truth: &[f64]) -> [usize; 2] {
    let lonely =
        |these: &[f64], those: &[f64]| these.iter().filter(|a| !those.iter().any(|b| (*a - b).abs() < 1e-3)).count();
    [lonely(truth, found), lonely(found, truth)]
}

/// A class of products: integers in [0, 64] are roots in the interval.
type Class = (&'static str, fn(&mut dyn FnMut(i32, i32) -> i32) -> [i32; 5]);

const CLASSES: [Class; 6] = [
    ("simple, inside", |r| [4 + r(0, 9), 17 + r(0, 9), 30 + r(0, 9), 43 + r(0, 9), r(70, 200)]),
    ("one at an end", |r| [64 * r(0, 2), r(8, 28), r(36, 56), r(70, 200), r(-200, -6)]),
    ("double", |r| {
        let k = r(4, 60);
        [k, k, r(70, 200), r(70, 200), r(-200, -6)]
    }),
    ("triple", |r| {
        let k = r(4, 60);
        [k, k, k, r(70, 200), r(-200, -6)]
    }),
    ("quadruple", |r| {
        let k = r(4, 60);
        [k, k, k, k, r(-200, -6)]
    }),
    ("quintuple", |r| [r(4, 60); 5]),
];

/// Prints who misses what.
fn misses(count: usize) {
    println!("\n{count} products of each class: roots missed and ghosts\n{:24} {:>12} {:>12}", "", "ours", "polycool");
    for (name, make) in CLASSES {
        let mut random = queries::Random::new(3);
        let mut whole = |from: i32, to: i32| {
            #[allow(clippy::cast_possible_truncation, reason = "small integers")]
            let k = (random.unit() * f64::from(to - from)).floor() as i32;
            from + k
        };
        let mut sums = [[0; 2]; 2];
        for _ in 0..count {
            let numerators = make(&mut whole);
            let p = product(&numerators);
            let mut truth: Vec<f64> =
                numerators.iter().filter(|k| (0..=64).contains(*k)).map(|k| f64::from(*k) / 64.0).collect();
            truth.dedup();
            let ours: Vec<f64> =
                p.roots_in_unit().map_or_else(|_| Vec::new(), |roots| roots.iter().map(|r| r.value).collect());
            let theirs: Vec<f64> =
                polycool::Poly::new(p.coefficients).roots_between(0.0, 1.0, 1e-12).into_iter().collect();
            for (sum, found) in sums.iter_mut().zip([ours, theirs]) {
                let [missed, ghosts] = faults(&found, &truth);
                *sum = [sum[0] + missed, sum[1] + ghosts];
            }
        }
        let words = sums.map(|[missed, ghosts]| format!("{missed}, {ghosts}"));
        println!("{name:24} {:>12} {:>12}", words[0], words[1]);
    }
}

fn main() {
    let is_bench = std::env::args().any(|argument| argument == "--bench");
    let (turns, count) = if is_bench { (TURNS, INPUTS) } else { (1, 100) };
    println!("{:24} {:>8} {:>8} {:>8}", "ns a call", "ours", "theirs", "ratio");
    for n in 0..3 {
        let list = queries::class(n, count);
        let ours: Vec<_> = list.iter().map(|(b, q)| (b.power_basis(), *q)).collect();
        let theirs: Vec<_> = list
            .iter()
            .map(|(b, q)| {
                let [a, b, c, d] = b.points.map(|p| kurbo::Point::new(p.x, p.y));
                (kurbo::CubicBez::new(a, b, c, d), kurbo::Point::new(q.x, q.y))
            })
            .collect();
        let name = format!("nearest c{n}, kurbo");
        race(&name, turns, (&ours, |(b, q)| nearest(b, q)), (&theirs, |(b, q)| b.nearest(*q, 1e-12)));
    }
    let mut sets: Vec<(String, Vec<Polynomial<f64, 6>>)> = (0..3)
        .map(|n| {
            let list = queries::class(n, count).iter().map(|(b, q)| distance_quintic(&b.power_basis(), q)).collect();
            (format!("c{n}"), list)
        })
        .collect();
    sets.push(("rootless".to_owned(), rootless(count)));
    for (name, list) in &sets {
        let peers: Vec<polycool::Poly<6>> = list.iter().map(|p| polycool::Poly::new(p.coefficients)).collect();
        let theirs = |p: &polycool::Poly<6>| p.roots_between(0.0, 1.0, 1e-12);
        let alike = |p: &Polynomial<f64, 6>| p.roots_in_unit_within(&1e-12);
        race(&format!("roots {name}, polycool"), turns, (list, alike), (&peers, theirs));
        race(&format!("finest {name}, polycool"), turns, (list, |p| p.roots_in_unit()), (&peers, theirs));
    }
    for (name, list) in &sets {
        race(
            &format!("certified {name}, plain"),
            turns,
            (list, |p| p.certified_in_unit()),
            (list, |p| p.roots_in_unit()),
        );
    }
    misses(if is_bench { 10_000 } else { 10 });
}
