//! Equilibrium of a homogeneous test: damped Newton with the exact tangent, by steps of the load where it needs them.

use piola_continuum::tensor::rows::Rows;
use piola_continuum::{CauchyStress, Deformation, DisplacementGradient, FirstPiola};
use piola_numerics::linear::lu;

use super::{Control, Controls};
use crate::ConstitutiveError;
use crate::solids::Hyperelastic;

/// A homogeneous state in which everything prescribed holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HomogeneousState {
    /// The deformation.
    pub deformation: DisplacementGradient,
    /// P, Pa.
    pub first_piola: FirstPiola,
    /// T, Pa.
    pub cauchy: CauchyStress,
    /// The largest |stress − prescribed stress|, Pa.
    pub residual: f64,
    /// Evaluations of the tangent, of all steps of the load.
    pub iterations: usize,
    /// Steps of the load: 1 unless Newton's method failed to reach the load at once.
    pub steps: usize,
}

/// Corrections below this share of ∇u end the iteration: with quadratic convergence the next one is its square.
const ENOUGH: f64 = 1e-11;
/// Corrections of F below this are rounding.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Halvings of a correction before it is given up.
const HALVINGS: usize = 20;
/// Evaluations of the tangent in one step of the load.
const ITERATIONS: usize = 40;
/// The smallest step of the load.
const LEAST_STEP: f64 = 1.0 / 1_048_576.0;

/// The state in which all prescribed components hold.
///
/// ```text
/// r(F) = stress(F) − prescribed = 0 for the free components of F:   (∂r/∂F) δF = −r,   F ← F + α δF
/// ```
/// α is halved until 0 < det F, the law has an answer and |r| falls. If that fails the load is applied in steps, each
/// the interpolation between what `start` has and what is prescribed.
///
/// | argument | what |
/// |---|---|
/// | `controls` | what is prescribed |
/// | `start` | where to begin: the reference, or the last state of a path |
///
/// # Errors
/// [`ConstitutiveError::NotConverged`] with the best state; [`ConstitutiveError::Indeterminate`] when the tangent is
/// singular at the start, as when a rotation is left free; what the law says of `start`.
///
/// # Accuracy
/// The free components of ∇u within a relative 1e-12 × the condition number of the tangent, at small strain too if the law
/// keeps its digits there.
///
/// # Example
/// ```
/// use piola_constitutive::homogeneous::{Controls, equilibrium};
/// use piola_constitutive::solids::MooneyRivlin;
/// use piola_continuum::DisplacementGradient;
/// let rubber = MooneyRivlin::stress_free(0.5, 0.0, 1.0)?; // μ = 1, λ = 4 c = 4: Poisson's ratio 0.4
/// let bar = equilibrium(&rubber, &Controls::uniaxial(1.0 + 1e-9)?, &DisplacementGradient::zero())?;
/// let contraction = -bar.deformation.matrix()[(1, 1)] / bar.deformation.matrix()[(0, 0)];
/// assert!((contraction - 0.4).abs() < 1e-8);
/// # Ok::<(), piola_constitutive::ConstitutiveError>(())
/// ```
pub fn equilibrium(
    law: &impl Hyperelastic,
    controls: &Controls,
    start: &DisplacementGradient,
) -> Result<HomogeneousState, ConstitutiveError> {
    law.check(start)?;
    let target = controls.components().map(|row| row.map(Control::value));
    let begin = prescribed_at(law, controls, start);
    let at = |share: f64| -> Rows<f64> {
        core::array::from_fn(|i| core::array::from_fn(|j| begin[i][j] * (1.0 - share) + target[i][j] * share))
    };
    let (mut state, mut share, mut step) = (*start, 0.0_f64, 1.0_f64);
    let (mut iterations, mut steps) = (0, 0);
    loop {
        let whole = 1.0 <= share + step;
        let load = if whole { target } else { at(share + step) };
        match newton(law, controls, &load, &state) {
            Ok((reached, count)) => {
                iterations += count;
                steps += 1;
                state = reached;
                if whole {
                    break;
                }
                share += step;
                step *= 2.0;
            }
            Err(failure) => {
                iterations += failure.iterations;
                if failure.singular && steps == 0 && step <= 0.25 {
                    return Err(ConstitutiveError::Indeterminate { gradient: state.gradient_rows() });
                }
                step *= 0.5;
                if step < LEAST_STEP {
                    let (_, residual) = residual_of(law, controls, &target, &state);
                    let gradient = state.gradient_rows();
                    return Err(ConstitutiveError::NotConverged { residual, iterations, share, gradient });
                }
            }
        }
    }
    let (_, residual) = residual_of(law, controls, &target, &state);
    let first_piola = law.first_piola(&state);
    Ok(HomogeneousState {
        deformation: state,
        first_piola,
        cauchy: first_piola.cauchy(&state),
        residual,
        iterations,
        steps,
    })
}

