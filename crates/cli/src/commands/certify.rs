//! `fsample certify`.

use std::io::{self, Write};

use fsample_recheck::Certificate;
use lineart::export::number::{Number, Readable};

use crate::engine::{self, Bounds, Engine, Fault, Judged};
use crate::errors::Failure;
use crate::input;
use crate::options::CertifyArgs;
use crate::output::{Format, Target};
use crate::summary::{Summary, count};

/// Judges samples: proved, refuted or unknown.
pub(crate) fn run(args: &CertifyArgs) -> Result<(), Failure> {
    if let Some(check) = &args.check {
        return recheck(args, check);
    }
    let target = args.output.as_deref().map(|output| Target::new(Some(output), None, &[Format::Json])).transpose()?;
    let options = args.model.check()?;
    let (epsilon, effort) = args.check()?;
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
    if args.effective {
        let found = match &samples {
            Some(samples) => engine.effective(samples, epsilon, min_distance, effort)?,
            None => engine.effective_of_placed(epsilon, min_distance, effort)?,
        };
        summary.door(&engine.door());
        summary.print(&args.input.file);
        return say(&format!("effective epsilon from {} to {}", Number(found.lower), Number(found.upper)));
    }
    let judged = match &samples {
        Some(samples) => engine.certify(samples, epsilon, min_distance, effort)?,
        None => engine.sample_certified(&Bounds::least(epsilon, min_distance), epsilon, effort)?.1,
    };
    if let Some(target) = &target {
        target.write(|out| judged.certificate.write(out, &about(&args.input.file, diagonal, &judged)))?;
    }
    summary.say(count(judged.certificate.samples.len(), "sample"));
    summary.say(count(judged.certificate.pieces.len(), "piece"));
    summary.say(count(judged.cells, "cell"));
    summary.door(&engine.door());
    summary.print(&args.input.file);
    let answer = match (&judged.witness, judged.unknown()) {
        (Some(w), _) => refuted(w),
        (None, 0) => "proved".to_owned(),
        (None, left) => format!("unknown: {} left", count(left, "piece")),
    };
    say(&answer)?;
    if judged.proved() { Ok(()) } else { Err(Failure::no(format!("{}: {answer}", args.input.file))) }
}

fn say(answer: &str) -> Result<(), Failure> {
    writeln!(io::stdout().lock(), "{answer}").map_err(|error| Failure::output("-", &error))
}

fn refuted(w: &Fault) -> String {
    format!(
        "refuted at ({}, {}), path {} segment {} t {}: the nearest sample is at {}, lfs at most {}",
        w.x,
        w.y,
        w.path,
        w.segment,
        w.t,
        Readable(w.distance),
        Readable(w.lfs)
    )
}

/// Re-checks a certificate.
fn recheck(args: &CertifyArgs, file: &str) -> Result<(), Failure> {
    if file == "-" && (args.input.file == "-" || args.samples.as_deref() == Some("-")) {
        return Err(Failure::usage("only one of the drawing, the samples and the certificate can be standard input"));
    }
    let quiet = args.model.quiet;
    let mut summary = Summary::start(quiet);
    let drawing = input::drawing(&args.input.file, quiet)?;
    let samples = args.samples.as_deref().map(input::samples).transpose()?;
    let certificate = Certificate::read(&input::text(file)?).map_err(|cause| Failure::input(file, cause))?;
    let epsilon = certificate.epsilon;
    let answer = if args.epsilon.is_some_and(|asked| asked < epsilon) {
        Err(format!("it is about ε = {epsilon}"))
    } else {
        engine::recheck(&drawing, &certificate, samples.as_deref())?
    };
    summary.say(format!("ε = {epsilon}"));
    if let Some(floor) = certificate.min_distance {
        summary.say(format!("floor {}", Readable(floor)));
    }
    summary.say(count(certificate.samples.len(), "sample"));
    summary.say(count(certificate.pieces.len(), "piece"));
    if let Ok(shown) = &answer {
        summary.say(count(shown.claims, "claim") + " evaluated");
    }
    summary.print(file);
    let shown = answer.map_err(|cause| Failure::no(format!("{file}: rejected: {cause}")))?;
    let answer = shown.fault.as_ref().map_or_else(|| "proved".to_owned(), refuted);
    say(&answer)?;
    if shown.fault.is_none() { Ok(()) } else { Err(Failure::no(format!("{file}: {answer}"))) }
}

/// What a certificate says for people; no check looks at it.
fn about(source: &str, diagonal: f64, judged: &Judged) -> Vec<(&'static str, String)> {
    let facts = judged.door.facts().map(|(name, value)| format!("\"{name}\": {value:?}")).join(", ");
    let segments: Vec<String> =
        judged.segments.iter().map(|(p, s, a, b)| format!("[{p}, {s}, {a:?}, {b:?}]")).collect();
    let mut about = vec![
        ("version", format!("{:?}", env!("CARGO_PKG_VERSION"))),
        ("source", format!("{source:?}")),
        ("diagonal", format!("{diagonal:?}")),
        ("floor", format!("{:?}", fsample_recheck::FLOOR)),
        ("singular_floor", format!("{:?}", fsample_recheck::SINGULAR_FLOOR)),
        ("door", format!("{{{facts}}}")),
        ("sources", format!("[{}]", segments.join(", "))),
    ];
    if let Some(Fault { path, segment, t, x, y, .. }) = &judged.witness {
        let place = format!("{{\"path\": {path}, \"segment\": {segment}, \"t\": {t:?}, \"x\": {x:?}, \"y\": {y:?}}}");
        about.push(("witness_at", place));
    }
    about
}
