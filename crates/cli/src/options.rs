//! The command line: what can be asked, and what can be asked together.
//!
//! clap checks names and forms. Whether values make sense (ε above zero, a smallest distance not above the largest) is
//! checked in [`ModelArgs::check`] and [`SamplingArgs::bounds`], so that the message can say what would be right. All of
//! these are usage errors, exit code 2; lengths can only be compared once the drawing says how long a millimetre is.

use std::ffi::OsString;
use std::num::NonZero;
use std::path::PathBuf;

use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use fsample_experiments::shard::Shard;
use fsample_experiments::study::Grid;
use lineart::drawing::Drawing;
use lineart::export::OptionValue;
use lineart::mesh;
use lineart::reconstruct::Algorithm;
use lineart::units::Length;

use crate::engine::{Bounds, Density, Effort, ModelOptions};
use crate::errors::Failure;
use crate::number_in::number;

/// Local feature size, medial axis and ε-samples of vector line art.
///
/// Reads an SVG drawing (or a CSV of control points), works out how near each of its points is to the drawing's medial
/// axis, and places points along the curves: dense where there is detail, sparse where there is none.
///
/// Coordinates are the user units of the root viewBox, y downwards. A length L is a plain number (user units) or a
/// number with mm, cm, in, px, pt, or % (of the diagonal of the drawing's control points).
#[derive(Parser, Debug)]
#[command(name = "fsample", version, arg_required_else_help = true, max_term_width = 100)]
#[command(after_help = "\
Examples:
  fsample sample drawing.svg -o samples.svg
  fsample sample drawing.svg --epsilon 0.3 --chord-error 0.1mm --min-distance 0.05mm -o plot.gcode
  fsample inspect drawing.svg

Exit codes: 0 done; 1 the answer is no; 2 usage; 3 bad input; 4 output could not be written;
5 gave up at a limit that an option can raise.")]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// One command and its options.
#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    Sample(SampleArgs),
    Medial(MedialArgs),
    Lfs(LfsArgs),
    Certify(CertifyArgs),
    Inspect(InspectArgs),
    Colour(ColourArgs),
    Compare(CompareArgs),
    Reconstruct(ReconstructArgs),
    Mesh(MeshArgs),
    Simulate(SimulateArgs),
    Reproduce(ReproduceArgs),
    Roots(RootsArgs),
    Nearest(NearestArgs),
    Completions(CompletionsArgs),
    Man(ManArgs),
}

/// Place points along the curves of a drawing.
///
/// Every point p of a curve gets a sample nearer than ε times the local feature size at p, with as few samples as that
/// takes. More bounds can be added; each sample says which one decided it. Path ends and corners are always samples;
/// next in rank comes --min-distance, then the upper bounds.
///
/// Without -o, a table path,segment,t,x,y,lfs,bound goes to standard output.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample sample drawing.svg                              a table on standard output
  fsample sample drawing.svg -o samples.svg               a picture in layers
  fsample sample drawing.svg --epsilon 0.66 -o points.ply for a mesher
  fsample sample drawing.svg --certified                  proved to be an ε-sample
  fsample sample drawing.svg --chord-error 0.1mm --min-distance 0.05mm --feed 2000 -o plot.gcode
  fsample sample - --format json < drawing.svg            from and to a pipe")]
pub(crate) struct SampleArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    /// Prove the result: with every rounding accounted for, each point of the curves has a sample as near as --epsilon says.
    /// Samples that cannot be proved are not written, and the exit code is 1
    #[arg(long, conflicts_with = "rho")]
    pub(crate) certified: bool,
    #[command(flatten)]
    pub(crate) effort: EffortArgs,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    /// Layers of an SVG result, from drawing, lfs, medial, samples
    #[arg(long, value_name = "NAMES", value_delimiter = ',', help_heading = "SVG")]
    pub(crate) layers: Option<Vec<Layer>>,
    #[command(flatten)]
    pub(crate) plotter: PlotterArgs,
}

/// Compute the medial axis of a drawing, as polylines.
///
/// Each row is a foot point on a curve with the centre of the largest empty disk that touches the curve there, on one
/// side. Directions without a bounded disk have no row.
///
/// Without -o, a table path,segment,t,x,y,side,mx,my,radius,polyline goes to standard output.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample medial drawing.svg -o medial.svg
  fsample medial drawing.svg --steps 1000 > medial.csv")]
