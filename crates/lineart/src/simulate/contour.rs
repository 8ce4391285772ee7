//! Lines of equal value, and the bands between them, of a function that is linear on each triangle.

use std::collections::HashMap;

use feature_sampling::geometry::Point;

use crate::mesh::Mesh;

/// A line of equal value.
#[derive(Clone, Debug, PartialEq)]
pub struct Contour {
    /// The value.
    pub level: f64,
    /// Chains of points; one that closes repeats its first point at its end.
    pub lines: Vec<Vec<Point<f64>>>,
}

/// `count` values that divide a range into `count + 1` equal parts; none where the range is empty.
pub fn levels(least: f64, greatest: f64, count: usize) -> Vec<f64> {
    if greatest.partial_cmp(&least) != Some(std::cmp::Ordering::Greater) {
        return Vec::new();
    }
    (1..=count).map(|i| least + (greatest - least) * (i as f64 / (count + 1) as f64)).collect()
}

/// The line of one value. A vertex at just that value counts as above it.
pub fn contour(mesh: &Mesh, values: &[f64], level: f64) -> Contour {
    // Each crossed edge of a triangle leads to another one: from where the line enters to where it leaves, with what is
    // above on the left.
    let mut next: HashMap<[u32; 2], [u32; 2]> = HashMap::new();
    let mut entries: HashMap<[u32; 2], ()> = HashMap::new();
    let mut order = Vec::new();
    for triangle in &mesh.triangles {
        let above = triangle.map(|v| values[v as usize] >= level);
        let (mut enter, mut leave) = (None, None);
        for i in 0..3 {
            let (from, to) = (triangle[i], triangle[(i + 1) % 3]);
            let edge = [from.min(to), from.max(to)];
            match (above[i], above[(i + 1) % 3]) {
                (true, false) => enter = Some(edge),
                (false, true) => leave = Some(edge),
                _ => {}
            }
        }
        if let Some((enter, leave)) = enter.zip(leave) {
            next.insert(enter, leave);
            entries.insert(leave, ());
            order.push(enter);
        }
    }
    let place = |[a, b]: [u32; 2]| {
        let (p, q) = (mesh.points[a as usize], mesh.points[b as usize]);
        let (u, v) = (values[a as usize], values[b as usize]);
        p.plus_scaled(&((level - u) / (v - u)), &q.minus(&p))
    };
    let mut lines = Vec::new();
    // Open lines first, from where nothing leads to; then what is left are rings.
    let (open, rings): (Vec<_>, Vec<_>) = order.into_iter().partition(|edge| !entries.contains_key(edge));
    for start in open.into_iter().chain(rings) {
        let mut at = start;
        let mut line = vec![place(at)];
        while let Some(to) = next.remove(&at) {
            line.push(place(to));
            at = to;
        }
        if line.len() > 1 {
            lines.push(line);
        }
    }
    Contour { level, lines }
}

/// The parts of a triangle between levels: for each band that it reaches into, its number (0 is below the first level) and
/// a convex polygon.
pub fn bands(corners: [Point<f64>; 3], values: [f64; 3], levels: &[f64]) -> Vec<(usize, Vec<Point<f64>>)> {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let band_of = |value: f64| levels.partition_point(|level| *level <= value);
    let (first, last) = (band_of(least), band_of(greatest));
    let whole: Vec<(Point<f64>, f64)> = corners.into_iter().zip(values).collect();
    if first == last {
        return vec![(first, corners.to_vec())];
    }
    let mut out = Vec::new();
    for band in first..=last {
        let mut polygon = whole.clone();
        if let Some(&low) = band.checked_sub(1).and_then(|i| levels.get(i)) {
            polygon = clip(&polygon, |value| value - low);
        }
        if let Some(&high) = levels.get(band) {
            polygon = clip(&polygon, |value| high - value);
        }
        if polygon.len() > 2 {
            out.push((band, polygon.into_iter().map(|(p, _)| p).collect()));
        }
    }
    out
}

/// What of a convex polygon has a value that `inside` does not make negative.
fn clip(polygon: &[(Point<f64>, f64)], inside: impl Fn(f64) -> f64) -> Vec<(Point<f64>, f64)> {
    let mut out = Vec::with_capacity(polygon.len() + 1);
    for (&(p, u), &(q, v)) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let (a, b) = (inside(u), inside(v));
        if a >= 0.0 {
            out.push((p, u));
        }
        if (a >= 0.0) != (b >= 0.0) {
            let share = a / (a - b);
            out.push((p.plus_scaled(&share, &q.minus(&p)), u + share * (v - u)));
        }
    }
    out
}
