//! All extremals between two events: starts on a grid of momenta, brackets with one degree of freedom, and a balance of
//! orientations with two.

use nalgebra::DMatrix;
use piola_integrators::Tolerance;

use super::degree::orientation;
use super::events::{Event, SearchRegion};
use super::geodetic_distance::{Extremal, GeodeticDistance, Problem, check_events};
use crate::PhaseFunction;
use crate::ray::{MOST_STEPS, RayEnd};
use crate::{HamiltonJacobiError, HamiltonianError};

/// How often the grid of a search is doubled while sheets are known to be missing.
const DOUBLINGS: usize = 3;
/// The relative tolerance of a search, whose finds are refined afterwards.
const COARSE: Tolerance = match Tolerance::relative(1e-9) {
    Ok(tolerance) => tolerance,
    Err(_) => unreachable!(),
};
/// Steps after which a ray of a search is given up: it heads for a singularity.
const SEARCH_STEPS: u64 = 1000;

impl<H: PhaseFunction> GeodeticDistance<'_, H> {
    /// All sheets in a search region: every extremal between the events whose initial momentum lies in a box, in the
    /// order of the distance.
    ///
    /// [`between`](Self::between) is started from each point of the region's grid, and what is found twice is given
    /// once. **Guaranteed** is that each sheet given is an extremal, that no two are the same, and that a sheet is
    /// found when a point of the grid lies where Newton's iteration converges to it. With one degree of freedom more is
    /// done: folds of q(t₁; p₀) and changes of sign of its miss are bracketed between neighbouring points of the
    /// grid, so that all sheets are found when no two folds lie between the same two points. With two, the orientations
    /// of the sheets found are balanced against the [`degree`](Self::degree) of the region, and while they differ the
    /// grid is doubled, three times at most: what is then still missing comes in pairs of opposite orientation, or the
    /// degree is not known. With more, that no further sheet exists is not proven: compare with a finer grid. With two
    /// and more, rays are sought at 1e-9 first, given up after a thousand steps (they head for a singularity), and what
    /// is found is refined to the tolerance.
    ///
    /// # Errors
    /// As [`between`](Self::between); [`HamiltonJacobiError::ConjugateEvents`] also when only one of the sheets found ends
    /// in a conjugate point, since its number of neighbours is then not defined.
    ///
    /// # Example
    /// A pendulum that is to be back after a time: it may be pushed either way.
    /// ```
    /// use piola_hamiltonian::hamilton_jacobi::{Event, GeodeticDistance, SearchRegion};
    /// use piola_hamiltonian::PhaseFunction;
    /// use piola_numerics::Real;
    /// struct Pendulum; // H = p²/2 − 4 cos q
    /// impl PhaseFunction for Pendulum {
    ///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
    ///         T::lit(0.5) * p[0] * p[0] - T::lit(4.0) * q[0].cos()
    ///     }
    /// }
    /// let region = SearchRegion::new(&[-6.0], &[6.0], 16)?;
    /// let (from, to) = (Event::new(&[0.5], 0.0), Event::new(&[0.5], 4.0));
    /// let sheets = GeodeticDistance::new(&Pendulum).all_between(&from, &to, &region)?;
    /// assert_eq!(sheets.len(), 5); // from a push one way, over swings to and fro, to a push the other way
    /// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
    /// ```
    pub fn all_between(
        &self,
        from: &Event,
        to: &Event,
        region: &SearchRegion,
    ) -> Result<Vec<Extremal>, HamiltonianError> {
        check_events(from, to, region.lower.len())?;
        let problem = self.problem(from, to);
        // With one degree of freedom the brackets need every digit and every step; with more, the search does not.
        let (tolerance, most_steps) =
            if from.coordinates.len() == 1 { (self.tolerance, MOST_STEPS) } else { (self.coarser(), SEARCH_STEPS) };
        let coarse = Self { hamiltonian: self.hamiltonian, tolerance };
        let search = Problem { distance: &coarse, from, to, most_steps };
        let mut gathered = Gathered { miss: f64::INFINITY, seen: Vec::new(), found: Vec::new() };
        let mut region = region.clone();
        if let ([lower], [upper]) = (&region.lower[..], &region.upper[..]) {
            let bracketed = problem.bracketed((*lower, *upper), region.resolution);
            gathered.gather((&problem, &search), &region, bracketed.into_iter());
        }
        gathered.gather((&problem, &search), &region, (0..region.starts()).map(|number| region.start(number)));
        if from.coordinates.len() == 2
            && let Some(degree) = search.degree(&region)
        {
            for _ in 0..DOUBLINGS {
                if gathered.found.iter().map(|(_, end)| problem.orientation(end)).sum::<i32>() == degree {
                    break;
                }
                region.resolution = region.resolution.saturating_mul(2);
                gathered.gather((&problem, &search), &region, (0..region.starts()).map(|number| region.start(number)));
            }
        }
        let Gathered { miss, found, .. } = gathered;
        if found.is_empty() {
            return Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NoExtremal {
                miss,
                starts: region.starts(),
            }));
        }
        let mut sheets = Vec::with_capacity(found.len());
        for (momenta, end) in found {
            sheets.push(problem.certify(&momenta, end.sizes)?);
        }
        sheets.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        Ok(sheets)
    }

    /// The tolerance of a search.
    fn coarser(&self) -> Tolerance {
        if self.tolerance.relative_part() < COARSE.relative_part() { COARSE } else { self.tolerance }
    }
}

