//! Time and true error of static solutions on a cube, all ways in one run.

use std::time::Instant;

use piola_spectral::{BoxGrid, BoxOperator, BoxSolver, Precision, Walls};
use serde_json::{Value, json};

use super::differences::Staggered;
use super::problem::{displacement, force, lame, relative_error, samples};
use super::transforms::{LineTransform, PlainSolver, Realfft, Rustdct};

/// What went wrong.
pub type Failure = Box<dyn std::error::Error>;

/// A measurement.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Which way.
    pub way: &'static str,
    /// Cells along each axis.
    pub points: usize,
    /// Threads.
    pub threads: usize,
    /// The least time of some runs.
    pub seconds: f64,
    /// ‖u − exact‖/‖exact‖.
    pub error: f64,
}

impl Measured {
    /// Three fields read and written once, over the time: 10⁹ bytes a second.
    #[must_use]
    pub fn gigabytes_per_second(&self) -> f64 {
        let bytes = if self.way.contains("f32") { 4.0 } else { 8.0 };
        6.0 * bytes * (self.points as f64).powi(3) / self.seconds / 1e9
    }

    /// The record of it.
    #[must_use]
    pub fn record(&self) -> Value {
        json!({
            "way": self.way, "points": self.points, "threads": self.threads, "seconds": self.seconds,
            "error": self.error, "gigabytes_per_second": self.gigabytes_per_second(),
        })
    }
}

/// The least time of runs that last some tenths of a second together, three at least; `reset` is not timed.
fn least(mut reset: impl FnMut(), mut run: impl FnMut()) -> f64 {
    let (mut best, mut spent, mut rounds) = (f64::INFINITY, 0.0, 0);
    // More than one copy of a small problem's data would not change its time: it stays in the cache.
    while rounds < 3 || (spent < 0.3 && rounds < 1000) {
        reset();
        let begun = Instant::now();
        run();
        let time = begun.elapsed().as_secs_f64();
        best = f64::min(best, time);
        spent += time;
        rounds += 1;
    }
    best
}

/// Ours.
///
/// # Errors
/// Those of the solver, and of the threads.
pub fn ours<T: Precision>(way: &'static str, points: usize, threads: usize) -> Result<Measured, Failure> {
    let lame = lame()?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let grid = BoxGrid::cells([points; 3], [1.0 / points as f64; 3])?;
    let mut solver = BoxSolver::<T, 3>::new(grid, Walls::Sliding, BoxOperator::elastic(lame))?;
    let forces = [0, 1, 2].map(|c| samples(points, [0.5; 3], |x| force(lame, x, c)));
    let forces = forces.map(|field| field.into_iter().map(T::lit).collect::<Vec<_>>());
    let fields = std::cell::RefCell::new(forces.clone());
    let mut failure = None;
    let seconds = least(
        || fields.borrow_mut().clone_from(&forces),
        || {
            let [x, y, z] = &mut *fields.borrow_mut();
            failure = pool.install(|| solver.solve_in_place([x, y, z])).err();
        },
    );
    if let Some(failure) = failure {
        return Err(failure.into());
    }
    let solution = fields.into_inner().map(|field| field.into_iter().map(|value| value.primal(0)).collect());
    Ok(Measured { way, points, threads, seconds, error: relative_error(&solution, &exact(points)) })
}

fn exact(points: usize) -> [Vec<f64>; 3] {
    [0, 1, 2].map(|c| samples(points, [0.5; 3], |x| displacement(x, c)))
}

/// The same method with the transforms of `rustdct` and of `realfft`, one thread.
///
/// # Errors
/// Never: the material is elliptic.
pub fn other_transforms(points: usize) -> Result<[Measured; 2], Failure> {
    fn of(way: &'static str, points: usize, transform: impl LineTransform) -> Result<Measured, Failure> {
        let lame = lame()?;
        let mut solver = PlainSolver::new(points, lame, transform);
        let forces = [0, 1, 2].map(|c| samples(points, [0.5; 3], |x| force(lame, x, c)));
        let fields = std::cell::RefCell::new(forces.clone());
        let seconds = least(|| fields.borrow_mut().clone_from(&forces), || solver.solve(&mut fields.borrow_mut()));
        let error = relative_error(&fields.into_inner(), &exact(points));
        Ok(Measured { way, points, threads: 1, seconds, error })
    }
    Ok([of("rustdct", points, Rustdct::new(points))?, of("realfft", points, Realfft::new(points))?])
}

/// Differences and conjugate gradients, until the residual is a hundredth of what the differences leave out; one thread.
///
/// # Errors
/// If the residual does not fall so far.
pub fn differences(points: usize) -> Result<Measured, Failure> {
    let lame = lame()?;
    let sampled = |value: &dyn Fn([f64; 3], usize) -> f64| {
        [0, 1, 2].map(|c| samples(points, Staggered::offset(c), |x| value(x, c)))
    };
    let forces = sampled(&|x, c| force(lame, x, c));
    let mut grid = Staggered::new(points, lame);
    let tolerance = 0.01 / (points * points) as f64;
    let begun = Instant::now();
    let (u, solved) = grid.solve(&forces, tolerance);
    let seconds = begun.elapsed().as_secs_f64();
    if tolerance < solved.residual {
        return Err(format!("conjugate gradients ended at {:.1e} after {} steps", solved.residual, solved.steps).into());
    }
    let error = relative_error(&u, &sampled(&displacement));
    Ok(Measured { way: "differences", points, threads: 1, seconds, error })
}
