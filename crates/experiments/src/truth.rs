//! The ground truth of Table 1: tangent disks, lfs and gaps between samples of a curve.
//!
//! Radii are exact in the scalar at any density. lfs is minimised over feet ([`Oracle`]), from medial polylines that only say
//! where to look, so it has nearly all digits of the scalar; two densities of these polylines show whether any feature was
//! missed. Gaps come from the sampler on the finer polylines.

use feature_sampling::curve::CurveParam;
use feature_sampling::geometry::Point;
use feature_sampling::lfs::FeatureSize;
use feature_sampling::medial::{Foot, Resolution, Side, tangent_disk};
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::{self, SamplingOptions};
use feature_sampling::scalar::Scalar;
use fsample_oracle::feature_size::Oracle;

use crate::ExperimentError;
use crate::source::Source;

/// The scalar of the ground truth.
#[cfg(feature = "mpfr")]
pub(crate) type Truest = feature_sampling_mpfr::Mpfr<128>;
/// The scalar of the ground truth.
#[cfg(not(feature = "mpfr"))]
pub(crate) type Truest = f64;

/// The scalar of the ground truth, as tables name it.
pub(crate) const TRUEST: &str =
    if cfg!(feature = "mpfr") { "MPFR with 128 bits" } else { "f64 (built without the feature mpfr)" };

/// Joints that turn by less are smooth, in degrees: the program's default.
pub(crate) const CORNER_DEGREES: f64 = 1.0;

/// One place in so many is looked at with the coarser polylines as well.
pub(crate) const CHECKED: usize = 4;

/// What is true of a curve, rounded to doubles.
#[derive(Clone, Debug)]
pub(crate) struct Truth {
    /// Points of the curve at the places.
    pub(crate) points: Vec<Point<f64>>,
    /// Medial points of the nearer side there, with radii up to the diagonal.
    pub(crate) medial: Vec<Point<f64>>,
    pub(crate) lfs: Vec<f64>,
    pub(crate) gaps: Vec<Vec<f64>>,
    /// The largest difference of lfs at the two densities, over the hull diagonal.
    pub(crate) lfs_differs: f64,
    /// Root mean square difference of gaps at the two densities, over the hull diagonal.
    pub(crate) gaps_differ: f64,
}

impl Truth {
    /// At so many places a segment; `tolerances` are those of the polylines, the finer first.
    pub(crate) fn new(source: &Source, places: u32, tolerances: [f64; 2]) -> Result<Self, ExperimentError> {
        let [fine, coarse] = tolerances;
        let oracle = |tolerance: f64| {
            Oracle::<Truest>::new(&source.paths, CORNER_DEGREES, tolerance)
                .map_err(|error| ExperimentError::new(format!("{}: {error}", source.name)))
        };
        let (fine, coarse) = (oracle(fine)?, oracle(coarse)?);
        let places = equidistant(fine.curve(), places);
        let Disks { points, centres: medial, .. } = disks(fine.curve(), &places);
        let true_lfs = |oracle: &Oracle<Truest>, p: &Point<f64>| oracle.lfs(&Point::from_f64(p.x, p.y)).lfs;
        let (mut lfs, mut lfs_differs) = (Vec::new(), 0.0_f64);
        for (i, p) in points.iter().enumerate() {
            let value = true_lfs(&fine, p);
            if i % CHECKED == 0 {
                let difference = apart(true_lfs(&coarse, p), &value);
                // Both are infinite where there is no medial axis.
                lfs_differs = if difference.is_nan() { lfs_differs } else { lfs_differs.max(difference) };
            }
            lfs.push(value.to_f64());
        }
        let gaps_of = |oracle: &Oracle<Truest>| gaps(source, oracle.curve(), &oracle.medial().index());
        let (gaps, other) = (gaps_of(&fine)?, gaps_of(&coarse)?);
        let unit = source.hull_diagonal();
        let gaps_differ = rms(gaps.iter().zip(&other).flat_map(|(a, b)| differences(a, b))) / unit;
        Ok(Self { points, medial, lfs, gaps, lfs_differs: lfs_differs / unit, gaps_differ })
    }
}

/// What one sampler makes of a curve.
pub(crate) struct Job<S> {
    pub(crate) curve: CurveModel<S>,
    pub(crate) medial: MedialModel<S>,
}

