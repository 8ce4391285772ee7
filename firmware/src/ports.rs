//! The controller without a debugger, for a measurement of its size: bytes come from, and steps and faults go to, fixed
//! addresses, as with the registers of a serial line and of two stepper drivers. Included by the programs in `bin`.

use super::board;
use feature_sampling::sampling::Sample;
use fsample_planner::MotorStep;
use plotter::*;

const PORT: *mut u32 = 0x4000_4000 as *mut u32;

fn put(word: u32) {
    // SAFETY: a device's register.
    unsafe { PORT.write_volatile(word) };
}

struct Motors;

impl Listener for Motors {
    fn before(&mut self) {}
    fn after(&mut self, _: Work) {}
    fn sample(&mut self, _: &Sample<f32>) {}
    fn pen(&mut self, down: bool) {
        put(u32::from(down));
    }
    fn motor(&mut self, step: MotorStep) {
        put(step.after);
        put(u32::from(step.x as u8) << 8 | u32::from(step.y as u8));
    }
}

#[unsafe(no_mangle)]
extern "C" fn start() -> ! {
    // SAFETY: a device's register.
    let mut bytes = core::iter::from_fn(|| Some(unsafe { PORT.read_volatile() } as u8));
    loop {
        // SAFETY: the only call.
        let done = unsafe { board::job(&mut bytes, TURNS, &mut Motors) };
        put(done.map_or_else(|fault| fault.code(), |_| 0));
    }
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
