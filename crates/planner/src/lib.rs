//! From points to motor steps: a trapezoidal planner with look-ahead, for two axes, in f32, without heap and without panics.
//!
//! **Problem.** Samples of a path come one by one. Between two of them the pen moves in a straight line, never faster than
//! the feed, never changing its speed by more than the acceleration allows, and passing from one line to the next with a
//! jump of velocity of at most the *corner speed*. How fast a line may be entered depends on what follows: the pen must
//! always be able to stop within the lines that are known.
//!
//! **How.** [`Planner::line`] rounds the end of a line to motor steps (so that errors do not add up), bounds the speed at
//! the joint with the line before, |v|·|u₂ − u₁| ≤ corner speed for unit directions u₁, u₂, and enters it into a queue of
//! [`LINES`] lines. From the newest line back to the oldest, the squared speed at a joint is at most that of the next joint
//! plus 2·a·length; the last line ends at rest. The oldest line's entry speed is that with which the pen already moves: it
//! only falls below what was planned if nothing follows, which had been assumed anyway. So speeds planned once only grow.
//!
//! [`Planner::step`] hands out one motor step: the signs of the two axes (Bresenham's line, the longer axis steps each
//! time) and how long after the step before it is due. The squared speed after k of n steps is
//! min(v₀² + 2as, feed², v₁² + 2a(length − s)), s = k·length/n; a step between squared speeds u² and w² takes 2·(length/n)/(u + w):
//! the time of a constant acceleration of at most a. Times are rounded up, so that rounding never speeds the pen up.
//!
//! **Work.** `line` visits each queued line once; `step` is one square root, one division and a few products. Neither loops
//! otherwise. A line is handed over to `step` when it is the oldest; while the queue is full no line can be taken
//! ([`PlanError::Full`]), and while it is not [`Planner::flush`]ed fewer lines than [`LINES`] are not started, so that
//! look-ahead is never given away.
//!
//! **What can go wrong.** Speeds are exact to a few roundoffs of f32; `tests/motion.rs` recovers them from the times. A line
//! has at most 2^24 steps (longer ones are refused), because f32 counts no further.
#![no_std]
#![forbid(unsafe_code)]

use core::fmt;

/// Lines that the planner looks ahead.
pub const LINES: usize = 16;

/// Largest number of motor steps in one line, and largest coordinate in steps.
pub const MOST_STEPS: i32 = 1 << 24;

/// What the machine can do; lengths in user units, times in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Speed along the path.
    pub feed: f32,
    /// Largest jump of velocity between two lines; half of it is the speed at which the pen may turn back.
    pub corner_speed: f32,
    /// Acceleration along the path.
    pub acceleration: f32,
    /// Motor steps a unit.
    pub steps_per_unit: f32,
    /// Ticks a second of the timer that times the steps.
    pub clock: f32,
}

/// One motor step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MotorStep {
    /// Ticks since the step before, at least 1.
    pub after: u32,
    /// −1, 0 or 1.
    pub x: i8,
    /// −1, 0 or 1.
    pub y: i8,
}

impl MotorStep {
    /// The step in one word: 16 times the ticks, plus 1, 2, 4, 8 for +x, −x, +y, −y. Ticks from 2^28 on are cut to 2^28 − 1.
    #[must_use]
    pub const fn word(&self) -> u32 {
        let after = if self.after < 1 << 28 { self.after } else { (1 << 28) - 1 };
        let signs =
            (self.x > 0) as u32 | ((self.x < 0) as u32) << 1 | ((self.y > 0) as u32) << 2 | ((self.y < 0) as u32) << 3;
        after << 4 | signs
    }
}

/// Why a line was not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlanError {
    /// The queue is full: take steps first.
    Full,
    /// A limit is not a positive finite number.
    Limits,
    /// A point is not finite or farther than [`MOST_STEPS`] steps from the origin or from the point before.
    Range,
}

impl fmt::Display for PlanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Full => "the planner's queue is full",
            Self::Limits => "a limit of the machine is not a positive finite number",
            Self::Range => "a point is out of the motors' range",
        })
    }
}

impl core::error::Error for PlanError {}

