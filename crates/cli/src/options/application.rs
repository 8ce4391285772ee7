//! Options of the applications: colouring, reconstruction, meshes, simulation.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lineart::mesh;
use lineart::mesh::drawn::Grading;
use lineart::reconstruct::Algorithm;
use lineart::units::Length;

use super::groups::{InputArg, ModelArgs, OutputArgs, SamplingArgs, above};
use crate::errors::Failure;
use crate::number_in::number;

/// Colour a drawing whose strokes leave gaps.
///
/// Hints say which colour belongs where: dots given on the command line, in a file, or dots and scribbles in a layer of the
/// drawing (any group with the id or Inkscape label “hints”). Colour does not cross strokes; where two colours meet in a
/// gap they meet at its narrowest place. What is outside the drawing takes part as a hint without colour.
///
/// The result is the drawing, unchanged, with a layer “fills” of Bézier outlines under the strokes, and without the layer
/// of hints. Without -o it goes to standard output.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample colour drawing.svg --hint 120,80,gold --hint 40,200,#c33 -o coloured.svg
  fsample colour drawing.svg --hints hints.csv -o coloured.svg       hints.csv: one \"x,y,colour\" per line
  fsample colour drawing.svg -o coloured.svg                         hints in the layer “hints”
  fsample colour drawing.svg --auto -o coloured.svg                  no hints: a colour for each room
  fsample colour drawing.svg --hint 120,80,gold --report regions.json --debug -o look.svg")]
pub(crate) struct ColourArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    /// The coloured drawing, SVG; - is standard output
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// A hint: a place and a colour (#rgb, #rrggbb, a CSS name, or none); may be repeated
    #[arg(long, value_name = "X,Y,COLOUR", allow_hyphen_values = true)]
    pub(crate) hint: Vec<String>,
    /// Hints, one "x,y,colour" per line; - is standard input
    #[arg(long, value_name = "FILE")]
    pub(crate) hints: Option<String>,
    /// Id or Inkscape label of the groups of the drawing that hold hints [default: hints]
    #[arg(long, value_name = "NAME")]
    pub(crate) hint_layer: Option<String>,
    /// Find rooms without hints and colour them from a palette; hints in the drawing are not used
    #[arg(long, conflicts_with_all = ["hint", "hints", "hint_layer"])]
    pub(crate) auto: bool,
    /// Colour does not enter rooms without a hint through openings narrower than L
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub(crate) max_gap: Option<Length>,
    /// Let each colour reach L/2 beyond its outline, under the strokes, so that no seam shows
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub(crate) bleed: Option<Length>,
    /// What becomes of regions that no hint reaches
    #[arg(long, value_enum, default_value_t = UnlabelledName::None)]
    pub(crate) unlabelled: UnlabelledName,
    /// What is outside the drawing is no hint: colour may leave through gaps
    #[arg(long)]
    pub(crate) no_outside: bool,
    /// With --auto: a room's entrance is narrower than this share of its widest passage
    #[arg(long, value_name = "G", default_value_t = 0.7, allow_negative_numbers = true)]
    pub(crate) gamma: f64,
    /// Write what was found: regions with their hints, areas and gaps, as JSON
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
    /// Add a layer with the triangulation and the gaps
    #[arg(long)]
    pub(crate) debug: bool,
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
}

/// What becomes of regions that no hint reaches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum UnlabelledName {
    /// They stay empty
    None,
    /// They take the colour with which they share most of their boundary
    Neighbour,
    /// They are coloured from a palette
    Auto,
}

/// Find the curves that points lie on.
///
/// Of points without order (one "x y" or "x,y" per line), finds which are neighbours along a curve. Nine published
/// algorithms are offered, and accord, which is our own; variants have names of their own. Each names the edges that it
/// finds as pairs of line numbers of points, from 0; among equal points the first stands for all.
///
/// Without -o, a table a,b goes to standard output; with --algorithm all it is algorithm,a,b.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample reconstruct points.txt --algorithm connect2d > edges.csv
  fsample reconstruct points.txt --algorithm all -o all.svg
  fsample reconstruct points.txt --algorithm crust --compare true-edges.csv
  fsample reconstruct points.txt --algorithm conservative-crust --disk-factor 0.8

