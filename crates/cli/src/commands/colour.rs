//! `fsample colour`: colours between strokes that leave gaps.

use std::path::Path;

use lineart::colour::{self, Auto, Colour, Hint, Layers, Options, Painting, Unlabelled};
use lineart::drawing::Drawing;
use lineart::export::control_box;
use lineart::export::svg::Picture;
use lineart::node;
use lineart::units::Length;

use crate::engine::Engine;
use crate::errors::{Failure, warn};
use crate::input;
use crate::options::{ColourArgs, UnlabelledName, above, resolve};
use crate::output::{Format, Target};
use crate::progress::Progress;
use crate::summary::{Summary, count};

/// Colours a drawing.
pub(crate) fn run(args: &ColourArgs) -> Result<(), Failure> {
    let target = target(args.output.as_deref(), Format::Svg)?;
    let report = args.report.as_deref().map(|file| self::target(Some(file), Format::Json)).transpose()?;
    args.sampling.check()?;
    let model = args.model.check()?;
    if !(args.gamma > 0.0 && args.gamma <= 1.0) {
        return Err(Failure::usage(format!("--gamma is {}; it lies above 0 and is at most 1", args.gamma)));
    }
    if args.input.file == "-" && args.hints.as_deref() == Some("-") {
        return Err(Failure::usage("the drawing and the hints cannot both come from standard input"));
    }

    let quiet = args.model.quiet;
    let mut summary = Summary::start(quiet);
    let (mut drawing, text) = input::drawing_and_text(&args.input.file, quiet)?;
    let is_svg = text.trim_start_matches('\u{feff}').trim_start().starts_with('<');
    let layer = args.hint_layer.as_deref().unwrap_or("hints");
    let (mut hints, unread) = colour::from_layer(&mut drawing, layer);
    if args.hint_layer.is_some() && hints.is_empty() && unread.is_empty() {
        return Err(Failure::input(&args.input.file, format!("there is no hint in a layer “{layer}”")));
    }
    for warning in unread.iter().filter(|_| !quiet) {
        warn(format!("{}: {warning}", args.input.file));
    }
    hints.extend(given(args)?);
    if args.auto {
        hints.clear();
    } else if hints.is_empty() {
        let ways = "give --hint X,Y,COLOUR, --hints FILE or a layer “hints” in the drawing, or ask for --auto";
        return Err(Failure::usage(format!("there are no hints: {ways}")));
    }
    let background = take_background(&mut drawing);
    if drawing.paths.is_empty() {
        return Err(Failure::input(&args.input.file, "there is nothing in it but hints"));
    }
    let diagonal = Engine::diagonal(&drawing);
    let bounds = args.sampling.bounds(&drawing, diagonal)?;
    let length = |name, length: Option<Length>| -> Result<f64, Failure> {
        let Some(length) = length else { return Ok(0.0) };
        above(name, 0.0, length.value())?;
        resolve(name, length, drawing.user_units_per_mm, diagonal)
    };
    let (max_gap, bleed) = (length("max-gap", args.max_gap)?, length("bleed", args.bleed)?);
    target.check_folder()?;
    report.as_ref().map_or(Ok(()), Target::check_folder)?;

    let engine = Engine::new(&drawing, &model)?;
    let progress = Progress::new("sampling", quiet);
    let rows = engine.sample(&bounds)?;
    drop(progress);
    let options = Options {
        outside: !args.no_outside,
        max_gap,
        unlabelled: match args.unlabelled {
            UnlabelledName::None => Unlabelled::None,
            UnlabelledName::Neighbour => Unlabelled::Neighbour,
            UnlabelledName::Auto => Unlabelled::Auto,
        },
        auto: Auto { gamma: args.gamma, ..Auto::default() },
    };
    let chains = node::Chain::of_samples(&rows);
    let pitch = node::Options::for_drawing(diagonal, bounds.min_distance);
    let painting = colour::colour(&drawing.paths, &chains, &pitch, &hints, &options)
        .map_err(|error| Failure::input(&args.input.file, error))?;

    let layers =
        Layers { bleed, debug: args.debug.then_some(1e-3 * diagonal), hint_layer: is_svg.then_some(layer), background };
    let text = if is_svg { text } else { picture(&drawing)? };
    let coloured = colour::insert(&text, &painting, &layers)
        .ok_or_else(|| Failure::input(&args.input.file, "colours cannot be put into this document"))?;
    target.write(|out| out.write_all(coloured.as_bytes()))?;
    if let Some(report) = report {
        report.write(|out| colour::report(out, &args.input.file, &painting))?;
    }
    if !quiet {
        warnings(&args.input.file, &drawing, &painting);
    }
    tell(&mut summary, &painting);
    summary.print(&args.input.file);
    Ok(())
}

