//! Proved bounds of lfs in `f64` beside those in MPFR, and beside a judge that proves nothing.
//!
//! Both enclosures are the same branch and bound, in two arithmetics: they must meet at every point, for both hold lfs there.
//! The judge ([`Oracle`]) shares none of it and is never below lfs: no lower bound may be above what it finds.
//!
//! The door rounds where it changes a drawing, so C in `f64` and C in 128 bits are not quite the same curve. A point is asked
//! about where it is nearest to either, and bounds are taken wider by how far that is, since lfs is 1-Lipschitz; that M may move
//! by more is not allowed for, and was not needed.

use feature_sampling::curve::door::{CurveError, DoorOptions, sine_of_degrees};
use feature_sampling::curve::nearest;
use feature_sampling::geometry::Point;
use feature_sampling::lfs::bound::LfsBounds;
use feature_sampling::lfs::enclose::Precision;
use feature_sampling::medial::Resolution;
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::prover::Prover;
use feature_sampling::scalar::{Directed, Scalar};
use fsample_oracle::feature_size::{Oracle, Stroke};
use fsample_oracle::random::Random;

use crate::Mpfr;

/// The other arithmetic.
type Wide = Mpfr<128>;

/// Cells of the foot set, at most, in each arithmetic.
const CELLS: usize = 4_000_000;

/// Comparisons for one point, at most.
const STEPS: u32 = 100_000;

/// What was asked about a drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// Joints that turn by less are smooth, in degrees.
    pub corner_degrees: f64,
    /// Tolerance of the polylines where searches start.
    pub tolerance: f64,
    /// Width of the enclosures, as a share of the upper bound.
    pub share: f64,
    /// Number of random points.
    pub points: u32,
    /// Where random numbers start.
    pub seed: u64,
}

/// What was found at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// The point.
    pub at: Point<f64>,
    /// Bounds found in `f64`.
    pub plain: [f64; 2],
    /// Bounds found in 128 bits, rounded outwards.
    pub wide: [f64; 2],
    /// What the judge found, rounded up; infinite if it found nothing.
    pub judge: f64,
}

impl Compared {
    /// Both enclosures have a number in common, and neither lower bound is above the judge.
    pub fn agrees(&self) -> bool {
        let meet = self.plain[0] <= self.wide[1] && self.wide[0] <= self.plain[1];
        meet && self.plain[0] <= self.judge && self.wide[0] <= self.judge
    }
}

/// A value and the numbers on both sides of it in `f64`.
fn outward(value: &Wide) -> [f64; 2] {
    let value = value.to_f64();
    if value.is_finite() { [value.next_down(), value.next_up()] } else { [value; 2] }
}

/// Bounds at the point of C nearest to p, and wider by how far that is.
fn bounds<S: Directed>(
    prover: &mut Prover<'_, S>,
    curve: &CurveModel<S>,
    medial: &MedialModel<S>,
    p: &Point<f64>,
    share: f64,
) -> Option<[S; 2]> {
    let p = Point::from_f64(p.x, p.y);
    let near = nearest::nearest(&curve.curve(), &p, S::infinity())?;
    let on = curve.curve().point(&near.at)?;
    let off = on.distance(&p);
    let least = curve.diagonal().clone() * &S::from_f64(1e-7);
    let precision = Precision { share: S::from_f64(share), least, steps: STEPS };
    let LfsBounds { lower, upper } = prover.lfs(&on, &S::zero(), &medial.lfs(&on), &precision);
    Some([(lower - &off).max(S::zero()), upper + &off])
}

/// Compares at random points of a drawing.
///
/// # Errors
/// What the door has against the drawing.
pub fn compare(strokes: &[Stroke], question: &Question) -> Result<Vec<Compared>, CurveError> {
    let Question { corner_degrees, tolerance, share, points, seed } = *question;
    let oracle = Oracle::<Wide>::new(strokes, corner_degrees, tolerance)?;
    let paths: Vec<_> = strokes.iter().map(|(closed, cubics)| (*closed, &cubics[..])).collect();
    let corner_sine = sine_of_degrees(&corner_degrees);
    let plain = CurveModel::new(&paths, &DoorOptions { corner_sine, ..DoorOptions::default() })?;
    let plain_medial = MedialModel::new(&plain, &Resolution::Tolerance(tolerance));
    let (mut in_plain, mut in_wide) = (Prover::new(&plain, CELLS), Prover::new(oracle.curve(), CELLS));
    let mut random = Random::new(seed);
    let segments = i32::try_from(plain.curve().segments.len()).unwrap_or(i32::MAX);
    let mut rows = Vec::new();
    for _ in 0..points {
        let segment = usize::try_from(random.integer(0, segments - 1)).unwrap_or(0);
        let p = plain.curve().segments[segment].point(&random.unit());
        let narrow = bounds(&mut in_plain, &plain, &plain_medial, &p, share);
        let wide = bounds(&mut in_wide, oracle.curve(), oracle.medial(), &p, share);
        let (Some(plain), Some([lower, upper])) = (narrow, wide) else { continue };
        let judge = outward(&oracle.lfs(&Point::from_f64(p.x, p.y)).lfs)[1];
        rows.push(Compared { at: p, plain, wide: [outward(&lower)[0], outward(&upper)[1]], judge });
    }
    Ok(rows)
}
