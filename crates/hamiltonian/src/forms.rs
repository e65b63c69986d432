//! Differential forms on phase space, the canonical ones among them.
//!
//! ```text
//! θ = p dq                ω = dθ = dp ∧ dq                                              W(8.11), W(8.20–8.24)
//! θ̃ = p dq − H dt         ω̃ = dθ̃ = dp ∧ dq − dH ∧ dt                                    W(10.10–10.11)
//! ```
//!
//! Points are written x = (q, p), or x = (q, p, t) for the extended forms. As a map from vectors to covectors a form of
//! degree two fills its second place, ω(v) = ω(·, v), so that ω(h) = dH for Hamilton's field h.

use nalgebra::{DMatrix, DVector};
use piola_numerics::{Gradient, Real};

use super::PhaseFunction;
use super::differential::{CHUNK, differentiate_at, rate_in_time};
use crate::HamiltonianError;
use crate::check::{check_finite, check_length};

/// A form of degree one, α = α_i(x) dx^i, written once for any scalar.
///
/// # Example
/// See [`exterior_derivative`].
///
/// # Source
/// W(8.11).
pub trait OneForm {
    /// Whether the form lives where x has so many components; any number by default.
    fn accepts(&self, _dimension: usize) -> bool {
        true
    }
    /// Writes the components α_i(x), as many as x has.
    fn components<T: Real>(&self, x: &[T], out: &mut [T]);
}

/// A form of degree two, β = ½ β_ij(x) dx^i ∧ dx^j, written once for any scalar.
///
/// # Example
/// See [`closedness_residual`].
///
/// # Source
/// W(8.21).
pub trait TwoForm {
    /// Whether the form lives where x has so many components; any number by default.
    fn accepts(&self, _dimension: usize) -> bool {
        true
    }
    /// Writes the entries β_ij(x) = β(∂_i, ∂_j), entry (i, j) at `i + j * dimension`.
    fn entries<T: Real>(&self, x: &[T], out: &mut [T]);
}

/// The canonical form of degree one, θ = p dq, on x = (q, p).
///
/// # Example
/// ```
/// use piola_hamiltonian::CanonicalOneForm;
/// // A motion with q̇ = (5, 7): θ = p·q̇, whatever ṗ is.
/// assert_eq!(CanonicalOneForm.along(&[2.0, 3.0], &[5.0, 7.0]), 31.0);
/// ```
///
/// # Source
/// W(8.11–8.19).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CanonicalOneForm;

impl CanonicalOneForm {
    /// θ(x)(k) = p·q̇ for a vector k = (q̇, ṗ), of which only q̇ matters. The shorter list is the one that counts.
    pub fn along<T: Real>(self, p: &[T], velocity: &[T]) -> T {
        p.iter().zip(velocity).fold(T::zero(), |sum, (&p, &v)| sum + p * v)
    }
}

impl OneForm for CanonicalOneForm {
    fn accepts(&self, dimension: usize) -> bool {
        dimension.is_multiple_of(2)
    }
    fn components<T: Real>(&self, x: &[T], out: &mut [T]) {
        let n = x.len() / 2;
        out[..n].copy_from_slice(&x[n..]);
        out[n..].fill(T::zero());
    }
}

/// The canonical form of degree two, ω = dp ∧ dq, on x = (q, p): skew, closed and not degenerate.
///
/// # Example
/// ```
/// use piola_hamiltonian::CanonicalTwoForm;
/// let (u, v) = ([1.0, 2.0], [3.0, 5.0]); // (δq, δp)
/// assert_eq!(CanonicalTwoForm.of(&u, &v), 2.0 * 3.0 - 1.0 * 5.0);
/// let mut covector = [0.0; 2];
/// CanonicalTwoForm.lower_into(&v, &mut covector); // ω(·, v)
/// assert_eq!(covector, [-5.0, 3.0]);
/// let mut back = [0.0; 2];
/// CanonicalTwoForm.raise_into(&covector, &mut back);
/// assert_eq!(back, v);
/// ```
///
/// # Source
/// W(8.20–8.24).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CanonicalTwoForm;

