//! `fsample sample`: the main job.

use lineart::export::svg::Picture;
use lineart::export::{Header, LfsRow, PathRows, SampleRow, csv, gcode, json, ply};

use crate::engine::{Engine, ModelOptions};
use crate::errors::Failure;
use crate::input;
use crate::job::{self, Lfs};
use crate::options::{Layer, SampleArgs};
use crate::output::{Format, Target};
use crate::progress::Progress;
use crate::summary::{Summary, count};

/// Samples a drawing.
pub(crate) fn run(args: &SampleArgs) -> Result<(), Failure> {
    let formats = [Format::Svg, Format::Ply, Format::Csv, Format::Json, Format::Gcode, Format::Fsj];
    let target = Target::new(args.output.output.as_deref(), args.output.format.as_deref(), &formats)?;
    args.sampling.check()?;
    let options = args.model.check()?;
    let machine = args.plotter.machine()?;
    if args.layers.is_some() && target.format != Format::Svg {
        return Err(Failure::usage(format!("--layers is for svg, and the result is {}", target.format)));
    }
    if args.plotter.is_given() && !matches!(target.format, Format::Gcode | Format::Fsj) {
        return Err(Failure::usage(format!("pen and feed options are for gcode, and the result is {}", target.format)));
    }

    if args.with_lfs && target.format != Format::Fsj {
        return Err(Failure::usage(format!("--with-lfs is for fsj, and the result is {}", target.format)));
    }

    let proof = args.proof()?;
    if proof.is_some() && target.format == Format::Fsj {
        return Err(Failure::usage("a job's samples are placed on the chip: --certified says nothing about them"));
    }

    let quiet = args.model.quiet;
    let mut summary = Summary::start(quiet);
    let drawing = input::drawing(&args.input.file, quiet)?;
    let bounds = args.sampling.bounds(&drawing, Engine::diagonal(&drawing))?;
    target.check_folder()?;

    // A job's steps are the chip's; what the chip's lfs is compared with is as good as the tolerance.
    let steps = options.steps;
    let options = if target.format == Format::Fsj { ModelOptions { steps: None, ..options } } else { options };
    let engine = Engine::new(&drawing, &options)?;
    if target.format == Format::Fsj {
        let lfs = if args.with_lfs { Lfs::Along } else { Lfs::OnChip };
        let bytes = job::bytes(&drawing, &engine, &bounds, steps, machine.feed, lfs)?;
        return target.write(|out| out.write_all(&bytes));
    }
    let progress = Progress::new("sampling", quiet);
    let paths = match proof {
        None => engine.sample(&bounds)?,
        Some((epsilon, effort)) => {
            let (paths, judged) = engine.sample_certified(&bounds, epsilon, effort)?;
            if !judged.proved() {
                let left = count(judged.unknown(), "piece");
                return Err(Failure::no(format!("{}: {left} could not be proved: raise --slack", args.input.file)));
            }
            paths
        }
    };
    drop(progress);

    let mut described = bounds.describe();
    described.extend(args.model.describe());
    let header = Header { source: drawing.source.clone(), options: described, diagonal: Engine::diagonal(&drawing) };
    target.write(|out| match target.format {
        Format::Csv => csv::samples(out, &paths),
        Format::Json => json::samples(out, &header, &paths),
        Format::Ply => ply::samples(out, &paths),
        Format::Gcode => gcode::samples(out, &header, &drawing, &machine, &paths),
        Format::Svg => {
            let shown = |layer| args.layers.as_ref().is_none_or(|layers| layers.contains(&layer));
            let lfs = shown(Layer::Lfs).then(|| paths.iter().map(lfs_rows).collect::<Vec<_>>());
            let medial = shown(Layer::Medial).then(|| engine.medial());
            Picture {
                drawing: &drawing,
                show_drawing: shown(Layer::Drawing),
                lfs: lfs.as_deref(),
                medial: medial.as_deref(),
                samples: shown(Layer::Samples).then_some(&paths),
                band: None,
            }
            .write(out)
        }
        // A job was written above; the others are not offered.
        _ => Ok(()),
    })?;

    summary.samples(&paths, &bounds);
    if let Some((epsilon, _)) = proof {
        summary.say(format!("proved at ε = {epsilon}"));
    }
    summary.door(&engine.door());
    summary.print(&args.input.file);
    Ok(())
}

/// The lfs that samples carry.
fn lfs_rows(path: &PathRows<SampleRow>) -> PathRows<LfsRow> {
    let row = |row: &SampleRow| {
        let SampleRow { path, segment, t, x, y, lfs, .. } = *row;
        LfsRow { path, segment, t, x, y, lfs, bounds: None }
    };
    PathRows { closed: path.closed, rows: path.rows.iter().map(row).collect() }
}
