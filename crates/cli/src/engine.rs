//! Where the command line meets the kernel.
//!
//! The kernel speaks of its curve C (segments with joints, cusps split, kinks smoothed); users speak of the paths and cubics
//! of their drawing. [`Engine`] builds the kernel's model of a drawing, asks it, and translates answers back into the rows
//! that are exported. Nothing else in this crate names a type of the kernel's models.
//!
//! **Threads.** Paths are walked independently of each other, each by whichever thread is free, and put together in the
//! order of the document. So the number of threads decides how long it takes and nothing else.

mod certified;
mod enclosed;

use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, Ordering};

use feature_sampling::bezier::Cubic;
use feature_sampling::curve::door::{DoorOptions, DoorReport, sine_of_degrees};
use feature_sampling::curve::{Curve, CurveParam, nearest};
use feature_sampling::geometry::Point;
use feature_sampling::medial::walk::relevance;
use feature_sampling::medial::{MedialPoint, Resolution, Side};
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::{Bound, Condition, Sample, SamplingError, SamplingOptions};
use lineart::drawing::{Drawing, DrawingPath};
use lineart::export::{LfsRow, MedialRow, PathRows, SampleRow, control_box};

pub(crate) use certified::{Effort, Fault, Judged, recheck};
pub(crate) use enclosed::{Enclosed, Width};

use crate::errors::{Failure, shown};
use crate::progress::Progress;
use crate::summary::count;
use lineart::export::number::Readable;

/// How the model of a drawing is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ModelOptions {
    /// Foot points per cubic; without it, as many as the tolerance takes.
    pub(crate) steps: Option<u32>,
    /// Relative error of lfs.
    pub(crate) tolerance: f64,
    /// Joints that turn by less are smooth, in degrees.
    pub(crate) corner_angle: f64,
    /// Most medial points of the drawing.
    pub(crate) max_medial_points: usize,
    /// At least 1.
    pub(crate) threads: usize,
    /// Show no progress.
    pub(crate) quiet: bool,
}

/// What makes samples dense where there is detail.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Density {
    /// |p − s| < ε·lfs(p).
    Epsilon(f64),
    /// The same with the smallest lfs between neighbours.
    Rho(f64),
}

/// All bounds of a sampling; lengths in user units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) density: Density,
    pub(crate) chord_error: Option<f64>,
    pub(crate) min_distance: Option<f64>,
    pub(crate) max_distance: Option<f64>,
    pub(crate) grading: Option<f64>,
    pub(crate) start: f64,
    /// Most samples on one path.
    pub(crate) limit: u32,
}

impl Bounds {
    /// An ε-condition and nothing else, but perhaps a floor.
    pub(crate) const fn least(epsilon: f64, min_distance: Option<f64>) -> Self {
        Self {
            density: Density::Epsilon(epsilon),
            chord_error: None,
            min_distance,
            max_distance: None,
            grading: None,
            start: 0.0,
            limit: 10_000_000,
        }
    }
}

/// The model of a drawing.
pub(crate) struct Engine<'d> {
    drawing: &'d Drawing,
    options: ModelOptions,
    curve: CurveModel<f64>,
    medial: MedialModel<f64>,
}

impl<'d> Engine<'d> {
    /// The diagonal of the box of the control points: what % of a length refers to.
    pub(crate) fn diagonal(drawing: &Drawing) -> f64 {
        control_box(drawing).extent().norm()
    }

    /// Takes a drawing through the door and looks at what it did, without computing anything more.
    pub(crate) fn inspect(drawing: &Drawing, corner_angle: f64) -> Result<Door, Failure> {
        curve_model(drawing, corner_angle).map(|curve| Door::new(curve.report()))
    }

    /// Builds the model.
    pub(crate) fn new(drawing: &'d Drawing, options: &ModelOptions) -> Result<Self, Failure> {
        let curve = curve_model(drawing, options.corner_angle)?;
        let medial = MedialModel::from_paths(walk_all(drawing, &curve, options)?);
        Ok(Self { drawing, options: *options, curve, medial })
    }

    /// lfs at a point, without a place on the drawing.
    pub(crate) fn lfs(&self, p: &Point<f64>) -> f64 {
        self.medial.lfs(p)
    }