impl CanonicalTwoForm {
    /// ω(u, v) = u_p·v_q − u_q·v_p, of vectors (δq, δp) of one even length.
    pub fn of<T: Real>(self, u: &[T], v: &[T]) -> T {
        let n = u.len() / 2;
        (0..n).fold(T::zero(), |sum, i| sum + (u[n + i] * v[i] - u[i] * v[n + i]))
    }

    /// The covector ω(·, v), of components (−v_p, v_q): the map from tangent to cotangent vectors.
    pub fn lower_into<T: Real>(self, v: &[T], out: &mut [T]) {
        let n = v.len() / 2;
        for i in 0..n {
            out[i] = -v[n + i];
            out[n + i] = v[i];
        }
    }

    /// The vector v with ω(·, v) = `covector`: the inverse map. It makes Hamilton's field of dH.
    pub fn raise_into<T: Real>(self, covector: &[T], out: &mut [T]) {
        let n = covector.len() / 2;
        for i in 0..n {
            out[i] = covector[n + i];
            out[n + i] = -covector[i];
        }
    }
}

impl TwoForm for CanonicalTwoForm {
    fn accepts(&self, dimension: usize) -> bool {
        dimension.is_multiple_of(2)
    }
    fn entries<T: Real>(&self, x: &[T], out: &mut [T]) {
        let dimension = x.len();
        let n = dimension / 2;
        out.fill(T::zero());
        for i in 0..n {
            out[(n + i) + i * dimension] = T::one();
            out[i + (n + i) * dimension] = -T::one();
        }
    }
}

/// The extended form θ̃ = p dq − H dt, on x = (q, p, t).
///
/// # Example
/// Along a motion it is the Lagrangian: θ̃ = (p·q̇ − H) dt.
/// ```
/// use piola_hamiltonian::{
///     Differential, ExtendedOneForm, ExtendedTwoForm, OneForm, PhaseFunction, SymplecticGradient, TwoForm, VectorField,
/// };
/// use piola_numerics::Real;
/// struct Oscillator; // H = (p² + q²)/2
/// impl PhaseFunction for Oscillator {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * (p[0] * p[0] + q[0] * q[0])
///     }
/// }
/// let mut theta = [0.0; 3];
/// ExtendedOneForm(Oscillator).components(&[1.0, 3.0, 0.0], &mut theta);
/// assert_eq!(theta, [3.0, 0.0, -5.0]);
/// // ω̃ vanishes on the motion, the symplectic gradient of H with dt = 1.
/// let (mut omega, mut motion) = ([0.0; 9], [0.0; 3]);
/// ExtendedTwoForm(Oscillator).entries(&[1.0, 3.0, 0.0], &mut omega);
/// SymplecticGradient(Oscillator).components(&[1.0, 3.0, 0.0], &mut motion);
/// assert_eq!(motion, [3.0, -1.0, 1.0]);
/// assert!((0..3).all(|i| (0..3).map(|j| omega[i + 3 * j] * motion[j]).sum::<f64>() == 0.0));
/// let mut differential = [0.0; 3];
/// Differential(Oscillator).components(&[1.0, 3.0, 0.0], &mut differential);
/// assert_eq!(differential, [1.0, 3.0, 0.0]);
/// ```
///
/// # Source
/// W(10.10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExtendedOneForm<H>(pub H);

impl<H: PhaseFunction> OneForm for ExtendedOneForm<H> {
    fn accepts(&self, dimension: usize) -> bool {
        !dimension.is_multiple_of(2)
    }
    fn components<T: Real>(&self, x: &[T], out: &mut [T]) {
        let n = x.len() / 2;
        let (q, p) = x[..2 * n].split_at(n);
        out[..n].copy_from_slice(p);
        out[n..2 * n].fill(T::zero());
        out[2 * n] = -self.0.value(q, p, x[2 * n]);
    }
}

/// The extended form ω̃ = dp ∧ dq − dH ∧ dt, on x = (q, p, t).
///
/// Its one null direction is that of the motion: ω̃(·, (H_p, −H_q, 1)) = 0.
///
/// # Example
/// See [`ExtendedOneForm`].
///
/// # Source
/// W(10.11).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExtendedTwoForm<H>(pub H);

