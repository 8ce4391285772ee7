//! Cases of scalars, vectors, polynomials and single cubics.

use feature_sampling::bezier::{critical, hull, nearest};
use feature_sampling::geometry::{Aabb, Point, Vector, distance_sq_to_segment, project_to_segment};
use feature_sampling::polynomial::{Polynomial, Root, RootKind};
use feature_sampling::scalar::{Field, Scalar};
use num_traits::{One, Zero};

use super::input::{Gen, lift_cubic, lift_point, lift_vector};
use super::{Truth, lift, ulps};

/// The larger of two coordinates' errors.
fn point_error<S: Scalar>(found: &Point<S>, truth: &Point<Truth>, size: &Truth) -> f64 {
    ulps(&found.x, &truth.x, size).max(ulps(&found.y, &truth.y, size))
}

/// The larger of two components' errors.
fn vector_error<S: Scalar>(found: &Vector<S>, truth: &Vector<Truth>, size: &Truth) -> f64 {
    ulps(&found.x, &truth.x, size).max(ulps(&found.y, &truth.y, size))
}

fn largest(values: impl IntoIterator<Item = Truth>) -> Truth {
    values.into_iter().map(Field::abs).fold(Truth::zero(), Scalar::max)
}

/// The largest coordinate of points, as their size.
fn reach<'p>(points: impl IntoIterator<Item = &'p Point<Truth>>) -> Truth {
    largest(points.into_iter().flat_map(|p| [p.x.clone(), p.y.clone()]))
}

/// √x.
pub fn sqrt<S: Scalar>(g: &mut Gen) -> f64 {
    let x: S = g.positive();
    let truth = lift(&x).sqrt();
    ulps(&x.sqrt(), &truth, &truth)
}

/// x².
pub fn square<S: Scalar>(g: &mut Gen) -> f64 {
    let x: S = g.number();
    let truth = lift(&x).square();
    ulps(&x.square(), &truth, &truth)
}

/// p/q.
pub fn ratio<S: Scalar>(g: &mut Gen) -> f64 {
    let [p, q] = [g.below(2000), g.below(2000) + 1].map(|n| i32::try_from(n).unwrap_or(1));
    let truth = Truth::ratio(p, q);
    ulps(&S::ratio(p, q), &truth, &truth)
}

/// (a + b)/2.
pub fn midpoint<S: Scalar>(g: &mut Gen) -> f64 {
    let (a, b): (S, S) = (g.number(), g.number());
    let truth = Truth::midpoint(&lift(&a), &lift(&b));
    ulps(&S::midpoint(&a, &b), &truth, &truth)
}

/// A double, rounded to the scalar.
pub fn from_f64<S: Scalar>(g: &mut Gen) -> f64 {
    let v = g.between(-100.0, 100.0);
    let truth = Truth::from_f64(v);
    ulps(&S::from_f64(v), &truth, &truth)
}

/// b − a.
pub fn point_minus<S: Scalar>(g: &mut Gen) -> f64 {
    let (a, b) = (g.point::<S>(), g.point::<S>());
    let truth = lift_point(&b).minus(&lift_point(&a));
    let found = b.minus(&a);
    ulps(&found.x, &truth.x, &truth.x).max(ulps(&found.y, &truth.y, &truth.y))
}

/// p + v.
pub fn point_plus<S: Scalar>(g: &mut Gen) -> f64 {
    let (p, v) = (g.point::<S>(), g.vector::<S>());
    let truth = lift_point(&p).plus(&lift_vector(&v));
    let found = p.plus(&v);
    ulps(&found.x, &truth.x, &truth.x).max(ulps(&found.y, &truth.y, &truth.y))
}

