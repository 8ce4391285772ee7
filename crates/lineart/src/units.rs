//! Lengths as a user writes them: `0.5`, `0.1mm`, `2%`.
//!
//! A plain number is in user units of the drawing. A physical unit needs to know how large the drawing is on paper,
//! which the drawing tells ([`crate::drawing::Drawing::user_units_per_mm`]) or does not; `%` is of the diagonal of
//! the bounding box of the control points. CSS fixes the ratios: 1 in = 25.4 mm = 96 px = 72 pt.
//!
//! Every length option is a distance, so negative numbers, NaN and infinities are refused when the text is parsed.
//! Zero is a length; an option that cannot do with zero says so itself.

use std::fmt;
use std::str::FromStr;

/// Unit of a [`Length`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// User units of the root `viewBox`: a plain number.
    User,
    /// Millimetres.
    Mm,
    /// Centimetres.
    Cm,
    /// Inches.
    In,
    /// CSS pixels, 96 to the inch.
    Px,
    /// Points, 72 to the inch.
    Pt,
    /// Hundredths of the diagonal of the bounding box of the control points.
    Percent,
}

impl Unit {
    const ALL: [(&'static str, Self); 6] = [
        ("mm", Self::Mm),
        ("cm", Self::Cm),
        ("in", Self::In),
        ("px", Self::Px),
        ("pt", Self::Pt),
        ("%", Self::Percent),
    ];

    /// The unit in millimetres, where it has a physical size.
    pub const fn in_mm(self) -> Option<f64> {
        match self {
            Self::Mm => Some(1.0),
            Self::Cm => Some(10.0),
            Self::In => Some(25.4),
            Self::Px => Some(25.4 / 96.0),
            Self::Pt => Some(25.4 / 72.0),
            Self::User | Self::Percent => None,
        }
    }

    /// The suffix, empty for user units.
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::User => "",
            Self::Mm => "mm",
            Self::Cm => "cm",
            Self::In => "in",
            Self::Px => "px",
            Self::Pt => "pt",
            Self::Percent => "%",
        }
    }
}

/// A distance with its unit; finite and not negative.
///
/// ```
/// use lineart::units::Length;
/// let length: Length = "0.5mm".parse()?;
/// // A drawing of 4 user units to the millimetre whose diagonal is 800 user units:
/// assert_eq!(length.resolve(Some(4.0), 800.0)?, 2.0);
/// assert_eq!("1%".parse::<Length>()?.resolve(None, 800.0)?, 8.0);
/// # Ok::<(), lineart::units::LengthError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Length {
    value: f64,
    unit: Unit,
}

/// Why a text is not a length, or a length has no size in a drawing.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LengthError {
    /// Not a number with one of the units; holds the text.
    Malformed(String),
    /// A number, but not a finite one; holds the text.
    NotFinite(String),
    /// A number below zero; holds the text.
    Negative(String),
    /// The drawing has no physical size: give user units or `%` instead.
    NoPhysicalSize(String),
    /// The length leaves the range of finite numbers when converted to user units.
    OutOfRange(String),
}

impl fmt::Display for LengthError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Malformed(text) => {
                write!(f, "“{text}” is not a length: write a number alone (user units) or with mm, cm, in, px, pt or %")
            }
            Self::NotFinite(text) => write!(f, "“{text}” is not a finite length"),
            Self::Negative(text) => write!(f, "“{text}” is negative; a length is 0 or more"),
            Self::NoPhysicalSize(text) => write!(
                f,
                "“{text}” has no size here: the drawing gives no physical width or height; use user units or %"
            ),
            Self::OutOfRange(text) => write!(f, "“{text}” is too large for this drawing"),
        }
    }
}

impl std::error::Error for LengthError {}

impl Length {
    /// The length `value` `unit`; refuses what parsing refuses.
    pub fn new(value: f64, unit: Unit) -> Result<Self, LengthError> {
        let text = || format!("{value}{}", unit.suffix());
        if !value.is_finite() {
            Err(LengthError::NotFinite(text()))
        } else if value < 0.0 {
            Err(LengthError::Negative(text()))
        } else {
            Ok(Self { value, unit })
        }
    }

