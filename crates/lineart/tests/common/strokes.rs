//! Random stroke sets of the kinds that break triangulators, and a judge of what noding makes of them.
//!
//! The judge shares no code with the noder: it looks at all pairs of edges in 128-bit integers, walks along every chain,
//! and measures distances from the original curves.

use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::Point;
use lineart::drawing::DrawingPath;
use lineart::node::{Chain, NodeError, Noded, Options, Track, node};

/// A small generator of random numbers (SplitMix64, Steele et al., 2014).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 * f64::EPSILON / 2.0
    }

    /// Below n.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the range first")]
    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64).floor().clamp(0.0, n as f64 - 1.0) as usize
    }

    fn point(&mut self) -> Point<f64> {
        Point::new(self.unit(), self.unit())
    }

    fn stroke(&mut self) -> DrawingPath {
        let count = 1 + self.below(3);
        let mut cubics: Vec<Cubic<f64>> = Vec::new();
        let start = self.point();
        let mut from = start;
        for _ in 0..count {
            let cubic = match self.below(6) {
                0 => Cubic::line(from, self.point()),
                // Retracted handles.
                1 => Cubic::new(from, from, self.point(), self.point()),
                _ => Cubic::new(from, self.point(), self.point(), self.point()),
            };
            from = *cubic.end();
            cubics.push(cubic);
        }
        let closed = self.below(4) == 0;
        if closed {
            cubics.push(Cubic::line(from, start));
        }
        DrawingPath { closed, cubics, ..DrawingPath::default() }
    }
}

/// What is wrong with a stroke set beyond crossings.
pub(crate) const KINDS: [&str; 5] = ["crossings", "T-junctions", "copies", "displaced copies", "lattice-rounded"];

pub(crate) fn moved(path: &DrawingPath, by: impl Fn(&Point<f64>) -> Point<f64>) -> DrawingPath {
    let cubics = path.cubics.iter().map(|cubic| Cubic { points: cubic.points.each_ref().map(&by) }).collect();
    DrawingPath { cubics, ..path.clone() }
}

/// Strokes and chains of one kind; `seed` decides everything.
pub(crate) fn strokes(kind: usize, seed: u64) -> (Vec<DrawingPath>, Vec<Chain>) {
    let mut random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ (kind as u64) << 56);
    let mut paths: Vec<DrawingPath> = (0..3 + random.below(8)).map(|_| random.stroke()).collect();
    for _ in 0..1 + random.below(5) {
        let host = paths[random.below(paths.len())].clone();
        let cubic = host.cubics[random.below(host.cubics.len())];
        let extra = match kind {
            1 => {
                // Ends on the curve, or a little short of it, or a little beyond.
                let t = if random.below(3) == 0 { 0.5 } else { random.unit() };
                let (foot, from) = (cubic.eval(&t), random.point());
                let off = [0.0, 1e-12, 1e-9, 1e-7, 1e-6, 3e-6][random.below(6)] * (random.unit() - 0.5);
                let end = foot.plus_scaled(&off, &foot.minus(&from));
                DrawingPath { cubics: vec![Cubic::line(from, end)], ..DrawingPath::default() }
            }
            2 => match random.below(3) {
                0 => host,
                1 => {
                    let cubics = host.cubics.iter().rev().map(Cubic::reversed).collect();
                    DrawingPath { cubics, ..host }
                }
                _ => {
                    let (_, part) = cubic.split_at(&random.unit());
                    let (part, _) = part.split_at(&random.unit());
                    DrawingPath { cubics: vec![part], ..DrawingPath::default() }
                }
            },
            3 => {
                let size = [1e-13, 1e-11, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5][random.below(7)];
                let (dx, dy) = (size * (random.unit() - 0.5), size * (random.unit() - 0.5));
                moved(&host, |p| Point::new(p.x + dx, p.y + dy))
            }
            _ => random.stroke(),
        };
        paths.push(extra);
    }
    if kind == 4 {
        let round = |v: f64| (4.0 * v).round() / 4.0;
        paths = paths.iter().map(|path| moved(path, |p| Point::new(round(p.x), round(p.y)))).collect();
    }
    let chains = paths.iter().enumerate().map(|(path, stroke)| {
        let n = stroke.cubics.len() as f64;
        let count = [1, 2, 5, 12, 40][random.below(5)];
        let jitter = random.unit() * 0.9;
        let mut at: Vec<f64> = (0..=count)
            .map(|i| {
                n * (f64::from(i) + if i > 0 && i < count { jitter * (random.unit() - 0.5) } else { 0.0 })
                    / f64::from(count)
            })
            .collect();
        // Corners are samples.
        at.extend((1..stroke.cubics.len()).map(|i| i as f64));
        at.sort_by(f64::total_cmp);
        if stroke.closed {
            at.pop();
        }
        Chain { path, closed: stroke.closed, at }
    });
    let chains = chains.collect();
    (paths, chains)
}

