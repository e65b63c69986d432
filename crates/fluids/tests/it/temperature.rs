//! Fluids at another temperature: each answers as the fluid all of whose times, parameter by parameter, are aₜ times as long.

use nalgebra::Matrix3;
use piola_continuum::Symmetric;
use piola_continuum::rates::{HomogeneousMotion, VelocityGradient};
use piola_fluids::{
    AnyFluid, Bingham, CarreauYasuda, Casson, ConstantCoefficients, Cross, Ellis, ExponentialDamping,
    ExponentialPhanThienTanner, Extension, Eyring, Giesekus, HerschelBulkley, Kbkz, LinearPhanThienTanner, Modes,
    Newtonian, OldroydB, Oscillation, Papanastasiou, PowerLaw, RationalDamping, ReinerRivlin, Relaxation, SecondOrder,
    ShearStresses, Shifted, SimpleFluid, Sisko, Slipping, UpperConvectedMaxwell,
};
use piola_testkit::{Tol, assert_close_at_scale};

/// aₜ.
const FACTOR: f64 = 1.75;

/// One fluid of each kind, its times `a` times as long.
fn fluids(a: f64) -> Vec<AnyFluid> {
    let powers = |n: f64| a.powf(n);
    let memory =
        || vec![Relaxation { viscosity: 2.0 * a, time: 0.5 * a }, Relaxation { viscosity: a, time: 0.125 * a }];
    let oldroyd = OldroydB::new(0.25 * a, 2.0 * a, 0.5 * a).expect("bounds");
    let fast = OldroydB::new(0.0, a, 0.125 * a).expect("bounds");
    let linear = LinearPhanThienTanner::new(0.125 * a, 2.0 * a, 0.5 * a, 0.3).expect("bounds");
    vec![
        Newtonian::new(0.75 * a).expect("bounds").into(),
        PowerLaw::new(1.5 * powers(0.4), 0.4).expect("bounds").into(),
        Bingham::new(0.5, 0.75 * a).expect("bounds").into(),
        HerschelBulkley::new(0.5, 1.5 * powers(0.4), 0.4).expect("bounds").into(),
        Casson::new(0.5, 0.75 * a).expect("bounds").into(),
        CarreauYasuda::new(2.0 * a, 0.05 * a, 1.5 * a, 0.4, 1.25).expect("bounds").into(),
        Cross::new(2.0 * a, 0.05 * a, 1.5 * a, 0.6).expect("bounds").into(),
        Ellis::new(1.5 * a, 0.75, 2.5).expect("bounds").into(),
        Eyring::new(2.0, 1.5 * a).expect("bounds").into(),
        Sisko::new(0.125 * a, 2.0 * powers(0.4), 0.4).expect("bounds").into(),
        Papanastasiou::new(0.5, 1.5 * powers(0.4), 0.4, 20.0 * a).expect("bounds").into(),
        ReinerRivlin(ConstantCoefficients::new(1.5 * a, 0.5 * a * a).expect("bounds")).into(),
        SecondOrder::new(2.0 * a, -0.5 * a * a, 0.75 * a * a).expect("bounds").into(),
        UpperConvectedMaxwell::new(2.0 * a, 0.5 * a).expect("bounds").into(),
        oldroyd.into(),
        Giesekus::new(0.125 * a, 2.0 * a, 0.5 * a, 0.3).expect("bounds").into(),
        linear.into(),
        ExponentialPhanThienTanner::new(0.125 * a, 2.0 * a, 0.5 * a, 0.3).expect("bounds").into(),
        Slipping::new(linear, 0.125).expect("bounds").into(),
        Modes::new(vec![oldroyd, fast]).expect("modes").into(),
        Kbkz::new(memory(), RationalDamping::new(8.0, 0.5).expect("bounds")).expect("bounds").into(),
        Kbkz::new(memory(), ExponentialDamping::new(0.2, 0.5).expect("bounds")).expect("bounds").into(),
    ]
}

