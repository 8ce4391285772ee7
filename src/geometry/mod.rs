//! Points, vectors, boxes, segments and disks of the plane.
//!
//! Points are places, vectors are differences of places; only what makes sense for them is defined. Coordinates are
//! user units of the drawing, y downwards as in SVG; "left" is the direction (−y, x) of a tangent (x, y) throughout.

mod aabb;
#[cfg(any(feature = "glam", feature = "kurbo"))]
mod convert;
pub mod hierarchy;
mod point;
mod segment;
mod vector;

pub use aabb::Aabb;
pub use point::Point;
pub use segment::{distance_sq_to_segment, project_to_segment};
pub use vector::Vector;
