//! Isotropic laws W(I₁, I₂, J): the stress and both tangents once, for all of them.
//!
//! ```text
//! P = s F⁻ᵀ + (2 w₁ + 4 w₂)(F − F⁻ᵀ) + 2 w₂ F ((I₁ − 3) 1 − (C − 1))
//! s = 2 w₁ + 4 w₂ + J w_J        wₐ = ∂W/∂Iₐ,  w_J = ∂W/∂J
//! ```
//! It is `2 w₁ F + 2 w₂ F (I₁ 1 − C) + J w_J F⁻ᵀ`, ordered so that each term is as small as the strain: at the reference
//! every one vanishes, if the law's *residual* s does. A law gives s without cancellation, from I₁ − 3, I₂ − 3 and J − 1.
//! At large strain the order is the printed one, with J ∂W/∂J from I₁, I₂ and J: where a body is compressed to nearly nothing
//! the differences from the reference would hide what is left.

use nalgebra::Matrix3;
use piola_continuum::internal::strain as kernels;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent};
use piola_continuum::{Deformation, FirstPiola, SecondPiola};
use piola_numerics::linear::matrix3::{determinant, from_rows};
use piola_numerics::{Dual, Real};
use piola_tensor::internal::rows::{Rows, double_contraction};

use crate::known_volume::KnownVolume;
use crate::packed;

mod energy;
pub(crate) mod kinematics;
mod measures;
pub(crate) mod straight;
pub(crate) mod tangent;

pub use energy::{Curvatures, InvariantEnergy, Invariants, Slopes, invariants_of};
use kinematics::InvariantKinematics;
pub use measures::{kirchhoff, second_piola};
use tangent::tangent;

/// J − 1 − ln J, never negative and of second order in the change of volume, without cancellation.
///
/// # Example
/// ```
/// use piola_solids::invariant::volume_excess;
/// use piola_continuum::DisplacementGradient;
/// let excess: f64 = volume_excess(&DisplacementGradient::from_rows([[1e-9, 0.0, 0.0], [0.0; 3], [0.0; 3]])?);
/// assert!((excess / 5e-19 - 1.0).abs() < 1e-8); // ½ (J − 1)²
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn volume_excess<T: Real>(deformation: &impl Deformation<T>) -> T {
    piola_numerics::internal::volume_excess(deformation.volume_change(), deformation.jacobian())
}

/// I₁ − 3 − 2 ln J, never negative and of second order in the strain, without cancellation.
///
/// ```text
/// I₁ − 3 − 2 (J − 1) = H : H − 2 i₂(H) − 2 det H,   H = ∇u
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_excess<T: Real>(deformation: &impl Deformation<T>) -> T {
    first_excess_beside(deformation, volume_excess(deformation))
}

/// [`first_excess`], J − 1 − ln J given: what several terms of an energy share.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_excess_beside<T: Real>(deformation: &impl Deformation<T>, volume_excess: T) -> T {
    let h = deformation.displacement_rows();
    let two = T::lit(2.0);
    double_contraction(h, h) - two * beyond_trace(h) + two * volume_excess
}

/// I₂ − 3 − 4 ln J, never negative and of second order in the strain, without cancellation.
///
/// ```text
/// I₂ − 3 − 4 (J − 1) = 2 H : H + i₂(G) − 4 i₂(H) − 4 det H,   G = C − 1,  H = ∇u
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn second_excess<T: Real>(deformation: &impl Deformation<T>) -> T {
    second_excess_beside(deformation, volume_excess(deformation))
}

/// [`second_excess`], J − 1 − ln J given.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn second_excess_beside<T: Real>(deformation: &impl Deformation<T>, volume_excess: T) -> T {
    let h = deformation.displacement_rows();
    let (two, four) = (T::lit(2.0), T::lit(4.0));
    let [a, b, c, d, e, f] = kernels::right_cauchy_green_minus_one(h).components;
    let second = (a * b - d * d) + (b * c - e * e) + (a * c - f * f);
    two * double_contraction(h, h) + second - four * beyond_trace(h) + four * volume_excess
}

