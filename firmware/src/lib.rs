//! The controller: it takes a job byte by byte, holds it in lent memory, computes lfs on the chip in f32, and draws: samples
//! through the resumable sampler, motor steps through the planner.
//!
//! The same code runs on the chip (`src/bin/controller.rs`) and on the host (`src/bin/host.rs`); the kernel uses only
//! + − × ÷ √ and comparisons, so both give the same samples and the same steps to the bit.
//!
//! A job goes through two functions. [`receive`] reads it, checks it and makes the curve; its scratch memory is free
//! afterwards and may be the same bytes as [`MedialMemory`]. [`draw`] computes the medial polylines and their index, and
//! then draws. Every loop is bounded by the job; every failure is a [`Fault`], after which the next job can be received.
//!
//! A controller that gets lfs from its host does the same with [`table::receive`] and [`table::draw`], in a third of the
//! memory and less than half of the flash.
#![no_std]
#![deny(unsafe_code)]

#[allow(unsafe_code, reason = "each use is explained there")]
pub mod memory;
pub mod table;

use feature_sampling::bezier::Cubic;
use feature_sampling::buffer::{BufferFull, Forget, SliceStore, Store};
use feature_sampling::curve::contact::{self, Contact};
use feature_sampling::curve::door::{self, CurveBuffers, CurveError, DoorOptions, Entered, PathInput};
use feature_sampling::curve::{Arc, Curve, Path, Segment};
use feature_sampling::geometry::hierarchy::{Item, Node, nodes_for};
use feature_sampling::geometry::{Aabb, Point};
use feature_sampling::lfs::FeatureSize;
use feature_sampling::lfs::compact::{Block, Blocks, CompactIndex, boxes_for};
use feature_sampling::medial::uniform::{Progress, UniformWalk};
use feature_sampling::sampling::resumable::{Resumable, Step};
use feature_sampling::sampling::{Condition, Sample, SamplingError, SamplingOptions};
use fsample_job::{Command, Decoder, JobError, JobOptions, LEAF};
use fsample_planner::{Limits, MotorStep, PlanError, Planner};

/// Cubics that a job may have.
pub const CUBICS: usize = 200;
/// Paths that a job may have.
pub const PATHS: usize = 48;
/// Segments of C: closing lines and splits at cusps come on top of the cubics.
pub const SEGMENTS: usize = CUBICS + 4;
/// Arcs.
pub const ARCS: usize = 6 * CUBICS;
/// Leaves of the hierarchy over the arcs.
pub const LEAVES: usize = ARCS.div_ceil(LEAF as usize);
/// Its nodes.
pub const NODES: usize = nodes_for(LEAVES);
/// Places where the job touches itself.
pub const CONTACTS: usize = 96;
/// Blocks of up to 48 medial points of the whole job.
pub const BLOCKS: usize = 336;
/// Boxes over them.
pub const BOXES: usize = boxes_for(BLOCKS);
/// Scratch entries: one a segment or two a path.
pub const ORDER: usize = SEGMENTS;

/// Ticks a second of the timer that times motor steps.
pub const CLOCK: f32 = 84_000_000.0;

/// What went wrong with a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The stream is no job.
    Job(JobError),
    /// More cubics, paths, arcs, touchings or medial points than there is memory for.
    Memory,
    /// What the job draws is no curve.
    Curve(CurveError),
    /// The sampler refused its options or its limit.
    Sampling(SamplingError),
    /// A point or a limit that the motors cannot follow.
    Motion(PlanError),
}

impl Fault {
    /// The fault as it is reported: the kind in the second byte, in the first one what the job's decoder said.
    #[must_use]
    pub const fn code(&self) -> u32 {
        match self {
            Self::Job(error) => 0x100 | error.code() as u32,
            Self::Memory => 0x200,
            Self::Curve(CurveError::Empty) => 0x301,
            Self::Curve(CurveError::NoExtent) => 0x302,
            Self::Curve(_) => 0x300,
            Self::Sampling(_) => 0x400,
            Self::Motion(_) => 0x500,
        }
    }
}

impl From<BufferFull> for Fault {
    fn from(_: BufferFull) -> Self {
        Self::Memory
    }
}

impl From<PlanError> for Fault {
    fn from(error: PlanError) -> Self {
        Self::Motion(error)
    }
}

/// Memory for the curve; each slice has as many entries as the constant of its name.
#[derive(Debug)]
pub struct CurveMemory<'a> {
    /// [`SEGMENTS`].
    pub segments: &'a mut [Segment<f32>],
    /// [`PATHS`].
    pub paths: &'a mut [Path],
    /// [`ARCS`].
    pub arcs: &'a mut [Arc<f32>],
    /// [`NODES`].
    pub nodes: &'a mut [Node<f32>],
}

/// Memory that [`receive`] needs and that is free afterwards.
#[derive(Debug)]
pub struct Scratch<'a> {
    /// [`CUBICS`].
    pub cubics: &'a mut [Cubic<f32>],
    /// [`PATHS`]: the number of cubics, and whether the path is closed.
    pub lengths: &'a mut [(u32, bool)],
    /// [`LEAVES`].
    pub items: &'a mut [Item<f32>],
    /// [`ORDER`].
    pub order: &'a mut [u32],
}

