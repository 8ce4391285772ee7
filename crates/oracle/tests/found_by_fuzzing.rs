//! What fuzzing and the surveys have found, each by its name.

use feature_sampling::bezier::Cubic;
use feature_sampling::bezier::nearest::nearest;
use feature_sampling::geometry::Point;
use fsample_oracle::closest::Closest;
use fsample_oracle::property::{check_closest, check_roots, document};
use fsample_oracle::solve::{Ask, solve};

/// The reversed polynomial was given up as noise on the lower quarter of a piece: a cluster of three where p is 1e15 times
/// its rounding error.
#[test]
fn large_positive_roots_cast_no_shadow_on_the_negative_side() {
    let p = [
        -4.679729755136345e93,
        3.797164789115978e75,
        -1.0825742859398463e57,
        1.3139344419369277e38,
        -7.065350496848394e18,
        0.13840307910588834,
    ];
    let found = solve(&p, Ask::Real).expect("finite");
    assert_eq!(found.len(), 5, "{found:?}");
    assert!(found.iter().all(|root| root.value > 0.0), "{found:?}");
    check_roots(&[0.0, 0.0, 1.1909882842232846e39, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], 2.3283064365386963e-10, 230.0);
}

/// Seen from the left the root is at 1 − 1.5e-14, from the right it is cut at 1: the mean of both was taken.
#[test]
fn a_root_just_below_1_found_from_both_sides() {
    let p =
        [0.019341239008092294, -0.09648902649701292, 0.1925443077357085, -0.11539652024678773, -1.0130785099704553e-15];
    check_roots(&p, -1.0, 2.0);
}

/// A near miss of a double root at 1 was called a simple root.
#[test]
fn a_double_root_at_an_end_is_not_simple() {
    let p = [
        1.9502201306534328e-18,
        2162097509668.7373,
        -6486292515056.276,
        7206991668036.129,
        -3603495826431.6606,
        720699163783.071,
    ];
    check_roots(&p, 0.0, 1.5);
}

/// Half of a triple root at 1 from the left, half from the right: a cluster of two, with one root in it.
#[test]
fn a_triple_root_at_1_found_from_both_sides_keeps_its_parity() {
    let p = [
        6.155857742094904e17,
        -2.0519525804593882e18,
        2.4623430963600937e18,
        -1.231171548132202e18,
        2.051952580219991e17,
        6911.8945312493015,
    ];
    check_roots(&p, 0.5, 1.5);
}

/// Noise in proportion to the whole line was believed on a short stretch: a cluster of six beside two simple roots.
#[test]
fn a_simple_root_beside_a_quadruple_one_makes_no_cluster_of_six() {
    let p = [
        -9.238210196815106e-10,
        2.942330183938517e-7,
        -3.7424339097895935e-5,
        0.0023723291233169936,
        -0.07457366585729666,
        0.9061298370361528,
        1.0,
    ];
    let found = solve(&p, Ask::Real).expect("finite");
    assert!(found.iter().all(|root| root.kind.multiplicity() <= 4), "{found:?}");
    check_roots(&p, 0.0, 0.5);
}

/// Steps about the last place sent the search away to where one long step ended it, with that step's rounding error.
#[test]
fn a_huge_root_is_right_to_the_last_place() {
    check_roots(
        &[1.0, 128.0, -56.0, 0.0, -16384.0, -6.58276836460481e-37, -238.0, 0.0, 123145302310912.0, 6.0],
        0.0,
        1.0,
    );
}

/// Signs of coefficients that were nothing but noise were believed: 4e-10 too far on a stroke of length 30.
#[test]
fn a_query_beside_the_end_of_a_retracted_handle() {
    let x = 2.3283064365386963e-10;
    let (a, b) = (Point::new(x, -24.028473675842545), Point::new(x, 6.574660815772404e-10));
    let basis = Cubic::new(a, a, b, b).power_basis();
    let q = Point::new(x, x);
    let found = nearest(&basis, &q);
    let exact = Closest::new(&basis, &q).expect("finite");
    assert!(exact.excess_absolute(found.t) < 1e-14, "{found:?}: {}", exact.excess_absolute(found.t));
}

