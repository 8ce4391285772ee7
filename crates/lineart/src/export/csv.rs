//! Tables: a header line, then one row per line, comma-separated, `\n` at the end of each.
//!
//! No field ever needs quoting: all are numbers or one of a few fixed words. Infinity is `inf`.

use std::io::{self, Write};

use super::number::Number;
use super::{LfsRow, MedialRow, PathRows, SampleRow};

/// Columns of the samples table.
pub const SAMPLES: &str = "path,segment,t,x,y,lfs,bound";
/// Columns of the medial table.
pub const MEDIAL: &str = "path,segment,t,x,y,side,mx,my,radius,polyline";
/// Columns of the lfs table.
pub const LFS: &str = "path,segment,t,x,y,lfs";
/// Columns of proved bounds, behind those of the lfs table.
pub const LFS_BOUNDS: &str = ",lower,upper";

/// Writes the samples table.
///
/// # Errors
/// Those of `out`.
pub fn samples(out: &mut dyn Write, paths: &[PathRows<SampleRow>]) -> io::Result<()> {
    writeln!(out, "{SAMPLES}")?;
    for row in paths.iter().flat_map(|path| &path.rows) {
        let [t, x, y, lfs] = [row.t, row.x, row.y, row.lfs].map(Number);
        writeln!(out, "{},{},{t},{x},{y},{lfs},{}", row.path, row.segment, row.bound)?;
    }
    Ok(())
}

/// Writes the medial table.
///
/// # Errors
/// Those of `out`.
pub fn medial(out: &mut dyn Write, paths: &[PathRows<MedialRow>]) -> io::Result<()> {
    writeln!(out, "{MEDIAL}")?;
    for row in paths.iter().flat_map(|path| &path.rows) {
        let [t, x, y, mx, my, radius] = [row.t, row.x, row.y, row.mx, row.my, row.radius].map(Number);
        let MedialRow { path, segment, side, polyline, .. } = row;
        writeln!(out, "{path},{segment},{t},{x},{y},{side},{mx},{my},{radius},{polyline}")?;
    }
    Ok(())
}

/// Writes the lfs table, with columns `lower,upper` where the first row has bounds.
///
/// # Errors
/// Those of `out`.
pub fn lfs(out: &mut dyn Write, paths: &[PathRows<LfsRow>]) -> io::Result<()> {
    let rows = || paths.iter().flat_map(|path| &path.rows);
    let bounded = rows().next().is_some_and(|row| row.bounds.is_some());
    writeln!(out, "{LFS}{}", if bounded { LFS_BOUNDS } else { "" })?;
    for row in rows() {
        let [t, x, y, lfs] = [row.t, row.x, row.y, row.lfs].map(Number);
        write!(out, "{},{},{t},{x},{y},{lfs}", row.path, row.segment)?;
        if let Some(bounds) = row.bounds {
            let [lower, upper] = bounds.map(Number);
            write!(out, ",{lower},{upper}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_as_the_interface_fixes_them() {
        let row = SampleRow { path: 1, segment: 2, t: 0.5, x: -0.0, y: 1e-7, lfs: f64::INFINITY, bound: "epsilon" };
        let mut out = Vec::new();
        samples(&mut out, &[PathRows { closed: false, rows: vec![row] }]).expect("written");
        assert_eq!(
            String::from_utf8(out).expect("text"),
            "path,segment,t,x,y,lfs,bound\n1,2,0.5,0,0.0000001,inf,epsilon\n",
            "one header, one row"
        );
    }
}