    /// The number before the unit.
    pub const fn value(&self) -> f64 {
        self.value
    }

    /// The unit.
    pub const fn unit(&self) -> Unit {
        self.unit
    }

    /// The length in user units, within rounding of two operations.
    ///
    /// `user_units_per_mm` is the drawing's, `diagonal` that of the bounding box of its control points.
    pub fn resolve(&self, user_units_per_mm: Option<f64>, diagonal: f64) -> Result<f64, LengthError> {
        let user = match (self.unit, self.unit.in_mm(), user_units_per_mm) {
            (Unit::Percent, ..) => self.value / 100.0 * diagonal,
            (_, None, _) => self.value,
            (_, Some(mm), Some(per_mm)) => self.value * mm * per_mm,
            (_, Some(_), None) => return Err(LengthError::NoPhysicalSize(self.to_string())),
        };
        if user.is_finite() { Ok(user) } else { Err(LengthError::OutOfRange(self.to_string())) }
    }
}

impl fmt::Display for Length {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.value, self.unit.suffix())
    }
}

impl FromStr for Length {
    type Err = LengthError;

    fn from_str(text: &str) -> Result<Self, LengthError> {
        let trimmed = text.trim();
        let (number, unit) = Unit::ALL
            .iter()
            .find_map(|(suffix, unit)| Some((trimmed.strip_suffix(suffix)?.trim_end(), *unit)))
            .unwrap_or((trimmed, Unit::User));
        let value: f64 = number.parse().map_err(|_| LengthError::Malformed(text.to_owned()))?;
        Self::new(value, unit).map_err(|error| match error {
            LengthError::NotFinite(_) => LengthError::NotFinite(text.to_owned()),
            LengthError::Negative(_) => LengthError::Negative(text.to_owned()),
            other => other,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn user(text: &str) -> Result<f64, LengthError> {
        text.parse::<Length>()?.resolve(Some(2.0), 50.0)
    }

    #[test]
    fn every_unit_has_its_size() {
        assert_eq!(user("3"), Ok(3.0));
        assert_eq!(user("3mm"), Ok(6.0));
        assert_eq!(user(" 3 mm "), Ok(6.0));
        assert_eq!(user("0.5cm"), Ok(10.0));
        assert_eq!(user("1in"), Ok(50.8));
        assert!((user("96px").unwrap() - 50.8).abs() < 1e-12);
        assert!((user("72pt").unwrap() - 50.8).abs() < 1e-12);
        assert_eq!(user("10%"), Ok(5.0));
        assert_eq!(user("1e-3mm"), Ok(0.002));
        assert_eq!(user("0"), Ok(0.0));
    }

    #[test]
    fn what_is_no_distance_is_refused() {
        for text in ["", "mm", "%", "3 miles", "3MM", "0x3", "1,5mm", "3mm3", "--3"] {
            assert_eq!(user(text), Err(LengthError::Malformed(text.to_owned())), "{text}");
        }
        for text in ["NaN", "inf", "infinity", "nanmm", "1e999", "-inf%"] {
            assert_eq!(user(text), Err(LengthError::NotFinite(text.to_owned())), "{text}");
        }
        assert_eq!(user("-1mm"), Err(LengthError::Negative("-1mm".to_owned())));
        assert_eq!(user("1e308in"), Err(LengthError::OutOfRange(Length::new(1e308, Unit::In).unwrap().to_string())));
    }

    #[test]
    fn a_physical_length_needs_a_physical_drawing() {
        let length: Length = "1mm".parse().unwrap();
        assert_eq!(length.resolve(None, 50.0), Err(LengthError::NoPhysicalSize("1mm".to_owned())));
        assert_eq!("1".parse::<Length>().unwrap().resolve(None, 50.0), Ok(1.0));
    }

    #[test]
    fn a_length_prints_as_it_is_read() {
        for text in ["3", "0.1mm", "2.5cm", "1in", "4px", "5pt", "7%"] {
            assert_eq!(text.parse::<Length>().unwrap().to_string(), text);
        }
    }
}
