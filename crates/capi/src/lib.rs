//! The C interface for firmware: `include/fsample.h` says what each function does. This file only translates.
//!
//! Nothing is allocated: the caller lends memory, whose size the header states and `check` compares. No function unwinds or
//! panics; every failure is a negative number. All `unsafe` of the C interface is here, and all of it is one of two things:
//! a pointer from C is taken for what the header says it is, or a type is placed in memory that C lent for it.
#![no_std]

use core::ffi::c_void;
use core::mem::MaybeUninit;
use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::Point;
use feature_sampling::sampling::Sample;
use feature_sampling::sampling::flatten::Flattener;
use fsample_planner::{Limits, MotorStep, PlanError, Planner};
use plotter::memory::Memory;
use plotter::{Listener, Work};

/// A pointer was null or misaligned.
const BAD_POINTER: i32 = -1;
/// A number was out of range.
const BAD_NUMBER: i32 = -2;
/// The planner's queue is full.
const FULL: i32 = -3;

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// The value that C lent memory for.
///
/// # Safety
/// `p` is null, misaligned, or valid for reads and writes of a `T` for the length of the call, with nothing else using it.
unsafe fn lent<'a, T>(p: *mut c_void) -> Option<&'a mut MaybeUninit<T>> {
    let p = p.cast::<MaybeUninit<T>>();
    // SAFETY: the caller's promise; `MaybeUninit` asks nothing of the bytes.
    if p.is_null() || !p.is_aligned() { None } else { Some(unsafe { &mut *p }) }
}

/// Eight floats are a cubic.
///
/// # Safety
/// `p` is null or points to `N` floats.
unsafe fn floats<const N: usize>(p: *const f32) -> Option<[f32; N]> {
    // SAFETY: the caller's promise.
    if p.is_null() || !p.is_aligned() { None } else { Some(unsafe { p.cast::<[f32; N]>().read() }) }
}

/// See the header.
///
/// # Safety
/// As the header says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsample_flatten_begin(memory: *mut c_void, cubic: *const f32, tolerance: f32) -> i32 {
    // SAFETY: the caller lends FSAMPLE_FLATTENER_BYTES and eight floats.
    let (Some(slot), Some([a, b, c, d, e, f, g, h])) =
        (unsafe { lent::<Flattener<f32>>(memory) }, unsafe { floats(cubic) })
    else {
        return BAD_POINTER;
    };
    let cubic = Cubic::new(Point::new(a, b), Point::new(c, d), Point::new(e, f), Point::new(g, h));
    match Flattener::new(&cubic, &tolerance) {
        Ok(flat) => {
            slot.write(flat);
            0
        }
        Err(_) => BAD_NUMBER,
    }
}

/// See the header.
///
/// # Safety
/// As the header says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsample_flatten_next(memory: *mut c_void, point: *mut f32) -> i32 {
    // SAFETY: the caller lends the memory that `fsample_flatten_begin` filled, and room for two floats.
    let (Some(slot), Some(out)) =
        (unsafe { lent::<Flattener<f32>>(memory) }, unsafe { lent::<[f32; 2]>(point.cast()) })
    else {
        return BAD_POINTER;
    };
    // SAFETY: filled by `fsample_flatten_begin`, as the caller promises.
    match unsafe { slot.assume_init_mut() }.next() {
        Some(p) => {
            out.write([p.x, p.y]);
            1
        }
        None => 0,
    }
}

/// See the header.
///
/// # Safety
/// As the header says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsample_planner_begin(memory: *mut c_void, limits: *const f32) -> i32 {
    // SAFETY: the caller lends FSAMPLE_PLANNER_BYTES and a struct of five floats.
    let (Some(slot), Some([feed, corner_speed, acceleration, steps_per_unit, clock])) =
        (unsafe { lent::<Planner>(memory) }, unsafe { floats(limits) })
    else {
        return BAD_POINTER;
    };
    match Planner::new(Limits { feed, corner_speed, acceleration, steps_per_unit, clock }) {
        Ok(planner) => {
            slot.write(planner);
            0
        }
        Err(_) => BAD_NUMBER,
    }
}

