//! Certificates that hold are accepted, and no claim that is false ever is: certificates are spoilt at random, and what is still
//! accepted is compared with a dense look at the curve.

use feature_sampling::bezier::Cubic;
use feature_sampling::certificate::{Claim, Placed, Verdict};
use feature_sampling::curve::door::DoorOptions;
use feature_sampling::geometry::Point;
use feature_sampling::medial::Resolution;
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::{Condition, SamplingOptions};
use fsample_recheck::{Certificate, Claimed, FLOOR, Proved, SINGULAR_FLOOR, Span, Upper, Why, certificate, check};

type Paths = Vec<(bool, Vec<Cubic<f64>>)>;

fn cubic(p: [(f64, f64); 4]) -> Cubic<f64> {
    let [a, b, c, d] = p.map(|(x, y)| Point::new(x, y));
    Cubic::new(a, b, c, d)
}

/// An ellipse of four cubics, and a stroke outside of it with two open ends.
fn smooth() -> Paths {
    let k = 0.552_284_749_830_793_4;
    let (a, b) = (3.0, 1.0);
    let ellipse = vec![
        cubic([(a, 0.0), (a, k * b), (k * a, b), (0.0, b)]),
        cubic([(0.0, b), (-k * a, b), (-a, k * b), (-a, 0.0)]),
        cubic([(-a, 0.0), (-a, -k * b), (-k * a, -b), (0.0, -b)]),
        cubic([(0.0, -b), (k * a, -b), (a, -k * b), (a, 0.0)]),
    ];
    vec![(true, ellipse), (false, vec![cubic([(-2.0, 3.0), (-1.0, 2.0), (1.0, 2.0), (3.0, 4.0)])])]
}

/// A bent stroke, its corner, and a stroke that crosses it.
fn singular() -> Paths {
    let bent = vec![
        cubic([(0.0, 0.0), (1.0, 0.5), (2.0, 0.5), (3.0, 0.0)]),
        cubic([(3.0, 0.0), (3.2, 1.0), (3.0, 2.0), (2.0, 3.0)]),
    ];
    vec![(false, bent), (false, vec![cubic([(1.0, -1.0), (1.2, 0.0), (1.6, 1.0), (1.5, 2.0)])])]
}

struct Made {
    model: CurveModel<f64>,
    medial: MedialModel<f64>,
    samples: Vec<Placed<f64>>,
}

fn made(paths: &Paths, epsilon: f64) -> Made {
    let input: Vec<(bool, &[Cubic<f64>])> = paths.iter().map(|(closed, c)| (*closed, c.as_slice())).collect();
    let model = CurveModel::new(&input, &DoorOptions::default()).expect("a curve");
    let medial = MedialModel::new(&model, &Resolution::Tolerance(1e-4));
    let options = SamplingOptions {
        condition: Condition::Epsilon(epsilon),
        tolerance: 1e-3,
        singular_floor: 0.98 * SINGULAR_FLOOR,
        floor: 0.98 * FLOOR,
        ..SamplingOptions::default()
    };
    let mut samples: Vec<Placed<f64>> = model
        .sample(&medial, &options)
        .expect("samples")
        .iter()
        .map(|s| Placed { path: s.path, at: s.at, point: s.point })
        .collect();
    samples.sort_by(|a, b| a.at.segment.cmp(&b.at.segment).then(a.at.t.total_cmp(&b.at.t)));
    Made { model, medial, samples }
}

fn proved(made: &Made, epsilon: f64) -> Certificate {
    let claim = Claim::new(epsilon);
    let judgement = made.model.certify(&made.samples, &claim, 400_000, false);
    certificate(&made.model, &made.samples, &claim, 1.0, &judgement)
}

#[test]
fn what_is_proved_is_accepted() {
    for (paths, epsilon) in [(smooth(), 0.5), (smooth(), 0.66), (singular(), 0.5), (singular(), 0.66)] {
        let made = made(&paths, 0.99 * epsilon);
        let c = proved(&made, epsilon);
        assert_eq!(c.claimed, Claimed::Proved, "at {epsilon}");
        let checked = check(made.model.curve(), &c);
        assert!(matches!(checked, Ok(Proved::Sample { claims }) if claims > 100), "at {epsilon}: {checked:?}");
        let mut text = Vec::new();
        c.write(&mut text, &[]).expect("a vector");
        let text = String::from_utf8(text).expect("text");
        assert_eq!(Certificate::read(&text).as_ref(), Ok(&c), "it comes back to the bit");
    }
}

