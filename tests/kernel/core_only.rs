//! The whole chain in lent memory: door, contacts, medial polylines, index, samples, without a single `Vec`.
//!
//! In slices of stated size and in `ArrayVec`s, in f32 and f64, the results equal those of the `Vec` wrappers to the bit;
//! a buffer that is too small, whichever it is, is an error and never a panic.

use crate::common::{Stroke, cubic, curve_model, ellipse, open, rounded, stick};
use arrayvec::ArrayVec;
use feature_sampling::buffer::{BufferFull, SliceStore, Store};
use feature_sampling::curve::contact::{self, Contact};
use feature_sampling::curve::door::{self, CurveBuffers, CurveError, DoorOptions, PathInput};
use feature_sampling::curve::{ArcStart, Path, Segment, Source};
use feature_sampling::geometry::hierarchy::{Item, Node, nodes_for};
use feature_sampling::lfs::{self, LfsIndex, items_for};
use feature_sampling::medial::{self, MedialPoint, Resolution};
use feature_sampling::model::MedialModel;
use feature_sampling::sampling::grading::GapLimit;
use feature_sampling::sampling::{self, Sample, SamplingError, SamplingOptions};
use feature_sampling::scalar::Scalar;

/// Sizes of all buffers, in items.
#[derive(Clone, Copy, Debug)]
struct Room {
    segments: usize,
    paths: usize,
    arcs: usize,
    contacts: usize,
    medial: usize,
    samples: usize,
    scratch: usize,
}

const ROOM: Room = Room { segments: 16, paths: 4, arcs: 160, contacts: 16, medial: 12_000, samples: 400, scratch: 400 };

/// Any of the ways to run out of room, or a real refusal.
#[derive(Debug, PartialEq)]
enum Failure {
    Full(BufferFull),
    Other,
}

impl From<BufferFull> for Failure {
    fn from(full: BufferFull) -> Self {
        Self::Full(full)
    }
}

impl From<CurveError> for Failure {
    fn from(error: CurveError) -> Self {
        if let CurveError::Full(full) = error { Self::Full(full) } else { Self::Other }
    }
}

impl From<SamplingError> for Failure {
    fn from(error: SamplingError) -> Self {
        if let SamplingError::Full(full) = error { Self::Full(full) } else { Self::Other }
    }
}

/// All stores of the chain.
struct Stores<Sg, So, Pa, Ar, No, It, Or, Co, Me, Mn, Mi, Sa, Sc> {
    curve: CurveBuffers<Sg, So, Pa, Ar, No, It, Or>,
    contacts: Co,
    medial: Me,
    medial_nodes: Mn,
    medial_items: Mi,
    samples: Sa,
    scratch: Sc,
}

