//! The solids of Blatz and Ko.

use piola_continuum::Deformation;
use piola_numerics::{Mask, Real};

use super::exponent_range::{check_below, largest_exponent, within};
use super::incompressible::inverse_excess;
use super::invariant::{Curvatures, InvariantEnergy, Invariants, Slopes, first_excess, hyperelastic_of_invariants};
use crate::SolidsError;
use piola_numerics::internal::excess_over_given;
use piola_numerics::parameters;

parameters! {
    SolidsError;
    /// The solid of Blatz and Ko, for foamed and for solid rubber.
    ///
    /// ```text
    /// W = ½ μ f [I₁ − 3 + (J^(−2β) − 1)/β] + ½ μ (1 − f) [I₂/J² − 3 + (J^(2β) − 1)/β]        β = ν/(1 − 2 ν)
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | μ | `shear_modulus` | Pa | 0 < μ |
    /// | ν | `poisson_ratio` | 1 | 0 ≤ ν < ½ |
    /// | f | `solid_fraction` | 1 | 0 ≤ f ≤ 1: 0 foam, 1 solid |
    ///
    /// `check` refuses changes of volume whose power J^(±2β) leaves the range of the scalar, as it soon does near ν = ½;
    /// without it energy, stresses and tangents are NaN there.
    ///
    /// [`foam`](Self::foam) is f = 0, ν = ¼: W = ½ μ (I₂/I₃ + 2 √I₃ − 5).
    ///
    /// # Accuracy
    /// P, S, τ relative 1e-13 down to ∇u = 1e-16; tangents a few ulp of their norm.
    ///
    /// # Example
    /// ```
    /// use piola_solids::{BlatzKo, Hyperelastic};
    /// use piola_continuum::DeformationGradient;
    /// let foam = BlatzKo::foam(2.0)?;
    /// let stress = foam.cauchy(&DeformationGradient::diagonal([2.0, 1.0, 1.0])?).0.components;
    /// assert!((stress[0] - 1.75_f64).abs() < 1e-15); // μ (1 − 1/(λ² J))
    /// assert!((stress[1] - 1.0_f64).abs() < 1e-15); // μ (1 − 1/J)
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// Blatz & Ko 1962.
    pub struct BlatzKo("Blatz–Ko") {
        /// μ, Pa.
        shear_modulus as "mu": "0 < μ" => 0.0 < shear_modulus,
        /// ν.
        poisson_ratio as "nu": "0 ≤ ν < ½" => 0.0 <= poisson_ratio && poisson_ratio < 0.5,
        /// f.
        solid_fraction as "share": "0 ≤ f ≤ 1" => 0.0 <= solid_fraction && solid_fraction <= 1.0,
    }
}

impl BlatzKo {
    /// Foamed polyurethane: f = 0, ν = ¼.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn foam(shear_modulus: f64) -> Result<Self, SolidsError> {
        Self::new(shear_modulus, 0.25, 0.0)
    }

    /// β = ν/(1 − 2 ν).
    #[doc(alias = "beta")]
    #[must_use]
    pub fn exponent(&self) -> f64 {
        self.poisson_ratio / (1.0 - 2.0 * self.poisson_ratio)
    }

    /// μ f and μ (1 − f).
    fn moduli(&self) -> (f64, f64) {
        (self.shear_modulus * self.solid_fraction, self.shear_modulus * (1.0 - self.solid_fraction))
    }

    /// J^(−2β) − 1 and J^(2β) − 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn powers<T: Real>(&self, logarithm: T) -> (T, T) {
        let exponent = T::lit(2.0 * self.exponent()) * logarithm;
        let exponent = within(exponent.abs(), T::lit(self.limit::<T>()), exponent);
        ((-exponent).exp_m1(), exponent.exp_m1())
    }

    /// Upper bound of |2 β ln J| that keeps the tangent within the range of the scalar.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn limit<T: Real>(&self) -> f64 {
        largest_exponent::<T>(4.0 * self.shear_modulus * (1.0 + self.exponent()))
    }
}

impl InvariantEnergy for BlatzKo {
    const SECOND: bool = true;
    const CURVED: bool = true;
    const STRAIGHT: bool = true;
    /// To the rounding of ln J.
    const REFUSED_IS_NOT_FINITE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        let (jacobian, limit) = (deformation.jacobian(), self.limit::<T>());
        // |2 β ln J| < 60.
        let small = self.exponent() <= 10.0 && 60.0 <= limit;
        if small && (T::lit(0.05).less_than(jacobian) & jacobian.less_than(T::lit(20.0))).all() {
            return Ok(());
        }
        let exponent = (T::lit(2.0 * self.exponent()) * deformation.ln_jacobian()).abs();
        check_below(Self::NAME, "2 β |ln J|", exponent, limit)
    }

    /// With z = J^(∓2β) − 1 the brackets are I₁ − 3 − 2 ln J and I₂/J² − 3 + 2 ln J, each with (z − ln(1 + z))/β.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let (solid, foam) = self.moduli();
        let (down, up) = self.powers(deformation.ln_jacobian());
        let beta = self.exponent();
        let exponent = T::lit(2.0 * beta) * deformation.ln_jacobian();
        let reciprocal = if 0.0 < beta { T::lit(beta.recip()) } else { T::zero() };
        T::lit(0.5 * solid) * (first_excess(deformation) + reciprocal * excess_over_given(down, -exponent))
            + T::lit(0.5 * foam) * (inverse_excess(deformation) + reciprocal * excess_over_given(up, exponent))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, invariants: &Invariants<T>) -> Slopes<T> {
        let (solid, foam) = self.moduli();
        let change = invariants.change;
        let (down, up) = self.powers(change.ln_1p_given(invariants.jacobian));
        let reciprocal = invariants.jacobian.recip();
        let square = reciprocal * reciprocal;
        // (J² − 1 − (I₂ − 3))/J².
        let shape = (change * (change + T::lit(2.0)) - invariants.second) * square;
        Slopes {
            first: T::lit(0.5 * solid),
            second: T::lit(0.5 * foam) * square,
            residual: T::lit(foam) * (up + shape) - T::lit(solid) * down,
            volume: T::lit(foam) * ((T::one() + up) - invariants.second_whole * square)
                - T::lit(solid) * (T::one() + down),
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, invariants: &Invariants<T>) -> Curvatures<T> {
        let (solid, foam) = self.moduli();
        let (one, beta) = (T::one(), self.exponent());
        let (down, up) = self.powers(invariants.change.ln_1p_given(invariants.jacobian));
        let reciprocal = invariants.jacobian.recip();
        let square = reciprocal * reciprocal;
        let inverse = invariants.second_whole * square;
        let growth = T::lit(3.0) * inverse + T::lit(2.0 * beta - 1.0) * (one + up);
        Curvatures {
            second_volume: T::lit(-foam) * (square * reciprocal),
            ..Curvatures::of_volume(
                (T::lit(solid * (2.0 * beta + 1.0)) * (one + down) + T::lit(foam) * growth) * square,
            )
        }
    }
}

hyperelastic_of_invariants!(BlatzKo);
