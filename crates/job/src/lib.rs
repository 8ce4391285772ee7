//! The `.fsj` job format: what a host sends to a plotter's controller.
//!
//! A job is a stream of little-endian bytes: the four bytes `FSJ1`, then commands of one kind byte and a payload whose length
//! the kind decides, all numbers being IEEE 754 binary32. The last command carries the CRC-32 (polynomial 0xEDB88320, as in
//! zip) of every byte before the checksum itself.
//!
//! | kind | command | payload |
//! |---|---|---|
//! | 1 | options, exactly once and first | ε, η, chord error, d_min, d_max, feed, corner speed, acceleration, motor steps a unit (f32 each; chord error and d_max 0 where there is none), foot points a cubic (u16) |
//! | 2 | begin a path | x, y, closed (u8: 0 or 1) |
//! | 3 | cubic from the last point | x1, y1, x2, y2, x3, y3 |
//! | 4 | line from the last point | x, y |
//! | 5 | lfs along the cubic before it | number of values, 2 to 1025 (u16), corners (u8: 1 where the cubic starts, 2 where it ends) |
//! | 6 | values | 16 values (u16 each): the upper half of a binary32, towards 0; what is beyond the number is 0 |
//! | 7 | lfs along the cubic before it is wanted | number of places, 2 to 1025 (u16), corners as in 5 |
//! | 8 | an arc of that cubic ends here | its parameter in (0, 1), ascending (f32) |
//! | 15 | end | CRC-32 (u32) |
//!
//! The cubics are those of the curve as the host's door made it, split, snapped and smoothed, so that a controller needs no
//! door. Ends whose points are equal to the bit meet. lfs is known at places along each cubic, at equal steps of its parameter,
//! the first at 0, the last at 1; every cubic has a command 5, or every cubic has a command 7.
//!
//! **With lfs.** Commands 5 and 6 are for a controller that does not compute lfs. No value is above lfs at its place. As many
//! commands 6 follow a command 5 as its values need.
//!
//! **Without lfs.** A command 7 says where the controller has to compute it, and the commands 8 after it where curvature is
//! extremal or zero, and where so much turning has come together that a new arc begins. A cubic that repeats an earlier one has two
//! places and no arcs.
//!
//! η covers what the controller's values may be too large by at their places (its foot points, f32): it divides them by 1 + η.
//! Values that come with the job need no η.
//!
//! [`Decoder::push`] takes one byte and does a bounded amount of work; its memory is fixed. A job must not move a motor
//! before its end has been accepted: only then is the checksum known to hold.
#![no_std]
#![forbid(unsafe_code)]

use core::fmt;

/// The first bytes of a job.
pub const MAGIC: [u8; 4] = *b"FSJ1";

/// Largest coordinate and length, in user units; more is refused, so that products of lengths stay in binary32's range.
pub const LARGEST: f32 = 1.0e5;

/// Arcs that share a leaf of the curve's hierarchy on the chip. The host measures η with the same number: another one can
/// change the last bits of a radius.
pub const LEAF: u32 = 12;

/// Values of lfs in one command.
pub const VALUES: usize = 16;

/// Most values along one cubic.
pub const MOST_VALUES: u16 = 1025;

/// The upper half of a number that is not negative, towards 0: the number loses a 128th of itself at most (the smallest ones,
/// below 1e-38, more). What is negative or not a number becomes 0.
#[must_use]
pub const fn reduce(v: f32) -> u16 {
    if v > 0.0 { (v.to_bits() >> 16) as u16 } else { 0 }
}

/// The number of an upper half.
#[must_use]
pub const fn expand(half: u16) -> f32 {
    f32::from_bits((half as u32) << 16)
}

/// The upper half of infinity: larger ones are negative or not numbers.
const INFINITE: u16 = reduce(f32::INFINITY);

