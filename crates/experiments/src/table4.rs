//! Table 4: triangles, time and error of the simulation against sampling density.

use crate::clock;
use crate::mesh_study::{MeshStudy, of_the_study};
use crate::meshing::{DENSITIES, Mode};
use crate::report::{Cell, Report, Table};
use crate::{Experiment, ExperimentError, Finding};

/// What the paper prints: averages over five sketches. The second heading there says "Uniform" again; the text and Figure 10
/// have it as nonuniform.
const PRINTED: [(&str, [[f64; 6]; 3]); 2] = [
    (
        "uniform",
        [
            [1087.0, 1654.0, 3373.0, 6702.0, 11333.0, 24536.0],
            [0.011, 0.021, 0.069, 0.273, 0.835, 6.784],
            [3.526, 3.106, 2.700, 1.933, 1.703, f64::NAN],
        ],
    ),
    (
        "nonuniform",
        [
            [249.0, 252.0, 267.0, 301.0, 350.0, 477.0],
            [0.013, 0.012, 0.014, 0.013, 0.016, 0.074],
            [7.631, 3.481, 2.039, 2.354, 1.268, f64::NAN],
        ],
    ),
];

/// The experiment.
#[derive(Clone, Debug)]
pub struct Table4 {
    study: MeshStudy,
}

impl Table4 {
    /// Of a study.
    pub const fn new(study: MeshStudy) -> Self {
        Self { study }
    }
}

impl Experiment for Table4 {
    of_the_study!("table4");

    fn report(&self, findings: &[Vec<Finding>]) -> Result<Report, ExperimentError> {
        let columns = [
            "curve",
            "mode",
            "density",
            "triangles",
            "sampling_s",
            "meshing_s",
            "simulation_s",
            "rmse_percent",
            "min_angle",
        ];
        let head = "Table 4: simulation against density";
        let mut averages = Table::new("table4", format!("{head}, averages"), &columns);
        let mut each = Table::new("table4-drawings", format!("{head}, each drawing"), &columns);
        let row = |curve: &str, mode: &str, density: f64, measured: [f64; 6]| {
            let [triangles, rest @ ..] = measured;
            let mut row = vec![Cell::text(curve), Cell::text(mode), Cell::number(density), Cell::count(triangles)];
            row.extend(rest.map(Cell::number));
            row
        };
        for mode in Mode::ALL {
            for &density in self.study.densities() {
                let mut sum = [0.0; 6];
                for (curve, found) in self.study.curves.iter().zip(findings) {
                    let measured = self.study.measured(found, mode, density)?;
                    each.rows.push(row(&curve.name, mode.name(), density, measured));
                    sum.iter_mut().zip(measured).for_each(|(sum, value)| *sum += value);
                }
                let mean = sum.map(|sum| sum / self.study.curves.len() as f64);
                averages.rows.push(row("average", mode.name(), density, mean));
            }
        }
        for (mode, [triangles, seconds, rmse]) in PRINTED {
            for (i, &density) in DENSITIES.iter().enumerate() {
                let measured = [triangles[i], f64::NAN, f64::NAN, seconds[i], rmse[i], f64::NAN];
                averages.rows.push(row("printed", mode, density, measured));
            }
        }
        let names: Vec<&str> = self.study.curves.iter().map(|curve| curve.name.as_str()).collect();
        averages.notes = vec![
            format!("Drawings: {}. The paper's five are Croco, Lion and three sketches, of which only Croco is public.", names.join(", ")),
            "−Δu = 1 with u = 0 on all lines and on the rectangle, in linear elements. Samples: ε = 1, distances from 0.01 to 0.1 \
             (nonuniform: to the density). *uniform*: no edge longer than the density. *nonuniform*: only the smallest angle is \
             bounded. *graded*: edges no longer than the density d, 16 times lfs at the samples, and d (d/c)^(ω/π−1) where lines \
             leave an opening of ω, c a fourteenth of the rectangle's diagonal; the last two grow with the distance, by twice of it."
                .to_owned(),
            format!("Seconds are {} on one core: *sampling_s* samples and nodes, without the medial axis; *simulation_s* is matrix, \
                     factor and solution, the least of five.", clock::kind()),
            "*rmse_percent* is against the uniform mesh of density 0.005 in one fixed rectangle, in percent of the greatest value. \
             The printed RMSE column cannot be compared with it: the paper says neither which source or values it simulates with \
             (equal values alone have a constant solution) nor what its RMSE is a share of, its baseline is the densest mesh of \
             each mode (so that the error common to a mode disappears), and the prototype's rectangle grows with the density, so that \
             its columns are not solutions of one problem. Its shape can: the error falls with the density, and nonuniform meshes \
             have few triangles and a large error."
                .to_owned(),
            "The printed time grows quadratically with the triangles: that of a dense or badly ordered solver. Here it is a sparse \
             Cholesky factorisation ordered by nested dissection."
                .to_owned(),
        ];
        if self.study.curves.iter().any(|curve| curve.shipped) {
            averages.notes.push(
                "Warning: drawings that come with the program were used; with --curve the paper's Croco can be one of them."
                    .to_owned(),
            );
        }
        Ok(Report { name: "table4", tables: vec![averages, each], plots: vec![], bars: vec![], pictures: vec![] })
    }
}
