//! The displacement in equilibrium.

use piola_spectral::{BoxGrid, BoxOperator, BoxSolver, ModalSeries, PointLocation, SpectralError, WallForces, Walls};

use super::form::sum;
use super::{BoxFields, Form, Probe, StaticTask};
use crate::Observer;

/// A displacement in equilibrium, with its stress.
///
/// # Example
/// See [`BoxStudy`](super::BoxStudy).
#[derive(Debug, Clone)]
pub struct StaticField<const D: usize> {
    /// The grid.
    pub grid: BoxGrid<D>,
    /// The components of the displacement at its points, m; empty until they are known.
    pub displacement: [Vec<f64>; D],
    /// The components of the stress, Pa; empty until they are known.
    pub stress: [[Vec<f64>; D]; D],
    /// ½∫ ε:σ dV, J (in a rectangle: J/m).
    pub energy: Option<f64>,
    /// The sum of all loads, N (in a rectangle: N/m).
    pub resultant: Option<[f64; D]>,
    /// The force of the near and the far sliding wall of each axis on the body along this axis, N (in a rectangle: N/m).
    pub wall_forces: Option<[[f64; 2]; D]>,
    /// The force per volume normal to the walls, which was treated apart.
    pub lifted: Option<WallForces<D>>,
    /// The displacement at the probes, m.
    pub probes: Vec<(Probe<D>, [f64; D])>,
}

fn zeros<const D: usize>(length: usize) -> [Vec<f64>; D] {
    core::array::from_fn(|_| vec![0.0; length])
}

/// Replaces the velocity or displacement lists by the solution for all loads; what was lifted at the walls.
///
/// Samples of smooth forces are solved for on the grid, modes and forces at points as series: each as exactly as it can be.
pub(super) fn solve_for_loads<const D: usize>(
    fields: &BoxFields<D>,
    solver: &mut BoxSolver<f64, D>,
    is_truncated: bool,
) -> Result<([Vec<f64>; D], Option<WallForces<D>>), SpectralError> {
    let grid = *solver.grid();
    let mut solution = zeros(grid.len());
    let mut lifted = None;
    let (sampled, modal): (Vec<&Form<D>>, Vec<&Form<D>>) = fields
        .loads
        .iter()
        .map(|load| &load.form)
        .partition(|form| matches!(form, Form::Uniform { .. } | Form::Gaussian { .. }));
    if !sampled.is_empty() {
        for (component, samples) in solution.iter_mut().enumerate() {
            for (point, sample) in samples.iter_mut().enumerate() {
                let place = grid.position(grid.indices(point));
                let values = sampled.iter().filter_map(|form| form.value(place));
                *sample = values.map(|value| value[component]).sum();
            }
        }
        let lists = solution.each_mut().map(Vec::as_mut_slice);
        if is_truncated {
            solver.solve_in_place(lists)?;
        } else {
            lifted = Some(solver.solve_lifted_in_place(lists)?);
        }
    }
    if !modal.is_empty() {
        let highest = fields.highest();
        let force = series_of(fields, &modal, highest)?;
        let mut samples = zeros(grid.len());
        solver.sample_into(&force.solved(solver.operator()), samples.each_mut().map(Vec::as_mut_slice))?;
        for (total, own) in solution.iter_mut().zip(&samples) {
            for (total, own) in total.iter_mut().zip(own) {
                *total += own;
            }
        }
    }
    Ok((solution, lifted))
}

/// The sum of forms as modes.
pub(super) fn series_of<const D: usize>(
    fields: &BoxFields<D>,
    forms: &[&Form<D>],
    highest: [usize; D],
) -> Result<ModalSeries<D>, SpectralError> {
    let mut total = ModalSeries::zeros(fields.sides, fields.walls, highest)?;
    for form in forms {
        let own = form.series(fields.sides, fields.walls, highest)?;
        total = sum(fields.sides, fields.walls, highest, &[(1.0, &total), (1.0, &own)])?;
    }
    Ok(total)
}

impl<const D: usize> StaticField<D> {
    pub(super) fn of(task: &StaticTask<D>) -> Self {
        Self {
            grid: task.grid,
            displacement: core::array::from_fn(|_| Vec::new()),
            stress: core::array::from_fn(|_| core::array::from_fn(|_| Vec::new())),
            energy: None,
            resultant: None,
            wall_forces: None,
            lifted: None,
            probes: Vec::new(),
        }
    }

