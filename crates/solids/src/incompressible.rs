//! Incompressible solids: any energy of the change of shape, with a pressure that is given.

use nalgebra::Matrix3;
use piola_continuum::internal::strain as kernels;
use piola_continuum::strain::invariants;
use piola_continuum::{CauchyStress, Deformation, FirstPiola, Symmetric};
use piola_numerics::{Mask, Real};

use super::invariant::{Curvatures, InvariantEnergy, Invariants, Slopes, first_excess, hyperelastic_of_invariants};
use super::isochoric::{self, Isochoric};
use crate::SolidsError;
use crate::error::check_finite;
use piola_numerics::internal::excess_over_given;

const LAW: &str = "incompressible solid";

/// Largest |J − 1| admitted.
const VOLUME: f64 = 1e-6;

/// The pressure of an incompressible solid, Pa.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written", rename_all = "snake_case"))]
pub enum Pressure {
    /// p of T = −p 1 + 2 W₁ B − 2 W₂ B⁻¹, as the text writes it. The stress-free reference has p = 2 (W₁ − W₂).
    Whole(f64),
    /// q of T = −q 1 + 2 W₁ (B − 1) − 2 W₂ (B⁻¹ − 1): the pressure beyond that of a body at rest, without cancellation.
    Excess(f64),
}

impl Default for Pressure {
    /// That of a body at rest.
    fn default() -> Self {
        Self::Excess(0.0)
    }
}

/// A pressure as it is written.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(rename_all = "snake_case")]
enum Written {
    Whole(f64),
    Excess(f64),
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for Pressure {
    type Error = SolidsError;

    fn try_from(written: Written) -> Result<Self, SolidsError> {
        match written {
            Written::Whole(p) => check_finite(LAW, "p", p).map(|()| Self::Whole(p)),
            Written::Excess(q) => check_finite(LAW, "q", q).map(|()| Self::Excess(q)),
        }
    }
}

/// Refuses a change of volume of what is incompressible.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn check_volume<T: Real>(law: &'static str, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
    let change = deformation.volume_change();
    if change.abs().less_than(T::lit(VOLUME)).all() { Ok(()) } else { Err(changed_volume(law, &change)) }
}

/// The first lane whose volume changes.
#[cold]
#[inline(never)]
fn changed_volume<T: Real>(law: &'static str, change: &T) -> SolidsError {
    let values = (0..T::LANES).map(|lane| change.primal(lane).abs());
    let value = values.into_iter().find(|value| VOLUME <= *value || value.is_nan()).unwrap_or(f64::NAN);
    SolidsError::BeyondLimit { law, quantity: "|J − 1|", value, limit: VOLUME }
}

/// An incompressible isotropic solid of any [`Isochoric`] energy, its pressure given.
///
/// ```text
/// T = −p 1 + 2 W₁ B − 2 W₂ B⁻¹,   det F = 1        p = q + 2 (W₁ − W₂)
/// ```
/// As a [`Hyperelastic`](super::Hyperelastic) law it has the energy W − p (J − 1), or W − q (J − 1), its W₁ and W₂
/// continued to other volumes so that stress and tangent are derivatives at a fixed p or q:
///
/// ```text
/// p:  W(I₁ − 3, I₂/J² − 3)         q:  W(I₁ − 3 − 2 ln J, I₂/J² − 3 + 2 ln J)
/// ```
/// To have the pressure from a condition such as a free face see `piola_specimens::homogeneous`.
///
/// # Accuracy
/// With an excess pressure P, S, τ relative 1e-13 down to ∇u = 1e-16. With a whole pressure a few ulp of p and of the
/// moduli: its digits are lost where p nearly balances the moduli.
///
/// # Errors
/// `check` refuses 1e-6 ≤ |J − 1| and what the energy refuses.
///
/// # Example
/// ```
/// use piola_solids::{Hyperelastic, IncompressibleSolid, isochoric::MooneyRivlin};
/// use piola_continuum::DeformationGradient;
/// let rubber = IncompressibleSolid::new(MooneyRivlin::new(0.5, 0.25)?);
/// let shear = DeformationGradient::simple_shear(1.0)?;
/// let stress = rubber.cauchy(&shear).0.components; // q = 0
/// assert_eq!([stress[0], stress[1], stress[2], stress[3]], [-0.5, 1.0, 0.0, 1.5]);
/// let pressed = rubber.at_pressure(1.75)?.cauchy(&shear).0.components;
/// assert_eq!(pressed[2], 2.0 * 0.5 - 2.0 * 0.25 - 1.75);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// B(4.64), B(4.66), W(21.20), W(25.4).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct IncompressibleSolid<I> {
    /// W, of I₁ − 3 and I₂ − 3.
    pub isochoric: I,
    /// p or q, Pa.
    #[cfg_attr(feature = "serde", serde(default))]
    pub pressure: Pressure,
}