/// What a job asks of the controller. Lengths in user units, times in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JobOptions {
    /// ε in (0, 1].
    pub epsilon: f32,
    /// Values of lfs are divided by 1 + η; in [0, 1].
    pub eta: f32,
    /// Largest chord error; 0 for none.
    pub chord_error: f32,
    /// d_min, above 0.
    pub min_distance: f32,
    /// d_max; 0 for none.
    pub max_distance: f32,
    /// Speed along the path.
    pub feed: f32,
    /// Speed at a corner, at most the feed.
    pub corner_speed: f32,
    /// Acceleration along the path.
    pub acceleration: f32,
    /// Motor steps a unit.
    pub steps_per_unit: f32,
    /// Foot points a cubic, 1 to 1024.
    pub foot_points: u16,
}

/// One command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    /// The options.
    Options(JobOptions),
    /// A path starts.
    Begin {
        /// Its first point.
        at: [f32; 2],
        /// It ends where it starts.
        closed: bool,
    },
    /// A cubic from the last point: two handles and its end.
    Cubic([f32; 6]),
    /// A line from the last point.
    Line([f32; 2]),
    /// A table of lfs along the last cubic follows.
    Table {
        /// How many values.
        values: u16,
        /// C has a corner where the cubic starts, where it ends.
        corners: [bool; 2],
    },
    /// Values of the table, as [`expand`] reads them.
    Values([u16; VALUES]),
    /// lfs has to be computed along the last cubic.
    Places {
        /// At how many places.
        places: u16,
        /// C has a corner where the cubic starts, where it ends.
        corners: [bool; 2],
    },
    /// An arc of the last cubic ends at this parameter.
    Cut(f32),
    /// The job is whole and its checksum holds.
    End,
}

/// Why a stream is no job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum JobError {
    /// It does not start with [`MAGIC`].
    Magic,
    /// No command has this kind.
    Unknown(u8),
    /// A number is not finite, beyond [`LARGEST`], or out of its option's range.
    Range,
    /// Options that are missing or repeated, or a curve without a path.
    Order,
    /// The checksum does not hold.
    Checksum,
    /// Bytes after the end.
    AfterEnd,
    /// The stream stopped before its end.
    Truncated,
    /// An earlier byte was refused already.
    Refused,
    /// The encoder's buffer is full.
    Full,
}

impl JobError {
    /// The error in one byte, for a report over a serial line.
    #[must_use]
    pub const fn code(&self) -> u8 {
        match self {
            Self::Magic => 1,
            Self::Unknown(_) => 2,
            Self::Range => 3,
            Self::Order => 4,
            Self::Checksum => 5,
            Self::AfterEnd => 6,
            Self::Truncated => 7,
            Self::Refused => 8,
            Self::Full => 9,
        }
    }
}

impl fmt::Display for JobError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Magic => f.write_str("not a job: it does not start with FSJ1"),
            Self::Unknown(kind) => write!(f, "no command has the kind {kind}"),
            Self::Range => f.write_str("a number is out of range"),
            Self::Order => f.write_str("a command stands where it must not"),
            Self::Checksum => f.write_str("the checksum does not hold"),
            Self::AfterEnd => f.write_str("bytes follow the end of the job"),
            Self::Truncated => f.write_str("the job stops before its end"),
            Self::Refused => f.write_str("an earlier byte was refused"),
            Self::Full => f.write_str("the buffer for the job is full"),
        }
    }
}

impl core::error::Error for JobError {}

/// Length of a command's payload.
const fn payload(kind: u8) -> Option<usize> {
    Some(match kind {
        1 => 38,
        2 => 9,
        3 => 24,
        4 => 8,
        5 | 7 => 3,
        6 => 2 * VALUES,
        8 => 4,
        15 => 4,
        _ => return None,
    })
}

/// CRC-32, bit by bit: no table in flash.
const fn crc(mut sum: u32, byte: u8) -> u32 {
    sum ^= byte as u32;
    let mut bit = 0;
    while bit < 8 {
        sum = if sum & 1 == 1 { sum >> 1 ^ 0xEDB8_8320 } else { sum >> 1 };
        bit += 1;
    }
    sum
}

/// Where the decoder stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Magic(usize),
    Kind,
    Payload(u8, usize),
    Ended,
    Refused,
}

