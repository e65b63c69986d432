//! Creeping flow of a viscous fluid, with the displacement of its particles.

mod interpolation;

use crate::Precision;
use crate::error::{SpectralError, check_bound, check_length};
use crate::solver::BoxSolver;

pub(crate) use interpolation::interpolate;

/// What a step of a flow did.
///
/// # Example
/// ```
/// use piola_spectral::FlowReport;
/// let report = FlowReport { least_jacobian: 0.8, largest_courant_number: 0.5, was_regridded: false };
/// assert!(0.5 < report.least_jacobian);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowReport {
    /// The least det(1 − ∇u) at the points of the grid, of the displacement since the last regridding.
    pub least_jacobian: f64,
    /// The largest Courant number, h times speed over spacing along an axis: steps beyond about 0.8 are unstable.
    pub largest_courant_number: f64,
    /// Whether the displacement so far was put away before the step.
    pub was_regridded: bool,
}

/// The creeping flow of a viscous fluid, and the map of its particles.
///
/// ```text
/// 0 = f + μΔv + (λ + μ)∇(∇·v)          the velocity
/// ∂u/∂t = v − (∇u) v                   the Eulerian displacement: the particle now at x was at x − u(x)
/// ```
/// When det(1 − ∇u) would fall below a bound, the displacement is put away as a finished map and a new one begins at zero. The
/// map of the whole flow is the composition of all. Each piece maps the box onto itself, and each has a Jacobian above the
/// bound at all points of the grid: the composition is invertible, with the product of the least Jacobians as a lower bound.
///
/// Derivatives are those of the modes. Time is advanced by the classical Runge–Kutta method of order 4.
///
/// # Example
/// ```
/// use piola_spectral::{BoxGrid, BoxOperator, BoxSolver, LameParameters, ViscousFlow, Walls};
/// use std::f64::consts::PI;
/// let grid = BoxGrid::cells([16, 16], [1.0 / 16.0, 1.0 / 16.0])?;
/// let solver = BoxSolver::<f64, 2>::new(grid, Walls::Sliding, BoxOperator::elastic(LameParameters::new(0.0, 1.0)?))?;
/// let mut flow = ViscousFlow::new(solver, 0.5)?;
/// let mut x: Vec<f64> = (0..grid.len()).map(|p| (PI * grid.position(grid.indices(p))[0]).sin()).collect();
/// let mut y = vec![0.0; grid.len()];
/// flow.velocity_in_place([&mut x, &mut y])?; // the force becomes the velocity sin πx/(2π²)
/// let report = flow.step([&x, &y], 0.1)?;
/// // Particles came from the left.
/// assert!(flow.reference_position([0.5, 0.5])?[0] < 0.5);
/// assert!(0.9 < report.least_jacobian && flow.certified_jacobian() == report.least_jacobian);
/// # Ok::<(), piola_spectral::SpectralError>(())
/// ```
///
/// # Source
/// B(4.85); regridding as in §4.5 there.
#[derive(Clone, Debug)]
pub struct ViscousFlow<T, const D: usize> {
    solver: BoxSolver<T, D>,
    bound: f64,
    displacement: [Vec<T>; D],
    least_jacobian: f64,
    finished: Vec<FinishedMap<T, D>>,
    work: Work<T, D>,
}

/// A displacement that was put away, with its least Jacobian.
#[derive(Clone, Debug, PartialEq)]
struct FinishedMap<T, const D: usize> {
    displacement: [Vec<T>; D],
    least_jacobian: f64,
}

/// The memory of a step.
#[derive(Clone, Debug)]
struct Work<T, const D: usize> {
    gradient: [[Vec<T>; D]; D],
    stage: [Vec<T>; D],
    sum: [Vec<T>; D],
}

impl<T: Precision, const D: usize> ViscousFlow<T, D> {
    /// A fluid at rest. The viscosities λ and μ are those of the solver's operator; regridding keeps
    /// `least_jacobian` < det(1 − ∇u).
    ///
    /// # Errors
    /// 0 < `least_jacobian` < 1 violated.
    pub fn new(solver: BoxSolver<T, D>, least_jacobian: f64) -> Result<Self, SpectralError> {
        check_bound("least Jacobian", least_jacobian, "0 < J < 1", 0.0 < least_jacobian && least_jacobian < 1.0)?;
        let zeros = || std::array::from_fn(|_| vec![T::lit(0.0); solver.grid().len()]);
        let work = Work { gradient: std::array::from_fn(|_| zeros()), stage: zeros(), sum: zeros() };
        let displacement = zeros();
        Ok(Self { solver, bound: least_jacobian, displacement, least_jacobian: 1.0, finished: Vec::new(), work })
    }

