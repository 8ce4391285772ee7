//! Jobs for a plotter's controller: a drawing as a `.fsj` stream.
//!
//! The host takes the drawing through the door and sends the curve C, rounded to f32, so that the chip needs no door; and it says
//! at which places along C lfs is to be known: so many that what a table of lfs says between them is short by an eighth at most,
//! or lies below the floor.
//!
//! A chip that computes lfs does so in f32 from a fixed number of foot points a cubic. The host runs the same computation, to
//! the bit, and compares each value with the engine's lfs at its place; η is what they are too large by at most, where they are
//! above the floor. The chip divides its values by 1 + η. Then none is above lfs, and what the table says between the places is a
//! bound (`feature_sampling::lfs::table`): the places are all there is to check.
//!
//! A chip that does not compute lfs gets the values with the job ([`Lfs::Along`]), and η is 0.

use feature_sampling::bezier::Cubic;
use feature_sampling::buffer::BufferFull;
use feature_sampling::curve::given::{self, Extent};
use feature_sampling::curve::{ArcStart, Curve, CurveParam, JointKind, Path, Segment, arc, contact};
use feature_sampling::geometry::Point;
use feature_sampling::geometry::hierarchy::Node;
use feature_sampling::lfs::FeatureSize;
use feature_sampling::lfs::gather::Gather;
use feature_sampling::lfs::table::{Column, LfsTable};
use feature_sampling::medial::uniform::Progress;
use fsample_job::{Encoder, JobError, JobOptions, LEAF, expand, reduce};
use lineart::drawing::Drawing;
use std::cell::Cell;

use crate::engine::{Bounds, Density, Engine};
use crate::errors::{Failure, shown};

/// Foot points a cubic where `--steps` does not say.
const FOOT_POINTS: u32 = 32;

/// Looks between two places.
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
    let name = shown(&drawing.source);
    let foot_points = u16::try_from(steps.unwrap_or(FOOT_POINTS)).ok().filter(|n| (1..=1024).contains(n));
    let foot_points = foot_points.ok_or_else(|| Failure::usage("a job takes --steps from 1 to 1024"))?;
    let min_distance = bounds.min_distance.unwrap_or(Engine::diagonal(drawing) / 1000.0);
    let floor = min_distance / epsilon;
    // `--steps` is the number of foot points, or that of values where there are no foot points.
    let places = steps.filter(|_| lfs == Lfs::Along);
    let sent = Sent::new(engine, places, floor, lfs);
    let eta = match lfs {
        Lfs::OnChip => {
            let full = |_| Failure::limit(format!("{name}: more touchings than there is memory for"));
            sent.excess(engine, &sent.on_chip(u32::from(foot_points)).map_err(full)?, floor)
        }
        Lfs::Along => 0.0,
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
    let mut out = vec![0; 64 + sent.bytes()];
    let written = sent.encode(&mut out, &options, lfs).map_err(|error| Failure::input(&drawing.source, error))?;
    out.truncate(written);
    Ok(out)
}

/// Rounded to binary32.
#[expect(clippy::cast_possible_truncation, reason = "the chip's numbers are binary32")]
fn rounded(v: f64) -> f32 {
    v as f32
}

/// In binary32, from the end of the cubic before it, as the stream has it. What is a line of uniform speed remains one.
fn single(cubic: &Cubic<f64>, here: Option<Point<f32>>) -> Cubic<f32> {
    let [own, a, b, end] = cubic.points.map(|p| Point::new(rounded(p.x), rounded(p.y)));
    let start = here.unwrap_or(own);
    if *cubic == Cubic::line(*cubic.start(), *cubic.end()) {
        Cubic::line(start, end)
    } else {
        Cubic::new(start, a, b, end)
    }
}

/// What a chip gets: the curve C, the places along it, and what lfs is there.
struct Sent {
    segments: Vec<Segment<f32>>,
    paths: Vec<Path>,
    arcs: Vec<ArcStart<f32>>,
    nodes: Vec<Node<f32>>,
    columns: Vec<Column>,
    values: Vec<f32>,
    extent: Extent<f32>,
}