pub(crate) struct MedialArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
}

/// Compute the local feature size: the distance to the medial axis.
///
/// By default at every foot point of the medial axis; with --at, at the given points. For these the path, segment and
/// parameter are those of the nearest point of the drawing.
///
/// Without -o, a table path,segment,t,x,y,lfs goes to standard output.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample lfs drawing.svg -o lfs.svg                      the curves, coloured
  fsample lfs drawing.svg --at points.txt > lfs.csv       points.txt: one \"x y\" or \"x,y\" per line
  echo 10 20 | fsample lfs drawing.svg --at -")]
pub(crate) struct LfsArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    /// Points to ask about, one "x y" or "x,y" per line; - is standard input
    #[arg(long, value_name = "POINTS")]
    pub(crate) at: Option<String>,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
}

/// Prove that samples are an ε-sample of a drawing, or find a point where they are not.
///
/// Every point p of a curve must have a sample nearer than ε times the local feature size at p (or than the floor that
/// holds where that falls to 0). The answer is proved in rounded-outwards arithmetic for all points at once: proved, refuted
/// (with a point) or unknown. Without --samples, samples are placed first, with some slack, so that they can be proved.
///
/// The exit code is 0 for proved and 1 otherwise.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample certify drawing.svg --epsilon 0.5
  fsample sample drawing.svg --epsilon 0.495 > s.csv && fsample certify drawing.svg --samples s.csv --epsilon 0.5
  fsample certify drawing.svg --epsilon 0.5 -o certificate.json
  fsample certify drawing.svg --check certificate.json")]
pub(crate) struct CertifyArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    /// Samples to judge, as fsample sample writes them (csv); - is standard input
    #[arg(long, value_name = "CSV")]
    pub(crate) samples: Option<String>,
    /// What is to be proved: a sample nearer than E times the local feature size, everywhere
    #[arg(long, value_name = "E", allow_negative_numbers = true, required_unless_present = "check")]
    pub(crate) epsilon: Option<f64>,
    /// A distance that is near enough in any case, to one of the two neighbours along the path
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub(crate) min_distance: Option<Length>,
    #[command(flatten)]
    pub(crate) effort: EffortArgs,
    /// Write the certificate to this file, as JSON
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Re-check this certificate of the drawing instead: evaluate every claim in it, and search for nothing. With --epsilon or
    /// --samples, it must be about no larger ε and about these samples; - is standard input
    #[arg(long, value_name = "JSON", conflicts_with_all = ["min_distance", "slack", "max_cells", "output"])]
    pub(crate) check: Option<String>,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
}

impl CertifyArgs {
    /// ε and what may be spent, if all options make sense without the drawing.
    pub(crate) fn check(&self) -> Result<(f64, Effort), Failure> {
        let epsilon = self.epsilon.unwrap_or_default();
        share("epsilon", epsilon)?;
        if let Some(length) = self.min_distance {
            above("min-distance", 0.0, length.value())?;
        }
        Ok((epsilon, self.effort.check()?))
    }

    /// The floor in user units.
    pub(crate) fn min_distance(&self, drawing: &Drawing, diagonal: f64) -> Result<Option<f64>, Failure> {
        self.min_distance.map(|l| resolve("min-distance", l, drawing.user_units_per_mm, diagonal)).transpose()
    }
}

/// What may be spent on a proof.
#[derive(Args, Debug)]
pub(crate) struct EffortArgs {
    /// Where samples are placed to be proved: aim this share below ε [default: 0.01]
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true)]
    pub(crate) slack: Option<f64>,
    /// Answer unknown where more cells of the foot set would be needed [default: 4000000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) max_cells: Option<u32>,
}

impl SampleArgs {
    /// ε and what may be spent, if the result is to be proved.
    pub(crate) fn proof(&self) -> Result<Option<(f64, Effort)>, Failure> {
        if self.certified {
            return Ok(Some((self.sampling.epsilon.unwrap_or(0.5), self.effort.check()?)));
        }
        match self.effort {
            EffortArgs { slack: None, max_cells: None } => Ok(None),
            _ => Err(Failure::usage("--slack and --max-cells are for --certified")),
        }
    }
}

