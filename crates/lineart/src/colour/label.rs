//! From hints to a colour for each face.
//!
//! Hints become seeds, the flood says which seed reaches a face, seeds of one colour count as one, and faces of one colour
//! that are joined across open sides are a region. What no hint reaches stays empty, or is coloured by a neighbour or as
//! if there were no hints. This is all that is done again when a hint changes.

use std::collections::BTreeMap;

use feature_sampling::geometry::Point;

use super::auto;
use super::flood::{Flood, components};
use super::hint::{Colour, Hint, PALETTE};
use super::plane::{Face, NONE, Plane};
use super::{Options, Unlabelled};

/// Which face has which colour.
#[derive(Clone, Debug)]
pub struct Labels {
    /// Index of the region of each face.
    pub(super) region_of: Vec<u32>,
    /// Colours of the regions.
    pub(super) colours: Vec<Option<Colour>>,
    /// Hints in the regions.
    pub(super) hints: Vec<Vec<usize>>,
    /// Hints in conflict.
    pub(super) warnings: Vec<String>,
}

impl Labels {
    /// The colour at a point; none where nothing is filled.
    pub fn at(&self, plane: &Plane<'_>, p: &Point<f64>) -> Option<&Colour> {
        let region = self.region_of.get(plane.locate(p) as usize)?;
        self.colours.get(*region as usize)?.as_ref()
    }
}

