//! Measured responses of viscoelastic fluids to flows that draw them out.

pub use piola_fluids::Extension;

use crate::FitError;

/// What is measured in a shear flow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum ShearResponse {
    /// τ, Pa.
    ShearStress,
    /// N₁, Pa.
    FirstNormalStressDifference,
    /// N₂, Pa; negative.
    SecondNormalStressDifference,
}

impl ShearResponse {
    /// The sign of all its values.
    pub(super) const fn sign(self) -> f64 {
        match self {
            Self::SecondNormalStressDifference => -1.0,
            _ => 1.0,
        }
    }
}

/// A flow and what is measured in it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum NonlinearFlow {
    /// Steady shear; the drive is the shear rate, 1/s.
    SteadyShear(ShearResponse),
    /// Shear from rest; the drive is the time, s.
    ShearStartUp {
        /// The shear rate, 1/s.
        shear_rate: f64,
        /// What is measured.
        response: ShearResponse,
    },
    /// Steady extension; the drive is the rate ε̇, 1/s, the response the stress difference, Pa.
    SteadyExtension(Extension),
    /// Extension from rest; the drive is the time, s, the response the stress difference, Pa.
    ExtensionStartUp {
        /// The kind of extension.
        extension: Extension,
        /// ε̇, 1/s.
        rate: f64,
    },
}

impl NonlinearFlow {
    /// The measured response of a shear flow; `None` of an extension.
    #[must_use]
    pub const fn shear_response(self) -> Option<ShearResponse> {
        match self {
            Self::SteadyShear(response) | Self::ShearStartUp { response, .. } => Some(response),
            _ => None,
        }
    }
}

/// Rows (drive, response) of one flow.
///
/// # Example
/// ```
/// use piola_fit::nonlinear::{Extension, NonlinearData, NonlinearFlow};
/// let flow = NonlinearFlow::ExtensionStartUp { extension: Extension::Uniaxial, rate: 0.5 };
/// assert_eq!(NonlinearData::new(flow, vec![[0.1, 3.0], [0.2, 5.0]])?.rows().len(), 2);
/// let refused = NonlinearData::new(flow, vec![[0.1, -3.0]]).unwrap_err().to_string();
/// assert_eq!(refused, "row 0: the response is -3; it must be positive and finite");
/// # Ok::<(), piola_fit::FitError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct NonlinearData {
    flow: NonlinearFlow,
    rows: Vec<[f64; 2]>,
}

impl NonlinearData {
    /// From rows in any order; they are sorted by their drive.
    ///
    /// # Errors
    /// [`FitError::RateNotPositive`]; [`FitError::RowNotPositive`] for a drive or a response that is not positive and finite;
    /// [`FitError::RowNotNegative`] for an N₂ that is not negative and finite.
    pub fn new(flow: NonlinearFlow, mut rows: Vec<[f64; 2]>) -> Result<Self, FitError> {
        let holds = |value: f64| 0.0 < value && value.is_finite();
        let check = |row: usize, quantity: &'static str, value: f64| {
            if holds(value) { Ok(()) } else { Err(FitError::RowNotPositive { row, quantity, value }) }
        };
        if let NonlinearFlow::ShearStartUp { shear_rate: rate, .. } | NonlinearFlow::ExtensionStartUp { rate, .. } =
            flow
            && !holds(rate)
        {
            return Err(FitError::RateNotPositive { value: rate });
        }
        let is_negative = flow.shear_response().is_some_and(|response| response.sign() < 0.0);
        for (row, &[drive, response]) in rows.iter().enumerate() {
            check(row, "drive", drive)?;
            if !is_negative {
                check(row, "response", response)?;
            } else if !holds(-response) {
                return Err(FitError::RowNotNegative { row, quantity: "response", value: response });
            }
        }
        rows.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Ok(Self { flow, rows })
    }

    /// The flow.
    #[must_use]
    pub const fn flow(&self) -> NonlinearFlow {
        self.flow
    }

    /// The rows, by rising drive.
    #[must_use]
    pub fn rows(&self) -> &[[f64; 2]] {
        &self.rows
    }

    /// A viscosity that a slow fluid would have, and a rate, for starts of a search.
    pub(super) fn scales(&self) -> Option<[f64; 2]> {
        let largest = |f: &dyn Fn(&[f64; 2]) -> f64| self.rows.iter().map(f).fold(0.0, f64::max);
        let last = self.rows.last()?[0];
        // N₂ is a share of N₁ that is not known yet.
        if self.flow.shear_response() == Some(ShearResponse::SecondNormalStressDifference) {
            return None;
        }
        let found = match self.flow {
            NonlinearFlow::SteadyShear(ShearResponse::ShearStress) => [largest(&|[k, tau]| tau / k), last],
            NonlinearFlow::ShearStartUp { shear_rate, response: ShearResponse::ShearStress } => {
                [largest(&|row| row[1]) / shear_rate, shear_rate]
            }
            NonlinearFlow::SteadyExtension(extension) => {
                [largest(&|[rate, stress]| stress / rate) / extension.trouton_ratio(), last]
            }
            NonlinearFlow::ExtensionStartUp { extension, rate } => {
                [largest(&|row| row[1]) / rate / extension.trouton_ratio(), rate]
            }
            // N₁ is 2 η λ k²: with λ = 1/k about η = N₁/(2 k).
            NonlinearFlow::SteadyShear(_) => [largest(&|[k, first]| first / (2.0 * k)), last],
            NonlinearFlow::ShearStartUp { shear_rate, .. } => [largest(&|row| row[1]) / (2.0 * shear_rate), shear_rate],
        };
        Some(found)
    }
}
