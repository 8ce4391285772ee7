//! The controller of jobs that bring their lfs along (tier 1) on a Cortex-M in QEMU.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(not(target_os = "none"))]
fn main() {}

#[cfg(target_os = "none")]
use plotter::memory::TableMemory as Memory;

#[cfg(target_os = "none")]
#[path = "../board.rs"]
mod board;

#[cfg(target_os = "none")]
#[path = "../semihosting.rs"]
mod semihosting;
