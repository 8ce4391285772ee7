//! `fsample certify`.

use std::io::{self, Write};

use lineart::export::number::Readable;

use crate::engine::{Engine, Judged};
use crate::errors::Failure;
use crate::input;
use crate::options::CertifyArgs;
use crate::output::{Format, Target};
use crate::summary::{Summary, count};

/// Judges samples: proved, refuted or unknown.
pub(crate) fn run(args: &CertifyArgs) -> Result<(), Failure> {
    let target = args.output.as_deref().map(|output| Target::new(Some(output), None, &[Format::Json])).transpose()?;
    let options = args.model.check()?;
    let slack = args.check()?;
    if args.input.file == "-" && args.samples.as_deref() == Some("-") {
        return Err(Failure::usage("the drawing and the samples cannot both come from standard input"));
    }
    let quiet = args.model.quiet;
    let mut summary = Summary::start(quiet);
    let drawing = input::drawing(&args.input.file, quiet)?;
    let samples = args.samples.as_deref().map(input::samples).transpose()?;
    if let Some(target) = &target {
        target.check_folder()?;
    }
    let diagonal = Engine::diagonal(&drawing);
    let min_distance = args.min_distance(&drawing, diagonal)?;
    let engine = Engine::new(&drawing, &options)?;
    let judged = engine.certify(samples.as_deref(), args.epsilon, min_distance, slack, args.max_cells)?;
    if let Some(target) = &target {
        target.write(|out| write_certificate(out, &args.input.file, args.epsilon, min_distance, diagonal, &judged))?;
    }
    summary.say(count(judged.samples.len(), "sample"));
    summary.say(count(judged.pieces.len(), "piece"));
    summary.say(count(judged.cells, "cell"));
    summary.door(&engine.door());
    summary.print(&args.input.file);
    let answer = match (&judged.witness, judged.unknown()) {
        (Some(w), _) => format!(
            "refuted at ({}, {}), path {} segment {} t {}: the nearest sample is at {}, lfs at most {}",
            w.x,
            w.y,
            w.path,
            w.segment,
            w.t,
            Readable(w.distance),
            Readable(w.lfs)
        ),
        (None, 0) => "proved".to_owned(),
        (None, left) => format!("unknown: {} left", count(left, "piece")),
    };
    let mut out = io::stdout().lock();
    writeln!(out, "{answer}").map_err(|error| Failure::output("-", &error))?;
    if judged.proved() { Ok(()) } else { Err(Failure::no(format!("{}: {answer}", args.input.file))) }
}

/// The certificate as JSON.
fn write_certificate(
    out: &mut dyn Write,
    source: &str,
    epsilon: f64,
    min_distance: Option<f64>,
    diagonal: f64,
    judged: &Judged,
) -> io::Result<()> {
    let number = |v: f64| if v.is_finite() { format!("{v:?}") } else { "null".to_owned() };
    writeln!(out, "{{")?;
    writeln!(out, "  \"version\": \"{}\",", env!("CARGO_PKG_VERSION"))?;
    writeln!(out, "  \"source\": {source:?},")?;
    writeln!(out, "  \"scalar\": \"f64\",")?;
    writeln!(out, "  \"epsilon\": {},", number(epsilon))?;
    writeln!(out, "  \"min_distance\": {},", min_distance.map_or_else(|| "null".to_owned(), number))?;
    writeln!(out, "  \"diagonal\": {},", number(diagonal))?;
    writeln!(out, "  \"verdict\": \"{}\",", judged.verdict())?;
    if let Some(w) = &judged.witness {
        writeln!(
            out,
            "  \"witness\": {{\"path\": {}, \"segment\": {}, \"t\": {:?}, \"x\": {:?}, \"y\": {:?}, \"distance_at_least\": {:?}, \"lfs_at_most\": {:?}}},",
            w.path, w.segment, w.t, w.x, w.y, w.distance, w.lfs
        )?;
    }
    writeln!(out, "  \"door\": {{")?;
    let facts = judged.door.facts();
    for (i, (name, value)) in facts.iter().enumerate() {
        let comma = if i + 1 < facts.len() { "," } else { "" };
        writeln!(out, "    \"{name}\": {value:?}{comma}")?;
    }
    writeln!(out, "  }},")?;
    list(out, "samples", &judged.samples, |s| {
        format!(
            "{{\"path\": {}, \"segment\": {}, \"t\": {:?}, \"x\": {:?}, \"y\": {:?}}}",
            s.path, s.segment, s.t, s.x, s.y
        )
    })?;
    writeln!(out, ",")?;
    list(out, "neighbourhoods", &judged.neighbourhoods, |n| {
        format!(
            "{{\"path\": {}, \"segment\": {}, \"t\": {:?}, \"x\": {:?}, \"y\": {:?}, \"forwards\": {}, \"length\": {:?}}}",
            n.path, n.segment, n.t, n.x, n.y, n.forwards, n.length
        )
    })?;
    writeln!(out, ",")?;
    list(out, "pieces", &judged.pieces, |p| {
        format!(
            "{{\"path\": {}, \"segment\": {}, \"from\": {:?}, \"to\": {:?}, \"sample\": {}, \"reason\": \"{}\", \"lfs_at_least\": {}}}",
            p.path,
            p.segment,
            p.from,
            p.to,
            p.sample.map_or_else(|| "null".to_owned(), |s| s.to_string()),
            p.reason,
            p.lfs.map_or_else(|| "null".to_owned(), number)
        )
    })?;
    writeln!(out, "\n}}")
}

fn list<T>(out: &mut dyn Write, name: &str, items: &[T], row: impl Fn(&T) -> String) -> io::Result<()> {
    write!(out, "  \"{name}\": [")?;
    for (i, item) in items.iter().enumerate() {
        write!(out, "{}\n    {}", if i > 0 { "," } else { "" }, row(item))?;
    }
    write!(out, "\n  ]")
}
