//! Boundaries as Béziers: the drawing's own cubics, cut where regions meet.
//!
//! Consecutive steps along one path whose parameters follow each other are one run, and a run is the original cubics
//! between its two parameters, split by de Casteljau. Runs start and end in the points of vertices, which all regions that
//! meet there share to the bit. Between runs a gap is closed (`closing`).

use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::Point;

use super::closing::Closings;
use super::plane::Plane;
use super::region::Step;
use crate::node::{Owner, Track};

/// A piece of an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Piece {
    /// A cubic.
    Cubic(Cubic<f64>),
    /// A straight line to a point.
    Line(Point<f64>),
}

/// A closed outline.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Where it starts and ends.
    pub start: Point<f64>,
    /// Its pieces; the last one ends at the start.
    pub pieces: Vec<Piece>,
}

/// A step along a path.
#[derive(Clone, Copy, Debug)]
struct Run {
    path: u32,
    /// Parameters in the direction of the loop.
    from: f64,
    to: f64,
    forward: bool,
    end: u32,
}

enum Part {
    Chain(Run),
    Gap { from: u32, to: u32, side: u32 },
}

/// The outline of a loop.
pub(super) fn outline(plane: &Plane<'_>, steps: &[Step], closings: &Closings) -> Outline {
    let mut parts: Vec<Part> = Vec::new();
    for step in steps {
        let chain = plane.sides[step.side as usize].chain;
        let Some(edge) = plane.noded.edges.get(chain as usize) else {
            parts.push(Part::Gap { from: step.from, to: step.to, side: step.side });
            continue;
        };
        let along = edge.ends[0] == step.from;
        let runs = plane.noded.owners(edge).iter().map(|owner| {
            let Owner { path, at: [a, b], forward } = *owner;
            let (from, to) = if along { (a, b) } else { (b, a) };
            Run { path, from, to, forward: forward == along, end: step.to }
        });
        let mut runs = runs.collect::<Vec<_>>().into_iter();
        // Go on along the same path if one of the owners does.
        let continued = match parts.last() {
            Some(Part::Chain(last)) => runs.clone().find_map(|run| join(plane, last, &run)),
            _ => None,
        };
        match continued {
            Some(run) => {
                parts.pop();
                parts.push(Part::Chain(run));
            }
            None => parts.extend(runs.next().map(Part::Chain)),
        }
    }
    // The loop may have been entered in the middle of a run.
    if parts.len() > 1
        && let (Some(Part::Chain(last)), Some(Part::Chain(first))) = (parts.last(), parts.first())
        && let Some(run) = join(plane, last, first)
    {
        parts.pop();
        parts[0] = Part::Chain(run);
        // Then it starts where that run starts.
        let start = steps.first().map_or(0, |_| run.end);
        parts.rotate_left(1);
        let start_point = plane.point(start);
        return emit(plane, &parts, start_point, closings);
    }
    let start = steps.first().map_or_else(Point::default, |step| plane.point(step.from));
    emit(plane, &parts, start, closings)
}

/// Two runs that follow each other along one path, as one.
fn join(plane: &Plane<'_>, first: &Run, second: &Run) -> Option<Run> {
    if first.path != second.path || first.forward != second.forward {
        return None;
    }
    let path = plane.paths.get(first.path as usize)?;
    let n = path.cubics.len() as f64;
    // Around the seam of a closed path parameters start again.
    let turn = if second.forward && second.from < first.to - 0.5 * n {
        n
    } else if !second.forward && second.from > first.to + 0.5 * n {
        -n
    } else {
        0.0
    };
    let (from, to) = (second.from + turn, second.to + turn);
    // Pieces shorter than the lattice can show have been dropped between them. A small loop of the path that ends in this
    // same vertex is no such piece: it leaves on the way.
    let forwards = if first.forward { from >= first.to - 1e-9 } else { from <= first.to + 1e-9 };
    let track = Track::new(&path.cubics);
    let vertex = track.eval_around(first.to);
    let between = (1..=8).map(|i| first.to + (from - first.to) * f64::from(i) / 8.0);
    let near = between.into_iter().all(|u| track.eval_around(u).distance(&vertex) <= 8.0 * plane.unit);
    (forwards && near && (from - first.to).abs() < 0.25 && (to - first.from).abs() <= n).then_some(Run {
        to,
        end: second.end,
        ..*first
    })
}

fn emit(plane: &Plane<'_>, parts: &[Part], start: Point<f64>, closings: &Closings) -> Outline {
    let mut pieces: Vec<Piece> = Vec::new();
    let mut here = start;
    for part in parts {
        match part {
            Part::Gap { from, to, side } => {
                let end = plane.point(*to);
                pieces.push(match closings.get(side) {
                    Some(&[a, b]) if from < to => Piece::Cubic(Cubic::new(here, a, b, end)),
                    Some(&[a, b]) => Piece::Cubic(Cubic::new(here, b, a, end)),
                    None => Piece::Line(end),
                });
                here = end;
            }
            Part::Chain(run) => {
                let end = plane.point(run.end);
                let mut cubics = curve(plane, run);
                let count = cubics.len();
                for (i, cubic) in cubics.iter_mut().enumerate() {
                    cubic.points[0] = here;
                    if i + 1 == count {
                        cubic.points[3] = end;
                    }
                    here = cubic.points[3];
                }
                if cubics.is_empty() && here != end {
                    pieces.push(Piece::Line(end));
                    here = end;
                }
                pieces.extend(cubics.into_iter().map(|cubic| {
                    if crate::stretch::is_straight(&cubic) { Piece::Line(cubic.points[3]) } else { Piece::Cubic(cubic) }
                }));
            }
        }
    }
    Outline { start, pieces }
}

/// The cubics of a run in the direction of the loop.
fn curve(plane: &Plane<'_>, run: &Run) -> Vec<Cubic<f64>> {
    let Some(path) = plane.paths.get(run.path as usize) else { return Vec::new() };
    let n = path.cubics.len() as f64;
    let (mut low, mut high) = if run.forward { (run.from, run.to) } else { (run.to, run.from) };
    while low < 0.0 {
        (low, high) = (low + n, high + n);
    }
    while low >= n {
        (low, high) = (low - n, high - n);
    }
    let cubics: Vec<Cubic<f64>> = Track::new(&path.cubics).cubics(low, high).collect();
    if run.forward { cubics } else { cubics.iter().rev().map(Cubic::reversed).collect() }
}
