//! `docs/accuracy.md`. Every number in it is measured or stands in the table of allowed errors; this file has the words.

use std::path::PathBuf;

use feature_sampling_mpfr::truth::{document, shapes};

const HEAD: &str = "\
# Accuracy
How large the errors are, function by function and for lfs as a whole. **This file is generated**, with every number in it:
```
FSAMPLE_DATA=FOLDER cargo run --release -p feature-sampling-mpfr -- accuracy > docs/accuracy.md
```
What is proved instead of measured stands in [mathematics.md](mathematics.md). The paper's Table 1, with errors against the
number of steps, is made by `fsample reproduce table1`.

";

const FUNCTIONS: &str = "\
## Function by function
Each public function of the kernel that rounds, in `f32` and in `f64`, against itself in 256 bits
([`crates/mpfr`](../crates/mpfr/src/lib.rs)) on the same input: random, with a liking for zeros, ends of intervals, lines and
retracted handles. One ulp is 2^(1−BITS) of what the second column names: of the result where it is well conditioned,
otherwise of what rounding is relative to. `cargo test -p feature-sampling-mpfr` fails where an error exceeds what is
*allowed*, where a public function has no entry in [the table](../crates/mpfr/src/truth/table.rs), and where names or allowed
errors here are not those of the table. *Measured* is the largest error when this file was made.

";

const HULL: &str = "
The bound of `hull_distance_sq` stays a bound where it is so far off: next to an edge of the hull the direction that it is
taken in is mostly rounding, and turning it makes the bound smaller.

### Functions that do not round, or only through others
";

const SHAPES: &str = "
## lfs on shapes with a known value
The largest relative error over the places where the value is known, by scalar and by `tolerance`. The value that counts is
that *of the cubics that are drawn*: a circle of four cubics has curvature that varies, and its smallest lfs is not R.

";

const DRAWINGS: &str = "
Most of these do not depend on the tolerance: inflections, vertices, joints and contacts are feet at any resolution, and
straight medial polylines are exact. Only the concentric circles have a curved medial axis that decides lfs between feet. What
is left at T-junction and crossing are places close to the point where lfs is 0, where rounding of coordinates counts relative
to a small value.

## lfs on drawings
Where `FSAMPLE_DATA` names a folder with `drawings/NAME.svg` and `truth/NAME.csv`: parameters of each drawing with their lfs
from an independent dense computation, given with 12 digits. Joints that turn by less than 0.002 rad are smooth in both.

";

const TAIL: &str = "
*Radii* are those of the tangent disks on both sides, where they are below the diagonal; their errors are what the digits of
the truth leave. The two signs of lfs are told apart because they differ in kind. Where lfs comes out too *large*, the
ε-condition is at risk: the sampler takes (1 − tolerance)·lfs for that reason. Where it comes out too *small*, a few samples
more than needed result. There an edge of a polyline runs nearer to the curve than M does, as where it cuts the angle at a
branch point: the tolerance is a target of refinement, not a bound
([when a cell is fine enough](mathematics.md#8-when-a-cell-is-fine-enough)).

## Determinism
The same input and options give the same bytes, whatever the number of threads, and on every target with IEEE arithmetic: the
kernel uses + − × ÷ √ and comparisons only, all correctly rounded, and never asks for a fused multiply-add.
";

/// The page.
pub(crate) fn accuracy() -> shapes::Result<String> {
    let folder = std::env::var_os("FSAMPLE_DATA").map(PathBuf::from);
    let drawings = folder.map(|folder| shapes::against_truth(&folder)).transpose()?.flatten();
    if drawings.is_none() {
        eprintln!("accuracy: no drawings: FSAMPLE_DATA names no folder with drawings and truth");
    }
    let drawings = drawings.unwrap_or_else(|| "(Not measured: the drawings were not there.)\n".to_owned());
    let (functions, others) = (document::functions(true), document::others());
    let shapes = shapes::analytic()?;
    let parts = [HEAD, FUNCTIONS, &functions, HULL, &others, SHAPES, &shapes, DRAWINGS, &drawings, TAIL];
    Ok(parts.concat())
}
