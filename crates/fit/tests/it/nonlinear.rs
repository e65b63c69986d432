//! Viscoelastic fluids found again from their own flows, exact and with noise.

use piola_fit::FitError;
use piola_fit::nonlinear::{
    Extension, NonlinearData, NonlinearFlow, NonlinearModel, Options, RelaxationModes, ShearResponse, State,
    fit_nonlinear,
};
use piola_fluids::{
    AnyFluid, DifferentialFluid, Extension as Kind, Giesekus, Modes, OldroydB, Parameters, Relaxation,
    ViscometricFluid, follow,
};
use piola_testkit::{Tol, assert_each_close};

const FOUND: Tol = Tol::stated(1e-8, "answers of start-up are integrated to 1e-12");

fn rates(low: f64, count: u32) -> Vec<f64> {
    (0..count).map(|k| low * 2.0_f64.powi(k.cast_signed())).collect()
}

/// All flows of a fluid, with responses that `answer` gives.
fn flows(mut answer: impl FnMut(NonlinearFlow, f64) -> f64) -> Vec<NonlinearData> {
    use ShearResponse::{FirstNormalStressDifference, ShearStress};
    let start = |shear_rate, response| NonlinearFlow::ShearStartUp { shear_rate, response };
    let flows = [
        (NonlinearFlow::SteadyShear(ShearStress), rates(0.02, 9)),
        (NonlinearFlow::SteadyShear(FirstNormalStressDifference), rates(0.1, 6)),
        (start(2.0, ShearStress), rates(0.05, 7)),
        (start(2.0, FirstNormalStressDifference), rates(0.1, 6)),
        (NonlinearFlow::SteadyExtension(Extension::Uniaxial), rates(0.01, 5)),
        (NonlinearFlow::ExtensionStartUp { extension: Extension::Uniaxial, rate: 0.3 }, rates(0.1, 6)),
        (NonlinearFlow::ExtensionStartUp { extension: Extension::Biaxial, rate: 0.1 }, rates(0.1, 5)),
    ];
    let set = |(flow, drives): (NonlinearFlow, Vec<f64>)| {
        let rows = drives.into_iter().map(|drive| [drive, answer(flow, drive)]).collect();
        NonlinearData::new(flow, rows).expect("positive")
    };
    flows.into_iter().map(set).collect()
}

/// The answers of a fluid, from its own functions.
fn answer(fluid: &AnyFluid, flow: NonlinearFlow, drive: f64) -> f64 {
    let sheared = |first: bool, stress: [f64; 6]| if first { stress[1] - stress[0] } else { stress[3] };
    let is_first = |response| response == ShearResponse::FirstNormalStressDifference;
    let extended = |kind: Kind, rate: f64| {
        let [a, b, c] = kind.rates(rate);
        [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]]
    };
    let along = |gradient: [[f64; 3]; 3]| -> [f64; 6] {
        macro_rules! followed {
            ($fluid:expr) => {
                follow($fluid, |_| gradient, &[drive], 1e-13).expect("a stress")[0].components
            };
        }
        match fluid {
            AnyFluid::OldroydB(fluid) => followed!(fluid),
            AnyFluid::Giesekus(fluid) => followed!(fluid),
            AnyFluid::LinearPhanThienTanner(fluid) => followed!(fluid),
            AnyFluid::ExponentialPhanThienTanner(fluid) => followed!(fluid),
            _ => panic!("no differential fluid"),
        }
    };
    match flow {
        NonlinearFlow::SteadyShear(ShearResponse::ShearStress) => fluid.shear_stress(drive),
        NonlinearFlow::SteadyShear(_) => fluid.first_normal_stress_difference(drive),
        NonlinearFlow::SteadyExtension(kind) => {
            let rates = kind.rates(drive);
            kind.difference(match fluid {
                AnyFluid::OldroydB(fluid) => fluid.extensional_stress(rates).expect("slow"),
                AnyFluid::Giesekus(fluid) => fluid.extensional_stress(rates).expect("bounded"),
                AnyFluid::LinearPhanThienTanner(fluid) => fluid.extensional_stress(rates).expect("bounded"),
                AnyFluid::ExponentialPhanThienTanner(fluid) => fluid.extensional_stress(rates).expect("bounded"),
                _ => panic!("no differential fluid"),
            })
        }
        NonlinearFlow::ShearStartUp { shear_rate, response } => {
            sheared(is_first(response), along([[0.0; 3], [shear_rate, 0.0, 0.0], [0.0; 3]]))
        }
        NonlinearFlow::ExtensionStartUp { extension, rate } => {
            let [a, b, c, ..] = along(extended(extension, rate));
            extension.difference([a, b, c])
        }
        _ => panic!("another flow"),
    }
}

