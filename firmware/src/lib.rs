//! The controller: it takes a job byte by byte, holds it in lent memory, computes lfs on the chip in f32, and hands out
//! samples through the resumable sampler.
//!
//! The same code runs on the chip (`src/bin/controller.rs`) and on the host (`src/bin/host.rs`); the kernel uses only
//! + − × ÷ √ and comparisons, so both give the same samples to the bit.
#![no_std]
#![forbid(unsafe_code)]

use feature_sampling::bezier::Cubic;
use feature_sampling::buffer::{SliceStore, Store};
use feature_sampling::curve::contact::{self, Contact};
use feature_sampling::curve::door::{self, CurveBuffers, DoorOptions, PathInput};
use feature_sampling::curve::{Arc, Path, Segment};
use feature_sampling::geometry::Point;
use feature_sampling::geometry::hierarchy::{Item, Node, nodes_for};
use feature_sampling::lfs::{self, LfsIndex, items_for};
use feature_sampling::medial::{self, MedialPoint, Resolution};
use feature_sampling::sampling::resumable::{Resumable, Step};
use feature_sampling::sampling::{Condition, Sample, SamplingError, SamplingOptions};
use fsample_job::{Command, Decoder, JobError, JobOptions};

/// Cubics that a job may have.
pub const CUBICS: usize = 256;
/// Paths that a job may have.
pub const PATHS: usize = 64;
/// Segments of C: a closing line a path and splits at cusps come on top of the cubics.
pub const SEGMENTS: usize = CUBICS + PATHS;
/// Arcs.
pub const ARCS: usize = 12 * SEGMENTS;
/// Medial points of the whole job.
pub const MEDIAL: usize = 24_576;
/// Places where the job touches itself.
pub const CONTACTS: usize = 512;

/// What went wrong with a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The stream is no job.
    Job(JobError),
    /// More cubics, paths, arcs, touchings or medial points than there is memory for.
    Memory,
    /// What the job draws is no curve.
    Curve,
    /// The sampler refused its options or its limit.
    Sampling(SamplingError),
}

/// Lent memory; each slice has as many entries as the constant of its name.
#[derive(Debug)]
pub struct Arena<'a> {
    /// [`CUBICS`].
    pub cubics: &'a mut [Cubic<f32>],
    /// [`PATHS`]: the number of cubics, and whether the path is closed.
    pub lengths: &'a mut [(usize, bool)],
    /// [`SEGMENTS`].
    pub segments: &'a mut [Segment<f32>],
    /// [`PATHS`].
    pub paths: &'a mut [Path],
    /// [`ARCS`].
    pub arcs: &'a mut [Arc<f32>],
    /// Nodes over the arcs.
    pub nodes: &'a mut [Node<f32>],
    /// Scratch: as many as arcs.
    pub items: &'a mut [Item<f32>],
    /// Scratch.
    pub order: &'a mut [u32],
    /// [`CONTACTS`].
    pub contacts: &'a mut [Contact<f32>],
    /// [`MEDIAL`].
    pub medial: &'a mut [MedialPoint<f32>],
    /// Scratch: [`MEDIAL_ITEMS`].
    pub medial_items: &'a mut [Item<f32>],
    /// Nodes over the medial polylines.
    pub medial_nodes: &'a mut [Node<f32>],
}

/// Nodes over [`ARCS`].
pub const ARC_NODES: usize = nodes_for(ARCS);
/// Items over [`MEDIAL`].
pub const MEDIAL_ITEMS: usize = items_for(MEDIAL);
/// Nodes over [`MEDIAL`].
pub const MEDIAL_NODES: usize = nodes_for(MEDIAL_ITEMS);
/// Scratch entries: one a segment or two a path.
pub const ORDER: usize = SEGMENTS + 2 * PATHS;

/// What the controller tells as it works.
pub trait Listener {
    /// A phase starts: 1 the door, 2 touchings, 3 medial polylines, 4 their index, 5 sampling.
    fn phase(&mut self, phase: u32);
    /// A call of the sampler starts.
    fn before_step(&mut self);
    /// It has ended.
    fn after_step(&mut self);
    /// A sample.
    fn sample(&mut self, sample: &Sample<f32>);
}

/// What a job came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Totals {
    /// Segments of C.
    pub segments: usize,
    /// Arcs of C.
    pub arcs: usize,
    /// Medial points.
    pub medial: usize,
    /// Samples.
    pub samples: u32,
    /// Calls of the sampler.
    pub calls: u32,
}

