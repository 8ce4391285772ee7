//! The entries, by name.
//!
//! Where analysis gives a bound for a few operations in a row, it is that (half an ulp for each rounding); for whole
//! algorithms it is a power of two above what was observed, so that a loss of two bits is noticed. What was measured stands
//! in `docs/accuracy.md`.

use super::{Entry, Kind, Measured, arithmetic as a, curves as c};

/// Many cheap cases, or few dear ones.
const MANY: u32 = 3000;
const SOME: u32 = 400;
const FEW: u32 = 24;

/// A rounded function: its generic case, the size of an ulp, ulps in `f32` and `f64`, number of cases.
macro_rules! measured {
    ($function:literal, $module:ident :: $case:ident, $size:literal, [$single:literal, $double:literal], $cases:expr) => {
        Entry {
            function: $function,
            kind: Kind::Measured(Measured {
                size: $size,
                allowed: [$single, $double],
                cases: $cases,
                run: [$module::$case::<f32>, $module::$case::<f64>],
            }),
        }
    };
}

const fn exact(function: &'static str, why: &'static str) -> Entry {
    Entry { function, kind: Kind::Exact(why) }
}

const fn through(function: &'static str, other: &'static str) -> Entry {
    Entry { function, kind: Kind::Through(other) }
}

/// One entry for each public function of the kernel, by name.
pub const TABLE: &[Entry] = &[
    measured!("bezier::critical::inflections", a::inflections, "1, for tame cubics", [2.0, 2.0], SOME),
    measured!("bezier::critical::slowest", a::slowest, "1, for tame cubics", [32.0, 16.0], SOME),
    measured!("bezier::critical::vertices", a::vertices, "1, for tame cubics", [32.0, 16.0], SOME),
    exact("bezier::cubic::Cubic::control_box", "comparisons"),
    exact("bezier::cubic::Cubic::end", "a copy"),
    measured!("bezier::cubic::Cubic::eval", a::cubic_eval, "the largest coordinate", [4.0, 4.0], MANY),
    exact("bezier::cubic::Cubic::is_finite", "comparisons"),
    through("bezier::cubic::Cubic::line", "bezier::cubic::Cubic::quadratic"),
    through("bezier::cubic::Cubic::move_end", "geometry::point::Point::plus"),
    exact("bezier::cubic::Cubic::new", "a copy"),
    measured!("bezier::cubic::Cubic::power_basis", a::cubic_powers, "the largest coordinate", [16.0, 16.0], MANY),
    measured!("bezier::cubic::Cubic::quadratic", a::cubic_raised, "the largest coordinate", [2.0, 2.0], MANY),
    exact("bezier::cubic::Cubic::reversed", "an exchange"),
    measured!("bezier::cubic::Cubic::split_at", a::cubic_split, "the largest coordinate", [4.0, 4.0], MANY),
    exact("bezier::cubic::Cubic::start", "a copy"),
    measured!(
        "bezier::cubic::PowerBasis::derivative",
        a::power_derivatives,
        "the largest coordinate",
        [64.0, 64.0],
        MANY
    ),
    measured!("bezier::cubic::PowerBasis::eval", a::power_eval, "the largest coordinate", [16.0, 16.0], MANY),
    through("bezier::cubic::PowerBasis::second_derivative", "bezier::cubic::PowerBasis::derivative"),
    measured!("bezier::cubic::PowerBasis::taylor", a::power_taylor, "the largest coordinate", [32.0, 32.0], MANY),
    measured!(
        "bezier::hull::hull_distance_sq",
        a::hull_distance,
        "the largest coordinate, for the root of the result",
        [2048.0, 8192.0],
        MANY
    ),
    measured!(
        "bezier::hull::hull_keeps_away",
        a::hull_keeps_away,
        "the largest coordinate, where the answer is wrong",
        [0.5, 0.5],
        SOME
    ),
    measured!(
        "bezier::nearest::critical_points",
        a::critical_points,
        "the largest coordinate, for the least distance",
        [16.0, 8.0],
        SOME
    ),
    measured!(
        "bezier::nearest::distance_quintic",
        a::quintic,
        "the square of the largest coordinate",
        [2048.0, 2048.0],
        MANY
    ),
    measured!(
        "bezier::nearest::nearest",
        a::nearest_distance,
        "the largest coordinate, for the distance",
        [16.0, 16.0],
        SOME
    ),
    measured!(
        "bezier::nearest::nearest_between",
        a::nearest_between,
        "the largest coordinate, for the distance",
        [8.0, 8.0],
        SOME
    ),
    through("bezier::nearest::nearest_of", "bezier::nearest::nearest"),
    exact("buffer::SliceStore::into_items", "a copy"),
    exact("buffer::SliceStore::new", "a copy"),
    exact("buffer::Store::items", "a copy"),
    exact("buffer::Store::items_mut", "a copy"),
    exact("buffer::Store::push", "a copy"),
    exact("buffer::Store::shorten", "integers"),
    exact("curve::Curve::arcs_of", "a look-up"),
    exact("curve::Curve::end", "a look-up"),
    exact("curve::Curve::end_point", "a look-up"),
    exact("curve::Curve::hierarchy", "a copy"),
    exact("curve::Curve::joint", "a look-up"),
    measured!("curve::Curve::point", c::segment_point, "the diagonal", [0.5, 1.0], FEW),
    exact("curve::Curve::segment", "a look-up"),
    exact("curve::Segment::end", "a look-up"),
    exact("curve::Segment::end_point", "a look-up"),
    through("curve::Segment::point", "curve::Curve::point"),
    measured!("curve::Segment::tangent", c::segment_tangent, "1", [8.0, 2.0], FEW),
    measured!("curve::Source::parameter", c::source_parameter, "1", [0.5, 0.5], FEW),
    measured!("curve::arc::Arc::bounds", c::arc_bounds, "the diagonal, for what sticks out", [0.5, 0.5], FEW),
    through("curve::arc::Arc::moving", "curve::arc::Arc::bounds"),
    measured!("curve::arc::Arc::turning", c::arc_turning, "1", [8.0, 4.0], FEW),
    through("curve::contact::Contact::middle", "scalar::Scalar::midpoint"),
    through("curve::contact::find", "curve::contact::reach"),
    through("curve::contact::place", "scalar::Scalar::midpoint"),
    measured!("curve::contact::reach", c::contact_reach, "the result", [2.0, 2.0], FEW),
    exact("curve::door::CurveBuffers::curve", "a copy"),
    measured!("curve::door::enter", c::diagonal, "the diagonal", [2.0, 1.0], FEW),
    measured!("curve::door::sine_of_degrees", c::sine_of_degrees, "the result", [2.0, 2.0], SOME),
    exact("curve::joint::EndId::new", "integers"),
    exact("curve::joint::EndId::opposite", "integers"),
    exact("curve::joint::EndId::segment", "integers"),
    exact("curve::joint::EndId::side", "integers"),
    exact("curve::nearest::Locality::holds", "a comparison of turning, which is a matter of convention"),
    through("curve::nearest::Locality::of", "curve::arc::Arc::turning"),
    through("curve::nearest::Locality::on_arc", "curve::arc::Arc::turning"),
    measured!("curve::nearest::nearest", c::nearest, "the diagonal, for the distance", [0.5, 1.0], FEW),
    through("curve::nearest::nearest_beside", "curve::nearest::nearest"),
    through("curve::nearest::nearest_non_local", "curve::nearest::nearest"),
    through("curve::nearest::nearest_on_arc", "curve::nearest::nearest"),
    exact("geometry::aabb::Aabb::around", "comparisons"),
    measured!("geometry::aabb::Aabb::centre", a::box_centre, "the result", [0.5, 0.5], MANY),
    measured!("geometry::aabb::Aabb::distance_sq", a::box_distance_sq, "the result", [4.0, 4.0], MANY),
    exact("geometry::aabb::Aabb::empty", "no computation"),
    measured!("geometry::aabb::Aabb::extent", a::box_extent, "the result", [0.5, 0.5], MANY),
    exact("geometry::aabb::Aabb::include", "comparisons"),
    exact("geometry::aabb::Aabb::merge", "comparisons"),
    exact("geometry::hierarchy::Hierarchy::bounds", "a copy"),
    through("geometry::hierarchy::Hierarchy::nearest_first", "geometry::aabb::Aabb::distance_sq"),
    exact("geometry::hierarchy::Hierarchy::new", "a copy"),
    exact("geometry::hierarchy::Hierarchy::traverse", "decides nothing itself"),
    exact("geometry::hierarchy::build", "comparisons; the order of sums of box ends changes the tree, not its boxes"),
    exact("geometry::hierarchy::nodes_for", "integers"),
    measured!("geometry::point::Point::distance", a::point_distance, "the result", [2.0, 2.0], MANY),
    measured!("geometry::point::Point::distance_sq", a::point_distance_sq, "the result", [4.0, 4.0], MANY),
    through("geometry::point::Point::from_f64", "scalar::Scalar::from_f64"),
    exact("geometry::point::Point::is_finite", "a comparison"),
    measured!("geometry::point::Point::middle", a::point_middle, "the result", [0.5, 0.5], MANY),
    measured!("geometry::point::Point::minus", a::point_minus, "the result", [0.5, 0.5], MANY),
    exact("geometry::point::Point::new", "a copy"),
    measured!("geometry::point::Point::plus", a::point_plus, "the result", [0.5, 0.5], MANY),
    measured!(
        "geometry::point::Point::plus_scaled",
        a::point_plus_scaled,
        "the sum of the moduli of the terms",
        [2.0, 2.0],
        MANY
    ),
    measured!(
        "geometry::segment::distance_sq_to_segment",
        a::segment_distance_sq,
        "the largest coordinate, for the root of the result",
        [4.0, 4.0],
        MANY
    ),
    measured!("geometry::segment::project_to_segment", a::projection, "the largest coordinate", [4.0, 4.0], MANY),
    measured!(
        "geometry::vector::Vector::cross",
        a::vector_cross,
        "the sum of the moduli of the terms",
        [2.0, 2.0],
        MANY
    ),
    measured!("geometry::vector::Vector::dot", a::vector_dot, "the sum of the moduli of the terms", [2.0, 2.0], MANY),
    exact("geometry::vector::Vector::is_finite", "a comparison"),
    exact("geometry::vector::Vector::left", "a sign and an exchange"),
    through("geometry::vector::Vector::minus", "geometry::vector::Vector::plus"),
    exact("geometry::vector::Vector::new", "a copy"),
    measured!("geometry::vector::Vector::norm", a::vector_norm, "the result", [2.0, 2.0], MANY),
    measured!("geometry::vector::Vector::norm_sq", a::vector_norm_sq, "the result", [2.0, 2.0], MANY),
    exact("geometry::vector::Vector::opposite", "signs"),
    measured!("geometry::vector::Vector::plus", a::vector_plus, "the result", [0.5, 0.5], MANY),
    measured!(
        "geometry::vector::Vector::plus_scaled",
        a::vector_plus_scaled,
        "the sum of the moduli of the terms",
        [2.0, 2.0],
        MANY
    ),
    measured!("geometry::vector::Vector::scaled", a::vector_scaled, "the result", [0.5, 0.5], MANY),
    measured!("geometry::vector::Vector::unit", a::vector_unit, "1", [2.0, 2.0], MANY),
    exact("geometry::vector::Vector::zero", "no computation"),
    through("lfs::FeatureSize::lfs", "lfs::LfsIndex::distance"),
    through("lfs::FeatureSize::lfs_below", "lfs::LfsIndex::distance"),
    measured!("lfs::LfsIndex::distance", c::index_distance, "the diagonal and the distance", [0.5, 0.5], FEW),
    through("lfs::LfsIndex::nearest", "lfs::LfsIndex::distance"),
    exact("lfs::LfsIndex::new", "a copy"),
    exact("lfs::LfsIndex::points", "a copy"),
    exact("lfs::build", "comparisons"),
    exact("lfs::items_for", "integers"),
    through("lfs::kd::KdIndex::lfs", "lfs::LfsIndex::distance"),
    exact("lfs::kd::KdIndex::new", "copies"),
    exact("medial::disk::Guard::new", "no computation"),
    measured!("medial::disk::tangent_disk", c::disks, "the radius, up to the diagonal", [32.0, 32.0], FEW),
    measured!(
        "medial::disk::tangent_disk_beside",
        c::disks_beside,
        "the radius, up to the diagonal",
        [64.0, 32.0],
        FEW
    ),
    exact("medial::foot::Foot::fan", "a copy"),
    measured!(
        "medial::foot::Foot::normal",
        c::foot,
        "1 for the direction, the diagonal for the speed",
        [8.0, 2.0],
        FEW
    ),
    measured!("medial::walk::relevance", c::relevance_bound, "the result", [2.0, 2.0], FEW),
    measured!("medial::walk::walk", c::lfs, "the diagonal, for lfs from its polylines", [8.0, 4.0], FEW),
    exact("model::CurveModel::contacts", "a copy"),
    exact("model::CurveModel::curve", "a copy"),
    exact("model::CurveModel::diagonal", "a copy"),
    through("model::CurveModel::new", "curve::door::enter"),
    exact("model::CurveModel::report", "a copy"),
    through("model::CurveModel::sample", "sampling::sampler::sample_path"),
    through("model::CurveModel::sample_path", "sampling::sampler::sample_path"),
    through("model::CurveModel::source", "curve::Source::parameter"),
    through("model::CurveModel::walk", "medial::walk::walk"),
    exact("model::MedialModel::from_paths", "copies"),
    exact("model::MedialModel::index", "a copy"),
    through("model::MedialModel::lfs", "lfs::LfsIndex::distance"),
    through("model::MedialModel::new", "medial::walk::walk"),
    exact("model::MedialModel::points", "a copy"),
    measured!("polynomial::bound::Polynomial::cauchy_bound", a::cauchy, "the result, never below it", [8.0, 8.0], MANY),
    measured!("polynomial::bound::Polynomial::kojima_bound", a::kojima, "the result, never below it", [8.0, 8.0], MANY),
    through("polynomial::bound::Polynomial::root_bound", "polynomial::bound::Polynomial::kojima_bound"),
    exact("polynomial::eval::Polynomial::degree", "comparisons"),
    measured!("polynomial::eval::Polynomial::eval", a::polynomial_eval, "Σ|aⱼxʲ|", [2.0, 2.0], MANY),
    measured!(
        "polynomial::eval::Polynomial::eval_with_derivative",
        a::polynomial_slope,
        "Σ|aⱼxʲ|, Σ|jaⱼxʲ⁻¹|",
        [2.0, 4.0],
        MANY
    ),
    measured!("polynomial::eval::Polynomial::magnitude", a::polynomial_magnitude, "the result", [2.0, 4.0], MANY),
    exact("polynomial::eval::Polynomial::mirrored", "signs"),
    exact("polynomial::eval::Polynomial::new", "a copy"),
    exact("polynomial::eval::Polynomial::reversed", "an exchange"),
    measured!(
        "polynomial::eval::Polynomial::taylor",
        a::polynomial_taylor,
        "the same of the moduli of the coefficients",
        [4.0, 4.0],
        MANY
    ),
    measured!(
        "polynomial::roots::Polynomial::real_roots",
        a::real_roots,
        "Σ|aⱼxʲ|, for p at simple roots",
        [2.0, 2.0],
        SOME
    ),
    measured!(
        "polynomial::roots::Polynomial::roots_between",
        a::roots_between,
        "Σ|aⱼxʲ|, for p at simple roots",
        [2.0, 2.0],
        SOME
    ),
    measured!(
        "polynomial::roots::Polynomial::roots_in_unit",
        a::roots_in_unit,
        "Σ|aⱼxʲ|, for p at simple roots",
        [2.0, 2.0],
        SOME
    ),
    exact("polynomial::roots::RootKind::multiplicity", "integers"),
    exact(
        "predicate::Predicates::incircle",
        "exact in the domain of check_domain (Exact); Plain is the sign of a rounded determinant",
    ),
    exact(
        "predicate::Predicates::orient2d",
        "exact in the domain of check_domain (Exact); Plain is the sign of a rounded determinant",
    ),
    exact("predicate::Sign::of", "a comparison"),
    exact("predicate::Sign::opposite", "no computation"),
    exact("predicate::domain::check_domain", "comparisons"),
    exact("sampling::SamplingOptions::check", "comparisons"),
    measured!("sampling::chord::chord_error", c::chord_error, "the diagonal", [2.0, 2.0], FEW),
    measured!(
        "sampling::chord::piece_error_sq",
        c::piece_error,
        "the largest coordinate, for the root of the result",
        [2.0, 4.0],
        SOME
    ),
    measured!("sampling::grading::measure", c::grading_measure, "the result", [2.0, 2.0], SOME),
    measured!("sampling::grading::slope", c::grading_slope, "1", [1.0, 1.0], SOME),
    through("sampling::grading::smooth", "sampling::grading::value"),
    measured!("sampling::grading::value", c::grading_value, "the result", [4.0, 2.0], SOME),
    through("sampling::rho::next", "sampling::sampler::sample_path"),
    exact("sampling::run::Pos::max_of", "a comparison"),
    exact("sampling::run::Pos::min_of", "a comparison"),
    measured!("sampling::run::Run::advance", c::run_advance, "1, for the parameter", [0.5, 0.5], FEW),
    measured!("sampling::run::Run::between", c::run_between, "1, for the parameter", [0.5, 1.0], FEW),
    through("sampling::run::Run::forward", "sampling::run::Run::between"),
    exact("sampling::run::Run::place", "a copy"),
    through("sampling::run::Run::point", "curve::Curve::point"),
    exact("sampling::run::Run::segment", "a look-up"),
    exact("sampling::run::Run::segment_index", "integers"),
    through("sampling::run::Run::tangent", "curve::Segment::tangent"),
    exact("sampling::run::Run::window", "a copy"),
    measured!(
        "sampling::sampler::sample_path",
        c::samples,
        "the diagonal, for the points, at the same lfs up to rounding",
        [16.0, 16.0],
        FEW
    ),
    through("sampling::size::Sizes::at", "lfs::LfsIndex::distance"),
    exact("sampling::size::Sizes::factor", "a copy"),
    through("sampling::size::Sizes::floored", "lfs::LfsIndex::distance"),
    through("sampling::size::Sizes::lfs", "lfs::LfsIndex::distance"),
    through("sampling::size::Sizes::new", "lfs::LfsIndex::distance"),
    through("sampling::spread::inner_samples", "sampling::sampler::sample_path"),
    through("sampling::step::next", "sampling::sampler::sample_path"),
    exact("scalar::Field::abs", "a sign"),
    exact("scalar::Field::half", "a power of two"),
    exact("scalar::Field::int", "small integers are numbers of every scalar"),
    exact("scalar::Field::mul_pow2", "a power of two, within the normal range"),
    measured!("scalar::Field::sqrt", a::sqrt, "the result", [0.5, 0.5], MANY),
    measured!("scalar::Field::square", a::square, "the result", [0.5, 0.5], MANY),
    exact("scalar::Field::twice", "a power of two"),
    exact("scalar::Scalar::clamp", "comparisons"),
    measured!("scalar::Scalar::from_f64", a::from_f64, "the result", [0.5, 0.0], MANY),
    exact("scalar::Scalar::infinity", "no computation"),
    exact("scalar::Scalar::is_finite", "a comparison"),
    exact("scalar::Scalar::max", "a comparison"),
    measured!("scalar::Scalar::midpoint", a::midpoint, "the result", [0.5, 0.5], MANY),
    exact("scalar::Scalar::min", "a comparison"),
    measured!("scalar::Scalar::ratio", a::ratio, "the result", [0.5, 0.5], MANY),
    exact("scalar::Scalar::to_f64", "f32 and f64 are doubles"),
    exact("scalar::Scalar::unit_roundoff", "a power of two"),
];
