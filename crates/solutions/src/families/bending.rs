//! Family 1: a block bent to a sector of a tube.

use piola_fields::{Cartesian, Cylindrical};
use piola_numerics::{Dual, Real};
use piola_tensor::internal::rows::Rows;

use super::profile;
use super::{Family, check_constraint, isochoric_factor};
use crate::error::check_finite;
use crate::{ResponseFunctions, SolutionsError};

/// Family 1: bending, stretching and shearing of a rectangular block.
///
/// ```text
/// r = √(2 A X)      θ = B Y + C Z      z = D Y + E Z      A (B E − C D) = 1
/// F = [A/r  0  0;  0  r B  r C;  0  D  E]
/// T_rr' = (N_θθ − N_rr)/r,   N = g₁ B + g₋₁ B⁻¹        W(25.14–25.16)
/// ```
/// | constant | unit |
/// |---|---|
/// | A | m |
/// | B, C | rad/m |
/// | D, E | 1 |
///
/// # Example
/// See [`Family`].
///
/// # Source
/// W §25, family 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockBending {
    profile: profile::Cylindrical<f64>,
}

impl BlockBending {
    /// From A, B, C, D, E.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::ConstraintViolated`] with the A that satisfies the constraint.
    pub fn new([a, b, c, d, e]: [f64; 5]) -> Result<Self, SolutionsError> {
        check_finite("constants", &[a, b, c, d, e])?;
        let nearest = isochoric_factor([b, c, d, e])?;
        let terms = (a * (b * e - c * d), a.abs() * ((b * e).abs() + (c * d).abs()));
        check_constraint("family 1", "A (B E − C D) = 1", terms, ("A", nearest))?;
        Ok(Self { profile: profile::Cylindrical { a, offset: 0.0, block: [b, c, d, e], is_sector: false } })
    }

    /// From B, C, D, E: A follows.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] where no A is right.
    pub fn isochoric([b, c, d, e]: [f64; 4]) -> Result<Self, SolutionsError> {
        let a = isochoric_factor([b, c, d, e])?;
        Ok(Self { profile: profile::Cylindrical { a, offset: 0.0, block: [b, c, d, e], is_sector: false } })
    }

    /// A, B, C, D, E.
    #[must_use]
    pub fn constants(&self) -> [f64; 5] {
        let [b, c, d, e] = self.profile.block;
        [self.profile.a, b, c, d, e]
    }

    pub(crate) const fn profile(&self) -> &profile::Cylindrical<f64> {
        &self.profile
    }
}

impl profile::Cylindrical<f64> {
    /// The same over another scalar.
    pub(crate) fn over<T: Real>(&self) -> profile::Cylindrical<T> {
        profile::Cylindrical {
            a: T::lit(self.a),
            offset: T::lit(self.offset),
            block: self.block.map(T::lit),
            is_sector: self.is_sector,
        }
    }

    /// The place, in cylindrical coordinates.
    pub(crate) fn place<T: Real>(&self, [s, y, z]: [T; 3]) -> [T; 3] {
        let profile = self.over::<T>();
        let [b, c, d, e] = profile.block;
        [profile.radius(s), b * y + c * z, d * y + e * z]
    }

    pub(crate) fn check_domain(
        &self,
        reference: [f64; 3],
        (quantity, bound): (&'static str, &'static str),
    ) -> Result<(), SolutionsError> {
        check_finite("reference coordinates", &reference)?;
        let coordinate = reference[0];
        if self.is_sector && coordinate <= 0.0 {
            return Err(SolutionsError::OutsideDomain { quantity: "R", value: coordinate, bound: "0 < R", coordinate });
        }
        let value = self.radicand(coordinate);
        if 0.0 < value { Ok(()) } else { Err(SolutionsError::OutsideDomain { quantity, value, bound, coordinate }) }
    }

    pub(crate) fn rise_with_slope(
        &self,
        law: &impl ResponseFunctions,
        from: f64,
        to: f64,
    ) -> Result<(f64, [f64; 3]), SolutionsError> {
        let rise = self.over::<Dual<f64>>().rise(law, Dual::constant(from), Dual::variable(to))?;
        Ok((rise.value, [rise.tangent, 0.0, 0.0]))
    }
}

impl Family for BlockBending {
    type Reference = Cartesian;
    type Current = Cylindrical;

    fn place<T: Real>(&self, reference: [T; 3]) -> [T; 3] {
        self.profile.place(reference)
    }

    fn gradient<T: Real>(&self, [x, _, _]: [T; 3]) -> Rows<T> {
        self.profile.over::<T>().gradient(x)
    }

    fn check_domain(&self, reference: [f64; 3]) -> Result<(), SolutionsError> {
        self.profile.check_domain(reference, ("2 A X", "0 < 2 A X"))
    }

    fn rise(&self, law: &impl ResponseFunctions, from: [f64; 3], to: [f64; 3]) -> Result<f64, SolutionsError> {
        self.profile.rise(law, from[0], to[0])
    }

    fn rise_and_slope(
        &self,
        law: &impl ResponseFunctions,
        from: [f64; 3],
        to: [f64; 3],
    ) -> Result<(f64, [f64; 3]), SolutionsError> {
        self.profile.rise_with_slope(law, from[0], to[0])
    }
}
