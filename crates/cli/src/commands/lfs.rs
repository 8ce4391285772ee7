//! `fsample lfs`.

use lineart::export::number::Readable;
use lineart::export::svg::Picture;
use lineart::export::{Header, OptionValue, PathRows, csv, json};

use crate::engine::{Enclosed, Engine};
use crate::errors::Failure;
use crate::input;
use crate::options::LfsArgs;
use crate::output::{Format, Target};
use crate::summary::{Summary, count};

/// Computes local feature sizes, along the drawing or at given points.
pub(crate) fn run(args: &LfsArgs) -> Result<(), Failure> {
    let formats = [Format::Svg, Format::Csv, Format::Json];
    let target = Target::new(args.output.output.as_deref(), args.output.format.as_deref(), &formats)?;
    let options = args.model.check()?;
    let width = args.width()?;
    if args.input.file == "-" && args.at.as_deref() == Some("-") {
        return Err(Failure::usage("the drawing and the points cannot both come from standard input"));
    }
    if args.at.is_some() && target.format == Format::Svg {
        return Err(Failure::usage("a picture colours the drawing, not the points of --at: choose csv or json"));
    }
    let quiet = args.model.quiet;
    let mut summary = Summary::start(quiet);
    let drawing = input::drawing(&args.input.file, quiet)?;
    let points = args.at.as_deref().map(input::points).transpose()?;
    target.check_folder()?;

    let engine = Engine::new(&drawing, &options)?;
    let mut paths = match &points {
        // The order of the points is kept, whichever path each is near: they are one list.
        Some(points) => vec![PathRows { closed: false, rows: points.iter().map(|p| engine.lfs_at(p)).collect() }],
        None => engine.lfs_along(),
    };
    let enclosed = width.map(|width| engine.enclose(&mut paths, width, target.format == Format::Svg));
    let mut described = args.model.describe();
    described.extend(args.at.clone().map(|file| ("at", OptionValue::Text(file))));
    let header = Header { source: drawing.source.clone(), options: described, diagonal: Engine::diagonal(&drawing) };
    target.write(|out| match target.format {
        Format::Json => json::lfs(out, &header, &paths),
        Format::Svg => {
            let band = enclosed.as_ref().and_then(|e| e.band.as_deref());
            Picture { drawing: &drawing, show_drawing: true, lfs: Some(&paths), medial: None, samples: None, band }
                .write(out)
        }
        _ => csv::lfs(out, &paths),
    })?;

    let rows = || paths.iter().flat_map(|path| &path.rows);
    summary.say(count(rows().count(), "point"));
    if let Some(row) = rows().min_by(|a, b| a.lfs.total_cmp(&b.lfs)) {
        let place = format!("at ({}, {}), path {} segment {}", Readable(row.x), Readable(row.y), row.path, row.segment);
        summary.say(format!("smallest lfs {} {place}", Readable(row.lfs)));
    }
    if let Some(enclosed) = &enclosed {
        proved(&mut summary, enclosed, rows().filter_map(|row| row.bounds));
    }
    summary.door(&engine.door());
    summary.print(&args.input.file);
    Ok(())
}

/// What was proved: the reach and where, how wide the bounds are.
fn proved(summary: &mut Summary, enclosed: &Enclosed, bounds: impl Iterator<Item = [f64; 2]>) {
    let [lower, upper] = enclosed.reach.map(Readable);
    let place = enclosed.at.map(|p| format!(" at ({}, {})", Readable(p.x), Readable(p.y))).unwrap_or_default();
    summary.say(format!("reach from {lower} to {upper}{place}"));
    let share = |[lower, upper]: [f64; 2]| if upper > 0.0 { 1.0 - lower / upper } else { 0.0 };
    let widest = bounds.map(share).fold(0.0, f64::max);
    summary.say(format!("bounds no wider than {} %", Readable(100.0 * widest)));
    summary.say(count(enclosed.cells, "cell"));
}
