//! PLY, ASCII: samples as vertices, and an edge between neighbours along a path.
//!
//! Vertices carry z = 0, which viewers insist on, and their lfs, a property of our own that they skip. PLY's grammar of
//! numbers is C's, so an infinite lfs is `inf`. A closed path has a closing edge.

use std::io::{self, Write};

use super::number::Number;
use super::{PathRows, SampleRow};

/// Writes samples.
///
/// # Errors
/// Those of `out`.
pub fn samples(out: &mut dyn Write, paths: &[PathRows<SampleRow>]) -> io::Result<()> {
    let vertices: usize = paths.iter().map(|path| path.rows.len()).sum();
    let edges: usize = paths.iter().map(|path| path.edges().count()).sum();
    writeln!(out, "ply\nformat ascii 1.0\nelement vertex {vertices}")?;
    writeln!(out, "property double x\nproperty double y\nproperty double z\nproperty double lfs")?;
    writeln!(out, "element edge {edges}\nproperty int vertex1\nproperty int vertex2\nend_header")?;
    for row in paths.iter().flat_map(|path| &path.rows) {
        writeln!(out, "{} {} 0 {}", Number(row.x), Number(row.y), Number(row.lfs))?;
    }
    let mut first = 0;
    for path in paths {
        let count = path.rows.len();
        let indices = PathRows { closed: path.closed, rows: (first..first + count).collect() };
        for (a, b) in indices.edges() {
            writeln!(out, "{a} {b}")?;
        }
        first += count;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_paths() {
        let path = |closed, n: u32| PathRows {
            closed,
            rows: (0..n)
                .map(|i| SampleRow { path: 0, segment: i, t: 0.0, x: f64::from(i), y: 0.5, lfs: 1.0, bound: "epsilon" })
                .collect(),
        };
        let mut out = Vec::new();
        samples(&mut out, &[path(true, 3), path(false, 2)]).expect("written");
        let text = String::from_utf8(out).expect("text");
        let (head, body) = text.split_once("end_header\n").expect("a header");
        assert!(head.contains("element vertex 5\n") && head.contains("element edge 4\n"), "counts: {head}");
        let body: Vec<_> = body.lines().collect();
        assert_eq!(body[..5], ["0 0.5 0 1", "1 0.5 0 1", "2 0.5 0 1", "0 0.5 0 1", "1 0.5 0 1"], "vertices");
        assert_eq!(body[5..], ["0 1", "1 2", "2 0", "3 4"], "edges");
    }
}
