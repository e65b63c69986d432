//! Fluids with normal stresses, one of each kind, and all fluids.

use piola_fluids::{
    AnyFluid, ConstantCoefficients, ExponentialDamping, ExponentialPhanThienTanner, Giesekus, Kbkz,
    LinearPhanThienTanner, Modes, OldroydB, RationalDamping, ReinerRivlin, Relaxation, SecondOrder, Slipping,
    UpperConvectedMaxwell,
};

use super::shear::fluids;

/// All built-in fluids, some of them twice.
pub(super) fn all() -> Vec<AnyFluid> {
    fluids().into_iter().chain(elastic()).collect()
}

/// One of each with normal stresses.
pub(super) fn elastic() -> Vec<AnyFluid> {
    let memory = vec![Relaxation { viscosity: 2.0, time: 0.5 }];
    let giesekus = Giesekus::new(0.125, 2.0, 0.5, 0.3).expect("bounds");
    let linear = LinearPhanThienTanner::new(0.0, 2.0, 0.5, 0.3).expect("bounds");
    let exponential = ExponentialPhanThienTanner::new(0.125, 2.0, 0.5, 0.3).expect("bounds");
    let oldroyd = OldroydB::new(0.125, 2.0, 0.5).expect("bounds");
    vec![
        ReinerRivlin(ConstantCoefficients::new(1.5, 0.5).expect("bounds")).into(),
        SecondOrder::new(2.0, -0.5, 0.75).expect("bounds").into(),
        UpperConvectedMaxwell::new(2.0, 0.5).expect("bounds").into(),
        oldroyd.into(),
        giesekus.into(),
        linear.into(),
        exponential.into(),
        Slipping::new(oldroyd, 0.125).expect("bounds").into(),
        Slipping::new(LinearPhanThienTanner::new(0.125, 2.0, 0.5, 0.3).expect("bounds"), 0.125).expect("bounds").into(),
        Slipping::new(exponential, 0.125).expect("bounds").into(),
        Modes::new(vec![oldroyd, oldroyd]).expect("modes").into(),
        Modes::new(vec![giesekus]).expect("modes").into(),
        Modes::new(vec![linear]).expect("modes").into(),
        Modes::new(vec![exponential]).expect("modes").into(),
        Kbkz::new(memory.clone(), RationalDamping::new(8.0, 0.5).expect("bounds")).expect("bounds").into(),
        Kbkz::new(memory, ExponentialDamping::new(0.2, 0.5).expect("bounds")).expect("bounds").into(),
    ]
}