/// p + k v.
pub fn point_plus_scaled<S: Scalar>(g: &mut Gen) -> f64 {
    let (p, k, v) = (g.point::<S>(), g.number::<S>(), g.vector::<S>());
    let (tp, tk, tv) = (lift_point(&p), lift(&k), lift_vector(&v));
    let size = |a: &Truth, b: &Truth| a.clone().abs() + &(tk.clone() * b).abs();
    let (found, truth) = (p.plus_scaled(&k, &v), tp.plus_scaled(&tk, &tv));
    ulps(&found.x, &truth.x, &size(&tp.x, &tv.x)).max(ulps(&found.y, &truth.y, &size(&tp.y, &tv.y)))
}

/// |p − q|².
pub fn point_distance_sq<S: Scalar>(g: &mut Gen) -> f64 {
    let (p, q) = (g.point::<S>(), g.point::<S>());
    let truth = lift_point(&p).distance_sq(&lift_point(&q));
    ulps(&p.distance_sq(&q), &truth, &truth)
}

/// |p − q|.
pub fn point_distance<S: Scalar>(g: &mut Gen) -> f64 {
    let (p, q) = (g.point::<S>(), g.point::<S>());
    let truth = lift_point(&p).distance(&lift_point(&q));
    ulps(&p.distance(&q), &truth, &truth)
}

/// (p + q)/2.
pub fn point_middle<S: Scalar>(g: &mut Gen) -> f64 {
    let (p, q) = (g.point::<S>(), g.point::<S>());
    let truth = lift_point(&p).middle(&lift_point(&q));
    let found = p.middle(&q);
    ulps(&found.x, &truth.x, &truth.x).max(ulps(&found.y, &truth.y, &truth.y))
}

/// v + w and v − w.
pub fn vector_plus<S: Scalar>(g: &mut Gen) -> f64 {
    let (v, w) = (g.vector::<S>(), g.vector::<S>());
    let (a, b) = (lift_vector(&v), lift_vector(&w));
    let (truth, found) = (a.plus(&b), v.plus(&w));
    let sum = ulps(&found.x, &truth.x, &truth.x).max(ulps(&found.y, &truth.y, &truth.y));
    let (truth, found) = (a.minus(&b), v.minus(&w));
    sum.max(ulps(&found.x, &truth.x, &truth.x)).max(ulps(&found.y, &truth.y, &truth.y))
}

/// k v.
pub fn vector_scaled<S: Scalar>(g: &mut Gen) -> f64 {
    let (v, k) = (g.vector::<S>(), g.number::<S>());
    let (truth, found) = (lift_vector(&v).scaled(&lift(&k)), v.scaled(&k));
    ulps(&found.x, &truth.x, &truth.x).max(ulps(&found.y, &truth.y, &truth.y))
}

/// v + k w.
pub fn vector_plus_scaled<S: Scalar>(g: &mut Gen) -> f64 {
    let (v, k, w) = (g.vector::<S>(), g.number::<S>(), g.vector::<S>());
    let (tv, tk, tw) = (lift_vector(&v), lift(&k), lift_vector(&w));
    let size = |a: &Truth, b: &Truth| a.clone().abs() + &(tk.clone() * b).abs();
    let (found, truth) = (v.plus_scaled(&k, &w), tv.plus_scaled(&tk, &tw));
    ulps(&found.x, &truth.x, &size(&tv.x, &tw.x)).max(ulps(&found.y, &truth.y, &size(&tv.y, &tw.y)))
}

/// v·w.
pub fn vector_dot<S: Scalar>(g: &mut Gen) -> f64 {
    let (v, w) = (g.vector::<S>(), g.vector::<S>());
    let (a, b) = (lift_vector(&v), lift_vector(&w));
    let size = (a.x.clone() * &b.x).abs() + &(a.y.clone() * &b.y).abs();
    ulps(&v.dot(&w), &a.dot(&b), &size)
}

/// v × w.
pub fn vector_cross<S: Scalar>(g: &mut Gen) -> f64 {
    let (v, w) = (g.vector::<S>(), g.vector::<S>());
    let (a, b) = (lift_vector(&v), lift_vector(&w));
    let size = (a.x.clone() * &b.y).abs() + &(a.y.clone() * &b.x).abs();
    ulps(&v.cross(&w), &a.cross(&b), &size)
}