    /// The curve C.
    pub(crate) fn curve(&self) -> Curve<'_, f64> {
        self.curve.curve()
    }

    /// The relative error of lfs that the medial axis was refined to.
    pub(crate) const fn tolerance(&self) -> f64 {
        self.options.tolerance
    }

    /// What was changed before anything was computed.
    pub(crate) fn door(&self) -> Door {
        Door::new(self.curve.report())
    }

    /// Rows by path of the drawing. A path that the door dropped keeps its place and has none.
    fn by_path<R>(&self, mut rows_of: impl FnMut(usize) -> Vec<R>) -> Vec<PathRows<R>> {
        let empty = |path: &DrawingPath| PathRows { closed: path.closed, rows: Vec::new() };
        let mut out: Vec<PathRows<R>> = self.drawing.paths.iter().map(empty).collect();
        for (index, path) in self.curve.curve().paths.iter().enumerate() {
            if let Some(place) = out.get_mut(path.source as usize) {
                *place = PathRows { closed: path.closed, rows: rows_of(index) };
            }
        }
        out
    }

    /// Samples.
    pub(crate) fn sample(&self, bounds: &Bounds) -> Result<Vec<PathRows<SampleRow>>, Failure> {
        self.sampled(bounds, 1.0).map(|samples| self.sample_rows(samples, bounds))
    }

    /// Samples of each path of C, for upper bounds and floors that are `aim` times what is asked.
    fn sampled(&self, bounds: &Bounds, aim: f64) -> Result<Vec<Vec<Sample<f64>>>, Failure> {
        let default = SamplingOptions::default();
        let options = SamplingOptions {
            condition: match bounds.density {
                Density::Epsilon(epsilon) => Condition::Epsilon(epsilon * aim),
                Density::Rho(rho) => Condition::Rho(rho * aim),
            },
            chord_error: bounds.chord_error,
            min_distance: bounds.min_distance,
            max_distance: bounds.max_distance,
            grading: bounds.grading,
            start: bounds.start,
            tolerance: self.options.tolerance,
            limit: bounds.limit,
            singular_floor: default.singular_floor * aim,
            floor: default.floor * aim,
            ..default
        };
        options.check().map_err(Failure::usage)?;
        let sampled = each_path(&self.curve, "sampling", &self.options, |path| {
            self.curve.sample_path(&self.medial, path, &options)
        });
        let samples = sampled.into_iter().map(|samples| match samples {
            Ok(samples) => Ok(samples),
            Err(SamplingError::Limit(limit)) => {
                let advice = "raise --max-samples, or ask for less with --min-distance";
                let name = shown(&self.drawing.source);
                Err(Failure::limit(format!("{name}: a path needs more than {limit} samples: {advice}")))
            }
            Err(error) => Err(Failure::usage(error)),
        });
        samples.collect()
    }

    /// Samples of each path of C as rows by path of the drawing.
    fn sample_rows(&self, samples: Vec<Vec<Sample<f64>>>, bounds: &Bounds) -> Vec<PathRows<SampleRow>> {
        let row = |sample: &Sample<f64>| self.sample_row(sample, bounds);
        let mut rows: Vec<Vec<SampleRow>> = samples.iter().map(|samples| samples.iter().map(row).collect()).collect();
        self.by_path(|index| rows.get_mut(index).map(std::mem::take).unwrap_or_default())
    }

    fn sample_row(&self, sample: &Sample<f64>, bounds: &Bounds) -> SampleRow {
        let (path, segment, t) = self.curve.source(&sample.at);
        let bound = match sample.bound {
            Bound::Start => "start",
            Bound::Epsilon => "epsilon",
            Bound::Chord => "chord",
            Bound::Min => "min",
            Bound::Max => "max",
            Bound::Grading => "grading",
            // A floor that the user set is d_min.
            Bound::Floor if bounds.min_distance.is_some() => "min",
            Bound::Floor => "floor",
            Bound::End => "end",
            Bound::Corner => "corner",
        };
        SampleRow { path, segment, t, x: sample.point.x, y: sample.point.y, lfs: sample.lfs, bound }
    }

    /// Medial points, with radii that are bounded.
    pub(crate) fn medial(&self) -> Vec<PathRows<MedialRow>> {
        let curve = self.curve.curve();
        let mut rows: Vec<Vec<MedialRow>> = curve.paths.iter().map(|_| Vec::new()).collect();
        for point in self.medial.points() {
            let path = curve.segment(point.at.segment).and_then(|segment| rows.get_mut(segment.path as usize));
            path.into_iter().for_each(|rows| rows.push(self.medial_row(point)));
        }
        self.by_path(|index| rows.get_mut(index).map(std::mem::take).unwrap_or_default())
    }

    fn medial_row(&self, p: &MedialPoint<f64>) -> MedialRow {
        let (path, segment, t) = self.curve.source(&p.at);
        let side = match p.side {
            Side::Left => "left",
            Side::Right => "right",
            Side::Fan => "fan",
            Side::Corner => "corner",
        };
        let (foot, centre) = (&p.foot, &p.centre);
        let MedialPoint { radius, polyline, .. } = *p;
        MedialRow { path, segment, t, x: foot.x, y: foot.y, side, mx: centre.x, my: centre.y, radius, polyline }
    }

    /// lfs at a point that need not lie on the drawing; path, segment and t are those of the nearest point that does.
    pub(crate) fn lfs_at(&self, p: &Point<f64>) -> LfsRow {
        let near = nearest::nearest(&self.curve.curve(), p, f64::INFINITY);
        self.lfs_row(&near.map_or_else(CurveParam::default, |near| near.at), p)
    }

    fn lfs_row(&self, at: &CurveParam<f64>, p: &Point<f64>) -> LfsRow {
        let (path, segment, t) = self.curve.source(at);
        LfsRow { path, segment, t, x: p.x, y: p.y, lfs: self.medial.lfs(p), bounds: None }
    }

    /// lfs at all foot points and all ends of cubics, along the paths.
    pub(crate) fn lfs_along(&self) -> Vec<PathRows<LfsRow>> {
        let curve = self.curve.curve();
        let mut feet: Vec<Vec<(f64, Point<f64>)>> = vec![Vec::new(); curve.segments.len()];
        for point in self.medial.points() {
            if let Some(feet) = feet.get_mut(point.at.segment as usize).filter(|_| point.at.t > 0.0 && point.at.t < 1.0)
            {
                feet.push((point.at.t, point.foot));
            }
        }
        self.by_path(|index| {
            let Some(path) = curve.paths.get(index) else { return Vec::new() };
            let mut rows = Vec::new();
            for segment in path.first..path.first + path.count {
                let mut stops = feet.get(segment as usize).cloned().unwrap_or_default();
                let end = segment + 1 == path.first + path.count && !path.closed;
                let cubic = curve.segment(segment).map(|segment| &segment.cubic);
                stops.extend(cubic.map(|cubic| (0.0, *cubic.start())));
                stops.extend(cubic.filter(|_| end).map(|cubic| (1.0, *cubic.end())));
                // Most feet carry a disk on either side.
                stops.sort_by(|a, b| a.0.total_cmp(&b.0));
                stops.dedup_by(|a, b| a.0 == b.0);
                rows.extend(stops.iter().map(|(t, point)| self.lfs_row(&CurveParam { segment, t: *t }, point)));
            }
            rows
        })
    }
}