/// A bar of stretch λ, its sides free: see [`equilibrium`].
///
/// # Errors
/// As [`equilibrium`].
///
/// # Example
/// ```
/// use piola_constitutive::{homogeneous, solids::MooneyRivlin};
/// let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
/// let bar = homogeneous::uniaxial(&rubber, 2.0)?;
/// assert!(bar.cauchy.0.components[1].abs() < 1e-14);
/// # Ok::<(), piola_constitutive::ConstitutiveError>(())
/// ```
pub fn uniaxial(law: &impl Hyperelastic, stretch: f64) -> Result<HomogeneousState, ConstitutiveError> {
    equilibrium(law, &Controls::uniaxial(stretch)?, &DisplacementGradient::zero())
}

/// A sheet of stretch λ along 1 and 2, its faces free: see [`equilibrium`].
///
/// # Errors
/// As [`equilibrium`].
pub fn equibiaxial(law: &impl Hyperelastic, stretch: f64) -> Result<HomogeneousState, ConstitutiveError> {
    equilibrium(law, &Controls::equibiaxial(stretch)?, &DisplacementGradient::zero())
}

/// A sheet of stretch λ along 1, held along 2, its faces free: see [`equilibrium`].
///
/// # Errors
/// As [`equilibrium`].
pub fn planar(law: &impl Hyperelastic, stretch: f64) -> Result<HomogeneousState, ConstitutiveError> {
    equilibrium(law, &Controls::planar(stretch)?, &DisplacementGradient::zero())
}

/// A block sheared by k = F₂₁, its third faces free where `free` says so: see [`equilibrium`].
///
/// # Errors
/// As [`equilibrium`].
pub fn simple_shear(law: &impl Hyperelastic, amount: f64, free: bool) -> Result<HomogeneousState, ConstitutiveError> {
    equilibrium(law, &Controls::simple_shear(amount, free)?, &DisplacementGradient::zero())
}

/// F = J^(⅓) 1: see [`equilibrium`].
///
/// # Errors
/// As [`equilibrium`].
///
/// # Example
/// ```
/// use piola_constitutive::{homogeneous, solids::MooneyRivlin};
/// let solid = MooneyRivlin::stress_free(0.5, 0.0, 1.0)?;
/// // T = [(J^(2/3) − 1)/J + 2 (J² − 1)/J] 1 at J = 8.
/// let stress = homogeneous::volumetric(&solid, 8.0)?.cauchy.0.components[0];
/// assert!((stress - (3.0 + 126.0) / 8.0).abs() < 1e-13);
/// # Ok::<(), piola_constitutive::ConstitutiveError>(())
/// ```
pub fn volumetric(law: &impl Hyperelastic, jacobian: f64) -> Result<HomogeneousState, ConstitutiveError> {
    equilibrium(law, &Controls::volumetric(jacobian)?, &DisplacementGradient::zero())
}

struct Failure {
    iterations: usize,
    singular: bool,
}

/// What a state has of the components that are prescribed.
fn prescribed_at(law: &impl Hyperelastic, controls: &Controls, state: &DisplacementGradient) -> Rows<f64> {
    let nominal = law.first_piola(state);
    let cauchy = nominal.cauchy(state).0.rows();
    let displacement = state.displacement_rows();
    core::array::from_fn(|i| {
        core::array::from_fn(|j| match controls.components()[i][j] {
            Control::Displacement(_) => displacement[i][j],
            Control::Nominal(_) => nominal.0[(i, j)],
            Control::Cauchy(_) => cauchy[i][j],
        })
    })
}

/// The residual and its largest modulus; displacements that are prescribed have none.
fn residual_of(
    law: &impl Hyperelastic,
    controls: &Controls,
    load: &Rows<f64>,
    state: &DisplacementGradient,
) -> (Rows<f64>, f64) {
    let present = prescribed_at(law, controls, state);
    let mut largest = 0.0_f64;
    let residual = core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            if matches!(controls.components()[i][j], Control::Displacement(_)) {
                return 0.0;
            }
            let difference = present[i][j] - load[i][j];
            // NaN counts as more than any number.
            largest = if difference.abs() <= largest { largest } else { difference.abs() };
            difference
        })
    });
    (residual, largest)
}