/// What a search has found.
struct Gathered {
    /// The least distance met from the event.
    miss: f64,
    /// The momenta that the search itself led to.
    seen: Vec<Vec<f64>>,
    /// Those refined, in the region, each once.
    found: Vec<(Vec<f64>, RayEnd)>,
}

impl Gathered {
    /// Starts a coarse search from each of the momenta, and refines what it leads to.
    fn gather<H: PhaseFunction>(
        &mut self,
        (problem, search): (&Problem<'_, '_, H>, &Problem<'_, '_, H>),
        region: &SearchRegion,
        starts: impl Iterator<Item = Vec<f64>>,
    ) {
        for start in starts {
            let Some((momenta, _)) = search.solve(&start, &mut self.miss) else { continue };
            if self.seen.iter().any(|other| region.same(other, &momenta)) {
                continue;
            }
            let refined = problem
                .shoot(&momenta)
                .and_then(|end| problem.newton(&momenta, end, &problem.to.coordinates, &mut self.miss));
            self.seen.push(momenta);
            if let Some((momenta, end)) = refined
                && region.contains(&momenta)
                && !self.found.iter().any(|(other, _)| region.same(other, &momenta))
            {
                self.found.push((momenta, end));
            }
        }
    }
}

impl<H: PhaseFunction> Problem<'_, '_, H> {
    /// The sign of det ∂q₁/∂p₀ of a ray.
    fn orientation(&self, end: &RayEnd) -> i32 {
        let n = self.freedom();
        orientation(DMatrix::from_fn(n, n, |i, j| end.variation(j, i)).determinant())
    }

    /// With one degree of freedom: momenta at which the miss changes sign, between points of a grid and the folds
    /// between them.
    fn bracketed(&self, (lower, upper): (f64, f64), cells: usize) -> Vec<Vec<f64>> {
        /// Halvings of a bracket: enough for one that shrinks to rounding.
        const MOST: usize = 60;
        // (p₀, miss, ∂q₁/∂p₀)
        let look = |p: f64| {
            let end = self.shoot(&[p])?;
            Some((p, end.values[0] - self.to.coordinates[0], end.variation(0, 0)))
        };
        let places = (0..=cells).map(|i| lower + (upper - lower) * i as f64 / cells as f64);
        let mut points = Vec::new();
        for next in places.filter_map(look) {
            if let Some(&before) = points.last() {
                let (mut a, mut b): ((f64, f64, f64), _) = (before, next);
                if a.2 * b.2 < 0.0 {
                    for _ in 0..MOST {
                        let Some(middle) = look(0.5 * (a.0 + b.0)) else { break };
                        if (middle.2 < 0.0) == (a.2 < 0.0) {
                            a = middle;
                        } else {
                            b = middle;
                        }
                        // Once the fold itself has crossed the target there is nothing more to be learnt of it.
                        if middle.1 * before.1 < 0.0 && middle.1 * next.1 < 0.0 {
                            break;
                        }
                    }
                    points.extend([a, b]);
                }
            }
            points.push(next);
        }
        let mut found = Vec::new();
        for pair in points.windows(2) {
            let (mut a, mut b) = (pair[0], pair[1]);
            if b.1 * a.1 < 0.0 {
                // Near enough for Newton's iteration when the slopes at both ends are alike.
                for _ in 0..MOST {
                    if (a.2 - b.2).abs() <= 0.1 * a.2.abs() {
                        break;
                    }
                    let Some(middle) = look(0.5 * (a.0 + b.0)) else { break };
                    if (middle.1 < 0.0) == (a.1 < 0.0) { a = middle } else { b = middle }
                }
                found.push(vec![a.0 - a.1 * ((b.0 - a.0) / (b.1 - a.1))]);
            }
        }
        found
    }
}
