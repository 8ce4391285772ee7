//! The one line on standard error that says what a run did.

use std::io::{self, Write};
use std::time::Instant;

use feature_sampling::geometry::Point;
use lineart::export::number::Readable;
use lineart::export::{PathRows, SampleRow};

use crate::engine::{Bounds, Door};

/// Parts of the line, joined when it is printed.
pub(crate) struct Summary {
    started: Instant,
    quiet: bool,
    parts: Vec<String>,
}

impl Summary {
    /// Starts the clock.
    pub(crate) fn start(quiet: bool) -> Self {
        Self { started: Instant::now(), quiet, parts: Vec::new() }
    }

    /// Adds a part; an empty one says nothing.
    pub(crate) fn say(&mut self, part: impl Into<String>) {
        self.parts.push(part.into());
    }

    /// What samples are like: how many, how far apart, where lfs is smallest, where a lower bound won.
    ///
    /// With --min-distance that is the floor; without it there is one of our own around corners.
    pub(crate) fn samples(&mut self, paths: &[PathRows<SampleRow>], bounds: &Bounds) {
        let rows = || paths.iter().flat_map(|path| &path.rows);
        let used = paths.iter().filter(|path| !path.rows.is_empty()).count();
        self.say(format!("{} on {}", count(rows().count(), "sample"), count(used, "path")));

        let place = |row: &SampleRow| Point::new(row.x, row.y);
        let gaps = paths.iter().flat_map(PathRows::edges).map(|(a, b)| place(a).distance(&place(b)));
        let (min, max) = gaps.fold((f64::INFINITY, 0.0_f64), |(min, max), gap| (min.min(gap), max.max(gap)));
        if min <= max {
            self.say(format!("gaps {} to {}", Readable(min), Readable(max)));
        }
        match rows().min_by(|a, b| a.lfs.total_cmp(&b.lfs)) {
            Some(row) if row.lfs.is_finite() => self.say(format!(
                "smallest lfs {} at ({}, {}), {}",
                Readable(row.lfs),
                Readable(row.x),
                Readable(row.y),
                location(row)
            )),
            Some(_) => self.say("lfs infinite: no medial axis"),
            None => {}
        }
        let won: Vec<_> = rows().filter(|row| matches!(row.bound, "min" | "floor")).collect();
        if !won.is_empty() {
            const SHOWN: usize = 3;
            let name = if bounds.min_distance.is_some() { "min-distance" } else { "the floor" };
            let places: Vec<_> = won.iter().take(SHOWN).map(|row| location(row)).collect();
            let more = if won.len() > SHOWN { "; …" } else { "" };
            self.say(format!("{name} won at {} ({}{more})", count(won.len(), "sample"), places.join("; ")));
        }
    }

    /// What was changed before anything was computed.
    pub(crate) fn door(&mut self, door: &Door) {
        let changes = door.changes();
        if !changes.is_empty() {
            self.say(format!("changed: {}", changes.join(", ")));
        }
    }

    /// Prints the line.
    pub(crate) fn print(mut self, source: &str) {
        if !self.quiet {
            let seconds = self.started.elapsed().as_secs_f64();
            self.say(format!("{seconds:.3} s"));
            drop(writeln!(io::stderr(), "fsample: {source}: {}", self.parts.join("; ")));
        }
    }
}

/// `1 path`, `2 paths`.
pub(crate) fn count(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

fn location(row: &SampleRow) -> String {
    format!("path {} segment {} t {}", row.path, row.segment, Readable(row.t))
}