/// A line in the queue.
#[derive(Clone, Copy, Debug, Default)]
struct Line {
    /// Steps along each axis.
    steps: [i32; 2],
    length: f32,
    /// Largest squared speed at its start: that of the joint.
    joint: f32,
    /// Planned squared speed at its start.
    entry: f32,
}

/// The line that is being stepped.
#[derive(Clone, Copy, Debug)]
struct Motion {
    steps: [i32; 2],
    /// Steps along the longer axis, and how many are done.
    count: i32,
    done: i32,
    /// Bresenham's error, of the shorter axis.
    error: i32,
    /// Length of a step.
    share: f32,
    /// Squared speeds at its start, at its end, and after the last step.
    start: f32,
    end: f32,
    now: f32,
}

/// The planner.
#[derive(Clone, Debug)]
pub struct Planner {
    limits: Limits,
    /// A ring: the oldest line, and how many there are.
    queue: [Line; LINES],
    first: usize,
    len: usize,
    /// Where the newest line ends, in steps, and its direction; none after a stop.
    at: [i32; 2],
    direction: Option<[f32; 2]>,
    motion: Option<Motion>,
    /// Squared speed with which the oldest line is entered, fixed when the one before it was started.
    entered: f32,
    /// What is queued is to be run to its end.
    flushing: bool,
}

/// √v, correctly rounded: equal on host and chip.
fn root(v: f32) -> f32 {
    libm::sqrtf(v)
}

/// A step count that a float holds exactly.
const fn float(n: i32) -> f32 {
    n as f32
}

impl Planner {
    /// At rest at the origin.
    ///
    /// # Errors
    /// [`PlanError::Limits`].
    pub fn new(limits: Limits) -> Result<Self, PlanError> {
        let l = &limits;
        let good = [l.feed, l.corner_speed, l.acceleration, l.steps_per_unit, l.clock]
            .iter()
            .all(|v| *v > 0.0 && v.is_finite());
        if !good {
            return Err(PlanError::Limits);
        }
        Ok(Self {
            limits,
            queue: [Line::default(); LINES],
            first: 0,
            len: 0,
            at: [0, 0],
            direction: None,
            motion: None,
            entered: 0.0,
            flushing: false,
        })
    }

    /// No line can be taken before some steps are.
    #[must_use]
    pub const fn is_full(&self) -> bool {
        self.len == LINES
    }

    /// Nothing is queued and nothing moves.
    #[must_use]
    pub const fn is_idle(&self) -> bool {
        self.len == 0 && self.motion.is_none()
    }

    /// Where the queued lines lead to, in steps.
    #[must_use]
    pub const fn position(&self) -> [i32; 2] {
        self.at
    }

    /// Adds a straight line to a point. A line that is shorter than a step is none: its length goes to the next.
    ///
    /// # Errors
    /// [`PlanError::Full`] and [`PlanError::Range`]; nothing has changed then.
    pub fn line(&mut self, to: [f32; 2]) -> Result<(), PlanError> {
        if self.is_full() {
            return Err(PlanError::Full);
        }
        let to = [self.in_steps(to[0])?, self.in_steps(to[1])?];
        let steps = [to[0] - self.at[0], to[1] - self.at[1]];
        if steps[0].abs() > MOST_STEPS || steps[1].abs() > MOST_STEPS {
            return Err(PlanError::Range);
        }
        if steps == [0, 0] {
            return Ok(());
        }
        let [x, y] = steps.map(|n| float(n) / self.limits.steps_per_unit);
        let length = root(x * x + y * y);
        let direction = [x / length, y / length];
        let joint = self.direction.map_or(0.0, |before| self.joint_speed_sq(before, direction));
        let slot = (self.first + self.len) % LINES;
        if let Some(line) = self.queue.get_mut(slot) {
            *line = Line { steps, length, joint, entry: 0.0 };
        }
        self.len += 1;
        self.at = to;
        self.direction = Some(direction);
        self.flushing = false;
        self.plan();
        Ok(())
    }

    /// What is queued is all for now: it is run until the pen rests. The next line starts from rest.
    pub fn flush(&mut self) {
        self.flushing = true;
        self.direction = None;
    }