impl EffortArgs {
    fn check(&self) -> Result<Effort, Failure> {
        let slack = self.slack.unwrap_or(0.01);
        if slack > 0.0 && slack < 1.0 {
            Ok(Effort { slack, cells: self.max_cells.unwrap_or(4_000_000) })
        } else {
            Err(Failure::usage(format!("--slack is {slack}; it lies between 0 and 1")))
        }
    }
}

/// Tell what is in a drawing and what would be made of it.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample inspect drawing.svg
  fsample inspect drawing.svg --format json")]
pub(crate) struct InspectArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    /// The form of the answer
    #[arg(long, value_enum, default_value_t = InspectFormat::Text)]
    pub(crate) format: InspectFormat,
    /// Joints that turn by less are smooth, in degrees
    #[arg(long, value_name = "DEG", default_value_t = 1.0, allow_negative_numbers = true)]
    pub(crate) corner_angle: f64,
    /// No warnings on standard error
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// Forms of `inspect`'s answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum InspectFormat {
    Text,
    Json,
}

/// Set ε-samples beside other ways to flatten the same drawing.
///
/// For each method: points; the largest distance of the curve from its chords; chords that are missing from the
/// Delaunay triangulation of the points; grading, the largest ratio of two neighbouring gaps; the smallest and largest
/// gap. Methods: ε-samples, alone and with the chord error bounded; greedy chords of the same error; the fewest equal
/// steps per cubic of the same error; pieces of equal length, as vpype reads curves; the splitter that plotter firmware
/// (Marlin, grblHAL) runs on a G5 command.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample compare drawing.svg
  fsample compare drawing.svg --diagonal 150mm --min-distance 0.05mm
  fsample compare drawing.svg --format csv > compare.csv")]
pub(crate) struct CompareArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    /// The form of the answer
    #[arg(long, value_enum, default_value_t = CompareFormat::Text)]
    pub(crate) format: CompareFormat,
    /// Share of the local feature size that separates samples at most
    #[arg(long, value_name = "E", default_value_t = 0.5, allow_negative_numbers = true)]
    pub(crate) epsilon: f64,
    /// Chord error of the methods that bound it
    #[arg(long, value_name = "L", default_value = "0.1mm", allow_negative_numbers = true)]
    pub(crate) chord_error: Length,
    /// Smallest distance between neighbouring ε-samples
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub(crate) min_distance: Option<Length>,
    /// Length of the pieces of the method that makes pieces of equal length
    #[arg(long, value_name = "L", default_value = "0.1mm", allow_negative_numbers = true)]
    pub(crate) piece: Length,
    /// Take the drawing to be of such a size that its diagonal has this physical length
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub(crate) diagonal: Option<Length>,
    /// Give up (exit code 5) where one path would need more ε-samples
    #[arg(long, value_name = "N", default_value_t = 10_000_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) max_samples: u32,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
}

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

/// Forms of `compare`'s answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum CompareFormat {
    Text,
    Csv,
    Json,
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
/// smaller one), no edge is longer than --max-edge. With --graded, triangles are small where the drawing has detail and grow
/// with the distance from it.
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
        self.max_edge.map_or(Ok(()), |length| above("max-edge", 0.0, length.value()).map(drop))
    }
}

/// Compute the tables and figures of the paper again.
///
/// Each experiment runs on the curves given with --curve; without, on drawings that come with the program, and its tables
/// say so. Into the folder -o go Markdown, JSON, one CSV per table and SVG plots; without -o the first table goes to
/// standard output as CSV. Long experiments can be spread: each machine runs its --shard, and --merge makes the report
/// from what they found, under the same curves and options.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample reproduce table2 --quick
  fsample reproduce table2 --curve bunny.svg --curve complex.svg --curve spiral.svg -o results
  fsample reproduce table2 --curve a.svg --curve b.svg --shard 1/2 -o parts
  fsample reproduce table2 --curve a.svg --curve b.svg --merge parts/table2.shard-*.csv -o results")]
