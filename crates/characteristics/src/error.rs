//! What can be wrong with an equation, its data or its solution.

/// A condition that an equation of first order, its data or its solution violates.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CharacteristicsError {
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
    /// from ≤ 0 ≤ to violated by the span of characteristics, or an end that is not finite.
    #[error("the characteristics start at 0, so their span from {from} to {to} must be finite and contain 0")]
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
    /// Too few samples to say anything of the motion between them.
    #[error("too few samples: {found} given, at least {needed} needed")]
    TooFewSamples {
        /// The number given.
        found: usize,
        /// The number needed.
        needed: usize,
    },
    /// ξ becomes infinite along a characteristic of an equation that is linear in ξ, but does not
    /// [declare](crate::FirstOrderPde::QUASILINEAR) it.
    #[error(
        "the characteristic stops at s = {s}, x = {x:?}, where ξ becomes infinite. The equation is linear in ξ: declare \
         `const QUASILINEAR: bool = true`, and its characteristics are followed without ξ"
    )]
    UndeclaredQuasilinear {
        /// s there.
        s: f64,
        /// x there.
        x: Vec<f64>,
    },
    /// A point that no characteristic of the solution reaches.
    #[error(
        "no characteristic reaches the point {point:?}; the nearest one, from the initial parameters {parameters:?}, \
         passes it at the distance {distance:e}"
    )]
    OutsideOfCharacteristics {
        /// The point.
        point: Vec<f64>,
        /// τ of the nearest characteristic computed.
        parameters: Vec<f64>,
        /// Its distance.
        distance: f64,
    },
    /// Several characteristics reach a point: the solution has several sheets there.
    #[error(
        "{} characteristics reach the point {point:?}, with u = {values:?}: ask for all sheets or for the first \
         arrival",
        values.len()
    )]
    SeveralSheets {
        /// The point.
        point: Vec<f64>,
        /// u on the sheets.
        values: Vec<f64>,
    },
    /// The one characteristic that reaches a point has passed caustics.
    #[error(
        "the characteristic that reaches the point {point:?} with u = {value} touches a caustic before (caustics \
         passed: {caustics}): ask for all sheets"
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
        "the error of interpolation is still {error:e} with {rays} characteristics: allow more characteristics, more \
         parts of each, or a coarser resolution"
    )]
    TooManyCharacteristics {
        /// The characteristics made.
        rays: usize,
        /// The largest error of interpolation left.
        error: f64,
    },
    /// The observer stopped the solution.
    #[error("the solution was stopped after {rays} characteristics were integrated")]
    Stopped {
        /// The characteristics integrated so far, those made again included.
        rays: usize,
    },
    /// No generator of the Monge cone was found over a direction.
    #[error(
        "no generator of the Monge cone was found over the direction {direction:?}: at ξ = {covector:?} its conditions \
         Φ_ξ = λ x′, Φ = 0 have the relative residual {residual:e}"
    )]
    NoGenerator {
        /// x′.
        direction: Vec<f64>,
        /// The last ξ.
        covector: Vec<f64>,
        /// The largest relative residual of Φ_ξ = λ x′ and Φ = 0.
        residual: f64,
    },
    /// The run in time failed.
    #[error("the run stopped at time {time} s: {source}")]
    Run {
        /// The time reached.
        time: f64,
        /// Why.
        source: Box<piola_integrators::IntegratorsError<CharacteristicsError>>,
    },
    /// Data on the initial manifold that give no solution, or not one.
    #[error(transparent)]
    Strip(#[from] StripError),
    /// A linear system that cannot be solved.
    #[error(transparent)]
    Numerics(#[from] piola_numerics::NumericsError),
}

/// A condition that the strip of data on the initial manifold violates.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StripError {
    /// The derivatives of a manifold along its parameters depend on each other.
    #[error(
        "the initial manifold is singular at {parameters:?}: its derivative along parameter {index} depends on the \
         derivatives along those before (independent part {share:e})"
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
        "no ξ near the guess satisfies the data and the equation at {parameters:?}: at ξ = {covector:?}, Φ is \
         {residual:e} and its derivative along the normal of the manifold is {slope:e}"
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
        "the ξ given at {parameters:?} violates strip condition {condition} by {residual:e} (u_τ = ξ·x_τ for each \
         parameter from 0, then Φ = 0)"
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
        "the equation is not linear in ξ at {parameters:?} (second difference {residual:e}): leave out `const \
         QUASILINEAR: bool = true`"
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
    Characteristic {
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
    Monge {
        /// τ.
        parameters: Vec<f64>,
        /// The sine of the angle between Φ_ξ and the manifold.
        transversality: f64,
        /// The relative residual of the condition on ξ′.
        residual: f64,
    },
    /// A point of the manifold that no characteristic leaves, because ξ is not determined or Φ_ξ = 0.
    #[error(
        "the initial manifold determines no solution at {parameters:?}: {} (sine {transversality:e} between the \
         characteristic and the manifold)",
        in_words(*kind)
    )]
    Degenerate {
        /// τ.
        parameters: Vec<f64>,
        /// The sine of the angle between Φ_ξ and the manifold.
        transversality: f64,
        /// What the manifold is there.
        kind: crate::StripKind,
    },
}

/// Why a point of the initial manifold determines no solution.
fn in_words(kind: crate::StripKind) -> &'static str {
    match kind {
        crate::StripKind::Transversal => "the manifold is transversal there",
        crate::StripKind::Characteristic => "the strip is characteristic there",
        crate::StripKind::Monge => "the strip is a Monge strip there, but not a characteristic one",
        crate::StripKind::Undetermined => "the data do not determine ξ",
        crate::StripKind::Stationary => "Φ_ξ = 0, so the characteristic stands still",
        crate::StripKind::NoCovector => "no ξ satisfies the data and the equation",
        crate::StripKind::Jump => "ξ jumps from one root of Φ to another",
    }
}
