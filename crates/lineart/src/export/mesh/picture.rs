//! A mesh as SVG: its edges, thin, and the lines of the drawing over them.

use std::fmt::Write as _;
use std::io::{self, Write};

use feature_sampling::geometry::{Aabb, Point};

use super::MeshRows;
use crate::export::number::trimmed;

/// Coordinates with as many decimals as a ten-thousandth of the picture asks for: a mesh has many of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pen {
    decimals: usize,
}

impl Pen {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cut to what there is room for")]
    pub(super) fn new(diagonal: f64) -> Self {
        let decimals = (5.0 - diagonal.log10()).ceil();
        Self { decimals: if decimals.is_finite() { decimals.clamp(0.0, 300.0) as usize } else { 6 } }
    }

    /// A coordinate or a length.
    pub(super) fn number(self, value: f64) -> String {
        trimmed(value, self.decimals)
    }

    /// A point.
    pub(super) fn point(self, p: Point<f64>) -> String {
        format!("{} {}", self.number(p.x), self.number(p.y))
    }
}

/// The head of a picture over a box, 800 pixels wide or high; answers pen and diagonal.
pub(super) fn open(out: &mut dyn Write, frame: &Aabb<f64>, below: f64) -> io::Result<(Pen, f64)> {
    let extent = frame.extent();
    let diagonal = extent.norm();
    let pen = Pen::new(diagonal);
    let pixel = 800.0 / extent.x.max(extent.y + below).max(f64::MIN_POSITIVE);
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{} {} {}\" width=\"{}\" height=\"{}\">",
        pen.point(frame.min),
        pen.number(extent.x),
        pen.number(extent.y + below),
        trimmed(extent.x * pixel, 2),
        trimmed((extent.y + below) * pixel, 2)
    )?;
    Ok((pen, diagonal))
}

/// The box of a mesh: its rectangle.
pub(super) fn frame_of(rows: &MeshRows<'_>) -> Aabb<f64> {
    Aabb::around(rows.mesh.points.iter())
}

/// The pieces of lines as path data, neighbours strung together.
pub(super) fn lines(rows: &MeshRows<'_>, pen: Pen) -> String {
    let mut data = String::new();
    let mut last = None;
    for border in rows.mesh.borders.iter().filter(|border| border.line.is_some()) {
        let [a, b] = border.ends;
        // Writing to a string cannot fail.
        if last != Some(a) {
            let _ = write!(data, "M{}", pen.point(rows.mesh.points[a as usize]));
        }
        let _ = write!(data, "L{}", pen.point(rows.mesh.points[b as usize]));
        last = Some(b);
    }
    data
}

/// Writes the picture.
///
/// # Errors
/// Those of `out`.
pub fn write(out: &mut dyn Write, rows: &MeshRows<'_>) -> io::Result<()> {
    let mesh = rows.mesh;
    let frame = frame_of(rows);
    let (pen, diagonal) = open(out, &frame, 0.0)?;
    writeln!(
        out,
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#fff\"/>",
        pen.number(frame.min.x),
        pen.number(frame.min.y),
        pen.number(frame.extent().x),
        pen.number(frame.extent().y)
    )?;
    // Every inner edge belongs to two triangles, in opposite directions.
    let mut edges: Vec<[u32; 2]> = mesh
        .triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    edges.sort_unstable();
    edges.dedup();
    let width = |share: f64| pen.number(share * diagonal);
    write!(out, "<path fill=\"none\" stroke=\"#8a9aa8\" stroke-width=\"{}\" d=\"", width(0.0006))?;
    for [a, b] in edges {
        let [a, b] = [a, b].map(|v| pen.point(mesh.points[v as usize]));
        write!(out, "M{a}L{b}")?;
    }
    writeln!(out, "\"/>")?;
    writeln!(
        out,
        "<path fill=\"none\" stroke=\"#b5121b\" stroke-width=\"{}\" stroke-linecap=\"round\" d=\"{}\"/>",
        width(0.002),
        lines(rows, pen)
    )?;
    writeln!(out, "</svg>")
}