pub(crate) struct ReproduceArgs {
    /// The experiments
    #[arg(value_enum, required = true, value_name = "NAME")]
    pub(crate) experiment: Vec<ExperimentName>,
    /// A curve (as IN of other commands); may be repeated
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub(crate) curve: Vec<String>,
    /// Do only part I of N
    #[arg(long, value_name = "I/N", conflicts_with = "merge")]
    pub(crate) shard: Option<Shard>,
    /// Compute nothing; put these parts together
    #[arg(long, value_name = "FILES", num_args = 1..)]
    pub(crate) merge: Vec<PathBuf>,
    /// The folder for results; it is made where there is none
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// Sample sets to study beside our own (table3, figure7): “set E O N”, then N lines “x y”; may be xz-compressed
    #[arg(long, value_name = "FILE", help_heading = "Reconstruction")]
    pub(crate) samples: Option<PathBuf>,
    /// Distance of the values of ε that are studied (table3, figure7), a multiple of 0.001 [default: 0.01]
    #[arg(long, value_name = "S", help_heading = "Reconstruction", allow_negative_numbers = true)]
    pub(crate) epsilon_step: Option<f64>,
    /// Starts of the samples of each ε (table3, figure7) [default: 100]
    #[arg(long, value_name = "N", help_heading = "Reconstruction", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) starts: Option<u32>,
    /// PNG images of shapes, or folders of them (figure6)
    #[arg(long, value_name = "FILES", num_args = 1.., help_heading = "Reconstruction")]
    pub(crate) masks: Vec<PathBuf>,
    /// A small version of the experiment, in seconds
    #[arg(long)]
    pub(crate) quick: bool,
    /// Threads to use, except where time is measured; the result does not depend on it [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: Option<u16>,
    /// No warnings, no progress
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// Experiments of `reproduce`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ExperimentName {
    /// Error and time against steps per cubic
    Table1,
    /// Time, and what the hull test and the quintic solver save
    Table2,
    /// How far nine reconstruction algorithms reach under ε-sampling, on the curve named complex or else the first
    Table3,
    /// Triangles, time and error of the simulation on meshes of six densities
    Table4,
    /// Exact reconstructions of real-world outlines
    Figure6,
    /// Exact reconstructions by ε, on the same curve as table3
    Figure7,
    /// The same as plots, and error against triangles
    Figure10,
    /// Pictures of meshes
    Figure12,
    /// Pictures of meshes and simulations of the first curve at six densities
    Figure13,
    /// All of them
    All,
}

impl ReproduceArgs {
    /// Values of ε and starts of the study.
    pub(crate) fn grid(&self) -> Result<Grid, Failure> {
        let (step, starts) = if self.quick { (0.05, 10) } else { (0.01, 100) };
        let step = self.epsilon_step.unwrap_or(step);
        let Some(thousandths) = (1..=500_u32).find(|n| (f64::from(*n) - 1000.0 * step).abs() < 1e-6) else {
            let message = format!("--epsilon-step is {step}; it is a multiple of 0.001, up to 0.5");
            return Err(Failure::usage(message));
        };
        Ok(Grid::new(thousandths, self.starts.unwrap_or(starts)))
    }

    /// What was asked for: each once, in the order of the paper.
    pub(crate) fn names(&self) -> Vec<ExperimentName> {
        let asked = |name: &ExperimentName| {
            *name != ExperimentName::All
                && (self.experiment.contains(name) || self.experiment.contains(&ExperimentName::All))
        };
        ExperimentName::value_variants().iter().copied().filter(asked).collect()
    }
}

/// Find the real roots of polynomials.
///
/// Each line holds the coefficients of one polynomial, up to 16, in ascending powers, separated by blanks or commas: decimal,
/// or hexadecimal as C99 writes it (0x1.8p-3). Blank lines and # comments are skipped.
///
/// The table line,root,lower,upper,kind has a row for each root: lower and upper enclose it; kind is simple, even (a double
/// root, or two that cannot be told apart), odd (a triple root, or three), or cluster:K (about K roots with multiplicity).
/// Lines count from 1. A polynomial that is zero everywhere has no row, but a warning.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  echo 6 -29 16 16 | fsample roots                        1/4 and 3/4, the roots in [0, 1]
  fsample roots polynomials.txt --interval -2,0x1p4
  fsample roots polynomials.txt --all > roots.csv")]
