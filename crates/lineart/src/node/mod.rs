//! Noding: chains of samples become a planar graph.
//!
//! Real drawings cross themselves, end on other strokes, repeat strokes exactly, almost, or in part. A triangulator that
//! is given such chains as constraints drops some of them, or chases the slivers that rounding leaves between two copies.
//! Here the chains are cut first, so that no two edges meet but in a common vertex:
//!
//! ```text
//! chains ── meet     halved where curves come near each other; crossings put on both curves (Newton)
//!    │       └ track   paths by one parameter; hulls of their pieces
//!    └───── lattice  iterated snap rounding on whole numbers: exact signs, near vertices and copies merged
//!            └ pairs   boxes that overlap; cluster: points as good as one
//! ```
//!
//! **What is kept.** Every edge knows its owners: the paths it is a piece of, with the parameters at both its ends. So the
//! original cubics between two vertices can be had again, cut by parameter. Every vertex has two points: the lattice
//! point, of which all edges together are noded, and the point of the curve that it stands for; at a crossing that is one
//! point for both curves.
//!
//! **What is promised.** Edges meet in vertices only; no vertex is farther than the pitch from the chords of curves that are led
//! through it ([`Report::max_displacement`] says how far); strokes that run within three quarters of it become one; pieces that vanish are shorter than that. Chords are within an
//! eighth of the pitch of their curves wherever strokes come that near each other. The result is a function of the input
//! alone.
//!
//! **Cost.** O(n log n) for n vertices, plus the pairs of pieces whose boxes overlap: neighbours, crossings, and strokes
//! that lie on each other.
//!
//! ```
//! use lineart::node::{Chain, Options, node};
//!
//! let text = r#"<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0L2 2"/><path d="M0 2L2 0"/></svg>"#;
//! let drawing = lineart::svg::read_str(text, "cross.svg")?;
//! let chain = |path| Chain { path, closed: false, at: vec![0.0, 1.0] };
//! let noded = node(&drawing.paths, &[chain(0), chain(1)], &Options::new(1e-6))?;
//! assert_eq!((noded.vertices.len(), noded.edges.len()), (5, 4));
//! assert_eq!(noded.report.crossings, 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cluster;
mod lattice;
mod meet;
pub(crate) mod pairs;
mod track;

use std::fmt;

use feature_sampling::geometry::{Aabb, Point};

use self::meet::{Stop, Strand};
pub use self::track::Track;
use crate::drawing::DrawingPath;
use crate::export::{PathRows, SampleRow};

/// Samples of one path, as parameters along it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chain {
    /// Index of the path.
    pub path: usize,
    /// The last vertex is followed by the first, which is not repeated.
    pub closed: bool,
    /// Places on the path as numbers: the index of the cubic plus the parameter on it (see
    /// [`crate::stretch::Location::as_number`]). Increasing; on a closed chain they may start anywhere and run through the
    /// seam once, either as numbers beyond the number of cubics or starting again from 0.
    pub at: Vec<f64>,
}

impl Chain {
    /// The chains of a sampled drawing, one for each path that has samples.
    pub fn of_samples(paths: &[PathRows<SampleRow>]) -> Vec<Self> {
        let chain = |(path, rows): (usize, &PathRows<SampleRow>)| {
            let at = rows.rows.iter().map(|row| row.segment as f64 + row.t).collect();
            Self { path, closed: rows.closed, at }
        };
        paths.iter().enumerate().filter(|(_, rows)| !rows.rows.is_empty()).map(chain).collect()
    }
}

/// How to node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// No point is moved farther than this, in user units. The unit of the lattice is a quarter of it, or, where that would
    /// move something farther, a sixteenth or a sixty-fourth. Points and curves nearer than three quarters of it become one.
    pub pitch: f64,
    /// Rounds of snap rounding at most.
    pub rounds: usize,
    /// Vertices, or edges, at most.
    pub limit: usize,
}

impl Options {
    /// With this pitch, 30 rounds and ten million vertices at most.
    pub fn new(pitch: f64) -> Self {
        Self { pitch, rounds: 30, limit: 10_000_000 }
    }

    /// The usual pitch of a drawing: a millionth of its diagonal, or a hundredth of the smallest distance of samples if
    /// that is more.
    pub fn for_drawing(diagonal: f64, min_distance: Option<f64>) -> Self {
        Self::new((1e-6 * diagonal).max(min_distance.unwrap_or(0.0) / 100.0))
    }
}

/// A vertex of the graph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// The lattice point, in user units.
    pub point: Point<f64>,
    /// The point of the curves that it stands for, at most a pitch away: the sample, or the crossing of two curves. Where
    /// several samples became one vertex it is the first of them.
    pub exact: Point<f64>,
    /// The lattice point in units of the lattice ([`Noded::unit`]).
    pub place: [i64; 2],
}

/// A piece of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Owner {
    /// Index of the path.
    pub path: u32,
    /// Parameters on the path at the edge's two ends, numbers as in [`Chain::at`]; on closed paths they run on through the
    /// seam. Equal where the piece is shorter than doubles can tell.
    pub at: [f64; 2],
    /// The path runs from the edge's first end to its second; parameters do not decrease in that direction.
    pub forward: bool,
}

