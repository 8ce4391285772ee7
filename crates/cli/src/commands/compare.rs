//! `fsample compare`: ε-samples beside other ways to flatten the same drawing.
//!
//! All lengths are in millimetres, on a drawing of its own size or of the size that `--diagonal` gives it: the other
//! methods have absolute tolerances, so that a comparison only means something at a size.

use std::io::{self, Write};

use lineart::drawing::{Drawing, DrawingPath};
use lineart::export::json::JsonText;
use lineart::export::number::{JsonNumber, Number, Readable};
use lineart::export::{PathRows, SampleRow};
use lineart::flatten::{self, Figures, Polyline, Vertex};
use lineart::stretch::Location;
use lineart::units::Length;

use crate::engine::{Bounds, Density, Engine};
use crate::errors::{Failure, warn};
use crate::input;
use crate::options::{CompareArgs, CompareFormat, above, resolve, share};
use crate::output::to_stdout;
use crate::progress::Progress;
use crate::summary::Summary;

/// CSS pixels in a millimetre.
const PX_PER_MM: f64 = 96.0 / 25.4;

/// The tolerance that firmware uses for G5, in millimetres.
const G5_TOLERANCE: f64 = 0.1;

/// Gaps below this share of the diagonal are nothing: the kernel drops segments that short, so the others may as well.
const SLIVER: f64 = 2e-6;

/// The most uniform steps per cubic that are tried.
const MOST_STEPS: u32 = 4096;

/// A line of the table.
struct Row {
    method: &'static str,
    setting: String,
    figures: Figures,
}

/// Prints the table.
pub(crate) fn run(args: &CompareArgs) -> Result<(), Failure> {
    let options = args.model.check()?;
    let epsilon = share("epsilon", args.epsilon)?;
    above("chord-error", 0.0, args.chord_error.value())?;
    above("piece", 0.0, args.piece.value())?;
    if let Some(length) = args.min_distance {
        above("min-distance", 0.0, length.value())?;
    }
    let quiet = args.model.quiet;
    let mut summary = Summary::start(quiet);
    let drawing = input::drawing(&args.input.file, quiet)?;
    let diagonal = Engine::diagonal(&drawing);
    let per_mm = user_units_per_mm(args, &drawing, diagonal)?;
    let user = |name, length: Length| resolve(name, length, Some(per_mm), diagonal);
    let chord_error = user("chord-error", args.chord_error)?;
    let piece = user("piece", args.piece)?;
    let min_distance = args.min_distance.map(|length| user("min-distance", length)).transpose()?;

    let engine = Engine::new(&drawing, &options)?;
    let progress = Progress::new("comparing", quiet);
    let mut rows: Vec<Row> = Vec::new();
    let total = 6 + u64::from(min_distance.is_some());
    let mut add = |method, setting: String, lines: Vec<Polyline>| {
        let cubics = drawing.paths.iter().map(|path| path.cubics.as_slice());
        let figures = flatten::figures(cubics.zip(&lines)).map_err(|error| Failure::input(&args.input.file, error))?;
        rows.push(Row { method, setting, figures });
        progress.of(rows.len() as u64, total);
        Ok(())
    };
    let sampled = |chord_error, min_distance| {
        let bounds = Bounds {
            density: Density::Epsilon(epsilon),
            chord_error,
            min_distance,
            max_distance: None,
            grading: None,
            start: 0.0,
            limit: args.max_samples,
        };
        engine.sample(&bounds).map(|paths| paths.iter().map(polyline).collect::<Vec<_>>())
    };
    let each = |flatten: &dyn Fn(&DrawingPath) -> Polyline| {
        drawing.paths.iter().map(|path| flatten(path).without_slivers(SLIVER * diagonal)).collect()
    };

    let epsilon_text = format!("epsilon {}", Number(epsilon));
    add("epsilon", epsilon_text.clone(), sampled(None, None)?)?;
    let chord_text = format!("{epsilon_text} chord {}", args.chord_error);
    add("epsilon+chord", chord_text.clone(), sampled(Some(chord_error), None)?)?;
    if let Some((smallest, length)) = min_distance.zip(args.min_distance) {
        add("epsilon+chord+min", format!("{chord_text} min {length}"), sampled(Some(chord_error), Some(smallest))?)?;
    }
    add(
        "greedy-chord",
        format!("chord {}", args.chord_error),
        each(&|path| flatten::by_chord_error(&path.cubics, path.closed, chord_error)),
    )?;
    let steps = flatten::steps_for(drawing.paths.iter().map(|path| path.cubics.as_slice()), chord_error, MOST_STEPS);
    add(
        "uniform",
        format!("{steps} steps per cubic"),
        each(&|path| flatten::uniform(&path.cubics, path.closed, steps)),
    )?;
    add(
        "pieces",
        format!("length {}", args.piece),
        each(&|path| flatten::by_length(&path.cubics, path.closed, piece)),
    )?;
    add(
        "g5-splitter",
        format!("midpoint {G5_TOLERANCE}mm"),
        each(&|path| flatten::by_midpoint(&path.cubics, path.closed, G5_TOLERANCE * per_mm)),
    )?;
    drop(progress);

    let table = Table { source: &args.input.file, diagonal: diagonal / per_mm, per_mm, rows: &rows };
    let written = to_stdout(|out| match args.format {
        CompareFormat::Text => table.text(out),
        CompareFormat::Csv => table.csv(out),
        CompareFormat::Json => table.json(out),
    });
    written.map_err(|error| Failure::output("-", &error))?;
    summary.say(format!("{} methods at a diagonal of {} mm", rows.len(), Readable(diagonal / per_mm)));
    summary.door(&engine.door());
    summary.print(&args.input.file);
    Ok(())
}

