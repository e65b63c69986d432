//! Maps of phase space, and whether they are canonical.
//!
//! ```text
//! (q, p, t) ↦ (Q, P, t)        J = ∂(Q, P)/∂(q, p)        Jᵀ Ω J = Ω                      W(9.16)
//! d(P dQ − p dq − F dt) = 0        G = K + F                                             W(10.24), W(10.28)
//! ```
//!
//! A map that depends on time is a contact transformation, with a function F by which the new Hamiltonian G exceeds
//! the old one.

use nalgebra::{DMatrix, DVector};
use piola_numerics::{Dual, Real};

use super::PhaseFunction;
use super::differential::{check_result, differentiate_at, undefined, with_room};
use super::forms::jacobian_of;
use crate::HamiltonianError;
use crate::check::check_length;

/// A map of phase space at each time, (q, p) ↦ (Q, P), written once for any scalar.
///
/// # Example
/// ```
/// use piola_hamiltonian::HamiltonianError;
/// use piola_hamiltonian::{PhaseMap, canonical_test};
/// use piola_numerics::Real;
/// struct Exchange; // Q = p, P = −q
/// impl PhaseMap for Exchange {
///     fn map<T: Real>(&self, q: &[T], p: &[T], _t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
///         let n = q.len();
///         for i in 0..n {
///             new[i] = p[i];
///             new[n + i] = -q[i];
///         }
///         Ok(())
///     }
/// }
/// assert_eq!(canonical_test(&Exchange, &[1.0, 2.0], &[3.0, 5.0], 0.0)?.residual, 0.0);
/// # Ok::<(), HamiltonianError>(())
/// ```
///
/// # Source
/// W(9.16), W(10.22).
pub trait PhaseMap {
    /// Whether the map, at a fixed point, changes with time.
    const TIME_DEPENDENT: bool = false;

    /// Writes (Q, P), 2n components.
    ///
    /// # Errors
    /// What the map refuses, by name and number.
    fn map<T: Real>(&self, q: &[T], p: &[T], t: T, new: &mut [T]) -> Result<(), HamiltonianError>;

    /// F at the old point, J: by how much the new Hamiltonian exceeds the old one. Zero for a map without time.
    ///
    /// # Errors
    /// As [`map`](Self::map).
    fn excess<T: Real>(&self, _q: &[T], _p: &[T], _t: T) -> Result<T, HamiltonianError> {
        Ok(T::zero())
    }
}

/// A map of phase space that can be gone back.
///
/// # Example
/// See [`Inverse`](super::Inverse).
pub trait InvertiblePhaseMap: PhaseMap {
    /// Writes the old (q, p) of the new (Q, P).
    ///
    /// # Errors
    /// As [`PhaseMap::map`].
    fn invert<T: Real>(&self, new_q: &[T], new_p: &[T], t: T, old: &mut [T]) -> Result<(), HamiltonianError>;
}

impl<M: PhaseMap> PhaseMap for &M {
    const TIME_DEPENDENT: bool = M::TIME_DEPENDENT;
    fn map<T: Real>(&self, q: &[T], p: &[T], t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
        (**self).map(q, p, t, new)
    }
    fn excess<T: Real>(&self, q: &[T], p: &[T], t: T) -> Result<T, HamiltonianError> {
        (**self).excess(q, p, t)
    }
}

impl<M: InvertiblePhaseMap> InvertiblePhaseMap for &M {
    fn invert<T: Real>(&self, new_q: &[T], new_p: &[T], t: T, old: &mut [T]) -> Result<(), HamiltonianError> {
        (**self).invert(new_q, new_p, t, old)
    }
}

/// The image (Q, P) of a point and the Jacobian ∂(Q, P)/∂(q, p), 2n×2n.
///
/// The Jacobian carries vectors tangent to phase space: (δQ, δP) = J (δq, δp).
///
/// # Errors
/// [`HamiltonianError::WrongLength`], [`HamiltonianError::NotFinite`], and what the map refuses.
///
/// # Example
/// ```
/// use piola_hamiltonian::{PolarCoordinates, image_and_jacobian};
/// let (image, jacobian) = image_and_jacobian(&PolarCoordinates, &[3.0, 4.0], &[1.0, 2.0], 0.0)?;
/// assert_eq!((image[0], image[3]), (5.0, 3.0 * 2.0 - 4.0 * 1.0)); // r, p_φ
/// assert_eq!((jacobian[(3, 0)], jacobian[(3, 3)]), (2.0, 3.0)); // ∂p_φ/∂x, ∂p_φ/∂p_y
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(8.17).
pub fn image_and_jacobian<T: Real>(
    map: &impl PhaseMap,
    q: &[T],
    p: &[T],
    t: T,
) -> Result<(DVector<T>, DMatrix<T>), HamiltonianError> {
    check_length("p", q.len(), p.len())?;
    let n = q.len();
    let mut image = DVector::from_element(2 * n, T::zero());
    let mut jacobian = DMatrix::from_element(2 * n, 2 * n, T::zero());
    let mut refusal = None;
    let x: Vec<T> = q.iter().chain(p).copied().collect();
    jacobian_of(&x, image.as_mut_slice(), jacobian.as_mut_slice(), |x, out| {
        let (q, p) = x.split_at(n);
        if let Err(error) = map.map(q, p, piola_numerics::Gradient::constant(t), out) {
            refusal = Some(error);
        }
    });
    check_result((q, p, t), "(Q, P)", if refusal.is_none() { image.as_slice() } else { &[] })?;
    if let Some(error) = refusal {
        return Err(error);
    }
    check_result((q, p, t), "∂(Q, P)", jacobian.as_slice())?;
    Ok((image, jacobian))
}

