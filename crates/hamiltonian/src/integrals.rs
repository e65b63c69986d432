//! Integrals of the motion: whether a function is one, and whether many are in involution and independent.
//!
//! ```text
//! dK/dt = ∂K/∂t + {K, H} = 0                                                            W(9.20), W(10.17)
//! ```

use nalgebra::DMatrix;
use piola_numerics::{Dual, Gradient, Real};

use super::PhaseFunction;
use super::differential::{CHUNK, check_result, differentiate_at, with_room};
use crate::HamiltonianError;
use crate::check::{check_finite, check_length};

/// A point of phase space at a time: finite numbers, as many momenta as coordinates.
///
/// # Example
/// ```
/// use piola_hamiltonian::PhasePoint;
/// let point = PhasePoint::new(&[1.0, 2.0], &[3.0, 4.0], 0.5)?;
/// assert_eq!((point.q(), point.p(), point.time()), (&[1.0, 2.0][..], &[3.0, 4.0][..], 0.5));
/// assert!(PhasePoint::new(&[1.0], &[f64::NAN], 0.0).is_err());
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(8.9), W(10.4).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written"))]
pub struct PhasePoint {
    q: Vec<f64>,
    p: Vec<f64>,
    #[cfg_attr(feature = "serde", serde(rename = "t"))]
    time: f64,
}

/// What is read before it is checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    q: Vec<f64>,
    p: Vec<f64>,
    #[serde(default)]
    t: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for PhasePoint {
    type Error = HamiltonianError;
    fn try_from(written: Written) -> Result<Self, HamiltonianError> {
        Self::new(&written.q, &written.p, written.t)
    }
}

impl PhasePoint {
    /// The point (q, p) at the time t.
    ///
    /// # Errors
    /// [`HamiltonianError::WrongLength`], [`HamiltonianError::NotFinite`].
    pub fn new(q: &[f64], p: &[f64], t: f64) -> Result<Self, HamiltonianError> {
        check_length("p", q.len(), p.len())?;
        check_finite("q", q)?;
        check_finite("p", p)?;
        check_finite("t", &[t])?;
        Ok(Self { q: q.to_vec(), p: p.to_vec(), time: t })
    }

    /// q.
    #[must_use]
    pub fn q(&self) -> &[f64] {
        &self.q
    }

    /// p.
    #[must_use]
    pub fn p(&self) -> &[f64] {
        &self.p
    }

    /// t, s.
    #[must_use]
    pub const fn time(&self) -> f64 {
        self.time
    }
}

/// Several functions on phase space at once, written for any scalar: a set of integrals, or candidates for them.
///
/// # Example
/// See [`involution_test`].
///
/// # Source
/// W(9.23).
pub trait PhaseFunctions {
    /// How many functions there are.
    fn count(&self) -> usize;
    /// Writes their values.
    fn values<T: Real>(&self, q: &[T], p: &[T], t: T, out: &mut [T]);
}

impl<K: PhaseFunctions> PhaseFunctions for &K {
    fn count(&self) -> usize {
        (**self).count()
    }
    fn values<T: Real>(&self, q: &[T], p: &[T], t: T, out: &mut [T]) {
        (**self).values(q, p, t, out);
    }
}

/// Writes the values of functions and their differentials by rows, down the columns.
pub(super) fn differentials_into<T: Real>(
    functions: &impl PhaseFunctions,
    (q, p, t): (&[T], &[T], T),
    values: &mut [T],
    differentials: &mut [T],
) {
    let (n, count) = (q.len(), values.len());
    let zero = Gradient::<T, CHUNK>::constant(T::zero());
    with_room(zero, 2 * n, |seeds| {
        with_room(zero, count, |out| {
            for first in (0..2 * n).step_by(CHUNK) {
                for (i, (seed, &x)) in seeds.iter_mut().zip(q.iter().chain(p)).enumerate() {
                    *seed = Gradient::variable(x, i.wrapping_sub(first));
                }
                let (q, p) = seeds.split_at(n);
                functions.values(q, p, Gradient::constant(t), out);
                for (row, result) in out.iter().enumerate() {
                    values[row] = result.value;
                    for (column, &partial) in (first..2 * n).zip(&result.partials) {
                        differentials[row + column * count] = partial;
                    }
                }
            }
        });
    });
}

