//! From a drawing to its mesh, for the commands that need one.

use lineart::drawing::Drawing;
use lineart::export::number::Readable;
use lineart::mesh::drawn::{Drawn, Grading, noding};
use lineart::mesh::smooth::smooth;
use lineart::mesh::{self, Mesh, Outcome, Size};

use crate::engine::{Bounds, Engine, ModelOptions};
use crate::errors::{Failure, shown, warn};
use crate::options::{TriangleArgs, resolve};
use crate::progress::Progress;
use crate::summary::{Summary, count};

/// A mesh and what it is a mesh of.
pub(crate) struct Meshed {
    pub(crate) drawn: Drawn,
    pub(crate) mesh: Mesh,
    pub(crate) path_of: Vec<u32>,
    pub(crate) names: Vec<String>,
}

/// Samples, nodes, meshes; says in the summary what came of it.
pub(crate) fn meshed(
    drawing: &Drawing,
    model: &ModelOptions,
    bounds: &Bounds,
    args: &TriangleArgs,
    summary: &mut Summary,
) -> Result<Meshed, Failure> {
    let diagonal = Engine::diagonal(drawing);
    let longest = match args.max_edge {
        Some(length) => resolve("max-edge", length, drawing.user_units_per_mm, diagonal)?,
        None => f64::INFINITY,
    };
    let engine = Engine::new(drawing, model)?;
    let progress = Progress::new("sampling", model.quiet);
    let samples = engine.sample(bounds)?;
    drop(progress);
    let limit = |message: String| Failure::limit(format!("{}: {message}", shown(&drawing.source)));
    let noding = noding(diagonal, bounds.min_distance);
    let drawn = Drawn::new(&drawing.paths, &samples, &noding)
        .map_err(|error| limit(format!("{error}; ask for less detail with --min-distance")))?;
    let size = match (args.graded, longest.is_finite()) {
        (true, _) => drawn.graded(longest, &Grading { lfs_factor: args.lfs_factor, growth: args.growth }),
        (false, true) => Size::Uniform(longest),
        (false, false) => Size::Unbounded,
    };
    let max_vertices = args.max_vertices as usize;
    let options = mesh::Options { min_angle: args.min_angle, size, max_vertices };
    let outcome =
        mesh::mesh(&drawn.lines(), &drawn.frame, &options).map_err(|error| Failure::input(&drawing.source, error))?;
    let Outcome { mut mesh, capped, unrefined } = outcome;
    if capped {
        let most = args.max_vertices;
        let advice = "raise --max-vertices, or ask for less with --max-edge, --min-angle or --min-distance";
        return Err(limit(format!("the mesh needs more than {}: {advice}", format_args!("{most} vertices"))));
    }
    if let Some(first) = unrefined.first().filter(|_| !model.quiet) {
        let (places, x, y) = (count(unrefined.len(), "place"), Readable(first.at.x), Readable(first.at.y));
        warn(format!("{}: {places} could not be refined, the first at ({x}, {y})", shown(&drawing.source)));
    }
    if args.smooth > 0 {
        smooth(&mut mesh, &options, u32::from(args.smooth));
    }

    let quality = mesh.quality();
    summary.say(format!("{} vertices, {}", mesh.points.len(), count(mesh.triangles.len(), "triangle")));
    summary.say(format!("angles from {}°", Readable(quality.min_angle)));
    summary.say(format!("edges {} to {}", Readable(quality.shortest), Readable(quality.longest)));
    if mesh.excused > 0 {
        summary.say(format!("{} flat at a small angle between lines", count(mesh.excused, "triangle")));
    }
    let report = drawn.report;
    if report.crossings > 0 {
        summary.say(count(report.crossings, "crossing"));
    }
    if report.segments_merged > 0 {
        summary.say(count(report.segments_merged, "repeated line") + " merged");
    }
    summary.door(&engine.door());
    let names = drawing.paths.iter().map(|path| path.id.clone().unwrap_or_default()).collect();
    Ok(Meshed { path_of: drawn.path_of(), drawn, mesh, names })
}
