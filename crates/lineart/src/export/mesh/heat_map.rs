//! Values on a mesh as SVG: bands of colour, lines of equal value, the drawing, a legend.

use std::io::{self, Write};

use super::MeshRows;
use super::picture::{frame_of, lines, open};
use crate::export::number::Readable;
use crate::export::palette;
use crate::simulate::contour::{bands, contour, levels};

/// Bands of colour: so many that their steps are hardly seen.
const BANDS: usize = 40;

/// Writes the picture; `lines_of` is the number of lines of equal value.
///
/// # Errors
/// Those of `out`.
pub fn write(out: &mut dyn Write, rows: &MeshRows<'_>, lines_of: usize) -> io::Result<()> {
    let Some(values) = rows.values else { return super::picture::write(out, rows) };
    let mesh = rows.mesh;
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let frame = frame_of(rows);
    let below = 0.07 * frame.extent().x.max(frame.extent().y);
    let (pen, diagonal) = open(out, &frame, below)?;
    let (x, y) = (frame.min.x, frame.max.y);
    let (width, height) = (frame.extent().x, frame.extent().y);
    let box_of = |x: f64, y: f64, width: f64, height: f64, fill: &str| {
        let [x, y, width, height] = [x, y, width, height].map(|v| pen.number(v));
        format!("<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"{fill}\"/>")
    };
    writeln!(out, "{}", box_of(x, frame.min.y, width, height + below, "#fff"))?;

    let steps = levels(least, greatest, BANDS - 1);
    let colour = |band: usize| palette::full((band as f64 + 0.5) / BANDS as f64);
    let mut areas = vec![String::new(); steps.len() + 1];
    for triangle in &mesh.triangles {
        let corners = triangle.map(|v| mesh.points[v as usize]);
        for (band, polygon) in bands(corners, triangle.map(|v| values[v as usize]), &steps) {
            let points: Vec<String> = polygon.into_iter().map(|p| pen.point(p)).collect();
            areas[band].push_str(&format!("M{}Z", points.join("L")));
        }
    }
    // A thin stroke of the same colour closes the seams that smoothing leaves between neighbours.
    let seam = pen.number(0.0008 * diagonal);
    for (band, data) in areas.iter().enumerate().filter(|(_, data)| !data.is_empty()) {
        let colour = colour(band);
        writeln!(out, "<path fill=\"{colour}\" stroke=\"{colour}\" stroke-width=\"{seam}\" d=\"{data}\"/>")?;
    }
    let thin = pen.number(0.0008 * diagonal);
    for level in levels(least, greatest, lines_of) {
        write!(out, "<path fill=\"none\" stroke=\"#fff\" stroke-opacity=\"0.6\" stroke-width=\"{thin}\" d=\"")?;
        for line in contour(mesh, values, level).lines {
            let points: Vec<String> = line.into_iter().map(|p| pen.point(p)).collect();
            write!(out, "M{}", points.join("L"))?;
        }
        writeln!(out, "\"/>")?;
    }
    let thick = pen.number(0.0025 * diagonal);
    writeln!(
        out,
        "<path fill=\"none\" stroke=\"#000\" stroke-width=\"{thick}\" stroke-linecap=\"round\" d=\"{}\"/>",
        lines(rows, pen)
    )?;

    let (bar, top) = (0.6 * width, y + 0.3 * below);
    if !steps.is_empty() {
        for band in 0..BANDS {
            let from = x + 0.2 * width + bar * (band as f64 / BANDS as f64);
            // Each runs under the next: no seams.
            let to = x + 0.2 * width + bar;
            writeln!(out, "{}", box_of(from, top, to - from, 0.4 * below, &colour(band)))?;
        }
    }
    let size = pen.number(0.4 * below);
    let base = pen.number(top + 0.36 * below);
    for (value, at, anchor) in [(least, 0.18, "end"), (greatest, 0.82, "start")] {
        let at = pen.number(x + at * width);
        writeln!(
            out,
            "<text x=\"{at}\" y=\"{base}\" font-family=\"sans-serif\" font-size=\"{size}\" text-anchor=\"{anchor}\">{}</text>",
            Readable(value)
        )?;
    }
    writeln!(out, "</svg>")
}