/// How far a function is from being an integral, at the worst of some points.
///
/// # Example
/// See [`integral_test`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IntegralTest {
    /// dK/dt there, the unit of K per second.
    pub rate: f64,
    /// |dK/dt| over the sum of the magnitudes of its terms: some ulp for an integral.
    pub relative: f64,
    /// The index of that point.
    pub point: usize,
}

impl IntegralTest {
    /// Whether all rates are below a share of the terms they are made of.
    #[must_use]
    pub fn passes(&self, tolerance: f64) -> bool {
        self.relative <= tolerance
    }
}

/// Tests whether a function is an integral of a Hamiltonian, with time in either: whether ∂K/∂t + {K, H} vanishes at
/// the points given.
///
/// # Errors
/// [`HamiltonianError::TooFewSamples`] without points; [`HamiltonianError::NotFinite`] where a function has no derivatives.
///
/// # Example
/// The energy of an oscillator is kept, its momentum is not:
/// ```
/// use piola_hamiltonian::{PhaseFunction, PhasePoint, integral_test};
/// use piola_numerics::Real;
/// struct Oscillator;
/// impl PhaseFunction for Oscillator {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * (p[0] * p[0] + q[0] * q[0])
///     }
/// }
/// struct Momentum;
/// impl PhaseFunction for Momentum {
///     fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
///         p[0]
///     }
/// }
/// let points = [PhasePoint::new(&[1.0], &[2.0], 0.0)?, PhasePoint::new(&[3.0], &[1.0], 0.0)?];
/// assert!(integral_test(&Oscillator, &Oscillator, &points)?.passes(1e-14));
/// let test = integral_test(&Momentum, &Oscillator, &points)?;
/// assert_eq!((test.rate, test.relative), (-1.0, 1.0));
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(9.20), W(10.17).
pub fn integral_test(
    function: &impl PhaseFunction,
    hamiltonian: &impl PhaseFunction,
    points: &[PhasePoint],
) -> Result<IntegralTest, HamiltonianError> {
    if points.is_empty() {
        return Err(HamiltonianError::TooFewSamples { found: 0, needed: 1 });
    }
    let mut worst = IntegralTest { rate: 0.0, relative: 0.0, point: 0 };
    for (index, point) in points.iter().enumerate() {
        for (rate, magnitude) in rates_and_magnitudes(&Alone(function), hamiltonian, point)? {
            let relative = if rate.abs() <= 0.0 { 0.0 } else { rate.abs() / magnitude };
            if worst.relative < relative {
                worst = IntegralTest { rate, relative, point: index };
            }
        }
    }
    Ok(worst)
}

/// One function as a set.
struct Alone<'a, K>(&'a K);

impl<K: PhaseFunction> PhaseFunctions for Alone<'_, K> {
    fn count(&self) -> usize {
        1
    }
    fn values<T: Real>(&self, q: &[T], p: &[T], t: T, out: &mut [T]) {
        out[0] = self.0.value(q, p, t);
    }
}

/// The rates of functions along the motion of H, and the sums of the magnitudes of their terms.
pub(super) fn rates_and_magnitudes(
    functions: &impl PhaseFunctions,
    hamiltonian: &impl PhaseFunction,
    point: &PhasePoint,
) -> Result<Vec<(f64, f64)>, HamiltonianError> {
    let (n, count) = (point.q.len(), functions.count());
    let place = (&point.q[..], &point.p[..], point.time);
    let (mut values, mut slopes, mut h) = (vec![0.0; count], vec![0.0; count * 2 * n], vec![0.0; 2 * n]);
    differentials_into(functions, place, &mut values, &mut slopes);
    differentiate_at(hamiltonian, place, &mut h);
    check_result(place, "dK", &slopes)?;
    check_result(place, "dH", &h)?;
    let still = |x: &[f64]| x.iter().map(|&x| Dual::constant(x)).collect::<Vec<_>>();
    let mut timed = vec![Dual::constant(0.0); count];
    functions.values(&still(place.0), &still(place.1), Dual::variable(place.2), &mut timed);
    let mut rates = Vec::with_capacity(count);
    for (c, timed) in timed.iter().enumerate() {
        check_result(place, "∂K/∂t", &[timed.tangent])?;
        rates.push((0..n).fold((timed.tangent, timed.tangent.abs()), |(rate, magnitude), i| {
            let (gain, loss) = (slopes[c + i * count] * h[n + i], slopes[c + (n + i) * count] * h[i]);
            (rate + (gain - loss), magnitude + (gain.abs() + loss.abs()))
        }));
    }
    Ok(rates)
}

