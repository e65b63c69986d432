//! Newton's method of homogeneous tests: free components of F and the multipliers of constraints together.
//!
//! ```text
//! stress: P of the body + Σ λₖ ∂μₖ/∂F        r = stress − prescribed        μₖ(F) = 0
//! ⎡ ∂r/∂F    ∂r/∂λ ⎤ ⎡ δF ⎤     ⎡ r ⎤
//! ⎣ ∂μ/∂F      0   ⎦ ⎣ δλ ⎦ = − ⎣ μ ⎦        stresses and λ in units of the tangent of the start
//! ```

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{CauchyStress, Deformation, DisplacementGradient, FirstPiola};
use piola_numerics::linear::lu;
use piola_solids::Response;
use piola_solids::internal_constraints::Constraints;
use piola_tensor::internal::rows::Rows;

use super::{Control, Controls};

/// Corrections below this share of ∇u end the iteration: with quadratic convergence the next one is its square.
const ENOUGH: f64 = 1e-11;
/// Corrections of F below this are rounding.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Halvings of a correction before it is given up.
const HALVINGS: usize = 20;
/// Evaluations of the tangent in one step of the load.
const ITERATIONS: usize = 40;
/// The components of F and of a symmetric reaction: more unknowns are not independent.
const MOST: usize = 9 + 6;

/// A body and its prescribed components.
pub(super) struct Problem<'a, L, C> {
    pub(super) law: &'a L,
    pub(super) constraints: &'a C,
    pub(super) controls: &'a Controls,
    /// The unit of stresses, Pa.
    pub(super) unit: f64,
}

/// An iterate.
#[derive(Clone, Copy)]
pub(super) struct Point<const N: usize> {
    pub(super) state: DisplacementGradient,
    pub(super) multipliers: [f64; N],
}

/// A load, or a residual: a value for each component and for each μₖ.
#[derive(Clone, Copy)]
pub(super) struct Load<const N: usize> {
    pub(super) components: Rows<f64>,
    pub(super) values: [f64; N],
}

pub(super) struct Failure {
    pub(super) iterations: usize,
    pub(super) singular: bool,
}

pub(super) fn largest_entry(rows: &Rows<f64>) -> f64 {
    rows.as_flattened().iter().fold(0.0, |largest: f64, x| largest.max(x.abs()))
}

