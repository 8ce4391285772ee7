//! Colouring of line art whose strokes leave gaps.
//!
//! Hints say which colour belongs where: dots or scribbles. Strokes stop colour; through the gaps between them two colours
//! meet where the passage is narrowest, so that no threshold says what a gap is. The result is vector art again: outlines
//! of the drawing's own cubics, cut by parameter where regions meet. (Paper, Section 5.1; the rule of the flow is Delaunay
//! Painting's, Parakkat, Memari and Cani, 2022.)
//!
//! ```text
//! plane    the noded samples, triangulated in a frame; made once for a drawing
//! label    hints → flood (a maximum spanning forest over the faces), auto (seeds where there are no hints) → regions
//! region   faces of one colour, their boundary loops       closing  gaps between regions       outline  loops as Béziers
//! ```
//!
//! **Samples.** In an ε-sample neighbouring samples are nearer to each other than to other strokes, so that chains are
//! Delaunay edges wherever curves are smooth and apart; noding sees to the rest. Colour never crosses an edge of a chain.
//!
//! **Limits.** Colour leaves a shape through a gap that is wider than the shape is inside; hint what is outside of it then.
//! A corridor narrower than a gap elsewhere takes the colour from beyond unless it is hinted, and so does a region without
//! a hint.

mod auto;
mod closing;
mod flood;
mod hint;
mod label;
mod outline;
mod plane;
mod region;
mod report;
mod write;

use std::fmt;

use feature_sampling::geometry::Point;

pub use self::auto::Auto;
pub use self::hint::{Colour, Hint, HintError, PALETTE, from_layer, parse_hints};
pub use self::label::Labels;
pub use self::outline::{Outline, Piece};
use self::plane::NONE;
pub use self::plane::Plane;
pub use self::report::report;
pub use self::write::{Layers, insert};
use crate::drawing::DrawingPath;
use crate::node::{Chain, NodeError, Options as NodeOptions};

/// What happens to regions that no hint reaches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Unlabelled {
    /// They stay empty.
    #[default]
    None,
    /// They take the colour with which they share most of their boundary.
    Neighbour,
    /// They are found and coloured as if there were no hints at all.
    Auto,
}

/// How to colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// What is outside the drawing takes part as a hint without colour.
    pub outside: bool,
    /// Colour does not enter rooms without a hint through openings narrower than this; 0 for none.
    pub max_gap: f64,
    /// Regions that no hint reaches.
    pub unlabelled: Unlabelled,
    /// How rooms are found without hints.
    pub auto: Auto,
}

impl Default for Options {
    fn default() -> Self {
        Self { outside: true, max_gap: 0.0, unlabelled: Unlabelled::None, auto: Auto::default() }
    }
}

/// A gap that two regions meet in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Its two ends, on strokes.
    pub ends: [Point<f64>; 2],
    /// Its length.
    pub length: f64,
}

/// A region of one colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Its colour; none if it is left empty.
    pub colour: Option<Colour>,
    /// Area of its faces, in square user units: that of the polygon of samples.
    pub area: f64,
    /// Outer outline and holes, to be filled by the even-odd rule. Regions without colour have outlines too.
    pub outlines: Vec<Outline>,
    /// Indices of the hints in it.
    pub hints: Vec<usize>,
    /// Gaps through which it touches other regions.
    pub gaps: Vec<Gap>,
    /// It reaches the frame: it is outside.
    pub outside: bool,
}

/// A coloured drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Painting {
    /// Regions, by their first face.
    pub regions: Vec<Region>,
    /// What a user should know: hints in conflict, hints on strokes.
    pub warnings: Vec<String>,
    /// Corners of all triangles, for a picture of the triangulation.
    pub triangles: Vec<[Point<f64>; 3]>,
}

/// Why a drawing could not be coloured.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ColourError {
    /// The samples could not be noded.
    Node(NodeError),
    /// There is no stroke.
    Empty,
    /// The triangulator refused the noded samples.
    Triangulation,
}

