//! The solution surface: characteristics over a mesh of the initial manifold, refined where it bends.

use core::ops::ControlFlow;
use std::collections::{BTreeMap, BTreeSet};

use super::mesh::{Walk, cut, edges};
use super::problem::check_span;
use super::ray::{Marcher, Ray};
use super::{CauchyProblem, FirstOrderPde, InitialManifold, ParameterInterval};
use crate::CharacteristicsError;

/// How finely a solution is resolved.
///
/// # Example
/// See [`CauchyProblem::solve`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Refinement {
    /// The largest error of cubic interpolation between neighbouring characteristics and levels, of x and of u/|ξ|, in
    /// the unit of x. Infinite: the characteristics of the grid given, and no others.
    pub resolution: f64,
    /// The largest number of characteristics.
    pub most_rays: usize,
    /// The least number of parts of s on either side of zero, and at least two.
    pub levels: usize,
    /// The largest number to which they are doubled.
    pub most_levels: usize,
}

impl Refinement {
    /// To a resolution in the unit of x, with at most 100 000 characteristics and from 4 to 1024 parts of s.
    #[must_use]
    pub const fn to(resolution: f64) -> Self {
        Self { resolution, most_rays: 100_000, levels: 4, most_levels: 1024 }
    }
}

/// A solution of Cauchy's problem by characteristics, as far as they were asked for; folds are kept.
///
/// It is made by [`CauchyProblem::solve`]. The manifold is a mesh of simplices with m corners in the parameters, refined
/// adaptively: a polyline for m = 2, triangles for m = 3, tetrahedra for m = 4.
///
/// # Source
/// W(A.43).
#[derive(Debug)]
pub struct CharacteristicSolution<'a, P, M> {
    pub(super) problem: CauchyProblem<'a, P, M>,
    pub(super) intervals: Vec<ParameterInterval>,
    pub(super) levels: Vec<f64>,
    pub(super) rays: Vec<Ray>,
    pub(super) simplices: Vec<Vec<usize>>,
    pub(super) error: f64,
}

impl<P, M> CharacteristicSolution<'_, P, M> {
    /// The values of s at which the states of the characteristics are kept, in order.
    #[must_use]
    pub fn levels(&self) -> &[f64] {
        &self.levels
    }
    /// The characteristics.
    #[must_use]
    pub fn rays(&self) -> &[Ray] {
        &self.rays
    }
    /// Which characteristics are neighbours: simplices of m corners each.
    #[must_use]
    pub fn simplices(&self) -> &[Vec<usize>] {
        &self.simplices
    }
    /// (x, u, ξ) of one characteristic at one level, by their numbers; `None` beyond the last of either.
    #[must_use]
    pub fn strip(&self, ray: usize, level: usize) -> Option<(&[f64], f64, &[f64])> {
        let ray = self.rays.get(ray)?;
        let n = ray.states.len() / self.levels.len();
        let row = ray.states.get(level * n..(level + 1) * n)?;
        let m = self.problem.data.variables;
        Some((&row[..m], row[m], &row[m + 1..=2 * m]))
    }
    /// The largest error of interpolation that was found and let be, in the unit of x.
    #[must_use]
    pub const fn interpolation_error(&self) -> f64 {
        self.error
    }
    /// The largest |Φ| on the characteristics.
    #[must_use]
    pub fn drift(&self) -> f64 {
        self.rays.iter().fold(0.0, |drift, ray| drift.max(ray.drift))
    }
}