/// |v|².
pub fn vector_norm_sq<S: Scalar>(g: &mut Gen) -> f64 {
    let v = g.vector::<S>();
    let truth = lift_vector(&v).norm_sq();
    ulps(&v.norm_sq(), &truth, &truth)
}

/// |v|.
pub fn vector_norm<S: Scalar>(g: &mut Gen) -> f64 {
    let v = g.vector::<S>();
    let truth = lift_vector(&v).norm();
    ulps(&v.norm(), &truth, &truth)
}

/// v/|v|.
pub fn vector_unit<S: Scalar>(g: &mut Gen) -> f64 {
    let v = g.vector::<S>();
    match (v.unit(), lift_vector(&v).unit()) {
        (Some(found), Some(truth)) => vector_error(&found, &truth, &Truth::one()),
        (None, None) => 0.0,
        _ => f64::INFINITY,
    }
}

fn boxes<S: Scalar>(g: &mut Gen) -> (Aabb<S>, Aabb<Truth>) {
    let points = [g.point::<S>(), g.point(), g.point()];
    let truths = points.each_ref().map(lift_point);
    (Aabb::around(&points), Aabb::around(&truths))
}

/// Squared distance of a point from a box.
pub fn box_distance_sq<S: Scalar>(g: &mut Gen) -> f64 {
    let (found, truth) = boxes::<S>(g);
    let p = g.point::<S>();
    let known = truth.distance_sq(&lift_point(&p));
    ulps(&found.distance_sq(&p), &known, &known)
}

/// Extent of a box.
pub fn box_extent<S: Scalar>(g: &mut Gen) -> f64 {
    let (found, truth) = boxes::<S>(g);
    let (found, truth) = (found.extent(), truth.extent());
    ulps(&found.x, &truth.x, &truth.x).max(ulps(&found.y, &truth.y, &truth.y))
}

/// Centre of a box.
pub fn box_centre<S: Scalar>(g: &mut Gen) -> f64 {
    let (found, truth) = boxes::<S>(g);
    let (found, truth) = (found.centre(), truth.centre());
    ulps(&found.x, &truth.x, &truth.x).max(ulps(&found.y, &truth.y, &truth.y))
}

/// The nearest point of a segment.
pub fn projection<S: Scalar>(g: &mut Gen) -> f64 {
    let [p, a, b] = [g.point::<S>(), g.point(), g.point()];
    let lifted = [&p, &a, &b].map(lift_point);
    let [tp, ta, tb] = &lifted;
    let (found, truth) = (project_to_segment(&p, &a, &b).1, project_to_segment(tp, ta, tb).1);
    // The projection moves along a short segment as fast as p moves.
    point_error(&found, &truth, &reach(&lifted))
}

/// Its squared distance.
pub fn segment_distance_sq<S: Scalar>(g: &mut Gen) -> f64 {
    let [p, a, b] = [g.point::<S>(), g.point(), g.point()];
    let lifted = [&p, &a, &b].map(lift_point);
    let [tp, ta, tb] = &lifted;
    // Errors of coordinates count doubly in a square: relative to distance times size.
    let (found, truth) = (distance_sq_to_segment(&p, &a, &b), distance_sq_to_segment(tp, ta, tb));
    ulps(&found.sqrt(), &truth.sqrt(), &reach(&lifted))
}

fn polynomial<S: Scalar>(g: &mut Gen) -> (Polynomial<S, 6>, Polynomial<Truth, 6>) {
    let c: [S; 6] = std::array::from_fn(|_| g.number());
    let truth = Polynomial::new(c.each_ref().map(lift));
    (Polynomial::new(c), truth)
}

