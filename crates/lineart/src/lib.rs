//! Applications on top of the kernel.

pub mod colour;
pub mod csv_in;
pub mod delaunay;
pub mod drawing;
pub mod export;
pub mod flatten;
pub mod mesh;
pub mod node;
pub mod reconstruct;
pub mod simulate;
pub mod stretch;
pub mod svg;
pub mod text_in;
pub mod units;
