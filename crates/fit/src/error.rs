//! Violated conditions of fits: each variant names one.

/// A violated condition of a fit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// There is no test to fit to.
    #[error("there is no test to fit to")]
    NoTests,
    /// A test has no points.
    #[error("test `{test}` has no points")]
    EmptyTest {
        /// The test.
        test: String,
    },
    /// All rows of a test are at rest, where every law has the same answers.
    #[error("all rows of the test `{test}` are at rest: they tell nothing of the law")]
    NothingTold {
        /// The test.
        test: String,
    },
    /// Two tests have the same name.
    #[error("two tests are called `{test}`")]
    TestTwice {
        /// Their name.
        test: String,
    },
    /// A stretch of a test is not positive and finite (an amount of shear: not finite).
    #[error("test `{test}`, point {index}: the stretch {value} is not positive and finite")]
    StretchNotPositive {
        /// The test.
        test: String,
        /// The point, from 0.
        index: usize,
        /// The stretch.
        value: f64,
    },
    /// A stretch of a test, or an amount of shear, is so small or large that no law has a stress there.
    #[error(
        "test `{test}`, point {index}: at the stretch {value:e} no law has a stress; valid stretches are 1e-30 to 1e30"
    )]
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
    StressNotFinite {
        /// The test.
        test: String,
        /// The point, from 0.
        index: usize,
        /// The stress.
        value: f64,
    },
    /// A deformation of a test changes the volume of a material that is incompressible.
    #[error("test `{test}`, point {index}: det F = {determinant}, but it must be 1 for an incompressible material")]
    NotIsochoric {
        /// The test.
        test: String,
        /// The point, from 0.
        index: usize,
        /// det F.
        determinant: f64,
    },
    /// An index of a component or axis is not 0, 1 or 2.
    #[error("test `{test}`, point {index}: there is no axis {value}; the axes are 0, 1 and 2")]
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
    WeightNotPositive {
        /// The test.
        test: String,
        /// The weight.
        value: f64,
    },
    /// A model to fit has a name that is not known.
    #[error(
        "no model is called `{name}`; the models are neo-hookean, mooney-rivlin, yeoh, gent, arruda-boyce, carroll, \
         lopez-pamies, van-der-waals, extended-tube, polynomial:n, ogden:n"
    )]
    UnknownModel {
        /// The name.
        name: String,
    },
    /// A fluid has a name that is not known.
    #[error(
        "no fluid that can be fitted is called `{name}`; they are newtonian, power-law, bingham, casson, herschel-bulkley, \
         papanastasiou, eyring, sisko, ellis, cross, carreau-yasuda"
    )]
    UnknownFluid {
        /// The name.
        name: String,
    },
    /// A viscoelastic fluid has a name that is not known.
    #[error(
        "no viscoelastic fluid that can be fitted is called `{name}`; they are oldroyd-b, giesekus, linear-ptt, exponential-ptt, \
         kbkz-rational, kbkz-exponential"
    )]
    UnknownNonlinearModel {
        /// The name.
        name: String,
    },
    /// A measured number is not positive and finite.
    #[error("row {row}: the {quantity} is {value}; it must be positive and finite")]
    RowNotPositive {
        /// The row, from 0.
        row: usize,
        /// The quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// A measured number is not negative and finite.
    #[error("row {row}: the {quantity} is {value}; it must be negative and finite")]
    RowNotNegative {
        /// The row, from 0.
        row: usize,
        /// The quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// A second normal stress difference is measured, and that of the fluid is zero.
    #[error("{model} has no second normal stress difference; of the viscoelastic fluids only giesekus has one")]
    NoSecondNormalStressDifference {
        /// The fluid.
        model: String,
    },
    /// A rate of a flow is not positive and finite.
    #[error("the rate of the flow is {value}; it must be positive and finite")]
    RateNotPositive {
        /// The rate, 1/s.
        value: f64,
    },
    /// A law of foam or fibres has a name that is not known.
    #[error("no law of foam or fibres is called `{name}`; they are hyperfoam:n and holzapfel-gasser-ogden")]
    UnknownSidesModel {
        /// The name.
        name: String,
    },
    /// A law with history has a name that is not known.
    #[error(
        "no law with history is called `{name}`; they are bergstrom-boyce, reese-govindjee, ogden-roxburgh, viscoplastic"
    )]
    UnknownHistoryModel {
        /// The name.
        name: String,
    },
    /// No kind of intervals has this name.
    #[error(
        "no intervals are called `{name}`; they are linear, profile, bootstrap, and bootstrap:N of 200 to 100000 samples"
    )]
    UnknownIntervals {
        /// The name.
        name: String,
    },
    /// A law with history has no answer to a loading.
    #[error(
        "test `{test}`: laws with history are fitted to uniaxial, equibiaxial, planar and simple-shear tests, not to \
         {loading} ones"
    )]
    NoHistoryLoading {
        /// The test.
        test: String,
        /// The loading.
        loading: &'static str,
    },
    /// A time of a test is not finite, or before that of the row above.
    #[error(
        "test `{test}`, point {index}: the time {value} s is not finite and at least {before} s, that of the row above"
    )]
    TimeOutOfOrder {
        /// The test.
        test: String,
        /// The point, from 0.
        index: usize,
        /// The time, s.
        value: f64,
        /// The time of the row above; 0 of the first row.
        before: f64,
    },
    /// A law with history cannot be followed to a row of a test.
    #[cfg(feature = "history")]
    #[error("test `{test}`, point {index}: {error}")]
    NoHistory {
        /// The test.
        test: String,
        /// The point, from 0.
        index: usize,
        /// Why.
        error: Box<piola_inelastic::InelasticError>,
    },
    /// A model of one's own computes more or fewer stresses than a test has rows.
    #[error("{quantity} has {found} entries, and {expected} are needed")]
    WrongLength {
        /// What the array holds.
        quantity: &'static str,
        /// The length needed.
        expected: usize,
        /// Its length.
        found: usize,
    },
    /// No stretch of the free sides was found at which they carry no stress.
    #[error("test `{test}`, point {index}: no stretch of the free sides leaves them without stress")]
    SidesNotFound {
        /// The test.
        test: String,
        /// The point, from 0.
        index: usize,
    },
    /// A law has no answer to a loading.
    #[error("{model} cannot be fitted to {loading} tests; it can to uniaxial, transverse, equibiaxial and planar ones")]
    NoSuchLoading {
        /// The law.
        model: String,
        /// The loading.
        loading: &'static str,
    },
    /// The angle of a strip is not finite.
    #[error("test `{test}`: the angle {value} of the strip is not finite")]
    AngleNotFinite {
        /// The test.
        test: String,
        /// The angle, radians.
        value: f64,
    },
    /// Lateral stretches are given of a test that has none to measure.
    #[error("the test `{test}` has lateral stretches, which are not measured in {loading} tests")]
    NoLateral {
        /// The test.
        test: String,
        /// The loading.
        loading: &'static str,
    },
    /// A series has no terms, or too many.
    #[error("the number of terms of a series is {value}; it must be 1 to 6")]
    SeriesLength {
        /// The number of terms.
        value: usize,
    },
    /// There is no relaxation mode, or there are too many to fit.
    #[error("the number of relaxation modes is {value}; it must be at least 1, and at most 6 if they are fitted")]
    ModeCount {
        /// The number of modes.
        value: usize,
    },
    /// A viscosity or a time of a given relaxation mode is not positive and finite.
    #[error("relaxation mode {index}: the {quantity} is {value}; it must be positive and finite")]
    ModeNotPositive {
        /// The mode, from 0.
        index: usize,
        /// The quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// Nothing is deformed in any test, where every law has the same stress.
    #[error(
        "test `{test}`: all its stretches are {value}, so it deforms nothing, and neither does any other test: the \
         data say nothing of the parameters"
    )]
    NothingDeformed {
        /// The first test.
        test: String,
        /// Its first stretch: 1, or 0 for an amount of shear.
        value: f64,
    },
    /// A model or fluid has more parameters than there are points.
    #[error("{model}: too few measured points ({points}) for the number of parameters ({parameters})")]
    TooFewPoints {
        /// The model or fluid.
        model: String,
        /// Points of all tests.
        points: usize,
        /// Its parameters.
        parameters: usize,
    },
    /// Bounds are given for a parameter that a model or fluid does not have.
    #[error("{model} has no parameter `{parameter}`")]
    UnknownParameter {
        /// The model or fluid.
        model: String,
        /// The parameter.
        parameter: String,
    },
    /// A parameter of a model is to have the sign of one that it cannot.
    #[error(
        "{model}: `{parameter}` cannot take the sign of parameter {index}: the model has no such parameter, or the \
         stress is linear in it"
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
    #[error("{model}: the number of parameter values is {values}; it must be {parameters}")]
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
    /// Bounds of a fluid's parameter are not finite, or leave nothing between them.
    #[error("the bounds {lower:e} and {upper:e} of `{parameter}` must be finite, the lower below the upper")]
    EmptyInterval {
        /// The parameter.
        parameter: String,
        /// Its least value.
        lower: f64,
        /// Its greatest value.
        upper: f64,
    },
    /// A probability of intervals is not between 0 and 1.
    #[error("the confidence {value} is not between 0 and 1")]
    ConfidenceOutOfRange {
        /// The confidence.
        value: f64,
    },
    /// A model or fluid has finite answers at no start of the search.
    #[error("{model}: no starting point of the search has finite answers within the bounds")]
    NoStart {
        /// The model or fluid.
        model: String,
    },
    /// The law of a solid refuses its parameters.
    #[cfg(feature = "solids")]
    #[error(transparent)]
    Solids(#[from] piola_solids::SolidsError),
    /// A law with history refuses its parameters.
    #[cfg(feature = "history")]
    #[error(transparent)]
    Inelastic(#[from] piola_inelastic::InelasticError),
    /// The fluid refuses its parameters, or has no shear rate at a stress.
    #[cfg(feature = "fluids")]
    #[error(transparent)]
    Fluids(#[from] piola_fluids::FluidsError),
    /// A table of measured flows is refused.
    #[cfg(feature = "fluids")]
    #[error(transparent)]
    Viscometry(#[from] piola_viscometry::ViscometryError),
}