fn curve_model(drawing: &Drawing, corner_angle: f64) -> Result<CurveModel<f64>, Failure> {
    let options = DoorOptions { corner_sine: sine_of_degrees(&corner_angle), ..DoorOptions::default() };
    let paths: Vec<(bool, &[Cubic<f64>])> =
        drawing.paths.iter().map(|path| (path.closed, path.cubics.as_slice())).collect();
    CurveModel::new(&paths, &options).map_err(|error| Failure::input(&drawing.source, error))
}

/// Walks around every path.
fn walk_all(
    drawing: &Drawing,
    curve: &CurveModel<f64>,
    options: &ModelOptions,
) -> Result<Vec<Vec<MedialPoint<f64>>>, Failure> {
    let resolution = match options.steps {
        Some(steps) => Resolution::Steps(steps),
        None => Resolution::Tolerance(options.tolerance),
    };
    let relevance = relevance(&curve.curve());
    let limit = options.max_medial_points;
    let too_many = || {
        let name = shown(&drawing.source);
        let advice = "raise --max-medial-points, or ask for less with --tolerance or --steps";
        Failure::limit(format!("{name}: more than {limit} medial points are needed: {advice}"))
    };
    let walked =
        each_path(curve, "medial axis", options, |path| curve.walk_within(path, &resolution, &relevance, limit));
    let points = walked.into_iter().collect::<Result<Vec<_>, _>>().map_err(|_| too_many())?;
    // Each path alone and all together: the same answer for any number of threads.
    if points.iter().map(Vec::len).sum::<usize>() > limit { Err(too_many()) } else { Ok(points) }
}

