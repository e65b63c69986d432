//! Prony series of relaxation.

use piola_numerics::Real;

use crate::SolidsError;
use crate::error::check_bound;

const SERIES: &str = "Prony series";

/// A term gₖ exp(−t/τₖ).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct PronyTerm {
    /// gₖ, the share of the overstress; 0 ≤ gₖ.
    pub weight: f64,
    /// τₖ, s; 0 < τₖ.
    pub time: f64,
}

/// g(t) = Σ gₖ exp(−t/τₖ): how an overstress relaxes.
///
/// # Example
/// ```
/// use piola_solids::memory::{Prony, PronyTerm};
/// let series = Prony::new(vec![PronyTerm { weight: 0.5, time: 2.0 }])?;
/// assert_eq!(series.relaxation(0.0), 0.5);
/// assert_eq!(series.storage(0.5), 0.25); // ω τ = 1: storage and loss are equal
/// assert_eq!(series.loss(0.5), 0.25);
/// # Ok::<(), piola_solids::SolidsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Vec<PronyTerm>", into = "Vec<PronyTerm>"))]
pub struct Prony {
    terms: Vec<PronyTerm>,
}

impl Prony {
    /// From its terms, in any order; none at all is a solid without memory.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn new(terms: Vec<PronyTerm>) -> Result<Self, SolidsError> {
        for term in &terms {
            check_bound(SERIES, "weight", term.weight, "0 ≤ weight", 0.0 <= term.weight)?;
            check_bound(SERIES, "time", term.time, "0 < time", 0.0 < term.time)?;
        }
        Ok(Self { terms })
    }

    /// The terms.
    #[must_use]
    pub fn terms(&self) -> &[PronyTerm] {
        &self.terms
    }

    /// Σ gₖ.
    #[must_use]
    pub fn sum(&self) -> f64 {
        self.terms.iter().map(|term| term.weight).sum()
    }

    /// g(t).
    #[must_use]
    pub fn relaxation(&self, time: f64) -> f64 {
        self.terms.iter().map(|term| term.weight * (-time / term.time).exp()).sum()
    }

    /// g′(ω) = Σ gₖ ω² τₖ²/(1 + ω² τₖ²) of an oscillation: the part in phase with the strain.
    #[must_use]
    pub fn storage(&self, angular_frequency: f64) -> f64 {
        self.oscillation(angular_frequency, |x| {
            if 1.0 < x { 1.0 / (1.0 + x.recip() * x.recip()) } else { x * x / (1.0 + x * x) }
        })
    }

    /// g″(ω) = Σ gₖ ω τₖ/(1 + ω² τₖ²) of an oscillation: the part in phase with the rate of strain.
    #[must_use]
    pub fn loss(&self, angular_frequency: f64) -> f64 {
        self.oscillation(angular_frequency, |x| 1.0 / (x + x.recip()))
    }

    fn oscillation(&self, angular_frequency: f64, share: impl Fn(f64) -> f64) -> f64 {
        self.terms.iter().map(|term| term.weight * share(angular_frequency * term.time)).sum()
    }

    /// The factors of a step of time, for all points that take it.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`] and [`SolidsError::OutOfBounds`] unless 0 ≤ Δt.
    pub fn step(&self, duration: f64) -> Result<PronyStep, SolidsError> {
        let mut step = PronyStep { factors: Vec::with_capacity(self.terms.len()) };
        self.step_into(duration, &mut step)?;
        Ok(step)
    }

    /// As [`step`](Self::step), in the memory of another step.
    ///
    /// # Errors
    /// As [`step`](Self::step); the step is then unchanged.
    pub fn step_into(&self, duration: f64, step: &mut PronyStep) -> Result<(), SolidsError> {
        check_bound(SERIES, "Δt", duration, "0 ≤ Δt", 0.0 <= duration)?;
        step.factors.clear();
        step.factors.extend(self.terms.iter().map(|term| factors(term, duration)));
        Ok(())
    }
}

impl TryFrom<Vec<PronyTerm>> for Prony {
    type Error = SolidsError;

    fn try_from(terms: Vec<PronyTerm>) -> Result<Self, SolidsError> {
        Self::new(terms)
    }
}

impl From<Prony> for Vec<PronyTerm> {
    fn from(series: Prony) -> Self {
        series.terms
    }
}

/// The update of each term over a step Δt: hₖ ← exp(−Δt/τₖ) hₖ + φ(Δt/τₖ) ΔS with φ(x) = (1 − e⁻ˣ)/x.
///
/// # Accuracy
/// 2 ulp each, for Δt/τ from 0 to ∞.
#[derive(Clone, Debug, PartialEq)]
pub struct PronyStep {
    factors: Vec<Factors>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Factors {
    pub(super) weight: f64,
    pub(super) decay: f64,
    pub(super) share: f64,
}

impl PronyStep {
    pub(super) fn factors(&self) -> &[Factors] {
        &self.factors
    }

    /// exp(−Δt/τₖ) of the k-th term.
    #[must_use]
    pub fn decay(&self, k: usize) -> Option<f64> {
        self.factors.get(k).map(|factors| factors.decay)
    }

    /// φ(Δt/τₖ) of the k-th term.
    #[must_use]
    pub fn share(&self, k: usize) -> Option<f64> {
        self.factors.get(k).map(|factors| factors.share)
    }

    /// Σ gₖ φ(Δt/τₖ): what the step adds to the tangent.
    pub(super) fn stiffness<T: Real>(&self) -> T {
        T::lit(self.factors.iter().map(|factors| factors.weight * factors.share).sum())
    }
}

fn factors(term: &PronyTerm, duration: f64) -> Factors {
    let x = duration / term.time;
    let share = if x <= 0.0 {
        1.0
    } else if x.is_finite() {
        -(-x).exp_m1() / x
    } else {
        0.0
    };
    Factors { weight: term.weight, decay: (-x).exp(), share }
}