impl<L: Response, C> Problem<'_, L, C> {
    /// The unit of stresses: the largest entry of the tangent.
    pub(super) fn unit_at(law: &L, state: &DisplacementGradient) -> f64 {
        let tangent = law.stress_and_tangent(state).1.0.components;
        let largest = tangent.as_flattened().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        if 0.0 < largest && largest.is_finite() { largest } else { 1.0 }
    }

    /// P with the reactions.
    pub(super) fn stress<const N: usize>(&self, point: &Point<N>) -> FirstPiola
    where
        C: Constraints<N>,
    {
        let stress = self.law.stress(&point.state).0;
        FirstPiola(stress + self.reaction(point))
    }

    /// Σ λₖ ∂μₖ/∂F.
    fn reaction<const N: usize>(&self, point: &Point<N>) -> Matrix3<f64>
    where
        C: Constraints<N>,
    {
        let gradients = self.constraints.gradients(&point.state);
        gradients.iter().zip(point.multipliers).fold(Matrix3::zeros(), |sum, (gradient, x)| sum + gradient * x)
    }

    /// The current values of the prescribed components.
    pub(super) fn present<const N: usize>(&self, point: &Point<N>) -> Load<N>
    where
        C: Constraints<N>,
    {
        let first_piola = self.stress(point);
        let cauchy = first_piola.cauchy(&point.state).0.rows();
        let displacement = point.state.displacement_rows();
        let components = core::array::from_fn(|i| {
            core::array::from_fn(|j| match self.controls.components()[i][j] {
                Control::Displacement(_) => displacement[i][j],
                Control::FirstPiola(_) => first_piola.0[(i, j)],
                Control::Cauchy(_) => cauchy[i][j],
            })
        });
        Load { components, values: self.constraints.values(&point.state) }
    }

    /// The current values less the load, and the largest modulus of its stresses; zero for prescribed displacements.
    pub(super) fn residual<const N: usize>(&self, load: &Load<N>, point: &Point<N>) -> (Load<N>, f64)
    where
        C: Constraints<N>,
    {
        let present = self.present(point);
        let mut largest = 0.0_f64;
        let components = core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                if matches!(self.controls.components()[i][j], Control::Displacement(_)) {
                    return 0.0;
                }
                let difference = present.components[i][j] - load.components[i][j];
                // NaN counts as more than any number.
                largest = if difference.abs() <= largest { largest } else { difference.abs() };
                difference
            })
        });
        let values = core::array::from_fn(|k| present.values[k] - load.values[k]);
        (Load { components, values }, largest)
    }

    fn norm<const N: usize>(&self, residual: &Load<N>) -> f64 {
        let stresses = residual.components.as_flattened().iter().map(|x| (x / self.unit).powi(2)).sum::<f64>();
        (stresses + residual.values.iter().map(|x| x * x).sum::<f64>()).sqrt()
    }

    /// The state of these rows where the law admits it. During the iteration the volume of an incompressible body may
    /// change: the law is then asked about the isochoric part.
    fn admitted(&self, rows: Rows<f64>) -> Option<DisplacementGradient> {
        let state = DisplacementGradient::from_rows(rows).ok()?;
        if self.law.keeps_volume() {
            self.law.admits(&isochoric_part(&state)?).ok()?;
        } else {
            self.law.admits(&state).ok()?;
        }
        Some(state)
    }

    /// A point at which the load is carried, and how many tangents it took.
    pub(super) fn newton<const N: usize>(&self, load: &Load<N>, start: &Point<N>) -> Result<(Point<N>, usize), Failure>
    where
        C: Constraints<N>,
    {
        let mut rows = start.state.displacement_rows();
        let (places, n) = self.controls.free();
        for (i, row) in self.controls.components().iter().enumerate() {
            for (j, control) in row.iter().enumerate() {
                if matches!(control, Control::Displacement(_)) {
                    rows[i][j] = load.components[i][j];
                }
            }
        }
        let free = &places[..n];
        let failed = |iterations, singular| Failure { iterations, singular };
        let mut point = Point { state: self.admitted(rows).ok_or(failed(0, false))?, ..*start };
        let (mut residual, _) = self.residual(load, &point);
        if !self.norm(&residual).is_finite() {
            return Err(failed(0, false));
        }
        if n + N == 0 {
            return Ok((point, 0));
        }
        for iteration in 1..=ITERATIONS {
            let correction = self.correction(&point, &residual, free).ok_or(failed(iteration, true))?;
            let size = largest_entry(&correction.components);
            let scale = largest_entry(&point.state.displacement_rows());
            let last = size <= ENOUGH * scale || size <= ROUNDING * (1.0 + scale);
            let before = self.norm(&residual);
            let mut length = 1.0;
            let mut found = false;
            for _ in 0..HALVINGS {
                let mut rows = point.state.displacement_rows();
                for &(i, j) in free {
                    rows[i][j] += length * correction.components[i][j];
                }
                if let Some(state) = self.admitted(rows) {
                    let multipliers = core::array::from_fn(|k| point.multipliers[k] + length * correction.values[k]);
                    let trial = Point { state, multipliers };
                    let (after, _) = self.residual(load, &trial);
                    if self.norm(&after) <= (1.0 - 1e-4 * length) * before {
                        (point, residual, found) = (trial, after, true);
                        break;
                    }
                }
                if last {
                    // What remains is rounding.
                    break;
                }
                length *= 0.5;
            }
            if last {
                return Ok((point, iteration));
            }
            if !found {
                return Err(failed(iteration, false));
            }
            if self.norm(&residual) <= 0.0 {
                return Ok((point, iteration));
            }
        }
        Err(failed(ITERATIONS, false))
    }

    /// The corrections of F and of the multipliers, or none where the matrix is singular.
    fn correction<const N: usize>(
        &self,
        point: &Point<N>,
        residual: &Load<N>,
        free: &[(usize, usize)],
    ) -> Option<Load<N>>
    where
        C: Constraints<N>,
    {
        let (state, n) = (&point.state, free.len() + N);
        if MOST < n {
            return None;
        }
        let (stress, mut tangent) = self.law.stress_and_tangent(state);
        let stress = FirstPiola(stress.0 + self.reaction(point));
        if 0 < N {
            let bent = self.constraints.curvature(state, point.multipliers).components;
            for (entry, addend) in tangent.0.components.as_flattened_mut().iter_mut().zip(bent.as_flattened()) {
                *entry += addend;
            }
        }
        let gradients = self.constraints.gradients(state);
        let mut matrix = [0.0; MOST * MOST];
        for (column, &place) in free.iter().enumerate() {
            for (row, &entry) in free.iter().enumerate() {
                matrix[column * n + row] = self.slope(state, &stress, &tangent, entry, place) / self.unit;
            }
            for (row, gradient) in gradients.iter().enumerate() {
                matrix[column * n + free.len() + row] = gradient[place];
            }
        }
        for (column, gradient) in gradients.iter().enumerate() {
            let cauchy: CauchyStress = FirstPiola(*gradient).cauchy(state);
            for (row, &(i, j)) in free.iter().enumerate() {
                matrix[(free.len() + column) * n + row] = match self.controls.components()[i][j] {
                    Control::Cauchy(_) => cauchy.0.rows()[i][j],
                    _ => gradient[(i, j)],
                };
            }
        }
        let mut solution = [0.0; MOST];
        for (entry, &(i, j)) in solution.iter_mut().zip(free) {
            *entry = -residual.components[i][j] / self.unit;
        }
        for (entry, value) in solution[free.len()..].iter_mut().zip(residual.values) {
            *entry = -value;
        }
        let mut exchanges = [0; MOST];
        let matrix = &mut matrix[..n * n];
        lu::factor_in_place(matrix, &mut exchanges[..n]).ok()?;
        let pivots = (0..n).map(|k| matrix[k * n + k].abs());
        let (least, largest) = pivots.fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
        if least <= 1e-14 * largest {
            return None;
        }
        lu::solve_in_place(matrix, &exchanges[..n], &mut solution[..n]).ok()?;
        let mut components = [[0.0; 3]; 3];
        for (&(i, j), &entry) in free.iter().zip(&solution) {
            components[i][j] = entry;
        }
        let values = core::array::from_fn(|k| solution[free.len() + k] * self.unit);
        Some(Load { components, values })
    }

    /// ∂ stressᵢⱼ/∂Fₖᵦ of the kind that is prescribed.
    fn slope(
        &self,
        state: &DisplacementGradient,
        stress: &FirstPiola,
        tangent: &FirstPiolaTangent,
        (i, j): (usize, usize),
        (k, b): (usize, usize),
    ) -> f64 {
        if !matches!(self.controls.components()[i][j], Control::Cauchy(_)) {
            return tangent.entry(i, j, k, b);
        }
        // δ(P Fᵀ)/J − T tr(δF F⁻¹), symmetrised as T is.
        let f = state.gradient_rows();
        let product = |i: usize, j: usize| {
            let varied: f64 = (0..3).map(|c| tangent.entry(i, c, k, b) * f[j][c]).sum();
            varied + if j == k { stress.0[(i, b)] } else { 0.0 }
        };
        let cauchy = stress.cauchy(state).0.rows();
        0.5 * (product(i, j) + product(j, i)) / state.jacobian() - cauchy[i][j] * state.inverse_rows()[b][k]
    }
}

/// J^(−⅓) F.
fn isochoric_part(state: &DisplacementGradient) -> Option<DisplacementGradient> {
    // c − 1 without cancellation.
    let less = (-state.ln_jacobian() / 3.0).exp_m1();
    let h = state.displacement_rows();
    let rows =
        core::array::from_fn(|i| core::array::from_fn(|j| (1.0 + less) * h[i][j] + if i == j { less } else { 0.0 }));
    DisplacementGradient::from_rows(rows).ok()
}
