//! HNN-Crust (Ohrhallinger, Mitchell, Wimmer 2016).
//!
//! Each site p chooses its nearest neighbour q, and as half-neighbour the nearest r on p's own side of the bisector of p and
//! q: |qr| > |pr|. An edge counts if both its ends choose it. Proved to be correct below ε = 0.47. Degrees never exceed 2,
//! so the result is made of paths and loops. The candidates are the 14 nearest other sites, as in its authors' program; a
//! site with no half-neighbour among them keeps only q. O(n log n).

use super::kd::Kd;
use super::sites::Sites;
use super::{Pairs, Reconstruction};

/// Whose choice an edge needs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Consent {
    /// Both its ends'.
    #[default]
    Both,
    /// One end's.
    Either,
}

/// HNN-Crust.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HnnCrust {
    /// Whose choice an edge needs.
    pub consent: Consent,
    /// How many nearest other sites are looked at.
    pub candidates: usize,
}

impl Default for HnnCrust {
    fn default() -> Self {
        Self { consent: Consent::Both, candidates: 14 }
    }
}

impl Reconstruction for HnnCrust {
    fn pairs(&self, sites: &Sites) -> Pairs {
        let kd = Kd::new(sites.points());
        let mut found = Vec::new();
        let mut chosen: Vec<[Option<u32>; 2]> = Vec::with_capacity(sites.len());
        let wanted = self.candidates.min(sites.len()) + 1;
        for p in sites.numbers() {
            kd.nearest(&sites.point(p), wanted, &mut found);
            // The site itself comes first: sites are distinct.
            let mut others = found.iter().filter(|other| other.1 != p);
            let choice = others.next().map(|&(_, q)| {
                let beyond = |r: &&(f64, u32)| sites.point(q).distance_sq(&sites.point(r.1)) > r.0;
                [Some(q), others.find(beyond).map(|r| r.1)]
            });
            chosen.push(choice.unwrap_or_default());
        }
        let chooses = |a: u32, b: u32| chosen[a as usize].contains(&Some(b));
        let mut pairs = Vec::new();
        for p in sites.numbers() {
            let agreed = |r: &u32| self.consent == Consent::Either || chooses(*r, p);
            pairs.extend(chosen[p as usize].into_iter().flatten().filter(agreed).map(|r| [p, r]));
        }
        pairs
    }
}