/// Memory for lfs.
#[derive(Debug)]
pub struct MedialMemory<'a> {
    /// [`CONTACTS`].
    pub contacts: &'a mut [Contact<f32>],
    /// [`BLOCKS`].
    pub blocks: &'a mut [Block<f32>],
    /// [`BOXES`].
    pub boxes: &'a mut [Aabb<f32>],
}

/// What [`receive`] found: how much of its memory the curve takes, and what the job asks for.
#[derive(Clone, Debug)]
pub struct Received {
    options: JobOptions,
    entered: Entered<f32>,
    counts: [usize; 4],
}

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// A turn of the medial walk: a foot point with its disk, mostly.
    Foot,
    /// A call of the sampler.
    Sampler,
    /// A motor step of the planner.
    Motor,
    /// A line added to the planner.
    Line,
    /// The touchings of one segment.
    Contacts,
    /// The index over the medial polylines.
    Index,
}

impl Work {
    /// How many kinds there are.
    pub const KINDS: usize = 6;
}

/// What the controller tells as it works.
pub trait Listener {
    /// A piece of work starts.
    fn before(&mut self);
    /// It has ended.
    fn after(&mut self, work: Work);
    /// A sample.
    fn sample(&mut self, sample: &Sample<f32>);
    /// The pen goes down or up.
    fn pen(&mut self, down: bool);
    /// The motors step.
    fn motor(&mut self, step: MotorStep);
}

/// What a job came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Totals {
    /// Segments of C.
    pub segments: u32,
    /// Arcs of C.
    pub arcs: u32,
    /// Medial points; values of lfs, where the host has sent them.
    pub medial: u32,
    /// Blocks that hold them.
    pub blocks: u32,
    /// Samples.
    pub samples: u32,
    /// Calls of the sampler.
    pub calls: u32,
    /// Motor steps.
    pub steps: u32,
}

/// Reads a whole job and makes its curve. Nothing moves before the checksum has been found to hold.
///
/// # Errors
/// See [`Fault`]. The memory is then of no use, and free for the next job.
pub fn receive(
    bytes: impl Iterator<Item = u8>,
    memory: &mut CurveMemory<'_>,
    scratch: Scratch<'_>,
) -> Result<Received, Fault> {
    let mut lengths = SliceStore::new(scratch.lengths);
    let options = read(bytes, scratch.cubics, &mut lengths)?;
    let cubics: &[Cubic<f32>] = scratch.cubics;
    let mut buffers = CurveBuffers {
        segments: SliceStore::new(&mut *memory.segments),
        sources: Forget,
        paths: SliceStore::new(&mut *memory.paths),
        arcs: SliceStore::new(&mut *memory.arcs),
        nodes: SliceStore::new(&mut *memory.nodes),
        items: SliceStore::new(scratch.items),
        order: SliceStore::new(scratch.order),
    };
    let input = lengths.items().iter().scan(0_usize, |from, &(count, closed)| {
        let to = *from + count as usize;
        let cubics = cubics.get(*from..to).unwrap_or_default();
        *from = to;
        Some(PathInput { closed, cubics })
    });
    let door = DoorOptions { leaf: LEAF, ..DoorOptions::default() };
    let entered = door::enter(input, &door, &mut buffers).map_err(|error| match error {
        CurveError::Full(_) => Fault::Memory,
        error => Fault::Curve(error),
    })?;
    let counts = [
        buffers.segments.items().len(),
        buffers.paths.items().len(),
        buffers.arcs.items().len(),
        buffers.nodes.items().len(),
    ];
    Ok(Received { options, entered, counts })
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

/// Turns of the sampler in one call, in the images: at most five look-ups of lfs.
pub const TURNS: u32 = 4;

/// Computes lfs of a received job and draws it. `budget` is the number of turns of a call of the sampler.
///
/// # Errors
/// See [`Fault`].
pub fn draw(
    received: &Received,
    memory: &CurveMemory<'_>,
    medial: MedialMemory<'_>,
    budget: u32,
    listener: &mut impl Listener,
) -> Result<Totals, Fault> {
    let Received { options, entered, counts } = received;
    let [segments, paths, arcs, nodes] = *counts;
    let curve = Curve {
        segments: memory.segments.get(..segments).unwrap_or_default(),
        sources: &[],
        paths: memory.paths.get(..paths).unwrap_or_default(),
        arcs: memory.arcs.get(..arcs).unwrap_or_default(),
        nodes: memory.nodes.get(..nodes).unwrap_or_default(),
        leaf: entered.leaf,
        diagonal: &entered.diagonal,
        noise: &entered.noise,
    };
    let mut contacts = SliceStore::new(medial.contacts);
    for (segment, _) in (0_u32..).zip(curve.segments) {
        listener.before();
        contact::find(&curve, segment, &mut contacts)?;
        listener.after(Work::Contacts);
    }
    let contacts: &[Contact<f32>] = contacts.into_items();

    let mut feet = Blocks::new(medial.blocks, options.resolution());
    let mut line = 0;
    for (path, _) in (0_u32..).zip(curve.paths) {
        let mut walk = UniformWalk::new(&curve, path, u32::from(options.foot_points), contacts, line);
        // Every turn gets on; the path ends it.
        loop {
            listener.before();
            let progress = walk.step(1, &mut feet)?;
            listener.after(Work::Foot);
            if progress == Progress::Done {
                break;
            }
        }
        line = walk.polyline();
    }
    let points = feet.taken();
    let blocks: &[Block<f32>] = feet.finish()?;
    listener.before();
    let index = CompactIndex::build(blocks, medial.boxes)?;
    listener.after(Work::Index);

    let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    let totals = Totals {
        segments: count(segments),
        arcs: count(arcs),
        medial: points,
        blocks: count(blocks.len()),
        ..Totals::default()
    };
    draw_paths(&curve, &index, options, budget, totals, listener)
}

/// Draws all paths of a curve.
fn draw_paths(
    curve: &Curve<'_, f32>,
    features: &impl FeatureSize<f32>,
    options: &JobOptions,
    budget: u32,
    totals: Totals,
    listener: &mut impl Listener,
) -> Result<Totals, Fault> {
    let planner = Planner::new(Limits {
        feed: options.feed,
        corner_speed: options.corner_speed,
        acceleration: options.acceleration,
        steps_per_unit: options.steps_per_unit,
        clock: CLOCK,
    })?;
    let sampling = sampling_options(options);
    let mut pen = Pen { planner, listener, totals };
    for (path, p) in (0_u32..).zip(curve.paths) {
        pen.path(Resumable::new(curve, features, path, &sampling).map_err(Fault::Sampling)?, budget, p.closed)?;
    }
    Ok(pen.totals)
}

/// The motors with what feeds them.
struct Pen<'l, L> {
    planner: Planner,
    listener: &'l mut L,
    totals: Totals,
}

