//! Running some of the units, keeping what they found, putting it together.
//!
//! Shard I of N (I from 1) does the units i with i ≡ I − 1 modulo N. What it found is a small table: three header lines that
//! say which experiment it is part of, then `unit,name,value` with one finding a line, values in shortest round-trip form.
//! Merging checks that all parts answer the same question and that each unit is there exactly once.

use std::collections::BTreeMap;
use std::fmt;
use std::io::{self, Write};
use std::str::FromStr;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use crate::{Experiment, ExperimentError, Finding, Report};

/// First line of a shard file.
const MAGIC: &str = "# fsample reproduce, shard, layout 1";

/// Which part of the units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// From 1 to `of`.
    pub index: u32,
    /// Number of shards.
    pub of: u32,
}

impl Shard {
    /// Everything.
    pub const WHOLE: Self = Self { index: 1, of: 1 };

    /// The units of this shard, ascending.
    pub fn units(self, all: u32) -> impl Iterator<Item = u32> {
        (self.index - 1..all).step_by(self.of as usize)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match parts {
            Some((index, of)) if (1..=of).contains(&index) => Ok(Self { index, of }),
            _ => Err("write I/N with 1 ≤ I ≤ N, such as 2/8".to_owned()),
        }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

/// What some units of an experiment found.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    experiment: String,
    fingerprint: String,
    units: u32,
    findings: BTreeMap<u32, Vec<Finding>>,
}

/// Does the units of a shard, on at most `threads` threads (one, if the experiment is timed). `progress` is told how many
/// of how many units are done, in whatever order they end; the result does not depend on the threads.
///
/// # Errors
/// That of the first unit, in order, among those that failed; the rest is not begun.
pub fn run(
    experiment: &dyn Experiment,
    shard: Shard,
    threads: usize,
    progress: &(dyn Fn(u64, u64) + Sync),
) -> Result<Part, ExperimentError> {
    let mine: Vec<u32> = shard.units(experiment.units()).collect();
    let threads = if experiment.timed() { 1 } else { threads.clamp(1, mine.len().max(1)) };
    let (next, failed) = (AtomicUsize::new(0), AtomicBool::new(false));
    let done = Mutex::new(Vec::new());
    let worker = || {
        while !failed.load(Ordering::Relaxed) {
            let Some(&unit) = mine.get(next.fetch_add(1, Ordering::Relaxed)) else { break };
            let found = experiment.run(unit);
            if found.is_err() {
                failed.store(true, Ordering::Relaxed);
            }
            // A thread that panicked takes the whole run with it when the scope ends.
            let Ok(mut done) = done.lock() else { break };
            done.push((unit, found));
            progress(done.len() as u64, mine.len() as u64);
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(worker);
        }
        worker();
    });
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_by_key(|(unit, _)| *unit);
    let findings = done.into_iter().map(|(unit, found)| Ok((unit, found?))).collect::<Result<_, ExperimentError>>()?;
    Ok(Part {
        experiment: experiment.name().to_owned(),
        fingerprint: experiment.fingerprint(),
        units: experiment.units(),
        findings,
    })
}

impl Part {
    /// Name of the experiment that it is part of.
    pub fn experiment(&self) -> &str {
        &self.experiment
    }

    /// Writes the shard file.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{MAGIC}\n# {} of {} units\n# {}", self.experiment, self.units, self.fingerprint)?;
        writeln!(out, "unit,name,value")?;
        for (unit, findings) in &self.findings {
            if findings.is_empty() {
                // The unit was done although it found nothing.
                writeln!(out, "{unit},,")?;
            }
            for Finding { name, value } in findings {
                writeln!(out, "{unit},{name},{value}")?;
            }
        }
        Ok(())
    }

    /// Reads a shard file; `name` is that of the file, for messages.
    ///
    /// # Errors
    /// Names the file, the line and what is wrong with it.
    pub fn read(text: &str, name: &str) -> Result<Self, ExperimentError> {
        let bad = |line: usize, cause: &str| ExperimentError::new(format!("{name}: line {line}: {cause}"));
        let mut lines = text.lines();
        if lines.next() != Some(MAGIC) {
            return Err(bad(1, "this is no shard of `fsample reproduce`"));
        }
        let about = lines.next().and_then(|line| line.strip_prefix("# ")).and_then(|line| line.strip_suffix(" units"));
        let (experiment, units) = about
            .and_then(|line| line.split_once(" of "))
            .and_then(|(experiment, units)| Some((experiment.to_owned(), units.parse().ok()?)))
            .ok_or_else(|| bad(2, "the experiment and its number of units are missing"))?;
        let fingerprint = lines.next().and_then(|line| line.strip_prefix("# "));
        let fingerprint = fingerprint.ok_or_else(|| bad(3, "the fingerprint is missing"))?.to_owned();
        if lines.next() != Some("unit,name,value") {
            return Err(bad(4, "the header unit,name,value is missing"));
        }
        let mut findings: BTreeMap<u32, Vec<Finding>> = BTreeMap::new();
        for (line, content) in (5..).zip(lines) {
            let mut fields = content.split(',');
            let (Some(unit), Some(name), Some(value), None) =
                (fields.next(), fields.next(), fields.next(), fields.next())
            else {
                return Err(bad(line, "there have to be three fields"));
            };
            let unit: u32 = unit.parse().map_err(|_| bad(line, "the unit is no number"))?;
            if unit >= units {
                return Err(bad(line, "there is no such unit"));
            }
            let of_unit = findings.entry(unit).or_default();
            if !(name.is_empty() && value.is_empty()) {
                let value = value.parse().map_err(|_| bad(line, "the value is no number"))?;
                of_unit.push(Finding::new(name, value));
            }
        }
        Ok(Self { experiment, fingerprint, units, findings })
    }
}

