//! S and τ of a law of invariants without P.

use piola_continuum::internal::strain as kernels;
use piola_continuum::{Deformation, KirchhoffStress, SecondPiola, Symmetric};
use piola_numerics::{Mask, Real};
use piola_tensor::internal::rows::{double_contraction, product, scaled, transpose};

use super::energy::{InvariantEnergy, Invariants, Slopes, invariants_of};
use super::kinematics::{SMALL, largest_modulus, select_symmetric};

impl<T: Real> Invariants<T> {
    /// With I₁ and I₂ from F itself where `beside` does not hold.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn whole<L: InvariantEnergy>(self, beside: T::Mask, deformation: &impl Deformation<T>) -> Self {
        let f = deformation.gradient_rows();
        let k = deformation.cofactor_rows();
        let second = if L::SECOND { double_contraction(k, k) } else { self.second_whole };
        Self {
            first_whole: T::select(beside, self.first_whole, double_contraction(f, f)),
            second_whole: T::select(beside, self.second_whole, second),
            ..self
        }
    }
}

/// τ = s 1 + (2 w₁ + 4 w₂)(B − 1) + 2 w₂ B ((I₁ − 3) 1 − (B − 1)); at large strain τ = J ∂W/∂J 1 + 2 w₁ B + 2 w₂ (I₁ B − B²).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn kirchhoff<T: Real, L: InvariantEnergy>(law: &L, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
    let change = kernels::left_cauchy_green_minus_one(deformation.displacement_rows());
    let small = largest_modulus(&change).at_most(T::lit(SMALL));
    let mut invariants = invariants_of(law, deformation);
    if !small.all() {
        invariants = invariants.whole::<L>(small, deformation);
    }
    let slopes = law.slopes(&invariants);
    let beside = beside_kirchhoff::<T, L>(&slopes, &invariants, &change);
    if small.all() {
        return KirchhoffStress(beside);
    }
    let (two, left) = (T::lit(2.0), kernels::left_cauchy_green(deformation.gradient_rows()));
    let mut plain = Symmetric::identity() * slopes.volume + left * (two * slopes.first);
    if L::SECOND {
        plain += (left * invariants.first_whole - left.square()) * (two * slopes.second);
    }
    KirchhoffStress(select_symmetric(small, &beside, &plain))
}

/// τ beside the reference.
#[cfg_attr(not(debug_assertions), inline(always))]
fn beside_kirchhoff<T: Real, L: InvariantEnergy>(
    slopes: &Slopes<T>,
    invariants: &Invariants<T>,
    change: &Symmetric<T>,
) -> Symmetric<T> {
    let (two, four, change) = (T::lit(2.0), T::lit(4.0), *change);
    let stiffness = if L::SECOND { two * slopes.first + four * slopes.second } else { two * slopes.first };
    let stress = Symmetric::identity() * slopes.residual + change * stiffness;
    if !L::SECOND {
        return stress;
    }
    // B (i 1 − G) = (1 + G)(i 1 − G) = i 1 + (i − 1) G − G².
    let square = Symmetric::upper_triangle(product(change.rows(), change.rows()));
    let i = invariants.first;
    let inner = Symmetric::identity() * i + change * (i - T::one()) - square;
    stress + inner * (two * slopes.second)
}

/// S = s C⁻¹ + (2 w₁ + 4 w₂)(1 − C⁻¹) + 2 w₂ ((I₁ − 3) 1 − (C − 1)); at large strain S = J ∂W/∂J C⁻¹ + 2 w₁ 1 + 2 w₂ (I₁ 1 − C).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn second_piola<T: Real, L: InvariantEnergy>(law: &L, deformation: &impl Deformation<T>) -> SecondPiola<T> {
    let (two, four) = (T::lit(2.0), T::lit(4.0));
    let change = kernels::right_cauchy_green_minus_one(deformation.displacement_rows());
    let small = largest_modulus(&change).at_most(T::lit(SMALL));
    let mut invariants = invariants_of(law, deformation);
    if !small.all() {
        invariants = invariants.whole::<L>(small, deformation);
    }
    let slopes = law.slopes(&invariants);
    let inverse = scaled(transpose(deformation.cofactor_rows()), invariants.jacobian.recip());
    let inverse_square = Symmetric::upper_triangle(product(inverse, transpose(inverse)));
    // 1 − C⁻¹ = C⁻¹ (C − 1).
    let beyond = Symmetric::upper_triangle(product(inverse_square.rows(), change.rows()));
    let stiffness = if L::SECOND { two * slopes.first + four * slopes.second } else { two * slopes.first };
    let mut beside = inverse_square * slopes.residual + beyond * stiffness;
    if L::SECOND {
        beside += (Symmetric::identity() * invariants.first - change) * (two * slopes.second);
    }
    if small.all() {
        return SecondPiola(beside);
    }
    let mut plain = inverse_square * slopes.volume;
    let mut uniform = two * slopes.first;
    if L::SECOND {
        uniform += two * slopes.second * invariants.first_whole;
        plain -= kernels::right_cauchy_green(deformation.gradient_rows()) * (two * slopes.second);
    }
    SecondPiola(select_symmetric(small, &beside, &(plain + Symmetric::identity() * uniform)))
}
