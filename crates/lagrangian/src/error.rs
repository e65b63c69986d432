//! What can be wrong with a system or its state.

/// A condition that a system, its state or its motion violates.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LagrangianError {
    /// A slice of the wrong length.
    #[error("`{quantity}` has length {found}; length {expected} is needed")]
    WrongLength {
        /// The name of the argument.
        quantity: &'static str,
        /// The length needed.
        expected: usize,
        /// The length found.
        found: usize,
    },
    /// An infinite or NaN component.
    #[error("component {index} of `{quantity}` is {value}; it must be finite")]
    NotFinite {
        /// The name of the argument.
        quantity: &'static str,
        /// The component.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A part whose position is infinite or NaN although coordinates and time are finite.
    #[error("the position of part {part} is not finite at these coordinates")]
    PartNowhere {
        /// The part's number in the order of placement.
        part: usize,
    },
    /// The attitude of a body is not a unit quaternion.
    #[error("the attitude of part {part} has the squared length {squared_length}; it must be 1: normalise it")]
    AttitudeNotUnit {
        /// The part's number in the order of placement.
        part: usize,
        /// w² + x² + y² + z².
        squared_length: f64,
    },
    /// The inertia metric of a system without parts, whose mechanics is all in its Lagrangian function.
    #[error(
        "the system has no parts and so no inertia metric: for a Lagrangian function, `equations_into` gives the mass \
         matrix ∂²L/∂q̇∂q̇ at a velocity"
    )]
    NoParts,
    /// A mass that violates 0 ≤ m < ∞.
    #[error("part {part} has the mass {mass} kg; it must satisfy 0 ≤ m < ∞")]
    InvalidMass {
        /// The part's number in the order of placement.
        part: usize,
        /// Its mass.
        mass: f64,
    },
    /// A placement that uses the time but does not say so: its velocities would be wrong.
    #[error("the placement of part {part} depends on time: declare `const TIME_DEPENDENT: bool = true`")]
    UndeclaredTimeDependence {
        /// The part's number in the order of placement.
        part: usize,
    },
    /// A potential that is not of first degree in the velocities but says so: its accelerations would be wrong.
    #[error("the potential is not linear in the velocities: leave out `const LINEAR_IN_VELOCITIES: bool = true`")]
    NonlinearPotential,
    /// The inertia metric, or the Hessian ∂²L/∂v∂v, is not positive definite.
    #[error(
        "the inertia metric is singular: pivot {pivot:e} of coordinate {coordinate} is not positive beside the \
         diagonal entry {diagonal:e}; the motion along {direction:?} has no inertia (dependent coordinates, a missing \
         mass, or a singular chart)"
    )]
    SingularMetric {
        /// The coordinate at which the elimination stopped.
        coordinate: usize,
        /// The pivot found there.
        pivot: f64,
        /// The diagonal entry it came from.
        diagonal: f64,
        /// A direction q̇ without kinetic energy, as far as rounding tells.
        direction: Vec<f64>,
    },
    /// The momenta could not be inverted for velocities.
    #[error(
        "no velocities were found for the momenta in {iterations} iterations (last correction {correction:e}): \
         they may lie outside the range of ∂L/∂q̇"
    )]
    LegendreNotConverged {
        /// Newton iterations made.
        iterations: usize,
        /// The largest component of the last correction, relative to the velocity.
        correction: f64,
    },
    /// 0 < g_ΔΓ v^Δ v^Γ violated by the direction of a geodesic.
    #[error("the direction has the squared length {squared_length} in the inertia metric; it must be positive")]
    NoDirection {
        /// g_ΔΓ v^Δ v^Γ.
        squared_length: f64,
    },
    /// An integral over time that does not become accurate, however small the intervals.
    #[error("the error of the integral is still {error:e} after {intervals} intervals: the integrand is not smooth")]
    QuadratureNotConverged {
        /// The intervals used.
        intervals: usize,
        /// The error left.
        error: f64,
    },
    /// Samples of a motion that are not in the order of time.
    #[error("the time {time} of sample {index} is not later than {before}, the time of the sample before it")]
    TimesNotIncreasing {
        /// The sample.
        index: usize,
        /// Its time.
        time: f64,
        /// The time before.
        before: f64,
    },
    /// Too few samples to say anything of the motion between them.
    #[error("too few samples: {found} given, at least {needed} needed")]
    TooFewSamples {
        /// The number given.
        found: usize,
        /// The number needed.
        needed: usize,
    },
    /// The run in time failed.
    #[error("the run stopped at time {time} s: {source}")]
    Run {
        /// The time reached.
        time: f64,
        /// Why.
        source: Box<piola_integrators::IntegratorsError<LagrangianError>>,
    },
    /// A run whose steps are kept failed before its end.
    #[error("the run stopped at time {time} s and keeps the steps made so far ({}): {source}", run.steps())]
    Unfinished {
        /// The time reached.
        time: f64,
        /// Why.
        source: Box<piola_integrators::IntegratorsError<LagrangianError>>,
        /// The motion up to there.
        run: Box<crate::Run>,
    },
    /// Constraints that cannot be satisfied, or not be told apart.
    #[error(transparent)]
    Constraint(#[from] ConstraintError),
    /// A frame of quasi-velocities that cannot be used.
    #[error(transparent)]
    Anholonomic(#[from] AnholonomicError),
    /// An equilibrium or its modes that cannot be found.
    #[error(transparent)]
    SmallMotions(#[from] SmallMotionsError),
    /// Angles at a gimbal point, or other kinematic data that cannot be used.
    #[error(transparent)]
    Kinematics(#[from] piola_kinematics::KinematicsError),
    /// A linear system that cannot be solved.
    #[error(transparent)]
    Numerics(#[from] piola_numerics::NumericsError),
}

/// A condition that constraints φ(q, t) = 0 violate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ConstraintError {
    /// A constraint that depends on others, where that is [refused](crate::constraints::Redundancy::Refused).
    #[error(
        "constraint {constraint}{} depends on others: its gradient is the combination of theirs with the weights \
         {combination:?}",
        of(name.as_ref())
    )]
    Redundant {
        /// The constraint.
        constraint: usize,
        /// Its name, if it has one.
        name: Option<String>,
        /// The weights of the others in its gradient.
        combination: Vec<f64>,
    },
    /// A constraint that contradicts others: its gradient is a combination of theirs, its residual is not.
    #[error(
        "constraint {constraint}{} contradicts others: it differs by {residual:e} from their combination with the \
         weights {combination:?}, which its gradient equals",
        of(name.as_ref())
    )]
    Inconsistent {
        /// The constraint.
        constraint: usize,
        /// Its name, if it has one.
        name: Option<String>,
        /// The residual (of the position, or its rate) less that of the combination.
        residual: f64,
        /// The weights of the others in its gradient.
        combination: Vec<f64>,
    },
    /// No state near the guess satisfies the constraints.
    #[error("no state near the guess satisfies constraint {constraint}{} (residual {residual:e})", of(name.as_ref()))]
    NotAssembled {
        /// The constraint that is farthest from being satisfied.
        constraint: usize,
        /// Its name, if it has one.
        name: Option<String>,
        /// Its residual, or the rate of it.
        residual: f64,
    },
    /// The number of independent constraints changes: the motion may branch there.
    #[error(
        "at time {time} s constraint {constraint}{} becomes dependent on others, or independent of them: the position \
         is singular",
        of(name.as_ref())
    )]
    Singular {
        /// The constraint.
        constraint: usize,
        /// Its name, if it has one.
        name: Option<String>,
        /// The time.
        time: f64,
    },
    /// A constraint that uses the time but does not say so: its rate would be wrong.
    #[error("constraint {constraint}{} depends on time: declare `const TIME_DEPENDENT: bool = true`", of(name.as_ref()))]
    UndeclaredTimeDependence {
        /// The constraint.
        constraint: usize,
        /// Its name, if it has one.
        name: Option<String>,
    },
}

