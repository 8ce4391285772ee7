//! The kernel in arbitrary precision, from the command line. `fsample-mpfr` without arguments says what it does.
//!
//! Exit codes as those of `fsample`: 0 done, 1 bounds that do not agree, 2 usage, 3 bad input, 4 output could not be written.

mod page;

use std::error::Error;
use std::fmt::Display;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use feature_sampling::curve::{CurveParam, nearest};
use feature_sampling::geometry::Point;
use feature_sampling::scalar::Scalar;
use feature_sampling_mpfr::Mpfr;
use feature_sampling_mpfr::enclosures::{self, Compared, Question};
use feature_sampling_mpfr::ladder::{self, AtPrecision, RUNGS};
use fsample_oracle::feature_size::{Oracle, Stroke};
use fsample_oracle::verdict;
use lineart::text_in;

const HELP: &str = "\
The kernel of fsample in arbitrary precision (MPFR).

  fsample-mpfr lfs DRAWING [--at POINTS | --along N] [--bits B]
      lfs to nearly all digits of B bits (default 128): at the points of a file, one `x y` or `x,y` a line, or at N places
      a cubic (default 4). A table path,segment,t,x,y,lfs,mx,my,polylines goes to standard output: (mx, my) is the medial
      point found, and polylines the distance to the coarse polylines that said where to look. lfs is the distance to a
      point of the medial axis: never below the true value but for rounding.
  fsample-mpfr ladder DRAWING [--along N]
      the same at every precision from 64 to 1024 bits: how far each is from the highest.
  fsample-mpfr enclosures DRAWING [--points N] [--width W]
      proved bounds of lfs in f64 and in 128 bits, at N random points (default 10), W of the upper bound apart (default 0.05),
      and what the judge of `lfs` finds: a table, then how many do not agree. Exit code 1 if any.
  fsample-mpfr verdicts [--curves N] [--from SEED]
      N random small curves (default 100), each from a seed of its own, with samples that are good as often as not: what is
      proved or refuted in f64 is compared in 128 bits at the worst point of every gap. Exit code 1 at the first false verdict.
  fsample-mpfr accuracy
      docs/accuracy.md; FSAMPLE_DATA names a folder with drawings/ and truth/.

Options: --tolerance T of the coarse polylines (default 1e-4; 0.01 for enclosures), --corner-angle DEG below which joints are smooth (default 1).
";

/// Why nothing came of it, and the exit code.
struct Failure(u8, String);

impl Failure {
    fn usage(message: impl Display) -> Self {
        Self(2, message.to_string())
    }

    fn input(file: &Path, cause: impl Display) -> Self {
        // Some causes name their file already.
        let (name, cause) = (file.display().to_string(), cause.to_string());
        Self(3, if cause.starts_with(&name) { cause } else { format!("{name}: {cause}") })
    }
}

/// What was asked for.
struct Options {
    drawing: PathBuf,
    at: Option<PathBuf>,
    along: u32,
    bits: u32,
    tolerance: f64,
    corner_angle: f64,
    points: u32,
    width: f64,
}

/// The commands that take a drawing.
#[derive(Clone, Copy, PartialEq)]
enum Command {
    Lfs,
    Ladder,
    Enclosures,
}

impl Options {
    /// The defaults.
    fn of(command: Command) -> Self {
        let tolerance = if command == Command::Enclosures { 0.01 } else { 1e-4 };
        let (corner_angle, drawing) = (1.0, PathBuf::new());
        Self { drawing, at: None, along: 4, bits: 128, tolerance, corner_angle, points: 10, width: 0.05 }
    }