    /// The next motor step; none where the pen rests, or where more lines should be added first.
    pub fn step(&mut self) -> Option<MotorStep> {
        if self.motion.is_none() {
            if !(self.is_full() || self.flushing) {
                return None;
            }
            self.motion = self.start();
        }
        let feed = self.limits.feed * self.limits.feed;
        let twice = 2.0 * self.limits.acceleration;
        let m = self.motion.as_mut()?;
        m.done += 1;
        let (behind, ahead) = (float(m.done) * m.share, float(m.count - m.done) * m.share);
        let next = least(least(m.start + twice * behind, m.end + twice * ahead), feed);
        let (u, w) = (root(m.now), root(next));
        // From rest to rest in one step: up to the middle and down again.
        let seconds =
            if u + w > 0.0 { 2.0 * m.share / (u + w) } else { 2.0 * root(m.share / self.limits.acceleration) };
        m.now = next;
        let [x, y] = m.steps;
        let (long, short) = if x.abs() >= y.abs() { (x, y) } else { (y, x) };
        m.error += 2 * short.abs();
        let aside = m.error > m.count;
        if aside {
            m.error -= 2 * m.count;
        }
        let (a, b) = (sign(long), if aside { sign(short) } else { 0 });
        let (x, y) = if x.abs() >= y.abs() { (a, b) } else { (b, a) };
        if m.done == m.count {
            self.motion = None;
        }
        Some(MotorStep { after: ticks(seconds * self.limits.clock), x, y })
    }

    /// The squared speed at a joint of two unit directions: |v|·|u₂ − u₁| is at most the corner speed.
    fn joint_speed_sq(&self, before: [f32; 2], after: [f32; 2]) -> f32 {
        let (dx, dy) = (after[0] - before[0], after[1] - before[1]);
        let turn = dx * dx + dy * dy;
        let corner = self.limits.corner_speed * self.limits.corner_speed;
        let feed = self.limits.feed * self.limits.feed;
        // A hair less, for the rounding of the directions.
        if corner < feed * turn { 0.9999 * corner / turn } else { feed }
    }

    fn in_steps(&self, v: f32) -> Result<i32, PlanError> {
        let steps = v * self.limits.steps_per_unit;
        if steps.is_finite() && steps.abs() < float(MOST_STEPS) {
            // Towards zero after half a step outwards: to the nearest.
            #[allow(clippy::cast_possible_truncation, reason = "within 2^24")]
            let nearest = (if steps < 0.0 { steps - 0.5 } else { steps + 0.5 }) as i32;
            Ok(nearest)
        } else {
            Err(PlanError::Range)
        }
    }

    /// Entry speeds of the queued lines, from the newest, which ends at rest, to the oldest.
    fn plan(&mut self) {
        let twice = 2.0 * self.limits.acceleration;
        let mut exit = 0.0;
        for n in (0..self.len).rev() {
            let oldest = n == 0;
            let slot = (self.first + n) % LINES;
            let Some(line) = self.queue.get_mut(slot) else { return };
            let entry = least(line.joint, exit + twice * line.length);
            line.entry = if oldest { self.entered } else { entry };
            exit = line.entry;
        }
    }

    /// Takes the oldest line out of the queue and fixes the speed with which the next one is entered.
    fn start(&mut self) -> Option<Motion> {
        if self.len == 0 {
            return None;
        }
        let line = *self.queue.get(self.first)?;
        self.first = (self.first + 1) % LINES;
        self.len -= 1;
        let next = if self.len == 0 { 0.0 } else { self.queue.get(self.first).map_or(0.0, |l| l.entry) };
        let start = self.entered;
        // What is reached from the entry may be less than what the joint allows.
        let end = least(next, start + 2.0 * self.limits.acceleration * line.length);
        self.entered = end;
        let [x, y] = line.steps;
        let count = x.abs().max(y.abs());
        Some(Motion {
            steps: line.steps,
            count,
            done: 0,
            error: 0,
            share: line.length / float(count),
            start,
            end,
            now: start,
        })
    }
}

/// The smaller one; no call of a library for NaN, which there is none of.
const fn least(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

const fn sign(n: i32) -> i8 {
    if n > 0 {
        1
    } else if n < 0 {
        -1
    } else {
        0
    }
}

/// Rounded up, at least 1.
#[allow(clippy::cast_possible_truncation, reason = "a saturating cast of a positive number")]
fn ticks(v: f32) -> u32 {
    let whole = v as u32;
    whole.saturating_add(u32::from((whole as f32) < v)).max(1)
}
