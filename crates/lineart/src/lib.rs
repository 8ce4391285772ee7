//! Applications on top of the kernel.

pub mod drawing;