/// Steps between values along one segment: from the one to the other, by doubling.
const STEPS: [u32; 2] = [4, 1024];

impl Sent {
    /// The curve as the chip will have it, and its table: `steps` values a segment, or as many as it takes.
    fn new(engine: &Engine<'_>, steps: Option<u32>, floor: f64, lfs: Lfs) -> Self {
        let (mut segments, mut paths, mut arcs) = (Vec::new(), Vec::<Path>::new(), Vec::new());
        let curve = engine.curve();
        for path in curve.paths {
            let (first, index) = (segments.len(), number(paths.len()));
            let own = curve.segments.iter().skip(path.first as usize).take(path.count as usize);
            let mut here = None;
            for s in own {
                let cubic = single(&s.cubic, here);
                if cubic.points.iter().all(|p| p == cubic.start()) {
                    // What is a point in binary32 is no segment.
                    continue;
                }
                here = Some(*cubic.end());
                let corners = [0, 1].map(|side| s.end(side).kind == JointKind::Corner);
                segments.push(given::segment(number(segments.len()), index, cubic, corners));
                if lfs == Lfs::OnChip {
                    given::join(&mut segments);
                    cut(&mut segments, &mut arcs);
                }
            }
            let count = segments.len() - first;
            if count > 0 {
                paths.push(Path { source: index, first: number(first), count: number(count), ..*path });
            }
        }
        let extent = Extent::of(&segments);
        let mut nodes = Vec::new();
        if lfs == Lfs::OnChip {
            // Vectors take everything: there is no error.
            let _ = given::finish(&mut segments, &mut arcs, LEAF, &mut Vec::new(), &mut nodes);
        }
        let mut sent = Self { segments, paths, arcs, nodes, columns: Vec::new(), values: Vec::new(), extent };
        for index in 0..number(sent.segments.len()) {
            let first = sent.values.len();
            sent.columns.push(Column { first: number(first), count: 0 });
            if sent.segments[index as usize].twin.is_some() {
                // The table of the segment that it repeats stands for it.
                sent.fill(engine, index, 1);
                continue;
            }
            let [mut few, most] = STEPS;
            if let Some(steps) = steps {
                few = steps;
            }
            let mut try_with = |steps: u32| {
                sent.values.truncate(first);
                sent.fill(engine, index, steps);
                sent.is_close(engine, index, floor)
            };
            while !try_with(few) && steps.is_none() && few < most {
                few *= 2;
            }
            // Between that and half as many.
            if steps.is_none() && few > STEPS[0] && !(5..8).any(|eighths| try_with(few / 8 * eighths)) {
                try_with(few);
            }
        }
        sent
    }