/// Turns bytes into commands.
#[derive(Clone, Debug)]
pub struct Decoder {
    state: State,
    bytes: [u8; 38],
    filled: usize,
    sum: u32,
    /// The checksum before the payload in hand.
    before: u32,
    options: bool,
    path: bool,
    /// The last command was a cubic or a line.
    curve: bool,
    /// Values of a table that are still to come.
    values: usize,
    /// Where the last arc of a cubic starts; 1 where there is none to cut.
    arc: f32,
}

impl Default for Decoder {
    fn default() -> Self {
        Self::new()
    }
}

impl Decoder {
    /// At the start of a stream.
    pub const fn new() -> Self {
        Self {
            state: State::Magic(0),
            bytes: [0; 38],
            filled: 0,
            sum: u32::MAX,
            before: u32::MAX,
            options: false,
            path: false,
            curve: false,
            values: 0,
            arc: 1.0,
        }
    }

    /// Takes one byte; a command where it completes one.
    ///
    /// # Errors
    /// See [`JobError`]; the decoder then refuses everything else.
    pub fn push(&mut self, byte: u8) -> Result<Option<Command>, JobError> {
        let result = self.take(byte);
        if result.is_err() {
            self.state = State::Refused;
        }
        result
    }

    /// Says whether the stream may stop here.
    ///
    /// # Errors
    /// [`JobError::Truncated`] before the end, [`JobError::Refused`] after an error.
    pub const fn finish(&self) -> Result<(), JobError> {
        match self.state {
            State::Ended => Ok(()),
            State::Refused => Err(JobError::Refused),
            _ => Err(JobError::Truncated),
        }
    }

    fn take(&mut self, byte: u8) -> Result<Option<Command>, JobError> {
        match self.state {
            State::Refused => Err(JobError::Refused),
            State::Ended => Err(JobError::AfterEnd),
            State::Magic(n) => {
                if MAGIC.get(n) != Some(&byte) {
                    return Err(JobError::Magic);
                }
                self.sum = crc(self.sum, byte);
                self.state = if n + 1 == MAGIC.len() { State::Kind } else { State::Magic(n + 1) };
                Ok(None)
            }
            State::Kind => {
                let length = payload(byte).ok_or(JobError::Unknown(byte))?;
                self.sum = crc(self.sum, byte);
                self.before = self.sum;
                self.filled = 0;
                self.state = State::Payload(byte, length);
                Ok(None)
            }
            State::Payload(kind, length) => {
                if let Some(slot) = self.bytes.get_mut(self.filled) {
                    *slot = byte;
                }
                self.filled += 1;
                self.sum = crc(self.sum, byte);
                if self.filled < length {
                    return Ok(None);
                }
                self.state = State::Kind;
                self.command(kind).map(Some)
            }
        }
    }

