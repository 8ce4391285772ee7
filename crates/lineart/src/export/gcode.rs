//! G-code for pen plotters: one polyline per path, through its samples.
//!
//! The dialect is what Marlin, grbl and grblHAL have in common: `G21` (millimetres), `G90` (absolute), `G0` to travel,
//! `G1` to draw, `;` comments, one command per line. How a pen goes up and down differs from machine to machine, so
//! those lines are the user's. SVG's y points down and a plotter's points up: y is flipped about the frame of the
//! drawing, whose lower left corner becomes the origin.
//!
//! Coordinates have four decimals, a tenth of a micrometre: below the step of any plotter, and short enough for the line
//! buffers of 8-bit controllers.

use std::io::{self, Write};

use super::number::{Number, trimmed};
use super::{Header, OptionValue, PathRows, SampleRow, frame};
use crate::drawing::Drawing;

/// CSS pixels in a millimetre: the unit of a drawing that states no physical size.
const PX_PER_MM: f64 = 96.0 / 25.4;

/// What depends on the machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// Lines that lift the pen.
    pub pen_up: Vec<String>,
    /// Lines that lower the pen.
    pub pen_down: Vec<String>,
    /// Drawing speed in mm/min.
    pub feed: f64,
    /// Travel speed in mm/min.
    pub travel_feed: f64,
}

impl Default for Machine {
    /// A pen on a z axis, 5 mm above the paper when up.
    fn default() -> Self {
        Self { pen_up: vec!["G0 Z5".to_owned()], pen_down: vec!["G1 Z0".to_owned()], feed: 1500.0, travel_feed: 3000.0 }
    }
}

/// Writes samples as pen movements.
///
/// # Errors
/// Those of `out`.
pub fn samples(
    out: &mut dyn Write,
    header: &Header,
    drawing: &Drawing,
    machine: &Machine,
    paths: &[PathRows<SampleRow>],
) -> io::Result<()> {
    let [left, top, width, height] = frame(drawing);
    let scale = 1.0 / drawing.user_units_per_mm.unwrap_or(PX_PER_MM);
    let place = |row: &SampleRow| {
        let [x, y] = [(row.x - left) * scale, (top + height - row.y) * scale].map(|v| trimmed(v, 4));
        format!("X{x} Y{y}")
    };

    writeln!(out, "; fsample {}", env!("CARGO_PKG_VERSION"))?;
    writeln!(out, "; source: {}", one_line(&header.source))?;
    for (name, value) in &header.options {
        match value {
            OptionValue::Number(number) => writeln!(out, "; {name}: {}", Number(*number))?,
            OptionValue::Text(text) => writeln!(out, "; {name}: {}", one_line(text))?,
        }
    }
    writeln!(out, "; feed: {} mm/min, travel-feed: {} mm/min", Number(machine.feed), Number(machine.travel_feed))?;
    writeln!(out, "; pen-up: {}", one_line(&machine.pen_up.join(" | ")))?;
    writeln!(out, "; pen-down: {}", one_line(&machine.pen_down.join(" | ")))?;
    let assumed = if drawing.user_units_per_mm.is_some() { "" } else { " (no physical size in the drawing: 96 dpi)" };
    writeln!(out, "; 1 user unit = {} mm{assumed}", trimmed(scale, 6))?;
    writeln!(out, "; page: {} mm x {} mm", trimmed(width * scale, 4), trimmed(height * scale, 4))?;
    let drawn = paths.iter().filter(|path| !path.rows.is_empty()).count();
    writeln!(out, "; paths: {drawn}, points: {}", paths.iter().map(|path| path.rows.len()).sum::<usize>())?;

    writeln!(out, "G21\nG90")?;
    lines(out, &machine.pen_up)?;
    let [feed, travel] = [machine.feed, machine.travel_feed].map(Number);
    let mut group = None;
    for (index, path) in paths.iter().enumerate() {
        let Some((first, rest)) = path.rows.split_first() else { continue };
        let source = drawing.paths.get(index);
        let here = source.and_then(|path| path.group);
        if here != group {
            group = here;
            if let Some(name) = group.map(|group| group_name(drawing, group)).filter(|name| !name.is_empty()) {
                writeln!(out, "; group: {}", one_line(&name))?;
            }
        }
        let id = source.and_then(|path| path.id.as_deref()).map_or(String::new(), |id| format!(" {}", one_line(id)));
        writeln!(out, "; path {index}{id}")?;
        writeln!(out, "G0 {} F{travel}", place(first))?;
        lines(out, &machine.pen_down)?;
        let closing = path.closed.then_some(first);
        let mut speed = format!(" F{feed}");
        for row in rest.iter().chain(closing) {
            // The feed is modal: once per path is enough.
            writeln!(out, "G1 {}{}", place(row), std::mem::take(&mut speed))?;
        }
        lines(out, &machine.pen_up)?;
    }
    writeln!(out, "G0 X0 Y0 F{travel}\nM2")
}

/// The user's own lines.
fn lines(out: &mut dyn Write, commands: &[String]) -> io::Result<()> {
    commands.iter().try_for_each(|command| writeln!(out, "{command}"))
}

/// Names of the groups around something, outermost first; a layer's label before its id.
fn group_name(drawing: &Drawing, innermost: usize) -> String {
    let parent = |&index: &usize| drawing.groups.get(index).and_then(|group| group.parent);
    let mut names: Vec<&str> = std::iter::successors(Some(innermost), parent)
        .filter_map(|index| drawing.groups.get(index))
        .filter_map(|group| group.label.as_deref().or(group.id.as_deref()))
        .collect();
    names.reverse();
    names.join(" / ")
}

/// Text fit for a comment: nothing in it can end the line and start a command.
fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { '?' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::DrawingPath;

    #[test]
    fn a_triangle_and_a_line() {
        let drawing = Drawing {
            view_box: Some([0.0, 0.0, 100.0, 50.0]),
            user_units_per_mm: Some(2.0),
            paths: vec![
                DrawingPath { id: Some("a\nG28".to_owned()), ..DrawingPath::default() },
                DrawingPath::default(),
                DrawingPath::default(),
            ],
            ..Drawing::default()
        };
        let row = |x, y| SampleRow { path: 0, segment: 0, t: 0.0, x, y, lfs: 1.0, bound: "epsilon" };
        let paths = [
            PathRows { closed: true, rows: vec![row(0.0, 50.0), row(1.0 / 3.0, 50.0), row(100.0, 0.0)] },
            PathRows { closed: false, rows: vec![] },
            PathRows { closed: false, rows: vec![row(10.0, 10.0), row(20.0, 10.0)] },
        ];
        let header = Header { source: "t.svg".to_owned(), options: vec![], diagonal: 1.0 };
        let machine = Machine { feed: 800.0, ..Machine::default() };
        let mut out = Vec::new();
        samples(&mut out, &header, &drawing, &machine, &paths).expect("written");
        let text = String::from_utf8(out).expect("text");
        let commands: Vec<_> = text.lines().filter(|line| !line.starts_with(';')).collect();
        let expected = [
            "G21",
            "G90",
            "G0 Z5", // page, then the triangle
            "G0 X0 Y0 F3000",
            "G1 Z0",
            "G1 X0.1667 Y0 F800",
            "G1 X50 Y25",
            "G1 X0 Y0",
            "G0 Z5", // the line
            "G0 X5 Y20 F3000",
            "G1 Z0",
            "G1 X10 Y20 F800",
            "G0 Z5",
            "G0 X0 Y0 F3000",
            "M2",
        ];
        assert_eq!(commands, expected, "the whole program; an id cannot smuggle a command in");
    }
}
