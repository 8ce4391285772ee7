//! Local feature size, medial polylines and ε-samples of Bézier line art.
//!
//! A drawing is a set of curves C. Its **medial axis** M is the closure of the set of points with two or more closest points
//! on C; the **local feature size** lfs(p) of a point p ∈ C is its distance to M: small where the curve bends sharply or where
//! two strokes come near each other. A finite set S ⊂ C is an **ε-sample** if every p ∈ C has a sample s with
//! |p − s| < ε·lfs(p). This crate computes all three for piecewise cubic Bézier paths, open or closed, any number of them.
//! It follows *Feature-Sized Sampling for Vector Line Art*; `docs/paper-map.md` says where, and where it differs.
//!
//! # Example
//! A drawing of two cubics, one above the other; their lfs; samples for ε = 1/2.
//!
//! ```
//! # #[cfg(feature = "alloc")] {
//! use feature_sampling::bezier::Cubic;
//! use feature_sampling::curve::door::DoorOptions;
//! use feature_sampling::geometry::Point;
//! use feature_sampling::medial::Resolution;
//! use feature_sampling::model::{CurveModel, MedialModel};
//! use feature_sampling::sampling::{Condition, SamplingOptions};
//!
//! let cubic = |p: [[f64; 2]; 4]| Cubic { points: p.map(|[x, y]| Point::new(x, y)) };
//! let wave = [cubic([[0.0, 0.0], [30.0, 25.0], [70.0, -25.0], [100.0, 0.0]])];
//! let arch = [cubic([[0.0, 40.0], [30.0, 10.0], [70.0, 10.0], [100.0, 40.0]])];
//!
//! // The door makes the curve C of the drawing: two open paths.
//! let curve = CurveModel::new(&[(false, &wave), (false, &arch)], &DoorOptions::default())?;
//! assert_eq!((curve.report().open_ends, curve.contacts().len()), (4, 0));
//!
//! // Medial polylines, refined until lfs is good to a thousandth.
//! let tolerance = 1e-3;
//! let medial = MedialModel::new(&curve, &Resolution::Tolerance(tolerance));
//! let (far, near) = (wave[0].eval(&0.2), wave[0].eval(&0.8));
//! assert!(medial.lfs(&near) > medial.lfs(&far), "on the left the strokes are closer to each other");
//!
//! // Samples, path after path; what they are given is what they keep.
//! let epsilon = 0.5;
//! let options = SamplingOptions { condition: Condition::Epsilon(epsilon), tolerance, ..SamplingOptions::default() };
//! let samples = curve.sample(&medial, &options)?;
//! for i in 0..=1000 {
//!     let p = wave[0].eval(&(f64::from(i) / 1000.0));
//!     let nearest = samples.iter().map(|s| s.point.distance(&p)).fold(f64::INFINITY, f64::min);
//!     assert!(nearest < epsilon * medial.lfs(&p));
//! }
//! # }
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! # Map
//! Each module uses only those above it.
//!
//! | module | what it holds | paper |
//! |---|---|---|
//! | [`scalar`] | numbers: [`Field`](scalar::Field) for algebra, [`Scalar`](scalar::Scalar) to decide; `f32`, `f64` | |
//! | [`buffer`] | where results go: lent slices, arrays, vectors | |
//! | [`polynomial`] | real roots, Cauchy's and Kojima's bounds | 7.1 |
//! | [`geometry`] | points, vectors, boxes, the bounding hierarchy | |
//! | [`predicate`] | orientation and in-circle, plain and exact | |
//! | [`bezier`] | cubics, [hull test](bezier::hull), [closest point](bezier::nearest), [critical points](bezier::critical) | Eq. 1, 7.1 |
//! | [`curve`] | the curve C: [door](curve::door), [joints](curve::joint), [arcs](curve::arc), [contacts](curve::contact) | 2 |
//! | [`medial`] | [foot points](medial::foot), [tangent disks](medial::disk), [medial polylines](medial::walk()) | 3.1, 7.1 |
//! | [`lfs`] | distance to the medial polylines | 3.2 |
//! | [`sampling`] | ε-samples and ρ-samples, d_min, d_max, chord error, grading | 3.3, 5.2, 6 |
//! | [`certificate`] | proofs that samples are ε-samples, and points where they are none | |
#![cfg_attr(
    feature = "alloc",
    doc = "| [`model`] | the whole chain in vectors: a thin owner without an algorithm of its own | |"
)]
//!
//! # Memory
//! Nothing is allocated. What mathematics bounds comes in an `ArrayVec`; everything else is written into a
//! [`Store`](buffer::Store) that the caller lends, and a store that is full is an error, never a shorter answer. With
//! `alloc` there are owners in vectors beside the same functions.
//!
//! # Numbers
//! Only + − × ÷ √ and comparisons are used, so results agree to the bit on every target with IEEE arithmetic, with `std` and
//! with `libm`. Lengths inside the kernel are judged relative to the drawing's diagonal. Coordinates are plain user units; y
//! may point either way ("left" is always (−y, x)).
//!
//! # Features
//! | feature | default | what it adds |
//! |---|---|---|
//! | `std` | yes | links the standard library; implies `alloc` |
//! | `alloc` | yes | `Vec` as a [`Store`](buffer::Store), and the module `model` |
//! | `libm` | | square roots where there is no `std`: one of the two is needed |
//! | `kiddo` | | nearest medial *vertex* through a kd-tree, as the paper does it (`lfs::kd`) |
//! | `glam`, `kurbo` | | exact conversions of points (and, for kurbo, cubics) |
#![cfg_attr(not(feature = "std"), no_std)]
#![forbid(unsafe_code)]

#[cfg(feature = "alloc")]
extern crate alloc;

pub mod bezier;
pub mod buffer;
pub mod certificate;
pub mod curve;
pub mod geometry;
pub mod lfs;
pub mod medial;
#[cfg(feature = "alloc")]
pub mod model;
mod order;
pub mod polynomial;
pub mod predicate;
#[cfg(feature = "alloc")]
pub mod prover;
pub mod sampling;
pub mod scalar;
