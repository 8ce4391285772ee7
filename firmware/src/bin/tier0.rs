//! The smallest image: decodes a job and flattens each cubic within the chord error, for a measurement of its size. Bytes
//! come from, and points go to, fixed addresses, as with a serial line's registers; there is no semihosting.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(not(target_os = "none"))]
fn main() {}

#[cfg(target_os = "none")]
mod chip {
    use core::arch::global_asm;
    use feature_sampling::bezier::Cubic;
    use feature_sampling::geometry::Point;
    use feature_sampling::sampling::flatten::Flattener;
    use fsample_job::{Command, Decoder};

    global_asm!(
        ".section .vectors, \"a\"",
        ".word _stack_top",
        ".word reset + 1",
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
        "b start",
    );

    const PORT: *mut u32 = 0x4000_4000 as *mut u32;

    fn put(p: &Point<f32>) {
        // SAFETY: a device's register.
        unsafe {
            PORT.write_volatile(p.x.to_bits());
            PORT.write_volatile(p.y.to_bits());
        }
    }

    #[unsafe(no_mangle)]
    extern "C" fn start() -> ! {
        let mut decoder = Decoder::new();
        let (mut here, mut tolerance) = (Point::new(0.0_f32, 0.0), 0.0_f32);
        loop {
            // SAFETY: a device's register.
            let byte = unsafe { PORT.read_volatile() } as u8;
            match decoder.push(byte) {
                Ok(Some(Command::Options(options))) => tolerance = options.chord_error,
                Ok(Some(Command::Begin { at: [x, y], .. })) => here = Point::new(x, y),
                Ok(Some(Command::Line([x, y]))) => {
                    here = Point::new(x, y);
                    put(&here);
                }
                Ok(Some(Command::Cubic([a, b, c, d, e, f]))) => {
                    let cubic = Cubic::new(here, Point::new(a, b), Point::new(c, d), Point::new(e, f));
                    here = *cubic.end();
                    let Ok(mut flat) = Flattener::new(&cubic, &tolerance) else { continue };
                    while let Some(p) = flat.next() {
                        put(&p);
                    }
                }
                // What concerns lfs is not for this one.
                Ok(_) => {}
                Err(_) => decoder = Decoder::new(),
            }
        }
    }

    #[panic_handler]
    fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
        loop {}
    }
}
