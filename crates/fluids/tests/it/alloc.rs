//! No fluid allocates in an evaluation or in a step along a history.

use nalgebra::Matrix3;
use piola_continuum::rates::{ExponentialMotion, HomogeneousMotion, VelocityGradient};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_fluids::{
    ConvectedMaxwell, Extension, FlowMoment, Following, Giesekus, Kbkz, Modes, OldroydB, RationalDamping, Relaxation,
    SimpleFluid, SteadyStress, ViscometricFluid,
};
use piola_numerics::Dual;
use piola_testkit::allocations_in;

use super::elastic::all;

fn gradient() -> VelocityGradient {
    VelocityGradient::from_rows([[0.05, -0.05, 0.02], [0.3, -0.025, 0.05], [-0.08, 0.15, -0.025]]).expect("finite")
}

fn none(what: &str, evaluation: impl FnOnce()) {
    let (count, ()) = allocations_in(evaluation);
    assert_eq!(count, 0, "{what}");
}

#[test]
fn allocations_in_evaluations_of_every_fluid_equal_zero() {
    let l = gradient();
    for fluid in all() {
        none(&format!("{fluid:?}"), || {
            for k in [0.0, 1e-8, 0.7, -1e8] {
                let functions = (fluid.shear_stress(k), fluid.sigma1(k), fluid.sigma2(k), fluid.viscosity(k));
                let dual = (fluid.shear_stress(Dual::variable(k)), fluid.first_normal_stress_difference(k));
                let _ = core::hint::black_box((functions, dual, fluid.yield_stress()));
            }
            let rate = fluid.shear_rate(fluid.shear_stress(0.7));
            let moment = fluid.flow_moment(FlowMoment::First, 0.5, 2.5);
            let steady = fluid.response_to_steady(&l);
            let oscillation = fluid.response_to_small_oscillation(0.7);
            let extension = fluid.response_to_extension(Extension::Planar, 0.3);
            let _ = core::hint::black_box((rate, moment, steady, oscillation, extension));
        });
    }
}

#[test]
fn allocations_in_steps_along_histories_equal_zero() {
    let l = gradient();
    let modes = (0..4).map(|i| OldroydB::new(0.1, 2.0, 0.5 + f64::from(i)).expect("bounds")).collect();
    let fluid = Modes::new(modes).expect("modes");
    let mut memory = [Symmetric::zero(); 4];
    let motion = ExponentialMotion::new(l.0, Matrix3::identity()).expect("a motion");
    let samples: [(f64, DeformationGradient); 4] =
        [0.0, 0.5, 1.0, 2.0].map(|t| (t, motion.deformation(t).expect("a motion")));
    none("Maxwell", || {
        let starts = (fluid.start_up(2.0, 0.3), fluid.cessation(2.0, 0.3), fluid.start_up_stress(&l, 1.5));
        let steps = (fluid.advance(&mut memory, &l, 0.5), fluid.advance_through(&mut memory, &samples));
        let strain = |s: f64| Symmetric::new(0.0, s * s, 0.0, s, 0.0, 0.0);
        let history = (fluid.stress_of_history(strain, 2.0), fluid.steady_stress(&l));
        let _ = core::hint::black_box((starts, steps, history));
    });
    let terms = vec![Relaxation { viscosity: 2.0, time: 0.5 }, Relaxation { viscosity: 1.0, time: 4.0 }];
    let fluid = Kbkz::new(terms, RationalDamping::new(8.0, 0.5).expect("bounds")).expect("bounds");
    none("K-BKZ", || {
        let starts = (fluid.start_up(2.0, 0.3), fluid.cessation(2.0, 0.3), fluid.steady_shear(2.0));
        let along = (fluid.stress_along(&motion, 2.0), fluid.stress_of_samples(&samples), fluid.steady_stress(&l));
        let history = fluid.stress_of_history(|s| Symmetric::new(1.0, 1.0 + s * s, 1.0, s, 0.0, 0.0), 2.0);
        let _ = core::hint::black_box((starts, along, history));
    });
    let fluid = Modes::new(vec![
        Giesekus::new(0.1, 2.0, 0.5, 0.25).expect("bounds"),
        Giesekus::new(0.0, 1.0, 4.0, 0.1).expect("bounds"),
    ])
    .expect("modes");
    let rows = l.rows();
    let mut following = Following::from_rest(&fluid, 1e-9).expect("a tolerance");
    following.advance(|_| rows, 0.01).expect("runs");
    none("Giesekus", || {
        for step in 1..=20 {
            let turned = |t: f64| rows.map(|row| row.map(|x| x * (1.0 + t.sin())));
            let stress = following.advance(turned, 0.1 * f64::from(step));
            let _ = core::hint::black_box(stress);
        }
    });
}
