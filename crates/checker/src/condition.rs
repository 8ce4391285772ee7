//! The ε-condition, judged at every point of the curve.
//!
//! Every p of C needs a sample s with |p−s| < ε·lfs(p). Both sides are Lipschitz in arc length (with constants 1 and
//! ε), so a probe with its neighbourhood of half-length h gives the bound (|p−s|+h) / (lfs−h) on the ratio around it;
//! intervals are halved until that bound is within a stated slack of the largest ratio seen. The largest ratios are
//! then polished with exact disks. Near corners, crossings, T-junctions, cusps and retracted handles the *floored*
//! condition stands in: on the stretch of the path around such a point where ε·lfs < 1e-3 of the diagonal, p must lie
//! nearer than that to one of its two neighbours along its own path. Elsewhere the floor is 1e-7 of the diagonal. A
//! floor of the user's own takes the place of both.

use crate::contact::{Contact, TOUCH};
use crate::door::Drawing;
use crate::lfs::Evaluator;
use crate::plane::{V2, minimise};
use crate::tree::Tree;

/// A sample to be judged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Index of its path in the raw drawing.
    pub path: usize,
    /// Index of its cubic in the raw path; one past the last for an added closing line.
    pub segment: usize,
    /// Parameter on that cubic.
    pub t: f64,
    /// Where it claims to be.
    pub point: V2,
}

/// What the judge may be told.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// The floor that the user gave, if any.
    pub min_distance: Option<f64>,
    /// Relative excess over ε that still passes: the checker's own error.
    pub tolerance: f64,
    /// Points this near (shares of the diagonal) to a contact, a corner or an open end are left out of the judgement
    /// and of the effective ε. Zero for a real judgement; comparisons with published figures need it.
    pub leave_out: f64,
}

impl Default for Options {
    fn default() -> Self {
        Options { min_distance: None, tolerance: 1e-8, leave_out: 0.0 }
    }
}

/// A point of the curve where the condition fails.
#[derive(Clone, Copy, Debug)]
pub struct Violation {
    /// Index of the path.
    pub path: usize,
    /// Index of the cubic in the raw path.
    pub segment: usize,
    /// Parameter on that cubic.
    pub t: f64,
    /// The point.
    pub point: V2,
    /// Distance to the sample over what is allowed; 1 would be the limit.
    pub ratio: f64,
    /// Whether a floor, not lfs, set what is allowed.
    pub floored: bool,
}

/// The judgement.
#[derive(Clone, Debug)]
pub struct Report {
    /// Worst point of each gap that fails.
    pub violations: Vec<Violation>,
    /// Largest |p−s| / lfs(p) where no floor decides.
    pub effective_epsilon: f64,
    /// Where that is.
    pub worst: Option<V2>,
    /// Share of the length of the curve on which a floor decides.
    pub share_under_floor: f64,
    /// The tolerance used.
    pub tolerance_used: f64,
    /// Between probes no ratio is larger than the reported ones by more than this share.
    pub slack: f64,
    /// Largest distance of the curve from the chord between neighbouring samples.
    pub max_chord_error: f64,
    /// Pairs of consecutive samples (indices into the given list) whose edge no Delaunay triangulation of all samples
    /// has.
    pub missing_edges: Vec<(usize, usize)>,
    /// Largest ratio of neighbouring gaps.
    pub grading: f64,
    /// Smallest and largest gap.
    pub gaps: (f64, f64),
    /// Largest distance between a sample and the point that its parameters name.
    pub off_curve: f64,
    /// Consecutive samples, as indices into the given list.
    pub edges: Vec<(usize, usize)>,
}

/// Bounds between probes are driven to within this share.
const SLACK: f64 = 2e-3;

/// So many local maxima of one part of a gap are polished, the largest first.
const MAXIMA: usize = 8;

/// One path with its samples, addressed by g = number of the piece + parameter along it.
struct Track<'a> {
    drawing: &'a Drawing,
    path: usize,
}

