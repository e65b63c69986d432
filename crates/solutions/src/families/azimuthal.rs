//! Family 5: a sector of a tube sheared azimuthally.

use piola_fields::Cylindrical;
use piola_numerics::{Gradient, Real};
use piola_tensor::internal::rows::Rows;

use super::{Family, check_constraint};
use crate::error::{check_bound, check_finite};
use crate::{LocalDeformation, ResponseFunctions, SolutionsError};

/// Family 5: inflation, bending, extension and azimuthal shearing of a sector of a tube.
///
/// ```text
/// r = A R      θ = B ln R + C Θ      z = D Z      A² C D = 1
/// F = [A  0  0;  A B  A C  0;  0  0  D]
/// T_rr(r, θ) = T_rr(r₀, θ₀) + (N_θθ − N_rr) ln(r/r₀) − 2 N_rθ (θ − θ₀)        W(25.17–25.19)
/// ```
/// B, B⁻¹ and N are the same everywhere; the pressure is not, and it grows with θ: a whole tube cannot be so deformed.
///
/// | constant | unit |
/// |---|---|
/// | A, C, D | 1 |
/// | B | rad |
///
/// # Example
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::families::{AzimuthalShearing, Datum, Family};
/// let shearing = AzimuthalShearing::new([1.0, 0.5, 1.0, 1.0])?;
/// let at = [2.0, 0.0, 0.0];
/// let stress = shearing.stress(&NeoHookean::new(2.0)?, &Datum::free_at(at), at)?;
/// assert_eq!(stress.cauchy.0.components[3], 1.0); // μ A² B
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W §25, family 5; M. Singh and A. C. Pipkin, Z. angew. Math. Phys. 16 (1965) 706.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AzimuthalShearing {
    constants: [f64; 4],
}

impl AzimuthalShearing {
    /// From A, B, C, D.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] unless 0 < A; [`SolutionsError::ConstraintViolated`] with
    /// the D that satisfies the constraint.
    pub fn new([a, b, c, d]: [f64; 4]) -> Result<Self, SolutionsError> {
        check_finite("constants", &[a, b, c, d])?;
        check_bound("A", a, "0 < A", 0.0 < a)?;
        check_bound("C", c, "C ≠ 0", 0.0 < c.abs())?;
        let value = a * a * c * d;
        check_constraint("family 5", "A² C D = 1", (value, value.abs()), ("D", (a * a * c).recip()))?;
        Ok(Self { constants: [a, b, c, d] })
    }

    /// From A, B, C: D follows.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] unless 0 < A and C ≠ 0.
    pub fn isochoric([a, b, c]: [f64; 3]) -> Result<Self, SolutionsError> {
        Self::new([a, b, c, (a * a * c).recip()])
    }

    /// A, B, C, D.
    #[must_use]
    pub const fn constants(&self) -> [f64; 4] {
        self.constants
    }

    /// `(N_θθ − N_rr) ln(R/R₀) − 2 N_rθ (θ − θ₀)`.
    fn rise_over<T: Real>(
        &self,
        law: &impl ResponseFunctions,
        from: [f64; 3],
        to: [T; 3],
    ) -> Result<T, SolutionsError> {
        let extra = LocalDeformation::of(self.gradient(from)).checked_stress(law)?.components;
        let turn = self.place(to)[1] - T::lit(self.place(from)[1]);
        Ok(T::lit(extra[1] - extra[0]) * (to[0] / T::lit(from[0])).ln() - T::lit(2.0 * extra[3]) * turn)
    }
}

impl Family for AzimuthalShearing {
    type Reference = Cylindrical;
    type Current = Cylindrical;

    fn place<T: Real>(&self, [r, theta, z]: [T; 3]) -> [T; 3] {
        let [a, b, c, d] = self.constants.map(T::lit);
        [a * r, b * r.ln() + c * theta, d * z]
    }

    fn gradient<T: Real>(&self, _reference: [T; 3]) -> Rows<T> {
        let [a, b, c, d] = self.constants.map(T::lit);
        let zero = T::zero();
        [[a, zero, zero], [a * b, a * c, zero], [zero, zero, d]]
    }

    fn check_domain(&self, reference: [f64; 3]) -> Result<(), SolutionsError> {
        check_finite("reference coordinates", &reference)?;
        let value = reference[0];
        let outside = SolutionsError::OutsideDomain { quantity: "R", value, bound: "0 < R", coordinate: value };
        if 0.0 < value { Ok(()) } else { Err(outside) }
    }

    fn rise(&self, law: &impl ResponseFunctions, from: [f64; 3], to: [f64; 3]) -> Result<f64, SolutionsError> {
        self.rise_over(law, from, to)
    }

    fn rise_and_slope(
        &self,
        law: &impl ResponseFunctions,
        from: [f64; 3],
        to: [f64; 3],
    ) -> Result<(f64, [f64; 3]), SolutionsError> {
        let at: [Gradient<f64, 3>; 3] = core::array::from_fn(|i| Gradient::variable(to[i], i));
        let rise = self.rise_over(law, from, at)?;
        Ok((rise.value, rise.partials))
    }
}
