//! Isotropic laws W(I₁, I₂, J): the stress and both tangents once, for all of them.
//!
//! ```text
//! P = s F⁻ᵀ + (2 w₁ + 4 w₂)(F − F⁻ᵀ) + 2 w₂ F ((I₁ − 3) 1 − (C − 1))
//! s = 2 w₁ + 4 w₂ + J w_J        wₐ = ∂W/∂Iₐ,  w_J = ∂W/∂J
//! ```
//! It is 2 w₁ F + 2 w₂ F (I₁ 1 − C) + J w_J F⁻ᵀ, ordered so that each term is as small as the strain: at the reference
//! every one vanishes, if the law's *residual* s does. A law gives s without cancellation, from I₁ − 3, I₂ − 3 and J − 1.

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::strain::{invariants, kernels};
use piola_continuum::tensor::FourthOrder;
use piola_continuum::tensor::rows::{Rows, difference, double_contraction, product, scaled, sum, transpose};
use piola_continuum::{Deformation, FirstPiola, KirchhoffStress, SecondPiola, Symmetric};
use piola_numerics::linear::matrix3::{determinant, from_rows};
use piola_numerics::{Mask, Real};

use crate::ConstitutiveError;
use crate::elementary::excess_over_logarithm;

/// I₁ − 3, I₂ − 3, J − 1 and J of a deformation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Invariants<T> {
    /// I₁ − 3 of C.
    pub first: T,
    /// I₂ − 3 of C; zero where the law does not use it.
    pub second: T,
    /// J − 1.
    pub change: T,
    /// J.
    pub jacobian: T,
}

/// First derivatives of W(I₁, I₂, J).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slopes<T> {
    /// ∂W/∂I₁, Pa.
    pub first: T,
    /// ∂W/∂I₂, Pa.
    pub second: T,
    /// s = 2 ∂W/∂I₁ + 4 ∂W/∂I₂ + J ∂W/∂J, Pa, without cancellation: what a stress-free law has none of at the reference.
    pub residual: T,
}

/// Second derivatives of W(I₁, I₂, J).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvatures<T> {
    /// ∂²W/∂I₁².
    pub first_first: T,
    /// ∂²W/∂I₁∂I₂.
    pub first_second: T,
    /// ∂²W/∂I₂².
    pub second_second: T,
    /// ∂²W/∂I₁∂J.
    pub first_volume: T,
    /// ∂²W/∂I₂∂J.
    pub second_volume: T,
    /// ∂²W/∂J².
    pub volume_volume: T,
}

impl<T: Real> Curvatures<T> {
    /// Those of a law whose only curvature is that of the volume.
    #[inline(always)]
    #[must_use]
    pub fn of_volume(volume_volume: T) -> Self {
        let o = T::zero();
        Self {
            first_first: o,
            first_second: o,
            second_second: o,
            first_volume: o,
            second_volume: o,
            volume_volume,
        }
    }
}

/// An isotropic energy W(I₁, I₂, J) with its derivatives in closed form.
pub trait InvariantEnergy {
    /// Whether W depends on I₂; what that needs is compiled out otherwise.
    const SECOND: bool;
    /// Whether another second derivative than ∂²W/∂J² is not zero.
    const CURVED: bool;

    /// W less W of the reference, J/m³, without cancellation: see [`first_excess`] and [`second_excess`].
    #[must_use]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T;

    /// W of the reference as the formula is printed, J/m³.
    #[must_use]
    fn reference_energy(&self) -> f64 {
        0.0
    }

    /// Refuses deformations at which the law has no answer.
    ///
    /// # Errors
    /// [`ConstitutiveError::BeyondLimit`]; most laws have no limit.
    #[inline(always)]
    fn check<T: Real>(&self, _deformation: &impl Deformation<T>) -> Result<(), ConstitutiveError> {
        Ok(())
    }

    /// Its first derivatives.
    #[must_use]
    fn slopes<T: Real>(&self, invariants: &Invariants<T>) -> Slopes<T>;

    /// Its second derivatives.
    #[must_use]
    fn curvatures<T: Real>(&self, invariants: &Invariants<T>) -> Curvatures<T>;
}

/// Strains with components up to this size take the forms in which everything is as small as the strain.
const SMALL: f64 = 0.25;

/// The invariants that a law uses.
#[inline(always)]
#[must_use]
pub fn invariants_of<T: Real, L: InvariantEnergy>(_law: &L, deformation: &impl Deformation<T>) -> Invariants<T> {
    Invariants {
        first: invariants::first_minus_three(deformation),
        second: if L::SECOND { invariants::second_minus_three(deformation) } else { T::zero() },
        change: deformation.volume_change(),
        jacobian: deformation.jacobian(),
    }
}

