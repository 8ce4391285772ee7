//! Figures 12 and 13 as pictures: drawings, samples and meshes; meshes and simulations at six densities.

use std::fmt::Write as _;

use lineart::export::mesh::{MeshRows, heat_map, picture};

use crate::meshing::{DENSITIES, Meshed, Mode, Subject};
use crate::report::{Cell, Report, Table};
use crate::source::Source;
use crate::{Experiment, ExperimentError, Finding};

/// Which of the two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pictures {
    /// Figure 12: each drawing's polylines of samples, and its mesh at density 0.1.
    Meshes,
    /// Figure 13: one drawing at six densities: uniform and nonuniform meshes, and the simulations on them.
    Densities,
}

/// The experiment.
#[derive(Clone, Debug)]
pub struct Figure12 {
    curves: Vec<Source>,
    which: Pictures,
}

/// Side of a picture in its row, in pixels.
const SIDE: f64 = 240.0;

impl Figure12 {
    /// Of these curves; [`Pictures::Densities`] takes the first.
    pub fn new(mut curves: Vec<Source>, which: Pictures) -> Self {
        if which == Pictures::Densities {
            curves.truncate(1);
        }
        Self { curves, which }
    }

    /// The rows of pictures, with a word for each picture.
    fn rows(&self) -> Result<Vec<Vec<(String, String)>>, ExperimentError> {
        let mut rows = Vec::new();
        for source in &self.curves {
            let subject = Subject::new(source)?;
            match self.which {
                Pictures::Meshes => {
                    let mut row = Vec::new();
                    for mode in Mode::ALL {
                        let meshed = subject.mesh(mode, DENSITIES[0])?;
                        row.push((format!("{}, {}", source.name, words(mode, &meshed)), drawn(&meshed, None)?));
                    }
                    rows.push(row);
                }
                Pictures::Densities => {
                    for mode in Mode::ALL {
                        let (mut meshes, mut solutions) = (Vec::new(), Vec::new());
                        for density in DENSITIES {
                            let meshed = subject.mesh(mode, density)?;
                            let (solution, _) = subject.solve(&meshed, 1)?;
                            meshes.push((format!("{density}: {}", words(mode, &meshed)), drawn(&meshed, None)?));
                            let greatest = format!("greatest {:.5}", solution.greatest);
                            solutions.push((greatest, drawn(&meshed, Some(&solution.values))?));
                        }
                        rows.extend([meshes, solutions]);
                    }
                }
            }
        }
        Ok(rows)
    }
}

fn words(mode: Mode, meshed: &Meshed) -> String {
    format!("{}, {} triangles", mode.name(), meshed.mesh.triangles.len())
}

/// A mesh or its values as SVG.
fn drawn(meshed: &Meshed, values: Option<&[f64]>) -> Result<String, ExperimentError> {
    let path_of = meshed.drawn.path_of();
    let rows = MeshRows { mesh: &meshed.mesh, path_of: &path_of, names: &[], values, source: "" };
    let mut out = Vec::new();
    let written = match values {
        Some(_) => heat_map::write(&mut out, &rows, 8),
        None => picture::write(&mut out, &rows),
    };
    written.map_err(|error| ExperimentError::new(error.to_string()))?;
    String::from_utf8(out).map_err(|error| ExperimentError::new(error.to_string()))
}

/// Pictures in rows, with their words below them.
fn sheet(rows: &[Vec<(String, String)>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let (width, height) = (SIDE * columns as f64, (SIDE + 20.0) * rows.len() as f64);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n"
    );
    for (r, row) in rows.iter().enumerate() {
        for (c, (words, svg)) in row.iter().enumerate() {
            let (x, y) = (SIDE * c as f64, (SIDE + 20.0) * r as f64);
            // Each picture is a document of its own: its size becomes that of its place.
            let body = svg.split_once(" width=\"").map_or(svg.as_str(), |(head, _)| head);
            let rest = svg.split_once(">\n").map_or("", |(_, rest)| rest);
            let view = body.split_once("viewBox=").map_or("", |(_, view)| view);
            let inner = SIDE - 8.0;
            // Writing to a string cannot fail.
            let _ = write!(
                out,
                "<svg x=\"{}\" y=\"{}\" width=\"{inner}\" height=\"{inner}\" viewBox={view}>\n{rest}\
                 <text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{words}</text>\n",
                x + 4.0,
                y + 4.0,
                x + SIDE / 2.0,
                y + SIDE + 10.0
            );
        }
    }
    out.push_str("</svg>\n");
    out
}

impl Experiment for Figure12 {
    fn name(&self) -> &'static str {
        match self.which {
            Pictures::Meshes => "figure12",
            Pictures::Densities => "figure13",
        }
    }

    fn fingerprint(&self) -> String {
        self.curves.iter().map(Source::fingerprint).collect::<Vec<_>>().join(" ")
    }

    fn units(&self) -> u32 {
        1
    }

    fn run(&self, _unit: u32) -> Result<Vec<Finding>, ExperimentError> {
        // Pictures are no numbers: they are drawn with the report.
        Ok(vec![Finding::new("curves", self.curves.len() as f64)])
    }

    fn report(&self, _findings: &[Vec<Finding>]) -> Result<Report, ExperimentError> {
        let rows = self.rows()?;
        let title = match self.which {
            Pictures::Meshes => "Figure 12: meshes at density 0.1",
            Pictures::Densities => "Figure 13: meshes and simulations at six densities",
        };
        let mut table = Table::new(self.name(), title, &["row", "picture"]);
        for (r, row) in (1_u64..).zip(&rows) {
            table.rows.extend(row.iter().map(|(words, _)| vec![Cell::Count(r), Cell::text(words)]));
        }
        let file = (format!("{}.svg", self.name()), sheet(&rows));
        Ok(Report { name: self.name(), tables: vec![table], plots: vec![], bars: vec![], pictures: vec![file] })
    }
}
