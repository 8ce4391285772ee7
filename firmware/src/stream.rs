//! From the bytes of a job to its cubics, with what the job says about each ([`fsample_job`]).
//!
//! A cubic is joined to those before it as it comes: between two bytes the work is a comparison with each of them at most.

use crate::Fault;
use feature_sampling::bezier::Cubic;
use feature_sampling::buffer::{SliceStore, Store};
use feature_sampling::curve::given::{self, Extent};
use feature_sampling::curve::{ArcStart, JointKind, Path, Segment};
use feature_sampling::geometry::Point;
use feature_sampling::lfs::table::Column;
use fsample_job::{Command, Decoder, JobError, JobOptions};

/// A command that has no place where it stands, or that is missing there.
const ORDER: Fault = Fault::Job(JobError::Order);

/// Who computes lfs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lfs {
    /// The controller: the job has places and arcs.
    Own,
    /// The host: the job has values.
    Given,
}

/// Memory for a job.
#[derive(Debug)]
pub struct JobMemory<'a> {
    /// [`CUBICS`](crate::CUBICS).
    pub segments: &'a mut [Segment<f32>],
    /// [`CUBICS`](crate::CUBICS).
    pub columns: &'a mut [Column],
    /// [`PATHS`](crate::PATHS).
    pub paths: &'a mut [Path],
    /// [`ARCS`](crate::ARCS), or none where the host computes lfs.
    pub arcs: &'a mut [ArcStart<f32>],
    /// [`VALUES`](crate::VALUES), or none where the controller computes lfs.
    pub values: &'a mut [u16],
}

/// A job that has been read.
#[derive(Debug)]
pub struct Job<'a> {
    /// What it asks for.
    pub options: JobOptions,
    /// Its cubics.
    pub segments: &'a mut [Segment<f32>],
    /// For each cubic the places where lfs is known.
    pub columns: &'a [Column],
    /// Its paths.
    pub paths: &'a [Path],
    /// Its arcs, without turning.
    pub arcs: &'a mut [ArcStart<f32>],
    /// Values that came along.
    pub values: &'a [u16],
    /// Its size and noise.
    pub extent: Extent<f32>,
}

impl Job<'_> {
    /// How many places there are.
    #[must_use]
    pub fn places(&self) -> u32 {
        end(self.columns)
    }
}

/// The index behind the last value.
fn end(columns: &[Column]) -> u32 {
    columns.last().map_or(0, |c| c.first + c.count)
}

/// Reads a whole job. Nothing moves before the checksum has been found to hold.
///
/// # Errors
/// See [`Fault`]; a job that says of a cubic nothing, or what another kind of controller wants, is out of order.
#[inline(never)]
pub fn read(bytes: impl Iterator<Item = u8>, memory: JobMemory<'_>, lfs: Lfs) -> Result<Job<'_>, Fault> {
    let mut segments = SliceStore::new(memory.segments);
    let mut columns = SliceStore::new(memory.columns);
    let mut paths = SliceStore::new(memory.paths);
    let mut arcs = SliceStore::new(memory.arcs);
    let mut values = SliceStore::new(memory.values);
    let (mut decoder, mut options) = (Decoder::new(), None);
    let mut here = Point::new(0.0, 0.0);
    for byte in bytes {
        let curve = match decoder.push(byte).map_err(Fault::Job)? {
            None => continue,
            // The stream of a serial line goes on: the job ends here.
            Some(Command::End) => break,
            Some(Command::Options(given)) => {
                options = Some(given);
                continue;
            }
            Some(Command::Begin { at: [x, y], closed }) => {
                here = Point::new(x, y);
                let (source, first) = (index(paths.items().len()), index(segments.items().len()));
                paths.push(Path { source, first, count: 0, closed })?;
                continue;
            }
            Some(told @ (Command::Table { values: count, corners } | Command::Places { places: count, corners })) => {
                if matches!(told, Command::Places { .. }) != (lfs == Lfs::Own) {
                    return Err(ORDER);
                }
                let first = end(columns.items());
                columns.push(Column { first, count: u32::from(count) })?;
                if let Some(segment) = segments.items_mut().last_mut() {
                    for (end, corner) in segment.ends.iter_mut().zip(corners) {
                        end.kind = if corner { JointKind::Corner } else { JointKind::Open };
                    }
                }
                if lfs == Lfs::Own {
                    given::join(segments.items_mut());
                    given::arc(segments.items_mut(), &mut arcs)?;
                }
                continue;
            }
            Some(Command::Values(given)) => {
                let end = end(columns.items());
                for v in given {
                    if index(values.items().len()) < end {
                        values.push(v)?;
                    }
                }
                continue;
            }
            Some(Command::Cut(t)) => {
                if !given::cut(segments.items_mut(), &mut arcs, t)? {
                    return Err(ORDER);
                }
                continue;
            }
            Some(Command::Line([x, y])) => Cubic::line(here, Point::new(x, y)),
            Some(Command::Cubic([a, b, c, d, e, f])) => {
                Cubic::new(here, Point::new(a, b), Point::new(c, d), Point::new(e, f))
            }
        };
        // The one before it has told where lfs is wanted.
        if columns.items().len() != segments.items().len() {
            return Err(ORDER);
        }
        here = *curve.end();
        let path = index(paths.items().len()).saturating_sub(1);
        segments.push(given::segment(index(segments.items().len()), path, curve, [false; 2]))?;
        if let Some(path) = paths.items_mut().last_mut() {
            path.count += 1;
        }
    }
    decoder.finish().map_err(Fault::Job)?;
    let options = options.ok_or(ORDER)?;
    if columns.items().len() != segments.items().len() {
        return Err(ORDER);
    }
    if segments.items().is_empty() {
        return Err(Fault::Empty);
    }
    let extent = Extent::of(segments.items());
    if extent.diagonal <= 0.0 {
        return Err(Fault::NoExtent);
    }
    Ok(Job {
        options,
        extent,
        segments: segments.into_items(),
        columns: columns.into_items(),
        paths: paths.into_items(),
        arcs: arcs.into_items(),
        values: values.into_items(),
    })
}

/// An index below the number of [`CUBICS`](crate::CUBICS) or [`VALUES`](crate::VALUES).
pub(crate) fn index(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}
