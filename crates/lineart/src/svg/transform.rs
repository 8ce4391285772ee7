//! Affine maps: the `transform` attribute and its cousin, the CSS property.
//!
//! A map is the six numbers of SVG's `matrix(a b c d e f)`: (x, y) ↦ (a x + c y + e, b x + d y + f). Products are
//! formed in f64 on the way down the tree and applied to each point once, so a point deep inside ten groups carries
//! the rounding of one product, not of ten.

use svgtypes::{TransformListParser, TransformListToken};

use super::fault::Fault;

/// (x, y) ↦ (a x + c y + e, b x + d y + f).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine {
    pub(super) a: f64,
    pub(super) b: f64,
    pub(super) c: f64,
    pub(super) d: f64,
    pub(super) e: f64,
    pub(super) f: f64,
}

impl Affine {
    pub(super) const IDENTITY: Self = Self { a: 1.0, b: 0.0, c: 0.0, d: 1.0, e: 0.0, f: 0.0 };

    pub(super) const fn translation(x: f64, y: f64) -> Self {
        Self { e: x, f: y, ..Self::IDENTITY }
    }

    pub(super) const fn scaling(x: f64, y: f64) -> Self {
        Self { a: x, d: y, ..Self::IDENTITY }
    }

    /// The map that does `inner` first, then `self`.
    pub(super) fn after(&self, inner: &Self) -> Self {
        Self {
            a: self.a * inner.a + self.c * inner.b,
            b: self.b * inner.a + self.d * inner.b,
            c: self.a * inner.c + self.c * inner.d,
            d: self.b * inner.c + self.d * inner.d,
            e: self.a * inner.e + self.c * inner.f + self.e,
            f: self.b * inner.e + self.d * inner.f + self.f,
        }
    }

    /// The image of (x, y).
    pub(super) fn apply(&self, x: f64, y: f64) -> (f64, f64) {
        (self.a * x + self.c * y + self.e, self.b * x + self.d * y + self.f)
    }

    /// The factor by which areas grow, to the power ½: what becomes of a stroke width, on average over directions.
    pub(super) fn mean_scale(&self) -> f64 {
        (self.a * self.d - self.b * self.c).abs().sqrt()
    }

    /// The plane collapses to a line or a point. The bound is relative: the determinant is a difference of two
    /// products, each rounded, so that below a few units in the last place its value is noise.
    pub(super) fn is_singular(&self) -> bool {
        // Scaled, so that the products neither overflow nor vanish. Entries that are not finite are no collapse:
        // they come to light as coordinates out of range.
        let largest = [self.a, self.b, self.c, self.d].into_iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        if largest == 0.0 || !largest.is_finite() {
            return largest == 0.0;
        }
        let [a, b, c, d] = [self.a, self.b, self.c, self.d].map(|v| v / largest);
        let (p, q) = (a * d, b * c);
        (p - q).abs() <= 4.0 * f64::EPSILON * (p.abs() + q.abs())
    }

    /// A transform list as the `transform` attribute has it.
    pub(super) fn parse(text: &str) -> Result<Self, Fault> {
        let mut map = Self::IDENTITY;
        for token in TransformListParser::from(text) {
            let token = token.map_err(|error| Fault::from_svgtypes(error, text))?;
            map = map.after(&Self::of_token(token));
        }
        Ok(map)
    }

    /// A transform list as CSS has it, where that can be said in the attribute's grammar: lengths in px, angles in
    /// deg, the six functions the attribute knows.
    pub(super) fn parse_css(text: &str) -> Option<Self> {
        if text == "none" {
            return Some(Self::IDENTITY);
        }
        let plain = text.replace("px", "").replace("deg", "");
        Self::parse(&plain).ok()
    }

    fn of_token(token: TransformListToken) -> Self {
        match token {
            TransformListToken::Matrix { a, b, c, d, e, f } => Self { a, b, c, d, e, f },
            TransformListToken::Translate { tx, ty } => Self::translation(tx, ty),
            TransformListToken::Scale { sx, sy } => Self::scaling(sx, sy),
            TransformListToken::Rotate { angle } => {
                let (sin, cos) = sin_cos_degrees(angle);
                Self { a: cos, b: sin, c: -sin, d: cos, ..Self::IDENTITY }
            }
            TransformListToken::SkewX { angle } => Self { c: angle.to_radians().tan(), ..Self::IDENTITY },
            TransformListToken::SkewY { angle } => Self { b: angle.to_radians().tan(), ..Self::IDENTITY },
        }
    }
}

