//! The re-check itself.

use std::fmt;

use feature_sampling::curve::{Curve, EndId};
use feature_sampling::geometry::Point;
use feature_sampling::scalar::Field;

use crate::bernstein::Real;
use crate::cover::{Required, sound, sound_feet};
use crate::empty::{Work, empty, reached};
use crate::feet::{Capsule, Feet, Span, exact, points};
use crate::scene::{BoxTree, Scene};
use crate::{
    Certificate, Claimed, FLOOR, FootClaim, NeighbourhoodClaim, Node, PieceClaim, Place, SINGULAR_FLOOR, Tree, Upper,
    Why, WitnessClaim, hash,
};

/// A sample lies where it says to within this share of the diagonal.
const ON_CURVE: f64 = 1e-6;

/// What a certificate that holds has shown.
#[derive(Clone, Debug, PartialEq)]
pub enum Proved {
    /// The samples are an ε-sample; evaluated were so many claims about radii.
    Sample {
        /// Claims about empty disks that were relied on.
        claims: usize,
    },
    /// They are none: the condition fails at this point.
    Fault(WitnessClaim),
}

/// Why a certificate does not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rejection {
    what: String,
}

impl Rejection {
    pub(crate) const fn new(what: String) -> Self {
        Self { what }
    }
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)
    }
}

impl std::error::Error for Rejection {}

fn reject<T>(what: impl Into<String>) -> Result<T, Rejection> {
    Err(Rejection::new(what.into()))
}

/// Evaluates every claim of a certificate on a curve.
///
/// # Errors
/// A [`Rejection`] that names the first claim that does not hold, or was not shown.
pub fn check(curve: Curve<'_, f64>, certificate: &Certificate) -> Result<Proved, Rejection> {
    let scene = Scene::new(curve);
    let mut checker = Checker::new(&scene, certificate, false)?;
    match &certificate.claimed {
        Claimed::Unknown => reject("it claims nothing"),
        Claimed::Refuted(witness) => checker.fault(witness).map(|()| Proved::Fault(*witness)),
        Claimed::Proved => {
            Required::new(&scene).covered(&certificate.trees)?;
            checker.all_pieces()?;
            Ok(Proved::Sample { claims: checker.cells.iter().filter(|c| c.shown).count() })
        }
    }
}

/// Halvings of a piece that is not served as a whole.
const HALVINGS: u32 = 8;

/// Leaves out of a certificate what no piece relies on, without looking at what it claims of radii.
///
/// The prover may have discharged a cell for a longer piece, so one that its cells do not serve is halved: halves have smaller
/// disks around them. What is not served then becomes unknown.
pub fn trim(curve: Curve<'_, f64>, certificate: &mut Certificate) {
    let scene = Scene::new(curve);
    let Ok(mut checker) = Checker::new(&scene, certificate, true) else { return };
    let mut pieces = Vec::new();
    for (piece, i) in certificate.pieces.iter().zip(0..) {
        let mut pending = vec![(*piece, 0)];
        while let Some((piece, depth)) = pending.pop() {
            if !matches!(piece.why, Why::Feature(_)) || checker.piece(&piece, i).is_ok() {
                pieces.push(piece);
                continue;
            }
            let m = 0.5 * (piece.from + piece.to);
            if depth < HALVINGS && piece.from < m && m < piece.to {
                pending.push((PieceClaim { from: m, ..piece }, depth + 1));
                pending.push((PieceClaim { to: m, ..piece }, depth + 1));
            } else {
                pieces.push(PieceClaim { why: Why::Unknown, ..piece });
            }
        }
    }
    let (cells, roots) = (checker.cells, checker.roots);
    for (tree, root) in certificate.trees.iter_mut().zip(roots) {
        let mut kept = Vec::new();
        let mut pending = vec![root];
        while let Some(i) = pending.pop() {
            let cell = &cells[i];
            let split = cell.node.split && cell.divided;
            let lower = if cell.lower_used { cell.node.lower } else { 0.0 };
            let upper = cell.node.upper.filter(|_| cell.upper_used);
            kept.push(Node { split, lower, upper });
            if split {
                pending.extend([cell.second, i + 1]);
            }
        }
        tree.nodes = kept;
    }
    if certificate.claimed == Claimed::Proved && pieces.iter().any(|p| p.why == Why::Unknown) {
        certificate.claimed = Claimed::Unknown;
    }
    certificate.pieces = pieces;
}

