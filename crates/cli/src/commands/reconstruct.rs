//! `fsample reconstruct`: curves from points.

use std::collections::BTreeSet;
use std::time::Instant;

use feature_sampling::geometry::Point;
use lineart::export::edges::{self, EdgesOf};
use lineart::export::number::Readable;
use lineart::reconstruct::{Algorithm, Consent, ConservativeCrust, HnnCrust, Reconstruction, Separation, Sites};

use crate::errors::Failure;
use crate::input;
use crate::options::{ReconstructArgs, above};
use crate::output::{Format, Target};
use crate::progress::Progress;
use crate::summary::{Summary, count};

/// Reconstructs, and compares if asked to.
pub(crate) fn run(args: &ReconstructArgs) -> Result<(), Failure> {
    let target = Target::new(
        args.output.output.as_deref(),
        args.output.format.as_deref(),
        &[Format::Csv, Format::Svg, Format::Json],
    )?;
    let algorithms: Vec<Algorithm> = match Algorithm::named(&args.algorithm) {
        Some(algorithm) => vec![algorithm],
        None => Algorithm::MAIN.to_vec(),
    };
    check_parameters(args, &algorithms)?;
    if args.file == "-" && args.compare.as_deref() == Some("-") {
        return Err(Failure::usage("the points and the true edges cannot both come from standard input"));
    }
    let mut summary = Summary::start(args.quiet);
    let points = input::points(&args.file)?;
    if points.is_empty() {
        return Err(Failure::input(&args.file, "there is no point in it"));
    }
    let truth = args.compare.as_deref().map(|file| true_edges(file, &points)).transpose()?;
    target.check_folder()?;

    let progress = Progress::new("reconstructing", args.quiet);
    let start = Instant::now();
    let sites = Sites::new(&points).map_err(|error| Failure::input(&args.file, error))?;
    summary.say(format!("{}, triangulated in {} s", count(points.len(), "point"), seconds(start)));
    if sites.len() < points.len() {
        summary.say(count(points.len() - sites.len(), "point") + " equal to an earlier one");
    }
    let mut results = Vec::new();
    for (done, algorithm) in (0_u64..).zip(&algorithms) {
        progress.of(done, algorithms.len() as u64);
        let start = Instant::now();
        let edges = rule(*algorithm, args).edges(&sites);
        summary.say(format!("{}: {} in {} s", algorithm.name(), count(edges.len(), "edge"), seconds(start)));
        results.push(EdgesOf { algorithm: algorithm.name(), edges });
    }
    drop(progress);

    let all = args.algorithm == "all";
    target.write(|out| match target.format {
        Format::Json => edges::json(out, &args.file, points.len(), &results),
        Format::Svg => edges::svg(out, &points, &results, truth.as_deref()),
        _ => edges::csv(out, &results, all),
    })?;

    let differing = truth.map(|truth| compare(&truth, &results, &mut summary));
    summary.print(&args.file);
    match differing {
        Some(names) if !names.is_empty() => {
            Err(Failure::no(format!("{}: the edges of {} differ from the true ones", args.file, names.join(", "))))
        }
        _ => Ok(()),
    }
}

/// Parameters make sense, and belong to the algorithm.
fn check_parameters(args: &ReconstructArgs, algorithms: &[Algorithm]) -> Result<(), Failure> {
    let factors = [
        ("disk-factor", args.disk_factor, Algorithm::ConservativeCrust),
        ("medial-factor", args.medial_factor, Algorithm::ConservativeCrustMedial),
    ];
    for (name, value, of) in factors {
        let Some(value) = value else { continue };
        above(name, 0.0, value)?;
        if !algorithms.contains(&of) {
            return Err(Failure::usage(format!("--{name} is a parameter of {}", of.name())));
        }
    }
    let hnn = [Algorithm::HnnCrust, Algorithm::HnnCrustEither];
    if args.candidates.is_some() && !hnn.iter().any(|of| algorithms.contains(of)) {
        return Err(Failure::usage("--candidates is a parameter of hnn-crust and hnn-crust-either"));
    }
    Ok(())
}

/// The rule with the parameters that were given.
fn rule(algorithm: Algorithm, args: &ReconstructArgs) -> Box<dyn Reconstruction> {
    let hnn = |consent| {
        let candidates = args.candidates.map_or(HnnCrust::default().candidates, |n| n as usize);
        Box::new(HnnCrust { consent, candidates })
    };
    let separated = |separation| Box::new(ConservativeCrust { separation });
    match (algorithm, args.disk_factor, args.medial_factor) {
        (Algorithm::ConservativeCrust, Some(factor), _) => separated(Separation::Disk { factor }),
        (Algorithm::ConservativeCrustMedial, _, Some(factor)) => separated(Separation::Medial { factor }),
        (Algorithm::HnnCrust, ..) => hnn(Consent::Both),
        (Algorithm::HnnCrustEither, ..) => hnn(Consent::Either),
        _ => algorithm.rule(),
    }
}

/// The true edges by the numbers that results use: equal points go by the first of them.
fn true_edges(file: &str, points: &[Point<f64>]) -> Result<Vec<(usize, usize)>, Failure> {
    let mut first = std::collections::HashMap::new();
    let numbers: Vec<usize> = points
        .iter()
        .enumerate()
        .map(|(i, p)| *first.entry([(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()]).or_insert(i))
        .collect();
    let mut edges = BTreeSet::new();
    for (line, [a, b]) in input::edges(file)? {
        let (Some(&a), Some(&b)) = (numbers.get(a), numbers.get(b)) else {
            let cause = format!("line {line}: there are only {}", count(points.len(), "point"));
            return Err(Failure::input(file, cause));
        };
        if a != b {
            edges.insert((a.min(b), a.max(b)));
        }
    }
    Ok(edges.into_iter().collect())
}

/// Says what differs; the names of the algorithms that do.
fn compare(truth: &[(usize, usize)], results: &[EdgesOf], summary: &mut Summary) -> Vec<&'static str> {
    let mut names = Vec::new();
    for result in results {
        let missing = truth.iter().filter(|edge| result.edges.binary_search(edge).is_err()).count();
        let extra = result.edges.iter().filter(|edge| truth.binary_search(edge).is_err()).count();
        if missing + extra > 0 {
            names.push(result.algorithm);
            summary.say(format!("{}: {missing} missing, {extra} extra", result.algorithm));
        } else {
            summary.say(format!("{}: exact", result.algorithm));
        }
    }
    names
}

fn seconds(since: Instant) -> Readable {
    Readable(since.elapsed().as_secs_f64())
}
