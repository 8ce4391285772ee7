//! `fsample roots`.

use std::fmt::Write as _;

use feature_sampling::polynomial::{Polynomial, Root, RootKind, RootsError};
use fsample_oracle::judge::{Interval, Judge};
use lineart::export::number::Number;

use crate::errors::{Failure, warn};
use crate::input;
use crate::number_in::number;
use crate::options::RootsArgs;
use crate::output::{Format, Target};

/// Columns of the result.
const HEADER: &str = "line,root,lower,upper,kind";

/// The most coefficients of a line.
const MOST: usize = 16;

/// Where roots are looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Range {
    /// [0, 1].
    Unit,
    /// Between two numbers.
    Between(f64, f64),
    /// Everywhere.
    Real,
}

/// Finds the real roots of the polynomials of a file, one to a line.
pub(crate) fn run(args: &RootsArgs) -> Result<(), Failure> {
    let target = Target::new(args.output.output.as_deref(), args.output.format.as_deref(), &[Format::Csv])?;
    let range = match &args.interval {
        Some(text) => interval(text)?,
        None if args.all => Range::Real,
        None => Range::Unit,
    };
    let text = input::text(&args.file)?;
    target.check_folder()?;
    let mut rows = String::with_capacity(text.len() * 2);
    rows.push_str(HEADER);
    rows.push('\n');
    let mut coefficients = Vec::with_capacity(MOST);
    for (line, content) in (1_usize..).zip(text.lines()) {
        let bad = |cause: String| Failure::input(&args.file, format!("line {line}: {cause}"));
        read(content, &mut coefficients).map_err(bad)?;
        if coefficients.is_empty() {
            continue;
        }
        let answer = if args.certified { certified(&coefficients, range) } else { solve(&coefficients, range) };
        match answer {
            Ok(found) => found.iter().for_each(|root| row(&mut rows, line, root)),
            Err(RootsError::ZeroPolynomial) if args.quiet => {}
            Err(RootsError::ZeroPolynomial) => {
                warn(format!("{}: line {line}: {}, so no row for it", args.file, RootsError::ZeroPolynomial));
            }
            Err(error) => return Err(bad(error.to_string())),
        }
    }
    target.write(|out| out.write_all(rows.as_bytes()))
}

/// `A,B`.
fn interval(text: &str) -> Result<Range, Failure> {
    let usage = |cause: String| Failure::usage(format!("--interval {text}: {cause}"));
    let (lo, hi) = text.split_once(',').ok_or_else(|| usage("write two numbers A,B".to_owned()))?;
    let (lo, hi) = (number(lo.trim()).map_err(usage)?, number(hi.trim()).map_err(usage)?);
    if lo < hi {
        Ok(Range::Between(lo, hi))
    } else {
        Err(usage("the first number has to be the smaller one".to_owned()))
    }
}

/// The coefficients of a line; none of a blank line or a comment.
fn read(content: &str, coefficients: &mut Vec<f64>) -> Result<(), String> {
    coefficients.clear();
    let content = content.split('#').next().unwrap_or_default();
    let fields = content.split(|c: char| c == ',' || c.is_whitespace()).filter(|field| !field.is_empty());
    for field in fields {
        if coefficients.len() == MOST {
            return Err(format!("more than {MOST} coefficients"));
        }
        coefficients.push(number(field)?);
    }
    Ok(())
}

/// The roots, by the solver for this number of coefficients.
fn solve(coefficients: &[f64], range: Range) -> Result<Vec<Root<f64>>, RootsError> {
    macro_rules! by_size {
        ($($n:literal)*) => {
            match coefficients.len() {
                $($n => solve_as::<$n>(coefficients, range),)*
                _ => solve_as::<MOST>(coefficients, range),
            }
        };
    }
    by_size!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15)
}

/// The roots with brackets that are proved, by counts in integers of any size.
fn certified(coefficients: &[f64], range: Range) -> Result<Vec<Root<f64>>, RootsError> {
    let judge = Judge::new(coefficients).ok_or(RootsError::ZeroPolynomial)?;
    let within = match range {
        Range::Unit => Interval::between(0.0, 1.0),
        Range::Between(lo, hi) => Interval::between(lo, hi),
        Range::Real => Some(judge.everywhere()),
    };
    Ok(judge.certified(&within.ok_or(RootsError::BadInterval)?))
}

fn solve_as<const N: usize>(coefficients: &[f64], range: Range) -> Result<Vec<Root<f64>>, RootsError> {
    let p = Polynomial::<f64, N>::new(std::array::from_fn(|j| coefficients.get(j).copied().unwrap_or(0.0)));
    let found = match range {
        Range::Unit => p.roots_in_unit(),
        Range::Between(lo, hi) => p.roots_between(&lo, &hi),
        Range::Real => p.real_roots(),
    };
    found.map(|roots| roots.into_iter().collect())
}

fn row(rows: &mut String, line: usize, root: &Root<f64>) {
    let [value, lower, upper] = [root.value, root.lower, root.upper].map(Number);
    let kind = match root.kind {
        RootKind::Simple => "simple",
        RootKind::Even => "even",
        RootKind::Odd => "odd",
        RootKind::Cluster(k) => {
            // Writing to a string cannot fail.
            let _ = writeln!(rows, "{line},{value},{lower},{upper},cluster:{k}");
            return;
        }
    };
    let _ = writeln!(rows, "{line},{value},{lower},{upper},{kind}");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_as_people_write_them() {
        let mut c = Vec::new();
        for (line, expected) in [
            ("1 2 3", &[1.0, 2.0, 3.0][..]),
            ("  1,2 , 3  # comment", &[1.0, 2.0, 3.0]),
            ("0x1p-1\t-2e0", &[0.5, -2.0]),
            ("", &[]),
            ("# nothing", &[]),
        ] {
            assert_eq!(read(line, &mut c), Ok(()), "{line}");
            assert_eq!(c, expected, "{line}");
        }
        assert!(read("1 two", &mut c).is_err_and(|e| e.contains("two")), "a word");
        assert!(read(&"1 ".repeat(17), &mut c).is_err_and(|e| e.contains("16")), "too many");
        assert_eq!(read(&"1 ".repeat(16), &mut c), Ok(()), "just enough");
    }

    #[test]
    fn intervals() {
        assert_eq!(interval("-1,0x1p1").ok(), Some(Range::Between(-1.0, 2.0)));
        for bad in ["1", "1,1", "2,1", "a,b", "0,inf", "0,1,2"] {
            assert!(interval(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn every_number_of_coefficients() {
        for size in 2..=16 {
            // (x − 1)·(1 + x + … ): xⁿ − 1
            let mut c = vec![0.0; size];
            c[0] = -1.0;
            c[size - 1] = 1.0;
            let found = solve(&c, Range::Unit).expect("finite");
            assert_eq!(found.len(), 1, "{size}: {found:?}");
            assert_eq!(found[0].value, 1.0, "{size}");
            let all = solve(&c, Range::Real).expect("finite");
            assert_eq!(all.len(), 1 + usize::from(size % 2 == 1), "{size}: {all:?}");
        }
        assert_eq!(solve(&[5.0], Range::Real), Ok(vec![]), "a constant");
        assert_eq!(solve(&[0.0], Range::Real), Err(RootsError::ZeroPolynomial));
    }
}