impl<L: Listener> Pen<'_, L> {
    /// Draws one path. While the planner has room the sampler is asked, for one bounded call at a time; while it has none
    /// the motors step. On a machine a timer interrupt takes the steps and the main loop does the rest.
    fn path(
        &mut self,
        mut sampler: Resumable<'_, f32, impl FeatureSize<f32>>,
        budget: u32,
        closed: bool,
    ) -> Result<(), Fault> {
        let mut first = None;
        // Every call gets on; the sampler's limit ends it.
        loop {
            self.listener.before();
            let step = sampler.step(budget);
            self.listener.after(Work::Sampler);
            self.totals.calls += 1;
            match step.map_err(Fault::Sampling)? {
                Step::Pending => {}
                Step::Done => break,
                Step::Sample(sample) => {
                    self.totals.samples += 1;
                    self.listener.sample(&sample);
                    let to = [sample.point.x, sample.point.y];
                    self.line(to)?;
                    if first.is_none() {
                        first = Some(to);
                        self.rest();
                        self.listener.pen(true);
                    }
                }
            }
        }
        if let Some(to) = first {
            if closed {
                self.line(to)?;
            }
            self.rest();
            self.listener.pen(false);
        }
        Ok(())
    }

    fn line(&mut self, to: [f32; 2]) -> Result<(), Fault> {
        while self.planner.is_full() && self.motor() {}
        self.listener.before();
        let taken = self.planner.line(to);
        self.listener.after(Work::Line);
        Ok(taken?)
    }

    /// Runs the planner empty.
    fn rest(&mut self) {
        self.planner.flush();
        while self.motor() {}
    }

    /// One motor step; false where there is none.
    fn motor(&mut self) -> bool {
        self.listener.before();
        let step = self.planner.step();
        self.listener.after(Work::Motor);
        let Some(step) = step else { return false };
        self.totals.steps += 1;
        self.listener.motor(step);
        true
    }
}

/// Reads the whole stream into the scratch memory.
fn read(
    bytes: impl Iterator<Item = u8>,
    cubics: &mut [Cubic<f32>],
    lengths: &mut SliceStore<'_, (u32, bool)>,
) -> Result<JobOptions, Fault> {
    let mut decoder = Decoder::new();
    let mut options = None;
    let (mut count, mut here) = (0_usize, Point::new(0.0, 0.0));
    for byte in bytes {
        let curve = match decoder.push(byte).map_err(Fault::Job)? {
            None => continue,
            // The stream of a serial line goes on: the job ends here.
            Some(Command::End) => break,
            Some(Command::Options(given)) => {
                options = Some(given);
                continue;
            }
            Some(Command::Begin { at: [x, y], closed }) => {
                here = Point::new(x, y);
                lengths.push((0, closed))?;
                continue;
            }
            // lfs for another kind of controller: η was measured for that one.
            Some(Command::Table { .. } | Command::Values(_)) => return Err(Fault::Job(JobError::Order)),
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
