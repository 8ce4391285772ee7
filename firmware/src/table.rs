//! Tier 1: the controller of a job that brings its lfs along. It has no medial axis.

use crate::stream::{Job, JobMemory, Lfs, index, read};
use crate::{Fault, Listener, Totals, draw_paths};
use feature_sampling::curve::Curve;

/// Reads a whole job.
///
/// # Errors
/// See [`Fault`]; a job without lfs along every cubic is out of order.
pub fn receive(bytes: impl Iterator<Item = u8>, memory: JobMemory<'_>) -> Result<Job<'_>, Fault> {
    read(bytes, memory, Lfs::Given)
}

/// Draws a job that has been read. `budget` is the number of turns of a call of the sampler.
///
/// # Errors
/// See [`Fault`].
pub fn draw(job: &Job<'_>, budget: u32, listener: &mut impl Listener) -> Result<Totals, Fault> {
    let Job { options, segments, columns, paths, values, extent, .. } = job;
    let curve = Curve {
        segments,
        sources: &[],
        paths,
        arcs: &[],
        nodes: &[],
        leaf: 1,
        diagonal: &extent.diagonal,
        noise: &extent.noise,
    };
    let value = |k: u32| values.get(k as usize).copied().unwrap_or(0);
    let totals = Totals { segments: index(segments.len()), values: job.places(), ..Totals::default() };
    draw_paths(&curve, columns, value, options, budget, totals, listener)
}
