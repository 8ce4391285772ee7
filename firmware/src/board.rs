//! What every image needs: vectors, start-up, and memory. Included by the programs in `bin`, which name the kind of memory.

use super::Memory;
use core::arch::global_asm;
use core::mem::MaybeUninit;
use plotter::{Fault, Listener, Totals};

// Stack pointer and reset vector; the other exceptions stop in one place. Where there is a floating-point unit it is switched
// on: full access to coprocessors 10 and 11. Elsewhere the register is reserved and the write is ignored.
global_asm!(
    ".section .vectors, \"a\"",
    ".word _stack_top",
    ".word reset + 1",
    ".rept 14",
    ".word hang + 1",
    ".endr",
    ".text",
    ".thumb_func",
    ".global reset",
    "reset:",
    "ldr r0, =0xE000ED88",
    "ldr r1, [r0]",
    "ldr r2, =0x00F00000",
    "orrs r1, r2",
    "str r1, [r0]",
    "dsb",
    "isb",
    "bl start",
    ".thumb_func",
    "hang:",
    "b hang",
    ".ltorg",
);

static mut MEMORY: MaybeUninit<Memory> = MaybeUninit::uninit();

/// Bytes of static memory for a job, without the stack.
#[allow(dead_code, reason = "not every image prints it")]
pub const BYTES: usize = size_of::<Memory>();

/// Receives one job and draws it.
///
/// # Safety
/// Never called while another call runs: an image has one main loop.
pub unsafe fn job(bytes: impl Iterator<Item = u8>, budget: u32, listener: &mut impl Listener) -> Result<Totals, Fault> {
    // SAFETY: `Memory` asks nothing of its bytes, and the caller promises that nothing else uses them.
    unsafe { &mut *(&raw mut MEMORY).cast::<Memory>() }.run(bytes, budget, listener)
}