    fn command(&mut self, kind: u8) -> Result<Command, JobError> {
        let follows = matches!(kind, 5 | 7);
        if (kind == 1) == self.options || (kind == 6) != (self.values > 0) || (follows && !self.curve) {
            return Err(JobError::Order);
        }
        self.curve = matches!(kind, 3 | 4);
        let arc = core::mem::replace(&mut self.arc, 1.0);
        match kind {
            1 => {
                self.options = true;
                let [low, high] = [self.byte(36), self.byte(37)];
                let options = JobOptions {
                    epsilon: self.number(0)?,
                    eta: self.number(1)?,
                    chord_error: self.number(2)?,
                    min_distance: self.number(3)?,
                    max_distance: self.number(4)?,
                    feed: self.number(5)?,
                    corner_speed: self.number(6)?,
                    acceleration: self.number(7)?,
                    steps_per_unit: self.number(8)?,
                    foot_points: u16::from_le_bytes([low, high]),
                };
                options.check()?;
                Ok(Command::Options(options))
            }
            2 => {
                self.path = true;
                let closed = match self.byte(8) {
                    0 => false,
                    1 => true,
                    _ => return Err(JobError::Range),
                };
                Ok(Command::Begin { at: [self.number(0)?, self.number(1)?], closed })
            }
            15 => {
                let told = self.word(0);
                if told != !self.before {
                    return Err(JobError::Checksum);
                }
                self.state = State::Ended;
                Ok(Command::End)
            }
            5 | 7 => {
                let (values, corners) = (u16::from_le_bytes([self.byte(0), self.byte(1)]), self.byte(2));
                if !(2..=MOST_VALUES).contains(&values) || corners > 3 {
                    return Err(JobError::Range);
                }
                let corners = [corners & 1 != 0, corners & 2 != 0];
                if kind == 7 {
                    self.arc = 0.0;
                    return Ok(Command::Places { places: values, corners });
                }
                self.values = usize::from(values);
                Ok(Command::Table { values, corners })
            }
            8 => {
                let t = self.number(0)?;
                if arc >= 1.0 {
                    return Err(JobError::Order);
                }
                if t <= arc || t >= 1.0 {
                    return Err(JobError::Range);
                }
                self.arc = t;
                Ok(Command::Cut(t))
            }
            6 => {
                let values = core::array::from_fn(|k| u16::from_le_bytes([self.byte(2 * k), self.byte(2 * k + 1)]));
                let beyond = values.iter().skip(self.values);
                if values.iter().any(|&v| v > INFINITE) || beyond.copied().any(|v| v != 0) {
                    return Err(JobError::Range);
                }
                self.values = self.values.saturating_sub(VALUES);
                Ok(Command::Values(values))
            }
            _ if !self.path => Err(JobError::Order),
            3 => {
                let mut numbers = [0.0; 6];
                for (k, number) in numbers.iter_mut().enumerate() {
                    *number = self.number(k)?;
                }
                Ok(Command::Cubic(numbers))
            }
            _ => Ok(Command::Line([self.number(0)?, self.number(1)?])),
        }
    }

    fn byte(&self, at: usize) -> u8 {
        self.bytes.get(at).copied().unwrap_or(0)
    }

    fn word(&self, k: usize) -> u32 {
        u32::from_le_bytes(core::array::from_fn(|i| self.byte(4 * k + i)))
    }

    fn number(&self, k: usize) -> Result<f32, JobError> {
        let v = f32::from_bits(self.word(k));
        if v.is_finite() && v.abs() <= LARGEST { Ok(v) } else { Err(JobError::Range) }
    }
}

impl JobOptions {
    /// Checks every number against its range.
    ///
    /// # Errors
    /// [`JobError::Range`].
    pub fn check(&self) -> Result<(), JobError> {
        let positive = |v: f32| v > 0.0 && v <= LARGEST;
        let optional = |v: f32| v == 0.0 || positive(v);
        let good = positive(self.epsilon)
            && self.epsilon <= 1.0
            && (0.0..=1.0).contains(&self.eta)
            && optional(self.chord_error)
            && positive(self.min_distance)
            && (self.max_distance == 0.0 || (positive(self.max_distance) && self.max_distance >= self.min_distance))
            && positive(self.feed)
            && positive(self.corner_speed)
            && self.corner_speed <= self.feed
            && positive(self.acceleration)
            && positive(self.steps_per_unit)
            && (1..=1024).contains(&self.foot_points);
        if good { Ok(()) } else { Err(JobError::Range) }
    }
}

/// Writes a job into a lent buffer.
#[derive(Debug)]
pub struct Encoder<'a> {
    out: &'a mut [u8],
    len: usize,
    sum: u32,
}

impl<'a> Encoder<'a> {
    /// Starts a job.
    ///
    /// # Errors
    /// [`JobError::Full`]; [`JobError::Range`] for options that [`JobOptions::check`] refuses.
    pub fn new(out: &'a mut [u8], options: &JobOptions) -> Result<Self, JobError> {
        options.check()?;
        let mut encoder = Self { out, len: 0, sum: u32::MAX };
        encoder.bytes(&MAGIC)?;
        encoder.bytes(&[1])?;
        let o = options;
        let numbers = [
            o.epsilon,
            o.eta,
            o.chord_error,
            o.min_distance,
            o.max_distance,
            o.feed,
            o.corner_speed,
            o.acceleration,
            o.steps_per_unit,
        ];
        encoder.numbers(&numbers)?;
        encoder.bytes(&o.foot_points.to_le_bytes())?;
        Ok(encoder)
    }