impl Track<'_> {
    fn count(&self) -> usize {
        self.drawing.paths[self.path].pieces.len()
    }

    /// Obstacle and its own parameter for piece i, parameter x along the path.
    fn place(&self, i: usize, x: f64) -> (usize, f64) {
        let piece = self.drawing.paths[self.path].pieces[i];
        (piece.cubic, if piece.reversed { 1.0 - x } else { x })
    }

    fn at(&self, i: usize, x: f64) -> V2 {
        let (cubic, t) = self.place(i, x);
        self.drawing.cubics[cubic].at(t)
    }

    fn length_bound(&self, i: usize, x0: f64, x1: f64) -> f64 {
        let (cubic, a) = self.place(i, x0);
        let (_, b) = self.place(i, x1);
        self.drawing.cubics[cubic].length_bound(a.min(b), a.max(b))
    }

    /// The address of a raw segment and parameter; a dropped segment is where its predecessor ends.
    #[expect(clippy::cast_precision_loss, reason = "paths have far fewer than 2^52 pieces")]
    fn address(&self, segment: usize, t: f64) -> f64 {
        let pieces = &self.drawing.paths[self.path].pieces;
        let i = pieces.partition_point(|p| p.segment < segment);
        match pieces.get(i) {
            Some(p) if p.segment == segment => i as f64 + t,
            _ => i as f64,
        }
    }

    /// Piece and parameter of an address; the end of the path belongs to its last piece.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "addresses are small and positive")]
    #[expect(clippy::cast_precision_loss, reason = "paths have far fewer than 2^52 pieces")]
    fn split(&self, g: f64) -> (usize, f64) {
        let n = self.count();
        let g = if self.drawing.paths[self.path].closed && g >= n as f64 { g - n as f64 } else { g };
        let i = (g.max(0.0) as usize).min(n - 1);
        (i, g - i as f64)
    }
}

/// Obstacle, its own parameter, and whether the path runs it backwards, for a raw segment and parameter.
pub(crate) fn place(drawing: &Drawing, path: usize, segment: usize, t: f64) -> (usize, f64, bool) {
    let track = Track { drawing, path };
    let (i, x) = track.split(track.address(segment, t));
    let (cubic, t) = track.place(i, x);
    (cubic, t, drawing.paths[path].pieces[i].reversed)
}

/// A part of a gap on one piece, with one rule.
#[derive(Clone, Copy)]
struct Part {
    piece: usize,
    x0: f64,
    x1: f64,
    floored: bool,
}

struct Judge<'a> {
    evaluator: &'a Evaluator,
    epsilon: f64,
    options: Options,
    tree: Tree,
    skip: Vec<V2>,
}

/// What is asked of a point, as ratio to what is allowed, and whether the floor gave it.
#[derive(Clone, Copy)]
struct Probe {
    ratio: f64,
    bound: f64,
    allowed: f64,
    floored: bool,
}

