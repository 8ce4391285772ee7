//! Real roots in [0, 1]: closest-point quintics of the three query classes and quintics with planted roots, beside
//! polycool (the solver of kurbo) at 1e-12.
#![allow(missing_docs, reason = "criterion's macros make undocumented functions")]

mod queries;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use feature_sampling::bezier::nearest::distance_quintic;
use feature_sampling::polynomial::Polynomial;
use std::hint::black_box;

/// 1024 quintics with k roots in [0, 1] and the others outside.
fn planted(k: usize) -> Vec<Polynomial<f64, 6>> {
    let mut random = queries::Random::new(7);
    (0..1024)
        .map(|_| {
            let mut c = [0.0; 6];
            c[0] = 1.0;
            for n in 0..5 {
                let root = if n < k { random.unit() } else { 1.1 + 4.0 * random.unit() };
                for j in (0..=n + 1).rev() {
                    let below = if j > 0 { c[j - 1] } else { 0.0 };
                    c[j] = below - root * c[j];
                }
            }
            Polynomial::new(c)
        })
        .collect()
}

fn bench(c: &mut Criterion) {
    let mut sets: Vec<(String, Vec<Polynomial<f64, 6>>)> = (0..3)
        .map(|n| {
            let list = queries::class(n, 1024).iter().map(|(b, q)| distance_quintic(&b.power_basis(), q)).collect();
            (format!("c{n}"), list)
        })
        .collect();
    sets.extend([0, 1, 3, 5].map(|k| (format!("k{k}"), planted(k))));
    let mut group = c.benchmark_group("quintic_in_unit");
    for (name, list) in &sets {
        let mut i = 0;
        group.bench_function(BenchmarkId::new("ours", name), |bencher| {
            bencher.iter(|| {
                i = (i + 1) % list.len();
                black_box(&list[i]).roots_in_unit()
            });
        });
        let theirs: Vec<polycool::Poly<6>> = list.iter().map(|p| polycool::Poly::new(p.coefficients)).collect();
        group.bench_function(BenchmarkId::new("polycool", name), |bencher| {
            bencher.iter(|| {
                i = (i + 1) % theirs.len();
                black_box(&theirs[i]).roots_between(0.0, 1.0, 1e-12)
            });
        });
    }
    for (name, list) in sets.iter().take(3) {
        let mut i = 0;
        group.bench_function(BenchmarkId::new("ours_all_real", name), |bencher| {
            bencher.iter(|| {
                i = (i + 1) % list.len();
                black_box(&list[i]).real_roots()
            });
        });
    }
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
