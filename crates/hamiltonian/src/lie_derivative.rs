//! Lie derivatives along fields of vectors on phase space.
//!
//! ```text
//! L_k f      = k^j ∂_j f
//! (L_k α)_i  = k^j ∂_j α_i + α_j ∂_i k^j
//! (L_k β)_ij = k^m ∂_m β_ij + β_mj ∂_i k^m + β_im ∂_j k^m
//! L_k θ = −ω(k) + d(θ(k))                                                               W(9.18)
//! ```
//!
//! The flow of k keeps ω exactly where L_k ω = 0, W(9.15): then k is locally Hamiltonian.

use nalgebra::{DMatrix, DVector};
use piola_numerics::{Dual, Real};

use super::PhaseFunction;
use super::forms::{CanonicalTwoForm, OneForm, TwoForm, VectorField, check_dimension, jacobian_of};
use crate::HamiltonianError;
use crate::check::{check_finite, check_length};

/// k(x) and ∂_j k^i, entry (i, j).
fn with_gradient<T: Real>(field: &impl VectorField, x: &[T]) -> Result<(DVector<T>, DMatrix<T>), HamiltonianError> {
    let mut values = DVector::from_element(x.len(), T::zero());
    let mut gradient = DMatrix::from_element(x.len(), x.len(), T::zero());
    jacobian_of(x, values.as_mut_slice(), gradient.as_mut_slice(), |x, out| field.components(x, out));
    check_finite("x", x)?;
    check_finite("k", values.as_slice())?;
    check_finite("∂k", gradient.as_slice())?;
    Ok((values, gradient))
}

/// x moving along k.
fn moving<T: Real>(x: &[T], k: &[T]) -> Vec<Dual<T>> {
    x.iter().zip(k).map(|(&x, &k)| Dual::new(x, k)).collect()
}

/// The Lie derivative of a function along a field: the rate at which it grows where the flow of the field leads.
///
/// ```text
/// L_k f = k(f) = f_{,i} k^i
/// ```
///
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | k | `field` | as x | that of x over that of the parameter of the flow |
/// | f | `function` | scalar | \[f\] |
/// | x | `x` | (q, p) at the time 0, or (q, p, t) | those of q, p and t |
///
/// The result is in \[f\] over the unit of the parameter of the flow. Along Hamilton's field it is the Poisson bracket,
/// {f, H}, and along the extended one ∂f/∂t + {f, H}; the differential of f goes with it, L_k df = d(L_k f).
///
/// # Errors
/// [`HamiltonianError::NotFinite`], of the point, of the field or of the result.
///
/// # Accuracy
/// The derivative is exact to rounding: a few ulp of Σ |f_{,i} k^i| beside what f and k lose themselves.
///
/// # Source
/// W(9.14), W(9.17).
pub fn lie_derivative_of_function<T: Real>(
    field: &impl VectorField,
    function: &impl PhaseFunction,
    x: &[T],
) -> Result<T, HamiltonianError> {
    let mut k = vec![T::zero(); x.len()];
    field.components(x, &mut k);
    check_finite("x", x)?;
    check_finite("k", &k)?;
    let moving = moving(x, &k);
    let n = x.len() / 2;
    let (q, p) = moving[..2 * n].split_at(n);
    let time = moving.get(2 * n).copied().unwrap_or(Dual::constant(T::zero()));
    let result = function.value(q, p, time).tangent;
    check_finite("L_k f", &[result])?;
    Ok(result)
}

/// The Lie derivative of a form of degree one along a field.
///
/// # Errors
/// [`HamiltonianError::WrongLength`] where the form does not live; [`HamiltonianError::NotFinite`].
///
/// # Accuracy
/// Derivatives are exact to rounding.
///
/// # Example
/// The shear k = p ∂_q of phase space: θ(k) = p², ω(k) = ω(·, k) = p dp, and L_k θ = −p dp + 2p dp.
/// ```
/// use piola_hamiltonian::{CanonicalOneForm, VectorField, lie_derivative_of_one_form};
/// use piola_numerics::Real;
/// struct Shear;
/// impl VectorField for Shear {
///     fn components<T: Real>(&self, x: &[T], out: &mut [T]) {
///         out[0] = x[1];
///         out[1] = T::zero();
///     }
/// }
/// assert_eq!(lie_derivative_of_one_form(&Shear, &CanonicalOneForm, &[2.0, 3.0])?.as_slice(), [0.0, 3.0]);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(9.18), W(10.14).
pub fn lie_derivative_of_one_form<T: Real>(
    field: &impl VectorField,
    form: &impl OneForm,
    x: &[T],
) -> Result<DVector<T>, HamiltonianError> {
    check_dimension(form.accepts(x.len()), x.len())?;
    let (k, gradient) = with_gradient(field, x)?;
    let mut alpha = vec![Dual::constant(T::zero()); x.len()];
    form.components(&moving(x, k.as_slice()), &mut alpha);
    let component = |i: usize| (0..x.len()).fold(alpha[i].tangent, |sum, j| sum + alpha[j].value * gradient[(j, i)]);
    let result = DVector::from_fn(x.len(), |i, _| component(i));
    check_finite("L_k α", result.as_slice())?;
    Ok(result)
}