/// See the header.
///
/// # Safety
/// As the header says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsample_planner_line(memory: *mut c_void, x: f32, y: f32) -> i32 {
    // SAFETY: the caller lends the memory that `fsample_planner_begin` filled.
    let Some(slot) = (unsafe { lent::<Planner>(memory) }) else { return BAD_POINTER };
    // SAFETY: filled by `fsample_planner_begin`, as the caller promises.
    match unsafe { slot.assume_init_mut() }.line([x, y]) {
        Ok(()) => 0,
        Err(PlanError::Full) => FULL,
        Err(_) => BAD_NUMBER,
    }
}

/// See the header.
///
/// # Safety
/// As the header says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsample_planner_flush(memory: *mut c_void) -> i32 {
    // SAFETY: the caller lends the memory that `fsample_planner_begin` filled.
    let Some(slot) = (unsafe { lent::<Planner>(memory) }) else { return BAD_POINTER };
    // SAFETY: filled by `fsample_planner_begin`, as the caller promises.
    unsafe { slot.assume_init_mut() }.flush();
    0
}

/// A motor step as C sees it.
#[repr(C)]
pub struct FsampleStep {
    after: u32,
    x: i8,
    y: i8,
}

/// See the header.
///
/// # Safety
/// As the header says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsample_planner_step(memory: *mut c_void, step: *mut FsampleStep) -> i32 {
    // SAFETY: the caller lends the memory that `fsample_planner_begin` filled, and room for a step.
    let (Some(slot), Some(out)) = (unsafe { lent::<Planner>(memory) }, unsafe { lent::<FsampleStep>(step.cast()) })
    else {
        return BAD_POINTER;
    };
    // SAFETY: filled by `fsample_planner_begin`, as the caller promises.
    match unsafe { slot.assume_init_mut() }.step() {
        Some(MotorStep { after, x, y }) => {
            out.write(FsampleStep { after, x, y });
            1
        }
        None => 0,
    }
}

/// What a job calls. Each function may be null.
#[repr(C)]
pub struct FsampleCalls {
    user: *mut c_void,
    /// The next byte of the stream, or a negative number where there is none.
    byte: Option<unsafe extern "C" fn(*mut c_void) -> i32>,
    between: Option<unsafe extern "C" fn(*mut c_void)>,
    sample: Option<unsafe extern "C" fn(*mut c_void, f32, f32, f32)>,
    pen: Option<unsafe extern "C" fn(*mut c_void, i32)>,
    motor: Option<unsafe extern "C" fn(*mut c_void, *const FsampleStep)>,
}

impl Listener for &FsampleCalls {
    fn before(&mut self) {}

    fn after(&mut self, _: Work) {
        if let Some(call) = self.between {
            // SAFETY: the caller's function with the caller's pointer.
            unsafe { call(self.user) };
        }
    }

    fn sample(&mut self, s: &Sample<f32>) {
        if let Some(call) = self.sample {
            // SAFETY: as above.
            unsafe { call(self.user, s.point.x, s.point.y, s.lfs) };
        }
    }

    fn pen(&mut self, down: bool) {
        if let Some(call) = self.pen {
            // SAFETY: as above.
            unsafe { call(self.user, i32::from(down)) };
        }
    }

    fn motor(&mut self, step: MotorStep) {
        if let Some(call) = self.motor {
            let step = FsampleStep { after: step.after, x: step.x, y: step.y };
            // SAFETY: as above; the step lives through the call.
            unsafe { call(self.user, &raw const step) };
        }
    }
}

/// See the header.
///
/// # Safety
/// As the header says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsample_job(memory: *mut c_void, calls: *const FsampleCalls, budget: u32) -> i32 {
    // SAFETY: the caller lends FSAMPLE_JOB_BYTES and a struct of functions.
    let (Some(memory), Some(calls)) = (unsafe { lent::<Memory>(memory) }, unsafe { calls.as_ref() }) else {
        return BAD_POINTER;
    };
    let bytes = core::iter::from_fn(|| {
        let call = calls.byte?;
        // SAFETY: the caller's function with the caller's pointer.
        u8::try_from(unsafe { call(calls.user) }).ok()
    });
    match memory.write(Memory::new()).run(bytes, budget, &mut &*calls) {
        Ok(totals) => i32::try_from(totals.samples).unwrap_or(i32::MAX),
        Err(fault) => -fault.code().cast_signed(),
    }
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn fsample_bytes(what: i32) -> u32 {
    let size = match what {
        0 => size_of::<Flattener<f32>>(),
        1 => size_of::<Planner>(),
        2 => size_of::<Memory>(),
        _ => 0,
    };
    u32::try_from(size).unwrap_or(0)
}