/// A cell with what was found out about it.
struct Cell {
    node: Node,
    /// Index of the second half; the first one follows.
    second: usize,
    capsule: Option<Capsule>,
    /// What its own point shows, once it was looked at.
    reach: Option<f64>,
    /// Its own claim of empty disks was evaluated and holds.
    shown: bool,
    lower_used: bool,
    upper_used: bool,
    divided: bool,
}

/// A bound, and the cell that claims it.
#[derive(Clone, Copy)]
struct Bound {
    value: f64,
    cell: usize,
}

/// Something of the foot set to look at: the cell, its feet, what was inherited.
struct Task {
    cell: usize,
    feet: Span,
    lower: (Bound, Span),
    upper: Bound,
}

/// A stretch of C as a disk.
struct Ball {
    centre: Point<f64>,
    radius: f64,
}

struct Checker<'c> {
    scene: &'c Scene<'c>,
    certificate: &'c Certificate,
    /// Claims of empty disks are taken at their word.
    trusting: bool,
    cells: Vec<Cell>,
    roots: Vec<usize>,
    near: BoxTree,
    points: Vec<Point<f64>>,
    work: Work,
    /// Neighbourhoods that hold.
    shown: Vec<bool>,
}

impl<'c> Checker<'c> {
    fn new(scene: &'c Scene<'c>, certificate: &'c Certificate, trusting: bool) -> Result<Self, Rejection> {
        let c = certificate;
        if c.curve != hash(&scene.curve) {
            return reject("it is about another curve");
        }
        let positive = |v: f64| v > 0.0 && v.is_finite();
        if !positive(c.epsilon) || !c.min_distance.is_none_or(positive) {
            return reject("ε or the floor is not a positive number");
        }
        let points = Required::new(scene).points;
        let mut checker = Self {
            scene,
            certificate,
            trusting,
            cells: Vec::new(),
            roots: Vec::new(),
            near: BoxTree::default(),
            points,
            work: Work::new(),
            shown: vec![false; c.neighbourhoods.len()],
        };
        checker.samples()?;
        let mut boxes = Vec::new();
        for (tree, i) in c.trees.iter().zip(0..) {
            if !sound_feet(&scene.curve, &tree.feet) {
                return reject(format!("tree {i} has no feet"));
            }
            checker.roots.push(checker.cells.len());
            checker.tree(tree, i)?;
            boxes.push(match tree.feet {
                Span::Side { segment, from, to, .. } => scene.bounds(segment, [from, to]),
                Span::Fan { end, .. } => scene.bounds(end >> 1, [f64::from(end & 1); 2]),
            });
        }
        checker.near = BoxTree::new(&boxes);
        Ok(checker)
    }

    /// Samples are sorted, and lie where they say.
    fn samples(&self) -> Result<(), Rejection> {
        let off = ON_CURVE * self.scene.curve.diagonal;
        let mut last = (0, f64::NEG_INFINITY);
        for (s, i) in self.certificate.samples.iter().zip(0..) {
            let Place { segment, t } = s.at;
            if !sound(&self.scene.curve, segment, [t, t]) || (segment, t) < last {
                return reject(format!("sample {i} is out of order"));
            }
            last = (segment, t);
            let there = self.scene.from(EndId::new(segment, 0)).map(|o| o.point(&Real::point(t)));
            let distance = there.map(|p| *p.minus(&exact(&Point::new(s.x, s.y))).norm().hi());
            if !distance.is_some_and(|d| d <= off) {
                return reject(format!("sample {i} is not on the curve"));
            }
        }
        Ok(())
    }