    /// A path starts.
    ///
    /// # Errors
    /// [`JobError::Full`] or [`JobError::Range`].
    pub fn begin(&mut self, at: [f32; 2], closed: bool) -> Result<(), JobError> {
        self.bytes(&[2])?;
        self.numbers(&at)?;
        self.bytes(&[u8::from(closed)])
    }

    /// A cubic from the last point.
    ///
    /// # Errors
    /// [`JobError::Full`] or [`JobError::Range`].
    pub fn cubic(&mut self, points: [f32; 6]) -> Result<(), JobError> {
        self.bytes(&[3])?;
        self.numbers(&points)
    }

    /// A line from the last point.
    ///
    /// # Errors
    /// [`JobError::Full`] or [`JobError::Range`].
    pub fn line(&mut self, to: [f32; 2]) -> Result<(), JobError> {
        self.bytes(&[4])?;
        self.numbers(&to)
    }

    /// lfs along the cubic before it, at equal steps of its parameter, and where C has corners. Values are rounded towards 0
    /// ([`reduce`]).
    ///
    /// # Errors
    /// [`JobError::Full`]; [`JobError::Range`] for fewer than 2 values or more than [`MOST_VALUES`].
    pub fn table(&mut self, corners: [bool; 2], values: &[f32]) -> Result<(), JobError> {
        let count = u16::try_from(values.len()).ok().filter(|n| (2..=MOST_VALUES).contains(n));
        self.along(5, corners, count.ok_or(JobError::Range)?)?;
        for chunk in values.chunks(VALUES) {
            self.bytes(&[6])?;
            for k in 0..VALUES {
                self.bytes(&chunk.get(k).copied().map_or(0, reduce).to_le_bytes())?;
            }
        }
        Ok(())
    }

    /// lfs along the cubic before it has to be computed: at how many places, and where C has corners.
    ///
    /// # Errors
    /// [`JobError::Full`]; [`JobError::Range`] for fewer than 2 places or more than [`MOST_VALUES`].
    pub fn places(&mut self, corners: [bool; 2], places: u16) -> Result<(), JobError> {
        if !(2..=MOST_VALUES).contains(&places) {
            return Err(JobError::Range);
        }
        self.along(7, corners, places)
    }

    /// An arc of the cubic before it ends at a parameter.
    ///
    /// # Errors
    /// [`JobError::Full`]; [`JobError::Range`] for a parameter that is not inside (0, 1).
    pub fn cut(&mut self, t: f32) -> Result<(), JobError> {
        if !(t > 0.0 && t < 1.0) {
            return Err(JobError::Range);
        }
        self.bytes(&[8])?;
        self.numbers(&[t])
    }

    fn along(&mut self, kind: u8, corners: [bool; 2], count: u16) -> Result<(), JobError> {
        let [low, high] = count.to_le_bytes();
        let [start, end] = corners.map(u8::from);
        self.bytes(&[kind, low, high, start | end << 1])
    }

    /// Ends the job; the number of bytes written.
    ///
    /// # Errors
    /// [`JobError::Full`].
    pub fn end(mut self) -> Result<usize, JobError> {
        self.bytes(&[15])?;
        let sum = !self.sum;
        self.bytes(&sum.to_le_bytes())?;
        Ok(self.len)
    }

    fn numbers(&mut self, numbers: &[f32]) -> Result<(), JobError> {
        for v in numbers {
            if !(v.is_finite() && v.abs() <= LARGEST) {
                return Err(JobError::Range);
            }
            self.bytes(&v.to_le_bytes())?;
        }
        Ok(())
    }

    fn bytes(&mut self, bytes: &[u8]) -> Result<(), JobError> {
        for &byte in bytes {
            *self.out.get_mut(self.len).ok_or(JobError::Full)? = byte;
            self.len += 1;
            self.sum = crc(self.sum, byte);
        }
        Ok(())
    }
}
