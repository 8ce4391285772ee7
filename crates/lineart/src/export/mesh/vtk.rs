//! VTK, the legacy format, ASCII: triangles and lines as cells, with the path of each (−1: none), values at the points.

use std::io::{self, Write};

use super::MeshRows;
use crate::export::number::Number;

/// Writes the mesh.
///
/// # Errors
/// Those of `out`.
pub fn write(out: &mut dyn Write, rows: &MeshRows<'_>) -> io::Result<()> {
    let mesh = rows.mesh;
    let (triangles, lines) = (mesh.triangles.len(), mesh.borders.len());
    writeln!(out, "# vtk DataFile Version 3.0\nfsample: {}\nASCII", rows.title())?;
    writeln!(out, "DATASET UNSTRUCTURED_GRID\nPOINTS {} double", mesh.points.len())?;
    for p in &mesh.points {
        writeln!(out, "{} {} 0", Number(p.x), Number(p.y))?;
    }
    writeln!(out, "CELLS {} {}", triangles + lines, 4 * triangles + 3 * lines)?;
    for [a, b, c] in &mesh.triangles {
        writeln!(out, "3 {a} {b} {c}")?;
    }
    for [a, b] in mesh.borders.iter().map(|border| border.ends) {
        writeln!(out, "2 {a} {b}")?;
    }
    writeln!(out, "CELL_TYPES {}", triangles + lines)?;
    for cell in (0..triangles).map(|_| 5).chain((0..lines).map(|_| 3)) {
        writeln!(out, "{cell}")?;
    }
    writeln!(out, "CELL_DATA {}\nSCALARS path int 1\nLOOKUP_TABLE default", triangles + lines)?;
    for path in (0..triangles).map(|_| None).chain(mesh.borders.iter().map(|border| rows.path(border))) {
        match path {
            Some(path) => writeln!(out, "{path}")?,
            None => writeln!(out, "-1")?,
        }
    }
    if let Some(values) = rows.values {
        writeln!(out, "POINT_DATA {}\nSCALARS u double 1\nLOOKUP_TABLE default", values.len())?;
        for value in values {
            writeln!(out, "{}", Number(*value))?;
        }
    }
    Ok(())
}