    /// Takes the cells of a tree, and finds the second halves.
    fn tree(&mut self, tree: &Tree, name: usize) -> Result<(), Rejection> {
        // Split cells whose second half is still to come.
        let mut open: Vec<usize> = Vec::new();
        let mut complete = false;
        for &node in &tree.nodes {
            if complete || !(node.lower >= 0.0 && node.lower.is_finite()) {
                return reject(format!("the cells of tree {name} are malformed"));
            }
            let index = self.cells.len();
            self.cells.push(Cell {
                node,
                second: 0,
                capsule: None,
                reach: None,
                shown: false,
                lower_used: false,
                upper_used: false,
                divided: false,
            });
            if node.split {
                open.push(index);
            } else {
                // The next cell is the second half of the last one that has none yet.
                match open.pop() {
                    Some(parent) => self.cells[parent].second = index + 1,
                    None => complete = true,
                }
            }
        }
        if complete { Ok(()) } else { reject(format!("the cells of tree {name} end too soon")) }
    }

    /// The disk around a point of C.
    fn spot(&self, segment: u32, t: f64) -> Option<Ball> {
        let p = self.scene.from(EndId::new(segment, 0))?.point(&Real::point(t));
        let centre = Point::new(p.x.middle(), p.y.middle());
        let radius = *p.minus(&exact(&centre)).norm().hi();
        Some(Ball { centre, radius })
    }

    /// The disk around a stretch of C, and its control points.
    fn ball(&self, segment: u32, range: [f64; 2]) -> Option<(Ball, [[Real; 4]; 2])> {
        let o = self.scene.from(EndId::new(segment, 0))?;
        let [a, b] = range.map(Real::point);
        let [mut x, mut y] = points(o, a, b, &exact(&Point::new(0.0, 0.0)));
        for axis in [&mut x, &mut y] {
            let third = Real::int(1) / Real::int(3);
            axis[1] = axis[1] * third;
            axis[2] = axis[2] * third;
        }
        let mean = |c: &[Real; 4]| 0.25 * c.iter().map(Real::middle).sum::<f64>();
        let centre = Point::new(mean(&x), mean(&y));
        let radius = farthest(&[x, y], &centre);
        Some((Ball { centre, radius }, [x, y]))
    }

    fn all_pieces(&mut self) -> Result<(), Rejection> {
        let certificate = self.certificate;
        let mut expected = (0, 0.0);
        for (p, i) in certificate.pieces.iter().zip(0..) {
            if !sound(&self.scene.curve, p.segment, [p.from, p.to]) || (p.segment, p.from) != expected {
                return reject(format!("piece {i} does not follow the one before it"));
            }
            expected = if p.to == 1.0 { (p.segment + 1, 0.0) } else { (p.segment, p.to) };
            self.piece(p, i)?;
        }
        if expected.0 as usize == self.scene.curve.segments.len() {
            Ok(())
        } else {
            reject(format!("the pieces end at segment {} parameter {}", expected.0, expected.1))
        }
    }

    /// One piece is well sampled.
    fn piece(&mut self, p: &PieceClaim, index: usize) -> Result<(), Rejection> {
        let certificate = self.certificate;
        let sample = certificate.samples.get(p.sample as usize);
        let (Some(sample), Some((ball, control))) = (sample, self.ball(p.segment, [p.from, p.to])) else {
            return reject(format!("piece {index} has no sample"));
        };
        let distance = farthest(&control, &Point::new(sample.x, sample.y));
        let diagonal = *self.scene.curve.diagonal;
        let nearer = |floor: f64| distance < floor * (1.0 - 4.0 * f64::EPSILON);
        match p.why {
            Why::Unknown => reject(format!("piece {index} is not known to be well sampled")),
            Why::Floor => {
                if !nearer(certificate.min_distance.unwrap_or(FLOOR * diagonal)) || !self.neighbour(p) {
                    return reject(format!("piece {index} is not served by the floor"));
                }
                Ok(())
            }
            Why::Neighbourhood(name) => {
                if certificate.min_distance.is_some() || !nearer(SINGULAR_FLOOR * diagonal) || !self.neighbour(p) {
                    return reject(format!("piece {index} is not served by the floor of its neighbourhood"));
                }
                match certificate.neighbourhoods.get(name as usize) {
                    Some(n) if holds(n, p) => self.neighbourhood(n, name),
                    _ => reject(format!("piece {index} does not lie in its neighbourhood")),
                }
            }
            Why::Feature(lfs) => {
                let allowed = Real::point(lfs) * Real::point(certificate.epsilon);
                if !(lfs > 0.0 && lfs.is_finite() && distance < *allowed.lo()) {
                    return reject(format!("the sample of piece {index} is too far away for what it claims"));
                }
                match self.feature(&ball, lfs)? {
                    true => Ok(()),
                    false => reject(format!("the cells do not show lfs ≥ {lfs} on piece {index}")),
                }
            }
        }
    }

