//! From raw paths to the curve C that every statement of the checker is about.
//!
//! Drawings come with debris: segments of length 1e-16, ends that all but meet, kinks of a twentieth of a degree where
//! smoothness was meant. They are cleaned once, here, by fixed rules:
//!
//! 1. Segments shorter than 2e-6 of the diagonal (of the box of all control points) are dropped; what follows is moved
//!    on to the end of what came before. A path is closed if it says so, by a straight line where its ends differ by
//!    more than that, or if its ends are that near. Ends of different open paths that are that near become one.
//! 2. Cubics whose control points are collinear and that never turn back are lines at uniform speed.
//! 3. Identical cubics, in either direction, are one obstacle. Paths refer to obstacles, so both keep their samples.
//! 4. Where exactly two branches meet and turn by less than the corner angle (1°), both handles are turned by half the
//!    kink, lengths kept: the joint is smooth. The curve moves by at most 2/9 · handle · turn; beyond 1e-4 of the
//!    diagonal the joint stays a corner, and so does one with a retracted handle.

use crate::curve::Cubic;
use crate::plane::{V2, v2};

/// A path as read: control points of its cubics in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RawPath {
    /// Whether the path says that it is closed.
    pub closed: bool,
    /// Control points, one entry per cubic.
    pub cubics: Vec<[[f64; 2]; 4]>,
}

/// What the door may be told.
#[derive(Clone, Copy, Debug)]
pub struct DoorOptions {
    /// Joints that turn by less (in degrees) are smoothed.
    pub corner_angle: f64,
}

impl Default for DoorOptions {
    fn default() -> Self {
        DoorOptions { corner_angle: 1.0 }
    }
}

/// One end of an obstacle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct End {
    /// Which obstacle.
    pub(crate) cubic: usize,
    /// Its end at t = 1 rather than t = 0.
    pub(crate) last: bool,
}

/// A place where obstacles end.
#[derive(Clone, Debug)]
pub(crate) struct Vertex {
    /// Where.
    pub(crate) at: V2,
    /// The obstacles that end here.
    pub(crate) branches: Vec<End>,
    /// Exactly two branches of opposite directions.
    pub(crate) smooth: bool,
}

/// One step of a path: an obstacle, run forwards or backwards.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    /// The obstacle.
    pub(crate) cubic: usize,
    /// Run from t = 1 to t = 0.
    pub(crate) reversed: bool,
    /// Index of the raw segment; one past the last for an added closing line.
    pub(crate) segment: usize,
}

/// A cleaned path.
#[derive(Clone, Debug)]
pub(crate) struct Path {
    /// Whether the last piece leads back to the first.
    pub(crate) closed: bool,
    /// Its pieces in order; empty if everything was dropped.
    pub(crate) pieces: Vec<Piece>,
}

/// The curve C.
#[derive(Clone, Debug)]
pub(crate) struct Drawing {
    pub(crate) diagonal: f64,
    pub(crate) cubics: Vec<Cubic>,
    /// Vertices at the two ends of each obstacle.
    pub(crate) ends: Vec<[usize; 2]>,
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) paths: Vec<Path>,
    /// Largest displacement by smoothing.
    pub(crate) displacement: f64,
}

type Control = [V2; 4];

struct Loose {
    closed: bool,
    segments: Vec<(usize, Control)>,
}

fn polygon_length(c: &Control) -> f64 {
    c.windows(2).map(|w| w[0].distance(w[1])).sum()
}

/// Moves the start of `c` to `to`, its handle with it.
fn move_start(c: &mut Control, to: V2) {
    let by = to - c[0];
    c[0] = to;
    c[1] = c[1] + by;
}

/// Moves the end of `c` to `to`, its handle with it.
fn move_end(c: &mut Control, to: V2) {
    let by = to - c[3];
    c[3] = to;
    c[2] = c[2] + by;
}

