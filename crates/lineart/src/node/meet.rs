//! Where curves meet: chains are refined until their chords say the same as the curves.
//!
//! Between two samples the curve bulges away from its chord. Chords alone would therefore cross where the curves do not,
//! or the other way round, and a crossing of chords is not where the curves cross. Pieces whose hulls are apart cannot
//! meet, whatever their chords do. The others are halved until their hulls are apart or both are flat to an eighth of the
//! pitch; then chord and curve are the same thing at the scale of the lattice. So extra vertices appear only near
//! contacts: a few at a crossing, many along a stretch where two different strokes lie on each other. (Copies, whose
//! pieces coincide with each other end to end, are recognised and not halved.)
//!
//! Where flat pieces cross, Newton's method on A(u) = B(v) gives the parameters of the crossing on both cubics, and both
//! chains get a vertex there, at one point.
//!
//! "Apart" is by two pitches: the lattice moves neither of two strokes by more than one, so it never leads a chord that is
//! not flat through a vertex of another stroke, which might be near the chord and far from the curve.
//!
//! **Merging.** Points nearer to each other than three quarters of a pitch become one, and a curve that is so near to a vertex is
//! led through it. That is as much as the promise of a pitch allows, and no less is taken because triangulations pay for what is
//! left apart: between lines at a distance h over a length L, triangles without small angles number about 7 L / h.
//!
//! **Neighbours.** Pieces that share a vertex always touch there. Where a line through the vertex parts them they cannot
//! meet elsewhere, and where the angle between their chords is large beside their bends, the chords come within two pitches
//! only so near the vertex that bends do not count. Otherwise the halves away from the vertex are tested like any others, and the
//! halves at it are neighbours again.

use feature_sampling::geometry::Point;

use super::cluster::Clusters;
use super::pairs::Boxes;
use super::track::{Hull, Track};
use super::{NodeError, Options};

/// A vertex of a chain on its way to the lattice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stop {
    /// Parameter on the path.
    pub(super) u: f64,
    /// The point there; at a crossing the one that both curves share.
    pub(super) point: Point<f64>,
}

/// A chain as a list of stops, the first repeated after the seam of a closed one.
#[derive(Clone, Debug)]
pub(super) struct Strand<'a> {
    pub(super) track: Track<'a>,
    /// Index of the path.
    pub(super) path: u32,
    pub(super) closed: bool,
    pub(super) stops: Vec<Stop>,
}

/// A stretch of a chain that is tested against others.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// Which strand.
    strand: u32,
    from: f64,
    to: f64,
    hull: Hull,
    /// Points of the stops.
    ends: [Point<f64>; 2],
}

/// A longer deviation than this share of the chord is halved whatever is near.
const ROUND: f64 = 0.2;
/// Points and curves nearer to each other than this become one, in pitches; rounding to the lattice adds a fifth at most.
const MERGE: f64 = 0.75;
/// Halvings of one piece at most.
const MAX_DEPTH: u32 = 40;