impl fmt::Display for ColourError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Node(error) => error.fmt(f),
            Self::Empty => write!(f, "there is no stroke long enough to bound a colour"),
            Self::Triangulation => write!(f, "its strokes cannot be triangulated"),
        }
    }
}

impl std::error::Error for ColourError {}

/// Colours a drawing: makes the plane, colours it, and samples more densely where a gap's straight closing would cut
/// through a curve.
///
/// # Errors
/// [`ColourError`].
pub fn colour(
    paths: &[DrawingPath],
    chains: &[Chain],
    node_options: &NodeOptions,
    hints: &[Hint],
    options: &Options,
) -> Result<Painting, ColourError> {
    // Each round halves the pieces that bulge too far: their bulges fall to a quarter.
    const ROUNDS: usize = 6;
    let mut chains = chains.to_vec();
    for round in 0..=ROUNDS {
        let plane = Plane::new(paths, &chains, node_options)?;
        let labels = plane.label(hints, options);
        let bulges = closing::bulges(&plane, &labels.region_of);
        if bulges.is_empty() || round == ROUNDS {
            return Ok(plane.finish(&labels, hints));
        }
        for (path, u) in bulges {
            for chain in chains.iter_mut().filter(|chain| chain.path == path) {
                add_sample(chain, u, paths[path].cubics.len() as f64);
            }
        }
    }
    Err(ColourError::Triangulation)
}

fn add_sample(chain: &mut Chain, u: f64, n: f64) {
    let Some(&first) = chain.at.first() else { return };
    // Parameters of a closed chain in one turn from its first sample on.
    for v in &mut chain.at {
        if *v < first {
            *v += n;
        }
    }
    let u = if u < first { u + n } else { u };
    if let Err(place) = chain.at.binary_search_by(|v| v.total_cmp(&u)) {
        chain.at.insert(place, u);
    }
}

impl Plane<'_> {
    /// Outlines and everything else that is said of regions.
    pub fn finish(&self, labels: &Labels, hints: &[Hint]) -> Painting {
        let count = labels.colours.len();
        let closings = closing::closings(self, &labels.region_of);
        let loops = region::loops(self, &labels.region_of, count);
        let mut areas = vec![0.0; count];
        labels.region_of.iter().zip(0..).for_each(|(region, face)| areas[*region as usize] += self.area(face));
        let mut warnings = labels.warnings.clone();
        for (index, hint) in hints.iter().enumerate() {
            if let [p] = hint.points.as_slice()
                && self.is_on_stroke(p)
            {
                warnings.push(format!("hint {} is on a stroke", index + 1));
            }
        }
        let regions = loops.into_iter().zip(&labels.colours).zip(&labels.hints).zip(areas);
        let regions = regions.map(|(((loops, colour), hints), area)| {
            let steps = || loops.iter().flatten();
            let gap = |step: &region::Step| Gap {
                ends: [self.point(step.from), self.point(step.to)],
                length: self.length(step.side),
            };
            let open = |step: &&region::Step| step.beyond != NONE && self.sides[step.side as usize].chain == NONE;
            Region {
                colour: colour.clone(),
                area,
                outlines: loops.iter().map(|steps| outline::outline(self, steps, &closings)).collect(),
                hints: hints.clone(),
                gaps: steps().filter(open).map(gap).collect(),
                outside: steps().any(|step| step.beyond == NONE),
            }
        });
        let triangles = self.faces.iter().map(|face| face.corners.map(|v| self.point(v)));
        Painting { regions: regions.collect(), warnings, triangles: triangles.collect() }
    }

    /// Within a billionth of the drawing's size of a stroke.
    fn is_on_stroke(&self, p: &Point<f64>) -> bool {
        let extent = self.places.iter().map(|place| place[0].abs().max(place[1].abs())).max().unwrap_or(0) as f64;
        self.noded.edges.iter().any(|edge| {
            let [a, b] = edge.ends.map(|v| self.point(v));
            let chord = b.minus(&a);
            let share = (p.minus(&a).dot(&chord) / chord.norm_sq()).clamp(0.0, 1.0);
            a.plus_scaled(&share, &chord).distance(p) <= 1e-9 * extent * self.unit
        })
    }
}
