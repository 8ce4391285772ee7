//! Iterated snap rounding: segments between lattice points, cut until they meet in vertices only.
//!
//! Coordinates are whole numbers of a unit, a quarter of a pitch at first. A round looks at every pair of segments of which one is new: where they
//! cross properly (exact signs, 128 bits), both are led through the lattice point nearest to the crossing; where an end of
//! one lies within 0.7 units of the other, that one is led through it. Equal segments become one, with the
//! owners of both. A round without a change ends it, and then no two segments meet but in a common vertex. Sources:
//! Hobby, "Practical segment intersection with finite precision output", 1999; Halperin and Packer, "Iterated snap
//! rounding", 2002.
//!
//! **It ends.** A segment of length L that is led through lattice points nearer than 0.7 falls into pieces that are all
//! shorter than L: lattice points are at least 1 apart, so the first and last piece lose at least 0.7 along the segment,
//! and a middle piece from one side to the other is at most √((L − 1.4)² + 1.4²) long, which is less than L from L = 1.4
//! on. (With a tolerance of √½ the diagonal of a lattice square could be led through both other corners, that is, turn into
//! the other diagonal, and back.) Squared lengths are whole numbers, so without new crossings this stops. New crossings
//! come of segments that moved; rounds are capped.
//!
//! **Drift.** Each time it is led through a vertex a segment moves a little, and could wander off in many steps. So no
//! segment is led through a near vertex that is farther than a pitch (less the rounding of a crossing) from the chord it
//! comes from. Only proper crossings and vertices exactly on a segment have to be obeyed whatever the distance. Where many
//! strokes lie within a few units of each other, one could lead to the next, and a segment go astray by more than a pitch. The way is
//! as long in units on any lattice, so such sets are rounded again on a finer one ([`UNITS`]): few, as strokes so near are one before
//! they come here (`--example node_survey` counts them).

use std::collections::HashMap;

use feature_sampling::geometry::{Aabb, Point};

use super::cluster::Clusters;
use super::meet::Strand;
use super::pairs::Boxes;
use super::{Edge, NodeError, Noded, Options, Owner, Report, Vertex};

/// Lattice units in a pitch: the first number serves, unless a segment would end up farther than a pitch from its chord.
const UNITS: [f64; 3] = [4.0, 16.0, 64.0];
/// An end nearer to a segment than this is on it, in units; less than half a diagonal of a lattice square.
const NEAR: f64 = 0.7;
/// Half a diagonal of a lattice square: how far the rounding of a crossing moves it, in units.
const ROUNDING: f64 = 0.7072;
/// Vertices nearer to each other than this become one before they are rounded, in units.
const SAME: f64 = 0.5;
type Place = [i64; 2];

/// One owner of a segment while it is being cut: parameters at its two ends and the chord it comes from.
#[derive(Clone, Copy, Debug)]
struct Claim {
    owner: Owner,
    chord: u32,
}

/// A segment between two vertices, the lower number first.
#[derive(Clone, Debug)]
struct Segment {
    ends: [u32; 2],
    claims: Vec<Claim>,
    /// Came up in the round before.
    fresh: bool,
}

struct Lattice<'s, 'a> {
    strands: &'s [Strand<'a>],
    origin: Point<f64>,
    unit: f64,
    /// Farther than this from its chord no segment is led through a vertex that is merely near, in units.
    drift: f64,
    places: Vec<Place>,
    exact: Vec<Point<f64>>,
    by_place: HashMap<Place, u32>,
    segments: Vec<Segment>,
    /// Chords of the curves themselves, in units, before anything was merged or rounded; and the strand of each.
    chords: Vec<([Point<f64>; 2], u32)>,
}

/// Coordinates on the coarsest lattice would not be whole doubles any more.
pub(super) fn is_too_fine(bounds: &Aabb<f64>, options: &Options) -> bool {
    UNITS.first().is_none_or(|units| overflows(bounds, options.pitch / units))
}

fn overflows(bounds: &Aabb<f64>, unit: f64) -> bool {
    let extent = bounds.extent();
    extent.x.max(extent.y) / unit >= 4_503_599_627_370_496.0
}

