//! Meshes on their way out: STL, PLY, OBJ, MSH, VTK, and pictures.
//!
//! All are ASCII, in user units with z = 0, triangles counterclockwise in the coordinates as they are (their normal is +z;
//! since y points down in a drawing, they look clockwise there). The lines of the drawing go along wherever the format can
//! say so: as edges, line elements or polylines, with the path that they belong to.
//!
//! | format | triangles | lines | values of a simulation |
//! |---|---|---|---|
//! | STL | facets | | |
//! | PLY | faces | edges, with their path | vertex property |
//! | OBJ | faces | `l`, a group for each path | |
//! | MSH (gmsh 2.2) | elements, physical surface 1 | elements, a physical curve for each path | node data |
//! | VTK (legacy) | cells | cells, with their path | point data |

pub mod heat_map;
pub mod msh;
pub mod obj;
pub mod picture;
pub mod ply;
pub mod raster;
pub mod stl;
pub mod table;
pub mod vtk;

use crate::mesh::{Border, Mesh};

/// A mesh and what is known about its lines and vertices.
#[derive(Clone, Copy, Debug)]
pub struct MeshRows<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// The path of each line; where several share a line, the first.
    pub path_of: &'a [u32],
    /// Names of the paths, for formats that have names.
    pub names: &'a [String],
    /// A value at each vertex.
    pub values: Option<&'a [f64]>,
    /// Name of the drawing.
    pub source: &'a str,
}

impl MeshRows<'_> {
    /// The path that a border belongs to; `None` for the rectangle.
    pub fn path(&self, border: &Border) -> Option<u32> {
        self.path_of.get(border.line? as usize).copied()
    }

    /// The name of the drawing without what would break a line of text.
    fn title(&self) -> String {
        self.source.chars().map(|c| if c.is_control() { ' ' } else { c }).take(200).collect()
    }

    /// The name of a path, in one word of printable ASCII.
    fn name(&self, path: u32) -> String {
        let name = self.names.get(path as usize).map_or("", String::as_str);
        let plain = |c: char| if c.is_ascii_alphanumeric() || "-_.:".contains(c) { c } else { '_' };
        let word: String = name.chars().map(plain).take(100).collect();
        if word.is_empty() { format!("path-{path}") } else { format!("path-{path}-{word}") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Lines, Options, mesh};
    use feature_sampling::geometry::{Aabb, Point};

    /// One line in a square, as coarse as can be; values are x.
    fn with_rows(check: impl FnOnce(&MeshRows<'_>)) {
        let frame = Aabb { min: Point::new(0.0, 0.0), max: Point::new(4.0, 4.0) };
        let points = [Point::new(1.0, 2.0), Point::new(3.0, 2.0)];
        let outcome = mesh(&Lines { points: &points, edges: &[[0, 1]] }, &frame, &Options::default()).expect("noded");
        let values: Vec<f64> = outcome.mesh.points.iter().map(|p| p.x).collect();
        let rows = MeshRows {
            mesh: &outcome.mesh,
            path_of: &[0],
            names: &["a \"line\"".to_owned()],
            values: Some(&values),
            source: "a\nb.svg",
        };
        check(&rows);
    }

    #[test]
    fn every_format_says_the_same() {
        with_rows(|rows| {
            let text = |write: &dyn Fn(&mut dyn std::io::Write) -> std::io::Result<()>| {
                let mut out = Vec::new();
                write(&mut out).expect("written");
                String::from_utf8(out).expect("text")
            };
            let (points, triangles) = (rows.mesh.points.len(), rows.mesh.triangles.len());
            let borders = rows.mesh.borders.len();
            let sides = rows.mesh.borders.iter().filter(|border| border.line.is_none()).count();
            assert!(points >= 6 && triangles + sides == 2 * points - 2, "Euler: {points} {triangles} {sides}");
            let stl = text(&|out| stl::write(out, rows));
            assert_eq!(stl.matches("facet normal 0 0 1\n").count(), triangles, "facets");
            let ply = text(&|out| ply::write(out, rows));
            assert!(ply.contains(&format!("element face {triangles}\n")), "faces");
            let faces = ply.lines().skip_while(|line| *line != "end_header").skip(1 + points).take(triangles);
            assert_eq!(faces.filter(|line| line.starts_with("3 ")).count(), triangles, "as many as said");
            assert_eq!(ply.lines().filter(|line| line.ends_with(" -1")).count(), sides, "the sides");
            let obj = text(&|out| obj::write(out, rows));
            assert_eq!(obj.matches("\nf ").count(), triangles, "faces");
            assert_eq!(obj.matches("\nl ").count(), borders, "lines");
            let msh = text(&|out| msh::write(out, rows));
            assert!(msh.contains(&format!("$Elements\n{}\n", triangles + borders)), "elements");
            assert!(msh.contains("1 1 \"path-0-a__line_\"\n"), "a name without quotes");
            let vtk = text(&|out| vtk::write(out, rows));
            assert!(vtk.contains(&format!("CELLS {} {}\n", triangles + borders, 4 * triangles + 3 * borders)), "cells");
            assert!(vtk.lines().nth(1).is_some_and(|title| title.contains("a b.svg")), "one line of title");
            assert!(
                vtk.contains("SCALARS u double 1\nLOOKUP_TABLE default\n1\n3\n0\n4\n4\n0\n"),
                "values are x: {vtk}"
            );
        });
    }
}
