//! Histories seen by other observers and from other references, and theorems of simple fluids on them.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::Symmetric;
use piola_continuum::rates::HomogeneousMotion;
use piola_numerics::Real;

use super::simple_fluid::SimpleFluid;
use crate::FluidsError;
use crate::error::check_bound;

/// A motion as a turning observer sees it: Q(t) F(t).
///
/// # Source
/// W(18.3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenFrom<M, Q> {
    /// F(t).
    pub motion: M,
    /// Q(t), orthogonal.
    pub observer: Q,
}

impl<M: HomogeneousMotion, Q: HomogeneousMotion> HomogeneousMotion for SeenFrom<M, Q> {
    fn gradient<T: Real>(&self, t: T) -> Matrix3<T> {
        self.observer.gradient(t) * self.motion.gradient(t)
    }
}

/// A motion from another reference: F(t) H.
///
/// # Source
/// W(18.24).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Referred<M> {
    /// F(t).
    pub motion: M,
    /// H; det H = 1 keeps the density.
    pub reference: Matrix3<f64>,
}

impl<M: HomogeneousMotion> HomogeneousMotion for Referred<M> {
    fn gradient<T: Real>(&self, t: T) -> Matrix3<T> {
        self.motion.gradient(t) * self.reference.map(T::lit)
    }
}

/// A violation relative to a size; 0 where both are.
fn ratio(violation: f64, size: f64) -> f64 {
    if 0.0 < size { violation / size } else { violation }
}

/// Relative violation of objectivity, W(19.11) and W(19.13): the difference between the stress seen by an observer who turns with Q(t)
/// and the turned stress, over the stress. Zero for a simple fluid.
///
/// A constant Q, which may be improper, tries the isotropy of the functional.
///
/// # Errors
/// As [`SimpleFluid::response_to_motion`].
///
/// # Accuracy
/// The `tolerance` of what is integrated; rounding and quadrature elsewhere.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fluids::{UpperConvectedMaxwell, fluid_indifference};
/// use piola_continuum::rates::ExponentialMotion;
/// let fluid = UpperConvectedMaxwell::new(2.0, 0.5)?;
/// let l = Matrix3::new(0.5, 1.0, 0.0, 0.0, -0.25, 0.5, 0.0, 0.0, -0.25);
/// let motion = ExponentialMotion::new(l, Matrix3::identity())?;
/// let observer = ExponentialMotion::new(Vector3::new(0.5, -2.0, 1.0).cross_matrix(), Matrix3::identity())?;
/// assert!(fluid_indifference(&fluid, motion, observer, 1.5, 1e-11)? < 1e-9);
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
pub fn fluid_indifference<M: HomogeneousMotion, Q: HomogeneousMotion>(
    fluid: &impl SimpleFluid,
    motion: M,
    observer: Q,
    t: f64,
    tolerance: f64,
) -> Result<f64, FluidsError> {
    let turn = observer.gradient(t);
    let stress = fluid.response_to_motion(&motion, t, tolerance)?.matrix();
    let seen = fluid.response_to_motion(&SeenFrom { motion, observer }, t, tolerance)?.matrix();
    Ok(ratio((seen - turn * stress * turn.transpose()).norm(), stress.norm()))
}

/// Relative change of the stress where the same motion is described from another reference of the same density, F(t) H with
/// det H = 1, W(19.6) and W(19.10): zero for a fluid.
///
/// # Errors
/// As [`SimpleFluid::response_to_motion`]; [`FluidsError::OutOfBounds`] unless det H = 1 to rounding.
///
/// # Accuracy
/// As [`fluid_indifference`].
pub fn reference_indifference<M: HomogeneousMotion>(
    fluid: &impl SimpleFluid,
    motion: M,
    reference: &Matrix3<f64>,
    t: f64,
    tolerance: f64,
) -> Result<f64, FluidsError> {
    let determinant = reference.determinant();
    let unimodular = (determinant - 1.0).abs() <= 1e-12 * (1.0 + reference.norm().powi(3));
    check_bound("change of reference", "det H", determinant, "det H = 1", unimodular)?;
    let stress = fluid.response_to_motion(&motion, t, tolerance)?.matrix();
    let seen = fluid.response_to_motion(&Referred { motion, reference: *reference }, t, tolerance)?.matrix();
    Ok(ratio((seen - stress).norm(), stress.norm()))
}

/// Deviations of a vector f from a proper vector of the history and of the stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneHistory {
    /// The largest |Cₜ(t − s) f − (f·Cₜ f) f| beside |Cₜ|, at times since the start: zero for a plane history.
    pub history: f64,
    /// |T f − (f·T f) f| beside |T + p 1|: then zero too.
    pub stress: f64,
}

/// Tries the theorem of plane histories, W(19.18): where f is a proper vector of all Uₜ(t − s), it is one of the stress.
///
/// # Errors
/// As [`SimpleFluid::response_to_motion`]; [`FluidsError::OutOfBounds`] for an f without direction.
///
/// # Accuracy
/// As [`fluid_indifference`].
///
/// # Example
/// See [`fluid_indifference`].
pub fn plane_history(
    fluid: &impl SimpleFluid,
    motion: &impl HomogeneousMotion,
    normal: &Vector3<f64>,
    t: f64,
    tolerance: f64,
) -> Result<PlaneHistory, FluidsError> {
    let size = normal.norm();
    check_bound("plane history", "|f|", size, "0 < |f|", 0.0 < size)?;
    let f = normal / size;
    let across = |a: &Symmetric| {
        let image = *a * f;
        ratio((image - f * f.dot(&image)).norm(), a.norm())
    };
    let mut history = 0.0_f64;
    for i in 1..=16 {
        let relative = motion.relative(t, -t * f64::from(i) / 16.0)?;
        history = history.max(across(&relative.right_cauchy_green()));
    }
    let stress = across(&fluid.response_to_motion(motion, t, tolerance)?);
    Ok(PlaneHistory { history, stress })
}