/// A condition that quasi-velocities or rolling bodies violate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AnholonomicError {
    /// The vectors of a frame, or the quasi-velocities of a coframe, depend on each other.
    #[error(
        "the frame is singular: quasi-velocity {index} depends on the others (pivot {pivot:e} beside {scale:e}); the \
         combination with the weights {combination:?} vanishes"
    )]
    SingularFrame {
        /// The quasi-velocity at which the elimination stopped.
        index: usize,
        /// The pivot found there.
        pivot: f64,
        /// The magnitude it is compared with.
        scale: f64,
        /// Weights of the vectors, or of the quasi-velocities where these are given, whose sum vanishes.
        combination: Vec<f64>,
    },
    /// An index beyond the last quasi-velocity.
    #[error("there is no quasi-velocity {index}: the number of quasi-velocities is {count}")]
    NoSuchQuasiVelocity {
        /// The index asked for.
        index: usize,
        /// The number of quasi-velocities.
        count: usize,
    },
    /// One quasi-velocity held by two conditions.
    #[error("quasi-velocity {index} is held twice")]
    HeldTwice {
        /// The index given twice.
        index: usize,
    },
    /// A length that violates 0 < l < ∞.
    #[error("the {quantity} is {value} m; it must satisfy 0 < l < ∞")]
    InvalidLength {
        /// What has that length.
        quantity: &'static str,
        /// The value given.
        value: f64,
    },
}

/// Why an equilibrium or its modes were not found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SmallMotionsError {
    /// The forces do not balance anywhere near the guess.
    #[error(
        "no equilibrium was found (Newton steps: {iterations}): the residual force is {residual:e} of the forces that \
         balance"
    )]
    NoEquilibrium {
        /// Newton steps made.
        iterations: usize,
        /// The largest force left over the forces that balance.
        residual: f64,
    },
    /// A displacement that changes no force: the equilibrium is not isolated, or cannot be sought from here.
    #[error(
        "the stiffness is singular (ratio of singular values {ratio:e}): a displacement along {direction:?} changes no \
         force"
    )]
    SingularStiffness {
        /// Smallest over largest singular value of the stiffness by units of mass.
        ratio: f64,
        /// The displacement, its largest component being one.
        direction: Vec<f64>,
    },
    /// The iteration for eigenvalues or singular values does not converge.
    #[error("the iteration for the eigenvalues of a matrix did not converge (number of rows: {rows})")]
    NoEigenvalues {
        /// The rows of the matrix.
        rows: usize,
    },
}

/// A name as it stands behind an index.
fn of(name: Option<&String>) -> String {
    name.map(|name| format!(" ({name})")).unwrap_or_default()
}
