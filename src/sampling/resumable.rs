//! The sampler in calls of bounded work, for programs that must not wait: a motor controller's main loop.
//!
//! [`Resumable::step`] does at most `budget` *turns* and answers [`Step::Pending`], [`Step::Sample`] or [`Step::Done`].
//! A turn is the unit of work of [`super::step`]: at most one look-up of lfs (two where a bound from the last look-up turns
//! out too small, and one more for the sample that is handed out), at most the chord error of one piece of a cubic, and at
//! most eight evaluations of a cubic. A look-up visits each node of its index at most once. Finding the next corner of a path
//! compares at most as many joints as the path has, once a run. Where a run ends, once more as many evaluations of a cubic as
//! the scalar has digits may be needed, to keep d_min to the end. Nothing else depends on the job.
//!
//! The samples are those of [`sample_path`](super::sample_path) with [`SamplingOptions::even`] off, to the bit and in the
//! same order: both turn the same [`Search`]. What needs to see a whole run at once is refused
//! ([`SamplingError::NotResumable`]): even spreading and grading (several passes), ρ (nested bisections), and ε without a
//! d_min, since the floors that then hold march along the path.
//!
//! One sample is held back inside, because the last one before an end or a corner may have to keep d_min to it.

use super::run::{Pos, Run};
use super::sampler::{Leg, Legs};
use super::size::{Sizes, Stretches};
use super::spread::{LastKept, last_kept};
use super::step::{Caps, Next, Search};
use super::{Bound, Condition, Sample, SamplingError, SamplingOptions};
use crate::curve::Curve;
use crate::geometry::Point;
use crate::lfs::FeatureSize;
use crate::scalar::Scalar;

/// What a call did.
#[derive(Clone, Debug, PartialEq)]
pub enum Step<S> {
    /// The budget is used up; call again.
    Pending,
    /// The next sample.
    Sample(Sample<S>),
    /// There are no more samples.
    Done,
}

/// A sample that waits for the next one, or for the run's end.
#[derive(Clone, Debug)]
struct Held<S> {
    pos: Pos<S>,
    point: Point<S>,
    bound: Bound,
}

/// The samples of one path, one by one.
#[derive(Clone, Debug)]
pub struct Resumable<'a, S, F> {
    curve: &'a Curve<'a, S>,
    features: &'a F,
    options: &'a SamplingOptions<S>,
    path: u32,
    legs: Legs<'a, S>,
    run: Option<Run<'a, S>>,
    search: Option<Search<S>>,
    /// Where the sample before the held one lies.
    before: Pos<S>,
    held: Option<Held<S>>,
    /// Inner samples of the run.
    count: u32,
    looked: Option<(Point<S>, S)>,
}

impl<'a, S: Scalar, F: FeatureSize<S>> Resumable<'a, S, F> {
    /// Starts at a path of the curve; a path that does not exist has no samples.
    ///
    /// # Errors
    /// See [`SamplingError`]; [`SamplingError::NotResumable`] as the module says.
    pub fn new(
        curve: &'a Curve<'a, S>,
        features: &'a F,
        path: u32,
        options: &'a SamplingOptions<S>,
    ) -> Result<Self, SamplingError> {
        options.check()?;
        let bounded = match options.condition {
            Condition::Epsilon(_) => options.min_distance.is_some(),
            Condition::Rho(_) => false,
            Condition::Unbounded => true,
        };
        if !bounded || options.even || options.grading.is_some() {
            return Err(SamplingError::NotResumable);
        }
        Ok(Self {
            curve,
            features,
            options,
            path,
            legs: Legs::new(curve, path, &options.start),
            run: None,
            search: None,
            before: Pos { k: 0, t: S::zero() },
            held: None,
            count: 0,
            looked: None,
        })
    }

    /// Does at most `budget` turns (at least one); ends as soon as there is a sample.
    ///
    /// # Errors
    /// [`SamplingError::Limit`] where a run needs more samples than [`SamplingOptions::limit`]; the sampler is then done.
    #[inline(never)]
    pub fn step(&mut self, budget: u32) -> Result<Step<S>, SamplingError> {
        let Some(run) = self.run.clone() else {
            return Ok(match self.legs.next() {
                None => Step::Done,
                Some(Leg::Fixed(at, bound)) => match self.curve.point(&at) {
                    Some(point) => {
                        let lfs = self.features.lfs(&at, &point);
                        Step::Sample(Sample { path: self.path, at, point, lfs, bound })
                    }
                    None => Step::Pending,
                },
                Some(Leg::Run(run)) => {
                    self.search = Some(Search::new(&run, &run.start));
                    self.before = run.start.clone();
                    self.held = None;
                    self.count = 0;
                    self.looked = None;
                    self.run = Some(run);
                    Step::Pending
                }
            });
        };
        let stretches = Stretches::default();
        let sizes: Sizes<'_, S, F, true> = Sizes::new(&run, self.features, &[], self.options, &S::one(), &stretches);
        sizes.resume(self.looked.take());
        let caps =
            Caps { chord: self.options.chord_error.clone(), max: self.options.max_distance.clone(), graded: None };
        let mut next = None;
        if let Some(search) = &mut self.search {
            for _ in 0..budget.max(1) {
                next = search.turn(&run, &sizes, self.options, &caps);
                if next.is_some() {
                    break;
                }
            }
        }
        self.looked = sizes.looked();
        match next {
            None => Ok(Step::Pending),
            Some(next) if next.pos < run.end => self.hold(&run, next),
            Some(_) => {
                self.run = None;
                self.search = None;
                Ok(self.last(&run))
            }
        }
    }

    /// Holds a sample back and hands out the one that was held.
    fn hold(&mut self, run: &Run<'a, S>, next: Next<S>) -> Result<Step<S>, SamplingError> {
        self.count += 1;
        if self.count >= self.options.limit {
            self.run = None;
            self.legs = Legs::new(self.curve, u32::MAX, &S::zero());
            return Err(SamplingError::Limit(self.options.limit));
        }
        self.search = Some(Search::new(run, &next.pos));
        let held = Held { point: run.point(&next.pos), pos: next.pos, bound: next.bound };
        Ok(match self.held.replace(held) {
            None => Step::Pending,
            Some(done) => {
                self.before = done.pos.clone();
                self.sample(run, done)
            }
        })
    }

    /// The sample before the run's end.
    fn last(&mut self, run: &Run<'a, S>) -> Step<S> {
        let Some(held) = self.held.take() else { return Step::Pending };
        let Some(min) = &self.options.min_distance else { return self.sample(run, held) };
        match last_kept(run, min, &self.before, &held.pos) {
            LastKept::AsItIs => self.sample(run, held),
            LastKept::Moved(pos) => {
                let point = run.point(&pos);
                self.sample(run, Held { pos, point, bound: Bound::Min })
            }
            LastKept::Dropped => Step::Pending,
        }
    }

    fn sample(&self, run: &Run<'a, S>, held: Held<S>) -> Step<S> {
        let at = run.place(&held.pos);
        let lfs = self.features.lfs(&at, &held.point);
        Step::Sample(Sample { path: self.path, at, point: held.point, lfs, bound: held.bound })
    }
}