/// A selector with a line break made a warning of two lines.
#[test]
fn a_line_break_in_a_style_sheet_stays_out_of_the_warning() {
    document(b"!<style>a>\nb[c]{stroke:red}</style><path d='M0 0L1 1'/>");
}

/// No fault of the closest point: seen from 9e11 away all points of the curve are equally far in doubles. The property asked
/// for a stationary parameter all the same.
#[test]
fn a_query_so_far_away_that_all_points_are_level() {
    let cubic = Cubic::new(
        Point::new(-2.337401384030771e-10, -3.373_536_630_144_119),
        Point::new(9.912055258689082e-8, 31655.472100153704),
        Point::new(-0.0016316728112786454, -0.0006994095543232808),
        Point::new(2.3283064365386963e-10, 2.3283064365386963e-10),
    );
    check_closest(&cubic, &Point::new(-921400391520.5728, -0.4819350648426135), 0.0, 1.0);
}

/// The square of the slope at the reciprocal underflows: plain steps towards a bracket of 1e-12 lost four digits.
#[test]
fn a_root_of_1e105_in_a_wide_bracket() {
    let c = [-1.438043545891893e-58, -3.556851672255464e98, -2.273788596691974e-143, 2.418429580981082e-112];
    check_roots(&c, -1.0, 1.0);
}

/// A pair of roots 2e-6 apart, seen from afar: a bracket a thousandth wide was put where steps shrank by a third each.
#[test]
fn a_wide_bracket_waits_until_steps_shrink_fast() {
    let p = [-0.7318910211294397, 5.069375038138915, -12.869110107416773, 14.33789062499909, -6.546875, 1.0];
    check_roots(&p, 0.0, 1.0);
}

/// The closest point was right and the judge wrong: the quintic with rounded coefficients has no root there.
#[test]
fn a_stationary_point_that_the_rounded_quintic_does_not_know() {
    let p = Point::new;
    let cubic = Cubic::new(
        p(2.464581871919335e-10, -1324351731.56073),
        p(2.328308413171061e-10, 2.3295498863262775e-10),
        p(-3584.177734375, 2.328306436538824e-10),
        p(-3584.177734375, 2.328306436538824e-10),
    );
    check_closest(&cubic, &p(2.3283064365386963e-10, 2.3283064365386963e-10), 0.0, 1.0);
}

/// Value times slope is 1e-312 near the root, with few digits left: the last step was taken for a small one.
#[test]
fn a_step_whose_products_lose_their_digits_is_not_the_last() {
    let c = [6.397087345733778e-308, 1.130692526381147e-309, 8.889744242069257e-280, 3.109891882916974e-120];
    check_roots(&c, -1.0, 1.0);
}

/// A certified bracket that ended at 0, where a root had been divided out: "exactly one" was said of two.
#[test]
fn a_certified_bracket_that_ends_at_a_root_at_0() {
    let c = [0.0, 4.50514e-319, 6.21314252043346e-66, 6.359745635991445e-116, 6.359744766225762e-116];
    check_roots(&c, -1.0, 1.0);
    let (small, large) = ([2.0732734e-317, 1.935613e-317], [-1.7456713911491722e-149, -2.5637160115410706e-69]);
    check_roots(&[0.0, 0.0, 0.0, small[0], small[1], large[0], large[1], 0.0], -1.0, 1.0);
    check_roots(&[0.0, 0.0, 0.0, small[0], small[1], large[0], large[1], 0.0], 0.0, 1.0);
}

