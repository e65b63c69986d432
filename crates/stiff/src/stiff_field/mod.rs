//! What an implicit method for stiff problems needs of a field: its Jacobian, and perhaps a mass matrix.

use piola_integrators::Field;
use piola_integrators::internal::DIRECTIONS;
use piola_numerics::Gradient;

mod mass;
#[cfg(feature = "sparse")]
mod sparse_jacobian;
#[cfg(feature = "sparse")]
mod sparsity;

pub use self::mass::WithMass;
#[cfg(feature = "sparse")]
pub use self::sparse_jacobian::SparseJacobian;
#[cfg(feature = "sparse")]
pub use self::sparsity::Sparsity;

/// A field M ẏ = f(t, y) with its Jacobian ∂f/∂y.
///
/// Three types add a Jacobian to a [`Field`]:
///
/// | Jacobian | type | needs |
/// |---|---|---|
/// | exact, by differentiable numbers | [`ExactJacobian`] | a field that is generic over its scalar |
/// | by a function of yours | [`GivenJacobian`] | ∂fᵢ/∂yⱼ in closed form |
/// | by differences | [`DifferenceJacobian`] | nothing: any closure in `f64` |
///
/// [`WithMass`] adds a mass matrix to any of them. Matrices are stored down their columns, entry (i, j) at `i + j * n`.
#[cfg_attr(feature = "sparse", doc = "")]
#[cfg_attr(
    feature = "sparse",
    doc = "[`SparseJacobian`] is [`ExactJacobian`] for large systems in which each rate depends on few components: only the \
           entries that its [`Sparsity`] names are computed, stored and factored."
)]
///
/// # Example
/// ```
/// use piola_integrators::field;
/// use piola_stiff::{DifferenceJacobian, StiffField};
/// let mut decay = DifferenceJacobian::new(field(1, |_t, y: &[f64], rate: &mut [f64]| rate[0] = -50.0 * y[0]));
/// let mut jacobian = [0.0];
/// decay.jacobian(0.0, &[2.0], &mut jacobian)?;
/// assert!((jacobian[0] + 50.0).abs() < 1e-5);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[doc(alias("DAE", "mass matrix", "implicit"))]
pub trait StiffField: Field {
    /// Writes ∂f/∂y at (t, y), n×n down the columns, to `jacobian`.
    #[cfg_attr(
        feature = "sparse",
        doc = "\nWhere [`sparsity`](Self::sparsity) names the entries, `jacobian` has one place for each of them, in their order."
    )]
    ///
    /// # Errors
    /// Whatever makes the field undefined at (t, y).
    fn jacobian(&mut self, t: f64, y: &[f64], jacobian: &mut [f64]) -> Result<(), Self::Error>;
    /// M, constant, n×n down the columns; it may be singular. The default is none: ẏ = f(t, y).
    fn mass(&self) -> Option<&[f64]> {
        None
    }
    /// M by its nonzero entries (row, column, value), where [`mass`](Self::mass) is none. Repeated entries are added. The
    /// default is none.
    fn mass_entries(&self) -> Option<&[(usize, usize, f64)]> {
        None
    }
    /// The entries of ∂f/∂y that may differ from zero, if the field knows them. The default is none: all.
    #[cfg(feature = "sparse")]
    fn sparsity(&self) -> Option<&Sparsity> {
        None
    }
    /// The differentiation index of a component, 1 or 2; a higher one is refused. The default is 1.
    ///
    /// Components of a constrained system that only the first derivative of the constraints determines, as the
    /// reactions of constraints on velocities, have index 2: errors of theirs are weighted with the step.
    #[doc(alias("differentiation index", "Lagrange multiplier"))]
    fn index(&self, _component: usize) -> u32 {
        1
    }
}

/// Delegates [`Field`] to the field `self.field`.
macro_rules! delegate_field {
    ($F:ident) => {
        type Error = <$F as Field>::Error;
        fn dimension(&self) -> usize {
            <$F as Field>::dimension(&self.field)
        }
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Self::Error> {
            <$F as Field>::rate(&mut self.field, t, y, rate)
        }
        fn is_second_order(&self) -> bool {
            <$F as Field>::is_second_order(&self.field)
        }
        fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), Self::Error> {
            <$F as Field>::project(&mut self.field, t, y)
        }
        fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]) {
            <$F as Field>::magnitudes(&self.field, y, magnitudes);
        }
    };
}
use delegate_field;

/// Numbers with derivatives in four directions, over which [`ExactJacobian`] evaluates a field.
pub type Differentiable = Gradient<f64, DIRECTIONS>;

/// A field that is generic over its scalar, with its exact Jacobian.
///
/// A Jacobian costs n/4 evaluations over numbers with four derivatives, about as much as n + n/4 in `f64`.
///
/// # Accuracy
/// That of the field's own operations: there is no step width and no truncation.
///
/// # Example
/// ```
/// use core::convert::Infallible;
/// use piola_integrators::Field;
/// use piola_stiff::{ExactJacobian, StiffField};
/// use piola_numerics::Real;
/// struct VanDerPol; // ẍ = 10⁶ ((1 − x²) ẋ − x)
/// impl<T: Real> Field<T> for VanDerPol {
///     type Error = Infallible;
///     fn dimension(&self) -> usize {
///         2
///     }
///     fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
///         rate[0] = y[1];
///         rate[1] = T::lit(1e6) * ((T::one() - y[0] * y[0]) * y[1] - y[0]);
///         Ok(())
///     }
/// }
/// let mut jacobian = [0.0; 4];
/// ExactJacobian::new(VanDerPol).jacobian(0.0, &[2.0, 1.0], &mut jacobian)?;
/// assert_eq!(jacobian, [0.0, -5e6, 1.0, -3e6]); // down the columns
/// # Ok::<(), Infallible>(())
/// ```
#[doc(alias("automatic differentiation"))]
#[derive(Clone, Debug)]
pub struct ExactJacobian<F> {
    field: F,
    point: Vec<Differentiable>,
    rate: Vec<Differentiable>,
}

