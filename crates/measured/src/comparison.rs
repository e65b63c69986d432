//! Models fitted to the same data, and the best of them: laws of solids in [`fitting`](crate::fitting), fluids in
//! [`rheology`](crate::rheology).

/// The judgement of a fit: what a [`Comparison`] ranks it by.
pub trait Judged {
    /// Akaike's criterion, corrected for few data; `None` without three data more than parameters.
    fn aicc(&self) -> Option<f64>;
    /// Whether the search converged.
    fn is_converged(&self) -> bool;
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
}

impl<M: Copy, F: Judged, E> Comparison<M, F, E> {
    /// Fits each model.
    pub(crate) fn of(models: &[M], fit: impl Fn(M) -> Result<F, E>) -> Self {
        Self { candidates: models.iter().map(|&model| Candidate { model, fit: fit(model) }).collect() }
    }

    /// The models with a fit.
    pub fn fits(&self) -> impl Iterator<Item = (M, &F)> {
        self.candidates.iter().filter_map(|candidate| Some((candidate.model, candidate.fit.as_ref().ok()?)))
    }

    /// The models without a fit, and why.
    pub fn refusals(&self) -> impl Iterator<Item = (M, &E)> {
        self.candidates.iter().filter_map(|candidate| Some((candidate.model, candidate.fit.as_ref().err()?)))
    }

    /// The fit with the least `AICc`; `None` where no fit has one.
    #[must_use]
    pub fn best(&self) -> Option<(M, &F)> {
        let judged = self.fits().filter_map(|(model, fit)| Some((fit.aicc()?, (model, fit))));
        judged.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, best)| best)
    }

    /// Whether every model was fitted, and every search converged.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.candidates.iter().all(|candidate| candidate.fit.as_ref().is_ok_and(Judged::is_converged))
    }
}
