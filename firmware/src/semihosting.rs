//! The controller with a debugger: a semihosting channel stands in for the serial line and for the pen. Included by the
//! programs in `bin`.
//!
//! It runs `job0.fsj`, `job1.fsj` and so on from the debugger's folder, until there is none. It prints a line a sample, all
//! numbers as bits in hexadecimal; after each job a line of totals, or of the fault. The steps of the motors go to
//! `pen0.bin` and so on: a word a step, times 16 the ticks since the step before, plus 1, 2, 4, 8 for +x, −x, +y, −y; the
//! words 0 and 1 lift and lower the pen.

use super::board;
use core::arch::asm;
use feature_sampling::sampling::Sample;
use fsample_planner::MotorStep;
use plotter::*;

/// One call of the debugger.
fn semihost(operation: u32, argument: usize) -> usize {
    let mut answer = operation as usize;
    // SAFETY: the breakpoint 0xAB hands r0 and r1 to the debugger, which reads and writes what r1 points to.
    unsafe { asm!("bkpt 0xAB", inout("r0") answer, in("r1") argument) };
    answer
}

/// SYS_OPEN; all ones where there is no such file. `mode` is that of C's fopen by its number: 1 rb, 4 w, 5 wb.
fn open(name: &[u8], mode: usize) -> usize {
    let block = [name.as_ptr() as usize, mode, name.len() - 1];
    semihost(1, block.as_ptr() as usize)
}

fn close(file: usize) {
    semihost(2, (&raw const file) as usize);
}

fn write(file: usize, data: *const u8, len: usize) {
    let block = [file, data as usize, len];
    semihost(5, block.as_ptr() as usize);
}

/// SysTick counts down in 24 bits; QEMU's `-icount` makes it a count of instructions.
const SYSTICK: *mut u32 = 0xE000_E010 as *mut u32;

fn ticks() -> u32 {
    // SAFETY: the system timer's registers of every Cortex-M.
    unsafe { SYSTICK.add(2).read_volatile() }
}

/// Words that are written to the pen's file at once.
const WORDS: usize = 64;

struct Channel {
    console: usize,
    pen: usize,
    words: [u32; WORDS],
    used: usize,
    from: u32,
    /// Longest and all ticks of each kind of work.
    worst: [u32; Work::KINDS],
    total: [u32; Work::KINDS],
}

impl Channel {
    fn line(&self, tag: u8, numbers: &[u32]) {
        let mut text = [b' '; 160];
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
        write(self.console, text.as_ptr(), (2 + 9 * numbers.len()).min(text.len()));
    }

    fn put(&mut self, word: u32) {
        if let Some(slot) = self.words.get_mut(self.used) {
            *slot = word;
            self.used += 1;
        }
        if self.used == WORDS {
            self.flush();
        }
    }

    fn flush(&mut self) {
        write(self.pen, self.words.as_ptr().cast(), 4 * self.used);
        self.used = 0;
    }
}

impl Listener for Channel {
    fn before(&mut self) {
        self.from = ticks();
    }
    fn after(&mut self, work: Work) {
        let spent = self.from.wrapping_sub(ticks()) & 0x00FF_FFFF;
        if let (Some(worst), Some(total)) = (self.worst.get_mut(work as usize), self.total.get_mut(work as usize)) {
            *worst = spent.max(*worst);
            *total = total.wrapping_add(spent);
        }
    }
    fn sample(&mut self, s: &Sample<f32>) {
        let [t, x, y, lfs] = [s.at.t, s.point.x, s.point.y, s.lfs].map(f32::to_bits);
        self.line(b's', &[s.path, s.at.segment, t, x, y, lfs, s.bound as u32]);
    }
    fn pen(&mut self, down: bool) {
        self.put(u32::from(down));
    }
    fn motor(&mut self, step: MotorStep) {
        self.put(step.word());
    }
}

unsafe extern "C" {
    /// Where the stack begins: a symbol of the linker's script.
    static _stack_top: u8;
}

/// Top of the stack.
fn top() -> usize {
    (&raw const _stack_top) as usize
}

/// How far down the stack is watched.
const WATCHED: usize = 0x1_0000;
const PAINT: u32 = 0x5AFE_57AC;

/// Paints the unused part of the stack.
#[inline(never)]
fn paint() {
    let here = 0_u32;
    let below = (&raw const here) as usize - 256;
    for at in (top() - WATCHED..below).step_by(4) {
        // SAFETY: RAM below this frame and above the statics; nothing lives there.
        unsafe { (at as *mut u32).write_volatile(PAINT) };
    }
}

/// How deep the stack has been: bytes from its top to the lowest word that lost its paint.
#[inline(never)]
fn depth() -> u32 {
    let lost = (top() - WATCHED..top()).step_by(4).find(|at| {
        // SAFETY: RAM.
        unsafe { (*at as *const u32).read_volatile() != PAINT }
    });
    (top() - lost.unwrap_or_else(top)) as u32
}

#[unsafe(no_mangle)]
extern "C" fn start() -> ! {
    let console = open(b":tt\0", 4);
    // SAFETY: the system timer's registers: largest reload, processor clock, no interrupt.
    unsafe {
        SYSTICK.add(1).write_volatile(0x00FF_FFFF);
        SYSTICK.add(2).write_volatile(0);
        SYSTICK.write_volatile(5);
    }
    let (mut job, mut pen) = (*b"job0.fsj\0", *b"pen0.bin\0");
    loop {
        let file = open(&job, 1);
        if file == usize::MAX {
            break;
        }
        let pen_file = open(&pen, 5);
        let bytes = core::iter::from_fn(|| {
            let mut byte = 0_u8;
            let block = [file, (&raw mut byte) as usize, 1];
            // SYS_READ answers how many bytes were not read.
            let left = semihost(6, block.as_ptr() as usize);
            // SAFETY: the debugger wrote to the byte behind the compiler's back.
            (left == 0).then(|| unsafe { (&raw const byte).read_volatile() })
        });
        let mut channel = Channel {
            console,
            pen: pen_file,
            words: [0; WORDS],
            used: 0,
            from: 0,
            worst: [0; Work::KINDS],
            total: [0; Work::KINDS],
        };
        paint();
        // SAFETY: the only call.
        let done = unsafe { board::job(bytes, TURNS, &mut channel) };
        let deep = depth();
        channel.flush();
        match done {
            Ok(t) => {
                channel.line(b'e', &[t.segments, t.arcs, t.medial, t.values, t.samples, t.calls, t.steps]);
                channel.line(b'w', &channel.worst);
                channel.line(b't', &channel.total);
                channel.line(b'm', &[deep, board::BYTES as u32]);
            }
            Err(fault) => channel.line(b'f', &[fault.code()]),
        }
        close(pen_file);
        close(file);
        job[3] += 1;
        pen[3] += 1;
    }
    // SYS_EXIT, application exit.
    semihost(0x18, 0x20026);
    loop {}
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    semihost(0x18, 0x20024);
    loop {}
}