pub(crate) struct RootsArgs {
    /// The polynomials; - is standard input
    #[arg(value_name = "FILE", default_value = "-")]
    pub(crate) file: String,
    /// Look for roots between A and B, ends included [default: 0,1]
    #[arg(long, value_name = "A,B", conflicts_with = "all", allow_hyphen_values = true)]
    pub(crate) interval: Option<String>,
    /// Find all real roots
    #[arg(long)]
    pub(crate) all: bool,
    /// Prove the answer in exact arithmetic: each bracket holds as many roots as its kind says, and there are no others
    #[arg(long)]
    pub(crate) certified: bool,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    /// No warnings on standard error
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// Find the points of a drawing that are closest to given points.
///
/// The drawing is taken as it is drawn: every cubic of the file, kinks and all. Of equally close points that of the first
/// path and segment is taken.
///
/// A table x,y,path,segment,t,px,py,distance goes to standard output, a row for each query in their order: the query, where
/// on the drawing (t is the parameter of the cubic), the point there, and how far away it is.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample nearest drawing.svg 10,20 -3,4.5
  fsample nearest drawing.svg - < points.txt              one \"x y\" or \"x,y\" per line")]
pub(crate) struct NearestArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    /// Points to ask about; - reads a list from standard input
    #[arg(value_name = "X,Y", required = true)]
    pub(crate) queries: Vec<String>,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    /// No warnings on standard error
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// Print a completion script for a shell.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample completions bash > ~/.local/share/bash-completion/completions/fsample
  fsample completions zsh > ~/.zfunc/_fsample")]
pub(crate) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    pub(crate) shell: Shell,
}

/// Print a manual page.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample man | man -l -
  fsample man sample > fsample-sample.1")]
pub(crate) struct ManArgs {
    /// The command whose page is wanted; without it, the page of fsample itself
    pub(crate) command: Option<String>,
}

/// The drawing.
#[derive(Args, Debug)]
pub(crate) struct InputArg {
    /// An SVG drawing, or a CSV of control points (path,closed,x0,y0,…,x3,y3); - is standard input
    #[arg(value_name = "IN")]
    pub(crate) file: String,
}

/// Where the result goes.
#[derive(Args, Debug)]
pub(crate) struct OutputArgs {
    /// The result; its extension decides the format; - is standard output
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// The format, whatever the extension
    #[arg(long, value_name = "NAME")]
    pub(crate) format: Option<String>,
}

/// How finely the medial axis is followed.
#[derive(Args, Debug)]
#[command(next_help_heading = "Computation")]
pub(crate) struct ModelArgs {
    /// Foot points per cubic, the same on each; without it, as many as --tolerance takes
    #[arg(long, value_name = "N", conflicts_with = "tolerance", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) steps: Option<u32>,
    /// Relative error of the local feature size to refine to [default: 0.001]
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    pub(crate) tolerance: Option<f64>,
    /// Joints that turn by less are smooth, in degrees
    #[arg(long, value_name = "DEG", default_value_t = 1.0, allow_negative_numbers = true)]
    pub(crate) corner_angle: f64,
    /// Give up (exit code 5) where more medial points are needed
    #[arg(long, value_name = "N", default_value_t = 20_000_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) max_medial_points: u32,
    /// Threads to use; the result does not depend on it [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: Option<u16>,
    /// No summary, no warnings, no progress
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// The corner angle is one.
pub(crate) fn check_corner_angle(angle: f64) -> Result<f64, Failure> {
    if (0.0..=90.0).contains(&angle) {
        Ok(angle)
    } else {
        Err(Failure::usage(format!("--corner-angle is {angle}; it lies between 0 and 90 degrees")))
    }
}

impl ModelArgs {
    /// The tolerance that lfs is refined to where --steps is not given.
    const TOLERANCE: f64 = 1e-3;

    /// The options, if they make sense.
    pub(crate) fn check(&self) -> Result<ModelOptions, Failure> {
        let tolerance = self.tolerance.unwrap_or(Self::TOLERANCE);
        if !(tolerance > 0.0 && tolerance < 1.0) {
            return Err(Failure::usage(format!("--tolerance is {tolerance}; it lies between 0 and 1")));
        }
        let available = || std::thread::available_parallelism().map_or(1, NonZero::get);
        let threads = self.threads.map_or_else(available, usize::from);
        let corner_angle = check_corner_angle(self.corner_angle)?;
        let max_medial_points = usize::try_from(self.max_medial_points).unwrap_or(usize::MAX);
        Ok(ModelOptions { steps: self.steps, tolerance, corner_angle, max_medial_points, threads, quiet: self.quiet })
    }

