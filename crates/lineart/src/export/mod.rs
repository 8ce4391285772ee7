//! Results on their way out: CSV, JSON, PLY, SVG and G-code; meshes in the formats of [`mesh`].
//!
//! A writer here takes *rows* (plain numbers and names, one struct per kind of table) and not the kernel's own types,
//! so that results computed in any scalar leave through the same door, and so that the columns of a file are written
//! down in one place. Rows are grouped by path ([`PathRows`]), in document order, because every format needs to know
//! where a path begins, where it ends and whether it closes.
//!
//! Kept by all writers:
//!
//! * Numbers are in shortest round-trip form ([`number`]): reading one back gives the same double, to the bit. The one
//!   exception is G-code, whose readers are firmware: four decimals of a millimetre.
//! * Nothing depends on the clock, the machine or the order of a hash map: the same rows give the same bytes.
//! * Writers only speak to [`std::io::Write`]; files are made by [`atomic`], which never leaves half of one behind.

pub mod atomic;
pub mod csv;
pub mod edges;
pub mod gcode;
pub mod json;
pub mod mesh;
pub mod number;
mod palette;
pub mod ply;
pub mod svg;

use feature_sampling::geometry::Aabb;

use crate::drawing::Drawing;

/// One sample: a row of the samples table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleRow {
    /// Subpath in document order, from 0.
    pub path: u32,
    /// Cubic of that path, from 0.
    pub segment: u32,
    /// Parameter on that cubic, in [0, 1].
    pub t: f64,
    /// The point, in user units.
    pub x: f64,
    /// The point, in user units, y downwards.
    pub y: f64,
    /// Local feature size at the point, in user units; infinite where the drawing has no medial axis.
    pub lfs: f64,
    /// Which bound decided this sample: start, epsilon, chord, min, max, grading, floor, end or corner.
    pub bound: &'static str,
}

/// One foot point with its medial point on one side: a row of the medial table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MedialRow {
    /// Subpath in document order, from 0.
    pub path: u32,
    /// Cubic of that path, from 0.
    pub segment: u32,
    /// Parameter of the foot point on that cubic.
    pub t: f64,
    /// The foot point.
    pub x: f64,
    /// The foot point.
    pub y: f64,
    /// left (direction (−B'y, B'x)), right, fan or corner.
    pub side: &'static str,
    /// The medial point.
    pub mx: f64,
    /// The medial point.
    pub my: f64,
    /// Distance from the foot point to the medial point.
    pub radius: f64,
    /// Which medial polyline the point belongs to, from 0; rows of one polyline follow each other.
    pub polyline: u32,
}

/// The local feature size at one point: a row of the lfs table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LfsRow {
    /// Subpath in document order, from 0.
    pub path: u32,
    /// Cubic of that path, from 0.
    pub segment: u32,
    /// Parameter on that cubic.
    pub t: f64,
    /// The point asked about.
    pub x: f64,
    /// The point asked about.
    pub y: f64,
    /// Its distance to the medial axis, in user units; infinite where there is none.
    pub lfs: f64,
    /// What it was proved to be at least and at most.
    pub bounds: Option<[f64; 2]>,
}

/// The rows of one path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathRows<R> {
    /// The last row is followed by the first.
    pub closed: bool,
    /// Rows in the order of the path.
    pub rows: Vec<R>,
}

impl<R> PathRows<R> {
    /// Neighbouring rows, with the closing pair of a closed path of three rows or more (two rows have one edge).
    pub fn edges(&self) -> impl Iterator<Item = (&R, &R)> {
        let closing = (self.closed && self.rows.len() > 2).then(|| self.rows.last().zip(self.rows.first())).flatten();
        self.rows.iter().zip(self.rows.iter().skip(1)).chain(closing)
    }
}

/// What a result says about itself besides its rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Header {
    /// Name of the drawing, `-` for standard input.
    pub source: String,
    /// The options that decide the result, by their names on the command line; lengths in user units.
    pub options: Vec<(&'static str, OptionValue)>,
    /// Diagonal of the bounding box of the control points, in user units.
    pub diagonal: f64,
}

/// The value of an option in a [`Header`].
#[derive(Clone, Debug, PartialEq)]
pub enum OptionValue {
    /// A number; lengths in user units.
    Number(f64),
    /// A name.
    Text(String),
}

/// The bounding box of all control points of a drawing.
pub fn control_box(drawing: &Drawing) -> Aabb<f64> {
    let mut all = Aabb::empty();
    for cubic in drawing.paths.iter().flat_map(|path| &path.cubics) {
        all.merge(&cubic.control_box());
    }
    all
}

/// The frame a picture of the drawing is shown in: its `viewBox`, or else the box of its control points with a margin
/// of 5 % of the diagonal. x, y, width, height.
pub fn frame(drawing: &Drawing) -> [f64; 4] {
    drawing.view_box.unwrap_or_else(|| {
        let all = control_box(drawing);
        let extent = all.extent();
        let margin = 0.05 * extent.norm();
        [all.min.x - margin, all.min.y - margin, extent.x + 2.0 * margin, extent.y + 2.0 * margin]
    })
}

#[cfg(test)]
mod tests {
    use super::PathRows;

    #[test]
    fn edges_close_where_the_path_does() {
        let edges = |closed, n: i32| {
            let path = PathRows { closed, rows: (0..n).collect() };
            path.edges().map(|(a, b)| (*a, *b)).collect::<Vec<_>>()
        };
        assert_eq!(edges(false, 3), [(0, 1), (1, 2)], "an open path has one edge less than points");
        assert_eq!(edges(true, 3), [(0, 1), (1, 2), (2, 0)], "a closed path returns");
        assert_eq!(edges(true, 2), [(0, 1)], "two points have one edge, closed or not");
        assert!(edges(true, 1).is_empty(), "one point has none");
        assert!(edges(true, 0).is_empty(), "nothing has none");
    }
}
