//! Meshes as CSV: a row for each triangle, or for each vertex and its value.

use std::io::{self, Write};

use super::MeshRows;
use crate::export::number::Number;

/// Writes `triangle,x0,y0,x1,y1,x2,y2`.
///
/// # Errors
/// Those of `out`.
pub fn triangles(out: &mut dyn Write, rows: &MeshRows<'_>) -> io::Result<()> {
    writeln!(out, "triangle,x0,y0,x1,y1,x2,y2")?;
    for (index, triangle) in rows.mesh.triangles.iter().enumerate() {
        write!(out, "{index}")?;
        for p in triangle.map(|v| rows.mesh.points[v as usize]) {
            write!(out, ",{},{}", Number(p.x), Number(p.y))?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// Writes `vertex,x,y,u`.
///
/// # Errors
/// Those of `out`.
pub fn values(out: &mut dyn Write, rows: &MeshRows<'_>) -> io::Result<()> {
    writeln!(out, "vertex,x,y,u")?;
    for (vertex, (p, u)) in rows.mesh.points.iter().zip(rows.values.unwrap_or_default()).enumerate() {
        writeln!(out, "{vertex},{},{},{}", Number(p.x), Number(p.y), Number(*u))?;
    }
    Ok(())
}
