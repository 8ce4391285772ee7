//! Cubics with a point each, in the three classes that closest-point solvers are compared in.

use crate::random::Random;
use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::Point;

/// Where the points lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// c0: anywhere in the box of the control points.
    Box,
    /// c1: within 1e-3 of the diagonal of the curve.
    Near,
    /// c2: within 1e-3 of the diagonal of a centre of curvature.
    Centre,
}

impl Class {
    /// c0, c1, c2.
    pub const ALL: [Self; 3] = [Self::Box, Self::Near, Self::Centre];
}

/// A random cubic in a square of side 100 and a query.
pub fn query(class: Class, random: &mut Random) -> (Cubic<f64>, Point<f64>) {
    loop {
        let mut point = || Point::new(random.between(0.0, 100.0), random.between(0.0, 100.0));
        let cubic = Cubic::new(point(), point(), point(), point());
        let (control, b, t) = (cubic.control_box(), cubic.power_basis(), random.unit());
        let extent = control.extent();
        let near = extent.norm() * 1e-3;
        let mut beside =
            |p: Point<f64>| Point::new(p.x + near * random.between(-1.0, 1.0), p.y + near * random.between(-1.0, 1.0));
        let query = match class {
            Class::Box => {
                Point::new(random.between(control.min.x, control.max.x), random.between(control.min.y, control.max.y))
            }
            Class::Near => beside(b.eval(&t)),
            Class::Centre => {
                let (d, dd) = (b.derivative(&t), b.second_derivative(&t));
                let centre = b.eval(&t).plus_scaled(&(d.norm_sq() / d.cross(&dd)), &d.left());
                let far = control.distance_sq(&centre);
                if far.is_nan() || far > extent.norm_sq() {
                    continue;
                }
                beside(centre)
            }
        };
        return (cubic, query);
    }
}