    /// The sample of a piece is the one before or behind it along its path.
    fn neighbour(&self, p: &PieceClaim) -> bool {
        let samples = &self.certificate.samples;
        let curve = &self.scene.curve;
        let Some(&path) = curve.segment(p.segment).and_then(|s| curve.paths.get(s.path as usize)) else { return false };
        let first = samples.partition_point(|s| s.at.segment < path.first);
        let last = samples.partition_point(|s| s.at.segment < path.first + path.count);
        // Samples up to the piece's start, and from its end on: none lies inside.
        let before = samples.partition_point(|s| (s.at.segment, s.at.t) <= (p.segment, p.from));
        let behind = samples.partition_point(|s| (s.at.segment, s.at.t) < (p.segment, p.to));
        let own = p.sample as usize;
        if behind > before || !(first..last).contains(&own) {
            return false;
        }
        let previous = if before > first { own + 1 == before } else { path.closed && own + 1 == last };
        let next = if before < last { own == before } else { path.closed && own == first };
        previous || next
    }

    /// lfs ≥ `g` on a stretch of C: no cell comes nearer.
    fn feature(&mut self, ball: &Ball, g: f64) -> Result<bool, Rejection> {
        let (centre, g_real) = (exact(&ball.centre), Real::point(g));
        let margin = Real::point(ball.radius);
        // A point of M within g of the stretch?
        let free = |p: &Point<f64>| *(exact(p).minus(&centre).norm() - margin).lo() >= g;
        if !self.points.iter().all(free) {
            return Ok(false);
        }
        let far = *(g_real.twice() + margin).hi();
        let mut found = Vec::new();
        self.near.near(&centre, *Real::point(far).square().hi(), &mut found);
        for root in found {
            let (cell, feet) = (self.roots[root], self.certificate.trees[root].feet);
            let nothing = Bound { value: 0.0, cell };
            let upper = Bound { value: f64::INFINITY, cell };
            let mut pending = vec![Task { cell, feet, lower: (nothing, feet), upper }];
            while let Some(mut task) = pending.pop() {
                self.look(&mut task);
                if self.discharged(&task, ball, g, far)? {
                    continue;
                }
                let cell = &mut self.cells[task.cell];
                let Some([a, b]) = task.feet.halves().filter(|_| cell.node.split) else { return Ok(false) };
                cell.divided = true;
                let (lower, upper, second) = (task.lower, task.upper, cell.second);
                pending.push(Task { cell: second, feet: b, lower, upper });
                pending.push(Task { cell: task.cell + 1, feet: a, lower, upper });
            }
        }
        Ok(true)
    }

    /// Adds what a cell claims itself to what it inherited.
    fn look(&mut self, task: &mut Task) {
        let scene = self.scene;
        let cell = &mut self.cells[task.cell];
        if cell.node.lower > task.lower.0.value {
            task.lower = (Bound { value: cell.node.lower, cell: task.cell }, task.feet);
        }
        if let Some(upper) = &cell.node.upper {
            let reach = *cell.reach.get_or_insert_with(|| reach_of(scene, &task.feet, upper));
            if reach < task.upper.value {
                task.upper = Bound { value: reach, cell: task.cell };
            }
        }
    }

