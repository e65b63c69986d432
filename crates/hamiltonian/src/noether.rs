//! Integrals and symmetries, each from the other.
//!
//! ```text
//! K an integral          ⇔   the flow of k = ω⁻¹(dK) keeps H                              W(9.27), W p. 58
//! a group of canonical maps that keeps H   ⇒   ω(k) = dK, K an integral
//! ```

use core::ops::ControlFlow;

use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_numerics::{Dual, Real};

use super::differential::with_room;
use super::forms::{CanonicalTwoForm, VectorField};
use super::integrals::PhasePoint;
use super::lie_derivative::{LocallyHamiltonianTest, locally_hamiltonian_test};
use super::{HamiltonianField, PhaseFunction};
use crate::HamiltonianError;
use crate::check::{check_finite, check_length};
use piola_lagrangian::Action;
use piola_lagrangian::internal::integrate;

/// K at a fixed time.
struct AtTime<'a, K> {
    function: &'a K,
    time: f64,
}

impl<K: PhaseFunction> PhaseFunction for AtTime<'_, K> {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        self.function.value(q, p, T::lit(self.time))
    }
}

/// The flow of a function on phase space, and what it does to the Hamiltonian.
///
/// # Example
/// See [`symmetry_flow`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SymmetryFlow {
    /// The point reached.
    pub end: PhasePoint,
    /// The largest |H − H₀| on the way, J: rounding and the error of the integration where K is an integral.
    pub change_of_hamiltonian: f64,
    /// H₀, J.
    pub hamiltonian: f64,
}

/// Follows the flow of K, dq/dτ = ∂K/∂p, dp/dτ = −∂K/∂q, at a fixed time, and watches H.
///
/// Where K is an integral of H and neither depends on time, H stays what it is: the flow is a symmetry. The unit of τ is
/// that of J s over the unit of K: an angle for a angular momentum, a length for a momentum.
///
/// # Errors
/// [`HamiltonianError::NotFinite`]; [`HamiltonianError::Run`] when the flow cannot be followed that far.
///
/// # Example
/// The angular momentum turns the plane, here by a right angle:
/// ```
/// use piola_hamiltonian::{PhaseFunction, PhasePoint, symmetry_flow};
/// use piola_integrators::Tolerance;
/// use piola_numerics::Real;
/// struct Kepler;
/// impl PhaseFunction for Kepler {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * (p[0] * p[0] + p[1] * p[1]) - (q[0] * q[0] + q[1] * q[1]).sqrt().recip()
///     }
/// }
/// struct Moment;
/// impl PhaseFunction for Moment {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         q[0] * p[1] - q[1] * p[0]
///     }
/// }
/// let start = PhasePoint::new(&[1.0, 0.0], &[0.25, 1.0], 0.0)?;
/// let angle = std::f64::consts::FRAC_PI_2;
/// let flow = symmetry_flow(&Moment, &Kepler, &start, angle, Tolerance::relative(1e-12)?)?;
/// assert!((flow.end.q()[1] - 1.0).abs() < 1e-11 && (flow.end.p()[0] + 1.0).abs() < 1e-11);
/// assert!(flow.change_of_hamiltonian < 1e-11);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(9.27), W(10.18).
pub fn symmetry_flow(
    function: &impl PhaseFunction,
    hamiltonian: &impl PhaseFunction,
    start: &PhasePoint,
    parameter: f64,
    tolerance: Tolerance,
) -> Result<SymmetryFlow, HamiltonianError> {
    check_finite("parameter", &[parameter])?;
    let (n, t) = (start.q().len(), start.time());
    let at_start = hamiltonian.value(start.q(), start.p(), t);
    check_finite("H", &[at_start])?;
    let frozen = AtTime { function, time: t };
    let mut field = HamiltonianField::new(&frozen, n);
    let refused = |source| HamiltonianError::Run { time: t, source: Box::new(source) };
    let mut state = State::new(0.0, [start.q(), start.p()].concat()).map_err(|_| HamiltonianError::NotFinite {
        quantity: "start",
        index: 0,
        value: f64::NAN,
    })?;
    let mut largest = 0.0_f64;
    DormandPrince853::new(tolerance)
        .integrate(&mut field, &mut state, parameter, |step| {
            let (q, p) = step.values().split_at(n);
            largest = largest.max((hamiltonian.value(q, p, t) - at_start).abs());
            ControlFlow::Continue(())
        })
        .map_err(refused)?;
    let (q, p) = state.values.split_at(n);
    Ok(SymmetryFlow { end: PhasePoint::new(q, p, t)?, change_of_hamiltonian: largest, hamiltonian: at_start })
}

