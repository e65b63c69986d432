//! Violated conditions of flows and of recovery from data: each variant names one.

use piola_fluids::FluidsError;

/// A violated condition of viscometry.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ViscometryError {
    /// A number is infinite or NaN.
    #[error("{flow}: {quantity} = {value} is not finite")]
    NotFinite {
        /// The flow.
        flow: &'static str,
        /// The name of the number.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number is outside its bounds.
    #[error("{flow}: {quantity} = {value:e} violates {bound}")]
    OutOfBounds {
        /// The flow.
        flow: &'static str,
        /// The name of the number.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// The condition, such as `0 < R`.
        bound: &'static str,
    },
    /// τ falls where the flow passes: no steady shear is stable there.
    #[error("{fluid}: the shear stress falls, τ′ = {slope:e} Pa s, at the shear rate {shear_rate:e} 1/s")]
    NotIncreasing {
        /// The fluid.
        fluid: &'static str,
        /// The shear rate, 1/s.
        shear_rate: f64,
        /// τ′ there, Pa s.
        slope: f64,
    },
    /// The error of an integral stays large: the integrand jumps or is not smooth.
    #[error("the integral did not converge: its value is {value:e} with the error {error:e}")]
    NotConverged {
        /// The integral.
        value: f64,
        /// Its error.
        error: f64,
    },
    /// No drive has the wanted answer.
    #[error("{flow}: no drive was found for which {quantity} = {value:e}")]
    NoDrive {
        /// The flow.
        flow: &'static str,
        /// The wanted quantity.
        quantity: &'static str,
        /// Its wanted value.
        value: f64,
    },
    /// There is not one answer for each place.
    #[error("{flow}: `{quantity}` has length {found}; length {expected} is needed")]
    WrongLength {
        /// The flow.
        flow: &'static str,
        /// The name of the argument.
        quantity: &'static str,
        /// The number of entries it must have.
        expected: usize,
        /// The number of entries it has.
        found: usize,
    },
    /// A number of a table is missing, infinite, zero or negative.
    #[error("row {row}, column {column}: {value} is not positive and finite")]
    RowNotPositive {
        /// Its row, from 0.
        row: usize,
        /// Its column, from 0.
        column: usize,
        /// It.
        value: f64,
    },
    /// Two rows of a table have the same drive.
    #[error("row {row}: {value:e} repeats the value of the row before")]
    RowTwice {
        /// The second row, from 0.
        row: usize,
        /// The drive.
        value: f64,
    },
    /// The rows of a table do not rise in the drive.
    #[error("row {row}: {value:e} is below {previous:e} of the row before: sort the rows")]
    RowNotSorted {
        /// The row, from 0.
        row: usize,
        /// Its drive.
        value: f64,
        /// The drive of the row before.
        previous: f64,
    },
    /// The response of a table falls, by more than its noise explains, where the drive rises.
    #[error("row {row}: the response {value:e} is not above {previous:e}, the response at a smaller drive")]
    ResponseFalls {
        /// The row, from 0.
        row: usize,
        /// Its response.
        value: f64,
        /// The largest response of the rows before.
        previous: f64,
    },
    /// A table is too short for a derivative.
    #[error("too few rows: {rows} given, at least {least} needed")]
    TooFewRows {
        /// Its rows.
        rows: usize,
        /// The number needed.
        least: usize,
    },
    /// Drives of a table are too close together for a curve.
    #[error("no curve was found through the {rows} rows: their drives are too close together")]
    RowsTooClose {
        /// Its rows.
        rows: usize,
    },
    /// A recovered value is not positive: noise is stronger than the flow.
    #[error("no positive value was recovered at {at:e}: the noise is stronger than the flow")]
    NotRecovered {
        /// Where, in the unit of the abscissa.
        at: f64,
    },
    /// The band of a value has no ends that are numbers: it is not determined.
    #[error("the value at {at:e} is not determined: its band has no ends")]
    NotDetermined {
        /// Where, in the unit of the abscissa.
        at: f64,
    },
    /// Speeds of coaxial cylinders fall towards the smallest torque as those of a fluid that yields.
    #[error(
        "the speeds fall towards the smallest torque as those of a fluid that yields: all shear rates are known from the stress \
         {above:e} Pa on; below, some depend too much on torques that were not measured: fit a fluid with a yield stress"
    )]
    YieldUnknown {
        /// Rows of the table.
        rows: usize,
        /// The stress from which on all values are known, Pa.
        above: f64,
    },
    /// A recovered curve is asked for beyond what was measured.
    #[error("{value:e} lies outside the measured range, {lowest:e} to {highest:e}")]
    NotMeasured {
        /// The abscissa.
        value: f64,
        /// The lowest that was measured.
        lowest: f64,
        /// The highest that was measured.
        highest: f64,
    },
    /// A probability is not between 0 and 1.
    #[error("the confidence {value} violates 0 < confidence < 1")]
    ConfidenceOutOfRange {
        /// The probability.
        value: f64,
    },
    /// A measured curve or its derivative is infinite or NaN.
    #[error("the measured curve or its derivative at {drive:e} is not finite")]
    CurveNotFinite {
        /// The drive.
        drive: f64,
    },
    /// The series of coaxial cylinders does not come to a value.
    #[error(
        "the series at the torque per length {torque:e} N did not converge: its error is {error:e} after {terms} terms"
    )]
    SeriesNotConverged {
        /// The torque per length, N.
        torque: f64,
        /// Its terms.
        terms: usize,
        /// Its error, in the unit of its value.
        error: f64,
    },
    /// A correction needs more tables.
    #[error("too few tables: {tables} given, at least {least} needed")]
    TooFewTables {
        /// The tables.
        tables: usize,
        /// The number needed.
        least: usize,
    },
    /// A correction needs geometries that differ.
    #[error("the {quantity} is {value:e} m in all tables; it must differ between them")]
    SameGeometry {
        /// The quantity that does not differ.
        quantity: &'static str,
        /// Its value, m.
        value: f64,
    },
    /// A correction needs geometries that agree.
    #[error("the {quantity} must be the same in all tables; two of them have {} m and {} m", values[0], values[1])]
    DifferentGeometry {
        /// The quantity that differs.
        quantity: &'static str,
        /// Two of its values, m.
        values: [f64; 2],
    },
    /// Tables that are to be compared do not overlap.
    #[error(
        "no measurement of the first table lies between {lowest:e} and {highest:e}, the range that all tables cover"
    )]
    NothingInCommon {
        /// The lowest that all reach.
        lowest: f64,
        /// The highest that all reach.
        highest: f64,
    },
    /// The fluid itself refuses: no shear rate at a stress, a parameter outside its bounds.
    #[error(transparent)]
    Fluids(#[from] FluidsError),
}

/// Refuses a number that is not finite.
pub(crate) fn check_finite(flow: &'static str, quantity: &'static str, value: f64) -> Result<(), ViscometryError> {
    if value.is_finite() { Ok(()) } else { Err(ViscometryError::NotFinite { flow, quantity, value }) }
}

/// Refuses a number that is not finite or for which `holds` is false.
pub(crate) fn check_bound(
    flow: &'static str,
    quantity: &'static str,
    value: f64,
    bound: &'static str,
    holds: bool,
) -> Result<(), ViscometryError> {
    check_finite(flow, quantity, value)?;
    if holds { Ok(()) } else { Err(ViscometryError::OutOfBounds { flow, quantity, value, bound }) }
}
