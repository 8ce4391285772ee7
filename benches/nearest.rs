//! The closest point of a cubic for the three query classes, beside kurbo at 1e-12, and the hull test.
#![allow(missing_docs, reason = "criterion's macros make undocumented functions")]

mod queries;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use feature_sampling::bezier::Cubic;
use feature_sampling::bezier::hull::{hull_distance_sq, hull_keeps_away};
use feature_sampling::bezier::nearest::{nearest, nearest_of};
use kurbo::ParamCurveNearest;
use std::hint::black_box;

fn bench(c: &mut Criterion) {
    let mut group = c.benchmark_group("nearest");
    for n in 0..3 {
        let list = queries::class(n, 1024);
        let ours: Vec<_> = list.iter().map(|(b, q)| (b.power_basis(), *q)).collect();
        let mut i = 0;
        group.bench_function(BenchmarkId::new("ours", format!("c{n}")), |bencher| {
            bencher.iter(|| {
                i = (i + 1) % ours.len();
                let (b, q) = black_box(&ours[i]);
                nearest(b, q)
            });
        });
        let theirs: Vec<_> = list
            .iter()
            .map(|(b, q)| {
                let p = b.points.map(|p| kurbo::Point::new(p.x, p.y));
                (kurbo::CubicBez::new(p[0], p[1], p[2], p[3]), kurbo::Point::new(q.x, q.y))
            })
            .collect();
        group.bench_function(BenchmarkId::new("kurbo", format!("c{n}")), |bencher| {
            bencher.iter(|| {
                i = (i + 1) % theirs.len();
                let (b, q) = black_box(&theirs[i]);
                b.nearest(*q, 1e-12)
            });
        });
    }
    let list = queries::class(0, 1024);
    let cubics: Vec<Cubic<f64>> = list.iter().map(|(b, _)| *b).collect();
    let mut i = 0;
    group.bench_function("hull_distance_sq", |bencher| {
        bencher.iter(|| {
            i = (i + 1) % list.len();
            hull_distance_sq(black_box(&cubics[i]), &list[(i * 7) % list.len()].1)
        });
    });
    group.bench_function("hull_keeps_away", |bencher| {
        bencher.iter(|| {
            i = (i + 1) % list.len();
            hull_keeps_away(black_box(&cubics[i]), &list[(i * 7) % list.len()].1, &25.0)
        });
    });
    group.bench_function("nearest_of_64", |bencher| {
        bencher.iter(|| {
            i = (i + 1) % list.len();
            nearest_of(black_box(&cubics[..64]), &list[i].1, f64::INFINITY)
        });
    });
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