    /// The solver.
    #[must_use]
    pub fn solver(&self) -> &BoxSolver<T, D> {
        &self.solver
    }

    /// Replaces the force by the velocity, m/s.
    ///
    /// # Errors
    /// As of [`BoxSolver::solve_in_place`].
    pub fn velocity_in_place(&mut self, fields: [&mut [T]; D]) -> Result<(), SpectralError> {
        self.solver.solve_in_place(fields)
    }

    /// Advances the displacement by h with a velocity that is steady during the step.
    ///
    /// # Errors
    /// A list of the wrong length, a velocity or h that is not finite, 0 ≤ h violated. [`SpectralError::Folded`] when the
    /// Jacobian would fall below the bound in this step alone: the flow is then as before the step, and a shorter one may pass.
    pub fn step(&mut self, velocity: [&[T]; D], h: f64) -> Result<FlowReport, SpectralError> {
        check_bound("h", h, "0 <= h", 0.0 <= h)?;
        let mut largest_courant_number = 0.0_f64;
        for (component, velocity) in velocity.iter().enumerate() {
            check_length("velocity", velocity.len(), self.solver.grid().len())?;
            for (index, value) in velocity.iter().enumerate() {
                let value = value.primal(0);
                if !value.is_finite() {
                    return Err(SpectralError::NotFinite { quantity: "velocity", index, value });
                }
                let number = h * value.abs() / self.solver.grid().spacings()[component];
                largest_courant_number = largest_courant_number.max(number);
            }
        }
        let mut was_regridded = false;
        loop {
            self.runge_kutta(velocity, T::lit(h));
            let (least_jacobian, index) = self.least_jacobian_of_stage();
            if self.bound < least_jacobian {
                std::mem::swap(&mut self.displacement, &mut self.work.stage);
                self.least_jacobian = least_jacobian;
                return Ok(FlowReport { least_jacobian, largest_courant_number, was_regridded });
            }
            let is_fresh = self.displacement.iter().flatten().all(|value| *value == T::lit(0.0));
            if is_fresh {
                return Err(SpectralError::Folded { index, jacobian: least_jacobian, bound: self.bound });
            }
            self.regrid();
            was_regridded = true;
        }
    }

    /// Puts the displacement so far away as a finished map, and begins at zero.
    pub fn regrid(&mut self) {
        let zeros = std::array::from_fn(|_| vec![T::lit(0.0); self.solver.grid().len()]);
        let displacement = std::mem::replace(&mut self.displacement, zeros);
        self.finished.push(FinishedMap { displacement, least_jacobian: self.least_jacobian });
        self.least_jacobian = 1.0;
    }

    /// The displacement since the last regridding, m.
    #[must_use]
    pub fn displacement(&self) -> [&[T]; D] {
        self.displacement.each_ref().map(Vec::as_slice)
    }

    /// How often the displacement was put away.
    #[must_use]
    pub fn regriddings(&self) -> usize {
        self.finished.len()
    }

    /// The pieces of the map, each with its displacement, m, and its least Jacobian: those that were put away, then the last one.
    pub fn pieces(&self) -> impl Iterator<Item = ([&[T]; D], f64)> {
        let finished =
            self.finished.iter().map(|map| (map.displacement.each_ref().map(Vec::as_slice), map.least_jacobian));
        finished.chain([(self.displacement(), self.least_jacobian)])
    }

    /// A flow that goes on from the [`pieces`](Self::pieces) of another, bit for bit as that one would.
    ///
    /// # Errors
    /// As of [`new`](Self::new); no piece, a list of the wrong length, a displacement or a least Jacobian that is not finite.
    pub fn from_pieces(
        solver: BoxSolver<T, D>,
        least_jacobian: f64,
        pieces: impl IntoIterator<Item = ([Vec<T>; D], f64)>,
    ) -> Result<Self, SpectralError> {
        let mut flow = Self::new(solver, least_jacobian)?;
        for (displacement, least_jacobian) in pieces {
            for list in &displacement {
                check_length("displacement", list.len(), flow.solver.grid().len())?;
                for (index, value) in list.iter().enumerate() {
                    let value = value.primal(0);
                    if !value.is_finite() {
                        return Err(SpectralError::NotFinite { quantity: "displacement", index, value });
                    }
                }
            }
            check_bound("least Jacobian", least_jacobian, "0 < J", 0.0 < least_jacobian)?;
            flow.finished.push(FinishedMap { displacement, least_jacobian });
        }
        let Some(last) = flow.finished.pop() else {
            return Err(SpectralError::WrongLength { quantity: "pieces", found: 0, expected: 1 });
        };
        (flow.displacement, flow.least_jacobian) = (last.displacement, last.least_jacobian);
        Ok(flow)
    }

