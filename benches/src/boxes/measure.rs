//! Time and true error of static solutions on a cube, all ways in one run.

use std::time::Instant;

use piola_spectral::{BoxGrid, BoxOperator, BoxSolver, Precision, Walls};
use serde_json::{Value, json};

use super::differences::Staggered;
use super::problem::{centres, displacements, forces, lame, root_mean_square_error};
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
    let forces = forces(lame, points, centres).map(|field| field.into_iter().map(T::lit).collect::<Vec<_>>());
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
    let solution: Vec<f64> = fields.into_inner().concat().into_iter().map(|value| value.primal(0)).collect();
    let error = root_mean_square_error(&solution, &displacements(points, centres).concat());
    Ok(Measured { way, points, threads, seconds, error })
}

/// The same method with the transforms of `rustdct` and of `realfft`, one thread.
///
/// # Errors
/// Never: the material is elliptic.
pub fn other_transforms(points: usize) -> Result<[Measured; 2], Failure> {
    fn of(way: &'static str, points: usize, transform: impl LineTransform) -> Result<Measured, Failure> {
        let lame = lame()?;
        let mut solver = PlainSolver::new(points, lame, transform);
        let forces = forces(lame, points, centres);
        let fields = std::cell::RefCell::new(forces.clone());
        let seconds = least(|| fields.borrow_mut().clone_from(&forces), || solver.solve(&mut fields.borrow_mut()));
        let error = root_mean_square_error(&fields.into_inner().concat(), &displacements(points, centres).concat());
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
    let forces = forces(lame, points, Staggered::offset);
    let mut grid = Staggered::new(points, lame);
    let tolerance = 0.01 / (points * points) as f64;
    let begun = Instant::now();
    let (u, solved) = grid.solve(&forces, tolerance);
    let seconds = begun.elapsed().as_secs_f64();
    if tolerance < solved.residual {
        return Err(format!("conjugate gradients ended at {:.1e} after {} steps", solved.residual, solved.steps).into());
    }
    let error = root_mean_square_error(&u.concat(), &displacements(points, Staggered::offset).concat());
    Ok(Measured { way: "differences", points, threads: 1, seconds, error })
}