/// p(x).
pub fn polynomial_eval<S: Scalar>(g: &mut Gen) -> f64 {
    let ((p, truth), x) = (polynomial::<S>(g), g.parameter::<S>());
    let t = lift(&x);
    ulps(&p.eval(&x), &truth.eval(&t), &truth.magnitude(&t))
}

/// p(x) and p'(x).
pub fn polynomial_slope<S: Scalar>(g: &mut Gen) -> f64 {
    let ((p, truth), x) = (polynomial::<S>(g), g.parameter::<S>());
    let t = lift(&x);
    let ((value, slope), (v, s)) = (p.eval_with_derivative(&x), truth.eval_with_derivative(&t));
    let mut size = Truth::zero();
    for (j, c) in (0_i32..6).zip(&truth.coefficients).skip(1).rev() {
        size = size * &t + &(c.clone().abs() * &Truth::int(j));
    }
    ulps(&value, &v, &truth.magnitude(&t)).max(ulps(&slope, &s, &size))
}

/// Σ|aⱼ| |x|ʲ.
pub fn polynomial_magnitude<S: Scalar>(g: &mut Gen) -> f64 {
    let ((p, truth), x) = (polynomial::<S>(g), g.parameter::<S>());
    let known = truth.magnitude(&lift(&x));
    ulps(&p.magnitude(&x), &known, &known)
}

/// Taylor coefficients, each relative to its own sum of moduli.
pub fn polynomial_taylor<S: Scalar>(g: &mut Gen) -> f64 {
    let ((p, truth), x) = (polynomial::<S>(g), g.parameter::<S>());
    let t = lift(&x);
    let sizes = Polynomial::<Truth, 6>::new(truth.coefficients.each_ref().map(|c| c.clone().abs())).taylor(&t);
    let (found, known) = (p.taylor(&x), truth.taylor(&t));
    let errors = found.coefficients.iter().zip(&known.coefficients).zip(&sizes.coefficients);
    errors.map(|((f, k), s)| ulps(f, k, s)).fold(0.0, f64::max)
}

fn bound_error<S: Scalar>(found: Option<S>, truth: Option<Truth>) -> f64 {
    match (found, truth) {
        (Some(found), Some(truth)) => {
            // Rounded outwards: a bound below the true one is no bound.
            let below = lift(&found) < truth.clone() * &(Truth::one() - &Truth::unit_roundoff().mul_pow2(8));
            if below { f64::INFINITY } else { ulps(&found, &truth, &truth) }
        }
        (None, None) => 0.0,
        _ => f64::INFINITY,
    }
}

/// Cauchy's bound.
pub fn cauchy<S: Scalar>(g: &mut Gen) -> f64 {
    let (p, truth) = polynomial::<S>(g);
    bound_error(p.cauchy_bound(), truth.cauchy_bound())
}

/// Kojima's bound.
pub fn kojima<S: Scalar>(g: &mut Gen) -> f64 {
    let (p, truth) = polynomial::<S>(g);
    bound_error(p.kojima_bound(), truth.kojima_bound())
}

/// |p(x)| at roots with a change of sign, relative to Σ|aⱼ| |x|ʲ: how far the root is one of a neighbouring polynomial.
fn residual<S: Scalar, const N: usize>(truth: &Polynomial<Truth, N>, x: &S) -> f64 {
    let t = lift(x);
    ulps(&S::zero(), &truth.eval(&t), &truth.magnitude(&t))
}

/// Roots in [0, 1].
pub fn roots_in_unit<S: Scalar>(g: &mut Gen) -> f64 {
    let (p, truth) = polynomial::<S>(g);
    let roots = p.roots_in_unit().unwrap_or_default();
    roots.iter().filter(|r| r.kind == RootKind::Simple).map(|r| residual(&truth, &r.value)).fold(0.0, f64::max)
}

/// All real roots.
pub fn real_roots<S: Scalar>(g: &mut Gen) -> f64 {
    let (p, truth) = polynomial::<S>(g);
    let roots = p.real_roots().unwrap_or_default();
    roots.iter().filter(|r| r.kind == RootKind::Simple).map(|r| residual(&truth, &r.value)).fold(0.0, f64::max)
}