#[test]
fn what_is_refuted_is_accepted() {
    let whole = made(&smooth(), 0.495);
    for dropped in (0..whole.samples.len()).step_by(11) {
        let mut samples = whole.samples.clone();
        samples.remove(dropped);
        let claim = Claim::new(0.5);
        let judgement = whole.model.certify(&samples, &claim, 400_000, false);
        assert!(matches!(judgement.verdict, Verdict::Refuted(_)), "without sample {dropped}");
        let mut c = certificate(&whole.model, &samples, &claim, 1.0, &judgement);
        let checked = check(whole.model.curve(), &c);
        assert!(
            matches!(checked, Ok(Proved::Fault(_))),
            "without sample {dropped}: {checked:?} {:?} {:?}",
            judgement.verdict,
            c.claimed
        );
        // Each number of the witness better than it is.
        let Claimed::Refuted(honest) = c.claimed else { panic!("a witness") };
        for change in 0..3 {
            let mut w = honest;
            match change {
                0 => w.distance *= 1.05,
                1 => w.lfs *= 0.5,
                _ => w.lower = 1.05 * w.lower + 1.0,
            }
            c.claimed = Claimed::Refuted(w);
            assert!(check(whole.model.curve(), &c).is_err(), "without sample {dropped}, change {change}");
        }
    }
}

struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, n: usize) -> usize {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to n")]
        let k = (self.unit() * n as f64) as usize;
        k.min(n - 1)
    }

    /// A number like v: near it, far from it, or something else.
    fn like(&mut self, v: f64) -> f64 {
        match self.below(8) {
            0 => 0.0,
            1 => -v,
            2 => v * (1.0 + 1e-3 * (self.unit() - 0.5)),
            3 => v * 1.001,
            4 => v * 2.0 + 0.01,
            5 => self.unit(),
            6 => f64::from_bits(v.to_bits() ^ 1 << self.below(64)),
            _ => v + 0.2 * (self.unit() - 0.5),
        }
    }
}