impl<H: PhaseFunction> TwoForm for ExtendedTwoForm<H> {
    fn accepts(&self, dimension: usize) -> bool {
        !dimension.is_multiple_of(2)
    }
    fn entries<T: Real>(&self, x: &[T], out: &mut [T]) {
        let dimension = x.len();
        let n = dimension / 2;
        let (q, p) = x[..2 * n].split_at(n);
        out.fill(T::zero());
        for i in 0..n {
            out[(n + i) + i * dimension] = T::one();
            out[i + (n + i) * dimension] = -T::one();
        }
        let (rows, time) = out.split_at_mut(2 * n * dimension);
        differentiate_at(&self.0, (q, p, x[2 * n]), &mut time[..2 * n]);
        for i in 0..2 * n {
            rows[2 * n + i * dimension] = time[i];
            time[i] = -time[i];
        }
    }
}

/// A field of vectors on phase space, k = k^i(x) ∂_i, written once for any scalar.
///
/// # Example
/// See [`lie_derivative_of_one_form`](super::lie_derivative_of_one_form).
///
/// # Source
/// W(9.17).
pub trait VectorField {
    /// Writes the components k^i(x), as many as x has.
    fn components<T: Real>(&self, x: &[T], out: &mut [T]);
}

/// Hamilton's field (K_p, −K_q) of a function K: on x = (q, p) at the time 0 where x has no time, and with the
/// component 1 along t where x = (q, p, t).
///
/// # Example
/// See [`ExtendedOneForm`].
///
/// # Source
/// W(9.13), W(10.12), W(10.15).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymplecticGradient<K>(pub K);

impl<K: PhaseFunction> VectorField for SymplecticGradient<K> {
    fn components<T: Real>(&self, x: &[T], out: &mut [T]) {
        let n = x.len() / 2;
        let (q, p) = x[..2 * n].split_at(n);
        let time = x.get(2 * n).copied();
        differentiate_at(&self.0, (q, p, time.unwrap_or(T::zero())), &mut out[..2 * n]);
        for i in 0..n {
            (out[i], out[n + i]) = (out[n + i], -out[i]);
        }
        if time.is_some() {
            out[2 * n] = T::one();
        }
    }
}

/// dK on x = (q, p) at the time 0, or on x = (q, p, t), as a form of degree one.
///
/// # Example
/// See [`ExtendedOneForm`].
///
/// # Source
/// W(8.8), W(9.14).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Differential<K>(pub K);

impl<K: PhaseFunction> OneForm for Differential<K> {
    fn components<T: Real>(&self, x: &[T], out: &mut [T]) {
        let n = x.len() / 2;
        let (q, p) = x[..2 * n].split_at(n);
        let time = x.get(2 * n).copied();
        differentiate_at(&self.0, (q, p, time.unwrap_or(T::zero())), &mut out[..2 * n]);
        if let Some(t) = time {
            out[2 * n] = rate_in_time(&self.0, q, p, t);
        }
    }
}

/// Writes f(x) and ∂f_i/∂x_j, entry (i, j) at `i + j * values`, of a formula with `values` values.
pub(crate) fn jacobian_of<T: Real>(
    x: &[T],
    values: &mut [T],
    jacobian: &mut [T],
    mut formula: impl FnMut(&[Gradient<T, CHUNK>], &mut [Gradient<T, CHUNK>]),
) {
    let zero = Gradient::<T, CHUNK>::constant(T::zero());
    let (mut seeds, mut out) = (vec![zero; x.len()], vec![zero; values.len()]);
    for first in (0..x.len()).step_by(CHUNK) {
        for (j, (seed, &x)) in seeds.iter_mut().zip(x).enumerate() {
            *seed = Gradient::variable(x, j.wrapping_sub(first));
        }
        formula(&seeds, &mut out);
        for (i, result) in out.iter().enumerate() {
            values[i] = result.value;
            for (j, &partial) in (first..x.len()).zip(&result.partials) {
                jacobian[i + j * values.len()] = partial;
            }
        }
    }
}

