//! PLY, ASCII: vertices, faces, and an edge for each piece of a line with the path it belongs to (−1: the rectangle).

use std::io::{self, Write};

use super::MeshRows;
use crate::export::number::Number;

/// Writes the mesh.
///
/// # Errors
/// Those of `out`.
pub fn write(out: &mut dyn Write, rows: &MeshRows<'_>) -> io::Result<()> {
    let mesh = rows.mesh;
    writeln!(out, "ply\nformat ascii 1.0\nelement vertex {}", mesh.points.len())?;
    writeln!(out, "property double x\nproperty double y\nproperty double z")?;
    if rows.values.is_some() {
        writeln!(out, "property double u")?;
    }
    writeln!(out, "element face {}\nproperty list uchar int vertex_indices", mesh.triangles.len())?;
    writeln!(out, "element edge {}\nproperty int vertex1\nproperty int vertex2", mesh.borders.len())?;
    writeln!(out, "property int path\nend_header")?;
    for (i, p) in mesh.points.iter().enumerate() {
        write!(out, "{} {} 0", Number(p.x), Number(p.y))?;
        match rows.values.and_then(|values| values.get(i)) {
            Some(value) => writeln!(out, " {}", Number(*value))?,
            None => writeln!(out)?,
        }
    }
    for [a, b, c] in &mesh.triangles {
        writeln!(out, "3 {a} {b} {c}")?;
    }
    for border in &mesh.borders {
        let [a, b] = border.ends;
        match rows.path(border) {
            Some(path) => writeln!(out, "{a} {b} {path}")?,
            None => writeln!(out, "{a} {b} -1")?,
        }
    }
    Ok(())
}