    /// The options that decide the result, for headers.
    pub(crate) fn describe(&self) -> Vec<(&'static str, OptionValue)> {
        let resolution = match self.steps {
            Some(steps) => ("steps", OptionValue::Number(f64::from(steps))),
            None => ("tolerance", OptionValue::Number(self.tolerance.unwrap_or(Self::TOLERANCE))),
        };
        vec![resolution, ("corner-angle", OptionValue::Number(self.corner_angle))]
    }
}

/// How densely to sample.
#[derive(Args, Debug)]
#[command(next_help_heading = "Bounds")]
pub(crate) struct SamplingArgs {
    /// Every point of a curve has a sample nearer than E times its local feature size [default: 0.5]
    #[arg(long, value_name = "E", conflicts_with = "rho", allow_negative_numbers = true)]
    pub(crate) epsilon: Option<f64>,
    /// Like --epsilon, with the smallest local feature size between neighbours in the place of the point's own
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    pub(crate) rho: Option<f64>,
    /// Largest distance of the curve from the chord between neighbours
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub(crate) chord_error: Option<Length>,
    /// Smallest distance between neighbours; wins over the upper bounds
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub(crate) min_distance: Option<Length>,
    /// Largest distance between neighbours
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub(crate) max_distance: Option<Length>,
    /// Largest ratio of two neighbouring gaps, above 1
    #[arg(long, value_name = "G", allow_negative_numbers = true)]
    pub(crate) grading: Option<f64>,
    /// Where on a closed path the first sample lies, as a share of its parameters, in [0, 1)
    #[arg(long, value_name = "F", default_value_t = 0.0, allow_negative_numbers = true)]
    pub(crate) start: f64,
    /// Give up (exit code 5) where one path would need more samples
    #[arg(long, value_name = "N", default_value_t = 10_000_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) max_samples: u32,
}

/// A share of lfs: beyond 1 the condition says nothing about the curve's shape any more.
pub(crate) fn share(name: &str, value: f64) -> Result<f64, Failure> {
    if value > 0.0 && value <= 1.0 {
        Ok(value)
    } else {
        Err(Failure::usage(format!("--{name} is {value}; it has to be above 0 and at most 1")))
    }
}

/// A length option of a drawing in user units. Lengths that have no size in this drawing are usage errors: another option
/// value is needed, not another drawing.
pub(crate) fn resolve(name: &str, length: Length, per_mm: Option<f64>, diagonal: f64) -> Result<f64, Failure> {
    length.resolve(per_mm, diagonal).map_err(|error| Failure::usage(format!("--{name}: {error}")))
}

/// A finite number above a limit.
pub(crate) fn above(name: &str, limit: f64, value: f64) -> Result<f64, Failure> {
    if value > limit && value.is_finite() {
        Ok(value)
    } else {
        Err(Failure::usage(format!("--{name} is {value}; it has to be a finite number above {limit}")))
    }
}

impl SamplingArgs {
    /// What can be said without the drawing.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        self.density()?;
        if let Some(grading) = self.grading {
            above("grading", 1.0, grading)?;
        }
        if !(0.0..1.0).contains(&self.start) {
            return Err(Failure::usage(format!("--start is {}; it lies in [0, 1)", self.start)));
        }
        let positive = [
            ("chord-error", self.chord_error),
            ("min-distance", self.min_distance),
            ("max-distance", self.max_distance),
        ];
        for (name, length) in positive.into_iter().filter_map(|(name, length)| Some((name, length?))) {
            above(name, 0.0, length.value())?;
        }
        Ok(())
    }

    fn density(&self) -> Result<Density, Failure> {
        match self.rho {
            Some(rho) => share("rho", rho).map(Density::Rho),
            None => share("epsilon", self.epsilon.unwrap_or(0.5)).map(Density::Epsilon),
        }
    }

    /// The bounds in user units, if they agree with each other.
    pub(crate) fn bounds(&self, drawing: &Drawing, diagonal: f64) -> Result<Bounds, Failure> {
        self.check()?;
        let length = |name, length: Option<Length>| {
            length.map(|length| resolve(name, length, drawing.user_units_per_mm, diagonal)).transpose()
        };
        let bounds = Bounds {
            density: self.density()?,
            chord_error: length("chord-error", self.chord_error)?,
            min_distance: length("min-distance", self.min_distance)?,
            max_distance: length("max-distance", self.max_distance)?,
            grading: self.grading,
            start: self.start,
            limit: self.max_samples,
        };
        match (self.min_distance, self.max_distance, bounds.min_distance, bounds.max_distance) {
            (Some(min), Some(max), Some(smallest), Some(largest)) if smallest > largest => {
                Err(Failure::usage(format!("--min-distance {min} is above --max-distance {max}")))
            }
            _ => Ok(bounds),
        }
    }
}