/// Rounds the strands, on the first lattice where no vertex is farther than the pitch from a chord that is led through it.
pub(super) fn round(strands: &[Strand<'_>], bounds: &Aabb<f64>, options: &Options) -> Result<Noded, NodeError> {
    let mut outcome = Err(NodeError::TooFine);
    for units in UNITS {
        let unit = options.pitch / units;
        if !strands.is_empty() && overflows(bounds, unit) {
            break;
        }
        outcome = Lattice::new(strands, &bounds.min, unit, units - ROUNDING).settle(options);
        match &outcome {
            Ok(noded) if noded.report.max_displacement > options.pitch => {
                outcome = Err(NodeError::NotSettled { rounds: options.rounds });
            }
            Err(NodeError::NotSettled { .. }) => {}
            _ => break,
        }
    }
    outcome
}

impl<'s, 'a> Lattice<'s, 'a> {
    fn new(strands: &'s [Strand<'a>], origin: &Point<f64>, unit: f64, drift: f64) -> Self {
        let mut lattice = Self {
            strands,
            origin: *origin,
            unit,
            drift,
            places: Vec::new(),
            exact: Vec::new(),
            by_place: HashMap::new(),
            segments: Vec::new(),
            chords: Vec::new(),
        };
        lattice.enter();
        lattice
    }

    /// Cuts until nothing changes.
    fn settle(mut self, options: &Options) -> Result<Noded, NodeError> {
        let samples = self.places.len();
        let mut rounds = 0;
        while self.cut(options.limit)? {
            rounds += 1;
            if rounds > options.rounds {
                return Err(NodeError::NotSettled { rounds: options.rounds });
            }
        }
        Ok(self.finish(samples, rounds))
    }
}

impl Lattice<'_, '_> {
    /// A point in units.
    fn scaled(&self, p: &Point<f64>) -> Point<f64> {
        Point::new((p.x - self.origin.x) / self.unit, (p.y - self.origin.y) / self.unit)
    }

    fn vertex(&mut self, place: Place, exact: Point<f64>) -> u32 {
        if let Some(&vertex) = self.by_place.get(&place) {
            return vertex;
        }
        let vertex = u32::try_from(self.places.len()).unwrap_or(u32::MAX);
        self.places.push(place);
        self.exact.push(exact);
        self.by_place.insert(place, vertex);
        vertex
    }

    /// Vertices and first segments. A stop near an earlier one takes that one's vertex.
    fn enter(&mut self) {
        let mut clusters = Clusters::new(SAME * self.unit, self.origin);
        let mut segments = Vec::new();
        for (number, strand) in (0..).zip(self.strands) {
            let mut last: Option<(u32, f64, Point<f64>)> = None;
            for stop in &strand.stops {
                let exact = clusters.first(stop.point);
                let vertex = self.vertex(nearest_place(&self.scaled(&exact)), exact);
                let p = self.scaled(&strand.track.eval(stop.u));
                if let Some((before, u, q)) = last
                    && before != vertex
                {
                    let chord = u32::try_from(self.chords.len()).unwrap_or(u32::MAX);
                    self.chords.push(([q, p], number));
                    let owner = Owner { path: strand.path, at: [u, stop.u], forward: true };
                    segments.push(Segment {
                        ends: [before, vertex],
                        claims: vec![Claim { owner, chord }],
                        fresh: true,
                    });
                }
                last = Some((vertex, stop.u, p));
            }
        }
        self.segments = merged(segments);
    }

    fn place(&self, vertex: u32) -> Place {
        self.places.get(vertex as usize).copied().unwrap_or_default()
    }

    /// One round; false if nothing changed.
    fn cut(&mut self, limit: usize) -> Result<bool, NodeError> {
        let count = self.segments.len();
        let mut through: Vec<Vec<u32>> = vec![Vec::new(); count];
        let boxes = Boxes::new(self.segments.iter().map(|segment| self.bounds(segment)).collect());
        let mut pairs = Vec::new();
        boxes.overlapping(|i| self.segments[i as usize].fresh, |i, j| pairs.push([i, j]));
        for [i, j] in pairs {
            let (a, b) = (&self.segments[i as usize], &self.segments[j as usize]);
            for (segment, other, which) in [(a, b, i), (b, a, j)] {
                through[which as usize].extend(other.ends.iter().filter(|&&v| self.is_on(segment, v)));
            }
            if let Some(place) = self.crossing(a.ends, b.ends) {
                let vertex = self.vertex(place, self.at(place));
                for which in [i, j] {
                    through[which as usize].push(vertex);
                }
            }
        }
        let mut changed = false;
        let mut next = Vec::with_capacity(count);
        for (segment, mut through) in std::mem::take(&mut self.segments).into_iter().zip(through) {
            through.retain(|v| !segment.ends.contains(v));
            if through.is_empty() {
                next.push(Segment { fresh: false, ..segment });
                continue;
            }
            changed = true;
            self.lead(&segment, through, &mut next);
        }
        if next.len() > limit {
            return Err(NodeError::TooMany { limit });
        }
        self.segments = merged(next);
        Ok(changed)
    }

