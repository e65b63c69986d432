//! Linear least squares between bounds.
//!
//! ```text
//! minimise |A x − b|²   with   lₖ ≤ xₖ ≤ uₖ
//! ```
//! By active sets (P. B. Stark, R. L. Parker, *Bounded-variable least-squares*, 1995): unknowns at a bound are let go
//! one at a time while that lowers the sum of squares.

use nalgebra::{DMatrix, DVector};

/// Singular values below this part of the largest count as zero.
const RANK: f64 = 1e-13;

#[derive(Clone, Copy, PartialEq)]
enum State {
    Free,
    Lower,
    Upper,
}

/// The solution and which unknowns are free; of all solutions the shortest in scaled unknowns.
pub(super) fn solve(a: &DMatrix<f64>, b: &DVector<f64>, bounds: &[[f64; 2]]) -> (DVector<f64>, Vec<bool>) {
    let unknowns = a.ncols();
    if 4 * (unknowns + 1) < a.nrows() {
        let (a, b) = compressed(a, b);
        return solve(&a, &b, bounds);
    }
    let sizes: Vec<f64> = (0..unknowns).map(|k| size(a.column(k).norm())).collect();
    let scaled = DMatrix::from_fn(a.nrows(), unknowns, |i, k| a[(i, k)] / sizes[k]);
    // An unknown at its bound is there exactly, whatever scaling and its inverse have rounded.
    let stated = |k: usize, x: f64| x.max(bounds[k][0]).min(bounds[k][1]);
    let finish =
        |x: DVector<f64>, free: Vec<bool>| (DVector::from_fn(unknowns, |k, _| stated(k, x[k] / sizes[k])), free);
    let bounds: Vec<[f64; 2]> = bounds.iter().zip(&sizes).map(|(pair, size)| pair.map(|x| x * size)).collect();
    let inside = |k: usize, x: f64| bounds[k][0] <= x && x <= bounds[k][1];

    // Mostly no bound is met.
    let all = vec![true; unknowns];
    let plain = on_free(&scaled, b, &DVector::zeros(unknowns), &all);
    if (0..unknowns).all(|k| inside(k, plain[k])) {
        return finish(plain, all);
    }

    let start = |k: usize| match bounds[k] {
        [low, high] if low.is_infinite() && high.is_infinite() => State::Free,
        [low, high] if low.is_finite() && (high.is_infinite() || low.abs() <= high.abs()) => State::Lower,
        _ => State::Upper,
    };
    let at = |k: usize, state: State| match state {
        State::Free => 0.0,
        State::Lower => bounds[k][0],
        State::Upper => bounds[k][1],
    };
    let mut states: Vec<State> = (0..unknowns).map(start).collect();
    let mut x = DVector::from_fn(unknowns, |k, _| at(k, states[k]));
    let tolerance = 1e-13 * b.norm().max(f64::MIN_POSITIVE);
    for _ in 0..10 * (unknowns + 1) {
        settle(&scaled, b, &bounds, &mut states, &mut x);
        let slope = scaled.tr_mul(&(b - &scaled * &x));
        let gain = |k: usize| match states[k] {
            State::Free => 0.0,
            State::Lower => slope[k],
            State::Upper => -slope[k],
        };
        let best = (0..unknowns).filter(|&k| bounds[k][0] < bounds[k][1]).max_by(|&i, &j| gain(i).total_cmp(&gain(j)));
        match best {
            Some(k) if tolerance < gain(k) => states[k] = State::Free,
            _ => break,
        }
    }
    let free = states.iter().map(|state| *state == State::Free).collect();
    finish(x, free)
}

/// Fewer rows with the same sums of squares |A x − b|² for all x: R of [A b] = Q R.
pub(super) fn compressed(a: &DMatrix<f64>, b: &DVector<f64>) -> (DMatrix<f64>, DVector<f64>) {
    let unknowns = a.ncols();
    let mut both = a.clone().insert_column(unknowns, 0.0);
    both.set_column(unknowns, b);
    let r = both.qr().r();
    (r.columns(0, unknowns).into_owned(), r.column(unknowns).into_owned())
}

/// 1 for a column of zeros.
fn size(norm: f64) -> f64 {
    if 0.0 < norm && norm.is_finite() { norm } else { 1.0 }
}

/// Moves to the solution on the free unknowns, fixing those that meet a bound on the way.
fn settle(a: &DMatrix<f64>, b: &DVector<f64>, bounds: &[[f64; 2]], states: &mut [State], x: &mut DVector<f64>) {
    for _ in 0..=states.len() {
        let free: Vec<bool> = states.iter().map(|state| *state == State::Free).collect();
        let target = on_free(a, b, x, &free);
        let mut step = 1.0;
        let mut met = None;
        for k in (0..states.len()).filter(|&k| free[k]) {
            let (bound, state) =
                if target[k] < bounds[k][0] { (bounds[k][0], State::Lower) } else { (bounds[k][1], State::Upper) };
            let beyond = target[k] < bounds[k][0] || bounds[k][1] < target[k];
            if beyond {
                let part = ((bound - x[k]) / (target[k] - x[k])).clamp(0.0, 1.0);
                if part <= step {
                    step = part;
                    met = Some((k, bound, state));
                }
            }
        }
        *x += (target - &*x) * step;
        let Some((k, bound, state)) = met else { return };
        x[k] = bound;
        states[k] = state;
    }
}

