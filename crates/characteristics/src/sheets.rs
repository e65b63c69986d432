//! The solution at a point: the ray map inverted, on every sheet.

use piola_numerics::linear::lu;

use super::ray::Marcher;
use super::{CharacteristicSolution, FirstOrderPde, InitialManifold, Overlap, RayPoint};
use crate::CharacteristicsError;
use crate::check::{check_finite, check_length};

/// A part of a cell's extent by which its box is made larger, since rays and fronts are bent.
const MARGIN: f64 = 0.3;

/// The solution at a point on one of its sheets.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sheet {
    /// The characteristic that reaches the point, with u and ξ = ∇u there.
    pub point: RayPoint,
    /// How many caustics it has passed on its way: none on the sheet of the data.
    pub caustics: usize,
}

impl<P: FirstOrderPde + Sync, M: InitialManifold + Sync> CharacteristicSolution<'_, P, M> {
    /// The solution at x, where there is one sheet and its characteristic has met no caustic.
    ///
    /// # Errors
    /// [`CharacteristicsError::OutsideOfCharacteristics`], [`CharacteristicsError::SeveralSheets`] with all values,
    /// [`CharacteristicsError::BeyondCaustic`]; [`CharacteristicsError::WrongLength`], [`CharacteristicsError::NotFinite`].
    ///
    /// # Accuracy
    /// That of the tolerance over the smallest singular value of the ray map: the characteristic through x is
    /// integrated, nothing is interpolated.
    pub fn at(&self, x: &[f64]) -> Result<Sheet, CharacteristicsError> {
        let mut sheets = self.sheets_at(x)?;
        match sheets.len() {
            0 => Err(self.outside(x)),
            1 => {
                let sheet = sheets.remove(0);
                if sheet.caustics == 0 {
                    Ok(sheet)
                } else {
                    let (point, value, caustics) = (x.to_vec(), sheet.point.u, sheet.caustics);
                    Err(CharacteristicsError::BeyondCaustic { point, value, caustics })
                }
            }
            _ => {
                let values = sheets.iter().map(|sheet| sheet.point.u).collect();
                Err(CharacteristicsError::SeveralSheets { point: x.to_vec(), values })
            }
        }
    }

    /// The sheet with the least u at x: the first arrival where u is the time of a front, the viscosity solution where
    /// Φ = ∂u/∂t + H with convex H.
    ///
    /// # Errors
    /// [`CharacteristicsError::OutsideOfCharacteristics`]; as [`sheets_at`](Self::sheets_at).
    pub fn first_arrival(&self, x: &[f64]) -> Result<Sheet, CharacteristicsError> {
        let sheets = self.sheets_at(x)?;
        let least = sheets.into_iter().min_by(|a, b| a.point.u.total_cmp(&b.point.u));
        least.ok_or_else(|| self.outside(x))
    }

    /// All sheets of the solution at x, in the order of s; none where no characteristic passes.
    ///
    /// In each cell of characteristics and levels whose box contains x, Newton's iteration on the ray map starts from
    /// the middle, and from the corners of cells that a caustic crosses; for m = 2 from the solutions of the
    /// interpolated cell. Two sheets closer than the resolution can be missed.
    ///
    /// # Errors
    /// [`CharacteristicsError::WrongLength`], [`CharacteristicsError::NotFinite`].
    pub fn sheets_at(&self, x: &[f64]) -> Result<Vec<Sheet>, CharacteristicsError> {
        check_length("x", self.problem.data.variables, x.len())?;
        check_finite("x", x)?;
        let mut inversion = Inversion::new(self, x);
        for simplex in &self.simplices {
            for level in 0..self.levels.len().saturating_sub(1) {
                inversion.look_in(simplex, level);
            }
        }
        if inversion.found.is_empty() {
            let (ray, level, _) = self.nearest(x);
            inversion.start(self.rays[ray].parameters.clone(), self.levels[level], ray, None);
        }
        let mut sheets = inversion.found;
        sheets.sort_by(|a, b| a.point.s.total_cmp(&b.point.s));
        Ok(sheets)
    }

    /// The solution at given points, a grid in any number of variables for one: [`sheets_at`](Self::sheets_at) for
    /// each, in their order; `None` where no characteristic passes, or several do and `overlap` keeps nothing of them.
    ///
    /// The characteristic through each point is integrated, which costs more than the interpolation of
    /// [`onto_grid`](Self::onto_grid) in the plane and gives u and ξ to the tolerance. With feature `rayon` points are
    /// shared among all cores; the result does not depend on their number.
    ///
    /// # Errors
    /// As [`sheets_at`](Self::sheets_at): the first point that is refused.
    pub fn at_points(&self, points: &[Vec<f64>], overlap: Overlap) -> Result<Vec<Option<Sheet>>, CharacteristicsError> {
        let single = |x: &Vec<f64>| -> Result<Option<Sheet>, CharacteristicsError> {
            let sheets = self.sheets_at(x)?;
            if 1 < sheets.len() && overlap == Overlap::Nothing {
                return Ok(None);
            }
            Ok(sheets.into_iter().min_by(|a, b| a.point.u.total_cmp(&b.point.u)))
        };
        #[cfg(feature = "rayon")]
        let found: Vec<_> = {
            use rayon::prelude::*;
            points.par_iter().map(single).collect()
        };
        #[cfg(not(feature = "rayon"))]
        let found: Vec<_> = points.iter().map(single).collect();
        found.into_iter().collect()
    }

    /// The computed state nearest to x: its ray, its level, its distance.
    fn nearest(&self, x: &[f64]) -> (usize, usize, f64) {
        let mut nearest = (0, 0, f64::INFINITY);
        for (index, ray) in self.rays.iter().enumerate() {
            for level in 0..self.levels.len() {
                let row = self.row(&ray.states, level);
                let distance = x.iter().zip(row).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
                if distance < nearest.2 {
                    nearest = (index, level, distance);
                }
            }
        }
        nearest
    }

    fn outside(&self, x: &[f64]) -> CharacteristicsError {
        let (ray, _, distance) = self.nearest(x);
        let parameters = self.rays[ray].parameters.clone();
        CharacteristicsError::OutsideOfCharacteristics { point: x.to_vec(), parameters, distance }
    }
}