/// The Lie derivative of a form of degree two along a field.
///
/// # Errors
/// [`HamiltonianError::WrongLength`] where the form does not live; [`HamiltonianError::NotFinite`].
///
/// # Accuracy
/// Derivatives are exact to rounding.
///
/// # Source
/// W(9.15), W(10.13).
pub fn lie_derivative_of_two_form<T: Real>(
    field: &impl VectorField,
    form: &impl TwoForm,
    x: &[T],
) -> Result<DMatrix<T>, HamiltonianError> {
    check_dimension(form.accepts(x.len()), x.len())?;
    let (k, gradient) = with_gradient(field, x)?;
    lie_derivative_of(form, x, &k, &gradient)
}

fn lie_derivative_of<T: Real>(
    form: &impl TwoForm,
    x: &[T],
    k: &DVector<T>,
    gradient: &DMatrix<T>,
) -> Result<DMatrix<T>, HamiltonianError> {
    let d = x.len();
    let mut beta = vec![Dual::constant(T::zero()); d * d];
    form.entries(&moving(x, k.as_slice()), &mut beta);
    let entry = |i: usize, j: usize| {
        (0..d).fold(beta[i + j * d].tangent, |sum, m| {
            sum + (beta[m + j * d].value * gradient[(m, i)] + beta[i + m * d].value * gradient[(m, j)])
        })
    };
    let result = DMatrix::from_fn(d, d, entry);
    check_finite("L_k β", result.as_slice())?;
    Ok(result)
}

/// How far a field is from being locally Hamiltonian at a point.
///
/// # Example
/// See [`locally_hamiltonian_test`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LocallyHamiltonianTest {
    /// The entry of L_k ω that is largest beside the derivatives of k that it is made of, its own unit.
    pub residual: f64,
    /// That entry over the sum of the magnitudes of these derivatives: between 0 and 1, and some ulp for a locally
    /// Hamiltonian field.
    pub relative: f64,
    /// The row of the entry, in the order (q, p).
    pub row: usize,
    /// Its column.
    pub column: usize,
}

/// Tests whether a field is locally Hamiltonian at a point x = (q, p): whether L_k ω = 0.
///
/// # Errors
/// [`HamiltonianError::WrongLength`] where x has no even number of components; [`HamiltonianError::NotFinite`].
///
/// # Example
/// Friction shrinks areas of phase space, a rotation keeps them:
/// ```
/// use piola_hamiltonian::{VectorField, locally_hamiltonian_test};
/// use piola_numerics::Real;
/// struct Damped(f64); // q̇ = p, ṗ = −q − c p
/// impl VectorField for Damped {
///     fn components<T: Real>(&self, x: &[T], out: &mut [T]) {
///         out[0] = x[1];
///         out[1] = -x[0] - T::lit(self.0) * x[1];
///     }
/// }
/// assert_eq!(locally_hamiltonian_test(&Damped(0.0), &[1.0, 2.0])?.residual, 0.0);
/// let damped = locally_hamiltonian_test(&Damped(0.25), &[1.0, 2.0])?;
/// assert_eq!((damped.residual, damped.relative), (0.25, 1.0));
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(9.15–9.16).
pub fn locally_hamiltonian_test(
    field: &impl VectorField,
    x: &[f64],
) -> Result<LocallyHamiltonianTest, HamiltonianError> {
    check_length("x", 2 * (x.len() / 2), x.len())?;
    let n = x.len() / 2;
    let (k, gradient) = with_gradient(field, x)?;
    let derivative = lie_derivative_of(&CanonicalTwoForm, x, &k, &gradient)?;
    // L_k ω = dω(k): each entry is the difference of two derivatives of k.
    let conjugate = |i: usize| if i < n { n + i } else { i - n };
    let mut worst = LocallyHamiltonianTest { residual: 0.0, relative: 0.0, row: 0, column: 0 };
    for row in 0..2 * n {
        for column in 0..row {
            let scale = gradient[(conjugate(row), column)].abs() + gradient[(conjugate(column), row)].abs();
            let residual = derivative[(row, column)].abs();
            let relative = if residual <= 0.0 { 0.0 } else { residual / scale };
            if worst.relative < relative {
                worst = LocallyHamiltonianTest { residual, relative, row, column };
            }
        }
    }
    Ok(worst)
}
