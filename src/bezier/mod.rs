//! Cubic Bézier curves (paper, Equation 1): evaluation, splitting, raising of lines and quadratics, hull test, closest
//! point.

mod cubic;

pub use cubic::{Cubic, PowerBasis};
