//! Wavefront OBJ: faces, then the lines of each path as a group.

use std::io::{self, Write};

use super::MeshRows;
use crate::export::number::Number;

/// Writes the mesh. Indices count from 1.
///
/// # Errors
/// Those of `out`.
pub fn write(out: &mut dyn Write, rows: &MeshRows<'_>) -> io::Result<()> {
    let mesh = rows.mesh;
    writeln!(out, "# fsample: {}", rows.title())?;
    for p in &mesh.points {
        writeln!(out, "v {} {} 0", Number(p.x), Number(p.y))?;
    }
    writeln!(out, "g mesh")?;
    for [a, b, c] in &mesh.triangles {
        writeln!(out, "f {} {} {}", a + 1, b + 1, c + 1)?;
    }
    let mut open = None;
    for border in &mesh.borders {
        let path = rows.path(border);
        if open != Some(path) {
            match path {
                Some(path) => writeln!(out, "g {}", rows.name(path))?,
                None => writeln!(out, "g frame")?,
            }
            open = Some(path);
        }
        let [a, b] = border.ends;
        writeln!(out, "l {} {}", a + 1, b + 1)?;
    }
    Ok(())
}