/// The report of an experiment from all of its parts. Each part comes with a name for messages.
///
/// # Errors
/// Names the part that does not fit, or the first unit that is missing or there twice.
pub fn merge(experiment: &dyn Experiment, parts: Vec<(String, Part)>) -> Result<Report, ExperimentError> {
    let mut all: BTreeMap<u32, Vec<Finding>> = BTreeMap::new();
    for (name, part) in parts {
        if part.experiment != experiment.name() {
            let message = format!("{name}: it is part of {}, not of {}", part.experiment, experiment.name());
            return Err(ExperimentError::new(message));
        }
        if part.fingerprint != experiment.fingerprint() || part.units != experiment.units() {
            let message = format!("{name}: it was made from other curves or with other options");
            return Err(ExperimentError::new(message));
        }
        for (unit, findings) in part.findings {
            if all.insert(unit, findings).is_some() {
                return Err(ExperimentError::new(format!("{name}: unit {unit} is in another shard already")));
            }
        }
    }
    for unit in 0..experiment.units() {
        if !all.contains_key(&unit) {
            let message = format!("unit {unit} of {} is in none of the shards", experiment.units());
            return Err(ExperimentError::new(message));
        }
    }
    experiment.report(&all.into_values().collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Cell, Table};

    /// Squares of the units.
    struct Squares(u32);

    impl Experiment for Squares {
        fn name(&self) -> &'static str {
            "squares"
        }

        fn fingerprint(&self) -> String {
            format!("up to {}", self.0)
        }

        fn units(&self) -> u32 {
            self.0
        }

        fn run(&self, unit: u32) -> Result<Vec<Finding>, ExperimentError> {
            let third = f64::from(unit) / 3.0;
            Ok(if unit == 1 { vec![] } else { vec![Finding::new("square", third * third)] })
        }

        fn report(&self, findings: &[Vec<Finding>]) -> Result<Report, ExperimentError> {
            let mut table = Table::new("squares", "Squares", &["square"]);
            for found in findings {
                table.rows.push(vec![Cell::number(found.first().map_or(0.0, |finding| finding.value))]);
            }
            Ok(Report { name: "squares", tables: vec![table], plots: vec![], bars: vec![], pictures: vec![] })
        }
    }

    fn part(n: u32, shard: &str) -> Part {
        run(&Squares(n), shard.parse().expect("a shard"), 2, &|_, _| ()).expect("done")
    }

    #[test]
    fn parts_make_the_whole() {
        let whole = merge(&Squares(7), vec![("whole".into(), part(7, "1/1"))]).expect("a report");
        let parts = ["3/3", "1/3", "2/3"].map(|shard| {
            let mut text = Vec::new();
            part(7, shard).write(&mut text).expect("written");
            let text = String::from_utf8(text).expect("text");
            (shard.to_owned(), Part::read(&text, shard).expect("read back"))
        });
        let merged = merge(&Squares(7), parts.to_vec()).expect("a report");
        assert_eq!(merged.csv(), whole.csv(), "to the byte");
    }

    #[test]
    fn what_does_not_fit() {
        let message = |n, parts: &[(u32, &str)]| {
            let parts = parts.iter().map(|(n, shard)| (format!("{n}:{shard}"), part(*n, shard))).collect();
            merge(&Squares(n), parts).expect_err("does not fit").to_string()
        };
        assert_eq!(message(7, &[(7, "1/2")]), "unit 1 of 7 is in none of the shards");
        assert_eq!(message(7, &[(7, "1/1"), (7, "2/2")]), "7:2/2: unit 1 is in another shard already");
        assert_eq!(message(7, &[(8, "1/1")]), "8:1/1: it was made from other curves or with other options");
        for wrong in ["0/3", "4/3", "1", "a/b", "1/0"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
        let error = Part::read(&format!("{MAGIC}\n# squares of 2 units\n# up to 2\nunit,name,value\n5,a,1\n"), "x.csv");
        assert_eq!(error.expect_err("no unit 5").to_string(), "x.csv: line 5: there is no such unit");
    }
}
