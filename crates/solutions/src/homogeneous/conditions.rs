//! Tests of homogeneous motions, and the motions that pass them.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::Deformation;
use piola_continuum::rates::{ExponentialMotion, HomogeneousMotion, LinearMotion};
use piola_fields::AffineHistory;
use piola_numerics::Jet;
use piola_tensor::Symmetric;

use crate::SolutionsError;
use crate::error::{check_bound, check_finite};

/// The body force per mass that a homogeneous motion needs in a body of any homogeneous simple material, b = F̈ X + c̈, m/s².
///
/// # Errors
/// [`SolutionsError::NotFinite`].
///
/// # Accuracy
/// Exact derivatives: a few ulp of the terms.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fields::AffineHistory;
/// use piola_numerics::Real;
/// use piola_solutions::homogeneous::body_force;
/// struct Fall;
/// impl AffineHistory for Fall {
///     fn gradient<T: Real>(&self, _t: T) -> Matrix3<T> {
///         Matrix3::from_diagonal_element(T::one())
///     }
///     fn translation<T: Real>(&self, t: T) -> Vector3<T> {
///         Vector3::new(T::zero(), T::zero(), T::lit(-4.905) * t * t)
///     }
/// }
/// assert_eq!(body_force(&Fall, &Vector3::x(), 2.0)?.z, -9.81);
/// # Ok::<(), piola_solutions::SolutionsError>(())
/// ```
///
/// # Source
/// W(22.7).
pub fn body_force(
    history: &impl AffineHistory,
    reference: &Vector3<f64>,
    t: f64,
) -> Result<Vector3<f64>, SolutionsError> {
    check_finite("X", reference.as_slice())?;
    check_finite("t", &[t])?;
    let time = Jet::<f64, 0>::time(t);
    let force =
        history.gradient(time).map(|f| f.second_rate) * reference + history.translation(time).map(|c| c.second_rate);
    check_finite("body force", force.as_slice())?;
    Ok(force)
}

/// What a homogeneous motion leaves of the conditions for universal motions at one time: zero where it satisfies them.
///
/// # Example
/// Steady simple shearing is accelerationless, keeps volumes and so the circulation.
/// ```
/// use piola_solutions::homogeneous::{MotionConditions, simple_shearing};
/// let shearing = MotionConditions::of(&simple_shearing(2.0)?, 1.5)?;
/// assert_eq!((shearing.acceleration, shearing.volume, shearing.volume_rate, shearing.circulation), (0.0, 0.0, 0.0, 0.0));
/// # Ok::<(), piola_solutions::SolutionsError>(())
/// ```
///
/// # Source
/// W(22.8), W(22.19–22.23).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionConditions {
    /// |F̈ F⁻¹| beside |L|²: zero at all times in a motion that is universal for all simple materials, W(22.8).
    pub acceleration: f64,
    /// det F − 1: zero in a motion of an incompressible body.
    pub volume: f64,
    /// tr L beside |L|: zero at all times where volumes are kept.
    pub volume_rate: f64,
    /// |skew F̈ F⁻¹| beside |F̈ F⁻¹|: zero at all times in a motion that preserves circulation, W(22.21).
    pub circulation: f64,
}

impl MotionConditions {
    /// Of a motion at a time.
    ///
    /// # Errors
    /// [`SolutionsError::Continuum`] where det F is not positive; [`SolutionsError::NotFinite`].
    ///
    /// # Accuracy
    /// A few ulp × the condition number of F.
    pub fn of(motion: &impl HomogeneousMotion, t: f64) -> Result<Self, SolutionsError> {
        check_finite("t", &[t])?;
        let rates = motion.rates(t)?;
        let velocity = motion.velocity_gradient(t)?.0;
        let acceleration = motion.acceleration_gradient(t)?.0;
        let ratio = |part: f64, whole: f64| if 0.0 < whole { part / whole } else { part };
        let speed = velocity.norm();
        let skew = (acceleration - acceleration.transpose()) * 0.5;
        Ok(Self {
            acceleration: ratio(acceleration.norm(), speed * speed),
            volume: rates.deformation.volume_change(),
            volume_rate: ratio(velocity.trace().abs(), speed),
            circulation: ratio(skew.norm(), acceleration.norm()),
        })
    }
}

/// ζ = −½ x·(F̈ F⁻¹) x, m²/s², of a motion x = F X that preserves circulation: a = −grad ζ, and p = ρ ζ + p₀(t) is the
/// pressure that the acceleration asks for.
///
/// # Errors
/// [`SolutionsError::NoPotential`] where F̈ F⁻¹ is not symmetric to 1e-12; as [`MotionConditions::of`].
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_solutions::homogeneous::{acceleration_potential, steady_extension};
/// let extension = steady_extension([2.0, -1.0, -1.0])?;
/// assert!((acceleration_potential(&extension, &Vector3::x(), 0.0)? + 2.0).abs() < 1e-14); // −½ · 2²
/// # Ok::<(), piola_solutions::SolutionsError>(())
/// ```
///
/// # Source
/// W(22.19–22.23).
pub fn acceleration_potential(
    motion: &impl HomogeneousMotion,
    place: &Vector3<f64>,
    t: f64,
) -> Result<f64, SolutionsError> {
    const ROUNDING: f64 = 1e-12;
    check_finite("place", place.as_slice())?;
    let gradient = motion.acceleration_gradient(t)?.0;
    let skew = (gradient - gradient.transpose()) * 0.5;
    let (residual, scale) = (skew.norm(), gradient.norm());
    if ROUNDING * scale < residual {
        let condition = "F̈ F⁻¹ symmetric";
        return Err(SolutionsError::NoPotential { condition, residual, scale, t });
    }
    Ok(-0.5 * place.dot(&(gradient * place)))
}

/// The steady extension F = exp(A t), A = diag(rates) with tr A = 0: it preserves circulation.
///
/// # Errors
/// [`SolutionsError::ConstraintViolated`] unless tr A = 0, with the third rate that satisfies it; [`SolutionsError::NotFinite`].
///
/// # Example
/// See [`acceleration_potential`].
///
/// # Source
/// W(22.24–22.28).
pub fn steady_extension(rates: [f64; 3]) -> Result<ExponentialMotion, SolutionsError> {
    check_finite("rates", &rates)?;
    let sum: f64 = rates.iter().sum();
    let scale: f64 = rates.iter().map(|rate| rate.abs()).sum();
    if 4.0 * f64::EPSILON * scale < sum.abs() {
        return Err(SolutionsError::ConstraintViolated {
            family: "steady extension",
            constraint: "tr A = 0",
            value: sum,
            constant: "the third rate",
            nearest: -(rates[0] + rates[1]),
        });
    }
    Ok(ExponentialMotion::new(Symmetric::diagonal(rates).matrix(), Matrix3::identity())?)
}

/// The steady simple shearing F = 1 + K t, K₂₁ = k, 1/s: it needs no body force in any homogeneous simple material.
///
/// # Errors
/// [`SolutionsError::OutOfBounds`] for a k that is not finite.
///
/// # Example
/// See [`MotionConditions`].
///
/// # Source
/// W(22.12–22.14).
pub fn simple_shearing(rate: f64) -> Result<LinearMotion, SolutionsError> {
    check_bound("k", rate, "finite", rate.is_finite())?;
    let mut k = Matrix3::zeros();
    k[(1, 0)] = rate;
    Ok(LinearMotion::new(Matrix3::identity(), k)?)
}