/// Whether the cubic is a line that never turns back, and then that line with thirds for handles.
fn straightened(c: &Control, diagonal: f64) -> Option<Control> {
    let chord = c[3] - c[0];
    let length = chord.norm();
    let slack = 1e-12 * diagonal;
    if length <= slack || c[1..3].iter().any(|p| (*p - c[0]).cross(chord).abs() > slack * length) {
        return None;
    }
    let place = |p: V2| (p - c[0]).dot(chord) / (length * length);
    let (b0, b1, b2) = (place(c[1]), place(c[2]) - place(c[1]), 1.0 - place(c[2]));
    // The derivative has these three Bernstein coefficients; it must not change sign on [0, 1].
    let monotone = b0 >= -1e-12 && b2 >= -1e-12 && b1 >= -(b0.max(0.0) * b2.max(0.0)).sqrt() - 1e-12;
    monotone.then(|| [c[0], c[0] + chord * (1.0 / 3.0), c[3] - chord * (1.0 / 3.0), c[3]])
}

/// Rule 1 for one path.
fn tidy(raw: &RawPath, near: f64) -> Loose {
    let mut segments: Vec<(usize, Control)> = Vec::new();
    for (i, c) in raw.cubics.iter().enumerate() {
        let mut c = c.map(|[x, y]| v2(x, y));
        if polygon_length(&c) < near {
            continue;
        }
        if let Some((_, before)) = segments.last() {
            move_start(&mut c, before[3]);
        }
        segments.push((i, c));
    }
    let mut closed = false;
    if let (Some(&(_, first)), Some(&(_, last))) = (segments.first(), segments.last()) {
        let gap = first[0].distance(last[3]);
        closed = raw.closed || gap < near;
        if closed && gap >= near {
            let (a, b) = (last[3], first[0]);
            let third = (b - a) * (1.0 / 3.0);
            segments.push((raw.cubics.len(), [a, a + third, b - third, b]));
        } else if closed && let Some((_, last)) = segments.last_mut() {
            move_end(last, first[0]);
        }
    }
    Loose { closed, segments }
}

/// Brings ends of different open paths together where they all but meet.
fn join_open_ends(paths: &mut [Loose], near: f64) {
    let mut seats: Vec<V2> = Vec::new();
    for path in paths.iter_mut().filter(|p| !p.closed) {
        let count = path.segments.len();
        for last in [false, true] {
            let Some((_, c)) = path.segments.get_mut(if last { count.wrapping_sub(1) } else { 0 }) else { continue };
            let at = if last { c[3] } else { c[0] };
            match seats.iter().find(|s| s.distance(at) < near) {
                Some(&seat) if last => move_end(c, seat),
                Some(&seat) => move_start(c, seat),
                None => seats.push(at),
            }
        }
    }
}

impl Drawing {
    /// Cleans raw paths by the rules of this module.
    pub(crate) fn new(raw: &[RawPath], options: &DoorOptions) -> Drawing {
        let all = || raw.iter().flat_map(|p| p.cubics.iter().flatten());
        let (mut low, mut high) = (v2(f64::MAX, f64::MAX), v2(f64::MIN, f64::MIN));
        for &[x, y] in all() {
            low = v2(low.x.min(x), low.y.min(y));
            high = v2(high.x.max(x), high.y.max(y));
        }
        let diagonal = if all().next().is_some() { low.distance(high) } else { 0.0 };
        let near = 2e-6 * diagonal;
        let mut loose: Vec<Loose> = raw.iter().map(|p| tidy(p, near)).collect();
        join_open_ends(&mut loose, near);

        let mut obstacles: Vec<Control> = Vec::new();
        let mut paths = Vec::new();
        let same = |a: &Control, b: &Control| (0..4).all(|i| a[i].distance(b[i]) <= 1e-12 * diagonal);
        for path in loose {
            let mut pieces = Vec::new();
            for (segment, control) in path.segments {
                let control = straightened(&control, diagonal).unwrap_or(control);
                let mut back = control;
                back.reverse();
                let known = obstacles.iter().enumerate().find_map(|(i, o)| {
                    (same(o, &control)).then_some((i, false)).or_else(|| same(o, &back).then_some((i, true)))
                });
                let (cubic, reversed) = known.unwrap_or_else(|| {
                    obstacles.push(control);
                    (obstacles.len() - 1, false)
                });
                pieces.push(Piece { cubic, reversed, segment });
            }
            paths.push(Path { closed: path.closed, pieces });
        }
        let mut vertices: Vec<Vertex> = Vec::new();
        let mut ends = vec![[0; 2]; obstacles.len()];
        for (cubic, c) in obstacles.iter().enumerate() {
            for (side, at) in [c[0], c[3]].into_iter().enumerate() {
                let end = End { cubic, last: side == 1 };
                ends[cubic][side] = match vertices.iter_mut().position(|v| v.at.distance(at) <= 1e-12 * diagonal) {
                    Some(v) => {
                        vertices[v].branches.push(end);
                        v
                    }
                    None => {
                        vertices.push(Vertex { at, branches: vec![end], smooth: false });
                        vertices.len() - 1
                    }
                };
            }
        }
        let displacement = smooth(&mut obstacles, &mut vertices, &ends, &paths, diagonal, options);
        let cubics = obstacles
            .iter()
            .map(|c| match straightened(c, diagonal) {
                Some(_) => Cubic::line(c[0], c[3]),
                None => Cubic::new(*c),
            })
            .collect();
        Drawing { diagonal, cubics, ends, vertices, paths, displacement }
    }