/// Roots in [−2, 3].
pub fn roots_between<S: Scalar>(g: &mut Gen) -> f64 {
    let (p, truth) = polynomial::<S>(g);
    let roots = p.roots_between(&S::int(-2), &S::int(3)).unwrap_or_default();
    roots.iter().filter(|r| r.kind == RootKind::Simple).map(|r| residual(&truth, &r.value)).fold(0.0, f64::max)
}

/// 0 if p changes its sign in every bracket a thousandth wide and none is wider.
fn change_of_sign<S: Scalar, const N: usize>(truth: &Polynomial<Truth, N>, roots: &[Root<S>]) -> f64 {
    let width = S::one().mul_pow2(-10);
    let holds = |r: &&Root<S>| {
        let signs = [&r.lower, &r.upper].map(|x| truth.eval(&lift(x)) > Truth::zero());
        // Brackets beyond 1 are reciprocals of such: w/(1 − w²/4) wide.
        let wide = width.clone() / &(S::one() - &width.clone().square().mul_pow2(-2));
        let most = (wide + &S::unit_roundoff().mul_pow2(3)) * &r.value.clone().abs();
        signs[0] != signs[1] && r.upper.clone() - &r.lower <= most
    };
    let simple = roots.iter().filter(|r| r.kind == RootKind::Simple && r.lower < r.upper);
    if simple.clone().all(|r| holds(&r)) { 0.0 } else { f64::INFINITY }
}

/// Roots in [0, 1], in brackets a thousandth wide.
pub fn roots_in_unit_within<S: Scalar>(g: &mut Gen) -> f64 {
    let (p, truth) = polynomial::<S>(g);
    change_of_sign(&truth, &p.roots_in_unit_within(&S::one().mul_pow2(-10)).unwrap_or_default())
}

/// All real roots, in brackets a thousandth wide.
pub fn real_roots_within<S: Scalar>(g: &mut Gen) -> f64 {
    let (p, truth) = polynomial::<S>(g);
    change_of_sign(&truth, &p.real_roots_within(&S::one().mul_pow2(-10)).unwrap_or_default())
}

/// Roots in [−2, 3], in brackets a thousandth wide.
pub fn roots_between_within<S: Scalar>(g: &mut Gen) -> f64 {
    let (p, truth) = polynomial::<S>(g);
    change_of_sign(
        &truth,
        &p.roots_between_within(&S::int(-2), &S::int(3), &S::one().mul_pow2(-10)).unwrap_or_default(),
    )
}

/// B(t) by de Casteljau.
pub fn cubic_eval<S: Scalar>(g: &mut Gen) -> f64 {
    let (c, t) = (g.cubic::<S>(), g.parameter::<S>());
    let truth = lift_cubic(&c);
    point_error(&c.eval(&t), &truth.eval(&lift(&t)), &reach(&truth.points))
}

/// Control points of both parts.
pub fn cubic_split<S: Scalar>(g: &mut Gen) -> f64 {
    let (c, t) = (g.cubic::<S>(), g.parameter::<S>());
    let truth = lift_cubic(&c);
    let size = reach(&truth.points);
    let ((a, b), (ta, tb)) = (c.split_at(&t), truth.split_at(&lift(&t)));
    let pairs = a.points.iter().chain(&b.points).zip(ta.points.iter().chain(&tb.points));
    pairs.map(|(f, k)| point_error(f, k, &size)).fold(0.0, f64::max)
}