/// Refines the strands; answers how many crossings were put on the curves.
pub(super) fn refine(strands: &mut [Strand<'_>], origin: &Point<f64>, options: &Options) -> Result<usize, NodeError> {
    let flat = options.pitch / 8.0;
    let apart = 2.0 * options.pitch;
    let near = MERGE * options.pitch;
    let mut clusters = Clusters::new(near, *origin);
    for strand in strands.iter_mut() {
        straighten(strand, flat, options.limit)?;
        strand.stops.iter_mut().for_each(|stop| stop.point = clusters.first(stop.point));
    }
    share(strands, near);
    let pieces = all_pieces(strands);
    let boxes = Boxes::new(pieces.iter().map(|piece| piece.hull.bounds(apart / 2.0)).collect());
    let mut search = Search { strands, flat, apart, near, limit: options.limit, found: Vec::new(), crossings: 0 };
    let mut outcome = Ok(());
    boxes.overlapping(
        |_| true,
        |i, j| {
            if outcome.is_ok() {
                outcome = search.pair(&pieces[i as usize], &pieces[j as usize]);
            }
        },
    );
    outcome?;
    let Search { found, crossings, .. } = search;
    insert(strands, found);
    // Copies were cut by third strokes at places of their own.
    share(strands, near);
    Ok(crossings)
}

/// Adds stops to strands.
fn insert(strands: &mut [Strand<'_>], found: Vec<(u32, Stop)>) {
    for (strand, stop) in found {
        if let Some(strand) = strands.get_mut(strand as usize) {
            strand.stops.push(stop);
        }
    }
    for strand in strands.iter_mut() {
        // Stable: of equal parameters the stop that came first stays, which is the sample.
        strand.stops.sort_by(|a, b| a.u.total_cmp(&b.u));
        strand.stops.dedup_by(|later, kept| later.u == kept.u);
    }
}

/// Gives every curve the vertices of others that lie on it: ends of strokes at T-junctions, samples of copies. Two
/// different samplings of one curve become one sampling, so that their pieces are twins.
fn share(strands: &mut [Strand<'_>], near: f64) {
    let pieces = all_pieces(strands);
    let boxes = Boxes::new(pieces.iter().map(|piece| piece.hull.bounds(near / 2.0)).collect());
    let mut found = Vec::new();
    let mut offer = |a: &Piece, b: &Piece| {
        let track = strands[b.strand as usize].track;
        for p in a.ends.into_iter().filter(|p| !b.ends.contains(p)) {
            let Some(share) = b.hull.beside(&p, near) else { continue };
            let u = track.nearest(&p, b.from, b.to, b.from + share * (b.to - b.from));
            if b.from < u && u < b.to && track.eval(u).distance(&p) <= near {
                found.push((b.strand, Stop { u, point: p }));
            }
        }
    };
    boxes.overlapping(
        |_| true,
        |i, j| {
            let (a, b) = (&pieces[i as usize], &pieces[j as usize]);
            // The common vertex of neighbours must not be taken for a touch.
            if a.strand != b.strand || (a.to < b.from && strands[a.strand as usize].length() > b.to - a.from) {
                offer(a, b);
                offer(b, a);
            }
        },
    );
    insert(strands, found);
}

/// Halves pieces that turn far, so that each lies along its chord.
fn straighten(strand: &mut Strand<'_>, flat: f64, limit: usize) -> Result<(), NodeError> {
    let least = if strand.closed { 4 } else { 1 };
    let mut coarse = strand.stops.len() <= least;
    let mut out: Vec<Stop> = strand.stops.first().copied().into_iter().collect();
    let track = strand.track;
    for pair in strand.stops.windows(2) {
        let [Stop { u: from, .. }, end] = [pair[0], pair[1]];
        // What is still to be halved, nearest on top.
        let mut ends = vec![(end.u, 0)];
        let mut from = from;
        while let Some((to, depth)) = ends.pop() {
            let hull = Hull::of(&track, from, to);
            let deviation = hull.deviation();
            let bends = deviation > flat && (deviation > ROUND * hull.chord || !track.advances(from, to, &hull.along));
            let middle = 0.5 * (from + to);
            let splits = (bends && depth < MAX_DEPTH) || (coarse && depth < 2);
            if splits && from < middle && middle < to {
                ends.push((to, depth + 1));
                ends.push((middle, depth + 1));
                continue;
            }
            let point = if to == end.u { end.point } else { track.eval(to) };
            out.push(Stop { u: to, point });
            if out.len() > limit {
                return Err(NodeError::TooMany { limit });
            }
            from = to;
        }
        coarse = coarse && strand.closed;
    }
    strand.stops = out;
    Ok(())
}

fn all_pieces(strands: &[Strand<'_>]) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for (number, strand) in (0..).zip(strands) {
        for pair in strand.stops.windows(2) {
            let (from, to) = (pair[0].u, pair[1].u);
            let hull = Hull::of(&strand.track, from, to);
            pieces.push(Piece { strand: number, from, to, hull, ends: [pair[0].point, pair[1].point] });
        }
    }
    pieces
}

fn halves(track: &Track<'_>, piece: &Piece) -> [Piece; 2] {
    let middle = 0.5 * (piece.from + piece.to);
    let half = |from, to, ends| Piece { from, to, hull: Hull::of(track, from, to), ends, ..*piece };
    let point = track.eval(middle);
    [half(piece.from, middle, [piece.ends[0], point]), half(middle, piece.to, [point, piece.ends[1]])]
}

struct Search<'s, 'a> {
    strands: &'s [Strand<'a>],
    flat: f64,
    /// Pieces farther from each other than this have nothing to do with each other.
    apart: f64,
    /// Points this near are one.
    near: f64,
    limit: usize,
    /// New stops by strand.
    found: Vec<(u32, Stop)>,
    crossings: usize,
}

impl Strand<'_> {
    /// How far the parameter runs from the first stop to the last.
    fn length(&self) -> f64 {
        self.stops.first().zip(self.stops.last()).map_or(0.0, |(first, last)| last.u - first.u)
    }
}

impl<'a> Search<'_, 'a> {
    fn track(&self, piece: &Piece) -> Track<'a> {
        self.strands[piece.strand as usize].track
    }

    /// Two pieces of the refined chains whose boxes overlap.
    fn pair(&mut self, a: &Piece, b: &Piece) -> Result<(), NodeError> {
        let mut shared = a.ends.into_iter().filter(|end| b.ends.contains(end));
        match (shared.next(), shared.next()) {
            (Some(corner), None) => self.neighbours(a, b, corner),
            _ => self.strangers(a, b),
        }
    }

    fn is_flat(&self, piece: &Piece) -> bool {
        let middle = 0.5 * (piece.from + piece.to);
        piece.hull.deviation() <= self.flat || !(piece.from < middle && middle < piece.to)
    }

    /// The pieces coincide, in either direction: their ends are the same points, and four points between them lie on the other curve.
    fn are_twins(&self, a: &Piece, b: &Piece) -> bool {
        if a.ends != b.ends && a.ends != [b.ends[1], b.ends[0]] {
            return false;
        }
        let (track_a, track_b) = (self.track(a), self.track(b));
        (1..5).all(|i| {
            let share = f64::from(i) / 5.0;
            let p = track_a.eval(a.from + share * (a.to - a.from));
            let guess = b.hull.beside(&p, f64::INFINITY).unwrap_or(share);
            let q = track_b.eval(track_b.nearest(&p, b.from, b.to, b.from + guess * (b.to - b.from)));
            p.distance(&q) <= self.near
        })
    }

    /// Two pieces that do not follow each other.
    fn strangers(&mut self, a: &Piece, b: &Piece) -> Result<(), NodeError> {
        let mut pending = vec![(*a, *b)];
        while let Some((a, b)) = pending.pop() {
            if a.hull.is_apart(&b.hull, self.apart) || self.are_twins(&a, &b) {
                continue;
            }
            // From here on both have to be pieces of their chains: their halves may be apart where their chords cross.
            for piece in [&a, &b] {
                self.found.push((piece.strand, Stop { u: piece.from, point: piece.ends[0] }));
                self.found.push((piece.strand, Stop { u: piece.to, point: piece.ends[1] }));
            }
            if self.found.len() > self.limit.saturating_mul(4) {
                return Err(NodeError::TooMany { limit: self.limit });
            }
            let (flat_a, flat_b) = (self.is_flat(&a), self.is_flat(&b));
            if flat_a && flat_b {
                self.cross(&a, &b);
                continue;
            }
            // The rounder of the two: halving it gains most.
            let first = !flat_a && (flat_b || a.hull.deviation() >= b.hull.deviation());
            let (halved, whole) = if first { (&a, &b) } else { (&b, &a) };
            let [left, right] = halves(&self.track(halved), halved);
            self.found.push((halved.strand, Stop { u: left.to, point: left.ends[1] }));
            pending.extend([(left, *whole), (right, *whole)]);
        }
        Ok(())
    }

    /// Two pieces that share the vertex at `corner`.
    fn neighbours(&mut self, a: &Piece, b: &Piece, corner: Point<f64>) -> Result<(), NodeError> {
        let (track_a, track_b) = (self.track(a), self.track(b));
        let (mut a, mut b) = (*a, *b);
        for _ in 0..MAX_DEPTH {
            // The line through the corner that is most likely to part them: between the two directions that leave it.
            let [leaves_a, leaves_b] = [&a, &b]
                .map(|piece| if piece.ends[0] == corner { piece.hull.along } else { piece.hull.along.opposite() });
            let normal = leaves_b.minus(&leaves_a);
            let parted = normal.unit().is_some_and(|normal| {
                track_a.is_below(a.from, a.to, &corner, &normal, self.near)
                    && track_b.is_below(b.from, b.to, &corner, &normal.opposite(), self.near)
            });
            // The sine of the angle between the chords; of a right one where they leave each other backwards.
            let spread = if leaves_a.dot(&leaves_b) > 0.0 { leaves_a.cross(&leaves_b).abs() } else { f64::INFINITY };
            // Three times the deviation over the chord bounds the slope at the vertex.
            let bend = |piece: &Piece| 8.0 * piece.hull.deviation() / piece.hull.chord;
            if (parted && bend(&a).max(bend(&b)) <= spread) || (self.is_flat(&a) && self.is_flat(&b)) {
                break;
            }
            let order = |piece: &Piece, [first, second]: [Piece; 2]| {
                if piece.ends[0] == corner { [first, second] } else { [second, first] }
            };
            let [near_a, far_a] = order(&a, halves(&track_a, &a));
            let [near_b, far_b] = order(&b, halves(&track_b, &b));
            for (piece, half) in [(&a, &near_a), (&b, &near_b)] {
                let (u, point) = if half.to < piece.to { (half.to, half.ends[1]) } else { (half.from, half.ends[0]) };
                self.found.push((piece.strand, Stop { u, point }));
            }
            self.strangers(&far_a, &near_b)?;
            self.strangers(&far_a, &far_b)?;
            self.strangers(&near_a, &far_b)?;
            (a, b) = (near_a, near_b);
        }
        Ok(())
    }

    /// Puts the crossing of two flat pieces on both curves, where their chords cross.
    fn cross(&mut self, a: &Piece, b: &Piece) {
        // Room for what the curves do within the flatness.
        const SLACK: f64 = 0.05;
        let (chord_a, chord_b) = (a.hull.end.minus(&a.hull.start), b.hull.end.minus(&b.hull.start));
        let area = chord_a.cross(&chord_b);
        let between = b.hull.start.minus(&a.hull.start);
        let (s, t) = (between.cross(&chord_b) / area, between.cross(&chord_a) / area);
        let within = |x: f64| (-SLACK..=1.0 + SLACK).contains(&x);
        // Also false where the chords are parallel. Where they cross and part by less than twice the merging distance over all their
        // length, an end of one is as good as on the other: they are joined there, and Newton's method would find a crossing anywhere
        // along them.
        let parts = area.abs() > 2.0 * self.near * a.hull.chord.max(b.hull.chord);
        if !(parts && within(s) && within(t)) {
            return;
        }
        let at = |piece: &Piece, share: f64| piece.from + share.clamp(0.0, 1.0) * (piece.to - piece.from);
        let (track_a, track_b) = (self.track(a), self.track(b));
        let (mut u, mut v) = (at(a, s), at(b, t));
        for _ in 0..8 {
            let gap = track_b.eval(v).minus(&track_a.eval(u));
            let (da, db) = (track_a.derivative(u), track_b.derivative(v));
            let area = da.cross(&db);
            let (du, dv) = (gap.cross(&db) / area, gap.cross(&da) / area);
            if !(du.is_finite() && dv.is_finite()) {
                break;
            }
            (u, v) = ((u + du).clamp(a.from, a.to), (v + dv).clamp(b.from, b.to));
            if du.abs() <= f64::EPSILON * u && dv.abs() <= f64::EPSILON * v {
                break;
            }
        }
        let (p, q) = (track_a.eval(u), track_b.eval(v));
        if p.distance(&q) <= self.flat / 8.0 {
            let point = p.middle(&q);
            self.found.push((a.strand, Stop { u, point }));
            self.found.push((b.strand, Stop { u: v, point }));
            self.crossings += 1;
        }
    }
}