    /// A lower bound of the Jacobian of the whole map at the points of the grids: the product of the least Jacobians of its
    /// pieces. It is positive, so the map is invertible.
    #[must_use]
    pub fn certified_jacobian(&self) -> f64 {
        self.finished.iter().map(|map| map.least_jacobian).product::<f64>() * self.least_jacobian
    }

    /// Where the particle that is now at `place` was at first, m: the composition of all maps.
    ///
    /// # Errors
    /// A place that is not finite, or outside the box.
    ///
    /// # Accuracy
    /// Each map is interpolated by cubic polynomials: order 4 in the spacing.
    pub fn reference_position(&self, place: [f64; D]) -> Result<[f64; D], SpectralError> {
        let sides = self.solver.grid().sides();
        for axis in 0..D {
            let is_inside = 0.0 <= place[axis] && place[axis] <= sides[axis];
            check_bound("place", place[axis], "0 <= x <= L", is_inside)?;
        }
        let maps = self.finished.iter().map(|map| &map.displacement).chain([&self.displacement]).rev();
        Ok(maps.fold(place, |place, map| {
            std::array::from_fn(|component| {
                let (grid, walls) = (self.solver.grid(), self.solver.walls());
                let u = interpolate(grid, walls, component, &map[component], place);
                (place[component] - u).clamp(0.0, sides[component])
            })
        }))
    }

    /// The displacement of the whole flow at the points of the grid: x less the place where its particle was at first.
    ///
    /// # Errors
    /// A list of the wrong length.
    pub fn total_displacement_into(&self, out: &mut [Vec<T>; D]) -> Result<(), SpectralError> {
        let grid = self.solver.grid();
        for out in out.iter() {
            check_length("displacement", out.len(), grid.len())?;
        }
        for point in 0..grid.len() {
            let place = grid.position(grid.indices(point));
            let reference = self.reference_position(place)?;
            for component in 0..D {
                out[component][point] = T::lit(place[component] - reference[component]);
            }
        }
        Ok(())
    }

    /// One step from the displacement; the result is in `stage`.
    fn runge_kutta(&mut self, velocity: [&[T]; D], h: T) {
        let Self { solver, displacement, work, .. } = self;
        for component in 0..D {
            work.stage[component].copy_from_slice(&displacement[component]);
            work.sum[component].copy_from_slice(&displacement[component]);
        }
        for (share, ahead) in [(1.0 / 6.0, 0.5), (1.0 / 3.0, 0.5), (1.0 / 3.0, 1.0), (1.0 / 6.0, 0.0)] {
            solver.differentiate(work.stage.each_ref().map(Vec::as_slice), &mut work.gradient);
            let (share, ahead) = (T::lit(share) * h, T::lit(ahead) * h);
            for component in 0..D {
                let (stage, sum) = (&mut work.stage[component], &mut work.sum[component]);
                for (point, (stage, sum)) in stage.iter_mut().zip(sum).enumerate() {
                    let mut rate = velocity[component][point];
                    for axis in 0..D {
                        rate -= work.gradient[component][axis][point] * velocity[axis][point];
                    }
                    *sum += share * rate;
                    *stage = displacement[component][point] + ahead * rate;
                }
            }
        }
        std::mem::swap(&mut work.stage, &mut work.sum);
    }

    /// The least det(1 − ∇u) of the result, and its point.
    fn least_jacobian_of_stage(&mut self) -> (f64, usize) {
        let Self { solver, work, .. } = self;
        solver.differentiate(work.stage.each_ref().map(Vec::as_slice), &mut work.gradient);
        let mut least = (f64::INFINITY, 0);
        for point in 0..solver.grid().len() {
            let mut f = [[0.0; 3]; 3];
            for (row, entries) in f.iter_mut().enumerate() {
                for (column, entry) in entries.iter_mut().enumerate() {
                    let unit = if row == column { 1.0 } else { 0.0 };
                    *entry =
                        if row < D && column < D { unit - work.gradient[row][column][point].primal(0) } else { unit };
                }
            }
            let jacobian = piola_numerics::linear::matrix3::determinant(f);
            if jacobian.is_nan() {
                return (f64::NEG_INFINITY, point); // overflow: folded
            }
            if jacobian < least.0 {
                least = (jacobian, point);
            }
        }
        least
    }
}
