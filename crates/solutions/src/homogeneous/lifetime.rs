//! For how long a motion F₀ t + F₁ is one.

use nalgebra::Matrix3;
use piola_numerics::linear::matrix3::inverse;

use crate::SolutionsError;
use crate::error::{check_bound, check_finite};

/// The open interval of times about t = 0 in which 0 < det(F₀ t + F₁).
///
/// # Example
/// See [`lifetime`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lifetime {
    /// Its begin, s; −∞ where there is none.
    pub begin: f64,
    /// Its end, s; ∞ where there is none.
    pub end: f64,
}

impl Lifetime {
    /// Whether the motion exists at all times, W(22.9): the real proper numbers of F₀ F₁⁻¹ are zero.
    #[must_use]
    pub fn is_eternal(&self) -> bool {
        self.begin.is_infinite() && self.end.is_infinite()
    }

    /// Whether the motion exists at all t ≥ 0: no real proper number of F₀ F₁⁻¹ is negative.
    #[must_use]
    pub fn lasts(&self) -> bool {
        self.end.is_infinite()
    }
}

/// The lifetime of the accelerationless motion F = F₀ t + F₁.
///
/// ```text
/// det F = det F₁ (1 + I t + II t² + III t³),  I, II, III of K = F₀ F₁⁻¹; zeros at t = −1/k, k the real proper numbers of K
/// ```
/// I, II, III below `tolerance` times |K|, |K|², |K|³ are taken for zero: proper numbers of a nilpotent K cannot be computed
/// to better than its cube root, these can.
///
/// # Errors
/// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] unless 0 < det F₁ and 0 ≤ `tolerance`.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_solutions::homogeneous::lifetime;
/// let one = Matrix3::identity();
/// let shear = Matrix3::new(0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0);
/// assert!(lifetime(&shear, &one, 1e-12)?.is_eternal());
/// let shrinking = lifetime(&(-one * 0.5), &one, 1e-12)?;
/// assert!((shrinking.end - 2.0).abs() < 1e-12 && !shrinking.lasts());
/// # Ok::<(), piola_solutions::SolutionsError>(())
/// ```
///
/// # Source
/// W(22.8–22.9).
pub fn lifetime(rate: &Matrix3<f64>, start: &Matrix3<f64>, tolerance: f64) -> Result<Lifetime, SolutionsError> {
    check_finite("F₀", rate.as_slice())?;
    check_finite("F₁", start.as_slice())?;
    check_bound("tolerance", tolerance, "0 ≤ tolerance", 0.0 <= tolerance)?;
    let jacobian = start.determinant();
    check_bound("det F₁", jacobian, "0 < det F₁", 0.0 < jacobian)?;
    let k = rate * inverse(start)?;
    let size = k.norm();
    if size <= 0.0 {
        return Ok(Lifetime { begin: f64::NEG_INFINITY, end: f64::INFINITY });
    }
    // In units of 1/|K|.
    let k = k / size;
    let invariants = [k.trace(), 0.5 * (k.trace() * k.trace() - (k * k).trace()), k.determinant()];
    let [a, b, c] = invariants.map(|x| if x.abs() <= tolerance { 0.0 } else { x });
    let roots = real_roots(a, b, c);
    let begin = roots.iter().copied().filter(|t| *t < 0.0).fold(f64::NEG_INFINITY, f64::max);
    let end = roots.iter().copied().filter(|t| 0.0 < *t).fold(f64::INFINITY, f64::min);
    Ok(Lifetime { begin: begin / size, end: end / size })
}

/// The real zeros of 1 + a t + b t² + c t³: reciprocals of those of s³ + a s² + b s + c that are not zero.
fn real_roots(a: f64, b: f64, c: f64) -> Vec<f64> {
    let monic = |s: f64| ((s + a) * s + b) * s + c;
    let slope = |s: f64| (3.0 * s + 2.0 * a) * s + b;
    // Between the zeros of the slope there is at most one zero; all lie within Cauchy's bound.
    let bound = 1.0 + a.abs().max(b.abs()).max(c.abs());
    let inner = a * a - 3.0 * b;
    let rounding = 64.0 * f64::EPSILON * bound.powi(3);
    // A triple zero, as of a multiple of the identity, is where the curvature vanishes: searched for it would be lost to its
    // cube root.
    let middle = -a / 3.0;
    if inner.abs() <= rounding && monic(middle).abs() <= rounding {
        return if f64::EPSILON < middle.abs() { vec![middle.recip()] } else { Vec::new() };
    }
    let mut ends = vec![-bound];
    if 0.0 < inner {
        let root = inner.sqrt();
        ends.extend([(-a - root) / 3.0, (-a + root) / 3.0]);
    }
    ends.push(bound);
    let mut zeros = Vec::new();
    for pair in ends.windows(2) {
        let (mut low, mut high) = (pair[0], pair[1]);
        if monic(low).abs() <= 0.0 {
            zeros.push(low);
        }
        if 0.0 <= monic(low) * monic(high) {
            continue;
        }
        let rises = monic(low) < 0.0;
        for _ in 0..200 {
            let middle = f64::midpoint(low, high);
            if (monic(middle) < 0.0) == rises { low = middle } else { high = middle }
        }
        zeros.push(f64::midpoint(low, high));
    }
    // A double zero touches: it is one of the slope, too.
    for &end in &ends {
        let touches = monic(end).abs() <= 8.0 * f64::EPSILON * bound.powi(3) && slope(end).abs() <= 1e-7;
        if touches {
            zeros.push(end);
        }
    }
    zeros.retain(|s| f64::EPSILON < s.abs());
    zeros.into_iter().map(f64::recip).collect()
}
