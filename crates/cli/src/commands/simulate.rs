//! `fsample simulate`: the Poisson problem around a drawing.

use lineart::drawing::Drawing;
use lineart::export::mesh::{MeshRows, heat_map, raster, table, vtk};
use lineart::export::number::Readable;
use lineart::simulate::{Problem, SimulateError, Simulation};

use crate::engine::Engine;
use crate::errors::Failure;
use crate::input;
use crate::meshing::meshed;
use crate::options::SimulateArgs;
use crate::output::{Format, Target};
use crate::summary::{Summary, count};

/// Meshes a drawing and solves.
pub(crate) fn run(args: &SimulateArgs) -> Result<(), Failure> {
    let formats = [Format::Svg, Format::Vtk, Format::Csv, Format::Png];
    let target = Target::new(args.output.output.as_deref(), args.output.format.as_deref(), &formats)?;
    args.sampling.check()?;
    args.triangles.check()?;
    let model = args.model.check()?;
    if !args.source.is_finite() {
        return Err(Failure::usage(format!("--source is {}; it has to be a finite number", args.source)));
    }
    let mut summary = Summary::start(model.quiet);
    let drawing = input::drawing(&args.input.file, model.quiet)?;
    let bounds = args.sampling.bounds(&drawing, Engine::diagonal(&drawing))?;
    let values = path_values(args, &drawing)?;
    target.check_folder()?;

    let meshed = meshed(&drawing, &model, &bounds, &args.triangles, &mut summary)?;
    let of_path = |path: u32| values.get(path as usize).copied().flatten();
    let given = meshed.drawn.given(&meshed.mesh, of_path, args.frame_value.0);
    let failed = |error: SimulateError| match error {
        SimulateError::Loose { .. } => {
            Failure::usage(format!("{error}: give one along the rectangle with --frame-value, or along more paths"))
        }
        error => Failure::input(&drawing.source, error),
    };
    let simulation = Simulation::new(&meshed.mesh, &given).map_err(failed)?;
    let unit = Engine::diagonal(&drawing);
    let solution = simulation.solve(&Problem { source: args.source, unit, given: &given }).map_err(failed)?;

    let rows = MeshRows {
        mesh: &meshed.mesh,
        path_of: &meshed.path_of,
        names: &meshed.names,
        values: Some(&solution.values),
        source: &drawing.source,
    };
    let contours = usize::from(args.contours);
    target.write(|out| match target.format {
        Format::Svg => heat_map::write(out, &rows, contours),
        Format::Png => raster::write(out, &rows, contours),
        Format::Vtk => vtk::write(out, &rows),
        _ => table::values(out, &rows),
    })?;
    summary.say(format!("u from {} to {}", Readable(solution.least), Readable(solution.greatest)));
    summary.say(format!("energy {}", Readable(solution.energy)));
    summary.say(format!("Dirichlet energy {}", Readable(solution.dirichlet_energy)));
    summary.say(format!("{}, residual {:.1e}", count(solution.unknowns, "unknown"), solution.residual));
    summary.print(&args.input.file);
    Ok(())
}

/// The value of each path.
fn path_values(args: &SimulateArgs, drawing: &Drawing) -> Result<Vec<Option<f64>>, Failure> {
    let mut values: Vec<Option<f64>> = drawing.paths.iter().map(|path| path.value.or(args.value.0)).collect();
    for given in &args.path_value {
        let index = given.path.parse::<usize>().ok();
        let mut any = false;
        for (i, (path, value)) in drawing.paths.iter().zip(&mut values).enumerate() {
            if path.id.as_deref() == Some(&given.path) || index == Some(i) {
                *value = given.value.0;
                any = true;
            }
        }
        if !any {
            return Err(Failure::usage(format!("--path-value: there is no path “{}”", given.path)));
        }
    }
    Ok(values)
}