    /// No medial point of the cell is nearer than `g` to the stretch, and no foot than `far` where that was enough to know.
    fn discharged(&mut self, task: &Task, ball: &Ball, g: f64, far: f64) -> Result<bool, Rejection> {
        let scene = self.scene;
        let cell = &mut self.cells[task.cell];
        let capsule = *cell.capsule.get_or_insert_with(|| Capsule::new(scene, &task.feet));
        if capsule.off_feet(&ball.centre) >= far {
            return Ok(true);
        }
        let (lower, upper) = (task.lower.0.value, task.upper.value);
        let mut needs_upper = false;
        if lower < g {
            let high = upper.min(g).max(lower);
            let away = |high: f64| {
                let d = Real::point(capsule.distance(&ball.centre, lower, high)) - Real::point(ball.radius);
                *d.lo() >= g
            };
            if !away(high) {
                return Ok(false);
            }
            needs_upper = upper < g && !away(g);
        }
        if needs_upper {
            self.cells[task.upper.cell].upper_used = true;
        }
        if lower > 0.0 {
            self.cells[task.lower.0.cell].lower_used = true;
            self.show(task.lower)?;
        }
        Ok(true)
    }

    /// Evaluates a claim of empty disks, if it was not yet.
    fn show(&mut self, (bound, feet): (Bound, Span)) -> Result<(), Rejection> {
        if self.trusting || self.cells[bound.cell].shown {
            return Ok(());
        }
        if !empty(self.scene, &feet, bound.value, &mut self.work) {
            return reject(format!("it is not shown that the disks of radius {} at {feet:?} are empty", bound.value));
        }
        self.cells[bound.cell].shown = true;
        Ok(())
    }

    /// lfs is below floor/ε on all of a neighbourhood.
    fn neighbourhood(&mut self, n: &NeighbourhoodClaim, name: u32) -> Result<(), Rejection> {
        if self.shown[name as usize] {
            return Ok(());
        }
        let fail = |what: &str| reject(format!("neighbourhood {name}: {what}"));
        let diagonal = *self.scene.curve.diagonal;
        let below = *(Real::point(SINGULAR_FLOOR * (1.0 - 4.0 * f64::EPSILON)) * Real::point(diagonal)
            / Real::point(self.certificate.epsilon))
        .lo();
        let FootClaim { at, left, upper } = n.place;
        if !sound(&self.scene.curve, at.segment, [at.t, at.t]) {
            return fail("there is no such place");
        }
        let feet = |segment, left, from, to| Span::Side { segment, left, from, to };
        let reach = reach_of(self.scene, &feet(at.segment, left, at.t, at.t), &upper);
        let zero_enough = reach <= FLOOR * (1.0 - 4.0 * f64::EPSILON) * diagonal;
        if !zero_enough {
            return fail("lfs is not shown to be nearly zero there");
        }
        let Some(place) = self.spot(at.segment, at.t) else { return fail("there is no such place") };
        let mut inside = false;
        let mut last: Option<(u32, f64)> = None;
        for step in &n.steps {
            if !sound(&self.scene.curve, step.segment, [step.from, step.to]) {
                return fail("there is no such stretch");
            }
            if last.is_some_and(|last| !self.follows(last, (step.segment, step.from))) {
                return fail("the stretches do not follow each other");
            }
            last = Some((step.segment, step.to));
            inside |= step.segment == at.segment && step.from <= at.t && at.t <= step.to;
            let Some((ball, _)) = self.ball(step.segment, [step.from, step.to]) else {
                return fail("there is no such stretch");
            };
            let beyond = match step.foot {
                // Some f + ρd with ρ no larger than the radius belongs to M.
                Some(foot) if sound(&self.scene.curve, foot.at.segment, [foot.at.t, foot.at.t]) => {
                    let span = feet(foot.at.segment, foot.left, foot.at.t, foot.at.t);
                    let reach = reach_of(self.scene, &span, &foot.upper);
                    if reach < below {
                        Capsule::new(self.scene, &span).farthest(&ball.centre, 0.0, reach)
                    } else {
                        reach
                    }
                }
                Some(_) => f64::INFINITY,
                None => {
                    let between = exact(&ball.centre).minus(&exact(&place.centre)).norm();
                    *(between + Real::point(place.radius) + Real::point(reach)).hi()
                }
            };
            let lfs = *(Real::point(beyond) + Real::point(ball.radius)).hi();
            let small = lfs < below;
            if !small {
                return fail("lfs is not shown to be small on all of it");
            }
        }
        if !inside {
            return fail("it does not hold its place");
        }
        self.shown[name as usize] = true;
        Ok(())
    }