    fn curve(&self) -> Curve<'_, f32> {
        Curve {
            segments: &self.segments,
            sources: &[],
            paths: &self.paths,
            arcs: &self.arcs,
            nodes: &self.nodes,
            leaf: LEAF,
            diagonal: &self.extent.diagonal,
            noise: &self.extent.noise,
        }
    }

    /// Appends the values of a segment.
    fn fill(&mut self, engine: &Engine<'_>, segment: u32, steps: u32) {
        let column = Column { count: steps + 1, ..self.columns[segment as usize] };
        let values: Vec<f32> = (0..column.count)
            // Rounded towards 0, twice.
            .map(|k| expand(reduce(rounded(self.lfs(engine, segment, column.parameter(k)) * (1.0 - 1e-7)).max(0.0))))
            .collect();
        self.columns[segment as usize] = column;
        self.values.extend(values);
    }

    /// No more than the engine's lfs at a place: less its tolerance and the noise of the coordinates.
    fn lfs(&self, engine: &Engine<'_>, segment: u32, t: f32) -> f64 {
        let p = self.curve().point(&CurveParam { segment, t }).unwrap_or_default();
        engine.lfs(&double(&p)) * (1.0 - engine.tolerance()) - 2.0 * f64::from(self.extent.noise)
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

    /// The values that the chip will compute.
    fn on_chip(&self, foot_points: u32) -> Result<Vec<f32>, BufferFull> {
        let curve = self.curve();
        let mut contacts = Vec::new();
        for segment in 0..number(curve.segments.len()) {
            contact::find(&curve, segment, &mut contacts)?;
        }
        let cells: Vec<Cell<u16>> = vec![Cell::new(0); self.values.len()];
        let (get, set) = (|k: u32| expand(cells[k as usize].get()), |k: u32, v: f32| cells[k as usize].set(reduce(v)));
        let mut most = vec![0.0; self.nodes.len()];
        let mut gather = Gather::new(&curve, &self.columns, &contacts, foot_points, &mut most, (get, set));
        while gather.step(u32::MAX) != Progress::Done {}
        Ok(cells.iter().map(|cell| expand(cell.get())).collect())
    }

    /// What values are too large by at most, where they are above `floor`: η.
    fn excess(&self, engine: &Engine<'_>, values: &[f32], floor: f64) -> f64 {
        let mut excess = 0.0_f64;
        for (segment, column) in (0..).zip(&self.columns).filter(|(s, _)| self.segments[*s as usize].twin.is_none()) {
            for k in 0..column.count {
                let value = f64::from(values[(column.first + k) as usize]);
                let lfs = self.lfs(engine, segment, column.parameter(k)).max(floor);
                if value > lfs {
                    excess = excess.max(value / lfs - 1.0);
                }
            }
        }
        // The quotient is rounded, and the chip's: some roundoffs of binary32.
        excess + if excess > 0.0 { 1e-6 } else { 0.0 }
    }

    /// Bytes that it may take, at most.
    fn bytes(&self) -> usize {
        10 * self.paths.len() + self.segments.len() * (25 + 4 + 33) + 3 * self.values.len() + 5 * self.arcs.len()
    }

    fn encode(&self, out: &mut [u8], options: &JobOptions, lfs: Lfs) -> Result<usize, JobError> {
        let mut encoder = Encoder::new(out, options)?;
        let along: Vec<(&Segment<f32>, &Column)> = self.segments.iter().zip(&self.columns).collect();
        for path in &self.paths {
            let own = along.iter().skip(path.first as usize).take(path.count as usize);
            for (k, (segment, column)) in own.enumerate() {
                let [start, a, b, c] = &segment.cubic.points;
                if k == 0 {
                    encoder.begin([start.x, start.y], path.closed)?;
                }
                if segment.cubic == Cubic::line(*start, *c) {
                    encoder.line([c.x, c.y])?;
                } else {
                    encoder.cubic([a.x, a.y, b.x, b.y, c.x, c.y])?;
                }
                let corners = [0, 1].map(|side| segment.end(side).kind == JointKind::Corner);
                if lfs == Lfs::OnChip {
                    encoder.places(corners, u16::try_from(column.count).unwrap_or(u16::MAX))?;
                    for arc in self.curve().arcs_of(segment).skip(1) {
                        encoder.cut(arc.span[0])?;
                    }
                    continue;
                }
                let values = self.values.iter().skip(column.first as usize).take(column.count as usize);
                encoder.table(corners, &values.copied().collect::<Vec<_>>())?;
            }
        }
        encoder.end()
    }
}

