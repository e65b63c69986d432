//! The arguments of an energy of invariants.

use piola_numerics::Real;

/// The most families of fibres that an energy may have.
pub(super) const MOST_FAMILIES: usize = 2;

/// The arguments of an energy of invariants, each less its value at the reference, so that none has lost digits at small strain.
///
/// What is not asked for is not computed. In the table C = Fᵀ F, J = det F, Ī₁ = J^(−2/3) I₁, Ī₂ = J^(−4/3) I₂, and a is the direction of
/// a family of fibres.
///
/// | method | argument | order in the strain |
/// |---|---|---|
/// | `first`, `second` | I₁ − 3, I₂ − 3 | 1 |
/// | `first_excess`, `second_excess` | I₁ − 3 − 2 ln J, I₂ − 3 − 4 ln J | 2 |
/// | `isochoric_first`, `isochoric_second` | Ī₁ − 3, Ī₂ − 3 | 2 |
/// | `volume_change`, `ln_jacobian` | J − 1, ln J | 1 |
/// | `volume_excess` | J − 1 − ln J | 2 |
/// | `jacobian` | J | |
/// | `fourth(k)`, `fifth(k)` | I₄ − 1 = a · C a − 1, I₅ − 1 = a · C² a − 1 of family k | 1 |
/// | `isochoric_fourth(k)` | J^(−2/3) I₄ − 1 of family k | 1 |
///
/// An energy whose terms are of second order keeps all digits of a small stress. So does one with terms of first order whose
/// coefficients cancel to the last bit: ½ μ (I₁ − 3) − μ ln J does.
///
/// The argument of a family that the energy does not have is NaN.
pub trait Excesses<T: Real> {
    /// I₁ − 3.
    #[must_use]
    fn first(&self) -> T;
    /// I₂ − 3.
    #[must_use]
    fn second(&self) -> T;
    /// I₁ − 3 − 2 ln J.
    #[must_use]
    fn first_excess(&self) -> T;
    /// I₂ − 3 − 4 ln J.
    #[must_use]
    fn second_excess(&self) -> T;
    /// J^(−2/3) I₁ − 3.
    #[must_use]
    fn isochoric_first(&self) -> T;
    /// J^(−4/3) I₂ − 3.
    #[must_use]
    fn isochoric_second(&self) -> T;
    /// J − 1.
    #[must_use]
    fn volume_change(&self) -> T;
    /// J.
    #[must_use]
    fn jacobian(&self) -> T;
    /// ln J.
    #[must_use]
    fn ln_jacobian(&self) -> T;
    /// J − 1 − ln J.
    #[must_use]
    fn volume_excess(&self) -> T;
    /// I₄ − 1 = a · C a − 1 of a family of fibres.
    #[must_use]
    fn fourth(&self, family: usize) -> T;
    /// I₅ − 1 = a · C² a − 1 of a family of fibres.
    #[must_use]
    fn fifth(&self, family: usize) -> T;
    /// J^(−2/3) I₄ − 1 of a family of fibres.
    #[must_use]
    fn isochoric_fourth(&self, family: usize) -> T;
}
