//! Answers of viscoelastic fluids in each flow.
//!
//! The velocity gradient is given, so the modes of a differential fluid do not know of each other: each is followed alone, with steps of
//! its own, and no longer than it remembers.

use piola_continuum::Symmetric;
use piola_continuum::rates::VelocityGradient;
use piola_fluids::{
    ConvectedMaxwell, Damping, DifferentialFluid, Extension, FluidsError, Following, Kbkz, Mode, OldroydB, StressRate,
    ViscometricFluid,
};

use super::data::{NonlinearData, NonlinearFlow, ShearResponse};
use crate::FitError;

/// Tolerance of the stresses of start-up.
const TOLERANCE: f64 = 1e-12;
/// Relaxation times after which the flow is steady to 10⁻¹⁷: a search that tries short times would integrate for ever.
const SETTLED: f64 = 40.0;

/// Of τ, N₁ and N₂.
const fn of_shear(response: ShearResponse, [shear, first, second]: [f64; 3]) -> f64 {
    match response {
        ShearResponse::ShearStress => shear,
        ShearResponse::FirstNormalStressDifference => first,
        ShearResponse::SecondNormalStressDifference => second,
    }
}

/// τ, N₁ or N₂ in steady shear.
fn steady_shear(fluid: &impl ViscometricFluid, response: ShearResponse, rate: f64) -> f64 {
    match response {
        ShearResponse::ShearStress => fluid.shear_stress(rate),
        ShearResponse::FirstNormalStressDifference => fluid.first_normal_stress_difference(rate),
        ShearResponse::SecondNormalStressDifference => fluid.second_normal_stress_difference(rate),
    }
}

/// The velocity gradient of an extension.
fn extending(extension: Extension, rate: f64) -> [[f64; 3]; 3] {
    let [first, second, third] = extension.rates(rate);
    [[first, 0.0, 0.0], [0.0, second, 0.0], [0.0, 0.0, third]]
}

/// The answers of Oldroyd's fluid B in the rows of a flow, in closed form, appended.
pub(super) fn linear(modes: &[OldroydB], data: &NonlinearData, out: &mut Vec<f64>) -> Result<(), FitError> {
    for [drive, _] in data.rows() {
        let mut sum = 0.0;
        for mode in modes {
            sum += match data.flow() {
                NonlinearFlow::SteadyShear(response) => steady_shear(mode, response, *drive),
                NonlinearFlow::SteadyExtension(extension) => {
                    extension.difference(mode.extensional_stress(extension.rates(*drive))?)
                }
                NonlinearFlow::ShearStartUp { shear_rate, response } => {
                    let stresses = mode.start_up(shear_rate, *drive)?;
                    of_shear(response, [stresses.shear, stresses.first, stresses.second])
                }
                NonlinearFlow::ExtensionStartUp { extension, rate } => {
                    let gradient =
                        VelocityGradient::from_rows(extending(extension, rate)).map_err(FluidsError::from)?;
                    let [t11, t22, t33, ..] = mode.start_up_stress(&gradient, *drive)?.components;
                    extension.difference([t11, t22, t33])
                }
            };
        }
        out.push(sum);
    }
    Ok(())
}

/// The answers of all modes in the rows of a flow, appended.
pub(super) fn differential<M>(modes: &[M], data: &NonlinearData, out: &mut Vec<f64>) -> Result<(), FitError>
where
    M: Mode + StressRate + DifferentialFluid<Mode = M>,
{
    let begin = out.len();
    out.resize(begin + data.rows().len(), 0.0);
    for mode in modes {
        add(mode, data, &mut out[begin..])?;
    }
    Ok(())
}

/// Adds the answers of a mode.
fn add<M>(mode: &M, data: &NonlinearData, out: &mut [f64]) -> Result<(), FitError>
where
    M: Mode + StressRate + DifferentialFluid<Mode = M>,
{
    let rows = || data.rows().iter().map(|row| row[0]);
    match data.flow() {
        NonlinearFlow::SteadyShear(response) => {
            for (sum, rate) in out.iter_mut().zip(rows()) {
                *sum += steady_shear(mode, response, rate);
            }
        }
        NonlinearFlow::SteadyExtension(extension) => {
            for (sum, rate) in out.iter_mut().zip(rows()) {
                *sum += extension.difference(mode.extensional_stress(extension.rates(rate))?);
            }
        }
        NonlinearFlow::ShearStartUp { shear_rate, response } => {
            let mut motion = Following::from_rest(mode, TOLERANCE)?;
            let gradient = [[0.0; 3], [shear_rate, 0.0, 0.0], [0.0; 3]];
            for (sum, t) in out.iter_mut().zip(rows()) {
                *sum += if SETTLED * mode.time() < t {
                    steady_shear(mode, response, shear_rate)
                } else {
                    let [t11, t22, t33, t12, ..] = motion.advance(|_| gradient, t)?.components;
                    of_shear(response, [t12, t22 - t11, t11 - t33])
                };
            }
        }
        NonlinearFlow::ExtensionStartUp { extension, rate } => {
            let mut motion = Following::from_rest(mode, TOLERANCE)?;
            let (gradient, rates) = (extending(extension, rate), extension.rates(rate));
            let fastest = rates.iter().fold(0.0, |most: f64, rate| most.max(*rate));
            for (sum, t) in out.iter_mut().zip(rows()) {
                // Stresses approach their end as e^(−(1 − 2 λ ε̇) t/λ).
                let is_settled = SETTLED * mode.time() < (1.0 - 2.0 * mode.time() * fastest) * t;
                let stresses = if is_settled {
                    mode.extensional_stress(rates)?
                } else {
                    let [t11, t22, t33, ..] = motion.advance(|_| gradient, t)?.components;
                    [t11, t22, t33]
                };
                *sum += extension.difference(stresses);
            }
        }
    }
    Ok(())
}

/// The answers of a K-BKZ fluid in the rows of a flow, appended.
pub(super) fn integral<H: Damping>(fluid: &Kbkz<H>, data: &NonlinearData, out: &mut Vec<f64>) -> Result<(), FitError> {
    for [drive, _] in data.rows() {
        out.push(match data.flow() {
            NonlinearFlow::SteadyShear(response) => steady_shear(fluid, response, *drive),
            NonlinearFlow::ShearStartUp { shear_rate, response } => {
                let stresses = fluid.start_up(shear_rate, *drive)?.value;
                of_shear(response, [stresses.shear, stresses.first, stresses.second])
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
