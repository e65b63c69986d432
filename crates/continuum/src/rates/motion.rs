//! Homogeneous motions: F as a function of time, and what follows from it by exact derivatives.
//!
//! | to get | use |
//! |---|---|
//! | F, Ḟ, F̈ | [`deformation`](HomogeneousMotion::deformation), [`rates`](HomogeneousMotion::rates) |
//! | L, grad a | [`velocity_gradient`](HomogeneousMotion::velocity_gradient), [`acceleration_gradient`](HomogeneousMotion::acceleration_gradient) |
//! | Fₜ(τ), Cₜ(τ) | [`relative`](HomogeneousMotion::relative) |

use nalgebra::Matrix3;
use piola_numerics::linear::matrix3::{from_rows, inverse_and_determinant, rows_of};
use piola_numerics::{Jet, Real};
use piola_tensor::internal::rows::{Rows, difference, product, scaled, sum};

use super::exponential::{exponential_minus_identity_rows, exponential_rows};
use super::{AccelerationGradient, GradientRate, GradientSecondRate, RelativeDeformation, VelocityGradient};
use crate::error::check_finite;
use crate::{ContinuumError, DeformationGradient};

/// A homogeneous motion x = F(t) X + c(t), by its deformation gradient as a function of time, W(14.10).
///
/// One method is to be given; as it is written over any scalar, rates are exact.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::rates::HomogeneousMotion;
/// use piola_numerics::Real;
///
/// /// Simple shear that oscillates, x₂ = X₂ + sin t X₁.
/// struct Oscillation;
/// impl HomogeneousMotion for Oscillation {
///     fn gradient<T: Real>(&self, t: T) -> Matrix3<T> {
///         let mut f = Matrix3::from_diagonal_element(T::one());
///         f[(1, 0)] = t.sin();
///         f
///     }
/// }
/// assert_eq!(Oscillation.velocity_gradient(0.0)?.0[(1, 0)], 1.0);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
pub trait HomogeneousMotion {
    /// F(t).
    fn gradient<T: Real>(&self, t: T) -> Matrix3<T>;

    /// Fₜ(t + s) − 1 for the lapse s: to be stated without cancellation by motions that can.
    fn relative_displacement<T: Real>(&self, t: T, lapse: T) -> Matrix3<T> {
        let now = rows_of(&self.gradient(t));
        let change = difference(rows_of(&self.gradient(t + lapse)), now);
        from_rows(product(change, inverse_and_determinant(now).0))
    }

    /// F(t), checked.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`ContinuumError::NonPositiveJacobian`]: at this time F is no deformation.
    fn deformation<T: Real>(&self, t: T) -> Result<DeformationGradient<T>, ContinuumError> {
        DeformationGradient::new(self.gradient(t))
    }

    /// F(t), Ḟ(t) and F̈(t), in one pass.
    ///
    /// # Errors
    /// As [`deformation`](Self::deformation).
    fn rates<T: Real>(&self, t: T) -> Result<MotionRates<T>, ContinuumError> {
        let jet = self.gradient(Jet::<T, 0>::time(t));
        Ok(MotionRates {
            deformation: DeformationGradient::new(jet.map(|f| f.value))?,
            rate: GradientRate::new(jet.map(|f| f.rate))?,
            second_rate: GradientSecondRate::new(jet.map(|f| f.second_rate))?,
        })
    }

    /// L(t) = Ḟ F⁻¹, W(14.21).
    ///
    /// # Errors
    /// As [`deformation`](Self::deformation).
    fn velocity_gradient<T: Real>(&self, t: T) -> Result<VelocityGradient<T>, ContinuumError> {
        let MotionRates { deformation, rate, .. } = self.rates(t)?;
        Ok(VelocityGradient::of(&deformation, &rate))
    }

    /// grad a = F̈ F⁻¹.
    ///
    /// # Errors
    /// As [`deformation`](Self::deformation).
    fn acceleration_gradient<T: Real>(&self, t: T) -> Result<AccelerationGradient<T>, ContinuumError> {
        let MotionRates { deformation, second_rate, .. } = self.rates(t)?;
        Ok(AccelerationGradient::of(&deformation, &second_rate))
    }

    /// Fₜ(t + s), relative to the present configuration, after the lapse s; the past has s < 0.
    ///
    /// # Errors
    /// As [`deformation`](Self::deformation), of Fₜ.
    fn relative<T: Real>(&self, t: T, lapse: T) -> Result<RelativeDeformation<T>, ContinuumError> {
        RelativeDeformation::of_displacement(rows_of(&self.relative_displacement(t, lapse)))
    }
}

/// F, Ḟ and F̈ of a motion at one time.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::Deformation;
/// use piola_continuum::rates::{HomogeneousMotion, LinearMotion};
/// let motion = LinearMotion::new(Matrix3::identity(), Matrix3::from_diagonal_element(0.5))?;
/// let rates = motion.rates(2.0)?;
/// assert_eq!((rates.deformation.jacobian(), rates.rate.0[(0, 0)], rates.second_rate.0[(0, 0)]), (8.0, 0.5, 0.0));
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>"))
)]
pub struct MotionRates<T = f64> {
    /// F.
    pub deformation: DeformationGradient<T>,
    /// Ḟ.
    pub rate: GradientRate<T>,
    /// F̈.
    pub second_rate: GradientSecondRate<T>,
}

