//! Curves from points: nine published reconstruction algorithms, and one of ours.
//!
//! Given points on unknown curves, which of them are neighbours along a curve? Each algorithm is a rule that picks edges,
//! most of them of the Delaunay triangulation, and each has its file, which says what is proved of it and how sure this
//! implementation is of being the published rule. All of them see the points through [`Sites`], which merges equal points,
//! triangulates once with exact predicates and puts all edges into one order; **ties are broken there**, by one rule.
//!
//! Each algorithm is O(n log n). A result is a set of pairs of indices of the given points, ascending; among equal points
//! the first stands for all.
//!
//! ```
//! use feature_sampling::geometry::Point;
//! use lineart::reconstruct::{NnCrust, Reconstruction, Sites};
//!
//! let corners = [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| Point::new(x, y));
//! let sites = Sites::new(&corners)?;
//! assert_eq!(NnCrust::default().edges(&sites), [(0, 2), (0, 3), (1, 2), (1, 3)]);
//! # Ok::<(), lineart::reconstruct::SitesError>(())
//! ```

mod accord;
pub mod angle;
mod compatible_crust;
mod connect2d;
mod conservative_crust;
mod crawl;
mod crust;
mod disks;
mod hnn_crust;
mod insertion;
mod kd;
mod nn_crust;
mod peel;
mod sigdt;
mod sites;
mod solid;
mod union;
mod voronoi;

pub use accord::Accord;
pub use compatible_crust::{CompatibleCrust, Form};
pub use connect2d::Connect2d;
pub use conservative_crust::{ConservativeCrust, Separation, gabriel};
pub use crawl::Crawl;
pub use crust::Crust;
pub use hnn_crust::{Consent, HnnCrust};
pub use nn_crust::{NnCrust, Seekers};
pub use peel::{Peel, urquhart};
pub use sigdt::{Loops, Sigdt, influence};
pub use sites::{Edge, Face, OUTER, Sites, SitesError};
pub use voronoi::circumcentres;

/// Edges as pairs of site numbers; in any order, possibly repeated.
pub type Pairs = Vec<[u32; 2]>;

/// A rule that picks edges.
pub trait Reconstruction {
    /// The edges, as pairs of site numbers: in any order, either end first, perhaps several times. Never fails: for too
    /// few points there are no edges.
    fn pairs(&self, sites: &Sites) -> Pairs;

    /// The edges as pairs of indices of the points that were given: lower index first, sorted, each once.
    fn edges(&self, sites: &Sites) -> Vec<(usize, usize)> {
        let original = self.pairs(sites).into_iter().map(|pair| pair.map(|site| sites.original(site)));
        let mut edges: Vec<_> = original.map(|[a, b]| (a.min(b), a.max(b))).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }
}

/// An algorithm by name, with the parameters of the study; variants have names of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Algorithm {
    /// [`ConservativeCrust`] by disks.
    ConservativeCrust,
    /// [`CompatibleCrust`].
    CompatibleCrust,
    /// [`Connect2d`].
    Connect2d,
    /// [`Crawl`].
    Crawl,
    /// [`Crust`].
    Crust,
    /// [`HnnCrust`].
    HnnCrust,
    /// [`NnCrust`].
    NnCrust,
    /// [`Peel`].
    Peel,
    /// [`Sigdt`], one polygon.
    Sigdt,
    /// [`Accord`], ours.
    Accord,
    /// [`Accord`] without seeds, ours.
    AccordUnseeded,
    /// [`CompatibleCrust`] in its mutual form.
    CompatibleCrustMutual,
    /// [`ConservativeCrust`] by its own medial axis.
    ConservativeCrustMedial,
    /// [`HnnCrust`] with the choice of either end.
    HnnCrustEither,
    /// [`NnCrust`] as first described.
    NnCrustDegreeOne,
    /// [`Sigdt`], a polygon of each component.
    SigdtComponents,
}

impl Algorithm {
    /// The nine of the paper's study, in the order of its Table 3.
    pub const NINE: [Self; 9] = [
        Self::ConservativeCrust,
        Self::CompatibleCrust,
        Self::Connect2d,
        Self::Crawl,
        Self::Crust,
        Self::HnnCrust,
        Self::NnCrust,
        Self::Peel,
        Self::Sigdt,
    ];

