//! Flows of a Newtonian and a Bingham fluid against their closed forms.

use std::f64::consts::PI;

use piola::fluids::{AnyFluid, Bingham, Newtonian, OldroydB};
use piola_ffi::flows::{
    ViscometricFunction, couette_angular_velocities, couette_moment, couette_speed_difference, pipe_discharge,
    pipe_pressure_gradient, pipe_velocities, viscometric,
};
use piola_testkit::{Tol, assert_close, assert_each_close};

#[test]
fn flows_of_a_newtonian_fluid_are_those_of_hagen_and_couette() {
    let oil: AnyFluid = Newtonian::new(0.5).unwrap().into();
    let discharge = pipe_discharge(&oil, 2.0, 3.0).unwrap();
    assert!((discharge.value - 12.0 * PI).abs() <= discharge.error); // π c R⁴/(8 μ)
    let gradient = pipe_pressure_gradient(&oil, 2.0, 12.0 * PI).unwrap();
    assert!((gradient.value - 3.0).abs() <= gradient.error);
    let mut velocities = [0.0; 3];
    pipe_velocities(&oil, 2.0, 3.0, &[0.0, 1.0, 2.0], &mut velocities).unwrap();
    assert_each_close("velocities", &velocities, &[6.0, 4.5, 0.0], Tol::ulps(16.0)); // c (R² − r²)/(4 μ)
    let difference = couette_speed_difference(&oil, [1.0, 2.0], 8.0 * PI).unwrap();
    assert!((difference.value - 3.0).abs() <= difference.error); // M/(4 π μ) (1/R₁² − 1/R₂²)
    let moment = couette_moment(&oil, [1.0, 2.0], 3.0).unwrap();
    assert!((moment.value - 8.0 * PI).abs() <= moment.error);
    let mut speeds = [0.0; 2];
    couette_angular_velocities(&oil, [1.0, 2.0], 8.0 * PI, &[1.0, 2.0], &mut speeds).unwrap();
    assert_close("speeds", &speeds, &[0.0, 3.0], Tol::ulps(16.0));
}

#[test]
fn discharge_of_a_bingham_fluid_is_that_of_buckingham() {
    let (yields, viscosity, radius, gradient) = (3.0, 0.5, 2.0, 6.0);
    let mud: AnyFluid = Bingham::new(yields, viscosity).unwrap().into();
    let wall: f64 = 0.5 * gradient * radius;
    let share = yields / wall;
    let expected = PI * radius.powi(3) * wall / (4.0 * viscosity) * (1.0 - 4.0 / 3.0 * share + share.powi(4) / 3.0);
    let found = pipe_discharge(&mud, radius, gradient).unwrap();
    assert_close("discharge", &[found.value], &[expected], Tol::ulps(32.0));
}

#[test]
fn viscometric_functions_are_those_of_the_fluid() {
    let melt: AnyFluid = OldroydB::new(1.0, 3.0, 0.5).unwrap().into(); // ηₛ, ηₚ, λ
    let of = |function, entry: f64| {
        let mut out = [0.0];
        viscometric(&melt, function, &[entry], &mut out).unwrap();
        out[0]
    };
    assert_eq!(of(ViscometricFunction::ShearStress, 2.0), 8.0); // (ηₛ + ηₚ) k
    assert_eq!(of(ViscometricFunction::Viscosity, 2.0), 4.0);
    assert_eq!(of(ViscometricFunction::FirstNormalStressDifference, 2.0), 12.0); // 2 ηₚ λ k²
    assert_eq!(of(ViscometricFunction::SecondNormalStressDifference, 2.0), 0.0);
    assert_eq!(of(ViscometricFunction::ShearRate, 8.0), 2.0);
}
