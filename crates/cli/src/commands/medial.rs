//! `fsample medial`.

use lineart::export::svg::Picture;
use lineart::export::{Header, csv, json};

use crate::engine::Engine;
use crate::errors::Failure;
use crate::input;
use crate::options::MedialArgs;
use crate::output::{Format, Target};
use crate::summary::{Summary, count};

/// Computes the medial axis of a drawing.
pub(crate) fn run(args: &MedialArgs) -> Result<(), Failure> {
    let formats = [Format::Svg, Format::Csv, Format::Json];
    let target = Target::new(args.output.output.as_deref(), args.output.format.as_deref(), &formats)?;
    let options = args.model.check()?;
    let mut summary = Summary::start(args.model.quiet);
    let drawing = input::drawing(&args.input.file, args.model.quiet)?;
    target.check_folder()?;

    let engine = Engine::new(&drawing, &options)?;
    let paths = engine.medial();
    let header =
        Header { source: drawing.source.clone(), options: args.model.describe(), diagonal: Engine::diagonal(&drawing) };
    target.write(|out| match target.format {
        Format::Json => json::medial(out, &header, &paths),
        Format::Svg => Picture {
            drawing: &drawing,
            show_drawing: true,
            lfs: None,
            medial: Some(&paths),
            samples: None,
            band: None,
        }
        .write(out),
        _ => csv::medial(out, &paths),
    })?;

    let points: usize = paths.iter().map(|path| path.rows.len()).sum();
    let polylines: usize = paths.iter().map(|path| path.rows.chunk_by(|a, b| a.polyline == b.polyline).count()).sum();
    summary.say(format!("{} in {}", count(points, "medial point"), count(polylines, "polyline")));
    summary.door(&engine.door());
    summary.print(&args.input.file);
    Ok(())
}
