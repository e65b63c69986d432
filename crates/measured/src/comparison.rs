//! Models fitted to the same data, and the best of them: laws of solids in [`fitting`](crate::fitting), fluids in
//! [`rheology`](crate::rheology).

use core::cell::{Cell, RefCell};
use core::fmt::Display;
use core::ops::ControlFlow;

/// The judgement of a fit: what a [`Comparison`] ranks it by.
pub trait Judged {
    /// Akaike's criterion, corrected for few data; `None` without three data more than parameters.
    fn aicc(&self) -> Option<f64>;
    /// Whether the search converged.
    fn is_converged(&self) -> bool;
    /// What correlated residuals widen intervals by: criteria count as many numbers less as its square.
    fn widening(&self) -> f64 {
        1.0
    }
}

/// A model with its fit.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Candidate<M, F, E> {
    /// The model.
    pub model: M,
    /// Its fit, or why there is none.
    pub fit: Result<F, E>,
}

/// Models fitted to the same data, in the order of asking.
///
/// # Example
/// ```
/// use piola_measured::fitting::{Measurements, Request, compare};
/// let text = "mode,stretch,stress\nuniaxial,1.5,1.6\nuniaxial,2.0,3.5\nuniaxial,3.0,8.1\nuniaxial,4.0,13.9\n";
/// let measurements = Measurements::parse("rubber.csv", text)?;
/// let laws = vec!["neo-hookean".parse()?, "mooney-rivlin".parse()?];
/// let comparison = compare(&measurements, &Request::of(laws))?;
/// assert!(comparison.is_complete() && comparison.fits().count() == 2);
/// assert!(comparison.best().is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Comparison<M, F, E> {
    /// The models.
    pub candidates: Vec<Candidate<M, F, E>>,
    /// Models that are fitted for other ends than to describe the material, such as regularisations: they are not ranked.
    pub unranked: Vec<M>,
    /// Whether the caller stopped it before all models were fitted.
    pub interrupted: bool,
}

/// Is told the finished part of the work, and may end it.
pub type Watch<'w> = &'w mut dyn FnMut(f64) -> ControlFlow<()>;

impl<M: Copy + PartialEq, F: Judged, E> Comparison<M, F, E> {
    /// Fits each model until `watch` breaks.
    pub(crate) fn of(
        models: &[M],
        watch: Watch<'_>,
        mut fit: impl FnMut(M, &dyn Fn() -> bool) -> Result<F, E>,
    ) -> Self {
        let mut candidates = Vec::new();
        let watch = RefCell::new(watch);
        let broken = Cell::new(false);
        for (index, &model) in models.iter().enumerate() {
            let done = index as f64 / models.len() as f64;
            let stop = || {
                if !broken.get() {
                    broken.set((*watch.borrow_mut())(done).is_break());
                }
                broken.get()
            };
            if stop() {
                break;
            }
            candidates.push(Candidate { model, fit: fit(model, &stop) });
        }
        Self { candidates, unranked: Vec::new(), interrupted: broken.get() }
    }

    /// The models with a fit.
    pub fn fits(&self) -> impl Iterator<Item = (M, &F)> {
        self.candidates.iter().filter_map(|candidate| Some((candidate.model, candidate.fit.as_ref().ok()?)))
    }

    /// The models without a fit, and why.
    pub fn refusals(&self) -> impl Iterator<Item = (M, &E)> {
        self.candidates.iter().filter_map(|candidate| Some((candidate.model, candidate.fit.as_ref().err()?)))
    }

    /// The refusals as sentences that begin with the name of the model, once: a library's begin with its own spelling of it.
    #[must_use]
    pub fn refusals_in_words(&self) -> Vec<String>
    where
        M: Display,
        E: Display,
    {
        let sentence = |(model, refusal): (M, &E)| {
            let (model, refusal) = (model.to_string(), refusal.to_string());
            match refusal.split_once(": ") {
                Some((name, rest)) if name.to_lowercase().replace(' ', "-") == model => format!("{model}: {rest}"),
                _ => format!("{model}: {refusal}"),
            }
        };
        self.refusals().map(sentence).collect()
    }

    /// The fit with the least `AICc` of those that are ranked; `None` where no fit has one.
    #[must_use]
    pub fn best(&self) -> Option<(M, &F)> {
        let ranked = self.fits().filter(|(model, _)| !self.unranked.contains(model));
        let judged = ranked.filter_map(|(model, fit)| Some((fit.aicc()?, (model, fit))));
        judged.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, best)| best)
    }

    /// The difference of `AICc` up to which models are not told apart: 2 for independent residuals of the best fit, as many times more as
    /// correlation makes them fewer.
    #[must_use]
    pub fn indifference(&self) -> Option<f64> {
        let (_, best) = self.best()?;
        Some(2.0 * best.widening() * best.widening())
    }

    /// The ranked models that are not told apart from the best one, itself left out.
    pub fn rivals(&self) -> impl Iterator<Item = (M, &F)> {
        let best = self.best().and_then(|(model, fit)| Some((model, fit.aicc()?)));
        let within = self.indifference();
        let is_near = move |model: M, fit: &F| {
            let ((best, least), within) = (best?, within?);
            Some(model != best && fit.aicc()? <= least + within)
        };
        let ranked = self.fits().filter(|(model, _)| !self.unranked.contains(model));
        ranked.filter(move |(model, fit)| is_near(*model, fit).unwrap_or(false))
    }

    /// Whether there is a best fit and its search converged, or, where no fit has a criterion, any did.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        let any = || self.fits().any(|(_, fit)| fit.is_converged());
        !self.interrupted && self.best().map_or_else(any, |(_, best)| best.is_converged())
    }

    /// Whether every model was fitted, and every search converged.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        !self.interrupted
            && self.candidates.iter().all(|candidate| candidate.fit.as_ref().is_ok_and(Judged::is_converged))
    }
}
