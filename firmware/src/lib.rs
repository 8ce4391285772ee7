//! The controller: it takes a job byte by byte, holds it in lent memory, computes lfs on the chip in f32, and draws: samples
//! through the resumable sampler, motor steps through the planner.
//!
//! The same code runs on the chip (`src/bin/controller.rs`) and on the host (`src/bin/host.rs`); the kernel uses only
//! + − × ÷ √ and comparisons, so both give the same samples and the same steps to the bit.
//!
//! A job ([`stream`]) is the curve as its host's door made it, with places along it where lfs is to be known. A controller
//! that computes lfs ([`own`]) walks around the medial axis once and lets every edge of it lower the values of the places
//! that it is nearer to; one that gets lfs from its host ([`table`]) reads them. Both then sample from the same table, with
//! the same code. Every loop is bounded by the job; every failure is a [`Fault`], after which the next job can be received.
#![no_std]
#![deny(unsafe_code)]

#[allow(unsafe_code, reason = "each use is explained there")]
pub mod memory;
pub mod own;
pub mod stream;
pub mod table;

use feature_sampling::buffer::BufferFull;
use feature_sampling::curve::Curve;
use feature_sampling::geometry::hierarchy::nodes_for;
use feature_sampling::lfs::FeatureSize;
use feature_sampling::lfs::table::{Column, LfsTable};
use feature_sampling::sampling::resumable::{Resumable, Step};
use feature_sampling::sampling::{Condition, Sample, SamplingError, SamplingOptions};
use fsample_job::{JobError, JobOptions, LEAF, expand};
use fsample_planner::{Limits, MotorStep, PlanError, Planner};

/// Cubics that a job may have: those of the curve that its host's door made.
pub const CUBICS: usize = 200;
/// Paths that a job may have.
pub const PATHS: usize = 72;
/// Arcs.
pub const ARCS: usize = 6 * CUBICS;
/// Leaves of the hierarchy over the arcs.
pub const LEAVES: usize = ARCS.div_ceil(LEAF as usize);
/// Its nodes.
pub const NODES: usize = nodes_for(LEAVES);
/// Places where the job touches itself.
pub const CONTACTS: usize = 160;
/// Places along the job's cubics where lfs is known.
pub const VALUES: usize = 20 * CUBICS;

/// Ticks a second of the timer that times motor steps.
pub const CLOCK: f32 = 84_000_000.0;

/// What went wrong with a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The stream is no job.
    Job(JobError),
    /// More cubics, paths, arcs, touchings or places than there is memory for.
    Memory,
    /// The job draws nothing.
    Empty,
    /// All its points coincide.
    NoExtent,
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
            Self::Empty => 0x301,
            Self::NoExtent => 0x302,
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

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// A turn of the medial walk: mostly a foot point with its disk, and the places that its edge is near to.
    Foot,
    /// A call of the sampler.
    Sampler,
    /// A motor step of the planner.
    Motor,
    /// A line added to the planner.
    Line,
    /// The touchings of one segment.
    Contacts,
    /// Joints, strands and the hierarchy, once the whole curve is there.
    Curve,
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
    /// Medial points; none where the host has computed lfs.
    pub medial: u32,
    /// Places where lfs is known.
    pub values: u32,
    /// Samples.
    pub samples: u32,
    /// Calls of the sampler.
    pub calls: u32,
    /// Motor steps.
    pub steps: u32,
}

/// The bounds of a job.
#[must_use]
pub fn sampling_options(options: &JobOptions) -> SamplingOptions<f32> {
    let some = |v: f32| (v > 0.0).then_some(v);
    SamplingOptions {
        condition: Condition::Epsilon(options.epsilon),
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

/// Draws all paths of a curve. Not inlined, so that its memory is needed while it draws only. `value` is the list of all values of lfs, which are divided by 1 + η.
#[inline(never)]
fn draw_paths(
    curve: &Curve<'_, f32>,
    columns: &[Column],
    value: impl Fn(u32) -> u16,
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
    let share = 1.0 / (1.0 + options.eta);
    let features = LfsTable::new(curve, columns, |k| expand(value(k)) * share);
    let mut pen = Pen { planner, listener, totals };
    for (path, p) in (0_u32..).zip(curve.paths) {
        pen.path(Resumable::new(curve, &features, path, &sampling).map_err(Fault::Sampling)?, budget, p.closed)?;
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
