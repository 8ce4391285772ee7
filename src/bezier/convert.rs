//! Cubics to and from `kurbo`. Both sides describe a cubic by its control points: conversions are exact.

use super::Cubic;

impl From<kurbo::CubicBez> for Cubic<f64> {
    #[inline]
    fn from(c: kurbo::CubicBez) -> Self {
        Self::new(c.p0.into(), c.p1.into(), c.p2.into(), c.p3.into())
    }
}

impl From<Cubic<f64>> for kurbo::CubicBez {
    #[inline]
    fn from(c: Cubic<f64>) -> Self {
        let [p0, p1, p2, p3] = c.points;
        Self::new(p0, p1, p2, p3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use kurbo::ParamCurve;

    #[test]
    fn there_and_back() {
        let [a, b, c, d] = [(0.0, 0.1), (1.0, 2.0), (3.0, 2.5), (4.0, -0.7)].map(|(x, y)| Point::new(x, y));
        let cubic = Cubic::new(a, b, c, d);
        let theirs = kurbo::CubicBez::from(cubic);
        assert_eq!(Cubic::from(theirs), cubic);
        assert!(Point::from(theirs.eval(0.3)).distance(&cubic.eval(&0.3)) < 1e-15, "the same curve");
    }
}