/// The cubic of a quadratic, and of a line.
pub fn cubic_raised<S: Scalar>(g: &mut Gen) -> f64 {
    use feature_sampling::bezier::Cubic;
    let [a, b, c] = [g.point::<S>(), g.point(), g.point()];
    let lifted = [&a, &b, &c].map(lift_point);
    let size = reach(&lifted);
    let [ta, tb, tc] = lifted;
    let (line, line_truth) = (Cubic::line(a.clone(), c.clone()), Cubic::line(ta.clone(), tc.clone()));
    let (bow, bow_truth) = (Cubic::quadratic(a, &b, c), Cubic::quadratic(ta, &tb, tc));
    let pairs = line.points.iter().chain(&bow.points).zip(line_truth.points.iter().chain(&bow_truth.points));
    pairs.map(|(f, k)| point_error(f, k, &size)).fold(0.0, f64::max)
}

/// Coefficients in powers of t.
pub fn cubic_powers<S: Scalar>(g: &mut Gen) -> f64 {
    let c = g.cubic::<S>();
    let truth = lift_cubic(&c);
    let (size, p, q) = (reach(&truth.points), c.power_basis(), truth.power_basis());
    p.a.iter().zip(&q.a).map(|(f, k)| vector_error(f, k, &size)).fold(0.0, f64::max)
}

/// B(t) in powers of t, with the coefficients' own errors.
pub fn power_eval<S: Scalar>(g: &mut Gen) -> f64 {
    let (c, t) = (g.cubic::<S>(), g.parameter::<S>());
    let truth = lift_cubic(&c);
    let known = truth.power_basis().eval(&lift(&t));
    point_error(&c.power_basis().eval(&t), &known, &reach(&truth.points))
}

/// B'(t) and B''(t).
pub fn power_derivatives<S: Scalar>(g: &mut Gen) -> f64 {
    let (c, t) = (g.cubic::<S>(), g.parameter::<S>());
    let truth = lift_cubic(&c);
    let (size, p, q, s) = (reach(&truth.points), c.power_basis(), truth.power_basis(), lift(&t));
    let first = vector_error(&p.derivative(&t), &q.derivative(&s), &size);
    first.max(vector_error(&p.second_derivative(&t), &q.second_derivative(&s), &size))
}

/// Taylor coefficients of B about t.
pub fn power_taylor<S: Scalar>(g: &mut Gen) -> f64 {
    let (c, t) = (g.cubic::<S>(), g.parameter::<S>());
    let truth = lift_cubic(&c);
    let (size, p, q) = (reach(&truth.points), c.power_basis().taylor(&t), truth.power_basis().taylor(&lift(&t)));
    p.iter().zip(&q).map(|(f, k)| vector_error(f, k, &size)).fold(0.0, f64::max)
}

/// Each parameter's distance to the nearest true one; a different number of them is no error of rounding but of counting.
fn parameters_error<S: Scalar>(found: &[S], truth: &[Truth]) -> f64 {
    if found.len() != truth.len() {
        return f64::INFINITY;
    }
    found.iter().zip(truth).map(|(f, k)| ulps(f, k, &Truth::one())).fold(0.0, f64::max)
}

/// Vertices of tame cubics.
pub fn vertices<S: Scalar>(g: &mut Gen) -> f64 {
    let c = g.tame_cubic::<S>();
    parameters_error(&critical::vertices(&c.power_basis()), &critical::vertices(&lift_cubic(&c).power_basis()))
}

/// Parameters of least speed of tame cubics.
pub fn slowest<S: Scalar>(g: &mut Gen) -> f64 {
    let c = g.tame_cubic::<S>();
    parameters_error(&critical::slowest(&c.power_basis()), &critical::slowest(&lift_cubic(&c).power_basis()))
}

/// Inflections of S-shaped cubics.
pub fn inflections<S: Scalar>(g: &mut Gen) -> f64 {
    let mut c = g.tame_cubic::<S>();
    // The second handle mirrored at the chord: one inflection, in the middle part.
    let middle = c.points[0].middle(&c.points[3]);
    c.points[2] = middle.plus(&middle.minus(&c.points[1]));
    parameters_error(&critical::inflections(&c.power_basis()), &critical::inflections(&lift_cubic(&c).power_basis()))
}

