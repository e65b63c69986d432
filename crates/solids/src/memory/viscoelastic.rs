//! Finite linear viscoelasticity.

use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, SecondPiola, Symmetric};
use piola_numerics::Real;

use super::prony::Factors;
use super::{Prony, PronyStep, Scaled};
use crate::Hyperelastic;
use crate::SolidsError;
use crate::error::{check_bound, check_finite};

/// A solid whose overstress relaxes: finite linear viscoelasticity.
///
/// ```text
/// S(t) = S_E(C) + Σ gₖ hₖ        ḣₖ + hₖ/τₖ = Ṡ_D        hₖ(t) = ∫ exp(−(t − s)/τₖ) dS_D(C(s))/ds ds
/// step Δt:  hₖ ← exp(−Δt/τₖ) hₖ + φ(Δt/τₖ) (S_D − S_D before),   φ(x) = (1 − e⁻ˣ)/x
/// ∂S/∂E = ∂S_E/∂E + Σ gₖ φ(Δt/τₖ) ∂S_D/∂E
/// ```
/// | symbol | what | unit |
/// |---|---|---|
/// | `S_E` | the stress at rest, of the law `equilibrium` | Pa |
/// | `S_D` | the stress that relaxes, of the law `overstress`: isochoric, if volumes do not relax | Pa |
/// | gₖ, τₖ | of the [`Prony`] series | –, s |
/// | `S_E` + Σ gₖ `S_D` | the stress of fast loading | Pa |
///
/// Everything is told in components of the reference: the response is frame-indifferent for any overstress.
///
/// # Accuracy
/// The update is exact where `S_D` is linear in time during the step (a step of zero duration is a jump); otherwise its error
/// is of second order in Δt. No step is too long or short: Δt/τ from 0 to ∞.
///
/// # Example
/// A strain applied at once and held: the stress relaxes from 1.5 μ k to μ k.
/// ```
/// use piola_solids::memory::{Prony, PronyTerm, Viscoelastic};
/// use piola_solids::MooneyRivlin;
/// use piola_continuum::DeformationGradient;
/// let rubber = MooneyRivlin::stress_free(0.5, 0.0, 1.0)?; // μ = 1
/// let series = Prony::new(vec![PronyTerm { weight: 0.5, time: 2.0 }])?;
/// let solid = Viscoelastic::new(rubber, rubber, series);
/// let (mut state, shear) = (solid.at_rest(), DeformationGradient::simple_shear(0.5)?);
/// solid.advance(&mut state, &shear, &solid.prony().step(0.0)?);
/// let stress = |duration: f64| solid.prony().step(duration).map(|step| {
///     solid.cauchy(&state, &shear, &step).0.components[3]
/// });
/// assert_eq!(stress(0.0)?, 0.75);
/// assert!((stress(2.0)? - 0.5 * (1.0 + 0.5 * (-1.0_f64).exp())).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(18.1), W(18.11); J. C. Simo, *On a fully three-dimensional finite-strain viscoelastic damage model*, Comput. Methods
/// Appl. Mech. Eng. 60 (1987).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Viscoelastic<E, D> {
    equilibrium: E,
    overstress: D,
    prony: Prony,
}

impl<E: Hyperelastic, D: Hyperelastic> Viscoelastic<E, D> {
    /// Of the law at rest, the law of the overstress, and its relaxation.
    #[must_use]
    pub const fn new(equilibrium: E, overstress: D, prony: Prony) -> Self {
        Self { equilibrium, overstress, prony }
    }
}

impl<L: Hyperelastic + Clone> Viscoelastic<Scaled<L>, L> {
    /// Of the law of fast loading, of which Σ gₖ relaxes: S = (1 − Σ gₖ) `S_L` + Σ gₖ hₖ.
    ///
    /// # Errors
    /// [`SolidsError::OutOfBounds`] unless Σ gₖ ≤ 1.
    pub fn relaxing(law: L, prony: Prony) -> Result<Self, SolidsError> {
        let sum = prony.sum();
        check_bound("Prony series", "sum of weights", sum, "sum ≤ 1", sum <= 1.0)?;
        Ok(Self { equilibrium: Scaled::new(law.clone(), 1.0 - sum)?, overstress: law, prony })
    }
}

