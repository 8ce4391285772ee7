//! Local feature size, medial polylines and ε-samples of Bézier line art.
#![cfg_attr(not(feature = "std"), no_std)]
#![forbid(unsafe_code)]

#[cfg(feature = "alloc")]
extern crate alloc;

pub mod bezier;
pub mod buffer;
pub mod curve;
pub mod geometry;
pub mod lfs;
pub mod medial;
#[cfg(feature = "alloc")]
pub mod model;
pub mod polynomial;
pub mod predicate;
pub mod sampling;
pub mod scalar;