/// From the usual starts, or from one that is near.
fn values(model: NonlinearModel, data: &[NonlinearData], near: Option<&[f64]>) -> Vec<f64> {
    let starts = near.iter().map(|near| near.iter().map(|value| 1.3 * value).collect()).collect();
    let fit = fit_nonlinear(model, data, &Options { starts, ..Options::default() }).expect("a fit");
    assert!(fit.outcome.is_converged(), "{model}: {:?}", fit.outcome);
    fit.parameters.iter().map(|parameter| parameter.value).collect()
}

#[test]
fn differential_fluids_are_found_again_from_exact_flows() -> Result<(), FitError> {
    for (model, exact) in [
        (NonlinearModel::OldroydB, vec![0.5, 20.0, 1.5]),
        (NonlinearModel::Giesekus, vec![0.5, 20.0, 1.5, 0.2]),
        (NonlinearModel::LinearPtt, vec![0.5, 20.0, 1.5, 0.1]),
        (NonlinearModel::ExponentialPtt, vec![0.5, 20.0, 1.5, 0.1]),
    ] {
        let fluid = model.fluid(&RelaxationModes::Fitted(1), &exact)?;
        let data = flows(|flow, drive| answer(&fluid, flow, drive));
        assert_each_close(model.name(), &values(model, &data, Some(&exact)), &exact, FOUND);
        // Steady shear, steady extension and one start-up tell all from afar.
        let some: Vec<NonlinearData> = [0, 1, 2, 4].map(|k: usize| data[k].clone()).to_vec();
        if model == NonlinearModel::Giesekus {
            assert_each_close(model.name(), &values(model, &some, None), &exact, FOUND);
        }
    }
    Ok(())
}

/// Start-up of shear of a K-BKZ fluid with Wagner's damping and β = 1 in closed form.
///
/// τ = (η/λ) k ∫₀ᵗ s e^(−q s)/λ ds + (η/λ) k t e^(−q t), q = 1/λ + n k; N₁ alike with one power more.
fn wagner([viscosity, time, strength]: [f64; 3], rate: f64, t: f64) -> [f64; 2] {
    let q = time.recip() + strength * rate;
    let (modulus, x) = (viscosity / time, q * t);
    let first = (1.0 - (-x).exp() * (1.0 + x)) / (q * q);
    let second = (2.0 - (-x).exp() * (2.0 + 2.0 * x + x * x)) / (q * q * q);
    let older = (-x).exp();
    [modulus * rate * (first / time + t * older), modulus * rate * rate * (second / time + t * t * older)]
}

#[test]
fn fluid_of_wagner_is_found_again_from_closed_forms_of_shear() -> Result<(), FitError> {
    let exact = [8.0, 2.0, 0.3];
    let start = |shear_rate, response, k: usize| {
        let flow = NonlinearFlow::ShearStartUp { shear_rate, response };
        let row = |t: f64| [t, wagner(exact, shear_rate, t)[k]];
        NonlinearData::new(flow, rates(0.1, 7).into_iter().map(row).collect())
    };
    // η k/(1 + n λ k)².
    let steady = |k: f64| [k, exact[0] * k / (1.0 + exact[2] * exact[1] * k).powi(2)];
    let data = [
        start(1.0, ShearResponse::ShearStress, 0)?,
        start(4.0, ShearResponse::FirstNormalStressDifference, 1)?,
        NonlinearData::new(
            NonlinearFlow::SteadyShear(ShearResponse::ShearStress),
            rates(0.05, 8).into_iter().map(steady).collect(),
        )?,
    ];
    let fit = fit_nonlinear(NonlinearModel::KbkzExponential, &data, &Options::default())?;
    let found: Vec<f64> = fit.parameters.iter().take(3).map(|parameter| parameter.value).collect();
    assert_each_close("η, λ, n", &found, &exact, FOUND);
    // In shear I₁ = I₂: nothing tells β.
    assert!(fit.parameters[3].interval.is_none() && fit.parameters[3].state != State::Determined);
    Ok(())
}