    fn parse(arguments: &[String], command: Command) -> Result<Self, Failure> {
        let (mut drawing, mut along) = (None, None);
        let mut options = Self::of(command);
        let mut rest = arguments.iter();
        while let Some(argument) = rest.next() {
            let mut value = || rest.next().ok_or_else(|| Failure::usage(format!("{argument} needs a value")));
            let number = |text: &String, low: f64, high: f64| match text.parse::<f64>() {
                Ok(v) if v >= low && v <= high => Ok(v),
                _ => Err(Failure::usage(format!("{argument} {text}: a number from {low} to {high} is needed"))),
            };
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "in the range just checked")]
            let whole = |text: &String, high: f64| number(text, 1.0, high).map(|v| v as u32);
            match argument.as_str() {
                "--at" if command == Command::Lfs => options.at = Some(PathBuf::from(value()?)),
                "--along" if command != Command::Enclosures => along = Some(whole(value()?, 1e6)?),
                "--bits" if command == Command::Lfs => options.bits = whole(value()?, 1024.0)?,
                "--points" if command == Command::Enclosures => options.points = whole(value()?, 1e6)?,
                "--width" if command == Command::Enclosures => options.width = number(value()?, 1e-6, 0.5)?,
                "--tolerance" => options.tolerance = number(value()?, 1e-9, 0.1)?,
                "--corner-angle" => options.corner_angle = number(value()?, 0.0, 180.0)?,
                option if option.starts_with("--") => return Err(Failure::usage(format!("unknown option {option}"))),
                file if drawing.is_none() => drawing = Some(PathBuf::from(file)),
                more => return Err(Failure::usage(format!("one drawing at a time, not {more} as well"))),
            }
        }
        if options.at.is_some() && along.is_some() {
            return Err(Failure::usage("--at and --along exclude each other"));
        }
        options.drawing = drawing.ok_or_else(|| Failure::usage("which drawing?"))?;
        options.along = along.unwrap_or(options.along);
        Ok(options)
    }
}

/// A place that is asked about.
enum Place {
    /// A point of the plane.
    Point(Point<f64>),
    /// A parameter of a segment of the curve, as a fraction.
    Along(u32, i32, i32),
}

/// A row of the table, in one precision.
struct Row<S> {
    place: String,
    point: Point<S>,
    lfs: S,
    medial: Option<Point<S>>,
    polylines: S,
}

/// lfs at places of a drawing.
struct Job<'j> {
    strokes: &'j [Stroke],
    options: &'j Options,
    points: Option<&'j [Point<f64>]>,
}

impl Job<'_> {
    fn rows<S: Scalar>(&self) -> Result<Vec<Row<S>>, Failure> {
        let Options { drawing, along, tolerance, corner_angle, .. } = self.options;
        let oracle = Oracle::<S>::new(self.strokes, *corner_angle, *tolerance)
            .map_err(|error| Failure::input(drawing, error))?;
        let curve = oracle.curve().curve();
        let places: Vec<Place> = match self.points {
            Some(points) => points.iter().cloned().map(Place::Point).collect(),
            None => {
                let count = i32::try_from(*along).unwrap_or(i32::MAX);
                let of = |segment| (0..count).map(move |i| Place::Along(segment, 2 * i + 1, 2 * count));
                (0..).zip(curve.segments).flat_map(|(segment, _)| of(segment)).collect()
            }
        };
        let row = |place: &Place| {
            let (at, point) = match place {
                Place::Point(p) => {
                    let p = Point::from_f64(p.x, p.y);
                    let near = nearest::nearest(&curve, &p, S::infinity())?;
                    (near.at, p)
                }
                Place::Along(segment, num, den) => {
                    let at = CurveParam { segment: *segment, t: S::ratio(*num, *den) };
                    let point = curve.point(&at)?;
                    (at, point)
                }
            };
            let (path, segment, t) = oracle.curve().source(&at);
            let found = oracle.lfs(&point);
            let place = format!("{path},{segment},{}", t.to_f64());
            Some(Row { place, point, lfs: found.lfs, medial: found.medial, polylines: found.polylines })
        };
        Ok(places.iter().filter_map(row).collect())
    }
}

/// The table of `lfs`.
struct Printed<'j>(Job<'j>);

