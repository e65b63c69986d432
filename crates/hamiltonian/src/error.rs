//! What can be wrong on phase space.

/// A condition that a function, a map or a motion on phase space violates.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HamiltonianError {
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
    /// 0 < x violated.
    #[error("the {quantity} is {value}; it must be positive")]
    NotPositive {
        /// The name of the quantity.
        quantity: &'static str,
        /// The value given.
        value: f64,
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
    /// Equations that Newton's iteration does not solve from its guess.
    #[error(
        "Newton's iteration did not converge for {condition}: residual {residual:e}, last correction {correction:e} of \
         the largest unknown; start nearer"
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
        "the map is not canonical: entry ({row}, {column}) of JᵀΩJ − Ω is {residual:e}, or {relative:e} relative to \
         its terms"
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
        "the field is not locally Hamiltonian: entry ({row}, {column}) of the Lie derivative of ω is {residual:e}, or \
         {relative:e} relative to its terms"
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
    #[error("function {index} is not an integral of the motion: its rate is {relative:e} relative to its terms")]
    NotAnIntegral {
        /// The function.
        index: usize,
        /// Its rate over the magnitudes of its terms.
        relative: f64,
    },
    /// An action that no motion has.
    #[error("action {index} is {value}; it must lie between {least} and {greatest}")]
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
    /// A body that is not bound to its centre: its orbit is no ellipse.
    #[error("the energy is {energy} J; the elements of an ellipse need a negative energy")]
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
    /// The iteration for eigenvalues or singular values does not converge.
    #[error("the iteration for the eigenvalues of a matrix did not converge (number of rows: {rows})")]
    NoEigenvalues {
        /// The rows of the matrix.
        rows: usize,
    },
    /// The run in time failed.
    #[error("the run stopped at time {time} s: {source}")]
    Run {
        /// The time reached.
        time: f64,
        /// Why.
        source: Box<piola_integrators::IntegratorsError<HamiltonianError>>,
    },
    /// A condition of Hamilton–Jacobi theory.
    #[error(transparent)]
    HamiltonJacobi(#[from] HamiltonJacobiError),
    /// A Lagrangian that cannot be used, or an integral that does not become accurate.
    #[error(transparent)]
    Lagrangian(#[from] piola_lagrangian::LagrangianError),
    /// A linear system that cannot be solved.
    #[error(transparent)]
    Numerics(#[from] piola_numerics::NumericsError),
}

/// A condition that extremals, solutions of the Hamilton–Jacobi equation or wave fronts violate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HamiltonJacobiError {
    /// A Hamiltonian that depends on time where one is needed that does not.
    #[error(
        "the Hamiltonian depends on time (∂H/∂t = {rate:e} W): wave fronts at one energy need a Hamiltonian that does \
         not"
    )]
    TimeDependentHamiltonian {
        /// ∂H/∂t, W.
        rate: f64,
    },
    /// A length that violates 0 < l < ∞.
    #[error("the {quantity} is {value} m; it must satisfy 0 < l < ∞")]
    InvalidLength {
        /// What has that length.
        quantity: &'static str,
        /// The value given.
        value: f64,
    },
    /// Two events that an extremal joins at a conjugate point: neighbouring extremals join them too.
    #[error(
        "the events are conjugate: the singular values of ∂q₁/∂p₀ along the extremal have the ratio {ratio:e}, so its \
         action has no derivatives there"
    )]
    ConjugateEvents {
        /// Smallest over largest singular value of ∂q₁/∂p₀, each made free of units by the size of q and p.
        ratio: f64,
    },
    /// No extremal was found between two events.
    #[error(
        "none of the {starts} extremals tried from the search region reaches the event: the nearest misses it by \
         {miss:e}"
    )]
    NoExtremal {
        /// The least distance |q(t₁) − q₁| met.
        miss: f64,
        /// The number of initial momenta tried.
        starts: usize,
    },
    /// Two events at the same time: all extremals leave one place and none arrives at another.
    #[error("both events are at the time {time} s; their times must differ")]
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
    #[error("{unknown} were not found (iterations: {iterations}, residual of the equations: {residual:e})")]
    NotFound {
        /// What was sought.
        unknown: &'static str,
        /// Iterations made.
        iterations: usize,
        /// The largest residual left.
        residual: f64,
    },
    /// A complete integral whose constants are not independent: det ∂²U/∂q∂Q = 0.
    #[error("the integral is not complete: the singular values of ∂²U/∂q∂Q have the ratio {ratio:e} there")]
    IncompleteIntegral {
        /// Smallest over largest singular value of ∂²U/∂q∂Q scaled to rows and columns of unit size.
        ratio: f64,
    },
    /// A function that does not solve the Hamilton–Jacobi equation where it is to give motions.
    #[error(
        "the function does not solve the Hamilton–Jacobi equation: the residual is {residual:e} J, the terms are of \
         size {scale:e} J"
    )]
    NoSolution {
        /// ∂U/∂t + H.
        residual: f64,
        /// |∂U/∂t| + |H|.
        scale: f64,
    },
    /// An initial manifold that the extremals touch: transversals do not leave it.
    #[error("the extremal touches the initial manifold: dU/dt along it is {rate:e}, with terms of size {scale:e}")]
    NotTransversal {
        /// U_q·H_p + U_t.
        rate: f64,
        /// |U_q||H_p| + |U_t|.
        scale: f64,
    },
    /// A point on a caustic, where transversals meet and their solution has no second derivatives.
    #[error("the transversals meet in a caustic: the Jacobian of their map is {ratio:e} of its initial value")]
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
}