/// I₁ − 3 − 2 ln J, never negative and of second order in the strain, without cancellation.
///
/// ```text
/// I₁ − 3 − 2 (J − 1) = H : H − 2 i₂(H) − 2 det H,   H = ∇u
/// ```
#[inline(always)]
#[must_use]
pub fn first_excess<T: Real>(deformation: &impl Deformation<T>) -> T {
    let h = deformation.displacement_rows();
    let two = T::lit(2.0);
    double_contraction(h, h) - two * beyond_trace(h) + two * excess_over_logarithm(deformation.volume_change())
}

/// I₂ − 3 − 4 ln J, never negative and of second order in the strain, without cancellation.
///
/// ```text
/// I₂ − 3 − 4 (J − 1) = 2 H : H + i₂(G) − 4 i₂(H) − 4 det H,   G = C − 1,  H = ∇u
/// ```
#[inline(always)]
#[must_use]
pub fn second_excess<T: Real>(deformation: &impl Deformation<T>) -> T {
    let h = deformation.displacement_rows();
    let (two, four) = (T::lit(2.0), T::lit(4.0));
    let [a, b, c, d, e, f] = kernels::right_cauchy_green_minus_one(h).components;
    let second = (a * b - d * d) + (b * c - e * e) + (a * c - f * f);
    two * double_contraction(h, h) + second - four * beyond_trace(h)
        + four * excess_over_logarithm(deformation.volume_change())
}

/// i₂(H) + det H = det(1 + H) − 1 − tr H.
#[inline(always)]
fn beyond_trace<T: Real>(h: Rows<T>) -> T {
    let minor = |i: usize, j: usize| h[i][i] * h[j][j] - h[i][j] * h[j][i];
    (minor(0, 1) + minor(1, 2) + minor(0, 2)) + determinant(h)
}

/// P, see the [module](self).
///
/// # Accuracy
/// A few ulp of its own norm × the condition number of F.
#[inline(always)]
#[must_use]
pub fn first_piola<T: Real, L: InvariantEnergy>(law: &L, deformation: &impl Deformation<T>) -> FirstPiola<T> {
    let invariants = invariants_of(law, deformation);
    let slopes = law.slopes(&invariants);
    let inverse_transpose = scaled(deformation.cofactor_rows(), invariants.jacobian.recip());
    FirstPiola(from_rows(first_piola_rows::<T, L>(&slopes, &invariants, inverse_transpose, deformation)))
}

#[inline(always)]
fn first_piola_rows<T: Real, L: InvariantEnergy>(
    slopes: &Slopes<T>,
    invariants: &Invariants<T>,
    inverse_transpose: Rows<T>,
    deformation: &impl Deformation<T>,
) -> Rows<T> {
    let (two, four) = (T::lit(2.0), T::lit(4.0));
    let f = deformation.gradient_rows();
    let change = kernels::right_cauchy_green_minus_one(deformation.displacement_rows());
    // F − F⁻ᵀ = F⁻ᵀ (C − 1) where that is small.
    let small = largest_modulus(&change).at_most(T::lit(SMALL));
    let plain = difference(f, inverse_transpose);
    let beyond = if small.any() {
        let exact = product(inverse_transpose, change.rows());
        if small.all() { exact } else { select(small, exact, plain) }
    } else {
        plain
    };
    let stiffness = if L::SECOND { two * slopes.first + four * slopes.second } else { two * slopes.first };
    let stress = sum(scaled(inverse_transpose, slopes.residual), scaled(beyond, stiffness));
    if !L::SECOND {
        return stress;
    }
    let inner = (Symmetric::identity() * invariants.first - change) * (two * slopes.second);
    sum(stress, product(f, inner.rows()))
}

#[inline(always)]
fn largest_modulus<T: Real>(a: &Symmetric<T>) -> T {
    let [a, b, c, d, e, f] = a.components.map(T::abs);
    let larger = |a: T, b: T| T::select(a.less_than(b), b, a);
    larger(larger(larger(a, b), larger(c, d)), larger(e, f))
}

#[inline(always)]
fn select<T: Real>(mask: T::Mask, a: Rows<T>, b: Rows<T>) -> Rows<T> {
    let entry = |i: usize, j: usize| T::select(mask, a[i][j], b[i][j]);
    let row = |i: usize| [entry(i, 0), entry(i, 1), entry(i, 2)];
    [row(0), row(1), row(2)]
}

