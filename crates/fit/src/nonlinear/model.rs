//! Viscoelastic fluids by their names, and their answers in each flow.

use core::fmt;
use core::str::FromStr;

use piola_continuum::Symmetric;
use piola_continuum::rates::VelocityGradient;
use piola_fluids::{
    AnyFluid, ConvectedMaxwell, DifferentialFluid, ExponentialDamping, ExponentialPhanThienTanner, Extension,
    FluidsError, Following, Giesekus, Kbkz, LinearPhanThienTanner, Mode, OldroydB, RationalDamping, Relaxation,
    StressRate, ViscometricFluid,
};

use super::data::{NonlinearData, NonlinearFlow, ShearResponse};
use crate::FitError;

/// Tolerance of the stresses of start-up.
const TOLERANCE: f64 = 1e-12;
/// Relaxation times after which the flow is steady to 10⁻¹⁷: a search that tries short times would integrate for ever.
const SETTLED: f64 = 40.0;

/// A viscoelastic fluid of one mode with unknown parameters.
///
/// | name | fluid | parameters |
/// |---|---|---|
/// | `oldroyd-b` | [`OldroydB`] | `solvent_viscosity`, `polymer_viscosity`, `time` |
/// | `giesekus` | [`Giesekus`] | the same, and `mobility` ≤ ½ |
/// | `linear-ptt`, `exponential-ptt` | [`LinearPhanThienTanner`], [`ExponentialPhanThienTanner`] | the same, and `extensibility` |
/// | `kbkz-rational` | [`Kbkz`] with [`RationalDamping`] | `viscosity`, `time`, `alpha`, `beta` ≤ 1 |
/// | `kbkz-exponential` | [`Kbkz`] with [`ExponentialDamping`] | `viscosity`, `time`, `strength`, `beta` ≤ 1 |
///
/// In shear `beta` of both K-BKZ fluids does nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NonlinearModel {
    /// Oldroyd's fluid B.
    OldroydB,
    /// Giesekus' fluid.
    Giesekus,
    /// Phan-Thien and Tanner's fluid with the linear function.
    LinearPtt,
    /// The same with the exponential function.
    ExponentialPtt,
    /// K-BKZ with the damping of Papanastasiou, Scriven and Macosko.
    KbkzRational,
    /// K-BKZ with Wagner's damping.
    KbkzExponential,
}