impl<'a, P: FirstOrderPde + Sync, M: InitialManifold + Sync> CauchyProblem<'a, P, M> {
    /// Solves the problem for τ in the intervals and `from` ≤ s ≤ `to`.
    ///
    /// The manifold is first [classified](Self::classify): only the unique case is solved. Levels of s and
    /// characteristics are added until cubic interpolation meets the resolution; none are where the resolution is
    /// infinite. Every box of the grid of parameters becomes (m − 1)! simplices, each tested along its m (m − 1)/2
    /// edges. With feature `rayon` characteristics are integrated on all cores; the result does not depend on their
    /// number.
    ///
    /// # Errors
    /// [`StripError::Characteristic`](crate::StripError::Characteristic) (infinitely many solutions), [`StripError::Monge`](crate::StripError::Monge) (none),
    /// [`StripError::Degenerate`](crate::StripError::Degenerate) (a point where part of the manifold degenerates);
    /// [`CharacteristicsError::InvalidSpan`], [`CharacteristicsError::InvalidInterval`]; [`CharacteristicsError::TooManyCharacteristics`] with
    /// the error left, where the characteristics or the parts of s allowed do not meet the resolution; as
    /// [`characteristic`](Self::characteristic).
    ///
    /// # Example
    /// ```
    /// use piola_characteristics::*;
    /// use piola_numerics::Real;
    /// struct Burgers; // ∂u/∂t + u ∂u/∂q = 0 in x = (t, q)
    /// impl FirstOrderPde for Burgers {
    ///     const QUASILINEAR: bool = true;
    ///     fn value<T: Real>(&self, _x: &[T], u: T, xi: &[T]) -> T {
    ///         xi[0] + u * xi[1]
    ///     }
    /// }
    /// struct Sine; // u = sin q at t = 0
    /// impl InitialManifold for Sine {
    ///     fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
    ///         (x[0], x[1]) = (T::zero(), tau[0]);
    ///         tau[0].sin()
    ///     }
    /// }
    /// let problem = CauchyProblem::new(&Burgers, &Sine, 2)?;
    /// let wave = [ParameterInterval { from: 0.0, to: 6.0, parts: 8 }];
    /// let solution = problem.solve(&wave, (0.0, 1.5), Refinement::to(1e-3))?;
    /// let shock = solution.first_loss_of_invertibility()?.ok_or("the wave breaks")?;
    /// assert!((shock.point.s - 1.0).abs() < 1e-12); // t = 1 at q = π
    /// let before = solution.at(&[0.5, 0.5 + 0.5 * 0.5_f64.sin()])?; // on the characteristic of q = 1/2
    /// assert!((before.point.u - 0.5_f64.sin()).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// W(A.43).
    pub fn solve(
        &self,
        intervals: &[ParameterInterval],
        (from, to): (f64, f64),
        refinement: Refinement,
    ) -> Result<CharacteristicSolution<'a, P, M>, CharacteristicsError> {
        self.solve_observed(intervals, (from, to), refinement, &mut |_| ControlFlow::Continue(()))
    }

    /// Solves the problem as [`solve`](Self::solve) does. The observer is called now and then with the number of characteristics
    /// that have been integrated, those made again included, and may stop the solution.
    ///
    /// # Errors
    /// [`CharacteristicsError::Stopped`] when the observer asks for it, or as [`solve`](Self::solve).
    pub fn solve_observed(
        &self,
        intervals: &[ParameterInterval],
        (from, to): (f64, f64),
        refinement: Refinement,
        observer: &mut dyn FnMut(usize) -> ControlFlow<()>,
    ) -> Result<CharacteristicSolution<'a, P, M>, CharacteristicsError> {
        let mut watch = Watch { rays: 0, observer };
        self.check_intervals(intervals)?;
        check_span(from, to)?;
        if refinement.resolution.is_nan() || refinement.resolution <= 0.0 {
            let quantity = "resolution";
            return Err(CharacteristicsError::InvalidInterval { quantity, from: 0.0, to: refinement.resolution });
        }
        self.refuse_unless_unique(intervals)?;
        let walk = Walk::new(intervals);
        let mut starts: Vec<(Vec<f64>, Vec<f64>)> = Vec::with_capacity(walk.len());
        for index in 0..walk.len() {
            let m = self.data.variables;
            let guess = walk.before(index).map_or(&self.guess[..], |before| &starts[before].1[m + 1..=2 * m]);
            let tau = walk.parameters(index);
            let start = self.ray_start(&tau, guess)?.1;
            starts.push((tau, start));
        }
        let mut solution = CharacteristicSolution {
            problem: self.clone(),
            intervals: intervals.to_vec(),
            levels: Vec::new(),
            rays: Vec::new(),
            simplices: walk.simplices(),
            error: 0.0,
        };
        // One part has no middle at which its interpolation could be tested.
        let mut parts = refinement.levels.max(2);
        loop {
            solution.levels = levels(from, to, parts);
            solution.rays = self.integrate(&starts, &solution.levels, &mut watch)?;
            // Cubic interpolation over the doubled parts is sixteen times less accurate.
            let error = solution.rays.iter().map(|ray| self.error_between_levels(ray, &solution.levels));
            let error = error.fold(0.0, f64::max) / 16.0;
            if error <= refinement.resolution {
                solution.error = error;
                break;
            }
            if refinement.most_levels < 2 * parts {
                return Err(CharacteristicsError::TooManyCharacteristics { rays: solution.rays.len(), error });
            }
            parts *= 2;
        }
        solution.refine(refinement, &mut watch)?;
        Ok(solution)
    }

    /// The rays of all starts, each by itself: the result does not depend on the number of threads.
    fn integrate(
        &self,
        starts: &[(Vec<f64>, Vec<f64>)],
        levels: &[f64],
        watch: &mut Watch<'_>,
    ) -> Result<Vec<Ray>, CharacteristicsError> {
        let mut rays = Vec::with_capacity(starts.len());
        for starts in starts.chunks(BETWEEN_LOOKS) {
            // The first failure in the order of the rays, whichever thread met it first.
            for ray in self.integrate_together(starts, levels) {
                rays.push(ray?);
            }
            watch.integrated(starts.len())?;
        }
        Ok(rays)
    }

    fn integrate_together(
        &self,
        starts: &[(Vec<f64>, Vec<f64>)],
        levels: &[f64],
    ) -> Vec<Result<Ray, CharacteristicsError>> {
        let equation = self.data.equation;
        let marcher = || Marcher::new(equation, self.data.variables, self.tolerance);
        let ray = |marcher: &mut Marcher<'a, P>, (tau, start): &(Vec<f64>, Vec<f64>)| {
            marcher.ray(equation, (tau, start), levels)
        };
        #[cfg(feature = "rayon")]
        {
            use rayon::prelude::*;
            starts.par_iter().map_init(marcher, ray).collect()
        }
        #[cfg(not(feature = "rayon"))]
        {
            let mut marcher = marcher();
            starts.iter().map(|start| ray(&mut marcher, start)).collect()
        }
    }

    /// The largest error, in the unit of x, of cubic interpolation over every two neighbouring parts, at the level
    /// between them: every part is in one of the pairs.
    fn error_between_levels(&self, ray: &Ray, levels: &[f64]) -> f64 {
        let n = ray.states.len() / levels.len();
        let mut largest = 0.0_f64;
        for j in 1..levels.len().saturating_sub(1) {
            let h = levels[j + 1] - levels[j - 1];
            // Across s = 0 the parts may differ.
            if 1e-9 * h < (2.0 * levels[j] - levels[j - 1] - levels[j + 1]).abs() {
                continue;
            }
            let row = |rows: &'_ [f64], j: usize, i: usize| rows[j * n + i];
            largest = largest.max(self.difference(&ray.states[j * n..], |i| {
                0.5 * (row(&ray.states, j - 1, i) + row(&ray.states, j + 1, i))
                    + 0.125 * h * (row(&ray.rates, j - 1, i) - row(&ray.rates, j + 1, i))
            }));
        }
        largest
    }

    /// The distance between a state (x, u, ξ) and an interpolated one, u by |ξ|.
    fn difference(&self, state: &[f64], interpolated: impl Fn(usize) -> f64) -> f64 {
        let m = self.data.variables;
        let mut largest = 0.0_f64;
        for i in 0..m {
            largest = largest.max((state[i] - interpolated(i)).abs());
        }
        let xi = state[m + 1..=2 * m].iter().fold(0.0_f64, |xi, x| xi.max(x.abs()));
        if 0.0 < xi { largest.max((state[m] - interpolated(m)).abs() / xi) } else { largest }
    }
}

