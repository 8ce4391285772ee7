//! Applications on top of the kernel.