/// How far a map is from being canonical at a point.
///
/// # Example
/// See [`canonical_test`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CanonicalTest {
    /// The largest entry of JᵀΩJ − Ω beside the sum of magnitudes it is made of, its own unit.
    pub residual: f64,
    /// That entry over the sum of magnitudes: some ulp for a canonical map.
    pub relative: f64,
    /// The row of the entry, in the order (q, p).
    pub row: usize,
    /// Its column.
    pub column: usize,
}

impl CanonicalTest {
    const NOTHING: Self = Self { residual: 0.0, relative: 0.0, row: 0, column: 0 };

    /// Takes an entry that should vanish, and what it is made of.
    fn see(&mut self, entry: f64, scale: f64, row: usize, column: usize) {
        let residual = entry.abs();
        let relative = if residual <= 0.0 { 0.0 } else { residual / scale };
        if self.relative < relative || relative.is_nan() {
            *self = Self { residual, relative, row, column };
        }
    }
}

/// The bracket [a, b] = Σ P_a·Q_b − Q_a·P_b of two tangents of the image, and the sum of its terms' magnitudes.
fn lagrange_bracket(a: &[f64], b: &[f64]) -> (f64, f64) {
    let n = a.len() / 2;
    (0..n).fold((0.0, 0.0), |(sum, scale), i| {
        let (first, second) = (a[n + i] * b[i], a[i] * b[n + i]);
        (sum + (first - second), scale + (first.abs() + second.abs()))
    })
}

/// Tests whether a map is canonical at a point: whether its Jacobian is symplectic.
///
/// ```text
/// Jᵀ Ω J − Ω        Ω = [0 −1; 1 0] in the order (q, p)
/// ```
///
/// # Errors
/// As [`image_and_jacobian`].
///
/// # Example
/// To double q alone is not canonical: dP ∧ dQ = 2 dp ∧ dq.
/// ```
/// use piola_hamiltonian::HamiltonianError;
/// use piola_hamiltonian::{PhaseMap, canonical_test, require_canonical};
/// use piola_numerics::Real;
/// struct Doubled;
/// impl PhaseMap for Doubled {
///     fn map<T: Real>(&self, q: &[T], p: &[T], _t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
///         new[0] = q[0] + q[0];
///         new[1] = p[0];
///         Ok(())
///     }
/// }
/// let test = canonical_test(&Doubled, &[1.0], &[3.0], 0.0)?;
/// assert_eq!((test.residual, test.row, test.column), (1.0, 1, 0));
/// assert!(require_canonical(&Doubled, &[1.0], &[3.0], 0.0, 1e-12).is_err());
/// # Ok::<(), HamiltonianError>(())
/// ```
///
/// # Source
/// W(9.16), W p. 56.
pub fn canonical_test(map: &impl PhaseMap, q: &[f64], p: &[f64], t: f64) -> Result<CanonicalTest, HamiltonianError> {
    let (_, jacobian) = image_and_jacobian(map, q, p, t)?;
    Ok(symplecticity(&jacobian))
}

/// The test of a given Jacobian.
fn symplecticity(jacobian: &DMatrix<f64>) -> CanonicalTest {
    let d = jacobian.ncols();
    let column = |i: usize| &jacobian.as_slice()[i * d..(i + 1) * d];
    let mut worst = CanonicalTest::NOTHING;
    for i in 0..d {
        for j in 0..i {
            let (bracket, scale) = lagrange_bracket(column(i), column(j));
            let expected = if i == j + d / 2 { 1.0 } else { 0.0 };
            worst.see(bracket - expected, scale.max(expected), i, j);
        }
    }
    worst
}

/// Refuses a map whose Jacobian is not symplectic at a point to a relative tolerance.
///
/// # Errors
/// [`HamiltonianError::NotCanonical`] with the worst entry; what [`image_and_jacobian`] refuses.
///
/// # Source
/// W(9.16).
pub fn require_canonical(
    map: &impl PhaseMap,
    q: &[f64],
    p: &[f64],
    t: f64,
    tolerance: f64,
) -> Result<(), HamiltonianError> {
    let CanonicalTest { residual, relative, row, column } = canonical_test(map, q, p, t)?;
    if relative <= tolerance { Ok(()) } else { Err(HamiltonianError::NotCanonical { residual, relative, row, column }) }
}

