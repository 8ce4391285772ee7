//! Figure 6: exact reconstructions of real-world curves.
//!
//! The paper runs a benchmark of more than 2000 curves whose list is not at hand. Here the curves are outlines of images or
//! of drawings ([`crate::silhouette`]), each at several strides; a run is correct if the edges are exactly those between
//! consecutive points. Units are outlines.

use lineart::reconstruct::Algorithm;

use crate::bars::Bars;
use crate::report::{Cell, Report, Table};
use crate::silhouette::Outline;
use crate::{Experiment, ExperimentError, Finding};

/// Every so many boundary pixels.
pub const STRIDES: [u32; 3] = [6, 10, 16];

/// Of 51, 58 and 60 silhouettes of MPEG-7 CE-Shape-1 (part B) at these strides, an independent implementation found so
/// many percent right; of nn-crust it ran the form here, of sigdt the joined one.
const MPEG7: [(Algorithm, [u32; 3]); 9] = [
    (Algorithm::ConservativeCrust, [49, 32, 30]),
    (Algorithm::CompatibleCrust, [50, 34, 36]),
    (Algorithm::Connect2d, [92, 77, 73]),
    (Algorithm::Crawl, [54, 39, 41]),
    (Algorithm::Crust, [50, 39, 40]),
    (Algorithm::HnnCrust, [50, 39, 41]),
    (Algorithm::NnCrust, [47, 34, 33]),
    (Algorithm::Peel, [50, 39, 41]),
    (Algorithm::Sigdt, [84, 72, 70]),
];

/// The experiment.
#[derive(Clone, Debug)]
pub struct Figure6 {
    outlines: Vec<Outline>,
    shipped: bool,
}

impl Figure6 {
    /// Of these outlines; `shipped`: they came with the program.
    pub const fn new(outlines: Vec<Outline>, shipped: bool) -> Self {
        Self { outlines, shipped }
    }
}

impl Experiment for Figure6 {
    fn name(&self) -> &'static str {
        "figure6"
    }

    fn fingerprint(&self) -> String {
        let hashes = self.outlines.iter().flat_map(|outline| outline.fingerprint().to_le_bytes());
        format!("{} outlines #{:016x} strides={STRIDES:?}", self.outlines.len(), crate::source::fnv(hashes))
    }

    fn units(&self) -> u32 {
        u32::try_from(self.outlines.len()).unwrap_or(u32::MAX)
    }

    fn run(&self, unit: u32) -> Result<Vec<Finding>, ExperimentError> {
        let Some(outline) = self.outlines.get(unit as usize) else { return Ok(Vec::new()) };
        let mut findings = Vec::new();
        for stride in STRIDES {
            // Too few points for a shape at this stride: no finding.
            let Some(set) = outline.points(stride) else { continue };
            let correct = set
                .correct(&Algorithm::MAIN)
                .map_err(|error| ExperimentError::new(format!("{}: {error}", outline.name)))?;
            let named = Algorithm::MAIN.iter().zip(correct);
            findings.extend(
                named.map(|(a, right)| Finding::new(format!("{}/{stride}", a.name()), f64::from(u8::from(right)))),
            );
        }
        Ok(findings)
    }

    fn report(&self, findings: &[Vec<Finding>]) -> Result<Report, ExperimentError> {
        let mut table = Table::new(
            "figure6",
            "Figure 6: exact reconstructions of outlines in percent, by stride",
            &["algorithm", "stride_6", "stride_10", "stride_16", "mpeg7_6", "mpeg7_10", "mpeg7_16"],
        );
        let count_of = |name: &str| {
            let values = findings.iter().flatten().filter(|finding| finding.name == name).map(|finding| finding.value);
            values.fold((0_u32, 0.0), |(n, sum), value| (n + 1, sum + value))
        };
        let mut bars = Bars {
            name: "figure6".to_owned(),
            title: "Figure 6: exact reconstructions of outlines".to_owned(),
            unit: "%".to_owned(),
            full: 100.0,
            series: STRIDES.map(|stride| format!("every {stride}th")).to_vec(),
            groups: Vec::new(),
        };
        for algorithm in Algorithm::MAIN {
            let shares = STRIDES.map(|stride| {
                let (runs, right) = count_of(&format!("{}/{stride}", algorithm.name()));
                if runs == 0 { f64::NAN } else { 100.0 * right / f64::from(runs) }
            });
            let mut row = vec![Cell::text(algorithm.name())];
            row.extend(shares.map(Cell::number));
            let known = MPEG7.iter().find(|(known, _)| *known == algorithm);
            row.extend((0..3).map(|i| known.map_or(Cell::Empty, |(_, percent)| Cell::Count(u64::from(percent[i])))));
            table.rows.push(row);
            bars.groups.push((algorithm.name().to_owned(), shares.to_vec()));
        }
        let runs = STRIDES.map(|stride| count_of(&format!("{}/{stride}", Algorithm::Crust.name())).0.to_string());
        table.notes = vec![
            format!(
                "{} outlines, of which {} have at least {} points at strides 6, 10, 16.",
                self.outlines.len(),
                runs.join(", "),
                crate::silhouette::FEWEST
            ),
            "*mpeg7*: what an independent implementation found on some 60 silhouettes of MPEG-7 CE-Shape-1, part B, whose \
             licence does not allow to ship them; give such images with --masks to compare. The paper's own benchmark \
             orders the algorithms in the same way: connect2d and sigdt best, compatible-crust below them."
                .to_owned(),
            "accord is this project's own and not in the paper.".to_owned(),
        ];
        if self.shipped {
            table.notes.push(
                "Warning: no images were given with --masks and no drawings with --curve, so the closed paths of drawings \
                 that come with the program were used."
                    .to_owned(),
            );
        }
        Ok(Report { name: "figure6", tables: vec![table], plots: vec![], bars: vec![bars], pictures: vec![] })
    }
}