impl Judge<'_> {
    /// Floor outside of stretches.
    fn floor(&self) -> f64 {
        self.options.min_distance.unwrap_or(TOUCH * self.evaluator.scene.drawing.diagonal)
    }

    /// The ratio at a point of a part, and a bound of it within h, given lfs and its slack.
    fn probe(&self, p: V2, neighbours: [Option<V2>; 2], floored: bool, lfs: (f64, f64), h: f64) -> Probe {
        let own = neighbours.into_iter().flatten().map(|s| p.distance(s)).fold(f64::INFINITY, f64::min);
        if floored {
            let floor = 1e-3 * self.evaluator.scene.drawing.diagonal;
            return Probe { ratio: own / floor, bound: (own + h) / floor, allowed: floor, floored };
        }
        let floor = self.floor();
        // Nearer than a neighbour there may be any other sample.
        let any = self.tree.nearest(p, own).map_or(own, |(_, d)| d);
        let allowed = self.epsilon * lfs.0;
        let least = self.epsilon * (lfs.0 - lfs.1 - h).max(0.0);
        let by = |d: f64, a: f64| if a == f64::INFINITY { 0.0 } else { d / a };
        let (feature, floor_ratio) = (by(any, allowed), by(own, floor));
        let bound = by(any + h, least).min(by(own + h, floor));
        Probe {
            ratio: feature.min(floor_ratio),
            bound,
            allowed: allowed.max(floor).min(1e300),
            floored: floor_ratio < feature,
        }
    }

    /// Whether all points within h of p are left out.
    fn skipped(&self, p: V2, h: f64) -> bool {
        let radius = self.options.leave_out * self.evaluator.scene.drawing.diagonal;
        radius > 0.0 && self.skip.iter().any(|s| s.distance(p) + h < radius)
    }

    /// Local maxima of the coarse ratio on a part: place, bracket, ratio. Nothing above `best` times the slack is lost.
    fn scan(&self, track: &Track, part: Part, neighbours: [Option<V2>; 2], best: f64) -> Vec<(f64, f64, f64, f64)> {
        let mut probes: Vec<(f64, f64)> = Vec::new();
        let mut stack: Vec<(f64, f64)> = Vec::new();
        let n = 8;
        let x = |i: i32| part.x0 + (part.x1 - part.x0) * f64::from(i) / f64::from(n);
        stack.extend((0..n).map(|i| (x(i), x(i + 1))));
        let mut largest = best;
        let coarse = |p: V2| {
            if part.floored {
                return (0.0, 0.0);
            }
            // A slack above half the aim would keep the search from ever ending.
            let (lfs, slack) = self.evaluator.coarse(p);
            if slack > 0.4 * SLACK * lfs { (self.evaluator.fine(p).lfs, 0.0) } else { (lfs, slack) }
        };
        for i in [0, n] {
            let p = track.at(part.piece, x(i));
            if !self.skipped(p, 0.0) {
                probes.push((x(i), self.probe(p, neighbours, part.floored, coarse(p), 0.0).ratio));
            }
        }
        while let Some((a, b)) = stack.pop() {
            let m = 0.5 * (a + b);
            let p = track.at(part.piece, m);
            // The half that is longer bounds how far the interval reaches.
            let h = track.length_bound(part.piece, a, m).max(track.length_bound(part.piece, m, b));
            if self.skipped(p, h) {
                continue;
            }
            let probe = self.probe(p, neighbours, part.floored, coarse(p), h);
            if !self.skipped(p, 0.0) {
                probes.push((m, probe.ratio));
                largest = largest.max(probe.ratio);
            }
            if probe.bound > largest * (1.0 + SLACK) && b - a > 1e-9 {
                stack.extend([(a, m), (m, b)]);
            }
        }
        probes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut out = Vec::new();
        for (i, &(m, ratio)) in probes.iter().enumerate() {
            let (l, r) = (i.saturating_sub(1), (i + 1).min(probes.len() - 1));
            // Coarse lfs may rank two maxima wrongly by its own error.
            if ratio >= (1.0 - 3.0 * SLACK) * largest && (i == 0 || ratio > probes[l].1) && ratio >= probes[r].1 {
                out.push((m, probes[l].0, probes[r].0, ratio));
            }
        }
        // A plateau (D and lfs both proportional to the distance from a corner) has countless equal maxima.
        out.sort_by(|a, b| b.3.total_cmp(&a.3));
        out.truncate(MAXIMA);
        out
    }

    /// The maximum of the exact ratio in a bracket.
    fn polish(&self, track: &Track, part: Part, neighbours: [Option<V2>; 2], at: (f64, f64, f64)) -> (f64, Probe) {
        let exact = |x: f64| {
            let p = track.at(part.piece, x);
            let lfs = if part.floored { 0.0 } else { self.evaluator.fine(p).lfs };
            self.probe(p, neighbours, part.floored, (lfs, 0.0), 0.0)
        };
        let (m, lo, hi) = at;
        let mut best = (m, exact(m));
        // A step of 1e-8 of the distance that is allowed moves the ratio by about as much.
        let allowed = if part.floored { 1e-3 * self.evaluator.scene.drawing.diagonal } else { best.1.allowed };
        let width = track.length_bound(part.piece, lo, hi).max(1e-300);
        let tolerance = (1e-8 * (part.x1 - part.x0)).max(3e-9 * allowed / width * (hi - lo));
        if tolerance > hi - lo {
            return best;
        }
        minimise(
            |x| {
                let probe = exact(x);
                if probe.ratio > best.1.ratio && !self.skipped(track.at(part.piece, x), 0.0) {
                    best = (x, probe);
                }
                -probe.ratio
            },
            lo,
            hi,
            tolerance,
        );
        best
    }

    /// The stretch around g where ε·lfs stays below the floor of contacts.
    fn stretch(&self, track: &Track, g: f64) -> (f64, f64) {
        let limit = 1e-3 * self.evaluator.scene.drawing.diagonal / self.epsilon;
        let out = [-1.0, 1.0].map(|direction| self.reach(track, g, direction, limit));
        (out[0], out[1])
    }

    /// Walks from g until lfs reaches `limit`. lfs is 1-Lipschitz, so a step of limit − lfs cannot pass the place.
    #[expect(clippy::cast_precision_loss, reason = "paths have far fewer than 2^52 pieces")]
    fn reach(&self, track: &Track, g: f64, direction: f64, limit: f64) -> f64 {
        let n = track.count() as f64;
        let closed = track.drawing.paths[track.path].closed;
        let wrap = |g: f64| if closed { g.rem_euclid(n) } else { g.clamp(0.0, n) };
        let point = |g: f64| {
            let (i, x) = track.split(wrap(g));
            track.at(i, x)
        };
        let mut here = g;
        loop {
            if (here - g).abs() >= n || (!closed && if direction > 0.0 { here >= n } else { here <= 0.0 }) {
                return here;
            }
            let lfs = self.evaluator.coarse(point(here)).0;
            let stride = (limit - lfs).max(1e-3 * limit);
            // Never across the end of a piece: the next step starts there.
            let room = if direction > 0.0 { here.floor() + 1.0 - here } else { here - (here.ceil() - 1.0) };
            let mut step = room;
            loop {
                let (a, b) = if direction > 0.0 { (here, here + step) } else { (here - step, here) };
                let base = if direction > 0.0 { here.floor() } else { here.ceil() - 1.0 };
                let (i, _) = track.split(wrap(base));
                if step < 1e-12 || track.length_bound(i, a - base, b - base) <= stride {
                    break;
                }
                step *= 0.5;
            }
            let next = if step == room {
                if direction > 0.0 { here.floor() + 1.0 } else { here.ceil() - 1.0 }
            } else {
                here + direction * step
            };
            let (near, slack) = self.evaluator.coarse(point(next));
            if near + slack >= limit && self.evaluator.fine(point(next)).lfs >= limit {
                let (mut inside, mut outside) = (here, next);
                for _ in 0..24 {
                    let m = 0.5 * (inside + outside);
                    if self.evaluator.fine(point(m)).lfs < limit {
                        inside = m;
                    } else {
                        outside = m;
                    }
                }
                return outside;
            }
            here = next;
        }
    }
}