#[test]
fn integral_fluids_are_found_again_from_shear_and_extension() -> Result<(), FitError> {
    for (model, exact) in [
        (NonlinearModel::KbkzRational, vec![20.0, 1.5, 4.0, 0.3]),
        (NonlinearModel::KbkzExponential, vec![20.0, 1.5, 0.3, 0.4]),
    ] {
        let fluid = model.fluid(&RelaxationModes::Fitted(1), &exact)?;
        macro_rules! stress {
            ($flow:expr, $drive:expr, $fluid:expr) => {
                match $flow {
                    NonlinearFlow::SteadyShear(ShearResponse::ShearStress) => $fluid.steady_shear($drive)[0].value,
                    NonlinearFlow::SteadyShear(_) => $fluid.steady_shear($drive)[1].value,
                    NonlinearFlow::ShearStartUp { shear_rate, response } => {
                        let found = $fluid.start_up(shear_rate, $drive)?.value;
                        if response == ShearResponse::ShearStress { found.shear } else { found.first }
                    }
                    NonlinearFlow::ExtensionStartUp { extension, rate } => {
                        let motion = Extending(extension.rates(rate));
                        let [a, b, c, ..] = $fluid.stress_along(&motion, $drive)?.value.components;
                        extension.difference([a, b, c])
                    }
                    _ => return Err(FitError::NoTests),
                }
            };
        }
        let mut data = Vec::new();
        let start = |shear_rate, response| NonlinearFlow::ShearStartUp { shear_rate, response };
        for (flow, drives) in [
            (NonlinearFlow::SteadyShear(ShearResponse::ShearStress), rates(0.05, 7)),
            (start(2.0, ShearResponse::FirstNormalStressDifference), rates(0.1, 5)),
            (NonlinearFlow::ExtensionStartUp { extension: Extension::Uniaxial, rate: 0.5 }, rates(0.1, 6)),
            (NonlinearFlow::ExtensionStartUp { extension: Extension::Biaxial, rate: 0.3 }, rates(0.1, 5)),
        ] {
            let mut rows = Vec::new();
            for drive in drives {
                let stress = match &fluid {
                    AnyFluid::KbkzRational(fluid) => stress!(flow, drive, fluid),
                    AnyFluid::KbkzExponential(fluid) => stress!(flow, drive, fluid),
                    _ => return Err(FitError::NoTests),
                };
                rows.push([drive, stress]);
            }
            data.push(NonlinearData::new(flow, rows)?);
        }
        assert_each_close(model.name(), &values(model, &data, Some(&exact)), &exact, FOUND);
    }
    Ok(())
}

/// Steady extension from rest: F = exp(t D).
struct Extending([f64; 3]);

impl piola_continuum::rates::HomogeneousMotion for Extending {
    fn gradient<T: piola_numerics::Real>(&self, t: T) -> nalgebra::Matrix3<T> {
        let [a, b, c] = self.0.map(|rate| (t * T::lit(rate)).exp());
        nalgebra::Matrix3::from_diagonal(&nalgebra::Vector3::new(a, b, c))
    }
}