    /// The pieces of a segment through some vertices, in their order along it.
    fn lead(&self, segment: &Segment, mut through: Vec<u32>, out: &mut Vec<Segment>) {
        let [a, b] = segment.ends;
        let (start, end) = (self.place(a), self.place(b));
        through.sort_by_key(|&v| (dot(start, end, self.place(v)), v));
        through.dedup();
        through.push(b);
        let length_sq = dot(start, end, end) as f64;
        // Parameters of all owners at the vertex before.
        let mut before: Vec<f64> = segment.claims.iter().map(|claim| claim.owner.at[0]).collect();
        let mut last = a;
        for vertex in through {
            let share = dot(start, end, self.place(vertex)) as f64 / length_sq;
            let mut claims = Vec::with_capacity(segment.claims.len());
            for (claim, before) in segment.claims.iter().zip(&mut before) {
                let [from, to] = claim.owner.at;
                let here =
                    if vertex == b { to } else { self.parameter(claim, vertex, *before, from + share * (to - from)) };
                claims.push(Claim { owner: Owner { at: [*before, here], ..claim.owner }, ..*claim });
                *before = here;
            }
            out.push(Segment { ends: [last, vertex], claims, fresh: true });
            last = vertex;
        }
    }

    /// The parameter on an owner's curve that is nearest to a vertex, between the one before and the owner's end.
    fn parameter(&self, claim: &Claim, vertex: u32, before: f64, guess: f64) -> f64 {
        let strand = self.chords.get(claim.chord as usize).and_then(|(_, strand)| self.strands.get(*strand as usize));
        let (low, high) = (before.min(claim.owner.at[1]), before.max(claim.owner.at[1]));
        match strand {
            Some(strand) => strand.track.nearest(&self.at(self.place(vertex)), low, high, guess),
            None => guess.clamp(low, high),
        }
    }

    fn bounds(&self, segment: &Segment) -> Aabb<f64> {
        let [a, b] = segment.ends.map(|v| self.place(v));
        let low = |i: usize| a[i].min(b[i]) as f64 - NEAR / 2.0;
        let high = |i: usize| a[i].max(b[i]) as f64 + NEAR / 2.0;
        Aabb { min: Point::new(low(0), low(1)), max: Point::new(high(0), high(1)) }
    }

    /// The vertex has to become part of the segment.
    fn is_on(&self, segment: &Segment, vertex: u32) -> bool {
        if segment.ends.contains(&vertex) {
            return false;
        }
        let ([a, b], v) = (segment.ends.map(|v| self.place(v)), self.place(vertex));
        let along = dot(a, b, v);
        let length_sq = dot(a, b, b);
        if along <= 0 || along >= length_sq {
            return false;
        }
        let area = cross(a, b, v);
        if area == 0 {
            return true;
        }
        // Rounding decides nothing here but whether a vertex at just this distance is taken.
        let area = area as f64;
        if area * area > NEAR * NEAR * length_sq as f64 {
            return false;
        }
        let v = Point::new(v[0] as f64, v[1] as f64);
        segment.claims.iter().all(|claim| self.drift_of(claim, &v) <= self.drift)
    }

    /// How far a point, in units, is from the chord of an owner.
    fn drift_of(&self, claim: &Claim, v: &Point<f64>) -> f64 {
        self.chords.get(claim.chord as usize).map_or(0.0, |([a, b], _)| {
            let chord = b.minus(a);
            let length_sq = chord.norm_sq();
            let share = if length_sq > 0.0 { (v.minus(a).dot(&chord) / length_sq).clamp(0.0, 1.0) } else { 0.0 };
            a.plus_scaled(&share, &chord).distance(v)
        })
    }