    /// The obstacle seen from one of its ends.
    pub(crate) fn branch(&self, end: End) -> Cubic {
        let c = &self.cubics[end.cubic];
        if end.last { c.reversed() } else { *c }
    }
}

/// The pairs of ends that make a joint, each once: where a path goes on from one cubic to the next, and where two open
/// paths end in one vertex.
fn joints(paths: &[Path], ends: &[[usize; 2]], vertices: usize) -> Vec<[End; 2]> {
    let mut pairs: Vec<[End; 2]> = Vec::new();
    let mut open = vec![Vec::new(); vertices];
    for path in paths {
        let entry = |p: &Piece| End { cubic: p.cubic, last: p.reversed };
        let exit = |p: &Piece| End { cubic: p.cubic, last: !p.reversed };
        pairs.extend(path.pieces.windows(2).map(|p| [exit(&p[0]), entry(&p[1])]));
        let (Some(first), Some(last)) = (path.pieces.first(), path.pieces.last()) else { continue };
        if path.closed {
            pairs.push([exit(last), entry(first)]);
        } else {
            for end in [entry(first), exit(last)] {
                open[ends[end.cubic][usize::from(end.last)]].push(end);
            }
        }
    }
    pairs.extend(open.iter().filter_map(|ends| <[End; 2]>::try_from(ends.as_slice()).ok()));
    let mut known: Vec<[End; 2]> = Vec::new();
    for [a, b] in pairs {
        if a != b && !known.contains(&[a, b]) && !known.contains(&[b, a]) {
            known.push([a, b]);
        }
    }
    known
}

/// Rule 4: makes joints smooth in place; returns the largest displacement.
///
/// A joint is one of a path, whatever else touches it; only where nothing does, the vertex as a whole is smooth.
fn smooth(
    obstacles: &mut [Control],
    vertices: &mut [Vertex],
    ends: &[[usize; 2]],
    paths: &[Path],
    diagonal: f64,
    options: &DoorOptions,
) -> f64 {
    let limit = options.corner_angle.to_radians();
    let mut moved: f64 = 0.0;
    for [a, b] in joints(paths, ends, vertices.len()) {
        let (handle, root) = (|e: End| if e.last { 2 } else { 1 }, |e: End| if e.last { 3 } else { 0 });
        let (pa, pb) = (obstacles[a.cubic][root(a)], obstacles[b.cubic][root(b)]);
        let (ha, hb) = (obstacles[a.cubic][handle(a)] - pa, obstacles[b.cubic][handle(b)] - pb);
        let (la, lb) = (ha.norm(), hb.norm());
        // A retracted handle has no direction to turn.
        if la.min(lb) <= 1e-9 * diagonal {
            continue;
        }
        let (ua, ub) = (ha * (1.0 / la), hb * (1.0 / lb));
        let turn = ua.cross(-ub).atan2(ua.dot(-ub)).abs();
        let shift = 2.0 / 9.0 * la.max(lb) * turn;
        if turn >= limit || shift > 1e-4 * diagonal {
            continue;
        }
        moved = moved.max(shift);
        let u = (ua - ub).unit();
        obstacles[a.cubic][handle(a)] = pa + u * la;
        obstacles[b.cubic][handle(b)] = pb - u * lb;
        let vertex = &mut vertices[ends[a.cubic][usize::from(a.last)]];
        vertex.smooth = vertex.branches.len() == 2;
    }
    moved
}
