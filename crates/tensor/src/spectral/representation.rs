//! Representation of an isotropic function of a symmetric tensor by powers of its argument (Rivlin and Ericksen).
//!
//! ```text
//! G(Q A Qᵀ) = Q G(A) Qᵀ for all orthogonal Q   ⇔   G(A) = γ₀ 1 + γ₁ A + γ₂ A²,  γ functions of I, II, III of A     W(19.20–19.21)
//! ```

use super::decompose;
use crate::error::{check_finite, check_range};
use crate::{Symmetric, TensorError};

/// How many eigenvalues of the argument are different, and with that how many powers its isotropic functions need.
///
/// # Example
/// See [`representation`].
///
/// # Source
/// W(19.23), W(19.25), W(19.27).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum EigenvalueCase {
    /// One: A = d 1, every direction is principal, G = γ₀ 1.
    One,
    /// Two: A = c 1 + d f ⊗ f, G = γ₀ 1 + γ₁ A.
    Two,
    /// Three: G = γ₀ 1 + γ₁ A + γ₂ A².
    Three,
}

/// The coefficients of a value G(A) in powers of A.
///
/// # Example
/// See [`representation`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Representation {
    /// How many eigenvalues of A are different.
    pub case: EigenvalueCase,
    /// γ₀, γ₁, γ₂; zero for the powers that are not needed.
    pub coefficients: [f64; 3],
    /// |G − γ₀ 1 − γ₁ A − γ₂ A²|/|G|: far from rounding, G is no isotropic function of A.
    pub residual: f64,
}

impl Representation {
    /// γ₀ 1 + γ₁ A + γ₂ A².
    #[must_use]
    pub fn at(&self, argument: &Symmetric) -> Symmetric {
        let [zeroth, first, second] = self.coefficients;
        Symmetric::identity() * zeroth + *argument * first + argument.square() * second
    }
}

/// The coefficients of the value G of an isotropic function at A, of the lowest degree.
///
/// Eigenvalues whose difference is at most `tolerance` times the largest modulus are taken as one, and so are the values
/// there.
///
/// ```text
/// three eigenvalues a > b > c with values g:   γ₂ = g[a, b, c],  γ₁ = g[a, b] − γ₂ (a + b),  γ₀ = g(a) − γ₁ a − γ₂ a²
/// two, a and c:                                γ₁ = g[a, c],  γ₀ = g(a) − γ₁ a
/// one:                                         γ₀ = ⅓ tr G
/// ```
///
/// # Errors
/// [`TensorError::NotFinite`]; [`TensorError::OutOfRange`] unless 0 ≤ `tolerance`.
///
/// # Accuracy
/// The represented tensor: a few ulp of |G|. The coefficients: that over the gaps of the eigenvalues, relative to the largest, and over
/// the product of two gaps for γ₂.
///
/// # Example
/// By the theorem of Cayley and Hamilton A³ = I A² − II A + III 1: 6 A² − 11 A + 6 for the eigenvalues 1, 2, 3.
/// ```
/// use piola_tensor::Symmetric;
/// use piola_tensor::spectral::{EigenvalueCase, representation};
/// let (argument, cube) = (Symmetric::diagonal([1.0, 2.0, 3.0]), Symmetric::diagonal([1.0, 8.0, 27.0]));
/// let found = representation(&argument, &cube, 1e-9)?;
/// assert_eq!((found.case, found.coefficients), (EigenvalueCase::Three, [6.0, -11.0, 6.0]));
/// // A stress that is not coaxial with its argument is no isotropic function of it.
/// let skewed = Symmetric::new(1.0, 8.0, 27.0, 4.0, 0.0, 0.0);
/// assert!(0.1 < representation(&argument, &skewed, 1e-9)?.residual);
/// # Ok::<(), piola_tensor::TensorError>(())
/// ```
///
/// # Source
/// W(19.19–19.32).
pub fn representation(argument: &Symmetric, value: &Symmetric, tolerance: f64) -> Result<Representation, TensorError> {
    check_finite("argument", &argument.components)?;
    check_finite("value", &value.components)?;
    check_range("tolerance", tolerance, f64::INFINITY)?;
    let principal = decompose(argument);
    let [a, b, c] = principal.values;
    let image = |k: usize| {
        let axis = nalgebra::Vector3::from(principal.vectors[k]);
        axis.dot(&(*value * axis))
    };
    let [ga, gb, gc] = [image(0), image(1), image(2)];
    let close = tolerance * a.abs().max(c.abs());
    let line = |(a, ga): (f64, f64), (c, gc): (f64, f64)| {
        let first = (ga - gc) / (a - c);
        [ga - first * a, first, 0.0]
    };
    let (case, coefficients) = match (a - b <= close, b - c <= close) {
        (true, true) => (EigenvalueCase::One, [value.trace() / 3.0, 0.0, 0.0]),
        (true, false) => (EigenvalueCase::Two, line((0.5 * (a + b), 0.5 * (ga + gb)), (c, gc))),
        (false, true) => (EigenvalueCase::Two, line((a, ga), (0.5 * (b + c), 0.5 * (gb + gc)))),
        (false, false) => {
            let [upper, lower] = [(ga - gb) / (a - b), (gb - gc) / (b - c)];
            let second = (upper - lower) / (a - c);
            let first = upper - second * (a + b);
            (EigenvalueCase::Three, [ga - first * a - second * a * a, first, second])
        }
    };
    let mut found = Representation { case, coefficients, residual: 0.0 };
    let size = value.norm();
    if 0.0 < size {
        found.residual = (found.at(argument) - *value).norm() / size;
    }
    Ok(found)
}