/// An edge between two different vertices, the lower index first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// Indices of vertices.
    pub ends: [u32; 2],
    first: u32,
    count: u32,
}

/// What noding did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    /// Crossings of curves at which both curves were cut.
    pub crossings: usize,
    /// Vertices that snap rounding added beyond those on the curves.
    pub vertices_added: usize,
    /// Owners beyond the first of each edge: pieces that lie on others.
    pub segments_merged: usize,
    /// Largest distance of a vertex from a chord that is led through it, in user units.
    pub max_displacement: f64,
    /// Rounds of snap rounding that changed something.
    pub rounds: usize,
}

/// The graph.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Noded {
    /// Its vertices; each is an end of an edge.
    pub vertices: Vec<Vertex>,
    /// Its edges, by their ends in order, each pair of vertices once.
    pub edges: Vec<Edge>,
    owners: Vec<Owner>,
    /// The unit of the lattice, in user units.
    pub unit: f64,
    /// What was done.
    pub report: Report,
}

impl Noded {
    /// The paths an edge is a piece of, at least one, in the order of the chains.
    pub fn owners(&self, edge: &Edge) -> &[Owner] {
        let first = edge.first as usize;
        self.owners.get(first..first + edge.count as usize).unwrap_or_default()
    }
}

/// Why chains could not be noded.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum NodeError {
    /// The pitch is not a positive number.
    Pitch(f64),
    /// The pitch is so small beside the drawing that lattice coordinates would not be exact.
    TooFine,
    /// A chain names a path that there is not, or its parameters do not increase along it.
    Chain {
        /// Index of the chain.
        chain: usize,
    },
    /// More vertices or edges than allowed.
    TooMany {
        /// [`Options::limit`].
        limit: usize,
    },
    /// Segments were still being cut after the last round.
    NotSettled {
        /// [`Options::rounds`].
        rounds: usize,
    },
}

impl fmt::Display for NodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pitch(pitch) => write!(f, "the pitch is {pitch}; it has to be a finite number above 0"),
            Self::TooFine => write!(f, "the pitch is too small beside the drawing"),
            Self::Chain { chain } => write!(f, "chain {chain} does not follow its path"),
            Self::TooMany { limit } => write!(f, "more than {limit} vertices are needed where strokes meet"),
            Self::NotSettled { rounds } => write!(f, "strokes that meet are not settled after {rounds} rounds"),
        }
    }
}

impl std::error::Error for NodeError {}

/// Nodes chains of a drawing's paths.
///
/// Chains may leave paths out; a path may have several. Chains of fewer than two vertices have no edges.
///
/// # Errors
/// [`NodeError`].
pub fn node(paths: &[DrawingPath], chains: &[Chain], options: &Options) -> Result<Noded, NodeError> {
    if !(options.pitch > 0.0 && options.pitch.is_finite()) {
        return Err(NodeError::Pitch(options.pitch));
    }
    let mut strands = Vec::with_capacity(chains.len());
    for (index, chain) in chains.iter().enumerate() {
        strands.push(strand(paths, chain).ok_or(NodeError::Chain { chain: index })?);
    }
    // The lattice starts at the corner of the drawing.
    let hulls = strands.iter().flat_map(|strand| paths.get(strand.path as usize)).flat_map(|path| &path.cubics);
    let bounds = Aabb::around(hulls.flat_map(|cubic| &cubic.points));
    if !strands.is_empty() && lattice::is_too_fine(&bounds, options) {
        return Err(NodeError::TooFine);
    }
    let crossings = meet::refine(&mut strands, &bounds.min, options)?;
    let mut noded = lattice::round(&strands, &bounds, options)?;
    noded.report.crossings = crossings;
    Ok(noded)
}

/// A chain with its points; `None` where it does not follow its path.
fn strand<'a>(paths: &'a [DrawingPath], chain: &Chain) -> Option<Strand<'a>> {
    let cubics = &paths.get(chain.path)?.cubics;
    let path = u32::try_from(chain.path).ok()?;
    let track = Track::new(cubics);
    let n = track.length();
    let mut stops: Vec<Stop> = Vec::with_capacity(chain.at.len() + 1);
    let mut turn = 0.0;
    for &given in &chain.at {
        let mut u = given + turn;
        if chain.closed && turn == 0.0 && stops.last().is_some_and(|last| u < last.u) {
            turn = n;
            u += n;
        }
        let far = stops
            .first()
            .map_or(if chain.closed { 2.0 * n } else { n }, |first| if chain.closed { first.u + n } else { n });
        if !(u >= 0.0 && u <= far) || stops.last().is_some_and(|last| u < last.u) {
            return None;
        }
        if stops.last().is_none_or(|last| u > last.u) {
            stops.push(Stop { u, point: track.eval(u) });
        }
    }
    if let Some(first) = stops.first().copied().filter(|_| chain.closed) {
        // A sample just before the seam may be the seam itself.
        stops.retain(|stop| stop.u < first.u + n);
        stops.push(Stop { u: first.u + n, point: first.point });
    }
    Some(Strand { track, path, closed: chain.closed, stops })
}