impl<Sg, So, Pa, Ar, No, It, Or, Co, Me, Mn, Mi, Sa, Sc> Stores<Sg, So, Pa, Ar, No, It, Or, Co, Me, Mn, Mi, Sa, Sc> {
    /// Runs the chain; afterwards `medial` and `samples` hold the results.
    fn run<S: Scalar>(
        &mut self,
        paths: &[PathInput<'_, S>],
        resolution: &Resolution<S>,
        options: &SamplingOptions<S>,
    ) -> Result<(), Failure>
    where
        Sg: Store<Segment<S>>,
        So: Store<Source<S>>,
        Pa: Store<Path>,
        Ar: Store<ArcStart<S>>,
        No: Store<Node<S>>,
        It: Store<Item<S>>,
        Or: Store<u32>,
        Co: Store<Contact<S>>,
        Me: Store<MedialPoint<S>>,
        Mn: Store<Node<S>>,
        Mi: Store<Item<S>>,
        Sa: Store<Sample<S>>,
        Sc: Store<GapLimit<S>>,
    {
        let entered = door::enter(paths.iter().cloned(), &DoorOptions::default(), &mut self.curve)?;
        let curve = self.curve.curve(&entered);
        for (segment, _) in (0_u32..).zip(curve.segments) {
            contact::find(&curve, segment, &mut self.contacts)?;
        }
        let contacts = self.contacts.items();
        let relevance = medial::walk::relevance(&curve);
        let mut polyline = 0;
        for (path, _) in (0_u32..).zip(curve.paths) {
            polyline = medial::walk(&curve, path, resolution, contacts, &relevance, polyline, &mut self.medial)?;
        }
        lfs::build(self.medial.items(), &mut self.medial_items, &mut self.medial_nodes)?;
        let index = LfsIndex::new(self.medial.items(), self.medial_nodes.items());
        for (path, _) in (0_u32..).zip(curve.paths) {
            sampling::sample_path(&curve, &index, contacts, path, options, &mut self.samples, &mut self.scratch)?;
        }
        Ok(())
    }
}

/// Medial points and samples of the chain in lent slices, handed to `look`.
fn in_slices<S: Scalar + Copy + Default, R>(
    paths: &[PathInput<'_, S>],
    resolution: &Resolution<S>,
    options: &SamplingOptions<S>,
    room: &Room,
    look: impl FnOnce(&[MedialPoint<S>], &[Sample<S>]) -> R,
) -> Result<R, Failure> {
    let mut segments = [Segment::<S>::default(); ROOM.segments];
    let mut sources = [Source::<S>::default(); ROOM.segments];
    let mut path_list = [Path::default(); ROOM.paths];
    let mut arcs = [ArcStart::<S>::default(); ROOM.arcs];
    let mut nodes = [Node::<S>::default(); nodes_for(ROOM.arcs)];
    let mut items = [Item::<S>::default(); ROOM.arcs];
    let mut order = [0_u32; ROOM.segments];
    let mut contacts = [Contact::<S>::default(); ROOM.contacts];
    let mut medial = [MedialPoint::<S>::default(); ROOM.medial];
    let mut medial_nodes = [Node::<S>::default(); nodes_for(items_for(ROOM.medial))];
    let mut medial_items = [Item::<S>::default(); items_for(ROOM.medial)];
    let mut samples: [Sample<S>; ROOM.samples] = core::array::from_fn(|_| Sample::default());
    let mut scratch: [GapLimit<S>; ROOM.scratch] = core::array::from_fn(|_| GapLimit::default());
    let mut stores = Stores {
        curve: CurveBuffers {
            segments: SliceStore::new(&mut segments[..room.segments]),
            sources: SliceStore::new(&mut sources[..room.segments]),
            paths: SliceStore::new(&mut path_list[..room.paths]),
            arcs: SliceStore::new(&mut arcs[..room.arcs]),
            nodes: SliceStore::new(&mut nodes[..nodes_for(room.arcs)]),
            items: SliceStore::new(&mut items[..room.arcs]),
            order: SliceStore::new(&mut order[..room.segments]),
        },
        contacts: SliceStore::new(&mut contacts[..room.contacts]),
        medial: SliceStore::new(&mut medial[..room.medial]),
        medial_nodes: SliceStore::new(&mut medial_nodes[..nodes_for(items_for(room.medial))]),
        medial_items: SliceStore::new(&mut medial_items[..items_for(room.medial)]),
        samples: SliceStore::new(&mut samples[..room.samples]),
        scratch: SliceStore::new(&mut scratch[..room.scratch]),
    };
    stores.run(paths, resolution, options)?;
    Ok(look(stores.medial.items(), stores.samples.items()))
}

fn drawings() -> [Vec<Stroke>; 3] {
    let wave = cubic([[0.0, 0.0], [20.0, 40.0], [50.0, -30.0], [70.0, 10.0]]);
    [
        vec![ellipse(0.0, 0.0, 1.0, 1.0)],
        vec![open(vec![wave]), stick([0.0, 20.0], [60.0, -5.0])],
        vec![ellipse(0.0, 0.0, 8.0, 3.0), stick([-4.0, 0.0], [4.0, 1.0]), stick([4.0, 1.0], [5.0, 0.0])],
    ]
}

/// A thread with a stack for all arrays at once, whatever the optimiser makes of them.
fn roomy(run: impl FnOnce() + Send + 'static) {
    let thread = std::thread::Builder::new().stack_size(64 << 20).spawn(run).expect("a thread");
    if let Err(panic) = thread.join() {
        std::panic::resume_unwind(panic);
    }
}

fn options<S: Scalar>(grading: bool) -> SamplingOptions<S> {
    SamplingOptions { grading: grading.then(|| S::ratio(3, 2)), ..SamplingOptions::default() }
}

fn equal_to_vectors<S: Scalar + Copy + Default>() {
    for strokes in drawings() {
        let strokes = rounded::<S>(&strokes);
        let inputs: ArrayVec<PathInput<'_, S>, 4> =
            strokes.iter().map(|s| PathInput { closed: s.closed, cubics: &s.cubics }).collect();
        for resolution in [Resolution::Steps(40), Resolution::Tolerance(S::ratio(1, 100))] {
            let curve = curve_model(&strokes, &DoorOptions::default());
            let medial = MedialModel::new(&curve, &resolution);
            // Grading in f64 only.
            for options in [options(false), options(S::BITS > 24)] {
                let samples = curve.sample(&medial, &options).expect("samples");
                in_slices(&inputs, &resolution, &options, &ROOM, |points, found| {
                    assert_eq!(points, medial.points());
                    assert_eq!(found, samples);
                })
                .expect("room enough");
            }
        }
    }
}

#[test]
fn slices_equal_vectors() {
    roomy(equal_to_vectors::<f32>);
    roomy(equal_to_vectors::<f64>);
}

#[test]
fn array_vectors_equal_vectors() {
    roomy(|| {
        let strokes = rounded::<f32>(&drawings()[1]);
        let inputs: ArrayVec<PathInput<'_, f32>, 4> =
            strokes.iter().map(|s| PathInput { closed: s.closed, cubics: &s.cubics }).collect();
        let mut stores = Stores {
            curve: CurveBuffers {
                segments: ArrayVec::<Segment<f32>, 16>::new(),
                sources: ArrayVec::<Source<f32>, 16>::new(),
                paths: ArrayVec::<Path, 4>::new(),
                arcs: ArrayVec::<ArcStart<f32>, 160>::new(),
                nodes: ArrayVec::<Node<f32>, 320>::new(),
                items: ArrayVec::<Item<f32>, 160>::new(),
                order: ArrayVec::<u32, 16>::new(),
            },
            contacts: ArrayVec::<Contact<f32>, 16>::new(),
            medial: ArrayVec::<MedialPoint<f32>, 3000>::new(),
            medial_nodes: ArrayVec::<Node<f32>, 1000>::new(),
            medial_items: ArrayVec::<Item<f32>, 500>::new(),
            samples: ArrayVec::<Sample<f32>, 400>::new(),
            scratch: ArrayVec::<GapLimit<f32>, 400>::new(),
        };
        stores.run(&inputs, &Resolution::Steps(40), &options(false)).expect("room enough");
        let curve = curve_model(&strokes, &DoorOptions::default());
        let medial = MedialModel::new(&curve, &Resolution::Steps(40));
        assert_eq!(stores.medial.items(), medial.points());
        assert_eq!(stores.samples.items(), curve.sample(&medial, &options(false)).expect("samples"));
    });
}

#[test]
fn too_small_buffers_say_so() {
    roomy(|| {
        let strokes = rounded::<f64>(&drawings()[2]);
        let inputs: ArrayVec<PathInput<'_, f64>, 4> =
            strokes.iter().map(|s| PathInput { closed: s.closed, cubics: &s.cubics }).collect();
        let resolution = Resolution::Steps(20);
        let run = |room: &Room| in_slices(&inputs, &resolution, &options(true), room, |m, s| (m.len(), s.len()));
        let (points, samples) = run(&ROOM).expect("room enough");
        // Each buffer in turn, at every size from none to what it needs.
        type Part = (&'static str, fn(&mut Room) -> &mut usize, Option<usize>);
        let parts: [Part; 7] = [
            ("segments", |r| &mut r.segments, Some(6)),
            ("paths", |r| &mut r.paths, Some(3)),
            ("arcs", |r| &mut r.arcs, None),
            ("contacts", |r| &mut r.contacts, None),
            ("medial", |r| &mut r.medial, Some(points)),
            ("samples", |r| &mut r.samples, Some(samples)),
            ("scratch", |r| &mut r.scratch, None),
        ];
        for (name, part, needed) in parts {
            let mut room = ROOM;
            let full = *part(&mut room);
            let step = (full / 60).max(1);
            let mut enough = 0;
            for size in (0..=full).step_by(step).chain(needed) {
                let mut room = ROOM;
                *part(&mut room) = size;
                match run(&room) {
                    Ok(found) => {
                        assert_eq!(found, (points, samples), "{name}: {size}");
                        assert!(needed.is_none_or(|n| size >= n), "{name}: {size} cannot be enough");
                        enough += 1;
                    }
                    Err(Failure::Full(BufferFull { capacity })) => {
                        assert!(enough == 0 || Some(size) == needed, "{name}: {size} is too small, less was enough");
                        assert!(name == "medial" || capacity <= 2 * size.max(1), "{name}: {size} for {capacity}");
                    }
                    Err(Failure::Other) => panic!("{name}: {size}"),
                }
            }
            assert!(enough > 0, "{name}: {full} is not enough");
        }
    });
}
