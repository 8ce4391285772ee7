//! Certificates: a proof that a set of points is an ε-sample, or a point where it is none.
//!
//! S is an ε-sample of C if every p ∈ C has an s ∈ S with |p−s| < ε·lfs(p); where lfs falls to 0 the floored condition stands in
//! (`docs/mathematics.md`, section 1). [`condition::judge`] decides this for all points of C at once: it covers C by
//! [`Piece`]s and finds for each a proof in the band around the medial axis ([`crate::lfs::bound`]), in interval arithmetic.
//! The answer is a [`Verdict`]:
//!
//! * **Proved**: every piece has its proof. Needs only that the band contains M;
//! * **Refuted**: a [`Witness`] p with |p−s| ≥ ε·lfs(p) for all samples s. Needs that the band is not larger than M;
//! * **Unknown**: the pieces that are left when the budget is used up, or when they are smaller than a set share of what is
//!   to be proved about them.
//!
//! Proofs speak of C\* ([`crate::curve::ideal`]) and of samples as they are given, to the last bit. What they do not speak of
//! is what the door did before: it is listed in [`crate::curve::door::DoorReport`].

pub mod condition;
pub mod effective;
pub mod singular;

use crate::curve::CurveParam;
use crate::geometry::Point;
use crate::medial::Side;
use crate::scalar::Scalar;

/// A sample: where it is on C, and the point that stands for it.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Placed<S> {
    /// Its path in C.
    pub path: u32,
    /// Its place on C.
    pub at: CurveParam<S>,
    /// The point: what distances are measured to.
    pub point: Point<S>,
}

/// What is to be proved, and how much work may be spent.
#[derive(Clone, Debug)]
pub struct Claim<S> {
    /// ε.
    pub epsilon: S,
    /// The floor everywhere; without it the two shares below hold.
    pub min_distance: Option<S>,
    /// Floor on stretches around singular points, as a share of the diagonal (1e-3).
    pub singular_floor: S,
    /// Floor elsewhere, as a share of the diagonal (1e-7).
    pub floor: S,
    /// Largest number of pieces.
    pub pieces: usize,
    /// Largest number of cells made for one gap between samples: one hard place shall not spend what others need.
    pub gap_cells: usize,
    /// Largest number of times that a piece and a cell are compared.
    pub work: u64,
    /// A piece smaller than this share of the lfs that it needs is left unknown (2^−10).
    pub finest: S,
    /// As soon as one piece of a gap between samples is left unknown, so is all of the gap behind it: for those who add a sample then,
    /// and do not want to know more (no).
    pub give_up: bool,
}

impl<S: Scalar> Claim<S> {
    /// The claim that a set is an ε-sample, with the default floors and limits.
    pub fn new(epsilon: S) -> Self {
        Self {
            epsilon,
            min_distance: None,
            singular_floor: S::one() / &S::int(1000),
            floor: S::one() / &S::int(10_000_000),
            pieces: 4_000_000,
            gap_cells: 10_000,
            work: 1_000_000_000,
            finest: S::one().mul_pow2(-10),
            give_up: false,
        }
    }
}

/// The answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict<S> {
    /// The condition holds at every point of C.
    Proved,
    /// It fails at this point.
    Refuted(Witness<S>),
    /// Neither was proved.
    Unknown,
}

/// A point of C where the condition fails.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness<S> {
    /// Where it is on C.
    pub at: CurveParam<S>,
    /// The point, to a few roundoffs.
    pub point: Point<S>,
    /// At most its distance from every sample.
    pub distance: S,
    /// At least its lfs.
    pub lfs: S,
    /// The cell of the band that shows it.
    pub cell: u32,
}

impl<S: Scalar> Witness<S> {
    /// The condition fails there for every ε up to this: at most |p−s| / lfs(p).
    pub fn ratio(&self) -> S {
        self.distance.clone() / &self.lfs * &(S::one() - &S::unit_roundoff().mul_pow2(4))
    }
}

/// Why a piece fulfils the condition, or why that is not known.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason<S> {
    /// lfs is at least this everywhere on it, and its sample nearer than ε times this.
    Feature(S),
    /// Its sample is a neighbour along the path and nearer than the floor that holds everywhere.
    Floor,
    /// Its sample is a neighbour along the path and nearer than the floor of this neighbourhood, in whose extent it lies.
    Neighbourhood(u32),
    /// Unknown: it became smaller than [`Claim::finest`] says.
    Fine,
    /// Unknown: no more cells could be made, or no more comparisons.
    Cells,
    /// Unknown: no more pieces could be made.
    Pieces,
}

impl<S> Reason<S> {
    /// The piece is proved.
    pub const fn proves(&self) -> bool {
        matches!(self, Self::Feature(_) | Self::Floor | Self::Neighbourhood(_))
    }
}

/// A piece of C with its proof.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece<S> {
    /// The segment.
    pub segment: u32,
    /// First and last parameter.
    pub span: [S; 2],
    /// The sample that serves it: an index into the samples.
    pub sample: u32,
    /// Why, or why not.
    pub reason: Reason<S>,
}

/// A foot whose medial point is known to be near.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundedFoot<S> {
    /// Where it is.
    pub at: CurveParam<S>,
    /// The side that it is on.
    pub side: Side,
    /// The point of C that bounds its radius; without one the curvature does.
    pub witness: Option<CurveParam<S>>,
}

/// A stretch of the path around a singular place, on all of which lfs is so small that a floor serves.
#[derive(Clone, Debug, PartialEq)]
pub struct Neighbourhood<S> {
    /// The path.
    pub path: u32,
    /// A foot beside the place, with a medial point that is nearly there.
    pub foot: BoundedFoot<S>,
    /// The point there.
    pub point: Point<S>,
    /// About how long the stretch is.
    pub length: S,
    /// First of its steps, and how many there are.
    pub steps: (u32, u32),
}

/// A step of a neighbourhood, in the order of the path.
#[derive(Clone, Debug, PartialEq)]
pub struct Step<S> {
    /// The segment.
    pub segment: u32,
    /// First and last parameter.
    pub span: [S; 2],
    /// lfs is small since the medial point of this foot is near; without one, since the place is.
    pub foot: Option<BoundedFoot<S>>,
}

/// The part of a neighbourhood on one segment.
#[derive(Clone, Debug, PartialEq)]
pub struct Extent<S> {
    /// The segment.
    pub segment: u32,
    /// First and last parameter.
    pub span: [S; 2],
    /// Index of the neighbourhood.
    pub neighbourhood: u32,
}
