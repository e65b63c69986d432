//! Equations of motion solved for the accelerations: q̈ = f(t, q, q̇).

use piola_numerics::Real;

use crate::IntegratorsError;
use crate::field::magnitudes_of_blocks;

/// A system of second order q̈ = f(t, q, q̇), over any scalar, the time too.
///
/// Methods for such systems do not integrate q̇ = v, which they know: they need fewer evaluations and less memory. A field
/// that is generic over its scalar is evaluated at several times at once, in the lanes of one number.
///
/// # Example
/// ```
/// use core::convert::Infallible;
/// use piola_integrators::SecondOrder;
/// use piola_numerics::{Lanes, Real};
/// struct Pendulum; // length 1 m, gravity 9.81 m/s²
/// impl<T: Real> SecondOrder<T> for Pendulum {
///     type Error = Infallible;
///     fn freedom(&self) -> usize {
///         1
///     }
///     #[cfg_attr(not(debug_assertions), inline(always))] // lanes gain only what is inlined
///     fn acceleration(&mut self, _t: T, q: &[T], _v: &[T], acceleration: &mut [T]) -> Result<(), Infallible> {
///         acceleration[0] = -T::lit(9.81) * q[0].sin();
///         Ok(())
///     }
/// }
/// let mut two = [Lanes([0.0; 2])]; // at two places at once
/// Pendulum.acceleration(Lanes([0.0, 0.1]), &[Lanes([0.0, 0.5])], &[Lanes([1.0, 0.9])], &mut two)?;
/// assert_eq!(two[0].0, [0.0, -9.81 * 0.5_f64.sin()]);
/// # Ok::<(), Infallible>(())
/// ```
#[doc(alias("equation of motion", "Nyström", "second-order system"))]
pub trait SecondOrder<T: Real = f64> {
    /// Why an evaluation can fail; [`Infallible`](core::convert::Infallible) when it cannot.
    type Error;
    /// Whether f depends on q̇; methods then need not compute it. The default is yes.
    ///
    /// Where it is false, the velocities given to [`acceleration`](Self::acceleration) mean nothing.
    const VELOCITY_DEPENDENT: bool = true;
    /// The number of coordinates where it is the same for every value of this type. The Nyström pairs then unroll
    /// their loops, and so does [`GaussLegendre16`](crate::GaussLegendre16) up to four.
    ///
    /// A run refuses a value that differs from [`freedom`](Self::freedom).
    const FREEDOM: Option<usize> = None;
    /// Whether [`magnitudes`](Self::magnitudes) is written for this type. The default is no: a method then compares errors with the
    /// largest position and the largest velocity, which costs it nothing for each component.
    const OWN_MAGNITUDES: bool = false;
    /// Whether this very system's f depends on q̇. The default is what its type says; a system that decides when it is made, as
    /// one with optional velocity-dependent forces, says so here.
    fn is_velocity_dependent(&self) -> bool {
        Self::VELOCITY_DEPENDENT
    }
    /// The number n of coordinates.
    fn freedom(&self) -> usize;
    /// Writes q̈ = f(t, q, q̇) to `acceleration`. All slices have the length of [`freedom`](Self::freedom).
    ///
    /// # Errors
    /// Whatever makes the acceleration undefined at (t, q, q̇).
    fn acceleration(&mut self, t: T, q: &[T], v: &[T], acceleration: &mut [T]) -> Result<(), Self::Error>;
    /// Writes the magnitude against which the error of each component of (q, q̇) is relative, as
    /// [`Field::magnitudes`](crate::Field::magnitudes). The Nyström pairs call it where
    /// [`OWN_MAGNITUDES`](Self::OWN_MAGNITUDES) is set; the other methods compare with the largest of each block.
    fn magnitudes(&self, state: &[T], magnitudes: &mut [f64]) {
        magnitudes_of_blocks(state, magnitudes);
    }
}

/// Refuses a system whose number of coordinates differs from the one its type states.
pub(crate) fn check_freedom<T: Real, F: SecondOrder<T>>(field: &F) -> Result<(), IntegratorsError<F::Error>> {
    let found = field.freedom();
    match F::FREEDOM {
        Some(expected) if expected != found => {
            Err(IntegratorsError::WrongLength { quantity: "field", expected, found })
        }
        _ => Ok(()),
    }
}