impl<I: Isochoric> IncompressibleSolid<I> {
    /// Without excess pressure: the reference is free of stress.
    #[must_use]
    pub const fn new(isochoric: I) -> Self {
        Self { isochoric, pressure: Pressure::Excess(0.0) }
    }

    /// At the pressure p of T = −p 1 + 2 W₁ B − 2 W₂ B⁻¹, Pa.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`].
    pub fn at_pressure(self, pressure: f64) -> Result<Self, SolidsError> {
        check_finite(LAW, "p", pressure)?;
        Ok(Self { pressure: Pressure::Whole(pressure), ..self })
    }

    /// At the pressure q beyond that of a body at rest, Pa.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`].
    pub fn at_excess_pressure(self, excess: f64) -> Result<Self, SolidsError> {
        check_finite(LAW, "q", excess)?;
        Ok(Self { pressure: Pressure::Excess(excess), ..self })
    }

    /// The stress that the deformation determines, 2 W₁ B − 2 W₂ B⁻¹.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn extra_stress<T: Real>(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        let [first, second] = self.slopes_at(deformation);
        let stress = kernels::left_cauchy_green(deformation.gradient_rows()) * (T::lit(2.0) * first);
        if !I::SECOND {
            return CauchyStress(stress);
        }
        // B⁻¹ = F⁻ᵀ F⁻¹, Cof F Cof Fᵀ of an isochoric F.
        let inverse: Symmetric<T> = kernels::left_cauchy_green(deformation.cofactor_rows());
        CauchyStress(stress - inverse * (T::lit(2.0) * second))
    }

    /// ∂W/∂F of W(I₁, I₂) as a function of all F, 2 W₁ F + 2 W₂ F (I₁ 1 − C): P up to a multiple of F⁻ᵀ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn energy_gradient<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        let [first, second] = self.slopes_at(deformation);
        let f = Matrix3::from_fn(|i, j| deformation.gradient_rows()[i][j]);
        let two = T::lit(2.0);
        let c = kernels::right_cauchy_green(deformation.gradient_rows());
        let inner = Symmetric::identity() * (first + second * c.trace()) - c * second;
        FirstPiola(f * inner.matrix() * two)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes_at<T: Real>(&self, deformation: &impl Deformation<T>) -> [T; 2] {
        let second = if I::SECOND { invariants::second_minus_three(deformation) } else { T::zero() };
        self.isochoric.slopes(invariants::first_minus_three(deformation), second)
    }

    /// (x, y) of W and their derivatives.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn arguments<T: Real>(&self, invariants: &Invariants<T>) -> Arguments<T> {
        let (one, two, three) = (T::one(), T::lit(2.0), T::lit(3.0));
        let reciprocal = invariants.jacobian.recip();
        let square = reciprocal * reciprocal;
        let change = invariants.change;
        let two_j = two * reciprocal;
        // I₂/J² and ∂/∂J of it.
        let second_invariant = if I::SECOND { invariants.second + three } else { three };
        let ratio = second_invariant * square;
        let less_three =
            if I::SECOND { (invariants.second - three * (change * (change + two))) * square } else { T::zero() };
        let (first, second, first_rate, second_rate) = match self.pressure {
            Pressure::Whole(_) => (invariants.first, less_three, T::zero(), -two_j * ratio),
            Pressure::Excess(_) => {
                let logarithm = two * change.ln_1p_given(invariants.jacobian);
                (invariants.first - logarithm, less_three + logarithm, -two_j, two_j * (one - ratio))
            }
        };
        let excess = matches!(self.pressure, Pressure::Excess(_));
        let bend = if excess { two * square } else { T::zero() };
        Arguments {
            first,
            second,
            first_rate,
            second_rate: if I::SECOND { second_rate } else { T::zero() },
            first_bend: bend,
            second_bend: T::lit(6.0) * ratio * square - bend,
            square,
        }
    }
}

/// x and y, their first and second derivatives with respect to J, and J⁻².
struct Arguments<T> {
    first: T,
    second: T,
    first_rate: T,
    second_rate: T,
    first_bend: T,
    second_bend: T,
    square: T,
}

