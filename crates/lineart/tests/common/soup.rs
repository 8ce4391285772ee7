//! Random strokes as what is meshed.

use std::time::Instant;

use super::strokes;
use feature_sampling::geometry::Aabb;
use lineart::export::{PathRows, SampleRow};
use lineart::mesh::drawn::{Drawn, Grading, noding};
use lineart::mesh::{Options, Outcome, Size, mesh};
use lineart::node::Track;

/// Lines of random strokes, and a longest edge: a twentieth of their diagonal, as sizes alternate.
pub(crate) fn soup(kind: usize, seed: u64) -> (Drawn, Options) {
    let (paths, chains) = strokes::strokes(kind, seed);
    let mut rows: Vec<PathRows<SampleRow>> =
        paths.iter().map(|path| PathRows { closed: path.closed, rows: Vec::new() }).collect();
    for chain in &chains {
        let track = Track::new(&paths[chain.path].cubics);
        rows[chain.path].rows.extend(chain.at.iter().map(|&u| {
            let (at, p) = (track.locate(u), track.eval(u));
            let segment = u32::try_from(at.segment).expect("few");
            // A made-up lfs: refinement takes any.
            SampleRow { path: 0, segment, t: at.t, x: p.x, y: p.y, lfs: 0.02 + 0.1 * p.x * p.x, bound: "" }
        }));
    }
    let mut all = Aabb::empty();
    paths.iter().flat_map(|path| &path.cubics).for_each(|cubic| all.merge(&cubic.control_box()));
    let diagonal = all.extent().norm();
    let drawn = Drawn::new(&paths, &rows, &noding(diagonal, None)).expect("noded");
    let length = 0.05 * diagonal;
    let size = match seed % 3 {
        0 => Size::Unbounded,
        1 => Size::Uniform(length),
        _ => drawn.graded(2.0 * length, &Grading { lfs_factor: Some(4.0), growth: 1.0 }),
    };
    (drawn, Options { size, ..Options::default() })
}

/// Meshes one; what is wrong, or the number of triangles and the seconds that they took.
pub(crate) fn examine(kind: usize, seed: u64) -> Result<(usize, f64), String> {
    let (drawn, options) = soup(kind, seed);
    let start = Instant::now();
    let Outcome { mesh, capped, unrefined } =
        mesh(&drawn.lines(), &drawn.frame, &options).map_err(|error| error.to_string())?;
    let seconds = start.elapsed().as_secs_f64();
    if capped {
        return Err("the limit on vertices".to_owned());
    }
    if let Some(first) = unrefined.first() {
        return Err(format!("{} places not refined, the first {first:?}", unrefined.len()));
    }
    super::meshes::judge(&mesh, &drawn, &options)?;
    Ok((mesh.triangles.len(), seconds))
}
