//! Products of covectors with Jacobians.

use core::convert::Infallible;

use piola_numerics::{Gradient, Real};

use super::{DIRECTIONS, Directional};

/// A covector λ and the sums to which its products λᵀ ∂f/∂y and λᵀ ∂f/∂p are added.
///
/// # Example
/// ```
/// use core::convert::Infallible;
/// use piola_integrators::{JacobianProduct, ParametricField};
/// use piola_numerics::Real;
/// /// ẏ = p y², with its product in closed form.
/// struct Blowup;
/// impl ParametricField for Blowup {
///     type Error = Infallible;
///     fn dimension(&self) -> usize {
///         1
///     }
///     fn parameters(&self) -> usize {
///         1
///     }
///     fn rate<T: Real>(&self, _t: f64, y: &[T], p: &[T], rate: &mut [T]) -> Result<(), Infallible> {
///         rate[0] = p[0] * y[0] * y[0];
///         Ok(())
///     }
///     fn vector_jacobian_product<T: Real>(
///         &self, _t: f64, y: &[T], p: &[T], product: &mut JacobianProduct<T>,
///     ) -> Result<(), Infallible> {
///         let (lambda, by_state, by_parameters) = product.parts();
///         by_state[0] += T::lit(2.0) * lambda[0] * p[0] * y[0];
///         by_parameters[0] += lambda[0] * y[0] * y[0];
///         Ok(())
///     }
/// }
/// let mut product = JacobianProduct::of(vec![1.0], 1);
/// Blowup.vector_jacobian_product(0.0, &[3.0], &[0.5], &mut product)?;
/// assert_eq!((product.by_state(), product.by_parameters()), (&[3.0][..], &[9.0][..]));
/// # Ok::<(), Infallible>(())
/// ```
#[doc(alias("VJP", "pullback", "reverse mode"))]
#[derive(Clone, Debug)]
pub struct JacobianProduct<T = f64> {
    covector: Vec<T>,
    by_state: Vec<T>,
    by_parameters: Vec<T>,
    y: Vec<Directional<T>>,
    p: Vec<Directional<T>>,
    rate: Vec<Directional<T>>,
}

impl<T: Real> JacobianProduct<T> {
    /// A covector of n components, with sums for m parameters, all zero.
    #[must_use]
    pub fn of(covector: Vec<T>, m: usize) -> Self {
        let n = covector.len();
        let mut product = Self::empty();
        product.covector = covector;
        product.resize(n, m);
        product
    }

    /// The covector λ, and the sums of λᵀ ∂f/∂y and λᵀ ∂f/∂p, to which an implementation adds. The lengths are n, n and m.
    pub fn parts(&mut self) -> (&[T], &mut [T], &mut [T]) {
        (&self.covector, &mut self.by_state, &mut self.by_parameters)
    }

    /// The sum of λᵀ ∂f/∂y, n components.
    #[must_use]
    pub fn by_state(&self) -> &[T] {
        &self.by_state
    }

    /// The sum of λᵀ ∂f/∂p, m components.
    #[must_use]
    pub fn by_parameters(&self) -> &[T] {
        &self.by_parameters
    }

    /// Of no components.
    pub(super) fn empty() -> Self {
        let [covector, by_state, by_parameters] = [const { Vec::new() }; 3];
        let [y, p, rate] = [const { Vec::new() }; 3];
        Self { covector, by_state, by_parameters, y, p, rate }
    }

    /// The covector, to be written.
    pub(super) fn covector_mut(&mut self) -> &mut [T] {
        &mut self.covector
    }

    /// Sets the sums by the state to zero.
    pub(super) fn clear_by_state(&mut self) {
        self.by_state.fill(T::zero());
    }

    /// Sets the sums by the parameters to zero.
    pub(super) fn clear_by_parameters(&mut self) {
        self.by_parameters.fill(T::zero());
    }

    /// Makes room for n components and m parameters.
    pub(super) fn resize(&mut self, n: usize, m: usize) {
        self.covector.resize(n, T::zero());
        self.by_state.resize(n, T::zero());
        self.by_parameters.resize(m, T::zero());
        let constant = Gradient::constant(T::zero());
        self.y.resize(n, constant);
        self.p.resize(m, constant);
        self.rate.resize(n, constant);
    }

    /// Adds the products of the covector with the Jacobians of a rate, by differentiable numbers.
    pub(super) fn add_of_rate<E>(
        &mut self,
        y: &[T],
        p: &[T],
        mut rate: impl FnMut(&[Directional<T>], &[Directional<T>], &mut [Directional<T>]) -> Result<(), E>,
    ) -> Result<(), E> {
        self.add(y, p, |covector, y, p, out| {
            rate(y, p, out)?;
            let mut sums = [T::zero(); DIRECTIONS];
            for (&lambda, rate) in covector.iter().zip(&*out) {
                for (sum, &partial) in sums.iter_mut().zip(&rate.partials) {
                    *sum += lambda * partial;
                }
            }
            Ok(sums)
        })
    }

    /// Adds the gradient of a function times a weight, by differentiable numbers.
    pub(super) fn add_of_scalar(
        &mut self,
        y: &[T],
        p: &[T],
        weight: T,
        mut function: impl FnMut(&[Directional<T>], &[Directional<T>]) -> Directional<T>,
    ) {
        let added = self.add(y, p, |_, y, p, _| Ok(function(y, p).partials.map(|partial| weight * partial)));
        match added {
            Ok(()) => {}
            Err::<(), Infallible>(never) => match never {},
        }
    }

    /// Evaluates over y and p with the derivatives of each chunk of directions, and adds what is returned for each of them.
    fn add<E>(
        &mut self,
        y: &[T],
        p: &[T],
        mut derivatives: impl FnMut(
            &[T],
            &[Directional<T>],
            &[Directional<T>],
            &mut [Directional<T>],
        ) -> Result<[T; DIRECTIONS], E>,
    ) -> Result<(), E> {
        self.resize(y.len(), p.len());
        let Self { covector, by_state, by_parameters, y: y_at, p: p_at, rate } = self;
        for (at, &value) in y_at.iter_mut().zip(y).chain(p_at.iter_mut().zip(p)) {
            *at = Gradient::constant(value);
        }
        let directions = y.len() + p.len();
        for first in (0..directions).step_by(DIRECTIONS) {
            let seed = |y_at: &mut [Directional<T>], p_at: &mut [Directional<T>], value: T| {
                let inputs = y_at.iter_mut().chain(p_at).skip(first);
                for (slot, input) in inputs.take(DIRECTIONS).enumerate() {
                    input.partials[slot] = value;
                }
            };
            seed(y_at, p_at, T::one());
            let sums = derivatives(covector, y_at, p_at, rate)?;
            seed(y_at, p_at, T::zero());
            for (sum, &term) in by_state.iter_mut().chain(&mut *by_parameters).skip(first).zip(&sums) {
                *sum += term;
            }
        }
        Ok(())
    }
}