/// I₁(C⁻¹) − 3 + 2 ln J, of second order in the strain, without cancellation.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn inverse_excess<T: Real>(deformation: &impl Deformation<T>) -> T {
    let (two, reciprocal) = (T::lit(2.0), deformation.jacobian().recip());
    // ∇u of the inverse deformation is −h.
    let h = deformation.spatial_displacement_rows();
    let minor = |i: usize, j: usize| h[i][i] * h[j][j] - h[i][j] * h[j][i];
    let beyond = (minor(0, 1) + minor(1, 2) + minor(0, 2)) - piola_numerics::linear::matrix3::determinant(h);
    piola_tensor::internal::rows::double_contraction(h, h) - two * beyond
        + two * excess_over_given(-deformation.volume_change() * reciprocal, -deformation.ln_jacobian())
}

impl<I: Isochoric> InvariantEnergy for IncompressibleSolid<I> {
    const SECOND: bool = I::SECOND;
    const CURVED: bool = true;
    const STRAIGHT: bool = I::STRAIGHT;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let change = deformation.volume_change();
        let (first, second, pressure) = match self.pressure {
            Pressure::Excess(q) => {
                let second = if I::SECOND { inverse_excess(deformation) } else { T::zero() };
                (first_excess(deformation), second, q)
            }
            Pressure::Whole(p) => {
                let first = invariants::first_minus_three(deformation);
                let second = if I::SECOND {
                    let reciprocal = deformation.jacobian().recip();
                    let beyond = T::lit(3.0) * (change * (change + T::lit(2.0)));
                    (invariants::second_minus_three(deformation) - beyond) * (reciprocal * reciprocal)
                } else {
                    T::zero()
                };
                (first, second, p)
            }
        };
        self.isochoric.energy(first, second) - T::lit(pressure) * change
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        check_volume(LAW, deformation)?;
        if !I::LIMITED {
            return Ok(());
        }
        let second = if I::SECOND { invariants::second_minus_three(deformation) } else { T::zero() };
        isochoric::check_lanes(&self.isochoric, invariants::first_minus_three(deformation), second)
    }

    fn is_incompressible(&self) -> bool {
        true
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, invariants: &Invariants<T>) -> Slopes<T> {
        let at = self.arguments(invariants);
        let [a, b] = self.isochoric.slopes(at.first, at.second);
        let (two, change) = (T::lit(2.0), invariants.change);
        let second = b * at.square;
        // Both are computed, so that there is no branch in a loop over lanes.
        let (whole, pressure) = match self.pressure {
            Pressure::Whole(p) => (true, T::lit(p)),
            Pressure::Excess(q) => (false, T::lit(q)),
        };
        let mut of_whole = (two * a - pressure) - pressure * change;
        let mut of_excess = -(pressure * invariants.jacobian);
        if I::SECOND {
            of_whole -= two * second * (invariants.second + T::one());
            of_excess += two * second * (change * (change + two) - invariants.second);
        }
        // 2 W₁ − 2 W₂ (I₂ − 2)/J² − p J, or 2 W₂ (J² − 1 − (I₂ − 3))/J² − q J.
        let residual = T::select(T::Mask::splat(whole), of_whole, of_excess);
        let second = if I::SECOND { second } else { T::zero() };
        // J is 1: no digits are lost.
        let volume = residual - (two * a + T::lit(4.0) * second);
        Slopes { first: a, second, residual, volume }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, invariants: &Invariants<T>) -> Curvatures<T> {
        let at = self.arguments(invariants);
        let [a, b] = self.isochoric.slopes(at.first, at.second);
        let [xx, xy, yy] = self.isochoric.curvatures(at.first, at.second);
        let first_turn = xx * at.first_rate + xy * at.second_rate;
        let second_turn = xy * at.first_rate + yy * at.second_rate;
        let two_j = T::lit(2.0) * invariants.jacobian.recip();
        let bending = if I::SECOND { a * at.first_bend + b * at.second_bend } else { a * at.first_bend };
        Curvatures {
            first_first: xx,
            first_second: xy * at.square,
            second_second: yy * (at.square * at.square),
            first_volume: first_turn,
            second_volume: (second_turn - b * two_j) * at.square,
            volume_volume: first_turn * at.first_rate + second_turn * at.second_rate + bending,
        }
    }
}

hyperelastic_of_invariants!([I: Isochoric] IncompressibleSolid<I>);
