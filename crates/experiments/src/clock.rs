//! Time on one core.
//!
//! Where the system tells (Linux, `/proc/thread-self/schedstat`), the time that this thread has spent on a processor: what
//! else runs on the machine then counts little. Elsewhere, the time on the wall.

use std::fs;
use std::time::Instant;

/// A running clock. It has to be read on the thread that started it.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    processor: Option<u64>,
    wall: Instant,
}

/// Nanoseconds that this thread has spent on a processor.
fn on_processor() -> Option<u64> {
    fs::read_to_string("/proc/thread-self/schedstat").ok()?.split_whitespace().next()?.parse().ok()
}

impl Clock {
    /// Starts.
    pub fn start() -> Self {
        Self { processor: on_processor(), wall: Instant::now() }
    }

    /// Seconds since the start.
    pub fn seconds(&self) -> f64 {
        match (self.processor, on_processor()) {
            (Some(start), Some(now)) if now > start => (now - start) as f64 * 1e-9,
            _ => self.wall.elapsed().as_secs_f64(),
        }
    }
}

/// What [`Clock`] measures here, for notes of tables.
pub fn kind() -> &'static str {
    if on_processor().is_some() { "processor time" } else { "time on the wall" }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_takes_time() {
        let clock = Clock::start();
        let sum = (0..3_000_000_u64).fold(0_u64, |sum, i| sum.wrapping_mul(31).wrapping_add(std::hint::black_box(i)));
        std::hint::black_box(sum);
        assert!(clock.seconds() > 0.0 && clock.seconds() < 60.0, "{}", clock.seconds());
    }
}