With --compare the exit code is 1 if the edges of an algorithm differ.")]
pub(crate) struct ReconstructArgs {
    /// Points, one "x y" or "x,y" per line; - is standard input
    #[arg(value_name = "POINTS")]
    pub(crate) file: String,
    /// The algorithm; all: the nine and accord
    #[arg(long, short, value_name = "NAME", value_parser = algorithm_names())]
    pub(crate) algorithm: String,
    /// True edges, a table a,b: what is missing and what is extra is said
    #[arg(long, value_name = "EDGES")]
    pub(crate) compare: Option<String>,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    /// Nearest points that hnn-crust and hnn-crust-either look at [default: 14]
    #[arg(long, value_name = "N", help_heading = "Parameters", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) candidates: Option<u32>,
    /// Radius of conservative-crust's disks in half edges [default: 0.7071]
    #[arg(long, value_name = "F", help_heading = "Parameters", allow_negative_numbers = true)]
    pub(crate) disk_factor: Option<f64>,
    /// Distance from the medial axis that conservative-crust-medial asks for, in edges [default: 0.46]
    #[arg(long, value_name = "F", help_heading = "Parameters", allow_negative_numbers = true)]
    pub(crate) medial_factor: Option<f64>,
    /// No summary
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// The names that --algorithm takes.
fn algorithm_names() -> clap::builder::PossibleValuesParser {
    let names = Algorithm::ALL.iter().map(|algorithm| algorithm.name()).chain(["all"]);
    clap::builder::PossibleValuesParser::new(names.collect::<Vec<_>>())
}

/// Fill the rectangle around a drawing with triangles, along its lines.
///
/// The drawing is sampled, strokes that cross, touch or repeat each other are cut where they meet, and a rectangle around it
/// is triangulated: every line between samples is made of edges, no angle is below --min-angle (unless two lines meet at a
/// smaller one), no edge is longer than --max-edge. With --graded, triangles are small where the drawing has detail
/// (--lfs-factor) and grow with the distance from it (--growth).
///
/// Without -o, a table triangle,x0,y0,x1,y1,x2,y2 goes to standard output.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample mesh drawing.svg -o mesh.svg                    a picture
  fsample mesh drawing.svg --max-edge 3% -o mesh.msh      for gmsh and its readers
  fsample mesh drawing.svg --graded --max-edge 10% --epsilon 1 --min-distance 1% -o mesh.vtk
  fsample mesh drawing.svg --max-edge 2mm -o mesh.stl")]
pub(crate) struct MeshArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    #[command(flatten)]
    pub(crate) triangles: TriangleArgs,
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
}

/// Solve the Poisson problem −Δu = f around a drawing, with u given along its lines.
///
/// Meshes the drawing as `mesh` does and solves with linear elements. Lengths count in diagonals of the drawing, so that u
/// does not depend on its units. With --source 0 the values given along the lines are interpolated as smoothly as possible
/// (Laplace, steady heat, diffusion curves).
///
/// The value of a path is that of --path-value, else that of the attribute data-value of its element or of a group around
/// it, else that of --value. Without -o, a table vertex,x,y,u goes to standard output.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample simulate drawing.svg --max-edge 2% -o load.svg  a membrane under load, held along the lines
  fsample simulate drawing.svg --graded --max-edge 3% -o load.vtk
  fsample simulate drawing.svg --source 0 --path-value 0=1 --path-value wall=-1 -o heat.png
  fsample simulate drawing.svg --source 0 --value 1 --max-edge 2% > values.csv")]
