//! Numbers on their way in: decimal, or hexadecimal as C99 writes it (`0x1.8p-3`).
//!
//! Hexadecimal is how programs hand doubles to each other without a thought about digits: `%a` in C, `float.hex()` in
//! Python. The form is an optional sign, `0x`, hexadecimal digits with an optional point among them, and an optional `p` with
//! a decimal power of two. More digits than a double holds are rounded to the nearest, ties to even, as C does.

/// A finite double, or why it is none.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    let is_hexadecimal = unsigned.starts_with("0x") || unsigned.starts_with("0X");
    let value = if is_hexadecimal {
        unsigned.get(2..).and_then(hexadecimal).map(|v| if text.starts_with('-') { -v } else { v })
    } else {
        text.parse::<f64>().ok()
    };
    match value {
        Some(value) if value.is_finite() => Ok(value),
        Some(_) => Err(format!("“{text}” is not a finite double")),
        None => Err(format!("“{text}” is not a number")),
    }
}

/// What follows `0x`.
fn hexadecimal(text: &str) -> Option<f64> {
    let (digits, power) = match text.split_once(['p', 'P']) {
        Some((digits, power)) => (digits, exponent(power)?),
        None => (text, 0),
    };
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    if whole.is_empty() && fraction.is_empty() {
        return None;
    }
    // Up to 61 bits are kept; of what comes after them only matters whether it is zero.
    let (mut significand, mut exponent, mut rest) = (0_u64, power, false);
    let all = whole.chars().map(|digit| (digit, false)).chain(fraction.chars().map(|digit| (digit, true)));
    for (digit, after_point) in all {
        let digit = u64::from(digit.to_digit(16)?);
        if significand >> 57 == 0 {
            significand = significand << 4 | digit;
            exponent -= i64::from(after_point) * 4;
        } else {
            rest |= digit != 0;
            exponent += i64::from(!after_point) * 4;
        }
    }
    Some(rounded(significand, rest, exponent))
}

/// A decimal exponent; one beyond all doubles is cut, since it makes no difference.
fn exponent(text: &str) -> Option<i64> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let size = digits.bytes().fold(0_i64, |n, digit| (n * 10 + i64::from(digit - b'0')).min(1 << 40));
    Some(if text.starts_with('-') { -size } else { size })
}

/// The double nearest to (significand + something below 1 if `rest`) · 2^exponent, ties to even.
fn rounded(significand: u64, rest: bool, exponent: i64) -> f64 {
    let bits = i64::from(u64::BITS - significand.leading_zeros());
    if bits == 0 {
        return 0.0;
    }
    if bits + exponent > 1024 {
        return f64::INFINITY;
    }
    // Bits below the last one that a double of this size has.
    let drop = (bits - 53).max(-1074 - exponent);
    let (mut kept, mut exponent) = (significand, exponent);
    if drop > 0 {
        let drop = drop.min(64);
        let shift = u32::try_from(drop).unwrap_or(64);
        kept = significand.checked_shr(shift).unwrap_or(0);
        let below = significand - kept.checked_shl(shift).unwrap_or(0);
        let half = 1_u64 << (shift - 1);
        let up = below > half || below == half && (rest || kept & 1 == 1);
        kept += u64::from(up);
        exponent += drop;
    }
    if kept == 0 {
        return 0.0;
    }
    #[allow(clippy::cast_precision_loss, reason = "at most 2⁵³")]
    let mut value = kept as f64;
    // The result is a double, or one power of two above the largest: no step rounds.
    while exponent != 0 {
        let step = exponent.clamp(-500, 500);
        value *= 2.0_f64.powi(i32::try_from(step).unwrap_or(0));
        exponent -= step;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimal_and_hexadecimal() {
        for (text, value) in [
            ("1", 1.0),
            ("-2.5e-3", -2.5e-3),
            ("+4", 4.0),
            ("0x1p0", 1.0),
            ("0x1.8p-3", 0.1875),
            ("-0X.8P+1", -1.0),
            ("0x10", 16.0),
            ("0x1.999999999999ap-4", 0.1),
            ("0x1.fffffffffffffp+1023", f64::MAX),
            ("0x0.0000000000001p-1022", 5e-324),
            ("0x1p-1074", 5e-324),
            ("0x1p-1022", f64::MIN_POSITIVE),
            ("0x.00000000000000000000000000001p+100", 2.0_f64.powi(-16)),
            ("0x100000000000000000000000000000p-100", 2.0_f64.powi(16)),
            ("0x0p99999999999999999999", 0.0),
            ("0x1p-99999999999999999999", 0.0),
        ] {
            assert_eq!(number(text), Ok(value), "{text}");
        }
        assert!(number("-0x0p0").is_ok_and(|v| v == 0.0 && v.is_sign_negative()), "minus zero");
    }

    #[test]
    fn digits_beyond_a_double_are_rounded_to_even() {
        let ulp = 2.0_f64.powi(-52);
        for (text, value) in [
            ("0x1.00000000000008p0", 1.0),
            ("0x1.000000000000080000000000000000001p0", 1.0 + ulp),
            ("0x1.00000000000018p0", 1.0 + 2.0 * ulp),
            ("0x1.000000000000179p0", 1.0 + ulp),
            ("0x0.8p-1074", 0.0),
            ("0x0.81p-1074", 5e-324),
            ("0x1.8p-1074", 1e-323),
            ("0x1.4p-1074", 5e-324),
        ] {
            assert_eq!(number(text), Ok(value), "{text}");
        }
    }

    #[test]
    fn what_is_no_number() {
        for text in
            ["", "x", "0x", "0x.", "0xp1", "0x1p", "0x1p+", "0x1p1.5", "0x1.2.3", "0xg", "1e", "--1", "0x-1", "é"]
        {
            assert!(number(text).is_err_and(|e| e.contains("is not a number")), "{text}");
        }
        for text in ["inf", "-inf", "nan", "1e999", "0x1p1024", "0x1.fffffffffffff8p1023"] {
            assert!(number(text).is_err_and(|e| e.contains("finite")), "{text}");
        }
    }

    #[test]
    fn every_size_of_double_comes_back() {
        let mut seed = 1_u64;
        for _ in 0..100_000 {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let value = f64::from_bits(seed);
            if !value.is_finite() {
                continue;
            }
            let bits = value.abs().to_bits();
            let (biased, fraction) = (bits >> 52, bits & ((1 << 52) - 1));
            let (lead, power) =
                if biased == 0 { (0, -1022) } else { (1, i64::try_from(biased).expect("small") - 1023) };
            let sign = if value < 0.0 { "-" } else { "" };
            let text = format!("{sign}0x{lead}.{fraction:013x}p{power}");
            assert_eq!(number(&text), Ok(value), "{text}");
        }
    }
}
