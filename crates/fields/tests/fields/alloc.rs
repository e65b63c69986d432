//! Evaluations allocate nothing.

use nalgebra::Vector3;
use piola_continuum::{CauchyStress, Symmetric};
use piola_fields::compatibility::{Curvature, gradient_residual};
use piola_fields::{
    Body, Coordinates, Cylindrical, Eulerian, Flow, Inversion, Material, Motion, Spatial, Spherical, Uniform,
};
use piola_testkit::allocations_in;

use super::fixtures::{Column, Tensor, Wave};

#[test]
fn motions_inversion_operators_and_balances_allocate_nothing() {
    let motion = Wave { amplitude: 0.1, phase: [0.1, 0.2, 0.3], frequency: 1.0 };
    let tensor = Tensor { coefficients: [1.0; 9] };
    let (allocations, ()) = allocations_in(|| {
        for step in 0..100_i32 {
            let (x, t) = (Vector3::new(0.3, -0.2, 0.7), f64::from(step) * 0.01);
            motion.velocity_gradient(&x, t).expect("L");
            motion.acceleration(&x, t).expect("a");
            motion.second_gradient(&x, t).expect("gradient of F");
            let place = motion.position(&x, t).expect("x");
            Inversion::default().preimage(&motion, &place, t).expect("X");
            Eulerian::new(&motion).velocity(&place, t).expect("v");
            Spatial(tensor).rate_following(&motion, &x, t).expect("rate");
            let q = Vector3::new(1.0, 0.5, 0.7);
            Spherical.divergence(&tensor, &q, t).expect("div T");
            Cylindrical.local_basis(&q).expect("basis");
            gradient_residual(&Material(tensor), &q, t).expect("Curl");
            Curvature::of_metric(&Material(Uniform(Symmetric::identity())), &q, t).expect("curvature");
            let flow = Flow { coordinates: Cylindrical, density: Uniform(1.0), velocity: Column(tensor) };
            let stress = Uniform(CauchyStress::zero());
            flow.momentum_residual(&stress, &Uniform(Vector3::zeros()), &q, t).expect("momentum");
            let body = Body { motion, reference_density: Uniform(1.0) };
            body.spatial_momentum_residual(&Spatial(stress), &Spatial(Uniform(x)), &x, t).expect("momentum");
        }
    });
    assert_eq!(allocations, 0);
}
