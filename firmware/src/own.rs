//! Tier 2: the controller that computes lfs.

use crate::stream::{Job, JobMemory, Lfs, index, read};
use crate::{Fault, Listener, Totals, Work, draw_paths};
use core::cell::Cell;
use feature_sampling::buffer::SliceStore;
use feature_sampling::curve::Curve;
use feature_sampling::curve::contact::{self, Contact};
use feature_sampling::curve::given;
use feature_sampling::geometry::hierarchy::{Item, Node};
use feature_sampling::lfs::gather::Gather;
use feature_sampling::lfs::table::Column;
use feature_sampling::medial::uniform::Progress;
use fsample_job::{LEAF, expand, reduce};

/// Memory for lfs.
#[derive(Debug)]
pub struct MedialMemory<'a> {
    /// [`CONTACTS`](crate::CONTACTS).
    pub contacts: &'a mut [Contact<f32>],
    /// [`VALUES`](crate::VALUES).
    pub values: &'a mut [u16],
    /// [`NODES`](crate::NODES).
    pub most: &'a mut [f32],
}

/// A job whose curve is ready.
#[derive(Debug)]
pub struct Received<'a> {
    job: Job<'a>,
    nodes: &'a [Node<f32>],
}

/// Reads a whole job and makes its curve. `nodes` are [`NODES`](crate::NODES); `items`, [`LEAVES`](crate::LEAVES), are free
/// afterwards.
///
/// # Errors
/// See [`Fault`]. The memory is then of no use, and free for the next job.
pub fn receive<'a>(
    bytes: impl Iterator<Item = u8>,
    memory: JobMemory<'a>,
    nodes: &'a mut [Node<f32>],
    items: &mut [Item<f32>],
    listener: &mut impl Listener,
) -> Result<Received<'a>, Fault> {
    let job = read(bytes, memory, Lfs::Own)?;
    let mut nodes = SliceStore::new(nodes);
    listener.before();
    given::finish(job.segments, job.arcs, LEAF, &mut SliceStore::new(items), &mut nodes)?;
    listener.after(Work::Curve);
    Ok(Received { job, nodes: nodes.into_items() })
}

/// Computes lfs of a received job and draws it. `budget` is the number of turns of a call of the sampler.
///
/// # Errors
/// See [`Fault`].
pub fn draw(
    received: &Received<'_>,
    medial: MedialMemory<'_>,
    budget: u32,
    listener: &mut impl Listener,
) -> Result<Totals, Fault> {
    let Received { job: Job { options, segments, columns, paths, arcs, extent, .. }, nodes } = received;
    let curve = Curve {
        segments,
        sources: &[],
        paths,
        arcs,
        nodes,
        leaf: LEAF,
        diagonal: &extent.diagonal,
        noise: &extent.noise,
    };
    let places = received.job.places();
    let values = medial.values.get_mut(..places as usize).ok_or(Fault::Memory)?;
    let cells = Cell::from_mut(values).as_slice_of_cells();
    let points =
        feature_size(&curve, columns, cells, u32::from(options.foot_points), medial.contacts, medial.most, listener)?;
    let totals = Totals {
        segments: index(segments.len()),
        arcs: index(arcs.len()),
        medial: points,
        values: places,
        ..Totals::default()
    };
    let value = |k: u32| cells.get(k as usize).map_or(0, Cell::get);
    draw_paths(&curve, columns, value, options, budget, totals, listener)
}

/// Computes the values of lfs of a curve; how many medial points it took. Not inlined, so that its memory is free afterwards.
#[inline(never)]
fn feature_size(
    curve: &Curve<'_, f32>,
    columns: &[Column],
    values: &[Cell<u16>],
    foot_points: u32,
    contacts: &mut [Contact<f32>],
    most: &mut [f32],
    listener: &mut impl Listener,
) -> Result<u32, Fault> {
    let mut found = SliceStore::new(contacts);
    for (segment, _) in (0_u32..).zip(curve.segments) {
        listener.before();
        contact::find(curve, segment, &mut found)?;
        listener.after(Work::Contacts);
    }
    let get = |k: u32| values.get(k as usize).map_or(0.0, |value| expand(value.get()));
    let set = |k: u32, v: f32| {
        if let Some(value) = values.get(k as usize) {
            value.set(reduce(v));
        }
    };
    let mut gather = Gather::new(curve, columns, found.into_items(), foot_points, most, (get, set));
    // Every turn gets on; the last path ends it.
    loop {
        listener.before();
        let progress = gather.step(1);
        listener.after(Work::Foot);
        if progress == Progress::Done {
            return Ok(gather.taken());
        }
    }
}