/// What the judge measured.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Verdict {
    pub(crate) edges: usize,
    /// Largest distance of a vertex from the point of an owner's curve at the owner's parameter, in pitches.
    pub(crate) off_curve: f64,
    /// What the noder itself says, in pitches.
    pub(crate) displacement: f64,
    pub(crate) rounds: usize,
    /// Lattice units in a pitch.
    pub(crate) units: f64,
}

fn cross(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i128 {
    let [ax, ay, bx, by, cx, cy] = [a[0], a[1], b[0], b[1], c[0], c[1]].map(i128::from);
    (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
}

/// Two edges meet in something other than a common end.
pub(crate) fn clash(a: [[i64; 2]; 2], b: [[i64; 2]; 2]) -> bool {
    let outside = |i: usize| a[0][i].max(a[1][i]) < b[0][i].min(b[1][i]) || b[0][i].max(b[1][i]) < a[0][i].min(a[1][i]);
    if outside(0) || outside(1) {
        return false;
    }
    let inside = |e: [[i64; 2]; 2], v: [i64; 2]| {
        let between = |i: usize| e[0][i].min(e[1][i]) <= v[i] && v[i] <= e[0][i].max(e[1][i]);
        v != e[0] && v != e[1] && cross(e[0], e[1], v) == 0 && between(0) && between(1)
    };
    let sign = |x: i128| x.signum();
    let proper = sign(cross(a[0], a[1], b[0])) * sign(cross(a[0], a[1], b[1])) < 0
        && sign(cross(b[0], b[1], a[0])) * sign(cross(b[0], b[1], a[1])) < 0;
    proper || inside(a, b[0]) || inside(a, b[1]) || inside(b, a[0]) || inside(b, a[1])
}

/// Judges a graph; `Err` says what is wrong.
pub(crate) fn judge(paths: &[DrawingPath], chains: &[Chain], noded: &Noded, pitch: f64) -> Result<Verdict, String> {
    let segment = |ends: [u32; 2]| ends.map(|v| noded.vertices[v as usize].place);
    if let Some(i) = noded.edges.iter().position(|edge| edge.ends[0] >= edge.ends[1]) {
        return Err(format!("edge {i} has its ends in disorder"));
    }
    // All pairs, but those that are apart from left to right.
    let mut by_left: Vec<(i64, i64, usize)> = Vec::with_capacity(noded.edges.len());
    for (i, edge) in noded.edges.iter().enumerate() {
        let [a, b] = segment(edge.ends);
        by_left.push((a[0].min(b[0]), a[0].max(b[0]), i));
    }
    by_left.sort_unstable();
    for (k, &(_, right, i)) in by_left.iter().enumerate() {
        let a = &noded.edges[i];
        for &(_, _, j) in by_left[k + 1..].iter().take_while(|(left, ..)| *left <= right) {
            let b = &noded.edges[j];
            if a.ends == b.ends || clash(segment(a.ends), segment(b.ends)) {
                return Err(format!("edges {i} and {j} meet: {:?} {:?}", segment(a.ends), segment(b.ends)));
            }
        }
    }
    let mut verdict = Verdict {
        edges: noded.edges.len(),
        displacement: noded.report.max_displacement / pitch,
        rounds: noded.report.rounds,
        units: pitch / noded.unit,
        off_curve: 0.0,
    };
    for chain in chains {
        let track = Track::new(&paths[chain.path].cubics);
        // Pieces in the direction of the path: parameters and vertices.
        let mut pieces: Vec<Piece> = Vec::new();
        for edge in &noded.edges {
            for owner in noded.owners(edge).iter().filter(|owner| owner.path as usize == chain.path) {
                let [a, b] = owner.at;
                pieces.push(if owner.forward { (owner.at, edge.ends) } else { ([b, a], [edge.ends[1], edge.ends[0]]) });
                for (u, v) in owner.at.iter().zip(edge.ends) {
                    let off = track.eval(*u).distance(&noded.vertices[v as usize].point) / pitch;
                    verdict.off_curve = verdict.off_curve.max(off);
                }
            }
        }
        pieces.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]).then(a.0[1].total_cmp(&b.0[1])));
        let (Some(first), Some(last)) = (chain.at.first(), chain.at.last()) else { continue };
        let near = |u: f64, v: u32| track.eval(u).distance(&noded.vertices[v as usize].point) <= 2.0 * pitch;
        match (pieces.first(), pieces.last()) {
            (Some(start), Some(end)) => {
                let last = if chain.closed { *first } else { *last };
                if !(near(*first, start.1[0]) && near(last, end.1[1])) {
                    return Err(format!("the chain of path {} lost an end", chain.path));
                }
            }
            _ => {
                // The whole path is smaller than the lattice can show.
                let far = (0..=64).map(|i| track.eval(first + (last - first) * f64::from(i) / 64.0));
                if far.into_iter().any(|p| p.distance(&track.eval(*first)) > 4.0 * pitch) {
                    return Err(format!("the chain of path {} is gone", chain.path));
                }
            }
        }
        walk(&mut pieces);
        for pair in pieces.windows(2) {
            let [(before, from), (after, to)] = [pair[0], pair[1]];
            if from[1] != to[0] {
                return Err(format!("the chain of path {} is broken at {}", chain.path, before[1]));
            }
            if before[1] > after[0] {
                return Err(format!("pieces of path {} overlap at {}", chain.path, before[1]));
            }
        }
    }
    Ok(verdict)
}

