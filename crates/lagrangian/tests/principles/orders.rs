//! Slopes of convergence.

use piola_lagrangian::{Lagrangian, SampledMotion};
use piola_testkit::assert_order;

use crate::laws::{Oscillator, action_samples};
use crate::systems::everything;

#[test]
fn samples_of_a_motion_satisfy_the_discrete_equations_to_second_order() {
    let system = everything();
    let steps = [16_u32, 32, 64, 128];
    let spacings = steps.map(|steps| 1.0 / f64::from(steps));
    let residuals = steps.map(|steps| system.stationarity_of_samples(&action_samples(&system, steps)).unwrap().worst);
    assert_order("discrete Euler–Lagrange equations", &spacings, &residuals, 2.0, 0.1);
}

/// The cubic's error enters by its square, because the action is stationary at the motion q = cos t.
#[test]
fn action_of_samples_of_a_motion_converges_to_sixth_order() {
    let oscillator = Lagrangian::from_function(Oscillator);
    let steps = [4_u32, 8, 16, 32];
    let spacings = steps.map(|steps| 2.0 / f64::from(steps));
    let errors = steps.map(|steps| {
        let times: Vec<f64> = (0..=steps).map(|i| 2.0 / f64::from(steps) * f64::from(i)).collect();
        let coordinates = times.iter().map(|t| t.cos()).collect();
        let velocities = times.iter().map(|t| -t.sin()).collect();
        let samples = SampledMotion::new(1, times, coordinates, velocities).unwrap();
        let action = oscillator.action_of_samples(&samples).unwrap();
        let error = (action.value + 0.25 * 4.0_f64.sin()).abs();
        assert!(error <= action.error, "{error:e} {action:?}");
        error
    });
    assert_order("action", &spacings, &errors, 6.0, 0.25);
}
