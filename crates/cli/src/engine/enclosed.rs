//! Enclosures in terms of the drawing: lfs at points, the reach, the band around the medial axis.

use feature_sampling::curve::nearest;
use feature_sampling::geometry::Point;
use feature_sampling::lfs::enclose::Precision;
use feature_sampling::medial::cell::Capsule;
use feature_sampling::prover::Prover;
use lineart::export::{LfsRow, PathRows};

use super::Engine;

/// How far a band is drawn and how finely: capsules up to a tenth of their radius, or this share of the diagonal.
const FINEST: f64 = 2e-3;

/// Capsules of a picture, about, at most.
const CAPSULES: u32 = 200_000;

/// What was enclosed besides the rows.
#[derive(Debug)]
pub(crate) struct Enclosed {
    /// The reach, between two bounds.
    pub(crate) reach: [f64; 2],
    /// A foot where lfs is at most the upper one.
    pub(crate) at: Option<Point<f64>>,
    /// The band, if it was asked for.
    pub(crate) band: Option<Vec<Capsule<f64>>>,
    /// Cells that were made.
    pub(crate) cells: usize,
}

/// How exactly, and at what cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Width {
    /// Upper less lower bound, as a share of the upper one.
    pub(crate) share: f64,
    /// Most cells of the foot set.
    pub(crate) cells: u32,
}

/// Comparisons for one point, at most.
const STEPS: u32 = 100_000;

impl Engine<'_> {
    /// Adds bounds to all rows, and encloses the reach.
    pub(crate) fn enclose(&self, paths: &mut [PathRows<LfsRow>], width: Width, band: bool) -> Enclosed {
        let curve = self.curve.curve();
        let cells = usize::try_from(width.cells).unwrap_or(usize::MAX);
        let mut prover = Prover::new(&self.curve, cells);
        let diagonal = *self.curve.diagonal();
        // Where lfs is that small it is a floor's business (`docs/mathematics.md`, section 1).
        let precision = Precision { share: width.share, least: 1e-7 * diagonal, steps: STEPS };
        for row in paths.iter_mut().flat_map(|path| &mut path.rows) {
            let p = Point::new(row.x, row.y);
            // A point beside the curve: lfs of the nearest one on it, which differs by no more than their distance.
            let Some(near) = nearest::nearest(&curve, &p, f64::INFINITY) else { continue };
            let Some(on) = curve.point(&near.at) else { continue };
            let off = on.distance(&p);
            let off = if off <= 4.0 * curve.noise { 0.0 } else { off * (1.0 + 1e-15) };
            let found = prover.lfs(&on, &0.0, &self.medial.lfs(&on), &precision);
            row.bounds = Some([(found.lower - off).max(0.0), found.upper + off]);
        }
        let estimate = self.medial.points().iter().map(|m| m.radius).fold(f64::INFINITY, f64::min);
        let steps = u32::MAX;
        let reach = prover.reach(&estimate, &Precision { steps, ..precision.clone() });
        let at = reach.cell.and_then(|cell| prover.cells().get(cell as usize)).map(|cell| cell.centre);
        let fine = Precision { share: 0.1, least: FINEST * diagonal, steps: CAPSULES };
        let band = band.then(|| prover.capsules(&diagonal, &fine));
        Enclosed { reach: [reach.lower, reach.upper], at, band, cells: prover.cells().len() }
    }
}
