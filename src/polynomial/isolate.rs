//! Isolation: brackets that hold exactly one root each, and clusters that cannot be told apart.
//!
//! Pieces of the interval are visited from left to right. The sign pattern of a piece's Bernstein coefficients decides:
//! no sign variation, no root; one variation, one root; otherwise the piece is halved. A coefficient below the noise has
//! no sign. Undecided coefficients *inside* a pattern only raise the possible number of variations and call for halving.
//! Undecided coefficients at an *end* mean roots near that end: if b₀ … b₍ₖ₋₁₎ are at most E in modulus and the others
//! all beyond m on one side, then p = 0 at s is possible only where the Bernstein weights of the latter, P(s) ≥ sᵏ,
//! satisfy m·P ≤ E·(1−P), hence sᵏ ≤ E/(E+m): the roots, k at most by the rule of signs, lie in a short bracket at that
//! end, and nothing is left for the rest of the piece.
//!
//! The first piece is written in the scalar's own precision, with noise in proportion to the whole of p. Before a bracket is
//! given up as a cluster, p is written anew on it, as if in twice the precision: what is left of the noise then is what is
//! taken to be unknown of the coefficients (or, if they are taken as [`Given::Exactly`], a multiple of u²). Isolation goes on
//! until all coefficients of a piece are below twice that, or signs are clear.
//!
//! Work is bounded by a number of steps; what is left when they are spent is reported as clusters, never dropped.

use super::bernstein::{self, Given, Piece, Signs};
use super::{Polynomial, twofold};
use crate::buffer::Keep;
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// Pieces waiting while their left neighbours are searched, one for each level of halving. When there is no more room,
/// those without roots are thrown out; the others are fewer than N by the rule of signs, but for noise.
const PENDING: usize = 32;

/// Brackets within brackets that are searched once more.
const NESTED: usize = 12;

/// A piece with undecided signs is written anew when all its coefficients are below 2^NOISY times the noise. Without this
/// margin the search would follow the place where |p| crosses the noise level, which is not a root, down to the last bit.
const NOISY: i32 = 4;

/// The same for pieces whose noise can not be made smaller: these are given up.
const SETTLED: i32 = 1;

/// What a bracket holds.
#[derive(Clone, Debug)]
pub(super) enum Found<S> {
    /// One root with a change of sign; where to start looking.
    One(S),
    /// As many roots as the number says at most, too close to tell apart; 0 where only noise is seen.
    Cluster(usize),
}

/// A bracket with roots.
#[derive(Clone, Debug)]
pub(super) struct Isolated<S> {
    /// Lower end.
    pub(super) lower: S,
    /// Upper end.
    pub(super) upper: S,
    /// Sign of p just below, 0 if unknown.
    pub(super) before: i8,
    /// Sign of p just above, 0 if unknown.
    pub(super) after: i8,
    /// The content.
    pub(super) found: Found<S>,
}

/// What the coefficients of a piece say.
enum Verdict<S> {
    /// No root; the sign of p.
    None(i8),
    /// One root; the index i of the coefficient before the change, if the change is between neighbours, and the sign of p
    /// before it.
    One(Option<u32>, i8),
    /// Not decided: halve.
    Halve,
    /// All roots of the piece (k at most) lie within this share of its width from its lower end.
    AtLower(S, usize),
    /// The same from its upper end.
    AtUpper(S, usize),
    /// Nothing stands out from the noise.
    Noise,
}

/// Brackets on their way out, in ascending order.
struct Record<S, F> {
    /// Takes them.
    out: F,
    /// The last one, while it is a cluster that may still grow or learn the sign behind it.
    open: Option<Isolated<S>>,
    /// Sign of p at the right end of what has been searched so far.
    sign: i8,
    /// Signs of p from the upper ends of brackets that are searched once more, innermost last.
    beyond: ArrayVec<(S, i8), NESTED>,
}

impl<S: Scalar, F: FnMut(Isolated<S>)> Record<S, F> {
    /// A stretch was searched whose signs at its ends are these.
    #[inline]
    fn pass(&mut self, first: i8, last: i8) {
        if let Some(previous) = &mut self.open
            && previous.after == 0
        {
            previous.after = first;
        }
        self.sign = last;
    }

    /// The search has come to this place: stretches without roots before it are passed.
    #[inline]
    fn arrive(&mut self, at: Option<&S>) {
        while let Some((from, sign)) = self.beyond.last()
            && at.is_none_or(|at| from <= at)
        {
            let sign = *sign;
            self.beyond.pop();
            self.pass(sign, sign);
        }
    }

    /// One root between lower and upper.
    #[inline]
    fn one(&mut self, lower: S, upper: S, before: i8, start: S) {
        self.pass(before, -before);
        self.close();
        (self.out)(Isolated { lower, upper, before, after: -before, found: Found::One(start) });
    }

    /// Nothing more can be learnt about the last cluster.
    #[inline]
    fn close(&mut self) {
        if let Some(cluster) = self.open.take() {
            (self.out)(cluster);
        }
    }

