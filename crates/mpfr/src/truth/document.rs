//! `docs/accuracy.md`, made from the table.

use std::fmt::Write;

use super::table::TABLE;
use super::{Entry, Kind, Measured};

/// A number of ulps as documents show it.
pub fn shown(ulps: f64) -> String {
    match ulps {
        0.0 => "0".to_owned(),
        u if u < 10.0 => format!("{u:.2}"),
        u if u < 1e5 => format!("{u:.0}"),
        u => format!("{u:.0e}"),
    }
}

/// A row for a measured function; `worst` gives the measured errors, or nothing.
fn row(out: &mut String, entry: &Entry, measured: &Measured, worst: Option<[f64; 2]>) {
    let [single, double] = measured.allowed.map(shown);
    let size = measured.size.replace('|', "\\|");
    // Writing to a string cannot fail.
    let _ = write!(out, "| `{}` | {size} | {single} | {double} |", entry.function);
    if let Some(worst) = worst {
        let [single, double] = worst.map(shown);
        let _ = write!(out, " {single} | {double} |");
    }
    out.push('\n');
}

/// The part about single functions. Without `measure` the columns of measured errors are left out: what is left follows from
/// the table alone and has to agree with what is committed.
pub fn functions(measure: bool) -> String {
    let mut out = String::from("| function | an ulp is relative to | f32 allowed | f64 allowed |");
    out.push_str(if measure { " f32 measured | f64 measured |\n" } else { "\n" });
    out.push_str(if measure { "|---|---|---|---|---|---|\n" } else { "|---|---|---|---|\n" });
    for entry in TABLE {
        if let Kind::Measured(measured) = &entry.kind {
            row(&mut out, entry, measured, measure.then(|| [measured.worst(0), measured.worst(1)]));
        }
    }
    out
}

/// Functions that do not round, and functions that leave rounding to others.
pub fn others() -> String {
    let mut out = String::from("| function | errors |\n|---|---|\n");
    for entry in TABLE {
        match entry.kind {
            Kind::Exact(why) => {
                let _ = writeln!(out, "| `{}` | none: {why} |", entry.function);
            }
            Kind::Through(other) => {
                let _ = writeln!(out, "| `{}` | those of `{other}` |", entry.function);
            }
            Kind::Encloses(how) => {
                let _ = writeln!(out, "| `{}` | encloses the exact result, {how} |", entry.function);
            }
            Kind::Bounded(how) => {
                let _ = writeln!(out, "| `{}` | {how} |", entry.function);
            }
            Kind::Measured(_) => {}
        }
    }
    out
}

/// The rows of a committed document without the columns of measured errors.
pub fn without_measured(document: &str) -> Vec<String> {
    let rows = document.lines().filter(|line| line.starts_with("| `") || line.starts_with("| function |"));
    rows.map(|line| {
        let line = line.replace("\\|", "\u{0}");
        let cells: Vec<&str> = line.split('|').collect();
        // Leading and trailing bar make an empty cell each.
        let kept = if cells.len() == 8 { &cells[..5] } else { &cells[..cells.len() - 1] };
        (kept.join("|") + "|").replace('\u{0}', "\\|")
    })
    .collect()
}
