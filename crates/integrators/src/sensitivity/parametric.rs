//! Fields with parameters.

use piola_numerics::Real;

use super::{JacobianProduct, check_parameters};
use crate::field::magnitudes_of_blocks;
use crate::{Field, IntegratorsError};

/// A first-order system with parameters, ẏ = f(t, y, p), over any scalar.
///
/// # Example
/// ```
/// use core::convert::Infallible;
/// use piola_integrators::{DormandPrince853, ParametricField, State, Tolerance, WithParameters};
/// use piola_numerics::Real;
/// /// ẏ = p y.
/// struct Growth;
/// impl ParametricField for Growth {
///     type Error = Infallible;
///     fn dimension(&self) -> usize {
///         1
///     }
///     fn parameters(&self) -> usize {
///         1
///     }
///     fn rate<T: Real>(&self, _t: f64, y: &[T], p: &[T], rate: &mut [T]) -> Result<(), Infallible> {
///         rate[0] = p[0] * y[0];
///         Ok(())
///     }
/// }
/// let mut state = State::new(0.0, vec![1.0])?;
/// let mut growth = WithParameters::new(&Growth, &[2.0])?;
/// DormandPrince853::new(Tolerance::relative(1e-13)?).integrate_to(&mut growth, &mut state, 1.0)?;
/// assert!((state.values[0] - 2.0_f64.exp()).abs() < 1e-12);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("parameter estimation", "ODE"))]
pub trait ParametricField {
    /// Why an evaluation can fail; [`Infallible`](core::convert::Infallible) when it cannot.
    type Error;
    /// The number n of components of y.
    fn dimension(&self) -> usize;
    /// The number m of parameters p.
    fn parameters(&self) -> usize;
    /// Writes f(t, y, p) to `rate`. The lengths are n, m and n.
    ///
    /// The same arguments must give the same rate: steps are made again.
    ///
    /// # Errors
    /// Whatever makes the field undefined at (t, y, p).
    fn rate<T: Real>(&self, t: f64, y: &[T], p: &[T], rate: &mut [T]) -> Result<(), Self::Error>;
    /// Writes the magnitude against which the error of each component is relative: as [`Field::magnitudes`].
    fn magnitudes<T: Real>(&self, y: &[T], magnitudes: &mut [f64]) {
        magnitudes_of_blocks(y, magnitudes);
    }
    /// Adds the product of a covector λ with the Jacobians to `product`, for [`AdjointSensitivity`](super::AdjointSensitivity).
    ///
    /// ```text
    /// by_state ← by_state + λᵀ ∂f/∂y        by_parameters ← by_parameters + λᵀ ∂f/∂p
    /// ```
    ///
    /// The default evaluates [`rate`](Self::rate) (n + m)/4 times over numbers with four derivatives. A product in closed form costs
    /// about as much as one evaluation: give one where m is large.
    ///
    /// # Errors
    /// Whatever makes the field undefined at (t, y, p).
    fn vector_jacobian_product<T: Real>(
        &self,
        t: f64,
        y: &[T],
        p: &[T],
        product: &mut JacobianProduct<T>,
    ) -> Result<(), Self::Error> {
        product.add_of_rate(y, p, |y, p, rate| self.rate(t, y, p, rate))
    }
}

/// A field with given values of its parameters, as a [`Field`] that every method for first-order systems integrates.
///
/// # Example
/// See [`ParametricField`].
#[derive(Clone, Copy, Debug)]
pub struct WithParameters<'a, F, T = f64> {
    field: &'a F,
    p: &'a [T],
}

impl<'a, F: ParametricField, T: Real> WithParameters<'a, F, T> {
    /// The field at the parameters p.
    ///
    /// # Errors
    /// Their number is not the field's, or one of them is not finite.
    pub fn new(field: &'a F, p: &'a [T]) -> Result<Self, IntegratorsError<F::Error>> {
        check_parameters(field, p)?;
        Ok(Self { field, p })
    }
}

impl<F: ParametricField, T: Real> Field<T> for WithParameters<'_, F, T> {
    type Error = F::Error;
    fn dimension(&self) -> usize {
        self.field.dimension()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), F::Error> {
        self.field.rate(t, y, self.p, rate)
    }
    fn magnitudes(&self, y: &[T], magnitudes: &mut [f64]) {
        self.field.magnitudes(y, magnitudes);
    }
}