impl Bounds {
    /// The bounds that are set, for headers.
    pub(crate) fn describe(&self) -> Vec<(&'static str, OptionValue)> {
        let density = match self.density {
            Density::Epsilon(epsilon) => ("epsilon", Some(epsilon)),
            Density::Rho(rho) => ("rho", Some(rho)),
        };
        [
            density,
            ("chord-error", self.chord_error),
            ("min-distance", self.min_distance),
            ("max-distance", self.max_distance),
            ("grading", self.grading),
            ("start", Some(self.start)),
        ]
        .into_iter()
        .filter_map(|(name, value)| Some((name, OptionValue::Number(value?))))
        .collect()
    }
}

/// A layer of an SVG result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Layer {
    Drawing,
    Lfs,
    Medial,
    Samples,
}

/// What a plotter needs to be told.
#[derive(Args, Debug)]
#[command(next_help_heading = "G-code")]
pub(crate) struct PlotterArgs {
    /// A line that lifts the pen; may be given several times [default: "G0 Z5"]
    #[arg(long, value_name = "LINE", allow_hyphen_values = true)]
    pub(crate) pen_up: Vec<String>,
    /// A line that lowers the pen; may be given several times [default: "G1 Z0"]
    #[arg(long, value_name = "LINE", allow_hyphen_values = true)]
    pub(crate) pen_down: Vec<String>,
    /// Drawing speed in mm/min [default: 1500]
    #[arg(long, value_name = "V", allow_negative_numbers = true)]
    pub(crate) feed: Option<f64>,
    /// Travel speed in mm/min [default: 3000]
    #[arg(long, value_name = "V", allow_negative_numbers = true)]
    pub(crate) travel_feed: Option<f64>,
}

impl PlotterArgs {
    /// Some option of this group is given.
    pub(crate) fn is_given(&self) -> bool {
        !self.pen_up.is_empty() || !self.pen_down.is_empty() || self.feed.is_some() || self.travel_feed.is_some()
    }

    /// The machine, if what is said of it makes sense.
    pub(crate) fn machine(&self) -> Result<lineart::export::gcode::Machine, Failure> {
        let mut machine = lineart::export::gcode::Machine::default();
        for (name, given, lines) in
            [("pen-up", &self.pen_up, &mut machine.pen_up), ("pen-down", &self.pen_down, &mut machine.pen_down)]
        {
            if let Some(line) = given.iter().find(|line| line.chars().any(char::is_control)) {
                return Err(Failure::usage(format!("--{name} {line:?}: one line each; repeat the option for more")));
            }
            if !given.is_empty() {
                lines.clone_from(given);
            }
        }
        if let Some(feed) = self.feed {
            machine.feed = above("feed", 0.0, feed)?;
        }
        if let Some(feed) = self.travel_feed {
            machine.travel_feed = above("travel-feed", 0.0, feed)?;
        }
        Ok(machine)
    }
}

/// Reads the command line.
pub(crate) fn parse() -> Result<Command, Failure> {
    let arguments = queries_as_values(std::env::args_os());
    Cli::try_parse_from(arguments).map(|cli| cli.command).map_err(|error| Failure::from_clap(&error))
}

/// The command line with a blank before queries like `-5,3`, which clap would take for options.
fn queries_as_values(arguments: impl Iterator<Item = OsString>) -> Vec<OsString> {
    let mut arguments: Vec<OsString> = arguments.collect();
    if arguments.get(1).is_some_and(|command| command == "nearest") {
        for argument in arguments.iter_mut().skip(2) {
            let is_query = argument
                .to_str()
                .and_then(|text| text.strip_prefix('-'))
                .is_some_and(|text| text.contains(',') && text.starts_with(|c: char| c.is_ascii_digit() || c == '.'));
            if is_query {
                let mut value = OsString::from(" ");
                value.push(&*argument);
                *argument = value;
            }
        }
    }
    arguments
}

/// The command line as data, for completions and manual pages.
pub(crate) fn definition() -> clap::Command {
    Cli::command()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_definition_is_sound() {
        definition().debug_assert();
    }
}
