//! The independent judge of local feature size and of ε-samples.
//!
//! A sampler that computes lfs wrongly also believes its samples to be right. This crate therefore computes everything
//! again, from the control points on, by other means and without speed in mind: it shares no code with the kernel, not
//! even its vectors. One concept, one file, in the order of use:
//!
//! | file | question |
//! |---|---|
//! | [`door`] | what is the curve C that a raw drawing stands for? |
//! | [`curve`] | where is B(t), and within what disc does a piece stay? |
//! | `disk` | how large is the largest empty disk that touches C at f in direction d? |
//! | `foot` | where is the medial axis? |
//! | `lfs` | how far is it from p? |
//! | `contact` | where does lfs vanish? |
//! | [`condition`] | is a set of samples an ε-sample? |
//! | `delaunay` | are consecutive samples Delaunay neighbours? |
//! | [`table`] | what do the CSV files say? |
//!
//! Start with [`Checker`].

pub mod condition;
mod contact;
pub mod curve;
mod delaunay;
mod disk;
pub mod door;
mod foot;
mod lfs;
pub mod plane;
pub mod table;
mod tree;

pub use condition::{Options, Report, Sample, Violation};
pub use door::{DoorOptions, RawPath};
pub use lfs::Feature;
pub use plane::V2;

use contact::Contact;

/// The judge of one drawing.
pub struct Checker {
    evaluator: lfs::Evaluator,
    contacts: Vec<Contact>,
}

impl Checker {
    /// Cleans the paths and computes their medial axis densely.
    pub fn new(paths: &[RawPath]) -> Checker {
        Checker::with_options(paths, &DoorOptions::default())
    }

    /// The same with other rules at the door.
    pub fn with_options(paths: &[RawPath], options: &DoorOptions) -> Checker {
        let drawing = door::Drawing::new(paths, options);
        let contacts = contact::contacts(&drawing);
        let special: Vec<V2> = contacts.iter().map(|c| c.at).collect();
        Checker { evaluator: lfs::Evaluator::new(disk::Scene::new(drawing), &special), contacts }
    }

    /// lfs at a parameter of a raw segment (one past the last for an added closing line). Infinite without medial axis.
    pub fn lfs(&self, path: usize, segment: usize, t: f64) -> f64 {
        self.feature_at(self.point(path, segment, t)).lfs
    }

    /// lfs and the nearest medial point of any point of the plane.
    pub fn feature_at(&self, p: V2) -> Feature {
        self.evaluator.fine(p)
    }

    /// The radius of the largest empty tangent disk on the left (direction (−y′, x′)) or right of a path.
    pub fn radius(&self, path: usize, segment: usize, t: f64, left: bool) -> f64 {
        self.evaluator.radius(self.place(path, segment, t), left)
    }

    /// The point of C at a parameter of a raw segment.
    pub fn point(&self, path: usize, segment: usize, t: f64) -> V2 {
        let (cubic, t, _) = self.place(path, segment, t);
        self.evaluator.scene.drawing.cubics[cubic].at(t)
    }

    fn place(&self, path: usize, segment: usize, t: f64) -> (usize, f64, bool) {
        condition::place(&self.evaluator.scene.drawing, path, segment, t)
    }

    /// Raw segment, parameter and distance of the point of a path nearest to p.
    pub fn project(&self, path: usize, p: V2) -> Option<(usize, f64, f64)> {
        let drawing = &self.evaluator.scene.drawing;
        let on = |piece: &door::Piece| {
            let (t, d) = drawing.cubics[piece.cubic].project(p);
            (piece.segment, if piece.reversed { 1.0 - t } else { t }, d)
        };
        drawing.paths[path].pieces.iter().map(on).min_by(|a, b| a.2.total_cmp(&b.2))
    }

    /// Judges samples, in any order, against ε.
    pub fn check(&self, samples: &[Sample], epsilon: f64, options: Options) -> Report {
        condition::judge(&self.evaluator, &self.contacts, samples, epsilon, options)
    }

    /// Diagonal of the box of all control points.
    pub fn diagonal(&self) -> f64 {
        self.evaluator.scene.drawing.diagonal
    }

    /// The most that smoothing of joints moved the curve.
    pub fn displacement(&self) -> f64 {
        self.evaluator.scene.drawing.displacement
    }

    /// Corners, crossings, T-junctions, cusps and retracted handles.
    pub fn contacts(&self) -> Vec<V2> {
        self.contacts.iter().map(|c| c.at).collect()
    }

    /// Number of disks that the dense medial axis took.
    pub fn feet(&self) -> usize {
        self.evaluator.medial.feet
    }
}