    /// The nine and ours.
    pub const MAIN: [Self; 10] = [
        Self::ConservativeCrust,
        Self::CompatibleCrust,
        Self::Connect2d,
        Self::Crawl,
        Self::Crust,
        Self::HnnCrust,
        Self::NnCrust,
        Self::Peel,
        Self::Sigdt,
        Self::Accord,
    ];

    /// Everything that has a name.
    pub const ALL: [Self; 16] = [
        Self::ConservativeCrust,
        Self::CompatibleCrust,
        Self::Connect2d,
        Self::Crawl,
        Self::Crust,
        Self::HnnCrust,
        Self::NnCrust,
        Self::Peel,
        Self::Sigdt,
        Self::Accord,
        Self::AccordUnseeded,
        Self::CompatibleCrustMutual,
        Self::ConservativeCrustMedial,
        Self::HnnCrustEither,
        Self::NnCrustDegreeOne,
        Self::SigdtComponents,
    ];

    /// The name that commands and files use.
    pub const fn name(self) -> &'static str {
        match self {
            Self::ConservativeCrust => "conservative-crust",
            Self::CompatibleCrust => "compatible-crust",
            Self::Connect2d => "connect2d",
            Self::Crawl => "crawl",
            Self::Crust => "crust",
            Self::HnnCrust => "hnn-crust",
            Self::NnCrust => "nn-crust",
            Self::Peel => "peel",
            Self::Sigdt => "sigdt",
            Self::Accord => "accord",
            Self::AccordUnseeded => "accord-unseeded",
            Self::CompatibleCrustMutual => "compatible-crust-mutual",
            Self::ConservativeCrustMedial => "conservative-crust-medial",
            Self::HnnCrustEither => "hnn-crust-either",
            Self::NnCrustDegreeOne => "nn-crust-degree-one",
            Self::SigdtComponents => "sigdt-components",
        }
    }

    /// The algorithm of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|algorithm| algorithm.name() == name)
    }

    /// Below this ε its authors proved it to be correct on smooth closed curves without further conditions.
    pub const fn proved_epsilon(self) -> Option<f64> {
        match self {
            Self::Crust => Some(0.252),
            Self::NnCrust | Self::NnCrustDegreeOne => Some(1.0 / 3.0),
            Self::HnnCrust => Some(0.47),
            Self::CompatibleCrust | Self::CompatibleCrustMutual => Some(0.66),
            _ => None,
        }
    }

    /// The rule with its default parameters.
    pub fn rule(self) -> Box<dyn Reconstruction + Send + Sync> {
        match self {
            Self::ConservativeCrust => Box::new(ConservativeCrust::default()),
            Self::CompatibleCrust => Box::new(CompatibleCrust::default()),
            Self::Connect2d => Box::new(Connect2d),
            Self::Crawl => Box::new(Crawl),
            Self::Crust => Box::new(Crust),
            Self::HnnCrust => Box::new(HnnCrust::default()),
            Self::NnCrust => Box::new(NnCrust::default()),
            Self::Peel => Box::new(Peel),
            Self::Sigdt => Box::new(Sigdt::default()),
            Self::Accord => Box::new(Accord::default()),
            Self::AccordUnseeded => Box::new(Accord { seeded: false }),
            Self::CompatibleCrustMutual => Box::new(CompatibleCrust { form: Form::Mutual }),
            Self::ConservativeCrustMedial => Box::new(ConservativeCrust::MEDIAL),
            Self::HnnCrustEither => Box::new(HnnCrust { consent: Consent::Either, ..HnnCrust::default() }),
            Self::NnCrustDegreeOne => Box::new(NnCrust { seekers: Seekers::DegreeOne }),
            Self::SigdtComponents => Box::new(Sigdt { loops: Loops::Components }),
        }
    }

    /// The edges it picks.
    pub fn edges(self, sites: &Sites) -> Vec<(usize, usize)> {
        self.rule().edges(sites)
    }
}
