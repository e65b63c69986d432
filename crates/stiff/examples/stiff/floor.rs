//! What the linear algebra of a run takes by itself: its factorisations, and the solutions of its sweeps.

use std::hint::black_box;
use std::time::Instant;

use num_complex::Complex64;
use piola_stiff::RadauReport;

#[path = "../../src/radau_iia/lu.rs"]
mod lu;

use lu::{Entry, Factors};

/// Repetitions, of which the least time counts.
const REPETITIONS: u32 = 500;

/// Seconds of a factorisation and of a solution, of shift·1 − J down its columns.
fn times<T: Entry>(n: usize, jacobian: &[f64], shift: T, of: impl Fn(f64) -> T) -> Option<[f64; 2]> {
    let mut factors = Factors::default();
    factors.resize(n);
    let mut least = [f64::INFINITY; 2];
    for _ in 0..REPETITIONS {
        for (k, (entry, &j)) in factors.entries.iter_mut().zip(jacobian).enumerate() {
            *entry = if k % (n + 1) == 0 { shift - of(j) } else { of(-j) };
        }
        let mut b = vec![shift; n];
        let clock = Instant::now();
        black_box(&mut factors).factor().ok()?;
        least[0] = least[0].min(clock.elapsed().as_secs_f64());
        let clock = Instant::now();
        factors.solve(black_box(&mut b));
        least[1] = least[1].min(clock.elapsed().as_secs_f64());
        black_box(&b);
    }
    Some(least)
}

/// Seconds of the factorisations and of the solutions of a run whose steps are about h: as if each step had 3 stages, and 7.
///
/// A sweep evaluates the field at each stage, and solves one real system and a complex one for each two stages more.
pub(crate) fn linear_algebra(n: usize, jacobian: &[f64], h: f64, report: &RadauReport) -> Option<[[f64; 2]; 2]> {
    let [real, real_solution] = times(n, jacobian, 4.0 / h, |j| j)?;
    let [pair, pair_solution] = times(n, jacobian, Complex64::new(3.0 / h, 3.0 / h), |j| Complex64::new(j, 0.0))?;
    Some([3.0, 7.0].map(|stages: f64| {
        let pairs = 0.5 * (stages - 1.0);
        let sweeps = report.run.evaluations as f64 / stages;
        [report.factorisations as f64 * (real + pairs * pair), sweeps * (real_solution + pairs * pair_solution)]
    }))
}
