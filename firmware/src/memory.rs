//! The one place of the controller's library with `unsafe`: memory for a job as one block, of which a part is used twice.

use crate::own::{self, MedialMemory};
use crate::stream::JobMemory;
use crate::{ARCS, CONTACTS, CUBICS, Fault, LEAVES, Listener, NODES, PATHS, Totals, VALUES, table};
use core::mem::{ManuallyDrop, MaybeUninit};
use feature_sampling::curve::contact::Contact;
use feature_sampling::curve::{ArcStart, Path, Segment};
use feature_sampling::geometry::hierarchy::{Item, Node};
use feature_sampling::lfs::table::Column;

/// The same bytes, first while the hierarchy is built and then for the values.
union Phase {
    #[allow(dead_code, reason = "its size and place are used")]
    items: ManuallyDrop<[Item<f32>; LEAVES]>,
    #[allow(dead_code, reason = "its size and place are used")]
    values: ManuallyDrop<[u16; VALUES]>,
}

/// What a job keeps whose lfs is computed here.
struct Own {
    segments: [Segment<f32>; CUBICS],
    columns: [Column; CUBICS],
    paths: [Path; PATHS],
    arcs: [ArcStart<f32>; ARCS],
    nodes: [Node<f32>; NODES],
    most: [f32; NODES],
    contacts: [Contact<f32>; CONTACTS],
    phase: Phase,
}

/// Memory for one job.
#[derive(Debug)]
pub struct Memory(MaybeUninit<Own>);

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
        // SAFETY: places inside memory that is borrowed for as long as this runs; each field is lent once. The slice of the
        // union's first half is gone when that of its second is made: `receive` answers with nothing that borrows it.
        unsafe {
            let job = JobMemory {
                segments: fresh(&raw mut (*all).segments),
                columns: fresh(&raw mut (*all).columns),
                paths: fresh(&raw mut (*all).paths),
                arcs: fresh(&raw mut (*all).arcs),
                values: &mut [],
            };
            let phase = &raw mut (*all).phase;
            let items = fresh(phase.cast::<[Item<f32>; LEAVES]>());
            let received = own::receive(bytes, job, fresh(&raw mut (*all).nodes), items, listener)?;
            let medial = MedialMemory {
                contacts: fresh(&raw mut (*all).contacts),
                values: fresh(phase.cast::<[u16; VALUES]>()),
                most: fresh(&raw mut (*all).most),
            };
            own::draw(&received, medial, budget, listener)
        }
    }
}

impl Default for Memory {
    fn default() -> Self {
        Self::new()
    }
}

/// Memory for one job that brings its lfs along.
#[derive(Debug)]
pub struct TableMemory(MaybeUninit<Given>);

/// What such a job keeps.
struct Given {
    segments: [Segment<f32>; CUBICS],
    columns: [Column; CUBICS],
    paths: [Path; PATHS],
    values: [u16; VALUES],
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
            JobMemory {
                segments: fresh(&raw mut (*all).segments),
                columns: fresh(&raw mut (*all).columns),
                paths: fresh(&raw mut (*all).paths),
                arcs: &mut [],
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
