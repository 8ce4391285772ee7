//! The medial axis by polylines (paper, section 3.1).
//!
//! A [`foot`] point with a direction carries the largest empty tangent [`disk`]; its centre is a medial point. Walking
//! around the curve ([`walk()`]), on the left of every stroke and back on its other side, around open ends and outer corners
//! by fans, gives medial *polylines*. Both sides of every stroke are kept: the paper keeps the nearer one, which makes lfs
//! too large (by up to 5 % on its own test curve).

pub mod cell;
pub mod clear;
pub mod disk;
mod family;
pub mod foot;
pub mod foot_set;
mod pencil;
pub mod radii;
mod trail;
pub mod uniform;
pub mod walk;

pub use disk::{Guard, TangentDisk, tangent_disk, tangent_disk_beside};
pub use foot::{Foot, Side};
pub use uniform::walk_uniform;
pub use walk::{MedialPoint, Resolution, walk};