/// i₂(H) + det H = det(1 + H) − 1 − tr H.
#[cfg_attr(not(debug_assertions), inline(always))]
fn beyond_trace<T: Real>(h: Rows<T>) -> T {
    let minor = |i: usize, j: usize| h[i][i] * h[j][j] - h[i][j] * h[j][i];
    (minor(0, 1) + minor(1, 2) + minor(0, 2)) + determinant(h)
}

/// P, see the [module](self).
///
/// # Accuracy
/// A few ulp of its own norm × the condition number of F.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_piola<T: Real, L: InvariantEnergy>(law: &L, deformation: &impl Deformation<T>) -> FirstPiola<T> {
    if L::STRAIGHT {
        return straight::first_piola(law, deformation);
    }
    let kinematics = InvariantKinematics::of_deformation::<L>(deformation);
    let slopes = law.slopes(&kinematics.invariants);
    FirstPiola(from_rows(kinematics.first_piola::<L>(&slopes)))
}

/// (∂P/∂F) : δF.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_piola_derivative<T: Real, L: InvariantEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
    direction: &Matrix3<T>,
) -> FirstPiola<T> {
    if L::STRAIGHT {
        return straight::first_piola_derivative(law, deformation, direction);
    }
    let varied = deformation.lifted(|i, j, x| Dual::new(x, direction[(i, j)]));
    FirstPiola(first_piola(law, &varied).0.map(|x| x.tangent))
}

/// (W, P), the change of volume computed once.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn energy_and_first_piola<T: Real, L: InvariantEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (T, FirstPiola<T>) {
    let known = KnownVolume::of(deformation);
    (law.energy(&known), first_piola(law, &known))
}

/// (W, P, ∂P/∂F), the change of volume computed once, and as [`first_piola_and_tangent`].
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn energy_first_piola_and_tangent<T: Real, L: InvariantEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
    let known = KnownVolume::of(deformation);
    let (stress, tangent) = first_piola_and_tangent(law, &known);
    (law.energy(&known), stress, tangent)
}

/// ∂P/∂F, 45 entries and their mirror images.
///
/// ```text
/// A = w₁ ∂²I₁ + w₂ ∂²I₂ + w_J ∂²J + Σ wₐᵦ ∂Iₐ ⊗ ∂Iᵦ
/// ∂I₁ = 2F        ∂I₂ = 2 (I₁ F − F C)        ∂J = Cof F        ∂²I₁ = 2 δᵢⱼ δ_AB        ∂²J = εᵢⱼₖ ε_ABC F_kC
/// ∂²I₂ = 2 (I₁ δᵢⱼ δ_AB + F_iA F_jB + εᵢⱼₖ ε_ABC Cof_kC − δᵢⱼ C_AB − Bᵢⱼ δ_AB)
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_piola_tangent<T: Real, L: InvariantEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> FirstPiolaTangent<T> {
    if L::STRAIGHT {
        return packed::both(straight::first_piola_and_upper_triangle(law, deformation)).1;
    }
    let kinematics = InvariantKinematics::of_deformation::<L>(deformation);
    let (slopes, curvatures) = law.slopes_and_curvatures(&kinematics.invariants);
    tangent::<T, L>(&slopes, &curvatures, &kinematics)
}

/// (P, ∂P/∂F), the invariants, slopes and Cof F computed once.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_piola_and_tangent<T: Real, L: InvariantEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
    if L::STRAIGHT {
        return packed::both(straight::first_piola_and_upper_triangle(law, deformation));
    }
    let kinematics = InvariantKinematics::of_deformation::<L>(deformation);
    let (slopes, curvatures) = law.slopes_and_curvatures(&kinematics.invariants);
    let stress = FirstPiola(from_rows(kinematics.first_piola::<L>(&slopes)));
    (stress, tangent::<T, L>(&slopes, &curvatures, &kinematics))
}