/// Sine and cosine of an angle in degrees; exact at multiples of 90°, where a drawing means a quarter turn and
/// π rounded to f64 would tilt it by 1e-16.
pub(super) fn sin_cos_degrees(angle: f64) -> (f64, f64) {
    let turn = angle.rem_euclid(360.0);
    match turn {
        0.0 | 360.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => turn.to_radians().sin_cos(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(list: &str, x: f64, y: f64) -> (f64, f64) {
        Affine::parse(list).unwrap().apply(x, y)
    }

    fn near(p: (f64, f64), q: (f64, f64)) -> bool {
        (p.0 - q.0).abs() < 1e-14 && (p.1 - q.1).abs() < 1e-14
    }

    #[test]
    fn each_function() {
        assert_eq!(image("matrix(1 2 3 4 5 6)", 1.0, 1.0), (9.0, 12.0));
        assert_eq!(image("translate(3)", 1.0, 1.0), (4.0, 1.0));
        assert_eq!(image("translate(3,-4)", 1.0, 1.0), (4.0, -3.0));
        assert_eq!(image("scale(3)", 1.0, 2.0), (3.0, 6.0));
        assert_eq!(image("scale(3 4)", 1.0, 2.0), (3.0, 8.0));
        assert_eq!(image("rotate(90)", 1.0, 2.0), (-2.0, 1.0));
        assert_eq!(image("rotate(-270)", 1.0, 2.0), (-2.0, 1.0));
        assert_eq!(image("rotate(180 1 1)", 3.0, 4.0), (-1.0, -2.0));
        assert!(near(image("rotate(30)", 2.0, 0.0), (3.0_f64.sqrt(), 1.0)));
        assert!(near(image("skewX(45)", 1.0, 2.0), (3.0, 2.0)));
        assert!(near(image("skewY(45)", 1.0, 2.0), (1.0, 3.0)));
    }

    #[test]
    fn a_list_applies_from_the_right() {
        assert_eq!(image("translate(10 0) scale(2)", 1.0, 1.0), (12.0, 2.0));
        assert_eq!(image("scale(2), translate(10 0)", 1.0, 1.0), (22.0, 2.0));
        assert_eq!(image("", 1.0, 1.0), (1.0, 1.0));
    }

    #[test]
    fn malformed_lists_say_where() {
        assert_eq!(Affine::parse("translate(1 2) wobble(3)").unwrap_err().at, Some(15));
        assert!(Affine::parse("scale(").is_err());
        assert!(Affine::parse("matrix(1 2 3)").is_err());
        assert!(Affine::parse("scale(nan)").is_err());
    }

    #[test]
    fn css_spelling() {
        assert_eq!(Affine::parse_css("translate(3px, 4px) rotate(90deg)").unwrap().apply(1.0, 2.0), (1.0, 5.0));
        assert_eq!(Affine::parse_css("none"), Some(Affine::IDENTITY));
        assert_eq!(Affine::parse_css("translate(10%, 4px)"), None);
        assert_eq!(Affine::parse_css("rotate(1rad)"), None);
    }

    #[test]
    fn singular_maps_are_seen() {
        assert!(Affine::parse("scale(0)").unwrap().is_singular());
        assert!(Affine::parse("rotate(30) scale(1 0) rotate(10)").unwrap().is_singular());
        assert!(!Affine::parse("scale(1e-12 1e12)").unwrap().is_singular());
        assert!(!Affine::parse("scale(1e-200)").unwrap().is_singular());
        assert!(!Affine::parse("scale(1e300)").unwrap().is_singular());
        assert!(!Affine::parse("scale(1e300) scale(1e300)").unwrap().is_singular());
        assert!(!Affine::parse("rotate(45)").unwrap().is_singular());
    }
}