/// τ = s 1 + (2 w₁ + 4 w₂)(B − 1) + 2 w₂ B ((I₁ − 3) 1 − (B − 1)).
#[inline(always)]
#[must_use]
pub fn kirchhoff<T: Real, L: InvariantEnergy>(law: &L, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
    let invariants = invariants_of(law, deformation);
    let slopes = law.slopes(&invariants);
    let (two, four) = (T::lit(2.0), T::lit(4.0));
    let change = kernels::left_cauchy_green_minus_one(deformation.displacement_rows());
    let stiffness = if L::SECOND { two * slopes.first + four * slopes.second } else { two * slopes.first };
    let stress = Symmetric::identity() * slopes.residual + change * stiffness;
    if !L::SECOND {
        return KirchhoffStress(stress);
    }
    // B (i 1 − G) = (1 + G)(i 1 − G) = i 1 + (i − 1) G − G².
    let square = Symmetric::upper_triangle(product(change.rows(), change.rows()));
    let i = invariants.first;
    let inner = Symmetric::identity() * i + change * (i - T::one()) - square;
    KirchhoffStress(stress + inner * (two * slopes.second))
}

/// S = s C⁻¹ + (2 w₁ + 4 w₂)(1 − C⁻¹) + 2 w₂ ((I₁ − 3) 1 − (C − 1)).
#[inline(always)]
#[must_use]
pub fn second_piola<T: Real, L: InvariantEnergy>(law: &L, deformation: &impl Deformation<T>) -> SecondPiola<T> {
    let invariants = invariants_of(law, deformation);
    let slopes = law.slopes(&invariants);
    let (two, four) = (T::lit(2.0), T::lit(4.0));
    let inverse = scaled(transpose(deformation.cofactor_rows()), invariants.jacobian.recip());
    let inverse_square = Symmetric::upper_triangle(product(inverse, transpose(inverse)));
    let change = kernels::right_cauchy_green_minus_one(deformation.displacement_rows());
    // 1 − C⁻¹ = C⁻¹ (C − 1) where that is small.
    let small = largest_modulus(&change).at_most(T::lit(SMALL));
    let plain = Symmetric::identity() - inverse_square;
    let beyond = if small.any() {
        let exact = Symmetric::upper_triangle(product(inverse_square.rows(), change.rows()));
        let choose = |k: usize| T::select(small, exact.components[k], plain.components[k]);
        Symmetric { components: [choose(0), choose(1), choose(2), choose(3), choose(4), choose(5)] }
    } else {
        plain
    };
    let stiffness = if L::SECOND { two * slopes.first + four * slopes.second } else { two * slopes.first };
    let stress = inverse_square * slopes.residual + beyond * stiffness;
    if !L::SECOND {
        return SecondPiola(stress);
    }
    SecondPiola(stress + (Symmetric::identity() * invariants.first - change) * (two * slopes.second))
}

/// ∂P/∂F, 45 entries and their mirror images.
///
/// ```text
/// A = w₁ ∂²I₁ + w₂ ∂²I₂ + w_J ∂²J + Σ wₐᵦ ∂Iₐ ⊗ ∂Iᵦ
/// ∂I₁ = 2F        ∂I₂ = 2 (I₁ F − F C)        ∂J = Cof F        ∂²I₁ = 2 δᵢⱼ δ_AB        ∂²J = εᵢⱼₖ ε_ABC F_kC
/// ∂²I₂ = 2 (I₁ δᵢⱼ δ_AB + 2 F_iA F_jB − δᵢⱼ C_AB − F_iB F_jA − Bᵢⱼ δ_AB)
/// ```
#[inline(always)]
#[must_use]
pub fn first_piola_tangent<T: Real, L: InvariantEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> FirstPiolaTangent<T> {
    let invariants = invariants_of(law, deformation);
    let slopes = law.slopes(&invariants);
    let cofactor = deformation.cofactor_rows();
    tangent(law, &slopes, &invariants, cofactor, deformation)
}

/// (P, ∂P/∂F), the invariants, slopes and Cof F computed once.
#[inline(always)]
#[must_use]
pub fn first_piola_and_tangent<T: Real, L: InvariantEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
    let invariants = invariants_of(law, deformation);
    let slopes = law.slopes(&invariants);
    let cofactor = deformation.cofactor_rows();
    let inverse_transpose = scaled(cofactor, invariants.jacobian.recip());
    let stress = first_piola_rows::<T, L>(&slopes, &invariants, inverse_transpose, deformation);
    (FirstPiola(from_rows(stress)), tangent(law, &slopes, &invariants, cofactor, deformation))
}

