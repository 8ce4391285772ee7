//! The report: one JSON object, `{version, source, regions: [{colour, area, loops, hints, outside, gaps}], warnings}`.
//!
//! Hints are numbered from 1 in the order they were given; gaps have their two ends and their length, in user units.

use std::io::{self, Write};

use super::Painting;
use crate::export::json::{JsonText, VERSION};
use crate::export::number::JsonNumber;

/// Writes the report.
///
/// # Errors
/// Those of `out`.
pub fn report(out: &mut dyn Write, source: &str, painting: &Painting) -> io::Result<()> {
    writeln!(out, "{{\"version\":{VERSION},\"source\":{},\"regions\":[", JsonText(source))?;
    for (i, region) in painting.regions.iter().enumerate() {
        let colour = region.colour.as_ref().map_or("null".to_owned(), |c| JsonText(&c.to_string()).to_string());
        let hints: Vec<String> = region.hints.iter().map(|hint| (hint + 1).to_string()).collect();
        write!(
            out,
            "{{\"colour\":{colour},\"area\":{},\"loops\":{},\"hints\":[{}],\"outside\":{},\"gaps\":[",
            JsonNumber(region.area),
            region.outlines.len(),
            hints.join(","),
            region.outside
        )?;
        for (j, gap) in region.gaps.iter().enumerate() {
            let comma = if j > 0 { "," } else { "" };
            let [x0, y0, x1, y1, length] =
                [gap.ends[0].x, gap.ends[0].y, gap.ends[1].x, gap.ends[1].y, gap.length].map(JsonNumber);
            write!(out, "{comma}{{\"from\":[{x0},{y0}],\"to\":[{x1},{y1}],\"length\":{length}}}")?;
        }
        let comma = if i + 1 < painting.regions.len() { "," } else { "" };
        writeln!(out, "]}}{comma}")?;
    }
    let warnings: Vec<String> = painting.warnings.iter().map(|w| JsonText(w).to_string()).collect();
    writeln!(out, "],\"warnings\":[{}]}}", warnings.join(","))
}
