//! What can be wrong with a law or with what is asked of it: each variant names the violated condition.

use piola_continuum::ContinuumError;

/// A violated condition of a constitutive law.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ConstitutiveError {
    /// A parameter is infinite or NaN.
    #[error("{law}: {parameter} = {value} is not finite")]
    NotFinite {
        /// The law.
        law: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
    /// A parameter is outside its bounds.
    #[error("{law}: {parameter} = {value:e} violates {bound}")]
    OutOfBounds {
        /// The law.
        law: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// What would be valid, such as `0 < μ`.
        bound: &'static str,
    },
    /// The deformation is beyond what the law can answer.
    #[error("{law}: {quantity} = {value:e} is not below its limit {limit:e}")]
    BeyondLimit {
        /// The law.
        law: &'static str,
        /// What is limited.
        quantity: &'static str,
        /// What it is.
        value: f64,
        /// What it must be below.
        limit: f64,
    },
    /// The law has no limit here, but its answer is beyond the range of the scalar.
    #[error("the answer `{answer}` is beyond the range of the scalar; valid are deformations at which it is finite")]
    Overflow {
        /// What was asked for.
        answer: &'static str,
    },
    /// No state was found in which everything prescribed holds.
    #[error(
        "equilibrium not reached after {iterations} iterations: at {share} of the load, F = {gradient:?}, \
         a stress is off by {residual:e} Pa from the whole load"
    )]
    NotConverged {
        /// The largest difference from the prescribed stresses in the best state, Pa.
        residual: f64,
        /// Evaluations of the tangent.
        iterations: usize,
        /// The share of the load that the best state carries.
        share: f64,
        /// F of the best state, by rows.
        gradient: [[f64; 3]; 3],
    },
    /// The tangent of the free components is singular: a rotation or another mode is left free.
    #[error("what is prescribed does not determine the deformation near F = {gradient:?}: the tangent is singular")]
    Indeterminate {
        /// F where it was found, by rows.
        gradient: [[f64; 3]; 3],
    },
    /// Both Tᵢⱼ and Tⱼᵢ are prescribed.
    #[error("T is symmetric: of the components ({row}, {column}) and ({column}, {row}) only one can be prescribed")]
    PrescribedTwice {
        /// i, from 0.
        row: usize,
        /// j, from 0.
        column: usize,
    },
    /// A face that a test leaves free carries a traction.
    #[error(
        "T{component:?} = {stress:e} Pa is a traction on a free face: the axes of the law are not those of the test"
    )]
    TractionOnFreeFace {
        /// The component of T, from 0.
        component: [usize; 2],
        /// Its value, Pa.
        stress: f64,
    },
    /// There is no test to fit to.
    #[error("there is no test to fit to")]
    NoTests,
    /// A test has no points.
    #[error("test `{test}` has no points")]
    EmptyTest {
        /// The test.
        test: String,
    },
    /// Two tests have the same name.
    #[error("there are two tests `{test}`")]
    TestTwice {
        /// Their name.
        test: String,
    },
    /// A stretch of a test is not positive and finite (an amount of shear: not finite).
    #[error("test `{test}`, point {index}: the stretch {value} is not positive and finite")]
    Stretch {
        /// The test.
        test: String,
        /// The point, from 0.
        index: usize,
        /// The stretch.
        value: f64,
    },
    /// A stretch of a test, or an amount of shear, is so small or large that no law has a stress there.
    #[error("test `{test}`, point {index}: at the stretch {value:e} no law has a stress: valid are 1e-30 to 1e30")]
    StretchOutOfRange {
        /// The test.
        test: String,
        /// The point, from 0.
        index: usize,
        /// The stretch.
        value: f64,
    },
    /// A stress of a test is not finite.
    #[error("test `{test}`, point {index}: the stress {value} is not finite")]
    Stress {
        /// The test.
        test: String,
        /// The point, from 0.
        index: usize,
        /// The stress.
        value: f64,
    },
    /// A deformation of a test changes the volume of a material that is incompressible.
    #[error("test `{test}`, point {index}: det F = {determinant} of an incompressible material is not 1")]
    NotIsochoric {
        /// The test.
        test: String,
        /// The point, from 0.
        index: usize,
        /// det F.
        determinant: f64,
    },
    /// An index of a component or axis is not 0, 1 or 2.
    #[error("test `{test}`, point {index}: {value} is none of the axes 0, 1 and 2")]
    NoSuchComponent {
        /// The test.
        test: String,
        /// The point, from 0.
        index: usize,
        /// The index.
        value: usize,
    },
    /// The weight of a test is not positive and finite.
    #[error("test `{test}`: the weight {value} is not positive and finite")]
    Weight {
        /// The test.
        test: String,
        /// The weight.
        value: f64,
    },
    /// A model to fit has a name that is not known.
    #[error(
        "no model is called `{name}`: there are neo-hookean, mooney-rivlin, yeoh, gent, arruda-boyce, polynomial:n, ogden:n"
    )]
    UnknownModel {
        /// The name.
        name: String,
    },
    /// A series has no terms, or too many.
    #[error("a series of {value} terms: valid are 1 to 6")]
    SeriesLength {
        /// The number of terms.
        value: usize,
    },
    /// Nothing is deformed in any test, where every law has the same stress.
    #[error(
        "test `{test}`: all its stretches are {value}, at which nothing is deformed, and no other test has one that is not: \
         the data say nothing of the parameters"
    )]
    NothingDeformed {
        /// The first test.
        test: String,
        /// Its first stretch: 1, or 0 for an amount of shear.
        value: f64,
    },
    /// A model has more parameters than there are points.
    #[error("{model}: {points} measured points cannot determine {parameters} parameters")]
    TooFewPoints {
        /// The model.
        model: String,
        /// Points of all tests.
        points: usize,
        /// Parameters of the model.
        parameters: usize,
    },
    /// Bounds are given for a parameter that a model does not have.
    #[error("{model} has no parameter `{parameter}`")]
    UnknownParameter {
        /// The model.
        model: String,
        /// The parameter.
        parameter: String,
    },
    /// A parameter of a model is to have the sign of one that it cannot.
    #[error(
        "{model}: `{parameter}` is to have the sign of parameter {index}, which the model does not have or is a factor"
    )]
    NoSuchSign {
        /// The model.
        model: String,
        /// The parameter.
        parameter: String,
        /// The number of the other, from 0.
        index: usize,
    },
    /// A model is given more or fewer values than it has parameters.
    #[error("{model} has {parameters} parameters: {values} values are given")]
    NumberOfValues {
        /// The model.
        model: String,
        /// Its parameters.
        parameters: usize,
        /// The values.
        values: usize,
    },
    /// No value is within the bounds of a parameter.
    #[error("{model}: no value of `{parameter}` is at least {lower:e} and at most {upper:e}")]
    ImpossibleBounds {
        /// The model.
        model: String,
        /// The parameter.
        parameter: String,
        /// The least value, that of the model included.
        lower: f64,
        /// The greatest value, that of the model included.
        upper: f64,
    },
    /// A probability of intervals is not between 0 and 1.
    #[error("the confidence {value} is not between 0 and 1")]
    Confidence {
        /// The confidence.
        value: f64,
    },
    /// A model has finite stresses at no start of the search.
    #[error("{model}: the stresses are finite, and the bounds kept, at no start of the search")]
    NoStart {
        /// The model.
        model: String,
    },
    /// A constraint is not the same for all observers: its reaction is not symmetric.
    #[error("the reaction of the constraint has a skew part {skew:e} beside {size:e}: it depends on the observer")]
    ConstraintDependsOnObserver {
        /// The largest entry of the skew part of F (∂μ/∂F)ᵀ.
        skew: f64,
        /// The largest entry of F (∂μ/∂F)ᵀ.
        size: f64,
    },
    /// A constraint follows from others.
    #[error(
        "constraint {index} follows from the others: of {count} only {rank} are independent, {share:e} of it is its own"
    )]
    RedundantConstraint {
        /// The constraint, from 0.
        index: usize,
        /// How many are independent.
        rank: usize,
        /// How many there are.
        count: usize,
        /// What is left of its reaction without the others', as a share of it.
        share: f64,
    },
    /// Constraints contradict one another.
    #[error("constraint {index} contradicts the others by {residual:e}")]
    InconsistentConstraints {
        /// The constraint, from 0.
        index: usize,
        /// Its value less the one that follows from the others.
        residual: f64,
    },
    /// Displacements that are prescribed violate a constraint, whatever the free components do.
    #[error(
        "what is prescribed contradicts constraint {index}: it is {value:e} at F = {gradient:?}, where no free component \
         changes it; valid: 0"
    )]
    ContradictedConstraint {
        /// The constraint, from 0.
        index: usize,
        /// Its value, or what of it no free component can change.
        value: f64,
        /// F with what is prescribed, by rows.
        gradient: [[f64; 3]; 3],
    },
    /// The deformation violates a constraint.
    #[error("the deformation violates constraint {index}: {value:e} is not zero to {tolerance:e}")]
    ConstraintViolated {
        /// The constraint, from 0.
        index: usize,
        /// Its value.
        value: f64,
        /// The largest modulus allowed.
        tolerance: f64,
    },
    /// Conditions on the stress do not determine the multiplier of a constraint.
    #[error("the conditions do not determine the multiplier of constraint {index}: only {rank} of {count}")]
    UndeterminedMultiplier {
        /// The constraint, from 0.
        index: usize,
        /// How many multipliers they determine.
        rank: usize,
        /// How many there are.
        count: usize,
    },
    /// No multipliers satisfy a condition on the stress.
    #[error("no reaction satisfies condition {index}: {residual:e} remains")]
    ImpossibleCondition {
        /// The condition, from 0.
        index: usize,
        /// What its left side has beyond its right, Pa.
        residual: f64,
    },
    /// No shear rate has this shear stress.
    #[error("{fluid}: no shear rate was found at the shear stress {stress:e} Pa: {residual:e} Pa remain")]
    NoShearRate {
        /// The fluid.
        fluid: &'static str,
        /// The shear stress, Pa.
        stress: f64,
        /// By how much the best rate's stress is off, Pa.
        residual: f64,
    },
    /// Entries of a batch of shear rates or stresses have no answer; theirs are NaN, all others are computed.
    #[error("{fluid}: {count} entries have no answer, first of all {value} at {index}")]
    BadEntries {
        /// The fluid.
        fluid: &'static str,
        /// The first such entry, from 0.
        index: usize,
        /// Its value, 1/s or Pa.
        value: f64,
        /// How many there are.
        count: usize,
    },
    /// Points of a batch are bad; the outputs of all others are computed.
    #[error("{} of {count} points are bad: {}", points.len(), first_of(points))]
    BadPoints {
        /// All bad points, in order.
        points: Vec<crate::batch::BadPoint>,
        /// The number of points of the batch.
        count: usize,
        /// How many good points took the slow path of the analysis of the stretches.
        slow_path: usize,
    },
    /// A motion could not be followed.
    #[error("the motion could not be followed: {0}")]
    Integration(#[from] piola_integrators::IntegratorsError),
    /// The deformation or stress itself is refused.
    #[error(transparent)]
    Continuum(#[from] ContinuumError),
}

/// The first bad point in words.
fn first_of(points: &[crate::batch::BadPoint]) -> String {
    points.first().map_or_else(String::new, |point| format!("at point {}, {}", point.index, point.error))
}

/// Refuses a parameter that is not finite.
pub(crate) fn check_finite(law: &'static str, parameter: &'static str, value: f64) -> Result<(), ConstitutiveError> {
    if value.is_finite() { Ok(()) } else { Err(ConstitutiveError::NotFinite { law, parameter, value }) }
}

/// Refuses a parameter that is not finite or for which `holds` is false.
pub(crate) fn check_bound(
    law: &'static str,
    parameter: &'static str,
    value: f64,
    bound: &'static str,
    holds: bool,
) -> Result<(), ConstitutiveError> {
    check_finite(law, parameter, value)?;
    if holds { Ok(()) } else { Err(ConstitutiveError::OutOfBounds { law, parameter, value, bound }) }
}
