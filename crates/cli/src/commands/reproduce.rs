//! `fsample reproduce`: the paper's tables and figures, computed again.
//!
//! What an experiment computes lives in `fsample-experiments`. This file finds the curves, runs the units (or some of them,
//! or none where shards are merged) and writes files. To add an experiment: a variant of
//! [`ExperimentName`] and a line in [`experiments`].

use std::fs;
use std::io;
use std::num::NonZero;
use std::path::Path;

use fsample_experiments::figure6::Figure6;
use fsample_experiments::figure7::Figure7;
use fsample_experiments::figure10::Figure10;
use fsample_experiments::figure12::{Figure12, Pictures};
use fsample_experiments::mesh_study::MeshStudy;
use fsample_experiments::shard::{self, Part, Shard};
use fsample_experiments::silhouette::Outline;
use fsample_experiments::source::Source;
use fsample_experiments::study::Study;
use fsample_experiments::table1::Table1;
use fsample_experiments::table2::Table2;
use fsample_experiments::table3::Table3;
use fsample_experiments::table4::Table4;
use fsample_experiments::{Experiment, Report};
use lineart::drawing::Drawing;
use lineart::export::atomic;
use lineart::svg;

use crate::errors::{Failure, warn};
use crate::input;
use crate::options::{ExperimentName, ReproduceArgs};
use crate::output::to_stdout;
use crate::progress::Progress;
use crate::study_input;

/// Drawings that come with the program, for runs without `--curve`.
const SHIPPED: [(&str, &str); 2] = [
    ("leaf_01.svg", include_str!("../../../../drawings/leaf_01.svg")),
    ("bee.svg", include_str!("../../../../drawings/bee.svg")),
];

/// Those and the others, for outlines.
const ALL_SHIPPED: [(&str, &str); 8] = [
    SHIPPED[0],
    SHIPPED[1],
    ("celtic_triskell_01.svg", include_str!("../../../../drawings/celtic_triskell_01.svg")),
    ("elephant_outline_matthe_r.svg", include_str!("../../../../drawings/elephant_outline_matthe_r.svg")),
    ("hand_dennis_rutjes_01.svg", include_str!("../../../../drawings/hand_dennis_rutjes_01.svg")),
    ("seal_sek_.svg", include_str!("../../../../drawings/seal_sek_.svg")),
    ("sleeping_cat_ron_golan_01.svg", include_str!("../../../../drawings/sleeping_cat_ron_golan_01.svg")),
    ("hook.svg", include_str!("../../../../drawings/hook.svg")),
];

/// The experiments that were asked for, ready to run.
fn experiments(args: &ReproduceArgs) -> Result<Vec<Box<dyn Experiment>>, Failure> {
    let curves = curves(args)?;
    let mut list: Vec<Box<dyn Experiment>> = Vec::new();
    for name in args.names() {
        match name {
            ExperimentName::Table1 => list.push(Box::new(Table1::new(curves.clone(), args.quick))),
            ExperimentName::Table3 => list.push(Box::new(Table3::new(study(args, &curves)?))),
            ExperimentName::Figure6 => list.push(Box::new(figure6(args, &curves)?)),
            ExperimentName::Figure7 => list.push(Box::new(Figure7::new(study(args, &curves)?))),
            ExperimentName::Table4 => {
                list.push(Box::new(Table4::new(MeshStudy::new(meshed(args, &curves)?, args.quick))))
            }
            ExperimentName::Figure10 => {
                list.push(Box::new(Figure10::new(MeshStudy::new(meshed(args, &curves)?, args.quick))));
            }
            ExperimentName::Figure12 => list.push(Box::new(Figure12::new(meshed(args, &curves)?, Pictures::Meshes))),
            ExperimentName::Figure13 => list.push(Box::new(Figure12::new(meshed(args, &curves)?, Pictures::Densities))),
            ExperimentName::Table2 => list.push(Box::new(Table2::new(curves.clone(), args.quick))),
            // Names of many were told apart already.
            ExperimentName::All => {}
        }
    }
    Ok(list)
}

/// The reconstruction study: of the paper's curve if it is among those given, else of the first; of the one that comes with
/// the program if there is none and no sample sets either.
fn study(args: &ReproduceArgs, curves: &[Source]) -> Result<Study, Failure> {
    let given = args.samples.as_deref().map(study_input::sets).transpose()?;
    let curve = match (args.curve.is_empty(), &given) {
        (false, _) => curves.iter().find(|curve| curve.name == "complex").or(curves.first()).cloned(),
        (true, Some(_)) => None,
        (true, None) => Some(shipped("hook.svg", include_str!("../../../../drawings/hook.svg"))?),
    };
    Ok(Study::new(curve, args.grid()?, given))
}

/// Outlines: of the images and drawings given, or of all drawings that come with the program.
fn figure6(args: &ReproduceArgs, curves: &[Source]) -> Result<Figure6, Failure> {
    let drawings = match (args.curve.is_empty(), args.masks.is_empty()) {
        (false, _) => curves.to_vec(),
        (true, false) => Vec::new(),
        (true, true) => ALL_SHIPPED.iter().map(|(name, text)| shipped(name, text)).collect::<Result<_, _>>()?,
    };
    let mut outlines = study_input::masks(&args.masks)?;
    outlines.extend(drawings.iter().flat_map(Outline::of_drawing));
    if outlines.is_empty() {
        return Err(Failure::usage("figure6 needs closed paths, and the drawings given have none"));
    }
    Ok(Figure6::new(outlines, args.curve.is_empty() && args.masks.is_empty()))
}

