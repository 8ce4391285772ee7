//! Jobs for a plotter's controller: a drawing as a `.fsj` stream, with the η that makes the chip's samples true.
//!
//! The chip computes lfs in f32 from a fixed number of foot points a cubic. What that may be too large by is measured here,
//! by running the same computation in f32 and comparing it with the engine's lfs at four places a foot point on every cubic;
//! the chip then samples at ε/(1 + η). It is measured at those places, not proved between them.
//!
//! A chip that does not compute lfs gets it with the job ([`Lfs::Along`]): values along every cubic of C that are not above the
//! engine's lfs at their places, so many that what the chip makes of them is short by an eighth at most, or lies below the floor. η is then what is measured of it in the same way, and that is nothing: between the places the
//! chip's answer is a bound (`feature_sampling::lfs::table`).

use feature_sampling::bezier::Cubic;
use feature_sampling::buffer::BufferFull;
use feature_sampling::curve::door::{DoorOptions, sine_of_degrees};
use feature_sampling::curve::given::{self, Extent};
use feature_sampling::curve::{Curve, CurveParam, JointKind, Path, Segment};
use feature_sampling::geometry::{Aabb, Point};
use feature_sampling::lfs::FeatureSize;
use feature_sampling::lfs::compact::{Block, Blocks, CompactIndex};
use feature_sampling::lfs::table::{Column, LfsTable};
use feature_sampling::medial;
use feature_sampling::model::CurveModel;
use fsample_job::{Encoder, JobError, JobOptions, LEAF, expand, reduce};
use lineart::drawing::Drawing;

use crate::engine::{Bounds, Density, Engine};
use crate::errors::{Failure, shown};

/// Foot points a cubic where `--steps` does not say.
const FOOT_POINTS: u32 = 32;

/// The turn from which a joint is a corner, in degrees, where the chip makes the curve: that of its door's defaults.
const CORNER_ANGLE: f64 = 1.0;

/// Looks between two foot points.
const LOOKS: u32 = 4;

/// Who computes lfs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Lfs {
    /// The chip.
    OnChip,
    /// The host, which sends it along.
    Along,
}