impl NonlinearModel {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::OldroydB,
        Self::Giesekus,
        Self::LinearPtt,
        Self::ExponentialPtt,
        Self::KbkzRational,
        Self::KbkzExponential,
    ];

    /// Its name, as `giesekus`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::OldroydB => "oldroyd-b",
            Self::Giesekus => "giesekus",
            Self::LinearPtt => "linear-ptt",
            Self::ExponentialPtt => "exponential-ptt",
            Self::KbkzRational => "kbkz-rational",
            Self::KbkzExponential => "kbkz-exponential",
        }
    }

    /// The names of its parameters, in order.
    #[must_use]
    pub const fn parameters(self) -> &'static [&'static str] {
        match self {
            Self::OldroydB => &["solvent_viscosity", "polymer_viscosity", "time"],
            Self::Giesekus => &["solvent_viscosity", "polymer_viscosity", "time", "mobility"],
            Self::LinearPtt | Self::ExponentialPtt => {
                &["solvent_viscosity", "polymer_viscosity", "time", "extensibility"]
            }
            Self::KbkzRational => &["viscosity", "time", "alpha", "beta"],
            Self::KbkzExponential => &["viscosity", "time", "strength", "beta"],
        }
    }

    /// The bounds of a parameter.
    pub(super) const fn bounds(self, parameter: usize) -> [f64; 2] {
        match (self, parameter) {
            (Self::Giesekus, 3) => [0.0, 0.5],
            (Self::KbkzRational | Self::KbkzExponential, 3) => [0.0, 1.0],
            _ => [0.0, f64::INFINITY],
        }
    }

    /// Starts of a search about a viscosity and a rate.
    pub(super) fn starts(self, [viscosity, rate]: [f64; 2]) -> Vec<Vec<f64>> {
        let mut starts = Vec::new();
        for weissenberg in [0.3, 3.0, 30.0] {
            let time = weissenberg / rate;
            for last in [0.3, 0.03] {
                starts.push(match self {
                    Self::OldroydB => vec![0.3 * last * viscosity, viscosity, time],
                    Self::Giesekus | Self::LinearPtt | Self::ExponentialPtt => {
                        vec![0.1 * viscosity, viscosity, time, last]
                    }
                    Self::KbkzRational => vec![viscosity, time, 3.0 / last, 0.3],
                    Self::KbkzExponential => vec![viscosity, time, last, 0.3],
                });
            }
        }
        starts
    }

    /// The fluid with these parameters.
    ///
    /// # Errors
    /// [`FitError::NumberOfValues`]; [`FitError::Fluids`] for parameters out of bounds.
    pub fn fluid(self, parameters: &[f64]) -> Result<AnyFluid, FitError> {
        let wrong = || FitError::NumberOfValues {
            model: self.name().to_owned(),
            parameters: self.parameters().len(),
            values: parameters.len(),
        };
        let memory = |viscosity, time| vec![Relaxation { viscosity, time }];
        Ok(match (self, parameters) {
            (Self::OldroydB, &[solvent, polymer, time]) => OldroydB::new(solvent, polymer, time)?.into(),
            (Self::Giesekus, &[solvent, polymer, time, alpha]) => Giesekus::new(solvent, polymer, time, alpha)?.into(),
            (Self::LinearPtt, &[solvent, polymer, time, epsilon]) => {
                LinearPhanThienTanner::new(solvent, polymer, time, epsilon)?.into()
            }
            (Self::ExponentialPtt, &[solvent, polymer, time, epsilon]) => {
                ExponentialPhanThienTanner::new(solvent, polymer, time, epsilon)?.into()
            }
            (Self::KbkzRational, &[viscosity, time, alpha, beta]) => {
                Kbkz::new(memory(viscosity, time), RationalDamping::new(alpha, beta)?)?.into()
            }
            (Self::KbkzExponential, &[viscosity, time, strength, beta]) => {
                Kbkz::new(memory(viscosity, time), ExponentialDamping::new(strength, beta)?)?.into()
            }
            _ => return Err(wrong()),
        })
    }

    /// The answers of the fluid with these parameters in the rows of a flow, appended.
    pub(super) fn answers(self, parameters: &[f64], data: &NonlinearData, out: &mut Vec<f64>) -> Result<(), FitError> {
        match self.fluid(parameters)? {
            AnyFluid::OldroydB(fluid) => match data.flow() {
                // Exact.
                NonlinearFlow::ShearStartUp { shear_rate, response } => {
                    for [t, _] in data.rows() {
                        let stresses = fluid.start_up(shear_rate, *t)?;
                        out.push(of_shear(response, stresses.shear, stresses.first));
                    }
                    Ok(())
                }
                _ => differential(&fluid, data, out),
            },
            AnyFluid::Giesekus(fluid) => differential(&fluid, data, out),
            AnyFluid::LinearPhanThienTanner(fluid) => differential(&fluid, data, out),
            AnyFluid::ExponentialPhanThienTanner(fluid) => differential(&fluid, data, out),
            AnyFluid::KbkzRational(fluid) => integral(&fluid, data, out),
            AnyFluid::KbkzExponential(fluid) => integral(&fluid, data, out),
            _ => Ok(()),
        }
    }
}

impl fmt::Display for NonlinearModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for NonlinearModel {
    type Err = FitError;

    fn from_str(text: &str) -> Result<Self, FitError> {
        let found = Self::ALL.into_iter().find(|model| model.name() == text);
        found.ok_or_else(|| FitError::UnknownNonlinearModel { name: text.to_owned() })
    }
}

fn of_shear(response: ShearResponse, shear: f64, first: f64) -> f64 {
    match response {
        ShearResponse::ShearStress => shear,
        ShearResponse::FirstNormalStressDifference => first,
    }
}