/// Arcs of the last segment, as the job will cut them.
fn cut(segments: &mut [Segment<f32>], arcs: &mut Vec<ArcStart<f32>>) {
    let (index, mut own) = (number(segments.len()) - 1, Vec::new());
    // Vectors take everything: there is no error.
    let _ = segments.last().map(|segment| arc::cut(index, segment, &mut own));
    let _ = given::arc(segments, arcs);
    for arc in own.iter().skip(1) {
        let _ = given::cut(segments, arcs, arc.t);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::ModelOptions;
    use fsample_job::{Command, Decoder};

    fn engine(drawing: &Drawing) -> Engine<'_> {
        let options = ModelOptions {
            steps: None,
            tolerance: 0.001,
            corner_angle: 1.0,
            max_medial_points: 1 << 20,
            threads: 1,
            quiet: true,
        };
        Engine::new(drawing, &options).unwrap_or_else(|error| panic!("{error:?}"))
    }

    /// η is computed for the cubics that the chip reads, to the bit. A stroke that is drawn twice, whose end is snapped to that of
    /// a third one, leaves a gap in C where its second drawing goes on; the stream has none.
    #[test]
    fn the_chip_reads_the_cubics_that_eta_is_for() {
        let svg = r#"<svg xmlns="http://www.w3.org/2000/svg"><path d="M0.1 0C0 30 40 30 40 0"/>
            <path d="M0.1 0C0 30 40 30 40 0L60.3 5.7"/><path d="M50 -30L39.99985 0"/></svg>"#;
        let drawing = lineart::svg::read_str(svg, "test").unwrap_or_else(|error| panic!("{error}"));
        let engine = engine(&drawing);
        let curve = engine.curve();
        let gap = |w: &[Segment<f64>]| w[0].path == w[1].path && w[0].cubic.end() != w[1].cubic.start();
        assert!(curve.segments.windows(2).any(gap), "C has a gap");
        let bounds = Bounds::least(0.5, Some(0.5));
        for lfs in [Lfs::OnChip, Lfs::Along] {
            let sent = Sent::new(&engine, None, 1.0, lfs);
            let bytes =
                bytes(&drawing, &engine, &bounds, None, 1200.0, lfs).unwrap_or_else(|error| panic!("{error:?}"));
            let (mut decoder, mut here, mut read) = (Decoder::new(), Point::new(0.0, 0.0), Vec::new());
            for command in bytes.iter().filter_map(|&byte| decoder.push(byte).expect("a job")) {
                let cubic = match command {
                    Command::Begin { at: [x, y], .. } => {
                        here = Point::new(x, y);
                        continue;
                    }
                    Command::Line([x, y]) => Cubic::line(here, Point::new(x, y)),
                    Command::Cubic([a, b, c, d, e, f]) => {
                        Cubic::new(here, Point::new(a, b), Point::new(c, d), Point::new(e, f))
                    }
                    _ => continue,
                };
                here = *cubic.end();
                read.push(cubic);
            }
            assert_eq!(read, sent.segments.iter().map(|s| s.cubic).collect::<Vec<_>>());
        }
    }

    /// Divided by 1 + η, the chip's values are not above lfs at their places, so that its answers are not above lfs anywhere; and
    /// with few foot points that takes an η.
    #[test]
    fn no_answer_of_the_chip_is_above_lfs() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../drawings/hook.svg");
        let drawing = lineart::drawing::load(file).unwrap_or_else(|error| panic!("{error}"));
        let engine = engine(&drawing);
        let floor = 0.005 * Engine::diagonal(&drawing);
        let sent = Sent::new(&engine, None, floor, Lfs::OnChip);
        let mut all = Vec::new();
        for foot_points in [2, 32] {
            let values = sent.on_chip(foot_points).expect("room");
            let eta = sent.excess(&engine, &values, floor);
            let curve = sent.curve();
            // How much more than lfs is answered, at five places a step.
            let most = |share: f64| {
                let table = LfsTable::new(&curve, &sent.columns, |k| values[k as usize] * rounded(share));
                let mut most = 0.0_f64;
                for (segment, column) in (0..).zip(&sent.columns) {
                    let looks = 5 * (column.count - 1);
                    for k in 0..=looks {
                        let at = CurveParam { segment, t: rounded(f64::from(k) / f64::from(looks)) };
                        let p = curve.point(&at).expect("a place");
                        let lfs = engine.lfs(&double(&p)).max(floor);
                        most = most.max(f64::from(table.lfs(&at, &p)) / lfs - 1.0);
                    }
                }
                most
            };
            assert!(most(1.0 / (1.0 + eta)) <= 0.0, "{foot_points}: {eta}");
            all.push((eta, most(1.0)));
        }
        let [(coarse, above), (fine, _)] = all[..] else { panic!("two") };
        assert!(coarse > 0.01 && above > 0.01, "{all:?}");
        assert!(fine < 0.01, "{all:?}");
    }
}