/// By how much of itself a cell in the plane is made larger, since it is interpolated.
const NEAR: f64 = 0.05;

/// The extent of a cell in s and in the parameters.
struct Cell {
    /// The lower and the upper end of s, then of each parameter.
    extents: Vec<(f64, f64)>,
}

impl Cell {
    fn new<P, M>(solution: &CharacteristicSolution<'_, P, M>, simplex: &[usize], level: usize) -> Self {
        let mut extents = vec![(solution.levels[level], solution.levels[level + 1])];
        for i in 0..solution.intervals.len() {
            let values = || simplex.iter().map(|&ray| solution.rays[ray].parameters[i]);
            extents.push((values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)));
        }
        Self { extents }
    }

    /// Farther than the cell is wide.
    fn is_far_from(&self, s: f64, tau: &[f64]) -> bool {
        let far =
            |(&value, &(low, high)): (&f64, &(f64, f64))| value < low - (high - low) || high + (high - low) < value;
        [s].iter().chain(tau).zip(&self.extents).any(far)
    }
}

/// The search for the characteristics that pass through one point.
struct Inversion<'s, 'a, P, M> {
    solution: &'s CharacteristicSolution<'a, P, M>,
    marcher: Marcher<'a, P>,
    x: &'s [f64],
    found: Vec<Sheet>,
}

impl<'s, 'a, P: FirstOrderPde + Sync, M: InitialManifold + Sync> Inversion<'s, 'a, P, M> {
    fn new(solution: &'s CharacteristicSolution<'a, P, M>, x: &'s [f64]) -> Self {
        let problem = &solution.problem;
        let marcher = Marcher::new(problem.data.equation, problem.data.variables, problem.tolerance);
        Self { solution, marcher, x, found: Vec::new() }
    }

