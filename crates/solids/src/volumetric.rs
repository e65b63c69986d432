//! Energies of a change of volume, U(J): parts to combine with any energy of a change of shape.
//!
//! ```text
//! mean Kirchhoff stress J U′(J)      pressure p = −U′(J)      bulk modulus of the reference U″(1) = κ
//! ```
//!
//! | type | U(J) | J → 0 | source |
//! |---|---|---|---|
//! | [`Quadratic`] | ½ κ (J − 1)² | finite | the penalty of incompressibility |
//! | [`Logarithmic`] | ½ κ ln² J | infinite, not convex in J beyond e | Simo, Taylor & Pister 1985 |
//! | [`Lame`] | ½ λ ln² J, λ of either sign | beside a shape that resists a change of volume | Hencky 1928, Ogden 1972 |
//! | [`QuadraticLogarithmic`] | ¼ κ ((J − 1)² + ln² J) | infinite | Simo & Taylor 1982 |
//! | [`SimoTaylor`] | ¼ κ (J² − 1 − 2 ln J) | infinite, convex | Simo & Taylor 1991 |
//! | [`Liu`] | κ (J ln J − J + 1) | finite, convex | Liu, Hofstetter & Mang 1994 |
//! | [`Miehe`] | κ (J − 1 − ln J) | infinite, convex | Miehe 1994 |
//! | [`OgdenVolumetric`] | κ β⁻² (J^(−β) − 1 + β ln J) | infinite for 0 < β | Ogden 1972 |
//! | [`HartmannNeff`] | κ (J⁵ + J⁻⁵ − 2)/50 | infinite, convex | Hartmann & Neff 2003 |
//!
//! All are computed from J − 1, so that no digits cancel near the reference. Where which one is to be read from a file:
//! [`AnyVolumetric`](super::AnyVolumetric).
//!
//! # Example
//! The mean Kirchhoff stress J U′ and other numbers at J = 2.
//! ```
//! use piola_solids::volumetric::{HartmannNeff, Lame, Liu, Logarithmic, Miehe, OgdenVolumetric};
//! use piola_solids::volumetric::{Quadratic, QuadraticLogarithmic, SimoTaylor, Volumetric};
//! let (change, jacobian, ln2) = (1.0, 2.0, 2.0_f64.ln()); // J − 1 and J
//! assert_eq!(Quadratic::new(8.0)?.energy(0.5, 1.5), 1.0); // ½ κ (J − 1)²
//! assert_eq!(Logarithmic::new(8.0)?.mean_kirchhoff(change, jacobian), 8.0 * ln2);
//! assert_eq!(Lame::new(-8.0)?.mean_kirchhoff(change, jacobian), -8.0 * ln2);
//! assert_eq!(QuadraticLogarithmic::new(2.0)?.mean_kirchhoff(change, jacobian), 2.0 + ln2); // ½ κ (J (J − 1) + ln J)
//! assert_eq!(SimoTaylor::new(2.0)?.mean_kirchhoff(change, jacobian), 3.0); // ½ κ (J² − 1)
//! assert_eq!(Liu::new(3.0)?.curvature(change, jacobian), 1.5); // κ/J
//! assert_eq!(Miehe::new(3.0)?.mean_kirchhoff(change, jacobian), 3.0); // κ (J − 1)
//! assert!((OgdenVolumetric::new(4.0, 1.0)?.mean_kirchhoff(change, jacobian) - 2.0_f64).abs() < 1e-15); // κ/β (1 − J^(−β))
//! assert!((HartmannNeff::new(50.0)?.energy(change, jacobian) - 961.0_f64 / 32.0).abs() < 1e-13); // (J⁵ − 1)²/J⁵
//! # Ok::<(), piola_solids::SolidsError>(())
//! ```

use piola_numerics::internal::{excess_over_given as excess, volume_excess};
use piola_numerics::{Real, parameters};

/// An energy of the change of volume, zero with its first derivative at J = 1.
///
/// # Example
/// One of your own, U = κ (cosh(J − 1) − 1).
/// ```
/// use piola_solids::volumetric::Volumetric;
/// use piola_numerics::Real;
/// #[derive(Clone)]
/// struct Mine(f64);
/// impl Volumetric for Mine {
///     fn energy<T: Real>(&self, change: T, _jacobian: T) -> T {
///         let half = (change * T::lit(0.5)).sinh();
///         T::lit(2.0 * self.0) * half * half // cosh x − 1 without cancellation
///     }
///     fn mean_kirchhoff<T: Real>(&self, change: T, jacobian: T) -> T {
///         T::lit(self.0) * jacobian * change.sinh()
///     }
///     fn curvature<T: Real>(&self, change: T, _jacobian: T) -> T {
///         T::lit(self.0) * change.cosh()
///     }
/// }
/// assert_eq!(Mine(3.0).bulk_modulus(), 3.0);
/// ```
pub trait Volumetric: Clone {
    /// See [`InvariantEnergy::STRAIGHT`](super::invariant::InvariantEnergy::STRAIGHT).
    const STRAIGHT: bool = false;
    /// True if the bulk modulus may be negative, beside a change of shape that resists a change of volume too.
    const EITHER_SIGN: bool = false;