/// Spoils one thing.
fn spoil(c: &mut Certificate, random: &mut Random) -> &'static str {
    let tree = random.below(c.trees.len());
    let node = random.below(c.trees[tree].nodes.len());
    let piece = random.below(c.pieces.len());
    let sample = random.below(c.samples.len());
    match random.below(20) {
        0 => {
            c.epsilon *= 1.0 - 0.1 * random.unit();
            "ε lowered"
        }
        1 => {
            c.epsilon = random.like(c.epsilon);
            "ε changed"
        }
        2 => {
            let s = &mut c.samples[sample];
            s.x = random.like(s.x);
            s.y = random.like(s.y);
            "a sample moved"
        }
        3 => {
            let s = &mut c.samples[sample];
            s.at.t = random.like(s.at.t);
            "a sample's place changed"
        }
        4 => {
            c.samples.remove(sample);
            "a sample dropped"
        }
        5 => {
            c.pieces.remove(piece);
            "a piece dropped"
        }
        6 => {
            let p = &mut c.pieces[piece];
            p.to = random.like(p.to);
            "a piece's end changed"
        }
        7 => {
            c.pieces[piece].sample = u32::try_from(random.below(c.samples.len() + 1)).expect("few");
            "a piece's sample changed"
        }
        8 => {
            let why = c.pieces[piece].why;
            c.pieces[piece].why = match (why, random.below(4)) {
                (Why::Feature(lfs), 0 | 1) => Why::Feature(lfs * (1.0 + 0.1 * random.unit())),
                (Why::Feature(lfs), 2) => Why::Feature(random.like(lfs)),
                (_, 3) => Why::Neighbourhood(u32::try_from(random.below(4)).expect("few")),
                _ => Why::Floor,
            };
            "a piece's reason changed"
        }
        9 => {
            let next = (piece + 1).min(c.pieces.len() - 1);
            c.pieces[piece].to = c.pieces[next].to;
            c.pieces.remove(next);
            "two pieces made one"
        }
        10 => {
            c.trees.remove(tree);
            "a tree dropped"
        }
        11 => {
            c.trees[tree].nodes.remove(node);
            "a cell dropped"
        }
        12 => {
            c.trees[tree].nodes[node].split ^= true;
            "a cell divided, or not"
        }
        13 | 14 => {
            let n = &mut c.trees[tree].nodes[node];
            n.lower = if n.lower > 0.0 { n.lower * (1.0 + random.unit()) } else { random.unit() };
            "a radius enlarged"
        }
        15 => {
            c.trees[tree].nodes[node].lower = f64::MAX;
            "a radius without end"
        }
        16 => {
            let at = fsample_recheck::Place { segment: u32::try_from(random.below(6)).expect("few"), t: random.unit() };
            c.trees[tree].nodes[node].upper =
                Some(if random.below(4) == 0 { Upper::Curvature } else { Upper::Point(at) });
            "an upper bound changed"
        }
        17 => {
            let by = random.unit();
            let (Span::Side { from, to, .. } | Span::Fan { from, to, .. }) = &mut c.trees[tree].feet;
            if random.below(2) == 0 {
                *from += 0.1 * by
            } else {
                *to -= 0.1 * by
            }
            "a tree's feet changed"
        }
        18 => {
            match c.neighbourhoods.len() {
                0 => c.min_distance = Some(0.02 * random.unit()),
                n => {
                    let n = &mut c.neighbourhoods[random.below(n)];
                    let step = random.below(n.steps.len());
                    match random.below(3) {
                        0 => n.steps[step].to = random.like(n.steps[step].to),
                        1 => n.place.at.t = random.like(n.place.at.t),
                        _ => {
                            n.steps.remove(step);
                        }
                    }
                }
            }
            "a neighbourhood changed, or a floor claimed"
        }
        _ => {
            // Every radius a little larger.
            let by = 1.0 + 0.02 * random.unit();
            c.trees.iter_mut().flat_map(|t| &mut t.nodes).for_each(|n| n.lower *= by);
            "all radii enlarged"
        }
    }
}

/// How much the condition fails by, densely looked at: the largest of |p−s| / max(ε lfs, floor).
fn worst(made: &Made, c: &Certificate) -> f64 {
    let (curve, diagonal) = (made.model.curve(), *made.model.diagonal());
    let mut worst = 0.0_f64;
    for (segment, index) in curve.segments.iter().zip(0..) {
        for i in 0..=400 {
            let t = f64::from(i) / 400.0;
            let p = segment.point(&t);
            let lfs = made.medial.lfs(&p);
            let nearest = c.samples.iter().map(|s| p.distance(&Point::new(s.x, s.y))).fold(f64::INFINITY, f64::min);
            let feature = c.epsilon * lfs;
            let floor = match c.min_distance {
                Some(floor) => floor,
                None if feature < SINGULAR_FLOOR * diagonal => SINGULAR_FLOOR * diagonal,
                None => FLOOR * diagonal,
            };
            let ratio = nearest / feature.max(floor);
            assert!(!ratio.is_nan(), "at {index} {t}");
            worst = worst.max(ratio);
        }
    }
    worst
}

/// No spoilt certificate gets a false claim accepted, and none makes the check panic.
fn survey(rounds: usize, seed: u64) {
    let mut random = Random(seed);
    let (mut accepted, mut rejected) = (0, 0);
    for (paths, aim) in [(smooth(), 0.499), (singular(), 0.49)] {
        let made = made(&paths, aim);
        let honest = proved(&made, 0.5);
        assert_eq!(honest.claimed, Claimed::Proved);
        for _ in 0..rounds / 2 {
            let mut c = honest.clone();
            let what = spoil(&mut c, &mut random);
            if check(made.model.curve(), &c).is_err() {
                rejected += 1;
                continue;
            }
            accepted += 1;
            // The medial polylines know lfs to 1e-4.
            let ratio = worst(&made, &c);
            assert!(ratio < 1.0 + 1e-3, "{what}: {ratio}");
        }
    }
    assert!(accepted > rounds / 10 && rejected > rounds / 3, "both happen: {accepted} and {rejected}");
}

