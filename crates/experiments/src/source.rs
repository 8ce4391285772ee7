//! The curves that an experiment is about.

use std::fmt::Write;

use feature_sampling::bezier::Cubic;
use feature_sampling::curve::door::{DoorOptions, sine_of_degrees};
use feature_sampling::geometry::Point;
use feature_sampling::model::CurveModel;
use feature_sampling::scalar::Scalar;
use lineart::drawing::Drawing;

use crate::ExperimentError;

/// A curve with the name that tables give it.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// The name: that of the file without folder and extension.
    pub name: String,
    /// It came with the program; the paper does not use it.
    pub shipped: bool,
    /// Paths: closed or not, and their cubics.
    pub paths: Vec<(bool, Vec<Cubic<f64>>)>,
}

impl Source {
    /// The curves of a drawing.
    pub fn new(drawing: &Drawing, shipped: bool) -> Self {
        let name = table_name(&drawing.source);
        Self { name, shipped, paths: drawing.paths.iter().map(|path| (path.closed, path.cubics.clone())).collect() }
    }

    /// Number of cubics as drawn.
    pub fn cubics(&self) -> usize {
        self.paths.iter().map(|(_, cubics)| cubics.len()).sum()
    }

    /// The longest diagonal of a cubic's control polygon: the largest distance between two of the four control points of
    /// one cubic. Table 1 measures in it.
    pub fn hull_diagonal(&self) -> f64 {
        let mut longest = 0.0_f64;
        for cubic in self.paths.iter().flat_map(|(_, cubics)| cubics) {
            for (i, a) in cubic.points.iter().enumerate() {
                for b in &cubic.points[i + 1..] {
                    longest = longest.max(a.distance(b));
                }
            }
        }
        longest
    }

    /// The curve in a scalar: coordinates are rounded to it, then taken through the door.
    ///
    /// # Errors
    /// Names the curve and what the door has against it.
    pub fn model<S: Scalar>(&self, corner_degrees: f64) -> Result<CurveModel<S>, ExperimentError> {
        let rounded = |c: &Cubic<f64>| Cubic { points: c.points.map(|p| Point::from_f64(p.x, p.y)) };
        let paths: Vec<(bool, Vec<Cubic<S>>)> =
            self.paths.iter().map(|(closed, cubics)| (*closed, cubics.iter().map(rounded).collect())).collect();
        let borrowed: Vec<(bool, &[Cubic<S>])> = paths.iter().map(|(closed, cubics)| (*closed, &cubics[..])).collect();
        let corner_sine = sine_of_degrees(&S::from_f64(corner_degrees));
        CurveModel::new(&borrowed, &DoorOptions { corner_sine, ..DoorOptions::default() })
            .map_err(|error| ExperimentError::new(format!("{}: {error}", self.name)))
    }

    /// Name and content in one word: the same for the same control points, to the bit, and for hardly any others.
    pub fn fingerprint(&self) -> String {
        let bytes = self.paths.iter().flat_map(|(closed, cubics)| {
            let coordinates = cubics.iter().flat_map(|c| &c.points).flat_map(|p| [p.x, p.y]);
            [u8::from(*closed), 0xff].into_iter().chain(coordinates.flat_map(|v| v.to_bits().to_le_bytes()))
        });
        let hash = fnv(bytes);
        let mut word = self.name.clone();
        // Writing to a string cannot fail.
        let _ = write!(word, "#{hash:016x}");
        word
    }
}

/// FNV-1a, 64 bits (Fowler, Noll and Vo): good enough to notice a mix-up.
pub(crate) fn fnv(bytes: impl Iterator<Item = u8>) -> u64 {
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

/// The name that tables give to what is in a file: without folder and extension, and without separators of tables.
pub(crate) fn table_name(file: &str) -> String {
    let stem = std::path::Path::new(file).file_stem();
    let name = stem.map_or_else(|| file.to_owned(), |stem| stem.to_string_lossy().into_owned());
    name.replace([',', '|', '\n', '\r', '"', '='], "_")
}
