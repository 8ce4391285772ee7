//! `fsample mesh`: triangles around a drawing.

use lineart::export::mesh::{MeshRows, msh, obj, picture, ply, stl, table, vtk};

use crate::engine::Engine;
use crate::errors::Failure;
use crate::input;
use crate::meshing::meshed;
use crate::options::MeshArgs;
use crate::output::{Format, Target};
use crate::summary::Summary;

/// Meshes a drawing.
pub(crate) fn run(args: &MeshArgs) -> Result<(), Failure> {
    let formats = [Format::Stl, Format::Ply, Format::Obj, Format::Msh, Format::Vtk, Format::Svg, Format::Csv];
    let target = Target::new(args.output.output.as_deref(), args.output.format.as_deref(), &formats)?;
    args.sampling.check()?;
    args.triangles.check()?;
    let model = args.model.check()?;
    let mut summary = Summary::start(model.quiet);
    let drawing = input::drawing(&args.input.file, model.quiet)?;
    let bounds = args.sampling.bounds(&drawing, Engine::diagonal(&drawing))?;
    target.check_folder()?;

    let meshed = meshed(&drawing, &model, &bounds, &args.triangles, &mut summary)?;
    let rows = MeshRows {
        mesh: &meshed.mesh,
        path_of: &meshed.path_of,
        names: &meshed.names,
        values: None,
        source: &drawing.source,
    };
    target.write(|out| match target.format {
        Format::Stl => stl::write(out, &rows),
        Format::Ply => ply::write(out, &rows),
        Format::Obj => obj::write(out, &rows),
        Format::Msh => msh::write(out, &rows),
        Format::Vtk => vtk::write(out, &rows),
        Format::Svg => picture::write(out, &rows),
        _ => table::triangles(out, &rows),
    })?;
    summary.print(&args.input.file);
    Ok(())
}
