//! Sums and products whose rounding errors are kept.
//!
//! ```text
//! two_sum:      a + b = s + e  exactly,   s = fl(a + b)          (Knuth)
//! two_product:  a · b = p + e  exactly,   p = fl(a · b)          (Dekker, Veltkamp)
//! ```
//!
//! | to | use |
//! |---|---|
//! | add many numbers as if in twice the precision | [`CompensatedSum`] |
//! | form Σ aᵢbᵢ as if in twice the precision | [`compensated_dot`] |
//! | advance a state y by small increments without losing their tails | [`compensated_add`] |
//!
//! Nothing here uses fused multiplication, so results are the same on every machine. Over lanes each lane is
//! compensated; over differentiable numbers the derivatives of a sum are compensated too, because sums act
//! on each part alone.
//!
//! # References
//! D. E. Knuth, *The Art of Computer Programming* 2, 4.2.2; T. J. Dekker, *A floating-point technique for
//! extending the available precision*, Numer. Math. 18 (1971); A. Neumaier, ZAMM 54 (1974); T. Ogita,
//! S. M. Rump, S. Oishi, *Accurate sum and dot product*, SIAM J. Sci. Comput. 26 (2005).

use crate::error::check_dimension;
use crate::{NumericsError, Real};

/// The rounded sum of two numbers and its rounding error: `a + b = sum + error` exactly.
///
/// # Accuracy
/// Exact unless the sum overflows, when the error is NaN.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn two_sum<T: Real>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let b_rounded = sum - a;
    let a_rounded = sum - b_rounded;
    (sum, (a - a_rounded) + (b - b_rounded))
}

/// The rounded product of two numbers and its rounding error: `a · b = product + error` exactly.
///
/// # Accuracy
/// Exact in f64 for factors below 2⁹⁹⁶ in size and a product that neither overflows nor falls below 2⁻⁹⁶⁹
/// (f32: 2¹¹⁵ and 2⁻¹⁰²).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn two_product<T: Real>(a: T, b: T) -> (T, T) {
    let product = a * b;
    let (a_high, a_low) = split(a);
    let (b_high, b_low) = split(b);
    let error = a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low);
    (product, error)
}

/// Two halves of a number with half its digits each, so that products of halves are exact (Veltkamp).
#[cfg_attr(not(debug_assertions), inline(always))]
fn split<T: Real>(x: T) -> (T, T) {
    let splitter = T::lit(if unit_in_last_place::<T>() < 1e-10 { 134_217_729.0 } else { 4097.0 });
    let scaled = splitter * x;
    let high = scaled - (scaled - x);
    (high, x - high)
}

/// The distance from one to the next number of `T`: 2⁻⁵² over f64, 2⁻²³ over f32.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn unit_in_last_place<T: Real>() -> f64 {
    let next = T::one() + T::lit(f64::EPSILON);
    if 1.0 < next.primal(0) { f64::EPSILON } else { f64::from(f32::EPSILON) }
}

/// A running sum that carries what its additions round off.
///
/// ```text
/// s ← fl(s + x),   c ← c + (rounding error of that addition),   value = s + c
/// ```
///
/// # Accuracy
/// For n terms in f64 |error| ≤ 2⁻⁵³ |Σx| + n² 2⁻¹⁰⁶ Σ|x|: as if summed in twice the precision and rounded
/// once.
/// An infinite or NaN term gives what the plain sum gives.
///
/// # Example
/// ```
/// use piola_numerics::sums::CompensatedSum;
/// let mut sum = CompensatedSum::new();
/// for x in [1.0, 1e100, 1.0, -1e100] {
///     sum.add(x);
/// }
/// assert_eq!(sum.value(), 2.0); // the plain sum is 0
/// ```
#[doc(alias("Kahan", "Neumaier"))]
#[derive(Clone, Copy, Debug)]
pub struct CompensatedSum<T> {
    sum: T,
    carry: T,
}

impl<T: Real> CompensatedSum<T> {
    /// The empty sum.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn new() -> Self {
        Self { sum: T::zero(), carry: T::zero() }
    }
    /// Adds a term.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn add(&mut self, term: T) {
        let (sum, error) = two_sum(self.sum, term);
        self.sum = sum;
        self.carry += error;
    }
    /// Adds the product of two factors with its rounding error.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn add_product(&mut self, a: T, b: T) {
        let (product, error) = two_product(a, b);
        self.add(product);
        self.carry += error;
    }
    /// The sum.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn value(self) -> T {
        // After an overflow the carry is NaN and the plain sum tells what happened.
        T::select(self.carry.is_finite(), self.sum + self.carry, self.sum)
    }
}

impl<T: Real> Default for CompensatedSum<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real> Extend<T> for CompensatedSum<T> {
    fn extend<I: IntoIterator<Item = T>>(&mut self, terms: I) {
        for term in terms {
            self.add(term);
        }
    }
}

impl<T: Real> FromIterator<T> for CompensatedSum<T> {
    fn from_iter<I: IntoIterator<Item = T>>(terms: I) -> Self {
        let mut sum = Self::new();
        sum.extend(terms);
        sum
    }
}

/// The sum of the terms as if in twice the precision: [`CompensatedSum`] of a slice.
#[must_use]
pub fn compensated_sum<T: Real>(terms: &[T]) -> T {
    terms.iter().copied().collect::<CompensatedSum<T>>().value()
}

/// Σ aᵢbᵢ as if in twice the precision.
///
/// # Errors
/// When the lengths differ.
///
/// # Accuracy
/// |error| ≤ 2⁻⁵³ |a·b| + n² 2⁻¹⁰⁵ Σ|aᵢbᵢ| in the range of [`two_product`].
pub fn compensated_dot<T: Real>(a: &[T], b: &[T]) -> Result<T, NumericsError> {
    check_dimension("b", b.len(), a.len())?;
    let mut sum = CompensatedSum::new();
    for (&a, &b) in a.iter().zip(b) {
        sum.add_product(a, b);
    }
    Ok(sum.value())
}

/// Advances a state by an increment: `y + carry ← y + carry + increment`, with |carry| ≤ ½ ulp of y.
///
/// A million steps of an integrator add a million roundings to y; with the carry they add none that is
/// noticeable: y stays the rounded value of the sum of all increments. Start with a carry of zero.
///
/// # Errors
/// When the lengths differ; nothing is written then.
///
/// # Accuracy
/// Each call commits an error of at most 2⁻⁵³ (|carry| + |increment|).
///
/// # Example
/// ```
/// use piola_numerics::sums::compensated_add;
/// let (mut y, mut carry) = ([1.0], [0.0]);
/// for _ in 0..1024 {
///     compensated_add(&mut y, &mut carry, &[2.0_f64.powi(-60)])?; // less than half an ulp of y
/// }
/// assert_eq!(y, [1.0 + 2.0_f64.powi(-50)]);
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
#[inline]
pub fn compensated_add<T: Real>(y: &mut [T], carry: &mut [T], increment: &[T]) -> Result<(), NumericsError> {
    check_dimension("carry", carry.len(), y.len())?;
    check_dimension("increment", increment.len(), y.len())?;
    for ((y, carry), &increment) in y.iter_mut().zip(carry).zip(increment) {
        (*y, *carry) = two_sum(*y, increment + *carry);
    }
    Ok(())
}