fn norm(rows: &Rows<f64>) -> f64 {
    rows.as_flattened().iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn largest_entry(rows: &Rows<f64>) -> f64 {
    rows.as_flattened().iter().fold(0.0, |largest: f64, x| largest.max(x.abs()))
}

/// A state of these rows, if it is one and the law has an answer there.
fn admitted(law: &impl Hyperelastic, rows: Rows<f64>) -> Option<DisplacementGradient> {
    let state = DisplacementGradient::from_rows(rows).ok()?;
    law.check(&state).ok()?;
    Some(state)
}

fn newton(
    law: &impl Hyperelastic,
    controls: &Controls,
    load: &Rows<f64>,
    start: &DisplacementGradient,
) -> Result<(DisplacementGradient, usize), Failure> {
    let mut rows = start.displacement_rows();
    let mut free = [(0, 0); 9];
    let mut n = 0;
    for (i, row) in controls.components().iter().enumerate() {
        for (j, control) in row.iter().enumerate() {
            if matches!(control, Control::Displacement(_)) {
                rows[i][j] = load[i][j];
            } else {
                free[n] = (i, j);
                n += 1;
            }
        }
    }
    let free = &free[..n];
    let failed = |iterations, singular| Failure { iterations, singular };
    let mut state = admitted(law, rows).ok_or(failed(0, false))?;
    let (mut residual, _) = residual_of(law, controls, load, &state);
    if !norm(&residual).is_finite() {
        return Err(failed(0, false));
    }
    if n == 0 {
        return Ok((state, 0));
    }
    for iteration in 1..=ITERATIONS {
        let correction = correction(law, controls, &state, &residual, free).ok_or(failed(iteration, true))?;
        let size = largest_entry(&correction);
        let scale = largest_entry(&state.displacement_rows());
        let last = size <= ENOUGH * scale || size <= ROUNDING * (1.0 + scale);
        let before = norm(&residual);
        let mut length = 1.0;
        let mut found = false;
        for _ in 0..HALVINGS {
            let mut rows = state.displacement_rows();
            for &(i, j) in free {
                rows[i][j] += length * correction[i][j];
            }
            if let Some(trial) = admitted(law, rows) {
                let (after, _) = residual_of(law, controls, load, &trial);
                if norm(&after) <= (1.0 - 1e-4 * length) * before {
                    (state, residual, found) = (trial, after, true);
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
            return Ok((state, iteration));
        }
        if !found {
            return Err(failed(iteration, false));
        }
        if norm(&residual) <= 0.0 {
            return Ok((state, iteration));
        }
    }
    Err(failed(ITERATIONS, false))
}

/// −(∂r/∂F)⁻¹ r, or none where the tangent is singular.
fn correction(
    law: &impl Hyperelastic,
    controls: &Controls,
    state: &DisplacementGradient,
    residual: &Rows<f64>,
    free: &[(usize, usize)],
) -> Option<Rows<f64>> {
    let n = free.len();
    let (stress, tangent) = law.first_piola_and_tangent(state);
    let cauchy = stress.cauchy(state).0.rows();
    let (f, inverse, jacobian) = (state.gradient_rows(), state.inverse_rows(), state.jacobian());
    let mut matrix = [0.0; 81];
    for (column, &(k, b)) in free.iter().enumerate() {
        for (row, &(i, j)) in free.iter().enumerate() {
            matrix[column * n + row] = match controls.components()[i][j] {
                Control::Cauchy(_) => {
                    // δ(P Fᵀ)/J − T tr(δF F⁻¹), symmetrised as T is.
                    let product = |i: usize, j: usize| {
                        let varied: f64 = (0..3).map(|c| tangent.entry(i, c, k, b) * f[j][c]).sum();
                        varied + if j == k { stress.0[(i, b)] } else { 0.0 }
                    };
                    0.5 * (product(i, j) + product(j, i)) / jacobian - cauchy[i][j] * inverse[b][k]
                }
                _ => tangent.entry(i, j, k, b),
            };
        }
    }
    let mut exchanges = [0; 9];
    let mut solution = [0.0; 9];
    for (entry, &(i, j)) in solution.iter_mut().zip(free) {
        *entry = -residual[i][j];
    }
    let matrix = &mut matrix[..n * n];
    lu::factor_in_place(matrix, &mut exchanges[..n]).ok()?;
    let pivots = (0..n).map(|k| matrix[k * n + k].abs());
    let (least, largest) = pivots.fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    if least <= 1e-14 * largest {
        return None;
    }
    lu::solve_in_place(matrix, &exchanges[..n], &mut solution[..n]).ok()?;
    let mut rows = [[0.0; 3]; 3];
    for (&(i, j), &entry) in free.iter().zip(&solution) {
        rows[i][j] = entry;
    }
    Some(rows)
}
