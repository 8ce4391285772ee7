//! Tier 2: the controller that computes lfs.

use crate::stream::{Job, JobMemory, Lfs, index, read};
use crate::{Fault, Listener, Totals, Work, draw_paths};
use core::cell::Cell;
use feature_sampling::buffer::SliceStore;
use feature_sampling::curve::Curve;
use feature_sampling::curve::contact::{self, Contact};
use feature_sampling::curve::given::{self, Extent};
use feature_sampling::geometry::hierarchy::{Item, Node};
use feature_sampling::lfs::gather::Gather;
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
    extent: Extent<f32>,
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
    let extent = Extent::of(job.segments);
    given::finish(job.segments, job.arcs, LEAF, &mut SliceStore::new(items), &mut nodes)?;
    listener.after(Work::Curve);
    Ok(Received { job, nodes: nodes.into_items(), extent })
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
    let Received { job: Job { options, segments, columns, paths, arcs, .. }, nodes, extent } = received;
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
    let mut contacts = SliceStore::new(medial.contacts);
    for (segment, _) in (0_u32..).zip(curve.segments) {
        listener.before();
        contact::find(&curve, segment, &mut contacts)?;
        listener.after(Work::Contacts);
    }
    let contacts: &[Contact<f32>] = contacts.into_items();

    let cells = Cell::from_mut(values).as_slice_of_cells();
    let value = |k: u32| cells.get(k as usize).map_or(0, Cell::get);
    let set = |k: u32, v: f32| {
        if let Some(cell) = cells.get(k as usize) {
            cell.set(reduce(v));
        }
    };
    let access = (|k| expand(value(k)), set);
    let mut gather = Gather::new(&curve, columns, contacts, u32::from(options.foot_points), medial.most, access)?;
    // Every turn gets on; the last path ends it.
    loop {
        listener.before();
        let progress = gather.step(1);
        listener.after(Work::Foot);
        if progress == Progress::Done {
            break;
        }
    }
    let totals = Totals {
        segments: index(segments.len()),
        arcs: index(arcs.len()),
        medial: gather.taken(),
        values: places,
        ..Totals::default()
    };
    draw_paths(&curve, columns, value, options, budget, totals, listener)
}