/// A piece of a path: parameters and vertices, in the direction of the path.
type Piece = ([f64; 2], [u32; 2]);

/// Puts pieces of no extent in the parameter, which a sorted list has at one place, into an order in which the path can run
/// through them.
fn walk(pieces: &mut [Piece]) {
    let mut from = 1;
    while from < pieces.len() {
        let u = pieces[from].0[0];
        let count = pieces[from..].iter().take_while(|piece| piece.0 == [u, u]).count();
        if let Some(order) = trail(pieces[from - 1].1[1], &pieces[from..from + count]) {
            pieces[from..from + count].copy_from_slice(&order);
        }
        from += count.max(1);
    }
}

/// All pieces in a row that begins at a vertex, each where the one before ends, if there is such a row (Hierholzer 1873).
fn trail(start: u32, pieces: &[Piece]) -> Option<Vec<Piece>> {
    let mut left = pieces.to_vec();
    let (mut row, mut path) = (Vec::new(), vec![(start, None)]);
    while let Some(&(vertex, piece)) = path.last() {
        if let Some(next) = left.iter().position(|piece| piece.1[0] == vertex) {
            let next = left.remove(next);
            path.push((next.1[1], Some(next)));
        } else {
            path.pop();
            row.extend(piece);
        }
    }
    row.reverse();
    let is_row = left.is_empty() && row.windows(2).all(|pair| pair[0].1[1] == pair[1].1[0]);
    is_row.then_some(row)
}

/// Nodes one random set and judges it.
pub(crate) fn examine(kind: usize, seed: u64) -> Result<Verdict, String> {
    let (paths, chains) = strokes(kind, seed);
    let pitch = [1e-6, 1e-6, 1e-5, 1e-4, 1e-3][(seed % 5) as usize] * std::f64::consts::SQRT_2;
    let noded = node(&paths, &chains, &Options::new(pitch)).map_err(|error: NodeError| error.to_string())?;
    let verdict = judge(&paths, &chains, &noded, pitch)?;
    // The noder measures from chords, the judge from curves, which are flat to an eighth of the pitch at contacts.
    if verdict.displacement > 1.0 || verdict.off_curve > 1.125 {
        return Err(format!("moved by {} pitches, {} off the curve", verdict.displacement, verdict.off_curve));
    }
    Ok(verdict)
}