/// A target of one format; a file without an extension is fine.
fn target(file: Option<&Path>, format: Format) -> Result<Target, Failure> {
    let name = format.to_string();
    let has_extension = file.is_some_and(|file| file.extension().is_some());
    Target::new(file, (!has_extension).then_some(name.as_str()), &[format])
}

/// Hints of the command line and of the file.
fn given(args: &ColourArgs) -> Result<Vec<Hint>, Failure> {
    let mut hints = Vec::new();
    if let Some(file) = &args.hints {
        let read = colour::parse_hints(&input::text(file)?)
            .map_err(|(line, error)| Failure::input(file, format!("line {line}: {error}")))?;
        hints.extend(read);
    }
    for text in &args.hint {
        hints.push(text.parse().map_err(|error| Failure::usage(format!("--hint: {error}")))?);
    }
    Ok(hints)
}

/// Takes out a background: a first rectangle without a stroke around everything. It is no line of the drawing.
fn take_background(drawing: &mut Drawing) -> bool {
    let Some((first, others)) = drawing.paths.split_first() else { return false };
    let is_plain = first.element == "rect" && first.group.is_none() && first.stroke.is_none() && first.fill.is_some();
    if !is_plain || others.is_empty() {
        return false;
    }
    let outer = control_box(&Drawing { paths: vec![first.clone()], ..Drawing::default() });
    let inner = control_box(&Drawing { paths: others.to_vec(), ..Drawing::default() });
    let holds = outer.min.x <= inner.min.x
        && outer.min.y <= inner.min.y
        && outer.max.x >= inner.max.x
        && outer.max.y >= inner.max.y;
    if holds {
        drawing.paths.remove(0);
    }
    holds
}

/// A document for a drawing that came as a table.
fn picture(drawing: &Drawing) -> Result<String, Failure> {
    let mut bytes = Vec::new();
    let picture = Picture { drawing, show_drawing: true, lfs: None, medial: None, samples: None, band: None };
    picture.write(&mut bytes).map_err(|error| Failure::output("-", &error))?;
    String::from_utf8(bytes).map_err(|error| Failure::input(&drawing.source, error))
}

fn warnings(file: &str, drawing: &Drawing, painting: &Painting) {
    for warning in &painting.warnings {
        warn(format!("{file}: {warning}"));
    }
    let hides = |fill: &String| fill != "transparent" && Colour::named(fill).is_some();
    let filled = drawing.paths.iter().filter(|path| path.fill.as_ref().is_some_and(hides)).count();
    if filled > 0 {
        let paths = count(filled, "path");
        warn(format!("{file}: {paths} with a fill of its own, which hides the colours under it"));
    }
}

fn tell(summary: &mut Summary, painting: &Painting) {
    let coloured = painting.regions.iter().filter(|region| region.colour.is_some());
    summary.say(count(coloured.clone().count(), "coloured region"));
    let gaps: Vec<f64> = coloured.flat_map(|region| &region.gaps).map(|gap| gap.length).collect();
    if !gaps.is_empty() {
        let widest = gaps.iter().copied().fold(0.0, f64::max);
        let widest = lineart::export::number::Readable(widest);
        summary.say(format!("{} of gaps closed, the widest {widest}", count(gaps.len(), "side")));
    }
}