    /// Where two segments cross properly: the lattice point nearest to it.
    fn crossing(&self, first: [u32; 2], second: [u32; 2]) -> Option<Place> {
        let ([a, b], [c, d]) = (first.map(|v| self.place(v)), second.map(|v| self.place(v)));
        let (at_a, at_b) = (cross(c, d, a), cross(c, d, b));
        let (at_c, at_d) = (cross(a, b, c), cross(a, b, d));
        let opposite = |p: i128, q: i128| (p > 0 && q < 0) || (p < 0 && q > 0);
        if !(opposite(at_a, at_b) && opposite(at_c, at_d)) {
            return None;
        }
        // The share lies strictly between 0 and 1, so the double is good to a few ulp of the segment's length.
        let share = at_a as f64 / (at_a - at_b) as f64;
        let offset = |i: usize| nearest_whole(share * (b[i] - a[i]) as f64);
        Some([a[0] + offset(0), a[1] + offset(1)])
    }

    /// The point of a lattice place, in user units.
    fn at(&self, place: Place) -> Point<f64> {
        Point::new(self.origin.x + place[0] as f64 * self.unit, self.origin.y + place[1] as f64 * self.unit)
    }

    fn finish(self, samples: usize, rounds: usize) -> Noded {
        let mut used = vec![false; self.places.len()];
        for end in self.segments.iter().flat_map(|segment| segment.ends) {
            used[end as usize] = true;
        }
        // Numbers that keep the order, so that edges stay sorted with their lower end first.
        let mut number = vec![0; self.places.len()];
        let mut vertices = Vec::new();
        for (vertex, _) in used.iter().enumerate().filter(|(_, used)| **used) {
            number[vertex] = u32::try_from(vertices.len()).unwrap_or(u32::MAX);
            let place = self.places[vertex];
            vertices.push(Vertex { point: self.at(place), exact: self.exact[vertex], place });
        }
        let mut displacement: f64 = 0.0;
        let mut merged_segments = 0;
        let mut edges = Vec::with_capacity(self.segments.len());
        let mut owners = Vec::new();
        for segment in &self.segments {
            for (end, claim) in segment.ends.iter().flat_map(|end| segment.claims.iter().map(move |claim| (end, claim)))
            {
                let place = self.place(*end);
                displacement = displacement.max(self.drift_of(claim, &Point::new(place[0] as f64, place[1] as f64)));
            }
            let first = u32::try_from(owners.len()).unwrap_or(u32::MAX);
            owners.extend(segment.claims.iter().map(|claim| claim.owner));
            let count = u32::try_from(segment.claims.len()).unwrap_or(u32::MAX);
            merged_segments += segment.claims.len() - 1;
            edges.push(Edge { ends: segment.ends.map(|end| number[end as usize]), first, count });
        }
        let report = Report {
            crossings: 0,
            vertices_added: self.places.len().saturating_sub(samples),
            segments_merged: merged_segments,
            max_displacement: displacement * self.unit,
            rounds,
        };
        Noded { vertices, edges, owners, unit: self.unit, report }
    }
}

/// Lower end first; equal segments become one.
fn merged(mut segments: Vec<Segment>) -> Vec<Segment> {
    for segment in &mut segments {
        if segment.ends[0] > segment.ends[1] {
            segment.ends.reverse();
            for claim in &mut segment.claims {
                claim.owner.at.reverse();
                claim.owner.forward = !claim.owner.forward;
            }
        }
    }
    // Stable: owners stay in the order of the strands.
    segments.sort_by_key(|segment| segment.ends);
    let mut out: Vec<Segment> = Vec::with_capacity(segments.len());
    for segment in segments {
        match out.last_mut().filter(|last| last.ends == segment.ends) {
            Some(last) => {
                last.claims.extend(segment.claims);
                // One that was there before has met everything already.
                last.fresh &= segment.fresh;
            }
            None => out.push(segment),
        }
    }
    out
}

/// (b − a) · (v − a), exact.
fn dot(a: Place, b: Place, v: Place) -> i128 {
    let d = |p: Place, i: usize| i128::from(p[i]) - i128::from(a[i]);
    d(b, 0) * d(v, 0) + d(b, 1) * d(v, 1)
}

/// Twice the signed area of the triangle abv, exact.
fn cross(a: Place, b: Place, v: Place) -> i128 {
    let d = |p: Place, i: usize| i128::from(p[i]) - i128::from(a[i]);
    d(b, 0) * d(v, 1) - d(b, 1) * d(v, 0)
}

#[expect(clippy::cast_possible_truncation, reason = "within ±2^53; checked at the door")]
fn nearest_whole(x: f64) -> i64 {
    x.round() as i64
}

fn nearest_place(p: &Point<f64>) -> Place {
    [nearest_whole(p.x), nearest_whole(p.y)]
}