#[test]
fn nothing_false_is_accepted() {
    survey(100, 1);
}

/// `cargo test --release -p fsample-recheck --test mutations -- --ignored`.
#[test]
#[ignore = "long: 10,000 certificates"]
fn nothing_false_is_accepted_of_ten_thousand() {
    survey(10_000, 2);
}

/// What is claimed may be true and its certificate still be worth nothing: no part of a cover may be missing.
#[test]
fn what_is_left_out_is_missed() {
    for paths in [smooth(), singular()] {
        let made = made(&paths, 0.49);
        let honest = proved(&made, 0.5);
        let curve = made.model.curve();
        let missed = |c: &Certificate, what: &str| assert!(check(curve, c).is_err(), "{what}");
        for i in 0..honest.trees.len() {
            let mut c = honest.clone();
            c.trees.remove(i);
            missed(&c, "a tree");
            let mut c = honest.clone();
            let (Span::Side { from, to, .. } | Span::Fan { from, to, .. }) = &mut c.trees[i].feet;
            if i % 2 == 0 {
                *from += 1e-3;
            } else {
                *to -= 1e-3;
            }
            missed(&c, "an end of a tree");
        }
        for i in (0..honest.pieces.len()).step_by(9) {
            let mut c = honest.clone();
            c.pieces.remove(i);
            missed(&c, "a piece");
            let mut c = honest.clone();
            let p = &mut c.pieces[i];
            p.to = p.from + 0.999 * (p.to - p.from);
            missed(&c, "an end of a piece");
        }
    }
}

/// Certificates made for a false claim: the samples of ε = 0.5 as samples of 0.3, everything in order but for one thing.
#[test]
fn forgeries_are_rejected() {
    for paths in [smooth(), singular()] {
        let made = made(&paths, 0.49);
        let mut forged = proved(&made, 0.5);
        let curve = made.model.curve();
        forged.epsilon = 0.3;
        assert!(worst(&made, &forged) > 1.2, "the claim is false");
        for p in &mut forged.pieces {
            if let Why::Feature(lfs) = &mut p.why {
                *lfs *= 0.5 / 0.3 * (1.0 + 1e-9);
            }
        }
        assert!(check(curve, &forged).is_err(), "lfs is not that large");
        // No cells at all.
        let mut c = forged.clone();
        c.trees.clear();
        assert!(check(curve, &c).is_err(), "there are feet");
        // Disks so large that nothing comes near: only that they are not empty is wrong.
        for radius in [0.5, 10.0, 1e6] {
            let mut c = forged.clone();
            for tree in &mut c.trees {
                tree.nodes = vec![fsample_recheck::Node { split: false, lower: radius, upper: None }];
            }
            assert!(check(curve, &c).is_err(), "disks of radius {radius} are not empty");
        }
        // The pieces that are served, and no others.
        let mut c = forged.clone();
        c.pieces.retain(|p| !matches!(p.why, Why::Feature(_)));
        assert!(check(curve, &c).is_err(), "the rest of the curve is missing");
        // Samples beside the curve.
        let mut c = forged.clone();
        c.epsilon = 0.5;
        for s in &mut c.samples {
            s.y += 1e-3;
        }
        assert!(check(curve, &c).is_err(), "samples are on the curve");
        // A floor where there is none.
        let mut c = forged.clone();
        for p in &mut c.pieces {
            p.why = Why::Floor;
        }
        assert!(check(curve, &c).is_err(), "no floor is that large");
    }
}

/// A claim of lfs that is larger than the truth is not shown by any cells.
#[test]
fn a_claim_beyond_its_slack_is_rejected() {
    let made = made(&smooth(), 0.495);
    let honest = proved(&made, 0.5);
    let curve = made.model.curve();
    for i in (0..honest.pieces.len()).step_by(7) {
        let mut c = honest.clone();
        let p = &mut c.pieces[i];
        let cubic = curve.segment(p.segment).expect("a segment");
        let lfs = |t: f64| made.medial.lfs(&cubic.point(&t));
        let least = lfs(0.5 * (p.from + p.to)).min(lfs(p.from)).min(lfs(p.to));
        p.why = Why::Feature(1.002 * least);
        assert!(check(curve, &c).is_err(), "piece {i}");
    }
}