impl<P: FirstOrderPde + Sync, M: InitialManifold + Sync> CharacteristicSolution<'_, P, M> {
    /// Adds characteristics in the middles of edges until interpolation across them meets the resolution.
    fn refine(&mut self, refinement: Refinement, watch: &mut Watch<'_>) -> Result<(), CharacteristicsError> {
        if refinement.resolution.is_infinite() {
            return Ok(());
        }
        let mut settled: BTreeSet<(usize, usize)> = BTreeSet::new();
        loop {
            let open: Vec<_> = edges(&self.simplices).into_iter().filter(|edge| !settled.contains(edge)).collect();
            if open.is_empty() {
                return Ok(());
            }
            let mut starts = Vec::with_capacity(open.len());
            for &(a, b) in &open {
                let m = self.problem.data.variables;
                let tau: Vec<f64> =
                    self.rays[a].parameters.iter().zip(&self.rays[b].parameters).map(|(a, b)| 0.5 * (a + b)).collect();
                let zero = self.levels.partition_point(|&s| s < 0.0);
                let guess = &self.row(&self.rays[a].states, zero)[m + 1..=2 * m];
                let start = self.problem.ray_start(&tau, guess)?.1;
                starts.push((tau, start));
            }
            let rays = self.problem.integrate(&starts, &self.levels, watch)?;
            let (mut middles, mut worst) = (BTreeMap::new(), 0.0_f64);
            for ((a, b), ray) in open.into_iter().zip(rays) {
                let error = self.error_across((a, b), &ray);
                if error <= refinement.resolution {
                    settled.insert((a, b));
                    self.error = self.error.max(error);
                } else {
                    worst = worst.max(error);
                    middles.insert((a, b), self.rays.len());
                    self.rays.push(ray);
                }
            }
            if middles.is_empty() {
                return Ok(());
            }
            if refinement.most_rays < self.rays.len() {
                return Err(CharacteristicsError::TooManyCharacteristics { rays: self.rays.len(), error: worst });
            }
            let length = |(a, b): (usize, usize)| {
                let (a, b) = (&self.rays[a].parameters, &self.rays[b].parameters);
                let parts = a.iter().zip(b).zip(&self.intervals);
                parts.map(|((a, b), i)| ((a - b) / (i.to - i.from)).powi(2)).sum::<f64>()
            };
            self.simplices = cut(&self.simplices, &middles, length);
        }
    }

    /// The largest error of cubic interpolation between two rays, at a ray in their middle.
    fn error_across(&self, (a, b): (usize, usize), ray: &Ray) -> f64 {
        let (a, b) = (&self.rays[a], &self.rays[b]);
        let n = 2 * self.problem.data.variables + 1;
        let step: Vec<f64> = b.parameters.iter().zip(&a.parameters).map(|(b, a)| b - a).collect();
        let mut largest = 0.0_f64;
        for level in 0..self.levels.len() {
            let (ya, yb) = (self.row(&a.states, level), self.row(&b.states, level));
            let along = |y: &[f64], i: usize| -> f64 {
                step.iter().enumerate().map(|(k, step)| step * y[(k + 1) * n + i]).sum()
            };
            largest = largest.max(self.problem.difference(self.row(&ray.states, level), |i| {
                0.5 * (ya[i] + yb[i]) + 0.125 * (along(ya, i) - along(yb, i))
            }));
        }
        largest
    }
}

/// Characteristics that are integrated between two calls of the observer.
const BETWEEN_LOOKS: usize = 16;

/// Counts the characteristics, and asks the observer whether to go on.
struct Watch<'o> {
    rays: usize,
    observer: &'o mut dyn FnMut(usize) -> ControlFlow<()>,
}

impl Watch<'_> {
    fn integrated(&mut self, count: usize) -> Result<(), CharacteristicsError> {
        self.rays += count;
        match (self.observer)(self.rays) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(CharacteristicsError::Stopped { rays: self.rays }),
        }
    }
}

/// Levels of s with zero among them, each side in equal parts.
fn levels(from: f64, to: f64, parts: usize) -> Vec<f64> {
    let share = |i: usize, end: f64| if i == parts { end } else { end * (i as f64 / parts as f64) };
    let mut levels = Vec::with_capacity(2 * parts + 1);
    if from < 0.0 {
        levels.extend((1..=parts).rev().map(|i| share(i, from)));
    }
    levels.push(0.0);
    if 0.0 < to {
        levels.extend((1..=parts).map(|i| share(i, to)));
    }
    levels
}