    /// A stretch that starts at b follows one that ends at a along a path.
    fn follows(&self, a: (u32, f64), b: (u32, f64)) -> bool {
        let curve = &self.scene.curve;
        let Some(path) = curve.segment(a.0).and_then(|s| curve.paths.get(s.path as usize)) else { return false };
        let next = if a.0 + 1 < path.first + path.count { Some(a.0 + 1) } else { path.closed.then_some(path.first) };
        a == b || (a.1 == 1.0 && b.1 == 0.0 && next == Some(b.0))
    }

    /// The condition fails at a point.
    fn fault(&mut self, w: &WitnessClaim) -> Result<(), Rejection> {
        let scene = self.scene;
        let c = self.certificate;
        if !sound(&scene.curve, w.at.segment, [w.at.t, w.at.t]) || !sound_feet(&scene.curve, &w.feet) {
            return reject("the witness is not on the curve");
        }
        let Some(point) = self.spot(w.at.segment, w.at.t) else {
            return reject("the witness is not on the curve");
        };
        let floor = c.min_distance.unwrap_or(SINGULAR_FLOOR * *scene.curve.diagonal * (1.0 + 4.0 * f64::EPSILON));
        let allowed = Real::point(c.epsilon) * Real::point(w.lfs);
        if !(w.distance >= *allowed.hi() && w.distance >= floor && w.lfs > 0.0) {
            return reject("the distance of the witness from the samples is not large enough");
        }
        for (s, i) in c.samples.iter().zip(0..) {
            let d = exact(&point.centre).minus(&exact(&Point::new(s.x, s.y))).norm() - Real::point(point.radius);
            let far_enough = *d.lo() >= w.distance;
            if !far_enough {
                return reject(format!("sample {i} is nearer to the witness than it says"));
            }
        }
        let upper = reach_of(scene, &w.feet, &w.upper);
        if !(upper.is_finite() && upper >= w.lower && w.lower >= 0.0) {
            return reject("no medial point near the witness is shown");
        }
        let far = Capsule::new(scene, &w.feet).farthest(&point.centre, w.lower, upper);
        let near_enough = *(Real::point(far) + Real::point(point.radius)).hi() <= w.lfs;
        if !near_enough {
            return reject("no medial point as near to the witness as it says is shown");
        }
        if empty(scene, &w.feet, w.lower, &mut self.work) {
            Ok(())
        } else {
            reject("it is not shown that the disks near the witness are empty")
        }
    }
}

/// At least the distance of a point from a stretch, by its control points.
fn farthest([x, y]: &[[Real; 4]; 2], p: &Point<f64>) -> f64 {
    let p = exact(p);
    let to = |(x, y): (&Real, &Real)| *((*x - p.x).square() + (*y - p.y).square()).sqrt().hi();
    x.iter().zip(y).map(to).fold(0.0, f64::max)
}

/// The piece lies in the neighbourhood: within one run of its steps on one segment.
fn holds(n: &NeighbourhoodClaim, p: &PieceClaim) -> bool {
    n.steps.chunk_by(|a, b| a.segment == b.segment && a.to == b.from).any(|run| match run {
        [first, .., last] => first.segment == p.segment && first.from <= p.from && p.to <= last.to,
        [only] => only.segment == p.segment && only.from <= p.from && p.to <= only.to,
        [] => false,
    })
}