#[test]
fn intervals_of_noisy_flows_hold_the_parameters_as_often_as_they_say() -> Result<(), FitError> {
    const TABLES: u64 = 50;
    let exact = Giesekus::new(0.5, 20.0, 1.5, 0.2)?;
    let any = AnyFluid::from(exact);
    // Steady shear, steady extension, and the start-up of one shear.
    let all = flows(|flow, drive| answer(&any, flow, drive));
    let truth: Vec<NonlinearData> = [0, 1, 2, 4].map(|k: usize| all[k].clone()).to_vec();
    let near = exact.parameters().map(|value| 1.1 * value).to_vec();
    let options = Options { starts: vec![near], ..Options::default() };
    let (mut inside, mut counted) = (0_usize, 0_usize);
    for seed in 1..=TABLES {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        // The sum of twelve uniform numbers.
        let mut disturbed = |y: f64| y * (1.0 + 0.02 * ((0..12).map(|_| uniform()).sum::<f64>() - 6.0));
        let data: Vec<NonlinearData> = truth
            .iter()
            .map(|set| {
                let rows = set.rows().iter().map(|row| [row[0], disturbed(row[1])]).collect();
                NonlinearData::new(set.flow(), rows)
            })
            .collect::<Result<_, _>>()?;
        let fit = fit_nonlinear(NonlinearModel::Giesekus, &data, &options)?;
        for (parameter, value) in fit.parameters.iter().zip(exact.parameters()) {
            if let Some([low, high]) = parameter.interval {
                counted += 1;
                inside += usize::from(low <= value && value <= high);
            }
        }
    }
    assert_eq!(counted, 4 * 50);
    // 200 intervals: the standard deviation is 1.5 %.
    let share = inside as f64 / counted as f64;
    assert!((0.92..=0.98).contains(&share), "{share}");
    Ok(())
}

#[test]
fn impossible_flows_and_unknown_fluids_are_refused_by_name() -> Result<(), FitError> {
    let steady = NonlinearFlow::SteadyShear(ShearResponse::ShearStress);
    let refused = NonlinearData::new(steady, vec![[1.0, 2.0], [f64::NAN, 1.0]]).expect_err("NaN").to_string();
    assert_eq!(refused, "row 1: the drive is NaN; it must be positive and finite");
    let flow = NonlinearFlow::ExtensionStartUp { extension: Extension::Planar, rate: -1.0 };
    let refused = NonlinearData::new(flow, vec![]).expect_err("a negative rate").to_string();
    assert_eq!(refused, "the rate of the flow is -1; it must be positive and finite");
    let few = NonlinearData::new(steady, vec![[1.0, 2.0]])?;
    let refused = fit_nonlinear(NonlinearModel::Giesekus, &[few], &Options::default()).expect_err("few").to_string();
    assert_eq!(refused, "giesekus: too few measured points (1) for the number of parameters (4)");
    assert!("maxwell".parse::<NonlinearModel>().is_err_and(|error| error.to_string().contains("kbkz-rational")));
    // Shear alone does not tell a solvent from a polymer of Oldroyd's fluid B.
    let fluid = OldroydB::new(1.0, 2.0, 0.5)?;
    let rows = rates(0.1, 6).into_iter().map(|k| [k, fluid.shear_stress(k)]).collect();
    let fit = fit_nonlinear(NonlinearModel::OldroydB, &[NonlinearData::new(steady, rows)?], &Options::default())?;
    assert!(fit.parameters.iter().all(|parameter| parameter.state != State::Determined), "{:?}", fit.parameters);
    Ok(())
}

