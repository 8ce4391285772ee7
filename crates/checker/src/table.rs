//! The two tables that the binary reads: control points, and samples. Both are plain CSV with an optional header.

use crate::condition::Sample;
use crate::door::RawPath;
use crate::plane::v2;

/// Rows of numbers; rows whose first field is not one (headers, comments) are left out. Lines count from 1.
fn rows(text: &str) -> Result<Vec<(usize, Vec<f64>)>, String> {
    let mut out = Vec::new();
    for (i, line) in text.lines().enumerate() {
        let fields: Vec<&str> = line.split(',').map(str::trim).collect();
        if fields[0].parse::<f64>().is_err() {
            continue;
        }
        // Trailing columns may hold words (the bound that decided a sample).
        let numbers: Vec<f64> = fields.iter().map_while(|f| f.parse().ok()).collect();
        out.push((i + 1, numbers));
    }
    if out.is_empty() { Err("no rows".into()) } else { Ok(out) }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked to be a small whole number")]
fn index(x: f64, line: usize) -> Result<usize, String> {
    if (0.0..1e9).contains(&x) && x.fract() == 0.0 {
        Ok(x as usize)
    } else {
        Err(format!("line {line}: {x} is not an index"))
    }
}

/// Paths from `path,closed,x0,y0,…,x3,y3`, one cubic per line.
///
/// # Errors
/// A message that names the line.
pub fn drawing(text: &str) -> Result<Vec<RawPath>, String> {
    let mut out: Vec<RawPath> = Vec::new();
    for (line, v) in rows(text)? {
        if v.len() < 10 {
            return Err(format!("line {line}: ten columns wanted"));
        }
        let path = index(v[0], line)?;
        if path > out.len() {
            return Err(format!("line {line}: paths must come in order"));
        }
        if path == out.len() {
            out.push(RawPath::default());
        }
        out[path].closed = v[1] != 0.0;
        out[path].cubics.push([[v[2], v[3]], [v[4], v[5]], [v[6], v[7]], [v[8], v[9]]]);
    }
    Ok(out)
}

/// Samples from `path,segment,t,x,y,…`.
///
/// # Errors
/// A message that names the line.
pub fn samples(text: &str) -> Result<Vec<Sample>, String> {
    let mut out = Vec::new();
    for (line, v) in rows(text)? {
        if v.len() < 5 {
            return Err(format!("line {line}: path,segment,t,x,y wanted"));
        }
        out.push(Sample { path: index(v[0], line)?, segment: index(v[1], line)?, t: v[2], point: v2(v[3], v[4]) });
    }
    Ok(out)
}
