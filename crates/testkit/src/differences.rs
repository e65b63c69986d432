//! Derivatives by differences of values: rough, but independent of every other way.

/// The derivative of f at x along v, by central differences extrapolated twice.
///
/// ```text
/// D(h) = (f(x + h v) − f(x − h v))/2h,    (64 D(h) − 20 D(2h) + D(4h))/45 = v·∇f + O(h⁶)
/// ```
///
/// With h = 2⁻⁹ the error is about 10⁻¹³ of the size of f for formulas that vary over lengths of one along v;
/// [`Tol::stated`](crate::Tol::stated) a tolerance of 10⁻¹¹ or so.
///
/// # Panics
/// When x and v differ in length.
///
/// # Example
/// ```
/// use piola_testkit::{Tol, assert_close, difference_quotient};
/// let slope = difference_quotient(|x| vec![x[0].sin()], &[0.0], &[1.0]);
/// assert_close("sin′ 0", &slope, &[1.0], Tol::stated(1e-12, "sixth-order differences"));
/// ```
#[must_use]
#[track_caller]
pub fn difference_quotient(f: impl Fn(&[f64]) -> Vec<f64>, x: &[f64], v: &[f64]) -> Vec<f64> {
    assert_eq!(x.len(), v.len(), "the direction has another length than the point");
    let central = |h: f64| -> Vec<f64> {
        let at = |s: f64| f(&x.iter().zip(v).map(|(x, v)| x + s * v).collect::<Vec<_>>());
        at(h).iter().zip(at(-h)).map(|(ahead, behind)| (ahead - behind) / (2.0 * h)).collect()
    };
    let h = 2.0_f64.powi(-9);
    let [fine, middle, coarse] = [central(h), central(2.0 * h), central(4.0 * h)];
    fine.iter().zip(middle).zip(coarse).map(|((a, b), c)| (64.0 * a - 20.0 * b + c) / 45.0).collect()
}

/// The condition number of f at x: by how much relative errors of x are magnified in f.
///
/// ```text
/// κ = max_i Σ_j |∂fᵢ/∂xⱼ| |xⱼ| / max_i |fᵢ|,    at least 1
/// ```
///
/// Estimated by differences with steps of 2⁻²⁰ of each xⱼ. The result of a good algorithm is within a few
/// ulp × κ, so `Tol::ulps(8.0).times(condition_number(…))` is a fair tolerance.
///
/// # Example
/// ```
/// // x − y of nearly equal numbers: κ = (|x| + |y|)/|x − y| = 2001.
/// let kappa = piola_testkit::condition_number(|x| vec![x[0] - x[1]], &[1.001, 1.0]);
/// assert!((kappa - 2001.0).abs() < 1.0);
/// ```
#[must_use]
pub fn condition_number(f: impl Fn(&[f64]) -> Vec<f64>, x: &[f64]) -> f64 {
    condition_number_by_steps(2.0_f64.powi(-20), f, x)
}

/// The [`condition_number`] by differences with relative steps of another size: small ones where f varies over lengths
/// below 10⁻⁶ of x, and is itself rounded only at the end.
///
/// # Example
/// ```
/// // x² − y² with x = 1 + 1e-9 and y = 1: κ ≈ 4/2e-9.
/// let f = |x: &[f64]| vec![(x[0] - x[1]) * (x[0] + x[1])];
/// let kappa = piola_testkit::condition_number_by_steps(2.0_f64.powi(-40), f, &[1.0 + 1e-9, 1.0]);
/// assert!((kappa / 2e9 - 1.0).abs() < 1e-2);
/// ```
#[must_use]
pub fn condition_number_by_steps(h: f64, f: impl Fn(&[f64]) -> Vec<f64>, x: &[f64]) -> f64 {
    let value = f(x);
    let size = value.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    let mut sums = vec![0.0; value.len()];
    let mut moved = x.to_vec();
    for j in 0..x.len() {
        moved[j] = x[j] * (1.0 + h);
        let ahead = f(&moved);
        moved[j] = x[j] * (1.0 - h);
        let behind = f(&moved);
        moved[j] = x[j];
        for (sum, (a, b)) in sums.iter_mut().zip(ahead.iter().zip(&behind)) {
            *sum += (a - b).abs() / (2.0 * h);
        }
    }
    let largest = sums.iter().fold(0.0_f64, |m, a| m.max(*a));
    if 0.0 < size { (largest / size).max(1.0) } else { 1.0 }
}
