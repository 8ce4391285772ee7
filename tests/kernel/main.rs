//! The kernel, asked from outside: a module for each promise.
//!
//! One program, because the kernel is generic: each test program would compile it again for the scalars it asks about, and the
//! compiler's time would go up more than tenfold. `cargo test --test kernel true_samples::` runs one module.

mod bounds;
mod certificate;
mod common;
mod contacts;
mod core_only;
mod disks;
mod empty_disks;
mod enclosures;
mod gather;
mod interval;
mod lfs_shapes;
mod lfs_table;
mod nearest;
mod polynomial;
mod predicates;
mod properties;
mod resumable;
mod true_samples;
mod truth;
mod uniform;