#[inline(always)]
fn tangent<T: Real, L: InvariantEnergy>(
    law: &L,
    slopes: &Slopes<T>,
    invariants: &Invariants<T>,
    cofactor: Rows<T>,
    deformation: &impl Deformation<T>,
) -> FirstPiolaTangent<T> {
    let (two, four) = (T::lit(2.0), T::lit(4.0));
    let f = deformation.gradient_rows();
    let curvatures = law.curvatures(invariants);
    let volume =
        (slopes.residual - (two * slopes.first + four * slopes.second)) * invariants.jacobian.recip();
    let mut a = [[T::zero(); 9]; 9];

    // w_J ∂²J, first: a block for each pair of rows.
    let mut block = |i: usize, j: usize, row: [T; 3]| {
        let v = [row[0] * volume, row[1] * volume, row[2] * volume];
        for (p, q, r) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            a[3 * i + p][3 * j + q] = v[r];
            a[3 * i + q][3 * j + p] = -v[r];
        }
    };
    block(0, 1, f[2]);
    block(1, 2, f[0]);
    block(0, 2, [-f[1][0], -f[1][1], -f[1][2]]);

    // Curvatures: Σ wₐᵦ ∂Iₐ ⊗ ∂Iᵦ as v ⊗ Cof F + u ⊗ F + g ⊗ FC.
    let right = kernels::right_cauchy_green(f);
    let fc = if L::SECOND { product(f, right.rows()) } else { f };
    let trace = invariants.first + T::lit(3.0);
    let mut diagonal = two * slopes.first;
    if L::SECOND {
        diagonal += two * slopes.second * trace;
    }
    let left = if L::SECOND { kernels::left_cauchy_green(f) } else { right };
    let (c, b) = (right.rows(), left.rows());
    let w = two * slopes.second;
    for r in 0..9 {
        for s in r..9 {
            let (i, p, j, q) = (r / 3, r % 3, s / 3, s % 3);
            let mut entry = a[r][s] + curvatures.volume_volume * (cofactor[i][p] * cofactor[j][q]);
            if i == j && p == q {
                entry += diagonal;
            }
            if L::SECOND {
                let mut second = two * (f[i][p] * f[j][q]) - f[i][q] * f[j][p];
                if i == j {
                    second -= c[p][q];
                }
                if p == q {
                    second -= b[i][j];
                }
                entry += w * second;
            }
            if L::CURVED {
                let (x, y) = (two * f[i][p], two * f[j][q]);
                entry += curvatures.first_first * (x * y);
                let (k, l) = (cofactor[i][p], cofactor[j][q]);
                entry += curvatures.first_volume * (x * l + k * y);
                if L::SECOND {
                    let g = two * (trace * f[i][p] - fc[i][p]);
                    let h = two * (trace * f[j][q] - fc[j][q]);
                    entry += curvatures.second_second * (g * h)
                        + curvatures.first_second * (x * h + g * y)
                        + curvatures.second_volume * (g * l + k * h);
                }
            }
            a[r][s] = entry;
            a[s][r] = entry;
        }
    }
    FirstPiolaTangent(FourthOrder { components: a })
}

/// Writes [`Hyperelastic`](super::Hyperelastic) for a law of invariants, the parameters of a generic one in brackets first.
macro_rules! hyperelastic_of_invariants {
    ([$($generics:tt)*] $law:ty) => {
        impl<$($generics)*> $crate::solids::Hyperelastic for $law {
            #[inline(always)]
            fn energy<T: piola_numerics::Real>(&self, deformation: &impl piola_continuum::Deformation<T>) -> T {
                $crate::solids::invariant::InvariantEnergy::energy(self, deformation)
            }
            fn reference_energy(&self) -> f64 {
                $crate::solids::invariant::InvariantEnergy::reference_energy(self)
            }
            #[inline(always)]
            fn check<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> Result<(), $crate::ConstitutiveError> {
                $crate::solids::invariant::InvariantEnergy::check(self, deformation)
            }
            #[inline(always)]
            fn first_piola<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> piola_continuum::FirstPiola<T> {
                $crate::solids::invariant::first_piola(self, deformation)
            }
            #[inline(always)]
            fn second_piola<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> piola_continuum::SecondPiola<T> {
                $crate::solids::invariant::second_piola(self, deformation)
            }
            #[inline(always)]
            fn kirchhoff<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> piola_continuum::KirchhoffStress<T> {
                $crate::solids::invariant::kirchhoff(self, deformation)
            }
            #[inline(always)]
            fn first_piola_tangent<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> piola_continuum::stress::tangents::FirstPiolaTangent<T> {
                $crate::solids::invariant::first_piola_tangent(self, deformation)
            }
            #[inline(always)]
            fn first_piola_and_tangent<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> (piola_continuum::FirstPiola<T>, piola_continuum::stress::tangents::FirstPiolaTangent<T>) {
                $crate::solids::invariant::first_piola_and_tangent(self, deformation)
            }
        }
    };
    ($law:ty) => {
        $crate::solids::invariant::hyperelastic_of_invariants!([] $law);
    };
}
pub(super) use hyperelastic_of_invariants;