/// What an upper bound shows.
fn reach_of(scene: &Scene<'_>, span: &Span, upper: &Upper) -> f64 {
    let Some(feet) = Feet::new(scene, span) else { return f64::INFINITY };
    match upper {
        Upper::Curvature => feet.osculating(scene),
        Upper::Point(at) if sound(&scene.curve, at.segment, [at.t, at.t]) => reached(scene, &feet, at.segment, at.t),
        Upper::Point(_) => f64::INFINITY,
    }
}

#[cfg(test)]
mod tests {
    use feature_sampling::bezier::Cubic;
    use feature_sampling::curve::door::DoorOptions;
    use feature_sampling::model::CurveModel;

    use super::*;

    /// y = x²/4 for |x| ≤ 6. Its medial axis is the ray (0, y), y ≥ 2; the radius at a foot is √(4 + x²).
    fn parabola() -> CurveModel<f64> {
        let cubic = [(-6.0, 9.0), (-2.0, -3.0), (2.0, -3.0), (6.0, 9.0)].map(|(x, y)| Point::new(x, y));
        CurveModel::new(&[(false, &[Cubic { points: cubic }])], &DoorOptions::default()).expect("a curve")
    }

    /// All stretches of one side of the parabola, halved so often, with their radii as claims. Outside, radii have no bound.
    fn cells(left: bool, depth: u32) -> Tree {
        fn divide(nodes: &mut Vec<Node>, left: bool, [from, to]: [f64; 2], depth: u32) {
            let x = |t: f64| 12.0 * t - 6.0;
            let nearest = if from < 0.5 && to > 0.5 { 0.0 } else { x(from).abs().min(x(to).abs()) };
            let m = 0.5 * (from + to);
            let split = depth > 0;
            let (lower, upper) = match (split, left) {
                (true, _) => (0.0, None),
                (_, false) => (20.0, None),
                // What has its own reflection beside it is bounded by curvature.
                _ if x(m).abs() < 0.05 => ((4.0 + nearest * nearest).sqrt() * (1.0 - 2e-4), Some(Upper::Curvature)),
                _ => {
                    let reflected = Upper::Point(Place { segment: 0, t: 1.0 - m });
                    ((4.0 + nearest * nearest).sqrt() * (1.0 - 2e-4), Some(reflected))
                }
            };
            nodes.push(Node { split, lower, upper });
            if split {
                divide(nodes, left, [from, m], depth - 1);
                divide(nodes, left, [m, to], depth - 1);
            }
        }
        let mut nodes = Vec::new();
        divide(&mut nodes, left, [0.0, 1.0], depth);
        Tree { feet: Span::Side { segment: 0, left, from: 0.0, to: 1.0 }, nodes }
    }

    /// The nearest medial point may stand on feet that are farther than it is, but by less than twice: seen from (√8, 2) the ray begins at a
    /// distance of √8, and the foot of its first point is at √12. Who looks at feet up to the distance in question only finds nothing there.
    #[test]
    fn feet_count_up_to_twice_the_distance() {
        let model = parabola();
        let scene = Scene::new(model.curve());
        let certificate = Certificate {
            curve: hash(&scene.curve),
            corner_angle: 1.0,
            epsilon: 0.5,
            min_distance: None,
            claimed: Claimed::Proved,
            samples: Vec::new(),
            pieces: Vec::new(),
            neighbourhoods: Vec::new(),
            trees: vec![cells(true, 13), cells(false, 6)],
        };
        let x = 8.0_f64.sqrt();
        let shown = |lfs: f64| {
            let mut checker = Checker::new(&scene, &certificate, false).expect("a sound certificate");
            let ball = checker.spot(0, (x + 6.0) / 12.0).expect("a point");
            checker.feature(&ball, lfs).expect("claims that hold")
        };
        assert!(shown(x - 2e-3), "the true bound is shown");
        assert!(!shown(x + 1.5e-3), "lfs is less than that");
    }
}
