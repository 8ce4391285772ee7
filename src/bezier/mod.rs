//! Cubic Bézier curves (paper, Equation 1): evaluation, splitting, raising of lines and quadratics, hull test, closest
//! point.

pub mod critical;
pub mod hull;
pub mod nearest;
mod cubic;
pub(crate) mod newton;

pub use cubic::{Cubic, PowerBasis};