pub(crate) struct SimulateArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    /// f, the same everywhere
    #[arg(long, value_name = "F", default_value_t = 1.0, allow_negative_numbers = true, help_heading = "Problem")]
    pub(crate) source: f64,
    /// u along paths that have no value of their own; none: they hold nothing
    #[arg(long, value_name = "V", default_value = "0", allow_hyphen_values = true, help_heading = "Problem")]
    pub(crate) value: GivenValue,
    /// u along a path, by its index or id; may be repeated
    #[arg(long, value_name = "PATH=V", allow_hyphen_values = true, help_heading = "Problem")]
    pub(crate) path_value: Vec<PathValue>,
    /// u along the rectangle; none: insulated
    #[arg(long, value_name = "V", default_value = "0", allow_hyphen_values = true, help_heading = "Problem")]
    pub(crate) frame_value: GivenValue,
    /// Lines of equal value in pictures
    #[arg(long, value_name = "N", default_value_t = 12, value_parser = clap::value_parser!(u16).range(0..=1000), help_heading = "Problem")]
    pub(crate) contours: u16,
    #[command(flatten)]
    pub(crate) triangles: TriangleArgs,
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
}

/// A finite number, or `none`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GivenValue(pub(crate) Option<f64>);

impl std::str::FromStr for GivenValue {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "none" { Ok(Self(None)) } else { number(text).map(|value| Self(Some(value))) }
    }
}

/// A path, by its index or its id, and a value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PathValue {
    pub(crate) path: String,
    pub(crate) value: GivenValue,
}

impl std::str::FromStr for PathValue {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        // An id may hold an equals sign, a number does not.
        let (path, value) = text.rsplit_once('=').ok_or("write PATH=VALUE")?;
        Ok(Self { path: path.to_owned(), value: value.parse()? })
    }
}

/// What triangles have to be like.
#[derive(Args, Debug)]
#[command(next_help_heading = "Triangles")]
pub(crate) struct TriangleArgs {
    /// Longest edge [default: no limit]
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub(crate) max_edge: Option<Length>,
    /// Smallest angle, in degrees, up to 33; beyond 20.7 it may take the limit of --max-vertices to end
    #[arg(long, value_name = "DEG", default_value_t = mesh::DEFAULT_MIN_ANGLE, allow_negative_numbers = true)]
    pub(crate) min_angle: f64,
    /// Small triangles at small features, at ends and at corners, growing with the distance from them
    #[arg(long)]
    pub(crate) graded: bool,
    /// Graded: a triangle at a sample may be as large as its lfs, times this [default: 16, but no smaller than at ends of strokes]
    #[arg(long, value_name = "A", requires = "graded", allow_negative_numbers = true)]
    pub(crate) lfs_factor: Option<f64>,
    /// Graded: what a unit of distance from such a place adds
    #[arg(long, value_name = "B", default_value_t = Grading::default().growth, requires = "graded", allow_negative_numbers = true)]
    pub(crate) growth: f64,
    /// Move vertices inside to more even places, N times over, where no bound breaks
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(0..=1000))]
    pub(crate) smooth: u16,
    /// Give up (exit code 5) where more vertices are needed
    #[arg(long, value_name = "N", default_value_t = 2_000_000, value_parser = clap::value_parser!(u32).range(1..=200_000_000))]
    pub(crate) max_vertices: u32,
}

impl TriangleArgs {
    /// What can be said without the drawing.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        let most = mesh::LARGEST_MIN_ANGLE;
        if !(0.0..=most).contains(&self.min_angle) {
            let angle = self.min_angle;
            return Err(Failure::usage(format!("--min-angle is {angle}; it lies between 0 and {most} degrees")));
        }
        self.lfs_factor.map_or(Ok(()), |factor| above("lfs-factor", 0.0, factor).map(drop))?;
        above("growth", 0.0, self.growth)?;
        self.max_edge.map_or(Ok(()), |length| above("max-edge", 0.0, length.value()).map(drop))
    }
}
