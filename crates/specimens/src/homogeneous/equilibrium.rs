//! Equilibrium of a homogeneous test: damped Newton with the exact tangent, by steps of the load where it needs them.

use piola_continuum::{CauchyStress, Deformation, DisplacementGradient, FirstPiola, Symmetric};
use piola_solids::internal::{outside_of_columns, rank_of_columns};
use piola_solids::internal_constraints::{Combination, Constraints, Incompressibility};
use piola_solids::{Response, SolidsError};

use super::newton::{Load, Point, Problem};
use super::{Control, Controls, check_stretches};
use crate::SpecimensError;

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
    /// The pressure with which an incompressible body keeps its volume, beyond the one that its law has, Pa; 0 if the
    /// body is compressible.
    pub pressure: f64,
}

/// A homogeneous state of a body with internal constraints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstrainedState<const N: usize> {
    /// The state; its stresses are those of the body, reactions included.
    pub state: HomogeneousState,
    /// λₖ, Pa.
    pub multipliers: [f64; N],
    /// Σ λₖ F (∂μₖ/∂F)ᵀ/J, the part of T that the constraints have, Pa.
    pub reaction: CauchyStress,
}

/// Values of constraints beyond this share of their slopes contradict what is prescribed.
const LARGEST_CONTRADICTION: f64 = 1e-9;
/// Slopes below this share of the largest are rounding.
const LEAST_SLOPE: f64 = 1e-10;

/// The smallest step of the load.
const LEAST_STEP: f64 = 1.0 / 1_048_576.0;

/// The state in which all prescribed components hold.
///
/// ```text
/// r(F) = stress(F) − prescribed = 0 for the free components of F:   (∂r/∂F) δF = −r,   F ← F + α δF
/// ```
/// α is halved until 0 < det F, the law has an answer and |r| falls. If that fails the load is applied in steps, each
/// the interpolation between what `start` has and what is prescribed. Of an incompressible law
/// ([`keeps_volume`](Response::keeps_volume)) the pressure is an unknown too, as in
/// [`constrained_equilibrium`] with [`Incompressibility`].
///
/// | argument | what |
/// |---|---|
/// | `controls` | what is prescribed |
/// | `start` | where to begin: the reference, or the last state of a path |
///
/// # Errors
/// [`SpecimensError::NotConverged`] with the best state; [`SpecimensError::Indeterminate`] when the tangent is
/// singular at the start, as when a rotation is left free; of an incompressible law [`SpecimensError::OutOfBounds`] when
/// the displacements that are prescribed change the volume (det F beyond 10⁻⁹ of 1) and no free component makes up for it,
/// [`SolidsError::UndeterminedMultiplier`] when they keep it and nothing that is prescribed sees the pressure; what the
/// law says of `start`.
///
/// # Accuracy
/// The free components of ∇u within a relative 1e-12 × the condition number of the tangent, at small strain too if the law
/// keeps its digits there.
///
/// # Example
/// ```
/// use piola_specimens::homogeneous::{Control, Controls, equilibrium};
/// use piola_solids::{IncompressibleSolid, MooneyRivlin, isochoric::NeoHookean};
/// use piola_continuum::DisplacementGradient;
/// let start = DisplacementGradient::zero();
/// let rubber = MooneyRivlin::stress_free(0.5, 0.0, 1.0)?; // μ = 1, λ = 4 c = 4: Poisson's ratio 0.4
/// let bar = equilibrium(&rubber, &Controls::uniaxial(1.0 + 1e-9)?, &start)?;
/// let contraction = -bar.deformation.matrix()[(1, 1)] / bar.deformation.matrix()[(0, 0)];
/// assert!((contraction - 0.4).abs() < 1e-8);
/// // An incompressible bar that a force pulls to λ = 2: P = μ (λ − λ⁻²).
/// let rubber = IncompressibleSolid::new(NeoHookean::new(1.0)?);
/// let pulled = Controls::axial([Control::FirstPiola(1.75), Control::FREE, Control::FREE])?;
/// let bar = equilibrium(&rubber, &pulled, &start)?;
/// assert!((bar.deformation.matrix()[(0, 0)] - 1.0).abs() < 1e-14);
/// assert!((bar.pressure + 0.5).abs() < 1e-14); // q = μ (λ⁻¹ − 1)
/// # Ok::<(), piola_specimens::SpecimensError>(())
/// ```
pub fn equilibrium(
    law: &impl Response,
    controls: &Controls,
    start: &DisplacementGradient,
) -> Result<HomogeneousState, SpecimensError> {
    if law.keeps_volume() {
        let found = constrained_equilibrium(law, &Incompressibility, controls, start).map_err(|error| match error {
            SpecimensError::ContradictedConstraint { value, .. } => {
                let (law, parameter, bound) = ("incompressible body", "det F", "det F = 1");
                SpecimensError::OutOfBounds { law, parameter, value: 1.0 + value, bound }
            }
            other => other,
        })?;
        let pressure = Incompressibility::pressure(found.multipliers[0], &found.state.deformation);
        return Ok(HomogeneousState { pressure, ..found.state });
    }
    Ok(constrained_equilibrium(law, &(), controls, start)?.state)
}