/// The bytes of a job. `feed` in millimetres a minute; where the drawing has no physical size a unit counts as one.
pub(crate) fn bytes(
    drawing: &Drawing,
    engine: &Engine<'_>,
    bounds: &Bounds,
    steps: Option<u32>,
    feed: f64,
    lfs: Lfs,
) -> Result<Vec<u8>, Failure> {
    let Density::Epsilon(epsilon) = bounds.density else {
        return Err(Failure::usage("a job takes --epsilon, not --rho"));
    };
    if bounds.grading.is_some() || bounds.start != 0.0 {
        return Err(Failure::usage("a job takes neither --grading nor --start"));
    }
    if lfs == Lfs::OnChip && engine.corner_angle().to_bits() != CORNER_ANGLE.to_bits() {
        let message = "the chip takes corners from 1 degree on: a job takes --corner-angle only with --with-lfs";
        return Err(Failure::usage(message));
    }
    let name = shown(&drawing.source);
    let foot_points = u16::try_from(steps.unwrap_or(FOOT_POINTS)).ok().filter(|n| (1..=1024).contains(n));
    let foot_points = foot_points.ok_or_else(|| Failure::usage("a job takes --steps from 1 to 1024"))?;
    let paths: Vec<(bool, Vec<Cubic<f32>>)> =
        drawing.paths.iter().map(|path| (path.closed, path.cubics.iter().map(single).collect())).collect();
    let min_distance = bounds.min_distance.unwrap_or(Engine::diagonal(drawing) / 1000.0);
    let floor = min_distance / epsilon;
    // As on the chip: the same leaves.
    let mut door = DoorOptions { leaf: LEAF, ..DoorOptions::default() };
    if lfs == Lfs::Along {
        // The chip takes the curve as it is sent.
        door.corner_sine = rounded(sine_of_degrees(&engine.corner_angle()));
    }
    let input: Vec<(bool, &[Cubic<f32>])> = paths.iter().map(|(closed, cubics)| (*closed, cubics.as_slice())).collect();
    let model = CurveModel::<f32>::new(&input, &door).map_err(|error| Failure::input(&drawing.source, error))?;
    let full = || Failure::limit(format!("{name}: more medial points than a job may have"));
    let sent = match lfs {
        Lfs::OnChip => None,
        Lfs::Along => Some(Sent::new(&model, engine, steps, floor)),
    };
    let eta = match &sent {
        None => excess(&model, engine, u32::from(foot_points), floor).map_err(|_| full())?,
        Some(sent) => sent.excess(engine, floor),
    };
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
    let mut out = vec![0; 64 + 10 * paths.len() + 25 * count + sent.as_ref().map_or(0, Sent::bytes)];
    let written = match &sent {
        None => encode(&mut out, &options, &paths),
        Some(sent) => sent.encode(&mut out, &options),
    };
    let written = written.map_err(|error| Failure::input(&drawing.source, error))?;
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
fn excess(model: &CurveModel<f32>, engine: &Engine<'_>, foot_points: u32, floor: f64) -> Result<f64, BufferFull> {
    let curve = model.curve();
    let mut slots = vec![Block::default(); 1 << 16];
    let mut blocks = Blocks::new(&mut slots, rounded(floor));
    let mut line = 0;
    for (path, _) in (0..).zip(curve.paths) {
        line = medial::walk_uniform(&curve, path, foot_points, model.contacts(), line, &mut blocks)?;
    }
    let blocks = blocks.finish()?;
    let mut boxes = vec![Aabb::default(); blocks.len()];
    let index = CompactIndex::build(blocks, &mut boxes)?;
    let mut most = 0.0_f64;
    let looks = LOOKS * foot_points;
    for segment in curve.segments {
        for k in 0..=looks {
            let p = segment.power.eval(&rounded(f64::from(k) / f64::from(looks)));
            let truth = engine.lfs(&double(&p));
            if truth > floor && truth.is_finite() {
                most = most.max(f64::from(index.distance(&p)) / truth - 1.0);
            }
        }
    }
    // The engine's own tolerance, and the places between those that were looked at.
    Ok(most * 1.25 + 0.003)
}

/// What a chip gets that does not compute lfs: the curve C, and values along it.
struct Sent {
    segments: Vec<Segment<f32>>,
    paths: Vec<Path>,
    columns: Vec<Column>,
    values: Vec<f32>,
    extent: Extent<f32>,
}

/// Steps between values along one segment: from the one to the other, by doubling.
const STEPS: [u32; 2] = [4, 1024];

impl Sent {
    /// The curve as the chip will have it, and its table: `steps` values a segment, or as many as it takes.
    fn new(model: &CurveModel<f32>, engine: &Engine<'_>, steps: Option<u32>, floor: f64) -> Self {
        let mut segments = Vec::new();
        let mut paths = Vec::new();
        for (index, path) in (0_u32..).zip(model.curve().paths) {
            let first = segments.len();
            let own = model.curve().segments.iter().skip(path.first as usize).take(path.count as usize);
            let mut here = None;
            for s in own {
                // As the stream has it: a cubic starts where the one before it ends.
                let mut cubic = s.cubic;
                cubic.points[0] = here.unwrap_or(cubic.points[0]);
                here = Some(cubic.points[3]);
                let corners = [0, 1].map(|side| s.end(side).kind == JointKind::Corner);
                segments.push(given::segment(number(segments.len()), index, cubic, corners));
            }
            paths.push(Path { source: index, first: number(first), ..*path });
        }
        let extent = Extent::of(&segments);
        let mut sent = Self { segments, paths, columns: Vec::new(), values: Vec::new(), extent };
        for index in 0..number(sent.segments.len()) {
            let first = sent.values.len();
            sent.columns.push(Column { first: number(first), count: 0 });
            let [mut few, most] = STEPS;
            if let Some(steps) = steps {
                few = steps;
            }
            loop {
                sent.values.truncate(first);
                sent.fill(engine, index, few);
                if steps.is_some() || few >= most || sent.is_close(engine, index, floor) {
                    break;
                }
                few *= 2;
            }
        }
        sent
    }

    fn curve(&self) -> Curve<'_, f32> {
        Curve {
            segments: &self.segments,
            sources: &[],
            paths: &self.paths,
            arcs: &[],
            nodes: &[],
            leaf: 1,
            diagonal: &self.extent.diagonal,
            noise: &self.extent.noise,
        }
    }

    /// Appends the values of a segment, none above the engine's lfs less its tolerance and the noise of the coordinates.
    fn fill(&mut self, engine: &Engine<'_>, segment: u32, steps: u32) {
        let column = Column { count: steps + 1, ..self.columns[segment as usize] };
        let curve = self.curve();
        let value = |k: u32| {
            let p = curve.point(&CurveParam { segment, t: column.parameter(k) }).unwrap_or_default();
            let lfs = engine.lfs(&double(&p)) * (1.0 - engine.tolerance()) - 2.0 * f64::from(self.extent.noise);
            // Rounded towards 0, twice.
            expand(reduce(rounded(lfs * (1.0 - 1e-7)).max(0.0)))
        };
        let values: Vec<f32> = (0..column.count).map(value).collect();
        self.columns[segment as usize] = column;
        self.values.extend(values);
    }

    /// The chip's answer and the engine's at places between the values of a segment.
    fn looks(&self, engine: &Engine<'_>, segment: u32) -> Vec<(f64, f64)> {
        let curve = self.curve();
        let table = LfsTable::new(&curve, &self.columns, |k| self.values.get(k as usize).copied().unwrap_or(0.0));
        let looks = LOOKS * (self.columns[segment as usize].count - 1);
        let look = |k: u32| {
            let at = CurveParam { segment, t: rounded(f64::from(k) / f64::from(looks)) };
            let p = curve.point(&at).unwrap_or_default();
            (f64::from(table.lfs(&at, &p)), engine.lfs(&double(&p)))
        };
        (0..=looks).map(look).collect()
    }

    /// Enough values: where lfs is above the floor the answer is short by an eighth at most.
    fn is_close(&self, engine: &Engine<'_>, segment: u32, floor: f64) -> bool {
        self.looks(engine, segment).iter().all(|&(told, lfs)| lfs <= floor || told >= lfs * 0.875 || told.is_infinite())
    }

    /// The largest relative excess of the chip's answers over the engine's lfs, where lfs is above `floor`.
    fn excess(&self, engine: &Engine<'_>, floor: f64) -> f64 {
        let all = (0..number(self.segments.len())).flat_map(|segment| self.looks(engine, segment));
        all.filter(|(_, lfs)| *lfs > floor && lfs.is_finite()).fold(0.0, |most, (told, lfs)| most.max(told / lfs - 1.0))
    }

    /// Bytes that it may take, at most.
    fn bytes(&self) -> usize {
        10 * self.paths.len() + self.segments.len() * (25 + 4 + 33) + 3 * self.values.len()
    }

    fn encode(&self, out: &mut [u8], options: &JobOptions) -> Result<usize, JobError> {
        let mut encoder = Encoder::new(out, options)?;
        let along: Vec<(&Segment<f32>, &Column)> = self.segments.iter().zip(&self.columns).collect();
        for path in &self.paths {
            let own = along.iter().skip(path.first as usize).take(path.count as usize);
            for (k, (segment, column)) in own.enumerate() {
                let [start, a, b, c] = &segment.cubic.points;
                if k == 0 {
                    encoder.begin([start.x, start.y], path.closed)?;
                }
                encoder.cubic([a.x, a.y, b.x, b.y, c.x, c.y])?;
                let values = self.values.iter().skip(column.first as usize).take(column.count as usize);
                let corners = [0, 1].map(|side| segment.end(side).kind == JointKind::Corner);
                encoder.table(corners, &values.copied().collect::<Vec<_>>())?;
            }
        }
        encoder.end()
    }
}

/// A point in double precision.
fn double(p: &Point<f32>) -> Point<f64> {
    Point::new(f64::from(p.x), f64::from(p.y))
}

/// A number of things in memory as an index.
fn number(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}
