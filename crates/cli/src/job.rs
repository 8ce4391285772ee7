//! Jobs for a plotter's controller: a drawing as a `.fsj` stream, with the η that makes the chip's samples true.
//!
//! The chip computes lfs in f32 from a fixed number of foot points a cubic. What that may be too large by is measured here,
//! by running the same computation in f32 and comparing it with the engine's lfs at four places a foot point on every cubic;
//! the chip then samples at ε/(1 + η). It is measured at those places, not proved between them.

use feature_sampling::bezier::Cubic;
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::geometry::{Aabb, Point};
use feature_sampling::lfs::compact::{Block, Blocks, CompactIndex};
use feature_sampling::medial;
use feature_sampling::model::CurveModel;
use fsample_job::{Encoder, JobError, JobOptions, LEAF};
use lineart::drawing::Drawing;

use crate::engine::{Bounds, Density, Engine};
use crate::errors::{Failure, shown};

/// Foot points a cubic where `--steps` does not say.
const FOOT_POINTS: u32 = 32;

/// Looks between two foot points.
const LOOKS: u32 = 4;

/// The bytes of a job. `feed` in millimetres a minute; where the drawing has no physical size a unit counts as one.
pub(crate) fn bytes(
    drawing: &Drawing,
    engine: &Engine<'_>,
    bounds: &Bounds,
    steps: Option<u32>,
    feed: f64,
) -> Result<Vec<u8>, Failure> {
    let Density::Epsilon(epsilon) = bounds.density else {
        return Err(Failure::usage("a job takes --epsilon, not --rho"));
    };
    if bounds.grading.is_some() || bounds.start != 0.0 {
        return Err(Failure::usage("a job takes neither --grading nor --start"));
    }
    let name = shown(&drawing.source);
    let foot_points = u16::try_from(steps.unwrap_or(FOOT_POINTS)).ok().filter(|n| (1..=1024).contains(n));
    let foot_points = foot_points.ok_or_else(|| Failure::usage("a job takes --steps from 1 to 1024"))?;
    let paths: Vec<(bool, Vec<Cubic<f32>>)> =
        drawing.paths.iter().map(|path| (path.closed, path.cubics.iter().map(single).collect())).collect();
    let min_distance = bounds.min_distance.unwrap_or(Engine::diagonal(drawing) / 1000.0);
    let eta = excess(drawing, engine, &paths, u32::from(foot_points), min_distance / epsilon)?;
    if eta > 1.0 {
        let advice = "raise --steps, or --min-distance above the details that it misses";
        return Err(Failure::limit(format!("{name}: the chip's lfs would be {eta:.2} times too large: {advice}")));
    }
    let per_mm = drawing.user_units_per_mm.unwrap_or(1.0);
    let feed = rounded(feed / 60.0 * per_mm);
    let options = JobOptions {
        epsilon: rounded(epsilon),
        eta: rounded(eta),
        chord_error: bounds.chord_error.map_or(0.0, rounded),
        min_distance: rounded(min_distance),
        max_distance: bounds.max_distance.map_or(0.0, rounded),
        feed,
        corner_speed: feed / 10.0,
        acceleration: rounded(1000.0 * per_mm),
        steps_per_unit: rounded(80.0 / per_mm),
        foot_points,
    };
    let count: usize = paths.iter().map(|(_, cubics)| cubics.len()).sum();
    let mut out = vec![0; 64 + 10 * paths.len() + 25 * count];
    let written = encode(&mut out, &options, &paths).map_err(|error| Failure::input(&drawing.source, error))?;
    out.truncate(written);
    Ok(out)
}

fn encode(out: &mut [u8], options: &JobOptions, paths: &[(bool, Vec<Cubic<f32>>)]) -> Result<usize, JobError> {
    let mut encoder = Encoder::new(out, options)?;
    for (closed, cubics) in paths {
        let Some(first) = cubics.first() else { continue };
        encoder.begin([first.start().x, first.start().y], *closed)?;
        for cubic in cubics {
            let [_, a, b, c] = &cubic.points;
            encoder.cubic([a.x, a.y, b.x, b.y, c.x, c.y])?;
        }
    }
    encoder.end()
}

/// Rounded to binary32.
#[expect(clippy::cast_possible_truncation, reason = "the chip's numbers are binary32")]
fn rounded(v: f64) -> f32 {
    v as f32
}

fn single(cubic: &Cubic<f64>) -> Cubic<f32> {
    Cubic { points: cubic.points.map(|p| Point::new(rounded(p.x), rounded(p.y))) }
}

/// The largest relative excess of the chip's lfs over the engine's, where lfs is above `floor`, and a little more.
fn excess(
    drawing: &Drawing,
    engine: &Engine<'_>,
    paths: &[(bool, Vec<Cubic<f32>>)],
    foot_points: u32,
    floor: f64,
) -> Result<f64, Failure> {
    let input: Vec<(bool, &[Cubic<f32>])> = paths.iter().map(|(closed, cubics)| (*closed, cubics.as_slice())).collect();
    // As on the chip: the same leaves, the same blocks.
    let door = DoorOptions { leaf: LEAF, ..DoorOptions::default() };
    let model = CurveModel::<f32>::new(&input, &door).map_err(|error| Failure::input(&drawing.source, error))?;
    let curve = model.curve();
    let mut slots = vec![Block::default(); 1 << 16];
    let mut blocks = Blocks::new(&mut slots, rounded(floor));
    let relevance = medial::walk::relevance(&curve);
    let full = |_| Failure::limit(format!("{}: more medial points than a job may have", shown(&drawing.source)));
    let mut line = 0;
    for (path, _) in (0..).zip(curve.paths) {
        line = medial::walk_uniform(&curve, path, foot_points, model.contacts(), &relevance, line, &mut blocks)
            .map_err(full)?;
    }
    let blocks = blocks.finish().map_err(full)?;
    let mut boxes = vec![Aabb::default(); blocks.len()];
    let index = CompactIndex::build(blocks, &mut boxes).map_err(full)?;
    let mut most = 0.0_f64;
    let looks = LOOKS * foot_points;
    for segment in curve.segments {
        for k in 0..=looks {
            let p = segment.power.eval(&rounded(f64::from(k) / f64::from(looks)));
            let truth = engine.lfs(&Point::new(f64::from(p.x), f64::from(p.y)));
            if truth > floor && truth.is_finite() {
                most = most.max(f64::from(index.distance(&p)) / truth - 1.0);
            }
        }
    }
    // The engine's own tolerance, and the places between those that were looked at.
    Ok(most * 1.25 + 0.003)
}
