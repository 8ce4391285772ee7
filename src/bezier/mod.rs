//! Cubic Bézier curves (paper, Equation 1): evaluation, splitting, raising of lines and quadratics, hull test, closest
//! point.

#[cfg(feature = "kurbo")]
mod convert;
pub mod critical;
mod cubic;
pub mod hull;
pub mod nearest;
pub(crate) mod newton;

pub use cubic::{Cubic, PowerBasis};
