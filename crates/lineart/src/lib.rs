//! Applications on top of the kernel.

pub mod delaunay;
pub mod drawing;
pub mod export;
pub mod flatten;
pub mod stretch;