    /// Solves; false when the observer stopped it.
    pub(super) fn solve(
        &mut self,
        fields: &BoxFields<D>,
        task: &StaticTask<D>,
        observer: &mut Observer<'_>,
    ) -> Result<bool, SpectralError> {
        let mut solver = BoxSolver::new(task.grid, fields.walls, BoxOperator::elastic(fields.lame))?;
        if let Some(modes) = task.modes {
            solver = solver.with_truncation(modes);
        }
        self.resultant = Some(resultant(fields, &task.grid)?);
        if observer(0.1).is_break() {
            return Ok(false);
        }
        let (displacement, lifted) = solve_for_loads(fields, &mut solver, task.modes.is_some())?;
        (self.displacement, self.lifted) = (displacement, lifted);
        if observer(0.4).is_break() {
            return Ok(false);
        }
        let lists = self.displacement.each_ref().map(Vec::as_slice);
        let mut stress: [[Vec<f64>; D]; D] = core::array::from_fn(|_| zeros(task.grid.len()));
        solver.stress_into(fields.lame, lists, &mut stress)?;
        self.stress = stress;
        if observer(0.7).is_break() {
            return Ok(false);
        }
        let series = solver.series_of(lists)?;
        let energy = series.elastic_energy(fields.lame);
        finite("elastic energy", energy)?;
        self.energy = Some(energy);
        if fields.walls == Walls::Sliding {
            let mut forces = [[0.0; 2]; D];
            for (axis, forces) in forces.iter_mut().enumerate() {
                *forces = [series.wall_force(fields.lame, axis, false)?, series.wall_force(fields.lame, axis, true)?];
            }
            self.wall_forces = Some(forces);
        }
        for probe in &fields.probes {
            self.probes.push((probe.clone(), series.value(probe.at)?));
        }
        Ok(observer(1.0).is_continue())
    }
}

/// Refuses an energy beyond the range of numbers, which loads of any size can reach.
pub(super) fn finite(quantity: &'static str, value: f64) -> Result<(), SpectralError> {
    if value.is_finite() { Ok(()) } else { Err(SpectralError::NotFinite { quantity, index: 0, value }) }
}

/// The sum of all loads: samples times the volumes that belong to their points, forces at points, integrals of modes.
fn resultant<const D: usize>(fields: &BoxFields<D>, grid: &BoxGrid<D>) -> Result<[f64; D], SpectralError> {
    let mut total = [0.0; D];
    for load in &fields.loads {
        let own = match &load.form {
            Form::Point { total, .. } => *total,
            Form::Mode { indices, .. } => load.form.series(fields.sides, fields.walls, *indices)?.integral(),
            Form::Uniform { .. } | Form::Gaussian { .. } => integral(&load.form, grid),
        };
        for (total, own) in total.iter_mut().zip(own) {
            *total += own;
        }
    }
    Ok(total)
}

fn integral<const D: usize>(form: &Form<D>, grid: &BoxGrid<D>) -> [f64; D] {
    let mut total = [0.0; D];
    for point in 0..grid.len() {
        let indices = grid.indices(point);
        let volume: f64 = (0..D)
            .map(|axis| {
                let is_end = indices[axis] == 0 || indices[axis] + 1 == grid.points()[axis];
                let share = if is_end && grid.location() == PointLocation::Nodes { 0.5 } else { 1.0 };
                share * grid.spacings()[axis]
            })
            .product();
        if let Some(value) = form.value(grid.position(indices)) {
            for (total, own) in total.iter_mut().zip(value) {
                *total += volume * own;
            }
        }
    }
    total
}

impl<const D: usize> StaticField<D> {
    /// The largest displacement, m, and its place.
    #[must_use]
    pub fn largest_displacement(&self) -> Option<(f64, [f64; D])> {
        let sizes =
            (0..self.displacement[0].len()).map(|point| (super::map::size_at(&self.displacement, point), point));
        let (size, point) = sizes.max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some((size, self.grid.position(self.grid.indices(point))))
    }

    /// The largest size of a component of the stress, Pa.
    #[must_use]
    pub fn largest_stress(&self, row: usize, column: usize) -> Option<f64> {
        self.stress[row][column].iter().map(|stress| stress.abs()).reduce(f64::max)
    }

    /// The largest component of what loads and walls together leave over, over that of the loads: the error of the forces of the
    /// walls, which are sums of modes.
    #[must_use]
    pub fn unbalance(&self) -> Option<f64> {
        let (loads, walls) = (self.resultant?, self.wall_forces?);
        let size = loads.iter().fold(0.0, |size: f64, load| size.max(load.abs()));
        let left = (0..D).map(|axis| (loads[axis] + walls[axis][0] + walls[axis][1]).abs()).fold(0.0, f64::max);
        (0.0 < size).then(|| left / size)
    }
}