/// The memory of a viscoelastic solid.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        deny_unknown_fields,
        bound(serialize = "Symmetric<T>: serde::Serialize", deserialize = "Symmetric<T>: serde::Deserialize<'de>")
    )
)]
pub struct ViscoelasticState<T: Real = f64> {
    /// `S_D` of the last step, Pa.
    driving: Symmetric<T>,
    /// hₖ, Pa.
    overstresses: Vec<Symmetric<T>>,
}

impl<T: Real> ViscoelasticState<T> {
    /// `S_D` of the last step, Pa.
    #[must_use]
    pub const fn driving(&self) -> &Symmetric<T> {
        &self.driving
    }

    /// hₖ, Pa, without the weights.
    #[must_use]
    pub fn overstresses(&self) -> &[Symmetric<T>] {
        &self.overstresses
    }

    /// The same state over another scalar.
    #[must_use]
    pub fn lifted<S: Real>(&self, lift: impl Fn(T) -> S) -> ViscoelasticState<S> {
        let each = |a: &Symmetric<T>| Symmetric { components: a.components.map(&lift) };
        ViscoelasticState { driving: each(&self.driving), overstresses: self.overstresses.iter().map(each).collect() }
    }
}

impl<E: Hyperelastic, D: Hyperelastic> Viscoelastic<E, D> {
    /// The law at rest.
    #[must_use]
    pub const fn equilibrium(&self) -> &E {
        &self.equilibrium
    }

    /// The law of the overstress.
    #[must_use]
    pub const fn overstress(&self) -> &D {
        &self.overstress
    }

    /// The relaxation.
    #[must_use]
    pub const fn prony(&self) -> &Prony {
        &self.prony
    }

    /// The state of a body that has been undeformed for ever.
    #[must_use]
    pub fn at_rest<T: Real>(&self) -> ViscoelasticState<T> {
        let reference = self.overstress.reference_stress();
        ViscoelasticState {
            driving: Symmetric { components: reference.components.map(T::lit) },
            overstresses: vec![Symmetric::zero(); self.prony.terms().len()],
        }
    }

