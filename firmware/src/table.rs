//! Tier 1: the controller of a job that brings its lfs along.
//!
//! The host has taken the drawing through the door and computed lfs; the controller keeps cubics and values
//! ([`fsample_job`], commands 5 and 6), and samples and draws as the larger one does. It has neither door nor medial axis.

use crate::{CUBICS, Fault, Listener, Totals, draw_paths};
use feature_sampling::bezier::Cubic;
use feature_sampling::buffer::{SliceStore, Store};
use feature_sampling::curve::given::{self, Extent};
use feature_sampling::curve::{Curve, JointKind, Path, Segment};
use feature_sampling::geometry::Point;
use feature_sampling::lfs::table::{Column, LfsTable};
use fsample_job::{Command, Decoder, JobError, JobOptions, expand};

/// Values of lfs that a job may bring: 32 a cubic.
pub const VALUES: usize = 32 * CUBICS;

/// Memory for a job; each slice has as many entries as said.
#[derive(Debug)]
pub struct TableMemory<'a> {
    /// [`SEGMENTS`](crate::SEGMENTS).
    pub segments: &'a mut [Segment<f32>],
    /// [`SEGMENTS`](crate::SEGMENTS).
    pub columns: &'a mut [Column],
    /// [`PATHS`](crate::PATHS).
    pub paths: &'a mut [Path],
    /// [`VALUES`].
    pub values: &'a mut [u16],
}

/// What [`receive`] found.
#[derive(Debug)]
pub struct Received<'a> {
    options: JobOptions,
    segments: &'a [Segment<f32>],
    columns: &'a [Column],
    paths: &'a [Path],
    values: &'a [u16],
}

/// Reads a whole job. Nothing moves before the checksum has been found to hold.
///
/// # Errors
/// See [`Fault`]; a job without lfs along every cubic is out of order.
pub fn receive(bytes: impl Iterator<Item = u8>, memory: TableMemory<'_>) -> Result<Received<'_>, Fault> {
    let mut segments = SliceStore::new(memory.segments);
    let mut columns = SliceStore::new(memory.columns);
    let mut paths = SliceStore::new(memory.paths);
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
            Some(Command::Table { values: count, corners }) => {
                let first = index(values.items().len());
                if let (Some(column), Some(segment)) = (columns.items_mut().last_mut(), segments.items_mut().last_mut())
                {
                    *column = Column { first, count: u32::from(count) };
                    for (end, corner) in segment.ends.iter_mut().zip(corners) {
                        end.kind = if corner { JointKind::Corner } else { JointKind::Open };
                    }
                }
                continue;
            }
            Some(Command::Values(given)) => {
                let end = columns.items().last().map_or(0, |c| c.first + c.count);
                for v in given {
                    if index(values.items().len()) < end {
                        values.push(v)?;
                    }
                }
                continue;
            }
            Some(Command::Line([x, y])) => Cubic::line(here, Point::new(x, y)),
            Some(Command::Cubic([a, b, c, d, e, f])) => {
                Cubic::new(here, Point::new(a, b), Point::new(c, d), Point::new(e, f))
            }
        };
        here = *curve.end();
        let path = index(paths.items().len()).saturating_sub(1);
        segments.push(given::segment(index(segments.items().len()), path, curve, [false; 2]))?;
        columns.push(Column::default())?;
        if let Some(path) = paths.items_mut().last_mut() {
            path.count += 1;
        }
    }
    decoder.finish().map_err(Fault::Job)?;
    let options = options.ok_or(Fault::Job(JobError::Order))?;
    if columns.items().iter().any(|c| c.count == 0) {
        return Err(Fault::Job(JobError::Order));
    }
    Ok(Received {
        options,
        segments: segments.into_items(),
        columns: columns.into_items(),
        paths: paths.into_items(),
        values: values.into_items(),
    })
}

/// An index below the number of [`SEGMENTS`](crate::SEGMENTS), [`PATHS`](crate::PATHS) or [`VALUES`].
fn index(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

/// Draws a received job. `budget` is the number of turns of a call of the sampler.
///
/// # Errors
/// See [`Fault`].
pub fn draw(received: &Received<'_>, budget: u32, listener: &mut impl Listener) -> Result<Totals, Fault> {
    let Received { options, segments, columns, paths: list, values } = received;
    let extent = Extent::of(segments);
    let curve = Curve {
        segments,
        sources: &[],
        paths: list,
        arcs: &[],
        nodes: &[],
        leaf: 1,
        diagonal: &extent.diagonal,
        noise: &extent.noise,
    };
    let table = LfsTable::new(&curve, columns, |k| values.get(k as usize).copied().map_or(0.0, expand));
    let totals = Totals { segments: index(segments.len()), medial: index(values.len()), ..Totals::default() };
    draw_paths(&curve, &table, options, budget, totals, listener)
}
