//! Local feature size, medial polylines and ε-samples of Bézier line art.
#![cfg_attr(not(feature = "std"), no_std)]
#![forbid(unsafe_code)]

#[cfg(feature = "alloc")]
extern crate alloc;

pub mod bezier;
pub mod geometry;
pub mod scalar;