/// F(t) = F₀ + t A: every body point moves uniformly.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::rates::{HomogeneousMotion, LinearMotion};
/// let motion = LinearMotion::new(Matrix3::identity(), Matrix3::from_diagonal_element(0.5))?;
/// assert_eq!(motion.deformation(2.0)?.matrix()[(0, 0)], 2.0);
/// assert_eq!(motion.velocity_gradient(2.0)?.0[(0, 0)], 0.25);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "[[[f64; 3]; 3]; 2]", into = "[[[f64; 3]; 3]; 2]"))]
pub struct LinearMotion {
    initial: Rows<f64>,
    rate: Rows<f64>,
}

impl LinearMotion {
    /// From F₀ and A = Ḟ.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`]; [`ContinuumError::NonPositiveJacobian`] of F₀.
    pub fn new(initial: Matrix3<f64>, rate: Matrix3<f64>) -> Result<Self, ContinuumError> {
        DeformationGradient::new(initial)?;
        let rate = rows_of(&rate);
        check_finite("rate of F", rate.as_flattened())?;
        Ok(Self { initial: rows_of(&initial), rate })
    }
}

impl HomogeneousMotion for LinearMotion {
    fn gradient<T: Real>(&self, t: T) -> Matrix3<T> {
        from_rows(sum(constant(&self.initial), scaled(constant(&self.rate), t)))
    }
    fn relative_displacement<T: Real>(&self, t: T, lapse: T) -> Matrix3<T> {
        let now = inverse_and_determinant(rows_of(&self.gradient(t))).0;
        from_rows(scaled(product(constant(&self.rate), now), lapse))
    }
}

/// F(t) = exp(K t) F₀: the motion with the steady velocity gradient K.
///
/// ```text
/// L = K,   Ḟ = K F,   Fₜ(t + s) = exp(K s)
/// ```
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::rates::{ExponentialMotion, HomogeneousMotion};
/// // K² = 0: exp(K t) = 1 + K t, steady simple shear.
/// let k = Matrix3::new(0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0);
/// let shear = ExponentialMotion::new(k, Matrix3::identity())?;
/// assert_eq!(shear.deformation(4.0)?.matrix()[(1, 0)], 8.0);
/// assert_eq!(shear.relative(4.0, -1e-20)?.displacement.matrix()[(1, 0)], -2e-20);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "[[[f64; 3]; 3]; 2]", into = "[[[f64; 3]; 3]; 2]"))]
pub struct ExponentialMotion {
    generator: Rows<f64>,
    initial: Rows<f64>,
}

impl ExponentialMotion {
    /// From K and F₀.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`]; [`ContinuumError::NonPositiveJacobian`] of F₀.
    pub fn new(generator: Matrix3<f64>, initial: Matrix3<f64>) -> Result<Self, ContinuumError> {
        DeformationGradient::new(initial)?;
        let generator = rows_of(&generator);
        check_finite("K", generator.as_flattened())?;
        Ok(Self { generator, initial: rows_of(&initial) })
    }
}

impl HomogeneousMotion for ExponentialMotion {
    fn gradient<T: Real>(&self, t: T) -> Matrix3<T> {
        from_rows(product(exponential_rows(scaled(constant(&self.generator), t)), constant(&self.initial)))
    }
    fn relative_displacement<T: Real>(&self, _time: T, lapse: T) -> Matrix3<T> {
        from_rows(exponential_minus_identity_rows(scaled(constant(&self.generator), lapse)))
    }
    fn velocity_gradient<T: Real>(&self, _time: T) -> Result<VelocityGradient<T>, ContinuumError> {
        Ok(VelocityGradient::trusted(constant(&self.generator)))
    }
    fn acceleration_gradient<T: Real>(&self, _time: T) -> Result<AccelerationGradient<T>, ContinuumError> {
        let k = constant(&self.generator);
        Ok(AccelerationGradient::trusted(product(k, k)))
    }
}

impl TryFrom<[Rows<f64>; 2]> for LinearMotion {
    type Error = ContinuumError;
    fn try_from([initial, rate]: [Rows<f64>; 2]) -> Result<Self, ContinuumError> {
        Self::new(from_rows(initial), from_rows(rate))
    }
}

impl From<LinearMotion> for [Rows<f64>; 2] {
    fn from(motion: LinearMotion) -> Self {
        [motion.initial, motion.rate]
    }
}

impl TryFrom<[Rows<f64>; 2]> for ExponentialMotion {
    type Error = ContinuumError;
    fn try_from([generator, initial]: [Rows<f64>; 2]) -> Result<Self, ContinuumError> {
        Self::new(from_rows(generator), from_rows(initial))
    }
}

impl From<ExponentialMotion> for [Rows<f64>; 2] {
    fn from(motion: ExponentialMotion) -> Self {
        [motion.generator, motion.initial]
    }
}

fn constant<T: Real>(rows: &Rows<f64>) -> Rows<T> {
    rows.map(|row| row.map(T::lit))
}
