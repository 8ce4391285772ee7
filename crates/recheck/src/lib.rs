//! Certificates of ε-samples, re-checked.
//!
//! A certificate says that given points are an ε-sample of a drawing, or that they are not, and carries what is needed to see
//! it. This crate reads one and evaluates it, claim by claim, in interval arithmetic. It shares with the prover
//! (`feature_sampling::certificate`) the curve C\*, the numbers and the theorem that the foot set is complete, and nothing
//! else: no search, no bound and no form of the prover is used, and none of the numbers that it wrote is believed.
//!
//! **What is in it.** A forest of *cells* covers the foot set. A cell may claim that all tangent disks of one radius at its feet
//! are empty ([`Node::lower`]), and name a point of C that its disks cannot hold ([`Node::upper`]); halves inherit what their
//! cell claims. *Pieces* cover C. A piece claims a lower bound of lfs, and names a sample that is nearer than ε times that. It
//! names no cells: the forest is searched from its roots for cells that could come nearer, each one is discharged or divided, and
//! where one is neither the certificate is rejected. Each claim about a radius is evaluated when it is first needed, once.
//!
//! **What is checked.** The cells cover the foot set and the pieces cover C, to the bit; every radius that is relied on; for every
//! piece, the distance of its sample, the place of that sample along the path where a floor serves, and lfs; for every
//! neighbourhood, that lfs is small on all of it; samples lie where they say. **What is believed**: that C\* is the curve in
//! question (its hash is compared), the roundings of IEEE 754, and this crate.
//!
//! The mathematics is in `docs/certificates.md`, with a remark on each step in floating point. Time is linear in the number of
//! claims, times the logarithm of the number of stretches that C consists of.

mod bernstein;
mod check;
mod cover;
mod empty;
mod feet;
mod json;
mod made;
mod scene;

pub use check::{Proved, Rejection, check, trim};
pub use feet::Span;
pub use made::certificate;

use feature_sampling::curve::Curve;

/// Floor on stretches around places where lfs is nearly zero, as a share of the diagonal.
pub const SINGULAR_FLOOR: f64 = 1e-3;

/// Floor everywhere, as a share of the diagonal; a place where lfs is at most this is one to have a neighbourhood.
pub const FLOOR: f64 = 1e-7;

/// A point of C, by segment and parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Segment of C.
    pub segment: u32,
    /// Parameter from 0 to 1.
    pub t: f64,
}

/// A sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleClaim {
    /// Where it is along its path.
    pub at: Place,
    /// The point, to the last bit.
    pub x: f64,
    /// Its other coordinate.
    pub y: f64,
}

/// Why radii have an upper bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Upper {
    /// This point of C is in no empty disk.
    Point(Place),
    /// No empty disk is larger than the osculating one.
    Curvature,
}

/// A cell of the foot set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Its halves follow.
    pub split: bool,
    /// All tangent disks of this radius at its feet are empty; 0 claims nothing.
    pub lower: f64,
    /// A bound of the radii from above.
    pub upper: Option<Upper>,
}

/// A stretch of the foot set and its subdivision: cells in preorder.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    /// The feet of the first cell.
    pub feet: Span,
    /// All cells.
    pub nodes: Vec<Node>,
}

/// Why a piece of C is well sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Why {
    /// lfs is at least this on all of it.
    Feature(f64),
    /// Its sample is a neighbour along the path, nearer than the floor that holds everywhere.
    Floor,
    /// Its sample is a neighbour along the path, nearer than the floor of this neighbourhood.
    Neighbourhood(u32),
    /// It is not known.
    Unknown,
}

/// A piece of C.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PieceClaim {
    /// Segment of C.
    pub segment: u32,
    /// First parameter.
    pub from: f64,
    /// Last parameter.
    pub to: f64,
    /// The sample that is near enough.
    pub sample: u32,
    /// Why it is.
    pub why: Why,
}

/// A foot with an upper bound of its radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FootClaim {
    /// Where it is.
    pub at: Place,
    /// On the left.
    pub left: bool,
    /// Why its radius is bounded.
    pub upper: Upper,
}

/// A stretch of a neighbourhood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Segment of C.
    pub segment: u32,
    /// First parameter.
    pub from: f64,
    /// Last parameter.
    pub to: f64,
    /// lfs is small there since the medial point of this foot is near; without one, since the place is.
    pub foot: Option<FootClaim>,
}

/// A stretch of a path around a place where lfs is nearly zero, on all of which it is small.
#[derive(Clone, Debug, PartialEq)]
pub struct NeighbourhoodClaim {
    /// A foot whose medial point is no farther than [`FLOOR`] says.
    pub place: FootClaim,
    /// Stretches that follow each other along the path, and hold the place.
    pub steps: Vec<Step>,
}

/// A point where the condition fails.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WitnessClaim {
    /// The point of C.
    pub at: Place,
    /// Every sample is at least so far away,
    pub distance: f64,
    /// and its lfs is at most this,
    pub lfs: f64,
    /// since the medial points of these feet are that near:
    pub feet: Span,
    /// all their tangent disks of this radius are empty,
    pub lower: f64,
    /// and larger ones are not.
    pub upper: Upper,
}

/// What is claimed of the drawing and the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Claimed {
    /// An ε-sample.
    Proved,
    /// None, for this reason.
    Refuted(WitnessClaim),
    /// Nothing.
    Unknown,
}

/// A certificate.
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// Which curve it speaks of: [`hash`].
    pub curve: u64,
    /// Joints that turn by less are smooth in it, in degrees.
    pub corner_angle: f64,
    /// ε.
    pub epsilon: f64,
    /// The floor of the user, a length, which takes the place of both floors.
    pub min_distance: Option<f64>,
    /// The answer.
    pub claimed: Claimed,
    /// All samples, by path, segment and parameter.
    pub samples: Vec<SampleClaim>,
    /// Pieces of C, by segment and parameter.
    pub pieces: Vec<PieceClaim>,
    /// Where lfs is small.
    pub neighbourhoods: Vec<NeighbourhoodClaim>,
    /// The foot set.
    pub trees: Vec<Tree>,
}

/// A number that tells curves apart (FNV-1a over all control points and the lengths of the paths). It guards against mistaking
/// one drawing for another, not against deceit: every claim is evaluated on the curve that is there.
pub fn hash(curve: &Curve<'_, f64>) -> u64 {
    let mut state = 0xcbf2_9ce4_8422_2325_u64;
    let mut eat = |v: u64| {
        for byte in v.to_le_bytes() {
            state = (state ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    for path in curve.paths {
        eat(u64::from(path.count) << 1 | u64::from(path.closed));
    }
    for segment in curve.segments {
        for p in &segment.cubic.points {
            eat(p.x.to_bits());
            eat(p.y.to_bits());
        }
    }
    state
}
