//! Family 0: homogeneous isochoric deformations.

use nalgebra::Matrix3;
use piola_fields::Cartesian;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{determinant, rows_of};
use piola_tensor::internal::rows::{Rows, apply};

use super::{Family, check_constraint};
use crate::error::{check_bound, check_finite};
use crate::{ResponseFunctions, SolutionsError};

/// Family 0: x = F X + c with det F = 1. Stress and pressure are the same everywhere.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::families::{Datum, Family, IsochoricDeformation};
/// let shear = Matrix3::new(1.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
/// let shear = IsochoricDeformation::new(shear, [0.0; 3])?;
/// let stress = shear.stress(&NeoHookean::new(2.0)?, &Datum::free_at([0.0; 3]), [1.0, 2.0, 3.0])?;
/// assert_eq!(stress.cauchy.0.components[3], 1.0); // μ k
/// assert_eq!(stress.pressure, 2.5); // μ (1 + k²): T₁₁ = 0
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W §25.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IsochoricDeformation {
    gradient: Rows<f64>,
    translation: [f64; 3],
}

impl IsochoricDeformation {
    /// From F, by rows, and c, m.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::ConstraintViolated`] with the factor that makes F isochoric.
    pub fn new(gradient: Matrix3<f64>, translation: [f64; 3]) -> Result<Self, SolutionsError> {
        let rows = rows_of(&gradient);
        check_finite("F", rows.as_flattened())?;
        check_finite("c", &translation)?;
        let jacobian = determinant(rows);
        check_bound("det F", jacobian, "0 < det F", 0.0 < jacobian)?;
        let size = rows.map(|row| row.into_iter().map(f64::abs).sum::<f64>());
        let scale = (jacobian, size[0] * size[1] * size[2]);
        check_constraint("family 0", "det F = 1", scale, ("a factor of F", jacobian.cbrt().recip()))?;
        Ok(Self { gradient: rows, translation })
    }
}

impl Family for IsochoricDeformation {
    type Reference = Cartesian;
    type Current = Cartesian;

    fn place<T: Real>(&self, reference: [T; 3]) -> [T; 3] {
        let x = apply(self.gradient.map(|row| row.map(T::lit)), reference);
        core::array::from_fn(|i| x[i] + T::lit(self.translation[i]))
    }

    fn gradient<T: Real>(&self, _reference: [T; 3]) -> Rows<T> {
        self.gradient.map(|row| row.map(T::lit))
    }

    fn check_domain(&self, reference: [f64; 3]) -> Result<(), SolutionsError> {
        check_finite("X", &reference)
    }

    fn rise(&self, _law: &impl ResponseFunctions, _from: [f64; 3], _to: [f64; 3]) -> Result<f64, SolutionsError> {
        Ok(0.0)
    }

    fn rise_and_slope(
        &self,
        _law: &impl ResponseFunctions,
        _from: [f64; 3],
        _to: [f64; 3],
    ) -> Result<(f64, [f64; 3]), SolutionsError> {
        Ok((0.0, [0.0; 3]))
    }
}