    /// Refuses deformations at which one of the laws has no answer.
    ///
    /// # Errors
    /// Those of the laws.
    pub fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        self.equilibrium.check(deformation)?;
        self.overstress.check(deformation)
    }

    /// Refuses a state that is not one of this solid, such as one that was read: it must have an overstress for each term of
    /// the series, all finite.
    ///
    /// # Errors
    /// [`SolidsError::OutOfBounds`], [`SolidsError::NotFinite`].
    pub fn check_state(&self, state: &ViscoelasticState) -> Result<(), SolidsError> {
        const STATE: &str = "viscoelastic state";
        let count = state.overstresses.len();
        let fits = count == self.prony.terms().len();
        check_bound(STATE, "number of overstresses", count as f64, "one for each term of the series", fits)?;
        let all = state.overstresses.iter().chain([&state.driving]);
        all.flat_map(|stress| stress.components).try_for_each(|x| check_finite(STATE, "a stress", x))
    }

    /// Refuses a step that is not one of this solid's series: it must have the factors of each of its terms.
    ///
    /// Evaluations trust the step as far as its number of terms: with a step of another number the answers are NaN.
    ///
    /// # Errors
    /// [`SolidsError::OutOfBounds`].
    pub fn check_step(&self, step: &PronyStep) -> Result<(), SolidsError> {
        const STEP: &str = "viscoelastic step";
        let count = step.factors().len() as f64;
        check_bound(STEP, "number of terms", count, "those of the series", self.fits(step))
    }

    /// True if a step has the terms of the series.
    fn fits(&self, step: &PronyStep) -> bool {
        step.factors().len() == self.prony.terms().len()
    }

    /// 1, or NaN where the terms of state, step and series are not as many.
    #[inline]
    fn counted<T: Real>(&self, state: &ViscoelasticState<T>, step: &PronyStep) -> T {
        if self.fits(step) && state.overstresses.len() == step.factors().len() { T::one() } else { T::lit(f64::NAN) }
    }

    /// S at the end of a step, the state being that of its beginning.
    #[inline]
    #[must_use]
    pub fn second_piola<T: Real>(
        &self,
        state: &ViscoelasticState<T>,
        deformation: &impl Deformation<T>,
        step: &PronyStep,
    ) -> SecondPiola<T> {
        let change = self.overstress.second_piola(deformation).0 - state.driving;
        let mut stress = self.equilibrium.second_piola(deformation).0;
        for (overstress, factors) in state.overstresses.iter().zip(step.factors()) {
            stress += advanced(overstress, &change, factors) * T::lit(factors.weight);
        }
        SecondPiola(stress * self.counted(state, step))
    }

    /// P at the end of a step.
    #[inline]
    #[must_use]
    pub fn first_piola<T: Real>(
        &self,
        state: &ViscoelasticState<T>,
        deformation: &impl Deformation<T>,
        step: &PronyStep,
    ) -> FirstPiola<T> {
        self.second_piola(state, deformation, step).first_piola(deformation)
    }

    /// T at the end of a step.
    #[inline]
    #[must_use]
    pub fn cauchy<T: Real>(
        &self,
        state: &ViscoelasticState<T>,
        deformation: &impl Deformation<T>,
        step: &PronyStep,
    ) -> CauchyStress<T> {
        self.second_piola(state, deformation, step).cauchy(deformation)
    }

    /// ∂S/∂E of the step: consistent with [`second_piola`](Self::second_piola); the state does not enter.
    #[inline]
    #[must_use]
    pub fn material_tangent<T: Real>(&self, deformation: &impl Deformation<T>, step: &PronyStep) -> MaterialTangent<T> {
        let equilibrium = self.equilibrium.material_tangent(deformation).0;
        let overstress = self.overstress.material_tangent(deformation).0;
        let counted = if self.fits(step) { T::one() } else { T::lit(f64::NAN) };
        MaterialTangent(equilibrium + overstress * (step.stiffness::<T>() * counted))
    }

    /// (P, ∂P/∂F) of the step.
    #[inline]
    #[must_use]
    pub fn first_piola_and_tangent<T: Real>(
        &self,
        state: &ViscoelasticState<T>,
        deformation: &impl Deformation<T>,
        step: &PronyStep,
    ) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
        let stress = self.second_piola(state, deformation, step);
        let tangent = self.material_tangent(deformation, step).first_piola(&stress, deformation);
        (stress.first_piola(deformation), tangent)
    }

    /// Takes the step: the state becomes that of its end. Nothing is allocated.
    #[inline]
    pub fn advance<T: Real>(
        &self,
        state: &mut ViscoelasticState<T>,
        deformation: &impl Deformation<T>,
        step: &PronyStep,
    ) {
        let driving = self.overstress.second_piola(deformation).0 * self.counted(state, step);
        let change = driving - state.driving;
        for (overstress, factors) in state.overstresses.iter_mut().zip(step.factors()) {
            *overstress = advanced(overstress, &change, factors);
        }
        state.driving = driving;
    }
}

/// exp(−Δt/τ) h + φ(Δt/τ) ΔS.
#[cfg_attr(not(debug_assertions), inline(always))]
fn advanced<T: Real>(overstress: &Symmetric<T>, change: &Symmetric<T>, factors: &Factors) -> Symmetric<T> {
    *overstress * T::lit(factors.decay) + *change * T::lit(factors.share)
}