/// Receives a job and runs it. `budget` is the number of turns of a call of the sampler.
///
/// # Errors
/// See [`Fault`]. Nothing is sampled before the job's checksum has been found to hold.
pub fn run(
    bytes: impl Iterator<Item = u8>,
    budget: u32,
    arena: &mut Arena<'_>,
    listener: &mut impl Listener,
) -> Result<Totals, Fault> {
    let full = |_| Fault::Memory;
    let mut lengths = SliceStore::new(&mut *arena.lengths);
    let options = receive(bytes, arena.cubics, &mut lengths)?;
    let lengths: &[(usize, bool)] = lengths.into_items();
    let cubics: &[Cubic<f32>] = arena.cubics;

    listener.phase(1);
    let mut buffers = CurveBuffers {
        segments: SliceStore::new(&mut *arena.segments),
        paths: SliceStore::new(&mut *arena.paths),
        arcs: SliceStore::new(&mut *arena.arcs),
        nodes: SliceStore::new(&mut *arena.nodes),
        items: SliceStore::new(&mut *arena.items),
        order: SliceStore::new(&mut *arena.order),
    };
    let input = lengths.iter().scan(0_usize, |from, &(count, closed)| {
        let cubics = cubics.get(*from..*from + count).unwrap_or_default();
        *from += count;
        Some(PathInput { closed, cubics })
    });
    let entered = door::enter(input, &DoorOptions::default(), &mut buffers).map_err(|error| match error {
        door::CurveError::Full(_) => Fault::Memory,
        _ => Fault::Curve,
    })?;
    let curve = buffers.curve(&entered);

    listener.phase(2);
    let mut contacts = SliceStore::new(&mut *arena.contacts);
    for (segment, _) in (0_u32..).zip(curve.segments) {
        contact::find(&curve, segment, &mut contacts).map_err(full)?;
    }
    let contacts: &[Contact<f32>] = contacts.into_items();

    listener.phase(3);
    let mut points = SliceStore::new(&mut *arena.medial);
    let relevance = medial::walk::relevance(&curve);
    let mut line = 0;
    for (path, _) in (0_u32..).zip(curve.paths) {
        let steps = Resolution::Steps(u32::from(options.foot_points));
        line = medial::walk(&curve, path, &steps, contacts, &relevance, line, &mut points).map_err(full)?;
    }
    let points: &[MedialPoint<f32>] = points.into_items();

    listener.phase(4);
    let mut tree = SliceStore::new(&mut *arena.medial_nodes);
    lfs::build(points, &mut SliceStore::new(&mut *arena.medial_items), &mut tree).map_err(full)?;
    let index = LfsIndex::new(points, tree.into_items());

    listener.phase(5);
    let sampling = sampling_options(&options);
    let mut totals =
        Totals { segments: curve.segments.len(), arcs: curve.arcs.len(), medial: points.len(), samples: 0, calls: 0 };
    for (path, _) in (0_u32..).zip(curve.paths) {
        let mut sampler = Resumable::new(&curve, &index, path, &sampling).map_err(Fault::Sampling)?;
        // Every call gets on; the sampler's limit ends it.
        loop {
            listener.before_step();
            let step = sampler.step(budget);
            listener.after_step();
            totals.calls += 1;
            match step.map_err(Fault::Sampling)? {
                Step::Pending => {}
                Step::Done => break,
                Step::Sample(sample) => {
                    totals.samples += 1;
                    listener.sample(&sample);
                }
            }
        }
    }
    Ok(totals)
}

/// The bounds of a job; ε is lowered by what lfs on the chip may be too large by.
#[must_use]
pub fn sampling_options(options: &JobOptions) -> SamplingOptions<f32> {
    let some = |v: f32| (v > 0.0).then_some(v);
    SamplingOptions {
        condition: Condition::Epsilon(options.epsilon / (1.0 + options.eta)),
        chord_error: some(options.chord_error),
        min_distance: some(options.min_distance),
        max_distance: some(options.max_distance),
        even: false,
        limit: 1_000_000,
        ..SamplingOptions::default()
    }
}

/// Reads the whole stream into the arena.
fn receive(
    bytes: impl Iterator<Item = u8>,
    cubics: &mut [Cubic<f32>],
    lengths: &mut SliceStore<'_, (usize, bool)>,
) -> Result<JobOptions, Fault> {
    let mut decoder = Decoder::new();
    let mut options = None;
    let (mut count, mut here) = (0_usize, Point::new(0.0, 0.0));
    for byte in bytes {
        let curve = match decoder.push(byte).map_err(Fault::Job)? {
            None | Some(Command::End) => continue,
            Some(Command::Options(given)) => {
                options = Some(given);
                continue;
            }
            Some(Command::Begin { at: [x, y], closed }) => {
                here = Point::new(x, y);
                lengths.push((0, closed)).map_err(|_| Fault::Memory)?;
                continue;
            }
            Some(Command::Line([x, y])) => Cubic::line(here, Point::new(x, y)),
            Some(Command::Cubic([a, b, c, d, e, f])) => {
                Cubic::new(here, Point::new(a, b), Point::new(c, d), Point::new(e, f))
            }
        };
        here = *curve.end();
        *cubics.get_mut(count).ok_or(Fault::Memory)? = curve;
        count += 1;
        if let Some((length, _)) = lengths.items_mut().last_mut() {
            *length += 1;
        }
    }
    decoder.finish().map_err(Fault::Job)?;
    options.ok_or(Fault::Job(JobError::Order))
}