/// What is meshed: the drawings given, and as many of those that come with the program as make five.
fn meshed(args: &ReproduceArgs, curves: &[Source]) -> Result<Vec<Source>, Failure> {
    let mut sources = if args.curve.is_empty() { Vec::new() } else { curves.to_vec() };
    for (name, text) in [ALL_SHIPPED[3], ALL_SHIPPED[1], ALL_SHIPPED[4], ALL_SHIPPED[6], ALL_SHIPPED[5]] {
        let source = shipped(name, text)?;
        if sources.len() < 5 && sources.iter().all(|given| given.name != source.name) {
            sources.push(source);
        }
    }
    Ok(sources)
}

fn shipped(name: &str, text: &str) -> Result<Source, Failure> {
    svg::read_str(text, name).map(|drawing| Source::new(&drawing, true)).map_err(Failure::read)
}

/// Runs the command.
pub(crate) fn run(args: &ReproduceArgs) -> Result<(), Failure> {
    let shards = args.merge.iter().map(|file| read_shard(file)).collect::<Result<Vec<_>, _>>()?;
    let experiments = experiments(args)?;
    if experiments.len() > 1 && args.output.is_none() {
        return Err(Failure::usage("several experiments make several files: say where with -o DIR"));
    }
    if let Some(folder) = &args.output {
        fs::create_dir_all(folder).map_err(|error| Failure::output(&folder.display().to_string(), &error))?;
    }
    for experiment in &experiments {
        let experiment = experiment.as_ref();
        if let Some(shard) = args.shard {
            let part = compute(experiment, shard, args)?;
            let name = format!("{}.shard-{}-of-{}.csv", experiment.name(), shard.index, shard.of);
            write(args.output.as_deref(), &name, |out| part.write(out))?;
            continue;
        }
        let report = if args.merge.is_empty() {
            let part = compute(experiment, Shard::WHOLE, args)?;
            shard::merge(experiment, vec![(experiment.name().to_owned(), part)])
        } else {
            let of_this = |part: &Part| experiments.len() == 1 || part.experiment() == experiment.name();
            shard::merge(experiment, shards.iter().filter(|(_, part)| of_this(part)).cloned().collect())
        };
        write_report(args, &report.map_err(Failure::read)?)?;
    }
    Ok(())
}

/// The curves: those given, or those shipped.
fn curves(args: &ReproduceArgs) -> Result<Vec<Source>, Failure> {
    if args.curve.is_empty() {
        return SHIPPED.iter().map(|(name, text)| shipped(name, text)).collect();
    }
    let read = |file: &String| input::drawing(file, args.quiet).map(|drawing: Drawing| Source::new(&drawing, false));
    let curves = args.curve.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    for (i, curve) in curves.iter().enumerate() {
        if curves.iter().take(i).any(|other| other.name == curve.name) {
            return Err(Failure::usage(format!("two curves are named “{}”: tables go by the file's name", curve.name)));
        }
    }
    Ok(curves)
}

fn read_shard(file: &Path) -> Result<(String, Part), Failure> {
    let name = file.display().to_string();
    let text = fs::read_to_string(file).map_err(|error| Failure::input(&name, error))?;
    let part = Part::read(&text, &name).map_err(Failure::read)?;
    Ok((name, part))
}

fn compute(experiment: &dyn Experiment, shard: Shard, args: &ReproduceArgs) -> Result<Part, Failure> {
    let progress = Progress::new(experiment.name(), args.quiet);
    let available = std::thread::available_parallelism().map_or(1, NonZero::get);
    let threads = args.threads.map_or(available, usize::from);
    shard::run(experiment, shard, threads, &|done, total| progress.of(done, total)).map_err(Failure::read)
}

/// A folder takes every form of a report, standard output the first table as CSV.
fn write_report(args: &ReproduceArgs, report: &Report) -> Result<(), Failure> {
    if !args.quiet {
        let notes = report.tables.iter().flat_map(|table| &table.notes);
        notes.filter_map(|note| note.strip_prefix("Warning: ")).for_each(warn);
    }
    if args.output.is_none() {
        return write(None, "", |out| out.write_all(report.csv().as_bytes()));
    }
    for (name, content) in report.files() {
        write(args.output.as_deref(), &name, |out| out.write_all(content.as_bytes()))?;
    }
    Ok(())
}

fn write(
    folder: Option<&Path>,
    name: &str,
    body: impl FnOnce(&mut dyn io::Write) -> io::Result<()>,
) -> Result<(), Failure> {
    match folder {
        None => to_stdout(body).map_err(|error| Failure::output("-", &error)),
        Some(folder) => {
            let file = folder.join(name);
            atomic::write_file(&file, body).map_err(|error| Failure::output(&file.display().to_string(), &error))
        }
    }
}
