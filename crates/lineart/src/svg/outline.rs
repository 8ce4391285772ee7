//! A pen that turns drawing commands into subpaths of cubics in root user units.
//!
//! Commands come in the user space of their element; every point is transformed as it arrives. Lines and quadratics
//! are raised to cubics *after* the transform, so that their control points are exactly where the kernel's own
//! constructors put them (a third of the way in root space, not the image of a rounded third).
//!
//! The rules of subpaths live here. A move starts a subpath; after a close, drawing goes on from the closed point in
//! a new subpath even with no move; a subpath that draws nothing leaves no trace. Closing adds a straight line where
//! the end differs from the start, however little: dropping segments that are too short to matter is the business of
//! whoever knows the size of the drawing.

use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::Point;

use super::arc::{self, ArcShape};
use super::transform::Affine;

/// One finished subpath.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Subpath {
    pub(super) closed: bool,
    pub(super) cubics: Vec<Cubic<f64>>,
}

/// Why the drawn outline cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PenError {
    /// A coordinate is not finite or too large; holds the number of the drawing command, from 1.
    OutOfRange(usize),
    /// More than [`super::MAX_CUBICS`] cubics. Those beyond were not kept, so that a file cannot fill the memory.
    TooMany,
}

/// The pen.
#[derive(Debug)]
pub(super) struct Outline<'a> {
    to_root: &'a Affine,
    /// First point of the current subpath, in the element's user space.
    start: (f64, f64),
    /// Where the pen is, in the element's user space.
    here: (f64, f64),
    cubics: Vec<Cubic<f64>>,
    done: Vec<Subpath>,
    /// Drawing commands so far.
    segments: usize,
    /// How many cubics were kept.
    kept: usize,
    /// The first thing that went wrong.
    error: Option<PenError>,
}

impl<'a> Outline<'a> {
    pub(super) fn new(to_root: &'a Affine) -> Self {
        Self {
            to_root,
            start: (0.0, 0.0),
            here: (0.0, 0.0),
            cubics: Vec::new(),
            done: Vec::new(),
            segments: 0,
            kept: 0,
            error: None,
        }
    }

    /// Where the pen is, in the element's user space.
    pub(super) fn here(&self) -> (f64, f64) {
        self.here
    }

    pub(super) fn move_to(&mut self, to: (f64, f64)) {
        self.end_subpath(false);
        self.start = to;
        self.here = to;
    }

    pub(super) fn line_to(&mut self, to: (f64, f64)) {
        let (a, b) = (self.image(self.here), self.image(to));
        self.push(Cubic::line(a, b), to);
    }

    pub(super) fn quadratic_to(&mut self, control: (f64, f64), to: (f64, f64)) {
        let (a, c, b) = (self.image(self.here), self.image(control), self.image(to));
        self.push(Cubic::quadratic(a, &c, b), to);
    }

    pub(super) fn cubic_to(&mut self, control1: (f64, f64), control2: (f64, f64), to: (f64, f64)) {
        let cubic = Cubic::new(self.image(self.here), self.image(control1), self.image(control2), self.image(to));
        self.push(cubic, to);
    }

    /// An elliptical arc; nothing where it ends at its start, a line where a radius is 0.
    pub(super) fn arc_to(&mut self, shape: &ArcShape, to: (f64, f64)) {
        let from = self.here;
        if from == to {
            return;
        }
        let before = self.segments;
        if !arc::arc_to(from, to, shape, |p, q, r| self.cubic_to(p, q, r)) {
            self.line_to(to);
        }
        self.segments = before + 1; // One command, however many pieces.
    }

    /// Closes the subpath, with a straight line where its ends differ.
    pub(super) fn close(&mut self) {
        if let (Some(first), Some(last)) = (self.cubics.first(), self.cubics.last())
            && first.start() != last.end()
        {
            self.line_to(self.start);
        }
        self.here = self.start;
        self.end_subpath(true);
    }

    /// The subpaths, or the first thing that went wrong.
    pub(super) fn finish(mut self) -> Result<Vec<Subpath>, PenError> {
        self.end_subpath(false);
        match self.error {
            None => Ok(self.done),
            Some(error) => Err(error),
        }
    }

    fn image(&self, (x, y): (f64, f64)) -> Point<f64> {
        let (x, y) = self.to_root.apply(x, y);
        Point::new(x, y)
    }

    fn push(&mut self, cubic: Cubic<f64>, to: (f64, f64)) {
        self.segments += 1;
        let fits = |v: f64| v.abs() <= super::MAX_COORDINATE; // False for NaN.
        if !cubic.points.iter().all(|p| fits(p.x) && fits(p.y)) {
            self.error = self.error.or(Some(PenError::OutOfRange(self.segments)));
        }
        if self.kept < super::MAX_CUBICS {
            self.kept += 1;
            self.cubics.push(cubic);
        } else {
            self.error = self.error.or(Some(PenError::TooMany));
        }
        self.here = to;
    }

    fn end_subpath(&mut self, closed: bool) {
        if !self.cubics.is_empty() {
            self.done.push(Subpath { closed, cubics: std::mem::take(&mut self.cubics) });
        }
    }
}
