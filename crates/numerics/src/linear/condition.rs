//! An estimate of ‖A⁻¹‖₁ from a few solutions.

/// Up to this size every column of A⁻¹ is computed, which costs little more than the estimate.
const SMALL: usize = 10;

/// ‖A⁻¹‖₁ for n ≤ 10; a lower bound for larger n, rarely below a third of it.
///
/// `solve` and `solve_transposed` overwrite a vector with A⁻¹ and A⁻ᵀ times it. N. J. Higham, *FORTRAN codes
/// for estimating the one-norm*, ACM Trans. Math. Softw. 14 (1988), after W. W. Hager.
pub(super) fn inverse_norm(n: usize, solve: impl Fn(&mut [f64]), solve_transposed: impl Fn(&mut [f64])) -> f64 {
    if n == 0 {
        return 0.0;
    }
    let norm = |x: &[f64]| x.iter().map(|a| a.abs()).sum::<f64>();
    let mut x = vec![1.0 / n as f64; n];
    if n <= SMALL {
        return (0..n).fold(0.0, |largest, j| {
            x.fill(0.0);
            x[j] = 1.0;
            solve(&mut x);
            norm(&x).max(largest)
        });
    }
    // ‖A⁻¹x‖ is convex in x; its largest value on the unit ball lies at a corner ±eⱼ, and the gradient
    // Aᵀ⁻¹ sign(A⁻¹x) shows the corner to try next.
    let mut estimate = 0.0_f64;
    let mut corner = usize::MAX;
    for _ in 0..5 {
        solve(&mut x);
        let reached = norm(&x);
        if reached <= estimate {
            break;
        }
        estimate = reached;
        for a in &mut x {
            *a = 1.0_f64.copysign(*a);
        }
        solve_transposed(&mut x);
        let mut next = 0;
        for j in 0..n {
            if x[next].abs() < x[j].abs() {
                next = j;
            }
        }
        if next == corner {
            break;
        }
        corner = next;
        x.fill(0.0);
        x[corner] = 1.0;
    }
    // A vector of alternating signs guards against cancellation in all of the above.
    let mut sign = 1.0;
    for (i, a) in x.iter_mut().enumerate() {
        *a = sign * (1.0 + i as f64 / (n - 1) as f64);
        sign = -sign;
    }
    solve(&mut x);
    estimate.max(2.0 * norm(&x) / (3.0 * n as f64))
}
