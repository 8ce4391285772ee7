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

// Copying and filling, in place of the compiler's own functions, which take ten times the flash: words where both ends are
// aligned, else bytes. The stack is as the procedure call standard wants it; Thumb-1 suffices.
global_asm!(
    ".section .text.memmove, \"ax\"",
    ".irp name, memmove, __aeabi_memmove, __aeabi_memmove4, __aeabi_memmove8",
    ".thumb_func",
    ".global \\name",
    "\\name:",
    ".endr",
    "cmp r0, r1",
    "bls 2f",
    "1: subs r2, #1",
    "bcc 6f",
    "ldrb r3, [r1, r2]",
    "strb r3, [r0, r2]",
    "b 1b",
    ".irp name, memcpy, __aeabi_memcpy, __aeabi_memcpy4, __aeabi_memcpy8",
    ".thumb_func",
    ".global \\name",
    "\\name:",
    ".endr",
    "2: push {{r0, r4}}",
    "movs r3, r0",
    "orrs r3, r1",
    "lsls r3, r3, #30",
    "bne 4f",
    "3: subs r2, #4",
    "bcc 7f",
    "ldmia r1!, {{r4}}",
    "stmia r0!, {{r4}}",
    "b 3b",
    "7: adds r2, #4",
    "4: subs r2, #1",
    "bcc 5f",
    "ldrb r4, [r1]",
    "strb r4, [r0]",
    "adds r1, #1",
    "adds r0, #1",
    "b 4b",
    "5: pop {{r0, r4}}",
    "6: bx lr",
    ".section .text.memset, \"ax\"",
    ".irp name, __aeabi_memclr, __aeabi_memclr4, __aeabi_memclr8",
    ".thumb_func",
    ".global \\name",
    "\\name:",
    ".endr",
    "movs r2, #0",
    ".irp name, __aeabi_memset, __aeabi_memset4, __aeabi_memset8",
    ".thumb_func",
    ".global \\name",
    "\\name:",
    ".endr",
    "movs r3, r1",
    "movs r1, r2",
    "movs r2, r3",
    ".thumb_func",
    ".global memset",
    "memset:",
    "push {{r0, r4}}",
    "uxtb r1, r1",
    "lsls r3, r1, #8",
    "orrs r1, r3",
    "lsls r3, r1, #16",
    "orrs r1, r3",
    "lsls r3, r0, #30",
    "bne 4f",
    "3: subs r2, #4",
    "bcc 7f",
    "stmia r0!, {{r1}}",
    "b 3b",
    "7: adds r2, #4",
    "4: subs r2, #1",
    "bcc 5f",
    "strb r1, [r0]",
    "adds r0, #1",
    "b 4b",
    "5: pop {{r0, r4}}",
    "bx lr",
    ".text",
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
