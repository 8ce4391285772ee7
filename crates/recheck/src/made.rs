//! From the prover's answer to a certificate: what it knows, written down as claims. Nothing is checked here.

use feature_sampling::certificate::{BoundedFoot, Claim, Placed, Reason, Verdict};
use feature_sampling::curve::{CurveParam, EndId};
use feature_sampling::medial::Side;
use feature_sampling::medial::cell::{Cell, FootSpan, UNDIVIDED};
use feature_sampling::model::{CurveModel, Judgement};

use crate::{
    Certificate, Claimed, FootClaim, NeighbourhoodClaim, Node, PieceClaim, Place, SampleClaim, Span, Step, Tree, Upper,
    Why, WitnessClaim, hash, trim,
};

/// What claims are changed by so that the check's roundings, which are others, have room: a share of 2⁻⁴⁰.
const ROUNDING: f64 = 1.0 / (1_u64 << 40) as f64;

fn place(at: &CurveParam<f64>) -> Place {
    Place { segment: at.segment, t: at.t }
}

fn upper(witness: Option<&CurveParam<f64>>) -> Upper {
    witness.map_or(Upper::Curvature, |at| Upper::Point(place(at)))
}

fn foot(foot: &BoundedFoot<f64>) -> FootClaim {
    FootClaim { at: place(&foot.at), left: foot.side == Side::Left, upper: upper(foot.witness.as_ref()) }
}

fn number(end: EndId) -> u32 {
    2 * end.segment() + u32::from(end.side() == 1)
}

fn span(feet: &FootSpan<f64>) -> Option<Span> {
    match *feet {
        FootSpan::Normal { segment, span: [from, to], side } => {
            Some(Span::Side { segment, left: side == Side::Left, from, to })
        }
        FootSpan::Fan { end, other, left, span: [from, to] } => {
            Some(Span::Fan { end: number(end), other: number(other), left, from, to })
        }
        // The check knows such points itself.
        FootSpan::Corner { .. } => None,
    }
}

/// A cell and all that it was divided into, in preorder.
fn tree(cells: &[Cell<f64>], root: usize, feet: Span) -> Tree {
    let mut nodes = Vec::new();
    let mut pending = vec![(root, 0.0, f64::INFINITY)];
    while let Some((i, inherited, reached)) = pending.pop() {
        let Some(cell) = cells.get(i) else { break };
        let split = cell.children != UNDIVIDED;
        let lower = if cell.lower > inherited { cell.lower } else { 0.0 };
        let upper = (cell.upper < reached).then(|| upper(cell.witness.as_ref()));
        nodes.push(Node { split, lower, upper });
        if split {
            let first = cell.children as usize;
            let (inherited, reached) = (inherited.max(lower), reached.min(cell.upper));
            pending.extend([(first + 1, inherited, reached), (first, inherited, reached)]);
        }
    }
    Tree { feet, nodes }
}

/// Writes an answer down, and leaves out what no piece relies on.
pub fn certificate(
    model: &CurveModel<f64>,
    samples: &[Placed<f64>],
    claim: &Claim<f64>,
    corner_angle: f64,
    judgement: &Judgement<f64>,
) -> Certificate {
    let curve = model.curve();
    let claimed = match &judgement.verdict {
        Verdict::Proved => Claimed::Proved,
        Verdict::Unknown => Claimed::Unknown,
        Verdict::Refuted(w) => {
            let cell = judgement.cells.get(w.cell as usize);
            match cell.and_then(|c| span(&c.feet).map(|feet| (c, feet))) {
                Some((cell, feet)) => Claimed::Refuted(WitnessClaim {
                    at: place(&w.at),
                    // The check rounds in another order.
                    distance: w.distance * (1.0 - ROUNDING),
                    lfs: w.lfs * (1.0 + ROUNDING),
                    feet,
                    lower: cell.lower,
                    upper: upper(cell.witness.as_ref()),
                }),
                None => Claimed::Unknown,
            }
        }
    };
    let steps = |(first, count): (u32, u32)| {
        let all = judgement.steps.get(first as usize..(first + count) as usize).unwrap_or_default();
        let step = |s: &feature_sampling::certificate::Step<f64>| {
            let [from, to] = s.span;
            let foot = s.foot.as_ref().map(foot);
            Step { segment: s.segment, from, to, foot }
        };
        all.iter().map(step).collect()
    };
    let mut certificate = Certificate {
        curve: hash(&curve),
        corner_angle,
        epsilon: claim.epsilon,
        min_distance: claim.min_distance,
        claimed,
        samples: samples.iter().map(|s| SampleClaim { at: place(&s.at), x: s.point.x, y: s.point.y }).collect(),
        pieces: judgement
            .pieces
            .iter()
            .map(|p| PieceClaim {
                segment: p.segment,
                from: p.span[0],
                to: p.span[1],
                sample: p.sample,
                why: match p.reason {
                    // A little more, so that the check's own bound of the sample's distance has room.
                    Reason::Feature(lfs) => Why::Feature(lfs + ROUNDING * curve.diagonal / claim.epsilon),
                    Reason::Floor => Why::Floor,
                    Reason::Neighbourhood(n) => Why::Neighbourhood(n),
                    Reason::Fine | Reason::Cells | Reason::Pieces => Why::Unknown,
                },
            })
            .collect(),
        neighbourhoods: judgement
            .neighbourhoods
            .iter()
            .map(|n| NeighbourhoodClaim { place: foot(&n.foot), steps: steps(n.steps) })
            .collect(),
        trees: (0..judgement.roots.min(judgement.cells.len()))
            .filter_map(|root| span(&judgement.cells[root].feet).map(|feet| tree(&judgement.cells, root, feet)))
            .collect(),
    };
    trim(curve, &mut certificate);
    certificate
}
