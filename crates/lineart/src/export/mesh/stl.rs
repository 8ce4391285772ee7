//! STL, ASCII: a facet for each triangle. Names of solids end with the line, so they are left to a fixed word.

use std::io::{self, Write};

use super::MeshRows;
use crate::export::number::Number;

/// Writes the triangles.
///
/// # Errors
/// Those of `out`.
pub fn write(out: &mut dyn Write, rows: &MeshRows<'_>) -> io::Result<()> {
    writeln!(out, "solid fsample")?;
    for triangle in &rows.mesh.triangles {
        writeln!(out, "facet normal 0 0 1\nouter loop")?;
        for p in triangle.map(|v| rows.mesh.points[v as usize]) {
            writeln!(out, "vertex {} {} 0", Number(p.x), Number(p.y))?;
        }
        writeln!(out, "endloop\nendfacet")?;
    }
    writeln!(out, "endsolid fsample")
}
