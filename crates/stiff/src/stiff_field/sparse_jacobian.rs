//! The exact Jacobian of a field whose sparsity is known, in few passes.

use piola_integrators::{Field, IntegratorsError};
use piola_numerics::Gradient;

use super::{DIRECTIONS, Differentiable, Sparsity, StiffField, delegate_field};

/// A field that is generic over its scalar, with its exact sparse Jacobian.
///
/// Columns that share no row have one colour and are differentiated together: four colours in a pass. A chain of any
/// length, each of whose members depends on its two neighbours, takes one pass where
/// [`ExactJacobian`](crate::ExactJacobian) takes n/4. [`RadauIia`](crate::RadauIia) then stores and factors the sparse
/// matrices alone.
///
/// The pattern must hold every entry that can differ from zero: derivatives outside of it are lost, or added to others of
/// their row, and Newton's iteration then converges slowly or not at all. [`Sparsity::of_field`] finds the pattern.
///
/// # Accuracy
/// That of the field's own operations: there is no step width and no truncation.
///
/// # Example
/// ```
/// use core::convert::Infallible;
/// use piola_integrators::{Field, State, Tolerance};
/// use piola_stiff::{RadauIia, SparseJacobian, Sparsity};
/// use piola_numerics::Real;
/// const N: usize = 200;
/// struct Rod; // u̇ᵢ = N² (uᵢ₋₁ − 2uᵢ + uᵢ₊₁): diffusion on [0, 1] with zeros at the ends
/// impl<T: Real> Field<T> for Rod {
///     type Error = Infallible;
///     fn dimension(&self) -> usize {
///         N - 1
///     }
///     fn rate(&mut self, _t: f64, u: &[T], rate: &mut [T]) -> Result<(), Infallible> {
///         for i in 0..N - 1 {
///             let left = if i == 0 { T::zero() } else { u[i - 1] };
///             let right = if i + 2 == N { T::zero() } else { u[i + 1] };
///             rate[i] = T::lit((N * N) as f64) * (left - u[i] - u[i] + right);
///         }
///         Ok(())
///     }
/// }
/// let start: Vec<f64> = (1..N).map(|i| (core::f64::consts::PI * i as f64 / N as f64).sin()).collect();
/// let sparsity = Sparsity::of_field(&mut Rod, 0.0, &start)?;
/// let mut rod = SparseJacobian::new(Rod, sparsity)?;
/// assert_eq!((rod.colours(), rod.passes()), (3, 1));
/// let mut state = State::new(0.0, start)?;
/// RadauIia::new(Tolerance::relative(1e-8)?).integrate_to(&mut rod, &mut state, 0.1)?;
/// // The first mode decays with π², but for the error of the difference quotient.
/// let middle = state.values[N / 2 - 1] / (-0.1 * core::f64::consts::PI.powi(2)).exp();
/// assert!((middle - 1.0).abs() < 1e-4);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
///
/// # References
/// Curtis, Powell & Reid, *On the estimation of sparse Jacobian matrices*, J. Inst. Maths Applics 13 (1974) 117.
#[doc(alias("colouring", "coloring", "Curtis-Powell-Reid", "automatic differentiation"))]
#[derive(Clone, Debug)]
pub struct SparseJacobian<F> {
    field: F,
    sparsity: Sparsity,
    colours: usize,
    /// The columns in the order of their colours, each with its colour.
    columns: Vec<(usize, usize)>,
    point: Vec<Differentiable>,
    rate: Vec<Differentiable>,
}

impl<F: Field + Field<Differentiable, Error = <F as Field>::Error>> SparseJacobian<F> {
    /// Takes a field that is generic over its scalar, and the entries of its Jacobian that may differ from zero.
    ///
    /// # Errors
    /// [`IntegratorsError::WrongLength`] unless the pattern has the field's dimension.
    pub fn new(field: F, sparsity: Sparsity) -> Result<Self, IntegratorsError> {
        let (expected, found) = (<F as Field>::dimension(&field), sparsity.dimension());
        if expected != found {
            return Err(IntegratorsError::WrongLength { quantity: "sparsity", expected, found });
        }
        let (colour_of, colours) = sparsity.colouring();
        let mut columns: Vec<(usize, usize)> = colour_of.into_iter().enumerate().collect();
        columns.sort_by_key(|&(_, colour)| colour);
        let memory = vec![Gradient::constant(0.0); expected];
        Ok(Self { field, sparsity, colours, columns, point: memory.clone(), rate: memory })
    }

    /// The number of groups of columns that share no row.
    #[must_use]
    pub const fn colours(&self) -> usize {
        self.colours
    }

    /// Evaluations of the field over numbers with four derivatives that a Jacobian costs: ⌈colours/4⌉.
    #[must_use]
    pub const fn passes(&self) -> usize {
        self.colours.div_ceil(DIRECTIONS)
    }
}

impl<F: Field> Field for SparseJacobian<F> {
    delegate_field!(F);
}

impl<F: Field + Field<Differentiable, Error = <F as Field>::Error>> StiffField for SparseJacobian<F> {
    fn jacobian(&mut self, t: f64, y: &[f64], jacobian: &mut [f64]) -> Result<(), Self::Error> {
        for (point, &y) in self.point.iter_mut().zip(y) {
            *point = Gradient::constant(y);
        }
        let (starts, _) = self.sparsity.columns();
        for pass in self.columns.chunk_by(|(_, one), (_, other)| one / DIRECTIONS == other / DIRECTIONS) {
            for &(column, colour) in pass {
                self.point[column].partials[colour % DIRECTIONS] = 1.0;
            }
            <F as Field<Differentiable>>::rate(&mut self.field, t, &self.point, &mut self.rate)?;
            for &(column, colour) in pass {
                self.point[column].partials[colour % DIRECTIONS] = 0.0;
                let entries = jacobian.iter_mut().skip(starts[column]);
                for (entry, &row) in entries.zip(self.sparsity.rows_of(column)) {
                    *entry = self.rate[row].partials[colour % DIRECTIONS];
                }
            }
        }
        Ok(())
    }
    fn sparsity(&self) -> Option<&Sparsity> {
        Some(&self.sparsity)
    }
}