/// The state of a body with internal constraints in which all prescribed components hold, and the multipliers of the
/// constraints.
///
/// ```text
/// stress of P(F) + Σ λₖ ∂μₖ/∂F = prescribed,   μₖ(F) = 0
/// ```
/// The unknowns are the free components of F and all λₖ; the reactions follow from the faces whose tractions are
/// prescribed. A start that violates the constraints is brought back to them with the steps of the load. What the law says
/// of motions that the constraints forbid drops out with the multipliers.
///
/// # Errors
/// As [`equilibrium`]; [`SolidsError::RedundantConstraint`] and [`SolidsError::InconsistentConstraints`] at
/// the start; [`SpecimensError::ContradictedConstraint`] when the displacements that are prescribed violate a constraint
/// by more than 10⁻⁹ of its slopes and no free component changes it there, for an incompressible law's own constraint too;
/// [`SolidsError::UndeterminedMultiplier`] when they keep it and nothing that is prescribed sees its reaction.
///
/// # Example
/// A bar with a cord along it, its sides free: it is stretched by no force, which the cord takes whole.
/// ```
/// use piola_specimens::homogeneous::{Control, Controls, constrained_equilibrium};
/// use piola_solids::internal_constraints::Inextensibility;
/// use piola_solids::{Fibre, MooneyRivlin};
/// use piola_continuum::DisplacementGradient;
/// let rubber = MooneyRivlin::stress_free(0.5, 0.0, 1.0)?; // μ = 1, λ = 4
/// let cord = Inextensibility::along(Fibre::new([1.0, 0.0, 0.0])?);
/// let pulled = Controls::axial([Control::FirstPiola(3.0), Control::FREE, Control::FREE])?;
/// let bar = constrained_equilibrium(&rubber, &cord, &pulled, &DisplacementGradient::zero())?;
/// assert!(bar.state.deformation.matrix().norm() < 1e-14);
/// assert!((Inextensibility::tension(bar.multipliers[0]) - 3.0).abs() < 1e-14);
/// # Ok::<(), piola_specimens::SpecimensError>(())
/// ```
///
/// # Source
/// W(21.18), W(21.20), W(21.22).
pub fn constrained_equilibrium<const N: usize>(
    law: &impl Response,
    constraints: &impl Constraints<N>,
    controls: &Controls,
    start: &DisplacementGradient,
) -> Result<ConstrainedState<N>, SpecimensError> {
    law.admits(start)?;
    if 0 < N {
        Combination::new(constraints.restrictions(start)?)?;
    }
    let problem = Problem { law, constraints, controls, unit: Problem::<_, ()>::unit_at(law, start) };
    let target = Load { components: controls.components().map(|row| row.map(Control::value)), values: [0.0; N] };
    let mut point = Point { state: *start, multipliers: [0.0; N] };
    let begin = problem.present(&point);
    let between = |share: f64, from: f64, to: f64| from * (1.0 - share) + to * share;
    let at = |share: f64| Load {
        components: core::array::from_fn(|i| {
            core::array::from_fn(|j| between(share, begin.components[i][j], target.components[i][j]))
        }),
        values: begin.values.map(|value| between(share, value, 0.0)),
    };
    let (mut share, mut step) = (0.0_f64, 1.0_f64);
    let (mut iterations, mut steps) = (0, 0);
    loop {
        let whole = 1.0 <= share + step;
        let load = if whole { target } else { at(share + step) };
        match problem.newton(&load, &point) {
            Ok((reached, count)) => {
                iterations += count;
                steps += 1;
                point = reached;
                if whole {
                    break;
                }
                share += step;
                step *= 2.0;
            }
            Err(failure) => {
                iterations += failure.iterations;
                if failure.singular && steps == 0 && step <= 0.25 {
                    return Err(undetermined(constraints, controls, &point.state));
                }
                step *= 0.5;
                if step < LEAST_STEP {
                    let (_, residual) = problem.residual(&target, &point);
                    let gradient = point.state.gradient_rows();
                    return Err(SpecimensError::NotConverged { residual, iterations, share, gradient });
                }
            }
        }
    }
    let Point { state, multipliers } = point;
    law.admits(&state)?;
    let (_, residual) = problem.residual(&target, &point);
    let first_piola = problem.stress(&point);
    let mut reaction = Symmetric::zero();
    for (gradient, multiplier) in constraints.gradients(&state).into_iter().zip(multipliers) {
        reaction += FirstPiola(gradient).cauchy(&state).0 * multiplier;
    }
    Ok(ConstrainedState {
        state: HomogeneousState {
            deformation: state,
            first_piola,
            cauchy: first_piola.cauchy(&state),
            residual,
            iterations,
            steps,
            pressure: 0.0,
        },
        multipliers,
        reaction: CauchyStress(reaction),
    })
}