/// Cuts the addresses [from, to] of a path into parts by pieces and by stretches (sorted, disjoint, within [0, n]).
#[expect(clippy::cast_precision_loss, reason = "paths have far fewer than 2^52 pieces")]
fn parts(track: &Track, from: f64, to: f64, stretches: &[(f64, f64)]) -> Vec<Part> {
    let n = track.count() as f64;
    let mut cuts = vec![from, to];
    let mut whole = from.floor() + 1.0;
    while whole < to {
        cuts.push(whole);
        whole += 1.0;
    }
    for shift in [0.0, n] {
        for &(a, b) in stretches {
            cuts.extend([a + shift, b + shift].into_iter().filter(|&c| c > from && c < to));
        }
    }
    cuts.sort_by(f64::total_cmp);
    let mut out = Vec::new();
    for w in cuts.windows(2).filter(|w| w[1] - w[0] > 1e-13) {
        let m = 0.5 * (w[0] + w[1]);
        let (piece, x) = track.split(m);
        let half = 0.5 * (w[1] - w[0]);
        let wrapped = if m >= n { m - n } else { m };
        let floored = stretches.iter().any(|&(a, b)| a <= wrapped && wrapped <= b);
        out.push(Part { piece, x0: (x - half).max(0.0), x1: (x + half).min(1.0), floored });
    }
    out
}