impl AtPrecision for Printed<'_> {
    type Out = Result<String, Failure>;

    fn run<S: Scalar + Display>(self) -> Self::Out {
        let mut out = String::from("path,segment,t,x,y,lfs,mx,my,polylines\n");
        for Row { place, point, lfs, medial, polylines } in self.0.rows::<S>()? {
            let medial = medial.map_or_else(|| ",".to_owned(), |m| format!("{},{}", m.x, m.y));
            out.push_str(&format!("{place},{},{},{lfs},{medial},{polylines}\n", point.x, point.y));
        }
        Ok(out)
    }
}

/// lfs at a rung, as numbers of the highest precision.
struct Rung<'j>(Job<'j>);

type Highest = Mpfr<1024>;

impl AtPrecision for Rung<'_> {
    type Out = Result<Vec<Highest>, Failure>;

    fn run<S: Scalar + Display>(self) -> Self::Out {
        let lift = |v: &S| {
            // Decimal and back: Display writes as many digits as the precision has.
            let parsed = rug::Float::parse(v.to_string()).map(|p| rug::Float::with_val(1024, p));
            parsed.map_or_else(|_| Highest::infinity(), |v| Highest::from_float(&v))
        };
        Ok(self.0.rows::<S>()?.iter().map(|row| lift(&row.lfs)).collect())
    }
}

fn lfs(options: &Options) -> Result<String, Failure> {
    let points = options.at.as_deref().map(read_points).transpose()?;
    let strokes = read(&options.drawing)?;
    let job = Job { strokes: &strokes, options, points: points.as_deref() };
    let done = ladder::at(options.bits, Printed(job));
    done.unwrap_or_else(|| Err(Failure::usage(format!("--bits {}: at most 1024", options.bits))))
}

fn ladder(options: &Options) -> Result<String, Failure> {
    let strokes = read(&options.drawing)?;
    let mut rungs = Vec::new();
    for bits in RUNGS {
        let start = Instant::now();
        let job = Job { strokes: &strokes, options, points: None };
        let values = ladder::at(bits, Rung(job)).unwrap_or_else(|| Err(Failure::usage("no such rung")))?;
        eprintln!("{bits} bits: {} places, {:.1} s", values.len(), start.elapsed().as_secs_f64());
        rungs.push((bits, values));
    }
    let Some((_, truth)) = rungs.last().cloned() else { return Ok(String::new()) };
    let mut out = String::from("bits,places,largest_relative_difference\n");
    for (bits, values) in &rungs {
        // As floats of MPFR: 2^−1024 is nearly below what a double holds.
        let differences = values.iter().zip(&truth).filter(|(_, b)| b.is_finite());
        let exact = |a: &Highest, b: &Highest| {
            let difference = rug::Float::with_val(64, a.as_float() - b.as_float()).abs();
            difference / b.as_float()
        };
        let largest = differences.map(|(a, b)| exact(a, b)).fold(rug::Float::new(64), |m, d| m.max(&d));
        out.push_str(&format!("{bits},{},{largest:.2e}\n", values.len()));
    }
    Ok(out)
}

/// The table, and whether all rows agree.
fn compared(options: &Options) -> Result<(String, bool), Failure> {
    let strokes = read(&options.drawing)?;
    let Options { corner_angle: corner_degrees, tolerance, width: share, points, .. } = *options;
    let question = Question { corner_degrees, tolerance, share, points, seed: 1 };
    let rows = enclosures::compare(&strokes, &question).map_err(|error| Failure::input(&options.drawing, error))?;
    let mut out = String::from("x,y,lower,upper,lower_128,upper_128,judge,agrees\n");
    for row in &rows {
        let Compared { at, plain: [a, b], wide: [c, d], judge } = row;
        out.push_str(&format!("{},{},{a},{b},{c},{d},{judge},{}\n", at.x, at.y, row.agrees()));
    }
    let apart = rows.iter().filter(|row| !row.agrees()).count();
    eprintln!("{}: {} points, {apart} do not agree", options.drawing.display(), rows.len());
    Ok((out, apart == 0))
}

