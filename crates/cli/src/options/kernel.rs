//! Options of the kernel's own questions: roots and closest points.

use clap::Args;

use super::groups::{InputArg, OutputArgs};

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