/// P and the 45 entries of ∂P/∂F on and above its diagonal:
/// [`Hyperelastic::first_piola_and_upper_triangle`](super::Hyperelastic::first_piola_and_upper_triangle).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_piola_and_upper_triangle<T: Real, L: InvariantEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> [T; 54] {
    if L::STRAIGHT {
        straight::first_piola_and_upper_triangle(law, deformation)
    } else {
        packed::of_pair(first_piola_and_tangent(law, deformation))
    }
}

/// (S, ∂S/∂E), from P and ∂P/∂F.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn second_piola_and_tangent<T: Real, L: InvariantEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (SecondPiola<T>, MaterialTangent<T>) {
    let (first_piola, tangent) = first_piola_and_tangent(law, deformation);
    let stress = first_piola.second_piola(deformation);
    (stress, MaterialTangent(tangent.material(&stress, deformation).0.major_part()))
}

/// Writes [`Hyperelastic`](super::Hyperelastic) for a law of invariants, the parameters of a generic one in brackets first.
macro_rules! hyperelastic_of_invariants {
    ([$($generics:tt)*] $law:ty) => {
        impl<$($generics)*> $crate::Hyperelastic for $law {
            const REFUSED_IS_NOT_FINITE: bool =
                <$law as $crate::invariant::InvariantEnergy>::REFUSED_IS_NOT_FINITE;
            const KNOWS_DEFORMATIONS: bool = <$law as $crate::invariant::InvariantEnergy>::STRAIGHT;

            fn reference_energy(&self) -> f64 {
                $crate::invariant::InvariantEnergy::reference_energy(self)
            }
            fn is_incompressible(&self) -> bool {
                $crate::invariant::InvariantEnergy::is_incompressible(self)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn first_piola_derivative<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
                direction: &nalgebra::Matrix3<T>,
            ) -> piola_continuum::FirstPiola<T> {
                $crate::invariant::first_piola_derivative(self, deformation, direction)
            }

            answers! { |self, deformation|
                energy -> T { $crate::invariant::InvariantEnergy::energy(self, deformation) }
                check -> Result<(), $crate::SolidsError> { $crate::invariant::InvariantEnergy::check(self, deformation) }
                first_piola -> piola_continuum::FirstPiola<T> { $crate::invariant::first_piola(self, deformation) }
                energy_and_first_piola -> (T, piola_continuum::FirstPiola<T>) {
                    $crate::invariant::energy_and_first_piola(self, deformation)
                }
                energy_first_piola_and_tangent ->
                    (T, piola_continuum::FirstPiola<T>, piola_continuum::stress::tangents::FirstPiolaTangent<T>) {
                    $crate::invariant::energy_first_piola_and_tangent(self, deformation)
                }
                second_piola -> piola_continuum::SecondPiola<T> { $crate::invariant::second_piola(self, deformation) }
                kirchhoff -> piola_continuum::KirchhoffStress<T> { $crate::invariant::kirchhoff(self, deformation) }
                first_piola_tangent -> piola_continuum::stress::tangents::FirstPiolaTangent<T> {
                    $crate::invariant::first_piola_tangent(self, deformation)
                }
                first_piola_and_tangent ->
                    (piola_continuum::FirstPiola<T>, piola_continuum::stress::tangents::FirstPiolaTangent<T>) {
                    $crate::invariant::first_piola_and_tangent(self, deformation)
                }
                first_piola_and_upper_triangle -> [T; 54] {
                    $crate::invariant::first_piola_and_upper_triangle(self, deformation)
                }
                second_piola_and_tangent ->
                    (piola_continuum::SecondPiola<T>, piola_continuum::stress::tangents::MaterialTangent<T>) {
                    $crate::invariant::second_piola_and_tangent(self, deformation)
                }
                cauchy_and_tangent ->
                    (piola_continuum::CauchyStress<T>, piola_continuum::stress::tangents::TruesdellTangent<T>) {
                    let (stress, tangent) = $crate::invariant::second_piola_and_tangent(self, deformation);
                    (stress.cauchy(deformation), tangent.truesdell(deformation))
                }
            }
        }
    };
    ($law:ty) => {
        $crate::invariant::hyperelastic_of_invariants!([] $law);
    };
}
pub(super) use hyperelastic_of_invariants;