/// The unknowns that are not free stay, the others solve what is left.
fn on_free(a: &DMatrix<f64>, b: &DVector<f64>, x: &DVector<f64>, free: &[bool]) -> DVector<f64> {
    let places: Vec<usize> = (0..free.len()).filter(|&k| free[k]).collect();
    let mut solution = x.clone();
    if places.is_empty() {
        return solution;
    }
    let mut rest = b.clone();
    for k in (0..free.len()).filter(|&k| !free[k]) {
        rest -= a.column(k) * x[k];
    }
    let part = DMatrix::from_fn(a.nrows(), places.len(), |i, k| a[(i, places[k])]);
    let svd = part.svd(true, true);
    let threshold = RANK * svd.singular_values.max();
    if let Ok(found) = svd.solve(&rest, threshold) {
        for (&place, value) in places.iter().zip(found.iter()) {
            solution[place] = *value;
        }
    }
    solution
}

/// An orthonormal basis of the space of the columns that are free.
pub(super) fn range(a: &DMatrix<f64>, free: &[bool]) -> DMatrix<f64> {
    let places: Vec<usize> = (0..free.len()).filter(|&k| free[k] && 0.0 < a.column(k).norm()).collect();
    if places.is_empty() {
        return DMatrix::zeros(a.nrows(), 0);
    }
    let norms: Vec<f64> = places.iter().map(|&k| a.column(k).norm()).collect();
    let part = DMatrix::from_fn(a.nrows(), places.len(), |i, k| a[(i, places[k])] / norms[k]);
    if part.nrows() <= 4 * part.ncols() {
        let svd = part.svd(true, false);
        let threshold = RANK * svd.singular_values.max();
        let kept: Vec<usize> = (0..places.len()).filter(|&k| threshold < svd.singular_values[k]).collect();
        return svd.u.map_or_else(|| DMatrix::zeros(a.nrows(), 0), |u| u.select_columns(&kept));
    }
    // Q R = part, R = U Σ Vᵀ: the basis is Q U, with few rows in the decomposition.
    let qr = part.qr();
    let (q, svd) = (qr.q(), qr.r().svd(true, false));
    let threshold = RANK * svd.singular_values.max();
    let kept: Vec<usize> = (0..places.len()).filter(|&k| threshold < svd.singular_values[k]).collect();
    svd.u.map_or_else(|| DMatrix::zeros(a.nrows(), 0), |u| q * u.select_columns(&kept))
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::solve;

    #[test]
    fn bounded_solution_equals_the_best_over_all_sets_of_bounds() {
        // Every choice of free, lower and upper for three unknowns, over many seeded problems.
        let mut seed = 1_u64;
        let mut next = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from(u32::try_from(seed >> 33).unwrap_or(0)) / f64::from(1_u32 << 31) * 2.0 - 1.0
        };
        for _ in 0..200 {
            let a = DMatrix::from_fn(6, 3, |_, _| next());
            let b = DVector::from_fn(6, |_, _| next());
            let bounds = [[0.0, f64::INFINITY], [-0.2, 0.1], [f64::NEG_INFINITY, 0.05]];
            let (x, _) = solve(&a, &b, &bounds);
            let value = (&a * &x - &b).norm();
            let mut best = f64::INFINITY;
            for choice in 0..27_usize {
                let fixed: Vec<Option<f64>> = (0..3)
                    .map(|k| match choice / 3_usize.pow(u32::try_from(k).unwrap_or(0)) % 3 {
                        0 => None,
                        side => Some(bounds[k][side - 1]).filter(|bound| bound.is_finite()),
                    })
                    .collect();
                let start = DVector::from_fn(3, |k, _| fixed[k].unwrap_or(0.0));
                let free: Vec<bool> = fixed.iter().map(Option::is_none).collect();
                let candidate = super::on_free(&a, &b, &start, &free);
                let slack = 1e-12;
                if (0..3).all(|k| bounds[k][0] - slack <= candidate[k] && candidate[k] <= bounds[k][1] + slack) {
                    best = best.min((&a * &candidate - &b).norm());
                }
            }
            assert!((0..3).all(|k| bounds[k][0] <= x[k] && x[k] <= bounds[k][1]), "{x}");
            assert!((value - best).abs() <= 1e-12 * best, "{value} {best}");
        }
    }
}