impl<F: Field + Field<Differentiable, Error = <F as Field>::Error>> ExactJacobian<F> {
    /// Takes a field that is generic over its scalar.
    pub fn new(field: F) -> Self {
        let memory = vec![Gradient::constant(0.0); <F as Field>::dimension(&field)];
        Self { field, point: memory.clone(), rate: memory }
    }
}

impl<F: Field> Field for ExactJacobian<F> {
    delegate_field!(F);
}

impl<F: Field + Field<Differentiable, Error = <F as Field>::Error>> StiffField for ExactJacobian<F> {
    fn jacobian(&mut self, t: f64, y: &[f64], jacobian: &mut [f64]) -> Result<(), Self::Error> {
        let n = y.len();
        self.point.resize(n, Gradient::constant(0.0));
        self.rate.resize(n, Gradient::constant(0.0));
        for first in (0..n).step_by(DIRECTIONS) {
            for (i, (point, &y)) in self.point.iter_mut().zip(y).enumerate() {
                // Before `first` the difference wraps to a number that is no direction.
                *point = Gradient::variable(y, i.wrapping_sub(first));
            }
            <F as Field<Differentiable>>::rate(&mut self.field, t, &self.point, &mut self.rate)?;
            for (i, rate) in self.rate.iter().enumerate() {
                for (column, &partial) in (first..n).zip(&rate.partials) {
                    jacobian[i + column * n] = partial;
                }
            }
        }
        Ok(())
    }
}

/// A field with a Jacobian by forward differences, for closures in `f64`.
///
/// A Jacobian costs n + 1 evaluations, which [`Report`](piola_integrators::Report) does not count. The increment of yⱼ is √ε times
/// its [magnitude](Field::magnitudes) or |yⱼ|, whichever is larger.
///
/// # Accuracy
/// About half the digits of `f64`: Newton's iteration converges somewhat slower, its solution is the same.
///
/// # Example
/// See [`StiffField`].
#[doc(alias("finite differences"))]
#[derive(Clone, Debug)]
pub struct DifferenceJacobian<F> {
    field: F,
    point: Vec<f64>,
    rate: Vec<f64>,
    magnitudes: Vec<f64>,
}

impl<F: Field> DifferenceJacobian<F> {
    /// Takes any field.
    pub fn new(field: F) -> Self {
        let memory = vec![0.0; field.dimension()];
        Self { field, point: memory.clone(), rate: memory.clone(), magnitudes: memory }
    }
}

impl<F: Field> Field for DifferenceJacobian<F> {
    delegate_field!(F);
}

impl<F: Field> StiffField for DifferenceJacobian<F> {
    fn jacobian(&mut self, t: f64, y: &[f64], jacobian: &mut [f64]) -> Result<(), Self::Error> {
        let n = y.len();
        for memory in [&mut self.point, &mut self.rate, &mut self.magnitudes] {
            memory.resize(n, 0.0);
        }
        self.point.copy_from_slice(y);
        self.field.magnitudes(y, &mut self.magnitudes);
        self.field.rate(t, y, &mut self.rate)?;
        for (j, column) in jacobian.chunks_exact_mut(n.max(1)).enumerate() {
            let size = self.magnitudes[j].max(y[j].abs());
            let size = if 0.0 < size { size } else { 1.0 };
            // Upwards in size, so that a positive concentration stays positive.
            self.point[j] = y[j] + (f64::EPSILON.sqrt() * size).copysign(y[j]);
            let increment = self.point[j] - y[j];
            self.field.rate(t, &self.point, column)?;
            for (entry, &rate) in column.iter_mut().zip(&self.rate) {
                *entry = (*entry - rate) / increment;
            }
            self.point[j] = y[j];
        }
        Ok(())
    }
}

/// A field with a Jacobian by a function J(t, y, jacobian), down the columns, into zeros.
///
/// # Example
/// ```
/// use piola_integrators::field;
/// use piola_stiff::{GivenJacobian, StiffField};
/// let decay = field(1, |_t, y: &[f64], rate: &mut [f64]| rate[0] = -50.0 * y[0]);
/// let mut decay = GivenJacobian::new(decay, |_t, _y: &[f64], jacobian: &mut [f64]| jacobian[0] = -50.0);
/// let mut jacobian = [0.0];
/// decay.jacobian(0.0, &[2.0], &mut jacobian)?;
/// assert_eq!(jacobian, [-50.0]);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct GivenJacobian<F, J> {
    field: F,
    jacobian: J,
}

impl<F: Field, J: FnMut(f64, &[f64], &mut [f64])> GivenJacobian<F, J> {
    /// Takes a field and the function that writes the nonzero entries of its Jacobian.
    pub fn new(field: F, jacobian: J) -> Self {
        Self { field, jacobian }
    }
}

impl<F: Field, J> Field for GivenJacobian<F, J> {
    delegate_field!(F);
}

impl<F: Field, J: FnMut(f64, &[f64], &mut [f64])> StiffField for GivenJacobian<F, J> {
    fn jacobian(&mut self, t: f64, y: &[f64], jacobian: &mut [f64]) -> Result<(), Self::Error> {
        jacobian.fill(0.0);
        (self.jacobian)(t, y, jacobian);
        Ok(())
    }
}
