//! Bar charts, as SVG.

use std::fmt::Write;

use lineart::export::number::trimmed;

/// Height of a bar, of the space between groups, and the places of the labels and the bars.
const BAR: f64 = 10.0;
const SPACE: f64 = 8.0;
const LEFT: f64 = 150.0;
const WIDTH: f64 = 400.0;
const TOP: f64 = 36.0;

/// From light to dark.
const COLOURS: [&str; 4] = ["#9ecae1", "#4292c6", "#084594", "#000000"];

/// A chart of groups of horizontal bars.
#[derive(Clone, Debug, PartialEq)]
pub struct Bars {
    /// A word for the name of the file.
    pub name: String,
    /// A heading.
    pub title: String,
    /// What the numbers are of.
    pub unit: String,
    /// The value of a bar of full length.
    pub full: f64,
    /// What the bars of a group stand for; up to four.
    pub series: Vec<String>,
    /// Groups: a label and a value for each series; NaN has no bar.
    pub groups: Vec<(String, Vec<f64>)>,
}

impl Bars {
    /// The picture.
    pub fn svg(&self) -> String {
        let group = BAR * self.series.len() as f64 + SPACE;
        let height = TOP + group * self.groups.len() as f64 + 44.0;
        let width = LEFT + WIDTH + 60.0;
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
             height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n\
             <text x=\"10\" y=\"20\" font-size=\"14\">{}</text>\n",
            self.title
        );
        // Writing to a string cannot fail.
        for quarter in 0..=4 {
            let x = LEFT + WIDTH * f64::from(quarter) / 4.0;
            let value = trimmed(self.full * f64::from(quarter) / 4.0, 3);
            let bottom = height - 44.0;
            let _ = writeln!(
                out,
                "<path d=\"M{x} {TOP}V{bottom}\" stroke=\"#ddd\"/><text x=\"{x}\" y=\"{}\" text-anchor=\"middle\">{value}{}</text>",
                bottom + 14.0,
                self.unit
            );
        }
        for (row, (label, values)) in self.groups.iter().enumerate() {
            let y = TOP + group * row as f64 + SPACE / 2.0;
            let middle = y + BAR * self.series.len() as f64 / 2.0 + 4.0;
            let _ = writeln!(out, "<text x=\"{}\" y=\"{middle}\" text-anchor=\"end\">{label}</text>", LEFT - 8.0);
            for (i, value) in values.iter().enumerate().filter(|(_, value)| value.is_finite()) {
                let (y, length) = (y + BAR * i as f64, WIDTH * value / self.full);
                let _ = writeln!(
                    out,
                    "<rect x=\"{LEFT}\" y=\"{y}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\
                     <text x=\"{}\" y=\"{}\" font-size=\"9\">{}</text>",
                    trimmed(length, 2),
                    BAR - 1.0,
                    COLOURS[i % COLOURS.len()],
                    trimmed(LEFT + length + 4.0, 2),
                    y + BAR - 2.0,
                    trimmed(*value, 1)
                );
            }
        }
        for (i, label) in self.series.iter().enumerate() {
            let (x, y) = (LEFT + 110.0 * i as f64, height - 12.0);
            let _ = writeln!(
                out,
                "<rect x=\"{x}\" y=\"{}\" width=\"10\" height=\"10\" fill=\"{}\"/><text x=\"{}\" y=\"{y}\">{label}</text>",
                y - 10.0,
                COLOURS[i % COLOURS.len()],
                x + 15.0
            );
        }
        out.push_str("</svg>\n");
        out
    }
}
