//! Figure 10: triangles, time and error against density; and error against triangles.

use crate::mesh_study::{MeshStudy, of_the_study};
use crate::meshing::Mode;
use crate::plot::{Axis, Plot, Series};
use crate::report::{Cell, Report, Table};
use crate::{Experiment, ExperimentError, Finding};

/// The experiment.
#[derive(Clone, Debug)]
pub struct Figure10 {
    study: MeshStudy,
}

impl Figure10 {
    /// Of a study.
    pub const fn new(study: MeshStudy) -> Self {
        Self { study }
    }

    /// One series for each mode.
    fn series(
        &self,
        mut point: impl FnMut(Mode, f64) -> Result<[f64; 2], ExperimentError>,
    ) -> Result<Vec<Series>, ExperimentError> {
        let mut out = Vec::new();
        for mode in Mode::ALL {
            let points =
                self.study.densities().iter().map(|&density| point(mode, density)).collect::<Result<_, _>>()?;
            out.push(Series { label: mode.name().to_owned(), points, dashed: false });
        }
        Ok(out)
    }
}

impl Experiment for Figure10 {
    of_the_study!("figure10");

    fn report(&self, findings: &[Vec<Finding>]) -> Result<Report, ExperimentError> {
        let axis = |label: &str| Axis { label: label.to_owned(), logarithmic: true };
        let mean = |mode, density, place: usize| -> Result<f64, ExperimentError> {
            let mut sum = 0.0;
            for found in findings {
                sum += self.study.measured(found, mode, density)?[place];
            }
            Ok(sum / findings.len() as f64)
        };
        let mut plots = Vec::new();
        for (place, name, label) in
            [(0, "triangles", "triangles"), (3, "time", "simulation, s"), (4, "error", "RMSE, %")]
        {
            plots.push(Plot {
                name: format!("figure10-{name}"),
                title: format!("Figure 10: {label} against density, averages"),
                x: axis("density, diagonals"),
                y: axis(label),
                series: self.series(|mode, density| Ok([density, mean(mode, density, place)?]))?,
            });
        }
        for (curve, found) in self.study.curves.iter().zip(findings) {
            let series = self.series(|mode, density| {
                let measured = self.study.measured(found, mode, density)?;
                Ok([measured[0], measured[4]])
            })?;
            plots.push(Plot {
                name: format!("figure10-{}", curve.name),
                title: format!("{}: error against triangles", curve.name),
                x: axis("triangles"),
                y: axis("RMSE, %"),
                series,
            });
        }
        let columns = ["curve", "density", "uniform_rmse", "graded_rmse", "uniform_at_as_many_triangles", "gain"];
        let mut table =
            Table::new("figure10", "Figure 10: graded against uniform meshes of as many triangles", &columns);
        for (curve, found) in self.study.curves.iter().zip(findings) {
            let at = |mode, density| self.study.measured(found, mode, density);
            let mut uniform = Vec::new();
            for &density in self.study.densities() {
                let measured = at(Mode::Uniform, density)?;
                uniform.push([measured[0], measured[4]]);
            }
            for &density in self.study.densities() {
                let graded = at(Mode::Graded, density)?;
                let same = interpolated(&uniform, graded[0]);
                table.rows.push(vec![
                    Cell::text(&curve.name),
                    Cell::number(density),
                    Cell::number(at(Mode::Uniform, density)?[4]),
                    Cell::number(graded[4]),
                    Cell::number(same),
                    Cell::number(same / graded[4]),
                ]);
            }
        }
        table.notes.push(
            "*uniform_at_as_many_triangles* is the error that uniform meshes of the curve have at the number of triangles of the \
             graded one, between those measured on logarithmic axes; empty outside of them. *gain* above 1: the graded mesh is better."
                .to_owned(),
        );
        Ok(Report { name: "figure10", tables: vec![table], plots, bars: vec![], pictures: vec![] })
    }
}

/// The y at an x between points of ascending x, on logarithmic axes; NaN outside.
fn interpolated(points: &[[f64; 2]], x: f64) -> f64 {
    let between = points.windows(2).find(|pair| pair[0][0] <= x && x <= pair[1][0]);
    between.map_or(f64::NAN, |pair| {
        let [[x0, y0], [x1, y1]] = [pair[0], pair[1]].map(|p| p.map(f64::ln));
        (y0 + (x.ln() - x0) / (x1 - x0) * (y1 - y0)).exp()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_on_logarithmic_axes() {
        let points = [[10.0, 1.0], [1000.0, 0.01]];
        assert!((interpolated(&points, 100.0) - 0.1).abs() < 1e-12, "the middle");
        assert!(interpolated(&points, 1.0).is_nan(), "outside");
    }
}