    /// Starts Newton's iterations in a cell whose box contains the point.
    fn look_in(&mut self, simplex: &[usize], level: usize) {
        let solution = self.solution;
        let corners = || simplex.iter().flat_map(|&ray| [(ray, level), (ray, level + 1)]);
        for (i, &x) in self.x.iter().enumerate() {
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for (ray, level) in corners() {
                let corner = solution.row(&solution.rays[ray].states, level)[i];
                (low, high) = (low.min(corner), high.max(corner));
            }
            // A flat cell is as thick as it is wide in the other coordinates, which bend into this one.
            let margin = MARGIN * (high - low) + solution.problem_resolution();
            if x < low - margin || high + margin < x {
                return;
            }
        }
        let negative = |(ray, level): (usize, usize)| solution.rays[ray].determinants[level] < 0.0;
        let folded = corners().any(negative) && !corners().all(negative);
        let cell = Cell::new(solution, simplex, level);
        if let ([first, second], &[x, y]) = (simplex, self.x) {
            // In the plane the interpolated cell tells where to start, and whether.
            let patch = solution.patch((*first, *second), level);
            let starts = [(0.5, 0.5), (0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
            for &start in if folded { &starts[..] } else { &starts[..1] } {
                if let Some((a, b, _)) = patch.invert([x, y], start, NEAR) {
                    let (low, high) = (solution.rays[*first].parameters[0], solution.rays[*second].parameters[0]);
                    let (s0, s1) = (solution.levels[level], solution.levels[level + 1]);
                    self.start(vec![low + b * (high - low)], s0 + a * (s1 - s0), *first, Some(&cell));
                }
            }
            return;
        }
        let mut middle = vec![0.0; self.x.len() - 1];
        for &ray in simplex {
            for (middle, tau) in middle.iter_mut().zip(&solution.rays[ray].parameters) {
                *middle += tau / simplex.len() as f64;
            }
        }
        let (s0, s1) = (solution.levels[level], solution.levels[level + 1]);
        self.start(middle, 0.5 * (s0 + s1), simplex[0], Some(&cell));
        if folded {
            for (ray, level) in corners() {
                self.start(solution.rays[ray].parameters.clone(), solution.levels[level], ray, Some(&cell));
            }
        }
    }

    /// One Newton iteration for x(s, τ) = x; failures are not solutions, nor is what lies far from the cell: the cell
    /// that it lies in finds it.
    fn start(&mut self, mut tau: Vec<f64>, mut s: f64, ray: usize, cell: Option<&Cell>) {
        const STEPS: usize = 40;
        let m = self.x.len();
        let (solution, n) = (self.solution, 2 * m + 1);
        let (from, to) = (solution.levels[0], solution.levels[solution.levels.len() - 1]);
        tau.iter_mut().zip(&solution.intervals).for_each(|(tau, i)| *tau = tau.clamp(i.from, i.to));
        s = s.clamp(from, to);
        let guess = solution.covector_at_zero(ray).to_vec();
        let mut matrix = vec![0.0; m * m];
        let mut exchanges = vec![0; m];
        let mut rate = vec![0.0; n * m];
        for _ in 0..STEPS {
            let Ok((_, start)) = solution.problem.ray_start(&tau, &guess) else { return };
            let Ok(y) = self.marcher.state_at(&start, s) else { return };
            self.marcher.field.rate_into(&y, &mut rate);
            matrix[..m].copy_from_slice(&rate[..m]);
            for a in 1..m {
                matrix[a * m..(a + 1) * m].copy_from_slice(&y[a * n..a * n + m]);
            }
            let mut step: Vec<f64> = self.x.iter().zip(&y).map(|(x, y)| x - y).collect();
            let size = y[..m].iter().chain(self.x).fold(0.0_f64, |size, x| size.max(x.abs()));
            let residual = step.iter().fold(0.0_f64, |r, x| r.max(x.abs()));
            if lu::factor_in_place(&mut matrix, &mut exchanges).is_err()
                || lu::solve_in_place(&matrix, &exchanges, &mut step).is_err()
            {
                return;
            }
            let mut moved = step[0].abs() / (to - from);
            for (step, interval) in step[1..].iter().zip(&solution.intervals) {
                moved = moved.max(step.abs() / (interval.to - interval.from));
            }
            if moved <= 1e-13 || residual <= 4.0 * f64::EPSILON * size {
                self.keep(&tau, s, &start, &y);
                return;
            }
            // Not farther than a quarter of the domain at once, and not out of it.
            let share = (0.25 / moved).min(1.0);
            s = (s + share * step[0]).clamp(from, to);
            for ((tau, step), interval) in tau.iter_mut().zip(&step[1..]).zip(&solution.intervals) {
                *tau = (*tau + share * step).clamp(interval.from, interval.to);
            }
            if cell.is_some_and(|cell| cell.is_far_from(s, &tau)) {
                return;
            }
        }
    }

    /// Keeps a solution unless it is known.
    fn keep(&mut self, tau: &[f64], s: f64, start: &[f64], y: &[f64]) {
        /// Closer than this share of the domain two solutions are one.
        const SAME: f64 = 1e-7;
        let solution = self.solution;
        let span = solution.levels[solution.levels.len() - 1] - solution.levels[0];
        let point = solution.problem.ray_point(&mut self.marcher, tau, s, y);
        let xi = point.xi.iter().fold(0.0_f64, |xi, x| xi.max(x.abs()));
        let known = self.found.iter().any(|other| {
            let other = &other.point;
            let near = other.parameters.iter().zip(tau).zip(&solution.intervals);
            let one_ray = near.into_iter().all(|((a, b), i)| (a - b).abs() <= SAME * (i.to - i.from));
            // On a closed manifold one ray has two parameters.
            let one_strip = other.xi.iter().zip(&point.xi).all(|(a, b)| (a - b).abs() <= SAME * xi)
                && (other.u - point.u).abs() <= SAME * (point.u.abs() + xi * span);
            (other.s - s).abs() <= SAME * span && (one_ray || one_strip)
        });
        if known {
            return;
        }
        let levels = if s < 0.0 { vec![s, 0.0] } else { vec![0.0, s] };
        let equation = solution.problem.data.equation;
        let caustics = if s.abs() <= 0.0 {
            0
        } else {
            self.marcher.ray(equation, (tau, start), &levels).map_or(0, |ray| ray.caustic.len())
        };
        self.found.push(Sheet { point, caustics });
    }
}

impl<P, M> CharacteristicSolution<'_, P, M> {
    /// What boxes of cells are made larger by, whatever their extent.
    pub(super) const fn problem_resolution(&self) -> f64 {
        4.0 * self.error
    }
}
