//! MSH 2.2, ASCII: gmsh's format that every reader knows.
//!
//! Triangles are the physical surface 1, `mesh`. Each path is a physical curve: its index plus 1; the rectangle comes after
//! the last. Values are node data.

use std::collections::BTreeSet;
use std::io::{self, Write};

use super::MeshRows;
use crate::export::number::Number;

/// Writes the mesh. Indices count from 1.
///
/// # Errors
/// Those of `out`.
pub fn write(out: &mut dyn Write, rows: &MeshRows<'_>) -> io::Result<()> {
    let mesh = rows.mesh;
    let paths: BTreeSet<u32> = mesh.borders.iter().filter_map(|border| rows.path(border)).collect();
    let frame = paths.last().map_or(1, |last| last + 2);
    writeln!(out, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}", paths.len() + 2)?;
    for path in paths {
        writeln!(out, "1 {} \"{}\"", path + 1, rows.name(path))?;
    }
    writeln!(out, "1 {frame} \"frame\"\n2 1 \"mesh\"\n$EndPhysicalNames\n$Nodes\n{}", mesh.points.len())?;
    for (number, p) in (1..).zip(&mesh.points) {
        writeln!(out, "{number} {} {} 0", Number(p.x), Number(p.y))?;
    }
    writeln!(out, "$EndNodes\n$Elements\n{}", mesh.borders.len() + mesh.triangles.len())?;
    let mut number = 0;
    for border in &mesh.borders {
        number += 1;
        let ([a, b], tag) = (border.ends, rows.path(border).map_or(frame, |path| path + 1));
        writeln!(out, "{number} 1 2 {tag} {tag} {} {}", a + 1, b + 1)?;
    }
    for [a, b, c] in &mesh.triangles {
        number += 1;
        writeln!(out, "{number} 2 2 1 1 {} {} {}", a + 1, b + 1, c + 1)?;
    }
    writeln!(out, "$EndElements")?;
    if let Some(values) = rows.values {
        writeln!(out, "$NodeData\n1\n\"u\"\n1\n0\n3\n0\n1\n{}", values.len())?;
        for (number, value) in (1..).zip(values) {
            writeln!(out, "{number} {}", Number(*value))?;
        }
        writeln!(out, "$EndNodeData")?;
    }
    Ok(())
}