/// Distance to the convex hull of a cubic.
pub fn hull_distance<S: Scalar>(g: &mut Gen) -> f64 {
    let (c, q) = (g.cubic::<S>(), g.point::<S>());
    let (truth, t) = (lift_cubic(&c), lift_point(&q));
    let size = reach(truth.points.iter().chain([&t]));
    ulps(&hull::hull_distance_sq(&c, &q).sqrt(), &hull::hull_distance_sq(&truth, &t).sqrt(), &size)
}

/// The hull test never says that a curve keeps away which does not.
pub fn hull_keeps_away<S: Scalar>(g: &mut Gen) -> f64 {
    let (c, q) = (g.cubic::<S>(), g.point::<S>());
    let (truth, t) = (lift_cubic(&c), lift_point(&q));
    let size = reach(truth.points.iter().chain([&t]));
    let known = nearest::nearest(&truth.power_basis(), &t).distance_sq.sqrt();
    // Asked about a distance just beyond the true one: "keeps away" is wrong, by as much as that is beyond.
    let asked = S::from_f64(known.to_f64() * 1.000_001).square();
    if !hull::hull_keeps_away(&c, &q, &asked) {
        return 0.0;
    }
    ulps(&asked.sqrt(), &known, &size)
}

/// Coefficients of (B − q)·B'.
pub fn quintic<S: Scalar>(g: &mut Gen) -> f64 {
    let (c, q) = (g.cubic::<S>(), g.point::<S>());
    let (truth, t) = (lift_cubic(&c), lift_point(&q));
    let size = reach(truth.points.iter().chain([&t])).square();
    let found = nearest::distance_quintic(&c.power_basis(), &q);
    let known = nearest::distance_quintic(&truth.power_basis(), &t);
    found.coefficients.iter().zip(&known.coefficients).map(|(f, k)| ulps(f, k, &size)).fold(0.0, f64::max)
}

/// The distance of the closest point.
pub fn nearest_distance<S: Scalar>(g: &mut Gen) -> f64 {
    let (c, q) = (g.cubic::<S>(), g.point::<S>());
    let (truth, t) = (lift_cubic(&c), lift_point(&q));
    let size = reach(truth.points.iter().chain([&t]));
    let found = nearest::nearest(&c.power_basis(), &q);
    let known = nearest::nearest(&truth.power_basis(), &t);
    ulps(&found.distance_sq.sqrt(), &known.distance_sq.sqrt(), &size)
}

/// The distance of the closest point in an interval.
pub fn nearest_between<S: Scalar>(g: &mut Gen) -> f64 {
    let (c, q, a, b) = (g.cubic::<S>(), g.point::<S>(), g.parameter::<S>(), g.parameter::<S>());
    let (truth, t) = (lift_cubic(&c), lift_point(&q));
    let size = reach(truth.points.iter().chain([&t]));
    let (a, b) = if a < b { (a, b) } else { (b, a) };
    let found = nearest::nearest_between(&c.power_basis(), &q, &a, &b);
    let known = nearest::nearest_between(&truth.power_basis(), &t, &lift(&a), &lift(&b));
    ulps(&found.distance_sq.sqrt(), &known.distance_sq.sqrt(), &size)
}

/// The distance at the best critical point or end.
pub fn critical_points<S: Scalar>(g: &mut Gen) -> f64 {
    let (c, q) = (g.cubic::<S>(), g.point::<S>());
    let (truth, t) = (lift_cubic(&c), lift_point(&q));
    let size = reach(truth.points.iter().chain([&t]));
    let known = nearest::nearest(&truth.power_basis(), &t).distance_sq.sqrt();
    let basis = c.power_basis();
    let best = nearest::critical_points(&basis, &q)
        .into_iter()
        .chain([S::zero(), S::one()])
        .map(|s| basis.eval(&s).distance(&q))
        .fold(S::infinity(), Scalar::min);
    ulps(&best, &known, &size)
}
