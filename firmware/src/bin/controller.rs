//! The controller on a Cortex-M: start-up, memory, and a semihosting channel in place of a serial line.
//!
//! The image reads `job.fsj` from the debugger's folder and writes one line a sample, all numbers as bits in hexadecimal.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(not(target_os = "none"))]
fn main() {}

#[cfg(target_os = "none")]
mod chip {
    use core::arch::{asm, global_asm};
    use core::mem::MaybeUninit;
    use feature_sampling::sampling::Sample;
    use plotter::*;

    // Stack pointer and reset vector; the other exceptions stop in one place.
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
        // The floating-point unit is switched on: full access to coprocessors 10 and 11.
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
    );

    /// One call of the debugger.
    fn semihost(operation: u32, argument: usize) -> usize {
        let mut answer = operation as usize;
        // SAFETY: the breakpoint 0xAB hands r0 and r1 to the debugger, which reads what r1 points to.
        unsafe { asm!("bkpt 0xAB", inout("r0") answer, in("r1") argument) };
        answer
    }

    fn write(text: &[u8]) {
        // SYS_WRITE to the console that is open as file 1.
        let block = [unsafe { CONSOLE }, text.as_ptr() as usize, text.len()];
        semihost(5, block.as_ptr() as usize);
    }

    static mut CONSOLE: usize = 0;

    fn line(tag: u8, numbers: &[u32]) {
        let mut text = [b' '; 96];
        let mut slots = text.iter_mut();
        let mut put = |c: u8| {
            if let Some(slot) = slots.next() {
                *slot = c;
            }
        };
        put(tag);
        for n in numbers {
            put(b' ');
            for digit in (0..8).rev() {
                let d = (n >> (4 * digit) & 15) as u8;
                put(if d < 10 { b'0' + d } else { b'a' + d - 10 });
            }
        }
        put(b'\n');
        let used = 2 + 9 * numbers.len();
        write(text.get(..used).unwrap_or_default());
    }

    /// SysTick counts down in 24 bits; QEMU's `-icount` makes it a count of instructions.
    const SYSTICK: *mut u32 = 0xE000_E010 as *mut u32;

    fn ticks() -> u32 {
        // SAFETY: the system timer's registers of every Cortex-M.
        unsafe { SYSTICK.add(2).read_volatile() }
    }

    struct Channel {
        from: u32,
        worst: u32,
        total: u64,
    }

    impl Listener for Channel {
        fn phase(&mut self, phase: u32) {
            line(b'p', &[phase, self.total as u32]);
        }
        fn before_step(&mut self) {
            self.from = ticks();
        }
        fn after_step(&mut self) {
            let spent = self.from.wrapping_sub(ticks()) & 0x00FF_FFFF;
            self.worst = self.worst.max(spent);
            self.total += u64::from(spent);
        }
        fn sample(&mut self, s: &Sample<f32>) {
            let [t, x, y, lfs] = [s.at.t, s.point.x, s.point.y, s.lfs].map(f32::to_bits);
            line(b's', &[s.path, s.at.segment, t, x, y, lfs, s.bound as u32]);
        }
    }

    /// Top of the stack, and how far down it is watched.
    const TOP: usize = 0x2040_0000;
    const WATCHED: usize = 0x4_0000;
    const PAINT: u32 = 0x5AFE_57AC;

    /// Paints the unused part of the stack.
    #[inline(never)]
    fn paint() {
        let here = 0_u32;
        let below = (&raw const here) as usize - 256;
        for at in (TOP - WATCHED..below).step_by(4) {
            // SAFETY: RAM below this frame and above the statics; nothing lives there.
            unsafe { (at as *mut u32).write_volatile(PAINT) };
        }
    }

    /// How deep the stack has been: bytes from its top to the lowest word that lost its paint.
    #[inline(never)]
    fn depth() -> u32 {
        let lost = (TOP - WATCHED..TOP).step_by(4).find(|at| {
            // SAFETY: RAM.
            unsafe { (*at as *const u32).read_volatile() != PAINT }
        });
        (TOP - lost.unwrap_or(TOP)) as u32
    }

    macro_rules! lent {
        ($kind:ty, $count:expr) => {{
            static mut SLOTS: MaybeUninit<[$kind; $count]> = MaybeUninit::uninit();
            // SAFETY: this runs once, before anything else; every slot is written before the slice is made.
            unsafe {
                let first = (&raw mut SLOTS).cast::<$kind>();
                for i in 0..$count {
                    first.add(i).write(<$kind>::default());
                }
                core::slice::from_raw_parts_mut(first, $count)
            }
        }};
    }

    #[unsafe(no_mangle)]
    extern "C" fn start() -> ! {
        // SYS_OPEN ":tt" for writing is the console; "job.fsj" for reading binary.
        let console = [b":tt\0".as_ptr() as usize, 4, 3];
        // SAFETY: nothing else runs yet.
        unsafe { CONSOLE = semihost(1, console.as_ptr() as usize) };
        let job = [b"job.fsj\0".as_ptr() as usize, 1, 7];
        let file = semihost(1, job.as_ptr() as usize);
        // SAFETY: the system timer's registers: largest reload, processor clock, no interrupt.
        unsafe {
            SYSTICK.add(1).write_volatile(0x00FF_FFFF);
            SYSTICK.add(2).write_volatile(0);
            SYSTICK.write_volatile(5);
        }
        let bytes = core::iter::from_fn(|| {
            let mut byte = 0_u8;
            let block = [file, (&raw mut byte) as usize, 1];
            // SYS_READ answers how many bytes were not read.
            let left = semihost(6, block.as_ptr() as usize);
            // SAFETY: the debugger wrote to the byte behind the compiler's back.
            (left == 0).then(|| unsafe { (&raw const byte).read_volatile() })
        });
        let mut arena = Arena {
            cubics: lent!(feature_sampling::bezier::Cubic<f32>, CUBICS),
            lengths: lent!((usize, bool), PATHS),
            segments: lent!(feature_sampling::curve::Segment<f32>, SEGMENTS),
            paths: lent!(feature_sampling::curve::Path, PATHS),
            arcs: lent!(feature_sampling::curve::Arc<f32>, ARCS),
            nodes: lent!(feature_sampling::geometry::hierarchy::Node<f32>, ARC_NODES),
            items: lent!(feature_sampling::geometry::hierarchy::Item<f32>, ARCS),
            order: lent!(u32, ORDER),
            contacts: lent!(feature_sampling::curve::contact::Contact<f32>, CONTACTS),
            medial: lent!(feature_sampling::medial::MedialPoint<f32>, MEDIAL),
            medial_items: lent!(feature_sampling::geometry::hierarchy::Item<f32>, MEDIAL_ITEMS),
            medial_nodes: lent!(feature_sampling::geometry::hierarchy::Node<f32>, MEDIAL_NODES),
        };
        let mut channel = Channel { from: 0, worst: 0, total: 0 };
        paint();
        match run(bytes, 8, &mut arena, &mut channel) {
            Ok(t) => line(
                b'e',
                &[t.samples, t.calls, t.medial as u32, t.arcs as u32, channel.worst, channel.total as u32, depth()],
            ),
            Err(fault) => line(
                b'f',
                &[match fault {
                    Fault::Job(_) => 1,
                    Fault::Memory => 2,
                    Fault::Curve => 3,
                    Fault::Sampling(_) => 4,
                }],
            ),
        }
        // SYS_EXIT, application exit.
        semihost(0x18, 0x20026);
        loop {}
    }

    #[panic_handler]
    fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
        write(b"panic\n");
        semihost(0x18, 0x20024);
        loop {}
    }
}