/// Does something to every path, on several threads, and answers the results in the order of the paths.
fn each_path<T: Send>(
    curve: &CurveModel<f64>,
    what: &'static str,
    options: &ModelOptions,
    work: impl Fn(u32) -> T + Sync,
) -> Vec<T> {
    let progress = Progress::new(what, options.quiet);
    let count = u32::try_from(curve.curve().paths.len()).unwrap_or(u32::MAX);
    let next = AtomicU32::new(0);
    let done = Mutex::new(Vec::new());
    let worker = || {
        loop {
            let path = next.fetch_add(1, Ordering::Relaxed);
            if path >= count {
                break;
            }
            let result = work(path);
            // A thread that panicked takes the whole run with it when the scope ends.
            let Ok(mut done) = done.lock() else { break };
            done.push((path, result));
            progress.of(done.len() as u64, u64::from(count));
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..options.threads.min(count as usize) {
            scope.spawn(worker);
        }
        worker();
    });
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_by_key(|(path, _)| *path);
    done.into_iter().map(|(_, result)| result).collect()
}

/// What the door did to a drawing.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Door {
    pub(crate) smooth_joints: u32,
    pub(crate) corners: u32,
    pub(crate) open_ends: u32,
    report: DoorReport<f64>,
}

impl Door {
    fn new(report: &DoorReport<f64>) -> Self {
        let DoorReport { smooth_joints, corners, open_ends, .. } = *report;
        Self { smooth_joints, corners, open_ends, report: *report }
    }

    /// What was changed, by fixed names; lengths in user units.
    pub(crate) fn facts(&self) -> [(&'static str, f64); 11] {
        let report = &self.report;
        [
            ("short_segments_dropped", f64::from(report.dropped)),
            ("paths_vanished", f64::from(report.vanished)),
            ("closing_lines_added", f64::from(report.closing_lines)),
            ("paths_closed", f64::from(report.closed)),
            ("lines_straightened", f64::from(report.straightened)),
            ("cusps_split", f64::from(report.cusps)),
            ("repeated_cubics", f64::from(report.twins)),
            ("ends_joined", f64::from(report.joined)),
            ("kinks_smoothed", f64::from(report.smoothed)),
            ("largest_smoothing", report.displacement),
            ("largest_snapping", report.snap),
        ]
    }

    /// What was changed, in words; nothing if nothing was.
    pub(crate) fn changes(&self) -> Vec<String> {
        let report = &self.report;
        let by = |length: f64| format!("by up to {}", Readable(length));
        [
            (report.dropped, count(report.dropped as usize, "short segment") + " dropped"),
            (report.vanished, count(report.vanished as usize, "path") + " dropped whole"),
            (report.closing_lines, count(report.closing_lines as usize, "closing line") + " added"),
            (report.closed, count(report.closed as usize, "open path") + " closed"),
            (report.twins, count(report.twins as usize, "cubic") + " drawn more than once"),
            (report.joined, count(report.joined as usize, "joint") + " of ends of different paths"),
            (report.smoothed, count(report.smoothed as usize, "kink") + " smoothed " + &by(report.displacement)),
            (u32::from(report.snap > 0.0), "points snapped together ".to_owned() + &by(report.snap)),
        ]
        .into_iter()
        .filter_map(|(times, words)| (times > 0).then_some(words))
        .collect()
    }
}