    /// U of J − 1 and J, J/m³, without cancellation.
    #[must_use]
    fn energy<T: Real>(&self, change: T, jacobian: T) -> T;

    /// J U′(J), Pa: the mean of the Kirchhoff stress, without cancellation.
    #[must_use]
    fn mean_kirchhoff<T: Real>(&self, change: T, jacobian: T) -> T;

    /// U″(J), Pa.
    #[must_use]
    fn curvature<T: Real>(&self, change: T, jacobian: T) -> T;

    /// J (J U′)′ = J U′ + J² U″, Pa: how the mean Kirchhoff stress grows with ln J.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn stiffness<T: Real>(&self, change: T, jacobian: T) -> T {
        self.mean_kirchhoff(change, jacobian) + self.curvature(change, jacobian) * (jacobian * jacobian)
    }

    /// κ = U″(1), Pa.
    #[must_use]
    fn bulk_modulus(&self) -> f64 {
        self.curvature(0.0, 1.0)
    }
}

impl<U: Volumetric> Volumetric for &U {
    const STRAIGHT: bool = U::STRAIGHT;
    const EITHER_SIGN: bool = U::EITHER_SIGN;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, change: T, jacobian: T) -> T {
        U::energy(self, change, jacobian)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mean_kirchhoff<T: Real>(&self, change: T, jacobian: T) -> T {
        U::mean_kirchhoff(self, change, jacobian)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvature<T: Real>(&self, change: T, jacobian: T) -> T {
        U::curvature(self, change, jacobian)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stiffness<T: Real>(&self, change: T, jacobian: T) -> T {
        U::stiffness(self, change, jacobian)
    }
    fn bulk_modulus(&self) -> f64 {
        U::bulk_modulus(self)
    }
}

parameters! {
    SolidsError;
    /// U = ½ κ (J − 1)².
    ///
    /// κ in Pa, 0 ≤ κ. Volume may vanish at the finite cost ½ κ.
    pub struct Quadratic("quadratic volumetric energy") {
        /// κ, Pa.
        bulk_modulus as "kappa": "0 ≤ κ" => 0.0 <= bulk_modulus,
    }
}

impl Volumetric for Quadratic {
    const STRAIGHT: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, change: T, _jacobian: T) -> T {
        T::lit(0.5 * self.bulk_modulus) * (change * change)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mean_kirchhoff<T: Real>(&self, change: T, jacobian: T) -> T {
        T::lit(self.bulk_modulus) * (jacobian * change)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvature<T: Real>(&self, _change: T, _jacobian: T) -> T {
        T::lit(self.bulk_modulus)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stiffness<T: Real>(&self, change: T, jacobian: T) -> T {
        T::lit(self.bulk_modulus) * (jacobian * (jacobian + change))
    }
}

parameters! {
    SolidsError;
    /// U = ½ κ ln² J.
    ///
    /// κ in Pa, 0 ≤ κ. The pressure falls again where e < J.
    pub struct Logarithmic("logarithmic volumetric energy") {
        /// κ, Pa.
        bulk_modulus as "kappa": "0 ≤ κ" => 0.0 <= bulk_modulus,
    }
}

impl Volumetric for Logarithmic {
    const STRAIGHT: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, change: T, jacobian: T) -> T {
        let logarithm = change.ln_1p_given(jacobian);
        T::lit(0.5 * self.bulk_modulus) * (logarithm * logarithm)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mean_kirchhoff<T: Real>(&self, change: T, jacobian: T) -> T {
        T::lit(self.bulk_modulus) * change.ln_1p_given(jacobian)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvature<T: Real>(&self, change: T, jacobian: T) -> T {
        let reciprocal = jacobian.recip();
        T::lit(self.bulk_modulus) * (T::one() - change.ln_1p_given(jacobian)) * (reciprocal * reciprocal)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stiffness<T: Real>(&self, _change: T, _jacobian: T) -> T {
        T::lit(self.bulk_modulus)
    }
}

parameters! {
    SolidsError;
    /// U = ½ λ ln² J with λ of either sign: beside a change of shape that resists a change of volume too.
    ///
    /// λ in Pa. The bulk modulus is that of the whole law, λ + ⅔ μ for [`Hencky`](super::Hencky) and
    /// [`Ogden`](super::Ogden), which see that it is positive.
    pub struct Lame("volumetric energy of Lamé's λ") {
        /// λ, Pa.
        first_lame_parameter as "lambda": "finite" => true,
    }
}

impl Volumetric for Lame {
    const STRAIGHT: bool = true;
    const EITHER_SIGN: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, change: T, jacobian: T) -> T {
        let logarithm = change.ln_1p_given(jacobian);
        T::lit(0.5 * self.first_lame_parameter) * (logarithm * logarithm)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mean_kirchhoff<T: Real>(&self, change: T, jacobian: T) -> T {
        T::lit(self.first_lame_parameter) * change.ln_1p_given(jacobian)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvature<T: Real>(&self, change: T, jacobian: T) -> T {
        let reciprocal = jacobian.recip();
        T::lit(self.first_lame_parameter) * (T::one() - change.ln_1p_given(jacobian)) * (reciprocal * reciprocal)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stiffness<T: Real>(&self, _change: T, _jacobian: T) -> T {
        T::lit(self.first_lame_parameter)
    }
}

parameters! {
    SolidsError;
    /// U = ¼ κ ((J − 1)² + ln² J).
    ///
    /// κ in Pa, 0 ≤ κ.
    pub struct QuadraticLogarithmic("quadratic–logarithmic volumetric energy") {
        /// κ, Pa.
        bulk_modulus as "kappa": "0 ≤ κ" => 0.0 <= bulk_modulus,
    }
}

impl Volumetric for QuadraticLogarithmic {
    const STRAIGHT: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, change: T, jacobian: T) -> T {
        let logarithm = change.ln_1p_given(jacobian);
        T::lit(0.25 * self.bulk_modulus) * (change * change + logarithm * logarithm)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mean_kirchhoff<T: Real>(&self, change: T, jacobian: T) -> T {
        T::lit(0.5 * self.bulk_modulus) * (jacobian * change + change.ln_1p_given(jacobian))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvature<T: Real>(&self, change: T, jacobian: T) -> T {
        let reciprocal = jacobian.recip();
        let beyond = (T::one() - change.ln_1p_given(jacobian)) * (reciprocal * reciprocal);
        T::lit(0.5 * self.bulk_modulus) * (T::one() + beyond)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stiffness<T: Real>(&self, change: T, jacobian: T) -> T {
        T::lit(0.5 * self.bulk_modulus) * (jacobian * (jacobian + change) + T::one())
    }
}

parameters! {
    SolidsError;
    /// U = ¼ κ (J² − 1 − 2 ln J).
    ///
    /// κ in Pa, 0 ≤ κ.
    pub struct SimoTaylor("Simo–Taylor volumetric energy") {
        /// κ, Pa.
        bulk_modulus as "kappa": "0 ≤ κ" => 0.0 <= bulk_modulus,
    }
}

impl Volumetric for SimoTaylor {
    const STRAIGHT: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, change: T, jacobian: T) -> T {
        // J² − 1 − 2 ln J = (J − 1)² + 2 (J − 1 − ln J).
        T::lit(0.25 * self.bulk_modulus) * (change * change + T::lit(2.0) * volume_excess(change, jacobian))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mean_kirchhoff<T: Real>(&self, change: T, _jacobian: T) -> T {
        T::lit(0.5 * self.bulk_modulus) * (change * (change + T::lit(2.0)))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvature<T: Real>(&self, _change: T, jacobian: T) -> T {
        let reciprocal = jacobian.recip();
        T::lit(0.5 * self.bulk_modulus) * (T::one() + reciprocal * reciprocal)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stiffness<T: Real>(&self, _change: T, jacobian: T) -> T {
        T::lit(self.bulk_modulus) * (jacobian * jacobian)
    }
}

parameters! {
    SolidsError;
    /// U = κ (J ln J − J + 1).
    ///
    /// κ in Pa, 0 ≤ κ. The pressure is −κ ln J; volume may vanish at the finite cost κ.
    pub struct Liu("Liu volumetric energy") {
        /// κ, Pa.
        bulk_modulus as "kappa": "0 ≤ κ" => 0.0 <= bulk_modulus,
    }
}

impl Volumetric for Liu {
    const STRAIGHT: bool = true;

    /// With z = 1/J − 1 it is κ J (z − ln(1 + z)).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, change: T, jacobian: T) -> T {
        T::lit(self.bulk_modulus) * (jacobian * excess(-change / jacobian, -change.ln_1p_given(jacobian)))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mean_kirchhoff<T: Real>(&self, change: T, jacobian: T) -> T {
        T::lit(self.bulk_modulus) * (jacobian * change.ln_1p_given(jacobian))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvature<T: Real>(&self, _change: T, jacobian: T) -> T {
        T::lit(self.bulk_modulus) / jacobian
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stiffness<T: Real>(&self, change: T, jacobian: T) -> T {
        T::lit(self.bulk_modulus) * (jacobian * (T::one() + change.ln_1p_given(jacobian)))
    }
}

parameters! {
    SolidsError;
    /// U = κ (J − 1 − ln J).
    ///
    /// κ in Pa, 0 ≤ κ.
    pub struct Miehe("Miehe volumetric energy") {
        /// κ, Pa.
        bulk_modulus as "kappa": "0 ≤ κ" => 0.0 <= bulk_modulus,
    }
}

impl Volumetric for Miehe {
    const STRAIGHT: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, change: T, jacobian: T) -> T {
        T::lit(self.bulk_modulus) * volume_excess(change, jacobian)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mean_kirchhoff<T: Real>(&self, change: T, _jacobian: T) -> T {
        T::lit(self.bulk_modulus) * change
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvature<T: Real>(&self, _change: T, jacobian: T) -> T {
        let reciprocal = jacobian.recip();
        T::lit(self.bulk_modulus) * (reciprocal * reciprocal)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stiffness<T: Real>(&self, _change: T, jacobian: T) -> T {
        T::lit(self.bulk_modulus) * jacobian
    }
}

parameters! {
    SolidsError;
    /// U = κ β⁻² (J^(−β) − 1 + β ln J).
    ///
    /// κ in Pa, 0 ≤ κ; β ≠ 0, κ/β² finite. β = 9 is Ogden's value for rubber, β = −2 is [`SimoTaylor`]'s energy.
    pub struct OgdenVolumetric("Ogden volumetric energy") {
        /// κ, Pa.
        bulk_modulus as "kappa": "0 ≤ κ" => 0.0 <= bulk_modulus,
        /// β.
        exponent as "beta": "0 < |β|, κ/β² finite" => 0.0 < exponent.abs() && (bulk_modulus / (exponent * exponent)).is_finite(),
    }
}

impl OgdenVolumetric {
    /// J^(−β) − 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn power<T: Real>(&self, change: T, jacobian: T) -> T {
        (T::lit(-self.exponent) * change.ln_1p_given(jacobian)).exp_m1()
    }
}

impl Volumetric for OgdenVolumetric {
    const STRAIGHT: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, change: T, jacobian: T) -> T {
        let logarithm = T::lit(-self.exponent) * change.ln_1p_given(jacobian);
        T::lit(self.bulk_modulus / (self.exponent * self.exponent)) * excess(logarithm.exp_m1(), logarithm)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mean_kirchhoff<T: Real>(&self, change: T, jacobian: T) -> T {
        T::lit(-self.bulk_modulus / self.exponent) * self.power(change, jacobian)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvature<T: Real>(&self, change: T, jacobian: T) -> T {
        let reciprocal = jacobian.recip();
        let slope = T::one() + T::lit((self.exponent + 1.0) / self.exponent) * self.power(change, jacobian);
        T::lit(self.bulk_modulus) * slope * (reciprocal * reciprocal)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stiffness<T: Real>(&self, change: T, jacobian: T) -> T {
        T::lit(self.bulk_modulus) * (T::lit(-self.exponent) * change.ln_1p_given(jacobian)).exp()
    }
}

parameters! {
    SolidsError;
    /// U = κ (J⁵ + J⁻⁵ − 2)/50.
    ///
    /// κ in Pa, 0 ≤ κ.
    pub struct HartmannNeff("Hartmann–Neff volumetric energy") {
        /// κ, Pa.
        bulk_modulus as "kappa": "0 ≤ κ" => 0.0 <= bulk_modulus,
    }
}

impl HartmannNeff {
    /// J⁵ − 1 and J⁵.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn powers<T: Real>(change: T, jacobian: T) -> (T, T) {
        let square = jacobian * jacobian;
        let fourth = square * square;
        (change * (T::one() + jacobian + square + square * jacobian + fourth), fourth * jacobian)
    }
}

impl Volumetric for HartmannNeff {
    const STRAIGHT: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, change: T, jacobian: T) -> T {
        let (less_one, fifth) = Self::powers(change, jacobian);
        T::lit(0.02 * self.bulk_modulus) * (less_one * less_one / fifth)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mean_kirchhoff<T: Real>(&self, change: T, jacobian: T) -> T {
        let (less_one, fifth) = Self::powers(change, jacobian);
        T::lit(0.1 * self.bulk_modulus) * (less_one * (T::one() + fifth.recip()))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvature<T: Real>(&self, _change: T, jacobian: T) -> T {
        let square = jacobian * jacobian;
        let seventh = square * square * square * jacobian;
        T::lit(0.2 * self.bulk_modulus) * (T::lit(2.0) * (square * jacobian) + T::lit(3.0) / seventh)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stiffness<T: Real>(&self, change: T, jacobian: T) -> T {
        let (_, fifth) = Self::powers(change, jacobian);
        T::lit(0.5 * self.bulk_modulus) * (fifth + fifth.recip())
    }
}