/// Refuses a point where a form does not live: with time where it has none, or without.
pub(super) fn check_dimension(accepts: bool, dimension: usize) -> Result<(), HamiltonianError> {
    if accepts {
        Ok(())
    } else {
        // One more or less: the other parity.
        Err(HamiltonianError::WrongLength { quantity: "x", expected: dimension + 1, found: dimension })
    }
}

/// The exterior derivative of a form of degree one: (dα)_ij = ∂_i α_j − ∂_j α_i.
///
/// # Errors
/// [`HamiltonianError::WrongLength`] where the form does not live; [`HamiltonianError::NotFinite`].
///
/// # Accuracy
/// Derivatives are exact to rounding.
///
/// # Example
/// ω = dθ:
/// ```
/// use piola_hamiltonian::{CanonicalOneForm, exterior_derivative};
/// let omega = exterior_derivative(&CanonicalOneForm, &[2.0, 3.0])?;
/// assert_eq!(omega.as_slice(), [0.0, 1.0, -1.0, 0.0]); // ω(∂p, ∂q) = 1
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(8.20).
pub fn exterior_derivative<T: Real>(form: &impl OneForm, x: &[T]) -> Result<DMatrix<T>, HamiltonianError> {
    let dimension = x.len();
    check_dimension(form.accepts(dimension), dimension)?;
    let mut values = DVector::from_element(dimension, T::zero());
    // Entry (i, j) is ∂_j α_i.
    let mut gradient = DMatrix::from_element(dimension, dimension, T::zero());
    jacobian_of(x, values.as_mut_slice(), gradient.as_mut_slice(), |x, out| form.components(x, out));
    check_finite("x", x)?;
    check_finite("dα", gradient.as_slice())?;
    Ok(DMatrix::from_fn(dimension, dimension, |i, j| gradient[(j, i)] - gradient[(i, j)]))
}

/// The largest component of the exterior derivative of a form of degree two, |∂_i β_jk + ∂_j β_ki + ∂_k β_ij|: zero
/// where the form is closed.
///
/// # Errors
/// [`HamiltonianError::NotFinite`].
///
/// # Example
/// β = q₁ dq₂ ∧ dp₁ is not closed, ω is:
/// ```
/// use piola_hamiltonian::{CanonicalTwoForm, TwoForm, closedness_residual};
/// use piola_numerics::Real;
/// struct Open;
/// impl TwoForm for Open {
///     fn entries<T: Real>(&self, x: &[T], out: &mut [T]) {
///         out.fill(T::zero());
///         out[1 + 2 * 4] = x[0];
///         out[2 + 4] = -x[0];
///     }
/// }
/// let x = [1.0, 2.0, 3.0, 5.0];
/// assert_eq!((closedness_residual(&Open, &x)?, closedness_residual(&CanonicalTwoForm, &x)?), (1.0, 0.0));
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(8.24).
pub fn closedness_residual(form: &impl TwoForm, x: &[f64]) -> Result<f64, HamiltonianError> {
    let d = x.len();
    check_dimension(form.accepts(d), d)?;
    let (mut values, mut gradient) = (vec![0.0; d * d], vec![0.0; d * d * d]);
    jacobian_of(x, &mut values, &mut gradient, |x, out| form.entries(x, out));
    check_finite("x", x)?;
    check_finite("dβ", &gradient)?;
    let partial = |i: usize, j: usize, k: usize| gradient[j + k * d + i * d * d];
    let mut worst = 0.0;
    for i in 0..d {
        for j in i + 1..d {
            for k in j + 1..d {
                worst = f64::max(worst, (partial(i, j, k) + partial(j, k, i) + partial(k, i, j)).abs());
            }
        }
    }
    Ok(worst)
}

/// The velocity that follows from a covector by ω, checked for length: ω⁻¹ of any covector on phase space.
///
/// # Errors
/// [`HamiltonianError::WrongLength`] where the covector has no even number of components.
///
/// # Source
/// W(9.21).
pub fn raise<T: Real>(covector: &[T]) -> Result<DVector<T>, HamiltonianError> {
    check_length("covector", 2 * (covector.len() / 2), covector.len())?;
    let mut out = DVector::from_element(covector.len(), T::zero());
    CanonicalTwoForm.raise_into(covector, out.as_mut_slice());
    Ok(out)
}