impl<S: Scalar> Job<S> {
    pub(crate) fn new(source: &Source, resolution: &Resolution<S>) -> Result<Self, ExperimentError> {
        let curve = source.model::<S>(CORNER_DEGREES)?;
        let medial = MedialModel::new(&curve, resolution);
        Ok(Self { curve, medial })
    }

    pub(crate) fn gaps(&self, source: &Source) -> Result<Vec<Vec<f64>>, ExperimentError> {
        gaps(source, &self.curve, &self.medial.index())
    }

    /// Distance of a point of the plane from the medial polylines: lfs, for a point of C.
    pub(crate) fn distance(&self, p: &Point<f64>) -> f64 {
        self.medial.lfs(&Point::from_f64(p.x, p.y)).to_f64()
    }
}

/// Distances of consecutive samples, path by path.
pub(crate) fn gaps<S: Scalar>(
    source: &Source,
    model: &CurveModel<S>,
    features: &impl FeatureSize<S>,
) -> Result<Vec<Vec<f64>>, ExperimentError> {
    let curve = model.curve();
    let mut all = Vec::new();
    for (path, _) in (0_u32..).zip(curve.paths) {
        let (mut samples, mut scratch) = (Vec::new(), Vec::new());
        let options = SamplingOptions::default();
        sampling::sample_path(&curve, features, model.contacts(), path, &options, &mut samples, &mut scratch)
            .map_err(|error| ExperimentError::new(format!("{}: path {path}: {error}", source.name)))?;
        all.push(samples.windows(2).map(|pair| pair[0].point.distance(&pair[1].point).to_f64()).collect());
    }
    Ok(all)
}

/// The parameters of the places of one segment.
pub(crate) fn parameters(count: u32) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| (f64::from(i) + 0.5) / f64::from(count))
}

/// So many places a segment, by segment and parameter.
pub(crate) fn equidistant<S: Scalar>(model: &CurveModel<S>, count: u32) -> Vec<(u32, f64)> {
    let segments = (0_u32..).zip(model.curve().segments);
    segments.flat_map(|(segment, _)| parameters(count).map(move |t| (segment, t))).collect()
}

/// The tangent disks at places.
pub(crate) struct Disks {
    /// The places on the curve.
    pub(crate) points: Vec<Point<f64>>,
    /// Radii to the left and to the right.
    pub(crate) radii: Vec<[f64; 2]>,
    /// Centres of the nearer side, with radii up to the diagonal.
    pub(crate) centres: Vec<Point<f64>>,
}

/// The tangent disks at these places.
pub(crate) fn disks<S: Scalar>(model: &CurveModel<S>, places: &[(u32, f64)]) -> Disks {
    let curve = model.curve();
    let (mut points, mut all, mut centres) = (Vec::new(), Vec::new(), Vec::new());
    let lower = |p: &Point<S>| Point::new(p.x.to_f64(), p.y.to_f64());
    for (segment, t) in places {
        let at = CurveParam { segment: *segment, t: S::from_f64(*t) };
        let mut radii = [S::infinity(), S::infinity()];
        let mut centre = None;
        for (i, side) in [Side::Left, Side::Right].into_iter().enumerate() {
            let Some(foot) = Foot::normal(&curve, at.clone(), side) else { continue };
            radii[i] = tangent_disk(&curve, &foot).radius;
            if radii[i] <= *curve.diagonal && (i == 0 || radii[1] < radii[0]) {
                centre = Some(lower(&foot.point.plus_scaled(&radii[i], &foot.direction)));
            }
        }
        points.extend(curve.point(&at).as_ref().map(lower));
        all.push(radii.map(|r| r.to_f64()));
        centres.extend(centre);
    }
    Disks { points, radii: all, centres }
}

/// |a − b|.
fn apart<S: Scalar>(a: S, b: &S) -> f64 {
    (a - b).abs().to_f64()
}

/// Root mean square.
pub(crate) fn rms(values: impl IntoIterator<Item = f64>) -> f64 {
    let (sum, count) = values.into_iter().fold((0.0, 0_u32), |(sum, n), v| (sum + v * v, n + 1));
    (sum / f64::from(count.max(1))).sqrt()
}

/// Differences where both are finite (a curve without a medial axis has an infinite lfs in every row).
pub(crate) fn differences<'v>(a: &'v [f64], b: &'v [f64]) -> impl Iterator<Item = f64> + 'v {
    a.iter().zip(b).map(|(a, b)| a - b).filter(|d| d.is_finite())
}