    /// Unresolved roots; joined to an unresolved neighbour which they touch.
    #[cold]
    fn cluster(&mut self, lower: S, upper: S, before: i8, after: i8, count: usize) {
        if let Some(previous) = &mut self.open
            && let Found::Cluster(other) = previous.found
            && previous.upper >= lower
        {
            previous.upper = upper;
            previous.after = after;
            previous.found = Found::Cluster(if other == 0 || count == 0 { 0 } else { other.max(count) });
            self.sign = after;
            return;
        }
        let before = if before == 0 { self.sign } else { before };
        self.pass(before, after);
        self.close();
        self.open = Some(Isolated { lower, upper, before, after, found: Found::Cluster(count) });
    }
}

/// Brackets of all roots of p on `first`, ascending; `p` is the polynomial the piece was made from and p(0) ≠ 0.
#[inline]
pub(super) fn isolate<S: Scalar, const N: usize>(
    p: &Polynomial<S, N>,
    first: Piece<S, N>,
    given: Given,
    out: impl FnMut(Isolated<S>),
) {
    let mut verdict = judge(&first);
    if matches!(verdict, Verdict::None(_)) {
        return;
    }
    let mut record = Record { out, open: None, sign: 0, beyond: ArrayVec::new() };
    // the last one is the leftmost
    let mut pieces: ArrayVec<Piece<S, N>, PENDING> = ArrayVec::new();
    pieces.keep(first);
    for _ in 0..2 * N * (S::BITS as usize + 16) {
        let Some(piece) = pieces.last() else { break };
        if !record.beyond.is_empty() {
            record.arrive(Some(&piece.lo));
        }
        match verdict {
            Verdict::None(sign) => record.pass(sign, sign),
            Verdict::One(change, before) => {
                let (lower, upper) = (piece.lo.clone(), piece.hi.clone());
                let start = match change {
                    Some(i) => bernstein::polygon_zero(&piece.b, i, &lower, &upper),
                    None => S::midpoint(&lower, &upper),
                };
                record.one(lower, upper, before, start);
            }
            Verdict::Halve => {
                if pieces.is_full() {
                    make_room(&mut pieces);
                }
                let copy = pieces.last().cloned();
                if let Some(copy) = copy
                    && pieces.try_push(copy).is_ok()
                {
                    if let [.., right, left] = pieces.as_mut_slice()
                        && right.halve(left)
                    {
                        if given == Given::Provably && !twofold::is_exact_sum(&left.lo, &right.hi) {
                            seat_again(p, left, right);
                        }
                        verdict = judge(left);
                        continue;
                    }
                    pieces.truncate(pieces.len() - 1);
                }
                if let Some(piece) = pieces.last() {
                    record.cluster(piece.lo.clone(), piece.hi.clone(), 0, 0, 0);
                }
            }
            unresolved => {
                if let Some(anew) = settle(p, piece, unresolved, given, &mut record)
                    && let Some(piece) = pieces.last_mut()
                {
                    *piece = anew;
                    verdict = judge(piece);
                    continue;
                }
            }
        }
        pieces.truncate(pieces.len().saturating_sub(1));
        let Some(piece) = pieces.last() else { break };
        verdict = judge(piece);
    }
    // steps have run out, or nothing is left
    while let Some(piece) = pieces.pop() {
        record.cluster(piece.lo, piece.hi, 0, 0, 0);
    }
    record.arrive(None);
    record.close();
}

/// Halves whose common end was rounded are not quite halves: coefficients that prove something are those between the ends as
/// they are.
#[cold]
fn seat_again<S: Scalar, const N: usize>(p: &Polynomial<S, N>, left: &mut Piece<S, N>, right: &mut Piece<S, N>) {
    for piece in [left, right] {
        *piece = Piece::seated(p, piece.lo.clone(), piece.hi.clone(), Given::Provably);
    }
}

/// Throws out pieces without roots; no sign changes on them, so nothing else is lost.
#[cold]
fn make_room<S: Scalar, const N: usize>(pieces: &mut ArrayVec<Piece<S, N>, PENDING>) {
    pieces.retain(|piece| !matches!(judge(piece), Verdict::None(_)));
}

