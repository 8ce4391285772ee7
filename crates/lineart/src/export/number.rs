//! How numbers are written.
//!
//! Rust prints a double with the fewest digits that read back to the same bits, and never with an exponent, which
//! every CSV reader, spreadsheet and plotting script understands. Two values need a word more: −0 is written as 0 (the
//! sign of a zero is an accident of rounding and would make equal results differ), and an infinite lfs has no decimal
//! form: `inf` in tables, `null` in JSON, which knows no infinity.

use std::fmt;

/// A double in shortest round-trip form; `inf`, `-inf` and `NaN` where it is not finite.
#[derive(Clone, Copy, Debug)]
pub struct Number(pub f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Adding zero turns −0 into 0 and changes nothing else.
        fmt::Display::fmt(&(self.0 + 0.0), f)
    }
}

/// A double as JSON writes it: like [`Number`], with `null` for what is not finite.
#[derive(Clone, Copy, Debug)]
pub struct JsonNumber(pub f64);

impl fmt::Display for JsonNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_finite() { Number(self.0).fmt(f) } else { f.write_str("null") }
    }
}

/// A double for people to read: about four significant digits, `inf` where it is infinite.
#[derive(Clone, Copy, Debug)]
pub struct Readable(pub f64);

impl fmt::Display for Readable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size != 0.0 && size.is_finite() && !(1e-4..1e6).contains(&size) {
            return write!(f, "{:.3e}", self.0);
        }
        let decimals = [(1000.0, 0), (100.0, 1), (10.0, 2), (1.0, 3), (0.1, 4), (0.01, 5), (0.001, 6)]
            .iter()
            .find_map(|&(from, decimals)| (size >= from).then_some(decimals))
            .unwrap_or(7);
        f.write_str(&trimmed(self.0, decimals))
    }
}

/// Rounded to so many decimals, without trailing zeros, without a sign on zero.
pub fn trimmed(value: f64, decimals: usize) -> String {
    let mut text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    }
    if text == "-0" { "0".to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::{JsonNumber, Number, Readable, trimmed};

    #[test]
    fn shortest_round_trip() {
        for value in [0.1, 1.0 / 3.0, 1e300, 5e-324, -2.5, 123_456_789.0, f64::MAX] {
            let text = Number(value).to_string();
            assert_eq!(text.parse(), Ok(value), "{text} reads back");
            assert!(!text.contains(['e', 'E']), "{text} has no exponent");
        }
        assert_eq!(Number(-0.0).to_string(), "0", "zero has no sign");
        assert_eq!(Number(f64::INFINITY).to_string(), "inf", "infinity in tables");
        assert_eq!(JsonNumber(f64::INFINITY).to_string(), "null", "infinity in JSON");
    }

    #[test]
    fn decimals_without_trailing_zeros() {
        assert_eq!(trimmed(1.5, 4), "1.5", "zeros go");
        assert_eq!(trimmed(100.0, 4), "100", "the point goes");
        assert_eq!(trimmed(100.0, 0), "100", "zeros before the point stay");
        assert_eq!(trimmed(-0.000_01, 4), "0", "a rounded zero has no sign");
        assert_eq!(trimmed(12.345_678, 4), "12.3457", "rounded");
    }

    #[test]
    fn readable_numbers() {
        let text = |v| Readable(v).to_string();
        assert_eq!(text(0.0), "0", "zero");
        assert_eq!(text(12.345_67), "12.35", "four digits");
        assert_eq!(text(0.001_234_56), "0.001235", "four digits below one");
        assert_eq!(text(1.5e-9), "1.500e-9", "small");
        assert_eq!(text(f64::INFINITY), "inf", "infinite");
    }
}