/// The gradients of constraints in the free components: a column for each constraint.
fn free_slopes<const N: usize>(
    constraints: &impl Constraints<N>,
    controls: &Controls,
    state: &DisplacementGradient,
) -> [[f64; 9]; N] {
    let (places, n) = controls.free();
    constraints.gradients(state).map(|gradient| {
        let mut column = [0.0; 9];
        for (entry, &place) in column.iter_mut().zip(&places[..n]) {
            *entry = gradient[place];
        }
        column
    })
}

/// The constraint that what is prescribed violates, whatever the free components do nearby.
///
/// ```text
/// μ + (∂μ/∂F) δF = 0 for no δF of the free components:   what of μ is no sum of the columns of ∂μ/∂F
/// ```
fn contradiction<const N: usize>(
    constraints: &impl Constraints<N>,
    controls: &Controls,
    state: &DisplacementGradient,
) -> Option<SpecimensError> {
    let mut rows = state.displacement_rows();
    for (row, prescribed) in rows.iter_mut().zip(controls.components()) {
        for (entry, control) in row.iter_mut().zip(prescribed) {
            if let Control::Displacement(value) = *control {
                *entry = value;
            }
        }
    }
    let target = DisplacementGradient::from_rows(rows).ok()?;
    let values = constraints.values(&target);
    let gradients = constraints.gradients(&target);
    let slope = gradients.iter().flat_map(|gradient| gradient.iter()).fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let slopes = free_slopes(constraints, controls, &target);
    let told = |x: f64| if LEAST_SLOPE * slope < x.abs() { x } else { 0.0 };
    let columns: [[f64; N]; 9] = core::array::from_fn(|place| core::array::from_fn(|k| told(slopes[k][place])));
    let rest = outside_of_columns(&columns, values);
    let scale = values.iter().fold(slope, |largest, x| largest.max(x.abs()));
    let (index, &value) = rest.iter().enumerate().max_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()))?;
    let gradient = target.gradient_rows();
    let contradicts = LARGEST_CONTRADICTION * scale < value.abs();
    contradicts.then_some(SpecimensError::ContradictedConstraint { index, value, gradient })
}

/// Why the matrix is singular: a constraint that what is prescribed contradicts, a multiplier that the free components do not
/// see, or a motion that is left free.
fn undetermined<const N: usize>(
    constraints: &impl Constraints<N>,
    controls: &Controls,
    state: &DisplacementGradient,
) -> SpecimensError {
    match rank_of_columns(&free_slopes(constraints, controls, state)) {
        (rank, Some(index)) => contradiction(constraints, controls, state)
            .unwrap_or(SolidsError::UndeterminedMultiplier { index, rank, count: N }.into()),
        _ => SpecimensError::Indeterminate { gradient: state.gradient_rows() },
    }
}

/// A bar of stretch λ, its sides free: see [`equilibrium`].
///
/// # Errors
/// As [`equilibrium`]; [`SpecimensError::OutOfBounds`] unless 0 < λ.
pub fn uniaxial(law: &impl Response, stretch: f64) -> Result<HomogeneousState, SpecimensError> {
    check_stretches(&[stretch])?;
    equilibrium(law, &Controls::uniaxial(stretch)?, &DisplacementGradient::zero())
}

/// A sheet of stretch λ along 1 and 2, its faces free: see [`equilibrium`].
///
/// # Errors
/// As [`equilibrium`]; [`SpecimensError::OutOfBounds`] unless 0 < λ.
pub fn equibiaxial(law: &impl Response, stretch: f64) -> Result<HomogeneousState, SpecimensError> {
    check_stretches(&[stretch])?;
    equilibrium(law, &Controls::equibiaxial(stretch)?, &DisplacementGradient::zero())
}

/// A sheet of stretch λ along 1, held along 2, its faces free: see [`equilibrium`].
///
/// # Errors
/// As [`equilibrium`]; [`SpecimensError::OutOfBounds`] unless 0 < λ.
pub fn planar(law: &impl Response, stretch: f64) -> Result<HomogeneousState, SpecimensError> {
    check_stretches(&[stretch])?;
    equilibrium(law, &Controls::planar(stretch)?, &DisplacementGradient::zero())
}

/// A block sheared by k = F₂₁, its third faces free where `free` says so: see [`equilibrium`].
///
/// # Errors
/// As [`equilibrium`].
pub fn simple_shear(law: &impl Response, amount: f64, free: bool) -> Result<HomogeneousState, SpecimensError> {
    equilibrium(law, &Controls::simple_shear(amount, free)?, &DisplacementGradient::zero())
}

/// F = J^(⅓) 1: see [`equilibrium`].
///
/// # Errors
/// As [`equilibrium`]; [`SpecimensError::OutOfBounds`] unless 0 < J.
pub fn volumetric(law: &impl Response, jacobian: f64) -> Result<HomogeneousState, SpecimensError> {
    equilibrium(law, &Controls::volumetric(jacobian)?, &DisplacementGradient::zero())
}