/// Involution and independence of a set of functions at a point.
///
/// # Example
/// See [`involution_test`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Involution {
    /// {Kᵢ, Kⱼ}, by rows.
    pub brackets: Vec<Vec<f64>>,
    /// The largest bracket relative to the sum of the magnitudes of its terms.
    pub relative: f64,
    /// The pair it belongs to.
    pub pair: [usize; 2],
    /// The singular values of the differentials, scaled to length one and sorted downwards: as many as there are
    /// functions, or as phase space has dimensions.
    pub singular_values: Vec<f64>,
}

impl Involution {
    /// How many of the functions are independent at the point: the singular values above a share of the largest.
    #[must_use]
    pub fn rank(&self, tolerance: f64) -> usize {
        let largest = self.singular_values.first().copied().unwrap_or(0.0);
        self.singular_values.iter().filter(|&&value| tolerance * largest < value).count()
    }
}

/// Tests a set of functions for involution, {Kᵢ, Kⱼ} = 0, and for independence, at a point.
///
/// n independent integrals in involution make a system of n degrees of freedom integrable.
///
/// # Errors
/// [`HamiltonianError::NotFinite`] where a function has no derivatives.
///
/// # Example
/// Two components of the angular momentum are not in involution; a component and L² are, and are independent.
/// ```
/// use piola_hamiltonian::{PhaseFunctions, PhasePoint, involution_test};
/// use piola_numerics::Real;
/// struct Moments; // L₁, L₃, L²
/// impl PhaseFunctions for Moments {
///     fn count(&self) -> usize {
///         3
///     }
///     fn values<T: Real>(&self, q: &[T], p: &[T], _t: T, out: &mut [T]) {
///         let moment = |i: usize| q[(i + 1) % 3] * p[(i + 2) % 3] - q[(i + 2) % 3] * p[(i + 1) % 3];
///         let (x, y, z) = (moment(0), moment(1), moment(2));
///         out.copy_from_slice(&[x, z, x * x + y * y + z * z]);
///     }
/// }
/// let point = PhasePoint::new(&[1.0, 2.0, 3.0], &[4.0, -1.0, 2.0], 0.0)?;
/// let test = involution_test(&Moments, &point)?;
/// assert_eq!((test.brackets[0][2], test.brackets[1][2]), (0.0, 0.0));
/// assert_eq!((test.brackets[1][0], test.rank(1e-10)), (10.0, 3)); // {L₃, L₁} = L₂ = 3·4 − 1·2
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(9.20), W(9.23).
pub fn involution_test(functions: &impl PhaseFunctions, point: &PhasePoint) -> Result<Involution, HamiltonianError> {
    let (n, count) = (point.q.len(), functions.count());
    let mut values = vec![0.0; count];
    let mut rows = DMatrix::zeros(count, 2 * n);
    let place = (&point.q[..], &point.p[..], point.time);
    differentials_into(functions, place, &mut values, rows.as_mut_slice());
    check_result(place, "dK", rows.as_slice())?;
    let mut test = Involution {
        brackets: vec![vec![0.0; count]; count],
        relative: 0.0,
        pair: [0, 0],
        singular_values: Vec::new(),
    };
    for i in 0..count {
        for j in 0..i {
            let (bracket, magnitude) = (0..n).fold((0.0, 0.0), |(sum, magnitude), k| {
                let (gain, loss) = (rows[(i, k)] * rows[(j, n + k)], rows[(i, n + k)] * rows[(j, k)]);
                (sum + (gain - loss), magnitude + (gain.abs() + loss.abs()))
            });
            (test.brackets[i][j], test.brackets[j][i]) = (bracket, -bracket);
            let relative = if bracket.abs() <= 0.0 { 0.0 } else { bracket.abs() / magnitude };
            if test.relative < relative {
                (test.relative, test.pair) = (relative, [i, j]);
            }
        }
    }
    // Units of coordinates, then of functions, are taken out: neither changes the rank.
    for mut column in rows.column_iter_mut() {
        let largest = column.amax();
        if 0.0 < largest {
            column /= largest;
        }
    }
    for mut row in rows.row_iter_mut() {
        let length = row.norm();
        if 0.0 < length {
            row /= length;
        }
    }
    test.singular_values = rows.singular_values().iter().copied().collect();
    Ok(test)
}