/// Several modes of Giesekus' fluid, followed together by the fluid itself, with N₂.
fn several() -> (Modes<Giesekus>, Vec<NonlinearData>) {
    let fluid = Modes::new(vec![
        Giesekus::new(0.5, 4.0, 0.05, 0.2).expect("a mode"),
        Giesekus::new(0.0, 20.0, 2.0, 0.2).expect("a mode"),
    ])
    .expect("modes");
    let start = |shear_rate: f64, response: ShearResponse| {
        let times = rates(0.02, 11);
        let gradient = [[0.0; 3], [shear_rate, 0.0, 0.0], [0.0; 3]];
        let stresses = follow(&fluid, |_| gradient, &times, 1e-13).expect("stresses");
        let rows = times.iter().zip(stresses).map(|(t, stress)| {
            let [t11, t22, t33, t12, ..] = stress.components;
            let value = match response {
                ShearResponse::ShearStress => t12,
                ShearResponse::FirstNormalStressDifference => t22 - t11,
                ShearResponse::SecondNormalStressDifference => t11 - t33,
            };
            [*t, value]
        });
        NonlinearData::new(NonlinearFlow::ShearStartUp { shear_rate, response }, rows.collect()).expect("rows")
    };
    let steady = rates(0.01, 14).into_iter().map(|k| [k, fluid.shear_stress(k)]).collect();
    let data = vec![
        NonlinearData::new(NonlinearFlow::SteadyShear(ShearResponse::ShearStress), steady).expect("rows"),
        start(3.0, ShearResponse::ShearStress),
        start(3.0, ShearResponse::FirstNormalStressDifference),
        start(1.0, ShearResponse::SecondNormalStressDifference),
    ];
    (fluid, data)
}

#[test]
fn modes_of_a_spectrum_and_their_mobility_are_found_again() -> Result<(), FitError> {
    let (fluid, data) = several();
    let options = Options { modes: RelaxationModes::Fitted(2), ..Options::default() };
    let fit = fit_nonlinear(NonlinearModel::Giesekus, &data, &options)?;
    let found: Vec<f64> = fit.parameters.iter().map(|parameter| parameter.value).collect();
    assert_each_close("ηₛ, η₁, λ₁, η₂, λ₂, α", &found, &[0.5, 4.0, 0.05, 20.0, 2.0, 0.2], FOUND);
    assert_eq!(fit.parameters[3].name, "polymer_viscosity2");
    assert!(matches!(fit.fluid, AnyFluid::GiesekusModes(_)));
    // The spectrum is known from oscillation: what is left is told to the same accuracy.
    let given = fluid.modes().iter().map(|m| Relaxation { viscosity: m.polymer_viscosity(), time: m.time() }).collect();
    let options = Options { modes: RelaxationModes::Given(given), ..Options::default() };
    let fit = fit_nonlinear(NonlinearModel::Giesekus, &data, &options)?;
    let found: Vec<f64> = fit.parameters.iter().map(|parameter| parameter.value).collect();
    assert_each_close("ηₛ, α", &found, &[0.5, 0.2], FOUND);
    Ok(())
}

#[test]
fn second_normal_stresses_and_modes_are_checked_by_name() {
    let (_, data) = several();
    let refused = fit_nonlinear(NonlinearModel::LinearPtt, &data, &Options::default()).expect_err("no N₂").to_string();
    assert!(refused.starts_with("linear-ptt has no second normal stress difference"), "{refused}");
    let second = NonlinearFlow::SteadyShear(ShearResponse::SecondNormalStressDifference);
    let refused = NonlinearData::new(second, vec![[1.0, 2.0]]).expect_err("positive").to_string();
    assert_eq!(refused, "row 0: the response is 2; it must be negative and finite");
    let good = Relaxation { viscosity: 1.0, time: 1.0 };
    for (modes, what) in [
        (RelaxationModes::Fitted(0), "the number of relaxation modes is 0; it must be at least 1"),
        (RelaxationModes::Given(vec![]), "the number of relaxation modes is 0"),
        (
            RelaxationModes::Given(vec![Relaxation { viscosity: -1.0, time: 1.0 }]),
            "relaxation mode 0: the viscosity is -1;",
        ),
        (
            RelaxationModes::Given(vec![good, Relaxation { viscosity: 1.0, time: f64::NAN }]),
            "relaxation mode 1: the time is NaN",
        ),
    ] {
        // The same words for a fluid without a solvent.
        let options = Options { modes, ..Options::default() };
        let first = &data[..1];
        for model in [NonlinearModel::Giesekus, NonlinearModel::KbkzRational] {
            let refused = fit_nonlinear(model, first, &options).expect_err(what).to_string();
            assert!(refused.contains(what), "{refused}");
        }
    }
}
