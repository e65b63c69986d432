//! What can be wrong with a system or its state.

/// A condition that a system, its state or its motion violates.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DynamicsError {
    /// A slice of the wrong length.
    #[error("`{quantity}` has {found} components where {expected} are needed")]
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
    /// 0 ≤ Gm < ∞ violated.
    #[error("the gravitational parameter of body {body} is {value} m³/s²; it must satisfy 0 ≤ Gm < ∞")]
    InvalidGravitationalParameter {
        /// The body's index.
        body: usize,
        /// The value given.
        value: f64,
    },
    /// 0 ≤ ε < ∞ violated.
    #[error("the softening length is {value} m; it must satisfy 0 ≤ ε < ∞")]
    InvalidSoftening {
        /// The value given.
        value: f64,
    },
    /// Two bodies in one place, or so near that the cube of their distance is no number any more, where
    /// nothing softens what one does to the other.
    #[error(
        "bodies {first} and {second} are in one place, where their attraction is infinite; separate them or soften the attraction"
    )]
    CoincidentBodies {
        /// The first body's index.
        first: usize,
        /// The second body's index.
        second: usize,
    },
    /// An index beyond the last body.
    #[error("there is no body {body}: the system has {bodies}")]
    NoSuchBody {
        /// The index asked for.
        body: usize,
        /// The number of bodies.
        bodies: usize,
    },
    /// The attracting centre of the post-Newtonian term has no mass.
    #[error("body {body} has no mass, so that it cannot be the centre of a post-Newtonian term")]
    MasslessCentre {
        /// The body's index.
        body: usize,
    },
    /// 0 < c < ∞ violated.
    #[error("the speed of light is {value} m/s; it must satisfy 0 < c < ∞")]
    InvalidSpeedOfLight {
        /// The value given.
        value: f64,
    },
    /// A part whose position is infinite or NaN although coordinates and time are finite.
    #[error("part {part} is nowhere: its position is not finite at these coordinates")]
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
        "the inertia metric is singular: pivot {pivot:e} of coordinate {coordinate} is not positive against {diagonal:e}; \
         the motion along {direction:?} has no inertia (dependent coordinates, a missing mass, or a singular chart)"
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
    /// A mass that violates 0 ≤ m < ∞.
    #[error("part {part} has the mass {mass} kg; it must satisfy 0 ≤ m < ∞")]
    InvalidMass {
        /// The part's number in the order of placement.
        part: usize,
        /// Its mass.
        mass: f64,
    },
    /// The run in time failed.
    #[error("the run stopped at time {time} s: {source}")]
    Run {
        /// The time reached.
        time: f64,
        /// Why.
        source: Box<piola_integrators::IntegratorsError<DynamicsError>>,
    },
    /// A run whose steps are kept failed before its end.
    #[error("the run stopped at time {time} s after {} steps, which are kept: {source}", run.steps())]
    Unfinished {
        /// The time reached.
        time: f64,
        /// Why.
        source: Box<piola_integrators::IntegratorsError<DynamicsError>>,
        /// The motion up to there.
        run: Box<crate::Run>,
    },
    /// 0 < g_ΔΓ v^Δ v^Γ violated by the direction of a geodesic.
    #[error("the direction has the squared length {squared_length} in the inertia metric; it must be positive")]
    NoDirection {
        /// g_ΔΓ v^Δ v^Γ.
        squared_length: f64,
    },
    /// An integral over time that does not become accurate, however small the intervals.
    #[error("the integral still has the error {error:e} after {intervals} intervals: its integrand is not smooth")]
    QuadratureNotConverged {
        /// The intervals used.
        intervals: usize,
        /// The error left.
        error: f64,
    },
    /// Samples of a motion that are not in the order of time.
    #[error("the time {time} of sample {index} does not come after the {before} of the one before")]
    TimesNotIncreasing {
        /// The sample.
        index: usize,
        /// Its time.
        time: f64,
        /// The time before.
        before: f64,
    },
    /// Too few samples to say anything of the motion between them.
    #[error("{found} samples are given where at least {needed} are needed")]
    TooFewSamples {
        /// The number given.
        found: usize,
        /// The number needed.
        needed: usize,
    },
    /// Angles at a gimbal point, or other kinematic data that cannot be used.
    #[error(transparent)]
    Kinematics(#[from] piola_kinematics::KinematicsError),
    /// A linear system that cannot be solved.
    #[error(transparent)]
    Numerics(#[from] piola_numerics::NumericsError),
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
    /// Equations that Newton's iteration does not solve from its guess.
    #[error(
        "{condition} was not found by Newton's iteration: the residual {residual:e} is left, the last correction was \
         {correction:e} of the largest unknown; start nearer"
    )]
    NotSolved {
        /// What was sought.
        condition: &'static str,
        /// The largest residual left.
        residual: f64,
        /// The last correction over the largest unknown.
        correction: f64,
    },
    /// A map of phase space whose Jacobian is not symplectic.
    #[error(
        "the map is not canonical: entry ({row}, {column}) of JᵀΩJ − Ω is {residual:e}, {relative:e} of the terms it is \
         made of"
    )]
    NotCanonical {
        /// The entry.
        residual: f64,
        /// The entry over the magnitudes of its terms.
        relative: f64,
        /// Its row, in the order (q, p).
        row: usize,
        /// Its column.
        column: usize,
    },
    /// A field of vectors whose flow does not keep ω.
    #[error(
        "the field is not locally Hamiltonian: entry ({row}, {column}) of the Lie derivative of ω is {residual:e}, \
         {relative:e} of the terms it is made of"
    )]
    NotLocallyHamiltonian {
        /// The entry.
        residual: f64,
        /// The entry over the magnitudes of its terms.
        relative: f64,
        /// Its row, in the order (q, p).
        row: usize,
        /// Its column.
        column: usize,
    },
    /// A function that is given as an integral and is none.
    #[error("function {index} is no integral: its rate is {relative:e} of the terms it is made of")]
    NotAnIntegral {
        /// The function.
        index: usize,
        /// Its rate over the magnitudes of its terms.
        relative: f64,
    },
    /// A Hamiltonian that depends on time where one is needed that does not.
    #[error("the Hamiltonian changes with time, ∂H/∂t = {rate:e}: fronts of one energy need one that does not")]
    TimeDependentHamiltonian {
        /// ∂H/∂t, W.
        rate: f64,
    },
    /// An action that no motion has.
    #[error("the action {index} is {value}; it must lie between {least} and {greatest}")]
    InvalidAction {
        /// Its index.
        index: usize,
        /// The value given.
        value: f64,
        /// The least value possible.
        least: f64,
        /// The greatest.
        greatest: f64,
    },
    /// 0 < x violated.
    #[error("the {quantity} is {value}; it must be positive")]
    NotPositive {
        /// What it is.
        quantity: &'static str,
        /// The value given.
        value: f64,
    },
    /// A body that is not bound to its centre: its orbit is no ellipse.
    #[error("the energy is {energy} J; elements of an ellipse need a negative one")]
    NotBound {
        /// The energy.
        energy: f64,
    },
    /// Elements of an orbit where an angle has no meaning.
    #[error(
        "the eccentricity is {eccentricity:e} and the sine of the inclination {sine_of_inclination:e}: both must be \
         positive for the angles to have a meaning"
    )]
    DegenerateElements {
        /// e.
        eccentricity: f64,
        /// sin i.
        sine_of_inclination: f64,
    },
    /// The forces do not balance anywhere near the guess.
    #[error("no equilibrium was found in {iterations} steps: the forces left are {residual:e} of those that balance")]
    NoEquilibrium {
        /// Newton steps made.
        iterations: usize,
        /// The largest force left over the forces that balance.
        residual: f64,
    },
    /// A displacement that changes no force: the equilibrium is not isolated, or cannot be sought from here.
    #[error(
        "the stiffness is singular ({ratio:e} of the largest) along {direction:?}: no force answers that displacement"
    )]
    SingularStiffness {
        /// Smallest over largest singular value of the stiffness by units of mass.
        ratio: f64,
        /// The displacement, its largest component being one.
        direction: Vec<f64>,
    },
    /// The iteration for eigenvalues or singular values does not converge.
    #[error("the eigenvalues of a matrix of {rows} rows were not found")]
    NoEigenvalues {
        /// The rows of the matrix.
        rows: usize,
    },
    /// The vectors of a frame, or the quasi-velocities of a coframe, depend on each other.
    #[error(
        "the frame is singular: quasi-velocity {index} depends on the others (pivot {pivot:e} against {scale:e}); the \
         combination {combination:?} vanishes"
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
    #[error("there is no quasi-velocity {index}: the frame has {count}")]
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
    /// A constraint that depends on others, where that is [refused](crate::constraints::Redundancy::Refused).
    #[error("constraint {constraint}{} depends on others: its gradient is their combination {combination:?}", of(name.as_ref()))]
    RedundantConstraint {
        /// The constraint.
        constraint: usize,
        /// Its name, if it has one.
        name: Option<String>,
        /// The weights of the others in its gradient.
        combination: Vec<f64>,
    },
    /// A constraint that contradicts others: its gradient is a combination of theirs, its residual is not.
    #[error(
        "constraint {constraint}{} contradicts others: where it should be their combination {combination:?} it differs \
         by {residual:e}",
        of(name.as_ref())
    )]
    InconsistentConstraint {
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
    #[error("no state near the guess satisfies constraint {constraint}{}: {residual:e} is left of it", of(name.as_ref()))]
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
        "at time {time} s constraint {constraint}{} becomes dependent on others, or ceases to be: the position is singular",
        of(name.as_ref())
    )]
    SingularConstraint {
        /// The constraint.
        constraint: usize,
        /// Its name, if it has one.
        name: Option<String>,
        /// The time.
        time: f64,
    },
    /// A constraint that uses the time but does not say so: its rate would be wrong.
    #[error("constraint {constraint}{} depends on time: declare `const TIME_DEPENDENT: bool = true`", of(name.as_ref()))]
    UndeclaredTimeInConstraint {
        /// The constraint.
        constraint: usize,
        /// Its name, if it has one.
        name: Option<String>,
    },
    /// Two events that an extremal joins at a conjugate point: neighbouring extremals join them too.
    #[error(
        "the events are conjugate: ∂q₁/∂p₀ along the extremal has singular values of ratio {ratio:e}, so that its action \
         has no derivatives there"
    )]
    ConjugateEvents {
        /// Smallest over largest singular value of ∂q₁/∂p₀, each made free of units by the size of q and p.
        ratio: f64,
    },
    /// No extremal was found between two events.
    #[error(
        "none of {starts} extremals of the search region could be brought to the event: the nearest misses it by {miss:e}"
    )]
    NoExtremal {
        /// The least distance |q(t₁) − q₁| met.
        miss: f64,
        /// The number of initial momenta tried.
        starts: usize,
    },
    /// Two events at the same time: all extremals leave one place and none arrives at another.
    #[error("both events are at the time {time} s")]
    EventsAtOneTime {
        /// The time.
        time: f64,
    },
    /// Bounds of a search region that are not in order, or no numbers.
    #[error("the bounds {lower} and {upper} of momentum {index} must satisfy −∞ < lower ≤ upper < ∞")]
    InvalidRegion {
        /// The component.
        index: usize,
        /// The lower bound.
        lower: f64,
        /// The upper bound.
        upper: f64,
    },
    /// A Newton iteration that does not converge.
    #[error("{unknown} were not found in {iterations} iterations: {residual:e} is left of the equations")]
    NotFound {
        /// What was sought.
        unknown: &'static str,
        /// Iterations made.
        iterations: usize,
        /// The largest residual left.
        residual: f64,
    },
    /// A complete integral whose constants are not independent: det ∂²U/∂q∂Q = 0.
    #[error("the integral is not complete: ∂²U/∂q∂Q has singular values of ratio {ratio:e} there")]
    IncompleteIntegral {
        /// Smallest over largest singular value of ∂²U/∂q∂Q scaled to rows and columns of unit size.
        ratio: f64,
    },
    /// A function that does not solve the Hamilton–Jacobi equation where it is to give motions.
    #[error(
        "the function does not solve the Hamilton–Jacobi equation: it leaves {residual:e} J of terms of {scale:e} J"
    )]
    NoSolution {
        /// ∂U/∂t + H.
        residual: f64,
        /// |∂U/∂t| + |H|.
        scale: f64,
    },
    /// An initial manifold that the extremals touch: transversals do not leave it.
    #[error("the extremal touches the initial manifold: dU/dt along it is {rate:e} of terms of {scale:e}")]
    NotTransversal {
        /// U_q·H_p + U_t.
        rate: f64,
        /// |U_q||H_p| + |U_t|.
        scale: f64,
    },
    /// A point on a caustic, where transversals meet and their solution has no second derivatives.
    #[error("the transversals meet in a caustic: their map has {ratio:e} of the Jacobian that they started with")]
    OnCaustic {
        /// The Jacobian relative to that of the start.
        ratio: f64,
    },
    /// A coordinate where the motion with these constants does not reach.
    #[error("coordinate {coordinate} cannot be {value}: the square of its momentum would be {square:e}")]
    ForbiddenCoordinate {
        /// The coordinate.
        coordinate: usize,
        /// Its value.
        value: f64,
        /// The square of the separated momentum.
        square: f64,
    },
    /// The derivatives of a manifold along its parameters depend on each other.
    #[error(
        "the initial manifold is singular at {parameters:?}: its derivative along parameter {index} depends on those \
         before (a share of {share:e} is its own)"
    )]
    DependentParameters {
        /// τ.
        parameters: Vec<f64>,
        /// The parameter.
        index: usize,
        /// The share of the derivative that is not a combination of those before.
        share: f64,
    },
    /// No ξ near the guess satisfies u_τ = ξ·x_τ and Φ(x, u, ξ) = 0.
    #[error(
        "no ξ satisfies the data and the equation at {parameters:?} near the guess: at {covector:?} Φ is {residual:e} \
         and changes by {slope:e} along the normal of the manifold"
    )]
    NoInitialCovector {
        /// τ.
        parameters: Vec<f64>,
        /// The nearest ξ found.
        covector: Vec<f64>,
        /// Φ there.
        residual: f64,
        /// Its derivative along the normal.
        slope: f64,
    },
    /// A given ξ(τ) is not that of a strip, or does not satisfy the equation.
    #[error(
        "the ξ given at {parameters:?} violates condition {condition} of a strip (the last is Φ = 0) by {residual:e}"
    )]
    NotAStrip {
        /// τ.
        parameters: Vec<f64>,
        /// The parameter whose u_τ = ξ·x_τ is violated; their number where it is Φ = 0.
        condition: usize,
        /// u_τ − ξ·x_τ or Φ.
        residual: f64,
    },
    /// An equation that declares itself linear in ξ but is not: its characteristics would be wrong.
    #[error(
        "the equation is not linear in ξ at {parameters:?} (a second difference is {residual:e}): leave out \
         `const QUASILINEAR: bool = true`"
    )]
    NotQuasilinear {
        /// τ.
        parameters: Vec<f64>,
        /// Φ(2ξ) − 2Φ(ξ) + Φ(0).
        residual: f64,
    },
    /// A characteristic strip carries infinitely many solutions.
    #[error(
        "the initial strip is characteristic at {parameters:?} (sine {transversality:e} between the characteristic and \
         the manifold, residual {residual:e}): infinitely many solutions contain it"
    )]
    CharacteristicStrip {
        /// τ.
        parameters: Vec<f64>,
        /// The sine of the angle between Φ_ξ and the manifold.
        transversality: f64,
        /// The relative residual of the condition on ξ′.
        residual: f64,
    },
    /// A strip that is Monge but not characteristic lies on no solution.
    #[error(
        "the initial strip is a Monge strip but not a characteristic one at {parameters:?} (sine {transversality:e} \
         between the characteristic and the manifold, residual {residual:e}): no twice differentiable solution \
         contains it"
    )]
    MongeStrip {
        /// τ.
        parameters: Vec<f64>,
        /// The sine of the angle between Φ_ξ and the manifold.
        transversality: f64,
        /// The relative residual of the condition on ξ′.
        residual: f64,
    },
    /// A point of the manifold that no characteristic leaves, because ξ is not determined or Φ_ξ = 0.
    #[error(
        "the initial manifold determines no solution at {parameters:?}: {kind:?}, sine {transversality:e} between it \
         and the manifold"
    )]
    DegenerateStrip {
        /// τ.
        parameters: Vec<f64>,
        /// The sine of the angle between Φ_ξ and the manifold.
        transversality: f64,
        /// What the manifold is there.
        kind: crate::first_order_pde::StripKind,
    },
    /// from ≤ 0 ≤ to violated by the span of characteristics, or an end that is not finite.
    #[error("the characteristics are asked for from {from} to {to}; they start at 0, which must lie between")]
    InvalidSpan {
        /// The lower end.
        from: f64,
        /// The upper end.
        to: f64,
    },
    /// An interval without extent, or with ends that are not finite.
    #[error("the interval of `{quantity}` goes from {from} to {to}; it must satisfy −∞ < from < to < ∞")]
    InvalidInterval {
        /// What has that interval.
        quantity: &'static str,
        /// The lower end.
        from: f64,
        /// The upper end.
        to: f64,
    },
    /// A point that no characteristic of the solution reaches.
    #[error("no characteristic reaches {point:?}; the nearest, of parameters {parameters:?}, stays {distance:e} away")]
    OutsideOfCharacteristics {
        /// The point.
        point: Vec<f64>,
        /// τ of the nearest characteristic computed.
        parameters: Vec<f64>,
        /// Its distance.
        distance: f64,
    },
    /// Several characteristics reach a point: the solution has several sheets there.
    #[error("{} characteristics reach {point:?}, with u = {values:?}: ask for all sheets or for the first arrival", values.len())]
    SeveralSheets {
        /// The point.
        point: Vec<f64>,
        /// u on the sheets.
        values: Vec<f64>,
    },
    /// The one characteristic that reaches a point has passed caustics.
    #[error(
        "the characteristic that reaches {point:?} with u = {value} has passed {caustics} caustics: ask for all sheets"
    )]
    BeyondCaustic {
        /// The point.
        point: Vec<f64>,
        /// u on it.
        value: f64,
        /// The caustics passed.
        caustics: usize,
    },
    /// The initial manifold would need more characteristics than are allowed.
    #[error(
        "{rays} characteristics leave an error of interpolation of {error:e}: allow more of them, more parts of each, or a coarser resolution"
    )]
    TooManyCharacteristics {
        /// The characteristics made.
        rays: usize,
        /// The largest error of interpolation left.
        error: f64,
    },
    /// No generator of the Monge cone was found over a direction.
    #[error(
        "no generator of the Monge cone lies over {direction:?}: at ξ = {covector:?} the conditions are violated by {residual:e}"
    )]
    NoGenerator {
        /// x′.
        direction: Vec<f64>,
        /// The last ξ.
        covector: Vec<f64>,
        /// The largest relative residual of Φ_ξ = λ x′ and Φ = 0.
        residual: f64,
    },
}

/// A name as it stands behind an index.
fn of(name: Option<&String>) -> String {
    name.map(|name| format!(" ({name})")).unwrap_or_default()
}