/// Counts of verdicts, or the first false one and exit code 1.
fn verdicts(arguments: &[String]) -> Result<(String, ExitCode), Failure> {
    let (mut curves, mut from) = (100_u64, 0_u64);
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        let mut value = || rest.next().and_then(|text| text.parse().ok()).filter(|v: &u64| *v <= 1 << 40);
        let place = match argument.as_str() {
            "--curves" => &mut curves,
            "--from" => &mut from,
            other => return Err(Failure::usage(format!("unknown option {other}"))),
        };
        *place = value().ok_or_else(|| Failure::usage(format!("{argument}: a whole number up to 2^40 is needed")))?;
    }
    let (mut counts, end) = (verdict::Counts::default(), from + curves);
    while from < end {
        let next = end.min(from + 100);
        match verdict::survey::<Mpfr<128>>(from..next) {
            Ok(more) => counts += more,
            Err(cause) => return Ok((format!("{cause}\n"), ExitCode::from(1))),
        }
        eprintln!("up to seed {next}: {counts:?}");
        from = next;
    }
    let verdict::Counts { rejected, proved, refuted, unknown, points } = counts;
    let text = format!("rejected,proved,refuted,unknown,points\n{rejected},{proved},{refuted},{unknown},{points}\n");
    Ok((text, ExitCode::SUCCESS))
}

fn read(file: &Path) -> Result<Vec<Stroke>, Failure> {
    let drawing = lineart::drawing::load(file).map_err(|error| Failure::input(file, error))?;
    if drawing.paths.is_empty() {
        return Err(Failure::input(file, "there is no curve in it"));
    }
    Ok(drawing.paths.into_iter().map(|path| (path.closed, path.cubics)).collect())
}

fn read_points(file: &Path) -> Result<Vec<Point<f64>>, Failure> {
    let text = text_in::read_file(file).map_err(|error| Failure::input(file, error))?;
    let mut points = Vec::new();
    for (line, content) in (1..).zip(text.lines()) {
        let content = content.split('#').next().unwrap_or_default();
        let fields = content.split(|c: char| c == ',' || c.is_whitespace()).filter(|field| !field.is_empty());
        let numbers: Vec<Option<f64>> =
            fields.map(|field| field.parse().ok().filter(|v: &f64| v.is_finite())).collect();
        match numbers.as_slice() {
            [] => {}
            [Some(x), Some(y)] => points.push(Point::new(*x, *y)),
            // A header.
            [None, None] if points.is_empty() => {}
            _ => return Err(Failure::input(file, format!("line {line}: write “x y” or “x,y”"))),
        }
    }
    Ok(points)
}

/// What is to be printed, and the exit code.
fn run(arguments: &[String]) -> Result<(String, ExitCode), Failure> {
    let done = |text: String| (text, ExitCode::SUCCESS);
    match arguments.split_first() {
        None => Ok(done(HELP.to_owned())),
        Some((first, _)) if matches!(first.as_str(), "help" | "--help" | "-h") => Ok(done(HELP.to_owned())),
        Some((first, rest)) if first == "lfs" => lfs(&Options::parse(rest, Command::Lfs)?).map(done),
        Some((first, rest)) if first == "ladder" => ladder(&Options::parse(rest, Command::Ladder)?).map(done),
        Some((first, rest)) if first == "enclosures" => {
            let (text, agree) = compared(&Options::parse(rest, Command::Enclosures)?)?;
            Ok((text, ExitCode::from(u8::from(!agree))))
        }
        Some((first, rest)) if first == "verdicts" => verdicts(rest),
        Some((first, [])) if first == "accuracy" => {
            page::accuracy().map(done).map_err(|error: Box<dyn Error>| Failure(3, error.to_string()))
        }
        Some((first, _)) => Err(Failure::usage(format!("{first}: lfs, ladder, enclosures, verdicts or accuracy"))),
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok((text, code)) => match io::stdout().lock().write_all(text.as_bytes()) {
            Ok(()) => code,
            // The reader of a pipe left early.
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
            Err(error) => {
                eprintln!("fsample-mpfr: standard output: {error}");
                ExitCode::from(4)
            }
        },
        Err(Failure(code, message)) => {
            eprintln!("fsample-mpfr: {message}");
            ExitCode::from(code)
        }
    }
}
