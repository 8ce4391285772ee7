//! Figure 7: share of exact reconstructions by ε.

use lineart::reconstruct::Algorithm;

use crate::plot::{Axis, Plot, Series};
use crate::report::{Cell, Report, Table};
use crate::study::{Column, Study};
use crate::{Experiment, ExperimentError, Finding};

/// The experiment: [`crate::study`] as a plot.
#[derive(Debug)]
pub struct Figure7 {
    study: Study,
}

impl Figure7 {
    /// Of a study.
    pub const fn new(study: Study) -> Self {
        Self { study }
    }
}

impl Experiment for Figure7 {
    fn name(&self) -> &'static str {
        "figure7"
    }

    fn fingerprint(&self) -> String {
        self.study.fingerprint()
    }

    fn units(&self) -> u32 {
        self.study.units()
    }

    fn run(&self, unit: u32) -> Result<Vec<Finding>, ExperimentError> {
        self.study.run(unit)
    }

    fn report(&self, findings: &[Vec<Finding>]) -> Result<Report, ExperimentError> {
        let columns = self.study.columns(findings)?;
        let names = Algorithm::MAIN.map(Algorithm::name);
        let mut table =
            Table::new("figure7", "Figure 7: exact reconstructions in percent, by ε", &["samples", "epsilon"]);
        table.columns.extend(names.map(str::to_owned));
        for column in &columns {
            for (i, thousandths) in column.thousandths.iter().enumerate() {
                let mut row = vec![Cell::text(column.key), Cell::number(f64::from(*thousandths) / 1000.0)];
                let at = |place| column.success(place).get(i).map_or(Cell::Empty, |point| Cell::number(point[1]));
                row.extend((0..names.len()).map(at));
                table.rows.push(row);
            }
        }
        table.notes = columns.iter().map(|column| format!("*{}*: {}.", column.key, column.label)).collect();
        table.notes.push("accord is this project's own and not in the paper.".to_owned());
        Ok(Report {
            name: "figure7",
            tables: vec![table],
            plots: columns.iter().map(plot).collect(),
            bars: vec![],
            pictures: vec![],
        })
    }
}

fn plot(column: &Column) -> Plot {
    let series = Algorithm::MAIN.into_iter().enumerate().map(|(place, algorithm)| Series {
        label: algorithm.name().to_owned(),
        points: column.success(place),
        dashed: !Algorithm::NINE.contains(&algorithm),
    });
    Plot {
        name: format!("figure7-{}", column.key),
        title: format!("Figure 7: {}", column.label),
        x: Axis { label: "ε".to_owned(), logarithmic: false },
        y: Axis { label: "exact reconstructions, %".to_owned(), logarithmic: false },
        series: series.collect(),
    }
}
