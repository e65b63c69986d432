//! Fits of the laws of [`AnyModel`], compiled once, in this crate.
//!
//! [`fit`](super::fit) is compiled in the crate that calls it, because a model may be the caller's own. A program that fits only the
//! laws of this crate saves that: it calls the methods of this file, which do the same.

use piola_specimens::homogeneous::Mode;

use super::{Alone, AnyModel, Data, Fit, HeldOut, Measure, Options, Prediction, Residuals, Test};
use super::{alone, fit_until, held_out, predict};
use crate::FitError;

impl AnyModel {
    /// Fits the law, as [`fit_until`] does.
    ///
    /// # Errors
    /// As [`fit`](super::fit).
    ///
    /// # Example
    /// ```
    /// use piola_fit::solids::{AnyModel, Data, Measure, Options, Table, Test};
    /// let bar = Table::Uniaxial(vec![[2.0, 7.0 / 2.0]]); // 2 (λ − 1/λ²)
    /// let data = Data::new(vec![Test::new("bar", bar, Measure::FirstPiola)?])?;
    /// let fit = AnyModel::NeoHookean.fit_until(&data, &Options::default(), &|| false)?;
    /// assert!((fit.values()[0] - 2.0).abs() < 1e-14);
    /// # Ok::<(), piola_fit::FitError>(())
    /// ```
    pub fn fit_until(&self, data: &Data, options: &Options, stop: &dyn Fn() -> bool) -> Result<Fit, FitError> {
        fit_until(self, data, options, stop)
    }

    /// Fits the law to each test alone, as [`alone`] does.
    #[must_use]
    pub fn alone(&self, data: &Data, options: &Options, joint: &Fit, stop: &dyn Fn() -> bool) -> Vec<Alone> {
        alone(self, data, options, joint, stop)
    }

    /// Predicts each test from a fit to the others, as [`held_out`] does.
    ///
    /// # Errors
    /// As [`held_out`].
    pub fn held_out(&self, data: &Data, options: &Options, stop: &dyn Fn() -> bool) -> Result<Vec<HeldOut>, FitError> {
        held_out(self, data, options, stop)
    }

    /// Stresses of the fitted law with their intervals, as [`predict`] finds them.
    ///
    /// # Errors
    /// As [`predict`].
    pub fn predict(
        &self,
        fit: &Fit,
        mode: Mode,
        measure: Measure,
        stretches: &[f64],
    ) -> Result<Vec<Prediction>, FitError> {
        predict(self, fit, mode, measure, stretches)
    }

    /// Residuals of the fitted law in a test, as [`Test::beside`] finds them.
    ///
    /// # Errors
    /// As [`Test::beside`].
    pub fn residuals(&self, test: &Test, fit: &Fit) -> Result<Residuals, FitError> {
        test.beside(self, fit)
    }
}
