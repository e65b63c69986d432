//! Incompressible isotropic laws by their response functions of B and B⁻¹.

use piola_numerics::Real;
use piola_solids::SolidsError;
use piola_solids::isochoric::Isochoric;
use piola_tensor::Symmetric;
use piola_tensor::internal::rows::{Rows, cofactor};

/// An incompressible isotropic elastic solid by its response functions.
///
/// ```text
/// T = −p 1 + g₁ B + g₋₁ B⁻¹        det B = 1        I = tr B,  II = tr B⁻¹        W(25.4)
/// g₁ = 2 ∂W/∂I        g₋₁ = −2 ∂W/∂II        with a stored energy W(I, II), J/m³        W(25.7)
/// ```
/// Every energy of [`piola_solids::isochoric`] is such a law. A law without a stored energy implements
/// [`response`](Self::response).
///
/// # Example
/// ```
/// use piola_numerics::Real;
/// use piola_solids::isochoric::MooneyRivlin;
/// use piola_solutions::ResponseFunctions;
/// let rubber = MooneyRivlin::new(0.5, 0.25)?;
/// assert_eq!(rubber.response(1.0, 1.0), [1.0, -0.5]);
/// /// Elastic, but no energy has these functions.
/// struct Mine;
/// impl ResponseFunctions for Mine {
///     fn response<T: Real>(&self, _first: T, second: T) -> [T; 2] {
///         [T::lit(1.0) + second, T::zero()]
///     }
/// }
/// assert_eq!(Mine.response(0.0, 2.0), [3.0, 0.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(25.4), W(25.7).
#[doc(alias("incompressible isotropic solid", "Rivlin"))]
pub trait ResponseFunctions {
    /// (g₁, g₋₁), Pa, at I − 3 and II − 3.
    #[must_use]
    fn response<T: Real>(&self, first: T, second: T) -> [T; 2];

    /// Refuses changes of shape beyond what the law can answer.
    ///
    /// # Errors
    /// [`SolidsError::BeyondLimit`]; most laws have no limit.
    fn check(&self, first: f64, second: f64) -> Result<(), SolidsError> {
        let _ = (first, second);
        Ok(())
    }
}

impl<I: Isochoric> ResponseFunctions for I {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn response<T: Real>(&self, first: T, second: T) -> [T; 2] {
        let [first, second] = self.slopes(first, second);
        [T::lit(2.0) * first, T::lit(-2.0) * second]
    }
    fn check(&self, first: f64, second: f64) -> Result<(), SolidsError> {
        Isochoric::check(self, first, second)
    }
}

/// An isochoric deformation at a particle: F, B, B⁻¹ and the invariants.
///
/// # Example
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::LocalDeformation;
/// let shear = LocalDeformation::of([[1.0, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
/// assert_eq!((shear.first_minus_three, shear.second_minus_three), (0.25, 0.25)); // k²
/// let extra = shear.extra_stress(&NeoHookean::new(2.0)?);
/// assert_eq!(extra.components[3], 1.0); // μ k
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalDeformation<T = f64> {
    /// F in physical components, by rows: the first index of the deformed body, the second of the reference.
    pub gradient: Rows<T>,
    /// B = F Fᵀ in physical components.
    pub left_cauchy_green: Symmetric<T>,
    /// B⁻¹.
    pub inverse: Symmetric<T>,
    /// I − 3 = tr B − 3.
    pub first_minus_three: T,
    /// II − 3 = tr B⁻¹ − 3.
    pub second_minus_three: T,
}

impl<T: Real> LocalDeformation<T> {
    /// Of F with det F = 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(gradient: Rows<T>) -> Self {
        let left_cauchy_green = Symmetric::gram(gradient);
        // F⁻ᵀ is the cofactor of an isochoric F.
        let inverse = Symmetric::gram(cofactor(gradient));
        let three = T::lit(3.0);
        Self {
            gradient,
            left_cauchy_green,
            inverse,
            first_minus_three: left_cauchy_green.trace() - three,
            second_minus_three: inverse.trace() - three,
        }
    }

    /// g₁ B + g₋₁ B⁻¹, Pa: T + p 1, W(25.4).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn extra_stress(&self, law: &(impl ResponseFunctions + ?Sized)) -> Symmetric<T> {
        let [direct, inverse] = law.response(self.first_minus_three, self.second_minus_three);
        self.left_cauchy_green * direct + self.inverse * inverse
    }

    /// [`extra_stress`](Self::extra_stress) of a law that accepts the deformation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn checked_stress(&self, law: &impl ResponseFunctions) -> Result<Symmetric<T>, SolidsError> {
        let [direct, inverse] = self.checked_response(law)?;
        Ok(self.left_cauchy_green * direct + self.inverse * inverse)
    }

    /// (g₁, g₋₁) of a law that accepts the deformation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn checked_response(&self, law: &impl ResponseFunctions) -> Result<[T; 2], SolidsError> {
        law.check(self.first_minus_three.primal(0), self.second_minus_three.primal(0))?;
        Ok(law.response(self.first_minus_three, self.second_minus_three))
    }
}