/// τ or N₁ in steady shear.
fn steady_shear(fluid: &impl ViscometricFluid, response: ShearResponse, rate: f64) -> f64 {
    match response {
        ShearResponse::ShearStress => fluid.shear_stress(rate),
        ShearResponse::FirstNormalStressDifference => fluid.first_normal_stress_difference(rate),
    }
}

/// The velocity gradient of an extension.
fn extending(extension: Extension, rate: f64) -> [[f64; 3]; 3] {
    let [first, second, third] = extension.rates(rate);
    [[first, 0.0, 0.0], [0.0, second, 0.0], [0.0, 0.0, third]]
}

/// The longest λ, s.
fn slowest(fluid: &impl DifferentialFluid) -> f64 {
    fluid.modes().iter().map(Mode::time).fold(0.0, f64::max)
}

fn differential<F: DifferentialFluid<Mode: StressRate> + ViscometricFluid>(
    fluid: &F,
    data: &NonlinearData,
    out: &mut Vec<f64>,
) -> Result<(), FitError> {
    match data.flow() {
        NonlinearFlow::SteadyShear(response) => {
            out.extend(data.rows().iter().map(|row| steady_shear(fluid, response, row[0])));
        }
        NonlinearFlow::SteadyExtension(extension) => {
            for [rate, _] in data.rows() {
                out.push(extension.difference(fluid.extensional_stress(extension.rates(*rate))?));
            }
        }
        NonlinearFlow::ShearStartUp { shear_rate, response } => {
            let mut motion = Following::from_rest(fluid, TOLERANCE)?;
            let gradient = [[0.0; 3], [shear_rate, 0.0, 0.0], [0.0; 3]];
            for [t, _] in data.rows() {
                if SETTLED * slowest(fluid) < *t {
                    out.push(steady_shear(fluid, response, shear_rate));
                    continue;
                }
                let [t11, t22, _, t12, ..] = motion.advance(|_| gradient, *t)?.components;
                out.push(of_shear(response, t12, t22 - t11));
            }
        }
        NonlinearFlow::ExtensionStartUp { extension, rate } => {
            let mut motion = Following::from_rest(fluid, TOLERANCE)?;
            let gradient = extending(extension, rate);
            let rates = extension.rates(rate);
            let fastest = rates.iter().fold(0.0, |most: f64, rate| most.max(*rate));
            for [t, _] in data.rows() {
                // Stresses approach their end as e^(−(1 − 2 λ ε̇) t/λ).
                let time = slowest(fluid);
                if SETTLED * time < (1.0 - 2.0 * time * fastest) * t {
                    out.push(extension.difference(fluid.extensional_stress(rates)?));
                    continue;
                }
                let [t11, t22, t33, ..] = motion.advance(|_| gradient, *t)?.components;
                out.push(extension.difference([t11, t22, t33]));
            }
        }
    }
    Ok(())
}

fn integral<H: piola_fluids::Damping>(
    fluid: &Kbkz<H>,
    data: &NonlinearData,
    out: &mut Vec<f64>,
) -> Result<(), FitError> {
    for [drive, _] in data.rows() {
        out.push(match data.flow() {
            NonlinearFlow::SteadyShear(response) => steady_shear(fluid, response, *drive),
            NonlinearFlow::ShearStartUp { shear_rate, response } => {
                let stresses = fluid.start_up(shear_rate, *drive)?.value;
                of_shear(response, stresses.shear, stresses.first)
            }
            NonlinearFlow::SteadyExtension(extension) => {
                let gradient = VelocityGradient::from_rows(extending(extension, *drive)).map_err(FluidsError::from)?;
                let [t11, t22, t33, ..] = fluid.steady_stress(&gradient)?.value.components;
                extension.difference([t11, t22, t33])
            }
            NonlinearFlow::ExtensionStartUp { extension, rate } => {
                // Finger's tensor of the past: exp(2 s D).
                let past = |s: f64| {
                    let [a, b, c] = extension.rates(rate).map(|rate| (2.0 * s * rate).exp());
                    Symmetric { components: [a, b, c, 0.0, 0.0, 0.0] }
                };
                let [t11, t22, t33, ..] = fluid.stress_of_history(past, *drive)?.value.components;
                extension.difference([t11, t22, t33])
            }
        });
    }
    Ok(())
}