/// Sorts intervals, cuts them at the ends of [0, n] (wrapping on closed paths) and unites those that meet.
fn unite(raw: Vec<(f64, f64)>, n: f64, closed: bool) -> Vec<(f64, f64)> {
    let mut cut: Vec<(f64, f64)> = Vec::new();
    for (a, b) in raw {
        cut.push((a.max(0.0), b.min(n)));
        if closed && a < 0.0 {
            cut.push(((a + n).max(0.0), n));
        }
        if closed && b > n {
            cut.push((0.0, (b - n).min(n)));
        }
    }
    cut.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut out: Vec<(f64, f64)> = Vec::new();
    for (a, b) in cut {
        match out.last_mut() {
            Some(last) if a <= last.1 => last.1 = last.1.max(b),
            _ => out.push((a, b)),
        }
    }
    out
}

/// Judges samples against ε.
#[expect(clippy::cast_precision_loss, reason = "paths have far fewer than 2^52 pieces")]
pub(crate) fn judge(
    evaluator: &Evaluator,
    contacts: &[Contact],
    samples: &[Sample],
    epsilon: f64,
    options: Options,
) -> Report {
    let drawing = &evaluator.scene.drawing;
    let ends = drawing.vertices.iter().filter(|v| v.branches.len() == 1).map(|v| v.at);
    let judge = Judge {
        evaluator,
        epsilon,
        options,
        tree: Tree::new(samples.iter().map(|s| (s.point, s.point))),
        skip: contacts.iter().map(|c| c.at).chain(ends).collect(),
    };
    let mut report = Report {
        violations: Vec::new(),
        effective_epsilon: 0.0,
        worst: None,
        share_under_floor: 0.0,
        tolerance_used: options.tolerance,
        slack: SLACK,
        max_chord_error: 0.0,
        missing_edges: Vec::new(),
        grading: 1.0,
        gaps: (f64::INFINITY, 0.0),
        off_curve: 0.0,
        edges: Vec::new(),
    };
    let (mut length, mut under) = (0.0, 0.0);
    for path in 0..drawing.paths.len() {
        let track = Track { drawing, path };
        if track.count() == 0 {
            continue;
        }
        let n = track.count() as f64;
        let closed = drawing.paths[path].closed;
        let mut stretches = Vec::new();
        if options.min_distance.is_none() {
            for (i, piece) in drawing.paths[path].pieces.iter().enumerate() {
                for &(cubic, t) in contacts.iter().flat_map(|c| &c.places) {
                    if cubic == piece.cubic {
                        let g = i as f64 + if piece.reversed { 1.0 - t } else { t };
                        if !stretches.iter().any(|&(a, b)| a <= g && g <= b) {
                            stretches.push(judge.stretch(&track, g));
                        }
                    }
                }
            }
        }
        let stretches = unite(stretches, n, closed);
        for part in parts(&track, 0.0, n, &stretches) {
            let (cubic, a) = track.place(part.piece, part.x0);
            let (_, b) = track.place(part.piece, part.x1);
            let whole = drawing.cubics[cubic].length(a.min(b), a.max(b));
            let cells = if part.floored { 0 } else { 100 };
            let x = |cell: i32| part.x0 + (part.x1 - part.x0) * (f64::from(cell) + 0.5) / f64::from(cells);
            let low = |&cell: &i32| epsilon * evaluator.coarse(track.at(part.piece, x(cell))).0 < judge.floor();
            length += whole;
            under += if part.floored { whole } else { whole * 0.01 * (0..cells).filter(low).count() as f64 };
        }

        let mut own: Vec<(f64, usize)> = Vec::new();
        for (index, s) in samples.iter().enumerate().filter(|(_, s)| s.path == path) {
            let mut g = track.address(s.segment, s.t);
            let (i, x) = track.split(g);
            let claimed = track.at(i, x).distance(s.point);
            if claimed > 1e-9 * drawing.diagonal {
                // Straightened lines and turned handles move parameters a little: trust the point, not the parameter.
                let (cubic, _) = track.place(i, x);
                let (t, off) = drawing.cubics[cubic].project(s.point);
                let (_, along) = track.place(i, t);
                g = i as f64 + along;
                report.off_curve = report.off_curve.max(off);
            }
            own.push((if closed && g >= n { g - n } else { g }, index));
        }
        own.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));

        let mut gaps: Vec<(f64, f64, Option<usize>, Option<usize>)> = Vec::new();
        for w in own.windows(2) {
            gaps.push((w[0].0, w[1].0, Some(w[0].1), Some(w[1].1)));
        }
        match (own.first(), own.last()) {
            (Some(&(first, a)), Some(&(last, b))) if closed => gaps.push((last, first + n, Some(b), Some(a))),
            (Some(&(first, a)), Some(&(last, b))) => {
                gaps.insert(0, (0.0, first, None, Some(a)));
                gaps.push((last, n, Some(b), None));
            }
            _ => gaps.push((0.0, n, None, None)),
        }
        let mut sizes = Vec::new();
        for &(from, to, a, b) in &gaps {
            let seat = |s: Option<usize>| s.map(|i| samples[i].point);
            let neighbours = [seat(a), seat(b)];
            let parts = parts(&track, from, to, &stretches);
            if let (Some(i), Some(j)) = (a, b) {
                report.edges.push((i, j));
                let (p, q) = (samples[i].point, samples[j].point);
                sizes.push(p.distance(q));
                for part in &parts {
                    let off = |x: f64| track.at(part.piece, x).distance_to_segment(p, q).0;
                    let cells = 32;
                    let x = |k: i32| part.x0 + (part.x1 - part.x0) * f64::from(k) / f64::from(cells);
                    let k = (0..=cells).max_by(|&k, &l| off(x(k)).total_cmp(&off(x(l)))).unwrap_or(0);
                    let peak = minimise(|x| -off(x), x((k - 1).max(0)), x((k + 1).min(cells)), 1e-9);
                    report.max_chord_error = report.max_chord_error.max(-peak.1).max(off(x(k)));
                }
            }
            let mut worst: Option<Violation> = None;
            for part in parts {
                // Ratios well below both the limit and the largest one seen need no care.
                let seen = report.effective_epsilon / epsilon;
                let least = if part.floored { 0.9 } else { 0.9 * seen.min(1.0) };
                for (m, lo, hi, ratio) in judge.scan(&track, part, neighbours, least) {
                    let matters = ratio * (1.0 + 3.0 * SLACK) >= 1.0
                        || (!part.floored && ratio * (1.0 + 3.0 * SLACK) >= report.effective_epsilon / epsilon);
                    if !matters {
                        continue;
                    }
                    let (x, probe) = judge.polish(&track, part, neighbours, (m, lo, hi));
                    let point = track.at(part.piece, x);
                    if !probe.floored && probe.ratio * epsilon > report.effective_epsilon {
                        report.effective_epsilon = probe.ratio * epsilon;
                        report.worst = Some(point);
                    }
                    if probe.ratio >= 1.0 + options.tolerance && worst.is_none_or(|w| w.ratio < probe.ratio) {
                        let segment = drawing.paths[path].pieces[part.piece].segment;
                        worst =
                            Some(Violation { path, segment, t: x, point, ratio: probe.ratio, floored: probe.floored });
                    }
                }
            }
            report.violations.extend(worst);
        }
        for (i, &size) in sizes.iter().enumerate() {
            report.gaps = (report.gaps.0.min(size), report.gaps.1.max(size));
            let next = if i + 1 < sizes.len() { Some(sizes[i + 1]) } else { closed.then(|| sizes[0]) };
            if let Some(next) = next {
                report.grading = report.grading.max(size / next).max(next / size);
            }
        }
    }
    report.share_under_floor = if length > 0.0 { under / length } else { 0.0 };
    report.missing_edges = crate::delaunay::missing(samples, &report.edges);
    report
}