/// A shear that oscillates and turns.
struct Swaying;

impl HomogeneousMotion for Swaying {
    fn gradient<T: piola_numerics::Real>(&self, t: T) -> Matrix3<T> {
        let mut f = Matrix3::from_diagonal_element(T::one());
        f[(1, 0)] = T::lit(1.5) * (T::lit(2.0) * t).sin();
        f[(2, 1)] = T::lit(0.5) * t;
        f
    }
}

fn same(what: &str, actual: &[f64], expected: &[f64]) {
    let scale = expected.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
    assert_close_at_scale(what, actual, expected, scale, Tol::stated(1e-8, "tolerance 1e-11 of each of many steps"));
}

/// Whether both refuse, or both answer with the same numbers.
fn both<T, E: core::fmt::Debug>(what: &str, one: Result<T, E>, other: Result<T, E>, numbers: impl Fn(&T) -> Vec<f64>) {
    match (one, other) {
        (Ok(one), Ok(other)) => same(what, &numbers(&one), &numbers(&other)),
        (Err(_), Err(_)) => {}
        (one, other) => panic!("{what}: refused by one: {:?} {:?}", one.err(), other.err()),
    }
}

#[test]
fn every_response_at_another_temperature_equals_that_of_the_fluid_whose_times_are_as_long() {
    let tensor = |stress: &Symmetric| stress.components.to_vec();
    let shear = |at: &ShearStresses| vec![at.shear, at.first, at.second];
    let harmonics =
        |all: &Oscillation| all.shear.iter().chain(&all.first_normal).flatten().copied().collect::<Vec<_>>();
    let steady = VelocityGradient::from_rows([[0.1, 0.0, 0.2], [1.5, 0.1, 0.0], [0.0, -0.3, -0.2]]).expect("finite");
    let samples = [0.0, 0.2, 0.3, 0.9].map(|t| (t + 7.0, Swaying.deformation(t).expect("a motion")));
    for (reference, exact) in fluids(1.0).into_iter().zip(fluids(FACTOR)) {
        let what = format!("{exact:?}");
        let shifted = Shifted::new(reference, FACTOR).expect("aₜ");
        both(&what, shifted.response_to_steady(&steady), exact.response_to_steady(&steady), tensor);
        let one = shifted.response_to_motion(&Swaying, 0.7, 1e-11);
        both(&what, one, exact.response_to_motion(&Swaying, 0.7, 1e-11), tensor);
        let one = shifted.response_to_samples(&samples, 1e-11);
        both(&what, one, exact.response_to_samples(&samples, 1e-11), tensor);
        for time in [0.0, 0.4, 3.0] {
            let one = shifted.response_to_start(1.5, time, 1e-11);
            both(&what, one, exact.response_to_start(1.5, time, 1e-11), shear);
            let one = shifted.response_to_stop(-1.5, time, 1e-11);
            both(&what, one, exact.response_to_stop(-1.5, time, 1e-11), shear);
        }
        let moduli = |at: &piola_fluids::Moduli| vec![at.storage, at.loss];
        let one = shifted.response_to_small_oscillation(0.7);
        both(&what, one, exact.response_to_small_oscillation(0.7), moduli);
        let one = shifted.response_to_oscillation(1.5, 0.7, 3, 1e-10);
        both(&what, one, exact.response_to_oscillation(1.5, 0.7, 3, 1e-10), harmonics);
        for extension in [Extension::Uniaxial, Extension::Planar, Extension::Biaxial] {
            let one = shifted.response_to_extension(extension, 0.2);
            both(&what, one, exact.response_to_extension(extension, 0.2), |value| vec![*value]);
        }
        assert!(shifted.response_to_start(1.0, -1.0, 1e-9).is_err());
        assert!(shifted.response_to_samples(&samples[..1], 1e-9).is_err());
    }
}
