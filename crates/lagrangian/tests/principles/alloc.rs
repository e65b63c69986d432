//! Evaluations with a workspace allocate nothing once it has been used.

use nalgebra::Vector3;
use piola_lagrangian::{PartForce, PartPower, Reaction, Workspace};
use piola_testkit::allocations_in;

use crate::systems::everything;

#[test]
fn evaluations_with_a_workspace_allocate_nothing() {
    let system = everything();
    let (q, v, a, t) = ([0.25, 0.5, -0.75], [1.0, -0.5, 0.25], [0.5, 0.25, 1.0], 0.5);
    let mut work = Workspace::default();
    let mut reactions = [Reaction::none(); 3];
    let mut parts = [PartPower::default(); 3];
    let mut out = [0.0; 3];
    let forces = [PartForce::force([1.0, 2.0, 3.0]); 3];
    let mut all = || {
        system.reactions_into(&mut work, &q, &v, t, &mut reactions).unwrap();
        system.power_balance_with(&mut work, &q, &v, t).unwrap();
        system.virtual_work_into(&mut work, &forces, &q, t, &mut out).unwrap();
        system.actuator_powers_into(&mut work, &q, &v, t, &mut parts, &mut out).unwrap();
        system.covariant_acceleration_into(&mut work, &q, &v, &a, t, &mut out).unwrap();
        system.raise_in_place(&mut work, &q, t, &mut out).unwrap();
        system.driving_forces_into(&mut work, &q, &v, &a, t, &mut out).unwrap();
        system.system_momentum_with(&mut work, &q, &v, t, &Vector3::zeros()).unwrap();
    };
    all();
    assert_eq!(allocations_in(all).0, 0);
}