/// The scale of the comparison: --diagonal, or the drawing's own size, or 96 dpi.
fn user_units_per_mm(args: &CompareArgs, drawing: &Drawing, diagonal: f64) -> Result<f64, Failure> {
    match args.diagonal {
        Some(length) => {
            let mm = length.unit().in_mm().map(|unit| unit * length.value());
            match mm.map(|mm| diagonal / mm).filter(|per_mm| per_mm.is_finite() && *per_mm > 0.0) {
                Some(per_mm) => Ok(per_mm),
                None => Err(Failure::usage(format!("--diagonal is {length}; it needs a physical size, such as 150mm"))),
            }
        }
        None => Ok(drawing.user_units_per_mm.unwrap_or_else(|| {
            if !args.model.quiet {
                let message = "no physical size in the drawing: taken at 96 dpi; --diagonal gives it one";
                warn(format!("{}: {message}", args.input.file));
            }
            PX_PER_MM
        })),
    }
}

/// Samples as a polyline.
fn polyline(path: &PathRows<SampleRow>) -> Polyline {
    let vertex = |row: &SampleRow| Vertex {
        at: Location::new(row.segment as usize, row.t),
        point: feature_sampling::geometry::Point::new(row.x, row.y),
    };
    Polyline { closed: path.closed, vertices: path.rows.iter().map(vertex).collect() }
}

struct Table<'a> {
    source: &'a str,
    /// In millimetres.
    diagonal: f64,
    per_mm: f64,
    rows: &'a [Row],
}

impl Table<'_> {
    /// Largest chord error, grading, smallest and largest gap; lengths in millimetres.
    fn measures(&self, row: &Row) -> [f64; 4] {
        let Figures { chord_error, grading, min_gap, max_gap, .. } = row.figures;
        [chord_error / self.per_mm, grading, min_gap / self.per_mm, max_gap / self.per_mm]
    }

    fn text(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{} at a diagonal of {} mm; lengths in mm", self.source, Readable(self.diagonal))?;
        let head = ["method", "setting", "points", "chord error", "missing edges", "grading", "min gap", "max gap"];
        let lines: Vec<[String; 8]> = std::iter::once(head.map(str::to_owned))
            .chain(self.rows.iter().map(|row| {
                let [error, grading, min, max] = self.measures(row).map(|v| Readable(v).to_string());
                let Figures { points, missing, edges, .. } = row.figures;
                let missing = format!("{missing} of {edges}");
                [row.method.to_owned(), row.setting.clone(), points.to_string(), error, missing, grading, min, max]
            }))
            .collect();
        let width = |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0);
        let widths: [usize; 8] = std::array::from_fn(width);
        for line in &lines {
            let cells = line.iter().zip(widths).enumerate().map(|(column, (cell, width))| match column {
                // Words to the left, numbers to the right.
                0 | 1 => format!("{cell:<width$}"),
                _ => format!("{cell:>width$}"),
            });
            writeln!(out, "{}", cells.collect::<Vec<_>>().join("  "))?;
        }
        Ok(())
    }

    fn csv(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "method,setting,points,edges,chord_error_mm,missing_edges,grading,min_gap_mm,max_gap_mm")?;
        for row in self.rows {
            let [error, grading, min, max] = self.measures(row).map(Number);
            let Figures { points, edges, missing, .. } = row.figures;
            let Row { method, setting, .. } = row;
            writeln!(out, "{method},{setting},{points},{edges},{error},{missing},{grading},{min},{max}")?;
        }
        Ok(())
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        write!(out, "{{\n\"version\":1,\n\"source\":{},", JsonText(self.source))?;
        write!(out, "\n\"diagonal_mm\":{},\n\"methods\":[", JsonNumber(self.diagonal))?;
        for (i, row) in self.rows.iter().enumerate() {
            let [error, grading, min, max] = self.measures(row).map(JsonNumber);
            let Figures { points, edges, missing, .. } = row.figures;
            let (method, setting) = (JsonText(row.method), JsonText(&row.setting));
            write!(out, "{}\n{{\"method\":{method},\"setting\":{setting},", if i == 0 { "" } else { "," })?;
            write!(out, "\"points\":{points},\"edges\":{edges},\"chord_error_mm\":{error},")?;
            write!(out, "\"missing_edges\":{missing},\"grading\":{grading},")?;
            write!(out, "\"min_gap_mm\":{min},\"max_gap_mm\":{max}}}")?;
        }
        writeln!(out, "]\n}}")
    }
}