/// The end at t = 1 is 4e-6 farther than the closest point, where Horner's scheme is off by 1e-5: right, and the judge allowed for
/// roundings of control points only.
#[test]
fn an_end_that_the_noise_of_powers_hides_a_closer_point_from() {
    let p = Point::new;
    let far = -466340811.7960784;
    let cubic = Cubic::new(
        p(6.302296242211337e-6, -466338415.43359375),
        p(far, far),
        p(-466340811.91717213, -466340811.67498463),
        p(-466340811.7929828, far),
    );
    check_closest(&cubic, &p(far, far), 0.0, 1.0);
}

/// A parameter of 3e-17 that is off by 8e-20, where the curve runs 1e9 of those a unit: right, while the judge allowed for Horner's
/// scheme alone.
#[test]
fn a_foot_beside_the_start_of_a_long_cubic() {
    let p = Point::new;
    let unit = 2.3283064365386963e-10;
    let cubic = Cubic::new(
        p(-4.2726234639313225e-7, -2.3800348106258453e-10),
        p(4117061640.052284, 2.328306436572577e-10),
        p(unit, unit),
        p(unit, unit),
    );
    check_closest(&cubic, &p(unit, unit), 0.0, 1.0);
}

/// Six roots about 1.36, four of them complex, where the search changes to reciprocals: the signs at both ends were noise, and with
/// the seventh root there were eight.
#[test]
fn a_cluster_at_the_border_keeps_its_parity() {
    let c = [
        1.0,
        -1.1425628663055296,
        -6.298773288688196,
        18.50931828903984,
        -21.530911494174756,
        12.987866787700769,
        -4.0370419141318985,
        0.513591847421945,
    ];
    check_roots(&c, -1.0, 1.0);
}

/// Two roots 2e-15 apart: pieces were halved in the middle, their ends rounded, and a bracket "with exactly one root" ended half a unit
/// of the last place before it.
#[test]
fn a_certified_bracket_is_where_its_piece_is() {
    let c = [0.24969488382342317, 31.941421508790878, 1020.2514648437499, -79.9375, 1.0];
    check_roots(&c, -0.0625, 4.0);
}

/// Beside the end the slope of the distance is known to two and a half errors of Horner's scheme.
#[test]
fn a_stationary_point_beside_the_end_within_the_noise_of_two_schemes() {
    let p = Point::new;
    let unit = 2.3283064365386963e-10;
    let cubic = Cubic::new(
        p(-65536.00000000035, 2.3283064451445505e-10),
        p(2.3283085875958065e-10, unit),
        p(-0.0002441406259107437, 2.97208502949325e-8),
        p(1.3385492649318563e-9, 2.3288726502812877e-10),
    );
    check_closest(&cubic, &p(unit, unit), 0.0, 1.0);
}

/// A root of order five 2e-3 below the border: the noise around it went on beyond the border, as a cluster of three of its own.
#[test]
fn a_multiple_root_beside_the_border_is_one() {
    let c = [
        1.0,
        -5.025390625,
        10.81646728515625,
        -12.925183773040771,
        9.260445386171341,
        -3.977901568985544,
        0.9485520235939475,
        -0.09685656604611381,
    ];
    let found = solve(&c, Ask::Real).expect("finite");
    assert_eq!(found.len(), 3, "{found:?}");
    check_roots(&c, -1.0, 1.0);
}

/// Near misses of order six 1e-2 beyond the border: the noise before it was a simple root at the border, and none is there.
#[test]
fn the_noise_of_a_multiple_root_beyond_the_border_is_no_root() {
    let c = [
        6.757950382650499,
        36.24720188508033,
        83.10609690511252,
        105.60896166145241,
        80.35146535286796,
        36.60934532596712,
        9.249996231868863,
        1.0,
    ];
    check_roots(&c, -2.0625, 0.0);
    let c = [
        13.938310864261181,
        67.5796890368976,
        140.07426454522272,
        160.8508300952664,
        110.48339844622653,
        45.3750000023573,
        10.312500000263753,
        1.0,
    ];
    check_roots(&c, -1.375, -3.674451042612832e-7);
}
