//! Three ways of meshing at six densities: the numbers behind Table 4 and Figure 10. [`crate::meshing`] has the protocol.

use crate::meshing::{DENSITIES, Mode, Reference, Subject};
use crate::source::Source;
use crate::{ExperimentError, Finding, value};

/// The study of some curves.
#[derive(Clone, Debug)]
pub struct MeshStudy {
    /// The curves.
    pub curves: Vec<Source>,
    quick: bool,
}

/// What is measured of each mesh, by name: triangles, seconds for sampling, meshing and solving, error in percent, smallest
/// angle.
pub const MEASURES: [&str; 6] = ["triangles", "sampling", "meshing", "solving", "rmse", "min_angle"];

/// The name of a finding.
fn name(mode: Mode, density: f64, measure: &str) -> String {
    format!("{}/{density}/{measure}", mode.name())
}

impl MeshStudy {
    /// Of these curves; `quick` compares with a coarser reference, at the three largest densities.
    pub const fn new(curves: Vec<Source>, quick: bool) -> Self {
        Self { curves, quick }
    }

    /// The densities of the study.
    pub fn densities(&self) -> &'static [f64] {
        if self.quick { &DENSITIES[..3] } else { &DENSITIES }
    }

    /// What was asked, for shards.
    pub fn fingerprint(&self) -> String {
        let curves: Vec<String> = self.curves.iter().map(Source::fingerprint).collect();
        format!("{} quick={}", curves.join(" "), self.quick)
    }

    /// A unit for each curve.
    pub fn units(&self) -> u32 {
        u32::try_from(self.curves.len()).unwrap_or(u32::MAX)
    }

    /// Meshes a curve in all ways.
    ///
    /// # Errors
    /// Names the curve and the cause.
    pub fn run(&self, unit: u32) -> Result<Vec<Finding>, ExperimentError> {
        let Some(source) = self.curves.get(unit as usize) else { return Ok(Vec::new()) };
        let subject = Subject::new(source)?;
        let reference = Reference::new(&subject, self.quick)?;
        let mut findings = vec![Finding::new("medial", subject.seconds)];
        for mode in Mode::ALL {
            for &density in self.densities() {
                let meshed = subject.mesh(mode, density)?;
                let (solution, seconds) = subject.solve(&meshed, 5)?;
                let measured = [
                    meshed.mesh.triangles.len() as f64,
                    meshed.sampling,
                    meshed.meshing,
                    seconds,
                    reference.error(&meshed.mesh, &solution.values),
                    meshed.mesh.quality().min_angle,
                ];
                let named = MEASURES.iter().zip(measured);
                findings.extend(named.map(|(measure, found)| Finding::new(name(mode, density, measure), found)));
            }
        }
        Ok(findings)
    }

    /// What was measured of one mesh, in the order of [`MEASURES`].
    ///
    /// # Errors
    /// Something is missing.
    pub fn measured(&self, findings: &[Finding], mode: Mode, density: f64) -> Result<[f64; 6], ExperimentError> {
        let mut out = [0.0; 6];
        for (out, measure) in out.iter_mut().zip(MEASURES) {
            *out = value(findings, &name(mode, density, measure))?;
        }
        Ok(out)
    }
}

/// The parts of `Experiment` that Table 4 and Figure 10 have in common.
macro_rules! of_the_study {
    ($name:literal) => {
        fn name(&self) -> &'static str {
            $name
        }

        fn fingerprint(&self) -> String {
            self.study.fingerprint()
        }

        fn units(&self) -> u32 {
            self.study.units()
        }

        fn timed(&self) -> bool {
            true
        }

        fn run(&self, unit: u32) -> Result<Vec<Finding>, ExperimentError> {
            self.study.run(unit)
        }
    };
}
pub(crate) use of_the_study;
