//! The query classes of the benches, from a fixed seed: c0, uniform in the control box of a random cubic; c1, within
//! 1e-3 of its diagonal of the curve; c2, within 1e-3 of the diagonal of a centre of curvature.

use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::Point;

/// A small generator, the same everywhere.
pub(crate) struct Random(u64);

impl Random {
    /// Starts at a seed.
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Uniform in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let x = (self.0 ^ (self.0 >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        f64::from(u32::try_from(x >> 32).unwrap_or_default()) / 4_294_967_296.0
    }

    fn point(&mut self) -> Point<f64> {
        Point::new(self.unit() * 100.0, self.unit() * 100.0)
    }
}

/// So many cubics with a query each.
pub(crate) fn class(number: u32, count: usize) -> Vec<(Cubic<f64>, Point<f64>)> {
    let mut random = Random::new(42);
    let mut list = Vec::new();
    while list.len() < count {
        let cubic = Cubic::new(random.point(), random.point(), random.point(), random.point());
        let (control, b, t) = (cubic.control_box(), cubic.power_basis(), random.unit());
        let extent = control.extent();
        let near = extent.norm() * 1e-3;
        let jitter = |p: Point<f64>, r: &mut Random| {
            Point::new(p.x + (r.unit() * 2.0 - 1.0) * near, p.y + (r.unit() * 2.0 - 1.0) * near)
        };
        let query = match number {
            0 => Point::new(control.min.x + extent.x * random.unit(), control.min.y + extent.y * random.unit()),
            1 => jitter(b.eval(&t), &mut random),
            _ => {
                let (d, dd) = (b.derivative(&t), b.second_derivative(&t));
                let centre = b.eval(&t).plus_scaled(&(d.norm_sq() / d.cross(&dd)), &d.left());
                if control.distance_sq(&centre) > extent.norm_sq() {
                    continue;
                }
                jitter(centre, &mut random)
            }
        };
        list.push((cubic, query));
    }
    list
}
