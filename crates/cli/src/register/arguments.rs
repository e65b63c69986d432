//! The arguments of the command `register`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use piola_registration::{Interpolant, Registration, RegistrationError, RegistrationModel, SimilarityMeasure};

/// How the moving image resists deformation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Model {
    /// A linear elastic body: small deformations.
    Elastic,
    /// A viscous fluid: large deformations.
    Fluid,
}

/// What is made small.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Measure {
    /// Sum of squares: equal things have equal intensities.
    Squares,
    /// Cross-correlation: intensities are related linearly.
    Correlation,
    /// Mutual information: two kinds of scanner.
    Information,
}

/// Values between samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Interpolation {
    Linear,
    Cubic,
}

#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is an option of the command line")]
pub(crate) struct RegisterArguments {
    /// The image that stays: a PNG, TIFF, `NIfTI` or NRRD file of two or three dimensions.
    pub(crate) fixed: PathBuf,
    /// The image that is deformed until it resembles the fixed one.
    pub(crate) moving: PathBuf,
    /// The model of the deformation.
    #[arg(long, value_enum, default_value_t = Model::Fluid)]
    pub(crate) model: Model,
    /// The measure of similarity.
    #[arg(long, value_enum, default_value_t = Measure::Squares)]
    pub(crate) measure: Measure,
    /// λ of the model, without unit [default: 0].
    #[arg(long, value_name = "NUMBER", default_value_t = 0.0, hide_default_value = true, allow_hyphen_values = true)]
    pub(crate) lambda: f64,
    /// μ of the model, without unit: stiffness of the elastic body, 0.05 by default; of no effect in a fluid with λ = 0.
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    pub(crate) mu: Option<f64>,
    /// Deform both images by half, so that exchanging them inverts the map.
    #[arg(long)]
    pub(crate) symmetric: bool,
    /// Levels of the pyramid; 1 for the given images alone. By default images are halved down to 16 samples.
    #[arg(long, value_name = "N")]
    pub(crate) levels: Option<usize>,
    /// The most steps on a level.
    #[arg(long, value_name = "N", default_value_t = 200)]
    pub(crate) steps: usize,
    /// Share of the whole decrease that ten steps must exceed.
    #[arg(long, value_name = "SHARE", default_value_t = 1e-3)]
    pub(crate) tolerance: f64,
    /// Values between samples.
    #[arg(long, value_enum, default_value_t = Interpolation::Linear)]
    pub(crate) interpolation: Interpolation,
    /// Distance of the samples of PNG and TIFF files, mm, the same along both axes.
    #[arg(long, value_name = "MM")]
    pub(crate) spacing: Option<f64>,
    /// Bring the moving image onto the grid of the fixed one first, by the places in both headers.
    #[arg(long)]
    pub(crate) resample: bool,
    /// Compute in single precision: half the memory.
    #[arg(long)]
    pub(crate) single: bool,
    /// Folder of the results instead of out/register-MOVING.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print JSON to standard output.
    #[arg(long)]
    pub(crate) json: bool,
}

impl RegisterArguments {
    pub(crate) fn similarity(&self) -> SimilarityMeasure {
        match self.measure {
            Measure::Squares => SimilarityMeasure::SumOfSquares,
            Measure::Correlation => SimilarityMeasure::CrossCorrelation,
            Measure::Information => SimilarityMeasure::MutualInformation,
        }
    }

    /// The name of what the measure's number is.
    pub(crate) fn measure_name(&self) -> &'static str {
        match self.measure {
            Measure::Squares => "mean square of the difference",
            Measure::Correlation => "1 - correlation",
            Measure::Information => "-mutual information",
        }
    }

    pub(crate) fn model_name(&self) -> &'static str {
        match self.model {
            Model::Elastic => "elastic",
            Model::Fluid => "fluid",
        }
    }

    pub(crate) fn interpolant(&self) -> Interpolant {
        match self.interpolation {
            Interpolation::Linear => Interpolant::Linear,
            Interpolation::Cubic => Interpolant::CubicSpline,
        }
    }

    /// The method that these arguments state.
    pub(crate) fn method(&self) -> Result<Registration, RegistrationError> {
        let model = match self.model {
            Model::Elastic => RegistrationModel::elastic(self.lambda, self.mu.unwrap_or(0.05))?,
            Model::Fluid => RegistrationModel::viscous_fluid(self.lambda, self.mu.unwrap_or(1.0))?,
        };
        let mut method = Registration::new(model)
            .with_measure(self.similarity())
            .with_interpolant(self.interpolant())
            .with_steps(self.steps)
            .with_tolerance(self.tolerance);
        if self.symmetric {
            method = method.symmetric();
        }
        if let Some(levels) = self.levels {
            method = method.with_levels(levels);
        }
        Ok(method)
    }
}
