//! The trait of laws with internal variables.

use piola_numerics::Real;
use piola_solids::SolidsError;
use piola_tensor::internal::rows::Rows;

/// A solid whose stress depends on the deformation and on S internal variables, which evolve.
///
/// ```text
/// P = P(F, z)        r(zₙ, F, x, Δt) = 0  for the X unknowns x of a step        zₙ₊₁ = z(zₙ, F, x)
/// ```
/// A law states its stress, the equations of one implicit step and the state that follows from their unknowns, each as one function
/// over any scalar. [`InelasticPoint`](crate::InelasticPoint) solves the equations by Newton's method with exact derivatives, estimates the
/// error, divides the increment where it must, and returns the stress with its consistent tangent.
///
/// Unknowns and residuals are without unit and of the size of a strain.
///
/// # Example
/// A Maxwell element in the volume: J = Jₑ Jᵢ, p = κ ln Jₑ, and the logarithm of Jᵢ creeps as p/η.
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_inelastic::{StepControl, Evolution, InelasticPoint};
/// use piola_numerics::Real;
/// use piola_numerics::linear::matrix3::{adjugate, determinant};
///
/// struct Creeping { kappa: f64, eta: f64 }
///
/// impl Evolution<1, 1> for Creeping {
///     fn initial(&self) -> [f64; 1] {
///         [0.0] // ln Jᵢ
///     }
///     fn residual<T: Real>(&self, from: &[T; 1], f: &[[T; 3]; 3], x: &[T; 1], dt: f64) -> [T; 1] {
///         let pressure = T::lit(self.kappa) * (determinant(*f).ln() - from[0] - x[0]);
///         [x[0] - T::lit(dt / self.eta) * pressure]
///     }
///     fn updated<T: Real>(&self, from: &[T; 1], _f: &[[T; 3]; 3], x: &[T; 1], _dt: f64) -> [T; 1] {
///         [from[0] + x[0]]
///     }
///     fn first_piola<T: Real>(&self, f: &[[T; 3]; 3], state: &[T; 1]) -> [[T; 3]; 3] {
///         let j = determinant(*f);
///         let scale = T::lit(self.kappa) * (j.ln() - state[0]) / j;
///         let adjugate = adjugate(*f); // P = p F⁻ᵀ
///         [0, 1, 2].map(|i| [0, 1, 2].map(|k: usize| scale * adjugate[k][i]))
///     }
/// }
///
/// let law = Creeping { kappa: 2.0, eta: 1.0 };
/// let mut point = InelasticPoint::new(&law);
/// let grown = DeformationGradient::dilatation(1.1)?;
/// point.advance(&grown, 1e-9, &StepControl::default())?; // at once: p = κ ln J
/// let relaxed = point.advance(&grown, 0.5, &StepControl::default())?;
/// let pressure = relaxed.first_piola.0[(0, 0)] * 1.1;
/// assert!((pressure - 2.0 * 1.1_f64.powi(3).ln() * (-1.0_f64).exp()).abs() < 1e-8); // e^(−κ t/η)
/// # Ok::<(), piola_inelastic::InelasticError>(())
/// ```
pub trait Evolution<const S: usize, const X: usize> {
    /// The internal variables of the body as it was made.
    #[must_use]
    fn initial(&self) -> [f64; S];

    /// False where the state does not change in the step, as below a yield stress. The unknowns are then zero and
    /// [`updated`](Self::updated) must return `from`: integration with a tolerance skips such a stretch of an increment.
    #[must_use]
    fn evolves(&self, _from: &[f64; S], _gradient: &Rows<f64>, _dt: f64) -> bool {
        true
    }

    /// r: the equations of an implicit step from the state `from` to the deformation F in the time `dt`, s.
    #[must_use]
    fn residual<T: Real>(&self, from: &[T; S], gradient: &Rows<T>, unknowns: &[T; X], dt: f64) -> [T; X];

    /// The state at the end of the step.
    #[must_use]
    fn updated<T: Real>(&self, from: &[T; S], gradient: &Rows<T>, unknowns: &[T; X], dt: f64) -> [T; S];

    /// P by rows, Pa, of F and the state at the same time.
    #[must_use]
    fn first_piola<T: Real>(&self, gradient: &Rows<T>, state: &[T; S]) -> Rows<T>;

    /// Coordinates of a state about another, zero for the same: differences unless another is chosen. States of several step widths are
    /// extrapolated in them.
    #[must_use]
    fn coordinates<T: Real>(&self, about: &[T; S], state: &[T; S]) -> [T; S] {
        let mut coordinates = *state;
        for (x, y) in coordinates.iter_mut().zip(about) {
            *x -= *y;
        }
        coordinates
    }

    /// The state of such [`coordinates`](Self::coordinates).
    #[must_use]
    fn at_coordinates<T: Real>(&self, about: &[T; S], coordinates: &[T; S]) -> [T; S] {
        let mut state = *about;
        for (x, y) in state.iter_mut().zip(coordinates) {
            *x += *y;
        }
        state
    }

    /// Work that a step dissipates per reference volume, J/m³: at least zero.
    #[must_use]
    fn dissipated(&self, _from: &[f64; S], _gradient: &Rows<f64>, _state: &[f64; S]) -> f64 {
        0.0
    }

    /// Refuses deformations at which an elastic law of the solid has no answer.
    ///
    /// # Errors
    /// Those of the laws.
    fn check(&self, _gradient: &Rows<f64>, _state: &[f64; S]) -> Result<(), SolidsError> {
        Ok(())
    }
}
