//! Family 2: a sector of a tube straightened to a block.

use piola_fields::{Cartesian, Cylindrical};
use piola_numerics::Real;
use piola_tensor::internal::rows::Rows;

use super::{Family, check_constraint, isochoric_factor};
use crate::error::check_finite;
use crate::{ResponseFunctions, SolutionsError};

/// Family 2: straightening, stretching and shearing of a sector of a tube.
///
/// ```text
/// x = ½ A R²      y = B Θ + C Z      z = D Θ + E Z      A (B E − C D) = 1
/// F = [A R  0  0;  0  B/R  C;  0  D/R  E]
/// T_xx = constant        W(25.11–25.13)
/// ```
/// | constant | unit |
/// |---|---|
/// | A | 1/m |
/// | B, D | m/rad |
/// | C, E | 1 |
///
/// # Example
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::families::{Datum, Family, SectorStraightening};
/// let straight = SectorStraightening::new([0.5, 2.0, 0.0, 0.0, 1.0])?; // x = ¼ R², y = 2 Θ
/// let at = [4.0, 0.0, 0.0];
/// assert_eq!(straight.place(at), [4.0, 0.0, 0.0]);
/// let stress = straight.stress(&NeoHookean::new(1.0)?, &Datum::free_at(at), at)?;
/// assert_eq!(stress.cauchy.0.components[1], 0.25 - 4.0); // (B/R)² − (A R)²
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W §25, family 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectorStraightening {
    a: f64,
    block: [f64; 4],
}

impl SectorStraightening {
    /// From A, B, C, D, E.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::ConstraintViolated`] with the A that satisfies the constraint.
    pub fn new([a, b, c, d, e]: [f64; 5]) -> Result<Self, SolutionsError> {
        check_finite("constants", &[a, b, c, d, e])?;
        let nearest = isochoric_factor([b, c, d, e])?;
        let terms = (a * (b * e - c * d), a.abs() * ((b * e).abs() + (c * d).abs()));
        check_constraint("family 2", "A (B E − C D) = 1", terms, ("A", nearest))?;
        Ok(Self { a, block: [b, c, d, e] })
    }

    /// From B, C, D, E: A follows.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] where no A is right.
    pub fn isochoric(block: [f64; 4]) -> Result<Self, SolutionsError> {
        Ok(Self { a: isochoric_factor(block)?, block })
    }

    /// A, B, C, D, E.
    #[must_use]
    pub fn constants(&self) -> [f64; 5] {
        let [b, c, d, e] = self.block;
        [self.a, b, c, d, e]
    }
}

impl Family for SectorStraightening {
    type Reference = Cylindrical;
    type Current = Cartesian;

    fn place<T: Real>(&self, [r, theta, z]: [T; 3]) -> [T; 3] {
        let [b, c, d, e] = self.block.map(T::lit);
        [T::lit(0.5 * self.a) * r * r, b * theta + c * z, d * theta + e * z]
    }

    fn gradient<T: Real>(&self, [r, _, _]: [T; 3]) -> Rows<T> {
        let [b, c, d, e] = self.block.map(T::lit);
        let zero = T::zero();
        [[T::lit(self.a) * r, zero, zero], [zero, b / r, c], [zero, d / r, e]]
    }

    fn check_domain(&self, reference: [f64; 3]) -> Result<(), SolutionsError> {
        check_finite("reference coordinates", &reference)?;
        let value = reference[0];
        let outside = SolutionsError::OutsideDomain { quantity: "R", value, bound: "0 < R", coordinate: value };
        if 0.0 < value { Ok(()) } else { Err(outside) }
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