/// Records a cluster, or writes p anew where that would show more.
#[cold]
fn settle<S: Scalar, const N: usize>(
    p: &Polynomial<S, N>,
    piece: &Piece<S, N>,
    verdict: Verdict<S>,
    given: Given,
    record: &mut Record<S, impl FnMut(Isolated<S>)>,
) -> Option<Piece<S, N>> {
    let signs = Signs::of(&piece.b, &piece.noise);
    let last = u32::try_from(N).unwrap_or(1).saturating_sub(1);
    let width = piece.hi.clone() - &piece.lo;
    let (lo, hi) = (piece.lo.clone(), piece.hi.clone());
    let (lower, upper, before, after, count) = match verdict {
        Verdict::AtLower(share, count) => (lo.clone(), lo.clone() + &(width * &share), 0, signs.at(last), count),
        Verdict::AtUpper(share, count) => (hi.clone() - &(width * &share), hi.clone(), signs.at(0), 0, count),
        _ if piece.settled => {
            record.cluster(lo, hi, 0, 0, 0);
            return None;
        }
        _ => (lo.clone(), hi.clone(), 0, 0, 0),
    };
    let (lower, upper) = match given {
        // Rounded outwards, where this is still a part of the piece: what is proved holds beyond.
        Given::Provably => {
            let nudge = S::unit_roundoff().twice();
            (lo.clone().max(lower * &(S::one() - &nudge)), hi.clone().min(upper * &(S::one() + &nudge)))
        }
        _ => (lower, upper),
    };
    let is_no_part = given == Given::Provably && count > 0 && lower <= lo && upper >= hi;
    if lower >= upper || is_no_part {
        record.cluster(lower, upper, before, after, count);
        return None;
    }
    if before != 0 {
        record.pass(before, before);
    }
    if after != 0 {
        // Without room the parity of what is found stays unknown, nothing else.
        let _ = record.beyond.try_push((upper.clone(), after));
    }
    let mut anew = Piece::seated(p, lower, upper, given);
    let helps = anew.noise.clone() * &S::ratio(4, 3) < piece.noise;
    anew.settled = count == 0 && !helps;
    Some(anew)
}

/// All coefficients are beyond the noise, on one side: p has no root on the piece.
#[inline]
pub(super) fn has_no_root<S: Scalar, const N: usize>(piece: &Piece<S, N>) -> bool {
    matches!(judge(piece), Verdict::None(_))
}

/// Reads the sign pattern of a piece.
#[inline]
fn judge<S: Scalar, const N: usize>(piece: &Piece<S, N>) -> Verdict<S> {
    // the common case, all signs known, in few steps
    let mut least = S::infinity();
    let mut negative = 0;
    for (i, c) in piece.b.iter().enumerate() {
        least = c.clone().abs().min(least);
        negative |= u32::from(*c < S::zero()) << i;
    }
    let all_known = least > piece.noise;
    if !all_known {
        return judge_noisy(piece);
    }
    let before = if negative & 1 == 0 { 1 } else { -1 };
    let changes = (negative ^ (negative >> 1)) & (Signs::full::<N>() >> 1);
    if changes == 0 {
        Verdict::None(before)
    } else if changes.is_power_of_two() {
        Verdict::One(Some(changes.trailing_zeros()), before)
    } else {
        Verdict::Halve
    }
}

/// Reads a sign pattern with undecided coefficients in it.
#[cold]
fn judge_noisy<S: Scalar, const N: usize>(piece: &Piece<S, N>) -> Verdict<S> {
    let signs = Signs::of(&piece.b, &piece.noise);
    let decided = signs.decided();
    let ceiling = piece.noise.clone().mul_pow2(if piece.settled { SETTLED } else { NOISY });
    if piece.b.iter().all(|c| c.clone().abs() <= ceiling) {
        return Verdict::Noise;
    }
    let size = u32::try_from(N).unwrap_or(0);
    let leading = decided.trailing_zeros();
    let trailing = decided.leading_zeros() - (u32::BITS - size);
    // the most variations that any choice of the undecided signs inside the pattern can give
    let (mut most, mut previous, mut gap) = (0, signs.at(leading), 1);
    for i in leading + 1..size - trailing {
        let sign = signs.at(i);
        if sign == 0 {
            gap += 1;
        } else {
            most += if sign == previous { gap & !1 } else { (gap - 1) | 1 };
            (previous, gap) = (sign, 1);
        }
    }
    match (leading, trailing, most) {
        (0, 0, 1) => {
            let changes = signs.changes();
            Verdict::One((changes != 0).then(|| changes.trailing_zeros()), signs.at(0))
        }
        (k, 0, 0) => match share(piece, decided, k) {
            Some(share) => Verdict::AtLower(share, k as usize),
            None => Verdict::Halve,
        },
        (0, k, 0) => match share(piece, decided, k) {
            Some(share) => Verdict::AtUpper(share, k as usize),
            None => Verdict::Halve,
        },
        _ => Verdict::Halve,
    }
}

/// The share s of the width with sᵏ ≤ E/(E+m), rounded up to a power of two and doubled; `None` if it is not small.
fn share<S: Scalar, const N: usize>(piece: &Piece<S, N>, decided: u32, k: u32) -> Option<S> {
    let mut least = S::infinity();
    for (i, c) in piece.b.iter().enumerate() {
        if (decided >> i) & 1 == 1 {
            least = least.min(c.clone().abs());
        }
    }
    let target = piece.noise.clone() / &(piece.noise.clone() + &least);
    let step = k.cast_signed();
    let (mut share, mut power) = (S::one(), S::one());
    for _ in 0..2 * S::BITS {
        let smaller = power.clone().mul_pow2(-step);
        if smaller < target {
            break;
        }
        power = smaller;
        share = share.half();
    }
    let share = share.twice();
    (share <= S::one().mul_pow2(-2)).then_some(share)
}
