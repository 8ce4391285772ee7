//! `fsample lfs`.

use lineart::export::number::Readable;
use lineart::export::svg::Picture;
use lineart::export::{Header, OptionValue, PathRows, csv, json};

use crate::engine::Engine;
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
    let paths = match &points {
        // The order of the points is kept, whichever path each is near: they are one list.
        Some(points) => vec![PathRows { closed: false, rows: points.iter().map(|p| engine.lfs_at(p)).collect() }],
        None => engine.lfs_along(),
    };
    let mut described = args.model.describe();
    described.extend(args.at.clone().map(|file| ("at", OptionValue::Text(file))));
    let header = Header { source: drawing.source.clone(), options: described, diagonal: Engine::diagonal(&drawing) };
    target.write(|out| match target.format {
        Format::Json => json::lfs(out, &header, &paths),
        Format::Svg => {
            Picture { drawing: &drawing, show_drawing: true, lfs: Some(&paths), medial: None, samples: None }.write(out)
        }
        _ => csv::lfs(out, &paths),
    })?;

    let rows = || paths.iter().flat_map(|path| &path.rows);
    summary.say(count(rows().count(), "point"));
    if let Some(row) = rows().min_by(|a, b| a.lfs.total_cmp(&b.lfs)) {
        let place = format!("at ({}, {}), path {} segment {}", Readable(row.x), Readable(row.y), row.path, row.segment);
        summary.say(format!("smallest lfs {} {place}", Readable(row.lfs)));
    }
    summary.door(&engine.door());
    summary.print(&args.input.file);
    Ok(())
}
