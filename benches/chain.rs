//! The chain from a drawing to its samples, step by step: tangent disk, medial walk, lfs look-up, sampling, whole job.
//!
//! The drawing is a shipped one (`drawings/celtic_triskell_01.svg`: 35 cubics, crossings) and, where the folder named by
//! `FSAMPLE_DATA` has it, the paper's COMPLEX. Run with `cargo bench --bench chain`.

use criterion::{Criterion, criterion_group, criterion_main};
use feature_sampling::bezier::Cubic;
use feature_sampling::curve::CurveParam;
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::medial::{Foot, Guard, Resolution, Side, tangent_disk, tangent_disk_beside};
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::SamplingOptions;
use std::hint::black_box;
use std::path::PathBuf;

/// A path: whether it is closed, and its cubics.
type Stroke = (bool, Vec<Cubic<f64>>);

fn drawings() -> Vec<(String, Vec<Stroke>)> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let mut files = vec![root.join("drawings/celtic_triskell_01.svg")];
    if let Some(extra) = std::env::var_os("FSAMPLE_DATA") {
        files.push(PathBuf::from(extra).join("drawings/complex.svg"));
    }
    files
        .iter()
        .filter_map(|file| {
            let drawing = lineart::svg::read_file(file).ok()?;
            let name = file.file_stem()?.to_string_lossy().into_owned();
            Some((name, drawing.paths.into_iter().map(|p| (p.closed, p.cubics)).collect()))
        })
        .collect()
}

fn chain(criterion: &mut Criterion) {
    for (name, strokes) in drawings() {
        let paths: Vec<(bool, &[Cubic<f64>])> = strokes.iter().map(|(c, s)| (*c, s.as_slice())).collect();
        let door = DoorOptions::default();
        let Ok(model) = CurveModel::new(&paths, &door) else { continue };
        let curve = model.curve();
        let feet: Vec<Foot<f64>> = (0..1000_u32)
            .filter_map(|i| {
                let count = u32::try_from(curve.segments.len()).unwrap_or(1);
                let at = CurveParam { segment: (i * count) / 1000, t: f64::from(i * count % 1000) / 1000.0 };
                Foot::normal(&curve, at, Side::Left)
            })
            .collect();
        let mut group = criterion.benchmark_group(name);
        group.bench_function("tangent disks of 1000 feet", |b| {
            b.iter(|| feet.iter().map(|f| tangent_disk(&curve, black_box(f)).radius.min(1e9)).sum::<f64>());
        });
        group.bench_function("the same 1000 in a row, guarded", |b| {
            b.iter(|| {
                let mut guard = Guard::new();
                feet.iter().map(|f| tangent_disk_beside(&curve, black_box(f), &mut guard).radius.min(1e9)).sum::<f64>()
            });
        });
        group.bench_function("the door", |b| b.iter(|| CurveModel::new(black_box(&paths), &door).is_ok()));
        for (label, resolution) in
            [("tolerance 1e-3", Resolution::Tolerance(1e-3)), ("100 steps", Resolution::Steps(100))]
        {
            group.bench_function(format!("medial polylines, {label}"), |b| {
                b.iter(|| MedialModel::new(&model, black_box(&resolution)).points().len());
            });
        }
        let medial = MedialModel::new(&model, &Resolution::Tolerance(1e-3));
        group.bench_function("lfs of 1000 points", |b| {
            b.iter(|| feet.iter().map(|f| medial.lfs(black_box(&f.point)).min(1e9)).sum::<f64>());
        });
        let options = SamplingOptions::default();
        group.bench_function("epsilon-samples at 0.5", |b| {
            b.iter(|| model.sample(&medial, black_box(&options)).map_or(0, |s| s.len()));
        });
        group.bench_function("whole job", |b| {
            b.iter(|| {
                let model = CurveModel::new(black_box(&paths), &door).ok()?;
                let medial = MedialModel::new(&model, &Resolution::Tolerance(1e-3));
                model.sample(&medial, &options).ok().map(|s| s.len())
            });
        });
        group.finish();
    }
}

criterion_group!(benches, chain);
criterion_main!(benches);