/// A group of maps of phase space with one parameter, the identity at zero, written once for any scalar.
///
/// # Example
/// See [`Generator`].
///
/// # Source
/// W p. 58.
pub trait OneParameterGroup {
    /// Writes the image (Q, P) of (q, p) for a parameter.
    fn act<T: Real>(&self, parameter: T, q: &[T], p: &[T], new: &mut [T]);
}

/// The generator of a group: the field of velocities of its maps at the identity, by exact derivatives.
///
/// # Example
/// A shift along x has the generator ∂_x, whose integral is p_x:
/// ```
/// use piola_hamiltonian::{Generator, OneParameterGroup, PhasePoint, integral_of_symmetry};
/// use piola_integrators::Tolerance;
/// use piola_numerics::Real;
/// struct Shift;
/// impl OneParameterGroup for Shift {
///     fn act<T: Real>(&self, parameter: T, q: &[T], p: &[T], new: &mut [T]) {
///         new[0] = q[0] + parameter;
///         new[1] = p[0];
///     }
/// }
/// let (from, to) = (PhasePoint::new(&[0.0], &[0.0], 0.0)?, PhasePoint::new(&[5.0], &[3.0], 0.0)?);
/// let momentum = integral_of_symmetry(&Generator(Shift), &from, &to, Tolerance::relative(1e-13)?)?;
/// assert!((momentum.value - 3.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W p. 58.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Generator<G>(pub G);

impl<G: OneParameterGroup> VectorField for Generator<G> {
    fn components<T: Real>(&self, x: &[T], out: &mut [T]) {
        let zero = Dual::constant(T::zero());
        with_room(zero, x.len(), |point| {
            for (point, &x) in point.iter_mut().zip(x) {
                *point = Dual::constant(x);
            }
            with_room(zero, x.len(), |image| {
                let (q, p) = point.split_at(x.len() / 2);
                self.0.act(Dual::variable(T::zero()), q, p, image);
                for (out, image) in out.iter_mut().zip(image) {
                    *out = image.tangent;
                }
            });
        });
    }
}

/// How far a field may be from locally Hamiltonian, relative to its derivatives.
const LOCALLY_HAMILTONIAN: f64 = 1e-10;

/// The integral of a symmetry, K(to) − K(from), by quadrature of ω(k) along the straight line between the points.
///
/// ```text
/// dK = ω(k)        K(to) − K(from) = ∫₀¹ ω(dx/ds, k) ds
/// ```
///
/// The field should be defined along the line. It is tested for being locally Hamiltonian at both ends and in the
/// middle.
///
/// # Errors
/// [`HamiltonianError::NotLocallyHamiltonian`] with the worst entry of L_k ω; [`HamiltonianError::WrongLength`];
/// [`HamiltonianError::NotFinite`]; [`LagrangianError::QuadratureNotConverged`](piola_lagrangian::LagrangianError::QuadratureNotConverged).
///
/// # Source
/// W(9.16), W p. 58.
pub fn integral_of_symmetry(
    field: &impl VectorField,
    from: &PhasePoint,
    to: &PhasePoint,
    tolerance: Tolerance,
) -> Result<Action, HamiltonianError> {
    check_length("q of the end", from.q().len(), to.q().len())?;
    let start = [from.q(), from.p()].concat();
    let way: Vec<f64> = to.q().iter().chain(to.p()).zip(&start).map(|(end, start)| end - start).collect();
    let (mut x, mut k) = (start.clone(), vec![0.0; start.len()]);
    for fraction in [0.0, 0.5, 1.0] {
        place(&start, &way, fraction, &mut x);
        let LocallyHamiltonianTest { residual, relative, row, column } = locally_hamiltonian_test(field, &x)?;
        if LOCALLY_HAMILTONIAN < relative {
            return Err(HamiltonianError::NotLocallyHamiltonian { residual, relative, row, column });
        }
    }
    let allowed = (tolerance.relative_part(), tolerance.absolute_part());
    let integrals = integrate((0.0, 1.0), allowed, |fraction| {
        place(&start, &way, fraction, &mut x);
        field.components(&x, &mut k);
        check_finite("k", &k)?;
        Ok::<_, HamiltonianError>([CanonicalTwoForm.of(&way, &k)])
    })?;
    let ([value], [error]) = (integrals.values, integrals.errors);
    Ok(Action { value, error })
}

/// start + fraction way.
fn place(start: &[f64], way: &[f64], fraction: f64, x: &mut [f64]) {
    for ((x, start), way) in x.iter_mut().zip(start).zip(way) {
        *x = start + fraction * way;
    }
}
