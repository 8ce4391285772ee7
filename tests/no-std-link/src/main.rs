//! A program without std and without an allocator that samples a circle in buffers on its stack.
//!
//! Its exit status is the number of samples, or 100 and more where a step failed. That it links at all is the test: an
//! allocation anywhere in the kernel would ask for a global allocator, which this program does not have.
#![no_std]
#![no_main]

use feature_sampling::bezier::Cubic;
use feature_sampling::buffer::{Forget, SliceStore};
use feature_sampling::curve::contact::{self, Contact};
use feature_sampling::curve::door::{self, CurveBuffers, DoorOptions, PathInput};
use feature_sampling::curve::{ArcStart, Path, Segment};
use feature_sampling::geometry::Point;
use feature_sampling::geometry::hierarchy::{Item, Node, nodes_for};
use feature_sampling::lfs::{self, LfsIndex, items_for};
use feature_sampling::medial::{self, MedialPoint, Resolution};
use feature_sampling::sampling::grading::GapLimit;
use feature_sampling::sampling::{self, Sample, SamplingOptions};

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// The precompiled `core` names the unwinder's hook. Nothing unwinds here (`panic = "abort"`), so it is never called.
#[unsafe(no_mangle)]
pub extern "C" fn rust_eh_personality() {}

const ARCS: usize = 64;
const MEDIAL: usize = 1000;

/// The number of samples of a circle at ε = 1/2, or the number of the step that failed.
fn circle() -> Result<usize, i32> {
    let p = Point::new;
    let k = 0.552_284_8_f32;
    let quarters = [
        Cubic::new(p(1.0, 0.0), p(1.0, k), p(k, 1.0), p(0.0, 1.0)),
        Cubic::new(p(0.0, 1.0), p(-k, 1.0), p(-1.0, k), p(-1.0, 0.0)),
        Cubic::new(p(-1.0, 0.0), p(-1.0, -k), p(-k, -1.0), p(0.0, -1.0)),
        Cubic::new(p(0.0, -1.0), p(k, -1.0), p(1.0, -k), p(1.0, 0.0)),
    ];
    let (mut segments, mut paths) = ([Segment::<f32>::default(); 8], [Path::default(); 2]);
    let (mut arcs, mut items) = ([ArcStart::<f32>::default(); ARCS], [Item::<f32>::default(); ARCS]);
    let (mut nodes, mut order) = ([Node::<f32>::default(); nodes_for(ARCS)], [0_u32; 8]);
    let mut buffers = CurveBuffers {
        segments: SliceStore::new(&mut segments),
        sources: Forget,
        paths: SliceStore::new(&mut paths),
        arcs: SliceStore::new(&mut arcs),
        nodes: SliceStore::new(&mut nodes),
        items: SliceStore::new(&mut items),
        order: SliceStore::new(&mut order),
    };
    let input = [PathInput { closed: true, cubics: &quarters }];
    let entered = door::enter(input.iter().copied(), &DoorOptions::default(), &mut buffers).map_err(|_| 101)?;
    let curve = buffers.curve(&entered);

    let mut contacts = [Contact::<f32>::default(); 8];
    let mut touching = SliceStore::new(&mut contacts);
    for (segment, _) in (0_u32..).zip(curve.segments) {
        contact::find(&curve, segment, &mut touching).map_err(|_| 102)?;
    }
    let contacts: &[Contact<f32>] = touching.into_items();

    let mut medial = [MedialPoint::<f32>::default(); MEDIAL];
    let mut points = SliceStore::new(&mut medial);
    let relevance = medial::walk::relevance(&curve);
    medial::walk(&curve, 0, &Resolution::Steps(50), contacts, &relevance, 0, &mut points).map_err(|_| 103)?;
    let points: &[MedialPoint<f32>] = points.into_items();

    let mut items = [Item::<f32>::default(); items_for(MEDIAL)];
    let mut nodes = [Node::<f32>::default(); nodes_for(items_for(MEDIAL))];
    let mut tree = SliceStore::new(&mut nodes);
    lfs::build(points, &mut SliceStore::new(&mut items), &mut tree).map_err(|_| 104)?;
    let index = LfsIndex::new(points, tree.into_items());

    let mut samples: [Sample<f32>; 64] = core::array::from_fn(|_| Sample::default());
    let mut found = SliceStore::new(&mut samples);
    let mut scratch: [GapLimit<f32>; 1] = [GapLimit::default()];
    let options = SamplingOptions::default();
    sampling::sample_path(&curve, &index, contacts, 0, &options, &mut found, &mut SliceStore::new(&mut scratch))
        .map_err(|_| 105)?;
    Ok(found.into_items().len())
}

/// Called by the C runtime's start-up code, which is all that is linked beside the kernel.
#[unsafe(no_mangle)]
pub extern "C" fn main() -> i32 {
    match circle() {
        Ok(count) => i32::try_from(count).unwrap_or(106),
        Err(step) => step,
    }
}