impl Plane<'_> {
    /// Labels all faces: what is to be done again when hints change.
    pub fn label(&self, hints: &[Hint], options: &Options) -> Labels {
        let mut warnings = Vec::new();
        let mut seeds: BTreeMap<u32, usize> = BTreeMap::new();
        let mut outside_frame = None;
        for (index, hint) in hints.iter().enumerate() {
            for face in self.faces_of(hint) {
                if face == NONE {
                    outside_frame = Some(index);
                    continue;
                }
                if let Some(before) = seeds.insert(face, index)
                    && hints[before].colour != hint.colour
                {
                    warnings.push(format!(
                        "hints {} and {} are in one place and differ; the later one holds",
                        before + 1,
                        index + 1
                    ));
                }
            }
        }
        let corners = u32::try_from(self.places.len()).unwrap_or(NONE).saturating_sub(4);
        let frame: Vec<u32> = (0_u32..)
            .zip(&self.faces)
            .filter(|(_, face)| face.corners.iter().any(|v| *v >= corners))
            .map(|(number, _)| number)
            .collect();
        // Sources: hints by their index, then what is outside, then rooms.
        let outside = u32::try_from(hints.len()).unwrap_or(NONE);
        let source = |index: usize| u32::try_from(index).unwrap_or(NONE);
        let mut start: Vec<(u32, u32)> = seeds.iter().map(|(face, hint)| (*face, source(*hint))).collect();
        match outside_frame {
            Some(hint) => start.extend(frame.iter().map(|face| (*face, source(hint)))),
            None if options.outside => start.extend(frame.iter().map(|face| (*face, outside))),
            None => {}
        }
        let gap = (options.max_gap / self.unit).max(0.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let max_gap = (gap * gap) as u128;
        let auto = hints.is_empty() || options.unlabelled == Unlabelled::Auto;
        let mut flood = Flood::empty(self);
        if hints.is_empty() {
            let (_, found) = auto::rooms(self, &start, outside + 1, &options.auto, max_gap);
            flood = found;
        } else {
            // Rooms: what hangs together through passages that are not narrower than the largest gap.
            let room = components(self, |_, _, side| side.chain == NONE && side.length_sq >= max_gap);
            let mut sizes = vec![0_u32; self.faces.len()];
            room.iter().for_each(|room| sizes[*room as usize] += 1);
            let mut hinted = vec![false; self.faces.len()];
            start.iter().for_each(|(face, _)| hinted[room[*face as usize] as usize] = true);
            flood.grow(self, &start, |face, length_sq| {
                let room = room[face as usize] as usize;
                length_sq >= max_gap || hinted[room] || sizes[room] == 1
            });
            if auto {
                let (all, found) = auto::rooms(self, &start, outside + 1, &options.auto, max_gap);
                let rooms: Vec<u32> = all.iter().map(|(_, source)| *source).collect();
                for (here, found) in flood.source.iter_mut().zip(&found.source) {
                    if *here == NONE && *found > outside && rooms.contains(found) {
                        *here = *found;
                    }
                }
            }
        }
        self.regions(&flood, hints, outside, options, warnings, &seeds)
    }

    /// The faces a hint stands for.
    fn faces_of(&self, hint: &Hint) -> Vec<u32> {
        let mut faces: Vec<u32> = Vec::new();
        if let [p] = hint.points.as_slice() {
            return vec![self.locate(p)];
        }
        for pair in hint.points.windows(2) {
            faces.extend(self.along(&pair[0], &pair[1]));
        }
        faces.sort_unstable();
        faces.dedup();
        faces.retain(|face| *face != NONE);
        faces
    }

    /// Faces that a segment meets.
    fn along(&self, a: &Point<f64>, b: &Point<f64>) -> Vec<u32> {
        let (p, q) = (self.scaled(a), self.scaled(b));
        let inside = |face: &Face, p: spade::Point2<f64>| {
            (0..3).all(|i| {
                let [u, v] = [face.corners[i], face.corners[(i + 1) % 3]].map(|c| self.places[c as usize]);
                (v[0] - u[0]) as f64 * (p.y - u[1] as f64) - (v[1] - u[1]) as f64 * (p.x - u[0] as f64) >= 0.0
            })
        };
        let crosses = |face: &Face| {
            (0..3).any(|i| {
                let [u, v] =
                    [face.corners[i], face.corners[(i + 1) % 3]].map(|c| self.places[c as usize].map(|v| v as f64));
                let area = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
                    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
                };
                let (p, q) = ([p.x, p.y], [q.x, q.y]);
                area(u, v, p) * area(u, v, q) < 0.0 && area(p, q, u) * area(p, q, v) < 0.0
            })
        };
        let met = |face: &&Face| inside(face, p) || inside(face, q) || crosses(face);
        (0_u32..).zip(&self.faces).filter(|(_, face)| met(face)).map(|(number, _)| number).collect()
    }

    /// From sources to regions with colours.
    fn regions(
        &self,
        flood: &Flood,
        hints: &[Hint],
        outside: u32,
        options: &Options,
        warnings: Vec<String>,
        seeds: &BTreeMap<u32, usize>,
    ) -> Labels {
        // Sources of one colour are one. Rooms and what nothing reached have keys of their own.
        let mut keys: Vec<u32> = (0..=outside).collect();
        for (i, hint) in hints.iter().enumerate() {
            if let Some(first) = hints.iter().position(|other| other.colour == hint.colour) {
                keys[i] = u32::try_from(first).unwrap_or(NONE);
            }
        }
        if let Some(empty) = hints.iter().position(|hint| hint.colour.is_none()) {
            keys[outside as usize] = u32::try_from(empty).unwrap_or(NONE);
        }
        let key = |face: u32| {
            let source = flood.source[face as usize];
            keys.get(source as usize).copied().unwrap_or(source)
        };
        let set = components(self, |a, b, side| side.chain == NONE && key(a) == key(b));
        let mut number = vec![NONE; self.faces.len()];
        let mut first: Vec<u32> = Vec::new();
        let region_of: Vec<u32> = set
            .iter()
            .map(|root| {
                let place = &mut number[*root as usize];
                if *place == NONE {
                    *place = u32::try_from(first.len()).unwrap_or(NONE);
                    first.push(*root);
                }
                *place
            })
            .collect();
        let mut colours: Vec<Option<Colour>> = vec![None; first.len()];
        // Not labelled, or found without a hint: to be coloured from the palette.
        let mut free = vec![false; first.len()];
        let mut unreached = vec![false; first.len()];
        for (region, face) in first.iter().enumerate() {
            let source = flood.source[*face as usize];
            match hints.get(source as usize) {
                Some(hint) => colours[region].clone_from(&hint.colour),
                None if source == NONE => unreached[region] = true,
                None if source > outside => free[region] = true,
                None => {}
            }
        }
        if options.unlabelled == Unlabelled::Neighbour {
            self.take_from_neighbours(&region_of, &unreached, &mut colours);
        }
        self.give_palette(&region_of, &free, &mut colours);
        let mut own_hints = vec![Vec::new(); first.len()];
        for (face, hint) in seeds {
            let list: &mut Vec<usize> = &mut own_hints[region_of[*face as usize] as usize];
            if !list.contains(hint) {
                list.push(*hint);
            }
        }
        own_hints.iter_mut().for_each(|list| list.sort_unstable());
        Labels { region_of, colours, hints: own_hints, warnings }
    }

    /// Lengths of the boundaries that pairs of regions share, in lattice units.
    fn shared(&self, region_of: &[u32]) -> BTreeMap<(u32, u32), f64> {
        let mut shared = BTreeMap::new();
        for (face, number) in self.faces.iter().zip(0_u32..) {
            for (side, beyond) in face.sides.iter().zip(&face.beyond) {
                if *beyond == NONE || *beyond < number {
                    continue;
                }
                let (a, b) = (region_of[number as usize], region_of[*beyond as usize]);
                if a != b {
                    let length = (self.sides[*side as usize].length_sq as f64).sqrt();
                    *shared.entry((a.min(b), a.max(b))).or_insert(0.0) += length;
                }
            }
        }
        shared
    }

    fn take_from_neighbours(&self, region_of: &[u32], unreached: &[bool], colours: &mut [Option<Colour>]) {
        let shared = self.shared(region_of);
        let mut best: Vec<(f64, u32)> = vec![(0.0, NONE); colours.len()];
        for (&(a, b), &length) in &shared {
            for (own, other) in [(a, b), (b, a)] {
                if unreached[own as usize] && !unreached[other as usize] && length > best[own as usize].0 {
                    best[own as usize] = (length, other);
                }
            }
        }
        for (region, (_, from)) in best.iter().enumerate() {
            if let Some(colour) = colours.get(*from as usize).cloned().filter(|_| *from != NONE) {
                colours[region] = colour;
            }
        }
    }

    /// Gives free regions colours of the palette, so that neighbours differ where six colours suffice; large regions first.
    fn give_palette(&self, region_of: &[u32], free: &[bool], colours: &mut [Option<Colour>]) {
        if !free.contains(&true) {
            return;
        }
        let mut areas = vec![0.0; colours.len()];
        region_of.iter().zip(0..).for_each(|(region, face)| areas[*region as usize] += self.area(face));
        let mut order: Vec<usize> = (0..colours.len()).filter(|region| free[*region]).collect();
        order.sort_by(|a, b| f64::total_cmp(&areas[*b], &areas[*a]).then(a.cmp(b)));
        let mut neighbours: Vec<Vec<u32>> = vec![Vec::new(); colours.len()];
        for (a, b) in self.shared(region_of).into_keys() {
            neighbours[a as usize].push(b);
            neighbours[b as usize].push(a);
        }
        let mut given = vec![usize::MAX; colours.len()];
        for region in order {
            let uses = |colour: usize| neighbours[region].iter().filter(|n| given[**n as usize] == colour).count();
            let colour = (0..PALETTE.len()).min_by_key(|colour| (uses(*colour), *colour)).unwrap_or(0);
            given[region] = colour;
            colours[region] = Colour::named(PALETTE[colour]);
        }
    }
}
