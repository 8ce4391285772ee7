//! The one place of the controller's library with `unsafe`: memory for a job as one block that is used twice.
//!
//! What a job needs while it is received and what it needs while it is drawn may be the same bytes, beside those of the curve.

use crate::{
    ARCS, Arc, BLOCKS, BOXES, Block, CONTACTS, CUBICS, Contact, Cubic, CurveMemory, Fault, Item, LEAVES, Listener,
    MedialMemory, NODES, Node, ORDER, PATHS, Path, SEGMENTS, Scratch, Segment, Totals, draw, receive, table,
};
use core::mem::{ManuallyDrop, MaybeUninit};
use feature_sampling::geometry::Aabb;
use feature_sampling::lfs::table::Column;

/// Memory of the curve, alive through the whole job.
struct Lasting {
    segments: [Segment<f32>; SEGMENTS],
    paths: [Path; PATHS],
    arcs: [Arc<f32>; ARCS],
    nodes: [Node<f32>; NODES],
}

/// Memory while a job is received.
struct Receiving {
    cubics: [Cubic<f32>; CUBICS],
    lengths: [(u32, bool); PATHS],
    items: [Item<f32>; LEAVES],
    order: [u32; ORDER],
}

/// Memory while it is drawn.
struct Drawing {
    contacts: [Contact<f32>; CONTACTS],
    blocks: [Block<f32>; BLOCKS],
    boxes: [Aabb<f32>; BOXES],
}

/// The same bytes, first for the one and then for the other.
union Phase {
    #[allow(dead_code, reason = "its size and place are used")]
    receiving: ManuallyDrop<Receiving>,
    #[allow(dead_code, reason = "its size and place are used")]
    drawing: ManuallyDrop<Drawing>,
}

/// Memory for one job.
#[derive(Debug)]
pub struct Memory(MaybeUninit<(Lasting, Phase)>);

impl Memory {
    /// Nothing is written before a job runs.
    #[must_use]
    pub const fn new() -> Self {
        Self(MaybeUninit::uninit())
    }

    /// Receives one job and draws it.
    ///
    /// # Errors
    /// See [`Fault`].
    pub fn run(
        &mut self,
        bytes: impl Iterator<Item = u8>,
        budget: u32,
        listener: &mut impl Listener,
    ) -> Result<Totals, Fault> {
        let all = self.0.as_mut_ptr();
        // SAFETY: places inside memory that is borrowed for as long as this runs; each field is lent once. The slices of the
        // union's first half are gone when those of its second are made: `receive` answers with nothing that borrows them.
        unsafe {
            let (lasting, phase) = (&raw mut (*all).0, &raw mut (*all).1);
            let mut curve = CurveMemory {
                segments: fresh(&raw mut (*lasting).segments),
                paths: fresh(&raw mut (*lasting).paths),
                arcs: fresh(&raw mut (*lasting).arcs),
                nodes: fresh(&raw mut (*lasting).nodes),
            };
            let receiving = phase.cast::<Receiving>();
            let scratch = Scratch {
                cubics: fresh(&raw mut (*receiving).cubics),
                lengths: fresh(&raw mut (*receiving).lengths),
                items: fresh(&raw mut (*receiving).items),
                order: fresh(&raw mut (*receiving).order),
            };
            let received = receive(bytes, &mut curve, scratch)?;
            let drawing = phase.cast::<Drawing>();
            let medial = MedialMemory {
                contacts: fresh(&raw mut (*drawing).contacts),
                blocks: fresh(&raw mut (*drawing).blocks),
                boxes: fresh(&raw mut (*drawing).boxes),
            };
            draw(&received, &curve, medial, budget, listener)
        }
    }
}

impl Default for Memory {
    fn default() -> Self {
        Self::new()
    }
}

/// Memory for one job that brings its lfs along ([`table`]).
#[derive(Debug)]
pub struct TableMemory(MaybeUninit<Given>);

/// What such a job keeps.
struct Given {
    segments: [Segment<f32>; SEGMENTS],
    columns: [Column; SEGMENTS],
    paths: [Path; PATHS],
    values: [u16; table::VALUES],
}

impl TableMemory {
    /// Nothing is written before a job runs.
    #[must_use]
    pub const fn new() -> Self {
        Self(MaybeUninit::uninit())
    }

    /// Receives one job and draws it.
    ///
    /// # Errors
    /// See [`Fault`].
    pub fn run(
        &mut self,
        bytes: impl Iterator<Item = u8>,
        budget: u32,
        listener: &mut impl Listener,
    ) -> Result<Totals, Fault> {
        let all = self.0.as_mut_ptr();
        // SAFETY: places inside memory that is borrowed for as long as this runs; each field is lent once.
        let memory = unsafe {
            table::TableMemory {
                segments: fresh(&raw mut (*all).segments),
                columns: fresh(&raw mut (*all).columns),
                paths: fresh(&raw mut (*all).paths),
                values: fresh(&raw mut (*all).values),
            }
        };
        table::draw(&table::receive(bytes, memory)?, budget, listener)
    }
}

impl Default for TableMemory {
    fn default() -> Self {
        Self::new()
    }
}

/// Writes the default into every slot of an array.
///
/// # Safety
/// The pointer is valid for writes of the whole array, and nothing else refers to it while the slice is alive.
unsafe fn fresh<'a, T: Default, const N: usize>(first: *mut [T; N]) -> &'a mut [T] {
    let first = first.cast::<T>();
    for i in 0..N {
        // SAFETY: inside the array.
        unsafe { first.add(i).write(T::default()) };
    }
    // SAFETY: every slot has been written; the caller answers for the rest.
    unsafe { core::slice::from_raw_parts_mut(first, N) }
}