/// Tests whether a map that depends on time is a contact transformation with the F it states.
///
/// ```text
/// d(P dQ − p dq − F dt) = 0:    Jᵀ Ω J = Ω    and    P_x·Q_t − Q_x·P_t = ∂F/∂x    for x = q, p
/// ```
///
/// The row or column 2n of the result is that of the time.
///
/// # Errors
/// As [`image_and_jacobian`].
///
/// # Source
/// W(10.20–10.25).
pub fn contact_test(map: &impl PhaseMap, q: &[f64], p: &[f64], t: f64) -> Result<CanonicalTest, HamiltonianError> {
    let (_, jacobian) = image_and_jacobian(map, q, p, t)?;
    let d = 2 * q.len();
    let mut worst = symplecticity(&jacobian);
    // The image moving in time…
    let point: Vec<Dual<f64>> = q.iter().chain(p).map(|&x| Dual::constant(x)).collect();
    let mut moving = vec![Dual::constant(0.0); d];
    let (dual_q, dual_p) = point.split_at(q.len());
    map.map(dual_q, dual_p, Dual::variable(t), &mut moving)?;
    let rates: Vec<f64> = moving.iter().map(|x| x.tangent).collect();
    check_result((q, p, t), "∂(Q, P)/∂t", &rates)?;
    // … and the slope of F.
    let mut slope = vec![0.0; d];
    differentiate_at(&Excess(map), (q, p, t), &mut slope);
    check_result((q, p, t), "dF", &slope)?;
    for (i, slope) in slope.iter().enumerate() {
        let (bracket, scale) = lagrange_bracket(&jacobian.as_slice()[i * d..(i + 1) * d], &rates);
        worst.see(bracket - slope, scale.max(slope.abs()), i, d);
    }
    Ok(worst)
}

/// F of a map as a function on the old phase space; not a number where the map refuses.
struct Excess<'a, M>(&'a M);

impl<M: PhaseMap> PhaseFunction for Excess<'_, M> {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        self.0.excess(q, p, t).unwrap_or_else(|_| undefined())
    }
}

/// The Hamiltonian in new coordinates, G(Q, P, t) = H + F at the old point.
///
/// Where the map refuses the point its value is not a number, which every function of this module refuses by name.
///
/// # Example
/// A free particle in a frame that turns: G = p²/2 − Ω (Q₁P₂ − Q₂P₁).
/// ```
/// use piola_hamiltonian::{PhaseFunction, RotatingFrame, TransformedHamiltonian};
/// use piola_numerics::Real;
/// struct Free;
/// impl PhaseFunction for Free {
///     fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * (p[0] * p[0] + p[1] * p[1])
///     }
/// }
/// let turning = TransformedHamiltonian { hamiltonian: Free, map: RotatingFrame::new(0.5)? };
/// assert_eq!(turning.value(&[1.0, 2.0], &[3.0, 4.0], 0.0), 12.5 - 0.5 * (1.0 * 4.0 - 2.0 * 3.0));
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(10.28).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransformedHamiltonian<H, M> {
    /// The old Hamiltonian.
    pub hamiltonian: H,
    /// The map from old to new coordinates.
    pub map: M,
}

impl<H: PhaseFunction, M: InvertiblePhaseMap> PhaseFunction for TransformedHamiltonian<H, M> {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        let n = q.len();
        with_room(T::zero(), 2 * n, |old| {
            let excess = self.map.invert(q, p, t, old).and_then(|()| self.map.excess(&old[..n], &old[n..], t));
            let (q, p) = old.split_at(n);
            excess.map_or_else(|_| undefined(), |excess| self.hamiltonian.value(q, p, t) + excess)
        })
    }
}

/// A function K(q, p, t) seen through a map, K∘φ: a function on the old phase space of one on the new.
///
/// # Example
/// The momentum along φ, as a function of Cartesian coordinates:
/// ```
/// use piola_hamiltonian::{PhaseFunction, PolarCoordinates, PulledBack};
/// use piola_numerics::Real;
/// struct Second; // P₂
/// impl PhaseFunction for Second {
///     fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
///         p[1]
///     }
/// }
/// let moment = PulledBack { function: Second, map: PolarCoordinates };
/// assert_eq!(moment.value(&[3.0, 4.0], &[1.0, 2.0], 0.0), 2.0);
/// ```
///
/// # Source
/// W(9.21).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PulledBack<K, M> {
    /// The function on the new phase space.
    pub function: K,
    /// The map from the old phase space to the new one.
    pub map: M,
}

impl<K: PhaseFunction, M: PhaseMap> PhaseFunction for PulledBack<K, M> {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        with_room(T::zero(), 2 * q.len(), |new| match self.map.map(q, p, t, new) {
            Ok(()) => {
                let (q, p) = new.split_at(q.len());
                self.function.value(q, p, t)
            }
            Err(_) => undefined(),
        })
    }
}
